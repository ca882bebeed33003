/* Periodic motions with any sequence of phases.

   A phase is what each mass does: sticks, slips slower than the belt, or faster.

     m1 \ m2    sticks   slower   faster
     sticks     D        C        c
     slower     Gamma    H        X
     faster     gamma    x        h

   A word is a cyclic sequence of 1 to 12 of them, "D-Gamma-H-C" or "D Gamma H C" or "DGHC" (G and g for Gamma and
   gamma). */
#ifndef SS_WORDS_H
#define SS_WORDS_H

#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

enum ss_fate {
  SS_OPEN,        /* nothing is known against it */
  SS_IMPOSSIBLE,  /* a transition cannot happen */
  SS_COINCIDENCE, /* two masses change at once: no orbit but at exceptional parameters */
  SS_UNCLOSED,    /* proved: it cannot come back, a mass is never slower than the belt */
  SS_FAMILY       /* H alone: families of orbits, none isolated */
};
/* Whatever the parameters.  why (or NULL): the reason, "" for SS_OPEN. */
SS_API int ss_word_fate(enum ss_fate *fate, char **why, const char *word);
/* Tells f each word of at most `longest` phases (1 to 8) of single transitions that all can happen, each from one of
   its phases alone, shorter ones first, until it returns 0 (SS_STOPPED). */
SS_API int ss_word_each(int longest, int (*f)(void *self, const char *word), void *self);

typedef struct ss_word_orbits ss_word_orbits;
/* The orbits of a word at a scene that gives e1 and e2, by increasing period: from random starts under Coulomb's law
   and a grid, then enclosed to so many digits (1 to 1000) where their conditioning allows.  word: NULL for the scene's
   own.  None found is no proof that there is none.  A word in which a mass is faster than the belt needs u_r1 and
   u_r2.  SS_DOMAIN: the word's fate is another than SS_OPEN, and ss_error() says why.  Up to some seconds. */
SS_API int ss_word_orbits_find(ss_word_orbits **out, const ss_scene *s, const char *word, size_t digits);
SS_API void ss_word_orbits_free(ss_word_orbits *o);
SS_API size_t ss_word_orbits_count(const ss_word_orbits *o);
/* How many phases the word has; phase i, turned as its orbits are: "Gamma", NULL beyond. */
SS_API size_t ss_word_orbits_phases(const ss_word_orbits *o);
SS_API const char *ss_word_orbit_phase(const ss_word_orbits *o, size_t k, size_t i);
/* Orbit k: the duration of its phase i; a coordinate where phase i begins, 0 to 3: the positions x1, x2 and velocities
   v1, v2 of equations (1), without sliding friction where the scene does not give u_ri, so that x is then the paper's
   z; its period. */
SS_API const ss_number *ss_word_orbit_time(const ss_word_orbits *o, size_t k, size_t i);
SS_API const ss_number *ss_word_orbit_state(const ss_word_orbits *o, size_t k, size_t i, int coordinate);
SS_API const ss_number *ss_word_orbit_period(const ss_word_orbits *o, size_t k);
/* The Jacobian of the return to the beginning of phase 0 in the coordinates that are free there: its size, 1 to 3;
   which coordinates, "x1"; its entries. */
SS_API int ss_word_orbit_free_coordinates(const ss_word_orbits *o, size_t k);
SS_API const char *ss_word_orbit_free_coordinate(const ss_word_orbits *o, size_t k, int i);
SS_API const ss_number *ss_word_orbit_jacobian(const ss_word_orbits *o, size_t k, int row, int column);
/* Every eigenvalue below 1 in modulus; every condition of Coulomb's law along it; 1 when all about it is proved. */
SS_API enum ss_truth ss_word_orbit_stable(const ss_word_orbits *o, size_t k);
SS_API enum ss_truth ss_word_orbit_admissible(const ss_word_orbits *o, size_t k);
SS_API int ss_word_orbit_certified(const ss_word_orbits *o, size_t k);

#ifdef __cplusplus
}
#endif

#endif
