/* Printed decimals: the quantity on the nearest orbit, what other readings of the data would give, and what the other
   printed numbers give. */
#include <string.h>

#include "base/work.h"
#include "certificate.h"
#include "num/calc.h"
#include "stability/precision.h"
#include "value/expression.h"
#include "value/solved.h"
#include "value/title.h"

enum { DIGITS_SHOWN = 8, BITS_SHOWN = 27 };

/* |x - printed|/unit, to three digits. */
static const char *units_off(struct judge *j, const arb_t x, const struct printed_number *p) {
  OWNED(calc) c = calc_begin(num_ctx_arb(LAST_PREC));
  val off = calc_abs(&c, calc_sub(&c, x, calc_q(&c, &p->value)));
  return ball_text(j, calc_div(&c, off, calc_q(&c, &p->unit)), 3);
}

struct number_job {
  struct judge *j;
  struct view view;
  const struct printed_number *p;
  const char *formula, *section, *relation;
};

/* To the digits that are shown, and well enough to say whether it prints so. */
static bool known_well(const arb_t x, const struct printed_number *p) {
  enum reading how;
  return arb_rel_accuracy_bits(x) >= BITS_SHOWN && printed_fits(x, p, &how) != TRUTH_UNKNOWN;
}

/* *bits becomes the precision that it took, if that is more. */
static int number_at(arb_t x, slong *bits, const struct number_job *n, const struct point *p) {
  OWNED(expression) e;
  ARB_VECTOR(v, EXPRESSION_MOST);
  int s = SS_UNABLE;
  if (expression_open(&e, n->view, n->formula, n->section, n->j->d)) {
    slong first = precision_planned(&e.tape, p, BITS_SHOWN, FIRST_PREC, n->j->cache);
    first = FLINT_MIN(FLINT_MAX(first, FIRST_PREC), LAST_PREC);
    for (slong prec = first; prec <= LAST_PREC; prec *= 2) {
      s = expression_value(v, &e, p, prec, n->j->cache);
      *bits = FLINT_MAX(*bits, prec);
      bool well = s == SS_OK && known_well(v, n->p);
      if (well || 2 * prec > LAST_PREC) work_precision_raise(LADDER_NUMBER, well && prec == first);
      if (well || (s & SS_DOMAIN)) break;
    }
  }
  arb_set(x, v);
  return s;
}

/* The quantity in units of the last decimal, rounded to nearest: proved by its enclosure. */
static void correct_number(struct finding *f, const struct number_job *n, const arb_t x) {
  NUMBERS(arb, units);
  NUMBERS(fmpz, k);
  OWNED(calc) c = calc_begin(num_ctx_arb(LAST_PREC));
  val above = calc_add(&c, calc_div(&c, x, calc_q(&c, &n->p->unit)), calc_d(&c, 0.5));
  arb_floor(units, above, LAST_PREC);
  if (arb_get_unique_fmpz(k, units)) {
    OWNED(text) digits = {0}, latex = {0};
    fmpz_mul(k, k, fmpq_numref(&n->p->unit));
    num_print_fixed(&digits, k, printed_decimals(n->p));
    name_latex(&latex, n->p->name);
    f->correction = result_str(n->j->out, "%s %s %s", paper_name(n->p->name).is, n->relation, text_str(&digits));
    f->correction_latex = result_str(n->j->out, "%s %s %s", text_str(&latex), n->relation, text_str(&digits));
    f->correction_verdict = VERDICT_PROVED;
  }
}

/* u_r1 > 0.0678, not u_r1 = 0.0678. */
static bool is_bound(const struct number_job *n) {
  return strcmp(n->relation, "=") != 0;
}

/* "2.0000" for 2 beside numbers of four decimals. */
static const char *with_all_digits(const struct number_job *n) {
  struct text t = {0};
  NUMBERS(fmpz, k);
  fmpz_divexact(k, fmpq_denref(&n->p->unit), fmpq_denref(&n->p->value));
  fmpz_mul(k, k, fmpq_numref(&n->p->value));
  num_print_fixed(&t, k, printed_decimals(n->p));
  return result_take(n->j->out, &t);
}

/* The printed number as the rule reads it: "2 (that is, 2.0000)", or "0.6784" where no digit is left out. */
static const char *as_given(const struct number_job *n) {
  bool whole = fmpq_equal(&n->p->digit, &n->p->unit);
  return whole ? n->p->decimal : result_str(n->j->out, "%s (that is, %s)", n->p->decimal, with_all_digits(n));
}

/* "of the fourth decimal"; of a number that is given to no decimals, or has an exponent, "of its last digit". */
static const char *unit_name(const struct number_job *n) {
  enum { MOST_IN_WORDS = 6 };
  slong k = printed_decimals(n->p);
  if (k == 0 || strpbrk(n->p->decimal, "eE") != NULL) return "of its last digit";
  if (k <= MOST_IN_WORDS) return result_str(n->j->out, "of the %s decimal", ordinal_word[k - 1]);
  return result_str(n->j->out, "of the last of %ld decimals", (long)k);
}

/* "t_a = ..., which is printed as 0.6784 when rounded" or "t_a = ...; the printed 0.6784 differs from this by 3 units
   of the fourth decimal". */
static void add_value(struct text *note, const struct number_job *n, const arb_t x, truth fits, enum reading how) {
  text_printf(note, "%s %s %s", paper_name(n->p->name).is, n->relation, ball_text(n->j, x, DIGITS_SHOWN));
  if (fits == TRUTH_TRUE)
    text_printf(note, ", which is printed as %s when %s", n->p->decimal, reading_name[how]);
  else
    text_printf(note, "; the printed %s differs from this by about %s units %s", as_given(n), units_off(n->j, x, n->p),
                unit_name(n));
}

/* Whether the number is right when rounded, if the printed t_b and t_c are the data and e_1 and e_2 follow from them:
   "t_b = 2 and t_c = 1.5", or NULL. */
static const char *rounded_if_given(const struct number_job *n, const struct printed_number *own) {
  const struct scene *s = n->j->scene;
  const struct printed_number *t_b = scene_printed(s, "t_b"), *t_c = scene_printed(s, "t_c");
  const char *given = NULL;
  if (!t_b || !t_c || n->p == t_b || n->p == t_c || !s->given[KEY_CHI] || !s->given[KEY_ETA] || !s->given[KEY_V])
    return NULL;
  LOCAL(point, p);
  NUMBERS(arb, x);
  p.kind = POINT_GIVEN;
  for (int k = KEY_CHI; k <= KEY_V; k++) fmpq_set(&p.q[Q_CHI + k], &s->value[k]);
  fmpq_set(&p.q[Q_TB], &t_b->value);
  fmpq_set(&p.q[Q_TC], &t_c->value);
  for (slong n_orbits = point_orbits(&p, n->j->cache, FIRST_PREC)->n; !given && p.orbit < n_orbits; p.orbit++) {
    enum reading how;
    slong bits = FIRST_PREC;
    if (number_at(x, &bits, n, &p) == SS_OK && printed_fits(x, own, &how) == TRUTH_TRUE && how == READ_ROUNDED)
      given = result_str(n->j->out, "t_b = %s and t_c = %s", t_b->decimal, t_c->decimal);
  }
  return given;
}

/* By the digits that are printed, and no others. */
static void read_by_own_digits(struct finding *f, const struct number_job *n, const arb_t x) {
  struct printed_number own = *n->p; /* borrowed */
  enum reading how;
  own.unit = own.digit;
  if (printed_fits(x, &own, &how) != TRUTH_TRUE) return;
  const char *given = how == READ_ROUNDED ? NULL : rounded_if_given(n, &own);
  f->condition = result_str(
      n->j->out, "%s is read to its own digits (%s%s%s), not as %s, with as many decimals as the other numbers",
      n->p->decimal, reading_name[how], given ? ", or rounded if e_1 and e_2 follow from " : "", given ? given : "",
      with_all_digits(n));
}

/* A bound may be rounded to the side on which it suffices: where u_r1 > 0.05323 is needed, u_r1 > 0.0533 is no
   error. */
static bool read_as_sufficient(struct finding *f, const struct number_job *n, const arb_t x) {
  bool up = *n->relation == '>', fits = false;
  OWNED(calc) c = calc_begin(num_ctx_arb(LAST_PREC));
  val beyond = up ? calc_sub(&c, calc_q(&c, &n->p->value), x) : calc_sub(&c, x, calc_q(&c, &n->p->value));
  if (is_bound(n)) fits = arb_is_positive(beyond) && arb_lt(beyond, calc_q(&c, &n->p->digit));
  if (fits)
    f->condition = result_str(n->j->out, "%s is rounded %s, so that it suffices as a bound, not to the nearest",
                              n->p->decimal, up ? "up" : "down");
  return fits;
}

/* The scene's data, the orbit, what is printed with its unit, and the value there. */
static void certify_number(struct finding *f, const struct number_job *n, const arb_t x) {
  struct judge *j = n->j;
  struct certificate *c = &f->certificate;
  certify_scene(c, j);
  certify_orbit(c, j, scene_orbit(j->scene, j->cache));
  certificate_add(c, j->out, "printed", result_copy(j->out, n->p->decimal));
  certify_exact(c, j, "unit", &n->p->unit);
  certificate_add(c, j->out, "value", ball_text(j, x, DIGITS_SHOWN));
}

static const char *unless_admissible(const struct scene *s, const struct dyn_orbit *o) {
  return orbit_admissible(NULL, s, o) == TRUTH_FALSE ? ", which is not admissible," : "";
}

/* The route that decides: the quantity on the nearest orbit, and on the others for the note. */
static struct route_result number_on_orbits(struct finding *f, const struct number_job *n) {
  struct judge *j = n->j;
  LOCAL(point, p);
  struct text note = {0};
  NUMBERS(arb, x);
  truth t = TRUTH_UNKNOWN;
  const char *where = NULL;
  slong bits = FIRST_PREC;
  if (nearest_orbit_point(&p, j->scene, j->cache) && number_at(x, &bits, n, &p) == SS_OK) {
    enum reading how;
    slong used = bits, nearest = p.orbit;
    t = printed_fits(x, n->p, &how);
    where = usual_orbit_text(j, "periodic solution");
    const struct dyn_orbits *orbits = scene_orbits(j->scene, j->cache);
    text_printf(&note, "on %s%s ", where, unless_admissible(j->scene, &orbits->orbit[nearest]));
    add_value(&note, n, x, t, how);
    if (t == TRUTH_FALSE) {
      certify_number(f, n, x);
      if (!read_as_sufficient(f, n, x)) {
        correct_number(f, n, x);
        read_by_own_digits(f, n, x);
      }
    }
    if (t == TRUTH_FALSE)
      f->effect = result_str(j->out, "the printed value is %s, the computed one %s; they differ by about %s units %s",
                             as_given(n), ball_text(j, x, DIGITS_SHOWN), units_off(j, x, n->p), unit_name(n));
    for (p.orbit = 0; p.orbit < orbits->n; p.orbit++)
      if (p.orbit != nearest && number_at(x, &bits, n, &p) == SS_OK)
        text_printf(&note, "; on another solution%s %s is %s", unless_admissible(j->scene, &orbits->orbit[p.orbit]),
                    is_bound(n) ? "the bound" : "it", ball_text(j, x, 6));
    bits = used;
  } else {
    text_add(&note, "no periodic solution was found, or the quantity could not be evaluated on it");
  }
  return finding_add_route(f, j->out, (struct route_result){"balls", outcome_of_truth(t), true, where != NULL},
                           "corrected", bits, where, result_take(j->out, &note));
}

/* Whether some reading of the printed digits of e1 and e2, where these are the data, rescues the number: the orbit at
   the corners of their box. */
static void number_rescue(struct finding *f, const struct number_job *n) {
  struct judge *j = n->j;
  const struct printed_number *pe[2] = {scene_printed(j->scene, "e1"), scene_printed(j->scene, "e2")};
  if (!pe[0] || !pe[1] || !scene_has_forces(j->scene)) return;
  struct scene at_corner = *j->scene; /* shares everything but the two values, which are restored below */
  NUMBERS(fmpq, shift);
  NUMBERS(arb, x, lo, hi);
  long found = 0, fit = 0;
  slong bits = FIRST_PREC;
  for (int corner = 0; corner < 4; corner++) {
    LOCAL(point, p);
    for (int k = 0; k < 2; k++) {
      fmpq_init(&at_corner.value[KEY_E1 + k]);
      if (corner >> k & 1)
        fmpq_set(shift, &pe[k]->unit);
      else {
        fmpq_div_2exp(shift, &pe[k]->unit, 1);
        fmpq_neg(shift, shift);
      }
      fmpq_add(&at_corner.value[KEY_E1 + k], &pe[k]->value, shift);
    }
    enum reading how;
    if (nearest_orbit_point(&p, &at_corner, j->cache) && number_at(x, &bits, n, &p) == SS_OK) {
      fit += printed_fits(x, n->p, &how) == TRUTH_TRUE;
      if (found == 0 || arf_cmp(arb_midref(x), arb_midref(lo)) < 0) arb_set(lo, x);
      if (found == 0 || arf_cmp(arb_midref(x), arb_midref(hi)) > 0) arb_set(hi, x);
      found++;
    }
    for (int k = 0; k < 2; k++) fmpq_clear(&at_corner.value[KEY_E1 + k]);
  }
  const char *note =
      !found
          ? NULL
          : result_str(
                j->out,
                "with the extreme values of e_1 and e_2 that their printed digits allow (from half a unit of the last "
                "decimal below to one unit above) %s%s takes values from %s to %s, rounded, and %s %s",
                is_bound(n) ? "the bound for " : "", paper_name(n->p->name).is, ball_text(j, lo, 6),
                ball_text(j, hi, 6), fit ? "some of them give" : "none of them gives",
                f->condition ? with_all_digits(n) : "the printed digits");
  finding_state(f, j->out, "balls", "corrected", bits, found, NULL, note);
}

enum { HALVINGS = 40 };

/* The point halfway. */
static void halfway(struct point *p, const struct point *a, const struct point *b) {
  for (int i = 0; i < N_Q; i++) {
    fmpq_add(&p->q[i], &a->q[i], &b->q[i]);
    fmpq_div_2exp(&p->q[i], &p->q[i], 1);
  }
}

/* Is there a point at which the other numbers print as they do and this one does too: at a corner, or on the line
   between those where it is least and greatest? */
static bool others_give(const struct number_job *n, enum reading how, bool own_digits) {
  struct point end[2];
  LOCAL(point, p);
  ARB_VECTOR(v, 2);
  NUMBERS(arb, x, aim);
  slong bits = FIRST_PREC;
  enum reading fits;
  for (int i = 0; i < 2; i++) point_init(&end[i]);
  bool ok =
      printed_point(&p, n->j->scene) && printed_point(&end[0], n->j->scene) && printed_point(&end[1], n->j->scene);
  for (int corner = 0; ok && corner < PRINTED_CORNERS; corner++) {
    printed_corner(&p, n->j->scene, n->p->name, how, own_digits, corner);
    ok = number_at(x, &bits, n, &p) == SS_OK;
    for (int i = 0; ok && i < 2; i++) {
      int order = arf_cmp(arb_midref(x), arb_midref(v + i));
      if (corner != 0 && (i ? order <= 0 : order >= 0)) continue;
      arb_set(v + i, x);
      printed_corner(&end[i], n->j->scene, n->p->name, how, own_digits, corner);
    }
  }
  bool found = false;
  for (int i = 0; ok && i < 2; i++) found = found || printed_fits(v + i, n->p, &fits) == TRUTH_TRUE;
  arb_set_fmpq(aim, &n->p->value, LAST_PREC);
  bool between = ok && arb_lt(v, aim) && arb_gt(v + 1, aim);
  for (int k = 0; between && !found && k < HALVINGS; k++) {
    halfway(&p, &end[0], &end[1]);
    if (number_at(x, &bits, n, &p) != SS_OK) break;
    found = printed_fits(x, n->p, &fits) == TRUTH_TRUE;
    halfway(&end[arb_lt(x, aim) ? 0 : 1], &end[0], &end[1]);
  }
  for (int i = 0; i < 2; i++) point_clear(&end[i]);
  return found;
}

/* A printed decimal stands for every value that prints so: the other numbers need not be those decimals. *own_digits:
   they are read by their own digits alone, which beside a number that a control moves by units they are not. */
static bool others_read_so(enum reading *how, bool *own_digits, const struct number_job *n) {
  bool moved = scene_printed(n->j->scene, n->p->name) != n->p;
  for (int k = 0; k < (moved ? 1 : 2) * N_READINGS; k++) {
    *how = (enum reading)(k % N_READINGS);
    *own_digits = k >= N_READINGS;
    if (others_give(n, *how, *own_digits)) return true;
  }
  return false;
}

/* Does the formula's value x at the printed numbers change with the number itself? */
static bool repeats_itself(const struct number_job *n, const arb_t x) {
  int q = printed_quantity(n->p->name);
  LOCAL(point, p);
  NUMBERS(arb, y);
  if (q < 0 || !printed_point(&p, n->j->scene)) return false;
  fmpq_add(&p.q[q], &p.q[q], &n->p->unit);
  int s = expression_number(y, n->view, n->formula, n->section, &p, FIRST_PREC, n->j->cache, n->j->d);
  return s != SS_OK || !arb_overlaps(x, y);
}

/* What the other printed numbers give through the same formula: a route that decides, or a statement beside it. */
static struct route_result number_from_printed(struct finding *f, const struct number_job *n, bool decides) {
  struct judge *j = n->j;
  LOCAL(point, p);
  struct text note = {0};
  NUMBERS(arb, x);
  enum reading how = READ_ROUNDED;
  slong bits = FIRST_PREC;
  bool have = printed_point(&p, j->scene) && number_at(x, &bits, n, &p) == SS_OK;
  if (decides && have && repeats_itself(n, x)) {
    finding_state(f, j->out, "balls", "printed numbers", bits, 0, "the printed numbers",
                  result_str(j->out, "the formula takes %s from its own printed value", paper_name(n->p->name).is));
    return (struct route_result){"balls", ROUTE_UNDECIDED, true, 1};
  }
  truth t = have ? printed_fits(x, n->p, &how) : TRUTH_UNKNOWN;
  bool own_digits = false;
  enum reading others;
  bool so = decides && t == TRUTH_FALSE && others_read_so(&others, &own_digits, n);
  if (so && !own_digits) t = TRUTH_TRUE;
  if (decides && t == TRUTH_FALSE && !so) read_by_own_digits(f, n, x);
  struct route_result w = {"balls", outcome_of_truth(t), true, have};
  if (have) {
    text_add(&note, "from the other printed numbers, taken exactly, ");
    add_value(&note, n, x, so ? TRUTH_FALSE : t, how);
    if (so)
      text_printf(&note, "; some values that are printed as these when %s%s give %s", reading_name[others],
                  own_digits ? ", each to its own digits," : "", n->p->decimal);
    if (so && own_digits)
      f->condition = result_str(j->out,
                                "the other numbers are read by their own digits (%s), not with the decimals "
                                "of the longest",
                                reading_name[others]);
    const char *where = "the printed numbers", *says = result_take(j->out, &note);
    if (decides)
      finding_add_route(f, j->out, w, "printed numbers", bits, where, says);
    else
      finding_state(f, j->out, "balls", "printed numbers", bits, 1, where, says);
  }
  return w;
}

/* Is the formula one number of a solution?  false with the verdict set, or an error. */
static bool is_number(struct finding *f, const struct number_job *n, const struct claim *c) {
  OWNED(expression) e;
  bool ok = expression_open(&e, n->view, n->formula, n->section, n->j->d);
  const char *free = ok ? expression_undetermined(&e) : NULL;
  if (ok && e.n != 1) ok = claim_error(n->j, c, "formula", "a number is needed, not a matrix");
  if (ok && free) verdict_leave_open(f, n->j->out, result_str(n->j->out, "%s is not given", free));
  return ok && !free;
}

bool judge_number(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  const char *name = claim_get(c, "number"), *from = claim_get(c, "from");
  const char *relation = claim_get(c, "relation");
  struct number_job n = {j,
                         view,
                         NULL,
                         claim_formula(&j->out->arena, j->model, c, "formula"),
                         claim_get(c, "section"),
                         relation ? relation : "="};
  n.view.layer = LAYER_CORRECTED;
  if (!name || !n.formula || !from) return claim_error(j, c, "kind", "number, formula and from are needed");
  if (relation && strcmp(relation, "<") != 0 && strcmp(relation, ">") != 0)
    return claim_error(j, c, "relation", "\"<\" or \">\", for a bound");
  if (strcmp(from, "orbit") != 0 && strcmp(from, "printed") != 0)
    return claim_error(j, c, "from", "orbit, or printed: the other printed numbers");
  n.p = scene_printed(j->scene, name);
  if (!n.p) {
    finding_skip(f, j, result_str(j->out, "the scene prints no %s", name));
    return true;
  }
  char stated = claim_formula_relation(j->model, c, "formula");
  if (stated && stated != *n.relation) {
    verdict_leave_open(
        f, j->out,
        stated == '?' ? result_str(j->out, "%s has no symbol alone on a side", claim_get(c, "formula"))
                      : result_str(j->out, "%s says another relation than %s", claim_get(c, "formula"), n.relation));
    return true;
  }
  if (!is_number(f, &n, c)) return !j->d->set;
  struct printed_number own;
  bool owned = printed_replace(&own, &n.p, c);
  OWNED(text) latex = {0};
  name_latex(&latex, name);
  f->printed = result_str(j->out, "%s %s %s", text_str(&latex), n.relation, n.p->decimal);
  bool on_orbits = strcmp(from, "orbit") == 0;
  struct route_result w = on_orbits ? number_on_orbits(f, &n) : number_from_printed(f, &n, true);
  if (on_orbits && w.outcome == ROUTE_DIFFERS) number_rescue(f, &n);
  if (on_orbits && claim_get(c, "also-printed")) number_from_printed(f, &n, false);
  f->verdict = verdict_of(&w, 1, true);
  if (f->condition) f->verdict = verdict_under_condition(f->verdict, VERDICT_PROVED);
  if (owned) printed_release(&own);
  return !j->d->set;
}
