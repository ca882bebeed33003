/* For how long a phase a condition holds throughout it, in closed form.

   In a phase in which one mass slips there is one frequency, and a margin is

     level + factor (even (1 - cos x) + odd sin x + drift (x - sin x)),

   x being the frequency times the time since the phase began, the time to its end or, of a condition at one of the
   switching times, the length of the phase.  With factor, even, odd, drift > 0 on the whole domain,

     even (1 - cos x) + odd sin x = 2 sin(x/2) (even sin(x/2) + odd cos(x/2)) is positive on (0, X) exactly if
       X <= 2 (pi - arctan(odd/even)); odd sin x exactly if X <= pi and odd > 0;
     its integral even (x - sin x) + odd (1 - cos x) rises up to there and has, with the period 2 pi, its crests at x =
       2 (k pi - arctan(odd/even)), k = 1, 2, ..., each even * 2 pi higher than the one before, of the height
       2 (even (k pi - arctan(odd/even)) + odd): its greatest value on [0, X] is that at X, and no other, exactly if
       X - 2 k pi <= 2 (pi - arctan(odd/even)) for k = floor(X/(2 pi)) and it is higher there than at the crest before;
     even (1 - cos x) + drift (x - sin x) is positive for every x > 0, so that with a level the margin is positive on
       (0, X) exactly if level >= 0. */
#ifndef STICKSLIP_EXACT_RANGE_H
#define STICKSLIP_EXACT_RANGE_H

#include "condition.h"
#include "num/calc.h"

enum range_part { RANGE_FREQUENCY, RANGE_FACTOR, RANGE_EVEN, RANGE_ODD, RANGE_DRIFT, N_RANGE_PARTS };

struct range_form {
  const struct tape *parts;        /* in their order; what else it gives is not read */
  bool there[N_RANGE_PARTS];       /* else 1, of frequency and factor, or 0 */
  const struct condition *premise; /* or NULL: the level or, with odd and without even, odd is its margin times
                                             what is positive on the whole domain */
  bool from_end;                   /* x counts the time to the end of the phase */
  bool rate;                       /* the form, with odd, is that of minus the margin's rate, and the margin is
                                             zero where the phase ends: the integral must be greatest at X */
};

/* factor (even (1 - cos x) + odd sin x + drift (x - sin x)): the form without its level. */
val range_swing(struct calc *c, const val part[N_RANGE_PARTS], val x, val sine, val cosine);

/* Is the margin of that form, or (scaled) what is positive on the whole domain times it, on every motion of the phase
   that begins and ends with its events, and have the parts their signs, so that the range is as said above? */
bool exact_range(bool *scaled, const struct condition *goal, const struct range_form *form);

#endif
