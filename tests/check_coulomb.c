/* The laws of the simulation under Coulomb's law.

   Two routes are held against each other event by event, and both against things that share nothing with either: the
   law spelled out from (2), motions worked out by hand (given where they stand), conserved energy, scaling, and the
   paper's orbit with its multiplier, whose digits come from tests/oracle/orbits.tsv (mpmath, matrix exponentials).
   Random operands are dyadic; a failing trial prints them. */
#include "known_orbits.h"
#include "motion/coulomb.h"
#include "rational.h"
#include "rng.h"
#include "test.h"

enum { N_ROUTES = 3 };
static const char *const route_name[N_ROUTES] = {"ode", "double", "mpfr"};

/* The motion from x by one of the routes, mpfr at 160 bits. */
static int simulate(struct coulomb_result *r, int route, const double p[N_COULOMB], const double x[N_STATE],
                    const struct coulomb_plan *plan, const struct coulomb_sink *sink) {
  if (route == 0) return coulomb_simulate_ode(r, p, x, plan, sink);
  struct num_ctx ctx = route == 1 ? num_ctx_double() : num_ctx_mpfr(160);
  OWNED(num_vec) params = vec_of(p, N_COULOMB, ctx), start = vec_of(x, N_STATE, ctx);
  return coulomb_simulate_exact(r, &params, &start, plan, sink);
}

struct told {
  int status;
  struct coulomb_result r;
  struct coulomb_log log;
  struct text word;
};

static struct told tell(int route, const double p[N_COULOMB], const double x[N_STATE],
                        const struct coulomb_plan *plan) {
  struct told t = {.status = SS_OK};
  struct coulomb_sink sink = coulomb_log_sink(&t.log);
  t.status = simulate(&t.r, route, p, x, plan, &sink);
  coulomb_log_word(&t.word, &t.log);
  return t;
}

static struct told tell_for(int route, const double p[N_COULOMB], const double x[N_STATE], double duration) {
  struct coulomb_plan plan = coulomb_plan_default;
  plan.duration = duration;
  return tell(route, p, x, &plan);
}

static void told_clear(struct told *t) {
  coulomb_log_clear(&t->log);
  text_clear(&t->word);
}

/* t: a struct told of each route. */
static void routes_clear(struct told (*t)[N_ROUTES]) {
  for (int route = 0; route < N_ROUTES; route++) told_clear(&(*t)[route]);
}

static const char *show(const double p[N_COULOMB], const double x[N_STATE]) {
  static char text[400];
  snprintf(text, sizeof text, "params %.17g %.17g %.17g %.17g %.17g %.17g %.17g start %.17g %.17g %.17g %.17g", p[0],
           p[1], p[2], p[3], p[4], p[5], p[6], x[0], x[1], x[2], x[3]);
  return text;
}

/* Any start, mostly with masses faster than the belt, slower, or both. */
static void random_motion(double p[N_COULOMB], double x[N_STATE], struct rng *r) {
  p[COULOMB_CHI] = rng_dyadic(r, 3, 61);
  p[COULOMB_ETA] = rng_dyadic(r, 8, 256);
  p[COULOMB_V] = rng_dyadic(r, 16, 128);
  for (int i = 0; i < 2; i++) {
    p[COULOMB_US1 + i] = rng_dyadic(r, 0, 200);
    p[COULOMB_UR1 + i] = p[COULOMB_US1 + i] + rng_dyadic(r, 1, 200);
    x[Z_1 + i] = rng_dyadic(r, -640, 640);
    x[DZ_1 + i] = rng_dyadic(r, -200, 200);
  }
}

static void check_same_events(const struct told *a, const struct told *b, double within, const char *operands) {
  ck_assert_msg(a->status == b->status && a->log.n == b->log.n, "%s: status %d %d, %zu and %zu events", operands,
                a->status, b->status, a->log.n, b->log.n);
  for (size_t i = 0; i < a->log.n; i++) {
    const struct coulomb_event *e = &a->log.event[i], *f = &b->log.event[i];
    ck_assert_msg(e->mass == f->mass && e->from == f->from && e->to == f->to, "%s: event %zu", operands, i);
    double gap = fabs(e->at.t - f->at.t);
    for (int k = 0; k < 2; k++)
      gap = fmax(
          gap, fmax(fabs(e->at.x[k] - f->at.x[k]), fmax(fabs(e->at.v[k] - f->at.v[k]), fabs(e->at.u[k] - f->at.u[k]))));
    ck_assert_msg(gap <= within, "%s: event %zu differs by %g", operands, i, gap);
  }
}

/* --- The law. --- */

CASE("coulomb", .seconds = 60);

TEST_EACH(law_away_from_its_limits_is_equation_2, 2000) {
  struct rng r = {(uint64_t)_i};
  double p[N_COULOMB], x[N_STATE];
  random_motion(p, x, &r);
  for (int i = 0; i < 2; i++)
    if (rng_between(&r, 0, 1)) x[DZ_1 + i] = p[COULOMB_V];
  enum coulomb_mode mode[2];
  coulomb_law_d(mode, p, x);
  double force[2] = {x[0] - p[COULOMB_CHI] * x[1], p[COULOMB_CHI] * (x[1] - x[0])};
  for (int i = 0; i < 2; i++) {
    double lag = p[COULOMB_V] - x[DZ_1 + i], most = p[COULOMB_UR1 + i];
    if (fabs(force[i]) == most) continue;
    bool sticks = lag == 0 && fabs(force[i]) < most;
    double eps = lag != 0 ? copysign(1, lag) : copysign(1, force[i]); /* u_i = eps u_si */
    enum coulomb_mode expected = sticks ? MODE_STICK : eps > 0 ? MODE_BELOW : MODE_ABOVE;
    ck_assert_msg(mode[i] == expected, "%s: mass %d in phase %c", show(p, x), i + 1, coulomb_letter(mode));
  }
}

/* chi = 1/2, eta = 1, V = 1, u_s = (1, 1), u_r = (2, 3).  From f_1, f_2: x_2 = 2 f_1 + 4 f_2, x_1 = 2 f_1 + 2 f_2. */
static const double half[N_COULOMB] = {0.5, 1, 1, 1, 1, 2, 3};
static void from_forces(double x[N_STATE], double f1, double f2, double v1, double v2) {
  x[Z_1] = 2 * f1 + 2 * f2;
  x[Z_2] = 2 * f1 + 4 * f2;
  x[DZ_1] = v1;
  x[DZ_2] = v2;
}

TABLE(at_limits, "tests/cases/law_at_limits.tsv", 6);
enum { F1, F2, V1, V2, LETTER, WHY }; /* its columns */

TEST_EACH(law_at_its_limits, at_limits.n) {
  char *const *row = at_limits.row[_i];
  double x[N_STATE];
  enum coulomb_mode mode[2];
  from_forces(x, atof(row[F1]), atof(row[F2]), atof(row[V1]), atof(row[V2]));
  coulomb_law_d(mode, half, x);
  ck_assert_msg(coulomb_letter(mode) == *row[LETTER], "%s: %c, not %c", row[WHY], coulomb_letter(mode), *row[LETTER]);
  for (int route = 0; route < N_ROUTES; route++) {
    OWNED(told) t = tell_for(route, half, x, 1.0 / 1024);
    ck_assert_msg(t.status == SS_OK && t.log.n == 0 && coulomb_letter(t.r.at.mode) == *row[LETTER],
                  "%s: %s goes on with %c", row[WHY], route_name[route], coulomb_letter(t.r.at.mode));
    for (int m = 0; m < 2; m++) { /* the modes chosen can be kept up for a while */
      double lag = half[COULOMB_V] - t.r.at.v[m];
      bool kept = t.r.at.mode[m] == MODE_STICK   ? fabs(t.r.at.u[m]) <= half[COULOMB_UR1 + m] * (1 + 1e-15)
                  : t.r.at.mode[m] == MODE_BELOW ? lag > 0
                                                 : lag < 0;
      ck_assert_msg(kept, "%s: %s, mass %d does not keep its mode", row[WHY], route_name[route], m + 1);
    }
  }
}

TEST(letters_are_distinct) {
  char seen[N_MODES * N_MODES + 1] = "";
  for (int i = 0; i < N_MODES * N_MODES; i++) {
    enum coulomb_mode mode[2] = {(enum coulomb_mode)(i / N_MODES), (enum coulomb_mode)(i % N_MODES)};
    ck_assert(!strchr(seen, coulomb_letter(mode)));
    seen[i] = coulomb_letter(mode);
  }
  ck_assert_str_eq(seen, "DCcGHXgxh");
}

/* --- Motions worked out by hand. --- */

TEST(sliding_without_events_keeps_its_energy) {
  /* Both masses slip around the equilibrium d under u_s, slower than the belt for ever: no event, and the energy of
     z = x - d in the potential (z_1^2 - 2 chi z_1 z_2 + chi z_2^2)/2 with masses 1 and 1/eta is constant. */
  static const double p[N_COULOMB] = {0.625, 2.5, 1, 1.5, 0, 2, 0.5};
  double d1 = p[COULOMB_US1] / (1 - p[COULOMB_CHI]), x[N_STATE] = {d1 + 0.25, d1 - 0.125, 0.125, -0.25};
  for (int route = 0; route < N_ROUTES; route++) {
    double energy[2];
    for (int k = 0; k < 2; k++) {
      OWNED(told) t = tell_for(route, p, x, k == 0 ? 0 : 300);
      double z1 = t.r.at.x[0] - d1, z2 = t.r.at.x[1] - d1, v1 = t.r.at.v[0], v2 = t.r.at.v[1];
      energy[k] = v1 * v1 + v2 * v2 / 2.5 + z1 * z1 - 2 * 0.625 * z1 * z2 + 0.625 * z2 * z2;
      ck_assert_uint_eq(t.log.n, 0);
      ck_assert_double_eq(t.r.at.t, k == 0 ? 0 : 300);
    }
    double drift = fabs(energy[1] - energy[0]), allowed = route == 0 ? 1e-11 : 1e-14;
    ck_assert_msg(drift < allowed * energy[0], "%s: energy changes by %g", route_name[route], drift / energy[0]);
  }
  struct coulomb_plan plan = coulomb_plan_default;
  plan.returns = 1;
  struct coulomb_result r;
  for (int route = 1; route < N_ROUTES; route++) {
    ck_assert_int_eq(simulate(&r, route, p, x, &plan, NULL), SS_UNABLE);
    ck_assert_int_eq(r.end, COULOMB_QUIET);
  }
  plan.max_steps = 1000;
  ck_assert_int_eq(simulate(&r, 0, p, x, &plan, NULL), SS_UNABLE);
  ck_assert_int_eq(r.end, COULOMB_STEPS);
  ck_assert_int_eq(r.steps, 1000);
}

/* Numbers between blanks. */
static void read_numbers(double *x, int n, const char *text) {
  for (int i = 0; i < n; i++) {
    char *end;
    x[i] = strtod(text, &end);
    text = end;
  }
}

TABLE(by_hand, "tests/cases/motions_by_hand.tsv", 9);
enum { PARAMETERS, START, DURATION, ROUTES, WITHIN, EVENTS, FRICTION, WORD, TOUCHES }; /* its columns */

TEST_EACH(motions_worked_out_by_hand, by_hand.n) {
  static const enum coulomb_mode mode_of[128] = {['s'] = MODE_STICK, ['-'] = MODE_BELOW, ['+'] = MODE_ABOVE};
  char *const *row = by_hand.row[_i];
  double p[N_COULOMB], x[N_STATE], u[2], at, within = atof(row[WITHIN]);
  read_numbers(p, N_COULOMB, row[PARAMETERS]);
  read_numbers(x, N_STATE, row[START]);
  read_numbers(u, 2, row[FRICTION]);
  for (int route = 0; route < atoi(row[ROUTES]); route++) {
    OWNED(told) t = tell_for(route, p, x, atof(row[DURATION]));
    const char *next = row[EVENTS];
    int mass;
    char from, to, mark;
    size_t n = 0;
    for (; sscanf(next, "%lf:%d:%c>%c%c", &at, &mass, &from, &to, &mark) == 5; n++) {
      ck_assert_msg(n < t.log.n, "%s: no event %zu", route_name[route], n);
      const struct coulomb_event *e = &t.log.event[n];
      ck_assert_double_eq_tol(e->at.t, at, within);
      ck_assert(e->mass == mass - 1 && e->from == mode_of[(int)from] && e->to == mode_of[(int)to]);
      ck_assert(e->simultaneous == (mark == '&') && (e->grazing || mark != '~'));
      next += strcspn(next, " ");
      next += *next == ' ';
    }
    ck_assert_msg(t.log.n == n, "%s: %s", route_name[route], text_str(&t.word));
    for (int i = 0; i < 2 && n > 0; i++) ck_assert_double_eq_tol(t.log.event[n - 1].at.u[i], u[i], within);
    ck_assert_str_eq(text_str(&t.word), row[WORD]);
    ck_assert(t.r.touches > 0 || !is_yes(row[TOUCHES]));
  }
}

/* chi = 3/8, V = 1: while m2 sticks, x_1' - V = x_1'(0) - V + C (cos t - 1) + S sin t with C = x_1'(0) - 3/8 and
   S = x_1''(0).  At rest with S = 1/2 the highest value is hypot(3, 4)/8 - 5/8 = 0, at t = atan2(4, -3). */
static const double grazing[N_COULOMB] = {0.375, 1, 1, 1.5, 1, 2, 100};
static void grazing_start(double x[N_STATE], double s) {
  x[Z_1] = (1.5 - s + 1.5) / 0.625; /* f_1 = u_s1 - S, f_2 = 3/2: (4, 8) for S = 1/2 */
  x[Z_2] = x[Z_1] + 4;
  x[DZ_1] = 0;
  x[DZ_2] = 1;
}

/* A decimal, in mpfr. */
static void set_text(void *z, const char *decimal, slong prec) {
  RATIONALS(q, 1, rationals(&decimal, 1));
  num_mpfr.set_q(z, q, prec);
}

TEST(mpfr_decides_what_double_precision_cannot) {
  /* The grazing start with S = 1/2 + 1e-40 or 1/2 - 1e-40: a crossing, at a distance of about sqrt(2 * 0.8e-40 / 0.625)
     from the crest, or a miss.  In double precision both are the same motion. */
  struct num_ctx ctx = num_ctx_mpfr(400);
  for (int miss = 0; miss < 2; miss++) {
    double xd[N_STATE];
    grazing_start(xd, 0.5);
    OWNED(num_vec) p = vec_of(grazing, N_COULOMB, ctx), x = vec_of(xd, N_STATE, ctx);
    mpfr_ptr x1 = num_vec_at(&x, Z_1), x2 = num_vec_at(&x, Z_2);
    set_text(x1, miss ? "1e-40" : "-1e-40", 400);
    mpfr_add_d(x1, x1, 2.5, MPFR_RNDN); /* f_1 + f_2 */
    mpfr_div_d(x1, x1, 0.625, MPFR_RNDN);
    mpfr_add_d(x2, x1, 4, MPFR_RNDN);
    struct coulomb_plan plan = coulomb_plan_default;
    OWNED(coulomb_log) log = {.n = 0};
    struct coulomb_result r;
    struct coulomb_sink sink = coulomb_log_sink(&log);
    plan.duration = miss ? 6.5 : 2.25;
    ck_assert_int_eq(coulomb_simulate_exact(&r, &p, &x, &plan, &sink), SS_OK);
    ck_assert_uint_eq(log.n, miss ? 0u : 1u);
    if (!miss) ck_assert(log.event[0].mass == 0 && log.event[0].to == MODE_STICK && log.event[0].grazing);
    ck_assert(r.touches > 0);
  }
}

TEST(a_mass_may_leave_the_belt_slowly) {
  /* Static and sliding friction differ by 2^-32, so that m2 leaves V with almost no acceleration while m1 rushes by. */
  double x[N_STATE], p[N_COULOMB] = {0.5, 0x1p-10, 0x1p-9, 0, 0.25, 0.0625, 0.25 + 0x1p-32};
  from_forces(x, 0.125, 0, 35, p[COULOMB_V]);
  OWNED_CLEARED(routes_clear) struct told t[N_ROUTES] = {{.status = SS_OK}};
  for (int route = 0; route < N_ROUTES; route++) {
    t[route] = tell_for(route, p, x, 10);
    ck_assert_int_eq(t[route].r.end, COULOMB_DONE);
    ck_assert(t[route].log.n > 0 && t[route].log.event[0].mass == 1 && t[route].log.event[0].to == MODE_ABOVE);
  }
  check_same_events(&t[1], &t[2], 1e-9, "double");
  check_same_events(&t[0], &t[2], 1e-8, "ode");
}

/* --- The routes against each other. --- */

TEST_EACH(routes_agree_event_by_event, 200) {
  struct rng r = {(uint64_t)_i};
  double p[N_COULOMB], x[N_STATE];
  random_motion(p, x, &r);
  OWNED_CLEARED(routes_clear) struct told t[N_ROUTES] = {{.status = SS_OK}};
  for (int route = 0; route < N_ROUTES; route++) {
    t[route] = tell_for(route, p, x, 40);
    ck_assert_msg(t[route].status == SS_OK && t[route].r.at.t == 40, "%s: %s ends with %s", show(p, x),
                  route_name[route], coulomb_end_name[t[route].r.end]);
  }
  check_same_events(&t[1], &t[2], 1e-10, show(p, x));
  check_same_events(&t[0], &t[2], 1e-8, show(p, x));
}

TEST_EACH(scaling_everything_scales_the_motion, 50) {
  /* x, x', V and u times 8: the same times; in double precision the same bits. */
  struct rng r = {(uint64_t)_i};
  double p[N_COULOMB], x[N_STATE], q[N_COULOMB], y[N_STATE];
  random_motion(p, x, &r);
  for (int i = 0; i < N_COULOMB; i++) q[i] = i < COULOMB_V ? p[i] : 8 * p[i];
  for (int i = 0; i < N_STATE; i++) y[i] = 8 * x[i];
  for (int route = 0; route < 2; route++) {
    OWNED(told) s = tell_for(route, p, x, 20), t = tell_for(route, q, y, 20);
    ck_assert_uint_eq(s.log.n, t.log.n);
    for (size_t i = 0; i < s.log.n; i++) {
      const struct coulomb_row *a = &s.log.event[i].at, *b = &t.log.event[i].at;
      bool same = a->t == b->t && 8 * a->x[0] == b->x[0] && 8 * a->v[1] == b->v[1] && 8 * a->u[0] == b->u[0];
      ck_assert_msg(same, "%s: %s, event %zu", show(p, x), route_name[route], i);
    }
  }
}

TEST_EACH(a_motion_can_be_taken_up_again, 50) {
  struct rng r = {(uint64_t)_i};
  double p[N_COULOMB], x[N_STATE];
  random_motion(p, x, &r);
  for (int route = 0; route < N_ROUTES; route++) {
    OWNED(told) whole = tell_for(route, p, x, 11), part = tell_for(route, p, x, 4.1875);
    double middle[N_STATE] = {part.r.at.x[0], part.r.at.x[1], part.r.at.v[0], part.r.at.v[1]};
    OWNED(told) rest = tell_for(route, p, middle, 11 - 4.1875);
    ck_assert_msg(part.log.n + rest.log.n == whole.log.n, "%s: %s", show(p, x), route_name[route]);
    for (int i = 0; i < 2; i++) {
      ck_assert(rest.r.at.mode[i] == whole.r.at.mode[i]);
      ck_assert_double_eq_tol(rest.r.at.x[i], whole.r.at.x[i], 1e-8);
      ck_assert_double_eq_tol(rest.r.at.v[i], whole.r.at.v[i], 1e-8);
    }
  }
}

/* --- Samples, limits, refusals. --- */

struct tape_recorder {
  struct coulomb_row row[200];
  size_t n, most;
};
static bool record(void *self, const struct coulomb_row *row) {
  struct tape_recorder *t = self;
  if (t->n == t->most) return false;
  t->row[t->n] = *row;
  if (row->exact)
    for (int i = 0; i < 2; i++) {
      ck_assert_double_eq(row->exact->ctx.type->get_d(num_vec_at(row->exact, 1 + i)), row->x[i]);
      ck_assert_double_eq(row->exact->ctx.type->get_d(num_vec_at(row->exact, 3 + i)), row->v[i]);
    }
  t->row[t->n++].exact = NULL;
  return true;
}

TEST_EACH(samples_of_the_routes_agree, 20) {
  struct rng r = {(uint64_t)_i};
  static struct tape_recorder rec[N_ROUTES];
  double p[N_COULOMB], x[N_STATE];
  random_motion(p, x, &r);
  struct coulomb_plan plan = coulomb_plan_default;
  plan.duration = 12.2;
  plan.sample = 0.1; /* 122 steps of it exceed 12.2 by rounding */
  for (int route = 0; route < N_ROUTES; route++) {
    rec[route].n = 0;
    rec[route].most = 200;
    struct coulomb_result end;
    struct coulomb_sink sink = {&rec[route], NULL, record};
    ck_assert_int_eq(simulate(&end, route, p, x, &plan, &sink), SS_OK);
    ck_assert_uint_eq(rec[route].n, 123);
    for (size_t k = 0; k < rec[route].n; k++) {
      const struct coulomb_row *a = &rec[route].row[k], *b = &rec[0].row[k];
      ck_assert_double_eq_tol(a->t, 0.1 * (double)k, 1e-13);
      for (int i = 0; i < 2; i++) {
        ck_assert_msg(a->mode[i] == b->mode[i], "%s: %s at %g", show(p, x), route_name[route], a->t);
        double gap = fmax(fabs(a->x[i] - b->x[i]), fmax(fabs(a->v[i] - b->v[i]), fabs(a->u[i] - b->u[i])));
        ck_assert_msg(gap < 1e-9, "%s: %s at %g is off by %g", show(p, x), route_name[route], a->t, gap);
        if (a->mode[i] == MODE_STICK)
          ck_assert(a->v[i] == p[COULOMB_V] && fabs(a->u[i]) <= p[COULOMB_UR1 + i] + 1e-9);
        else
          ck_assert_double_eq(a->u[i], a->v[i] < p[COULOMB_V] ? p[COULOMB_US1 + i] : -p[COULOMB_US1 + i]);
      }
    }
    ck_assert_double_eq(rec[route].row[122].t, end.at.t);
    ck_assert_double_eq(rec[route].row[122].x[0], end.at.x[0]);
  }
}

/* A start near the paper's orbit. */
static const double paper[N_COULOMB] = {0.8, 1, 1, 3.5 - 2.7844, 2.2 - 0.8587, 3.5, 2.2};
static void paper_start(double x[N_STATE], double z10, double z20) {
  OWNED(num_vec) p = vec_of(paper, N_COULOMB, num_ctx_double()), s = vec_new(N_STATE, num_ctx_double());
  ck_assert_int_eq(coulomb_start_set(&s, &p, &z10, &z20), SS_OK);
  memcpy(x, s.data, N_STATE * sizeof *x);
}

static bool refuse(void *self, const struct coulomb_event *e) {
  (void)self;
  return e->at.mode[0] != MODE_STICK;
}

TEST(every_limit_ends_a_run) {
  double x[N_STATE];
  paper_start(x, 0.978, -2.125);
  for (int route = 0; route < N_ROUTES; route++) {
    struct coulomb_plan plan = coulomb_plan_default;
    struct coulomb_result r;
    static struct tape_recorder rec = {.most = 5};
    rec.n = 0;
    plan.returns = 3;
    ck_assert_int_eq(simulate(&r, route, paper, x, &plan, NULL), SS_OK);
    ck_assert(r.end == COULOMB_DONE && r.returns == 3 && r.events == 12 && coulomb_letter(r.at.mode) == 'D');
    plan.max_events = 7;
    ck_assert_int_eq(simulate(&r, route, paper, x, &plan, NULL), SS_UNABLE);
    ck_assert(r.end == COULOMB_EVENTS && r.events == 7);
    plan.max_events = 100;
    plan.max_steps = 20;
    ck_assert_int_eq(simulate(&r, route, paper, x, &plan, NULL), SS_UNABLE);
    ck_assert_int_eq(r.end, COULOMB_STEPS);
    plan.max_steps = 1000;
    ck_assert_int_eq(simulate(&r, route, paper, x, &plan, &(struct coulomb_sink){NULL, refuse, NULL}), SS_OK);
    ck_assert(r.end == COULOMB_STOPPED && r.events == 3 && coulomb_letter(r.at.mode) == 'C');
    plan.sample = 0.5;
    ck_assert_int_eq(simulate(&r, route, paper, x, &plan, &(struct coulomb_sink){&rec, NULL, record}), SS_OK);
    ck_assert(r.end == COULOMB_STOPPED && rec.n == 5);
    plan.returns = 0;
    plan.duration = 2.25; /* the sixth sample belongs to the last stretch */
    rec.most = 4;
    rec.n = 0;
    ck_assert_int_eq(simulate(&r, route, paper, x, &plan, &(struct coulomb_sink){&rec, NULL, record}), SS_OK);
    ck_assert(r.end == COULOMB_STOPPED && rec.n == 4);
    rec.most = 5;
  }
}

TEST(nonsense_is_refused) {
  static const double bad[][2] = {{COULOMB_CHI, 0},   {COULOMB_CHI, 1},       {COULOMB_ETA, 0},   {COULOMB_V, 0},
                                  {COULOMB_V, -1},    {COULOMB_US1, -1},      {COULOMB_US2, 2.2}, {COULOMB_UR1, 0.5},
                                  {COULOMB_ETA, NAN}, {COULOMB_UR2, INFINITY}};
  double p[N_COULOMB], x[N_STATE];
  struct coulomb_result r;
  struct coulomb_plan plan = coulomb_plan_default;
  plan.duration = 1;
  paper_start(x, 0.978, -2.125);
  for (int route = 0; route < 2; route++) {
    for (size_t i = 0; i < COUNT(bad); i++) {
      memcpy(p, paper, sizeof p);
      p[(int)bad[i][0]] = bad[i][1];
      ck_assert_int_eq(simulate(&r, route, p, x, &plan, NULL), SS_DOMAIN);
    }
    struct coulomb_plan endless = coulomb_plan_default, backward = plan;
    backward.duration = -1;
    ck_assert_int_eq(simulate(&r, route, paper, x, &endless, NULL), SS_DOMAIN);
    ck_assert_int_eq(simulate(&r, route, paper, x, &backward, NULL), SS_DOMAIN);
    double nowhere[N_STATE] = {0, 0, NAN, 1}, far[N_STATE] = {1e308, -1e308, -1e308, 1e308};
    ck_assert_int_eq(simulate(&r, route, paper, nowhere, &plan, NULL), SS_DOMAIN);
    ck_assert_int_eq(simulate(&r, route, paper, far, &plan, NULL), SS_UNABLE);
    ck_assert_int_eq(r.end, COULOMB_FAILED);
  }
  plan.tolerance = 1e-15;
  ck_assert_int_eq(simulate(&r, 0, paper, x, &plan, NULL), SS_DOMAIN);
}

/* A belt far faster than the forces are large: an answer while the law can be told, else a refusal at once, after no
   step at all. */
TEST(a_law_below_rounding_is_refused) {
  static const double speed[] = {1e35, 1e100, 1e300};
  double p[N_COULOMB], x[N_STATE];
  struct coulomb_result r;
  struct coulomb_plan plan = coulomb_plan_default;
  plan.duration = 400;
  memcpy(p, paper, sizeof p);
  for (int route = 0; route < 2; route++) {
    paper_start(x, 0.978, -2.125);
    for (int i = 0; i < 3; i++) {
      p[COULOMB_V] = x[DZ_1] = x[DZ_2] = speed[i];
      ck_assert_int_eq(simulate(&r, route, p, x, &plan, NULL), SS_UNABLE);
      ck_assert(r.end == COULOMB_BLURRED && r.steps == 0 && r.at.t == 0 && r.at.v[0] == speed[i]);
    }
    p[COULOMB_V] = x[DZ_1] = x[DZ_2] = 1e10;
    ck_assert_int_eq(simulate(&r, route, p, x, &plan, NULL), SS_OK);
    ck_assert(r.end == COULOMB_DONE && r.at.t == 400);
    p[COULOMB_V] = 1; /* far from rest, friction is as nothing, and no mass comes to rest on the belt */
    x[Z_1] = 1e99;
    ck_assert_int_eq(simulate(&r, route, p, x, &plan, NULL), SS_OK);
  }
}

/* A belt that hardly moves.  The masses stick until f_1 = u_r1, after (u_r1 - f_1)/((1 - chi) V); then m1 jumps, as if
   the belt stood still: f_1 swings from u_r1 about u_s1 to 2 u_s1 - u_r1, while m2, with friction enough, stays. */
TEST(a_slow_belt_takes_few_steps) {
  static const double speed[] = {1e-6, 1e-10, 1e-14, 1e-100, 1e-300};
  double p[N_COULOMB], x[N_STATE];
  struct coulomb_result r;
  struct coulomb_plan plan = coulomb_plan_default;
  plan.returns = 1;
  memcpy(p, paper, sizeof p);
  p[COULOMB_UR2] = 100;
  for (int route = 0; route < 2; route++)
    for (int i = 0; i < 5; i++) {
      double chi = p[COULOMB_CHI], V = speed[i];
      paper_start(x, 0.978, -2.125);
      p[COULOMB_V] = x[DZ_1] = x[DZ_2] = V;
      double wait = (p[COULOMB_UR1] - (x[Z_1] - chi * x[Z_2])) / ((1 - chi) * V), there = x[Z_2] + V * wait;
      OWNED(coulomb_log) log = {.n = 0};
      struct coulomb_sink sink = coulomb_log_sink(&log);
      ck_assert_int_eq(simulate(&r, route, p, x, &plan, &sink), SS_OK);
      ck_assert_int_lt(r.steps, 2000);
      ck_assert_uint_eq(log.n, 2);
      OWNED(text) word = {0}; /* the slip-stick phase takes no time that the wait could be told apart by */
      coulomb_log_word(&word, &log);
      ck_assert_str_eq(text_str(&word), "GD");
      ck_assert_double_eq_tol(log.event[0].at.t, wait, 1e-11 * wait);
      ck_assert_double_eq_tol(r.at.x[1], there, 1e-5);
      ck_assert_double_eq_tol(r.at.x[0], 2 * p[COULOMB_US1] - p[COULOMB_UR1] + chi * there, 1e-5);
    }
}

TEST(parameters_from_the_models) {
  static const double model[N_PARAMS] = {0.5, 2, 1, 0.75, 1.25}, limits[2] = {1.75, 1.5}, low[2] = {0.5, 2};
  struct num_ctx ctx = num_ctx_mpfr(64);
  OWNED(num_vec) m = vec_of(model, N_PARAMS, ctx), l = vec_of(limits, 2, ctx), k = vec_of(low, 2, ctx);
  OWNED(num_vec) p = vec_new(N_COULOMB, ctx);
  ck_assert_int_eq(coulomb_params_set(&p, &m, &l), SS_OK);
  static const double expected[N_COULOMB] = {0.5, 2, 1, 1, 0.25, 1.75, 1.5};
  for (int i = 0; i < N_COULOMB; i++) ck_assert_double_eq(num_mpfr.get_d(num_vec_at(&p, i)), expected[i]);
  ck_assert_int_eq(coulomb_params_set(&p, &m, &k), SS_DOMAIN); /* u_s1 = 1/2 - 3/4 < 0 */
}

/* --- The paper's orbit: orbit 1 of set paper in tests/oracle/orbits.tsv. --- */

static const char *known(int column) {
  return known_orbit_named("paper", 1).field[column];
}

struct watch {
  mpfr_t last, worst, off; /* the last event; the worst of a duration; x_2 - x_1 of the latest return */
  long n;
};

static bool watch_event(void *self, const struct coulomb_event *e) {
  struct watch *w = self;
  MPFR_NUMBERS(300, d, expected);
  mpfr_srcptr t = num_vec_at(e->at.exact, 0);
  mpfr_sub(d, t, w->last, MPFR_RNDN);
  mpfr_set(w->last, t, MPFR_RNDN);
  set_text(expected, known(KNOWN_TA + (int)(w->n++ % 4)), 300);
  mpfr_sub(d, d, expected, MPFR_RNDN);
  if (mpfr_cmpabs(d, w->worst) > 0) mpfr_abs(w->worst, d, MPFR_RNDN);
  if (coulomb_letter(e->at.mode) == 'D')
    mpfr_sub(w->off, num_vec_at(e->at.exact, 2), num_vec_at(e->at.exact, 1), MPFR_RNDN);
  return true;
}

/* The motion in mpfr from the orbit, z_2 moved by the given amount, over some returns. */
static void run_orbit(struct watch *w, const char *moved, long returns) {
  struct num_ctx ctx = num_ctx_mpfr(300);
  static const char *const decimals[N_COULOMB] = {"0.8", "1", "1", "0.7156", "1.3413", "3.5", "2.2"};
  OWNED(num_vec) p = vec_new(N_COULOMB, ctx), z = vec_new(2, ctx), x = vec_new(N_STATE, ctx);
  for (int i = 0; i < N_COULOMB; i++) set_text(num_vec_at(&p, i), decimals[i], 300);
  for (int i = 0; i < 2; i++) set_text(num_vec_at(&z, i), known(KNOWN_Z10 + i), 300);
  mpfr_inits2(300, w->last, w->worst, w->off, (mpfr_ptr)NULL);
  mpfr_set_zero(w->last, 1);
  mpfr_set_zero(w->worst, 1);
  w->n = 0;
  set_text(w->off, moved, 300);
  num_mpfr.add(num_vec_at(&z, 1), num_vec_at(&z, 1), w->off, 300);
  ck_assert_int_eq(coulomb_start_set(&x, &p, num_vec_at(&z, 0), num_vec_at(&z, 1)), SS_OK);
  struct coulomb_plan plan = coulomb_plan_default;
  struct coulomb_result r;
  plan.returns = returns;
  ck_assert_int_eq(coulomb_simulate_exact(&r, &p, &x, &plan, &(struct coulomb_sink){w, watch_event, NULL}), SS_OK);
}

static void watch_clear(struct watch *w) {
  mpfr_clears(w->last, w->worst, w->off, (mpfr_ptr)NULL);
}

/* 60 digits, a tenth of which the multiplier could cost in 200 periods at most; delta = 1e-30 in z_2 - z_1 becomes
   trace^200 delta (1 + order delta trace^200). */
TEST(the_orbit_in_mpfr_to_the_oracles_digits) {
  OWNED(watch) w, rest;
  run_orbit(&rest, "0", 200);
  ck_assert_int_eq(rest.n, 800);
  ck_assert_msg(mpfr_cmp_d(rest.worst, 1e-56) < 0, "off by %g", mpfr_get_d(rest.worst, MPFR_RNDN));
  run_orbit(&w, "1e-30", 200);
  MPFR_NUMBERS(300, growth);
  set_text(growth, known(KNOWN_TRACE), 300);
  mpfr_pow_si(growth, growth, 200, MPFR_RNDN);
  mpfr_sub(w.off, w.off, rest.off, MPFR_RNDN);
  mpfr_mul_d(w.off, w.off, 1e30, MPFR_RNDN); /* 1e30 as a double is right to 1e-16 */
  mpfr_div(w.off, w.off, growth, MPFR_RNDN);
  mpfr_sub_si(w.off, w.off, 1, MPFR_RNDN);
  ck_assert_msg(fabs(mpfr_get_d(w.off, MPFR_RNDN)) < 1e-15, "off by %g", mpfr_get_d(w.off, MPFR_RNDN));
}

TEST(the_printed_start_over_200_periods) {
  /* The orbit is unstable, so the motion leaves it; all routes must see it leave alike, and where it goes must be a
     motion that repeats. */
  double x[N_STATE];
  paper_start(x, 0.8921, -2.1958);
  OWNED_CLEARED(routes_clear) struct told t[N_ROUTES] = {{.status = SS_OK}};
  struct coulomb_plan plan = coulomb_plan_default;
  plan.returns = 200;
  for (int route = 0; route < N_ROUTES; route++) t[route] = tell(route, paper, x, &plan);
  check_same_events(&t[1], &t[2], 1e-9, "double");
  check_same_events(&t[0], &t[2], 1e-9, "ode");
  const char *word = text_str(&t[2].word);
  size_t whole = 0, n = t[2].log.n;
  while (strncmp(word + 4 * whole, "GHCD", 4) == 0) whole++;
  ck_assert(whole > 20 && 4 * whole < n); /* 0.015 off at first, times 1.023 in each period */
  for (size_t i = n - 400; i + 8 < n; i++) {
    ck_assert_int_eq(word[i], word[i + 8]);
    ck_assert_double_eq_tol(t[2].log.event[i].at.x[0], t[2].log.event[i + 8].at.x[0], 1e-10);
  }
}
