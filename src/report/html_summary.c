/* The verdict first: counts, the worst that was found in a few sentences, answers to what a reader asks first, how the
   audit itself was tested, how to run it again.  Every sentence is made of the record. */
#include <string.h>

#include "html.h"

static const char *const meaning[N_VERDICTS] = {
    [VERDICT_PROVED] = "an exact identity, or enclosures that settle the claim on its whole domain",
    [VERDICT_CONDITIONAL] = "refuted on the domain, proved under the condition named",
    [VERDICT_SUPPORTED] =
        "agrees at every accepted point, by at least two routes that do not share their reasoning; not a proof",
    [VERDICT_REFUTED] =
        "does not hold as printed; a certificate says where the two sides differ, or why the form cannot be right",
    [VERDICT_UNKNOWN] = "undecided; the claim says why",
    [VERDICT_SKIPPED] = "not possible in this scene, with the reason; never a success",
    [VERDICT_DEFINITION] = "asserts nothing"};

static void add_counts(const struct page *p, const long count[N_VERDICTS]) {
  text_add(p->out,
           "<table class=\"counts\">\n<caption>The verdicts, and what each word means</caption>\n<thead><tr>"
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

/* How much a failure says: failures that it rests on, which it sums up, then what fails with it, then what it is said to
   follow from. */
static long weight(const struct page *p, const struct finding *f) {
  long w = f->n_depends_on;
  for (int i = 0; i < f->n_depends_on; i++) {
    const struct finding *on = page_finding(p, f->depends_on[i]);
    w += on && report_is_failure(on) ? 1000000 : 0;
  }
  const struct consequence *q = audit_result_consequence(p->r, f->id);
  return w + (q ? 1000L * q->falls.n : 0);
}

/* The weightiest failure of a grade; NULL without one. */
static const struct finding *foremost(const struct page *p, enum grade g) {
  const struct finding *best = NULL;
  for (size_t i = 0; i < p->r->n_findings; i++) {
    const struct finding *f = &p->r->findings[i];
    if (!report_is_failure(f) || report_grade(p->r, f) != g || report_mended_with(p->r, f)) continue;
    if (!best || weight(p, f) > weight(p, best)) best = f;
  }
  return best;
}

static void add_quoted_title(const struct page *p, const struct finding *f) {
  text_add(p->out, "<a href=\"#");
  html_anchor(p->out, "f-", f->id);
  text_add(p->out, "\">");
  if (strncmp(f->id, "eq-", 3) == 0) {
    text_add(p->out, "Equation (");
    html_plain(p->out, f->id + 3);
    text_add(p->out, "), ");
  }
  text_add(p->out, "&#8220;");
  html_text(p->out, f->title, NULL);
  text_add(p->out, "&#8221;</a>");
}

/* What is wrong, in the shortest words that the record has. */
static void add_reason(const struct page *p, const struct finding *f) {
  const struct consequence *q = audit_result_consequence(p->r, f->id);
  const struct evidence *e = report_deciding(f);
  const char *size = q ? f->size : f->effect;
  if (f->change) {
    text_add(p->out, ": ");
    html_text(p->out, f->change, NULL);
  } else if (f->fault && strcmp(f->fault, "number") == 0 && size) {
    text_add(p->out, ": ");
    html_text(p->out, size, NULL);
  } else if (e && e->note) {
    text_add(p->out, ": ");
    html_text(p->out, e->note, NULL);
  }
  html_stop(p->out);
  if (q && q->falls.n) {
    text_add(p->out, " With it ");
    page_claims(p, &q->falls);
    text_add(p->out, q->falls.n == 1 ? " fails." : " fail.");
  }
}

/* The others of the same grade, by name, with what to change in them. */
static void add_others(const struct page *p, enum grade g, const struct finding *but) {
  const char *sep = " Likewise: ";
  for (size_t i = 0; i < p->r->n_findings; i++) {
    const struct finding *f = &p->r->findings[i];
    if (f == but || !report_is_failure(f) || report_grade(p->r, f) != g) continue;
    text_add(p->out, sep);
    page_claim(p, f->id);
    if (f->change && !report_mended_with(p->r, f)) {
      text_add(p->out, " (");
      html_text(p->out, f->change, NULL);
      text_add_char(p->out, ')');
    }
    sep = ", ";
  }
  if (sep[0] == ',') text_add_char(p->out, '.');
}

static void add_foremost(const struct page *p) {
  enum { MOST = 3 };
  int n = 0;
  for (int g = 0; g < N_GRADES && n < MOST; g++) {
    const struct finding *f = foremost(p, (enum grade)g);
    if (!f) continue;
    if (n++ == 0) text_add(p->out, "<h3>The most important findings</h3>\n<ol>\n");
    text_printf(p->out, "<li><strong>%s.</strong> ", report_grade_heading[g]);
    add_quoted_title(p, f);
    text_add(p->out, f->verdict == VERDICT_CONDITIONAL ? " holds under a condition only" : " does not hold");
    add_reason(p, f);
    add_others(p, (enum grade)g, f);
    text_add(p->out, "</li>\n");
  }
  if (n) text_add(p->out, "</ol>\n");
}

/* --- What is asked first --- */

static void add_answer(const struct page *p, const struct finding *f) {
  if (f->verdict != VERDICT_DEFINITION) {
    text_add(p->out, report_is_failure(f)                                              ? "No: "
                     : f->verdict == VERDICT_PROVED || f->verdict == VERDICT_SUPPORTED ? "Yes: "
                                                                                       : "Open: ");
    page_claim(p, f->id);
    text_add(p->out, " is ");
    page_verdict(p, f->verdict);
    text_add_char(p->out, '.');
    return;
  }
  text_add(p->out, "The paper does not say; what was computed (");
  page_claim(p, f->id);
  text_add(p->out, "):");
  page_statements(p, f, "states");
}

static bool is_wrong_formula(const struct finding *f) {
  return report_is_failure(f) && strncmp(f->id, "eq-", 3) == 0;
}

/* What to do about a formula, in a few words. */
static void add_remedy(const struct page *p, const struct finding *f) {
  const struct finding *first = report_mended_with(p->r, f);
  if (first) {
    text_add(p->out, ": mended with ");
    page_claim(p, first->id);
  } else if (f->change) {
    text_add(p->out, ": ");
    html_text(p->out, f->change, NULL);
  } else if (f->correction) {
    text_add(p->out, ": should read ");
    if (f->correction_latex)
      html_math(p->out, f->correction_latex, NULL);
    else
      html_text(p->out, f->correction, NULL);
  }
}

static void add_wrong_formulas(const struct page *p) {
  const char *before = "<dt>Which printed formulas are wrong?</dt>\n<dd><ul class=\"columns\">\n";
  for (size_t i = 0; i < p->r->n_findings; i++) {
    const struct finding *f = &p->r->findings[i];
    if (!is_wrong_formula(f)) continue;
    text_add(p->out, before);
    text_add(p->out, "<li>");
    page_claim(p, f->id);
    add_remedy(p, f);
    text_add(p->out, "</li>\n");
    before = "";
  }
  if (!*before) text_add(p->out, "</ul>A letter tells apart what is said under one number.</dd>\n");
}

/* Questions and the claims that answer them, where those were judged. */
static void add_questions(const struct page *p) {
  static const struct {
    const char *question, *id;
  } of[] = {{"Is the printed example a periodic solution?", "text-periodic"},
            {"Is the example stable?", "text-example-stability"}};
  text_add(p->out, "<h3>Asked first</h3>\n<dl>\n");
  for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
    const struct finding *f = page_finding(p, of[i].id);
    if (!f) continue;
    text_printf(p->out, "<dt>%s</dt>\n<dd>", of[i].question);
    add_answer(p, f);
    text_add(p->out, "</dd>\n");
  }
  add_wrong_formulas(p);
  text_add(p->out, "<dt>How is it rechecked?</dt>\n<dd>All of it: <code>stickslip verify ");
  html_plain(p->out, p->r->scene);
  text_add(p->out, "</code>. One claim: the command in its row, as <code>stickslip verify ");
  html_plain(p->out, p->r->scene);
  text_add(p->out, " --only ID</code>; or by hand at the exact parameters that a refutation names.</dd>\n</dl>\n");
}

/* --- Its own power --- */

static void add_power(const struct page *p) {
  const struct audit_result *r = p->r;
  size_t noticed = 0, within = 0;
  for (size_t i = 0; i < r->n_controls; i++) noticed += r->controls[i].noticed;
  for (size_t i = 0; i < r->n_pairs; i++) within += r->pairs[i].within;
  text_add(p->out, "<h3>Would it have noticed?</h3>\n<p>");
  if (r->n_controls)
    text_printf(p->out, "Of %zu statements made wrong on purpose, <strong>%zu were noticed</strong> in this run. ",
                r->n_controls, noticed);
  else
    text_add(p->out, "No statements made wrong on purpose were tried in this run. ");
  if (r->n_pairs)
    text_printf(p->out, "Of %zu pairs of routes to one quantity, %zu agree within the accuracy that they state. ",
                r->n_pairs, within);
  long unexpected = audit_result_unexpected(r);
  if (unexpected)
    text_printf(p->out, "<strong>%ld results are not as recorded.</strong>", unexpected);
  else
    text_add(p->out, "All verdicts are as recorded.");
  text_add(p->out, "</p>\n");
}

void page_summary(const struct page *p) {
  long count[N_VERDICTS];
  audit_result_count(p->r, count);
  text_add(p->out, "<section id=\"s-verdict\" aria-labelledby=\"h-verdict\">\n<h2 id=\"h-verdict\">The verdict</h2>\n");
  text_printf(p->out,
              "<p class=\"lead\">Of %zu statements, <strong>%ld do not hold as printed</strong>; %ld are proved, "
              "%ld supported, %ld undecided",
              p->r->n_findings, count[VERDICT_REFUTED] + count[VERDICT_CONDITIONAL], count[VERDICT_PROVED],
              count[VERDICT_SUPPORTED], count[VERDICT_UNKNOWN]);
  if (count[VERDICT_SKIPPED]) text_printf(p->out, ", %ld not possible here", count[VERDICT_SKIPPED]);
  text_printf(p->out, "; %ld assert nothing.</p>\n", count[VERDICT_DEFINITION]);
  page_verdict_bar(p, count);
  add_foremost(p);
  add_questions(p);
  add_power(p);
  add_counts(p, count);
  text_add(p->out, "</section>\n");
}
