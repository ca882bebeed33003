/* The paper's orbits from the general engine. */
#include "system_orbit.h"

#include "mech/two_masses.h"

/* With J to three quarters of the bits, for which stiff data need up to four times as many. */
static int near_enough(struct mech_orbit *o, const struct mech *m, const double *t, const double *z, slong prec) {
  static const struct mech_word word = {N_PHASES, {"ss", "-s", "--", "s-"}};
  for (int times = 1;; times *= 2) {
    slong bits = prec;
    int status = mech_orbit_near(o, m, &word, t, z, times * prec);
    for (int i = 0; !status && i < 4; i++) {
      slong good = arb_rel_accuracy_bits(arb_mat_entry(o->jacobian, i / 2, i % 2));
      if (good < bits) bits = good;
    }
    if (status || 4 * bits >= 3 * prec || times == 4) return status;
    mech_orbit_clear(o);
  }
}

/* Without sliding friction z is x. */
int system_orbit(arb_ptr t, arb_ptr z, arb_ptr j, const fmpq params[N_PARAMS], const struct dyn_orbit *near,
                 slong prec) {
  OWNED(mech) m;
  struct mech_orbit o;
  double start[N_STATE];
  const fmpq *const none[2] = {NULL, NULL};
  two_masses(&m, params, none);
  for (int i = 0; i < 2; i++) {
    start[i] = arf_get_d(arb_midref(i ? near->z20 : near->z10), ARF_RND_NEAR);
    start[2 + i] = fmpq_get_d(params + P_V);
  }
  int status = near_enough(&o, &m, near->guess, start, prec);
  if (!status) {
    if (t) _arb_vec_set(t, o.t, N_PHASES);
    if (z) _arb_vec_set(z, o.state, N_PHASES * N_STATE);
    if (z) _arb_vec_set(z + N_PHASES * N_STATE, o.state, N_STATE);
    for (int i = 0; j && i < 4; i++) arb_set(j + i, arb_mat_entry(o.jacobian, i / 2, i % 2));
    mech_orbit_clear(&o);
  }
  return status;
}
