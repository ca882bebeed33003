/* along-e2.tsv: the paper's orbit when e2 alone is another, up to where its branch ends or the line does, with the
   proved brackets of what changes on the way (explore/bifurcate.h). */
#include <math.h>

#include "explore/bifurcate.h"
#include "motion/warm.h"
#include "tables.h"

/* The line runs from BEGIN/STEPS to END/STEPS times the scene's e2; one step in SHOWN is a row. */
enum { BEGIN = 128, STEPS = 256, END = 768, SHOWN = 16, DIGITS = 6, STARTS = 65, DECIMALS = 6 };
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
    [CHANGE_U_R1] = "u_r1 is no longer sufficient",
    [CHANGE_U_R2] = "u_r2 is no longer sufficient",
    [CHANGE_H_V1] = "the first mass reaches the velocity of the belt earlier in the global slip phase",
    [CHANGE_TC] = "the first mass touches the velocity of the belt at the end of the global slip phase",
    [CHANGE_C_V2] = "both masses reach the velocity of the belt at once",
    [CHANGE_TB] = "t_b becomes zero",
    [CHANGE_GAMMA_V1] = "t_c becomes zero",
    [CHANGE_GAMMA_R] = "the force on the second mass reaches its limit earlier in the slip-stick phase"};

static void add_state(struct text *body, truth is) {
  text_add(body, is == TRUTH_TRUE ? "\tyes" : is == TRUTH_FALSE ? "\tno" : "\t-");
}

static void add_sample(struct text *body, const fmpq_t e2, const struct dyn_orbit *o) {
  text_add(body, "-\t");
  num_print_rational(body, e2, DIGITS);
  text_add(body, "\t-");
  table_number(body, o->trace, DECIMALS);
  table_number(body, o->period, DECIMALS);
  add_state(body, o->stable);
  add_state(body, o->admissible);
  text_add_char(body, '\n');
}

/* A change, with what the orbit is above it. */
static void add_change(struct text *body, const struct dyn_bifurcation *b) {
  text_printf(body, "%s\t", says[b->what]);
  num_print_rational(body, &b->low, b->digits);
  text_add_char(body, '\t');
  num_print_rational(body, &b->high, b->digits);
  table_number(body, b->trace, DECIMALS);
  text_add(body, "\t-");
  const struct dyn_beside *above = &b->beside[1];
  bool there = above->n == 1 && above->word[0] == TRUTH_TRUE;
  add_state(body, there ? above->orbit[0].stable : TRUTH_UNKNOWN);
  add_state(body, there ? above->orbit[0].admissible : TRUTH_UNKNOWN);
  text_add_char(body, '\n');
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
      if (list->at[next].branch == branch && list->at[next].crosses) add_change(body, &list->at[next]);
    if (ok && i % SHOWN == 0) add_sample(body, &w->params[P_E2], &o);
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
