/* The verdict first: counts, answers to what a reader asks first with how to run it again, the worst that was found in
   a few sentences, how the audit itself was tested.  Every sentence is made of the record. */
#include <string.h>

#include "escape.h"
#include "finding.h"
#include "html.h"
#include "sections.h"

static const char *const meaning[N_VERDICTS] = {
    [VERDICT_PROVED] = "an exact identity, or enclosures that settle the claim on its whole domain",
    [VERDICT_CONDITIONAL] = "refuted on the domain, proved under the condition named",
    [VERDICT_SUPPORTED] = ("agrees at every point tried, by at least two <a href=\"#s-routes\">routes</a> that do not "
                           "share their reasoning; not a proof"),
    [VERDICT_REFUTED] =
        "does not hold as printed; a certificate says where the two sides differ, or why the form cannot be right",
    [VERDICT_UNKNOWN] = "undecided; the claim says why",
    [VERDICT_SKIPPED] = "not possible in this scene, with the reason; never a success",
    [VERDICT_DEFINITION] = "asserts nothing"};

static void add_counts(const struct page *p, const long count[N_VERDICTS]) {
  text_add(p->out,
           "<table class=\"counts\" id=\"s-verdicts\">\n<caption>The verdicts, and what each word "
           "means</caption>\n<thead><tr>"
           "<th scope=\"col\">verdict</th><th scope=\"col\" class=\"n\">claims</th><th scope=\"col\">meaning</th>"
           "</tr></thead>\n<tbody>\n");
  for (int i = 0; i < N_VERDICTS; i++) {
    text_add(p->out, "<tr><th scope=\"row\">");
    page_verdict(p, (enum verdict)i);
    text_printf(p->out, "</th><td class=\"n\">%ld</td><td>%s</td></tr>\n", count[i], meaning[i]);
  }
  text_printf(p->out,
              "</tbody>\n<tfoot><tr><th scope=\"row\">all</th><td class=\"n\">%zu</td><td></td></tr></tfoot>\n"
              "</table>\n",
              p->r->n_findings);
}

/* --- The most important findings --- */

/* How much a failure says: failures that it rests on, which it sums up, then what fails with it, then what it is said
   to follow from. */
static long weight(const struct page *p, const struct finding *f) {
  long w = f->n_depends_on;
  for (int i = 0; i < f->n_depends_on; i++) {
    const struct finding *on = page_finding(p, f->depends_on[i]);
    w += on && finding_fails(on) ? 1000000 : 0;
  }
  const struct consequence *q = audit_result_consequence(p->r, f->id);
  return w + (q ? 1000L * q->falls.n : 0);
}

/* The weightiest failure of a grade; NULL without one. */
static const struct finding *foremost(const struct page *p, enum grade g) {
  const struct finding *best = NULL;
  for (size_t i = 0; i < p->r->n_findings; i++) {
    const struct finding *f = &p->r->findings[i];
    if (!finding_fails(f) || failure_grade(p->r, f) != g || failure_mended_with(p->r, f)) continue;
    if (!best || weight(p, f) > weight(p, best)) best = f;
  }
  return best;
}

static void add_quoted_title(const struct page *p, const struct finding *f) {
  page_begin_link(p, "f-", f->id);
  if (strncmp(f->id, "eq-", 3) == 0) {
    text_add(p->out, "Equation (");
    escape_html(p->out, f->id + 3);
    text_add(p->out, "), ");
  }
  text_add(p->out, "&#8220;");
  html_text(p->out, f->title, NULL);
  text_add(p->out, "&#8221;</a>");
}

static bool is_fault(const struct finding *f, const char *fault) {
  return f->fault && strcmp(f->fault, fault) == 0;
}

/* What is wrong, in the shortest words that the record has. */
static void add_reason(const struct page *p, const struct finding *f) {
  const struct consequence *q = audit_result_consequence(p->r, f->id);
  const struct evidence *e = failure_evidence(f);
  const char *size = failure_size(p->r, f);
  if (f->change) {
    text_add(p->out, ": ");
    html_text(p->out, f->change, NULL);
  } else if (is_fault(f, "number") && size) {
    text_add(p->out, ": ");
    html_text(p->out, size, NULL);
  } else if (is_fault(f, "argument")) {
    text_add(p->out, ": a counterexample stands with it");
  } else if (e && e->note) {
    text_add(p->out, ": ");
    html_text(p->out, e->note, NULL);
  }
  html_stop(p->out);
  if (is_fault(f, "argument") && f->correction) {
    text_add(p->out, " With the correction (");
    html_text(p->out, f->correction, NULL);
    text_printf(p->out, ") it is %s.", verdict_name[f->correction_verdict]);
  }
  if (f->verdict == VERDICT_CONDITIONAL && f->size) {
    text_add_char(p->out, ' ');
    html_text(p->out, f->size, NULL);
    html_stop(p->out);
  }
  if (q && q->falls.n) {
    text_add(p->out, " With it as printed, ");
    page_begin_link(p, "f-", f->id);
    text_printf(p->out, "%d statement%s</a> that rest%s on it fail%s.", q->falls.n, q->falls.n == 1 ? "" : "s",
                q->falls.n == 1 ? "s" : "", q->falls.n == 1 ? "s" : "");
  }
}

/* A link that shows what the claim says. */
static void add_titled(const struct page *p, const struct finding *f) {
  page_begin_link(p, "f-", f->id);
  html_text(p->out, f->title, NULL);
  text_add(p->out, "</a>");
}

/* What to change in one of the others. */
static void add_change(const struct page *p, const struct finding *f) {
  bool number = failure_is_number(f);
  if ((!number && !f->change) || failure_mended_with(p->r, f)) return;
  text_add(p->out, number ? " <span class=\"k\">(" : " (");
  if (number)
    html_math(p->out, f->correction_latex, NULL);
  else
    html_text(p->out, f->change, NULL);
  text_add(p->out, number ? ")</span>" : ")");
}

/* The others of the same grade, equations by number, with what to change in them. */
static void add_others(const struct page *p, enum grade g, const struct finding *but) {
  const char *sep = " Likewise: ";
  for (size_t i = 0; i < p->r->n_findings; i++) {
    const struct finding *f = &p->r->findings[i];
    if (f == but || !finding_fails(f) || failure_grade(p->r, f) != g) continue;
    text_add(p->out, sep);
    if (strncmp(f->id, "eq-", 3) == 0)
      page_claim(p, f->id);
    else
      add_titled(p, f);
    add_change(p, f);
    sep = "; ";
  }
  if (sep[0] == ';') text_add_char(p->out, '.');
}

static void add_foremost(const struct page *p) {
  enum { MOST = 3 };
  int n = 0;
  for (int g = 0; g < N_GRADES && n < MOST; g++) {
    const struct finding *f = foremost(p, (enum grade)g);
    if (!f) continue;
    if (n++ == 0) text_add(p->out, "<h3>The most important findings</h3>\n<ol>\n");
    text_printf(p->out, "<li><strong>%s.</strong> ", grade_heading[g]);
    add_quoted_title(p, f);
    text_add(p->out, f->verdict == VERDICT_CONDITIONAL ? " holds only under the condition " : " does not hold");
    if (f->verdict == VERDICT_CONDITIONAL) html_text(p->out, f->condition ? f->condition : "named there", NULL);
    add_reason(p, f);
    add_others(p, (enum grade)g, f);
    text_add(p->out, "</li>\n");
  }
  if (n) text_add(p->out, "</ol>\n");
}

/* --- What is asked first --- */

/* The refuted numbers among those that a refuted claim rests on, as printed or as corrected. */
static void add_numbers(const struct page *p, const struct finding *f, bool printed, const char *words) {
  const char *before = words;
  for (int i = 0; i < f->n_depends_on; i++) {
    const struct finding *on = page_finding(p, f->depends_on[i]);
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

/* What was computed for the orbit meant, before the list: "tr J = x: so by the criterion; admissible". */
static void add_meant(const struct page *p, const struct finding *f) {
  static const char meant[] = ", the nearest to the printed numbers", unstable[] = ": unstable";
  for (int i = 0; i < f->n_evidence; i++) {
    const struct evidence *e = &f->evidence[i];
    const char *colon = e->note ? strstr(e->note, ": ") : NULL, *end = colon ? strchr(colon, ';') : NULL;
    if (!e->worst || !strstr(e->worst, meant) || !end) continue;
    text_printf(p->out, "<strong>%s: the periodic solution nearest to the printed numbers is ",
                strncmp(colon, unstable, strlen(unstable)) == 0 ? "No" : "Yes");
    html_prose_n(p->out, colon + 2, (size_t)(end - colon - 2));
    text_add(p->out, "</strong>, with ");
    html_prose_n(p->out, e->note, (size_t)(colon - e->note));
    text_add(p->out, ". ");
    return;
  }
}

static void add_verdict_of(const struct page *p, const struct finding *f) {
  text_add(p->out, " Claim ");
  page_claim(p, f->id);
  text_add(p->out, ": ");
  page_verdict(p, f->verdict);
  text_add_char(p->out, '.');
}

static void add_stability(const struct page *p, const struct finding *f) {
  add_meant(p, f);
  html_text(p->out,
            "Each period multiplies a small distance from a periodic motion by $|\\operatorname{tr} J|$: below 1 it is "
            "stable, above 1 unstable. The paper gives this criterion and does not say which its example is. For all "
            "periodic solutions found with its data (claim ",
            NULL);
  page_claim(p, f->id);
  text_add(p->out, "):");
  page_statements(p, f, "states");
  html_text(
      p->out,
      "Admissible: the two masses can follow it; not admissible: it solves the equations and breaks a condition of "
      "the motion.",
      NULL);
  const struct finding *later = page_finding(p, "text-long-run");
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
    text_add(p->out, " Rounding does not explain it. ");
    html_text(p->out, e->note, NULL);
    html_stop(p->out);
  }
  add_verdict_of(p, f);
}

static bool is_wrong_formula(const struct finding *f) {
  return finding_fails(f) && strncmp(f->id, "eq-", 3) == 0;
}

/* What to do about a formula, in a few words. */
static void add_remedy(const struct page *p, const struct finding *f) {
  const struct finding *first = failure_mended_with(p->r, f);
  if (first) {
    text_add(p->out, ": mended with ");
    page_claim(p, first->id);
  } else if (f->change) {
    text_add(p->out, ": ");
    html_text(p->out, f->change, NULL);
    if (f->verdict == VERDICT_CONDITIONAL && f->condition) {
      text_add(p->out, " (as printed it holds where ");
      html_text(p->out, f->condition, NULL);
      text_add_char(p->out, ')');
    }
  } else if (f->correction) {
    text_add(p->out, ": should read ");
    if (f->correction_latex)
      html_math(p->out, f->correction_latex, NULL);
    else
      html_text(p->out, f->correction, NULL);
  }
}

/* Those with a fault of that class, or with any other. */
static bool add_wrong(const struct page *p, bool notation, const char *heading) {
  const char *before = heading;
  for (size_t i = 0; i < p->r->n_findings; i++) {
    const struct finding *f = &p->r->findings[i];
    if (!is_wrong_formula(f) || is_fault(f, "notation") != notation) continue;
    text_add(p->out, before);
    text_add(p->out, "<li>");
    page_claim(p, f->id);
    add_remedy(p, f);
    text_add(p->out, "</li>\n");
    before = "";
  }
  if (!*before) text_add(p->out, "</ul>\n");
  return !*before;
}

static bool is_slip_of_text(const struct finding *f) {
  return finding_fails(f) && strncmp(f->id, "eq-", 3) != 0 && is_fault(f, "notation");
}

/* Slips outside the numbered equations, by what does not hold. */
static void add_slips_of_text(const struct page *p) {
  const char *before = "<p>Slips of notation in the text. It does not hold that</p>\n<ul>\n";
  for (size_t i = 0; i < p->r->n_findings; i++) {
    if (!is_slip_of_text(&p->r->findings[i])) continue;
    text_printf(p->out, "%s<li>", before);
    add_titled(p, &p->r->findings[i]);
    text_add(p->out, "</li>\n");
    before = "";
  }
  if (!*before) text_add(p->out, "</ul>\n");
}

static void add_wrong_formulas(const struct page *p) {
  text_add(p->out, "<dt>Which printed formulas are wrong?</dt>\n<dd>");
  bool any = add_wrong(p, false, "<p>Not what the equations of motion give:</p>\n<ul class=\"columns\">\n");
  any |= add_wrong(p, true,
                   "<p>Slips of notation, without sense or false when read literally:</p>\n<ul class=\"columns\">\n");
  add_slips_of_text(p);
  text_add(p->out,
           any ? "<p>A letter behind the number of an equation tells apart the several things that the paper says "
                 "under that number.</p></dd>\n"
               : "None of those judged.</dd>\n");
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
  text_add(p->out, "<li>One claim, by the command that stands with it, for ");
  page_claim(p, f->id);
  text_add_char(p->out, ' ');
  html_code(p->out, finding_recheck(f));
  text_add(p->out, "; with <code>--out DIR</code> its report goes to that folder and this one stays.</li>\n");
  if (point_of(&point, note)) {
    text_add(p->out, "<li>Both sides of it as numbers, there or wherever you like: <code>stickslip explain ");
    escape_html(p->out, f->id);
    text_add(p->out, " --at ");
    escape_html(p->out, text_str(&point));
    text_add(p->out, "</code>.</li>\n");
  }
  text_add(p->out, "<li>By hand: evaluate both sides at the exact parameters that a certificate names");
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
           "<dt>How do I recheck it?</dt>\n<dd><p>In a copy of the project; its program is "
           "<code>build/stickslip</code> there, called <code>stickslip</code> on this page.</p>\n<ul>\n"
           "<li>All of it: <code>make deps verify</code> installs what is needed, builds the program and repeats "
           "the audit; once built, <code>stickslip verify ");
  escape_html(p->out, p->r->scene);
  text_add(p->out, "</code> does.</li>\n");
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
    const struct finding *f = page_finding(p, of[i].id);
    if (!f) continue;
    text_printf(p->out, "<dt>%s</dt>\n<dd>", of[i].question);
    add_answer(p, f);
    text_add(p->out, "</dd>\n");
  }
  add_wrong_formulas(p);
  add_recheck(p);
  text_add(p->out, "</dl>\n");
}

/* The failures by how much they say, each with a link to where they are. */
static void add_grades(const struct page *p, long failures) {
  long n[N_GRADES] = {0};
  for (size_t i = 0; i < p->r->n_findings; i++)
    if (finding_fails(&p->r->findings[i])) n[failure_grade(p->r, &p->r->findings[i])]++;
  const char *sep = "";
  if (!failures) return;
  text_printf(p->out, "<p>The %ld, worst first: ", failures);
  for (int g = 0; g < N_GRADES; g++) {
    if (!n[g]) continue;
    text_printf(p->out, "%s<a href=\"#g-%d\">%s</a> <strong>%ld</strong>", sep, g, grade_heading[g], n[g]);
    sep = ", ";
  }
  text_add(p->out, ".</p>\n");
}

void page_summary(const struct page *p) {
  long count[N_VERDICTS], total = audit_result_count(count, p->r, OF_PAPER);
  page_begin_section(p, "verdict", "The verdict");
  text_printf(
      p->out,
      "<p class=\"lead\">Of %ld statements, <strong>%ld do not hold as printed</strong> (%ld refuted, %ld true only "
      "under a condition); %ld are proved, %ld supported (no proof, and no counterexample), %ld undecided",
      total, count[VERDICT_REFUTED] + count[VERDICT_CONDITIONAL], count[VERDICT_REFUTED], count[VERDICT_CONDITIONAL],
      count[VERDICT_PROVED], count[VERDICT_SUPPORTED], count[VERDICT_UNKNOWN]);
  if (count[VERDICT_SKIPPED]) text_printf(p->out, ", %ld not possible here", count[VERDICT_SKIPPED]);
  text_printf(p->out, "; %ld are definitions.</p>\n", count[VERDICT_DEFINITION]);
  add_grades(p, count[VERDICT_REFUTED] + count[VERDICT_CONDITIONAL]);
  page_verdict_bar(p, count);
  add_questions(p);
  add_foremost(p);
  page_power(p);
  add_counts(p, count);
  text_add(p->out, "</section>\n");
}
