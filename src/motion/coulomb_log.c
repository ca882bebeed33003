/* The simulations for callers with plain arrays of doubles, and what is read off a motion afterwards: its phases in
   short, and whether two routes report the same events. */
#include <math.h>
#include <string.h>

#include "coulomb.h"
#include "num/calc.h"

int coulomb_start_set_d(double start[N_STATE], const double params[N_COULOMB], double z10, double z20) {
  OWNED(calc) c = calc_begin(num_ctx_double());
  struct num_vec p = calc_vec_d(&c, params, N_COULOMB), x = calc_vec(&c, N_STATE);
  c.status |= coulomb_start_set(&x, &p, calc_d(&c, z10), calc_d(&c, z20));
  for (int i = 0; i < N_STATE; i++) start[i] = x.ctx.type->get_d(num_vec_at(&x, i));
  return c.status;
}

int coulomb_simulate_d(struct coulomb_result *result, const double params[N_COULOMB], const double start[N_STATE],
                       const struct coulomb_plan *plan, const struct coulomb_sink *sink) {
  OWNED(calc) c = calc_begin(num_ctx_double());
  const struct num_vec p = calc_vec_d(&c, params, N_COULOMB), x = calc_vec_d(&c, start, N_STATE);
  *result = (struct coulomb_result){.end = COULOMB_FAILED};
  return c.status ? SS_DOMAIN : coulomb_simulate_exact(result, &p, &x, plan, sink);
}

void coulomb_word_fold(struct text *out, const char *word) {
  while (*word) {
    size_t len = strcspn(word, "D");
    if (word[len] == 'D') len++;
    long n = 0;
    const char *p = word;
    for (; strncmp(p, word, len) == 0; p += len) n++;
    text_printf(out, "%s(%.*s)^%ld", out->len ? " " : "", (int)len, word, n);
    word = p;
  }
}

double coulomb_log_compare(size_t *shared, const struct coulomb_log *a, const struct coulomb_log *b) {
  double worst = 0;
  for (*shared = 0; *shared < a->n && *shared < b->n; ++*shared) {
    const struct coulomb_event *e = &a->event[*shared], *f = &b->event[*shared];
    if (e->mass != f->mass || e->from != f->from || e->to != f->to) break;
    worst = fmax(worst, fabs(e->at.t - f->at.t));
    for (int i = 0; i < 2; i++) worst = fmax(worst, fmax(fabs(e->at.x[i] - f->at.x[i]), fabs(e->at.v[i] - f->at.v[i])));
  }
  return worst;
}
