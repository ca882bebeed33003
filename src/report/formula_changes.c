/* Where two formulas differ, symbol by symbol: a symbol is a letter with its accent, primes and index, so that u_{r1}
   and u_{r2} differ as a whole.  The longest common sequence of symbols stays, the rest is marked. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "formula.h"

enum { MOST_SYMBOLS = 600, LONGEST_KEY = 40 };

/* key: how the symbol is spelt when blanks and braces do not count. */
struct symbol {
  size_t at;
  char key[LONGEST_KEY];
};

struct symbols {
  struct symbol *s;
  size_t n, cap;
};

static void add_key(struct symbol *y, const char *s, size_t len) {
  size_t n = strlen(y->key);
  for (size_t i = 0; i < len; i++)
    if (!strchr(" {}", s[i]) && n + 1 < LONGEST_KEY) y->key[n++] = s[i];
  y->key[n] = '\0';
}

/* The length of a group without groups or scripts in it, or of the one sign or command at s; 0 for others. */
static size_t small_group(const char *s, const char *end) {
  const struct tex_token t = tex_read(s, end);
  if (t.kind != TEX_OPEN) return t.len;
  size_t n = 1;
  while (s + n < end && !strchr("{}_^&", s[n])) n++;
  return s + n < end && s[n] == '}' && n < LONGEST_KEY / 2 ? n + 1 : 0;
}

/* Primes and an index after a letter; the place behind them. */
static const char *read_suffix(struct symbol *y, const char *s, const char *end) {
  for (;;) {
    const char *p = s;
    if (p < end && *p == '_') {
      size_t n = small_group(p + 1, end);
      if (n == 0) return s;
      add_key(y, p, n + 1);
      s = p + n + 1;
    } else if (p < end && *p == '\'') {
      add_key(y, p, 1);
      s = p + 1;
    } else {
      return s;
    }
  }
}

/* A command or its accent with the letter under it, each with what belongs to it. */
static const char *read_word(struct symbol *y, const struct tex_token *t, const char *end) {
  const char *after = t->s + t->len;
  enum tex_role role = t->word->role;
  if (role == TEX_ROLE_SPACE) return after;
  add_key(y, t->s, t->len);
  if (role == TEX_ROLE_ACCENT) {
    size_t n = small_group(after, end);
    add_key(y, after, n);
    after += n;
  }
  bool letter = role == TEX_ROLE_ACCENT || role == TEX_ROLE_LETTER || role == TEX_ROLE_UPRIGHT;
  return letter ? read_suffix(y, after, end) : after;
}

/* An environment is a symbol where it begins. */
static const char *read_environment(struct symbol *y, const struct tex_token *t, const char *end) {
  size_t len;
  const char *after = t->s + t->len, *name = tex_braced(&len, after, end);
  if (t->kind == TEX_BEGIN) add_key(y, t->s, t->len);
  return name ? name + len + 1 : after;
}

/* One symbol or command; what only groups or spaces has an empty key. */
static const char *read_symbol(struct symbol *y, const char *s, const char *end) {
  const struct tex_token t = tex_read(s, end);
  const char *after = s + t.len;
  switch (t.kind) {
  case TEX_WORD:
    return read_word(y, &t, end);
  case TEX_BEGIN:
  case TEX_FINISH:
    return read_environment(y, &t, end);
  case TEX_GAP:
  case TEX_BRACE:
  case TEX_LEFT:
  case TEX_RIGHT:
    return after;
  case TEX_DIGIT:
    after = s + tex_number_length(s, end);
    break;
  case TEX_STRANGE:
    if (*s == '\\') return after;
    break;
  default:
    break;
  }
  add_key(y, s, (size_t)(after - s));
  return t.kind == TEX_LETTER ? read_suffix(y, after, end) : after;
}

static void read_symbols(struct symbols *list, const char *tex, size_t begin, size_t end) {
  for (const char *s = tex + begin, *stop = tex + end; s < stop;) {
    struct symbol y = {.at = (size_t)(s - tex)};
    s = read_symbol(&y, s, stop);
    if (!*y.key) continue;
    *SS_PUSH(list->s, list->n, list->cap) = y;
  }
}

static bool same(const struct symbol *a, const struct symbol *b) {
  return strcmp(a->key, b->key) == 0;
}

/* length[i][j]: of the longest common sequence of what follows i in a and j in b. */
static uint16_t *common_lengths(const struct symbols *a, const struct symbols *b) {
  size_t w = b->n + 1;
  uint16_t *length = ss_malloc((a->n + 1) * w * sizeof *length);
  memset(length, 0, (a->n + 1) * w * sizeof *length);
  for (size_t i = a->n; i-- > 0;)
    for (size_t j = b->n; j-- > 0;) {
      uint16_t down = length[(i + 1) * w + j], right = length[i * w + j + 1];
      length[i * w + j] = same(&a->s[i], &b->s[j]) ? (uint16_t)(length[(i + 1) * w + j + 1] + 1)
                          : down > right           ? down
                                                   : right;
    }
  return length;
}

bool formula_changes(bool *a_changed, const char *a, bool *b_changed, const char *b) {
  struct symbols x = {.n = 0}, y = {.n = 0};
  memset(a_changed, 0, strlen(a) * sizeof *a_changed);
  memset(b_changed, 0, strlen(b) * sizeof *b_changed);
  read_symbols(&x, a, 0, strlen(a));
  read_symbols(&y, b, 0, strlen(b));
  bool done = x.n <= MOST_SYMBOLS && y.n <= MOST_SYMBOLS;
  FREED uint16_t *length = done ? common_lengths(&x, &y) : NULL;
  done = done && 2 * (size_t)length[0] >= (x.n < y.n ? x.n : y.n);
  for (size_t i = 0, j = 0, w = y.n + 1; done && (i < x.n || j < y.n);) {
    if (i < x.n && j < y.n && same(&x.s[i], &y.s[j]))
      i++, j++;
    else if (j == y.n || (i < x.n && length[(i + 1) * w + j] >= length[i * w + j + 1]))
      a_changed[x.s[i++].at] = true;
    else
      b_changed[y.s[j++].at] = true;
  }
  free(y.s);
  free(x.s);
  return done;
}

/* The symbols of the text's formulas. */
static void read_text_symbols(struct symbols *list, const char *text) {
  const char *open = strchr(text, '$');
  while (open) {
    const char *close = strchr(open + 1, '$');
    if (!close) return;
    read_symbols(list, text, (size_t)(open + 1 - text), (size_t)(close - text));
    open = strchr(close + 1, '$');
  }
}

/* Whether symbol j of b stands between the neighbours of symbol i of a; what begins or ends a does not matter. */
static bool same_place(const struct symbols *a, size_t i, const struct symbols *b, size_t j) {
  return same(&a->s[i], &b->s[j]) && (i == 0 || (j > 0 && same(&a->s[i - 1], &b->s[j - 1]))) &&
         (i + 1 == a->n || (j + 1 < b->n && same(&a->s[i + 1], &b->s[j + 1])));
}

void formula_changes_in_text(bool *changed, const char *text, const char *a, const bool *a_changed) {
  struct symbols x = {.n = 0}, y = {.n = 0};
  memset(changed, 0, strlen(text) * sizeof *changed);
  read_symbols(&x, a, 0, strlen(a));
  read_text_symbols(&y, text);
  for (size_t i = 0; x.n <= MOST_SYMBOLS && y.n <= MOST_SYMBOLS && i < x.n; i++) {
    if (!a_changed[x.s[i].at]) continue;
    size_t found = 0, at = 0;
    for (size_t j = 0; j < y.n; j++)
      if (same_place(&x, i, &y, j)) {
        found++;
        at = y.s[j].at;
      }
    if (found == 1) changed[at] = true;
  }
  free(y.s);
  free(x.s);
}
