/* Lanes: what the kernels of batch.c read and write, and the choice of one for tests. */
#ifndef STICKSLIP_BATCH_IMPL_H
#define STICKSLIP_BATCH_IMPL_H

#include "batch.h"

enum { LANES = 16 };
struct lanes {
  double params[N_PARAMS][LANES], guess[2][LANES], out[N_DYN_OUT][LANES];
  double broken[LANES], status[LANES]; /* integers */
  double parts[LANES];                 /* in which phase H is to be looked at, about; 0: no more to be done */
};
/* A look at phase H in parts of time h: the state at the end of the last part, and what was seen up to there. */
struct march {
  double chi[LANES], a[LANES], stiff[LANES], om[2][LANES], sigma[2][LANES], amount[2][LANES], other[2][LANES];
  double pull_b[LANES], start_p[LANES], start_w[LANES], parts[LANES], h[LANES], by_s[2][LANES], by_c[2][LANES],
      at_s[2][LANES], at_c[2][LANES];
  double p[LANES], q[LANES], w[LANES], pull[LANES];
  double below[LANES], slow[LANES], above[LANES]; /* 1, or 0: z_1' < V, z_2' < V; how often z_2' > V was seen */
};

/* An instruction set that kernels exist for here; NULL after the last. */
const char *batch_set_name(int set);
/* Whether this machine has it. */
bool batch_set_here(int set);
/* All calls use it from now on; -1: the widest that the machine has.  Not while another thread is in
   dyn_orbits_batch. */
void batch_set_use(int set);

#endif
