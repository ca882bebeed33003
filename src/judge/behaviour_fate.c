/* What becomes of motions beside a periodic orbit.  They are told by r = x_2 - x_1 at its returns to the global stick
   phase, where r alone fixes the state when m_1 breaks loose: it stays near (r never gets far from the orbit's, in
   units of the perturbation), departs and comes back, or ends elsewhere. */
#include <math.h>
#include <string.h>

#include "friction.h"
#include "judge.h"
#include "value/title.h"

/* --- Perturbed motions --- */

enum { N_SIZES = 3, MOMENTS = 3 };
static const double sizes[N_SIZES] = {1e-2, 1e-4, 1e-6};
static const char *const size_words[N_SIZES] = {"1e-2, 1e-4 and 1e-6", "1e-4 and 1e-6", "1e-6"}; /* from one on */
/* A departure counts as near when it is less than this many times the perturbation; the least that counts as far. */
static const double near_factor = 50, far_least = 1e-3;

enum fate { FATE_NEAR, FATE_BACK, FATE_ELSEWHERE, FATE_NO_STICK, FATE_OPEN, N_FATES };

struct orbit_motion {
  struct coulomb_setup start; /* on the orbit, at the start of the stick phase */
  double r, begin[5];         /* r there; times at which the phases begin, and the period */
  long periods;               /* to follow a perturbed motion */
};

/* A motion up to so many returns, or for four times as long as the orbit takes for them. */
static struct trajectory follow(enum motion_route r, const struct orbit_motion *o, const struct coulomb_setup *m) {
  struct coulomb_plan plan = coulomb_plan_default;
  plan.returns = o->periods;
  plan.duration = 4 * (double)o->periods * o->begin[4];
  plan.max_events = 64 * o->periods;
  return motion_simulate(r, m, &plan);
}

/* What becomes of a motion that begins beside the orbit, by one route. */
static enum fate fate_of(enum motion_route r, const struct orbit_motion *o, const struct coulomb_setup *m,
                         double size) {
  OWNED(trajectory) t = follow(r, o, m);
  double last = 0, farthest = 0; /* of r from the orbit's, at the returns */
  for (size_t i = 0; i < t.log.n; i++) {
    const struct coulomb_row *at = &t.log.event[i].at;
    if (at->mode[0] != MODE_STICK || at->mode[1] != MODE_STICK) continue;
    last = fabs(at->x[1] - at->x[0] - o->r);
    farthest = fmax(farthest, last);
  }
  bool simulated = t.status == SS_OK, returns = t.result.returns >= o->periods, back = last < 0.1 * size;
  if (!simulated) return FATE_OPEN;
  if (!returns) return FATE_NO_STICK;
  if (!back) return last > far_least ? FATE_ELSEWHERE : FATE_OPEN;
  return farthest < near_factor * size ? FATE_NEAR : farthest > far_least ? FATE_BACK : FATE_OPEN;
}

/* The state of the orbit after that part of a phase, by closed forms. */
static bool orbit_at(struct coulomb_setup *m, const struct orbit_motion *o, int ph, double part) {
  struct coulomb_plan plan = coulomb_plan_default;
  struct coulomb_result r;
  *m = o->start;
  plan.duration = o->begin[ph] + part * (o->begin[ph + 1] - o->begin[ph]);
  if (coulomb_simulate_d(&r, o->start.params, o->start.start, &plan, NULL) != SS_OK) return false;
  for (int i = 0; i < 2; i++) {
    m->start[Z_1 + i] = r.at.x[i];
    m->start[DZ_1 + i] = r.at.v[i];
  }
  return true;
}

static bool orbit_motion_make(struct orbit_motion *m, const struct point *p, const struct dyn_orbit *o, double factor) {
  bool ok = coulomb_setup_on_orbit(&m->start, p->q + Q_CHI, o, factor) == SS_OK;
  m->r = m->start.start[Z_2] - m->start.start[Z_1];
  m->begin[0] = 0;
  for (int i = 0; i < 4; i++) m->begin[i + 1] = m->begin[i] + o->guess[i];
  return ok;
}

struct table {
  int first;                                  /* of the sizes tried */
  long count[N_PHASES][2 * N_STATE][N_FATES]; /* phase; direction and side; fate */
  long total[N_FATES], apart;                 /* apart: the routes disagree */
  long smallest[2][2];                        /* of the smallest size: breaks_loose or not; near or far */
  struct coulomb_setup departs;               /* the first of the smallest that departs */
};

static const char *const coordinate[N_STATE] = {"x_1", "x_2", "x'_1", "x'_2"};

/* Does the change of velocity set a sticking mass free at once: is it slower than the belt while the force on it
   exceeds what sliding friction can carry, so that it falls back further, or faster the other way round? */
static bool breaks_loose(const struct coulomb_setup *at, int direction, double change) {
  const double *p = at->params;
  int i = direction - DZ_1;
  if (i < 0 || at->start[direction] != p[COULOMB_V]) return false;
  double f[2];
  coulomb_forces(f, p, at->start);
  return change < 0 ? f[i] > p[COULOMB_US1 + i] : f[i] < -p[COULOMB_US1 + i];
}

static void try_perturbation(struct table *t, const struct orbit_motion *o, const struct coulomb_setup *at, int ph,
                             int d, int s) {
  struct coulomb_setup m = *at;
  enum fate fate[N_MOTION_ROUTES];
  double change = (d % 2 ? -1 : 1) * sizes[s];
  m.start[d / 2] += change;
  for (int r = 0; r < N_MOTION_ROUTES; r++) fate[r] = fate_of((enum motion_route)r, o, &m, sizes[s]);
  bool same = fate[0] == fate[1];
  if (!same) fate[0] = FATE_OPEN;
  t->apart += !same;
  t->count[ph][d][fate[0]]++;
  t->total[fate[0]]++;
  if (s < N_SIZES - 1 || fate[0] == FATE_OPEN) return;
  if (fate[0] != FATE_NEAR && t->smallest[0][1] + t->smallest[1][1] == 0) t->departs = m;
  t->smallest[breaks_loose(at, d / 2, change)][fate[0] != FATE_NEAR]++;
}

static void fill_table(struct table *t, const struct orbit_motion *o) {
  for (int ph = 0; ph < N_PHASES; ph++)
    for (int k = 0; k < MOMENTS; k++) {
      struct coulomb_setup at;
      if (!orbit_at(&at, o, ph, (2 * k + 1) / (2.0 * MOMENTS))) continue;
      for (int d = 0; d < 2 * N_STATE; d++)
        for (int s = t->first; s < N_SIZES; s++) try_perturbation(t, o, &at, ph, d, s);
    }
}

static void say_table(struct behaviour *b, const struct table *t) {
  for (int ph = 0; ph < N_PHASES; ph++) {
    struct text line = {0};
    text_printf(&line,
                "perturbed in the %s phase (numbers of motions that stay near, depart and come back, end elsewhere, "
                "never again stick with both masses):",
                phase_words[ph]);
    long trials = 0;
    for (int d = 0; d < 2 * N_STATE; d++) {
      const long *c = t->count[ph][d];
      text_printf(&line, "%s %s%c %ld %ld %ld %ld", d ? "," : "", coordinate[d / 2], d % 2 ? '-' : '+', c[FATE_NEAR],
                  c[FATE_BACK], c[FATE_ELSEWHERE], c[FATE_NO_STICK]);
      if (c[FATE_OPEN]) text_printf(&line, " (%ld open)", c[FATE_OPEN]);
      for (int k = 0; k < N_FATES; k++) trials += c[k];
    }
    finding_state(b->f, b->j->out, "integration", "model", -1, trials, NULL, result_take(b->j->out, &line));
  }
}

/* "Only conditionally stable": holds when perturbations that keep r near die out, and when among arbitrarily small ones
   there are such that do not keep it near. */
static void judge_table(struct route_result w[N_MOTION_ROUTES], struct behaviour *b, const struct table *t,
                        double friction) {
  long near = t->total[FATE_NEAR], open = t->total[FATE_OPEN],
       all = near + open + t->total[FATE_BACK] + t->total[FATE_ELSEWHERE] + t->total[FATE_NO_STICK];
  const char *note = result_str(
      b->j->out,
      "a stable admissible orbit, with u_ri %g times the least possible, perturbed by %s at %d moments of each phase: "
      "%ld motions stay near and approach it, %ld depart and come back, %ld end elsewhere, %ld never again stick with "
      "both masses; %ld are undecided. Of the smallest perturbations, %ld free a sticking mass at once (slower than "
      "the belt while the force on it exceeds the sliding friction), and %ld of these depart; of the %ld others %ld do",
      friction, size_words[t->first], MOMENTS, near, t->total[FATE_BACK], t->total[FATE_ELSEWHERE],
      t->total[FATE_NO_STICK], open, t->smallest[1][0] + t->smallest[1][1], t->smallest[1][1],
      t->smallest[0][0] + t->smallest[0][1], t->smallest[0][1]);
  long far = t->smallest[0][1] + t->smallest[1][1];
  const char *where = far ? result_str(b->j->out, "departs: %s", motion_text(b, &t->departs)) : NULL;
  enum route_outcome outcome = open          ? ROUTE_UNDECIDED
                               : near && far ? ROUTE_AGREES
                               : near        ? ROUTE_DIFFERS
                                             : ROUTE_NOTHING;
  if (t->apart) outcome = ROUTE_UNDECIDED;
  behaviour_routes(w, b, (const enum route_outcome[]){outcome, outcome}, all, where, note);
}

bool behaviour_perturb(struct behaviour *b) {
  enum { FRICTIONS = 2 };
  static const double friction[FRICTIONS] = {OWN_FRICTION, 2};
  struct orbit_motion o;
  struct table t[FRICTIONS];
  struct route_result w[FRICTIONS * N_MOTION_ROUTES + 1];
  LOCAL(point, p);
  memset(t, 0, sizeof t);
  const struct dyn_orbit *orbit = behaviour_stable_orbit(&p, b);
  bool ok = orbit != NULL;
  struct route_result proof = {.outcome = ROUTE_UNDECIDED};
  if (ok) proof = stable_prove_conditional(b, &p, orbit);
  for (int k = FRICTIONS - 1; ok && k >= 0; k--) {
    double slope = fabs(num_arb.get_d(orbit->trace));
    ok = orbit_motion_make(&o, &p, orbit, friction[k]) ||
         claim_error(b->j, b->c, "at", "the orbit at these parameters cannot be simulated");
    o.periods = 6 + (long)ceil(log(1e-3) / log(fmin(0.99, fmax(1e-3, slope))));
    t[k].first = k == 0 ? 0 : N_SIZES - 1; /* the second friction with the smallest only */
    if (ok) fill_table(&t[k], &o);
  }
  for (int k = 0; ok && k < FRICTIONS; k++) judge_table(w + k * N_MOTION_ROUTES, b, &t[k], friction[k]);
  if (ok) {
    b->f->verdict = verdict_with_proof(w, FRICTIONS * N_MOTION_ROUTES, &proof);
    say_table(b, &t[0]);
  }
  return ok;
}
