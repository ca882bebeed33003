/* Blocks of doubling size in a chain; an allocation never moves, and all of them die together.
   Exhausted memory is not a state any caller could go on from: the program says so and ends with status 5. */
#include "arena.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_BLOCK = 4096, LARGEST_BLOCK = 1 << 20 };

struct arena_block {
  struct arena_block *next;
  size_t used, size;
  _Alignas(max_align_t) unsigned char bytes[];
};

static bool quiet;
static void (*called)(void);

void ss_exhausted_quietly(void) {
  quiet = true;
  called = NULL;
}

void ss_exhausted_calls(void (*f)(void)) {
  called = f;
}

void ss_out_of_memory(void) {
  if (called) called();
  if (!quiet) fputs("stickslip: out of memory\n", stderr);
  exit(EXIT_EXHAUSTED);
}

static void *or_die(void *p) {
  if (!p) ss_out_of_memory();
  return p;
}

void *ss_malloc(size_t size) {
  return or_die(malloc(size ? size : 1));
}

void *ss_realloc(void *p, size_t size) {
  return or_die(realloc(p, size ? size : 1));
}

void arena_list_add(struct arena *a, const char ***list, int *n, const char *s) {
  const char **longer = arena_alloc(a, (size_t)(*n + 1) * sizeof *longer);
  if (*n) memcpy(longer, *list, (size_t)*n * sizeof *longer);
  longer[(*n)++] = s;
  *list = longer;
}

char *ss_strdup(const char *s) {
  return ss_strndup(s, strlen(s));
}

char *ss_strndup(const char *s, size_t len) {
  char *p = ss_malloc(len + 1);
  memcpy(p, s, len);
  p[len] = '\0';
  return p;
}

void *ss_grow(void *p, size_t len, size_t *cap, size_t size) {
  if (len < *cap) return p;
  size_t wanted = *cap ? *cap * 2 : 8;
  if (wanted > SIZE_MAX / size) or_die(NULL);
  *cap = wanted;
  return ss_realloc(p, wanted * size);
}

void arena_init(struct arena *a) {
  a->head = NULL;
}

void arena_clear(struct arena *a) {
  while (a->head) {
    struct arena_block *next = a->head->next;
    free(a->head);
    a->head = next;
  }
}

void arena_in(void *room, size_t size) {
  *(struct arena_block *)room = (struct arena_block){.size = size - sizeof(struct arena_block)};
}

void arena_resume(struct arena *a, void *room) {
  a->head = room;
}

void *arena_alloc(struct arena *a, size_t size) {
  const size_t align = _Alignof(max_align_t);
  if (size > SIZE_MAX / 2) or_die(NULL);
  size = (size + align - 1) / align * align;
  struct arena_block *b = a->head;
  if (!b || b->size - b->used < size) {
    size_t want = b ? b->size * 2 : FIRST_BLOCK;
    if (want > LARGEST_BLOCK) want = LARGEST_BLOCK;
    if (want < size) want = size;
    b = ss_malloc(sizeof *b + want);
    b->next = a->head;
    b->used = 0;
    b->size = want;
    a->head = b;
  }
  void *p = b->bytes + b->used;
  b->used += size;
  return memset(p, 0, size);
}

char *arena_strndup(struct arena *a, const char *s, size_t len) {
  char *p = arena_alloc(a, len + 1);
  memcpy(p, s, len);
  return p;
}

char *arena_strdup(struct arena *a, const char *s) {
  return arena_strndup(a, s, strlen(s));
}
