/* Coulomb's law (2) as a claim of kind law reads it, for one mass, and what it says of states whose signs are known.

   A cell is a set of states of one mass on which every sign that (2) asks for is the same: on which side of the belt's
   velocity V the mass is, and where the force f = x_1 - chi x_2, or chi (x_2 - x_1), that friction has to balance lies
   between the limits.  Its states are rational functions of symbols that are positive, and of others that may have any
   value (the other mass's place, velocity and friction); finitely many cells hold all states.  A margin has a sign on
   a cell when all its terms, which then contain positive symbols alone, have it. */
#ifndef STICKSLIP_JUDGE_LAW_H
#define STICKSLIP_JUDGE_LAW_H

#include "num/calc.h"
#include "proof/condition.h"

enum branch { SLIPS, STICKS, BREAKS, N_BRANCHES };

struct law {
  struct judge *j;
  struct conditions branch[N_BRANCHES];
  struct sentence heading; /* over the branches of a mass that has the belt's velocity */
  bool headed;
  char names[2][16]; /* of the mass's sliding and static friction */
  int mass;          /* 0 or 1 */
  int slower;        /* the eps of a slower mass that slips, which the text may choose; 0: not known */
  bool closed;       /* a mass breaks away at its limits too: ">=" where the text has ">" */
};
/* The law of a claim; false with j->d set.  Clear it in either case. */
bool law_read(struct law *l, struct judge *j, const struct claim *c, struct view view);
void law_clear(struct law *l);

/* Where f is, side being 1 or -1: anywhere; |f| < u_r; side f = u_r, > u_r; side f = u_s, > u_s, < u_s. */
enum pull { PULL_ANY, PULL_INSIDE, PULL_AT, PULL_BEYOND, PULL_SLIDING, PULL_OVER, PULL_UNDER };
struct law_cell {
  int mass, speed; /* the sign of V - x' */
  enum pull pull;
  int side;
};

/* A state over the symbols; the values may be replaced by others of its calc. */
struct law_state {
  struct calc c;
  val chi, eta, belt, x[2], v[2], a[2], u[2], slide[2], limit[2], eps;
  val shift[2];        /* d_01 and d_02 in z = x - d_0; 0 unless set */
  char unknown[8][32]; /* names that nothing gives a value: any value */
  int n_unknown;
};
/* Both masses anywhere; u_r > u_s > 0 and chi, eta, V > 0.  In balls each symbol is some number instead. */
void law_state_open(struct law_state *s, struct num_ctx ctx);
/* Exact, with one mass in the cell; inside the limits u_s is any positive number. */
void law_state_open_in(struct law_state *s, struct law_cell cell);
void law_state_clear(struct law_state *s);
/* f of the mass. */
val law_pull(struct law_state *s, int mass);
/* A symbol of any value. */
val law_free(struct law_state *s);

enum { NO_SIGN = 2 };
/* -1, 0 or 1 wherever the state's symbols have their signs; NO_SIGN when that is not known. */
int law_sign(const struct law_state *s, val x);
/* Whether x is the constant 0; FALSE: it has other values too. */
truth law_vanishes(const struct law_state *s, val x);
/* Whether x is a constant plus constants times the places and velocities. */
truth law_affine(const struct law_state *s, val x);
/* The rational number that x is; false when it is not known to be one. */
bool law_rational(fmpq_t out, const struct law_state *s, val x);
/* All outputs of a tape with the statements' names (those of the law's mass, where it is given); false when one has no
   such value. */
bool law_values(struct num_vec *out, struct law_state *s, const struct tape *t, const struct law *names);
/* The first of them, or NULL. */
val law_value(struct law_state *s, const struct tape *t, const struct law *names);
/* The value of *unknown (one of the state's) at which an equation's margin is zero, where it is of degree 1 in it. */
val law_solve(struct law_state *s, val *unknown, const struct condition *equation, const struct law *names);

/* Do the inequalities of the branch hold in the state (eps of BREAKS being the state's), with the friction that it
   gives? */
truth law_holds(const struct law *l, struct law_state *s, enum branch b);
/* The friction that the branch gives; NULL when its equations do not determine it. */
val law_friction(const struct law *l, struct law_state *s, enum branch b);
/* Does the heading hold (a mass without one: UNKNOWN)? */
truth law_headed(const struct law *l, struct law_state *s);

/* Which branches (2) has for a mass in the state, those whose conditions hold: SLIPS with either sign, and the
   others where the mass has the belt's velocity.  n = -1 when that is not decided; else b, eps and u are those of the
   first of the n. */
struct law_answer {
  int n;
  enum branch b;
  int eps;
  val u;
};
struct law_answer law_answer(const struct law *l, struct law_state *s, int speed);
/* Is u the friction by no branch that may apply, whatever friction their equations determine? */
bool law_denies(const struct law *l, struct law_state *s, int speed, val u);

#endif
