/* stability-map.tsv: which orbits there are over a plane of two parameters, and proved points of the boundaries.

   Each column of the plane is a line of explore/family.h, with a search at every point; on some columns and rows the
   changes of admissible orbits are enclosed as explore/bifurcate.h does it. */
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "explore/bifurcate.h"
#include "tables.h"
#include "value/solved.h"

enum { DIGITS = 6, STARTS = 65, LINES = 32, MOST_ROW = 160 };

/* The rows that one process makes: of a column's cells, or of the changes along a column or row. */
struct line {
  char rows[TABLE_MOST_SIDE * MOST_ROW];
};

struct map {
  const struct scene *scene;
  const struct dyn_axis *axis; /* two: across, and up each column */
  slong every[2];              /* of the columns and rows, how far those with proved points are apart */
  size_t columns[2];           /* how many there are, and how many of them with proved points */
};

/* A value of an axis to six digits. */
static void add_value(struct text *rows, const struct dyn_axis *a, slong i) {
  NUMBERS(fmpq, x);
  dyn_axis_q(x, a, i);
  text_add_char(rows, '\t');
  num_print_rational(rows, x, DIGITS);
}

/* How many orbits of the word there are at each point of a column; of these admissible ones; of these stable ones. */
static void add_cells(struct text *rows, const struct map *m, const fmpq *params, slong column) {
  struct dyn_family_request q = {.params = params, .axis = &m->axis[1], .every = 1, .late = true};
  OWNED(dyn_family) f;
  scene_static_friction(q.u_r, m->scene);
  if (dyn_family_find(&f, &q, 0, m->axis[1].n) != SS_OK) abort(); /* the ends of both axes are in the domain */
  for (slong i = 0; i < f.n_points; i++) {
    const struct dyn_family_point *p = &f.point[i];
    int admissible = 0, stable = 0;
    for (slong k = p->first; k < p->first + p->n; k++) {
      if (dyn_member_admissible(&f.member[k]) != TRUTH_TRUE) continue;
      admissible++;
      stable += f.member[k].stable == TRUTH_TRUE;
    }
    text_add(rows, "cell");
    add_value(rows, &m->axis[0], column);
    text_add(rows, "\t-");
    add_value(rows, &m->axis[1], i);
    text_printf(rows, "\t-\t%ld\t%d\t%d\t%s\n", (long)p->n, admissible, stable, dyn_family_status_name[p->status]);
  }
}

static bool admissible_beside(const struct dyn_bifurcation *b, const struct scene *s) {
  for (const struct dyn_beside *side = b->beside; side < b->beside + 2; side++)
    for (int i = 0; i < side->n; i++)
      if (side->word[i] == TRUTH_TRUE && orbit_admissible(NULL, s, &side->orbit[i]) == TRUTH_TRUE) return true;
  return false;
}

/* The changes along a column or row, as many as there is room for. */
static void add_changes(struct text *rows, const struct map *m, const fmpq *params, bool row, slong at) {
  const struct dyn_axis *a = &m->axis[!row];
  OWNED(dyn_bifurcations) list;
  NUMBERS(fmpq, from, to);
  dyn_axis_q(from, a, 0);
  dyn_axis_q(to, a, a->n - 1);
  struct dyn_line line = {.params = params, .vary = a->vary, .from = from, .to = to};
  scene_static_friction(line.u_r, m->scene);
  dyn_bifurcations_find(&list, &line, DIGITS, STARTS);
  for (slong i = 0; i < list.n && i < TABLE_MOST_SIDE; i++) {
    const struct dyn_bifurcation *b = &list.at[i];
    if (!b->crosses || !admissible_beside(b, m->scene)) continue;
    text_add(rows, dyn_change_id[b->what]);
    if (row) table_bracket(rows, b);
    add_value(rows, &m->axis[row], at);
    text_add(rows, "\t-");
    if (!row) table_bracket(rows, b);
    text_add(rows, "\t-\t-\t-\t-\n");
  }
}

/* First the cells of every column, then the changes along columns, then those along rows. */
static void make_line(void *result, size_t i, void *arg) {
  const struct map *m = arg;
  size_t cells = m->columns[0], marked = cells + m->columns[1];
  bool row = i >= marked;
  slong at = i < cells ? (slong)i : (slong)(i - (row ? marked : cells)) * m->every[row];
  OWNED(text) rows = {0};
  fmpq params[N_PARAMS];
  fmpq *own = table_params(params, m->scene, m->axis[row].vary);
  dyn_axis_q(own, &m->axis[row], at);
  if (i < cells)
    add_cells(&rows, m, params, at);
  else
    add_changes(&rows, m, params, row, at);
  if (rows.len >= sizeof(struct line)) abort(); /* the numbers of a row are short */
  memcpy(result, text_str(&rows), rows.len + 1);
  fmpq_clear(own);
}

static void add_heading(struct text *body, const struct map *m) {
  const char *x = scene_key_name[m->axis[0].vary], *y = scene_key_name[m->axis[1].vary];
  text_printf(body,
              "# The orbits of the word D-Gamma-H-C over %s and %s: at each cell how many there are, how many of these "
              "are admissible, and how many of these stable, in double precision with balls where a margin is thin; "
              "status ok, or what is open there.\n"
              "# Other rows: a change of an admissible orbit, enclosed with proof: along %s where %s_to is given, else "
              "along %s.  flip: tr J = -1; fold: tr J = 1; the others are conditions that cease to hold, as bifurcate "
              "names them.  " TABLE_UNITS "\n"
              "what\t%s\t%s_to\t%s\t%s_to\torbits\tadmissible\tstable\tstatus\n",
              x, y, x, x, y, x, x, y, y);
}

bool table_of_map(struct audit_result *out, const struct scene *s, const struct dyn_axis axis[2], int jobs,
                  struct crew_tally *tally, struct diag *d) {
  struct map m = {.scene = s, .axis = axis, .columns = {(size_t)axis[0].n}};
  for (int i = 0; i < 2; i++) m.every[i] = (axis[i].n + LINES - 1) / LINES;
  m.columns[1] = (size_t)((axis[0].n - 1) / m.every[0] + 1);
  tally->of = m.columns[0] + m.columns[1] + (size_t)((axis[1].n - 1) / m.every[1] + 1);
  FREED struct line *line = ss_malloc(tally->of * sizeof *line);
  struct text body = {0};
  bool ok = crew_results(line, sizeof *line, tally->of, jobs, make_line, &m, tally, d);
  add_heading(&body, &m);
  for (size_t i = 0; ok && i < tally->of; i++) text_add(&body, line[i].rows);
  table_finish(out, "stability-map.tsv", &body);
  return ok;
}
