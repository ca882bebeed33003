/* Points at which sentences are tried.  A point is exact: rational parameters, states or times, and which orbit of its
   parameters is meant; how it is written, and which orbit that is once the orbits have been found.  What the paper's
   symbols are worth there is values.c, and how points are drawn is sampler.c. */
#include "point.h"

const struct restriction restrictions[] = {{"V = 1", Q_V, "1"}, {"eta = 1", Q_ETA, "1"}};

const int n_restrictions = sizeof restrictions / sizeof *restrictions;

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

/* The values of the paper's own symbols. */
static const char *print_own(struct text *out, const char *sep, const struct point *p) {
  fmpq_t z;
  fmpq_init(z);
  for (size_t i = 0; p->paper && p->paper->n_own && i < p->paper->n_symbols; i++) {
    const struct symbol *s = &p->paper->symbols[i];
    if (!s->has_domain) continue;
    point_own_value(z, p, s);
    text_printf(out, "%s%s = ", sep, s->name);
    num_print_q(out, z);
    sep = ", ";
  }
  fmpq_clear(z);
  return sep;
}

void point_print(struct text *out, const struct point *p) {
  static const struct {
    const char *name;
    int q;
    unsigned kinds; /* bit for each point_kind */
  } shown[] = {{"chi", Q_CHI, 127},   {"eta", Q_ETA, 127},  {"V", Q_V, 127},     {"e1", Q_E1, 28},
               {"e2", Q_E2, 28},      {"t_a", Q_TA, 80},    {"t_b", Q_TB, 112},  {"t_c", Q_TC, 112},
               {"t_d", Q_TD, 80},     {"t", Q_T, 3},        {"z_10", Q_Z1, 84},  {"z_20", Q_Z2, 84},
               {"z'_10", Q_DZ1, 64},  {"z'_20", Q_DZ2, 64}, {"z_1(0)", Q_Z1, 2}, {"z_2(0)", Q_Z2, 2},
               {"z_1'(0)", Q_DZ1, 2}, {"z_2'(0)", Q_DZ2, 2}};
  const char *sep = print_own(out, "", p);
  if (!point_of_model(p)) return;
  bool of_scene = p->kind == POINT_ORBIT && p->scene;
  for (int k = KEY_CHI; of_scene && k <= KEY_TD; k++) {
    if (!p->scene->given[k]) continue;
    text_printf(out, "%s%s = ", sep, scene_key_name[k]);
    num_print_q(out, &p->scene->value[k]);
    sep = ", ";
  }
  for (size_t i = 0; !of_scene && i < sizeof shown / sizeof *shown; i++) {
    if (!(shown[i].kinds >> p->kind & 1U)) continue;
    text_printf(out, "%s%s = ", sep, shown[i].name);
    num_print_q(out, &p->q[shown[i].q]);
    sep = ", ";
  }
  if (p->kind == POINT_ORBIT || p->kind == POINT_GIVEN) text_printf(out, ", orbit %ld", (long)p->orbit + 1);
}

/* u_ri = 5/4 max(e_i, u_ri_min), upwards to a 1024th. */
static void take_realistic_friction(struct point *p, const struct dyn_orbit *o) {
  fmpz_t k;
  arb_ptr w = _arb_vec_init(2), least = w, e = w + 1;
  fmpz_init(k);
  for (int i = 0; i < 2; i++) {
    arb_set_fmpq(e, &p->q[Q_E1 + i], FIRST_PREC);
    arb_max(least, i ? o->u_r2_min : o->u_r1_min, e, FIRST_PREC);
    arb_mul_si(least, least, 1280, FIRST_PREC);
    arf_get_fmpz(k, arb_midref(least), ARF_RND_CEIL);
    fmpq_set_fmpz(&p->q[Q_US1 + i], k);
    fmpq_div_2exp(&p->q[Q_US1 + i], &p->q[Q_US1 + i], 10);
    fmpq_sub(&p->q[Q_US1 + i], &p->q[Q_US1 + i], &p->q[Q_E1 + i]);
  }
  _arb_vec_clear(w, 2);
  fmpz_clear(k);
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
