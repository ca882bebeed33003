/* From a scene to the Coulomb simulation: friction, and a start on an orbit or at the printed numbers. */
#include "coulomb_setup.h"
#include "orbits.h"
#include "printed.h"
#include <math.h>
#include <string.h>

enum { SETUP_PREC = 128 };

/* e_i of the scene, at printed numbers the printed one, or else that of the orbit. */
static double limit_above_sliding(const struct scene *s, int i, const struct dyn_orbit *o, bool printed) {
  const fmpq *e = printed || s->given[KEY_E1 + i] ? scene_number(s, (enum scene_key)(KEY_E1 + i)) : NULL;
  if (e) return fmpq_get_d(e);
  return o ? num_arb.get_d(i == 0 ? o->e1 : o->e2) : 0;
}

/* Friction enough for a limit e above sliding and for the orbit, unless NULL: factor max(e_i, u_ri_min). */
static double own_friction(double factor, double e, int i, const struct dyn_orbit *o) {
  return factor * fmax(e, o ? num_arb.get_d(i == 0 ? o->u_r1_min : o->u_r2_min) : 0);
}

static double static_friction(const struct scene *s, int i, const struct dyn_orbit *o, bool printed) {
  if (s->given[KEY_U_R1 + i]) return fmpq_get_d(&s->value[KEY_U_R1 + i]);
  return own_friction(OWN_FRICTION, limit_above_sliding(s, i, o, printed), i, o);
}

/* Friction and the belt: what the orbit needs, or off the orbits, as at printed numbers, the most that any of them
   needs. */
static void set_params(struct coulomb_setup *sim, const struct scene *s, const struct dyn_orbits *list,
                       const struct dyn_orbit *o, bool printed) {
  *sim = (struct coulomb_setup){.own_friction = false};
  for (int i = 0; i < 2; i++) {
    double e = limit_above_sliding(s, i, o, printed), u_r = 0;
    for (slong k = 0; printed && k < list->n; k++) u_r = fmax(u_r, static_friction(s, i, &list->orbit[k], printed));
    if (!printed || list->n == 0) u_r = static_friction(s, i, o, printed);
    sim->params[COULOMB_UR1 + i] = u_r;
    sim->params[COULOMB_US1 + i] = u_r - e;
    sim->own_friction = sim->own_friction || !s->given[KEY_U_R1 + i];
  }
  for (int i = 0; i < 3; i++) sim->params[COULOMB_CHI + i] = fmpq_get_d(&s->value[KEY_CHI + i]);
  sim->period = o ? num_arb.get_d(o->period) : 0;
  sim->trace = printed || !o ? (double)NAN : num_arb.get_d(o->trace);
}

int coulomb_setup_on_orbit(struct coulomb_setup *sim, const fmpq params[N_PARAMS], const struct dyn_orbit *o,
                           double factor) {
  *sim = (struct coulomb_setup){
      .own_friction = true, .period = num_arb.get_d(o->period), .trace = num_arb.get_d(o->trace)};
  for (int i = 0; i < 3; i++) sim->params[COULOMB_CHI + i] = fmpq_get_d(params + P_CHI + i);
  for (int i = 0; i < 2; i++) {
    double e = fmpq_get_d(params + P_E1 + i);
    sim->params[COULOMB_UR1 + i] = own_friction(factor, e, i, o);
    sim->params[COULOMB_US1 + i] = sim->params[COULOMB_UR1 + i] - e;
  }
  return coulomb_start_set_d(sim->start, sim->params, num_arb.get_d(o->z10), num_arb.get_d(o->z20));
}

/* Friction and start; the orbit is the one asked for, at printed numbers the first, for its bounds and period. */
static bool setup_from(struct coulomb_setup *sim, const struct scene *s, const struct dyn_orbits *list, slong orbit,
                       bool printed, struct diag *d) {
  const struct dyn_orbit *o = orbit < list->n ? &list->orbit[orbit] : NULL;
  const struct printed_number *z[2];
  bool ok = printed ? printed_start(z, s) : o != NULL;
  if (!ok && printed)
    diag_set(d, "%s: error: --at printed needs printed z10 and z20", s->path);
  else if (!ok)
    scene_lacks_orbit(s, orbit, list->n, d);
  if (!ok) return false;
  set_params(sim, s, list, o, printed);
  sim->broken = !printed && o->admissible == TRUTH_FALSE;
  double z10 = printed ? fmpq_get_d(&z[0]->value) : num_arb.get_d(o->z10);
  double z20 = printed ? fmpq_get_d(&z[1]->value) : num_arb.get_d(o->z20);
  ok = coulomb_start_set_d(sim->start, sim->params, z10, z20) == SS_OK;
  if (!ok) diag_set(d, "%s: error: these parameters cannot be simulated", s->path);
  return ok;
}

bool audit_coulomb_setup(struct coulomb_setup *sim, const struct scene *s, slong orbit, bool printed, struct diag *d) {
  OWNED(dyn_orbits) list;
  audit_orbits(&list, s, SETUP_PREC);
  if (!printed) audit_orbits_complete(&list, s, SETUP_PREC);
  return setup_from(sim, s, &list, orbit, printed, d);
}

bool coulomb_setup_among(struct coulomb_setup *sim, const struct scene *s, const struct dyn_orbits *list, slong orbit) {
  return setup_from(sim, s, list, orbit, false, NULL);
}

bool coulomb_setup_listed(struct coulomb_setup *sim, const struct scene *s, slong orbit) {
  OWNED(dyn_orbits) list;
  audit_orbits(&list, s, SETUP_PREC);
  return coulomb_setup_among(sim, s, &list, orbit);
}

bool coulomb_start_read(double *z, int n, const char *start, const char *takes, struct diag *d) {
  NUMBERS(fmpq, x);
  bool ok = true;
  for (int i = 0; ok && i < n; i++) {
    size_t len = strcspn(start, ",");
    bool last = i + 1 == n;
    ok = (start[len] == '\0') == last ? scene_constant(x, start, len, "--start", d)
                                      : diag_set(d, "error: --start takes %s", takes);
    z[i] = fmpq_get_d(x);
    if (ok && !(fabs(z[i]) <= 1e100)) ok = diag_set(d, "error: --start takes numbers of at most 1e100");
    start += len + !last;
  }
  return ok;
}

bool audit_coulomb_setup_from(struct coulomb_setup *sim, const struct scene *s, const char *start, struct diag *d) {
  OWNED(dyn_orbits) list;
  bool ok = true;
  audit_orbits(&list, s, SETUP_PREC);
  const struct dyn_orbit *o = list.n ? &list.orbit[0] : NULL;
  if (!o && !scene_has_forces(s))
    ok = diag_set(d, "%s: error: without an orbit the scene must give e1 and e2 to be simulated", s->path);
  set_params(sim, s, &list, o, true);
  return ok && coulomb_start_read(sim->start, N_STATE, start, "four constant expressions, x1,x2,v1,v2", d);
}

int coulomb_setup_return(struct text *word, struct coulomb_result *end, const struct coulomb_setup *sim,
                         double periods) {
  OWNED(coulomb_log) log = {.n = 0};
  struct coulomb_plan plan = coulomb_plan_default;
  plan.returns = 1;
  plan.duration = periods * sim->period;
  struct coulomb_sink sink = coulomb_log_sink(&log);
  int status = coulomb_simulate_ode(end, sim->params, sim->start, &plan, &sink);
  coulomb_log_word(word, &log);
  return status;
}

truth coulomb_setup_closes(const struct coulomb_setup *sim) {
  struct coulomb_result end;
  OWNED(text) word = {0};
  int status = coulomb_setup_return(&word, &end, sim, 2);
  double off = fabs(end.at.x[1] - end.at.x[0] - (sim->start[1] - sim->start[0])) /
               (1 + fabs(sim->start[0]) + fabs(sim->start[1]));
  bool same = strcmp(text_str(&word), "GHCD") == 0;
  if (status != SS_OK) return TRUTH_UNKNOWN;
  if (!same || off > 1e-3) return TRUTH_FALSE;
  return off < 1e-7 ? TRUTH_TRUE : TRUTH_UNKNOWN;
}
