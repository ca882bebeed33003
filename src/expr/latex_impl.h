/* What the files that read LaTeX share: latex_marks.c turns characters into marks, latex_read.c marks into expressions,
   latex_statements.c finds the statements among them.  Every function that returns a pointer or bool reports the first
   mistake and then returns NULL or false. */
#ifndef STICKSLIP_EXPR_LATEX_IMPL_H
#define STICKSLIP_EXPR_LATEX_IMPL_H

#include "base/tex.h"
#include "expr_impl.h"
#include "latex_read.h"

/* A reading is looked for everywhere in the formula. */
enum { LATEX_MAX_MARKS = 5000, LATEX_MAX_READINGS = 20 };

/* A token that says something: neither a blank nor how large a bracket is.  \begin, \end, \text and \operatorname
   include the word in braces behind them, and have it as s and len. */
struct mark {
  enum tex_kind kind;
  const char *s;
  size_t len;
  const struct tex_word *word;
  size_t pair; /* of a bracket: the index of its partner */
};
struct marks {
  struct mark *m;
  size_t n, cap;
};

/* The marks of a formula as it is to be read; freed by the caller also on failure. */
bool latex_marks(struct marks *out, const struct latex_formula *f, struct diag *d);
bool mark_is_sign(const struct mark *m, char c);
bool mark_is_role(const struct mark *m, enum tex_role role);
bool mark_is_text(const struct mark *m, const char *word);
/* The relation that a mark stands for. */
bool mark_relation(enum relop *op, const struct mark *m);

/* An index letter and its value. */
struct binding {
  char letter;
  int value;
};

struct latex_reader {
  struct arena *arena;
  const struct source *src;
  const struct latex_names *names;
  struct diag *d;
  const struct mark *m;
  size_t at, end; /* the mark in hand, and where the part that is read ends */
  struct binding bound[2];
  int n_bound;
  int depth, bars, tangents;
  long n_nodes;
  const struct expr *signed_by, *sign; /* q of the statement's sign(q), and the eps that it is; NULL: it has none */
};

/* Reports a mistake at the mark in hand. */
void *latex_mistake(struct latex_reader *r, const char *fmt, ...) SS_PRINTF(2, 3);
struct expr *latex_node(struct latex_reader *r, enum expr_kind kind, size_t at, int n_args);
/* The name eps, for what stands at the mark. */
const struct expr *latex_sign(struct latex_reader *r, size_t at);
/* A sum as far as it goes. */
const struct expr *latex_sum(struct latex_reader *r);
/* The function that a mark names, EXPR_DIV for the tangent, sin(x)/cos(x); EXPR_SYM for none. */
enum expr_kind latex_function(const struct mark *m);
/* The mark of a letter by the name that it has in typed formulas; false when the mark is none. */
bool latex_letter(struct text *out, const struct mark *m);

#endif
