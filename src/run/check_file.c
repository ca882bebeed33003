/* stickslip check: reads a file as its suffix says and reports the first thing wrong with it. */
#include "audit.h"
#include "claim/kinds.h"
#include "value/title.h"
#include <string.h>

static bool has_suffix(const char *path, const char *suffix) {
  size_t n = strlen(path), k = strlen(suffix);
  return n > k && strcmp(path + n - k, suffix) == 0;
}

/* Each record of a file of controls is seen alone, as in an audit. */
static bool check_controls(const struct model *m, struct diag *d) {
  const struct record_file *f = m->files[m->n_files - 1];
  bool ok = true;
  for (size_t i = 1; ok && i < f->n_records; i++)
    ok = view_check((struct view){m, LAYER_CORRECTED, NULL, f->records[i].id_name}, d);
  return ok;
}

static bool add_paper(struct model *m, const char *data, struct diag *d) {
  struct text folder;
  text_init(&folder);
  text_printf(&folder, "%s/paper", data);
  bool ok = model_add_folder(m, text_str(&folder), RANK_PAPER, d);
  text_clear(&folder);
  return ok;
}

/* An equation file is read over the paper's own, so that it may use their names.  A file of controls damages one name
   several times over; its records bear ids that begin with ctl-. */
static bool check_equations(const char *path, const char *data, struct diag *d) {
  struct model m;
  model_init(&m);
  bool ok = add_paper(&m, data, d) && model_add_file(&m, path, RANK_CONTROL, d);
  const struct record_file *f = ok ? m.files[m.n_files - 1] : NULL;
  bool controls = f && f->n_records > 1 && strncmp(f->records[1].id_name, "ctl-", 4) == 0;
  if (ok && controls) ok = check_controls(&m, d);
  model_clear(&m);
  if (ok && !controls) {
    model_init(&m);
    ok = add_paper(&m, data, d) && model_add_file(&m, path, RANK_USER, d) && model_check_tex(&m, RANK_USER, d) &&
         view_check((struct view){&m, LAYER_PRINTED, NULL, NULL}, d);
    model_clear(&m);
  }
  return ok;
}

static bool known_attribute(const char *key) {
  static const char *const known[] = {
      "equation",     "section",  "own",        "kind",        "value",        "statement",    "bound",
      "points",       "routes",   "oracle",     "number",      "from",         "formula",      "fault",
      "title",        "quote",    "depends-on", "record",      "effect",       "restricted",   "claim",
      "shift",        "relation", "letter",     "range",       "perturbation", "record-scene", "repaired-range",
      "also-printed", "premises", "conclusion", "over",        "friction",     "increasing",   "repair",
      "reads",        "repaired", "symbols",    "stands-for",  "found-in",     "scaled",       "statements",
      "absent",       "unknowns", "rank",       "constraints", "least-first",  "least-second", "word",
      "conditions",   "given",    "through",    "needs",       "check",        "at",           "transition",
      "limit",        "jumps",    "side",       "vary",        "about",        "converse",     "mass",
      "slips",        "sticks",   "breaks"};
  for (size_t i = 0; i < sizeof known / sizeof *known; i++)
    if (strcmp(known[i], key) == 0) return true;
  return false;
}

static bool complain(const struct claim *c, size_t at, struct diag *d, const char *what) {
  diag_at(d, &c->file->src, at, "%s: %s", c->id, what);
  return false;
}

static bool check_title(const struct claim *c, const struct model *m, struct diag *d) {
  struct text title;
  text_init(&title);
  bool ok = claim_title(&title, m, c, d);
  text_clear(&title);
  return ok;
}

/* m: NULL for a control. */
static bool check_claim(const struct claim *c, const struct model *m, struct diag *d) {
  const char *record = claim_get(c, "record"), *kind = claim_get(c, "kind");
  size_t head = c->record->id.begin;
  for (size_t k = 0; k < c->record->n_fields; k++) {
    const struct field *f = &c->record->fields[k];
    if (!f->attribute) return complain(c, f->value.begin, d, "a claim has attributes only, \"word: text\"");
    if (!known_attribute(f->key_name)) return complain(c, f->key.begin, d, "unknown attribute");
  }
  if (!m) return claim_get(c, "claim") || complain(c, head, d, "a control names the claim that it damages");
  if (!kind) return complain(c, head, d, "a claim has a kind and a title, or the attributes that make one");
  if (!claim_kind_of(c)) return complain(c, record_field(c->record, "kind")->value.begin, d, "unknown kind of claim");
  if (record && verdict_parse(record) == N_VERDICTS)
    return complain(c, record_field(c->record, "record")->value.begin, d, "not a verdict");
  return check_title(c, m, d);
}

static bool check_result(const struct claim *c, struct diag *d) {
  static const char *const known[] = {"section", "title", "formula"};
  for (size_t k = 0; k < c->record->n_fields; k++) {
    const struct field *f = &c->record->fields[k];
    bool ok = false;
    for (size_t i = 0; f->attribute && i < sizeof known / sizeof *known; i++)
      ok = ok || strcmp(known[i], f->key_name) == 0;
    if (!ok)
      return complain(c, f->attribute ? f->key.begin : f->value.begin, d, "a result has section, title and formula");
  }
  return (claim_get(c, "title") && claim_get(c, "formula")) ||
         complain(c, c->record->id.begin, d, "a result has a title and a formula");
}

/* A file holds claims and results, or controls; its first record says which.  What claims name is the paper's. */
static bool check_claims(const char *path, const char *data, struct diag *d) {
  struct claims c = {.n = 0};
  struct source src;
  if (!source_read(&src, path, MAX_CLAIM_FILE, d)) return false;
  struct record_file f;
  bool ok = record_file_parse(&f, src, d);
  bool control = ok && f.n_records > 1 && strcmp(f.records[1].kind_name, "control") == 0;
  record_file_clear(&f);
  ok = ok && claims_add_file(&c, path, control ? "control" : "claim", d);
  struct model m;
  model_init(&m);
  ok = ok && (control || add_paper(&m, data, d));
  for (size_t i = 0; ok && i < c.n; i++) ok = check_claim(&c.claim[i], control ? NULL : &m, d);
  for (size_t i = 0; ok && i < c.n_results; i++) ok = check_result(&c.result[i], d);
  model_clear(&m);
  claims_clear(&c);
  return ok;
}

/* The claims and the quantities that a scene asks for are looked up where it asks for any. */
static bool check_asked(const struct scene *s, const char *data, struct diag *d) {
  if (!s->asked.claims.n && !s->asked.values.n) return true;
  struct model m;
  struct claims c = {.n = 0};
  model_init(&m);
  bool ok =
      claims_load_data(&c, data, "claims", "claim", d) && add_paper(&m, data, d) && scene_check_asked(s, &c, &m, d);
  model_clear(&m);
  claims_clear(&c);
  return ok;
}

static bool check_scene(const char *path, const char *data, struct diag *d) {
  struct scene s;
  bool ok = scene_load_box(&s, path, data, d) && check_asked(&s, data, d);
  scene_clear(&s);
  return ok;
}

bool audit_check_file(const char *path, const char *data, struct diag *d) {
  if (has_suffix(path, ".eq")) return check_equations(path, data, d);
  if (has_suffix(path, ".claim")) return check_claims(path, data, d);
  if (has_suffix(path, ".scene")) return check_scene(path, data, d);
  diag_set(d, "%s: error: not a kind of file that can be checked; .eq, .claim or .scene", path);
  return false;
}
