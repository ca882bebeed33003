/* The orbits that tests/oracle knows (mpmath, matrix exponentials, two searches): sets of parameters, each with its
   orbits.  A file is read when it is first asked for. */
#ifndef STICKSLIP_TESTS_KNOWN_ORBITS_H
#define STICKSLIP_TESTS_KNOWN_ORBITS_H

#include "motion/dynamics.h"
#include "table.h"

/* How many there are in orbits.tsv, and the fields of an orbit's row there, most of them numbers to 60 digits. */
enum { KNOWN_SETS = 30, KNOWN_ORBITS = 60 };
enum {
  KNOWN_INDEX = 2,
  KNOWN_Z10,
  KNOWN_Z20,
  KNOWN_TA,
  KNOWN_TB,
  KNOWN_TC,
  KNOWN_TD,
  KNOWN_PERIOD,
  KNOWN_TRACE,
  KNOWN_U1,
  KNOWN_U2,
  KNOWN_ADMISSIBLE,
  KNOWN_VIOLATIONS
};

struct known_set {
  const char *name, *const *text; /* the parameters, as they stand there */
  fmpq *params;
  double value[N_PARAMS];
  int n; /* orbits, and their rows */
  char *(*orbit)[MOST_COLUMNS];
};
struct known_orbit {
  const struct known_set *set;
  char *const *field;
};

/* Of orbits.tsv, by place or by name. */
const struct known_set *known_set(int i);
const struct known_set *known_set_named(const char *name);
struct known_orbit known_orbit(int i);
struct known_orbit known_orbit_named(const char *set, int index);

/* A set of later.tsv, whose rows are t_a, t_b, t_c and t_d of solutions from the second field on. */
const struct known_set *later_set(int i);

#endif
