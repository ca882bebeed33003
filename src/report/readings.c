/* The readings of an example, as JSON and for people. */
#include <string.h>

#include "audit_shape.h"
#include "finding.h"
#include "report.h"
#include "sheet.h"

void report_readings_json(struct text *out, const struct audit_result *r) {
  OWNED(json) j = json_document(out, "stickslip-readings-1");
  json_string(&j, "scene", r->scene);
  shape_write(&j, "readings", &readings_shape, r->readings);
}

/* --- For people --- */

static void add_strings(struct text *out, const char *const *list, int n, const char *none) {
  for (int i = 0; i < n; i++) text_printf(out, "%s%s", i ? "; " : "", list[i]);
  if (n == 0) text_add(out, none);
}

/* Rows for results, columns for inputs. */
static void add_slope_table(struct text *out, const struct reading_slope *s, int n) {
  int columns = 0;
  while (columns < n && strcmp(s[columns].of, s[0].of) == 0) columns++;
  if (columns == 0) return;
  text_add(out, "| change of, per unit of |");
  for (int k = 0; k < columns; k++) text_printf(out, " %s |", paper_name(s[k].by).is);
  text_add(out, "\n| --- |");
  for (int k = 0; k < columns; k++) text_add(out, " ---: |");
  for (int i = 0; i < n; i++)
    text_printf(out, "%s%s%s %s |", i % columns ? "" : "\n| ", i % columns ? "" : paper_name(s[i].of).is,
                i % columns ? "" : " |", s[i].value);
  text_add(out, "\n\n");
}

static void add_dropped(struct text *out, const struct example_reading *r) {
  if (r->n_dropped == 0) text_add(out, "nothing");
  for (int i = 0; i < r->n_dropped; i++)
    text_printf(out, "%s%s, with a difference of the sides of %s", i ? "; " : "", r->dropped[i].equation,
                r->dropped[i].residual);
}

static void add_reading(struct text *out, const struct example_reading *r) {
  text_add(out, "- exact data: ");
  add_strings(out, r->inputs, r->n_inputs, "none");
  text_add(out, "\n- equations left out: ");
  add_dropped(out, r);
  text_add(out, "\n- equations satisfied: ");
  add_strings(out, r->solved, r->n_solved, "nothing");
  text_printf(out, "\n- %d assumption%s: %s\n- matrices as %s%s; intermediate numbers: %s; digits reproduced: %d\n\n",
              r->assumptions, plural_s(r->assumptions), r->assumed, r->layer,
              r->confirmed ? ", with the same result by the independent model" : "", r->carry, r->digits);
  markdown_head(out, "number|printed:|in this reading:|");
  for (int i = 0; i < r->n_numbers; i++)
    text_printf(out, "| %s | %s | %s | %s |\n", paper_name(r->number[i].name).is, r->number[i].printed,
                r->number[i].value, r->number[i].how);
  text_add(out, "\n");
  add_slope_table(out, r->slope, r->n_slopes);
}

/* The first in full, the others in a line. */
static void add_readings(struct text *out, const struct example_reading *r, int n) {
  if (n == 0) return;
  text_add(out, "### Readings that give every printed number\n\nThe first of them:\n\n");
  add_reading(out, &r[0]);
  if (n == 1) return;
  markdown_head(out, "rank:|exact data|equations left out|intermediate numbers|assumptions:|digits:");
  for (int i = 0; i < n; i++) {
    text_printf(out, "| %d | ", i + 1);
    add_strings(out, r[i].inputs, r[i].n_inputs, "none");
    text_add(out, " | ");
    add_dropped(out, &r[i]);
    text_printf(out, " | %s | %d | %d |\n", r[i].carry, r[i].assumptions, r[i].digits);
  }
  text_add(out, "\n");
}

static void add_levels(struct text *out, const struct readings *r) {
  markdown_head(out, "equations left out:|readings:|not determined:|give all printed numbers:|without intermediate "
                     "rounding:|undecided:");
  for (int i = 0; i < r->n_levels; i++)
    text_printf(out, "| %d | %ld | %ld | %ld | %ld | %ld |\n", r->level[i].dropped, r->level[i].tried,
                r->level[i].undetermined, r->level[i].reproduce, r->level[i].unrounded, r->level[i].open);
  text_add(out, "\n");
}

static void add_procedure(struct text *out, const struct readings_procedure *p) {
  if (p->n_outputs == 0) return;
  text_printf(out, "### The whole procedure, from %s\n\n", p->inputs);
  markdown_head(
      out, "result|printed:|value:|for all data with the printed digits|agrees somewhere|decimals of the data needed:");
  for (int i = 0; i < p->n_outputs; i++) {
    const struct procedure_output *o = &p->output[i];
    text_printf(out, "| %s | %s | %s | %s to %s | %s | ", paper_name(o->name).is, o->printed, o->value,
                o->low ? o->low : "?", o->high ? o->high : "?", o->within);
    if (o->decimals >= 0)
      text_printf(out, "%d |\n", o->decimals);
    else
      text_add(out, "- |\n");
  }
  text_add(out, "\n");
  add_slope_table(out, p->slope, p->n_slopes);
}

void report_readings_markdown(struct text *out, const struct readings *r) {
  text_add(out, "## How the printed numbers could have arisen\n\n");
  for (int i = 0; i < r->n_conclusions; i++) text_printf(out, "- %s\n", r->conclusion[i]);
  text_add(out, "\n");
  add_levels(out, r);
  add_readings(out, r->found, r->n_found);
  add_procedure(out, &r->procedure);
  text_add(out, "The search:\n\n");
  for (int i = 0; i < r->n_space; i++) text_printf(out, "- %s\n", r->space[i]);
  text_add(out, "\n");
}

/* --- In a letter --- */

/* What an equation says, without the words in brackets behind it. */
static void add_equation(const struct sheet *s, const char *text) {
  OWNED(text) t = {0};
  size_t n = strlen(text);
  if (n && text[n - 1] == ')')
    while (n && text[--n] != '(') continue;
  while (n && text[n - 1] == ' ') n--;
  text_add_n(&t, text, n ? n : strlen(text));
  sheet_prose(s, text_str(&t));
}

const struct example_reading *best_reading(const struct audit_result *r) {
  return r->readings && r->readings->n_found ? &r->readings->found[0] : NULL;
}

void reading_say(const struct sheet *s, const struct example_reading *e) {
  text_add(s->out, "If ");
  sheet_list(s, e->inputs, e->n_inputs);
  text_printf(s->out, " are taken as exact data, the other %d printed numbers follow from them to every printed digit",
              e->n_numbers - e->n_inputs);
  for (int i = 0; i < e->n_dropped; i++) {
    text_add(s->out, i                   ? "; "
                     : e->n_dropped == 1 ? ". One equation is then not satisfied: "
                                         : ". The following equations are then not satisfied: ");
    add_equation(s, e->dropped[i].equation);
    sheet_add(s, ", where the difference of the two sides is %p", e->dropped[i].residual);
  }
  text_add(s->out, ". ");
  if (e->start) sheet_add(s, "The initial positions are %t.", e->start);
}
