/* The complete search: strips marched through phase H until t_c lies behind them, so that every common zero is
   collected. complete.c says from that whether a list of orbits is complete. */
#ifndef STICKSLIP_MARCH_H
#define STICKSLIP_MARCH_H

#include "cell.h"

enum { MARCH_LEVELS = 64, MARCH_LOWEST = 44 }; /* of steps: 2^(index - MARCH_LOWEST) */

struct march {
  struct disk_params params;
  struct clock step[MARCH_LEVELS];
  int level;     /* the usual step */
  double period; /* after which phase H repeats itself; infinite where its frequencies are not in a simple ratio */
  struct known *known;
  size_t n_known;
  struct commons zeros;
  long cells, budget;
  bool spent;      /* the budget */
  bool stuck;      /* a cell could not be decided: a double zero, or one nearly so */
  bool crest;      /* t_b at the very crest of the rise could not be excluded */
  double where[2]; /* t_b and t_c of the first cell that was stuck */
};
/* Every common zero of p and H_k, k = 0, 1, ..., with 0 < t_b <= t* and t_c no later than the first root of p: in
   zeros, each once or twice, or among the known ones that were met; unless spent, stuck or crest says that something
   was left open.  false outside what double precision can hold. */
bool march_run(struct march *s, const fmpq *params, struct known *known, size_t n_known, long budget);
void march_clear(struct march *s);

#endif
