/* Questions of the reports to the record. */
#include <string.h>

#include "finding.h"
#include "sheet.h"

bool finding_fails(const struct finding *f) {
  return verdict_fails(f->verdict);
}

void evidence_extent(struct text *out, const struct evidence *e) {
  bool tried = e->trials >= 0 && strcmp(e->route, "diagnostic") != 0; /* which reads what is printed */
  if (tried) text_printf(out, ", %ld trial%s", e->trials, plural_s(e->trials));
  if (e->bits >= 0) text_printf(out, ", %ld bits", e->bits);
}

const struct evidence *failure_evidence(const struct finding *f) {
  for (int i = 0; i < f->n_evidence; i++)
    if (strcmp(f->evidence[i].result, "differs") == 0) return &f->evidence[i];
  return f->n_evidence ? &f->evidence[0] : NULL;
}

const struct finding *failure_mended_with(const struct audit_result *r, const struct finding *f) {
  for (const struct finding *g = r->findings; f->correction_latex && g < f; g++)
    if (finding_fails(g) && g->correction_latex && strcmp(g->correction_latex, f->correction_latex) == 0) return g;
  return NULL;
}

bool failure_is_number(const struct finding *f) {
  return f->correction_latex && failure_fault(f) == FAULT_NUMBER;
}

const char *root_value(const struct audit_result *r, const struct root_cause *root, int claim) {
  const struct finding *f = audit_result_finding(r, root->claims[claim]);
  return f && failure_is_number(f) ? f->correction_latex : NULL;
}

const struct root_cause *audit_root_of_numbers(const struct audit_result *r) {
  for (size_t i = 0; i < r->n_roots; i++)
    for (int k = 0; k < r->roots[i].n_claims; k++)
      if (root_value(r, &r->roots[i], k)) return &r->roots[i];
  return NULL;
}

enum fault failure_fault(const struct finding *f) {
  return f->fault ? (enum fault)word_find(f->fault, fault_name, N_FAULTS) : N_FAULTS;
}

const char *failure_words(const struct audit_result *r, const struct finding *f) {
  static const char *const words[N_FAULTS + 1] = {"a slip of notation; taken literally, the statement does not hold",
                                                  "the formula does not follow from those that it rests on",
                                                  "the paper's own equations give another value for its data",
                                                  "the assertion does not hold in general", "it does not hold"};
  enum fault is = failure_fault(f);
  for (int i = 0; is == FAULT_FORMULA && i < f->n_depends_on; i++) {
    const struct finding *on = audit_result_finding(r, f->depends_on[i]);
    if (on && on->verdict == VERDICT_REFUTED && !on->correction_latex)
      return "a formula that it rests on does not hold either";
  }
  return is == FAULT_NUMBER && r->data ? "it does not hold for the data of this scene" : words[is];
}

const char *failure_heading(const struct finding *f) {
  if (!finding_fails(f)) return "";
  if (f->verdict != VERDICT_CONDITIONAL) return "it does not hold that ";
  return failure_fault(f) == FAULT_NUMBER ? "it holds only to the digits printed that "
                                          : "it does not hold in general that ";
}

const char *correction_heading(const struct finding *f) {
  return f->correction_verdict == VERDICT_REFUTED ? "Does not hold either" : "Should read";
}

bool finding_restricts(const struct finding *o, const struct finding *f) {
  if (f->condition || !o->condition || o->n_depends_on != 1 || strcmp(o->depends_on[0], f->id) != 0) return false;
  return o->verdict == VERDICT_PROVED || o->verdict == VERDICT_SUPPORTED;
}

const char *finding_quote(const struct finding *f) {
  return f->quote_part ? f->quote_part : f->quote;
}

const char *finding_printed(const struct finding *f) {
  return f->printed_part ? f->printed_part : f->printed;
}

const char *finding_recheck(const struct finding *f) {
  return f->reproduce ? f->reproduce : "stickslip verify";
}

const char *finding_certified(const struct finding *f, const char *name) {
  for (int i = 0; i < f->certificate.n; i++)
    if (strcmp(f->certificate.at[i].name, name) == 0) return f->certificate.at[i].value;
  return NULL;
}

void finding_orbit(struct text *out, const struct finding *f) {
  static const char *const names[] = {"e_1", "e_2", "z_10", "z_20", "t_a", "t_b", "t_c", "t_d"};
  enum { N = sizeof names / sizeof *names };
  for (int i = 0; i < N; i++)
    if (!finding_certified(f, names[i])) return;
  for (int i = 0; i < N; i++) text_printf(out, "%s%s = %s", i ? ", " : "", names[i], finding_certified(f, names[i]));
}

static void add_label(const struct sheet *s, const char *word) {
  sheet_add(s, s->dialect == DIALECT_HTML ? " <em>%s:</em> " : " *%s:* ", word);
}

void root_say(const struct sheet *s, const struct audit_result *r, const struct root_cause *root) {
  const char *more[][2] = {{"Consequence", root->severity == SEVERITY_NOTATION ? NULL : root->consequence},
                           {"To see it", root->by_hand}};
  sheet_add(s, "%t%.", root->wrong);
  add_label(s, severity_correction[root->severity]);
  sheet_values(s, r, root);
  sheet_add(s, "%t%.", root->correct);
  for (int i = 0; i < 2; i++) {
    if (!more[i][1]) continue;
    add_label(s, more[i][0]);
    sheet_add(s, "%t%.", more[i][1]);
  }
}

const struct derived *derived_next(const struct consequence *q, const struct derived *last, enum change change) {
  for (int i = last ? (int)(last - q->derived) + 1 : 0; i < q->n_derived; i++)
    if (q->derived[i].change == change) return &q->derived[i];
  return NULL;
}

void derived_list(const struct sheet *s, const struct consequence *q, enum change change, const char *begin,
                  const char *end) {
  const char *before = begin;
  for (const struct derived *d = NULL; (d = derived_next(q, d, change)) != NULL; before = ", ") {
    sheet_add(s, "%s%m", before, d->latex);
    if (change != CHANGE_SAME_FORMULA) sheet_add(s, " (%e)", d->verdict);
  }
  if (before != begin) text_add(s->out, end);
}

const char *failure_size(const struct audit_result *r, const struct finding *f) {
  return audit_result_consequence(r, f->id) ? f->size : f->effect;
}

const char *audit_method(const struct audit_result *r) {
  return r->model ? "The formulas and statements of the paper were compared, one by one, with its equations of motion "
                    "(1) and Coulomb's law (2): by exact algebra, by computations with rigorous error bounds and by "
                    "numerical integration."
                  : "The formulas of the paper were compared with each other, one by one: by exact algebra, and by "
                    "computations with rigorous error bounds at values of its own symbols.";
}

void audit_data(struct text *out, const struct audit_result *r) {
  if (r->data)
    text_printf(out,
                "The data, and any printed numbers, are those of this scene, %s, and not those of the paper's example: "
                "what it says of that is asked of them among the checks.",
                r->data);
}

void audit_recheck(struct text *out, const struct audit_result *r) {
  const char *one = r->n_findings ? finding_recheck(&r->findings[0]) : "stickslip verify", *end = NULL;
  for (const char *p = one; (p = strstr(p, " --only ")) != NULL; p++) end = p; /* the last: a path may hold another */
  text_add_n(out, one, end ? (size_t)(end - one) : strlen(one));
}

size_t controls_noticed(const struct audit_result *r) {
  size_t n = 0;
  for (size_t i = 0; i < r->n_controls; i++) n += r->controls[i].noticed;
  return n;
}

const char *const severity_heading[N_SEVERITIES] = {"Errors of substance", "Remarks",
                                                    "Misprints and slips of notation"};
const char *const severity_correction[N_SEVERITIES] = {"Should read", "Suggested", "Should read"};
const char *const severity_words[N_SEVERITIES][2] = {
    {"error of substance", "errors of substance"}, {"remark", "remarks"}, {"slip of notation", "slips of notation"}};

void verdicts_say(struct text *out, const struct audit_result *r) {
  long count[N_VERDICTS], of_numbers = 0, of_notation = 0;
  const struct root_cause *numbers = audit_root_of_numbers(r);
  long asserted = audit_result_count(count, r, OF_PAPER) - count[VERDICT_DEFINITION], proved = count[VERDICT_PROVED];
  if (asserted == 0) {
    text_add(out, "No statement of the paper that asserts something was examined");
    return;
  }
  text_printf(out, "Of the %ld statement%s of the paper that assert%s something, %ld %s been proved", asserted,
              plural_s(asserted), asserted == 1 ? "s" : "", proved, proved == 1 ? "has" : "have");
  for (size_t i = 0; i < r->n_roots; i++) {
    long refuted = 0;
    for (int k = 0; k < r->roots[i].n_claims; k++) {
      const struct finding *f = audit_result_finding(r, r->roots[i].claims[k]);
      refuted += f && f->of == OF_PAPER && f->verdict == VERDICT_REFUTED;
    }
    if (&r->roots[i] == numbers) of_numbers = refuted;
    if (r->roots[i].severity == SEVERITY_NOTATION) of_notation += refuted;
  }
  long conditional = count[VERDICT_CONDITIONAL], fail = count[VERDICT_REFUTED];
  if (conditional) text_printf(out, ", %ld hold%s under a condition", conditional, conditional == 1 ? "s" : "");
  if (fail) text_printf(out, ", %ld do%s not hold as printed", fail, fail == 1 ? "es" : "");
  if (of_numbers) text_printf(out, ", %ld of them about the numbers of the example", of_numbers);
  if (of_notation && of_notation == fail)
    text_add(out, fail == 1 ? ", because of a misprint or slip of notation"
                            : ", all because of a misprint or slip of notation");
  else if (of_notation)
    text_printf(out, "%s%ld %sbecause of a misprint or slip of notation", of_numbers ? " and " : ", ", of_notation,
                of_numbers ? "" : "of them ");
  if (count[VERDICT_SUPPORTED]) text_printf(out, "; %ld could be confirmed only numerically", count[VERDICT_SUPPORTED]);
  if (count[VERDICT_SKIPPED]) text_printf(out, "; %ld cannot be judged with these data", count[VERDICT_SKIPPED]);
  if (count[VERDICT_UNKNOWN]) text_printf(out, "; %ld could not be decided", count[VERDICT_UNKNOWN]);
}
