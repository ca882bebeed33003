/* Values that a scene asks for: numbers of its orbits, and the paper's corrected formulas in balls, at the parameters
   where these are enough, else at each of the scene's orbits; the precision doubles until every digit asked for is
   certain. */
#include <math.h>
#include <string.h>

#include "audit.h"
#include "judge/judge.h"
#include "run.h"
#include "scene/scene_impl.h"
#include "stability/precision.h"
#include "value/expression.h"
#include "value/solved.h"

/* What still surrounds zero with MOST_BITS_OF_ZERO is not told from it. */
enum { DIGITS = 15, TO_ROUND = 16, MOST_BITS = 1 << 16, MOST_BITS_OF_ZERO = 1 << 11, MOST_ORBITS = 64 };

/* What the place of a value takes in audit.json besides its texts: names of its members, marks, blanks. */
enum { VALUE_FRAME = 80 };

/* One number of an orbit, or one expression, ready to be evaluated. */
struct quantity {
  const char *name;
  size_t item;         /* in the scene's list */
  size_t *bytes;       /* that all values so far take */
  int number;          /* of an orbit; -1: an expression */
  struct text formula; /* in the notation of the equation files */
  struct elaboration el;
  struct tape tape;
  int rows, cols;
};

/* What is free at a point of ours, and so has no value at the scene. */
static bool is_free(const char *input) {
  return strcmp(input, "t") == 0 || word_find(input, name_of_point, N_OF_POINT) < N_OF_POINT;
}

/* Which of an orbit's own numbers the outputs call so. */
static int number_named(const char *name) {
  for (int i = 0; i < ORBIT_NUMBERS; i++)
    if (strcmp(orbit_number_name(i), name) == 0) return i;
  return -1;
}

/* In the paper as corrected. */
static bool is_defined(const struct model *m, const char *name) {
  const struct view v = {m, LAYER_CORRECTED, NULL, NULL};
  for (size_t i = 0; i < m->n_defs; i++)
    if (strcmp(m->defs[i].name, name) == 0 && view_sees(&v, &m->defs[i])) return true;
  return false;
}

/* "trace_J" is tr(J), "det_J" is det(J), unless the paper itself defines that name. */
static bool write_out(struct text *out, const struct model *m, const char *name) {
  static const char *const short_form[] = {"trace_", "det_"}, *const function[] = {"tr", "det"};
  for (int i = 0; i < 2; i++) {
    size_t n = strlen(short_form[i]);
    if (strncmp(name, short_form[i], n) != 0 || is_defined(m, name) || !is_defined(m, name + n)) continue;
    text_printf(out, "%s(%s)", function[i], name + n);
    return true;
  }
  text_add(out, name);
  return false;
}

/* Whether a name can be among the values of a scene: one of the paper's, a number of an orbit, trace_J, det_J. */
static bool value_is_named(const struct model *m, const char *name) {
  OWNED(text) unused = {0};
  bool named = write_out(&unused, m, name);
  return named || number_named(name) >= 0 || is_defined(m, name) || model_is_symbol(m, name);
}

/* As read from one section; the tape only if that can be. */
static bool read_in(struct tape *t, struct quantity *q, const char *section, struct diag *d) {
  struct matrix value;
  diag_init(d);
  if (!elaborate_tape(t, &value, &q->el, "values", text_str(&q->formula), section, d)) return false;
  q->rows = value.rows;
  q->cols = value.cols;
  return true;
}

/* A name that several sections define has a value when they define it alike. */
static bool read_everywhere(struct quantity *q, const struct model *m, struct diag *d) {
  struct diag other;
  const char *first = NULL;
  for (size_t i = 0; i < m->n_defs; i++) {
    struct tape t;
    const char *section = m->defs[i].section;
    bool read = read_in(&t, q, section, &other);
    bool unlike = read && first && !tape_same(&t, &q->tape);
    if (unlike) {
      diag_init(d);
      diag_set(d, "sections %s and %s define it differently", first, section);
    }
    if (read && !first) {
      first = section;
      q->tape = t;
    } else {
      tape_clear(&t);
    }
    if (unlike) return false;
  }
  if (first) diag_init(d); /* what was missing without a section is not */
  return first != NULL;
}

/* false with d set; cleared in any case. */
static bool read_quantity(struct quantity *q, const char *name, const struct model *m, struct diag *d) {
  q->name = name;
  q->number = is_defined(m, name) ? -1 : number_named(name);
  q->rows = q->cols = 1;
  elaboration_init(&q->el, (struct view){m, LAYER_CORRECTED, NULL, NULL}, NULL, 0);
  write_out(&q->formula, m, name);
  if (q->number >= 0) return true;
  bool ok = read_in(&q->tape, q, "", d) || read_everywhere(q, m, d);
  for (slong i = 0; ok && i < q->tape.n_inputs; i++)
    ok = !is_free(q->tape.inputs[i]) || diag_set(d, "%s is free in it", q->tape.inputs[i]);
  return ok;
}

static void quantity_clear(struct quantity *q) {
  tape_clear(&q->tape);
  elaboration_clear(&q->el);
  text_clear(&q->formula);
}

static int number_at(struct num_vec *out, bool *known, const struct quantity *q, const struct point *p, slong prec,
                     struct orbit_cache *cache) {
  *known = p->kind == POINT_ORBIT;
  if (!*known) return SS_UNABLE;
  const struct dyn_orbits *list = point_orbits(p, cache, prec);
  if (p->orbit >= list->n) return SS_UNABLE;
  arb_set(num_vec_at(out, 0), orbit_number(&list->orbit[p->orbit], q->number));
  return SS_OK;
}

/* An orbit's own numbers are enclosed to what is asked for. */
static slong first_precision(const struct quantity *q, const struct point *p, slong digits, struct orbit_cache *cache) {
  slong bits = (slong)ceil((double)digits * log2(10));
  return q->number >= 0 ? precision_round(bits + TO_ROUND)
                        : precision_planned(&q->tape, p, bits, FIRST_PREC + 4 * digits, cache);
}

/* What no reader of an audit.json would take is refused at the scene's line. */
static void check_room(struct judge *j, const struct quantity *q) {
  const struct scene_list *list = &j->scene->asked.values;
  size_t at = list->place[q->item].begin;
  if (j->out->n_values > MOST_AUDIT_ELEMENTS)
    diag_at(j->d, list->source, at, "with this one there are more than %d values; ask for fewer of them",
            MOST_AUDIT_ELEMENTS);
  else if (*q->bytes > LARGEST_VALUES)
    diag_at(j->d, list->source, at,
            "with this one the values take more than %d bytes; ask for fewer of them, or for fewer digits",
            LARGEST_VALUES);
}

static void add_value(struct judge *j, const struct quantity *q, slong entry, const char *at, const char *value) {
  struct audit_result *out = j->out;
  const char *place = entry_place(out, (slong)q->rows * q->cols, q->cols, entry);
  bool column = *place && *place != '[';
  *SS_PUSH(out->values, out->n_values, out->cap_values) =
      (struct asked_value){result_str(out, column ? "%s[%s]" : "%s%s", q->name, place), at, value};
  *q->bytes += VALUE_FRAME + strlen(out->values[out->n_values - 1].name) + strlen(at) + (value ? strlen(value) : 0);
  check_room(j, q);
}

/* false when the point does not say what some symbol stands for; then nothing is added. */
static bool value_at(struct judge *j, const struct quantity *q, const struct point *p, const char *at, slong digits) {
  slong n = (slong)q->rows * q->cols;
  slong first = first_precision(q, p, digits, j->cache);
  for (slong prec = first;; prec *= 2) {
    OWNED(num_vec) x;
    OWNED(text) t = {0};
    bool known, all = true, last = 2 * prec > MOST_BITS + 4 * digits;
    num_vec_init(&x, n, num_ctx_arb(prec));
    int s =
        q->number < 0 ? tape_at_point(&x, &known, &q->tape, p, j->cache) : number_at(&x, &known, q, p, prec, j->cache);
    for (slong i = 0; s == SS_OK && i < n; i++) {
      text_reset(&t);
      bool zero = prec > MOST_BITS_OF_ZERO + 4 * digits && arb_contains_zero(num_vec_at(&x, i));
      all = (num_print(&t, num_vec_at(&x, i), digits) == SS_OK || zero) && all;
    }
    bool settled = all || last || (s & SS_DOMAIN);
    for (slong i = 0; known && settled && i < n && !j->d->set; i++) {
      text_reset(&t);
      bool good = s == SS_OK && num_print(&t, num_vec_at(&x, i), digits) == SS_OK;
      add_value(j, q, i, at, good ? result_copy(j->out, text_str(&t)) : NULL);
    }
    if (known && settled && !(s & SS_DOMAIN)) work_precision_raise(LADDER_VALUE, all && prec == first);
    if (!known || settled) return known;
  }
}

static void at_orbits(struct judge *j, const struct quantity *q, struct point *p, slong digits) {
  slong n = scene_orbits(j->scene, j->cache)->n;
  p->kind = POINT_ORBIT;
  p->scene = j->scene;
  for (slong k = 0; k < n && k < MOST_ORBITS && !j->d->set; k++) {
    p->orbit = k;
    if (value_at(j, q, p, result_str(j->out, "orbit %ld", (long)k + 1), digits)) continue;
    audit_leave_out(j->out, result_str(j->out, "the value of %s", q->name),
                    "some symbol in it has no value on an orbit");
    return;
  }
  if (n == 0) audit_leave_out(j->out, result_str(j->out, "the value of %s", q->name), "the scene has no orbit");
}

static void one_value(struct judge *j, size_t item, size_t *bytes, slong digits) {
  const char *name = result_copy(j->out, j->scene->asked.values.item[item]);
  OWNED(quantity) q = {.item = item, .bytes = bytes};
  LOCAL(point, p);
  struct diag d = {0};
  for (int k = 0; k < N_SCENE_PARAMS; k++)
    if (j->scene->given[k]) fmpq_set(&p.q[Q_CHI + k], &j->scene->value[k]);
  p.kind = POINT_PARAMS;
  const char *why = !scene_has_forces(j->scene) && scene_is_box(j->scene) ? "the scene is a box" : NULL;
  if (!read_quantity(&q, name, j->model, &d)) why = result_copy(j->out, d.what);
  if (why)
    audit_leave_out(j->out, result_str(j->out, "the value of %s", name), why);
  else if (!scene_has_forces(j->scene) || !value_at(j, &q, &p, "the parameters", digits))
    at_orbits(j, &q, &p, digits);
}

bool values_asked(struct judge *j) {
  const struct scene_asked *asked = &j->scene->asked;
  size_t bytes = 0;
  for (size_t i = 0; i < asked->values.n && !j->d->set; i++)
    one_value(j, i, &bytes, asked->digits > 0 ? asked->digits : DIGITS);
  return !j->d->set;
}

/* --- Is what the scene asks for among the claims and the paper's definitions? --- */

static bool check_asked_claims(const struct scene_list *list, const struct claims *c, struct diag *d) {
  for (size_t i = 0; i < list->n; i++) {
    bool any = false;
    for (size_t k = 0; k < c->n && !any; k++) any = claim_asked_for(&c->claim[k], list->item[i]);
    if (any) continue;
    OWNED(text) groups = {0};
    claim_groups_print(&groups);
    return diag_at(
        d, list->source, list->place[i].begin,
        "no claim is called, and no group holds, %.100s; \"stickslip list\" names them all, and groups are %s",
        list->item[i], text_str(&groups));
  }
  return true;
}

/* Every name in the quantity is one of the paper's, or a number of an orbit. */
static bool check_names(const struct model *m, const struct scene_list *list, const struct expr *e, struct diag *d) {
  bool named = e->kind == EXPR_SYM || e->kind == EXPR_CALL;
  if (named && !value_is_named(m, e->name))
    return diag_at(
        d, list->source, e->span.begin,
        "the paper has no quantity %.100s; names are those of its equations and the numbers of an orbit, as in "
        "z10, trace, J_a, trace_J, H(t_c)[1,3]",
        e->name);
  for (int i = 0; i < e->n_args; i++)
    if (!check_names(m, list, e->args[i], d)) return false;
  return true;
}

bool scene_check_asked(const struct scene *s, const struct claims *c, const struct model *m, struct diag *d) {
  const struct scene_list *values = &s->asked.values;
  bool ok = check_asked_claims(&s->asked.claims, c, d);
  for (size_t i = 0; ok && i < values->n; i++) {
    LOCAL(arena, a);
    const struct expr *e = scene_quantity(&a, values, i, d);
    ok = e && check_names(m, values, e, d);
  }
  return ok;
}
