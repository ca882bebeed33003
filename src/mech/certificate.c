/* Certified orbits as a file for stickslip-checker, see verify/checker/README.md: the system, and of each orbit what is
   proved of it, with numbers without loss (rationals p/q, balls in Arb's text form, four hexadecimal integers).

   Nothing is computed here. */
#include <string.h>

#include "moments.h"
#include "orbit.h"
#include "two_masses.h"

/* --- Numbers, and what both kinds of orbits have --- */

static void fraction_json(struct json *j, const char *key, const fmpq *x) {
  JSON_STRING(j, key, num_print_q(j->out, x));
}

static void ball_json(struct json *j, const char *key, arb_srcptr x) {
  char *s = arb_dump_str(x);
  json_string(j, key, s);
  flint_free(s);
}

/* With its radius doubled, so that a checker that rounds elsewhere can prove that its own enclosure lies within. */
static void wide_ball_json(struct json *j, const char *key, arb_srcptr x) {
  NUMBERS(arb, y);
  arb_set(y, x);
  mag_mul_2exp_si(arb_radref(y), arb_radref(y), 1);
  ball_json(j, key, y);
}

static void multiplier_json(struct json *j, arb_srcptr re, arb_srcptr im) {
  JSON_OBJECT(j, NULL);
  wide_ball_json(j, "re", re);
  wide_ball_json(j, "im", im);
}

static void verdicts_json(struct json *j, truth stable, truth admissible) {
  JSON_OBJECT(j, "verdicts");
  json_bool(j, "stable", stable == TRUTH_TRUE);
  json_bool(j, "admissible", admissible == TRUTH_TRUE);
}

/* --- The system --- */

/* limit: NULL where none is given. */
static void mass_json(struct json *j, const struct mech_mass *mass, bool open, const fmpq *limit) {
  static const char *const side[2] = {"below", "above"};
  JSON_OBJECT(j, NULL);
  json_string(j, "name", mass->name);
  fraction_json(j, "inertia", mass->inertia);
  if (mass->rubbed) {
    if (!open) fraction_json(j, "sliding", mass->sliding);
    if (limit) fraction_json(j, "static", limit);
    fraction_json(j, "surface", mass->surface);
  }
  for (int s = 0; s < 2; s++) {
    if (!mass->stop[s].given) continue;
    JSON_OBJECT(j, side[s]);
    fraction_json(j, "position", mass->stop[s].position);
    fraction_json(j, "restitution", mass->stop[s].restitution);
  }
}

static void links_json(struct json *j, const char *list, const char *size, const struct mech_link *link, int n) {
  JSON_EACH (j, list, l, n) {
    JSON_OBJECT(j, NULL);
    JSON_EACH (j, "between", s, 2) json_printf(j, NULL, "%d", link[l].end[s] + 1);
    fraction_json(j, size, link[l].size);
  }
}

/* u_r: where sliding friction is left open, the static limits that are given; else NULL. */
static void system_json(struct json *j, const struct mech *m, const fmpq *const *u_r) {
  JSON_OBJECT(j, "system");
  JSON_EACH (j, "masses", i, m->n) mass_json(j, &m->mass[i], u_r != NULL, u_r ? u_r[i] : m->mass[i].limit);
  links_json(j, "springs", "stiffness", m->spring, m->n_springs);
  links_json(j, "dampers", "constant", m->damper, m->n_dampers);
  JSON_EACH (j, "loads", l, m->n_loads) {
    JSON_OBJECT(j, NULL);
    json_printf(j, "mass", "%d", m->load[l].mass + 1);
    if (m->load[l].order > 1) json_printf(j, "order", "%d", m->load[l].order);
    fraction_json(j, "cosine", m->load[l].cosine);
    fraction_json(j, "sine", m->load[l].sine);
  }
  if (m->n_loads) fraction_json(j, "frequency", m->frequency);
}

/* Begins the file; scene: a name. */
static struct json begin(struct text *out, const char *scene, const struct mech *m, const fmpq *const *u_r) {
  struct json j = json_document(out, NULL);
  json_string(&j, "format", "stickslip orbits, version 2");
  json_string(&j, "scene", scene);
  system_json(&j, m, u_r);
  return j;
}

/* --- Orbits of systems --- */

static void balls_json(struct json *j, const char *key, arb_srcptr x, int n, bool wide) {
  JSON_EACH (j, key, i, n) (wide ? wide_ball_json : ball_json)(j, NULL, x + i);
}

/* The position of a mass that has just broken loose is its limit over a stiffness: where that is exact it gets a
   radius, since a checker that divides in balls does not meet it. */
static void start_json(struct json *j, const struct mech_orbit *o, int i) {
  enum { BITS = 96 };
  bool loose = i < o->n && o->word.phase[o->word.n - 1][i] == 's' && o->word.phase[0][i] != 's';
  NUMBERS(arb, x);
  arb_set(x, o->state + i);
  if (loose && arb_is_exact(x)) mag_set_ui_2exp_si(arb_radref(x), 1, arf_abs_bound_lt_2exp_si(arb_midref(x)) - BITS);
  wide_ball_json(j, NULL, x);
}

static void enclosures_json(struct json *j, const struct mech_orbit *o) {
  JSON_OBJECT(j, "enclosures");
  balls_json(j, "times", o->t, o->word.n, true);
  json_array(j, "start");
  for (int i = 0; i < 2 * o->n; i++) start_json(j, o, i);
  if (o->turns) wide_ball_json(j, NULL, o->angle);
  json_end_array(j);
  wide_ball_json(j, "period", o->period);
  JSON_EACH (j, "multipliers", i, o->n_free)
    multiplier_json(j, acb_realref(o->multiplier + i), acb_imagref(o->multiplier + i));
}

/* "y" for each mass that keeps Coulomb's law and clear of its obstacles along a phase, "n" for others. */
static void kept_json(struct json *j, const struct mech_orbit *o) {
  JSON_EACH (j, "kept", k, o->word.n) {
    char kept[MECH_MASSES + 1] = "";
    memset(kept, 'y', (size_t)o->n);
    for (int i = 0; i < o->n_facts; i++)
      if (o->fact[i].phase == k && o->fact[i].holds == TRUTH_FALSE) kept[o->fact[i].mass] = 'n';
    json_string(j, NULL, kept);
  }
}

static void orbit_json(struct json *j, const struct mech_orbit *o) {
  JSON_OBJECT(j, NULL);
  mech_word_json(j, &o->word);
  if (o->turns) json_printf(j, "turns", "%ld", (long)o->turns);
  json_object(j, "box");
  balls_json(j, "times", o->box, o->word.n, false);
  balls_json(j, "free", o->box + o->word.n, o->n_free, false);
  json_end_object(j);
  enclosures_json(j, o);
  kept_json(j, o);
  verdicts_json(j, o->stable, o->admissible);
}

void mech_certificates_json(struct text *out, const char *scene, const struct mech *m, const struct mech_orbits *list) {
  OWNED(json) j = begin(out, scene, m, NULL);
  JSON_EACH (&j, "orbits", i, list->n)
    if (list->orbit[i].certified) orbit_json(&j, &list->orbit[i]);
}

/* --- Orbits of the paper's word: sliding friction is in no equation, and e1 and e2 are the excesses --- */

static void paper_balls_json(struct json *j, const char *key, arb_srcptr const *x, int n) {
  JSON_EACH (j, key, i, n) wide_ball_json(j, NULL, x[i]);
}

/* Some of the quantities: a given one exactly, of the others the balls. */
static void box_of(struct json *j, const char *key, int first, int n, const struct dyn_question *q,
                   const struct dyn_certificate *z) {
  JSON_EACH (j, key, i, n) {
    const fmpq *given = NULL;
    for (int k = 0; k < 2; k++)
      if ((int)q->which[k] == first + i) given = q->value + k;
    if (given)
      fraction_json(j, NULL, given);
    else
      ball_json(j, NULL, z->box[first + i]);
  }
}

static void paper_box_json(struct json *j, const struct dyn_question *q, const struct dyn_certificate *z) {
  JSON_OBJECT(j, "box");
  box_of(j, "times", QUANTITY_TA, N_PHASES, q, z);
  json_array(j, "free");
  ball_json(j, NULL, z->box_z10);
  ball_json(j, NULL, z->box_z20);
  json_end_array(j);
  box_of(j, "excess", QUANTITY_E1, 2, q, z);
}

/* V, and the multiplier 0 beside the trace (the stick phase forgets all but z_2 - z_1), are told to as many bits as the
   period; the least static limits, which a checker finds by halving phases, to at most FOUND. */
static void paper_enclosures_json(struct json *j, const struct dyn_question *q, const struct dyn_orbit *o) {
  enum { FOUND = 256 };
  slong bits = FLINT_MAX(arb_rel_accuracy_bits(o->period), DYN_CERTIFY_FIRST);
  NUMBERS(arb, V, zero, real, u_r1, u_r2);
  arb_set_fmpq(V, q->model + P_V, bits);
  arb_add_error_2exp_si(zero, -bits);
  arb_set_round(u_r1, o->u_r1_min, FOUND);
  arb_set_round(u_r2, o->u_r2_min, FOUND);
  JSON_OBJECT(j, "enclosures");
  paper_balls_json(j, "times", (arb_srcptr[]){o->t[PHASE_D], o->t[PHASE_GAMMA], o->t[PHASE_H], o->t[PHASE_C]},
                   N_PHASES);
  paper_balls_json(j, "start", (arb_srcptr[]){o->z10, o->z20, V, V}, 4);
  paper_balls_json(j, "excess", (arb_srcptr[]){o->e1, o->e2}, 2);
  wide_ball_json(j, "period", o->period);
  json_array(j, "multipliers");
  multiplier_json(j, o->trace, real);
  multiplier_json(j, zero, real);
  json_end_array(j);
  paper_balls_json(j, "static", (arb_srcptr[]){u_r1, u_r2}, 2);
}

/* What is asked of each mass in each phase: of m1 in phase D w < e1, which is t_a > 0. */
static const int condition[N_PHASES][2] = {
    [PHASE_D] = {COND_TA, COND_D_R},
    [PHASE_GAMMA] = {COND_GAMMA_V1, COND_GAMMA_R},
    [PHASE_H] = {COND_H_V1, COND_H_V2},
    [PHASE_C] = {COND_C_W, COND_C_V2},
};

static void paper_orbit_json(struct json *j, const struct dyn_question *q, const struct dyn_orbit *o,
                             const struct dyn_certificate *z) {
  static const char *const word[N_PHASES] = {"ss", "-s", "--", "s-"};
  JSON_OBJECT(j, NULL);
  json_string_array(j, "word", word, N_PHASES);
  paper_box_json(j, q, z);
  paper_enclosures_json(j, q, o);
  JSON_EACH (j, "kept", k, N_PHASES)
    json_printf(j, NULL, "%s%s", z->holds[condition[k][0]] == TRUTH_TRUE ? "y" : "n",
                z->holds[condition[k][1]] == TRUTH_TRUE ? "y" : "n");
  verdicts_json(j, z->stable, z->admissible);
}

void two_masses_certificates_json(struct text *out, const char *scene, const struct dyn_question *q,
                                  const struct dyn_orbits *list, const struct dyn_certificate *proof) {
  const fmpq *chi = q->model + P_CHI, *eta = q->model + P_ETA, *V = q->model + P_V;
  const fmpq params[N_PARAMS] = {*chi, *eta, *V, *V, *V}; /* borrowed; no friction of it is written */
  OWNED(mech) m;
  two_masses(&m, params, (const fmpq *const[]){NULL, NULL});
  OWNED(json) j = begin(out, scene, &m, q->u_r);
  JSON_EACH (&j, "orbits", i, list->n)
    if (proof[i].certified) paper_orbit_json(&j, q, &list->orbit[i], &proof[i]);
}
