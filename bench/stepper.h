/* One adaptive step after the other of a smooth system of four equations, by an integrator that is named: those of GSL
   (rk8pd, bsimp, msbdf, ...) and, where it is installed, CVODE's BDF formulas ("cvode-bdf"). */
#ifndef STICKSLIP_BENCH_STEPPER_H
#define STICKSLIP_BENCH_STEPPER_H

enum { STEPPER_SIZE = 4 };

/* An autonomous system, and the error that a step may have: relative, and absolute for each component. */
struct stepper_system {
  void (*field)(double f[STEPPER_SIZE], const void *self, const double y[STEPPER_SIZE]);
  void (*jacobian)(double j[STEPPER_SIZE * STEPPER_SIZE], const void *self, const double y[STEPPER_SIZE]);
  const void *self;
  double relative, absolute[STEPPER_SIZE];
  double longest; /* step */
};

struct stepper;
/* NULL when there is no integrator of that name.  The system must outlive it. */
struct stepper *stepper_open(const char *name, const struct stepper_system *system);
void stepper_close(struct stepper *s);
/* From y on, at the time 0. */
int stepper_start(struct stepper *s, const double y[STEPPER_SIZE]);
/* One step: the time and the state at its end.  A status of status.h. */
int stepper_step(struct stepper *s, double *t, double y[STEPPER_SIZE]);

#endif
