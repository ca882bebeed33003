/* What can be said against claims and controls before anything is judged: attributes that nothing reads, kinds and
   verdicts that there are not, and what is missing. */
#include <string.h>

#include "claim.h"

/* What claims of each kind have; the first row, what all have; the last, what controls may have besides. */
static const struct {
  const char *kind, *attributes;
} read_by[] = {
    {"", "equation section own kind title quote place depends-on about few record record-scene correction restricted"},
    {"definition", "value statement"},
    {"matrix", "value points routes oracle perturbation"},
    {"identity", "statement points routes oracle perturbation"},
    {"sharp", "statement points perturbation"},
    {"inequality", "statement points routes"},
    {"index-range", "statement letter range repaired-range"},
    {"number", "number from formula relation also-printed"},
    {"closure", ""},
    {"criterion", "statement at side"},
    {"behaviour", "check moves states range transition limit jumps friction at vary systems"},
    {"report", "formula"},
    {"argument", "statement premises conclusion over friction increasing repair converse converse-of"},
    {"notation", "reads repaired repaired-as symbols stands-for found-in"},
    {"scaling", "statement scaled repaired repaired-as"},
    {"reach", "statements absent"},
    {"rank", "statement unknowns rank"},
    {"defined", "statements over at vary"},
    {"sequence", "word conditions"},
    {"existence", "given through"},
    {"constraints", "constraints least-first least-second"},
    {"solutions", "statement count every until kept constraints at"},
    {"range", "premises conclusion even odd factor frequency drift rate from"},
    {"law", "mass slips sticks breaks heading limits"},
    {"outside", "needs"},
    {NULL, "claim of near shift"},
};
enum { N_READ_BY = sizeof read_by / sizeof *read_by };

/* kind: that of the claim; NULL: any, a control's too. */
static bool is_read(const char *attribute, const char *kind) {
  size_t n;
  for (size_t i = 0; i < N_READ_BY; i++) {
    const char *of = read_by[i].kind, *list = read_by[i].attributes;
    if (kind && (!of || (*of && strcmp(of, kind) != 0))) continue;
    for (const char *p = list_item(&n, list); p; p = list_item(&n, p + n))
      if (strlen(attribute) == n && strncmp(p, attribute, n) == 0) return true;
  }
  return false;
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
    if (!is_read(f->key_name, NULL)) return complain(c, f->key.begin, d, "unknown attribute");
  }
  if (control) return claim_get(c, "claim") || claim_mistake(c, "", d, "a control names the claim that it damages");
  if (!kind) return claim_mistake(c, "", d, "a claim has a kind and a title, or the attributes that make one");
  if (!claim_kind_of(c)) return claim_mistake(c, "kind", d, "unknown kind of claim");
  for (size_t k = 0; k < c->record->n_fields; k++) {
    const char *name = c->record->fields[k].key_name;
    if (!is_read(name, kind)) return claim_mistake(c, name, d, "a claim of kind %s has no such attribute", kind);
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
