/* A second opinion: the model once more, in long double.  The equations of motion (1) as a first-order system, its
   exponential by a Taylor series, events by Newton's method, derivatives by differences. */
#ifndef STICKSLIP_TESTS_PLAIN_H
#define STICKSLIP_TESTS_PLAIN_H

#include "value/point.h"

typedef long double real;

struct plain {
  real chi, eta, v, e1, e2;
};
struct plain plain_of(const struct point *p);
real real_of(const fmpq_t q);

/* (1) with z measured from the equilibrium; a mass that sticks keeps its velocity. */
void plain_system(real a[16], const struct plain *p, int ph);
/* Of an m x n and an n x p matrix; any of them may be z. */
void plain_product(real *z, const real *x, const real *y, int m, int n, int p);
/* exp(A t), and what it makes of a state. */
void plain_propagator(real phi[16], const struct plain *p, int ph, real t);
void plain_flow(real out[4], const struct plain *p, int ph, const real z[4], real t);

/* What is zero where a phase ends. */
real plain_switching(const struct plain *p, int ph, const real z[4]);
/* z to the end of its phase, near time t, which is returned. */
real plain_end(real z[4], const struct plain *p, int ph, real t);
/* The derivative of the map from z to the end of phases from..to (each near its time in t) along dz. */
void plain_derivative(real out[4], const struct plain *p, int from, int to, const real z[4], const real dz[4],
                      const real t[4]);

#endif
