/* The four equations of given.h in the six quantities e1, e2, t_a, t_b, t_c, t_d, over any number type; Newton's iteration
   on any four of the six, and the proof that a box holds exactly one solution. */
#ifndef STICKSLIP_ORBIT_EQUATIONS_H
#define STICKSLIP_ORBIT_EQUATIONS_H

#include "map_balls.h"
#include "stickslip/given.h"

enum { WORD_FREE = 4 };
/* chi, eta, V and the two known quantities exactly, and the other four. */
struct word_data {
  const fmpq *model, *value;
  const enum dyn_quantity *which;
  int unknown[WORD_FREE];
};
/* Their left sides, zero on an orbit, and derivatives by the quantities. */
struct word {
  val e[WORD_FREE], j[WORD_FREE][N_QUANTITIES];
  val end; /* r at the stick phase */
};
/* Of the model; e1 and e2 are among the quantities and stand for nothing here. */
void word_params(struct ball_params *m, struct calc *c, const fmpq *model);
void word_make(struct word *w, struct calc *c, const struct ball_params *m, const val x[N_QUANTITIES]);
/* One Newton step on x; *settled when it is below 2^-bits. */
int word_newton(bool *settled, struct num_vec *x, struct calc *c, const struct ball_params *m,
                const int unknown[WORD_FREE], slong bits);
/* Newton's iteration in mpfr from x, the precision doubling up to that of x; the known ones are rounded once. */
int word_refine(struct num_vec *x, const struct word_data *q);

/* A solution: the enclosures x, and the boxes in which it is the only one. */
struct word_root {
  arb_t x[N_QUANTITIES], box[N_QUANTITIES];
};
void word_root_init(struct word_root *s);
void word_root_clear(struct word_root *s);
/* The rounded inverse y of the derivative at the midpoint, and the Newton step there. */
int word_precondition(struct num_vec *y, struct num_vec *step, const struct word *w, const int unknown[WORD_FREE]);
/* One application of Krawczyk's operator to s->box around the points mid: s->x, and whether it lies inside, which proves
   that the box holds exactly one solution, and s->x it. */
bool word_krawczyk(struct word_root *s, struct calc *c, const struct ball_params *m, const val mid[WORD_FREE],
                   const struct num_vec *y, const struct num_vec *step, const int unknown[WORD_FREE]);
/* Proves one solution near x (of mpfr), on boxes that grow until one is mapped into its interior. */
int word_enclose(struct word_root *s, const struct num_vec *x, const struct word_data *q);

#endif
