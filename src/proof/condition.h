/* Conditions: inequalities and equations of the paper as margins along a phase of a periodic orbit.

   A condition is one step of a relation of the equation files, its margin what must be positive (the right side minus
   the left one of "<") or zero.  A margin has a derivative along a phase by Z' = A Z, and time is halved until an
   enclosure of the margin, or near an end where the margin vanishes by definition one of its derivative, has a sign.
   What that leaves open, or an equation, is refuted where it fails at one of some moments; where exact algebra finds
   the margin zero, an equation, <= and >= hold; else it is unknown. */
#ifndef STICKSLIP_CONDITION_H
#define STICKSLIP_CONDITION_H

#include "value/sentence.h"

/* What moves along a phase: z_1(t), z_2(t), z_1'(t), z_2'(t), t, the same four of x, and the second and third
   derivatives of z and x. */
enum { MOVING_T = 4, MOVING_X = 5, MOVING_SECOND = 9, MOVING_THIRD = 13, N_MOVING = 17, MAX_CONDITIONS = 24 };

struct condition {
  struct sentence s;    /* its tape gives the margin */
  struct tape rate;     /* and this the margin's derivative, */
  bool has_rate;        /* unless a root moves, through which none is seen, or a fourth derivative stands in it */
  const char *text;     /* as written */
  const char *equation; /* the paper's number of it, or NULL */
  const char *unbound;  /* a name in it that had no value at a point; NULL: none has been met */
  bool equality, strict;
  truth vanishes[3]; /* is the margin zero on every orbit (exact_vanishes), by enum exact_time; UNKNOWN until asked */
  bool moving;       /* along `phase`; else at the switching times alone */
  enum phase phase;
  slong input[N_MOVING]; /* index among the tape's inputs, or -1 */
  bool friction[2];      /* whether the margin depends on u_s1, on u_s2 (through u_r1, u_r2, or x = z + d) */
  bool in_x;             /* some x_i(t) or x_i'(t) is among the inputs */
};

struct conditions {
  struct condition at[MAX_CONDITIONS];
  int n;
};

/* "eq-51, eq-52#1, eq-59#1.2, eq-56 D": records, the statement and the step of its chain (all without), and the phase
   of a record that names the time t without a range.  false with j->d set. */
bool conditions_read(struct conditions *list, struct judge *j, const struct claim *c, const char *attribute,
                     struct view view);
void conditions_clear(struct conditions *list);
/* Whether an inequality of the list is a < or >; a <= or >=. */
bool conditions_any_strict(const struct conditions *list);
bool conditions_admit_equality(const struct conditions *list);
/* Whether one of them depends on the friction. */
bool conditions_use_friction(const struct conditions *list);
/* Do inequalities of the list keep the switching functions of phases Gamma, H and C from zero along their phases, so
   that t_b, t_c and t_d are first roots?  By exact algebra: such a margin is a switching function times a number and
   powers of the parameters. */
bool conditions_make_first(const struct conditions *list);

/* The least margin over samples of the open phase at u_s1 = u_s2 = 0 (of an equality minus the largest deviation), and
   its slopes in them; in double, in units of V.  Status flags. */
struct sampled {
  double least, slope[2];
};
int conditions_sample(struct sampled *out, struct conditions *list, const struct point *p, struct orbit_cache *cache);

/* Does the condition hold throughout its phase at the point?  In balls of FIRST_PREC bits; that both sides are equal is
   known by exact algebra, or where they are exact numbers, alone.  FALSE: *where is a fraction of the phase at which it
   certainly fails (0 or 1: beside that end; of what is not halved, the moment tried at which it fails most), and value
   the margin there; either may be NULL. */
truth condition_holds(double *where, arb_ptr value, struct condition *c, const struct point *p,
                      struct orbit_cache *cache);
/* Do all of them?  Looks no further than the first that fails. */
truth conditions_hold(struct conditions *list, const struct point *p, struct orbit_cache *cache);
/* The same at one fraction of the phase, or with where < 0 at the samples, the states carried by matrix
   exponentials. */
truth condition_holds_at(struct condition *c, const struct point *p, double where, struct orbit_cache *cache);

#endif
