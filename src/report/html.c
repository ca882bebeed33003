/* Text for a page that is HTML and well-formed XML at once.  What is quoted was written by others: nothing of it is
   markup. */
#include <string.h>

#include "page.h"

/* A character that XML can hold, by its bytes: no control characters, no noncharacters at the end of the plane. */
static bool shows(const unsigned char *s, size_t n) {
  if (n == 1) return s[0] >= ' ' && s[0] != 0x7F;
  if (n == 2) return !(s[0] == 0xC2 && s[1] < 0xA0);
  return !(n == 3 && s[0] == 0xEF && s[1] == 0xBF && s[2] >= 0xBE);
}

static void add_character(struct text *out, const char *s, size_t n) {
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

void html_plain_n(struct text *out, const char *s, size_t len) {
  for (size_t i = 0; i < len;) {
    unsigned char c = (unsigned char)s[i];
    size_t n = c < 0xC0 ? 1 : c < 0xE0 ? 2 : c < 0xF0 ? 3 : 4;
    if (c >= 0x80 && (n > len - i || text_valid_prefix(s + i, n) != n)) {
      text_add(out, "\xef\xbf\xbd");
      i++;
      continue;
    }
    add_character(out, s + i, n);
    i += n;
  }
}

void html_plain(struct text *out, const char *s) {
  if (s) html_plain_n(out, s, strlen(s));
}

static void add_code(struct text *out, const char *kind, const char *s, size_t len) {
  text_printf(out, "<code%s>", kind);
  html_plain_n(out, s, len);
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
  if (len && !mathml_add(out, tex, len, changed)) add_code(out, " class=\"raw\"", tex, len);
}

void html_math(struct text *out, const char *tex, const bool *changed) {
  add_math(out, tex, strlen(tex), changed);
}

void html_text(struct text *out, const char *s, const bool *changed) {
  if (!s) return;
  size_t dollars = 0, len = strlen(s);
  for (size_t i = 0; i < len; i++) dollars += s[i] == '$';
  if (dollars % 2) {
    html_plain_n(out, s, len);
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

void html_anchor(struct text *out, const char *prefix, const char *name) {
  text_add(out, prefix);
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
  if (out->len && !strchr(".?!", out->data[out->len - 1])) text_add_char(out, '.');
}
