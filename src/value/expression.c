/* An expression in the paper's notation at a point, in balls. */
#include "expression.h"

#include <string.h>

#include "names.h"

bool expression_open(struct expression *x, struct view view, const char *expression, const char *section,
                     struct diag *d) {
  OWNED(elaboration) el;
  struct matrix m;
  *x = (struct expression){.n = 0};
  elaboration_init(&el, view, NULL, 0);
  bool ok = elaborate_text(&m, &el, expression, expression, section ? section : "", d) &&
            m.rows * m.cols <= EXPRESSION_MOST && elaboration_tape(&x->tape, &el, m.e, m.rows * m.cols, d);
  if (ok) x->rows = m.rows;
  if (ok) x->n = m.rows * m.cols;
  return ok;
}

void expression_clear(struct expression *x) {
  tape_clear(&x->tape);
}

const char *expression_undetermined(const struct expression *x) {
  const char *first = NULL;
  for (slong i = 0; i < x->tape.n_inputs && !first; i++) {
    const char *name = x->tape.inputs[i];
    bool limit = strcmp(name, "u_r1") == 0 || strcmp(name, "u_r2") == 0;
    if (limit || name_is_free(name) || name_goes_with_time(name)) first = name;
  }
  return first;
}

bool formula_tape(struct tape *t, struct view v, const char *formula, const char *section, const struct override *o,
                  int n) {
  OWNED(elaboration) el;
  struct matrix m;
  struct diag d = {0};
  elaboration_init(&el, v, o, n);
  return elaborate_tape(t, &m, &el, formula, formula, section, &d);
}

int tape_at_point(struct num_vec *out, bool *known, const struct tape *t, const struct point *p,
                  struct orbit_cache *cache) {
  OWNED(values) v;
  int s = values_init(&v, p, VARIANT_CLOSED, out->ctx, cache);
  const char *unbound = NULL;
  if (s == SS_OK) s = values_eval(out, &unbound, &v, t);
  *known = !unbound;
  return s;
}

int expression_value(arb_ptr out, const struct expression *x, const struct point *p, slong prec,
                     struct orbit_cache *cache) {
  OWNED(num_vec) res;
  bool known;
  num_vec_init(&res, x->n, num_ctx_arb(prec));
  int s = tape_at_point(&res, &known, &x->tape, p, cache);
  for (int i = 0; i < x->n; i++) arb_set(out + i, num_vec_at(&res, i));
  return s;
}

int expression_at(arb_ptr out, int *n, struct view view, const char *expression, const char *section,
                  const struct point *p, slong prec, struct orbit_cache *cache, struct diag *d) {
  OWNED(expression) x;
  bool ok = expression_open(&x, view, expression, section, d);
  *n = x.n;
  return ok ? expression_value(out, &x, p, prec, cache) : SS_UNABLE;
}

int expression_number(arb_t z, struct view view, const char *expression, const char *section, const struct point *p,
                      slong prec, struct orbit_cache *cache, struct diag *d) {
  OWNED(expression) x;
  bool ok = expression_open(&x, view, expression, section, d) && x.n == 1 && !expression_undetermined(&x);
  return ok ? expression_value(z, &x, p, prec, cache) : SS_UNABLE;
}
