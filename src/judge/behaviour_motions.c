/* Motions under Coulomb's law by both routes, and what is said of them: what the checks of kind behaviour share.
   Whatever depends on rounding (a flat contact, routes that part) is left out and counted, so that a verdict
   is the same on every machine. */
#include "behaviour.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "verdict.h"

static const char *const motion_route_name[N_MOTION_ROUTES] = {"integration", "motion"};

static bool keep_event(void *self, const struct coulomb_event *e) {
  struct trajectory *t = self;
  struct coulomb_sink log = coulomb_log_sink(&t->log);
  return log.event(log.self, e);
}

static bool keep_row(void *self, const struct coulomb_row *row) {
  struct trajectory *t = self;
  t->row = ss_grow(t->row, t->n_rows, &t->cap_rows, sizeof *t->row);
  t->row[t->n_rows] = *row;
  t->row[t->n_rows++].exact = NULL;
  return true;
}

struct trajectory motion_simulate(enum motion_route route, const struct coulomb_setup *m,
                                  const struct coulomb_plan *plan) {
  struct trajectory t = {.status = SS_OK};
  struct coulomb_sink sink = {&t, keep_event, keep_row};
  t.status = (route == BY_INTEGRATION ? coulomb_simulate_ode : coulomb_simulate_d)(&t.result, m->params, m->start, plan,
                                                                                   &sink);
  return t;
}

void trajectory_clear(struct trajectory *t) {
  coulomb_log_clear(&t->log);
  free(t->row);
}

bool trajectories_agree(const struct trajectory *a, const struct trajectory *b) {
  size_t shared;
  double size = 1, apart = coulomb_log_compare(&shared, &a->log, &b->log);
  for (int i = 0; i < 2; i++) {
    size = fmax(size, fabs(a->result.at.x[i]));
    apart = fmax(apart, fabs(a->result.at.x[i] - b->result.at.x[i]));
    apart = fmax(apart, fabs(a->result.at.v[i] - b->result.at.v[i]));
  }
  return a->status == SS_OK && b->status == SS_OK && a->log.n == shared && b->log.n == shared &&
         a->result.touches == 0 && b->result.touches == 0 && apart < 1e-6 * size;
}

const char mode_letters[N_MODE_PAIRS + 1] = "DGHCghcXx";

int mode_index(const enum coulomb_mode mode[2]) {
  return (int)(strchr(mode_letters, coulomb_letter(mode)) - mode_letters);
}

static double nearest_dyadic(double x) {
  return nearbyint(64 * x) / 64;
}

/* Random parameters, all exact in double. */
static void motion_params(struct coulomb_setup *m, struct sampler *s) {
  LOCAL(point, p);
  sampler_next(&p, s);
  static const int from[] = {Q_CHI, Q_ETA, Q_V, Q_US1, Q_US2};
  for (int i = 0; i < 5; i++) m->params[COULOMB_CHI + i] = fmpq_get_d(&p.q[from[i]]);
  for (int i = 0; i < 2; i++) m->params[COULOMB_UR1 + i] = m->params[COULOMB_US1 + i] + fmpq_get_d(&p.q[Q_E1 + i]);
}

/* A start anywhere, overrunning masses and sticking ones included. */
static void motion_start(struct coulomb_setup *m, struct sampler *s) {
  LOCAL(point, p);
  double f[2];
  sampler_next(&p, s);
  for (int i = 0; i < 2; i++) {
    double pull = fmpq_get_d(&p.q[Q_Z1 + i]), speed = fmpq_get_d(&p.q[Q_DZ1 + i]); /* both in eighths, up to 4 */
    bool sticks = nearbyint(8 * pull) / 2 == floor(nearbyint(8 * pull) / 2);
    f[i] = m->params[COULOMB_UR1 + i] * pull / 2;
    m->start[DZ_1 + i] = m->params[COULOMB_V] * (sticks ? 1 : 1 + speed);
  }
  m->start[Z_1] = nearest_dyadic((f[0] + f[1]) / (1 - m->params[COULOMB_CHI]));
  m->start[Z_2] = nearest_dyadic(m->start[Z_1] + f[1] / m->params[COULOMB_CHI]);
}

const char *motion_text(struct behaviour *b, const struct coulomb_setup *m) {
  const double *p = m->params, *x = m->start;
  return result_str(b->j->out,
                    "chi = %.12g, eta = %.12g, V = %.12g, e1 = %.12g, e2 = %.12g, u_r1 = %.12g, u_r2 = %.12g; "
                    "--start %.12g,%.12g,%.12g,%.12g",
                    p[COULOMB_CHI], p[COULOMB_ETA], p[COULOMB_V], p[COULOMB_UR1] - p[COULOMB_US1],
                    p[COULOMB_UR2] - p[COULOMB_US2], p[COULOMB_UR1], p[COULOMB_UR2], x[0], x[1], x[2], x[3]);
}

double orbit_r(const struct dyn_orbit *o) {
  return num_arb.get_d(o->z20) - num_arb.get_d(o->z10);
}

val orbit_passed(struct calc *c, const struct num_vec *params, const struct dyn_orbit *o, val by,
                 const double near[N_PHASES]) {
  const struct num_type *t = c->ctx.type;
  OWNED(dyn_arc) arc;
  struct num_vec z = calc_vec(c, 2);
  dyn_arc_init(&arc, c->ctx);
  c->status |= t->set_arb(num_vec_at(&z, 0), o->z10, c->ctx.prec) | t->set_arb(num_vec_at(&z, 1), o->z20, c->ctx.prec);
  val z_2 = calc_add(c, num_vec_at(&z, 1), by);
  if (c->status == SS_OK) c->status |= dyn_arc_run(&arc, params, num_vec_at(&z, 0), z_2, near);
  const struct num_vec end = dyn_arc_state(&arc, N_PHASES);
  return calc_sub(c, num_vec_at(&end, Z_2), num_vec_at(&end, Z_1));
}

int return_map_fate(const fmpq params[N_PARAMS], double r, double part, long steps) {
  double p[N_PARAMS], offset = part * fabs(r), at = r + offset, t[4];
  for (int i = 0; i < N_PARAMS; i++) p[i] = fmpq_get_d(&params[i]);
  for (long i = 0; i < steps; i++) {
    if (dyn_return_map_d(&at, NULL, t, p, at) != SS_OK) return -1;
    if (fabs(at - r) < 0.5 * fabs(offset)) return 1;
    if (fabs(at - r) > 2 * fabs(offset)) return -1;
  }
  return 0;
}

double motion_distance(const struct point *params, const struct dyn_orbit *o, double part, long returns) {
  struct coulomb_setup m;
  struct coulomb_plan plan = coulomb_plan_default;
  if (coulomb_setup_on_orbit(&m, params->q + Q_CHI, o, OWN_FRICTION) != SS_OK) return NAN;
  double r = m.start[Z_2] - m.start[Z_1], offset = part * fabs(r);
  m.start[Z_2] += offset;
  plan.returns = returns;
  plan.max_events = 64 * returns;
  OWNED(trajectory) t = motion_simulate(BY_INTEGRATION, &m, &plan);
  return t.status == SS_OK ? fabs(t.result.at.x[1] - t.result.at.x[0] - r) / offset : NAN;
}

/* --- Orbits --- */

void orbit_walk_begin(struct orbit_walk *w, struct behaviour *b, bool admissible, int draws) {
  *w = (struct orbit_walk){.cache = b->j->cache, .draws = draws};
  sampler_init(&w->sampler, b->c->id, &(struct point_spec){.kind = POINT_ORBIT, .admissible = admissible});
  point_init(&w->p);
}

const struct dyn_orbit *orbit_walk_next(struct orbit_walk *w) {
  while (w->draws-- > 0) {
    sampler_next(&w->p, &w->sampler);
    if (w->in_turn) w->sampler.spec.admissible = !w->sampler.spec.admissible;
    if (!point_settle(&w->p, w->cache)) continue;
    const struct dyn_orbit *o = &orbit_cache_get(w->cache, w->p.q, FD_PREC + 64)->orbit[w->p.orbit];
    if (!o->grazing && orbit_is_new(&w->met, o)) return o;
  }
  return NULL;
}

void orbit_walk_clear(struct orbit_walk *w) {
  point_clear(&w->p);
}

/* --- Evidence --- */

struct route_result behaviour_route(struct behaviour *b, struct route_result w, const char *where, const char *note) {
  return finding_add_route(b->f, b->j->out, w, "model", -1, where, note);
}

void behaviour_routes(struct route_result w[N_MOTION_ROUTES], struct behaviour *b,
                      const enum route_outcome outcome[N_MOTION_ROUTES], long trials, const char *where,
                      const char *note) {
  for (int r = 0; r < N_MOTION_ROUTES; r++) {
    bool first = r == BY_INTEGRATION;
    const struct route_result said = {motion_route_name[r], outcome[r], first, trials};
    w[r] = behaviour_route(b, said, first ? where : NULL, first ? note : NULL);
  }
}

/* --- Random motions watched --- */

struct watched behaviour_watch(struct behaviour *b, watch_fn fn, void *self) {
  enum { MOTIONS = 96 };
  struct watched w = {0, 0};
  struct sampler s;
  sampler_init(&s, b->c->id, &(struct point_spec){.kind = POINT_PARAMS});
  for (long i = 0; i < MOTIONS; i++) {
    struct coulomb_setup m;
    struct trajectory trajectory[N_MOTION_ROUTES];
    struct coulomb_plan plan = coulomb_plan_default;
    motion_params(&m, &s);
    motion_start(&m, &s);
    plan.duration = 12;
    plan.sample = 0.25;
    for (int r = 0; r < N_MOTION_ROUTES; r++) trajectory[r] = motion_simulate((enum motion_route)r, &m, &plan);
    bool same = trajectories_agree(&trajectory[0], &trajectory[1]);
    w.motions += same;
    w.apart += !same;
    if (same) fn(self, &m, trajectory);
    for (int r = 0; r < N_MOTION_ROUTES; r++) trajectory_clear(&trajectory[r]);
  }
  return w;
}

void behaviour_conclude(struct behaviour *b, const struct answers said[N_MOTION_ROUTES], long trials, const char *note,
                        const struct route_result *proof) {
  struct route_result w[N_MOTION_ROUTES + 1];
  enum route_outcome outcome[N_MOTION_ROUTES];
  for (int r = 0; r < N_MOTION_ROUTES; r++) outcome[r] = answers_outcome(&said[r]);
  behaviour_routes(w, b, outcome, trials, NULL, note);
  b->f->verdict = verdict_with_proof(w, N_MOTION_ROUTES, proof);
}
