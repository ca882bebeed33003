/* The result record of the study of digits: for every formula and every region of its arguments the worst point found,
   how many digits double precision loses there, how many of them the problem loses and how many the formula, where and
   why.

   Errors are relative, in units of 2^-53 of the true value; a matrix is measured by its largest entry.  With kappa the
   condition number, the sum over the inputs of |x df/dx| / |f|, the problem loses log10 max(1, kappa) digits (where a
   change of an input by 2^-53 is too large for a derivative, the change of the result itself takes its place if it is
   larger); the formula what is lost beyond that.  A formula loses where its error exceeds STABILITY_ALLOWED max(1,
   kappa) 2^-53, and is at fault where it loses or where it does not return a value that double precision can hold:
   stability_loses and stability_at_fault say so for every report.  Digits are counted from 0 to STABILITY_DIGITS, all
   there are; what is worse than the loss of all of them, a relative error beyond 1, counts in `excess`, which orders
   the points. */
#ifndef STICKSLIP_STABILITY_RESULT_H
#define STICKSLIP_STABILITY_RESULT_H

#include <stdbool.h>

#include "base/arena.h"

#define STABILITY_DIGITS 15.9
enum { STABILITY_ALLOWED = 8 };

/* Why digits are lost, at the node named; the last three return no value, or 0 or a coarse number for a true value that
   a double holds: failures. */
#define LOSS_CAUSES(X)                                                                                                 \
  X(ROUNDING, "roundings that add up")                                                                                 \
  X(CANCELLATION, "cancellation")                                                                                      \
  X(SMALL_DIVISOR, "division by a small difference")                                                                   \
  X(ARGUMENT, "rounded argument of a function")                                                                        \
  X(ROOT, "root of a polynomial with rounded coefficients")                                                            \
  X(CODE, "in the code of a function")                                                                                 \
  X(OVERFLOW, "overflow in an intermediate")                                                                           \
  X(UNDERFLOW, "underflow in an intermediate")                                                                         \
  X(ZERO_DIVISOR, "division by a difference that rounds to zero")

enum loss_cause {
#define CAUSE_ENUM(name, says) CAUSE_##name,
  LOSS_CAUSES(CAUSE_ENUM)
#undef CAUSE_ENUM
      N_LOSS_CAUSES
};
extern const char *const loss_cause_says[N_LOSS_CAUSES];

/* Predicted against observed loss: bins of digits [0,1), [1,2), [2,4), [4,8), [8,12), [12,...), and failures. */
enum { N_LOSS_BINS = 7 };
extern const char *const loss_bin_name[N_LOSS_BINS];
/* The bin of a loss; NaN stands for a failure. */
int loss_bin(double digits);

struct stability_region {
  const char *id, *says;
};

struct stability_formula {
  const char *id, *also; /* also: other names of the same formula, joined by ", "; "" */
  const char *record, *equation, *text;
  long points;               /* at which it was held against its true value */
  const char *replacement;   /* records of the other layer that the formula is made of there; NULL: the same formula */
  bool proved;               /* each of them equal to what it replaces */
  bool kernel;               /* a function of the program: an error status is an answer, and no node is named */
  bool zero;                 /* its true value is zero wherever it was tried, so that no relative error exists */
  long worst, worst_failure; /* rows; -1: none.  Of failures the one at the least extreme inputs */
};

/* One formula in one region. */
struct stability_row {
  int formula, region;
  long points, outside, undecided, failures;         /* outside: of the domain, or of the range of a double */
  bool found;                                        /* the rest but for the failure has a meaning */
  bool at_fault;                                     /* as stability_at_fault says */
  double error;                                      /* log10, in units of 2^-53 */
  double observed, problem, formula_lost, predicted; /* digits */
  double excess;                                     /* formula_lost, but not cut off where all digits are lost */
  bool sign_lost;                                    /* the value that is furthest off has the wrong sign */
  enum loss_cause cause;
  double node_grows; /* by how many digits the relative error grows in that node */
  const char
      *node; /* the subexpression that loses the digits, and its operands where it is a difference, a quotient or */
  const char *left, *right; /* a function; NULL where there is none */
  const char *source;       /* file:line at which that node is written; NULL: nowhere */
  const char *witness;      /* chi=0x1.8p-3,... */
  double after;      /* digits that the formula of the other layer loses there; NaN: none asked for, or it fails */
  double after_most; /* the most that a search for its own worst point in this region finds; NaN: none asked for */
  const char *after_witness; /* there; NULL */
  long after_failures;       /* points at which it has no value though a double holds it */
  long after_short;          /* points at which it fails or loses, of those at which it was found out, */
  long after_rounded;        /* and how many of them remain when the form is rounded(...) as a whole */
  /* The failure at the least extreme inputs: where it can be met soonest. */
  enum loss_cause failure;
  double failure_size; /* log10 of the true value of its node; NaN: none is named */
  const char *failure_node, *failure_source, *failure_witness; /* NULL without one */
};

/* A formula of the corrected layer beside its stable form, both in balls at points of the regions where the corrected
   one has a finite value: does the stable one have it too? */
struct stability_pair {
  const char *formula;
  long points, undecided;       /* undecided: the value is not known to 32 bits, as where it is zero */
  long lost, differ;            /* the stable form has no value in balls of 4096 bits; another value */
  const char *region, *witness; /* of the first of these; NULL: there is none */
};

/* Digits lost by the formula over two inputs, the others as at a witness; NaN where nothing is known, INFINITY a
   failure. */
enum { STABILITY_MAP = 41 };
struct stability_map {
  int formula;
  const char *x, *y, *at;                          /* inputs, and the values of the others */
  double x_at[STABILITY_MAP], y_at[STABILITY_MAP]; /* log10 of the size of the inputs; of chi log10 chi/(1 - chi) */
  double lost[STABILITY_MAP][STABILITY_MAP], after[STABILITY_MAP][STABILITY_MAP]; /* [y][x] */
};

struct stability_result {
  struct arena arena;        /* owns every string */
  const char *layer, *after; /* after: the layer held against it, or NULL */
  const char *sources;       /* the model's options (model/model.h); NULL: none */
  bool quick;
  const struct stability_region *region;
  int n_regions;
  struct stability_formula *formula;
  int n_formulas;
  struct stability_row *row; /* by formula, then by region */
  long n_rows;
  long confusion[N_LOSS_BINS][N_LOSS_BINS]; /* [predicted][observed], over all points tried */
  long conditions,
      condition_differs;       /* condition numbers from symbolic derivatives, and how many the adjoint disputes */
  struct stability_pair *pair; /* where the stable layer is held against another */
  int n_pairs;
  struct stability_map *map;
  int n_maps;
};

/* Of a formula that loses so many digits of its own. */
bool stability_is_loss(double formula_lost);
bool stability_loses(const struct stability_row *row);
/* Has the stable form no value, or another one, somewhere? */
bool stability_pair_fails(const struct stability_pair *p);
/* A function of the program may say that it has no value. */
bool stability_at_fault(const struct stability_row *row, bool kernel);

/* Points of a region at which some formula was held against its true value. */
long stability_region_points(const struct stability_result *r, int region);
/* The first region without such a point, -1 when all are reached: in a study of every formula that is an error. */
int stability_empty_region(const struct stability_result *r);

void stability_result_clear(struct stability_result *r);
/* The row of that formula and region. */
const struct stability_row *stability_row_at(const struct stability_result *r, int formula, int region);

#endif
