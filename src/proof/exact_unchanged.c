/* Does a formula feel how another is read?  Both readings are put in full, but for local Jacobians that are the same in
   both, which are held as unknowns: then a result that is proved equal is equal whatever they are. */
#include <stdlib.h>
#include <string.h>

#include "exact_proof.h"
#include "value/expression.h"
#include "value/local_maps.h"

static bool is_moved(const struct exact_change *c, const char *name) {
  for (int i = 0; i < c->n_moved; i++)
    if (strcmp(c->moved[i], name) == 0) return true;
  return false;
}

/* The first reading's value of a quantity that the change moves is another unknown. */
static int bind_moved(fmpz_mpoly_q_struct *z, struct exact_field *f, const char *name, void *arg) {
  char other[64];
  if (!is_moved(arg, name)) return exact_symbol(z, f, name);
  snprintf(other, sizeof other, "%s moved", name);
  return exact_symbol(z, f, other);
}

static bool reads_moved(const struct exact_change *c, const struct tape *t) {
  for (slong i = 0; i < t->n_inputs; i++)
    if (is_moved(c, t->inputs[i])) return true;
  return false;
}

static bool same_element(const struct exact_change *c, const struct tape *a, const struct tape *b) {
  enum { TERMS = 1500 };
  struct exact_field *f = exact_field_new(NULL, 0);
  struct calc w = exact_calc(f);
  struct num_vec x, y;
  exact_field_limit(f, TERMS);
  exact_field_bind(f, bind_moved, (void *)(uintptr_t)c);
  int s = exact_eval(&x, &w, f, a);
  exact_field_bind(f, NULL, NULL);
  s |= exact_eval(&y, &w, f, b);
  bool same = s == SS_OK && x.len == y.len;
  for (slong i = 0; same && i < x.len; i++) same = exact_equal(f, num_vec_at(&x, i), num_vec_at(&y, i));
  calc_clear(&w);
  exact_field_free(f);
  return same;
}

/* The local Jacobians that are the same formulas in both readings, and do not feel what is moved. */
static int common_jacobians(struct override *o, const struct exact_change *c) {
  int n = 0;
  for (int ph = 0; ph < N_PHASES; ph++) {
    const struct local_map *map = &local_maps[ph];
    struct tape a, b;
    bool ok = formula_tape(&a, c->first, map->name, "stability", NULL, 0);
    ok = formula_tape(&b, c->second, map->name, "stability", NULL, 0) && ok;
    if (ok && tape_same(&a, &b) && !reads_moved(c, &a)) o[n++] = (struct override){map->name, map->rows, map->cols};
    tape_clear(&b);
    tape_clear(&a);
  }
  return n;
}

static bool same_with(const struct exact_change *c, const char *formula, const char *section, const struct override *o,
                      int n) {
  struct tape a, b;
  bool ok = formula_tape(&a, c->first, formula, section, o, n);
  ok = formula_tape(&b, c->second, formula, section, o, n) && ok;
  bool same = ok && same_element(c, &a, &b);
  tape_clear(&b);
  tape_clear(&a);
  return same;
}

bool exact_unchanged(const struct exact_change *c, const char *formula, const char *section) {
  struct override o[N_PHASES];
  int n = common_jacobians(o, c);
  if (same_with(c, formula, section, o, n)) return true;
  for (int i = 0; i < n; i++) { /* one of them in full */
    struct override left[N_PHASES];
    int m = 0;
    for (int k = 0; k < n; k++)
      if (k != i) left[m++] = o[k];
    if (m == n - 1 && same_with(c, formula, section, left, m)) return true;
  }
  return false;
}
