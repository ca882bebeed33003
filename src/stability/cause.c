/* The rule that says why digits are lost.

   A node v of the tape that is rounded once moves the result f by |v df/dv / f| units: the adjoint df/dv comes from one
   pass from the result down, in balls.  The sum over the nodes (as if roundings were independent) is the predicted
   error; it knows the true values alone, and nothing of what double precision did.  The cause is read off the way from
   the node whose rounding matters most up to the result: where the relative error grows most on it, there the digits
   go. */
#include <math.h>
#include <stdlib.h>

#include "stability_impl.h"

enum { LEAST_NORMAL = -1022, LEAST_NUMBER = -1075, MOST_NUMBER = 1024 };

static arb_ptr value(const struct digits_bench *w, slong i) {
  return num_vec_at(&w->b, i);
}

/* --- Partial derivatives of a node by its operands --- */

/* Of sinc x, (cos x - sinc x)/x, and of stumpff x, (sinc^2(x/2)/2 - 3 stumpff x)/x; 0 at 0, where both are even. */
static void partial_over_angle(arb_t z, const struct digits_bench *w, slong i) {
  const struct tape_instr *in = &w->f->tape.code[i];
  arb_srcptr x = value(w, in->a);
  if (arb_is_zero(x)) {
    arb_zero(z);
    return;
  }
  slong prec = w->prec;
  if (in->op == TAPE_sinc) {
    arb_cos(z, x, prec);
    arb_sub(z, z, value(w, i), prec);
  } else {
    arb_mul_2exp_si(z, x, -1);
    arb_sinc(z, z, prec);
    arb_sqr(z, z, prec);
    arb_mul_2exp_si(z, z, -1);
    arb_submul_ui(z, value(w, i), 3, prec);
  }
  arb_div(z, z, x, prec);
}

/* -w^k / P'(w) */
static void partial_of_root(arb_t z, const struct digits_bench *w, slong i, slong k) {
  const struct tape *t = &w->f->tape;
  const struct tape_instr *in = &t->code[i];
  slong prec = w->prec;
  NUMBERS(arb, below, term);
  for (slong j = 1; j < in->b; j++) {
    arb_pow_ui(term, value(w, i), (ulong)(j - 1), prec);
    arb_mul(term, term, value(w, t->links[in->a + j]), prec);
    arb_addmul_si(below, term, j, prec);
  }
  arb_pow_ui(z, value(w, i), (ulong)k, prec);
  arb_div(z, z, below, prec);
  arb_neg(z, z);
}

static void partial(arb_t z, const struct digits_bench *w, slong i, slong k) {
  const struct tape *t = &w->f->tape;
  const struct tape_instr *in = &t->code[i];
  slong prec = w->prec;
  switch (in->op) {
  case TAPE_add:
  case TAPE_ROUNDED:
    arb_one(z);
    break;
  case TAPE_sub:
    arb_set_si(z, k ? -1 : 1);
    break;
  case TAPE_neg:
    arb_set_si(z, -1);
    break;
  case TAPE_mul:
    arb_set(z, value(w, tape_operand(t, i, 1 - k)));
    break;
  case TAPE_div:
    arb_inv(z, value(w, in->b), prec);
    if (k) arb_mul(z, z, value(w, i), prec);
    if (k) arb_neg(z, z);
    break;
  case TAPE_sin:
    arb_cos(z, value(w, in->a), prec);
    break;
  case TAPE_cos:
    arb_sin(z, value(w, in->a), prec);
    arb_neg(z, z);
    break;
  case TAPE_cot:
    arb_sqr(z, value(w, i), prec);
    arb_add_ui(z, z, 1, prec);
    arb_neg(z, z);
    break;
  case TAPE_abs:
    arb_set_si(z, arb_is_negative(value(w, in->a)) ? -1 : 1);
    break;
  case TAPE_exp:
    arb_set(z, value(w, i));
    break;
  case TAPE_sqrt:
    arb_mul_2exp_si(z, value(w, i), 1);
    arb_inv(z, z, prec);
    break;
  case TAPE_POW:
    arb_set_si(z, in->k - 1);
    arb_pow(z, value(w, in->a), z, prec);
    arb_mul_si(z, z, in->k, prec);
    break;
  case TAPE_sinc:
  case TAPE_stumpff:
    partial_over_angle(z, w, i);
    break;
  case TAPE_hypot:
    arb_div(z, value(w, tape_operand(t, i, k)), value(w, i), prec);
    break;
  case TAPE_ROOT:
    partial_of_root(z, w, i, k);
    break;
  default:
    arb_indeterminate(z);
  }
}

/* --- The adjoint --- */

/* log2 of what rounding the true value of a node once changes in it, relative to it and in units of 2^-53: -inf where
   it is a double. */
static double rounding(arb_srcptr v) {
  double nearest = arf_get_d(arb_midref(v), ARF_RND_NEAR);
  if (!isfinite(nearest)) return 0;
  NUMBERS(arb, off);
  arb_set_d(off, nearest);
  arb_sub(off, v, off, 64);
  double r = arb_is_zero(off) ? -INFINITY : digits_log2(off) - digits_log2(v) + 53;
  return fmin(53, r);
}

/* Does the operation round?  Inputs are given, and a sign costs nothing. */
static bool rounds(enum tape_op op) {
  return op != TAPE_INPUT && op != TAPE_neg && op != TAPE_abs;
}

static bool is_tiny(arb_srcptr v) {
  return !arb_contains_zero(v) && digits_log2(v) < LEAST_NORMAL;
}

/* log2 |v df/dv| */
static double reach(const struct digits_bench *w, slong i) {
  arb_srcptr a = num_vec_at(&w->adjoint, i);
  return arb_is_zero(a) ? -INFINITY : digits_log2(a) + digits_log2(value(w, i));
}

/* What reaches the result; through: of what lies behind a TAPE_ROUNDED too, whose own roundings do not. */
static void fill_adjoint(struct digits_bench *w, slong which, bool through) {
  const struct tape *t = &w->f->tape;
  slong top = w->f->out[which];
  NUMBERS(arb, p);
  for (slong i = 0; i < t->n; i++) arb_zero(num_vec_at(&w->adjoint, i));
  arb_one(num_vec_at(&w->adjoint, top));
  for (slong i = top; i >= 0; i--) {
    arb_srcptr a = num_vec_at(&w->adjoint, i);
    if (arb_is_zero(a) || (!through && t->code[i].op == TAPE_ROUNDED)) continue;
    for (slong k = 0; k < tape_operands(t, i); k++) {
      arb_ptr z = num_vec_at(&w->adjoint, tape_operand(t, i, k));
      partial(p, w, i, k);
      arb_addmul(z, a, p, w->prec);
    }
  }
}

/* log2 of a sum of numbers given by their log2, scaled. */
static double log2_add(double a, double b) {
  double most = fmax(a, b), least = fmin(a, b);
  return isinf(most) || isinf(least) ? most : most + log2(1 + exp2(least - most));
}

/* log2 of what the radius of a node's own ball moves in the result, in units of 2^-53. */
static double haze(const struct digits_bench *w, slong i) {
  arb_srcptr v = value(w, i), a = num_vec_at(&w->adjoint, i);
  if (mag_is_zero(arb_radref(v)) || arb_is_zero(a)) return -INFINITY;
  return digits_log2(a) + digits_log2_mag(arb_radref(v)) + 53;
}

/* log2 of what is not known of |v df/dv|. */
static double blur(const struct digits_bench *w, slong i) {
  arb_srcptr a = num_vec_at(&w->adjoint, i);
  return mag_is_zero(arb_radref(a)) ? -INFINITY : digits_log2_mag(arb_radref(a)) + digits_log2(value(w, i));
}

struct digits_effect digits_adjoint(struct digits_bench *w, slong which, double size) {
  const struct tape *t = &w->f->tape;
  slong top = w->f->out[which];
  double squares = -INFINITY, sum = -INFINITY, unknown = -INFINITY, hazy = -INFINITY;
  bool fails = false;
  fill_adjoint(w, which, true);
  for (slong i = 0; i <= top; i++) {
    if (t->code[i].op != TAPE_INPUT || arb_is_zero(num_vec_at(&w->adjoint, i))) continue;
    sum = log2_add(sum, reach(w, i) - size);
    unknown = fmax(unknown, blur(w, i) - size);
  }
  if (t->only_under_rounded) fill_adjoint(w, which, false);
  for (slong i = 0; i <= top; i++) {
    if (t->code[i].op == TAPE_INPUT || arb_is_zero(num_vec_at(&w->adjoint, i))) continue;
    double off = rounds(t->code[i].op) ? reach(w, i) - size + rounding(value(w, i)) : -INFINITY;
    squares = log2_add(squares, 2 * off);
    hazy = fmax(hazy, haze(w, i) - size);
    fails = fails || (off > 4 && is_tiny(value(w, i)));
  }
  bool known = unknown < fmax(0, sum) - 10 && hazy < fmax(0, squares / 2) - 3;
  return (struct digits_effect){fails ? NAN : squares / 2, sum, known};
}

double digits_amplification(struct digits_bench *w, slong which) {
  const struct tape *t = &w->f->tape;
  double sum = -INFINITY;
  fill_adjoint(w, which, true);
  for (slong i = 0; i <= w->f->out[which]; i++) {
    arb_srcptr a = num_vec_at(&w->adjoint, i), v = value(w, i);
    if (arb_is_zero(a)) continue;
    double off = t->code[i].op == TAPE_INPUT ? digits_log2_mag(arb_radref(v)) + (double)w->prec
                 : rounds(t->code[i].op)     ? digits_log2(v)
                                             : -INFINITY;
    sum = log2_add(sum, digits_log2(a) + off);
  }
  return sum - digits_log2(value(w, w->f->out[which]));
}

/* Rounded to a double, the true values of its operands or of itself are zero, and so is whatever is a multiple of
   it. */
static bool becomes_zero(const struct digits_bench *w, const bool *zero, slong i) {
  const struct tape_instr *in = &w->f->tape.code[i];
  if (digits_log2(value(w, i)) < LEAST_NUMBER) return true;
  switch (in->op) {
  case TAPE_add:
  case TAPE_sub: {
    double a = zero[in->a] ? 0 : arf_get_d(arb_midref(value(w, in->a)), ARF_RND_NEAR);
    double b = zero[in->b] ? 0 : arf_get_d(arb_midref(value(w, in->b)), ARF_RND_NEAR);
    return a == (in->op == TAPE_add ? -b : b);
  }
  case TAPE_mul:
    return zero[in->a] || zero[in->b];
  case TAPE_POW:
    return in->k > 0 && zero[in->a];
  case TAPE_neg:
  case TAPE_abs:
  case TAPE_sqrt:
  case TAPE_sin:
  case TAPE_div:
    return zero[in->a];
  default:
    return false;
  }
}

bool digits_predicts_failure(const struct digits_bench *w) {
  const struct tape *t = &w->f->tape;
  FREED bool *zero = ss_malloc((size_t)t->n * sizeof *zero);
  bool fails = false;
  for (slong i = 0; !fails && i < t->n; i++) {
    zero[i] = becomes_zero(w, zero, i);
    if (tape_only_under_rounded(&w->f->tape, i)) continue;
    fails = digits_log2(value(w, i)) > MOST_NUMBER || (t->code[i].op == TAPE_div && zero[t->code[i].b]);
  }
  return fails;
}

/* --- The cause --- */

/* log2 of the relative error of node i over that of its operand k. */
static double growth(const struct digits_bench *w, slong i, slong k) {
  NUMBERS(arb, p);
  partial(p, w, i, k);
  return digits_log2(p) + digits_log2(value(w, tape_operand(&w->f->tape, i, k))) - digits_log2(value(w, i));
}

/* Zero in truth and in double: nothing is lost there, though the ways that lead through it may each say so. */
static bool is_zero_all_the_same(const struct digits_bench *w, slong i) {
  return arb_contains_zero(value(w, i)) && !w->d_flags[i] && *(const double *)num_vec_at(&w->d, i) == 0;
}

/* The consumer of node n through which most of its rounding reaches the result; -1 for the result itself. */
static slong next_on_the_way(slong *by, const struct digits_bench *w, slong n, slong top) {
  const struct tape *t = &w->f->tape;
  slong best = -1;
  double most = -INFINITY;
  for (slong i = n + 1; i <= top; i++)
    for (slong k = 0; k < tape_operands(t, i); k++) {
      if (tape_operand(t, i, k) != n) continue;
      double r = reach(w, i);
      if (!isfinite(r) || is_zero_all_the_same(w, i)) continue;
      r += growth(w, i, k);
      if (best >= 0 && r <= most) continue;
      most = r;
      best = i;
      *by = k;
    }
  return best;
}

/* The node whose rounding matters most. */
static slong source_node(const struct digits_bench *w, slong top) {
  slong best = top;
  double most = -INFINITY;
  for (slong i = 0; i <= top; i++) {
    if (!rounds(w->f->tape.code[i].op)) continue;
    double r = reach(w, i) + rounding(value(w, i));
    if (!(r > most)) continue;
    most = r;
    best = i;
  }
  return best;
}

/* The entry that is furthest off. */
static slong worst_entry(const struct digits_bench *w) {
  slong worst = 0;
  double most = -INFINITY;
  NUMBERS(arb, diff);
  for (slong k = 0; k < w->f->n; k++) {
    slong i = w->f->out[k];
    arb_set_d(diff, *(const double *)num_vec_at(&w->d, i));
    arb_sub(diff, diff, value(w, i), w->prec);
    double e = digits_log2(diff);
    if (e > most) {
      most = e;
      worst = k;
    }
  }
  return worst;
}

/* log2 of what the error of node i does to the result, in units of 2^-53 of the result's size 2^0. */
static double error_through(const struct digits_bench *w, slong i) {
  NUMBERS(arb, diff);
  arb_set_d(diff, *(const double *)num_vec_at(&w->d, i));
  arb_sub(diff, diff, value(w, i), w->prec);
  arb_mul(diff, diff, num_vec_at(&w->adjoint, i), w->prec);
  return arb_is_zero(diff) ? -INFINITY : digits_log2(diff) + 53;
}

/* The node below the normal numbers whose error moves the result most. */
static slong underflowing(double *most, const struct digits_bench *w) {
  slong best = -1;
  *most = -INFINITY;
  for (slong i = 0; i < w->f->tape.n; i++) {
    if (tape_only_under_rounded(&w->f->tape, i) || !is_tiny(value(w, i)) || w->d_flags[i]) continue;
    double e = error_through(w, i);
    if (!(e > *most)) continue;
    *most = e;
    best = i;
  }
  return best;
}

/* The first node that has become zero; -1. */
static slong vanished(const struct digits_bench *w) {
  for (slong i = 0; i < w->f->tape.n; i++)
    if (!tape_only_under_rounded(&w->f->tape, i) && is_tiny(value(w, i)) && !w->d_flags[i] &&
        *(const double *)num_vec_at(&w->d, i) == 0)
      return i;
  return -1;
}

bool digits_underflows(struct digits_bench *w, const struct digits_loss *r, double size) {
  enum { UNEXPLAINED = 20 };
  double most;
  bool any = false;
  for (slong i = 0; i < w->f->tape.n; i++)
    any = any || (!tape_only_under_rounded(&w->f->tape, i) && is_tiny(value(w, i)));
  if (!any) return false;
  if (r->error > r->predicted + UNEXPLAINED && vanished(w) >= 0)
    return true; /* no small change: a frequency became 0 */
  fill_adjoint(w, worst_entry(w), false);
  return underflowing(&most, w) >= 0 && most - size > fmin(r->error, 53) - 2;
}

static enum loss_cause cause_of(enum tape_op op, bool divides) {
  switch (op) {
  case TAPE_add:
  case TAPE_sub:
    return divides ? CAUSE_SMALL_DIVISOR : CAUSE_CANCELLATION;
  case TAPE_ROOT:
    return CAUSE_ROOT;
  case TAPE_mul:
  case TAPE_div:
  case TAPE_POW:
  case TAPE_neg:
  case TAPE_abs:
    return CAUSE_ROUNDING;
  default:
    return CAUSE_ARGUMENT;
  }
}

struct digits_cause digits_explain(struct digits_bench *w) {
  const struct tape *t = &w->f->tape;
  if (w->f->kernel) return (struct digits_cause){CAUSE_CODE, -1, 0};
  slong which = worst_entry(w), top = w->f->out[which], by = 0;
  fill_adjoint(w, which, false);
  slong n = source_node(w, top);
  struct digits_cause c = {CAUSE_ROUNDING, n, 0};
  bool divides = false; /* the culprit, behind which nothing but factors came, is a divisor */
  bool open = false;
  for (slong i = next_on_the_way(&by, w, n, top); n != top && i >= 0; i = next_on_the_way(&by, w, n, top)) {
    double g = growth(w, i, by);
    enum tape_op op = t->code[i].op;
    if (open && op == TAPE_div && by == 1) divides = true;
    if (op != TAPE_mul && op != TAPE_neg) open = false;
    if (g > 1 && g > c.grows) {
      c = (struct digits_cause){CAUSE_ROUNDING, i, g};
      divides = false;
      open = true;
    }
    n = i;
  }
  if (c.grows > 1) c.cause = cause_of(t->code[c.node].op, divides);
  return c;
}

static bool is_wrong_zero(const struct digits_bench *w, slong i) {
  return !w->d_flags[i] && *(const double *)num_vec_at(&w->d, i) == 0 && !arb_contains_zero(value(w, i));
}

/* Where a zero that should be none has begun: factors, roots and powers hand it on. */
static slong zero_source(const struct digits_bench *w, slong i) {
  const struct tape *t = &w->f->tape;
  for (bool on = true; on && t->code[i].op != TAPE_add && t->code[i].op != TAPE_sub;) {
    on = false;
    for (slong k = 0; !on && k < tape_operands(t, i); k++) {
      on = is_wrong_zero(w, tape_operand(t, i, k));
      if (on) i = tape_operand(t, i, k);
    }
  }
  return i;
}

/* The first node that has no value though its operands have; else the smallest that underflows. */
struct digits_cause digits_explain_failure(struct digits_bench *w) {
  const struct tape *t = &w->f->tape;
  if (w->f->kernel) return (struct digits_cause){CAUSE_CODE, -1, 0};
  for (slong i = 0; i < t->n; i++) {
    if (w->d_flags[i] == SS_OK || tape_only_under_rounded(&w->f->tape, i)) continue;
    enum tape_op op = t->code[i].op;
    slong at = op == TAPE_div ? zero_source(w, t->code[i].b) : i;
    bool tiny = digits_log2(value(w, at)) < LEAST_NORMAL;
    if (w->d_flags[i] & SS_DOMAIN)
      return (struct digits_cause){tiny ? CAUSE_UNDERFLOW : op == TAPE_ROOT ? CAUSE_ROOT : CAUSE_ZERO_DIVISOR, at, 0};
    if (op == TAPE_ROOT) return (struct digits_cause){CAUSE_ROOT, i, 0};
    bool over = digits_log2(value(w, i)) > MOST_NUMBER;
    return (struct digits_cause){over ? CAUSE_OVERFLOW : CAUSE_ZERO_DIVISOR, over ? i : at, 0};
  }
  double most;
  fill_adjoint(w, worst_entry(w), false);
  slong i = underflowing(&most, w);
  if (i < 0) i = vanished(w);
  return (struct digits_cause){CAUSE_UNDERFLOW, i < 0 ? w->f->out[0] : i, 0};
}
