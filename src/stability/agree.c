/* Has a stable form the corrected form's value wherever that has one?  Both in balls at the exact doubles of the
   extreme regions, at precisions that rise until the values are known: a point where the corrected form has a finite
   value and the stable one none is one that the algebra of a proof passes over. */
#include <stdlib.h>
#include <string.h>

#include "stability_impl.h"

/* Values are known to so many bits; precisions from the first to the last, quadrupled. */
enum { KNOWN_BITS = 32, AGREE_FIRST = 256, AGREE_LAST = 4096 };

/* --- Pairs --- */

static void add_pair(struct digits_pairs *p, struct digits_formula *corrected, struct digits_formula *stable) {
  *SS_PUSH(p->pair, p->n, p->cap) = (struct digits_pair){corrected, stable};
}

static void pair_by_name(struct digits_pairs *p) {
  for (size_t i = 0; i < p->corrected.n; i++) {
    struct digits_formula *f = &p->corrected.formula[i];
    struct digits_formula *g = digits_is_entry(f) ? NULL : digits_other(&p->stable, f);
    if (g) add_pair(p, f, g);
  }
}

/* Parts that the corrected layer has no name for, only what they equal. */
static bool pair_parts(struct digits_pairs *p, const struct stable_proofs *proofs, struct diag *d) {
  p->part = ss_malloc((2 * proofs->n + 1) * sizeof *p->part);
  for (size_t i = 0; i < proofs->n; i++) {
    const struct stable_proof *of = &proofs->item[i];
    if (!of->equals) continue;
    struct digits_formula *pair = &p->part[p->n_parts];
    if (!digits_formula_of(&pair[0], &p->corrected, of->name, of->equals, of->section, d)) return false;
    p->n_parts++;
    if (!digits_formula_of(&pair[1], &p->stable, of->name, of->name, of->section, d)) return false;
    p->n_parts++;
    add_pair(p, &pair[0], &pair[1]);
  }
  return true;
}

bool digits_pairs_make(struct digits_pairs *p, const struct model *m, const struct stable_proofs *proofs,
                       struct diag *d) {
  *p = (struct digits_pairs){.n = 0};
  bool ok = digits_set_make(&p->corrected, m, LAYER_CORRECTED, d);
  ok = digits_set_make(&p->stable, m, LAYER_STABLE, ok ? d : NULL) && ok;
  if (ok) pair_by_name(p);
  return ok && pair_parts(p, proofs, d);
}

void digits_pairs_clear(struct digits_pairs *p) {
  for (size_t i = 0; i < p->n_parts; i++) digits_formula_clear(&p->part[i]);
  free(p->part);
  free(p->pair);
  digits_set_clear(&p->corrected);
  digits_set_clear(&p->stable);
}

/* --- One point --- */

/* What is known of one entry. */
enum agreement { OPEN, SAME, NO_VALUE, OTHER_VALUE, OUTSIDE };

static bool is_known(arb_srcptr x) {
  return arb_rel_accuracy_bits(x) > KNOWN_BITS || arb_is_zero(x);
}

/* last: there is no higher precision. */
static enum agreement compare(arb_srcptr corrected, int corrected_status, arb_srcptr stable, int stable_status,
                              bool last) {
  bool there = corrected_status == SS_OK && arb_is_finite(corrected);
  bool here = stable_status == SS_OK && arb_is_finite(stable);
  if (!there) return last ? OUTSIDE : OPEN;
  if (!here) return last ? NO_VALUE : OPEN;
  if (!arb_overlaps(corrected, stable)) return OTHER_VALUE;
  return is_known(corrected) && is_known(stable) ? SAME : OPEN;
}

static void run_balls(struct digits_bench *w, const double *x, slong prec) {
  for (slong k = 0; k < w->f->tape.n_inputs; k++) arb_set_d(num_vec_at(&w->bx, k), x[k]);
  w->b.ctx.prec = w->bx.ctx.prec = prec;
  tape_eval(&w->b, w->b_flags, &w->f->tape, &w->bx);
}

/* The worst of the entries, in the order of enum agreement. */
static enum agreement agree_at(struct digits_bench *f, struct digits_bench *g, const double *x, const double *y) {
  enum agreement all = OPEN;
  for (slong prec = AGREE_FIRST; all == OPEN && prec <= AGREE_LAST; prec *= 4) {
    run_balls(f, x, prec);
    run_balls(g, y, prec);
    bool open = false;
    enum agreement worst = SAME;
    for (slong k = 0; k < f->f->n; k++) {
      slong i = f->f->out[k], j = g->f->out[k];
      enum agreement a =
          compare(num_vec_at(&f->b, i), f->b_flags[i], num_vec_at(&g->b, j), g->b_flags[j], 4 * prec > AGREE_LAST);
      open = open || a == OPEN;
      if (a != OPEN && a > worst) worst = a;
    }
    if (!open || worst == OTHER_VALUE) all = worst;
  }
  return all;
}

static void count(struct digits_agreement *out, enum agreement a, int region, const double *x) {
  out->points += a != OUTSIDE;
  out->outside += a == OUTSIDE;
  out->undecided += a == OPEN;
  if (a != NO_VALUE && a != OTHER_VALUE) return;
  if (out->lost + out->differ == 0) {
    out->region = region;
    memcpy(out->x, x, sizeof out->x);
  }
  out->lost += a == NO_VALUE;
  out->differ += a == OTHER_VALUE;
}

void digits_agree(struct digits_agreement *out, struct digits_pairs *p, size_t pair, int samples) {
  struct digits_formula *f = p->pair[pair].corrected, *g = p->pair[pair].stable;
  OWNED(digits_bench) w, v;
  double x[DIGITS_INPUTS] = {0}, y[DIGITS_INPUTS], u[DIGITS_COORDINATES];
  uint64_t random = 1;
  *out = (struct digits_agreement){.points = 0};
  for (int k = 0; k < DIGITS_INPUTS; k++) y[k] = 0.5; /* an input that the corrected form does without is ordinary */
  digits_bench_init(&w, f);
  digits_bench_init(&v, g);
  for (int region = 0; region < n_digits_regions; region++) {
    struct digits_place *place = digits_place_new(region, &w, &p->corrected);
    for (int i = 0; place && i < samples * digits_region_width(region); i++) {
      for (int k = 0; k < DIGITS_COORDINATES; k++) u[k] = random_unit(&random);
      if (!digits_point(x, place, u)) continue;
      digits_inputs(y, g, f, x);
      count(out, agree_at(&w, &v, x, y), region, x);
    }
    digits_place_free(place);
  }
}
