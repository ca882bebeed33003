/* The stable layer held against the corrected one, by exact algebra.  The field knows the frequencies and their half angles,
   so that what is to be shown is that differences of rational functions are zero. */
#include "stickslip/stable.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "stickslip/exact.h"

enum { N_POSITIVE = 6, N_TIMES = 5, N_ANGLES = 4, STABLE_TERMS = 4096 };

typedef fmpz_mpoly_q_struct element;

/* A definition that has no counterpart in the corrected layer and yet a value there, by its record's attribute "equals".
   As an unknown it stands for that value. */
struct part {
  const char *name, *section, *equals;
  int rows, cols;
};
struct part_value {
  const struct part *part;
  struct exact_vec value;
};
enum { MOST_PARTS = 32 };

/* The parameters by the frequencies, and the angles of the phases. */
struct stable_field {
  struct exact_field *field;
  element frequency[2], chi, eta, g_1;
  element positive[N_POSITIVE], angle[N_TIMES * N_ANGLES];
  struct part_value *part; /* values of parts that are held as unknowns */
  int n_parts;
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

static const char *const time_name[N_TIMES] = {"t", "t_a", "t_b", "t_c", "t_d"};

/* omega_1 t, omega_2 t, omega t and t over the unit, for each time. */
static void make_angles(struct stable_field *s, slong unit) {
  const element *rate[] = {&s->frequency[0], &s->frequency[1], &s->positive[0]};
  element half;
  exact_init(&half, s->field);
  for (int i = 0; i < N_TIMES; i++) {
    s->status |= exact_symbol(&half, s->field, time_name[i]);
    combine_si(s, num_exact.div, &half, &half, unit);
    for (int k = 0; k < 3; k++) combine(s, num_exact.mul, &s->angle[i * N_ANGLES + k], &half, rate[k]);
    num_exact.set(&s->angle[i * N_ANGLES + 3], &half);
  }
  exact_clear(&half, s->field);
}

/* An entry of a part, "rest_2[1,2]", by what it equals in the corrected layer; NULL when it is none. */
static const element *part_entry(const struct stable_field *s, const char *name) {
  for (int i = 0; i < s->n_parts; i++) {
    const struct part_value *p = &s->part[i];
    size_t len = strlen(p->part->name);
    if (strncmp(name, p->part->name, len) != 0 || name[len] != '[') continue;
    int row = name[len + 1] - '1', col = name[len + 3] - '1';
    return &p->value.x[row * p->part->cols + col];
  }
  return NULL;
}

static int bind(element *z, struct exact_field *f, const char *name, void *stable) {
  const struct stable_field *s = stable;
  const element *known = strcmp(name, "chi") == 0        ? &s->chi
                         : strcmp(name, "eta") == 0      ? &s->eta
                         : strcmp(name, "g_1[1,1]") == 0 ? &s->g_1
                                                         : part_entry(s, name);
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

static void field_make(struct stable_field *s, slong unit) {
  *s = (struct stable_field){.field = exact_field_new(NULL, 0)};
  exact_field_limit(s->field, STABLE_TERMS);
  each_element(s, exact_init);
  s->status = exact_symbol(&s->frequency[0], s->field, "omega_1") | exact_symbol(&s->frequency[1], s->field, "omega_2");
  make_parameters(s);
  make_angles(s, unit);
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
  struct text shapes; /* of the matrices that these are entries of */
  struct tape tape;
};

/* Quantities that long forms are made of in both layers alike.  Where forms are equal whatever these are, they are equal if
   each of these is the same in both layers.  Of the first that is proved directly; g_1 = 1 - omega_1^2 has a name in the stable
   layer alone.  Of the others it follows from what is proved before, or is. */
static const struct override held[] = {{"J_b", 2, 1},      {"ktilde_1", 1, 1}, {"H_13", 1, 1},     {"H_23", 1, 1},
                                       {"ktilde_3", 1, 1}, {"ktilde_4", 1, 1}, {"ktilde_5", 1, 1}, {"g_1", 1, 1},
                                       {"N_1", 2, 2},      {"N_2", 2, 2},      {"N_3", 2, 2},      {"N_4", 2, 2},
                                       {"S_c", 4, 1},      {"J_c", 3, 2}};
enum { N_HELD = sizeof held / sizeof *held, N_DIRECT = 8 };

static const char *in_corrected(const char *name) {
  return strcmp(name, "g_1") == 0 ? "1 - omega_1^2" : name;
}

/* Its place among those that may be held; N_HELD for another. */
static int place_held(const char *name) {
  int i = 0;
  while (i < N_HELD && strcmp(held[i].name, name) != 0) i++;
  return i;
}

/* All that may be an unknown: the parts proved so far, then those.  An attempt takes the first n. */
struct unknowns {
  struct override name[MOST_PARTS + N_HELD];
  struct part part[MOST_PARTS];
  int n, n_parts;
  bool algebra_alone;
  int usable; /* of those that may be held, this many are known to be the same in both layers */
};

static void reading_init(struct reading *r, const struct model *m, enum layer layer, const struct unknowns *u) {
  *r = (struct reading){.n = 0};
  text_init(&r->shapes);
  elaboration_init(&r->el, (struct view){m, layer, NULL, NULL}, u->name, u->n);
}

static void reading_clear(struct reading *r) {
  tape_clear(&r->tape);
  text_clear(&r->shapes);
  free(r->e);
  elaboration_clear(&r->el);
}

static void add_entries(struct reading *r, const struct matrix *m) {
  text_printf(&r->shapes, "%dx%d ", m->rows, m->cols);
  for (int i = 0; i < m->rows * m->cols; i++) {
    r->e = ss_grow(r->e, (size_t)r->n, &r->cap, sizeof *r->e);
    r->e[r->n++] = m->e[i];
  }
}

static bool read_shape(struct matrix *m, struct reading *r, const char *value, const char *section, struct diag *d) {
  struct source src;
  struct arena a;
  arena_init(&a);
  source_from_string(&src, value, value);
  const struct expr *e = expr_parse(&a, &src, (struct span){0, src.len}, d);
  bool ok = e && elaborate(m, &r->el, e, &src, section, d);
  source_clear(&src);
  arena_clear(&a);
  return ok;
}

static bool read_value(struct reading *r, const char *value, const char *section, struct diag *d) {
  struct matrix m;
  bool ok = read_shape(&m, r, value, section, d);
  if (ok) add_entries(r, &m);
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

static bool meets(const struct tape *t, const char *part) {
  size_t len = strlen(part);
  for (slong k = 0; k < t->n_inputs; k++)
    if (strncmp(t->inputs[k], part, len) == 0 && t->inputs[k][len] == '[') return true;
  return false;
}

/* What the parts that a tape uses are equal to, in a field. */
static bool value_parts(struct stable_field *s, struct part_value v[MOST_PARTS], const struct tape *used,
                        const struct model *m, const struct unknowns *u, struct diag *d) {
  bool ok = true;
  s->part = v;
  for (int i = 0; ok && u->n > 0 && i < u->n_parts; i++) {
    struct reading r;
    if (!meets(used, u->part[i].name)) continue;
    reading_init(&r, m, LAYER_CORRECTED, u);
    ok = read_value(&r, u->part[i].equals, u->part[i].section, d) && elaboration_tape(&r.tape, &r.el, r.e, r.n, d);
    if (ok) {
      v[s->n_parts] = (struct part_value){.part = &u->part[i]};
      s->status |= exact_eval(&v[s->n_parts++].value, s->field, &r.tape);
    }
    reading_clear(&r);
  }
  return ok;
}

/* Sets p->why_not to the reason for which entries are not shown equal in a field with angles over that unit, or to NULL. */
static bool compare_in(struct stable_proof *p, struct reading r[2], slong unit, const struct model *m,
                       const struct unknowns *u, struct diag *d) {
  struct stable_field s;
  struct exact_vec v[2];
  struct part_value part[MOST_PARTS];
  field_make(&s, unit);
  bool ok = value_parts(&s, part, &r[1].tape, m, u, d);
  int status = s.status;
  for (int i = 0; i < 2; i++) status |= exact_eval(&v[i], s.field, &r[i].tape);
  p->why_not = status & SS_DOMAIN   ? "a divisor is zero for all parameters"
               : status & SS_UNABLE ? "an expression outgrew the budget of exact algebra"
                                    : NULL;
  for (slong i = 0; !p->why_not && i < v[0].len; i++)
    if (!exact_equal(s.field, &v[0].x[i], &v[1].x[i])) p->why_not = "an entry differs, as far as exact algebra knows";
  p->entries = (int)r[0].n;
  p->largest = exact_largest(s.field);
  for (int i = 0; i < 2; i++) exact_vec_clear(&v[i]);
  for (int i = 0; i < s.n_parts; i++) exact_vec_clear(&part[i].value);
  field_clear(&s);
  return ok;
}

static bool same_shapes(const struct reading r[2]) {
  return strcmp(text_str(&r[0].shapes), text_str(&r[1].shapes)) == 0;
}

static int times_in(const struct tape *t) {
  int n = 0;
  for (slong k = 0; k < t->n_inputs; k++)
    for (int i = 0; i < N_TIMES; i++) n += strcmp(t->inputs[k], time_name[i]) == 0;
  return n;
}

/* Where there is one time, half of the angles that others have are affordable. */
static bool compare(struct stable_proof *p, struct reading r[2], const struct model *m, const struct unknowns *u,
                    struct diag *d) {
  enum { UNIT = 4 };
  p->why_not = "the forms have different shapes";
  if (!same_shapes(r)) return true;
  bool ok = compare_in(p, r, UNIT, m, u, d);
  if (ok && p->why_not && times_in(&r[1].tape) == 1) ok = compare_in(p, r, 2 * UNIT, m, u, d);
  return ok;
}

/* --- Points --- */

enum { NEAR = 3, POINTS = 8 };

/* Near 1 in the first trials, then over orders of magnitude and of either sign where that is free; chi in (0, 1).  Of each
   name its own. */
static double draw(const char *name, int trial) {
  uint64_t h = 14695981039346656037U + (uint64_t)trial;
  for (const char *c = name; *c; c++) h = (h ^ (unsigned char)*c) * 0x100000001b3U;
  h *= 0x9e3779b97f4a7c15U;
  double unit = (double)(h >> 40) * 0x1p-24;
  if (strcmp(name, "chi") == 0) return trial < NEAR ? 0.125 + unit / 2 : (unit + 0x1p-25) / (1 + 0x1p-24);
  if (trial < NEAR) return 0.25 + unit;
  double size = ldexp(1 + unit, (int)(h >> 33 & 7) - 4);
  return (*name == 'z' || *name == 'x') && h >> 32 & 1 ? -size : size;
}

static void balls_there(struct num_vec *out, int *status, const struct tape *t, int trial) {
  enum { BITS = 256 };
  struct num_vec in;
  num_vec_init(&in, t->n_inputs, num_ctx_arb(BITS));
  num_vec_init(out, t->n_outputs, num_ctx_arb(BITS));
  for (slong k = 0; k < t->n_inputs; k++) arb_set_d(num_vec_at(&in, k), draw(t->inputs[k], trial));
  tape_eval(out, status, t, &in);
  num_vec_clear(&in);
}

/* What points say of the entries of two forms of one shape. */
struct seen {
  bool differ; /* enclosures are disjoint */
  bool lost;   /* the corrected one has a value and the stable one none */
  long *met;   /* of each entry, points at which both have one */
};

static void look_there(struct seen *seen, const struct reading r[2], int trial) {
  struct num_vec v[2];
  int *status[2];
  for (int i = 0; i < 2; i++) {
    status[i] = ss_malloc((size_t)(r[i].n + 1) * sizeof *status[i]);
    balls_there(&v[i], status[i], &r[i].tape, trial);
  }
  for (slong k = 0; k < r[0].n; k++) {
    bool both = status[0][k] == SS_OK && status[1][k] == SS_OK;
    seen->met[k] += both;
    seen->lost = seen->lost || (status[0][k] == SS_OK && !both);
    seen->differ = seen->differ || (both && !arb_overlaps(num_vec_at(&v[0], k), num_vec_at(&v[1], k)));
  }
  for (int i = 0; i < 2; i++) {
    num_vec_clear(&v[i]);
    free(status[i]);
  }
}

/* Why points refuse the equality, or NULL: a route of its own, and soon told.  The algebra shows that two forms agree where
   both have a value; that they do have one somewhere is shown here. */
static const char *refused_by_points(const struct reading r[2], bool only_values) {
  struct seen seen = {.met = ss_malloc((size_t)(r[0].n + 1) * sizeof *seen.met)};
  bool empty = false;
  for (slong k = 0; k < r[0].n; k++) seen.met[k] = 0;
  for (int trial = 0; trial < POINTS && !(seen.differ && !only_values); trial++) look_there(&seen, r, trial);
  for (slong k = 0; k < r[0].n; k++) empty = empty || seen.met[k] == 0;
  free(seen.met);
  return seen.differ && !only_values ? "an entry differs, by balls at a point"
         : seen.lost                 ? "an entry has no value at a point where the corrected form has one"
         : empty                     ? "no point was found at which both forms have a value"
                                     : NULL;
}

/* --- Attempts --- */

/* Relations are the same only if what stands between their sides is. */
static bool same_relations(const struct statement_record *a, const struct statement_record *b) {
  bool same = a->n_stmts == b->n_stmts;
  for (int k = 0; same && k < a->n_stmts; k++) {
    same = a->stmts[k]->n_sides == b->stmts[k]->n_sides && !a->stmts[k]->range_var && !b->stmts[k]->range_var;
    for (int i = 0; same && i + 1 < a->stmts[k]->n_sides; i++) same = a->stmts[k]->ops[i] == b->stmts[k]->ops[i];
  }
  return same;
}

/* What is held against what: a value of either layer or, where these are NULL, a record of either. */
struct sides {
  const char *value[2];
  const struct statement_record *record[2];
};

/* Both sides as tapes, with these quantities held as unknowns; clear r all the same. */
static bool read_sides(struct reading r[2], const char *section, const struct model *m, const struct sides *of,
                       const struct unknowns *u, struct diag *d) {
  static const enum layer layer[2] = {LAYER_CORRECTED, LAYER_STABLE};
  bool ok = true;
  for (int i = 0; i < 2; i++) reading_init(&r[i], m, layer[i], u);
  for (int i = 0; ok && i < 2; i++)
    ok = (of->value[i] ? read_value(&r[i], of->value[i], section, d) : read_record(&r[i], of->record[i], d)) &&
         elaboration_tape(&r[i].tape, &r[i].el, r[i].e, r[i].n, d);
  return ok;
}

static bool attempt(struct stable_proof *p, const struct model *m, const struct sides *of, const struct unknowns *u,
                    struct diag *d) {
  struct reading r[2];
  bool ok = read_sides(r, p->section, m, of, u, d) && compare(p, r, m, u, d);
  for (int i = 0; i < 2; i++) reading_clear(&r[i]);
  return ok;
}

/* Sets p->why_not where points refuse the equality; of the values themselves the algebra alone may be asked. */
static bool try_points(struct stable_proof *p, const struct model *m, const struct sides *of, bool only_values,
                       struct diag *d) {
  const struct unknowns none = {.n = 0};
  struct reading r[2];
  bool ok = read_sides(r, p->section, m, of, &none, d);
  p->why_not = ok && same_shapes(r) ? refused_by_points(r, only_values) : NULL;
  for (int i = 0; i < 2; i++) reading_clear(&r[i]);
  return ok;
}

/* An unknown is known by its name alone, which then must have one meaning in all sections. */
static bool means_one_thing(const struct model *m, const char *name) {
  const struct view stable = {m, LAYER_STABLE, NULL, NULL};
  const struct definition *first = NULL;
  bool one = true;
  for (size_t i = 0; i < m->n_defs; i++) {
    const struct definition *def = &m->defs[i];
    if (strcmp(def->name, name) != 0 || !view_sees(&stable, def)) continue;
    one = one && (!first || strcmp(first->section, def->section) == 0);
    first = def;
  }
  return one;
}

static bool direct(const struct model *m) {
  const struct view corrected = {m, LAYER_CORRECTED, NULL, NULL};
  const struct unknowns none = {.n = 0};
  struct diag d;
  diag_init(&d);
  bool yes = !view_lookup(&corrected, "g_1", "stability", &d);
  for (int i = 0; i < N_HELD; i++) yes = yes && means_one_thing(m, held[i].name);
  for (int i = 0; yes && i < N_DIRECT; i++) {
    struct stable_proof p = {.section = "stability"};
    const struct sides of = {.value = {in_corrected(held[i].name), held[i].name}};
    yes = attempt(&p, m, &of, &none, &d) && !p.why_not;
  }
  return yes;
}

static bool is_proved(const struct stable_proofs *p, const struct stmt *stmt) {
  for (size_t i = 0; i < p->n; i++)
    if (p->item[i].stmt == stmt) return !p->item[i].why_not;
  return false;
}

/* Notes what a name is made of in the stable layer. */
static bool note_use(bool *used, const struct model *m, const char *name, const char *section) {
  struct model noting = *m;
  struct model_use use = {used, ss_malloc((m->n_records + 1) * sizeof *use.record)};
  struct reading r;
  struct matrix shape;
  struct diag d;
  diag_init(&d);
  memset(used, 0, m->n_defs * sizeof *used);
  memset(use.record, 0, m->n_records * sizeof *use.record);
  noting.use = &use;
  const struct unknowns none = {.n = 0};
  reading_init(&r, &noting, LAYER_STABLE, &none);
  bool ok = read_shape(&shape, &r, name, section, &d);
  reading_clear(&r);
  free(use.record);
  return ok;
}

/* Whether every definition that the stable layer has in place of a corrected one, on the way to the name, is proved. */
static bool follows(const struct stable_proofs *p, const struct model *m, const char *name, const char *section) {
  struct view corrected = {m, LAYER_CORRECTED, NULL, NULL};
  struct diag d;
  diag_init(&d);
  bool *used = ss_malloc((m->n_defs + 1) * sizeof *used), yes = note_use(used, m, name, section);
  for (size_t i = 0; yes && i < m->n_defs; i++) {
    const struct definition *def = &m->defs[i];
    if (used[i] && def->rank == RANK_STABLE && view_lookup(&corrected, def->name, def->section, &d))
      yes = is_proved(p, def->stmt);
  }
  free(used);
  return yes;
}

/* How many of those that may be held are, for a proof of the name: none for one that is proved directly. */
static int holdable(struct unknowns *u, const struct stable_proofs *p, const struct model *m, const char *name) {
  int own = place_held(name);
  if (u->usable < 0) u->usable = direct(m) ? N_DIRECT : 0;
  if (own == N_HELD)
    while (u->usable >= N_DIRECT && u->usable < N_HELD && follows(p, m, held[u->usable].name, "stability")) u->usable++;
  return own < N_DIRECT ? 0 : own < N_HELD ? FLINT_MIN(u->usable, N_DIRECT) : u->usable;
}

/* Whether the stable side meets parts. */
static bool uses_parts(bool *yes, const char *section, const struct model *m, const struct sides *of,
                       const struct unknowns *parts, struct diag *d) {
  struct reading r;
  *yes = false;
  reading_init(&r, m, LAYER_STABLE, parts);
  bool ok = (of->value[1] ? read_value(&r, of->value[1], section, d) : read_record(&r, of->record[1], d)) &&
            elaboration_tape(&r.tape, &r.el, r.e, r.n, d);
  for (int i = 0; ok && i < parts->n_parts; i++) *yes = *yes || meets(&r.tape, parts->part[i].name);
  reading_clear(&r);
  return ok;
}

/* Whether a function says something of t, which is a symbol too, besides what it says of its argument. */
static bool names_time(bool *yes, const char *function, const char *section, enum layer layer, const struct model *m,
                       struct diag *d) {
  const struct unknowns none = {.n = 0};
  struct reading r;
  struct text there;
  text_init(&there);
  text_printf(&there, "%.*s(%s)", (int)strcspn(function, "("), function, time_name[1]);
  reading_init(&r, m, layer, &none);
  bool ok = read_value(&r, text_str(&there), section, d) && elaboration_tape(&r.tape, &r.el, r.e, r.n, d);
  for (slong k = 0; ok && k < r.tape.n_inputs; k++) *yes = *yes || strcmp(r.tape.inputs[k], time_name[0]) == 0;
  reading_clear(&r);
  text_clear(&there);
  return ok;
}

/* The two sides of a function are held against each other at t: enough where they know no other t. */
static bool try_argument(struct stable_proof *p, const struct model *m, const struct sides *of, struct diag *d) {
  bool yes = false, ok = true;
  if (!p->stmt || !p->stmt->param) return true;
  ok = names_time(&yes, of->value[1], p->section, LAYER_STABLE, m, d);
  if (ok && of->value[0] == of->value[1]) ok = names_time(&yes, of->value[0], p->section, LAYER_CORRECTED, m, d);
  if (yes) p->why_not = "a function depends on t besides its argument";
  return ok;
}

/* With none of those that may be held, with those proved directly, or with all; what is made of parts is mostly equal
   whatever these are, and large where they are put in. */
static bool attempt_levels(struct stable_proof *p, const struct model *m, const struct sides *of, struct unknowns *u,
                           int most, bool all_first, struct diag *d) {
  const int level[] = {0, FLINT_MIN(most, N_DIRECT), most};
  bool ok = true;
  p->why_not = "";
  for (int i = 0; ok && p->why_not && i < 3; i++) {
    int k = all_first ? 2 - i : i;
    if (k > 0 && level[k] == level[k - 1]) continue;
    struct unknowns some = *u;
    some.n = u->n_parts + level[k];
    ok = attempt(p, m, of, &some, d);
    p->held = level[k] > 0;
  }
  return ok;
}

/* p says where it stands, of->value[1] or the record of the stable layer what it is called. */
static bool prove(struct stable_proofs *out, struct stable_proof p, const struct model *m, const struct sides *of,
                  struct unknowns *u, struct diag *d) {
  const char *name = of->value[1] ? of->value[1] : of->record[1]->id;
  p.name = arena_strndup(&out->arena, name, strlen(name));
  struct unknowns parts = *u;
  parts.n = u->n_parts;
  bool by_parts, ok = try_points(&p, m, of, u->algebra_alone, d);
  if (ok && !p.why_not) ok = try_argument(&p, m, of, d);
  if (ok && !p.why_not)
    ok = uses_parts(&by_parts, p.section, m, of, &parts, d) &&
         attempt_levels(&p, m, of, u, holdable(u, out, m, name), by_parts, d);
  if (!of->value[1] && !same_relations(of->record[0], of->record[1])) p.why_not = "the relations differ";
  out->item = ss_grow(out->item, out->n, &out->cap, sizeof *out->item);
  out->item[out->n++] = p;
  return ok;
}

/* --- All forms --- */

static const struct statement_record *home(const struct model *m, const struct definition *def) {
  for (size_t i = 0; i < m->n_records; i++)
    if (m->records[i].record == def->record) return &m->records[i];
  return NULL;
}

/* What a definition equals in the corrected layer: its own name there (NAME or NAME(t)), or for the last one of a record
   what "equals" says; NULL when it is a part of others. */
static const char *counterpart(const char *value, const struct model *m, const struct definition *def, struct diag *d) {
  struct view corrected = {m, LAYER_CORRECTED, NULL, NULL};
  bool own = view_lookup(&corrected, def->name, def->section, d) != NULL;
  const struct statement_record *r = home(m, def);
  const char *equals = r->stmts[r->n_stmts - 1] == def->stmt ? record_get(def->record, "equals") : NULL;
  if (own && equals) diag_set(d, "%s has a corrected form; \"equals\" is for parts that have none", def->name);
  return own ? value : equals;
}

/* A part that is no function can be held from now on. */
static void keep_part(struct unknowns *u, const struct model *m, const struct definition *def, const char *equals) {
  struct reading r;
  struct diag d;
  struct matrix shape;
  const struct unknowns none = {.n = 0};
  diag_init(&d);
  if (def->stmt->param || u->n_parts == MOST_PARTS || !means_one_thing(m, def->name)) return;
  reading_init(&r, m, LAYER_STABLE, &none);
  if (read_shape(&shape, &r, def->name, def->section, &d) && shape.rows < 10 && shape.cols < 10) {
    u->part[u->n_parts++] = (struct part){def->name, def->section, equals, shape.rows, shape.cols};
    memmove(u->name + u->n_parts, u->name + u->n_parts - 1, sizeof held);
    u->name[u->n_parts - 1] = (struct override){def->name, shape.rows, shape.cols};
    u->n++;
  }
  reading_clear(&r);
}

/* A part that takes the name of a free symbol would change what other formulas say. */
static bool hides_symbol(const struct model *m, const struct definition *def, struct diag *d) {
  struct view corrected = {m, LAYER_CORRECTED, NULL, NULL};
  struct diag none;
  diag_init(&none);
  if (def->rank != RANK_STABLE || !model_is_symbol(m, def->name) ||
      view_lookup(&corrected, def->name, def->section, &none))
    return false;
  diag_set(d, "%s is a free symbol in the corrected layer; a part needs a name of its own", def->name);
  return true;
}

static bool prove_definition(struct stable_proofs *out, struct unknowns *u, const struct model *m,
                             const struct definition *def, struct diag *d) {
  struct text own;
  text_init(&own);
  text_printf(&own, def->stmt->param ? "%s(t)" : "%s", def->name);
  struct diag unclear;
  diag_init(&unclear);
  const char *other = def->rank == RANK_STABLE ? counterpart(text_str(&own), m, def, &unclear) : NULL;
  if (unclear.set) diag_again(d, unclear.message);
  bool ok = !unclear.set && !hides_symbol(m, def, d);
  if (ok && other) {
    struct sides of = {.value = {other, text_str(&own)}};
    ok = prove(out,
               (struct stable_proof){.section = def->section,
                                     .record = home(m, def),
                                     .stmt = def->stmt,
                                     .equals = other == text_str(&own) ? NULL : other},
               m, &of, u, d);
    if (ok && other != text_str(&own) && !out->item[out->n - 1].why_not) keep_part(u, m, def, other);
  }
  text_clear(&own);
  return ok;
}

static bool prove_all(struct stable_proofs *out, const struct model *model, bool algebra_alone, struct diag *d) {
  struct model both = *model;
  const struct model *m = &both;
  both.stable = false; /* else the stable layer would be held against itself */
  struct unknowns u = {.n = N_HELD, .usable = -1, .algebra_alone = algebra_alone};
  memcpy(u.name, held, sizeof held);
  *out = (struct stable_proofs){.n = 0};
  arena_init(&out->arena);
  bool ok = true;
  for (size_t i = 0; ok && i < m->n_defs; i++) ok = prove_definition(out, &u, m, &m->defs[i], d);
  for (size_t i = 0; ok && i < m->n_records; i++) {
    const struct statement_record *r = &m->records[i];
    if (r->rank != RANK_STABLE || strcmp(r->record->kind_name, "define") == 0) continue;
    struct view corrected = {m, LAYER_CORRECTED, NULL, NULL};
    struct sides of = {.record = {view_record(&corrected, r->id), r}};
    if (!of.record[0]) diag_set(d, "%s replaces no record", r->id);
    ok = of.record[0] && prove(out, (struct stable_proof){.section = r->section, .record = r}, m, &of, &u, d);
  }
  return ok;
}

bool stable_prove(struct stable_proofs *out, const struct model *m, struct diag *d) {
  return prove_all(out, m, false, d);
}

bool stable_prove_by_algebra(struct stable_proofs *out, const struct model *m, struct diag *d) {
  return prove_all(out, m, true, d);
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
