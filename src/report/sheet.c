/* Text with formulas in it, for Markdown and for LaTeX.  What a report quotes was written by others: a bar must not end a
   table's cell, an underscore must not begin italics, and a percent sign must not hide the rest of a line. */
#include <string.h>

#include "impl.h"

/* --- Escapes --- */

static void escape_markdown(struct text *out, char c) {
  if (strchr("\\`*_[]<>#|~&$", c)) text_add_char(out, '\\');
  text_add_char(out, c);
}

/* A bracket or a star after the end of a table's row would belong to the command that ends it. */
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
               {'-', "-{}"},
               {'[', "{[}"},
               {'*', "{*}"}};
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
  text_printf(out, "{[}U+%04lX]", point);
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

/* In Markdown a bar or a backtick cannot stand in code everywhere; such text is shown as it is. */
static void add_code(const struct sheet *s, const char *code, size_t len) {
  bool plain = !s->tex && (memchr(code, '|', len) || memchr(code, '`', len));
  const char *begin = s->tex ? "\\texttt{" : "`", *end = s->tex ? "}" : "`";
  if (!plain) text_add(s->out, begin);
  if (s->tex || plain)
    add_plain(s, code, len);
  else
    for (size_t i = 0; i < len; i++) text_add_char(s->out, (unsigned char)code[i] < ' ' ? ' ' : code[i]);
  if (!plain) text_add(s->out, end);
}

/* A bar as \vert, which no table mistakes for the end of a cell; after \left and \right it needs no blank. */
static void add_math(const struct sheet *s, const char *math, size_t len) {
  while (len && *math == ' ') math++, len--;
  while (len && math[len - 1] == ' ') len--;
  if (len == 0) return;
  if (!math_is_sane(math, len)) {
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
