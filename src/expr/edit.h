/* One-token edits of a statement: the misprints that a formula may have suffered, as trees of their own.

   An edit changes one token, or moves one factor or entry; everything else is the tree as written.  The kinds:

     sign        + for - and - for +; a leading minus put or dropped
     operator    * for / and / for *
     exponent    one more, one less (an exponent of 1 is dropped)
     number      an integer literal one more, one less
     index       an entry's index, or a block's, one off or a block's width off; a name for one of its family: names
                 that differ in one character of their index (z_1b z_2b, t_a t_b, u_r1 u_s1, Z_a Z_b)
     symbol      a name for another of the same shape: any used in the same statement; a free symbol without an index
                 for another such of the section
     function    sin, cos, cot for one another; sinc for stumpff; det for tr; inv, transpose, sqrt left out; hypot(a, b)
                 for either argument
     prime       a prime more or less, on a function or in a name (z_1a, z'_1a)
     dropped     a factor, a term, a divisor or a numerator left out
     factor      a term times one of the given factors
     term        a name of its family added to the name that a function has for its argument: H(t_a + t_c) for H(t_c)
     moved       a factor from the numerator to the denominator or back
     transposed  two rows, two columns or two entries of a matrix literal exchanged; a row written as a column
     relation    < for > and back, <= for >= and back; the smallest root for the largest

   Edits come in the order of the text, then of the kinds; every one prints differently from the original and from the
   others.  Statements of more than EDIT_MAX_NODES nodes have no edits, and no statement more than EDIT_MAX. */
#ifndef STICKSLIP_EXPR_EDIT_H
#define STICKSLIP_EXPR_EDIT_H

#include "expr.h"

#define EDIT_KINDS(X)                                                                                                  \
  X(SIGN, sign)                                                                                                        \
  X(OPERATOR, operator)                                                                                                \
  X(EXPONENT, exponent)                                                                                                \
  X(NUMBER, number)                                                                                                    \
  X(INDEX, index)                                                                                                      \
  X(SYMBOL, symbol)                                                                                                    \
  X(FUNCTION, function)                                                                                                \
  X(PRIME, prime)                                                                                                      \
  X(DROPPED, dropped)                                                                                                  \
  X(FACTOR, factor)                                                                                                    \
  X(TERM, term)                                                                                                        \
  X(MOVED, moved)                                                                                                      \
  X(TRANSPOSED, transposed)                                                                                            \
  X(RELATION, relation)

enum edit_kind {
#define EDIT_ENUM(upper, lower) EDIT_##upper,
  EDIT_KINDS(EDIT_ENUM)
#undef EDIT_ENUM
      N_EDIT_KINDS
};
extern const char *const edit_kind_name[N_EDIT_KINDS];

enum { EDIT_MAX_NODES = 400, EDIT_MAX = 4096 };

/* A name that may stand in the statement. */
struct edit_word {
  const char *name;
  int rows, cols; /* of its value; names of different shapes are not exchanged */
  bool function;  /* it takes an argument */
  bool here;      /* it stands in the statement */
  bool plain;     /* a free symbol without an index */
};
struct edit_vocabulary {
  const struct edit_word *word;
  size_t n_words;
  const char *const *factor; /* names or integers */
  int n_factors;
};

struct edit {
  enum edit_kind kind;
  struct span place;     /* of the part that changed */
  const char *was, *now; /* that part before and after; what was left out or put in for a relation */
  const char *text;      /* the statement printed */
  const struct stmt *stmt;
};
struct edits {
  struct edit *edit; /* heap */
  size_t n, cap;
};

/* Appends the edits of a statement; trees and texts live in the arena and share what is unchanged with s. */
void stmt_edits(struct edits *out, struct arena *a, const struct stmt *s, const struct edit_vocabulary *v);
void edits_clear(struct edits *e);

/* Names that differ in one character of their index, the part after "_". */
bool edit_same_family(const char *a, const char *b);

#endif
