/* From a scene to the Coulomb simulation: friction, and a start on an orbit or at the printed numbers. */
#include <math.h>

#include "audit_impl.h"

static double middle(const arb_t x) {
  return arf_get_d(arb_midref(x), ARF_RND_NEAR);
}

/* e_i of the scene, or else of the orbit. */
static double limit_above_sliding(const struct scene *s, int i, const struct dyn_orbit *o) {
  if (s->given[KEY_E1 + i]) return fmpq_get_d(&s->value[KEY_E1 + i]);
  return o ? middle(i == 0 ? o->e1 : o->e2) : 0;
}

/* Friction enough for a limit e above sliding and for the orbit, unless NULL: 5/4 max(e_i, u_ri_min). */
static double own_friction(double e, int i, const struct dyn_orbit *o) {
  return 1.25 * fmax(e, o ? middle(i == 0 ? o->u_r1_min : o->u_r2_min) : 0);
}

static double static_friction(const struct scene *s, int i, const struct dyn_orbit *o) {
  if (s->given[KEY_U_R1 + i]) return fmpq_get_d(&s->value[KEY_U_R1 + i]);
  return own_friction(limit_above_sliding(s, i, o), i, o);
}

static int set_start(struct coulomb_setup *sim, double z10, double z20) {
  struct num_vec p, x, z;
  num_vec_init(&p, N_COULOMB, num_ctx_double());
  num_vec_init(&x, N_STATE, num_ctx_double());
  num_vec_init(&z, 2, num_ctx_double());
  for (int i = 0; i < N_COULOMB; i++) p.ctx.type->set_d(num_vec_at(&p, i), sim->params[i], 53);
  z.ctx.type->set_d(num_vec_at(&z, 0), z10, 53);
  z.ctx.type->set_d(num_vec_at(&z, 1), z20, 53);
  int s = coulomb_start_set(&x, &p, num_vec_at(&z, 0), num_vec_at(&z, 1));
  for (int i = 0; i < N_STATE; i++) sim->start[i] = x.ctx.type->get_d(num_vec_at(&x, i));
  num_vec_clear(&z);
  num_vec_clear(&x);
  num_vec_clear(&p);
  return s;
}

int coulomb_setup_on_orbit(struct coulomb_setup *sim, const fmpq params[N_PARAMS], const struct dyn_orbit *o) {
  *sim = (struct coulomb_setup){.own_friction = true, .period = middle(o->period), .trace = middle(o->trace)};
  for (int i = 0; i < 3; i++) sim->params[COULOMB_CHI + i] = fmpq_get_d(params + P_CHI + i);
  for (int i = 0; i < 2; i++) {
    double e = fmpq_get_d(params + P_E1 + i);
    sim->params[COULOMB_UR1 + i] = own_friction(e, i, o);
    sim->params[COULOMB_US1 + i] = sim->params[COULOMB_UR1 + i] - e;
  }
  return set_start(sim, middle(o->z10), middle(o->z20));
}

/* Friction and start; the orbit is the one asked for, at printed numbers the first, for its bounds and period. */
bool audit_coulomb_setup(struct coulomb_setup *sim, const struct scene *s, slong orbit, bool printed, struct diag *d) {
  struct dyn_orbits list;
  *sim = (struct coulomb_setup){.own_friction = false};
  audit_orbits(&list, s, 128);
  const struct dyn_orbit *o = orbit < list.n ? &list.orbit[orbit] : NULL;
  const struct printed_number *z[2] = {scene_printed(s, "z10"), scene_printed(s, "z20")};
  bool ok = printed ? z[0] && z[1] : o != NULL;
  if (!ok && printed)
    diag_set(d, "%s: error: --at printed needs printed z10 and z20", s->path);
  else if (!ok)
    diag_set(d, "%s: error: there is no orbit %ld; the scene has %ld", s->path, (long)orbit + 1, (long)list.n);
  if (ok) {
    for (int i = 0; i < 2; i++) {
      double e = limit_above_sliding(s, i, o), u_r = 0;
      for (slong k = 0; printed && k < list.n; k++) u_r = fmax(u_r, static_friction(s, i, &list.orbit[k]));
      if (!printed || list.n == 0) u_r = static_friction(s, i, o);
      sim->params[COULOMB_UR1 + i] = u_r;
      sim->params[COULOMB_US1 + i] = u_r - e;
      sim->own_friction = sim->own_friction || !s->given[KEY_U_R1 + i];
    }
    for (int i = 0; i < 3; i++) sim->params[COULOMB_CHI + i] = fmpq_get_d(&s->value[KEY_CHI + i]);
    sim->period = o ? middle(o->period) : 0;
    sim->trace = printed ? (double)NAN : middle(o->trace);
    double z10 = printed ? fmpq_get_d(&z[0]->value) : middle(o->z10);
    double z20 = printed ? fmpq_get_d(&z[1]->value) : middle(o->z20);
    ok = set_start(sim, z10, z20) == SS_OK;
    if (!ok) diag_set(d, "%s: error: these parameters cannot be simulated", s->path);
  }
  dyn_orbits_clear(&list);
  return ok;
}
