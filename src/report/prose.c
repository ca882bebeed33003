/* Names and numbers in plain sentences as a book sets them: z_10 with a lowered index, chi as the Greek letter, 1e-9 as
   a power of ten, s^2 and 2^-52 with a raised exponent, a minus as long as a plus.  What stands between quotation marks
   is meant to be copied and stays as it is. */
#include <string.h>

#include "base/tex.h"
#include "escape.h"
#include "html.h"

/* The rest of a sentence, and what of it was read. */
struct prose {
  const char *s;
  size_t len;
};

static char at(const struct prose *p, size_t i) {
  return i < p->len ? p->s[i] : '\0';
}

/* Whether a name or number may begin here: not inside a word, nor after the dash of a claim's name or a dot. */
static bool begins(const char *all, size_t i) {
  if (i == 0) return true;
  char c = all[i - 1];
  if (c == '-') return i == 1 || !char_is_word(all[i - 2]);
  return !char_is_word(c) && c != '.';
}

static size_t count(const struct prose *p, size_t from, bool (*is)(char)) {
  size_t n = 0;
  while (is(at(p, from + n))) n++;
  return n;
}

static size_t primes(const struct prose *p, size_t from) {
  size_t n = 0;
  while (at(p, from + n) == '\'') n++;
  return n;
}

static void add_primes(struct text *out, size_t n) {
  while (n--) text_add(out, "\xe2\x80\xb2");
}

static const char *greek(const char *s, size_t len) {
  static const char *const names[] = {"chi", "eta", "omega", "lambda"};
  const struct tex_word *w = tex_word(s, len);
  for (size_t i = 0; w && i < sizeof names / sizeof *names; i++)
    if (strcmp(w->name, names[i]) == 0) return w->text;
  return NULL;
}

static bool is_index(char c) {
  return char_is_letter(c) || char_is_digit(c);
}

/* t_a, z'_0, z_1', dZ_b, e1, chi; the bytes read, or 0 where there is no such name. */
static size_t add_name(struct text *out, const struct prose *p) {
  size_t letters = count(p, 0, char_is_letter), before = primes(p, letters), i = letters + before;
  const char *letter = greek(p->s, letters);
  size_t gap = at(p, i) == '_', index = count(p, i + gap, is_index);
  bool lowered = (gap && index) || (letters == 1 && !before && index && char_is_digit(at(p, i)));
  if (!letters || index > 3 || at(p, i + gap + index) == '_') return 0;
  if (!(lowered && (letter || letters <= 2)) && !(letter && !gap && !index)) return 0;
  size_t after = primes(p, i + gap + index);
  if (char_is_word(at(p, i + gap + index + after))) return 0;
  text_add(out, "<var>");
  if (letter)
    text_add(out, letter);
  else
    escape_html(out, p->s, letters);
  add_primes(out, before);
  if (lowered) {
    const struct prose low = {p->s + i + gap, index};
    size_t slanted = count(&low, 0, char_is_letter);
    text_add(out, slanted ? "<sub><i>" : "<sub>");
    escape_html(out, low.s, slanted);
    text_add(out, slanted ? "</i>" : "");
    escape_html(out, low.s + slanted, index - slanted);
    text_add(out, "</sub>");
  }
  add_primes(out, after);
  text_add(out, "</var>");
  return i + gap + index + after;
}

/* 1e-74, 7.92e-32; the bytes read, or 0. */
static size_t add_power(struct text *out, const struct prose *p) {
  size_t mantissa = count(p, 0, char_is_digit);
  if (mantissa && at(p, mantissa) == '.') mantissa += 1 + count(p, mantissa + 1, char_is_digit);
  if (!mantissa || at(p, mantissa) != 'e') return 0;
  bool minus = at(p, mantissa + 1) == '-';
  size_t sign = minus || at(p, mantissa + 1) == '+', from = mantissa + 1 + sign, n = count(p, from, char_is_digit);
  if (!n || char_is_word(at(p, from + n))) return 0;
  bool one = mantissa == 1 && p->s[0] == '1', zero = n == 1 && p->s[from] == '0';
  if (!one || zero) escape_html(out, p->s, mantissa);
  if (zero) return from + n;
  text_add(out, one ? "10" : "&#183;10");
  if (!minus && n == 1 && p->s[from] == '1') return from + n;
  text_add(out, minus ? "<sup>\xe2\x88\x92" : "<sup>");
  escape_html(out, p->s + from, n);
  text_add(out, "</sup>");
  return from + n;
}

/* ^2, ^-52, ^{-1} behind a name, a number or a closing bracket; the bytes read, or 0. */
static size_t add_exponent(struct text *out, const char *all, size_t i, size_t len) {
  if (all[i] != '^' || i == 0 || !(char_is_word(all[i - 1]) || strchr(")'", all[i - 1]))) return 0;
  const struct prose p = {all + i, len - i};
  size_t brace = at(&p, 1) == '{', minus = at(&p, 1 + brace) == '-', from = 1 + brace + minus;
  size_t n = count(&p, from, char_is_digit), end = from + n + brace;
  if (!n || (brace && at(&p, from + n) != '}') || (!brace && char_is_word(at(&p, end)))) return 0;
  text_add(out, minus ? "<sup>\xe2\x88\x92" : "<sup>");
  escape_html(out, p.s + from, n);
  text_add(out, "</sup>");
  return end;
}

/* A minus, as a sign before a number or between two blanks after a name or number; a product of what stands beside
   it. */
static const char *operator_at(const char *all, size_t i, size_t len) {
  char before = i ? all[i - 1] : ' ', after = i + 1 < len ? all[i + 1] : ' ';
  if (all[i] == '*')
    return (char_is_word(before) || strchr(")'", before)) && (char_is_word(after) || after == '(') ? "\xe2\x8b\x85"
                                                                                                   : NULL;
  if (all[i] != '-') return NULL;
  if (char_is_digit(after) && strchr(" (=/,", before)) return "\xe2\x88\x92";
  bool operand = i >= 2 && (char_is_word(all[i - 2]) || strchr(")'", all[i - 2]));
  return before == ' ' && after == ' ' && operand ? "\xe2\x88\x92" : NULL;
}

void html_prose_n(struct text *out, const char *s, size_t len) {
  bool quoted = false;
  for (size_t i = 0; i < len;) {
    const struct prose rest = {s + i, len - i};
    size_t n = 0;
    quoted ^= s[i] == '"';
    if (!quoted && begins(s, i)) n = char_is_digit(s[i]) ? add_power(out, &rest) : add_name(out, &rest);
    if (!quoted && !n) n = add_exponent(out, s, i, len);
    if (!quoted && !n && rest.len >= 3 && memcmp(s + i, "+/-", 3) == 0) {
      text_add(out, "\xc2\xb1");
      n = 3;
    }
    const char *sign = quoted || n ? NULL : operator_at(s, i, len);
    if (sign) {
      text_add(out, sign);
      n = 1;
    }
    if (!n) {
      for (n = 1; i + n < len && ((unsigned char)s[i + n] & 0xC0) == 0x80;) n++;
      escape_html(out, s + i, n);
    }
    i += n;
  }
}

void html_prose(struct text *out, const char *s) {
  if (s) html_prose_n(out, s, strlen(s));
}
