/* stickslip bifurcate: where the orbits change along a line in parameter space, as a table or as JSON. */
#include "explore/bifurcate.h"

#include <math.h>
#include <string.h>

#include "base/json.h"
#include "cli.h"

enum { STARTS = 257 };

/* --- What is known of the orbits beside a change. --- */

static const char *ending_word(enum dyn_branch_end end, enum dyn_change change) {
  static const char *const words[] = {[END_OF_LINE] = "line", [END_CLOSED] = "closed", [END_LOST] = "lost"};
  return end == END_CHANGE ? dyn_change_id[change] : words[end];
}

/* --- JSON --- */

static void json_known(struct json *j, const char *key, const arb_t x, slong digits) {
  bool known = arb_is_finite(x) && (arb_is_exact(x) || arb_rel_accuracy_bits(x) > 4);
  json_number(j, key, known ? x : NULL, digits);
}

static void side_json(struct json *j, const char *key, const struct dyn_beside *side, const struct scene *s,
                      slong digits) {
  JSON_EACH (j, key, i, side->n) {
    if (side->word[i] == TRUTH_FALSE) continue;
    JSON_OBJECT(j, NULL);
    json_truth(j, "of_word", side->word[i]);
    json_known(j, "trace", side->orbit[i].trace, digits);
    json_truth(j, "stable", side->orbit[i].stable);
    json_truth(j, "admissible", orbit_admissible(NULL, s, &side->orbit[i]));
  }
}

static void change_json(struct json *j, const struct dyn_bifurcation *b, const struct scene *s, slong digits) {
  JSON_OBJECT(j, NULL);
  json_string(j, "kind", dyn_change_id[b->what]);
  json_long(j, "branch", (long)b->branch + 1);
  json_rational(j, "low", &b->low, b->digits);
  json_rational(j, "high", &b->high, b->digits);
  json_bool(j, "proved", b->crosses);
  json_bool(j, "unique", b->unique);
  json_truth(j, "of_word", b->word);
  json_known(j, "t_b", b->tb, digits);
  json_known(j, "t_c", b->tc, digits);
  json_known(j, "trace", b->trace, digits);
  json_known(j, "third", b->third, digits);
  side_json(j, "below", &b->beside[0], s, digits);
  side_json(j, "above", &b->beside[1], s, digits);
}

static void branch_json(struct json *j, const struct dyn_branch *b, long number) {
  JSON_OBJECT(j, NULL);
  json_long(j, "branch", number);
  json_printf(j, "from", "%.6g", b->from[0]);
  json_printf(j, "to", "%.6g", b->to[0]);
  json_printf(j, "least", "%.6g", b->span[0]);
  json_printf(j, "greatest", "%.6g", b->span[1]);
  json_string(j, "begins", ending_word(b->end[0], b->change[0]));
  json_string(j, "ends", ending_word(b->end[1], b->change[1]));
}

static void all_json(struct text *out, const struct dyn_bifurcations *list, const struct scene *s,
                     const struct scene_range *a, slong digits) {
  OWNED(json) j = json_of_model(out, s);
  along_json(&j, scene_key_name[a->vary], a->from, a->to, digits);
  json_bool(&j, "complete", false);
  json_long(&j, "missed", (long)list->missed);
  JSON_EACH (&j, "bifurcations", i, list->n) change_json(&j, &list->at[i], s, digits);
  JSON_EACH (&j, "branches", i, list->n_branches) branch_json(&j, &list->branch[i], (long)i + 1);
}

/* --- Text --- */

static void side_text(struct text *out, const struct dyn_beside *side, const struct scene *s) {
  int n = 0;
  for (int i = 0; i < side->n; i++) {
    if (side->word[i] == TRUTH_FALSE) continue;
    const struct dyn_orbit *o = &side->orbit[i];
    text_printf(out, "%s%s, %s%s", n++ ? " and " : "", fate_name[o->stable],
                admissibility_name[orbit_admissible(NULL, s, o)],
                side->word[i] == TRUTH_UNKNOWN ? ", perhaps not of the word" : "");
  }
  if (n == 0) text_add(out, "none");
}

static void change_text(struct text *out, const struct dyn_bifurcation *b, const struct scene *s, slong digits) {
  size_t begin = out->len, width = 2 * (size_t)digits + 9;
  text_add(out, "  [");
  num_print_rational(out, &b->low, b->digits);
  text_add(out, ", ");
  num_print_rational(out, &b->high, b->digits);
  text_add_char(out, ']');
  while (out->len - begin < width) text_add_char(out, ' ');
  text_printf(out, "  %-9s %6ld  ", dyn_change_id[b->what], (long)b->branch + 1);
  side_text(out, &b->beside[0], s);
  text_add(out, " -> ");
  side_text(out, &b->beside[1], s);
  if (!b->crosses)
    text_add(out, "; not proved");
  else if (!b->unique)
    text_add(out, "; perhaps more than once");
  if (b->what == CHANGE_FLIP && b->crosses && !arb_contains_zero(b->third))
    text_printf(out, "; at tr J = -1 %s", arb_is_positive(b->third) ? "stable" : "unstable");
  text_add_char(out, '\n');
}

/* What the kinds that occur mean; two of one id, on one line. */
static void kinds_text(struct text *out, const struct dyn_bifurcations *list) {
  const char *last = "";
  bool met[N_CHANGES] = {false};
  for (slong i = 0; i < list->n; i++) met[list->at[i].what] = true;
  for (int k = 0; k < N_CHANGES; k++) {
    if (!met[k]) continue;
    bool again = strcmp(dyn_change_id[k], last) == 0;
    if (!again) text_printf(out, "%s%s: ", *last ? "\n" : "", dyn_change_id[k]);
    text_printf(out, "%s%s", again ? ", or " : "", dyn_change_text[k]);
    last = dyn_change_id[k];
  }
  if (*last) text_add_char(out, '\n');
}

static void all_text(struct text *out, const struct dyn_bifurcations *list, const struct scene *s,
                     const struct scene_range *a, slong digits) {
  const char *name = scene_key_name[a->vary];
  along_text(out, s, name, a->from, a->to, (long)list->n, (long)list->n_branches);
  text_printf(out, "  %-*s  %-9s %6s  %s\n", 2 * (int)digits + 7, name, "kind", "branch", "orbits below -> above");
  for (slong i = 0; i < list->n; i++) change_text(out, &list->at[i], s, digits);
  kinds_text(out, list);
  for (slong i = 0; i < list->n_branches; i++) {
    const struct dyn_branch *b = &list->branch[i];
    text_printf(out, "branch %ld: %s from %.6g (%s) to %.6g (%s)", (long)i + 1, name, b->from[0],
                ending_word(b->end[0], b->change[0]), b->to[0], ending_word(b->end[1], b->change[1]));
    if (b->span[0] < fmin(b->from[0], b->to[0]) || b->span[1] > fmax(b->from[0], b->to[0]))
      text_printf(out, ", reaching from %.6g to %.6g", b->span[0], b->span[1]);
    text_add_char(out, '\n');
  }
  text_add(out, "not proved complete: a branch between two of the values searched at can be missing\n");
}

/* --- The command. --- */

void warn_missed(const struct scene *s) {
  fprintf(stderr, "%s: warning: a search or a branch ran into its limits; there may be more changes\n", s->path);
}

static int show(const struct scene *s, const struct scene_range *a, const struct options *o, slong digits) {
  OWNED(dyn_bifurcations) list;
  struct dyn_line line = {.params = s->value, .vary = a->vary, .from = a->from, .to = a->to};
  scene_static_friction(line.u_r, s);
  int found = dyn_bifurcations_find(&list, &line, digits, STARTS);
  if (found != SS_OK || list.missed) warn_missed(s);
  struct text out = {0};
  (option(o, OPT_JSON) ? all_json : all_text)(&out, &list, s, a, digits);
  print_found(o, &out);
  return EXIT_AS_RECORDED;
}

/* On the paper's two masses. */
static int with_line(const struct options *o, const struct scene *s, slong digits, struct diag *d) {
  LOCAL(scene_range, a);
  int status = parse_along(&a, NULL, o);
  if (!status && !scene_needs_forces(s, "bifurcate", d)) status = EXIT_INPUT;
  if (!status) status = range_check_friction(&a, s, "--along", option(o, OPT_ALONG));
  if (!status) status = show(s, &a, o, digits);
  return status;
}

int run_bifurcate(const struct options *o, const char *data, struct diag *d) {
  slong digits;
  int status = parse_digits(&digits, o, MAX_BRACKET_DIGITS);
  if (status) return status;
  if (!option(o, OPT_ALONG)) return usage("bifurcate needs --along NAME=A:B");
  OWNED(scene) s;
  if (load_scene(&s, o->operands.word[0], data, o, SCENE_EXACT_OR_SYSTEM, d))
    status = s.system ? run_system_bifurcate(o, &s, data, digits, d) : with_line(o, &s, digits, d);
  return status;
}
