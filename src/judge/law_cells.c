/* The law on cells of states, see law.h: exact arithmetic over symbols of known sign. */
#include <string.h>

#include "law.h"
#include "num/num_exact.h"
#include "tape/exact.h"

/* Generators: the first N_POSITIVE are positive. */
enum {
  GEN_CHI,
  GEN_ETA,
  GEN_BELT,
  GEN_NEAR, /* how far f is from a limit, and from the other one */
  GEN_FAR,
  GEN_LAG,   /* |V - x'| */
  GEN_SLIDE, /* u_s of each mass, and u_r - u_s */
  GEN_RISE = GEN_SLIDE + 2,
  N_POSITIVE = GEN_RISE + 2,
  GEN_X = N_POSITIVE,
  GEN_V = GEN_X + 2,
  GEN_A = GEN_V + 2,
  GEN_U = GEN_A + 2,
  GEN_FORCE = GEN_U + 2,
  GEN_FREE,
  GEN_UNKNOWN
};

/* In balls no sum or difference of these and of what a program is likely to contain vanishes by chance. */
static val generator(struct law_state *s, slong k) {
  if (s->c.ctx.type == &num_arb) return calc_d(&s->c, 0.37890625 + 0.40625 * (double)k);
  void *z = calc_new(&s->c);
  fmpz_mpoly_q_gen(z, k, num_exact_ctx());
  return z;
}

val law_free(struct law_state *s) {
  return generator(s, GEN_FREE);
}

void law_state_open(struct law_state *s, struct num_ctx ctx) {
  *s = (struct law_state){.c = calc_begin(ctx)};
  s->chi = generator(s, GEN_CHI);
  s->eta = generator(s, GEN_ETA);
  s->belt = generator(s, GEN_BELT);
  s->eps = calc_d(&s->c, 1);
  for (int i = 0; i < 2; i++) {
    s->x[i] = generator(s, GEN_X + i);
    s->v[i] = generator(s, GEN_V + i);
    s->a[i] = generator(s, GEN_A + i);
    s->u[i] = generator(s, GEN_U + i);
    s->slide[i] = generator(s, GEN_SLIDE + i);
    s->limit[i] = calc_add(&s->c, s->slide[i], generator(s, GEN_RISE + i));
    s->shift[i] = calc_d(&s->c, 0);
  }
}

void law_state_clear(struct law_state *s) {
  calc_clear(&s->c);
}

val law_pull(struct law_state *s, int mass) {
  struct calc *c = &s->c;
  return mass ? calc_mul(c, s->chi, calc_sub(c, s->x[1], s->x[0])) : calc_sub(c, s->x[0], calc_mul(c, s->chi, s->x[1]));
}

/* The mass's own place so that f has the value. */
static void place(struct law_state *s, int mass, val f) {
  struct calc *c = &s->c;
  s->x[mass] = mass ? calc_add(c, s->x[0], calc_div(c, f, s->chi)) : calc_add(c, f, calc_mul(c, s->chi, s->x[1]));
}

void law_state_open_in(struct law_state *s, struct law_cell cell) {
  law_state_open(s, num_ctx_exact());
  struct calc *c = &s->c;
  int i = cell.mass;
  val near = generator(s, GEN_NEAR), far = generator(s, GEN_FAR), f = generator(s, GEN_FORCE);
  if (cell.pull == PULL_INSIDE) {
    s->limit[i] = calc_div_ui(c, calc_add(c, near, far), 2);
    f = calc_div_ui(c, calc_sub(c, near, far), 2);
  } else if (cell.pull != PULL_ANY) {
    f = cell.pull == PULL_AT || cell.pull == PULL_BEYOND ? s->limit[i] : s->slide[i];
    if (cell.pull == PULL_BEYOND || cell.pull == PULL_OVER) f = calc_add(c, f, near);
    if (cell.pull == PULL_UNDER) f = calc_sub(c, f, near);
    if (cell.side < 0) f = calc_neg(c, f);
  }
  place(s, i, f);
  val lag = generator(s, GEN_LAG);
  s->v[i] = cell.speed == 0 ? s->belt : cell.speed > 0 ? calc_sub(c, s->belt, lag) : calc_add(c, s->belt, lag);
}

/* --- Signs --- */

static int ball_sign(arb_srcptr x) {
  bool zero = arb_contains_zero(x) && mag_cmp_2exp_si(arb_radref(x), -FIRST_PREC / 2) < 0;
  return arb_is_positive(x) ? 1 : arb_is_negative(x) ? -1 : zero ? 0 : NO_SIGN;
}

int law_sign(const struct law_state *s, val x) {
  if (s->c.status != SS_OK || !x) return NO_SIGN;
  if (s->c.ctx.type == &num_arb) return ball_sign(x);
  const fmpz_mpoly_q_struct *z = x;
  bool positive[NUM_EXACT_GENERATORS];
  for (int g = 0; g < NUM_EXACT_GENERATORS; g++) positive[g] = g < N_POSITIVE;
  if (fmpz_mpoly_is_zero(&z->num, num_exact_ctx())) return 0;
  int sign = exact_terms_sign(&z->num, positive, false) * exact_terms_sign(&z->den, positive, false);
  return sign ? sign : NO_SIGN;
}

truth law_vanishes(const struct law_state *s, val x) {
  return s->c.status != SS_OK || !x ? TRUTH_UNKNOWN : num_exact.is_zero(x);
}

/* In the places and velocities together. */
static slong degree(const fmpz_mpoly_struct *p) {
  slong e[NUM_EXACT_GENERATORS], most = 0;
  for (slong i = 0; i < fmpz_mpoly_length(p, num_exact_ctx()); i++) {
    slong sum = 0;
    fmpz_mpoly_get_term_exp_si(e, p, i, num_exact_ctx());
    for (int g = GEN_X; g < GEN_A; g++) sum += e[g];
    most = FLINT_MAX(most, sum);
  }
  return most;
}

truth law_affine(const struct law_state *s, val x) {
  const fmpz_mpoly_q_struct *z = x;
  if (s->c.status != SS_OK || !x) return TRUTH_UNKNOWN;
  return degree(&z->num) <= 1 && degree(&z->den) == 0 ? TRUTH_TRUE : TRUTH_FALSE;
}

bool law_rational(fmpq_t out, const struct law_state *s, val x) {
  const fmpz_mpoly_q_struct *z = x;
  bool ok = s->c.status == SS_OK && fmpz_mpoly_is_fmpz(&z->num, num_exact_ctx()) &&
            fmpz_mpoly_is_fmpz(&z->den, num_exact_ctx());
  return ok && num_exact_at(out, z, NULL) == SS_OK;
}

/* --- Values --- */

/* A name that the law does not know may have any value. */
static val any_value(struct law_state *s, const char *name) {
  enum { MOST = (int)(sizeof s->unknown / sizeof *s->unknown) };
  int i = 0;
  while (i < s->n_unknown && strcmp(s->unknown[i], name) != 0) i++;
  if (i == MOST || strlen(name) >= sizeof *s->unknown) return NULL;
  if (i == s->n_unknown) strcpy(s->unknown[s->n_unknown++], name);
  return generator(s, GEN_UNKNOWN + i);
}

static val named(struct law_state *s, const char *name, const struct law *l) {
  if (l && strcmp(name, l->names[0]) == 0) return s->slide[l->mass];
  if (l && strcmp(name, l->names[1]) == 0) return s->limit[l->mass];
  static const char *const of_mass[2][9] = {
      {"x_1(t)", "x_1'(t)", "z_1'(t)", "x_1''(t)", "u_1", "u_s1", "u_r1", "e_1", "z_1(t)"},
      {"x_2(t)", "x_2'(t)", "z_2'(t)", "x_2''(t)", "u_2", "u_s2", "u_r2", "e_2", "z_2(t)"}};
  for (int i = 0; i < 2; i++) {
    const val value[7] = {s->x[i], s->v[i], s->v[i], s->a[i], s->u[i], s->slide[i], s->limit[i]};
    for (int k = 0; k < 7; k++)
      if (strcmp(of_mass[i][k], name) == 0) return value[k];
    if (strcmp(of_mass[i][7], name) == 0) return calc_sub(&s->c, s->limit[i], s->slide[i]);
    if (strcmp(of_mass[i][8], name) == 0) return calc_sub(&s->c, s->x[i], s->shift[i]);
  }
  return strcmp(name, "chi") == 0   ? s->chi
         : strcmp(name, "eta") == 0 ? s->eta
         : strcmp(name, "V") == 0   ? s->belt
         : strcmp(name, "eps") == 0 ? s->eps
                                    : any_value(s, name);
}

bool law_values(struct num_vec *out, struct law_state *s, const struct tape *t, const struct law *names) {
  struct num_vec in = calc_vec(&s->c, t->n_inputs);
  *out = calc_vec(&s->c, t->n_outputs);
  for (slong i = 0; i < in.len; i++) {
    val x = named(s, t->inputs[i], names);
    if (!x) return false;
    s->c.ctx.type->set(num_vec_at(&in, i), x);
  }
  return s->c.status == SS_OK && tape_eval(out, NULL, t, &in) == SS_OK;
}

val law_value(struct law_state *s, const struct tape *t, const struct law *names) {
  struct num_vec out;
  return law_values(&out, s, t, names) ? num_vec_at(&out, 0) : NULL;
}

val law_solve(struct law_state *s, val *unknown, const struct condition *equation, const struct law *names) {
  struct calc *c = &s->c;
  val kept = *unknown, m[3];
  for (int i = 0; i < 3; i++) { /* at 0, 1 and any other value */
    *unknown = i < 2 ? calc_d(c, i) : law_free(s);
    m[i] = law_value(s, &equation->s.tape, names);
  }
  *unknown = kept;
  if (!equation->equality || !m[0] || !m[1] || !m[2]) return NULL;
  val slope = calc_sub(c, m[1], m[0]);
  int sign = law_sign(s, slope);
  bool line = law_sign(s, calc_sub(c, calc_sub(c, m[2], m[0]), calc_mul(c, slope, law_free(s)))) == 0;
  return line && (sign == 1 || sign == -1) ? calc_neg(c, calc_div(c, m[0], slope)) : NULL;
}

/* --- Branches --- */

truth law_holds(const struct law *l, struct law_state *s, enum branch b) {
  truth all = TRUTH_TRUE;
  val any = s->u[l->mass], u = law_friction(l, s, b);
  if (u) s->u[l->mass] = u;
  for (int k = 0; k < l->branch[b].n; k++) {
    const struct condition *c = &l->branch[b].at[k];
    if (c->equality) continue;
    int sign = law_sign(s, law_value(s, &c->s.tape, l));
    truth holds = sign == NO_SIGN                                                         ? TRUTH_UNKNOWN
                  : sign > 0 || (sign == 0 && (!c->strict || (l->closed && b == BREAKS))) ? TRUTH_TRUE
                                                                                          : TRUTH_FALSE;
    all = truth_and(all, holds);
  }
  s->u[l->mass] = any;
  return all;
}

val law_friction(const struct law *l, struct law_state *s, enum branch b) {
  val u = NULL;
  for (int k = 0; k < l->branch[b].n; k++) {
    if (!l->branch[b].at[k].equality) continue;
    val solved = law_solve(s, &s->u[l->mass], &l->branch[b].at[k], l);
    if (!solved || (u && law_sign(s, calc_sub(&s->c, u, solved)) != 0)) return NULL;
    u = solved;
  }
  return u;
}

truth law_headed(const struct law *l, struct law_state *s) {
  struct num_vec out;
  if (!l->headed || !law_values(&out, s, &l->heading.tape, l)) return TRUTH_UNKNOWN;
  truth all = TRUTH_TRUE;
  for (slong i = 0; i < l->heading.n; i++) {
    int sign = law_sign(s, calc_sub(&s->c, num_vec_at(&out, i), num_vec_at(&out, l->heading.n + i)));
    all = truth_and(all, sign == NO_SIGN ? TRUTH_UNKNOWN : sign == 0 ? TRUTH_TRUE : TRUTH_FALSE);
  }
  return all;
}

/* The branches in the order in which they are asked, with their signs; where the mass moves, the last two.  That of
   slipping might hold at the belt's velocity, too. */
static const int eps_of[] = {0, 1, -1, 1, -1};
enum { N_CASES = sizeof eps_of / sizeof *eps_of, FIRST_SLIP = 3 };

static enum branch take_case(struct law_state *s, int i) {
  s->eps = calc_d(&s->c, eps_of[i] ? eps_of[i] : 1);
  return i >= FIRST_SLIP ? SLIPS : i > 0 ? BREAKS : STICKS;
}

struct law_answer law_answer(const struct law *l, struct law_state *s, int speed) {
  struct law_answer a = {0, SLIPS, speed, NULL};
  for (int i = speed ? FIRST_SLIP : 0; i < N_CASES && a.n >= 0; i++) {
    enum branch b = take_case(s, i);
    truth holds = law_holds(l, s, b);
    if (holds == TRUTH_FALSE) continue;
    val u = law_friction(l, s, b);
    bool known = holds == TRUTH_TRUE && u;
    if (known && a.n == 0) a = (struct law_answer){0, b, eps_of[i], u};
    a.n = known ? a.n + 1 : -1;
  }
  return a;
}

/* Does one of the branch's equations fail with the friction? */
static bool denies(const struct law *l, struct law_state *s, enum branch b, val u) {
  val any = s->u[l->mass];
  bool fails = false;
  s->u[l->mass] = u;
  for (int k = 0; k < l->branch[b].n; k++) {
    const struct condition *c = &l->branch[b].at[k];
    int sign = c->equality ? law_sign(s, law_value(s, &c->s.tape, l)) : 0;
    fails = fails || sign == 1 || sign == -1;
  }
  s->u[l->mass] = any;
  return fails;
}

bool law_denies(const struct law *l, struct law_state *s, int speed, val u) {
  bool all = true;
  for (int i = speed ? FIRST_SLIP : 0; i < N_CASES; i++) {
    enum branch b = take_case(s, i);
    all = all && (law_holds(l, s, b) == TRUTH_FALSE || denies(l, s, b, u));
  }
  return all;
}
