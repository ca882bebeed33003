/* The verdicts counted, and would the audit have noticed?  What was made wrong on purpose and found: statements in this
   run, and damages of the formulas and of what stands beside them in the study whose file stands beside the report; and
   which claims one route alone has judged. */
#include <string.h>

#include "finding.h"
#include "page.h"

static const char *const meaning[N_VERDICTS] = {
    [VERDICT_PROVED] = "by exact algebra, or by rigorous error bounds on the whole domain",
    [VERDICT_CONDITIONAL] = "does not hold in general, proved under the condition named",
    [VERDICT_SUPPORTED] = "confirmed at every point tried, by at least two independent routes; not a proof",
    [VERDICT_REFUTED] =
        "does not hold as printed; a certificate says where the two sides differ, or why the formula cannot be right",
    [VERDICT_UNKNOWN] = "undecided, for the reason given with the claim",
    [VERDICT_SKIPPED] = "cannot be judged with these data, for the reason given",
    [VERDICT_DEFINITION] = "asserts nothing that could be judged"};

static const char counts[] = "verdict|statements of the paper:|checks of the suite:|meaning";

static void add_counts(const struct page *p) {
  long count[N_VERDICTS], checks[N_VERDICTS], of_paper = audit_result_count(count, p->r, OF_PAPER);
  long of_suite = audit_result_count(checks, p->r, OF_SUITE);
  page_begin_table(p, "stack counts", "The verdicts, and what each word means", counts);
  for (int i = 0; i <= N_VERDICTS; i++) {
    bool all = i == N_VERDICTS;
    char paper[24], suite[24];
    page_row(p, counts, PAGE_ROW "%s%v</th>|%s|%s|%s", all ? "all" : NULL, all ? NULL : verdict_name[i],
             page_number(paper, all ? of_paper : count[i]), page_number(suite, all ? of_suite : checks[i]),
             all ? NULL : meaning[i]);
  }
  page_end_table(p);
}

/* Whether the claim could have failed by it. */
static bool decides(const struct evidence *e) {
  return strcmp(e->result, "agrees") == 0 || strcmp(e->result, "differs") == 0 || strcmp(e->result, "proved") == 0;
}

/* The route by which all that decides was found, or NULL. */
static const char *only_route(const struct finding *f) {
  const char *only = NULL;
  for (int i = 0; i < f->n_evidence; i++) {
    if (!decides(&f->evidence[i])) continue;
    if (only && strcmp(only, f->evidence[i].route) != 0) return NULL;
    only = f->evidence[i].route;
  }
  return only;
}

static bool is_judged(const struct finding *f) {
  return f->verdict != VERDICT_DEFINITION && f->verdict != VERDICT_UNKNOWN && f->verdict != VERDICT_SKIPPED;
}

static bool has_control(const struct audit_result *r, const char *id) {
  for (size_t i = 0; i < r->n_controls; i++)
    if (r->controls[i].claim && strcmp(r->controls[i].claim, id) == 0) return true;
  return false;
}

static void add_controls(const struct page *p) {
  const struct audit_result *r = p->r;
  size_t judged = 0, damaged = 0;
  for (size_t i = 0; i < r->n_findings; i++) {
    judged += is_judged(&r->findings[i]);
    damaged += is_judged(&r->findings[i]) && has_control(r, r->findings[i].id);
  }
  if (r->n_controls)
    text_printf(p->out,
                "<li>Of %zu controls, statements made wrong on purpose, <strong>%zu were "
                "noticed</strong> in this run; %zu of the %zu claims judged have a control of their own.</li>\n",
                r->n_controls, controls_noticed(r), damaged, judged);
  else
    text_add(p->out, "<li>No statements made wrong on purpose were tried in this run.</li>\n");
}

/* The first claim at or after i that this route alone has judged. */
static size_t next_alone(const struct audit_result *r, size_t i, const char *route) {
  for (; i < r->n_findings; i++) {
    const char *only = is_judged(&r->findings[i]) ? only_route(&r->findings[i]) : NULL;
    if (only && (!route || strcmp(only, route) == 0)) break;
  }
  return i;
}

/* Claims without a second route, by the route that they have. */
static void add_alone(const struct page *p) {
  const struct audit_result *r = p->r;
  size_t alone = 0, judged = 0;
  for (size_t i = 0; i < r->n_findings; i++) {
    judged += is_judged(&r->findings[i]);
    alone += next_alone(r, i, NULL) == i;
  }
  text_printf(p->out, "<li>Two routes or more decided %zu of the %zu claim%s judged", judged - alone, judged,
              plural_s((long)judged));
  if (alone) text_printf(p->out, ", and one alone %zu", alone);
  const char *sep = ": ";
  for (size_t i = next_alone(r, 0, NULL); i < r->n_findings; i = next_alone(r, i + 1, NULL)) {
    const char *route = only_route(&r->findings[i]);
    if (next_alone(r, 0, route) < i) continue;
    page_add(p, "%s%e", sep, route);
    const char *before = " (";
    for (size_t k = i; k < r->n_findings; k = next_alone(r, k + 1, route)) {
      text_add(p->out, before);
      page_claim(p, r->findings[k].id);
      before = ", ";
    }
    text_add_char(p->out, ')');
    sep = "; ";
  }
  text_add(p->out, ".</li>\n");
}

static void add_mutation(const struct page *p) {
  const struct mutation_score *s = p->r->mutation;
  if (!s) return;
  text_printf(
      p->out,
      "<li>As a test, one symbol of a formula was altered in every way, and one item of what stands beside the "
      "formulas "
      "as by a mistake of transcription (TeX, quotations, printed numbers, the lines of claims and controls, titles). "
      "Of <strong>%ld alterations that change a meaning</strong>, %ld of them in formulas, <strong>%ld were "
      "noticed</strong> (<a href=\"../mutation/mutation.md\">table by class</a>). Not counted are %ld that are proved, "
      "or known by a rule, to mean the same; %ld that make no difference on any motion",
      s->counted, s->formulas, s->noticed, s->equivalent, s->on_motions);
  if (s->needs_text) text_printf(p->out, "; %ld that only the paper's text can tell", s->needs_text);
  text_printf(
      p->out,
      "; and %ld of the corrections, which are not the paper's and are counted separately. The test is repeated by "
      "<code>stickslip mutate --count all</code>.</li>\n",
      s->errata);
}

static void add_pairs(const struct page *p) {
  const struct audit_result *r = p->r;
  size_t within = 0;
  for (size_t i = 0; i < r->n_pairs; i++) within += r->pairs[i].within;
  if (!r->n_pairs) return;
  text_printf(p->out, "<li>Of %zu pairs of routes to the same quantity, %zu agree within their stated accuracy.</li>\n",
              r->n_pairs, within);
}

void page_power(const struct page *p) {
  long unexpected = audit_result_unexpected(p->r);
  size_t recorded = 0;
  for (size_t i = 0; i < p->r->n_findings; i++) recorded += p->r->findings[i].recorded != N_VERDICTS;
  page_begin_fold(p, "power", "The verdicts, and how reliable they are");
  add_counts(p);
  text_add(p->out, "<ul>\n");
  add_controls(p);
  add_mutation(p);
  add_alone(p);
  add_pairs(p);
  if (unexpected)
    text_printf(p->out, "<li><strong>%ld results are not as recorded.</strong></li>\n", unexpected);
  else if (recorded == p->r->n_findings)
    text_add(p->out, "<li>Every verdict is the one on record for the claim.</li>\n");
  else
    text_printf(
        p->out,
        "<li>%zu of the %zu verdicts are on record, and come out as recorded; the others have no record for these "
        "data.</li>\n",
        recorded, p->r->n_findings);
  text_add(
      p->out,
      "<li>The controls one by one, what every two routes share and by how much they differ, runs over many periods "
      "and the precision that was needed stand in <a href=\"audit.md\">audit.md</a>.</li>\n</ul>\n</details>\n");
}
