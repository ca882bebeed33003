/* One Jacobian by one method: of the whole period, or of one phase in the paper's corner of it, at one precision. */
#include <string.h>

#include "audit_impl.h"

const char *const method_name[N_METHODS] = {"analytic", "implicit", "saltation", "fd", "fd-double", "ode"};
const char *const method_accuracy[N_METHODS] = {"radius of the enclosure",
                                                "radius of the enclosure",
                                                "radius of the enclosure",
                                                "estimate: truncation and rounding of the differences",
                                                "estimate: truncation and rounding of the differences",
                                                "estimate: truncation and error of the integrations"};

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
  arb_ptr x = _arb_vec_init(16);
  int n;
  struct view view = {job->model, layer, NULL, NULL};
  int s = expression_at(x, &n, view, map ? map->name : "J", "stability", &job->point, prec, job->cache, job->d);
  if (n != entries(map)) s |= SS_UNABLE;
  for (int i = 0; i < entries(map); i++) arb_set(out + i, x + i);
  _arb_vec_clear(x, 16);
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
  struct num_vec in = {v->ctx, N_STATE, num_vec_at(&v->arc.z, N_STATE * (slong)ph)};
  const void *t = num_vec_at(&v->arc.t, ph);
  if (method == METHOD_IMPLICIT) return dyn_local_jacobian(j, ph, &v->params, &in, t);
  if (method == METHOD_SALTATION) return dyn_local_jacobian_saltation(j, ph, &v->params, &in, t);
  return dyn_local_jacobian_fd(j, err, ph, &v->params, &in, v->ctx.type->get_d(t));
}

/* The paper's corner of a phase's derivative, in balls. */
static int corner(arb_ptr out, const struct local_map *map, const struct num_vec *local, const fmpq *chi) {
  struct num_vec x;
  num_vec_init(&x, entries(map) + 1, local->ctx);
  void *c = num_vec_at(&x, entries(map));
  int s = x.ctx.type->set_q(c, chi, x.ctx.prec);
  s |= local_map_corner(&x, map, local, c);
  for (int i = 0; i < entries(map); i++) arb_set(out + i, num_vec_at(&x, i));
  num_vec_clear(&x);
  return s;
}

/* Implicit differentiation and saltation matrices in balls, differences in MPFR. */
static int by_model(arb_ptr out, const struct jacobian_job *job, enum jacobian_method method,
                    const struct local_map *map, slong prec) {
  struct point p = point_for(job, method);
  struct num_ctx ctx = method == METHOD_FD ? num_ctx_mpfr(prec) : num_ctx_arb(prec);
  struct values v;
  struct num_vec j, err, balls;
  arb_t e;
  arb_init(e);
  slong n = map ? N_STATE * N_STATE : 4;
  int s = values_init(&v, &p, VARIANT_CLOSED, ctx, job->cache);
  num_vec_init(&j, n, ctx);
  num_vec_init(&err, 1, ctx);
  num_vec_init(&balls, n, num_ctx_arb(prec));
  if (s == SS_OK)
    s |= map ? phase_matrix(&j, num_vec_at(&err, 0), method, map->phase, &v)
             : whole_matrix(&j, num_vec_at(&err, 0), method, &v);
  ctx.type->get_arb(e, num_vec_at(&err, 0));
  for (slong i = 0; i < n; i++) {
    ctx.type->get_arb(num_vec_at(&balls, i), num_vec_at(&j, i));
    arb_add_error(num_vec_at(&balls, i), e);
    if (!map) arb_set(out + i, num_vec_at(&balls, i));
  }
  if (map) s |= corner(out, map, &balls, &p.q[Q_CHI]);
  num_vec_clear(&balls);
  num_vec_clear(&err);
  num_vec_clear(&j);
  values_clear(&v);
  arb_clear(e);
  return s;
}

/* --- In double precision --- */

static void ball_of(arb_t out, double value, double err) {
  mag_t radius;
  mag_init(radius);
  mag_set_d(radius, err);
  arb_set_d(out, value);
  mag_set(arb_radref(out), radius);
  mag_clear(radius);
}

/* The pass in doubles: parameters, states and times. */
struct pass {
  double params[N_PARAMS], z[N_PHASES + 1][N_STATE], t[N_PHASES];
};

static int read_pass(struct pass *pass, const struct jacobian_job *job, enum jacobian_method method) {
  struct point p = point_for(job, method);
  struct values v;
  int s = values_init(&v, &p, VARIANT_CLOSED, num_ctx_arb(FIRST_PREC), job->cache);
  for (int i = 0; i < N_PARAMS; i++) pass->params[i] = v.ctx.type->get_d(num_vec_at(&v.params, i));
  for (int i = 0; i < (N_PHASES + 1) * N_STATE; i++)
    pass->z[i / N_STATE][i % N_STATE] = v.ctx.type->get_d(num_vec_at(&v.arc.z, i));
  for (int i = 0; i < N_PHASES; i++) pass->t[i] = v.ctx.type->get_d(num_vec_at(&v.arc.t, i));
  values_clear(&v);
  return s;
}

/* The simulation's start and friction, found once for a job. */
static bool have_setup(struct jacobian_job *job) {
  if (!job->setup_done)
    job->setup_good =
        audit_coulomb_setup(&job->setup, job->scene, job->point.orbit, job->point.kind == POINT_PRINTED, NULL);
  job->setup_done = true;
  return job->setup_good;
}

static int whole_by_doubles(arb_ptr out, struct jacobian_job *job, enum jacobian_method method,
                            const struct pass *pass) {
  double j[4], err;
  int s = method == METHOD_ODE ? coulomb_return_jacobian(j, &err, job->setup.params, job->setup.start)
                               : dyn_return_jacobian_d(j, &err, pass->params, pass->z[0], pass->t);
  for (int i = 0; i < 4 && !s; i++) ball_of(out + i, j[i], err);
  return s;
}

static int phase_by_doubles(arb_ptr out, struct jacobian_job *job, enum jacobian_method method,
                            const struct local_map *map, const struct pass *pass) {
  double dir[LOCAL_MOST][N_STATE], column[LOCAL_MOST * N_STATE], err[LOCAL_MOST], x[N_STATE];
  const double(*along)[N_STATE] = (const double(*)[N_STATE])dir;
  const enum phase ph = map->phase;
  int s;
  local_map_directions(dir, map, pass->params[P_CHI]);
  memcpy(x, pass->z[ph], sizeof x);
  if (method == METHOD_ODE) {
    for (int i = 0; i < 2; i++) x[i] += job->setup.start[i] - pass->z[0][i]; /* x = z + d */
    s = coulomb_local_differences(column, err, ph, job->setup.params, x, pass->t[ph], along, map->cols);
  } else {
    s = dyn_local_differences_d(column, err, ph, pass->params, x, pass->t[ph], along, map->cols);
  }
  for (int i = 0; i < entries(map) && !s; i++) {
    int row = i / map->cols, k = i % map->cols;
    ball_of(out + i, column[N_STATE * k + map->keep[row]], err[k]);
  }
  return s;
}

static int by_doubles(arb_ptr out, struct jacobian_job *job, enum jacobian_method method, const struct local_map *map) {
  struct pass pass;
  if (method == METHOD_ODE && !have_setup(job)) return SS_DOMAIN;
  bool needs_pass = map || method != METHOD_ODE; /* the simulation finds its own way through the period */
  int s = needs_pass ? read_pass(&pass, job, method) : SS_OK;
  if (s) return s;
  return map ? phase_by_doubles(out, job, method, map, &pass) : whole_by_doubles(out, job, method, &pass);
}

int jacobian_route(arb_ptr out, struct jacobian_job *job, enum jacobian_method method, enum layer layer,
                   const struct local_map *map, slong prec) {
  if (method == METHOD_ANALYTIC) return analytic(out, job, layer, map, prec);
  return method_is_double(method) ? by_doubles(out, job, method, map) : by_model(out, job, method, map, prec);
}
