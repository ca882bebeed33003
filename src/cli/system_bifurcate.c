/* stickslip bifurcate on a scene that names a system file. */
#include <math.h>
#include <string.h>

#include "base/json.h"
#include "cli.h"
#include "mech/follow.h"
#include "mech/moments.h"

/* What is shown, and how. */
struct shown {
  const struct mech_follow *f;
  const struct mech *m; /* for the names of its masses */
  const struct mech_line *l;
  const struct scene *s;
  slong digits;
  int decimals; /* of the ends of brackets */
};

/* The side of a change with the lower or the upper parameter. */
static const struct mech_side *side_of(const struct mech_change *c, bool upper) {
  bool falling = fmpq_cmp(c->side[0].at, c->side[1].at) > 0;
  return &c->side[upper != falling];
}

/* The end of a bracket, rounded outwards, with all its decimals. */
static void print_end(struct text *out, const struct shown *v, const struct mech_change *c, bool upper) {
  NUMBERS(fmpq, end, scale);
  NUMBERS(fmpz, whole);
  fmpz_ui_pow_ui(fmpq_numref(scale), 10, (ulong)v->decimals);
  fmpq_mul(end, side_of(c, upper)->at, scale);
  (upper ? fmpz_cdiv_q : fmpz_fdiv_q)(whole, fmpq_numref(end), fmpq_denref(end));
  fmpq_set_fmpz(end, whole);
  fmpq_div(end, end, scale);
  double size = fabs(fmpq_get_d(end));
  num_print_rational(out, end, v->decimals + 1 + (size < 1 ? 0 : (slong)floor(log10(size))));
}

/* --- JSON --- */

static void side_json(struct json *j, const char *key, const struct mech_side *s) {
  JSON_OBJECT(j, key);
  json_bool(j, "found", s->found);
  if (s->found) {
    json_truth(j, "of_word", s->own);
    json_truth(j, "stable", s->stable);
    json_truth(j, "admissible", s->admissible);
  }
}

static void change_json(struct json *j, const struct shown *v, const struct mech_change *c) {
  JSON_OBJECT(j, NULL);
  json_string(j, "kind", mech_turn_id[c->what]);
  json_long(j, "branch", c->branch + 1);
  for (int i = 0; i < 2; i++) JSON_STRING(j, i ? "high" : "low", print_end(j->out, v, c, i));
  JSON_EACH (j, "conditions", i, c->n_facts) JSON_STRING(j, NULL, mech_fact_print(j->out, v->m, &c->fact[i], NULL));
  side_json(j, "below", side_of(c, false));
  side_json(j, "above", side_of(c, true));
}

static void branch_json(struct json *j, const struct shown *v, const struct mech_branch *b, int number) {
  JSON_OBJECT(j, NULL);
  json_long(j, "branch", number);
  mech_word_json(j, &b->word);
  json_rational(j, "from", b->end[0].at, v->digits);
  json_rational(j, "to", b->end[1].at, v->digits);
}

static void all_json(struct text *out, const struct shown *v) {
  OWNED(json) j = json_of_model(out, v->s);
  along_json(&j, v->l->name, v->l->from, v->l->to, v->digits);
  json_bool(&j, "complete", false);
  json_bool(&j, "spent", v->f->spent);
  JSON_EACH (&j, "bifurcations", i, v->f->n_changes) change_json(&j, v, &v->f->change[i]);
  JSON_EACH (&j, "branches", i, v->f->n_branches) branch_json(&j, v, &v->f->branch[i], i + 1);
}

/* --- Text --- */

static void side_text(struct text *out, const struct mech_side *s) {
  if (!s->found)
    text_add(out, "none found");
  else if (s->own == TRUTH_FALSE)
    text_add(out, "none of the word");
  else
    text_printf(out, "%s, %s", fate_name[s->stable], admissibility_name[s->admissible]);
}

static void change_text(struct text *out, const struct shown *v, const struct mech_change *c) {
  for (int i = 0; i < 2; i++) {
    text_add(out, i ? ", " : "  [");
    print_end(out, v, c, i);
  }
  text_printf(out, "]  branch %d  %s: ", c->branch + 1, mech_turn_id[c->what]);
  side_text(out, side_of(c, false));
  text_add(out, " -> ");
  side_text(out, side_of(c, true));
  for (int i = 0; i < c->n_facts; i++) {
    text_add(out, i ? ", " : "; changed: ");
    mech_fact_print(out, v->m, &c->fact[i], NULL);
  }
  text_add_char(out, '\n');
}

static void branch_text(struct text *out, const struct shown *v, const struct mech_branch *b, int number) {
  text_printf(out, "branch %d, ", number);
  mech_word_print(out, &b->word);
  for (int i = 0; i < 2; i++) {
    text_printf(out, i ? " to " : ": %s from ", v->l->name);
    num_print_rational(out, b->end[i].at, 6);
    text_printf(out, " (period %.6g)", b->end[i].period);
  }
  text_add_char(out, '\n');
}

static void all_text(struct text *out, const struct shown *v) {
  const struct mech_follow *f = v->f;
  along_text(out, v->s, v->l->name, v->l->from, v->l->to, f->n_changes, f->n_branches);
  for (int i = 0; i < f->n_changes; i++) change_text(out, v, &f->change[i]);
  for (int i = 0; i < f->n_branches; i++) branch_text(out, v, &f->branch[i], i + 1);
  text_add(
      out,
      "orbits are looked for at both ends of the line and followed from there; proved are those at both ends of each "
      "bracket, not that there are no other orbits or changes\n");
}

/* --- The command --- */

static int show(const struct options *o, const struct shown *given, const struct mech_word *w, struct diag *d) {
  OWNED(mech_follow) f;
  struct shown v = *given;
  OWNED(text) out = {0};
  progress_begin();
  bool ok = mech_follow(&f, v.l, w->n ? w : NULL, d);
  progress_end();
  v.f = &f;
  if (ok && f.spent)
    fprintf(stderr, "%s: warning: the search ran into its limit; there may be more changes\n", v.s->path);
  if (ok) (option(o, OPT_JSON) ? all_json : all_text)(&out, &v);
  if (ok) {
    print_found(o, &out);
  } else {
    text_printf(&out, "%s: at %s = ", v.s->path, v.l->name);
    num_print_q(&out, f.at);
    fprintf(stderr, "%s:\n", text_str(&out));
  }
  return EXIT_AS_RECORDED;
}

/* How many decimals tell the ends of a bracket apart. */
static int decimals_of(const struct mech_line *l) {
  NUMBERS(fmpq, width);
  fmpq_sub(width, l->from, l->to);
  double wide = fabs(fmpq_get_d(width));
  int decimals = (int)l->digits - (int)floor(log10(wide));
  return decimals > 0 ? decimals : 0;
}

int run_system_bifurcate(const struct options *o, const struct scene *s, const char *data, slong digits,
                         struct diag *d) {
  struct mech_word w;
  LOCAL(scene_range, a);
  OWNED(text) name = {0}, path = {0};
  int status = parse_along(&a, &name, o);
  if (!status) {
    OWNED(mech) m;
    scene_system_path(&path, s->system, data);
    struct mech_line l = {
        text_str(&path), text_str(&name), s->system_value,          {a.from[0]},
        {a.to[0]},       digits,          solved_word_bits(digits), progress_wanted() ? progress_count : NULL};
    struct shown v = {.m = &m, .l = &l, .s = s, .digits = digits, .decimals = decimals_of(&l)};
    if (scene_load_system(&m, &w, s, data, false, d)) status = show(o, &v, &w, d);
  }
  return status;
}
