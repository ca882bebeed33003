/* The law entry by entry; see the header. */
#include "propagator_law.h"
#include "num/calc.h"

int propagator_law(struct num_vec *out, const struct num_vec *p, const struct num_vec *rate,
                   const struct num_vec *start, const struct num_vec *a) {
  enum { N = 4 };
  OWNED(calc) c = calc_begin(out->ctx);
  for (int i = 0; i < N; i++)
    for (int j = 0; j < N; j++) {
      slong at = N * i + j, mark = calc_mark(&c);
      val rest = num_vec_at(rate, at), one = calc_d(&c, i == j);
      for (int k = 0; k < N; k++)
        rest = calc_sub(&c, rest, calc_mul(&c, num_vec_at(a, N * i + k), num_vec_at(p, N * k + j)));
      calc_store(&c, num_vec_at(out, at), rest);
      calc_store(&c, num_vec_at(out, N * N + at), calc_sub(&c, num_vec_at(start, at), one));
      calc_release(&c, mark);
    }
  return c.status;
}
