/* The certificates of a scene's orbits as one file: rationals exactly, balls in Arb's lossless text form.

   Nothing is computed here. */
#include "certify.h"
#include "num/exact_json.h"

static const char *const friction_name[2] = {"u_r1", "u_r2"};

static void given_json(struct json *j, const struct dyn_question *q) {
  static const char *const model[3] = {"chi", "eta", "V"};
  JSON_OBJECT(j, "given");
  for (int i = 0; i < 3; i++) json_fraction(j, model[i], q->model + i);
  for (int i = 0; i < 2; i++) json_fraction(j, dyn_quantity_id[q->which[i]], q->value + i);
  for (int i = 0; i < 2; i++)
    if (q->u_r[i]) json_fraction(j, friction_name[i], q->u_r[i]);
}

static void box_json(struct json *j, const struct dyn_question *q, const struct dyn_certificate *z) {
  JSON_OBJECT(j, "box");
  json_ball(j, "z10", z->box_z10);
  json_ball(j, "z20", z->box_z20);
  for (int i = 0; i < N_QUANTITIES; i++)
    if (i != (int)q->which[0] && i != (int)q->which[1]) json_ball(j, dyn_quantity_id[i], z->box[i]);
}

static void enclosures_json(struct json *j, const struct dyn_orbit *o) {
  JSON_OBJECT(j, "enclosures");
  json_wide_ball(j, "z10", o->z10);
  json_wide_ball(j, "z20", o->z20);
  json_wide_ball(j, "e1", o->e1);
  json_wide_ball(j, "e2", o->e2);
  for (int i = 0; i < N_PHASES; i++) json_wide_ball(j, dyn_quantity_id[QUANTITY_TA + i], o->t[i]);
  json_wide_ball(j, "period", o->period);
  json_wide_ball(j, "trace", o->trace);
  json_wide_ball(j, "margin", o->margin);
  json_wide_ball(j, "u_r1_min", o->u_r1_min);
  json_wide_ball(j, "u_r2_min", o->u_r2_min);
}

static void condition_json(struct json *j, const struct dyn_certificate *z, int i) {
  JSON_OBJECT(j, dyn_condition_id[i]);
  json_bool(j, "holds", z->holds[i] == TRUTH_TRUE);
  if (z->holds[i] == TRUTH_FALSE && z->where[i] == WHERE_INSIDE)
    json_ball(j, "broken_at", z->breach[i]);
  else if (z->holds[i] == TRUTH_FALSE)
    json_string(j, "broken_at", dyn_where_name[z->where[i]]);
}

static void conditions_json(struct json *j, const struct dyn_question *q, const struct dyn_certificate *z) {
  JSON_OBJECT(j, "conditions");
  for (int i = 0; i < N_CONDITIONS; i++) condition_json(j, z, i);
  for (int i = 0; i < 2; i++) {
    if (!q->u_r[i]) continue;
    JSON_OBJECT(j, friction_name[i]);
    json_bool(j, "holds", z->u_r[i] == TRUTH_TRUE);
  }
}

static void orbit_json(struct json *j, const struct dyn_question *q, const struct dyn_orbit *o,
                       const struct dyn_certificate *z) {
  JSON_OBJECT(j, NULL);
  box_json(j, q, z);
  enclosures_json(j, o);
  json_object(j, "first_events");
  for (int i = 0; i < N_PHASES; i++) json_bool(j, phase_name[i], z->first[i] == TRUTH_TRUE);
  json_end_object(j);
  conditions_json(j, q, z);
  json_verdicts(j, z->stable, z->admissible);
}

void dyn_certificates_json(struct text *out, const char *scene, const struct dyn_question *q,
                           const struct dyn_orbits *list, const struct dyn_certificate *proof) {
  OWNED(json) j = json_document(out, NULL);
  json_string(&j, "format", "stickslip orbits of the word D-Gamma-H-C, version 1");
  json_string(&j, "scene", scene);
  given_json(&j, q);
  JSON_EACH (&j, "orbits", i, list->n)
    if (proof[i].certified) orbit_json(&j, q, &list->orbit[i], &proof[i]);
}
