/* A number that is known by an enclosure: a ball, midpoint and radius, in which its exact value lies, proved; or an
   exact rational, where a scene gives it.

   Numbers are parts of the handles they come from (orbits, Jacobians, ...), and live as long.  NULL stands for a number
   that there is not, and every function here takes it. */
#ifndef SS_NUMBER_H
#define SS_NUMBER_H

#include <mpfr.h>

#include "status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ss_number ss_number;

/* Its significant decimal digits, 1 to 100000, rounded to nearest, only if every point of the ball rounds to them:
   "2.7844", "1.07e-9" (plain where the exponent is from -6 to max(digits, 21) - 1); trailing zeros are kept, an exact
   zero is "0". SS_UNABLE when so many are not known; ss_number_digits says how many are. */
SS_API int ss_number_text(char **out, const ss_number *x, size_t digits);
/* The most digits, up to 100000, that ss_number_text gives; 0 when it gives none: the ball contains zero, or no digit
   is sure. */
SS_API size_t ss_number_digits(const ss_number *x);
/* The midpoint, or the rational number, rounded to nearest; NaN for NULL, infinite beyond the doubles. */
SS_API double ss_number_double(const ss_number *x);
/* The same rounded to nearest at the precision of out, which the caller has initialised: off by at most the radius and
   half a unit in the last place. */
SS_API int ss_number_mpfr(mpfr_t out, const ss_number *x);
/* An upper bound of the radius: 0 for an exact number, else at least 2^-1000; infinite when nothing is known, and for
   NULL. */
SS_API double ss_number_radius(const ss_number *x);

#ifdef __cplusplus
}
#endif

#endif
