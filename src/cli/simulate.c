/* stickslip simulate: the masses under Coulomb's law from a start on an orbit, at the printed numbers or of one's own,
   integrated by GSL; in the table and in JSON, held against the closed forms event by event. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "mech/moments.h"
#include "motion/coulomb.h"
#include "simulated.h"
#include "value/printed.h"

enum { MAX_STEPS = 10000000 }; /* of an integrator: many periods need more than a proof does */

/* What is simulated, and for how long. */
struct simulation {
  struct coulomb_setup setup;
  struct coulomb_plan plan;
  char from[32]; /* orbit:2, printed, or start */
};

/* --- The paper's two masses --- */

static struct mech_moment moment_of(const struct coulomb_row *r) {
  struct mech_moment at = {.t = r->t, .mass = -1};
  for (int i = 0; i < 2; i++) {
    at.z[i] = r->x[i];
    at.z[2 + i] = r->v[i];
    at.u[i] = r->u[i];
    at.phase[i] = coulomb_mode_letter[r->mode[i]];
  }
  return at;
}

/* Events at one instant share their row; here each changes one mass. */
static void motion_of(struct mech_motion *out, const struct coulomb_setup *setup, const struct coulomb_log *log) {
  enum coulomb_mode mode[2];
  *out = (struct mech_motion){.moment = ss_malloc((log->n + 1) * sizeof *out->moment), .n_moments = (int)log->n + 1};
  coulomb_law_d(mode, setup->params, setup->start);
  out->moment[0] =
      (struct mech_moment){.mass = -1, .phase = {coulomb_mode_letter[mode[0]], coulomb_mode_letter[mode[1]]}};
  memcpy(out->moment[0].z, setup->start, sizeof setup->start);
  for (size_t i = 0; i < log->n; i++) {
    const struct coulomb_event *e = &log->event[i];
    struct mech_moment *at = &out->moment[i + 1];
    *at = moment_of(&e->at);
    at->mass = e->mass;
    memcpy(at->phase, at[-1].phase, sizeof at->phase);
    at->phase[e->mass] = coulomb_mode_letter[e->to];
  }
}

static bool print_csv_row(void *self, const struct coulomb_row *r) {
  (void)self;
  struct mech_moment at = moment_of(r);
  csv_line(2, &at);
  return !ferror(stdout);
}

static bool print_csv_event(void *self, const struct coulomb_event *e) {
  return print_csv_row(self, &e->at);
}

/* A sink that stops does so because standard output is closed, which the end of the program reports. */
static int early_status(const struct coulomb_result *r) {
  if (r->end == COULOMB_DONE || r->end == COULOMB_STOPPED) return EXIT_AS_RECORDED;
  return ended_early(coulomb_end_name[r->end], "ode", r->at.t);
}

static int simulate_csv(const struct simulation *run) {
  struct coulomb_result r = {.end = COULOMB_FAILED};
  struct coulomb_sink sink = {NULL, print_csv_event, print_csv_row};
  csv_line(2, NULL);
  coulomb_simulate_ode(&r, run->setup.params, run->setup.start, &run->plan, &sink);
  return early_status(&r);
}

static void print_heading(const struct simulation *run, const struct scene *s) {
  struct text out = {0};
  text_printf(&out, "%s, %s: u_r1 = %.10g, u_r2 = %.10g\n%s", s->name, run->from, run->setup.params[COULOMB_UR1],
              run->setup.params[COULOMB_UR2],
              run->setup.own_friction ? "(where the scene gives none: 5/4 of what the orbits need)\n" : "");
  if (run->setup.broken)
    text_printf(&out, "%s is not admissible: it breaks a condition of Coulomb's law, and the motion is another\n",
                run->from);
  mech_table_heading(&out, 2, false);
  print_text(&out);
}

/* A line of the table, of an event that the log keeps. */
static bool print_event(void *self, const struct coulomb_event *e) {
  struct coulomb_sink keep = coulomb_log_sink(self);
  struct text out = {0};
  struct mech_moment at = moment_of(&e->at);
  at.mass = e->mass;
  at.phase[e->mass] = coulomb_mode_letter[e->to];
  mech_table_line(&out, 2, false, &at, coulomb_mode_letter[e->from]);
  text_add(&out, e->grazing ? "  grazing\n" : "\n");
  print_text(&out);
  return keep.event(keep.self, e) && !ferror(stdout);
}

static void print_end(const struct coulomb_log *ode, const struct coulomb_log *exact, const struct coulomb_result *r) {
  OWNED(text) word = {0}, folded = {0};
  size_t shared;
  double worst = coulomb_log_compare(&shared, ode, exact);
  puts(TABLE_UNITS "\nstick: with the belt; below, above: slower, faster than it");
  coulomb_log_word(&word, ode);
  coulomb_word_fold(&folded, text_str(&word));
  puts("word: the phases that begin after the start, in order, G for Gamma; ^3: three times over");
  printf("word %s\n", text_str(&folded));
  ended_line(r->at.t, r->returns, "return", " to the global stick phase", r->end ? coulomb_end_name[r->end] : NULL);
  routes_line((long)shared, (long)ode->n, worst);
}

static void print_json(const struct simulation *run, const struct scene *s, const struct coulomb_log *ode,
                       const struct coulomb_log *exact, const struct coulomb_result *r) {
  OWNED(mech_motion) main, other;
  motion_of(&main, &run->setup, ode);
  motion_of(&other, &run->setup, exact);
  main.t = r->at.t;
  simulated_json(&(struct simulated){s->name, NULL, run->from, 2, N_STATE, &main, &other}, coulomb_end_name[r->end]);
}

/* The lines of the table are printed as the events come. */
static int simulate_events(const struct simulation *run, const struct scene *s, bool json) {
  OWNED(coulomb_log) ode = {.n = 0}, exact = {.n = 0};
  struct coulomb_result r = {.end = COULOMB_FAILED}, r_exact;
  struct coulomb_sink sink = coulomb_log_sink(&ode), sink_exact = coulomb_log_sink(&exact);
  if (!json) {
    print_heading(run, s);
    sink = (struct coulomb_sink){.self = &ode, .event = print_event};
  }
  coulomb_simulate_ode(&r, run->setup.params, run->setup.start, &run->plan, &sink);
  coulomb_simulate_d(&r_exact, run->setup.params, run->setup.start, &run->plan, &sink_exact);
  if (json)
    print_json(run, s, &ode, &exact, &r);
  else
    print_end(&ode, &exact, &r);
  return early_status(&r);
}

/* --- The command --- */

static int usage_of(const struct options *o, long *periods, long *samples, double *time) {
  *periods = 1;
  *samples = DEFAULT_SAMPLES;
  int status = parse_count(periods, o, OPT_PERIODS, MAX_PERIODS);
  if (!status) status = parse_count(samples, o, OPT_SAMPLES, MAX_SAMPLES);
  if (!status) status = parse_decimal(time, o, OPT_TIME, MOST_TIME);
  if (status) return status;
  if (option(o, OPT_COMPARE) && *periods > MAX_COMPARED)
    return usage("--periods takes at most %d with --compare", MAX_COMPARED);
  return EXIT_AS_RECORDED;
}

int run_simulate(const struct options *o, const char *data, struct diag *d) {
  const char *start = option(o, OPT_START);
  enum { SLACK = 4 };
  long periods, samples;
  double time;
  slong orbit;
  bool printed;
  int status = usage_of(o, &periods, &samples, &time);
  if (!status) status = parse_start(&orbit, &printed, o);
  if (status) return status;
  OWNED(scene) s;
  struct simulation run = {.plan = coulomb_plan_default};
  bool ok = load_scene(&s, o->operands.word[0], data, o, SCENE_EXACT_OR_SYSTEM, d);
  if (ok && s.system)
    return run_system_simulate(o, &s, data, &(struct system_run){orbit < 0 ? 0 : orbit, periods, samples, time}, d);
  if (ok && orbit < 0) orbit = scene_usual_orbit(&s);
  if (start || printed)
    snprintf(run.from, sizeof run.from, "%s", start ? "start" : "printed");
  else
    snprintf(run.from, sizeof run.from, "orbit:%ld", (long)orbit + 1);
  ok = ok && (start ? audit_coulomb_setup_from(&run.setup, &s, start, d)
                    : audit_coulomb_setup(&run.setup, &s, orbit, printed, d));
  if (ok) {
    double period = run.setup.period > 0 ? run.setup.period : 100;
    run.plan.returns = time > 0 ? 0 : periods;
    run.plan.max_steps = MAX_STEPS;
    /* a motion that never sticks again ends all the same */
    run.plan.duration = time > 0 ? time : SLACK * (double)periods * period;
    if (option(o, OPT_CSV)) run.plan.sample = period / (double)samples;
    if (option(o, OPT_COMPARE))
      status = compare_routes(&run.setup, &s, run.from, periods, run.plan.duration);
    else
      status = option(o, OPT_CSV) ? simulate_csv(&run) : simulate_events(&run, &s, option(o, OPT_JSON) != NULL);
  }
  return status;
}
