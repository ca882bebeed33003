/* A browser does not break a formula, so that one is set in pieces, which end where TeX would break it. */
#include <string.h>

#include "formula.h"

/* What is open: groups, which must close within a piece, and parentheses, which should. */
struct depth {
  int groups, parentheses;
};

static void count(struct depth *d, const struct tex_token *t) {
  enum tex_kind k = t->kind;
  char sign = k == TEX_SIGN ? *t->s : k == TEX_BRACE ? t->s[1] : '\0';
  enum tex_role role = t->word ? t->word->role : TEX_ROLE_ORDINARY;
  d->groups +=
      (k == TEX_OPEN || k == TEX_LEFT || k == TEX_BEGIN) - (k == TEX_CLOSE || k == TEX_RIGHT || k == TEX_FINISH);
  d->parentheses += (sign == '(' || sign == '[' || sign == '{' || role == TEX_ROLE_OPEN) -
                    (sign == ')' || sign == ']' || sign == '}' || role == TEX_ROLE_CLOSE);
}

bool formula_breaks_before(const struct tex_token *t) {
  return t->word ? t->word->role == TEX_ROLE_BINARY : t->kind == TEX_SIGN && strchr("=<>+-", *t->s);
}

static bool takes_room(const struct tex_token *t) {
  return t->kind != TEX_BLANK && t->kind != TEX_OPEN && t->kind != TEX_CLOSE && t->kind != TEX_RAISED &&
         t->kind != TEX_LOWERED;
}

const char *formula_piece_end(const char *s, const char *end) {
  enum { LONG_PIECE = 24 };
  struct depth d = {0, 0};
  int signs = 0;
  bool follows = false, script = true; /* nothing is broken off before the first token either */
  for (const char *p = s; p < end;) {
    const struct tex_token t = tex_read(p, end);
    count(&d, &t);
    if (d.groups == 0 && d.parentheses == 0 && !script) {
      if (t.kind == TEX_SIGN && *p == ',') return p + 1;
      if (t.word && t.word->role == TEX_ROLE_SPACE) return p;
      if (signs >= LONG_PIECE && follows && formula_breaks_before(&t)) return p;
    }
    if (takes_room(&t)) {
      signs++;
      follows = !formula_breaks_before(&t) && !(t.kind == TEX_SIGN && strchr("([", *p));
    }
    script = t.kind == TEX_RAISED || t.kind == TEX_LOWERED;
    p += t.len + (t.kind == TEX_LEFT || t.kind == TEX_RIGHT); /* with the fence */
  }
  return end;
}
