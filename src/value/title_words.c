/* The words of titles: records by number or formula, lists, phases, and the places that "points" names. */
#include "names.h"
#include "sentence.h"
#include "title_impl.h"
#include <string.h>

/* --- Counts and lists --- */

static const char *const counts[] = {"two",   "three", "four", "five",   "six",   "seven",
                                     "eight", "nine",  "ten",  "eleven", "twelve"};
enum { N_COUNTS = sizeof counts / sizeof *counts };

void title_count(struct text *out, long n) {
  if (n == 1)
    text_add(out, "one");
  else if (n >= 2 && n < 2 + N_COUNTS)
    text_add(out, counts[n - 2]);
  else
    text_printf(out, "%ld", n);
}

bool title_is_count(const char *word, size_t len) {
  for (int i = 0; i < N_COUNTS; i++)
    if (word_is(word, len, counts[i])) return true;
  return false;
}

void title_list_clear(struct title_list *l) {
  for (size_t i = 0; i < sizeof l->item / sizeof *l->item; i++) text_clear(&l->item[i]);
}

static bool is_twice(const struct title_list *l, int i) {
  for (int k = 0; k < i; k++)
    if (strcmp(text_str(&l->item[k]), text_str(&l->item[i])) == 0) return true;
  return false;
}

struct text *title_list_next(struct title_list *l) {
  if (l->n == (int)(sizeof l->item / sizeof *l->item)) l->n--;
  struct text *t = &l->item[l->n++];
  text_reset(t);
  return t;
}

int title_list_write(struct text *out, struct title_list *l) {
  const struct text *once[sizeof l->item / sizeof *l->item];
  int n = 0;
  for (int i = 0; i < l->n; i++)
    if (l->item[i].len && !is_twice(l, i)) once[n++] = &l->item[i];
  for (int i = 0; i < n; i++) text_printf(out, "%s%s", list_joint(i, n, " and "), text_str(once[i]));
  return n;
}

int title_listed(struct text *out, const char *list, char between) {
  OWNED(title_list) l = {.n = 0};
  while (*list) {
    while (*list == ' ' || *list == between) list++;
    const char *end = strchr(list, between);
    size_t len = end ? (size_t)(end - list) : strlen(list);
    if (len) text_add_n(title_list_next(&l), list, len);
    list += len;
  }
  return title_list_write(out, &l);
}

bool title_is_plural(const char *text) {
  return strstr(text, " and ") != NULL || strstr(text, ", ") != NULL;
}

/* --- Phases --- */

const char *const phase_words[N_PHASES] = {"global stick", "slip-stick", "global slip", "stick-slip"};

void title_phases(struct text *out, const enum phase *phase, int n) {
  text_add(out, "the ");
  for (int i = 0; i < n; i++) text_printf(out, "%s%s", list_joint(i, n, " and "), phase_words[phase[i]]);
  text_add(out, n == 1 ? " phase" : " phases");
}

void title_phases_listed(struct text *out, const char *list) {
  enum { MOST = 16 };
  char name[MOST][CLAIM_NAME];
  enum phase phase[MOST];
  int n = 0, listed = claim_names_listed(name, MOST, list);
  for (int i = 0; i < listed; i++) {
    int ph = word_find(name[i], phase_name, N_PHASES);
    if (ph < N_PHASES) phase[n++] = (enum phase)ph;
  }
  title_phases(out, phase, n);
}

/* --- Places --- */

struct place {
  enum phase phase[N_PHASES];
  int n_phases;
  bool params, arcs, orbits, admissible, realistic, patched;
};

static void read_place(struct place *p, const char *points) {
  struct asked_points at;
  while ((points = claim_next_points(&at, points)) != NULL) {
    p->params = p->params || strcmp(at.word, "params") == 0;
    p->arcs = p->arcs || strcmp(at.word, "arcs") == 0 || strcmp(at.word, "flow") == 0;
    p->orbits = p->orbits || strcmp(at.word, "orbits") == 0;
    p->admissible = p->admissible || strcmp(at.word, "admissible") == 0;
    p->realistic = p->realistic || strcmp(at.word, "realistic") == 0;
    p->patched = p->patched || strcmp(at.word, "patched") == 0;
    int ph = word_find(at.phase, phase_name, N_PHASES);
    bool known = ph == N_PHASES;
    for (int i = 0; i < p->n_phases; i++) known = known || (int)p->phase[i] == ph;
    if (!known) p->phase[p->n_phases++] = (enum phase)ph;
  }
}

/* Is a statement of the record said for some time?  Then in which phase each such is; N_PHASES: not one alone. */
static bool one_range(enum phase *phase, const struct statement_record *r) {
  int n = 0;
  for (int k = 0; k < r->n_stmts; k++) {
    if (!r->stmts[k]->range_hi || r->stmts[k]->range_signs) continue;
    enum phase said = name_of_range(r->stmts[k]);
    *phase = n++ && said != *phase ? N_PHASES : said;
  }
  return n > 0;
}

bool title_range(enum phase *phase, const struct title *t) {
  const char *id = claim_get(t->c, "statement");
  const struct statement_record *r = id ? title_judged(t, id, strlen(id)) : NULL;
  return r && one_range(phase, r);
}

void title_place(struct text *out, const struct title *t, const char *points) {
  struct place p = {.n_phases = 0};
  read_place(&p, points);
  if (t->m->system && title_range(p.phase, t)) p.n_phases = *p.phase < N_PHASES;
  const char *of = p.realistic    ? "every realistic orbit"
                   : p.admissible ? "every admissible orbit"
                   : p.arcs       ? NULL
                   : p.patched    ? "motions from any initial state"
                   : p.orbits     ? "periodic solutions"
                                  : NULL;
  if (p.n_phases == N_PHASES)
    text_add(out, " in every phase");
  else if (p.n_phases) {
    text_add(out, " in ");
    title_phases(out, p.phase, p.n_phases);
  }
  if (of) text_printf(out, "%s%s", p.n_phases ? " of " : " on ", of);
  if (p.params && t->m->system) text_add(out, " for all parameters");
}

void title_domain(struct text *out, const struct title *t, const struct statement_record *r) {
  bool condition = false, names = false, chain = false;
  for (int k = 0; k < r->n_stmts; k++) {
    condition = condition || statement_is_condition(t->m, r, r->stmts[k]);
    names = names || stmt_any(r->stmts[k], expr_is_name, NULL);
    chain = chain || r->stmts[k]->n_sides > 2;
  }
  if (names) text_printf(out, " %s %s sides have values", condition ? "and" : "wherever", chain ? "all" : "both");
}

/* --- Records --- */

void title_no_record(const struct title *t, const char *attribute, const char *item) {
  int n = (int)strcspn(item, " "), id = (int)strcspn(item, "# ");
  const struct statement_record *r = title_record(t, item, (size_t)id);
  if (r && r->rank == RANK_USER)
    claim_mistake(t->c, attribute, t->d, "there is no %.*s: %s replaces %.*s and has no such statement or step", n,
                  item, r->src->name, id, item);
  else
    claim_mistake(t->c, attribute, t->d, "there is no record %.*s in the equation files%s", n, item,
                  record_field(t->c->record, attribute) ? "" : "; \"statement: ID\" says which record is judged");
}

bool title_defines(const struct model *m, const char *name, size_t len) {
  for (size_t i = 0; i < m->n_defs; i++)
    if (m->defs[i].rank <= RANK_USER && word_is(name, len, m->defs[i].name)) return true;
  return false;
}

const struct statement_record *title_record(const struct title *t, const char *id, size_t len) {
  const struct statement_record *best = NULL;
  for (size_t i = 0; i < t->m->n_records; i++) {
    const struct statement_record *r = &t->m->records[i];
    if (r->rank <= RANK_USER && word_is(id, len, r->id)) best = r;
  }
  return best;
}

const struct statement_record *title_judged(const struct title *t, const char *id, size_t len) {
  const struct statement_record *printed = title_record(t, id, len);
  const struct view v = claim_view(t->m, t->c);
  return printed ? view_record(&v, printed->id) : NULL;
}

static bool is_listed(const struct expr *first_order, const char *name) {
  bool listed = false;
  for (int i = 1; i < first_order->n_args; i++) listed = listed || strcmp(first_order->args[i]->name, name) == 0;
  return listed;
}

static bool has_other_perturbation(const struct expr *e, const struct expr *first_order) {
  if (e->kind == EXPR_SYM && name_of_tangent(e->name) >= 0) return !is_listed(first_order, e->name);
  for (int i = 0; i < e->n_args; i++)
    if (has_other_perturbation(e->args[i], first_order)) return true;
  return false;
}

/* Is it to first order in the perturbations, all that it contains and nothing else? */
static bool is_in_all(const struct title *t, const struct statement_record *r, const struct expr *first_order) {
  OWNED(elaboration) el;
  struct matrix m;
  struct diag d = {0};
  bool all = true;
  for (int i = 1; i < first_order->n_args; i++) all = all && name_of_tangent(first_order->args[i]->name) >= 0;
  elaboration_init(&el, claim_view(t->m, t->c), NULL, 0);
  if (all && elaborate(&m, &el, first_order->args[0], r->src, r->section, &d))
    for (int k = 0; k < m.rows * m.cols; k++) all = all && !has_other_perturbation(m.e[k], first_order);
  return all;
}

/* What holds of a formula beyond what it shows. */
static void restriction(struct text *out, const struct title *t, const struct statement_record *r,
                        const struct stmt *s) {
  const struct expr *first_order = NULL;
  for (int i = 0; i < s->n_sides && !first_order; i++)
    if (s->sides[i]->kind == EXPR_FIRST_ORDER) first_order = s->sides[i];
  if (s->range_signs) text_printf(out, " for %s = +1 and -1", s->range_var);
  if (first_order) text_add(out, " to first order");
  if (!first_order || is_in_all(t, r, first_order)) return;
  text_add(out, " in ");
  for (int i = 1, n = first_order->n_args; i < n; i++)
    text_printf(out, "%s%s", list_joint(i - 1, n - 1, " and "), first_order->args[i]->name);
}

/* Which of a record's statements: all, or those that are conditions of others, or the others. */
enum listed { ALL, CONDITIONS, SAID };

/* A record's statements as items of the list; the last one. */
static const struct stmt *list_formulas(struct title_list *l, const struct model *m, const struct statement_record *r,
                                        enum listed which) {
  const struct stmt *last = NULL;
  enum phase one = N_PHASES;
  one_range(&one, r);
  for (int k = 0; k < r->n_stmts; k++) {
    const struct stmt *s = r->stmts[k];
    if (s->kind == STMT_TRAJECTORY) continue;
    if (which != ALL && statement_is_condition(m, r, s) != (which == CONDITIONS)) continue;
    struct text *item = title_list_next(l);
    stmt_plain(item, s);
    if (s->range_hi && one == N_PHASES) stmt_print_range(item, s);
    last = s;
  }
  return last;
}

/* The same, written. */
static const struct stmt *write_formulas(struct text *out, const struct model *m, const struct statement_record *r,
                                         enum listed which) {
  OWNED(title_list) l = {.n = 0};
  const struct stmt *last = list_formulas(&l, m, r, which);
  title_list_write(out, &l);
  return last;
}

void title_formulas(struct text *out, const struct title *t, const struct statement_record *r) {
  const struct stmt *last = write_formulas(out, t->m, r, ALL);
  if (last) restriction(out, t, r, last);
}

void title_conditional(struct text *out, const struct title *t, const struct statement_record *r) {
  OWNED(text) conditions = {0};
  const struct stmt *last = write_formulas(out, t->m, r, SAID);
  if (write_formulas(&conditions, t->m, r, CONDITIONS)) text_add(out, " when ");
  text_add(out, text_str(&conditions));
  if (last) restriction(out, t, r, last);
}

void title_first_formula(struct text *out, const struct statement_record *r) {
  int k = 0;
  while (k < r->n_stmts && r->stmts[k]->kind == STMT_TRAJECTORY) k++;
  if (k < r->n_stmts) stmt_plain(out, r->stmts[k]);
}

static bool says_something(const struct statement_record *r) {
  for (int k = 0; k < r->n_stmts; k++)
    if (r->stmts[k]->kind == STMT_RELATION) return true;
  return false;
}

/* From *i on the next record of the paper under the number, those left out that another one of their id replaces. */
static const struct statement_record *next_under(size_t *i, const struct title *t, const char *number) {
  while (*i < t->m->n_records) {
    const struct statement_record *r = &t->m->records[(*i)++];
    if (strcmp(r->equation, number) == 0 && title_record(t, r->id, strlen(r->id)) == r) return r;
  }
  return NULL;
}

bool title_owns_number(const struct title *t, const struct statement_record *r) {
  const struct statement_record *other;
  for (size_t i = 0; *r->equation && (other = next_under(&i, t, r->equation)) != NULL;)
    if (strcmp(other->id, r->id) != 0 && says_something(other)) return false;
  return *r->equation != '\0';
}

const char *title_note(const struct statement_record *r, bool brief) {
  const char *note = record_get(r->record, "note");
  if (*r->equation || !note || note[0] != '(' || !char_is_digit(note[1])) return NULL;
  bool numbers = note[strlen(note) - 1] == ')';
  return numbers || (brief && !strchr(note, ',')) ? note : NULL;
}

void title_name(struct text *out, const struct title *t, const struct statement_record *r) {
  const char *note = title_note(r, false);
  if (note)
    text_add(out, note);
  else if (*r->equation)
    text_printf(out, "(%s)", r->equation);
  else
    title_formulas(out, t, r);
}

/* --- Items of arguments --- */

struct part {
  const struct statement_record *r;
  int statement, step; /* from 1; 0: all */
  enum phase phase;
};

/* "eq-59#1.2 C", without looking whether there is such a thing. */
static struct part parse_part(const struct title *t, const char *item) {
  struct cited at = {.statement = 0};
  claim_next_cited(&at, item);
  return (struct part){title_judged(t, at.id, strlen(at.id)), at.statement, at.step,
                       (enum phase)word_find(at.phase, phase_name, N_PHASES)};
}

static bool part_is_there(const struct part *p) {
  if (!p->r || p->statement < 0 || p->step < 0 || p->statement > p->r->n_stmts) return false;
  return p->statement == 0 ? p->r->n_stmts > 0 : p->step < p->r->stmts[p->statement - 1]->n_sides;
}

static bool read_part(struct part *p, const struct title *t, const char *attribute, const char *item) {
  *p = parse_part(t, item);
  bool ok = part_is_there(p);
  if (ok && p->phase == N_PHASES) p->phase = name_of_range(p->r->stmts[p->statement ? p->statement - 1 : 0]);
  if (!ok) title_no_record(t, attribute, item);
  return ok;
}

/* All records that state something under this number stand in the list. */
static bool number_is_listed(const struct title *t, const char *list, const struct statement_record *r) {
  struct cited at;
  const struct statement_record *other;
  for (size_t i = 0; (other = next_under(&i, t, r->equation)) != NULL;) {
    bool found = !says_something(other);
    for (const char *p = list; !found && (p = claim_next_cited(&at, p)) != NULL;)
      found = at.statement == 0 && strcmp(at.id, other->id) == 0;
    if (!found) return false;
  }
  return *r->equation != '\0';
}

/* The statements that an item means, as formulas. */
static void part_formulas(struct text *out, const struct title *t, const struct part *p) {
  if (p->statement == 0) {
    title_formulas(out, t, p->r);
    return;
  }
  struct stmt s = *p->r->stmts[p->statement - 1];
  if (p->step) {
    s.sides += p->step - 1;
    s.ops += p->step - 1;
    s.n_sides = 2;
  }
  stmt_plain(out, &s);
  if (s.range_hi && p->phase == N_PHASES) stmt_print_range(out, &s);
  restriction(out, t, p->r, &s);
}

/* By number, not as a formula. */
static bool is_numbered(const struct title *t, const struct part *p, const char *list, enum title_detail detail) {
  enum { SHORT = 16 };
  bool brief = detail != TITLE_FORMULAS, note = title_note(p->r, brief) != NULL;
  if (p->statement == 0 && (note || number_is_listed(t, list, p->r))) return true;
  if (!brief || !*p->r->equation || (p->step && detail == TITLE_BRIEF)) return false;
  if (detail == TITLE_NUMBERS) return true;
  OWNED(text) formulas = {0};
  part_formulas(&formulas, t, p);
  return formulas.len > SHORT;
}

static bool is_inequality(const struct stmt *s) {
  return s->kind == STMT_RELATION && s->ops[0] != REL_EQ;
}

/* How many of its statements are inequalities, or how many are not. */
static int count_kind(const struct statement_record *r, bool inequalities) {
  int n = 0;
  for (int k = 0; k < r->n_stmts; k++)
    n += r->stmts[k]->kind == STMT_RELATION && is_inequality(r->stmts[k]) == inequalities;
  return n;
}

/* "an inequality of (9)", "the first inequality of (53)" of two, "the inequalities of (9)" where the list has all that
   stand under the number, of what an item means. */
static void write_share(struct text *out, const struct title *t, const struct part *p, const char *list) {
  char item[64];
  bool inequality = is_inequality(p->r->stmts[p->statement ? p->statement - 1 : 0]);
  const struct statement_record *under;
  int has = 0, of = 0, before = 0;
  for (size_t i = 0; (under = next_under(&i, t, p->r->equation)) != NULL;) {
    if (under == p->r) before = of;
    of += count_kind(under, inequality);
  }
  for (int k = 0; k + 1 < p->statement; k++) before += is_inequality(p->r->stmts[k]) == inequality;
  for (const char *at = list; (at = claim_next_item(item, sizeof item, at)) != NULL;) {
    struct part other = parse_part(t, item);
    if (!part_is_there(&other) || other.r != p->r) continue;
    has += other.statement ? is_inequality(other.r->stmts[other.statement - 1]) == inequality
                           : count_kind(other.r, inequality);
  }
  const char *what = has > 1 ? (inequality ? "inequalities" : "equations") : inequality ? "inequality" : "equation";
  const char *article = has == of ? "the " : has > 1 ? "" : of > 2 ? "an " : before ? "the second " : "the first ";
  text_printf(out, "%s%s of (%s)", article, what, p->r->equation);
}

bool title_parts_scan(struct title_parts *p, const struct title *t, const char *attribute) {
  char item[64];
  const char *list = claim_get(t->c, attribute);
  for (const char *at = list; (at = claim_next_item(item, sizeof item, at)) != NULL;) {
    struct part part;
    if (!read_part(&part, t, attribute, item)) return false;
    if (is_numbered(t, &part, list, p->detail) || part.phase == N_PHASES) continue;
    p->several = p->several || (p->one != N_PHASES && p->one != part.phase);
    p->one = part.phase;
  }
  return true;
}

/* All that the item states are equations. */
static bool is_equation(const struct part *p) {
  bool all = true;
  for (int k = 0; k < p->r->n_stmts; k++)
    if (p->statement == 0 || k == p->statement - 1) all = all && !is_inequality(p->r->stmts[k]);
  return all;
}

static bool is_wanted(const struct part *p, enum title_items items) {
  return items == TITLE_ALL || is_equation(p) == (items == TITLE_EQUATIONS);
}

bool title_has_premises(const struct title *t, enum title_items items) {
  char item[64];
  bool found = false;
  for (const char *at = claim_get(t->c, "premises"); (at = claim_next_item(item, sizeof item, at)) != NULL;) {
    struct part part = parse_part(t, item);
    found = found || (part_is_there(&part) && is_wanted(&part, items));
  }
  return found;
}

static bool takes_time(const struct expr *e, const void *arg) {
  (void)arg;
  return e->kind == EXPR_CALL && e->args[0]->kind == EXPR_SYM && strcmp(e->args[0]->name, "t") == 0;
}

bool title_moves(const struct title *t, const char *attribute) {
  char item[64];
  struct part part;
  if (!claim_next_item(item, sizeof item, claim_get(t->c, attribute)) || !read_part(&part, t, attribute, item))
    return false;
  return stmt_any(part.r->stmts[part.statement ? part.statement - 1 : 0], takes_time, NULL);
}

/* All inequalities, or none, and not all that stands under the number. */
static bool is_a_share(const struct title *t, const struct statement_record *r, const char *list) {
  return !number_is_listed(t, list, r) && (count_kind(r, true) == 0 || count_kind(r, false) == 0);
}

static void write_numbered(struct text *out, const struct title *t, const struct part *p, const char *list,
                           enum title_detail detail) {
  const char *note = title_note(p->r, detail != TITLE_FORMULAS);
  if (note)
    text_add(out, note);
  else if (detail != TITLE_NUMBERS && (p->statement || is_a_share(t, p->r, list)))
    write_share(out, t, p, list);
  else
    text_printf(out, "(%s)", p->r->equation);
}

bool title_parts_write(struct text *out, struct title_parts *p, const struct title *t, const char *attribute) {
  OWNED(title_list) l = {.n = 0};
  char item[64];
  const char *list = claim_get(t->c, attribute);
  bool ok = true;
  for (const char *at = list; ok && (at = claim_next_item(item, sizeof item, at)) != NULL;) {
    struct part part;
    if (!(ok = read_part(&part, t, attribute, item))) break;
    if (!is_wanted(&part, p->items)) continue;
    bool numbered = is_numbered(t, &part, list, p->detail);
    bool with_phase = !numbered && p->several && part.phase != N_PHASES;
    if (!numbered && part.statement == 0 && !with_phase) { /* one by one */
      list_formulas(&l, t->m, part.r, ALL);
      continue;
    }
    struct text *to = title_list_next(&l);
    if (numbered)
      write_numbered(to, t, &part, list, p->detail);
    else
      part_formulas(to, t, &part);
    if (!with_phase) continue;
    text_add(to, " in ");
    title_phases(to, &part.phase, 1);
  }
  title_list_write(out, &l);
  return ok;
}

/* --- Formulas of attributes --- */

bool title_formula(struct text *out, const struct title *t, const char *attribute) {
  LOCAL(arena, a);
  struct diag unread = {0};
  if (!claim_get(t->c, attribute)) return false;
  const char *text = claim_formula(&a, t->m, t->c, attribute);
  OWNED(source) src;
  source_from_string(&src, attribute, text);
  const struct span all = {0, src.len};
  const struct expr *e = expr_parse(&a, &src, all, &unread);
  diag_init(&unread);
  const struct stmt *s = e ? NULL : stmt_parse(&a, &src, all, &unread);
  size_t abs = src.len > 5 && strncmp(text, "abs(", 4) == 0 ? 4 : 0;
  if (e)
    expr_plain(out, e);
  else if (s)
    stmt_plain(out, s);
  else if (abs) /* of what is no number: it cannot be read, but must be shown */
    text_printf(out, "|%.*s|", (int)(src.len - abs - 1), text + abs);
  else
    text_add(out, text);
  return true;
}
