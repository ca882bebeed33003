/* Points at which sentences are tried.  A point is exact: rational parameters, states or times, and which orbit of its
   parameters is meant; how it is written, and which orbit that is once the orbits have been found.  What the paper's
   symbols are worth there is values.c, and how points are drawn is sampler.c. */
#include "point.h"

const struct restriction restrictions[] = {{"V = 1", Q_V, "1"}, {"eta = 1", Q_ETA, "1"}};

const int n_restrictions = sizeof restrictions / sizeof *restrictions;

const char *const point_kind_word[N_POINT_KINDS] = {
    [POINT_PARAMS] = "params", [POINT_FLOW] = "flow", [POINT_ARC] = "arcs",        [POINT_ORBIT] = "orbits",
    [POINT_PRINTED] = "",      [POINT_GIVEN] = "",    [POINT_PATCHED] = "patched",
};

bool point_has_word(enum point_kind kind) {
  return kind == POINT_ARC || kind == POINT_ORBIT || kind == POINT_PATCHED;
}

bool point_has_events(enum point_kind kind) {
  return kind == POINT_ARC || kind == POINT_ORBIT || kind == POINT_GIVEN;
}

void point_init(struct point *p) {
  *p = (struct point){.kind = POINT_PARAMS};
  for (int i = 0; i < N_Q; i++) fmpq_init(&p->q[i]);
}

void point_clear(struct point *p) {
  for (int i = 0; i < N_Q; i++) fmpq_clear(&p->q[i]);
}

void point_copy(struct point *out, const struct point *p) {
  struct point own = *out;
  *out = *p;
  for (int i = 0; i < N_Q; i++) {
    out->q[i] = own.q[i];
    fmpq_set(&out->q[i], &p->q[i]);
  }
}

bool point_of_model(const struct point *p) {
  return !p->paper || p->paper->system;
}

const struct symbol *point_own(size_t *i, const struct point *p, const struct tape *read, const struct tape *given) {
  for (; p->paper && *i < p->paper->n_symbols; ++*i) {
    const struct symbol *s = &p->paper->symbols[*i];
    if (s->has_domain && (!read || tape_input(read, s->name) >= 0 || (given && tape_input(given, s->name) >= 0)))
      return s;
  }
  return NULL;
}

static const char *print_own(struct text *out, const struct point *p, const struct tape *read,
                             const struct tape *given) {
  const char *sep = "";
  const struct symbol *s;
  NUMBERS(fmpq, z);
  for (size_t i = 0; (s = point_own(&i, p, read, given)) != NULL; i++) {
    point_own_value(z, p, s);
    text_printf(out, "%s%s = ", sep, s->name);
    num_print_q(out, z);
    sep = ", ";
  }
  return sep;
}

/* Sets of kinds of points. */
enum {
  PARAMS = 1 << POINT_PARAMS,
  FLOW = 1 << POINT_FLOW,
  ARC = 1 << POINT_ARC,
  ORBIT = 1 << POINT_ORBIT,
  PRINTED = 1 << POINT_PRINTED,
  GIVEN = 1 << POINT_GIVEN,
  PATCHED = 1 << POINT_PATCHED,
  PASS = ARC | ORBIT, /* where the motion passes through the word, with its events */
  ALL = 2 * PATCHED - 1
};

/* The start of a pass stands in its certificate with the times. */
static const struct point_quantity table[] = {
    {"chi", "chi", Q_CHI, ALL, ALL, 0},
    {"eta", "eta", Q_ETA, ALL, ALL, 0},
    {"V", "V", Q_V, ALL, ALL, 0},
    {"e_1", "e1", Q_E1, PASS | PRINTED, PASS | PRINTED, PARAMS | FLOW | PATCHED},
    {"e_2", "e2", Q_E2, PASS | PRINTED, PASS | PRINTED, PARAMS | FLOW | PATCHED},
    {"t_a", "t_a", Q_TA, PRINTED | PATCHED, PRINTED | PATCHED, 0},
    {"t_b", "t_b", Q_TB, PRINTED | GIVEN | PATCHED, PRINTED | GIVEN | PATCHED, 0},
    {"t_c", "t_c", Q_TC, PRINTED | GIVEN | PATCHED, PRINTED | GIVEN | PATCHED, 0},
    {"t_d", "t_d", Q_TD, PRINTED | PATCHED, PRINTED | PATCHED, 0},
    {"t", "t", Q_T, PARAMS | FLOW, PARAMS | FLOW, ALL},
    {"s", "s", Q_S, 0, 0, 0},
    {"z_10", "z_10", Q_Z1, ARC | PRINTED | PATCHED, PRINTED | PATCHED, 0},
    {"z_20", "z_20", Q_Z2, ARC | PRINTED | PATCHED, PRINTED | PATCHED, 0},
    {"z'_10", "z'_10", Q_DZ1, PATCHED, PATCHED, 0},
    {"z'_20", "z'_20", Q_DZ2, PATCHED, PATCHED, 0},
    {"z_1", "z_1", Q_Z1, FLOW, FLOW, 0},
    {"z_2", "z_2", Q_Z2, FLOW, FLOW, 0},
    {"z_1'", "z_1'", Q_DZ1, FLOW, FLOW, 0},
    {"z_2'", "z_2'", Q_DZ2, FLOW, FLOW, 0},
    {"u_s1", "u_s1", Q_US1, 0, PASS, ALL & ~GIVEN},
    {"u_s2", "u_s2", Q_US2, 0, PASS, ALL & ~GIVEN},
    {"u_r1", NULL, Q_US1, 0, 0, GIVEN},
    {"u_r2", NULL, Q_US2, 0, 0, GIVEN},
    {"x", "x", Q_X, 0, PASS, ALL},
    {"y", "y", Q_Y, 0, PASS, ALL},
    {"lambda", "lambda", Q_LAMBDA, 0, 0, ALL},
};

enum { N_TABLE = sizeof table / sizeof *table };

const struct point_quantity *point_settable(size_t *i) {
  while (*i < N_TABLE && !table[*i].key) ++*i;
  return *i < N_TABLE ? &table[*i] : NULL;
}

const struct point_quantity *point_certified(size_t *i, const struct point *p, unsigned read) {
  for (; *i < N_TABLE; ++*i) {
    unsigned kinds = table[*i].certified | (read >> table[*i].q & 1U ? table[*i].if_read : 0);
    if (kinds >> p->kind & 1U) return &table[*i];
  }
  return NULL;
}

void point_print(struct text *out, const struct point *p) {
  point_print_read(out, p, NULL, NULL);
}

void point_print_read(struct text *out, const struct point *p, const struct tape *read, const struct tape *given) {
  const char *sep = print_own(out, p, read, given);
  if (!point_of_model(p)) {
    if (!*sep) text_add(out, "any values of the symbols");
    return;
  }
  bool of_scene = p->kind == POINT_ORBIT && p->scene;
  for (int k = KEY_CHI; of_scene && k <= KEY_TD; k++) {
    if (!p->scene->given[k]) continue;
    text_printf(out, "%s%s = ", sep, scene_key_name[k]);
    num_print_q(out, &p->scene->value[k]);
    sep = ", ";
  }
  for (size_t i = 0; !of_scene && i < N_TABLE; i++) {
    if (!(table[i].shown >> p->kind & 1U)) continue;
    text_printf(out, "%s%s%s = ", sep, table[i].key, p->kind == POINT_FLOW && table[i].q >= Q_Z1 ? "(0)" : "");
    num_print_q(out, &p->q[table[i].q]);
    sep = ", ";
  }
  if (p->kind == POINT_ORBIT || p->kind == POINT_GIVEN) text_printf(out, ", orbit %ld", (long)p->orbit + 1);
}

/* u_ri = 5/4 max(e_i, u_ri_min), or just above that maximum, upwards to a 1024th. */
static void take_realistic_friction(struct point *p, const struct dyn_orbit *o) {
  NUMBERS(fmpz, k);
  NUMBERS(arb, least, e);
  uint64_t state = p->draw;
  bool much = random_next(&state) >> 32 & 1;
  for (int i = 0; i < 2; i++) {
    arb_set_fmpq(e, &p->q[Q_E1 + i], FIRST_PREC);
    arb_max(least, i ? o->u_r2_min : o->u_r1_min, e, FIRST_PREC);
    arb_mul_si(least, least, much ? 1280 : 1025, FIRST_PREC);
    arf_get_fmpz(k, arb_midref(least), ARF_RND_CEIL);
    fmpq_set_fmpz(&p->q[Q_US1 + i], k);
    fmpq_div_2exp(&p->q[Q_US1 + i], &p->q[Q_US1 + i], 10);
    fmpq_sub(&p->q[Q_US1 + i], &p->q[Q_US1 + i], &p->q[Q_E1 + i]);
  }
}

bool point_settle(struct point *p, struct orbit_cache *c) {
  if (p->kind != POINT_ORBIT) return true;
  const struct dyn_orbits *list = point_orbits(p, c, FIRST_PREC);
  slong n = 0;
  for (slong i = 0; i < list->n; i++) n += !p->admissible || list->orbit[i].admissible == TRUTH_TRUE;
  if (n == 0) return false;
  slong wanted = p->orbit % n, at = 0;
  for (slong i = 0; i < list->n; i++) {
    if (p->admissible && list->orbit[i].admissible != TRUTH_TRUE) continue;
    if (wanted-- == 0) at = i;
  }
  p->orbit = at;
  if (p->realistic) take_realistic_friction(p, &list->orbit[at]);
  return true;
}
