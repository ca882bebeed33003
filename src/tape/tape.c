/* A tape is a post-order walk of the shared scalars: every operand stands before its use, once. */
#include "tape.h"

#include <stdlib.h>
#include <string.h>

#include "expr/map.h"
#include "tape_impl.h"

/* --- Building --- */

struct builder {
  struct tape *t;
  const struct tape_root *roots;
  size_t n_roots;
  struct expr_map places; /* of scalars already on the tape */
  size_t cap_code, cap_consts, cap_inputs, cap_links;
  struct diag *d;
};

static slong place_of(const struct builder *b, const struct expr *e) {
  const struct expr_slot *s = expr_map_find(&b->places, e);
  return s ? s->at : -1;
}

static bool add_const(slong *index, struct builder *b, const char *decimal) {
  struct tape *t = b->t;
  *index = t->n_consts;
  fmpq *q = SS_PUSH(t->consts, t->n_consts, b->cap_consts);
  fmpq_init(q);
  if (num_parse_decimal(q, decimal, strlen(decimal)) == SS_OK) return true;
  return diag_set(b->d, "the number %.40s is too large to hold", decimal);
}

slong tape_input(const struct tape *t, const char *name) {
  for (slong i = 0; i < t->n_inputs; i++)
    if (strcmp(t->inputs[i], name) == 0) return i;
  return -1;
}

bool tape_reads_matrix(const struct tape *t, const char *name) {
  size_t len = strlen(name);
  for (slong i = 0; i < t->n_inputs; i++)
    if (strncmp(t->inputs[i], name, len) == 0 && t->inputs[i][len] == '[') return true;
  return false;
}

static slong add_input(struct builder *b, const char *name) {
  struct tape *t = b->t;
  slong known = tape_input(t, name);
  if (known >= 0) return known;
  *SS_PUSH(t->inputs, t->n_inputs, b->cap_inputs) = ss_strdup(name);
  return t->n_inputs - 1;
}

static const struct tape_root *root_of(const struct builder *b, const char *name) {
  for (size_t i = 0; i < b->n_roots; i++)
    if (strcmp(b->roots[i].name, name) == 0) return &b->roots[i];
  return NULL;
}

static enum tape_op op_of(enum expr_kind k) {
  static const enum tape_op ops[EXPR_INDEX + 1] = {
      [EXPR_NEG] = TAPE_neg,   [EXPR_ADD] = TAPE_add,         [EXPR_SUB] = TAPE_sub,     [EXPR_MUL] = TAPE_mul,
      [EXPR_DIV] = TAPE_div,   [EXPR_SIN] = TAPE_sin,         [EXPR_COS] = TAPE_cos,     [EXPR_COT] = TAPE_cot,
      [EXPR_SQRT] = TAPE_sqrt, [EXPR_EXP] = TAPE_exp,         [EXPR_ABS] = TAPE_abs,     [EXPR_ROUNDED] = TAPE_ROUNDED,
      [EXPR_SINC] = TAPE_sinc, [EXPR_STUMPFF] = TAPE_stumpff, [EXPR_HYPOT] = TAPE_hypot, [EXPR_POW] = TAPE_POW};
  if (!ops[k]) abort();
  return ops[k];
}

/* The operands of a scalar: those of a root are its coefficients; a call of a trajectory is an input. */
static int operands(const struct expr *const **args, const struct builder *b, const struct expr *e) {
  *args = (const struct expr *const *)e->args;
  if (e->kind == EXPR_CALL) return 0;
  if (e->kind != EXPR_SYM) return e->n_args;
  const struct tape_root *r = root_of(b, e->name);
  *args = r ? (const struct expr *const *)r->coeff : NULL;
  return r ? r->n_coeff : 0;
}

/* Emits the instruction of a scalar whose operands are all placed. */
static bool place(struct builder *b, const struct expr *e) {
  struct tape *t = b->t;
  struct tape_instr in = {.op = TAPE_CONST, .a = -1, .b = -1, .k = 0};
  const struct expr *const *args;
  int n = operands(&args, b, e);
  if (e->kind == EXPR_NUM) {
    if (!add_const(&in.k, b, e->name)) return false;
  } else if (e->kind == EXPR_SYM && n > 0) {
    in.op = TAPE_ROOT;
    in.a = t->n_links;
    in.b = n;
    in.k = root_of(b, e->name)->largest ? -1 : 1;
    for (int i = 0; i < n; i++) *SS_PUSH(t->links, t->n_links, b->cap_links) = place_of(b, args[i]);
  } else if (e->kind == EXPR_SYM) {
    in.op = TAPE_INPUT;
    in.k = add_input(b, e->name);
  } else if (e->kind == EXPR_CALL) {
    OWNED(text) name = {0};
    expr_print(&name, e);
    in.op = TAPE_INPUT;
    in.k = add_input(b, text_str(&name));
  } else {
    in.op = op_of(e->kind);
    in.a = place_of(b, args[0]);
    if (n > 1) in.b = place_of(b, args[1]);
    in.k = e->exponent;
  }
  expr_map_put(&b->places, e)->at = t->n;
  *SS_PUSH(t->code, t->n, b->cap_code) = in;
  return true;
}

/* What the outputs reach without passing a TAPE_ROUNDED is open; the rest counts only under one. */
static void find_only_under_rounded(struct tape *t) {
  bool any = false;
  for (slong i = 0; i < t->n; i++) any = any || t->code[i].op == TAPE_ROUNDED;
  if (!any) return;
  FREED bool *open = ss_malloc((size_t)t->n * sizeof *open);
  t->only_under_rounded = ss_malloc((size_t)t->n * sizeof *t->only_under_rounded);
  for (slong i = 0; i < t->n; i++) open[i] = false;
  for (slong i = 0; i < t->n_outputs; i++) open[t->outputs[i]] = true;
  for (slong i = t->n - 1; i >= 0; i--) {
    t->only_under_rounded[i] = !open[i];
    if (!open[i] || t->code[i].op == TAPE_ROUNDED) continue;
    for (slong k = 0; k < tape_operands(t, i); k++) open[tape_operand(t, i, k)] = true;
  }
}

/* Post-order with a stack of our own: scalars can be deeper than the machine's. */
static bool walk(struct builder *b, const struct expr *root) {
  FREED const struct expr **stack = NULL;
  size_t n = 0, cap = 0;
  bool ok = true;
  *SS_PUSH(stack, n, cap) = root;
  while (ok && n > 0) {
    const struct expr *e = stack[n - 1];
    if (place_of(b, e) >= 0) {
      n--;
      continue;
    }
    const struct expr *const *args;
    int count = operands(&args, b, e);
    size_t before = n;
    for (int i = count - 1; i >= 0; i--)
      if (place_of(b, args[i]) < 0) *SS_PUSH(stack, n, cap) = args[i];
    if (n == before) {
      ok = place(b, e);
      n--;
    }
  }
  return ok;
}

bool tape_build(struct tape *t, const struct expr *const *outputs, slong n, const struct tape_root *roots,
                size_t n_roots, struct diag *d) {
  *t = (struct tape){.n = 0};
  struct builder b = {.t = t, .roots = roots, .n_roots = n_roots, .d = d};
  bool ok = true;
  for (slong i = 0; ok && i < n; i++) ok = walk(&b, outputs[i]);
  if (ok) {
    t->outputs = ss_malloc((size_t)n * sizeof *t->outputs);
    t->n_outputs = n;
    for (slong i = 0; i < n; i++) t->outputs[i] = place_of(&b, outputs[i]);
    find_only_under_rounded(t);
    tape_check(t);
  } else {
    tape_clear(t);
  }
  expr_map_clear(&b.places);
  return ok;
}

void tape_clear(struct tape *t) {
  for (slong i = 0; i < t->n_consts; i++) fmpq_clear(&t->consts[i]);
  for (slong i = 0; i < t->n_inputs; i++) free(t->inputs[i]);
  free(t->consts);
  free(t->inputs);
  free(t->links);
  free(t->outputs);
  free(t->only_under_rounded);
  free(t->code);
  *t = (struct tape){.n = 0};
}

bool tape_same(const struct tape *a, const struct tape *b) {
  bool same = a->n == b->n && a->n_consts == b->n_consts && a->n_inputs == b->n_inputs && a->n_links == b->n_links &&
              a->n_outputs == b->n_outputs;
  for (slong i = 0; same && i < a->n; i++) {
    const struct tape_instr *x = &a->code[i], *y = &b->code[i];
    same = x->op == y->op && x->a == y->a && x->b == y->b && x->k == y->k;
  }
  for (slong i = 0; same && i < a->n_consts; i++) same = fmpq_equal(&a->consts[i], &b->consts[i]);
  for (slong i = 0; same && i < a->n_inputs; i++) same = strcmp(a->inputs[i], b->inputs[i]) == 0;
  for (slong i = 0; same && i < a->n_links; i++) same = a->links[i] == b->links[i];
  for (slong i = 0; same && i < a->n_outputs; i++) same = a->outputs[i] == b->outputs[i];
  return same;
}

/* --- Looking at it --- */

const char *const tape_op_name[N_TAPE_OPS] = {
#define NUM_UNARY(name)  [TAPE_##name] = #name,
#define NUM_BINARY(name) [TAPE_##name] = #name,
#include "num/ops.def"
    [TAPE_POW] = "pow",
    [TAPE_ROUNDED] = "rounded",
    [TAPE_CONST] = "const",
    [TAPE_INPUT] = "input",
    [TAPE_ROOT] = "root"};

static void insist(bool ok) {
  if (!ok) abort();
}

void tape_check(const struct tape *t) {
  for (slong i = 0; i < t->n; i++) {
    const struct tape_instr *in = &t->code[i];
    if (in->op == TAPE_CONST) insist(in->k >= 0 && in->k < t->n_consts);
    if (in->op == TAPE_INPUT) insist(in->k >= 0 && in->k < t->n_inputs);
    if (in->op == TAPE_ROUNDED) insist(t->only_under_rounded != NULL);
    if (in->op == TAPE_ROOT) insist(in->a >= 0 && in->b >= 2 && in->a <= t->n_links - in->b);
    for (slong k = 0; k < tape_operands(t, i); k++) insist(tape_operand(t, i, k) >= 0 && tape_operand(t, i, k) < i);
  }
  for (slong i = 0; i < t->n_outputs; i++) insist(t->outputs[i] >= 0 && t->outputs[i] < t->n);
}

static void dump_instr(struct text *out, const struct tape *t, slong i) {
  const struct tape_instr *in = &t->code[i];
  text_printf(out, "%%%ld = %s", (long)i, tape_op_name[in->op]);
  if (in->op == TAPE_CONST) {
    text_add_char(out, ' ');
    num_print_q(out, &t->consts[in->k]);
  } else if (in->op == TAPE_INPUT) {
    text_printf(out, " %s", t->inputs[in->k]);
  } else if (in->op == TAPE_ROOT) {
    text_add(out, in->k < 0 ? " largest" : " smallest");
  }
  for (slong k = 0; k < tape_operands(t, i); k++) text_printf(out, " %%%ld", (long)tape_operand(t, i, k));
  if (in->op == TAPE_POW) text_printf(out, " %ld", (long)in->k);
  text_add_char(out, '\n');
}

void tape_dump(struct text *out, const struct tape *t) {
  for (slong i = 0; i < t->n; i++) dump_instr(out, t, i);
  for (slong i = 0; i < t->n_outputs; i++) text_printf(out, "out %%%ld\n", (long)t->outputs[i]);
}
