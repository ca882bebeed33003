/* What damaged formulas showed to be unread: the blocks and springs behind (1), states and perturbations where nothing
   is V, friction that a realistic orbit has.  What is expected is known by hand: the blocks by Newton's law, forces by
   the orbit's own bounds. */
#include "paper_model.h"
#include "test.h"
#include "value/values.h"

CASE("law", .once = {paper_open, paper_close});

/* --- Points --- */

static struct num_ctx balls(void) {
  return num_ctx_arb(FIRST_PREC);
}

static void bind(arb_t z, struct values *v, const char *name) {
  bool known;
  ck_assert_msg(values_bind(z, &known, v, name) == SS_OK && known, "%s", name);
}

/* m omega_3^2 x'' + k x + k_between (x - x_other) = F */
static void newton(struct values *v, const char *const name[6]) {
  BALLS(9, w);
  for (int i = 0; i < 6; i++) bind(w + i, v, name[i]);
  bind(w + 6, v, "omega_3");
  bind(w + 7, v, "k_2");
  arb_mul(w, w, w + 6, FIRST_PREC);
  arb_mul(w, w, w + 6, FIRST_PREC);
  arb_mul(w, w, w + 1, FIRST_PREC);
  arb_sub(w, w, w + 5, FIRST_PREC);
  if (name[4][0] == 'k') arb_addmul(w, w + 4, w + 2, FIRST_PREC);
  arb_sub(w + 8, w + 2, w + 3, FIRST_PREC);
  arb_addmul(w, w + 7, w + 8, FIRST_PREC);
  ck_assert_msg(arb_contains_zero(w) && mag_cmp_2exp_si(arb_radref(w), -80) < 0, "%s", name[0]);
  for (int i = 0; i < 2; i++) ck_assert(arb_is_positive(w + 6 + i));
}

/* Newton's law for the blocks, in the time before scaling, along motions of every phase. */
TEST_EACH(blocks_obey_newton, N_PHASES) {
  static const char *const name[2][6] = {{"m_1", "x_1''(t)", "x_1(t)", "x_2(t)", "k_1", "F_1"},
                                         {"m_2", "x_2''(t)", "x_2(t)", "x_1(t)", "V", "F_2"}};
  LOCAL(point, p);
  struct sampler s = sampler_of("blocks", (struct point_spec){.kind = POINT_FLOW, .phase = (enum phase)_i});
  for (int n = 0; n < 4; n++) {
    OWNED(values) v;
    sampler_next(&p, &s);
    ck_assert(values_init(&v, &p, n % 2 ? VARIANT_EXPONENTIAL : VARIANT_CLOSED, balls(), the_paper.cache) == SS_OK);
    for (int mass = 0; mass < 2; mass++) newton(&v, name[mass]);
  }
}

/* Closed forms and exponentials carry a patched state alike; nothing on the way is V, and no two perturbations agree
   but those that are zero. */
TEST(patched_states_are_general) {
  static const char *const tangent[] = {"x",   "y",   "u",   "v",   "x_a", "y_a", "u_a", "v_a", "x_b", "y_b",
                                        "u_b", "v_b", "x_c", "y_c", "u_c", "v_c", "x_f", "y_f", "u_f", "v_f"};
  LOCAL(point, p);
  struct sampler s = sampler_of("patched", (struct point_spec){.kind = POINT_PATCHED, .phase = PHASE_C});
  for (int n = 0; n < 6; n++) {
    struct values v[2];
    NUMBERS(arb, belt);
    BALLS(COUNT(tangent), x);
    sampler_next(&p, &s);
    for (int k = 0; k < 2; k++)
      ck_assert(values_init(&v[k], &p, k ? VARIANT_EXPONENTIAL : VARIANT_CLOSED, balls(), the_paper.cache) == SS_OK);
    arb_set_fmpq(belt, &p.q[Q_V], FIRST_PREC);
    for (int i = 0; i < 4 * (N_PHASES + 1); i++) {
      ck_assert(arb_overlaps(num_vec_at(&v[0].arc.z, i), num_vec_at(&v[1].arc.z, i)));
      ck_assert(i % 4 < 2 || fmpq_equal(&p.q[Q_DZ1], &p.q[Q_V]) || fmpq_equal(&p.q[Q_DZ2], &p.q[Q_V]) ||
                !arb_overlaps(num_vec_at(&v[0].arc.z, i), belt));
    }
    for (int i = 0; i < COUNT(tangent); i++) {
      bind(x + i, &v[0], tangent[i]);
      bool zero = i == 6 || i == 7 || i == 11 || i == 18; /* (25), (30), (38) */
      ck_assert_msg((arb_is_zero(x + i) != 0) == zero || fmpq_is_zero(&p.q[Q_X]) || fmpq_is_zero(&p.q[Q_Y]), "%s",
                    tangent[i]);
      for (int k = 0; k < i; k++) ck_assert(zero || arb_is_zero(x + i) || !arb_equal(x + i, x + k));
    }
    for (int k = 0; k < 2; k++) values_clear(&v[k]);
  }
}

/* Every u_ri exceeds e_i and what the orbit asks by a quarter or a 1024th, and by no more than the grid; both occur. */
TEST(realistic_friction_is_above_what_is_asked) {
  LOCAL(point, p);
  long seen = 0, few = 0;
  struct sampler s =
      sampler_of("realistic", (struct point_spec){.kind = POINT_ORBIT, .admissible = true, .realistic = true});
  for (int draws = 0; draws < 40 && seen < 6; draws++) {
    sampler_next(&p, &s);
    if (!point_settle(&p, the_paper.cache)) continue;
    const struct dyn_orbit *o = &point_orbits(&p, the_paper.cache, FIRST_PREC)->orbit[p.orbit];
    ck_assert(o->admissible == TRUTH_TRUE);
    for (int i = 0; i < 2; i++) {
      double e = fmpq_get_d(&p.q[Q_E1 + i]), u_r = fmpq_get_d(&p.q[Q_US1 + i]) + e;
      double least = num_arb.get_d(i ? o->u_r2_min : o->u_r1_min);
      if (least < e) least = e;
      double above = u_r > 1.1 * least ? 1.25 : 1025.0 / 1024;
      ck_assert(u_r >= above * least - 1e-12 && u_r <= above * least + 1.0 / 1024 + 1e-12);
      few += above < 1.25;
    }
    seen++;
  }
  ck_assert_int_eq(seen, 6);
  ck_assert(few > 0 && few < 12);
}
