/* The program's own functions of dynamics.h, studied like the paper's formulas: the same code over balls is the truth,
   since what it returns there encloses the exact result; of the return map, which is in double alone, the arc in balls
   between events that are found and proved to be first there.  They are no tapes: condition numbers are differences in
   balls at a high precision, and no node is named.  An error status is an answer, a wrong value is not. */
#include <math.h>
#include <string.h>

#include "motion/return_map.h"
#include "motion/warm.h"
#include "num/calc.h"
#include "stability_impl.h"
#include "value/names.h"

/* One evaluation. */
struct kernel_call {
  struct num_vec *out;
  enum phase phase;
  const struct num_vec *params, *state;
  const void *t;
};

struct digits_kernel {
  const char *id, *says, *inputs; /* separated by blanks; parameters and t by their names, the others are the state */
  int rows, cols;
  enum phase phase;
  int (*run)(const struct kernel_call *c);
  bool (*place)(
      double *x); /* takes a region's point to one at which the function has a value; false where none is; or NULL */
};

static int run_flow(const struct kernel_call *c) {
  return dyn_flow(c->out, c->phase, c->params, c->state, c->t);
}

static int run_matrix(const struct kernel_call *c) {
  return dyn_flow_matrix(c->out, c->phase, c->params, c->t);
}

static int run_local(const struct kernel_call *c) {
  return dyn_local_jacobian(c->out, c->phase, c->params, c->state, c->t);
}

static int run_switching(const struct kernel_call *c) {
  return dyn_switching(num_vec_at(c->out, 0), c->phase, c->params, c->state);
}

static int run_rate(const struct kernel_call *c) {
  return dyn_switching_rate(num_vec_at(c->out, 0), c->phase, c->params, c->state);
}

/* --- The return map of r, the first of the state --- */

enum { MOST_STEPS = 400 };

static int map_in_double(struct num_vec *out, const struct num_vec *params, double r) {
  struct dyn_return x;
  double p[N_PARAMS];
  for (slong i = 0; i < N_PARAMS; i++) p[i] = num_double.get_d(num_vec_at(params, i));
  int status = dyn_return_map(&x, p, r);
  if (status || x.grazing) return status | SS_UNABLE;
  const double y[N_RETURN] = {x.t[PHASE_D], x.t[PHASE_GAMMA], x.t[PHASE_H], x.t[PHASE_C], x.r_end, x.slope};
  for (slong i = 0; i < out->len; i++) num_double.set(num_vec_at(out, i), &y[i]);
  return SS_OK;
}

static int run_map(const struct kernel_call *c) {
  const void *r = num_vec_at(c->state, 0);
  return c->out->ctx.type == &num_double ? map_in_double(c->out, c->params, num_double.get_d(r))
                                         : dyn_return_first(c->out, c->params, r, MOST_STEPS);
}

static int run_warm(const struct kernel_call *c) {
  return digits_warm_run(c->out, c->params, c->state);
}

#define STATE  "chi eta t z_1 z_2 z'_1 z'_2"
#define FORCES "chi eta V e_1 e_2 "
#define OF_PHASES(X, name, says, inputs, rows, cols, run)                                                              \
  X(name "-D", says ", phase D", inputs, rows, cols, PHASE_D, run, NULL)                                               \
  X(name "-Gamma", says ", phase Gamma", inputs, rows, cols, PHASE_GAMMA, run, NULL)                                   \
  X(name "-H", says ", phase H", inputs, rows, cols, PHASE_H, run, NULL)                                               \
  X(name "-C", says ", phase C", inputs, rows, cols, PHASE_C, run, NULL)
#define KERNELS(X)                                                                                                     \
  OF_PHASES(X, "dyn_flow", "the state after the time t", STATE, 4, 1, run_flow)                                        \
  OF_PHASES(X, "dyn_flow_matrix", "the matrix of that map", "chi eta t", 4, 4, run_matrix)                             \
  OF_PHASES(X, "dyn_local_jacobian", "the derivative of the map to the event at t", STATE, 4, 4, run_local)            \
  OF_PHASES(X, "dyn_switching", "the switching function", FORCES "z_1 z_2 z'_1 z'_2", 1, 1, run_switching)             \
  OF_PHASES(X, "dyn_switching_rate", "its derivative along the motion", FORCES "z_1 z_2 z'_1 z'_2", 1, 1, run_rate)    \
  X("dyn_return_map", "the next t_a, t_b, t_c, t_d, r at the end and slope of the return map", FORCES "r", N_RETURN,   \
    1, PHASE_D, run_map, NULL)                                                                                         \
  X("dyn_orbit_warm", "z_10, z_20, t_a, t_b, t_c, t_d, period, trace, least u_r1, u_r2 of the orbit near t_b, t_c",    \
    FORCES "t_b t_c", N_DYN_OUT, 1, PHASE_D, run_warm, digits_warm_place)

static const struct digits_kernel kernels[] = {
#define KERNEL_ROW(id, says, inputs, rows, cols, phase, run, place) {id, says, inputs, rows, cols, phase, run, place},
    KERNELS(KERNEL_ROW)
#undef KERNEL_ROW
};

/* --- Running one --- */

int digits_kernel_run(struct num_vec *out, const struct digits_formula *f, const struct num_vec *in) {
  const struct digits_kernel *k = f->kernel;
  const struct num_type *type = out->ctx.type;
  const void *t = NULL;
  slong n_state = 0;
  OWNED(calc) c = calc_begin(out->ctx);
  struct num_vec all = calc_vec(&c, k->rows * k->cols), params = calc_vec(&c, N_PARAMS), state = calc_vec(&c, N_STATE);
  for (slong i = 0; i < N_PARAMS; i++) type->set_d(num_vec_at(&params, i), 1, out->ctx.prec); /* some are not read */
  for (slong i = 0; i < in->len; i++) {
    const char *name = f->tape.inputs[i];
    int p = word_find(name, name_param, N_PARAMS);
    if (p < N_PARAMS)
      type->set(num_vec_at(&params, p), num_vec_at(in, i));
    else if (strcmp(name, "t") == 0)
      t = num_vec_at(in, i);
    else
      type->set(num_vec_at(&state, n_state++), num_vec_at(in, i));
  }
  int status = k->run(&(struct kernel_call){&all, k->phase, &params, &state, t});
  for (slong i = 0; i < f->n && !status; i++) type->set(num_vec_at(out, i), num_vec_at(&all, f->first + i));
  return status;
}

bool digits_kernel_place(double *x, const struct digits_formula *f) {
  return !f->kernel || !f->kernel->place || f->kernel->place(x);
}

/* The sum over the inputs of |f(x_k (1 + h)) - f(x)|/h for each entry, into sum. */
static bool add_slopes(arb_ptr sum, const struct digits_formula *f, const struct num_vec *in, slong prec) {
  OWNED(calc) c = calc_begin(num_ctx_arb(prec));
  struct num_vec x = calc_vec(&c, in->len), at = calc_vec(&c, f->n), moved = calc_vec(&c, f->n);
  num_vec_set(&x, in);
  bool ok = digits_kernel_run(&at, f, &x) == SS_OK;
  for (slong k = 0; k < in->len && ok; k++) {
    arb_ptr z = num_vec_at(&x, k);
    arb_mul_2exp_si(z, num_vec_at(in, k), -prec / 2);
    arb_add(z, z, num_vec_at(in, k), prec);
    ok = digits_kernel_run(&moved, f, &x) == SS_OK;
    for (slong i = 0; i < f->n && ok; i++) {
      arb_ptr d = num_vec_at(&moved, i);
      arb_sub(d, d, num_vec_at(&at, i), prec);
      arb_mul_2exp_si(d, d, prec / 2);
      arb_abs(d, d);
      arb_add(sum + i, sum + i, d, prec);
    }
    arb_set(z, num_vec_at(in, k));
  }
  return ok;
}

enum { SLOPE_FIRST = 512, SLOPE_LAST = 8192 };

/* log2 of the condition number over 2^size; -inf where it does not show. */
double digits_kernel_condition(const struct digits_formula *f, const struct num_vec *in, double size) {
  double c = NAN;
  for (slong prec = SLOPE_FIRST; isnan(c) && prec <= SLOPE_LAST; prec *= 2) {
    ARB_VECTOR(sum, f->n);
    double most = -INFINITY, blur = -INFINITY;
    bool ok = add_slopes(sum, f, in, prec);
    for (slong i = 0; i < f->n; i++) {
      most = fmax(most, digits_log2(sum + i) - size);
      if (!mag_is_zero(arb_radref(sum + i))) blur = fmax(blur, digits_log2_mag(arb_radref(sum + i)) - size);
    }
    if (ok && blur < fmax(0, most) - 10) c = most;
  }
  return c;
}

/* --- Enrolling them --- */

static void name_inputs(struct digits_formula *f, const char *inputs) {
  for (const char *p = inputs; *p; p += *p == ' ') {
    size_t len = strcspn(p, " ");
    f->tape.inputs = ss_realloc(f->tape.inputs, (size_t)(f->tape.n_inputs + 1) * sizeof *f->tape.inputs);
    f->tape.inputs[f->tape.n_inputs++] = ss_strndup(p, len);
    p += len;
  }
}

/* Entries [first, first + n). */
static void enrol(struct digits_set *s, const struct digits_kernel *k, const char *id, slong first, slong n) {
  struct digits_formula f = {
      .id = id, .also = "", .record = k->id, .equation = "", .section = "dynamics", .text = k->says, .kernel = k};
  f.first = first;
  f.n = n;
  name_inputs(&f, k->inputs);
  f.out = arena_alloc(&s->arena, (size_t)n * sizeof *f.out);
  for (slong i = 0; i < n; i++) f.out[i] = i;
  f.input = arena_alloc(&s->arena, (size_t)f.tape.n_inputs * sizeof *f.input);
  for (slong i = 0; i < f.tape.n_inputs; i++) f.input[i] = digits_class_of(f.tape.inputs[i]);
  *SS_PUSH(s->formula, s->n, s->cap) = f;
}

void digits_enrol_kernels(struct digits_set *s) {
  for (size_t i = 0; i < sizeof kernels / sizeof *kernels; i++) {
    const struct digits_kernel *k = &kernels[i];
    for (int e = 0; e < k->rows * k->cols && k->rows > 1; e++)
      enrol(s, k, digits_entry_id(s, k->id, k->rows, k->cols, e), e, 1);
    enrol(s, k, k->id, 0, k->rows * k->cols);
  }
}
