/* Printed numbers as brackets, the points they stand for, and the orbit they are nearest to.
   A printed decimal is read in two ways, rounded and cut off; each is a bracket one unit wide, the unit of the last
   decimal to which the scene's numbers are given (struct printed_number). */
#include "printed.h"
#include "orbits.h"
#include "solved.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const reading_name[N_READINGS] = {"rounded", "truncated"};

void printed_ends(fmpq_t below, fmpq_t above, const struct printed_number *p, enum reading how) {
  bool negative = p->decimal[0] == '-';
  fmpq_set_si(below, how == READ_ROUNDED ? 1 : negative ? 2 : 0, 2);
  fmpq_set_si(above, how == READ_ROUNDED ? 1 : negative ? 0 : 2, 2);
  fmpq_mul(below, below, &p->unit);
  fmpq_mul(above, above, &p->unit);
  fmpq_sub(below, &p->value, below);
  fmpq_add(above, &p->value, above);
}

/* The same as balls. */
static void bracket(arb_t lo, arb_t hi, const struct printed_number *p, enum reading how) {
  NUMBERS(fmpq, below, above);
  printed_ends(below, above, p, how);
  arb_set_fmpq(lo, below, LAST_PREC);
  arb_set_fmpq(hi, above, LAST_PREC);
}

static truth in_bracket(const arb_t x, const struct printed_number *p, enum reading how) {
  NUMBERS(arb, lo, hi);
  bracket(lo, hi, p, how);
  truth t = TRUTH_UNKNOWN;
  bool negative = p->decimal[0] == '-', open_lo = how == READ_TRUNCATED && negative;
  bool open_hi = how == READ_TRUNCATED && !negative; /* what has reached the next unit is cut off to that */
  if ((open_lo ? arb_gt : arb_ge)(x, lo) && (open_hi ? arb_lt : arb_le)(x, hi))
    t = TRUTH_TRUE;
  else if ((open_lo ? arb_le : arb_lt)(x, lo) || (open_hi ? arb_ge : arb_gt)(x, hi))
    t = TRUTH_FALSE;
  return t;
}

truth printed_fits(const arb_t x, const struct printed_number *p, enum reading *how) {
  truth t = TRUTH_FALSE;
  for (int r = 0; r < N_READINGS && t != TRUTH_TRUE; r++) {
    t = truth_or(t, in_bracket(x, p, (enum reading)r));
    *how = (enum reading)r;
  }
  return t;
}

void printed_ball(arb_t x, const struct printed_number *p) {
  NUMBERS(arb, lo, hi);
  arb_zero(x);
  for (int r = 0; r < N_READINGS; r++) {
    bracket(lo, hi, p, (enum reading)r);
    arb_union(lo, lo, hi, LAST_PREC);
    if (r == 0)
      arb_set(x, lo);
    else
      arb_union(x, x, lo, LAST_PREC);
  }
}

/* Printed numbers, of which the first six may be moved, and where they stand at a point. */
static const char *const number_name[] = {"t_a", "t_b", "t_c", "t_d", "z10", "z20", "e1", "e2"};
static const int number_q[] = {Q_TA, Q_TB, Q_TC, Q_TD, Q_Z1, Q_Z2, Q_E1, Q_E2};
enum { KNOWN = sizeof number_q / sizeof *number_q, MOVED = KNOWN - 2 };

int printed_quantity(const char *name) {
  int k = word_find(name, number_name, KNOWN);
  return k == KNOWN ? -1 : number_q[k];
}

void printed_corner(struct point *p, const struct scene *s, const char *but, enum reading how, bool own_digits,
                    int corner) {
  NUMBERS(fmpq, low, high, in);
  for (int i = 0; i < MOVED; i++) {
    const struct printed_number *given = scene_printed(s, number_name[i]);
    if (!given || (but && strcmp(number_name[i], but) == 0)) continue;
    struct printed_number as_read = *given; /* borrowed */
    if (own_digits) as_read.unit = as_read.digit;
    printed_ends(low, high, &as_read, how);
    fmpq_sub(in, high, low); /* inside the ends, of which one may not print so */
    fmpq_div_2exp(in, in, 10);
    if (corner >> i & 1)
      fmpq_sub(&p->q[number_q[i]], high, in);
    else
      fmpq_add(&p->q[number_q[i]], low, in);
  }
}

bool printed_replace(struct printed_number *own, const struct printed_number **p, const struct claim *c) {
  const char *shift = claim_get(c, "shift");
  if (!shift || !*p) return false;
  fmpq_init(&own->value);
  fmpq_init(&own->digit);
  fmpq_init(&own->unit);
  own->name = (*p)->name;
  own->decimal = (*p)->decimal;
  fmpq_set(&own->digit, &(*p)->unit); /* what is moved by units has their digits */
  fmpq_set(&own->unit, &(*p)->unit);
  fmpq_set_si(&own->value, strtol(shift, NULL, 10), 1);
  fmpq_mul(&own->value, &own->value, &own->unit);
  fmpq_add(&own->value, &own->value, &(*p)->value);
  *p = own;
  return true;
}

void printed_release(struct printed_number *own) {
  fmpq_clear(&own->value);
  fmpq_clear(&own->digit);
  fmpq_clear(&own->unit);
}

slong printed_decimals(const struct printed_number *p) {
  return (slong)fmpz_sizeinbase(fmpq_denref(&p->unit), 10) - 1;
}

const fmpq *scene_number(const struct scene *s, enum scene_key key) {
  if (s->given[key]) return &s->value[key];
  const struct printed_number *p = scene_printed(s, scene_key_name[key]);
  return p ? &p->value : NULL;
}

bool printed_start(const struct printed_number *z[2], const struct scene *s) {
  z[0] = scene_printed(s, "z10");
  z[1] = scene_printed(s, "z20");
  return z[0] && z[1];
}

bool printed_point(struct point *out, const struct scene *s) {
  const struct printed_number *z[2];
  static const int q[] = {Q_CHI, Q_ETA, Q_V, Q_E1, Q_E2, Q_TA, Q_TB, Q_TC, Q_TD}; /* by scene_key */
  out->kind = POINT_PRINTED;
  for (int k = KEY_CHI; k <= KEY_TD; k++) {
    const fmpq *x = scene_number(s, (enum scene_key)k);
    if (!x) return false;
    fmpq_set(&out->q[q[k]], x);
  }
  bool start = printed_start(z, s);
  for (int i = 0; start && i < 2; i++) fmpq_set(&out->q[Q_Z1 + i], &z[i]->value);
  return start;
}

void record_scene(struct audit_result *out, const struct scene *s) {
  struct text data = {0};
  out->scene = result_copy(out, s->name);
  out->title = s->changed ? NULL : result_copy(out, s->title);
  if (scene_is_example(s)) return;
  scene_data_print(&data, s);
  out->data = result_take(out, &data);
}

enum { N_OF_ORBIT = 6 }; /* numbers of an orbit (solved.h), of which some may be printed */

/* Relative squared distance of an orbit from the printed numbers; 0 where none are printed. */
static double distance(const struct dyn_orbit *o, const struct scene *s) {
  double sum = 0;
  for (int i = 0; i < N_OF_ORBIT; i++) {
    const struct printed_number *p = scene_printed(s, orbit_number_name(i));
    if (!p) continue;
    double want = fmpq_get_d(&p->value), unit = fmpq_get_d(&p->unit);
    double rel = (num_arb.get_d(orbit_number(o, i)) - want) / fmax(fabs(want), unit);
    sum += rel * rel;
  }
  return sum;
}

slong usual_orbit(const struct dyn_orbits *list, const struct scene *s) {
  slong nearest = 0, admissible = list->n;
  double least = INFINITY, most = 0;
  for (slong i = 0; i < list->n; i++) {
    const struct dyn_orbit *o = &list->orbit[i];
    double off = s ? distance(o, s) : 0;
    if (off < least) {
      least = off;
      nearest = i;
    }
    most = fmax(most, off);
    if (admissible == list->n && (s ? orbit_admissible(NULL, s, o) : o->admissible) == TRUTH_TRUE) admissible = i;
  }
  return most > 0 || admissible == list->n ? nearest : admissible;
}

const char *usual_orbit_text(struct judge *j, const char *noun) {
  const struct dyn_orbits *list = scene_orbits(j->scene, j->cache);
  for (int i = 0; i < N_OF_ORBIT; i++)
    if (scene_printed(j->scene, orbit_number_name(i)))
      return result_str(j->out, "the %s nearest to the printed numbers", noun);
  slong k = usual_orbit(list, j->scene);
  truth best = TRUTH_FALSE;
  for (slong i = 0; i < list->n && best != TRUTH_TRUE; i++) {
    truth is = orbit_admissible(NULL, j->scene, &list->orbit[i]);
    if (is != TRUTH_FALSE) best = is;
  }
  return result_str(j->out, "%s %ld (the first%s)", noun, (long)k + 1,
                    best == TRUTH_TRUE    ? " admissible one"
                    : best == TRUTH_FALSE ? "; none is admissible"
                                          : "; none is proved to be admissible");
}

slong scene_usual_orbit(const struct scene *s) {
  OWNED(dyn_orbits) list;
  audit_orbits(&list, s, FIRST_PREC);
  audit_orbits_complete(&list, s, FIRST_PREC);
  return usual_orbit(&list, s);
}

const struct dyn_orbit *scene_orbit(const struct scene *s, struct orbit_cache *cache) {
  const struct dyn_orbits *list = scene_orbits(s, cache);
  return list->n ? &list->orbit[usual_orbit(list, s)] : NULL;
}

bool nearest_orbit_point(struct point *out, const struct scene *s, struct orbit_cache *cache) {
  const struct dyn_orbits *list = scene_orbits(s, cache);
  out->kind = POINT_ORBIT;
  out->scene = s;
  for (int k = 0; k < N_SCENE_PARAMS; k++) fmpq_set(&out->q[Q_CHI + k], &s->value[k]);
  out->orbit = usual_orbit(list, s);
  return list->n > 0;
}

const char *scene_lacks_forces(const struct scene *s) {
  return scene_is_box(s) ? "the scene gives intervals" : "the scene does not give e1 and e2";
}

void finding_skip(struct finding *f, struct judge *j, const char *why) {
  f->verdict = VERDICT_SKIPPED;
  if (scene_is_box(j->scene)) { /* of which no record speaks */
    why = "the scene gives intervals, and this is about one set of parameters";
    f->recorded = N_VERDICTS;
  }
  f->condition = result_copy(j->out, why);
}

const char *ball_text(struct judge *j, const arb_t x, slong n) {
  struct text t = {0};
  if (num_print(&t, x, n) != SS_OK) num_print_ball(&t, x, n);
  return result_take(j->out, &t);
}

const char *rational_text(struct judge *j, const fmpq *x) {
  struct text t = {0};
  num_print_q(&t, x);
  return result_take(j->out, &t);
}

const char *point_text(struct judge *j, const struct point *p) {
  struct text t = {0};
  point_print(&t, p);
  return result_take(j->out, &t);
}

int scene_numbers(struct num_vec *params, struct judge *j) {
  const struct num_type *t = params->ctx.type;
  int s = SS_OK;
  for (int k = 0; k < N_PARAMS; k++) s |= t->set_q(num_vec_at(params, k), &j->scene->value[k], params->ctx.prec);
  if (scene_has_forces(j->scene)) return s;
  const struct dyn_orbit *o = scene_orbit(j->scene, j->cache);
  if (!o) return s | SS_DOMAIN;
  if (!j->scene->given[KEY_E1]) s |= t->set_arb(num_vec_at(params, P_E1), o->e1, params->ctx.prec);
  if (!j->scene->given[KEY_E2]) s |= t->set_arb(num_vec_at(params, P_E2), o->e2, params->ctx.prec);
  return s;
}
