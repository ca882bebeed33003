/* Text for a page that is HTML and well-formed XML at once.  What is quoted was written by others: nothing of it is
   markup. */
#include <string.h>

#include "escape.h"
#include "formula.h"
#include "html.h"

static void add_code(struct text *out, const char *kind, const char *s, size_t len) {
  text_printf(out, "<code%s>", kind);
  escape_html(out, s, len);
  text_add(out, "</code>");
}

void html_code(struct text *out, const char *s) {
  add_code(out, "", s, strlen(s));
}

static void add_math(struct text *out, const char *tex, size_t len, const bool *changed) {
  while (len && *tex == ' ') {
    tex++, len--;
    if (changed) changed++;
  }
  while (len && tex[len - 1] == ' ') len--;
  if (len && !formula_mathml(out, tex, len, changed)) add_code(out, " class=\"raw\"", tex, len);
}

void html_math(struct text *out, const char *tex, const bool *changed) {
  add_math(out, tex, strlen(tex), changed);
}

void html_text(struct text *out, const char *s, const bool *changed) {
  if (!s) return;
  size_t dollars = 0, len = strlen(s);
  for (size_t i = 0; i < len; i++) dollars += s[i] == '$';
  if (dollars % 2) {
    escape_html(out, s, len);
    return;
  }
  bool math = false;
  for (size_t i = 0; i < len; math = !math) {
    size_t n = strcspn(s + i, "$");
    bool ends = math && s[i + n] && s[i + n + 1] && strchr(".,;:)", s[i + n + 1]); /* with what stays on its line */
    text_add(out, ends ? "<span class=\"k\">" : "");
    if (math)
      add_math(out, s + i, n, changed ? changed + i : NULL);
    else
      html_prose_n(out, s + i, n);
    if (ends) text_printf(out, "%c</span>", s[i + n + 1]);
    i += n + (s[i + n] == '$') + ends;
  }
}

void html_anchor(struct text *out, const char *name) {
  for (; *name; name++) {
    unsigned char c = (unsigned char)*name;
    bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    if (plain)
      text_add_char(out, *name);
    else
      text_printf(out, ".%02X", c);
  }
}

void html_stop(struct text *out) {
  static const char span[] = "</span>";
  size_t n = out->len, k = sizeof span - 1;
  if (n > k && memcmp(out->data + n - k, span, k) == 0) n -= k; /* which keeps a formula with its stop */
  if (n && !strchr(".?!", out->data[n - 1])) text_add_char(out, '.');
}
