/* audit.md: the same record for people.  Formulas stand between dollar signs, as common viewers render them. */
#include <string.h>

#include "escape.h"
#include "finding.h"
#include "glossary.h"
#include "report.h"
#include "sheet.h"

static void add_counts(struct text *out, const struct audit_result *r) {
  long paper[N_VERDICTS], suite[N_VERDICTS];
  long statements = audit_result_count(paper, r, OF_PAPER), checks = audit_result_count(suite, r, OF_SUITE);
  markdown_head(out, "verdict|statements of the paper:|checks of the suite:");
  for (int i = 0; i < N_VERDICTS; i++)
    if (paper[i] + suite[i]) text_printf(out, "| %s | %ld | %ld |\n", verdict_name[i], paper[i], suite[i]);
  text_printf(out, "| total | %ld | %ld |\n\n", statements, checks);
}

/* What fails, by the severity of its root. */
static void add_severities(struct text *out, const struct audit_result *r) {
  if (!r->n_roots) return;
  markdown_head(out, "refuted or conditional|roots:|statements of the paper:|checks of the suite:");
  for (int severity = 0; severity < N_SEVERITIES; severity++) {
    long of[2] = {0, 0};
    for (size_t i = 0; i < r->n_findings; i++)
      of[r->findings[i].of == OF_PAPER] += (int)r->findings[i].severity == severity;
    text_printf(out, "| %s | %zu | %ld | %ld |\n", severity_words[severity][0],
                audit_result_roots(r, (enum severity)severity), of[true], of[false]);
  }
  text_add(out, "\n");
}

/* What a reader of the paper has not met; and what the quotations were compared with. */
static void add_words(struct text *out, const struct audit_result *r) {
  const struct sheet s = {out, DIALECT_MARKDOWN};
  text_add(out, "## Words used in this report\n\n");
  for (const struct glossary_entry *g = NULL; (g = glossary_next(g, r)) != NULL;)
    sheet_add(&s, "- %s: %t.\n", g->word, g->meaning);
  text_add_char(out, '\n');
  if (r->paper_text)
    text_printf(out,
                "Digest of the quoted text of the paper, token by token: `%s` (`stickslip quotes FILE` compares "
                "it with a copy).\n\n",
                r->paper_text);
}

/* What is wrong, in order of consequence; slips of notation are a list behind it. */
static void add_roots(struct text *out, const struct audit_result *r) {
  const struct sheet s = {out, DIALECT_MARKDOWN};
  int last = -1;
  for (size_t i = 0; i < r->n_roots; i++) {
    const struct root_cause *root = &r->roots[i];
    if (last != (int)root->severity)
      text_printf(out, "%s## %s%s\n\n", i ? "\n" : "", severity_heading[root->severity],
                  root->severity == SEVERITY_SUBSTANCE ? ", in order of consequence" : "");
    last = (int)root->severity;
    sheet_add(&s, "- **%t**: %t. ", root->where, root->title);
    root_say(&s, r, root);
    for (int k = 0; k < root->n_claims; k++) text_printf(out, "%s%s", k ? ", " : " (Evidence: ", root->claims[k]);
    text_add(out, ")\n");
  }
  if (r->n_roots) text_add_char(out, '\n');
}

static void add_finding(struct text *out, const struct finding *f) {
  text_printf(out, "### %s: %s%s\n\n", f->id, failure_heading(f), f->title);
  if (f->quote) text_printf(out, "- paper: %s\n", f->quote);
  if (f->printed) text_printf(out, "- as read: $%s$\n", f->printed);
  text_printf(out, "- verdict: **%s**%s%s%s%s\n", verdict_name[f->verdict], f->fault ? ", fault: " : "",
              f->fault ? f->fault : "", f->condition ? ", condition: " : "", f->condition ? f->condition : "");
  if (f->correction)
    text_printf(out, "- %s: `%s` (%s)\n",
                f->correction_verdict != VERDICT_REFUTED ? "correction"
                : finding_fails(f)                       ? "no correction either"
                                                         : "the correction on file makes it wrong",
                f->correction, verdict_name[f->correction_verdict]);
  if (f->effect) text_printf(out, "- effect: %s\n", f->effect);
  for (int i = 0; i < f->n_depends_on; i++)
    text_printf(out, "%s%s%s", i ? ", " : "- depends on: ", f->depends_on[i], i + 1 == f->n_depends_on ? "\n" : "");
  for (int i = 0; i < f->n_evidence; i++) {
    const struct evidence *e = &f->evidence[i];
    text_printf(out, "- %s (%s): %s", e->route, or_dash(e->layer), e->result);
    evidence_extent(out, e);
    if (e->residual) text_printf(out, ", residual %s", e->residual);
    if (e->note) text_printf(out, "; %s", e->note);
    if (evidence_where(e)) text_printf(out, " [%s]", e->worst);
    text_add_char(out, '\n');
  }
  text_printf(out, "- recheck: `%s`\n\n", f->reproduce);
}

static void add_section(struct text *out, const struct audit_result *r, const char *heading,
                        bool (*wanted)(const struct finding *)) {
  bool any = false;
  for (size_t i = 0; i < r->n_findings; i++) {
    if (!wanted(&r->findings[i])) continue;
    if (!any) text_printf(out, "## %s\n\n", heading);
    any = true;
    add_finding(out, &r->findings[i]);
  }
}

static bool is_unknown(const struct finding *f) {
  return f->verdict == VERDICT_UNKNOWN;
}
static bool is_rest(const struct finding *f) {
  return !finding_fails(f) && !is_unknown(f);
}

static void add_overview(struct text *out, const struct audit_result *r) {
  text_add(out, "## Every claim\n\n");
  markdown_head(out, "claim|what it says|verdict|fault|as recorded");
  for (size_t i = 0; i < r->n_findings; i++) {
    const struct finding *f = &r->findings[i];
    text_printf(out, "| %s | ", f->id);
    escape_cell(out, or_dash(f->title));
    text_printf(out, " | %s | %s | %s |\n", verdict_name[f->verdict], or_dash(f->fault),
                f->recorded == N_VERDICTS ? "-"
                : finding_unexpected(f)   ? "NO"
                                          : "yes");
  }
  text_add_char(out, '\n');
}

static void add_controls(struct text *out, const struct audit_result *r) {
  if (r->n_controls == 0) return;
  text_printf(out, "## Controls\n\nStatements made wrong on purpose, of which %zu of %zu were noticed.\n\n",
              controls_noticed(r), r->n_controls);
  markdown_head(out, "control|claim that it alters|verdict|size of the alteration");
  for (size_t i = 0; i < r->n_controls; i++)
    text_printf(out, "| %s | %s | %s | %s |\n", r->controls[i].id, r->controls[i].claim,
                verdict_name[r->controls[i].verdict], r->controls[i].distance ? r->controls[i].distance : "");
  text_add_char(out, '\n');
}

/* --- Routes --- */

/* All, or those that disagree, under a heading. */
static void add_route_pairs(struct text *out, const struct audit_result *r, bool disagreeing) {
  const char *quantity = "";
  OWNED(text) heading = {0};
  for (size_t i = 0; i < r->n_pairs; i++) {
    const struct route_pair *p = &r->pairs[i];
    if (disagreeing && p->within) continue;
    if (disagreeing && !*quantity) text_add(out, "## Routes that disagree\n\n");
    if (strcmp(quantity, p->quantity) != 0) {
      if (*quantity) text_add_char(out, '\n');
      text_reset(&heading);
      text_add_capital(&heading, p->quantity);
      escape_cell(out, text_str(&heading));
      text_add(out, ":\n\n");
      markdown_head(out, "routes|both use|comparisons:|tolerance|largest disagreement|at");
    }
    quantity = p->quantity;
    text_printf(out, "| %s, %s | %s | %ld | %s | ", p->first, p->second, p->shared, p->comparisons, p->stated);
    text_printf(out, "%s%s | ", p->within ? "" : "**beyond**: ", p->largest ? p->largest : p->within ? "within" : "-");
    escape_cell(out, or_dash(p->worst));
    text_add(out, " |\n");
  }
  if (*quantity) text_add_char(out, '\n');
}

static void add_routes(struct text *out, const struct audit_result *r) {
  if (!r->model) return;
  text_add(out, "## What the routes have in common\n\n");
  if (r->n_pairs)
    text_add(out,
             "Any two routes to the same quantity are compared at fixed random points and on orbits. The table shows "
             "what both use, in the computation or in locating the events, besides the equations of motion and the "
             "point, and the largest disagreement relative to max(1, largest entry). Finite differences are compared "
             "to within their own estimate of error where that is larger. The disagreements of routes in double "
             "precision are given in run.json.\n\n");
  add_route_pairs(out, r, false);
  for (int i = 0; i < r->n_independence; i++) text_printf(out, "- %s\n", r->independence[i]);
  text_add_char(out, '\n');
}

/* Likewise of those that fail. */
static void add_long_run_rows(struct text *out, const struct audit_result *r, bool failing) {
  bool any = false;
  for (size_t i = 0; i < r->n_long_runs; i++) {
    const struct long_result *l = &r->long_runs[i];
    if (failing && !long_result_fails(l)) continue;
    if (failing && !any) text_add(out, "## Long runs that the multiplier does not explain\n\n");
    if (!any)
      markdown_head(out, "orbit|tr J:|periods run:|an error of 2^-52 reaches 1e-6 after|departure from MPFR as "
                         "predicted|displacement as predicted");
    any = true;
    text_printf(out, "| %s | %s | %ld | %s | %s | %s |\n", l->orbit, l->multiplier, l->periods, l->expected,
                l->obeys ? "yes" : "**NO**", l->displaced ? "yes" : "**NO**");
  }
  if (any) text_add_char(out, '\n');
}

static void add_long_runs(struct text *out, const struct audit_result *r) {
  if (r->n_long_runs == 0) return;
  text_add(
      out,
      "## Long runs\n\nNumerical integration by GSL and the closed forms, both in double precision, are compared with "
      "the closed forms in multiple precision (MPFR), from the same initial state on the orbit, under Coulomb's "
      "law. Where |tr J| > 1 both must depart from the latter by that factor each period; where |tr J| < 1 their "
      "positions must stay within 1e-9 of it, relative to the state; and a displacement between two of them must "
      "grow or shrink by that factor. The rates are required to agree to a tenth of log |tr J|; the measured "
      "ones, and the times at which the runs differ by 1e-6, are given in run.json. `stickslip simulate SCENE "
      "--compare` shows a run.\n\n");
  add_long_run_rows(out, r, false);
}

static void add_precision(struct text *out, const struct audit_result *r) {
  if (r->n_precision) {
    text_add(out, "## Precision\n\nHow often the first precision in interval arithmetic was sufficient; otherwise it "
                  "was raised.\n\n");
    markdown_head(out, "computation|times:|sufficient:");
  }
  for (size_t i = 0; i < r->n_precision; i++)
    text_printf(out, "| %s | %ld | %ld |\n", r->precision[i].what, r->precision[i].tried, r->precision[i].enough);
  if (r->n_precision) text_add_char(out, '\n');
}

/* --- Consequences of a failure --- */

static void add_ids(struct text *out, const char *label, const struct id_list *list) {
  for (int i = 0; i < list->n; i++)
    text_printf(out, "%s%s%s", i ? ", " : label, list->id[i], i + 1 == list->n ? "\n" : "");
}

static bool all_same(const struct consequence *q) {
  for (int i = 0; i < q->n_derived; i++)
    if (q->derived[i].change != CHANGE_SAME_FORMULA) return false;
  return true;
}

/* Whether nothing else is touched by the failure. */
static bool is_idle(const struct consequence *q) {
  return all_same(q) && !q->falls.n && !q->survives.n && !q->open.n;
}

static void add_changes(const struct sheet *s, const struct consequence *q) {
  if (!derived_next(q, NULL, CHANGE_CHANGES)) return;
  text_add(s->out, "\n");
  markdown_head(s->out, "result||relative difference|entry|as printed|corrected|at");
  for (const struct derived *d = NULL; (d = derived_next(q, d, CHANGE_CHANGES)) != NULL;)
    sheet_add(s, "| %m, %t | %s | below %s | %s | %s%s%s | %s | %s |\n", d->latex, d->title, d->verdict, d->size,
              or_dash(d->entry), d->printed, d->chain ? "; all printed: " : NULL, d->chain, d->corrected, d->where);
}

static void add_consequences(struct text *out, const struct audit_result *r) {
  const struct sheet s = {out, DIALECT_MARKDOWN};
  if (r->n_consequences == 0) return;
  text_printf(
      out,
      "## Consequences of each error\n\nIn each case the formula in question is taken as printed and all others as "
      "corrected%s.\n\n",
      r->consequences[0].n_derived
          ? ", and the results are evaluated at the times and the state of the true periodic solution. A "
            "result whose formula does not contain the error has the same value there; what becomes of it when the "
            "equations themselves are solved as printed is said where it was computed"
          : "");
  for (size_t i = 0; i < r->n_consequences; i++) {
    const struct consequence *q = &r->consequences[i];
    if (is_idle(q)) continue;
    text_printf(out, "### %s\n\n", q->failure);
    const struct finding *f = audit_result_finding(r, q->failure), *first = f ? failure_mended_with(r, f) : NULL;
    if (first) {
      text_printf(out, "As for %s, whose correction is the same.\n\n", first->id);
      continue;
    }
    if (q->solved) sheet_add(&s, "- the equations solved with it: %p\n", q->solved);
    add_ids(out, "- statements that no longer hold: ", &q->falls);
    add_ids(out, "- statements that use it and keep their verdict: ", &q->survives);
    add_ids(out, "- statements that use it, undecided: ", &q->open);
    derived_list(&s, q, CHANGE_AGREES, "- results that are unchanged: ", "\n");
    derived_list(&s, q, CHANGE_UNDECIDED, "- results left undecided: ", "\n");
    derived_list(&s, q, CHANGE_UNDEFINED, "- results that cannot be evaluated: ", "\n");
    if (q->n_derived && all_same(q))
      text_printf(out, "- results whose formulas do not contain it: all %d\n", q->n_derived);
    else
      derived_list(&s, q, CHANGE_SAME_FORMULA, "- results whose formulas do not contain it: ", "\n");
    add_changes(&s, q);
    text_add_char(out, '\n');
  }
  const char *sep = "Without any consequence for other statements or results: ";
  for (size_t i = 0; i < r->n_consequences; i++) {
    if (!is_idle(&r->consequences[i])) continue;
    text_printf(out, "%s%s", sep, r->consequences[i].failure);
    sep = ", ";
  }
  if (*sep == ',') text_add(out, ".\n\n");
}

/* --- The whole --- */

void report_markdown(struct text *out, const struct audit_result *r) {
  size_t begin = out->len;
  text_printf(out, "# Audit: %s\n\n", r->scene);
  if (r->title && *r->title) text_printf(out, "Data: %s.%s", r->title, r->data ? " " : "");
  audit_data(out, r);
  text_add(out, "\n\n");
  if (r->paper_source) text_printf(out, "%s\n\n", r->paper_source);
  add_roots(out, r);
  add_counts(out, r);
  add_severities(out, r);
  verdicts_say(out, r);
  text_add(out, ".\n\n");
  add_route_pairs(out, r, true);
  add_long_run_rows(out, r, true);
  add_section(out, r, "Not as recorded", finding_unexpected);
  add_words(out, r);
  add_section(out, r, "Statements that do not hold as printed", finding_fails);
  add_consequences(out, r);
  add_section(out, r, "Undecided", is_unknown);
  if (r->readings) report_readings_markdown(out, r->readings);
  add_overview(out, r);
  add_controls(out, r);
  add_routes(out, r);
  add_long_runs(out, r);
  if (r->n_values) {
    text_add(out, "## Values\n\n");
    markdown_head(out, "name|at|value");
  }
  for (size_t i = 0; i < r->n_values; i++) {
    const struct asked_value *v = &r->values[i];
    text_printf(out, "| `%s` | %s | %s |\n", v->name, v->at, v->value ? v->value : "not known");
  }
  if (r->n_values) text_add_char(out, '\n');
  add_precision(out, r);
  if (r->n_skipped) text_add(out, "## Left out\n\n");
  for (size_t i = 0; i < r->n_skipped; i++) text_printf(out, "- %s: %s\n", r->skipped[i].what, r->skipped[i].why);
  if (r->n_skipped) text_add_char(out, '\n');
  add_section(out, r, "The other claims", is_rest);
  escape_tags(out, begin);
}
