/* Other sequences of phases. */
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "library.h"

enum { MOST_DIGITS = 1000, LONGEST = 8 };

/* The numbers of one orbit. */
struct numbers {
  struct ss_number t[WORD_MOST], state[WORD_MOST * N_STATE], jacobian[WORD_FREE_MOST * WORD_FREE_MOST], period;
};

struct ss_word_orbits {
  struct word_orbits list;
  struct numbers *number;
};

static int read_word(struct mech_word *w, const char *text) {
  const char *why;
  size_t at;
  if (phase_word_parse(w, &at, &why, text, strlen(text))) return SS_OK;
  return library_fail(SS_INPUT, "word:1:%zu: error: %s", at + 1, why);
}

int ss_word_fate(enum ss_fate *fate, char **why, const char *word) {
  struct mech_word w;
  OWNED(text) t = {0};
  if (why) *why = NULL;
  if (!fate || !word) return library_argument(__func__, "no word, or no place for its fate");
  int status = read_word(&w, word);
  if (status) return status;
  *fate = (enum ss_fate)phase_word_fate(&t, &w);
  if (*fate == SS_OPEN) text_reset(&t);
  if (why) *why = library_take(&t);
  return SS_OK;
}

int ss_word_each(int longest, int (*f)(void *self, const char *word), void *self) {
  if (!f || longest < 1 || longest > LONGEST) return library_argument(__func__, "no function to tell, or not 1 to 8");
  OWNED(text) t = {0};
  bool on = true;
  for (int n = 1; n <= longest && on; n++)
    for (struct mech_word w = {.n = 0}; on && phase_word_next(&w, n);) {
      text_reset(&t);
      phase_word_print(&t, &w);
      on = f(self, text_str(&t)) != 0;
    }
  return on ? SS_OK : library_fail(SS_STOPPED, "%s: stopped by the caller", __func__);
}

/* The word that is asked for, whose orbits can be searched for at the scene; an SS_ status. */
static int open_word(struct mech_word *w, const struct ss_scene *s, const char *word) {
  OWNED(text) why = {0};
  *w = s->s.word;
  int status = word || w->n == 0 ? read_word(w, word ? word : "D Gamma H C") : SS_OK;
  if (!status) status = library_point(s, false, true);
  if (status) return status;
  if (phase_word_fate(&why, w) != WORD_OPEN) return library_fail(SS_DOMAIN, "%s", text_str(&why));
  if (scene_lacks_friction(&s->s, w))
    return library_fail(SS_INPUT, "%.300s: error: a word in which a mass is faster than the belt needs u_r1 and u_r2",
                        s->s.path);
  return SS_OK;
}

static void borrow(struct ss_word_orbits *o) {
  o->number = ss_malloc((size_t)(o->list.found.n + 1) * sizeof *o->number);
  for (int k = 0; k < o->list.found.n; k++) {
    const struct mech_orbit *w = &o->list.found.orbit[k];
    struct numbers *x = &o->number[k];
    for (int i = 0; i < w->word.n; i++) x->t[i] = (struct ss_number){w->t + i, NULL};
    for (int i = 0; i < w->word.n * N_STATE; i++) x->state[i] = (struct ss_number){w->state + i, NULL};
    for (int i = 0; i < w->n_free * w->n_free; i++) x->jacobian[i] = (struct ss_number){w->jacobian->entries + i, NULL};
    x->period = (struct ss_number){w->period, NULL};
  }
}

int ss_word_orbits_find(ss_word_orbits **out, const ss_scene *s, const char *word, size_t digits) {
  struct mech_word w;
  if (!out) return library_argument(__func__, "no place for the orbits");
  *out = NULL;
  if (!s) return library_argument(__func__, "no scene");
  int status = library_digits(__func__, digits, MOST_DIGITS);
  if (!status) status = open_word(&w, s, word);
  if (status) return status;
  struct ss_word_orbits *o = ss_malloc(sizeof *o);
  status = solved_word(&o->list, &w, &s->s, (slong)digits);
  borrow(o);
  *out = o;
  if (!status) return SS_OK;
  *out = NULL;
  ss_word_orbits_free(o);
  return library_fail(status, "%s: the search failed", s->s.name);
}

void ss_word_orbits_free(ss_word_orbits *o) {
  if (!o) return;
  free(o->number);
  word_orbits_clear(&o->list);
  free(o);
}

static const struct mech_orbit *orbit_of(const struct ss_word_orbits *o, size_t k) {
  return o && k < (size_t)o->list.found.n ? &o->list.found.orbit[k] : NULL;
}

size_t ss_word_orbits_count(const ss_word_orbits *o) {
  return o ? (size_t)o->list.found.n : 0;
}

size_t ss_word_orbits_phases(const ss_word_orbits *o) {
  return o ? (size_t)o->list.word.n : 0;
}

static bool has_phase(const struct ss_word_orbits *o, size_t k, size_t i) {
  return orbit_of(o, k) && i < (size_t)o->list.word.n;
}

const char *ss_word_orbit_phase(const ss_word_orbits *o, size_t k, size_t i) {
  return has_phase(o, k, i) ? phase_word_name(o->list.word.phase[i]) : NULL;
}

const ss_number *ss_word_orbit_time(const ss_word_orbits *o, size_t k, size_t i) {
  return has_phase(o, k, i) ? &o->number[k].t[i] : NULL;
}

const ss_number *ss_word_orbit_state(const ss_word_orbits *o, size_t k, size_t i, int coordinate) {
  bool there = has_phase(o, k, i) && coordinate >= 0 && coordinate < N_STATE;
  return there ? &o->number[k].state[i * N_STATE + (size_t)coordinate] : NULL;
}

const ss_number *ss_word_orbit_period(const ss_word_orbits *o, size_t k) {
  return orbit_of(o, k) ? &o->number[k].period : NULL;
}

int ss_word_orbit_free_coordinates(const ss_word_orbits *o, size_t k) {
  return orbit_of(o, k) ? o->list.found.orbit[k].n_free : 0;
}

const char *ss_word_orbit_free_coordinate(const ss_word_orbits *o, size_t k, int i) {
  static const char *const coordinate[N_STATE] = {"x1", "x2", "v1", "v2"};
  bool there = i >= 0 && i < ss_word_orbit_free_coordinates(o, k);
  return there ? coordinate[o->list.found.orbit[k].free[i]] : NULL;
}

const ss_number *ss_word_orbit_jacobian(const ss_word_orbits *o, size_t k, int row, int column) {
  int n = ss_word_orbit_free_coordinates(o, k);
  return row >= 0 && row < n && column >= 0 && column < n ? &o->number[k].jacobian[row * n + column] : NULL;
}

enum ss_truth ss_word_orbit_stable(const ss_word_orbits *o, size_t k) {
  return orbit_of(o, k) ? (enum ss_truth)o->list.found.orbit[k].stable : SS_UNKNOWN;
}

enum ss_truth ss_word_orbit_admissible(const ss_word_orbits *o, size_t k) {
  return orbit_of(o, k) ? (enum ss_truth)o->list.found.orbit[k].admissible : SS_UNKNOWN;
}

int ss_word_orbit_certified(const ss_word_orbits *o, size_t k) {
  return orbit_of(o, k) && o->list.found.orbit[k].certified;
}
