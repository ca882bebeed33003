/* A text read in the place of a record's statements. */
#include "judge.h"

const struct statement_record *reread_open(struct reread *r, const struct statement_record *in, const char *text,
                                           const char *name, struct diag *d) {
  source_from_string(&r->src, name, text);
  arena_init(&r->arena);
  const struct stmt *s = stmt_parse(&r->arena, &r->src, (struct span){0, r->src.len}, d);
  if (s && s->kind != STMT_RELATION) diag_at(d, &r->src, s->span.begin, "an equation or an inequality is needed");
  if (!s || s->kind != STMT_RELATION) return NULL;
  r->stmt = s;
  r->record = *in;
  r->record.stmts = &r->stmt;
  r->record.n_stmts = 1;
  r->record.src = &r->src;
  return &r->record;
}

void reread_close(struct reread *r) {
  arena_clear(&r->arena);
  source_clear(&r->src);
}
