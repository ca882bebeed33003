/* What a search has found, in words and in digits: a formula and a row of the result record. */
#include <math.h>

#include "stability_impl.h"

static const char *kept_str(struct stability_result *r, const char *s) {
  return arena_strdup(&r->arena, s);
}

static const char *node_text(struct digits_study *st, const struct digits_formula *f, slong node, bool whole) {
  if (f->kernel) return kept_str(st->out, f->record);
  struct text t = {0};
  digits_print_node(&t, &st->set, f, node, whole);
  return text_take(&st->out->arena, &t);
}

static const char *record_text(struct digits_study *st, const struct digits_formula *f, slong node) {
  const char *id = digits_record_of(&st->set, f, node);
  return id ? kept_str(st->out, id) : NULL;
}

static const char *point_text(struct digits_study *st, const struct digits_formula *f, const double *x) {
  struct text t = {0};
  digits_print_point(&t, f, x);
  return text_take(&st->out->arena, &t);
}

void digits_describe_formula(struct stability_formula *z, struct digits_study *st, const struct digits_formula *f) {
  *z = (struct stability_formula){.id = kept_str(st->out, f->id),
                                  .also = kept_str(st->out, f->also),
                                  .record = kept_str(st->out, f->record),
                                  .equation = kept_str(st->out, f->equation),
                                  .text = kept_str(st->out, f->text),
                                  .kernel = f->kernel != NULL,
                                  .worst = -1,
                                  .worst_failure = -1};
}

void digits_describe_replacement(struct stability_formula *z, struct digits_study *st,
                                 const struct digits_formula *after) {
  struct text t = {0};
  z->proved = digits_replacement(&t, st->model, &st->proofs, after);
  if (t.len) z->replacement = text_take(&st->out->arena, &t);
}

static void describe_cause(struct stability_row *z, struct digits_study *st, const struct digits_formula *f,
                           const struct digits_found *found) {
  z->cause = found->why.cause;
  z->node_grows = found->why.grows * log10(2);
  z->node = node_text(st, f, found->why.node, false);
  z->source = record_text(st, f, found->why.node);
  if (f->kernel) return;
  const struct tape_instr *in = &f->tape.code[found->why.node];
  if (in->op == TAPE_CONST || in->op == TAPE_INPUT || in->op == TAPE_ROOT) return;
  z->left = node_text(st, f, in->a, true);
  if (in->b >= 0) z->right = node_text(st, f, in->b, true);
}

void digits_describe_pair(struct stability_pair *z, struct digits_study *st, size_t pair,
                          const struct digits_agreement *found) {
  const struct digits_formula *f = st->pairs.pair[pair].corrected;
  bool fails = found->lost + found->differ > 0;
  *z = (struct stability_pair){.formula = kept_str(st->out, f->id),
                               .points = found->points,
                               .undecided = found->undecided,
                               .lost = found->lost,
                               .differ = found->differ,
                               .region = fails ? digits_region[found->region].id : NULL,
                               .witness = fails ? point_text(st, f, found->x) : NULL};
}

void digits_describe_row(struct stability_row *z, struct digits_study *st, int formula, int region,
                         const struct digits_found *found) {
  const struct digits_formula *f = st->formula[formula];
  *z = (struct stability_row){.formula = formula,
                              .region = region,
                              .points = found->points,
                              .outside = found->outside,
                              .undecided = found->undecided + found->zero,
                              .failures = found->failures,
                              .found = found->found,
                              .after = NAN,
                              .failure_size = NAN,
                              .after_most = found->after_found ? found->after_worst.formula : (double)NAN,
                              .after_witness = found->after_found ? point_text(st, f, found->after_x) : NULL,
                              .after_failures = found->after_failures,
                              .after_short = found->after_short,
                              .after_rounded = found->after_rounded};
  if (found->found) {
    z->error = found->loss.error * log10(2);
    z->observed = found->loss.observed;
    z->problem = found->loss.problem;
    z->formula_lost = found->loss.formula;
    z->excess = found->loss.excess;
    z->sign_lost = found->loss.sign_lost;
    z->predicted = fmin(STABILITY_DIGITS, fmax(0, found->loss.predicted * log10(2)));
    z->witness = point_text(st, f, found->x);
    if (found->after.kind == DIGITS_LOST) z->after = found->after.formula;
    describe_cause(z, st, f, found);
  }
  z->at_fault = stability_at_fault(z, f->kernel != NULL);
  if (!found->failed) return;
  z->failure = found->failure.cause;
  z->failure_node = node_text(st, f, found->failure.node, false);
  z->failure_source = record_text(st, f, found->failure.node);
  z->failure_size = found->failure_size * log10(2);
  z->failure_witness = point_text(st, f, found->failure_x);
}
