/* Stiff scenes: the ratio of masses eta over twenty-four decades, an orbit in each, and what integrators make of it.

   For each eta a short list of forces e1, e2 is gone through, which follow the frequency omega = sqrt(chi eta) of the
   second mass, until one has an admissible orbit that is certified.  From its r = z_2 - z_1, rounded to double and then
   exact, one Poincare map is asked for: t_b, t_c, t_d and r at the end.  The truth are balls near the orbit's own
   times.

   The integrators are GSL's and, where it is installed, CVODE's.  They take steps as long as their error estimates
   allow, so that events can be missed.  An event is taken for the right one when it lies within an eighth of the
   shortest period of its phase of the true one; a crossing of the same sense cannot be that near.  From the first event
   that is not the right one on, the word is another motion's. */
#include <math.h>
#include <string.h>

#include "base/arena.h"
#include "bench/figure.h"
#include "bench/jobs.h"
#include "bench/study.h"
#include "motion/certify.h"

static const double PI2 = 6.283185307179586;
enum { TB, TC, TD, R_END = MAP_R, N_OUT };
enum { TRUTH_BITS = 320 };

/* One scene: the parameters as exact doubles, the map's start, the truth and rough times. */
struct scene_at {
  int decade, tried;
  double p[N_PARAMS + 1]; /* and r */
  double trace, ta;
  slong bits;
  bool found;
  struct num_vec truth;
  double t[3], window[3]; /* the events, and how near an event must be */
};

/* The number of bits at which the orbit was certified; 0 when it was not. */
static slong certified(const struct dyn_orbit *o, const fmpq *params) {
  static const enum dyn_quantity which[2] = {QUANTITY_E1, QUANTITY_E2};
  OWNED(dyn_certificate) z = {.certified = false};
  dyn_certify(&z, &(struct dyn_question){.model = params, .value = params + P_E1, .which = which}, o);
  return z.certified && z.admissible == TRUTH_TRUE ? z.bits : 0;
}

static int find_truth(struct scene_at *s) {
  OWNED(num_vec) in, given;
  double hint[BENCH_HINT];
  num_vec_init(&in, N_PARAMS + 1, s->truth.ctx);
  num_vec_init(&given, 0, s->truth.ctx);
  for (int i = 0; i <= N_PARAMS; i++) arb_set_d(num_vec_at(&in, i), s->p[i]);
  int status = bench_map.truth(&s->truth, &given, hint, &in, s->t);
  return status & SS_DOMAIN; /* long phases are fine here */
}

/* The first admissible and certified orbit at the parameters becomes the scene's. */
static bool take_orbit(struct scene_at *s) {
  OWNED(dyn_orbits) list;
  fmpq *params = bench_exact(s->p);
  dyn_orbits_find(&list, params, 128, NULL);
  bool found = false;
  for (slong i = 0; i < list.n && !found; i++) {
    const struct dyn_orbit *o = &list.orbit[i];
    s->bits = o->admissible == TRUTH_TRUE ? certified(o, params) : 0;
    if (s->bits == 0) continue;
    NUMBERS(arb, r);
    arb_sub(r, o->z20, o->z10, 128);
    s->p[N_PARAMS] = num_arb.get_d(r);
    s->trace = num_arb.get_d(o->trace);
    s->ta = num_arb.get_d(o->t[PHASE_D]);
    for (int k = 0; k < 3; k++) s->t[k] = num_arb.get_d(o->t[PHASE_GAMMA + k]);
    found = find_truth(s) == SS_OK && arb_is_finite((arb_srcptr)num_vec_at(&s->truth, R_END));
  }
  _fmpq_vec_clear(params, N_PARAMS);
  return found;
}

static void find_scene(struct scene_at *s, int decade) {
  static const double first[] = {2.19, 1.8, 2.6, 3.2, 1.4, 1, 10}, second[] = {0.9, 0.5, 1.3, 0.7, 0.1, 15};
  double chi = 0.8, eta = pow(10, decade), omega = sqrt(chi * eta);
  *s = (struct scene_at){.decade = decade};
  num_vec_init(&s->truth, N_OUT, num_ctx_arb(TRUTH_BITS));
  for (int i = 0; i < COUNT(first) * COUNT(second) && !s->found; i++) {
    const double p[N_PARAMS] = {chi, eta, 1, first[i / COUNT(second)] * fmax(omega, 1 / omega),
                                second[i % COUNT(second)] * fmin(1, 1 / omega)};
    memcpy(s->p, p, sizeof p);
    s->tried++;
    s->found = take_orbit(s);
  }
  double fast = 0.5 * (1 + chi * eta + sqrt((1 + chi * eta) * (1 + chi * eta) - 4 * chi * eta * (1 - chi)));
  const double period[3] = {PI2, PI2 / sqrt(fast), PI2 / omega};
  for (int k = 0; k < 3; k++) s->window[k] = period[k] / 8;
}

/* --- Methods. --- */

/* Of the map's job.  CVODE is the last one, and left out where it is not installed. */
static const char *const method_id[] = {"closed-double", "gsl-rk8pd", "gsl-rkf45",
                                        "gsl-bsimp",     "gsl-msbdf", "cvode-bdf"};
enum { N_METHODS = COUNT(method_id) - !HAS_CVODE };

static bool integrates(const struct bench_method *m) {
  return m->kind == SET_TOLERANCE;
}

struct outcome {
  const char *state; /* "ok", or what went wrong */
  bool word;         /* every event was the right one */
  double error;      /* the largest relative one */
  long steps;
  double seconds;
};

/* What an integrator opens begins with its motion. */
static void *open_method(const struct bench_method *m, double tolerance, long most_steps) {
  void *self = m->open ? m->open(m, tolerance, NULL) : NULL;
  if (self) ((struct bench_motion *)self)->limits = (struct bench_limits){true, most_steps};
  return self;
}

static double error_of(const double out[N_OUT], const struct scene_at *s) {
  double worst = 0;
  NUMBERS(arb, off);
  for (int k = 0; k < N_OUT; k++) {
    arb_set_d(off, out[k]);
    arb_sub(off, off, num_vec_at(&s->truth, k), TRUTH_BITS);
    arb_div(off, off, num_vec_at(&s->truth, k), 64);
    worst = fmax(worst, fabs(num_arb.get_d(off)));
  }
  return worst;
}

/* Which event is the first that is not the right one, in words. */
static const char *judge(const double out[N_OUT], const struct scene_at *s) {
  static const char *const late[] = {"late t_b", "late t_c", "late t_d"};
  static const char *const early[] = {"early t_b", "early t_c", "early t_d"};
  for (int k = 0; k < 3; k++) {
    double off = out[k] - num_arb.get_d(num_vec_at(&s->truth, k));
    if (!(fabs(off) <= s->window[k])) return off > 0 ? late[k] : early[k];
  }
  return NULL;
}

static struct outcome measure(const struct bench_method *m, const struct scene_at *s, double tolerance, bool quick) {
  struct outcome o = {.state = "ok", .seconds = INFINITY};
  double out[N_OUT], spent = 0;
  struct num_vec to = {num_ctx_double(), N_OUT, (char *)out};
  const struct bench_case c = {.x = s->p};
  void *self = open_method(m, tolerance, quick ? 20000 : 200000);
  if (m->open && !self) return (struct outcome){.state = "cannot be set up", .error = NAN, .seconds = NAN};
  int status = SS_OK;
  do {
    for (int k = 0; k < N_OUT; k++) out[k] = NAN;
    double begin = bench_now();
    status = m->run(self, &to, &o.steps, &c);
    double took = bench_now() - begin;
    o.seconds = fmin(o.seconds, took);
    spent += took;
  } while (!status && spent < (quick ? 0.001 : 0.01));
  if (self) m->close(self);
  const char *wrong = status ? NULL : judge(out, s);
  o.error = status ? NAN : error_of(out, s);
  if (status)
    o.state = status & SS_DOMAIN ? "says that there is no event" : "gives up";
  else if (wrong)
    o.state = wrong;
  else
    o.word = true;
  return o;
}

/* --- The tables. --- */

static const double tolerances[] = {1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}, few[] = {1e-4, 1e-8};
static const int few_decades[] = {-12, -6, 0, 6, 12};
enum { FIRST_DECADE = -12, LAST_DECADE = 12, MOST_SCENES = LAST_DECADE - FIRST_DECADE + 1 };

static void add_scene(struct study_table *t, const struct scene_at *s) {
  study_cells(t, "1e%+d\t%d", s->decade, s->tried);
  if (!s->found) {
    study_cells(t, "no admissible orbit that is certified among these");
    study_row(t);
    return;
  }
  study_cells(t, "%.17g\t%.17g\t%.6g\t%.6g\t%.6g\t%.6g\t%.3g\t%.9g\t%ld", s->p[P_E1], s->p[P_E2], s->ta, s->t[TB],
              s->t[TC], s->t[TD], s->t[TC] * sqrt(1 + s->p[P_CHI] * s->p[P_ETA]), s->trace, (long)s->bits);
  study_row(t);
}

static void add_run(struct study_table *t, const struct scene_at *s, const struct bench_method *m, double tolerance,
                    const struct outcome *o) {
  study_cells(t, "1e%+d\t%s\t%.1g\t%s\t%.2g\t%ld\t%.3g", s->decade, m->id, integrates(m) ? tolerance : NAN, o->state,
              o->error, o->steps, o->seconds);
  study_row(t);
}

struct sums {
  int runs, word, late, early, given_up;
};

static void count(struct sums *c, const struct outcome *o) {
  c->runs++;
  c->word += o->word;
  c->late += strncmp(o->state, "late", 4) == 0;
  c->early += strncmp(o->state, "early", 5) == 0;
  c->given_up += !o->word && isnan(o->error);
}

/* Time at one tolerance, and the error, against eta. */
static void draw(struct study_page *page, const struct study_table *runs) {
  static const char *const y[] = {"seconds of one Poincar\xc3\xa9 map, tolerance 1e-8", "largest relative error"};
  struct figure f = {.id = "stiff", .title = page->study->title, .panels = 2};
  for (int i = 0; i < 2; i++)
    f.panel[i] = (struct figure_panel){.x = "ratio of masses *\xce\xb7*", .y = y[i], .power = {true, true}};
  OWNED(rows) t;
  rows_parse(&t, text_str(&runs->tsv));
  for (int k = 0; k < N_METHODS; k++) {
    const struct bench_method *m = bench_method_of(&bench_map, method_id[k]);
    figure_curve(&f, m->id);
    for (size_t i = 0; i < t.n; i++) {
      if (!rows_is(&t, i, rows_column(&t, "method"), m->id)) continue;
      if (integrates(m) && !rows_is(&t, i, rows_column(&t, "tolerance"), "1e-08")) continue;
      if (!rows_is(&t, i, rows_column(&t, "outcome"), "ok")) continue;
      double eta = log10(rows_number(&t, i, rows_column(&t, "eta")));
      figure_point(&f, 0, eta, log10(rows_number(&t, i, rows_column(&t, "seconds"))));
      figure_point(&f, 1, eta, log10(rows_number(&t, i, rows_column(&t, "error"))));
    }
  }
  figure_svg(&page->figure, &f);
}

static bool run(struct study_page *page, const struct bench_env *env) {
  const double *tolerance = page->quick ? few : tolerances;
  int n = page->quick ? COUNT(few) : COUNT(tolerances), scenes = page->quick ? COUNT(few_decades) : MOST_SCENES;
  struct sums sums[N_METHODS] = {{0}};
  (void)env;
  struct study_table *orbits = study_table(
      page, "orbits", "The orbits", "eta\ttried\te1\te2\tt_a\tt_b\tt_c\tt_d\tturns\ttrace\tbits",
      "chi = 0.8 and V = 1; the doubles are taken exactly. tried: pairs (e1, e2) until one had an admissible orbit "
      "that is certified, of at most 42: e1 is one of seven factors times the larger of omega and 1/omega, e2 one of "
      "six times the smaller of 1 and 1/omega. turns: the angle of the fast mode over phase H. bits: at which it was "
      "certified.");
  struct study_table *runs = study_table(
      page, "runs", "Every run", "eta\tmethod\ttolerance\toutcome\terror\tsteps\tseconds",
      "outcome ok: all three events are the right ones. late, early: the first event that is not within an eighth of a "
      "period of the true one. error: the largest relative one of t_b, t_c, t_d and r. gives up: more steps in a phase "
      "than allowed, or a step that the method cannot make.");
  struct study_table *words = study_table(page, "words", "The word", "eta\tmethod\tloosest\ttighter",
                                          "loosest: the loosest tolerance from which on the phase word is right at "
                                          "every tighter one that was tried; none: not "
                                          "even at the tightest. tighter: how many tolerances that are.");
  struct study_table *totals = study_table(page, "totals", "Counts", "method\truns\tword\tlate\tearly\tgives_up",
                                           "Over all scenes and tolerances.");
  for (int i = 0; i < scenes; i++) {
    struct scene_at s;
    find_scene(&s, page->quick ? few_decades[i] : FIRST_DECADE + i);
    add_scene(orbits, &s);
    for (int k = 0; k < N_METHODS && s.found; k++) {
      const struct bench_method *m = bench_method_of(&bench_map, method_id[k]);
      struct outcome o[COUNT(tolerances)];
      int settings = integrates(m) ? n : 1;
      for (int j = 0; j < settings; j++) {
        o[j] = measure(m, &s, tolerance[j], page->quick);
        add_run(runs, &s, m, tolerance[j], &o[j]);
        count(&sums[k], &o[j]);
      }
      int tighter = 0;
      while (tighter < settings && o[settings - 1 - tighter].word) tighter++;
      study_cells(words, "1e%+d\t%s", s.decade, method_id[k]);
      study_cells(words, !tighter ? "none" : integrates(m) ? "%.0e" : "-", tolerance[tighter ? settings - tighter : 0]);
      study_cells(words, "%d of %d", tighter, settings);
      study_row(words);
    }
    num_vec_clear(&s.truth);
  }
  for (int k = 0; k < N_METHODS; k++) {
    const struct sums *c = &sums[k];
    study_cells(totals, "%s\t%d\t%d\t%d\t%d\t%d", method_id[k], c->runs, c->word, c->late, c->early, c->given_up);
    study_row(totals);
  }
  for (int k = 0; k < N_METHODS; k++)
    text_printf(&page->found, "- %s: the right word in %d of %d runs, another event in %d, none in %d\n", method_id[k],
                sums[k].word, sums[k].runs, sums[k].late + sums[k].early, sums[k].given_up);
  draw(page, runs);
  return sums[0].runs > 0;
}

const struct study study_stiff = {
    .id = "stiff",
    .title = "Stiff scenes",
    .question =
        "The ratio of masses eta runs from 1e-12 to 1e12. In each decade an orbit is looked for, and one Poincare "
        "map from it is\ncomputed by integrators whose steps are as long as their error estimates allow, and in "
        "closed form.\nErrors are true ones, against balls.",
    .run = run,
};
