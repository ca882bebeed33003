/* A printed example: its eight quantities, the bounds (53), and what its decimals look like. */
#include <string.h>

#include "readings_impl.h"
#include "value/point.h"
#include "value/printed.h"

static const char *const bound_name[N_BOUNDS] = {"u_r1", "u_r2"};
static const int decimals_fed[N_CARRIES] = {[CARRY_3] = 3, [CARRY_2] = 2};

static int significant_digits(const char *decimal) {
  int n = 0;
  for (const char *p = decimal; *p && *p != 'e' && *p != 'E'; p++)
    if (*p >= '0' && *p <= '9') n += n > 0 || *p != '0';
  return n;
}

/* The nearest multiple of 10^-n, ties away from zero. */
static void round_decimals(fmpq_t z, const fmpq_t x, int n) {
  NUMBERS(fmpz, scale, q);
  NUMBERS(fmpq, y, half);
  fmpz_ui_pow_ui(scale, 10, (ulong)n);
  fmpq_set_si(half, fmpq_sgn(x) < 0 ? -1 : 1, 2);
  fmpq_mul_fmpz(y, x, scale);
  fmpq_add(y, y, half);
  fmpz_tdiv_q(q, fmpq_numref(y), fmpq_denref(y));
  fmpq_set_fmpz_frac(z, q, scale);
}

const char *example_init(struct example *e, const struct scene *s) {
  *e = (struct example){.scene = s};
  for (int c = 0; c < N_CARRIES; c++)
    for (int i = 0; i < N_X; i++) fmpq_init(&e->fed[c][i]);
  for (int i = 0; i < N_X; i++) {
    const struct printed_number *p = e->printed[i] = scene_printed(s, orbit_number_name(i));
    if (!p) return "they take printed values of z10, z20, t_a, t_b, t_c, t_d, e1 and e2";
    e->value[i] = fmpq_get_d(&p->value);
    e->unit[i] = fmpq_get_d(&p->unit);
    e->digits[i] = significant_digits(p->decimal);
    int after = (int)printed_decimals(p);
    e->missing[i] = after - (int)fmpz_sizeinbase(fmpq_denref(&p->digit), 10) + 1;
    for (int c = 0; c < N_CARRIES; c++) {
      fmpq_set(&e->fed[c][i], &p->value);
      if (decimals_fed[c] && decimals_fed[c] < after) round_decimals(&e->fed[c][i], &p->value, decimals_fed[c]);
    }
    if (scene_given_number(s, i)) e->data |= 1U << i;
  }
  for (int i = 0; i < N_BOUNDS; i++) {
    const struct printed_number *p = e->printed[N_X + i] = scene_printed(s, bound_name[i]);
    e->unit[N_X + i] = p ? fmpq_get_d(&p->unit) : 0;
  }
  return NULL;
}

void example_clear(struct example *e) {
  for (int c = 0; c < N_CARRIES; c++)
    for (int i = 0; i < N_X; i++) fmpq_clear(&e->fed[c][i]);
}

void readings_bounds(arb_ptr bound, arb_srcptr x, const struct scene *s) {
  enum { PREC = FIRST_PREC };
  NUMBERS(arb, chi, v);
  arb_set_fmpq(chi, &s->value[KEY_CHI], PREC);
  arb_sub_ui(v, chi, 1, PREC); /* V t_a (1 - chi)/2 */
  arb_neg(v, v);
  arb_mul(bound, v, x + X_TA, PREC);
  arb_set_fmpq(v, &s->value[KEY_V], PREC);
  arb_mul(bound, bound, v, PREC);
  arb_mul_2exp_si(bound, bound, -1);
  arb_sub(v, x + X_Z20, x + X_Z10, PREC); /* (e_2 - chi (z_20 - z_10))/2 */
  arb_mul(v, v, chi, PREC);
  arb_sub(bound + 1, x + X_E2, v, PREC);
  arb_mul_2exp_si(bound + 1, bound + 1, -1);
}
