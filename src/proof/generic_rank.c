/* Why a rank that was seen at one point is that of almost all, and why none is larger. */
#include "generic_rank.h"

#include <stdlib.h>
#include <string.h>

#include "claim/claim.h"
#include "exact_motion_impl.h"
#include "record/result.h"

/* --- Analytic entries --- */

/* A program that gives what those instructions read, or give, in the place of its outputs. */
static struct tape probe(const struct tape *t, slong *outputs, enum tape_op op, bool operand) {
  struct tape p = *t;
  p.outputs = outputs;
  p.n_outputs = 0;
  for (slong i = 0; i < t->n; i++)
    if (t->code[i].op == op) outputs[p.n_outputs++] = operand ? t->code[i].a : i;
  return p;
}

/* Square roots are taken of what is positive: sqrt(chi*eta). */
static bool roots_of_positive(slong *n, const struct tape *t, slong *outputs) {
  struct tape p = probe(t, outputs, TAPE_sqrt, true);
  EXACT_FIELD f = exact_field_new(NULL, 0);
  OWNED(calc) c = exact_calc(f);
  struct num_vec v;
  bool ok = exact_eval(&v, &c, f, &p) == SS_OK;
  for (slong i = 0; ok && i < v.len; i++) ok = exact_unit_sign(f, at(&v, i)) > 0;
  *n = p.n_outputs;
  return ok;
}

/* The parameters by the frequencies; everything else is free. */
static int bind_parameter(element *z, struct exact_field *f, const char *name, void *motion) {
  struct exact_motion *m = motion;
  int i = word_find(name, name_param, N_PARAMS);
  if (i == N_PARAMS) return exact_symbol(z, f, name);
  num_exact.set(z, at(&m->params, i));
  return SS_OK;
}

/* Roots of polynomials are the frequencies, of which the squares are the two distinct eigenvalues of K: simple roots,
   which are analytic in the coefficients. */
static bool roots_are_simple(slong *n, const struct tape *t, slong *outputs) {
  static const struct exact_attempt modes = {.modes = true};
  static const struct point_spec anywhere = {.kind = POINT_PARAMS};
  struct tape p = probe(t, outputs, TAPE_ROOT, false);
  OWNED(exact_motion) m;
  struct num_vec v;
  exact_motion_begin(&m, &modes, &anywhere);
  exact_field_bind(m.field, bind_parameter, &m);
  bool ok = exact_eval(&v, &m.c, m.field, &p) == SS_OK && m.state_status == SS_OK;
  for (slong i = 0; ok && i < v.len; i++)
    ok = exact_equal(m.field, at(&v, i), at(&m.frequency, 0)) || exact_equal(m.field, at(&v, i), at(&m.frequency, 1));
  *n = p.n_outputs;
  return ok;
}

/* Sums, products, quotients, powers with whole exponents, sines and cosines of such functions are such. */
static bool is_elementary(enum tape_op op) {
  static const enum tape_op known[] = {TAPE_CONST, TAPE_INPUT, TAPE_POW,  TAPE_ROUNDED, TAPE_ROOT, TAPE_neg,
                                       TAPE_sqrt,  TAPE_sin,   TAPE_cos,  TAPE_cot,     TAPE_add,  TAPE_sub,
                                       TAPE_mul,   TAPE_div,   TAPE_sinc, TAPE_stumpff};
  for (size_t i = 0; i < sizeof known / sizeof *known; i++)
    if (known[i] == op) return true;
  return false;
}

/* sin(p/q) is no quotient of analytic functions: an angle must be a polynomial of its symbols and of the roots. */
static bool divides(const struct tape *t, slong i, bool *seen) {
  const struct tape_instr *in = &t->code[i];
  if (seen[i] || in->op == TAPE_CONST || in->op == TAPE_INPUT || in->op == TAPE_ROOT || in->op == TAPE_sqrt)
    return false;
  seen[i] = true;
  return in->op == TAPE_div || in->op == TAPE_cot || (in->op == TAPE_POW && in->k < 0) || divides(t, in->a, seen) ||
         (in->b >= 0 && divides(t, in->b, seen));
}

static bool is_analytic(struct text *why, const struct tape *t) {
  slong square, simple;
  FREED slong *outputs = ss_malloc((size_t)(t->n + 1) * sizeof *outputs);
  FREED bool *seen = ss_malloc((size_t)(t->n + 1) * sizeof *seen);
  bool ok = true;
  memset(seen, 0, (size_t)(t->n + 1) * sizeof *seen);
  for (slong i = 0; ok && i < t->n; i++) {
    enum tape_op op = t->code[i].op;
    bool angle = op == TAPE_sin || op == TAPE_cos || op == TAPE_cot || op == TAPE_sinc || op == TAPE_stumpff;
    ok = is_elementary(op) && !(angle && divides(t, t->code[i].a, seen));
  }
  ok = ok && roots_of_positive(&square, t, outputs) && roots_are_simple(&simple, t, outputs);
  if (!ok)
    text_add(why,
             "the entries of the derivative are not shown to be quotients of functions that are analytic on the whole "
             "domain");
  else
    text_printf(why,
                "on the connected domain of the parameters and unknowns each entry of the derivative is a quotient of "
                "analytic functions%s%s, so that a minor that is not zero at one point is not zero on an open and "
                "dense set",
                square ? "; the only square roots are of products of chi, eta and V" : "",
                simple ? "; omega_1 < 1 < omega_2 are simple roots" : "");
  return ok;
}

/* --- Equations that repeat others --- */

/* How many equations are another one, up to a number other than zero. */
static int repeated(struct text *note, struct exact_field *f, const struct num_vec *v, const int *status) {
  int n = 0;
  for (slong i = 1; i < v->len; i++) {
    slong k = 0;
    while (k < i && !(status[i] == SS_OK && status[k] == SS_OK && !exact_is_zero(at(v, i)) &&
                      exact_ratio_sign(f, at(v, i), at(v, k), NULL, 0)))
      k++;
    if (k == i) continue;
    text_printf(note, "; of the scalar equations number %ld is number %ld again, by exact algebra", (long)i + 1,
                (long)k + 1);
    n++;
  }
  return n;
}

static int repeated_equations(struct text *note, struct judge *j, const struct claim *c, struct view view) {
  struct override o[4];
  OWNED(elaboration) el;
  OWNED(tape) t = {.n = 0};
  struct diag d = {0};
  const struct expr *out[RANK_NAMES];
  int rows = 0, status[RANK_NAMES + 1], n = 0, free_states = 0;
  struct judge quiet = *j;
  quiet.d = &d;
  /* what the phases meet in, as free symbols: an identity whatever the states are is one */
  for (int i = 0; i < N_PHASES - 1; i++) free_states += oracle_override(&o[free_states], name_meeting[i]);
  elaboration_init(&el, view, o, free_states);
  if (rank_residuals(out, &rows, &el, &quiet, c, view_record(&view, claim_get(c, "statement"))) && rows > 0 &&
      elaboration_tape(&t, &el, out, rows, &d)) {
    struct num_vec v;
    EXACT_FIELD f = exact_field_new(NULL, 0);
    OWNED(calc) w = exact_calc(f);
    exact_eval_each(&v, status, &w, f, &t, NULL);
    n = repeated(note, f, &v, status);
  }
  return n;
}

struct generic_rank generic_rank_of(struct judge *j, const struct claim *c, struct view view,
                                    const struct rank_system *y) {
  struct generic_rank g = {0};
  struct text note = {0};
  g.analytic = is_analytic(&note, &y->s.tape);
  int rows = y->rows - repeated_equations(&note, j, c, view);
  g.most = rows < y->cols ? rows : y->cols;
  text_printf(&note, "; of %d equation%s in %d unknown%s no more than %d can be independent", rows,
              rows == 1 ? "" : "s", y->cols, y->cols == 1 ? "" : "s", g.most);
  g.note = result_take(j->out, &note);
  return g;
}
