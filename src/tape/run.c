/* The evaluation keeps the status flags of each instruction, so that an output is blamed only for what it depends
   on. */
#include <math.h>
#include <stdlib.h>

#include "base/work.h"
#include "tape.h"
#include "tape_impl.h"

/* --- One instruction --- */

static int run_root(void *z, const struct tape *t, const struct tape_instr *in, const struct num_vec *reg) {
  OWNED(num_vec) coeff;
  num_vec_init(&coeff, in->b, reg->ctx);
  for (slong k = 0; k < in->b; k++) reg->ctx.type->set(num_vec_at(&coeff, k), num_vec_at(reg, t->links[in->a + k]));
  return num_poly_root(z, &coeff, in->k);
}

int tape_inherited(const struct tape *t, slong i, const int *flags) {
  int s = SS_OK;
  slong n = tape_operands(t, i);
  for (slong k = 0; k < n; k++) s |= flags[tape_operand(t, i, k)];
  return s;
}

static int run(const struct tape *t, slong i, struct num_vec *reg, const struct num_vec *in) {
  const struct tape_instr *op = &t->code[i];
  const struct num_type *type = reg->ctx.type;
  slong prec = reg->ctx.prec;
  void *z = num_vec_at(reg, i);
  switch (op->op) {
  case TAPE_CONST:
    return type->set_q(z, &t->consts[op->k], prec);
  case TAPE_INPUT:
    type->set(z, num_vec_at(in, op->k));
    return SS_OK;
  case TAPE_POW:
    return type->pow_si(z, num_vec_at(reg, op->a), op->k, prec);
  case TAPE_ROUNDED:
    type->set(z, num_vec_at(reg, op->a));
    return SS_OK;
  case TAPE_ROOT:
    return run_root(z, t, op, reg);
#define NUM_UNARY(name)                                                                                                \
  case TAPE_##name:                                                                                                    \
    return type->name(z, num_vec_at(reg, op->a), prec);
#define NUM_BINARY(name)                                                                                               \
  case TAPE_##name:                                                                                                    \
    return type->name(z, num_vec_at(reg, op->a), num_vec_at(reg, op->b), prec);
#include "num/ops.def"
  }
  abort();
}

/* All but what is there already; NULL: nothing is. */
static void run_all(struct num_vec *reg, int *flags, const struct tape *t, const struct num_vec *in,
                    const bool *there) {
  slong prec = reg->ctx.prec;
  work_add((unsigned long long)t->n * (prec > 128 ? (unsigned long long)prec / 128 : 1));
  for (slong i = 0; i < t->n; i++) {
    if (there && there[i]) continue;
    flags[i] = tape_inherited(t, i, flags);
    if (flags[i] == SS_OK) flags[i] = run(t, i, reg, in);
  }
}

/* --- What is rounded once --- */

/* By so many bits a ball is narrower than the last place of what it is rounded to; below 2^LEAST_SIZE a double becomes
   0. */
enum { GUARD_BITS = 8, LEAST_SIZE = -1100, FIRST_BITS = 128, LAST_BITS = 4096 };

static bool becomes_zero(arb_srcptr x, const struct num_ctx *ctx) {
  NUMBERS(mag, size);
  arb_get_mag(size, x);
  return ctx->type == &num_double && mag_cmp_2exp_si(size, LEAST_SIZE) < 0;
}

static bool is_known(arb_srcptr x, const struct num_ctx *ctx) {
  return arb_rel_accuracy_bits(x) > ctx->prec + GUARD_BITS || becomes_zero(x, ctx);
}

static bool all_known(const struct num_vec *ball, const int *flags, const struct tape *t, const struct num_ctx *ctx) {
  bool known = true;
  for (slong i = 0; known && i < t->n; i++)
    if (t->code[i].op == TAPE_ROUNDED && !t->only_under_rounded[i])
      known = (flags[i] & SS_DOMAIN) || (!flags[i] && is_known(num_vec_at(ball, i), ctx));
  return known;
}

/* Every instruction in balls, until what is to be rounded is known. */
static void enclose(struct num_vec *ball, int *flags, const struct tape *t, const struct num_vec *in) {
  slong prec = in->ctx.prec, last = 8 * prec > LAST_BITS ? 8 * prec : LAST_BITS;
  OWNED(num_vec) x;
  num_vec_init(&x, in->len, num_ctx_arb(last));
  for (slong i = 0; i < in->len; i++) in->ctx.type->get_arb(num_vec_at(&x, i), num_vec_at(in, i));
  for (slong bits = 2 * prec > FIRST_BITS ? 2 * prec : FIRST_BITS;; bits = 2 * bits < last ? 2 * bits : last) {
    ball->ctx.prec = x.ctx.prec = bits;
    run_all(ball, flags, t, &x, NULL);
    if (all_known(ball, flags, t, &in->ctx) || bits == last) break;
  }
}

static int rounded(void *z, const struct num_ctx *ctx, arb_srcptr x, bool must_be_known) {
  if (must_be_known && !is_known(x, ctx)) return SS_UNABLE;
  return becomes_zero(x, ctx) ? ctx->type->set_d(z, 0, ctx->prec) : ctx->type->set_arb(z, x, ctx->prec);
}

/* What counts only under TAPE_ROUNDED, and the roundings themselves, from balls; `there` says which those are. */
static void round_once(struct num_vec *reg, int *flags, bool *there, const struct tape *t, const struct num_vec *in) {
  OWNED(num_vec) ball;
  FREED int *ball_flags = ss_malloc((size_t)t->n * sizeof *ball_flags);
  num_vec_init(&ball, t->n, num_ctx_arb(FIRST_BITS));
  enclose(&ball, ball_flags, t, in);
  for (slong i = 0; i < t->n; i++) {
    there[i] = t->only_under_rounded[i] || t->code[i].op == TAPE_ROUNDED;
    if (!there[i]) continue;
    flags[i] = ball_flags[i];
    if (!flags[i]) flags[i] = rounded(num_vec_at(reg, i), &reg->ctx, num_vec_at(&ball, i), !t->only_under_rounded[i]);
  }
}

/* --- All --- */

static bool rounds(const struct num_type *type) {
  return type == &num_double || type == &num_mpfr;
}

int tape_eval(struct num_vec *out, int *status, const struct tape *t, const struct num_vec *in) {
  OWNED(num_vec) reg;
  num_vec_init(&reg, t->n, out->ctx);
  FREED int *flags = ss_malloc((size_t)t->n * sizeof *flags);
  FREED bool *there = t->only_under_rounded && rounds(out->ctx.type) ? ss_malloc((size_t)t->n * sizeof *there) : NULL;
  if (there) round_once(&reg, flags, there, t, in);
  run_all(&reg, flags, t, in, there);
  int all = SS_OK;
  for (slong i = 0; i < t->n_outputs; i++) {
    int f = flags[t->outputs[i]];
    all |= f;
    if (status) status[i] = f;
    if (f == SS_OK)
      out->ctx.type->set(num_vec_at(out, i), num_vec_at(&reg, t->outputs[i]));
    else
      out->ctx.type->set_d(num_vec_at(out, i), NAN, out->ctx.prec);
  }
  return all;
}
