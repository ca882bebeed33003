/* A text as the tokens that count.  Whether a character stands in a formula is not asked: a lost dollar sign would turn
   the rest of the text inside out. */
#include <nettle/sha2.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/tex.h"
#include "quote.h"

struct reader {
  const char *begin, *end;
  bool *counts; /* of each environment around the place: do its cells and rows? */
  size_t n, cap;
};

/* What the reader makes of the bytes at s. */
struct bite {
  size_t len;
  bool drop;
  struct quote_token number; /* of an equation; of length 0: it is none */
};

static struct bite bite(size_t len, bool drop) {
  return (struct bite){.len = len, .drop = drop};
}

static const char *skip_white(const char *s, const char *end) {
  while (s < end && strchr(" \n\t\r\f\v", *s)) s++;
  return s;
}

/* The end of an equation's number that begins behind s, if the dollars that end its formula follow, with the number;
   else s. */
static const char *behind_tag(struct quote_token *number, const char *s, const char *end) {
  const char *p = skip_white(s, end);
  if (p == end || *p != '(') return s;
  const char *digits = ++p;
  while (p < end && char_is_digit(*p)) p++;
  if (p == digits || p == end || *p != ')') return s;
  const char *dollars = skip_white(p + 1, end);
  if (end - dollars < 2 || dollars[0] != '$' || dollars[1] != '$') return s;
  *number = (struct quote_token){digits, (size_t)(p - digits)};
  return p + 1;
}

/* \begin{name} and \end{name}; a name is short, so that braces without end cost no more than others. */
static struct bite environment(struct reader *r, const struct tex_token *t) {
  enum { LONGEST = 40 };
  const char *brace = t->s + t->len;
  size_t len;
  const char *name = tex_braced(&len, brace, r->end - brace > LONGEST ? brace + LONGEST : r->end);
  if (!name) return bite(t->len, false);
  bool lines = (len == 7 && memcmp(name, "aligned", 7) == 0) || (len == 5 && memcmp(name, "cases", 5) == 0);
  if (t->kind == TEX_BEGIN) {
    *SS_PUSH(r->counts, r->n, r->cap) = !lines;
  } else if (r->n > 0) {
    r->n--;
  }
  return bite((size_t)(name + len + 1 - t->s), lines);
}

/* What formulas do not have, or Markdown has besides. */
static struct bite stranger(const struct reader *r, const struct tex_token *t) {
  unsigned char c = (unsigned char)*t->s;
  if (t->len == 2 && strchr("()[]", t->s[1])) return bite(2, true); /* \( and the like */
  if (t->len > 1 || c < 0x80) return bite(t->len, t->len == 1 && strchr("$~\n\t\r\f\v", c));
  size_t len = 1;
  while (t->s + len < r->end && ((unsigned char)t->s[len] & 0xC0) == 0x80) len++; /* one character of UTF-8 */
  return bite(len, false);
}

/* \quad, with the number of the equation that may stand behind it. */
static struct bite space(const struct reader *r, const struct tex_token *t) {
  struct bite b = {.drop = true};
  b.len = (size_t)(behind_tag(&b.number, t->s + t->len, r->end) - t->s);
  return b;
}

static struct bite bite_at(struct reader *r, const char *s) {
  const struct tex_token t = tex_read(s, r->end);
  switch (t.kind) {
  case TEX_BLANK:
  case TEX_GAP:
  case TEX_LEFT:
  case TEX_RIGHT:
    return bite(t.len, true);
  case TEX_DIGIT:
    return bite(tex_number_length(s, r->end), false);
  case TEX_CELL:
  case TEX_ROW:
    return bite(t.len, r->n == 0 || !r->counts[r->n - 1]);
  case TEX_BEGIN:
  case TEX_FINISH:
    return environment(r, &t);
  case TEX_WORD:
    return t.word->role == TEX_ROLE_SPACE ? space(r, &t) : bite(t.len, false);
  case TEX_SIGN:
    return bite(t.len, *s == '*' && (s == r->begin || !strchr("^{", s[-1])));
  case TEX_STRANGE:
    return stranger(r, &t);
  default:
    return bite(t.len, false);
  }
}

bool quote_token_same(const struct quote_token *a, const struct quote_token *b) {
  return a->len == b->len && memcmp(a->s, b->s, a->len) == 0;
}

void quote_tokens_read(struct quote_tokens *t, const char *s, size_t len) {
  struct reader r = {.begin = s, .end = s + len};
  while (s < r.end) {
    const struct bite b = bite_at(&r, s);
    if (!b.drop) *SS_PUSH(t->token, t->n, t->cap) = (struct quote_token){s, b.len};
    if (b.number.len) *SS_PUSH(t->tag, t->n_tags, t->cap_tags) = (struct quote_tag){b.number, t->n};
    s += b.len;
  }
  free(r.counts);
}

void quote_tokens_clear(struct quote_tokens *t) {
  free(t->token);
  free(t->tag);
  *t = (struct quote_tokens){.n = 0};
}

static void add_line(struct sha256_ctx *c, const char *before, const struct quote_token *t, const char *behind) {
  sha256_update(c, strlen(before), (const uint8_t *)before);
  sha256_update(c, t->len, (const uint8_t *)t->s);
  sha256_update(c, strlen(behind), (const uint8_t *)behind);
}

void quote_tokens_digest(char digest[QUOTE_DIGEST], const struct quote_tokens *t) {
  struct sha256_ctx c;
  uint8_t bytes[SHA256_DIGEST_SIZE];
  sha256_init(&c);
  for (size_t i = 0, k = 0; i < t->n || k < t->n_tags;) {
    if (k < t->n_tags && t->tag[k].behind == i)
      add_line(&c, "(", &t->tag[k++].number, ")\n");
    else
      add_line(&c, "", &t->token[i++], "\n");
  }
  sha256_digest(&c, sizeof bytes, bytes);
  size_t n = (size_t)snprintf(digest, QUOTE_DIGEST, "sha256 ");
  for (size_t i = 0; i < sizeof bytes; i++) snprintf(digest + n + 2 * i, QUOTE_DIGEST - n - 2 * i, "%02x", bytes[i]);
}

bool paper_text_read(struct paper_text *t, const char *path, struct diag *d) {
  *t = (struct paper_text){.src = {.text = NULL}};
  if (!source_read(&t->src, path, MAX_QUOTED_TEXT, d)) return false;
  quote_tokens_read(&t->tokens, t->src.text, t->src.len);
  if (t->tokens.n == 0) diag_set(d, "%.300s: error: an empty text", path);
  return t->tokens.n > 0;
}

void paper_text_clear(struct paper_text *t) {
  quote_tokens_clear(&t->tokens);
  source_clear(&t->src);
}
