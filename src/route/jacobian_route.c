/* One Jacobian by one method: of the whole period, or of one phase in the paper's corner of it, at one precision. */
#include "jacobian.h"
#include "num/calc.h"

#include <string.h>

#include "value/expression.h"
#include "value/printed.h"

const char *const method_name[N_METHODS] = {"analytic", "implicit", "saltation", "fd", "fd-double", "ode"};
const char *const method_accuracy[N_METHODS] = {
    "radius of the enclosure",
    "radius of the enclosure",
    "radius of the enclosure",
    "estimate: truncation and rounding of the differences",
    "estimate: truncation and rounding of the differences, rounding of the inputs",
    "estimate: truncation and error of the integrations, rounding of the inputs"};

bool method_is_double(enum jacobian_method method) {
  return method == METHOD_FD_DOUBLE || method == METHOD_ODE;
}

/* The paper's chain is read at the printed times; the model finds the events of the printed start itself. */
static struct point point_for(const struct jacobian_job *job, enum jacobian_method method) {
  struct point p = job->point; /* borrows its numbers */
  if (p.kind == POINT_PRINTED && method != METHOD_ANALYTIC) p.kind = POINT_ARC;
  return p;
}

static int entries(const struct local_map *map) {
  return map ? map->rows * map->cols : 4;
}

static int analytic(arb_ptr out, const struct jacobian_job *job, enum layer layer, const struct local_map *map,
                    slong prec) {
  ARB_VECTOR(x, 16);
  int n;
  struct view view = {job->model, layer, NULL, NULL};
  int s = expression_at(x, &n, view, map ? map->name : "J", "stability", &job->point, prec, job->cache, job->d);
  if (n != entries(map)) s |= SS_UNABLE;
  for (int i = 0; i < entries(map); i++) arb_set(out + i, x + i);
  return s;
}

static int whole_matrix(struct num_vec *j, void *err, enum jacobian_method method, const struct values *v) {
  if (method == METHOD_IMPLICIT) return dyn_return_jacobian(j, &v->params, &v->arc);
  if (method == METHOD_SALTATION) return dyn_return_jacobian_saltation(j, &v->params, &v->arc);
  double guess[N_PHASES];
  for (int i = 0; i < N_PHASES; i++) guess[i] = v->ctx.type->get_d(num_vec_at(&v->arc.t, i));
  return dyn_return_jacobian_fd(j, err, &v->params, num_vec_at(&v->arc.z, Z_1), num_vec_at(&v->arc.z, Z_2), guess);
}

static int phase_matrix(struct num_vec *j, void *err, enum jacobian_method method, enum phase ph,
                        const struct values *v) {
  const struct num_vec in = dyn_arc_state(&v->arc, ph);
  const void *t = num_vec_at(&v->arc.t, ph);
  if (method == METHOD_IMPLICIT) return dyn_local_jacobian(j, ph, &v->params, &in, t);
  if (method == METHOD_SALTATION) return dyn_local_jacobian_saltation(j, ph, &v->params, &in, t);
  return dyn_local_jacobian_fd(j, err, ph, &v->params, &in, v->ctx.type->get_d(t));
}

/* The paper's corner of a phase's derivative, in balls. */
static int corner(arb_ptr out, const struct local_map *map, const struct num_vec *local, const void *chi) {
  struct num_vec x = {local->ctx, entries(map), (char *)out};
  return local_map_corner(&x, map, local, chi);
}

/* Implicit differentiation and saltation matrices in balls, differences in MPFR. */
static int by_model(arb_ptr out, const struct jacobian_job *job, enum jacobian_method method,
                    const struct local_map *map, slong prec) {
  struct point p = point_for(job, method);
  struct num_ctx ctx = method == METHOD_FD ? num_ctx_mpfr(prec) : num_ctx_arb(prec);
  OWNED(values) v;
  slong n = map ? N_STATE * N_STATE : 4;
  int s = values_init(&v, &p, VARIANT_CLOSED, ctx, job->cache);
  OWNED(calc) c = calc_begin(ctx), w = calc_begin(num_ctx_arb(prec));
  struct num_vec j = calc_vec(&c, n), err = calc_vec(&c, 1), balls = calc_vec(&w, n);
  arb_ptr e = calc_new(&w);
  if (s == SS_OK)
    s |= map ? phase_matrix(&j, num_vec_at(&err, 0), method, map->phase, &v)
             : whole_matrix(&j, num_vec_at(&err, 0), method, &v);
  ctx.type->get_arb(e, num_vec_at(&err, 0));
  for (slong i = 0; i < n; i++) {
    ctx.type->get_arb(num_vec_at(&balls, i), num_vec_at(&j, i));
    arb_add_error(num_vec_at(&balls, i), e);
    if (!map) arb_set(out + i, num_vec_at(&balls, i));
  }
  if (map) s |= corner(out, map, &balls, calc_q(&w, &p.q[Q_CHI]));
  return s;
}

/* --- In double precision --- */

static void ball_of(arb_t out, double value, double err) {
  arb_set_d(out, value);
  mag_set_d(arb_radref(out), err);
}

/* The pass in doubles: parameters, states and times. */
struct pass {
  double params[N_PARAMS], z[N_PHASES + 1][N_STATE], t[N_PHASES];
};

static int read_pass(struct pass *pass, const struct jacobian_job *job, enum jacobian_method method) {
  struct point p = point_for(job, method);
  OWNED(values) v;
  int s = values_init(&v, &p, VARIANT_CLOSED, num_ctx_arb(FIRST_PREC), job->cache);
  for (int i = 0; i < N_PARAMS; i++) pass->params[i] = v.ctx.type->get_d(num_vec_at(&v.params, i));
  for (int i = 0; i < (N_PHASES + 1) * N_STATE; i++)
    pass->z[i / N_STATE][i % N_STATE] = v.ctx.type->get_d(num_vec_at(&v.arc.z, i));
  for (int i = 0; i < N_PHASES; i++) pass->t[i] = v.ctx.type->get_d(num_vec_at(&v.arc.t, i));
  return s;
}

/* The simulation's start and friction, found once for a job. */
static bool have_setup(struct jacobian_job *job) {
  if (!job->setup_done && job->point.kind == POINT_PRINTED)
    job->setup_good = audit_coulomb_setup(&job->setup, job->scene, job->point.orbit, true, NULL);
  else if (!job->setup_done)
    job->setup_good =
        coulomb_setup_among(&job->setup, job->scene, scene_orbits(job->scene, job->cache), job->point.orbit);
  job->setup_done = true;
  return job->setup_good;
}

/* The return Jacobian along the arc from a start, near its times. */
static int implicit_from(struct num_vec *j, const struct num_vec *params, const void *z10, const void *z20,
                         const double t[N_PHASES]) {
  OWNED(dyn_arc) arc;
  dyn_arc_init(&arc, params->ctx);
  int s = dyn_arc_run(&arc, params, z10, z20, t);
  if (!s) s = dyn_return_jacobian(j, params, &arc);
  return s;
}

/* What a method in double precision has worked at, exactly: parameters of the model, and a state z. */
struct rounded {
  struct num_vec params, z;
};

static struct rounded rounded_new(struct calc *c) {
  return (struct rounded){calc_vec(c, N_PARAMS), calc_vec(c, N_STATE)};
}

static void set_doubles(struct num_vec *out, const double *x) {
  for (slong i = 0; i < out->len; i++) arb_set_d(num_vec_at(out, i), x[i]);
}

/* The simulation knows e_i as the difference of two limits, and x = z + d. */
static int rounded_simulation(struct rounded *r, const struct coulomb_setup *setup, const double x[N_STATE]) {
  struct num_ctx ctx = r->z.ctx;
  OWNED(calc) c = calc_begin(ctx);
  struct num_vec all = calc_vec(&c, N_COULOMB), at = calc_vec(&c, N_STATE); /* of z = 0 */
  val still = calc_d(&c, 0);
  set_doubles(&all, setup->params);
  for (int i = 0; i < 3; i++) arb_set(num_vec_at(&r->params, P_CHI + i), num_vec_at(&all, COULOMB_CHI + i));
  for (int i = 0; i < 2; i++)
    arb_sub(num_vec_at(&r->params, P_E1 + i), num_vec_at(&all, COULOMB_UR1 + i), num_vec_at(&all, COULOMB_US1 + i),
            ctx.prec);
  int s = coulomb_start_set(&at, &all, still, still);
  set_doubles(&r->z, x);
  for (int i = Z_1; i <= Z_2; i++) arb_sub(num_vec_at(&r->z, i), num_vec_at(&r->z, i), num_vec_at(&at, i), ctx.prec);
  return s;
}

/* The derivative of the phase that starts at z and ends near t, in the paper's corner. */
static int implicit_phase(arb_ptr out, const struct local_map *map, const struct num_vec *params,
                          const struct num_vec *z, double t) {
  OWNED(calc) c = calc_begin(params->ctx);
  struct num_vec local = calc_vec(&c, N_STATE * N_STATE), at = calc_vec(&c, 1);
  int s = dyn_event(num_vec_at(&at, 0), map->phase, params, z, t);
  if (!s) s = dyn_local_jacobian(&local, map->phase, params, z, num_vec_at(&at, 0));
  if (!s) s = corner(out, map, &local, num_vec_at(params, P_CHI));
  return s;
}

/* How far rounding the parameters and the start to doubles moves each entry: 1/(1 - chi) alone loses seven digits at
   chi = 1 - 1e-9.  Estimates of differences know of nothing but the map that they were taken of. */
static int rounding_of_inputs(double off[MATRIX_MOST], const struct jacobian_job *job, enum jacobian_method method,
                              const struct local_map *map, const struct pass *pass, const struct rounded *rounded) {
  struct num_ctx ctx = num_ctx_arb(FIRST_PREC);
  struct point p = point_for(job, method);
  OWNED(values) v;
  struct num_vec j[2]; /* exact, rounded */
  int s = values_init(&v, &p, VARIANT_CLOSED, ctx, job->cache);
  const struct num_vec *params[2] = {&v.params, &rounded->params};
  const struct num_vec in = dyn_arc_state(&v.arc, map ? map->phase : 0);
  const struct num_vec *z[2] = {&in, &rounded->z};
  for (int i = 0; i < 2; i++) {
    num_vec_init(&j[i], entries(map), ctx);
    if (s) continue;
    s = map ? implicit_phase(num_vec_at(&j[i], 0), map, params[i], z[i], pass->t[map->phase])
            : implicit_from(&j[i], params[i], num_vec_at(z[i], Z_1), num_vec_at(z[i], Z_2), pass->t);
  }
  for (int i = 0; i < entries(map) && !s; i++) {
    arb_ptr d = num_vec_at(&j[1], i);
    arb_sub(d, d, num_vec_at(&j[0], i), FIRST_PREC);
    arb_get_mag(arb_radref(d), d);
    off[i] = mag_get_d(arb_radref(d));
  }
  for (int i = 0; i < 2; i++) num_vec_clear(&j[i]);
  return s;
}

static int whole_by_doubles(arb_ptr out, struct jacobian_job *job, enum jacobian_method method,
                            const struct pass *pass) {
  double j[4], err, off[MATRIX_MOST];
  OWNED(calc) c = calc_begin(num_ctx_arb(FIRST_PREC));
  struct rounded at = rounded_new(&c);
  int s;
  if (method == METHOD_ODE) {
    s = coulomb_return_jacobian(j, &err, job->setup.params, job->setup.start);
    if (!s) s = rounded_simulation(&at, &job->setup, job->setup.start);
  } else {
    s = dyn_return_jacobian_d(j, &err, pass->params, pass->z[0], pass->t);
    set_doubles(&at.params, pass->params);
    set_doubles(&at.z, pass->z[0]);
  }
  if (!s) s = rounding_of_inputs(off, job, method, NULL, pass, &at);
  for (int i = 0; i < 4 && !s; i++) ball_of(out + i, j[i], err + off[i]);
  return s;
}

static int phase_by_doubles(arb_ptr out, struct jacobian_job *job, enum jacobian_method method,
                            const struct local_map *map, const struct pass *pass) {
  double dir[LOCAL_MOST][N_STATE], column[LOCAL_MOST * N_STATE], err[LOCAL_MOST], x[N_STATE], off[MATRIX_MOST];
  const double(*along)[N_STATE] = (const double(*)[N_STATE])dir;
  const enum phase ph = map->phase;
  const struct dyn_stretch stretch = {ph, x, pass->t[ph]};
  OWNED(calc) c = calc_begin(num_ctx_arb(FIRST_PREC));
  struct rounded at = rounded_new(&c);
  int s;
  local_map_directions(dir, map, pass->params[P_CHI]);
  memcpy(x, pass->z[ph], sizeof x);
  if (method == METHOD_ODE) {
    for (int i = 0; i < 2; i++) x[i] += job->setup.start[i] - pass->z[0][i]; /* x = z + d */
    s = coulomb_local_differences(column, err, job->setup.params, &stretch, along, map->cols);
    if (!s) s = rounded_simulation(&at, &job->setup, x);
  } else {
    s = dyn_local_differences_d(column, err, pass->params, &stretch, along, map->cols);
    set_doubles(&at.params, pass->params);
    set_doubles(&at.z, x);
  }
  if (!s) s = rounding_of_inputs(off, job, method, map, pass, &at);
  for (int i = 0; i < entries(map) && !s; i++) {
    int row = i / map->cols, k = i % map->cols;
    ball_of(out + i, column[N_STATE * k + map->keep[row]], err[k] + off[i]);
  }
  return s;
}

static int by_doubles(arb_ptr out, struct jacobian_job *job, enum jacobian_method method, const struct local_map *map) {
  struct pass pass;
  if (method == METHOD_ODE && !have_setup(job)) return SS_DOMAIN;
  int s = read_pass(&pass, job,
                    method); /* the simulation finds its own way through the period; its accuracy needs the times */
  if (s) return s;
  return map ? phase_by_doubles(out, job, method, map, &pass) : whole_by_doubles(out, job, method, &pass);
}

int jacobian_route(arb_ptr out, struct jacobian_job *job, enum jacobian_method method, enum layer layer,
                   const struct local_map *map, slong prec) {
  if (method == METHOD_ANALYTIC) return analytic(out, job, layer, map, prec);
  return method_is_double(method) ? by_doubles(out, job, method, map) : by_model(out, job, method, map, prec);
}
