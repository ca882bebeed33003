/* The closed form of each phase.

   The forces are linear in w = z_1 - chi z_2 and r = z_2 - z_1.  In phase Gamma w oscillates with frequency 1, in
   phase C r with frequency sqrt(chi eta), in phase H both together with the two frequencies of K.  Each phase is kept
   as the 2x2 blocks C = cos(sqrt(K) t), S = sin(sqrt(K) t)/sqrt(K) and N = -K S = C', which a flow applies and a
   derivative reuses. */
#include "flow.h"
#include "rounded.h"

const char *const phase_name[N_PHASES] = {"D", "Gamma", "H", "C"};
const int phase_slips[N_PHASES][2] = {
    [PHASE_D] = {0, 0}, [PHASE_GAMMA] = {1, 0}, [PHASE_H] = {1, 1}, [PHASE_C] = {0, 1}};

bool dyn_in_domain(const fmpq *params, int n) {
  for (int i = 0; i < n; i++)
    if (fmpq_sgn(params + i) <= 0) return false;
  return fmpz_cmp(fmpq_numref(params + P_CHI), fmpq_denref(params + P_CHI)) < 0;
}

struct spectrum flow_spectrum(struct calc *c, const val p[N_PARAMS]) {
  /* The eigenvalues of K are 1 + above and 1 - below: above * below = chi^2 eta, above - below = chi eta - 1.  The one
     without cancellation comes first; the smaller eigenvalue is the product, chi eta (1 - chi), over the larger. */
  val one = calc_d(c, 1), half = calc_d(c, 0.5), zero = calc_d(c, 0);
  val stiff = calc_mul(c, p[P_CHI], p[P_ETA]), couple = calc_mul(c, p[P_CHI], stiff);
  val lead = calc_sub(c, stiff, one);
  val gap = calc_sqrt(c, calc_add(c, calc_mul(c, lead, lead), calc_mul(c, calc_d(c, 4), couple)));
  val above, below;
  if (calc_lt(c, zero, lead)) {
    above = calc_mul(c, half, calc_add(c, gap, lead));
    below = calc_div(c, couple, above);
  } else {
    below = calc_mul(c, half, calc_sub(c, gap, lead));
    above = calc_div(c, couple, below);
  }
  val large = calc_add(c, one, above);
  val small = calc_div(c, calc_mul(c, stiff, calc_sub(c, one, p[P_CHI])), large);
  return (struct spectrum){{calc_sqrt(c, small), calc_sqrt(c, large)},
                           calc_div(c, above, gap),
                           calc_div(c, below, gap),
                           calc_div(c, p[P_CHI], gap),
                           calc_div(c, stiff, gap),
                           gap};
}

/* lead = f1 - f2. */
static void function_of(val out[4], struct calc *c, const struct spectrum *s, val f1, val f2, val lead) {
  out[0] = calc_dot(c, s->above, f1, s->below, f2);
  out[1] = calc_mul(c, s->couple, lead);
  out[2] = calc_mul(c, s->back, lead);
  out[3] = calc_dot(c, s->below, f1, s->above, f2);
}

/* sin x, cos x, 1 - cos x and x - sin x; the last two cancel where x is small. */
struct circular {
  val sine, cosine, versine, lag;
  bool small;
};

static struct circular circular_at(struct calc *c, val x) {
  struct circular r = {.small = calc_exponent(c, x) <= -2};
  val one = calc_d(c, 1);
  if (r.small) {
    calc_sin_versine(c, &r.sine, &r.versine, x);
    r.cosine = calc_sub(c, one, r.versine);
    r.lag = calc_mul(c, x, calc_mul(c, calc_mul(c, x, x), calc_stumpff(c, x)));
  } else {
    calc_sin_cos(c, &r.sine, &r.cosine, x);
    r.versine = calc_sub(c, one, r.cosine);
    r.lag = calc_sub(c, x, r.sine);
  }
  return r;
}

static void set_block(val out[4], val a, val b, val c, val d) {
  out[0] = a;
  out[1] = b;
  out[2] = c;
  out[3] = d;
}

static void blocks_stick(struct blocks *b, struct calc *c, val t) {
  val zero = calc_d(c, 0), one = calc_d(c, 1);
  set_block(b->c, one, zero, zero, one);
  set_block(b->s, t, zero, zero, t);
  set_block(b->n, zero, zero, zero, zero);
}

/* m2 keeps its velocity, w oscillates, z_1 = w + chi z_2. */
static void blocks_gamma(struct blocks *b, struct calc *c, val chi, val t) {
  val zero = calc_d(c, 0), one = calc_d(c, 1);
  struct circular x = circular_at(c, t);
  set_block(b->c, x.cosine, calc_mul(c, chi, x.versine), zero, one);
  set_block(b->s, x.sine, calc_mul(c, chi, x.lag), zero, t);
  set_block(b->n, calc_neg(c, x.sine), calc_mul(c, chi, x.sine), zero, zero);
}

/* m1 keeps its velocity, r oscillates, z_2 = z_1 + r. */
static void blocks_c(struct blocks *b, struct calc *c, val omega, val t) {
  val zero = calc_d(c, 0), one = calc_d(c, 1);
  struct circular x = circular_at(c, calc_mul(c, omega, t));
  val slow = calc_div(c, x.sine, omega), fast = calc_mul(c, x.sine, omega);
  val behind = x.small ? calc_div(c, x.lag, omega) : calc_sub(c, t, slow);
  set_block(b->c, one, zero, x.versine, x.cosine);
  set_block(b->s, t, zero, behind, slow);
  set_block(b->n, zero, zero, fast, calc_neg(c, fast));
}

void flow_blocks_h(struct blocks *b, struct calc *c, const struct spectrum *s, val t) {
  struct circular x[2];
  val slow[2], fast[2];
  for (int i = 0; i < 2; i++) {
    x[i] = circular_at(c, calc_mul(c, s->om[i], t));
    slow[i] = calc_div(c, x[i].sine, s->om[i]);
    fast[i] = calc_neg(c, calc_mul(c, x[i].sine, s->om[i]));
  }
  bool small = x[0].small && x[1].small;
  val turned = small ? calc_sub(c, x[1].versine, x[0].versine) : calc_sub(c, x[0].cosine, x[1].cosine);
  val moved = small ? calc_sub(c, calc_div(c, x[1].lag, s->om[1]), calc_div(c, x[0].lag, s->om[0]))
                    : calc_sub(c, slow[0], slow[1]);
  function_of(b->c, c, s, x[0].cosine, x[1].cosine, turned);
  function_of(b->s, c, s, slow[0], slow[1], moved);
  function_of(b->n, c, s, fast[0], fast[1], calc_sub(c, fast[0], fast[1]));
}

struct blocks flow_blocks(struct calc *c, enum phase ph, const val p[N_PARAMS], val t) {
  struct blocks b;
  if (ph == PHASE_D) {
    blocks_stick(&b, c, t);
  } else if (ph == PHASE_GAMMA) {
    blocks_gamma(&b, c, p[P_CHI], t);
  } else if (ph == PHASE_H) {
    struct spectrum s = flow_spectrum(c, p);
    flow_blocks_h(&b, c, &s, t);
  } else {
    blocks_c(&b, c, calc_sqrt(c, calc_mul(c, p[P_CHI], p[P_ETA])), t);
  }
  return b;
}

void flow_apply(val out[N_STATE], struct calc *c, const struct blocks *b, const val in[N_STATE]) {
  for (int i = 0; i < 2; i++) {
    val near = calc_dot(c, b->c[2 * i], in[Z_1], b->c[2 * i + 1], in[Z_2]);
    val speed = calc_dot(c, b->c[2 * i], in[DZ_1], b->c[2 * i + 1], in[DZ_2]);
    out[Z_1 + i] = calc_add(c, near, calc_dot(c, b->s[2 * i], in[DZ_1], b->s[2 * i + 1], in[DZ_2]));
    out[DZ_1 + i] = calc_add(c, speed, calc_dot(c, b->n[2 * i], in[Z_1], b->n[2 * i + 1], in[Z_2]));
  }
}

val flow_entry(const struct blocks *b, int i, int j) {
  const val *block = (i < 2) == (j < 2) ? b->c : i < 2 ? b->s : b->n;
  return block[2 * (i % 2) + j % 2];
}

val flow_force(struct calc *c, int mass, val chi, const val z[2]) {
  return mass == 0 ? calc_sub(c, z[0], calc_mul(c, chi, z[1])) : calc_mul(c, chi, calc_sub(c, z[1], z[0]));
}

void flow_field(val f[N_STATE], struct calc *c, enum phase ph, const val p[N_PARAMS], const val z[N_STATE]) {
  f[Z_1] = z[DZ_1];
  f[Z_2] = z[DZ_2];
  f[DZ_1] = phase_slips[ph][0] ? calc_neg(c, flow_force(c, 0, p[P_CHI], z)) : NULL;
  f[DZ_2] = phase_slips[ph][1] ? calc_mul(c, calc_mul(c, p[P_CHI], p[P_ETA]), calc_sub(c, z[Z_1], z[Z_2])) : NULL;
}

val flow_switching_along(struct calc *c, enum phase ph, val chi, const val v[N_STATE]) {
  if (ph == PHASE_D || ph == PHASE_GAMMA) return flow_force(c, ph == PHASE_GAMMA, chi, v);
  return v[ph == PHASE_H ? DZ_1 : DZ_2];
}

val flow_switching(struct calc *c, enum phase ph, const val p[N_PARAMS], const val z[N_STATE]) {
  static const int limit[N_PHASES] = {P_E1, P_E2, P_V, P_V};
  return calc_sub(c, flow_switching_along(c, ph, p[P_CHI], z), p[limit[ph]]);
}

val flow_switching_rate(struct calc *c, enum phase ph, const val p[N_PARAMS], const val z[N_STATE]) {
  val f[N_STATE];
  flow_field(f, c, ph, p, z);
  return flow_switching_along(c, ph, p[P_CHI], f);
}

static void flow_formula(val *out, struct calc *c, enum phase ph, const val p[N_PARAMS], const val *in, val t) {
  struct blocks b = flow_blocks(c, ph, p, t);
  flow_apply(out, c, &b, in);
}

static void matrix_formula(val *out, struct calc *c, enum phase ph, const val p[N_PARAMS], const val *in, val t) {
  (void)in;
  struct blocks b = flow_blocks(c, ph, p, t);
  for (int i = 0; i < N_STATE; i++)
    for (int j = 0; j < N_STATE; j++) out[N_STATE * i + j] = flow_entry(&b, i, j);
}

static void switching_formula(val *out, struct calc *c, enum phase ph, const val p[N_PARAMS], const val *z, val t) {
  (void)t;
  out[0] = flow_switching(c, ph, p, z);
}

static void along_formula(val *out, struct calc *c, enum phase ph, const val p[N_PARAMS], const val *v, val t) {
  (void)t;
  out[0] = flow_switching_along(c, ph, p[P_CHI], v);
}

static void rate_formula(val *out, struct calc *c, enum phase ph, const val p[N_PARAMS], const val *z, val t) {
  (void)t;
  out[0] = flow_switching_rate(c, ph, p, z);
}

int dyn_flow(struct num_vec *out, enum phase ph, const struct num_vec *params, const struct num_vec *in,
             const void *t) {
  return rounded_run(out, flow_formula, ph, params, in, t);
}

int dyn_flow_matrix(struct num_vec *out, enum phase ph, const struct num_vec *params, const void *t) {
  return rounded_run(out, matrix_formula, ph, params, NULL, t);
}

int dyn_switching(void *value, enum phase ph, const struct num_vec *params, const struct num_vec *z) {
  struct num_vec out = {params->ctx, 1, value};
  return rounded_run(&out, switching_formula, ph, params, z, NULL);
}

int dyn_switching_along(void *value, enum phase ph, const struct num_vec *params, const struct num_vec *v) {
  struct num_vec out = {params->ctx, 1, value};
  return rounded_run(&out, along_formula, ph, params, v, NULL);
}

int dyn_switching_rate(void *value, enum phase ph, const struct num_vec *params, const struct num_vec *z) {
  struct num_vec out = {params->ctx, 1, value};
  return rounded_run(&out, rate_formula, ph, params, z, NULL);
}
