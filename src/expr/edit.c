/* One-token edits.  The trees of a statement are laid out as a list of nodes in the order of the text, each with its
   parent; an edit replaces one node by a new subtree and copies the path above it, so that nothing recurses and all
   edits share what they leave alone.  Edits that print alike are one edit. */
#include "edit.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EDIT_STRING(upper, lower) #lower,
const char *const edit_kind_name[N_EDIT_KINDS] = {EDIT_KINDS(EDIT_STRING)};

/* A node of the statement's trees: trees are its sides, then the ends of its range. */
struct place {
  const struct expr *e;
  int parent; /* in the list; -1 for a whole tree */
  int arg;    /* which operand of the parent, or which tree */
};

struct job {
  struct edits *out;
  size_t first; /* of this statement's edits */
  struct arena *arena;
  const struct stmt *stmt;
  const char *original; /* printed */
  const struct edit_vocabulary *words;
  struct place *place;
  int n;
};

/* --- New trees --- */

static struct expr *copy_node(struct job *j, const struct expr *e) {
  struct expr *c = arena_alloc(j->arena, sizeof *c);
  *c = *e;
  if (e->n_args > 0) {
    c->args = arena_alloc(j->arena, (size_t)e->n_args * sizeof *c->args);
    memcpy(c->args, e->args, (size_t)e->n_args * sizeof *c->args);
  }
  return c;
}

static const struct expr *with_arg(struct job *j, const struct expr *e, int i, const struct expr *arg) {
  struct expr *c = copy_node(j, e);
  c->args[i] = arg;
  return c;
}

static const struct expr *with_kind(struct job *j, const struct expr *e, enum expr_kind k) {
  struct expr *c = copy_node(j, e);
  c->kind = k;
  return c;
}

static const struct expr *new_node(struct job *j, enum expr_kind k, const struct expr *a, const struct expr *b) {
  struct expr *e = arena_alloc(j->arena, sizeof *e);
  e->kind = k;
  e->span = a->span;
  e->n_args = b ? 2 : 1;
  e->args = arena_alloc(j->arena, (size_t)e->n_args * sizeof *e->args);
  e->args[0] = a;
  if (b) e->args[1] = b;
  return e;
}

static const struct expr *new_leaf(struct job *j, const char *name, struct span span) {
  struct expr *e = arena_alloc(j->arena, sizeof *e);
  e->kind = isdigit((unsigned char)name[0]) ? EXPR_NUM : EXPR_SYM;
  e->name = arena_strdup(j->arena, name);
  e->span = span;
  return e;
}

static const struct expr *with_name(struct job *j, const struct expr *e, const char *name) {
  struct expr *c = copy_node(j, e);
  c->name = arena_strdup(j->arena, name);
  return c;
}

static bool is_literal(const struct expr *e, const char *digits) {
  return e->kind == EXPR_NUM && strcmp(e->name, digits) == 0;
}

static bool is_sum(const struct expr *e) {
  return e->kind == EXPR_ADD || e->kind == EXPR_SUB;
}
static bool is_product(const struct expr *e) {
  return e->kind == EXPR_MUL || e->kind == EXPR_DIV;
}

/* --- Booking an edit --- */

static const char *printed(struct job *j, const struct expr *e) {
  OWNED(text) t = {0};
  expr_print(&t, e);
  return arena_strndup(j->arena, text_str(&t), t.len);
}

static void book(struct job *j, enum edit_kind kind, struct span where, const char *was, const char *now,
                 const struct stmt *s) {
  OWNED(text) t = {0};
  stmt_print(&t, s);
  bool fresh = strcmp(text_str(&t), j->original) != 0 && j->out->n - j->first < EDIT_MAX;
  for (size_t i = j->first; fresh && i < j->out->n; i++) fresh = strcmp(j->out->edit[i].text, text_str(&t)) != 0;
  if (fresh)
    *SS_PUSH(j->out->edit, j->out->n, j->out->cap) =
        (struct edit){kind, where, was, now, arena_strndup(j->arena, text_str(&t), t.len), s};
}

/* Tree k of a copy of the statement becomes e. */
static struct stmt *with_tree(struct job *j, int k, const struct expr *e) {
  struct stmt *s = arena_alloc(j->arena, sizeof *s);
  *s = *j->stmt;
  if (k == s->n_sides) s->range_lo = e;
  if (k == s->n_sides + 1) s->range_hi = e;
  if (k >= s->n_sides) return s;
  s->sides = arena_alloc(j->arena, (size_t)s->n_sides * sizeof *s->sides);
  memcpy(s->sides, j->stmt->sides, (size_t)s->n_sides * sizeof *s->sides);
  s->sides[k] = e;
  return s;
}

static void replace(struct job *j, int i, enum edit_kind kind, const struct expr *by) {
  const struct expr *was = j->place[i].e, *now = by;
  while (j->place[i].parent >= 0) {
    const struct place *p = &j->place[i];
    by = with_arg(j, j->place[p->parent].e, p->arg, by);
    i = p->parent;
  }
  book(j, kind, was->span, printed(j, was), printed(j, now), with_tree(j, j->place[i].arg, by));
}

/* --- Where a node stands --- */

static const struct expr *parent_of(const struct job *j, int i) {
  return j->place[i].parent < 0 ? NULL : j->place[j->place[i].parent].e;
}

/* A place that takes a whole sum: a side, an entry, an argument, the inside of brackets. */
static bool takes_sum(const struct job *j, int i) {
  const struct expr *p = parent_of(j, i);
  return !p || (!is_sum(p) && !is_product(p) && p->kind != EXPR_NEG && p->kind != EXPR_POW && p->kind != EXPR_INDEX);
}

/* A whole term: not a factor of something larger, not a sum or a minus itself. */
static bool is_term(const struct job *j, int i) {
  const struct expr *p = parent_of(j, i), *e = j->place[i].e;
  bool whole = takes_sum(j, i) || is_sum(p) || p->kind == EXPR_NEG;
  return whole && !is_sum(e) && e->kind != EXPR_NEG && !is_literal(e, "0");
}

/* --- The kinds --- */

static void edit_sign(struct job *j, int i) {
  const struct expr *e = j->place[i].e;
  if (is_sum(e)) replace(j, i, EDIT_SIGN, with_kind(j, e, e->kind == EXPR_ADD ? EXPR_SUB : EXPR_ADD));
  if (e->kind == EXPR_NEG) replace(j, i, EDIT_SIGN, e->args[0]);
  /* a minus before the first term of a sum, which is the first node below that is none */
  bool first = is_term(j, i);
  int k = i;
  while (first && !takes_sum(j, k)) {
    first = is_sum(parent_of(j, k)) && j->place[k].arg == 0;
    k = j->place[k].parent;
  }
  if (first) replace(j, i, EDIT_SIGN, new_node(j, EXPR_NEG, e, NULL));
}

static void edit_operator(struct job *j, int i) {
  const struct expr *e = j->place[i].e;
  if (is_product(e)) replace(j, i, EDIT_OPERATOR, with_kind(j, e, e->kind == EXPR_MUL ? EXPR_DIV : EXPR_MUL));
}

static void edit_exponent(struct job *j, int i) {
  const struct expr *e = j->place[i].e;
  for (int d = -1; e->kind == EXPR_POW && d <= 1; d += 2) {
    struct expr *c = copy_node(j, e);
    c->exponent += d;
    if (c->exponent != 0 && abs(c->exponent) < 9999) replace(j, i, EDIT_EXPONENT, c->exponent == 1 ? e->args[0] : c);
  }
}

static void edit_number(struct job *j, int i) {
  const struct expr *e = j->place[i].e;
  if (e->kind != EXPR_NUM || strlen(e->name) > 6 || strspn(e->name, "0123456789") != strlen(e->name)) return;
  long n = strtol(e->name, NULL, 10);
  for (long d = -1; d <= 1; d += 2) {
    char digits[24];
    if (n + d < 0) continue;
    snprintf(digits, sizeof digits, "%ld", n + d);
    replace(j, i, EDIT_NUMBER, new_leaf(j, digits, e->span));
  }
}

/* An entry's indices: one off; a block's: moved by one, or by its width. */
static void edit_entry(struct job *j, int i) {
  const struct expr *e = j->place[i].e;
  for (int k = 0; e->kind == EXPR_INDEX && k < e->n_index; k++) {
    int width = e->index[2 * k + 1] - e->index[2 * k] + 1;
    int step[] = {-width, -1, 1, width};
    for (int s = width == 1; s < 4 - (width == 1); s++) {
      struct expr *c = copy_node(j, e);
      c->index[2 * k] += step[s];
      c->index[2 * k + 1] += step[s];
      if (c->index[2 * k] >= 1 && c->index[2 * k + 1] < 9999) replace(j, i, EDIT_INDEX, c);
    }
  }
}

bool edit_same_family(const char *a, const char *b) {
  const char *index = strchr(a, '_');
  if (!index || strlen(a) != strlen(b) || strncmp(a, b, (size_t)(index - a) + 1) != 0) return false;
  int differ = 0;
  for (size_t i = (size_t)(index - a) + 1; a[i]; i++) differ += a[i] != b[i];
  return differ == 1;
}

static const struct edit_word *find_word(const struct job *j, const char *name) {
  for (size_t k = 0; k < j->words->n_words; k++)
    if (strcmp(j->words->word[k].name, name) == 0) return &j->words->word[k];
  return NULL;
}

/* The name for others of its class: its family as an index, the rest as a symbol. */
static void edit_name(struct job *j, int i, bool family) {
  const struct expr *e = j->place[i].e;
  const struct edit_word *self = e->kind == EXPR_SYM || e->kind == EXPR_CALL ? find_word(j, e->name) : NULL;
  for (size_t k = 0; self && k < j->words->n_words; k++) {
    const struct edit_word *w = &j->words->word[k];
    if (w == self || w->rows != self->rows || w->cols != self->cols || w->function != self->function) continue;
    bool related = edit_same_family(e->name, w->name);
    if (family != related || !(related || w->here || (w->plain && self->plain))) continue;
    replace(j, i, family ? EDIT_INDEX : EDIT_SYMBOL, with_name(j, e, w->name));
  }
}

static void edit_function(struct job *j, int i) {
  static const enum expr_kind other[][2] = {
      {EXPR_SIN, EXPR_COS},      {EXPR_SIN, EXPR_COT},      {EXPR_COS, EXPR_SIN},   {EXPR_COS, EXPR_COT},
      {EXPR_COT, EXPR_SIN},      {EXPR_COT, EXPR_COS},      {EXPR_DET, EXPR_TR},    {EXPR_TR, EXPR_DET},
      {EXPR_SINC, EXPR_STUMPFF}, {EXPR_STUMPFF, EXPR_SINC}, {EXPR_INV, EXPR_PAREN}, {EXPR_TRANSPOSE, EXPR_PAREN},
      {EXPR_SQRT, EXPR_PAREN}};
  const struct expr *e = j->place[i].e;
  for (size_t k = 0; k < sizeof other / sizeof *other; k++)
    if (other[k][0] == e->kind) replace(j, i, EDIT_FUNCTION, with_kind(j, e, other[k][1]));
  for (int k = 0; e->kind == EXPR_HYPOT && k < 2; k++)
    replace(j, i, EDIT_FUNCTION, new_node(j, EXPR_PAREN, e->args[k], NULL));
}

static void edit_prime(struct job *j, int i) {
  const struct expr *e = j->place[i].e;
  for (int d = -1; e->kind == EXPR_CALL && d <= 1; d += 2) {
    struct expr *c = copy_node(j, e);
    c->order += d;
    if (c->order >= 0 && c->order <= 2) replace(j, i, EDIT_PRIME, c);
  }
  const char *bar = e->kind == EXPR_SYM ? strchr(e->name, '_') : NULL;
  if (!bar || strlen(e->name) > 60) return;
  bool has = bar > e->name && bar[-1] == '\'';
  char name[64];
  snprintf(name, sizeof name, "%.*s%s%s", (int)(bar - e->name) - has, e->name, has ? "" : "'", bar);
  if (find_word(j, name)) replace(j, i, EDIT_PRIME, with_name(j, e, name));
}

/* In a chain the last operand goes at its own node, the first one at the innermost. */
static void edit_dropped(struct job *j, int i) {
  const struct expr *e = j->place[i].e;
  if (!is_sum(e) && !is_product(e)) return;
  const struct expr *a = e->args[0], *b = e->args[1];
  replace(j, i, EDIT_DROPPED, a);
  if (is_sum(e) ? is_sum(a) : is_product(a)) return;
  if (e->kind == EXPR_SUB) replace(j, i, EDIT_DROPPED, new_node(j, EXPR_NEG, b, NULL));
  if (e->kind == EXPR_DIV) replace(j, i, EDIT_DROPPED, with_arg(j, e, 0, new_leaf(j, "1", a->span)));
  if (e->kind == EXPR_ADD || e->kind == EXPR_MUL) replace(j, i, EDIT_DROPPED, b);
}

static void edit_factor(struct job *j, int i) {
  const struct expr *e = j->place[i].e;
  for (int k = 0; is_term(j, i) && k < j->words->n_factors; k++) {
    const struct expr *f = new_leaf(j, j->words->factor[k], e->span);
    const struct expr *by = e->kind == EXPR_DIV  ? with_arg(j, e, 0, new_node(j, EXPR_MUL, e->args[0], f))
                            : is_literal(e, "1") ? f
                                                 : new_node(j, EXPR_MUL, e, f);
    replace(j, i, EDIT_FACTOR, by);
  }
}

static void edit_term(struct job *j, int i) {
  const struct expr *e = j->place[i].e, *p = parent_of(j, i);
  const struct edit_word *self = e->kind == EXPR_SYM ? find_word(j, e->name) : NULL;
  for (size_t k = 0; self && p && p->kind == EXPR_CALL && k < j->words->n_words; k++) {
    const struct edit_word *w = &j->words->word[k];
    if (w == self || w->function || w->rows * w->cols != 1 || !edit_same_family(e->name, w->name)) continue;
    replace(j, i, EDIT_TERM, new_node(j, EXPR_ADD, new_leaf(j, w->name, e->span), e));
  }
}

/* --- Factors moved across the bar of a quotient --- */

enum { MAX_FACTORS = 32 };

/* The factors of a product without a quotient in it; 0 when there are too many. */
static int factors(const struct expr *f[MAX_FACTORS], const struct expr *e) {
  int n = 0;
  while (e->kind == EXPR_PAREN && e->args[0]->kind == EXPR_MUL) e = e->args[0];
  for (; e->kind == EXPR_MUL; e = e->args[0]) {
    if (n == MAX_FACTORS - 1) return 0;
    f[n++] = e->args[1];
  }
  f[n++] = e;
  for (int i = 0; i < n / 2; i++) {
    const struct expr *t = f[i];
    f[i] = f[n - 1 - i];
    f[n - 1 - i] = t;
  }
  return n;
}

/* The product of all factors but one, and perhaps of one more; NULL for an empty product. */
static const struct expr *product(struct job *j, const struct expr *const *f, int n, int without,
                                  const struct expr *more) {
  const struct expr *p = NULL;
  for (int i = 0; i <= n; i++) {
    const struct expr *g = i == n ? more : f[i];
    if (i == without || !g) continue;
    p = p ? new_node(j, EXPR_MUL, p, g) : g;
  }
  return p;
}

static const struct expr *quotient(struct job *j, const struct expr *num, const struct expr *den, struct span span) {
  if (!num) num = new_leaf(j, "1", span);
  return den ? new_node(j, EXPR_DIV, num, den) : num;
}

static void edit_moved(struct job *j, int i) {
  const struct expr *e = j->place[i].e, *p = parent_of(j, i), *num[MAX_FACTORS], *den[MAX_FACTORS];
  if (!is_product(e) || (p && is_product(p) && j->place[i].arg == 0)) return;
  bool has_bar = e->kind == EXPR_DIV;
  int n = factors(num, has_bar ? e->args[0] : e), m = has_bar ? factors(den, e->args[1]) : 0;
  for (int k = 0; k < m; k++)
    replace(j, i, EDIT_MOVED, quotient(j, product(j, num, n, -1, den[k]), product(j, den, m, k, NULL), e->span));
  for (int k = 0; k < n; k++)
    if (!is_literal(num[k], "1"))
      replace(j, i, EDIT_MOVED, quotient(j, product(j, num, n, k, NULL), product(j, den, m, -1, num[k]), e->span));
}

/* --- Matrices --- */

static void exchange(struct job *j, int i, int a, int b, int n, int stride) {
  struct expr *c = copy_node(j, j->place[i].e);
  for (int k = 0; k < n; k++) {
    const struct expr *t = c->args[a + k * stride];
    c->args[a + k * stride] = c->args[b + k * stride];
    c->args[b + k * stride] = t;
  }
  replace(j, i, EDIT_TRANSPOSED, c);
}

static void edit_transposed(struct job *j, int i) {
  const struct expr *e = j->place[i].e;
  if (e->kind != EXPR_MATRIX) return;
  int r = e->rows, c = e->cols;
  for (int k = 0; k + 1 < r; k++) exchange(j, i, k * c, (k + 1) * c, c, 1);
  for (int k = 0; k + 1 < c; k++) exchange(j, i, k, k + 1, r, c);
  for (int k = 0; r == c && k < r; k++)
    for (int l = k + 1; l < c; l++) exchange(j, i, k * c + l, l * c + k, 1, 1);
  if ((r == 1) == (c == 1)) return;
  struct expr *flat = copy_node(j, e);
  flat->rows = c;
  flat->cols = r;
  replace(j, i, EDIT_TRANSPOSED, flat);
}

/* --- The statement itself --- */

static void edit_relation(struct job *j) {
  static const enum relop other[] = {
      [REL_EQ] = REL_EQ, [REL_LT] = REL_GT, [REL_LE] = REL_GE, [REL_GT] = REL_LT, [REL_GE] = REL_LE};
  const struct stmt *s = j->stmt;
  if (s->kind == STMT_ROOT) {
    struct stmt *c = with_tree(j, 0, s->sides[0]);
    c->largest = !s->largest;
    book(j, EDIT_RELATION, s->span, s->largest ? "largest" : "smallest", s->largest ? "smallest" : "largest", c);
  }
  for (int k = 0; s->kind == STMT_RELATION && k + 1 < s->n_sides; k++) {
    struct stmt *c = with_tree(j, 0, s->sides[0]);
    c->ops = arena_alloc(j->arena, (size_t)(s->n_sides - 1) * sizeof *c->ops);
    memcpy(c->ops, s->ops, (size_t)(s->n_sides - 1) * sizeof *c->ops);
    c->ops[k] = other[s->ops[k]];
    struct span between = {s->sides[k]->span.end, s->sides[k + 1]->span.begin};
    book(j, EDIT_RELATION, between, relop_sign[s->ops[k]], relop_sign[c->ops[k]], c);
  }
}

/* The nodes of all trees in the order in which they are opened; false when there are too many. */
static bool lay_out(struct job *j) {
  const struct stmt *s = j->stmt;
  j->n = 0;
  int open[EDIT_MAX_NODES], n_open = 0;
  for (int k = s->n_sides + 1; k >= 0; k--) {
    const struct expr *tree = k < s->n_sides ? s->sides[k] : k == s->n_sides ? s->range_lo : s->range_hi;
    if (!tree) continue;
    if (j->n == EDIT_MAX_NODES) return false;
    j->place[j->n] = (struct place){tree, -1, k};
    open[n_open++] = j->n++;
  }
  while (n_open > 0) {
    int i = open[--n_open];
    const struct expr *e = j->place[i].e;
    if (e->n_args > EDIT_MAX_NODES - j->n) return false;
    for (int k = e->n_args - 1; k >= 0; k--) {
      j->place[j->n] = (struct place){e->args[k], i, k};
      open[n_open++] = j->n++;
    }
  }
  return true;
}

/* A small symbol of first_order(f; x, y): only another name can stand there. */
static bool is_listed(const struct job *j, int i) {
  const struct expr *p = parent_of(j, i);
  return p && p->kind == EXPR_FIRST_ORDER && j->place[i].arg > 0;
}

static void edit_node(struct job *j, int i) {
  if (is_listed(j, i)) {
    edit_name(j, i, true);
    edit_name(j, i, false);
    return;
  }
  edit_sign(j, i);
  edit_operator(j, i);
  edit_exponent(j, i);
  edit_number(j, i);
  edit_entry(j, i);
  edit_name(j, i, true);
  edit_prime(j, i);
  edit_name(j, i, false);
  edit_function(j, i);
  edit_dropped(j, i);
  edit_factor(j, i);
  edit_term(j, i);
  edit_moved(j, i);
  edit_transposed(j, i);
}

static int by_place(const void *a, const void *b) {
  const struct edit *x = a, *y = b;
  if (x->place.begin != y->place.begin) return x->place.begin < y->place.begin ? -1 : 1;
  if (x->place.end != y->place.end) return x->place.end > y->place.end ? -1 : 1;
  if (x->kind != y->kind) return x->kind < y->kind ? -1 : 1;
  return strcmp(x->text, y->text);
}

void stmt_edits(struct edits *out, struct arena *a, const struct stmt *s, const struct edit_vocabulary *v) {
  struct place place[EDIT_MAX_NODES];
  struct job j = {.out = out, .first = out->n, .arena = a, .stmt = s, .words = v, .place = place};
  if (s->kind == STMT_TRAJECTORY || !lay_out(&j)) return;
  OWNED(text) t = {0};
  stmt_print(&t, s);
  j.original = text_str(&t);
  for (int i = 0; i < j.n; i++) edit_node(&j, i);
  edit_relation(&j);
  if (out->n > j.first) qsort(out->edit + j.first, out->n - j.first, sizeof *out->edit, by_place);
}

void edits_clear(struct edits *e) {
  free(e->edit);
  *e = (struct edits){.n = 0};
}
