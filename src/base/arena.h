/* Memory that dies at once: everything taken from an arena is given back by arena_clear. */
#ifndef STICKSLIP_BASE_ARENA_H
#define STICKSLIP_BASE_ARENA_H

#include <stddef.h>

enum { EXIT_EXHAUSTED = 5 }; /* the status that exhausted memory ends the program with */

struct arena_block;
struct arena {
  struct arena_block *head;
};

void arena_init(struct arena *a); /* all zero: empty */
void arena_clear(struct arena *a);

/* Memory of the caller's, aligned for any type, as the first block of arenas: one that resumes it takes what is left of
   it (head is that block until something did not fit) and must not be cleared. */
void arena_in(void *room, size_t size);
void arena_resume(struct arena *a, void *room);

/* size bytes, zeroed, aligned for any type.  Ends the program with status 5 when memory is exhausted. */
void *arena_alloc(struct arena *a, size_t size);
/* The first len bytes of s with a terminating NUL. */
char *arena_strndup(struct arena *a, const char *s, size_t len);
char *arena_strdup(struct arena *a, const char *s);
/* One more string, which is not copied, at the end of a list of n in the arena. */
void arena_list_add(struct arena *a, const char ***list, int *n, const char *s);

/* malloc, realloc and strdup that end the program with status 5 and a message when memory is exhausted. */
void *ss_malloc(size_t size);
void *ss_realloc(void *p, size_t size);
char *ss_strdup(const char *s);
/* The first len bytes of s, which has as many, with a terminating NUL. */
char *ss_strndup(const char *s, size_t len);
/* Their end: for memory that something else asked for and did not get. */
_Noreturn void ss_out_of_memory(void);
/* From here on the status says it alone, and nothing is called: for a process whose parent has the word. */
void ss_exhausted_quietly(void);
/* From here on f is called before that end, and must not ask for memory: for a process with others to end. */
void ss_exhausted_calls(void (*f)(void));

/* How many elements an array has. */
#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

/* Makes room for one more element in a heap array of *cap elements of the given size, doubling it when full. */
void *ss_grow(void *p, size_t len, size_t *cap, size_t size);
/* The place of a new last element of such an array of n, which n counts from here on; what is put there must not name
   the array or n. */
#define SS_PUSH(p, n, cap) ((p) = ss_grow(p, (size_t)(n), &(cap), sizeof *(p)), &(p)[(n)++])

#endif
