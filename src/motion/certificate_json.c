/* The certificates of a scene's orbits as one file (exact_json.h): the two masses as a system in z, where sliding
   friction is in no equation and e1 and e2 are the excesses.

   Nothing is computed here. */
#include "certify.h"
#include "num/exact_json.h"

static void mass_json(struct json *j, const char *name, const fmpq *inertia, const fmpq *u_r, const fmpq *V) {
  JSON_OBJECT(j, NULL);
  json_string(j, "name", name);
  json_fraction(j, "inertia", inertia);
  if (u_r) json_fraction(j, "static", u_r);
  json_fraction(j, "surface", V);
}

static void system_json(struct json *j, const struct dyn_question *q) {
  static const char *const name[2] = {"m1", "m2"};
  const fmpq *chi = q->model + P_CHI, *V = q->model + P_V;
  NUMBERS(fmpq, one, light, gap);
  fmpq_one(one);
  fmpq_inv(light, q->model + P_ETA);
  fmpq_sub(gap, one, chi);
  const fmpq *inertia[2] = {one, light}, *stiffness[2] = {gap, chi};
  JSON_OBJECT(j, "system");
  JSON_EACH (j, "masses", i, 2) mass_json(j, name[i], inertia[i], q->u_r[i], V);
  JSON_EACH (j, "springs", i, 2) json_link(j, i, i + 1, "stiffness", stiffness[i]);
  json_string_array(j, "dampers", NULL, 0);
  json_string_array(j, "loads", NULL, 0);
}

/* Some of the quantities: a given one exactly, of the others the balls. */
static void box_of(struct json *j, const char *key, int first, int n, const struct dyn_question *q,
                   const struct dyn_certificate *z) {
  JSON_EACH (j, key, i, n) {
    const fmpq *given = NULL;
    for (int k = 0; k < 2; k++)
      if ((int)q->which[k] == first + i) given = q->value + k;
    if (given)
      json_fraction(j, NULL, given);
    else
      json_ball(j, NULL, z->box[first + i]);
  }
}

static void box_json(struct json *j, const struct dyn_question *q, const struct dyn_certificate *z) {
  JSON_OBJECT(j, "box");
  box_of(j, "times", QUANTITY_TA, N_PHASES, q, z);
  json_array(j, "free");
  json_ball(j, NULL, z->box_z10);
  json_ball(j, NULL, z->box_z20);
  json_end_array(j);
  box_of(j, "excess", QUANTITY_E1, 2, q, z);
}

/* V, and the multiplier 0 beside the trace (the stick phase forgets all but z_2 - z_1), are told to as many bits as the
   period; the least static limits, which a checker finds by halving phases, to at most FOUND. */
static void enclosures_json(struct json *j, const struct dyn_question *q, const struct dyn_orbit *o) {
  enum { FOUND = 256 };
  slong bits = FLINT_MAX(arb_rel_accuracy_bits(o->period), DYN_CERTIFY_FIRST);
  NUMBERS(arb, V, zero, real, u_r1, u_r2);
  arb_set_fmpq(V, q->model + P_V, bits);
  arb_add_error_2exp_si(zero, -bits);
  arb_set_round(u_r1, o->u_r1_min, FOUND);
  arb_set_round(u_r2, o->u_r2_min, FOUND);
  JSON_OBJECT(j, "enclosures");
  json_balls(j, "times", (arb_srcptr[]){o->t[PHASE_D], o->t[PHASE_GAMMA], o->t[PHASE_H], o->t[PHASE_C]}, N_PHASES);
  json_balls(j, "start", (arb_srcptr[]){o->z10, o->z20, V, V}, 4);
  json_balls(j, "excess", (arb_srcptr[]){o->e1, o->e2}, 2);
  json_wide_ball(j, "period", o->period);
  json_array(j, "multipliers");
  json_multiplier(j, o->trace, real);
  json_multiplier(j, zero, real);
  json_end_array(j);
  json_balls(j, "static", (arb_srcptr[]){u_r1, u_r2}, 2);
}

/* What is asked of each mass in each phase: of m1 in phase D w < e1, which is t_a > 0. */
static const int condition[N_PHASES][2] = {
    [PHASE_D] = {COND_TA, COND_D_R},
    [PHASE_GAMMA] = {COND_GAMMA_V1, COND_GAMMA_R},
    [PHASE_H] = {COND_H_V1, COND_H_V2},
    [PHASE_C] = {COND_C_W, COND_C_V2},
};

static void orbit_json(struct json *j, const struct dyn_question *q, const struct dyn_orbit *o,
                       const struct dyn_certificate *z) {
  static const char *const word[N_PHASES] = {"ss", "-s", "--", "s-"};
  JSON_OBJECT(j, NULL);
  json_string_array(j, "word", word, N_PHASES);
  box_json(j, q, z);
  enclosures_json(j, q, o);
  JSON_EACH (j, "kept", k, N_PHASES)
    json_printf(j, NULL, "%s%s", z->holds[condition[k][0]] == TRUTH_TRUE ? "y" : "n",
                z->holds[condition[k][1]] == TRUTH_TRUE ? "y" : "n");
  json_verdicts(j, z->stable, z->admissible);
}

void dyn_certificates_json(struct text *out, const char *scene, const struct dyn_question *q,
                           const struct dyn_orbits *list, const struct dyn_certificate *proof) {
  OWNED(json) j = json_certificate(out, scene);
  system_json(&j, q);
  JSON_EACH (&j, "orbits", i, list->n)
    if (proof[i].certified) orbit_json(&j, q, &list->orbit[i], &proof[i]);
}
