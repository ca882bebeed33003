/* stickslip jacobian --phases: every entry of the local Jacobians by every method, so that a wrong one is located. */
#include <string.h>

#include "base/json.h"
#include "cli.h"

enum { MATRIX_J = N_MATRICES - 1 };

static void matrix_worst(arb_t worst, const struct jacobian_matrix *a, int c) {
  jacobian_accuracy(worst, a->entry[c], a->rows * a->cols);
}

/* --- The table --- */

static void pad(struct text *out, size_t from, size_t width) {
  while (out->len < from + width) text_add_char(out, ' ');
}

/* Has the entry a digit that is known, or is it near zero?  A 0 for what is only not known would be read as a value.
   Fewer digits can be undecided where more are known: one of 3.5. */
static bool is_told(const struct jacobian_matrix *a, int c, int e, slong digits) {
  const double near = 1e-3;
  const arb_struct *x = a->entry[c] + e;
  if (!a->known[c]) return false;
  if (arb_contains_zero(x)) return mag_cmp_2exp_si(arb_radref(x), 0) < 0 && mag_get_d(arb_radref(x)) < near;
  OWNED(text) digit = {0};
  bool told = false;
  for (slong n = 1; n <= digits && !told; n++) told = num_print(&digit, x, n) == SS_OK;
  return told;
}

/* A cell: the digits that are known, ? where there is none, and a star where the method departs. */
static void add_cell(struct text *out, const struct jacobian_matrix *a, int c, int e, slong digits) {
  if (!a->known[c]) {
    text_add_char(out, '-');
    return;
  }
  if (is_told(a, c, e, digits))
    print_known(out, a->entry[c] + e, digits);
  else
    text_add_char(out, '?');
  if (a->departs[c][e]) text_add_char(out, '*');
}

static size_t column_width(const struct jacobian_phases *p, int c, slong digits) {
  OWNED(text) cell = {0};
  size_t width = strlen(jacobian_columns[c].heading);
  for (int i = 0; i < N_MATRICES; i++)
    for (int e = 0; e < p->matrix[i].rows * p->matrix[i].cols; e++) {
      text_reset(&cell);
      add_cell(&cell, &p->matrix[i], c, e, digits);
      if (cell.len > width) width = cell.len;
    }
  return width + 2;
}

static void add_rows(struct text *out, const struct jacobian_matrix *a, const size_t *width, slong digits) {
  for (int e = 0; e < a->rows * a->cols; e++) {
    size_t from = out->len;
    text_printf(out, "%s[%d,%d]", a->name, e / a->cols + 1, e % a->cols + 1);
    pad(out, from, 10);
    for (int c = 0; c < N_COLUMNS; c++) {
      from = out->len;
      add_cell(out, a, c, e, digits);
      if (c + 1 < N_COLUMNS) pad(out, from, width[c]);
    }
    text_add_char(out, '\n');
  }
}

/* The worst accuracy of a column over all matrices that it has. */
static void add_accuracies(struct text *out, const struct jacobian_phases *p, const size_t *width) {
  NUMBERS(arb, worst, x);
  text_add(out, "accuracy  ");
  for (int c = 0; c < N_COLUMNS; c++) {
    size_t from = out->len;
    bool any = false;
    arb_zero(worst);
    for (int i = 0; i < N_MATRICES; i++) {
      if (!p->matrix[i].known[c]) continue;
      any = true;
      matrix_worst(x, &p->matrix[i], c);
      arb_max(worst, worst, x, 64);
    }
    if (any)
      print_accuracy(out, worst);
    else
      text_add_char(out, '-');
    if (c + 1 < N_COLUMNS) pad(out, from, width[c]);
  }
  text_add_char(out, '\n');
}

/* "printed departs from the others at J_f[1,1], ..." for each method that does. */
static void add_summary(struct text *out, const struct jacobian_phases *p) {
  bool any = false;
  for (int c = 0; c < N_COLUMNS; c++) {
    const char *sep = " departs from the other methods at ";
    bool named = false;
    for (int i = 0; i < N_MATRICES; i++) {
      const struct jacobian_matrix *a = &p->matrix[i];
      for (int e = 0; e < a->rows * a->cols; e++) {
        if (!a->departs[c][e]) continue;
        text_printf(out, "%s%s%s[%d,%d]", named ? "" : jacobian_columns[c].heading, sep, a->name, e / a->cols + 1,
                    e % a->cols + 1);
        sep = ", ";
        named = any = true;
      }
    }
    if (named) text_add_char(out, '\n');
  }
  if (!any) text_add(out, "no entry departs: the methods agree within the accuracies that they state\n");
}

static const char *why_left_out(int c) {
  return jacobian_columns[c].method == METHOD_ODE ? "nearby motions under Coulomb's law do otherwise"
                                                  : "the events or the values could not be had there";
}

static void add_left_out(struct text *out, const struct jacobian_phases *p) {
  for (int c = 0; c < N_COLUMNS; c++) {
    const char *sep = " leaves out ";
    bool named = false;
    for (int i = 0; i < N_MATRICES; i++) {
      if (p->matrix[i].known[c]) continue;
      text_printf(out, "%s%s%s", named ? "" : jacobian_columns[c].heading, sep, p->matrix[i].name);
      sep = ", ";
      named = true;
    }
    if (named) text_printf(out, ": %s\n", why_left_out(c));
  }
}

/* A method whose J has the eigenvalues: implicit differentiation, or the first that is known. */
static int column_of_j(const struct jacobian_phases *p) {
  const struct jacobian_matrix *a = &p->matrix[MATRIX_J];
  for (int c = 0; c < N_COLUMNS; c++)
    if (a->known[c] && jacobian_columns[c].method == METHOD_IMPLICIT) return c;
  for (int c = 0; c < N_COLUMNS; c++)
    if (a->known[c]) return c;
  return -1;
}

static void phases_text(struct text *out, const struct jacobian_phases *p, const struct scene *s,
                        const struct jacobian_request *q) {
  size_t width[N_COLUMNS];
  text_printf(out, "%s, ", s->name);
  print_orbit_at(out, q, s);
  text_add(out, ": local Jacobians of the phases and J of the period\n          ");
  for (int c = 0; c < N_COLUMNS; c++) {
    size_t from = out->len;
    width[c] = column_width(p, c, q->digits);
    text_add(out, jacobian_columns[c].heading);
    if (c + 1 < N_COLUMNS) pad(out, from, width[c]);
  }
  text_add_char(out, '\n');
  for (int i = 0; i < N_MATRICES; i++) add_rows(out, &p->matrix[i], width, q->digits);
  add_accuracies(out, p, width);
  add_summary(out, p);
  add_left_out(out, p);
  if (q->at_printed)
    text_add(out,
             "printed and corrected stand at the printed times, the others find the events of the printed start\n");
}

/* --- JSON --- */

static void entry_json(struct json *w, const struct jacobian_matrix *a, int e, slong digits) {
  NUMBERS(arb, radius);
  JSON_OBJECT(w, NULL);
  json_long(w, "row", e / a->cols + 1);
  json_long(w, "col", e % a->cols + 1);
  json_object(w, "values");
  for (int c = 0; c < N_COLUMNS; c++) {
    if (!a->known[c]) continue;
    JSON_OBJECT(w, jacobian_columns[c].name);
    json_number(w, "value", is_told(a, c, e, digits) ? a->entry[c] + e : NULL, digits);
    jacobian_accuracy(radius, a->entry[c] + e, 1);
    JSON_STRING(w, "accuracy", print_accuracy(w->out, radius));
  }
  json_end_object(w);
  JSON_EACH (w, "departs", c, N_COLUMNS)
    if (a->departs[c][e]) json_string(w, NULL, jacobian_columns[c].name);
}

/* The members of a matrix's object. */
static void matrix_json(struct json *w, const struct jacobian_matrix *a, slong digits) {
  json_string(w, "name", a->name);
  if (a->phase) json_string(w, "phase", a->phase);
  json_long(w, "rows", a->rows);
  json_long(w, "cols", a->cols);
  JSON_EACH (w, "entries", e, a->rows * a->cols) entry_json(w, a, e, digits);
}

static void eigenvalues_json(struct json *w, const struct jacobian_phases *p, slong digits) {
  int c = column_of_j(p);
  if (!json_or_null(w, "eigenvalues", c >= 0)) return;
  const arb_struct *j = p->matrix[MATRIX_J].entry[c];
  struct text gsl[2] = {{0}, {0}};
  ARB_VECTOR(x, 2);
  jacobian_invariants(x, x + 1, j);
  json_object(w, "eigenvalues");
  json_string(w, "of", jacobian_columns[c].name);
  if (json_or_null(w, "exact", arb_is_zero(x + 1))) {
    json_array(w, "exact");
    json_string(w, NULL, "0");
    json_number(w, NULL, x, digits);
    json_end_array(w);
  }
  if (json_or_null(w, "gsl", print_eigenvalues(gsl, j))) {
    JSON_EACH (w, "gsl", i, 2) json_string(w, NULL, text_str(&gsl[i]));
  }
  json_end_object(w);
  for (int i = 0; i < 2; i++) text_clear(&gsl[i]);
}

static void accuracy_json(struct json *w, const struct jacobian_phases *p) {
  const struct jacobian_matrix *a = &p->matrix[MATRIX_J];
  NUMBERS(arb, worst);
  JSON_OBJECT(w, "accuracy");
  for (int c = 0; c < N_COLUMNS; c++) {
    if (!a->known[c]) continue;
    matrix_worst(worst, a, c);
    JSON_STRING(w, jacobian_columns[c].name, print_accuracy(w->out, worst));
  }
}

static void left_out_json(struct json *w, const struct jacobian_phases *p) {
  JSON_EACH (w, "left_out", i, N_MATRICES)
    for (int c = 0; c < N_COLUMNS; c++) {
      if (p->matrix[i].known[c]) continue;
      JSON_OBJECT(w, NULL);
      json_string(w, "name", p->matrix[i].name);
      json_string(w, "method", jacobian_columns[c].name);
      json_string(w, "why", why_left_out(c));
    }
}

static void phases_json(struct text *out, const struct jacobian_phases *p, const struct scene *s,
                        const struct jacobian_request *q) {
  OWNED(json) w = json_document(out, NULL);
  json_string(&w, "scene", s->name);
  json_at(&w, q);
  JSON_EACH (&w, "phases", i, MATRIX_J) {
    JSON_OBJECT(&w, NULL);
    matrix_json(&w, &p->matrix[i], q->digits);
  }
  json_object(&w, "period");
  matrix_json(&w, &p->matrix[MATRIX_J], q->digits);
  json_end_object(&w);
  eigenvalues_json(&w, p, q->digits);
  accuracy_json(&w, p);
  left_out_json(&w, p);
}

void show_phases(const struct options *o, const struct model *m, const struct scene *s,
                 const struct jacobian_request *q, struct diag *d) {
  LOCAL(jacobian_phases, p);
  struct text out = {0};
  bool ok = audit_phases(&p, m, s, q, d);
  if (ok && option(o, OPT_JSON)) phases_json(&out, &p, s, q);
  if (ok && !option(o, OPT_JSON)) {
    int c = column_of_j(&p);
    phases_text(&out, &p, s, q);
    if (c >= 0) eigenvalues_text(&out, "of J ", p.matrix[MATRIX_J].entry[c], q->digits);
  }
  print_text(&out);
}
