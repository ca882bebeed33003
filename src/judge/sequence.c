/* What a motion consists of: the order of its phases, by enclosures along the orbit and by integrating (1)-(2) under
   the Coulomb law; and whether motions with given times exist at all. */
#include <math.h>
#include <string.h>

#include "base/work.h"
#include "judge.h"
#include "motion/given.h"
#include "num/calc.h"
#include "proof/condition.h"
#include "value/coulomb_setup.h"

enum { UNITS_OF_EXISTENCE = 150000 }; /* of work: all motions with two times given */

static struct route_result add(struct finding *f, struct judge *j, struct route_result w, const char *note) {
  return finding_add_route(f, j->out, w, "model", w.decisive ? FIRST_PREC : -1, NULL, note);
}

/* --- The order of the phases --- */

/* The letters of one period of the Coulomb simulation from the orbit's start; false when it cannot be simulated. */
static bool simulated_word(struct text *word, const struct scene *s, slong orbit) {
  struct coulomb_setup sim;
  struct coulomb_result end;
  if (!coulomb_setup_listed(&sim, s, orbit)) return false;
  text_add_char(word, 'D');
  return coulomb_setup_return(word, &end, &sim, 4) == SS_OK;
}

/* The phases that a text names, at most so many of them; how many, 0 where one is no phase. */
static int read_phases(enum phase *phase, int most, const char *text) {
  char name[16];
  int n = 0, used;
  for (; text && n < most && sscanf(text, " %15s%n", name, &used) == 1; text += used) {
    int ph = word_find(name, phase_name, N_PHASES);
    if (ph == N_PHASES) return 0;
    phase[n++] = (enum phase)ph;
  }
  return n;
}

/* "D Gamma H C" as the simulation spells it, with the phase that begins anew. */
static bool letters_of(char out[16], const char *word) {
  enum { MOST = 14 };
  static const char letter[N_PHASES] = {'D', 'G', 'H', 'C'};
  enum phase phase[MOST];
  int n = read_phases(phase, MOST, word);
  for (int i = 0; i < n; i++) out[i] = letter[phase[i]];
  if (n == 0) return false;
  out[n] = out[0];
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
  struct conditions list = {.n = 0};
  struct point p;
  if (!letters_of(letters, word)) return claim_error(j, c, "word", "the names of phases are needed");
  bool ok = conditions_read(&list, j, c, "conditions", view);
  point_init(&p);
  if (ok && !nearest_orbit_point(&p, j->scene, j->cache)) {
    finding_skip(f, j, "the scene has no orbit, or does not give e1 and e2");
  } else if (ok) {
    struct route_result w[2];
    struct text got = {0};
    const char *note = NULL;
    enum route_outcome balls = hold_all(&note, j, &list, &p);
    bool certified = is_certified(j, letters);
    if (certified && !note)
      note = "each phase is proved to end at the first of its events, and every condition of Coulomb's law (2) to hold "
             "throughout its phase";
    w[0] = add(f, j, (struct route_result){"balls", balls, true, list.n}, note);
    bool done = j->effort != EFFORT_REFUTE && simulated_word(&got, j->scene, p.orbit);
    bool same = done && strcmp(text_str(&got), letters) == 0;
    note = done ? result_str(
                      j->out,
                      "the phases of one period are %s (D, G, H, C: global stick, slip-stick, global slip, stick-slip)",
                      text_str(&got))
                : "the simulation did not come to its end";
    w[1] = add(f, j, counted_route("integration", false, same, done && !same, !done), note);
    /* a motion whose conditions all hold has the phases of the model's word; another word is refuted by the
       comparison */
    if (done && !same && balls == ROUTE_AGREES) w[0] = (struct route_result){"balls", ROUTE_DIFFERS, true, 1};
    f->verdict = verdict_of(w, balls == ROUTE_DIFFERS ? 1 : 2, certified); /* the simulation tells the word alone */
    text_clear(&got);
  }
  point_clear(&p);
  conditions_clear(&list);
  return ok;
}

/* --- Motions of given times --- */

/* "t_a = 0, t_b = 2". */
static bool read_given(enum dyn_quantity which[2], fmpq value[2], const char *text) {
  for (int i = 0; i < 2; i++) {
    char name[8], number[24];
    int used;
    if (!text || sscanf(text, " %7[a-z_0-9] = %23[0-9./]%n", name, number, &used) != 2) return false;
    text += used;
    while (*text == ',' || *text == ' ') text++;
    int k = word_find(name, dyn_quantity_id, N_QUANTITIES);
    if (k == N_QUANTITIES || num_parse_decimal(&value[i], number, strlen(number)) != SS_OK) return false;
    which[i] = (enum dyn_quantity)k;
  }
  return true;
}

/* Does the state return, carried through the given phases over the orbit's times?  By closed forms or exponentials. */
static truth returns(const struct judge *j, const struct dyn_orbit *o, const enum phase *through, int n, bool closed) {
  struct num_ctx ctx = num_ctx_arb(FIRST_PREC);
  struct calc c = calc_begin(ctx);
  struct num_vec params = calc_vec(&c, N_PARAMS), m = calc_vec(&c, 16), z = calc_vec(&c, 4), start = calc_vec(&c, 4);
  int s = SS_OK;
  for (int i = 0; i < 3; i++) s |= ctx.type->set_q(num_vec_at(&params, i), &j->scene->value[i], ctx.prec);
  arb_set(num_vec_at(&params, P_E1), o->e1);
  arb_set(num_vec_at(&params, P_E2), o->e2);
  arb_set(num_vec_at(&start, 0), o->z10);
  arb_set(num_vec_at(&start, 1), o->z20);
  for (int i = 2; i < 4; i++) arb_set(num_vec_at(&start, i), num_vec_at(&params, P_V));
  num_vec_set(&z, &start);
  for (int i = 0; i < n; i++) {
    if (closed) {
      s |= dyn_flow(&z, through[i], &params, &z, o->t + (int)through[i]);
    } else {
      s |= dyn_propagator(&m, through[i], &params, o->t + (int)through[i]);
      s |= num_mat_mul(&z, &m, &z, 4, 4, 1);
    }
  }
  truth back = s == SS_OK ? TRUTH_TRUE : TRUTH_UNKNOWN;
  for (int i = 0; s == SS_OK && i < 4; i++)
    if (!arb_overlaps(num_vec_at(&z, i), num_vec_at(&start, i))) back = TRUTH_FALSE;
  /* A solution that is no motion shows nothing.  Without phase D, t_a = 0, the force is e_1 where phase C ends. */
  bool sticks = false;
  for (int i = 0; i < n; i++) sticks = sticks || through[i] == PHASE_D;
  for (int k = 0; k < N_CONDITIONS; k++)
    if (sticks || (k != COND_TA && k != COND_D_R && k != COND_C_W))
      back = truth_and(back, o->holds[k] == TRUTH_TRUE ? TRUTH_TRUE : TRUTH_UNKNOWN);
  calc_clear(&c);
  return back;
}

static struct route_result add_returns(struct finding *f, struct judge *j, const struct dyn_orbits *list,
                                       const enum phase *through, int n, bool closed) {
  struct answers back = {{0}};
  for (slong i = 0; i < list->n; i++) back.of[returns(j, &list->orbit[i], through, n, closed)]++;
  const struct dyn_orbit *o = list->n ? &list->orbit[0] : NULL;
  const char *note =
      o ? result_str(j->out,
                     "%ld found for chi, eta and V of %s, %sproved to exist; the state returns, and the conditions of "
                     "the phases are kept, for %ld of %ld; %s t_a = %s, t_b = %s, t_c = %s, t_d = %s, e1 = %s, e2 = %s",
                     (long)list->n, scene_data_of(j->scene), list->n == 1 ? "" : "each ", back.of[TRUTH_TRUE],
                     (long)list->n, list->n == 1 ? "it has" : "the first has", ball_text(j, o->t[0], 6),
                     ball_text(j, o->t[1], 6), ball_text(j, o->t[2], 6), ball_text(j, o->t[3], 6),
                     ball_text(j, o->e1, 6), ball_text(j, o->e2, 6))
        : "none was found; the search is not exhaustive";
  back.of[TRUTH_UNKNOWN] += !o;
  if (back.of[TRUTH_TRUE]) back.of[TRUTH_FALSE] = back.of[TRUTH_UNKNOWN] = 0; /* one is enough */
  struct route_result w = answers_route(closed ? "balls" : "exponential", closed, &back);
  w.trials = list->n;
  return add(f, j, w, note);
}

bool judge_existence(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  (void)view;
  enum dyn_quantity which[2];
  enum phase through[N_PHASES];
  fmpq value[2];
  struct dyn_orbits list;
  if (scene_is_box(j->scene)) {
    finding_skip(f, j, "the scene gives intervals");
    return true;
  }
  for (int i = 0; i < 2; i++) fmpq_init(&value[i]);
  int n = read_phases(through, N_PHASES, claim_get(c, "through"));
  bool ok = n > 0 || claim_error(j, c, "through", "the names of phases are needed");
  ok = ok && (read_given(which, value, claim_get(c, "given")) ||
              claim_error(j, c, "given", "reads NAME = VALUE, NAME = VALUE"));
  if (ok) {
    struct route_result w[2];
    work_add(UNITS_OF_EXISTENCE);
    dyn_orbits_given(&list, j->scene->value, which, value, FIRST_PREC, &dyn_given_limits);
    w[0] = add_returns(f, j, &list, through, n, true);
    w[1] = add_returns(f, j, &list, through, n, false);
    f->verdict = verdict_of(w, 2, true); /* one enclosed solution proves that there is one */
    dyn_orbits_clear(&list);
  }
  for (int i = 0; i < 2; i++) fmpq_clear(&value[i]);
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
