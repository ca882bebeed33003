/* The first working precision, planned from the condition of what is asked for.

   Evaluated at p bits an entry keeps p less the logarithm of its condition: how much more than one rounding the
   roundings of all nodes, and those of what the inputs come from, do to it (digits_amplification, from the adjoints of
   the tape).  It hardly depends on the precision, so a pilot of one machine word tells.  Precision decides where one
   starts and nothing else: what is not known well enough then is evaluated again with more bits. */
#ifndef STICKSLIP_STABILITY_PRECISION_H
#define STICKSLIP_STABILITY_PRECISION_H

#include "tape/tape.h"
#include "value/point.h"

/* The working precision at which every output of the tape should be known to so many bits, rounded as precision_round
   does; `otherwise` where no pilot tells. */
slong precision_planned(const struct tape *t, const struct point *p, slong bits, slong otherwise,
                        struct orbit_cache *cache);
/* Up to a multiple of 64, and of more than a sixteenth of it: words are paid for whole, and quantities asked for
   together share the orbits that were found at one precision. */
slong precision_round(slong prec);

#endif
