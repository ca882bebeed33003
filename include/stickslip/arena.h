/* Memory that dies at once: everything taken from an arena is given back by arena_clear. */
#ifndef STICKSLIP_ARENA_H
#define STICKSLIP_ARENA_H

#include <stddef.h>

struct arena_block;
struct arena {
  struct arena_block *head;
};

void arena_init(struct arena *a);
void arena_clear(struct arena *a);

/* size bytes, zeroed, aligned for any type.  Ends the program with status 5 when memory is exhausted. */
void *arena_alloc(struct arena *a, size_t size);
/* The first len bytes of s with a terminating NUL. */
char *arena_strndup(struct arena *a, const char *s, size_t len);

/* malloc and realloc that end the program with status 5 and a message when memory is exhausted. */
void *ss_malloc(size_t size);
void *ss_realloc(void *p, size_t size);

/* Makes room for one more element in a heap array of *cap elements of the given size, doubling it when full. */
void *ss_grow(void *p, size_t len, size_t *cap, size_t size);

#endif
