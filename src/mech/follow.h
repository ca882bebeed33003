/* Orbits of a system followed while one parameter of its file runs along a line.

   An orbit at one value is the guess at the next.  It counts as followed only where everything about it is decided and
   the way back leads to the orbit it came from.  Between two values at which something about it differs, or to the
   second of which it cannot be followed, the line is halved.  What is proved are the orbits at both ends of such a
   bracket and what holds of each (orbit.h); that one curve of orbits joins them is not. */
#ifndef STICKSLIP_MECH_FOLLOW_H
#define STICKSLIP_MECH_FOLLOW_H

#include "orbit.h"

struct mech_line {
  const char *path, *name;                  /* the system file and its parameter */
  struct mech_given *given;                 /* values of others in place of the file's */
  fmpq_t from, to;                          /* different */
  slong digits, prec;                       /* brackets: 10^-digits of the line; orbits */
  void (*progress)(size_t done, size_t of); /* or NULL: told of the search and of steps, there and back */
};

/* What is known at a value of the parameter. */
struct mech_side {
  fmpq_t at;
  bool found; /* there is an orbit; without one the rest says nothing */
  truth own, admissible, stable;
  double period;
};
enum mech_turn {
  MECH_FLIP,           /* the stability changes, and a multiplier passes -1; or an orbit ends on one that goes round
                          once while it goes twice */
  MECH_FOLD,           /* the same at 1, or no orbit is found beyond and a multiplier comes to 1 */
  MECH_NEIMARK_SACKER, /* the stability changes, and two conjugate ones pass the unit circle */
  MECH_CONDITION,      /* a condition of Coulomb's law begins or ceases to hold; where an event is no longer the first
                          one the branch ends */
  MECH_NO_FURTHER      /* no orbit is found beyond, and no multiplier comes to 1: an event may become a grazing one */
};
extern const char *const mech_turn_id[MECH_NO_FURTHER + 1]; /* "flip", "fold", "neimark-sacker", "condition", "lost" */
enum { MECH_TURNED = 8 };
struct mech_change {
  enum mech_turn what;
  int branch, n_facts;
  struct mech_side side[2];           /* in the direction of the line */
  struct mech_fact fact[MECH_TURNED]; /* the first of the conditions that are not the same on both sides; where the
                                         branch ends, those that make the solution beyond none of the word */
};
struct mech_branch {
  struct mech_word word;
  struct mech_side end[2]; /* in the direction of the line */
};
struct mech_follow {
  struct mech_change *change;
  struct mech_branch *branch;
  int n_changes, n_branches;
  size_t cap_changes, cap_branches;
  long looks; /* at how many values an orbit was solved for */
  fmpq_t at;  /* where the file describes no system, when it does not */
  bool spent; /* at the most that are allowed: there may be more changes */
};

/* The branches of orbits of their word, from those found at the line's first end, and from those at its other end that
   none of these reaches; of one word, or of all where w is NULL.  false with d set where the file describes no system
   at some value of the parameter. */
bool mech_follow(struct mech_follow *f, const struct mech_line *l, const struct mech_word *w, struct diag *d);
void mech_follow_clear(struct mech_follow *f);

#endif
