/* One formula at one point: its value in double against a ball around the true one, at the same exact doubles. */
#include <math.h>
#include <stdlib.h>

#include "num/calc.h"
#include "stability_impl.h"

/* The truth is known to so many bits beyond its size; precisions from the first to the last, doubled. */
enum { TRUTH_BITS = 64, TRUTH_FIRST = 128, TRUTH_LAST = 4096 };

/* log2 of a condition number below which second derivatives so large that 2^-53 of an input is not small are not to be
   feared where the first vanish, as at the crests of a fast oscillation. */
static const double NOT_STEADY = 10;

static slong n_nodes(const struct digits_formula *f) {
  return f->kernel ? f->n : f->tape.n;
}

void digits_bench_init(struct digits_bench *w, struct digits_formula *f) {
  const struct tape *t = &f->tape;
  slong n = n_nodes(f);
  *w = (struct digits_bench){.f = f, .prec = TRUTH_FIRST};
  num_vec_init(&w->x, t->n_inputs, num_ctx_double());
  num_vec_init(&w->d, n, num_ctx_double());
  num_vec_init(&w->bx, t->n_inputs, num_ctx_arb(TRUTH_FIRST));
  num_vec_init(&w->b, n, num_ctx_arb(TRUTH_FIRST));
  num_vec_init(&w->adjoint, n, num_ctx_arb(TRUTH_FIRST));
  w->d_flags = ss_malloc((size_t)n * sizeof *w->d_flags);
  w->b_flags = ss_malloc((size_t)n * sizeof *w->b_flags);
}

void digits_bench_clear(struct digits_bench *w) {
  num_vec_clear(&w->x);
  num_vec_clear(&w->d);
  num_vec_clear(&w->bx);
  num_vec_clear(&w->b);
  num_vec_clear(&w->adjoint);
  free(w->d_flags);
  free(w->b_flags);
}

/* log2_upper is good to a bit; losses are told to tenths of digits. */
double digits_log2_mag(const mag_t x) {
  if (mag_is_zero(x)) return -INFINITY;
  if (mag_is_inf(x)) return INFINITY;
  return log2((double)MAG_MAN(x)) + fmpz_get_d(MAG_EXPREF(x)) - MAG_BITS;
}

static double log2_radius(arb_srcptr x) {
  return digits_log2_mag(arb_radref(x));
}

double digits_log2(arb_srcptr x) {
  NUMBERS(mag, m);
  arb_get_mag(m, x);
  return digits_log2_mag(m);
}

/* All nodes; of a function of the program its results, which share one status. */
static void run(struct num_vec *out, int *flags, const struct digits_formula *f, const struct num_vec *in) {
  if (!f->kernel) {
    tape_eval(out, flags, &f->tape, in);
    return;
  }
  int status = digits_kernel_run(out, f, in);
  for (slong k = 0; k < f->n; k++) flags[k] = status;
}

/* The true values of all nodes at the working precision.  DIGITS_LOST: the entries are known well enough; *size is log2
   of the largest. */
static enum digits_kind truth_at(double *size, struct digits_bench *w) {
  const struct digits_formula *f = w->f;
  w->b.ctx.prec = w->bx.ctx.prec = w->adjoint.ctx.prec = w->prec;
  run(&w->b, w->b_flags, f, &w->bx);
  int flags = SS_OK;
  bool exact = true;
  double radius = -INFINITY;
  *size = -INFINITY;
  for (slong k = 0; k < f->n; k++) {
    arb_srcptr v = num_vec_at(&w->b, f->out[k]);
    flags |= w->b_flags[f->out[k]];
    if (flags) continue;
    *size = fmax(*size, digits_log2(v));
    radius = fmax(radius, log2_radius(v));
    exact = exact && arb_is_zero(v);
  }
  if (flags & SS_DOMAIN) return DIGITS_OUTSIDE;
  if (flags) return DIGITS_UNDECIDED;
  if (exact) return DIGITS_ZERO;
  return radius <= *size - TRUTH_BITS ? DIGITS_LOST : DIGITS_UNDECIDED;
}

/* Raises the precision until the truth is known.  What is still zero at the last precision counts as zero. */
static enum digits_kind find_truth(double *size, struct digits_bench *w) {
  enum digits_kind kind;
  for (w->prec = TRUTH_FIRST;; w->prec *= 2) {
    kind = truth_at(size, w);
    if (kind != DIGITS_UNDECIDED || 2 * w->prec > TRUTH_LAST) break;
  }
  bool zero = kind == DIGITS_UNDECIDED;
  for (slong k = 0; k < w->f->n; k++) {
    slong i = w->f->out[k];
    zero = zero && w->b_flags[i] == SS_OK && arb_contains_zero(num_vec_at(&w->b, i));
  }
  return zero ? DIGITS_ZERO : kind;
}

/* The formula in double: DIGITS_FAILED where an entry that a double can hold has no value. */
static enum digits_kind run_double(struct digits_loss *r, struct digits_bench *w, double size) {
  const struct digits_formula *f = w->f;
  run(&w->d, w->d_flags, f, &w->x);
  double *error = &r->error;
  *error = -INFINITY;
  NUMBERS(arb, diff);
  enum digits_kind kind = DIGITS_LOST;
  for (slong k = 0; k < f->n; k++) {
    slong i = f->out[k];
    if (w->d_flags[i]) {
      kind = DIGITS_FAILED;
      continue;
    }
    double got = *(const double *)num_vec_at(&w->d, i);
    arb_set_d(diff, got);
    arb_sub(diff, diff, num_vec_at(&w->b, i), w->prec);
    double off = digits_log2(diff) - size + 53;
    if (off <= *error) continue;
    *error = off;
    r->sign_lost = got > 0 ? arb_is_negative(num_vec_at(&w->b, i)) : got < 0 && arb_is_positive(num_vec_at(&w->b, i));
  }
  return kind;
}

static double digits_of(double bits) {
  return fmin(STABILITY_DIGITS, fmax(0, bits * log10(2)));
}

static void set_inputs(struct digits_bench *w, const double *x) {
  for (slong k = 0; k < w->f->tape.n_inputs; k++) {
    *(double *)num_vec_at(&w->x, k) = x[k];
    arb_set_d(num_vec_at(&w->bx, k), x[k]);
  }
}

/* log2 of the sum over the inputs of what a change by 2^-53 of one, up or down, does to the result, in units of 2^-53
   of 2^size: where a change that small is not small, the derivative does not tell. */
static double moved(const struct digits_bench *w, double size) {
  const struct digits_formula *f = w->f;
  FREED int *flags = ss_malloc((size_t)n_nodes(f) * sizeof *flags);
  NUMBERS(arb, step, off);
  double sum = 0;
  OWNED(calc) c = calc_begin(num_ctx_arb(w->prec));
  struct num_vec x = calc_vec(&c, f->tape.n_inputs), b = calc_vec(&c, n_nodes(f));
  num_vec_set(&x, &w->bx);
  for (slong k = 0; k < x.len; k++) {
    double most = 0;
    for (int sign = -1; sign <= 1; sign += 2) {
      arb_mul_2exp_si(step, num_vec_at(&w->bx, k), -53);
      arb_addmul_si(num_vec_at(&x, k), step, sign, w->prec);
      run(&b, flags, f, &x);
      for (slong i = 0; i < f->n; i++) {
        if (flags[f->out[i]]) continue;
        arb_sub(off, num_vec_at(&b, f->out[i]), num_vec_at(&w->b, f->out[i]), w->prec);
        most = fmax(most, exp2(fmin(1000, digits_log2(off) - size)));
      }
      arb_set(num_vec_at(&x, k), num_vec_at(&w->bx, k));
    }
    sum += most;
  }
  return sum > 0 ? log2(sum) + 53 : -INFINITY;
}

/* What roundings of the nodes and of the inputs do to the result, by the entry that they do most to. */
static void find_effect(struct digits_loss *r, struct digits_bench *w, double size) {
  if (w->f->kernel) {
    r->predicted = NAN;
    r->condition = digits_kernel_condition(w->f, &w->bx, size);
    return;
  }
  for (bool known = false; !known;) {
    known = true;
    r->predicted = r->condition = -INFINITY;
    for (slong k = 0; k < w->f->n; k++) {
      struct digits_effect e = digits_adjoint(w, k, size);
      r->predicted = isnan(e.predicted) || isnan(r->predicted) ? NAN : fmax(r->predicted, e.predicted);
      r->condition = fmax(r->condition, e.condition);
      known = known && e.known;
    }
    if (known || 2 * w->prec > TRUTH_LAST) return;
    w->prec *= 2;
    double same;
    truth_at(&same, w);
  }
}

struct digits_loss digits_measure(struct digits_bench *w, const double *x, double floor) {
  struct digits_loss r = {.predicted = NAN};
  double size;
  set_inputs(w, x);
  r.kind = find_truth(&size, w);
  if (r.kind != DIGITS_LOST) return r;
  r.kind = size > 1023.99 || size < -1021.99 ? DIGITS_OUTSIDE : run_double(&r, w, size);
  if (r.kind == DIGITS_OUTSIDE) return r;
  r.observed = digits_of(r.error);
  if (r.kind == DIGITS_LOST && fmax(0, r.error * log10(2)) <= floor) {
    r.kind = DIGITS_LESS;
    return r;
  }
  find_effect(&r, w, size);
  if (isnan(r.condition)) r.kind = DIGITS_UNDECIDED;
  if (digits_predicts_failure(w)) r.predicted = NAN;
  bool blamed = r.kind == DIGITS_LOST && stability_is_loss(r.observed - digits_of(r.condition));
  r.moved =
      blamed && r.condition > NOT_STEADY ? moved(w, size) : -INFINITY; /* an excuse that the derivatives do not know */
  r.problem = digits_of(fmax(r.condition, r.moved));
  r.formula = r.kind == DIGITS_LOST ? fmax(0, r.observed - r.problem) : 0;
  r.excess = r.formula > 0 ? r.error * log10(2) - r.problem : 0;
  if (r.formula > 1 && digits_underflows(w, &r, size)) r.kind = DIGITS_FAILED;
  return r;
}

/* --- Condition numbers from symbolic derivatives --- */

/* log2 of the largest sum over the inputs [from, to), over the size; NaN when not known to a few digits at this
   precision. */
static double condition_at(struct digits_bench *w, slong from, slong to, slong prec) {
  const struct digits_formula *f = w->f;
  slong n = f->tape.n_inputs;
  OWNED(num_vec) in, slope; /* the derivatives meet the inputs in an order of their own */
  NUMBERS(arb, sum, term);
  num_vec_init(&in, f->slopes.n_inputs, num_ctx_arb(prec));
  num_vec_init(&slope, f->n * n, num_ctx_arb(prec));
  FREED int *flags = ss_malloc((size_t)(f->n * n) * sizeof *flags);
  for (slong k = 0; k < f->slopes.n_inputs; k++)
    arb_set(num_vec_at(&in, k), num_vec_at(&w->bx, tape_input(&f->tape, f->slopes.inputs[k])));
  tape_eval(&slope, flags, &f->slopes, &in);
  double most = -INFINITY, size = -INFINITY;
  bool known = true;
  for (slong i = 0; i < f->n; i++) {
    arb_zero(sum);
    for (slong k = from; k < to; k++) {
      known = known && flags[i * n + k] == SS_OK;
      arb_mul(term, num_vec_at(&w->bx, k), num_vec_at(&slope, i * n + k), prec);
      arb_abs(term, term);
      arb_add(sum, sum, term, prec);
    }
    known =
        known && (arb_rel_accuracy_bits(sum) > 20 || log2_radius(sum) < digits_log2(num_vec_at(&w->b, f->out[i])) - 20);
    most = fmax(most, digits_log2(sum));
    size = fmax(size, digits_log2(num_vec_at(&w->b, f->out[i])));
  }
  return known ? most - size : NAN;
}

double digits_condition(struct digits_bench *w, slong from, slong to) {
  double c = NAN;
  for (slong prec = w->prec; isnan(c) && prec <= 4 * w->prec; prec *= 2) c = condition_at(w, from, to, prec);
  return c;
}
