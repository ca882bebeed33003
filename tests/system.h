/* The parts of system files, as lines of text, and words of their phases. */
#ifndef STICKSLIP_TESTS_SYSTEM_H
#define STICKSLIP_TESTS_SYSTEM_H

#include <check.h>

#include "mech/mech.h"

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

#endif
