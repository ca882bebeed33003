/* A cell: a strip during a short stretch of phase H; what can be excluded there, what is proved there. */
#ifndef STICKSLIP_CELL_H
#define STICKSLIP_CELL_H

#include "turns.h"
#include "warm.h"

/* The motion at the middle of a cell. */
struct cell {
  const struct strip *strip;
  struct disk p, q, r, w, pf, qf, rf; /* f: derivatives by the angle */
  double early;                       /* half of its length in time */
  bool first;                         /* it starts with phase H */
  bool later;                         /* zeros are looked for that need not be first roots */
};
/* Of a strip that outlives it; neither first nor later, and its length is left to the caller. */
void cell_at(struct cell *c, const struct strip *p, const struct clock *t);

/* A common zero, proved to be the only one in the box of half widths room around at; it lies within near. */
struct common {
  double k, at[2], near[2], room[2]; /* pairs: angle, time */
};
enum look { LOOK_CLEAR, LOOK_ZERO, LOOK_OPEN };
/* Whether the cell is proved to hold no zero with any k; or exactly one, which *zero describes.  dir = 1 when p starts
   below zero, -1 when above.  Where the answer is open for one k and no zero was found for another, zero->k is that k,
   else -1.  Before a later root p may have any sign, and phase C may last any time, so that r at its end has any
   sign. */
enum look cell_look(struct common *zero, const struct cell *c, const struct turns *k, double dir);
/* Where its orbit is to be looked for. */
struct dyn_place common_place(const struct common *z, const struct disk_params *s);
/* A zero that is known already, and surely lies there. */
struct known {
  double k;
  struct disk at[2];
  bool met; /* by a proof that it and another one are all there is around */
};
/* The zero that an orbit is after k full periods of phase Gamma. */
struct known known_of(const struct dyn_orbit *o, double k);
/* Whether it lies where the other one is the only one. */
bool known_is(const struct known *o, const struct common *z);
/* Zeros that were met, each once. */
struct commons {
  struct common *at;
  size_t n, cap;
};
/* Adds one of a cell in that strip around the time t, unless it is there: the same zero, proved in two cells, lies near
   one in the room of the other. */
void commons_add(struct commons *list, struct common z, const struct strip *p, double t);
/* The part of the strip, from *low to *high relative to its midpoint, where dir p may still not be positive at the
   cell's middle; false when there is none. */
bool cell_waiting(double *low, double *high, const struct cell *c, double dir);
/* Where the wider side of an undecided cell is. */
bool cell_wide_in_angle(const struct cell *c);
/* At most two zeros with this k in the box of half widths (angle, time) around the cell's middle, which t is. */
bool cell_folds_once(const struct cell *c, const struct clock *t, double k, const double half[2]);

#endif
