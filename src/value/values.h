/* Values of the paper's symbols at a point, in one number type. */
#ifndef STICKSLIP_VALUES_H
#define STICKSLIP_VALUES_H

#include "names.h"
#include "num/calc.h"
#include "point.h"
#include "tape/tape.h"

/* How they are got: closed form and implicit differentiation; states carried by matrix exponentials; tangents by finite
   differences; the return Jacobian by saltation matrices; orbits and their return Jacobian by the engine for any
   system, in balls alone. */
enum variant { VARIANT_CLOSED, VARIANT_EXPONENTIAL, VARIANT_FD, VARIANT_SALTATION, VARIANT_SYSTEM };

struct values {
  struct num_ctx ctx;
  const struct point *point;
  enum variant variant;
  struct calc c;            /* whose vectors the next ones are */
  struct num_vec q;         /* N_Q */
  unsigned read;            /* bit for each of them that symbols have been given the value of */
  struct num_vec params;    /* N_PARAMS */
  struct dyn_arc arc;       /* POINT_ARC, POINT_ORBIT */
  struct dyn_arc perturbed; /* finite perturbations */
  struct num_vec t;         /* the time t; on arcs made when first asked for, as the next two */
  struct num_vec zt, azt;   /* Z(t) and its derivative */
  bool have_t;
  struct followed *followed; /* whose arc it is, for many; NULL: another's */
  struct num_vec phi;        /* of an arc that is not followed; as there */
  bool have_phi[N_PHASES];
  struct num_vec return_jacobian; /* VARIANT_SYSTEM: J, 4 */
  struct num_vec local;           /* four local Jacobians, 16 each; each made when first asked for */
  bool have_local[N_PHASES];
  struct num_vec tangent; /* dZ_0, dZ_a, dZ_b, dZ_c, dZ_f, 4 each */
  struct num_vec dt;      /* dt_a, dt_b, dt_c, dt_d */
  bool have_tangent;
  unsigned tangent_read; /* bit for each of these 20 and 4, as of read */

  struct oracle_matrix *matrices; /* whose entries were asked for */
  size_t n_matrices, cap_matrices;
};

/* Status flags; anything but SS_OK means that the point is not accepted in this type. */
int values_init(struct values *v, const struct point *p, enum variant variant, struct num_ctx ctx,
                struct orbit_cache *cache);
void values_clear(struct values *v);
/* An exact quantity of the point for a symbol; that it was read is noted. */
const void *values_exact(struct values *v, int q);
/* The state after the time tau of a phase, by the variant's means; out may alias from. */
int values_carry(struct num_vec *out, const struct values *v, enum phase ph, const struct num_vec *from,
                 const void *tau);
/* The same from the start of the phase on the arc, and its rate; kept where an orbit is followed. */
int values_along(struct num_vec *z, struct num_vec *rate, const struct values *v, enum phase ph, const void *tau);
/* exp(A t) of a phase over its time on the arc. */
int values_propagator(struct num_vec *out, struct values *v, enum phase ph);
/* The value of a free symbol of a tape.  SS_UNABLE with *known = false for a name that has none at such a point. */
int values_bind(void *z, bool *known, struct values *v, const char *name);
/* Those of a tape's inputs, as many as in; *unbound becomes the first name without one, or NULL. */
int values_bind_inputs(struct num_vec *in, const char **unbound, struct values *v, const struct tape *t);
/* The outputs of a tape with these for its inputs, likewise. */
int values_eval(struct num_vec *out, const char **unbound, struct values *v, const struct tape *t);
/* Whether the model has a quantity of that name, at points of some kind. */
bool values_names(const char *name);
/* Whether springs_bind has. */
bool springs_names(const char *name);
/* The blocks behind (1), for motions of one phase: u_1, F_1, k_1, m_1, omega_3, ...; false for other names. */
bool springs_bind(int *status, void *z, struct values *v, const char *name);
int springs_square_of_omega_3(void *z, struct values *v);

#endif
