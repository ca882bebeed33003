/* The paper's files, and formulas over them. */
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "library.h"
#include "value/expression.h"
#include "value/printed.h"

enum { MOST_DIGITS = 10000, MOST_BITS = 1 << 16 };

_Static_assert((int)SS_LAYERS == N_LAYERS && (int)SS_STABLE == LAYER_STABLE, "the order of the layers");

int ss_paper_open(ss_paper **out, const char *data) {
  struct diag d = {0};
  if (!out) return library_argument(__func__, "no place for the paper");
  *out = NULL;
  data = library_data(data);
  if (!data) return SS_INPUT;
  struct ss_paper *p = ss_malloc(sizeof *p);
  atomic_init(&p->holders, 1);
  paper_files_init(&p->files);
  if (paper_files_load(&p->files, data, NULL, NULL, &d)) {
    *out = p;
    return SS_OK;
  }
  ss_paper_free(p);
  return library_input(&d);
}

void ss_paper_free(ss_paper *p) {
  if (!p || atomic_fetch_sub(&p->holders, 1) > 1) return;
  paper_files_clear(&p->files);
  free(p);
}

const char *ss_layer_name(int layer) {
  return layer >= 0 && layer < N_LAYERS ? layer_name[layer] : NULL;
}

struct ss_formula {
  struct expression x;
  char *text;
  arb_ptr value; /* of the last evaluation; NULL before one */
  struct ss_number number[EXPRESSION_MOST];
};

int ss_formula_open(ss_formula **out, const ss_paper *p, int layer, const char *text, const char *section) {
  struct diag d = {0};
  if (!out) return library_argument(__func__, "no place for the formula");
  *out = NULL;
  if (!p || !text || !ss_layer_name(layer)) return library_argument(__func__, "no paper, layer or text");
  struct ss_formula *f = ss_malloc(sizeof *f);
  f->value = NULL;
  f->text = ss_strdup(text);
  if (expression_open(&f->x, (struct view){&p->files.model, (enum layer)layer, NULL, NULL}, text, section, &d)) {
    *out = f;
    return SS_OK;
  }
  if (!d.set) diag_set(&d, "%s: error: more than %d entries", __func__, EXPRESSION_MOST);
  ss_formula_free(f);
  return library_input(&d);
}

static void forget(struct ss_formula *f) {
  if (f->value) _arb_vec_clear(f->value, f->x.n);
  f->value = NULL;
}

void ss_formula_free(ss_formula *f) {
  if (!f) return;
  forget(f);
  expression_clear(&f->x);
  free(f->text);
  free(f);
}

int ss_formula_rows(const ss_formula *f) {
  return f ? f->x.rows : 0;
}

int ss_formula_columns(const ss_formula *f) {
  return f ? f->x.n / f->x.rows : 0;
}

int ss_formula_latex(char **out, const ss_formula *f) {
  struct text t = {0};
  if (!out) return library_argument(__func__, "no place for the text");
  *out = NULL;
  if (!f) return library_argument(__func__, "no formula");
  expr_latex_of(&t, f->text); /* which has been read before */
  *out = library_take(&t);
  return SS_OK;
}

/* What else has a value there.  The program's option for it is --at. */
static bool set_values(struct point *p, const char *values, struct diag *d) {
  struct diag of_option = {0};
  if (point_set(p, values, &of_option)) return true;
  const char *at = strstr(of_option.message, "--at ");
  return diag_set(d, "error: values %s", at ? at + strlen("--at ") : of_option.message);
}

/* Whether "name=" begins one of the items. */
static bool gives(const char *values, const char *name) {
  size_t len = strlen(name);
  for (const char *s = values; s; s = strchr(s, ','), s += s != NULL)
    if (strncmp(s, name, len) == 0 && s[len] == '=') return true;
  return false;
}

/* What no orbit and no parameter determines has a value only where one is given: a symbol that lacks it, or NULL. */
static const char *not_given(const struct tape *t, const char *values) {
  static const char *const needs[][2] = {{"t", "t"},       {"x", "x"},       {"y", "y"},       {"lambda", "lambda"},
                                         {"u_s1", "u_s1"}, {"u_s2", "u_s2"}, {"u_r1", "u_s1"}, {"u_r2", "u_s2"}};
  for (slong i = 0; i < t->n_inputs; i++)
    for (size_t k = 0; k < sizeof needs / sizeof *needs; k++)
      if (strcmp(t->inputs[i], needs[k][0]) == 0 && !gives(values, needs[k][1])) return needs[k][0];
  return NULL;
}

/* The place as a point; false with d set. */
static bool place(struct point *p, const struct scene *s, long at, const char *values, struct orbit_cache *cache,
                  struct diag *d) {
  for (int k = 0; k < N_SCENE_PARAMS; k++)
    if (s->given[k])
      fmpq_set(&p->q[Q_CHI + k], &s->value[k]);
    else
      fmpq_one(&p->q[Q_CHI + k]); /* an orbit has its own */
  if (at == SS_AT_PARAMETERS && !scene_has_forces(s))
    diag_set(d, "%.300s: error: SS_AT_PARAMETERS needs a scene that gives e1 and e2", s->path);
  else if (at == SS_AT_PRINTED && !printed_point(p, s))
    diag_set(d, "%.300s: error: the scene does not print the state and the times", s->path);
  else if (at >= 0 && at >= scene_orbits(s, cache)->n)
    scene_lacks_orbit(s, at, scene_orbits(s, cache)->n, d);
  if (d->set) return false;
  if (at >= 0) {
    p->kind = POINT_ORBIT;
    p->scene = s;
    p->orbit = at;
  }
  p->timed = true;
  return !values || set_values(p, values, d);
}

/* The precision doubles until every digit is known. */
static int evaluate(struct ss_formula *f, const struct point *p, slong digits, struct orbit_cache *cache) {
  f->value = _arb_vec_init(f->x.n);
  for (int i = 0; i < f->x.n; i++) f->number[i] = (struct ss_number){f->value + i, NULL};
  for (slong prec = FIRST_PREC + 4 * digits;; prec *= 2) {
    OWNED(num_vec) v;
    bool known;
    num_vec_init(&v, f->x.n, num_ctx_arb(prec));
    int status = tape_at_point(&v, &known, &f->x.tape, p, cache);
    for (int i = 0; i < f->x.n; i++) arb_set(f->value + i, num_vec_at(&v, i));
    if (!known) return library_fail(SS_INPUT, "ss_formula_evaluate: some symbol in it has no value there");
    if (status & SS_DOMAIN) return library_fail(SS_DOMAIN, "ss_formula_evaluate: it is not defined there");
    if (!status && num_has_digits(f->value, f->x.n, digits)) return SS_OK;
    if (2 * prec > MOST_BITS + 4 * digits)
      return library_fail(SS_UNABLE, "ss_formula_evaluate: %ld digits are not known at %ld bits", (long)digits,
                          (long)prec);
  }
}

int ss_formula_evaluate(ss_formula *f, const ss_scene *s, long at, const char *values, size_t digits) {
  struct diag d = {0};
  if (!f || !s || at < SS_AT_PARAMETERS) return library_argument(__func__, "no formula, scene or place");
  int status = library_digits(__func__, digits, MOST_DIGITS);
  if (!status) status = library_point(s, true, false);
  if (status) return status;
  const char *lacking = not_given(&f->x.tape, values);
  if (lacking) return library_fail(SS_INPUT, "%s: %s has no value there, nor is one given", __func__, lacking);
  struct orbit_cache *cache = orbit_cache_new();
  orbit_cache_complete(cache);
  LOCAL(point, p);
  forget(f);
  status = place(&p, &s->s, at, values, cache, &d) ? evaluate(f, &p, (slong)digits, cache) : library_input(&d);
  if (status & ~SS_UNABLE) forget(f);
  orbit_cache_free(cache);
  return status;
}

const ss_number *ss_formula_value(const ss_formula *f, int row, int column) {
  int columns = ss_formula_columns(f);
  if (!f || !f->value || row < 0 || row >= f->x.rows || column < 0 || column >= columns) return NULL;
  return &f->number[row * columns + column];
}
