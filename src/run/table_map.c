/* stability-map.tsv: which orbits there are over a plane of two parameters, and proved points of the boundaries.

   Each column of the plane is a line of explore/family.h, with a search at every point; on some columns and rows the
   changes of admissible orbits are enclosed as explore/bifurcate.h does it. */
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "explore/bifurcate.h"
#include "tables.h"
#include "value/solved.h"

enum { DIGITS = 6, STARTS = 65, LINES = 32, MOST_MARKS = 40, DECIMAL = 32 };

/* How many orbits of the word there are at a point; of these admissible ones; of these stable ones. */
struct cell {
  int orbits, admissible, stable;
  enum dyn_family_status status;
};
struct mark {
  enum dyn_change what;
  char low[DECIMAL], high[DECIMAL];
};
/* What one process finds on a column or row. */
struct line {
  int n_marks; /* those beyond the most are left out */
  struct mark mark[MOST_MARKS];
  struct cell cell[TABLE_MOST_SIDE]; /* of a column */
};

struct map {
  const struct scene *scene;
  const struct dyn_axis *axis; /* two: across, and up each column */
  slong every[2];              /* of the columns and rows, how far those with proved points are apart */
};

/* The parameters with that of one axis at its i-th value. */
static void set_params(fmpq params[N_PARAMS], const struct map *m, int axis, slong i) {
  for (int k = 0; k < N_PARAMS; k++) {
    fmpq_init(&params[k]);
    fmpq_set(&params[k], &m->scene->value[k]);
  }
  dyn_axis_q(&params[m->axis[axis].vary], &m->axis[axis], i);
}

static void count(struct cell *cell, const struct dyn_family *f, const struct dyn_family_point *p) {
  *cell = (struct cell){.orbits = (int)p->n, .status = p->status};
  for (slong i = 0; i < p->n; i++) {
    const struct dyn_member *m = &f->member[p->first + i];
    bool admissible = dyn_member_admissible(m) == TRUTH_TRUE;
    cell->admissible += admissible;
    cell->stable += admissible && m->stable == TRUTH_TRUE;
  }
}

static void fill_column(struct line *line, const struct map *m, const fmpq *params) {
  struct dyn_family_request q = {.params = params, .axis = &m->axis[1], .every = 1, .late = true};
  struct dyn_family f;
  scene_static_friction(q.u_r, m->scene);
  if (dyn_family_find(&f, &q, 0, m->axis[1].n) != SS_OK) abort(); /* the ends of both axes are in the domain */
  for (slong i = 0; i < f.n_points; i++) count(&line->cell[i], &f, &f.point[i]);
  dyn_family_clear(&f);
}

static bool admissible_beside(const struct dyn_bifurcation *b, const struct scene *s) {
  bool any = false;
  truth u[2];
  for (int side = 0; side < 2; side++)
    for (int i = 0; i < b->beside[side].n; i++)
      any |= b->beside[side].word[i] == TRUTH_TRUE && orbit_admissible(u, s, &b->beside[side].orbit[i]) == TRUTH_TRUE;
  return any;
}

static void write_decimal(char out[DECIMAL], const fmpq_t x, slong digits) {
  struct text t;
  text_init(&t);
  num_print_rational(&t, x, digits);
  strncpy(out, text_str(&t), DECIMAL - 1);
  text_clear(&t);
}

/* The changes along an axis. */
static void find_marks(struct line *line, const struct map *m, int axis, const fmpq *params) {
  const struct dyn_axis *a = &m->axis[axis];
  struct dyn_bifurcations list;
  const fmpq *u[2];
  fmpq_t from, to;
  fmpq_init(from);
  fmpq_init(to);
  dyn_axis_q(from, a, 0);
  dyn_axis_q(to, a, a->n - 1);
  scene_static_friction(u, m->scene);
  dyn_bifurcations_find(&list, params, a->vary, from, to, u, DIGITS, STARTS);
  for (slong i = 0; i < list.n && line->n_marks < MOST_MARKS; i++) {
    const struct dyn_bifurcation *b = &list.at[i];
    struct mark *mark = &line->mark[line->n_marks];
    if (!b->crosses || !admissible_beside(b, m->scene)) continue;
    mark->what = b->what;
    write_decimal(mark->low, &b->low, b->digits);
    write_decimal(mark->high, &b->high, b->digits);
    line->n_marks++;
  }
  dyn_bifurcations_clear(&list);
  fmpq_clear(to);
  fmpq_clear(from);
}

/* The columns, then the rows with proved points. */
static void make_line(void *result, size_t i, void *arg) {
  const struct map *m = arg;
  struct line *line = result;
  slong columns = m->axis[0].n, at = (slong)i < columns ? (slong)i : ((slong)i - columns) * m->every[1];
  bool row = (slong)i >= columns;
  fmpq params[N_PARAMS];
  set_params(params, m, row, at);
  *line = (struct line){.n_marks = 0};
  if (!row) fill_column(line, m, params);
  if (row || at % m->every[0] == 0) find_marks(line, m, !row, params);
  for (int k = 0; k < N_PARAMS; k++) fmpq_clear(&params[k]);
}

/* A value of an axis to six digits. */
static void add_value(struct text *body, const struct dyn_axis *a, slong i) {
  fmpq_t x;
  fmpq_init(x);
  dyn_axis_q(x, a, i);
  text_add_char(body, '\t');
  num_print_rational(body, x, DIGITS);
  fmpq_clear(x);
}

static void add_cells(struct text *body, const struct map *m, const struct line *line, slong column) {
  for (slong i = 0; i < m->axis[1].n; i++) {
    const struct cell *c = &line->cell[i];
    text_add(body, "cell");
    add_value(body, &m->axis[0], column);
    text_add(body, "\t-");
    add_value(body, &m->axis[1], i);
    text_printf(body, "\t-\t%d\t%d\t%d\t%s\n", c->orbits, c->admissible, c->stable, dyn_family_status_name[c->status]);
  }
}

static void add_marks(struct text *body, const struct map *m, const struct line *line, bool row, slong at) {
  for (int i = 0; i < line->n_marks; i++) {
    const struct mark *mark = &line->mark[i];
    text_add(body, dyn_change_id[mark->what]);
    if (row) text_printf(body, "\t%s\t%s", mark->low, mark->high);
    add_value(body, &m->axis[row], at);
    text_add(body, "\t-");
    if (!row) text_printf(body, "\t%s\t%s", mark->low, mark->high);
    text_add(body, "\t-\t-\t-\t-\n");
  }
}

static void add_heading(struct text *body, const struct map *m) {
  const char *x = scene_key_name[m->axis[0].vary], *y = scene_key_name[m->axis[1].vary];
  text_printf(body,
              "# The orbits of the word D-Gamma-H-C over %s and %s: at each cell how many there are, how many of these "
              "are admissible, and how many of these stable, in double precision with balls where a margin is thin; "
              "status ok, or what is open there.\n"
              "# Other rows: a change of an admissible orbit, enclosed with proof: along %s where %s_to is given, else "
              "along %s.  flip: tr J = -1; fold: tr J = 1; the others are conditions that cease to hold, as bifurcate "
              "names them.  No dimensions.\n"
              "what\t%s\t%s_to\t%s\t%s_to\torbits\tadmissible\tstable\tstatus\n",
              x, y, x, x, y, x, x, y, y);
}

bool table_of_map(struct audit_result *out, const struct scene *s, const struct dyn_axis axis[2], int jobs,
                  struct crew_tally *tally, struct diag *d) {
  struct map m = {.scene = s, .axis = axis};
  for (int i = 0; i < 2; i++) m.every[i] = (axis[i].n + LINES - 1) / LINES;
  size_t columns = (size_t)axis[0].n, all = columns + (size_t)((axis[1].n - 1) / m.every[1] + 1);
  struct line *line = ss_malloc(all * sizeof *line);
  struct text body;
  text_init(&body);
  tally->of = all;
  bool ok = crew_results(line, sizeof *line, all, jobs, make_line, &m, tally, d);
  add_heading(&body, &m);
  for (size_t i = 0; ok && i < columns; i++) add_cells(&body, &m, &line[i], (slong)i);
  for (size_t i = 0; ok && i < all; i++)
    add_marks(&body, &m, &line[i], i >= columns, i < columns ? (slong)i : (slong)(i - columns) * m.every[1]);
  if (ok) table_finish(out, "stability-map.tsv", &body);
  text_clear(&body);
  free(line);
  return ok;
}
