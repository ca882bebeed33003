/* Text with formulas in it, for Markdown and for LaTeX.  What a report quotes was written by others: a bar must not end
   a table's cell, an underscore must not begin italics, and a percent sign must not hide the rest of a line. */
#include <string.h>

#include "escape.h"
#include "formula.h"
#include "sheet.h"

static void add_plain(const struct sheet *s, const char *text, size_t len) {
  (s->tex ? escape_tex : escape_markdown)(s->out, text, len);
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
  if (!formula_is_sane(math, len)) {
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
