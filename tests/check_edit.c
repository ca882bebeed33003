/* One-token edits: those of small statements, written down by hand from the list in edit.h; and what must hold of the
   edits of any statement, on every statement of the paper. */
#include "paper_model.h"
#include "power/mutants.h"
#include "test.h"

static const struct edit_word some_words[] = {
    {.name = "a", .rows = 1, .cols = 1, .plain = true},
    {.name = "b", .rows = 1, .cols = 1, .plain = true},
    {.name = "z_1a", .rows = 1, .cols = 1},
    {.name = "z_2a", .rows = 1, .cols = 1},
    {.name = "z'_1a", .rows = 1, .cols = 1},
    {.name = "M", .rows = 2, .cols = 2},
    {.name = "H", .rows = 2, .cols = 2, .function = true},
};
enum { N_WORDS = COUNT(some_words) };
static const char *const some_factors[] = {"b"};

/* The texts of one kind of edit, joined by " | "; factors are put in where they are asked for alone. */
static char *edits_as_text(const char *statement, enum edit_kind kind) {
  LOCAL(arena, a);
  OWNED(edits) e = {.n = 0};
  struct edit_word word[N_WORDS];
  struct text t = {0};
  OWNED(source) src = source_of("test", statement);
  text_add(&t, "");
  memcpy(word, some_words, sizeof word);
  const struct stmt *s;
  goes_well(s = stmt_parse(&a, &src, (struct span){0, src.len}, &d));
  for (int i = 0; i < N_WORDS; i++)
    for (int k = 0; k < s->n_sides; k++) word[i].here = word[i].here || stands_in_statement(s, word[i].name);
  struct edit_vocabulary v = {word, N_WORDS, some_factors, kind == EDIT_FACTOR};
  stmt_edits(&e, &a, s, &v);
  for (size_t i = 0; i < e.n; i++)
    if (e.edit[i].kind == kind) text_printf(&t, "%s%s", t.len ? " | " : "", e.edit[i].text);
  return t.data;
}

TABLE(by_hand, "tests/cases/edits.tsv", 3);
enum { KIND, STATEMENT, WANT }; /* its columns */

/* The items of a list in alphabetical order. */
static char *sorted(const char *list) {
  char *copy = strdup(list), *item[64];
  size_t n = 0;
  for (char *p = *copy ? copy : NULL; p; n++) {
    char *sep = strstr(p, " | ");
    ck_assert(n < 64);
    item[n] = p;
    if (sep) *sep = '\0';
    p = sep ? sep + 3 : NULL;
  }
  qsort(item, n, sizeof *item, word_compare);
  struct text t = {0};
  text_add(&t, "");
  for (size_t i = 0; i < n; i++) text_printf(&t, "%s%s", i ? " | " : "", item[i]);
  free(copy);
  return t.data;
}

TEST_EACH(edits_written_down_by_hand, by_hand.n) {
  char *const *row = by_hand.row[_i];
  int kind = word_find(row[KIND], edit_kind_name, N_EDIT_KINDS);
  FREED char *found = edits_as_text(row[STATEMENT], (enum edit_kind)kind);
  FREED char *got = sorted(found), *want = sorted(row[WANT]);
  ck_assert_msg(strcmp(got, want) == 0, "%s, %s:\n  %s\nnot\n  %s", row[STATEMENT], row[KIND], got, want);
}

TABLE(families, "tests/cases/edit_families.tsv", 3);
enum { NAME, OTHER, SAME }; /* its columns */

TEST_EACH(families_of_names, families.n) {
  char *const *row = families.row[_i];
  ck_assert_msg(edit_same_family(row[NAME], row[OTHER]) == is_yes(row[SAME]), "%s %s", row[NAME], row[OTHER]);
  ck_assert(edit_same_family(row[OTHER], row[NAME]) == is_yes(row[SAME]));
}

/* --- What holds of every edit --- */

static struct model papers;
static struct mutants population;

static void open_population(void) {
  papers = paper_model(NULL);
  mutants_init(&population, &papers, NULL, 0);
}

static void close_population(void) {
  mutants_clear(&population);
  model_clear(&papers);
}

static const struct expr *bare(const struct expr *e) {
  while (e->kind == EXPR_PAREN) e = e->args[0];
  return e;
}

/* Equality but for brackets, which printing puts in where a tree has none. */
static bool same_but_brackets(const struct expr *a, const struct expr *b) {
  a = bare(a);
  b = bare(b);
  bool same = a->kind == b->kind && a->order == b->order && a->exponent == b->exponent && a->rows == b->rows &&
              a->cols == b->cols && a->n_args == b->n_args && memcmp(a->index, b->index, sizeof a->index) == 0;
  if (same && a->name) same = strcmp(a->name, b->name) == 0;
  for (int i = 0; same && i < a->n_args; i++) same = same_but_brackets(a->args[i], b->args[i]);
  return same;
}

static bool same_statement(const struct stmt *a, const struct stmt *b,
                           bool (*same)(const struct expr *, const struct expr *)) {
  bool ok = a->n_sides == b->n_sides && a->largest == b->largest && !a->range_lo == !b->range_lo;
  for (int i = 0; ok && i < a->n_sides; i++) ok = same(a->sides[i], b->sides[i]);
  for (int i = 0; ok && i + 1 < a->n_sides; i++) ok = a->ops[i] == b->ops[i];
  return ok && (!a->range_lo || (same(a->range_lo, b->range_lo) && same(a->range_hi, b->range_hi)));
}

CASE("paper", .once = {open_population, close_population});

TEST(every_edit_is_a_statement_of_its_own) {
  long kinds[N_EDIT_KINDS] = {0};
  ck_assert_uint_gt(population.n, 5000);
  for (size_t i = 0; i < population.n; i++) {
    const struct mutant *m = &population.mutant[i];
    const struct target *t = &population.target[m->target];
    const struct statement_record *r = &papers.records[t->record];
    const struct stmt *original = r->stmts[t->stmt];
    kinds[m->edit.kind]++;
    ck_assert_msg(!same_statement(original, m->edit.stmt, expr_same), "%s", m->edit.text);
    ck_assert(m->edit.place.begin >= original->span.begin && m->edit.place.end <= original->span.end);
    ck_assert(m->edit.place.begin < m->edit.place.end && strcmp(m->edit.was, m->edit.now) != 0);
    LOCAL(arena, a);
    const struct stmt *again;
    OWNED(source) src = source_of("edit", m->edit.text);
    goes_well(again = stmt_parse(&a, &src, (struct span){0, src.len}, &d));
    ck_assert_msg(same_statement(again, m->edit.stmt, same_but_brackets), "%s", m->edit.text);
  }
  for (int k = 0; k < N_EDIT_KINDS; k++) ck_assert_msg(kinds[k] > 0, "no %s", edit_kind_name[k]);
}

TEST(no_edit_comes_twice_and_the_order_is_fixed) {
  OWNED(mutants) again;
  mutants_init(&again, &papers, NULL, 0);
  ck_assert_uint_eq(again.n, population.n);
  for (size_t i = 0; i < population.n; i++) {
    ck_assert_str_eq(again.mutant[i].edit.text, population.mutant[i].edit.text);
    for (size_t k = i + 1; k < population.n && population.mutant[k].target == population.mutant[i].target; k++)
      ck_assert_str_ne(population.mutant[k].edit.text, population.mutant[i].edit.text);
  }
}

CASE("edit");

/* Long statements: edits within the bounds, or none. */
TEST(long_statements_are_bounded) {
  static const int terms[] = {100, 199, 201, 20000};
  for (size_t i = 0; i < COUNT(terms); i++) {
    LOCAL(arena, a);
    OWNED(edits) e = {.n = 0};
    OWNED(source) src = source_of("long", nested("a + ", "a = b", "", (size_t)terms[i] - 1));
    struct edit_vocabulary v = {some_words, N_WORDS, some_factors, 1};
    const struct stmt *s;
    goes_well(s = stmt_parse(&a, &src, (struct span){0, src.len}, &d));
    stmt_edits(&e, &a, s, &v);
    ck_assert((e.n > 0) == (2 * terms[i] <= EDIT_MAX_NODES) && e.n <= EDIT_MAX);
  }
}
