/* A reader by descent.  What it takes is what RFC 8259 allows and nothing else; keys that occur twice are refused,
   since readers disagree about what they mean, and escapes of characters that no text file may hold. */
#include <string.h>

#include "json.h"

struct reader {
  const struct source *s;
  size_t at;
  struct arena *a;
  struct text word; /* the string being read */
  struct diag *d;
};

static bool read_value(struct reader *r, struct json_value *out, int depth);

static bool fail(struct reader *r, const char *what) {
  return diag_at(r->d, r->s, r->at, "%s", what);
}

static char look(const struct reader *r) {
  return r->s->text[r->at];
}

static void skip_blanks(struct reader *r) {
  while (look(r) && strchr(" \t\n\r", look(r))) r->at++;
}

static bool take(struct reader *r, char c) {
  if (look(r) != c || r->at >= r->s->len) return false;
  r->at++;
  return true;
}

/* --- Strings --- */

static bool read_hex(struct reader *r, unsigned long *point) {
  *point = 0;
  for (int i = 0; i < 4; i++, r->at++) {
    char c = look(r);
    unsigned long digit = c >= '0' && c <= '9'   ? (unsigned long)(c - '0')
                          : c >= 'a' && c <= 'f' ? (unsigned long)(c - 'a') + 10
                          : c >= 'A' && c <= 'F' ? (unsigned long)(c - 'A') + 10
                                                 : 16;
    if (digit == 16) return fail(r, "four hexadecimal digits are needed after \\u");
    *point = *point << 4 | digit;
  }
  return true;
}

static void add_utf8(struct text *out, unsigned long p) {
  if (p < 0x80) {
    text_add_char(out, (char)p);
    return;
  }
  int more = p < 0x800 ? 1 : p < 0x10000 ? 2 : 3;
  static const unsigned lead[] = {0, 0xC0, 0xE0, 0xF0};
  text_add_char(out, (char)(lead[more] | p >> (6 * more)));
  while (more-- > 0) text_add_char(out, (char)(0x80U | (p >> (6 * more) & 0x3FU)));
}

/* What follows \u; two of them for what lies beyond the first plane. */
static bool read_code_point(struct reader *r) {
  unsigned long high, low;
  if (!read_hex(r, &high)) return false;
  if (high == 0) return fail(r, "a string cannot hold NUL");
  if (high >= 0xDC00 && high <= 0xDFFF) return fail(r, "half of a surrogate pair");
  if (high >= 0xD800 && high <= 0xDBFF) {
    if (!take(r, '\\') || !take(r, 'u')) return fail(r, "half of a surrogate pair");
    if (!read_hex(r, &low)) return false;
    if (low < 0xDC00 || low > 0xDFFF) return fail(r, "half of a surrogate pair");
    high = 0x10000 + ((high - 0xD800) << 10) + (low - 0xDC00);
  }
  add_utf8(&r->word, high);
  return true;
}

static bool read_escape(struct reader *r) {
  static const char from[] = "\"\\/bfnrt", to[] = "\"\\/\b\f\n\r\t";
  char c = look(r);
  const char *k = c ? strchr(from, c) : NULL;
  if (!k && c != 'u') return fail(r, "an unknown escape in a string");
  r->at++;
  if (!k) return read_code_point(r);
  text_add_char(&r->word, to[k - from]);
  return true;
}

/* Between quotes, the first of which has been taken. */
static bool read_string(struct reader *r, const char **out) {
  text_reset(&r->word);
  while (!take(r, '"')) {
    if (r->at >= r->s->len) return fail(r, "a string without end");
    if ((unsigned char)look(r) < ' ') return fail(r, "a control character in a string");
    if (take(r, '\\')) {
      if (!read_escape(r)) return false;
    } else {
      text_add_char(&r->word, look(r));
      r->at++;
    }
  }
  if (text_plain_prefix(text_str(&r->word), r->word.len, true) < r->word.len)
    return fail(r, "a control character in the string that ends here");
  *out = arena_strndup(r->a, text_str(&r->word), r->word.len);
  return true;
}

/* --- Numbers and words --- */

static size_t read_digits(struct reader *r) {
  size_t n = 0;
  for (; look(r) >= '0' && look(r) <= '9'; r->at++) n++;
  return n;
}

static bool read_number(struct reader *r, struct json_value *out) {
  size_t from = r->at;
  take(r, '-');
  bool zero = look(r) == '0';
  size_t n = read_digits(r);
  bool ok = n > 0 && !(zero && n > 1);
  if (ok && take(r, '.')) ok = read_digits(r) > 0;
  if (ok && (take(r, 'e') || take(r, 'E'))) {
    if (!take(r, '+')) take(r, '-');
    ok = read_digits(r) > 0;
  }
  if (!ok) return fail(r, "not a number of JSON");
  *out = (struct json_value){.kind = JSON_KIND_NUMBER, .text = arena_strndup(r->a, r->s->text + from, r->at - from)};
  return true;
}

static bool read_word(struct reader *r, struct json_value *out) {
  static const struct {
    const char *word;
    enum json_kind kind;
    bool truth;
  } words[] = {{"null", JSON_KIND_NULL, false}, {"true", JSON_KIND_BOOL, true}, {"false", JSON_KIND_BOOL, false}};
  for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
    size_t n = strlen(words[i].word);
    if (strncmp(r->s->text + r->at, words[i].word, n) != 0) continue;
    r->at += n;
    *out = (struct json_value){.kind = words[i].kind, .truth = words[i].truth};
    return true;
  }
  return fail(r, "a value is needed here");
}

/* --- Containers --- */

static bool read_key(struct reader *r, const char **key) {
  skip_blanks(r);
  if (!take(r, '"')) return fail(r, "a key between quotes is needed here");
  if (!read_string(r, key)) return false;
  skip_blanks(r);
  return take(r, ':') || fail(r, "a colon is needed after a key");
}

/* Up to the closing bracket; the opening one has been taken. */
static bool read_container(struct reader *r, struct json_value *out, bool object, int depth) {
  struct json_value *last = NULL;
  *out = (struct json_value){.kind = object ? JSON_KIND_OBJECT : JSON_KIND_ARRAY};
  if (depth == JSON_READ_DEPTH) return fail(r, "nested too deeply");
  skip_blanks(r);
  if (take(r, object ? '}' : ']')) return true;
  do {
    struct json_value *v = arena_alloc(r->a, sizeof *v);
    const char *key = NULL;
    if (object && !read_key(r, &key)) return false;
    if (key && json_member(out, key)) return fail(r, "this key occurs twice");
    if (!read_value(r, v, depth + 1)) return false;
    v->key = key;
    if (last)
      last->next = v;
    else
      out->first = v;
    last = v;
    out->n++;
    if (object && out->n > JSON_READ_MEMBERS) return fail(r, "an object with too many members");
    skip_blanks(r);
  } while (take(r, ','));
  if (!take(r, object ? '}' : ']'))
    return fail(r, object ? "a comma or } is needed here" : "a comma or ] is needed here");
  return true;
}

static bool read_kind(struct reader *r, struct json_value *out, int depth) {
  if (take(r, '{')) return read_container(r, out, true, depth);
  if (take(r, '[')) return read_container(r, out, false, depth);
  if (take(r, '"')) {
    *out = (struct json_value){.kind = JSON_KIND_STRING};
    return read_string(r, &out->text);
  }
  if (look(r) == '-' || (look(r) >= '0' && look(r) <= '9')) return read_number(r, out);
  return read_word(r, out);
}

static bool read_value(struct reader *r, struct json_value *out, int depth) {
  skip_blanks(r);
  size_t at = r->at;
  bool ok = read_kind(r, out, depth);
  out->at = at;
  return ok;
}

bool json_parse(struct json_value *out, struct arena *a, const struct source *s, struct diag *d) {
  struct reader r = {.s = s, .a = a, .d = d};
  bool ok = read_value(&r, out, 0);
  skip_blanks(&r);
  if (ok && r.at < s->len) ok = fail(&r, "something follows the value");
  text_clear(&r.word);
  return ok;
}

const struct json_value *json_member(const struct json_value *v, const char *key) {
  if (!v || v->kind != JSON_KIND_OBJECT) return NULL;
  for (const struct json_value *m = v->first; m; m = m->next)
    if (strcmp(m->key, key) == 0) return m;
  return NULL;
}

const char *json_text(const struct json_value *v, const char *key) {
  const struct json_value *m = json_member(v, key);
  return m && m->kind == JSON_KIND_STRING ? m->text : NULL;
}

bool json_says(const struct json_value *v, const char *key, const char *what) {
  const char *text = json_text(v, key);
  return text && what && strcmp(text, what) == 0;
}

bool json_same(const struct json_value *a, const struct json_value *b) {
  if (a->kind != b->kind || a->truth != b->truth || a->n != b->n) return false;
  if (a->text && strcmp(a->text, b->text) != 0) return false;
  const struct json_value *y = b->first;
  for (const struct json_value *x = a->first; x; x = x->next) {
    const struct json_value *other = a->kind == JSON_KIND_OBJECT ? json_member(b, x->key) : y;
    if (!other || !json_same(x, other)) return false;
    y = y->next;
  }
  return true;
}
