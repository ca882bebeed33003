/* What coulomb.c keeps for the two routes: a route knows how to move within one pair of modes, the run knows the law,
   counts, and talks to the sink. */
#ifndef STICKSLIP_COULOMB_IMPL_H
#define STICKSLIP_COULOMB_IMPL_H

#include "coulomb.h"

/* Signs (-1, 0, 1) of what the law looks at; a route calls zero what is within its rounding of zero. */
struct coulomb_signs {
  int speed[2];  /* x_i' - V */
  int pull[2];   /* f_i */
  int excess[2]; /* |f_i| - u_ri */
  int lead;      /* V - chi x_2', the rate of f_1 while m1 sticks */
  int drag;      /* f_2 + u_s2, the sign of f_1'' where that rate is zero */
};

/* Of a state in doubles, of which tol is the rounding. */
void coulomb_signs_d(struct coulomb_signs *s, const double params[N_COULOMB], const double state[N_STATE], double tol);

enum move { MOVE_EVENT, MOVE_END, MOVE_QUIET, MOVE_BUDGET, MOVE_STOPPED, MOVE_FAILED };

struct coulomb_run;
struct route {
  void *self;
  /* The signs at the present instant; may pull a value that counts as equal onto its limit. */
  void (*signs)(void *self, struct coulomb_signs *s);
  /* Moves to the next event (or to the plan's end), adding its steps to the result and passing the times it goes
     through to run_samples. */
  enum move (*move)(void *self, struct coulomb_run *run);
  /* The moment t, not before the present and within the stretch that move is passing through.  u is left to the run. */
  void (*row)(void *self, struct coulomb_row *row, double t);
  double (*time)(const void *self);
};
struct coulomb_run {
  const struct coulomb_plan *plan;
  const struct coulomb_sink *sink;
  struct coulomb_result *result;
  struct route route;
  double us[2];
  enum coulomb_mode mode[2];
  bool grazing[2]; /* set by move for the event at hand */
  double next;     /* the number of the next sample */
  bool blurred[2]; /* u_si counts as equal to u_ri */
};

bool run_domain(const double params[N_COULOMB], const double start[N_STATE], const struct coulomb_plan *plan);
/* What the run keeps of the parameters; tol: what counts as equal. */
void run_init(struct coulomb_run *run, const double params[N_COULOMB], double tol);
/* Runs to the end and fills the result. */
int run_all(struct coulomb_run *run);
/* Every sample due before t; with last, also one at t.  false: the sink has had enough. */
bool run_samples(struct coulomb_run *run, double t, bool last);

#endif
