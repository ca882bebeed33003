#include "exact_json.h"

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

void json_verdicts(struct json *j, truth stable, truth admissible) {
  JSON_OBJECT(j, "verdicts");
  json_bool(j, "stable", stable == TRUTH_TRUE);
  json_bool(j, "admissible", admissible == TRUTH_TRUE);
}
