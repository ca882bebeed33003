/* What a point is worth in one number type: its parameters, the motion through it and that motion's neighbour, made
   afresh by the model and never by the paper's formulas.  The routes differ in how the states follow from one another:
   by the closed flow, or by the matrix exponential of each phase. */
#include "followed.h"
#include "num/calc.h"
#include "values_impl.h"

#include <stdlib.h>

#include "base/work.h"

const void *values_exact(struct values *v, int q) {
  v->read |= 1U << q;
  return num_vec_at(&v->q, q);
}

int values_carry(struct num_vec *out, const struct values *v, enum phase ph, const struct num_vec *from,
                 const void *tau) {
  if (v->variant != VARIANT_EXPONENTIAL) return dyn_flow(out, ph, &v->params, from, tau);
  OWNED(num_vec) p;
  num_vec_init(&p, 16, v->ctx);
  int s = dyn_propagator(&p, ph, &v->params, tau);
  s |= num_mat_mul(out, &p, from, 4, 4, 1);
  return s;
}

/* The state after time tau of the phase from another one, and its derivative. */
static int flow_from(struct num_vec *z, struct num_vec *rate, const struct values *v, enum phase ph,
                     const struct num_vec *from, const void *tau) {
  OWNED(num_vec) a;
  num_vec_init(&a, N_STATE * N_STATE, v->ctx);
  int s = values_carry(z, v, ph, from, tau);
  s |= dyn_system(&a, ph, &v->params);
  return s | num_mat_mul(rate, &a, z, N_STATE, N_STATE, 1);
}

int values_along(struct num_vec *z, struct num_vec *rate, const struct values *v, enum phase ph, const void *tau) {
  struct followed *f = v->followed;
  const struct num_vec from = dyn_arc_state(&v->arc, ph);
  if (!f) return flow_from(z, rate, v, ph, &from, tau);
  double near = v->ctx.type->get_d(tau);
  for (size_t i = 0; i < f->n; i++) {
    const struct moment *m = &f->moment[i];
    if (m->near != near || m->variant != v->variant || m->phase != ph || !num_same(v->ctx.type, m->tau.data, tau))
      continue;
    num_vec_set(z, &m->z);
    num_vec_set(rate, &m->rate);
    return m->status;
  }
  struct moment *m = SS_PUSH(f->moment, f->n, f->cap);
  *m = (struct moment){
      .variant = v->variant, .phase = ph, .near = near, .status = flow_from(z, rate, v, ph, &from, tau)};
  num_vec_init(&m->tau, 1, v->ctx);
  num_vec_init(&m->z, N_STATE, v->ctx);
  num_vec_init(&m->rate, N_STATE, v->ctx);
  v->ctx.type->set(num_vec_at(&m->tau, 0), tau);
  num_vec_set(&m->z, z);
  num_vec_set(&m->rate, rate);
  return m->status;
}

static int init_flow(struct values *v) {
  const struct num_vec z0 = {v->ctx, N_STATE, num_vec_at(&v->q, Q_Z1)};
  v->ctx.type->set(num_vec_at(&v->t, 0), num_vec_at(&v->q, Q_T));
  return flow_from(&v->zt, &v->azt, v, v->point->phase, &z0, num_vec_at(&v->t, 0));
}

/* The time t on an arc: the start of the point's phase and the fraction Q_S of its length. */
int values_time(struct values *v) {
  enum point_kind kind = v->point->kind;
  bool on_arc = point_has_events(kind) || kind == POINT_PATCHED;
  if (!on_arc || v->have_t) return SS_OK;
  const struct dyn_arc *arc = v->point->finite ? &v->perturbed : &v->arc;
  const struct num_type *t = v->ctx.type;
  struct num_vec tau = calc_vec(&v->c, 1);
  const struct num_vec z0 = dyn_arc_state(arc, v->point->phase);
  int ph = (int)v->point->phase;
  int s = t->mul(num_vec_at(&tau, 0), values_exact(v, Q_S), num_vec_at(&arc->t, ph), v->ctx.prec);
  t->set(num_vec_at(&v->t, 0), num_vec_at(&tau, 0));
  for (int k = 0; k < ph; k++)
    s |= t->add(num_vec_at(&v->t, 0), num_vec_at(&v->t, 0), num_vec_at(&arc->t, k), v->ctx.prec);
  s |= flow_from(&v->zt, &v->azt, v, v->point->phase, &z0, num_vec_at(&tau, 0));
  v->have_t = s == SS_OK;
  return s;
}

/* The motion that starts (x, y)/1024 beside the arc, with its own events. */
static int init_perturbed(struct values *v) {
  const struct num_type *t = v->ctx.type;
  struct num_vec w = calc_vec(&v->c, 3);
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
  return s;
}

int values_propagator(struct num_vec *out, struct values *v, enum phase ph) {
  bool *have = v->followed ? &v->followed->have_phi[ph] : &v->have_phi[ph];
  struct num_vec kept = {v->ctx, 16, num_vec_at(v->followed ? &v->followed->phi : &v->phi, 16 * (slong)ph)};
  int s = *have ? SS_OK : dyn_propagator(&kept, ph, &v->params, num_vec_at(&v->arc.t, (slong)ph));
  *have = s == SS_OK;
  num_vec_set(out, &kept);
  return s;
}

/* The states of an arc once more, each from the one before by the matrix exponential over the same times. */
static int carry_by_exponentials(struct dyn_arc *arc, struct values *v) {
  struct num_vec p = calc_vec(&v->c, 16);
  int s = SS_OK;
  for (int ph = 0; ph < N_PHASES; ph++) {
    s |= arc == &v->arc ? values_propagator(&p, v, (enum phase)ph)
                        : dyn_propagator(&p, (enum phase)ph, &v->params, num_vec_at(&arc->t, ph));
    const struct num_vec from = dyn_arc_state(arc, ph);
    struct num_vec to = dyn_arc_state(arc, ph + 1);
    s |= num_mat_mul(&to, &p, &from, 4, 4, 1);
  }
  return s;
}

/* The states at given times, whatever the switching functions are there. */
static int init_over_times(struct values *v) {
  const struct num_type *t = v->ctx.type;
  int s = SS_OK;
  for (int i = 0; i < 2; i++) {
    const void *speed = v->point->kind == POINT_PATCHED ? num_vec_at(&v->q, Q_DZ1 + i) : num_vec_at(&v->params, P_V);
    t->set(num_vec_at(&v->arc.z, Z_1 + i), num_vec_at(&v->q, Q_Z1 + i));
    t->set(num_vec_at(&v->arc.z, DZ_1 + i), speed);
  }
  for (int ph = 0; ph < N_PHASES; ph++) {
    const struct num_vec from = dyn_arc_state(&v->arc, ph);
    struct num_vec to = dyn_arc_state(&v->arc, ph + 1);
    t->set(num_vec_at(&v->arc.t, ph), num_vec_at(&v->q, Q_TA + ph));
    s |= dyn_flow(&to, (enum phase)ph, &v->params, &from, num_vec_at(&v->arc.t, ph));
  }
  return s;
}

static const struct dyn_orbit *orbit_of(const struct point *p, struct orbit_cache *cache, slong prec) {
  if (p->known) return p->known;
  const struct dyn_orbits *list = point_orbits(p, cache, prec);
  return p->orbit < list->n ? &list->orbit[p->orbit] : NULL;
}

/* e1 and e2 of the orbit, where the scene does not give them.  The point of one that is given by its times holds u_r1
   and u_r2 where others hold u_s1 and u_s2. */
static int take_forces(struct values *v, const struct dyn_orbit *o) {
  const struct num_type *t = v->ctx.type;
  int s = SS_OK;
  for (int i = 0; i < 2; i++) {
    void *u = num_vec_at(&v->q, Q_US1 + i), *e = num_vec_at(&v->q, Q_E1 + i);
    if (v->point->scene && v->point->scene->given[KEY_E1 + i]) continue;
    s |= t->set_arb(e, i == 0 ? o->e1 : o->e2, v->ctx.prec);
    t->set(num_vec_at(&v->params, P_E1 + i), e);
    if (v->point->kind == POINT_GIVEN) s |= t->sub(u, u, e, v->ctx.prec);
  }
  return s;
}

static int take_followed(struct values *v, struct orbit_cache *cache, const struct dyn_orbit *o) {
  v->followed = orbit_followed(cache, o, &v->params);
  num_vec_set(&v->arc.t, &v->followed->arc.t);
  num_vec_set(&v->arc.z, &v->followed->arc.z);
  return v->followed->status;
}

/* The orbit once more, by the engine for any system. */
static int take_system(struct values *v, struct orbit_cache *cache, const struct dyn_orbit *o) {
  if (v->ctx.type != &num_arb || v->point->kind != POINT_ORBIT || v->point->scene || v->point->finite) return SS_DOMAIN;
  const struct system_orbit *s = followed_system(orbit_followed(cache, o, &v->params), v->point->q + Q_CHI);
  if (s->status) return s->status;
  _arb_vec_set(num_vec_at(&v->arc.t, 0), s->t, N_PHASES);
  _arb_vec_set(num_vec_at(&v->arc.z, 0), s->z, (N_PHASES + 1) * N_STATE);
  _arb_vec_set(num_vec_at(&v->return_jacobian, 0), s->j, 4);
  return SS_OK;
}

static int init_arc(struct values *v, struct orbit_cache *cache) {
  int s = SS_OK;
  if (v->point->kind == POINT_ARC) {
    s |= v->variant == VARIANT_SYSTEM
             ? SS_DOMAIN
             : dyn_arc_run(&v->arc, &v->params, num_vec_at(&v->q, Q_Z1), num_vec_at(&v->q, Q_Z2), NULL);
  } else {
    const struct dyn_orbit *o = orbit_of(v->point, cache, v->ctx.prec);
    if (!o || o->grazing) {
      s = SS_DOMAIN;
    } else {
      if (v->point->scene || v->point->kind == POINT_GIVEN) s |= take_forces(v, o);
      s |= v->variant == VARIANT_SYSTEM ? take_system(v, cache, o) : take_followed(v, cache, o);
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
  if (point_has_events(p->kind)) work_add(UNITS_OF_ARC * words * (variant == VARIANT_FD ? ARCS_OF_DIFFERENCES : 1));
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
  *v = (struct values){.ctx = ctx, .point = p, .variant = variant, .c = calc_begin(ctx)};
  count_work(p, variant, ctx);
  v->q = calc_vec(&v->c, N_Q);
  v->params = calc_vec(&v->c, N_PARAMS);
  v->t = calc_vec(&v->c, 1);
  v->dt = calc_vec(&v->c, 4);
  v->zt = calc_vec(&v->c, 4);
  v->azt = calc_vec(&v->c, 4);
  v->local = calc_vec(&v->c, 64);
  v->return_jacobian = calc_vec(&v->c, 4);
  v->phi = calc_vec(&v->c, 16 * N_PHASES);
  v->tangent = calc_vec(&v->c, 20);
  dyn_arc_init(&v->arc, ctx);
  dyn_arc_init(&v->perturbed, ctx);
  int s = SS_OK;
  for (int i = 0; i < N_Q; i++) s |= ctx.type->set_q(num_vec_at(&v->q, i), &p->q[i], ctx.prec);
  for (int i = 0; i < N_PARAMS; i++) ctx.type->set(num_vec_at(&v->params, i), num_vec_at(&v->q, Q_CHI + i));
  if (s == SS_OK && p->kind == POINT_FLOW) s |= init_flow(v);
  if (s == SS_OK && (p->kind == POINT_PRINTED || p->kind == POINT_PATCHED)) s |= init_over_times(v);
  if (s == SS_OK && p->kind == POINT_PATCHED && variant == VARIANT_EXPONENTIAL) s |= carry_by_exponentials(&v->arc, v);
  if (s == SS_OK && point_has_events(p->kind)) s |= init_arc(v, cache);
  return s;
}

void values_clear(struct values *v) {
  free(v->matrices);
  dyn_arc_clear(&v->arc);
  dyn_arc_clear(&v->perturbed);
  calc_clear(&v->c);
}
