/* Whether a formula can be passed on to LaTeX, which stops at a brace, a script or an argument that is missing, and which
   would obey commands that are not of formulas.  A formula that is not understood here is shown as it is typed. */
#include <string.h>

#include "impl.h"

#define LETTERS "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"

enum { MAX_LEVELS = 64, MAX_TABS = 9 };

/* A group, \left...\right or an environment that is open. */
struct level {
  char kind;                           /* '{', 'l' for a fence, an environment's first letter; 0 outermost */
  bool text;                           /* inside \text */
  bool superscript, subscript, primes; /* the last atom has them */
  bool pending;                        /* a script waits for its argument */
  int args;                            /* braced arguments that the last command waits for */
  bool text_next;                      /* the argument is that of \text */
  int tabs, most_tabs;
};

struct reader {
  const char *s, *end;
  struct level level[MAX_LEVELS];
  int depth;
};

/* Whatever is neither a script nor a blank: the argument that is waited for, or a new atom. */
static bool atom(struct level *l) {
  if (l->args > 0) return false;
  if (!l->pending) l->superscript = l->subscript = l->primes = false;
  l->pending = false;
  return true;
}

static bool script(struct level *l, bool *used) {
  if (l->args > 0 || l->pending || l->text || *used) return false;
  *used = l->pending = true;
  return true;
}

static bool superscript(struct level *l) {
  if (l->primes) { /* x'^2 is one superscript, x^2' is two */
    l->primes = l->superscript = false;
  }
  return script(l, &l->superscript);
}

static bool prime(struct level *l) {
  if (l->text) return true;
  if (l->args > 0 || l->pending || (l->superscript && !l->primes)) return false;
  l->primes = l->superscript = true;
  return true;
}

static bool open_level(struct reader *r, char kind, int most_tabs) {
  struct level *l = &r->level[r->depth];
  if (r->depth + 1 == MAX_LEVELS || (kind != '{' && (l->args > 0 || l->pending || l->text))) return false;
  r->level[++r->depth] =
      (struct level){.kind = kind, .text = l->text || (l->args > 0 && l->text_next), .most_tabs = most_tabs};
  return true;
}

static bool close_level(struct reader *r, char kind) {
  struct level *l = &r->level[r->depth];
  if (l->kind != kind || l->args > 0 || l->pending) return false;
  l = &r->level[--r->depth];
  if (l->args > 0) {
    l->args--;
    return true;
  }
  return atom(l);
}

/* {name} after \begin or \end. */
static bool environment(struct reader *r, bool begin) {
  static const char *const names[] = {"pmatrix", "bmatrix", "matrix", "aligned", "cases"};
  const char *close = r->s < r->end && *r->s == '{' ? memchr(r->s, '}', (size_t)(r->end - r->s)) : NULL;
  if (!close) return false;
  const char *name = r->s + 1;
  size_t len = (size_t)(close - name);
  bool known = false;
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) known = known || math_is(name, len, names[i]);
  r->s = close + 1;
  return known && (begin ? open_level(r, *name, *name == 'c' ? 1 : MAX_TABS) : close_level(r, *name));
}

/* \left and \right with their delimiter. */
static bool fence(struct reader *r, bool left) {
  if (r->s == r->end || !strchr("()[].|", *r->s)) return false;
  r->s++;
  return left ? open_level(r, 'l', 0) : close_level(r, 'l');
}

/* \\[...] would be a distance, and \\* another command. */
static bool new_row(const struct reader *r, struct level *l) {
  const char *after = r->s;
  while (after < r->end && *after == ' ') after++;
  if (after < r->end && (*after == '[' || *after == '*')) return false;
  if (l->most_tabs == 0 || l->args > 0 || l->pending) return false;
  l->tabs = 0;
  l->superscript = l->subscript = l->primes = false;
  return true;
}

static bool command(struct reader *r) {
  struct level *l = &r->level[r->depth];
  const char *word = r->s;
  size_t len = strspn(word, LETTERS);
  if (len > (size_t)(r->end - word)) return false;
  if (len == 0) {
    if (r->s == r->end) return false;
    char c = *r->s++;
    if (c == '\\') return new_row(r, l);
    return strchr(",;:! ", c) ? l->args == 0 && !l->pending : (c == '{' || c == '}') && atom(l);
  }
  r->s += len;
  if (math_is(word, len, "begin") || math_is(word, len, "end")) return environment(r, *word == 'b');
  if (math_is(word, len, "left") || math_is(word, len, "right")) return fence(r, *word == 'l');
  const struct math_word *w = math_word(word, len);
  if (!w || l->text || (!w->symbol && l->pending) || !atom(l)) return false;
  l->args = w->args;
  l->text_next = w->role == MATH_TEXT;
  return true;
}

static bool tab(struct level *l) {
  bool ok = l->args == 0 && !l->pending && l->tabs++ < l->most_tabs;
  l->superscript = l->subscript = l->primes = false;
  return ok;
}

static bool next(struct reader *r) {
  struct level *l = &r->level[r->depth];
  unsigned char c = (unsigned char)*r->s++;
  switch (c) {
  case ' ':
    l->primes = false; /* x' ^2 has two superscripts */
    return true;
  case '\\':
    return command(r);
  case '{':
    return open_level(r, '{', 0);
  case '}':
    return close_level(r, '{');
  case '^':
    return superscript(l);
  case '_':
    l->primes = false; /* x'_1' has two superscripts */
    return script(l, &l->subscript);
  case '\'':
    return prime(l);
  case '&':
    return tab(l);
  default:
    return c > ' ' && c < 127 && !strchr("%#~$`", c) && atom(l);
  }
}

bool math_is_sane(const char *s, size_t len) {
  struct reader r = {.s = s, .end = s + len};
  while (r.s < r.end)
    if (!next(&r)) return false;
  return r.depth == 0 && !r.level[0].args && !r.level[0].pending;
}
