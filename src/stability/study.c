/* The study as a whole: the formulas of a layer, each in each region that says something of its inputs, by processes;
   then what they found in words, and maps of the worst. */
#include <stdlib.h>

#include "base/crew.h"
#include "stability_impl.h"

/* --- The formulas asked for --- */

static bool selected(const struct digits_formula *f, const struct stability_options *opt) {
  bool yes = opt->n_only == 0 && !(opt->quick && digits_is_entry(f));
  for (int i = 0; i < opt->n_only; i++) yes = yes || digits_selected(f, opt->only[i]);
  return yes;
}

static bool check_operands(const struct digits_set *s, const struct stability_options *opt, struct diag *d) {
  for (int i = 0; i < opt->n_only; i++) {
    bool any = false;
    for (size_t k = 0; k < s->n; k++) any = any || digits_selected(&s->formula[k], opt->only[i]);
    if (any) continue;
    return diag_set(d, "error: no formula \"%.200s\" that computes something", opt->only[i]);
  }
  return true;
}

static void keep_selected(struct digits_pairs *p, const struct stability_options *opt) {
  size_t n = 0;
  for (size_t i = 0; i < p->n; i++)
    if (selected(p->pair[i].corrected, opt)) p->pair[n++] = p->pair[i];
  p->n = n;
}

bool digits_study_open(struct digits_study *st, const struct model *m, const struct stability_options *opt,
                       struct diag *d) {
  *st = (struct digits_study){
      .model = m, .effort = opt->quick ? (struct digits_effort){3, 6, 1} : (struct digits_effort){24, 160, 12}};
  bool ok = digits_set_make(&st->set, m, opt->layer, d) && check_operands(&st->set, opt, d);
  st->have_other = opt->after >= 0;
  if (st->have_other) ok = digits_set_make(&st->other, m, (enum layer)opt->after, ok ? d : NULL) && ok;
  st->have_proofs = ok && opt->after == LAYER_STABLE;
  if (st->have_proofs) ok = stable_prove(&st->proofs, m, false, d);
  st->have_pairs = ok && st->have_proofs;
  if (st->have_pairs) ok = digits_pairs_make(&st->pairs, m, &st->proofs, d);
  if (ok && st->have_pairs) keep_selected(&st->pairs, opt);
  st->formula = ss_malloc((st->set.n + 1) * sizeof *st->formula);
  st->after = ss_malloc((st->set.n + 1) * sizeof *st->after);
  st->rounded = ss_malloc((st->set.n + 1) * sizeof *st->rounded);
  for (size_t i = 0; ok && i < st->set.n; i++) {
    if (!selected(&st->set.formula[i], opt)) continue;
    st->formula[st->n] = &st->set.formula[i];
    st->after[st->n] = st->have_other ? digits_other(&st->other, st->formula[st->n]) : NULL;
    if (st->after[st->n]) ok = digits_formula_rounded(&st->rounded[st->n], &st->other, st->after[st->n], d);
    st->n += ok;
  }
  return ok;
}

void digits_study_close(struct digits_study *st) {
  for (size_t i = 0; i < st->n; i++)
    if (st->after[i]) digits_formula_clear(&st->rounded[i]);
  digits_set_clear(&st->set);
  if (st->have_other) digits_set_clear(&st->other);
  if (st->have_pairs) digits_pairs_clear(&st->pairs);
  if (st->have_proofs) stable_proofs_clear(&st->proofs);
  free(st->formula);
  free(st->after);
  free(st->rounded);
}

/* --- Searching --- */

static void search_item(void *result, size_t i, void *arg) {
  struct digits_study *st = arg;
  size_t f = i / (size_t)n_digits_regions, region = i % (size_t)n_digits_regions;
  struct digits_formula *after = st->after[f];
  digits_search(result, st->formula[f], &st->set, after, after ? &st->rounded[f] : NULL, (int)region, st->effort);
}

/* The worst of all regions, or the first that comes within half a digit of it; of failures, that at the least extreme
   inputs.  Row i is the one that found[i] became. */
static void rate(struct stability_formula *f, const struct digits_formula *of, const struct stability_row *row, long i,
                 const struct digits_found *found) {
  f->points += row[i].points;
  f->zero = f->zero || found[i].zero > 0;
  if (row[i].found && (f->worst < 0 || row[i].excess > row[f->worst].excess + 0.5)) f->worst = i;
  if (!row[i].failures) return;
  double extreme = digits_extreme(of, found[i].failure_x);
  if (f->worst_failure < 0 || extreme < digits_extreme(of, found[f->worst_failure].failure_x)) f->worst_failure = i;
}

static void gather(struct digits_study *st, const struct digits_found *found) {
  struct stability_result *r = st->out;
  r->region = digits_region;
  r->n_regions = n_digits_regions;
  r->n_formulas = (int)st->n;
  r->n_rows = (long)st->n * n_digits_regions;
  r->formula = arena_alloc(&r->arena, (st->n + 1) * sizeof *r->formula);
  r->row = arena_alloc(&r->arena, ((size_t)r->n_rows + 1) * sizeof *r->row);
  for (size_t i = 0; i < st->n; i++) {
    digits_describe_formula(&r->formula[i], st, st->formula[i]);
    if (st->after[i] && st->have_proofs) digits_describe_replacement(&r->formula[i], st, st->after[i]);
    for (int k = 0; k < n_digits_regions; k++) {
      long at = (long)i * n_digits_regions + k;
      digits_describe_row(&r->row[at], st, (int)i, k, &found[at]);
      rate(&r->formula[i], st->formula[i], r->row, at, found);
      r->conditions += found[at].slopes;
      r->condition_differs += found[at].slopes_differ;
      for (int a = 0; a < N_LOSS_BINS; a++)
        for (int b = 0; b < N_LOSS_BINS; b++) r->confusion[a][b] += found[at].confusion[a][b];
    }
    r->formula[i].zero = r->formula[i].zero && r->formula[i].points == 0;
  }
}

/* --- The stable forms beside the corrected ones --- */

static void agree_item(void *result, size_t i, void *arg) {
  struct digits_study *st = arg;
  digits_agree(result, &st->pairs, i, st->effort.agreement);
}

static bool hold_pairs(struct digits_study *st, const struct stability_options *opt, struct crew_tally *tally,
                       struct diag *d) {
  struct stability_result *r = st->out;
  size_t n = st->have_pairs ? st->pairs.n : 0;
  if (n == 0) return true;
  FREED struct digits_agreement *found = ss_malloc(n * sizeof *found);
  bool ok = crew_results(found, sizeof *found, n, opt->jobs, agree_item, st, tally, d);
  r->pair = arena_alloc(&r->arena, n * sizeof *r->pair);
  for (size_t i = 0; ok && i < n; i++) digits_describe_pair(&r->pair[i], st, i, &found[i]);
  r->n_pairs = ok ? (int)n : 0;
  return ok;
}

/* --- All --- */

/* Every formula was studied, and a region has seen none of them: what the report says of it would be said of
   nothing. */
static bool check_regions(const struct stability_result *r, struct diag *d) {
  int k = stability_empty_region(r);
  if (k >= 0) diag_set(d, "error: no formula has a value at any point of the region %s", r->region[k].id);
  return k < 0;
}

bool audit_stability(struct stability_result *out, const struct model *m, const struct stability_options *opt,
                     struct diag *d) {
  OWNED_CLEARED(digits_study_close) struct digits_study st;
  bool ok = digits_study_open(&st, m, opt, d);
  st.out = out;
  out->layer = layer_name[opt->layer];
  out->after = opt->after >= 0 ? layer_name[opt->after] : NULL;
  out->sources = arena_strdup(&out->arena, m->options);
  out->quick = opt->quick;
  size_t n = st.n * (size_t)n_digits_regions;
  struct crew_tally tally = {.tell = opt->progress,
                             .of = n + (st.have_pairs ? st.pairs.n : 0) + (opt->quick ? 0 : MAPS * STABILITY_MAP)};
  FREED struct digits_found *found = ok ? ss_malloc(n * sizeof *found) : NULL;
  ok = ok && crew_results(found, sizeof *found, n, opt->jobs, search_item, &st, &tally, d);
  if (ok) gather(&st, found);
  ok = ok && (opt->n_only > 0 || check_regions(out, d)) && hold_pairs(&st, opt, &tally, d);
  return ok && (opt->quick || digits_draw_maps(&st, found, opt, &tally, d));
}
