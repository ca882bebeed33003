/* Every periodic orbit of the word D-Gamma-H-C at a scene's parameters, to as many digits as wanted, with proofs.

   An orbit is a solution of the paper's six equations of periodicity with t_b, t_c, t_d the first positive roots of
   their own switching functions and t_a of any sign.  What else a motion must fulfil is its admissibility: t_a > 0
   (51), no mass faster than the belt and no force above its limit in any phase (54), (57), (59), and static friction
   above SS_U_R1_MIN and SS_U_R2_MIN where the scene gives u_r1, u_r2.  The multiplier is tr J: the slope of the return
   map of r = z_2 - z_1 (J has rank one). */
#ifndef SS_ORBIT_H
#define SS_ORBIT_H

#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ss_orbits ss_orbits;

/* The numbers of an orbit. */
enum ss_orbit_number {
  SS_Z10,      /* position z_1 where the global stick phase begins (z = x less the equilibrium while both slip) */
  SS_Z20,      /* position z_2 there */
  SS_T_A,      /* duration of the global stick phase, D */
  SS_T_B,      /* of the slip-stick phase, Gamma */
  SS_T_C,      /* of the global slip phase, H */
  SS_T_D,      /* of the stick-slip phase, C */
  SS_E1,       /* u_r1 - u_s1 */
  SS_E2,       /* u_r2 - u_s2 */
  SS_PERIOD,   /* t_a + t_b + t_c + t_d */
  SS_TRACE,    /* tr J, the multiplier */
  SS_U_R1_MIN, /* infimum of the static friction by (54), (57), (59) */
  SS_U_R2_MIN,
  SS_ORBIT_NUMBERS
};
/* "z10", "z20", "t_a", ...; NULL beyond. */
SS_API const char *ss_orbit_number_name(int number);

/* Every orbit, by increasing z10, each number known to at least so many significant digits (1 to 100000), each orbit
   proved as far as that is possible, and the list held against a search that proves itself complete.  Two milliseconds
   for fifty digits of the paper's orbits, a tenth of a second for ten thousand; up to two seconds more where
   completeness is hard to tell.  SS_OK with an empty list: there is none, or (ss_orbits_complete) none was found.
   SS_UNABLE: a number could not be had to so many digits.  SS_INPUT: the scene has an interval or names another
   word. */
SS_API int ss_orbits_find(ss_orbits **out, const ss_scene *s, size_t digits);
/* The one orbit near the times t_b, t_c, found by Newton's iteration and proved like the others; nothing is searched
   for and the list is not complete.  The scene gives e1 and e2.  SS_UNABLE: no orbit of the word is proved near
   there. */
SS_API int ss_orbits_near(ss_orbits **out, const ss_scene *s, double t_b, double t_c, size_t digits);
SS_API void ss_orbits_free(ss_orbits *o);

SS_API size_t ss_orbits_count(const ss_orbits *o);
/* 1 where it is proved that the word has no other orbit at these parameters, else 0.  Where the scene gives t_b and one
   of e1 and e2 that holds for t_c up to ss_orbits_reach, which is infinite otherwise (NaN: not complete). */
SS_API int ss_orbits_complete(const ss_orbits *o);
SS_API double ss_orbits_reach(const ss_orbits *o);
/* Why it is not proved complete, in words; NULL when it is. */
SS_API const char *ss_orbits_gap(const ss_orbits *o);

/* Of orbit k, 0 <= k < count: its number (enum ss_orbit_number). */
SS_API const ss_number *ss_orbit_number(const ss_orbits *o, size_t k, int number);
/* |tr J| < 1. */
SS_API enum ss_truth ss_orbit_stable(const ss_orbits *o, size_t k);
/* Every condition holds; where the scene leaves u_r1 or u_r2 open: for some static friction, above its bound. */
SS_API enum ss_truth ss_orbit_admissible(const ss_orbits *o, size_t k);
/* The i-th condition that it breaks: t_a (51); gamma_v1, h_v1, h_v2, c_v2: a mass faster than the belt in that phase;
   c_w, d_r, gamma_r: a force above its limit; u_r1, u_r2: too little static friction.  NULL from the number of them
   on. */
SS_API const char *ss_orbit_violation(const ss_orbits *o, size_t k, size_t i);
/* 1 when all is proved: that it exists and is alone in its enclosure, that each event is the first, each condition or
   its violation, and on which side of 1 |tr J| lies. */
SS_API int ss_orbit_certified(const ss_orbits *o, size_t k);
/* What of that is open, joined by ", "; "" when nothing is. */
SS_API int ss_orbit_open(char **out, const ss_orbits *o, size_t k);
/* The certificates of those that are certified, as the JSON that stickslip-checker verifies on its own, each of
   them, not that there is no other.  SS_UNABLE: none is. */
SS_API int ss_orbits_certificate(char **out, const ss_orbits *o);

#ifdef __cplusplus
}
#endif

#endif
