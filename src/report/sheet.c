/* Text with formulas in it, for Markdown, LaTeX and HTML.  What a report quotes was written by others: a bar must not
   end a table's cell, an underscore must not begin italics, a percent sign must not hide the rest of a line, nothing is
   an element. */
#include <stdlib.h>
#include <string.h>

#include "base/tex.h"
#include "escape.h"
#include "finding.h"
#include "formula.h"
#include "html.h"
#include "sheet.h"

static void add_plain(const struct sheet *s, const char *text, size_t len) {
  static void (*const escape[])(struct text *, const char *, size_t) = {
      [DIALECT_MARKDOWN] = escape_markdown, [DIALECT_TEX] = escape_tex, [DIALECT_HTML] = escape_html};
  escape[s->dialect](s->out, text, len);
}

/* In Markdown a bar or a backtick cannot stand in code everywhere; such text is shown as it is. */
static void add_code(const struct sheet *s, const char *code, size_t len) {
  bool tex = s->dialect == DIALECT_TEX, plain = !tex && (memchr(code, '|', len) || memchr(code, '`', len));
  const char *begin = tex ? "\\texttt{" : "`", *end = tex ? "}" : "`";
  if (!plain) text_add(s->out, begin);
  if (tex || plain)
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

static void sheet_math(const struct sheet *s, const char *math) {
  if (s->dialect == DIALECT_HTML)
    html_math(s->out, math, NULL);
  else
    add_math(s, math, strlen(math));
}

void sheet_values(const struct sheet *s, const struct audit_result *r, const struct root_cause *root) {
  const char *value[MOST_VALUES];
  int n = root_values(value, r, root);
  for (int i = 0; i < n; i++) {
    text_add(s->out, i ? ", " : "");
    sheet_math(s, value[i]);
  }
  if (n) text_add(s->out, ". ");
}

static void sheet_code(const struct sheet *s, const char *code) {
  if (s->dialect == DIALECT_HTML)
    html_code(s->out, code);
  else
    add_code(s, code, strlen(code));
}

/* --- Names in sentences --- */

static bool is_greek(const char *s, size_t len) {
  static const char *const names[] = {"chi", "eta", "omega", "lambda", "Gamma"};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (strlen(names[i]) == len && strncmp(names[i], s, len) == 0) return true;
  return false;
}

/* z_10, z'_0, z_1', e1, chi, dZ_b as mathematics; the bytes read, or 0 where there is no such name. */
static size_t add_name(const struct sheet *s, const char *p) {
  size_t letters = 0, i, index = 0;
  while (char_is_letter(p[letters])) letters++;
  for (i = letters; p[i] == '\'';) i++;
  size_t primes = i - letters, gap = p[i] == '_';
  while (char_is_letter(p[i + gap + index]) || char_is_digit(p[i + gap + index])) index++;
  if (letters == 4 && strncmp(p, "hbar", 4) == 0 && !index) {
    add_math(s, "\\bar{h}", strlen("\\bar{h}"));
    return letters;
  }
  bool greek = is_greek(p, letters), digits = letters == 1 && !primes && char_is_digit(p[i]);
  bool lowered = index && index <= 3 && (gap || digits) && letters <= 2;
  bool alone = letters == 1 && !gap && !index && !strchr("aAI", *p);
  if (!letters || !(lowered || alone || (greek && !gap && !index)) || p[i + gap + index] == '_') return 0;
  size_t after = 0;
  while (p[i + gap + index + after] == '\'') after++;
  struct text t = {0};
  text_add(&t, greek ? "\\" : "");
  text_add_n(&t, p, letters + primes);
  if (lowered) {
    text_add(&t, "_{");
    text_add_n(&t, p + i + gap, index);
    text_add_char(&t, '}');
  }
  text_add_n(&t, p + i + gap + index, after);
  const char *rest = p + i + gap + index + after;
  size_t exponent = rest[0] == '^' && char_is_digit(rest[1]) ? 2 : 0;
  text_add_n(&t, rest, exponent);
  add_math(s, text_str(&t), t.len);
  text_clear(&t);
  return i + gap + index + after + exponent;
}

/* An exponent, s^2, or a minus before a number or between two blanks; the bytes read, or 0. */
static size_t add_sign(const struct sheet *s, const char *text, size_t i, size_t len) {
  char before = i ? text[i - 1] : ' ', after = i + 1 < len ? text[i + 1] : ' ';
  if (text[i] == '^' && char_is_digit(after)) {
    text_printf(s->out, "$^%c$", after);
    return 2;
  }
  bool minus = text[i] == '-' && ((char_is_digit(after) && strchr(" (", before)) || (before == ' ' && after == ' '));
  if (minus) text_add(s->out, "$-$");
  return minus;
}

static void add_prose(const struct sheet *s, const char *text, size_t len) {
  for (size_t i = 0; i < len;) {
    bool owned = i > 1 && text[i - 1] == '\'' && char_is_letter(text[i - 2]); /* the s of "Newton's" */
    bool inside = i && (char_is_word(text[i - 1]) || text[i - 1] == '-' || owned);
    size_t n = inside ? 0 : add_name(s, text + i);
    if (!n) n = add_sign(s, text, i, len);
    if (!n && text[i] == '*' && i && (char_is_word(text[i - 1]) || text[i - 1] == ')')) {
      text_add_char(s->out, ' ');
      n = 1;
    }
    if (!n) add_plain(s, text + i, n = 1);
    i += n;
  }
}

static void add_text(const struct sheet *s, const char *text, void (*add)(const struct sheet *, const char *, size_t)) {
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
      add(s, text, n);
    text += n + (text[n] == '$');
  }
}

void sheet_text(const struct sheet *s, const char *text) {
  if (s->dialect == DIALECT_HTML)
    html_text(s->out, text, NULL);
  else
    add_text(s, text, add_plain);
}

void sheet_prose(const struct sheet *s, const char *text) {
  if (s->dialect == DIALECT_HTML)
    html_prose(s->out, text);
  else
    add_text(s, text, add_prose);
}

void sheet_stop(const struct sheet *s) {
  if (s->dialect == DIALECT_HTML)
    html_stop(s->out);
  else if (s->out->len && s->out->data[s->out->len - 1] != '.')
    text_add_char(s->out, '.');
}

void sheet_list(const struct sheet *s, const char *const *list, int n) {
  for (int i = 0; i < n; i++) {
    text_add(s->out, i == 0 ? "" : i + 1 < n ? ", " : " and ");
    sheet_prose(s, list[i]);
  }
}

void markdown_head(struct text *out, const char *columns) {
  struct text rule = {0};
  text_add_char(out, '|');
  text_add(&rule, "\n|");
  for (const char *c = columns, *end = c; *end; c = end + 1) {
    end = c + strcspn(c, "|");
    bool right = end > c && end[-1] == ':';
    text_printf(out, "%s%.*s |", end > c ? " " : "", (int)(end - c - right), c);
    text_add(&rule, right ? " ---: |" : " --- |");
  }
  text_printf(out, "%s\n", text_str(&rule));
  text_clear(&rule);
}

void markdown_head_of(struct text *out, const char *columns, const char *const *name, int n) {
  struct text all = {0};
  text_add(&all, columns);
  for (int i = 0; i < n; i++) text_printf(&all, "|%s:", name[i]);
  markdown_head(out, text_str(&all));
  text_clear(&all);
}

/* --- Words with texts in them --- */

/* A claim of an equation by the equation's number, others as code. */
static void add_claim(const struct sheet *s, const char *id) {
  if (strncmp(id, "eq-", 3) == 0)
    sheet_add(s, "(%e)", id + 3);
  else
    sheet_code(s, id);
}

static void add_verdict(const struct sheet *s, const char *verdict) {
  if (s->dialect == DIALECT_HTML)
    sheet_add(s, "<span class=\"v %s\">%s</span>", verdict, verdict);
  else
    text_add(s->out, verdict);
}

static void add_one(const struct sheet *s, char how, const char *text) {
  switch (how) {
  case 's':
    text_add(s->out, text);
    return;
  case 'e':
    add_plain(s, text, strlen(text));
    return;
  case 't':
    sheet_text(s, text);
    return;
  case 'p':
    sheet_prose(s, text);
    return;
  case 'm':
    sheet_math(s, text);
    return;
  case 'c':
    sheet_code(s, text);
    return;
  case 'v':
    add_verdict(s, text);
    return;
  case 'a':
    html_anchor(s->out, text);
    return;
  case 'n':
    add_claim(s, text);
    return;
  }
  abort();
}

void sheet_add_texts(const struct sheet *s, const char *words, const char *const *text, size_t n) {
  size_t used = 0;
  for (const char *end; *words; words = end + 2) {
    end = words + strcspn(words, "%");
    text_add_n(s->out, words, (size_t)(end - words));
    if (!*end) break;
    if (end[1] == '.')
      sheet_stop(s);
    else if (used == n)
      abort();
    else if (text[used++])
      add_one(s, end[1], text[used - 1]);
  }
  if (used != n) abort();
}
