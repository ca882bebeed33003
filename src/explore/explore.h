/* What is asked of the model beyond one scene's orbit: other words, other parameters, other starts.  It stands on the
   rooms motion and mech.  Where to look:

     phase words      words (reading, which phase can follow), words_search and words_seeds (where orbits may be),
                      words_equations, words_orbits (the list, proved by the engine of the room mech)
     many points      batch (orbits in lanes of vectors, from guesses), family (the orbits along a line of parameters:
                      family_axis, family_member, family_level)
     one orbit moved  tube (over a box of parameters), curve and trace (along a line), bifurcate (where it changes), box
                      (every orbit of a box)
     other starts     basin (what an orbit attracts) */
#ifndef STICKSLIP_EXPLORE_H
#define STICKSLIP_EXPLORE_H

#include "motion/motion.h"

#endif
