/* What a motion consists of: the order of its phases, by enclosures along the orbit and by integrating (1)-(2) under
   the Coulomb law; and what cannot be decided from the paper. */
#include <string.h>

#include "certificate.h"
#include "proof/condition.h"
#include "value/coulomb_setup.h"

static struct route_result add(struct finding *f, struct judge *j, struct route_result w, const char *note) {
  return finding_add_route(f, j->out, w, "model", w.decisive ? FIRST_PREC : -1, NULL, note);
}

/* The letters of one period of the Coulomb simulation from the orbit's start; false when it cannot be simulated. */
static bool simulated_word(struct text *word, const struct scene *s, slong orbit) {
  struct coulomb_setup sim;
  struct coulomb_result end;
  if (!coulomb_setup_listed(&sim, s, orbit)) return false;
  text_add_char(word, 'D');
  return coulomb_setup_return(word, &end, &sim, 4) == SS_OK;
}

/* "D Gamma H C" as the simulation spells it, with the phase that begins anew; false where one is no phase.  A period
   may begin with any of its phases: here it begins with the first that there is of D, Gamma, H and C. */
static bool letters_of(char out[16], const char *word) {
  enum { MOST = 14 };
  static const char letter[N_PHASES] = {'D', 'G', 'H', 'C'};
  char name[16];
  int phase[MOST], n = 0, used, first = 0;
  for (; word && n < MOST && sscanf(word, " %15s%n", name, &used) == 1; word += used) {
    phase[n] = word_find(name, phase_name, N_PHASES);
    if (phase[n] == N_PHASES) return false;
    if (phase[n] < phase[first]) first = n;
    n++;
  }
  if (n > 1 && phase[n - 1] == phase[0]) n--; /* the period begins and ends within a phase */
  if (n == 0) return false;
  for (int i = 0; i <= n; i++) out[i] = letter[phase[(first + i) % n]];
  out[n + 1] = '\0';
  return true;
}

static enum route_outcome hold_all(const char **note, struct judge *j, struct conditions *list, const struct point *p) {
  for (int k = 0; k < list->n; k++) {
    truth holds = condition_holds(NULL, NULL, &list->at[k], p, j->cache);
    if (holds == TRUTH_TRUE) continue;
    *note = result_str(j->out, "%s: %s", list->at[k].text, holds == TRUTH_FALSE ? "false" : "undecided");
    return outcome_of_truth(holds);
  }
  return ROUTE_AGREES;
}

/* Every event is proved to be the first of its phase and every condition to hold throughout it, in the model's word. */
static bool is_certified(struct judge *j, const char *letters) {
  const struct dyn_orbit *o = scene_orbit(j->scene, j->cache);
  bool certified = o->admissible == TRUTH_TRUE && strcmp(letters, "DGHCD") == 0;
  for (int ph = 0; ph < N_PHASES; ph++) certified = certified && o->first[ph] == TRUTH_TRUE;
  return certified;
}

bool judge_sequence(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  char letters[16];
  const char *word = claim_get(c, "word");
  OWNED(conditions) list = {.n = 0};
  if (!letters_of(letters, word)) return claim_error(j, c, "word", "the names of phases are needed");
  bool ok = conditions_read(&list, j, c, "constraints", view);
  LOCAL(point, p);
  if (ok && !nearest_orbit_point(&p, j->scene, j->cache)) {
    finding_skip(f, j, "the scene has no orbit, or does not give e1 and e2");
  } else if (ok && !constraints_leave_open(f, j, &list)) {
    struct route_result w[2];
    OWNED(text) got = {0};
    const char *note = NULL;
    enum route_outcome balls = hold_all(&note, j, &list, &p);
    bool certified = is_certified(j, letters);
    if (certified && !note)
      note = "each phase is proved to end at the first of its events, and every condition of Coulomb's law (2) to hold "
             "throughout its phase";
    w[0] = add(f, j, (struct route_result){"balls", balls, true, list.n}, note);
    bool done = j->effort != EFFORT_REFUTE && simulated_word(&got, j->scene, p.orbit);
    bool same = done && strcmp(text_str(&got), letters) == 0;
    note = done ? result_str(j->out, "the phases of one period are %s (%s)", text_str(&got),
                             coulomb_letters_said(text_str(&got)))
                : "the simulation did not come to its end";
    w[1] = add(f, j, counted_route("integration", false, same, done && !same, !done), note);
    /* a motion whose conditions all hold has the phases of the model's word; another word is refuted by the
       comparison */
    if (done && !same && balls == ROUTE_AGREES) w[0] = (struct route_result){"balls", ROUTE_DIFFERS, true, 1};
    f->verdict = verdict_of(w, balls == ROUTE_DIFFERS ? 1 : 2, certified); /* the simulation tells the word alone */
    if (f->verdict == VERDICT_REFUTED) {
      certify_scene(&f->certificate, j);
      certify_orbit(&f->certificate, j, scene_orbit(j->scene, j->cache));
    }
  }
  return ok;
}

/* What cannot be decided from the paper: unknown, with the reason. */
bool judge_outside(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  (void)view;
  const char *why = claim_get(c, "needs");
  if (!why) return claim_error(j, c, "kind", "the attribute needs is missing");
  struct route_result w = {"reading", ROUTE_UNDECIDED, false, 0};
  add(f, j, w, result_str(j->out, "this would require %s", why));
  f->verdict = verdict_of(&w, 1, false);
  return true;
}
