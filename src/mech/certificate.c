/* The certified orbits of a system as one file, which holds the system itself: nothing is computed here. */
#include <string.h>

#include "moments.h"
#include "num/exact_json.h"
#include "orbit.h"

static void mass_json(struct json *j, const struct mech_mass *mass) {
  static const char *const side[2] = {"below", "above"};
  JSON_OBJECT(j, NULL);
  json_string(j, "name", mass->name);
  json_fraction(j, "inertia", mass->inertia);
  if (mass->rubbed) {
    json_fraction(j, "sliding", mass->sliding);
    json_fraction(j, "static", mass->limit);
    json_fraction(j, "surface", mass->surface);
  }
  for (int s = 0; s < 2; s++) {
    if (!mass->stop[s].given) continue;
    JSON_OBJECT(j, side[s]);
    json_fraction(j, "position", mass->stop[s].position);
    json_fraction(j, "restitution", mass->stop[s].restitution);
  }
}

static void links_json(struct json *j, const char *list, const char *size, const struct mech_link *link, int n) {
  JSON_EACH (j, list, l, n) json_link(j, link[l].end[0] + 1, link[l].end[1] + 1, size, link[l].size);
}

static void system_json(struct json *j, const struct mech *m) {
  JSON_OBJECT(j, "system");
  JSON_EACH (j, "masses", i, m->n) mass_json(j, &m->mass[i]);
  links_json(j, "springs", "stiffness", m->spring, m->n_springs);
  links_json(j, "dampers", "constant", m->damper, m->n_dampers);
  JSON_EACH (j, "loads", l, m->n_loads) {
    JSON_OBJECT(j, NULL);
    json_printf(j, "mass", "%d", m->load[l].mass + 1);
    if (m->load[l].order > 1) json_printf(j, "order", "%d", m->load[l].order);
    json_fraction(j, "cosine", m->load[l].cosine);
    json_fraction(j, "sine", m->load[l].sine);
  }
  if (m->n_loads) json_fraction(j, "frequency", m->frequency);
}

static void balls_json(struct json *j, const char *key, arb_srcptr x, int n, bool wide) {
  JSON_EACH (j, key, i, n) (wide ? json_wide_ball : json_ball)(j, NULL, x + i);
}

/* The position of a mass that has just broken loose is its limit over a stiffness: where that is exact it gets a
   radius, since a checker that divides in balls does not meet it. */
static void start_json(struct json *j, const struct mech_orbit *o, int i) {
  enum { BITS = 96 };
  bool loose = i < o->n && o->word.phase[o->word.n - 1][i] == 's' && o->word.phase[0][i] != 's';
  NUMBERS(arb, x);
  arb_set(x, o->state + i);
  if (loose && arb_is_exact(x)) mag_set_ui_2exp_si(arb_radref(x), 1, arf_abs_bound_lt_2exp_si(arb_midref(x)) - BITS);
  json_wide_ball(j, NULL, x);
}

static void enclosures_json(struct json *j, const struct mech_orbit *o) {
  JSON_OBJECT(j, "enclosures");
  balls_json(j, "times", o->t, o->word.n, true);
  json_array(j, "start");
  for (int i = 0; i < 2 * o->n; i++) start_json(j, o, i);
  if (o->turns) json_wide_ball(j, NULL, o->angle);
  json_end_array(j);
  json_wide_ball(j, "period", o->period);
  JSON_EACH (j, "multipliers", i, o->n_free)
    json_multiplier(j, acb_realref(o->multiplier + i), acb_imagref(o->multiplier + i));
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
  json_verdicts(j, o->stable, o->admissible);
}

void mech_certificates_json(struct text *out, const char *scene, const struct mech *m, const struct mech_orbits *list) {
  OWNED(json) j = json_certificate(out, scene);
  system_json(&j, m);
  JSON_EACH (&j, "orbits", i, list->n)
    if (list->orbit[i].certified) orbit_json(&j, &list->orbit[i]);
}
