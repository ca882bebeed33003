/* stickslip system, and orbit on a scene that names a system file. */
#include "cli.h"
#include "mech/describe.h"
#include "mech/orbit.h"
#include "word_orbits.h"

enum { MODE_DIGITS = 6 };

int run_system(const struct options *o, const char *data) {
  (void)data;
  if (o->operands.n != 1) return usage("system takes one %s", "FILE");
  struct mech m;
  struct diag d;
  diag_init(&d);
  bool ok = mech_load(&m, o->operands.word[0], &d);
  if (ok) {
    struct text out;
    text_init(&out);
    mech_describe(&out, &m, option(o, OPT_TEX), MODE_DIGITS);
    fputs(text_str(&out), stdout);
    text_clear(&out);
  }
  mech_clear(&m);
  return ok ? EXIT_AS_RECORDED : bad_input(&d);
}

/* --- Orbits --- */

static const char not_complete[] = "orbits are those that simulated motions come near; there may be others";

static void multipliers_json(struct json *j, const struct mech_orbit *o, slong digits) {
  if (!o->multipliers) {
    json_null(j, "multipliers");
    return;
  }
  json_array(j, "multipliers");
  for (int i = 0; i < o->n_free; i++) {
    json_object(j, NULL);
    json_number(j, "re", acb_realref(o->multiplier + i), digits);
    json_number(j, "im", acb_imagref(o->multiplier + i), digits);
    json_end_object(j);
  }
  json_end_array(j);
}

static void states_json(struct json *j, const struct mech_orbit *o, slong digits) {
  json_array(j, "states");
  for (int k = 0; k < o->word.n; k++) {
    json_array(j, NULL);
    for (int i = 0; i < 2 * o->n; i++) json_number(j, NULL, o->state + k * o->states + i, digits);
    json_end_array(j);
  }
  json_end_array(j);
}

/* The largest radius of the lengths and states. */
static void radius_of(struct text *out, const struct mech_orbit *o) {
  arb_t worst;
  arb_init(worst);
  for (int k = 0; k < o->word.n; k++) mag_max(arb_radref(worst), arb_radref(worst), arb_radref(o->t + k));
  for (int i = 0; i < o->word.n * o->states; i++)
    mag_max(arb_radref(worst), arb_radref(worst), arb_radref(o->state + i));
  arb_get_rad_arb(worst, worst);
  print_accuracy(out, worst);
  arb_clear(worst);
}

static void orbit_json(struct json *j, const struct mech_orbit *o, const struct mech *m, const char *system,
                       slong digits) {
  struct text t;
  text_init(&t);
  json_object(j, NULL);
  json_string(j, "system", system);
  json_array(j, "word");
  for (int k = 0; k < o->word.n; k++) json_string(j, NULL, o->word.phase[k]);
  json_end_array(j);
  json_array(j, "times");
  for (int k = 0; k < o->word.n; k++) json_number(j, NULL, o->t + k, digits);
  json_end_array(j);
  states_json(j, o, digits);
  json_number(j, "period", o->period, digits);
  if (o->turns) {
    json_number(j, "load_angle", o->angle, digits);
    json_long(j, "load_turns", o->turns);
  }
  multipliers_json(j, o, digits);
  json_truth(j, "stable", o->stable);
  json_truth(j, "admissible", o->admissible);
  json_array(j, "violations");
  for (int i = 0; i < o->n_facts; i++) {
    if (o->fact[i].holds != TRUTH_FALSE) continue;
    text_reset(&t);
    mech_fact_print(&t, m, &o->fact[i]);
    json_string(j, NULL, text_str(&t));
  }
  json_end_array(j);
  json_bool(j, "certified", o->certified);
  text_reset(&t);
  if (o->certified) radius_of(&t, o);
  json_string(j, "radius", o->certified ? text_str(&t) : NULL);
  json_end_object(j);
  text_clear(&t);
}

static void orbits_json(struct text *out, const struct mech_orbits *list, const struct mech *m, const struct scene *s,
                        slong digits) {
  struct json j;
  json_init(&j, out);
  json_object(&j, NULL);
  json_string(&j, "scene", s->name);
  json_string(&j, "layer", "model");
  json_bool(&j, "complete", false);
  json_string(&j, "gap", not_complete);
  json_array(&j, "orbits");
  for (int i = 0; i < list->n; i++) orbit_json(&j, &list->orbit[i], m, s->system, digits);
  json_end_array(&j);
  json_end_object(&j);
}

static void add_line(struct text *out, const char *name, arb_srcptr x, slong digits) {
  text_printf(out, "  %-12s ", name);
  print_known(out, x, digits);
  text_add_char(out, '\n');
}

static void multipliers_text(struct text *out, const struct mech_orbit *o, slong digits) {
  text_add(out, "  multipliers ");
  for (int i = 0; o->multipliers && i < o->n_free; i++) {
    text_add(out, i ? ", " : " ");
    print_known(out, acb_realref(o->multiplier + i), digits);
    if (arb_is_zero(acb_imagref(o->multiplier + i))) continue;
    text_add(out, arb_is_negative(acb_imagref(o->multiplier + i)) ? " " : " +");
    print_known(out, acb_imagref(o->multiplier + i), digits);
    text_add(out, " i");
  }
  text_add(out, o->multipliers ? "\n" : " not told apart\n");
}

static void orbit_text(struct text *out, const struct mech_orbit *o, const struct mech *m, slong digits) {
  static const char *const fate[] = {"unstable", "conditionally stable", "stability undecided"},
                           *const allowed[] = {"not admissible", "admissible", "admissibility undecided"};
  text_printf(out, "%s, %s\n", fate[o->stable], allowed[o->admissible]);
  for (int k = 0; k < o->word.n; k++) {
    char name[MECH_PHASE + 16];
    snprintf(name, sizeof name, "t_%d %s", k + 1, o->word.phase[k]);
    add_line(out, name, o->t + k, digits);
  }
  add_line(out, "period", o->period, digits);
  for (int i = 0; i < 2 * o->n; i++) {
    char name[24];
    snprintf(name, sizeof name, "x_%d%s", i % o->n + 1, i < o->n ? "" : "'");
    add_line(out, name, o->state + i, digits);
  }
  if (o->turns) add_line(out, "load angle", o->angle, digits);
  if (o->turns) text_printf(out, "  %-12s %ld\n", "load turns", (long)o->turns);
  multipliers_text(out, o, digits);
  text_add(out, o->certified ? "  certified; enclosed within "
                             : "  not certified: a condition or the stability is undecided");
  if (o->certified) radius_of(out, o);
  text_add(out, o->certified ? ", printed rounded\n" : "\n");
  for (int i = 0; i < o->n_facts; i++) {
    if (o->fact[i].holds != TRUTH_FALSE) continue;
    text_add(out, "  breaks       ");
    mech_fact_print(out, m, &o->fact[i]);
    text_add_char(out, '\n');
  }
}

static void orbits_text(struct text *out, const struct mech_orbits *list, const struct mech *m, const struct scene *s,
                        slong digits) {
  text_printf(out, "%s: %d orbit%s of the system %s found\n", s->name, list->n, list->n == 1 ? "" : "s", s->system);
  text_printf(out, "not proved complete: %s (%d motions, %d starts of Newton's iteration, %d without an orbit)\n",
              not_complete, list->simulations, list->candidates, list->failed);
  if (list->unfinished)
    text_printf(out, "%d of these motions were given up: too many steps, or numbers out of the range of a double\n",
                list->unfinished);
  for (int i = 0; i < list->n; i++) {
    text_printf(out, "orbit %d: ", i + 1);
    orbit_text(out, &list->orbit[i], m, digits);
  }
}

static bool write_certificate(const char *path, const struct mech_orbits *list, const struct mech *m,
                              const struct scene *s, struct diag *d) {
  if (!may_write_certificate(s, mech_orbits_certified(list), list->n, d)) return false;
  struct text out;
  text_init(&out);
  mech_certificates_json(&out, s->name, m, list);
  bool written = file_write(path, out.data, out.len, d);
  text_clear(&out);
  return written;
}

static void print_orbits(const struct options *o, const struct mech_orbits *list, const struct mech *m,
                         const struct scene *s, slong digits) {
  struct text out;
  text_init(&out);
  (option(o, OPT_JSON) ? orbits_json : orbits_text)(&out, list, m, s, digits);
  print_found(o, &out);
  text_clear(&out);
}

int run_system_orbit(const struct options *o, const struct scene *s, const char *data, slong digits, struct diag *d) {
  static const enum option of_two[] = {OPT_BASIN, OPT_METHOD};
  const char *certificate = option(o, OPT_CERTIFICATE);
  struct mech m;
  struct mech_word w;
  struct mech_orbits list;
  for (size_t i = 0; i < sizeof of_two / sizeof *of_two; i++)
    if (option(o, of_two[i])) {
      diag_set(d, "%s: error: --basin and --method are of the paper's two masses", s->path);
      return bad_input(d);
    }
  if (digits > WORD_DIGITS) {
    diag_set(d, "%s: error: a scene of a system file takes at most %d --digits", s->path, WORD_DIGITS);
    return bad_input(d);
  }
  bool ok = scene_load_system(&m, &w, s, data, d);
  if (ok) {
    mech_orbits_find(&list, &m, w.n ? &w : NULL, false, word_bits(digits) + 64);
    ok = !certificate || write_certificate(certificate, &list, &m, s, d);
    if (ok) print_orbits(o, &list, &m, s, digits);
    mech_orbits_clear(&list);
  }
  mech_clear(&m);
  return ok ? EXIT_AS_RECORDED : bad_input(d);
}
