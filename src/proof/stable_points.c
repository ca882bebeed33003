/* Two forms of one quantity at points, in balls: a route of its own beside the algebra, and soon told.  The algebra
   shows that the forms agree where both have a value; that they do have one is shown here. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "stable_impl.h"

enum { NEAR = 3, POINTS = 8 };

/* Near 1 in the first trials, then over orders of magnitude and of either sign where that is free; chi in (0, 1).  Of
   each name its own. */
static double draw(const char *name, int trial) {
  uint64_t h = 14695981039346656037U + (uint64_t)trial;
  for (const char *c = name; *c; c++) h = (h ^ (unsigned char)*c) * 0x100000001b3U;
  h *= 0x9e3779b97f4a7c15U;
  double unit = (double)(h >> 40) * 0x1p-24;
  if (strcmp(name, "chi") == 0) return trial < NEAR ? 0.125 + unit / 2 : (unit + 0x1p-25) / (1 + 0x1p-24);
  if (trial < NEAR) return 0.25 + unit;
  double size = ldexp(1 + unit, (int)(h >> 33 & 7) - 4);
  return (*name == 'z' || *name == 'x') && h >> 32 & 1 ? -size : size;
}

static void balls_there(struct num_vec *out, int *status, struct calc *c, const struct tape *t, int trial) {
  const struct num_vec in = calc_vec(c, t->n_inputs);
  *out = calc_vec(c, t->n_outputs);
  for (slong k = 0; k < t->n_inputs; k++) arb_set_d(num_vec_at(&in, k), draw(t->inputs[k], trial));
  tape_eval(out, status, t, &in);
}

/* What points say of the entries of two forms of one shape. */
struct seen {
  bool differ; /* enclosures are disjoint */
  bool lost;   /* the corrected one has a value and the stable one none */
  long *met;   /* of each entry, points at which both have one */
};

static void look_there(struct seen *seen, const struct reading r[2], int trial) {
  enum { BITS = 256 };
  OWNED(calc) c = calc_begin(num_ctx_arb(BITS));
  struct num_vec v[2];
  FREED int *all = ss_malloc((size_t)(2 * r[0].n + 1) * sizeof *all);
  int *const status[2] = {all, all + r[0].n};
  for (int i = 0; i < 2; i++) balls_there(&v[i], status[i], &c, &r[i].tape, trial);
  for (slong k = 0; k < r[0].n; k++) {
    bool both = status[0][k] == SS_OK && status[1][k] == SS_OK;
    seen->met[k] += both;
    seen->lost = seen->lost || (status[0][k] == SS_OK && !both);
    seen->differ = seen->differ || (both && !arb_overlaps(num_vec_at(&v[0], k), num_vec_at(&v[1], k)));
  }
}

const char *readings_refused(const struct reading r[2], bool only_values) {
  FREED long *met = ss_malloc((size_t)(r[0].n + 1) * sizeof *met);
  struct seen seen = {.met = met};
  bool empty = false;
  for (slong k = 0; k < r[0].n; k++) met[k] = 0;
  for (int trial = 0; trial < POINTS && !(seen.differ && !only_values); trial++) look_there(&seen, r, trial);
  for (slong k = 0; k < r[0].n; k++) empty = empty || met[k] == 0;
  return seen.differ && !only_values ? "an entry differs, by balls at a point"
         : seen.lost                 ? "an entry has no value at a point where the corrected form has one"
         : empty                     ? "no point was found at which both forms have a value"
                                     : NULL;
}
