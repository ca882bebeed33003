/* Which fields are damaged, by what, and of which class that is: one table. */
#include "damages.h"

#include <stdlib.h>
#include <string.h>

#include "damages_impl.h"

enum { MOST_MAKERS = 5 };

static const struct {
  enum damage_class class;
  enum material_part part;
  enum rank rank;        /* of equations */
  const char *attribute; /* NULL: a typed line; "": the record as a whole; "*": every attribute */
  damage_fn *damage[MOST_MAKERS];
} rules[] = {
    {DAMAGE_TEX, PART_EQUATIONS, RANK_PAPER, "tex", {damage_tex, maker_bars}},
    {DAMAGE_QUOTATION, PART_CLAIMS, RANK_PAPER, "quote", {maker_digits, maker_signs, maker_bars, damage_quotation}},
    {DAMAGE_PRINTED, PART_SCENE, RANK_PAPER, "printed", {damage_number}},
    {DAMAGE_PRINTED, PART_SCENE, RANK_PAPER, NULL, {damage_number}},
    {DAMAGE_PREMISE, PART_CLAIMS, RANK_PAPER, "premises", {damage_citations, damage_order, damage_premises}},
    {DAMAGE_CONCLUSION, PART_CLAIMS, RANK_PAPER, "conclusion", {damage_citations, damage_order}},
    {DAMAGE_CONCLUSION, PART_CLAIMS, RANK_PAPER, "converse", {maker_delete}},
    {DAMAGE_POINTS, PART_CLAIMS, RANK_PAPER, "points", {damage_points, damage_phases, damage_order}},
    {DAMAGE_ROUTES, PART_CLAIMS, RANK_PAPER, "routes", {damage_routes, damage_order}},
    {DAMAGE_TOLERANCE, PART_CLAIMS, RANK_PAPER, "perturbation", {maker_delete}},
    {DAMAGE_TOLERANCE, PART_CLAIMS, RANK_PAPER, "relation", {damage_one_of, maker_delete}},
    {DAMAGE_TOLERANCE, PART_CLAIMS, RANK_PAPER, "from", {damage_one_of, maker_delete}},
    {DAMAGE_TOLERANCE, PART_CLAIMS, RANK_PAPER, "rank", {maker_digits, maker_delete}},
    {DAMAGE_TOLERANCE, PART_CLAIMS, RANK_PAPER, "count", {maker_digits, maker_delete}},
    {DAMAGE_TOLERANCE, PART_CLAIMS, RANK_PAPER, "friction", {damage_parameters, maker_delete}},
    {DAMAGE_DOMAIN, PART_CLAIMS, RANK_PAPER, "at", {damage_parameters, maker_delete}},
    {DAMAGE_DOMAIN, PART_CLAIMS, RANK_PAPER, "vary", {damage_parameters, maker_delete}},
    {DAMAGE_DOMAIN, PART_CLAIMS, RANK_PAPER, "given", {maker_digits, maker_delete}},
    {DAMAGE_DOMAIN, PART_CLAIMS, RANK_PAPER, "range", {maker_digits, maker_delete}},
    {DAMAGE_DOMAIN, PART_CLAIMS, RANK_PAPER, "over", {damage_one_of, maker_delete}},
    {DAMAGE_DOMAIN, PART_CLAIMS, RANK_PAPER, "side", {damage_one_of, maker_delete}},
    {DAMAGE_DOMAIN, PART_CLAIMS, RANK_PAPER, "transition", {damage_one_of, maker_delete}},
    {DAMAGE_DOMAIN, PART_CLAIMS, RANK_PAPER, "word", {damage_phases}},
    {DAMAGE_CORRECTION, PART_CLAIMS, RANK_PAPER, "repaired", {maker_digits, maker_signs, maker_index, maker_delete}},
    {DAMAGE_CORRECTION,
     PART_CLAIMS,
     RANK_PAPER,
     "repaired-range",
     {maker_digits, maker_signs, maker_index, maker_delete}},
    {DAMAGE_CORRECTION, PART_CLAIMS, RANK_PAPER, "repair", {damage_citations, maker_delete}},
    {DAMAGE_RESTRICTION, PART_CLAIMS, RANK_PAPER, "restricted", {maker_digits, damage_restriction, maker_delete}},
    {DAMAGE_CONTROL, PART_EQUATIONS, RANK_CONTROL, NULL, {damage_control_formula}},
    {DAMAGE_CONTROL, PART_EQUATIONS, RANK_CONTROL, "", {maker_delete}},
    {DAMAGE_CONTROL, PART_CONTROLS, RANK_PAPER, "", {maker_delete}},
    {DAMAGE_CONTROL, PART_CONTROLS, RANK_PAPER, "claim", {damage_control_claim}},
    {DAMAGE_CONTROL, PART_CONTROLS, RANK_PAPER, "*", {damage_control_line}},
    {DAMAGE_TITLE,
     PART_CLAIMS,
     RANK_PAPER,
     "title",
     {maker_digits, maker_signs, maker_index, maker_bars, damage_title}},
    {DAMAGE_ERRATUM, PART_EQUATIONS, RANK_ERRATA, "tex", {damage_tex, maker_bars}},
};
enum { N_RULES = sizeof rules / sizeof *rules };

/* --- Which --- */

static bool is_named(const struct material *m, const struct damage *d, const char *item) {
  return strcmp(d->record, item) == 0 || file_is_named(m->file[d->file].name, item) ||
         strcmp(damage_classes[d->class].words, item) == 0;
}

bool damages_any(const struct damages *d, const struct material *m, const char *item) {
  for (size_t i = 0; i < d->n; i++)
    if (is_named(m, &d->damage[i], item)) return true;
  return false;
}

static void keep_named(struct damages *out, const struct material *m, const char *const *only, int n_only) {
  size_t kept = 0;
  for (size_t i = 0; i < out->n; i++) {
    bool named = n_only == 0;
    for (int k = 0; !named && k < n_only; k++) named = is_named(m, &out->damage[i], only[k]);
    if (named) out->damage[kept++] = out->damage[i];
  }
  out->n = kept;
}

/* --- Every one --- */

static bool is_of_rule(const struct material_file *f, const struct field *field, int rule) {
  const char *attribute = rules[rule].attribute;
  enum rank rank = f->rank == RANK_USER ? RANK_PAPER : f->rank;
  if (f->part != rules[rule].part || rank != rules[rule].rank) return false;
  if (!field) return attribute && !*attribute;
  if (!field->attribute) return !attribute;
  return attribute && (strcmp(attribute, field->key_name) == 0 || strcmp(attribute, "*") == 0);
}

static void damage_by_rule(struct maker *k, int rule) {
  if (!is_of_rule(&k->m->file[k->file], k->field, rule)) return;
  for (int i = 0; i < MOST_MAKERS && rules[rule].damage[i]; i++) {
    k->excuse = NULL;
    rules[rule].damage[i](k);
  }
}

static void damage_file(struct damages *out, const struct material *m, size_t file, int rule) {
  const struct record_file *f = m->file[file].parsed;
  for (size_t i = m->file[file].part == PART_SCENE ? 0 : 1; i < f->n_records; i++) {
    const struct record *r = &f->records[i];
    struct maker k = {out, m, file, r, NULL, rules[rule].class, f->src.text, NULL};
    damage_by_rule(&k, rule);
    for (size_t n = 0; n < r->n_fields; n++) {
      k.field = &r->fields[n];
      damage_by_rule(&k, rule);
    }
  }
}

void damages_init(struct damages *out, const struct material *m, const char *const *only, int n_only) {
  *out = (struct damages){.n = 0};
  for (int rule = 0; rule < N_RULES; rule++)
    for (size_t file = 0; file < m->n; file++) damage_file(out, m, file, rule);
  keep_named(out, m, only, n_only);
}

void damages_clear(struct damages *d) {
  free(d->damage);
  arena_clear(&d->arena);
}

/* --- What makers share --- */

void maker_add(struct maker *k, size_t begin, size_t end, const char *now, size_t n, const char *rule) {
  struct damages *out = k->out;
  if (n == end - begin && memcmp(k->text + begin, now, n) == 0) return;
  *SS_PUSH(out->damage, out->n, out->cap) =
      (struct damage){.class = k->class,
                      .file = k->file,
                      .begin = begin,
                      .end = end,
                      .now = arena_strndup(&out->arena, now, n),
                      .record = k->record->id_name,
                      .attribute = k->field && k->field->attribute ? k->field->key_name : "",
                      .rule = rule,
                      .excuse = k->excuse};
}

void maker_put(struct maker *k, size_t begin, size_t end, const char *now) {
  maker_add(k, begin, end, now, strlen(now), NULL);
}

static struct span maker_lines(const struct maker *k) {
  const struct record *r = k->record;
  const struct field *f = k->field;
  size_t begin = !f ? r->kind.begin : f->attribute ? f->key.begin : f->value.begin;
  size_t end = f ? f->value.end : r->n_fields ? r->fields[r->n_fields - 1].value.end : r->id.end;
  while (begin > 0 && k->text[begin - 1] != '\n') begin--;
  end += strcspn(k->text + end, "\n");
  return (struct span){begin, k->text[end] ? end + 1 : end};
}

void maker_delete(struct maker *k) {
  struct span s = maker_lines(k);
  maker_put(k, s.begin, s.end, "");
}

void damage_text(struct text *out, const struct material *m, const struct damage *d) {
  const struct source *src = &m->file[d->file].parsed->src;
  text_add_n(out, src->text, d->begin);
  text_add(out, d->now);
  text_add_n(out, src->text + d->end, src->len - d->end);
}
