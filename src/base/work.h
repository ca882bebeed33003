/* What a computation has cost so far, in units that no machine changes, and which parts of the program it has touched.

   One unit is about one arithmetic operation on balls of 128 bits: a node of a tape evaluated at p bits counts p/128
   (one at least), exact algebra a unit for each product of two terms, an event that is looked for, an orbit that is
   searched and a step of an integrator what measurement makes of them.  Counts belong to the thread. */
#ifndef STICKSLIP_BASE_WORK_H
#define STICKSLIP_BASE_WORK_H

#include <stdbool.h>

/* Parts whose use is noted: what a report may have to say was left out. */
#define WORK_PARTS(X)                                                                                                  \
  X(PHASE_D, "phase D")                                                                                                \
  X(PHASE_GAMMA, "phase Gamma")                                                                                        \
  X(PHASE_H, "phase H")                                                                                                \
  X(PHASE_C, "phase C")                                                                                                \
  X(SCENE_ORBITS, "the scene's periodic orbits")                                                                       \
  X(OTHER_ORBITS, "periodic orbits at other parameters")                                                               \
  X(ORBIT_POOL, "orbits drawn all over the parameter space")                                                           \
  X(SIMULATION, "motions under Coulomb's law")                                                                         \
  X(ALGEBRA, "proofs by exact algebra")                                                                                \
  X(BITS_128, "balls of 128 bits")                                                                                     \
  X(BITS_256, "balls of 256 bits")                                                                                     \
  X(BITS_512, "balls of 512 bits")                                                                                     \
  X(BITS_1024, "balls of 1024 bits")

enum work_part {
#define WORK_PART(name, text) WORK_##name,
  WORK_PARTS(WORK_PART)
#undef WORK_PART
      N_WORK_PARTS
};
extern const char *const work_part_name[N_WORK_PARTS];

/* What is tried in balls at a first precision, which is raised where that is not enough. */
#define WORK_LADDERS(X)                                                                                                \
  X(SIDES, "two sides at a point")                                                                                     \
  X(INEQUALITY, "an inequality at the scene's own numbers")                                                            \
  X(NUMBER, "the quantity of a printed number")                                                                        \
  X(RESULT, "a derived result with and without a fault")                                                               \
  X(VALUE, "a value asked for")

enum work_ladder {
#define WORK_LADDER(name, text) LADDER_##name,
  WORK_LADDERS(WORK_LADDER)
#undef WORK_LADDER
      N_WORK_LADDERS
};
extern const char *const work_ladder_name[N_WORK_LADDERS];

/* How often something was tried, and how often the first precision was enough. */
struct work_raises {
  long tried[N_WORK_LADDERS], enough[N_WORK_LADDERS];
};

/* From here on counts begin at zero and nothing is noted.  When limit, unless 0, is passed, exhausted is called; it
   must not return. */
void work_begin(unsigned long long limit, void (*exhausted)(void));
void work_add(unsigned long long units);
/* Steps that only odd parameters cause are counted where they arise, in whole blocks of this many, so that the last
   digits of a walk change no count at ordinary ones: there a search or a proof is counted once, by whoever asks for
   it. */
enum { WORK_BLOCK = 4096 };
void work_touch(enum work_part part);
unsigned long long work_units(void);
/* A bit for each part touched. */
unsigned work_touched(void);
void work_precision_raise(enum work_ladder ladder, bool enough);
struct work_raises work_raises(void);

#endif
