/* The simulation of walk.h. */
#include "walk.h"

#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <string.h>

#include "base/arena.h"
#include "base/work.h"
#include "motion/dynamics.h"
#include "num/flint_more.h"

enum { SIDE = MECH_STATES + 1 };
enum { UNITS_OF_LOOK = 15, HALVINGS = 200, TERMS = 14 }; /* of work; of the search for a root */
enum { MOST_MODES = 200 };                               /* kept at a time; one takes 70 KB */
enum { MOST_LOOKS = 200000, LOOKS_OF_EVENT = 15, MOST_STEPS = 10000 /* of GSL in a look */ };

const char *const mech_outcome_name[] = {"done", "its budget of steps is used up",
                                         "a mass rebounds from an obstacle in hops too short to be followed",
                                         "the integrator gives up, or a number is too large"};

/* What a mass may meet: the end of its mode; an obstacle below, above. */
enum meeting { OWN, BELOW, ABOVE, N_MEETINGS };

/* What is made once of the phases with these letters. */
struct mode {
  struct mode *next;
  char letters[MECH_MASSES + 1];
  double rate[SIDE * SIDE], jump[SIDE][SIDE]; /* A; exp(A look), by columns */
};

struct walk {
  const struct mech *m;
  const struct mech_plan *plan;
  enum mech_route route;
  enum mech_outcome end;
  int n, states;
  size_t cap; /* of the moments */
  char phase[MECH_PHASE + 1];
  int fresh;               /* the mass that has just begun to slip or rebounded, or -1: its condition starts at zero */
  enum meeting fresh_part; /* which */
  bool enough;             /* who is told says so */
  double look, z[MECH_STATES];
  double stiffness[MECH_MASSES * MECH_MASSES], damping[MECH_MASSES * MECH_MASSES];
  double loading[MECH_MASSES][2 * MECH_ORDERS], frequency, stop[MECH_MASSES][2], restitution[MECH_MASSES][2];
  double inertia[MECH_MASSES], sliding[MECH_MASSES], limit[MECH_MASSES], surface[MECH_MASSES];
  struct arena pool; /* of the modes met so far, up to MOST_MODES of them */
  struct mode *modes;
  int n_modes;
  const struct mode *mode;
  double series[TERMS + 1][SIDE]; /* (A look)^k (z, 1)/k!, where it is made: of the present z */
  bool made;
  gsl_odeiv2_system system;
  gsl_odeiv2_driver *driver;
};

static double force(const struct walk *w, const double *z, int i) {
  double f = 0;
  for (int j = 0; j < w->n; j++) f += w->stiffness[i * w->n + j] * z[j] + w->damping[i * w->n + j] * z[w->n + j];
  for (int j = 2 * w->n; j < w->states; j++) f -= w->loading[i][j - 2 * w->n] * z[j];
  return f;
}

static double friction(const struct walk *w, const double *z, int i) {
  char mode = mech_rests(w->phase[i]) ? mech_slipping(&w->m->mass[i]) : w->phase[i];
  return mode == 's' ? force(w, z, i) : mode == '-' ? w->sliding[i] : mode == '+' ? -w->sliding[i] : 0;
}

static int right_side(double t, const double z[], double dz[], void *self) {
  (void)t;
  const struct walk *w = self;
  for (int i = 0; i < w->n; i++) {
    dz[i] = z[w->n + i];
    dz[w->n + i] =
        w->phase[i] == 's' || mech_rests(w->phase[i]) ? 0 : (friction(w, z, i) - force(w, z, i)) / w->inertia[i];
  }
  for (int k = 0, at = 2 * w->n; at < w->states; k++, at += 2) {
    dz[at] = -w->m->order[k] * w->frequency * z[at + 1];
    dz[at + 1] = w->m->order[k] * w->frequency * z[at];
  }
  return GSL_SUCCESS;
}

/* term[k] = (A look)^k y/k! for k = 1 ... TERMS; term[0] = y. */
static void make_series(double term[][SIDE], const double *rate, double look, int side) {
  for (int k = 1; k <= TERMS; k++)
    for (int i = 0; i < side; i++) {
      double sum = 0;
      for (int j = 0; j < side; j++) sum += rate[i * side + j] * term[k - 1][j];
      term[k][i] = sum * look / k;
    }
}

/* exp(A part look) y, for a part of a look up to the whole, so that the terms fall like (1/16)^k/k!. */
static void add_series(double *to, const double term[][SIDE], int n, double part) {
  for (int i = 0; i < n; i++) {
    double sum = term[TERMS][i];
    for (int k = TERMS - 1; k >= 0; k--) sum = sum * part + term[k][i];
    to[i] = sum;
  }
}

static void make_mode(struct mode *mode, const struct walk *w) {
  int side = w->states + 1;
  SIZED(fmpq_mat, rate, side, side);
  memcpy(mode->letters, w->phase, (size_t)w->n);
  mech_rate(rate, w->m, mode->letters);
  for (int i = 0; i < side; i++)
    for (int j = 0; j < side; j++) mode->rate[i * side + j] = fmpq_get_d(fmpq_mat_entry(rate, i, j));
  double term[TERMS + 1][SIDE];
  for (int j = 0; j < side; j++) {
    for (int i = 0; i < side; i++) term[0][i] = i == j;
    make_series(term, mode->rate, w->look, side);
    add_series(mode->jump[j], term, w->states, 1);
  }
}

/* exp(A look) (z, 1). */
static void add_jump(double *to, const struct walk *w) {
  memcpy(to, w->mode->jump[w->states], (size_t)w->states * sizeof *to);
  for (int j = 0; j < w->states; j++)
    for (int i = 0; i < w->states; i++) to[i] += w->mode->jump[j][i] * w->z[j];
}

/* The state h after w->z in the present phase. */
static bool carry(double *to, struct walk *w, double h) {
  double t = 0;
  bool ok = true;
  if (w->route == MECH_PATCHED && h == w->look) {
    add_jump(to, w);
  } else if (w->route == MECH_PATCHED) {
    if (!w->made) {
      memcpy(w->series[0], w->z, (size_t)w->states * sizeof *w->z);
      w->series[0][w->states] = 1;
      make_series(w->series, w->mode->rate, w->look, w->states + 1);
      w->made = true;
    }
    add_series(to, w->series, w->states, h / w->look);
  } else {
    memcpy(to, w->z, sizeof w->z);
    gsl_odeiv2_driver_reset(w->driver);
    ok = h == 0 || gsl_odeiv2_driver_apply(w->driver, &t, h, to) == GSL_SUCCESS;
  }
  for (int i = 0; i < w->states; i++) ok = ok && isfinite(to[i]);
  return ok;
}

/* The force that presses mass i, at rest, against its obstacle. */
static double pressing(const struct walk *w, const double *z, int i, enum meeting part) {
  double push = friction(w, z, i) - force(w, z, i);
  return part == ABOVE ? push : -push;
}

/* Negative while mass i goes on as it does. */
static double condition(const struct walk *w, const double *z, int i, enum meeting part) {
  bool still = w->phase[i] == 's' && w->surface[i] == 0;
  bool rests = mech_rests(w->phase[i]);
  if (part != OWN && (still || rests || !w->m->mass[i].stop[part == ABOVE].given)) return -1;
  if (part != OWN) return part == ABOVE ? z[i] - w->stop[i][1] : w->stop[i][0] - z[i];
  double lead = z[w->n + i] - w->surface[i];
  if (rests) return -pressing(w, z, i, w->phase[i] == 'a' ? ABOVE : BELOW);
  if (w->phase[i] == '.') return -1;
  if (w->phase[i] == 's') return fabs(force(w, z, i)) - w->limit[i];
  return w->phase[i] == '-' ? lead : -lead;
}

/* The first root of a condition of mass i, which changes sign within (0, h]: regula falsi of Illinois. */
static bool locate(double *s, struct walk *w, int i, enum meeting part, double h, double at_end) {
  double a = 0, b = h, fa = condition(w, w->z, i, part), fb = at_end, z[MECH_STATES];
  if ((i == w->fresh && part == w->fresh_part) || fa > 0) { /* it leaves zero: begin where it is well below */
    for (a = h / 2; a > 1e-9 * h; a /= 2) {
      if (!carry(z, w, a)) return false;
      fa = condition(w, z, i, part);
      if (fa < 0) break;
    }
  }
  for (int k = 0; k < HALVINGS && b - a > 1e-15; k++) {
    double mid = a + (b - a) * fa / (fa - fb);
    if (!(mid > a && mid < b)) mid = 0.5 * (a + b);
    if (!carry(z, w, mid)) return false;
    double f = condition(w, z, i, part);
    if (f < 0) {
      a = mid;
      fa = f;
      fb /= 2;
    } else {
      b = mid;
      fb = f;
      fa /= 2;
    }
    if (f == 0) break;
  }
  *s = b;
  return true;
}

/* Along the tangent of the motion at z. */
static void go_straight(double *to, struct walk *w, const double *z, double h) {
  double rate[MECH_STATES];
  right_side(0, z, rate, w);
  for (int i = 0; i < w->states; i++) to[i] = z[i] + h * rate[i];
}

/* Is a condition of mass i that is negative now and h later positive at some s between?  Where it is concave it is
   below its tangents; ahead, back: where those of now and of h later lead. */
static bool peaks(double *s, double *top, struct walk *w, int i, enum meeting part, double h, const double *ahead,
                  const double *back) {
  double a = 0, b = h, z[MECH_STATES], next[MECH_STATES];
  bool may = condition(w, ahead, i, part) > 0 && condition(w, back, i, part) > 0;
  while (may && b - a > 1e-9 * h) {
    *s = 0.5 * (a + b);
    if (!carry(z, w, *s)) return false;
    *top = condition(w, z, i, part);
    if (*top > 0) return true;
    go_straight(next, w, z, b - *s);
    bool rises = condition(w, next, i, part) > *top;
    if (!rises) go_straight(next, w, z, a - *s);
    may = condition(w, next, i, part) > 0;
    *(rises ? &a : &b) = *s;
  }
  return false;
}

/* After a rebound of mass i: does what pushes it back bring it to rest there at once, or are its hops too short, or too
   low for its position, to be followed? */
static bool comes_to_rest(const struct walk *w, int i, enum meeting part) {
  static const double shortest = 1e-8, rest = 1e-6; /* a hop, and all hops that follow, in looks */
  double e = w->restitution[i][part == ABOVE];
  double pull = pressing(w, w->z, i, part) / w->inertia[i], v = fabs(w->z[w->n + i]);
  bool sticks = w->phase[i] != '.' && w->surface[i] == 0 && fabs(force(w, w->z, i)) < w->limit[i];
  if (!(pull > 0) || e == 0 || sticks) return false;
  double hop = 2 * v / pull, height = v * v / (2 * pull);
  return hop < shortest * w->look || hop < (1 - e) * rest * w->look || height < 16 * DBL_EPSILON * fabs(w->z[i]);
}

/* A mass at an obstacle without rebound: does it stay there? */
static bool begins_to_rest(struct walk *w, int i, enum meeting part) {
  if (w->restitution[i][part == ABOVE] != 0 || !(pressing(w, w->z, i, part) >= 0)) return false;
  w->z[w->n + i] = 0;
  w->phase[i] = part == ABOVE ? 'a' : 'b';
  w->fresh = -1;
  return true;
}

/* The law for the mass that has the event, which is at its surface's velocity, at its limit or at an obstacle. */
static void change(struct walk *w, int i, enum meeting part) {
  memset(w->phase + w->n, 0, sizeof w->phase - (size_t)w->n); /* no mark of an earlier rebound */
  w->fresh = i;
  w->fresh_part = part;
  if (part != OWN) {
    w->z[i] = w->stop[i][part == ABOVE];
    double e = w->restitution[i][part == ABOVE];
    w->z[w->n + i] = e == 0 ? 0 : -e * w->z[w->n + i];
    if (w->phase[i] != '.') w->phase[i] = w->z[w->n + i] < w->surface[i] ? '-' : '+';
    if (begins_to_rest(w, i, part)) return;
    mech_mark(w->phase + w->n, i, part == ABOVE);
    if (comes_to_rest(w, i, part)) w->end = MECH_RESTING;
    return;
  }
  if (mech_rests(w->phase[i])) {
    w->fresh_part = w->phase[i] == 'a' ? ABOVE : BELOW;
    w->phase[i] = mech_slipping(&w->m->mass[i]);
    return;
  }
  double f = force(w, w->z, i);
  bool loose = w->phase[i] == 's', holds = fabs(f) < w->limit[i];
  w->z[w->n + i] = w->surface[i];
  w->phase[i] = !loose && holds ? 's' : f > 0 ? '-' : '+';
  if (w->phase[i] == 's') w->fresh = -1;
}

static void begin(struct walk *w) {
  if (w->route != MECH_PATCHED) return; /* the integrator asks for forces alone */
  struct mode *mode = w->modes;
  while (mode && strncmp(mode->letters, w->phase, (size_t)w->n) != 0) mode = mode->next;
  if (!mode && w->n_modes == MOST_MODES) {
    arena_clear(&w->pool);
    w->modes = NULL;
    w->n_modes = 0;
  }
  if (!mode) {
    mode = arena_alloc(&w->pool, sizeof *mode);
    make_mode(mode, w);
    mode->next = w->modes;
    w->modes = mode;
    w->n_modes++;
  }
  w->mode = mode;
}

/* Tells of the present moment, an event where it has a mass. */
static void tell(struct walk *w, struct mech_moment *at, double t, int mass) {
  *at = (struct mech_moment){.t = t, .mass = mass};
  memcpy(at->phase, w->phase, sizeof at->phase);
  memcpy(at->z, w->z, sizeof at->z);
  for (int i = 0; i < w->n; i++) at->u[i] = friction(w, w->z, i);
  w->enough = w->enough || (w->plan->told && !w->plan->told(w->plan->self, at));
}

/* One look ahead: to the first event in it, or to its end. */
static void advance(double *gone, struct walk *w, struct mech_motion *out, double t, double h) {
  double z[MECH_STATES], ahead[MECH_STATES], back[MECH_STATES], first = h;
  int event = -1; /* a mass and what it meets */
  bool ok = carry(z, w, h), still = false;
  go_straight(ahead, w, w->z, h);
  if (ok) go_straight(back, w, z, -h);
  for (int k = 0; ok && k < N_MEETINGS * w->n; k++) {
    int i = k / N_MEETINGS;
    enum meeting part = (enum meeting)(k % N_MEETINGS);
    double s, end = h, at_end = condition(w, z, i, part);
    if (at_end < 0 && !peaks(&end, &at_end, w, i, part, h, ahead, back)) continue;
    if (at_end == 0 && mech_rests(w->phase[i])) continue; /* nothing pushes it off */
    if (i == w->fresh && part == w->fresh_part && part != OWN && at_end < 16 * DBL_EPSILON * fabs(z[i])) {
      still = true; /* no further from its obstacle than rounding */
      continue;
    }
    ok = locate(&s, w, i, part, end, at_end);
    if (ok && (s < first || event < 0)) {
      first = s;
      event = k;
    }
  }
  if (!ok || (event >= 0 && !carry(z, w, first))) {
    w->end = MECH_LOST;
    return;
  }
  memcpy(w->z, z, sizeof w->z);
  w->made = false;
  if (!still) w->fresh = -1;
  *gone = first;
  if (event < 0) return;
  change(w, event / N_MEETINGS, (enum meeting)(event % N_MEETINGS));
  tell(w, SS_PUSH(out->moment, out->n_moments, w->cap), t + first, event / N_MEETINGS);
  begin(w);
}

/* --- From the start --- */

static void take_system(struct walk *w) {
  const struct mech *m = w->m;
  double fastest = 0;
  for (int i = 0; i < w->n; i++) {
    for (int j = 0; j < w->n; j++) {
      w->stiffness[i * w->n + j] = fmpq_get_d(fmpq_mat_entry(m->stiffness, i, j));
      w->damping[i * w->n + j] = fmpq_get_d(fmpq_mat_entry(m->damping, i, j));
    }
    for (int j = 0; j < 2 * m->n_orders; j++) w->loading[i][j] = fmpq_get_d(fmpq_mat_entry(m->loading, i, j));
    for (int k = 0; k < 2; k++) {
      w->stop[i][k] = fmpq_get_d(m->mass[i].stop[k].position);
      w->restitution[i][k] = fmpq_get_d(m->mass[i].stop[k].restitution);
    }
    w->inertia[i] = fmpq_get_d(m->mass[i].inertia);
    w->sliding[i] = fmpq_get_d(m->mass[i].sliding);
    w->limit[i] = fmpq_get_d(m->mass[i].limit);
    w->surface[i] = fmpq_get_d(m->mass[i].surface);
    /* bounds of the frequencies, by Gershgorin's circles */
    fastest = fmax(fastest, sqrt(2 * w->stiffness[i * w->n + i] / w->inertia[i]));
    fastest = fmax(fastest, 2 * w->damping[i * w->n + i] / w->inertia[i]);
  }
  w->frequency = fmpq_get_d(m->frequency);
  for (int k = 0; k < m->n_orders; k++) fastest = fmax(fastest, m->order[k] * w->frequency);
  w->look = (w->route == MECH_PATCHED ? 1.0 / 16 : 1.0 / 23) / fastest;
}

static void take_start(struct walk *w, const double *start) {
  const char *given = w->plan->phase;
  memcpy(w->z, start, (size_t)w->states * sizeof *start);
  if (given) memcpy(w->phase, given, strlen(given) + 1);
  for (int i = 0; i < w->n; i++) {
    double lead = start[w->n + i] - w->surface[i], f = force(w, start, i);
    char mode = !w->m->mass[i].rubbed                          ? '.'
                : lead < 0 || (lead == 0 && f >= w->limit[i])  ? '-'
                : lead > 0 || (lead == 0 && f <= -w->limit[i]) ? '+'
                                                               : 's';
    if (!given) {
      w->phase[i] = mode;
      for (int k = 0; k < 2; k++)
        if (w->m->mass[i].stop[k].given && w->z[i] == w->stop[i][k] &&
            (k ? start[w->n + i] >= 0 : start[w->n + i] <= 0))
          begins_to_rest(w, i, k ? ABOVE : BELOW);
      continue;
    }
    if (w->phase[i] == 's') w->z[w->n + i] = w->surface[i];
    if (mech_rests(w->phase[i])) {
      w->z[i] = w->stop[i][w->phase[i] == 'a'];
      w->z[w->n + i] = 0;
      continue;
    }
    if (w->phase[i] != mode && w->phase[i] != 's') w->fresh = i;
    for (int k = 0; k < 2; k++) {
      if (!w->m->mass[i].stop[k].given || (k ? w->z[i] < w->stop[i][k] : w->z[i] > w->stop[i][k])) continue;
      w->z[i] = w->stop[i][k];
      w->fresh = i;
      w->fresh_part = k ? ABOVE : BELOW;
    }
  }
}

static bool in_domain(const struct walk *w) {
  double duration = w->plan->duration;
  bool ok = duration >= 0 && duration <= 1e6 && isfinite(w->look) && w->look > 0;
  for (int i = 0; i < w->states; i++) ok = ok && isfinite(w->z[i]);
  for (int i = 0; i < w->n; i++) ok = ok && isfinite(force(w, w->z, i) + w->limit[i] + w->surface[i]);
  for (int k = 0; ok && k < N_MEETINGS * w->n; k++)
    ok = k % N_MEETINGS == OWN || condition(w, w->z, k / N_MEETINGS, (enum meeting)(k % N_MEETINGS)) <= 0;
  return ok;
}

/* Where a condition that is linear in time is zero, from its values now and a look later; in looks. */
static double looks_until(double now, double later) {
  return later > now ? -now / (later - now) : INFINITY;
}

/* How far to look.  Where every mass sticks or rests and nothing is driven the state goes along a straight line, and
   one look leads past the first event, however slow the surfaces are. */
static double look_ahead(const struct walk *w) {
  double later[MECH_STATES], looks = INFINITY;
  if (w->states > 2 * w->n) return w->look;
  for (int i = 0; i < w->n; i++) {
    if (w->phase[i] != 's' && !mech_rests(w->phase[i])) return w->look;
    later[i] = w->z[i] + w->look * w->z[w->n + i];
    later[w->n + i] = w->z[w->n + i];
  }
  for (int k = 0; k < N_MEETINGS * w->n; k++) {
    int i = k / N_MEETINGS;
    enum meeting part = (enum meeting)(k % N_MEETINGS);
    double f = force(w, w->z, i), f_later = force(w, later, i), limit = w->limit[i];
    if (part == OWN && w->phase[i] == 's')
      looks = fmin(looks, fmin(looks_until(f - limit, f_later - limit), looks_until(-f - limit, -f_later - limit)));
    else
      looks = fmin(looks, looks_until(condition(w, w->z, i, part), condition(w, later, i, part)));
  }
  return (fmax(looks, 0) + 1) * w->look; /* a condition that fails already has its event at once */
}

/* Look by look, each up to a sample at most. */
static void go(struct walk *w, struct mech_motion *out) {
  const struct mech_plan *plan = w->plan;
  long looks = 0, samples = 1, most = plan->looks ? plan->looks : MOST_LOOKS;
  while (!w->end && !w->enough && plan->duration - out->t > 1e-12 && out->n_moments < plan->most) {
    double next = plan->sample > 0 ? (double)samples * plan->sample : INFINITY, look = look_ahead(w), gone = 0;
    bool sampled = next - out->t <= look && next <= plan->duration;
    double h = fmin(look, (sampled ? next : plan->duration) - out->t);
    int before = out->n_moments;
    looks += !sampled;
    if (looks > most) {
      w->end = MECH_LOOKS;
      break;
    }
    work_add(UNITS_OF_LOOK);
    if (h > 0) advance(&gone, w, out, out->t, h);
    bool event = out->n_moments > before;
    out->t = sampled && !event ? next : out->t + gone;
    if (event) looks += LOOKS_OF_EVENT;
    if (w->end || !sampled || event) continue;
    struct mech_moment at;
    tell(w, &at, next, -1);
    samples++;
  }
}

int mech_simulate(struct mech_motion *out, enum mech_route route, const struct mech *m, const double *start,
                  const struct mech_plan *plan) {
  FREED struct walk *w = ss_malloc(sizeof *w);
  *w = (struct walk){.m = m, .plan = plan, .route = route, .n = m->n, .states = m->states, .fresh = -1};
  take_system(w);
  take_start(w, start);
  *out = (struct mech_motion){.n_moments = 0};
  int s = in_domain(w) ? SS_OK : SS_DOMAIN;
  if (s == SS_OK) {
    tell(w, SS_PUSH(out->moment, out->n_moments, w->cap), 0, -1);
    gsl_error_handler_t *old = gsl_set_error_handler(dyn_gsl_quiet);
    w->system = (gsl_odeiv2_system){right_side, NULL, (size_t)w->states, w};
    w->driver = gsl_odeiv2_driver_alloc_y_new(&w->system, gsl_odeiv2_step_rk8pd, w->look, 1e-13, 1e-13);
    gsl_odeiv2_driver_set_nmax(w->driver, MOST_STEPS);
    begin(w);
    go(w, out);
    memcpy(out->z, w->z, sizeof out->z);
    out->end = w->end;
    gsl_odeiv2_driver_free(w->driver);
    gsl_set_error_handler(old);
    if (out->end != MECH_DONE) s = SS_UNABLE;
  }
  arena_clear(&w->pool);
  return s;
}

void mech_motion_clear(struct mech_motion *out) {
  free(out->moment);
}
