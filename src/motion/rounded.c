/* Functions of dynamics.h in double precision: worked out in balls and rounded once.

   In plain double precision the closed forms lose digits that the problem does not: where the terms of an entry cancel
   (chi small, chi eta near 1, short times), where om t is rounded before its sine is taken, where a product overflows
   though the result does not.  So the same code runs in balls, at a precision that rises until every result is known
   beyond a double, and what a double cannot hold is a status.  The usual point takes one pass at FIRST bits. */
#include <math.h>

#include "rounded.h"

enum { FIRST = 128, LAST = 4096, KNOWN = 64, LEAST = -1022, NOTHING = -1080, MOST_NUMBERS = 32 };

/* The double nearest to x; *known is false when x is not known well enough for that.  A number below the normal doubles
   has fewer digits than they: SS_UNABLE; what cannot be told from zero at the last precision is zero. */
static int round_ball(double *z, bool *known, arb_srcptr x, bool last) {
  *z = 0;
  if (arb_is_zero(x)) return SS_OK;
  if (arb_rel_accuracy_bits(x) < KNOWN) {
    *known = false;
    return last && arb_contains_zero(x) && arb_is_finite(x) && arf_cmpabs_2exp_si(arb_midref(x), NOTHING) < 0 &&
                   mag_cmp_2exp_si(arb_radref(x), NOTHING) < 0
               ? SS_OK
               : SS_UNABLE;
  }
  *z = arf_get_d(arb_midref(x), ARF_RND_NEAR);
  return isfinite(*z) && arf_cmpabs_2exp_si(arb_midref(x), LEAST) >= 0 ? SS_OK : SS_UNABLE;
}

static int evaluate(struct num_vec *out, phase_formula *f, enum phase ph, const val p[N_PARAMS], const val *in, val t) {
  val to[MOST_NUMBERS];
  OWNED(calc) c = calc_begin(out->ctx);
  f(to, &c, ph, p, in, t);
  for (slong i = 0; i < out->len; i++) out->ctx.type->set(num_vec_at(out, i), to[i]);
  return c.status;
}

/* The results of a pass.  *known: a higher precision would change nothing. */
static int round_all(struct num_vec *out, bool *known, const struct num_vec *balls, bool last) {
  int status = SS_OK;
  *known = true;
  for (slong i = 0; i < out->len; i++) {
    double z;
    status |= round_ball(&z, known, num_vec_at(balls, i), last);
    num_double.set(num_vec_at(out, i), &z);
  }
  return status;
}

/* The same numbers as balls, without a radius. */
static void to_balls(val *x, struct calc *c, slong n) {
  for (slong i = 0; i < n; i++) x[i] = calc_d(c, num_double.get_d(x[i]));
}

int rounded_run(struct num_vec *out, phase_formula *f, enum phase ph, const struct num_vec *params,
                const struct num_vec *in, const void *t) {
  val p[N_PARAMS], x[MOST_NUMBERS];
  slong n = in ? in->len : 0;
  flow_vals(p, params, 0, N_PARAMS);
  if (in) flow_vals(x, in, 0, n);
  if (params->ctx.type != &num_double) return evaluate(out, f, ph, p, x, t);
  OWNED(calc) given = calc_begin(num_ctx_arb(FIRST));
  struct num_vec balls = calc_vec(&given, out->len);
  to_balls(p, &given, N_PARAMS);
  to_balls(x, &given, n);
  if (t) to_balls(&t, &given, 1);
  bool known = given.status != SS_OK; /* something is not finite */
  int status = known ? SS_UNABLE : SS_OK;
  for (slong prec = FIRST; prec <= LAST && !known; prec *= 2) {
    balls.ctx.prec = prec;
    status = evaluate(&balls, f, ph, p, x, t);
    known = (status & SS_DOMAIN) != 0;
    if (!status) status = round_all(out, &known, &balls, prec == LAST);
  }
  return status;
}
