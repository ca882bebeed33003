/* What can be said against claims and controls before anything is judged: attributes that nothing reads, kinds and
   verdicts that there are not, and what is missing. */
#include "claim.h"

/* What all claims have besides what those of their kind have (kinds.h), and what controls may have. */
static const char of_all[] =
    "equation section own kind title quote place depends-on about few record correction restricted";
static const char of_controls[] = "claim of near shift";

/* kind: that of the claim; N_KINDS: any, a control's too. */
static bool is_read(const char *attribute, enum kind kind) {
  bool any = kind == N_KINDS, read = list_has(of_all, attribute) || (any && list_has(of_controls, attribute));
  for (int k = 0; k < N_KINDS; k++)
    read = read || ((any || k == (int)kind) && list_has(claim_kinds[k].attributes, attribute));
  return read;
}

static bool complain(const struct claim *c, size_t at, struct diag *d, const char *what) {
  return diag_at(d, &c->file->src, at, "%s: %s", c->id, what);
}

static bool check_claim(const struct claim *c, bool control, struct diag *d) {
  const char *record = claim_get(c, "record"), *word = claim_get(c, "kind");
  enum kind kind = claim_kind(c);
  for (size_t k = 0; k < c->record->n_fields; k++) {
    const struct field *f = &c->record->fields[k];
    if (!f->attribute) return complain(c, f->value.begin, d, "a claim has attributes only, \"word: text\"");
    if (!is_read(f->key_name, N_KINDS)) return complain(c, f->key.begin, d, "unknown attribute");
  }
  if (control) return claim_get(c, "claim") || claim_mistake(c, "", d, "a control names the claim that it damages");
  if (!word) return claim_mistake(c, "", d, "a claim has a kind and a title, or the attributes that make one");
  if (kind == N_KINDS) return claim_mistake(c, "kind", d, "%s", claim_no_kind);
  for (size_t k = 0; k < c->record->n_fields; k++) {
    const char *name = c->record->fields[k].key_name;
    if (!is_read(name, kind)) return claim_mistake(c, name, d, "a claim of kind %s has no such attribute", word);
  }
  if (record && verdict_parse(record) == N_VERDICTS) return claim_mistake(c, "record", d, "not a verdict");
  if (claim_get(c, "correction") && !claim_says(c, "correction", "unknown"))
    return claim_mistake(c, "correction", d, "only \"unknown\" can be on record: it is expected to hold");
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
