/* NAME=A:B, the values that one parameter runs through. */
#include <string.h>

#include "cli.h"

void range_init(struct range *r) {
  fmpq_init(r->from);
  fmpq_init(r->to);
}

void range_clear(struct range *r) {
  fmpq_clear(r->from);
  fmpq_clear(r->to);
}

static bool in_domain(const fmpq_t x, int vary) {
  return fmpq_sgn(x) > 0 && (vary != P_CHI || fmpq_cmp_si(x, 1) < 0);
}

/* usage() with two texts: the option, and what was given. */
static int complain(const char *fmt, const char *option, const char *text) {
  char message[400];
  snprintf(message, sizeof message, fmt, option, text);
  return usage("%s", message);
}

int range_parse_named(struct range *r, struct text *name, const char *option, const char *shape, const char *text,
                      size_t len) {
  const char *end = text + len, *equals = memchr(text, '=', len);
  const char *colon = equals ? memchr(equals, ':', (size_t)(end - equals)) : NULL;
  if (!equals || !colon || memchr(colon + 1, ':', (size_t)(end - colon - 1))) return complain(shape, option, text);
  struct diag d;
  diag_init(&d);
  text_add_n(name, text, (size_t)(equals - text));
  if (!scene_constant(r->from, equals + 1, (size_t)(colon - equals - 1), option, &d) ||
      !scene_constant(r->to, colon + 1, (size_t)(end - colon - 1), option, &d)) {
    fprintf(stderr, "%s\n", d.message);
    return EXIT_USAGE;
  }
  return EXIT_AS_RECORDED;
}

int range_parse(struct range *r, const char *option, const char *shape, const char *text, size_t len) {
  struct text name;
  text_init(&name);
  int status = range_parse_named(r, &name, option, shape, text, len);
  r->vary = word_find(text_str(&name), scene_key_name, N_SCENE_PARAMS);
  text_clear(&name);
  if (status) return status;
  if (r->vary == N_SCENE_PARAMS) return complain("%s varies chi, eta, V, e1 or e2, not %.200s", option, text);
  if (!in_domain(r->from, r->vary) || !in_domain(r->to, r->vary))
    return complain(r->vary == P_CHI ? "both ends of %s %.200s must lie between 0 and 1"
                                     : "both ends of %s %.200s must be positive",
                    option, text);
  return EXIT_AS_RECORDED;
}

int range_check_friction(const struct range *r, const struct scene *s, const char *option, const char *text) {
  int key = r->vary == P_E1 ? KEY_U_R1 : r->vary == P_E2 ? KEY_U_R2 : -1;
  if (key < 0 || !s->given[key]) return EXIT_AS_RECORDED;
  if (fmpq_cmp(r->from, &s->value[key]) < 0 && fmpq_cmp(r->to, &s->value[key]) < 0) return EXIT_AS_RECORDED;
  return complain("%s %.200s must stay below the static friction that the scene gives", option, text);
}
