/* The orbits along a line of parameter values, in double precision: continuation between searches.

   One of chi, eta, V, e1, e2 takes n values from one end to the other, both included, equally spaced and exact before
   they are rounded; the scene, which gives e1 and e2, has the others.  At anchors, every so many points, every orbit is
   searched for; between them each is followed, and a stretch on which one cannot be followed (a fold, a grazing event)
   is searched inside.  What can be missing: an orbit that the fast search misses, and one that begins and ends between
   two anchors. */
#ifndef SS_SWEEP_H
#define SS_SWEEP_H

#include "map.h"
#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One orbit at one value, or that there is none there. */
typedef struct ss_swept {
  size_t point;  /* which value, from 0 */
  double x;      /* the value */
  size_t orbits; /* how many orbits there are at it; 0: one row that tells so, its outputs NaN */
  size_t orbit;  /* which of them, by increasing z10 */
  double out[SS_OUTPUTS];
  unsigned violations, unsure; /* bits of enum ss_condition, decided in balls where double precision cannot */
  enum ss_truth stable;        /* |tr J| < 1 */
  enum ss_truth admissible;    /* no condition broken, none unsure */
  const char *status;          /* of the point: "ok", or a word for what is open there; static */
} ss_swept;
/* Valid during the call; 0 ends the sweep. */
typedef int (*ss_on_orbit)(void *self, const ss_swept *row);

/* Tells f of every orbit at every value in order.  from, to: constant expressions, "0.8", "4/5".  n: 1 (then from = to)
   to 10^9. every: points from one anchor to the next, 1 to 65536, or 0 for the usual.  About two microseconds a point.
   SS_ARGUMENT: no such parameter, n or every out of range.  SS_INPUT: an end cannot be read or lies outside the domain.
   SS_STOPPED: f said so. */
SS_API int ss_sweep(const ss_scene *s, const char *parameter, const char *from, const char *to, size_t n, size_t every,
                    ss_on_orbit f, void *self);

#ifdef __cplusplus
}
#endif

#endif
