/* Text with formulas in it, for Markdown and for LaTeX.  What a report quotes was written by others: a bar must not end a
   table's cell, an underscore must not begin italics, and a percent sign must not hide the rest of a line. */
#include <string.h>

#include "report_impl.h"

#define LETTERS "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"

bool report_is_failure(const struct finding *f) {
  return f->verdict == VERDICT_REFUTED || f->verdict == VERDICT_CONDITIONAL;
}

/* --- Mathematics that can be passed on --- */

/* The commands that formulas are made of. */
static bool is_math_command(const char *s, size_t len) {
  static const char *const words =
      " alpha beta gamma delta epsilon varepsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau upsilon "
      "phi "
      "varphi chi psi omega Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega frac sqrt left right begin end "
      "text mathrm mathsf mathcal mathbf operatorname quad qquad cdot times tilde bar hat dot ddot sin cos tan cot det "
      "dots ldots cdots equiv neq ne le leq ge geq lt gt in to rightarrow Rightarrow pm mp infty circ vert prime sum "
      "lbrace rbrace ";
  char padded[24];
  if (len + 3 > sizeof padded) return false;
  padded[0] = ' ';
  memcpy(padded + 1, s, len);
  memcpy(padded + 1 + len, " ", 2);
  return strstr(words, padded) != NULL;
}

static bool is_environment(const char *s, size_t len) {
  static const char *const names[] = {"pmatrix", "bmatrix", "matrix", "cases", "aligned"};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (strlen(names[i]) == len && memcmp(names[i], s, len) == 0) return true;
  return false;
}

/* Groups that are open while a formula is read: '{', 'l' for \left, and the first letter of an environment. */
struct groups {
  char open[64];
  size_t n, environments;
};

static bool open_group(struct groups *g, char c) {
  if (g->n == sizeof g->open) return false;
  g->open[g->n++] = c;
  return true;
}
static bool close_group(struct groups *g, char c) {
  return g->n > 0 && g->open[--g->n] == c;
}

/* Reads \begin{name} or \end{name} after the command; the number of bytes, 0 when it is wrong. */
static size_t environment(struct groups *g, const char *s, const char *end, bool begin) {
  const char *close = s < end && *s == '{' ? memchr(s, '}', (size_t)(end - s)) : NULL;
  if (!close || !is_environment(s + 1, (size_t)(close - s - 1))) return 0;
  g->environments += begin ? 1 : (size_t)-1;
  if (!(begin ? open_group(g, s[1]) : close_group(g, s[1]))) return 0;
  return (size_t)(close + 1 - s);
}

/* The command at s[0] = '\\'; the number of bytes, 0 when it is not of a formula. */
static size_t command(struct groups *g, const char *s, const char *end) {
  size_t len = strspn(s + 1, LETTERS);
  if (s + 1 + len > end) return 0;
  if (len == 0) return s + 1 < end && strchr(",;:!\\ {}", s[1]) ? 2 : 0;
  if (!is_math_command(s + 1, len)) return 0;
  bool left = len == 4 && memcmp(s + 1, "left", 4) == 0, right = len == 5 && memcmp(s + 1, "right", 5) == 0;
  if (left && !open_group(g, 'l')) return 0;
  if (right && !close_group(g, 'l')) return 0;
  if (left || right) { /* the delimiter is no group of its own */
    const char *d = s + 1 + len;
    return d < end && strchr("()[].|", *d) ? len + 2 : 0;
  }
  bool begin = len == 5 && memcmp(s + 1, "begin", 5) == 0, finish = len == 3 && memcmp(s + 1, "end", 3) == 0;
  if (!begin && !finish) return len + 1;
  size_t more = environment(g, s + 1 + len, end, begin);
  return more ? len + 1 + more : 0;
}

/* Primes and indices may not follow each other doubled: TeX refuses x^a^b, and x''^2. */
static bool is_sane(const char *s, size_t len) {
  struct groups g = {.n = 0};
  const char *end = s + len;
  while (s < end) {
    unsigned char c = (unsigned char)*s;
    size_t n = 1;
    if (c == '\\')
      n = command(&g, s, end);
    else if (c == '{')
      n = open_group(&g, '{');
    else if (c == '}')
      n = close_group(&g, '{');
    else if (c == '&')
      n = g.environments > 0;
    else if (c == '%' || c == '#' || c == '~' || c == '$' || c == '`' || c < ' ' || c >= 127)
      n = 0;
    if (n == 0) return false;
    s += n;
  }
  return g.n == 0;
}

/* --- Escapes --- */

static void escape_markdown(struct text *out, char c) {
  if (strchr("\\`*_[]<>#|~&$", c)) text_add_char(out, '\\');
  text_add_char(out, c);
}

static void escape_tex(struct text *out, char c) {
  static const struct {
    char c;
    const char *tex;
  } table[] = {{'\\', "\\textbackslash{}"},
               {'~', "\\textasciitilde{}"},
               {'^', "\\textasciicircum{}"},
               {'<', "$<$"},
               {'>', "$>$"},
               {'|', "$\\vert$"},
               {'"', "''"},
               {'`', "{}`{}"},
               {'-', "-{}"}};
  for (size_t i = 0; i < sizeof table / sizeof *table; i++)
    if (table[i].c == c) {
      text_add(out, table[i].tex);
      return;
    }
  if (strchr("#$%&_{}", c)) text_add_char(out, '\\');
  text_add_char(out, c);
}

/* TeX is given ASCII; what lies beyond is named by its code point. */
static size_t beyond_ascii(struct text *out, const char *s, size_t len) {
  unsigned char c = (unsigned char)*s;
  size_t n = c >= 0xF0 ? 4 : c >= 0xE0 ? 3 : 2;
  if (n > len) n = len;
  unsigned long point = c & (0xFFU >> (n + 1));
  for (size_t i = 1; i < n; i++) point = point << 6 | ((unsigned char)s[i] & 0x3FU);
  text_printf(out, "[U+%04lX]", point);
  return n;
}

/* A hyphen that is the sign of a number. */
static bool is_minus(const char *text, size_t len, size_t i) {
  return text[i] == '-' && i + 1 < len && text[i + 1] >= '0' && text[i + 1] <= '9' &&
         (i == 0 || strchr(" (=", text[i - 1]));
}

static void add_plain(const struct sheet *s, const char *text, size_t len) {
  for (size_t i = 0; i < len;) {
    unsigned char c = (unsigned char)text[i];
    if (s->tex && c >= 0x80) {
      i += beyond_ascii(s->out, text + i, len - i);
      continue;
    }
    if (c < ' ')
      text_add_char(s->out, ' ');
    else if (s->tex && is_minus(text, len, i))
      text_add(s->out, "$-$");
    else if (s->tex)
      escape_tex(s->out, text[i]);
    else
      escape_markdown(s->out, text[i]);
    i++;
  }
}

static void add_code(const struct sheet *s, const char *code, size_t len) {
  text_add(s->out, s->tex ? "\\texttt{" : "`");
  if (s->tex)
    add_plain(s, code, len);
  else
    for (size_t i = 0; i < len; i++)
      text_add_char(s->out, code[i] == '`' ? '\'' : (unsigned char)code[i] < ' ' ? ' ' : code[i]);
  text_add(s->out, s->tex ? "}" : "`");
}

/* A bar as \vert, which no table mistakes for the end of a cell; after \left and \right it needs no blank. */
static void add_math(const struct sheet *s, const char *math, size_t len) {
  while (len && *math == ' ') math++, len--;
  while (len && math[len - 1] == ' ') len--;
  if (len == 0) return;
  if (!is_sane(math, len)) {
    add_code(s, math, len);
    return;
  }
  text_add_char(s->out, '$');
  for (size_t i = 0; i < len; i++)
    if (math[i] == '|')
      text_add(s->out, "\\vert ");
    else
      text_add_char(s->out, math[i]);
  text_add_char(s->out, '$');
}

void sheet_math(const struct sheet *s, const char *math) {
  add_math(s, math, strlen(math));
}

void sheet_code(const struct sheet *s, const char *code) {
  add_code(s, code, strlen(code));
}

void sheet_text(const struct sheet *s, const char *text) {
  size_t dollars = 0;
  for (const char *p = text; *p; p++) dollars += *p == '$';
  if (dollars % 2) {
    add_plain(s, text, strlen(text));
    return;
  }
  for (bool math = false; *text; math = !math) {
    size_t n = strcspn(text, "$");
    if (math)
      add_math(s, text, n);
    else
      add_plain(s, text, n);
    text += n + (text[n] == '$');
  }
}
