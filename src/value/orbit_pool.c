/* The draws of orbit_pool.h: t_b and t_c up to 10, so that the motion of m_1 against a sticking m_2 (period 2 pi) is
   met before and after its first return towards the belt. */
#include "orbit_pool.h"

#include <stdlib.h>

#include "base/arena.h"
#include "base/work.h"
#include "claim/kinds.h"
#include "motion/given.h"

void pool_item_init(struct pool_item *item, const fmpq q[N_DRAW]) {
  static const enum dyn_quantity which[2] = {QUANTITY_TB, QUANTITY_TC};
  for (int i = 0; i < N_DRAW; i++) {
    fmpq_init(&item->q[i]);
    fmpq_set(&item->q[i], &q[i]);
  }
  dyn_orbits_given(&item->list, item->q, which, item->q + DRAW_TB, 64, NULL);
}

void pool_item_clear(struct pool_item *item) {
  for (int i = 0; i < N_DRAW; i++) fmpq_clear(&item->q[i]);
  dyn_orbits_clear(&item->list);
}

void pool_point(struct point *p, const struct pool_item *item, slong index) {
  static const int where[N_DRAW] = {Q_CHI, Q_ETA, Q_V, Q_TB, Q_TC};
  p->kind = POINT_GIVEN;
  p->orbit = index;
  p->known = &item->list.orbit[index];
  for (int i = 0; i < N_DRAW; i++) fmpq_set(&p->q[where[i]], &item->q[i]);
}

static void draw(fmpq q[N_DRAW], uint64_t *state) {
  static const struct {
    slong lo, hi;
    ulong den;
  } range[N_DRAW] = {{1, 63, 64}, {2, 128, 16}, {1, 12, 4}, {1, 640, 64}, {1, 640, 64}};
  for (int i = 0; i < N_DRAW; i++) {
    uint64_t span = (uint64_t)(range[i].hi - range[i].lo + 1);
    *state = *state * 6364136223846793005U + 1442695040888963407U;
    fmpq_set_si(&q[i], range[i].lo + (slong)((*state >> 33) % span), range[i].den);
  }
}

/* Draws on until that many draws are made. */
static void draw_up_to(struct orbit_pool *p, long draws) {
  enum { UNITS_OF_DRAW = 200 };
  FMPQ_VECTOR(q, N_DRAW);
  for (; p->draws < draws; p->draws++) {
    struct pool_item one;
    work_add(UNITS_OF_DRAW);
    draw(q, &p->state);
    pool_item_init(&one, q);
    if (one.list.n == 0) {
      pool_item_clear(&one);
      continue;
    }
    p->item = ss_grow(p->item, p->n, &p->cap, sizeof *p->item);
    p->item[p->n] = ss_malloc(sizeof one);
    *p->item[p->n++] = one;
  }
}

struct orbit_pool orbit_pool_get(struct judge *j) {
  enum { DRAWS = 6000, FEW = 600 };
  work_touch(WORK_ORBIT_POOL);
  struct orbit_pool **pool = orbit_cache_pool(j->cache);
  if (!*pool) {
    *pool = ss_malloc(sizeof **pool);
    **pool = (struct orbit_pool){.state = 1};
    draw_up_to(*pool, FEW);
    (*pool)->few = (*pool)->n;
  }
  if (j->effort != EFFORT_REFUTE) draw_up_to(*pool, DRAWS);
  struct orbit_pool seen = **pool;
  if (j->effort == EFFORT_REFUTE) seen.n = seen.few;
  return seen;
}

void orbit_pool_free(struct orbit_pool *p) {
  for (size_t i = 0; p && i < p->n; i++) {
    pool_item_clear(p->item[i]);
    free(p->item[i]);
  }
  if (p) free(p->item);
  free(p);
}
