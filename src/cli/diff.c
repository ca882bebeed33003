/* stickslip diff: what changed between two audits, for people or as JSON.  Claims are told apart by their ids; whatever
   else the two documents hold is compared member by member, so that "no change" means none but of the order of
   claims. */
#include <stdlib.h>
#include <string.h>

#include "base/json.h"
#include "cli.h"
#include "report/audit_shape.h"

struct audit_file {
  struct source source;
  struct arena arena;
  struct json_value root;
  const struct json_value **claim; /* in the file's order */
  const struct json_value **by_id;
  size_t n;
};

static const char *id_of(const struct json_value *claim) {
  return json_text(claim, "id");
}

static int compare_ids(const void *a, const void *b) {
  return strcmp(id_of(*(const struct json_value *const *)a), id_of(*(const struct json_value *const *)b));
}

static int compare_to_id(const void *id, const void *claim) {
  return strcmp(id, id_of(*(const struct json_value *const *)claim));
}

static const struct json_value *find_claim(const struct audit_file *f, const char *id) {
  const struct json_value *const *found = bsearch(id, f->by_id, f->n, sizeof *f->by_id, compare_to_id);
  return found ? *found : NULL;
}

/* The members that count verdicts: of the paper's statements, and of the suite's checks. */
enum { N_COUNTS = 2 };
static const struct { const char *member, *before; } counts[N_COUNTS] = {{"summary", ""}, {"checks", "checks "}};

/* --- Reading --- */

static bool not_an_audit(const struct audit_file *f, struct diag *d, const char *why) {
  return diag_set(d, "%s: error: not an audit.json of stickslip verify: %s", f->source.name, why);
}

static bool read_counts(const struct audit_file *f, const char *member, struct diag *d) {
  const struct json_value *of = json_member(&f->root, member);
  char why[32];
  snprintf(why, sizeof why, "no %s", member);
  if (!of || of->kind != JSON_KIND_OBJECT) return not_an_audit(f, d, why);
  for (const struct json_value *m = of->first; m; m = m->next)
    if (m->kind != JSON_KIND_NUMBER) return not_an_audit(f, d, "a count that is not a number");
  return true;
}

static bool read_claims(struct audit_file *f, const struct json_value *claims, struct diag *d) {
  f->claim = ss_malloc(claims->n * sizeof *f->claim);
  f->by_id = ss_malloc(claims->n * sizeof *f->by_id);
  for (const struct json_value *c = claims->first; c; c = c->next) {
    if (!id_of(c) || !json_text(c, "verdict")) return not_an_audit(f, d, "a claim without id or verdict");
    f->claim[f->n] = f->by_id[f->n] = c;
    f->n++;
  }
  qsort(f->by_id, f->n, sizeof *f->by_id, compare_ids);
  for (size_t i = 1; i < f->n; i++)
    if (compare_ids(&f->by_id[i - 1], &f->by_id[i]) == 0) return not_an_audit(f, d, "two claims with one id");
  return true;
}

static bool audit_file_read(struct audit_file *f, const char *path, struct diag *d) {
  *f = (struct audit_file){.n = 0};
  if (!source_read(&f->source, path, LARGEST_AUDIT, d) || !json_parse(&f->root, &f->arena, &f->source, d)) return false;
  const struct json_value *claims = json_member(&f->root, "claims");
  if (!json_says(&f->root, "schema", AUDIT_SCHEMA)) return not_an_audit(f, d, "no schema " AUDIT_SCHEMA);
  for (int i = 0; i < N_COUNTS; i++)
    if (!read_counts(f, counts[i].member, d)) return false;
  if (!claims || claims->kind != JSON_KIND_ARRAY) return not_an_audit(f, d, "no claims");
  return read_claims(f, claims, d);
}

static void audit_file_clear(struct audit_file *f) {
  free(f->claim);
  free(f->by_id);
  arena_clear(&f->arena);
  source_clear(&f->source);
}

/* --- What differs: told as it is found, in the order of the second file --- */

struct teller {
  bool any;
  struct json *json; /* NULL: lines for people */
};

static void print_name(const char *s) {
  for (; *s; s++) putchar((unsigned char)*s < ' ' || *s == 0x7F ? '?' : *s);
}

static void print_change(const char *kind, const char *name, const char *a, const char *b) {
  printf("%-8s ", kind);
  print_name(name);
  fputs(": ", stdout);
  if (a) print_name(a);
  if (a && b) fputs(" -> ", stdout);
  if (b) print_name(b);
  putchar('\n');
}

/* A count or the verdict of a claim in both files; NULL in one that has not the claim. */
static void tell_change(struct teller *l, bool claim, const char *name, const char *a, const char *b) {
  l->any = true;
  if (!l->json) {
    print_change(!a ? "added" : !b ? "removed" : claim ? "verdict" : "count", name, a, b);
    return;
  }
  JSON_OBJECT(l->json, NULL);
  json_string(l->json, claim ? "claim" : "count", name);
  json_string(l->json, "first", a);
  json_string(l->json, "second", b);
}

/* That a member of a claim, or with NULL of the document, has another value. */
static void tell_member(struct teller *l, const char *id, const char *name) {
  l->any = true;
  if (!l->json) {
    print_change("changed", id ? id : name, id ? name : "another value", NULL);
    return;
  }
  JSON_OBJECT(l->json, NULL);
  json_string(l->json, "claim", id);
  json_string(l->json, "member", name);
}

static void each_member(struct teller *l, const char *id, const struct json_value *a, const struct json_value *b,
                        const char *const *but) {
  for (int second = 0; second < 2; second++)
    for (const struct json_value *m = (second ? b : a)->first; m; m = m->next) {
      const struct json_value *other = json_member(second ? a : b, m->key);
      bool passed = (second && other) || (other && json_same(m, other));
      for (int k = 0; but[k]; k++) passed = passed || strcmp(but[k], m->key) == 0;
      if (!passed) tell_member(l, id, m->key);
    }
}

/* The counts of summary or checks, called by their names with what stands before them. */
static void each_count(struct teller *l, const struct audit_file *a, const struct audit_file *b, int part) {
  const struct json_value *x = json_member(&a->root, counts[part].member),
                          *y = json_member(&b->root, counts[part].member);
  for (int second = 0; second < 2; second++)
    for (const struct json_value *m = (second ? y : x)->first; m; m = m->next) {
      const struct json_value *other = json_member(second ? x : y, m->key);
      if ((second && other) || (other && json_same(m, other))) continue;
      char name[64];
      snprintf(name, sizeof name, "%s%.40s", counts[part].before, m->key);
      tell_change(l, false, name, second ? "0" : m->text, second ? m->text : other ? other->text : "0");
    }
}

static void each_verdict(struct teller *l, const struct audit_file *a, const struct audit_file *b) {
  for (size_t i = 0; i < b->n; i++) {
    const struct json_value *was = find_claim(a, id_of(b->claim[i]));
    const char *before = was ? json_text(was, "verdict") : NULL, *after = json_text(b->claim[i], "verdict");
    if (before && strcmp(before, after) == 0) continue;
    tell_change(l, true, id_of(b->claim[i]), before, after);
  }
  for (size_t i = 0; i < a->n; i++) {
    if (!find_claim(b, id_of(a->claim[i])))
      tell_change(l, true, id_of(a->claim[i]), json_text(a->claim[i], "verdict"), NULL);
  }
}

static void each_other(struct teller *l, const struct audit_file *a, const struct audit_file *b) {
  static const char *const told[] = {"summary", "checks", "claims", NULL}, *const verdict[] = {"verdict", NULL};
  for (size_t i = 0; i < b->n; i++) {
    const struct json_value *was = find_claim(a, id_of(b->claim[i]));
    if (was) each_member(l, id_of(b->claim[i]), was, b->claim[i], verdict);
  }
  each_member(l, NULL, &a->root, &b->root, told);
}

/* --- The command --- */

static bool print_diff(const struct audit_file *a, const struct audit_file *b) {
  struct teller l = {.any = false};
  for (int i = 0; i < N_COUNTS; i++) each_count(&l, a, b, i);
  each_verdict(&l, a, b);
  each_other(&l, a, b);
  if (!l.any) puts("no change");
  return l.any;
}

static bool print_json(const struct audit_file *a, const struct audit_file *b) {
  struct text out = {0};
  struct json j = json_document(&out, "stickslip-diff-1");
  struct teller l = {.json = &j};
  json_string(&j, "first", a->source.name);
  json_string(&j, "second", b->source.name);
  JSON_EACH (&j, "counts", i, N_COUNTS) each_count(&l, a, b, i);
  json_array(&j, "verdicts");
  each_verdict(&l, a, b);
  json_end_array(&j);
  json_array(&j, "members");
  each_other(&l, a, b);
  json_end_array(&j);
  json_bool(&j, "changed", l.any);
  json_end_object(&j);
  print_text(&out);
  return l.any;
}

int run_diff(const struct options *o, const char *data, struct diag *d) {
  (void)data;
  OWNED(audit_file) a, b = {.n = 0};
  bool both = audit_file_read(&a, o->operands.word[0], d) && audit_file_read(&b, o->operands.word[1], d);
  bool differ = both && (option(o, OPT_JSON) ? print_json : print_diff)(&a, &b);
  return differ ? EXIT_DIFFERS : EXIT_AS_RECORDED;
}
