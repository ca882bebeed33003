/* Open addressing, never more than half full; the size is a power of two. */
#include "map.h"

#include <stdint.h>
#include <stdlib.h>

enum { FIRST_SIZE = 64 }; /* which malloc has at hand: most trees are small */

/* The node's, or the free one that would be its. */
static struct expr_slot *home(const struct expr_map *m, const struct expr *node) {
  size_t i = (size_t)(((uint64_t)(uintptr_t)node * UINT64_C(0x9E3779B97F4A7C15)) >> 20);
  while (m->slot[i & (m->size - 1)].node && m->slot[i & (m->size - 1)].node != node) i++;
  return &m->slot[i & (m->size - 1)];
}

static void grow(struct expr_map *m) {
  struct expr_map old = *m;
  m->size = old.size ? 2 * old.size : FIRST_SIZE;
  m->slot = ss_malloc(m->size * sizeof *m->slot);
  for (size_t i = 0; i < m->size; i++) m->slot[i].node = NULL;
  for (size_t i = 0; i < old.size; i++)
    if (old.slot[i].node) *home(m, old.slot[i].node) = old.slot[i];
  free(old.slot);
}

void expr_map_clear(struct expr_map *m) {
  free(m->slot);
}

struct expr_slot *expr_map_find(const struct expr_map *m, const struct expr *node) {
  struct expr_slot *s = m->size ? home(m, node) : NULL;
  return s && s->node ? s : NULL;
}

struct expr_slot *expr_map_put(struct expr_map *m, const struct expr *node) {
  if (2 * (m->n + 1) > m->size) grow(m);
  struct expr_slot *s = home(m, node);
  s->node = node;
  m->n++;
  return s;
}
