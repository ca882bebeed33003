/* Functions of dynamics.h in double precision: worked out in balls and rounded once.

   In plain double precision the closed forms lose digits that the problem does not: where the terms of an entry cancel
   (chi small, chi eta near 1, short times), where om t is rounded before its sine is taken, where a product overflows
   though the result does not.  So the same code runs in balls, at a precision that rises until every result is known
   beyond a double, and what a double cannot hold is a status.  The usual point takes one pass at FIRST bits. */
#include <math.h>
#include <stdint.h>

#include "rounded.h"

enum { FIRST = 128, LAST = 4096, KNOWN = 64, LEAST = -1022, NOTHING = -1080 };

/* A copy in balls; false when something is not finite. */
static bool to_balls(struct num_vec *z, const struct num_vec *x) {
  bool finite = true;
  for (slong i = 0; i < x->len; i++) {
    double v = num_double.get_d(num_vec_at(x, i));
    finite = finite && isfinite(v);
    arb_set_d(num_vec_at(z, i), v);
  }
  return finite;
}

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

/* One pass at the precision.  *known: a higher one would change nothing. */
static int pass(struct num_vec *out, bool *known, phase_function run, enum phase ph, struct num_vec b[4], slong prec) {
  int status = SS_OK;
  for (int i = 0; i < 4; i++) b[i].ctx.prec = prec;
  *known = true;
  status = run(&b[3], ph, &b[0], &b[1], b[2].len ? num_vec_at(&b[2], 0) : NULL);
  if (status) {
    *known = (status & SS_DOMAIN) != 0;
    return status;
  }
  for (slong i = 0; i < out->len; i++) {
    double z;
    status |= round_ball(&z, known, num_vec_at(&b[3], i), prec == LAST);
    num_double.set(num_vec_at(out, i), &z);
  }
  return status;
}

int rounded_run(struct num_vec *out, phase_function run, enum phase ph, const struct num_vec *params,
                const struct num_vec *in, const void *t) {
  if (params->ctx.type != &num_double) return run(out, ph, params, in, t);
  const struct num_vec none = {params->ctx, 0, NULL}, time = {params->ctx, t ? 1 : 0, (char *)(uintptr_t)t};
  const struct num_vec *given[] = {params, in ? in : &none, &time};
  struct num_vec b[4];
  bool known = false;
  int status = SS_OK;
  for (int i = 0; i < 3; i++) {
    num_vec_init(&b[i], given[i]->len, num_ctx_arb(FIRST));
    known = !to_balls(&b[i], given[i]) || known;
  }
  num_vec_init(&b[3], out->len, num_ctx_arb(FIRST));
  if (known) status = SS_UNABLE;
  for (slong prec = FIRST; prec <= LAST && !known; prec *= 2) status = pass(out, &known, run, ph, b, prec);
  for (int i = 0; i < 4; i++) num_vec_clear(&b[i]);
  return status;
}
