/* Central differences in double precision, with an honest bound of their error. */
#ifndef STICKSLIP_DIFFERENCES_H
#define STICKSLIP_DIFFERENCES_H

#include "dynamics.h"

enum { DIFFERENCES_MOST = 50 };
/* A map of n_in to n_out doubles, at most DIFFERENCES_MOST, smooth but for its noise. */
struct double_map {
  int (*run)(double *out, const double *x, const void *self);
  const void *self;
  int n_in, n_out;
  double scale;  /* of the arguments; the longest step is a part of it */
  double floor;  /* the error of a value, relative to it and to the scale, is taken to be this at least */
  double jitter; /* and this, absolute */
};
/* The derivative along dir at x, extrapolated from central differences, and a bound of its worst component's error,
   from the change between steps and the measured noise.  The status of the map where it has no value nearby. */
int differences_along(double *out, double *err, const struct double_map *map, const double *x, const double *dir);
/* The same along n_dir directions, n_out numbers and an error for each; from here on err may be NULL. */
int differences_along_all(double *out, double *err, const struct double_map *map, const double *x,
                          const double (*dir)[N_STATE], int n_dir);
/* The derivative of two results by the first two arguments, and the worst error. */
int differences_jacobian(double j[4], double *err, const struct double_map *map, const double *x);

#endif
