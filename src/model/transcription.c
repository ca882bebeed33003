/* Whether the formulas of a record are what its TeX says: the TeX read into statements, held against those typed. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "expr/latex_read.h"
#include "model.h"

/* --- Names as TeX uses them --- */

struct seen_from {
  struct view view;
  const char *section;
};

static enum latex_name kind_of_name(const void *context, const char *name) {
  const struct seen_from *from = context;
  struct diag ambiguous = {0};
  const struct definition *def = view_lookup(&from->view, name, from->section, &ambiguous);
  if (def && (def->stmt->param || def->stmt->kind == STMT_TRAJECTORY)) return LATEX_FUNCTION;
  return def || model_is_symbol(from->view.model, name) || strcmp(name, expr_pi) == 0 ? LATEX_VALUE : LATEX_UNKNOWN;
}

/* --- Readings --- */

/* "PIECE as PIECE" of an attribute. */
static bool split_reading(struct latex_reading *out, const struct source *src, const struct field *fd, struct diag *d) {
  for (size_t i = fd->value.begin; i + 3 < fd->value.end; i++)
    if (isspace((unsigned char)src->text[i]) && strncmp(&src->text[i + 1], "as", 2) == 0 &&
        isspace((unsigned char)src->text[i + 3])) {
      *out = (struct latex_reading){{fd->value.begin, i}, {i + 4, fd->value.end}};
      return true;
    }
  return diag_at(d, src, fd->value.begin, "a reading is \"piece of the TeX as other TeX\"");
}

/* The attributes "reads" of a record, in an array to be freed. */
static bool readings_of(struct latex_reading **out, size_t *n, const struct statement_record *r, struct diag *d) {
  *out = ss_malloc((r->record->n_fields + 1) * sizeof **out);
  *n = 0;
  for (size_t i = 0; i < r->record->n_fields; i++) {
    const struct field *fd = &r->record->fields[i];
    if (!fd->attribute || strcmp(fd->key_name, "reads") != 0) continue;
    if (!split_reading(&(*out)[(*n)++], r->src, fd, d)) return false;
  }
  return true;
}

/* --- Two expressions --- */

/* a^(-1) is the inverse of a, of matrices and numbers alike. */
static bool is_inverse(const struct expr *e) {
  return e->kind == EXPR_INV || (e->kind == EXPR_POW && e->exponent == -1);
}

static bool same_name(const char *a, const char *b) {
  return a == b || (a && b && strcmp(a, b) == 0);
}

/* Where two trees part: the innermost pair that holds every difference; false where they are the same. */
static bool find_difference(const struct expr **a, const struct expr **b) {
  const struct expr *x = expr_bare(*a), *y = expr_bare(*b);
  *a = x;
  *b = y;
  if (!expr_same_node(x, y) && !(is_inverse(x) && is_inverse(y))) return true;
  bool differ = false;
  for (int i = 0; i < x->n_args; i++) {
    const struct expr *left = x->args[i], *right = y->args[i];
    if (!find_difference(&left, &right)) continue;
    *a = differ ? x : left;
    *b = differ ? y : right;
    if (differ) return true;
    differ = true;
  }
  return differ;
}

/* --- Two statements --- */

/* A statement as a chain of sides: a definition is "name = expression", a root "expression = 0". */
struct chain {
  const struct expr *const *side;
  const enum relop *op; /* of a relation; else all are "=" */
  int n;
  const struct expr *pair[2];
  struct expr made[2]; /* the side that the statement does not have as an expression, and what is inside it */
  const struct expr *inside;
};

/* c must stay where it is. */
static void chain_of(struct chain *c, const struct stmt *s) {
  memset(c, 0, sizeof *c);
  if (s->kind == STMT_RELATION) {
    c->n = s->n_sides;
    c->side = s->sides;
    c->op = s->ops;
    return;
  }
  bool root = s->kind == STMT_ROOT;
  struct expr *made = c->made;
  made[0] = (struct expr){.kind = root       ? EXPR_NUM
                                  : s->param ? EXPR_CALL
                                             : EXPR_SYM,
                          .name = root ? "0" : s->name,
                          .span = s->name_span};
  if (s->param && !root) {
    made[1] = (struct expr){.kind = EXPR_SYM, .name = s->param, .span = s->name_span};
    c->inside = &made[1];
    made[0].n_args = 1;
    made[0].args = &c->inside;
  }
  c->n = 2;
  c->side = c->pair;
  c->pair[root] = &made[0];
  c->pair[!root] = s->sides[0];
}

/* name := sqrt(a), of which the TeX says name^2 = a. */
static void square_chain(struct chain *c, const struct stmt *typed, const struct stmt *tex) {
  if (typed->kind != STMT_DEFINE || typed->param || typed->sides[0]->kind != EXPR_SQRT) return;
  if (tex->sides[0]->kind != EXPR_POW || tex->sides[0]->exponent != 2) return;
  c->made[1] = c->made[0];
  c->inside = &c->made[1];
  c->made[0] =
      (struct expr){.kind = EXPR_POW, .exponent = 2, .n_args = 1, .args = &c->inside, .span = typed->name_span};
  c->pair[1] = typed->sides[0]->args[0];
}

/* --- A record --- */

struct comparison {
  const struct statement_record *r;
  const struct stmt **tex;
  size_t n_tex;
  struct diag *d;
};

static bool mistake(const struct comparison *c, size_t typed, size_t tex, const char *what, const char *here,
                    const char *there) {
  size_t line, column;
  source_place(&line, &column, c->r->src, tex);
  return diag_at(c->d, c->r->src, typed, "%s: %s: %s here, %s in the TeX at %zu:%zu", c->r->id, what, here, there, line,
                 column);
}

/* Papers write 0 for a matrix of zeros as a side of an equation. */
static bool same_side(const struct comparison *c, const struct expr *typed, const struct expr *tex) {
  if ((expr_is_zero(tex) && expr_is_zero_matrix(typed)) || !find_difference(&typed, &tex)) return true;
  OWNED(text) here = {0}, there = {0};
  expr_print(&here, typed);
  expr_print(&there, tex);
  return mistake(c, typed->span.begin, tex->span.begin, "the formula is not what its TeX says", text_str(&here),
                 text_str(&there));
}

/* lo < v < hi of the TeX, for a variable of the record's ranges, is where the statements behind it hold. */
static bool is_domain(const struct comparison *c, const struct stmt *tex) {
  if (tex->n_sides != 3 || tex->sides[1]->kind != EXPR_SYM) return false;
  for (int i = 0; i < 2; i++)
    if (tex->ops[i] != REL_LT && tex->ops[i] != REL_LE) return false;
  for (int i = 0; i < c->r->n_stmts; i++)
    if (c->r->stmts[i]->range_lo && same_name(c->r->stmts[i]->range_var, tex->sides[1]->name)) return true;
  return false;
}

static const char *bounds(bool lo_closed, bool hi_closed) {
  static const char *const brackets[2][2] = {{"( )", "( ]"}, {"[ )", "[ ]"}};
  return brackets[lo_closed][hi_closed];
}

static bool same_range(const struct comparison *c, const struct stmt *typed, const struct stmt *tex,
                       const struct stmt *domain) {
  static const char *const what = "the range is not what the TeX says";
  const char *here = typed->range_var, *there = domain ? domain->sides[1]->name : tex->range_var;
  size_t at = typed->span.begin, tex_at = domain ? domain->span.begin : tex->span.begin;
  if (!same_name(here, there) || typed->range_signs != tex->range_signs || (typed->range_lo && !domain))
    return mistake(c, at, tex_at, what, here ? here : "none", there ? there : "none");
  if (!domain) return true;
  const bool lo = domain->ops[0] == REL_LE, hi = domain->ops[1] == REL_LE;
  if (typed->lo_closed != lo || typed->hi_closed != hi)
    return mistake(c, at, tex_at, what, bounds(typed->lo_closed, typed->hi_closed), bounds(lo, hi));
  return same_side(c, typed->range_lo, domain->sides[0]) && same_side(c, typed->range_hi, domain->sides[2]);
}

static bool same_statement(const struct comparison *c, const struct stmt *typed, const struct stmt *tex,
                           const struct stmt *domain) {
  struct chain a;
  chain_of(&a, typed);
  square_chain(&a, typed, tex);
  for (int i = 0; i < a.n && i < tex->n_sides; i++) {
    if (!same_side(c, a.side[i], tex->sides[i])) return false;
    if (i + 1 == a.n || i + 1 == tex->n_sides) break;
    const enum relop op = a.op ? a.op[i] : REL_EQ;
    if (op != tex->ops[i])
      return mistake(c, a.side[i]->span.end, tex->sides[i]->span.end, "the relation is not that of the TeX",
                     relop_sign[op], relop_sign[tex->ops[i]]);
  }
  if (a.n != tex->n_sides)
    return mistake(c, typed->span.end, tex->span.end, "one chain goes on", a.n > tex->n_sides ? "longer" : "shorter",
                   a.n > tex->n_sides ? "shorter" : "longer");
  return same_range(c, typed, tex, domain);
}

static bool same_statements(const struct comparison *c) {
  const struct stmt *domain = NULL;
  size_t k = 0;
  for (int i = 0; i < c->r->n_stmts; i++) {
    const struct stmt *typed = c->r->stmts[i];
    if (typed->kind == STMT_TRAJECTORY) continue;
    if (k < c->n_tex && is_domain(c, c->tex[k])) domain = c->tex[k++];
    if (k == c->n_tex) return diag_at(c->d, c->r->src, typed->span.begin, "%s: the TeX does not say this", c->r->id);
    if (!same_statement(c, typed, c->tex[k++], domain)) return false;
  }
  if (k == c->n_tex) return true;
  return diag_at(c->d, c->r->src, c->tex[k]->span.begin, "%s: no formula of the record says this", c->r->id);
}

static bool check_record(const struct model *m, const struct statement_record *r, struct arena *a, struct diag *d) {
  struct seen_from from = {{.model = m, .layer = r->rank == RANK_ERRATA ? LAYER_CORRECTED : LAYER_PRINTED}, r->section};
  struct latex_names names = {kind_of_name, &from};
  struct latex_formula f = {.src = r->src, .tex = record_field(r->record, "tex")->value};
  FREED struct latex_reading *readings = NULL;
  struct comparison c = {.r = r, .d = d};
  bool ok = readings_of(&readings, &f.n_readings, r, d);
  f.readings = readings;
  return ok && (c.tex = latex_statements(&c.n_tex, a, &f, &names, d)) && same_statements(&c);
}

bool model_check_tex(const struct model *m, enum rank last, struct diag *d) {
  LOCAL(arena, a);
  bool ok = true;
  for (size_t i = 0; ok && i < m->n_records; i++) {
    const struct statement_record *r = &m->records[i];
    if (*r->tex && r->rank <= last) ok = check_record(m, r, &a, d);
  }
  return ok;
}
