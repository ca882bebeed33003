/* Values and derivatives of the equations in any number type.

   Given the four propagators and their derivatives by time, everything else is linear algebra: states are carried
   through the word, tangents beside them.  The propagators are the paper's formulas on a tape, of either layer, or the
   model's closed forms with P' = A P.

   A row solved for z_0 is (N_1 - I)^-1 (or N_3^-1) times the rows of (44) at z_0, which is z_0 less the solution; its
   derivative by a time is that inverse times the derivative of (44) along the motion that starts at the solution. */
#include <string.h>

#include "num/calc.h"
#include "readings_impl.h"

static const char *const propagator_text[8] = {"D(t_a)",  "Gamma(t_b)",  "H(t_c)",  "C(t_d)",
                                               "D'(t_a)", "Gamma'(t_b)", "H'(t_c)", "C'(t_d)"};

/* --- The paper's formulas --- */

static bool name_inputs(struct formulas *f) {
  static const char *const names[] = {"chi", "eta", "V", "z_10", "z_20", "t_a", "t_b", "t_c", "t_d"};
  enum { N_NAMES = sizeof names / sizeof *names };
  for (slong i = 0; i < f->tape.n_inputs; i++) {
    int k = word_find(f->tape.inputs[i], names, N_NAMES);
    if (i >= (slong)(sizeof f->input / sizeof *f->input) || k == N_NAMES) return false;
    f->input[i] = k;
  }
  return true;
}

bool formulas_read(struct formulas *f, struct view v) {
  struct diag d = {0};
  *f = (struct formulas){.own_model = false};
  elaboration_init(&f->el, v, NULL, 0);
  const struct expr *entry[8 * 16];
  for (int k = 0; k < 8; k++) {
    const char *text = propagator_text[k];
    struct matrix mat;
    if (!elaborate_text(&mat, &f->el, text, text, "validation", &d) || mat.rows != 4 || mat.cols != 4) return false;
    for (int i = 0; i < 16; i++) entry[16 * k + i] = mat.e[i];
  }
  return elaboration_tape(&f->tape, &f->el, entry, 8 * 16, &d) && name_inputs(f);
}

void formulas_own(struct formulas *f) {
  *f = (struct formulas){.own_model = true};
}

void formulas_clear(struct formulas *f) {
  if (f->own_model) return;
  tape_clear(&f->tape);
  elaboration_clear(&f->el);
}

/* --- The system --- */

static void motion_make(struct motion *m, struct calc *c) {
  for (int k = 0; k < 5; k++) {
    m->state[k] = calc_vec(c, 4);
    m->tangent[k] = calc_vec(c, 24);
  }
}

void system_init(struct system *s, const struct formulas *f, const struct scene *scene, struct num_ctx ctx) {
  struct calc *c = &s->c;
  s->ctx = ctx;
  s->formulas = f;
  s->used = 0;
  s->memo = (struct memo){.n = 0};
  *c = calc_begin(ctx);
  s->model = calc_vec(c, 3);
  for (int i = 0; i < 3; i++) ctx.type->set_q(num_vec_at(&s->model, i), &scene->value[KEY_CHI + i], ctx.prec);
  s->x = calc_vec(c, N_X);
  for (int k = 0; k < KEPT_VALUES && !f->own_model; k++)
    s->kept[k] = (struct tape_values){calc_vec(c, f->tape.n_inputs), calc_vec(c, f->tape.n_outputs), 0};
  for (int k = 0; k < 4; k++) {
    s->p[k] = calc_vec(c, 16);
    s->dp[k] = calc_vec(c, 16);
  }
  motion_make(&s->own, c);
  motion_make(&s->from_solved, c);
  s->value = calc_vec(c, N_EQ);
  s->slope = calc_vec(c, N_EQ * N_X);
}

void system_clear(struct system *s) {
  memo_clear(&s->memo);
  calc_clear(&s->c);
}

/* --- Propagators --- */

static const void *input_of(const struct system *s, slong i) {
  int k = s->formulas->input[i];
  return k < 3 ? num_vec_at(&s->model, k) : num_vec_at(&s->x, k - 3);
}

static bool same_inputs(const struct tape_values *v, const struct system *s) {
  bool same = v->used > 0;
  for (slong i = 0; same && i < v->in.len; i++)
    same = s->formulas->input[i] < 3 || num_same(s->ctx.type, input_of(s, i), num_vec_at(&v->in, i));
  return same;
}

/* Iterations for other unknowns start from the same times again and again. */
static int from_tape(struct system *s) {
  const struct num_type *t = s->ctx.type;
  struct tape_values *v = s->kept, *oldest = s->kept;
  while (v < s->kept + KEPT_VALUES && !same_inputs(v, s)) {
    if (v->used < oldest->used) oldest = v;
    v++;
  }
  int status = SS_OK;
  if (v == s->kept + KEPT_VALUES) {
    v = oldest;
    for (slong i = 0; i < v->in.len; i++) t->set(num_vec_at(&v->in, i), input_of(s, i));
    status = tape_eval(&v->out, NULL, &s->formulas->tape, &v->in);
  }
  v->used = status == SS_OK ? ++s->used : 0;
  for (int k = 0; k < 8; k++)
    for (int i = 0; i < 16; i++)
      t->set(num_vec_at(k < 4 ? &s->p[k] : &s->dp[k - 4], i), num_vec_at(&v->out, 16 * k + i));
  return status;
}

static int from_model(struct system *s) {
  const struct num_type *t = s->ctx.type;
  OWNED(calc) c = calc_begin(s->ctx);
  struct num_vec params = calc_vec(&c, N_PARAMS), a = calc_vec(&c, 16);
  for (int i = 0; i < 3; i++) t->set(num_vec_at(&params, i), num_vec_at(&s->model, i));
  int status = t->set_d(num_vec_at(&params, P_E1), 1, s->ctx.prec); /* the motion does not depend on them */
  status |= t->set_d(num_vec_at(&params, P_E2), 1, s->ctx.prec);
  for (int k = 0; k < N_PHASES; k++) {
    status |= dyn_flow_matrix(&s->p[k], (enum phase)k, &params, num_vec_at(&s->x, X_TA + k));
    status |= dyn_system(&a, (enum phase)k, &params);
    status |= num_mat_mul(&s->dp[k], &a, &s->p[k], 4, 4, 4);
  }
  return status;
}

int system_propagators(struct system *s) {
  return s->formulas->own_model ? from_model(s) : from_tape(s);
}

/* --- Motions --- */

/* out = p in for the first n columns of 4x6 tangents; those for later times are still zero. */
static int carry_tangents(struct num_vec *out, const struct num_vec *p, const struct num_vec *in, int n) {
  const struct num_type *t = out->ctx.type;
  OWNED(num_vec) part;
  num_vec_init(&part, 4 * n, out->ctx);
  for (int i = 0; i < 4; i++)
    for (int c = 0; c < n; c++) t->set(num_vec_at(&part, n * i + c), num_vec_at(in, 6 * i + c));
  int status = num_mat_mul(&part, p, &part, 4, 4, n);
  for (int i = 0; i < 4; i++)
    for (int c = 0; c < n; c++) t->set(num_vec_at(out, 6 * i + c), num_vec_at(&part, n * i + c));
  return status;
}

/* From the positions in state[0], velocities V. */
static int motion_run(struct motion *m, const struct system *s) {
  const struct num_type *t = s->ctx.type;
  OWNED(num_vec) rate;
  num_vec_init(&rate, 4, s->ctx);
  for (int i = 2; i < 4; i++) t->set(num_vec_at(&m->state[0], i), num_vec_at(&s->model, 2));
  int status = SS_OK;
  for (int i = 0; i < 24; i++) status |= t->set_d(num_vec_at(&m->tangent[0], i), i == 0 || i == 7, s->ctx.prec);
  for (int k = 0; k < 4; k++) {
    status |= num_mat_mul(&m->state[k + 1], &s->p[k], &m->state[k], 4, 4, 1);
    status |= carry_tangents(&m->tangent[k + 1], &s->p[k], &m->tangent[k], 2 + k);
    status |= num_mat_mul(&rate, &s->dp[k], &m->state[k], 4, 4, 1);
    for (int i = 0; i < 4; i++) t->set(num_vec_at(&m->tangent[k + 1], 6 * i + 2 + k), num_vec_at(&rate, i));
  }
  return status;
}

/* --- Rows --- */

/* z += factor (end - start); without a start, factor end. */
static void add_share(void *z, struct calc *c, val factor, val end, val start) {
  calc_store(c, z, calc_add(c, z, calc_mul(c, factor, start ? calc_sub(c, end, start) : end)));
}

static int row_along(struct system *s, int eq) {
  const struct equation *e = &equations[eq];
  const struct num_type *t = s->ctx.type;
  OWNED(calc) w = calc_begin(s->ctx);
  void *value = num_vec_at(&s->value, eq);
  int status = t->set_d(value, 0, s->ctx.prec);
  bool returns = e->right == RIGHT_START;
  for (int c = 0; c < N_X; c++) status |= t->set_d(num_vec_at(&s->slope, eq * N_X + c), 0, s->ctx.prec);
  for (int i = 0; i < 4; i++) {
    if (e->one[i] == 0 && e->with_chi[i] == 0) continue;
    val with_chi = calc_mul(&w, calc_d(&w, e->with_chi[i]), num_vec_at(&s->model, 0));
    val factor = calc_add(&w, with_chi, calc_d(&w, e->one[i]));
    add_share(value, &w, factor, num_vec_at(&s->own.state[e->end], i),
              returns ? num_vec_at(&s->own.state[0], i) : NULL);
    for (int c = 0; c < 6; c++)
      add_share(num_vec_at(&s->slope, eq * N_X + c), &w, factor, num_vec_at(&s->own.tangent[e->end], 6 * i + c),
                returns ? num_vec_at(&s->own.tangent[0], 6 * i + c) : NULL);
  }
  if (e->right == RIGHT_V) calc_store(&w, value, calc_sub(&w, value, num_vec_at(&s->model, 2)));
  if (e->right >= 0) {
    calc_store(&w, value, calc_sub(&w, value, num_vec_at(&s->x, e->right)));
    status |= t->set_d(num_vec_at(&s->slope, eq * N_X + e->right), -1, s->ctx.prec);
  }
  return status | w.status;
}

/* Both rows of z_0 solved from the positions (block 0) or the velocities (block 1) of (44). */
static int rows_solved(struct system *s, int block) {
  const struct num_type *t = s->ctx.type;
  slong prec = s->ctx.prec;
  OWNED(calc) w = calc_begin(s->ctx);
  struct num_vec a = calc_vec(&w, 4), gap = calc_vec(&w, 2), rate = calc_vec(&w, 8), one = calc_vec(&w, 1);
  int status = t->set_d(num_vec_at(&one, 0), 1, prec);
  for (int i = 0; i < 2; i++) {
    int row = 2 * block + i;
    for (int j = 0; j < 2; j++) t->set(num_vec_at(&a, 2 * i + j), num_vec_at(&s->own.tangent[4], 6 * row + j));
    if (block == 0) status |= t->sub(num_vec_at(&a, 3 * i), num_vec_at(&a, 3 * i), num_vec_at(&one, 0), prec);
    status |= t->sub(num_vec_at(&gap, i), num_vec_at(&s->own.state[4], row), num_vec_at(&s->own.state[0], row), prec);
  }
  status |= num_mat_solve(&gap, &a, &gap, 2, 1);
  for (int i = 0; i < 2; i++)
    status |=
        t->sub(num_vec_at(&s->from_solved.state[0], i), num_vec_at(&s->own.state[0], i), num_vec_at(&gap, i), prec);
  status |= motion_run(&s->from_solved, s);
  for (int i = 0; i < 2; i++)
    for (int c = 0; c < 4; c++)
      t->set(num_vec_at(&rate, 4 * i + c), num_vec_at(&s->from_solved.tangent[4], 6 * (2 * block + i) + 2 + c));
  status |= num_mat_solve(&rate, &a, &rate, 2, 4);
  for (int i = 0; i < 2; i++) {
    int eq = (block ? EQ_G1 : EQ_F1) + i;
    t->set(num_vec_at(&s->value, eq), num_vec_at(&gap, i));
    for (int c = 0; c < N_X; c++) status |= t->set_d(num_vec_at(&s->slope, eq * N_X + c), c == X_Z10 + i, prec);
    for (int c = 0; c < 4; c++) t->set(num_vec_at(&s->slope, eq * N_X + X_TA + c), num_vec_at(&rate, 4 * i + c));
  }
  return status;
}

int system_eval(struct system *s, unsigned eqs) {
  int status = system_propagators(s);
  for (int i = 0; i < 2; i++) s->ctx.type->set(num_vec_at(&s->own.state[0], i), num_vec_at(&s->x, X_Z10 + i));
  status |= motion_run(&s->own, s);
  for (int eq = 0; eq < N_EQ; eq++)
    if (eqs >> eq & 1 && equations[eq].end > 0) status |= row_along(s, eq);
  if (eqs & (1U << EQ_F1 | 1U << EQ_F2)) status |= rows_solved(s, 0);
  if (eqs & (1U << EQ_G1 | 1U << EQ_G2)) status |= rows_solved(s, 1);
  return status;
}
