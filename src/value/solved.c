/* Orbits to the digits asked for: the precision doubles until every number of every orbit has them; then what the
   search may have missed, then the proofs. */
#include "solved.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "mech/two_masses.h"

static const struct {
  const char *name;
  size_t offset;
  const char *meaning;
} numbers[ORBIT_NUMBERS] = {
#define NUMBER(name, member, meaning) {name, offsetof(struct dyn_orbit, member), meaning},
    DYN_ORBIT_NUMBERS(NUMBER)
#undef NUMBER
};

const char *orbit_number_name(int i) {
  return numbers[i].name;
}

const char *orbit_number_meaning(int i) {
  return numbers[i].meaning;
}

arb_srcptr orbit_number(const struct dyn_orbit *o, int i) {
  return (arb_srcptr)(const void *)((const char *)o + numbers[i].offset);
}

const fmpq *scene_given_number(const struct scene *s, int i) {
  for (int k = KEY_E1; k <= KEY_TD; k++)
    if (s->given[k] && strcmp(scene_key_name[k], numbers[i].name) == 0) return &s->value[k];
  return NULL;
}

static bool all_printable(const struct dyn_orbits *list, const struct scene *s, slong digits) {
  bool ok = true;
  for (slong k = 0; k < list->n; k++)
    for (int i = 0; ok && i < ORBIT_NUMBERS; i++)
      ok = scene_given_number(s, i) || num_has_digits(orbit_number(&list->orbit[k], i), 1, digits);
  return ok;
}

bool solved_find(struct solved *z, const struct scene *s, slong digits) {
  slong prec = num_bits(digits) + 64, last = 8 * prec;
  bool good;
  z->proof = NULL;
  for (;; prec *= 2) {
    z->found = audit_orbits(&z->list, s, prec);
    good = all_printable(&z->list, s, digits);
    if (good || prec == last) break;
    dyn_orbits_clear(&z->list);
  }
  slong listed = z->list.n;
  if (good) audit_orbits_complete(&z->list, s, prec);
  if (z->list.n > listed) good = all_printable(&z->list, s, digits);
  if (good) solved_prove(z, s);
  return good;
}

/* The scene as a question; value borrows from it. */
static void question_of(struct dyn_question *q, enum dyn_quantity which[2], fmpq value[2], const struct scene *s) {
  *q = (struct dyn_question){.model = s->value + KEY_CHI, .value = value, .which = which};
  orbits_given_pair(which, value, s->value, s->given);
  scene_static_friction(q->u_r, s);
}

void solved_prove(struct solved *z, const struct scene *s) {
  struct dyn_question q;
  enum dyn_quantity which[2];
  fmpq value[2];
  z->proof = ss_malloc((size_t)(z->list.n + 1) * sizeof *z->proof);
  question_of(&q, which, value, s);
  for (slong i = 0; i < z->list.n; i++) {
    struct dyn_orbit *o = &z->list.orbit[i];
    z->proof[i] = (struct dyn_certificate){.certified = false};
    dyn_certify(&z->proof[i], &q, o);
    if (!z->proof[i].certified) continue;
    o->stable = z->proof[i].stable;
    for (int k = 0; k < N_CONDITIONS; k++) o->holds[k] = z->proof[i].holds[k];
  }
  if (scene_solution_ii(s)) judge_three_phases(&z->list, z->proof);
}

void solved_clear(struct solved *z) {
  for (slong i = 0; z->proof && i < z->list.n; i++) dyn_certificate_clear(&z->proof[i]);
  free(z->proof);
  dyn_orbits_clear(&z->list);
}

slong solved_certified(const struct solved *z) {
  slong n = 0;
  for (slong i = 0; i < z->list.n; i++) n += z->proof[i].certified;
  return n;
}

void solved_certificates(struct text *out, const struct solved *z, const struct scene *s) {
  struct dyn_question q;
  enum dyn_quantity which[2];
  fmpq value[2];
  question_of(&q, which, value, s);
  two_masses_certificates_json(out, s->name, &q, &z->list, z->proof);
}

slong solved_word_bits(slong digits) {
  return num_bits(digits) + 32;
}

int solved_word(struct word_orbits *list, const struct mech_word *w, const struct scene *s, slong digits) {
  enum { SIMULATIONS = 32 };
  const fmpq *u_r[2];
  OWNED(word_seeds) seeds;
  scene_static_friction(u_r, s);
  word_seeds_find(&seeds, s->value, u_r, SIMULATIONS);
  return word_orbits_find(list, w, s->value, u_r, &seeds, solved_word_bits(digits));
}

truth orbit_admissible(truth u[2], const struct scene *s, const struct dyn_orbit *o) {
  enum { PREC = 1024 };
  const fmpq *u_r[2];
  scene_static_friction(u_r, s);
  const truth holds[2] = {orbit_friction_enough(o, 0, u_r[0], PREC), orbit_friction_enough(o, 1, u_r[1], PREC)};
  for (int i = 0; i < 2 && u; i++) u[i] = holds[i];
  return truth_and(o->admissible, truth_and(holds[0], holds[1]));
}

const char *orbit_condition_name(int i) {
  return i < N_CONDITIONS ? dyn_condition_id[i] : scene_key_name[KEY_U_R1 + i - N_CONDITIONS];
}

bool orbit_breaks(const struct dyn_orbit *o, const truth u[2], int i) {
  return (i < N_CONDITIONS ? o->holds[i] : u[i - N_CONDITIONS]) == TRUTH_FALSE;
}
