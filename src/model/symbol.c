/* The domains that a paper declares for its symbols: "domain: real", or an inequality of the grammar with the symbol in
   it and exact numbers around it.  A domain holds more than one number, so that there is always something to draw. */
#include "symbol.h"

#include <stdlib.h>
#include <string.h>

void symbol_init(struct symbol *s, const struct record *r, const struct source *src) {
  *s = (struct symbol){.name = r->id_name, .record = r, .src = src};
  fmpq_init(s->low.at);
  fmpq_init(s->high.at);
}

void symbols_clear(struct symbol *s, size_t n) {
  for (size_t i = 0; i < n; i++) {
    fmpq_clear(s[i].low.at);
    fmpq_clear(s[i].high.at);
  }
  free(s);
}

bool symbol_takes(const struct symbol *s, const fmpq_t z) {
  int low = s->low.bounded ? fmpq_cmp(z, s->low.at) : 1, high = s->high.bounded ? fmpq_cmp(s->high.at, z) : 1;
  return (low > 0 || (low == 0 && s->low.closed)) && (high > 0 || (high == 0 && s->high.closed));
}

/* The value of a number, a quotient of two, or either with a sign; false for other forms. */
static bool exact_number(fmpq_t z, const struct expr *e) {
  NUMBERS(fmpq, by);
  bool ok;
  switch (e->kind) {
  case EXPR_NUM:
    return num_parse_decimal(z, e->name, strlen(e->name)) == SS_OK;
  case EXPR_PAREN:
    return exact_number(z, e->args[0]);
  case EXPR_NEG:
    ok = exact_number(z, e->args[0]);
    fmpq_neg(z, z);
    return ok;
  case EXPR_DIV:
    ok = exact_number(z, e->args[0]) && exact_number(by, e->args[1]) && !fmpq_is_zero(by);
    if (ok) fmpq_div(z, z, by);
    return ok;
  default:
    return false;
  }
}

/* One step of the chain, with the symbol on one side of it. */
static bool take_bound(struct symbol *s, const struct expr *left, enum relop op, const struct expr *right) {
  bool on_left = left->kind == EXPR_SYM && strcmp(left->name, s->name) == 0;
  bool on_right = right->kind == EXPR_SYM && strcmp(right->name, s->name) == 0;
  bool less = op == REL_LT || op == REL_LE;
  if (op == REL_EQ || on_left == on_right) return false;
  bool is_high = on_left == less;
  bool *bounded = is_high ? &s->high.bounded : &s->low.bounded;
  if (*bounded) return false;
  *bounded = true;
  *(is_high ? &s->high.closed : &s->low.closed) = op == REL_LE || op == REL_GE;
  return exact_number(is_high ? s->high.at : s->low.at, on_left ? right : left);
}

static bool take_chain(struct symbol *s, const struct stmt *chain) {
  if (chain->kind != STMT_RELATION || chain->range_var || chain->n_sides > 3) return false;
  for (int i = 0; i + 1 < chain->n_sides; i++)
    if (!take_bound(s, chain->sides[i], chain->ops[i], chain->sides[i + 1])) return false;
  return !s->low.bounded || !s->high.bounded || fmpq_cmp(s->low.at, s->high.at) < 0;
}

bool symbol_read_domain(struct symbol *s, struct diag *d) {
  const struct field *f = record_field(s->record, "domain");
  if (!f) return true;
  s->has_domain = true;
  if (strcmp(f->text, "real") == 0) return true;
  LOCAL(arena, a);
  struct diag why = {0};
  const struct stmt *chain = stmt_parse(&a, s->src, f->value, &why);
  return (chain && take_chain(s, chain)) ||
         diag_at(
             d, s->src, f->value.begin,
             "a domain reads \"real\" or \"0 < %s < 1\", with <, <=, > or >= and one or two exact numbers, the lower "
             "less than the upper",
             s->name);
}
