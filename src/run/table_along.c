/* Orbits along a line of one parameter, with the proved brackets of what changes on the way (explore/bifurcate.h).

   along-e2.tsv      the paper's orbit when e2 alone is another, up to where its branch ends or the line does
   bifurcations.tsv  every branch that is found, in the order in which it was followed, through its folds */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "explore/bifurcate.h"
#include "motion/warm.h"
#include "tables.h"
#include "value/solved.h"

/* The line runs from BEGIN/STEPS to END/STEPS times the scene's e2; one step in SHOWN is a row. */
enum {
  BEGIN = 128,
  STEPS = 256,
  END = 768,
  SHOWN = 16,
  DIGITS = 6,
  STARTS = 65,
  DECIMALS = 6,
  SPOT_DIGITS = 9,
  STARTS_OF_ALL = 257
};
#define ASTRAY 1e-3

static const char heading[] =
    "# The periodic orbit nearest to the printed numbers when e2 alone is another: samples, and between them what "
    "changes, each e2 there with two decimals that are proved to enclose it.\n"
    "# trace is tr J; stable, admissible: at the sample, or just above the change; - where that is not proved, or no "
    "orbit is left.\n"
    "change\te2\te2_to\ttrace\tperiod\tstable\tadmissible\n";

static const char *const says[N_CHANGES] = {
    [CHANGE_FLIP] = "tr J passes -1",
    [CHANGE_FOLD] = "the solution merges with another one",
    [CHANGE_TA] = "t_a becomes zero",
    [CHANGE_H_V2] = "the second mass reaches the velocity of the belt in the global slip phase",
    [CHANGE_C_W_START] = "the force on the first mass reaches its limit where it begins to stick",
    [CHANGE_C_W_HILL] = "the force on the first mass reaches its limit in the stick-slip phase",
    [CHANGE_U_R1] = "the static friction of the first mass is no longer sufficient",
    [CHANGE_U_R2] = "the static friction of the second mass is no longer sufficient",
    [CHANGE_H_V1] = "the first mass reaches the velocity of the belt earlier in the global slip phase",
    [CHANGE_TC] = "the first mass touches the velocity of the belt at the end of the global slip phase",
    [CHANGE_C_V2] = "both masses reach the velocity of the belt at once",
    [CHANGE_TB] = "t_b becomes zero",
    [CHANGE_GAMMA_V1] = "t_c becomes zero",
    [CHANGE_GAMMA_R] = "the force on the second mass reaches its limit earlier in the slip-stick phase"};

static void add_state(struct text *body, truth is) {
  text_add(body, is == TRUTH_TRUE ? "\tyes" : is == TRUTH_FALSE ? "\tno" : "\t-");
}

/* Static friction that the scene gives counts as a condition. */
static void add_states(struct text *body, const struct scene *s, const struct dyn_orbit *o) {
  truth u[2];
  add_state(body, o ? o->stable : TRUTH_UNKNOWN);
  add_state(body, o ? orbit_admissible(u, s, o) : TRUTH_UNKNOWN);
}

static void add_sample(struct text *body, const struct scene *s, const fmpq_t at, slong digits,
                       const struct dyn_orbit *o) {
  text_add(body, "-\t");
  num_print_rational(body, at, digits);
  text_add(body, "\t-");
  table_number(body, o->trace, DECIMALS);
  table_number(body, o->period, DECIMALS);
  add_states(body, s, o);
}

/* A change, with what the orbit is above it; beside: an orbit at an end of its bracket, whose numbers stand for those at
   the change, or NULL. */
static void add_change(struct text *body, const struct scene *s, const struct dyn_bifurcation *b,
                       const struct dyn_orbit *beside) {
  text_printf(body, "%s\t", says[b->what]);
  num_print_rational(body, &b->low, b->digits);
  text_add_char(body, '\t');
  num_print_rational(body, &b->high, b->digits);
  table_number(body, beside && b->what != CHANGE_FOLD ? beside->trace : b->trace, DECIMALS);
  if (beside)
    table_number(body, beside->period, DECIMALS);
  else
    text_add(body, "\t-");
  const struct dyn_beside *above = &b->beside[1];
  add_states(body, s, above->n == 1 && above->word[0] == TRUTH_TRUE ? &above->orbit[0] : NULL);
}

/* Where the orbit was last, and before that. */
struct walk {
  const struct scene *scene;
  fmpq params[N_PARAMS];
  double tb[2], tc[2];
  bool up, begun; /* begun: what was before is known */
};

static void set_step(fmpq_t e2, const struct walk *w, long i) {
  fmpq_set_si(e2, i, STEPS);
  fmpq_mul(e2, e2, &w->scene->value[KEY_E2]);
}

/* The orbit at step i, beside the last one, to be cleared whatever is answered; false where none is proved there, or
   one so far from where the last two point that it may be another. */
static bool walk_to(struct dyn_orbit *o, struct walk *w, long i) {
  truth first = TRUTH_UNKNOWN;
  double tb = w->begun ? 2 * w->tb[0] - w->tb[1] : w->tb[0], tc = w->begun ? 2 * w->tc[0] - w->tc[1] : w->tc[0];
  set_step(&w->params[P_E2], w, i);
  int status = dyn_orbit_near(o, &first, w->params, tb, tc, w->up, FIRST_PREC, NULL);
  if (status != SS_OK || first != TRUTH_TRUE) return false;
  if (w->begun && fabs(o->guess[1] - tb) + fabs(o->guess[2] - tc) > ASTRAY * (tb + tc)) return false;
  w->tb[1] = w->tb[0];
  w->tc[1] = w->tc[0];
  w->tb[0] = o->guess[1];
  w->tc[0] = o->guess[2];
  w->up = arb_gt(o->z20, o->z10);
  w->begun = true;
  return true;
}

/* Back to the beginning of the line, or as near to it as the orbit can be followed; the step where that is. */
static long walk_back(struct walk *w) {
  bool ok = true;
  long i = STEPS;
  while (ok && i > BEGIN) {
    struct dyn_orbit o;
    ok = walk_to(&o, w, i - 1);
    i -= ok;
    dyn_orbit_clear(&o);
  }
  w->begun = false;
  return i;
}

/* The branch with the orbit at its end; the number of branches where there is none. */
static slong branch_of(const struct dyn_bifurcations *list, const struct walk *w) {
  slong k = 0;
  for (; k < list->n_branches; k++)
    for (int end = 0; end < 2; end++) {
      const double *x = end ? list->branch[k].to : list->branch[k].from;
      if (fabs(x[1] - w->tb[0]) + fabs(x[2] - w->tc[0]) < 1e-6 * (w->tb[0] + w->tc[0])) return k;
    }
  return k;
}

/* Samples and changes by increasing e2. */
static void add_rows(struct text *body, const struct dyn_bifurcations *list, slong branch, struct walk *w, long begin) {
  slong next = 0;
  bool ok = true;
  for (long i = begin; ok && i <= END; i++) {
    struct dyn_orbit o;
    ok = walk_to(&o, w, i);
    for (; next < list->n && (!ok || fmpq_cmp(&list->at[next].low, &w->params[P_E2]) < 0); next++)
      if (list->at[next].branch == branch && list->at[next].crosses) {
        add_change(body, w->scene, &list->at[next], NULL);
        text_add_char(body, '\n');
      }
    if (ok && i % SHOWN == 0) {
      add_sample(body, w->scene, &w->params[P_E2], DIGITS, &o);
      text_add_char(body, '\n');
    }
    dyn_orbit_clear(&o);
  }
}

void table_along_e2(struct table_source *s) {
  const struct scene *scene = s->j->scene;
  const fmpq *const none[2] = {NULL, NULL};
  struct walk w = {scene, .tb = {s->orbit->guess[1]}, .tc = {s->orbit->guess[2]},
                   .up = arb_gt(s->orbit->z20, s->orbit->z10)};
  struct dyn_bifurcations list;
  struct text body;
  fmpq_t from, to;
  if (!scene_has_forces(scene)) return;
  text_init(&body);
  fmpq_init(from);
  fmpq_init(to);
  for (int i = 0; i < N_PARAMS; i++) {
    fmpq_init(&w.params[i]);
    fmpq_set(&w.params[i], &scene->value[i]);
  }
  long begin = walk_back(&w);
  set_step(from, &w, begin);
  set_step(to, &w, END);
  text_add(&body, heading);
  if (dyn_bifurcations_find(&list, scene->value, P_E2, from, to, none, DIGITS, STARTS) == SS_OK)
    add_rows(&body, &list, branch_of(&list, &w), &w, begin);
  table_finish(s->j->out, "along-e2.tsv", &body);
  dyn_bifurcations_clear(&list);
  for (int i = 0; i < N_PARAMS; i++) fmpq_clear(&w.params[i]);
  fmpq_clear(to);
  fmpq_clear(from);
  text_clear(&body);
}

/* --- Every branch --- */

/* A spot, or a change, in its place on its branch. */
struct place {
  slong branch;
  double place;
  const struct dyn_spot *spot;
  const struct dyn_bifurcation *change;
};

static int by_place(const void *x, const void *y) {
  const struct place *a = x, *b = y;
  if (a->branch != b->branch) return a->branch < b->branch ? -1 : 1;
  return (a->place > b->place) - (a->place < b->place);
}

/* The decimal of SPOT_DIGITS digits next to x. */
static bool set_near(fmpq_t q, double x) {
  char shown[40];
  struct diag d;
  diag_init(&d);
  snprintf(shown, sizeof shown, "%.*e", SPOT_DIGITS - 1, x);
  return scene_constant(q, shown, strlen(shown), "a spot", &d);
}

/* The orbit at the spot, once the parameter is a short decimal, which anybody can ask for again. */
static void add_spot(struct text *body, const struct scene *s, fmpq *params, int vary, bool up,
                     const struct dyn_spot *spot) {
  struct dyn_orbit o;
  truth first = TRUTH_UNKNOWN;
  if (!set_near(&params[vary], spot->x[0])) return;
  int status = dyn_orbit_near(&o, &first, params, spot->x[1], spot->x[2], up, FIRST_PREC, NULL);
  if (status == SS_OK && first == TRUTH_TRUE) {
    add_sample(body, s, &params[vary], SPOT_DIGITS, &o);
    text_printf(body, "\t%ld\n", (long)spot->branch + 1);
  }
  dyn_orbit_clear(&o);
}

static void add_branches(struct text *body, const struct scene *s, int vary, const struct dyn_bifurcations *list) {
  size_t n = (size_t)list->n_spots, all = n + (size_t)list->n;
  struct place *at = ss_malloc(all * sizeof *at);
  fmpq params[N_PARAMS];
  for (size_t i = 0; i < all; i++) {
    const struct dyn_spot *spot = i < n ? &list->spot[i] : NULL;
    const struct dyn_bifurcation *b = i < n ? NULL : &list->at[i - n];
    at[i] = (struct place){spot ? spot->branch : b->branch, spot ? spot->place : b->place, spot, b};
  }
  qsort(at, all, sizeof *at, by_place);
  for (int i = 0; i < N_PARAMS; i++) {
    fmpq_init(&params[i]);
    fmpq_set(&params[i], &s->value[i]);
  }
  for (size_t i = 0; i < all; i++) {
    const struct dyn_bifurcation *b = at[i].change;
    if (b && b->crosses) {
      const struct dyn_beside *side = &b->beside[b->beside[1].n > 0];
      add_change(body, s, b, side->n ? &side->orbit[0] : NULL);
      text_printf(body, "\t%ld\n", (long)b->branch + 1);
    } else if (!b) {
      add_spot(body, s, params, vary, list->branch[at[i].branch].up, at[i].spot);
    }
  }
  for (int i = 0; i < N_PARAMS; i++) fmpq_clear(&params[i]);
  free(at);
}

int table_of_bifurcations(struct audit_result *out, const struct scene *s, int vary, const fmpq_t from,
                          const fmpq_t to) {
  const char *name = scene_key_name[vary];
  const fmpq *u[2];
  struct dyn_bifurcations list;
  struct text body;
  scene_static_friction(u, s);
  text_init(&body);
  text_printf(&body,
              "# The periodic orbits of the word D-Gamma-H-C along %s, branch by branch in the order in which each was "
              "followed: samples, and between them what changes, with two decimals that are proved to enclose %s "
              "there.\n"
              "# trace is tr J, at a change that of an orbit at one end of its bracket; stable, admissible: at the "
              "sample, or just above the change; - where that is not "
              "proved, or no orbit is left.  A branch that begins and ends between two searches can be missing.  No "
              "dimensions.\n"
              "change\t%s\t%s_to\ttrace\tperiod\tstable\tadmissible\tbranch\n",
              name, name, name, name);
  int status = dyn_bifurcations_find(&list, s->value, vary, from, to, u, DIGITS, STARTS_OF_ALL);
  add_branches(&body, s, vary, &list);
  if (list.missed) status |= SS_UNABLE;
  table_finish(out, "bifurcations.tsv", &body);
  dyn_bifurcations_clear(&list);
  text_clear(&body);
  return status;
}
