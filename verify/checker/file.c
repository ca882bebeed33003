/* The certificate as a list of values with their paths, ".orbits.0.box.t_a"; how the checker ends. */
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "checker.h"

_Noreturn void end(int status) {
  if (fflush(stdout) != 0 || ferror(stdout)) {
    fputs("stickslip-checker: standard output cannot be written\n", stderr);
    status = NO_ANSWER;
  }
  exit(status);
}

void stop(int status, const char *fmt, ...) {
  char why[900];
  va_list args;
  va_start(args, fmt);
  vsnprintf(why, sizeof why, fmt, args);
  va_end(args);
  for (char *p = why; *p; p++)
    if (*p < ' ' || *p > '~') *p = '?';
  fprintf(status == REJECTED ? stdout : stderr, "%s: %s\n", status == REJECTED ? "rejected" : "stickslip-checker", why);
  end(status);
}

/* --- JSON --- */
enum { MAX_DIGITS = 200000, MAX_FILE = 1 << 25, MAX_VALUES = 10000, MAX_PATH = 80 };

static struct value {
  char path[MAX_PATH];
  const char *text; /* in the file's buffer; true and false too */
  enum kind kind;   /* GROUP: an object or a list, whose members follow */
  bool used;
} values[MAX_VALUES];
static int n_values;
static char *buffer, *at;

static char blanks(void) {
  while (*at == ' ' || *at == '\n' || *at == '\t' || *at == '\r') at++;
  return *at;
}

static void expect(char c) {
  if (!blanks()) stop(BAD_FILE, "the file ends too early");
  if (*at != c) stop(BAD_FILE, "the file is not JSON, or holds what no certificate has, in place of '%c'", c);
  at++;
}

/* Ends in the buffer where its quote was.  Escaped characters are kept as they stand: only names of scenes have any. */
static const char *read_string(void) {
  expect('"');
  const char *start = at;
  while (*at && *at != '"') at += at[0] == '\\' && at[1] ? 2 : 1;
  if (!*at) stop(BAD_FILE, "the file is not JSON: a string does not end");
  *at++ = '\0';
  return start;
}

/* The path is so short that nothing nests deeply. */
static void read_value(char *path, size_t len) {
  char c = blanks();
  if (n_values == MAX_VALUES) stop(BAD_FILE, "the file has too many values");
  struct value *v = &values[n_values++];
  memcpy(v->path, path, len + 1);
  for (int i = 0; i < n_values - 1; i++)
    if (strcmp(values[i].path, path) == 0) stop(BAD_FILE, "%s occurs twice", path);
  if (c != '{' && c != '[') {
    v->text = strncmp(at, "true", 4) == 0 ? "true" : strncmp(at, "false", 5) == 0 ? "false" : NULL;
    v->kind = v->text ? TRUTH : STRING;
    at += v->text ? strlen(v->text) : 0;
    if (!v->text) v->text = read_string();
    return;
  }
  v->kind = GROUP;
  v->text = "";
  at++;
  for (int n = 0; blanks() != (c == '{' ? '}' : ']'); n++) {
    char number[16];
    if (n > 0) expect(',');
    snprintf(number, sizeof number, "%d", n);
    const char *key = c == '{' ? read_string() : number;
    if (c == '{') expect(':');
    size_t more = strlen(key) + 1;
    if (len + more >= MAX_PATH || strchr(key, '.')) stop(BAD_FILE, "no certificate has the name %.80s there", key);
    snprintf(path + len, MAX_PATH - len, ".%s", key);
    read_value(path, len + more);
    path[len] = '\0';
    v->used = true;
  }
  at++;
}

void read_file(const char *name) {
  struct stat st = {0};
  FILE *f = stat(name, &st) == 0 && S_ISREG(st.st_mode) ? fopen(name, "rb") : NULL;
  size_t size = st.st_size < MAX_FILE ? (size_t)st.st_size : MAX_FILE;
  if (!f && errno == ENOMEM) stop(NO_ANSWER, "memory ran out");
  if (!f) stop(BAD_FILE, "%.200s cannot be read", name);
  at = buffer = flint_malloc(size + 1);
  size = fread(buffer, 1, size, f);
  bool whole = fgetc(f) == EOF;
  fclose(f);
  if (!whole || memchr(buffer, '\0', size)) stop(BAD_FILE, "%.200s is not a certificate", name);
  buffer[size] = '\0';
  read_value((char[MAX_PATH]){0}, 0);
  if (blanks()) stop(BAD_FILE, "something follows the end of the certificate");
}

const char *get(enum kind what, const char *fmt, ...) {
  char path[2 * MAX_PATH];
  va_list args;
  va_start(args, fmt);
  vsnprintf(path, sizeof path, fmt, args);
  va_end(args);
  for (int i = 0; i < n_values; i++)
    if (strcmp(values[i].path, path) == 0) {
      if (values[i].kind != (what == OPTIONAL ? STRING : what))
        stop(BAD_FILE, "%s has a value of the wrong type", path);
      values[i].used = true;
      return values[i].text;
    }
  if (what == STRING || what == TRUTH) stop(BAD_FILE, "%s is missing", path);
  return NULL;
}

void all_used(void) {
  for (int i = 0; i < n_values; i++)
    if (!values[i].used) stop(BAD_FILE, "unknown name %s", values[i].path);
}

/* --- Numbers --- */
slong narrowest;

void read_rational(fmpq_t q, const char *s) {
  const char *n = s + (s[0] == '-'), *end = n + strspn(n, "0123456789");
  bool good = end > n && end - s <= MAX_DIGITS;
  if (good && end[0] == '/' && end[1] > '0') end += 1 + strspn(end + 1, "0123456789");
  if (!good || *end || fmpq_set_str(q, s, 10)) stop(BAD_FILE, "%.40s is not a rational number that can be read", s);
}

/* "mantissa exponent mantissa exponent" of midpoint and radius, in hexadecimal: Arb's text form.  The ball is the
   file's, neither wider nor narrower: a radius of more bits than Arb keeps is refused. */
void read_ball(arb_t x, const char *s) {
  static const size_t most[4] = {MAX_DIGITS, 6, 8, 6};
  fmpz_t part[4];
  const char *p = s;
  for (int i = 0; i < 4; i++) {
    size_t sign = p[0] == '-', len = sign + strspn(p + sign, "0123456789abcdef");
    bool good = len > sign && len - sign <= most[i] && p[len] == (i < 3 ? ' ' : '\0') && !(i == 2 && sign);
    char *copy = good ? memcpy(flint_calloc(len + 1, 1), p, len) : NULL;
    fmpz_init(part[i]);
    if (!copy || fmpz_set_str(part[i], copy, 16) || (i == 2 && fmpz_bits(part[i]) > MAG_BITS))
      stop(BAD_FILE, "%.40s is no ball, or out of range", s);
    flint_free(copy);
    p += len + 1;
  }
  arf_set_fmpz_2exp(arb_midref(x), part[0], part[1]);
  mag_set_fmpz_2exp_fmpz_lower(arb_radref(x), part[2], part[3]); /* exact; the function beside it may round up */
  slong narrow = FLINT_MIN(-fmpz_get_si(MAG_EXPREF(arb_radref(x))), (slong)fmpz_bits(part[0]) + ENOUGH);
  if (!mag_is_zero(arb_radref(x))) narrowest = FLINT_MAX(narrowest, narrow);
  for (int i = 0; i < 4; i++) fmpz_clear(part[i]);
}

/* --- The pool --- */
enum { MAX_MATS = 1 << 16 };
static arb_mat_struct mats[MAX_MATS];
slong prec, pool_size;

mat matrix(slong rows, slong columns) {
  if (pool_size == MAX_MATS) stop(REJECTED, "the proof takes more memory than it may");
  arb_mat_init(&mats[pool_size], rows, columns);
  return &mats[pool_size++];
}

arb_ptr fresh(void) {
  return arb_mat_entry(matrix(1, 1), 0, 0);
}

mat part(mat m, slong row, slong column, slong rows, slong columns) {
  mat z = matrix(rows, columns);
  for (slong i = 0; i < rows; i++)
    for (slong k = 0; k < columns; k++) arb_set(arb_mat_entry(z, i, k), arb_mat_entry(m, row + i, column + k));
  return z;
}

void release(slong size) {
  while (pool_size > size) arb_mat_clear(&mats[--pool_size]);
}
