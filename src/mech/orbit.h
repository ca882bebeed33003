/* Periodic motions of a system with a given word of phases, enclosed with proof.

   Unknown are the lengths t_1 ... t_K of the phases and the coordinates of the state at the entry of the first phase
   that are free there: not the velocity of a sticking mass or of the one that has just changed its mode, nor the
   position of one that has just broken loose, since its force is at the limit, or has just rebounded, nor either of one
   that rests at an obstacle or rebounds without velocity; with loads their angle theta is one more.  The equations are
   the K events and the return of those coordinates, that of the angle after a given number of turns.  A word may be
   turned so that they are fewest.

   What is proved: by Krawczyk's operator in balls that a box holds exactly one solution; along each phase, by
   Taylor's formula in steps, that each condition of the phase holds up to its end, so that every event is the first
   one; the multipliers are those of the first return of the free coordinates, in balls.  Together, a certified
   admissible orbit is a motion under Coulomb's law.  Nothing is said about how many orbits there are. */
#ifndef STICKSLIP_MECH_ORBIT_H
#define STICKSLIP_MECH_ORBIT_H

#include "num/flint_more.h"
#include "walk.h"

enum mech_rule {
  MECH_LENGTH,  /* the phase has a positive length */
  MECH_SLOWER,  /* a slower mass is slower than its surface */
  MECH_FASTER,  /* a faster one faster */
  MECH_BELOW,   /* a sticking mass: f < r */
  MECH_ABOVE,   /* a sticking mass: f > -r */
  MECH_CLEAR,   /* a mass is clear of an obstacle */
  MECH_PRESSED, /* a resting one is pressed against its obstacle */
  MECH_BEYOND   /* a mass that passes through has a force beyond its limit */
};
/* "length", "slower", "faster", "break", "break_low", "obstacle", "contact", "beyond" */
extern const char *const mech_rule_name[MECH_BEYOND + 1];
struct mech_fact {
  int phase, mass; /* mass is 0 for a length */
  enum mech_rule rule;
  bool ends; /* its zero is the event that ends the phase: that it is the first one */
  truth holds;
  truth reversed; /* of one that ends the phase: it is broken from the entry on, and the event is its first zero */
  bool changes;   /* over a box: it is proved to hold in a part of it, and to be broken in another */
};
/* "3-m2-break" of the third phase; "3-Gamma-m2-break" where it has that name, else NULL. */
void mech_fact_print(struct text *out, const struct mech *m, const struct mech_fact *f, const char *phase);

struct mech_orbit {
  struct mech_word word;
  int n, states, n_free, free[MECH_STATES]; /* masses; see mech.h; places in x_1 ... x_n, x_1' ... x_n', theta */
  arb_ptr t, state;                         /* word.n lengths; the states at the entry of each phase */
  arb_t period, angle;                      /* theta at the entry of the first phase; 0 without loads */
  slong turns;                              /* of theta in a period */
  arb_mat_t jacobian;                       /* of the first return of the free coordinates */
  arb_ptr box;                              /* the lengths and the free coordinates: the proved box */
  acb_ptr multiplier;                       /* its eigenvalues, by decreasing modulus; n_free */
  bool multipliers;                         /* they are enclosed */
  struct mech_fact *fact;                   /* from here on by mech_orbit_judge; before, unknown */
  int n_facts;
  truth own;        /* every phase has a positive length and ends with its first event */
  truth admissible; /* all facts: Coulomb's law */
  truth stable;     /* every multiplier below 1 in modulus; of an orbit of its own word, else unknown */
  bool certified;   /* existence, uniqueness in a box, every fact and the stability are settled */
  /* Over a box of parameters, see below. */
  int pieces;              /* by which it is proved there, or MECH_UNPROVED; 0: there is no box */
  bool changes;            /* it is proved to be stable in a part of it, and not to be in another */
  struct mech_orbit *over; /* its numbers there; NULL where it is not proved */
};

/* How many coordinates are free at the entry of the first phase of a word, and which. */
int mech_free(int free[MECH_STATES], const struct mech *m, const struct mech_word *w);
/* How far a word is turned so that they are fewest, and among those first in it as it is. */
int mech_best_turn(const struct mech *m, const struct mech_word *w);
/* Turns a word so that the fewest coordinates are free, with its lengths t, and the state z at the entry of its first
   phase (m->states numbers). */
void mech_word_best(struct mech_word *w, double *t, double *z, const struct mech *m);
/* The orbit near such lengths and such a state, to prec bits where its conditioning allows; its conditions are not
   looked at.  SS_UNABLE: none is proved there, SS_DOMAIN: the word is not one of the system, and the orbit needs no
   clearing. */
int mech_orbit_near(struct mech_orbit *o, const struct mech *m, const struct mech_word *w, const double *t,
                    const double *z, slong prec);
/* own, admissible and certified, from the facts and the stability. */
void mech_orbit_conclude(struct mech_orbit *o);
/* Its conditions: Coulomb's law. */
void mech_orbit_judge(struct mech_orbit *o, const struct mech *m, slong prec);
enum mech_derivative {
  MECH_IMPLICIT,       /* of the equations that were solved, eliminating the events' times: the orbit's own */
  MECH_SALTATION,      /* matrix exponentials and saltation matrices */
  MECH_BESIDE_PATCHED, /* central differences of motions beside the orbit, in balls of their error as it is estimated */
  MECH_BESIDE_INTEGRATED /* the same, integrated as they stand */
};
/* The Jacobian of an orbit's first return by that route.  Not 0: the motions beside it do not follow the word. */
int mech_jacobian(arb_mat_t j, const struct mech *m, const struct mech_orbit *o, enum mech_derivative how, slong prec);
/* The orbit near another one's numbers, which may be of other data. */
int mech_orbit_beside(struct mech_orbit *o, const struct mech *m, const struct mech_orbit *near, slong prec);
/* Judged; solved for again with up to eight times as many bits where something is left open. */
void mech_orbit_decide(struct mech_orbit *o, const struct mech *m, slong prec);
/* Certified and admissible. */
bool mech_orbit_is_motion(const struct mech_orbit *o);
void mech_orbit_clear(struct mech_orbit *o);
/* The eigenvalues of a real square matrix, by decreasing modulus; false when they cannot be enclosed. */
bool mech_eigenvalues(acb_ptr z, const arb_mat_t a, slong prec);
/* Are they all below 1 in modulus? */
truth mech_all_inside(acb_srcptr z, int n);

/* Over a box of parameters that are intervals (mech_load_with).  Each of the orbits at its middle is followed over it:
   the box is halved, until on each of its pieces an orbit is proved for every point and what can be decided of it is.
   The union of the pieces' numbers is beside the orbit's own, those at the middle; its truths become those of all
   points, and it counts as certified no more.  That the orbits of neighbouring pieces are one branch is not looked
   into. */
enum { MECH_UNPROVED = -1, MECH_PIECES = 128 };
struct mech_box {
  const char *path; /* the system file, with such values in place of its own */
  const struct mech_given *given;
  const struct mech *m; /* what mech_load_with made of them */
  slong prec;
  void (*progress)(size_t done, size_t of); /* or NULL: told of pieces */
};
struct mech_orbits;
void mech_orbits_over(struct mech_orbits *list, const struct mech_box *b);

struct mech_orbits {
  struct mech_orbit *orbit;
  int n;
  int simulations, unfinished; /* motions simulated; of these not to their end (mech_simulate) */
  int candidates, failed;      /* starts of Newton's iteration; of these without a proved orbit */
};
/* Who waits is told of each motion and each start of Newton's iteration, MECH_SEARCHED at most, beside what else there
   is to do. */
enum { MECH_SIMULATIONS = 36, MECH_CANDIDATES = 90, MECH_SEARCHED = MECH_SIMULATIONS + MECH_CANDIDATES };
struct mech_tell {
  void (*to)(size_t done, size_t of); /* or NULL */
  size_t before, of;                  /* done before; altogether */
};
/* Orbits that simulated motions come near, by increasing period; of one word, or of all when w is NULL.  Motions from
   random starts (a fixed sequence) are searched for stretches that nearly return; unstable orbits are met only as
   motions pass them.  None found is no proof.  any: the first motion that leads to a certified admissible orbit is the
   last one.  tell may be NULL. */
void mech_orbits_find(struct mech_orbits *list, const struct mech *m, const struct mech_word *w, bool any, slong prec,
                      const struct mech_tell *tell);
/* Where the first of these motions starts, in a double for each element of the state. */
void mech_first_start(double *z, const struct mech *m);
void mech_orbits_clear(struct mech_orbits *list);

/* The words on which motions settle, from the starts of mech_orbits_find, but followed ten times as long; tells of
   each, MECH_SIMULATIONS in all. */
struct mech_settling {
  struct mech_settled {
    struct mech_word word;
    int motions;
  } * on;
  int n;
  int starts, settled, unfinished; /* motions; of these, those that settle; those that could not be followed so long */
  int eventless;                   /* those that go on without an event, such as vibrations in which no mass sticks */
};
void mech_settle(struct mech_settling *s, const struct mech *m, const struct mech_tell *tell);
void mech_settling_clear(struct mech_settling *s);
int mech_orbits_certified(const struct mech_orbits *list); /* how many */
/* The certified ones as a file for stickslip-checker (verify/checker/README.md); scene: a name. */
void mech_certificates_json(struct text *out, const char *scene, const struct mech *m, const struct mech_orbits *list);
/* Are they of the same word, with enclosures of all lengths and states that meet? */
bool mech_orbit_meets(const struct mech_orbit *a, const struct mech_orbit *b);
/* Does o meet one of them? */
bool mech_orbits_hold(const struct mech_orbits *list, const struct mech_orbit *o);
/* Takes o over. */
void mech_orbits_add(struct mech_orbits *list, const struct mech_orbit *o);
void mech_orbits_sort(struct mech_orbits *list); /* by increasing period */

#endif
