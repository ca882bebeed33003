/* What a parser says of a formula that it cannot read.  Each kind of mistake has its own sentence, with its place, that
   ends in what to write instead, since most mistakes are habits of other notations. */
#include <stdarg.h>
#include <stdio.h>

#include "parser.h"

struct shown parser_show(const struct parser *p, struct token t) {
  struct shown s;
  const int longest = 40;
  size_t len = t.end - t.begin;
  if (t.kind == TOK_END)
    snprintf(s.text, sizeof s.text, "the end");
  else if (len > (size_t)longest)
    snprintf(s.text, sizeof s.text, "\"%.*s...\"", longest, p->src->text + t.begin);
  else
    snprintf(s.text, sizeof s.text, "\"%.*s\"", (int)len, p->src->text + t.begin);
  return s;
}

/* Line and column of a place, for messages that name a second one. */
static struct shown show_place(const struct parser *p, size_t at) {
  size_t line, column;
  struct shown s;
  source_place(&line, &column, p->src, at);
  snprintf(s.text, sizeof s.text, "%zu:%zu", line, column);
  return s;
}

void *mistake_at(struct parser *p, size_t at, const char *fmt, ...) {
  char what[400];
  va_list ap;
  va_start(ap, fmt);
  vsnprintf(what, sizeof what, fmt, ap);
  va_end(ap);
  diag_at(p->diag, p->src, at, "%s", what);
  return NULL;
}

void *mistake(struct parser *p, const char *what) {
  return mistake_at(p, p->tok.begin, "%s", what);
}

void *mistake_prime(struct parser *p, size_t at) {
  return mistake_at(p, at,
                    "a prime marks a derivative: it follows the name of a function and is followed by \"(\", "
                    "as in H'(t); a transpose is written transpose(...)");
}

void *mistake_reserved(struct parser *p) {
  return mistake_at(p, p->tok.begin, "%s is a reserved word and cannot be a name", parser_show(p, p->tok).text);
}

void *mistake_unclosed(struct parser *p, struct token open, const char *closer) {
  bool first = p->diag && !p->diag->set;
  mistake_at(p, p->tok.begin, "expected %s to close the \"%c\" opened at %s, found %s", closer, open.kind,
             show_place(p, open.begin).text, parser_show(p, p->tok).text);
  if (first)
    snprintf(p->diag->what, sizeof p->diag->what, "expected %s to close the \"%c\", found %s", closer, open.kind,
             parser_show(p, p->tok).text);
  return NULL;
}

/* Where an operand should begin, something else stands. */
void *mistake_operand(struct parser *p) {
  int before = p->prev.kind;
  if (token_is_relation(before) && token_is_relation(p->tok.kind))
    return mistake(p, "the relations are written = < <= > >=");
  switch (p->tok.kind) {
  case '-': /* the one at the beginning of a sum has been taken: this one follows an operator */
    return mistake_at(p, p->tok.begin, "a sign after \"%c\" needs parentheses: write a%c(-b)", before, before);
  case '+':
    return mistake(p, "a leading \"+\" is not written: leave it out");
  case '\'':
    return mistake_prime(p, p->tok.begin);
  case '*':
    if (before == '*') return mistake(p, "a power is written a^2");
    break;
  case '{':
    return mistake(p, "braces are used for the signs alone: for eps in {+1, -1}");
  default:
    break;
  }
  if (p->tok.kind == TOK_END && p->prev.kind == TOK_END) return mistake(p, "the formula is empty");
  return mistake_at(p, p->tok.begin, "expected a number, a name, \"(\" or \"[\", found %s",
                    parser_show(p, p->tok).text);
}

/* After a complete formula something is left. */
void *mistake_trailing(struct parser *p) {
  static const struct {
    int kind;
    const char *says;
  } sentences[] = {
      {TOK_DEFINE, "only a name or name(argument) can stand before \":=\"; a relation is written \"=\""},
      {',', "unexpected \",\": decimals have a point, and rows are written [a, b]"},
      {';', "unexpected \";\": rows are separated by it inside [ ] only"},
      {':', "unexpected \":\": a value is written NAME = value, a range of indices inside [ ], a definition with "
            "\":=\""},
      {'{', "braces are used for the signs alone: for eps in {+1, -1}"}};
  int kind = p->tok.kind;
  if (kind == ')' || kind == ']' || kind == '}')
    return mistake_at(p, p->tok.begin, "\"%c\" closes nothing: no bracket is open", kind);
  if (token_is_relation(kind)) return mistake(p, "a relation has no place here: only an expression has");
  for (size_t i = 0; i < sizeof sentences / sizeof *sentences; i++)
    if (sentences[i].kind == kind) return mistake(p, sentences[i].says);
  if (parser_token_is(p, p->tok, "for"))
    return mistake(p, "\"for\" gives the range of a relation; there is no relation here");
  return mistake_at(p, p->tok.begin, "unexpected %s", parser_show(p, p->tok).text);
}
