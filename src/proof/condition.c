/* Conditions along the phases of an orbit, see condition.h.

   The rest of a tape's inputs are bound once for an orbit; only what moves is set anew for each time. */
#include "condition.h"

#include "claim/claim.h"
#include "exact_argument.h"
#include "motion/flow.h"
#include "num/calc.h"
#include "record/result.h"
#include "tape/exact.h"
#include "value/printed.h"
#include "value/values.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const char *const moving_name[N_MOVING] = {
    "z_1(t)",   "z_2(t)",   "z_1'(t)",  "z_2'(t)",  "t",         "x_1(t)",    "x_2(t)",    "x_1'(t)",  "x_2'(t)",
    "z_1''(t)", "z_2''(t)", "x_1''(t)", "x_2''(t)", "z_1'''(t)", "z_2'''(t)", "x_1'''(t)", "x_2'''(t)"};

/* --- Reading --- */

/* x_i at any time, which is z_i + d_0i. */
static bool reads_x(const struct tape *t) {
  struct motion_name n;
  bool any = false;
  for (slong i = 0; i < t->n_inputs; i++) any = any || (name_of_motion(&n, t->inputs[i]) && n.in_x && !n.primes);
  return any;
}

/* t_a + t_b of the second phase. */
static const struct expr *end_of(struct expr_pool *p, enum phase ph) {
  const struct expr *end = expr_sym(p, name_time[0]);
  for (int i = 1; i <= (int)ph; i++) end = expr_op2(p, EXPR_ADD, end, expr_sym(p, name_time[i]));
  return end;
}

/* The scalar, with the motion's values as plain symbols; at_end: at the end of its phase. */
static bool build(struct condition *c, bool *scalar, struct judge *j, const struct statement_record *r,
                  const struct stmt *st, int k, bool at_end, struct view view) {
  struct matrix a, b;
  c->s = (struct sentence){.n = 1, .cols = 1};
  elaboration_init(&c->s.el, view, NULL, 0);
  if (!elaborate_sides(&a, &b, &c->s.el, st, k, r->src, r->section, j->d)) return false;
  *scalar = a.rows * a.cols == 1;
  if (!*scalar) return false;
  bool less = st->ops[k] == REL_LT || st->ops[k] == REL_LE;
  const struct expr *margin = expr_op2(&c->s.el.pool, EXPR_SUB, less ? b.e[0] : a.e[0], less ? a.e[0] : b.e[0]);
  if (at_end) margin = expr_subst(&c->s.el.pool, margin, "t", end_of(&c->s.el.pool, c->phase));
  if (!elaboration_tape(&c->s.tape, &c->s.el, &margin, 1, j->d)) return false;
  c->equality = st->ops[k] == REL_EQ;
  c->strict = st->ops[k] == REL_LT || st->ops[k] == REL_GT;
  for (int m = 0; m < N_MOVING; m++) {
    c->input[m] = tape_input(&c->s.tape, moving_name[m]);
    c->moving = c->moving || c->input[m] >= 0;
    c->in_x = c->in_x || (m >= MOVING_X && m < MOVING_SECOND && c->input[m] >= 0);
  }
  for (int m = 0; m < 2; m++)
    c->friction[m] = reads_x(&c->s.tape) || tape_input(&c->s.tape, m ? "u_r2" : "u_r1") >= 0 ||
                     tape_input(&c->s.tape, m ? "u_s2" : "u_s1") >= 0;
  c->has_rate = c->moving && !elaboration_root_of(&c->s.el, "t");
  if (!c->has_rate) return true;
  margin = expr_diff(&c->s.el.pool, margin, "t");
  bool ok = elaboration_tape(&c->rate, &c->s.el, &margin, 1, j->d);
  for (slong i = 0; i < c->rate.n_inputs; i++)
    if (word_find(c->rate.inputs[i], moving_name, N_MOVING) == N_MOVING &&
        tape_input(&c->s.tape, c->rate.inputs[i]) < 0)
      c->has_rate = false;
  return ok;
}

/* A statement that is no condition: the claim's fault, or, of an overlay's and what a control makes of it, nothing that
   is decided. */
static bool no_condition(struct judge *j, const struct claim *claim, const char *attribute,
                         const struct statement_record *r, const struct stmt *st, const char *wrong) {
  if (r->rank != RANK_USER && r->rank != RANK_CONTROL) return claim_error(j, claim, attribute, wrong);
  diag_beyond(j->d);
  return diag_at(j->d, r->src, st->sides[0]->span.begin, "%s", wrong);
}

/* A step, along a phase or (at_end) where that ends. */
static bool add_step(struct conditions *list, struct judge *j, const struct claim *claim, const char *attribute,
                     const struct statement_record *r, const struct stmt *st, int k, enum phase ph, bool at_end,
                     struct view view) {
  if (list->n == MAX_CONDITIONS) return claim_error(j, claim, attribute, "too many conditions");
  struct condition *c = &list->at[list->n++];
  *c = (struct condition){.equation = *r->equation ? r->equation : NULL,
                          .phase = ph,
                          .vanishes = {TRUTH_UNKNOWN, TRUTH_UNKNOWN, TRUTH_UNKNOWN}};
  bool scalar = true;
  if (!build(c, &scalar, j, r, st, k, at_end, view)) {
    if (!scalar) no_condition(j, claim, attribute, r, st, "a condition needs scalars");
    return false;
  }
  struct text t = {0};
  stmt_print_step(&t, st, k);
  if (at_end) text_printf(&t, " at t = %s", name_switching[(int)ph + 1]);
  c->text = result_take(j->out, &t);
  return true;
}

/* The phase with both masses at rest takes time on admissible solutions, and perhaps on the scene's. */
static bool stick_takes_time(struct judge *j, const struct claim *claim) {
  bool at_scene = claim_says(claim, "over", "scene") && j->scene; /* none where two texts of a claim are compared */
  const struct dyn_orbit *o = at_scene ? scene_orbit(j->scene, j->cache) : NULL;
  return claim_kind(claim) == KIND_ARGUMENT &&
         (at_scene ? o && arb_is_positive(o->t[0]) : claim_over_admissible(claim));
}

/* The phases for which a statement is said: of several, each, if the first surely takes time; of a claim of kind range,
   one. */
static bool phases_of(enum phase *first, enum phase *last, struct judge *j, const struct claim *claim,
                      const struct cited *at, const struct statement_record *r, const struct stmt *st) {
  *first = *last = *at->phase ? (enum phase)word_find(at->phase, phase_name, N_PHASES) : PHASE_D;
  if (!st->range_hi) return true;
  *first = name_of_span(last, st);
  const char *wrong = NULL;
  if (*first == N_PHASES)
    wrong = "this range is no phase of the motion without its ends, nor several in a row";
  else if (*first != *last && claim_kind(claim) == KIND_RANGE)
    wrong = "a claim of kind range is of one phase: state this for each phase in a record of its own";
  else if (*first != *last && *first == PHASE_D && !stick_takes_time(j, claim))
    wrong = "on a solution that need not be admissible the first of these phases may take no time: state this for "
            "(0, t_a) and for the phases behind it in two statements";
  if (wrong) diag_beyond(j->d);
  return !wrong || diag_at(j->d, r->src, st->range_lo->span.begin, "%s", wrong);
}

/* A condition for each phase, and, of one that is strict, for the moments between two: there it holds by continuity
   only with equality. */
static bool add_cited(struct conditions *list, struct judge *j, const struct claim *claim, const char *attribute,
                      const struct cited *at, struct view view) {
  if (at->misnumbered) return claim_error(j, claim, attribute, "a statement of a record reads ID#1 or ID#1.2");
  if (*at->phase && word_find(at->phase, phase_name, N_PHASES) == N_PHASES)
    return claim_error(j, claim, attribute, "no such phase");
  const struct statement_record *r = view_record(&view, at->id);
  if (!r) return claim_error(j, claim, attribute, "there is no such record in the equation files");
  bool any = false, ok = true;
  for (int i = 0; i < r->n_stmts; i++) {
    const struct stmt *st = r->stmts[i];
    enum phase first, last;
    if (st->kind != STMT_RELATION || (at->statement && i + 1 != at->statement)) continue;
    if (!phases_of(&first, &last, j, claim, at, r, st)) return false;
    for (int k = 0; k + 1 < st->n_sides; k++) {
      if (at->step > 0 && k + 1 != at->step) continue;
      for (int ph = (int)first; ok && ph <= (int)last; ph++) {
        ok = add_step(list, j, claim, attribute, r, st, k, (enum phase)ph, false, view);
        const struct condition *c = &list->at[list->n - 1];
        if (!ok || !c->moving) break;
        if (!st->range_hi && !*at->phase)
          return no_condition(j, claim, attribute, r, st, "a condition at the time t needs a phase");
        if (ph < (int)last && c->strict) ok = add_step(list, j, claim, attribute, r, st, k, (enum phase)ph, true, view);
      }
      if (!ok) return false;
      any = true;
    }
  }
  return any || claim_error(j, claim, attribute, "there is no such statement or step in the record");
}

bool conditions_read(struct conditions *list, struct judge *j, const struct claim *c, const char *attribute,
                     struct view view) {
  struct cited at;
  list->n = 0;
  for (const char *p = claim_get(c, attribute); p && *p; p += *p == ',') {
    if (p[strspn(p, " ")] == ',' || !(p = claim_next_cited(&at, p)))
      return claim_error(j, c, attribute, "an empty item");
    if (!add_cited(list, j, c, attribute, &at, view)) return false;
  }
  return true;
}

bool conditions_any_strict(const struct conditions *list) {
  bool any = false;
  for (int k = 0; k < list->n; k++) any = any || list->at[k].strict;
  return any;
}

bool conditions_admit_equality(const struct conditions *list) {
  bool any = false;
  for (int k = 0; k < list->n; k++) any = any || !(list->at[k].equality || list->at[k].strict);
  return any;
}

bool conditions_use_friction(const struct conditions *list) {
  bool any = false;
  for (int k = 0; k < list->n; k++) any = any || list->at[k].friction[0] || list->at[k].friction[1];
  return any;
}

static bool keeps_from_zero(const struct condition *k, enum phase ph) {
  if (!k->strict || !k->moving || k->phase != ph) return false;
  EXACT_FIELD f = exact_field_new(NULL, 0);
  OWNED(calc) c = exact_calc(f);
  struct num_vec margin, p = calc_vec(&c, N_PARAMS), z = calc_vec(&c, N_STATE);
  val params[N_PARAMS], state[N_STATE];
  flow_vals(params, &p, 0, N_PARAMS);
  flow_vals(state, &z, 0, N_STATE);
  for (int i = 0; i < N_PARAMS; i++) c.status |= exact_symbol(num_vec_at(&p, i), f, name_param[i]);
  for (int i = 0; i < N_STATE; i++) c.status |= exact_symbol(num_vec_at(&z, i), f, moving_name[i]);
  val switching = flow_switching(&c, ph, params, state);
  return c.status == SS_OK && exact_eval(&margin, &c, f, &k->s.tape) == SS_OK &&
         exact_ratio_sign(f, num_vec_at(&margin, 0), switching, name_param, N_PARAMS) != 0;
}

bool conditions_make_first(const struct conditions *list) {
  bool all = true;
  for (int ph = PHASE_GAMMA; ph < N_PHASES; ph++) {
    bool any = false;
    for (int k = 0; k < list->n && !any; k++) any = keeps_from_zero(&list->at[k], (enum phase)ph);
    all = all && any;
  }
  return all;
}

void conditions_clear(struct conditions *list) {
  for (int i = 0; i < list->n; i++) {
    tape_clear(&list->at[i].rate);
    sentence_clear(&list->at[i].s);
  }
  list->n = 0;
}

/* --- Evaluating --- */

/* A condition at an orbit: everything bound but what moves. */
struct bound {
  struct values *v;
  struct condition *c;
  struct num_vec in, out, d; /* d: d_01 and d_02, where it reads x */
};

static int bind(struct bound *b, struct condition *c, struct values *v) {
  *b = (struct bound){v, c, calc_vec(&v->c, c->s.tape.n_inputs), calc_vec(&v->c, 1), calc_vec(&v->c, 2)};
  int s = SS_OK;
  for (slong i = 0; i < c->s.tape.n_inputs; i++) {
    bool moves = false, known;
    for (int m = 0; m < N_MOVING; m++) moves = moves || c->input[m] == i;
    if (moves) continue;
    s |= values_bind(num_vec_at(&b->in, i), &known, v, c->s.tape.inputs[i]);
    if (!known) c->unbound = c->s.tape.inputs[i];
  }
  for (int i = 0; c->in_x && i < 2; i++) {
    struct num_vec d = {v->ctx, 1, num_vec_at(&b->d, i)};
    s |= oracle_eval(&d, oracle_find(i == 0 ? "d_01" : "d_02"), v);
  }
  return v->have_t ? s | SS_UNABLE : s; /* something else moves, and has the value of one moment */
}

/* The margin with the moving inputs x (N_MOVING), or those bound alone. */
static int margin_at(void *z, struct bound *b, const struct num_vec *x) {
  for (int m = 0; x && m < N_MOVING; m++)
    if (b->c->input[m] >= 0) b->v->ctx.type->set(num_vec_at(&b->in, b->c->input[m]), num_vec_at(x, m));
  int s = tape_eval(&b->out, NULL, &b->c->s.tape, &b->in);
  b->v->ctx.type->set(z, num_vec_at(&b->out, 0));
  return s;
}

/* The state after the time tau of the phase, by the variant's means, its second and third derivatives, and the time
   since the start of the period; rate: of the state. */
static int moving_at(struct num_vec *x, struct num_vec *rate, const struct bound *b, enum phase ph, const void *tau) {
  struct values *v = b->v;
  OWNED(calc) c = calc_begin(v->ctx);
  struct num_vec z = calc_vec(&c, N_STATE), a = calc_vec(&c, N_STATE * N_STATE), third = calc_vec(&c, N_STATE);
  const struct num_type *t = v->ctx.type;
  int s = values_along(&z, rate, v, ph, tau) | dyn_system(&a, ph, &v->params) |
          num_mat_mul(&third, &a, rate, N_STATE, N_STATE, 1);
  for (int i = 0; i < 4; i++) {
    void *there = num_vec_at(x, MOVING_X + i);
    t->set(num_vec_at(x, i), num_vec_at(&z, i));
    t->set(there, num_vec_at(&z, i));
    if (i < 2 && b->c->in_x) s |= t->add(there, there, num_vec_at(&b->d, i), v->ctx.prec);
    t->set(num_vec_at(x, MOVING_SECOND + i), num_vec_at(rate, DZ_1 + i % 2));
    t->set(num_vec_at(x, MOVING_THIRD + i), num_vec_at(&third, DZ_1 + i % 2));
  }
  void *time = num_vec_at(x, MOVING_T);
  t->set(time, tau);
  for (int k = 0; k < (int)ph; k++) s |= t->add(time, time, num_vec_at(&v->arc.t, k), v->ctx.prec);
  return s;
}

/* --- Sampling in double --- */

/* One of them is no simple fraction, at which an equation might hold that holds at few moments. */
static const double fractions[] = {1 / 128., 1 / 16.,  2 / 16.,  3 / 16.,  4 / 16.,  5 / 16.,
                                   6 / 16.,  0.381966, 7 / 16.,  8 / 16.,  9 / 16.,  10 / 16.,
                                   11 / 16., 12 / 16., 13 / 16., 14 / 16., 15 / 16., 127 / 128.};
enum { N_FRACTIONS = sizeof fractions / sizeof *fractions };

static int least_margin(double *least, struct bound *b) {
  struct values *v = b->v;
  struct num_vec x = calc_vec(&v->c, N_MOVING), rate = calc_vec(&v->c, N_STATE);
  int s = SS_OK;
  *least = INFINITY;
  for (int i = 0; s == SS_OK && i < (b->c->moving ? N_FRACTIONS : 1); i++) {
    double m = 0, tau = fractions[i] * v->ctx.type->get_d(num_vec_at(&v->arc.t, (int)b->c->phase));
    if (b->c->moving) s |= moving_at(&x, &rate, b, b->c->phase, &tau);
    s |= margin_at(&m, b, b->c->moving ? &x : NULL);
    *least = fmin(*least, b->c->equality ? -fabs(m) : m);
  }
  return s;
}

/* The friction is set in the point's values, which the next binding reads. */
static int least_with_friction(double *least, struct condition *c, struct values *v, double us1, double us2) {
  struct bound b;
  v->ctx.type->set_d(num_vec_at(&v->q, Q_US1), us1, 53);
  v->ctx.type->set_d(num_vec_at(&v->q, Q_US2), us2, 53);
  int s = bind(&b, c, v);
  return s == SS_OK ? least_margin(least, &b) : s;
}

int conditions_sample(struct sampled *out, struct conditions *list, const struct point *p, struct orbit_cache *cache) {
  OWNED(values) v;
  int s = values_init(&v, p, VARIANT_CLOSED, num_ctx_double(), cache);
  if (s == SS_OK) {
    double belt = v.ctx.type->get_d(num_vec_at(&v.params, P_V));
    for (int i = 0; s == SS_OK && i < list->n; i++) {
      struct condition *c = &list->at[i];
      s |= least_with_friction(&out[i].least, c, &v, 0, 0);
      double by = fmax(belt, fabs(out[i].least)); /* beside a large margin the belt alone would be rounded away */
      for (int m = 0; m < 2; m++) {
        double with = out[i].least;
        if (c->friction[m]) s |= least_with_friction(&with, c, &v, m == 0 ? by : 0, m == 1 ? by : 0);
        out[i].slope[m] = (with - out[i].least) / by;
      }
      out[i].least /= belt;
    }
  }
  return s;
}

/* --- Deciding in balls --- */

/* Enclosures tell what is not zero; that a margin is, exact algebra has to, which is asked once. */
static bool is_zero(struct condition *c, enum exact_time time) {
  truth *known = &c->vanishes[time];
  if (*known == TRUTH_UNKNOWN) *known = exact_vanishes(c, time) ? TRUTH_TRUE : TRUTH_FALSE;
  return *known == TRUTH_TRUE;
}

/* The margin and its rate for every time of the ball tau. */
static int margin_over(arb_t value, arb_t rate, struct bound *b, const arb_t tau) {
  const struct tape *t = &b->c->rate;
  OWNED(calc) w = calc_begin(b->v->ctx);
  struct num_vec x = calc_vec(&w, N_MOVING), dz = calc_vec(&w, N_STATE), in = calc_vec(&w, t->n_inputs),
                 out = calc_vec(&w, 1);
  int s = moving_at(&x, &dz, b, b->c->phase, tau) | margin_at(value, b, &x);
  for (slong i = 0; b->c->has_rate && i < in.len; i++) {
    int m = word_find(t->inputs[i], moving_name, N_MOVING);
    arb_set(num_vec_at(&in, i),
            m < N_MOVING ? num_vec_at(&x, m) : num_vec_at(&b->in, tape_input(&b->c->s.tape, t->inputs[i])));
  }
  bool known = s == SS_OK && b->c->has_rate && tape_eval(&out, NULL, t, &in) == SS_OK;
  arb_indeterminate(rate);
  if (s != SS_OK) arb_indeterminate(value);
  if (known) arb_set(rate, num_vec_at(&out, 0));
  return s;
}

struct along {
  struct bound *b;
  arb_srcptr length;
  bool zero[2];  /* the margin is zero at the start, at the end */
  double *where; /* it fails, and the margin there */
  arb_ptr value;
  long budget; /* of pieces; a margin that hugs zero would have no end of them */
};

static void fraction_time(arb_t tau, const struct along *a, double lo, double hi) {
  arb_set_d(tau, 0.5 * (lo + hi));
  mag_set_d(arb_radref(tau), 0.5 * (hi - lo));
  arb_mul(tau, tau, a->length, a->b->v->ctx.prec);
}

static truth piece_holds(struct along *a, double lo, double hi, int depth) {
  enum { MAX_DEPTH = DBL_MANT_DIG - 1 }; /* the ends of a piece are doubles */
  ARB_VECTOR(w, 6);
  arb_ptr tau = w, at = w + 1, rate_at = w + 2, all = w + 3, rate = w + 4, shift = w + 5;
  bool at_zero = (lo == 0 && a->zero[0]) || (hi == 1 && a->zero[1]);
  double mid = 0.5 * (lo + hi);
  truth holds = TRUTH_UNKNOWN;
  fraction_time(tau, a, mid, mid);
  int s = margin_over(at, rate_at, a->b, tau);
  if (s == SS_OK && arb_is_negative(at)) {
    *a->where = mid;
    arb_set(a->value, at);
    holds = TRUTH_FALSE;
  }
  if (s == SS_OK && holds == TRUTH_UNKNOWN) {
    fraction_time(tau, a, lo, hi);
    margin_over(all, rate, a->b, tau); /* without a value, perhaps, where its parts have one */
    fraction_time(shift, a, -0.5 * (hi - lo), 0.5 * (hi - lo));
    arb_mul(shift, shift, rate, a->b->v->ctx.prec);
    arb_add(shift, shift, at, a->b->v->ctx.prec);
    if (arb_is_positive(shift) || arb_is_positive(all)) holds = TRUTH_TRUE;
    if (at_zero && !(lo == 0 && hi == 1)) /* from zero at the one end the margin only grows */
      if (lo == 0 ? arb_is_positive(rate) : arb_is_negative(rate)) holds = TRUTH_TRUE;
  }
  if (s != SS_OK || holds != TRUTH_UNKNOWN || depth >= MAX_DEPTH || a->budget-- <= 0) return holds;
  holds = piece_holds(a, lo, mid, depth + 1);
  return holds == TRUTH_FALSE ? holds : truth_and(holds, piece_holds(a, mid, hi, depth + 1));
}

/* In a phase that takes no time a condition along it says nothing, and holds; unknown where it may take none. */
static bool may_say_nothing(truth *holds, const struct bound *b) {
  if (!b->c->moving) return false;
  arb_srcptr length = num_vec_at(&b->v->arc.t, (int)b->c->phase);
  *holds = arb_is_nonpositive(length) ? TRUTH_TRUE : TRUTH_UNKNOWN;
  return !arb_is_positive(length);
}

static truth holds_along(double *where, arb_t value, struct bound *b) {
  struct along a = {
      .where = where, .value = value, .budget = 5000, .b = b, .length = num_vec_at(&b->v->arc.t, (int)b->c->phase)};
  ARB_VECTOR(w, 4);
  for (int end = 0; end < 2; end++) { /* where it may have no value */
    arb_ptr at = w + 2 + end;
    if (end) arb_set(w, a.length);
    margin_over(at, w + 1, b, w);
    a.zero[end] = arb_contains_zero(at) && is_zero(b->c, end ? TIME_END : TIME_START);
  }
  truth holds = piece_holds(&a, 0, 1, 0);
  for (int end = 0; holds == TRUTH_UNKNOWN && end < 2; end++) {
    if (!arb_is_negative(w + 2 + end)) continue; /* so it is beside the end, be it for less than doubles tell apart */
    holds = TRUTH_FALSE;
    *where = end;
    arb_set(value, w + 2 + end);
  }
  return holds;
}

/* Enclosures do not tell that a margin is zero, which is set so where exact algebra does; of one along a phase no
   moments tell that it is at all others. */
static truth sign_of(arb_t m, struct condition *c) {
  bool zero = arb_contains_zero(m) && ((!c->moving && arb_is_zero(m)) || is_zero(c, TIME_INSIDE));
  if (zero) arb_zero(m);
  if (zero) return c->strict ? TRUTH_FALSE : TRUTH_TRUE;
  if (arb_contains_zero(m)) return TRUTH_UNKNOWN;
  return !c->equality && arb_is_positive(m) ? TRUTH_TRUE : TRUTH_FALSE;
}

/* At a fraction of the phase, or at the one moment that the condition names, with the margin there. */
static truth holds_at(arb_t m, struct bound *b, double where) {
  OWNED(calc) w = calc_begin(b->v->ctx);
  struct num_vec x = calc_vec(&w, N_MOVING), rate = calc_vec(&w, N_STATE), tau = calc_vec(&w, 1);
  arb_ptr time = num_vec_at(&tau, 0);
  int s = SS_OK;
  if (b->c->moving) {
    arb_set_d(time, where);
    arb_mul(time, time, num_vec_at(&b->v->arc.t, (int)b->c->phase), FIRST_PREC);
    s |= moving_at(&x, &rate, b, b->c->phase, time);
  }
  s |= margin_at(m, b, b->c->moving ? &x : NULL);
  return s == SS_OK ? sign_of(m, b->c) : TRUTH_UNKNOWN;
}

/* At each of the moments; where it fails most of these. */
static truth holds_at_samples(double *where, arb_t value, struct bound *b) {
  NUMBERS(arb, m);
  truth holds = TRUTH_TRUE;
  for (int i = 0; i < (b->c->moving ? N_FRACTIONS : 1); i++) {
    truth here = holds_at(m, b, fractions[i]);
    if (here == TRUTH_FALSE && (holds != TRUTH_FALSE || arf_cmpabs(arb_midref(m), arb_midref(value)) > 0)) {
      *where = fractions[i];
      arb_set(value, m);
    }
    holds = truth_and(holds, here);
  }
  return holds;
}

truth condition_holds(double *where, arb_ptr value, struct condition *c, const struct point *p,
                      struct orbit_cache *cache) {
  OWNED(values) v;
  struct bound b;
  double at = 0;
  NUMBERS(arb, margin);
  truth holds = TRUTH_UNKNOWN;
  bool along = c->moving && !c->equality;
  int s = values_init(&v, p, VARIANT_CLOSED, num_ctx_arb(FIRST_PREC), cache);
  if (s == SS_OK) s |= bind(&b, c, &v);
  bool says = s == SS_OK && !may_say_nothing(&holds, &b);
  if (says && along) holds = holds_along(&at, margin, &b);
  if (says && holds == TRUTH_UNKNOWN) {
    truth sampled = holds_at_samples(&at, margin, &b);
    if (!along || sampled == TRUTH_FALSE || is_zero(c, TIME_INSIDE)) holds = sampled;
  }
  if (where) *where = at;
  if (value) arb_set(value, margin);
  return holds;
}

truth conditions_hold(struct conditions *list, const struct point *p, struct orbit_cache *cache) {
  truth all = TRUTH_TRUE;
  for (int k = 0; k < list->n && all != TRUTH_FALSE; k++)
    all = truth_and(all, condition_holds(NULL, NULL, &list->at[k], p, cache));
  return all;
}

truth condition_holds_at(struct condition *c, const struct point *p, double where, struct orbit_cache *cache) {
  OWNED(values) v;
  struct bound b;
  truth holds = TRUTH_UNKNOWN;
  NUMBERS(arb, margin);
  int s = values_init(&v, p, VARIANT_EXPONENTIAL, num_ctx_arb(FIRST_PREC), cache);
  if (s == SS_OK) s |= bind(&b, c, &v);
  if (s == SS_OK && !may_say_nothing(&holds, &b))
    holds = where < 0 ? holds_at_samples(&where, margin, &b) : holds_at(margin, &b, where);
  return holds;
}
