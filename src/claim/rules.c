/* Rules that no claim breaks silently: see claim.h.  Each broken one is an error with its place, since what is checked
   here is what the claims say of themselves, before anything is judged. */
#include "claim.h"
#include "record/routes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- Points and routes --- */

/* All points, and the least of any item. */
static void count_points(long *all, long *least, const struct claim *c) {
  struct asked_points at;
  *all = 0;
  *least = -1;
  for (const char *p = claim_points_asked(c); (p = claim_next_points(&at, p)) != NULL;) {
    *all += at.n;
    if (*least < 0 || at.n < *least) *least = at.n;
  }
}

/* Arcs alone say nothing of periodic orbits, whose times and start are bound; a few orbits alone say little; and no
   sort stands twice. */
enum { ORBITS_ALONE = 10 };

static bool check_sorts(const struct claim *c, struct diag *d) {
  enum { MOST = 16 };
  struct asked_points at[MOST];
  int n = 0;
  bool arcs = false, orbits = false;
  for (const char *p = claim_points_asked(c); n < MOST && (p = claim_next_points(&at[n], p)) != NULL; n++) {
    arcs = arcs || strcmp(at[n].word, "arcs") == 0;
    orbits = orbits || strcmp(at[n].word, "orbits") == 0;
    for (int i = 0; i < n; i++)
      if (strcmp(at[i].word, at[n].word) == 0 && strcmp(at[i].phase, at[n].phase) == 0)
        return claim_mistake(c, "points", d, "a sort of points stands here twice");
  }
  if (orbits && n == 1 && at[0].n < ORBITS_ALONE && !claim_get(c, "few"))
    return claim_mistake(c, "points", d, "orbits alone are at least 10; more of them, or a reason in \"few:\"");
  return !arcs || orbits || claim_get(c, "few") ||
         claim_mistake(c, "points", d, "what is tried on arcs is tried on orbits too; or a reason in \"few:\"");
}

/* Routes, balls first, of which each is independent of those before it. */
static int count_routes(const struct claim *c) {
  enum { MOST = 16 };
  char name[MOST][CLAIM_NAME] = {"balls"}, listed[MOST][CLAIM_NAME];
  int n = 1, m = claim_names_listed(listed, MOST - 1, claim_routes_asked(c));
  for (int i = 0; i < m; i++) {
    bool fresh = route_is_known(listed[i]);
    for (int k = 0; fresh && k < n; k++) fresh = routes_independent(name[k], listed[i]);
    if (fresh) memcpy(name[n++], listed[i], CLAIM_NAME);
  }
  return n;
}

/* Of what is tried at points.  At the paper's own symbols there is one way to a value, and no other route. */
static bool check_numbers(const struct model *m, const struct claim *c, const struct claim_kind *kind, struct diag *d) {
  enum { POINTS = 6, ROUTES = 2 };
  long all, least;
  int routes = count_routes(c);
  if (claim_get(c, "few") || !kind->tried_at_points) return true;
  count_points(&all, &least, c);
  if (all < POINTS || 2 * least < POINTS)
    return claim_mistake(c, "points", d,
                         "points for a claim of kind %s are at least %d in all and %d of each sort; more of them, or a "
                         "reason in \"few:\"",
                         kind->word, POINTS, POINTS / 2);
  return routes >= ROUTES || !m->system ||
         claim_mistake(c, "routes", d,
                       "a claim of kind %s is tried by at least %d independent routes, of which balls is one; here it "
                       "is alone; more of them, or a reason in \"few:\"",
                       kind->word, ROUTES);
}

/* --- Arguments --- */

static bool same_range(const struct stmt *a, const struct stmt *b) {
  if (!a->range_hi || !b->range_hi) return !a->range_hi && !b->range_hi;
  return expr_same(a->range_lo, b->range_lo) && expr_same(a->range_hi, b->range_hi) && a->lo_closed == b->lo_closed &&
         a->hi_closed == b->hi_closed;
}

/* Some step of either statement that the other has too, of those that are cited. */
static bool same_step(const struct stmt *s, int only_s, const struct stmt *t, int only_t) {
  if (s->kind != STMT_RELATION || t->kind != STMT_RELATION || !same_range(s, t)) return false;
  for (int i = 0; i + 1 < s->n_sides; i++)
    for (int k = 0; k + 1 < t->n_sides; k++)
      if ((!only_s || only_s == i + 1) && (!only_t || only_t == k + 1) && s->ops[i] == t->ops[k] &&
          expr_same(s->sides[i], t->sides[k]) && expr_same(s->sides[i + 1], t->sides[k + 1]))
        return true;
  return false;
}

/* The same text under two names. */
static bool same_text(const struct model *m, const struct cited *a, const struct cited *b) {
  struct view v = {m, LAYER_CORRECTED, NULL, NULL};
  if (strcmp(a->phase, b->phase) != 0) return false;
  const struct statement_record *r = view_record(&v, a->id), *q = view_record(&v, b->id);
  for (int i = 0; r && i < r->n_stmts; i++)
    for (int k = 0; q && k < q->n_stmts; k++)
      if ((!a->statement || a->statement == i + 1) && (!b->statement || b->statement == k + 1) &&
          same_step(r->stmts[i], a->step, q->stmts[k], b->step))
        return true;
  return false;
}

/* What repeats its premises in other words says so, by being turned round. */
static bool check_conclusion(const struct model *m, const struct claim *c, struct diag *d) {
  static const char *const premises[] = {"premises", "repair"};
  struct cited end, start;
  bool repeats = claim_get(c, "converse");
  for (const char *p = claim_get(c, "conclusion"); (p = claim_next_cited(&end, p)) != NULL;)
    for (size_t i = 0; i < sizeof premises / sizeof *premises; i++)
      for (const char *q = claim_get(c, premises[i]); (q = claim_next_cited(&start, q)) != NULL;) {
        bool itself = cited_overlap(&end, &start);
        if (!itself && (repeats || !same_text(m, &end, &start))) continue;
        return claim_mistake(c, premises[i], d, "the conclusion %.40s is among its own premises%s%.40s", end.id,
                             itself ? "" : ", as ", itself ? "" : start.id);
      }
  return true;
}

/* Whether a line of the list is a record of the equation. */
static bool cites_equation(const struct model *m, const char *list, const char *number) {
  struct view v = {m, LAYER_PRINTED, NULL, NULL};
  struct cited at;
  for (const char *p = list; (p = claim_next_cited(&at, p)) != NULL;) {
    const struct statement_record *r = view_record(&v, at.id);
    if (r && strcmp(r->equation, number) == 0) return true;
  }
  return false;
}

/* "(52), (53)" in the sentence are among its premises, or what it concludes. */
static bool check_quoted_numbers(const struct model *m, const struct claim *c, struct diag *d) {
  char number[8];
  int len = 0;
  for (const char *s = claim_get(c, "quote"); s && (s = strchr(s, '(')) != NULL; s++) {
    if (sscanf(s, "(%3[0-9]%n", number, &len) != 1 || s[len] != ')') continue;
    if (cites_equation(m, claim_get(c, "premises"), number) || cites_equation(m, claim_get(c, "conclusion"), number))
      continue;
    return claim_mistake(c, "premises", d, "the sentence cites (%s), which is neither a premise nor a conclusion",
                         number);
  }
  return true;
}

/* What the claim takes from its sentence, the first of several things, stands there in the same words. */
static bool check_quoted_words(const struct claim *c, struct diag *d) {
  static const char *const keys[] = {"transition", "side", "given"};
  const char *quote = claim_get(c, "quote");
  char words[64];
  for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
    if (claim_next_item(words, sizeof words, claim_get(c, keys[i])) && quote && !strstr(quote, words))
      return claim_mistake(c, keys[i], d, "the sentence does not say \"%s\"", words);
  }
  return true;
}

/* A formula that cites a statement is a side of one that there is. */
static bool check_formula(const struct model *m, const struct claim *c, struct diag *d) {
  static const char *const keys[] = {"formula", "least-first", "least-second"};
  LOCAL(arena, a);
  bool ok = true;
  for (size_t i = 0; ok && i < sizeof keys / sizeof *keys; i++) {
    const char *formula = claim_formula(&a, m, c, keys[i]);
    ok = !formula || !strchr(formula, '#') || claim_formula_relation(m, c, keys[i]) == '?' ||
         claim_mistake(c, keys[i], d, "there is no statement %s with a right side", formula);
  }
  return ok;
}

/* --- One claim --- */

bool claim_keeps_rules(const struct model *m, const struct claim *c, struct diag *d) {
  const struct claim_kind *kind = claim_kind_of(c);
  if (!kind) return claim_mistake(c, "kind", d, "%s", claim_no_kind);
  if (m->system && claim_kind(c) == KIND_INEQUALITY && claim_get(c, "points"))
    return claim_mistake(c, "points", d, "inequalities are judged with the example's own numbers; leave the line out");
  return check_numbers(m, c, kind, d) && check_sorts(c, d) && check_quoted_words(c, d) && check_formula(m, c, d) &&
         (claim_kind(c) != KIND_ARGUMENT || check_quoted_numbers(m, c, d)) && check_conclusion(m, c, d);
}

/* --- The whole --- */

/* "only": the other direction of an argument that stands by itself. */
static bool check_turned(const struct claims *claims, const struct claim *c, struct diag *d) {
  const char *id = claim_get(c, "converse-of");
  const struct claim *other = claim_named(claims, id);
  if (!id) return true;
  if (other && cited_share(claim_get(c, "conclusion"), claim_get(other, "premises")) &&
      cited_share(claim_get(other, "conclusion"), claim_get(c, "premises")))
    return true;
  return claim_mistake(c, "converse-of", d, "no argument of that name goes the other way round");
}

enum { UNSEEN, ON_THE_WAY, DONE };

/* Depth first: a claim that is met again on the way rests on itself. */
static bool walk(size_t *way, int n, char *state, struct dependences *rests, const struct claims *claims,
                 struct diag *d) {
  size_t a = way[n - 1];
  state[a] = ON_THE_WAY;
  for (size_t b = 0; b < claims->n; b++) {
    if (state[b] == DONE || !dependences_any(rests, a, b)) continue;
    if (state[b] == ON_THE_WAY) {
      OWNED(text) round = {0};
      int first = 0;
      while (way[first] != b) first++;
      for (int i = first; i < n; i++) text_printf(&round, "%s, which rests on ", claims->claim[way[i]].id);
      return diag_at(d, &claims->claim[b].file->src, claims->claim[b].record->id.begin, "a claim rests on itself: %s%s",
                     text_str(&round), claims->claim[b].id);
    }
    way[n] = b;
    if (!walk(way, n + 1, state, rests, claims, d)) return false;
  }
  state[a] = DONE;
  return true;
}

static bool check_graph(const struct model *m, const struct claims *claims, struct diag *d) {
  struct dependences *rests = dependences_new(m, claims);
  FREED size_t *way = ss_malloc((claims->n + 1) * sizeof *way);
  FREED char *state = ss_malloc(claims->n + 1);
  bool ok = true;
  memset(state, UNSEEN, claims->n + 1);
  for (size_t i = 0; ok && i < claims->n; i++) {
    way[0] = i;
    if (state[i] == UNSEEN) ok = walk(way, 1, state, rests, claims, d);
  }
  dependences_free(rests);
  return ok;
}

/* A correction that no claim asks for would never be judged. */
static bool check_errata(const struct model *m, const struct claims *claims, struct diag *d) {
  for (size_t i = 0; i < m->n_records; i++) {
    const struct statement_record *r = &m->records[i];
    bool asked = r->rank != RANK_ERRATA;
    for (size_t k = 0; !asked && k < claims->n; k++)
      asked = claim_judged_at_points(m, &claims->claim[k]) &&
              (erratum_is_about(r, &claims->claim[k], true) || erratum_is_about(r, &claims->claim[k], false));
    if (asked) continue;
    return diag_at(d, r->src, r->record->id.begin,
                   "%s: no claim is corrected by this; one with this equation number, on a statement that uses it, is",
                   r->record->id_name);
  }
  return true;
}

/* A record that replaces nothing would be one more formula, which no claim is about. */
static bool check_replaced(const struct model *m, struct diag *d) {
  for (size_t i = 0; i < m->n_records; i++) {
    const struct statement_record *r = &m->records[i];
    const struct field *f = record_field(r->record, "replaces");
    bool found = f == NULL;
    for (size_t k = 0; !found && k < m->n_records; k++)
      found = m->records[k].rank < r->rank && strcmp(m->records[k].id, f->text) == 0;
    if (found) continue;
    return diag_at(d, r->src, f->value.begin, "%s: there is no record %s to be replaced", r->record->id_name, f->text);
  }
  return true;
}

/* A correction by "x = x" would be proved of anything. */
static bool check_corrections(const struct model *m, struct diag *d) {
  for (size_t i = 0; i < m->n_records; i++) {
    const struct statement_record *r = &m->records[i];
    for (int k = 0; r->rank == RANK_ERRATA && k < r->n_stmts; k++) {
      const struct stmt *s = r->stmts[k];
      for (int n = 0; s->kind == STMT_RELATION && n + 1 < s->n_sides; n++)
        if (expr_same(s->sides[n], s->sides[n + 1]))
          return diag_at(d, r->src, s->sides[n]->span.begin,
                         "%s: a correction that says nothing: these sides are the same", r->record->id_name);
    }
  }
  return true;
}

/* A claim whose own text a correction replaced would be judged as corrected. */
static bool check_own_text(const struct model *m, const struct claims *claims, struct diag *d) {
  for (size_t i = 0; i < claims->n; i++) {
    const struct claim *c = &claims->claim[i];
    const struct view v = claim_view(m, c);
    const char *statement = claim_get(c, "statement");
    const struct statement_record *r = statement ? view_record(&v, statement) : NULL;
    if (r && r->rank == RANK_ERRATA)
      return claim_mistake(c, "statement", d,
                           "a correction of %s stands in its place: the claim needs the equation number of that record",
                           statement);
  }
  return true;
}

/* --- Controls --- */

/* The least number of a record's formulas that is written with a negative exponent, 1e-90; 0: none is. */
static double least_size(const struct statement_record *r) {
  double least = 0;
  for (int i = 0; i < r->n_stmts; i++) {
    const char *text = r->src->text, *end = text + r->stmts[i]->span.end;
    for (const char *s = text + r->stmts[i]->span.begin; s + 1 < end; s++) {
      bool starts = *s >= '0' && *s <= '9' && !(s[-1] >= '0' && s[-1] <= '9') && s[-1] != '.' && s[-1] != '_';
      double size = starts ? strtod(s, NULL) : 0;
      bool exponent = starts && memchr(s, 'e', strspn(s, "0123456789.e")) != NULL;
      if (exponent && size > 0 && (least == 0 || size < least)) least = size;
    }
  }
  return least;
}

/* A control that is wrong by a small number says near what, up to a factor of 1000. */
static bool check_near(const struct model *m, const struct claims *controls, struct diag *d) {
  for (size_t i = 0; i < controls->n; i++) {
    const struct claim *c = &controls->claim[i];
    const char *near = claim_get(c, "near");
    double size = 0, says = near ? strtod(near, NULL) : 0;
    for (size_t k = 0; k < m->n_records; k++)
      if (m->records[k].rank == RANK_CONTROL && strcmp(m->records[k].record->id_name, c->id) == 0)
        size = least_size(&m->records[k]);
    if (size == 0 || (size <= says && says <= 1000 * size)) continue;
    return claim_mistake(c, near ? "near" : "claim", d, "its formula is wrong by %g, and it says near: %s", size,
                         near ? near : "nothing");
  }
  return true;
}

static bool check_kind_controls(const struct claims *claims, const struct claims *controls, struct diag *d) {
  const struct claim *one[N_KINDS] = {NULL};
  int have[N_KINDS + 1] = {0};
  for (size_t i = claims->n; i-- > 0;) one[claim_kind(&claims->claim[i])] = &claims->claim[i];
  for (size_t i = 0; i < controls->n; i++) {
    const struct claim *c = claim_named(claims, record_get(controls->claim[i].record, "claim"));
    have[c ? claim_kind(c) : N_KINDS]++;
  }
  for (int k = 0; k < N_KINDS; k++) {
    if (!one[k] || have[k] >= claim_kinds[k].controls) continue;
    return claim_mistake(one[k], "kind", d,
                         "claims of kind %s, such as this, have %d controls, and must have %d: write them in controls",
                         claim_kinds[k].word, have[k], claim_kinds[k].controls);
  }
  return true;
}

/* What a correction in a claim's own file is, and by what kind of claim it is judged: "repaired of notation by law". */
static bool correction_sort(char out[96], const struct claims *claims, const struct claim *c) {
  static const char *const kept[] = {"repaired-range", "repaired", "repair"};
  const struct claim *by = claim_named(claims, claim_get(c, "repaired-as"));
  for (size_t i = 0; i < sizeof kept / sizeof *kept; i++) {
    if (!claim_get(c, kept[i])) continue;
    snprintf(out, 96, "%s%s of %s by %s", claim_get(c, "reads") ? "reads, " : "", kept[i], claim_kind_of(c)->word,
             by && claim_kind_of(by) ? claim_kind_of(by)->word : "itself");
    return true;
  }
  return false;
}

/* Each sort of correction is made wrong by some control. */
static bool check_correction_controls(const struct claims *claims, const struct claims *controls, size_t a,
                                      struct diag *d) {
  char wanted[96], has[96];
  if (!correction_sort(wanted, claims, &claims->claim[a])) return true;
  for (size_t i = 0; i < controls->n; i++) {
    const struct claim *c = claim_named(claims, record_get(controls->claim[i].record, "claim"));
    if (c && record_get(controls->claim[i].record, "of") && correction_sort(has, claims, c) && strcmp(has, wanted) == 0)
      return true;
  }
  return claim_mistake(&claims->claim[a], strstr(wanted, "range") ? "repaired-range" : "repaired", d,
                       "no control makes a correction of this sort wrong (%s)", wanted);
}

bool records_counted(const struct record_file *f, struct diag *d) {
  const struct field *count = record_field(&f->records[0], "count");
  long n = (long)f->n_records - 1, said = count ? strtol(count->text, NULL, 10) : -1;
  if (said == n) return true;
  if (!count)
    return diag_at(d, &f->src, 0, "the file begins with \"count: N\", the number of its records; here %ld", n);
  return diag_at(d, &f->src, count->value.begin, "there are %ld records in this file, not %ld", n, said);
}

bool claims_keep_rules(const struct model *m, const struct claims *claims, const struct claims *controls,
                       struct diag *d) {
  bool ok = true;
  for (size_t i = 0; ok && i < claims->n; i++)
    ok = claim_keeps_rules(m, &claims->claim[i], d) && check_turned(claims, &claims->claim[i], d);
  for (size_t i = 0; ok && i < claims->n_results; i++) ok = check_formula(m, &claims->result[i], d);
  for (size_t i = 0; ok && i < controls->n_files; i++) ok = records_counted(controls->files[i], d);
  ok = ok && check_near(m, controls, d) && check_kind_controls(claims, controls, d);
  for (size_t i = 0; ok && i < claims->n; i++) ok = check_correction_controls(claims, controls, i, d);
  return ok && check_errata(m, claims, d) && check_own_text(m, claims, d) && check_replaced(m, d) &&
         check_corrections(m, d) && check_graph(m, claims, d);
}
