/* Whether a formula can be passed on to LaTeX, which stops at a brace, a script or an argument that is missing, and
   which would obey commands that are not of formulas.  A formula that is not understood here is shown as it is
   typed. */
#include <string.h>

#include "formula.h"

enum { MAX_LEVELS = 64 };

/* A group, \left...\right or an environment that is open. */
struct level {
  enum tex_kind opened;                /* TEX_OPEN, TEX_LEFT or TEX_BEGIN; TEX_END for the formula as a whole */
  const struct tex_environment *kind;  /* of TEX_BEGIN, else NULL */
  bool text;                           /* inside \text */
  bool superscript, subscript, primes; /* the last atom has them */
  bool pending;                        /* a script waits for its argument */
  int args;                            /* braced arguments that the last command waits for */
  bool text_next;                      /* the argument is that of \text */
  int cells;                           /* of the row, that are ended */
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

static bool open_level(struct reader *r, enum tex_kind opened, const struct tex_environment *kind) {
  struct level *l = &r->level[r->depth];
  if (r->depth + 1 == MAX_LEVELS || (opened != TEX_OPEN && (l->args > 0 || l->pending || l->text))) return false;
  r->level[++r->depth] =
      (struct level){.opened = opened, .kind = kind, .text = l->text || (l->args > 0 && l->text_next)};
  return true;
}

static bool close_level(struct reader *r, enum tex_kind opened, const struct tex_environment *kind) {
  struct level *l = &r->level[r->depth];
  if (l->opened != opened || l->kind != kind || l->args > 0 || l->pending) return false;
  l = &r->level[--r->depth];
  if (l->args > 0) {
    l->args--;
    return true;
  }
  return atom(l);
}

/* {name} after \begin or \end. */
static bool environment(struct reader *r, bool begin) {
  size_t len;
  const char *name = tex_braced(&len, r->s, r->end);
  const struct tex_environment *kind = name ? tex_environment(name, len) : NULL;
  if (!kind) return false;
  r->s = name + len + 1;
  return begin ? open_level(r, TEX_BEGIN, kind) : close_level(r, TEX_BEGIN, kind);
}

/* \left and \right with their delimiter. */
static bool fence(struct reader *r, bool left) {
  if (r->s == r->end || !strchr("()[].|", *r->s)) return false;
  r->s++;
  return left ? open_level(r, TEX_LEFT, NULL) : close_level(r, TEX_LEFT, NULL);
}

/* \\[...] would be a distance, and \\* another command. */
static bool new_row(const struct reader *r, struct level *l) {
  const char *after = r->s;
  while (after < r->end && *after == ' ') after++;
  if (after < r->end && (*after == '[' || *after == '*')) return false;
  if (!l->kind || l->args > 0 || l->pending) return false;
  l->cells = 0;
  l->superscript = l->subscript = l->primes = false;
  return true;
}

static bool command(struct level *l, const struct tex_word *w) {
  if (l->text || (!w->symbol && l->pending) || !atom(l)) return false;
  l->args = w->args;
  l->text_next = w->role == TEX_ROLE_TEXT;
  return true;
}

static bool new_cell(struct level *l) {
  bool ok = l->args == 0 && !l->pending && l->kind && ++l->cells < l->kind->most_cells;
  l->superscript = l->subscript = l->primes = false;
  return ok;
}

static bool next(struct reader *r) {
  struct level *l = &r->level[r->depth];
  const struct tex_token t = tex_read(r->s, r->end);
  r->s += t.len;
  switch (t.kind) {
  case TEX_BLANK:
    l->primes = false; /* x' ^2 has two superscripts */
    return true;
  case TEX_LETTER:
  case TEX_DIGIT:
  case TEX_SIGN:
  case TEX_BRACE:
    return atom(l);
  case TEX_OPEN:
    return open_level(r, TEX_OPEN, NULL);
  case TEX_CLOSE:
    return close_level(r, TEX_OPEN, NULL);
  case TEX_RAISED:
    return superscript(l);
  case TEX_LOWERED:
    l->primes = false; /* x'_1' has two superscripts */
    return script(l, &l->subscript);
  case TEX_PRIME:
    return prime(l);
  case TEX_CELL:
    return new_cell(l);
  case TEX_ROW:
    return new_row(r, l);
  case TEX_GAP:
    return l->args == 0 && !l->pending;
  case TEX_LEFT:
  case TEX_RIGHT:
    return fence(r, t.kind == TEX_LEFT);
  case TEX_BEGIN:
  case TEX_FINISH:
    return environment(r, t.kind == TEX_BEGIN);
  case TEX_WORD:
    return command(l, t.word);
  case TEX_END:
  case TEX_STRANGE:
    break;
  }
  return false;
}

bool formula_is_sane(const char *s, size_t len) {
  struct reader r = {.s = s, .end = s + len, .level = {{.opened = TEX_END}}};
  while (r.s < r.end)
    if (!next(&r)) return false;
  return r.depth == 0 && !r.level[0].args && !r.level[0].pending;
}
