/* Orbits along a line: the families of a stretch at a time, so that memory does not grow with the line. */
#include <math.h>
#include <string.h>

#include "explore/family.h"
#include "library.h"

static void nothing_there(struct ss_swept *row) {
  for (int i = 0; i < SS_OUTPUTS; i++) row->out[i] = NAN;
  row->violations = row->unsure = 0;
  row->stable = row->admissible = SS_UNKNOWN;
}

static void take_member(struct ss_swept *row, const struct dyn_member *m) {
  memcpy(row->out, m->out, sizeof row->out);
  row->violations = m->violations;
  row->unsure = m->unsure;
  row->stable = (enum ss_truth)m->stable;
  row->admissible = (enum ss_truth)dyn_member_admissible(m);
}

static bool tell_point(const struct dyn_family *f, slong i, slong begin, ss_on_orbit tell, void *self) {
  const struct dyn_family_point *p = &f->point[i];
  struct ss_swept row = {
      .point = (size_t)(begin + i), .x = p->x, .orbits = (size_t)p->n, .status = dyn_family_status_name[p->status]};
  nothing_there(&row);
  if (p->n == 0) return tell(self, &row) != 0;
  for (slong k = 0; k < p->n; k++) {
    row.orbit = (size_t)k;
    take_member(&row, &f->member[p->first + k]);
    if (!tell(self, &row)) return false;
  }
  return true;
}

static int tell_all(const struct dyn_family_request *q, ss_on_orbit tell, void *self) {
  slong stretch = dyn_axis_stretch(q->every), n = q->axis->n;
  bool on = true;
  int status = SS_OK;
  for (slong begin = 0; begin < n && on && !status; begin += stretch) {
    OWNED(dyn_family) f;
    status = dyn_family_find(&f, q, begin, begin + stretch < n ? begin + stretch : n);
    for (slong i = 0; i < f.n_points && on && !status; i++) on = tell_point(&f, i, begin, tell, self);
  }
  if (status) return library_fail(status, "ss_sweep: the line leaves the domain");
  return on ? SS_OK : library_fail(SS_STOPPED, "ss_sweep: stopped by the caller");
}

static int sweep_line(const struct scene_range *l, const struct ss_scene *s, size_t n, size_t every, ss_on_orbit f,
                      void *self) {
  double held;
  if ((n == 1) != (fmpq_equal(l->from, l->to) != 0))
    return library_fail(SS_ARGUMENT, "ss_sweep: one value has one end, more have two that differ");
  if (num_double.set_q(&held, l->from, 53) || num_double.set_q(&held, l->to, 53))
    return library_fail(SS_INPUT, "ss_sweep: an end cannot be held in double precision");
  OWNED(dyn_axis) axis;
  dyn_axis_init(&axis, l->vary, l->from, l->to, (slong)n);
  struct dyn_family_request q = {.params = s->s.value,
                                 .axis = &axis,
                                 .every = every ? (slong)every : dyn_axis_usual_every((slong)n),
                                 .late = true};
  scene_static_friction(q.u_r, &s->s);
  return tell_all(&q, f, self);
}

int ss_sweep(const ss_scene *s, const char *parameter, const char *from, const char *to, size_t n, size_t every,
             ss_on_orbit f, void *self) {
  if (!f || n < 1 || n > AXIS_MOST_POINTS || every > AXIS_MOST_EVERY)
    return library_argument(__func__, "no function to tell, or n or every out of range");
  LOCAL(scene_range, l);
  int status = library_range(&l, s, parameter, from, to);
  if (!status) status = sweep_line(&l, s, n, every, f, self);
  return status;
}
