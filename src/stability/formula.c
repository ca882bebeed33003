/* One formula as a tape whose nodes are all visible: a scalar (an entry of a matrix too) or a whole matrix, measured by
   its largest entry. */
#include <string.h>

#include "stability_impl.h"

/* --- What an input is --- */

enum input_class digits_class_of(const char *name) {
  static const struct {
    const char *begin;
    bool whole;
    enum input_class class;
  } table[] = {{"chi", true, INPUT_CHI},       {"eta", true, INPUT_ETA},   {"V", true, INPUT_V},
               {"eps", true, INPUT_SIGN},      {"e_", false, INPUT_FORCE}, {"u_r", false, INPUT_FORCE},
               {"u_s", false, INPUT_FORCE},    {"k_", false, INPUT_FORCE}, {"m_", false, INPUT_FORCE},
               {"omega_", false, INPUT_FORCE}, {"t_", false, INPUT_TIME},  {"t", true, INPUT_TIME}};
  for (size_t i = 0; i < sizeof table / sizeof *table; i++)
    if (table[i].whole ? strcmp(name, table[i].begin) == 0 : strncmp(name, table[i].begin, strlen(table[i].begin)) == 0)
      return table[i].class;
  return INPUT_STATE;
}

/* --- One formula --- */

static const struct tape_root *root_of(const struct digits_set *s, const struct expr *e) {
  for (size_t i = 0; e->kind == EXPR_SYM && i < s->el.n_roots; i++)
    if (strcmp(s->el.roots[i].name, e->name) == 0) return &s->el.roots[i];
  return NULL;
}

/* The scalar of each node, from the outputs down: operands stand before their use. */
static void name_nodes(struct digits_formula *f, const struct digits_set *s) {
  const struct tape *t = &f->tape;
  for (slong k = 0; k < f->n; k++) f->node[f->out[k]] = f->entry[k];
  for (slong i = t->n; i-- > 0;) {
    const struct expr *e = f->node[i];
    const struct tape_root *r = root_of(s, e);
    for (slong k = 0; k < tape_operands(t, i); k++) f->node[tape_operand(t, i, k)] = r ? r->coeff[k] : e->args[k];
  }
}

/* Fills tape, out, node and input from the entries. */
static bool make_tape(struct digits_formula *f, struct digits_set *s, struct diag *d) {
  struct tape *t = &f->tape;
  if (!elaboration_tape(t, &s->el, f->entry, f->n, d)) return false;
  f->out = arena_alloc(&s->arena, (size_t)f->n * sizeof *f->out);
  memcpy(f->out, t->outputs, (size_t)f->n * sizeof *f->out);
  f->node = arena_alloc(&s->arena, (size_t)t->n * sizeof *f->node);
  name_nodes(f, s);
  t->outputs = ss_realloc(t->outputs, (size_t)t->n * sizeof *t->outputs);
  t->n_outputs = t->n;
  for (slong i = 0; i < t->n; i++) t->outputs[i] = i;
  f->input = arena_alloc(&s->arena, ((size_t)t->n_inputs + 1) * sizeof *f->input);
  for (slong k = 0; k < t->n_inputs; k++) f->input[k] = digits_class_of(t->inputs[k]);
  return true;
}

/* A value of a motion, z_1(t), is an input like any other: the formula does not say how it comes from t. */
static const struct expr *without_calls(struct digits_set *s, const struct expr *e) {
  struct expr_pool *p = &s->el.pool;
  if (e->kind == EXPR_CALL) {
    OWNED(text) name = {0};
    expr_print(&name, e);
    return expr_sym(p, text_str(&name));
  }
  if (e->n_args == 0) return e;
  const struct expr *a = without_calls(s, e->args[0]);
  if (e->kind == EXPR_POW) return expr_pow(p, a, e->exponent);
  return e->n_args == 1 ? expr_op1(p, e->kind, a) : expr_op2(p, e->kind, a, without_calls(s, e->args[1]));
}

static bool has_calls(const struct tape *t) {
  bool yes = false;
  for (slong k = 0; k < t->n_inputs; k++) yes = yes || strchr(t->inputs[k], '(');
  return yes;
}

bool digits_formula_make(struct digits_formula *f, struct digits_set *s, struct diag *d) {
  if (!make_tape(f, s, d)) return false;
  if (!has_calls(&f->tape)) return true;
  for (slong k = 0; k < f->n; k++) f->entry[k] = without_calls(s, f->entry[k]);
  tape_clear(&f->tape);
  return make_tape(f, s, d);
}

bool digits_formula_rounded(struct digits_formula *z, struct digits_set *s, const struct digits_formula *f,
                            struct diag *d) {
  *z = *f;
  z->have_slopes = false;
  z->entry = arena_alloc(&s->arena, (size_t)f->n * sizeof *z->entry);
  for (slong k = 0; k < f->n; k++) z->entry[k] = expr_op1(&s->el.pool, EXPR_ROUNDED, f->entry[k]);
  return digits_formula_make(z, s, d);
}

bool digits_formula_computes(const struct digits_formula *f) {
  const struct tape *t = &f->tape;
  for (slong i = 0; i < t->n; i++) {
    enum tape_op op = t->code[i].op;
    if (op != TAPE_CONST && op != TAPE_INPUT && op != TAPE_neg && op != TAPE_abs) return true;
  }
  return false;
}

void digits_formula_clear(struct digits_formula *f) {
  tape_clear(&f->tape);
  if (f->have_slopes) tape_clear(&f->slopes);
}

bool digits_formula_same(const struct digits_formula *a, const struct digits_formula *b) {
  if (a->n != b->n || a->tape.n_inputs != b->tape.n_inputs) return false;
  for (slong k = 0; k < a->tape.n_inputs; k++)
    if (a->input[k] != b->input[k]) return false;
  for (slong k = 0; k < a->n; k++)
    if (a->out[k] != b->out[k]) return false;
  struct tape other = b->tape;
  other.inputs = a->tape.inputs;
  return tape_same(&a->tape, &other);
}

void digits_inputs(double *y, const struct digits_formula *g, const struct digits_formula *f, const double *x) {
  for (slong k = 0; k < g->tape.n_inputs; k++) {
    slong from = tape_input(&f->tape, g->tape.inputs[k]);
    if (from >= 0) y[k] = x[from];
  }
}

void digits_print_point(struct text *out, const struct digits_formula *f, const double *x) {
  for (slong k = 0; k < f->tape.n_inputs; k++) text_printf(out, "%s%s=%a", k ? "," : "", f->tape.inputs[k], x[k]);
}
