/* Text with formulas in it, for Markdown, LaTeX and HTML.  What a report quotes was written by others: a bar must not
   end a table's cell, an underscore must not begin italics, a percent sign must not hide the rest of a line, nothing is
   an element. */
#include <stdlib.h>
#include <string.h>

#include "escape.h"
#include "finding.h"
#include "formula.h"
#include "sheet.h"

/* In Markdown a bar or a backtick cannot stand in code everywhere; such text is shown as it is. */
static void add_code(const struct sheet *s, const char *code, size_t len) {
  static const char *const begin[] = {"`", "\\texttt{", "<code>"}, *const end[] = {"`", "}", "</code>"};
  bool markdown = s->dialect == DIALECT_MARKDOWN,
       plain = markdown && (memchr(code, '|', len) || memchr(code, '`', len));
  if (!plain) text_add(s->out, begin[s->dialect]);
  if (!markdown || plain)
    sheet_plain(s, code, len);
  else
    for (size_t i = 0; i < len; i++) text_add_char(s->out, (unsigned char)code[i] < ' ' ? ' ' : code[i]);
  if (!plain) text_add(s->out, end[s->dialect]);
}

/* A bar as \vert, which no table mistakes for the end of a cell; after \left and \right it needs no blank. */
static void add_dollars(struct text *out, const char *math, size_t len) {
  text_add_char(out, '$');
  for (size_t i = 0; i < len; i++)
    if (math[i] == '|')
      text_add(out, "\\vert ");
    else
      text_add_char(out, math[i]);
  text_add_char(out, '$');
}

/* What the dialect might stumble over is shown as code. */
static void add_math(const struct sheet *s, const char *math, size_t len, const bool *changed) {
  while (len && *math == ' ') {
    math++, len--;
    if (changed) changed++;
  }
  while (len && math[len - 1] == ' ') len--;
  if (len == 0 || (s->dialect == DIALECT_HTML && formula_mathml(s->out, math, len, changed))) return;
  if (s->dialect == DIALECT_HTML) {
    text_add(s->out, "<code class=\"raw\">");
    escape_html(s->out, math, len);
    text_add(s->out, "</code>");
  } else if (formula_is_sane(math, len)) {
    add_dollars(s->out, math, len);
  } else {
    add_code(s, math, len);
  }
}

void html_math(struct text *out, const char *tex, const bool *changed) {
  add_math(HTML(out), tex, strlen(tex), changed);
}

void sheet_values(const struct sheet *s, const struct audit_result *r, const struct root_cause *root) {
  const char *before = NULL;
  for (int i = 0; i < root->n_claims; i++) {
    if (!root_value(r, root, i)) continue;
    sheet_add(s, "%s%m", before, root_value(r, root, i));
    before = ", ";
  }
  if (before) text_add(s->out, ". ");
}

/* --- Sentences --- */

/* How what is between formulas is written: escaped, as prose, or as it is. */
typedef void plain_text(const struct sheet *s, const char *text, size_t len);

static void add_as_is(const struct sheet *s, const char *text, size_t len) {
  text_add_n(s->out, text, len);
}

/* Mathematics between dollar signs, and what is between them; in HTML what ends a sentence stays on the line of its
   formula. */
static void add_text(const struct sheet *s, const char *text, const bool *changed, plain_text *plain) {
  size_t dollars = 0, len = strlen(text);
  for (size_t i = 0; i < len; i++) dollars += text[i] == '$';
  if (dollars % 2) {
    sheet_plain(s, text, len);
    return;
  }
  bool math = false;
  for (size_t i = 0; i < len; math = !math) {
    size_t n = strcspn(text + i, "$");
    bool kept =
        s->dialect == DIALECT_HTML && math && text[i + n] && text[i + n + 1] && strchr(".,;:)", text[i + n + 1]);
    text_add(s->out, kept ? "<span class=\"k\">" : "");
    if (math)
      add_math(s, text + i, n, changed ? changed + i : NULL);
    else
      plain(s, text + i, n);
    if (kept) text_printf(s->out, "%c</span>", text[i + n + 1]);
    i += n + (text[i + n] == '$') + kept;
  }
}

void html_text(struct text *out, const char *text, const bool *changed) {
  add_text(HTML(out), text, changed, sheet_prose_n);
}

void html_with_math(struct text *out, const char *html) {
  add_text(HTML(out), html, NULL, add_as_is);
}

void sheet_text(const struct sheet *s, const char *text) {
  add_text(s, text, NULL, s->dialect == DIALECT_HTML ? sheet_prose_n : sheet_plain);
}

void sheet_prose(const struct sheet *s, const char *text) {
  if (s->dialect == DIALECT_HTML)
    sheet_prose_n(s, text, strlen(text));
  else
    add_text(s, text, NULL, sheet_prose_n);
}

void sheet_stop(const struct sheet *s) {
  static const char span[] = "</span>";
  size_t n = s->out->len, k = sizeof span - 1;
  bool html = s->dialect == DIALECT_HTML;
  if (html && n > k && memcmp(s->out->data + n - k, span, k) == 0) n -= k; /* which keeps a formula with its stop */
  if (n && !strchr(html ? ".?!" : ".", s->out->data[n - 1])) text_add_char(s->out, '.');
}

void sheet_sentence(const struct sheet *s, const char *text) {
  OWNED(text) t = {0};
  text_add_capital(&t, text);
  sheet_add(s, s->dialect == DIALECT_HTML ? "%t%." : "%p%.", text_str(&t));
}

void sheet_list(const struct sheet *s, const char *const *list, int n) {
  for (int i = 0; i < n; i++) {
    text_add(s->out, list_joint(i, n, " and "));
    sheet_prose(s, list[i]);
  }
}

void markdown_head(struct text *out, const char *columns) {
  OWNED(text) rule = {0};
  text_add_char(out, '|');
  text_add(&rule, "\n|");
  for (const char *c = columns, *end = c; *end; c = end + 1) {
    end = c + strcspn(c, "|");
    bool right = end > c && end[-1] == ':';
    text_printf(out, "%s%.*s |", end > c ? " " : "", (int)(end - c - right), c);
    text_add(&rule, right ? " ---: |" : " --- |");
  }
  text_printf(out, "%s\n", text_str(&rule));
}

void markdown_head_of(struct text *out, const char *columns, const char *const *name, int n) {
  OWNED(text) all = {0};
  text_add(&all, columns);
  for (int i = 0; i < n; i++) text_printf(&all, "|%s:", name[i]);
  markdown_head(out, text_str(&all));
}

/* --- Words with texts in them --- */

/* A name in the value of an id: characters that an id cannot have by their codes. */
static void add_anchor(struct text *out, const char *name) {
  for (; *name; name++) {
    unsigned char c = (unsigned char)*name;
    bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    if (plain)
      text_add_char(out, *name);
    else
      text_printf(out, ".%02X", c);
  }
}

/* A claim of an equation by the equation's number, others as code. */
static void add_claim(const struct sheet *s, const char *id) {
  if (strncmp(id, "eq-", 3) == 0)
    sheet_add(s, "(%e)", id + 3);
  else
    add_code(s, id, strlen(id));
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
    sheet_plain(s, text, strlen(text));
    return;
  case 't':
    sheet_text(s, text);
    return;
  case 'p':
    sheet_prose(s, text);
    return;
  case 'm':
    add_math(s, text, strlen(text), NULL);
    return;
  case 'c':
    add_code(s, text, strlen(text));
    return;
  case 'v':
    add_verdict(s, text);
    return;
  case 'a':
    add_anchor(s->out, text);
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
