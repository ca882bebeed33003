/* Readings in words and digits. */
#include <math.h>
#include <string.h>

#include "readings_impl.h"
#include "record/result.h"
#include "value/printed.h"

enum { PREC = FIRST_PREC, VALUE_DIGITS = 8, SLOPE_DIGITS = 4 };

/* What cannot be told from zero is shown with a bound that does not hang on the last bits. */
static const char *digits_of(struct audit_result *out, const arb_t x, slong n) {
  NUMBERS(mag, size);
  arb_get_mag(size, x);
  bool tiny = arb_contains_zero(x) && !mag_is_zero(size) && mag_cmp_2exp_si(size, -64) < 0;
  if (tiny) return "0";
  struct text t = {0};
  if (num_print(&t, x, n) != SS_OK) num_print_ball(&t, x, n);
  return result_take(out, &t);
}

static void *room(struct audit_result *out, int n, size_t size) {
  return arena_alloc(&out->arena, (size_t)(n > 0 ? n : 1) * size);
}

static const char *names(struct audit_result *out, unsigned mask, const char *none) {
  struct text t = {0};
  for (int i = 0; i < N_X; i++)
    if (mask >> i & 1) text_printf(&t, "%s%s", t.len ? ", " : "", paper_name(orbit_number_name(i)).is);
  return t.len ? result_take(out, &t) : none;
}

/* The other row of (44) for the same z_i0. */
static unsigned twin(int eq) {
  return 1U << (eq < EQ_G1 ? eq + 2 : eq - 2);
}

enum { BY_POSITIONS = 1U << EQ_F1 | 1U << EQ_F2, BY_VELOCITIES = 1U << EQ_G1 | 1U << EQ_G2 };

/* In the basis solved for z_0, a row stands for a row of (45) when z_0 comes from both rows of the other kind. */
static const char *equation_text(struct audit_result *out, int eq, const struct form *form) {
  bool row = eq >= EQ_F1, by_velocities = (form->held & BY_VELOCITIES) == BY_VELOCITIES;
  unsigned whole = by_velocities ? BY_VELOCITIES : BY_POSITIONS;
  if (!row || (form->held & whole) != whole || whole >> eq & 1 || !(form->held & twin(eq)))
    return result_str(out, "%s", equations[eq].text);
  int i = (eq - EQ_F1) % 2 + 1;
  return result_str(out, "the %s of (45), M_%d1 + M_%d2 = 0 (that the two values of z_%d0 agree)",
                    i == 1 ? "first" : "second", i, i, i);
}

/* The line of (44) that holds, where it is one of the two. */
static const char *start_text(unsigned held) {
  bool positions = (held & BY_POSITIONS) == BY_POSITIONS, velocities = (held & BY_VELOCITIES) == BY_VELOCITIES;
  if (positions == velocities) return NULL;
  return velocities ? "those of the second line of (44), $z_0=-N_3^{-1}(N_4-I)z'_0$, which differ from those of (46)"
                    : "those of (46), which differ from those of the second line of (44)";
}

static void describe_equations(struct example_reading *r, struct audit_result *out, const struct candidate *c,
                               arb_srcptr x, struct system *s) {
  unsigned all = c->form.all | 1U << EQ_12 | 1U << EQ_14;
  r->solved = room(out, N_EQ, sizeof *r->solved);
  r->dropped = room(out, N_EQ, sizeof *r->dropped);
  r->start = start_text(c->form.held);
  for (int i = 0; i < N_X; i++) arb_set(num_vec_at(&s->x, i), x + i);
  bool ok = system_eval(s, all) == SS_OK;
  for (int eq = 0; eq < N_EQ; eq++) {
    if (!(all >> eq & 1)) continue;
    const char *text = equation_text(out, eq, &c->form);
    if (c->eqs >> eq & 1)
      r->solved[r->n_solved++] = text;
    else
      r->dropped[r->n_dropped++] =
          (struct reading_dropped){text, ok ? digits_of(out, num_vec_at(&s->value, eq), SLOPE_DIGITS) : "undefined"};
  }
}

static void describe_numbers(struct example_reading *r, struct audit_result *out, const struct candidate *c,
                             arb_srcptr x, const struct example *e) {
  r->number = room(out, N_PRINTED, sizeof *r->number);
  for (int i = 0; i < N_PRINTED; i++) {
    const struct printed_number *p = e->printed[i];
    if (!p) continue;
    enum reading how = READ_ROUNDED;
    printed_fits(x + i, p, &how);
    r->number[r->n_numbers++] = (struct reading_number){
        result_str(out, "%s", p->name), result_str(out, "%s", p->decimal), digits_of(out, x + i, VALUE_DIGITS),
        i < N_X && !(c->unknown >> i & 1) ? "input" : reading_name[how]};
  }
}

/* The fewest decimals of all inputs with which their rounding, to first order, moves an output by no more than half a
   unit of its last printed decimal: 10^-d (sum of |slopes|) <= unit. */
static int decimals_needed(arb_srcptr slopes, unsigned inputs, const struct printed_number *p) {
  enum { MOST = 99 };
  NUMBERS(arb, sum, a, unit);
  for (int k = 0; k < N_X; k++) {
    arb_abs(a, slopes + k);
    if (inputs >> k & 1) arb_add(sum, sum, a, PREC);
  }
  arb_set_fmpq(unit, &p->unit, PREC);
  int d = 0;
  for (; d < MOST && !arb_le(sum, unit); d++) arb_div_ui(sum, sum, 10, PREC);
  return d < MOST ? d : -1;
}

static void describe_slopes(struct example_reading *r, struct audit_result *out, const struct candidate *c,
                            arb_srcptr x, const struct example *e, struct system *s) {
  ARB_VECTOR(slope, N_X * N_X);
  r->slope = room(out, N_X * N_X, sizeof *r->slope);
  unsigned inputs = ~c->unknown & ((1U << N_X) - 1);
  bool ok = readings_slopes(slope, NULL, s, x, c->eqs, c->unknown), known = ok;
  for (int i = 0; ok && i < N_X; i++) {
    if (inputs >> i & 1) continue;
    int d = decimals_needed(slope + i * N_X, inputs, e->printed[i]);
    known = known && d >= 0;
    if (d > r->decimals) r->decimals = d;
    for (int k = 0; k < N_X; k++)
      if (inputs >> k & 1)
        r->slope[r->n_slopes++] = (struct reading_slope){orbit_number_name(i), orbit_number_name(k),
                                                         digits_of(out, slope + i * N_X + k, SLOPE_DIGITS)};
  }
  if (!known) r->decimals = -1;
}

static void describe_assumptions(struct example_reading *r, struct audit_result *out, const struct candidate *c,
                                 const struct example *e) {
  unsigned inputs = ~c->unknown & ((1U << N_X) - 1), beyond = inputs & ~e->data, computed = c->unknown & e->data;
  struct text t = {0};
  if (beyond) text_printf(&t, "data that the paper does not name as such: %s; ", names(out, beyond, ""));
  if (computed) text_printf(&t, "named as data in the paper, but computed: %s; ", names(out, computed, ""));
  if (c->assumed[ASSUME_ZEROS])
    text_printf(&t, "last digits that are zero by chance and not printed: %d; ", c->assumed[ASSUME_ZEROS]);
  if (c->assumed[ASSUME_FORM]) text_add(&t, "a form of (18) that is not in the paper; ");
  if (c->assumed[ASSUME_CARRY]) text_add(&t, "rounding of intermediate results; ");
  if (c->assumed[ASSUME_MIXED])
    text_printf(&t, "results truncated where most are rounded, or conversely: %d; ", c->assumed[ASSUME_MIXED]);
  if (t.len) t.data[t.len -= 2] = '\0';
  r->assumed = t.len ? result_take(out, &t) : "nothing";
  for (int i = 0; i < N_ASSUMPTIONS; i++) r->assumptions += c->assumed[i];
}

void reading_describe(struct example_reading *r, struct audit_result *out, const struct candidate *c, arb_srcptr x,
                      const struct example *e, struct system *s) {
  *r = (struct example_reading){.layer = layer_name[c->layer], .carry = carry_text[c->carry], .digits = c->digits};
  r->inputs = room(out, N_X, sizeof *r->inputs);
  for (int i = 0; i < N_X; i++)
    if (!(c->unknown >> i & 1))
      r->inputs[r->n_inputs++] =
          result_str(out, "%s = %s", paper_name(orbit_number_name(i)).is, e->printed[i]->decimal);
  describe_assumptions(r, out, c, e);
  describe_equations(r, out, c, x, s);
  describe_numbers(r, out, c, x, e);
  describe_slopes(r, out, c, x, e, s);
}

/* --- The whole procedure --- */

static bool procedure_solve(arb_ptr x, const struct example *e, unsigned inputs, struct system *s,
                            struct system *search) {
  double near[N_X];
  unsigned unknown = ~inputs & ((1U << N_X) - 1);
  memcpy(near, e->value, sizeof near);
  if (!readings_newton(near, search, EQUATIONS_OF_PAPER, unknown)) return false;
  for (int i = 0; i < N_X; i++) {
    if (unknown >> i & 1)
      arb_set_d(x + i, near[i]);
    else
      arb_set_fmpq(x + i, &e->printed[i]->value, PREC);
  }
  return readings_enclose(x, s, EQUATIONS_OF_PAPER, unknown);
}

/* Rounded outwards: to nearest, after half a unit of the last digit shown. */
static const char *end_of(struct audit_result *out, const arb_t x, bool upper) {
  enum { DIGITS = 6 };
  NUMBERS(arb, end);
  if (upper)
    arb_get_ubound_arf(arb_midref(end), x, PREC);
  else
    arb_get_lbound_arf(arb_midref(end), x, PREC);
  double size = fabs(arf_get_d(arb_midref(end), ARF_RND_NEAR));
  double half = size > 0 ? pow(10, floor(log10(size)) + 1 - DIGITS) / 2 : 0;
  arf_set_d(arb_midref(end), arf_get_d(arb_midref(end), ARF_RND_NEAR) + (upper ? half : -half));
  return digits_of(out, end, DIGITS);
}

void readings_procedure(struct readings *r, struct audit_result *out, const struct example *e, struct system *s,
                        struct system *search) {
  struct readings_procedure *p = &r->procedure;
  unsigned unknown = ~e->data & ((1U << N_X) - 1);
  p->inputs = names(out, e->data, "none");
  ARB_VECTOR(v, 2 * N_X + N_X * N_X);
  arb_ptr x = v, wide = v + N_X, slope = v + 2 * N_X;
  if (procedure_solve(x, e, e->data, s, search) && readings_slopes(slope, NULL, s, x, EQUATIONS_OF_PAPER, unknown)) {
    p->output = room(out, N_X, sizeof *p->output);
    p->slope = room(out, N_X * N_X, sizeof *p->slope);
    for (int i = 0; i < N_X; i++) {
      arb_set(wide + i, x + i);
      if (e->data >> i & 1) printed_ball(wide + i, e->printed[i]);
    }
    bool bracket = readings_enclose(wide, s, EQUATIONS_OF_PAPER, unknown);
    for (int i = 0; i < N_X; i++) {
      if (!(unknown >> i & 1)) continue;
      enum reading how;
      truth t = bracket ? printed_fits(wide + i, e->printed[i], &how) : TRUTH_UNKNOWN;
      if (t == TRUTH_UNKNOWN) t = truth_or(t, printed_fits(x + i, e->printed[i], &how));
      p->output[p->n_outputs++] = (struct procedure_output){orbit_number_name(i),
                                                            result_str(out, "%s", e->printed[i]->decimal),
                                                            digits_of(out, x + i, VALUE_DIGITS),
                                                            bracket ? end_of(out, wide + i, false) : NULL,
                                                            bracket ? end_of(out, wide + i, true) : NULL,
                                                            t == TRUTH_TRUE    ? "yes"
                                                            : t == TRUTH_FALSE ? "no"
                                                                               : "open",
                                                            decimals_needed(slope + i * N_X, e->data, e->printed[i])};
      for (int k = 0; k < N_X; k++)
        if (e->data >> k & 1)
          p->slope[p->n_slopes++] = (struct reading_slope){orbit_number_name(i), orbit_number_name(k),
                                                           digits_of(out, slope + i * N_X + k, SLOPE_DIGITS)};
    }
  }
}

/* Beside the difference itself what the residuals of the dropped equations make of it to first order. */
void reading_shifts(struct example_reading *r, struct audit_result *out, const struct candidate *c, arb_srcptr x,
                    const struct example *e, struct system *s, struct system *search) {
  unsigned all = c->form.all | 1U << EQ_12 | 1U << EQ_14, unknown = ~e->data & ((1U << N_X) - 1);
  ARB_VECTOR(v, N_EQ + 2 * N_X + N_X * N_EQ);
  arb_ptr residual = v, whole = v + N_EQ, sum = whole + N_X, answer = sum + N_X;
  for (int i = 0; i < N_X; i++) arb_set(num_vec_at(&s->x, i), x + i);
  bool ok = system_eval(s, all) == SS_OK;
  for (int eq = 0; eq < N_EQ; eq++) arb_set(residual + eq, num_vec_at(&s->value, eq));
  ok = ok && procedure_solve(whole, e, e->data, s, search) && readings_slopes(NULL, answer, s, whole, all, unknown);
  for (int eq = 0; ok && eq < N_EQ; eq++)
    for (int i = 0; (all & ~c->eqs) >> eq & 1 && i < N_X; i++)
      if (unknown >> i & 1) arb_addmul(sum + i, answer + i * N_EQ + eq, residual + eq, PREC);
  r->shift = room(out, N_X, sizeof *r->shift);
  for (int i = 0; ok && i < N_X; i++) {
    if (!(unknown >> i & 1)) continue;
    arb_sub(whole + i, x + i, whole + i, PREC);
    r->shift[r->n_shifts++] = (struct reading_shift){orbit_number_name(i), digits_of(out, whole + i, SLOPE_DIGITS),
                                                     digits_of(out, sum + i, SLOPE_DIGITS)};
  }
}

void readings_pairs(struct readings *r, struct audit_result *out, const struct example *e, struct system *s,
                    struct system *search) {
  r->pair = room(out, N_X * (N_X - 1) / 2, sizeof *r->pair);
  ARB_VECTOR(x, N_PRINTED);
  for (int i = 0; i < N_X; i++)
    for (int k = i + 1; k < N_X; k++) {
      unsigned inputs = 1U << i | 1U << k;
      struct readings_pair *p = &r->pair[r->n_pairs++];
      *p = (struct readings_pair){.inputs = result_str(out, "%s, %s", orbit_number_name(i), orbit_number_name(k))};
      struct text missed = {0};
      bool ok = procedure_solve(x, e, inputs, s, search);
      if (ok) readings_bounds(x + N_X, x, e->scene);
      for (int n = 0; n < N_PRINTED; n++) {
        enum reading how;
        if (!e->printed[n]) continue;
        bool fits = ok && (n < N_X && inputs >> n & 1 ? true : printed_fits(x + n, e->printed[n], &how) == TRUTH_TRUE);
        p->n_numbers++;
        p->n_given += fits;
        if (!fits) text_printf(&missed, "%s%s", missed.len ? ", " : "", e->printed[n]->name);
      }
      const char *list = result_take(out, &missed);
      p->missed = ok ? list : NULL;
    }
}
