/* Any text as the tokens that count.  Laws: tokens stand in it one behind the other, numbers of equations between
   them, and each is found at its place or before. */
#include "fuzz.h"
#include "quote/quote.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  OWNED(source) s = {.len = 0};
  if (!fuzz_source(&s, data, size)) return 0;
  OWNED(quote_tokens) t = {.n = 0};
  char digest[QUOTE_DIGEST];
  quote_tokens_read(&t, s.text, s.len);
  const char *end = s.text;
  for (size_t i = 0; i < t.n; i++) {
    fuzz_law(t.token[i].s >= end && t.token[i].len > 0, "tokens follow one another");
    end = t.token[i].s + t.token[i].len;
  }
  fuzz_law(end <= s.text + s.len, "tokens stand in the text");
  size_t behind = 0;
  for (size_t i = 0; i < t.n_tags; i++) {
    fuzz_law(t.tag[i].behind >= behind && t.tag[i].behind <= t.n, "numbers stand between tokens");
    behind = t.tag[i].behind;
  }
  quote_tokens_digest(digest, &t);
  if (t.n > 0) fuzz_law(quote_next(&t, &t, 1) == 1, "a text is found in itself");
  for (size_t i = 0; i < t.n && i < 50; i++) {
    const struct quote_tokens one = {.token = &t.token[i], .n = 1};
    size_t at = quote_next(&one, &t, 1); /* 0 where it is part of a word or opens a bracket */
    fuzz_law(at == 0 || quote_token_same(&t.token[at - 1], &t.token[i]), "what is found is the token");
  }
  return 0;
}
