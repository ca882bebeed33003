/* Which small edits of its printed text would make a refuted claim true?  The same edits that damage formulas, tried
   the other way round: each is put in place as if the paper had printed it, and the claim is judged by the checks that
   refuted it.  Where no edit helps, or not the correction on file, pairs of exchanged names are tried, within a budget,
   and then the steps of a chain a = b = c one by one. */
#include <stdlib.h>
#include <string.h>

#include "base/crew.h"
#include "judge/judge.h"
#include "mutants.h"
#include "power.h"
#include "value/title.h"

enum { PAIR_BUDGET = 20000 };

/* One or two edited statements; stmt NULL: the statement is left out. */
struct candidate {
  int n;
  struct target target[2];
  const struct stmt *stmt[2];
  const char *kind[2], *was[2], *now[2];
};

struct search {
  const struct model *model;
  const struct claims *claims;
  const struct scene *scene;
  struct orbit_cache *cache;
  struct facts *facts;
  struct overlay overlay;
  struct repair_result *out;
  int jobs;
  struct arena arena;
  const struct claim *claim;
  struct repairs *found; /* of the claim */
  struct lexicon *words;
  struct target *target;
  struct edits *edits; /* of each target */
  size_t n_targets, cap_targets;
  struct candidate *candidate;
  size_t n, cap;
};

/* --- Candidates --- */

/* The printed statements that the claim is about, and the definitions printed with them unless it is the statement that
   the errata correct. */
static void find_targets(struct search *s) {
  struct view v = claim_view(s->model, s->claim);
  bool with_definitions = !erratum_replaces(s->model, s->claim);
  for (size_t i = 0; i < s->model->n_records; i++) {
    const struct statement_record *r = &s->model->records[i];
    bool defines = strcmp(r->record->kind_name, "define") == 0;
    bool own = with_definitions && r->rank <= RANK_USER && claim_numbers(s->claim, r);
    bool subject = own || claim_is_about(r, s->claim);
    if (!subject || (!defines && view_record(&v, r->id) != r)) continue;
    for (int k = 0; k < r->n_stmts; k++) {
      if (r->stmts[k]->kind == STMT_TRAJECTORY) continue;
      *SS_PUSH(s->target, s->n_targets, s->cap_targets) = target_of(s->model, i, k);
    }
  }
  s->edits = ss_malloc((s->n_targets + 1) * sizeof *s->edits);
  for (size_t t = 0; t < s->n_targets; t++) {
    s->edits[t] = (struct edits){.n = 0};
    const struct statement_record *r = &s->model->records[s->target[t].record];
    if (!s->words) s->words = lexicon_new(s->model, r->section);
    lexicon_edits(&s->edits[t], &s->arena, s->words, r->stmts[s->target[t].stmt]);
  }
}

static struct candidate *add_candidate(struct search *s) {
  s->candidate = ss_grow(s->candidate, s->n, &s->cap, sizeof *s->candidate);
  s->candidate[s->n] = (struct candidate){.n = 0};
  return &s->candidate[s->n++];
}

static void put_edit(struct candidate *c, const struct target *t, const struct edit *e) {
  c->target[c->n] = *t;
  c->stmt[c->n] = e->stmt;
  c->kind[c->n] = edit_kind_name[e->kind];
  c->was[c->n] = e->was;
  c->now[c->n] = e->now;
  c->n++;
}

static const char *printed(struct arena *a, const struct stmt *s) {
  struct text t = {0};
  stmt_print(&t, s);
  return text_take(a, &t);
}

static void single_edits(struct search *s) {
  s->n = 0;
  for (size_t t = 0; t < s->n_targets; t++) {
    const struct target *x = &s->target[t];
    const struct statement_record *r = &s->model->records[x->record];
    for (size_t i = 0; i < s->edits[t].n; i++) put_edit(add_candidate(s), x, &s->edits[t].edit[i]);
    if (x->def >= 0 || r->n_stmts < 2) continue;
    struct edit out = {.was = printed(&s->arena, r->stmts[x->stmt]), .now = "nothing"};
    struct candidate *c = add_candidate(s);
    put_edit(c, x, &out);
    c->kind[0] = "statement left out";
  }
}

static bool is_name(const struct edit *e, bool symbols) {
  return e->kind == EDIT_INDEX || (symbols && e->kind == EDIT_SYMBOL);
}

/* Pairs in one statement: an edit and, later in the text, an edit of what it gives. */
static void pairs_within(struct search *s, size_t t, const struct edit *first, bool symbols) {
  OWNED(edits) later = {.n = 0};
  lexicon_edits(&later, &s->arena, s->words, first->stmt);
  for (size_t i = 0; i < later.n && s->n < PAIR_BUDGET; i++) {
    const struct edit *second = &later.edit[i];
    if (!is_name(second, symbols) || second->place.begin <= first->place.begin) continue;
    struct candidate *c = add_candidate(s);
    put_edit(c, &s->target[t], first);
    c->stmt[0] = second->stmt; /* it has both edits */
    c->kind[1] = edit_kind_name[second->kind];
    c->was[1] = second->was;
    c->now[1] = second->now;
  }
}

static void pairs_between(struct search *s, size_t t, const struct edit *first, bool symbols) {
  for (size_t u = t + 1; u < s->n_targets; u++)
    for (size_t i = 0; i < s->edits[u].n && s->n < PAIR_BUDGET; i++) {
      if (!is_name(&s->edits[u].edit[i], symbols)) continue;
      struct candidate *c = add_candidate(s);
      put_edit(c, &s->target[t], first);
      put_edit(c, &s->target[u], &s->edits[u].edit[i]);
    }
}

/* Whether all of them are within the budget. */
static bool pair_edits(struct search *s, bool symbols) {
  s->n = 0;
  for (size_t t = 0; t < s->n_targets; t++)
    for (size_t i = 0; i < s->edits[t].n; i++) {
      if (!is_name(&s->edits[t].edit[i], symbols)) continue;
      pairs_within(s, t, &s->edits[t].edit[i], symbols);
      pairs_between(s, t, &s->edits[t].edit[i], symbols);
    }
  return s->n < PAIR_BUDGET;
}

/* --- Trying one --- */

static void put_in_place(struct search *s, const struct candidate *c, bool in) {
  for (int i = 0; i < c->n; i++) {
    if (c->stmt[i])
      overlay_set(&s->overlay, &c->target[i], in ? c->stmt[i] : NULL);
    else
      overlay_leave_out(&s->overlay, &c->target[i], in);
  }
}

/* The verdict on the claim; refuted with d set when it cannot be judged. */
static enum verdict verdict_of_claim(const struct search *s, const struct model *m, enum effort effort,
                                     struct diag *d) {
  OWNED(audit_result) out;
  struct finding f;
  struct judge j = {
      .out = &out, .model = m, .claims = s->claims, .scene = s->scene, .cache = s->cache, .d = d, .effort = effort};
  audit_result_init(&out);
  return judge_verdict(&f, &j, s->claim) ? f.verdict : VERDICT_REFUTED;
}

/* With a candidate in place: refuted at the first difference, else in full. */
static enum verdict verdict_with(struct search *s) {
  enum verdict v = VERDICT_UNKNOWN;
  for (int effort = EFFORT_REFUTE + 1; effort-- > EFFORT_FULL && v != VERDICT_REFUTED;) {
    struct diag d = {0};
    v = verdict_of_claim(s, &s->overlay.model, (enum effort)effort, &d);
  }
  return v;
}

static void try_candidate(void *result, size_t i, void *arg) {
  struct search *s = arg;
  put_in_place(s, &s->candidate[i], true);
  enum verdict v = verdict_with(s);
  put_in_place(s, &s->candidate[i], false);
  memcpy(result, &v, sizeof v);
}

/* --- What passes --- */

/* Insertions, deletions and exchanges of characters that turn a into b. */
static long edit_distance(const char *a, const char *b) {
  size_t n = strlen(b);
  FREED long *row = ss_malloc((n + 1) * sizeof *row);
  for (size_t k = 0; k <= n; k++) row[k] = (long)k;
  for (; *a; a++) {
    long corner = row[0]++;
    for (size_t k = 1; k <= n; k++) {
      long up = row[k], best = corner + (*a != b[k - 1]);
      if (up + 1 < best) best = up + 1;
      if (row[k - 1] + 1 < best) best = row[k - 1] + 1;
      corner = up;
      row[k] = best;
    }
  }
  return row[n];
}

/* The statements of the claim as they stand in a model. */
static void add_statements(struct text *out, const struct search *s, const struct model *m, const struct candidate *c) {
  for (size_t t = 0; t < s->n_targets; t++) {
    const struct target *x = &s->target[t];
    bool touched = !c;
    for (int i = 0; c && i < c->n; i++) touched = touched || (c->target[i].record == x->record && x->def < 0);
    for (int i = 0; c && i < c->n; i++)
      touched = touched || (c->target[i].record == x->record && c->target[i].stmt == x->stmt);
    const struct statement_record *r = &m->records[x->record];
    if (!touched || x->stmt >= r->n_stmts) continue;
    if (out->len) text_add(out, "; ");
    stmt_print(out, r->stmts[x->stmt]);
  }
}

static struct repair describe(struct search *s, const struct candidate *c, enum verdict v) {
  struct arena *a = &s->out->arena;
  const char *erratum = s->found->erratum;
  struct text text = {0}, kinds = {0}, change = {0};
  OWNED(text) before = {0}, after = {0};
  struct repair r = {.edits = 0, .verdict = verdict_name[v]};
  for (int i = 0; i < 2 && c->kind[i]; i++, r.edits++) {
    text_printf(&kinds, "%s%s", i ? ", " : "", c->kind[i]);
    text_printf(&change, "%s%s -> %s", i ? "; " : "", c->was[i], c->now[i]);
  }
  add_statements(&before, s, s->model, NULL);
  put_in_place(s, c, true);
  add_statements(&after, s, &s->overlay.model, NULL);
  add_statements(&text, s, &s->overlay.model, c);
  r.distance = edit_distance(text_str(&before), text_str(&after));
  if (erratum && strcmp(erratum, text_str(&text)) == 0)
    r.erratum = "same text";
  else if (erratum && claim_says_corrected(s->claim, &s->overlay.model, s->model, s->facts))
    r.erratum = "same values";
  put_in_place(s, c, false);
  r.text = text_take(a, &text);
  r.kinds = text_take(a, &kinds);
  r.change = text_take(a, &change);
  return r;
}

static int smallest_first(const void *a, const void *b) {
  const struct repair *x = a, *y = b;
  if (x->edits != y->edits) return x->edits - y->edits;
  if (x->distance != y->distance) return x->distance < y->distance ? -1 : 1;
  int by_text = strcmp(x->text, y->text);
  return by_text ? by_text : strcmp(x->change, y->change);
}

static bool try_all(struct search *s, struct diag *d) {
  struct repairs *found = s->found;
  FREED enum verdict *v = ss_malloc((s->n + 1) * sizeof *v);
  bool ok = crew_results(v, sizeof *v, s->n, s->jobs, try_candidate, s, NULL, d);
  s->out->broken = !ok;
  for (size_t i = 0; ok && i < s->n; i++) {
    if (!verdict_passes(v[i])) continue;
    *SS_PUSH(found->repair, found->n, found->cap) = describe(s, &s->candidate[i], v[i]);
  }
  return ok;
}

/* --- One claim --- */

/* Something passes of what was found from there on and, when a correction is on file, that one does. */
static bool has_erratum(const struct repairs *found, size_t from) {
  bool has = !found->erratum && found->n > from;
  for (size_t i = from; i < found->n; i++) has = has || found->repair[i].erratum;
  return has;
}

/* Every edit; then pairs of exchanged names, where no edit helps or not the correction on file. */
static bool search_targets(struct search *s, struct diag *d) {
  struct repairs *found = s->found;
  size_t from = found->n;
  single_edits(s);
  found->singles += (long)s->n;
  if (!try_all(s, d)) return false;
  if (has_erratum(found, from)) return true;
  bool complete = pair_edits(s, true);
  if (!complete) complete = pair_edits(s, false);
  found->pairs_complete = complete && (found->pairs_complete || found->pairs == 0);
  found->pairs += (long)s->n;
  return try_all(s, d);
}

/* Steps a = b of a chain a = ... = b, each as the whole statement. */
static bool search_pieces(struct search *s, size_t t, struct diag *d) {
  const struct stmt *chain = s->model->records[s->target[t].record].stmts[s->target[t].stmt];
  bool ok = true;
  for (int k = 1; ok && chain->kind == STMT_RELATION && chain->n_sides > 2 && k < chain->n_sides; k++) {
    struct stmt *piece = arena_alloc(&s->arena, sizeof *piece);
    OWNED(edits) edits = {.n = 0};
    *piece = *chain;
    piece->n_sides = 2;
    piece->sides = arena_alloc(&s->arena, 2 * sizeof *piece->sides);
    piece->ops = &chain->ops[k - 1];
    piece->sides[0] = chain->sides[0];
    piece->sides[1] = chain->sides[k];
    lexicon_edits(&edits, &s->arena, s->words, piece);
    struct search part = *s;
    part.target = &s->target[t];
    part.n_targets = 1;
    part.edits = &edits;
    part.candidate = NULL;
    part.n = part.cap = 0;
    ok = search_targets(&part, d);
    s->arena = part.arena;
    free(part.candidate);
  }
  return ok;
}

static bool search_claim(struct search *s, struct diag *d) {
  struct text t = {0};
  if (erratum_text(&t, s->model, s->claim)) s->found->erratum = text_take(&s->out->arena, &t);
  text_reset(&t);
  find_targets(s);
  add_statements(&t, s, s->model, NULL);
  s->found->printed = text_take(&s->out->arena, &t);
  bool ok = search_targets(s, d);
  bool enough = has_erratum(s->found, 0);
  for (size_t i = 0; ok && !enough && i < s->n_targets; i++) ok = search_pieces(s, i, d);
  if (s->found->n) qsort(s->found->repair, s->found->n, sizeof *s->found->repair, smallest_first);
  return ok;
}

static void search_clear(struct search *s) {
  for (size_t t = 0; t < s->n_targets; t++) edits_clear(&s->edits[t]);
  free(s->edits);
  free(s->target);
  free(s->candidate);
  if (s->words) lexicon_free(s->words);
  arena_clear(&s->arena);
}

/* Why there is nothing to search; NULL when there is. */
static const char *no_search(const struct claim *c, enum verdict v) {
  if (!verdict_fails(v)) return "it is not refuted";
  enum kind kind = claim_kind(c);
  if (kind == KIND_INDEX_RANGE) return "it is about the range of an index, not about a formula";
  if (!claim_tried_at_points(c)) return "it is about numbers, or about more than one formula";
  return NULL;
}

static bool add_claim(const struct search *base, const struct claim *c, bool named, struct diag *d) {
  struct repair_result *out = base->out;
  struct search s = *base;
  s.claim = c;
  enum verdict v = verdict_of_claim(&s, s.model, EFFORT_FULL, d);
  const char *why = no_search(c, v);
  if (d->set || (!named && !verdict_fails(v))) return !d->set;
  struct text title = {0};
  bool ok = claim_title(&title, s.model, c, NULL, d);
  const char *equation = claim_get(c, "equation");
  struct repairs found = {.claim = arena_strdup(&out->arena, c->id),
                          .title = text_take(&out->arena, &title),
                          .equation = equation ? arena_strdup(&out->arena, equation) : NULL,
                          .why_none = why};
  s.found = &found;
  if (ok && !why) ok = search_claim(&s, d);
  search_clear(&s);
  *SS_PUSH(out->claim, out->n, out->cap) = found;
  return ok;
}

/* Whether there will be something to search, as far as the record tells. */
static bool is_work(const struct claim *c, const struct repair_options *opt) {
  const char *record = claim_get(c, "record");
  return claims_selects(opt->only, opt->n_only, c) && (!record || !no_search(c, verdict_parse(record)));
}

bool audit_repairs(struct repair_result *out, const struct model *m, const struct claims *claims,
                   const struct scene *scene, const struct repair_options *opt, struct diag *d) {
  if (!claims_check_selection(claims, opt->only, opt->n_only, d)) return false;
  struct search base = {.model = m,
                        .claims = claims,
                        .scene = scene,
                        .cache = orbit_cache_new(),
                        .facts = facts_new(m),
                        .out = out,
                        .jobs = opt->jobs};
  overlay_init(&base.overlay, m);
  out->scene = arena_strdup(&out->arena, scene->name);
  bool ok = true;
  size_t done = 0, of = 0;
  for (size_t i = 0; i < claims->n; i++) of += is_work(&claims->claim[i], opt);
  for (size_t i = 0; ok && i < claims->n; i++) {
    if (!claims_selects(opt->only, opt->n_only, &claims->claim[i])) continue;
    ok = add_claim(&base, &claims->claim[i], opt->n_only > 0, d);
    done += is_work(&claims->claim[i], opt);
    if (opt->progress) opt->progress(done, of);
  }
  overlay_clear(&base.overlay);
  facts_free(base.facts);
  orbit_cache_free(base.cache);
  return ok;
}

void repair_result_clear(struct repair_result *r) {
  for (size_t i = 0; i < r->n; i++) free(r->claim[i].repair);
  free(r->claim);
  arena_clear(&r->arena);
}
