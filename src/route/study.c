/* Routes held against each other, quantity by quantity.

   The points are fixed: random ones from one seed, orbits of parameters drawn likewise with V and eta different from 1,
   and the scene's own orbits.  At each, every route of the table that applies is asked for the whole quantity, and
   every two answers are compared, entry by entry, relative to max(1, the largest entry).  A route that applies and
   gives no answer disagrees with all the others. */
#include <math.h>
#include <string.h>

#include "jacobian.h"
#include "num/calc.h"
#include "record/finding.h"
#include "record/routes.h"
#include "studies.h"
#include "value/coulomb_setup.h"
#include "value/expression.h"
#include "value/followed.h"
#include "value/printed.h"
#include "value/sentence.h"

/* Bits, and the most that a route in balls gets where its enclosures are wide and no phase is long. */
enum { PREC = FD_PREC, MOST_PREC = 4 * PREC };
enum { N_POINTS = 8, N_ADMISSIBLE = 12, N_FREE = 4, MOST_DRAWS = 400 };
enum { MOST_ENTRIES = 2 * N_STATE * N_STATE, MATRIX = N_STATE * N_STATE };

struct tally {
  long n;
  bool within;
  double worst; /* log2 of the largest disagreement */
  const char *where;
};

struct study {
  struct judge *j;
  struct point point;
  const struct dyn_orbit *orbit; /* there; NULL where the point is on none */
  enum route_row row;            /* that is asked */
  slong prec;                    /* bits of the routes in balls */
  struct sentence propagator[N_PHASES], jacobian;
  bool readable; /* the paper's corrected formulas */
  struct tally tally[N_ROUTE_ROWS][N_ROUTE_ROWS];
};

static const int entries[N_STUDIED] = {MATRIX, 2 * MATRIX, N_PHASES *(1 + N_STATE), 4};

static void get_all(arb_ptr out, const struct num_vec *v) {
  for (slong i = 0; i < v->len; i++) v->ctx.type->get_arb(out + i, num_vec_at(v, i));
}

/* --- Propagators. --- */

static int params_in(struct num_vec *params, void *t, const struct point *p) {
  const struct num_type *type = params->ctx.type;
  int s = type->set_q(t, &p->q[Q_T], params->ctx.prec);
  for (int i = 0; i < N_PARAMS; i++) s |= type->set_q(num_vec_at(params, i), &p->q[Q_CHI + i], params->ctx.prec);
  return s;
}

static int propagator(arb_ptr out, struct study *s) {
  struct num_ctx ctx = s->row == ROUTE_P_TAYLOR ? num_ctx_mpfr(PREC)
                       : s->row == ROUTE_P_GSL  ? num_ctx_double()
                                                : num_ctx_arb(s->prec);
  OWNED(calc) c = calc_begin(ctx);
  struct num_vec params = calc_vec(&c, N_PARAMS), m = calc_vec(&c, MATRIX);
  void *t = calc_new(&c);
  int status = params_in(&params, t, &s->point);
  status |= (s->row == ROUTE_P_CLOSED ? dyn_flow_matrix : dyn_propagator)(&m, s->point.phase, &params, t);
  get_all(out, &m);
  return status;
}

/* The paper's propagator of the phase, or its Jacobian. */
static int paper_side(arb_ptr out, struct study *s) {
  struct sentence *sentence = s->row == ROUTE_J_PAPER ? &s->jacobian : &s->propagator[s->point.phase];
  OWNED(calc) c = calc_begin(num_ctx_arb(s->prec));
  struct num_vec lhs = calc_vec(&c, sentence->n), rhs = calc_vec(&c, sentence->n);
  int status = sentence_values(&lhs, &rhs, sentence, &s->point, s->j->cache);
  get_all(out, &lhs);
  return status;
}

/* --- Their derivatives, and their values at 0. --- */

/* The paper's matrix of the phase, followed by the given suffix. */
static int paper_matrix(arb_ptr out, const struct study *s, const char *suffix) {
  struct view view = {s->j->model, LAYER_CORRECTED, NULL, NULL};
  char text[32];
  int n;
  snprintf(text, sizeof text, "%s%s", phase_name[s->point.phase], suffix);
  int status = expression_at(out, &n, view, text, "", &s->point, s->prec, s->j->cache, NULL);
  return n == MATRIX ? status : status | SS_UNABLE;
}

static int rate_paper(arb_ptr out, struct study *s) {
  return paper_matrix(out, s, "'(t)") | paper_matrix(out + MATRIX, s, "(0)");
}

static int rate_ode(arb_ptr out, struct study *s) {
  struct num_ctx ctx = num_ctx_arb(s->prec);
  OWNED(calc) c = calc_begin(ctx);
  struct num_vec params = calc_vec(&c, N_PARAMS), t = calc_vec(&c, 1), a = calc_vec(&c, MATRIX),
                 m = calc_vec(&c, MATRIX);
  int status = paper_matrix(out, s, "(t)");
  for (int i = 0; i < MATRIX; i++) arb_set(num_vec_at(&m, i), out + i);
  status |= params_in(&params, num_vec_at(&t, 0), &s->point) | dyn_system(&a, s->point.phase, &params);
  status |= num_mat_mul(&m, &a, &m, N_STATE, N_STATE, N_STATE);
  get_all(out, &m);
  for (int i = 0; i < MATRIX; i++) arb_set_si(out + MATRIX + i, i % (N_STATE + 1) == 0);
  return status;
}

/* --- Times since the start and states at the four events. --- */

static int events_of_model(arb_ptr out, struct study *s) {
  enum variant variant = s->row == ROUTE_E_EXPONENTIAL ? VARIANT_EXPONENTIAL : VARIANT_CLOSED;
  OWNED(values) v;
  int status = values_init(&v, &s->point, variant, num_ctx_arb(s->prec), s->j->cache);
  for (int ph = 0; ph < N_PHASES && status == SS_OK; ph++) {
    arb_set(out + ph, num_vec_at(&v.arc.t, ph));
    if (ph > 0) arb_add(out + ph, out + ph, out + ph - 1, s->prec);
    for (int i = 0; i < N_STATE; i++)
      arb_set(out + N_PHASES + ph * N_STATE + i, num_vec_at(&v.arc.z, (ph + 1) * N_STATE + i));
  }
  return status;
}

static const struct system_orbit *by_system(struct study *s) {
  OWNED(calc) c = calc_begin(num_ctx_arb(s->prec));
  struct num_vec params = calc_vec(&c, N_PARAMS);
  params_in(&params, calc_new(&c), &s->point);
  return followed_system(orbit_followed(s->j->cache, s->orbit, &params), s->point.q + Q_CHI);
}

static int events_system(arb_ptr out, struct study *s) {
  const struct system_orbit *o = by_system(s);
  arb_set(out, o->t);
  for (int ph = 1; ph < N_PHASES; ph++) arb_add(out + ph, out + ph - 1, o->t + ph, s->prec);
  _arb_vec_set(out + N_PHASES, o->z + N_STATE, N_PHASES * N_STATE);
  return o->status;
}

/* A sink that writes the first events of a motion of the word G H C D, positions relative to the given shift of the
   origin. */
struct catcher {
  arb_ptr out;
  arb_srcptr shift;
  int n;
  bool strayed;
};

static bool catch_event(void *self, const struct coulomb_event *e) {
  static const char word[] = "GHCD";
  struct catcher *c = self;
  c->strayed = c->strayed || c->n == N_PHASES || coulomb_letter(e->at.mode) != word[c->n];
  if (c->strayed) return false;
  arb_ptr state = c->out + N_PHASES + c->n * N_STATE, t = c->out + c->n++;
  const double plain[] = {e->at.t, e->at.x[0], e->at.x[1], e->at.v[0], e->at.v[1]};
  for (int i = 0; i <= N_STATE; i++) {
    arb_ptr to = i == 0 ? t : state + i - 1;
    if (e->at.exact)
      e->at.exact->ctx.type->get_arb(to, num_vec_at(e->at.exact, i));
    else
      arb_set_d(to, plain[i]);
  }
  for (int i = 0; i < 2; i++) arb_sub(state + i, state + i, c->shift + i, PREC);
  return true;
}

/* The sum of the statuses of a simulation and of what it did. */
static int simulated(int status, const struct catcher *c) {
  return c->strayed || c->n < N_PHASES ? status | SS_DOMAIN : status;
}

static int events_integration(arb_ptr out, struct study *s) {
  struct coulomb_setup sim;
  struct coulomb_plan plan = coulomb_plan_default;
  struct coulomb_result result;
  ARB_VECTOR(shift, 2);
  int status = coulomb_setup_on_orbit(&sim, s->point.q + Q_CHI, s->orbit, OWN_FRICTION);
  for (int i = 0; i < 2; i++) {
    arb_set_d(shift + i, sim.start[i]);
    arb_sub(shift + i, shift + i, i == 0 ? s->orbit->z10 : s->orbit->z20, PREC);
  }
  struct catcher c = {out, shift, 0, false};
  struct coulomb_sink sink = {&c, catch_event, NULL};
  plan.returns = 1;
  if (!status) status = simulated(coulomb_simulate_ode(&result, sim.params, sim.start, &plan, &sink), &c);
  return status;
}

/* The same law in MPFR, from the orbit as it is enclosed and the same static friction. */
static int events_simulation(arb_ptr out, struct study *s) {
  struct num_ctx ctx = num_ctx_mpfr(PREC);
  struct coulomb_setup sim;
  struct coulomb_plan plan = coulomb_plan_default;
  struct coulomb_result result;
  ARB_VECTOR(shift, 2);
  OWNED(calc) w = calc_begin(ctx);
  struct num_vec model = calc_vec(&w, N_PARAMS), limits = calc_vec(&w, 2), params = calc_vec(&w, N_COULOMB),
                 z = calc_vec(&w, 2), start = calc_vec(&w, N_STATE);
  int status = coulomb_setup_on_orbit(&sim, s->point.q + Q_CHI, s->orbit, OWN_FRICTION);
  for (int i = 0; i < N_PARAMS; i++) status |= num_mpfr.set_q(num_vec_at(&model, i), s->point.q + Q_CHI + i, PREC);
  for (int i = 0; i < 2; i++) {
    status |= num_mpfr.set_d(num_vec_at(&limits, i), sim.params[COULOMB_UR1 + i], PREC);
    status |= num_mpfr.set_arb(num_vec_at(&z, i), i == 0 ? s->orbit->z10 : s->orbit->z20, PREC);
  }
  status |= coulomb_params_set(&params, &model, &limits);
  status |= coulomb_start_set(&start, &params, num_vec_at(&z, 0), num_vec_at(&z, 1));
  get_all(shift, &z);
  for (int i = 0; i < 2; i++) {
    NUMBERS(arb, x);
    num_mpfr.get_arb(x, num_vec_at(&start, i));
    arb_sub(shift + i, x, shift + i, PREC);
  }
  struct catcher c = {out, shift, 0, false};
  struct coulomb_sink sink = {&c, catch_event, NULL};
  plan.returns = 1;
  if (!status) status = simulated(coulomb_simulate_exact(&result, &params, &start, &plan, &sink), &c);
  return status;
}

/* --- The return Jacobian. --- */

static int jacobian_by_model(arb_ptr out, struct study *s) {
  static const enum jacobian_method method[N_ROUTE_ROWS] = {
      [ROUTE_J_IMPLICIT] = METHOD_IMPLICIT, [ROUTE_J_SALTATION] = METHOD_SALTATION, [ROUTE_J_FD] = METHOD_FD};
  struct jacobian_job job = {.point = s->point, .cache = s->j->cache, .d = s->j->d};
  return jacobian_route(out, &job, method[s->row], LAYER_CORRECTED, NULL, s->prec);
}

static int jacobian_system(arb_ptr out, struct study *s) {
  const struct system_orbit *o = by_system(s);
  _arb_vec_set(out, o->j, 4);
  return o->status;
}

static int jacobian_integration(arb_ptr out, struct study *s) {
  struct coulomb_setup sim;
  double value[4] = {0}, err = 0;
  int status = coulomb_setup_on_orbit(&sim, s->point.q + Q_CHI, s->orbit, OWN_FRICTION);
  if (!status) status = coulomb_return_jacobian(value, &err, sim.params, sim.start);
  for (int i = 0; i < 4; i++) {
    arb_set_d(out + i, value[i]);
    mag_set_d(arb_radref(out + i), err);
  }
  return status;
}

/* --- One point. --- */

static int (*const compute[N_ROUTE_ROWS])(arb_ptr out, struct study *s) = {
    [ROUTE_P_PAPER] = paper_side,
    [ROUTE_P_EXPONENTIAL] = propagator,
    [ROUTE_P_CLOSED] = propagator,
    [ROUTE_P_TAYLOR] = propagator,
    [ROUTE_P_GSL] = propagator,
    [ROUTE_R_PAPER] = rate_paper,
    [ROUTE_R_ODE] = rate_ode,
    [ROUTE_E_CLOSED] = events_of_model,
    [ROUTE_E_EXPONENTIAL] = events_of_model,
    [ROUTE_E_SIMULATION] = events_simulation,
    [ROUTE_E_INTEGRATION] = events_integration,
    [ROUTE_E_SYSTEM] = events_system,
    [ROUTE_J_PAPER] = paper_side,
    [ROUTE_J_IMPLICIT] = jacobian_by_model,
    [ROUTE_J_SALTATION] = jacobian_by_model,
    [ROUTE_J_FD] = jacobian_by_model,
    [ROUTE_J_INTEGRATION] = jacobian_integration,
    [ROUTE_J_SYSTEM] = jacobian_system,
};

static int ask(arb_ptr out, struct study *s, enum route_row row) {
  s->row = row;
  return compute[row](out, s);
}

/* What the integration's rounding must cost here, by the start alone, whatever the route finds: of times, relative to
   the longest; of the Jacobian, to its largest entry.  0 for other routes. */
static double floor_of(const struct study *s, enum route_row row) {
  struct coulomb_setup sim;
  if (row != ROUTE_E_INTEGRATION && row != ROUTE_J_INTEGRATION) return 0;
  if (coulomb_setup_on_orbit(&sim, s->point.q + Q_CHI, s->orbit, OWN_FRICTION)) return 0;
  return row == ROUTE_J_INTEGRATION ? coulomb_return_jacobian_floor(sim.params, sim.start)
                                    : coulomb_event_floor(sim.params, sim.start) / fmax(1, sim.period);
}

static void leave_out(struct study *s, enum route_row row, const char *by, const char *why) {
  struct text what = {0};
  text_printf(&what, "the %s by %s at ", route_quantity_name[route_table[row].quantity], by);
  point_print(&what, &s->point);
  audit_leave_out(s->j->out, result_take(s->j->out, &what), why);
}

/* Left out where that is more than half of the digits that the route states. */
static bool out_of_reach(struct study *s, enum route_row row, double floor) {
  if (floor <= pow(10, -0.5 * route_table[row].digits)) return false;
  leave_out(s, row, "integration", "rounding would leave it fewer than half of its digits");
  return true;
}

/* Left out where Newton's iteration from the other routes' orbit, in double precision, leads to no proved one. */
static bool not_solved(struct study *s, enum route_row row, int status) {
  if (status == SS_OK || !(route_table[row].means & MEANS_SHOOTING)) return false;
  leave_out(s, row, "the engine for any system", "it proves no orbit there");
  return true;
}

/* Coulomb's law follows an orbit only where it breaks no condition, and the engine for any system knows orbits alone;
   the paper's formulas may be beyond reading. */
static bool applies(const struct study *s, enum route_row row) {
  unsigned means = route_table[row].means;
  if (means & MEANS_PAPER && !s->readable) return false;
  if (means & MEANS_SHOOTING) return s->orbit != NULL;
  return !(means & MEANS_COULOMB) || (s->orbit && s->orbit->admissible == TRUTH_TRUE);
}

/* Differences give a radius that is their own estimate of their error, no enclosure and no disagreement: it is taken
   off, and answered. */
static double take_estimate(arb_ptr x, int n, enum route_row row) {
  NUMBERS(mag, most);
  for (int i = 0; i < n && route_table[row].means & MEANS_DIFFERENCES; i++) {
    mag_max(most, most, arb_radref(x + i));
    arb_get_mid_arb(x + i, x + i);
  }
  return mag_is_zero(most) ? -INFINITY : mag_get_d_log2_approx(most);
}

/* log2 of the largest difference, and of max(1, the largest entry), to which it is relative. */
struct gap {
  double off, scale;
};

static struct gap gap_between(arb_srcptr a, arb_srcptr b, int n) {
  struct gap g = {-INFINITY, 0};
  NUMBERS(arb, d);
  for (int i = 0; i < n; i++) {
    g.scale = fmax(g.scale, fmax(log2_upper(a + i), log2_upper(b + i)));
    arb_sub(d, a + i, b + i, 2 * PREC);
    g.off = fmax(g.off, log2_upper(d));
  }
  g.off -= g.scale;
  return g;
}

static int stated_digits(enum route_row a, enum route_row b) {
  return route_table[a].digits < route_table[b].digits ? route_table[a].digits : route_table[b].digits;
}

/* Within the stated accuracy, or within the estimates (log2 of the larger) where these are larger, but at most half of
   the digits may be given away so. */
static bool keeps(enum route_row a, enum route_row b, struct gap gap, double estimate) {
  double bits = stated_digits(a, b) * log2(10), allowed = fmin(1 + estimate - gap.scale, -bits / 2);
  return gap.off <= fmax(-bits, allowed);
}

static void book(struct study *s, enum route_row a, enum route_row b, struct gap gap, double estimate) {
  struct tally *t = &s->tally[a][b];
  t->within = (t->n == 0 || t->within) && keeps(a, b, gap, estimate);
  if (t->n++ > 0 && gap.off <= t->worst) return;
  struct text where = {0};
  if (s->point.kind == POINT_PARAMS) text_printf(&where, "%s, ", phase_name[s->point.phase]);
  point_print(&where, &s->point);
  t->worst = gap.off;
  t->where = result_take(s->j->out, &where);
}

/* log2 of the largest radius, relative as a gap is. */
static double width_of(arb_srcptr x, int n) {
  double scale = 0, width = -INFINITY;
  for (int i = 0; i < n; i++) {
    scale = fmax(scale, log2_upper(x + i));
    if (!mag_is_zero(arb_radref(x + i))) width = fmax(width, mag_get_d_log2_approx(arb_radref(x + i)));
  }
  return width - scale;
}

/* On a slow belt the stick phase is long, and through it a matrix exponential loses as many bits as its length has. */
static slong most_prec(const struct study *s) {
  enum { EXPONENTIALS = 8 }; /* one after the other, and what a quotient of theirs loses */
  return MOST_PREC + (s->orbit ? EXPONENTIALS * (slong)fmax(0, log2_upper(s->orbit->period)) : 0);
}

/* In balls with as many bits as the digits need that the route states. */
static int compute_row(arb_ptr out, struct study *s, enum route_row row) {
  int n = entries[route_table[row].quantity], status = ask(out, s, row);
  double wanted = -route_table[row].digits * log2(10) - 2;
  bool in_balls = !(route_table[row].means & MEANS_DIFFERENCES);
  slong most = most_prec(s);
  while (in_balls && s->prec < most && (status == SS_UNABLE || (status == SS_OK && width_of(out, n) > wanted))) {
    s->prec = FLINT_MIN(2 * s->prec, most);
    status = ask(out, s, row);
  }
  s->prec = PREC;
  return status;
}

/* Every route to the quantity, and every two of them. */
static void compare_at(struct study *s, enum route_quantity q) {
  ARB_VECTOR(value, N_ROUTE_ROWS * MOST_ENTRIES);
  int status[N_ROUTE_ROWS];
  double own[N_ROUTE_ROWS];
  bool asked[N_ROUTE_ROWS];
  for (int i = 0; i < N_ROUTE_ROWS; i++) {
    asked[i] = route_table[i].quantity == q && applies(s, (enum route_row)i);
    double floor = asked[i] ? floor_of(s, (enum route_row)i) : 0;
    asked[i] = asked[i] && !out_of_reach(s, (enum route_row)i, floor);
    if (asked[i]) status[i] = compute_row(value + i * MOST_ENTRIES, s, (enum route_row)i);
    asked[i] = asked[i] && !not_solved(s, (enum route_row)i, status[i]);
    if (asked[i]) own[i] = take_estimate(value + i * MOST_ENTRIES, entries[q], (enum route_row)i);
    if (asked[i] && i == ROUTE_E_INTEGRATION) own[i] = log2(floor * fmax(1, num_arb.get_d(s->orbit->period)));
  }
  for (int i = 0; i < N_ROUTE_ROWS; i++)
    for (int k = i + 1; k < N_ROUTE_ROWS; k++) {
      if (!asked[i] || !asked[k]) continue;
      bool both = status[i] == SS_OK && status[k] == SS_OK;
      struct gap gap = {INFINITY, 0};
      if (both) gap = gap_between(value + i * MOST_ENTRIES, value + k * MOST_ENTRIES, entries[q]);
      if (isnan(gap.off)) gap.off = INFINITY;
      book(s, (enum route_row)i, (enum route_row)k, gap, fmax(own[i], own[k]));
    }
}

/* The control: the closed form a moment later must not pass for the exponential now. */
static void control(struct study *s) {
  enum { SHIFT = 150 };
  ARB_VECTOR(now, 2 * MATRIX);
  NUMBERS(fmpq, shift);
  int status = ask(now, s, ROUTE_P_EXPONENTIAL);
  fmpq_set_si(shift, 1, 1);
  fmpq_div_2exp(shift, shift, SHIFT);
  fmpq_add(&s->point.q[Q_T], &s->point.q[Q_T], shift);
  status |= ask(now + MATRIX, s, ROUTE_P_CLOSED);
  bool noticed =
      status == SS_OK && !keeps(ROUTE_P_EXPONENTIAL, ROUTE_P_CLOSED, gap_between(now, now + MATRIX, MATRIX), -INFINITY);
  audit_control(s->j->out, "routes-later", "routes", noticed ? VERDICT_REFUTED : VERDICT_SUPPORTED);
}

/* --- All points. --- */

static void at_parameters(struct study *s) {
  struct sampler sampler;
  sampler_init(&sampler, "routes: parameters", &(struct point_spec){.kind = POINT_PARAMS});
  for (int i = 0; i < N_POINTS; i++) {
    sampler_next(&s->point, &sampler);
    for (int ph = 0; ph < N_PHASES; ph++) {
      s->point.phase = (enum phase)ph;
      compare_at(s, QUANTITY_PROPAGATOR);
      if (s->readable) compare_at(s, QUANTITY_RATE);
    }
  }
  s->point.phase = PHASE_H;
  control(s);
}

/* Passes that start anywhere in the global stick phase; without an orbit, Coulomb's law may leave the word. */
static void on_arcs(struct study *s) {
  struct sampler sampler;
  sampler_init(&sampler, "routes: arcs", &(struct point_spec){.kind = POINT_ARC});
  for (int i = 0, done = 0; i < MOST_DRAWS && done < N_POINTS; i++) {
    sampler_next(&s->point, &sampler);
    OWNED(values) v;
    bool accepted = values_init(&v, &s->point, VARIANT_CLOSED, num_ctx_arb(PREC), s->j->cache) == SS_OK;
    if (!accepted) continue;
    compare_at(s, QUANTITY_EVENTS);
    done++;
  }
}

static const struct dyn_orbit *orbit_there(const struct study *s) {
  return &orbit_cache_get(s->j->cache, s->point.q + Q_CHI, PREC + 64)->orbit[s->point.orbit];
}

static bool on_orbit(struct study *s) {
  s->orbit = orbit_there(s);
  bool clear = !s->orbit->grazing;
  if (clear) compare_at(s, QUANTITY_EVENTS);
  if (clear) compare_at(s, QUANTITY_JACOBIAN);
  s->orbit = NULL;
  return clear;
}

/* Different orbits of random parameters; the sampler repeats itself, since its pool of parameter sets is small. */
static void on_random_orbits(struct study *s, int n, bool admissible) {
  struct sampler sampler;
  struct orbit_set met = {.n = 0};
  int done = 0;
  sampler_init(&sampler, admissible ? "routes: admissible" : "routes: orbits",
               &(struct point_spec){.kind = POINT_ORBIT, .admissible = admissible});
  for (int i = 0; i < MOST_DRAWS && done < n; i++) {
    sampler_next(&s->point, &sampler);
    if (fmpq_is_one(&s->point.q[Q_ETA]) || !point_settle(&s->point, s->j->cache)) continue;
    done += orbit_is_new(&met, orbit_there(s)) && on_orbit(s);
  }
}

/* The routes take exact e1 and e2. */
static void on_scene_orbits(struct study *s) {
  if (!scene_has_forces(s->j->scene)) {
    audit_leave_out(s->j->out, "the routes on the scene's own orbits", scene_lacks_forces(s->j->scene));
    return;
  }
  slong n = scene_orbits(s->j->scene, s->j->cache)->n;
  for (slong i = 0; i < n; i++) {
    s->point.kind = POINT_ORBIT;
    s->point.orbit = i;
    for (int k = 0; k < N_SCENE_PARAMS; k++) fmpq_set(&s->point.q[Q_CHI + k], &s->j->scene->value[k]);
    on_orbit(s);
  }
}

/* --- The paper's formulas, and the result. --- */

/* A text of the paper that cannot be read is the business of the claims about it. */
static void read_paper(struct study *s) {
  struct view view = {s->j->model, LAYER_CORRECTED, NULL, NULL};
  struct diag d = {0};
  s->readable = sentence_from_value(&s->jacobian, view, "J", "stability", NULL, 0, &d);
  for (int ph = 0; ph < N_PHASES; ph++) {
    char name[16];
    snprintf(name, sizeof name, "%s(t)", phase_name[ph]);
    if (!sentence_from_value(&s->propagator[ph], view, name, "", NULL, 0, &d)) s->readable = false;
  }
  if (!s->readable)
    audit_leave_out(s->j->out, "the paper's formulas in the study of the routes", "corrected, they cannot be read");
}

static const char *size_of(struct audit_result *out, double log2x) {
  return isinf(log2x) && log2x > 0 ? "no answer" : order_of_magnitude(out, log2x);
}

static void add_pair(struct study *s, enum route_row a, enum route_row b) {
  struct audit_result *out = s->j->out;
  const struct route_info *first = &route_table[a], *second = &route_table[b];
  const struct tally *t = &s->tally[a][b];
  struct text shared = {0};
  route_means_print(&shared, route_means_shared(first, second));
  bool shown = first->exact && second->exact && t->n > 0;
  struct route_pair pair = {.quantity = route_quantity_name[first->quantity],
                            .first = first->name,
                            .second = second->name,
                            .shared = result_take(out, &shared),
                            .comparisons = t->n,
                            .stated = result_str(out, "1e-%d", stated_digits(a, b)),
                            .within = t->within,
                            .largest = shown ? size_of(out, t->worst) : NULL,
                            .worst = shown ? t->where : NULL,
                            .machine_largest = t->n > 0 ? exp2(t->worst) : (double)NAN,
                            .machine_worst = t->where};
  *SS_PUSH(out->pairs, out->n_pairs, out->cap_pairs) = pair;
}

bool study_routes(struct judge *j) {
  struct study s = {.j = j, .prec = PREC};
  point_init(&s.point);
  read_paper(&s);
  at_parameters(&s);
  on_arcs(&s);
  on_random_orbits(&s, N_ADMISSIBLE, true);
  on_random_orbits(&s, N_FREE, false);
  on_scene_orbits(&s);
  for (int i = 0; i < N_ROUTE_ROWS; i++)
    for (int k = i + 1; k < N_ROUTE_ROWS; k++) {
      const struct route_info *a = &route_table[i], *b = &route_table[k];
      bool paper = (a->means | b->means) & MEANS_PAPER;
      if (a->quantity == b->quantity && a->digits && (s.readable || !paper))
        add_pair(&s, (enum route_row)i, (enum route_row)k);
    }
  for (int ph = 0; ph < N_PHASES; ph++) sentence_clear(&s.propagator[ph]);
  sentence_clear(&s.jacobian);
  point_clear(&s.point);
  return !j->d->set;
}
