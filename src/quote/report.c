/* What is not found, for people. */
#include <string.h>

#include "quote.h"

static const char *const kind_name[N_QUOTE_KINDS] = {"title", "tex", "quote", "statement"};

static void say_file(struct text *out, const struct source *src, size_t offset) {
  size_t line, column;
  source_place(&line, &column, src, offset);
  text_printf(out, "%s:%zu", src->name, line);
}

static void say_name(struct text *out, const struct quotation *item) {
  text_printf(out, "%s%s%s", item->id, *item->id ? " " : "", kind_name[item->kind]);
}

static void say_quotation(struct text *out, const struct quotation *item) {
  say_file(out, item->src, item->field->value.begin);
  text_add(out, ": ");
  say_name(out, item);
}

/* The tokens around the one with index i, which is marked; blanks where something is dropped. */
static void say_around(struct text *out, const struct quote_tokens *t, size_t i) {
  enum { BEFORE = 24, BEHIND = 16 };
  const size_t first = i > BEFORE ? i - BEFORE : 0, last = t->n > i + BEHIND ? i + BEHIND : t->n;
  if (first > 0) text_add(out, "... ");
  for (size_t k = first; k < last; k++) {
    if (k > first && t->token[k].s != t->token[k - 1].s + t->token[k - 1].len) text_add_char(out, ' ');
    if (k == i) text_add(out, ">>");
    text_add_n(out, t->token[k].s, t->token[k].len);
    if (k == i) text_add(out, "<<");
  }
  text_add(out, i >= t->n ? " >>nothing more<<\n" : last < t->n ? " ...\n" : "\n");
}

/* Both sides at the first difference. */
static void say_difference(struct text *out, const struct quote_piece *p, const struct paper_text *paper) {
  const struct quote_tokens *text = &paper->tokens;
  size_t i = 0, at = p->place - 1;
  while (i < p->tokens.n && at + i < text->n && quote_token_same(&p->tokens.token[i], &text->token[at + i])) i++;
  text_add(out, "  quoted: ");
  say_around(out, &p->tokens, i);
  text_add(out, "  text:   ");
  say_around(out, text, at + i < text->n ? at + i : text->n);
  if (at + i >= text->n) return;
  text_add(out, "          at ");
  say_file(out, &paper->src, (size_t)(text->token[at + i].s - paper->src.text));
  text_add_char(out, '\n');
}

/* Places that lie by as much off as that of the piece: the least and the greatest, and how many pieces. */
struct shift {
  size_t least, greatest, n;
  bool between; /* there is a third place */
};

static bool moved_alike(const struct quote_piece *a, const struct quote_piece *b) {
  return b->outcome == QUOTE_ELSEWHERE && a->elsewhere - a->place == b->elsewhere - b->place;
}

static struct shift shift_of(const struct quotations *q, const struct quote_piece *p) {
  struct shift s = {p->place, p->place, 0, false};
  for (size_t i = 0; i < q->n_pieces; i++) {
    if (!moved_alike(p, &q->piece[i])) continue;
    const size_t place = q->piece[i].place;
    s.n++;
    if (place < s.least) s.least = place;
    if (place > s.greatest) s.greatest = place;
  }
  for (size_t i = 0; i < q->n_pieces; i++)
    s.between =
        s.between || (moved_alike(p, &q->piece[i]) && q->piece[i].place > s.least && q->piece[i].place < s.greatest);
  return s;
}

static void say_tokens(struct text *out, const struct quote_piece *p) {
  const bool later = p->elsewhere > p->place;
  const size_t n = later ? p->elsewhere - p->place : p->place - p->elsewhere;
  text_printf(out, "%zu token%s %s", n, plural_s((long long)n), later ? "later" : "earlier");
}

/* Pieces that something before them has moved are one finding, said of the first. */
static bool say_moved(struct text *out, const struct quotations *q, const struct quote_piece *p) {
  const struct shift s = shift_of(q, p);
  if (!s.between) return false;
  for (const struct quote_piece *first = q->piece; first < p; first++)
    if (moved_alike(p, first)) return true;
  text_printf(out, "%zu pieces of quotations stand ", s.n);
  say_tokens(out, p);
  text_printf(out, " than their places, from token %zu to token %zu\n", s.least, s.greatest);
  return true;
}

static void say_placeless(struct text *out, const struct quote_piece *p, const struct quote_tokens *text) {
  enum { MOST = 8 };
  size_t at = quote_next(&p->tokens, text, 1);
  text_add(out, at ? "no place is kept; it stands at" : "no place is kept, and it stands nowhere");
  for (int i = 0; at && i < MOST; i++, at = quote_next(&p->tokens, text, at + 1))
    text_printf(out, "%s %zu-%zu", i > 0 ? "," : "", at, at + p->tokens.n - 1);
  text_add_char(out, '\n');
}

static void say_piece(struct text *out, const struct quotations *q, const struct quotation *item, size_t k,
                      const struct paper_text *text) {
  const struct quote_piece *p = &q->piece[item->first + k];
  if (p->outcome == QUOTE_FOUND || (p->outcome == QUOTE_ELSEWHERE && say_moved(out, q, p))) return;
  say_quotation(out, item);
  if (item->n > 1) text_printf(out, ", piece %zu of %zu", k + 1, item->n);
  text_add(out, ": ");
  if (p->outcome == QUOTE_PLACELESS) {
    say_placeless(out, p, &text->tokens);
    return;
  }
  if (p->outcome == QUOTE_MISNAMED) {
    text_printf(out, "at token %zu, but no equation (%s) ends there\n", p->place, item->equation);
    return;
  }
  text_printf(out, "not at token %zu", p->place);
  if (p->outcome == QUOTE_ELSEWHERE) text_printf(out, ", but at %zu", p->elsewhere);
  text_add_char(out, '\n');
  say_difference(out, p, text);
}

static bool number_found(const struct quotations *q, const struct quoted_number *n) {
  return n->same && quotation_found(q, n->of);
}

/* One that is quoted, but whose quotation is not found, has been said. */
static void say_number(struct text *out, const struct quotations *q, const struct quoted_number *n) {
  if (n->same) return;
  const struct source *src = &q->scene[n->scene].src;
  say_file(out, src, (size_t)(n->line - src->text));
  text_printf(out, ": printed %.*s: ", (int)n->len, n->line);
  if (n->of) say_name(out, n->of);
  text_printf(out, "%s%s\n", n->of ? ", is " : "no claim quotes it", n->of ? n->of->field->text : "");
}

static void say_count(struct text *out, const char *what, size_t found, size_t n) {
  text_printf(out, "%s%zu of %zu", what, found, n);
}

bool quotations_report(struct text *out, const struct quotations *q, const struct paper_text *text) {
  size_t found[N_QUOTE_KINDS] = {0}, n[N_QUOTE_KINDS] = {0}, numbers = 0, all = 0;
  for (size_t i = 0; i < q->n; i++) {
    const struct quotation *item = &q->item[i];
    n[item->kind]++;
    if (quotation_found(q, item)) found[item->kind]++;
    for (size_t k = 0; k < item->n; k++) say_piece(out, q, item, k, text);
  }
  for (size_t i = 0; i < q->n_numbers; i++) {
    if (number_found(q, &q->number[i])) numbers++;
    say_number(out, q, &q->number[i]);
  }
  for (int k = 0; k < N_QUOTE_KINDS; k++) all += found[k];
  say_count(out, "quotations: ", all, q->n);
  say_count(out, " found (title ", found[QUOTE_TITLE], n[QUOTE_TITLE]);
  say_count(out, ", tex ", found[QUOTE_TEX], n[QUOTE_TEX]);
  say_count(out, ", quote ", found[QUOTE_CLAIM], n[QUOTE_CLAIM]);
  if (n[QUOTE_STATEMENT] > 0) say_count(out, ", statement ", found[QUOTE_STATEMENT], n[QUOTE_STATEMENT]);
  say_count(out, "); printed numbers of scenes: ", numbers, q->n_numbers);
  text_add_char(out, '\n');
  return all == q->n && numbers == q->n_numbers;
}
