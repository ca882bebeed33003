/* The verdict first: counts, answers to what a reader asks first with how to run it again, the worst that was found in
   a few sentences, how the audit itself was tested.  Every sentence is made of the record. */
#include <string.h>

#include "escape.h"
#include "finding.h"
#include "html.h"
#include "sections.h"

static const char *const meaning[N_VERDICTS] = {
    [VERDICT_PROVED] = "by exact algebra, or by rigorous error bounds on the whole domain",
    [VERDICT_CONDITIONAL] = "does not hold in general, proved under the condition named",
    [VERDICT_SUPPORTED] =
        ("confirmed at every point tried, by at least two independent <a href=\"#s-routes\">routes</a>; not a "
         "proof"),
    [VERDICT_REFUTED] =
        "does not hold as printed; a certificate says where the two sides differ, or why the form cannot be right",
    [VERDICT_UNKNOWN] = "undecided, for the reason given with the claim",
    [VERDICT_SKIPPED] = "cannot be judged with these data, for the reason given",
    [VERDICT_DEFINITION] = "asserts nothing that could be judged"};

static void add_counts(const struct page *p, const long count[N_VERDICTS], const long checks[N_VERDICTS]) {
  text_add(p->out, "<table class=\"counts\" id=\"s-verdicts\">\n<caption>The verdicts, and what each word "
                   "means</caption>\n<thead><tr>"
                   "<th scope=\"col\">verdict</th><th scope=\"col\" class=\"n\">statements of the paper</th>"
                   "<th scope=\"col\" class=\"n\">checks of the suite</th><th scope=\"col\">meaning</th>"
                   "</tr></thead>\n<tbody>\n");
  long of_paper = 0, of_suite = 0;
  for (int i = 0; i < N_VERDICTS; i++) {
    of_paper += count[i];
    of_suite += checks[i];
    text_add(p->out, "<tr><th scope=\"row\">");
    page_verdict(p, (enum verdict)i);
    text_printf(p->out, "</th><td class=\"n\">%ld</td><td class=\"n\">%ld</td><td>%s</td></tr>\n", count[i], checks[i],
                meaning[i]);
  }
  text_printf(p->out,
              "</tbody>\n<tfoot><tr><th scope=\"row\">all</th><td class=\"n\">%ld</td><td "
              "class=\"n\">%ld</td><td></td></tr></tfoot>\n</table>\n",
              of_paper, of_suite);
}

/* --- The most important findings --- */

/* A link that shows what the claim says. */
static void add_titled(const struct page *p, const struct finding *f) {
  page_begin_link(p, "f-", f->id);
  html_text(p->out, f->title, NULL);
  text_add(p->out, "</a>");
}

/* --- What is asked first --- */

/* The refuted numbers among those that a refuted claim rests on, as printed or as corrected. */
static void add_numbers(const struct page *p, const struct finding *f, bool printed, const char *words) {
  const char *before = words;
  for (int i = 0; i < f->n_depends_on; i++) {
    const struct finding *on = audit_result_finding(p->r, f->depends_on[i]);
    const char *number = on && printed ? on->printed : on ? on->correction_latex : NULL;
    if (!number || !finding_fails(on) || !failure_is_number(on)) continue;
    text_printf(p->out, "%s<span class=\"k\">", before);
    html_math(p->out, number, NULL);
    before = ",</span> ";
  }
  if (before != words) text_add(p->out, ".</span>");
}

/* Printed beside true, for the size of the difference. */
static void add_mended_numbers(const struct page *p, const struct finding *f) {
  add_numbers(p, f, true, " The paper prints ");
  add_numbers(p, f, false, " The periodic solution nearest to the printed numbers has ");
}

/* What was computed for the orbit meant, before the list: "tr J = x, so by the criterion; admissible". */
static void add_meant(const struct page *p, const struct finding *f) {
  static const char meant[] = ", the nearest to the printed numbers", unstable[] = ", unstable";
  for (int i = 0; i < f->n_evidence; i++) {
    const struct evidence *e = &f->evidence[i];
    const char *comma = e->note ? strstr(e->note, ", ") : NULL, *end = comma ? strchr(comma, ';') : NULL;
    if (!e->worst || !strstr(e->worst, meant) || !end) continue;
    text_printf(p->out, "<strong>%s: the periodic solution nearest to the printed numbers is ",
                strncmp(comma, unstable, strlen(unstable)) == 0 ? "No" : "Yes");
    html_prose_n(p->out, comma + 2, (size_t)(end - comma - 2));
    text_add(p->out, "</strong>, with ");
    html_prose_n(p->out, e->note, (size_t)(comma - e->note));
    text_add(p->out, ". ");
    return;
  }
}

static void add_verdict_of(const struct page *p, const struct finding *f) {
  text_add_char(p->out, ' ');
  page_begin_link(p, finding_fails(f) ? "f-" : "c-", f->id);
  text_add(p->out, "Evidence</a>.");
}

static void add_stability(const struct page *p, const struct finding *f) {
  add_meant(p, f);
  html_text(
      p->out,
      "In each period a small distance from the periodic motion is multiplied by $|\\operatorname{tr} J|$; the motion "
      "is stable if this is less than 1 and unstable if it is greater. The paper does not apply its criterion to the "
      "example. For the data of the example the following was found:",
      NULL);
  page_statements(p, f, "states");
  html_text(p->out,
            "A solution is called admissible if the two masses can follow it, and not admissible if it satisfies the "
            "equations but violates a condition of the motion.",
            NULL);
  const struct finding *later = audit_result_finding(p->r, "text-long-run");
  if (!later) return;
  text_add(p->out, " See also ");
  add_titled(p, later);
  text_add_char(p->out, '.');
}

static void add_answer(const struct page *p, const struct finding *f) {
  bool yes = f->verdict == VERDICT_PROVED || f->verdict == VERDICT_SUPPORTED;
  const struct evidence *e = finding_fails(f) ? failure_evidence(f) : NULL;
  if (f->verdict == VERDICT_DEFINITION) {
    add_stability(p, f);
    return;
  }
  text_printf(p->out, "<strong>%s:</strong> ", e ? "No" : yes ? "Yes" : "Open");
  html_text(p->out, e && f->effect ? f->effect : e ? e->note : NULL, NULL);
  html_stop(p->out);
  if (e) add_mended_numbers(p, f);
  if (e && f->effect && e->note) {
    text_add(p->out, " Rounding does not explain this. ");
    html_text(p->out, e->note, NULL);
    html_stop(p->out);
  }
  add_verdict_of(p, f);
}

static bool is_wrong_formula(const struct finding *f) {
  return finding_fails(f) && strncmp(f->id, "eq-", 3) == 0;
}

/* What is held against what: the printed formula on the left. */
static void add_both_texts(const struct page *p, const struct finding *f) {
  const char *printed = finding_printed(f);
  if (!printed || !f->correction_latex) return;
  text_add(p->out, ", printed ");
  html_math(p->out, printed, NULL);
  text_add(p->out, " (left) against ");
  html_math(p->out, f->correction_latex, NULL);
  text_add(p->out, " (right)");
}

/* The parameters that a certificate ends with, "... at chi = 1/2, t = 5", as --at takes them; NULL where it ends with
   more, such as the number of an orbit. */
static const char *point_of(struct text *out, const char *note) {
  const char *at = note ? strstr(note, ", at ") : NULL;
  text_reset(out);
  if (!at) return NULL;
  for (const char *s = at + 5; *s;) {
    size_t n = strcspn(s, ",;"), equals = strcspn(s, "=");
    if (equals >= n || s[n] == ';') return NULL;
    for (size_t i = 0; i < n; i++)
      if (s[i] != ' ') text_add_char(out, s[i]);
    if (s[n]) text_add_char(out, ',');
    s += n + (s[n] != '\0');
  }
  return text_str(out);
}

/* The formula that is the example: wrong, and with a certificate. */
static const struct finding *example(const struct page *p) {
  for (size_t i = 0; i < p->r->n_findings; i++)
    if (is_wrong_formula(&p->r->findings[i]) && failure_evidence(&p->r->findings[i])) return &p->r->findings[i];
  return NULL;
}

static void add_recheck_one(const struct page *p, const struct finding *f) {
  const char *note = failure_evidence(f)->note;
  struct text point;
  text_init(&point);
  text_add(p->out, "<li>One statement, by the command that is given with it; for ");
  page_claim(p, f->id);
  text_add(p->out, " this is ");
  html_code(p->out, finding_recheck(f));
  text_add(p->out, ". With <code>--out DIR</code> the report is written to that folder.</li>\n");
  if (point_of(&point, note)) {
    text_add(p->out, "<li>Both sides as numbers, at this or at other parameters: <code>stickslip explain ");
    escape_html(p->out, f->id);
    text_add(p->out, " --at ");
    escape_html(p->out, text_str(&point));
    text_add(p->out, "</code>.</li>\n");
  }
  text_add(p->out, "<li>By hand: evaluate both sides at the exact parameters of a certificate");
  if (note) {
    text_add(p->out, ". For ");
    page_claim(p, f->id);
    add_both_texts(p, f);
    text_add(p->out, ": ");
    html_text(p->out, note, NULL);
  }
  html_stop(p->out);
  text_add(p->out, "</li>\n");
  text_clear(&point);
}

/* How to see it again, with one formula as the example: its command, and both sides at one point for a calculator. */
static void add_recheck(const struct page *p) {
  const struct finding *f = example(p);
  text_add(p->out,
           "<dt>How can this be rechecked?</dt>\n<dd><p>The program, called <code>stickslip</code> on this page, is "
           "<code>build/stickslip</code> in a copy of the project.</p>\n<ul>\n"
           "<li>The whole audit: <code>make deps verify</code> installs what is needed, builds the program and "
           "repeats the audit; once built, ");
  page_recheck(p);
  text_add(p->out, " repeats it.</li>\n");
  if (f) add_recheck_one(p, f);
  text_add(p->out, "</ul></dd>\n");
}

/* Questions and the claims that answer them, where those were judged. */
static void add_questions(const struct page *p) {
  static const struct {
    const char *question, *id;
  } of[] = {{"Is the printed example a periodic solution?", "text-periodic"},
            {"Is the example stable?", "text-example-stability"}};
  text_add(p->out, "<h3>What readers ask first</h3>\n<dl>\n");
  for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
    const struct finding *f = audit_result_finding(p->r, of[i].id);
    if (!f) continue;
    text_printf(p->out, "<dt>%s</dt>\n<dd>", of[i].question);
    add_answer(p, f);
    text_add(p->out, "</dd>\n");
  }
  add_recheck(p);
  text_add(p->out, "</dl>\n");
}

/* The verdict in two sentences: causes are counted, not claims; then what was decided of what the paper asserts. */
static void add_lead(const struct page *p, const long count[N_VERDICTS], long total) {
  size_t substance = audit_result_roots(p->r, true), slips = audit_result_roots(p->r, false);
  long asserted = total - count[VERDICT_DEFINITION], wrong = count[VERDICT_REFUTED] + count[VERDICT_CONDITIONAL];
  long decided = count[VERDICT_PROVED] + wrong;
  text_printf(p->out,
              "<p class=\"lead\"><strong>%zu point%s that affect%s results</strong> %s to be corrected in the paper",
              substance, substance == 1 ? "" : "s", substance == 1 ? "s" : "", substance == 1 ? "has" : "have");
  if (slips) text_printf(p->out, "; there are also %zu remark%s and slips of notation", slips, slips == 1 ? "" : "s");
  text_printf(p->out, ".</p>\n<p>Of the %ld statements of the paper that assert something, %ld have been proved",
              asserted, count[VERDICT_PROVED]);
  if (count[VERDICT_SUPPORTED])
    text_printf(p->out, "; %ld could be confirmed only numerically", count[VERDICT_SUPPORTED]);
  if (count[VERDICT_UNKNOWN]) text_printf(p->out, "; %ld could not be decided", count[VERDICT_UNKNOWN]);
  if (count[VERDICT_SKIPPED]) text_printf(p->out, "; %ld cannot be judged with these data", count[VERDICT_SKIPPED]);
  if (wrong) text_add(p->out, "; the others do not hold as printed, for these reasons");
  if (asserted > 0) text_printf(p->out, " (%ld %% are decided)", 100 * decided / asserted);
  text_add(p->out, ".</p>\n");
}

void page_summary(const struct page *p) {
  long count[N_VERDICTS], checks[N_VERDICTS], total = audit_result_count(count, p->r, OF_PAPER);
  audit_result_count(checks, p->r, OF_SUITE);
  page_begin_section(p, "verdict", "The verdict");
  add_lead(p, count, total);
  page_roots(p);
  add_questions(p);
  page_slips(p);
  page_verdict_bar(p, count);
  page_power(p);
  add_counts(p, count, checks);
  text_add(p->out, "</section>\n");
}
