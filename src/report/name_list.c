/* A list is short enough to be searched from its beginning. */
#include "name_list.h"

#include "base/arena.h"
#include "base/text.h"

void names_add(struct names *list, const char *name) {
  *SS_PUSH(list->name, list->n, list->cap) = name;
}

size_t names_index(struct names *list, const char *name) {
  size_t i = (size_t)word_find(name, list->name, (int)list->n);
  if (i == list->n) names_add(list, name);
  return i;
}
