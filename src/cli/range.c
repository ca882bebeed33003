/* NAME=A:B, the values that one parameter runs through. */
#include <math.h>
#include <string.h>

#include "cli.h"

/* NAME=A:B in len bytes: where "=" and ":" stand. */
static int split(const char *at[2], const char *option, const char *shape, const char *text, size_t len) {
  const char *end = text + len;
  at[0] = memchr(text, '=', len);
  at[1] = at[0] ? memchr(at[0], ':', (size_t)(end - at[0])) : NULL;
  return at[1] && !memchr(at[1] + 1, ':', (size_t)(end - at[1] - 1)) ? EXIT_AS_RECORDED : usage(shape, option, text);
}

static int evaluate(struct scene_range *r, const char *const at[2], const char *end, const char *option) {
  struct diag d = {0};
  if (scene_constant(r->from, at[0] + 1, (size_t)(at[1] - at[0] - 1), option, &d) &&
      scene_constant(r->to, at[1] + 1, (size_t)(end - at[1] - 1), option, &d))
    return EXIT_AS_RECORDED;
  fprintf(stderr, "%s\n", d.message);
  return EXIT_USAGE;
}

/* The name is none of a parameter's: which may have been meant. */
static int no_parameter(const char *name, const char *option, const char *text) {
  struct suggestion meant;
  OWNED(text) says = {0};
  suggest_begin(&meant, name, strlen(name));
  for (int i = 0; i < N_SCENE_PARAMS; i++) suggest_try(&meant, scene_key_name[i]);
  suggest_print(&says, &meant);
  return usage("%s varies chi, eta, V, e1 or e2, not %.200s%s", option, text, text_str(&says));
}

int range_parse(struct scene_range *r, const char *option, const char *shape, const char *text, size_t len) {
  const char *at[2];
  OWNED(text) name = {0};
  int status = split(at, option, shape, text, len);
  if (status) return status;
  text_add_n(&name, text, (size_t)(at[0] - text));
  r->vary = word_find(text_str(&name), scene_key_name, N_SCENE_PARAMS);
  if (r->vary == N_SCENE_PARAMS) status = no_parameter(text_str(&name), option, text);
  if (!status) status = evaluate(r, at, text + len, option);
  if (status) return status;
  if (!scene_range_in_domain(r))
    return usage(r->vary == P_CHI ? "both ends of %s %.200s must lie between 0 and 1"
                                  : "both ends of %s %.200s must be positive",
                 option, text);
  return EXIT_AS_RECORDED;
}

int parse_along(struct scene_range *r, struct text *name, const struct options *o) {
  static const char along[] = "--along", shape[] = "%s takes NAME=A:B, as in e2=0.5:3, not %.200s";
  const char *text = option(o, OPT_ALONG), *at[2];
  int status = name ? split(at, along, shape, text, strlen(text)) : range_parse(r, along, shape, text, strlen(text));
  if (!status && name) {
    text_add_n(name, text, (size_t)(at[0] - text));
    status = evaluate(r, at, text + strlen(text), along);
  }
  if (!status && fmpq_cmp(r->from, r->to) == 0) return usage("the ends of --along %.200s are equal", text);
  double from = fmpq_get_d(r->from), to = fmpq_get_d(r->to);
  if (!status && !name && !(fmin(from, to) > 0 && from != to && (r->vary != P_CHI || fmax(from, to) < 1)))
    return usage("the ends of --along %.200s cannot be told apart or held in double precision", text);
  return status;
}

int range_check_friction(const struct scene_range *r, const struct scene *s, const char *option, const char *text) {
  if (scene_range_below_friction(r, s)) return EXIT_AS_RECORDED;
  return usage("%s %.200s must stay below the static friction that the scene gives", option, text);
}
