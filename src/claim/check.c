/* What can be said against claims and controls before anything is judged: attributes that nothing reads, kinds and
   verdicts that there are not, and what is missing. */
#include "claim.h"

static bool known_attribute(const char *key) {
  static const char *const known[] = {"equation",     "section",    "own",          "kind",         "value",
                                      "statement",    "points",     "routes",       "oracle",       "number",
                                      "from",         "formula",    "title",        "quote",        "depends-on",
                                      "record",       "restricted", "claim",        "shift",        "relation",
                                      "letter",       "range",      "perturbation", "record-scene", "repaired-range",
                                      "also-printed", "premises",   "conclusion",   "over",         "friction",
                                      "increasing",   "repair",     "reads",        "repaired",     "symbols",
                                      "stands-for",   "found-in",   "scaled",       "statements",   "absent",
                                      "unknowns",     "rank",       "constraints",  "least-first",  "least-second",
                                      "word",         "conditions", "given",        "through",      "needs",
                                      "check",        "moves",      "states",       "at",           "transition",
                                      "limit",        "jumps",      "side",         "vary",         "about",
                                      "converse",     "mass",       "slips",        "sticks",       "breaks",
                                      "place",        "few",        "converse-of",  "repaired-as",  "of",
                                      "near",         "heading",    "count",        "every",        "kept",
                                      "until",        "even",       "odd",          "drift",        "factor",
                                      "frequency",    "rate",       "systems",      "limits"};
  enum { N_KNOWN = sizeof known / sizeof *known };
  return word_find(key, known, N_KNOWN) < N_KNOWN;
}

static bool complain(const struct claim *c, size_t at, struct diag *d, const char *what) {
  diag_at(d, &c->file->src, at, "%s: %s", c->id, what);
  return false;
}

static bool check_claim(const struct claim *c, bool control, struct diag *d) {
  const char *record = claim_get(c, "record"), *kind = claim_get(c, "kind");
  for (size_t k = 0; k < c->record->n_fields; k++) {
    const struct field *f = &c->record->fields[k];
    if (!f->attribute) return complain(c, f->value.begin, d, "a claim has attributes only, \"word: text\"");
    if (!known_attribute(f->key_name)) return complain(c, f->key.begin, d, "unknown attribute");
  }
  if (control) return claim_get(c, "claim") || claim_mistake(c, "", d, "a control names the claim that it damages");
  if (!kind) return claim_mistake(c, "", d, "a claim has a kind and a title, or the attributes that make one");
  if (!claim_kind_of(c)) return claim_mistake(c, "kind", d, "unknown kind of claim");
  if (record && verdict_parse(record) == N_VERDICTS) return claim_mistake(c, "record", d, "not a verdict");
  return true;
}

static bool check_result(const struct claim *c, struct diag *d) {
  static const char *const known[] = {"section", "title", "formula"};
  if (!claim_has_only(c, known, 3, d, "a result has section, title and formula")) return false;
  return (claim_get(c, "title") && claim_get(c, "formula")) ||
         claim_mistake(c, "", d, "a result has a title and a formula");
}

bool claims_check(const struct claims *c, bool controls, struct diag *d) {
  bool ok = true;
  for (size_t i = 0; ok && i < c->n; i++) ok = check_claim(&c->claim[i], controls, d);
  for (size_t i = 0; ok && i < c->n_results; i++) ok = check_result(&c->result[i], d);
  return ok;
}

bool data_check(const struct audit_data *a, struct diag *d) {
  return claims_check(a->claims, false, d) && claims_check(a->controls, true, d) &&
         claims_keep_rules(a->model, a->claims, a->controls, d) &&
         (!a->statements || statements_keep_rules(a->model, a->claims, a->statements, d)) &&
         (!a->roots || roots_keep_rules(a->model, a->claims, a->roots, d));
}
