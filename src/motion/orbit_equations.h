/* The four equations of given.h in the six quantities e1, e2, t_a, t_b, t_c, t_d, over any number type; Newton's
   iteration on any four of the six, and the proof that a box holds exactly one solution. */
#ifndef STICKSLIP_ORBIT_EQUATIONS_H
#define STICKSLIP_ORBIT_EQUATIONS_H

#include "given.h"
#include "map_balls.h"
#include "orbit_judge.h"

enum { WORD_FREE = 4 };
/* chi, eta, V and the two known quantities exactly, and the other four. */
struct word_data {
  const fmpq *model, *value;
  const enum dyn_quantity *which;
  int unknown[WORD_FREE];
};
/* which: two that differ. */
struct word_data word_data_of(const fmpq *model, const enum dyn_quantity which[2], const fmpq *value);
/* Their left sides, zero on an orbit, and derivatives by the quantities. */
struct word {
  val e[WORD_FREE], j[WORD_FREE][N_QUANTITIES];
  val end;          /* r at the stick phase */
  val sine, cosine; /* of omega t_d */
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
/* A solution: the enclosures x, and the boxes in which it is the only one.  Zeros are one. */
struct word_root {
  arb_t x[N_QUANTITIES], box[N_QUANTITIES];
};
void word_root_clear(struct word_root *s);
/* The solution near the midpoints of s->x, at prec bits: Newton's iteration, the precision doubling up to that and the
   known quantities being rounded once; Krawczyk's operator proves it. */
int word_solve(struct word_root *s, const struct word_data *q, slong prec);

/* The numbers of a solution's orbit. */
int word_describe(struct dyn_orbit *o, const struct word_root *s, const fmpq *model, slong prec);
/* Its conditions; *domain: whether e1, e2, t_b, t_c and t_d are positive and phase C takes less than half a turn.
   Returns whether the events are proved to be first ones. */
truth word_judge_orbit(struct dyn_orbit *o, truth *domain, const struct word_root *s, const fmpq *model, slong prec,
                       long max_steps);

#endif
