/* A folder of the test's own, children for what ends a process, which programs the tests run, and lines of tables. */
#ifndef STICKSLIP_TESTS_SCRATCH_H
#define STICKSLIP_TESTS_SCRATCH_H

#include <stdbool.h>
#include <stddef.h>

#include "base/text.h"

/* Fixtures: make the folder, remove it with all that is in it. */
void scratch_open(void);
void scratch_close(void);

/* The path of a name in the folder; "" is the folder itself.  Valid until scratch_close. */
const char *scratch_path(const char *name);
/* Writes a file there and returns its path. */
const char *scratch_put(const char *name, const char *text);
const char *scratch_put_n(const char *name, const char *bytes, size_t len);
/* A text by that name; to be cleared. */
struct source source_of(const char *name, const char *text);
/* As by printf: a text, valid until scratch_close, or to the end where no folder is open; such a text in a file there,
   whose path is returned. */
const char *formatted(const char *fmt, ...) __attribute__((format(printf, 1, 2)));
const char *scratch_print(const char *name, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
/* A text with the first of these in it replaced, likewise; fails the test where there is none. */
const char *replaced(const char *text, const char *was, const char *now);
/* before so many times, the middle, and after as often. */
const char *nested(const char *before, const char *middle, const char *after, size_t n);
/* The names in a folder in alphabetical order, joined with blanks. */
const char *scratch_list(const char *path);

/* The program under test and the Python that checks its output: STICKSLIP and PYTHON of the environment, or the
   usual. */
const char *program(void);
const char *python(void);

/* A file as it is, to be freed; fails the test where it cannot be read. */
char *file_text(const char *path);
/* Of a file in the folder: whether it is there, and whether it holds a text. */
bool scratch_has(const char *name);
bool scratch_says(const char *name, const char *what);
void check_says(const char *name, const char *what); /* the same, shown where it does not */
void check_is(const char *name, const char *want);   /* it holds that and nothing else */

/* Runs a line of shell, in which $P is the program, $Y Python and $D the folder; its exit status, or -1 when a signal
   ended it.  there_is: whether a command is installed. */
int shell(const char *fmt, ...) __attribute__((format(printf, 1, 2)));
bool there_is(const char *command);

/* Fails the test where a line does not end with that status and print that text on either output, and shows what it
   printed.  shell_well: with 0.  shell_said: with 0 too; its standard output, to be freed. */
void shell_ends(int status, const char *says, const char *fmt, ...) __attribute__((format(printf, 3, 4)));
#define shell_well(...) shell_ends(0, "", __VA_ARGS__)
char *shell_said(const char *fmt, ...) __attribute__((format(printf, 1, 2)));

/* A message that begins with NAME:LINE:COLUMN shows the line with a caret under that column, and one without such a
   place shows none; fails the test that is about what. */
void check_caret(const char *message, const char *what);

/* The fields of a line between tabs, at most most of them; the line is cut up.  Returns how many. */
int split_tabs(char **field, int most, char *line);

/* How a child that calls f ends: its exit status (0 when f returns), or minus the signal that killed it. */
int child_end(void (*f)(void));

/* In a child that can write no large file: a build that counts what runs (make cover) leaves the counts of before
   whole. */
void count_nothing(void);

#endif
