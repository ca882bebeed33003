/* One function for each format. */
#include <string.h>

#include "escape.h"
#include "sheet.h"

/* --- HTML and XML --- */

/* A character that XML can hold, by its bytes: no control characters, no noncharacters at the end of the plane. */
static bool shows(const unsigned char *s, size_t n) {
  if (n == 1) return s[0] >= ' ' && s[0] != 0x7F;
  if (n == 2) return !(s[0] == 0xC2 && s[1] < 0xA0);
  return !(n == 3 && s[0] == 0xEF && s[1] == 0xBF && s[2] >= 0xBE);
}

static void add_html(struct text *out, const char *s, size_t n) {
  static const struct {
    char c;
    const char *html;
  } table[] = {{'<', "&lt;"}, {'>', "&gt;"}, {'&', "&amp;"}, {'"', "&quot;"}, {'\'', "&#39;"}};
  for (size_t i = 0; i < sizeof table / sizeof *table; i++)
    if (table[i].c == *s) {
      text_add(out, table[i].html);
      return;
    }
  if (strchr("\t\n\r", *s))
    text_add_char(out, ' ');
  else if (shows((const unsigned char *)s, n))
    text_add_n(out, s, n);
  else
    text_add(out, "\xef\xbf\xbd");
}

void escape_html(struct text *out, const char *s, size_t len) {
  for (size_t i = 0; i < len;) {
    unsigned char c = (unsigned char)s[i];
    size_t n = c < 0xC0 ? 1 : c < 0xE0 ? 2 : c < 0xF0 ? 3 : 4;
    if (c >= 0x80 && (n > len - i || text_valid_prefix(s + i, n) != n)) {
      text_add(out, "\xef\xbf\xbd");
      i++;
      continue;
    }
    add_html(out, s + i, n);
    i += n;
  }
}

/* --- Markdown --- */

void escape_markdown(struct text *out, const char *s, size_t len) {
  for (size_t i = 0; i < len; i++) {
    if (strchr("\\`*_[]<>#|~&$", s[i])) text_add_char(out, '\\');
    text_add_char(out, (unsigned char)s[i] < ' ' ? ' ' : s[i]);
  }
}

/* An element or a link, as CommonMark knows them, or a comment, declaration or instruction; x_i<V is none. */
static bool is_tag(const char *s) {
  s += s[0] == '/';
  if (s[0] == '!' || s[0] == '?') return true;
  if (!char_is_letter(s[0])) return false;
  while (char_is_letter_or_digit(*s) || *s == '-') s++;
  return strchr(" \t\n/>:", *s) != NULL;
}

void escape_tags(struct text *out, size_t from) {
  FREED char *all = ss_strdup(text_str(out));
  out->len = from;
  for (const char *s = all + from; *s; s++)
    if (*s == '<' && is_tag(s + 1))
      text_add(out, "&lt;");
    else if (s[0] == ']' && s[1] == '(') /* apart they are no link or image, and the same formula */
      text_add(out, "] ");
    else
      text_add_char(out, *s);
}

void escape_cell(struct text *out, const char *s) {
  for (; *s; s++) text_printf(out, *s == '|' ? "\\%c" : "%c", *s);
}

/* --- LaTeX --- */

/* A bracket or a star after the end of a table's row would belong to the command that ends it. */
static void add_tex(struct text *out, char c) {
  static const struct {
    char c;
    const char *tex;
  } table[] = {{'\\', "\\textbackslash{}"},
               {'~', "\\textasciitilde{}"},
               {'^', "\\textasciicircum{}"},
               {'<', "$<$"},
               {'>', "$>$"},
               {'|', "$\\vert$"},
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

/* The code point of a character, and its length. */
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

/* A quotation mark opens behind a blank or a bracket. */
static void add_quotation_mark(struct text *out) {
  bool opens = out->len == 0 || strchr(" \n({", out->data[out->len - 1]);
  text_add(out, opens ? "``" : "''");
}

void escape_tex(struct text *out, const char *s, size_t len) {
  for (size_t i = 0; i < len; i++) {
    if ((unsigned char)s[i] >= 0x80)
      i += beyond_ascii(out, s + i, len - i) - 1;
    else if ((unsigned char)s[i] < ' ')
      text_add_char(out, ' ');
    else if (is_minus(s, len, i))
      text_add(out, "$-$");
    else if (s[i] == '"')
      add_quotation_mark(out);
    else
      add_tex(out, s[i]);
  }
}

/* --- What a sheet is written in --- */

void sheet_plain(const struct sheet *s, const char *text, size_t len) {
  static void (*const escape[])(struct text *, const char *, size_t) = {
      [DIALECT_MARKDOWN] = escape_markdown, [DIALECT_TEX] = escape_tex, [DIALECT_HTML] = escape_html};
  escape[s->dialect](s->out, text, len);
}

/* --- CSV, Graphviz --- */

/* What a spreadsheet would compute.  A sign begins a number, or an inequality, unless something is called (NAME
   followed by a bracket; of TeX, \left is no name), quoted or taken from elsewhere. */
static bool is_computed(const char *s) {
  if (*s == '=' || *s == '@') return true;
  if (*s != '+' && *s != '-') return false;
  const char *word = s + 1;
  for (const char *p = word; *p; p++) {
    if (strchr("|!\"", *p) || (*p == '(' && p > word && word[-1] != '\\')) return true;
    if (!char_is_word(*p) && *p != '.') word = p + 1;
  }
  return false;
}

void escape_csv(struct text *out, const char *s) {
  if (!s || !*s) return;
  text_add(out, is_computed(s) ? "\"'" : "\"");
  for (; *s; s++) {
    if (*s == '"') text_add_char(out, '"');
    bool control = ((unsigned char)*s < ' ' && *s != '\n') || *s == 0x7F;
    text_add_char(out, control ? ' ' : *s);
  }
  text_add_char(out, '"');
}

void escape_dot(struct text *out, const char *s) {
  text_add_char(out, '"');
  for (; *s; s++) {
    if (*s == '"' || *s == '\\') text_add_char(out, '\\');
    text_add_char(out, (unsigned char)*s < ' ' ? ' ' : *s);
  }
  text_add_char(out, '"');
}
