/* Formulas in LaTeX, as a paper prints them, read into the statements that typed formulas give.

   Read are sums, implied products, quotients with / and \frac, powers, \sqrt, |x|, sin cos tan cot exp det tr, e^{x},
   matrices, rows (a, b) and their transposes (a, b)^t, ^\top, ^{\mathrm{T}} or (a, b)', and ^T where T is no name, [x]
   as (x), inverses ^{-1}, names with accents, primes and subscripts, chains of relations; and what LaTeX of this
   library writes (expr_latex).  A name is looked up:
   \tilde{k}_1 is ktilde_1, z'_{1b} is z'_1b, \varepsilon is eps; M_{12} is M[1,2] where M is a matrix and M_12 no name;
   a d before a letter makes a differential, dt_a.  Of a function without an argument it is t, the time: K is K(t); a
   prime marks its derivative, and so do the dots of \dot{x} and \ddot{x} where no name has them, and \frac{dx}{dt}
   where d and dt are none.

   Statements are separated by ",", ";", \quad, \\ before anything but a relation, "..." after anything but one, and the
   words "if", "i.e.", "and", "for", "with".  Among them stand, in parentheses: another statement; words, which say
   nothing; and the values of an index, (i = 1, 2), (i, j = 1, \dots, 4), (\varepsilon = \pm 1), which hold for the
   statements before it in which the letter stands in a subscript (the sign: anywhere).  |a| < b is read -b < a < b.
   \text{sign}(q) is eps, and behind all the statements comes eps q > 0, for eps = +1 and -1.

   How a formula departs from what it says to the letter is given as readings: a piece of it, found once, is read as
   another piece of LaTeX. */
#ifndef STICKSLIP_EXPR_LATEX_READ_H
#define STICKSLIP_EXPR_LATEX_READ_H

#include "expr.h"

enum latex_name { LATEX_UNKNOWN, LATEX_VALUE, LATEX_FUNCTION };
struct latex_names {
  enum latex_name (*kind)(const void *context, const char *name);
  const void *context;
};

struct latex_reading {
  struct span printed, read;
};

/* Places in a source; lines that begin with # are comments. */
struct latex_formula {
  const struct source *src;
  struct span tex;
  const struct latex_reading *readings;
  size_t n_readings;
};

/* The statements of a formula, relations all, in the arena.  At most 5000 tokens, 20 readings, 200 levels of
   brackets, 16 sides of a chain and EXPR_MAX_NODES nodes.  d is not set; NULL with d set on failure, else *n is at
   least 1. */
const struct stmt **latex_statements(size_t *n, struct arena *a, const struct latex_formula *f,
                                     const struct latex_names *names, struct diag *d);

#endif
