/* The states of an exact motion at its switching times, and their perturbations.  Each is free, but for what its phase
   and its event say of it, or follows from the one before by the propagator of the phase between them.  An event is an
   affine equation: it decides one component of a free state, or e_1 or e_2 where the whole state is known. */
#include <stdio.h>
#include <string.h>

#include "exact_motion_impl.h"
#include "num/calc.h"

int motion_length(element *z, struct exact_motion *m, int phase) {
  return motion_symbol(z, m, name_time[phase]);
}

/* What a switching function says of a vector: its value, or without its constant, for perturbations. */
static int switching(element *z, struct exact_motion *m, int phase, const struct num_vec *v, bool linear) {
  int s = (linear ? dyn_switching_along : dyn_switching)(z, (enum phase)phase, &m->params, v);
  return s == SS_OK ? exact_reduce(z, m->field) : s;
}

/* Component i of v so chosen that the affine switching function that ends the phase is zero. */
static int obey(struct num_vec *v, struct exact_motion *m, int phase, int i, bool linear) {
  struct num_vec w = calc_vec(&m->c, 2);
  int s = num_exact.set_d(at(v, i), 0, 0);
  s |= switching(at(&w, 0), m, phase, v, linear);
  s |= num_exact.set_d(at(v, i), 1, 0);
  s |= switching(at(&w, 1), m, phase, v, linear);
  s |= motion_op(num_exact.sub, at(&w, 1), m, at(&w, 0), at(&w, 1));
  return s == SS_OK ? motion_op(num_exact.div, at(v, i), m, at(&w, 0), at(&w, 1)) : s;
}

/* For each end of a phase, from the start of the period on: which components are free, and which one the event decides
   (-1: none). */
static const struct {
  bool free[N_STATE];
  int decided;
} ends[5] = {{{[Z_1] = true, [Z_2] = true}, -1},
             {{[Z_2] = true}, Z_1},
             {{[Z_1] = true, [DZ_1] = true}, Z_2},
             {{[Z_1] = true, [Z_2] = true, [DZ_2] = true}, DZ_1},
             {{[Z_1] = true, [Z_2] = true}, DZ_2}};

/* Any state at all: no mass sticks, no event has been. */
static int any_state(struct num_vec *v, struct exact_motion *m, int k) {
  int s = SS_OK;
  for (int i = 0; i < N_STATE; i++) {
    char name[32];
    snprintf(name, sizeof name, "Z_%c[%d]", "0abcd"[k], i + 1);
    s |= exact_symbol(at(v, i), m->field, name);
  }
  return s;
}

static int free_end(struct num_vec *v, struct exact_motion *m, int k, bool perturbation) {
  int s = SS_OK;
  for (int i = 0; i < N_STATE; i++) {
    if (ends[k].free[i]) s |= exact_symbol(at(v, i), m->field, (perturbation ? name_tangent : name_state)[k][i]);
    if (i < DZ_1 || phase_slips[k == 0 ? PHASE_D : k - 1][i - DZ_1]) continue;
    if (perturbation) /* of the velocity of a mass that sticks in the phase that ends */
      s |= num_exact.set_d(at(v, i), 0, 0);
    else
      num_exact.set(at(v, i), at(&m->params, P_V));
  }
  return s == SS_OK && ends[k].decided >= 0 ? obey(v, m, k - 1, ends[k].decided, perturbation) : s;
}

/* The event decides e_1 or e_2 where the state is known. */
static int decide_limit(struct exact_motion *m, int k, struct num_vec *z) {
  struct num_vec w = calc_vec(&m->c, 1);
  int limit = k == 1 ? P_E1 : P_E2;
  num_exact.set_d(at(&m->params, limit), 0, 0);
  int s = switching(at(&w, 0), m, k - 1, z, false);
  num_exact.set(at(&m->params, limit), at(&w, 0));
  return s;
}

/* From one end of the phase to the other, over its length and as much more; back: against the time. */
static int carried(struct num_vec *z, struct exact_motion *m, int phase, const struct num_vec *from,
                   const element *more, bool back) {
  struct num_vec p = calc_vec(&m->c, 16), u = calc_vec(&m->c, 1);
  int s = motion_length(at(&u, 0), m, phase);
  if (more) s |= motion_op(num_exact.add, at(&u, 0), m, at(&u, 0), more);
  if (back) s |= num_exact.neg(at(&u, 0), at(&u, 0), 0);
  s |= exact_propagator(&p, m, (enum phase)phase, at(&u, 0));
  return s == SS_OK ? motion_multiply(z, m, &p, from, 4, 4, 1) : s;
}

int motion_state(struct num_vec *z, struct exact_motion *m, int k) {
  if (k == 4 && is_periodic(m)) k = 0;
  *z = part(&m->state, 4 * k, 4);
  if (m->have_state[k]) return m->state_status;
  m->have_state[k] = true;
  bool patched = m->spec.kind == POINT_PATCHED;
  if (k <= m->attempt.anchor || k <= m->first_state || (k == 0 && is_periodic(m)))
    return m->state_status |= patched ? any_state(z, m, k) : free_end(z, m, k, false);
  struct num_vec before;
  bool back = k == 3 && m->attempt.anchor == ANCHOR_BACK;
  int s = motion_state(&before, m, back ? 4 : k - 1);
  if (s == SS_OK) s = carried(z, m, back ? PHASE_C : k - 1, &before, NULL, back);
  if (s == SS_OK && !patched && (k == 1 || k == 2)) s = decide_limit(m, k, z);
  return m->state_status |= s;
}

int motion_meeting(const char *name) {
  int k = 0;
  while (k < N_PHASES - 1 && strncmp(name, name_meeting[k], strlen(name_meeting[k])) != 0) k++;
  return k < N_PHASES - 1 ? k + 1 : 0;
}

/* --- Perturbations --- */

int motion_rate(struct num_vec *f, struct exact_motion *m, int phase, const struct num_vec *z) {
  struct num_vec a = calc_vec(&m->c, 16);
  int s = motion_system(&a, m, (enum phase)phase);
  return s == SS_OK ? motion_multiply(f, m, &a, z, 4, 4, 1) : s;
}

int motion_rate_at(struct num_vec *f, struct exact_motion *m, int k, int phase) {
  struct num_vec z;
  int s = motion_state(&z, m, k);
  return s == SS_OK ? motion_rate(f, m, phase, &z) : s;
}

/* -n dz/(n f), by which the event comes later when the state at its time is dz off. */
int motion_delay(element *dt, struct exact_motion *m, int k, const struct num_vec *dz, const struct num_vec *z) {
  OWNED(calc) c = exact_calc(m->field);
  void *off = calc_new(&c), *rate = calc_new(&c);
  c.status = switching(off, m, k - 1, dz, true);
  c.status |= dyn_switching_rate(rate, (enum phase)(k - 1), &m->params, z) | exact_reduce(rate, m->field);
  calc_store(&c, dt, calc_neg(&c, calc_div(&c, off, rate)));
  return c.status;
}

static int free_shift(element *dt, struct exact_motion *m, int phase) {
  return exact_symbol(dt, m->field, name_shift[phase]);
}

/* P dz + f dt, with dt where the event asks for it (located) or free. */
static int first_order(struct num_vec *out, struct exact_motion *m, int k, const struct num_vec *dz) {
  OWNED(calc) c = exact_calc(m->field);
  struct num_vec z, f = calc_vec(&c, 4);
  element *dt = at(&m->shift, k - 1);
  int s = motion_state(&z, m, k);
  s |= carried(out, m, k - 1, dz, NULL, false);
  if (s == SS_OK) s = motion_rate(&f, m, k - 1, &z);
  if (s == SS_OK)
    s = m->attempt.tangents == TANGENTS_LOCATED ? motion_delay(dt, m, k, out, &z) : free_shift(dt, m, k - 1);
  c.status = s;
  for (int i = 0; i < 4; i++) calc_store(&c, at(out, i), calc_add(&c, at(out, i), calc_mul(&c, at(&f, i), dt)));
  return c.status;
}

/* The other motion, Z + dZ, carried over the longer phase, less this one. */
static int difference(struct num_vec *out, struct exact_motion *m, int k, const struct num_vec *dz) {
  struct num_vec z, other = calc_vec(&m->c, 4);
  element *dt = at(&m->shift, k - 1);
  int s = motion_state(&z, m, k - 1);
  s |= free_shift(dt, m, k - 1);
  for (int i = 0; s == SS_OK && i < 4; i++) s = motion_op(num_exact.add, at(&other, i), m, at(&z, i), at(dz, i));
  if (s == SS_OK) s = carried(out, m, k - 1, &other, dt, false);
  if (s == SS_OK) s = motion_state(&z, m, k);
  for (int i = 0; s == SS_OK && i < 4; i++) s = motion_op(num_exact.sub, at(out, i), m, at(out, i), at(&z, i));
  return s;
}

/* At patched points any numbers, but that the velocity of a mass which sticks in the phase before, constant in that
   phase's system, is the belt's with and without the perturbation. */
static int any_tangent(struct num_vec *dz, struct exact_motion *m, int k) {
  struct num_vec a = calc_vec(&m->c, 16);
  int s = k > 0 ? motion_system(&a, m, (enum phase)(k - 1)) : SS_OK;
  for (int i = 0; i < N_STATE; i++) {
    bool sticks = k > 0 && i >= DZ_1;
    for (int c = 0; sticks && c < N_STATE; c++) sticks = exact_is_zero(at(&a, 4 * i + c));
    s |= sticks ? num_exact.set_d(at(dz, i), 0, 0) : exact_symbol(at(dz, i), m->field, name_tangent[k][i]);
  }
  return s;
}

int motion_tangent(struct num_vec *dz, struct exact_motion *m, int k) {
  *dz = part(&m->tangent, 4 * k, 4);
  if (m->have_tangent[k]) return m->tangent_status;
  m->have_tangent[k] = true;
  bool patched = m->spec.kind == POINT_PATCHED;
  if (patched || m->attempt.tangents == TANGENTS_FREE || k <= m->first_tangent) {
    if (k > 0) m->tangent_status |= free_shift(at(&m->shift, k - 1), m, k - 1);
    return m->tangent_status |= patched ? any_tangent(dz, m, k) : free_end(dz, m, k, true);
  }
  struct num_vec before;
  int s = motion_tangent(&before, m, k - 1);
  if (s == SS_OK) s = m->spec.finite ? difference(dz, m, k, &before) : first_order(dz, m, k, &before);
  return m->tangent_status |= s;
}

int motion_perturbed(struct num_vec *out, struct exact_motion *m, int k, bool perturbed) {
  struct num_vec z, dz;
  int s = motion_state(&z, m, k);
  num_vec_set(out, &z);
  if (!perturbed || s != SS_OK) return s;
  s = motion_tangent(&dz, m, k);
  for (int i = 0; s == SS_OK && i < 4; i++) s = motion_op(num_exact.add, at(out, i), m, at(out, i), at(&dz, i));
  return s;
}
