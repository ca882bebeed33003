/* The checks of claims of kind behaviour, a row for each.

     by law    whether (1) and (2) as the paper states them are read for it: the claims of kind law, one for each mass,
               are then among those of depends-on
     of scene  whether it is about the numbers of one scene
     says      what it tries, which is the claim's title (value/title.h); slip to stick, where there is a transition

   The function of a row, behaviour_NAME, is one of judge/behaviour.h. */
#ifndef STICKSLIP_CHECKS_H
#define STICKSLIP_CHECKS_H

#include "claims.h"

/* C(name, word in files, by law, of scene, says) */
#define BEHAVIOUR_CHECKS(C)                                                                                            \
  C(modes, "modes", true, false,                                                                                       \
    "every motion is a sequence of phases in which each mass sticks or slips, finitely many in a bounded time")        \
  C(closed_forms, "closed-forms", true, false,                                                                         \
    "every motion is given, in each of its phases, by the closed forms of (3), (4), (6), (8) and (10)")                \
  C(dimension, "dimension", false, false, "the phase space has {range} dimensions, depending on the phase")            \
  C(linear, "linear", true, false,                                                                                     \
    "within each configuration the equations of motion are linear, with constant coefficients")                        \
  C(switches, "switches", true, false,                                                                                 \
    "a transition from {transition} occurs where a mass reaches the belt's velocity and the force on it is smaller "   \
    "than its {limit} friction")                                                                                       \
  C(jumps, "jumps", true, false,                                                                                       \
    "friction and acceleration of a mass are discontinuous where it breaks loose or is caught, unless the force "      \
    "on it is the sliding friction, and position and velocity never are")                                              \
  C(small, "small", true, false,                                                                                       \
    "after a small change of the positions in the global stick phase both masses still stick")                         \
  C(fixed_points, "fixed-points", true, false,                                                                         \
    "the start of an admissible orbit is a fixed point of the map from one period to the next under Coulomb's law")    \
  C(linearization, "linearization", true, false,                                                                       \
    "linearizing within the phases alone, without regard to the switches, gives wrong results about stability")        \
  C(equality, "equality", false, false, "admissible periodic solutions are unstable unless {criterion}")               \
  C(perturb, "perturb", true, false,                                                                                   \
    "of the motions that result from arbitrarily small perturbations of a stable orbit some stay near it and others "  \
    "do not")                                                                                                          \
  C(long_run, "long-run", false, true, "what becomes of the printed initial state over many returns")                  \
  C(patching, "patching", false, false,                                                                                \
    "periodic motions of chains of more than two masses can be patched from the solutions of their phases")

struct behaviour_check {
  const char *word;
  bool by_law, of_scene;
  const char *says;
};
extern const struct behaviour_check behaviour_checks[];
/* NULL: its file names none that there is. */
const struct behaviour_check *claim_check(const struct claim *c);

#endif
