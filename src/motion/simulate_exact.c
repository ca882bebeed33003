/* The motion under Coulomb's law in closed form, through any sequence of modes.

   The state is kept as f_1, f_2 (the restoring forces) and p_i = x_i' - V: the law looks at these alone, they lose
   nothing where x is large, and x follows from f.  Within one pair of modes each of the four is a constant, a drift and
   at most two oscillations, so every condition has that shape too.  Its first root is searched in double precision
   (trig_sum.c), refined in the number type at hand, and decided there where double precision sees only a touching. */
#include <math.h>
#include <stdlib.h>

#include "coulomb_impl.h"
#include "flow.h"
#include "mode_motion.h"
#include "trig_sum.h"

/* Elements of a state. */
enum { F_1, P_1 = 2, TIME = 4, N_EXACT };

struct exact {
  struct calc c;
  val p[N_COULOMB], span, tol; /* span = 1 - chi */
  struct motion_law law;
  slong mark; /* what lies before it lives as long as the run */
  enum coulomb_mode mode[2];
  struct motion motion;
  struct coulomb_run *run;        /* that moves it */
  struct num_vec now, moved, row; /* row: t, x_1, x_2, x_1', x_2' */
};

/* -1, 0 or 1; zero when within tol. */
static int sign_of(struct calc *c, val x, val tol) {
  return calc_lt(c, tol, x) ? 1 : calc_lt(c, x, calc_neg(c, tol)) ? -1 : 0;
}

static val sided(struct calc *c, val x, int side) {
  return side > 0 ? x : calc_neg(c, x);
}

/* --- The motion in the present pair of modes. --- */

static void curves_make(struct exact *e) {
  struct calc *c = &e->c;
  const int slips[2] = {e->mode[0] != MODE_STICK, e->mode[1] != MODE_STICK};
  struct motion_start at;
  for (int i = 0; i < 2; i++) {
    at.force[i] = num_vec_at(&e->now, F_1 + i);
    at.slip[i] = num_vec_at(&e->now, P_1 + i);
    at.pull[i] = calc_sub(c, sided(c, e->p[COULOMB_US1 + i], e->mode[i] == MODE_BELOW ? 1 : -1), at.force[i]);
  }
  motion_make(&e->motion, c, &e->law, slips, &at);
}

/* The state after time t of the present curves. */
static void advance(struct exact *e, val t) {
  struct calc *c = &e->c;
  const struct num_type *type = c->ctx.type;
  slong mark = calc_mark(c);
  val z[N_STATE];
  motion_at(z, c, &e->motion, t);
  for (int i = 0; i < N_STATE; i++) type->set(num_vec_at(&e->moved, F_1 + i), z[i]);
  type->set(num_vec_at(&e->moved, TIME), calc_add(c, num_vec_at(&e->now, TIME), t));
  calc_release(c, mark);
}

/* --- Events. --- */

/* Negative while mass i goes on as it does; a sticking mass has one for each side. */
static struct harmonic margin(struct exact *e, int mass, int side) {
  struct calc *c = &e->c;
  bool sticks = e->mode[mass] == MODE_STICK;
  struct harmonic m = harmonic_sided(c, sticks ? &e->motion.force[mass] : &e->motion.speed[mass], side);
  if (sticks) {
    m.start = calc_sub(c, m.start, e->p[COULOMB_UR1 + mass]);
    if (sign_of(c, m.start, e->tol) == 0) m.start = e->law.zero; /* at the limit: derivatives tell how it starts */
  }
  return m;
}

static double as_double(const struct calc *c, val x) {
  return c->ctx.type->get_d(x);
}

/* The same wave seen from time t on, where it is zero. */
static struct trig_sum trig_sum_from(const struct trig_sum *w, double t) {
  struct trig_sum v = *w;
  v.start = 0;
  for (int k = 0; k < 2; k++) {
    double s = sin(w->om[k] * t), c = cos(w->om[k] * t);
    v.cs[k] = w->cs[k] * c + w->sn[k] * s;
    v.sn[k] = w->sn[k] * c - w->cs[k] * s;
  }
  return v;
}

enum contact { CONTACT_MISS, CONTACT_TOUCH, CONTACT_CROSS };

/* What happens near the flat contact at *t: the highest value near it decides, and *t becomes the root or its place. */
static enum contact judge_flat(val *t, struct exact *e, const struct harmonic *f) {
  struct calc *c = &e->c;
  struct angle angle[2];
  val crest = harmonic_newton(c, f, *t, 1);
  harmonic_angles(angle, c, f, crest);
  val top = harmonic_value(c, f, angle, crest);
  int sign = sign_of(c, top, e->tol);
  if (c->status || sign < 0) return CONTACT_MISS;
  *t = crest;
  if (sign == 0) return CONTACT_TOUCH;
  val before = calc_sqrt(c, calc_div(c, calc_mul(c, calc_d(c, -2), top), harmonic_bend(c, f, angle)));
  *t = harmonic_newton(c, f, calc_sub(c, crest, before), 0);
  return CONTACT_CROSS;
}

/* The first contact of a margin with zero that ends the present mode: *t and whether it is flat.  NULL when there is
   none before t_max; *status is that of the search which ended without one. */
static val first_contact(bool *flat, int *status, struct exact *e, const struct harmonic *f, bool sticks,
                         double t_max) {
  struct calc *c = &e->c;
  struct coulomb_run *run = e->run;
  struct trig_sum w = harmonic_trig_sum(c, f);
  struct trig_sum_root root;
  double passed = 0;
  for (;;) {
    struct dyn_limits lim = {t_max - passed, run->plan->max_steps - run->result->steps};
    *status = trig_sum_first_root(&root, &w, NULL, &lim);
    run->result->steps += root.steps;
    if (*status) return NULL;
    val t = calc_d(c, passed + root.t);
    if (!root.grazing && root.rate > 0) {
      *flat = false;
      return harmonic_newton(c, f, t, 0);
    }
    if (root.grazing) {
      *flat = true;
      run->result->touches++;
      enum contact contact = judge_flat(&t, e, f);
      if (contact == CONTACT_CROSS || (contact == CONTACT_TOUCH && !sticks)) return t;
    }
    passed += root.t; /* a force that turns back at its limit, or the end of an excursion below rounding */
    w = trig_sum_from(&w, root.t);
  }
}

struct event {
  val t; /* from the present; NULL when none */
  int mass, side;
  bool flat;
};

/* The first event up to t_max.  *status: SS_DOMAIN when it is proved that no event ever comes, SS_UNABLE when none was
   found before t_max or within the budget. */
static struct event first_event(int *status, struct exact *e, double t_max) {
  struct calc *c = &e->c;
  struct event first = {.t = NULL};
  *status = SS_DOMAIN;
  for (int mass = 0; mass < 2; mass++) {
    bool sticks = e->mode[mass] == MODE_STICK;
    for (int side = -1; side <= 1; side += 2) {
      if (!sticks && side != (e->mode[mass] == MODE_BELOW ? 1 : -1)) continue;
      struct harmonic m = margin(e, mass, side);
      bool flat;
      int end;
      double most = first.t ? 1.000001 * as_double(c, first.t) + 1e-300 : t_max;
      val t = first_contact(&flat, &end, e, &m, sticks, fmin(t_max, most));
      if (end & SS_UNABLE) *status = SS_UNABLE;
      if (t && calc_lt(c, t, e->law.zero)) t = e->law.zero;
      if (t && (!first.t || calc_lt(c, t, first.t))) first = (struct event){t, mass, side, flat};
    }
  }
  return first;
}

/* --- The route. --- */

static double exact_time(const void *self) {
  const struct exact *e = self;
  return as_double(&e->c, num_vec_at(&e->now, TIME));
}

static void exact_row(void *self, struct coulomb_row *row, double t) {
  struct exact *e = self;
  struct calc *c = &e->c;
  const struct num_type *type = c->ctx.type;
  slong mark = calc_mark(c);
  const struct num_vec *z = &e->now;
  if (t > exact_time(e)) {
    advance(e, calc_sub(c, calc_d(c, t), num_vec_at(&e->now, TIME)));
    z = &e->moved;
  }
  *row = (struct coulomb_row){.t = t, .exact = &e->row};
  type->set(num_vec_at(&e->row, 0), num_vec_at(z, TIME));
  val x1 = calc_div(c, calc_add(c, num_vec_at(z, F_1), num_vec_at(z, F_1 + 1)), e->span);
  val x2 = calc_add(c, x1, calc_div(c, num_vec_at(z, F_1 + 1), e->p[COULOMB_CHI]));
  type->set(num_vec_at(&e->row, 1), x1);
  type->set(num_vec_at(&e->row, 2), x2);
  for (int i = 0; i < 2; i++) {
    type->set(num_vec_at(&e->row, 3 + i), calc_add(c, e->p[COULOMB_V], num_vec_at(z, P_1 + i)));
    row->x[i] = as_double(c, num_vec_at(&e->row, 1 + i));
    row->v[i] = as_double(c, num_vec_at(&e->row, 3 + i));
    row->u[i] = as_double(c, num_vec_at(z, F_1 + i));
  }
  calc_release(c, mark);
}

static void exact_signs(void *self, struct coulomb_signs *s) {
  struct exact *e = self;
  struct calc *c = &e->c;
  slong mark = calc_mark(c);
  for (int i = 0; i < 2; i++) {
    val f = num_vec_at(&e->now, F_1 + i);
    s->speed[i] = sign_of(c, num_vec_at(&e->now, P_1 + i), e->tol);
    if (s->speed[i] == 0) c->ctx.type->set(num_vec_at(&e->now, P_1 + i), e->law.zero);
    s->pull[i] = sign_of(c, f, e->law.zero);
    s->excess[i] = sign_of(c, calc_sub(c, calc_abs(c, f), e->p[COULOMB_UR1 + i]), e->tol);
  }
  val lead = calc_sub(c, e->law.gap, calc_mul(c, e->p[COULOMB_CHI], num_vec_at(&e->now, P_1 + 1)));
  s->lead = s->speed[1] == 0 ? 1 : sign_of(c, lead, e->tol); /* chi V < V */
  s->drag = sign_of(c, calc_add(c, num_vec_at(&e->now, F_1 + 1), e->p[COULOMB_US2]), e->tol);
  calc_release(c, mark);
}

/* Puts the state on what the event says of it: the limit itself, and no mass on the wrong side of V. */
static void settle(struct exact *e, const struct event *event) {
  struct calc *c = &e->c;
  const struct num_type *type = c->ctx.type;
  for (int i = 0; i < 2; i++) {
    bool sticks = e->mode[i] == MODE_STICK;
    val wrong = sided(c, num_vec_at(&e->now, P_1 + i), e->mode[i] == MODE_BELOW ? 1 : -1);
    if (sticks || event->mass == i || calc_lt(c, e->law.zero, wrong))
      type->set(num_vec_at(&e->now, P_1 + i), e->law.zero);
    if (sticks && event->mass == i)
      type->set(num_vec_at(&e->now, F_1 + i), sided(c, e->p[COULOMB_UR1 + i], event->side));
  }
}

static enum move exact_move(void *self, struct coulomb_run *run) {
  struct exact *e = self;
  struct calc *c = &e->c;
  double duration = run->plan->duration, left = duration - exact_time(e);
  calc_release(c, e->mark);
  e->run = run;
  e->mode[0] = run->mode[0];
  e->mode[1] = run->mode[1];
  curves_make(e);
  int status;
  struct event event = first_event(&status, e, 1.000001 * left);
  if (c->status) return MOVE_FAILED;
  if (!event.t && run->result->steps >= run->plan->max_steps) return MOVE_BUDGET;
  if (!event.t && !isfinite(duration)) return status == SS_DOMAIN ? MOVE_QUIET : MOVE_BUDGET;
  if (isfinite(duration)) {
    val rest = calc_sub(c, calc_d(c, duration), num_vec_at(&e->now, TIME));
    if (!event.t || calc_lt(c, rest, event.t)) {
      if (!run_samples(run, duration, true)) return MOVE_STOPPED;
      advance(e, rest);
      num_vec_set(&e->now, &e->moved);
      c->status |= c->ctx.type->set_d(num_vec_at(&e->now, TIME), duration, c->ctx.prec);
      return c->status ? MOVE_FAILED : MOVE_END;
    }
  }
  val then = calc_add(c, num_vec_at(&e->now, TIME), event.t);
  if (!run_samples(run, as_double(c, then), false)) return MOVE_STOPPED;
  advance(e, event.t);
  num_vec_set(&e->now, &e->moved);
  settle(e, &event);
  run->grazing[event.mass] = event.flat;
  return c->status ? MOVE_FAILED : MOVE_EVENT;
}

/* The quantities that last as long as the run, and the state in its own coordinates. */
static void exact_begin(struct exact *e, const struct num_vec *params, const struct num_vec *start) {
  struct calc *c = &e->c;
  val x[N_STATE];
  *c = calc_begin(params->ctx);
  e->now = calc_vec(c, N_EXACT);
  e->moved = calc_vec(c, N_EXACT);
  e->row = calc_vec(c, N_EXACT);
  flow_vals(e->p, params, 0, N_COULOMB);
  flow_vals(x, start, 0, N_STATE);
  val chi = e->p[COULOMB_CHI], belt = e->p[COULOMB_V];
  e->span = calc_sub(c, calc_d(c, 1), chi);
  motion_law_make(&e->law, c, chi, e->p[COULOMB_ETA], belt, true);
  val size = calc_add(c, belt, calc_add(c, e->p[COULOMB_UR1], e->p[COULOMB_UR2]));
  for (int i = 0; i < N_STATE; i++) size = calc_add(c, size, calc_abs(c, x[i]));
  e->tol = calc_mul(c, size, calc_two_to(c, 4 - c->ctx.prec));
  e->mark = calc_mark(c);
  const struct num_type *type = c->ctx.type;
  for (int i = 0; i < 2; i++) {
    type->set(num_vec_at(&e->now, F_1 + i), flow_force(c, i, chi, x));
    type->set(num_vec_at(&e->now, P_1 + i), calc_sub(c, x[DZ_1 + i], belt));
  }
}

int coulomb_simulate_exact(struct coulomb_result *result, const struct num_vec *params, const struct num_vec *start,
                           const struct coulomb_plan *plan, const struct coulomb_sink *sink) {
  if (params->ctx.type->rigorous) abort(); /* a ball may straddle what the law distinguishes */
  double p[N_COULOMB], x[N_STATE];
  for (int i = 0; i < N_COULOMB; i++) p[i] = params->ctx.type->get_d(num_vec_at(params, i));
  for (int i = 0; i < N_STATE; i++) x[i] = start->ctx.type->get_d(num_vec_at(start, i));
  *result = (struct coulomb_result){.end = COULOMB_FAILED};
  if (!run_domain(p, x, plan)) return SS_DOMAIN;
  struct exact e;
  exact_begin(&e, params, start);
  struct coulomb_run run = {.plan = plan, .sink = sink, .result = result};
  run.route = (struct route){&e, exact_signs, exact_move, exact_row, exact_time};
  run_init(&run, p, as_double(&e.c, e.tol));
  int status = run_all(&run);
  calc_clear(&e.c);
  return status;
}
