/* Does the printed solution close?  One pass through the word from every start that the printed digits allow. */
#include <math.h>

#include "certificate.h"
#include "num/calc.h"

/* Positions after one pass through the word less those at its start, and the derivative of that: gap[0] for
   r = z_2 - z_1 (which alone fixes the state at the end of the stick phase), gap[1], gap[2] for z_1, z_2; slope[0],
   slope[1] of gap[0] with respect to z_1, z_2; times of the four events, unless NULL. */
static int closing_gap(arb_ptr gap, arb_ptr slope, arb_ptr times, struct judge *j, arb_srcptr start) {
  struct num_ctx ctx = num_ctx_arb(FIRST_PREC);
  OWNED(dyn_arc) arc;
  OWNED(calc) c = calc_begin(ctx);
  struct num_vec params = calc_vec(&c, N_PARAMS), jac = calc_vec(&c, 4);
  dyn_arc_init(&arc, ctx);
  int s = scene_numbers(&params, j);
  if (s == SS_OK) s |= dyn_arc_run(&arc, &params, start, start + 1, NULL);
  if (s == SS_OK) s |= dyn_return_jacobian(&jac, &params, &arc);
  for (int i = 0; i < 2; i++) {
    arb_sub(gap + 1 + i, num_vec_at(&arc.z, 16 + i), start + i, FIRST_PREC);
    arb_sub(slope + i, num_vec_at(&jac, 2 + i), num_vec_at(&jac, i), FIRST_PREC);
    arb_add_si(slope + i, slope + i, i == 0 ? 1 : -1, FIRST_PREC);
  }
  arb_sub(gap, gap + 2, gap + 1, FIRST_PREC);
  for (int i = 0; times && i < 4; i++) arb_set(times + i, num_vec_at(&arc.t, i));
  return s;
}

/* The gap of r over every start in the box z, by the mean value theorem: the gap at the middle plus the slope over the
   box times the distance from the middle. */
static int gap_over_box(arb_t gap, struct judge *j, arb_srcptr z) {
  ARB_VECTOR(w, 12);
  NUMBERS(arb, d);
  arb_ptr at_middle = w, middle = w + 3, slope = w + 5, unused = w + 7;
  for (int i = 0; i < 2; i++) arb_get_mid_arb(middle + i, z + i);
  int s = closing_gap(at_middle, unused + 3, NULL, j, middle);
  s |= closing_gap(unused, slope, NULL, j, z);
  arb_set(gap, at_middle);
  for (int i = 0; i < 2; i++) {
    arb_sub(d, z + i, middle + i, FIRST_PREC);
    arb_addmul(gap, slope + i, d, FIRST_PREC);
  }
  return s;
}

static void closure_by_times(struct finding *f, struct judge *j) {
  LOCAL(point, p);
  if (printed_point(&p, j->scene)) {
    OWNED(values) v;
    if (values_init(&v, &p, VARIANT_EXPONENTIAL, num_ctx_arb(FIRST_PREC), j->cache) == SS_OK) {
      ARB_VECTOR(d, 2);
      for (int i = 0; i < 2; i++) arb_sub(d + i, num_vec_at(&v.arc.z, 16 + i), num_vec_at(&v.arc.z, i), FIRST_PREC);
      finding_state(f, j->out, "balls", "model", FIRST_PREC, 1, "the printed state and times, taken exactly",
                    result_str(j->out,
                               "with the printed times the motion ends with z_1 and z_2 differing from their initial "
                               "values by %s and %s, and with the velocities %s and %s",
                               ball_text(j, d, 6), ball_text(j, d + 1, 6), ball_text(j, num_vec_at(&v.arc.z, 18), 8),
                               ball_text(j, num_vec_at(&v.arc.z, 19), 8)));
    }
  }
}

/* The scene's data, the printed start with its unit, and how far one period leads from it. */
static void certify_gap(struct finding *f, struct judge *j, const struct printed_number *const z[2], arb_srcptr gap) {
  struct certificate *c = &f->certificate;
  certify_scene(c, j);
  for (int i = 0; i < 2; i++) certify_exact(c, j, name_state[0][i], &z[i]->value);
  certify_exact(c, j, "unit", &z[0]->unit);
  for (int i = 0; i < 2; i++) certify_ball(c, j, i ? "off in z_2" : "off in z_1", gap + 1 + i);
}

/* What the printed start itself leads to, its decimals taken exactly. */
static void closure_by_events(struct finding *f, struct judge *j, const struct printed_number *const z[2], bool apart) {
  ARB_VECTOR(v, 11);
  arb_ptr start = v, gap = v + 2, slope = v + 5, t = v + 7;
  for (int i = 0; i < 2; i++) arb_set_fmpq(start + i, &z[i]->value, FIRST_PREC);
  if (closing_gap(gap, slope, t, j, start) == SS_OK) {
    finding_state(f, j->out, "balls", "model", FIRST_PREC, 1, "the printed initial state, taken exactly",
                  result_str(j->out, "from the printed initial state the phases have the durations %s, %s, %s and %s",
                             ball_text(j, t, 8), ball_text(j, t + 1, 8), ball_text(j, t + 2, 8),
                             ball_text(j, t + 3, 8)));
    if (apart) certify_gap(f, j, z, gap);
    if (apart)
      f->effect = result_str(
          j->out,
          "the motion from the printed initial state does not close: after one passage through the phases z_1 has "
          "changed by %s and z_2 by %s",
          ball_text(j, gap + 1, 5), ball_text(j, gap + 2, 5));
  }
}

/* An end of the ball, rounded away from it, to three digits. */
static double bound(const arb_t x, bool lower) {
  NUMBERS(arf, end);
  (lower ? arb_get_lbound_arf : arb_get_ubound_arf)(end, x, FIRST_PREC);
  double d = arf_get_d(end, lower ? ARF_RND_FLOOR : ARF_RND_CEIL);
  if (d == 0) return 0;
  double unit = pow(10, floor(log10(fabs(d))) - 2);
  return (lower ? floor(d / unit) : ceil(d / unit)) * unit;
}

/* Is every number of the orbit that is meant printed as the scene has it, or by its own digits? */
static truth orbit_prints_so(struct judge *j, const struct printed_number *const z[2], bool own_digits) {
  const struct dyn_orbit *o = scene_orbit(j->scene, j->cache);
  truth all = o ? TRUTH_TRUE : TRUTH_UNKNOWN;
  for (int i = 0; o && i < 2 + N_PHASES; i++) {
    const struct printed_number *p = i < 2 ? z[i] : scene_printed(j->scene, name_time[i - 2]);
    if (!p) continue;
    struct printed_number as_read = *p; /* borrowed */
    enum reading how;
    if (own_digits) as_read.unit = as_read.digit;
    all = truth_and(all, printed_fits(i == 0 ? o->z10 : i == 1 ? o->z20 : o->t[i - 2], &as_read, &how));
  }
  return all;
}

bool judge_closure(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  (void)view;
  const struct printed_number *z[2];
  if (!printed_start(z, j->scene) || (!scene_has_forces(j->scene) && scene_orbits(j->scene, j->cache)->n == 0)) {
    finding_skip(f, j, "the scene prints no initial state, or has neither e1 and e2 nor an orbit that has");
    return true;
  }
  struct printed_number own;
  bool owned = printed_replace(&own, &z[0], c);
  ARB_VECTOR(box, 2);
  NUMBERS(arb, gap);
  for (int i = 0; i < 2; i++) printed_ball(box + i, z[i]);
  int s = gap_over_box(gap, j, box);
  bool apart = s == SS_OK && !arb_contains_zero(gap);
  bool so = orbit_prints_so(j, z, false) == TRUTH_TRUE, by_digits = !so && orbit_prints_so(j, z, true) == TRUTH_TRUE;
  struct route_result w = {"balls", apart ? ROUTE_DIFFERS : so ? ROUTE_AGREES : ROUTE_UNDECIDED, true, 1};
  const struct dyn_orbit *meant = scene_orbit(j->scene, j->cache);
  bool breaks = meant && meant->admissible == TRUTH_FALSE;
  const char *note = NULL;
  if (s == SS_OK)
    note = result_str(j->out,
                      "for every initial state with the printed digits and %s, z_2 - z_1 changes during one passage by "
                      "an amount between %.3g and %.3g%s",
                      scene_is_example(j->scene) ? "e_1, e_2 as printed" : "the data of this scene", bound(gap, true),
                      bound(gap, false),
                      apart ? ", so that none of them is periodic"
                      : so  ? result_str(j->out,
                                         ", which contains zero, and one of them is periodic, since the numbers of the "
                                          "periodic solution that is nearest are printed so%s",
                                        breaks ? "; it is not admissible" : "")
                            : ", which cannot be told from zero; that one of them is periodic is not shown");
  finding_add_route(f, j->out, w, "model", FIRST_PREC,
                    "all initial states that the printed digits of z_10 and z_20 allow", note);
  w.trials = s == SS_OK;
  closure_by_events(f, j, z, apart);
  closure_by_times(f, j);
  /* a gap that may vanish is no proof that it does: a periodic solution that is printed so is one */
  f->verdict = verdict_of(&w, 1, true);
  if (by_digits && apart) {
    f->condition = "the numbers are read by their own digits, not with the decimals of the longest";
    f->verdict = verdict_under_condition(f->verdict, VERDICT_PROVED);
  }
  if (owned) printed_release(&own);
  return true;
}
