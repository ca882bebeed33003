/* For a reader who has not seen the paper: the system in half a page; and what the audit takes as given. */
#include "finding.h"
#include "glossary.h"
#include "page.h"

static void add_phases(const struct page *p) {
  static const struct {
    const char *matrix, *name, *masses, *lasts, *ends;
  } phases[] = {{"D", "global sticking", "both stick", "t_a",
                 "the springs' pull on $m_1$ reaches its limit, $z_1 - \\chi z_2 = e_1$"},
                {"\\Gamma", "slip-stick", "$m_1$ slips, $m_2$ sticks", "t_b",
                 "the pull on $m_2$ reaches its limit, $\\chi (z_2 - z_1) = e_2$"},
                {"H", "global slipping", "both slip", "t_c", "$m_1$ has the belt's velocity again, $z'_1 = V$"},
                {"C", "stick-slip", "$m_1$ sticks, $m_2$ slips", "t_d", "$m_2$ has it again, $z'_2 = V$"}};
  static const char heads[] = "phase|matrix|masses|lasts|ends when";
  page_begin_table(p, "stack", "The four phases of the paper's periodic motion", heads);
  for (size_t i = 0; i < sizeof phases / sizeof *phases; i++)
    page_row(p, heads, PAGE_ROW "%s</th>|%m|%t|%m|%t", phases[i].name, phases[i].matrix, phases[i].masses,
             phases[i].lasts, phases[i].ends);
  page_end_table(p);
}

static void add_words(const struct page *p) {
  text_add(p->out, "<h4 id=\"s-words\">Words used on this page</h4>\n<p>What the verdicts mean is said <a "
                   "href=\"#s-power\">below</a>.</p>\n<dl>\n");
  for (const struct glossary_entry *g = NULL; (g = glossary_next(g, p->r)) != NULL;)
    page_add(p, "<dt>%s</dt>\n<dd>%t.</dd>\n", g->word, g->meaning);
  text_add(p->out, "</dl>\n");
}

static void add_system(const struct page *p) {
  static const char *const before[] = {
      "Two blocks of mass $m_1$ and $m_2$ lie on a belt that moves with the constant velocity $V$. A spring of "
      "stiffness "
      "$k_1$ ties the first to a wall, a spring of stiffness $k_2$ ties the second to the first. The belt drags a "
      "block along (it sticks) until the springs pull harder than static friction, $u_{r1}$ or $u_{r2}$, can hold; "
      "then it slips against the smaller sliding friction, $u_{s1}$ or $u_{s2}$, until its velocity is the belt's "
      "again and friction can hold it.",
      "In dimensionless time, $x_1'' + x_1 - \\chi x_2 = u_1$ and $x_2'' + \\chi \\eta (x_2 - x_1) = \\eta u_2$, where "
      "$\\chi = "
      "\\frac{k_2}{k_1 + k_2}$ and $\\eta = \\frac{m_1}{m_2}$: time is counted in units of "
      "$\\sqrt{\\frac{m_1}{k_1 + k_2}}$, forces are divided by $k_1 + k_2$, which makes lengths of them, and lengths "
      "are in any one unit, so that the numbers on this page have none. Positions measured from the equilibrium under "
      "both sliding forces are $z_1, z_2$; of the friction only $e_1 = u_{r1} - u_{s1}$ and $e_2 = u_{r2} - u_{s2}$ "
      "enter."};
  static const char after[] =
      "In each phase a matrix carries the state $Z = (z_1, z_2, z'_1, z'_2)$ to its end; the motion is periodic when "
      "the state returns after all four. Its stability is determined by the Jacobian $J$ of one period: a small "
      "deviation is multiplied by $\\operatorname{tr} J$ in each period, so that it decreases if "
      "$|\\operatorname{tr} J| < 1$ and grows if $|\\operatorname{tr} J| > 1$.";
  page_add(p, "<figure>\n%s<figcaption>The system as the equations of motion (1) describe it.</figcaption></figure>\n",
           page_belt_svg);
  for (size_t i = 0; i < sizeof before / sizeof *before; i++) page_add(p, "<p>%t</p>\n", before[i]);
  add_phases(p);
  page_add(p, "<p>%t</p>\n", after);
}

void page_model(const struct page *p) {
  page_begin_fold(p, "model",
                  p->r->model ? "The system in half a page, and the words used here" : "The words used here");
  if (p->r->model) add_system(p);
  add_words(p);
  text_add(p->out, "</details>\n");
}

void page_limits(const struct page *p) {
  const struct audit_result *r = p->r;
  page_begin_fold(p, "limits", "What the audit does not show");
  page_add(p, "<ul>\n%s%s", r->model ? page_limits_model_html : "", page_limits_html);
  if (r->paper_source) page_add(p, "<li>What the printed page says: %t</li>\n", r->paper_source);
  if (r->paper_text)
    page_add(p,
             "<li>That your copy of the paper says what is quoted here: <code>stickslip quotes FILE</code> looks "
             "for every quotation in a copy. The digest of the text quoted, as its tokens: %c.</li>\n",
             r->paper_text);
  for (size_t i = 0; i < r->n_skipped; i++)
    page_add(p, "<li>Left out: %t: %e%.</li>\n", r->skipped[i].what, r->skipped[i].why);
  text_add(p->out, "</ul>\n</details>\n");
}
