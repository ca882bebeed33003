/* A counter and a mask; whoever sets a limit says what happens at its end. */
#include "work.h"

#include <stdlib.h>

const char *const work_part_name[N_WORK_PARTS] = {
#define PART_TEXT(name, text) text,
    WORK_PARTS(PART_TEXT)
#undef PART_TEXT
};

const char *const work_ladder_name[N_WORK_LADDERS] = {
#define LADDER_TEXT(name, text) text,
    WORK_LADDERS(LADDER_TEXT)
#undef LADDER_TEXT
};

static _Thread_local struct {
  unsigned long long units, limit;
  unsigned touched;
  struct work_raises raises;
  void (*exhausted)(void);
} work;

void work_begin(unsigned long long limit, void (*exhausted)(void)) {
  work.units = 0;
  work.limit = limit;
  work.touched = 0;
  work.raises = (struct work_raises){{0}, {0}};
  work.exhausted = exhausted;
}

void work_add(unsigned long long units) {
  work.units += units;
  if (!work.limit || work.units <= work.limit) return;
  work.exhausted();
  abort();
}

void work_touch(enum work_part part) {
  work.touched |= 1U << part;
}

unsigned long long work_units(void) {
  return work.units;
}

unsigned work_touched(void) {
  return work.touched;
}

void work_precision_raise(enum work_ladder ladder, bool enough) {
  work.raises.tried[ladder]++;
  work.raises.enough[ladder] += enough;
}

struct work_raises work_raises(void) {
  return work.raises;
}
