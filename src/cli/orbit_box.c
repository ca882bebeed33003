/* stickslip orbit on a box of parameters: enclosures that hold for every point of it, as a table or as JSON. */
#include <stdlib.h>

#include "cli.h"
#include "explore/box.h"
#include "motion/complete.h"
#include "orbit_numbers.h"

void add_end(struct text *out, const arb_struct *x, bool upper, slong digits) {
  char shown[128];
  NUMBERS(arf, end);
  MPFR_NUMBERS(128, m);
  if (upper)
    arb_get_ubound_arf(end, x, 128);
  else
    arb_get_lbound_arf(end, x, 128);
  arf_get_mpfr(m, end, upper ? MPFR_RNDU : MPFR_RNDD);
  mpfr_snprintf(shown, sizeof shown, "%.*R*g", (int)digits, upper ? MPFR_RNDU : MPFR_RNDD, m);
  text_add(out, shown);
}

/* The parameter that the i-th number of an orbit is where the scene gives it as an interval; -1 for another number. */
static int box_side(const struct scene *s, int i) {
  const fmpq *given = scene_given_number(s, i);
  for (int k = 0; k < N_SCENE_PARAMS; k++)
    if (s->interval[k] && given == &s->value[k]) return k;
  return -1;
}

void add_box_end(struct text *out, const fmpq *end, bool upper, slong digits) {
  OWNED(text) shown = {0};
  NUMBERS(fmpq, read);
  NUMBERS(arb, x);
  num_print_rational(&shown, end, digits);
  if (num_parse_decimal(read, text_str(&shown), shown.len) == SS_OK && fmpq_equal(read, end)) {
    text_add(out, text_str(&shown));
  } else {
    arb_set_fmpq(x, end, 128);
    add_end(out, x, upper, digits);
  }
}

/* An end of the i-th number: of its enclosure, or of the box itself. */
static void add_number_end(struct text *out, const struct dyn_orbit *o, int i, const struct scene *s, bool upper,
                           slong digits) {
  int k = box_side(s, i);
  if (k < 0)
    add_end(out, orbit_number(o, i), upper, digits);
  else
    add_box_end(out, upper ? &s->high[k] : &s->value[k], upper, digits);
}

static void add_middle(struct text *out, const arb_t x, slong digits) {
  NUMBERS(arb, mid);
  arb_get_mid_arb(mid, x);
  if (num_print(out, mid, digits) != SS_OK) text_add(out, "0"); /* exact: it prints */
}

static void add_number_middle(struct text *out, const struct dyn_orbit *o, int i, const struct scene *s, slong digits) {
  int k = box_side(s, i);
  if (k < 0) {
    add_middle(out, orbit_number(o, i), digits);
    return;
  }
  NUMBERS(fmpq, middle);
  fmpq_add(middle, &s->value[k], &s->high[k]);
  fmpq_div_2exp(middle, middle, 1);
  num_print_rational(out, middle, digits);
}

/* The given u_r count only where the numbers hold for the box. */
static truth box_admissible(truth u[2], const struct scene *s, const struct dyn_box_orbit *b) {
  truth t = orbit_admissible(u, s, &b->orbit);
  if (b->proved) return t;
  u[0] = u[1] = TRUTH_UNKNOWN;
  return TRUTH_UNKNOWN;
}

static void orbit_json(struct json *j, const struct dyn_box_orbit *b, const struct scene *s, slong digits) {
  const struct dyn_orbit *o = &b->orbit;
  truth u[2], admissible = box_admissible(u, s, b);
  JSON_OBJECT(j, NULL);
  orbit_numbers_json(j, o, add_number_middle, s, digits, admissible, u);
  json_bool(j, "certified", false);
  json_null(j, "radius");
  json_truth(j, "of_word", b->word);
  if (json_or_null(j, "enclosures", b->proved)) {
    JSON_OBJECT(j, "enclosures");
    for (int i = 0; i < ORBIT_NUMBERS; i++) {
      JSON_EACH (j, orbit_number_name(i), end, 2) JSON_STRING(j, NULL, add_number_end(j->out, o, i, s, end, digits));
    }
  }
  json_array(j, "changes");
  if (b->stability_changes) json_string(j, NULL, "stable");
  for (int i = 0; i < N_CONDITIONS; i++)
    if (b->changes[i]) json_string(j, NULL, dyn_condition_id[i]);
  json_end_array(j);
}

static void box_json(struct text *out, const struct dyn_box *box, const struct scene *s, slong digits) {
  OWNED(json) j = json_of_model(out, s);
  json_object(&j, "box");
  for (int k = 0; k < N_SCENE_PARAMS; k++) {
    if (!s->interval[k]) continue;
    JSON_EACH (&j, scene_key_name[k], end, 2)
      JSON_STRING(&j, NULL, add_box_end(out, end ? &s->high[k] : &s->value[k], end, digits));
  }
  json_end_object(&j);
  json_bool(&j, "complete", false);
  json_string(&j, "gap", dyn_gap_text[GAP_UNTRIED]);
  json_null(&j, "t_c_max");
  JSON_EACH (&j, "orbits", i, box->n) orbit_json(&j, &box->at[i], s, digits);
}

static void add_number_interval(struct text *out, const struct dyn_orbit *o, int i, const struct scene *s,
                                slong digits) {
  text_add_char(out, '[');
  add_number_end(out, o, i, s, false, digits);
  text_add(out, ", ");
  add_number_end(out, o, i, s, true, digits);
  text_add_char(out, ']');
}

static void orbit_text(struct text *out, const struct dyn_box_orbit *b, const struct scene *s, slong digits) {
  const struct dyn_orbit *o = &b->orbit;
  truth u[2], admissible = box_admissible(u, s, b);
  text_printf(out, "%s, ", b->stability_changes ? "stable in a part of the box" : stability_name[o->stable]);
  admissible_text(out, admissible, s);
  if (b->proved)
    text_printf(out, "; proved over the box in %ld pieces\n", (long)b->pieces);
  else
    text_printf(out, "; not proved over the box within %d pieces, its numbers at the middle\n", DYN_BOX_PIECES);
  if (b->proved && b->word != TRUTH_TRUE) text_add(out, "  perhaps not of the word all over the box\n");
  for (int i = 0; i < ORBIT_NUMBERS; i++) {
    text_printf(out, "  %-8s ", orbit_number_name(i));
    const fmpq *exact = box_side(s, i) < 0 ? scene_given_number(s, i) : NULL;
    if (exact)
      num_print_rational(out, exact, digits);
    else if (b->proved)
      add_number_interval(out, o, i, s, digits);
    else
      add_number_middle(out, o, i, s, digits);
    text_add_char(out, '\n');
  }
  for (int i = 0; i < ORBIT_CONDITIONS; i++) {
    if (orbit_breaks(o, u, i)) text_printf(out, "  breaks   %s\n", orbit_condition_name(i));
    if (i < N_CONDITIONS && b->changes[i])
      text_printf(out, "  breaks   %s in a part of the box\n", dyn_condition_id[i]);
  }
}

static void box_text(struct text *out, const struct dyn_box *box, const struct scene *s, slong digits) {
  text_printf(out, "%s: %ld orbit%s of the word D-Gamma-H-C found at the middle of the box", s->name, (long)box->n,
              plural_s(box->n));
  for (int k = 0; k < N_SCENE_PARAMS; k++) {
    if (!s->interval[k]) continue;
    text_printf(out, ", %s in [", scene_key_name[k]);
    num_print_q(out, &s->value[k]);
    text_add(out, ", ");
    num_print_q(out, &s->high[k]);
    text_add(out, "]");
  }
  text_add_char(out, '\n');
  for (slong i = 0; i < box->n; i++) {
    text_printf(out, "orbit %ld: ", (long)i + 1);
    orbit_text(out, &box->at[i], s, digits);
  }
}

int show_box(const struct options *o, const struct scene *s, slong digits) {
  fmpq high[N_SCENE_PARAMS];
  if (digits > MOST_BOX_DIGITS)
    return usage("intervals are shown with at most %d --digits, not %.200s", MOST_BOX_DIGITS, option(o, OPT_DIGITS));
  for (int k = 0; k < N_SCENE_PARAMS; k++) high[k] = s->interval[k] ? s->high[k] : s->value[k]; /* borrowed */
  OWNED(dyn_box) box;
  if (dyn_box_find(&box, s->value, high, DYN_BOX_HALVINGS) != SS_OK)
    fprintf(stderr, "%s: warning: the search at the middle of the box ran into its limits; there may be more orbits\n",
            s->path);
  struct text out = {0};
  (option(o, OPT_JSON) ? box_json : box_text)(&out, &box, s, digits);
  print_found(o, &out);
  return EXIT_AS_RECORDED;
}
