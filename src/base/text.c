/* Strings, sources and diagnostics.  A diagnostic is formatted when it is found, so that it outlives its source. */
#include "text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "arena.h"

const char *const ordinal_word[N_ORDINALS] = {"first", "second", "third",   "fourth",
                                              "fifth", "sixth",  "seventh", "eighth"};

void text_init(struct text *t) {
  *t = (struct text){NULL, 0, 0};
}

void text_clear(struct text *t) {
  free(t->data);
  text_init(t);
}

void text_reset(struct text *t) {
  t->len = 0;
  if (t->data) t->data[0] = '\0';
}

static void reserve(struct text *t, size_t extra) {
  size_t need = t->len + extra + 1;
  if (need <= t->cap) return;
  size_t cap = t->cap ? t->cap : 64;
  while (cap < need) cap *= 2;
  t->data = ss_realloc(t->data, cap);
  t->cap = cap;
}

void text_add_n(struct text *t, const char *s, size_t len) {
  reserve(t, len);
  if (len) memcpy(t->data + t->len, s, len);
  t->len += len;
  t->data[t->len] = '\0';
}

void text_add(struct text *t, const char *s) {
  text_add_n(t, s, strlen(s));
}

void text_add_char(struct text *t, char c) {
  text_add_n(t, &c, 1);
}

void text_add_capital(struct text *t, const char *words) {
  size_t n = 0;
  while (char_is_letter(words[n])) n++;
  bool ends = strchr(" ,", words[n]) || (words[n] == '-' && char_is_letter(words[n + 1]));
  bool word = ends && (n > 1 || *words == 'a'), small = word && *words >= 'a' && *words <= 'z';
  if (small) text_add_char(t, (char)(*words - 'a' + 'A'));
  text_add(t, words + small);
}

void text_vprintf(struct text *t, const char *fmt, va_list ap) {
  va_list again;
  va_copy(again, ap);
  int n = vsnprintf(NULL, 0, fmt, ap);
  if (n > 0) {
    reserve(t, (size_t)n);
    vsnprintf(t->data + t->len, (size_t)n + 1, fmt, again);
    t->len += (size_t)n;
  }
  va_end(again);
}

char *text_take(struct arena *a, struct text *t) {
  char *s = arena_strndup(a, text_str(t), t->len);
  text_clear(t);
  return s;
}

char *arena_printf(struct arena *a, const char *fmt, ...) {
  va_list ap;
  va_start(ap, fmt);
  char *s = arena_vprintf(a, fmt, ap);
  va_end(ap);
  return s;
}

char *arena_vprintf(struct arena *a, const char *fmt, va_list ap) {
  va_list again;
  va_copy(again, ap);
  int n = vsnprintf(NULL, 0, fmt, ap);
  char *s = arena_alloc(a, (size_t)(n > 0 ? n : 0) + 1);
  vsnprintf(s, (size_t)n + 1, fmt, again);
  va_end(again);
  return s;
}

static bool is_plain(char c) {
  return char_is_word(c) || (c && strchr("./-+=:,@%", c));
}

void text_add_quoted(struct text *t, const char *word) {
  const char *p = word;
  while (is_plain(*p)) p++;
  if (!*p && p > word) {
    text_add(t, word);
    return;
  }
  text_add_char(t, '\'');
  for (; *word; word++)
    if (*word == '\'')
      text_add(t, "'\\''");
    else
      text_add_char(t, *word);
  text_add_char(t, '\'');
}

void text_printf(struct text *t, const char *fmt, ...) {
  va_list ap;
  va_start(ap, fmt);
  text_vprintf(t, fmt, ap);
  va_end(ap);
}

/* Well-formed by table 3-7 of the Unicode standard. */
size_t text_valid_prefix(const char *text, size_t len) {
  const unsigned char *s = (const unsigned char *)text;
  size_t i = 0;
  while (i < len) {
    unsigned char c = s[i];
    size_t n = c < 0x80                   ? 0
               : (c >= 0xC2 && c <= 0xDF) ? 1
               : (c >= 0xE0 && c <= 0xEF) ? 2
               : (c >= 0xF0 && c <= 0xF4) ? 3
                                          : 4;
    if (n == 4 || len - i <= n) return i;
    for (size_t k = 1; k <= n; k++)
      if ((s[i + k] & 0xC0U) != 0x80U) return i;
    if ((c == 0xE0 && s[i + 1] < 0xA0) || (c == 0xED && s[i + 1] >= 0xA0) || (c == 0xF0 && s[i + 1] < 0x90) ||
        (c == 0xF4 && s[i + 1] >= 0x90))
      return i;
    i += n + 1;
  }
  return len;
}

/* Of characters that control: those below the blank, U+007F to U+009F, and U+2028 to U+202E and U+2066 to U+2069, which
   end lines or turn the direction of writing. */
static bool is_control(const unsigned char *s) {
  if (s[0] < ' ' || s[0] == 0x7F) return true;
  if (s[0] == 0xC2) return s[1] < 0xA0;
  return s[0] == 0xE2 &&
         ((s[1] == 0x80 && s[2] >= 0xA8 && s[2] <= 0xAE) || (s[1] == 0x81 && s[2] >= 0xA6 && s[2] <= 0xA9));
}

static bool ends_line(const char *s) {
  return s[0] == '\n' || (s[0] == '\r' && s[1] == '\n');
}

size_t text_plain_prefix(const char *s, size_t len, bool lines) {
  size_t good = text_valid_prefix(s, len), i = 0;
  while (i < good && (!is_control((const unsigned char *)s + i) || (lines && (s[i] == '\t' || ends_line(s + i))))) i++;
  return i;
}

bool word_is(const char *s, size_t len, const char *word) {
  return strlen(word) == len && strncmp(s, word, len) == 0;
}

bool list_has(const char *list, const char *word) {
  size_t n;
  for (const char *p = list_item(&n, list); p; p = list_item(&n, p + n))
    if (word_is(p, n, word)) return true;
  return false;
}

const char *list_joint(int i, int n, const char *last) {
  return i == 0 ? "" : i + 1 < n ? ", " : last;
}

int word_compare(const void *a, const void *b) {
  return strcmp(*(const char *const *)a, *(const char *const *)b);
}

int word_find(const char *word, const char *const *list, int n) {
  int i = 0;
  while (i < n && strcmp(list[i], word) != 0) i++;
  return i;
}

const char *list_item(size_t *len, const char *s) {
  if (s) s += strspn(s, ", ");
  *len = s ? strcspn(s, ", ") : 0;
  return *len ? s : NULL;
}

const char *text_str(const struct text *t) {
  return t->data ? t->data : "";
}

void diag_init(struct diag *d) {
  *d = (struct diag){.set = false};
}

/* Cuts a message that had to be truncated at a character boundary, so that it stays UTF-8. */
static void cut_at_character(char *s, size_t size) {
  size_t n = strlen(s);
  if (n + 1 < size) return;
  while (n > 0 && ((unsigned char)s[n - 1] & 0xC0U) == 0x80U) n--;
  if (n > 0 && ((unsigned char)s[n - 1] & 0x80U)) n--;
  s[n] = '\0';
}

/* A message is UTF-8 whatever it quotes, and does nothing to a terminal: a byte that is no part of a character and one
   that controls become "?"; newlines too, unless there may be lines. */
static void make_visible(char *s, bool lines) {
  size_t n = strlen(s);
  for (size_t i = text_plain_prefix(s, n, false); i < n; i += text_plain_prefix(s + i, n - i, false))
    if (lines && s[i] == '\n')
      i++;
    else
      s[i] = '?';
}

/* What quotes something long, a path of a million characters, keeps its beginning and its end, which says what is
   wrong. */
static void leave_out_the_middle(char *s, size_t size, const char *whole, size_t len) {
  static const char gap[] = " ... ";
  enum { HEAD = 300 };
  memcpy(s, whole, HEAD);
  s[HEAD] = '\0';
  cut_at_character(s, HEAD + 1);
  const char *tail = whole + len - (size - sizeof gap - HEAD);
  while (((unsigned char)*tail & 0xC0U) == 0x80U) tail++;
  strcat(s, gap);
  strcat(s, tail);
}

bool diag_set(struct diag *d, const char *fmt, ...) {
  if (!d || d->set) return false;
  va_list ap, again;
  va_start(ap, fmt);
  va_copy(again, ap);
  int n = vsnprintf(d->message, sizeof d->message, fmt, ap);
  va_end(ap);
  if (n >= (int)sizeof d->message) {
    FREED char *whole = ss_malloc((size_t)n + 1);
    vsnprintf(whole, (size_t)n + 1, fmt, again);
    leave_out_the_middle(d->message, sizeof d->message, whole, (size_t)n);
  }
  va_end(again);
  make_visible(d->message, false);
  const char *mark = strstr(d->message, "error: ");
  snprintf(d->what, sizeof d->what, "%.*s", (int)sizeof d->what - 1, mark ? mark + strlen("error: ") : d->message);
  cut_at_character(d->what, sizeof d->what);
  d->set = true;
  return false;
}

void diag_again(struct diag *d, const char *message) {
  if (!d || d->set) return;
  snprintf(d->message, sizeof d->message, "%s", message);
  d->set = true;
}

static bool starts_character(char c) {
  return ((unsigned char)c & 0xC0U) != 0x80U;
}

static size_t count_characters(const char *s, size_t len) {
  size_t n = 0;
  for (size_t i = 0; i < len; i++) n += starts_character(s[i]);
  return n;
}

/* Appends the source line around offset, at most `width` bytes of it, and a caret below the place. */
static void add_excerpt(struct text *out, const char *line, size_t len, size_t at) {
  const size_t width = 100;
  size_t from = 0;
  if (len > width && at > width / 2) from = at - width / 2;
  while (from > 0 && !starts_character(line[from])) from--;
  size_t to = len - from > width ? from + width : len;
  while (to > from && to < len && !starts_character(line[to])) to--;
  text_add(out, "\n  ");
  for (size_t i = from; i < to; i++)
    text_add_char(out, (unsigned char)line[i] < ' ' || line[i] == 0x7F ? ' ' : line[i]);
  text_add(out, "\n  ");
  for (size_t i = count_characters(line + from, at - from); i > 0; i--) text_add_char(out, ' ');
  text_add_char(out, '^');
}

/* The number of the line that holds a place, and where it begins. */
static void line_of(size_t *line, size_t *begin, const struct source *s, size_t offset) {
  *line = 1;
  *begin = 0;
  for (size_t i = 0; i < offset; i++)
    if (s->text[i] == '\n') {
      ++*line;
      *begin = i + 1;
    }
}

void source_place(size_t *line, size_t *column, const struct source *s, size_t offset) {
  size_t begin;
  if (offset > s->len) offset = s->len;
  line_of(line, &begin, s, offset);
  *column = count_characters(s->text + begin, offset - begin) + 1;
}

void diag_beyond(struct diag *d) {
  if (d && !d->set) d->beyond = true;
}

bool diag_at(struct diag *d, const struct source *s, size_t offset, const char *fmt, ...) {
  if (!d || d->set) return false;
  if (offset > s->len) offset = s->len;
  d->src = s;
  d->at = offset;
  size_t line, begin, end;
  line_of(&line, &begin, s, offset);
  end = begin;
  while (end < s->len && s->text[end] != '\n') end++;

  const size_t longest_name = 200;
  va_list ap;
  va_start(ap, fmt);
  vsnprintf(d->what, sizeof d->what, fmt, ap);
  va_end(ap);
  cut_at_character(d->what, sizeof d->what);
  make_visible(d->what, false);

  OWNED(text) out = {0}, name = {0};
  text_add(&name, s->name);
  if (name.len > longest_name) {
    name.data[longest_name] = '\0';
    cut_at_character(name.data, longest_name + 1);
  }
  text_printf(&out, "%s:%zu:%zu: error: %s", text_str(&name), line,
              count_characters(s->text + begin, offset - begin) + 1, d->what);
  make_visible(out.data, false);
  add_excerpt(&out, s->text + begin, end - begin, offset - begin);
  snprintf(d->message, sizeof d->message, "%s", text_str(&out)); /* which is shorter, by what went into it */
  make_visible(d->message, true);
  d->set = true;
  return false;
}

struct paper_name paper_name(const char *name) {
  struct paper_name p;
  int letters = (int)strcspn(name, "_0123456789");
  snprintf(p.is, sizeof p.is, "%.*s%s%s", letters, name, char_is_digit(name[letters]) ? "_" : "", name + letters);
  return p;
}
