/* A motion along an orbit in one number type at one precision, and what has been asked of it: claims, conditions and
   routes ask for the same again and again. */
#ifndef STICKSLIP_VALUE_FOLLOWED_H
#define STICKSLIP_VALUE_FOLLOWED_H

#include "system_orbit.h"
#include "values.h"

struct followed {
  const struct dyn_orbit *orbit; /* its address alone does not tell it: another may lie there when it is gone */
  double start[2];
  int status;
  struct dyn_arc arc;
  struct num_vec phi; /* the matrix exponentials over the arc's four phases, 16 each; each made when first asked for */
  bool have_phi[N_PHASES];
  struct system_orbit *system; /* the orbit by the engine for any system; NULL: not asked for yet */
  struct moment {
    enum variant variant;
    enum phase phase;
    double near; /* the time, rounded: what is looked for first */
    struct num_vec tau, z, rate;
    int status;
  } * moment;
  size_t n, cap;
};

struct followed *followed_new(const struct dyn_orbit *o, const struct num_vec *params);
void followed_free(struct followed *f);
/* In balls, at exact parameters. */
const struct system_orbit *followed_system(struct followed *f, const fmpq params[N_PARAMS]);
bool followed_is(const struct followed *f, const struct dyn_orbit *o, struct num_ctx ctx);

#endif
