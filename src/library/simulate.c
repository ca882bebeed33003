/* Coulomb's law. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "library.h"

_Static_assert((int)SS_ABOVE == MODE_ABOVE && N_COULOMB == 7, "modes and parameters");

struct ss_motion {
  struct coulomb_setup setup;
};

/* Takes what a room's setup gave. */
static int give(ss_motion **out, const struct coulomb_setup *setup, bool ok, const struct diag *d) {
  if (!ok) return library_input(d);
  *out = ss_malloc(sizeof **out);
  (*out)->setup = *setup;
  return SS_OK;
}

/* From that orbit, or from the printed numbers; s: NULL where what is missing is said. */
static int begin(ss_motion **out, const char *function, const ss_scene *s, const char *missing, slong k, bool printed) {
  struct coulomb_setup setup;
  struct diag d = {0};
  if (!out) return library_argument(function, "no place for the motion");
  *out = NULL;
  if (!s) return library_argument(function, missing);
  int status = library_point(s, true, false);
  return status ? status : give(out, &setup, audit_coulomb_setup(&setup, &s->s, k, printed, &d), &d);
}

int ss_motion_on_orbit(ss_motion **out, const ss_scene *s, size_t k) {
  bool can_be = k <= WORD_MAX / 2;
  return begin(out, __func__, can_be ? s : NULL, "no scene or no such orbit", can_be ? (slong)k : 0, false);
}

int ss_motion_printed(ss_motion **out, const ss_scene *s) {
  return begin(out, __func__, s, "no scene", 0, true);
}

int ss_motion_from(ss_motion **out, const ss_scene *s, const double start[4]) {
  struct coulomb_setup setup;
  struct diag d = {0};
  if (!out) return library_argument(__func__, "no place for the motion");
  *out = NULL;
  if (!s || !start) return library_argument(__func__, "no scene or no start");
  for (int i = 0; i < N_STATE; i++)
    if (!(fabs(start[i]) <= 1e100)) return library_argument(__func__, "a start is finite and at most 1e100");
  int status = library_point(s, true, false);
  if (status) return status;
  bool ok = audit_coulomb_setup_from(&setup, &s->s, "0,0,0,0", &d);
  memcpy(setup.start, start, sizeof setup.start);
  return give(out, &setup, ok, &d);
}

void ss_motion_free(ss_motion *m) {
  free(m);
}

int ss_motion_parameters(double params[7], const ss_motion *m) {
  if (!params || !m) return library_argument(__func__, "no motion, or no place for its parameters");
  memcpy(params, m->setup.params, sizeof m->setup.params);
  return SS_OK;
}

int ss_motion_start(double start[4], const ss_motion *m) {
  if (!start || !m) return library_argument(__func__, "no motion, or no place for its start");
  memcpy(start, m->setup.start, sizeof m->setup.start);
  return SS_OK;
}

int ss_motion_friction_is_own(const ss_motion *m) {
  return m && m->setup.own_friction;
}

double ss_motion_period(const ss_motion *m) {
  return m ? m->setup.period : NAN;
}

/* Whom the room's own sink passes things on to. */
struct listener {
  ss_on_event event;
  ss_on_sample sample;
  void *self;
  long samples; /* told so far */
};
enum { MAX_SAMPLES = 10000000 };

static struct ss_moment moment(const struct coulomb_row *r) {
  struct ss_moment m = {.t = r->t};
  for (int i = 0; i < 2; i++) {
    m.x[i] = r->x[i];
    m.v[i] = r->v[i];
    m.u[i] = r->u[i];
    m.mode[i] = (enum ss_mode)r->mode[i];
  }
  return m;
}

static bool on_event(void *self, const struct coulomb_event *e) {
  const struct listener *l = self;
  const struct ss_event told = {moment(&e->at),      e->mass,         (enum ss_mode)e->from,
                                (enum ss_mode)e->to, e->simultaneous, e->grazing};
  return l->event(l->self, &told) != 0;
}

static bool on_sample(void *self, const struct coulomb_row *r) {
  struct listener *l = self;
  if (++l->samples > MAX_SAMPLES) return false;
  const struct ss_moment told = moment(r);
  return l->sample(l->self, &told) != 0;
}

/* SS_OK or SS_ARGUMENT, with the argument that is wrong. */
static int plan_can_be(const char *function, double duration, long returns, double sample) {
  if (!(duration >= 0))
    return library_fail(SS_ARGUMENT, "%s: duration is a time from 0 to infinity, not %g", function, duration);
  if (returns < 0) return library_fail(SS_ARGUMENT, "%s: returns is a number from 0, not %ld", function, returns);
  if (!(sample >= 0 && isfinite(sample)))
    return library_fail(SS_ARGUMENT, "%s: sample is a finite time from 0, not %g", function, sample);
  if (isfinite(duration) || returns) return SS_OK;
  return library_argument(function, "a motion without end; give a finite duration, or returns");
}

int ss_motion_run(ss_moment *end, const ss_motion *m, int route, double duration, long returns, double sample,
                  ss_on_event event, ss_on_sample sampled, void *self) {
  enum { MAX_STEPS = 10000000 };
  if (!m || (route != SS_INTEGRATED && route != SS_CLOSED)) return library_argument(__func__, "no motion or no route");
  int status = plan_can_be(__func__, duration, returns, sample);
  if (status) return status;
  struct listener l = {event, sampled, self, 0};
  struct coulomb_sink sink = {&l, event ? on_event : NULL, sampled ? on_sample : NULL};
  struct coulomb_plan plan = coulomb_plan_default;
  struct coulomb_result r = {.end = COULOMB_FAILED};
  plan.duration = duration;
  plan.returns = returns;
  plan.sample = sampled ? sample : 0;
  plan.max_steps = MAX_STEPS;
  status = (route == SS_CLOSED ? coulomb_simulate_d : coulomb_simulate_ode)(&r, m->setup.params, m->setup.start, &plan,
                                                                            &sink);
  if (status & SS_DOMAIN) return library_fail(SS_DOMAIN, "%s: parameters that cannot be simulated", __func__);
  if (end) *end = moment(&r.at);
  if (l.samples > MAX_SAMPLES)
    return library_fail(SS_UNABLE, "%s: ended early at t = %.10g: more than %d samples", __func__, r.at.t, MAX_SAMPLES);
  if (r.end == COULOMB_STOPPED) return library_fail(SS_STOPPED, "%s: stopped by the caller", __func__);
  return status ? library_fail(status, "%s: ended early at t = %.10g: %s", __func__, r.at.t, coulomb_end_name[r.end])
                : SS_OK;
}
