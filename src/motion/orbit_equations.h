/* The four equations of given.h in the six quantities e1, e2, t_a, t_b, t_c, t_d, over any number type; Newton's
   iteration on any four of the six, and the proof that a box holds exactly one solution. */
#ifndef STICKSLIP_ORBIT_EQUATIONS_H
#define STICKSLIP_ORBIT_EQUATIONS_H

#include "given.h"
#include "map_balls.h"

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
/* The equations as a system of num/solve.h in the unknown quantities; self is a struct word_system. */
struct word_system {
  struct calc *c;
  const struct ball_params *m;
  const int *unknown;
  slong mark;              /* what lies above it in the calc belongs to one evaluation */
  val known[N_QUANTITIES]; /* those of the unknown ones are not read */
};
int word_values(const void **f, const void **j, const struct num_vec *x, void *self);
/* Whether each part of a step is at most 2^-bits of all times together, or of both limits. */
bool word_step_is_small(const struct num_vec *x, const struct num_vec *step, const struct word_system *s, slong bits);
/* Newton's iteration in mpfr from x, the precision doubling up to that of x; the known ones are rounded once. */
int word_refine(struct num_vec *x, const struct word_data *q);

/* A solution: the enclosures x, and the boxes in which it is the only one. */
struct word_root {
  arb_t x[N_QUANTITIES], box[N_QUANTITIES];
};
void word_root_init(struct word_root *s);
void word_root_clear(struct word_root *s);
/* Proves one solution near x (of mpfr) by Krawczyk's operator. */
int word_enclose(struct word_root *s, const struct num_vec *x, const struct word_data *q);

#endif
