/* The two masses under Coulomb's law (1)-(2), in double precision and the coordinates x: nothing here knows z, phases
   or periodicity.

   Away from the belt's velocity V the friction on mass i is u_si against its motion relative to the belt.  At x_i' = V
   it sticks while the restoring force is at most u_ri, and slips beyond.  Simultaneous events and contacts that only
   touch are resolved by the law itself; there is no cool-down.  A speed or force within rounding of its limit is at
   it. */
#ifndef SS_SIMULATE_H
#define SS_SIMULATE_H

#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

enum ss_mode { SS_STICK, SS_BELOW, SS_ABOVE }; /* with the belt; slower; faster */

/* One moment; at an event modes and friction are those just after it. */
typedef struct ss_moment {
  double t, x[2], v[2], u[2]; /* time, positions, velocities, friction forces */
  enum ss_mode mode[2];
} ss_moment;
/* One mass changes its mode.  Changes at one instant come one after the other, with the same moment. */
typedef struct ss_event {
  ss_moment at;
  int mass; /* 0 or 1 */
  enum ss_mode from, to;
  int simultaneous; /* 1: the other mass changes too */
  int grazing;      /* 1: the speed touched V, or crossed it so flatly that rounding decides */
} ss_event;
/* Told of events and samples; both are valid during the call alone.  0 ends the simulation. */
typedef int (*ss_on_event)(void *self, const ss_event *e);
typedef int (*ss_on_sample)(void *self, const ss_moment *m);

/* Parameters and a start. */
typedef struct ss_motion ss_motion;
/* On orbit k of the scene, from 0 in ss_orbits_find's order, where both masses come to stick.  Where the scene gives no
   u_ri, it is 5/4 of the larger of e_i and what the orbit needs (ss_motion_friction_is_own).  SS_INPUT: there is no
   such orbit. */
SS_API int ss_motion_on_orbit(ss_motion **out, const ss_scene *s, size_t k);
/* From the numbers z10, z20 that the scene prints, both velocities V. */
SS_API int ss_motion_printed(ss_motion **out, const ss_scene *s);
/* From x_1, x_2, x_1', x_2' of one's own, finite and at most 1e100. */
SS_API int ss_motion_from(ss_motion **out, const ss_scene *s, const double start[4]);
SS_API void ss_motion_free(ss_motion *m);
/* chi, eta, V, u_s1, u_s2, u_r1, u_r2. */
SS_API int ss_motion_parameters(double params[7], const ss_motion *m);
SS_API int ss_motion_start(double start[4], const ss_motion *m);
/* 1 when some u_ri is not the scene's. */
SS_API int ss_motion_friction_is_own(const ss_motion *m);
/* Of the orbit; from elsewhere of the scene's first orbit, and 0 when it has none. */
SS_API double ss_motion_period(const ss_motion *m);

enum ss_route {
  SS_INTEGRATED, /* Runge-Kutta-Prince-Dormand 8(7) of GSL, events by bounded steps; knows no closed form */
  SS_CLOSED      /* closed forms in each mode, first events searched without stepping over any */
};
/* Runs from the start until the duration is reached, or the masses have come to stick both so many times (returns; 0:
   any number), whichever is first; one of them must be given (duration may be infinite, returns 0).  sample: the
   distance of samples, at 0, sample, 2 sample, ...; 0: none.  Functions may be NULL; without moment no sample is taken.
   end (or NULL) is the last moment.  Measured on the paper's orbit over 200 periods: events within 1e-11 of
   multiprecision, by either route, in about 10 ms.  SS_ARGUMENT: a motion without end, and what is negative or NaN.
   SS_STOPPED: a function said so.  SS_UNABLE: 10^6 events, 10^7 samples or 10^7 steps, no event will ever come, the
   integrator gave up, or u_ri and u_si are nearer to each other than the rounding of the state; ss_error() says which,
   and the moment is valid.  SS_DOMAIN: parameters that cannot be simulated. */
SS_API int ss_motion_run(ss_moment *end, const ss_motion *m, int route, double duration, long returns, double sample,
                         ss_on_event event, ss_on_sample moment, void *self);

#ifdef __cplusplus
}
#endif

#endif
