/* Lists of names. */
#ifndef STICKSLIP_REPORT_NAMES_H
#define STICKSLIP_REPORT_NAMES_H

#include <stddef.h>

/* Names, each once, in the order in which they came. */
struct names {
  const char **name;
  size_t n, cap;
};
/* The place of the name, which is added where it is missing; the list holds the pointer, and name is to be freed. */
size_t names_index(struct names *list, const char *name);

#endif
