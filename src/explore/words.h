/* Periodic motions with any sequence of phases.

   A phase is a pair of modes (motion/coulomb.h): each mass sticks, slips slower than the belt (friction +u_s) or faster
   (-u_s). The nine of them, with the letters of coulomb_letter; the paper's four are those without a faster mass:

     m1 \ m2    sticks   slower   faster
     sticks     D        C        c
     slower     Gamma    H        X
     faster     gamma    x        h

   A word is a cyclic sequence of phases, written D-Gamma-H-C or "D Gamma H C" or DGHC (G and g for Gamma and gamma).
   It is a word of the system of both masses (mech/two_masses.h), whose phases are "ss", "-s", "--", "s-" and so on.

   Coordinates.  With the forces f_1 = x_1 - chi x_2 and f_2 = chi (x_2 - x_1) the state is w_i = f_i - u_si (so that
   w_1 = z_1 - chi z_2 and w_2 = chi (z_2 - z_1) in the paper's z) and p_i = x_i' - V:

     w_1' = (1 - chi) V + p_1 - chi p_2                  w_2' = chi (p_2 - p_1)
     p_1' = -w_1 slower, -(w_1 + 2 u_s1) faster          p_2' = -eta w_2 slower, -eta (w_2 + 2 u_s2) faster

   and p_i = 0 while mass i sticks, which it does while -(e_i + 2 u_si) < w_i < e_i, e_i = u_ri - u_si.  So a word
   without a faster phase depends on e_1 and e_2 alone, and of the static friction needs only that it is large enough
   (u_ri >= (e_i - w_i)/2 along the phase); one with a faster phase needs u_r1 and u_r2 given, and u_si = u_ri - e_i.

   Transitions.  One mass changes its mode at a time; two at once need a coincidence of parameters.  A sticking mass
   breaks loose at w_i = e_i to the slower side or at w_i = -(e_i + 2 u_si) to the faster one; a slipping mass at p_i =
   0 is captured when its force lies within the static limits, and passes through to the other slip when it does not.
   Impossible are
   - a break of m1 to the faster side while m2 is not faster than the belt: w_1' = (1 - chi) V - chi p_2 > 0;
   - a break of m2 from D: w_2' = 0;
   - a break of m2 to the faster side while m1 is slower, or to the slower side while m1 is faster: w_2' = -chi p_1.

   What no period can do.  Positions come back after a period, so the mean velocity of each mass is zero and p_i has the
   mean -V: each mass is slower than the belt in some phase of the word.  Hence no orbit of D alone, of Gamma and D, of
   any word in which a mass always sticks or overruns.  The word H alone is the free oscillation about the equilibrium
   of both sliding forces: families (one for each normal mode; all of it where the frequencies are commensurable), with
   every multiplier on the unit circle, and no isolated orbit.

   Orbits.  The unknowns are the lengths t_1..t_n of the phases and those coordinates of the state at the entry of the
   first phase that are free there: of a mass that has just broken loose none, of one that sticks w_i, of one that has
   just been captured or passed through w_i, of one that slips w_i and p_i.  The equations are the n events and the
   return of the free coordinates.  A word is turned so that they are fewest: with a break beside a sticking mass one,
   beside a slipping mass two, and without any sticking three.  As for the paper's word an orbit is a solution in which
   each phase but D ends at the first positive root of its own switching function, and D may have any length; all else
   is admissibility: every length is positive, a sticking mass stays within its limits, a slower one slower and a faster
   one faster, and at a pass-through the force is beyond the limit.  These together are Coulomb's law: an admissible
   orbit is a motion.
   They are searched for in these coordinates in double precision, and enclosed, judged and differentiated by src/mech,
   in positions and velocities.

   Its Jacobian is that of the first return to the entry of the first phase in the free coordinates; the
   derivative of the whole return has, besides, the eigenvalues 1 (along the motion, no part of the return
   map) and 0 (for each coordinate that is not free).  Orbits at which it is singular, two masses change at once or a
   speed only touches the belt's are not isolated or not smooth, and are not found, or left undecided. */
#ifndef STICKSLIP_EXPLORE_WORDS_H
#define STICKSLIP_EXPLORE_WORDS_H

#include "mech/orbit.h"
#include "motion/dynamics.h"

/* --- Words. --- */

enum { WORD_MOST = 12 }; /* phases of a word */
/* From len bytes; false with *why set, and *at to the offset of what is wrong. */
bool phase_word_parse(struct mech_word *w, size_t *at, const char **why, const char *text, size_t len);
/* "D-Gamma-H-C", from the phase it begins with. */
void phase_word_print(struct text *out, const struct mech_word *w);
/* "Gamma" of "-s". */
const char *phase_word_name(const char *phase);
/* Turned to come first in the order D Gamma H C gamma h c X x. */
void phase_word_canonical(struct mech_word *w);
/* D-Gamma-H-C, from whichever phase. */
bool phase_word_is_papers(const struct mech_word *w);
bool phase_word_has_faster(const struct mech_word *w);

/* Why the phase to cannot follow the phase from; NULL when it can. */
const char *phase_word_barrier(const char *from, const char *to);

enum word_fate {
  WORD_OPEN,        /* nothing is known against it */
  WORD_IMPOSSIBLE,  /* a transition cannot happen */
  WORD_COINCIDENCE, /* two masses change at once: no orbit but at exceptional parameters */
  WORD_UNCLOSED,    /* proved: it cannot come back, a mass is never slower than the belt */
  WORD_FAMILY       /* H alone */
};
extern const char *const word_fate_name[WORD_FAMILY + 1]; /* "open", "impossible", "coincidence", ... */
/* With the reason in why (may be NULL), which names the two phases of an impossible transition. */
enum word_fate phase_word_fate(struct text *why, const struct mech_word *w);

/* The next word of n phases after *w in the order of canonical words whose transitions all can happen; *w with n = 0
   starts.  false: there is none. */
bool phase_word_next(struct mech_word *w, int n);
/* How many canonical words of n phases there are without a phase that follows itself (n = 1: nine). */
long phase_word_count(int n);

/* --- Orbits. --- */

/* The coordinates of the state in double precision. */
enum word_coordinate { WORD_W1, WORD_W2, WORD_P1, WORD_P2 };

enum { WORD_FREE_MOST = 3 };

/* The orbits of a word as those of the system of both masses.  Of an orbit own, admissible, certified and the facts are
   those of a word, see above: D may have any length, facts are those of phases with a length, and of a sticking mass's
   lower limit with u_r; stable is known whatever they say. */
struct word_orbits {
  struct mech_word word; /* turned so that the fewest coordinates are free */
  struct mech m; /* with the sliding friction u_ri - e_i, none where u_ri is not given: x is then the paper's z */
  struct mech_orbits found; /* by increasing period; candidates are starts of Newton's iteration in double precision,
                               failed are solutions that could not be enclosed */
  long evaluations;         /* of the word's map, in the search */
};

/* Where a search may start, in double precision: the lengths of the phases and the states at their entries. */
struct word_seed {
  struct mech_word word;
  double t[WORD_MOST], state[WORD_MOST][N_STATE]; /* w1, w2, p1, p2 */
  int count;                                      /* how many simulations settled there */
};
struct word_seeds {
  struct word_seed *seed;
  size_t n, cap;
  int starts, settled; /* simulations; those that settled on a word */
  double u_r[2];       /* the static friction they had */
};
/* Simulations under Coulomb's law from random starts (a fixed sequence), and the words that they settle on, any length
   up to WORD_MOST.  u_r[i] may be NULL: then 10 (e1 + e2) is taken. */
void word_seeds_find(struct word_seeds *seeds, const fmpq *params, const fmpq *const u_r[2], int starts);
void word_seeds_clear(struct word_seeds *seeds);

/* Orbits of one word, whose fate is WORD_OPEN, by increasing period, each enclosed to prec bits where its conditioning
   allows: Newton's iteration in double precision from the local minima of the defect on a grid of the free coordinates
   and from the seeds of this word (seeds may be NULL), then Krawczyk's operator in balls.  None found is no proof.  An
   orbit that is a shorter word's, repeated, is left out.  params: chi, eta, V, e1, e2.  SS_DOMAIN: a faster phase needs
   u_r1 and u_r2; parameters outside the domain. */
int word_orbits_find(struct word_orbits *list, const struct mech_word *w, const fmpq *params, const fmpq *const u_r[2],
                     const struct word_seeds *seeds, slong prec);
void word_orbits_clear(struct word_orbits *list);
/* The infimum of u_ri from the forces at which mass i is captured, 0 without a capture; for an admissible orbit that is
   the one of all its phases.  false: in some phase a mass is faster than the belt, so that u_r is given. */
bool word_orbit_friction(arb_t least, const struct mech_orbit *o, const struct mech *m, int mass, slong prec);
/* Makes them orbits of a system with static friction in any case: that is a quarter above the larger of e_i and what
   they need where u_ri is not given.  Positions move with it; they are enclosed again, with up to eight times as many
   bits where they need them, or left out; of what was judged they keep whether they are admissible. */
void word_orbits_with_friction(struct word_orbits *list, slong prec);

#endif
