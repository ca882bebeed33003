/* Strings that grow, files read whole, files written beside and renamed. */
#ifndef STICKSLIP_BASE_TEXT_H
#define STICKSLIP_BASE_TEXT_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include "owned.h"

#define SS_PRINTF(a, b) __attribute__((format(printf, a, b)))

/* Characters of ASCII, whatever the locale is; a word is made of letters, digits and underscores. */
static inline bool char_is_digit(char c) {
  return c >= '0' && c <= '9';
}
static inline bool char_is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
static inline bool char_is_letter_or_digit(char c) {
  return char_is_letter(c) || char_is_digit(c);
}
static inline bool char_is_word(char c) {
  return char_is_letter_or_digit(c) || c == '_';
}
/* The first item at or behind s of a list with commas or blanks between, and its length; NULL, with length 0, when
   there is none, or no list. */
const char *list_item(size_t *len, const char *s);
/* Whether the len characters at s are that word. */
bool word_is(const char *s, size_t len, const char *word);
/* Is the word an item of such a list (or NULL)? */
bool list_has(const char *list, const char *word);
/* What stands before item i of n in a sentence: nothing, a comma, or before the last one such as " and ". */
const char *list_joint(int i, int n, const char *last);
/* The order of two strings behind pointers, for qsort. */
int word_compare(const void *a, const void *b);
/* The place of a word in a list of n words; n when it is none of them. */
int word_find(const char *word, const char *const *list, int n);

/* A name of a scene as the paper writes it: z_10 for z10, e_1 for e1. */
struct paper_name {
  char is[64];
};
struct paper_name paper_name(const char *name);

/* The ending of a noun of which there are n. */
static inline const char *plural_s(long long n) {
  return n == 1 ? "" : "s";
}
/* "first", "second", ...: of 1 to N_ORDINALS at ordinal_word[n - 1]. */
enum { N_ORDINALS = 8 };
extern const char *const ordinal_word[N_ORDINALS];
/* What stands in a table for a word; "-" for none or an empty one. */
static inline const char *or_dash(const char *word) {
  return word && *word ? word : "-";
}

/* data is always NUL-terminated once anything has been added, and NULL before: a text of zeros is empty. */
struct text {
  char *data;
  size_t len, cap;
};

void text_init(struct text *t);
void text_clear(struct text *t);
void text_reset(struct text *t); /* empties, keeps the memory */
void text_add(struct text *t, const char *s);
void text_add_n(struct text *t, const char *s, size_t len);
void text_add_char(struct text *t, char c);
/* The words, with a capital where they begin with one in small letters: not z_1 or det(A), which are formulas, or
   eq-27. */
void text_add_capital(struct text *t, const char *words);
/* A word as a shell reads it, in single quotes where it needs them. */
void text_add_quoted(struct text *t, const char *word);
void text_printf(struct text *t, const char *fmt, ...) SS_PRINTF(2, 3);
void text_vprintf(struct text *t, const char *fmt, va_list ap) SS_PRINTF(2, 0);
const char *text_str(const struct text *t); /* "" when nothing was added */
/* The text, which is cleared, as a string of the arena; and what is formatted as one. */
struct arena;
char *text_take(struct arena *a, struct text *t);
char *arena_printf(struct arena *a, const char *fmt, ...) SS_PRINTF(2, 3);
char *arena_vprintf(struct arena *a, const char *fmt, va_list ap) SS_PRINTF(2, 0);
/* The length of the longest prefix that is well-formed UTF-8: no overlong forms, no surrogates, nothing cut off. */
size_t text_valid_prefix(const char *s, size_t len);
/* The length of the longest prefix that is besides without characters that control a terminal, end a line or turn the
   direction of writing: U+0000 to U+001F, U+007F to U+009F, U+2028 to U+202E, U+2066 to U+2069.  lines: where there may
   be lines, LF, CR LF and TAB are none of them. */
size_t text_plain_prefix(const char *s, size_t len, bool lines);

/* A place in a source: byte offsets, end exclusive. */
struct span {
  size_t begin, end;
};

/* A file held in memory, with the name its diagnostics use.  text[len] is NUL. */
struct source {
  char *name;
  char *text;
  size_t len;
};

/* The first error of a run, none while all is zero, as the user will read it: one line, or three with the source line
   and a caret; at most 999 bytes of UTF-8 without control characters, no trailing newline.  What is longer loses its
   middle. */
struct diag {
  bool set;
  bool undeclared; /* the mistake is a name that no file declares, or two other sections do, or of another form */
  bool beyond;     /* no mistake: what stands there is more than the program reads */
  const void *src; /* diag_at: the source, to be told from others and not to be read; NULL without a place */
  size_t at;       /* the offset in it */
  char message[1000];
  char what[512]; /* what is wrong alone, a line: no file, no place in it */
};

void diag_init(struct diag *d);
/* Before an error is recorded: nothing is wrong with what it points at, it is only more than the program reads. */
void diag_beyond(struct diag *d);
/* Records an error; later ones are ignored, since the first is the cause.  d may be NULL.  Always false, which is what
   who finds the error returns. */
bool diag_set(struct diag *d, const char *fmt, ...) SS_PRINTF(2, 3);
/* The same with "name:line:column: error: " before it and the source line with a caret below.
   Lines and columns count from 1; a column is one UTF-8 character.  A long line is clipped around the caret. */
bool diag_at(struct diag *d, const struct source *s, size_t offset, const char *fmt, ...) SS_PRINTF(4, 5);

/* Records again, lines and all, what another diag has: one of another process, or of an attempt. */
void diag_again(struct diag *d, const char *message);

/* Reads a regular file of at most max bytes; refuses directories, devices, and what source_check does.
   A byte-order mark is dropped.  false with d set on failure. */
bool source_read(struct source *s, const char *path, size_t max, struct diag *d);
/* The same from memory; copies both, whatever they are. */
void source_from_string(struct source *s, const char *name, const char *text);
/* Whether all of the text is text_plain_prefix, its name too, without lines; so that what quotes them, in any language
   of the outputs or on a terminal, quotes no line end and no control sequence.  false with d set. */
bool source_check(const struct source *s, struct diag *d);
void source_clear(struct source *s);
/* Line and column of a place, counted as diag_at counts them. */
void source_place(size_t *line, size_t *column, const struct source *s, size_t offset);

/* The name of a file without its folders. */
const char *path_base(const char *path);
/* Whether it ends in the suffix and is more than that. */
bool path_has_suffix(const char *path, const char *suffix);
/* The folder part of a path, "." without one; out is emptied first. */
void path_folder(struct text *out, const char *path);

/* Writes len bytes to a descriptor, whatever it takes at a time; false, with errno set, when it takes no more. */
bool write_all(int fd, const char *data, size_t len);
/* Writes path with len bytes of data through a temporary file in the same folder and a rename, so that a reader sees
   the old file or the new one and a failure leaves the old one.  What stands there already must be a regular file.
   false with d set on failure. */
bool file_write(const char *path, const char *data, size_t len, struct diag *d);
/* Whether nothing but a regular file stands at path, so that a rename may put another there; errno says why not. */
bool file_replaceable(const char *path);
/* Several files as one: all temporary files are written before the first is renamed, so that a failure to write any of
   them leaves every old file. */
struct file_item {
  const char *path, *data;
  size_t len;
};
enum { MAX_FILE_ITEMS = 32 };
bool files_write(const struct file_item *item, int n, struct diag *d);
/* Removes from the folder the temporary files that a killed files_write of these n files left; for who keeps others
   from writing them. */
void files_remove_left(const char *folder, const struct file_item *item, int n);
/* The signals that end a run from outside: Ctrl-C, SIGTERM, SIGHUP, and the clock. */
enum { N_ENDING_SIGNALS = 4 };
extern const int ending_signals[N_ENDING_SIGNALS];
/* For the end of the process, handlers of signals too: what files_write was about is undone, or brought to its end when
   the first file stands in its place already, so that files are all old or all new and no temporary one stays; nor a
   folder that folder_make has made for nothing.  Where a signal has no handler, files_write sees to it. */
void files_settle(void);
/* How often, in this process, files_write or files_settle has put all files of a call in their places. */
int files_in_place(void);
/* The files of a folder whose names have the suffix and do not begin with a point, as paths in the order of their
   names, in an array to be freed and an arena; NULL with d set when there are none. */
char **folder_files(size_t *n, const char *path, const char *suffix, struct arena *a, struct diag *d);
/* Makes a folder and its parents; existing ones are fine. */
bool folder_make(const char *path, struct diag *d);
bool folder_is_there(const char *path);
/* Whether folder_make can succeed; nothing is left of the trial.  To be asked before work that would be in vain. */
bool folder_possible(const char *path, struct diag *d);

#endif
