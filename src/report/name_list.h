/* Lists of names. */
#ifndef STICKSLIP_REPORT_NAME_LIST_H
#define STICKSLIP_REPORT_NAME_LIST_H

#include <stddef.h>

/* Names in the order in which they came. */
struct names {
  const char **name;
  size_t n, cap;
};
/* Adds the name; the list holds the pointer, and its own name is to be freed. */
void names_add(struct names *list, const char *name);
/* The place of the name, which is added where it is missing. */
size_t names_index(struct names *list, const char *name);

#endif
