/* What is known about an orbit once its (t_b, t_c) are: every number of struct dyn_orbit, and every condition.  The
   parameters may be balls too; then it holds for each of their points. */
#ifndef STICKSLIP_ORBIT_JUDGE_H
#define STICKSLIP_ORBIT_JUDGE_H

#include "map_balls.h"

/* The end of the word: phase C turns by the angle in (0, pi) whose tangent is |q|/(omega r); meanwhile w drifts to wf,
   and the stick phase makes up the rest.  Also of a pass that does not close. */
struct ball_ending {
  val turn, td, wf, ta;
};
void ball_ending_make(struct ball_ending *e, struct calc *c, const struct ball_params *m, const struct ball_pass *s);

/* e1 - w in phase C at the angle u before its end at r_end, after which the stick phase takes ta. */
val ball_force_left(struct calc *c, const struct ball_params *m, val ta, val r_end, val u);
/* The angles before the end at which w would have a valley and, before it, a hill; false where it surely rises all
   along. */
bool ball_force_turns(val u[2], struct calc *c, const struct ball_params *m, val r_end);

/* Its numbers: those of DYN_ORBIT_NUMBERS, and the margin. */
enum { ORBIT_BALLS = 13 };
void dyn_orbit_balls(arb_ptr all[ORBIT_BALLS], struct dyn_orbit *o);
/* An orbit of its own; what it held is lost. */
void dyn_orbit_copy(struct dyn_orbit *to, struct dyn_orbit *o);
/* Every number of the orbit that a pass is. */
int dyn_orbit_describe(struct dyn_orbit *o, struct calc *c, const struct ball_params *m, const struct ball_pass *s);
/* The conditions.  Returns whether t_b and t_c are proved to be first roots, and the direction of phase C. */
truth dyn_orbit_judge(struct dyn_orbit *o, struct calc *c, const struct ball_params *m, const struct ball_pass *s,
                      long max_steps);

/* --- What the searches for orbits share. --- */

/* A solution near a known place, which is solved for at any precision. */
struct orbit_source {
  void *self;
  int (*solve)(void *self, slong prec);
  /* The numbers and the conditions of its orbit, from enclosures that solve left; the judgement is whether it is proved
     to be an orbit of the word. */
  int (*describe)(struct dyn_orbit *o, void *self, slong prec);
  truth (*judge)(struct dyn_orbit *o, void *self, slong prec);
};
/* The first working precision for prec bits of every number of its orbit.  How many bits the worst of them loses is the
   orbit's own (its condition) and hardly depends on the precision, so that a pilot run tells; up to 512 bits a failed
   attempt costs less than one. */
slong orbit_planned_bits(const struct orbit_source *s, slong prec);
/* The orbit of a source that is solved at `work` bits, to prec bits: the working precision is raised, *raises times, as
   long as that helps.  *valid as judge returns it. */
int orbit_finish(struct dyn_orbit *o, truth *valid, long *raises, const struct orbit_source *s, slong work, slong prec);
/* The same for the list, which has room for one more, unless it is proved to be none. */
int orbit_list_add(struct dyn_orbits *list, const struct orbit_source *s, slong work, slong prec);

/* For qsort: struct dyn_orbit by increasing z10. */
int dyn_orbits_by_z10(const void *x, const void *y);

#endif
