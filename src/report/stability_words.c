/* What the writers of the study of digits share: digits as text, the order of the ledger, a cause in words, counts.
   Digits are rounded to tenths: the library's sines and cosines may differ in their last bit from one machine to the
   next. */
#include "stability_words.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "sheet.h"

/* --- Numbers --- */

const char *stability_tenths(char buffer[32], double x) {
  if (!isfinite(x)) return NULL;
  snprintf(buffer, 32, "%.1f", x == 0 ? 0 : x);
  return buffer;
}

const char *stability_digits(char buffer[32], double x) {
  return or_dash(stability_tenths(buffer, x));
}

const char *stability_relative_error(char buffer[32], const struct stability_row *row) {
  double x = row->error - 53 * log10(2);
  if (row->observed < STABILITY_DIGITS || !isfinite(x)) return NULL;
  double power = floor(x), lead = round(pow(10, x - power));
  if (lead >= 10) {
    lead = 1;
    power++;
  }
  snprintf(buffer, 32, "%.0fe%.0f", lead, power == 0 ? 0 : power);
  return buffer;
}

const char *stability_lost(char buffer[80], const struct stability_row *row) {
  char e[32];
  if (!stability_relative_error(e, row))
    stability_tenths(buffer, row->observed);
  else if (row->sign_lost && row->error < 54 * log10(2))
    snprintf(buffer, 80, "sign");
  else
    snprintf(buffer, 80, "all digits (relative error %s%s)", e, row->sign_lost ? ", wrong sign" : "");
  return buffer;
}

void stability_add_command(struct text *out, const struct stability_result *r, const struct stability_row *row,
                           const char *witness) {
  text_printf(out, "stickslip stability \"%s\" --layer %s --at \"%s\"%s", r->formula[row->formula].id, r->layer,
              witness, r->sources ? r->sources : "");
}

int stability_by_loss(const void *a, const void *b) {
  const struct stability_row *x = *(const struct stability_row *const *)a, *y = *(const struct stability_row *const *)b;
  double p = round(10 * x->excess), q = round(10 * y->excess);
  if (p != q) return p < q ? 1 : -1;
  return x < y ? -1 : x > y;
}

const struct stability_row **stability_ledger(int *n, const struct stability_result *r) {
  const struct stability_row **row = ss_malloc(((size_t)r->n_formulas + 1) * sizeof(struct stability_row *));
  *n = 0;
  for (int i = 0; i < r->n_formulas; i++) {
    const struct stability_formula *f = &r->formula[i];
    if (f->worst >= 0) row[(*n)++] = &r->row[f->worst];
  }
  qsort(row, (size_t)*n, sizeof *row, stability_by_loss);
  return row;
}

double stability_gained(const struct stability_row *row) {
  return row->formula_lost - row->after;
}

void stability_add_cause(struct text *out, const struct stability_row *row, const char *quote) {
  text_add(out, loss_cause_says[row->cause]);
  if (row->cause == CAUSE_ARGUMENT)
    text_printf(out, ": %s%s%s", quote, row->node, quote);
  else if ((row->cause == CAUSE_CANCELLATION || row->cause == CAUSE_SMALL_DIVISOR) && row->left && row->right)
    text_printf(out, " between %s%s%s and %s%s%s", quote, row->left, quote, quote, row->right, quote);
  else
    text_printf(out, " at %s%s%s", quote, row->node, quote);
  if (row->source) text_printf(out, ", %s", row->source);
}

void stability_add_confusion(struct text *out, const struct stability_result *r) {
  markdown_head_of(out, "predicted \\ observed", loss_bin_name, N_LOSS_BINS);
  for (int a = 0; a < N_LOSS_BINS; a++) {
    text_printf(out, "| %s |", loss_bin_name[a]);
    for (int b = 0; b < N_LOSS_BINS; b++) text_printf(out, " %ld |", r->confusion[a][b]);
    text_add_char(out, '\n');
  }
  text_add_char(out, '\n');
}

/* --- Counts --- */

struct counts {
  int formulas, at_fault, failing, zero, kernels, kernels_at_fault;
  long points, diagonal, near, judged;
};

static struct counts count(const struct stability_result *r) {
  struct counts c = {.formulas = 0};
  for (int i = 0; i < r->n_formulas; i++) {
    const struct stability_formula *f = &r->formula[i];
    c.points += f->points;
    c.kernels += f->kernel;
    c.kernels_at_fault += f->kernel && f->worst >= 0 && stability_loses(&r->row[f->worst]);
    if (f->kernel) continue;
    c.formulas++;
    c.zero += f->zero;
    c.failing += f->worst_failure >= 0;
    c.at_fault += f->worst >= 0 && stability_loses(&r->row[f->worst]);
  }
  for (int a = 0; a < N_LOSS_BINS; a++)
    for (int b = 0; b < N_LOSS_BINS; b++) {
      c.judged += r->confusion[a][b];
      if (a == b) c.diagonal += r->confusion[a][b];
      if (abs(a - b) == 1 && a < N_LOSS_BINS - 1 && b < N_LOSS_BINS - 1) c.near += r->confusion[a][b];
    }
  return c;
}

void stability_add_summary(struct text *out, const struct stability_result *r) {
  struct counts c = count(r);
  text_printf(out,
              "%d formulas of the layer %s, %ld points: %d lose digits beyond the conditioning (more than %d max(1, "
              "kappa) units), %d "
              "fail somewhere, %d are zero wherever they were tried",
              c.formulas, r->layer, c.points, c.at_fault, STABILITY_ALLOWED, c.failing, c.zero);
  if (c.kernels)
    text_printf(out, "; of %d results of the program's own functions %d do so", c.kernels, c.kernels_at_fault);
  text_printf(
      out, "; the rule that names the cause predicts the observed bin at %ld of %ld points, the one beside it at %ld",
      c.diagonal, c.judged, c.near);
}
