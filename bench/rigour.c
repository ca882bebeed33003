/* What proof costs: a method in balls against its like in MPFR, at equal true error.

   At the same precision a ball knows fewer digits, since its radius grows with every operation; so the ball's time is
   read between two of its settings, on a straight line in the digits, at the error that MPFR has made.  Where no setting of
   the balls is so rough, the roughest stands. */
#include <math.h>
#include <string.h>

#include "bench/jobs.h"

static const struct {
  const struct bench_job *job;
  const char *plain, *balls;
} pairs[] = {{&bench_propagator, "closed-mpfr", "closed-arb"}, {&bench_propagator, "taylor-mpfr", "arb-expm"},
             {&bench_map, "closed-mpfr", "closed-arb"},        {&bench_jacobian, "implicit-mpfr", "implicit-arb"},
             {&bench_orbit, "newton-mpfr", "near-arb"},        {&bench_orbit, "newton-mpfr", "find-arb"}};

/* The time of the method at the given error (log10); NAN when it is not that good. */
static double time_at(const struct bench_table *t, const char *method, double error) {
  const struct bench_row *rough = NULL;
  for (int i = 0; i < t->n; i++) {
    const struct bench_row *r = &t->row[i];
    if (strcmp(r->method->id, method) != 0 || r->failure) continue;
    if (r->worst <= error) {
      if (!rough) return r->least_ns;
      double part = (rough->worst - error) / (rough->worst - r->worst);
      return rough->least_ns + part * (r->least_ns - rough->least_ns);
    }
    rough = r;
  }
  return NAN;
}

int bench_costs(struct bench_cost *out, int most, const struct bench_table *t) {
  int n = 0;
  for (int p = 0; p < COUNT(pairs); p++)
    for (int i = 0; i < t->n && pairs[p].job == t->job; i++) {
      const struct bench_row *r = &t->row[i];
      if (strcmp(r->method->id, pairs[p].plain) != 0 || r->failure) continue;
      double ns = time_at(t, pairs[p].balls, r->worst);
      if (isnan(ns) || n == most) continue;
      out[n++] = (struct bench_cost){pairs[p].plain, pairs[p].balls, -r->worst, r->least_ns, ns};
    }
  return n;
}
