/* Orbits along a line of one parameter, with the proved brackets of what changes on the way (explore/bifurcate.h).

   along-e2.tsv      the paper's orbit when e2 alone is another, up to where its branch ends or turns back, or the line
                     ends
   bifurcations.tsv  every branch that is found, in the order in which it was followed, through its folds */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "explore/bifurcate.h"
#include "motion/warm.h"
#include "tables.h"
#include "value/printed.h"
#include "value/solved.h"

/* The line of one orbit runs from half of the scene's e2 to three times it. */
enum { SAMPLES = 41, DIGITS = 6, STARTS = 65, DECIMALS = 6, SPOT_DIGITS = 9, STARTS_OF_ALL = 257 };
/* An orbit farther from where it is looked for, in parts of t_b + t_c, may be another. */
#define ASTRAY 1e-3

static const char heading[] =
    " when e2 alone is another: samples, and between them what "
    "changes, each e2 there with two decimals that are proved to enclose it.\n"
    "# From half of the e2 of the scene to three times it, as far as the branch reaches without turning back.\n"
    "# trace is tr J; stable, admissible: at the sample, or just above the change; - where that is not proved, or no "
    "orbit is left.  One that is not admissible solves the equations and is no motion.\n"
    "change\te2\te2_to\ttrace\tperiod\tstable\tadmissible\n";

static void add_state(struct text *body, truth is) {
  text_add(body, is == TRUTH_TRUE ? "\tyes" : is == TRUTH_FALSE ? "\tno" : "\t-");
}

/* Static friction that the scene gives counts as a condition. */
static void add_states(struct text *body, const struct scene *s, const struct dyn_orbit *o) {
  add_state(body, o ? o->stable : TRUTH_UNKNOWN);
  add_state(body, o ? orbit_admissible(NULL, s, o) : TRUTH_UNKNOWN);
}

/* What the rows are written with. */
struct line {
  struct text *body;
  const struct scene *scene;
  fmpq params[N_PARAMS], *at; /* at: the one of them that varies */
  slong digits;               /* of it in a sample */
};

/* How far from t_b and t_c the orbit is, in parts of their sum. */
static double apart(const struct dyn_orbit *o, const double guess[2]) {
  return (fabs(o->guess[PHASE_GAMMA] - guess[0]) + fabs(o->guess[PHASE_H] - guess[1])) / (guess[0] + guess[1]);
}

/* The orbit near t_b and t_c; nothing, and false, where none is proved there. */
static bool add_sample(struct line *l, const double guess[2], bool up) {
  OWNED(dyn_orbit) o;
  truth first = TRUTH_UNKNOWN;
  int status = dyn_orbit_near(&o, &first, l->params, (struct dyn_place){guess[0], guess[1], up}, FIRST_PREC, NULL);
  bool ok = status == SS_OK && first == TRUTH_TRUE && apart(&o, guess) <= ASTRAY;
  if (ok) {
    text_add(l->body, "-\t");
    num_print_rational(l->body, l->at, l->digits);
    text_add(l->body, "\t-");
    table_number(l->body, o.trace, DECIMALS);
    table_number(l->body, o.period, DECIMALS);
    add_states(l->body, l->scene, &o);
  }
  return ok;
}

/* A change, with what the orbit is above it; beside: an orbit at an end of its bracket, whose numbers stand for those
   at the change, or NULL. */
static void add_change(struct text *body, const struct scene *s, const struct dyn_bifurcation *b,
                       const struct dyn_orbit *beside) {
  text_add(body, dyn_change_text[b->what]);
  table_bracket(body, b);
  table_number(body, beside && b->what != CHANGE_FOLD ? beside->trace : b->trace, DECIMALS);
  table_number(body, beside ? beside->period : NULL, DECIMALS);
  const struct dyn_beside *above = &b->beside[1];
  add_states(body, s, above->n == 1 && above->word[0] == TRUTH_TRUE ? &above->orbit[0] : NULL);
}

/* --- Branches --- */

/* A spot, or a change, in its place on its branch: the parameter, t_b and t_c. */
struct place {
  slong branch;
  double place, x[3];
  const struct dyn_bifurcation *change; /* NULL for a spot */
};

static int by_place(const void *x, const void *y) {
  const struct place *a = x, *b = y;
  if (a->branch != b->branch) return a->branch < b->branch ? -1 : 1;
  return (a->place > b->place) - (a->place < b->place);
}

/* All spots and proved changes in order, to be freed. */
static struct place *find_places(size_t *n, const struct dyn_bifurcations *list) {
  struct place *at = ss_malloc((size_t)(list->n_spots + list->n + 1) * sizeof *at);
  *n = 0;
  for (slong i = 0; i < list->n_spots; i++) {
    const struct dyn_spot *s = &list->spot[i];
    at[(*n)++] = (struct place){s->branch, s->place, {s->x[0], s->x[1], s->x[2]}, NULL};
  }
  for (slong i = 0; i < list->n; i++) {
    const struct dyn_bifurcation *b = &list->at[i];
    const double x[3] = {fmpq_get_d(&b->low), num_arb.get_d(b->tb), num_arb.get_d(b->tc)};
    if (b->crosses) at[(*n)++] = (struct place){b->branch, b->place, {x[0], x[1], x[2]}, b};
  }
  qsort(at, *n, sizeof *at, by_place);
  return at;
}

/* --- One orbit --- */

/* Between two places that follow one another: t_b and t_c where e2 is x; false where they are not on both sides of
   it. */
static bool between(double guess[2], const struct place *a, const struct place *b, double x) {
  double part = (x - a->x[0]) / (b->x[0] - a->x[0]);
  for (int k = 0; k < 2; k++) guess[k] = a->x[1 + k] + part * (b->x[1 + k] - a->x[1 + k]);
  return a->branch == b->branch && part >= 0 && part <= 1;
}

/* The place after which the orbit lies on its branch; n where none is found that passes it. */
static size_t find_orbit(const struct place *at, size_t n, const struct dyn_orbit *o, double e2) {
  double guess[2];
  size_t i = 0;
  while (i + 1 < n && !(between(guess, &at[i], &at[i + 1], e2) && apart(o, guess) <= ASTRAY)) i++;
  return i + 1 < n ? i : n;
}

/* Whether the branch goes on from place i to the next, with rising or with falling e2. */
static bool goes_on(const struct place *at, size_t i, size_t n, bool rising) {
  return i + 1 < n && at[i].branch == at[i + 1].branch && (at[i].x[0] < at[i + 1].x[0]) == rising;
}

/* Samples at even distances, and changes, by increasing e2; from the orbit to both sides up to where its branch ends or
   turns back.  A sample within the bracket of a change is left out, since its side is not told by the decimals. */
static void add_sheet(struct line *l, const struct dyn_axis *axis, const struct place *at, size_t n, size_t orbit,
                      bool up) {
  bool rising = at[orbit].x[0] < at[orbit + 1].x[0];
  size_t first = orbit, last = orbit + 1;
  slong k = 0;
  while (first > 0 && goes_on(at, first - 1, n, rising)) first--;
  while (goes_on(at, last, n, rising)) last++;
  for (size_t i = 0; i <= last - first; i++) {
    const struct place *to = rising ? &at[first + i] : &at[last - i], *from = rising ? to - 1 : to + 1;
    for (; i > 0 && k < axis->n; k++) {
      double guess[2];
      dyn_axis_q(l->at, axis, k);
      if (fmpq_get_d(l->at) > to->x[0]) break;
      if (from->change && fmpq_cmp(l->at, &from->change->high) < 0) continue;
      if (between(guess, from, to, fmpq_get_d(l->at)) && add_sample(l, guess, up)) text_add_char(l->body, '\n');
    }
    if (to->change) {
      add_change(l->body, l->scene, to->change, NULL);
      text_add_char(l->body, '\n');
    }
  }
}

void table_along_e2(struct table_source *s) {
  const struct scene *scene = s->j->scene;
  const fmpq *e2 = &scene->value[KEY_E2];
  struct text body = {0};
  struct line l = {.body = &body, .scene = scene, .digits = DIGITS};
  if (!scene_has_forces(scene)) return;
  NUMBERS(fmpq, from, to);
  l.at = table_params(l.params, scene, KEY_E2);
  fmpq_div_2exp(from, e2, 1);
  fmpq_mul_si(to, e2, 3);
  OWNED(dyn_axis) axis;
  dyn_axis_init(&axis, P_E2, from, to, SAMPLES);
  text_add(&body, "# ");
  text_add_capital(&body, usual_orbit_text(s->j, "periodic orbit"));
  text_add(&body, heading);
  struct dyn_line line = {.params = scene->value, .vary = P_E2, .from = from, .to = to};
  OWNED(dyn_bifurcations) list;
  scene_static_friction(line.u_r, scene);
  if (dyn_bifurcations_find(&list, &line, DIGITS, STARTS) == SS_OK) {
    size_t n;
    FREED struct place *at = find_places(&n, &list);
    size_t orbit = find_orbit(at, n, s->orbit, fmpq_get_d(e2));
    if (orbit < n) add_sheet(&l, &axis, at, n, orbit, list.branch[at[orbit].branch].up);
  }
  table_finish(s->j->out, "along-e2.tsv", &body);
  if (!scene_is_example(scene)) s->j->out->tables[s->j->out->n_tables - 1].orbit = usual_orbit_text(s->j, "orbit");
  fmpq_clear(l.at);
}

/* --- Every branch --- */

/* The decimal of SPOT_DIGITS digits next to x. */
static bool set_near(fmpq_t q, double x) {
  char shown[40];
  struct diag d = {0};
  snprintf(shown, sizeof shown, "%.*e", SPOT_DIGITS - 1, x);
  return scene_constant(q, shown, strlen(shown), "a spot", &d);
}

/* At a spot the parameter is made a short decimal, which anybody can ask for again. */
static void add_branches(struct text *body, const struct scene *s, int vary, const struct dyn_bifurcations *list) {
  struct line l = {.body = body, .scene = s, .digits = SPOT_DIGITS};
  size_t n;
  FREED struct place *at = find_places(&n, list);
  l.at = table_params(l.params, s, vary);
  for (size_t i = 0; i < n; i++) {
    const struct dyn_bifurcation *b = at[i].change;
    const struct dyn_beside *side = b ? &b->beside[b->beside[1].n > 0] : NULL;
    if (b)
      add_change(body, s, b, side->n ? &side->orbit[0] : NULL);
    else if (!set_near(l.at, at[i].x[0]) || !add_sample(&l, &at[i].x[1], list->branch[at[i].branch].up))
      continue;
    text_printf(body, "\t%ld\n", (long)at[i].branch + 1);
  }
  fmpq_clear(l.at);
}

int table_of_bifurcations(struct audit_result *out, const struct scene *s, int vary, const fmpq_t from,
                          const fmpq_t to) {
  const char *name = scene_key_name[vary];
  struct dyn_line line = {.params = s->value, .vary = vary, .from = from, .to = to};
  OWNED(dyn_bifurcations) list;
  struct text body = {0};
  scene_static_friction(line.u_r, s);
  text_printf(&body,
              "# The periodic orbits of the word D-Gamma-H-C along %s, branch by branch in the order in which each was "
              "followed: samples, and between them what changes, with two decimals that are proved to enclose %s "
              "there.\n"
              "# trace is tr J, at a change that of an orbit at one end of its bracket; stable, admissible: at the "
              "sample, or just above the change; - where that is not "
              "proved, or no orbit is left.  A branch that begins and ends between two searches can be missing.  "
              "trace and period are numbers, e1, e2 and V lengths in one unit.\n"
              "change\t%s\t%s_to\ttrace\tperiod\tstable\tadmissible\tbranch\n",
              name, name, name, name);
  int status = dyn_bifurcations_find(&list, &line, DIGITS, STARTS_OF_ALL);
  add_branches(&body, s, vary, &list);
  if (list.missed) status |= SS_UNABLE;
  table_finish(out, "bifurcations.tsv", &body);
  return status;
}
