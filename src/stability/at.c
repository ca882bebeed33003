/* One formula at one point that was asked for, in words. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "stability_impl.h"

static bool parse_pair(double *x, slong *k, const struct digits_formula *f, const char *item, size_t len,
                       struct diag *d) {
  const char *equals = memchr(item, '=', len);
  char name[128], number[128], *end;
  if (!equals || equals == item || (size_t)(equals - item) >= sizeof name ||
      len - (size_t)(equals - item) > sizeof number)
    return diag_set(d, "error: --at takes NAME=VALUE,..., not %.*s", (int)(len < 200 ? len : 200), item);
  snprintf(name, sizeof name, "%.*s", (int)(equals - item), item);
  snprintf(number, sizeof number, "%.*s", (int)(len - 1 - (size_t)(equals - item)), equals + 1);
  double v = strtod(number, &end);
  bool plain = strspn(number, "+-.0123456789abcdefABCDEFpPxX") == strlen(number);
  if (!plain || end == number || *end || !isfinite(v))
    return diag_set(d, "error: %s is no finite number in double precision, decimal or hexadecimal: %s", name, number);
  *k = tape_input(&f->tape, name);
  *x = v;
  return true;
}

/* Fills the inputs of the formula; names that only other formulas have are passed over. */
static bool parse_point(double *x, const struct digits_formula *f, const char *at, struct diag *d) {
  bool have[DIGITS_INPUTS] = {false};
  for (const char *p = at; *p;) {
    size_t len = strcspn(p, ",");
    slong k = -1;
    double v = 0;
    if (!parse_pair(&v, &k, f, p, len, d)) return false;
    if (k >= 0 && have[k]) return diag_set(d, "error: %s is given twice", f->tape.inputs[k]);
    if (k >= 0) {
      x[k] = v;
      have[k] = true;
    }
    p += len + (p[len] == ',');
  }
  for (slong k = 0; k < f->tape.n_inputs; k++)
    if (!have[k])
      return diag_set(d, "error: %s is a function of %s, which --at does not give", f->id, f->tape.inputs[k]);
  return true;
}

static void print_values(struct text *out, const struct digits_bench *w) {
  const struct digits_formula *f = w->f;
  for (slong k = 0; k < f->n; k++) {
    slong i = f->out[k];
    text_printf(out, "  %-9s", k ? "" : "double");
    if (w->d_flags[i])
      text_add(out, "no value");
    else
      text_printf(out, "%.17g", *(const double *)num_vec_at(&w->d, i));
    text_add(out, "  true ");
    arb_srcptr v = num_vec_at(&w->b, i);
    if (num_print(out, v, 20) != SS_OK) num_print_ball(out, v, 20);
    text_add_char(out, '\n');
  }
}

static void print_conditions(struct text *out, struct digits_bench *w) {
  text_add(out, "  digits that each input's own rounding costs:");
  for (slong k = 0; k < w->f->tape.n_inputs; k++) {
    double c = digits_condition(w, k, k + 1) * log10(2);
    if (isnan(c))
      text_printf(out, " %s unknown", w->f->tape.inputs[k]);
    else
      text_printf(out, " %s %.1f", w->f->tape.inputs[k], fmax(0, c));
  }
  text_add_char(out, '\n');
}

static void print_cause(struct text *out, struct digits_study *st, const struct digits_formula *f,
                        struct digits_cause c) {
  text_printf(out, "  %s, at ", loss_cause_says[c.cause]);
  digits_print_node(out, &st->set, f, c.node, false);
  const char *id = digits_record_of(&st->set, f, c.node);
  text_printf(out, ", %s", id ? id : "which is written nowhere");
  if (c.grows > 0) text_printf(out, " (a relative error grows by %.1f digits there)", c.grows * log10(2));
  text_add_char(out, '\n');
}

static const char *const kind_says[] = {
    [DIGITS_OUTSIDE] = "it has no value there, or none that a double holds",
    [DIGITS_ZERO] = "its true value is zero there, or cannot be told from zero",
    [DIGITS_UNDECIDED] = "its true value is not known",
};

static bool print_formula(struct text *out, struct digits_study *st, struct digits_formula *f, const char *at,
                          struct diag *d) {
  double x[DIGITS_INPUTS] = {0};
  if (!parse_point(x, f, at, d) || (!f->kernel && !digits_slopes(f, &st->set, d))) return false;
  OWNED(digits_bench) w;
  digits_bench_init(&w, f);
  struct digits_loss r = digits_measure(&w, x, -1);
  text_printf(out, "%s: %s\n", f->id, f->text);
  if (r.kind != DIGITS_LOST && r.kind != DIGITS_FAILED) {
    text_printf(out, "  %s\n", kind_says[r.kind]);
  } else {
    print_values(out, &w);
    if (r.kind == DIGITS_LOST) {
      text_printf(out, "  error 10^%.1f units of 2^-53; of %.1f digits lost the problem loses %.1f, the formula %.1f%s",
                  fmax(-99, r.error * log10(2)), r.observed, r.problem, r.formula,
                  r.sign_lost ? "; the sign is lost" : "");
      if (f->kernel)
        text_add_char(out, '\n');
      else if (isnan(r.predicted))
        text_add(out, "; the rule predicts a failure\n");
      else
        text_printf(out, "; the rule predicts %.1f\n", fmin(STABILITY_DIGITS, fmax(0, r.predicted * log10(2))));
    }
    if (!f->kernel) print_conditions(out, &w);
    if (!f->kernel) print_cause(out, st, f, r.kind == DIGITS_FAILED ? digits_explain_failure(&w) : digits_explain(&w));
  }
  return true;
}

bool audit_stability_at(struct text *out, const struct model *m, const struct stability_options *opt, const char *at,
                        struct diag *d) {
  OWNED_CLEARED(digits_study_close) struct digits_study st;
  bool ok = digits_study_open(&st, m, opt, d);
  for (size_t i = 0; ok && i < st.n; i++) ok = print_formula(out, &st, st.formula[i], at, d);
  return ok;
}
