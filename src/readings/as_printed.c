/* What somebody meets who solves the paper's equations with one formula as it is printed: not that formula at the
   periodic solution, but another solution.  The six equations (12), (14), (16) and (18) are solved with the matrices of
   both texts at one set of data that has an admissible orbit. */
#include "readings_impl.h"
#include "study.h"
#include "value/names.h"
#include "value/point.h"
#include "value/printed.h"

#include <math.h>

enum { DRAWS = 200, SHOWN = 10, PRECISION = 128 };

/* For the start and the times; e_1 and e_2 are given. */
static const unsigned wanted = 1U << X_Z10 | 1U << X_Z20 | 1U << X_TA | 1U << X_TB | 1U << X_TC | 1U << X_TD;

/* The solution with these formulas next to the orbit, in balls. */
static bool solve_beside(arb_ptr x, const struct formulas *f, const struct scene *data, const struct dyn_orbit *o) {
  OWNED(system) search, proof;
  double start[N_X];
  for (int i = 0; i < N_X; i++) start[i] = arf_get_d(arb_midref(orbit_number(o, i)), ARF_RND_NEAR);
  system_init(&search, f, data, num_ctx_double());
  system_init(&proof, f, data, num_ctx_arb(PRECISION));
  bool ok = readings_newton(start, &search, EQUATIONS_OF_PAPER, wanted);
  for (int i = 0; i < N_X; i++) arb_set_d(x + i, start[i]);
  arb_set_fmpq(x + X_E1, &data->value[KEY_E1], PRECISION);
  arb_set_fmpq(x + X_E2, &data->value[KEY_E2], PRECISION);
  return ok && readings_enclose(x, &proof, EQUATIONS_OF_PAPER, wanted);
}

/* Digits to which two balls are certainly equal; 0 where they are certainly not. */
static long equal_digits(const arb_t x, const arb_t y) {
  enum { MOST = 30 };
  NUMBERS(arb, d);
  NUMBERS(mag, size);
  arb_sub(d, x, y, PRECISION);
  bool may = arb_contains_zero(d);
  arb_get_mag(size, d);
  double digits = -mag_get_d_log2_approx(size) * log10(2);
  arb_get_mag_lower(size, y);
  digits += mag_get_d_log2_approx(size) * log10(2);
  return !may ? 0 : digits > MOST ? MOST : (long)floor(digits);
}

static const char *tell(struct judge *j, arb_srcptr x, const struct dyn_orbit *o, const struct point *p) {
  OWNED(text) t = {0}, same = {0}, where = {0};
  long digits[N_X], least = PRECISION;
  int n_same = 0, n = 0, others = 0;
  for (int i = 0; i < X_E1; i++) {
    digits[i] = equal_digits(x + i, orbit_number(o, i));
    n_same += digits[i] > 0;
    if (digits[i] > 0 && digits[i] < least) least = digits[i];
  }
  for (int k = 0; k < N_SCENE_PARAMS; k++) {
    text_printf(&where, "%s%s = ", list_joint(k, N_SCENE_PARAMS, " and "), name_param[k]);
    num_print_q(&where, &p->q[Q_CHI + k]);
  }
  text_printf(
      &t,
      "For %s, where there is an admissible periodic solution, the equations (12), (14), (16) and (18) with the "
      "formula as printed give ",
      text_str(&where));
  for (int i = 0; i < X_E1; i++)
    if (digits[i] > 0)
      text_printf(&same, "%s%s", list_joint(n++, n_same, " and "), paper_name(orbit_number_name(i)).is);
    else
      text_printf(&t, "%s%s = %s instead of %s", others++ ? ", " : "", paper_name(orbit_number_name(i)).is,
                  ball_text(j, x + i, SHOWN), ball_text(j, orbit_number(o, i), SHOWN));
  if (n_same) text_printf(&t, ", and the same values of %s, to %ld digits", text_str(&same), least);
  text_add_char(&t, '.');
  return n_same < X_E1 ? result_take(j->out, &t) : NULL;
}

static const char *compare_at(struct judge *j, const struct formulas *f, const struct point *p) {
  const struct dyn_orbit *o = &point_orbits(p, j->cache, PRECISION)->orbit[p->orbit];
  struct scene data = {.word = {0}};
  for (int k = 0; k < N_SCENE_PARAMS; k++) {
    fmpq_init(&data.value[k]);
    fmpq_set(&data.value[k], &p->q[Q_CHI + k]);
  }
  ARB_VECTOR(x, N_X);
  const char *says = solve_beside(x, f, &data, o) ? tell(j, x, o, p) : NULL;
  for (int k = 0; k < N_SCENE_PARAMS; k++) fmpq_clear(&data.value[k]);
  return says;
}

const char *readings_as_printed(struct judge *j, const char *own) {
  OWNED(formulas) printed, corrected;
  bool ok = formulas_read(&printed, (struct view){j->model, LAYER_CORRECTED, own, NULL});
  ok = formulas_read(&corrected, (struct view){j->model, LAYER_CORRECTED, NULL, NULL}) && ok;
  ok = ok && !tape_same(&printed.tape, &corrected.tape);
  const char *says = NULL;
  LOCAL(point, p);
  struct sampler s;
  sampler_init(&s, "as printed", &(struct point_spec){.kind = POINT_ORBIT, .admissible = true});
  for (int i = 0; ok && !says && i < DRAWS; i++) {
    sampler_next(&p, &s);
    if (point_settle(&p, j->cache)) says = compare_at(j, &printed, &p);
  }
  return says;
}
