/* The motion under Coulomb's law by numerical integration of (1) in x, with nothing known about its solutions.

   GSL's Runge-Kutta-Prince-Dormand 8(7) takes adaptive steps within one pair of modes.  An event is looked for inside
   the accepted step by repeating it from its beginning with other lengths, so that nothing is interpolated or
   extrapolated.  Each condition is a margin that is negative while it holds; its derivatives follow from the equations,
   their bounds from the state, and a stretch is halved until the bounds show that the margin has no root in it, or at
   most one. */
#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <string.h>

#include "base/work.h"
#include "coulomb_impl.h"

/* Of work: a step of the integrator; those that one simulation does before any is counted, more than usual motions
   need. */
enum { UNITS_OF_ODE_STEP = 16, FREE_STEPS = 1 << 17, KEPT_STATES = 8 };

struct ode {
  const double *p;
  double tol; /* what counts as equal */
  double longest;
  gsl_odeiv2_system system;
  gsl_odeiv2_step *step;
  gsl_odeiv2_control *control;
  gsl_odeiv2_evolve *evolve;
  enum coulomb_mode mode[2];
  double u[2], gain[2];                  /* x_i'' = gain_i (u_i - f_i) in this pair of modes */
  double began;                          /* when this pair of modes began */
  double since, y[N_STATE];              /* the present */
  double step_since, step_from[N_STATE]; /* the step being looked into */
  struct {
    double s, y[N_STATE];
  } kept[KEPT_STATES]; /* the last states in it, which several margins ask for */
  int n_kept;          /* all that were made */
  double hint;         /* the next step's length */
  bool touched;        /* some margin came within tol of zero without crossing it */
};

static void accelerations(double a[2], const struct ode *o, const double y[N_STATE]) {
  double f[2];
  coulomb_forces(f, o->p, y);
  for (int i = 0; i < 2; i++) a[i] = o->gain[i] * (o->u[i] - f[i]);
}

static void set_modes(struct ode *o, const enum coulomb_mode mode[2]) {
  for (int i = 0; i < 2; i++) {
    double us = o->p[COULOMB_US1 + i];
    o->mode[i] = mode[i];
    o->u[i] = mode[i] == MODE_BELOW ? us : -us;
    o->gain[i] = mode[i] == MODE_STICK ? 0 : i == 0 ? 1 : o->p[COULOMB_ETA];
  }
}

static int right_side(double t, const double y[], double dydt[], void *self) {
  (void)t;
  dydt[Z_1] = y[DZ_1];
  dydt[Z_2] = y[DZ_2];
  accelerations(dydt + DZ_1, self, y);
  return GSL_SUCCESS;
}

/* The state s after the beginning of the step. */
static void state_at(double y[N_STATE], struct ode *o, double s) {
  double err[N_STATE];
  int i = 0;
  while (i < o->n_kept && i < KEPT_STATES && o->kept[i].s != s) i++;
  if (i == o->n_kept || i == KEPT_STATES) {
    i = o->n_kept++ % KEPT_STATES;
    o->kept[i].s = s;
    memcpy(o->kept[i].y, o->step_from, sizeof o->step_from);
    if (s > 0) gsl_odeiv2_step_apply(o->step, 0, s, o->kept[i].y, err, NULL, NULL, &o->system);
  }
  memcpy(y, o->kept[i].y, sizeof o->kept[i].y);
}

/* --- Margins: negative while mass i goes on as it does; a sticking mass has one for each side. --- */

struct margin {
  int mass, side; /* side: +1 or -1, of f_i or of x_i' - V */
};
struct point {
  double s, value, rate;
};

/* In the state y, s after the beginning of the step. */
static struct point margin_in(const struct ode *o, struct margin m, double s, const double y[N_STATE]) {
  double f[2], rate[2], a[2];
  if (o->mode[m.mass] != MODE_STICK) {
    accelerations(a, o, y);
    return (struct point){s, m.side * (y[DZ_1 + m.mass] - o->p[COULOMB_V]), m.side * a[m.mass]};
  }
  coulomb_forces(f, o->p, y);
  coulomb_forces(rate, o->p, y + DZ_1);
  return (struct point){s, m.side * f[m.mass] - o->p[COULOMB_UR1 + m.mass], m.side * rate[m.mass]};
}

static struct point margin_at(struct ode *o, struct margin m, double s) {
  double y[N_STATE];
  state_at(y, o, s);
  return margin_in(o, m, s, y);
}

/* Bounds of a margin's second and third derivatives over a step of length h.  Speeds stay below W and accelerations
   below A with W <= W0 + h A and A <= A0 + 2 m h W, m = max(1, chi eta), and h is at most 1/(2 sqrt(1 + chi eta)); a
   slipping mass has |x_i'''| <= c_i W with c_1 = 2, c_2 = 2 chi eta, and a sticking one |f_i''| = chi |x_j''|. */
struct bounds {
  double second, third;
};

static bool both_stick(const struct ode *o) {
  return o->mode[0] == MODE_STICK && o->mode[1] == MODE_STICK;
}

/* Without finite bounds a step cannot be looked into. */
static bool find_bounds(struct bounds lim[2], const struct ode *o, double h) {
  double a[2], chi = o->p[COULOMB_CHI], change[2] = {2, 2 * chi * o->p[COULOMB_ETA]};
  accelerations(a, o, o->step_from);
  double speed = fmax(fabs(o->step_from[DZ_1]), fabs(o->step_from[DZ_2])), rate = fmax(fabs(a[0]), fabs(a[1]));
  speed = 2 * (speed + h * rate);
  rate += fmax(change[0], change[1]) * h * speed;
  for (int i = 0; i < 2; i++)
    lim[i] = both_stick(o)              ? (struct bounds){0, 0} /* straight, however long the step */
             : o->mode[i] == MODE_STICK ? (struct bounds){chi * rate, chi * change[1 - i] * speed}
                                        : (struct bounds){change[i] * speed, change[i] * rate};
  return isfinite(lim[0].second) && isfinite(lim[0].third) && isfinite(lim[1].second) && isfinite(lim[1].third);
}

/* Newton's iteration kept inside the bracket a < 0 <= b. */
static double bracketed_root(struct ode *o, struct margin m, struct point a, struct point b) {
  const double settled = 1e-16 * o->longest;
  struct point at = b;
  for (int i = 0; i < 100 && b.s - a.s > settled; i++) {
    double step = -at.value / at.rate, next = at.s + step;
    if (fabs(step) <= settled) break;
    if (!(next > a.s && next < b.s)) next = a.s + 0.5 * (b.s - a.s);
    at = margin_at(o, m, next);
    if (at.value < 0)
      a = at;
    else
      b = at;
  }
  return at.s;
}

/* The first contact of a margin with zero between two points of the step, at *s.  A force that touches its limit and
   turns back is no contact. */
static bool seek(double *s, struct ode *o, struct margin m, struct bounds lim, struct point a, struct point b) {
  double h = b.s - a.s, bend = lim.third * h * h / 8;
  if (fmax(a.value, b.value) + lim.second * h * h / 8 < 0) return false;
  if (fmax(a.rate, b.rate) + bend < 0) return false; /* falls from a, where it holds */
  bool rises = fmin(a.rate, b.rate) > bend, tiny = lim.second * h * h <= 8 * o->tol;
  if (rises && b.value < 0) return false;
  if (tiny && o->step_since == 0 && a.s == 0 && a.value >= 0) return false; /* leaving its limit, as the law found */
  if (rises || (tiny && b.value >= 0)) {
    *s = a.value < 0 ? bracketed_root(o, m, a, b) : b.s;
    return true;
  }
  if (tiny) {
    bool crest = a.rate > 0 && b.rate < 0;
    *s = crest ? a.s + h * a.rate / (a.rate - b.rate) : a.value > b.value ? a.s : b.s;
    o->touched = true;
    return o->mode[m.mass] != MODE_STICK;
  }
  struct point mid = margin_at(o, m, a.s + 0.5 * h);
  return seek(s, o, m, lim, a, mid) || seek(s, o, m, lim, mid, b);
}

/* The first event within the step of length h, which ends in the present state: its place *s, and the mass that has it,
   or -1.  The present state goes back to the event. */
static int first_event(double *s, bool *flat, struct ode *o, const struct bounds lim[2], double h) {
  int first = -1;
  *s = h;
  *flat = o->touched = false;
  for (int mass = 0; mass < 2; mass++) {
    bool sticks = o->mode[mass] == MODE_STICK;
    if (sticks && mass == 1 && o->mode[0] == MODE_STICK) continue; /* f_2 is constant while both stick */
    for (int side = -1; side <= 1; side += 2) {
      if (!sticks && side != (o->mode[mass] == MODE_BELOW ? 1 : -1)) continue;
      struct margin m = {mass, side};
      double at;
      if (!seek(&at, o, m, lim[mass], margin_in(o, m, 0, o->step_from), margin_in(o, m, *s, o->y))) continue;
      state_at(o->y, o, at);
      double rate = margin_in(o, m, at, o->y).rate;
      *flat = rate * rate <= 16 * lim[mass].second * o->tol;
      *s = at;
      first = mass;
    }
  }
  return first;
}

/* --- The route. --- */

static double ode_time(const void *self) {
  const struct ode *o = self;
  return o->began + o->since;
}

static void ode_row(void *self, struct coulomb_row *row, double t) {
  struct ode *o = self;
  double y[N_STATE];
  bool now = t >= ode_time(o);
  if (now)
    memcpy(y, o->y, sizeof y);
  else
    state_at(y, o, t - o->began - o->step_since);
  *row = (struct coulomb_row){.t = t, .x = {y[Z_1], y[Z_2]}, .v = {y[DZ_1], y[DZ_2]}};
  coulomb_forces(row->u, o->p, y);
}

static void ode_signs(void *self, struct coulomb_signs *s) {
  struct ode *o = self;
  coulomb_signs_d(s, o->p, o->y, o->tol);
  for (int i = 0; i < 2; i++)
    if (s->speed[i] == 0) o->y[DZ_1 + i] = o->p[COULOMB_V];
}

static bool all_finite(const double y[N_STATE]) {
  return isfinite(y[0]) && isfinite(y[1]) && isfinite(y[2]) && isfinite(y[3]);
}

/* Puts the state on what the event says of it: no mass past V, the one with the event at V. */
static void settle(struct ode *o, int mass) {
  for (int i = 0; i < 2; i++) {
    double *v = &o->y[DZ_1 + i], belt = o->p[COULOMB_V];
    bool past = o->mode[i] == MODE_BELOW ? *v > belt : *v < belt;
    if (past || i == mass || o->mode[i] == MODE_STICK) *v = belt;
  }
}

static enum move ode_move(void *self, struct coulomb_run *run) {
  struct ode *o = self;
  const double duration = run->plan->duration;
  set_modes(o, run->mode);
  o->began = ode_time(o);
  o->since = 0;
  gsl_odeiv2_evolve_reset(o->evolve);
  for (;;) {
    double longest = both_stick(o) ? fmax(o->longest, o->since) : o->longest;
    double to = fmin(o->since + longest, duration - o->began), s;
    struct bounds lim[2];
    if (!(to > o->since)) {
      o->began = duration;
      o->since = 0;
      return run_samples(run, duration, true) ? MOVE_END : MOVE_STOPPED;
    }
    if (run->result->steps >= run->plan->max_steps) return MOVE_BUDGET;
    if (++run->result->steps % FREE_STEPS == 0) work_add((unsigned long long)FREE_STEPS * UNITS_OF_ODE_STEP);
    memcpy(o->step_from, o->y, sizeof o->y);
    o->step_since = o->since;
    o->n_kept = 0;
    if (gsl_odeiv2_evolve_apply(o->evolve, o->control, o->step, &o->system, &o->since, to, &o->hint, o->y) ||
        !all_finite(o->y) || !find_bounds(lim, o, o->since - o->step_since))
      return MOVE_FAILED;
    bool flat;
    int mass = first_event(&s, &flat, o, lim, o->since - o->step_since);
    if (mass >= 0) o->since = o->step_since + s;
    if (o->touched || flat) run->result->touches++;
    if (!run_samples(run, ode_time(o), false)) return MOVE_STOPPED;
    if (mass < 0) continue;
    run->grazing[mass] = flat;
    settle(o, mass);
    return MOVE_EVENT;
  }
}

static double size_of(const double params[N_COULOMB], const double start[N_STATE]) {
  double size = params[COULOMB_V] + params[COULOMB_UR1] + params[COULOMB_UR2];
  for (int i = 0; i < N_STATE; i++) size += fabs(start[i]);
  return size;
}

double coulomb_event_floor(const double params[N_COULOMB], const double start[N_STATE]) {
  double tol = 4 * coulomb_plan_default.tolerance * size_of(params, start);
  return tol / ((1 - params[COULOMB_CHI]) * params[COULOMB_V]);
}

int coulomb_simulate_ode(struct coulomb_result *result, const double params[N_COULOMB], const double start[N_STATE],
                         const struct coulomb_plan *plan, const struct coulomb_sink *sink) {
  *result = (struct coulomb_result){.end = COULOMB_FAILED};
  if (!run_domain(params, start, plan) || !(plan->tolerance >= 1e-13 && plan->tolerance <= 1e-3)) return SS_DOMAIN;
  struct ode o = {.p = params};
  double size = size_of(params, start);
  memcpy(o.y, start, sizeof o.y);
  o.tol = 4 * plan->tolerance * size;
  o.longest = 0.5 / sqrt(1 + params[COULOMB_CHI] * params[COULOMB_ETA]);
  o.hint = o.longest / 8;
  o.system = (gsl_odeiv2_system){right_side, NULL, N_STATE, &o};
  o.step = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, N_STATE);
  double least = fmax(plan->tolerance * params[COULOMB_V], 2 * DBL_EPSILON * size); /* no step can do better */
  o.control = gsl_odeiv2_control_standard_new(least, plan->tolerance, 1, 0);
  o.evolve = gsl_odeiv2_evolve_alloc(N_STATE);
  struct coulomb_run run = {.plan = plan, .sink = sink, .result = result};
  run.route = (struct route){&o, ode_signs, ode_move, ode_row, ode_time};
  run_init(&run, params, o.tol);
  int status = run_all(&run);
  gsl_odeiv2_evolve_free(o.evolve);
  gsl_odeiv2_control_free(o.control);
  gsl_odeiv2_step_free(o.step);
  return status;
}
