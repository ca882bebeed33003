/* What the equations of motion (1) and the law (2), as the paper states them, make of states: what claims about
   switches, configurations and phases are proved by.  The claim that is judged names the claims of kind law in
   depends-on, one for each mass, which name its equation of motion too. */
#ifndef STICKSLIP_JUDGE_FRICTION_H
#define STICKSLIP_JUDGE_FRICTION_H

#include "behaviour.h"
#include "law.h"

struct friction {
  struct law law[2];
  struct conditions moves[2]; /* the equation of motion of each mass */
};
/* false with d set; clear it in either case. */
bool friction_open(struct friction *f, struct behaviour *b);
void friction_clear(struct friction *f);

/* x'' of the mass in the state, by (1); NULL where (1) does not determine it. */
val friction_acceleration(const struct friction *f, struct law_state *s, int mass);
/* Gives a mass the friction of (2) while it slips (slips = 1: slower than the belt, -1: faster) or sticks (0; then it
   has the belt's velocity too).  false when (2) does not determine it. */
bool friction_apply(const struct friction *f, struct law_state *s, int mass, int slips);
/* The same of both masses, and both accelerations into s->a. */
bool friction_mode(const struct friction *f, struct law_state *s, const int slips[2]);

/* A proof's word as evidence: proved, refuted by it, or why neither (outcome ROUTE_UNDECIDED). */
struct route_result behaviour_proof(struct behaviour *b, enum route_outcome outcome, const char *note);
/* Proofs about the switches, as evidence: slip to stick; stick to slip (sliding_limit: where |f| reaches u_s); that
   masses stick in spite of small changes of the positions; that the states of the masses are sticking and slipping, and
   that their phases do not accumulate. */
struct route_result events_prove_stick(struct behaviour *b);
struct route_result events_prove_slip(struct behaviour *b, bool sliding_limit);
struct route_result events_prove_small(struct behaviour *b);
struct route_result events_prove_modes(struct behaviour *b);
/* Whether each mass is known to stick inside the limits, and to slip beyond. */
bool events_decided(const struct friction *f);
/* That a patched solution which breaks no condition of its phases is the motion under Coulomb's law. */
struct route_result phases_prove_motion(struct behaviour *b);
/* With a stable orbit that is certified here: that the phases' propagators alone do not tell stability, and that small
   perturbations of it exist which do not die out. */
struct route_result stable_prove_linearization(struct behaviour *b, const struct point *p, const struct dyn_orbit *o);
struct route_result stable_prove_conditional(struct behaviour *b, const struct point *p, const struct dyn_orbit *o);
/* The verdict of a proof alone. */
void behaviour_decide(struct behaviour *b, enum route_outcome outcome, const char *note);

#endif
