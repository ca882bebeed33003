/* Names and numbers in plain sentences as a book sets them: z_10 with a lowered index, chi as the Greek letter, s^2 and
   2^-52 with a raised exponent, a minus as long as a plus; in HTML 1e-9 as a power of ten too, elsewhere single letters
   as mathematics.  What stands between quotation marks is meant to be copied and stays as it is. */
#include <string.h>

#include "base/tex.h"
#include "sheet.h"

/* The rest of a sentence, and what of it was read. */
struct prose {
  const char *s;
  size_t len;
};

static char at(const struct prose *p, size_t i) {
  return i < p->len ? p->s[i] : '\0';
}

static bool is_html(const struct sheet *s) {
  return s->dialect == DIALECT_HTML;
}

/* Whether a name or number may begin here: not inside a word, nor after the dash of a claim's name, a dot or an
   apostrophe. */
static bool begins(const char *all, size_t i) {
  if (i == 0) return true;
  char c = all[i - 1];
  if (c == '-' || c == '\'') return i == 1 || !char_is_word(all[i - 2]);
  return !char_is_word(c) && c != '.';
}

static size_t count(const struct prose *p, size_t from, bool (*is)(char)) {
  size_t n = 0;
  while (is(at(p, from + n))) n++;
  return n;
}

static bool is_prime(char c) {
  return c == '\'';
}

/* --- Names --- */

/* What the paper calls hbar is an h with a bar. */
static const struct tex_word barred = {"bar{h}", TEX_ROLE_UPRIGHT, 0, true, ""};

/* The Greek letter of that name, or hbar; NULL for others.  An upright one, as Gamma, stays a word in HTML, where it
   names a phase. */
static const struct tex_word *letter_named(const struct sheet *s, const char *name, size_t len) {
  const struct tex_word *w = len == 4 && memcmp(name, "hbar", 4) == 0 ? &barred : tex_word(name, len);
  bool letter = w && (w->role == TEX_ROLE_LETTER || w->role == TEX_ROLE_UPRIGHT);
  return letter && !(is_html(s) && w->role == TEX_ROLE_UPRIGHT) ? w : NULL;
}

/* t_a, z'_0, z_1', dZ_b, e1, chi. */
struct name {
  const char *s;
  size_t letters, before, index, after; /* how many; before, after: primes before and after the index */
  const struct tex_word *as;            /* NULL: the letters stand for themselves */
  const char *low;                      /* the index, which may be empty */
};

/* The bytes read, or 0 where there is no such name. */
static size_t read_name(struct name *n, const struct sheet *s, const struct prose *p) {
  *n = (struct name){.s = p->s, .letters = count(p, 0, char_is_letter)};
  n->before = count(p, n->letters, is_prime);
  n->as = letter_named(s, p->s, n->letters);
  size_t i = n->letters + n->before, gap = at(p, i) == '_';
  n->low = p->s + i + gap;
  n->index = count(p, i + gap, char_is_letter_or_digit);
  size_t end = i + gap + n->index;
  bool lowered = (gap && n->index) || (n->letters == 1 && !n->before && char_is_digit(at(p, i)));
  bool alone = !is_html(s) && n->letters == 1 && !strchr("aAI", *p->s);
  bool named = lowered ? n->as || n->letters <= 2 : !gap && !n->index && (n->as || alone);
  if (!n->letters || n->index > 3 || !named || at(p, end) == '_') return 0;
  n->after = count(p, end, is_prime);
  end += n->after;
  return char_is_word(at(p, end)) ? 0 : end;
}

static void add_primes(struct text *out, size_t n) {
  while (n--) text_add(out, "\xe2\x80\xb2");
}

static void add_html_name(struct text *out, const struct name *n) {
  const struct prose low = {n->low, n->index};
  size_t slanted = count(&low, 0, char_is_letter);
  text_add(out, "<var>");
  text_add_n(out, n->as ? n->as->text : n->s, n->as ? strlen(n->as->text) : n->letters);
  add_primes(out, n->before);
  if (slanted) text_printf(out, "<sub><i>%.*s</i>", (int)slanted, low.s);
  if (low.len) text_printf(out, "%s%.*s</sub>", slanted ? "" : "<sub>", (int)(low.len - slanted), low.s + slanted);
  add_primes(out, n->after);
  text_add(out, "</var>");
}

/* With an exponent behind it; the bytes that this takes. */
static size_t add_name(const struct sheet *s, const struct prose *p) {
  struct name n;
  size_t read = read_name(&n, s, p);
  if (read && is_html(s)) add_html_name(s->out, &n);
  if (!read || is_html(s)) return read;
  const size_t minus = at(p, read) == '^' && at(p, read + 1) == '-', from = read + 1 + minus;
  const size_t digits = at(p, read) == '^' ? count(p, from, char_is_digit) : 0;
  text_printf(s->out, "$%.*s", (int)(n.as ? 0 : n.letters), n.s);
  text_printf(s->out, "%s%s%.*s", n.as ? "\\" : "", n.as ? n.as->name : "", (int)n.before, n.s + n.letters);
  if (n.index) text_printf(s->out, "_{%.*s}", (int)n.index, n.low);
  text_add_n(s->out, n.low + n.index, n.after);
  if (digits) text_printf(s->out, digits + minus > 1 ? "^{%.*s}" : "^%.*s", (int)(digits + minus), p->s + read + 1);
  text_add_char(s->out, '$');
  return digits ? from + digits : read;
}

/* --- Numbers and signs --- */

/* 1e-74, 7.92e-32, in HTML; the bytes read, or 0. */
static size_t add_power(const struct sheet *s, const struct prose *p) {
  size_t mantissa = count(p, 0, char_is_digit);
  if (mantissa && at(p, mantissa) == '.') mantissa += 1 + count(p, mantissa + 1, char_is_digit);
  if (!is_html(s) || at(p, mantissa) != 'e') return 0;
  bool minus = at(p, mantissa + 1) == '-';
  size_t sign = minus || at(p, mantissa + 1) == '+', from = mantissa + 1 + sign, n = count(p, from, char_is_digit);
  if (!n || char_is_word(at(p, from + n))) return 0;
  bool one = mantissa == 1 && p->s[0] == '1', zero = n == 1 && p->s[from] == '0';
  if (!one || zero) text_add_n(s->out, p->s, mantissa);
  if (zero) return from + n;
  text_add(s->out, one ? "10" : "&#183;10");
  if (!minus && n == 1 && p->s[from] == '1') return from + n;
  text_printf(s->out, "<sup>%s%.*s</sup>", minus ? "\xe2\x88\x92" : "", (int)n, p->s + from);
  return from + n;
}

/* ^2, ^-52, ^{-1} behind a name, a number or a closing bracket; the bytes read, or 0. */
static size_t add_exponent(const struct sheet *s, const char *all, size_t i, size_t len) {
  if (all[i] != '^' || i == 0 || !(char_is_word(all[i - 1]) || strchr(")'", all[i - 1]))) return 0;
  const struct prose p = {all + i, len - i};
  size_t brace = at(&p, 1) == '{', minus = at(&p, 1 + brace) == '-', from = 1 + brace + minus;
  size_t n = count(&p, from, char_is_digit), end = from + n + brace;
  if (!n || (brace && at(&p, from + n) != '}') || (!brace && char_is_word(at(&p, end)))) return 0;
  if (is_html(s))
    text_printf(s->out, "<sup>%s%.*s</sup>", minus ? "\xe2\x88\x92" : "", (int)n, p.s + from);
  else
    text_printf(s->out, n + minus > 1 ? "$^{%.*s}$" : "$^%.*s$", (int)(n + minus), p.s + from - minus);
  return end;
}

/* A minus, as a sign before a number or between two blanks after a name or number; a product of what stands beside it;
   more or less.  The bytes read, or 0. */
static size_t add_sign(const struct sheet *s, const char *all, size_t i, size_t len) {
  static const char *const minus[] = {"$-$", "$-$", "\xe2\x88\x92"}, *const times[] = {" ", " ", "\xe2\x8b\x85"};
  char before = i ? all[i - 1] : ' ', after = i + 1 < len ? all[i + 1] : ' ';
  bool sign = char_is_digit(after) && strchr(" (=/,", before);
  bool operand = i >= 2 && (char_is_word(all[i - 2]) || strchr(")'", all[i - 2]));
  if (is_html(s) && len - i >= 3 && memcmp(all + i, "+/-", 3) == 0) {
    text_add(s->out, "\xc2\xb1");
    return 3;
  }
  if (all[i] == '*' && (char_is_word(before) || strchr(")'", before)) && (char_is_word(after) || after == '('))
    text_add(s->out, times[s->dialect]);
  else if (all[i] == '-' && (sign || (before == ' ' && after == ' ' && operand)))
    text_add(s->out, minus[s->dialect]);
  else
    return 0;
  return 1;
}

void sheet_prose_n(const struct sheet *s, const char *text, size_t len) {
  bool quoted = false;
  for (size_t i = 0; i < len;) {
    const struct prose rest = {text + i, len - i};
    size_t n = 0;
    quoted ^= text[i] == '"';
    if (!quoted && begins(text, i)) n = char_is_digit(text[i]) ? add_power(s, &rest) : add_name(s, &rest);
    if (!quoted && !n) n = add_exponent(s, text, i, len);
    if (!quoted && !n) n = add_sign(s, text, i, len);
    if (!n) {
      for (n = 1; i + n < len && ((unsigned char)text[i + n] & 0xC0) == 0x80;) n++;
      sheet_plain(s, text + i, n);
    }
    i += n;
  }
}
