/* The statements of a formula in LaTeX: where each ends, and the values of the indices in it. */
#include <stdlib.h>
#include <string.h>

#include "latex_impl.h"

/* The letters of an index and their values, or the name of a sign that is +1 and -1. */
struct family {
  char letter[2];
  int n_letters, value[16], n_values;
  const char *sign;
};

/* Marks that are one statement. */
struct part {
  size_t begin, end;
  struct family family; /* both an index and a sign, perhaps */
};

struct splitter {
  struct latex_reader r;
  struct part *part;
  size_t n, cap;
};

/* --- Families --- */

static bool put_value(struct family *f, int value) {
  if (f->n_values == 16) return false;
  f->value[f->n_values++] = value;
  return true;
}

/* All that \dots leaves out before the value, one above the other. */
static bool fill_in(struct family *f, int value) {
  const int n = f->n_values, *v = f->value;
  if (n == 0 || v[n - 1] >= value || (n > 1 && v[n - 1] != v[n - 2] + 1)) return false;
  for (int next = v[n - 1] + 1; next < value; next++)
    if (!put_value(f, next)) return false;
  return true;
}

static bool are_dots(const struct mark *m) {
  return mark_is_role(m, TEX_ROLE_ORDINARY) && strstr(m->word->name, "dots");
}

/* Digits with commas between them. */
static bool read_values(struct family *f, const struct mark *m, size_t at, size_t end) {
  for (bool dots = false; at < end; at += 2) {
    if (at + 1 < end && !mark_is_sign(&m[at + 1], ',')) return false;
    const int value = m[at].kind == TEX_DIGIT ? *m[at].s - '0' : 0;
    if (!dots && are_dots(&m[at])) {
      dots = true;
      continue;
    }
    if (m[at].kind != TEX_DIGIT || (dots && !fill_in(f, value)) || !put_value(f, value)) return false;
    dots = false;
    if (at + 1 == end) return true;
  }
  return false;
}

/* i = 1, 2 or i, j = 1, 2, 3 or \varepsilon = \pm 1. */
static bool read_family(struct family *f, struct latex_reader *r, size_t begin, size_t end) {
  const struct mark *m = r->m;
  *f = (struct family){.n_letters = 0};
  if (begin + 4 == end && mark_is_sign(&m[begin + 1], '=') && mark_is_role(&m[begin + 2], TEX_ROLE_BINARY) &&
      strcmp(m[begin + 2].word->name, "pm") == 0 && m[begin + 3].kind == TEX_DIGIT && *m[begin + 3].s == '1') {
    OWNED(text) name = {0};
    if (latex_letter(&name, &m[begin])) f->sign = arena_strndup(r->arena, text_str(&name), name.len);
    return f->sign != NULL;
  }
  size_t at = begin;
  do {
    if (at >= end || m[at].kind != TEX_LETTER || f->n_letters == 2) return false;
    f->letter[f->n_letters++] = *m[at++].s;
  } while (at < end && mark_is_sign(&m[at], ',') && at++);
  return at < end && mark_is_sign(&m[at], '=') && read_values(f, m, at + 1, end);
}

/* Whether a letter stands in a subscript of the part. */
static bool has_index(const struct mark *m, const struct part *p, char letter) {
  for (size_t i = p->begin; i + 1 < p->end; i++) {
    if (m[i].kind != TEX_LOWERED) continue;
    size_t last = m[i + 1].kind == TEX_OPEN ? m[i + 1].pair : i + 1;
    for (size_t k = i + 1; k <= last; k++)
      if (m[k].kind == TEX_LETTER && *m[k].s == letter) return true;
  }
  return false;
}

static bool has_sign(const struct mark *m, const struct part *p, const char *sign) {
  OWNED(text) name = {0};
  bool found = false;
  for (size_t i = p->begin; i < p->end && !found; i++) {
    text_reset(&name);
    found = latex_letter(&name, &m[i]) && strcmp(text_str(&name), sign) == 0;
  }
  return found;
}

static bool concerns(const struct mark *m, const struct part *p, const struct family *f) {
  if (f->sign) return has_sign(m, p, f->sign);
  for (int i = 0; i < f->n_letters; i++)
    if (has_index(m, p, f->letter[i])) return true;
  return false;
}

/* The statements before it that have no values yet take them. */
static bool give_family(struct splitter *s, const struct family *f) {
  bool any = false;
  for (size_t i = 0; i < s->n; i++) {
    struct part *p = &s->part[i];
    if ((f->sign ? p->family.sign != NULL : p->family.n_values > 0) || !concerns(s->r.m, p, f)) continue;
    const char *sign = p->family.sign;
    if (f->sign)
      p->family.sign = f->sign;
    else
      p->family = *f, p->family.sign = sign;
    any = true;
  }
  return any || latex_mistake(&s->r, "these are the values of an index that no statement before them has");
}

/* --- Where statements end --- */

static bool is_relation(const struct mark *m) {
  enum relop op;
  return mark_relation(&op, m);
}

static bool spells(const struct mark *m, size_t at, size_t end, const char *word) {
  size_t n = strlen(word);
  if (at + n > end) return false;
  for (size_t i = 0; i < n; i++)
    if (m[at + i].len != 1 || *m[at + i].s != word[i]) return false;
  return true;
}

/* How many marks of a separator stand here; 0: none. */
static size_t separator(const struct mark *m, size_t at, size_t end) {
  static const char *const words[] = {"if", "i.e.", "and", "for", "with"};
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (mark_is_text(&m[at], words[i])) return 1;
  if (spells(m, at, end, "i.e.")) return 4;
  if (spells(m, at, end, "...")) return 3;
  if (m[at].kind == TEX_ROW) return at + 1 == end || !is_relation(&m[at + 1]);
  return mark_is_sign(&m[at], ',') || mark_is_sign(&m[at], ';') || mark_is_role(&m[at], TEX_ROLE_SPACE) ||
         (mark_is_sign(&m[at], '.') && at + 1 == end);
}

/* What says nothing inside a statement: a line's end before a relation, "..." behind one. */
static size_t filler(const struct mark *m, size_t begin, size_t at, size_t end) {
  if (m[at].kind == TEX_ROW && at + 1 < end && is_relation(&m[at + 1])) return 1;
  return at > begin && is_relation(&m[at - 1]) && spells(m, at, end, "...") ? 3 : 0;
}

static bool holds_relation(const struct mark *m, size_t open) {
  for (size_t i = open + 1; i < m[open].pair; i++) {
    if (is_relation(&m[i])) return true;
    if (m[i].pair > i) i = m[i].pair;
  }
  return false;
}

/* Words, and no relation, say nothing. */
static bool is_aside(const struct mark *m, size_t open) {
  return mark_is_role(&m[open + 1], TEX_ROLE_TEXT) && latex_function(&m[open + 1]) == EXPR_SYM &&
         !holds_relation(m, open);
}

/* Parentheses around words, or around a relation, are no operand. */
static bool is_remark(const struct mark *m, size_t open) {
  return mark_is_sign(&m[open], '(') && (is_aside(m, open) || holds_relation(m, open));
}

static void put_part(struct splitter *s, size_t begin, size_t end) {
  if (begin == end) return;
  *SS_PUSH(s->part, s->n, s->cap) = (struct part){.begin = begin, .end = end};
}

static bool split(struct splitter *s, size_t begin, size_t end);

static bool read_remark(struct splitter *s, size_t open) {
  const struct mark *m = s->r.m;
  struct family f;
  s->r.at = open;
  if (is_aside(m, open)) return true;
  return read_family(&f, &s->r, open + 1, m[open].pair) ? give_family(s, &f) : split(s, open + 1, m[open].pair);
}

static bool split(struct splitter *s, size_t begin, size_t end) {
  const struct mark *m = s->r.m;
  size_t from = begin, at = begin;
  while (at < end) {
    size_t n = filler(m, from, at, end);
    if (n > 0) {
      at += n;
    } else if ((n = separator(m, at, end)) > 0) {
      put_part(s, from, at);
      from = at += n;
    } else if (is_remark(m, at)) {
      put_part(s, from, at);
      if (!read_remark(s, at)) return false;
      from = at = m[at].pair + 1;
    } else {
      at = (m[at].pair > at ? m[at].pair : at) + 1;
    }
  }
  put_part(s, from, end);
  return true;
}

/* --- One statement --- */

const struct expr *latex_sign(struct latex_reader *r, size_t at) {
  struct expr *e = latex_node(r, EXPR_SYM, at, 0);
  if (e) e->name = "eps";
  return e;
}

static bool is_another_eps(const struct expr *e, const void *sign) {
  return e != sign && e->kind == EXPR_SYM && strcmp(e->name, "eps") == 0;
}

/* eps q > 0, where the statement has a sign(q), which is eps in it. */
static const struct stmt *condition_of_sign(struct latex_reader *r, struct stmt *s) {
  struct stmt *c = arena_alloc(r->arena, sizeof *c);
  struct expr *product = latex_node(r, EXPR_MUL, r->at - 1, 2), *zero = latex_node(r, EXPR_NUM, r->at - 1, 0);
  const struct expr *eps = latex_sign(r, r->at - 1), **sides = arena_alloc(r->arena, 2 * sizeof *sides);
  bool another = stmt_any(s, is_another_eps, r->sign) || expr_any(r->signed_by, is_another_eps, NULL);
  if (s->range_var || another) return latex_mistake(r, "the sign is called eps, and eps stands here besides");
  if (!product || !zero || !eps) return NULL;
  product->args[0] = eps;
  product->args[1] = r->signed_by;
  zero->name = "0";
  sides[0] = product;
  sides[1] = zero;
  s->range_var = "eps";
  s->range_signs = true;
  *c = *s;
  c->n_sides = 2;
  c->sides = sides;
  c->ops = arena_alloc(r->arena, sizeof *c->ops);
  c->ops[0] = REL_GT;
  return c;
}

enum { MAX_SIDES = 16 };

static size_t past_filler(const struct latex_reader *r) {
  size_t at = r->at;
  for (size_t n; at < r->end && (n = filler(r->m, 0, at, r->end)) > 0;) at += n;
  return at;
}

static struct stmt *read_statement(struct latex_reader *r, const struct part *p) {
  struct stmt *s = arena_alloc(r->arena, sizeof *s);
  *s = (struct stmt){.kind = STMT_RELATION};
  s->sides = arena_alloc(r->arena, MAX_SIDES * sizeof *s->sides);
  s->ops = arena_alloc(r->arena, MAX_SIDES * sizeof *s->ops);
  s->range_var = p->family.sign;
  s->range_signs = p->family.sign != NULL;
  r->at = p->begin;
  r->end = p->end;
  r->depth = r->bars = 0;
  r->signed_by = NULL;
  for (;;) {
    if (s->n_sides == MAX_SIDES) return latex_mistake(r, "a chain of more than %d sides", MAX_SIDES);
    r->at = past_filler(r);
    if (!(s->sides[s->n_sides++] = latex_sum(r))) return NULL;
    r->at = past_filler(r);
    if (r->at == r->end || !mark_relation(&s->ops[s->n_sides - 1], &r->m[r->at])) break;
    r->at++;
  }
  if (r->at < r->end) return latex_mistake(r, "this does not go on a formula");
  if (s->n_sides < 2) return latex_mistake(r, "an expression alone says nothing: a statement is a relation");
  s->span = (struct span){s->sides[0]->span.begin, s->sides[s->n_sides - 1]->span.end};
  bool less = s->ops[0] == REL_LT || s->ops[0] == REL_LE;
  struct stmt *between = less ? stmt_between(r->arena, s) : NULL;
  return between ? between : s;
}

/* --- All of them --- */

struct list {
  const struct stmt **stmt;
  size_t n, cap;
};

/* What is printed, and the conditions of its signs. */
struct reading {
  struct list said, signs;
};

static bool append(struct list *out, const struct stmt *s) {
  if (!s) return false;
  *SS_PUSH(out->stmt, out->n, out->cap) = s;
  return true;
}

static bool put_statement(struct reading *out, struct latex_reader *r, const struct part *p) {
  struct stmt *s = read_statement(r, p);
  if (!s || (r->signed_by && !append(&out->signs, condition_of_sign(r, s)))) return false;
  return append(&out->said, s);
}

/* A statement for each value of its index, or each pair of values, the first letter's outermost. */
static bool put_part_statements(struct reading *out, struct latex_reader *r, const struct part *p) {
  const struct family *f = &p->family;
  int second = f->n_letters > 1 ? f->n_values : 1;
  r->n_bound = f->n_letters;
  if (f->n_values == 0) return put_statement(out, r, p);
  for (int i = 0; i < f->n_values; i++)
    for (int k = 0; k < second; k++) {
      r->bound[0] = (struct binding){f->letter[0], f->value[i]};
      r->bound[1] = (struct binding){f->letter[1], f->value[k]};
      if (!put_statement(out, r, p)) return false;
    }
  return true;
}

const struct stmt **latex_statements(size_t *n, struct arena *a, const struct latex_formula *f,
                                     const struct latex_names *names, struct diag *d) {
  struct marks marks = {0};
  struct reading read = {.said = {.n = 0}};
  bool ok = latex_marks(&marks, f, d);
  struct splitter s = {.r = {.arena = a, .src = f->src, .names = names, .d = d, .m = marks.m, .end = marks.n}};
  ok = ok && (marks.n > 0 || diag_at(d, f->src, f->tex.begin, "the TeX is empty")) && split(&s, 0, marks.n);
  for (size_t i = 0; ok && i < s.n; i++) ok = put_part_statements(&read, &s.r, &s.part[i]);
  for (size_t i = 0; ok && i < read.signs.n; i++) ok = append(&read.said, read.signs.stmt[i]);
  ok = ok && (read.said.n > 0 || diag_at(d, f->src, f->tex.begin, "the TeX states nothing"));
  const struct stmt **out = ok ? arena_alloc(a, read.said.n * sizeof *out) : NULL;
  if (ok) memcpy(out, read.said.stmt, read.said.n * sizeof *out);
  *n = ok ? read.said.n : 0;
  free(marks.m);
  free(s.part);
  free(read.said.stmt);
  free(read.signs.stmt);
  return out;
}
