/* Where digits are lost: the ledger, worst first, and how well the rule that explains it predicts.  Digits are rounded to
   tenths: the library's sines and cosines may differ in their last bit from one machine to the next. */
#include "stickslip/report_stability.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "stickslip/json.h"

/* --- Numbers --- */

/* NULL where there is none. */
static const char *tenths(char buffer[32], double x) {
  if (!isfinite(x)) return NULL;
  snprintf(buffer, 32, "%.1f", x == 0 ? 0 : x);
  return buffer;
}

static const char *or_none(const char *s) {
  return s ? s : "-";
}

static void add_command(struct text *out, const struct stability_result *r, const struct stability_row *row,
                        const char *witness) {
  text_printf(out, "stickslip stability \"%s\" --layer %s --at \"%s\"", r->formula[row->formula].id, r->layer, witness);
}

/* The rows in the order of the ledger: losses of the formula's own, the largest first; equal ones as they come. */
static int by_loss(const void *a, const void *b) {
  const struct stability_row *x = *(const struct stability_row *const *)a, *y = *(const struct stability_row *const *)b;
  double p = round(10 * x->formula_lost), q = round(10 * y->formula_lost);
  if (p != q) return p < q ? 1 : -1;
  return x < y ? -1 : x > y;
}

/* One row a formula: its worst.  An array to be freed. */
static const struct stability_row **ledger(int *n, const struct stability_result *r) {
  const struct stability_row **row = ss_malloc(((size_t)r->n_formulas + 1) * sizeof(struct stability_row *));
  *n = 0;
  for (int i = 0; i < r->n_formulas; i++) {
    const struct stability_formula *f = &r->formula[i];
    if (f->worst >= 0) row[(*n)++] = &r->row[f->worst];
  }
  qsort(row, (size_t)*n, sizeof *row, by_loss);
  return row;
}

/* Digits that the other layer's form keeps where the formula loses them; NaN without one. */
static double gained(const struct stability_row *row) {
  return row->formula_lost - row->after;
}

/* "stable-45 and 9 more, proved": the last record of the replacement is the nearest to the formula. */
static void add_replacement(struct text *out, const struct stability_formula *f, bool all) {
  if (!f->replacement) {
    text_add_char(out, '-');
    return;
  }
  int more = 0;
  const char *last = f->replacement;
  for (const char *p = f->replacement; !all && (p = strstr(p, ", ")); p += 2) {
    last = p + 2;
    more++;
  }
  text_add(out, last);
  if (more) text_printf(out, " and %d more", more);
  text_add(out, f->proved ? ", proved" : ", not proved");
}

static bool loses(const struct stability_row *row) {
  return row->found && row->formula_lost > log10(STABILITY_ALLOWED);
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
    c.kernels_at_fault += f->kernel && f->worst >= 0 && loses(&r->row[f->worst]);
    if (f->kernel) continue;
    c.formulas++;
    c.zero += f->zero;
    c.failing += f->worst_failure >= 0;
    c.at_fault += f->worst >= 0 && loses(&r->row[f->worst]);
  }
  for (int a = 0; a < N_LOSS_BINS; a++)
    for (int b = 0; b < N_LOSS_BINS; b++) {
      c.judged += r->confusion[a][b];
      if (a == b) c.diagonal += r->confusion[a][b];
      if (abs(a - b) == 1 && a < N_LOSS_BINS - 1 && b < N_LOSS_BINS - 1) c.near += r->confusion[a][b];
    }
  return c;
}

static void add_summary(struct text *out, const struct stability_result *r) {
  struct counts c = count(r);
  text_printf(
      out,
      "%d formulas of the layer %s, %ld points: %d lose digits of their own (more than %d max(1, kappa) units), %d "
      "fail somewhere, %d are zero wherever they were tried",
      c.formulas, r->layer, c.points, c.at_fault, STABILITY_ALLOWED, c.failing, c.zero);
  if (c.kernels)
    text_printf(out, "; of %d results of the program's own functions %d do", c.kernels, c.kernels_at_fault);
  text_printf(out, "; the rule's bin is the observed one at %ld of %ld points, its neighbour at %ld", c.diagonal,
              c.judged, c.near);
}

/* --- JSON --- */

static void write_digits(struct json *j, const char *key, double x) {
  char buffer[32];
  json_string(j, key, tenths(buffer, x));
}

static void write_cause(struct json *j, const struct stability_row *row) {
  json_string(j, "cause", loss_cause_says[row->cause]);
  json_string(j, "node", row->node);
  json_string(j, "left", row->left);
  json_string(j, "right", row->right);
  write_digits(j, "node_grows", row->node_grows);
}

static void write_row(struct json *j, const struct stability_result *r, const struct stability_row *row) {
  struct text command;
  text_init(&command);
  json_object(j, NULL);
  json_string(j, "formula", r->formula[row->formula].id);
  json_string(j, "region", r->region[row->region].id);
  json_long(j, "points", row->points);
  json_long(j, "outside", row->outside);
  json_long(j, "undecided", row->undecided);
  json_long(j, "failures", row->failures);
  json_bool(j, "at_fault", row->at_fault);
  if (row->found) {
    write_digits(j, "log10_error", row->error);
    write_digits(j, "observed", row->observed);
    write_digits(j, "problem", row->problem);
    write_digits(j, "formula_lost", row->formula_lost);
    write_digits(j, "predicted", r->formula[row->formula].kernel ? (double)NAN : row->predicted);
    write_cause(j, row);
    json_string(j, "witness", row->witness);
    write_digits(j, "after", row->after);
    write_digits(j, "gained", gained(row));
    write_digits(j, "after_most", row->after_most);
    json_long(j, "after_failures", row->after_failures);
    json_string(j, "after_witness", row->after_witness);
    add_command(&command, r, row, row->witness);
    json_string(j, "command", text_str(&command));
  }
  if (row->failure_witness) {
    text_reset(&command);
    json_string(j, "failure", loss_cause_says[row->failure]);
    json_string(j, "failure_node", row->failure_node);
    json_string(j, "failure_witness", row->failure_witness);
    add_command(&command, r, row, row->failure_witness);
    json_string(j, "failure_command", text_str(&command));
  }
  json_end_object(j);
  text_clear(&command);
}

static void write_formula(struct json *j, const struct stability_formula *f) {
  json_object(j, NULL);
  json_string(j, "id", f->id);
  json_string(j, "also", f->also);
  json_string(j, "record", f->record);
  json_string(j, "equation", *f->equation ? f->equation : NULL);
  json_string(j, "section", f->section);
  json_string(j, "text", f->text);
  json_string(j, "inputs", f->inputs);
  json_long(j, "entries", f->entries);
  json_long(j, "nodes", f->nodes);
  json_long(j, "points", f->points);
  json_string(j, "replacement", f->replacement);
  json_bool(j, "proved", f->proved);
  json_bool(j, "kernel", f->kernel);
  json_bool(j, "zero", f->zero);
  json_end_object(j);
}

static void write_confusion(struct json *j, const struct stability_result *r) {
  json_array(j, "confusion");
  for (int a = 0; a < N_LOSS_BINS; a++) {
    json_object(j, NULL);
    json_string(j, "predicted", loss_bin_name[a]);
    json_array(j, "observed");
    for (int b = 0; b < N_LOSS_BINS; b++) json_long(j, NULL, r->confusion[a][b]);
    json_end_array(j);
    json_end_object(j);
  }
  json_end_array(j);
}

void report_stability_json(struct text *out, const struct stability_result *r) {
  struct json j;
  json_init(&j, out);
  json_object(&j, NULL);
  json_string(&j, "schema", "stickslip-stability-1");
  json_string(&j, "layer", r->layer);
  json_string(&j, "after", r->after);
  json_bool(&j, "quick", r->quick);
  json_array(&j, "bins");
  for (int i = 0; i < N_LOSS_BINS; i++) json_string(&j, NULL, loss_bin_name[i]);
  json_end_array(&j);
  write_confusion(&j, r);
  json_long(&j, "conditions", r->conditions);
  json_long(&j, "conditions_disputed", r->condition_differs);
  json_array(&j, "regions");
  for (int i = 0; i < r->n_regions; i++) {
    json_object(&j, NULL);
    json_string(&j, "id", r->region[i].id);
    json_string(&j, "says", r->region[i].says);
    json_end_object(&j);
  }
  json_end_array(&j);
  json_array(&j, "formulas");
  for (int i = 0; i < r->n_formulas; i++) write_formula(&j, &r->formula[i]);
  json_end_array(&j);
  json_array(&j, "ledger");
  for (long i = 0; i < r->n_rows; i++)
    if (r->row[i].at_fault) write_row(&j, r, &r->row[i]);
  json_end_array(&j);
  json_end_object(&j);
}

/* --- Tables --- */

void report_stability_tsv(struct text *out, const struct stability_result *r) {
  char a[32], b[32], c[32], e[32], f[32], g[32];
  text_add(out, "formula\tequation\tregion\tpoints\tfailures\tdigits lost\tby the problem\tby the formula\tpredicted\t"
                "cause\tnode\tafter\tgained\tafter, most\tafter, failures\twitness\tfailure\tfailure witness\n");
  for (long i = 0; i < r->n_rows; i++) {
    const struct stability_row *row = &r->row[i];
    const struct stability_formula *of = &r->formula[row->formula];
    if (!row->at_fault) continue;
    bool found = row->found && loses(row);
    text_printf(out, "%s\t%s\t%s\t%ld\t%ld\t%s\t%s\t%s\t%s\t%s\t%s", of->id,
                or_none(*of->equation ? of->equation : NULL), r->region[row->region].id, row->points, row->failures,
                or_none(found ? tenths(a, row->observed) : NULL), or_none(found ? tenths(b, row->problem) : NULL),
                or_none(found ? tenths(c, row->formula_lost) : NULL), or_none(found ? tenths(e, row->predicted) : NULL),
                found ? loss_cause_says[row->cause] : "-", or_none(found ? row->node : NULL));
    text_printf(out, "\t%s\t%s\t%s\t%ld\t%s\t%s\t%s\n", or_none(found ? tenths(a, row->after) : NULL),
                or_none(found ? tenths(f, gained(row)) : NULL), or_none(tenths(g, row->after_most)),
                row->after_failures, or_none(found ? row->witness : NULL),
                row->failure_witness ? loss_cause_says[row->failure] : "-", or_none(row->failure_witness));
  }
}

static void add_confusion(struct text *out, const struct stability_result *r) {
  text_add(out, "| predicted \\ observed |");
  for (int b = 0; b < N_LOSS_BINS; b++) text_printf(out, " %s |", loss_bin_name[b]);
  text_add(out, "\n| --- |");
  for (int b = 0; b < N_LOSS_BINS; b++) text_add(out, " ---: |");
  text_add_char(out, '\n');
  for (int a = 0; a < N_LOSS_BINS; a++) {
    text_printf(out, "| %s |", loss_bin_name[a]);
    for (int b = 0; b < N_LOSS_BINS; b++) text_printf(out, " %ld |", r->confusion[a][b]);
    text_add_char(out, '\n');
  }
  text_add_char(out, '\n');
}

/* "cancellation between a and b", in code style when asked for. */
static void add_cause(struct text *out, const struct stability_row *row, const char *quote) {
  text_add(out, loss_cause_says[row->cause]);
  if (row->cause == CAUSE_ARGUMENT)
    text_printf(out, ": %s%s%s", quote, row->node, quote);
  else if ((row->cause == CAUSE_CANCELLATION || row->cause == CAUSE_SMALL_DIVISOR) && row->left && row->right)
    text_printf(out, " between %s%s%s and %s%s%s", quote, row->left, quote, quote, row->right, quote);
  else
    text_printf(out, " at %s%s%s", quote, row->node, quote);
}

/* Rows of a table that people read; ledger.tsv has them all. */
enum { MOST_LOSING = 60, MOST_KERNELS = 15, MOST_NODES = 15, MOST_FAILING = 15 };

static void add_rest(struct text *out, int n, int most) {
  if (n > most) text_printf(out, "\nand %d more.\n", n - most);
  text_add_char(out, '\n');
}

/* What another layer makes of the formula. */
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
  add_replacement(out, &r->formula[row->formula], false);
  text_printf(out, " | %s | %s | %s | %ld | ", or_none(tenths(a, row->after)), or_none(tenths(b, gained(row))),
              or_none(tenths(c, o.most)), o.failures);
}

/* Of the formulas, or of the program's functions. */
static void add_ledger(struct text *out, const struct stability_result *r, bool kernels) {
  char a[32], b[32], c[32];
  int n, shown = 0, most = kernels ? MOST_KERNELS : MOST_LOSING;
  bool after = r->after && !kernels;
  const struct stability_row **row = ledger(&n, r);
  text_printf(out, "| formula | equation | region | lost | by the problem | by the formula | cause | %switness |\n",
              after ? "replacement | after | gained | after, most | fails | " : "");
  text_printf(out, "| --- | --- | --- | ---: | ---: | ---: | --- | %s--- |\n",
              after ? "--- | ---: | ---: | ---: | ---: | " : "");
  for (int i = 0; i < n; i++) {
    const struct stability_formula *f = &r->formula[row[i]->formula];
    if (!loses(row[i]) || f->kernel != kernels || shown++ >= most) continue;
    text_printf(out, "| `%s` | %s | %s | %s | %s | %s | ", f->id, *f->equation ? f->equation : f->record,
                r->region[row[i]->region].id, or_none(tenths(a, row[i]->observed)), or_none(tenths(b, row[i]->problem)),
                or_none(tenths(c, row[i]->formula_lost)));
    add_cause(out, row[i], "`");
    text_add(out, " | ");
    if (after) add_after(out, r, row[i]);
    text_printf(out, "`%s` |\n", row[i]->witness);
  }
  add_rest(out, shown, most);
  free(row);
}

/* Formulas whose replacement loses more than is allowed or fails somewhere, the worst first come first. */
static void add_unmended(struct text *out, const struct stability_result *r) {
  char a[32];
  int n = 0, kept = 0;
  text_add(out, "| formula | replacement | region | loses by itself | at |\n| --- | --- | --- | ---: | --- |\n");
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
    add_replacement(out, &r->formula[i], false);
    text_printf(out, " | %s | %s | `%s` |\n", r->region[worst->region].id, or_none(tenths(a, worst->after_most)),
                worst->after_witness);
  }
  add_rest(out, n, MOST_NODES);
  text_printf(out, "%d replaced formulas stay within %d max(1, kappa) units in every region, %d do not.\n\n", kept,
              STABILITY_ALLOWED, n);
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
  return by_loss(&x->worst, &y->worst);
}

/* Every row in which a formula loses digits counts for the node that loses them.  An array to be freed. */
static struct culprit *culprits(int *n, const struct stability_result *r) {
  struct culprit *c = NULL;
  size_t len = 0, cap = 0;
  for (long i = 0; i < r->n_rows; i++) {
    const struct stability_row *row = &r->row[i];
    if (!loses(row) || r->formula[row->formula].kernel) continue;
    size_t k = 0;
    while (k < len && !same_node(c[k].worst, row)) k++;
    if (k == len) {
      c = ss_grow(c, len, &cap, sizeof *c);
      c[len++] = (struct culprit){row, 0, -1};
    }
    c[k].formulas += c[k].last != row->formula;
    c[k].last = row->formula;
    if (by_loss(&row, &c[k].worst) < 0) c[k].worst = row;
  }
  if (len) qsort(c, len, sizeof *c, by_formulas);
  *n = (int)len;
  return c;
}

static void add_culprits(struct text *out, const struct stability_result *r) {
  char a[32];
  int n;
  struct culprit *c = culprits(&n, r);
  text_add(out, "| formulas | cause | digits | worst in | region |\n| ---: | --- | ---: | --- | --- |\n");
  for (int i = 0; i < n && i < MOST_NODES; i++) {
    const struct stability_row *row = c[i].worst;
    text_printf(out, "| %d | ", c[i].formulas);
    add_cause(out, row, "`");
    text_printf(out, " | %s | `%s` | %s |\n", or_none(tenths(a, row->formula_lost)), r->formula[row->formula].id,
                r->region[row->region].id);
  }
  add_rest(out, n, MOST_NODES);
  free(c);
}

static void add_failures(struct text *out, const struct stability_result *r) {
  text_add(out, "| formula | region | failure | node | witness |\n| --- | --- | --- | --- | --- |\n");
  int n = 0;
  for (int i = 0; i < r->n_formulas; i++) {
    if (r->formula[i].worst_failure < 0 || r->formula[i].kernel || n++ >= MOST_FAILING) continue;
    const struct stability_row *row = &r->row[r->formula[i].worst_failure];
    text_printf(out, "| `%s` | %s | %s | `%s` | `%s` |\n", r->formula[i].id, r->region[row->region].id,
                loss_cause_says[row->failure], row->failure_node, row->failure_witness);
  }
  add_rest(out, n, MOST_FAILING);
}

static void add_regions(struct text *out, const struct stability_result *r) {
  char a[32];
  text_add(out, "| region | what it is | points | formulas that lose digits | that fail | the worst | loses |\n"
                "| --- | --- | ---: | ---: | ---: | --- | ---: |\n");
  for (int k = 0; k < r->n_regions; k++) {
    long points = 0;
    int losing = 0, failing = 0;
    const struct stability_row *worst = NULL;
    for (int i = 0; i < r->n_formulas; i++) {
      const struct stability_row *row = stability_row_at(r, i, k);
      points += row->points;
      losing += loses(row);
      failing += row->failures > 0;
      if (row->found && (!worst || by_loss(&row, &worst) < 0)) worst = row;
    }
    text_printf(out, "| %s | %s | %ld | %d | %d | %s%s%s | %s |\n", r->region[k].id, r->region[k].says, points, losing,
                failing, worst ? "`" : "", worst ? r->formula[worst->formula].id : "-", worst ? "`" : "",
                or_none(worst ? tenths(a, worst->formula_lost) : NULL));
  }
  text_add_char(out, '\n');
}

static void add_maps(struct text *out, const struct stability_result *r, bool pictures) {
  if (r->n_maps == 0) return;
  text_add(out,
           "## Maps\n\nDigits that the formula loses over two inputs, the others as at its witness; axes are log10 of "
           "the input's size, of chi log10 chi/(1 - chi).\n\n");
  for (int i = 0; i < r->n_maps; i++) {
    const struct stability_map *m = &r->map[i];
    text_printf(out, "- `%s` over %s and %s: [map-%d.tsv](map-%d.tsv)%s\n", r->formula[m->formula].id, m->x, m->y,
                i + 1, i + 1, *m->at ? "" : "");
    if (*m->at) text_printf(out, "  with `%s`\n", m->at);
    if (pictures) text_printf(out, "\n  ![%s](map-%d.svg)\n", r->formula[m->formula].id, i + 1);
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

void report_stability_markdown(struct text *out, const struct stability_result *r, bool maps) {
  text_add(out, "# Where the formulas lose digits\n\n");
  add_summary(out, r);
  text_printf(
      out,
      ".\n\nEvery definition of the paper and every side of its statements, entry by entry and as matrices (by their "
      "largest entry), is evaluated in double precision and in balls at the same exact doubles. Errors are relative, "
      "in "
      "units of 2^-53. With kappa the condition number, the sum over the inputs of |x df/dx|/|f| from symbolic "
      "derivatives (above 2^43 the change itself that 2^-53 of an input makes, if that is larger), the problem loses "
      "log10 kappa digits, the formula what is lost beyond that; at most %.1f. In each "
      "region the points are drawn at random, then a climb looks for the worst; no formula, point or cause was put in "
      "by "
      "hand. A repetition on a machine with another C library may differ in tenths of digits and in witnesses.\n\n",
      STABILITY_DIGITS);
  if (r->quick) text_add(out, "This is the quick search: few points, short climbs, no maps.\n\n");
  text_add(out,
           "## Digits lost by the formula\n\nThe worst point of each formula that loses more than the conditioning "
           "allows, in the region where the search found it; `stickslip stability FORMULA --at WITNESS` shows it. "
           "ledger.tsv has every region in which one does.\n\n");
  if (r->after)
    text_printf(
        out,
        "Replacement: what the layer %s has in its place, by the last of the records that it is made of there "
        "(verify/stable.eq; `explain` shows the forms), and whether each of them was proved equal to what it "
        "replaces. After: what it loses at the same point; gained: the difference; after, most: what it loses at "
        "its own worst points, found by a search of its own; fails: points at which it has no value and should.\n\n",
        r->after);
  add_ledger(out, r, false);
  if (r->after) {
    text_add(out, "## What the replacements lose\n\n");
    add_unmended(out, r);
  }
  text_add(out, "## The nodes that lose them\n\nIn how many formulas, over all regions, and where most.\n\n");
  add_culprits(out, r);
  text_add(out,
           "## No value where there is one\n\nThe true value is one that a double holds, and the formula overflows, "
           "underflows or divides by zero on the way. The first region where it happened.\n\n");
  add_failures(out, r);
  add_zeros(out, r);
  text_add(out, "## The program's own functions\n\nResults of dynamics.h in double precision that lose more than the "
                "conditioning allows and say nothing (an error status is an answer).\n\n");
  add_ledger(out, r, true);
  text_add(out, "## Regions\n\n");
  add_regions(out, r);
  text_printf(
      out,
      "## Does the explanation predict?\n\nFrom the true values alone the rule adds up what one rounding of each "
      "node does to the result, and says how many digits will be lost; rows are its bins, columns what double "
      "precision lost, at every point drawn (not at those of the climbs). %ld condition numbers from symbolic "
      "derivatives stand beside those of the adjoint, which the rule uses; %ld differ. The rule expects too much where "
      "a "
      "number near 1 is rounded twice and the second rounding undoes the first.\n\n",
      r->conditions, r->condition_differs);
  add_confusion(out, r);
  add_maps(out, r, maps);
}

void report_stability_text(struct text *out, const struct stability_result *r) {
  enum { SHOWN = 40 };
  char a[32], b[32], c[32];
  int n;
  const struct stability_row **row = ledger(&n, r);
  text_printf(out, "%-22s %-22s %5s %8s %8s%s  cause\n", "formula", "region", "lost", "problem", "formula",
              r->after ? "   after" : "");
  for (int i = 0; i < n && i < SHOWN && loses(row[i]); i++) {
    const struct stability_formula *f = &r->formula[row[i]->formula];
    text_printf(out, "%-22s %-22s %5s %8s %8s", f->id, r->region[row[i]->region].id,
                or_none(tenths(a, row[i]->observed)), or_none(tenths(b, row[i]->problem)),
                or_none(tenths(c, row[i]->formula_lost)));
    if (r->after) text_printf(out, " %7s", or_none(tenths(a, row[i]->after)));
    text_add(out, "  ");
    add_cause(out, row[i], "");
    text_printf(out, "\n%23s at %s\n", "", row[i]->witness);
  }
  free(row);
  text_add_char(out, '\n');
  add_confusion(out, r);
  add_summary(out, r);
  text_add_char(out, '\n');
}

/* --- Maps --- */

/* Failures stand at one digit above all. */
static double shown(double lost) {
  return isinf(lost) ? STABILITY_DIGITS + 1 : lost;
}

static void add_cells(struct text *out, const struct stability_map *m, const char *blank) {
  for (int i = 0; i < STABILITY_MAP; i++) {
    for (int k = 0; k < STABILITY_MAP; k++) {
      text_printf(out, "%.1f\t%.1f\t", m->x_at[k], m->y_at[i]);
      for (int a = 0; a < 2; a++) {
        double v = a ? m->after[i][k] : m->lost[i][k];
        if (isnan(v))
          text_add(out, "NaN");
        else
          text_printf(out, "%.1f", shown(v));
        text_add(out, a ? "\n" : "\t");
      }
    }
    text_add(out, blank);
  }
}

void report_stability_map_tsv(struct text *out, const struct stability_result *r, int map) {
  const struct stability_map *m = &r->map[map];
  text_printf(
      out,
      "# %s, digits lost by the formula (%.1f: no value) over log10 |%s| and log10 |%s|; %s\n%s\t%s\tlost\tafter\n",
      r->formula[m->formula].id, STABILITY_DIGITS + 1, m->x, m->y, m->at, m->x, m->y);
  add_cells(out, m, "");
}

/* What an axis shows: of chi, chi/(1 - chi). */
static const char *axis(char buffer[64], const char *input) {
  bool chi = strcmp(input, "chi") == 0;
  snprintf(buffer, 64, chi ? "log10 %s/(1 - chi)" : "log10 |%s|", input);
  return buffer;
}

void report_stability_gnuplot(struct text *out, const struct stability_result *r, int map, const char *name) {
  const struct stability_map *m = &r->map[map];
  char x[64], y[64];
  text_add(out, "$cells << EOD\n");
  add_cells(out, m, "\n");
  text_printf(out,
              "EOD\nset terminal svg size %d,420 font 'sans,11'\nset output '%s.svg'\n"
              "set palette defined (0 '#fdf5c8', 4 '#8fd175', 8 '#25938b', 12 '#3a5088', 17 '#260a3c')\n"
              "set object rectangle from graph 0,0 to graph 1,1 behind fillcolor '#bbbbbb' fillstyle pattern 4\n"
              "set cbrange [0:%.1f]\nset cblabel 'digits lost by the formula'\nset cbtics 0,2\n"
              "set xrange [-16.4:16.4]\nset yrange [-16.4:16.4]\nset xtics 4\nset ytics 4\nset tics out nomirror\nset "
              "xlabel \"%s\" noenhanced\n"
              "set ylabel \"%s\" noenhanced\n",
              r->after ? 1040 : 560, name, STABILITY_DIGITS + 1, axis(x, m->x), axis(y, m->y));
  if (r->after) text_add(out, "set multiplot layout 1,2\n");
  text_printf(out, "set title \"%s, %s\" noenhanced\nplot $cells using 1:2:3 with image notitle\n",
              r->formula[m->formula].id, r->layer);
  if (r->after)
    text_printf(out, "set title \"%s, %s\" noenhanced\nplot $cells using 1:2:4 with image notitle\nunset multiplot\n",
                r->formula[m->formula].id, r->after);
  text_add(out, "unset output\n");
}
