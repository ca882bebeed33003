#include "followed.h"

#include <stdlib.h>

#include "base/arena.h"

struct followed *followed_new(const struct dyn_orbit *o, const struct num_vec *params) {
  struct num_ctx ctx = params->ctx;
  OWNED(num_vec) z;
  struct followed *f = ss_malloc(sizeof *f);
  *f = (struct followed){.orbit = o, .start = {num_arb.get_d(o->z10), num_arb.get_d(o->z20)}};
  num_vec_init(&z, 2, ctx);
  num_vec_init(&f->phi, 16 * N_PHASES, ctx);
  dyn_arc_init(&f->arc, ctx);
  f->status = ctx.type->set_arb(num_vec_at(&z, 0), o->z10, ctx.prec);
  f->status |= ctx.type->set_arb(num_vec_at(&z, 1), o->z20, ctx.prec);
  f->status |= dyn_arc_run(&f->arc, params, num_vec_at(&z, 0), num_vec_at(&z, 1), o->guess);
  return f;
}

void followed_free(struct followed *f) {
  for (size_t i = 0; i < f->n; i++) {
    num_vec_clear(&f->moment[i].tau);
    num_vec_clear(&f->moment[i].z);
    num_vec_clear(&f->moment[i].rate);
  }
  free(f->moment);
  if (f->system) system_orbit_clear(f->system);
  free(f->system);
  num_vec_clear(&f->phi);
  dyn_arc_clear(&f->arc);
  free(f);
}

const struct system_orbit *followed_system(struct followed *f, const fmpq params[N_PARAMS]) {
  if (!f->system) {
    f->system = ss_malloc(sizeof *f->system);
    system_orbit_init(f->system, params, f->orbit, f->arc.t.ctx.prec);
  }
  return f->system;
}

bool followed_is(const struct followed *f, const struct dyn_orbit *o, struct num_ctx ctx) {
  return f->orbit == o && f->start[0] == num_arb.get_d(o->z10) && f->start[1] == num_arb.get_d(o->z20) &&
         f->arc.t.ctx.type == ctx.type && f->arc.t.ctx.prec == ctx.prec;
}

static int moment_make(struct num_vec *z, struct num_vec *rate, const struct values *v, enum phase ph,
                       const void *tau) {
  OWNED(calc) c = calc_begin(v->ctx);
  struct num_vec a = calc_vec(&c, N_STATE * N_STATE);
  const struct num_vec from = dyn_arc_state(&v->arc, ph);
  int s = values_carry(z, v, ph, &from, tau);
  s |= dyn_system(&a, ph, &v->params);
  return s | num_mat_mul(rate, &a, z, N_STATE, N_STATE, 1);
}

int values_along(struct num_vec *z, struct num_vec *rate, const struct values *v, enum phase ph, const void *tau) {
  struct followed *f = v->followed;
  if (!f) return moment_make(z, rate, v, ph, tau);
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
  *m = (struct moment){.variant = v->variant, .phase = ph, .near = near, .status = moment_make(z, rate, v, ph, tau)};
  num_vec_init(&m->tau, 1, v->ctx);
  num_vec_init(&m->z, N_STATE, v->ctx);
  num_vec_init(&m->rate, N_STATE, v->ctx);
  v->ctx.type->set(num_vec_at(&m->tau, 0), tau);
  num_vec_set(&m->z, z);
  num_vec_set(&m->rate, rate);
  return m->status;
}
