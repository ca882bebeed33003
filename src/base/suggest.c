/* Edits are counted row by row of the usual table; an exchange of neighbours needs the row before the last one too. */
#include "suggest.h"

#include <string.h>

static char small(char c) {
  return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static size_t least(size_t a, size_t b) {
  return a < b ? a : b;
}

size_t word_edits(const char *a, size_t n, const char *b, size_t m) {
  size_t row[3][SUGGEST_LONGEST + 1];
  if (n > SUGGEST_LONGEST || m > SUGGEST_LONGEST) return SUGGEST_LONGEST;
  for (size_t k = 0; k <= m; k++) row[0][k] = k;
  for (size_t i = 1; i <= n; i++) {
    size_t *now = row[i % 3], *last = row[(i + 2) % 3], *before = row[(i + 1) % 3];
    now[0] = i;
    for (size_t k = 1; k <= m; k++) {
      char x = small(a[i - 1]), y = small(b[k - 1]);
      now[k] = least(last[k - 1] + (x != y), 1 + least(last[k], now[k - 1]));
      if (i > 1 && k > 1 && x == small(b[k - 2]) && y == small(a[i - 2])) now[k] = least(now[k], before[k - 2] + 1);
    }
  }
  return row[n % 3][m];
}

void suggest_begin(struct suggestion *s, const char *word, size_t len) {
  *s = (struct suggestion){.word = word, .len = len, .edits = SUGGEST_LONGEST};
}

void suggest_try(struct suggestion *s, const char *known) {
  size_t len = strlen(known), longer = len > s->len ? len : s->len;
  size_t edits = word_edits(s->word, s->len, known, len);
  if (edits > (longer > 7 ? 2U : longer > 2 ? 1U : 0U) || edits > s->edits) return;
  if (edits < s->edits) s->n = 0;
  s->edits = edits;
  if (s->n < SUGGEST_MOST) s->near[s->n++] = known;
}

void suggest_print(struct text *out, const struct suggestion *s) {
  for (int i = 0; i < s->n; i++)
    text_printf(out, "%s%s", i == 0 ? " (did you mean " : i + 1 < s->n ? ", " : " or ", s->near[i]);
  if (s->n) text_add(out, "?)");
}
