/* Sentences about form: ranges of indices, definitions. */
#include "judge.h"
#include <string.h>

/* --- Index ranges --- */

enum { MOST_INDEX = 9 };

/* A range of the indices of a letter, as a text claims it. */
struct index_range {
  const char *letter;
  int low, high;
  int size;                  /* rows of the model's matrix of that letter */
  bool used[MOST_INDEX + 1]; /* as an index of some entry */
  struct text outside;       /* entries that have an index out of the range */
};

static void book_index(struct index_range *r, int index, bool *outside) {
  if (index <= MOST_INDEX) r->used[index] = true;
  *outside = *outside || index < r->low || index > r->high;
}

/* Books the names LETTER_ij in the tree, and the entries LETTER(t)[i,j]. */
static void book_entries(struct index_range *r, const struct expr *e) {
  size_t n = strlen(r->letter);
  bool beyond = false;
  if (e->kind == EXPR_INDEX && e->args[0]->name && strcmp(e->args[0]->name, r->letter) == 0)
    for (int i = 0; i < 2 * e->n_index; i++) book_index(r, e->index[i], &beyond);
  if (beyond) {
    text_add(&r->outside, r->outside.len ? ", " : "");
    expr_print(&r->outside, e);
  }
  if (e->kind == EXPR_SYM && strncmp(e->name, r->letter, n) == 0 && e->name[n] == '_') {
    const char *index = e->name + n + 1;
    bool outside = false, digits = strspn(index, "0123456789") == strlen(index) && *index;
    for (const char *p = index; digits && *p; p++) book_index(r, *p - '0', &outside);
    if (outside && !strstr(text_str(&r->outside), e->name))
      text_printf(&r->outside, "%s%s", r->outside.len ? ", " : "", e->name);
  }
  for (int i = 0; i < e->n_args; i++) book_entries(r, e->args[i]);
}

static bool range_ends(int *lo, int *hi, const char *text) {
  return text && sscanf(text, "%d %d", lo, hi) == 2;
}

/* What is wrong with the range, or NULL: entries outside it, indices that the matrix has not; and, of a correction,
   ends that no entry has. */
static const char *range_fault(struct index_range *r, struct judge *j, const struct statement_record *rec,
                               const struct view *view, bool smallest) {
  const char *fault = NULL;
  for (int k = 0; k < rec->n_stmts; k++) {
    const struct stmt *s = view_stated(view, rec, rec->stmts[k]).stmt;
    for (int i = 0; i < (s->kind == STMT_RELATION ? s->n_sides : 1); i++) book_entries(r, s->sides[i]);
  }
  if (r->outside.len)
    fault = result_str(j->out, "%s is used with an index outside %d..%d: %s", r->letter, r->low, r->high,
                       text_str(&r->outside));
  else if (r->low < 1 || r->high > r->size)
    fault = result_str(j->out, "%s has no index %d: it is a matrix of %d rows and columns", r->letter,
                       r->low < 1 ? r->low : r->size + 1, r->size);
  else if (smallest && (r->low > r->high || !r->used[r->low] || !r->used[r->high]))
    fault = result_str(j->out, "no entry of %s is used with the index %d", r->letter,
                       r->low > r->high || r->used[r->low] ? r->high : r->low);
  text_clear(&r->outside);
  return fault;
}

/* The model's matrix, a function of the time or not. */
static int rows_of(const char *letter) {
  char name[32];
  snprintf(name, sizeof name, "%.20s(t)", letter);
  const struct oracle *o = oracle_find(name);
  if (!o) o = oracle_find(letter);
  int rows = o ? o->rows : 0;
  return rows < MOST_INDEX ? rows : MOST_INDEX;
}

bool judge_index_range(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  const char *id = claim_get(c, "statement"), *repaired = claim_get(c, "repaired-range");
  const struct statement_record *rec = id ? view_record(&view, id) : NULL;
  struct index_range r = {.letter = claim_get(c, "letter")};
  if (!rec || !r.letter) return claim_error(j, c, "statement", "a record and a letter are needed");
  if (!range_ends(&r.low, &r.high, claim_get(c, "range"))) return claim_error(j, c, "range", "a range reads LOW HIGH");
  r.size = rows_of(r.letter);
  if (!r.size) return claim_error(j, c, "letter", "the model has no matrix of that name");
  const char *fault = range_fault(&r, j, rec, &view, false);
  bool any = false;
  for (int i = 0; i <= MOST_INDEX; i++) any = any || r.used[i];
  struct route_result w = counted_route("diagnostic", true, any && !fault, fault != NULL, 0);
  const char *found = fault;
  if (!fault)
    found = any ? result_str(j->out, "every index of %s lies in %d..%d", r.letter, r.low, r.high)
                : result_str(j->out, "no entry of %s is used", r.letter);
  finding_add_route(f, j->out, w, "printed", -1, NULL, found);
  f->verdict = verdict_of(&w, 1, true);
  struct index_range again = {.letter = r.letter, .size = r.size};
  if (fault && repaired) {
    if (!range_ends(&again.low, &again.high, repaired))
      return claim_error(j, c, "repaired-range", "a range reads LOW HIGH");
    fault = range_fault(&again, j, rec, &view, true);
    f->correction = result_str(j->out, "indices %d..%d", again.low, again.high);
    f->correction_verdict = fault ? VERDICT_REFUTED : VERDICT_PROVED;
    found = fault;
    if (!fault)
      found = result_str(j->out,
                         "this is the smallest range that contains every index used, and the model's %s has all its "
                         "entries",
                         r.letter);
    finding_state(f, j->out, "diagnostic", layer_name[LAYER_CORRECTED], -1, 1, NULL, found);
  }
  return true;
}

bool judge_definition(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  (void)j;
  (void)c;
  (void)view;
  f->verdict = VERDICT_DEFINITION;
  return true;
}
