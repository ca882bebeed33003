/* Three simulations of one motion, return by return.  MPFR goes first and keeps its returns as they are, so that the
   others' distances from it are differences taken in MPFR, not of rounded numbers. */
#include "long_run.h"
#include "num/calc.h"

#include <math.h>
#include <stdlib.h>

#include "base/arena.h"

enum { MOST_EVENTS = 200000, KEPT = 3 };                /* kept of a return of MPFR: t, x_1, x_2 */
static const double ROUNDING = 1e-11, SATURATED = 1e-6; /* of the scale */

const char *const long_route_name[N_LONG_ROUTES] = {"ode", "closed", "mpfr"};

double long_run_reach(const double params[N_COULOMB], const double start[N_STATE]) {
  double f[2];
  coulomb_forces(f, params, start);
  return 0.01 * (params[COULOMB_UR1] - f[0]) / (1 - params[COULOMB_CHI]);
}

bool long_run_has_room(const double params[N_COULOMB], const double start[N_STATE]) {
  const double decades = 1e4;
  return long_run_reach(params, start) >= decades * ROUNDING * coulomb_scale(params, start);
}

/* What listens to one route. */
struct listener {
  struct long_run *run;
  enum long_route route;
  struct coulomb_sink log;
  struct num_vec *kept; /* KEPT elements a return */
  size_t cap;
};

/* The difference of the double d and the number x. */
static double difference(double d, const void *x) {
  MPFR_NUMBERS(53, z);
  mpfr_sub_d(z, x, d, MPFR_RNDN);
  return fabs(mpfr_get_d(z, MPFR_RNDN));
}

static void keep(struct listener *l, const struct coulomb_row *row) {
  struct long_run *run = l->run;
  size_t n = (size_t)run->n[l->route];
  struct long_return r = {row->t, {row->x[0], row->x[1]}, 0, 0, run->log[l->route].n};
  bool beside = l->kept->ctx.prec > 0; /* MPFR */
  bool known = l->route == LONG_MPFR ? l->kept->len >= (slong)(n + 1) * KEPT : (long)n < run->n[LONG_MPFR];
  if (beside && !known) return;
  for (int i = 0; beside && i < KEPT; i++) {
    void *x = num_vec_at(l->kept, (slong)n * KEPT + i);
    if (l->route == LONG_MPFR)
      num_mpfr.set(x, num_vec_at(row->exact, i));
    else if (i == 0)
      r.late = difference(r.t, x);
    else
      r.off = fmax(r.off, difference(r.x[i - 1], x));
  }
  run->at[l->route] = ss_grow(run->at[l->route], n, &l->cap, sizeof r);
  run->at[l->route][n] = r;
  run->n[l->route]++;
}

static bool listen(void *self, const struct coulomb_event *e) {
  struct listener *l = self;
  if (!l->log.event(l->log.self, e)) return false;
  if (e->returns) keep(l, &e->at);
  return true;
}

static int run_route(struct listener *l, const double params[N_COULOMB], const double start[N_STATE],
                     const struct coulomb_plan *plan) {
  struct coulomb_result r = {.end = COULOMB_FAILED};
  struct coulomb_sink sink = {l, listen, NULL};
  int status;
  if (l->route == LONG_ODE) {
    double moved[N_STATE] = {start[Z_1] + l->run->displaced, start[Z_2], start[DZ_1], start[DZ_2]};
    status = coulomb_simulate_ode(&r, params, moved, plan, &sink);
  } else if (l->route == LONG_CLOSED) {
    status = coulomb_simulate_d(&r, params, start, plan, &sink);
  } else {
    OWNED(calc) c = calc_begin(l->kept->ctx);
    const struct num_vec p = calc_vec_d(&c, params, N_COULOMB), x = calc_vec_d(&c, start, N_STATE);
    status = coulomb_simulate_exact(&r, &p, &x, plan, &sink);
  }
  l->run->end[l->route] = r.end;
  return status;
}

/* Of a run that says by how much the ODE route is displaced. */
static int run_all_routes(struct long_run *run, const double params[N_COULOMB], const double start[N_STATE],
                          long returns, double duration, slong prec) {
  struct coulomb_plan plan = coulomb_plan_default;
  OWNED(num_vec) kept;
  run->scale = coulomb_scale(params, start);
  run->reach = INFINITY;
  for (int i = 0; i < 2; i++) run->from[i] = start[Z_1 + i];
  plan.returns = returns;
  plan.duration = duration;
  plan.max_events = MOST_EVENTS;
  num_vec_init(&kept, prec ? KEPT * returns : 0, num_ctx_mpfr(prec));
  int status = SS_OK;
  for (int k = prec ? LONG_MPFR : LONG_CLOSED; k >= 0; k--) {
    struct listener l = {run, (enum long_route)k, coulomb_log_sink(&run->log[k]), &kept, 0};
    status |= run_route(&l, params, start, &plan);
  }
  return status;
}

int long_run_make(struct long_run *run, const double params[N_COULOMB], const double start[N_STATE], long returns,
                  double duration, slong prec) {
  *run = (struct long_run){.displaced = 0};
  return run_all_routes(run, params, start, returns, duration, prec);
}

void long_run_clear(struct long_run *run) {
  for (int k = 0; k < N_LONG_ROUTES; k++) {
    coulomb_log_clear(&run->log[k]);
    free(run->at[k]);
  }
}

long long_run_length(const struct long_run *run, struct long_pair p) {
  return run->n[p.a] < run->n[p.b] ? run->n[p.a] : run->n[p.b];
}

/* How far apart their positions are at return i, from 0. */
static double long_run_apart(const struct long_run *run, struct long_pair p, long i) {
  const struct long_return *a = &run->at[p.a][i], *b = &run->at[p.b][i];
  if (p.b == LONG_MPFR) return a->off;
  if (p.a == LONG_MPFR) return b->off;
  return fmax(fabs(a->x[0] - b->x[0]), fabs(a->x[1] - b->x[1]));
}

/* In a position or in time. */
static double anyhow_apart(const struct long_run *run, struct long_pair p, long i) {
  const struct long_return *a = &run->at[p.a][i], *b = &run->at[p.b][i];
  double late = p.b == LONG_MPFR ? a->late : p.a == LONG_MPFR ? b->late : fabs(a->t - b->t);
  return fmax(late, long_run_apart(run, p, i));
}

double long_run_most(const struct long_run *run, struct long_pair p) {
  double most = 0;
  long n = long_run_length(run, p);
  for (long i = 0; i < n; i++) most = fmax(most, long_run_apart(run, p, i));
  return most;
}

long long_run_parting(const struct long_run *run, struct long_pair p, double by) {
  long n = long_run_length(run, p);
  for (long i = 0; i < n; i++)
    if (anyhow_apart(run, p, i) > by) return i + 1;
  return 0;
}

/* The slope of the logarithm of the distance over the returns first .. last, counted from 1. */
static double slope(const struct long_run *run, struct long_pair p, long first, long last) {
  double middle = 0.5 * (double)(first + last), top = 0, bottom = 0;
  for (long i = first; i <= last; i++) {
    double from = (double)i - middle;
    top += from * log(long_run_apart(run, p, i - 1));
    bottom += from * from;
  }
  return top / bottom;
}

/* Above rounding, below saturation, and where the orbit's own multiplier holds. */
static bool is_linear(const struct long_run *run, struct long_pair p, long i) {
  const struct long_return *b = &run->at[p.b][i];
  double apart = long_run_apart(run, p, i), away = fmax(fabs(b->x[0] - run->from[0]), fabs(b->x[1] - run->from[1]));
  return apart >= ROUNDING * run->scale && apart <= SATURATED * run->scale && fmax(apart, away) <= run->reach;
}

bool long_run_growth(struct long_growth *growth, const struct long_run *run, struct long_pair p) {
  enum { FEWEST = 3 };
  long n = long_run_length(run, p), first = 0;
  for (long i = 1; i <= n + 1; i++) {
    if (i <= n && is_linear(run, p, i - 1)) {
      if (first == 0) first = i;
    } else if (first > 0 && i - first >= FEWEST) {
      *growth = (struct long_growth){first, i - 1, slope(run, p, first, i - 1)};
      return true;
    } else {
      first = 0;
    }
  }
  return false;
}

bool long_run_displaced(struct long_growth *growth, const double params[N_COULOMB], const double start[N_STATE],
                        double multiplier, double duration) {
  enum { RETURNS = 64 };
  OWNED(long_run) run = {.displaced = ldexp(coulomb_scale(params, start), fabs(multiplier) < 1 ? -21 : -34)};
  return run_all_routes(&run, params, start, RETURNS, duration, 0) != SS_DOMAIN &&
         long_run_growth(growth, &run, (struct long_pair){LONG_ODE, LONG_CLOSED});
}
