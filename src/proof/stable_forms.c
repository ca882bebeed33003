/* The stable layer held against the corrected one, definition by definition and relation by relation.  What is proved
   is used for what follows: a form proved the same in both layers may be held as an unknown in the proofs of longer
   ones. Each proof is first tried at points, which refuse a wrong form quickly. */
#include <stdlib.h>
#include <string.h>

#include "stable_impl.h"

static const struct unknowns none;

/* Its place among those that may be held; N_HELD for another. */
static int place_held(const char *name) {
  int i = 0;
  while (i < N_HELD && strcmp(stable_held[i].name, name) != 0) i++;
  return i;
}

/* --- Attempts --- */

/* Relations are the same only if what stands between their sides is. */
static bool same_relations(const struct statement_record *a, const struct statement_record *b) {
  bool same = a->n_stmts == b->n_stmts;
  for (int k = 0; same && k < a->n_stmts; k++) {
    same = a->stmts[k]->n_sides == b->stmts[k]->n_sides && !a->stmts[k]->range_var && !b->stmts[k]->range_var;
    for (int i = 0; same && i + 1 < a->stmts[k]->n_sides; i++) same = a->stmts[k]->ops[i] == b->stmts[k]->ops[i];
  }
  return same;
}

/* What is held against what: a value of either layer or, where these are NULL, a record of either. */
struct sides {
  const char *value[2];
  const struct statement_record *record[2];
};

/* Both sides as tapes, with these quantities held as unknowns; clear r all the same. */
static bool read_sides(struct reading r[2], const char *section, const struct model *m, const struct sides *of,
                       const struct unknowns *u, struct diag *d) {
  static const enum layer layer[2] = {LAYER_CORRECTED, LAYER_STABLE};
  bool ok = true;
  for (int i = 0; i < 2; i++) reading_init(&r[i], m, layer[i], u);
  for (int i = 0; ok && i < 2; i++)
    ok = (of->value[i] ? reading_value(&r[i], of->value[i], section, d) : reading_record(&r[i], of->record[i], d)) &&
         elaboration_tape(&r[i].tape, &r[i].el, r[i].e, r[i].n, d);
  return ok;
}

static bool attempt(struct stable_proof *p, const struct model *m, const struct sides *of, const struct unknowns *u,
                    struct diag *d) {
  struct reading r[2];
  bool ok = read_sides(r, p->section, m, of, u, d) && readings_compare(p, r, m, u, d);
  for (int i = 0; i < 2; i++) reading_clear(&r[i]);
  return ok;
}

/* Sets p->why_not where points refuse the equality; of the values themselves the algebra alone may be asked. */
static bool try_points(struct stable_proof *p, const struct model *m, const struct sides *of, bool only_values,
                       struct diag *d) {
  struct reading r[2];
  bool ok = read_sides(r, p->section, m, of, &none, d);
  p->why_not = ok && readings_same_shapes(r) ? readings_refused(r, only_values) : NULL;
  for (int i = 0; i < 2; i++) reading_clear(&r[i]);
  return ok;
}

/* An unknown is known by its name alone, which then must have one meaning in all sections. */
static bool means_one_thing(const struct model *m, const char *name) {
  const struct view stable = {m, LAYER_STABLE, NULL, NULL};
  const struct definition *first = NULL;
  bool one = true;
  for (size_t i = 0; i < m->n_defs; i++) {
    const struct definition *def = &m->defs[i];
    if (strcmp(def->name, name) != 0 || !view_sees(&stable, def)) continue;
    one = one && (!first || strcmp(first->section, def->section) == 0);
    first = def;
  }
  return one;
}

static bool direct(const struct model *m) {
  const struct view corrected = {m, LAYER_CORRECTED, NULL, NULL};
  struct diag d = {0};
  bool yes = !view_lookup(&corrected, "g_1", "stability", &d);
  for (int i = 0; i < N_HELD; i++) yes = yes && means_one_thing(m, stable_held[i].name);
  for (int i = 0; yes && i < N_DIRECT; i++) {
    struct stable_proof p = {.section = "stability"};
    const char *name = stable_held[i].name;
    const struct sides of = {.value = {strcmp(name, "g_1") == 0 ? "1 - omega_1^2" : name, name}};
    yes = attempt(&p, m, &of, &none, &d) && !p.why_not;
  }
  return yes;
}

static bool is_proved(const struct stable_proofs *p, const struct stmt *stmt) {
  for (size_t i = 0; i < p->n; i++)
    if (p->item[i].stmt == stmt) return !p->item[i].why_not;
  return false;
}

/* Notes what a value is made of in the stable layer. */
static bool note_use(const struct model *noting, const char *value, const char *section) {
  OWNED(reading) r;
  struct diag d = {0};
  reading_init(&r, noting, LAYER_STABLE, &none);
  return reading_value(&r, value, section, &d);
}

static bool is_asked(const struct unknowns *u, const struct model *m, const char *name) {
  bool yes = !u->asked;
  for (size_t i = 0; !yes && i < m->n_defs; i++) yes = u->asked->def[i] && strcmp(m->defs[i].name, name) == 0;
  return yes;
}

/* Whether every definition that the stable layer has in place of a corrected one, on the way to the name, is proved. */
static bool follows(const struct stable_proofs *p, const struct model *m, const char *name, const char *section) {
  struct view corrected = {m, LAYER_CORRECTED, NULL, NULL};
  struct diag d = {0};
  OWNED(model_use) used;
  const struct model noting = model_noting(&used, m);
  bool yes = note_use(&noting, name, section);
  for (size_t i = 0; yes && i < m->n_defs; i++) {
    const struct definition *def = &m->defs[i];
    if (used.def[i] && def->rank == RANK_STABLE && view_lookup(&corrected, def->name, def->section, &d))
      yes = is_proved(p, def->stmt);
  }
  return yes;
}

/* How many of those that may be held are, for a proof of the name: none for one that is proved directly.  One that is
   not asked for is met in corrected forms at most, and what is equal whatever it is needs no proof of it. */
static int holdable(struct unknowns *u, const struct stable_proofs *p, const struct model *m, const char *name) {
  int own = place_held(name);
  if (u->usable < 0) u->usable = direct(m) ? N_DIRECT : 0;
  if (own == N_HELD)
    while (u->usable >= N_DIRECT && u->usable < N_HELD &&
           (!is_asked(u, m, stable_held[u->usable].name) || follows(p, m, stable_held[u->usable].name, "stability")))
      u->usable++;
  return own < N_DIRECT ? 0 : own < N_HELD ? FLINT_MIN(u->usable, N_DIRECT) : u->usable;
}

/* Whether the stable side meets parts. */
static bool uses_parts(bool *yes, const char *section, const struct model *m, const struct sides *of,
                       const struct unknowns *parts, struct diag *d) {
  OWNED(reading) r;
  *yes = false;
  reading_init(&r, m, LAYER_STABLE, parts);
  bool ok = (of->value[1] ? reading_value(&r, of->value[1], section, d) : reading_record(&r, of->record[1], d)) &&
            elaboration_tape(&r.tape, &r.el, r.e, r.n, d);
  for (int i = 0; ok && i < parts->n_parts; i++) *yes = *yes || tape_reads_matrix(&r.tape, parts->part[i].name);
  return ok;
}

/* Whether a function says something of t, which is a symbol too, besides what it says of its argument. */
static bool names_time(bool *yes, const char *function, const char *section, enum layer layer, const struct model *m,
                       struct diag *d) {
  OWNED(reading) r;
  OWNED(text) there = {0};
  text_printf(&there, "%.*s(%s)", (int)strcspn(function, "("), function, name_time[0]);
  reading_init(&r, m, layer, &none);
  bool ok = reading_value(&r, text_str(&there), section, d) && elaboration_tape(&r.tape, &r.el, r.e, r.n, d);
  if (ok) *yes = *yes || tape_input(&r.tape, "t") >= 0;
  return ok;
}

/* The two sides of a function are held against each other at t: enough where they know no other t. */
static bool try_argument(struct stable_proof *p, const struct model *m, const struct sides *of, struct diag *d) {
  bool yes = false, ok = true;
  if (!p->stmt || !p->stmt->param) return true;
  ok = names_time(&yes, of->value[1], p->section, LAYER_STABLE, m, d);
  if (ok && of->value[0] == of->value[1]) ok = names_time(&yes, of->value[0], p->section, LAYER_CORRECTED, m, d);
  if (yes) p->why_not = "a function depends on t besides its argument";
  return ok;
}

/* With none of those that may be held, with those proved directly, or with all; what is made of parts is mostly equal
   whatever these are, and large where they are put in. */
static bool attempt_levels(struct stable_proof *p, const struct model *m, const struct sides *of, struct unknowns *u,
                           int most, bool all_first, struct diag *d) {
  const int level[] = {0, FLINT_MIN(most, N_DIRECT), most};
  bool ok = true;
  p->why_not = "";
  for (int i = 0; ok && p->why_not && i < 3; i++) {
    int k = all_first ? 2 - i : i;
    if (k > 0 && level[k] == level[k - 1]) continue;
    struct unknowns some = *u;
    some.n = u->n_parts + level[k];
    ok = attempt(p, m, of, &some, d);
    p->held = level[k] > 0;
  }
  return ok;
}

/* p says where it stands, of->value[1] or the record of the stable layer what it is called. */
static bool prove(struct stable_proofs *out, struct stable_proof p, const struct model *m, const struct sides *of,
                  struct unknowns *u, struct diag *d) {
  const char *name = of->value[1] ? of->value[1] : of->record[1]->id;
  p.name = arena_strdup(&out->arena, name);
  struct unknowns parts = *u;
  parts.n = u->n_parts;
  bool by_parts, ok = try_points(&p, m, of, u->algebra_alone, d);
  if (ok && !p.why_not) ok = try_argument(&p, m, of, d);
  if (ok && !p.why_not)
    ok = uses_parts(&by_parts, p.section, m, of, &parts, d) &&
         attempt_levels(&p, m, of, u, holdable(u, out, m, name), by_parts, d);
  if (!of->value[1] && !same_relations(of->record[0], of->record[1])) p.why_not = "the relations differ";
  *SS_PUSH(out->item, out->n, out->cap) = p;
  return ok;
}

/* --- All forms --- */

/* What a definition equals in the corrected layer: its own name there (NAME or NAME(t)), or for the last one of a
   record what "equals" says; NULL when it is a part of others. */
static const char *counterpart(const char *value, const struct model *m, const struct definition *def, struct diag *d) {
  struct view corrected = {m, LAYER_CORRECTED, NULL, NULL};
  bool own = view_lookup(&corrected, def->name, def->section, d) != NULL;
  const struct statement_record *r = model_statements(m, def->record);
  const char *equals = r->stmts[r->n_stmts - 1] == def->stmt ? record_get(def->record, "equals") : NULL;
  if (own && equals) diag_set(d, "%s has a corrected form; \"equals\" is for parts that have none", def->name);
  return own ? value : equals;
}

/* A part that is no function can be held from now on. */
static void keep_part(struct unknowns *u, const struct model *m, const struct definition *def, const char *equals) {
  struct diag d = {0};
  struct matrix shape;
  if (def->stmt->param || u->n_parts == MOST_PARTS || !means_one_thing(m, def->name)) return;
  OWNED(reading) r;
  reading_init(&r, m, LAYER_STABLE, &none);
  if (elaborate_text(&shape, &r.el, def->name, def->name, def->section, &d) && shape.rows < 10 && shape.cols < 10) {
    u->part[u->n_parts++] = (struct part){def->name, def->section, equals, shape.rows, shape.cols};
    memmove(u->name + u->n_parts, u->name + u->n_parts - 1, sizeof stable_held);
    u->name[u->n_parts - 1] = (struct override){def->name, shape.rows, shape.cols};
    u->n++;
  }
}

/* A part that takes the name of a free symbol would change what other formulas say. */
static bool hides_symbol(const struct model *m, const struct definition *def, struct diag *d) {
  struct view corrected = {m, LAYER_CORRECTED, NULL, NULL};
  struct diag unsaid = {0};
  if (def->rank != RANK_STABLE || !model_is_symbol(m, def->name) ||
      view_lookup(&corrected, def->name, def->section, &unsaid))
    return false;
  diag_set(d, "%s is a free symbol in the corrected layer; a part needs a name of its own", def->name);
  return true;
}

/* What a definition gives a value: NAME or NAME(t). */
static struct text value_of(const struct definition *def) {
  struct text own = {0};
  text_printf(&own, def->stmt->param ? "%s(t)" : "%s", def->name);
  return own;
}

static bool prove_definition(struct stable_proofs *out, struct unknowns *u, const struct model *m,
                             const struct definition *def, struct diag *d) {
  OWNED(text) own = value_of(def);
  struct diag unclear = {0};
  const char *other = def->rank == RANK_STABLE ? counterpart(text_str(&own), m, def, &unclear) : NULL;
  if (unclear.set) diag_again(d, unclear.message);
  bool ok = !unclear.set && !hides_symbol(m, def, d);
  if (ok && other) {
    struct sides of = {.value = {other, text_str(&own)}};
    ok = prove(out,
               (struct stable_proof){.section = def->section,
                                     .record = model_statements(m, def->record),
                                     .stmt = def->stmt,
                                     .equals = other == text_str(&own) ? NULL : other},
               m, &of, u, d);
    if (ok && other != text_str(&own) && !out->item[out->n - 1].why_not) keep_part(u, m, def, other);
  }
  return ok;
}

/* Every form, or only those asked for. */
static bool prove_all(struct stable_proofs *out, const struct model *m, bool algebra_alone,
                      const struct model_use *asked, struct diag *d) {
  struct unknowns u = {.n = N_HELD, .usable = -1, .algebra_alone = algebra_alone, .asked = asked};
  memcpy(u.name, stable_held, sizeof stable_held);
  *out = (struct stable_proofs){.n = 0};
  bool ok = true;
  for (size_t i = 0; ok && i < m->n_defs; i++)
    if (!asked || asked->def[i]) ok = prove_definition(out, &u, m, &m->defs[i], d);
  for (size_t i = 0; ok && i < m->n_records; i++) {
    const struct statement_record *r = &m->records[i];
    if (r->rank != RANK_STABLE || strcmp(r->record->kind_name, "define") == 0 || (asked && !asked->record[i])) continue;
    struct view corrected = {m, LAYER_CORRECTED, NULL, NULL};
    struct sides of = {.record = {view_record(&corrected, r->id), r}};
    if (!of.record[0]) diag_set(d, "%s replaces no record", r->id);
    ok = of.record[0] && prove(out, (struct stable_proof){.section = r->section, .record = r}, m, &of, &u, d);
  }
  return ok;
}

bool stable_prove(struct stable_proofs *out, const struct model *m, bool algebra_alone, struct diag *d) {
  return prove_all(out, m, algebra_alone, NULL, d);
}

/* Notes a record, and all that it is made of in the stable layer. */
static void note_record(const struct model *noting, size_t i) {
  const struct statement_record *of = &noting->records[i];
  OWNED(reading) r;
  struct diag d = {0};
  noting->use->record[i] = true;
  for (size_t k = 0; k < noting->n_defs; k++) {
    if (noting->defs[k].record != of->record) continue;
    OWNED(text) own = value_of(&noting->defs[k]);
    note_use(noting, text_str(&own), of->section);
  }
  reading_init(&r, noting, LAYER_STABLE, &none);
  reading_record(&r, of, &d);
}

static bool concerns(const struct statement_record *r, const char *equation, const char *record) {
  if (r->rank != RANK_STABLE) return false;
  return equation && *r->equation ? strcmp(r->equation, equation) == 0 : record && strcmp(r->id, record) == 0;
}

void stable_explain(struct text *out, const struct model *m, const char *equation, const char *record) {
  OWNED(model_use) used;
  const struct model noting = model_noting(&used, m);
  bool any = false;
  for (size_t i = 0; i < m->n_records; i++) {
    if (!concerns(&m->records[i], equation, record)) continue;
    any = true;
    note_record(&noting, i);
  }
  OWNED(stable_proofs) p = {.n = 0};
  struct diag d = {0};
  bool ok = !any || prove_all(&p, m, false, &used, &d);
  if (!ok) text_printf(out, "%-11s cannot be read over these formulas: %s\n", "stable form", d.message);
  for (size_t i = 0; ok && i < p.n; i++) {
    const struct statement_record *r = p.item[i].record;
    if (!concerns(r, equation, record)) continue;
    for (int k = 0; k < r->n_stmts; k++) {
      if (p.item[i].stmt && r->stmts[k] != p.item[i].stmt) continue;
      text_printf(out, "%-11s ", "stable form");
      stmt_print(out, r->stmts[k]);
      text_printf(out, " (%s%s)\n", p.item[i].why_not ? "not proved: " : "proved equal",
                  p.item[i].why_not ? p.item[i].why_not : "");
    }
  }
}

void stable_proofs_clear(struct stable_proofs *p) {
  free(p->item);
  arena_clear(&p->arena);
}
