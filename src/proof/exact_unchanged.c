/* Does a formula feel how another is read?  Both readings are put in full, but for local Jacobians that are the same in
   both, which are held as unknowns: then a result that is proved equal is equal whatever they are. */
#include "exact_proof.h"
#include "value/expression.h"
#include "value/local_maps.h"

static bool same_element(const struct tape *a, const struct tape *b) {
  enum { TERMS = 1500 };
  EXACT_FIELD f = exact_field_new(NULL, 0);
  exact_field_limit(f, TERMS);
  return exact_tapes_equal(f, a, b);
}

static bool same_with(struct view first, struct view second, const char *formula, const char *section,
                      bool (*same)(const struct tape *, const struct tape *), const struct override *o, int n) {
  OWNED(tape) a, b;
  bool ok = formula_tape(&a, first, formula, section, o, n);
  ok = formula_tape(&b, second, formula, section, o, n) && ok && same(&a, &b);
  return ok;
}

/* The local Jacobians that are the same formulas in both readings. */
static int common_jacobians(struct override *o, struct view first, struct view second) {
  int n = 0;
  for (int ph = 0; ph < N_PHASES; ph++) {
    const struct local_map *map = &local_maps[ph];
    if (same_with(first, second, map->name, "stability", tape_same, NULL, 0))
      o[n++] = (struct override){map->name, map->rows, map->cols};
  }
  return n;
}

bool exact_unchanged(struct view first, struct view second, const char *formula, const char *section) {
  struct override o[N_PHASES];
  int n = common_jacobians(o, first, second);
  if (same_with(first, second, formula, section, same_element, o, n)) return true;
  for (int i = 0; i < n; i++) { /* one of them in full */
    struct override left[N_PHASES];
    int m = 0;
    for (int k = 0; k < n; k++)
      if (k != i) left[m++] = o[k];
    if (m == n - 1 && same_with(first, second, formula, section, same_element, left, m)) return true;
  }
  return false;
}
