/* Periodic orbits all over the parameter space, drawn once for every claim that searches among them: at exact chi, eta,
   V, t_b, t_c there are at most two, in closed form, so that thousands of draws cost little. */
#ifndef STICKSLIP_ORBIT_POOL_H
#define STICKSLIP_ORBIT_POOL_H

#include <stdint.h>

#include "claim/judging.h"
#include "point.h"

/* What a draw fixes, in this order. */
enum { DRAW_CHI, DRAW_ETA, DRAW_V, DRAW_TB, DRAW_TC, N_DRAW };

struct pool_item {
  fmpq q[N_DRAW];
  struct dyn_orbits list; /* not empty */
};
struct orbit_pool {
  struct pool_item **item;
  size_t n, cap, few; /* few: of the first draws */
  long draws;
  uint64_t state; /* of the generator of draws */
};

/* The pool of the judge's cache, drawn when first asked for.  Its first items for EFFORT_REFUTE, whatever has been
   drawn already, so that no answer depends on what was asked before. */
struct orbit_pool orbit_pool_get(struct judge *j);
void orbit_pool_free(struct orbit_pool *p);

/* One draw with the orbits it has, which may be none. */
void pool_item_init(struct pool_item *item, const fmpq q[N_DRAW]);
void pool_item_clear(struct pool_item *item);
/* The draw as a point, its orbit `index` at hand. */
void pool_point(struct point *p, const struct pool_item *item, slong index);

#endif
