/* What the table of kinds says of a claim. */
#include "kinds.h"

#include <stdio.h>
#include <string.h>

#include "checks.h"
#include "claim.h"

const struct claim_kind claim_kinds[N_KINDS] = {
#define KIND_ROW(name, word, judge, tried, asked, scene, parts, fault, controls, of_model, own_record, attributes)     \
  {word, tried, asked, scene, parts, fault, controls, of_model, own_record, attributes},
    CLAIM_KINDS(KIND_ROW)
#undef KIND_ROW
};

#define KIND_WORD(name, word, ...) " " word
const char claim_no_kind[] = "unknown kind of claim; there are" CLAIM_KINDS(KIND_WORD);
#undef KIND_WORD

enum kind claim_kind(const struct claim *c) {
  const char *word = claim_get(c, "kind");
  int i = 0;
  while (i < N_KINDS && (!word || strcmp(claim_kinds[i].word, word) != 0)) i++;
  return (enum kind)i;
}

const struct claim_kind *claim_kind_of(const struct claim *c) {
  enum kind kind = claim_kind(c);
  return kind < N_KINDS ? &claim_kinds[kind] : NULL;
}

bool claim_tried_at_points(const struct claim *c) {
  const struct claim_kind *k = claim_kind_of(c);
  return k && k->tried_at_points;
}

bool claim_judges_its_id(const struct claim *c) {
  const struct claim_kind *k = claim_kind_of(c);
  return k && k->own_record && !(list_has(k->attributes, "value") && claim_get(c, "value"));
}

#define CHECK_ROW(name, ...) {__VA_ARGS__},
const struct behaviour_check behaviour_checks[] = {BEHAVIOUR_CHECKS(CHECK_ROW)};
#undef CHECK_ROW

const struct behaviour_check *claim_check(const struct claim *c) {
  for (int i = 0; i < COUNT(behaviour_checks); i++)
    if (claim_says(c, "check", behaviour_checks[i].word)) return &behaviour_checks[i];
  return NULL;
}

bool claim_of_scene(const struct claim *c) {
  const struct claim_kind *k = claim_kind_of(c);
  const struct behaviour_check *check = claim_check(c);
  return (k && k->of_scene && !claim_get(c, "at")) || claim_says(c, "over", "scene") || (check && check->of_scene);
}

bool claim_over_admissible(const struct claim *c) {
  return !claim_get(c, "over") || claim_says(c, "over", "admissible");
}

const char *claim_points_asked(const struct claim *c) {
  const char *own = claim_get(c, "points");
  if (own) return own;
  enum kind kind = claim_kind(c);
  return kind == KIND_MATRIX ? "params 24" : kind == KIND_IDENTITY ? "arcs 12, orbits 6" : NULL;
}

const char *claim_next_points(struct asked_points *out, const char *list) {
  char item[64];
  const char *rest = claim_next_item(item, sizeof item, list);
  *out = (struct asked_points){.n = 0};
  if (!rest || sscanf(item, "%15s %15s %ld", out->word, out->phase, &out->n) == 3) return rest;
  *out->phase = '\0';
  sscanf(item, "%15s %ld", out->word, &out->n);
  return rest;
}

static bool on_orbits_alone(const struct claim *c) {
  struct asked_points first, second;
  const char *rest = claim_next_points(&first, claim_get(c, "points"));
  return rest && strcmp(first.word, "orbits") == 0 && !claim_next_points(&second, rest);
}

const char *claim_routes_asked(const struct claim *c) {
  const char *own = claim_get(c, "routes");
  if (own) return own;
  enum kind kind = claim_kind(c);
  if (kind == KIND_MATRIX) return "taylor, gsl, ode";
  if (kind != KIND_IDENTITY) return kind == KIND_SHARP ? "exponential" : NULL;
  if (!claim_get(c, "oracle")) return "exponential";
  return on_orbits_alone(c) ? "oracle, system" : "oracle";
}

enum asked claim_asked(const struct claim *c) {
  const struct claim_kind *k = claim_kind_of(c);
  return k ? k->asked : ASKED_EARLY;
}
