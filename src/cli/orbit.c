/* stickslip orbit: every number to the digits asked for, as a table or as JSON. */
#include <math.h>

#include "base/json.h"
#include "cli.h"
#include "explore/family.h"
#include "motion/complete.h"
#include "motion/dynamics.h"
#include "motion/margins.h"
#include "orbit_numbers.h"
#include "word_orbits.h"

/* What is enclosed to so many digits is printed to them. */
static void print_number(struct text *out, const struct dyn_orbit *o, int i, const struct scene *s, slong digits) {
  const fmpq *exact = scene_given_number(s, i);
  if (exact)
    num_print_rational(out, exact, digits);
  else
    num_print(out, orbit_number(o, i), digits);
}

static void orbit_json(struct json *j, const struct dyn_orbit *o, const struct dyn_certificate *proof,
                       const struct scene *s, slong digits, bool basin) {
  NUMBERS(mag, radius);
  truth u[2], admissible = orbit_admissible(u, s, o);
  JSON_OBJECT(j, NULL);
  orbit_numbers_json(j, o, print_number, s, digits, admissible, u);
  dyn_orbit_radius(radius, o);
  proof_json(j, proof->certified, radius);
  if (basin) basin_json(j, o, s);
}

/* Why the list is not proved complete, and how far in t_c the proof reaches. */
static void completeness_json(struct json *j, const struct dyn_orbits *list) {
  json_string(j, "gap", list->complete ? NULL : dyn_gap_text[list->gap]);
  json_double(j, "t_c_max", "%.15g", list->complete && list->t_c_max > 0 ? list->t_c_max : (double)NAN);
}

/* Which orbits are meant, where the scene does not give the forces: " with these t_b and t_c". */
static void add_given(struct text *out, const struct scene *s) {
  if (scene_has_forces(s)) return;
  int n = 0;
  for (int k = KEY_E1; k <= KEY_TD; k++)
    if (s->given[k]) text_printf(out, "%s %s", n++ ? " and" : " with these", scene_key_name[k]);
}

static void add_completeness(struct text *out, const struct dyn_orbits *list, const struct scene *s) {
  if (!list->complete) {
    text_printf(out, "not proved complete: %s", dyn_gap_text[list->gap]);
    if (list->gap_at[1] > 0) text_printf(out, " (near t_b = %.6g, t_c = %.6g)", list->gap_at[0], list->gap_at[1]);
    text_add_char(out, '\n');
  } else if (list->t_c_max > 0) {
    text_add(out, "complete: there is no other orbit");
    add_given(out, s);
    text_printf(out, "%s with t_c up to %.15g\n", scene_has_forces(s) ? "" : " and", list->t_c_max);
  } else {
    text_add(out, "complete: there is no other orbit of this word");
    add_given(out, s);
    text_add_char(out, '\n');
  }
}

static void orbits_json(struct text *out, const struct solved *z, const struct scene *s, slong digits, bool basin) {
  const struct dyn_orbits *list = &z->list;
  OWNED(json) j = json_of_model(out, s);
  json_bool(&j, "complete", list->complete);
  completeness_json(&j, list);
  JSON_EACH (&j, "orbits", i, list->n) orbit_json(&j, &list->orbit[i], &z->proof[i], s, digits, basin);
}

/* Every inequality along the orbit, with its margin and where it is least. */
static void add_margins(struct text *out, const struct dyn_orbit *o, const struct scene *s) {
  static const char *const word[] = {"broken", "holds", "open"};
  const fmpq *u[2];
  LOCAL(dyn_margins, m);
  scene_static_friction(u, s);
  if (dyn_margins_find(&m, s->value, o, u[0], u[1], 128) == SS_OK) {
    text_printf(out, "  %-12s %-6s %-20s %s\n", "inequality", "", "margin", "at t");
    for (int i = 0; i < N_MARGINS; i++) {
      const struct dyn_margin *k = &m.at[i];
      bool meets = scene_solution_ii(s) && i == COND_C_W; /* w = e1 as phase C ends */
      if (scene_solution_ii(s) && !three_phases_have(i)) continue;
      bool low = i > MARGIN_D_W && !u[i >= MARGIN_D_R_LOW];
      text_printf(out, "  %-12s %-6s ", k->id, low ? "" : word[meets ? o->holds[COND_C_W] : k->holds]);
      size_t column = out->len;
      if (k->by_definition || (meets && arb_contains_zero(k->margin)))
        text_add(out, "0, as it must be");
      else if (num_print(out, k->margin, 6) != SS_OK)
        num_print_ball(out, k->margin, 6);
      if (low) text_printf(out, " + 2 %s", i >= MARGIN_D_R_LOW ? "u_r2" : "u_r1");
      do text_add_char(out, ' ');
      while (out->len - column < 21);
      if (num_print(out, k->time, 8) != SS_OK) num_print_ball(out, k->time, 8);
      text_printf(out, " (%s)\n", dyn_where_name[k->where]);
    }
  }
  text_add(out, "  v1, v2: V - z_i'; w: e_1 - (z_1 - chi z_2); r: e_2 - chi (z_2 - z_1); all >= 0\n"
                "  in the phase named before it; low: the same force above its other limit\n");
}

static void add_proof(struct text *out, const struct dyn_orbit *o, const struct dyn_certificate *proof) {
  NUMBERS(mag, radius);
  if (proof->certified) {
    dyn_orbit_radius(radius, o);
    proof_text(out, true, radius);
  } else {
    text_add(out, "  not certified, undecided: ");
    dyn_certificate_why(out, proof);
    text_add_char(out, '\n');
  }
}

/* Name, value and meaning in columns. */
static void numbers_text(struct text *out, const struct dyn_orbit *o, const struct scene *s, slong digits) {
  struct text t[ORBIT_NUMBERS] = {{0}};
  size_t widest = 0;
  for (int k = 0; k < ORBIT_NUMBERS; k++) {
    print_number(&t[k], o, k, s, digits);
    widest = t[k].len > widest ? t[k].len : widest;
  }
  for (int k = 0; k < ORBIT_NUMBERS; k++) {
    text_printf(out, "  %-8s %-*s  %s\n", orbit_number_name(k), (int)widest, text_str(&t[k]), orbit_number_meaning(k));
    text_clear(&t[k]);
  }
}

static void orbits_text(struct text *out, const struct solved *z, const struct scene *s, slong digits, bool basin) {
  const struct dyn_orbits *list = &z->list;
  text_printf(out, "%s: %ld orbit%s of the word %s found\n", s->name, (long)list->n, plural_s(list->n),
              scene_solution_ii(s) ? "Gamma-H-C" : "D-Gamma-H-C");
  add_completeness(out, list, s);
  for (slong i = 0; i < list->n; i++) {
    const struct dyn_orbit *o = &list->orbit[i];
    truth u[2], admissible = orbit_admissible(u, s, o);
    text_printf(out, "orbit %ld: %s, ", (long)i + 1, stability_name[o->stable]);
    admissible_text(out, admissible, s);
    text_add_char(out, '\n');
    numbers_text(out, o, s, digits);
    add_proof(out, o, &z->proof[i]);
    for (int k = 0; k < ORBIT_CONDITIONS; k++)
      if (orbit_breaks(o, u, k)) text_printf(out, "  breaks   %s\n", orbit_condition_name(k));
    if (basin) basin_text(out, o, s);
    add_margins(out, o, s);
  }
}

static bool write_certificate(const char *path, const struct scene *s, const struct solved *z, struct diag *d) {
  if (!may_write_certificate(s, solved_certified(z), z->list.n, d)) return false;
  OWNED(text) out = {0};
  solved_certificates(&out, z, s);
  return file_write(path, out.data, out.len, d);
}

static void print_orbits(const struct options *o, const struct solved *z, const struct scene *s, slong digits) {
  struct text out = {0};
  (option(o, OPT_JSON) ? orbits_json : orbits_text)(&out, z, s, digits, option(o, OPT_BASIN));
  print_found(o, &out);
}

static int show_orbits(const struct options *o, const struct scene *s, slong digits, struct diag *d) {
  OWNED(solved) z;
  int status = EXIT_AS_RECORDED;
  const char *certificate = option(o, OPT_CERTIFICATE);
  bool good = solved_find(&z, s, digits);
  if (z.found != SS_OK && !z.list.complete)
    fprintf(stderr, "%s: warning: the search ran into its limits; there may be more orbits\n", s->path);
  if (!good)
    diag_set(d, "%s: error: an orbit could not be enclosed to %ld digits; more --digits take a higher precision",
             s->path, (long)digits);
  if (!good || (certificate && !write_certificate(certificate, s, &z, d)))
    status = EXIT_INPUT;
  else
    print_orbits(o, &z, s, digits);
  if (status == EXIT_AS_RECORDED && certificate) say_written(o, certificate);
  return status;
}

/* What the options ask of a scene of the paper's word that it cannot give: NULL where there is no such thing. */
static const char *lacks(const struct options *o, const struct scene *s) {
  if (option(o, OPT_BASIN) && (scene_is_box(s) || !scene_has_forces(s)))
    return "--basin needs a scene that gives e1 and e2, and no interval";
  if (!option(o, OPT_CERTIFICATE)) return NULL;
  if (scene_is_box(s)) return "--certificate needs a scene without an interval";
  return scene_solution_ii(s) ? "--certificate is of the word D-Gamma-H-C, and the scene names Gamma-H-C" : NULL;
}

static int show_scene(const struct options *o, const struct scene *s, const char *data, slong digits, struct diag *d) {
  if (s->system || scene_other_word(s)) return run_proved_orbit(o, s, data, digits, d);
  const char *why = lacks(o, s);
  if (why) {
    diag_set(d, "%s: error: %s", s->path, why);
    return EXIT_INPUT;
  }
  return scene_is_box(s) ? show_box(o, s, digits) : show_orbits(o, s, digits, d);
}

int run_orbit(const struct options *o, const char *data, struct diag *d) {
  static const char *const method[] = {"model", "paper"};
  int by = 0, status = parse_word(&by, o, OPT_METHOD, method, 2);
  slong digits;
  if (!status && by == 1) {
    if (option(o, OPT_CERTIFICATE)) return usage("--certificate is of the model's orbits, not of --method paper");
    return run_orbit_paper(o, data, d);
  }
  if (!status) status = parse_digits(&digits, o, MAX_DIGITS);
  if (status) return status;
  OWNED(scene) s;
  if (load_scene(&s, o->operands.word[0], data, o, SCENE_OF_ANY_SYSTEM, d)) status = show_scene(o, &s, data, digits, d);
  return status;
}
