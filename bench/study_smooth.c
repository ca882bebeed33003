/* Smoothed friction: does the periodic motion of a smooth law tend to the event-driven orbit as its slope grows?

   Two scenes: a stable orbit, to which long runs lead by themselves, and the paper's, which is unstable and is found by
   Newton's iteration on the return to a section (shooting).  The section lies where the second mass slides, at a part
   of its greatest lag behind the belt.  Reference: the event-driven orbit's passage of the same section, by the closed
   forms. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "bench/figure.h"
#include "bench/jobs.h"
#include "bench/smooth.h"
#include "bench/study.h"
#include "scene/scene.h"

enum { UNKNOWNS = 3, MOST_RETURNS = 30, MOST_NEWTON = 10 };
static const double tolerance = 1e-9;
static const double sticks = 0.25; /* both masses as near to the belt, in units of V, are said to stick */

/* The event-driven orbit, on the section. */
struct reference {
  const char *name;
  bool shoot;
  double p[N_PARAMS], limit[2];
  double period, trace, level, middle; /* middle: from the section to the middle of the next stick phase */
  double y[STEPPER_SIZE];
};

static void state_at(double y[STEPPER_SIZE], const struct reference *r, enum phase ph, const double z[N_STATE],
                     double t) {
  struct num_ctx ctx = num_ctx_double();
  double moved[N_STATE];
  struct num_vec params = {ctx, N_PARAMS, (char *)(size_t)r->p}, in = {ctx, N_STATE, (char *)(size_t)z},
                 out = {ctx, N_STATE, (char *)moved};
  dyn_flow(&out, ph, &params, &in, &t);
  y[S_W] = moved[Z_1] - r->p[P_CHI] * moved[Z_2];
  y[S_R] = moved[Z_2] - moved[Z_1];
  y[S_P] = moved[DZ_1] - r->p[P_V];
  y[S_Q] = moved[DZ_2] - r->p[P_V];
}

/* The motion while the second mass slides, phases H and C: the time from the start of H. */
struct slide {
  const struct reference *r;
  const double *t, *z[2]; /* of the phases; the states Z_b and Z_c */
};

static double lag_at(double y[STEPPER_SIZE], const struct slide *s, double at) {
  bool late = at > s->t[PHASE_H];
  state_at(y, s->r, late ? PHASE_C : PHASE_H, s->z[late], late ? at - s->t[PHASE_H] : at);
  return y[S_Q];
}

enum { SAMPLES = 800 };

/* How often the lag falls through the level, and the sample after which it first does. */
static int count_passages(int *first, const struct slide *s, double level) {
  double y[STEPPER_SIZE], end = s->t[PHASE_H] + s->t[PHASE_C], before = 0;
  int n = 0;
  for (int k = 1; k <= SAMPLES; k++) {
    double q = lag_at(y, s, end * k / SAMPLES);
    if (before > level && q <= level && n++ == 0) *first = k - 1;
    before = q;
  }
  return n;
}

/* The level is a part of the greatest lag, as small a one as makes passages through it happen once in a period; returns
   the time of this passage. */
static double find_section(struct reference *r, const double t[N_PHASES], const double *states) {
  static const double part[] = {0.5, 0.75, 0.875, 0.9375};
  struct slide s = {r, t, {states + 2 * N_STATE, states + 3 * N_STATE}};
  double y[STEPPER_SIZE], least = 0, end = t[PHASE_H] + t[PHASE_C];
  int first = 0;
  for (int k = 0; k <= SAMPLES; k++) least = fmin(least, lag_at(y, &s, end * k / SAMPLES));
  for (int k = 0; k < COUNT(part); k++) {
    r->level = part[k] * least;
    if (count_passages(&first, &s, r->level) == 1) break;
  }
  double low = end * first / SAMPLES, high = end * (first + 1) / SAMPLES;
  for (int i = 0; i < 80; i++) {
    double mid = 0.5 * (low + high);
    if (lag_at(y, &s, mid) > r->level)
      low = mid;
    else
      high = mid;
  }
  lag_at(r->y, &s, high);
  r->y[S_Q] = r->level;
  return high;
}

static bool reference_of(struct reference *r, const struct dyn_orbit *o) {
  struct num_ctx ctx = num_ctx_double();
  struct num_vec params = {ctx, N_PARAMS, (char *)r->p};
  OWNED(dyn_arc) arc;
  arb_srcptr bound[2] = {o->u_r1_min, o->u_r2_min};
  for (int i = 0; i < 2; i++) r->limit[i] = 1.25 * fmax(r->p[P_E1 + i], num_arb.get_d(bound[i]));
  dyn_arc_init(&arc, ctx);
  double z10 = num_arb.get_d(o->z10), z20 = num_arb.get_d(o->z20);
  bool good = dyn_arc_run(&arc, &params, &z10, &z20, o->guess) == SS_OK;
  if (good) {
    const double *t = (const double *)(const void *)arc.t.data;
    double at = find_section(r, t, (const double *)(const void *)arc.z.data);
    r->period = num_arb.get_d(o->period);
    r->trace = num_arb.get_d(o->trace);
    r->middle = r->period + 0.5 * t[PHASE_D] - (t[PHASE_D] + t[PHASE_GAMMA] + at);
  }
  return good;
}

/* The first admissible orbit of a scene on file. */
static bool load_reference(struct reference *r, const char *name, bool shoot, const struct bench_env *env) {
  struct diag d = {0};
  OWNED(dyn_orbits) list = {.n = 0};
  bool good = false;
  *r = (struct reference){.name = name, .shoot = shoot};
  if (!env->data) return false;
  OWNED(scene) s;
  if (scene_load_with(&s, name, env->data, NULL, SCENE_EXACT, &d)) {
    for (int i = 0; i < N_PARAMS; i++) r->p[i] = fmpq_get_d(&s.value[i]);
    dyn_orbits_find(&list, s.value, 128, NULL);
    for (slong i = 0; i < list.n && !good; i++)
      good = list.orbit[i].admissible == TRUTH_TRUE && reference_of(r, &list.orbit[i]);
  }
  return good;
}

/* --- The periodic motion of a smooth law. --- */

struct motion {
  const char *state;
  double y[STEPPER_SIZE], period, creep, nearest, change; /* change: of the state in the last return, over its size */
  long steps;
  int returns;
  double seconds; /* of a return, the mean */
};

struct smooth_run {
  const struct reference *ref;
  struct smooth_way way;
};

static double distance(const double a[UNKNOWNS], const double b[UNKNOWNS]) {
  double off = 0, size = 0;
  for (int i = 0; i < UNKNOWNS; i++) {
    off = fmax(off, fabs(a[i] - b[i]));
    size = fmax(size, fabs(b[i]));
  }
  return off / size;
}

static int go_round(struct motion *o, double y[STEPPER_SIZE], const struct smooth_run *run) {
  struct smooth_passage s;
  double before[STEPPER_SIZE];
  memcpy(before, y, sizeof before);
  int status = smooth_return(&s, y, &run->way);
  o->steps += s.steps;
  o->returns++;
  o->period = s.time;
  o->creep = s.creep / run->ref->p[P_V];
  o->nearest = s.nearest / run->ref->p[P_V];
  o->change = distance(y, before);
  return status;
}

static int long_run(struct motion *o, const struct smooth_run *run) {
  int status = SS_OK;
  do status = go_round(o, o->y, run);
  while (!status && o->change > 20 * tolerance && o->returns < MOST_RETURNS);
  return status;
}

/* x <- x - (P' - I)^-1 (P(x) - x), P' by differences. */
static int newton_step(struct motion *o, double *moved, const struct smooth_run *run) {
  double a[UNKNOWNS * UNKNOWNS], b[UNKNOWNS], image[STEPPER_SIZE], before[UNKNOWNS];
  memcpy(image, o->y, sizeof image);
  int status = go_round(o, image, run);
  struct motion first = *o;
  for (int k = 0; k < UNKNOWNS && !status; k++) {
    double y[STEPPER_SIZE], h = 1e-5 * fabs(run->ref->y[S_W]);
    memcpy(y, o->y, sizeof y);
    y[k] += h;
    status = go_round(o, y, run);
    for (int i = 0; i < UNKNOWNS; i++) a[i * UNKNOWNS + k] = (y[i] - image[i]) / h - (i == k);
  }
  if (status) return status;
  for (int i = 0; i < UNKNOWNS; i++) b[i] = o->y[i] - image[i];
  const struct num_vec lead = {num_ctx_double(), UNKNOWNS * UNKNOWNS, (char *)a};
  struct num_vec step = {num_ctx_double(), UNKNOWNS, (char *)b};
  if (num_mat_solve(&step, &lead, &step, UNKNOWNS, 1)) return SS_UNABLE;
  memcpy(before, o->y, sizeof before);
  for (int i = 0; i < UNKNOWNS; i++) o->y[i] += b[i];
  *moved = distance(o->y, before);
  o->period = first.period;
  o->creep = first.creep;
  o->nearest = first.nearest;
  o->change = first.change;
  return isfinite(*moved) ? SS_OK : SS_UNABLE;
}

static int shoot(struct motion *o, const struct smooth_run *run) {
  double moved = INFINITY;
  int status = SS_OK;
  for (int i = 0; i < MOST_NEWTON && !status && moved > 1e-8; i++) status = newton_step(o, &moved, run);
  return status;
}

static void find_motion(struct motion *o, const struct reference *ref, const struct smooth *m, const char *solver,
                        long most_steps) {
  struct stepper_system system = smooth_system(m, tolerance, ref->period / 100);
  struct smooth_run run = {ref, {m, stepper_open(solver, &system), ref->middle, 20 * ref->period, most_steps}};
  *o = (struct motion){.state = "cannot be set up", .period = NAN, .creep = NAN, .change = NAN, .seconds = NAN};
  if (!run.way.stepper) return;
  memcpy(o->y, ref->y, sizeof o->y);
  double begin = bench_now();
  int status = ref->shoot ? shoot(o, &run) : long_run(o, &run);
  o->seconds = (bench_now() - begin) / o->returns;
  bool settled = o->change <= (ref->shoot ? 1e-6 : 20 * tolerance);
  o->state = status & SS_UNABLE   ? "gives up"
             : status & SS_DOMAIN ? "no return"
             : settled            ? o->nearest < sticks ? "periodic" : "periodic without a stick phase"
                                  : "does not settle";
  stepper_close(run.way.stepper);
}

/* --- The tables. --- */

static const char *const solvers[] = {"rk8pd", "bsimp", "msbdf",
#ifdef STICKSLIP_SUNDIALS
                                      "cvode-bdf"
#endif
};
enum { DECADES = 8, QUICK_SOLVER = 1 }; /* quick runs go without the first */

static void add_run(struct study_table *t, const struct reference *ref, enum smooth_law law, int decade,
                    const char *solver, const struct motion *o) {
  bool periodic = strncmp(o->state, "periodic", 8) == 0;
  study_cells(t, "%s\t%s\t1e%d\t%s\t%s\t%d", ref->name, smooth_law_name[law], decade, solver, o->state, o->returns);
  if (periodic)
    study_cells(t, "%.10g\t%.3g\t%.3g\t%.3g", o->period, fabs(o->period - ref->period) / ref->period,
                distance(o->y, ref->y), o->creep);
  else
    study_cells(t, "-\t-\t-\t-");
  study_cells(t, "%.4g\t%.3g", (double)o->steps / fmax(1, o->returns), o->seconds);
  study_row(t);
}

/* How the errors of one solver fall from decade to decade. */
struct fall {
  double period[DECADES + 1], state[DECADES + 1], creep[DECADES + 1];
};

static double rate(const double *x, int k) {
  return k > 1 ? log10(x[k - 1] / x[k]) : (double)NAN;
}

static void add_rates(struct study_table *t, const struct reference *ref, enum smooth_law law, const struct fall *f,
                      int decades) {
  for (int k = 1; k <= decades; k++) {
    study_cells(t, "%s\t%s\t1e%d\t%.3g\t%.3g\t%.3g\t%.3g\t%.3g\t%.3g", ref->name, smooth_law_name[law], k, f->period[k],
                rate(f->period, k), f->state[k], rate(f->state, k), f->creep[k], rate(f->creep, k));
    study_row(t);
  }
}

/* One line: the mean rate over the upper half of the decades, where there are errors at both of its ends. */
static void say_rate(struct text *out, const struct reference *ref, enum smooth_law law, const struct fall *f,
                     int decades) {
  int from = decades / 2, any = 0;
  for (int k = 1; k <= decades; k++) any += isfinite(f->state[k]);
  text_printf(out, "- %s, %s: ", ref->name, smooth_law_name[law]);
  double period = log10(f->period[from] / f->period[decades]) / (decades - from);
  double state = log10(f->state[from] / f->state[decades]) / (decades - from);
  if (any == 0)
    text_printf(out, "no periodic motion with a stick phase at any of the %d slopes\n", decades);
  else if (isfinite(state))
    text_printf(out, "from s = 1e%d to 1e%d the state's error falls as s^-%.3f, the period's as s^-%.3f\n", from,
                decades, state, period);
  else
    text_printf(out, "a periodic motion with a stick phase at %d of %d slopes\n", any, decades);
}

/* The periodic motion of the first solver that has one, by slope. */
static void keep(struct fall *f, int k, const struct reference *ref, const struct motion *o) {
  if (isfinite(f->period[k]) || strcmp(o->state, "periodic") != 0) return;
  f->period[k] = fabs(o->period - ref->period) / ref->period;
  f->state[k] = distance(o->y, ref->y);
  f->creep[k] = o->creep;
}

static const char *const scenes[] = {"stable", "paper"};

static void draw(struct study_page *page, const struct study_table *rates) {
  struct figure f = {.id = "smooth", .title = page->study->title, .panels = 1};
  f.panel[0] = (struct figure_panel){
      .x = "slope *s*", .y = "distance from the event-driven orbit, relative", .power = {true, true}};
  OWNED(rows) t;
  char name[2 * N_LAWS][40];
  rows_parse(&t, text_str(&rates->tsv));
  for (int k = 0; k < 2 * N_LAWS; k++) {
    const char *scene = scenes[k / N_LAWS], *law = smooth_law_name[k % N_LAWS];
    snprintf(name[k], sizeof name[k], "%s, %s", scene, law);
    figure_curve(&f, name[k]);
    for (size_t i = 0; i < t.n; i++)
      if (rows_is(&t, i, rows_column(&t, "scene"), scene) && rows_is(&t, i, rows_column(&t, "law"), law))
        figure_point(&f, 0, log10(rows_number(&t, i, rows_column(&t, "s"))),
                     log10(rows_number(&t, i, rows_column(&t, "state_error"))));
  }
  figure_svg(&page->figure, &f);
}

static bool run_smooth(struct study_page *page, const struct bench_env *env) {
  int decades = page->quick ? 4 : DECADES, first = page->quick ? QUICK_SOLVER : 0;
  struct study_table *orbits =
      study_table(page, "orbits", "The event-driven orbits", "scene\tperiod\ttrace\tu_s1\tu_r1\tu_s2\tu_r2\tsection",
                  "The static limits are 5/4 of what the orbit needs, as in simulate. section: "
                  "the lag x_2' - V at which passages are counted, in units of V.");
  struct study_table *runs = study_table(
      page, "runs", "Every run",
      "scene\tlaw\ts\tsolver\toutcome\treturns\tperiod\tperiod_error\tstate_error\tcreep\tsteps\tseconds",
      "stable: a long run, up to 30 returns; paper: shooting, four returns to each Newton step. no return: within 20 "
      "periods. without a stick phase: the greater of the two speeds relative to the belt is never below a quarter of "
      "V. creep: the greater speed relative to the belt in the middle of the stick phase, over V. steps and "
      "seconds: of one return.");
  struct study_table *rates =
      study_table(page, "rates", "How fast they approach",
                  "scene\tlaw\ts\tperiod_error\trate\tstate_error\tstate_rate\tcreep\tcreep_rate",
                  "Of the first solver in the list above that found a periodic motion with a stick phase. A rate is "
                  "the fall of the decimal logarithm over the decade before: an error like s^-a has the rate a.");
  bool good = true;
  for (int i = 0; i < COUNT(scenes); i++) {
    struct reference ref;
    good = load_reference(&ref, scenes[i], i == 1, env) && good;
    if (!good) break;
    study_cells(orbits, "%s\t%.12g\t%.6g", ref.name, ref.period, ref.trace);
    for (int k = 0; k < 2; k++) study_cells(orbits, "%.6g\t%.6g", ref.limit[k] - ref.p[P_E1 + k], ref.limit[k]);
    study_cells(orbits, "%.6g", ref.level / ref.p[P_V]);
    study_row(orbits);
    for (int law = 0; law < N_LAWS; law++) {
      struct fall fall;
      for (int k = 0; k <= DECADES; k++) fall.period[k] = fall.state[k] = fall.creep[k] = NAN;
      for (int k = 1; k <= decades; k++) {
        struct smooth m;
        smooth_init(&m, (enum smooth_law)law, pow(10, k), ref.p, ref.limit);
        m.level = ref.level;
        for (int j = COUNT(solvers) - 1; j >= first; j--) {
          struct motion o;
          find_motion(&o, &ref, &m, solvers[j], page->quick ? 20000 : 100000);
          add_run(runs, &ref, (enum smooth_law)law, k, solvers[j], &o);
          keep(&fall, k, &ref, &o);
        }
      }
      add_rates(rates, &ref, (enum smooth_law)law, &fall, decades);
      say_rate(&page->found, &ref, (enum smooth_law)law, &fall, decades);
    }
  }
  draw(page, rates);
  return good;
}

const struct study study_smooth = {
    .id = "smooth",
    .title = "Smoothed friction",
    .question =
        "Coulomb's law is replaced by smooth ones with a slope s at the speed of the belt: tanh, which has no static "
        "friction above\nthe sliding one, and two with a hump of that height. Does the periodic motion tend to the "
        "event-driven orbit, how fast,\nand at which cost?",
    .run = run_smooth,
};
