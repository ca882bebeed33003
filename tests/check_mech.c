/* Systems from files: what is read of them, and how they move.

   Numbers come from the simulation of the two masses (motion/coulomb.h), which shares no formula with src/mech, and
   from closed forms; longer chains are followed along their orbits in check_mech_orbits.c. */
#include "mech/describe.h"
#include "mech/moments.h"
#include "motion/coulomb.h"
#include "rng.h"
#include "system.h"
#include "test.h"

/* One that nothing rubs, of frequency 1. */
#define MASS_AND_SPRING FREE_MASS("m", "1") SPRING("k", "ground, m", "1")

static void finish(struct mech *m) {
  const char *why, *name;
  ck_assert_msg(mech_finish(m, &why, &name), "%s: %s", name, why);
}

/* It is not simulated from there for so long. */
static void nowhere(enum mech_route route, const struct mech *m, const double *start, double duration) {
  OWNED(mech_motion) z;
  ck_assert_int_eq(mech_simulate(&z, route, m, start, &PLAN(duration, 10)), SS_DOMAIN);
}

/* --- Motions --- */

static double dyadic(fmpq_t z, struct rng *r, slong low, slong high) {
  fmpq_set_si(z, rng_between(r, low, high), 64);
  return fmpq_get_d(z);
}

/* Masses one behind the other, on one belt. */
static void random_chain(struct mech *m, double start[2 * MECH_MASSES], int n, struct rng *r) {
  NUMBERS(fmpq, belt, x);
  dyadic(belt, r, 16, 128);
  mech_init(m);
  for (int i = 0; i < n; i++) {
    struct mech_link *spring = mech_add_link(m, true, "k");
    struct mech_mass *mass = mech_add_mass(m, "m");
    spring->end[0] = i - 1;
    spring->end[1] = i;
    dyadic(spring->size, r, 8, 64);
    dyadic(mass->inertia, r, 32, 128);
    mass->rubbed = true;
    fmpq_set(mass->surface, belt);
    dyadic(mass->sliding, r, 0, 100);
    dyadic(x, r, 8, 100);
    fmpq_add(mass->limit, mass->sliding, x);
    start[i] = dyadic(x, r, -200, 200);
    start[n + i] = rng_between(r, 0, 1) ? fmpq_get_d(belt) : dyadic(x, r, -150, 150);
  }
}

static const enum coulomb_mode mode_of[128] = {['s'] = MODE_STICK, ['-'] = MODE_BELOW, ['+'] = MODE_ABOVE};

TEST_EACH(a_chain_of_two_moves_as_the_papers_system, 100) {
  struct rng r = {(uint64_t)_i};
  OWNED(mech) m;
  double x[2 * MECH_MASSES], p[N_COULOMB];
  struct coulomb_plan plan = coulomb_plan_default;
  struct coulomb_result end;
  OWNED(coulomb_log) log = {.n = 0};
  random_chain(&m, x, 2, &r);
  p[COULOMB_CHI] = dyadic(m.spring[1].size, &r, 6, 58);
  fmpq_one(m.spring[0].size);
  fmpq_sub(m.spring[0].size, m.spring[0].size, m.spring[1].size);
  fmpq_one(m.mass[0].inertia);
  finish(&m);
  p[COULOMB_ETA] = 1 / fmpq_get_d(m.mass[1].inertia);
  p[COULOMB_V] = fmpq_get_d(m.mass[0].surface);
  for (int i = 0; i < 2; i++) {
    p[COULOMB_US1 + i] = fmpq_get_d(m.mass[i].sliding);
    p[COULOMB_UR1 + i] = fmpq_get_d(m.mass[i].limit);
  }
  struct coulomb_sink sink = coulomb_log_sink(&log);
  plan.duration = 12;
  ck_assert_int_eq(coulomb_simulate_d(&end, p, x, &plan, &sink), SS_OK);
  for (int route = 0; route < N_MECH_ROUTES; route++) {
    OWNED(mech_motion) z = simulated(route, &m, x, &PLAN(12, 1000));
    ck_assert_msg(z.n_moments == (int)log.n + 1, "trial %d route %d: %d events, not %zu", _i, route, z.n_moments - 1,
                  log.n);
    for (size_t k = 0; k < log.n; k++) {
      const struct mech_moment *at = &z.moment[k + 1];
      ck_assert_int_eq(at->mass, log.event[k].mass);
      ck_assert_int_eq((int)mode_of[(int)at->phase[at->mass]], (int)log.event[k].to);
      ck_assert_double_eq_tol(at->t, log.event[k].at.t, 1e-7);
    }
    for (int i = 0; i < 2; i++) {
      ck_assert_double_eq_tol(z.z[i], end.at.x[i], 1e-7);
      ck_assert_double_eq_tol(z.z[2 + i], end.at.v[i], 1e-7);
    }
  }
}

/* The integrator asks for forces, the patches for exponentials of exact rates. */
TEST_EACH(routes_agree_on_longer_chains, 30) {
  struct rng r = {(uint64_t)_i + 100};
  OWNED(mech) m;
  double x[2 * MECH_MASSES];
  random_chain(&m, x, 3 + _i % 3, &r);
  finish(&m);
  OWNED(mech_motion) a = simulated(MECH_INTEGRATED, &m, x, &PLAN(4, 1000)),
                     b = simulated(MECH_PATCHED, &m, x, &PLAN(4, 1000));
  ck_assert_int_eq(a.n_moments, b.n_moments);
  for (int k = 0; k < a.n_moments; k++) ck_assert_str_eq(a.moment[k].phase, b.moment[k].phase);
  for (int i = 0; i < m.states; i++) ck_assert_double_eq_tol(a.z[i], b.z[i], 1e-7);
}

TABLE(closed_forms, "tests/cases/motions_in_closed_form.tsv", 5);
enum { MOVING, FROM_STATE, FOR_TIME, PHASES_BEGIN, AT_THE_END }; /* its columns */

TEST_EACH(motions_in_closed_form, closed_forms.n) {
  char *const *row = closed_forms.row[_i];
  double start[MECH_STATES] = {0}, end[2], t;
  sscanf(row[FROM_STATE], "%lf %lf %lf %lf", start, start + 1, start + 2, start + 3);
  ck_assert_int_eq(sscanf(row[AT_THE_END], "%lf %lf", end, end + 1), 2);
  OWNED(mech) file = system_of(row[MOVING]);
  for (int route = 0; route < N_MECH_ROUTES; route++) {
    OWNED(mech_motion) z = simulated(route, &file, start, &PLAN(atof(row[FOR_TIME]), 1000));
    const char *next = row[PHASES_BEGIN];
    int n = 0;
    for (char phase[8]; sscanf(next, "%lf:%7s", &t, phase) == 2; n++) {
      ck_assert_int_lt(n, z.n_moments);
      ck_assert_double_eq_tol(z.moment[n].t, t, 1e-11);
      ck_assert_str_eq(z.moment[n].phase, phase);
      next += strcspn(next, " ") + strspn(next + strcspn(next, " "), " ");
    }
    ck_assert_int_eq(z.n_moments, n);
    double within = mech_rests(z.moment[n - 1].phase[0]) ? 0 : 1e-11;
    for (int i = 0; i < 2; i++) ck_assert_msg(fabs(z.z[i] - end[i]) <= within, "%g, not %g", z.z[i], end[i]);
  }
}

/* The forced vibration of x'' + x'/5 + 4 x = a cos(angle) + b sin(angle), angle' = w. */
static double forced(double w, double a, double b, double angle) {
  double p = 4 - w * w, q = w / 5;
  return ((a * p - b * q) * cos(angle) + (b * p + a * q) * sin(angle)) / (p * p + q * q);
}

/* Two such of the orders 3 and 2 of theta' = 1/2, the first of two loads, and their velocities. */
static void forced_by_two(double z[2], double theta) {
  z[0] = forced(1.5, 1, 0.25, 3 * theta) + forced(1, 0, 2, 2 * theta);
  z[1] = forced(1.5, 1.5 * 0.25, -1.5, 3 * theta) + forced(1, 2, 0, 2 * theta);
}

TEST(loads_superpose) {
  const double theta = 0.3, t = 37.25, later = theta + t / 2;
  static const int orders[] = {1, 3, 2};
  double start[8], want[8];
  OWNED(mech) file = system_of(FREE_MASS("m", "1") SPRING("k", "ground, m", "4") DAMPER("c", "ground, m", "1/5") LOAD(
      "p", "m", "3/2", "1/3") "  sine: 1/4\n" LOAD("r", "m", "3/2", "2/3") LOAD("q", "m", "1", "0") "  sine: 2\n");
  ck_assert(file.n_orders == 3 && file.states == 8 && fmpq_get_d(file.frequency) == 0.5);
  forced_by_two(start, theta);
  mech_at_angle(start + 2, &file, theta);
  forced_by_two(want, later);
  for (int k = 0; k < 3; k++) {
    ck_assert_int_eq(file.order[k], orders[k]);
    want[2 + 2 * k] = cos(orders[k] * later);
    want[3 + 2 * k] = sin(orders[k] * later);
  }
  for (int route = 0; route < N_MECH_ROUTES; route++) {
    OWNED(mech_motion) z = simulated(route, &file, start, &PLAN(t, 10));
    for (int i = 0; i < 8; i++) ck_assert_double_eq_tol(z.z[i], want[i], 1e-11);
  }
}

TEST(motions_outside_the_domain) {
  struct rng r = {7};
  OWNED(mech) m;
  double x[2 * MECH_MASSES];
  const double durations[] = {-1, INFINITY, NAN, 2e6};
  random_chain(&m, x, 3, &r);
  finish(&m);
  for (size_t i = 0; i < COUNT(durations); i++) nowhere(MECH_INTEGRATED, &m, x, durations[i]);
  OWNED(mech_motion) z = simulated(MECH_PATCHED, &m, x, &PLAN(0, 10));
  ck_assert_double_eq(z.z[1], x[1]);
  x[2] = NAN;
  nowhere(MECH_PATCHED, &m, x, 1);
  OWNED(mech) stopped = system_of(MASS_AND_SPRING STOP("o", "m", "above: 0", "1/2"));
  for (int route = 0; route < N_MECH_ROUTES; route++)
    nowhere((enum mech_route)route, &stopped, (const double[]){0.1, 0}, 1); /* beyond the obstacle */
}

struct energies {
  const struct mech *m;
  double first;
  long n, events;
};

/* (x' M x' + x K x)/2, and the times of samples. */
static bool watch_energy(void *self, const struct mech_moment *at) {
  struct energies *e = self;
  int n = e->m->n;
  double sum = 0;
  for (int i = 0; i < n; i++) {
    sum += fmpq_get_d(e->m->mass[i].inertia) * at->z[n + i] * at->z[n + i] / 2;
    for (int j = 0; j < n; j++) sum += fmpq_get_d(fmpq_mat_entry(e->m->stiffness, i, j)) * at->z[i] * at->z[j] / 2;
  }
  if (at->mass >= 0) {
    e->events++;
  } else {
    ck_assert_double_eq(at->t, (double)e->n++ * 0.3);
  }
  if (e->first == 0) e->first = sum;
  ck_assert_msg(fabs(sum - e->first) < 1e-10 * e->first, "at %g: %.17g, not %.17g", at->t, sum, e->first);
  return true;
}

TEST(energy_stays) {
  const double start[] = {0.5, -0.25, 1.5, -1};
  OWNED(mech) file = system_of(FREE_MASS("m", "1") FREE_MASS("n", "2") SPRING("k", "ground, m", "1") SPRING(
      "l", "m, n", "3") STOP("a", "m", "above: 3/4", "1") STOP("b", "n", "below: -1/2", "1"));
  for (int route = 0; route < N_MECH_ROUTES; route++) {
    struct energies e = {.m = &file};
    struct mech_plan plan = {.duration = 30, .most = 1000, .sample = 0.3, .self = &e, .told = watch_energy};
    OWNED(mech_motion) z = simulated(route, &file, start, &plan);
    ck_assert(e.n >= 100 && e.n <= 101 && e.events > 10 && e.events == z.n_moments - 1);
  }
}

/* What no simulation can go through ends, and says why. */
TABLE(ends, "tests/cases/simulations_that_end.tsv", 3);
enum { SYSTEM, START, END }; /* its columns */

TEST_EACH(simulations_that_end, ends.n) {
  double x[4] = {0};
  ck_assert_int_ge(sscanf(ends.row[_i][START], "%lf %lf %lf %lf", x, x + 1, x + 2, x + 3), 2);
  OWNED(mech) file = system_of(ends.row[_i][SYSTEM]);
  for (int route = 0; route < N_MECH_ROUTES; route++) {
    OWNED(mech_motion) z;
    struct mech_plan plan = {.duration = 500, .most = 100000, .looks = 100000};
    int status = mech_simulate(&z, (enum mech_route)route, &file, x, &plan);
    ck_assert_str_eq(mech_outcome_name[z.end], ends.row[_i][END]);
    ck_assert_int_eq(status, z.end == MECH_DONE ? SS_OK : SS_UNABLE);
  }
}

TEST(csv_rows) {
  const struct mech_moment at = {0.5, -1, "s+", {1, -2, 1, 0.25}, {0.125, -3}};
  LOCAL(text, t);
  mech_csv_heading(&t, 2);
  mech_csv_row(&t, 2, &at);
  ck_assert_str_eq(text_str(&t), "t,x1,x2,v1,v2,mode1,mode2,u1,u2\n0.5,1,-2,1,0.25,stick,above,0.125,-3\n");
}

/* Held on the belt where its spring pulls with more than static friction can hold, by far more than changes in a
   look. */
TEST(a_stick_beyond_its_limit) {
  static const double start[6] = {9, 0, 0, 1e-3, 1e-3, 1e-3};
  OWNED(mech) file;
  goes_well(mech_load(&file, "tests/cases/slow-belt.system", &d));
  for (int route = 0; route < N_MECH_ROUTES; route++) {
    struct mech_plan plan = {.duration = 1, .most = 10, .phase = "sss"};
    OWNED(mech_motion) out;
    mech_simulate(&out, (enum mech_route)route, &file, start, &plan);
    ck_assert_int_ge(out.n_moments, 2);
    ck_assert_double_lt(out.moment[1].t, 0.1);
    ck_assert_str_eq(out.moment[1].phase, "-ss");
  }
}

/* x'' + x'/5 + 4 x = 1/10 + cos(3/2 t) while x' < 1: the forced vibration has the velocity 3/2 / |4 - 9/4 + 3/10 i| =
   0.845 at most, so that every motion ends in it. */
TEST(a_forced_vibration_has_no_events) {
  OWNED(mech_settling) s;
  OWNED(mech) file = system_of(MASS("m", "1", "1/10", "1/5", "1") SPRING("k", "ground, m", "4")
                                   DAMPER("c", "ground, m", "1/5") LOAD("p", "m", "3/2", "1"));
  mech_settle(&s, &file, NULL);
  ck_assert_int_eq(s.settled + s.unfinished, 0);
  ck_assert_int_eq(s.eventless, s.starts);
}

/* A state that is far out but has not come back. */
TEST(far_out_is_not_settled) {
  struct mech_moment moment[] = {{.t = 0, .phase = "s", .z = {1e6, 1}},
                                 {.t = 1, .phase = "-", .z = {1e6 + 1, 1}},
                                 {.t = 2, .phase = "s", .z = {1e6 + 0.1, 1}}};
  struct mech_motion x = {.moment = moment, .n_moments = 3};
  struct mech_word w;
  double period, gap;
  ck_assert(!mech_settles(&w, &period, &gap, &x, 1, 2));
  moment[2].z[0] = 1e6 + 1e-7;
  ck_assert(mech_settles(&w, &period, &gap, &x, 1, 2) && w.n == 2 && gap > 5e-8);
}

/* --- Files and words --- */

TABLE(refused, "tests/cases/systems_refused.tsv", 2);
enum { REFUSED_FILE, REFUSED_SAYS }; /* its columns */

CASE("files", .once = {scratch_open, scratch_close});

TEST_EACH(files_that_are_refused, refused.n) {
  OWNED(mech) file;
  struct source src = source_of("a.system", refused.row[_i][REFUSED_FILE]);
  fails_with(mech_read(&file, src, NULL, false, &d), refused.row[_i][REFUSED_SAYS]);
}

TEST(a_thousand_masses) {
  LOCAL(text, t);
  OWNED(mech) file;
  for (int i = 0; i < 1000; i++) text_printf(&t, "mass m%d\n  inertia: 1\n", i);
  struct source src = source_of("a.system", text_str(&t));
  fails_with(mech_read(&file, src, NULL, false, &d), "a system has at most 24 masses");
}

TABLE(words, "tests/cases/system_words.tsv", 3);
enum { WORD, WHY, AT }; /* its columns */

TEST_EACH(words_of_two_masses, words.n) {
  struct mech_word w;
  const char *why;
  size_t at;
  OWNED(mech) file = system_of(MASS("m", "1", "1/2", "1", "1") MASS("n", "1", "1/2", "1", "1") SPRING(
      "k", "ground, m", "1") SPRING("l", "m, n", "1") STOP("o", "n", "above: 1", "1"));
  bool ok = mech_word_parse(&w, &at, &why, words.row[_i][WORD], &file);
  ck_assert_int_eq(ok, !*words.row[_i][WHY]);
  if (!ok) ck_assert_msg(strstr(why, words.row[_i][WHY]) && (int)at == atoi(words.row[_i][AT]), "%zu: %s", at, why);
}

/* Written down by hand: x'' = -3 x + y - x', y'' = (x - 5 y)/2; two loads, of whose frequencies 3/4 and 5/2 the base
   1/4 occurs in no force. */
TEST_EACH(systems_in_formulas, 2) {
  static const struct {
    const char *system, *plain[6], *tex[2];
  } row[] = {{"c = 1\n" FREE_MASS("m", "1") MASS("n", "2", "1/2", "3", "-1") SPRING("k", "ground, m", "2*c")
                  SPRING("l", "n, m", "c") SPRING("o", "n, ground", "4") STOP("w", "m", "below: -5/2", "1/4")
                      DAMPER("d", "m, ground", "c"),
              {"x_1'' = -f_1, f_1 = 3 x_1 - x_2 + x_1'", "2 x_2'' = u_2 - f_2, f_2 = -x_1 + 5 x_2",
               "|u_2| <= 3, u_2 = +-1/2; |f_2| = 3, x_2' = -1", "x_1 >= -5/2, x_1' -> -1/4 x_1'",
               "Eigenvalues while every mass slips or is free"},
              {"2 x_{2}'' = u_{2} - f_{2}, \\quad f_{2} = -x_{1} + 5 x_{2}"}},
             {MASS_AND_SPRING LOAD("p", "m", "3/4", "2") LOAD("q", "m", "5/2", "1/3"),
              {"f_1 = x_1 - 2 cos(3/4 t) - 1/3 cos(5/2 t)\n"},
              {"- 2 \\cos(\\frac{3}{4} t) - \\frac{1}{3} \\cos(\\frac{5}{2} t) "}}};
  OWNED(mech) file = system_of(row[_i].system);
  for (int tex = 0; tex < 2; tex++) {
    LOCAL(text, t);
    mech_describe(&t, &file, tex, 6);
    for (const char *const *line = tex ? row[_i].tex : row[_i].plain; *line; line++)
      ck_assert_msg(strstr(text_str(&t), *line) != NULL, "%s is not in\n%s", *line, text_str(&t));
  }
}
