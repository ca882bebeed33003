/* The files of a report.  audit.json comes first; every other one is written from what is read back out of it and from the
   tables beside it, by verify as by `stickslip report`, which therefore writes the same bytes. */
#include <string.h>
#include <unistd.h>

#include "cli.h"
#include "report/report.h"

/* Pictures that other commands leave beside reports; those that are there are linked to. */
static const struct neighbour pictures_beside[] = {{"../bench/map.svg", "error against run time of one Poincare map"},
                                                   {"../bench/jacobian.svg", "of its Jacobian"},
                                                   {"../bench/orbit.svg", "of the periodic orbit"},
                                                   {"../bench/verdicts.svg", "what verdicts cost"},
                                                   {"../stability/map-1.svg", "where formulas lose digits (1)"},
                                                   {"../stability/map-2.svg", "(2)"},
                                                   {"../stability/map-3.svg", "(3)"},
                                                   {"../stability/map-4.svg", "(4)"}};
enum { N_BESIDE = sizeof pictures_beside / sizeof *pictures_beside };

static size_t find_neighbours(struct neighbour found[N_BESIDE], const char *folder) {
  size_t n = 0;
  struct text path;
  text_init(&path);
  for (size_t i = 0; i < N_BESIDE; i++) {
    text_reset(&path);
    join_path(&path, folder, pictures_beside[i].path);
    if (access(text_str(&path), R_OK) == 0) found[n++] = pictures_beside[i];
  }
  text_clear(&path);
  return n;
}

/* Everything that shows what audit.json and its tables hold. */
static void add_views(struct output *out, struct audit_result *r) {
  static const struct {
    const char *name;
    void (*write)(struct text *out, const struct audit_result *r);
  } view[] = {{"audit.md", report_markdown}, {"audit.csv", report_csv},         {"claims.dot", report_dot},
              {"errata.md", report_errata},  {"errata.tex", report_errata_tex}, {"index.html", report_html},
              {"junit.xml", report_junit}};
  struct mutation_score score;
  struct neighbour found[N_BESIDE];
  r->mutation = score_beside(&score, out->folder, r) ? &score : NULL;
  r->n_neighbours = find_neighbours(found, out->folder);
  r->neighbours = found;
  for (size_t i = 0; i < sizeof view / sizeof *view; i++) view[i].write(output_add(out, view[i].name), r);
  r->mutation = NULL; /* it ends with this function, as what follows */
  r->n_neighbours = 0;
  r->neighbours = NULL;
}

static const struct data_table *table_of(const struct audit_result *r, const char *name) {
  for (size_t i = 0; i < r->n_tables; i++)
    if (strcmp(r->tables[i].name, name) == 0) return &r->tables[i];
  return NULL;
}

bool output_add_report(struct output *out, const struct audit_result *r, struct diag *d) {
  struct audit_result again;
  struct source s;
  struct text *json = output_add(out, "audit.json");
  report_json(json, r);
  audit_result_init(&again);
  source_from_string(&s, "audit.json", text_str(json));
  bool ok = s.len <= LARGEST_AUDIT;
  if (!ok)
    diag_set(d, "%s: error: audit.json would have more than %d bytes, which no reader takes", r->scene, LARGEST_AUDIT);
  ok = ok && report_read(&again, &s, d);
  for (size_t i = 0; ok && i < again.n_tables; i++) again.tables[i].text = table_of(r, again.tables[i].name)->text;
  if (ok) add_views(out, &again);
  source_clear(&s);
  audit_result_clear(&again);
  return ok;
}

/* --- stickslip report --- */

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
  struct text path;
  struct source s;
  text_init(&path);
  join_path(&path, folder, t->name);
  bool ok = source_read(&s, text_str(&path), LARGEST_TABLE, d);
  if (ok) {
    ok = check_table(&s, d);
    t->text = arena_strndup(&r->arena, s.text, s.len);
    source_clear(&s);
  }
  text_clear(&path);
  return ok;
}

static bool read_report(struct audit_result *r, const char *folder, struct diag *d) {
  struct text path;
  struct source s;
  text_init(&path);
  join_path(&path, folder, "audit.json");
  bool ok = source_read(&s, text_str(&path), LARGEST_AUDIT, d);
  if (ok) {
    ok = report_read(r, &s, d);
    source_clear(&s);
  }
  for (size_t i = 0; ok && i < r->n_tables; i++) ok = read_table(r, &r->tables[i], folder, d);
  text_clear(&path);
  return ok;
}

int run_report(const struct options *o, const char *data) {
  (void)data;
  if (o->operands.n != 1) return usage("report takes one folder, as %s", "stickslip report reports/paper");
  struct diag d;
  struct audit_result r;
  struct output out;
  diag_init(&d);
  audit_result_init(&r);
  output_init(&out, o->operands.word[0]);
  bool ok = read_report(&r, o->operands.word[0], &d);
  if (ok) add_views(&out, &r);
  ok = ok && output_write(&out, &d);
  if (ok) verify_line(&r);
  output_clear(&out);
  audit_result_clear(&r);
  return ok ? EXIT_AS_RECORDED : bad_input(&d);
}
