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

static const char *trajectory_argument(const struct stmt *s, const char *name) {
  for (int i = 0; i < s->n_names; i++)
    if (strcmp(s->names[i], name) == 0) return s->params[i];
  return NULL;
}

static enum latex_name kind_of_name(const char **param, const void *context, const char *name) {
  const struct seen_from *from = context;
  struct diag ambiguous;
  diag_init(&ambiguous);
  const struct definition *def = view_lookup(&from->view, name, from->section, &ambiguous);
  *param = !def ? NULL : def->stmt->kind == STMT_TRAJECTORY ? trajectory_argument(def->stmt, name) : def->stmt->param;
  if (*param) return LATEX_FUNCTION;
  return def || model_is_symbol(from->view.model, name) ? LATEX_VALUE : LATEX_UNKNOWN;
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
  diag_at(d, src, fd->value.begin, "a reading is \"piece of the TeX as other TeX\"");
  return false;
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

static const struct expr *without_parentheses(const struct expr *e) {
  while (e->kind == EXPR_PAREN) e = e->args[0];
  return e;
}

/* a^(-1) is the inverse of a, of matrices and numbers alike. */
static bool is_inverse(const struct expr *e) {
  return e->kind == EXPR_INV || (e->kind == EXPR_POW && e->exponent == -1);
}

static bool same_name(const char *a, const char *b) {
  return a == b || (a && b && strcmp(a, b) == 0);
}

static bool same_node(const struct expr *a, const struct expr *b) {
  if (is_inverse(a) && is_inverse(b)) return true;
  return a->kind == b->kind && same_name(a->name, b->name) && a->order == b->order && a->exponent == b->exponent &&
         a->rows == b->rows && a->cols == b->cols && a->n_index == b->n_index && a->n_args == b->n_args &&
         memcmp(a->index, b->index, sizeof a->index) == 0;
}

/* Where two trees part: the innermost pair that holds every difference; false where they are the same. */
static bool find_difference(const struct expr **a, const struct expr **b) {
  const struct expr *x = without_parentheses(*a), *y = without_parentheses(*b);
  bool differ = !same_node(x, y);
  if (differ) {
    *a = x;
    *b = y;
    return true;
  }
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

enum { MAX_SIDES = 16 };

/* A statement as a chain of sides: a definition is "name = expression", a root "expression = 0". */
struct chain {
  const struct expr *side[MAX_SIDES];
  enum relop op[MAX_SIDES];
  int n;
  struct expr made[2]; /* the side that the statement does not have as an expression, and what is inside it */
  const struct expr *inside;
};

static void relation_chain(struct chain *c, const struct stmt *s) {
  c->n = s->n_sides < MAX_SIDES ? s->n_sides : MAX_SIDES;
  for (int i = 0; i < c->n; i++) {
    c->side[i] = s->sides[i];
    c->op[i] = i + 1 < s->n_sides ? s->ops[i] : REL_EQ;
  }
}

/* c must stay where it is. */
static void chain_of(struct chain *c, const struct stmt *s) {
  memset(c, 0, sizeof *c);
  if (s->kind == STMT_RELATION) {
    relation_chain(c, s);
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
  c->side[root] = &made[0];
  c->side[!root] = s->sides[0];
}

/* name := sqrt(a), of which the TeX says name^2 = a. */
static void square_chain(struct chain *c, const struct stmt *typed, const struct stmt *tex) {
  if (typed->kind != STMT_DEFINE || typed->param || typed->sides[0]->kind != EXPR_SQRT) return;
  if (tex->sides[0]->kind != EXPR_POW || tex->sides[0]->exponent != 2) return;
  c->made[1] = c->made[0];
  c->inside = &c->made[1];
  c->made[0] =
      (struct expr){.kind = EXPR_POW, .exponent = 2, .n_args = 1, .args = &c->inside, .span = typed->name_span};
  c->side[1] = typed->sides[0]->args[0];
}

/* lo < v < hi of the TeX, for a variable of the record's ranges, is where its statements hold. */
static const struct stmt *domain_of(const struct stmt *typed, const struct stmt *const *tex, size_t n) {
  if (!typed->range_var || typed->range_signs) return NULL;
  for (size_t i = 0; i < n; i++)
    if (tex[i]->n_sides == 3 && tex[i]->ops[0] == REL_LT && tex[i]->ops[1] == REL_LT &&
        tex[i]->sides[1]->kind == EXPR_SYM && strcmp(tex[i]->sides[1]->name, typed->range_var) == 0)
      return tex[i];
  return NULL;
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
  diag_at(c->d, c->r->src, typed, "%s: %s: %s here, %s in the TeX at %zu:%zu", c->r->id, what, here, there, line,
          column);
  return false;
}

static bool same_side(const struct comparison *c, const struct expr *typed, const struct expr *tex) {
  if (!find_difference(&typed, &tex)) return true;
  struct text here, there;
  text_init(&here);
  text_init(&there);
  expr_print(&here, typed);
  expr_print(&there, tex);
  mistake(c, typed->span.begin, tex->span.begin, "the formula is not what its TeX says", text_str(&here),
          text_str(&there));
  text_clear(&here);
  text_clear(&there);
  return false;
}

static bool same_range(const struct comparison *c, const struct stmt *typed, const struct stmt *tex,
                       const struct stmt *domain) {
  size_t at = typed->span.begin, there = tex->span.begin;
  if (domain) return same_side(c, typed->range_lo, domain->sides[0]) && same_side(c, typed->range_hi, domain->sides[2]);
  if (same_name(typed->range_var, tex->range_var) && typed->range_signs == tex->range_signs) return true;
  return mistake(c, at, there, "the range is not what the TeX says", typed->range_var ? typed->range_var : "none",
                 tex->range_var ? tex->range_var : "none");
}

static bool same_statement(const struct comparison *c, const struct stmt *typed, const struct stmt *tex) {
  static const char *const sign[] = {[REL_EQ] = "=", [REL_LT] = "<", [REL_LE] = "<=", [REL_GT] = ">", [REL_GE] = ">="};
  struct chain a, b;
  chain_of(&a, typed);
  chain_of(&b, tex);
  square_chain(&a, typed, tex);
  for (int i = 0; i < a.n && i < b.n; i++) {
    if (!same_side(c, a.side[i], b.side[i])) return false;
    if (i + 1 < a.n && i + 1 < b.n && a.op[i] != b.op[i])
      return mistake(c, a.side[i]->span.end, b.side[i]->span.end, "the relation is not that of the TeX", sign[a.op[i]],
                     sign[b.op[i]]);
  }
  if (a.n != b.n)
    return mistake(c, typed->span.end, tex->span.end, "one chain goes on", a.n > b.n ? "longer" : "shorter",
                   a.n > b.n ? "shorter" : "longer");
  return same_range(c, typed, tex, domain_of(typed, c->tex, c->n_tex));
}

static bool is_domain(const struct comparison *c, const struct stmt *tex) {
  for (int i = 0; i < c->r->n_stmts; i++)
    if (domain_of(c->r->stmts[i], &tex, 1)) return true;
  return false;
}

static bool same_statements(const struct comparison *c) {
  size_t k = 0;
  for (int i = 0; i < c->r->n_stmts; i++) {
    const struct stmt *typed = c->r->stmts[i];
    if (typed->kind == STMT_TRAJECTORY) continue;
    while (k < c->n_tex && is_domain(c, c->tex[k])) k++;
    if (k == c->n_tex) {
      diag_at(c->d, c->r->src, typed->span.begin, "%s: the TeX does not say this", c->r->id);
      return false;
    }
    if (!same_statement(c, typed, c->tex[k++])) return false;
  }
  while (k < c->n_tex && is_domain(c, c->tex[k])) k++;
  if (k == c->n_tex) return true;
  diag_at(c->d, c->r->src, c->tex[k]->span.begin, "%s: no formula of the record says this", c->r->id);
  return false;
}

static bool check_record(const struct model *m, const struct statement_record *r, struct arena *a, struct diag *d) {
  struct seen_from from = {{.model = m, .layer = r->rank == RANK_ERRATA ? LAYER_CORRECTED : LAYER_PRINTED}, r->section};
  struct latex_names names = {kind_of_name, &from};
  struct latex_formula f = {.src = r->src, .tex = record_field(r->record, "tex")->value};
  struct latex_reading *readings = NULL;
  struct comparison c = {.r = r, .d = d};
  bool ok = readings_of(&readings, &f.n_readings, r, d);
  f.readings = readings;
  ok = ok && (c.tex = latex_statements(&c.n_tex, a, &f, &names, d)) && same_statements(&c);
  free(readings);
  return ok;
}

bool model_check_tex(const struct model *m, enum rank last, struct diag *d) {
  struct arena a;
  arena_init(&a);
  bool ok = true;
  for (size_t i = 0; ok && i < m->n_records; i++) {
    const struct statement_record *r = &m->records[i];
    if (*r->tex && r->rank <= last) ok = check_record(m, r, &a, d);
  }
  arena_clear(&a);
  return ok;
}
