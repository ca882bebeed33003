/* What became of the damages: the one score, its rows, and what survived, since each survivor asks for a check or an
   argument. */
#include "mutation.h"

#include "escape.h"
#include "sheet.h"

/* --- JSON --- */

static void write_row(struct json *j, const char *key, const struct mutation_row *r) {
  JSON_OBJECT(j, key);
  if (!key) json_string(j, "name", r->name);
  json_long(j, "total", mutation_row_total(r));
  for (int i = 0; i < N_MUTANT_FATES; i++) json_long(j, mutant_fate_name[i], r->count[i]);
}

static void write_rows(struct json *j, const char *key, const struct mutation_row *row, size_t n) {
  JSON_EACH (j, key, i, n) write_row(j, NULL, &row[i]);
}

static SHAPE(survivor, survivor, WORD_MEMBER("fate", survivor, fate, MEMBER_NEEDED, mutant_fate_name, N_MUTANT_FATES),
             NEEDED(survivor, kind, file), LONGS(survivor, line, column), NEEDED(survivor, record),
             NULLABLE(survivor, equation), NEEDED(survivor, original, text, was, now, read_by),
             MEMBER(MEMBER_BOOL, MEMBER_NEEDED, "corrected_elsewhere", survivor, corrected));

static void tell_class(struct json *j, const char *key, const void *record) {
  json_string(j, key, damage_classes[((const struct damaged *)record)->class].words);
}

static SHAPE(damaged, damaged, TOLD("class", tell_class),
             WORD_MEMBER("fate", damaged, fate, MEMBER_NEEDED, mutant_fate_name, N_MUTANT_FATES), NEEDED(damaged, file),
             LONGS(damaged, line), NEEDED(damaged, record, attribute, was, now, says));

SHAPE(mutation_score_shape, mutation_score,
      LONGS(mutation_score, counted, noticed, formulas, equivalent, on_motions, needs_text, errata));

void report_mutation_json(struct text *out, const struct mutation_result *r) {
  struct mutation_score score;
  mutation_score_of(&score, r);
  OWNED(json) j = json_document(out, MUTATION_SCHEMA);
  json_string(&j, "scene", r->scene);
  json_string(&j, "subject", r->subject);
  json_printf(&j, "seed", "%llu", r->seed);
  json_string(&j, "text", r->text);
  json_long(&j, "population", r->population);
  json_long(&j, "tried", r->tried);
  shape_write(&j, "score", &mutation_score_shape, &score);
  write_row(&j, "formulas", &r->formulas);
  write_row(&j, "corrected_elsewhere", &r->printed);
  write_row(&j, "errata", &r->errata);
  write_rows(&j, "files", r->file, r->n_files);
  write_rows(&j, "kinds", r->kind, r->n_kinds);
  write_rows(&j, "classes", r->data, N_DAMAGE_CLASSES);
  JSON_EACH (&j, "survivors", i, r->n_survivors) shape_write(&j, NULL, &survivor, &r->survivor[i]);
  JSON_EACH (&j, "damages", i, r->n_damaged) shape_write(&j, NULL, &damaged, &r->damaged[i]);
}

/* --- For people --- */

static const char *const fate_says[N_MUTANT_FATES] = {
    [FATE_EQUIVALENT] = "Survivors that are equivalent to the original",
    [FATE_ON_MOTIONS] = "Survivors that say the same on every motion of the word",
    [FATE_UNDECIDED] = "Survivors that may be different: no claim that reads them changes its verdict",
    [FATE_UNREAD] = "Survivors in statements that no claim reads",
};

/* The columns of the tables behind those of all rows, and the fates that stand in them. */
struct columns {
  int n;
  const char *words[N_MUTANT_FATES];
  enum mutant_fate fate[N_MUTANT_FATES];
};
static const struct columns of_formulas = {
    7,
    {"of them unreadable", "of them unproved", "of them refused", "equivalent", "same on motions", "undecided",
     "unread"},
    {FATE_UNREADABLE, FATE_UNPROVED, FATE_REFUSED, FATE_EQUIVALENT, FATE_ON_MOTIONS, FATE_UNDECIDED, FATE_UNREAD}};
static const struct columns of_data = {
    5,
    {"of them refused", "of them unreadable", "same by rule", "needs the text", "not noticed"},
    {FATE_REFUSED, FATE_UNREADABLE, FATE_EQUIVALENT, FATE_NEEDS_TEXT, FATE_UNDECIDED}};

static void add_row(struct text *out, const struct mutation_row *r, const struct columns *c) {
  text_printf(out, "| %s | %ld | %ld |", r->name, mutation_row_total(r), mutation_row_noticed(r));
  for (int i = 0; i < c->n; i++) text_printf(out, " %ld |", r->count[c->fate[i]]);
  text_add_char(out, '\n');
}

static void add_table(struct text *out, const char *heading, const struct columns *c, const struct mutation_row *row,
                      size_t n) {
  markdown_head_of(out, heading, c->words, c->n);
  for (size_t i = 0; i < n; i++)
    if (mutation_row_total(&row[i])) add_row(out, &row[i], c);
  text_add_char(out, '\n');
}

/* Survivors of one fate stand together by statement; next of the same statement and fate after i, or n. */
static size_t group_end(const struct mutation_result *r, size_t i) {
  size_t k = i + 1;
  while (k < r->n_survivors && r->survivor[k].record == r->survivor[i].record &&
         r->survivor[k].original == r->survivor[i].original)
    k++;
  return k;
}

static bool is_chosen(const struct survivor *s, enum mutant_fate f, bool corrected) {
  return s->fate == f && s->corrected == corrected;
}

static long chosen(const struct mutation_result *r, size_t from, size_t to, enum mutant_fate f, bool corrected) {
  long n = 0;
  for (size_t i = from; i < to; i++) n += is_chosen(&r->survivor[i], f, corrected);
  return n;
}

static void add_statement(struct text *out, const struct survivor *s, long n) {
  text_printf(out, "`%s`: %ld (%s:%ld, %s%s%s%s%s)", s->original, n, s->file, s->line, s->record,
              s->equation ? ", equation " : "", s->equation ? s->equation : "", *s->read_by ? ", read by " : "",
              s->read_by);
}

/* Every statement with survivors of one fate, each with their texts when asked for. */
static void list_survivors(struct text *out, const struct mutation_result *r, enum mutant_fate f, bool corrected,
                           bool texts) {
  for (size_t i = 0, end; i < r->n_survivors; i = end) {
    end = group_end(r, i);
    long n = chosen(r, i, end, f, corrected);
    if (n == 0) continue;
    text_add(out, "- ");
    add_statement(out, &r->survivor[i], n);
    text_add_char(out, '\n');
    for (size_t k = i; texts && k < end; k++) {
      const struct survivor *s = &r->survivor[k];
      if (is_chosen(s, f, corrected)) text_printf(out, "  - %ld:%ld %s: `%s`\n", s->line, s->column, s->kind, s->text);
    }
  }
}

static void add_summary(struct text *out, const struct mutation_result *r) {
  struct mutation_score s;
  mutation_score_of(&s, r);
  text_printf(out, "%ld of %ld damages that change a meaning are noticed", s.noticed, s.counted);
  text_printf(out, " (%ld of %ld of formulas)", mutation_row_noticed(&r->formulas), s.formulas);
  text_printf(out, "; left out: %ld that are proved or known to mean the same, %ld the same on every motion, ",
              s.equivalent, s.on_motions);
  text_printf(out, "%ld that only the paper's text can tell, %ld of errata.eq", s.needs_text, s.errata);
}

/* The texts of what no claim reads, and of printed text that is refuted anyway, are in mutation.json alone. */
static void add_survivors(struct text *out, const struct mutation_result *r, enum mutant_fate f, bool corrected) {
  long n = chosen(r, 0, r->n_survivors, f, corrected);
  if (n == 0) return;
  text_printf(out, "## %s%s (%ld)\n\n", corrected ? "Printed text that the errata correct: " : "", fate_says[f], n);
  list_survivors(out, r, f, corrected, f != FATE_UNREAD && !corrected);
  text_add_char(out, '\n');
}

static const enum mutant_fate survivor_order[] = {FATE_UNDECIDED, FATE_UNREAD, FATE_ON_MOTIONS, FATE_EQUIVALENT};
enum { N_SURVIVOR_FATES = sizeof survivor_order / sizeof *survivor_order };

static void add_damaged(struct text *out, const struct damaged *g) {
  text_printf(out, "- %s:%ld, %s%s%s: `%s` for `%s`", g->file, g->line, *g->record ? g->record : "scene",
              *g->attribute ? ", " : "", g->attribute, g->now, g->was);
  if (*g->says) text_printf(out, ": %s", g->says);
  text_add_char(out, '\n');
}

/* Those of a class that nothing noticed, the first ones; and examples of the others. */
static void list_damaged(struct text *out, const struct mutation_result *r, int class) {
  enum { MOST = 20 };
  long left = r->data[class].count[FATE_UNDECIDED], listed = 0;
  if (mutation_row_total(&r->data[class]) == 0) return;
  text_printf(out, "## %s\n\n", damage_classes[class].words);
  for (size_t i = 0; i < r->n_damaged; i++)
    if (r->damaged[i].class == (enum damage_class) class && r->damaged[i].fate != FATE_UNDECIDED)
      add_damaged(out, &r->damaged[i]);
  if (left) text_printf(out, "\nNot noticed (%ld):\n\n", left);
  for (size_t i = 0; i < r->n_damaged; i++)
    if (r->damaged[i].class == (enum damage_class) class && r->damaged[i].fate == FATE_UNDECIDED && listed++ < MOST)
      add_damaged(out, &r->damaged[i]);
  if (left > MOST) text_printf(out, "- and %ld more, in mutation.json\n", left - MOST);
  text_add_char(out, '\n');
}

/* The file of that name. */
extern const char mutation_explained_md[];

void report_mutation_markdown(struct text *out, const struct mutation_result *r) {
  size_t begin = out->len;
  text_add(out, "# Would the audit have noticed?\n\n");
  add_summary(out, r);
  text_printf(out, ".\n\n%ld of %ld damages, scene %s, seed %llu. ", r->tried, r->population, r->scene, r->seed);
  if (r->text) text_printf(out, "Quotations were looked for in the paper's text (`%s`). ", r->text);
  text_add(out, mutation_explained_md);
  add_table(out, "what is damaged|damages:|noticed:", &of_data, r->data, N_DAMAGE_CLASSES);
  struct mutation_row texts[] = {r->formulas, r->printed, r->errata};
  add_table(out, "formulas|damages:|noticed:", &of_formulas, texts, 3);
  add_table(out, "file|damages:|noticed:", &of_formulas, r->file, r->n_files);
  add_table(out, "one token|damages:|noticed:", &of_formulas, r->kind, r->n_kinds);
  for (int k = 0; k < N_DAMAGE_CLASSES; k++) list_damaged(out, r, k);
  for (int c = 0; c < 2; c++)
    for (int i = 0; i < N_SURVIVOR_FATES; i++) add_survivors(out, r, survivor_order[i], c);
  escape_tags(out, begin);
}

/* Name, noticed, how many: left out are those that say the same or need the text. */
static void print_row(struct text *out, const struct mutation_row *r) {
  if (mutation_row_total(r) == 0) return;
  text_printf(out, "%-20s %5ld of %5ld noticed", r->name, mutation_row_noticed(r), mutation_row_counted(r));
  long left = mutation_row_total(r) - mutation_row_counted(r);
  if (left) text_printf(out, ", %ld left out", left);
  text_add_char(out, '\n');
}

/* Where each of those that were asked for (--count) went. */
static void account_for_formulas(struct text *out, const struct mutation_result *r) {
  const struct mutation_row *f = &r->formulas;
  long errata = mutation_row_total(&r->errata), noticed = mutation_row_noticed(f), counted = mutation_row_counted(f);
  text_printf(out, "%ld damages of formulas: %ld noticed, %ld not noticed, %ld left out, %ld of errata.eq\n",
              mutation_row_total(f) + errata, noticed, counted - noticed, mutation_row_total(f) - counted, errata);
}

void report_mutation_text(struct text *out, const struct mutation_result *r) {
  for (int i = N_SURVIVOR_FATES; i-- > 0;) {
    enum mutant_fate f = survivor_order[i];
    if (chosen(r, 0, r->n_survivors, f, false) == 0) continue;
    text_printf(out, "%s:\n", fate_says[f]);
    list_survivors(out, r, f, false, f == FATE_UNDECIDED);
  }
  for (size_t i = 0; i < r->n_files; i++) print_row(out, &r->file[i]);
  for (size_t i = 0; i < r->n_kinds; i++) print_row(out, &r->kind[i]);
  print_row(out, &r->errata);
  for (int k = 0; k < N_DAMAGE_CLASSES; k++) print_row(out, &r->data[k]);
  account_for_formulas(out, r);
  add_summary(out, r);
  text_add_char(out, '\n');
}
