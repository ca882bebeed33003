/* Job 1: the propagator H(t) of the phase in which both masses slip, from chi, eta and t.

   The paper's modal form (47) is read from its own text.  Its frequencies are roots of (48): either the tape finds them
   again at each call, by the exact isolation that any root in the paper's text gets, or they are handed to it, from the
   quadratic as a programmer would solve it. */
#include <math.h>

#include "bench/jobs.h"
#include "motion/dynamics.h"

enum { N_ENTRIES = N_STATE * N_STATE };

static const int one_group[N_ENTRIES] = {0};

/* t up to some ten periods, of all sizes. */
static void place(double *x, const double *u) {
  x[0] = 0.05 + 0.9 * u[0];
  x[1] = exp(2.5 * (2 * u[1] - 1));
  x[2] = exp(-3 + 7 * u[2]);
}

/* chi and eta as parameters of the model; V, e1 and e2 play no part in the phase. */
static void set_params(struct num_vec *params, const struct num_vec *in) {
  const struct num_type *type = in->ctx.type;
  for (slong i = 0; i < N_PARAMS; i++) type->set_d(num_vec_at(params, i), 1, in->ctx.prec);
  type->set(num_vec_at(params, P_CHI), num_vec_at(in, 0));
  type->set(num_vec_at(params, P_ETA), num_vec_at(in, 1));
}

static int truth_of(struct num_vec *out, struct num_vec *given, double *hint, const struct num_vec *in,
                    const double *near) {
  OWNED(num_vec) params;
  (void)given, (void)hint, (void)near;
  num_vec_init(&params, N_PARAMS, in->ctx);
  set_params(&params, in);
  return dyn_propagator(out, PHASE_H, &params, num_vec_at(in, 2));
}

/* --- The suite's forms, in any arithmetic. --- */

typedef int (*propagator)(struct num_vec *p, enum phase ph, const struct num_vec *params, const void *t);

static int run_model(propagator f, struct num_vec *out, long *steps, const struct bench_case *c) {
  OWNED(num_vec) params;
  num_vec_init(&params, N_PARAMS, out->ctx);
  set_params(&params, &c->in);
  int status = f(out, PHASE_H, &params, num_vec_at(&c->in, 2));
  *steps = 1;
  return status;
}

static int run_exponential(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  (void)self;
  return run_model(dyn_propagator, out, steps, c);
}

static int run_closed(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  (void)self;
  return run_model(dyn_flow_matrix, out, steps, c);
}

/* --- The paper's modal form. --- */

enum symbol { SYM_CHI, SYM_ETA, SYM_T, SYM_SLOW, SYM_FAST, N_SYMBOLS };
static const char *const symbol_name[N_SYMBOLS] = {"chi", "eta", "t", "omega_1", "omega_2"};

static const struct bench_formula modal = {"H(t)", "appendix_a", symbol_name, N_SYMBOLS, N_ENTRIES, false, false};
static const struct bench_formula stable = {"H(t)", "appendix_a", symbol_name, N_SYMBOLS, N_ENTRIES, false, true};
static const struct bench_formula modal_roots = {"H(t)", "appendix_a", symbol_name, N_SYMBOLS, N_ENTRIES, true, false};

static int run_paper(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  double v[N_SYMBOLS] = {c->x[0], c->x[1], c->x[2]};
  bench_frequencies(&v[SYM_SLOW], &v[SYM_FAST], c->x[0], c->x[1]);
  *steps = 1;
  return bench_formula_run(self, out, v);
}

/* --- The table. --- */

static const struct bench_method methods[] = {
    {"paper-modal", "the paper's modal form (47), frequencies from the quadratic", FORMULA(modal, run_paper)},
    {"paper-modal-roots", "the paper's modal form (47) with (48) solved by root isolation",
     FORMULA(modal_roots, run_paper)},
    {"paper-stable", "the same in its stable form", FORMULA(stable, run_paper)},
    {"closed-double", "the suite's closed form in double", .type = &num_double, .run = run_closed},
    {"gsl-expm", "GSL's matrix exponential", .type = &num_double, .run = run_exponential},
    {"closed-mpfr", "the suite's closed form in MPFR", .type = &num_mpfr, BITS(7, 4), .run = run_closed},
    {"taylor-mpfr", "Taylor series with scaling and squaring in MPFR", .type = &num_mpfr, BITS(7, 4),
     .run = run_exponential},
    {"closed-arb", "the suite's closed form in balls", .type = &num_arb, BITS(7, 4), .run = run_closed},
    {"arb-expm", "Arb's matrix exponential in balls", .type = &num_arb, BITS(7, 4), .run = run_exponential},
};

const struct bench_job bench_propagator = {
    .id = "propagator",
    .title = "The propagator H(t)",
    .inputs = "chi, eta, t",
    .outputs = "the sixteen entries of H(t); errors in units of the largest",
    .n_in = 3,
    .n_out = N_ENTRIES,
    .n_cases = 64,
    .n_quick = 16,
    .worst_condition = 1e4,
    .group = one_group,
    .place = place,
    .truth = truth_of,
    .methods = methods,
    .n_methods = COUNT(methods),
};
