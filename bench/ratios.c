/* The ratios that are asked for.  Most are times of two rows of one run; sincos calls and the growth from 1000 to 10000
   digits are measured here.  What a run has not measured is said to be not measured. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "bench/jobs.h"
#include "motion/map_balls.h"
#include "motion/orbit_judge.h"
#include "motion/warm.h"

void bench_result_clear(struct bench_result *r) {
  for (int i = 0; i < r->n; i++) bench_table_clear(&r->table[i]);
  free(r->table);
  for (int i = 0; i < r->n_pages; i++) study_clear(&r->page[i]);
  free(r->page);
  free(r->ratio);
  bench_verdicts_clear(&r->verdicts);
  bench_peers_clear(&r->peers);
  *r = (struct bench_result){.n = 0};
}

static void add(struct bench_result *r, double value, bool at_most, double goal, const char *fmt, ...) SS_PRINTF(5, 6);

static void add(struct bench_result *r, double value, bool at_most, double goal, const char *fmt, ...) {
  struct bench_ratio *q = SS_PUSH(r->ratio, r->n_ratios, r->cap_ratios);
  *q = (struct bench_ratio){.value = value, .goal = goal, .at_most = at_most};
  va_list list;
  va_start(list, fmt);
  vsnprintf(q->name, sizeof q->name, fmt, list);
  va_end(list);
}

enum bench_outcome bench_outcome(const struct bench_ratio *r) {
  if (isnan(r->value)) return RATIO_NOT_MEASURED;
  if (isnan(r->goal)) return RATIO_STATED;
  return (r->at_most ? r->value <= r->goal : r->value >= r->goal) ? RATIO_MET : RATIO_NOT_MET;
}

static const struct bench_table *table_of(const struct bench_result *r, const struct bench_job *job) {
  for (int i = 0; i < r->n; i++)
    if (r->table[i].job == job) return &r->table[i];
  return NULL;
}

/* The least time of a method that did not fail; NAN without one. */
static double time_of(const struct bench_table *t, const char *method, double setting) {
  const struct bench_row *row = bench_find(t, method, setting);
  return row && !row->failure ? row->least_ns : NAN;
}

/* --- Units. --- */

/* Different arguments, as an application has them. */
static void libm_sincos(void *self) {
  volatile double *sum = self;
  static double x = 0;
  x = x > 20 ? x - 20 : x + 0.37;
  *sum += sin(x) + cos(x);
}

struct bits {
  mpfr_t x, s, c;
};

static void bits_init(struct bits *b, slong prec) {
  mpfr_inits2(prec, b->x, b->s, b->c, (mpfr_ptr)NULL);
  mpfr_sqrt_ui(b->x, 3, MPFR_RNDN);
}

static void bits_clear(struct bits *b) {
  mpfr_clears(b->x, b->s, b->c, (mpfr_ptr)NULL);
}

/* Operations to be timed; suite_turn is the same sine and cosine as the suite makes them. */
#define TIMED(name, operation)                                                                                         \
  static void name(void *self) {                                                                                       \
    struct bits *b = self;                                                                                             \
    operation;                                                                                                         \
  }
TIMED(mpfr_turn, mpfr_sin_cos(b->s, b->c, b->x, MPFR_RNDN))
TIMED(suite_turn, num_mpfr.sin_cos(b->s, b->c, b->x, mpfr_get_prec(b->x)))
TIMED(product, mpfr_mul(b->s, b->x, b->c, MPFR_RNDN))
TIMED(sum_of_two, mpfr_add(b->s, b->c, b->x, MPFR_RNDN))
TIMED(quotient, mpfr_div(b->s, b->x, b->c, MPFR_RNDN))
TIMED(small_quotient, mpfr_div_ui(b->s, b->x, 42, MPFR_RNDN))
TIMED(root, mpfr_sqrt(b->s, b->x, MPFR_RNDN))
#undef TIMED

static double mpfr_time(void (*f)(void *), slong prec) {
  OWNED(bits) b;
  bits_init(&b, prec);
  mpfr_turn(&b);
  return bench_time(f, &b);
}

/* --- Proofs. --- */

enum { PROOF_BITS = 64, PROOF_STEPS = 100000 };

/* An orbit of the example whose events are to be proved the first ones. */
struct proof {
  struct dyn_orbits list;
  const struct dyn_orbit *orbit;
  struct dyn_orbit judged;
  fmpq *params;
  bool proved;
};

static void prove_first(void *self) {
  struct proof *p = self;
  struct ball_params m;
  struct ball_pass s;
  OWNED(calc) c = calc_begin(num_ctx_arb(PROOF_BITS));
  ball_params_init(&m, &c, p->params);
  /* an admissible orbit has z_2' < V in phase C */
  ball_pass_make(&s, &c, &m, p->orbit->t[PHASE_GAMMA], p->orbit->t[PHASE_H], false);
  p->proved = dyn_orbit_judge(&p->judged, &c, &m, &s, PROOF_STEPS) == TRUTH_TRUE;
}

/* The time of the proof on the first admissible orbit; NAN when it fails. */
static double proof_time(void) {
  struct proof p = {.params = bench_exact(bench_example)};
  double ns = NAN;
  dyn_orbits_find(&p.list, p.params, PROOF_BITS, NULL);
  for (slong i = 0; i < p.list.n; i++)
    if (p.list.orbit[i].admissible == TRUTH_TRUE) p.orbit = &p.list.orbit[i];
  if (p.orbit) ns = bench_time(prove_first, &p);
  dyn_orbits_clear(&p.list);
  dyn_orbit_clear(&p.judged);
  _fmpq_vec_clear(p.params, N_PARAMS);
  return p.proved ? ns : NAN;
}

/* --- The map. --- */

/* What the suite's MPFR map takes at 256 bits, counted at every call of an operation on a usual input; TURNS is what
   the goal grants, TAKEN what it takes.  Corrections have half the bits; they are counted apart, and timed so. */
enum { TURNS = 11, TAKEN = 4, MAP_BITS = 256 };
static const struct {
  void (*run)(void *);
  int whole, half;
} arithmetic[] = {{product, 92, 34}, {sum_of_two, 86, 14}, {quotient, 16, 4}, {small_quotient, 21, 4}, {root, 5, 0}};

static double arithmetic_time(slong prec) {
  double sum = 0;
  for (int i = 0; i < COUNT(arithmetic); i++) {
    sum += arithmetic[i].whole * mpfr_time(arithmetic[i].run, prec);
    if (arithmetic[i].half) sum += arithmetic[i].half * mpfr_time(arithmetic[i].run, prec / 2);
  }
  return sum;
}

/* The time of CVODE where it is most accurate; NAN when it is not built in. */
static double best_cvode(const struct bench_table *t) {
  const struct bench_row *best = NULL;
  for (int i = 0; i < t->n; i++) {
    const struct bench_row *r = &t->row[i];
    if (strncmp(r->method->id, "cvode-", 6) == 0 && !r->failure && (!best || r->worst < best->worst)) best = r;
  }
  return best ? best->least_ns : NAN;
}

static void multiprecision_ratios(struct bench_result *r, const struct bench_table *t) {
  static const double bits[] = {128, 256, 512, 1024};
  double map = time_of(t, "closed-mpfr", MAP_BITS), rest = arithmetic_time(MAP_BITS);
  add(r, map / (TURNS * mpfr_time(mpfr_turn, MAP_BITS) + rest), true, 1.3,
      "MPFR map at %d bits / %d mpfr_sin_cos and its arithmetic (126 products, 100 sums, 45 quotients, 5 roots)",
      MAP_BITS, TURNS);
  add(r, map / (TAKEN * mpfr_time(suite_turn, MAP_BITS) + rest), true, NAN,
      "MPFR map at %d bits / its %d sines and cosines, rounded from balls, and its arithmetic", MAP_BITS, TAKEN);
  add(r, proof_time() / time_of(t, "closed-arb", PROOF_BITS), true, 1,
      "proof of first events and of every condition / map in balls at %d bits", PROOF_BITS);
  for (int i = 0; i < COUNT(bits); i++)
    add(r, time_of(t, "closed-mpfr", bits[i]) / time_of(t, "closed-arb", bits[i]), false, NAN,
        "MPFR map at %g bits / map in balls", bits[i]);
  for (int i = 0; i < COUNT(bits); i++) {
    double unit = TURNS * mpfr_time(mpfr_turn, (slong)bits[i]) + arithmetic_time((slong)bits[i]);
    add(r, unit / time_of(t, "closed-arb", bits[i]), false, NAN,
        "%d mpfr_sin_cos and the MPFR map's arithmetic at %g bits / map in balls", TURNS, bits[i]);
  }
}

static void map_ratios(struct bench_result *r, const struct bench_table *t) {
  volatile double sum = 0;
  double suite = time_of(t, "closed-double", NAN), hand = time_of(t, "hand-written", NAN);
  double sincos = bench_time(libm_sincos, (void *)(size_t)&sum);
  add(r, suite / hand, true, 1.2, "map in double, first roots searched / hand-written map, no search");
  add(r, suite / sincos, true, NAN, "map in double, first roots searched / libm's sincos");
  add(r, hand / sincos, true, NAN, "hand-written map / libm's sincos");
  add(r, time_of(t, "gsl-rk8pd", 1e-13) / suite, false, 40, "GSL rk8pd at 1e-13 / map in double");
  add(r, best_cvode(t) / suite, false, 1000, "CVODE at its best accuracy / map in double");
  multiprecision_ratios(r, t);
}

/* The same method at 1000 and at 10000 digits, on one input, against the sine. */
static void growth_ratio(struct bench_result *r) {
  static const double bits[] = {3322, 33220};
  double value = NAN;
  if (!r->quick) {
    struct bench_method m = *bench_method_of(&bench_map, "closed-mpfr");
    struct bench_job job = bench_map;
    OWNED(bench_table) t;
    m.settings = bits;
    m.n = COUNT(bits);
    job.methods = &m;
    job.n_methods = job.n_cases = 1;
    if (bench_run(&t, &job, &(struct bench_env){.model = NULL}, false))
      value = time_of(&t, m.id, bits[1]) / time_of(&t, m.id, bits[0]) /
              (mpfr_time(mpfr_turn, (slong)bits[1]) / mpfr_time(mpfr_turn, (slong)bits[0]));
  }
  add(r, value, true, 1, "growth of the MPFR map from 1000 to 10000 digits / that of mpfr_sin_cos");
}

/* GSL's solvers start from the same guess, and get the multiplier from the same formulas. */
static void orbit_ratios(struct bench_result *r, const struct bench_table *t) {
  double suite = time_of(t, "from-guess", NAN), hand = time_of(t, "hand-written", NAN);
  double newton = time_of(t, "gsl-newton", NAN), hybrids = time_of(t, "gsl-hybrids", NAN);
  add(r, newton / suite, false, 9,
      "GSL's newton on six unknowns / the suite's orbit and multiplier from a guess, not judged either");
  add(r, hybrids / suite, false, 15,
      "GSL's hybrids / the suite's orbit and multiplier from a guess, not judged either");
  add(r, time_of(t, "from-guess-judged", NAN) / suite, true, NAN,
      "the same with first roots proved and conditions checked / without");
  add(r, newton / hand, false, NAN, "GSL's newton on six unknowns / hand-written orbit and multiplier");
  add(r, hybrids / hand, false, NAN, "GSL's hybrids / hand-written orbit and multiplier");
  add(r, time_of(t, "return-map", NAN) / suite, true, NAN,
      "Newton's iteration on the suite's return map / the suite's orbit from a guess");
}

static void sweep_ratios(struct bench_result *r) {
  struct bench_lanes b;
  bench_lanes(&b, r->quick);
  for (int i = 0; i < b.n; i++)
    add(r, b.gain[i], false, strcmp(b.set[i], "baseline") == 0 ? NAN : 4,
        "sweep, one core: dyn_orbit_warm / orbits in lanes (%s)", b.set[i]);
  add(r, b.bare, false, NAN,
      "sweep, one core: dyn_orbit_bare, in double precision and without conditions / orbits in lanes");
}

void bench_ratios(struct bench_result *r) {
  const struct bench_table *map = table_of(r, &bench_map), *orbit = table_of(r, &bench_orbit);
  if (map) map_ratios(r, map);
  if (map) growth_ratio(r);
  if (orbit) orbit_ratios(r, orbit);
  if (orbit) sweep_ratios(r);
}
