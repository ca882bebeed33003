/* The stable layer held against the corrected one, by exact algebra.  The field knows the frequencies and their half angles,
   so that what is to be shown is that differences of rational functions are zero. */
#include "stickslip/stable.h"

#include <stdlib.h>
#include <string.h>

#include "stickslip/exact.h"

enum { N_POSITIVE = 6, N_TIMES = 5, N_ANGLES = 4, STABLE_TERMS = 4096 };

typedef fmpz_mpoly_q_struct element;

/* The parameters by the frequencies, and the angles of the phases. */
struct stable_field {
  struct exact_field *field;
  element frequency[2], chi, eta, g_1;
  element positive[N_POSITIVE], angle[N_TIMES * N_ANGLES];
  int status;
};

/* --- The field --- */

static void combine(struct stable_field *s, num_binary op, element *z, const element *x, const element *y) {
  if (s->status == SS_OK) s->status = op(z, x, y, 0);
  if (s->status == SS_OK) s->status = exact_reduce(z, s->field);
}

static void combine_si(struct stable_field *s, num_binary op, element *z, const element *x, slong n) {
  element y;
  exact_init(&y, s->field);
  num_exact.set_d(&y, (double)n, 0);
  combine(s, op, z, x, &y);
  exact_clear(&y, s->field);
}

/* omega is the root of omega_1^2 + omega_2^2 - 1, and its product with sqrt(chi) that of (1 - omega_1^2)(omega_2^2 - 1). */
static void make_parameters(struct stable_field *s) {
  element a, b, *omega = &s->positive[0], *root_chi = &s->positive[1];
  exact_init(&a, s->field);
  exact_init(&b, s->field);
  combine(s, num_exact.mul, &a, &s->frequency[0], &s->frequency[0]);
  combine(s, num_exact.mul, &b, &s->frequency[1], &s->frequency[1]);
  combine_si(s, num_exact.sub, &b, &b, 1);
  combine(s, num_exact.add, omega, &a, &b);
  s->status |= exact_sqrt(omega, s->field, omega);
  combine_si(s, num_exact.sub, &a, &a, 1);
  num_exact.neg(&a, &a, 0);
  num_exact.set(&s->g_1, &a);
  combine(s, num_exact.mul, &a, &a, &b);
  s->status |= exact_sqrt(root_chi, s->field, &a);
  combine(s, num_exact.div, root_chi, root_chi, omega);
  combine(s, num_exact.div, &s->positive[2], omega, root_chi);
  combine(s, num_exact.mul, &a, &s->frequency[0], &s->frequency[1]);
  combine(s, num_exact.div, &s->positive[3], &a, omega);
  combine(s, num_exact.add, &s->positive[4], &s->frequency[1], &s->frequency[0]);
  combine(s, num_exact.sub, &s->positive[5], &s->frequency[1], &s->frequency[0]);
  combine(s, num_exact.mul, &s->chi, root_chi, root_chi);
  combine(s, num_exact.mul, &s->eta, &s->positive[2], &s->positive[2]);
  exact_clear(&b, s->field);
  exact_clear(&a, s->field);
}

/* Half of omega_1 t, omega_2 t, omega t and t, for each time. */
static void make_angles(struct stable_field *s) {
  static const char *const times[N_TIMES] = {"t", "t_a", "t_b", "t_c", "t_d"};
  const element *rate[] = {&s->frequency[0], &s->frequency[1], &s->positive[0]};
  element half;
  exact_init(&half, s->field);
  for (int i = 0; i < N_TIMES; i++) {
    s->status |= exact_symbol(&half, s->field, times[i]);
    combine_si(s, num_exact.div, &half, &half, 4);
    for (int k = 0; k < 3; k++) combine(s, num_exact.mul, &s->angle[i * N_ANGLES + k], &half, rate[k]);
    num_exact.set(&s->angle[i * N_ANGLES + 3], &half);
  }
  exact_clear(&half, s->field);
}

static int bind(element *z, struct exact_field *f, const char *name, void *stable) {
  const struct stable_field *s = stable;
  const element *known = strcmp(name, "chi") == 0        ? &s->chi
                         : strcmp(name, "eta") == 0      ? &s->eta
                         : strcmp(name, "g_1[1,1]") == 0 ? &s->g_1
                                                         : NULL;
  if (!known) return exact_symbol(z, f, name);
  num_exact.set(z, known);
  return SS_OK;
}

/* All the elements of the field that it owns. */
static void each_element(struct stable_field *s, void (*act)(element *x, const struct exact_field *f)) {
  for (int i = 0; i < 2; i++) act(&s->frequency[i], s->field);
  act(&s->chi, s->field);
  act(&s->eta, s->field);
  act(&s->g_1, s->field);
  for (int i = 0; i < N_POSITIVE; i++) act(&s->positive[i], s->field);
  for (int i = 0; i < N_TIMES * N_ANGLES; i++) act(&s->angle[i], s->field);
}

static void field_make(struct stable_field *s) {
  *s = (struct stable_field){.field = exact_field_new(NULL, 0)};
  exact_field_limit(s->field, STABLE_TERMS);
  each_element(s, exact_init);
  s->status = exact_symbol(&s->frequency[0], s->field, "omega_1") | exact_symbol(&s->frequency[1], s->field, "omega_2");
  make_parameters(s);
  make_angles(s);
  exact_field_bind(s->field, bind, s);
  exact_field_roots(s->field, s->frequency, 2);
  exact_field_positive(s->field, s->positive, N_POSITIVE);
  exact_field_angles(s->field, s->angle, N_TIMES * N_ANGLES, N_ANGLES);
}

static void field_clear(struct stable_field *s) {
  each_element(s, exact_clear);
  exact_field_free(s->field);
}

/* --- One form --- */

/* The entries of what is replaced in one layer, as a tape. */
struct reading {
  struct elaboration el;
  const struct expr **e;
  slong n;
  size_t cap;
  struct tape tape;
};

/* Quantities that long forms are made of in both layers alike.  Where forms are equal whatever these are, they are equal if
   each of these is the same in both layers, which is proved of each without the others.  g_1 = 1 - omega_1^2 has a name in the
   stable layer alone. */
static const struct override held[] = {{"J_b", 2, 1},      {"ktilde_1", 1, 1}, {"H_13", 1, 1},     {"H_23", 1, 1},
                                       {"ktilde_3", 1, 1}, {"ktilde_4", 1, 1}, {"ktilde_5", 1, 1}, {"g_1", 1, 1}};
enum { N_HELD = sizeof held / sizeof *held };

static const char *in_corrected(const char *name) {
  return strcmp(name, "g_1") == 0 ? "1 - omega_1^2" : name;
}

static void reading_init(struct reading *r, const struct model *m, enum layer layer, int n_held) {
  *r = (struct reading){.n = 0};
  elaboration_init(&r->el, (struct view){m, layer, NULL, NULL}, held, n_held);
}

static void reading_clear(struct reading *r) {
  tape_clear(&r->tape);
  free(r->e);
  elaboration_clear(&r->el);
}

static void add_entries(struct reading *r, const struct matrix *m) {
  for (int i = 0; i < m->rows * m->cols; i++) {
    r->e = ss_grow(r->e, (size_t)r->n, &r->cap, sizeof *r->e);
    r->e[r->n++] = m->e[i];
  }
}

static bool read_value(struct reading *r, const char *value, const char *section, struct diag *d) {
  struct source src;
  struct arena a;
  struct matrix m;
  arena_init(&a);
  source_from_string(&src, value, value);
  const struct expr *e = expr_parse(&a, &src, (struct span){0, src.len}, d);
  bool ok = e && elaborate(&m, &r->el, e, &src, section, d);
  if (ok) add_entries(r, &m);
  source_clear(&src);
  arena_clear(&a);
  return ok;
}

static bool read_record(struct reading *r, const struct statement_record *of, struct diag *d) {
  bool ok = true;
  for (int k = 0; ok && k < of->n_stmts; k++)
    for (int i = 0; ok && i + 1 < of->stmts[k]->n_sides; i++) {
      struct matrix left, right;
      ok = elaborate_sides(&left, &right, &r->el, of->stmts[k], i, of->src, of->section, d);
      if (!ok) break;
      add_entries(r, &left);
      add_entries(r, &right);
    }
  return ok;
}

/* Why entries are not shown equal, or NULL. */
static const char *compare(struct stable_proof *p, struct reading r[2]) {
  if (r[0].n != r[1].n) return "the forms have different shapes";
  struct stable_field s;
  struct exact_vec v[2];
  field_make(&s);
  int status = s.status;
  for (int i = 0; i < 2; i++) status |= exact_eval(&v[i], s.field, &r[i].tape);
  const char *why = status & SS_DOMAIN   ? "a divisor is zero for all parameters"
                    : status & SS_UNABLE ? "an expression outgrew the budget of exact algebra"
                                         : NULL;
  for (slong i = 0; !why && i < v[0].len; i++)
    if (!exact_equal(s.field, &v[0].x[i], &v[1].x[i])) why = "an entry differs, as far as exact algebra knows";
  p->entries = (int)r[0].n;
  p->largest = exact_largest(s.field);
  for (int i = 0; i < 2; i++) exact_vec_clear(&v[i]);
  field_clear(&s);
  return why;
}

/* Relations are the same only if what stands between their sides is. */
static bool same_relations(const struct statement_record *a, const struct statement_record *b) {
  bool same = a->n_stmts == b->n_stmts;
  for (int k = 0; same && k < a->n_stmts; k++) {
    same = a->stmts[k]->n_sides == b->stmts[k]->n_sides && !a->stmts[k]->range_var && !b->stmts[k]->range_var;
    for (int i = 0; same && i + 1 < a->stmts[k]->n_sides; i++) same = a->stmts[k]->ops[i] == b->stmts[k]->ops[i];
  }
  return same;
}

/* With that many quantities held as unknowns; value: as the corrected layer and as the stable one writes it;
   record: instead, or NULL. */
static bool attempt(struct stable_proof *p, const struct model *m, const char *const value[2],
                    const struct statement_record *const record[2], int n_held, struct diag *d) {
  static const enum layer layer[2] = {LAYER_CORRECTED, LAYER_STABLE};
  struct reading r[2];
  bool ok = true;
  for (int i = 0; i < 2; i++) reading_init(&r[i], m, layer[i], n_held);
  for (int i = 0; ok && i < 2; i++)
    ok = (record ? read_record(&r[i], record[i], d) : read_value(&r[i], value[i], p->section, d)) &&
         elaboration_tape(&r[i].tape, &r[i].el, r[i].e, r[i].n, d);
  if (ok) p->why_not = compare(p, r);
  for (int i = 0; i < 2; i++) reading_clear(&r[i]);
  return ok;
}

/* Is each held quantity shown to be the same in both layers?  false also when one cannot be read. */
static bool held_proved(const struct model *m) {
  bool yes = true;
  struct diag none;
  diag_init(&none);
  for (int i = 0; yes && i < N_HELD; i++) {
    struct stable_proof p = {.section = "stability"};
    const char *const value[2] = {in_corrected(held[i].name), held[i].name};
    yes = attempt(&p, m, value, NULL, 0, &none) && !p.why_not;
  }
  return yes;
}

static bool is_held(const char *name) {
  bool yes = false;
  for (int i = 0; i < N_HELD; i++) yes = yes || strcmp(held[i].name, name) == 0;
  return yes;
}

/* A value of the two layers, or (value NULL) the record that each of them has; p says where it stands. */
static bool prove(struct stable_proofs *out, struct stable_proof p, const struct model *m, const char *value,
                  const struct statement_record *const record[2], struct diag *d) {
  const char *name = value ? value : record[1]->id;
  p.name = arena_strndup(&out->arena, name, strlen(name));
  const char *const both[2] = {value, value};
  bool ok = attempt(&p, m, both, record, 0, d);
  p.held = ok && p.why_not && !is_held(name) && held_proved(m);
  if (p.held) ok = attempt(&p, m, both, record, N_HELD, d);
  if (!value && !same_relations(record[0], record[1])) p.why_not = "the relations differ";
  out->item = ss_grow(out->item, out->n, &out->cap, sizeof *out->item);
  out->item[out->n++] = p;
  return ok;
}

/* --- All forms --- */

/* NAME or NAME(t) of a definition that the corrected layer has too; false when it has not. */
static bool counterpart(struct text *value, const struct model *m, const struct definition *def) {
  struct diag none;
  diag_init(&none);
  struct view corrected = {m, LAYER_CORRECTED, NULL, NULL};
  if (def->rank != RANK_STABLE || !view_lookup(&corrected, def->name, def->section, &none)) return false;
  text_reset(value);
  text_printf(value, def->stmt->param ? "%s(t)" : "%s", def->name);
  return true;
}

static const struct statement_record *home(const struct model *m, const struct definition *def) {
  for (size_t i = 0; i < m->n_records; i++)
    if (m->records[i].record == def->record) return &m->records[i];
  return NULL;
}

bool stable_prove(struct stable_proofs *out, const struct model *m, struct diag *d) {
  *out = (struct stable_proofs){.n = 0};
  arena_init(&out->arena);
  struct text value;
  text_init(&value);
  bool ok = true;
  for (size_t i = 0; ok && i < m->n_defs; i++)
    if (counterpart(&value, m, &m->defs[i])) {
      struct stable_proof p = {.section = m->defs[i].section, .record = home(m, &m->defs[i]), .stmt = m->defs[i].stmt};
      ok = prove(out, p, m, text_str(&value), NULL, d);
    }
  for (size_t i = 0; ok && i < m->n_records; i++) {
    const struct statement_record *r = &m->records[i];
    if (r->rank != RANK_STABLE || strcmp(r->record->kind_name, "define") == 0) continue;
    struct view corrected = {m, LAYER_CORRECTED, NULL, NULL};
    const struct statement_record *both[2] = {view_record(&corrected, r->id), r};
    if (!both[0]) diag_set(d, "%s replaces no record", r->id);
    ok = both[0] && prove(out, (struct stable_proof){.section = r->section, .record = r}, m, NULL, both, d);
  }
  text_clear(&value);
  return ok;
}

static bool concerns(const struct statement_record *r, const char *equation, const char *record) {
  if (r->rank != RANK_STABLE) return false;
  return equation && *r->equation ? strcmp(r->equation, equation) == 0 : record && strcmp(r->id, record) == 0;
}

void stable_explain(struct text *out, const struct model *m, const char *equation, const char *record) {
  bool any = false;
  for (size_t i = 0; i < m->n_records; i++) any = any || concerns(&m->records[i], equation, record);
  if (!any) return;
  struct stable_proofs p;
  struct diag d;
  diag_init(&d);
  bool ok = stable_prove(&p, m, &d);
  if (!ok) text_printf(out, "%-11s cannot be read over these formulas: %s\n", "stable", d.message);
  for (size_t i = 0; ok && i < p.n; i++) {
    const struct statement_record *r = p.item[i].record;
    if (!concerns(r, equation, record)) continue;
    for (int k = 0; k < r->n_stmts; k++) {
      if (p.item[i].stmt && r->stmts[k] != p.item[i].stmt) continue;
      text_printf(out, "%-11s ", "stable");
      stmt_print(out, r->stmts[k]);
      text_printf(out, " (%s%s)\n", p.item[i].why_not ? "not proved: " : "proved equal",
                  p.item[i].why_not ? p.item[i].why_not : "");
    }
  }
  stable_proofs_clear(&p);
}

void stable_proofs_clear(struct stable_proofs *p) {
  free(p->item);
  arena_clear(&p->arena);
}
