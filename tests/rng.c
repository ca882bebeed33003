#include "rng.h"

#include "base/random.h"

uint64_t rng_next(struct rng *r) {
  return random_next(&r->state);
}

double rng_unit(struct rng *r) {
  return random_unit(&r->state);
}

slong rng_between(struct rng *r, slong low, slong high) {
  return low + (slong)(rng_next(r) % (uint64_t)(high - low + 1));
}

double rng_within(struct rng *r, double low, double high) {
  return low + (high - low) * rng_unit(r);
}

double rng_dyadic(struct rng *r, slong low, slong high) {
  return (double)rng_between(r, low, high) / 64;
}

void rng_mantissa(arf_t x, struct rng *r, slong bits) {
  arf_zero(x);
  for (slong i = 0; i < bits; i += 32) {
    arf_mul_2exp_si(x, x, 32);
    arf_add_ui(x, x, rng_next(r) >> 32, ARF_PREC_EXACT, ARF_RND_DOWN);
  }
  arf_set_round(x, x, bits, ARF_RND_DOWN);
  if (arf_is_zero(x)) arf_one(x);
  fmpz_zero(ARF_EXPREF(x)); /* in [1/2, 1) */
}

void rng_edge(arf_t x, struct rng *r, slong bits, slong reach) {
  slong kind = rng_between(r, 0, 9);
  rng_mantissa(x, r, bits);
  switch (kind) {
  case 0:
    arf_set_si(x, rng_between(r, -3, 3));
    return;
  case 1:
    arf_set_si_2exp_si(x, 1, rng_between(r, -reach, reach));
    break;
  case 2:
    arf_set_si_2exp_si(x, rng_between(r, -2, 2), -bits);
    arf_add_ui(x, x, 1, bits, ARF_RND_DOWN);
    break;
  case 3: {
    NUMBERS(arb, t);
    arb_const_pi(t, bits + 40);
    arf_mul_si(x, arb_midref(t), rng_between(r, 1, 40), bits, ARF_RND_NEAR);
    arf_mul_2exp_si(x, x, -1);
    break;
  }
  case 4:
    arf_mul_2exp_si(x, x, rng_between(r, -reach, reach));
    break;
  default:
    arf_mul_2exp_si(x, x, rng_between(r, -8, 8));
  }
  if (rng_next(r) % 2) arf_neg(x, x);
}
