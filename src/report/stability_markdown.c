/* Where digits are lost, for people: the worst formulas, their replacements, the nodes, the failures, and how well the
   rule that explains the loss predicts it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sheet.h"
#include "stability.h"
#include "stability_words.h"

/* Rows of a table that people read; ledger.tsv has them all. */
enum { MOST_LOSING = 60, MOST_KERNELS = 15, MOST_NODES = 15, MOST_FAILING = 15 };

static void add_rest(struct text *out, int n, int most) {
  if (n > most) text_printf(out, "\nand %d more.\n", n - most);
  text_add_char(out, '\n');
}

/* 10^x, to a power of ten. */
static const char *power_of_ten(char buffer[32], double x) {
  if (!isfinite(x)) return "-";
  snprintf(buffer, 32, "1e%.0f", x == 0 ? 0 : x);
  return buffer;
}

/* --- The formulas and what replaces them --- */

/* "stable-45 and 9 more, proved": the last record of the replacement is the nearest to the formula. */
static void add_replacement(struct text *out, const struct stability_formula *f) {
  if (!f->replacement) {
    text_add_char(out, '-');
    return;
  }
  int more = 0;
  const char *last = f->replacement;
  for (const char *p = f->replacement; (p = strstr(p, ", ")); p += 2) {
    last = p + 2;
    more++;
  }
  text_add(out, last);
  if (more) text_printf(out, " and %d more", more);
  text_add(out, f->proved ? ", proved" : ", not proved");
}

struct other_form {
  double most; /* over all regions */
  long failures;
};

static struct other_form other_form(const struct stability_result *r, int formula) {
  struct other_form o = {(double)NAN, 0};
  for (int k = 0; k < r->n_regions; k++) {
    const struct stability_row *row = stability_row_at(r, formula, k);
    if (!isnan(row->after_most)) o.most = isnan(o.most) ? row->after_most : fmax(o.most, row->after_most);
    o.failures += row->after_failures;
  }
  return o;
}

static void add_after(struct text *out, const struct stability_result *r, const struct stability_row *row) {
  char a[32], b[32], c[32];
  struct other_form o = other_form(r, row->formula);
  add_replacement(out, &r->formula[row->formula]);
  text_printf(out, " | %s | %s | %s | %ld | ", stability_digits(a, row->after),
              stability_digits(b, stability_gained(row)), stability_digits(c, o.most), o.failures);
}

/* Of the formulas, or of the program's functions. */
static void add_ledger(struct text *out, const struct stability_result *r, bool kernels) {
  char a[80], b[32], c[32];
  int n, shown = 0, most = kernels ? MOST_KERNELS : MOST_LOSING;
  bool after = r->after && !kernels;
  FREED const struct stability_row **row = stability_ledger(&n, r);
  markdown_head(out, after ? "formula|equation|region|lost:|by the problem:|by the formula:|cause|replacement|after:|"
                             "gained:|after, most:|fails:|witness"
                           : "formula|equation|region|lost:|by the problem:|by the formula:|cause|witness");
  for (int i = 0; i < n; i++) {
    const struct stability_formula *f = &r->formula[row[i]->formula];
    if (!stability_loses(row[i]) || f->kernel != kernels || shown++ >= most) continue;
    text_printf(out, "| `%s` | %s | %s | %s | %s | %s | ", f->id, *f->equation ? f->equation : f->record,
                r->region[row[i]->region].id, stability_lost(a, row[i]), stability_digits(b, row[i]->problem),
                stability_digits(c, row[i]->excess));
    stability_add_cause(out, row[i], "`");
    text_add(out, " | ");
    if (after) add_after(out, r, row[i]);
    text_printf(out, "`%s` |\n", row[i]->witness);
  }
  add_rest(out, shown, most);
}

/* Formulas whose replacement loses more than is allowed or fails somewhere, the worst first come first. */
static void add_unmended(struct text *out, const struct stability_result *r) {
  char a[32];
  int n = 0, kept = 0;
  markdown_head(out, "formula|replacement|region|loses by itself:|at");
  for (int i = 0; i < r->n_formulas; i++) {
    const struct stability_row *worst = NULL;
    for (int k = 0; k < r->n_regions; k++) {
      const struct stability_row *row = stability_row_at(r, i, k);
      if (!isnan(row->after_most) && (!worst || row->after_most > worst->after_most)) worst = row;
    }
    if (!worst) continue;
    if (worst->after_most <= log10(STABILITY_ALLOWED)) {
      kept++;
      continue;
    }
    if (n++ >= MOST_NODES) continue;
    text_printf(out, "| `%s` | ", r->formula[i].id);
    add_replacement(out, &r->formula[i]);
    text_printf(out, " | %s | %s | `%s` |\n", r->region[worst->region].id, stability_digits(a, worst->after_most),
                worst->after_witness);
  }
  add_rest(out, n, MOST_NODES);
  text_printf(out, "%d replaced formulas stay within %d max(1, kappa) units in every region, %d do not.\n\n", kept,
              STABILITY_ALLOWED, n);
}

/* What is left of the points at which a replacement falls short when it is rounded as a whole. */
static void add_rounded(struct text *out, const struct stability_result *r) {
  long fall_short = 0, remain = 0;
  for (long i = 0; i < r->n_rows; i++) {
    fall_short += r->row[i].after_short;
    remain += r->row[i].after_rounded;
  }
  text_printf(
      out,
      "%ld times the searches noted that a replacement has no value or loses more than that, by points that they "
      "met first or that were worse than those before. Under rounded(), which computes a form as precisely as it "
      "takes and rounds it once, %ld of them remain: the balls that say what is true settle there, and rounded() "
      "takes its value from such balls.\n\n",
      fall_short, remain);
}

/* The stable forms in balls, and where they have not the corrected form's value. */
static void add_pairs(struct text *out, const struct stability_result *r) {
  int failing = 0;
  long points = 0, undecided = 0;
  for (int i = 0; i < r->n_pairs; i++) {
    points += r->pair[i].points;
    undecided += r->pair[i].undecided;
    failing += stability_pair_fails(&r->pair[i]);
  }
  text_printf(out,
              "%d formulas of the corrected layer stand beside their stable forms, both in balls, at %ld points of the "
              "regions where the corrected form has a finite value (at %ld of them one that is not known to 32 bits, "
              "as where it is zero): ",
              r->n_pairs, points, undecided);
  text_printf(out, failing ? "%d have not the same value everywhere.\n\n" : "all have the same value everywhere.\n\n",
              failing);
  if (failing) markdown_head(out, "formula|points:|no value:|another value:|region|at");
  for (int i = 0; i < r->n_pairs; i++) {
    const struct stability_pair *p = &r->pair[i];
    if (!stability_pair_fails(p)) continue;
    text_printf(out, "| `%s` | %ld | %ld | %ld | %s | `%s` |\n", p->formula, p->points, p->lost, p->differ, p->region,
                p->witness);
  }
  if (failing) text_add_char(out, '\n');
}

/* --- The nodes at which digits go --- */

struct culprit {
  const struct stability_row *worst;
  int formulas, last; /* last: the formula counted last */
};

static bool same_node(const struct stability_row *a, const struct stability_row *b) {
  return a->cause == b->cause && strcmp(a->node, b->node) == 0;
}

static int by_formulas(const void *a, const void *b) {
  const struct culprit *x = a, *y = b;
  if (x->formulas != y->formulas) return x->formulas < y->formulas ? 1 : -1;
  return stability_by_loss(&x->worst, &y->worst);
}

/* Every row in which a formula loses digits counts for the node that loses them.  An array to be freed. */
static struct culprit *culprits(int *n, const struct stability_result *r) {
  struct culprit *c = NULL;
  size_t len = 0, cap = 0;
  for (long i = 0; i < r->n_rows; i++) {
    const struct stability_row *row = &r->row[i];
    if (!stability_loses(row) || r->formula[row->formula].kernel) continue;
    size_t k = 0;
    while (k < len && !same_node(c[k].worst, row)) k++;
    if (k == len) *SS_PUSH(c, len, cap) = (struct culprit){row, 0, -1};
    c[k].formulas += c[k].last != row->formula;
    c[k].last = row->formula;
    if (stability_by_loss(&row, &c[k].worst) < 0) c[k].worst = row;
  }
  if (len) qsort(c, len, sizeof *c, by_formulas);
  *n = (int)len;
  return c;
}

static void add_culprits(struct text *out, const struct stability_result *r) {
  char a[32];
  int n;
  FREED struct culprit *c = culprits(&n, r);
  markdown_head(out, "formulas:|cause|digits:|worst in|region");
  for (int i = 0; i < n && i < MOST_NODES; i++) {
    const struct stability_row *row = c[i].worst;
    text_printf(out, "| %d | ", c[i].formulas);
    stability_add_cause(out, row, "`");
    text_printf(out, " | %s | `%s` | %s |\n", stability_digits(a, row->excess), r->formula[row->formula].id,
                r->region[row->region].id);
  }
  add_rest(out, n, MOST_NODES);
}

static void add_failures(struct text *out, const struct stability_result *r) {
  markdown_head(out, "formula|region|failure|node|which is|witness");
  char a[32];
  int n = 0;
  for (int i = 0; i < r->n_formulas; i++) {
    if (r->formula[i].worst_failure < 0 || r->formula[i].kernel || n++ >= MOST_FAILING) continue;
    const struct stability_row *row = &r->row[r->formula[i].worst_failure];
    text_printf(out, "| `%s` | %s | %s | `%s` | %s | `%s` |\n", r->formula[i].id, r->region[row->region].id,
                loss_cause_says[row->failure], row->failure_node, power_of_ten(a, row->failure_size),
                row->failure_witness);
  }
  add_rest(out, n, MOST_FAILING);
}

static void add_regions(struct text *out, const struct stability_result *r) {
  char a[32];
  markdown_head(out, "region|what it is|points:|formulas that lose digits:|that fail:|the worst|loses:");
  for (int k = 0; k < r->n_regions; k++) {
    int losing = 0, failing = 0;
    const struct stability_row *worst = NULL;
    for (int i = 0; i < r->n_formulas; i++) {
      const struct stability_row *row = stability_row_at(r, i, k);
      losing += stability_loses(row);
      failing += row->failures > 0;
      if (row->found && (!worst || stability_by_loss(&row, &worst) < 0)) worst = row;
    }
    text_printf(out, "| %s | %s | %ld | %d | %d | %s%s%s | %s |\n", r->region[k].id, r->region[k].says,
                stability_region_points(r, k), losing, failing, worst ? "`" : "",
                worst ? r->formula[worst->formula].id : "-", worst ? "`" : "",
                or_dash(worst ? stability_tenths(a, worst->excess) : NULL));
  }
  text_add_char(out, '\n');
}

static void add_maps(struct text *out, const struct stability_result *r) {
  if (r->n_maps == 0) return;
  text_add(out,
           "## Maps\n\nDigits that the formula loses over two inputs, the others as at its witness; axes are log10 of "
           "the input's size, of chi log10 chi/(1 - chi).\n\n");
  for (int i = 0; i < r->n_maps; i++) {
    const struct stability_map *m = &r->map[i];
    text_printf(out, "- `%s` over %s and %s: [map-%d.tsv](map-%d.tsv)\n", r->formula[m->formula].id, m->x, m->y, i + 1,
                i + 1);
    if (*m->at) text_printf(out, "  with `%s`\n", m->at);
    text_printf(out, "\n  ![%s](map-%d.svg)\n", r->formula[m->formula].id, i + 1);
  }
  text_add_char(out, '\n');
}

/* Formulas whose true value is zero. */
static void add_zeros(struct text *out, const struct stability_result *r) {
  int n = 0;
  for (int i = 0; i < r->n_formulas; i++) {
    if (!r->formula[i].zero) continue;
    text_printf(out, "%s`%s` (%s)",
                n++ ? ", "
                    : "Zero, or not to be told from zero, wherever they were tried, so that no relative error exists: ",
                r->formula[i].id, r->formula[i].text);
  }
  if (n) text_add(out, ".\n\n");
}

static void add_opening(struct text *out, const struct stability_result *r) {
  text_add(out, "# Where the formulas lose digits\n\n");
  stability_add_summary(out, r);
  text_printf(
      out,
      ".\n\nEvery definition of the paper and every side of its statements, entry by entry and as matrices (by their "
      "largest entry), is evaluated in double precision and in balls at the same exact doubles. Errors are relative, "
      "in units of 2^-53. With kappa the condition number, the sum over the inputs of |x df/dx|/|f| from symbolic "
      "derivatives (where the formula would be blamed, the change itself that 2^-53 of an input makes, if that is "
      "larger), the problem loses log10 max(1, kappa) digits, the formula what is lost beyond that. A double has "
      "%.1f digits: where all of them are lost the relative error stands for them, and the count by the formula goes "
      "on past %.1f, to the log10 of how many times the error is what the conditioning allows; it orders the ledger. "
      "A point at which no value comes out is a failure and has no such count. \"Sign\": a relative error near 1 and "
      "the wrong sign. In each region the points are drawn at random, then a climb looks for the worst; no formula, "
      "point or cause was put in by hand. A repetition on a machine with another C library may differ in tenths of "
      "digits and in witnesses.\n\n",
      STABILITY_DIGITS, STABILITY_DIGITS);
  if (r->quick)
    text_add(out, "This is the quick search: few points, short climbs, no maps, and where no formula was named, each "
                  "matrix as a whole alone.\n\n");
}

static void add_losses(struct text *out, const struct stability_result *r) {
  text_add(out,
           "## Digits lost by the formula\n\nThe worst point of each formula that loses more than the conditioning "
           "allows, in the region where the search found it; `stickslip stability FORMULA --at WITNESS` shows it. "
           "ledger.tsv has every region in which one does.\n\n");
  if (r->after)
    text_printf(
        out,
        "Replacement: what the layer %s has in its place, by the last of the records that it is made of there "
        "(verify/stable.eq; `explain` shows the forms), and whether each of them was proved equal to what it "
        "replaces. After: the digits that it loses at the same point; gained: those that it keeps and the formula "
        "loses, of %.1f; after, most: what it loses at "
        "its own worst points, found by a search of its own; fails: points at which it has no value and should.\n\n",
        r->after, STABILITY_DIGITS);
  add_ledger(out, r, false);
  if (r->after) {
    text_add(out, "## What the replacements lose\n\n");
    add_unmended(out, r);
    add_rounded(out, r);
  }
  if (r->n_pairs > 0) {
    text_add(out, "## A value wherever the corrected form has one\n\n");
    add_pairs(out, r);
  }
}

static void add_where(struct text *out, const struct stability_result *r) {
  text_add(out, "## The nodes that lose them\n\nIn how many formulas, over all regions, and where most.\n\n");
  add_culprits(out, r);
  text_add(out,
           "## No value where there is one\n\nThe true value is one that a double holds, and the formula overflows, "
           "underflows or divides by zero on the way. The failure at the least extreme inputs that a climb finds, with "
           "the true "
           "size of the node.\n\n");
  add_failures(out, r);
  add_zeros(out, r);
  text_add(out, "## The program's own functions\n\nResults of dynamics.h in double precision that lose more than the "
                "conditioning allows and say nothing (an error status is an answer).\n\n");
  add_ledger(out, r, true);
}

static void add_prediction(struct text *out, const struct stability_result *r) {
  text_printf(
      out,
      "## Does the explanation predict?\n\nFrom the true values alone the rule adds up what one rounding of each "
      "node does to the result, and says how many digits will be lost; rows are its bins, columns what double "
      "precision lost, at every point drawn (not at those of the climbs). %ld condition numbers from symbolic "
      "derivatives stand beside those of the adjoint, which the rule uses; %ld differ. The rule expects too much where "
      "a number near 1 is rounded twice and the second rounding undoes the first.\n\n",
      r->conditions, r->condition_differs);
  stability_add_confusion(out, r);
}

void report_stability_markdown(struct text *out, const struct stability_result *r) {
  add_opening(out, r);
  add_losses(out, r);
  add_where(out, r);
  text_add(out, "## Regions\n\n");
  add_regions(out, r);
  add_prediction(out, r);
  add_maps(out, r);
}
