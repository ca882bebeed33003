/* Stability: what is proved by signs of (1) and (2), with one certified orbit on which it is so. */
#include "friction.h"
#include "judge.h"
#include "motion/certify.h"
#include "num/num_exact.h"

const struct dyn_orbit *behaviour_stable_orbit(struct point *p, struct behaviour *b) {
  if (!judge_params(p, b->j, b->c, claim_get(b->c, "at"))) return NULL;
  const struct dyn_orbits *list = orbit_cache_get(b->j->cache, p->q, FD_PREC + 64);
  for (slong i = 0; i < list->n; i++) {
    const struct dyn_orbit *o = &list->orbit[i];
    if (o->admissible == TRUTH_TRUE && o->stable == TRUTH_TRUE && !o->grazing) return o;
  }
  claim_error(b->j, b->c, "at", "there is no stable admissible orbit at these parameters");
  return NULL;
}

/* Something of a mass in a phase, in which it slips or not, that may vanish; NULL: it is not known. */
typedef val of_mass(const struct friction *f, struct law_state *s, bool slips, int mass);

static bool vanishes_in_each_phase(const struct friction *f, of_mass *what) {
  truth all = TRUTH_TRUE;
  for (int ph = 0; ph < N_PHASES; ph++)
    for (int i = 0; i < 2; i++) {
      OWNED(law_state) s;
      law_state_open(&s, num_ctx_exact());
      val x = friction_mode(f, &s, phase_slips[ph]) ? what(f, &s, phase_slips[ph][i], i) : NULL;
      all = truth_and(all, x ? law_vanishes(&s, x) : TRUTH_UNKNOWN);
    }
  return all == TRUTH_TRUE;
}

/* x'' less that of the model, whose motions an orbit is certified to be. */
static val off_the_models(const struct friction *f, struct law_state *s, bool slips, int mass) {
  val model = slips ? calc_sub(&s->c, s->slide[mass], law_pull(s, mass)) : calc_d(&s->c, 0);
  (void)f;
  if (mass) model = calc_mul(&s->c, s->eta, model);
  return calc_sub(&s->c, s->a[mass], model);
}

static bool is_the_models(const struct friction *f) {
  return vanishes_in_each_phase(f, off_the_models) && events_decided(f);
}

/* The part of a mass in the divergence of (x', x''), whose first part has none. */
static val divergence(const struct friction *f, struct law_state *s, bool slips, int mass) {
  val before = s->a[mass];
  (void)slips;
  s->v[mass] = law_free(s);
  val after = friction_acceleration(f, s, mass);
  return after ? calc_sub(&s->c, after, before) : NULL;
}

/* Do the motions of each phase keep the volume of the phase space? */
static bool keeps_volume(const struct friction *f) {
  return vanishes_in_each_phase(f, divergence);
}

/* "the orbit at chi = ... is certified: ..."; NULL when that it is a motion by (1) and (2), exists, is admissible and
   has |tr J| < 1 is not proved. */
static const char *certified(struct behaviour *b, const struct point *p, const struct dyn_orbit *o) {
  static const enum dyn_quantity which[2] = {QUANTITY_E1, QUANTITY_E2};
  const struct dyn_question q = {p->q + Q_CHI, p->q + Q_E1, which, {NULL, NULL}};
  OWNED(text) t = {0};
  if (!is_the_models(b->law)) return NULL;
  OWNED(dyn_certificate) z = {.certified = false};
  dyn_certify(&z, &q, o);
  if (!z.certified || z.stable != TRUTH_TRUE || z.admissible != TRUTH_TRUE) return NULL;
  text_printf(&t,
              "the orbit at %s is certified in balls (%ld bits; one solution in its box, first events, each a simple "
              "root, and all conditions), with tr J = ",
              claim_get(b->c, "at"), (long)z.bits);
  num_print_ball(&t, o->trace, 6);
  return result_take(b->j->out, &t);
}

static const char attracts[] = "at the start of its stick phase r = z_2 - z_1 alone fixes what follows, the return map "
                               "of r is analytic there, since its events are simple roots (implicit function theorem), "
                               "and its slope is tr J: starts beside it in the stick phase come back to it";

struct route_result stable_prove_linearization(struct behaviour *b, const struct point *p, const struct dyn_orbit *o) {
  const char *orbit = keeps_volume(b->law) ? certified(b, p, o) : NULL;
  if (!orbit)
    return behaviour_proof(
        b, ROUTE_UNDECIDED,
        "no stable orbit is certified as a motion by (1) and (2), or a phase does not keep the volume");
  return behaviour_proof(
      b, ROUTE_AGREES,
      result_str(b->j->out,
                 "in each phase x''_i does not depend on x'_i, so that the linearized system has the trace 0 "
                 "and its propagator the determinant 1 (Liouville's formula); the product of the phases' propagators "
                 "has it too, and the product of its multipliers is 1: linearizing the phases alone calls no periodic "
                 "solution asymptotically stable, not even one that attracts all nearby starts in the stick phase: %s; "
                 "%s",
                 orbit, attracts));
}

/* A mass slower than the belt by however little, on which f exceeds u_s, falls back further. */
static bool falls_back(const struct friction *f) {
  OWNED(law_state) s;
  law_state_open_in(&s, (struct law_cell){0, 1, PULL_OVER, 1});
  return friction_apply(f, &s, 0, 1) && law_sign(&s, friction_acceleration(f, &s, 0)) == -1;
}

struct route_result stable_prove_conditional(struct behaviour *b, const struct point *p, const struct dyn_orbit *o) {
  const char *orbit = falls_back(b->law) && arb_is_positive(o->t[0]) ? certified(b, p, o) : NULL;
  if (!orbit)
    return behaviour_proof(
        b, ROUTE_UNDECIDED,
        "no stable orbit is certified as a motion by (1) and (2), or the sign of x''_1 is not known");
  return behaviour_proof(
      b, ROUTE_AGREES,
      result_str(
          b->j->out,
          "on every admissible orbit with t_a > 0, simple roots as events and |tr J| < 1: %s. Other perturbations, "
          "however small, do not: in the stick phase f_1 = x_1 - chi x_2 rises to u_r1 > u_s1; where u_s1 < f_1 < u_r1 "
          "and x'_1 is lowered from V to V - delta, (2) has the slip motion of m_1, x''_1 = u_s1 - f_1 < 0, so that "
          "m_1 slips at once, before f_1 has reached u_r1, whatever delta > 0 is. As delta tends to 0 that motion "
          "tends to the slip motion from the orbit's own state, which does not meet the orbit again for some time "
          "(states of the orbit with x'_1 near V and x'_2 = V either stick or have f_1 near u_r1): the distance from "
          "the orbit does not tend to 0 with delta. There are such orbits: %s",
          attracts, orbit));
}
