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
void system_orbit_init(struct system_orbit *s, const fmpq params[N_PARAMS], const struct dyn_orbit *near, slong prec) {
  OWNED(mech) m;
  struct mech_orbit o;
  double start[N_STATE];
  const fmpq *const none[2] = {NULL, NULL};
  *s = (struct system_orbit){.status = SS_OK};
  two_masses(&m, params, none);
  for (int i = 0; i < 2; i++) {
    start[i] = arf_get_d(arb_midref(i ? near->z20 : near->z10), ARF_RND_NEAR);
    start[2 + i] = fmpq_get_d(params + P_V);
  }
  s->status = near_enough(&o, &m, near->guess, start, prec);
  if (s->status) return;
  _arb_vec_set(s->t, o.t, N_PHASES);
  _arb_vec_set(s->z, o.state, N_PHASES * N_STATE);
  _arb_vec_set(s->z + N_PHASES * N_STATE, o.state, N_STATE);
  for (int i = 0; i < 4; i++) arb_set(s->j + i, arb_mat_entry(o.jacobian, i / 2, i % 2));
  mech_orbit_clear(&o);
}

void system_orbit_clear(struct system_orbit *s) {
  for (int i = 0; i < N_PHASES; i++) arb_clear(s->t + i);
  for (int i = 0; i < (N_PHASES + 1) * N_STATE; i++) arb_clear(s->z + i);
  for (int i = 0; i < 4; i++) arb_clear(s->j + i);
}
