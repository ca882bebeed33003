/* Jacobians of one period and of its phases. */
#include <stdlib.h>

#include "base/arena.h"
#include "library.h"

_Static_assert((int)SS_METHODS == N_METHODS && (int)SS_ODE == METHOD_ODE, "the order of the methods");
_Static_assert((int)SS_MATRICES == N_MATRICES, "the matrices");

enum { TRACE = 4, DET = 5, N_NUMBERS = 6 };

struct ss_jacobian {
  arb_ptr x; /* J, trace, det */
  struct ss_number number[N_NUMBERS];
};

struct ss_phases {
  struct jacobian_phases p;
  struct ss_number number[N_MATRICES][N_COLUMNS][MATRIX_MOST];
};

const char *ss_method_name(int method) {
  return method >= 0 && method < N_METHODS ? method_name[method] : NULL;
}

/* What is asked, of the scene's orbits or printed numbers; an SS_ status. */
static int ask(struct jacobian_request *q, const char *function, const struct ss_paper *p, const struct ss_scene *s,
               long at, size_t digits) {
  if (!p || !s) return library_argument(function, "no paper or no scene");
  if (at < SS_AT_PRINTED) return library_argument(function, "a place is an orbit, from 0, or SS_AT_PRINTED");
  *q = (struct jacobian_request){
      .at_printed = at == SS_AT_PRINTED, .orbit = at < 0 ? 0 : at, .digits = (slong)digits, .layer = LAYER_CORRECTED};
  int status = library_digits(function, digits, LIBRARY_DIGITS);
  return status ? status : library_point(s, true, false);
}

int ss_jacobian_find(ss_jacobian **out, const ss_paper *p, const ss_scene *s, int method, int layer, long at,
                     size_t digits) {
  struct jacobian_request q;
  struct diag d = {0};
  if (!out) return library_argument(__func__, "no place for the Jacobian");
  *out = NULL;
  if (!ss_method_name(method) || !ss_layer_name(layer))
    return library_argument(__func__, "no such method, or no such layer");
  int status = ask(&q, __func__, p, s, at, digits);
  if (status) return status;
  q.method = (enum jacobian_method)method;
  q.layer = (enum layer)layer;
  struct ss_jacobian *j = ss_malloc(sizeof *j);
  j->x = _arb_vec_init(N_NUMBERS);
  for (int i = 0; i < N_NUMBERS; i++) j->number[i] = (struct ss_number){j->x + i, NULL};
  if (audit_jacobian(j->x, j->x + TRACE, j->x + DET, &p->files.model, &s->s, &q, &d)) {
    *out = j;
    return SS_OK;
  }
  ss_jacobian_free(j);
  return library_input(&d);
}

void ss_jacobian_free(ss_jacobian *j) {
  if (!j) return;
  _arb_vec_clear(j->x, N_NUMBERS);
  free(j);
}

const ss_number *ss_jacobian_entry(const ss_jacobian *j, int row, int column) {
  return j && row >= 0 && row < 2 && column >= 0 && column < 2 ? &j->number[2 * row + column] : NULL;
}

const ss_number *ss_jacobian_trace(const ss_jacobian *j) {
  return j ? &j->number[TRACE] : NULL;
}

const ss_number *ss_jacobian_det(const ss_jacobian *j) {
  return j ? &j->number[DET] : NULL;
}

int ss_phases_find(ss_phases **out, const ss_paper *p, const ss_scene *s, long at, size_t digits) {
  struct jacobian_request q;
  struct diag d = {0};
  if (!out) return library_argument(__func__, "no place for the Jacobians");
  *out = NULL;
  int status = ask(&q, __func__, p, s, at, digits);
  if (status) return status;
  struct ss_phases *z = ss_malloc(sizeof *z);
  jacobian_phases_init(&z->p);
  if (!audit_phases(&z->p, &p->files.model, &s->s, &q, &d)) {
    ss_phases_free(z);
    return library_input(&d);
  }
  for (int m = 0; m < N_MATRICES; m++)
    for (int c = 0; c < N_COLUMNS; c++)
      for (int i = 0; z->p.matrix[m].known[c] && i < z->p.matrix[m].rows * z->p.matrix[m].cols; i++)
        z->number[m][c][i] = (struct ss_number){z->p.matrix[m].entry[c] + i, NULL};
  *out = z;
  return SS_OK;
}

void ss_phases_free(ss_phases *z) {
  if (!z) return;
  jacobian_phases_clear(&z->p);
  free(z);
}

const char *ss_phases_column(int column) {
  return column >= 0 && column < N_COLUMNS ? jacobian_columns[column].name : NULL;
}

static const struct jacobian_matrix *matrix_of(const struct ss_phases *z, int matrix) {
  return z && matrix >= 0 && matrix < N_MATRICES ? &z->p.matrix[matrix] : NULL;
}

int ss_phases_rows(const ss_phases *z, int matrix) {
  return matrix_of(z, matrix) ? z->p.matrix[matrix].rows : 0;
}

int ss_phases_columns(const ss_phases *z, int matrix) {
  return matrix_of(z, matrix) ? z->p.matrix[matrix].cols : 0;
}

/* Where the entry stands; -1 where there is none. */
static int entry_of(const struct ss_phases *z, int matrix, int column, int i, int k) {
  const struct jacobian_matrix *m = matrix_of(z, matrix);
  if (!m || !ss_phases_column(column) || !m->known[column]) return -1;
  return i >= 0 && i < m->rows && k >= 0 && k < m->cols ? i * m->cols + k : -1;
}

const ss_number *ss_phases_entry(const ss_phases *z, int matrix, int column, int i, int k) {
  int at = entry_of(z, matrix, column, i, k);
  return at < 0 ? NULL : &z->number[matrix][column][at];
}

int ss_phases_departs(const ss_phases *z, int matrix, int column, int i, int k) {
  int at = entry_of(z, matrix, column, i, k);
  return at >= 0 && z->p.matrix[matrix].departs[column][at];
}
