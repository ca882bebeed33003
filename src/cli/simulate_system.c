/* stickslip simulate on a scene that names a system file. */
#include <math.h>
#include <string.h>

#include "mech/describe.h"
#include "mech/orbit.h"
#include "simulated.h"
#include "word_orbits.h"

enum { MOST_LOOKS = 1000000, WORK = 100000000, MOST_DURATION = 1000000, NO_ORBIT_TIME = 100 };

struct system_simulation {
  struct mech m;
  struct mech_word word;     /* that the scene names, or of no phases */
  struct mech_orbits orbits; /* searched for without --start */
  const struct mech_orbit *orbit;
  char at[32]; /* where it starts */
  double start[MECH_STATES], period;
  struct mech_plan plan;
};

static int usage_of_system(const struct options *o) {
  const char *at = option(o, OPT_AT);
  if (option(o, OPT_COMPARE) || (at && strcmp(at, "printed") == 0))
    return usage("%s is of the paper's two masses", option(o, OPT_COMPARE) ? "--compare" : "--at printed");
  if (option(o, OPT_START) && option(o, OPT_PERIODS))
    return usage("--periods counts those of an orbit, and a --start has none: give --time");
  return EXIT_AS_RECORDED;
}

/* --- The start --- */

static bool start_given(struct system_simulation *run, const char *text, struct diag *d) {
  const struct mech *m = &run->m;
  char takes[100], coordinates[40] = "x1,v1";
  int n = 2 * m->n + (m->n_loads > 0);
  if (m->n > 1) snprintf(coordinates, sizeof coordinates, "x1,...,x%d,v1,...,v%d", m->n, m->n);
  snprintf(takes, sizeof takes, "%d constant expressions, %s%s", n, coordinates,
           m->n_loads ? " and the angle of the loads" : "");
  snprintf(run->at, sizeof run->at, "start");
  if (!coulomb_start_read(run->start, n, text, takes, d)) return false;
  if (m->n_loads) mech_at_angle(run->start + 2 * m->n, m, run->start[2 * m->n]);
  return true;
}

static bool start_on_orbit(struct system_simulation *run, const struct scene *s, const struct options *o, slong orbit,
                           struct diag *d) {
  progress_begin();
  mech_orbits_find(&run->orbits, &run->m, run->word.n ? &run->word : NULL, false, system_bits(DEFAULT_DIGITS),
                   &(struct mech_tell){progress_count, 0, MECH_SEARCHED});
  progress_end();
  bool there = orbit < run->orbits.n;
  if (!there && (option(o, OPT_AT) || option(o, OPT_PERIODS))) return scene_lacks_orbit(s, orbit, run->orbits.n, d);
  if (!there) {
    mech_first_start(run->start, &run->m);
    snprintf(run->at, sizeof run->at, "search");
    return true;
  }
  run->orbit = &run->orbits.orbit[orbit];
  run->period = arf_get_d(arb_midref(run->orbit->period), ARF_RND_NEAR);
  run->plan.phase = run->orbit->word.phase[0];
  for (int i = 0; i < run->m.states; i++) run->start[i] = arf_get_d(arb_midref(run->orbit->state + i), ARF_RND_NEAR);
  snprintf(run->at, sizeof run->at, "orbit:%ld", (long)orbit + 1);
  return true;
}

/* A start on an orbit is on it but for rounding. */
static bool starts_clear(const struct system_simulation *run, const struct scene *s, struct diag *d) {
  for (int k = 0; !run->orbit && k < 2 * run->m.n; k++) {
    const struct mech_mass *mass = &run->m.mass[k / 2];
    const struct mech_stop *stop = &mass->stop[k % 2];
    double x = run->start[k / 2], to = fmpq_get_d(stop->position);
    if (!stop->given || (k % 2 ? x <= to : x >= to)) continue;
    return diag_set(d, "%s: error: %s starts at %.10g, beyond the obstacle %s at %.10g", s->path, mass->name, x,
                    stop->name, to);
  }
  return true;
}

/* A millionth of a period more than asked for, so that the event that ends the last one is in it. */
static bool set_plan(struct system_simulation *run, const struct scene *s, const struct system_run *asked, bool csv,
                     struct diag *d) {
  int side = run->m.states + 1;
  double orbits = run->orbit ? ((double)asked->periods + 1e-6) * run->period : NO_ORBIT_TIME;
  run->plan.duration = asked->time > 0 ? asked->time : orbits;
  run->plan.most = MOST_LOOKS; /* more than the steps allow */
  run->plan.looks = WORK / (side * side) < MOST_LOOKS ? WORK / (side * side) : MOST_LOOKS;
  if (csv) run->plan.sample = (run->orbit ? run->period : run->plan.duration) / (double)asked->samples;
  if (run->plan.duration <= MOST_DURATION) return true;
  return diag_set(d, "%s: error: so many periods take longer than a time of %d", s->path, MOST_DURATION);
}

/* --- Output --- */

static bool print_row(void *self, const struct mech_moment *at) {
  csv_line(*(const int *)self, at);
  return !ferror(stdout);
}

static void print_start(const struct system_simulation *run, const struct mech_motion *x, const struct scene *s) {
  int n = run->m.n;
  printf("%s: the system %s from ", s->name, s->system);
  if (run->orbit)
    printf("%s of %d found, period %.10g%s\n", run->at, run->orbits.n, run->period,
           run->orbit->admissible == TRUTH_FALSE ? ", not admissible: the motion is another" : "");
  else
    puts(strcmp(run->at, "start") == 0 ? "--start" : "the first start of the search, which finds no orbit");
  printf("start: phase %s, x", x->moment[0].phase);
  for (int i = 0; i < 2 * n; i++) printf("%s %.10g", i == n ? ", v" : "", x->moment[0].z[i]);
  if (run->m.n_loads) printf(", load angle %.10g", atan2(run->start[2 * n + 1], run->start[2 * n]));
  putchar('\n');
}

static void print_names(const struct mech *m) {
  struct text out = {0};
  mech_names_print(&out, m);
  print_text(&out);
}

/* What becomes of it. */
static void print_fate(const struct system_simulation *run, const struct mech_motion *x) {
  struct mech_word w;
  OWNED(text) word = {0};
  double period, gap, last = x->moment[x->n_moments - 1].t;
  if (x->n_moments > 1 && x->t - last > x->t / 2) {
    printf("no event after t = %.10g\n", last);
  } else if (mech_settles(&w, &period, &gap, x, run->m.n, run->m.states)) {
    mech_word_print(&word, &w);
    printf("settles on: %s, period %.10g; the last return is within %.1e\n", text_str(&word), period, gap);
  } else {
    puts(x->n_moments == 1 ? "no event"
                           : "not seen to settle: no earlier event has the phase and state of the last one");
  }
  ended_line(x->t, x->n_moments - 1, "event", "", x->end ? mech_outcome_name[x->end] : NULL);
}

static void print_events(const struct mech_motion *x, int n) {
  struct text out = {0};
  mech_table_heading(&out, n, true);
  for (int i = 1; i < x->n_moments; i++) {
    const struct mech_moment *at = &x->moment[i];
    mech_table_line(&out, n, true, at, at[-1].phase[at->mass]);
    text_add_char(&out, '\n');
  }
  print_text(&out);
}

static int print_motion(struct system_simulation *run, const struct scene *s, const struct options *o, struct diag *d) {
  OWNED(mech_motion) x, exact;
  bool csv = option(o, OPT_CSV) != NULL;
  if (csv) {
    run->plan.self = &run->m.n;
    run->plan.told = print_row;
  }
  int status = mech_simulate(&x, MECH_INTEGRATED, &run->m, run->start, &run->plan);
  exact = (struct mech_motion){.n_moments = 0};
  if (status == SS_DOMAIN) {
    diag_set(d, "%s: error: a force, or a number of the system, is too large or too small for a double", s->path);
  } else if (!csv) {
    mech_simulate(&exact, MECH_PATCHED, &run->m, run->start, &run->plan);
    struct simulated shown = {s->name, s->system, run->at, run->m.n, run->m.states, &x, &exact};
    if (option(o, OPT_JSON)) {
      simulated_json(&shown, mech_outcome_name[x.end]);
    } else {
      print_start(run, &x, s);
      print_events(&x, run->m.n);
      print_names(&run->m);
      puts("stick: with its surface; below, above: slower, faster than it; phases as in docs/systems.md");
      print_fate(run, &x);
      int shared;
      double worst = mech_compare(&shared, &x, &exact, run->m.n);
      routes_line(shared, x.n_moments - 1, worst);
    }
  }
  if (status == SS_UNABLE) ended_early(mech_outcome_name[x.end], "ode", x.t);
  return status == SS_UNABLE ? EXIT_INTERNAL : EXIT_AS_RECORDED;
}

int run_system_simulate(const struct options *o, const struct scene *s, const char *data,
                        const struct system_run *asked, struct diag *d) {
  struct system_simulation run = {.period = 0};
  const char *start = option(o, OPT_START);
  int status = usage_of_system(o);
  if (status) return status;
  bool ok = scene_load_system(&run.m, &run.word, s, data, false, d);
  ok = ok && (start ? start_given(&run, start, d) : start_on_orbit(&run, s, o, asked->orbit, d));
  ok = ok && starts_clear(&run, s, d) && set_plan(&run, s, asked, option(o, OPT_CSV) != NULL, d);
  if (ok && option(o, OPT_CSV)) csv_line(run.m.n, NULL);
  if (ok) status = print_motion(&run, s, o, d);
  mech_orbits_clear(&run.orbits);
  mech_clear(&run.m);
  return status;
}
