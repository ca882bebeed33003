#include "paper_value.h"
#include "says.h"

#include <check.h>

int paper_value(fmpz_mpoly_q_struct *z, struct exact_field *f, const struct model *of, const char *text) {
  struct elaboration el;
  struct matrix m;
  struct tape t;
  struct calc c = exact_calc(f);
  struct num_vec v;
  elaboration_init(&el, (struct view){of, LAYER_CORRECTED, NULL, NULL}, NULL, 0);
  goes_well(elaborate_tape(&t, &m, &el, "test", text, "", &d));
  int s = exact_eval(&v, &c, f, &t);
  if (s == SS_OK) num_exact.set(z, num_vec_at(&v, 0));
  calc_clear(&c);
  tape_clear(&t);
  elaboration_clear(&el);
  return s;
}
