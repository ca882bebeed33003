/* One law suite for all number types, run through the method table.

   The types audit each other: a rounded type must give Arb's value at much higher precision to within its rounding,
   and a ball must hold what MPFR gives at much higher precision at points of its operands.  The other laws are
   identities of arithmetic.  Operands are random and biased to the edges; a failing trial prints them and its seed. */
#include "laws_num.h"
#include "model/model.h"
#include "rational.h"
#include "rng.h"
#include "test.h"

enum { TRIALS = 300, REFERENCE = 1600 };

struct num_ctx law_context(int i) {
  const struct num_ctx all[LAW_CONTEXTS] = {num_ctx_double(), num_ctx_mpfr(24), num_ctx_mpfr(200), num_ctx_arb(30),
                                            num_ctx_arb(160)};
  return all[i];
}

/* Operands and results of one trial, in one context; all are NaN-free when a trial begins. */
enum { X, Y, Z, U, V, W, N_SLOTS };
struct trial {
  struct num_ctx ctx;
  const struct num_type *f;
  struct num_vec slots;
  uint64_t seed;
  struct rng rng;
  const char *law, *op;
};

static void *at(const struct trial *t, int i) {
  return num_vec_at(&t->slots, i);
}

static struct trial trial_of(struct num_ctx ctx, const char *law) {
  struct trial t = {.ctx = ctx, .f = ctx.type, .law = law, .op = ""};
  num_vec_init(&t.slots, N_SLOTS, ctx);
  return t;
}

static void trial_clear(struct trial *t) {
  num_vec_clear(&t->slots);
}

/* Starts trial i with fresh X, Y, Z; balls are exact half of the time. */
static void trial_begin(struct trial *t, int i, slong reach) {
  NUMBERS(arb, x);
  t->seed = (uint64_t)i * 1000003u + strlen(t->law);
  t->rng.state = t->seed;
  for (int k = X; k <= Z; k++) {
    rng_edge(arb_midref(x), &t->rng, t->ctx.prec, reach);
    mag_zero(arb_radref(x));
    if (t->f->rigorous && rng_next(&t->rng) % 2) {
      arf_get_mag(arb_radref(x), arb_midref(x));
      mag_mul_2exp_si(arb_radref(x), arb_radref(x), rng_between(&t->rng, -t->ctx.prec, 1));
    }
    if (t->f->set_arb(at(t, k), x, t->ctx.prec) != SS_OK) ck_abort_msg("operand out of range");
  }
}

static void get(arb_t x, const struct trial *t, int i) {
  t->f->get_arb(x, at(t, i));
}

/* Fails unless ok, with every slot in Arb's exact dump format. */
static void require(const struct trial *t, bool ok, const char *what) {
  struct text out = {0};
  arb_t x;
  if (ok) return;
  arb_init(x);
  for (int i = 0; i < N_SLOTS; i++) {
    get(x, t, i);
    char *exact = arb_dump_str(x);
    text_printf(&out, "\n  %c = ", "XYZUVW"[i]);
    num_print_ball(&out, x, 30);
    text_printf(&out, "   (%s)", exact);
    flint_free(exact);
  }
  ck_abort_msg("%s at %ld bits, law \"%s\" %s, seed %llu: %s%s", t->f->name, (long)t->ctx.prec, t->law, t->op,
               (unsigned long long)t->seed, what, text_str(&out));
}

/* --- The operations by number. --- */

enum {
#define NUM_UNARY(op)  OP_##op,
#define NUM_BINARY(op) OP_##op,
#include "num/ops.def"
  N_OPS
};

static const struct {
  const char *name;
  bool binary;
} ops[N_OPS] = {
#define NUM_UNARY(op)  {#op, false},
#define NUM_BINARY(op) {#op, true},
#include "num/ops.def"
};

static int apply(const struct num_ctx *ctx, int op, void *z, const void *x, const void *y) {
  switch (op) {
#define NUM_UNARY(name)                                                                                                \
  case OP_##name:                                                                                                      \
    return ctx->type->name(z, x, ctx->prec);
#define NUM_BINARY(name)                                                                                               \
  case OP_##name:                                                                                                      \
    return ctx->type->name(z, x, y, ctx->prec);
#include "num/ops.def"
  default:
    ck_abort_msg("no such operation");
    return SS_UNABLE;
  }
}

/* --- Comparisons of slots. --- */

static bool is_nan(const struct trial *t, int i) {
  return isnan(t->f->get_d(at(t, i)));
}

/* The same value, or both NaN. */
static bool same(const struct trial *t, int i, int j) {
  NUMBERS(arb, x, y);
  get(x, t, i);
  get(y, t, j);
  return arb_equal(x, y) || (arf_is_nan(arb_midref(x)) && arf_is_nan(arb_midref(y)));
}

/* Slot i agrees with slot j: balls overlap, rounded values differ by at most ulps units of 2^-prec times scale (slot,
   or -1 for the values' own size). */
static bool near(const struct trial *t, int i, int j, int scale, slong ulps) {
  NUMBERS(arb, x, y, bound);
  get(x, t, i);
  get(y, t, j);
  bool yes = t->f->rigorous && arb_overlaps(x, y);
  if (!t->f->rigorous) {
    get(bound, t, scale < 0 ? i : scale);
    arb_abs(bound, bound);
    arb_mul_si(bound, bound, ulps, REFERENCE);
    arb_mul_2exp_si(bound, bound, -t->ctx.prec);
    arb_sub(x, x, y, ARF_PREC_EXACT);
    arb_abs(x, x);
    yes = arb_le(x, bound);
  }
  return yes;
}

static bool equals_si(const struct trial *t, int i, slong n) {
  NUMBERS(arb, x);
  get(x, t, i);
  return t->f->rigorous ? arb_contains_si(x, n) : arb_equal_si(x, n);
}

static void put_d(const struct trial *t, int i, double x) {
  require(t, t->f->set_d(at(t, i), x, t->ctx.prec) == SS_OK, "set_d fails");
}

/* Slot i becomes a point, or the ball [low, high], whose ends are multiples of 1/4 and not large. */
static void put_interval(const struct trial *t, int i, double low, double high) {
  NUMBERS(arb, x);
  if (low == high) {
    put_d(t, i, low);
    return;
  }
  arb_set_d(x, (low + high) / 2);
  mag_set_ui_2exp_si(arb_radref(x), (ulong)(4 * (high - low)), -3);
  t->f->set_arb(at(t, i), x, t->ctx.prec);
}

/* --- The types against each other. --- */

/* How far a rounded result may be from the exact one, in units of 2^-prec of its size: half an ulp when it is correctly
   rounded; the C library promises less for the functions. */
static slong tolerance(const struct num_type *f, int op) {
  bool library = f == &num_double && (op == OP_sin || op == OP_cos || op == OP_cot || op == OP_atan2 || op == OP_sinc ||
                                      op == OP_stumpff || op == OP_hypot || op == OP_exp);
  return library ? 4 : 1;
}

/* A rounded result against Arb's at REFERENCE bits. */
static void check_rounded(struct trial *t, int op, arb_t x, arb_t y) {
  const struct num_ctx reference = num_ctx_arb(REFERENCE);
  NUMBERS(arb, exact, z, bound);
  int status = apply(&t->ctx, op, at(t, U), at(t, X), at(t, Y));
  int expected = apply(&reference, op, exact, x, y);
  get(z, t, U);
  arb_abs(bound, exact);
  if (t->f == &num_double && expected == SS_OK && arf_cmpabs_2exp_si(arb_midref(exact), 1024) >= 0)
    expected = SS_UNABLE;
  require(t, status == expected, "status differs from the reference");
  require(t, (status == SS_OK) != is_nan(t, U), "NaN and status disagree");
  arb_mul_2exp_si(bound, bound, -t->ctx.prec);
  if (t->f == &num_double) { /* half the least subnormal number */
    NUMBERS(arb, least);
    arb_set_ui(least, 1);
    arb_mul_2exp_si(least, least, -1075);
    arb_max(bound, bound, least, REFERENCE);
  }
  arb_mul_si(bound, bound, tolerance(t->f, op), REFERENCE);
  arb_sub(exact, exact, z, REFERENCE);
  arb_abs(exact, exact);
  require(t, status != SS_OK || !arb_gt(exact, bound), "too far from the reference");
}

/* The point of a ball at mid + place/2 * rad. */
static void point(mpfr_t p, const arb_t x, slong place) {
  NUMBERS(arf, r);
  arf_set_mag(r, arb_radref(x));
  arf_mul_si(r, r, place, ARF_PREC_EXACT, ARF_RND_DOWN);
  arf_mul_2exp_si(r, r, -1);
  arf_add(r, r, arb_midref(x), ARF_PREC_EXACT, ARF_RND_DOWN);
  if (arf_get_mpfr(p, r, MPFR_RNDN) != 0) ck_abort_msg("the reference cannot hold the point");
}

/* A ball against MPFR at REFERENCE bits, at five points of each operand, its ends among them. */
static void check_ball(struct trial *t, int op, arb_t x, arb_t y) {
  const struct num_ctx reference = num_ctx_mpfr(REFERENCE);
  NUMBERS(arb, z, exact);
  MPFR_NUMBERS(REFERENCE, px, py, pz);
  bool points = arb_is_exact(x) && (arb_is_exact(y) || !ops[op].binary);
  int status = apply(&t->ctx, op, at(t, U), at(t, X), at(t, Y));
  get(z, t, U);
  require(t, (status == SS_OK) != is_nan(t, U), "NaN and status disagree");
  for (slong i = 0; i < 5; i++) {
    point(px, x, i - 2);
    point(py, y, (2 * i) % 5 - 2);
    int expected = apply(&reference, op, pz, px, py);
    num_mpfr.get_arb(exact, pz);
    NUMBERS(mag, error);
    arf_get_mag(error, arb_midref(exact));
    mag_mul_2exp_si(error, error, -REFERENCE);
    arb_add_error_mag(exact, error);
    if (status == SS_OK) require(t, expected == SS_OK && arb_overlaps(z, exact), "a point is not enclosed");
    if (status == SS_DOMAIN) require(t, expected == SS_DOMAIN, "SS_DOMAIN, but a point has a value");
    if (status == SS_UNABLE) require(t, !points || op == OP_cot || expected == SS_UNABLE, "cannot tell at a point");
  }
}

CASE("laws", .seconds = 60);

TEST_EACH(types_agree, LAW_CONTEXTS) {
  NUMBERS(arb, x, y);
  OWNED(trial) t = trial_of(law_context(_i), "types agree");
  for (int i = 0; i < TRIALS; i++)
    for (int op = 0; op < N_OPS; op++) {
      t.op = ops[op].name;
      trial_begin(&t, i * N_OPS + op, 500);
      get(x, &t, X);
      get(y, &t, Y);
      if (t.f->rigorous)
        check_ball(&t, op, x, y);
      else
        check_rounded(&t, op, x, y);
    }
}

/* Results at exact points are as narrow as the precision promises: an enclosure that is always true but wide would pass
   every other law. */
TEST_EACH(balls_are_tight, LAW_CONTEXTS) {
  static const int tight[] = {OP_add, OP_sub,   OP_mul,   OP_div,     OP_sqrt, OP_sin,
                              OP_cos, OP_atan2, OP_hypot, OP_stumpff, OP_sinc};
  NUMBERS(arb, z);
  OWNED(trial) t = trial_of(law_context(_i), "balls are tight");
  for (int i = 0; i < TRIALS && t.f->rigorous; i++)
    for (size_t k = 0; k < COUNT(tight); k++) {
      t.op = ops[tight[k]].name;
      trial_begin(&t, i, 60);
      for (int j = X; j <= Y; j++) {
        get(z, &t, j);
        mag_zero(arb_radref(z));
        t.f->set_arb(at(&t, j), z, t.ctx.prec);
      }
      if (apply(&t.ctx, tight[k], at(&t, U), at(&t, X), at(&t, Y)) != SS_OK) continue;
      get(z, &t, U);
      bool absolute = tight[k] == OP_sin || tight[k] == OP_cos || tight[k] == OP_sinc;
      NUMBERS(mag, scale);
      arb_get_mag(scale, z);
      if (absolute) mag_one(scale);
      mag_mul_2exp_si(scale, scale, 4 - t.ctx.prec);
      require(&t, mag_cmp(arb_radref(z), scale) <= 0, "too wide");
    }
}

/* --- Aliasing. --- */

TEST_EACH(outputs_may_alias_inputs, LAW_CONTEXTS) {
  OWNED(trial) t = trial_of(law_context(_i), "aliasing");
  for (int i = 0; i < TRIALS / 4; i++)
    for (int op = 0; op < N_OPS; op++) {
      t.op = ops[op].name;
      trial_begin(&t, i, 60);
      int status = apply(&t.ctx, op, at(&t, U), at(&t, X), at(&t, Y));
      t.f->set(at(&t, V), at(&t, X));
      require(&t, apply(&t.ctx, op, at(&t, V), at(&t, V), at(&t, Y)) == status && same(&t, U, V), "z = x");
      if (!ops[op].binary) continue;
      t.f->set(at(&t, V), at(&t, Y));
      require(&t, apply(&t.ctx, op, at(&t, V), at(&t, X), at(&t, V)) == status && same(&t, U, V), "z = y");
      t.f->set(at(&t, W), at(&t, X));
      status = apply(&t.ctx, op, at(&t, U), at(&t, X), at(&t, W));
      require(&t, apply(&t.ctx, op, at(&t, V), at(&t, X), at(&t, X)) == status && same(&t, U, V), "x = y");
      require(&t, apply(&t.ctx, op, at(&t, X), at(&t, X), at(&t, X)) == status && same(&t, U, X), "z = x = y");
    }
  t.op = "sin_cos, pow_si";
  for (int i = 0; i < TRIALS / 4; i++) {
    slong prec = t.ctx.prec;
    trial_begin(&t, i, 60);
    int status = t.f->sin_cos(at(&t, U), at(&t, V), at(&t, X), prec);
    t.f->set(at(&t, Z), at(&t, X));
    require(&t, t.f->sin_cos(at(&t, Z), at(&t, W), at(&t, Z), prec) == status, "status, s = x");
    require(&t, same(&t, U, Z) && same(&t, V, W), "s = x");
    t.f->set(at(&t, Z), at(&t, X));
    require(&t, t.f->sin_cos(at(&t, W), at(&t, Z), at(&t, Z), prec) == status, "status, c = x");
    require(&t, same(&t, U, W) && same(&t, V, Z), "c = x");
    slong n = rng_between(&t.rng, -9, 9);
    status = t.f->pow_si(at(&t, U), at(&t, X), n, prec);
    require(&t, t.f->pow_si(at(&t, X), at(&t, X), n, prec) == status && same(&t, U, X), "power, z = x");
  }
}

TEST_EACH(init_set_swap, LAW_CONTEXTS) {
  OWNED(trial) t = trial_of(law_context(_i), "init, set, swap");
  for (int k = 0; k < N_SLOTS; k++) require(&t, t.f->is_zero(at(&t, k)) == TRUTH_TRUE, "init leaves 0");
  for (int i = 0; i < TRIALS; i++) {
    trial_begin(&t, i, 500);
    t.f->set(at(&t, U), at(&t, X));
    t.f->set(at(&t, V), at(&t, Y));
    require(&t, same(&t, U, X) && same(&t, V, Y), "set copies");
    t.f->swap(at(&t, U), at(&t, V));
    require(&t, same(&t, U, Y) && same(&t, V, X), "swap exchanges");
    t.f->swap(at(&t, U), at(&t, U));
    t.f->set(at(&t, V), at(&t, V));
    require(&t, same(&t, U, Y) && same(&t, V, X), "with itself");
  }
}

/* --- Conversions. --- */

static void get_fmpq(fmpq_t q, const struct trial *t, int i) {
  NUMBERS(arb, x);
  get(x, t, i);
  arf_get_fmpq(q, arb_midref(x));
}

/* Slot V becomes the neighbour of the value in slot U in the direction of sign. */
static void neighbour(const struct trial *t, int sign) {
  t->f->set(at(t, V), at(t, U));
  if (t->f == &num_double) {
    *(double *)at(t, V) = nextafter(*(double *)at(t, U), sign > 0 ? (double)INFINITY : -(double)INFINITY);
  } else if (sign > 0) {
    mpfr_nextabove(at(t, V));
  } else {
    mpfr_nextbelow(at(t, V));
  }
}

/* |z - q| <= |v - q| for both neighbours v of z; at a tie the last bit of z is even, that is, z is a multiple of twice
   the gap. */
static void check_nearest(const struct trial *t, const fmpq_t q) {
  if (t->f == &num_mpfr && t->f->is_zero(at(t, U)) == TRUTH_TRUE) { /* its neighbours lie beyond 2^(-2^30) */
    require(t, fmpq_is_zero(q), "only zero is near zero");
    return;
  }
  NUMBERS(fmpq, z, v, dz, dv);
  get_fmpq(z, t, U);
  fmpq_sub(dz, z, q);
  fmpq_abs(dz, dz);
  for (int sign = -1; sign <= 1; sign += 2) {
    neighbour(t, sign);
    if (is_nan(t, V)) continue; /* beyond the largest double */
    get_fmpq(v, t, V);
    fmpq_sub(dv, v, q);
    fmpq_abs(dv, dv);
    int order = fmpq_cmp(dz, dv);
    require(t, order <= 0, "a neighbour is nearer");
    if (order < 0) continue;
    fmpq_sub(v, v, z);
    fmpq_abs(v, v);
    fmpq_mul_2exp(v, v, 1);
    fmpq_div(v, z, v);
    require(t, fmpz_is_one(fmpq_denref(v)), "a tie goes to the even neighbour");
  }
}

/* Fractions of every size, points halfway between two neighbours and just off them, subnormal doubles among them. */
static void random_fraction(fmpq_t q, struct rng *r, slong prec) {
  NUMBERS(arf, x);
  slong kind = rng_between(r, 0, 3);
  if (kind == 0) {
    fmpq_set_si(q, rng_between(r, -1000, 1000), (ulong)rng_between(r, 1, 1000));
  } else {
    rng_mantissa(x, r, prec + (kind == 1 ? 1 : 0));
    slong tiny = kind == 3 ? rng_between(r, -1080, -1000) : rng_between(r, -40, 40);
    arf_mul_2exp_si(x, x, tiny);
    arf_get_fmpq(q, x);
    if (rng_next(r) % 2) { /* next to a tie, by much less than any precision in use */
      NUMBERS(fmpq, d);
      fmpq_set_si(d, rng_between(r, -1, 1), 3);
      fmpq_div_2exp(d, d, 1500);
      fmpq_add(q, q, d);
    }
    if (rng_next(r) % 2) fmpq_neg(q, q);
  }
}

/* 0 < |q| <= 2^-1075: half of the least double, which rounds to 0. */
static bool vanishes(const fmpq_t q) {
  NUMBERS(fmpq, size, least);
  fmpq_set_si(least, 2, 1);
  fmpq_pow_si(least, least, -1075);
  fmpq_abs(size, q);
  return !fmpq_is_zero(q) && fmpq_cmp(size, least) <= 0;
}

TEST_EACH(rationals_round_once, LAW_CONTEXTS) {
  NUMBERS(fmpq, q);
  NUMBERS(arb, z);
  OWNED(trial) t = trial_of(law_context(_i), "set_q");
  for (int i = 0; i < TRIALS; i++) {
    trial_begin(&t, i, 60);
    random_fraction(q, &t.rng, t.ctx.prec);
    int expected = t.f == &num_double && vanishes(q) ? SS_UNABLE : SS_OK;
    require(&t, t.f->set_q(at(&t, U), q, t.ctx.prec) == expected, "status");
    if (expected != SS_OK) continue;
    get(z, &t, U);
    if (!t.f->rigorous) {
      check_nearest(&t, q);
      continue;
    }
    require(&t, arb_contains_fmpq(z, q), "not enclosed");
    require(&t, fmpq_is_zero(q) || arb_rel_accuracy_bits(z) >= t.ctx.prec - 3, "too wide");
  }
}

TEST_EACH(conversions_keep_values, LAW_CONTEXTS) {
  NUMBERS(arb, x);
  OWNED(trial) t = trial_of(law_context(_i), "conversions");
  for (int i = 0; i < TRIALS; i++) {
    trial_begin(&t, i, 900);
    get(x, &t, X);
    require(&t, t.f->set_arb(at(&t, U), x, t.ctx.prec) == SS_OK && same(&t, U, X), "get_arb, set_arb");
    double d = t.f->get_d(at(&t, X));
    MPFR_NUMBERS(53, m);
    arf_get_mpfr(m, arb_midref(x), MPFR_RNDN);
    require(&t, mpfr_cmp_d(m, d) == 0, "get_d is not the nearest double");
    if (t.ctx.prec < 53) continue;
    require(&t, t.f->set_d(at(&t, U), d, t.ctx.prec) == SS_OK && t.f->get_d(at(&t, U)) == d, "set_d, get_d");
  }
  for (int i = 0; i < TRIALS && !t.f->rigorous; i++) { /* midpoints with too many bits are rounded, and once */
    NUMBERS(fmpq, q);
    trial_begin(&t, i, 60);
    rng_edge(arb_midref(x), &t.rng, t.ctx.prec + 1 + (i % 40), 900);
    if (i % 2) arf_mul_2exp_si(arb_midref(x), arb_midref(x), -1000); /* subnormal doubles, and zero */
    mag_set_d(arb_radref(x), 0.125);
    require(&t, t.f->set_arb(at(&t, U), x, t.ctx.prec) == SS_OK, "set_arb");
    arf_get_fmpq(q, arb_midref(x));
    check_nearest(&t, q);
  }
}

TEST_EACH(what_cannot_be_held_is_refused, LAW_CONTEXTS) {
  const double bad[] = {INFINITY, -INFINITY, NAN};
  NUMBERS(arb, x);
  OWNED(trial) t = trial_of(law_context(_i), "refusals");
  for (int i = 0; i < 3; i++) {
    require(&t, t.f->set_d(at(&t, U), bad[i], t.ctx.prec) == SS_UNABLE && is_nan(&t, U), "set_d");
    put_d(&t, U, 1);
    arb_set_d(x, bad[i]);
    require(&t, t.f->set_arb(at(&t, U), x, t.ctx.prec) == SS_UNABLE && is_nan(&t, U), "set_arb");
    put_d(&t, U, 1);
  }
  arb_zero_pm_inf(x);
  require(&t, t.f->set_arb(at(&t, U), x, t.ctx.prec) == SS_UNABLE && is_nan(&t, U), "an unbounded ball");
  require(&t, isnan(t.f->get_d(at(&t, U))), "get_d of NaN");
  if (t.f == &num_double) {
    NUMBERS(fmpq, q);
    fmpq_set_si(q, 1, 1);
    fmpq_mul_2exp(q, q, 1024);
    require(&t, t.f->set_q(at(&t, U), q, 53) == SS_UNABLE && is_nan(&t, U), "2^1024 as a double");
  }
}

/* --- Arithmetic. --- */

TABLE(laws, "tests/cases/number_laws.tsv", 6);
enum { LEFT, RIGHT, SCALE, UNITS, WHERE, REACH }; /* its columns */

/* The sides of an identity, what it is measured by, and where it holds, as one tape. */
static void law_tape(struct tape *tape, struct elaboration *el, char *const *row) {
  struct matrix m;
  const char *scale = *row[SCALE] ? row[SCALE] : row[LEFT];
  const char *where = *row[WHERE] && *row[WHERE] != '*' ? row[WHERE] : "1";
  goes_well(elaborate_tape(tape, &m, el, row[LEFT], formatted("[%s, %s, %s, %s]", row[LEFT], row[RIGHT], scale, where),
                           "", &d));
}

static void check_law(struct trial *t, char *const *row, const struct tape *tape) {
  OWNED(num_vec) in = vec_new(tape->n_inputs, t->ctx), out = vec_new(4, t->ctx), zero = vec_new(1, t->ctx);
  int status[4], asked = 0;
  t->op = row[LEFT];
  for (int i = 0; i < TRIALS; i++) {
    trial_begin(t, i, atoi(row[REACH]));
    for (slong k = 0; k < tape->n_inputs; k++)
      t->f->set(num_vec_at(&in, k), at(t, X + (int)strcspn("xyz", tape->inputs[k])));
    tape_eval(&out, status, tape, &in);
    for (int k = 0; k < 3; k++) t->f->set(at(t, U + k), num_vec_at(&out, k));
    bool has_value = (status[0] | status[1] | status[2]) == SS_OK;
    if (t->f->lt(num_vec_at(&zero, 0), num_vec_at(&out, 3)) != TRUTH_TRUE) continue;
    if (*row[WHERE] == '*' && !has_value) continue;
    asked++;
    require(t, has_value, "status");
    bool holds =
        strcmp(row[UNITS], "same") == 0 ? same(t, U, V) : near(t, U, V, *row[SCALE] ? W : -1, atol(row[UNITS]));
    require(t, holds, row[RIGHT]);
  }
  ck_assert_int_gt(asked, TRIALS / 4);
}

CASE("identities", .once = {scratch_open, scratch_close}, .seconds = 60);

TEST_EACH(identities, LAW_CONTEXTS) {
  OWNED(trial) t = trial_of(law_context(_i), "identities");
  OWNED(model) m;
  OWNED(elaboration) el;
  model_init(&m);
  goes_well(model_add_file(&m, scratch_put("xyz.eq", "symbol x\nsymbol y\nsymbol z\n"), RANK_PAPER, &d));
  elaboration_init(&el, (struct view){&m, LAYER_PRINTED, NULL, NULL}, NULL, 0);
  for (int k = 0; k < laws.n; k++) {
    OWNED(tape) tape;
    law_tape(&tape, &el, laws.row[k]);
    check_law(&t, laws.row[k], &tape);
  }
}

CASE("laws");

TEST_EACH(sine_and_cosine_at_once, LAW_CONTEXTS) {
  OWNED(trial) t = trial_of(law_context(_i), "sin_cos");
  const struct num_type *f = t.f;
  slong prec = t.ctx.prec;
  for (int i = 0; i < TRIALS; i++) {
    trial_begin(&t, i, 300);
    int s = f->sin(at(&t, Y), at(&t, X), prec) | f->cos(at(&t, Z), at(&t, X), prec);
    s |= f->sin_cos(at(&t, U), at(&t, V), at(&t, X), prec);
    require(&t, s == SS_OK && near(&t, U, Y, -1, 0) && near(&t, V, Z, -1, 0), "sin_cos = sin, cos");
  }
  f->pi(at(&t, X), prec);
  f->sin_cos(at(&t, U), at(&t, V), at(&t, X), prec);
  put_d(&t, W, 4);
  put_d(&t, Z, 0);
  require(&t, near(&t, U, Z, W, 1), "sin pi = 0");
  require(&t, equals_si(&t, V, -1), "cos pi = -1");
}

TEST_EACH(power_laws, LAW_CONTEXTS) {
  OWNED(trial) t = trial_of(law_context(_i), "pow_si");
  const struct num_type *f = t.f;
  slong prec = t.ctx.prec;
  void *x = at(&t, X), *y = at(&t, Y), *u = at(&t, U), *v = at(&t, V), *w = at(&t, W);
  for (int i = 0; i < TRIALS; i++) {
    trial_begin(&t, i, 20);
    slong m = rng_between(&t.rng, 0, 12), n = rng_between(&t.rng, 0, 12);
    require(&t, f->pow_si(u, x, m, prec) == SS_OK && f->pow_si(v, x, n, prec) == SS_OK, "status of powers");
    f->mul(u, u, v, prec);
    require(&t, f->pow_si(w, x, m + n, prec) == SS_OK && near(&t, U, W, -1, 10), "x^m x^n = x^(m+n)");
    int status = f->pow_si(u, x, -m - 1, prec);
    truth zero = f->is_zero(x);
    require(&t, status == (zero == TRUTH_TRUE ? SS_DOMAIN : zero == TRUTH_FALSE ? SS_OK : SS_UNABLE), "1/x^m exists");
    if (status != SS_OK) continue;
    f->pow_si(v, x, m + 1, prec);
    put_d(&t, Y, 1);
    status = f->div(v, y, v, prec); /* a wide ball away from 0 can have powers around 0 */
    require(&t, (status != SS_OK && f->rigorous) || near(&t, U, V, -1, 10), "x^-m = 1/x^m");
  }
}

/* --- Failures. --- */

TEST_EACH(nan_goes_through, LAW_CONTEXTS) {
  OWNED(trial) t = trial_of(law_context(_i), "NaN");
  const struct num_type *f = t.f;
  slong prec = t.ctx.prec;
  f->set_d(at(&t, X), (double)NAN, prec);
  for (int k = 0; k < 3; k++) {
    put_d(&t, Y, k - 1);
    for (int op = 0; op < N_OPS; op++) {
      t.op = ops[op].name;
      put_d(&t, U, 1);
      require(&t, apply(&t.ctx, op, at(&t, U), at(&t, X), at(&t, Y)) == SS_UNABLE && is_nan(&t, U), "op(NaN, y)");
      put_d(&t, U, 1);
      if (!ops[op].binary) continue;
      int status = apply(&t.ctx, op, at(&t, U), at(&t, Y), at(&t, X));
      require(&t, status == SS_UNABLE && is_nan(&t, U), "op(y, NaN)");
    }
    t.op = "";
    require(&t, f->pow_si(at(&t, U), at(&t, X), k - 1, prec) == SS_UNABLE && is_nan(&t, U), "NaN^n");
    require(&t, f->lt(at(&t, X), at(&t, Y)) == TRUTH_UNKNOWN, "NaN < y");
    require(&t, f->lt(at(&t, Y), at(&t, X)) == TRUTH_UNKNOWN, "y < NaN");
  }
  require(&t, f->sin_cos(at(&t, U), at(&t, V), at(&t, X), prec) == SS_UNABLE, "sin_cos");
  require(&t, is_nan(&t, U) && is_nan(&t, V), "sin_cos leaves NaN");
  require(&t, f->is_zero(at(&t, X)) == TRUTH_UNKNOWN, "NaN = 0");
  require(&t, isnan(f->get_d(at(&t, X))), "get_d");
  f->set(at(&t, V), at(&t, X));
  require(&t, is_nan(&t, V), "set");
}

TABLE(answers, "tests/cases/operations_at.tsv", 9);
enum { OPERATION, X_LOW, X_HIGH, Y_LOW, Y_HIGH, STATUS, VALUE, UNITS_OFF, OF_TYPE }; /* its columns */

/* That operation, or the power whose exponent stands in the place of y. */
static int answer(const struct trial *t, char *const *row) {
  if (strcmp(row[OPERATION], "pow_si") == 0)
    return t->f->pow_si(at(t, U), at(t, X), strtol(row[Y_LOW], NULL, 10), t->ctx.prec);
  int op = 0;
  while (strcmp(ops[op].name, row[OPERATION]) != 0) ck_assert_int_lt(++op, N_OPS);
  return apply(&t->ctx, op, at(t, U), at(t, X), at(t, Y));
}

TEST_EACH(operations_at_their_limits, LAW_CONTEXTS) {
  static const char *const statuses[] = {[SS_OK] = "ok", [SS_DOMAIN] = "domain", [SS_UNABLE] = "unable"};
  NUMBERS(arb, value);
  OWNED(trial) t = trial_of(law_context(_i), "limits");
  for (int i = 0; i < answers.n; i++) {
    char *const *row = answers.row[i];
    double x[2] = {atof(row[X_LOW]), atof(row[X_HIGH])}, y[2] = {atof(row[Y_LOW]), atof(row[Y_HIGH])};
    if ((x[0] < x[1] || y[0] < y[1]) && !t.f->rigorous) continue;
    if (*row[OF_TYPE] && strcmp(row[OF_TYPE], t.f->name) != 0) continue;
    t.op = row[OPERATION];
    put_interval(&t, X, x[0], x[1]);
    put_interval(&t, Y, y[0], y[1]);
    int status = answer(&t, row);
    require(&t, strcmp(statuses[status], row[STATUS]) == 0, "status");
    require(&t, (status != SS_OK) == is_nan(&t, U), "NaN after a failure, and only then");
    if (!*row[VALUE]) continue;
    ck_assert_int_eq(arb_set_str(value, row[VALUE], REFERENCE), 0);
    t.f->set_arb(at(&t, V), value, t.ctx.prec);
    require(&t, near(&t, U, V, -1, atol(row[UNITS_OFF])), row[VALUE]);
  }
  if (t.f->rigorous) {
    put_interval(&t, X, -1, 2);
    require(&t, t.f->abs(at(&t, U), at(&t, X), t.ctx.prec) == SS_OK, "|[-1, 2]|");
    put_d(&t, V, -0.0625);
    require(&t, t.f->lt(at(&t, V), at(&t, U)) == TRUTH_TRUE, "the absolute value of a ball is cut at 0");
  }
}

/* --- Comparisons. --- */

TEST_EACH(three_valued_truth, LAW_CONTEXTS) {
  OWNED(trial) t = trial_of(law_context(_i), "truth");
  const struct num_type *f = t.f;
  NUMBERS(arb, x, y);
  for (int i = 0; i < TRIALS; i++) {
    trial_begin(&t, i, 500);
    if (i % 4 == 0) f->set(at(&t, Y), at(&t, X));
    get(x, &t, X);
    get(y, &t, Y);
    NUMBERS(arf, x0, x1, y0, y1); /* the ends decide: all of x below all of y, or none of x below any of y */
    arb_get_interval_arf(x0, x1, x, ARF_PREC_EXACT);
    arb_get_interval_arf(y0, y1, y, ARF_PREC_EXACT);
    truth lt = arf_cmp(x1, y0) < 0 ? TRUTH_TRUE : arf_cmp(x0, y1) >= 0 ? TRUTH_FALSE : TRUTH_UNKNOWN;
    bool holds_zero = arf_sgn(x0) <= 0 && arf_sgn(x1) >= 0;
    truth zero = !holds_zero ? TRUTH_FALSE : arf_equal(x0, x1) ? TRUTH_TRUE : TRUTH_UNKNOWN;
    require(&t, f->lt(at(&t, X), at(&t, Y)) == lt, "x < y");
    require(&t, f->is_zero(at(&t, X)) == zero, "x = 0");
  }
}
