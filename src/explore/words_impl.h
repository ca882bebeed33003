/* Phase words other than D-Gamma-H-C and their orbits (words.h): what the files words_*.c have in common.

   words            reading, printing, which phase can follow which
   words_equations  the equations of a word, for the search
   words_search     where the orbits of a word may be: a grid and Newton's iteration in double precision
   words_seeds      where simulations settle
   words_orbits     what the search finds, enclosed and judged by src/mech */
#ifndef STICKSLIP_WORDS_IMPL_H
#define STICKSLIP_WORDS_IMPL_H

#include "motion/mode_motion.h"
#include "words.h"

enum { WORD_UNKNOWNS = WORD_MOST + WORD_FREE_MOST };

/* How a phase ends. */
struct word_event {
  int mass;
  enum mech_end end;
};
struct word_event word_event_of(const struct mech_word *w, int phase);

/* A word, and the parameters as elements of a calc. */
struct word_law {
  const struct mech_word *w;
  int n_free, free[MECH_STATES];     /* the coordinates that are free at the entry of the first phase */
  struct motion_law law, difference; /* difference has V = 0 */
  val e[2], over[2];                 /* over[i] = 2 u_si; NULL where u_ri is not given */
};
void word_law_make(struct word_law *m, struct calc *c, const struct word_orbits *of, const fmpq *params,
                   const fmpq *const u_r[2]);
/* The motion from the state w1, w2, p1, p2 (difference: of two motions); motion_at tells the state after t. */
void word_motion(struct motion *out, struct calc *c, const struct word_law *m, const char *phase,
                 const val state[N_STATE], bool difference);
/* What is zero at an event. */
val word_event_value(struct calc *c, const struct word_law *m, const struct word_event *e, const val state[N_STATE]);
/* Sticking masses have no p. */
void word_settle(val state[N_STATE], const struct word_law *m, const char *phase);
/* The state at the entry of the first phase, from the free coordinates. */
void word_start(val state[N_STATE], struct calc *c, const struct word_law *m, const val *free);

/* Unknowns: n lengths, then the free coordinates.  The defects f of the events and of the free coordinates' return
   and their derivatives j, row by row. */
void word_equations(val *f, val *j, struct calc *c, const struct word_law *m, const val *x);

/* Solutions in double precision. */
struct word_found {
  double t[WORD_MOST], state[N_STATE]; /* at the entry of the first phase */
};
struct word_finds {
  struct word_found *found;
  size_t n, cap;
  long evaluations, candidates;
};
/* Of the word and the system in `of`. */
void word_search(struct word_finds *out, const struct word_orbits *of, const fmpq *params, const fmpq *const u_r[2],
                 const struct word_seeds *seeds);

#endif
