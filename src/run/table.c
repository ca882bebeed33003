/* How the numbers of a table are printed, and where a finished table goes. */
#include "tables.h"

#include <math.h>
#include <string.h>

void table_number(struct text *out, arb_srcptr x, int decimals) {
  if (!x) {
    text_add(out, "\t-");
    return;
  }
  NUMBERS(arb, unit, y);
  NUMBERS(fmpz, n);
  arb_set_ui(unit, 10);
  arb_pow_ui(unit, unit, (ulong)decimals, LAST_PREC);
  arb_mul(y, x, unit, LAST_PREC);
  text_add_char(out, '\t');
  if (!arb_is_finite(y) || mag_cmp_2exp_si(arb_radref(y), -2) >= 0) {
    text_add_char(out, '-');
  } else {
    arf_get_fmpz(n, arb_midref(y), ARF_RND_NEAR);
    num_print_fixed(out, n, decimals);
  }
}

slong table_pieces(double share) {
  enum { LEAST = 6, MOST = 200 };
  return (slong)fmin(MOST, fmax(LEAST, ceil(MOST * share)));
}

void table_bracket(struct text *out, const struct dyn_bifurcation *b) {
  text_add_char(out, '\t');
  num_print_rational(out, &b->low, b->digits);
  text_add_char(out, '\t');
  num_print_rational(out, &b->high, b->digits);
}

fmpq *table_params(fmpq params[N_PARAMS], const struct scene *s, int vary) {
  memcpy(params, s->value, N_PARAMS * sizeof *params);
  fmpq_init(&params[vary]);
  return &params[vary];
}

void table_finish(struct audit_result *out, const char *name, struct text *body) {
  *SS_PUSH(out->tables, out->n_tables, out->cap_tables) = (struct data_table){name, result_take(out, body), NULL};
}
