/* What became of the damaged formulas: survivors first, since each asks for a check or an argument. */
#include "mutation.h"
#include "base/json.h"

/* --- JSON --- */

static void write_row(struct json *j, const char *key, const struct mutation_row *r) {
  json_object(j, key);
  if (!key) json_string(j, "name", r->name);
  json_long(j, "total", mutation_row_total(r));
  for (int i = 0; i < N_MUTANT_FATES; i++) json_long(j, mutant_fate_name[i], r->count[i]);
  json_end_object(j);
}

static void write_rows(struct json *j, const char *key, const struct mutation_row *row, size_t n) {
  json_array(j, key);
  for (size_t i = 0; i < n; i++) write_row(j, NULL, &row[i]);
  json_end_array(j);
}

static void write_survivor(struct json *j, const struct survivor *s) {
  json_object(j, NULL);
  json_string(j, "fate", mutant_fate_name[s->fate]);
  json_string(j, "kind", s->kind);
  json_string(j, "file", s->file);
  json_long(j, "line", (long)s->line);
  json_long(j, "column", (long)s->column);
  json_string(j, "record", s->record);
  json_string(j, "equation", s->equation);
  json_string(j, "original", s->original);
  json_string(j, "text", s->text);
  json_string(j, "was", s->was);
  json_string(j, "now", s->now);
  json_string(j, "read_by", s->read_by);
  json_bool(j, "corrected_elsewhere", s->corrected);
  json_end_object(j);
}

void report_mutation_json(struct text *out, const struct mutation_result *r) {
  struct json j;
  struct text seed;
  text_init(&seed);
  text_printf(&seed, "%llu", r->seed);
  json_init(&j, out);
  json_object(&j, NULL);
  json_string(&j, "schema", "stickslip-mutation-1");
  json_string(&j, "scene", r->scene);
  json_string(&j, "subject", r->subject);
  json_string(&j, "seed", text_str(&seed));
  json_long(&j, "population", r->population);
  json_long(&j, "tried", r->tried);
  write_row(&j, "total", &r->total);
  write_row(&j, "corrected_elsewhere", &r->printed);
  write_rows(&j, "files", r->file, r->n_files);
  write_rows(&j, "kinds", r->kind, r->n_kinds);
  json_array(&j, "survivors");
  for (size_t i = 0; i < r->n_survivors; i++) write_survivor(&j, &r->survivor[i]);
  json_end_array(&j);
  json_end_object(&j);
  text_clear(&seed);
}

/* --- For people --- */

static const char *const fate_says[N_MUTANT_FATES] = {
    [FATE_EQUIVALENT] = "Survivors that are equivalent to the original",
    [FATE_ON_MOTIONS] = "Survivors that say the same on every motion of the word",
    [FATE_UNDECIDED] = "Survivors that may be different: no claim that reads them changes its verdict",
    [FATE_UNREAD] = "Survivors in statements that no claim reads",
};

static void add_row(struct text *out, const struct mutation_row *r) {
  text_printf(out, "| %s | %ld | %ld |", r->name, mutation_row_total(r), mutation_row_noticed(r));
  for (int i = FATE_UNREADABLE; i < N_MUTANT_FATES; i++) text_printf(out, " %ld |", r->count[i]);
  text_add_char(out, '\n');
}

static void add_table(struct text *out, const char *heading, const struct mutation_row *row, size_t n) {
  text_printf(
      out,
      "| %s | mutants | noticed | of them unreadable | of them unproved | equivalent | same on motions | undecided | "
      "unread |\n| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
      heading);
  for (size_t i = 0; i < n; i++)
    if (mutation_row_total(&row[i])) add_row(out, &row[i]);
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
  text_printf(out, "`%s`: %ld (%s:%zu, %s%s%s%s%s)", s->original, n, s->file, s->line, s->record,
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
      if (is_chosen(s, f, corrected)) text_printf(out, "  - %zu:%zu %s: `%s`\n", s->line, s->column, s->kind, s->text);
    }
  }
}

static void add_summary(struct text *out, const struct mutation_result *r) {
  long total = mutation_row_total(&r->total), noticed = mutation_row_noticed(&r->total);
  text_printf(out, "%ld of %ld mutants noticed (%ld cannot be read, %ld lose no more than a proof)", noticed, total,
              r->total.count[FATE_UNREADABLE], r->total.count[FATE_UNPROVED]);
  text_printf(out, "; survivors: %ld equivalent, %ld the same on every motion, %ld undecided, %ld read by no claim",
              r->total.count[FATE_EQUIVALENT], r->total.count[FATE_ON_MOTIONS], r->total.count[FATE_UNDECIDED],
              r->total.count[FATE_UNREAD]);
  long printed = mutation_row_total(&r->printed);
  if (printed)
    text_printf(out, "; of the printed text that the errata correct %ld of %ld", mutation_row_noticed(&r->printed),
                printed);
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

void report_mutation_markdown(struct text *out, const struct mutation_result *r) {
  text_add(out, "# Would the audit have noticed?\n\n");
  add_summary(out, r);
  text_printf(
      out,
      ".\n\n%ld of %ld one-token damages of the formulas, scene %s, seed %llu. Each is put in place alone, and the "
      "claims that read the damaged formula are judged again until a verdict changes: a claim's, its "
      "correction's, or that of a claim it makes under a restriction. Claims that search (arguments, counts, lists of "
      "constraints, the criterion) are asked last and with little effort, in the same way as for the undamaged text; "
      "of "
      "an argument the exact proof must be found again, for without it the verdict cannot be \"proved\". Claims that "
      "simulate are not asked. Unreadable: the damaged text has a name, a shape or an index that cannot be, a symbol "
      "without a value where the formula is used, or a range that is no phase. Where the errata correct a formula, the "
      "corrected text is damaged, since everything else reads it; damage to the printed text it replaces is "
      "counted apart.\n\n"
      "Equivalent: the damaged statement, or everything that uses it, is proved to say the same, by "
      "rational functions in which sines and roots are unknowns. Same on motions: so with what defines the phases "
      "put in: velocities that are V at a switching time stand for one another, forces are at their limits, and "
      "perturbations of a velocity that stays V are zero, whatever they are multiplied by. Such a mutant still says "
      "something true of every motion of the word, though perhaps less, or by another name; a formula that is "
      "used off the motions too is tried there (claims with points \"patched\"), and an equation that says "
      "nothing shows in a claim that counts equations. The text of every survivor is in mutation.json.\n\n",
      r->tried, r->population, r->scene, r->seed);
  add_table(out, "file", r->file, r->n_files);
  add_table(out, "damage", r->kind, r->n_kinds);
  struct mutation_row both[] = {r->total, r->printed};
  add_table(out, "text", both, 2);
  for (int c = 0; c < 2; c++)
    for (int i = 0; i < N_SURVIVOR_FATES; i++) add_survivors(out, r, survivor_order[i], c);
}

void report_mutation_text(struct text *out, const struct mutation_result *r) {
  for (int i = N_SURVIVOR_FATES; i-- > 0;) {
    enum mutant_fate f = survivor_order[i];
    if (chosen(r, 0, r->n_survivors, f, false) == 0) continue;
    text_printf(out, "%s:\n", fate_says[f]);
    list_survivors(out, r, f, false, f == FATE_UNDECIDED);
  }
  for (size_t i = 0; i < r->n_files; i++)
    text_printf(out, "%-20s %5ld of %5ld noticed\n", r->file[i].name, mutation_row_noticed(&r->file[i]),
                mutation_row_total(&r->file[i]));
  for (size_t i = 0; i < r->n_kinds; i++)
    if (mutation_row_total(&r->kind[i]))
      text_printf(out, "%-20s %5ld of %5ld noticed\n", r->kind[i].name, mutation_row_noticed(&r->kind[i]),
                  mutation_row_total(&r->kind[i]));
  add_summary(out, r);
  text_add_char(out, '\n');
}
