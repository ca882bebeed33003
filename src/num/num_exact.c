/* Rational functions over Q as a number type: Calcium's fmpz_mpoly_q in one ring of NUM_EXACT_GENERATORS generators,
   which have no meaning here.  An operation that could make more than NUM_EXACT_PRODUCT terms is not begun. */
#include <flint/mpoly.h>
#include <math.h>

#include "base/work.h"
#include "num/num_exact.h"

const fmpz_mpoly_ctx_struct *num_exact_ctx(void) {
  static fmpz_mpoly_ctx_t ctx;
  static bool made;
  if (!made) fmpz_mpoly_ctx_init(ctx, NUM_EXACT_GENERATORS, ORD_LEX);
  made = true;
  return ctx;
}

slong num_exact_terms(const fmpz_mpoly_q_struct *x) {
  slong n = fmpz_mpoly_length(&x->num, num_exact_ctx()), d = fmpz_mpoly_length(&x->den, num_exact_ctx());
  return n > d ? n : d;
}

slong num_exact_work(const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *y, bool sum) {
  slong xn = fmpz_mpoly_length(&x->num, num_exact_ctx()), xd = fmpz_mpoly_length(&x->den, num_exact_ctx());
  slong yn = fmpz_mpoly_length(&y->num, num_exact_ctx()), yd = fmpz_mpoly_length(&y->den, num_exact_ctx());
  slong product = num_exact_terms(x) * num_exact_terms(y), crossed = xn * yd + yn * xd;
  return sum && crossed < product ? crossed : product;
}

void num_exact_polynomial_at(fmpq_t z, const fmpz_mpoly_struct *p, const fmpq *value) {
  slong e[NUM_EXACT_GENERATORS];
  NUMBERS(fmpq, term, power);
  NUMBERS(fmpz, c);
  fmpq_zero(z);
  for (slong i = 0; i < fmpz_mpoly_length(p, num_exact_ctx()); i++) {
    fmpz_mpoly_get_term_coeff_fmpz(c, p, i, num_exact_ctx());
    fmpz_mpoly_get_term_exp_si(e, p, i, num_exact_ctx());
    fmpq_set_fmpz(term, c);
    for (slong k = 0; k < NUM_EXACT_GENERATORS; k++) {
      if (e[k] == 0) continue;
      fmpq_pow_si(power, &value[k], e[k]);
      fmpq_mul(term, term, power);
    }
    fmpq_add(z, z, term);
  }
}

int num_exact_at(fmpq_t z, const fmpz_mpoly_q_struct *x, const fmpq *value) {
  NUMBERS(fmpq, den);
  num_exact_polynomial_at(den, &x->den, value);
  num_exact_polynomial_at(z, &x->num, value);
  bool there = !fmpq_is_zero(den);
  if (there) fmpq_div(z, z, den);
  return there ? SS_OK : SS_DOMAIN;
}

static void e_init(void *x, slong prec) {
  (void)prec;
  fmpz_mpoly_q_init(x, num_exact_ctx());
}

static void e_clear(void *x) {
  fmpz_mpoly_q_clear(x, num_exact_ctx());
}

static void e_set(void *z, const void *x) {
  fmpz_mpoly_q_set(z, x, num_exact_ctx());
}

static void e_swap(void *x, void *y) {
  fmpz_mpoly_q_swap(x, y, num_exact_ctx());
}

static int e_set_q(void *z, const fmpq_t q, slong prec) {
  (void)prec;
  fmpz_mpoly_q_set_fmpq(z, q, num_exact_ctx());
  return SS_OK;
}

static int e_set_d(void *z, double x, slong prec) {
  (void)prec;
  if (!isfinite(x)) return SS_UNABLE;
  NUMBERS(fmpq, q);
  num_q_set_d(q, x);
  fmpz_mpoly_q_set_fmpq(z, q, num_exact_ctx());
  return SS_OK;
}

static int e_set_arb(void *z, const arb_t x, slong prec) {
  (void)z, (void)x, (void)prec;
  return SS_UNABLE;
}

static void e_get_arb(arb_t z, const void *x) {
  (void)x;
  arb_indeterminate(z);
}

/* Elimination asks for the size of a pivot: any that is not zero will do. */
static double e_get_d(const void *x) {
  return fmpz_mpoly_q_is_zero(x, num_exact_ctx()) ? 0 : 1;
}

static int e_neg(void *z, const void *x, slong prec) {
  (void)prec;
  fmpz_mpoly_q_neg(z, x, num_exact_ctx());
  return SS_OK;
}

/* Claims evaluate the same definitions, so that nearly every operation that takes long has been done before: results of
   operations are kept, each in the place of the last one with its hash.  flint_cleanup frees them. */
enum { KEPT = 4096, KEPT_LEAST = 4, KEPT_MOST = 4096 }; /* results; the terms of an operation that is kept */
typedef void (*ring_operation)(fmpz_mpoly_q_t, const fmpz_mpoly_q_t, const fmpz_mpoly_q_t, const fmpz_mpoly_ctx_t);
static _Thread_local struct kept {
  ring_operation op;
  fmpz_mpoly_q_struct x, y, z;
} * kept;

static void free_kept(void) {
  for (int i = 0; i < KEPT; i++) {
    if (!kept[i].op) continue;
    e_clear(&kept[i].x);
    e_clear(&kept[i].y);
    e_clear(&kept[i].z);
  }
  flint_free(kept);
  kept = NULL;
}

static ulong hash_on(ulong hash, const fmpz_mpoly_struct *p) {
  slong words = p->length * mpoly_words_per_exp(p->bits, num_exact_ctx()->minfo);
  for (slong i = 0; i < words; i++) hash = (hash ^ p->exps[i]) * 0x9e3779b97f4a7c15U;
  for (slong i = 0; i < p->length; i++) hash = (hash ^ fmpz_get_ui(p->coeffs + i)) * 0x9e3779b97f4a7c15U;
  return hash ^ hash >> 32;
}

static struct kept *kept_place(const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *y) {
  if (!kept) {
    kept = flint_calloc(KEPT, sizeof *kept);
    flint_register_cleanup_function(free_kept);
  }
  return &kept[hash_on(hash_on(hash_on(hash_on(0, &x->num), &x->den), &y->num), &y->den) % KEPT];
}

static int operate(ring_operation op, void *z, const void *x, const void *y, bool sum) {
  slong terms = num_exact_work(x, y, sum);
  if (terms > NUM_EXACT_PRODUCT) return SS_UNABLE;
  work_add(1 + (unsigned long long)terms);
  if (terms < KEPT_LEAST || terms > KEPT_MOST) {
    op(z, x, y, num_exact_ctx());
    return SS_OK;
  }
  struct kept *k = kept_place(x, y);
  if (!k->op) {
    e_init(&k->x, 0);
    e_init(&k->y, 0);
    e_init(&k->z, 0);
  }
  if (k->op != op || !fmpz_mpoly_q_equal(&k->x, x, num_exact_ctx()) || !fmpz_mpoly_q_equal(&k->y, y, num_exact_ctx())) {
    k->op = op;
    e_set(&k->x, x);
    e_set(&k->y, y);
    op(&k->z, x, y, num_exact_ctx());
  }
  e_set(z, &k->z);
  return SS_OK;
}

#define EXACT_BINARY(name, sum)                                                                                        \
  static int e_##name(void *z, const void *x, const void *y, slong prec) {                                             \
    (void)prec;                                                                                                        \
    return operate(fmpz_mpoly_q_##name, z, x, y, sum);                                                                 \
  }
EXACT_BINARY(add, true)
EXACT_BINARY(sub, true)
EXACT_BINARY(mul, false)
#undef EXACT_BINARY

static int e_div(void *z, const void *x, const void *y, slong prec) {
  (void)prec;
  if (fmpz_mpoly_q_is_zero(y, num_exact_ctx())) return SS_DOMAIN;
  return operate(fmpz_mpoly_q_div, z, x, y, false);
}

/* What is not rational is a generator of a field (exact.h), not a function here. */
static int e_unary(void *z, const void *x, slong prec) {
  (void)z, (void)x, (void)prec;
  return SS_UNABLE;
}

static int e_binary(void *z, const void *x, const void *y, slong prec) {
  (void)z, (void)x, (void)y, (void)prec;
  return SS_UNABLE;
}

static int e_sin_cos(void *s, void *c, const void *x, slong prec) {
  (void)s, (void)c, (void)x, (void)prec;
  return SS_UNABLE;
}

static int e_pow_si(void *z, const void *x, slong n, slong prec) {
  enum { MAX_POWER = 16 };
  fmpz_mpoly_q_struct r, base;
  if (n < -MAX_POWER || n > MAX_POWER) return SS_UNABLE;
  e_init(&r, prec);
  e_init(&base, prec);
  e_set(&base, x);
  int s = e_set_d(&r, 1, prec);
  for (slong i = 0; s == SS_OK && i < (n < 0 ? -n : n); i++)
    s = n < 0 ? e_div(&r, &r, &base, prec) : e_mul(&r, &r, &base, prec);
  if (s == SS_OK) e_swap(z, &r);
  e_clear(&base);
  e_clear(&r);
  return s;
}

static int e_pi(void *z, slong prec) {
  (void)z, (void)prec;
  return SS_UNABLE;
}

static truth e_is_zero(const void *x) {
  return e_get_d(x) == 0 ? TRUTH_TRUE : TRUTH_FALSE;
}

static truth e_lt(const void *x, const void *y) {
  (void)x, (void)y;
  return TRUTH_UNKNOWN;
}

const struct num_type num_exact = {
    .name = "exact",
    .size = sizeof(fmpz_mpoly_q_struct),
    .rigorous = true,
    .neg = e_neg,
    .abs = e_unary,
    .sqrt = e_unary,
    .exp = e_unary,
    .sin = e_unary,
    .cos = e_unary,
    .cot = e_unary,
    .sinc = e_unary,
    .stumpff = e_unary,
    .add = e_add,
    .sub = e_sub,
    .mul = e_mul,
    .div = e_div,
    .atan2 = e_binary,
    .hypot = e_binary,
    .pow_si = e_pow_si,
#define NUM_METHOD(name) e_##name
#include "methods.def"
};

struct num_ctx num_ctx_exact(void) {
  return (struct num_ctx){&num_exact, 0};
}
