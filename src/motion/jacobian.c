/* Derivatives of event-located maps, by implicit differentiation and by central differences, in MPFR and in double.

   A phase that ends at its own event maps Z to (I - f n^T/(n.f)) exp(A t) dZ, with f the phase's vector field and n the
   gradient of its switching function at the end.  The differences share nothing with that but the event-located map
   itself; their step 2^(-prec/3) balances truncation and rounding, and a second step measures the truncation. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "arc.h"
#include "differences.h"
#include "event.h"
#include "flow.h"
#include "num/calc.h"
#include "rounded.h"

/* The end of a phase at time t from a state: the propagator, the state, its vector field, the rate of the switching
   function there. */
struct phase_end {
  struct blocks b;
  val chi, z[N_STATE], f[N_STATE], rate;
};

static struct phase_end phase_end(struct calc *c, enum phase ph, const val p[N_PARAMS], const val *in, val t) {
  struct phase_end e = {.b = flow_blocks(c, ph, p, t), .chi = p[P_CHI]};
  flow_apply(e.z, c, &e.b, in);
  flow_field(e.f, c, ph, p, e.z);
  e.rate = flow_switching_along(c, ph, e.chi, e.f);
  return e;
}

/* A displacement at the start of a phase, as it is at the event that ends it.  The velocity that the event sets to V
   has none: exactly zero, which a difference of equal products would not be. */
static void carry(val column[N_STATE], struct calc *c, enum phase ph, const struct phase_end *e) {
  val end[N_STATE];
  flow_apply(end, c, &e->b, column);
  val delay = calc_div(c, flow_switching_along(c, ph, e->chi, end), e->rate); /* minus the derivative of the time */
  for (int k = 0; k < N_STATE; k++) column[k] = e->f[k] ? calc_sub(c, end[k], calc_mul(c, e->f[k], delay)) : end[k];
  if (ph == PHASE_H) column[DZ_1] = calc_d(c, 0);
  if (ph == PHASE_C) column[DZ_2] = calc_d(c, 0);
}

static void unit_column(val column[N_STATE], struct calc *c, int k) {
  for (int i = 0; i < N_STATE; i++) column[i] = calc_d(c, i == k);
}

static void local_formula(val *j, struct calc *c, enum phase ph, const val p[N_PARAMS], const val *in, val t) {
  const struct phase_end e = phase_end(c, ph, p, in, t);
  for (int k = 0; k < N_STATE; k++) {
    val column[N_STATE];
    unit_column(column, c, k);
    carry(column, c, ph, &e);
    for (int i = 0; i < N_STATE; i++) j[N_STATE * i + k] = column[i];
  }
}

int dyn_local_jacobian(struct num_vec *j, enum phase ph, const struct num_vec *params, const struct num_vec *in,
                       const void *t) {
  return rounded_run(j, local_formula, ph, params, in, t);
}

/* Along an arc: its four times, then the states at which its phases start. */
enum { ARC_T, ARC_Z = N_PHASES, N_ARC = ARC_Z + N_PHASES * N_STATE };

static void word_formula(val *j, struct calc *c, enum phase ph, const val p[N_PARAMS], const val *in, val t) {
  val column[2][N_STATE];
  (void)ph, (void)t;
  for (int k = 0; k < 2; k++) unit_column(column[k], c, k);
  for (int at = PHASE_D; at < N_PHASES; at++) {
    const struct phase_end e = phase_end(c, (enum phase)at, p, in + ARC_Z + at * N_STATE, in[ARC_T + at]);
    for (int k = 0; k < 2; k++) carry(column[k], c, (enum phase)at, &e);
  }
  for (int i = 0; i < 4; i++) j[i] = column[i % 2][i / 2];
}

int dyn_return_jacobian(struct num_vec *j, const struct num_vec *params, const struct dyn_arc *arc) {
  OWNED(calc) c = calc_begin(params->ctx);
  val all[N_ARC];
  flow_vals(all + ARC_T, &arc->t, 0, N_PHASES);
  flow_vals(all + ARC_Z, &arc->z, 0, N_ARC - ARC_Z);
  const struct num_vec in = calc_vec_of(&c, all, N_ARC);
  return rounded_run(j, word_formula, PHASE_D, params, &in, NULL);
}

/* A start z10, z20 and the times near which its events are. */
enum { START_Z, START_T = 2, N_START = START_T + N_PHASES };

static void start_formula(val *j, struct calc *c, enum phase ph, const val p[N_PARAMS], const val *in, val t) {
  OWNED(dyn_arc) arc;
  struct num_vec params = calc_vec_of(c, p, N_PARAMS), out = calc_vec(c, 4);
  double guess[N_PHASES];
  (void)ph, (void)t;
  for (int i = 0; i < N_PHASES; i++) guess[i] = num_arb.get_d(in[START_T + i]);
  dyn_arc_init(&arc, c->ctx);
  int status = rounded_from_guess(arc_run(&arc, &params, in[START_Z], in[START_Z + 1], NULL, guess), c);
  c->status |= status ? status : dyn_return_jacobian(&out, &params, &arc);
  flow_vals(j, &out, 0, 4);
}

int dyn_return_jacobian_from(double j[4], const double params[N_PARAMS], const double start[2], const double guess[4]) {
  const struct num_ctx d = num_ctx_double();
  double in[N_START] = {start[0], start[1]}, given[N_PARAMS];
  struct num_vec p = {d, N_PARAMS, (char *)given}, from = {d, N_START, (char *)in}, out = {d, 4, (char *)j};
  int status = SS_OK;
  memcpy(given, params, sizeof given);
  if (guess) {
    memcpy(in + START_T, guess, N_PHASES * sizeof *guess);
  } else {
    OWNED(dyn_arc) arc;
    dyn_arc_init(&arc, d);
    status = dyn_arc_run(&arc, &p, start, start + 1, NULL);
    if (!status) memcpy(in + START_T, arc.t.data, N_PHASES * sizeof *in);
  }
  if (!status && rounded_run(&out, start_formula, PHASE_D, &p, &from, NULL)) status = SS_UNABLE;
  return status;
}

/* --- Central differences. --- */

/* A map of n numbers whose events lie near those of the unperturbed point. */
struct event_map {
  int (*run)(struct num_vec *out, const struct num_vec *x, const struct event_map *map);
  const struct num_vec *params;
  enum phase ph;
  struct num_vec near; /* unperturbed times */
  slong n;
};

static val scale_of(struct calc *c, const struct num_vec *x, val at_least) {
  val scale = at_least;
  for (slong i = 0; i < x->len; i++) {
    val size = calc_abs(c, num_vec_at(x, i));
    if (calc_lt(c, scale, size)) scale = size;
  }
  return scale;
}

/* Column col of the derivative with step h. */
static void difference(val *out, struct calc *c, const struct event_map *map, const struct num_vec *x, slong col,
                       val h) {
  const struct num_type *type = c->ctx.type;
  OWNED(calc) w = calc_begin(c->ctx);
  struct num_vec moved = calc_vec(&w, map->n), value[2] = {calc_vec(&w, map->n), calc_vec(&w, map->n)};
  for (int side = 0; side < 2; side++) {
    num_vec_set(&moved, x);
    void *entry_moved = num_vec_at(&moved, col);
    type->set(entry_moved, side == 0 ? calc_add(c, entry_moved, h) : calc_sub(c, entry_moved, h));
    if (!c->status) c->status |= map->run(&value[side], &moved, map);
  }
  val width = calc_add(c, h, h);
  for (slong i = 0; i < map->n; i++)
    out[i] = calc_div(c, calc_sub(c, num_vec_at(&value[0], i), num_vec_at(&value[1], i)), width);
}

/* j receives the n x n derivative at x; err, unless NULL, the worst estimated error: a third of the change from step h
   to 2h, plus a few units in the last place of the scale over h. */
static int differentiate(struct num_vec *j, void *err, const struct event_map *map, const struct num_vec *x) {
  slong prec = x->ctx.prec;
  OWNED(calc) c = calc_begin(x->ctx);
  val scale = scale_of(&c, x, num_vec_at(map->params, P_V));
  val h = calc_mul(&c, scale, calc_two_to(&c, -prec / 3)), twice = calc_add(&c, h, h);
  val rounding = calc_div(&c, calc_mul(&c, scale, calc_two_to(&c, 3 - prec)), h), worst = calc_d(&c, 0);
  for (slong col = 0; col < map->n && !c.status; col++) {
    val fine[N_STATE], coarse[N_STATE];
    difference(fine, &c, map, x, col, h);
    if (err) difference(coarse, &c, map, x, col, twice);
    for (slong i = 0; i < map->n; i++) {
      j->ctx.type->set(num_vec_at(j, i * map->n + col), fine[i]);
      if (!err) continue;
      val change = calc_div(&c, calc_abs(&c, calc_sub(&c, fine[i], coarse[i])), calc_d(&c, 3));
      val error = calc_add(&c, change, calc_mul(&c, rounding, calc_add(&c, calc_d(&c, 1), calc_abs(&c, fine[i]))));
      if (calc_lt(&c, worst, error)) worst = error;
    }
  }
  if (err) c.ctx.type->set(err, worst);
  return c.status;
}

static int run_phase(struct num_vec *out, const struct num_vec *x, const struct event_map *map) {
  val p[N_PARAMS], in[N_STATE], z[N_STATE];
  OWNED(calc) c = calc_begin(x->ctx);
  flow_vals(p, map->params, 0, N_PARAMS);
  flow_vals(in, x, 0, N_STATE);
  val t = event_newton(&c, map->ph, p, in, num_vec_at(&map->near, 0));
  struct blocks b = flow_blocks(&c, map->ph, p, t);
  flow_apply(z, &c, &b, in);
  for (slong i = 0; i < N_STATE; i++) c.ctx.type->set(num_vec_at(out, i), z[i]);
  return c.status;
}

/* What the rounding of a phase's switching function, on the scale of its terms, moves the end of the phase by in
   double: where the function is flat, a Newton step from the unperturbed time ends where it began, and no noise is seen
   between neighbours. */
static int phase_jitter(double *jitter, enum phase ph, const struct num_vec *params, const struct num_vec *from,
                        val t) {
  val p[N_PARAMS], in[N_STATE];
  double terms = 0, speed = 0;
  OWNED(calc) c = calc_begin(params->ctx);
  double (*const size)(const void *) = c.ctx.type->get_d;
  flow_vals(p, params, 0, N_PARAMS);
  flow_vals(in, from, 0, N_STATE);
  const struct phase_end e = phase_end(&c, ph, p, in, t);
  val zero = calc_d(&c, 0);
  for (int k = 0; k < N_STATE; k++) {
    for (int i = 0; i < N_STATE; i++) {
      val part[N_STATE] = {zero, zero, zero, zero};
      part[k] = calc_mul(&c, flow_entry(&e.b, k, i), in[i]);
      terms += fabs(size(flow_switching_along(&c, ph, p[P_CHI], part)));
    }
    if (e.f[k]) speed = fmax(speed, fabs(size(e.f[k])));
  }
  *jitter = 4 * DBL_EPSILON * terms / fabs(size(e.rate)) * speed;
  return c.status;
}

static int run_word(struct num_vec *out, const struct num_vec *x, const struct event_map *map) {
  OWNED(dyn_arc) arc;
  dyn_arc_init(&arc, x->ctx);
  int status = arc_run(&arc, map->params, num_vec_at(x, 0), num_vec_at(x, 1), &map->near, NULL);
  for (slong i = 0; i < 2; i++) x->ctx.type->set(num_vec_at(out, i), num_vec_at(&arc.z, N_PHASES * N_STATE + i));
  return status;
}

int dyn_local_jacobian_fd(struct num_vec *j, void *err, enum phase ph, const struct num_vec *params,
                          const struct num_vec *in, double t0) {
  if (params->ctx.type->rigorous) return SS_UNABLE;
  OWNED(calc) c = calc_begin(params->ctx);
  const struct event_map map = {run_phase, params, ph, calc_vec(&c, 1), N_STATE};
  int status = dyn_event(num_vec_at(&map.near, 0), ph, params, in, t0);
  if (!status) status = differentiate(j, err, &map, in);
  return status;
}

int dyn_return_jacobian_fd(struct num_vec *j, void *err, const struct num_vec *params, const void *z10, const void *z20,
                           const double guess[4]) {
  if (params->ctx.type->rigorous) return SS_UNABLE;
  OWNED(calc) c = calc_begin(params->ctx);
  const struct num_vec x = calc_vec_of(&c, (const val[]){z10, z20}, 2);
  OWNED(dyn_arc) arc;
  dyn_arc_init(&arc, params->ctx);
  int status = dyn_arc_run(&arc, params, z10, z20, guess);
  struct event_map map = {run_word, params, PHASE_D, arc.t, 2};
  if (!status) status = differentiate(j, err, &map, &x);
  return status;
}

/* --- In hardware arithmetic. --- */

/* The event map on doubles, which are the elements of num_double. */
static int run_doubles(double *out, const double *x, const void *self) {
  const struct event_map *map = self;
  OWNED(calc) c = calc_begin(num_ctx_double());
  struct num_vec in = calc_vec_d(&c, x, map->n), end = calc_vec(&c, map->n);
  int status = map->run(&end, &in, map);
  memcpy(out, end.data, (size_t)map->n * sizeof *out);
  return status;
}

static struct double_map map_of_doubles(const struct event_map *map, const double *x, double jitter) {
  double scale = *(const double *)num_vec_at(map->params, P_V);
  for (slong i = 0; i < map->n; i++) scale = fmax(scale, fabs(x[i]));
  return (struct double_map){run_doubles, map, (int)map->n, (int)map->n, scale, 4 * DBL_EPSILON, jitter};
}

int dyn_local_differences_d(double *out, double *err, const double params[N_PARAMS], const struct dyn_stretch *of,
                            const double (*dir)[N_STATE], int n_dir) {
  OWNED(calc) c = calc_begin(num_ctx_double());
  const struct num_vec p = calc_vec_d(&c, params, N_PARAMS), from = calc_vec_d(&c, of->start, N_STATE);
  const struct event_map map = {run_phase, &p, of->phase, calc_vec(&c, 1), N_STATE};
  double jitter = 0;
  int status = dyn_event(num_vec_at(&map.near, 0), of->phase, &p, &from, of->t);
  if (!status) status = phase_jitter(&jitter, of->phase, &p, &from, num_vec_at(&map.near, 0));
  const struct double_map doubles = map_of_doubles(&map, of->start, jitter);
  if (!status) status = differences_along_all(out, err, &doubles, of->start, dir, n_dir);
  return status;
}

int dyn_return_jacobian_d(double j[4], double *err, const double params[N_PARAMS], const double start[2],
                          const double guess[4]) {
  OWNED(calc) c = calc_begin(num_ctx_double());
  const struct num_vec p = calc_vec_d(&c, params, N_PARAMS);
  OWNED(dyn_arc) arc;
  double jitter = 0;
  dyn_arc_init(&arc, num_ctx_double());
  int status = dyn_arc_run(&arc, &p, start, start + 1, guess);
  struct event_map map = {run_word, &p, PHASE_D, arc.t, 2};
  for (int ph = PHASE_GAMMA; ph < N_PHASES && !status; ph++) {
    double more = 0;
    const struct num_vec from = dyn_arc_state(&arc, ph);
    status = phase_jitter(&more, (enum phase)ph, &p, &from, num_vec_at(&arc.t, ph));
    jitter = fmax(jitter, more);
  }
  const struct double_map doubles = map_of_doubles(&map, start, jitter);
  if (!status) status = differences_jacobian(j, err, &doubles, start);
  return status;
}
