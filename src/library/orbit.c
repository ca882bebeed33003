/* The orbits of a scene. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "library.h"
#include "motion/complete.h"
#include "motion/warm.h"

struct ss_orbits {
  struct solved z;
  struct scene asked; /* of the scene: what is given, its word and its name */
  struct ss_number (*number)[ORBIT_NUMBERS];
};

static void keep_question(struct scene *kept, const struct scene *s) {
  *kept = (struct scene){.name = ss_strdup(s->name), .word = s->word};
  for (int k = 0; k < N_KEYS; k++) {
    fmpq_init(&kept->value[k]);
    fmpq_set(&kept->value[k], &s->value[k]);
    kept->given[k] = s->given[k];
  }
}

static void drop_question(struct scene *kept) {
  for (int k = 0; k < N_KEYS; k++) fmpq_clear(&kept->value[k]);
  free(kept->name);
}

static void borrow(struct ss_orbits *o) {
  o->number = ss_malloc((size_t)(o->z.list.n + 1) * sizeof *o->number);
  for (slong k = 0; k < o->z.list.n; k++)
    for (int i = 0; i < ORBIT_NUMBERS; i++)
      o->number[k][i] = (struct ss_number){orbit_number(&o->z.list.orbit[k], i), scene_given_number(&o->asked, i)};
}

int ss_orbits_find(ss_orbits **out, const ss_scene *s, size_t digits) {
  if (!out) return library_argument(__func__, "no place for the orbits");
  *out = NULL;
  if (!s) return library_argument(__func__, "no scene");
  int status = library_digits(__func__, digits, LIBRARY_DIGITS);
  if (!status) status = library_point(s, true, false);
  if (status) return status;
  struct ss_orbits *o = ss_malloc(sizeof *o);
  o->number = NULL;
  keep_question(&o->asked, &s->s);
  if (solved_find(&o->z, &o->asked, (slong)digits)) {
    borrow(o);
    *out = o;
    return SS_OK;
  }
  ss_orbits_free(o);
  return library_fail(SS_UNABLE, "%s: an orbit could not be enclosed to %zu digits; more take a higher precision",
                      s->s.name, digits);
}

/* The orbit in the direction in which phase C ends; one of them at most is an orbit of the word. */
static bool near(struct dyn_orbit *o, const fmpq *params, double t_b, double t_c, slong prec) {
  for (int up = 0; up < 2; up++) {
    truth first;
    if (dyn_orbit_near(o, &first, params, (struct dyn_place){t_b, t_c, up}, prec, NULL) == SS_OK && first == TRUTH_TRUE)
      return true;
    dyn_orbit_clear(o);
  }
  return false;
}

int ss_orbits_near(ss_orbits **out, const ss_scene *s, double t_b, double t_c, size_t digits) {
  if (!out) return library_argument(__func__, "no place for the orbit");
  *out = NULL;
  if (!s || !(t_b > 0 && t_c > 0 && t_b < INFINITY && t_c < INFINITY))
    return library_argument(__func__, "no scene, or a time that is not positive");
  int status = library_digits(__func__, digits, LIBRARY_DIGITS);
  if (!status) status = library_point(s, true, true);
  if (status) return status;
  struct dyn_orbit *one = ss_malloc(sizeof *one);
  if (!near(one, s->s.value, t_b, t_c, num_bits((slong)digits) + 64)) {
    free(one);
    return library_fail(SS_UNABLE, "%s: no orbit is proved near t_b = %.6g, t_c = %.6g", s->s.name, t_b, t_c);
  }
  struct ss_orbits *o = ss_malloc(sizeof *o);
  keep_question(&o->asked, &s->s);
  o->z = (struct solved){.list = {.orbit = one, .n = 1, .gap = GAP_UNTRIED}};
  solved_prove(&o->z, &o->asked);
  borrow(o);
  *out = o;
  return SS_OK;
}

void ss_orbits_free(ss_orbits *o) {
  if (!o) return;
  free(o->number);
  solved_clear(&o->z);
  drop_question(&o->asked);
  free(o);
}

static const struct dyn_orbit *orbit_of(const struct ss_orbits *o, size_t k) {
  return o && k < (size_t)o->z.list.n ? &o->z.list.orbit[k] : NULL;
}

const char *ss_orbit_number_name(int number) {
  return number >= 0 && number < ORBIT_NUMBERS ? orbit_number_name(number) : NULL;
}

size_t ss_orbits_count(const ss_orbits *o) {
  return o ? (size_t)o->z.list.n : 0;
}

int ss_orbits_complete(const ss_orbits *o) {
  return o && o->z.list.complete;
}

double ss_orbits_reach(const ss_orbits *o) {
  if (!ss_orbits_complete(o)) return NAN;
  return o->z.list.t_c_max > 0 ? o->z.list.t_c_max : INFINITY;
}

const char *ss_orbits_gap(const ss_orbits *o) {
  return o && !o->z.list.complete ? dyn_gap_text[o->z.list.gap] : NULL;
}

const ss_number *ss_orbit_number(const ss_orbits *o, size_t k, int number) {
  return orbit_of(o, k) && number >= 0 && number < ORBIT_NUMBERS ? &o->number[k][number] : NULL;
}

enum ss_truth ss_orbit_stable(const ss_orbits *o, size_t k) {
  const struct dyn_orbit *z = orbit_of(o, k);
  return z ? (enum ss_truth)z->stable : SS_UNKNOWN;
}

enum ss_truth ss_orbit_admissible(const ss_orbits *o, size_t k) {
  truth u[2];
  const struct dyn_orbit *z = orbit_of(o, k);
  return z ? (enum ss_truth)orbit_admissible(u, &o->asked, z) : SS_UNKNOWN;
}

const char *ss_orbit_violation(const ss_orbits *o, size_t k, size_t i) {
  truth u[2];
  const struct dyn_orbit *z = orbit_of(o, k);
  if (!z) return NULL;
  orbit_admissible(u, &o->asked, z);
  for (int c = 0; c < ORBIT_CONDITIONS; c++)
    if (orbit_breaks(z, u, c) && i-- == 0) return orbit_condition_name(c);
  return NULL;
}

int ss_orbit_certified(const ss_orbits *o, size_t k) {
  return orbit_of(o, k) && o->z.proof[k].certified;
}

int ss_orbit_open(char **out, const ss_orbits *o, size_t k) {
  if (!out) return library_argument(__func__, "no place for the text");
  *out = NULL;
  if (!orbit_of(o, k)) return library_argument(__func__, "no such orbit");
  struct text t = {0};
  if (!o->z.proof[k].certified) dyn_certificate_why(&t, &o->z.proof[k]);
  *out = library_take(&t);
  return SS_OK;
}

int ss_orbits_certificate(char **out, const ss_orbits *o) {
  if (!out) return library_argument(__func__, "no place for the text");
  *out = NULL;
  if (!o) return library_argument(__func__, "no orbits");
  if (scene_solution_ii(&o->asked))
    return library_fail(SS_INPUT, "%s: a certificate is of the word D-Gamma-H-C, not of Gamma-H-C", o->asked.name);
  if (solved_certified(&o->z) == 0) return library_fail(SS_UNABLE, "%s: no orbit is certified", o->asked.name);
  struct text t = {0};
  solved_certificates(&t, &o->z, &o->asked);
  *out = library_take(&t);
  return SS_OK;
}
