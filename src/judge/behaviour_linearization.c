/* Linearization: what the product of the phases' propagators alone would say of stability, and what it says with the
   jumps at the switches. */

#include "friction.h"
#include "judge.h"
#include "num/calc.h"
#include "value/oracle.h"

/* Is some eigenvalue of the 4x4 matrix surely outside the unit circle?  Yes when |tr M^k| > 4 for some k. */
static truth has_growth(const struct num_vec *m) {
  enum { DOUBLINGS = 9 };
  OWNED(calc) c = calc_begin(m->ctx);
  struct num_vec power = calc_vec(&c, m->len);
  val four = calc_d(&c, N_STATE);
  truth t = TRUTH_UNKNOWN;
  num_vec_set(&power, m);
  for (int i = 0; t != TRUTH_TRUE && i < DOUBLINGS; i++) {
    val trace = calc_d(&c, 0);
    for (int k = 0; k < N_STATE; k++) trace = calc_add(&c, trace, num_vec_at(&power, (N_STATE + 1) * k));
    if (calc_lt(&c, four, calc_abs(&c, trace))) t = TRUTH_TRUE;
    num_mat_mul(&power, &power, &power, N_STATE, N_STATE, N_STATE);
  }
  return t;
}

/* Unstable by the product of the phases' propagators? */
static truth unstable_by_propagators(struct values *v) {
  struct num_vec product = calc_vec(&v->c, N_STATE * N_STATE);
  return oracle_eval(&product, oracle_find("N"), v) == SS_OK ? has_growth(&product) : TRUTH_UNKNOWN;
}

/* Unstable by the Jacobian with saltation matrices, which has one eigenvalue that is not 0? */
static truth unstable_by_saltation(struct values *v) {
  struct calc *c = &v->c;
  struct num_vec j = calc_vec(c, 4);
  if (dyn_return_jacobian_saltation(&j, &v->params, &v->arc) != SS_OK) return TRUTH_UNKNOWN;
  val trace = calc_abs(c, calc_add(c, num_vec_at(&j, 0), num_vec_at(&j, 3))), one = calc_d(c, 1);
  return calc_lt(c, one, trace) ? TRUTH_TRUE : calc_lt(c, trace, one) ? TRUTH_FALSE : TRUTH_UNKNOWN;
}

struct methods {
  long right[2], wrong[2]; /* without jumps, with saltation matrices */
  long open;               /* without jumps */
  long comes_back, leaves; /* iterates where the method without jumps is wrong */
  const char *where;
};

static void compare_methods(struct methods *s, struct behaviour *b, const struct point *p, const struct dyn_orbit *o) {
  if (o->stable == TRUTH_UNKNOWN) return;
  OWNED(values) v;
  if (values_init(&v, p, VARIANT_CLOSED, num_ctx_arb(FIRST_PREC), b->j->cache) == SS_OK) {
    truth said[2] = {unstable_by_propagators(&v), unstable_by_saltation(&v)}, is = truth_not(o->stable);
    for (int i = 0; i < 2; i++)
      if (said[i] == TRUTH_UNKNOWN)
        s->open += i == 0;
      else
        *(said[i] == is ? &s->right[i] : &s->wrong[i]) += 1;
    if (said[0] != TRUTH_UNKNOWN && said[0] != is) {
      int fate = return_map_fate(p->q, orbit_r(o), 1e-4, 400);
      s->comes_back += fate > 0;
      s->leaves += fate < 0;
      if (!s->where) s->where = point_text(b->j, p);
    }
  }
}

/* The proof with the claim's own orbit.  false with d set. */
static bool prove(struct route_result *proof, struct behaviour *b) {
  LOCAL(point, p);
  const struct dyn_orbit *o = behaviour_stable_orbit(&p, b);
  if (o) *proof = stable_prove_linearization(b, &p, o);
  return o != NULL;
}

bool behaviour_linearization(struct behaviour *b) {
  enum { WANTED = 24, DRAWS = 96 };
  int method = claim_says(b->c, "jumps", "saltation");
  struct methods s = {.where = NULL};
  struct route_result w[3], proof = {.outcome = ROUTE_UNDECIDED};
  if (method == 0 && !prove(&proof, b)) return false;
  OWNED(orbit_walk) walk;
  const struct dyn_orbit *o;
  orbit_walk_begin(&walk, b, false, DRAWS);
  while (s.right[1] + s.wrong[1] < WANTED && (o = orbit_walk_next(&walk)) != NULL) compare_methods(&s, b, &walk.p, o);
  const char *note = result_str(b->j->out,
                                "the product of the phases' propagators (the variational equation without what happens "
                                "at the switches) has a multiplier outside the unit circle at %ld orbit%s where |tr J| "
                                "> 1 and also at %ld where |tr J| < 1 (none is proved at %ld others); with saltation "
                                "matrices at the switches linearization is right at %ld orbits and wrong at %ld",
                                s.right[0], plural_s(s.right[0]), s.wrong[0], s.open, s.right[1], s.wrong[1]);
  long right = s.right[method], wrong = s.wrong[method];
  enum route_outcome balls = wrong ? ROUTE_AGREES : right ? ROUTE_DIFFERS : ROUTE_NOTHING;
  w[0] = behaviour_route(b, (struct route_result){"balls", balls, true, right + wrong}, s.where, note);
  int n = 1;
  if (wrong)
    w[n++] = behaviour_route(b, counted_route("iteration", false, s.comes_back, s.leaves, 0), NULL,
                             result_str(b->j->out,
                                        "from beside the orbits that the propagators call unstable and J calls stable, "
                                        "iterates of the return map come back at %ld and depart at %ld",
                                        s.comes_back, s.leaves));
  b->f->verdict = verdict_with_proof(w, n, &proof);
  return true;
}
