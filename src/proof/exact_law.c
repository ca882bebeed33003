/* Coulomb's law on exact motions, see exact_law.h.

   By K d = (u_s1, eta u_s2) the restoring forces are f_1 = x_1 - chi x_2 = z_1 - chi z_2 + u_s1 and
   f_2 = chi (x_2 - x_1) = chi (z_2 - z_1) + u_s2.  A mass sticks from the start of its phase on, so that its force is
   below the limit there, too. */
#include "exact_law.h"

#include "exact_motion_impl.h"
#include "num/calc.h"

static val named(struct calc *c, struct exact_motion *m, const char *name) {
  element *z = calc_new(c);
  c->status |= exact_motion_bind(z, m->field, name, m);
  return z;
}

struct law {
  struct num_vec *margin;
  struct exact_bound *bound; /* or NULL */
  int n;
};

static void add(struct law *law, struct calc *c, val margin, struct exact_bound bound) {
  calc_store(c, at(law->margin, law->n), margin);
  if (law->bound) law->bound[law->n] = bound;
  law->n++;
}

/* u_ri - f_i and, with friction, u_ri + f_i. */
static void add_force(struct law *law, struct calc *c, struct exact_motion *m, struct exact_bound bound,
                      const char *const z[2]) {
  bool second = bound.mass == 1;
  val z1 = named(c, m, z[0]), z2 = named(c, m, z[1]), chi = at(&m->params, P_CHI);
  val f = second ? calc_mul(c, chi, calc_sub(c, z2, z1)) : calc_sub(c, z1, calc_mul(c, chi, z2));
  add(law, c, calc_sub(c, named(c, m, second ? "e_2" : "e_1"), f), bound);
  if (!m->spec.realistic) return;
  val limit = calc_add(c, named(c, m, second ? "u_r2" : "u_r1"), named(c, m, second ? "u_s2" : "u_s1"));
  bound.lower = true;
  add(law, c, calc_add(c, limit, f), bound);
}

int exact_law_margins(struct num_vec *out, struct exact_bound *bound, struct exact_motion *m) {
  static const char *const now[2] = {"z_1(t)", "z_2(t)"}, *const speed[2] = {"z_1'(t)", "z_2'(t)"};
  if (!m->spec.admissible || m->attempt.time != TIME_INSIDE) return 0;
  OWNED(calc) c = exact_calc(m->field);
  struct law law = {.margin = out, .bound = bound};
  for (int mass = 0; mass < 2; mass++) {
    if (!phase_slips[m->spec.phase][mass]) {
      add_force(&law, &c, m, (struct exact_bound){.mass = mass, .force = true}, now);
      add_force(&law, &c, m, (struct exact_bound){.mass = mass, .force = true, .start = true},
                name_state[m->spec.phase]);
    } else {
      val margin = calc_sub(&c, at(&m->params, P_V), named(&c, m, speed[mass]));
      add(&law, &c, margin, (struct exact_bound){.mass = mass});
    }
  }
  return c.status == SS_OK ? law.n : 0;
}

void exact_orbit_init(struct exact_motion *m, enum phase ph, int anchor, enum exact_time time, bool friction) {
  const struct point_spec spec = {.kind = POINT_ORBIT, .phase = ph, .admissible = true, .realistic = friction};
  const struct exact_attempt attempt = {.modes = ph == PHASE_H, .anchor = anchor, .time = time};
  exact_motion_init(m, &attempt, &spec, NULL);
  m->first_state = 0;
}

/* --- What follows --- */

/* A product of what is positive, or zero. */
static bool is_rest(const element *x, const struct num_vec *positive, int n) {
  return exact_is_zero(x) || exact_product_sign(x, num_vec_at(positive, 0), n) > 0;
}

bool exact_follows(struct exact_motion *m, const element *x, const struct num_vec *facts, int n) {
  enum { N_FACTORS = 4 };
  OWNED(calc) c = exact_calc(m->field);
  struct num_vec positive = calc_vec(&c, EXACT_POSITIVE);
  int n_positive = exact_motion_positive(&positive, m);
  val factor[N_FACTORS] = {calc_d(&c, 1), at(&m->params, P_CHI), calc_d(&c, 2), calc_d(&c, 0.5)};
  bool yes = exact_product_sign(x, num_vec_at(&positive, 0), n_positive) > 0;
  element *bare = calc_new(&c), *bare_fact = calc_new(&c);
  exact_without_factors(bare, x, num_vec_at(&positive, 0), n_positive);
  slong mark = calc_mark(&c);
  for (int i = 0; !yes && i < n; i++) {
    exact_without_factors(bare_fact, at(facts, i), num_vec_at(&positive, 0), n_positive);
    for (int k = 0; !yes && k < 2 * N_FACTORS; k++) {
      bool as_given = k < N_FACTORS;
      c.status = SS_OK;
      val rest =
          calc_sub(&c, as_given ? x : bare, calc_mul(&c, factor[k % N_FACTORS], as_given ? at(facts, i) : bare_fact));
      yes = c.status == SS_OK && is_rest(rest, &positive, n_positive);
      calc_release(&c, mark);
    }
  }
  return yes;
}
