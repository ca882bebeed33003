/* Coulomb's law, and the bookkeeping that both routes of a simulation share.

   The law is a function of signs alone, so that every number type and every route decides by the same few lines.  A run
   alternates between two steps: a route moves to the next event of the present pair of modes, and the law says what
   the modes are from then on. */
#include "coulomb.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/work.h"
#include "coulomb_impl.h"
#include "flow.h"

enum { MOST_IDLE = 16, MOST_UNCHANGED = 1000 };

const char *const coulomb_end_name[] = {
    "done",
    "its receiver asked for no more",
    "no event will come",
    "its budget of events is used up",
    "its budget of steps is used up",
    "changes without end at one instant",
    "the static friction exceeds the sliding friction by less than the rounding of the state",
    "the integrator gives up, or a number is too large"};
const struct coulomb_plan coulomb_plan_default = {INFINITY, 0, 0, 1000000, 1000000, 1e-13};

const char coulomb_mode_letter[N_MODES] = {[MODE_STICK] = 's', [MODE_BELOW] = '-', [MODE_ABOVE] = '+'};

char coulomb_letter(const enum coulomb_mode mode[2]) {
  static const char letter[N_MODES][N_MODES] = {{'D', 'C', 'c'}, {'G', 'H', 'X'}, {'g', 'x', 'h'}};
  return letter[mode[0]][mode[1]];
}

const char *coulomb_letters_said(const char *word) {
  return strpbrk(word, "cgxXh")
             ? "D, G, H, C: global stick, slip-stick, global slip, stick-slip; c, g, h, x, X: a mass "
               "is faster than the belt"
             : "D, G, H, C: global stick, slip-stick, global slip, stick-slip";
}

/* Whether |f_1| at its limit is about to exceed it while m1 sticks: f_1' = V - chi x_2'; where that is zero x_2' is
   above V, so that f_1'' = chi eta (u_s2 + f_2); where that is zero too, f_1''' = chi^2 eta (x_2' - V) > 0. */
static bool exceeds_1(const struct coulomb_signs *s) {
  int rise = s->lead ? s->lead : s->drag ? s->drag : 1;
  return rise * s->pull[0] > 0;
}

/* The same for m2: f_2' = chi (V - x_1'); where x_1' = V, f_2'' = -chi x_1'', and m1 leaves V to the side of its mode
   or not at all, when f_2 is constant. */
static bool exceeds_2(const struct coulomb_signs *s, enum coulomb_mode first) {
  int leaving = first == MODE_BELOW ? 1 : first == MODE_ABOVE ? -1 : 0;
  int rise = s->speed[0] ? -s->speed[0] : leaving;
  return rise * s->pull[1] > 0;
}

static void coulomb_law(enum coulomb_mode mode[2], const struct coulomb_signs *s) {
  for (int i = 0; i < 2; i++) {
    bool loose = s->excess[i] > 0;
    if (s->speed[i] == 0 && s->excess[i] == 0) loose = i == 0 ? exceeds_1(s) : exceeds_2(s, mode[0]);
    if (s->speed[i] != 0)
      mode[i] = s->speed[i] < 0 ? MODE_BELOW : MODE_ABOVE;
    else
      mode[i] = !loose ? MODE_STICK : s->pull[i] > 0 ? MODE_BELOW : MODE_ABOVE;
  }
}

double coulomb_scale(const double p[N_COULOMB], const double z[N_STATE]) {
  return fabs(z[Z_1]) + fabs(z[Z_2]) + p[COULOMB_V];
}

static int sign(double x, double tol) {
  return (x > tol) - (x < -tol);
}

void coulomb_signs_d(struct coulomb_signs *s, const double p[N_COULOMB], const double z[N_STATE], double tol) {
  double f[2];
  coulomb_forces(f, p, z);
  for (int i = 0; i < 2; i++) {
    s->speed[i] = sign(z[DZ_1 + i] - p[COULOMB_V], tol);
    s->pull[i] = sign(f[i], 0);
    s->excess[i] = sign(fabs(f[i]) - p[COULOMB_UR1 + i], tol);
  }
  s->lead = s->speed[1] == 0 ? 1 : sign(p[COULOMB_V] - p[COULOMB_CHI] * z[DZ_2], tol); /* chi V < V */
  s->drag = sign(f[1] + p[COULOMB_US2], tol);
}

void coulomb_law_d(enum coulomb_mode mode[2], const double p[N_COULOMB], const double z[N_STATE]) {
  struct coulomb_signs s;
  coulomb_signs_d(&s, p, z, 0);
  coulomb_law(mode, &s);
}

/* --- A run. --- */

bool run_domain(const double p[N_COULOMB], const double start[N_STATE], const struct coulomb_plan *plan) {
  for (int i = 0; i < N_COULOMB; i++)
    if (!isfinite(p[i])) return false;
  for (int i = 0; i < N_STATE; i++)
    if (!isfinite(start[i])) return false;
  for (int i = 0; i < 2; i++)
    if (!(p[COULOMB_US1 + i] >= 0 && p[COULOMB_US1 + i] < p[COULOMB_UR1 + i])) return false;
  if (!(p[COULOMB_CHI] > 0 && p[COULOMB_CHI] < 1 && p[COULOMB_ETA] > 0 && p[COULOMB_V] > 0)) return false;
  if (!(plan->duration >= 0 && plan->sample >= 0 && plan->returns >= 0)) return false;
  return isfinite(plan->duration) || plan->returns > 0;
}

void run_init(struct coulomb_run *run, const double p[N_COULOMB], double tol) {
  for (int i = 0; i < 2; i++) {
    run->us[i] = p[COULOMB_US1 + i];
    run->blurred[i] = isfinite(tol) && p[COULOMB_UR1 + i] - p[COULOMB_US1 + i] <= tol;
  }
}

static void fill_row(struct coulomb_run *run, struct coulomb_row *row, double t) {
  run->route.row(run->route.self, row, t);
  for (int i = 0; i < 2; i++) {
    row->mode[i] = run->mode[i];
    if (run->mode[i] != MODE_STICK) row->u[i] = run->mode[i] == MODE_BELOW ? run->us[i] : -run->us[i];
  }
}

bool run_samples(struct coulomb_run *run, double t, bool last) {
  double step = run->plan->sample;
  if (!(step > 0)) return true;
  double end = last ? t * (1 + 1e-12) : t; /* the last of many steps may miss the duration by rounding */
  for (; run->next * step < end || (last && run->next * step == end); run->next++) {
    struct coulomb_row row;
    fill_row(run, &row, fmin(run->next * step, t));
    if (run->sink && run->sink->sample && !run->sink->sample(run->sink->self, &row)) return false;
  }
  return true;
}

/* Lets the law decide, where it can be told. */
static bool decide(struct coulomb_run *run) {
  struct coulomb_signs s;
  run->route.signs(run->route.self, &s);
  for (int i = 0; i < 2; i++)
    if (run->blurred[i] && s.speed[i] == 0 && s.excess[i] == 0) return false;
  coulomb_law(run->mode, &s);
  return true;
}

/* Reports what the law changes.  COULOMB_DONE: nothing speaks against going on. */
static enum coulomb_end change_modes(struct coulomb_run *run) {
  enum coulomb_mode before[2] = {run->mode[0], run->mode[1]};
  if (!decide(run)) return COULOMB_BLURRED;
  bool changes[2] = {run->mode[0] != before[0], run->mode[1] != before[1]}, both = changes[0] && changes[1];
  bool back = (changes[0] || changes[1]) && run->mode[0] == MODE_STICK && run->mode[1] == MODE_STICK;
  run->result->returns += back;
  for (int i = 0; i < 2; i++) {
    if (!changes[i]) continue;
    struct coulomb_event e = {.mass = i,
                              .from = before[i],
                              .to = run->mode[i],
                              .simultaneous = both,
                              .returns = back && (i == 1 || !both),
                              .grazing = run->grazing[i]};
    run->result->events++;
    fill_row(run, &e.at, run->route.time(run->route.self));
    if (run->sink && run->sink->event && !run->sink->event(run->sink->self, &e)) return COULOMB_STOPPED;
  }
  return COULOMB_DONE;
}

static enum coulomb_end run_loop(struct coulomb_run *run) {
  static const enum coulomb_end after[] = {
      [MOVE_END] = COULOMB_DONE,      [MOVE_QUIET] = COULOMB_QUIET,     [MOVE_BUDGET] = COULOMB_STEPS,
      [MOVE_FAILED] = COULOMB_FAILED, [MOVE_STOPPED] = COULOMB_STOPPED,
  };
  const struct coulomb_plan *plan = run->plan;
  if (!decide(run)) return COULOMB_BLURRED;
  for (int idle = 0, unchanged = 0; idle <= MOST_IDLE && unchanged <= MOST_UNCHANGED;) {
    long events = run->result->events;
    double before = run->route.time(run->route.self);
    run->grazing[0] = run->grazing[1] = false;
    enum move move = run->route.move(run->route.self, run);
    if (move != MOVE_EVENT) return after[move];
    enum coulomb_end changed = change_modes(run);
    if (changed != COULOMB_DONE) return changed;
    if (plan->returns > 0 && run->result->returns >= plan->returns) return COULOMB_DONE;
    if (run->result->events >= plan->max_events) return COULOMB_EVENTS;
    idle = run->route.time(run->route.self) > before ? 0 : idle + 1;
    unchanged = run->result->events > events ? 0 : unchanged + 1;
  }
  return COULOMB_STUCK;
}

/* What a simulation counts as: nothing that hangs on the rounding of its steps. */
enum { UNITS = 5000 };

int run_all(struct coulomb_run *run) {
  work_touch(WORK_SIMULATION);
  work_add(UNITS);
  struct coulomb_result *r = run->result;
  *r = (struct coulomb_result){.end = COULOMB_DONE};
  r->end = run_loop(run);
  fill_row(run, &r->at, run->route.time(run->route.self));
  r->at.exact = NULL;
  return r->end == COULOMB_DONE || r->end == COULOMB_STOPPED ? SS_OK : SS_UNABLE;
}

/* --- From the model's parameters. --- */

int coulomb_params_set(struct num_vec *params, const struct num_vec *model, const struct num_vec *limits) {
  const struct num_type *type = params->ctx.type;
  double p[N_COULOMB], nowhere[N_STATE] = {0};
  int status = SS_OK;
  for (int i = 0; i < 3; i++) type->set(num_vec_at(params, COULOMB_CHI + i), num_vec_at(model, P_CHI + i));
  for (int i = 0; i < 2; i++) {
    type->set(num_vec_at(params, COULOMB_UR1 + i), num_vec_at(limits, i));
    status |= type->sub(num_vec_at(params, COULOMB_US1 + i), num_vec_at(limits, i), num_vec_at(model, P_E1 + i),
                        params->ctx.prec);
  }
  for (int i = 0; i < N_COULOMB; i++) p[i] = type->get_d(num_vec_at(params, i));
  struct coulomb_plan plan = {.duration = 0};
  return run_domain(p, nowhere, &plan) ? status : status | SS_DOMAIN;
}

int coulomb_start_set(struct num_vec *start, const struct num_vec *params, const void *z10, const void *z20) {
  OWNED(calc) c = calc_begin(start->ctx);
  val p[N_COULOMB];
  flow_vals(p, params, 0, N_COULOMB);
  /* d_1 - chi d_2 = u_s1 and chi (d_2 - d_1) = u_s2. */
  val span = calc_sub(&c, calc_d(&c, 1), p[COULOMB_CHI]);
  val d1 = calc_div(&c, calc_add(&c, p[COULOMB_US1], p[COULOMB_US2]), span);
  val x1 = calc_add(&c, z10, d1);
  val x2 = calc_add(&c, z20, calc_add(&c, d1, calc_div(&c, p[COULOMB_US2], p[COULOMB_CHI])));
  start->ctx.type->set(num_vec_at(start, Z_1), x1);
  start->ctx.type->set(num_vec_at(start, Z_2), x2);
  for (int i = 0; i < 2; i++) start->ctx.type->set(num_vec_at(start, DZ_1 + i), p[COULOMB_V]);
  return c.status;
}

/* --- Sinks. --- */

void coulomb_log_clear(struct coulomb_log *log) {
  free(log->event);
  *log = (struct coulomb_log){.n = 0};
}

static bool log_event(void *self, const struct coulomb_event *e) {
  struct coulomb_log *log = self;
  log->event = ss_grow(log->event, log->n, &log->cap, sizeof *log->event);
  log->event[log->n] = *e;
  log->event[log->n++].at.exact = NULL;
  return true;
}

struct coulomb_sink coulomb_log_sink(struct coulomb_log *log) {
  return (struct coulomb_sink){log, log_event, NULL};
}

/* Whether the phase before b, which began with a, took no time.  On a slow belt, after a global stick phase of 1e20,
   two moments that differ are one number; the masses have moved all the same. */
static bool at_once(const struct coulomb_row *a, const struct coulomb_row *b) {
  return b->t <= a->t && b->x[0] == a->x[0] && b->x[1] == a->x[1];
}

void coulomb_log_word(struct text *word, const struct coulomb_log *log) {
  for (size_t i = 0; i < log->n; i++) {
    bool empty = i + 1 < log->n && at_once(&log->event[i].at, &log->event[i + 1].at);
    if (!empty) text_add_char(word, coulomb_letter(log->event[i].at.mode));
  }
}
