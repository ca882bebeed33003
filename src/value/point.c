/* Points and what the paper's symbols are worth there.  A point is exact (rationals, and which orbit of its parameters);
   its values are made afresh in each number type by the model, never by the paper's formulas. */
#include <stdlib.h>
#include <string.h>

#include "claim/kinds.h"
#include "local_maps.h"
#include "oracle.h"
#include "stickslip/work.h"

const struct restriction restrictions[] = {{"V = 1", Q_V, "1"}, {"eta = 1", Q_ETA, "1"}};
const int n_restrictions = sizeof restrictions / sizeof *restrictions;

/* --- Points --- */

void point_init(struct point *p) {
  *p = (struct point){.kind = POINT_PARAMS};
  for (int i = 0; i < N_Q; i++) fmpq_init(&p->q[i]);
}

void point_clear(struct point *p) {
  for (int i = 0; i < N_Q; i++) fmpq_clear(&p->q[i]);
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
  const char *sep = "";
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

/* --- Which orbit --- */

/* u_ri = 5/4 max(e_i, u_ri_min), upwards to a 1024th. */
static void take_realistic_friction(struct point *p, const struct dyn_orbit *o) {
  fmpz_t k;
  arb_t least, e;
  fmpz_init(k);
  arb_init(least);
  arb_init(e);
  for (int i = 0; i < 2; i++) {
    arb_set_fmpq(e, &p->q[Q_E1 + i], FIRST_PREC);
    arb_max(least, i ? o->u_r2_min : o->u_r1_min, e, FIRST_PREC);
    arb_mul_si(least, least, 1280, FIRST_PREC);
    arf_get_fmpz(k, arb_midref(least), ARF_RND_CEIL);
    fmpq_set_fmpz(&p->q[Q_US1 + i], k);
    fmpq_div_2exp(&p->q[Q_US1 + i], &p->q[Q_US1 + i], 10);
    fmpq_sub(&p->q[Q_US1 + i], &p->q[Q_US1 + i], &p->q[Q_E1 + i]);
  }
  arb_clear(e);
  arb_clear(least);
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

/* --- Sampling --- */

/* k/den with k uniform in [lo, hi]. */
static void draw(fmpq *q, uint64_t *state, slong lo, slong hi, ulong den) {
  slong k = lo + (slong)(random_next(state) % (uint64_t)(hi - lo + 1));
  fmpq_set_si(q, k, den);
}

void sampler_init(struct sampler *s, const char *id, enum point_kind kind, enum phase phase,
                  const struct restriction *restriction) {
  *s = (struct sampler){.state = random_seed(id), .kind = kind, .phase = phase, .restriction = restriction};
}

/* The parameters, with e1 and e2 in units of V, so that orbits and arcs are not rare. */
static void draw_params(struct point *p, uint64_t *st, const struct restriction *restriction) {
  draw(&p->q[Q_CHI], st, 4, 60, 64);
  draw(&p->q[Q_ETA], st, 3, 64, 16);
  draw(&p->q[Q_V], st, 2, 24, 8);
  if (fmpq_is_one(&p->q[Q_V])) fmpq_set_si(&p->q[Q_V], 9, 8);
  if (restriction) {
    num_parse_decimal(&p->q[restriction->quantity], restriction->value, strlen(restriction->value));
  }
  draw(&p->q[Q_E1], st, 4, 40, 8);
  draw(&p->q[Q_E2], st, 2, 24, 16);
  fmpq_mul(&p->q[Q_E1], &p->q[Q_E1], &p->q[Q_V]);
  fmpq_mul(&p->q[Q_E2], &p->q[Q_E2], &p->q[Q_V]);
}

/* An arc starts in the stick phase: w below e1 by V (1 - chi) t_a, and r below e2/chi by a multiple of V. */
static void draw_arc(struct point *p, uint64_t *st) {
  fmpq_t one_chi, w, r, u;
  fmpq_init(one_chi);
  fmpq_init(w);
  fmpq_init(r);
  fmpq_init(u);
  fmpq_one(one_chi);
  fmpq_sub(one_chi, one_chi, &p->q[Q_CHI]);
  draw(u, st, 1, 24, 8);
  fmpq_mul(u, u, &p->q[Q_V]);
  fmpq_mul(u, u, one_chi);
  fmpq_sub(w, &p->q[Q_E1], u);
  draw(u, st, 4, 40, 8);
  fmpq_mul(u, u, &p->q[Q_V]);
  fmpq_div(r, &p->q[Q_E2], &p->q[Q_CHI]);
  fmpq_sub(r, r, u);
  fmpq_add(&p->q[Q_Z2], w, r);
  fmpq_div(&p->q[Q_Z2], &p->q[Q_Z2], one_chi);
  fmpq_sub(&p->q[Q_Z1], &p->q[Q_Z2], r);
  fmpq_clear(one_chi);
  fmpq_clear(w);
  fmpq_clear(r);
  fmpq_clear(u);
}

void sampler_next(struct point *p, struct sampler *s) {
  enum { POOL = 64 };
  p->kind = s->kind;
  p->phase = s->phase;
  p->finite = s->finite;
  p->admissible = s->admissible;
  p->realistic = s->realistic;
  p->scene = NULL;
  uint64_t *st = &s->state;
  if (s->kind == POINT_ORBIT) {
    /* all claims draw their parameter sets from one pool, so that an orbit is searched once */
    uint64_t pool = random_seed("orbits") + random_next(st) % POOL;
    random_next(&pool);
    draw_params(p, &pool, s->restriction);
  } else {
    draw_params(p, st, s->restriction);
  }
  p->orbit = (slong)(random_next(st) % 1000);
  draw(&p->q[Q_US1], st, 1, 40, 8);
  draw(&p->q[Q_US2], st, 1, 40, 8);
  draw(&p->q[Q_X], st, -40, 40, 7);
  draw(&p->q[Q_Y], st, -40, 41, 11);
  draw(&p->q[Q_LAMBDA], st, -40, 40, 9);
  draw(&p->q[Q_T], st, 1, 128, 16);
  draw(&p->q[Q_S], st, 1, 15, 16);
  for (int i = Q_Z1; i <= Q_DZ2; i++) draw(&p->q[i], st, -32, 32, 8);
  if (s->kind == POINT_ARC) draw_arc(p, st);
  for (int i = Q_TA; s->kind == POINT_PATCHED && i <= Q_TD; i++) draw(&p->q[i], st, 1, 48, 16);
}

/* --- Values --- */

/* One of the model's matrices, made once. */
struct oracle_matrix {
  const struct oracle *of;
  struct num_vec entry;
  int status;
};

/* Z(t) after time tau of the phase from z0, and its derivative. */
static int flow_from(struct values *v, const struct num_vec *z0, const void *tau) {
  struct num_vec a;
  num_vec_init(&a, 16, v->ctx);
  int s = SS_OK;
  if (v->variant == VARIANT_EXPONENTIAL) {
    s |= dyn_propagator(&a, v->point->phase, &v->params, tau);
    s |= num_mat_mul(&v->zt, &a, z0, 4, 4, 1);
  } else {
    s |= dyn_flow(&v->zt, v->point->phase, &v->params, z0, tau);
  }
  s |= dyn_system(&a, v->point->phase, &v->params);
  s |= num_mat_mul(&v->azt, &a, &v->zt, 4, 4, 1);
  num_vec_clear(&a);
  return s;
}

static int init_flow(struct values *v) {
  struct num_vec z0;
  num_vec_init(&z0, 4, v->ctx);
  for (int i = 0; i < 4; i++) v->ctx.type->set(num_vec_at(&z0, i), num_vec_at(&v->q, Q_Z1 + i));
  v->ctx.type->set(num_vec_at(&v->t, 0), num_vec_at(&v->q, Q_T));
  int s = flow_from(v, &z0, num_vec_at(&v->t, 0));
  num_vec_clear(&z0);
  return s;
}

/* The time t on an arc: the start of the point's phase and the fraction Q_S of its length. */
static int ensure_time(struct values *v) {
  enum point_kind kind = v->point->kind;
  bool on_arc = kind == POINT_ARC || kind == POINT_ORBIT || kind == POINT_GIVEN || kind == POINT_PATCHED;
  if (!on_arc || v->have_t) return SS_OK;
  const struct dyn_arc *arc = v->point->finite ? &v->perturbed : &v->arc;
  const struct num_type *t = v->ctx.type;
  struct num_vec z0, tau;
  num_vec_init(&z0, 4, v->ctx);
  num_vec_init(&tau, 1, v->ctx);
  int ph = (int)v->point->phase;
  for (int i = 0; i < 4; i++) t->set(num_vec_at(&z0, i), num_vec_at(&arc->z, 4 * ph + i));
  int s = t->mul(num_vec_at(&tau, 0), num_vec_at(&v->q, Q_S), num_vec_at(&arc->t, ph), v->ctx.prec);
  t->set(num_vec_at(&v->t, 0), num_vec_at(&tau, 0));
  for (int k = 0; k < ph; k++)
    s |= t->add(num_vec_at(&v->t, 0), num_vec_at(&v->t, 0), num_vec_at(&arc->t, k), v->ctx.prec);
  s |= flow_from(v, &z0, num_vec_at(&tau, 0));
  num_vec_clear(&tau);
  num_vec_clear(&z0);
  v->have_t = s == SS_OK;
  return s;
}

/* The motion that starts (x, y)/1024 beside the arc, with its own events. */
static int init_perturbed(struct values *v) {
  const struct num_type *t = v->ctx.type;
  struct num_vec w;
  num_vec_init(&w, 3, v->ctx);
  double guess[4];
  int s = t->set_d(num_vec_at(&w, 2), 1.0 / 1024, v->ctx.prec);
  for (int i = 0; i < 2; i++) {
    void *d = num_vec_at(&v->q, Q_X + i);
    s |= t->mul(d, d, num_vec_at(&w, 2), v->ctx.prec);
    s |= t->add(num_vec_at(&w, i), num_vec_at(&v->arc.z, i), d, v->ctx.prec);
  }
  s |= dyn_arc_run(&v->perturbed, &v->params, num_vec_at(&w, 0), num_vec_at(&w, 1), NULL);
  for (int i = 0; i < 4; i++) guess[i] = t->get_d(num_vec_at(&v->perturbed.t, i)) - t->get_d(num_vec_at(&v->arc.t, i));
  for (int i = 0; i < 4; i++)
    if (!(guess[i] > -0.5 && guess[i] < 0.5)) s |= SS_DOMAIN; /* another root: not a small perturbation */
  num_vec_clear(&w);
  return s;
}

int values_propagator(struct num_vec *out, struct values *v, enum phase ph) {
  struct num_vec kept = {v->ctx, 16, num_vec_at(&v->phi, 16 * (slong)ph)};
  int s = v->have_phi[ph] ? SS_OK : dyn_propagator(&kept, ph, &v->params, num_vec_at(&v->arc.t, (slong)ph));
  v->have_phi[ph] = s == SS_OK;
  num_vec_set(out, &kept);
  return s;
}

/* The states of an arc once more, each from the one before by the matrix exponential over the same times. */
static int carry_by_exponentials(struct dyn_arc *arc, struct values *v) {
  struct num_vec p, z;
  num_vec_init(&p, 16, v->ctx);
  num_vec_init(&z, 4, v->ctx);
  int s = SS_OK;
  for (int i = 0; i < 4; i++) v->ctx.type->set(num_vec_at(&z, i), num_vec_at(&arc->z, i));
  for (int ph = 0; ph < N_PHASES; ph++) {
    s |= arc == &v->arc ? values_propagator(&p, v, (enum phase)ph)
                        : dyn_propagator(&p, (enum phase)ph, &v->params, num_vec_at(&arc->t, ph));
    s |= num_mat_mul(&z, &p, &z, 4, 4, 1);
    for (int i = 0; i < 4; i++) v->ctx.type->set(num_vec_at(&arc->z, 4 * (ph + 1) + i), num_vec_at(&z, i));
  }
  num_vec_clear(&z);
  num_vec_clear(&p);
  return s;
}

/* The states at given times, whatever the switching functions are there. */
static int init_over_times(struct values *v) {
  struct num_vec z;
  num_vec_init(&z, 4, v->ctx);
  const struct num_type *t = v->ctx.type;
  t->set(num_vec_at(&z, 0), num_vec_at(&v->q, Q_Z1));
  t->set(num_vec_at(&z, 1), num_vec_at(&v->q, Q_Z2));
  for (int i = 0; i < 2; i++)
    t->set(num_vec_at(&z, 2 + i),
           v->point->kind == POINT_PATCHED ? num_vec_at(&v->q, Q_DZ1 + i) : num_vec_at(&v->params, P_V));
  int s = SS_OK;
  for (int ph = 0; ph <= N_PHASES; ph++) {
    for (int i = 0; i < 4; i++) t->set(num_vec_at(&v->arc.z, 4 * ph + i), num_vec_at(&z, i));
    if (ph == N_PHASES) break;
    t->set(num_vec_at(&v->arc.t, ph), num_vec_at(&v->q, Q_TA + ph));
    s |= dyn_flow(&z, (enum phase)ph, &v->params, &z, num_vec_at(&v->arc.t, ph));
  }
  num_vec_clear(&z);
  return s;
}

/* e1 and e2 where the scene does not give them: those of the orbit. */
static int set_limits(struct values *v, const struct dyn_orbit *o) {
  const struct num_type *t = v->ctx.type;
  int s = SS_OK;
  for (int i = 0; i < 2; i++) {
    if (v->point->scene->given[KEY_E1 + i]) continue;
    s |= t->set_arb(num_vec_at(&v->q, Q_E1 + i), i == 0 ? o->e1 : o->e2, v->ctx.prec);
    t->set(num_vec_at(&v->params, P_E1 + i), num_vec_at(&v->q, Q_E1 + i));
  }
  return s;
}

static const struct dyn_orbit *orbit_of(const struct point *p, struct orbit_cache *cache, slong prec) {
  if (p->known) return p->known;
  const struct dyn_orbits *list = point_orbits(p, cache, prec);
  return p->orbit < list->n ? &list->orbit[p->orbit] : NULL;
}

/* e1 and e2 of an orbit that is given by its times; its point holds u_r1 and u_r2 where others hold u_s1 and u_s2. */
static int take_forces(struct values *v, const struct dyn_orbit *o) {
  const struct num_type *t = v->ctx.type;
  int s = t->set_arb(num_vec_at(&v->q, Q_E1), o->e1, v->ctx.prec);
  s |= t->set_arb(num_vec_at(&v->q, Q_E2), o->e2, v->ctx.prec);
  for (int i = 0; i < 2; i++) {
    void *u = num_vec_at(&v->q, Q_US1 + i), *e = num_vec_at(&v->q, Q_E1 + i);
    s |= t->sub(u, u, e, v->ctx.prec);
    t->set(num_vec_at(&v->params, P_E1 + i), e);
  }
  return s;
}

static int init_arc(struct values *v, struct orbit_cache *cache) {
  int s = SS_OK;
  if (v->point->kind == POINT_ARC) {
    s |= dyn_arc_run(&v->arc, &v->params, num_vec_at(&v->q, Q_Z1), num_vec_at(&v->q, Q_Z2), NULL);
  } else {
    const struct dyn_orbit *o = orbit_of(v->point, cache, v->ctx.prec);
    if (!o || o->grazing) {
      s = SS_DOMAIN;
    } else {
      if (v->point->scene) s |= set_limits(v, o);
      if (v->point->kind == POINT_GIVEN) s |= take_forces(v, o);
      s |= orbit_arc(&v->arc, cache, o, &v->params);
    }
  }
  if (s == SS_OK && v->point->finite) s |= init_perturbed(v);
  if (s == SS_OK && v->variant == VARIANT_EXPONENTIAL) {
    s |= carry_by_exponentials(&v->arc, v);
    if (v->point->finite) s |= carry_by_exponentials(&v->perturbed, v);
  }
  return s;
}

/* An arc has four events to be found, differences several arcs. */
static void count_work(const struct point *p, enum variant variant, struct num_ctx ctx) {
  enum { UNITS_OF_ARC = 200, ARCS_OF_DIFFERENCES = 8 };
  unsigned long long words = ctx.prec > 128 ? (unsigned long long)ctx.prec / 128 : 1;
  bool arc = p->kind == POINT_ARC || p->kind == POINT_ORBIT || p->kind == POINT_GIVEN;
  if (arc) work_add(UNITS_OF_ARC * words * (variant == VARIANT_FD ? ARCS_OF_DIFFERENCES : 1));
  if (p->kind == POINT_FLOW)
    work_touch((enum work_part)(WORK_PHASE_D + (int)p->phase));
  else if (p->kind != POINT_PARAMS)
    for (int ph = 0; ph < N_PHASES; ph++) work_touch((enum work_part)(WORK_PHASE_D + ph));
  if (ctx.type == &num_arb)
    work_touch(ctx.prec <= 128   ? WORK_BITS_128
               : ctx.prec <= 256 ? WORK_BITS_256
               : ctx.prec <= 512 ? WORK_BITS_512
                                 : WORK_BITS_1024);
}

int values_init(struct values *v, const struct point *p, enum variant variant, struct num_ctx ctx,
                struct orbit_cache *cache) {
  *v = (struct values){.ctx = ctx, .point = p, .variant = variant};
  count_work(p, variant, ctx);
  num_vec_init(&v->q, N_Q, ctx);
  num_vec_init(&v->params, N_PARAMS, ctx);
  num_vec_init(&v->t, 1, ctx);
  num_vec_init(&v->dt, 4, ctx);
  num_vec_init(&v->zt, 4, ctx);
  num_vec_init(&v->azt, 4, ctx);
  num_vec_init(&v->local, 64, ctx);
  num_vec_init(&v->phi, 16 * N_PHASES, ctx);
  num_vec_init(&v->tangent, 20, ctx);
  dyn_arc_init(&v->arc, ctx);
  dyn_arc_init(&v->perturbed, ctx);
  int s = SS_OK;
  for (int i = 0; i < N_Q; i++) s |= ctx.type->set_q(num_vec_at(&v->q, i), &p->q[i], ctx.prec);
  for (int i = 0; i < N_PARAMS; i++) ctx.type->set(num_vec_at(&v->params, i), num_vec_at(&v->q, Q_CHI + i));
  if (s == SS_OK && p->kind == POINT_FLOW) s |= init_flow(v);
  if (s == SS_OK && (p->kind == POINT_PRINTED || p->kind == POINT_PATCHED)) s |= init_over_times(v);
  if (s == SS_OK && p->kind == POINT_PATCHED && variant == VARIANT_EXPONENTIAL) s |= carry_by_exponentials(&v->arc, v);
  if (s == SS_OK && (p->kind == POINT_ARC || p->kind == POINT_ORBIT || p->kind == POINT_GIVEN)) s |= init_arc(v, cache);
  return s;
}

void values_clear(struct values *v) {
  num_vec_clear(&v->q);
  num_vec_clear(&v->params);
  num_vec_clear(&v->t);
  num_vec_clear(&v->dt);
  num_vec_clear(&v->zt);
  num_vec_clear(&v->azt);
  num_vec_clear(&v->local);
  num_vec_clear(&v->phi);
  for (size_t i = 0; i < v->n_matrices; i++) num_vec_clear(&v->matrices[i].entry);
  free(v->matrices);
  num_vec_clear(&v->tangent);
  dyn_arc_clear(&v->arc);
  dyn_arc_clear(&v->perturbed);
}

/* --- Names --- */

static bool has_arc(const struct values *v) {
  return v->point->kind >= POINT_ARC;
}

int name_of_arc(const char *name) {
  static const struct {
    const char *name;
    int at;
  } table[] = {{"t_a", 100},  {"t_b", 101},  {"t_c", 102}, {"t_d", 103}, {"z_10", 0},   {"z_20", 1},  {"z'_10", 2},
               {"z'_20", 3},  {"z_1a", 4},   {"z_2a", 5},  {"z'_1a", 6}, {"z'_2a", 7},  {"z_1b", 8},  {"z_2b", 9},
               {"z'_1b", 10}, {"z'_2b", 11}, {"z_1c", 12}, {"z_2c", 13}, {"z'_1c", 14}, {"z'_2c", 15}};
  for (size_t i = 0; i < sizeof table / sizeof *table; i++)
    if (strcmp(table[i].name, name) == 0) return table[i].at;
  return -1;
}

/* A value of the arc's states or times by its name in the paper. */
static const void *arc_symbol(const struct values *v, const char *name) {
  int at = name_of_arc(name);
  if (at >= 0) return at >= 100 ? num_vec_at(&v->arc.t, at - 100) : num_vec_at(&v->arc.z, at);
  if (v->point->kind == POINT_ARC) return NULL; /* of the periodic solution */
  if (strcmp(name, "z_100") == 0) return num_vec_at(&v->arc.z, 0);
  if (strcmp(name, "z_200") == 0) return num_vec_at(&v->arc.z, 1);
  return NULL;
}

static const void *exact_symbol(const struct values *v, const char *name) {
  static const struct {
    const char *name;
    int q;
  } table[] = {{"chi", Q_CHI},  {"eta", Q_ETA},  {"V", Q_V}, {"e_1", Q_E1}, {"e_2", Q_E2},
               {"u_s1", Q_US1}, {"u_s2", Q_US2}, {"x", Q_X}, {"y", Q_Y},    {"lambda", Q_LAMBDA}};
  for (size_t i = 0; i < sizeof table / sizeof *table; i++)
    if (strcmp(table[i].name, name) == 0) return num_vec_at(&v->q, table[i].q);
  if (strcmp(name, "t") == 0)
    return num_vec_at(v->point->kind == POINT_PARAMS ? &v->q : &v->t, v->point->kind == POINT_PARAMS ? Q_T : 0);
  return NULL;
}

/* dt of a phase from dZ at its start: the switching function stays zero at the end, so its gradient applied to
   exp(A t) dZ is minus its rate times dt.  The switching functions are affine: their gradient is a difference. */
static int event_shift(void *dt, struct values *v, int ph, const struct num_vec *dz) {
  const struct num_type *t = v->ctx.type;
  slong p = v->ctx.prec;
  struct num_vec phi, end, w;
  num_vec_init(&phi, 16, v->ctx);
  num_vec_init(&end, 4, v->ctx);
  num_vec_init(&w, 2, v->ctx);
  void *at_zero = num_vec_at(&w, 0), *rate = num_vec_at(&w, 1);
  int s = dyn_switching(at_zero, (enum phase)ph, &v->params, &end);
  s |= values_propagator(&phi, v, (enum phase)ph);
  s |= num_mat_mul(&end, &phi, dz, 4, 4, 1);
  s |= dyn_switching(dt, (enum phase)ph, &v->params, &end);
  s |= t->sub(dt, dt, at_zero, p);
  for (int i = 0; i < 4; i++) t->set(num_vec_at(&end, i), num_vec_at(&v->arc.z, 4 * (ph + 1) + i));
  s |= dyn_switching_rate(rate, (enum phase)ph, &v->params, &end);
  s |= t->div(dt, dt, rate, p);
  s |= t->neg(dt, dt, p);
  num_vec_clear(&w);
  num_vec_clear(&end);
  num_vec_clear(&phi);
  return s;
}

/* The direction (x, y) carried along the word by the local Jacobians. */
static int carry_tangent(struct values *v) {
  struct num_vec dz, j, unused;
  num_vec_init(&dz, 4, v->ctx);
  num_vec_init(&j, 16, v->ctx);
  num_vec_init(&unused, N_STATE * LOCAL_MOST, v->ctx);
  v->ctx.type->set(num_vec_at(&dz, 0), num_vec_at(&v->q, Q_X));
  v->ctx.type->set(num_vec_at(&dz, 1), num_vec_at(&v->q, Q_Y));
  int s = SS_OK;
  for (int ph = 0; s == SS_OK && ph < N_PHASES; ph++)
    s = oracle_eval(&unused, oracle_find(local_maps[ph].name), v); /* makes the local Jacobian */
  for (int ph = 0; s == SS_OK && ph < N_PHASES; ph++) {
    s |= event_shift(num_vec_at(&v->dt, ph), v, ph, &dz);
    for (int i = 0; i < 16; i++) v->ctx.type->set(num_vec_at(&j, i), num_vec_at(&v->local, 16 * ph + i));
    s |= num_mat_mul(&dz, &j, &dz, 4, 4, 1);
    for (int i = 0; i < 4; i++) v->ctx.type->set(num_vec_at(&v->tangent, 4 * (ph + 1) + i), num_vec_at(&dz, i));
  }
  num_vec_clear(&unused);
  num_vec_clear(&j);
  num_vec_clear(&dz);
  return s;
}

/* Any numbers but x and y, and but for the velocities of masses that stick before and after. */
static int free_tangents(struct values *v) {
  static const bool zero[20] = {[6] = true, [7] = true, [11] = true, [18] = true};
  const struct num_type *t = v->ctx.type;
  int s = SS_OK;
  for (int i = 0; i < 20; i++) {
    void *z = num_vec_at(&v->tangent, i);
    s |= t->set_d(z, zero[i] ? 0 : 0.8125 + 0.71875 * i, v->ctx.prec);
    if (!zero[i]) s |= t->mul(z, z, num_vec_at(&v->q, i % 2 ? Q_Y : Q_X), v->ctx.prec);
    if (i < 2) t->set(z, num_vec_at(&v->q, Q_X + i));
  }
  for (int i = 0; i < 4; i++) s |= t->set_d(num_vec_at(&v->dt, i), 0.40625 + 0.34375 * i, v->ctx.prec);
  return s;
}

/* The perturbations x_a ... v_f and dt_a ... dt_d: tangents, or differences between the two motions. */
static int make_tangents(struct values *v) {
  if (v->have_tangent) return SS_OK;
  const struct num_type *t = v->ctx.type;
  int s = SS_OK;
  if (v->point->kind == POINT_PATCHED)
    s |= free_tangents(v);
  else if (!v->point->finite)
    s |= carry_tangent(v);
  for (int i = 0; v->point->finite && i < 20; i++)
    s |= t->sub(num_vec_at(&v->tangent, i), num_vec_at(&v->perturbed.z, i), num_vec_at(&v->arc.z, i), v->ctx.prec);
  for (int i = 0; v->point->finite && i < 4; i++)
    s |= t->sub(num_vec_at(&v->dt, i), num_vec_at(&v->perturbed.t, i), num_vec_at(&v->arc.t, i), v->ctx.prec);
  v->have_tangent = s == SS_OK;
  return s;
}

bool name_of_tangent(const char *name, int *index) {
  static const char components[] = "xyuv", ends[] = "abcf", times[] = "abcd";
  const char *c = name[0] ? strchr(components, name[0]) : NULL;
  if (c && !name[1]) {
    *index = (int)(c - components);
    return true;
  }
  if (c && name[1] == '_' && name[2] && !name[3] && strchr(ends, name[2])) {
    *index = 4 * (int)(strchr(ends, name[2]) - ends + 1) + (int)(c - components);
    return true;
  }
  if (strncmp(name, "dt_", 3) != 0 || !name[3] || name[4] || !strchr(times, name[3])) return false;
  *index = 100 + (int)(strchr(times, name[3]) - times);
  return true;
}

bool name_of_motion(const char *name, bool *in_x, int *component, int *primes, const char **argument) {
  if ((name[0] != 'z' && name[0] != 'x') || name[1] != '_' || (name[2] != '1' && name[2] != '2')) return false;
  *in_x = name[0] == 'x';
  *component = name[2] - '1';
  const char *p = name + 3;
  for (*primes = 0; *p == '\''; p++) ++*primes;
  *argument = p;
  return *p == '(' && *primes <= 2;
}

/* The motion t_b after its start: still in the stick phase where t_b < t_a, then in the slip-stick phase. */
static int state_at_tb(struct num_vec *z, struct values *v) {
  const struct num_type *t = v->ctx.type;
  struct num_vec w;
  num_vec_init(&w, 2, v->ctx);
  void *rest = num_vec_at(&w, 0), *zero = num_vec_at(&w, 1);
  const void *ta = num_vec_at(&v->arc.t, 0), *tb = num_vec_at(&v->arc.t, 1);
  int s = t->set_d(zero, 0, v->ctx.prec) | t->sub(rest, tb, ta, v->ctx.prec);
  bool sticks = t->lt(rest, zero) == TRUTH_TRUE;
  if (t->lt(zero, ta) != TRUTH_TRUE || (!sticks && t->lt(rest, zero) != TRUTH_FALSE)) s |= SS_UNABLE;
  for (int i = 0; i < 4; i++) t->set(num_vec_at(z, i), num_vec_at(&v->arc.z, 4 * !sticks + i));
  if (s == SS_OK) s |= dyn_flow(z, sticks ? PHASE_D : PHASE_GAMMA, &v->params, z, sticks ? tb : rest);
  num_vec_clear(&w);
  return s;
}

int name_of_switching_time(const char *argument) {
  static const char *const times[8] = {"(t_a)",
                                       "(t_a + t_b)",
                                       "(t_a + t_b + t_c)",
                                       "(t_a + t_b + t_c + t_d)",
                                       "(t_a + dt_a)",
                                       "(t_a + dt_a + t_b + dt_b)",
                                       "(t_a + dt_a + t_b + dt_b + t_c + dt_c)",
                                       "(t_a + dt_a + t_b + dt_b + t_c + dt_c + t_d + dt_d)"};
  for (int k = 0; k < 8; k++)
    if (strcmp(argument, times[k]) == 0) return k;
  return -1;
}

/* z at one of the times that the paper's sentences name: flows at 0 and t, arcs at t and at the switching times.  At the
   perturbed switching times the motion is the perturbed one; it has a value only where there is one. */
static int motion_value(void *z, bool *known, struct values *v, int component, int primes, const char *argument) {
  const struct num_type *t = v->ctx.type;
  *known = true;
  if (v->point->kind == POINT_FLOW && strcmp(argument, "(0)") == 0 && primes < 2) {
    t->set(z, num_vec_at(&v->q, Q_Z1 + component + 2 * primes));
    return SS_OK;
  }
  if (v->point->kind != POINT_PARAMS && strcmp(argument, "(t)") == 0) {
    int s = ensure_time(v);
    t->set(z, primes == 2 ? num_vec_at(&v->azt, component + 2) : num_vec_at(&v->zt, component + 2 * primes));
    return s;
  }
  if (has_arc(v) && primes < 2 && strcmp(argument, "(t_b)") == 0) {
    struct num_vec at;
    num_vec_init(&at, 4, v->ctx);
    int s = state_at_tb(&at, v);
    t->set(z, num_vec_at(&at, component + 2 * primes));
    num_vec_clear(&at);
    return s;
  }
  int k = name_of_switching_time(argument);
  if (has_arc(v) && primes < 2 && k >= 0 && (k < 4 || v->point->finite)) {
    const struct dyn_arc *arc = k >= 4 ? &v->perturbed : &v->arc;
    t->set(z, num_vec_at(&arc->z, 4 * (k % 4 + 1) + component + 2 * primes));
    return SS_OK;
  }
  *known = false;
  return SS_UNABLE;
}

/* x = z + d, so velocities and accelerations agree. */
static int bind_motion(void *z, bool *known, struct values *v, bool in_x, int component, int primes,
                       const char *argument) {
  int s = motion_value(z, known, v, component, primes, argument);
  if (s || !in_x || primes) return s;
  struct num_vec d;
  num_vec_init(&d, 1, v->ctx);
  s |= oracle_eval(&d, oracle_find(component ? "d_02" : "d_01"), v);
  s |= v->ctx.type->add(z, z, num_vec_at(&d, 0), v->ctx.prec);
  num_vec_clear(&d);
  return s;
}

/* Made once for all of its entries. */
static const struct oracle_matrix *oracle_matrix(struct values *v, const struct oracle *o) {
  for (size_t i = 0; i < v->n_matrices; i++)
    if (v->matrices[i].of == o) return &v->matrices[i];
  v->matrices = ss_grow(v->matrices, v->n_matrices, &v->cap_matrices, sizeof *v->matrices);
  struct oracle_matrix *m = &v->matrices[v->n_matrices++];
  m->of = o;
  num_vec_init(&m->entry, oracle_rows(o) * oracle_cols(o), v->ctx);
  m->status = oracle_eval(&m->entry, o, v);
  return m;
}

/* "J_a[1,2]": an entry of one of the model's matrices. */
static int bind_entry(void *z, bool *known, struct values *v, const char *name, const char *bracket) {
  char base[32];
  size_t n = (size_t)(bracket - name);
  *known = false;
  if (n >= sizeof base) return SS_UNABLE;
  memcpy(base, name, n);
  base[n] = '\0';
  const struct oracle *o = oracle_find(base);
  int i = atoi(bracket + 1), j = atoi(strchr(bracket, ',') + 1);
  if (!o || i > oracle_rows(o) || j > oracle_cols(o)) return SS_UNABLE;
  *known = true;
  const struct oracle_matrix *m = oracle_matrix(v, o);
  v->ctx.type->set(z, num_vec_at(&m->entry, (i - 1) * oracle_cols(o) + j - 1));
  return m->status;
}

int values_bind(void *z, bool *known, struct values *v, const char *name) {
  const struct num_type *t = v->ctx.type;
  *known = true;
  int status = strcmp(name, "t") == 0 ? ensure_time(v) : SS_OK;
  const void *p = exact_symbol(v, name);
  if (!p && has_arc(v)) p = arc_symbol(v, name);
  if (p) {
    t->set(z, p);
    return status;
  }
  if (strcmp(name, "u_r1") == 0) return t->add(z, num_vec_at(&v->q, Q_US1), num_vec_at(&v->q, Q_E1), v->ctx.prec);
  if (strcmp(name, "u_r2") == 0) return t->add(z, num_vec_at(&v->q, Q_US2), num_vec_at(&v->q, Q_E2), v->ctx.prec);
  int index, component, primes;
  if (has_arc(v) && name_of_tangent(name, &index)) {
    int s = make_tangents(v);
    t->set(z, index >= 100 ? num_vec_at(&v->dt, index - 100) : num_vec_at(&v->tangent, index));
    return s;
  }
  if (springs_bind(&status, z, v, name)) return status;
  bool in_x;
  const char *argument, *bracket = strchr(name, '[');
  if (bracket) return bind_entry(z, known, v, name, bracket);
  if (name_of_motion(name, &in_x, &component, &primes, &argument))
    return bind_motion(z, known, v, in_x, component, primes, argument);
  *known = false;
  return SS_UNABLE;
}
