/* Printed numbers as brackets, the points they stand for, and the orbit they are nearest to.
   A printed decimal is read in two ways, rounded and cut off; each is a bracket one unit of the last digit wide. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "audit_impl.h"
#include "stickslip/given.h"

const char *const reading_name[N_READINGS] = {"rounded", "truncated"};

/* The ends of the bracket of a decimal under a reading. */
static void bracket(arb_t lo, arb_t hi, const struct printed_number *p, enum reading how) {
  fmpq_t below, above; /* distances of the ends from the printed value, in units */
  fmpq_init(below);
  fmpq_init(above);
  bool negative = p->decimal[0] == '-';
  fmpq_set_si(below, how == READ_ROUNDED ? 1 : negative ? 2 : 0, 2);
  fmpq_set_si(above, how == READ_ROUNDED ? 1 : negative ? 0 : 2, 2);
  fmpq_mul(below, below, &p->unit);
  fmpq_mul(above, above, &p->unit);
  fmpq_sub(below, &p->value, below);
  fmpq_add(above, &p->value, above);
  arb_set_fmpq(lo, below, LAST_PREC);
  arb_set_fmpq(hi, above, LAST_PREC);
  fmpq_clear(above);
  fmpq_clear(below);
}

static truth in_bracket(const arb_t x, const struct printed_number *p, enum reading how) {
  arb_t lo, hi;
  arb_init(lo);
  arb_init(hi);
  bracket(lo, hi, p, how);
  truth t = TRUTH_UNKNOWN;
  if (arb_ge(x, lo) && arb_le(x, hi))
    t = TRUTH_TRUE;
  else if (arb_lt(x, lo) || arb_gt(x, hi))
    t = TRUTH_FALSE;
  arb_clear(hi);
  arb_clear(lo);
  return t;
}

/* TRUE under some reading, FALSE under none; *how is the reading. */
truth printed_fits(const arb_t x, const struct printed_number *p, enum reading *how) {
  truth t = TRUTH_FALSE;
  for (int r = 0; r < N_READINGS && t != TRUTH_TRUE; r++) {
    t = truth_or(t, in_bracket(x, p, (enum reading)r));
    *how = (enum reading)r;
  }
  return t;
}

/* A ball over both readings of a printed decimal. */
void printed_ball(arb_t x, const struct printed_number *p) {
  arb_t lo, hi;
  arb_init(lo);
  arb_init(hi);
  arb_zero(x);
  for (int r = 0; r < N_READINGS; r++) {
    bracket(lo, hi, p, (enum reading)r);
    arb_union(lo, lo, hi, LAST_PREC);
    if (r == 0)
      arb_set(x, lo);
    else
      arb_union(x, x, lo, LAST_PREC);
  }
  arb_clear(hi);
  arb_clear(lo);
}

/* A control moves the printed decimal by some units of its last digit. */
bool printed_replace(struct printed_number *own, const struct printed_number **p, const struct claim *c) {
  const char *shift = claim_get(c, "shift");
  if (!shift || !*p) return false;
  fmpq_init(&own->value);
  fmpq_init(&own->unit);
  own->name = (*p)->name;
  own->decimal = (*p)->decimal;
  fmpq_set(&own->unit, &(*p)->unit);
  fmpq_set_si(&own->value, strtol(shift, NULL, 10), 1);
  fmpq_mul(&own->value, &own->value, &own->unit);
  fmpq_add(&own->value, &own->value, &(*p)->value);
  *p = own;
  return true;
}

static void set_scene_params(struct point *p, const struct scene *s) {
  for (int k = 0; k < N_SCENE_PARAMS; k++) fmpq_set(&p->q[Q_CHI + k], &s->value[k]);
}

bool printed_point(struct point *out, const struct scene *s) {
  static const struct {
    const char *name;
    int q;
  } names[] = {{"z10", Q_Z1}, {"z20", Q_Z2}, {"t_a", Q_TA}, {"t_b", Q_TB}, {"t_c", Q_TC}, {"t_d", Q_TD}};
  out->kind = POINT_PRINTED;
  if (!scene_has_forces(s)) return false;
  set_scene_params(out, s);
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    const struct printed_number *p = scene_printed(s, names[i].name);
    if (!p) return false;
    fmpq_set(&out->q[names[i].q], &p->value);
  }
  return true;
}

/* Relative squared distance of an orbit from the printed numbers. */
static double distance(const struct dyn_orbit *o, const struct scene *s) {
  const struct {
    const char *name;
    arb_srcptr value;
  } of[] = {{"z10", o->z10}, {"z20", o->z20}, {"t_a", o->t[0]}, {"t_b", o->t[1]}, {"t_c", o->t[2]}, {"t_d", o->t[3]}};
  double sum = 0;
  for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
    const struct printed_number *p = scene_printed(s, of[i].name);
    if (!p) continue;
    double want = fmpq_get_d(&p->value), unit = fmpq_get_d(&p->unit);
    double rel = (arf_get_d(arb_midref(of[i].value), ARF_RND_NEAR) - want) / fmax(fabs(want), unit);
    sum += rel * rel;
  }
  return sum;
}

const struct dyn_orbits *scene_orbits(const struct scene *s, struct orbit_cache *cache) {
  static const struct dyn_orbits none = {.n = 0};
  return scene_has_forces(s) ? orbit_cache_get(cache, s->value, FD_PREC + 64) : &none;
}

int audit_orbits(struct dyn_orbits *list, const struct scene *s, slong prec) {
  if (scene_has_forces(s)) return dyn_orbits_find(list, s->value, prec, &dyn_limits_default);
  enum dyn_quantity which[2];
  fmpq value[2];
  int n = 0;
  for (int k = KEY_E1; k <= KEY_TD; k++) {
    if (!s->given[k]) continue;
    which[n] = (enum dyn_quantity)(QUANTITY_E1 + (k - KEY_E1));
    value[n++] = s->value[k]; /* borrowed: neither changed nor cleared */
  }
  return dyn_orbits_given(list, s->value, which, value, prec, &dyn_given_limits);
}

bool nearest_orbit_point(struct point *out, const struct scene *s, struct orbit_cache *cache) {
  const struct dyn_orbits *list = scene_orbits(s, cache);
  out->kind = POINT_ORBIT;
  set_scene_params(out, s);
  double best = INFINITY;
  for (slong i = 0; i < list->n; i++) {
    double dist = distance(&list->orbit[i], s);
    if (dist < best) {
      best = dist;
      out->orbit = i;
    }
  }
  return list->n > 0;
}

void finding_skip(struct finding *f, struct judge *j, const char *why) {
  f->verdict = VERDICT_SKIPPED;
  f->condition = result_str(j->out, "%s", why);
}

const char *ball_text(struct judge *j, const arb_t x, slong n) {
  struct text t;
  text_init(&t);
  if (num_print(&t, x, n) != SS_OK) num_print_ball(&t, x, n);
  const char *s = result_str(j->out, "%s", text_str(&t));
  text_clear(&t);
  return s;
}
