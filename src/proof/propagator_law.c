/* The law entry by entry; see the header. */
#include "propagator_law.h"

int propagator_law(struct num_vec *out, const struct num_vec *p, const struct num_vec *rate,
                   const struct num_vec *start, const struct num_vec *a) {
  enum { N = 4 };
  const struct num_type *t = out->ctx.type;
  slong prec = out->ctx.prec;
  struct num_vec term;
  num_vec_init(&term, 1, out->ctx);
  void *x = num_vec_at(&term, 0);
  int s = SS_OK;
  for (int i = 0; i < N; i++)
    for (int j = 0; j < N; j++) {
      void *z = num_vec_at(out, N * i + j);
      t->set(z, num_vec_at(rate, N * i + j));
      for (int k = 0; k < N; k++) {
        s |= t->mul(x, num_vec_at(a, N * i + k), num_vec_at(p, N * k + j), prec);
        s |= t->sub(z, z, x, prec);
      }
      s |= t->set_d(x, i == j, prec);
      s |= t->sub(num_vec_at(out, N * N + N * i + j), num_vec_at(start, N * i + j), x, prec);
    }
  num_vec_clear(&term);
  return s;
}
