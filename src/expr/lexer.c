/* Text to tokens, one at a time and without state: a token is found from a place, so looking ahead is asking again.
   Every character belongs to a token, to a blank or to a comment; anything else is named in the diagnostic together
   with what to write in its stead, since formulas are often pasted from documents that hold typographic signs. */
#include <string.h>

#include "expr_impl.h"

static size_t skip_blanks(const char *s, size_t i, size_t end) {
  while (i < end) {
    if (s[i] == '#')
      while (i < end && s[i] != '\n') i++;
    else if (s[i] == ' ' || s[i] == '\t' || s[i] == '\r' || s[i] == '\n')
      i++;
    else
      break;
  }
  return i;
}

static size_t skip_digits(const char *s, size_t i, size_t end) {
  while (i < end && char_is_digit(s[i])) i++;
  return i;
}

static struct token bad(size_t begin) {
  return (struct token){TOK_BAD, begin, begin};
}

/* The code point at s[i] and its length in bytes, or 0 bytes when it is not UTF-8. */
static size_t decode(const char *s, size_t i, size_t end, unsigned long *c) {
  unsigned char lead = (unsigned char)s[i];
  size_t len = lead < 0x80 ? 1 : (lead & 0xE0) == 0xC0 ? 2 : (lead & 0xF0) == 0xE0 ? 3 : (lead & 0xF8) == 0xF0 ? 4 : 0;
  if (len == 0 || len > end - i) return 0;
  *c = len == 1 ? lead : lead & (0x7FUL >> len);
  for (size_t k = 1; k < len; k++) {
    unsigned char byte = (unsigned char)s[i + k];
    if ((byte & 0xC0) != 0x80) return 0;
    *c = *c << 6 | (byte & 0x3FUL);
  }
  return len;
}

/* What to write in the stead of a character. */
static const char *remedy(unsigned long c) {
  enum { MOST = 6 };
  static const struct {
    unsigned long of[MOST];
    const char *says;
  } remedies[] = {{{0x2010, 0x2011, 0x2012, 0x2013, 0x2014, 0x2212}, "; a minus sign is \"-\""},
                  {{0xB7, 0xD7, 0x2219, 0x22C5}, "; a product is written with \"*\""},
                  {{0xF7, 0x2215}, "; a quotient is written with \"/\""},
                  {{0x2264}, "; write \"<=\""},
                  {{0x2265}, "; write \">=\""},
                  {{0x2261}, "; write \"=\""},
                  {{0x2018, 0x2019, 0x2032, 0x60, 0xB4}, "; a prime is \"'\""},
                  {{0xB2}, "; write \"^2\""},
                  {{0xB3}, "; write \"^3\""},
                  {{0x221A}, "; write sqrt(...)"},
                  {{0xA0}, ", a no-break space; write an ordinary one"},
                  {{'\\', '$'}, "; formulas are plain text, not TeX"},
                  {{'!', '~', 0x2248, 0x2260}, "; the relations are = < <= > >="},
                  {{'|'}, "; a modulus is abs(...)"},
                  {{'_'}, "; a name begins with a letter"},
                  {{'.'}, "; a decimal point stands before a digit"}};
  for (size_t i = 0; i < sizeof remedies / sizeof *remedies; i++)
    for (int k = 0; k < MOST; k++)
      if (remedies[i].of[k] == c) return remedies[i].says;
  return c >= 0x370 && c < 0x400 ? "; a Greek letter is written by its name, as in omega" : "";
}

static struct token unknown(const struct source *src, size_t at, size_t end, struct diag *d) {
  unsigned long c = 0;
  size_t len = decode(src->text, at, end, &c);
  if (len == 0)
    diag_at(d, src, at, "byte 0x%02X is not UTF-8", (unsigned)(unsigned char)src->text[at]);
  else if (c < ' ' || c == 0x7F)
    diag_at(d, src, at, "a control character, 0x%02lX, in a formula", c);
  else if (c < 0x7F)
    diag_at(d, src, at, "unexpected character \"%c\"%s", (int)c, remedy(c));
  else
    diag_at(d, src, at, "unexpected character \"%.*s\" (U+%04lX)%s", (int)len, src->text + at, c, remedy(c));
  return bad(at);
}

/* digits [. digits] or . digits, then an exponent.  An e without digits is not one: it may begin a name. */
static struct token number(const struct source *src, size_t begin, size_t end, struct diag *d) {
  const char *s = src->text;
  size_t i = skip_digits(s, begin, end);
  if (i < end && s[i] == '.') {
    size_t point = i++;
    i = skip_digits(s, i, end);
    if (i == point + 1) {
      diag_at(d, src, point, "digits are missing after the decimal point");
      return bad(begin);
    }
  }
  if (i < end && (s[i] == 'e' || s[i] == 'E')) {
    size_t digits = i + 1 + (i + 1 < end && (s[i + 1] == '+' || s[i + 1] == '-'));
    size_t stop = skip_digits(s, digits, end);
    if (stop == digits && (digits > i + 1 || stop == end || !char_is_word(s[stop]))) {
      diag_at(d, src, i, "the exponent of the number has no digits (a product with e is written with \"*\")");
      return bad(begin);
    }
    if (stop > digits) i = stop;
  }
  if (i < end && s[i] == '.') {
    diag_at(d, src, i, "a second decimal point in a number");
    return bad(begin);
  }
  if (i < end && char_is_word(s[i])) {
    diag_at(d, src, i, "a number runs into a name; a product is written with \"*\", and a name begins with a letter");
    return bad(begin);
  }
  return (struct token){TOK_NUMBER, begin, i};
}

/* Primes belong to the name when _ follows them, as in z'_1b; else they are tokens of their own. */
static struct token name(const char *s, size_t begin, size_t end) {
  size_t i = begin;
  for (;;) {
    while (i < end && char_is_word(s[i])) i++;
    size_t primes = i;
    while (primes < end && s[primes] == '\'') primes++;
    if (primes == i || primes == end || s[primes] != '_') break;
    i = primes;
  }
  return (struct token){TOK_NAME, begin, i};
}

struct token lex_token(const struct source *src, size_t from, size_t end, struct diag *d) {
  const char *s = src->text;
  size_t i = skip_blanks(s, from, end);
  if (i >= end) return (struct token){TOK_END, from, from};
  char c = s[i];
  char after = i + 1 < end ? s[i + 1] : ' ';
  if (char_is_letter(c)) return name(s, i, end);
  if (char_is_digit(c) || (c == '.' && char_is_digit(after))) return number(src, i, end, d);
  if (c == ':' && after == '=') return (struct token){TOK_DEFINE, i, i + 2};
  if (c == '<' && after == '=') return (struct token){TOK_LE, i, i + 2};
  if (c == '>' && after == '=') return (struct token){TOK_GE, i, i + 2};
  if (c && strchr("+-*/^()[]{},;:=<>'", c)) return (struct token){c, i, i + 1};
  return unknown(src, i, end, d);
}
