/* What kind of scene it is: of one point or a box, with which data, of which word. */
#include <string.h>

#include "scene_impl.h"

bool scene_has_forces(const struct scene *s) {
  return s->given[KEY_E1] && s->given[KEY_E2];
}

void scene_static_friction(const fmpq *u_r[2], const struct scene *s) {
  for (int i = 0; i < 2; i++) u_r[i] = s->given[KEY_U_R1 + i] ? &s->value[KEY_U_R1 + i] : NULL;
}

bool scene_lacks_friction(const struct scene *s, const struct mech_word *w) {
  return phase_word_has_faster(w) && !(s->given[KEY_U_R1] && s->given[KEY_U_R2]);
}

int scene_interval(const struct scene *s) {
  int k = 0;
  while (k < N_SCENE_PARAMS && !s->interval[k]) k++;
  return k;
}

bool scene_is_box(const struct scene *s) {
  return scene_interval(s) < N_SCENE_PARAMS;
}

bool scene_is_example(const struct scene *s) {
  for (int k = KEY_TA; k <= KEY_TD; k++)
    if (s->given[k]) return false;
  return s->n_printed > 0 && !s->changed;
}

const char *scene_data_of(const struct scene *s) {
  return scene_is_example(s) ? "the example" : "this scene";
}

void scene_data_print(struct text *out, const struct scene *s) {
  const char *sep = "";
  for (int k = 0; k < N_KEYS; k++) {
    if (!s->given[k]) continue;
    text_printf(out, "%s%s = %s", sep, scene_key_name[k], s->interval[k] ? "[" : "");
    num_print_q(out, &s->value[k]);
    if (s->interval[k]) {
      text_add(out, ", ");
      num_print_q(out, &s->high[k]);
      text_add_char(out, ']');
    }
    sep = ", ";
  }
}

bool scene_on_record(const struct scene *s) {
  return s->on_file && scene_is_example(s);
}

bool scene_solution_ii(const struct scene *s) {
  static const struct mech_word three = {3, {"-s", "--", "s-"}};
  return s->given[KEY_TA] && fmpq_is_zero(&s->value[KEY_TA]) && mech_word_same(&s->word, &three);
}

bool scene_four_phases(const struct scene *s, struct diag *d) {
  if (!scene_papers_word(s, d)) return false;
  if (!scene_solution_ii(s)) return true;
  return diag_set(
      d,
      "%s: error: the word Gamma-H-C is judged by orbit and words alone; take it away with --set word= to judge "
      "the motion as D-Gamma-H-C with t_a = 0",
      s->path);
}

bool scene_other_word(const struct scene *s) {
  return s->word.n > 0 && !phase_word_is_papers(&s->word) && !scene_solution_ii(s);
}

bool scene_papers_word(const struct scene *s, struct diag *d) {
  if (!scene_other_word(s)) return true;
  OWNED(text) word = {0};
  phase_word_print(&word, &s->word);
  return diag_set(
      d, "%s: error: the scene names the word %s; only orbit, jacobian and words take another than D-Gamma-H-C",
      s->path, text_str(&word));
}

bool scene_one_point(const struct scene *s, struct diag *d) {
  int k = scene_interval(s);
  if (k == N_SCENE_PARAMS) return true;
  return diag_set(d, "%.300s: error: %s is an interval; only orbit and verify take one", s->path, scene_key_name[k]);
}
