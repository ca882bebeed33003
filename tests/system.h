/* The parts of system files, as lines of text, and words of their phases. */
#ifndef STICKSLIP_TESTS_SYSTEM_H
#define STICKSLIP_TESTS_SYSTEM_H

#include <check.h>

#include "local.h"
#include "mech/orbit.h"
#include "says.h"
#include "scratch.h"

#define FREE_MASS(name, inertia) "mass " name "\n  inertia: " inertia "\n"
#define MASS(name, inertia, sliding, most, surface)                                                                    \
  FREE_MASS(name, inertia) "  sliding: " sliding "\n  static: " most "\n  surface: " surface "\n"
#define SPRING(name, between, stiffness) "spring " name "\n  between: " between "\n  stiffness: " stiffness "\n"
#define DAMPER(name, between, constant)  "damper " name "\n  between: " between "\n  constant: " constant "\n"
#define LOAD(name, on, frequency, cosine)                                                                              \
  "load " name "\n  on: " on "\n  frequency: " frequency "\n  cosine: " cosine "\n"
#define STOP(name, of, place, restitution)                                                                             \
  "obstacle " name "\n  stops: " of "\n  " place "\n  restitution: " restitution "\n"

/* A word of a system; fails the test that gives none. */
static inline struct mech_word word_in(const struct mech *m, const char *letters) {
  struct mech_word w;
  size_t at;
  const char *why;
  ck_assert_msg(mech_word_parse(&w, &at, &why, letters, m), "%s at %zu: %s", letters, at, why);
  return w;
}

/* That of a text; that of verify/systems; to be cleared. */
static inline struct mech system_of(const char *text) {
  struct mech m;
  goes_well(mech_read(&m, source_of("a.system", text), NULL, false, &d));
  return m;
}

static inline struct mech system_on_file(const char *name) {
  struct mech m;
  goes_well(mech_load(&m, formatted("verify/systems/%s.system", name), &d));
  return m;
}

/* Its motion from there, over that duration with so many moments at most; to be cleared. */
#define PLAN(time, moments) ((struct mech_plan){.duration = (time), .most = (moments)})

static inline struct mech_motion simulated(int route, const struct mech *m, const double *start,
                                           const struct mech_plan *plan) {
  struct mech_motion z;
  ck_assert_int_eq(mech_simulate(&z, (enum mech_route)route, m, start, plan), SS_OK);
  return z;
}

/* The Jacobian of an orbit by saltation matrices, and by differences of the motions of either route, over which the
   equations of the words have no say: each is stated to within `most`, and holds the orbit's own. */
static inline void check_routes_to_jacobian(const struct mech *m, const struct mech_orbit *o,
                                            const double most[MECH_BESIDE_INTEGRATED + 1], const char *what) {
  SIZED(arb_mat, j, o->n_free, o->n_free);
  for (enum mech_derivative how = MECH_SALTATION; how <= MECH_BESIDE_INTEGRATED; how++) {
    ck_assert_int_eq(mech_jacobian(j, m, o, how, 128), SS_OK);
    for (int i = 0; i < o->n_free * o->n_free; i++) {
      double err = mag_get_d(arb_radref(j->entries + i));
      ck_assert_msg(err < most[how], "%s, route %d: error %g", what, (int)how, err);
      ck_assert_msg(arb_overlaps(j->entries + i, o->jacobian->entries + i),
                    "%s, route %d, entry %d: off by more than %g", what, (int)how, i, err);
    }
  }
}

#endif
