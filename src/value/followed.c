/* What is made of an orbit that is followed, each when it is first asked for. */
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
