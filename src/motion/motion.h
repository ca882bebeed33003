/* The suite's own model: the motion between events, its events, the periodic orbits, and proofs about them.  The
   contract is dynamics.h and the header of each noun below; everything is derived from (1) and Coulomb's law (2), and
   no file here reads a formula of the paper.  Where to look:

     a phase              flow (closed form), propagator (matrix exponential), event (where it ends), trig_sum (first
                          roots)
     a pass of the word   arc (phase by phase), map (all at once), arc_search (from the start alone), differences,
                          jacobian, saltation, jacobian_ode (its derivatives, four ways), eigenvalues
     the return map of r  return_map (a double, by slip and polish), return_map_double (for searches), return_near,
                          return_jet (balls, series)
     periodic orbits      search (candidates), orbit (found and enclosed), orbit_judge (what is known of one), warm
                          (from a guess), map_balls (the two equations in (t_b, t_c)), certify, margins
     other given data     orbit_equations (the four equations), sheet, given_search, given; paper_route (the paper's
                          (44)-(46))
     complete lists       complete, march, strip, turns, cell; line, complete_given; branches (later roots)
     Coulomb's law        coulomb, mode_motion, simulate_exact, simulate_ode (two routes), coulomb_log, long_run
     numbers              rounded (right to the last bit), turn, disk, dual, double_double, sincos; gsl_errors

   Which formula stands where, and why more than once, is a table in docs/house.md.  The room knows base and num
   alone. */
#ifndef STICKSLIP_MOTION_H
#define STICKSLIP_MOTION_H

#include "dynamics.h"

#endif
