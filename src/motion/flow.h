/* The closed form of each phase over any number type: its flow as four 2x2 blocks, the frequencies of phase H, and the
   switching function that ends the phase. */
#ifndef STICKSLIP_FLOW_H
#define STICKSLIP_FLOW_H

#include "dynamics.h"
#include "num/calc.h"

/* z(t) = c z + s z', z'(t) = n z + c z' (2x2, row-major). */
struct blocks {
  val c[4], s[4], n[4];
};
/* Phase H: matrix functions of K = [1, -chi; -chi eta, chi eta] are
   f(K) = [above f1 + below f2, chi (f1 - f2); chi eta (f1 - f2), below f1 + above f2] / gap,
   f1 and f2 at the squares of the frequencies om[0] < om[1], which lie gap apart. */
struct spectrum {
  val om[2], above, below, couple, back; /* the last four divided by the gap; couple = chi, back = chi eta */
  val gap;
};
/* The one statement of the frequencies for every number type; slip.h and polish.h need one without branches for lanes
   of vectors, and check_dynamics.c compares all three.  Of p, chi and eta alone are read. */
struct spectrum flow_spectrum(struct calc *c, const val p[N_PARAMS]);
/* Those of phase H. */
void flow_blocks_h(struct blocks *b, struct calc *c, const struct spectrum *s, val t);
struct blocks flow_blocks(struct calc *c, enum phase ph, const val p[N_PARAMS], val t);
void flow_apply(val out[N_STATE], struct calc *c, const struct blocks *b, const val in[N_STATE]);
/* An entry of the 4x4 matrix that the blocks are. */
val flow_entry(const struct blocks *b, int i, int j);
/* The restoring forces w = z_1 - chi z_2 of m1 and chi r = chi (z_2 - z_1) of m2 at two positions; at two velocities
   their rates. */
val flow_force(struct calc *c, int mass, val chi, const val z[2]);
/* Z' at the state z; NULL where it is zero for all states. */
void flow_field(val f[N_STATE], struct calc *c, enum phase ph, const val p[N_PARAMS], const val z[N_STATE]);
/* A switching function; its gradient, which is constant, applied to v; and its rate. */
val flow_switching_along(struct calc *c, enum phase ph, val chi, const val v[N_STATE]);
val flow_switching(struct calc *c, enum phase ph, const val p[N_PARAMS], const val z[N_STATE]);
val flow_switching_rate(struct calc *c, enum phase ph, const val p[N_PARAMS], const val z[N_STATE]);
/* Pointers to the elements of a vector from the given index on. */
static inline void flow_vals(val *out, const struct num_vec *v, slong from, slong n) {
  for (slong i = 0; i < n; i++) out[i] = num_vec_at(v, from + i);
}

#endif
