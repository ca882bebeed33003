/* Divisors are collected from the trees of a record, so that none is left out, and each is shown not to be zero by its
   factors.  Two velocities that an admissible motion has below the belt's, for a reason that is checked here, give the
   factors that no sign of the parameters does. */
#include "nonzero.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "exact_argument.h"
#include "exact_motion_impl.h"
#include "num/calc.h"
#include "value/expression.h"

/* --- What is divided by --- */

static bool add_formula(struct divisor *list, int *n, const char *section, const char *formula, bool root) {
  for (int i = 0; i < *n; i++)
    if (strcmp(list[i].formula, formula) == 0 && strcmp(list[i].section, section) == 0 && list[i].root == root)
      return true;
  if (*n == MOST_DIVISORS) return false;
  list[(*n)++] = (struct divisor){formula, section, root};
  return true;
}

static bool add_divisor(struct divisor *list, int *n, struct arena *a, const char *section, const char *wrap,
                        const struct expr *e, bool root) {
  struct text t = {0};
  text_add(&t, wrap);
  expr_print(&t, expr_bare(e));
  text_add(&t, *wrap ? ")" : "");
  return add_formula(list, n, section, text_take(a, &t), root);
}

/* A number other than zero divides everywhere. */
static bool is_unit(const struct expr *e) {
  return e->kind == EXPR_NUM && isdigit((unsigned char)e->name[strspn(e->name, "0.")]); /* not in 0.0, not in 0e5 */
}

static bool collect(struct divisor *list, int *n, struct arena *a, const char *section, const struct expr *e) {
  bool ok = true;
  if (e->kind == EXPR_DIV && !is_unit(e->args[1])) ok = add_divisor(list, n, a, section, "", e->args[1], false);
  if (e->kind == EXPR_POW && e->exponent < 0) ok = add_divisor(list, n, a, section, "", e->args[0], false);
  if (e->kind == EXPR_INV) ok = add_divisor(list, n, a, section, "det(", e->args[0], false);
  if (e->kind == EXPR_COT) ok = add_divisor(list, n, a, section, "sin(", e->args[0], false);
  if (e->kind == EXPR_SQRT) ok = add_divisor(list, n, a, section, "", e->args[0], true);
  for (int i = 0; ok && i < e->n_args; i++) ok = collect(list, n, a, section, e->args[i]);
  return ok;
}

/* Of the sides of a relation, of what a definition defines, and the root of an equation, which need not have a positive
   one: where its sign is known there is one. */
static bool collect_stmt(struct divisor *list, int *n, struct arena *a, const char *section, const struct stmt *s) {
  bool ok = true;
  for (int i = 0; ok && i < (s->kind == STMT_RELATION ? s->n_sides : 1); i++)
    ok = collect(list, n, a, section, s->sides[i]);
  return ok && (s->kind != STMT_ROOT || add_formula(list, n, section, s->name, false));
}

static bool collect_definitions(struct divisor *list, int *n, struct arena *a, struct elaboration *el) {
  bool ok = true;
  for (size_t i = 0; ok && i < elaboration_n_used(el); i++) {
    const struct definition *used = elaboration_used(el, i);
    if (used) ok = collect_stmt(list, n, a, used->section, used->stmt);
  }
  return ok;
}

/* And of the definitions, of any record, that it puts in; those of an argument are at any argument. */
static bool collect_used(struct divisor *list, int *n, struct arena *a, const struct definition *of, struct view view) {
  const struct stmt *s = of->stmt;
  const struct override argument = {s->kind == STMT_DEFINE ? s->param : NULL, 1, 1};
  OWNED(elaboration) el;
  struct matrix m;
  struct diag d = {0};
  elaboration_init(&el, view, &argument, argument.name != NULL);
  if (s->kind == STMT_RELATION)
    relation_check(&el, s, of->src, of->section, &d);
  else
    elaborate(&m, &el, s->sides[0], of->src, of->section, &d);
  return collect_definitions(list, n, a, &el);
}

bool divisors_of(struct divisor *list, int *n, struct arena *a, const struct statement_record *r, struct view view) {
  bool ok = true;
  for (int k = 0; ok && k < r->n_stmts; k++) {
    const struct definition of = view_stated(&view, r, r->stmts[k]);
    ok = collect_stmt(list, n, a, of.section, of.stmt);
  }
  for (int k = 0; ok && k < r->n_stmts; k++) {
    const struct definition of = view_stated(&view, r, r->stmts[k]);
    ok = collect_used(list, n, a, &of, view);
  }
  return ok;
}

/* --- Motions with free states --- */

void exact_motion_free(struct exact_motion *m, bool modes, int anchor, const struct tape *reads) {
  const struct exact_attempt a = {.modes = modes, .anchor = anchor};
  static const struct point_spec orbit = {.kind = POINT_ORBIT};
  exact_motion_init(m, &a, &orbit, reads);
}

/* The blocks behind (1) are positive numbers of their own. */
static const char *const blocks[] = {"m_1", "m_2", "k_1", "k_2"};
enum { N_BLOCKS = 4 };

static int bind(element *z, struct exact_field *f, const char *name, void *motion) {
  return word_find(name, blocks, N_BLOCKS) < N_BLOCKS ? exact_symbol(z, f, name)
                                                      : exact_motion_bind(z, f, name, motion);
}

/* --- Signs --- */

enum { MOST_POSITIVE = 16 };
/* A symbol k > 0: with chi = k/(1 + k), 2 - chi is (2 + k)/(1 + k), whose terms all have one sign. */
static const char ratio[] = "chi/(1 - chi)";

/* What is positive on every motion, e_1, e_2 and the ratio; the blocks and the sum of the springs, or with modes, where
   0 < w_1 < 1 < w_2, the sum and the difference of these. */
static int positive_elements(struct num_vec *out, struct exact_motion *m) {
  OWNED(calc) c = exact_calc(m->field);
  int n = exact_motion_positive(out, m);
  if (n == 0) return 0;
  c.status |= exact_symbol(at(out, n++), m->field, ratio);
  for (int i = P_E1; i <= P_E2; i++) c.status |= exact_symbol(at(out, n++), m->field, name_param[i]);
  if (m->attempt.modes) {
    val w1 = at(&m->frequency, 0), w2 = at(&m->frequency, 1);
    calc_store(&c, at(out, n++), calc_sub(&c, w2, w1));
    calc_store(&c, at(out, n++), calc_add(&c, w2, w1));
  } else {
    for (int i = 0; i < N_BLOCKS; i++) c.status |= exact_symbol(at(out, n++), m->field, blocks[i]);
    calc_store(&c, at(out, n), calc_add(&c, at(out, n - 2), at(out, n - 1)));
    n++;
  }
  return c.status == SS_OK ? n : 0;
}

int motion_sign(const element *x, struct exact_motion *m) {
  struct num_vec positive = calc_vec(&m->c, MOST_POSITIVE);
  int n = positive_elements(&positive, m);
  return n ? exact_product_sign(x, at(&positive, 0), n) : 0;
}

/* Is x, or x times the square roots in it, such as sqrt(chi*eta), up to its sign a product of what is positive?  x is
   lost. */
static bool is_product(element *x, struct exact_motion *m) {
  return motion_sign(x, m) != 0 || (exact_times_roots(x, m->field) && motion_sign(x, m) != 0);
}

/* How chi and eta are written: as they are; by w_1 and w_2; chi by the ratio. */
enum writing { AS_THEY_ARE, BY_MODES, BY_RATIO, N_WRITINGS };

static bool has_sign(const struct tape *t, enum writing w, bool root) {
  OWNED(exact_motion) m;
  exact_motion_free(&m, w == BY_MODES, 4, t);
  exact_field_bind(m.field, bind, &m);
  element *x = calc_new(&m.c), *k = calc_new(&m.c);
  if (w == BY_RATIO) {
    m.c.status |= exact_symbol(k, m.field, ratio);
    calc_store(&m.c, at(&m.params, P_CHI), calc_div(&m.c, k, calc_add(&m.c, k, calc_d(&m.c, 1))));
  }
  return exact_margin(x, &m, t) && (root ? motion_sign(x, &m) > 0 : is_product(x, &m));
}

/* --- Velocities below the belt's --- */

static bool continuous(struct exact_motion *m, int k, int before, int after, int component) {
  struct num_vec f = calc_vec(&m->c, 4), g = calc_vec(&m->c, 4);
  return motion_rate_at(&f, m, k, before) == SS_OK && motion_rate_at(&g, m, k, after) == SS_OK &&
         exact_equal(m->field, at(&f, component), at(&g, component));
}

/* (z_1'')^2 + (z_1' - chi V)^2 at a state of phase Gamma. */
static val energy(struct calc *c, struct exact_motion *m, const struct num_vec *z, const struct num_vec *rate) {
  val v = calc_sub(c, at(z, DZ_1), calc_mul(c, at(&m->params, P_CHI), at(&m->params, P_V)));
  return calc_add(c, calc_mul(c, at(rate, DZ_1), at(rate, DZ_1)), calc_mul(c, v, v));
}

/* Its derivative along phase Gamma at any state: 2 z_1'' (z_1''' + z_1' - chi V). */
static bool energy_is_kept(struct exact_motion *m) {
  OWNED(calc) c = exact_calc(m->field);
  struct num_vec z, f = calc_vec(&c, 4), g = calc_vec(&c, 4);
  c.status = motion_state(&z, m, 2) | motion_rate(&f, m, PHASE_GAMMA, &z);
  if (c.status == SS_OK) c.status = motion_rate(&g, m, PHASE_GAMMA, &f);
  val v = calc_sub(&c, at(&z, DZ_1), calc_mul(&c, at(&m->params, P_CHI), at(&m->params, P_V)));
  val sum = calc_add(&c, at(&g, DZ_1), v);
  return c.status == SS_OK && exact_is_zero(sum);
}

const char *first_mass_is_slower(void) {
  OWNED(exact_motion) m;
  exact_motion_free(&m, false, 4, NULL);
  struct num_vec z, f = calc_vec(&m.c, 4);
  m.c.status = motion_state(&z, &m, 1) | motion_rate_at(&f, &m, 1, PHASE_GAMMA);
  val at_start = energy(&m.c, &m, &z, &f);
  void *e1 = calc_new(&m.c);
  m.c.status |= exact_symbol(e1, m.field, name_param[P_E1]);
  /* with z_1' = V again, z_1''^2 = e_1^2 */
  val v = calc_mul(&m.c, at(&m.params, P_V), calc_sub(&m.c, calc_d(&m.c, 1), at(&m.params, P_CHI)));
  val left = calc_sub(&m.c, calc_sub(&m.c, at_start, calc_mul(&m.c, v, v)), calc_mul(&m.c, e1, e1));
  bool ok =
      m.c.status == SS_OK && exact_is_zero(left) && energy_is_kept(&m) && continuous(&m, 2, PHASE_GAMMA, PHASE_H, DZ_1);
  return ok ? "z_1' < V at t_a + t_b, since with z_1' = V there z_1'' would be e_1 or -e_1 and z_1' would exceed V "
              "just after or just before"
            : NULL;
}

/* Two masses at one place with the belt's velocity stay so in phase C. */
static bool second_mass_would_stay(struct exact_motion *m) {
  struct num_vec z = calc_vec(&m->c, 4), f = calc_vec(&m->c, 4);
  int s = exact_symbol(at(&z, Z_1), m->field, "z");
  num_exact.set(at(&z, Z_2), at(&z, Z_1));
  for (int i = DZ_1; i <= DZ_2; i++) num_exact.set(at(&z, i), at(&m->params, P_V));
  if (s == SS_OK) s = motion_rate(&f, m, PHASE_C, &z);
  return s == SS_OK && exact_is_zero(at(&f, DZ_2)) && exact_equal(m->field, at(&f, Z_1), at(&f, Z_2));
}

const char *second_mass_is_slower(void) {
  OWNED(exact_motion) m;
  exact_motion_free(&m, false, 4, NULL);
  bool ok = continuous(&m, 3, PHASE_H, PHASE_C, DZ_2) && second_mass_would_stay(&m);
  return ok ? "z_2' < V at t_a + t_b + t_c, since with z_2' = V there z_2'', which is continuous, would be zero, else "
              "z_2' > V just before or just after, and z_2' would stay V throughout the stick-slip phase"
            : NULL;
}

/* Is y the first times something without a pole, but for factors that are never zero?  y is lost. */
static bool divides(const element *x, element *y, struct exact_motion *m) {
  if (motion_op(num_exact.div, y, m, y, x) != SS_OK) return false;
  fmpz_mpoly_set(&y->num, &y->den, num_exact_ctx());
  fmpz_mpoly_one(&y->den, num_exact_ctx());
  return is_product(y, m);
}

/* The velocity V - z_i' at that state has the divisor as a factor. */
static bool is_factor(const struct tape *t, int state, int component, int anchor) {
  OWNED(exact_motion) m;
  struct num_vec z;
  exact_motion_free(&m, false, anchor, t);
  element *x = calc_new(&m.c), *slower = calc_new(&m.c);
  return exact_margin(x, &m, t) && motion_state(&z, &m, state) == SS_OK &&
         motion_op(num_exact.sub, slower, &m, at(&m.params, P_V), at(&z, component)) == SS_OK && !exact_is_zero(x) &&
         divides(x, slower, &m);
}

/* --- Together --- */

static const char *why(const struct tape *t, bool root, bool admissible) {
  bool known = false;
  for (int w = 0; w < N_WRITINGS; w++) known = known || has_sign(t, (enum writing)w, root);
  if (known)
    return root ? "a product of factors that are positive for all parameters"
                : "up to the sign a product of factors that are positive for all parameters";
  if (!admissible || root) return NULL;
  if (is_factor(t, 2, DZ_1, 4)) return first_mass_is_slower();
  if (is_factor(t, 3, DZ_2, ANCHOR_BACK)) return second_mass_is_slower();
  return NULL;
}

/* The quantity as a tape; false where it is no scalar. */
static bool divisor_tape(struct tape *t, const struct divisor *q, struct view view) {
  return formula_tape(t, view, q->formula, q->section, NULL, 0) && t->n_outputs == 1;
}

const char *nonzero_because(const struct divisor *q, struct view view, bool admissible) {
  OWNED(tape) t;
  return divisor_tape(&t, q, view) ? why(&t, q->root, admissible) : NULL;
}

bool zero_everywhere(const struct divisor *q, struct view view) {
  OWNED(tape) t;
  if (!divisor_tape(&t, q, view) || q->root) return false;
  OWNED(exact_motion) m;
  exact_motion_free(&m, false, 4, &t);
  exact_field_bind(m.field, bind, &m);
  element *x = calc_new(&m.c);
  return exact_margin(x, &m, &t) && exact_is_zero(x);
}

bool divisor_is_continuous(const struct divisor *q, struct view view, bool admissible) {
  OWNED(source) src;
  LOCAL(arena, a);
  OWNED(elaboration) el;
  struct matrix m;
  struct diag d = {0};
  struct divisor inner[MOST_DIVISORS];
  int n = 0;
  source_from_string(&src, "divisor", q->formula);
  elaboration_init(&el, view, NULL, 0);
  const struct expr *e = expr_parse(&a, &src, (struct span){0, src.len}, &d);
  bool ok = e && elaborate(&m, &el, e, &src, q->section, &d) && collect(inner, &n, &a, q->section, e) &&
            collect_definitions(inner, &n, &a, &el);
  for (int i = 0; ok && i < n; i++) ok = nonzero_because(&inner[i], view, admissible) != NULL;
  return ok;
}

/* z_1'' at the end of phase H is a factor of the divisor. */
bool zero_at_touch(const struct divisor *q, struct view view) {
  OWNED(tape) t;
  if (!divisor_tape(&t, q, view)) return false;
  OWNED(exact_motion) m;
  exact_motion_free(&m, false, 4, &t);
  element *x = calc_new(&m.c);
  struct num_vec f = calc_vec(&m.c, 4);
  return exact_margin(x, &m, &t) && motion_rate_at(&f, &m, 3, PHASE_H) == SS_OK && !exact_is_zero(at(&f, DZ_1)) &&
         divides(at(&f, DZ_1), x, &m);
}
