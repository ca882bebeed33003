#include "exact_json.h"

struct json json_certificate(struct text *out, const char *scene) {
  struct json j = json_document(out, NULL);
  json_string(&j, "format", "stickslip orbits, version 2");
  json_string(&j, "scene", scene);
  return j;
}

void json_link(struct json *j, int a, int b, const char *key, const fmpq *size) {
  int end[2] = {a, b};
  JSON_OBJECT(j, NULL);
  JSON_EACH (j, "between", s, 2) json_printf(j, NULL, "%d", end[s]);
  json_fraction(j, key, size);
}

void json_fraction(struct json *j, const char *key, const fmpq *x) {
  JSON_STRING(j, key, num_print_q(j->out, x));
}

void json_ball(struct json *j, const char *key, arb_srcptr x) {
  char *s = arb_dump_str(x);
  json_string(j, key, s);
  flint_free(s);
}

void json_wide_ball(struct json *j, const char *key, arb_srcptr x) {
  NUMBERS(arb, y);
  arb_set(y, x);
  mag_mul_2exp_si(arb_radref(y), arb_radref(y), 1);
  json_ball(j, key, y);
}

void json_balls(struct json *j, const char *key, arb_srcptr const *x, int n) {
  JSON_EACH (j, key, i, n) json_wide_ball(j, NULL, x[i]);
}

void json_multiplier(struct json *j, arb_srcptr re, arb_srcptr im) {
  JSON_OBJECT(j, NULL);
  json_wide_ball(j, "re", re);
  json_wide_ball(j, "im", im);
}

void json_verdicts(struct json *j, truth stable, truth admissible) {
  JSON_OBJECT(j, "verdicts");
  json_bool(j, "stable", stable == TRUTH_TRUE);
  json_bool(j, "admissible", admissible == TRUTH_TRUE);
}
