/* The return map over balls, from rough times of its events: what the map in double precision is held against, and what it falls
   back on where its own roundings would show. */
#include "dyn_impl.h"
#include "stickslip/return_map.h"

/* w = e1: z_1 = (e1 + chi r)/(1 - chi), z_2 = z_1 + r. */
static void positions(val z[2], struct calc *c, const val p[N_PARAMS], val r) {
  val pull = calc_add(c, p[P_E1], calc_mul(c, p[P_CHI], r));
  z[0] = calc_div(c, pull, calc_sub(c, calc_d(c, 1), p[P_CHI]));
  z[1] = calc_add(c, z[0], r);
}

/* The next stick phase takes w from its last value to e1 at the speed (1 - chi) V. */
static val next_stick(struct calc *c, const val p[N_PARAMS], const struct dyn_arc *arc) {
  const struct num_vec end = {arc->z.ctx, N_STATE, num_vec_at(&arc->z, N_PHASES * N_STATE)};
  val z[N_STATE];
  flow_vals(z, &end, 0, N_STATE);
  return calc_neg(c, calc_div(c, flow_switching(c, PHASE_D, p, z), flow_switching_rate(c, PHASE_D, p, z)));
}

int dyn_return_near(struct num_vec *out, const struct num_vec *params, const void *r, const double guess[N_PHASES]) {
  struct calc c;
  struct dyn_arc arc;
  val p[N_PARAMS], z[2];
  const double near[] = {0, guess[PHASE_GAMMA], guess[PHASE_H], guess[PHASE_C]};
  arb_ptr jet = _arb_vec_init(2);
  calc_init(&c, params->ctx);
  dyn_arc_init(&arc, params->ctx);
  flow_vals(p, params, 0, N_PARAMS);
  positions(z, &c, p, r);
  int status = c.status;
  if (!status) status = dyn_arc_run(&arc, params, z[0], z[1], near);
  if (!status) status = dyn_return_jet(jet, 2, params, &arc);
  if (!status) {
    arb_set(num_vec_at(out, RETURN_TA), next_stick(&c, p, &arc));
    for (int ph = PHASE_GAMMA; ph < N_PHASES; ph++) arb_set(num_vec_at(out, RETURN_TA + ph), num_vec_at(&arc.t, ph));
    arb_set(num_vec_at(out, RETURN_R), jet);
    arb_set(num_vec_at(out, RETURN_SLOPE), jet + 1);
    status = c.status;
  }
  dyn_arc_clear(&arc);
  calc_clear(&c);
  _arb_vec_clear(jet, 2);
  return status;
}
