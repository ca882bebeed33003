/* Masses in a row of their own each, springs and dampers between any two of them or to the ground, surfaces that rub,
   harmonic loads, rigid obstacles:

     m_i x_i'' = u_i - f_i          f = K x + C x' - sum P_k (cos k theta, sin k theta)          theta' = Omega

   K and C are made from the springs and dampers, P from the loads: Omega is the largest number of which their
   frequencies are whole multiples, and a load of frequency k Omega is of the order k.  A mass that a surface of
   velocity V_i rubs has a sliding friction s_i and a static limit r_i, 0 <= s_i <= r_i, and moves in one of three
   modes; one that nothing rubs is free:

     's' sticks    x_i' = V_i, u_i = f_i, as long as |f_i| < r_i
     '-' slower    x_i' < V_i, u_i = +s_i
     '+' faster    x_i' > V_i, u_i = -s_i
     '.' free      u_i = 0

   An obstacle keeps x_i <= X or x_i >= X; a mass that reaches it rebounds, x_i' becomes -e x_i', 0 <= e <= 1.  Where
   e = 0 it rests there as long as it is pressed against the obstacle, in a mode of its own:

     'a' rests at the obstacle above    x_i = X, x_i' = 0, u_i - f_i > 0
     'b' rests at the obstacle below    x_i = X, x_i' = 0, u_i - f_i < 0

   with the friction u_i of a mass at rest beside its surface, +-s_i or 0, and slips or is free again from there.

   A phase is a letter for each mass, "s-" the first of two sticking and the second slower than its surface; one that
   begins with a rebound of the second mass ends in >2 (x_2 <= X) or <2 (x_2 >= X).  A word is a cyclic sequence of
   phases.  A sticking mass breaks loose at f_i = r_i to the slower side, at f_i = -r_i to the faster one; a slipping
   one that reaches V_i sticks where |f_i| < r_i and passes through elsewhere.

   Within a phase the state y = (x_1 ... x_n, x_1' ... x_n', 1), with cos theta, sin theta and cos k theta, sin k theta
   of each other order before the 1 where there are loads, obeys y' = A y with a constant matrix A, and every condition
   of a phase is a row c with c y < 0 (mech_rate, mech_condition): both exact, and the one place where the equations of
   motion are stated.  With two masses and springs 1 - chi and chi it is the paper's system.

   Parameters of a system file may be intervals, on which its data depend linearly.  The system is then that of their
   middles; beside it are those in which one of them is at its upper end.  With d_0 a datum of the first and d_i of the
   others it is d_0 + sum (d_i - d_0) delta_i over the box, -1 <= delta_i <= 1. */
#ifndef STICKSLIP_MECH_MECH_H
#define STICKSLIP_MECH_MECH_H

#include <flint/fmpq_mat.h>

#include "base/text.h"
#include "num/num.h"

enum {
  MECH_PHASE = 24 + 4,
  MECH_MASSES = 24,
  MECH_ORDERS = 9,   /* 1, and eight others at most, */
  MECH_HIGHEST = 64, /* none above this */
  MECH_STATES = 2 * MECH_MASSES + 2 * MECH_ORDERS,
  MECH_LINKS = 600,
  MECH_NAME = 32,
  MECH_PHASES = 48
};

/* An obstacle; where it is not given, none. */
struct mech_stop {
  bool given;
  char name[MECH_NAME];
  fmpq_t position, restitution;
};
struct mech_mass {
  char name[MECH_NAME];
  bool rubbed;
  struct mech_stop stop[2];                /* x >= its position, x <= its position */
  fmpq_t inertia, sliding, limit, surface; /* m_i, s_i, r_i, V_i */
};
/* A spring or a damper; an end of -1 is the ground. */
struct mech_link {
  char name[MECH_NAME];
  int end[2];
  fmpq_t size;
};
/* cosine cos(frequency t) + sine sin(frequency t), from the instant where theta is 0. */
struct mech_load {
  char name[MECH_NAME];
  int mass, order; /* order: by mech_finish */
  fmpq_t frequency, cosine, sine;
};
/* Another value for one of a file's parameters, or one that is an interval; a list. */
struct mech_given {
  struct mech_given *next;
  const char *name;
  fmpq_t low, high;         /* one value, or an interval's ends */
  const struct source *src; /* where it is given, for diagnostics; NULL: nowhere */
  size_t place;
};
struct mech {
  char *title;
  int n, n_springs, n_dampers, n_loads;
  int n_orders, order[MECH_ORDERS]; /* with loads: 1, then the others that occur */
  int states;                       /* the elements of y but the last: 2n, and two more for each order */
  struct mech_mass mass[MECH_MASSES];
  struct mech_link *spring, *damper;
  struct mech_load *load;
  fmpq_mat_t stiffness, damping, loading; /* K and C, n by n; P, two columns for each order */
  fmpq_t frequency;                       /* Omega; 0 without loads */
  struct mech_given *interval;            /* the parameters that are intervals, of a box; else NULL */
  int n_intervals;
  struct mech *moved; /* for each of them the system in which it is at its upper end */
};

/* A system without masses; the matrices are made by mech_finish. */
void mech_init(struct mech *m);
void mech_clear(struct mech *m);
void mech_given_free(struct mech_given *list); /* with the names */
/* A mass, spring or damper more, zero and free, between the ground and the ground; NULL when there is no room. */
struct mech_mass *mech_add_mass(struct mech *m, const char *name);
struct mech_link *mech_add_link(struct mech *m, bool spring, const char *name);
/* A load more, zero, on the first mass. */
struct mech_load *mech_add_load(struct mech *m, const char *name);
/* An obstacle for a mass, which has none on that side. */
struct mech_stop *mech_add_stop(struct mech_mass *mass, bool above, const char *name);
/* Makes K, C, P and Omega.  What is physically wrong is said in why (a mass that is not positive, a static limit below
   the sliding friction, masses that no chain of springs ties to the ground, ...), with the mass or link it is about in
   *name. */
bool mech_finish(struct mech *m, const char **why, const char **name);
/* The first load whose order is not the same in another system with as many; NULL: there is none. */
const char *mech_other_order(const struct mech *a, const struct mech *b);

/* Reads a system file (read.c says what stands in one).  false with d set. */
bool mech_load(struct mech *m, const char *path, struct diag *d);
/* The same with other values for some of its parameters, which it must have; of several for one the first.  box:
   parameters may be intervals; else they are refused. */
bool mech_load_with(struct mech *m, const char *path, const struct mech_given *given, bool box, struct diag *d);
/* The same from a source, which is taken over. */
bool mech_read(struct mech *m, struct source src, const struct mech_given *given, bool box, struct diag *d);

/* --- Phases and words --- */

struct mech_word {
  int n;
  char phase[MECH_PHASES][MECH_PHASE + 1];
};
/* "ss -s -- s-"; false with *why set, and *at to the offset of what is wrong: no phase of this system, a phase that
   equals the next one, two masses that change at once, a rebound where there is no obstacle. */
bool mech_word_parse(struct mech_word *w, size_t *at, const char **why, const char *text, const struct mech *m);
/* Whether each phase is one of this system, which may have other data than that for which the word was read. */
bool mech_word_is_of(const struct mech_word *w, const struct mech *m);
/* Whether each phase differs from the next by one mass. */
bool mech_word_good(const struct mech_word *w);
void mech_word_print(struct text *out, const struct mech_word *w);
/* The word turned to begin with its phase number by; out may be in. */
void mech_word_turn(struct mech_word *out, const struct mech_word *in, int by);
/* Is it the word `once`, begun at its phase number by, once or several times over? */
bool mech_word_goes_through(const struct mech_word *w, const struct mech_word *once, int by);
/* The same word, from whichever phase? */
bool mech_word_same(const struct mech_word *a, const struct mech_word *b);
/* How far b is turned to be a; -1 where they are not the same word. */
int mech_word_turned(const struct mech_word *a, const struct mech_word *b);

/* The elements of y from 2n on, but the last, where the loads' angle is theta. */
void mech_at_angle(double *pairs, const struct mech *m, double theta);
/* A of a phase, a square matrix of side states + 1. */
void mech_rate(fmpq_mat_t a, const struct mech *m, const char *phase);
/* What ends a phase, at a mass. */
enum mech_end {
  MECH_BREAKS_SLOWER, /* sticking: f_i - r_i */
  MECH_BREAKS_FASTER, /* sticking: -f_i - r_i */
  MECH_REACHES,       /* slipping: x_i' - V_i where slower, V_i - x_i' where faster */
  MECH_LIFTS,         /* resting: f_i - u_i above, u_i - f_i below */
  MECH_HITS_BELOW,    /* X - x_i */
  MECH_HITS_ABOVE     /* x_i - X */
};
bool mech_is_hit(enum mech_end end);
/* Does a mass of that mode rest at an obstacle? */
bool mech_rests(char mode);
/* What a mass does that slips from rest: '-', '+' or '.'. */
char mech_slipping(const struct mech_mass *mass);
/* Behind the letters of a phase: ">2" of the mass number 1, from the obstacle above it. */
void mech_mark(char *to, int mass, bool above);
/* The row c of length states + 1 with c y < 0 while the mass goes on in that mode. */
void mech_condition(fmpq_mat_t row, const struct mech *m, int mass, char mode, enum mech_end end);
/* The mass that changes or rebounds between two phases, and how; -1 when none or more than one does. */
int mech_event(enum mech_end *end, const char *from, const char *to);

#endif
