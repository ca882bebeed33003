/* The roots of discrepancies: several claims can fail for one cause, which is told once. */
#include "claim.h"

#include <string.h>

bool root_check(const struct claim *root, struct diag *d) {
  static const char *const known[] = {"title",   "severity",    "where",  "wrong",
                                      "correct", "consequence", "claims", "by-hand"};
  enum { N_KNOWN = sizeof known / sizeof *known, N_NEEDED = N_KNOWN - 1 };
  if (!claim_has_only(root, known, N_KNOWN, d,
                      "a root has title, severity, where, wrong, correct, consequence, by-hand and claims"))
    return false;
  for (int k = 0; k < N_NEEDED; k++) {
    const char *value = claim_get(root, known[k]);
    if (!value || !*value) return claim_mistake(root, known[k], d, "a root has the attribute %s", known[k]);
  }
  return severity_parse(claim_get(root, "severity")) < N_SEVERITIES ||
         claim_mistake(root, "severity", d, "a severity is substance, remark or notation");
}

/* The root that has the claim on its list, among the first n. */
static const struct claim *root_of(const struct claims *roots, size_t n, const char *id) {
  for (size_t i = 0; i < n; i++)
    if (claim_lists(&roots->claim[i], "claims", id)) return &roots->claim[i];
  return NULL;
}

static bool check_names(const struct claims *roots, size_t i, const struct claims *claims, struct diag *d) {
  const struct claim *root = &roots->claim[i];
  char name[64];
  for (const char *p = claim_get(root, "claims"); p && (p = claim_next_item(name, sizeof name, p)) != NULL;) {
    const struct claim *before = root_of(roots, i, name), *c = claim_named(claims, name);
    if (before) return claim_mistake(root, "claims", d, "%s stands at the root %s already", name, before->id);
    if (!c) return claim_mistake(root, "claims", d, "there is no claim %s", name);
    const char *record = claim_get(c, "record");
    if (record && !verdict_fails(verdict_parse(record)))
      return claim_mistake(root, "claims", d, "%s is on record as %s", name, record);
  }
  return true;
}

bool roots_keep_rules(const struct claims *claims, const struct claims *roots, struct diag *d) {
  enum severity last = SEVERITY_SUBSTANCE;
  for (size_t i = 0; i < roots->n; i++) {
    const struct claim *root = &roots->claim[i];
    if (!root_check(root, d) || !check_names(roots, i, claims, d)) return false;
    enum severity mine = severity_parse(claim_get(root, "severity"));
    if (mine < last) return claim_mistake(root, "severity", d, "those of more consequence stand before it");
    last = mine;
  }
  for (size_t i = 0; i < claims->n; i++) {
    const struct claim *c = &claims->claim[i];
    const char *record = claim_get(c, "record");
    if (record && verdict_fails(verdict_parse(record)) && !root_of(roots, roots->n, c->id))
      return claim_mistake(c, "record", d, "no root of the file of roots names this claim");
  }
  return true;
}

/* --- Of a result --- */

static const char *text_of(struct audit_result *out, const struct claim *root, const char *key) {
  return result_copy(out, claim_get(root, key));
}

/* In the order of the root's own list. */
static void add_claim(struct root_cause *r, struct audit_result *out, const char *id) {
  for (size_t i = 0; i < out->n_findings; i++) {
    struct finding *f = &out->findings[i];
    if (!f->root || strcmp(f->id, id) != 0) continue;
    f->root = r->id;
    f->severity = r->severity;
    r->claims[r->n_claims++] = f->id;
  }
}

static void add_root(struct audit_result *out, const struct claim *root) {
  out->roots = ss_grow(out->roots, out->n_roots, &out->cap_roots, sizeof *out->roots);
  struct root_cause *r = &out->roots[out->n_roots++];
  *r = (struct root_cause){.id = result_copy(out, root->id),
                           .title = text_of(out, root, "title"),
                           .severity = severity_parse(claim_get(root, "severity")),
                           .where = text_of(out, root, "where"),
                           .wrong = text_of(out, root, "wrong"),
                           .correct = text_of(out, root, "correct"),
                           .consequence = text_of(out, root, "consequence"),
                           .by_hand = text_of(out, root, "by-hand")};
  r->claims = arena_alloc(&out->arena, out->n_findings * sizeof *r->claims);
  char name[64];
  for (const char *list = claim_get(root, "claims"); list && (list = claim_next_item(name, sizeof name, list)) != NULL;)
    add_claim(r, out, name);
  out->n_roots -= r->n_claims == 0;
}

void roots_attach(struct audit_result *out, const struct claims *statements, const struct claims *roots) {
  for (size_t i = 0; i < out->n_findings; i++) {
    struct finding *f = &out->findings[i];
    f->of = !statements || statements_claim(statements, f->id) ? OF_PAPER : OF_SUITE;
    const struct claim *root = roots && verdict_fails(f->verdict) ? root_of(roots, roots->n, f->id) : NULL;
    f->root = root ? root->id : NULL;
    f->severity = N_SEVERITIES;
  }
  for (size_t i = 0; roots && i < roots->n; i++) add_root(out, &roots->claim[i]);
}
