/* stickslip orbit and jacobian on a scene that names another word than the paper's. */
#include "word_orbits.h"

#include <string.h>

enum { SIMULATIONS = 32 };

slong word_bits(slong digits) {
  return (slong)((double)digits * 3.33) + 32;
}

slong system_bits(slong digits) {
  return word_bits(digits) + 64;
}

/* --- Numbers. --- */

static void find_radius(mag_t radius, const struct word_orbit *o) {
  mag_zero(radius);
  radius_raise(radius, o->t, o->word.n);
  radius_raise(radius, o->state, N_STATE * o->word.n);
  radius_raise(radius, o->jacobian->entries, o->n_free * o->n_free);
}

static void violation(struct text *out, const struct word_orbit *o, const struct mech_fact *c) {
  text_printf(out, "%d-%s-", c->phase + 1, phase_word_name(o->word.mode[c->phase]));
  if (c->rule != MECH_LENGTH) text_printf(out, "m%d-", c->mass + 1);
  text_add(out, mech_rule_name[c->rule]);
}

/* "a+bi" where it is not real. */
static void add_eigenvalue(struct text *out, const acb_struct *z, slong digits) {
  size_t begin = out->len;
  bool real = arb_is_zero(acb_imagref(z));
  if (real || !arb_contains_zero(acb_realref(z))) print_known(out, acb_realref(z), digits);
  if (real) return;
  if (out->len > begin && arb_is_positive(acb_imagref(z))) text_add_char(out, '+');
  print_known(out, acb_imagref(z), digits);
  text_add_char(out, 'i');
}

/* --- One orbit. --- */

void json_word(struct json *j, const char *key, const struct phase_word *w) {
  json_begin_string(j, key);
  phase_word_print(j->out, w);
  json_end_string(j);
}

void return_json(struct json *j, const arb_mat_t x, slong digits) {
  json_array(j, "J");
  for (slong i = 0; i < arb_mat_nrows(x); i++) json_numbers(j, NULL, arb_mat_entry(x, i, 0), arb_mat_ncols(x), digits);
  json_end_array(j);
}

void return_text(struct text *out, const arb_mat_t x, slong digits) {
  for (slong i = 0; i < arb_mat_nrows(x); i++) {
    for (slong k = 0; k < arb_mat_ncols(x); k++) {
      text_add(out, "  ");
      print_known(out, arb_mat_entry(x, i, k), digits);
    }
    text_add_char(out, '\n');
  }
}

static void word_json(struct json *j, const struct word_orbit *o) {
  json_array(j, "word");
  for (int p = 0; p < o->word.n; p++) json_string(j, NULL, phase_word_name(o->word.mode[p]));
  json_end_array(j);
}

static void free_json(struct json *j, const struct word_orbit *o) {
  json_array(j, "free");
  for (int i = 0; i < o->n_free; i++) json_string(j, NULL, word_coordinate_name[o->free[i]]);
  json_end_array(j);
}

static void eigenvalues_json(struct json *j, const arb_mat_t x, slong digits) {
  slong n = arb_mat_nrows(x);
  acb_ptr z = _acb_vec_init(n);
  if (mech_eigenvalues(z, x, 2 * word_bits(digits))) {
    json_array(j, "eigenvalues");
    for (slong i = 0; i < n; i++) {
      json_begin_string(j, NULL);
      add_eigenvalue(j->out, z + i, digits);
      json_end_string(j);
    }
    json_end_array(j);
  } else {
    json_null(j, "eigenvalues");
  }
  _acb_vec_clear(z, n);
}

void word_orbit_json(struct json *j, const struct word_orbit *o, slong digits) {
  mag_t radius;
  mag_init(radius);
  find_radius(radius, o);
  json_object(j, NULL);
  word_json(j, o);
  json_numbers(j, "times", o->t, o->word.n, digits);
  json_number(j, "period", o->period, digits);
  json_object(j, "start");
  for (int i = 0; i < N_STATE; i++) json_number(j, word_coordinate_name[i], o->state + i, digits);
  json_end_object(j);
  free_json(j, o);
  return_json(j, o->jacobian, digits);
  json_number(j, "trace", o->trace, digits);
  json_number(j, "det", o->det, digits);
  eigenvalues_json(j, o->jacobian, digits);
  json_truth(j, "stable", o->stable);
  json_truth(j, "admissible", o->admissible);
  json_array(j, "violations");
  for (int i = 0; i < o->n_conditions; i++) {
    if (o->condition[i].holds != TRUTH_FALSE) continue;
    json_begin_string(j, NULL);
    violation(j->out, o, &o->condition[i]);
    json_end_string(j);
  }
  json_end_array(j);
  static const char *const least[2] = {"u_r1_min", "u_r2_min"};
  for (int i = 0; i < 2; i++) {
    if (phase_word_has_faster(&o->word))
      json_null(j, least[i]);
    else
      json_number(j, least[i], o->u_r_min[i], digits);
  }
  proof_json(j, o->certified, radius);
  json_end_object(j);
  mag_clear(radius);
}

static void eigenvalues_text(struct text *out, const arb_mat_t x, slong digits) {
  slong n = arb_mat_nrows(x);
  acb_ptr z = _acb_vec_init(n);
  bool known = mech_eigenvalues(z, x, 2 * word_bits(digits));
  text_add(out, "  eigenvalues ");
  for (slong i = 0; known && i < n; i++) {
    text_add(out, i ? ", " : "");
    add_eigenvalue(out, z + i, digits);
  }
  text_add(out, known ? "\n" : "not told apart\n");
  _acb_vec_clear(z, n);
}

/* One orbit as lines. */
static void word_orbit_text(struct text *out, const struct word_orbit *o, long number, const struct scene *s,
                            slong digits) {
  mag_t radius;
  mag_init(radius);
  text_printf(out, "orbit %ld: %s, ", number, stability_name[o->stable]);
  admissible_text(out, o->admissible, s);
  text_add_char(out, '\n');
  for (int p = 0; p < o->word.n; p++) {
    char name[24];
    snprintf(name, sizeof name, "t_%d %s", p + 1, phase_word_name(o->word.mode[p]));
    print_named(out, 10, name, o->t + p, digits);
  }
  print_named(out, 10, "period", o->period, digits);
  for (int i = 0; i < N_STATE; i++) print_named(out, 10, word_coordinate_name[i], o->state + i, digits);
  for (int i = 0; i < 2 && !phase_word_has_faster(&o->word); i++)
    print_named(out, 10, i ? "u_r2_min" : "u_r1_min", o->u_r_min[i], digits);
  eigenvalues_text(out, o->jacobian, digits);
  find_radius(radius, o);
  proof_text(out, o->certified, radius);
  for (int i = 0; i < o->n_conditions; i++) {
    if (o->condition[i].holds != TRUTH_FALSE) continue;
    text_add(out, "  breaks   ");
    violation(out, o, &o->condition[i]);
    text_add_char(out, '\n');
  }
  mag_clear(radius);
}

/* --- orbit --- */

static const char not_complete[] = "no proof of completeness covers this word";

static void orbits_json(struct text *out, const struct word_orbits *list, enum word_fate fate, const char *why,
                        const struct scene *s, slong digits) {
  struct json j;
  bool complete = fate == WORD_IMPOSSIBLE || fate == WORD_UNCLOSED;
  json_of_model(&j, out, s);
  json_word(&j, "word", &s->word);
  json_string(&j, "fate", word_fate_name[fate]);
  json_string(&j, "reason", fate == WORD_OPEN ? NULL : why);
  json_bool(&j, "complete", complete);
  json_string(&j, "gap", complete ? NULL : not_complete);
  json_array(&j, "orbits");
  for (slong i = 0; i < list->n; i++) word_orbit_json(&j, &list->orbit[i], digits);
  json_end_array(&j);
  json_end_object(&j);
}

static void orbits_text(struct text *out, const struct word_orbits *list, enum word_fate fate, const char *why,
                        const struct scene *s, slong digits) {
  text_printf(out, "%s: %ld orbit%s of the word ", s->name, (long)list->n, list->n == 1 ? "" : "s");
  phase_word_print(out, &s->word);
  text_add(out, " found\n");
  if (fate == WORD_IMPOSSIBLE || fate == WORD_UNCLOSED)
    text_printf(out, "there is none: %s\n", why);
  else if (fate != WORD_OPEN)
    text_printf(out, "none searched for: %s\n", why);
  else
    text_printf(out, "not proved complete: %s; %ld evaluations, %ld starts of Newton's iteration\n", not_complete,
                list->evaluations, list->candidates);
  if (list->failed > 0) text_printf(out, "%ld solutions in double precision could not be enclosed\n", list->failed);
  for (slong i = 0; i < list->n; i++) word_orbit_text(out, &list->orbit[i], (long)i + 1, s, digits);
}

/* The orbits of the scene's word; false with d set when the scene lacks what they need. */
static bool find_orbits(struct word_orbits *list, const struct scene *s, slong digits, struct diag *d) {
  const fmpq *u_r[2];
  struct word_seeds seeds;
  *list = (struct word_orbits){.n = 0};
  if (phase_word_fate(NULL, &s->word) != WORD_OPEN) return true;
  scene_static_friction(u_r, s);
  if (phase_word_has_faster(&s->word) && (!u_r[0] || !u_r[1])) {
    diag_set(d, "%s: error: a word in which a mass is faster than the belt needs u_r1 and u_r2", s->path);
    return false;
  }
  word_seeds_find(&seeds, s->value, u_r, SIMULATIONS);
  if (word_orbits_find(list, &s->word, s->value, u_r, &seeds, word_bits(digits)) != SS_OK)
    abort(); /* the scene is in the domain, and has the friction that the word needs */
  word_seeds_clear(&seeds);
  return true;
}

static bool check_digits(slong digits, const struct scene *s, struct diag *d) {
  if (digits <= WORD_DIGITS) return true;
  diag_set(d, "%s: error: a scene of another word takes at most %d --digits", s->path, WORD_DIGITS);
  return false;
}

/* The orbits as those of a system; static friction that the scene leaves open is stated in the file. */
static bool certify(const char *path, const struct word_orbits *list, const struct scene *s, slong digits,
                    struct diag *d) {
  const fmpq *u_r[2];
  struct mech m;
  struct mech_orbits same;
  scene_static_friction(u_r, s);
  word_orbits_as_system(&m, &same, list, s->value, u_r, system_bits(digits));
  bool ok = write_system_certificate(path, &same, list->n, &m, s, d);
  mech_orbits_clear(&same);
  mech_clear(&m);
  return ok;
}

int run_word_orbit(const struct options *o, const struct scene *s, slong digits, struct diag *d) {
  struct word_orbits list = {.n = 0};
  const char *certificate = option(o, OPT_CERTIFICATE);
  if (option(o, OPT_BASIN))
    diag_set(d, "%s: error: --basin is of the word D-Gamma-H-C, and the scene names another", s->path);
  if (d->set || !check_digits(digits, s, d) || !find_orbits(&list, s, digits, d)) return EXIT_INPUT;
  if (certificate && !certify(certificate, &list, s, digits, d)) {
    word_orbits_clear(&list);
    return EXIT_INPUT;
  }
  struct text out = {0}, why = {0};
  enum word_fate fate = phase_word_fate(&why, &s->word);
  (option(o, OPT_JSON) ? orbits_json : orbits_text)(&out, &list, fate, text_str(&why), s, digits);
  print_found(o, &out);
  text_clear(&why);
  text_clear(&out);
  word_orbits_clear(&list);
  if (certificate) say_written(o, certificate);
  return EXIT_AS_RECORDED;
}

/* --- jacobian --- */

bool return_route(enum mech_derivative *how, const struct jacobian_request *q, const struct scene *s, struct diag *d) {
  static const struct {
    enum jacobian_method method;
    enum mech_derivative how;
  } known[] = {{METHOD_IMPLICIT, MECH_IMPLICIT},
               {METHOD_SALTATION, MECH_SALTATION},
               {METHOD_FD_DOUBLE, MECH_BESIDE_PATCHED},
               {METHOD_ODE, MECH_BESIDE_INTEGRATED}};
  for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
    *how = known[i].how;
    if (known[i].method == q->method) return true;
  }
  diag_set(d, "%s: error: --method %s is of the paper's word; here it is implicit, saltation, fd-double or ode",
           s->path, method_name[q->method]);
  return false;
}

void return_unknown(struct diag *d, const struct jacobian_request *q, const struct scene *s) {
  bool simulated = q->method == METHOD_FD_DOUBLE || q->method == METHOD_ODE;
  diag_set(d, "%s: error: --method %s has no value: %s", s->path, method_name[q->method],
           simulated ? "a simulation beside the orbit does not follow the word"
                     : "the orbit could not be enclosed again");
}

static void show_matrix(const struct word_orbit *o, const arb_mat_t x, const struct scene *s,
                        const struct jacobian_request *q, bool as_json) {
  struct text out = {0};
  struct json j;
  if (as_json) {
    json_init(&j, &out);
    json_object(&j, NULL);
    word_json(&j, o);
    free_json(&j, o);
    return_json(&j, x, q->digits);
    eigenvalues_json(&j, x, q->digits);
    json_string(&j, "method", method_name[q->method]);
    json_string(&j, "layer", "model");
    json_at(&j, q);
    json_end_object(&j);
  } else {
    text_printf(&out, "%s, ", s->name);
    print_at(&out, q);
    text_printf(&out, ", method %s, layer model: the return of", method_name[q->method]);
    for (int i = 0; i < o->n_free; i++) text_printf(&out, " %s", word_coordinate_name[o->free[i]]);
    text_printf(&out, " at the start of %s\n", phase_word_name(o->word.mode[0]));
    return_text(&out, x, q->digits);
    eigenvalues_text(&out, x, q->digits);
  }
  fputs(text_str(&out), stdout);
  text_clear(&out);
}

static void show_jacobian(const struct options *o, const struct word_orbit *orbit, const struct scene *s,
                          const struct jacobian_request *q, enum mech_derivative how, struct diag *d) {
  const fmpq *u_r[2];
  arb_mat_t x;
  arb_mat_init(x, orbit->n_free, orbit->n_free);
  scene_static_friction(u_r, s);
  if (word_jacobian(x, orbit, s->value, u_r, how, 2 * word_bits(q->digits)))
    return_unknown(d, q, s);
  else
    show_matrix(orbit, x, s, q, option(o, OPT_JSON));
  arb_mat_clear(x);
}

int run_word_jacobian(const struct options *o, const struct scene *s, const struct jacobian_request *asked,
                      struct diag *d) {
  struct jacobian_request q = *asked;
  struct word_orbits list = {.n = 0};
  enum mech_derivative how;
  if (!option(o, OPT_METHOD)) q.method = METHOD_SALTATION;
  if (option(o, OPT_PHASES) || q.at_printed || option(o, OPT_LAYER)) {
    diag_set(d, "%s: error: %s is of the word D-Gamma-H-C, and the scene names another", s->path,
             option(o, OPT_PHASES) ? "--phases"
             : q.at_printed        ? "--at printed"
                                   : "--layer");
  }
  if (d->set || !return_route(&how, &q, s, d) || !check_digits(q.digits, s, d) || !find_orbits(&list, s, q.digits, d))
    return EXIT_INPUT;
  if (q.orbit < list.n)
    show_jacobian(o, &list.orbit[q.orbit], s, &q, how, d);
  else
    scene_lacks_orbit(s, q.orbit, list.n, d);
  word_orbits_clear(&list);
  return EXIT_AS_RECORDED;
}
