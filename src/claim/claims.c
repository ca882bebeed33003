/* Claims are records; what they mean is read where they are judged. */
#include <stdlib.h>
#include <string.h>

#include "base/suggest.h"
#include "claim.h"
#include "claims.h"
#include "model/model.h"

/* One more record at the end of a list in which ids are unique. */
static bool append(struct claim **list, size_t *n, size_t *cap, const struct record_file *f, const struct record *r,
                   struct diag *d) {
  for (size_t i = 0; i < *n; i++)
    if (strcmp((*list)[i].id, r->id_name) == 0)
      return diag_at(d, &f->src, r->id.begin, "%s %s is given twice", r->kind_name, r->id_name);
  *SS_PUSH(*list, *n, *cap) = (struct claim){.id = r->id_name, .record = r, .file = f};
  return true;
}

static bool add_source(struct claims *c, struct source src, const char *kind, struct diag *d) {
  struct record_file *f = ss_malloc(sizeof *f);
  *SS_PUSH(c->files, c->n_files, c->cap_files) = f;
  if (!record_file_parse(f, src, d)) return false;
  const struct record *top = &f->records[0];
  const char *says = strcmp(kind, "claim") == 0 ? "section" : "count"; /* the one thing said of a whole file */
  if (top->n_fields > 1 || (top->n_fields == 1 && !record_field(top, says)))
    return diag_at(d, &f->src, top->fields[0].attribute ? top->fields[0].key.begin : top->fields[0].value.begin,
                   "outside a record; begin one with \"%s ID\"", kind);
  for (size_t i = 1; i < f->n_records; i++) {
    const struct record *r = &f->records[i];
    bool result = strcmp(kind, "claim") == 0 && strcmp(r->kind_name, "result") == 0;
    if (strcmp(r->kind_name, kind) != 0 && !result)
      return diag_at(d, &f->src, r->kind.begin, "unknown record kind \"%s\"; this file holds \"%s ID\" records",
                     r->kind_name, kind);
    if (!(result ? append(&c->result, &c->n_results, &c->cap_results, f, r, d)
                 : append(&c->claim, &c->n, &c->cap, f, r, d)))
      return false;
  }
  return true;
}

bool claims_add_file(struct claims *c, const char *path, const char *kind, struct diag *d) {
  struct source src;
  return source_read(&src, path, MAX_CLAIM_FILE, d) && add_source(c, src, kind, d);
}

bool claims_add_text(struct claims *c, const char *name, const char *text, const char *kind, struct diag *d) {
  struct source src;
  source_from_string(&src, name, text);
  return add_source(c, src, kind, d);
}

bool claims_load_around(struct claims *c, const char *data, const char *folder, const char *kind, const char *path,
                        struct diag *d) {
  const char *suffix = strcmp(kind, "statement") == 0 ? ".statements" : strcmp(kind, "root") == 0 ? ".roots" : ".claim";
  LOCAL(arena, a);
  size_t n;
  FREED char **file = folder_files(&n, arena_printf(&a, "%s/%s", data, folder), suffix, &a, d);
  bool ok = n > 0;
  for (size_t i = 0; ok && i < n; i++) {
    bool here = path && strcmp(path_base(file[i]), path_base(path)) == 0;
    ok = claims_add_file(c, here ? path : file[i], kind, d);
  }
  return ok;
}

bool claims_load(struct claims *c, const char *data, const char *folder, const char *kind, struct diag *d) {
  return claims_load_around(c, data, folder, kind, NULL, d);
}

/* "as ID" in the place of a list that several claims share is that claim's list. */
static bool take_list(struct field *f, const struct record_file *of, const struct claims *c, struct diag *d) {
  bool shared = f->attribute && list_has("at constraints slips sticks breaks", f->key_name);
  if (!shared || strncmp(f->text, "as ", 3) != 0) return true;
  const struct claim *owner = claim_named(c, f->text + 3);
  const char *list = owner ? claim_get(owner, f->key_name) : NULL;
  if (!list || strncmp(list, "as ", 3) == 0)
    return diag_at(d, &of->src, f->value.begin, "no claim %s has a list of its own there", f->text + 3);
  char *taken = ss_strdup(list);
  free(f->text);
  f->text = taken;
  return true;
}

/* The first that names the claim. */
static const struct record *statement_naming(const struct claims *statements, const char *id) {
  for (size_t i = 0; i < statements->n; i++) {
    const struct claim *s = &statements->claim[i];
    if (claim_lists(s, "claims", id) || claim_lists(s, "checks", id)) return s->record;
  }
  return NULL;
}

void claims_take_words(struct claims *c, const struct claims *statements) {
  for (size_t i = 0; i < c->n; i++) c->claim[i].statement = statement_naming(statements, c->claim[i].id);
}

bool claims_complete(struct claims *c, const struct claims *statements, struct diag *d) {
  if (statements) claims_take_words(c, statements);
  for (size_t i = 0; i < c->n_files; i++)
    for (size_t k = 0; k < c->files[i]->n_records; k++)
      for (size_t n = 0; n < c->files[i]->records[k].n_fields; n++)
        if (!take_list(&c->files[i]->records[k].fields[n], c->files[i], c, d)) return false;
  return true;
}

void claims_clear(struct claims *c) {
  for (size_t i = 0; i < c->n_files; i++) {
    record_file_clear(c->files[i]);
    free(c->files[i]);
  }
  free(c->files);
  free(c->claim);
  free(c->result);
  *c = (struct claims){.n = 0};
}

const char *claim_get(const struct claim *c, const char *key) {
  const struct field *own = c->control ? record_field(c->control, key) : NULL;
  const char *v = own ? own->text : record_get(c->record, key);
  if (!v && strcmp(key, "section") == 0) return record_get(&c->file->records[0], key);
  if (!v && strcmp(key, "statement") == 0 && claim_judges_its_id(c)) return c->id;
  if (!v || strcmp(key, "quote") != 0 || strcmp(v, "statement") != 0) return v;
  return c->statement ? record_get(c->statement, key) : NULL;
}

bool claim_says(const struct claim *c, const char *key, const char *words) {
  const char *text = claim_get(c, key);
  return text && strcmp(text, words) == 0;
}

const char *claim_section(const struct claim *c) {
  const char *section = claim_get(c, "section");
  return section ? section : "";
}

const char *claim_own(const struct claim *c) {
  const char *own = claim_get(c, "own"), *equation = claim_get(c, "equation");
  return own ? own : equation ? equation : c->id;
}

bool claim_selected(const char *id, const char *item) {
  size_t n = strlen(item);
  if (n == 0 || strncmp(id, item, n) != 0) return false;
  const char *rest = id + n;
  bool numbered = item[n - 1] >= '0' && item[n - 1] <= '9';
  if (numbered && *rest >= 'a' && *rest <= 'z') rest++;
  return *rest == '\0' || *rest == '-';
}

bool claim_mistake(const struct claim *c, const char *key, struct diag *d, const char *fmt, ...) {
  const struct field *f = record_field(c->record, key);
  char what[400];
  va_list ap;
  va_start(ap, fmt);
  vsnprintf(what, sizeof what, fmt, ap);
  va_end(ap);
  return diag_at(d, &c->file->src, f ? f->value.begin : c->record->id.begin, "%s: %s", c->id, what);
}

bool claim_has_only(const struct claim *c, const char *const *known, int n, struct diag *d, const char *says) {
  for (size_t k = 0; k < c->record->n_fields; k++) {
    const struct field *f = &c->record->fields[k];
    if (f->attribute && word_find(f->key_name, known, n) < n) continue;
    return diag_at(d, &c->file->src, f->attribute ? f->key.begin : f->value.begin, "%s: %s", c->id, says);
  }
  return true;
}

bool claim_error(struct judge *j, const struct claim *c, const char *key, const char *what) {
  j->claim_at_fault = true;
  return claim_mistake(c, key, j->d, "%s", what);
}

const char *claim_next_made(struct made_claim *out, const char *list) {
  int n = 0;
  if (!list || sscanf(list, " %31[^:]: %15[a-z]: %31[a-z0-9-]%n", out->condition, out->record, out->id, &n) != 3)
    return NULL;
  return list + n + strspn(list + n, "; ");
}

bool claim_makes(const struct claim *c, const char *id) {
  struct made_claim made;
  for (const char *p = claim_get(c, "restricted"); (p = claim_next_made(&made, p)) != NULL;)
    if (strcmp(made.id, id) == 0) return true;
  return false;
}

const struct claim *claim_answering(const struct claims *claims, const char *id) {
  const struct claim *c = claim_named(claims, id);
  for (size_t i = 0; !c && i < claims->n; i++)
    if (claim_makes(&claims->claim[i], id)) c = &claims->claim[i];
  return c;
}

const struct claim *claim_named(const struct claims *claims, const char *id) {
  for (size_t i = 0; id && i < claims->n; i++)
    if (strcmp(claims->claim[i].id, id) == 0) return &claims->claim[i];
  return NULL;
}

bool claim_numbers(const struct claim *c, const struct statement_record *r) {
  return strcmp(r->record->kind_name, "define") == 0 && claim_says(c, "equation", r->equation);
}

bool claim_is_about(const struct statement_record *r, const struct claim *c) {
  if (r->rank > RANK_USER) return false;
  if (claim_get(c, "statement")) return claim_says(c, "statement", r->id);
  return claim_get(c, "value") && claim_numbers(c, r);
}

bool claim_is_altered(const struct model *m, const struct claim *c) {
  const struct model unnoted = model_unnoted(m);
  const struct view v = {&unnoted, LAYER_PRINTED, NULL, NULL};
  bool altered = false;
  for (size_t i = 0; c && i < m->n_records; i++) {
    const struct statement_record *r = &m->records[i];
    for (int k = 0; claim_is_about(r, c) && k < r->n_stmts; k++) {
      bool relation = r->stmts[k]->kind == STMT_RELATION;
      enum rank seen = relation ? view_record(&v, r->id)->rank : view_stated(&v, r, r->stmts[k]).rank;
      altered = altered || seen == RANK_USER;
    }
  }
  return altered;
}

int claim_formulas(struct text *out, const struct model *m, const struct claim *c, const char *prefix) {
  const struct model unnoted = model_unnoted(m);
  struct view v = claim_view(&unnoted, c);
  int n = 0;
  for (size_t i = 0; i < m->n_records; i++) {
    const struct statement_record *r = &m->records[i];
    const struct statement_record *seen = claim_is_about(r, c) ? view_record(&v, r->id) : NULL;
    if (seen != r && seen && claim_is_about(seen, c)) continue; /* it comes itself */
    for (int k = 0; seen && k < seen->n_stmts; k++, n++) {
      text_add(out, prefix);
      stmt_print(out, view_stated(&v, seen, seen->stmts[k]).stmt);
      text_add_char(out, '\n');
    }
  }
  return n;
}

struct view claim_view(const struct model *m, const struct claim *c) {
  return (struct view){m, LAYER_CORRECTED, claim_own(c), NULL};
}

static bool selects(const char *item, const struct claim *c) {
  return claim_selected(c->id, item) || claim_makes(c, item);
}

bool claims_selects(const char *const *only, int n_only, const struct claim *c) {
  if (n_only == 0) return true;
  for (int i = 0; i < n_only; i++)
    if (selects(only[i], c)) return true;
  return false;
}

bool claims_unknown(const struct claims *claims, const char *id, struct diag *d) {
  struct suggestion meant;
  OWNED(text) says = {0};
  suggest_begin(&meant, id, strlen(id));
  for (size_t i = 0; i < claims->n; i++) suggest_try(&meant, claims->claim[i].id);
  suggest_print(&says, &meant);
  return diag_set(d, "error: no claim is named %.200s%s; \"stickslip list\" names them all", id, text_str(&says));
}

bool claims_check_selection(const struct claims *claims, const char *const *only, int n_only, struct diag *d) {
  for (int i = 0; i < n_only; i++) {
    bool any = false;
    for (size_t k = 0; k < claims->n; k++) any = any || selects(only[i], &claims->claim[k]);
    if (!any) return claims_unknown(claims, only[i], d);
  }
  return true;
}

int claim_names_listed(char (*names)[CLAIM_NAME], int max, const char *list) {
  int n = 0;
  size_t len;
  for (const char *p = list_item(&len, list); p && n < max; p = list_item(&len, p + len))
    snprintf(names[n++], CLAIM_NAME, "%.*s", (int)(len < CLAIM_NAME ? len : CLAIM_NAME - 1), p);
  return n;
}

const char *claim_next_item(char *buf, size_t size, const char *list) {
  if (list) list += strspn(list, " ,");
  if (!list || !*list) return NULL;
  size_t n = strcspn(list, ",");
  size_t len = n;
  while (len && list[len - 1] == ' ') len--;
  if (len >= size) len = size - 1;
  memcpy(buf, list, len);
  buf[len] = '\0';
  return list + n;
}

const struct claim *claims_listing(const struct claims *claims, size_t n, const char *key, const char *id) {
  for (size_t i = 0; i < n; i++)
    if (claim_lists(&claims->claim[i], key, id)) return &claims->claim[i];
  return NULL;
}

bool claim_lists(const struct claim *c, const char *key, const char *item) {
  char name[64];
  for (const char *p = claim_get(c, key); (p = claim_next_item(name, sizeof name, p)) != NULL;)
    if (strcmp(name, item) == 0) return true;
  return false;
}
