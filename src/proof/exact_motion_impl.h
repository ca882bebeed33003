/* What the files about exact motions share.  exact_params.c stands below the others, then exact_propagator.c,
   exact_states.c, exact_matrices.c and exact_motion.c, each on those before it.  All return status flags; what they
   make is rewritten by the relations of the motion's field, where nothing else is said. */
#ifndef STICKSLIP_EXACT_MOTION_IMPL_H
#define STICKSLIP_EXACT_MOTION_IMPL_H

#include "exact_motion.h"
#include "value/local_maps.h"

static inline element *at(const struct num_vec *v, slong i) {
  return num_vec_at(v, i);
}

/* A vector that shares n elements of another from i on. */
static inline struct num_vec part(const struct num_vec *v, slong i, slong n) {
  return (struct num_vec){v->ctx, n, num_vec_at(v, i)};
}

static inline bool is_periodic(const struct exact_motion *m) {
  return m->spec.kind == POINT_ORBIT;
}

/* Whether its points lie on motions over the whole word. */
static inline bool has_word(const struct exact_motion *m) {
  return point_has_word(m->spec.kind);
}

/* --- exact_params.c --- */

/* A motion without its binder, of which only the parameters and propagators may be asked. */
void exact_motion_begin(struct exact_motion *m, const struct exact_attempt *a, const struct point_spec *spec);
int motion_reduce(struct num_vec *v, const struct exact_motion *m);
int motion_op(num_binary f, element *z, const struct exact_motion *m, const element *x, const element *y);
/* z = x y, matrices of rows x inner and inner x cols. */
int motion_multiply(struct num_vec *z, const struct exact_motion *m, const struct num_vec *x, const struct num_vec *y,
                    slong rows, slong inner, slong cols);
/* A free symbol, or the number that the motion's restriction makes of it. */
int motion_symbol(element *z, struct exact_motion *m, const char *name);
/* Notes a name that has no value on such a motion; SS_UNABLE. */
int motion_unknown(struct exact_motion *m, const char *name);
/* The matrix A of a phase. */
int motion_system(struct num_vec *a, struct exact_motion *m, enum phase ph);
/* The motion's parameters as those of a point, for what is defined for every number type. */
int motion_as_values(struct values *v, struct exact_motion *m, const struct point *p);
/* The oracle's quantity of that name, which is one of the parameters alone. */
int motion_of_params(struct num_vec *out, struct exact_motion *m, const char *name);

/* --- exact_states.c --- */

/* The time that a phase takes. */
int motion_length(element *z, struct exact_motion *m, int phase);
/* Z_0, Z_a, Z_b, Z_c, Z_f for k = 0 to 4, shared with the motion; on a periodic motion the last is the first. */
int motion_state(struct num_vec *z, struct exact_motion *m, int k);
/* The number of the state of which "S_a", "S_b" or "S_c" is the name, or the start of one; 0 for another name. */
int motion_meeting(const char *name);
/* A z, the rate of the state z in a phase. */
int motion_rate(struct num_vec *f, struct exact_motion *m, int phase, const struct num_vec *z);
/* The same at the motion's k-th state. */
int motion_rate_at(struct num_vec *f, struct exact_motion *m, int k, int phase);
/* By how much the event that ends phase k - 1 comes later when the state z at its time is dz off, in first order. */
int motion_delay(element *dt, struct exact_motion *m, int k, const struct num_vec *dz, const struct num_vec *z);
/* The perturbation of state k, shared with the motion; it sets the change of the time before it, too. */
int motion_tangent(struct num_vec *dz, struct exact_motion *m, int k);
/* State k, or the perturbed one. */
int motion_perturbed(struct num_vec *out, struct exact_motion *m, int k, bool perturbed);

#endif
