/* Coulomb's law as the text states it, branch by branch, for one mass: at random exact states just one branch may
   apply, and its force must be the law's.

   The law here: a slipping mass is dragged towards the belt's velocity by u_s; one that has it sticks while the
   restoring force is below u_r in size, and else breaks away on the side to which that force pulls it.  The second
   route asks the simulation of coulomb.h for mode and force at the start of a motion. */
#include <math.h>
#include <string.h>

#include "certificate.h"
#include "law.h"
#include "motion/coulomb.h"

static const char *const branch_name[N_BRANCHES] = {"slips", "sticks", "breaks"}; /* attributes of the claim too */

struct tally {
  struct answers said[2]; /* balls, integration */
  const char *where;
  struct certificate at; /* there */
};

/* A state: exact in double. */
struct state {
  double params[N_COULOMB], start[N_STATE], f[2];
  int speed; /* sign of V - x_i' of the mass in question */
};

/* u of the mass, and which branch. */
static double law_force(enum branch *b, const struct state *s, int mass) {
  double f = s->f[mass];
  int eps = s->speed ? s->speed : f > 0 ? 1 : -1;
  *b = s->speed ? SLIPS : fabs(f) < s->params[COULOMB_UR1 + mass] ? STICKS : BREAKS;
  return *b == STICKS ? f : eps * s->params[COULOMB_US1 + mass];
}

/* The same as the simulation has it; NaN when it does not start. */
static double simulated_force(enum branch *b, const struct state *s, int mass) {
  struct coulomb_plan plan = coulomb_plan_default;
  struct coulomb_result end;
  plan.duration = 0;
  if (coulomb_simulate_ode(&end, s->params, s->start, &plan, NULL) != SS_OK) return NAN;
  enum coulomb_mode m = end.at.mode[mass];
  *b = m == MODE_STICK ? STICKS : s->speed ? SLIPS : BREAKS;
  return end.at.u[mass];
}

/* The same for the law as the text has it, in balls. */
static void enter(struct law_state *s, const struct state *at) {
  law_state_open(s, num_ctx_arb(FIRST_PREC));
  struct calc *c = &s->c;
  s->chi = calc_d(c, at->params[COULOMB_CHI]);
  s->eta = calc_d(c, at->params[COULOMB_ETA]);
  s->belt = calc_d(c, at->params[COULOMB_V]);
  for (int i = 0; i < 2; i++) {
    s->x[i] = calc_d(c, at->start[Z_1 + i]);
    s->v[i] = calc_d(c, at->start[DZ_1 + i]);
    s->slide[i] = calc_d(c, at->params[COULOMB_US1 + i]);
    s->limit[i] = calc_d(c, at->params[COULOMB_UR1 + i]);
  }
}

/* What the text has there: the branch that applies, its friction, and whether its heading holds. */
static void certify_text(struct certificate *c, const struct law *l, const struct law_answer *a, truth headed) {
  struct judge *j = l->j;
  certificate_add(c, j->out, "applies",
                  a->n == 1   ? branch_name[a->b]
                  : a->n == 0 ? "none"
                  : a->n > 0  ? "several"
                              : "none with the right side");
  if (a->n == 1) certify_ball(c, j, "left", a->u);
  if (l->headed) certificate_add(c, j->out, "heading", headed == TRUTH_TRUE ? "holds" : "fails");
}

/* Does the text name this branch alone, with the force, and its heading hold just at the belt's velocity?  c gets what
   it has instead. */
static truth text_agrees(struct certificate *c, const struct law *l, const struct state *at, enum branch b,
                         double force, double tolerance) {
  OWNED(law_state) s;
  enter(&s, at);
  struct law_answer a = law_answer(l, &s, at->speed);
  truth headed = l->headed ? law_headed(l, &s) : at->speed == 0 ? TRUTH_TRUE : TRUTH_FALSE;
  bool said = a.n == 1 && a.b == b && fabs(num_arb.get_d(calc_sub(&s.c, a.u, calc_d(&s.c, force)))) <= tolerance;
  bool known = s.c.status == SS_OK && headed != TRUTH_UNKNOWN;
  known = known && (a.n >= 0 || law_denies(l, &s, at->speed, calc_d(&s.c, force)));
  for (int sign = -1; at->speed == 0 && sign <= 1; sign++) {
    s.eps = calc_d(&s.c, sign ? sign : 1);
    known = known && law_holds(l, &s, sign ? BREAKS : STICKS) != TRUTH_UNKNOWN;
  }
  if (!known) return TRUTH_UNKNOWN;
  if (said && (headed == TRUTH_TRUE) == (at->speed == 0)) return TRUTH_TRUE;
  certify_text(c, l, &a, headed);
  return TRUTH_FALSE;
}

static void certify_double(struct certificate *c, struct judge *j, const char *name, double x) {
  NUMBERS(fmpq, q);
  num_q_set_d(q, x);
  certify_exact(c, j, name, q);
}

/* The state, and the friction of the law. */
static void certify_state(struct certificate *c, const struct law *l, const struct state *s, enum branch b,
                          double force) {
  static const char *const of_mass[2][4] = {{"x_1", "x_1'", "u_s1", "u_r1"}, {"x_2", "x_2'", "u_s2", "u_r2"}};
  struct judge *j = l->j;
  certificate_add(c, j->out, "mass", l->mass ? "2" : "1");
  for (int k = COULOMB_CHI; k <= COULOMB_V; k++) certify_double(c, j, name_param[k], s->params[k]);
  for (int i = 0; i < 2; i++) {
    certify_double(c, j, of_mass[i][0], s->start[Z_1 + i]);
    certify_double(c, j, of_mass[i][1], s->start[DZ_1 + i]);
    certify_double(c, j, of_mass[i][2], s->params[COULOMB_US1 + i]);
    certify_double(c, j, of_mass[i][3], s->params[COULOMB_UR1 + i]);
  }
  certificate_add(c, j->out, "branch", branch_name[b]);
  certify_double(c, j, "right", force);
}

/* Limits a sixteenth and less above or below the restoring force where the mass has the belt's velocity. */
static void draw(struct state *s, uint64_t *state, int nth, int mass) {
  double u[8];
  for (int i = 0; i < 8; i++) {
    *state = *state * 6364136223846793005U + 1442695040888963407U;
    u[i] = (double)(1 + (*state >> 33) % 61);
  }
  double belt = u[2] / 16, off = ldexp(1, -4 - 10 * (nth / 4 % 3));
  *s = (struct state){.params = {u[0] / 64, u[1] / 16, belt},
                      .start = {(u[3] - 30.5) / 8, (u[4] - 31.5) / 4},
                      .speed = nth % 4 < 2    ? 0
                               : nth % 4 == 2 ? 1
                                              : -1};
  coulomb_forces(s->f, s->params, s->start);
  for (int i = 0; i < 2; i++) {
    double f = fabs(s->f[i]) + 0.0625 * (s->f[i] == 0);
    s->params[COULOMB_UR1 + i] = f * (nth % 4 == 0 || i != mass ? 1 + off : 1 - off);
    s->params[COULOMB_US1 + i] = s->params[COULOMB_UR1 + i] * u[5 + i] / 64;
    s->start[DZ_1 + i] = belt * (i == mass ? 1 - 0.25 * s->speed : nth % 3 == 0 ? 1 : 0.5);
  }
}

static void try_states(struct tally *n, const struct law *l) {
  enum { STATES = 32 };
  uint64_t state = 1;
  for (int i = 0; i < STATES; i++) {
    struct state s;
    enum branch b;
    draw(&s, &state, i, l->mass);
    for (int route = 0; route < (l->j->effort == EFFORT_REFUTE ? 1 : 2); route++) {
      double force = route ? simulated_force(&b, &s, l->mass) : law_force(&b, &s, l->mass);
      struct certificate text = {.n = 0};
      truth ok = isnan(force) ? TRUTH_UNKNOWN : text_agrees(&text, l, &s, b, force, ldexp(1 + fabs(force), -44));
      if (!isnan(force)) n->said[route].of[ok]++;
      if (ok != TRUTH_FALSE || n->where) continue;
      n->where =
          result_str(l->j->out, "chi = %g, x_1 = %g, x_2 = %g, u_r%d = %g, u_s%d = %g, where the mass %s",
                     s.params[COULOMB_CHI], s.start[Z_1], s.start[Z_2], l->mass + 1, s.params[COULOMB_UR1 + l->mass],
                     l->mass + 1, s.params[COULOMB_US1 + l->mass], branch_name[b]);
      certify_state(&n->at, l, &s, b, force);
      for (int k = 0; k < text.n; k++) certificate_add(&n->at, l->j->out, text.at[k].name, text.at[k].value);
    }
  }
}

/* --- All states --- */

/* Does the text give Coulomb's friction on the whole cell, by the branch that it names for such states alone? */
static bool cell_agrees(const struct law *l, struct law_cell cell) {
  OWNED(law_state) s;
  law_state_open_in(&s, cell);
  bool sticks = cell.pull == PULL_INSIDE;
  val f = law_pull(&s, l->mass), slide = s.slide[l->mass];
  int eps = cell.speed ? cell.speed : cell.side;
  val coulomb = sticks ? f : eps < 0 ? calc_neg(&s.c, slide) : slide;
  struct law_answer a = law_answer(l, &s, cell.speed);
  truth headed = law_headed(l, &s);
  bool ok = a.n == 1 && law_sign(&s, calc_sub(&s.c, a.u, coulomb)) == 0;
  ok = ok && a.b == (cell.speed ? SLIPS : sticks ? STICKS : BREAKS);
  return ok && (!l->headed || headed == (cell.speed ? TRUTH_FALSE : TRUTH_TRUE));
}

/* How many branches apply where f is at a limit; -1: not decided. */
static int at_limit(const struct law *l, int side) {
  OWNED(law_state) s;
  law_state_open_in(&s, (struct law_cell){l->mass, 0, PULL_AT, side});
  return law_answer(l, &s, 0).n;
}

/* The finite split of all states: slower and faster than the belt, and with its velocity inside the limits and beyond
   either; f = +-u_r is left, of which the paper's text may say nothing, but not two things. */
static bool every_cell_agrees(const struct law *l) {
  const struct law_cell cell[] = {{l->mass, 1, PULL_ANY, 1},
                                  {l->mass, -1, PULL_ANY, 1},
                                  {l->mass, 0, PULL_INSIDE, 1},
                                  {l->mass, 0, PULL_BEYOND, 1},
                                  {l->mass, 0, PULL_BEYOND, -1}};
  bool all = true;
  for (size_t i = 0; i < sizeof cell / sizeof *cell; i++) all = all && cell_agrees(l, cell[i]);
  for (int side = -1; side <= 1; side += 2) all = all && at_limit(l, side) >= 0 && at_limit(l, side) <= 1;
  return all;
}

static const char *pull_text(const struct law *l) {
  return l->mass ? "chi (x_2 - x_1)" : "x_1 - chi x_2";
}

static bool prove_law(struct finding *f, const struct law *l) {
  int m = l->mass + 1;
  if (!every_cell_agrees(l)) {
    exact_route(f, l->j->out, ROUTE_UNDECIDED,
                "the signs of the conditions are not shown to be those of Coulomb's law in every case");
    return false;
  }
  const char *note = result_str(
      l->j->out,
      "finite case analysis, exact in each case: with f = %s, one branch alone applies and gives Coulomb's friction "
      "where x'_%d < V (u_s%d), x'_%d > V (-u_s%d), and, at x'_%d = V, where |f| < u_r%d (f), f > u_r%d (u_s%d) and "
      "f < -u_r%d (-u_s%d)",
      pull_text(l), m, m, m, m, m, m, m, m, m, m);
  exact_route(f, l->j->out, ROUTE_AGREES, note);
  return true;
}

/* The law where f is just at a limit.  The correction is that of the text before (11): a mass breaks away
   at its limits too, and nothing else may change. */
static void judge_limits(struct finding *f, struct law *l) {
  static const char *const applies[] = {"no branch applies", "one branch applies", "two branches apply",
                                        "three branches apply"};
  int n[] = {at_limit(l, 1), at_limit(l, -1)}, m = l->mass + 1;
  bool known = n[0] >= 0 && n[1] >= 0, once = n[0] == 1 && n[1] == 1;
  const char *note =
      known ? result_str(l->j->out, "at x'_%d = V, with f = %s, %s where f = u_r%d, and %s where f = -u_r%d", m,
                         pull_text(l), applies[n[0]], m, applies[n[1]], m)
            : "the signs of the conditions are not known";
  struct route_result w = exact_route(f, l->j->out,
                                      once    ? ROUTE_AGREES
                                      : known ? ROUTE_DIFFERS
                                              : ROUTE_UNDECIDED,
                                      note);
  f->verdict = verdict_of(&w, 1, once);
  if (f->verdict != VERDICT_REFUTED) return;
  f->fault = fault_name[FAULT_NOTATION]; /* the text says what is meant */
  l->closed = true;
  bool mended = at_limit(l, 1) == 1 && at_limit(l, -1) == 1 && every_cell_agrees(l);
  f->correction = result_str(l->j->out, ">= in the place of > where the mass breaks away");
  f->correction_verdict = mended ? VERDICT_PROVED : VERDICT_REFUTED;
  exact_route(f, l->j->out, mended ? ROUTE_AGREES : ROUTE_DIFFERS,
              mended ? "with the correction exactly one branch applies in every state"
                     : "with the correction there are states in which no branch or more than one applies");
}

/* The heading is the claim's, or a correction in its place. */
static bool read_heading(struct law *l, const struct claim *c, struct view view) {
  OWNED(reread) in = {.stmt = NULL};
  bool corrected = l->j->instead && !strchr(l->j->instead, ';');
  const char *text = corrected ? l->j->instead : claim_get(c, "heading");
  static const struct statement_record nowhere = {.id = "heading", .section = "", .equation = "", .tex = ""};
  if (!text) return true;
  const struct statement_record *r = reread_open(&in, &nowhere, text, c->id, l->j->d);
  l->headed = r && sentence_from_relations(&l->heading, view, r, NULL, 0, l->j->d);
  if (r && !l->headed) sentence_clear(&l->heading);
  for (slong i = 0; l->headed && i < l->heading.n; i++)
    if (l->heading.ops[i] != REL_EQ)
      return claim_error(l->j, c, "heading", "the belt's velocity is given by an equation");
  return l->headed;
}

/* "u_{si}" for the mass 1 is typed u_s1. */
static void typed_name(char out[16], const char *symbol, size_t n, int mass) {
  size_t k = 0;
  for (size_t i = 0; i < n && k + 1 < 16; i++)
    if (symbol[i] != '{' && symbol[i] != '}' && symbol[i] != ' ') out[k++] = symbol[i];
  if (k && out[k - 1] == 'i') out[k - 1] = mass ? '2' : '1';
  out[k] = '\0';
}

static void read_names(struct law *l) {
  const char *names = l->j->instead, *second = names ? strchr(names, ';') : NULL;
  if (!second) {
    names = "u_si;u_ri";
    second = names + 4;
  }
  typed_name(l->names[0], names, (size_t)(second - names), l->mass);
  typed_name(l->names[1], second + 1, strlen(second + 1), l->mass);
}

bool law_read(struct law *l, struct judge *j, const struct claim *c, struct view view) {
  *l = (struct law){.j = j};
  const char *mass = claim_get(c, "mass");
  bool ok = (mass && (strcmp(mass, "1") == 0 || strcmp(mass, "2") == 0)) || claim_error(j, c, "mass", "1 or 2");
  l->mass = ok && mass[0] == '2';
  for (int b = 0; ok && b < N_BRANCHES; b++) {
    ok = conditions_read(&l->branch[b], j, c, branch_name[b], view);
    if (ok && l->branch[b].n == 0) ok = claim_error(j, c, branch_name[b], "the statements of this branch are needed");
  }
  if (!ok) return false;
  read_names(l);
  OWNED(law_state) s;
  law_state_open_in(&s, (struct law_cell){l->mass, 1, PULL_ANY, 1});
  struct law_answer a = law_answer(l, &s, 1);
  l->slower = a.n == 1 ? a.eps : 0;
  return read_heading(l, c, view);
}

void law_clear(struct law *l) {
  for (int b = 0; b < N_BRANCHES; b++) conditions_clear(&l->branch[b]);
  if (l->headed) sentence_clear(&l->heading);
}

bool judge_law(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  static const char *const route[2] = {"balls", "integration"};
  OWNED(law) l;
  bool limits, ok = law_read(&l, j, c, view) && judge_switch(&limits, j, c, "limits", "yes");
  if (ok && limits) {
    judge_limits(f, &l);
  } else if (ok) {
    struct route_result w[2];
    struct tally n = {.where = NULL};
    try_states(&n, &l);
    bool proved = j->effort != EFFORT_REFUTE && prove_law(f, &l);
    for (int i = 0; i < 2; i++) {
      w[i] = answers_route(route[i], i == 0, &n.said[i]);
      finding_add_route(f, j->out, w[i], layer_name[LAYER_CORRECTED], i ? -1 : FIRST_PREC, i ? NULL : n.where,
                        result_str(j->out,
                                   "at %ld of %ld states, at and beside the belt's velocity, one branch alone "
                                   "applies%s, and gives the friction of the law",
                                   n.said[i].of[TRUTH_TRUE], w[i].trials, l.headed ? ", under its heading" : ""));
    }
    f->verdict = verdict_of(w, 2, proved);
    if (f->verdict == VERDICT_REFUTED) f->certificate = n.at;
  }
  return ok;
}
