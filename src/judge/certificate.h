/* What a failure rests on, in numbers that somebody else can recompute: the certificate of a finding (that of an orbit:
   mech/certificate.c). */
#ifndef STICKSLIP_JUDGE_CERTIFICATE_H
#define STICKSLIP_JUDGE_CERTIFICATE_H

#include "judge.h"
#include "value/sentence.h"

/* x as p/q. */
void certify_exact(struct certificate *c, struct judge *j, const char *name, const fmpq *x);
/* x to CERTIFIED_DIGITS digits. */
enum { CERTIFIED_DIGITS = 15 };
void certify_ball(struct certificate *c, struct judge *j, const char *name, const arb_t x);
/* chi, eta, V, e_1, e_2; what the scene gives of them. */
void certify_params(struct certificate *c, struct judge *j, const fmpq *params);
void certify_scene(struct certificate *c, struct judge *j);
/* The parameters of a member of a family along one of them, whose value is given as a ball of prec bits. */
void certify_member(struct certificate *c, struct judge *j, const fmpq *params, int vary, const fmpq *value,
                    slong prec);
/* z_10, z_20, t_a, t_b, t_c, t_d of an orbit. */
void certify_orbit(struct certificate *c, struct judge *j, const struct dyn_orbit *o);
/* The exact quantities of a point, read as of point_certified, and what follows from t_b and t_c, of an orbit of the
   pool. */
void certify_drawn(struct certificate *c, struct judge *j, const struct point *p, const struct dyn_orbit *o,
                   unsigned read);
/* The numbers of a point on which what a sentence says there can rest, read or not: its exact quantities, the events
   of its pass where it has one, the time t where the sentence speaks of it, and what is perturbed where the
   perturbations are any numbers. */
void certify_point(struct certificate *c, struct judge *j, const struct point *p, struct sentence *s);
/* ", u_s1 = 2, t = 2.25": those of them that the sentence reads and the text of the point (point_print) does not
   say. */
const char *certificate_rest(struct judge *j, const struct point *p, struct sentence *s);

#endif
