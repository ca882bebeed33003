/* stickslip report: every file of a report again, from its audit.json and the tables beside it. */
#include "report/report.h"

#include "cli.h"

/* Pictures are drawn from few columns and some thousand rows. */
enum { LARGEST_TABLE = 4 << 20, MOST_COLUMNS = 64, MOST_ROWS = 50000 };

static bool check_table(const struct source *s, struct diag *d) {
  size_t columns = 0, rows = 0, most = 0;
  for (const char *c = s->text; *c; c++) {
    columns = *c == '\n' ? 0 : columns + (*c == '\t');
    if (columns > most) most = columns;
    rows += *c == '\n';
  }
  if (most >= MOST_COLUMNS || rows > MOST_ROWS)
    diag_set(d, "%s: error: a table of a picture has at most %d columns and %d rows", s->name, MOST_COLUMNS, MOST_ROWS);
  return most < MOST_COLUMNS && rows <= MOST_ROWS;
}

static bool read_table(struct audit_result *r, struct data_table *t, const char *folder, struct diag *d) {
  OWNED(source) s;
  if (!read_in(&s, folder, t->name, LARGEST_TABLE, d)) return false;
  bool ok = check_table(&s, d);
  t->text = arena_strndup(&r->arena, s.text, s.len);
  return ok;
}

static bool read_report(struct audit_result *r, const char *folder, struct diag *d) {
  OWNED(source) s;
  if (!read_in(&s, folder, "audit.json", LARGEST_AUDIT, d)) return false;
  bool ok = report_read(r, &s, d);
  for (size_t i = 0; ok && i < r->n_tables; i++) ok = read_table(r, &r->tables[i], folder, d);
  return ok;
}

int run_report(const struct options *o, const char *data, struct diag *d) {
  (void)data;
  LOCAL(audit_result, r);
  OWNED(output) out;
  output_init(&out, o->operands.word[0]);
  bool ok = read_report(&r, o->operands.word[0], d);
  struct mutation_score score;
  if (ok) output_add_views(&out, &r, score_beside(&score, o->operands.word[0], &r) ? &score : NULL);
  ok = ok && output_write(&out, d);
  if (ok) say_written(o, o->operands.word[0]);
  if (ok) verify_line(&r);
  return EXIT_AS_RECORDED;
}
