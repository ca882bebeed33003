/* The roots of discrepancies: several claims can fail for one cause, which is told once. */
#include "claim.h"
#include "kinds.h"

#include <stdio.h>
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

/* --- What a correction cites --- */

/* A statement in the notation of the files, as TeX, without the argument t, which the paper leaves out of motions. */
static bool add_statement(struct text *out, const char *statement, struct diag *d) {
  OWNED(source) src;
  LOCAL(arena, a);
  source_from_string(&src, "repaired", statement);
  const struct stmt *s = stmt_parse(&a, &src, (struct span){0, src.len}, d);
  if (!s) return false;
  text_add_char(out, '$');
  stmt_latex_plain(out, s);
  text_add_char(out, '$');
  return true;
}

/* What the record says, in its own TeX where it has some. */
static void add_record(struct text *out, const struct statement_record *r) {
  if (*r->tex) record_quote(out, r, ", ");
  for (int k = 0; !*r->tex && k < r->n_stmts; k++) {
    text_add(out, k ? ", $" : "$");
    stmt_latex(out, r->stmts[k]);
    text_add_char(out, '$');
  }
}

/* What the claim's own file holds as its correction, where that is a formula or the range of the indices. */
static bool add_repaired(struct text *out, const struct claim *c, const char *key, struct diag *d) {
  const char *value = claim_get(c, key);
  int first, last;
  if (value && strcmp(key, "repaired") == 0 && claim_get(c, "reads")) return add_statement(out, value, d);
  if (!value || strcmp(key, "repaired-range") != 0 || sscanf(value, "%d %d", &first, &last) != 2) return false;
  text_printf(out, "$i,j=%d,\\dots,%d$", first, last);
  return true;
}

/* "err-40": the TeX of the record, of its correction where it has one; "text-free-index.repaired": the claim's. */
static bool add_cited(struct text *out, const struct model *m, const struct claims *claims, const char *cited,
                      struct diag *d) {
  const struct view corrected = {m, LAYER_CORRECTED, NULL, NULL};
  const char *key = strchr(cited, '.');
  if (!key) {
    const struct statement_record *r = view_record(&corrected, cited);
    if (r) add_record(out, r);
    return r != NULL;
  }
  char id[CLAIM_NAME];
  snprintf(id, sizeof id, "%.*s", (int)(key - cited), cited);
  const struct claim *c = claim_named(claims, id);
  return c && add_repaired(out, c, key + 1, d);
}

/* The id under which a correction of that name is known, since it replaces that record; NULL for another name. */
static const char *replaced_by(const struct model *m, const char *name) {
  for (size_t i = 0; i < m->n_records; i++)
    if (strcmp(m->records[i].record->id_name, name) == 0) return m->records[i].id;
  return NULL;
}

/* The root's correction with what it cites, in braces outside of TeX. */
static bool add_correct(struct text *out, const struct model *m, const struct claims *claims, const struct claim *root,
                        struct diag *d) {
  bool tex = false;
  for (const char *p = claim_get(root, "correct"); *p; p++) {
    tex = tex != (*p == '$');
    if (tex || *p != '{') {
      text_add_char(out, *p);
      continue;
    }
    char cited[64];
    size_t n = strcspn(++p, "}");
    snprintf(cited, sizeof cited, "%.*s", (int)n, p);
    if (!p[n] || !add_cited(out, m, claims, cited, d)) {
      const char *replaced = replaced_by(m, cited);
      return claim_mistake(root, "correct", d, "there is no {%s}, a record or a correction \"CLAIM.repaired\"%s%s%s",
                           cited, replaced ? "; that record replaces another, write {" : "", replaced ? replaced : "",
                           replaced ? "}" : "");
    }
    p += n;
  }
  return true;
}

/* The symbols of a claim's correction stand in the text in their order, each once. */
static bool shows_symbols(const struct claim *c, const char *correct) {
  const char *list = claim_get(c, "symbols") ? claim_get(c, "repaired") : NULL;
  OWNED(text) seen = {0};
  for (const char *p = list; p && *p && correct; p += strspn(p, "; ")) {
    size_t n = strcspn(p, ";");
    OWNED(text) symbol = {0};
    text_add_n(&symbol, p, n);
    if (!strstr(text_str(&seen), text_str(&symbol))) {
      correct = strstr(correct, text_str(&symbol));
      text_printf(&seen, "%s;", text_str(&symbol));
    }
    p += n;
  }
  return correct != NULL;
}

static bool cites(const struct claim *root, const char *id, const char *key) {
  char cited[80];
  snprintf(cited, sizeof cited, "{%s%s}", id, key);
  return strstr(claim_get(root, "correct"), cited) != NULL;
}

/* A correction on file is cited by the root of its claim, and not restated. */
static bool check_correct(const struct model *m, const struct claim *root, const struct claim *c, const char *correct,
                          struct diag *d) {
  for (size_t i = 0; i < m->n_records; i++) {
    const struct statement_record *r = &m->records[i];
    bool of = erratum_is_about(r, c, true) || erratum_is_about(r, c, false);
    if (of && claim_tried_at_points(c) && !cites(root, r->id, ""))
      return claim_mistake(root, "correct", d, "the correction of %s is on file, and is cited as {%s}", c->id, r->id);
  }
  bool range = claim_get(c, "repaired-range") != NULL;
  if (range || (claim_get(c, "repaired") && claim_get(c, "reads"))) {
    const char *key = range ? ".repaired-range" : ".repaired";
    return cites(root, c->id, key) ||
           claim_mistake(root, "correct", d, "the correction of %s is on file, and is cited as {%s%s}", c->id, c->id,
                         key);
  }
  return shows_symbols(c, correct) ||
         claim_mistake(root, "correct", d, "the symbols by which %s is corrected do not stand here in their order",
                       c->id);
}

/* --- What roots must keep --- */

static bool check_claims(const struct model *m, const struct claims *roots, size_t i, const struct claims *claims,
                         const char *correct, struct diag *d) {
  const struct claim *root = &roots->claim[i];
  char name[64];
  for (const char *p = claim_get(root, "claims"); (p = claim_next_item(name, sizeof name, p)) != NULL;) {
    const struct claim *before = claims_listing(roots, i, "claims", name), *c = claim_named(claims, name);
    if (before) return claim_mistake(root, "claims", d, "%s stands at the root %s already", name, before->id);
    if (!c) return claim_mistake(root, "claims", d, "there is no claim %s", name);
    const char *record = claim_get(c, "record");
    if (record && !verdict_fails(verdict_parse(record)))
      return claim_mistake(root, "claims", d, "%s is on record as %s", name, record);
    if (!check_correct(m, root, c, correct, d)) return false;
  }
  return true;
}

static bool root_keeps_rules(const struct model *m, const struct claims *roots, size_t i, const struct claims *claims,
                             struct diag *d) {
  OWNED(text) correct = {0};
  return root_check(&roots->claim[i], d) && add_correct(&correct, m, claims, &roots->claim[i], d) &&
         check_claims(m, roots, i, claims, text_str(&correct), d);
}

bool roots_keep_rules(const struct model *m, const struct claims *claims, const struct claims *roots, struct diag *d) {
  enum severity last = SEVERITY_SUBSTANCE;
  for (size_t i = 0; i < roots->n; i++) {
    const struct claim *root = &roots->claim[i];
    if (!root_keeps_rules(m, roots, i, claims, d)) return false;
    enum severity mine = severity_parse(claim_get(root, "severity"));
    if (mine < last) return claim_mistake(root, "severity", d, "those of more consequence stand before it");
    last = mine;
  }
  for (size_t i = 0; i < claims->n; i++) {
    const struct claim *c = &claims->claim[i];
    const char *record = claim_get(c, "record");
    if (record && verdict_fails(verdict_parse(record)) && !claims_listing(roots, roots->n, "claims", c->id))
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

static bool add_root(struct audit_result *out, const struct model *m, const struct claims *claims,
                     const struct claim *root, struct diag *d) {
  OWNED(text) correct = {0};
  if (!add_correct(&correct, m, claims, root, d)) return false;
  struct root_cause *r = SS_PUSH(out->roots, out->n_roots, out->cap_roots);
  *r = (struct root_cause){.id = result_copy(out, root->id),
                           .title = text_of(out, root, "title"),
                           .severity = severity_parse(claim_get(root, "severity")),
                           .where = text_of(out, root, "where"),
                           .wrong = text_of(out, root, "wrong"),
                           .correct = result_take(out, &correct),
                           .consequence = text_of(out, root, "consequence"),
                           .by_hand = text_of(out, root, "by-hand")};
  r->claims = arena_alloc(&out->arena, out->n_findings * sizeof *r->claims);
  char name[64];
  for (const char *list = claim_get(root, "claims"); (list = claim_next_item(name, sizeof name, list)) != NULL;)
    add_claim(r, out, name);
  out->n_roots -= r->n_claims == 0;
  return true;
}

/* Of other data than those of its example the paper says nothing, so that it has no error either if a claim about them
   fails. */
static bool is_of_other_data(const struct audit_result *r, const struct claims *claims, const char *id) {
  const struct claim *c = r->data ? claim_named(claims, id) : NULL;
  return c && claim_of_scene(c);
}

/* The recorded cause is that of the recorded text and verdict, with a correction that mends it; what fails otherwise
   has none on record. */
static const struct claim *cause_of(const struct finding *f, const struct model *m, const struct claims *claims,
                                    const struct claims *roots) {
  bool as_recorded = f->recorded == N_VERDICTS || f->recorded == f->verdict;
  bool altered = claim_is_altered(m, claim_named(claims, f->id));
  bool mends = !f->correction || f->correction_verdict != VERDICT_REFUTED;
  if (!roots || !verdict_fails(f->verdict) || !as_recorded || altered || !mends) return NULL;
  return claims_listing(roots, roots->n, "claims", f->id);
}

bool roots_attach(struct audit_result *out, const struct model *m, const struct claims *claims,
                  const struct claims *statements, const struct claims *roots, struct diag *d) {
  for (size_t i = 0; i < out->n_findings; i++) {
    struct finding *f = &out->findings[i];
    bool other = is_of_other_data(out, claims, f->id), asserted = !statements || statements_claim(statements, f->id);
    f->of = asserted && !other ? OF_PAPER : OF_SUITE;
    const struct claim *root = other ? NULL : cause_of(f, m, claims, roots);
    f->root = root ? root->id : NULL;
    f->severity = N_SEVERITIES;
  }
  bool ok = true;
  for (size_t i = 0; ok && roots && i < roots->n; i++) ok = add_root(out, m, claims, &roots->claim[i], d);
  return ok;
}
