/* The rank of equations in some of their symbols, for all values of the others. */
#ifndef STICKSLIP_PROOF_EXACT_RANK_H
#define STICKSLIP_PROOF_EXACT_RANK_H

#include "tape/exact.h"
#include "value/sentence.h"

enum { RANK_NAMES = 16 };

/* The sign of what is a number times powers of chi, eta and V, which are positive: of what is zero for no values of its
   symbols; 0 for anything else. */
int exact_unit_sign(struct exact_field *f, const fmpz_mpoly_q_struct *x);

/* Residuals, then their derivatives by the unknowns, row by row. */
struct rank_system {
  struct sentence s; /* no more than its elaboration and its tape */
  char unknown[RANK_NAMES][32];
  slong input[RANK_NAMES]; /* of the tape; -1: the equations do not contain it */
  int rows, cols;
};

/* Of a claim of kind rank; clear its sentence, also after false. */
bool rank_system_build(struct rank_system *y, struct judge *j, const struct claim *c, struct view view);
/* Its tape without the derivatives, which come last; borrowed. */
struct tape rank_system_residuals(const struct rank_system *y);

/* Left minus right of every equation of the record, at most RANK_NAMES of them; false with j->d set. */
bool rank_residuals(const struct expr **out, int *rows, struct elaboration *el, struct judge *j, const struct claim *c,
                    const struct statement_record *r);

struct exact_rank {
  int rank;         /* -1: not decided */
  int least;        /* as free functions of all their symbols so many of the equations are independent, or more */
  bool contradict;  /* no values of the unknowns fulfil the equations */
  const char *note; /* the pivots, or why it is not decided */
};
struct exact_rank exact_rank_of(struct audit_result *out, const struct rank_system *y);

#endif
