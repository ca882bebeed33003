/* LaTeX as marks: blanks, comments and sizes of brackets dropped, readings put in place of what they read, brackets
   paired. */
#include <stdlib.h>
#include <string.h>

#include "latex_impl.h"

static size_t offset(const struct source *src, const char *s) {
  return (size_t)(s - src->text);
}

/* \vert, \lvert and \rvert are bars. */
bool mark_is_sign(const struct mark *m, char c) {
  return m->kind == TEX_WORD ? c == '|' && strcmp(m->word->text, "|") == 0 : m->kind == TEX_SIGN && *m->s == c;
}

bool mark_is_role(const struct mark *m, enum tex_role role) {
  return m->kind == TEX_WORD && m->word->role == role;
}

/* \text{word}, with or without blanks around the word. */
bool mark_is_text(const struct mark *m, const char *word) {
  if (!mark_is_role(m, TEX_ROLE_TEXT)) return false;
  const char *s = m->s;
  size_t len = m->len;
  while (len > 0 && *s == ' ') s++, len--;
  while (len > 0 && s[len - 1] == ' ') len--;
  return word_is(s, len, word);
}

bool mark_relation(enum relop *op, const struct mark *m) {
  static const struct {
    const char *name;
    enum relop op;
  } relations[] = {{"=", REL_EQ},    {"<", REL_LT},     {">", REL_GT},          {"\\equiv", REL_EQ},
                   {"\\le", REL_LE}, {"\\leq", REL_LE}, {"\\ge", REL_GE},       {"\\geq", REL_GE},
                   {"\\lt", REL_LT}, {"\\gt", REL_GT},  {"\\leqslant", REL_LE}, {"\\geqslant", REL_GE}};
  if (m->kind != TEX_SIGN && m->kind != TEX_WORD) return false;
  for (size_t i = 0; i < sizeof relations / sizeof *relations; i++)
    if (word_is(m->s, m->len, relations[i].name)) {
      *op = relations[i].op;
      return true;
    }
  return false;
}

/* --- Characters to marks --- */

static bool add(struct marks *out, struct mark m, const struct source *src, struct diag *d) {
  if (out->n == LATEX_MAX_MARKS)
    return diag_at(d, src, offset(src, m.s), "a formula in LaTeX of more than %d tokens", LATEX_MAX_MARKS);
  *SS_PUSH(out->m, out->n, out->cap) = m;
  return true;
}

/* Past blanks, ends of lines, and lines that are comments. */
static const char *skip_blanks(const char *s, const char *end) {
  bool new_line = false;
  for (; s < end; s++) {
    if (*s == '#' && new_line)
      while (s + 1 < end && *s != '\n') s++;
    if (*s == '\n')
      new_line = true;
    else if (*s != ' ' && *s != '\t' && *s != '\r' && !(*s == '#' && new_line))
      break;
  }
  return s;
}

/* Whether a token takes the word in the braces behind it along. */
static bool takes_word(const struct tex_token *t) {
  return t->kind == TEX_BEGIN || t->kind == TEX_FINISH ||
         (t->kind == TEX_WORD && t->word->args == 1 &&
          (t->word->role == TEX_ROLE_TEXT || t->word->role == TEX_ROLE_FUNCTION));
}

/* The environment that only sets lines below each other says nothing. */
static bool is_layout(const struct mark *m) {
  return (m->kind == TEX_BEGIN || m->kind == TEX_FINISH) && word_is(m->s, m->len, "aligned");
}

static bool read_token(struct marks *out, const char **s, const char *end, const struct source *src, struct diag *d) {
  struct tex_token t = tex_read(*s, end);
  const char *next = t.s + t.len;
  struct mark m = {.kind = t.kind, .s = t.s, .len = t.len, .word = t.word};
  if (takes_word(&t)) {
    next = skip_blanks(next, end);
    m.s = tex_braced(&m.len, next, end);
    if (!m.s) return diag_at(d, src, offset(src, t.s), "%.*s has no word in braces behind it", (int)t.len, t.s);
    next = m.s + m.len + 1;
  }
  *s = next;
  return t.kind == TEX_GAP || t.kind == TEX_LEFT || t.kind == TEX_RIGHT || is_layout(&m) || add(out, m, src, d);
}

static bool read_span(struct marks *out, const struct source *src, struct span where, struct diag *d) {
  const char *end = src->text + where.end;
  for (const char *s = src->text + where.begin; (s = skip_blanks(s, end)) < end;)
    if (!read_token(out, &s, end, src, d)) return false;
  return true;
}

/* --- Readings --- */

static bool same_mark(const struct mark *a, const struct mark *b) {
  return a->kind == b->kind && a->len == b->len && a->word == b->word && memcmp(a->s, b->s, a->len) == 0;
}

static bool stands_at(const struct marks *out, size_t at, const struct marks *piece) {
  if (at + piece->n > out->n) return false;
  for (size_t i = 0; i < piece->n; i++)
    if (!same_mark(&out->m[at + i], &piece->m[i])) return false;
  return true;
}

static bool replace(struct marks *out, const struct marks *printed, const struct marks *read, size_t at_source,
                    const struct source *src, struct diag *d) {
  size_t found = 0, at = 0;
  for (size_t i = 0; i < out->n && printed->n > 0; i++)
    if (stands_at(out, i, printed)) {
      at = i;
      found++;
    }
  if (found != 1)
    return diag_at(d, src, at_source,
                   found ? "what is read in another way stands %zu times in the TeX; give a longer piece of it"
                         : "what is read in another way does not stand in the TeX",
                   found);
  struct marks all = {0};
  bool ok = true;
  for (size_t i = 0; ok && i < at; i++) ok = add(&all, out->m[i], src, d);
  for (size_t i = 0; ok && i < read->n; i++) ok = add(&all, read->m[i], src, d);
  for (size_t i = at + printed->n; ok && i < out->n; i++) ok = add(&all, out->m[i], src, d);
  free(out->m);
  *out = all;
  return ok;
}

static bool apply(struct marks *out, const struct latex_reading *r, const struct source *src, struct diag *d) {
  struct marks printed = {0}, read = {0};
  bool ok = read_span(&printed, src, r->printed, d) && read_span(&read, src, r->read, d) &&
            replace(out, &printed, &read, r->printed.begin, src, d);
  free(printed.m);
  free(read.m);
  return ok;
}

static bool knows_all(const struct marks *out, const struct source *src, struct diag *d) {
  for (size_t i = 0; i < out->n; i++) {
    const struct mark *m = &out->m[i];
    if (m->kind == TEX_STRANGE || m->kind == TEX_BRACE)
      return diag_at(
          d, src, offset(src, m->s),
          "\"%.*s\" is not of the LaTeX that is read as a formula; \"reads: PIECE as TEX\" says it in other TeX",
          (int)(m->len < 40 ? m->len : 40), m->s);
  }
  return true;
}

/* --- Brackets --- */

static bool opens(const struct mark *m) {
  return mark_is_sign(m, '(') || mark_is_sign(m, '[') || m->kind == TEX_OPEN || m->kind == TEX_BEGIN;
}

static bool closes(const struct mark *m) {
  return mark_is_sign(m, ')') || mark_is_sign(m, ']') || m->kind == TEX_CLOSE || m->kind == TEX_FINISH;
}

static bool are_partners(const struct mark *open, const struct mark *close) {
  if (open->kind == TEX_BEGIN)
    return close->kind == TEX_FINISH && open->len == close->len && memcmp(open->s, close->s, open->len) == 0;
  if (open->kind == TEX_OPEN) return close->kind == TEX_CLOSE;
  return mark_is_sign(close, *open->s == '(' ? ')' : ']');
}

static bool pair_brackets(struct marks *out, const struct source *src, struct diag *d) {
  size_t open[EXPR_MAX_DEPTH], n = 0;
  for (size_t i = 0; i < out->n; i++) {
    struct mark *m = &out->m[i];
    if (opens(m)) {
      if (n == EXPR_MAX_DEPTH)
        return diag_at(d, src, offset(src, m->s), "brackets nested more than %d levels deep", EXPR_MAX_DEPTH);
      open[n++] = i;
    } else if (closes(m)) {
      if (n == 0 || !are_partners(&out->m[open[n - 1]], m))
        return diag_at(d, src, offset(src, m->s),
                       n ? "this does not close the last bracket" : "this closes no bracket");
      m->pair = open[--n];
      out->m[m->pair].pair = i;
    }
  }
  if (n == 0) return true;
  return diag_at(d, src, offset(src, out->m[open[n - 1]].s), "this bracket is not closed");
}

/* Outside matrices & only lines formulas up. */
static void drop_alignment(struct marks *out) {
  size_t kept = 0;
  int matrices = 0;
  for (size_t i = 0; i < out->n; i++) {
    matrices += (out->m[i].kind == TEX_BEGIN) - (out->m[i].kind == TEX_FINISH);
    if (out->m[i].kind != TEX_CELL || matrices > 0) out->m[kept++] = out->m[i];
  }
  out->n = kept;
}

bool latex_marks(struct marks *out, const struct latex_formula *f, struct diag *d) {
  if (f->n_readings > LATEX_MAX_READINGS)
    return diag_at(d, f->src, f->readings[LATEX_MAX_READINGS].printed.begin, "more than %d readings of a formula",
                   LATEX_MAX_READINGS);
  if (!read_span(out, f->src, f->tex, d)) return false;
  for (size_t i = 0; i < f->n_readings; i++)
    if (!apply(out, &f->readings[i], f->src, d)) return false;
  drop_alignment(out);
  return knows_all(out, f->src, d) && pair_brackets(out, f->src, d);
}
