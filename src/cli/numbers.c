/* Numbers, truths and lines in parameter space as the commands print them. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "cli.h"
#include "orbit_numbers.h"
#include "value/orbits.h"

const char *const stability_name[] = {"unstable", "conditionally stable", "stability undecided"};
const char *const fate_name[] = {"unstable", "stable", "stability undecided"};
const char *const admissibility_name[] = {"not admissible", "admissible", "admissibility undecided"};

/* A whole number of which n digits are known, from `from` on: 212766240 as 2.1276624e+8, since a zero that only fills
   up would be read as a digit. */
static void show_as_power(struct text *out, size_t from, slong n) {
  size_t sign = out->data[from] == '-', figures = out->len - from - sign;
  if (figures <= (size_t)n || strspn(out->data + from + sign, "0123456789") != figures) return;
  OWNED(text) whole = {0};
  text_add(&whole, out->data + from);
  out->len = from;
  out->data[from] = '\0';
  text_printf(out, "%.*s", (int)sign + 1, whole.data);
  if (n > 1) text_printf(out, ".%.*s", (int)n - 1, whole.data + sign + 1);
  text_printf(out, "e+%zu", figures - 1);
}

/* How far rounding of the matrix can move its eigenvalues: by the size of the matrix over their distance more than the
   matrix, and where that is not small, by the root. */
static double eigenvalue_error(const double m[4], const double re[2], const double im[2]) {
  double size = hypot(hypot(m[0], m[1]), hypot(m[2], m[3])), gap = hypot(re[0] - re[1], im[0] - im[1]);
  double move = 4 * DBL_EPSILON * size * (size / gap);
  return move < gap / 8 ? move : 8 * sqrt(DBL_EPSILON) * size;
}

static void print_near(struct text *out, double x, double err) {
  NUMBERS(arb, ball);
  arb_set_d(ball, x);
  mag_set_d(arb_radref(ball), err);
  print_known(out, ball, 15);
}

void print_known(struct text *out, const arb_struct *x, slong digits) {
  slong n = digits;
  size_t from = out->len;
  while (n > 0 && num_print(out, x, n) != SS_OK) n = n > 20 ? n / 2 : n - 1;
  if (n == 0) text_add_char(out, '0');
  if (n > 0 && n < digits) show_as_power(out, from, n);
}

void json_rational(struct json *j, const char *key, const fmpq_t q, slong digits) {
  JSON_STRING(j, key, num_print_rational(j->out, q, digits));
}

void json_number(struct json *j, const char *key, const arb_struct *x, slong digits) {
  if (json_or_null(j, key, x != NULL)) JSON_STRING(j, key, print_known(j->out, x, digits));
}

void json_numbers(struct json *j, const char *key, arb_srcptr x, slong n, slong digits) {
  JSON_EACH (j, key, i, n) json_number(j, NULL, x + i, digits);
}

void print_accuracy(struct text *out, const arb_struct *worst) {
  NUMBERS(arb, up);
  arb_mul_ui(up, worst, 106, 64); /* two digits round down by less than 1/20 */
  arb_div_ui(up, up, 100, 64);
  arb_get_mid_arb(up, up);
  num_print(out, up, 2);
}

void radius_raise(mag_t radius, arb_srcptr x, slong n) {
  for (slong i = 0; i < n; i++) mag_max(radius, radius, arb_radref(x + i));
}

void print_radius(struct text *out, const mag_t radius) {
  NUMBERS(arb, x);
  arf_set_mag(arb_midref(x), radius);
  print_accuracy(out, x);
}

void proof_json(struct json *j, bool certified, const mag_t radius) {
  json_bool(j, "certified", certified);
  if (json_or_null(j, "radius", certified)) JSON_STRING(j, "radius", print_radius(j->out, radius));
}

void proof_text(struct text *out, bool certified, const mag_t radius) {
  if (!certified) {
    text_add(out, "  not certified: a condition or the stability is undecided\n");
    return;
  }
  text_add(out, "  certified; enclosed within ");
  print_radius(out, radius);
  text_add(out, ", printed rounded\n");
}

void print_at(struct text *out, const struct jacobian_request *q) {
  if (q->at_printed)
    text_add(out, "printed");
  else
    text_printf(out, "orbit:%ld", (long)q->orbit + 1);
}

void print_orbit_at(struct text *out, const struct jacobian_request *q, const struct scene *s) {
  OWNED(dyn_orbits) list;
  print_at(out, q);
  audit_orbits(&list, s, FIRST_PREC);
  audit_orbits_complete(&list, s, FIRST_PREC);
  bool broken = !q->at_printed && q->orbit < list.n && orbit_admissible(NULL, s, &list.orbit[q->orbit]) == TRUTH_FALSE;
  if (broken) text_add(out, " (not admissible)");
}

void json_at(struct json *j, const struct jacobian_request *q) {
  JSON_STRING(j, "at", print_at(j->out, q));
}

struct json json_of_model(struct text *out, const struct scene *s) {
  struct json j = json_document(out, NULL);
  json_string(&j, "scene", s->name);
  json_string(&j, "layer", "model");
  return j;
}

void along_json(struct json *j, const char *name, const fmpq_t from, const fmpq_t to, slong digits) {
  JSON_OBJECT(j, "along");
  json_string(j, "name", name);
  json_rational(j, "from", from, digits);
  json_rational(j, "to", to, digits);
}

void along_text(struct text *out, const struct scene *s, const char *name, const fmpq_t from, const fmpq_t to,
                long changes, long branches) {
  text_printf(out, "%s: %s from ", s->name, name);
  num_print_q(out, from);
  text_add(out, " to ");
  num_print_q(out, to);
  text_printf(out, ", %ld change%s on %ld branch%s of orbits found\n", changes, plural_s(changes), branches,
              branches == 1 ? "" : "es");
}

bool print_eigenvalues(struct text out[2], arb_srcptr j) {
  double m[4], re[2], im[2], err = 0;
  for (int i = 0; i < 4; i++) {
    m[i] = num_arb.get_d(j + i);
    err = fmax(err, mag_get_d(arb_radref(j + i)));
  }
  if (dyn_eigenvalues_d(re, im, m) != SS_OK) return false;
  err = eigenvalue_error(m, re, im) * fmax(1, err / (DBL_EPSILON * hypot(hypot(m[0], m[1]), hypot(m[2], m[3]))));
  for (int i = 0; i < 2; i++)
    if (!isfinite(err) || !(err < hypot(re[i], im[i]) || err < 1e-3)) return false; /* no digit is known */
  for (int i = 0; i < 2; i++) {
    print_near(&out[i], re[i], err);
    if (im[i] == 0) continue;
    if (im[i] > 0) text_add_char(&out[i], '+');
    print_near(&out[i], im[i], err);
    text_add_char(&out[i], 'i');
  }
  return true;
}

void eigenvalues_text(struct text *out, const char *of, arb_srcptr j, slong digits) {
  struct text gsl[2] = {{0}, {0}};
  ARB_VECTOR(x, 2);
  jacobian_invariants(x, x + 1, j);
  if (arb_is_zero(x + 1)) {
    text_printf(out, "eigenvalues %s0 and ", of);
    print_known(out, x, digits);
    text_add(out, " (exactly: 0 and the trace)\n");
  }
  if (print_eigenvalues(gsl, j))
    text_printf(out, "eigenvalues %s%s and %s (GSL)\n", of, text_str(&gsl[0]), text_str(&gsl[1]));
  for (int i = 0; i < 2; i++) text_clear(&gsl[i]);
}

void json_truth(struct json *j, const char *key, truth t) {
  if (json_or_null(j, key, t != TRUTH_UNKNOWN)) json_bool(j, key, t == TRUTH_TRUE);
}

void admissible_text(struct text *out, truth admissible, const struct scene *s) {
  bool u1 = s->given[KEY_U_R1], u2 = s->given[KEY_U_R2];
  text_add(out, admissibility_name[admissible]);
  if (admissible != TRUTH_TRUE || s->system || (u1 && u2)) return;
  text_printf(out, " with %s",
              u1   ? "u_r2 above its bound"
              : u2 ? "u_r1 above its bound"
                   : "u_r1, u_r2 above their bounds");
}

void orbit_numbers_json(struct json *j, const struct dyn_orbit *o, number_printer *print, const struct scene *s,
                        slong digits, truth admissible, const truth u[2]) {
  for (int i = 0; i < ORBIT_NUMBERS; i++) {
    JSON_STRING(j, orbit_number_name(i), print(j->out, o, i, s, digits));
    if (strcmp(orbit_number_name(i), "trace") != 0) continue;
    json_array(j, "eigenvalues");
    json_string(j, NULL, "0");
    JSON_STRING(j, NULL, print(j->out, o, i, s, digits));
    json_end_array(j);
    json_truth(j, "stable", o->stable);
    json_truth(j, "admissible", admissible);
    JSON_EACH (j, "violations", k, ORBIT_CONDITIONS)
      if (orbit_breaks(o, u, k)) json_string(j, NULL, orbit_condition_name(k));
  }
}
