/* audit.json read back: the record that the other reports are written from, whoever wrote the file. */
#include <stdlib.h>
#include <string.h>

#include "audit_shape.h"
#include "name_list.h"
#include "report.h"

/* The names that the reports make lists and graphs of (claims, what they rest on, routes, sections): with more distinct
   ones the graph of the claims would be too large to be drawn, or looked at. */
enum { MOST_NAMES = 1500 };

static size_t count_distinct(struct names *list) {
  size_t n = 0;
  if (list->n) qsort(list->name, list->n, sizeof *list->name, word_compare);
  for (size_t i = 0; i < list->n; i++) n += i == 0 || strcmp(list->name[i - 1], list->name[i]) != 0;
  return n;
}

static void add_names_of(struct names *list, const struct finding *f) {
  names_add(list, f->id);
  if (f->section) names_add(list, f->section);
  for (int i = 0; i < f->n_depends_on; i++) names_add(list, f->depends_on[i]);
  for (int i = 0; i < f->n_evidence; i++) names_add(list, f->evidence[i].route);
}

static bool check_names(const struct audit_result *r, const struct source *s, struct diag *d) {
  struct names all = {.n = 0}, ids = {.n = 0};
  for (size_t i = 0; i < r->n_findings; i++) {
    names_add(&ids, r->findings[i].id);
    add_names_of(&all, &r->findings[i]);
  }
  for (size_t i = 0; i < r->n_consequences; i++) {
    const struct consequence *q = &r->consequences[i];
    names_add(&all, q->failure);
    for (int k = 0; k < q->falls.n; k++) names_add(&all, q->falls.id[k]);
  }
  for (size_t i = 0; i < r->n_pairs; i++) {
    names_add(&all, r->pairs[i].first);
    names_add(&all, r->pairs[i].second);
  }
  bool many = count_distinct(&all) > MOST_NAMES, twice = count_distinct(&ids) < ids.n;
  if (many) diag_set(d, "%s: error: more than %d names of claims, routes and sections", s->name, MOST_NAMES);
  if (twice) diag_set(d, "%s: error: two claims with one id", s->name);
  free(ids.name);
  free(all.name);
  return !many && !twice;
}

static bool root_lists(const struct root_cause *root, const char *id) {
  return word_find(id, root->claims, root->n_claims) < root->n_claims;
}

/* What a claim says of its root is what the root says of it. */
static bool check_roots(const struct audit_result *r, const struct source *s, struct diag *d) {
  int listed = 0, named = 0;
  bool fine = true;
  for (size_t i = 0; i < r->n_roots; i++) listed += r->roots[i].n_claims;
  for (size_t i = 0; fine && i < r->n_findings; i++) {
    const struct finding *f = &r->findings[i];
    const struct root_cause *root = f->root ? audit_result_root(r, f->root) : NULL;
    named += root != NULL;
    fine = root ? root_lists(root, f->id) && root->severity == f->severity : !f->root && f->severity == N_SEVERITIES;
  }
  if (!fine || listed != named) diag_set(d, "%s: error: the roots do not say what the claims say of them", s->name);
  return fine && listed == named;
}

bool report_read(struct audit_result *out, const struct source *s, struct diag *d) {
  struct json_value root;
  if (!json_parse(&root, &out->arena, s, d)) return false;
  if (!json_says(&root, "schema", AUDIT_SCHEMA))
    return diag_at(d, s, root.at, "not an audit.json of stickslip verify: its schema is not " AUDIT_SCHEMA);
  return shape_read(out, &out->arena, &audit_shape, &root, s, d) && check_names(out, s, d) && check_roots(out, s, d);
}
