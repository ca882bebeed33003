/* The model's matrices on an exact motion: the derivative of each phase's event-located map, the propagator of the
   period, and the Jacobian of the period.  That Jacobian is the product of the corners that the paper keeps, once it is
   known that each phase carries perturbations to where the next corner takes them up. */
#include <stdio.h>
#include <string.h>

#include "exact_motion_impl.h"
#include "num/calc.h"

/* The 4x4 derivative of the event-located map of a phase: column by column what it makes of a perturbation. */
static int local_jacobian(struct num_vec *j, struct exact_motion *m, int phase) {
  OWNED(calc) c = exact_calc(m->field);
  struct num_vec z, f = calc_vec(&c, 4), col = calc_vec(&c, 4), p = calc_vec(&c, 16);
  void *dt = calc_new(&c), *u = calc_new(&c);
  c.status = motion_state(&z, m, phase + 1);
  c.status |= motion_rate(&f, m, phase, &z);
  c.status |= motion_length(u, m, phase);
  c.status |= exact_propagator(&p, m, (enum phase)phase, u);
  for (int k = 0; c.status == SS_OK && k < 4; k++) {
    for (int i = 0; i < 4; i++) num_exact.set(at(&col, i), at(&p, 4 * i + k));
    c.status = motion_delay(dt, m, phase + 1, &col, &z);
    for (int i = 0; i < 4; i++)
      calc_store(&c, at(j, 4 * i + k), calc_add(&c, calc_mul(&c, at(&f, i), dt), at(&col, i)));
  }
  return c.status;
}

static int corner(struct num_vec *out, struct exact_motion *m, int phase) {
  struct num_vec j = calc_vec(&m->c, 16);
  int s = local_jacobian(&j, m, phase);
  if (s == SS_OK) s = local_map_corner(out, &local_maps[phase], &j, at(&m->params, P_CHI));
  return s == SS_OK ? motion_reduce(out, m) : s;
}

static int period_matrix(struct num_vec *out, struct exact_motion *m) {
  struct num_vec p = calc_vec(&m->c, 16), u = calc_vec(&m->c, 1);
  int s = SS_OK;
  for (int ph = 0; s == SS_OK && ph < N_PHASES; ph++) {
    s = motion_length(at(&u, 0), m, ph);
    if (s == SS_OK) s = exact_propagator(&p, m, (enum phase)ph, at(&u, 0));
    if (ph == 0)
      num_vec_set(out, &p);
    else if (s == SS_OK)
      s = motion_multiply(out, m, &p, out, 4, 4, 4);
  }
  return s;
}

/* --- The Jacobian of the period, from its corners --- */

/* Column k of what a corner takes in, as a perturbation. */
static int direction(struct num_vec *v, struct exact_motion *m, int phase, int k) {
  int s = SS_OK;
  for (int i = 0; i < N_STATE; i++) {
    enum entering in = local_maps[phase].in[k][i];
    s |= num_exact.set_d(at(v, i), in != STAYS_OUT, 0);
    if (in == ENTERS_BY_CHI) num_exact.set(at(v, i), at(&m->params, P_CHI));
  }
  return s;
}

/* Does the phase carry the perturbations of its corner's columns to those of the next corner's, as the corner says? */
static bool hands_over(struct exact_motion *m, int phase) {
  const struct local_map *map = &local_maps[phase];
  OWNED(calc) c = exact_calc(m->field);
  struct num_vec j = calc_vec(&c, 16), kept = calc_vec(&c, map->rows * map->cols);
  struct num_vec v = calc_vec(&c, 4), w = calc_vec(&c, 4);
  c.status = local_jacobian(&j, m, phase);
  if (c.status == SS_OK) c.status = corner(&kept, m, phase);
  for (int k = 0; c.status == SS_OK && k < map->cols; k++) {
    c.status = direction(&v, m, phase, k);
    if (c.status == SS_OK) c.status = motion_multiply(&v, m, &j, &v, 4, 4, 1);
    for (int r = 0; c.status == SS_OK && r < map->rows; r++) {
      c.status = direction(&w, m, phase + 1, r);
      val by = at(&kept, r * map->cols + k);
      for (int i = 0; i < 4; i++) calc_store(&c, at(&v, i), calc_sub(&c, at(&v, i), calc_mul(&c, at(&w, i), by)));
    }
    for (int i = 0; i < 4; i++)
      if (!exact_is_zero(at(&v, i))) c.status |= SS_UNABLE;
  }
  return c.status == SS_OK;
}

/* The product of the corners, held as unknowns, once it is known that each phase hands over to the next. */
static int return_jacobian(struct num_vec *out, struct exact_motion *m) {
  struct num_vec sum = calc_vec(&m->c, 6);
  char name[32];
  int s = SS_OK;
  m->used_matrix = true;
  for (int ph = 0; ph + 1 < N_PHASES; ph++)
    if (!hands_over(m, ph)) return SS_UNABLE;
  for (int ph = 0; s == SS_OK && ph < N_PHASES; ph++) {
    const struct local_map *map = &local_maps[ph];
    struct num_vec c = calc_vec(&m->c, map->rows * map->cols);
    for (int i = 0; i < map->rows * map->cols; i++) {
      snprintf(name, sizeof name, "%s[%d,%d]", map->name, i / map->cols + 1, i % map->cols + 1);
      s |= exact_symbol(at(&c, i), m->field, name);
    }
    struct num_vec before = part(&sum, 0, map->cols * 2), after = part(&sum, 0, map->rows * 2);
    if (ph == 0)
      num_vec_set(&after, &c);
    else if (s == SS_OK)
      s = motion_multiply(&after, m, &c, &before, map->rows, map->cols, 2);
  }
  for (int i = 0; i < 4; i++) num_exact.set(at(out, i), at(&sum, i));
  return s;
}

/* --- By name --- */

/* "dZ_0", "dZ_a", ... "dZ_f": 0 to 4; -1 for another name. */
static int perturbation_named(const char *name) {
  static const char ends_of[] = "0abcf";
  const char *c = strncmp(name, "dZ_", 3) == 0 && name[3] && !name[4] ? strchr(ends_of, name[3]) : NULL;
  return c ? (int)(c - ends_of) : -1;
}

int exact_motion_oracle(struct num_vec *out, struct exact_motion *m, const char *name) {
  static const char *const rational[] = {"K", "K_1", "K_2", "d_01", "d_02"};
  if (word_find(name, rational, 5) < 5) return motion_of_params(out, m, name);
  for (int ph = 0; ph < N_PHASES; ph++)
    if (strcmp(name, local_maps[ph].name) == 0) return corner(out, m, ph);
  int phase = name_of_propagator(name);
  if (phase >= 0) {
    struct num_vec u = calc_vec(&m->c, 1);
    int s = exact_symbol(at(&u, 0), m->field, "t");
    return s == SS_OK ? exact_propagator(out, m, (enum phase)phase, at(&u, 0)) : s;
  }
  if (strcmp(name, "N") == 0) return period_matrix(out, m);
  if (has_word(m) && motion_meeting(name)) {
    struct num_vec z;
    int s = motion_state(&z, m, motion_meeting(name));
    num_vec_set(out, &z);
    return s;
  }
  int end = m->spec.kind == POINT_PATCHED ? perturbation_named(name) : -1;
  if (end >= 0) {
    struct num_vec dz;
    int s = motion_tangent(&dz, m, end);
    num_vec_set(out, &dz);
    return s;
  }
  if (strcmp(name, "J") == 0) return return_jacobian(out, m);
  if (strcmp(name, "omega_1") == 0 || strcmp(name, "omega_2") == 0) {
    m->wants_modes = !m->attempt.modes;
    if (!m->attempt.modes) return SS_UNABLE;
    num_exact.set(at(out, 0), at(&m->frequency, name[6] - '1'));
    return SS_OK;
  }
  return motion_unknown(m, name);
}
