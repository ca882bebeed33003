/* How many full periods of phase Gamma can precede a strip's t_b, and strips that no time of phase H brings to a
   zero. */
#ifndef STICKSLIP_TURNS_H
#define STICKSLIP_TURNS_H

#include "strip.h"

/* Which k can be, for each sign of r at the end of phase C: index 1 for r > 0, 0 for r < 0 (zero belongs to both). */
struct turns {
  double from[2], to[2];
};
/* The k for which the energy of phase H suffices; empty ranges when there is none.  later: t_b need not be a first
   root, and r_end is of either sign whatever that of q. */
struct turns strip_turns(const struct strip *p, bool later);
/* r at the stick phase for k = 0, over the whole strip. */
struct disk strip_base(const struct strip *p);
/* The k for which r at the stick phase, base - k turn, is r_end: |r_end| in radius, its signs as told. */
struct turns turns_of(const struct turns *within, const struct disk_params *s, struct disk base, struct disk radius,
                      bool negative, bool positive);
double turns_count(const struct turns *k);
/* No zero for any time, since even two phases that run freely would not meet the equations. */
bool strip_misses(const struct strip *p, const struct turns *k);

#endif
