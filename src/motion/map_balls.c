/* The equations of the return map in balls, and the proof that a velocity stays below the belt's.

   The unknowns are (t_b, t_c): z_1' = V at the end of phase H, and the radius at which phase C ends is the r that the
   stick phase must have.  Both stay smooth where an event grazes.  The proof walks along phase H as the search in
   double precision does, with every bound rounded outwards. */
#include <math.h>

#include "base/work.h"
#include "map_balls.h"
#include "num/pi.h"

enum { UNITS_OF_VELOCITY = 60 }; /* of work: the velocity of a mass at one time */

void ball_params_init(struct ball_params *m, struct calc *c, const fmpq *params) {
  ball_params_with(m, c, params, calc_q(c, params + P_E1), calc_q(c, params + P_E2));
}

void ball_params_make(struct ball_params *m, struct calc *c, const val p[N_PARAMS]) {
  for (int i = 0; i < N_PARAMS; i++) m->p[i] = p[i];
  m->zero = calc_d(c, 0);
  m->one = calc_d(c, 1);
  m->two = calc_d(c, 2);
  m->a = calc_mul(c, calc_sub(c, m->one, m->p[P_CHI]), m->p[P_V]);
  m->stiff = calc_mul(c, m->p[P_CHI], m->p[P_ETA]);
  m->omega = calc_sqrt(c, m->stiff);
  m->spectrum = flow_spectrum(c, m->p);
  m->kept = false;
}

void ball_params_with(struct ball_params *m, struct calc *c, const fmpq *model, val e1, val e2) {
  const val p[N_PARAMS] = {calc_q(c, model), calc_q(c, model + 1), calc_q(c, model + 2), e1, e2};
  ball_params_make(m, c, p);
}

void ball_params_keep(struct ball_params *m, struct calc *c, val tb, val tc) {
  m->kept = true;
  m->near_tb = tb;
  m->near_tc = tc;
  calc_sin_cos(c, &m->turn_b.sine, &m->turn_b.cosine, tb);
  for (int i = 0; i < 2; i++)
    calc_sin_cos(c, &m->turn_c[i].sine, &m->turn_c[i].cosine, calc_mul(c, m->spectrum.om[i], tc));
}

static void turn_gamma(val *sine, val *cosine, struct calc *c, const struct ball_params *m, val tb) {
  if (m->kept)
    turn_by(sine, cosine, c, &m->turn_b, calc_sub(c, tb, m->near_tb));
  else
    calc_sin_cos(c, sine, cosine, tb);
}

static void turns_h(val sine[2], val cosine[2], struct calc *c, const struct ball_params *m, val tc) {
  val move = m->kept ? calc_sub(c, tc, m->near_tc) : tc;
  for (int i = 0; i < 2; i++) {
    val angle = calc_mul(c, m->spectrum.om[i], move);
    if (m->kept)
      turn_by(&sine[i], &cosine[i], c, &m->turn_c[i], angle);
    else
      calc_sin_cos(c, &sine[i], &cosine[i], angle);
  }
}

static struct ball_modes modes_from(struct calc *c, const struct spectrum *s, const struct moving *at) {
  struct ball_modes m;
  const val *v = at->v, *f = at->f;
  val share[2][2] = {{s->above, s->couple}, {s->back, s->below}}; /* of the slow mode: rows of its projector */
  for (int i = 0; i < 2; i++) {
    m.a[i][0] = calc_dot(c, share[i][0], v[0], share[i][1], v[1]);
    m.a[i][1] = calc_sub(c, v[i], m.a[i][0]);
    val slow = calc_dot(c, share[i][0], f[0], share[i][1], f[1]);
    m.b[i][0] = calc_div(c, slow, s->om[0]);
    m.b[i][1] = calc_div(c, calc_sub(c, f[i], slow), s->om[1]);
  }
  return m;
}

/* At the time with the given sines and cosines of om t. */
static struct moving modes_at(struct calc *c, const struct spectrum *s, const struct ball_modes *m, const val sine[2],
                              const val cosine[2]) {
  struct moving at;
  for (int i = 0; i < 2; i++) {
    val speed[2], force[2];
    for (int k = 0; k < 2; k++) {
      speed[k] = calc_sub(c, calc_mul(c, m->a[i][k], cosine[k]), calc_mul(c, m->b[i][k], sine[k]));
      force[k] = calc_mul(c, s->om[k], calc_dot(c, m->a[i][k], sine[k], m->b[i][k], cosine[k]));
    }
    at.v[i] = calc_add(c, speed[0], speed[1]);
    at.f[i] = calc_add(c, force[0], force[1]);
  }
  return at;
}

void ball_slide_make(struct ball_slide *g, struct calc *c, const struct ball_params *m, val tb) {
  val V = m->p[P_V], e1 = m->p[P_E1], e2 = m->p[P_E2];
  turn_gamma(&g->sine, &g->cosine, c, m, tb);
  g->wb = calc_dot(c, e1, g->cosine, m->a, g->sine);
  val dwb = calc_sub(c, calc_mul(c, m->a, g->cosine), calc_mul(c, e1, g->sine));
  g->pb = calc_sub(c, dwb, m->a);
  g->rise = calc_add(c, calc_sub(c, calc_mul(c, m->a, tb), g->wb), e1);
  g->r = calc_sub(c, calc_div(c, e2, m->p[P_CHI]), g->rise);
  g->at = (struct moving){{calc_add(c, V, g->pb), V}, {g->wb, calc_mul(c, m->p[P_ETA], e2)}};
  g->by_tb = (struct moving){{calc_neg(c, g->wb), m->zero}, {dwb, m->zero}};
}

void ball_pass_slip(struct ball_pass *s, struct calc *c, const struct ball_params *m, val tb, val tc) {
  struct ball_slide g;
  val V = m->p[P_V], sines[2], cosines[2];
  ball_slide_make(&g, c, m, tb);
  s->tb = tb;
  s->tc = tc;
  s->pb = g.pb;
  s->wb = g.wb;
  s->rise = g.rise;
  s->r = g.r;
  s->modes = modes_from(c, &m->spectrum, &g.at);
  struct ball_modes shift = modes_from(c, &m->spectrum, &g.by_tb);
  turns_h(sines, cosines, c, m, tc);
  struct moving at = modes_at(c, &m->spectrum, &s->modes, sines, cosines);
  struct moving by_tb = modes_at(c, &m->spectrum, &shift, sines, cosines);

  s->pc = calc_sub(c, at.v[0], V);
  s->qc = calc_sub(c, at.v[1], V);
  s->wc = at.f[0];
  s->rc = calc_div(c, at.f[1], m->stiff);
  s->pc_tb = by_tb.v[0];
  s->qc_tb = by_tb.v[1];
  s->pull_tb = by_tb.f[1];
}

void ball_pass_turn(struct ball_pass *s, struct calc *c, const struct ball_params *m, bool up) {
  s->up = up;
  val turned = calc_div(c, s->qc, m->omega);
  val radius = calc_sqrt(c, calc_dot(c, s->rc, s->rc, turned, turned));
  s->r_end = up ? radius : calc_neg(c, radius);
  s->defect = calc_sub(c, s->r_end, s->r);
  val turn = calc_div(c, calc_dot(c, s->rc, s->pull_tb, s->qc, s->qc_tb), m->stiff);
  s->r_end_tb = calc_div(c, turn, s->r_end);
  s->defect_tb = calc_sub(c, s->r_end_tb, s->pb);
  s->defect_tc = calc_neg(c, calc_div(c, calc_mul(c, s->rc, s->pc), s->r_end));
}

void ball_pass_make(struct ball_pass *s, struct calc *c, const struct ball_params *m, val tb, val tc, bool up) {
  ball_pass_slip(s, c, m, tb, tc);
  ball_pass_turn(s, c, m, up);
}

void ball_positions(val z[2], struct calc *c, const struct ball_params *m, val w, val r) {
  val ease = calc_sub(c, m->one, m->p[P_CHI]);
  z[0] = calc_div(c, calc_add(c, w, calc_mul(c, m->p[P_CHI], r)), ease);
  z[1] = calc_div(c, calc_add(c, w, r), ease);
}

val ball_rise(struct calc *c, const struct ball_params *m, val t) {
  val sine, cosine;
  calc_sin_cos(c, &sine, &cosine, t);
  return calc_dot(c, m->a, calc_sub(c, t, sine), m->p[P_E1], calc_sub(c, m->one, cosine));
}

val ball_crest(struct calc *c, const struct ball_params *m) {
  return calc_add(c, calc_pi(c), calc_mul(c, m->two, calc_atan2(c, m->a, m->p[P_E1])));
}

/* The rise grows strictly up to the first crest; later, t_b lies on the rising part of its period and above the crest
   before. */
truth ball_first_rise(struct calc *c, const struct ball_params *m, const struct ball_pass *s, truth *before_crest) {
  val turn = calc_mul(c, m->two, calc_pi(c)), fall = ball_crest(c, m);
  *before_crest = num_arb.lt(s->tb, fall);
  if (*before_crest == TRUTH_TRUE) return TRUTH_TRUE;
  double whole = floor(num_arb.get_d(s->tb) / (2 * PI));
  if (whole < 1) return *before_crest;
  val local = calc_sub(c, s->tb, calc_mul(c, calc_d(c, whole), turn));
  val before = calc_add(c, ball_rise(c, m, fall), calc_mul(c, calc_mul(c, calc_d(c, whole - 1), turn), m->a));
  return truth_and(num_arb.lt(local, fall), num_arb.lt(before, s->rise));
}

static double upper(val x) {
  NUMBERS(arf, bound);
  arb_get_ubound_arf(bound, x, 64);
  return arf_get_d(bound, ARF_RND_CEIL);
}

static double lower(val x) {
  NUMBERS(arf, bound);
  arb_get_lbound_arf(bound, x, 64);
  return arf_get_d(bound, ARF_RND_FLOOR);
}

struct harmonic ball_speed(struct calc *c, const struct ball_params *m, const struct ball_pass *s, int mass) {
  struct harmonic f = {.n = 2, .start = mass == 0 ? s->pb : m->zero, .drift = m->zero};
  for (int k = 0; k < 2; k++) {
    f.om[k] = m->spectrum.om[k];
    f.cs[k] = s->modes.a[mass][k];
    f.sn[k] = calc_neg(c, s->modes.b[mass][k]);
  }
  return f;
}

/* A velocity over the belt's, and its derivative. */
struct speed {
  val over, rate;
};

static struct speed speed_at(struct calc *c, const struct harmonic *f, val t) {
  struct angle angle[2];
  harmonic_angles(angle, c, f, t);
  return (struct speed){harmonic_value(c, f, angle, t), harmonic_rate(c, f, angle)};
}

/* An upper bound of that derivative of the speed: the sum of om^order times the amplitudes. */
static double rate_bound(struct calc *c, const struct harmonic *f, int order) {
  val sum = f->drift;
  for (int k = 0; k < 2; k++) {
    val part = calc_sqrt(c, calc_dot(c, f->cs[k], f->cs[k], f->sn[k], f->sn[k]));
    for (int i = 0; i < order; i++) part = calc_mul(c, f->om[k], part);
    sum = calc_add(c, sum, part);
  }
  return upper(sum) * (1 + 1e-9);
}

/* Whether the velocity is surely above zero somewhere after t, where the walk came to a stand, and before end. */
static bool rises_above(struct calc *c, const struct harmonic *f, double t, double end) {
  slong mark = calc_mark(c);
  bool above = false;
  for (double h = 1e-15 * (t + end); !above && !c->status && t + h < end; h *= 4) {
    above = arb_is_positive((arb_srcptr)speed_at(c, f, calc_d(c, t + h)).over);
    calc_release(c, mark);
  }
  return above;
}

/* A walk along the velocity from t = 0 by parabolas that it cannot cross, so that it passes no
   root. */
enum walk_end { WALK_PASSED, WALK_STANDS, WALK_TIRED };
struct walk {
  enum walk_end end;
  double t; /* how far it came */
};

/* To last, or to where a root is near. */
static struct walk walk_below(struct calc *c, const struct harmonic *f, double last, long max_steps) {
  slong mark = calc_mark(c);
  double bound = rate_bound(c, f, 2), first = fmin(upper(f->start), 0);
  struct walk at = {WALK_TIRED, 0};
  for (long i = 0; i < max_steps && !c->status && at.end == WALK_TIRED; i++) {
    if (i % WORK_BLOCK == WORK_BLOCK - 1) work_add((unsigned long long)WORK_BLOCK * UNITS_OF_VELOCITY);
    if (at.t > last) {
      at.end = WALK_PASSED;
      break;
    }
    struct speed v = speed_at(c, f, calc_d(c, at.t));
    double y = at.t == 0 ? first : upper(v.over), d = upper(v.rate), root = sqrt(fmax(d * d - 2 * bound * y, 0));
    double h = (d > 0 ? -2 * y / (d + root) : (root - d) / bound) * (1 - 1e-9);
    if (y > 0 || !(h > 1e-15 * at.t))
      at.end = WALK_STANDS;
    else
      at.t += h;
    calc_release(c, mark);
  }
  return at;
}

truth ball_slower(struct calc *c, const struct ball_params *m, const struct ball_pass *s, int mass, long max_steps) {
  slong mark = calc_mark(c);
  const struct harmonic f = ball_speed(c, m, s, mass);
  bool root_at_end = mass == 0;
  double last = root_at_end ? lower(s->tc) : upper(s->tc);
  if (root_at_end) { /* the speed grows from there to the root: it rises to zero */
    last -= fmax(lower(speed_at(c, &f, s->tc).rate), 0) / rate_bound(c, &f, 2) * (1 - 1e-9);
    last = nextafter(last, -INFINITY); /* the walk may end at last itself */
  }
  struct walk at = walk_below(c, &f, last, max_steps);
  truth answer = at.end == WALK_PASSED ? TRUTH_TRUE : TRUTH_UNKNOWN;
  if (at.end == WALK_STANDS && rises_above(c, &f, at.t, lower(s->tc))) answer = TRUTH_FALSE;
  calc_release(c, mark);
  return answer;
}

truth ball_touches(struct calc *c, const struct ball_params *m, const struct ball_pass *s, long max_steps) {
  slong mark = calc_mark(c);
  const struct harmonic f = ball_speed(c, m, s, 0);
  val fall = calc_sub(c, m->a, calc_mul(c, m->p[P_CHI], s->qc)); /* -z_1''' = z_1' - chi z_2' with z_1' = V */
  double back = fmax(lower(fall), 0) / rate_bound(c, &f, 3) * (1 - 1e-9);
  double last = nextafter(lower(s->tc) - back, -INFINITY);
  bool below = last > 0 && walk_below(c, &f, last, max_steps).end == WALK_PASSED;
  calc_release(c, mark);
  return below ? TRUTH_TRUE : TRUTH_UNKNOWN;
}

bool ball_first_root(double *t, struct calc *c, const struct ball_params *m, const struct ball_pass *s,
                     long max_steps) {
  const struct harmonic f = ball_speed(c, m, s, 0);
  struct walk at = walk_below(c, &f, INFINITY, max_steps);
  *t = at.t;
  return at.end == WALK_STANDS && at.t > 0;
}
