/* stickslip words: which short sequences of phases can happen at a scene's parameters, and which have periodic
   orbits. */
#include <stdlib.h>
#include <string.h>

#include "base/work.h"
#include "word_orbits.h"

enum { STARTS = 96 };
/* In units of work, after which no further word is searched, where the scene says no other: about a minute, whatever
   the parameters. */
static const unsigned long long most_work = 2000000000;

/* What a run over the words holds. */
struct survey {
  const struct scene *scene;
  const fmpq *u_r[2];
  int longest;
  slong digits;
  struct word_seeds seeds;
  struct text rows; /* as text: what was searched */
  struct listed {
    struct text words;
    long more; /* too many to list */
  } unclosed, needs, late;
  struct json *json;
  long possible, searched, with_orbits, orbits, failed;
};

static bool is_searched(const struct survey *v, const struct mech_word *w, enum word_fate fate) {
  unsigned long long budget = v->scene->asked.budget ? v->scene->asked.budget : most_work;
  return fate == WORD_OPEN && !scene_lacks_friction(v->scene, w) && work_units() <= budget;
}

/* Is it the first seed of its word? */
static bool is_first(const struct word_seeds *s, size_t i) {
  for (size_t k = 0; k < i; k++)
    if (mech_word_same(&s->seed[k].word, &s->seed[i].word)) return false;
  return true;
}

/* How many simulations settled on the word. */
static int settled_on(const struct survey *v, const struct mech_word *w) {
  int n = 0;
  for (size_t i = 0; i < v->seeds.n; i++)
    if (mech_word_same(&v->seeds.seed[i].word, w)) n += v->seeds.seed[i].count;
  return n;
}

/* --- JSON --- */

static void row_json(struct survey *v, const struct mech_word *w, enum word_fate fate, const char *why,
                     const struct word_orbits *list, bool searched) {
  struct json *j = v->json;
  const char *told = fate != WORD_OPEN || searched       ? word_fate_name[fate]
                     : scene_lacks_friction(v->scene, w) ? "needs u_r1, u_r2"
                                                         : "budget";
  JSON_OBJECT(j, NULL);
  JSON_STRING(j, "word", phase_word_print(j->out, w));
  json_string(j, "fate", told);
  json_string(j, "reason", fate == WORD_OPEN ? NULL : why);
  json_long(j, "settled", settled_on(v, w));
  json_long(j, "evaluations", list->evaluations);
  json_long(j, "starts", list->found.candidates);
  json_long(j, "unresolved", list->found.failed);
  JSON_EACH (j, "orbits", i, list->found.n) proved_orbit_json(j, &list->found.orbit[i], &list->m, v->scene, v->digits);
}

static void barriers_json(struct json *j) {
  struct mech_word from = {.n = 0}, to;
  json_array(j, "barriers");
  while (phase_word_next(&from, 1))
    for (to.n = 0; phase_word_next(&to, 1);) {
      const char *why = phase_word_barrier(from.phase[0], to.phase[0]);
      if (!why) continue;
      JSON_OBJECT(j, NULL);
      JSON_STRING(j, "from", phase_word_print(j->out, &from));
      JSON_STRING(j, "to", phase_word_print(j->out, &to));
      json_string(j, "reason", why);
    }
  json_end_array(j);
}

static void simulations_json(struct survey *v) {
  struct json *j = v->json;
  JSON_OBJECT(j, "simulations");
  json_long(j, "starts", v->seeds.starts);
  json_long(j, "settled", v->seeds.settled);
  json_bool(j, "own_friction", !v->u_r[0] || !v->u_r[1]);
  JSON_EACH (j, "words", i, v->seeds.n) {
    if (!is_first(&v->seeds, (size_t)i)) continue;
    JSON_OBJECT(j, NULL);
    JSON_STRING(j, "word", phase_word_print(j->out, &v->seeds.seed[i].word));
    json_long(j, "count", settled_on(v, &v->seeds.seed[i].word));
  }
}

/* --- Text --- */

static void add_listed(struct listed *list, const struct mech_word *w) {
  enum { MOST_LISTED = 800 };
  if (list->words.len > MOST_LISTED) {
    list->more++;
    return;
  }
  if (list->words.len > 0) text_add_char(&list->words, ' ');
  phase_word_print(&list->words, w);
}

static void show_listed(struct text *out, const char *what, const struct listed *list) {
  if (list->words.len == 0) return;
  text_printf(out, "%s: %s", what, text_str(&list->words));
  if (list->more > 0) text_printf(out, " and %ld more", list->more);
  text_add_char(out, '\n');
}

static void orbit_line(struct text *out, const struct mech_orbit *o, const struct scene *s, slong digits) {
  text_add(out, "    period ");
  print_known(out, o->period, digits);
  text_printf(out, ", %s, ", fate_name[o->stable]);
  admissible_text(out, o->admissible, s);
  text_add(out, o->certified ? "\n      " : ", not certified\n      ");
  for (int p = 0; p < o->word.n; p++) {
    text_printf(out, "%s%s ", p ? ", " : "", phase_word_name(o->word.phase[p]));
    print_known(out, o->t + p, digits);
  }
  text_add_char(out, '\n');
}

static void row_text(struct survey *v, const struct mech_word *w, enum word_fate fate, const char *why,
                     const struct word_orbits *list, bool searched) {
  struct text *out = &v->rows;
  if (fate == WORD_UNCLOSED) {
    add_listed(&v->unclosed, w);
    return;
  }
  if (fate == WORD_OPEN && !searched) {
    add_listed(scene_lacks_friction(v->scene, w) ? &v->needs : &v->late, w);
    return;
  }
  size_t begin = out->len;
  text_add(out, "  ");
  phase_word_print(out, w);
  while (out->len - begin < 20) text_add_char(out, ' ');
  if (fate == WORD_FAMILY) {
    text_printf(out, " %s\n", why);
    return;
  }
  if (list->found.n == 0)
    text_printf(out, " none found (%ld evaluations, %d starts)", list->evaluations, list->found.candidates);
  else
    text_printf(out, " %d orbit%s", list->found.n, plural_s(list->found.n));
  int settled = settled_on(v, w);
  if (settled > 0) text_printf(out, ", where %d simulation%s", settled, settled == 1 ? " settles" : "s settle");
  if (list->found.failed > 0)
    text_printf(out, "; %d solution%s in double precision could not be enclosed", list->found.failed,
                plural_s(list->found.failed));
  text_add_char(out, '\n');
  for (int i = 0; i < list->found.n; i++) orbit_line(out, &list->found.orbit[i], v->scene, v->digits);
}

static void simulations_text(struct text *out, const struct survey *v) {
  const struct word_seeds *s = &v->seeds;
  text_printf(out, "%d simulations from random starts, u_r1 = %.6g%s, u_r2 = %.6g%s: %d settled", s->starts, s->u_r[0],
              v->u_r[0] ? "" : " (10 (e1 + e2))", s->u_r[1], v->u_r[1] ? "" : " (10 (e1 + e2))", s->settled);
  for (size_t i = 0; i < s->n; i++) {
    if (!is_first(s, i)) continue;
    text_add(out, i ? ", " : ": ");
    phase_word_print(out, &s->seed[i].word);
    text_printf(out, " (%d)", settled_on(v, &s->seed[i].word));
  }
  text_add_char(out, '\n');
}

static long count_words(int longest) {
  long n = 0;
  for (int k = 1; k <= longest; k++) n += phase_word_count(k);
  return n;
}

static void all_text(struct text *out, const struct survey *v) {
  text_printf(out,
              "%s: words of at most %d phases: %ld in all, %ld in which each transition can happen, %ld searched, "
              "%ld with orbits\n",
              v->scene->name, v->longest, count_words(v->longest), v->possible, v->searched, v->with_orbits);
  simulations_text(out, v);
  text_add(out, text_str(&v->rows));
  show_listed(out, "cannot be periodic (a mass is never slower than the belt)", &v->unclosed);
  show_listed(out, "not searched, as a mass is faster than the belt and the scene lacks u_r1, u_r2", &v->needs);
  show_listed(out, "not searched, as the budget of work is used up", &v->late);
  text_add(
      out,
      "gamma, h, c: as Gamma, H, C, but what slips is faster than the belt; X: m_1 slower, m_2 faster; x: conversely\n"
      "none found is no proof that there is none\n");
}

/* --- The survey. --- */

static void one_word(struct survey *v, const struct mech_word *w) {
  OWNED(word_orbits) list = {.evaluations = 0};
  OWNED(text) why = {0};
  enum word_fate fate = phase_word_fate(&why, w);
  bool searched = is_searched(v, w, fate);
  v->possible++;
  if (searched) {
    if (word_orbits_find(&list, w, v->scene->value, v->u_r, &v->seeds, solved_word_bits(v->digits)) != SS_OK)
      abort(); /* the scene is in the domain, and has the friction that the word needs */
    v->searched++;
    v->with_orbits += list.found.n > 0;
    v->orbits += list.found.n;
    v->failed += list.found.failed;
  }
  (v->json ? row_json : row_text)(v, w, fate, text_str(&why), &list, searched);
}

static void all_words(struct survey *v) {
  for (int n = 1; n <= v->longest; n++)
    for (struct mech_word w = {.n = 0}; phase_word_next(&w, n);) one_word(v, &w);
}

static void all_json(struct survey *v, struct text *out) {
  OWNED(json) j = json_document(out, "stickslip-words-1");
  v->json = &j;
  json_string(&j, "scene", v->scene->name);
  json_string(&j, "layer", "model");
  json_long(&j, "longest", v->longest);
  json_long(&j, "canonical", count_words(v->longest));
  json_bool(&j, "complete", false);
  simulations_json(v);
  barriers_json(&j);
  json_array(&j, "words");
  all_words(v);
  json_end_array(&j);
  v->json = NULL;
  JSON_OBJECT(&j, "summary");
  json_long(&j, "possible", v->possible);
  json_long(&j, "searched", v->searched);
  json_long(&j, "with_orbits", v->with_orbits);
  json_long(&j, "orbits", v->orbits);
  json_long(&j, "unresolved", v->failed);
}

static void show_survey(struct survey *v, const struct options *o) {
  struct text out = {0};
  scene_static_friction(v->u_r, v->scene);
  word_seeds_find(&v->seeds, v->scene->value, v->u_r, STARTS);
  if (option(o, OPT_JSON)) {
    all_json(v, &out);
  } else {
    all_words(v);
    all_text(&out, v);
  }
  print_found(o, &out);
  word_seeds_clear(&v->seeds);
  text_clear(&v->late.words);
  text_clear(&v->needs.words);
  text_clear(&v->unclosed.words);
  text_clear(&v->rows);
}

int run_words(const struct options *o, const char *data, struct diag *d) {
  struct survey v = {.scene = NULL};
  long longest = DEFAULT_PHASES;
  int status = parse_digits(&v.digits, o, WORD_DIGITS);
  if (!status) status = parse_count(&longest, o, OPT_LONGEST, MOST_PHASES);
  if (status) return status;
  v.longest = (int)longest;
  OWNED(scene) s;
  v.scene = &s;
  bool ok = load_scene(&s, o->operands.word[0], data, o, SCENE_OF_ANY_SYSTEM, d);
  if (ok && s.system)
    status = run_system_words(o, &s, data, v.longest, v.digits, d);
  else if (ok && scene_one_point(&s, d) && scene_needs_forces(&s, "words", d))
    show_survey(&v, o);
  return status;
}
