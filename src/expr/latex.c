/* Formulas as LaTeX, close enough to print that a reader can lay them beside the paper's own.
   Quotients become \frac and need no parentheses as factors; built-in functions always show theirs, so that sin x^2
   cannot be misread; parentheses as written are kept except around a whole numerator or denominator. */
#include <string.h>

#include "base/tex.h"
#include "expr_impl.h"

#define LETTERS "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"

/* ---- names */

/* The command, without its backslash, of the Greek letter that the first len bytes of s name, or NULL. */
static const char *greek(const char *s, size_t len) {
  if (len == 3 && !memcmp(s, "eps", 3)) return "varepsilon";
  const struct tex_word *w = tex_word(s, len);
  bool letter = w && w->symbol && (w->role == TEX_ROLE_LETTER || w->role == TEX_ROLE_UPRIGHT);
  return letter && word_is(s, len, tex_letter_name(w)) ? w->name : NULL;
}

/* A base of letters: one letter, a Greek one, a differential of either (dt, dZ, dchi), or an upright word. */
static void base_latex(struct text *out, const char *s, size_t len) {
  const char *letter = greek(s, len), *differential = len > 1 && s[0] == 'd' ? greek(s + 1, len - 1) : NULL;
  if (letter)
    text_printf(out, "\\%s", letter);
  else if (differential)
    text_printf(out, "d\\%s", differential);
  else if (len <= 1 || (len == 2 && s[0] == 'd'))
    text_add_n(out, s, len);
  else
    text_printf(out, "\\mathrm{%.*s}", (int)len, s);
}

/* A base that may end in tilde or bar, which go on top. */
static void accented_latex(struct text *out, const char *s, size_t len) {
  static const char *const accents[] = {"tilde", "bar"};
  for (size_t i = 0; i < sizeof accents / sizeof *accents; i++) {
    size_t n = strlen(accents[i]);
    if (len <= n || memcmp(s + len - n, accents[i], n) != 0) continue;
    text_printf(out, "\\%s{", accents[i]);
    base_latex(out, s, len - n);
    text_add(out, "}");
    return;
  }
  base_latex(out, s, len);
}

/* A part of a subscript: r1 and 1b as they are, words of three letters and more upright, unless they are Greek. */
static void subscript_latex(struct text *out, const char *s, size_t len) {
  size_t letters = strspn(s, LETTERS);
  if (letters > len) letters = len;
  const char *letter = greek(s, letters);
  if (letter)
    text_printf(out, letters < len ? "\\%s %.*s" : "\\%s%.*s", letter, (int)(len - letters), s + letters);
  else
    text_printf(out, letters >= 3 ? "\\mathrm{%.*s}" : "%.*s", (int)len, s);
}

void name_latex(struct text *out, const char *name) {
  size_t base = strspn(name, LETTERS);
  accented_latex(out, name, base);
  for (const char *s = name + base; *s; s++)
    if (*s == '\'') text_add(out, "'");
  bool any = false;
  for (const char *s = name + base; *s;) {
    size_t len = strcspn(s, "_'");
    if (len > 0) {
      text_add(out, any ? "," : "_{");
      subscript_latex(out, s, len);
      any = true;
    }
    s += len + strspn(s + len, "_'");
  }
  if (any) text_add(out, "}");
}

/* A name to which an exponent or a prime is going to be attached: TeX refuses a second superscript. */
static void name_latex_closed(struct text *out, const char *name, bool superscript) {
  bool brace = superscript && strchr(name, '\'');
  if (brace) text_add(out, "{");
  name_latex(out, name);
  if (brace) text_add(out, "}");
}

/* ---- expressions */

static bool is_trigonometric(const struct expr *e) {
  return e->kind == EXPR_SIN || e->kind == EXPR_COS || e->kind == EXPR_COT || e->kind == EXPR_SINC;
}

/* \sin^{2}(x), the usual place of the exponent; \sin^{-1} would be read as the arc sine. */
static bool raised_inside(const struct expr *e) {
  return e->kind == EXPR_POW && e->exponent > 0 && is_trigonometric(e->args[0]);
}

/* Good as a factor, not as a base: a fraction, a function, and what already carries a superscript. */
static bool takes_no_superscript(const struct expr *e) {
  if (e->kind == EXPR_NUM) return strpbrk(e->name, "eE") != NULL;
  return e->kind == EXPR_DIV || (expr_function_name(e->kind) && e->kind != EXPR_SQRT && e->kind != EXPR_ABS);
}

static enum level level(const struct expr *e) {
  return takes_no_superscript(e) ? LEVEL_POWER : expr_level(e);
}

static bool needs_parentheses(const struct expr *e, int i) {
  if (e->kind == EXPR_DIV || raised_inside(e)) return false;
  enum level wanted = e->kind == EXPR_INV || e->kind == EXPR_TRANSPOSE ? LEVEL_POSTFIX : expr_operand_level(e->kind, i);
  return level(e->args[i]) < wanted;
}

/* A dot where juxtaposed factors would run together: before a number, and in 2 * 1/3. */
static const char *times(const struct expr *e) {
  const struct expr *left = e->args[0], *right = e->args[1];
  if (left->kind == EXPR_MUL) left = left->args[1];
  bool dot = expr_begins_with_digit(right) || (right->kind == EXPR_DIV && expr_begins_with_digit(left));
  return dot ? " \\cdot " : " \\, ";
}

static void number_latex(struct text *out, const char *s) {
  size_t mantissa = strcspn(s, "eE");
  text_add_n(out, s, mantissa);
  if (!s[mantissa]) return;
  const char *exponent = s + mantissa + 1;
  text_printf(out, " \\times 10^{%s}", exponent + (*exponent == '+'));
}

static void call_latex(struct text *out, const struct expr *e) {
  name_latex_closed(out, e->name, e->order > 0);
  if (e->order > 3)
    text_printf(out, "^{(%d)}", e->order);
  else
    text_add_n(out, "'''", (size_t)e->order);
}

static void indices_latex(struct text *out, const struct expr *e) {
  for (int k = 0; k < e->n_index; k++) {
    text_printf(out, "%s%d", k == 0 ? "}_{" : ",", e->index[2 * k]);
    if (e->index_range[k]) text_printf(out, ":%d", e->index[2 * k + 1]);
  }
  text_add(out, "}");
}

/* The name of a function, and the exponent that stands there; those that LaTeX has stand in the table of its
   commands. */
static void function_latex(struct text *out, const struct expr *e, const struct expr *parent) {
  const char *name = expr_function_name(e->kind);
  text_printf(out, tex_word(name, strlen(name)) ? "\\%s" : "\\operatorname{%s}", name);
  if (parent && raised_inside(parent)) text_printf(out, "^{%d}", parent->exponent);
}

static const struct expr_signs call_signs = {"\\left(", ", ", .behind = "\\right)"};

static const struct expr_signs signs[EXPR_INDEX + 1] = {
    [EXPR_NEG] = {.before = "-"},
    [EXPR_ADD] = {.between = " + "},
    [EXPR_SUB] = {.between = " - "},
    [EXPR_DIV] = {"\\frac{", "}{", .behind = "}"},
    [EXPR_PAREN] = {"\\left(", .behind = "\\right)"},
    [EXPR_SQRT] = {"\\sqrt{", .behind = "}"},
    [EXPR_ABS] = {"\\left|", .behind = "\\right|"},
    [EXPR_INV] = {"{", .behind = "}^{-1}"},
    [EXPR_TRANSPOSE] = {"{", .behind = "}^{\\mathsf{T}}"},
    /* [f] with the small symbols and their order at its foot */
    [EXPR_FIRST_ORDER] = {"\\left[ ", ", ", " \\right]_{O(", ")^{\\le 1}}"},
    [EXPR_MATRIX] = {"\\begin{pmatrix} ", " & ", " \\\\ ", " \\end{pmatrix}"},
    [EXPR_INDEX] = {.before = "{"}};

/* What e itself contributes before operand i, parentheses of the operands apart. */
static void symbols_latex(struct text *out, const struct expr *e, int i, const struct expr *parent) {
  bool first = i == 0, last = i == e->n_args, function = expr_function_name(e->kind) && !signs[e->kind].before;
  if (e->kind == EXPR_PAREN && parent && parent->kind == EXPR_DIV) return;
  if (e->kind == EXPR_NUM) number_latex(out, e->name);
  if (e->kind == EXPR_SYM) name_latex_closed(out, e->name, parent && parent->kind == EXPR_POW);
  if (first && e->kind == EXPR_CALL) call_latex(out, e);
  if (first && function) function_latex(out, e, parent);
  expr_write_signs(out, function || e->kind == EXPR_CALL ? &call_signs : &signs[e->kind], e, i);
  if (i == 1 && e->kind == EXPR_MUL) text_add(out, times(e));
  if (last && e->kind == EXPR_POW && !raised_inside(e)) text_printf(out, "^{%d}", e->exponent);
  if (last && e->kind == EXPR_INDEX) indices_latex(out, e);
}

static void latex_between(struct text *out, const struct expr *e, int i, const struct expr *parent) {
  if (i > 0 && needs_parentheses(e, i - 1)) text_add(out, "\\right)");
  symbols_latex(out, e, i, parent);
  if (i < e->n_args && needs_parentheses(e, i)) text_add(out, "\\left(");
}

static void plain_between(struct text *out, const struct expr *e, int i, const struct expr *parent) {
  if (parent && expr_is_understood(parent)) return;
  if (!expr_is_understood(e))
    latex_between(out, e, i, parent);
  else if (i == 0)
    call_latex(out, e);
}

void expr_latex(struct text *out, const struct expr *e) {
  expr_write(out, e, latex_between);
}

bool expr_latex_of(struct text *out, const char *expression) {
  LOCAL(arena, a);
  OWNED(source) s;
  source_from_string(&s, expression, expression);
  const struct expr *e = expr_parse(&a, &s, (struct span){0, s.len}, NULL);
  if (e) expr_latex(out, e);
  return e != NULL;
}

/* ---- statements */

static void range_latex(struct text *out, const struct stmt *s) {
  text_add(out, " \\quad \\text{for } ");
  name_latex(out, s->range_var);
  text_add(out, " \\in ");
  if (s->range_signs) {
    text_add(out, "\\lbrace +1, -1 \\rbrace");
    return;
  }
  text_add(out, s->lo_closed ? "\\left[" : "\\left(");
  expr_latex(out, s->range_lo);
  text_add(out, ", ");
  expr_latex(out, s->range_hi);
  text_add(out, s->hi_closed ? "\\right]" : "\\right)");
}

static void applied_latex(struct text *out, const char *name, const char *param) {
  name_latex(out, name);
  if (!param) return;
  text_add(out, "\\left(");
  name_latex(out, param);
  text_add(out, "\\right)");
}

static void write_stmt(struct text *out, const struct stmt *s, expr_between *between) {
  static const char *const symbol[] = {
      [REL_EQ] = " = ", [REL_LT] = " < ", [REL_LE] = " \\le ", [REL_GT] = " > ", [REL_GE] = " \\ge "};
  switch (s->kind) {
  case STMT_DEFINE:
    applied_latex(out, s->name, s->param);
    text_add(out, " = ");
    expr_write(out, s->sides[0], between);
    break;
  case STMT_RELATION:
    for (int i = 0; i < s->n_sides; i++) {
      if (i > 0) text_add(out, symbol[s->ops[i - 1]]);
      expr_write(out, s->sides[i], between);
    }
    if (s->range_var) range_latex(out, s);
    break;
  case STMT_ROOT:
    name_latex(out, s->name);
    text_printf(out, " = \\text{the %s positive root of } ", s->largest ? "largest" : "smallest");
    expr_write(out, s->sides[0], between);
    break;
  case STMT_TRAJECTORY:
    text_add(out, "\\text{trajectory } ");
    for (int i = 0; i < s->n_names; i++) {
      if (i > 0) text_add(out, ", ");
      applied_latex(out, s->names[i], s->params[i]);
    }
    break;
  }
}

void stmt_latex(struct text *out, const struct stmt *s) {
  write_stmt(out, s, latex_between);
}

void stmt_latex_plain(struct text *out, const struct stmt *s) {
  write_stmt(out, s, plain_between);
}
