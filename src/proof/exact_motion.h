/* The model's motions over a field of rational functions: what the paper's symbols stand for, exactly and for all
   parameters.

   A motion of the word is made of what dynamics.h says of its phases and of nothing of the paper's: the matrix A of
   each phase's first-order system, the switching functions and their rates.  Its states at the switching times are
   free, but for what their phase and their event say of them, or each follows from the one before; likewise the
   perturbations. */
#ifndef STICKSLIP_PROOF_EXACT_MOTION_H
#define STICKSLIP_PROOF_EXACT_MOTION_H

#include "num/calc.h"
#include "tape/exact.h"
#include "value/sentence.h"

enum exact_tangents {
  TANGENTS_FREE,    /* each perturbation free, but for its event */
  TANGENTS_SHIFTED, /* each from the one before with the change of the time free */
  TANGENTS_LOCATED, /* each from the one before by (I - f n^T/(n f)) P; first order only */
  N_EXACT_TANGENTS
};

/* Of sentences about both ends of a phase: the time t is its start or its end. */
enum exact_time { TIME_INSIDE, TIME_START, TIME_END };

/* Of a periodic motion: Z_c follows back through phase C from the start of the next period. */
enum { ANCHOR_BACK = -1 };

/* How much is asked to hold.  Less is quicker, and a proof with less is a proof. */
struct exact_attempt {
  bool modes; /* chi and eta by the frequencies of phase H, which free generators stand for */
  int anchor; /* the states after this one (0 to 4) follow each from the one before, the others are free; ANCHOR_BACK */
  enum exact_tangents tangents;
  enum exact_time time;
};

struct exact_motion {
  struct exact_field *field;
  struct calc c; /* elements and vectors of the field that live as long as the motion */
  struct exact_attempt attempt;
  struct point_spec spec; /* the points on it; the own symbols of their paper are free */
  bool bare;              /* a paper about another system: names are its own symbols' or nothing's */
  bool beyond;            /* one of those symbols, or pi, was asked for: free, but for what is not known of it here */
  struct num_vec own;     /* what is never negative by its domains and by the conditions of the sentence: n_own, of */
  int n_own, n_strict;    /* which the first n_strict are never zero either */
  int first_state, first_tangent; /* the earliest that the sentence reads */
  struct num_vec frequency;       /* two, with modes */
  struct num_vec params;          /* N_PARAMS; e_1 and e_2 as far as no state decides them */
  struct num_vec state, tangent;  /* five of four */
  struct num_vec shift;           /* dt_a ... dt_d */
  struct num_vec now[2];          /* Z(t) and its rate, of which names ask for each component */
  bool have_state[5], have_tangent[5], have_now[2];
  int state_status, tangent_status;
  bool used_matrix; /* what a matrix held as unknowns does to the motion was used */
  bool wants_modes; /* SS_UNABLE came from phase H without modes */
  char unbound[64]; /* or from this name */
};

/* The motion for a sentence at such points; reads: the inputs of its tape, which may be NULL. */
void exact_motion_init(struct exact_motion *m, const struct exact_attempt *a, const struct point_spec *spec,
                       const struct tape *reads);
void exact_motion_clear(struct exact_motion *m);
/* The domains of the paper's own symbols that the sentence reads, and its ranges and conditions, are known on it from
   now on: of points outside, or where a side of a condition has no value, nothing is said. */
void exact_motion_given(struct exact_motion *m, const struct sentence *s);
/* The binder of its field. */
int exact_motion_bind(fmpz_mpoly_q_struct *z, struct exact_field *f, const char *name, void *motion);
/* The model's quantity of the oracle's name, as long as its rows times its columns. */
int exact_motion_oracle(struct num_vec *out, struct exact_motion *m, const char *name);
/* What is positive on the whole domain: chi, eta, V, 1 - chi and, inside a phase, the time since its start and the time
   to its end; as many elements as are returned, at most EXACT_POSITIVE. */
enum { EXACT_POSITIVE = 10 };
int exact_motion_positive(struct num_vec *out, struct exact_motion *m);
/* exp(A u) of a phase; SS_UNABLE, too, where the phase's exp(A t), as made here, has not the derivative A exp(A t) or
   is not the identity at 0, which is computed once, when a proof first reaches the phase. */
int exact_propagator(struct num_vec *p, struct exact_motion *m, enum phase ph, const fmpz_mpoly_q_struct *u);

#endif
