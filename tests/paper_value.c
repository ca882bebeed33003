#include "paper_value.h"

#include <check.h>

int paper_value(fmpz_mpoly_q_struct *z, struct exact_field *f, const struct model *of, const char *text) {
  struct elaboration el;
  struct matrix m;
  struct tape t;
  struct diag d;
  struct exact_vec v;
  diag_init(&d);
  elaboration_init(&el, (struct view){of, LAYER_CORRECTED, NULL, NULL}, NULL, 0);
  ck_assert_msg(elaborate_tape(&t, &m, &el, "test", text, "", &d), "%s", d.message);
  int s = exact_eval(&v, f, &t);
  if (s == SS_OK) num_exact.set(z, &v.x[0]);
  exact_vec_clear(&v);
  tape_clear(&t);
  elaboration_clear(&el);
  return s;
}
