/* The closed form of a motion within one pair of modes, written once for the simulation and for the phase words. */
#include "mode_motion.h"

void harmonic_angles(struct angle angle[2], struct calc *c, const struct harmonic *f, val t) {
  for (int k = 0; k < f->n; k++) calc_sin_versine(c, &angle[k].sine, &angle[k].versine, calc_mul(c, f->om[k], t));
}

val harmonic_value(struct calc *c, const struct harmonic *f, const struct angle angle[2], val t) {
  val z = calc_add(c, f->start, calc_mul(c, f->drift, t));
  for (int k = 0; k < f->n; k++) z = calc_dot_from(c, z, f->sn[k], angle[k].sine, true, f->cs[k], angle[k].versine);
  return z;
}

val harmonic_rate(struct calc *c, const struct harmonic *f, const struct angle angle[2]) {
  val z = f->drift;
  for (int k = 0; k < f->n; k++) {
    val cosine = calc_sub(c, calc_d(c, 1), angle[k].versine);
    val swing = calc_dot_from(c, NULL, f->sn[k], cosine, true, f->cs[k], angle[k].sine);
    z = calc_add(c, z, calc_mul(c, f->om[k], swing));
  }
  return z;
}

val harmonic_bend(struct calc *c, const struct harmonic *f, const struct angle angle[2]) {
  val z = calc_d(c, 0);
  for (int k = 0; k < f->n; k++) {
    val cosine = calc_sub(c, calc_d(c, 1), angle[k].versine);
    val crest = calc_dot(c, f->sn[k], angle[k].sine, f->cs[k], cosine);
    z = calc_sub(c, z, calc_mul(c, calc_mul(c, f->om[k], f->om[k]), crest));
  }
  return z;
}

/* The derivatives of the order given and of the next one (0 and 1, or 1 and 2). */
static void harmonic_at(val out[2], struct calc *c, const struct harmonic *f, val t, int order) {
  struct angle angle[2];
  harmonic_angles(angle, c, f, t);
  out[0] = order == 0 ? harmonic_value(c, f, angle, t) : harmonic_rate(c, f, angle);
  out[1] = order == 0 ? harmonic_rate(c, f, angle) : harmonic_bend(c, f, angle);
}

/* How the speeds x_1', x_2' oscillate and the forces drift in the present pair of modes: a sticking mass moves evenly;
   a slipping one follows x_1'' = u_1 - f_1, x_2'' = eta (u_2 - f_2), with the frequency 1 or sqrt(chi eta) about the
   other's even motion, or both with the frequencies of the free system. */
struct swing {
  int n;
  val om[2], cs[2][2], sn[2][2], drift[2]; /* cs, sn: [mass][oscillation] of the speed; drift of the force */
};

static struct swing swing_make(struct calc *c, const struct motion_law *law, const int slips[2],
                               const struct motion_start *at) {
  const val *slip = at->slip;
  struct swing w = {.n = 0};
  val speed[2], pull[2] = {at->pull[0], calc_mul(c, law->eta, at->pull[1])};
  for (int i = 0; i < 2; i++) {
    speed[i] = calc_add(c, law->V, slip[i]);
    w.drift[i] = law->zero;
    for (int k = 0; k < 2; k++) w.cs[i][k] = w.sn[i][k] = law->zero;
  }
  if (!slips[0]) w.drift[0] = law->gap;
  if (!slips[0] && !slips[1]) return w;
  w.n = 1;
  if (!slips[1]) {
    w.drift[1] = calc_mul(c, law->chi, law->gap);
    w.om[0] = calc_d(c, 1);
    w.cs[0][0] = calc_add(c, slip[0], law->gap); /* x_1' - chi V */
    w.sn[0][0] = pull[0];
  } else if (!slips[0]) {
    w.om[0] = law->omega;
    w.cs[1][0] = slip[1];
    w.sn[1][0] = calc_div(c, pull[1], law->omega);
  } else {
    const struct spectrum *s = &law->spectrum;
    val couple = s->couple, back = s->back;
    w.n = 2;
    for (int k = 0; k < 2; k++) {
      val own[2] = {k == 0 ? s->above : s->below, k == 0 ? s->below : s->above};
      w.om[k] = s->om[k];
      w.cs[0][k] = calc_dot(c, own[0], speed[0], couple, speed[1]);
      w.cs[1][k] = calc_dot(c, back, speed[0], own[1], speed[1]);
      w.sn[0][k] = calc_div(c, calc_dot(c, own[0], pull[0], couple, pull[1]), s->om[k]);
      w.sn[1][k] = calc_div(c, calc_dot(c, back, pull[0], own[1], pull[1]), s->om[k]);
      couple = calc_neg(c, couple);
      back = calc_neg(c, back);
    }
  }
  return w;
}

void motion_law_make(struct motion_law *law, struct calc *c, val chi, val eta, val V, bool slip) {
  val model[N_PARAMS] = {[P_CHI] = chi, [P_ETA] = eta};
  law->chi = chi;
  law->eta = eta;
  law->V = V;
  law->zero = calc_d(c, 0);
  law->gap = calc_mul(c, calc_sub(c, calc_d(c, 1), chi), V);
  law->omega = calc_sqrt(c, calc_mul(c, chi, eta));
  if (slip) law->spectrum = flow_spectrum(c, model);
}

void motion_make(struct motion *m, struct calc *c, const struct motion_law *law, const int slips[2],
                 const struct motion_start *at) {
  struct swing w = swing_make(c, law, slips, at);
  val chi = law->chi, minus = calc_neg(c, chi), one = calc_d(c, 1);
  val weight[2][2] = {{one, minus}, {minus, chi}};
  for (int i = 0; i < 2; i++) {
    m->speed[i] = (struct harmonic){.n = w.n, .start = at->slip[i], .drift = law->zero};
    m->force[i] = (struct harmonic){.n = w.n, .start = at->force[i], .drift = w.drift[i]};
    for (int k = 0; k < w.n; k++) {
      m->speed[i].om[k] = m->force[i].om[k] = w.om[k];
      m->speed[i].cs[k] = w.cs[i][k];
      m->speed[i].sn[k] = w.sn[i][k];
      val cs = calc_dot(c, weight[i][0], w.cs[0][k], weight[i][1], w.cs[1][k]);
      val sn = calc_dot(c, weight[i][0], w.sn[0][k], weight[i][1], w.sn[1][k]);
      m->force[i].sn[k] = calc_div(c, cs, w.om[k]);
      m->force[i].cs[k] = calc_neg(c, calc_div(c, sn, w.om[k]));
    }
  }
}

void motion_at(val out[N_STATE], struct calc *c, const struct motion *m, val t) {
  struct angle angle[2];
  harmonic_angles(angle, c, &m->force[0], t);
  for (int i = 0; i < 2; i++) {
    out[i] = harmonic_value(c, &m->force[i], angle, t);
    out[2 + i] = harmonic_value(c, &m->speed[i], angle, t);
  }
}

struct harmonic harmonic_sided(struct calc *c, const struct harmonic *f, int side) {
  if (side > 0) return *f;
  struct harmonic m = {.n = f->n, .start = calc_neg(c, f->start), .drift = calc_neg(c, f->drift)};
  for (int k = 0; k < m.n; k++) {
    m.om[k] = f->om[k];
    m.cs[k] = calc_neg(c, f->cs[k]);
    m.sn[k] = calc_neg(c, f->sn[k]);
  }
  return m;
}

struct trig_sum harmonic_trig_sum(const struct calc *c, const struct harmonic *f) {
  struct trig_sum w = {.start = c->ctx.type->get_d(f->start), .drift = c->ctx.type->get_d(f->drift)};
  for (int k = 0; k < f->n; k++) {
    w.om[k] = c->ctx.type->get_d(f->om[k]);
    w.cs[k] = c->ctx.type->get_d(f->cs[k]);
    w.sn[k] = c->ctx.type->get_d(f->sn[k]);
  }
  return w;
}

val harmonic_newton(struct calc *c, const struct harmonic *f, val start, int order) {
  const struct num_type *type = c->ctx.type;
  void *t = calc_new(c);
  type->set(t, start);
  val small = calc_two_to(c, -c->ctx.prec / 2 - 6);
  slong mark = calc_mark(c);
  for (int i = 0; i < 100 && !c->status; i++) {
    val at[2];
    harmonic_at(at, c, f, t, order);
    val step = calc_div(c, at[0], at[1]);
    bool settled = !calc_lt(c, calc_mul(c, small, calc_abs(c, t)), calc_abs(c, step));
    type->set(t, calc_sub(c, t, step));
    calc_release(c, mark);
    if (settled) break;
  }
  return t;
}
