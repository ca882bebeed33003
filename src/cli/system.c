/* stickslip system; orbit, words and jacobian on a scene that names a system file, orbit and jacobian on one that names
   another word of the two masses: the same orbits, by another search and with other names of phases. */
#include "cli.h"
#include "mech/describe.h"
#include "mech/moments.h"
#include "mech/orbit.h"
#include "word_orbits.h"

enum { MODE_DIGITS = 6 };

int run_system(const struct options *o, const char *data, struct diag *d) {
  OWNED(text) path = {0};
  if (path_has_suffix(o->operands.word[0], ".scene")) {
    diag_set(d, "%.300s: error: a scene; system takes the file that its line \"system: FILE\" names",
             o->operands.word[0]);
    return EXIT_INPUT;
  }
  scene_system_path(&path, o->operands.word[0], data);
  OWNED(mech) m;
  bool ok = mech_load(&m, text_str(&path), d);
  if (ok) {
    struct text out = {0};
    mech_describe(&out, &m, option(o, OPT_TEX), MODE_DIGITS);
    print_text(&out);
  }
  return EXIT_AS_RECORDED;
}

/* --- Orbits --- */

static void refuse_option(struct diag *d, const char *option, const struct scene *s) {
  diag_set(d, "%s: error: %s is of %s", s->path, option,
           s->system ? "the paper's two masses" : "the word D-Gamma-H-C, and the scene names another");
}

static const char not_complete[] = "orbits are those that simulated motions come near; there may be others";

/* z: n multipliers, or NULL. */
static void multipliers_json(struct json *j, acb_srcptr z, int n, slong digits) {
  if (!json_or_null(j, "multipliers", z != NULL)) return;
  JSON_EACH (j, "multipliers", i, n) {
    JSON_OBJECT(j, NULL);
    json_number(j, "re", acb_realref(z + i), digits);
    json_number(j, "im", acb_imagref(z + i), digits);
  }
}

/* The largest radius of the lengths and states. */
static void find_radius(mag_t radius, const struct mech_orbit *o) {
  mag_zero(radius);
  radius_raise(radius, o->t, o->word.n);
  radius_raise(radius, o->state, o->word.n * o->states);
}

/* "s-" in a system file, "C" in another word of the two masses. */
static const char *phase_shown(const struct scene *s, const char *phase) {
  return s->system ? phase : phase_word_name(phase);
}

static void word_shown(struct json *j, const struct mech_orbit *o, const struct scene *s) {
  JSON_EACH (j, "word", k, o->word.n) json_string(j, NULL, phase_shown(s, o->word.phase[k]));
}

static void violation(struct text *out, const struct mech_fact *f, const struct mech_orbit *o, const struct mech *m,
                      const struct scene *s) {
  mech_fact_print(out, m, f, s->system ? NULL : phase_word_name(o->word.phase[f->phase]));
}

static const char *const friction_name[2] = {"u_r1_min", "u_r2_min"};

static void range_json(struct json *j, const char *key, const arb_struct *x, slong digits) {
  JSON_EACH (j, key, end, 2) JSON_STRING(j, NULL, add_end(j->out, x, end, digits));
}

static void ranges_json(struct json *j, const char *key, arb_srcptr x, int n, slong digits) {
  JSON_EACH (j, key, i, n) range_json(j, NULL, x + i, digits);
}

/* What holds over the box: the orbit's numbers, and what is true in a part of it alone. */
static void over_box_json(struct json *j, const struct mech_orbit *o, const struct mech *m, const struct scene *s,
                          slong digits) {
  const struct mech_orbit *over = o->over;
  json_truth(j, "of_word", o->own);
  if (json_or_null(j, "enclosures", over != NULL)) {
    JSON_OBJECT(j, "enclosures");
    ranges_json(j, "times", over->t, o->word.n, digits);
    JSON_EACH (j, "states", k, o->word.n) ranges_json(j, NULL, over->state + k * o->states, 2 * o->n, digits);
    range_json(j, "period", over->period, digits);
    if (o->turns) range_json(j, "load_angle", over->angle, digits);
    JSON_EACH (j, "multipliers", i, over->multipliers ? o->n_free : 0) {
      JSON_OBJECT(j, NULL);
      range_json(j, "re", acb_realref(over->multiplier + i), digits);
      range_json(j, "im", acb_imagref(over->multiplier + i), digits);
    }
  }
  json_array(j, "changes");
  if (o->changes) json_string(j, NULL, "stable");
  for (int i = 0; i < o->n_facts; i++)
    if (o->fact[i].changes) JSON_STRING(j, NULL, violation(j->out, &o->fact[i], o, m, s));
  json_end_array(j);
}

static void box_json(struct json *j, const struct mech_given *interval, slong digits) {
  JSON_OBJECT(j, "box");
  for (; interval; interval = interval->next)
    JSON_EACH (j, interval->name, end, 2)
      JSON_STRING(j, NULL, add_box_end(j->out, end ? interval->high : interval->low, end, digits));
}

void proved_orbit_json(struct json *j, const struct mech_orbit *o, const struct mech *m, const struct scene *s,
                       slong digits) {
  NUMBERS(mag, radius);
  NUMBERS(arb, least);
  find_radius(radius, o);
  JSON_OBJECT(j, NULL);
  if (s->system) json_string(j, "system", s->system);
  word_shown(j, o, s);
  json_numbers(j, "times", o->t, o->word.n, digits);
  JSON_EACH (j, "states", k, o->word.n) json_numbers(j, NULL, o->state + k * o->states, 2 * o->n, digits);
  json_number(j, "period", o->period, digits);
  if (o->turns) {
    json_number(j, "load_angle", o->angle, digits);
    json_long(j, "load_turns", o->turns);
  }
  multipliers_json(j, o->multipliers ? o->multiplier : NULL, o->n_free, digits);
  json_truth(j, "stable", o->stable);
  json_truth(j, "admissible", o->admissible);
  JSON_EACH (j, "violations", i, o->n_facts) {
    if (o->fact[i].holds != TRUTH_FALSE) continue;
    JSON_STRING(j, NULL, violation(j->out, &o->fact[i], o, m, s));
  }
  for (int i = 0; i < 2 && !s->system; i++)
    json_number(j, friction_name[i], word_orbit_friction(least, o, m, i, system_bits(digits)) ? least : NULL, digits);
  proof_json(j, o->certified, radius);
  if (o->pieces) over_box_json(j, o, m, s, digits);
}

static void orbits_json(struct text *out, const struct word_orbits *list, const struct scene *s, slong digits) {
  OWNED(json) j = json_of_model(out, s);
  if (list->m.interval) box_json(&j, list->m.interval, digits);
  if (s->system) {
    json_bool(&j, "complete", false);
    json_string(&j, "gap", not_complete);
  } else {
    word_json(&j, s);
  }
  JSON_EACH (&j, "orbits", i, list->found.n) proved_orbit_json(&j, &list->found.orbit[i], &list->m, s, digits);
}

/* What is known of a number; range: between which it lies. */
static void add_number(struct text *out, const arb_struct *x, bool range, slong digits) {
  if (!range) {
    print_known(out, x, digits);
    return;
  }
  text_add_char(out, '[');
  add_end(out, x, false, digits);
  text_add(out, ", ");
  add_end(out, x, true, digits);
  text_add_char(out, ']');
}

static void multipliers_text(struct text *out, acb_srcptr z, int n, bool range, slong digits) {
  text_add(out, "  multipliers ");
  for (int i = 0; z && i < n; i++) {
    text_add(out, i ? ", " : " ");
    add_number(out, acb_realref(z + i), range, digits);
    if (!range && arb_contains_zero(acb_realref(z + i)) && !arb_is_zero(acb_realref(z + i))) {
      text_add(out, " within ");
      print_radius(out, arb_radref(acb_realref(z + i)));
    }
    if (arb_is_zero(acb_imagref(z + i))) continue;
    text_add(out, !range && arb_is_negative(acb_imagref(z + i)) ? " " : " +");
    add_number(out, acb_imagref(z + i), range, digits);
    text_add(out, " i");
  }
  text_add(out, !z ? " not told apart\n" : n ? "\n" : " none\n");
}

static void print_named(struct text *out, const char *name, const arb_struct *x, bool range, slong digits) {
  text_printf(out, "  %-12s ", name);
  add_number(out, x, range, digits);
  text_add_char(out, '\n');
}

static void breaks_text(struct text *out, const struct mech_orbit *o, const struct mech *m, const struct scene *s) {
  for (int i = 0; i < o->n_facts; i++) {
    if (o->fact[i].holds != TRUTH_FALSE && !o->fact[i].changes) continue;
    text_add(out, "  breaks       ");
    violation(out, &o->fact[i], o, m, s);
    text_add(out, o->fact[i].changes ? " in a part of the box\n" : "\n");
  }
}

/* Behind its verdict, where it was followed over a box. */
static void proved_over_text(struct text *out, const struct mech_orbit *o) {
  if (o->over)
    text_printf(out, "; proved over the box in %d piece%s", o->pieces, plural_s(o->pieces));
  else if (o->pieces)
    text_printf(out, "; not proved over the box within %d pieces, its numbers at the middle", MECH_PIECES);
  text_add(out, o->over && o->own != TRUTH_TRUE ? "\n  perhaps not of the word all over the box\n" : "\n");
}

static void orbit_text(struct text *out, const struct mech_orbit *o, const struct mech *m, const struct scene *s,
                       slong digits) {
  NUMBERS(mag, radius);
  NUMBERS(arb, least);
  const struct mech_orbit *x = o->over ? o->over : o;
  bool range = o->over != NULL;
  text_printf(out, "%s, ", o->changes ? "stable in a part of the box" : stability_name[o->stable]);
  admissible_text(out, o->admissible, s);
  proved_over_text(out, o);
  for (int k = 0; k < o->word.n; k++) {
    char name[MECH_PHASE + 16];
    snprintf(name, sizeof name, "t_%d %s", k + 1, phase_shown(s, o->word.phase[k]));
    print_named(out, name, x->t + k, range, digits);
  }
  print_named(out, "period", x->period, range, digits);
  for (int i = 0; i < 2 * o->n; i++) {
    char name[24];
    snprintf(name, sizeof name, "x_%d%s", i % o->n + 1, i < o->n ? "" : "'");
    print_named(out, name, x->state + i, range, digits);
  }
  if (o->turns) print_named(out, "load angle", x->angle, range, digits);
  if (o->turns) text_printf(out, "  %-12s %ld\n", "load turns", (long)o->turns);
  for (int i = 0; i < 2 && !s->system; i++)
    if (word_orbit_friction(least, o, m, i, system_bits(digits)))
      print_named(out, friction_name[i], least, false, digits);
  multipliers_text(out, x->multipliers ? x->multiplier : NULL, o->n_free, range, digits);
  if (!o->pieces) {
    find_radius(radius, o);
    proof_text(out, o->certified, radius);
  }
  breaks_text(out, o, m, s);
}

/* How the orbits were looked for. */
static void search_text(struct text *out, const struct mech_orbits *list) {
  text_printf(out, "not proved complete: %s (%d motions, %d starts of Newton's iteration, %d without an orbit)\n",
              not_complete, list->simulations, list->candidates, list->failed);
  if (list->unfinished)
    text_printf(
        out,
        "%d of these motions were given up: too many steps, rebounds too short to be followed, or numbers out of the "
        "range of a double\n",
        list->unfinished);
}

static void box_text(struct text *out, const struct mech_given *interval) {
  if (interval) text_add(out, " at the middle of the box");
  for (; interval; interval = interval->next) {
    text_printf(out, ", %s in [", interval->name);
    num_print_q(out, interval->low);
    text_add(out, ", ");
    num_print_q(out, interval->high);
    text_add_char(out, ']');
  }
  text_add_char(out, '\n');
}

static void orbits_text(struct text *out, const struct word_orbits *list, const struct scene *s, slong digits) {
  const struct mech_orbits *found = &list->found;
  if (s->system) {
    text_printf(out, "%s: %d orbit%s of the system %s found", s->name, found->n, plural_s(found->n), s->system);
    box_text(out, list->m.interval);
    search_text(out, found);
    mech_names_print(out, &list->m);
  } else {
    word_text(out, list, s);
  }
  for (int i = 0; i < found->n; i++) {
    text_printf(out, "orbit %d: ", i + 1);
    orbit_text(out, &found->orbit[i], &list->m, s, digits);
  }
}

/* Another word's are written as a system's, with static friction in any case, and judged as such. */
static bool write_certificate(const char *path, struct word_orbits *list, const struct scene *s, slong digits,
                              struct diag *d) {
  int n = list->found.n;
  OWNED(text) out = {0};
  if (!s->system) {
    word_orbits_with_friction(list, system_bits(digits));
    for (int k = 0; k < list->found.n; k++) mech_orbit_decide(&list->found.orbit[k], &list->m, system_bits(digits));
  }
  bool ok = may_write_certificate(s, mech_orbits_certified(&list->found), n, d);
  if (ok) {
    mech_certificates_json(&out, s->name, &list->m, &list->found);
    ok = file_write(path, out.data, out.len, d);
  }
  return ok;
}

/* --- Words --- */

struct survey {
  struct mech_orbits orbits;
  struct mech_settling settling;
  int longest; /* longer words are left out */
};

/* Which words there are: each orbit's where no earlier one has it, then those on which motions settle; NULL where it
   has stood before, or is too long. */
static const struct mech_word *word_number(int *motions, const struct survey *v, int k) {
  const struct mech_orbits *list = &v->orbits;
  const struct mech_word *w = k < list->n ? &list->orbit[k].word : &v->settling.on[k - list->n].word;
  if (w->n > v->longest) return NULL;
  for (int i = 0; i < k && i < list->n; i++)
    if (mech_word_same(&list->orbit[i].word, w)) return NULL;
  *motions = 0;
  for (int i = 0; i < v->settling.n; i++)
    if (mech_word_same(&v->settling.on[i].word, w)) *motions = v->settling.on[i].motions;
  return w;
}

static void words_json(struct text *out, const struct survey *v, const struct mech *m, const struct scene *s,
                       slong digits) {
  const struct mech_orbits *list = &v->orbits;
  int motions;
  OWNED(json) j = json_document(out, NULL);
  json_string(&j, "scene", s->name);
  json_string(&j, "system", s->system);
  json_string(&j, "layer", "model");
  json_bool(&j, "complete", false);
  json_string(&j, "gap", not_complete);
  json_object(&j, "simulations");
  json_long(&j, "starts", v->settling.starts);
  json_long(&j, "settled", v->settling.settled);
  json_long(&j, "eventless", v->settling.eventless);
  json_long(&j, "unfinished", v->settling.unfinished);
  json_end_object(&j);
  JSON_EACH (&j, "words", k, list->n + v->settling.n) {
    const struct mech_word *w = word_number(&motions, v, k);
    if (!w) continue;
    JSON_OBJECT(&j, NULL);
    mech_word_json(&j, w);
    json_long(&j, "settled", motions);
    JSON_EACH (&j, "orbits", i, list->n)
      if (mech_word_same(&list->orbit[i].word, w)) proved_orbit_json(&j, &list->orbit[i], m, s, digits);
  }
}

/* A word with its orbits that are motions, as far as is known; *others: how many are not. */
static void word_line(struct text *out, int *others, const struct mech_orbits *list, const struct mech_word *w,
                      int motions, slong digits) {
  OWNED(text) rows = {0};
  for (int i = 0; i < list->n; i++) {
    const struct mech_orbit *o = &list->orbit[i];
    if (!mech_word_same(&o->word, w)) continue;
    *others += o->admissible == TRUTH_FALSE;
    if (o->admissible == TRUTH_FALSE) continue;
    text_add(&rows, "    orbit of period ");
    print_known(&rows, o->period, digits);
    text_printf(&rows, ", %s, %s%s\n", stability_name[o->stable], admissibility_name[o->admissible],
                o->certified ? "" : ", not certified");
  }
  if (motions > 0 || rows.len > 0) {
    text_add(out, "  ");
    mech_word_print(out, w);
    if (motions) text_printf(out, ": %d motion%s", motions, motions == 1 ? " settles on it" : "s settle on it");
    text_printf(out, "\n%s", text_str(&rows));
  }
}

static void words_text(struct text *out, const struct survey *v, const struct scene *s, slong digits) {
  const struct mech_settling *t = &v->settling;
  int motions, others = 0;
  text_printf(out, "%s: words of the system %s; %d of %d motions from random starts settle", s->name, s->system,
              t->settled, t->starts);
  if (t->eventless) text_printf(out, ", %d go%s on without events", t->eventless, t->eventless == 1 ? "es" : "");
  if (t->unfinished) text_printf(out, ", and %d could not be followed so long", t->unfinished);
  text_add_char(out, '\n');
  for (int k = 0; k < v->orbits.n + t->n; k++) {
    const struct mech_word *w = word_number(&motions, v, k);
    if (w) word_line(out, &others, &v->orbits, w, motions, digits);
  }
  if (others)
    text_printf(
        out,
        "%d more orbit%s of a word's equations break%s a condition of Coulomb's law, so that no motion follows %s "
        "(see --json)\n",
        others, plural_s(others), others == 1 ? "s" : "", others == 1 ? "it" : "them");
  search_text(out, &v->orbits);
}

/* --- The Jacobian of a return --- */

static void free_name(char name[16], const struct mech_orbit *o, int l) {
  int at = o->free[l];
  if (at == 2 * o->n)
    snprintf(name, 16, "load_angle");
  else
    snprintf(name, 16, "%c%d", at < o->n ? 'x' : 'v', at % o->n + 1);
}

static void return_text(struct text *out, const arb_mat_t x, slong digits) {
  for (slong i = 0; i < arb_mat_nrows(x); i++) {
    for (slong k = 0; k < arb_mat_ncols(x); k++) {
      text_add(out, "  ");
      print_known(out, arb_mat_entry(x, i, k), digits);
    }
    text_add_char(out, '\n');
  }
}

static void jacobian_json(struct text *out, const struct mech_orbit *o, const arb_mat_t x, acb_srcptr z,
                          const struct scene *s, const struct jacobian_request *q) {
  char name[16];
  OWNED(json) j = json_document(out, NULL);
  if (s->system) json_string(&j, "system", s->system);
  word_shown(&j, o, s);
  JSON_EACH (&j, "free", l, o->n_free) {
    free_name(name, o, l);
    json_string(&j, NULL, name);
  }
  JSON_EACH (&j, "J", i, arb_mat_nrows(x)) json_numbers(&j, NULL, arb_mat_entry(x, i, 0), arb_mat_ncols(x), q->digits);
  multipliers_json(&j, z, o->n_free, q->digits);
  json_string(&j, "method", method_name[q->method]);
  json_string(&j, "layer", "model");
  json_at(&j, q);
  json_truth(&j, "admissible", o->admissible);
}

static void jacobian_text(struct text *out, const struct mech_orbit *o, const arb_mat_t x, acb_srcptr z,
                          const struct scene *s, const struct jacobian_request *q) {
  char name[16];
  text_printf(out, "%s, ", s->name);
  print_at(out, q);
  text_printf(out, " (%s), method %s: ", admissibility_name[o->admissible], method_name[q->method]);
  text_add(out, o->n_free ? "the first return of" : "no coordinate is free");
  for (int l = 0; l < o->n_free; l++) {
    free_name(name, o, l);
    text_printf(out, " %s", name);
  }
  text_add(out, " at the entry of the first phase of ");
  for (int k = 0; k < o->word.n; k++)
    text_printf(out, "%s%s", k == 0 ? "" : s->system ? " " : "-", phase_shown(s, o->word.phase[k]));
  text_add(out, o->n_free ? "\n" : ", so that every motion beside the orbit is on it after one period\n");
  return_text(out, x, q->digits);
  multipliers_text(out, z, o->n_free, false, q->digits);
}

/* --method of such a Jacobian; false with d set where it is of the paper's word alone. */
static bool find_route(enum mech_derivative *how, const struct jacobian_request *q, const struct scene *s,
                       struct diag *d) {
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
  return diag_set(d, "%s: error: --method %s is of the paper's word; here it is implicit, saltation, fd-double or ode",
                  s->path, method_name[q->method]);
}

static void unknown(struct diag *d, const struct jacobian_request *q, const struct scene *s) {
  bool simulated = q->method == METHOD_FD_DOUBLE || q->method == METHOD_ODE;
  diag_set(d, "%s: error: --method %s has no value: %s", s->path, method_name[q->method],
           simulated ? "a simulation beside the orbit does not follow the word"
                     : "the orbit could not be enclosed again");
}

static void show_jacobian(const struct options *o, struct word_orbits *list, const struct scene *s,
                          const struct jacobian_request *q, enum mech_derivative how, struct diag *d) {
  slong prec = system_bits(q->digits);
  int n = list->found.n;
  if (q->orbit >= n) {
    scene_lacks_orbit(s, q->orbit, n, d);
    return;
  }
  if (!s->system) word_orbits_with_friction(list, prec);
  if (list->found.n < n) {
    unknown(d, q, s);
    return;
  }
  const struct mech_orbit *orbit = &list->found.orbit[q->orbit];
  struct text out = {0};
  acb_ptr z = _acb_vec_init(orbit->n_free);
  SIZED(arb_mat, x, orbit->n_free, orbit->n_free);
  if (mech_jacobian(x, &list->m, orbit, how, prec) != SS_OK) {
    unknown(d, q, s);
  } else {
    bool known = mech_eigenvalues(z, x, prec);
    (option(o, OPT_JSON) ? jacobian_json : jacobian_text)(&out, orbit, x, known ? z : NULL, s, q);
    print_text(&out);
  }
  _acb_vec_clear(z, orbit->n_free);
}

/* --- The commands --- */

/* Options that are of the paper's word of its two masses, or too many digits. */
static bool refuse(const struct options *o, const struct scene *s, slong digits, struct diag *d) {
  static const enum option of_paper[] = {OPT_BASIN, OPT_PHASES, OPT_LAYER};
  for (size_t i = 0; i < sizeof of_paper / sizeof *of_paper && !d->set; i++)
    if (option(o, of_paper[i])) refuse_option(d, option_name(of_paper[i]), s);
  if (!d->set && digits > WORD_DIGITS)
    diag_set(d, "%s: error: a scene of %s takes at most %d --digits", s->path,
             s->system ? "a system file" : "another word", WORD_DIGITS);
  return d->set;
}

static void find_over_box(struct mech_orbits *list, const struct mech *m, const struct scene *s, const char *data,
                          slong prec) {
  OWNED(text) path = {0};
  scene_system_path(&path, s->system, data);
  progress_begin();
  mech_orbits_over(list, &(struct mech_box){text_str(&path), s->system_value, m, prec, progress_count});
  progress_end();
}

bool find_system_orbits(struct mech *m, struct mech_orbits *list, enum system_search search, const struct scene *s,
                        const char *data, slong digits, struct diag *d) {
  struct mech_word w;
  *list = (struct mech_orbits){.n = 0};
  if (!scene_load_system(m, &w, s, data, search == OF_ITS_WORD_OVER_A_BOX, d)) return false;
  if (m->n_intervals && digits > MOST_BOX_DIGITS)
    return diag_set(d, "%s: error: intervals are shown with at most %d --digits", s->path, MOST_BOX_DIGITS);
  struct mech middle = *m; /* borrowed */
  middle.n_intervals = 0;
  progress_begin();
  mech_orbits_find(list, &middle, w.n && search != OF_ANY_WORD ? &w : NULL, false, system_bits(digits),
                   &(struct mech_tell){progress_count, 0, MECH_SEARCHED});
  progress_end();
  if (m->n_intervals) find_over_box(list, m, s, data, system_bits(digits));
  return true;
}

/* Those that a scene asks for; to be cleared in any case. */
static bool find_orbits(struct word_orbits *list, enum system_search search, const struct scene *s, const char *data,
                        slong digits, struct diag *d) {
  *list = (struct word_orbits){.evaluations = 0};
  return s->system ? find_system_orbits(&list->m, &list->found, search, s, data, digits, d)
                   : find_word_orbits(list, s, digits, d);
}

int run_proved_orbit(const struct options *o, const struct scene *s, const char *data, slong digits, struct diag *d) {
  const char *certificate = option(o, OPT_CERTIFICATE);
  OWNED(text) out = {0};
  if (s->system && option(o, OPT_METHOD)) refuse_option(d, "--method", s);
  if (d->set || refuse(o, s, digits, d)) return EXIT_INPUT;
  OWNED(word_orbits) list;
  bool ok = find_orbits(&list, certificate ? OF_ITS_WORD : OF_ITS_WORD_OVER_A_BOX, s, data, digits, d);
  if (ok) (option(o, OPT_JSON) ? orbits_json : orbits_text)(&out, &list, s, digits);
  if (ok && (!certificate || write_certificate(certificate, &list, s, digits, d))) {
    print_found(o, &out);
    if (certificate) say_written(o, certificate);
  }
  return EXIT_AS_RECORDED;
}

int run_system_words(const struct options *o, const struct scene *s, const char *data, int longest, slong digits,
                     struct diag *d) {
  struct survey v = {.longest = option(o, OPT_LONGEST) ? longest : MECH_PHASES};
  if (refuse(o, s, digits, d)) return EXIT_INPUT;
  OWNED(mech) m;
  bool ok = find_system_orbits(&m, &v.orbits, OF_ANY_WORD, s, data, digits, d);
  if (ok) {
    struct text out = {0};
    progress_begin();
    mech_settle(&v.settling, &m, &(struct mech_tell){progress_count, 0, MECH_SIMULATIONS});
    progress_end();
    if (option(o, OPT_JSON))
      words_json(&out, &v, &m, s, digits);
    else
      words_text(&out, &v, s, digits);
    print_found(o, &out);
    mech_settling_clear(&v.settling);
  }
  mech_orbits_clear(&v.orbits);
  return EXIT_AS_RECORDED;
}

int run_proved_jacobian(const struct options *o, const struct scene *s, const char *data,
                        const struct jacobian_request *asked, struct diag *d) {
  struct jacobian_request q = *asked;
  enum mech_derivative how;
  if (!option(o, OPT_METHOD)) q.method = METHOD_SALTATION;
  if (q.at_printed) refuse_option(d, "--at printed", s);
  if (d->set || !find_route(&how, &q, s, d) || refuse(o, s, q.digits, d)) return EXIT_INPUT;
  OWNED(word_orbits) list;
  if (find_orbits(&list, OF_ITS_WORD, s, data, q.digits, d)) show_jacobian(o, &list, s, &q, how, d);
  return EXIT_AS_RECORDED;
}
