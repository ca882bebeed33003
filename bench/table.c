/* The rows of a job, and what is read off them: the Pareto front, the method to use, what proof costs.

   What proof costs: a method in balls against its like in MPFR, at equal true error.  At the same precision a ball
   knows fewer digits, since its radius grows with every operation; so the ball's time is read between two of its
   settings, on a straight line in the digits, at the error that MPFR has made.  Where no setting of the balls is so
   rough, the roughest stands. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "bench/jobs.h"

static void add_method(struct bench_table *t, const struct bench_method *m) {
  t->method = ss_realloc(t->method, (size_t)(t->n_methods + 1) * sizeof(const struct bench_method *));
  t->method[t->n_methods++] = m;
}

/* A row is on the front when no other is at least as good in both and better in one. */
static void find_front(struct bench_table *t) {
  for (int i = 0; i < t->n; i++) {
    struct bench_row *r = &t->row[i];
    r->front = !r->failure;
    for (int k = 0; k < t->n && r->front; k++) {
      const struct bench_row *o = &t->row[k];
      if (o->failure || k == i) continue;
      bool as_good = o->worst <= r->worst && o->least_ns <= r->least_ns;
      if (as_good && (o->worst < r->worst || o->least_ns < r->least_ns)) r->front = false;
    }
  }
}

void bench_add_row(struct bench_table *t, const struct bench_method *m, const struct bench_row *row) {
  int k = 0;
  while (k < t->n_methods && strcmp(t->method[k]->id, m->id) != 0) k++;
  if (k == t->n_methods) add_method(t, m);
  t->row = ss_grow(t->row, (size_t)t->n, &t->cap, sizeof *t->row);
  t->row[t->n] = *row;
  t->row[t->n++].method = t->method[k];
  find_front(t);
}

const struct bench_method *bench_method_of(const struct bench_job *job, const char *id) {
  for (int i = 0; i < job->n_methods; i++)
    if (strcmp(job->methods[i].id, id) == 0) return &job->methods[i];
  return NULL;
}

const int bench_targets[] = {-6, -12, -30, -100, -300};
const int n_bench_targets = sizeof bench_targets / sizeof *bench_targets;

const struct bench_row *bench_best(const struct bench_table *t, double log_error, bool rigorous) {
  const struct bench_row *best = NULL;
  for (int i = 0; i < t->n; i++) {
    const struct bench_row *r = &t->row[i];
    const struct num_type *type = r->method->type;
    if (r->failure || r->method->bare || r->worst > log_error || (rigorous && !(type && type->rigorous))) continue;
    if (!best || r->least_ns < best->least_ns) best = r;
  }
  return best;
}

void bench_table_clear(struct bench_table *t) {
  free(t->row);
  free(t->method);
  *t = (struct bench_table){.n = 0};
}

const struct bench_row *bench_find(const struct bench_table *t, const char *method, double setting) {
  for (int i = 0; i < t->n; i++) {
    const struct bench_row *r = &t->row[i];
    if (strcmp(r->method->id, method) == 0 && (r->method->kind == SET_NONE || r->setting == setting)) return r;
  }
  return NULL;
}

/* --- What proof costs. --- */

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
