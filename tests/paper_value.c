#include "paper_value.h"

#include <check.h>

int paper_value(fmpz_mpoly_q_struct *z, struct exact_field *f, const struct model *of, const char *text) {
  struct elaboration el;
  struct matrix m;
  struct tape t;
  struct diag d;
  struct calc c = exact_calc(f);
  struct num_vec v;
  diag_init(&d);
  elaboration_init(&el, (struct view){of, LAYER_CORRECTED, NULL, NULL}, NULL, 0);
  ck_assert_msg(elaborate_tape(&t, &m, &el, "test", text, "", &d), "%s", d.message);
  int s = exact_eval(&v, &c, f, &t);
  if (s == SS_OK) num_exact.set(z, num_vec_at(&v, 0));
  calc_clear(&c);
  tape_clear(&t);
  elaboration_clear(&el);
  return s;
}
