/* Expressions in LaTeX by recursive descent over marks.  Recursion happens in latex_sum and in \sin without
   parentheses, which reads no sum, and is bounded by the levels of brackets. */
#include "latex_read.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "latex_impl.h"

static const struct expr *read_factor(struct latex_reader *r);
static const struct expr *read_applied(struct latex_reader *r, size_t at, enum expr_kind kind);

/* --- Marks in hand, mistakes, nodes --- */

static const struct mark *mark_in_hand(const struct latex_reader *r) {
  static const struct mark none = {.kind = TEX_END, .s = ""};
  return r->at < r->end ? &r->m[r->at] : &none;
}

void *latex_mistake(struct latex_reader *r, const char *fmt, ...) {
  char text[300];
  va_list args;
  va_start(args, fmt);
  vsnprintf(text, sizeof text, fmt, args);
  va_end(args);
  const struct mark *m = &r->m[r->at < r->end ? r->at : r->end - 1];
  diag_at(r->d, r->src, (size_t)(m->s - r->src->text) + (r->at < r->end ? 0 : m->len), "in the TeX: %s", text);
  return NULL;
}

struct expr *latex_node(struct latex_reader *r, enum expr_kind kind, size_t at, int n_args) {
  if (++r->n_nodes > EXPR_MAX_NODES) return latex_mistake(r, "a formula of more than %d nodes", EXPR_MAX_NODES);
  const struct mark *last = &r->m[r->at > 0 ? r->at - 1 : 0];
  struct expr *e = arena_alloc(r->arena, sizeof *e);
  e->kind = kind;
  e->span = (struct span){(size_t)(r->m[at].s - r->src->text), (size_t)(last->s - r->src->text) + last->len};
  e->n_args = n_args;
  if (n_args > 0) e->args = arena_alloc(r->arena, (size_t)n_args * sizeof *e->args);
  return e;
}

static const struct expr *node1(struct latex_reader *r, enum expr_kind kind, size_t at, const struct expr *a) {
  struct expr *e = a ? latex_node(r, kind, at, 1) : NULL;
  if (e) e->args[0] = a;
  return e;
}

static const struct expr *node2(struct latex_reader *r, enum expr_kind kind, size_t at, const struct expr *a,
                                const struct expr *b) {
  struct expr *e = a && b ? latex_node(r, kind, at, 2) : NULL;
  if (!e) return NULL;
  e->args[0] = a;
  e->args[1] = b;
  return e;
}

static bool accept_sign(struct latex_reader *r, char c) {
  if (!mark_is_sign(mark_in_hand(r), c)) return false;
  r->at++;
  return true;
}

static bool accept_kind(struct latex_reader *r, enum tex_kind kind) {
  if (mark_in_hand(r)->kind != kind) return false;
  r->at++;
  return true;
}

static bool accept_letter(struct latex_reader *r, char c) {
  const struct mark *m = mark_in_hand(r);
  return m->kind == TEX_LETTER && *m->s == c && ++r->at;
}

static bool accept_word(struct latex_reader *r, const char *name) {
  const struct mark *m = mark_in_hand(r);
  return m->kind == TEX_WORD && strcmp(m->word->name, name) == 0 && ++r->at;
}

/* How many marks a letter takes: 1, more for \mathrm{d} and \mathsf{T}; 0: it does not stand here. */
static size_t letter_length(const struct latex_reader *r, char c) {
  const struct mark *m = mark_in_hand(r);
  const bool font =
      mark_is_role(m, TEX_ROLE_FONT) && (strcmp(m->word->name, "mathrm") == 0 || strcmp(m->word->name, "mathsf") == 0);
  const bool braced = font && r->at + 3 < r->end && m[1].kind == TEX_OPEN && m[1].pair == r->at + 3;
  const size_t before = (size_t)font + braced;
  if (r->at + before >= r->end || m[before].kind != TEX_LETTER || *m[before].s != c) return 0;
  return before + 1 + braced;
}

/* --- Names --- */

bool latex_letter(struct text *out, const struct mark *m) {
  if (m->kind == TEX_LETTER) {
    text_add_char(out, *m->s);
    return true;
  }
  if (!mark_is_role(m, TEX_ROLE_LETTER) && !mark_is_role(m, TEX_ROLE_UPRIGHT)) return false;
  text_add(out, tex_letter_name(m->word));
  return true;
}

/* The letters of a name, with what stands over them behind: \tilde{k} is ktilde, \mathrm{prime} is prime. */
static bool read_base(struct text *out, struct latex_reader *r) {
  const struct mark *m = mark_in_hand(r);
  if (latex_letter(out, m)) return ++r->at;
  if (!mark_is_role(m, TEX_ROLE_ACCENT) && !mark_is_role(m, TEX_ROLE_FONT)) return false;
  r->at++;
  size_t close = mark_in_hand(r)->kind == TEX_OPEN ? mark_in_hand(r)->pair : r->at;
  bool braced = accept_kind(r, TEX_OPEN), plain = strcmp(m->word->name, "mathrm") == 0;
  if (!plain && m->word->role == TEX_ROLE_FONT) text_add(out, m->word->name);
  size_t n = 0;
  for (; r->at < r->end && (braced ? r->at < close : n == 0); n++, r->at++)
    if (!latex_letter(out, mark_in_hand(r))) break;
  if (n == 0 || (braced && r->at < close)) return latex_mistake(r, "a letter is expected here") != NULL;
  if (braced) r->at++;
  if (m->word->role == TEX_ROLE_ACCENT) text_add(out, m->word->name);
  return true;
}

static int bound_value(const struct latex_reader *r, const struct mark *m) {
  for (int i = 0; i < r->n_bound; i++)
    if (m->kind == TEX_LETTER && *m->s == r->bound[i].letter) return r->bound[i].value;
  return -1;
}

/* A number of at most so many digits. */
static int digits(struct latex_reader *r, int most) {
  int value = 0;
  for (int n = 0; n < most && mark_in_hand(r)->kind == TEX_DIGIT; n++, r->at++)
    value = 10 * value + (*mark_in_hand(r)->s - '0');
  return value;
}

/* One part of a subscript; an index letter gives its value and, in braces, k-1 the one before. */
static bool read_subscript_part(struct text *out, struct latex_reader *r, bool braced) {
  const struct mark *m = mark_in_hand(r);
  int value = bound_value(r, m);
  if (value >= 0) {
    r->at++;
    if (braced && accept_sign(r, '-')) {
      if (mark_in_hand(r)->kind != TEX_DIGIT) return latex_mistake(r, "a number is expected here");
      value -= digits(r, 4);
    }
    text_printf(out, "%d", value);
    return true;
  }
  if (m->kind == TEX_DIGIT || mark_is_sign(m, ':')) {
    text_add_char(out, *m->s);
    r->at++;
    return true;
  }
  if (mark_is_sign(m, ',') || mark_is_role(m, TEX_ROLE_TEXT)) {
    if (mark_is_sign(m, ',')) text_add_char(out, '_');
    for (size_t i = 0; i < m->len && mark_is_role(m, TEX_ROLE_TEXT); i++)
      if (char_is_letter(m->s[i]) || char_is_digit(m->s[i])) text_add_char(out, m->s[i]);
    r->at++;
    return true;
  }
  return read_base(out, r) || (!r->d->set && latex_mistake(r, "this is not read in a subscript"));
}

static bool read_subscript(struct text *out, struct latex_reader *r) {
  if (!accept_kind(r, TEX_LOWERED)) return true;
  const struct mark *open = mark_in_hand(r);
  if (!accept_kind(r, TEX_OPEN)) return read_subscript_part(out, r, false);
  while (r->at < open->pair)
    if (!read_subscript_part(out, r, true)) return false;
  r->at++;
  return true;
}

static int read_primes(struct latex_reader *r) {
  int n = 0;
  while (accept_kind(r, TEX_PRIME)) n++;
  return n;
}

/* A name as it is printed: letters, primes, subscript, primes. */
struct printed_name {
  struct text base, subscript;
  int inner, outer; /* primes before and behind the subscript */
  int dots;         /* over the letters: "dot" or "ddot" at the end of base */
};

static void printed_name_clear(struct printed_name *n) {
  text_clear(&n->base);
  text_clear(&n->subscript);
}

static bool read_printed_name(struct printed_name *n, struct latex_reader *r) {
  const struct mark *m = mark_in_hand(r);
  if (mark_is_role(m, TEX_ROLE_ACCENT))
    n->dots = (strcmp(m->word->name, "dot") == 0) + 2 * (strcmp(m->word->name, "ddot") == 0);
  if (!read_base(&n->base, r)) return false;
  n->inner = read_primes(r);
  if (!read_subscript(&n->subscript, r)) return false;
  n->outer = read_primes(r);
  return true;
}

/* The name in typed formulas, with so many primes before its subscript. */
static const char *typed_name(struct latex_reader *r, const struct printed_name *n, int primes) {
  OWNED(text) name = {0};
  text_add(&name, text_str(&n->base));
  for (int i = 0; i < primes; i++) text_add_char(&name, '\'');
  if (n->subscript.len > 0) text_printf(&name, "_%s", text_str(&n->subscript));
  return arena_strndup(r->arena, text_str(&name), name.len);
}

static enum latex_name kind_of(const struct latex_reader *r, const char *name) {
  return r->names->kind(r->names->context, name);
}

static const struct expr *symbol(struct latex_reader *r, size_t at, const char *name) {
  struct expr *e = latex_node(r, EXPR_SYM, at, 0);
  if (e) e->name = name;
  return e;
}

/* A function of what stands in parentheses behind it, else of the time. */
static const struct expr *call(struct latex_reader *r, size_t at, const char *name, int order) {
  const struct expr *arg;
  if (accept_sign(r, '(')) {
    arg = latex_sum(r);
    if (arg && !accept_sign(r, ')')) return latex_mistake(r, "the argument of %s ends here", name);
  } else {
    arg = symbol(r, at, "t");
  }
  struct expr *e = arg ? latex_node(r, EXPR_CALL, at, 1) : NULL;
  if (!e) return NULL;
  e->name = name;
  e->order = order;
  e->args[0] = arg;
  return e;
}

/* Indices as they stand in a subscript, "12", "1_2", "1:2_3:4", of a matrix. */
static const struct expr *entry(struct latex_reader *r, size_t at, const struct expr *of, const char *indices) {
  struct expr *e = of ? latex_node(r, EXPR_INDEX, at, 1) : NULL;
  if (!e) return NULL;
  e->args[0] = of;
  bool apart = strpbrk(indices, "_:") != NULL;
  if (strspn(indices, "0123456789_:") != strlen(indices))
    return latex_mistake(r, "\"%s\" are not the indices of an entry", indices);
  for (const char *s = indices; *s;) {
    char *next = (char *)s + 1;
    long first = apart ? strtol(s, &next, 10) : *s - '0', last = first;
    if (*next == ':') last = strtol(next + 1, &next, 10);
    if (e->n_index == 2 || next == s || first < 1 || last < first || last > EXPR_MAX_INDEX)
      return latex_mistake(r, "\"%s\" are not the indices of an entry", indices);
    e->index[2 * e->n_index] = (int)first;
    e->index[2 * e->n_index + 1] = (int)last;
    e->index_range[e->n_index++] = last > first || memchr(s, ':', (size_t)(next - s));
    s = next + (*next == '_');
  }
  return e;
}

/* M_{12} and H_{12}(t_c): an entry of what the letters name. */
static const struct expr *entry_by_name(struct latex_reader *r, size_t at, const struct printed_name *n) {
  const char *indices = text_str(&n->subscript);
  bool two = strlen(indices) == 2 && strspn(indices, "0123456789") == 2;
  if (n->inner || n->outer || (!two && !strchr(indices, ':'))) return NULL;
  const char *base = arena_strndup(r->arena, text_str(&n->base), n->base.len);
  enum latex_name kind = kind_of(r, base);
  if (kind == LATEX_UNKNOWN) return NULL;
  return entry(r, at, kind == LATEX_FUNCTION ? call(r, at, base, 0) : symbol(r, at, base), indices);
}

/* Dots that make no name of the paper's are derivatives, as primes are: \dot{x} is x'(t). */
static void read_dots(struct latex_reader *r, struct printed_name *n) {
  if (n->dots == 0 || kind_of(r, typed_name(r, n, 0)) != LATEX_UNKNOWN) return;
  n->base.len -= strlen(n->dots == 1 ? "dot" : "ddot");
  n->base.data[n->base.len] = '\0';
  n->inner += n->dots;
}

static enum expr_kind function_named(const char *name, size_t len) {
  static const struct {
    const char *name;
    enum expr_kind kind;
  } words[] = {
#define WORD(kind, name) {name, kind},
      EXPR_FUNCTIONS(WORD)
#undef WORD
          {"tan", EXPR_DIV}};
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (word_is(name, len, words[i].name)) return words[i].kind;
  return EXPR_SYM;
}

static const struct expr *resolve(struct latex_reader *r, size_t at, struct printed_name *n) {
  read_dots(r, n);
  const char *plain = typed_name(r, n, 0);
  enum expr_kind function = function_named(plain, strlen(plain));
  if (function != EXPR_SYM) return read_applied(r, at, function); /* \mathrm{tr} */
  const char *primed = n->inner > 0 && n->subscript.len > 0 && !n->outer ? typed_name(r, n, n->inner) : NULL;
  if (primed && kind_of(r, primed) == LATEX_VALUE) return symbol(r, at, primed);
  enum latex_name kind = kind_of(r, plain);
  if (kind == LATEX_FUNCTION) return call(r, at, plain, n->inner + n->outer);
  bool applied = kind == LATEX_VALUE && mark_is_sign(mark_in_hand(r), '(') && n->subscript.len == 2 &&
                 kind_of(r, text_str(&n->base)) == LATEX_FUNCTION;
  if (kind == LATEX_VALUE && !applied && n->inner + n->outer == 0) return symbol(r, at, plain);
  const struct expr *e = entry_by_name(r, at, n);
  if (e || r->d->set) return e;
  r->at = at;
  return latex_mistake(r,
                       kind == LATEX_VALUE ? "%s is no function, and this is read as a derivative"
                                           : "%s is neither defined nor a symbol",
                       plain);
}

/* A differential has a name of its own: dt_a, dZ_b. */
static bool read_differential(struct printed_name *n, struct latex_reader *r) {
  const struct mark *m = mark_in_hand(r);
  size_t at = r->at;
  if (m->kind != TEX_LETTER || *m->s != 'd') return false;
  r->at++;
  text_add(&n->base, "d");
  bool named = read_printed_name(n, r);
  if (named &&
      (kind_of(r, typed_name(r, n, 0)) != LATEX_UNKNOWN || kind_of(r, typed_name(r, n, n->inner)) != LATEX_UNKNOWN))
    return true;
  r->at = at;
  printed_name_clear(n);
  *n = (struct printed_name){.inner = 0};
  return false;
}

static const struct expr *read_name(struct latex_reader *r) {
  size_t at = r->at;
  OWNED(printed_name) n = {.inner = 0};
  const struct expr *e = NULL;
  if (read_differential(&n, r) || (!r->d->set && read_printed_name(&n, r))) e = resolve(r, at, &n);
  return e;
}

/* --- Operands --- */

static int read_exponent(struct latex_reader *r);

/* \times 10^{-3} behind a number belongs to it; 0: there is none. */
static int power_of_ten(struct latex_reader *r) {
  size_t at = r->at;
  const struct mark *m = &r->m[at];
  if (at + 4 < r->end && mark_is_role(m, TEX_ROLE_BINARY) && strcmp(m->word->name, "times") == 0 &&
      m[1].kind == TEX_DIGIT && *m[1].s == '1' && m[2].kind == TEX_DIGIT && *m[2].s == '0' && m[3].kind == TEX_RAISED) {
    r->at += 4;
    int exponent = read_exponent(r);
    if (exponent != 0) return exponent;
  }
  r->at = at;
  return 0;
}

/* Whether the mark that is so far on stands right behind the one before it, which is not so where a reading begins. */
static bool follows_closely(const struct latex_reader *r, size_t at) {
  return at < r->end && r->m[at].s == r->m[at - 1].s + 1;
}

/* A point belongs to a number where a digit follows. */
static void pass_number(struct latex_reader *r) {
  bool point = false;
  for (r->at++; follows_closely(r, r->at); r->at++) {
    const struct mark *m = mark_in_hand(r);
    const bool is_point = !point && mark_is_sign(m, '.') && follows_closely(r, r->at + 1) && m[1].kind == TEX_DIGIT;
    if (m->kind != TEX_DIGIT && !is_point) break;
    point = point || is_point;
  }
}

static const struct expr *read_number(struct latex_reader *r) {
  size_t at = r->at;
  const char *s = mark_in_hand(r)->s;
  pass_number(r);
  const size_t len = r->at - at;
  char power[16] = "";
  int exponent = power_of_ten(r);
  if (exponent != 0) snprintf(power, sizeof power, "e%d", exponent);
  struct expr *e = latex_node(r, EXPR_NUM, at, 0);
  if (!e) return NULL;
  char *name = arena_alloc(r->arena, len + sizeof power);
  memcpy(name, s, len);
  strcpy(name + len, power);
  e->name = name;
  return e;
}

static const struct expr *matrix(struct latex_reader *r, size_t at, int rows, int cols, const struct expr **entries) {
  struct expr *e = latex_node(r, EXPR_MATRIX, at, rows * cols);
  if (!e) return NULL;
  memcpy(e->args, entries, (size_t)(rows * cols) * sizeof *entries);
  e->rows = rows;
  e->cols = cols;
  return e;
}

enum { MAX_ENTRIES = 64 };

/* (a) and the row (a, b). */
static const struct expr *read_parentheses(struct latex_reader *r) {
  size_t at = r->at++;
  const struct expr *entries[MAX_ENTRIES];
  int n = 0;
  do {
    if (n == MAX_ENTRIES) return latex_mistake(r, "a row of more than %d entries", MAX_ENTRIES);
    if (!(entries[n++] = latex_sum(r))) return NULL;
  } while (accept_sign(r, ','));
  if (!accept_sign(r, ')')) return latex_mistake(r, "\")\" is expected here");
  return n == 1 ? node1(r, EXPR_PAREN, at, entries[0]) : matrix(r, at, 1, n, entries);
}

/* Between \begin{pmatrix} and \end; a comma before & sets entries apart and says nothing. */
static const struct expr *read_matrix(struct latex_reader *r) {
  const struct mark *begin = mark_in_hand(r);
  const struct tex_environment *kind = tex_environment(begin->s, begin->len);
  if (!kind) return latex_mistake(r, "{%.*s} is no matrix", (int)(begin->len < 40 ? begin->len : 40), begin->s);
  if (word_is(begin->s, begin->len, "cases"))
    return latex_mistake(r, "cases are read one by one: leave out what stands around one of them with \"...\"");
  size_t at = r->at++;
  const struct expr *entries[MAX_ENTRIES];
  int n = 0, rows = 1, cols = 0;
  for (;;) {
    if (n == MAX_ENTRIES) return latex_mistake(r, "a matrix of more than %d entries", MAX_ENTRIES);
    if (!(entries[n++] = latex_sum(r))) return NULL;
    accept_sign(r, ',');
    if (accept_kind(r, TEX_CELL)) continue;
    if (rows == 1) cols = n;
    if (n != rows * cols) return latex_mistake(r, "row %d has not the %d entries of row 1", rows, cols);
    if (!accept_kind(r, TEX_ROW)) break;
    rows++;
  }
  if (!accept_kind(r, TEX_FINISH)) return latex_mistake(r, "the matrix goes on with something that is not read");
  return matrix(r, at, rows, cols, entries);
}

static const struct expr *read_group(struct latex_reader *r, const struct expr *(*read)(struct latex_reader *)) {
  if (!accept_kind(r, TEX_OPEN)) return latex_mistake(r, "\"{\" is expected here");
  const struct expr *e = read(r);
  if (e && !accept_kind(r, TEX_CLOSE)) return latex_mistake(r, "\"}\" is expected here");
  return e;
}

/* A group, or one digit: \frac12, \sqrt2. */
static const struct expr *read_part(struct latex_reader *r) {
  const struct mark *m = mark_in_hand(r);
  if (m->kind != TEX_DIGIT) return read_group(r, latex_sum);
  struct expr *e = latex_node(r, EXPR_NUM, r->at++, 0);
  if (e) e->name = arena_strndup(r->arena, m->s, 1);
  return e;
}

/* The d of a derivative and the power at it, which is its order. */
static bool accept_d(struct latex_reader *r, int *order, bool of_time) {
  const size_t n = letter_length(r, 'd');
  r->at += n;
  if (n == 0 || (of_time && !accept_letter(r, 't'))) return false;
  *order = accept_kind(r, TEX_RAISED) ? read_exponent(r) : 1;
  return *order > 0;
}

/* {dE}{dt} and {d^2 E}{dt^2} behind \frac, where d and dt are no names of the paper's: the derivative of a function of
   the time.  NULL without a mistake: it is none. */
static const struct expr *read_rate(struct latex_reader *r, size_t at) {
  const size_t top = r->at, close = r->m[top < r->end ? top : at].pair;
  if (!accept_kind(r, TEX_OPEN) || kind_of(r, "d") != LATEX_UNKNOWN || kind_of(r, "dt") != LATEX_UNKNOWN)
    return r->at = top, NULL;
  int below = 0;
  OWNED(printed_name) n = {.inner = 0};
  r->at = close + 1;
  const bool of_time = accept_kind(r, TEX_OPEN) && accept_d(r, &below, true) && accept_kind(r, TEX_CLOSE);
  const size_t end = r->at;
  r->at = top + 1;
  int order = 0;
  if (!of_time || !accept_d(r, &order, false) || order != below || !read_printed_name(&n, r)) return r->at = top, NULL;
  n.outer += order;
  const bool bare = r->at == close; /* its argument, if any, stands behind the fraction */
  if (bare) r->at = end;
  const struct expr *e = resolve(r, at, &n);
  if (!e || bare) return e;
  if (r->at != close) return latex_mistake(r, "\"}\" is expected here");
  r->at = end;
  return e;
}

static const struct expr *read_fraction(struct latex_reader *r) {
  size_t at = r->at++;
  const struct expr *rate = read_rate(r, at);
  if (rate || r->d->set) return rate;
  const struct expr *top = read_part(r);
  return top ? node2(r, EXPR_DIV, at, top, read_part(r)) : NULL;
}

/* A group, and with a subscript an entry of it.  It holds one factor, for braces are not printed. */
static const struct expr *read_braced(struct latex_reader *r) {
  size_t at = r->at;
  const struct expr *e = read_group(r, read_factor);
  if (!e || mark_in_hand(r)->kind != TEX_LOWERED) return e;
  OWNED(text) indices = {0};
  return read_subscript(&indices, r) ? entry(r, at, e, text_str(&indices)) : NULL;
}

static const struct expr *read_bars(struct latex_reader *r) {
  if (r->bars++) return latex_mistake(r, "bars within bars are not read");
  size_t at = r->at++;
  const struct expr *e = latex_sum(r);
  r->bars = 0;
  if (e && !accept_sign(r, '|')) return latex_mistake(r, "the second bar is expected here");
  return node1(r, EXPR_ABS, at, e);
}

/* ^{\le 1} */
static bool accept_up_to_one(struct latex_reader *r) {
  enum relop op;
  if (!accept_kind(r, TEX_RAISED) || !accept_kind(r, TEX_OPEN)) return false;
  if (!mark_relation(&op, mark_in_hand(r)) || op != REL_LE) return false;
  r->at++;
  return mark_in_hand(r)->kind == TEX_DIGIT && digits(r, 4) == 1 && accept_kind(r, TEX_CLOSE);
}

/* _{O(x, y)^{\le 1}}, the names put behind what is there. */
static bool read_small(const struct expr **args, int *n, struct latex_reader *r) {
  if (!accept_kind(r, TEX_LOWERED) || !accept_kind(r, TEX_OPEN)) return false;
  if (!accept_letter(r, 'O') || !accept_sign(r, '(')) return false;
  do {
    if (*n == MAX_ENTRIES || !(args[(*n)++] = read_name(r))) return false;
  } while (accept_sign(r, ','));
  return accept_sign(r, ')') && accept_up_to_one(r) && accept_kind(r, TEX_CLOSE);
}

/* [f], and [f]_{O(x, y)^{\le 1}}: f to the first order in x and y. */
static const struct expr *read_brackets(struct latex_reader *r) {
  const struct expr *args[MAX_ENTRIES];
  int n = 0;
  size_t at = r->at++;
  if (!(args[n++] = latex_sum(r))) return NULL;
  if (mark_is_sign(mark_in_hand(r), ']') && (++r->at == r->end || r->m[r->at].kind != TEX_LOWERED))
    return node1(r, EXPR_PAREN, at, args[0]);
  if (!read_small(args, &n, r)) return latex_mistake(r, "brackets are read as [f] and [f]_{O(x, y)^{\\le 1}} alone");
  struct expr *e = latex_node(r, EXPR_FIRST_ORDER, at, n);
  if (e) memcpy(e->args, args, (size_t)n * sizeof *args);
  return e;
}

/* --- Functions --- */

enum expr_kind latex_function(const struct mark *m) {
  if (!mark_is_role(m, TEX_ROLE_TEXT) && !mark_is_role(m, TEX_ROLE_FUNCTION)) return EXPR_SYM;
  return m->word->args ? function_named(m->s, m->len) : function_named(m->word->name, strlen(m->word->name));
}

static bool is_sign_of(const struct mark *m) {
  bool word = (mark_is_role(m, TEX_ROLE_TEXT) || mark_is_role(m, TEX_ROLE_FUNCTION)) && m->word->args > 0;
  return word && (word_is(m->s, m->len, "sign") || word_is(m->s, m->len, "sgn"));
}

static bool starts_factor(const struct latex_reader *r) {
  const struct mark *m = mark_in_hand(r);
  static const enum tex_role roles[] = {TEX_ROLE_LETTER, TEX_ROLE_UPRIGHT, TEX_ROLE_ACCENT,
                                        TEX_ROLE_FONT,   TEX_ROLE_ROOT,    TEX_ROLE_FRACTION};
  for (size_t i = 0; i < sizeof roles / sizeof *roles; i++)
    if (mark_is_role(m, roles[i])) return true;
  return m->kind == TEX_LETTER || m->kind == TEX_DIGIT || m->kind == TEX_OPEN || m->kind == TEX_BEGIN ||
         mark_is_sign(m, '(') || mark_is_sign(m, '[') || (mark_is_sign(m, '|') && !r->bars) ||
         latex_function(m) != EXPR_SYM || is_sign_of(m);
}

static bool is_times(const struct mark *m) {
  return mark_is_role(m, TEX_ROLE_BINARY) &&
         (strcmp(m->word->name, "cdot") == 0 || strcmp(m->word->name, "times") == 0);
}

/* What a function is applied to: parentheses, else one factor that no other follows. */
static const struct expr *read_argument(struct latex_reader *r) {
  if (accept_sign(r, '(')) {
    const struct expr *e = latex_sum(r);
    return !e || accept_sign(r, ')') ? e : latex_mistake(r, "one argument in parentheses is read here");
  }
  if (latex_function(mark_in_hand(r)) != EXPR_SYM)
    return latex_mistake(r, "a function of a function needs parentheses");
  const struct expr *e = read_factor(r);
  const struct mark *next = mark_in_hand(r);
  if (e && (mark_is_sign(next, '/') || is_times(next) || (starts_factor(r) && latex_function(next) == EXPR_SYM)))
    return latex_mistake(r, "where the argument ends is doubtful: parentheses are needed");
  return e;
}

static const struct expr *read_hypot(struct latex_reader *r, size_t at) {
  const struct expr *a = accept_sign(r, '(') ? latex_sum(r) : NULL, *b = a && accept_sign(r, ',') ? latex_sum(r) : NULL;
  if (b && accept_sign(r, ')')) return node2(r, EXPR_HYPOT, at, a, b);
  return latex_mistake(r, "hypot has two arguments in parentheses");
}

/* Behind the name of the function. */
static const struct expr *read_applied(struct latex_reader *r, size_t at, enum expr_kind kind) {
  if (kind == EXPR_DIV && r->tangents) return r->at = at, latex_mistake(r, "a tangent within a tangent is not read");
  if (kind == EXPR_HYPOT) return read_hypot(r, at);
  int exponent = 0;
  if (accept_kind(r, TEX_RAISED) && (exponent = read_exponent(r)) < 1)
    return latex_mistake(r, "a power of a function is positive, \\sin^2(x)");
  r->tangents += kind == EXPR_DIV;
  const struct expr *arg = read_argument(r);
  r->tangents -= kind == EXPR_DIV; /* whose argument stands there twice: one within another doubles it each time */
  struct expr *e =
      (struct expr *)(kind == EXPR_DIV ? node2(r, kind, at, node1(r, EXPR_SIN, at, arg), node1(r, EXPR_COS, at, arg))
                                       : node1(r, kind, at, arg));
  if (!e || exponent == 0) return e;
  struct expr *power = latex_node(r, EXPR_POW, at, 1);
  if (!power) return NULL;
  power->args[0] = e;
  power->exponent = exponent;
  return power;
}

/* --- Factors, products, sums --- */

/* Past e^ and \mathrm{e}^ before a brace, where e is no name of the paper's. */
static bool accept_e(struct latex_reader *r) {
  const size_t n = letter_length(r, 'e');
  if (n == 0 || r->at + n + 1 >= r->end || kind_of(r, "e") != LATEX_UNKNOWN) return false;
  if (r->m[r->at + n].kind != TEX_RAISED || r->m[r->at + n + 1].kind != TEX_OPEN) return false;
  return r->at += n + 1;
}

/* sign(q) is eps; the statement eps q > 0 is its caller's to add. */
static const struct expr *read_sign_of(struct latex_reader *r) {
  size_t at = r->at++;
  if (r->signed_by) return latex_mistake(r, "one sign in a statement is read");
  if (!accept_sign(r, '(')) return latex_mistake(r, "the sign of what stands in parentheses is read");
  r->signed_by = latex_sum(r);
  if (!r->signed_by) return NULL;
  if (!accept_sign(r, ')')) return latex_mistake(r, "one argument in parentheses is read here");
  return r->sign = latex_sign(r, at);
}

static const struct expr *read_primary(struct latex_reader *r) {
  const struct mark *m = mark_in_hand(r);
  size_t at = r->at;
  if (accept_e(r)) return node1(r, EXPR_EXP, at, read_group(r, latex_sum));
  if (m->kind == TEX_DIGIT) return read_number(r);
  if (mark_is_sign(m, '(')) return read_parentheses(r);
  if (mark_is_sign(m, '[')) return read_brackets(r);
  if (mark_is_sign(m, '|')) return read_bars(r);
  if (m->kind == TEX_OPEN) return read_braced(r);
  if (m->kind == TEX_BEGIN) return read_matrix(r);
  if (mark_is_role(m, TEX_ROLE_FRACTION)) return read_fraction(r);
  if (mark_is_role(m, TEX_ROLE_ROOT)) {
    r->at++;
    return node1(r, EXPR_SQRT, at, read_part(r));
  }
  if (latex_function(m) != EXPR_SYM) return read_applied(r, r->at++, latex_function(m));
  if (is_sign_of(m)) return read_sign_of(r);
  if (starts_factor(r)) return read_name(r);
  return latex_mistake(
      r, r->at < r->end ? "\"%.*s\" does not stand here in a formula" : "something is missing behind this",
      (int)(m->len < 40 ? m->len : 40), m->s);
}

/* One digit behind ^, or several in braces, with a sign perhaps; 0 for what is none. */
static int read_exponent(struct latex_reader *r) {
  bool braced = accept_kind(r, TEX_OPEN), negative = braced && accept_sign(r, '-');
  int value = digits(r, braced ? 4 : 1);
  if (braced && !accept_kind(r, TEX_CLOSE)) return 0;
  return negative ? -value : value;
}

/* ^t, ^\top, ^{\mathsf{T}}, ^{\mathrm{T}} and, where T is no name of the paper's, ^T: the transpose. */
static bool accept_transpose(struct latex_reader *r) {
  const size_t at = r->at;
  const bool braced = accept_kind(r, TEX_OPEN);
  const size_t n = letter_length(r, 'T');
  if (n > 1 || (n == 1 && kind_of(r, "T") == LATEX_UNKNOWN))
    r->at += n;
  else if (!accept_letter(r, 't') && !accept_word(r, "top"))
    return r->at = at, false;
  return !braced || accept_kind(r, TEX_CLOSE) || (r->at = at, false);
}

static const struct expr *read_factor(struct latex_reader *r) {
  size_t at = r->at;
  const struct expr *e = read_primary(r);
  while (e && accept_kind(r, TEX_RAISED)) {
    if (accept_transpose(r)) {
      e = node1(r, EXPR_TRANSPOSE, at, e);
      continue;
    }
    int exponent = read_exponent(r);
    if (exponent == 0 && e->kind == EXPR_SYM && strcmp(e->name, "e") == 0)
      return latex_mistake(r, "e is a name of this paper's, so that this is no exponential: \\exp(x) is one");
    if (exponent == 0) return latex_mistake(r, "an exponent is an integer, ^t or ^T the transpose; a root is \\sqrt");
    struct expr *power = (struct expr *)node1(r, exponent == -1 ? EXPR_INV : EXPR_POW, at, e);
    if (power && exponent != -1) power->exponent = exponent;
    e = power;
  }
  if (e && e->kind == EXPR_MATRIX && e->rows == 1 && accept_kind(r, TEX_PRIME)) e = node1(r, EXPR_TRANSPOSE, at, e);
  if (e && mark_in_hand(r)->kind == TEX_PRIME)
    return latex_mistake(r, "what this prime means is not said: behind a row (a, b) it is the transpose");
  return e;
}

static const struct expr *read_product(struct latex_reader *r) {
  size_t at = r->at;
  const struct expr *e = read_factor(r);
  for (;;) {
    if (!e) return NULL;
    bool times = is_times(mark_in_hand(r));
    r->at += times;
    if (!times && mark_in_hand(r)->kind == TEX_DIGIT) return latex_mistake(r, "a number comes first in a product");
    if (!times && !starts_factor(r)) break;
    e = node2(r, EXPR_MUL, at, e, read_factor(r));
  }
  if (!accept_sign(r, '/')) return e;
  e = node2(r, EXPR_DIV, at, e, read_factor(r));
  if (e && (starts_factor(r) || mark_is_sign(mark_in_hand(r), '/')))
    return latex_mistake(r, "where the denominator of a / ends is doubtful: parentheses are needed");
  return e;
}

const struct expr *latex_sum(struct latex_reader *r) {
  if (++r->depth > EXPR_MAX_DEPTH + 1) return latex_mistake(r, "nested more than %d levels deep", EXPR_MAX_DEPTH);
  size_t at = r->at;
  bool negative = accept_sign(r, '-');
  const struct expr *e = read_product(r);
  if (negative && e) e = node1(r, EXPR_NEG, at, e);
  while (e && (mark_is_sign(mark_in_hand(r), '+') || mark_is_sign(mark_in_hand(r), '-'))) {
    enum expr_kind kind = mark_is_sign(mark_in_hand(r), '+') ? EXPR_ADD : EXPR_SUB;
    r->at++;
    e = node2(r, kind, at, e, read_product(r));
  }
  r->depth--;
  return e;
}
