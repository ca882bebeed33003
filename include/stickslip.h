/* All of the library: one header for each thing that one does with it.

     status.h     how functions answer; version; what a text returned costs
     number.h     an enclosed number: its digits, its double, its mpfr_t, its radius
     scene.h      parameters, from a file, from a text, changed line by line
     orbit.h      every periodic orbit of a scene, to N digits, with proofs
     map.h        the return map and the orbit near a guess in double precision, fast
     jacobian.h   the 2x2 Jacobian of one period, by six methods
     simulate.h   the motion under Coulomb's law, event by event
     sweep.h      the orbits along a line of parameter values
     words.h      other sequences of phases than the paper's
     bifurcate.h  where the orbits change along a line
     formula.h    a formula of the paper, evaluated and typeset
     audit.h      the paper's claims, judged

   Equations (1), (2), ... are the paper's.  As there, times are pure numbers, and positions, velocities and
   friction, divided by k_1 + k_2, are in one unit of length. */
#ifndef SS_STICKSLIP_H
#define SS_STICKSLIP_H

#include "stickslip/audit.h"
#include "stickslip/bifurcate.h"
#include "stickslip/formula.h"
#include "stickslip/jacobian.h"
#include "stickslip/map.h"
#include "stickslip/number.h"
#include "stickslip/orbit.h"
#include "stickslip/scene.h"
#include "stickslip/simulate.h"
#include "stickslip/status.h"
#include "stickslip/sweep.h"
#include "stickslip/words.h"

#endif
