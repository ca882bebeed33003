/* A list is short enough to be searched from its beginning. */
#include "names.h"

#include <string.h>

#include "base/arena.h"

void names_add(struct names *list, const char *name) {
  list->name = ss_grow(list->name, list->n, &list->cap, sizeof *list->name);
  list->name[list->n++] = name;
}

size_t names_index(struct names *list, const char *name) {
  for (size_t i = 0; i < list->n; i++)
    if (strcmp(list->name[i], name) == 0) return i;
  names_add(list, name);
  return list->n - 1;
}
