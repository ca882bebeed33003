#include "element.h"
#include "says.h"

int paper_value(fmpz_mpoly_q_struct *z, struct exact_field *f, const struct model *of, const char *text) {
  OWNED(elaboration) el;
  struct matrix m;
  OWNED(tape) t;
  OWNED(calc) c = exact_calc(f);
  struct num_vec v;
  elaboration_init(&el, (struct view){of, LAYER_CORRECTED, NULL, NULL}, NULL, 0);
  goes_well(elaborate_tape(&t, &m, &el, "test", text, "", &d));
  int s = exact_eval(&v, &c, f, &t);
  if (s == SS_OK) num_exact.set(z, num_vec_at(&v, 0));
  return s;
}
