/* What the files of jobs and peers share. */
#ifndef STICKSLIP_BENCH_JOBS_H
#define STICKSLIP_BENCH_JOBS_H

#include "bench/bench.h"

extern const struct bench_job bench_propagator, bench_map, bench_jacobian, bench_orbit;

/* --- formula.c: a formula of the paper as corrected, as a tape in double precision. --- */

struct bench_formula {
  const char *text, *section;
  const char *const *symbol; /* values of the formula's free names are given in this order */
  int n_symbols, n_out;
  bool roots; /* let the tape find quantities defined as roots; else they are symbols */
};
/* open and close of a method whose data is the formula. */
void *bench_formula_open(const struct bench_method *m, double setting, const struct bench_env *env);
void bench_formula_close(void *self);
int bench_formula_run(void *self, struct num_vec *out, const double *value);

#endif
