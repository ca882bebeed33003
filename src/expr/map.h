/* Something for each of many nodes, by their addresses. */
#ifndef STICKSLIP_EXPR_MAP_H
#define STICKSLIP_EXPR_MAP_H

#include "expr.h"

struct expr_slot {
  const struct expr *node;
  union {
    const struct expr *result;
    long at;
    double number;
  };
};
/* {0} at first. */
struct expr_map {
  struct expr_slot *slot;
  size_t n, size;
};
void expr_map_clear(struct expr_map *m);
/* What is kept for the node; NULL: nothing.  It stands there until something else is put. */
struct expr_slot *expr_map_find(const struct expr_map *m, const struct expr *node);
/* A place for a node that has none. */
struct expr_slot *expr_map_put(struct expr_map *m, const struct expr *node);

#endif
