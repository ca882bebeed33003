/* stickslip simulate: the two masses under Coulomb's law from a start on an orbit, at the printed numbers or of one's
   own, integrated by GSL; in the table, held against the closed forms event by event. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "motion/coulomb.h"
#include "value/printed.h"

enum { MAX_PERIODS = 100000, MAX_SAMPLES = 1000000, DEFAULT_SAMPLES = 100, MAX_COMPARED = 10000 };
enum { MAX_STEPS = 10000000 }; /* of an integrator: many periods need more than a proof does */

/* What is simulated, and for how long. */
struct simulation {
  struct coulomb_setup setup;
  struct coulomb_plan plan;
  char from[32]; /* orbit:2, printed, or --start */
};

static int parse_count(long *n, const char *text, long most, const char *option) {
  if (!text) return EXIT_AS_RECORDED;
  char *end;
  errno = 0;
  *n = strtol(text, &end, 10);
  if (!errno && !*end && text[0] >= '1' && text[0] <= '9' && *n >= 1 && *n <= most) return EXIT_AS_RECORDED;
  char what[80];
  snprintf(what, sizeof what, "%s takes a whole number from 1 to %ld", option, most);
  return usage("%s", what);
}

/* --- Output --- */

static bool print_csv_row(void *self, const struct coulomb_row *r) {
  struct text *line = self;
  text_reset(line);
  coulomb_csv_row(line, r);
  return fputs(text_str(line), stdout) >= 0;
}

static bool print_csv_event(void *self, const struct coulomb_event *e) {
  return print_csv_row(self, &e->at);
}

int ended_early(enum coulomb_end end, const char *route, double t) {
  fprintf(stderr, "simulate: error: the route %s ended early, at t = %.10g: %s\n", route, t, coulomb_end_name[end]);
  return EXIT_INTERNAL;
}

/* A sink that stops does so because standard output is closed, which the end of the program reports. */
static bool is_early(enum coulomb_end end) {
  return end != COULOMB_DONE && end != COULOMB_STOPPED;
}

static int simulate_csv(const struct simulation *run) {
  struct coulomb_result r = {.end = COULOMB_FAILED};
  struct text line;
  text_init(&line);
  struct coulomb_sink sink = {&line, print_csv_event, print_csv_row};
  fputs(coulomb_csv_header, stdout);
  coulomb_simulate_ode(&r, run->setup.params, run->setup.start, &run->plan, &sink);
  text_clear(&line);
  return is_early(r.end) ? ended_early(r.end, "ode", r.at.t) : EXIT_AS_RECORDED;
}

static int simulate_table(const struct simulation *run, const struct scene *s) {
  struct coulomb_log ode, exact;
  struct coulomb_result r = {.end = COULOMB_FAILED}, r_exact;
  struct text word, folded;
  coulomb_log_init(&ode);
  coulomb_log_init(&exact);
  text_init(&word);
  text_init(&folded);
  struct coulomb_sink sink = coulomb_log_sink(&ode), sink_exact = coulomb_log_sink(&exact);
  coulomb_simulate_ode(&r, run->setup.params, run->setup.start, &run->plan, &sink);
  coulomb_simulate_d(&r_exact, run->setup.params, run->setup.start, &run->plan, &sink_exact);
  printf("%s, %s: u_r1 = %.10g, u_r2 = %.10g\n%s", s->name, run->from, run->setup.params[COULOMB_UR1],
         run->setup.params[COULOMB_UR2],
         run->setup.own_friction ? "(where the scene gives none: 5/4 of what the orbits need)\n" : "");
  printf("%11s %-4s %-13s %12s %12s %10s %10s\n", "t", "mass", "change", "x1", "x2", "v1", "v2");
  for (size_t i = 0; i < ode.n; i++) {
    const struct coulomb_event *e = &ode.event[i];
    printf("%11.7f m%-3d %-5s > %-5s %12.8f %12.8f %10.6f %10.6f%s\n", e->at.t, e->mass + 1, coulomb_mode_name[e->from],
           coulomb_mode_name[e->to], e->at.x[0], e->at.x[1], e->at.v[0], e->at.v[1], e->grazing ? "  grazing" : "");
  }
  puts("all without dimensions; stick: with the belt; below, above: slower, faster than it");
  coulomb_log_word(&word, &ode);
  coulomb_word_fold(&folded, text_str(&word));
  puts("word: the phases in order, G for Gamma; ^3: three times over");
  printf("word %s\nended: %s at t = %.10f after %ld returns to the global stick phase\n", text_str(&folded),
         coulomb_end_name[r.end], r.at.t, r.returns);
  size_t shared;
  double worst = coulomb_log_compare(&shared, &ode, &exact);
  printf("closed forms: the first %zu of %zu events are the same, times and states within %.1e\n", shared, ode.n,
         worst);
  text_clear(&folded);
  text_clear(&word);
  coulomb_log_clear(&exact);
  coulomb_log_clear(&ode);
  return is_early(r.end) ? ended_early(r.end, "ode", r.at.t) : EXIT_AS_RECORDED;
}

int run_simulate(const struct options *o, const char *data) {
  const char *start = option(o, OPT_START);
  enum { SLACK = 4 };
  long periods = 1, samples = DEFAULT_SAMPLES;
  slong orbit;
  bool printed;
  int status = parse_count(&periods, option(o, OPT_PERIODS), MAX_PERIODS, "--periods");
  if (!status) status = parse_count(&samples, option(o, OPT_SAMPLES), MAX_SAMPLES, "--samples");
  if (!status) status = parse_start(&orbit, &printed, o);
  if (!status && option(o, OPT_AT) && start) status = usage("%s", "--at and --start exclude each other");
  if (status) return status;
  if (option(o, OPT_COMPARE) && (option(o, OPT_CSV) || option(o, OPT_SAMPLES)))
    return usage("--compare goes with neither %s", "--csv nor --samples");
  if (option(o, OPT_COMPARE) && periods > MAX_COMPARED)
    return usage("--periods takes at most 10000 with %s", "--compare");
  if (o->operands.n != 1) return usage("simulate takes one %s", "SCENE");
  struct diag d;
  struct scene s;
  struct simulation run = {.plan = coulomb_plan_default};
  diag_init(&d);
  bool ok = load_scene(&s, o->operands.word[0], data, o, SCENE_EXACT, &d);
  if (ok && orbit < 0) orbit = scene_usual_orbit(&s);
  if (start || printed)
    snprintf(run.from, sizeof run.from, "%s", start ? "--start" : "printed");
  else
    snprintf(run.from, sizeof run.from, "orbit:%ld", (long)orbit + 1);
  ok = ok && (start ? audit_coulomb_setup_from(&run.setup, &s, start, &d)
                    : audit_coulomb_setup(&run.setup, &s, orbit, printed, &d));
  if (ok) {
    double period = run.setup.period > 0 ? run.setup.period : 100;
    run.plan.returns = periods;
    run.plan.max_steps = MAX_STEPS;
    run.plan.duration = SLACK * (double)periods * period; /* a motion that never sticks again ends all the same */
    if (option(o, OPT_CSV)) run.plan.sample = period / (double)samples;
    if (option(o, OPT_COMPARE))
      status = compare_routes(&run.setup, &s, run.from, periods, run.plan.duration);
    else
      status = option(o, OPT_CSV) ? simulate_csv(&run) : simulate_table(&run, &s);
  } else {
    status = bad_input(&d);
  }
  scene_clear(&s);
  return status;
}
