/* Formulas in the paper's notation: trees as written, and scalars as elaborated.

   A tree holds what was written: no reordering, folding or simplifying, every literal as its decimal text, every node
   with its place in the source.  Scalars are trees without matrices, calls of defined functions or definitions left in
   them (model.h makes them); they are shared: equal scalars of one pool are the same pointer.

   Grammar.  Names are letters, digits and _, beginning with a letter; a prime belongs to a name when _ follows it
   (z'_1b), else it marks a derivative of a function (H'(t_c), z_1''(t)) and must be followed by primes or "(".

     statement  := "root" name ":" sum "," ("smallest" | "largest") "positive"
                 | "trajectory" name "(" name ")" ("," name "(" name ")")*
                 | name "(" name ")" ":=" sum | name ":=" sum
                 | sum (relop sum)+ [ "for" name "in" range ]
     relop      := "=" | "<" | "<=" | ">" | ">="
     range      := ("(" | "[") sum "," sum (")" | "]") | "{" "+1" "," "-1" "}"
     sum        := ["-"] product (("+" | "-") product)*
     product    := power ("*" power)* ["/" power]
     power      := postfix ["^" (digits | "(" "-" digits ")")]
     postfix    := primary ("[" index ["," index] "]")*
     index      := digits [":" digits]
     primary    := number | name | name "'"* "(" sum ")" | "(" sum ")" | matrix
                 | "hypot" "(" sum "," sum ")"
                 | "first_order" "(" sum ";" name ("," name)* ")"
     matrix     := "[" sum ("," sum)* (";" sum ("," sum)*)* "]"

   sin cos cot sqrt exp abs sinc stumpff rounded inv det tr transpose are functions of one argument, hypot(a, b) of two;
   they take no prime; the paper's |x| is abs(x).  sinc, stumpff, hypot are those of ops.def: with them formulas keep
   their digits. rounded(x) is x, of which a type that rounds has the nearest number or next to it, however x would come
   out (tape.h); of a matrix, entry by entry. first_order(f; x, y) is f to the first order in the named symbols
   together, f(0,0) + x f_x(0,0) + y f_y(0,0).  Doubtful forms are errors that ask for parentheses: a/b*c, a/b/c, a^b^c,
   -a^b, a*-b, and juxtaposition (2 a) asks for "*".  A one-index form v[i] is an entry of a row or a column.  Exponents
   are integers of at most 4 digits.  Nesting beyond 200 levels and formulas beyond 100000 nodes are refused. */
#ifndef STICKSLIP_EXPR_EXPR_H
#define STICKSLIP_EXPR_EXPR_H

#include "base/arena.h"
#include "base/text.h"

enum expr_kind {
  EXPR_NUM,  /* name: the decimal as written */
  EXPR_SYM,  /* name */
  EXPR_CALL, /* name, order primes, args[0] */
  EXPR_NEG,
  EXPR_ADD,
  EXPR_SUB,
  EXPR_MUL,
  EXPR_DIV,
  EXPR_POW, /* args[0], exponent */
  EXPR_SIN,
  EXPR_COS,
  EXPR_COT,
  EXPR_SQRT,
  EXPR_EXP,
  EXPR_ABS,
  EXPR_ROUNDED,
  EXPR_SINC,
  EXPR_STUMPFF,
  EXPR_HYPOT, /* of two */
  /* trees only, from here on */
  EXPR_PAREN, /* parentheses as written; args[0] */
  EXPR_INV,
  EXPR_DET,
  EXPR_TR,
  EXPR_TRANSPOSE,
  EXPR_FIRST_ORDER, /* args[0] to the first order in the symbols args[1], args[2], ... */
  EXPR_MATRIX,      /* rows x cols entries in row-major order */
  EXPR_INDEX        /* args[0]; index[] = first row, last row, first col, last col, from 1; n_index 1 or 2;
                  index_range[k]: written with a colon */
};

struct expr {
  enum expr_kind kind;
  const char *name;
  int order;
  int exponent;
  int rows, cols;
  int n_index;
  int index[4];
  bool index_range[2];
  int n_args;
  const struct expr **args;
  struct span span;        /* trees: place in the source; scalars: empty */
  const struct expr *next; /* pool chain; meaningless elsewhere */
};

/* The name "pi", which is the number wherever nothing else is defined under it. */
extern const char expr_pi[];

enum stmt_kind { STMT_DEFINE, STMT_RELATION, STMT_ROOT, STMT_TRAJECTORY };
enum relop { REL_EQ, REL_LT, REL_LE, REL_GT, REL_GE };
extern const char *const relop_sign[]; /* "=", "<", ... */

struct stmt {
  enum stmt_kind kind;
  struct span span;
  /* STMT_DEFINE: name, param or NULL, sides[0].  STMT_ROOT: name, sides[0], largest. */
  const char *name;
  struct span name_span;
  const char *param;
  bool largest;
  /* STMT_RELATION: sides[0] ops[0] sides[1] ops[1] ... */
  int n_sides;
  const struct expr **sides;
  enum relop *ops;
  const char *range_var; /* NULL without a range */
  bool range_signs;      /* {+1, -1} */
  const struct expr *range_lo, *range_hi;
  bool lo_closed, hi_closed;
  /* STMT_TRAJECTORY */
  int n_names;
  const char **names, **params;
};

/* Reads the statement, or the expression, that fills a span of the source (newlines and # comments inside are blanks).
   Nodes live in the arena.  NULL with d set on failure. */
const struct stmt *stmt_parse(struct arena *a, const struct source *src, struct span where, struct diag *d);
const struct expr *expr_parse(struct arena *a, const struct source *src, struct span where, struct diag *d);
/* |x| < y, or y > |x|, as -y < x < y, and likewise with an equality; NULL for another statement. */
struct stmt *stmt_between(struct arena *a, const struct stmt *s);

/* Infix text that parses back to an equal tree (scalars too: parentheses are put in where the grammar needs them). */
void expr_print(struct text *out, const struct expr *e);
void stmt_print(struct text *out, const struct stmt *s);
/* " for q in (0, 1)", where the statement has a range. */
void stmt_print_range(struct text *out, const struct stmt *s);
/* Step k of a relation, "a < b". */
void stmt_print_step(struct text *out, const struct stmt *s, int k);
/* As a reader writes it in a line of prose, not to be read back: products by a blank (by * before a number), a^-1, |a|,
   M_12 for M[1,2], columns and transposed rows as (a, b); the argument t of a name in small letters is left out, z_1'
   for z_1'(t).  Of a statement the relations alone: without its range, and without sides that are first_order(...)
   where two others are left; "name = ..." of a definition. */
void expr_plain(struct text *out, const struct expr *e);
void stmt_plain(struct text *out, const struct stmt *s);
/* The expression without the parentheses around it. */
const struct expr *expr_bare(const struct expr *e);
/* The literal 0, perhaps in parentheses; a matrix of such. */
bool expr_is_zero(const struct expr *e);
bool expr_is_zero_matrix(const struct expr *e);
/* Is any node of the tree, or of a statement's sides, so? */
typedef bool (*expr_is_fn)(const struct expr *e, const void *arg);
bool expr_any(const struct expr *e, expr_is_fn is, const void *arg);
bool stmt_any(const struct stmt *s, expr_is_fn is, const void *arg);
/* One of these: a name, but pi. */
bool expr_is_name(const struct expr *e, const void *arg);
/* Equality of shape, names and literals; places do not count. */
bool expr_same(const struct expr *a, const struct expr *b);
/* The same of two nodes, apart from their operands. */
bool expr_same_node(const struct expr *a, const struct expr *b);

/* The formula as LaTeX: quotients as \frac, matrices as pmatrix, names split at _ with Greek letters recognised
   (omega1 -> \omega_{1}, z'_1b -> z'_{1b}, k~: ktilde_1 -> \tilde{k}_{1}, gammatilde, hbar -> \bar{h}, Z_a -> Z_{a},
   e1 -> e_{1}, u_r1 -> u_{r1}, dt_b -> dt_{b}). */
void expr_latex(struct text *out, const struct expr *e);
/* The same of an expression as text; false, with nothing added, when it cannot be read. */
bool expr_latex_of(struct text *out, const char *expression);
void stmt_latex(struct text *out, const struct stmt *s);
/* The same without the argument t of motions, z_1' for z_1'(t), as expr_plain. */
void stmt_latex_plain(struct text *out, const struct stmt *s);
void name_latex(struct text *out, const char *name);

/* Shared scalars; all zero: empty. */
struct expr_pool {
  struct arena arena;
  const struct expr **bucket;
  size_t n_buckets, n;
};
void expr_pool_clear(struct expr_pool *p);
/* A node of one of the scalar kinds from scalars of the same pool (b only for ADD SUB MUL DIV HYPOT). */
const struct expr *expr_num(struct expr_pool *p, const char *decimal);
const struct expr *expr_int(struct expr_pool *p, long n); /* negative: NEG of a literal */
const struct expr *expr_sym(struct expr_pool *p, const char *name);
const struct expr *expr_call(struct expr_pool *p, const char *name, int order, const struct expr *arg);
const struct expr *expr_op1(struct expr_pool *p, enum expr_kind k, const struct expr *a);
const struct expr *expr_op2(struct expr_pool *p, enum expr_kind k, const struct expr *a, const struct expr *b);
const struct expr *expr_pow(struct expr_pool *p, const struct expr *a, int exponent);
/* expr_op2 without the zeros and ones that products of matrices leave; for reading alone. */
const struct expr *expr_tidy(struct expr_pool *p, enum expr_kind k, const struct expr *a, const struct expr *b);

/* The derivative of a scalar with respect to a symbol, by the rules of calculus applied node by node.  A subexpression
   free of the symbol contributes nothing (so zeros do not pile up); nothing else is simplified.  d/dx of a call
   f^(n)(u) is f^(n+1)(u) u'.  The derivatives of abs and of stumpff are not defined at 0, that of hypot not at the
   origin. */
const struct expr *expr_diff(struct expr_pool *p, const struct expr *e, const char *sym);
/* The scalar with every occurrence of a symbol replaced (inside call arguments too). */
const struct expr *expr_subst(struct expr_pool *p, const struct expr *e, const char *sym, const struct expr *by);

#endif
