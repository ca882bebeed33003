/* The orbit from a guess (warm.h), studied like the functions of kernel.c: the truth is the orbit that dyn_orbit_near
   encloses at the same exact parameters.

   A point names chi, eta, V, e_1, e_2 and the guess t_b, t_c.  Forces at random hardly ever have an orbit near a guess
   at random, so a point of a region is moved to where there is one: t_b and t_c alone leave a quadratic equation for
   e_1 and e_2 (given.h), whose solution, rounded, takes the place of the region's forces. */

#include "motion/warm.h"
#include "motion/given.h"
#include "stability_impl.h"

enum { PLACE_BITS = 64 };
enum warm_input { WARM_CHI, WARM_ETA, WARM_V, WARM_E1, WARM_E2, WARM_TB, WARM_TC, N_WARM };

bool digits_warm_place(double *x) {
  static const enum dyn_quantity which[2] = {QUANTITY_TB, QUANTITY_TC};
  static const enum warm_input from[2] = {WARM_TB, WARM_TC};
  FMPQ_VECTOR(model, 3);
  FMPQ_VECTOR(time, 2);
  OWNED(dyn_orbits) list = {.n = 0};
  for (int i = 0; i < 3; i++) num_q_set_d(model + i, x[i]);
  for (int i = 0; i < 2; i++) num_q_set_d(time + i, x[from[i]]);
  dyn_orbits_given(&list, model, which, time, PLACE_BITS, NULL);
  if (!list.n) return false;
  x[WARM_E1] = num_arb.get_d(list.orbit[0].e1);
  x[WARM_E2] = num_arb.get_d(list.orbit[0].e2);
  return isnormal(x[WARM_E1]) && isnormal(x[WARM_E2]);
}

static int warm_in_double(struct num_vec *out, const struct num_vec *params, const double guess[2]) {
  double p[N_PARAMS], y[N_DYN_OUT];
  unsigned violations, unsure;
  for (slong i = 0; i < N_PARAMS; i++) p[i] = num_double.get_d(num_vec_at(params, i));
  int status = dyn_orbit_warm(y, &violations, &unsure, p, guess);
  for (slong i = 0; i < N_DYN_OUT && !status; i++) num_double.set(num_vec_at(out, i), &y[i]);
  return status;
}

/* Two orbits can be near one guess: that at which double precision comes to rest is meant, if it does.  Directions of
   phase C that are to be tried: from *up to the one returned. */
static int settle(double guess[2], int *up, const fmpq *params) {
  double p[N_PARAMS], y[N_DYN_OUT];
  unsigned violations, unsure;
  for (slong i = 0; i < N_PARAMS; i++) p[i] = fmpq_get_d(params + i);
  *up = 0;
  if (dyn_orbit_warm(y, &violations, &unsure, p, guess)) return 1;
  guess[0] = y[DYN_OUT_TB];
  guess[1] = y[DYN_OUT_TC];
  return *up = y[DYN_OUT_Z20] > y[DYN_OUT_Z10];
}

/* None whose t_b and t_c are not first roots. */
static int warm_in_balls(struct num_vec *out, const fmpq *params, double guess[2]) {
  const struct dyn_limits few = {1000, 2000};
  int status = SS_DOMAIN, up, last = settle(guess, &up, params);
  for (; up <= last && status; up++) {
    OWNED(dyn_orbit) o;
    truth first;
    status = dyn_orbit_near(&o, &first, params, (struct dyn_place){guess[0], guess[1], up == 1}, out->ctx.prec, &few);
    if (status || first != TRUTH_TRUE) status = first == TRUTH_UNKNOWN && !status ? SS_UNABLE : SS_DOMAIN;
    for (int i = 0; i < N_DYN_OUT && !status; i++)
      arb_set(num_vec_at(out, i), dyn_orbit_output(&o, (enum dyn_output)i));
  }
  return status;
}

int digits_warm_run(struct num_vec *out, const struct num_vec *params, const struct num_vec *state) {
  double guess[2];
  for (int i = 0; i < 2; i++) guess[i] = out->ctx.type->get_d(num_vec_at(state, i));
  if (out->ctx.type == &num_double) return warm_in_double(out, params, guess);
  FMPQ_VECTOR(p, N_PARAMS);
  for (slong i = 0; i < N_PARAMS; i++) arf_get_fmpq(p + i, arb_midref((arb_srcptr)num_vec_at(params, i)));
  return warm_in_balls(out, p, guess);
}
