/* Straight-line programs: what the asked-for scalars reach, each shared subexpression once, evaluated by one loop over
   the method table of a number type. */
#ifndef STICKSLIP_TAPE_TAPE_H
#define STICKSLIP_TAPE_TAPE_H

#include "expr/expr.h"
#include "num/num.h"

enum tape_op {
  TAPE_CONST, /* k: index of the constant */
  TAPE_INPUT, /* k: index of the input */
#define NUM_UNARY(name)  TAPE_##name,
#define NUM_BINARY(name) TAPE_##name,
#include "num/ops.def"
  TAPE_POW,     /* a ^ k */
  TAPE_ROUNDED, /* a, rounded; see tape_eval */
  TAPE_ROOT     /* coefficients links[a .. a+b), k = 1 smallest or -1 largest positive root */
};
enum { N_TAPE_OPS = TAPE_ROOT + 1 };
extern const char *const tape_op_name[N_TAPE_OPS]; /* "add", "sin", "root", ... */

/* A quantity defined as a root: coefficients in ascending order as scalars.  Its symbol is its name, or "name@section"
   where roots of several sections share the name. */
struct tape_root {
  const char *name; /* of the symbol that stands for it in scalars */
  const struct expr **coeff;
  int n_coeff;
  bool largest;
};

struct tape_instr {
  enum tape_op op;
  slong a, b, k;
};

struct tape {
  struct tape_instr *code;
  slong n;
  fmpq *consts;
  slong n_consts;
  char **inputs; /* names of the free symbols, in order of first use */
  slong n_inputs;
  slong *links;
  slong n_links;
  slong *outputs;
  slong n_outputs;
  /* Of each instruction: the outputs given to tape_build reach it through TAPE_ROUNDED alone.  NULL: there is no
     TAPE_ROUNDED. */
  bool *only_under_rounded;
};

/* Compiles scalars of one pool; a symbol that names a root is computed, any other is an input.  false with d set when a
   literal is too large; t is empty then. */
bool tape_build(struct tape *t, const struct expr *const *outputs, slong n, const struct tape_root *roots,
                size_t n_roots, struct diag *d);
void tape_clear(struct tape *t);
/* Operands precede their use and every index is in range; aborts otherwise.  tape_build calls it. */
void tape_check(const struct tape *t);
/* The same program: instructions, constants and inputs alike, so that the outputs are the same formulas. */
bool tape_same(const struct tape *a, const struct tape *b);
/* The index of the input of that name; -1 when there is none. */
slong tape_input(const struct tape *t, const char *name);
/* Whether an entry of the matrix of that name, "S_c[1,1]", is among the inputs. */
bool tape_reads_matrix(const struct tape *t, const char *name);
/* One instruction a line, "%3 = mul %1 %2", inputs and constants by name, outputs last. */
void tape_dump(struct text *out, const struct tape *t);

/* How many operands an instruction has, and where they stand; those of a root are its coefficients. */
static inline slong tape_operands(const struct tape *t, slong i) {
  switch (t->code[i].op) {
#define NUM_UNARY(name)                                                                                                \
  case TAPE_##name:                                                                                                    \
    return 1;
#define NUM_BINARY(name)                                                                                               \
  case TAPE_##name:                                                                                                    \
    return 2;
#include "num/ops.def"
  case TAPE_POW:
  case TAPE_ROUNDED:
    return 1;
  case TAPE_CONST:
  case TAPE_INPUT:
    return 0;
  case TAPE_ROOT:
    return t->code[i].b;
  }
  abort();
}
static inline slong tape_operand(const struct tape *t, slong i, slong k) {
  const struct tape_instr *in = &t->code[i];
  return in->op == TAPE_ROOT ? t->links[in->a + k] : k ? in->b : in->a;
}

static inline bool tape_only_under_rounded(const struct tape *t, slong i) {
  return t->only_under_rounded && t->only_under_rounded[i];
}

/* Evaluates with the given inputs (n_inputs of them, same context as out).  status, when given, receives the flags of
   each output: those of every operation it depends on.  Returns their union.

   In balls and in exact numbers TAPE_ROUNDED changes nothing.  In double and MPFR it is the value of its operand at
   exactly the given inputs, found in balls of rising precision and rounded: off by at most 0.51 units in the last place
   (double: below 2^-1100 it is 0); SS_UNABLE when the balls do not tell it to so much at 4096 bits, or at eight times
   the precision if that is more. */
int tape_eval(struct num_vec *out, int *status, const struct tape *t, const struct num_vec *in);

#endif
