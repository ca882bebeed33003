/* Pieces of quotations looked for in a text: at their places, then everywhere. */
#include <stdlib.h>
#include <string.h>

#include "quote.h"

static bool is_letter(const struct quote_token *t) {
  return t->len == 1 && char_is_letter(*t->s);
}

/* Is the token with that index in one word with the one before it? */
static bool goes_on(const struct quote_tokens *text, size_t i) {
  const struct quote_token *t = text->token;
  return i > 0 && i < text->n && t[i - 1].s + 1 == t[i].s && is_letter(&t[i - 1]) && is_letter(&t[i]);
}

/* Does a bracket of the piece stay open that the token with that index closes? */
static bool leaves_open(const struct quote_tokens *piece, const struct quote_tokens *text, size_t i) {
  long open = 0;
  if (i >= text->n || text->token[i].len != 1 || !strchr(")}", *text->token[i].s)) return false;
  for (size_t k = 0; k < piece->n; k++)
    if (piece->token[k].len == 1)
      open += (strchr("({", *piece->token[k].s) != NULL) - (strchr(")}", *piece->token[k].s) != NULL);
  return open > 0;
}

/* Does the piece stand in the text at that place, counted from 1, and cuts no word nor brackets short? */
static bool stands_at(const struct quote_tokens *piece, const struct quote_tokens *text, size_t place) {
  if (place == 0 || place > text->n || piece->n > text->n - place + 1) return false;
  for (size_t i = 0; i < piece->n; i++)
    if (!quote_token_same(&piece->token[i], &text->token[place - 1 + i])) return false;
  const size_t behind = place - 1 + piece->n;
  return !goes_on(text, place - 1) && !goes_on(text, behind) && !leaves_open(piece, text, behind);
}

static size_t apart(size_t a, size_t b) {
  return a < b ? b - a : a - b;
}

size_t quote_next(const struct quote_tokens *piece, const struct quote_tokens *text, size_t from) {
  while (from <= text->n && !stands_at(piece, text, from)) from++;
  return from <= text->n ? from : 0;
}

/* The place of the piece that is nearest to its own; 0: there is none. */
static size_t nearest(const struct quote_tokens *piece, const struct quote_tokens *text, size_t own) {
  size_t best = 0;
  for (size_t at = quote_next(piece, text, 1); at; at = quote_next(piece, text, at + 1))
    if (!best || apart(at, own) < apart(best, own)) best = at;
  return best;
}

static int by_place(const void *a, const void *b) {
  const struct quote_piece *x = *(struct quote_piece *const *)a, *y = *(struct quote_piece *const *)b;
  if (x->place != y->place) return x->place < y->place ? -1 : 1;
  return x < y ? -1 : x > y;
}

/* Is the equation's number, if one is named, that of the formula at the place? */
static bool named_well(const char *equation, const struct quote_tokens *text, size_t place) {
  if (!equation) return true;
  size_t next = 0, len = strlen(equation);
  while (next < text->n_tags && text->tag[next].behind < place) next++;
  for (size_t i = next > 0 ? next - 1 : 0; i <= next && i < text->n_tags; i++)
    if (text->tag[i].number.len == len && memcmp(text->tag[i].number.s, equation, len) == 0) return true;
  return false;
}

static void check_names(struct quotations *q, const struct quote_tokens *text) {
  for (size_t i = 0; i < q->n; i++) {
    struct quote_piece *p = &q->piece[q->item[i].first];
    if (p->outcome == QUOTE_FOUND && !named_well(q->item[i].equation, text, p->place)) p->outcome = QUOTE_MISNAMED;
  }
}

/* In the order of places, since what was put into a text moves all that follows it by as much: a piece is looked for
   where the one before it went. */
void quotations_compare(struct quotations *q, const struct quote_tokens *text) {
  FREED struct quote_piece **order = ss_malloc((q->n_pieces + 1) * sizeof *order);
  for (size_t i = 0; i < q->n_pieces; i++) order[i] = &q->piece[i];
  qsort(order, q->n_pieces, sizeof *order, by_place);
  size_t moved = 0; /* modulo SIZE_MAX + 1 */
  for (size_t i = 0; i < q->n_pieces; i++) {
    struct quote_piece *p = order[i];
    p->elsewhere = 0;
    p->outcome = !p->place ? QUOTE_PLACELESS : stands_at(&p->tokens, text, p->place) ? QUOTE_FOUND : QUOTE_NOWHERE;
    if (p->outcome != QUOTE_NOWHERE) continue;
    bool along = stands_at(&p->tokens, text, p->place + moved);
    p->elsewhere = along ? p->place + moved : nearest(&p->tokens, text, p->place);
    if (!p->elsewhere) continue;
    p->outcome = QUOTE_ELSEWHERE;
    moved = p->elsewhere - p->place;
  }
  check_names(q, text);
}

bool quotation_found(const struct quotations *q, const struct quotation *item) {
  for (size_t i = 0; i < item->n; i++)
    if (q->piece[item->first + i].outcome != QUOTE_FOUND) return false;
  return true;
}
