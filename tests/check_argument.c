/* Sentences about conditions, counts, symbols and scaling: each kind of claim on small cases whose answer is known by
   hand, by another module (the margins of an orbit) or by tests/oracle/argument.py; hostile attributes; and the claims
   on file as a whole: nothing of the paper's numbering left out, counts that add up. */
#include "motion/margins.h"
#include "paper_model.h"
#include "proof/condition.h"
#include "rational.h"
#include "run/audit.h"
#include "test.h"
#include "value/expression.h"
#include "value/followed.h"
#include "value/orbit_pool.h"
#include "value/orbits.h"

#define HEAD "claim own\n  section: appendix_b\n  title: of the test\n"

/* What a claim of the test's own concludes; own and r are to be cleared behind the list. */
static void read_conclusion(struct conditions *list, struct claims *own, struct audit_result *r, const char *items) {
  struct diag said;
  struct judge j = paper_judge(r, &the_paper.model, &said, EFFORT_FULL);
  const char *path = scratch_print("own.claim", HEAD "  conclusion: %s\n", items);
  goes_well(claims_add_file(own, path, "claim", &d));
  struct view view = {&the_paper.model, LAYER_CORRECTED, NULL, NULL};
  ck_assert_msg(conditions_read(list, &j, &own->claim[0], "conclusion", view), "%s", said.message);
}

CASE("argument", .once = {paper_open, paper_close});

/* Rows of tests/oracle/argument.py: a scene, then e1, e2, V t_a (1 - chi)/2, (e1 - (z_1c - chi z_2c))/2 and
   (e2 - chi (z_20 - z_10))/2 there. */
static const struct {
  const char *q[N_DRAW];
  double e1, e2, stick, late, second;
} certificates[] = {{{"3/64", "55/8", "3/4", "221/64", "269/32"},
                     0.12444089340845,
                     0.11157838365975,
                     0.1476106643216,
                     0.217547533378131,
                     0.0686823943690888},
                    {{"11/64", "83/16", "1", "193/32", "89/16"},
                     0.00571375410074917,
                     0.775012748955643,
                     0.429491811665637,
                     0.874991864192924,
                     0.446981833305775}};

static void point_of(struct point *p, const char *const q[N_DRAW], double u_r1, double u_r2) {
  static const int where[N_DRAW] = {Q_CHI, Q_ETA, Q_V, Q_TB, Q_TC};
  point_init(p);
  p->kind = POINT_GIVEN;
  for (int i = 0; i < N_DRAW; i++) ck_assert_int_eq(fmpq_set_str(&p->q[where[i]], q[i], 10), 0);
  const double u[2] = {u_r1, u_r2};
  for (int i = 0; i < 2; i++) fmpq_set_si(&p->q[Q_US1 + i], (slong)ldexp(u[i], 30), 1 << 30);
}

/* (53) fails with u_r1 between e1 and the bound of the oracle and holds beyond; likewise the lower bound of (59), and
   that of (57) for u_r2; the bounds by the times are the same. */
TEST_EACH(bounds_of_an_independent_program, COUNT(certificates)) {
  OWNED(audit_result) r;
  OWNED(claims) own = {.n = 0};
  OWNED(conditions) list = {.n = 0};
  read_conclusion(&list, &own, &r, "eq-53#1, eq-59#1.1, eq-16b#1.1, text-16-friction, eq-57#2.1, text-58-friction");
  enum { FIRST_MASS = 4, BOUNDS = 6 };
  ck_assert_int_eq(list.n, BOUNDS);
  const double late = certificates[_i].late, second = certificates[_i].second;
  const double bound[BOUNDS] = {certificates[_i].stick, late, late, late, second, second};
  for (int k = 0; k < BOUNDS; k++)
    for (int side = -1; side <= 1; side += 2) {
      OWNED(point) p;
      NUMBERS(arb, value);
      double where;
      const double near = bound[k] + side * 1e-7;
      ck_assert(k >= FIRST_MASS || bound[k] > certificates[_i].e1);
      point_of(&p, certificates[_i].q, k < FIRST_MASS ? near : 10, k < FIRST_MASS ? 10 : near);
      truth holds = condition_holds(&where, value, &list.at[k], &p, the_paper.cache);
      ck_assert_msg(holds == (side > 0 ? TRUTH_TRUE : TRUTH_FALSE), "%s, %d: %d", list.at[k].text, side, (int)holds);
    }
}

/* The margins module works from closed forms of the extremes, the conditions from the paper's text by subdivision. */
TEST(conditions_are_the_margins_of_the_orbit) {
  static const struct {
    const char *item;
    int margin;
  } pairs[] = {{"eq-51#1", COND_TA},          {"eq-57#1", COND_GAMMA_V1}, {"text-h-phase#1", COND_H_V1},
               {"text-h-phase#2", COND_H_V2}, {"eq-59#2", COND_C_V2},     {"eq-59#1.2", COND_C_W},
               {"eq-54#2.2", COND_D_R},       {"eq-57#2.2", COND_GAMMA_R}};
  enum { PAIRS = COUNT(pairs), ORBITS = 40 };
  OWNED(audit_result) r;
  OWNED(claims) own = {.n = 0};
  OWNED(conditions) list = {.n = 0};
  LOCAL(text, items);
  for (int k = 0; k < PAIRS; k++) text_printf(&items, "%s%s", k ? ", " : "", pairs[k].item);
  read_conclusion(&list, &own, &r, text_str(&items));
  ck_assert_int_eq(list.n, PAIRS);
  struct judge j = {.cache = the_paper.cache};
  struct orbit_pool pool = orbit_pool_get(&j);
  long said[3] = {0}, done = 0;
  for (size_t i = 0; i < pool.n && done < ORBITS; i++) {
    const struct dyn_orbit *o = &pool.item[i]->list.orbit[0];
    if (o->grazing || !arb_is_positive(o->t[0])) continue; /* a stick phase that runs backwards has no interval */
    LOCAL(point, p);
    pool_point(&p, pool.item[i], 0);
    p.known = NULL;
    done++;
    for (int k = 0; k < PAIRS; k++) {
      NUMBERS(arb, value);
      double where;
      truth holds = condition_holds(&where, value, &list.at[k], &p, the_paper.cache);
      ck_assert_msg(holds == o->holds[pairs[k].margin], "%s on %zu: %d, not %d", pairs[k].item, i, (int)holds,
                    (int)o->holds[pairs[k].margin]);
      said[holds]++;
    }
  }
  ck_assert(done == ORBITS && said[TRUTH_TRUE] > 100 && said[TRUTH_FALSE] > 20 && said[TRUTH_UNKNOWN] == 0);
}

/* Orbits of a search come and go, and one may lie where another was. */
TEST(an_orbit_in_the_place_of_another_has_its_own_arc) {
  struct judge j = {.cache = the_paper.cache};
  struct orbit_pool pool = orbit_pool_get(&j);
  struct dyn_orbit o;
  OWNED(num_vec) params = vec_new(N_PARAMS, num_ctx_double());
  for (int i = 0; i < 2; i++) {
    o = pool.item[i]->list.orbit[0];
    for (int k = P_CHI; k <= P_V; k++) params.ctx.type->set_q(num_vec_at(&params, k), &pool.item[i]->q[k], 53);
    params.ctx.type->set_arb(num_vec_at(&params, P_E1), o.e1, 53);
    params.ctx.type->set_arb(num_vec_at(&params, P_E2), o.e2, 53);
    const struct followed *f = orbit_followed(the_paper.cache, &o, &params);
    ck_assert_double_eq_tol(*(double *)num_vec_at(&f->arc.z, 0), num_arb.get_d(o.z10), 1e-12);
  }
}

/* Nor does an answer depend on which claims were judged before: a control that only has to be refuted draws few orbits,
   and what is asked next has all of them, of which those few are the first. */
TEST(the_pool_does_not_remember_who_asked_first) {
  struct judge refute = {.cache = orbit_cache_new(), .effort = EFFORT_REFUTE}, full = {.cache = refute.cache};
  size_t few = orbit_pool_get(&refute).n;
  struct judge fresh = {.cache = orbit_cache_new()};
  struct orbit_pool all = orbit_pool_get(&full), first = orbit_pool_get(&fresh), again = orbit_pool_get(&refute);
  ck_assert_uint_lt(few, all.n);
  ck_assert_uint_eq(all.n, first.n);
  ck_assert_uint_eq(again.n, few);
  for (size_t i = 0; i < all.n; i++)
    for (int k = 0; k < N_DRAW; k++) ck_assert(fmpq_equal(&all.item[i]->q[k], &first.item[i]->q[k]));
  orbit_cache_free(full.cache);
  orbit_cache_free(fresh.cache);
}

/* The scene of a certificate is a scene, and its orbit breaks just what the certificate says. */
TEST(a_certificate_is_a_scene) {
  OWNED(audit_result) r = judge_only(&the_paper.model, "text-59-concluded");
  const char *from = r.findings[0].evidence[0].note, *end = strstr(from, " there is a solution");
  ck_assert(r.findings[0].verdict == VERDICT_CONDITIONAL && strncmp(from, "for ", 4) == 0 && end);
  LOCAL(text, t);
  for (from += strlen("for "); from < end; from++) text_add_char(&t, *from == ',' ? '\n' : *from);
  for (char *c = t.data; (c = strstr(c, "\n ")) != NULL;) memmove(c + 1, c + 2, strlen(c + 1));
  OWNED(dyn_orbits) list;
  OWNED(scene) s = scene_at(scratch_put("found.scene", text_str(&t)));
  ck_assert(s.given[KEY_U_R1] && s.given[KEY_TB] && !scene_has_forces(&s));
  audit_orbits(&list, &s, 128);
  ck_assert(list.n >= 1 && list.orbit[0].admissible == TRUTH_TRUE);
  double u = fmpq_get_d(&s.value[KEY_U_R1]), e1 = num_arb.get_d(list.orbit[0].e1);
  double least = num_arb.get_d(list.orbit[0].u_r1_min);
  ck_assert(e1 < u && u < least);
}

/* --- Scaling --- */

/* The formulas at fault as the note names them. */
static void faults_of(struct text *out, const char *overlay) {
  OWNED(audit_result) r;
  OWNED(model) m = paper_model(
      &(struct paper_layers){.overlay = overlay ? scratch_put("overlay.eq", overlay) : NULL, .controls = true});
  goes_well(
      judge_text(&r, &m, HEAD "  kind: scaling\n  scaled: V e_ u v F_ z x y d_ dz\n", &the_paper.scene, "own", &d));
  const char *note = r.findings[0].evidence[0].note;
  for (const char *p = note; p && *p;) {
    size_t n = strcspn(p, ":");
    if (*p != '(' && strncmp(p, "user", 4) != 0) break;
    text_printf(out, "%.*s ", (int)n, p);
    p = strstr(p, ". ");
    if (p) p += 2;
  }
  ck_assert(r.findings[0].verdict == (out->len ? VERDICT_REFUTED : VERDICT_PROVED));
}

TABLE(faulty, "tests/cases/without_a_degree.tsv", 2);
enum { OVERLAY, FAULTS }; /* its columns */

/* Dimensions by hand: V t z' in (10), 1 + sin/(V omega z) in (40); all else is homogeneous.  Repaired, none is left; a
   time added to a displacement, a displacement as an angle, or a root of unlike coefficients is found. */
TEST_EACH(formulas_without_a_degree, faulty.n) {
  char *const *row = faulty.row[_i];
  LOCAL(text, got);
  faults_of(&got, *row[OVERLAY] ? row[OVERLAY] : NULL);
  ck_assert_str_eq(text_str(&got), row[FAULTS]);
}

/* --- Counting --- */

/* det(N_1 - I) at the admissible orbit with chi = 15/64, eta = 2, V = 1, t_c = 43/32 and the t_b given. */
static void first_determinant(arb_t det, const char *t_b) {
  OWNED(point) p;
  struct diag d = {0};
  BALLS(16, v);
  int n;
  point_of(&p, (const char *const[N_DRAW]){"15/64", "2", "1", t_b, "43/32"}, 10, 10);
  const struct dyn_orbits *list = point_orbits(&p, the_paper.cache, 256);
  while (p.orbit < list->n && list->orbit[p.orbit].admissible != TRUTH_TRUE) p.orbit++;
  ck_assert_msg(p.orbit < list->n, "no admissible orbit at t_b = %s", t_b);
  ck_assert_int_eq(expression_at(v, &n, (struct view){&the_paper.model, LAYER_CORRECTED, NULL, NULL}, "det(N_1 - I)",
                                 "validation", &p, 256, the_paper.cache, &d),
                   SS_OK);
  arb_set(det, v);
}

/* Found by an independent search (1.78e-4 and -3.25e-4): (45) and (46) are not defined on every admissible orbit. */
TEST(the_first_inverse_has_exceptions) {
  NUMBERS(arb, x, y);
  first_determinant(x, "4771/2000");
  first_determinant(y, "2982/1250");
  ck_assert(arb_is_positive(x) && arb_is_negative(y));
  ck_assert_double_eq_tol(num_arb.get_d(x), 1.78e-4, 1e-6);
  ck_assert_double_eq_tol(num_arb.get_d(y), -3.25e-4, 1e-6);
}

/* --- The claims on file --- */

TEST(every_number_of_the_paper_is_covered) {
  long prose = 0;
  bool equation[62] = {false};
  for (size_t i = 0; i < the_paper.claims.n; i++) {
    const char *id = the_paper.claims.claim[i].id, *number = claim_get(&the_paper.claims.claim[i], "equation");
    prose += strncmp(id, "text-", 5) == 0 || strncmp(id, "fig-", 4) == 0;
    if (strncmp(id, "eq-", 3) != 0) continue;
    long n = strtol(id + 3, NULL, 10);
    ck_assert_msg(number && strtol(number, NULL, 10) == n, "%s is filed under equation %s", id, number);
    if (n >= 1 && n <= 61) equation[n] = true;
  }
  for (int n = 1; n <= 61; n++) ck_assert_msg(equation[n], "no claim for (%d)", n);
  ck_assert_int_ge(prose, 25);
}
