/* What rests on what.  A claim is about a definition (its value, or what it names by "about") or about a record (its
   statement).  Another claim rests on it when its own formulas, put in full, contain that definition or are held
   against that record; printed numbers rest on the printed numbers in their formula.  Nothing of this is written by
   hand. */
#include "claim.h"
#include "model/model.h"
#include "record/result.h"
#include <stdlib.h>
#include <string.h>

/* What one claim is about and, once asked for, what it reaches: that takes its formulas in full, the rest is looked
   up. */
struct reach {
  const struct definition **about;
  size_t n_about, cap_about;
  const char *record;      /* that it is about */
  const char *premises[2]; /* lists of the records that it argues from */
  const char *concludes;   /* that it deduces from them; NULL of other claims */
  const char *by_hand;     /* ids that it names */
  const char *number;      /* the printed number that it is about */
  const struct definition **used;
  size_t n_used, cap_used;
  char **symbols; /* of a number's formula */
  size_t n_symbols, cap_symbols;
  bool walked;
};

struct dependences {
  const struct model *model;
  const struct claims *claims;
  struct reach *reach;
  size_t n;
};

/* --- One claim --- */

/* The names in a list, each up to a bracket: "phi_1(t), K". */
static void read_about(struct reach *r, const struct view *v, const char *list, const char *section) {
  char value[64];
  while ((list = claim_next_item(value, sizeof value, list)) != NULL) {
    struct diag d = {0};
    const struct definition *def = view_lookup_value(v, value, section, &d);
    if (def) *SS_PUSH(r->about, r->n_about, r->cap_about) = def;
  }
}

/* Symbols of a scalar formula, those of its definitions included. */
static void add_symbols(struct reach *r, const struct elaboration *el, const struct matrix *m) {
  OWNED(tape) t = {.n = 0};
  struct diag d = {0};
  if (elaboration_tape(&t, el, m->e, m->rows * m->cols, &d))
    for (slong i = 0; i < t.n_inputs; i++) {
      *SS_PUSH(r->symbols, r->n_symbols, r->cap_symbols) = t.inputs[i];
      t.inputs[i] = NULL;
    }
}

/* Mistakes in a formula are the judges' to report; what it reaches before them counts. */
static void reach_text(struct reach *r, struct elaboration *el, const char *text, const char *section) {
  if (!text) return;
  struct diag d = {0};
  struct matrix m;
  if (elaborate_text(&m, el, text, text, section, &d) && r->number) add_symbols(r, el, &m);
}

static void reach_record(struct elaboration *el, const struct view *v, const char *id) {
  const struct statement_record *rec = id ? view_record(v, id) : NULL;
  for (int k = 0; rec && k < rec->n_stmts; k++) {
    const struct stmt *s = rec->stmts[k];
    for (int i = 0; s->kind == STMT_RELATION && i < s->n_sides; i++) {
      struct matrix m;
      struct diag d = {0};
      elaborate(&m, el, s->sides[i], rec->src, rec->section, &d);
    }
  }
}

static void look_at_claim(struct reach *r, const struct model *m, const struct claim *c) {
  const char *value = claim_get(c, "value");
  struct view v = claim_view(m, c);
  r->number = claim_get(c, "number");
  r->record = claim_get(c, "statement");
  read_about(r, &v, value, claim_section(c));
  read_about(r, &v, claim_get(c, "about"), claim_section(c));
  r->premises[0] = claim_get(c, "premises");
  r->premises[1] = claim_get(c, "constraints");
  r->concludes = claim_deduces(c) ? claim_get(c, "conclusion") : NULL;
  r->by_hand = claim_get(c, "depends-on");
}

/* Puts the claim's formulas in full; lists: what arguments, counts and sequences are made of. */
static const struct reach *walk(struct dependences *d, size_t a) {
  static const char *const lists[] = {"premises", "conclusion", "repair", "constraints", "statements"};
  struct cited at;
  struct reach *r = &d->reach[a];
  const struct claim *c = &d->claims->claim[a];
  if (r->walked) return r;
  r->walked = true;
  struct view v = claim_view(d->model, c);
  OWNED(elaboration) el;
  LOCAL(arena, formulas);
  elaboration_init(&el, v, NULL, 0);
  reach_text(r, &el, claim_get(c, "value"), claim_section(c));
  reach_text(r, &el, claim_formula(&formulas, d->model, c, "formula"), claim_section(c));
  reach_record(&el, &v, claim_get(c, "statement"));
  for (int i = 0; i < COUNT(lists); i++)
    for (const char *p = claim_get(c, lists[i]); (p = claim_next_cited(&at, p)) != NULL;) reach_record(&el, &v, at.id);
  for (size_t i = 0; i < elaboration_n_used(&el); i++) {
    const struct definition *def = elaboration_used(&el, i);
    if (def) *SS_PUSH(r->used, r->n_used, r->cap_used) = def;
  }
  return r;
}

struct dependences *dependences_new(const struct model *m, const struct claims *claims) {
  struct dependences *d = ss_malloc(sizeof *d);
  *d = (struct dependences){
      .model = m, .claims = claims, .n = claims->n, .reach = ss_malloc(claims->n * sizeof *d->reach)};
  for (size_t i = 0; i < d->n; i++) {
    d->reach[i] = (struct reach){.n_about = 0};
    look_at_claim(&d->reach[i], m, &claims->claim[i]);
  }
  return d;
}

void dependences_free(struct dependences *d) {
  for (size_t i = 0; i < d->n; i++) {
    struct reach *r = &d->reach[i];
    for (size_t k = 0; k < r->n_symbols; k++) free(r->symbols[k]);
    free(r->symbols);
    free(r->about);
    free(r->used);
  }
  free(d->reach);
  free(d);
}

/* --- Two claims --- */

/* The same name of the paper, whichever layer wrote the text. */
static bool same_name(const struct definition *a, const struct definition *b) {
  return *a->name == *b->name && strcmp(a->name, b->name) == 0 &&
         (!*a->section || !*b->section || strcmp(a->section, b->section) == 0);
}

static bool is_about(const struct reach *r, const struct definition *def) {
  for (size_t i = 0; i < r->n_about; i++)
    if (same_name(r->about[i], def)) return true;
  return false;
}

/* Claims about the same thing stand beside each other: neither rests on the other. */
bool dependences_on(struct dependences *d, size_t a, size_t b) {
  const struct reach *ra = walk(d, a), *rb = &d->reach[b];
  if (a == b) return false;
  for (size_t i = 0; i < ra->n_used; i++)
    if (is_about(rb, ra->used[i]) && !is_about(ra, ra->used[i])) return true;
  for (int i = 0; i < 2 && rb->record; i++)
    if (cited_share(ra->premises[i], rb->record) && (!ra->record || strcmp(ra->record, rb->record) != 0)) return true;
  if (!ra->number || !rb->number || strcmp(ra->number, rb->number) == 0) return false;
  for (size_t i = 0; i < ra->n_symbols; i++)
    if (strcmp(paper_name(rb->number).is, ra->symbols[i]) == 0) return true;
  return false;
}

static bool dependences_argued(const struct dependences *d, size_t a, size_t b) {
  const struct reach *x = &d->reach[a], *y = &d->reach[b];
  return a != b && x->concludes && y->concludes && cited_share(x->premises[0], y->concludes);
}

bool dependences_any(struct dependences *d, size_t a, size_t b) {
  return dependences_on(d, a, b) || dependences_argued(d, a, b) ||
         list_has(d->reach[a].by_hand, d->claims->claim[b].id);
}

size_t dependences_n_used(struct dependences *d, size_t a) {
  return walk(d, a)->n_used;
}

const struct definition *dependences_used(struct dependences *d, size_t a, size_t i) {
  return walk(d, a)->used[i];
}

bool dependences_corrected(struct dependences *d, size_t a, const char *equation) {
  const struct reach *r = walk(d, a);
  for (size_t i = 0; i < r->n_used; i++) {
    const struct definition *def = r->used[i];
    if (def->rank == RANK_ERRATA && strcmp(def->equation, equation) == 0) return true;
  }
  return false;
}

/* --- The list of a finding --- */

/* Every id that is named by hand must be that of a claim. */
static bool check_named(struct judge *j, const struct claim *c, const char *list) {
  size_t n;
  for (const char *p = list_item(&n, list); p; p = list_item(&n, p + n)) {
    bool known = false;
    for (size_t i = 0; i < j->claims->n; i++) known = known || word_is(p, n, j->claims->claim[i].id);
    if (!known) return claim_error(j, c, "depends-on", "depends-on names something that is not a claim");
  }
  return true;
}

bool dependences_list(struct finding *f, struct judge *j, const struct claim *c) {
  const char *by_hand = claim_get(c, "depends-on");
  size_t a = 0;
  while (a < j->claims->n && strcmp(j->claims->claim[a].id, c->id) != 0) a++;
  if (!check_named(j, c, by_hand)) return false;
  f->depends_on = arena_alloc(&j->out->arena, j->claims->n * sizeof *f->depends_on);
  f->n_depends_on = 0;
  for (size_t b = 0; b < j->claims->n; b++) {
    const char *id = j->claims->claim[b].id;
    if (a < j->claims->n ? dependences_any(j->dependences, a, b) : list_has(by_hand, id))
      f->depends_on[f->n_depends_on++] = result_copy(j->out, id);
  }
  return true;
}
