/* Where the orbits of the word change along a line in parameter space.

   Along the line one of chi, eta, V, e1, e2 runs from one value to another, the others being fixed.  The orbits form
   curves in (parameter, t_b, t_c), the zeros of two equations that stay smooth where orbits merge and where an event
   grazes; a branch is a piece of such a curve on which its points are orbits of the word.  A bifurcation is a zero of
   one of these functions on a branch:

     id        function                        what happens there
     flip      tr J + 1                        the multiplier passes -1
     fold      d defect / d t_b, so tr J - 1   two orbits merge; the branch turns back
     t_a       t_a                             the stick phase vanishes: admissibility (51)
     h_v2      greatest z_2' - V within H      z_2' touches V in phase H: admissibility
     c_w       z_1 - chi z_2 - e1 in C         the first mass would slip in phase C: admissibility (59)
     u_r1      u_r1 - its bound                the scene's static friction is no longer enough: admissibility
     u_r2      u_r2 - its bound
     h_v1      greatest z_1' - V within H      z_1' touches V before t_c: the branch ends
     t_c       z_1'' at t_c                    t_c becomes a double root (grazing): the branch ends
     c_v2      z_2' - V at t_c                 z_2' meets V when m1 sticks, and phase C turns about: the branch ends
     t_b       t_b                             phase Gamma vanishes: the branch ends
     gamma_v1  t_c                             z_1' reaches V at t_b, and phase H vanishes: the branch ends
     gamma_r   the rise of chi r at t_b over   an earlier crest of phase Gamma reaches e2: the branch ends
               that of the crest before  */
#ifndef STICKSLIP_EXPLORE_BIFURCATE_H
#define STICKSLIP_EXPLORE_BIFURCATE_H

#include "motion/dynamics.h"

/* Their names, ids and what happens there; of c_w at the start of phase C, and at the greatest value inside it.  From
   CHANGE_H_V1 on they end a branch. */
#define DYN_CHANGES(C)                                                                                                 \
  C(FLIP, "flip", "tr J passes -1")                                                                                    \
  C(FOLD, "fold", "the solution merges with another one")                                                              \
  C(TA, "t_a", "t_a becomes zero")                                                                                     \
  C(H_V2, "h_v2", "the second mass reaches the velocity of the belt in the global slip phase")                         \
  C(C_W_START, "c_w", "the force on the first mass reaches its limit where it begins to stick")                        \
  C(C_W_HILL, "c_w", "the force on the first mass reaches its limit in the stick-slip phase")                          \
  C(U_R1, "u_r1", "the static friction of the first mass is no longer sufficient")                                     \
  C(U_R2, "u_r2", "the static friction of the second mass is no longer sufficient")                                    \
  C(H_V1, "h_v1", "the first mass reaches the velocity of the belt earlier in the global slip phase")                  \
  C(TC, "t_c", "the first mass touches the velocity of the belt at the end of the global slip phase")                  \
  C(C_V2, "c_v2", "both masses reach the velocity of the belt at the same time")                                       \
  C(TB, "t_b", "t_b becomes zero")                                                                                     \
  C(GAMMA_V1, "gamma_v1", "t_c becomes zero")                                                                          \
  C(GAMMA_R, "gamma_r", "the force on the second mass reaches its limit earlier in the slip-stick phase")
#define DYN_CHANGE(name, id, text) CHANGE_##name,
enum dyn_change { DYN_CHANGES(DYN_CHANGE) N_CHANGES };
#undef DYN_CHANGE
extern const char *const dyn_change_id[N_CHANGES];
extern const char *const dyn_change_text[N_CHANGES]; /* what happens there */

/* The orbits that take part, at one end of the bracket, an exact value of the parameter. */
struct dyn_beside {
  int n; /* that exist there: of two that merge, 0 or 2; those of a proved enclosure only */
  struct dyn_orbit orbit[2];
  truth word[2]; /* whether t_b and t_c are the first roots, so that it is an orbit of the word */
};
struct dyn_bifurcation {
  enum dyn_change what;
  slong branch, digits, prec; /* digits: of the bracket; prec: working precision of the proof */
  double place;               /* on the branch, as struct dyn_spot has it */
  fmpq low, high;             /* the parameter lies between them */
  arb_t tb, tc;               /* of the orbit there */
  arb_t trace;                /* likewise; indeterminate where it has a pole */
  bool crosses; /* proved: one curve of orbits over the whole bracket, on which the function has opposite signs at the
                   two ends; for fold and t_c the zero itself, by interval Newton with the function as third
                   equation */
  bool unique;  /* proved: that curve, or that box, holds no second zero */
  truth
      word; /* t_b and t_c are first roots over the whole bracket; UNKNOWN where the branch ends, and always for fold */
  int sense; /* 1: the function rises with the parameter, -1: it falls (fold, t_c: the orbits exist above, below) */
  struct dyn_orbit
      touch; /* t_c: the orbit at the zero, where first[PHASE_H] says that z_1' < V up to t_c; else nothing */
  arb_t
      third; /* flip: c_2^2 + c_3 of the return map over the bracket; the orbit at tr J = -1 is stable when it is > 0 */
  struct dyn_beside beside[2]; /* at low and at high */
};

enum dyn_branch_end { END_OF_LINE, END_CHANGE, END_CLOSED, END_LOST };
struct dyn_branch {
  double from[3], to[3]; /* parameter, t_b, t_c at its ends; from has the smaller parameter */
  double span[2];        /* least and greatest parameter on it */
  enum dyn_branch_end end[2];
  enum dyn_change change[2]; /* where the end is END_CHANGE */
  bool up;                   /* phase C ends at a maximum of z_2 - z_1 */
};
/* Where a branch was met as it was followed, in double precision; the place counts along it. */
struct dyn_spot {
  slong branch;
  double place, x[3]; /* parameter, t_b, t_c */
};
struct dyn_bifurcations {
  struct dyn_bifurcation *at; /* by increasing parameter */
  slong n;
  struct dyn_spot *spot;
  slong n_spots;
  struct dyn_branch *branch;
  slong n_branches;
  slong missed; /* sign changes that could not be narrowed down */
};

/* One parameter varies between two values. */
struct dyn_line {
  const fmpq *params; /* of which params[vary] is not used */
  int vary;
  const fmpq *from, *to;
  const fmpq *u_r[2]; /* static friction forces or NULL */
};
/* Looks for orbits at `starts` values of the parameter and follows their curves from one end of the line to the other.
   Brackets are one unit (or two) of the digits-th significant decimal of the
   parameter wide, or narrower where no proof succeeds over so wide a one.  Branches that lie between two starts, and
   pairs of changes that undo one another within one step, can be missed.  SS_DOMAIN when an end lies outside the domain
   of dynamics.h, SS_UNABLE (with lists that are valid as far as they go) when a search or a curve ran into its
   limits. */
int dyn_bifurcations_find(struct dyn_bifurcations *list, const struct dyn_line *line, slong digits, slong starts);
void dyn_bifurcations_clear(struct dyn_bifurcations *list);

#endif
