/* Long runs beside orbits of different multipliers: do the routes in double precision leave MPFR, or stay with it, as
   tr J says?  What is judged has margins that no machine's rounding can use up; the figures are for run.json. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "motion/long_run.h"
#include "record/finding.h"
#include "studies.h"
#include "value/coulomb_setup.h"
#include "value/printed.h"

/* Parameters beside the scene's own, to cover the other kinds of multipliers with V and eta different from 1. */
static const struct {
  const char *why;
  const char *params[N_PARAMS];
  bool least; /* the admissible orbit with the least |tr J|, else with the largest */
} samples[] = {{"a stable orbit", {"0.71", "1.2", "1.9", "5.9", "0.158"}, true},
               {"an unstable orbit with tr J > 1", {"0.97", "0.87", "0.94", "0.82", "0.086"}, false},
               {"an unstable orbit with tr J < -1", {"0.95", "1.5", "1.2", "5.19", "0.201"}, false}};

/* Within a tenth of log|m|. */
static bool as_predicted(const struct long_growth *g, double multiplier) {
  double want = log(fabs(multiplier));
  return fabs(g->log - want) <= 0.1 * fabs(want);
}

/* Whether the run does what the multiplier says. */
static bool obeys(const struct long_run *run, double multiplier, struct long_result *r) {
  static const struct long_pair pairs[N_LONG_PAIRS] = {
      {LONG_ODE, LONG_CLOSED}, {LONG_ODE, LONG_MPFR}, {LONG_CLOSED, LONG_MPFR}};
  bool ok = true;
  for (int i = 0; i < N_LONG_PAIRS; i++) {
    struct long_growth g;
    bool grows = long_run_growth(&g, run, pairs[i]);
    r->machine_parting[i] = long_run_parting(run, pairs[i], 1e-6);
    r->machine_most[i] = long_run_most(run, pairs[i]);
    r->machine_growth[i] = grows ? exp(g.log) : (double)NAN;
    bool weak = fabs(multiplier) < 1.5; /* rounding may hold both routes on the orbit */
    if (fabs(multiplier) < 1)
      ok = ok && long_run_length(run, pairs[i]) == r->periods && r->machine_most[i] < 1e-9 * fmax(1, run->scale);
    else if (i > 0 || !weak)
      ok = ok && grows && as_predicted(&g, multiplier) && (weak || r->machine_parting[i] > 0);
  }
  return ok;
}

/* How many periods lie between the rounding of double precision and a distance of 1e-6. */
static double periods_to_part(double multiplier) {
  return log(1e-6 * ldexp(1, 52)) / log(fabs(multiplier));
}

/* Why nothing can be measured at this multiplier; NULL when it can. */
static const char *hopeless(const struct coulomb_setup *sim) {
  enum { MOST_PERIODS = 1500 };
  double multiplier = sim->trace;
  if (!long_run_has_room(sim->params, sim->start))
    return "between the rounding of positions, which grow as 1/(1 - chi), and the duration of the stick phase there is "
           "no room for a growth to show";
  if (fabs(multiplier) < 0.1) return "a displacement is gone before its rate can be measured";
  return fabs(periods_to_part(multiplier)) > MOST_PERIODS ? "tr J is too near to 1 or -1 for a growth to show" : NULL;
}

static void run_beside(struct long_result *r, const struct coulomb_setup *sim) {
  enum { BITS = 160, SLACK = 4 };
  OWNED(long_run) run;
  struct long_growth g;
  double duration = SLACK * (double)r->periods * sim->period;
  int status = long_run_make(&run, sim->params, sim->start, r->periods, duration, BITS);
  run.reach = long_run_reach(sim->params, sim->start);
  r->obeys = status != SS_DOMAIN && obeys(&run, sim->trace, r);
  bool grows = long_run_displaced(&g, sim->params, sim->start, sim->trace, duration);
  r->machine_displaced = grows ? exp(g.log) : (double)NAN;
  r->displaced = grows && as_predicted(&g, sim->trace);
}

static void add_run(struct judge *j, const fmpq params[N_PARAMS], const struct dyn_orbit *o, const char *name) {
  enum { STABLE_PERIODS = 100, MORE = 20 };
  struct audit_result *out = j->out;
  struct coulomb_setup sim;
  int status = coulomb_setup_on_orbit(&sim, params, o, OWN_FRICTION);
  const char *why = status ? "Coulomb's law does not follow it" : hopeless(&sim);
  if (why) {
    audit_leave_out(out, result_str(out, "long runs beside %s", name), why);
    return;
  }
  double part = periods_to_part(sim.trace);
  struct long_result r = {.orbit = name, .multiplier = ball_text(j, o->trace, 6)};
  r.periods = part < 0 ? STABLE_PERIODS : (long)ceil(part) + MORE;
  r.expected = part < 0 ? "never" : result_str(out, "about %ld periods", 5 * (long)ceil(part / 5));
  run_beside(&r, &sim);
  *SS_PUSH(out->long_runs, out->n_long_runs, out->cap_long_runs) = r;
}

static void beside_scene(struct judge *j) {
  LOCAL(point, p);
  if (scene_has_forces(j->scene) && nearest_orbit_point(&p, j->scene, j->cache)) {
    const struct dyn_orbit *o = &scene_orbits(j->scene, j->cache)->orbit[p.orbit];
    const char *name = result_str(j->out, "the scene's orbit %ld", (long)p.orbit + 1);
    if (o->admissible == TRUTH_TRUE && !o->grazing)
      add_run(j, j->scene->value, o, name);
    else
      audit_leave_out(j->out, result_str(j->out, "long runs beside %s", name), "Coulomb's law does not follow it");
  } else {
    const char *why = scene_has_forces(j->scene) ? "no orbit was found" : scene_lacks_forces(j->scene);
    audit_leave_out(j->out, "long runs beside the scene's own orbit", why);
  }
}

/* The admissible orbit with the least or the largest |tr J|; list->n when there is none. */
static slong pick(const struct dyn_orbits *list, bool least) {
  slong best = list->n;
  for (slong k = 0; k < list->n; k++) {
    const struct dyn_orbit *o = &list->orbit[k];
    if (o->admissible != TRUTH_TRUE || o->grazing) continue;
    bool less = best < list->n && fabs(num_arb.get_d(o->trace)) < fabs(num_arb.get_d(list->orbit[best].trace));
    if (best == list->n || less == least) best = k;
  }
  return best;
}

static void beside_sample(struct judge *j, size_t i) {
  fmpq params[N_PARAMS];
  OWNED(text) name = {0};
  text_printf(&name, "%s: ", samples[i].why);
  for (int k = 0; k < N_PARAMS; k++) {
    fmpq_init(params + k);
    num_parse_decimal(params + k, samples[i].params[k], strlen(samples[i].params[k]));
    text_printf(&name, "%s = %s, ", scene_key_name[KEY_CHI + k], samples[i].params[k]);
  }
  const struct dyn_orbits *list = orbit_cache_get(j->cache, params, FD_PREC + 64);
  slong best = pick(list, samples[i].least);
  if (best < list->n) {
    text_printf(&name, "orbit %ld", (long)best + 1);
    add_run(j, params, &list->orbit[best], result_str(j->out, "%s", text_str(&name)));
  } else {
    audit_leave_out(j->out, result_str(j->out, "long runs beside %s", samples[i].why), "no admissible orbit was found");
  }
  for (int k = 0; k < N_PARAMS; k++) fmpq_clear(params + k);
}

/* The control: no displacement may pass for one at a rate that is a quarter faster. */
static bool wrong_multiplier_noticed(const struct judge *j) {
  bool noticed = j->out->n_long_runs > 0;
  for (size_t i = 0; i < j->out->n_long_runs; i++) {
    const struct long_result *r = &j->out->long_runs[i];
    struct long_growth g = {.log = log(r->machine_displaced)};
    noticed = noticed && !as_predicted(&g, pow(fabs(strtod(r->multiplier, NULL)), 1.25));
  }
  return noticed;
}

void study_long_runs(struct judge *j) {
  beside_scene(j);
  for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) beside_sample(j, i);
  bool noticed = wrong_multiplier_noticed(j);
  audit_control(j->out, "long-runs-multiplier", "long runs", noticed ? VERDICT_REFUTED : VERDICT_SUPPORTED);
}
