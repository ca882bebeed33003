/* Phase H from a narrow interval of t_b, in disks, with bounds of its derivatives that hold for all time.

   At t_b the velocity of z_1 and the force on it are constants plus u and w, where w = e1 cos t_b + a sin t_b and u =
   w' turn about the origin; everything later is linear in them.  So every derivative by t_b is a motion of phase H
   again, and the amplitudes of its two modes bound it for all time. */
#include "strip.h"
#include "flow.h"

/* What depends on the parameters alone, in balls first. */
static void disk_params_from(struct disk_params *s, struct calc *c, const struct ball_params *m) {
  const struct spectrum *f = &m->spectrum;
  val root = calc_sqrt(c, m->p[P_ETA]), share[2] = {calc_sqrt(c, f->above), calc_sqrt(c, f->below)};
  val second[2] = {share[1], calc_neg(c, share[0])}, fall = ball_crest(c, m);
  s->chi = disk_arb(m->p[P_CHI]);
  s->V = disk_arb(m->p[P_V]);
  s->a = disk_arb(m->a);
  s->e1 = disk_arb(m->p[P_E1]);
  s->e2 = disk_arb(m->p[P_E2]);
  s->span = disk_arb(calc_div(c, m->p[P_E2], m->p[P_CHI]));
  s->eta = disk_arb(m->p[P_ETA]);
  s->pull = disk_arb(calc_mul(c, m->p[P_ETA], m->p[P_E2]));
  s->stiff = disk_arb(m->stiff);
  s->soft = disk_arb(calc_div(c, m->one, m->stiff));
  s->omega = disk_arb(m->omega);
  s->rho = disk_arb(calc_sqrt(c, calc_dot(c, m->a, m->a, m->p[P_E1], m->p[P_E1])));
  s->turn = disk_arb(calc_mul(c, m->two, calc_mul(c, calc_pi(c), m->a)));
  s->fall = disk_arb(fall);
  s->crest = disk_arb(ball_rise(c, m, fall));
  for (int i = 0; i < 2; i++) {
    arb_set(s->exact[i], f->om[i]);
    s->om[i] = disk_arb(f->om[i]);
    s->inverse[i] = disk_arb(calc_div(c, m->one, f->om[i]));
    s->x[i] = disk_arb(calc_mul(c, root, share[i]));
    s->y[i] = disk_arb(second[i]);
    s->back[i] = disk_arb(calc_div(c, share[i], root));
    s->force1[i] = disk_mul(s->om[i], s->back[i]);
    s->force2[i] = disk_mul(s->soft, disk_mul(s->om[i], s->y[i]));
  }
}

bool disk_params_init(struct disk_params *s, const fmpq *params) {
  struct ball_params m;
  bool fits = true;
  for (int i = 0; i < 2; i++) arb_init(s->exact[i]);
  OWNED(calc) c = calc_begin(num_ctx_arb(128));
  ball_params_init(&m, &c, params);
  disk_params_from(s, &c, &m);
  const struct disk all[] = {s->V,       s->a,       s->e1,   s->e2,        s->stiff,     s->turn,
                             s->back[0], s->back[1], s->x[0], s->soft,      s->x[1],      s->force1[0],
                             s->om[0],   s->om[1],   s->span, s->force2[0], s->inverse[0]};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
    double size = fabs(all[i].mid);
    fits = fits && size > 1e-40 && size < 1e40 && all[i].rad < 1e-14 * size;
  }
  return fits;
}

void disk_params_clear(struct disk_params *s) {
  for (int i = 0; i < 2; i++) arb_clear(s->exact[i]);
}

/* --- Clocks. --- */

void disk_sin_cos(struct disk *sine, struct disk *cosine, arb_srcptr angle) {
  NUMBERS(arb, s, c);
  arb_sin_cos(s, c, angle, 64);
  *sine = disk_arb(s);
  *cosine = disk_arb(c);
}

static void sine_cosine(struct disk *sine, struct disk *cosine, arb_srcptr rate, double t) {
  NUMBERS(arb, angle);
  arb_set_d(angle, t);
  if (rate) arb_mul(angle, angle, rate, 128);
  disk_sin_cos(sine, cosine, angle);
}

void clock_set(struct clock *c, const struct disk_params *s, double t) {
  c->t = t;
  for (int i = 0; i < 2; i++) sine_cosine(&c->sine[i], &c->cosine[i], s->exact[i], t);
}

void clock_turn(struct clock *to, const struct clock *c, const struct clock *step) {
  struct clock sum = {.t = c->t + step->t};
  for (int i = 0; i < 2; i++) {
    sum.sine[i] = disk_dot(c->sine[i], step->cosine[i], c->cosine[i], step->sine[i]);
    sum.cosine[i] = disk_cross(c->cosine[i], step->cosine[i], c->sine[i], step->sine[i]);
  }
  *to = sum;
}

void disk_modes(struct disk a[2], struct disk b[2], const struct disk_params *s, struct disk v1, struct disk v2,
                struct disk w, struct disk pull) {
  for (int i = 0; i < 2; i++) {
    a[i] = disk_dot(s->x[i], v1, s->y[i], v2);
    b[i] = disk_mul(s->inverse[i], disk_dot(s->x[i], w, s->y[i], pull));
  }
}

struct disk disk_less_turns(arb_srcptr t, double k) {
  NUMBERS(arb, x, turns);
  arb_set_d(x, 2 * k);
  arb_const_pi(turns, 128);
  arb_mul(turns, turns, x, 128);
  arb_sub(x, t, turns, 128);
  return disk_arb(x);
}

/* --- Strips. --- */

/* The sum over the modes of |weight| om^power amplitude. */
static double bound_of(const struct disk_params *s, const struct disk weight[2], int power, const double amplitude[2]) {
  double sum = 0;
  for (int i = 0; i < 2; i++) {
    double term = disk_mag(weight[i]) * amplitude[i];
    for (int k = 0; k < power; k++) term *= disk_mag(s->om[i]);
    sum += term;
  }
  return disk_up(sum);
}

static double hypotenuse(double x, double y) {
  return disk_up(sqrt(disk_up(x * x + y * y)));
}

static struct derivative_bounds bend_of(const struct disk_params *s, const struct disk weight[2], const double full[2],
                                        const double shift[2], const double bent[2]) {
  return (struct derivative_bounds){.ff = bound_of(s, weight, 0, bent),
                                    .fff = bound_of(s, weight, 0, shift), /* the third derivative is minus the first */
                                    .ft = bound_of(s, weight, 1, shift),
                                    .tt = bound_of(s, weight, 2, full),
                                    .fft = bound_of(s, weight, 1, bent)};
}

void strip_reach(struct strip *p, double reach) {
  const struct disk_params *s = p->s;
  double move = disk_up(disk_mag(s->rho) * reach);
  double u = fmin(disk_mag(p->u) + move, disk_mag(s->rho)), w = fmin(disk_mag(p->w) + move, disk_mag(s->rho));
  double shift[2], bent[2];
  for (int i = 0; i < 2; i++) {
    double enter = disk_mag(s->x[i]), slow = disk_mag(s->inverse[i]);
    p->most[i] = hypotenuse(disk_mag(p->a[i]) + enter * move, disk_mag(p->b[i]) + enter * move * slow);
    shift[i] = disk_up(enter * hypotenuse(w, u * slow));
    bent[i] = disk_up(enter * hypotenuse(u, w * slow));
  }
  p->p = bend_of(s, s->back, p->most, shift, bent);
  p->q = bend_of(s, s->y, p->most, shift, bent);
  p->r = bend_of(s, s->force2, p->most, shift, bent);
}

void strip_make(struct strip *p, const struct disk_params *s, double low, double high, double reach) {
  struct disk sine, cosine;
  p->s = s;
  p->angle = 0.5 * (low + high);
  p->half = disk_up(fmax(high - p->angle, p->angle - low));
  sine_cosine(&sine, &cosine, NULL, p->angle);
  p->w = disk_dot(s->e1, cosine, s->a, sine);
  p->u = disk_cross(s->a, cosine, s->e1, sine);
  p->pb = disk_sub(p->u, s->a);
  struct disk rise = disk_sub(disk_add(disk_mul(s->a, (struct disk){p->angle, 0}), s->e1), p->w);
  p->base = disk_sub(s->span, rise);
  double move = disk_up(disk_mag(s->rho) * p->half);
  double climb = disk_up((disk_mag(p->pb) + move) * p->half);
  p->later = !disk_negative(disk_add(disk_sub(disk_widen(rise, climb), s->crest), s->turn));
  disk_modes(p->a, p->b, s, disk_add(disk_sub(s->V, s->a), p->u), s->V, p->w, s->pull);
  for (int i = 0; i < 2; i++) {
    p->da[i] = disk_scale(disk_mul(s->x[i], p->w), -1);
    p->db[i] = disk_mul(s->inverse[i], disk_mul(s->x[i], p->u));
  }
  strip_reach(p, fmax(reach, p->half));
}

bool strip_never(const struct strip *p) {
  double sum = 0;
  for (int i = 0; i < 2; i++) sum += disk_mag(p->s->back[i]) * p->most[i];
  return disk_up(sum) < disk_low(p->s->V);
}
