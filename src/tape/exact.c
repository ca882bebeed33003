/* One pass over a tape in a field: each instruction makes one element of elements before it.  Sums and products are
   rewritten by the field's relations at once.  An instruction that has no value, or whose value is too large, leaves
   none to those that read it; the other outputs are computed all the same. */
#include <stdlib.h>
#include <string.h>

#include "exact_impl.h"
#include "tape_impl.h"

static int input(fmpz_mpoly_q_struct *z, struct exact_field *f, const char *name) {
  if (f->bind) return f->bind(z, f, name, f->bind_arg);
  for (int k = 0; k < f->n_facts; k++) {
    if (strcmp(f->fact[k].name, name) != 0) continue;
    struct num_vec v;
    OWNED(calc) c = exact_calc(f);
    int s = exact_eval(&v, &c, f, &f->fact[k].tape);
    if (s == SS_OK) num_exact.set(z, num_vec_at(&v, 0));
    return s;
  }
  return exact_symbol(z, f, name);
}

static int power(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x, slong n) {
  enum { MAX_POWER = 16 };
  if (n < -MAX_POWER || n > MAX_POWER) return SS_UNABLE;
  NUMBERS(quotient, r);
  fmpz_mpoly_q_set_si(r, 1, ring());
  int s = SS_OK;
  for (slong i = 0; s == SS_OK && i < labs(n); i++) s = exact_apply(n < 0 ? num_exact.div : num_exact.mul, r, f, r, x);
  fmpz_mpoly_q_swap(z, r, ring());
  return s;
}

static int run(const struct tape *t, slong i, fmpz_mpoly_q_struct *reg, struct exact_field *f) {
  const struct tape_instr *in = &t->code[i];
  fmpz_mpoly_q_struct *z = &reg[i];
  const fmpz_mpoly_q_struct *a = in->a >= 0 ? &reg[in->a] : NULL, *b = in->b >= 0 ? &reg[in->b] : NULL;
  switch (in->op) {
  case TAPE_CONST:
    fmpz_mpoly_q_set_fmpq(z, &t->consts[in->k], ring());
    return SS_OK;
  case TAPE_INPUT:
    return input(z, f, t->inputs[in->k]);
  case TAPE_ROOT:
    return exact_root(z, f, t, in, reg);
  case TAPE_POW:
    return power(z, f, a, in->k);
  case TAPE_ROUNDED:
    fmpz_mpoly_q_set(z, a, ring());
    return SS_OK;
  case TAPE_neg:
    return num_exact.neg(z, a, 0);
  case TAPE_sin:
  case TAPE_cos:
  case TAPE_cot:
    return exact_circular(z, f, in->op, a);
  case TAPE_sqrt:
    return exact_sqrt(z, f, a);
  case TAPE_exp:
    return exact_exp(z, f, a);
  case TAPE_abs:
    return exact_abs(z, f, a);
  case TAPE_sinc:
  case TAPE_stumpff:
    return exact_over_angle(z, f, in->op, a);
  case TAPE_hypot:
    return exact_hypot(z, f, a, b);
  case TAPE_add:
    return exact_apply(num_exact.add, z, f, a, b);
  case TAPE_sub:
    return exact_apply(num_exact.sub, z, f, a, b);
  case TAPE_mul:
    return exact_apply(num_exact.mul, z, f, a, b);
  case TAPE_div:
    return exact_apply(num_exact.div, z, f, a, b);
  default:
    return SS_UNABLE;
  }
}

/* What the wanted outputs reach. */
static bool *reached(const struct tape *t, const bool *wanted) {
  bool *needed = ss_malloc((size_t)(t->n + 1) * sizeof *needed);
  for (slong i = 0; i < t->n; i++) needed[i] = false;
  for (slong i = 0; i < t->n_outputs; i++)
    if (!wanted || wanted[i]) needed[t->outputs[i]] = true;
  for (slong i = t->n; i-- > 0;)
    for (slong k = 0; needed[i] && k < tape_operands(t, i); k++) needed[tape_operand(t, i, k)] = true;
  return needed;
}

/* all: nothing is computed any more once something that is reached has failed. */
static int eval(struct num_vec *out, int *status, struct calc *c, struct exact_field *f, const struct tape *t,
                const bool *wanted, bool all) {
  OWNED(calc) w = calc_begin(num_ctx_exact());
  const struct num_vec values = calc_vec(&w, t->n + 1);
  fmpz_mpoly_q_struct *reg = num_vec_at(&values, 0);
  FREED int *s = ss_malloc((size_t)(t->n + 1) * sizeof *s);
  FREED bool *needed = reached(t, wanted);
  int failed = SS_OK, together = SS_OK;
  for (slong i = 0; i < t->n; i++) {
    s[i] = SS_UNABLE;
    if (!needed[i] || (all && failed)) continue;
    s[i] = tape_inherited(t, i, s);
    if (s[i] == SS_OK) s[i] = run(t, i, reg, f);
    slong terms = num_exact_terms(&reg[i]);
    if (s[i] == SS_OK && terms > f->limit) s[i] = SS_UNABLE;
    if (terms > f->largest) f->largest = terms;
    failed |= s[i];
  }
  *out = calc_vec(c, t->n_outputs);
  for (slong i = 0; i < out->len; i++) {
    status[i] = s[t->outputs[i]];
    together |= status[i];
    if (status[i] == SS_OK) num_exact.set(num_vec_at(out, i), &reg[t->outputs[i]]);
  }
  return all ? failed : together;
}

int exact_eval_each(struct num_vec *out, int *status, struct calc *c, struct exact_field *f, const struct tape *t,
                    const bool *wanted) {
  return eval(out, status, c, f, t, wanted, false);
}

int exact_eval(struct num_vec *out, struct calc *c, struct exact_field *f, const struct tape *t) {
  FREED int *status = ss_malloc((size_t)(t->n_outputs + 1) * sizeof *status);
  return eval(out, status, c, f, t, NULL, true);
}

bool exact_tapes_equal(struct exact_field *f, const struct tape *a, const struct tape *b) {
  OWNED(calc) c = exact_calc(f);
  struct num_vec x, y;
  int s = exact_eval(&x, &c, f, a);
  s |= exact_eval(&y, &c, f, b);
  bool same = s == SS_OK && x.len == y.len;
  for (slong i = 0; same && i < x.len; i++) same = exact_equal(f, num_vec_at(&x, i), num_vec_at(&y, i));
  return same;
}
