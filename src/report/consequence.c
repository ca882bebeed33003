/* The part of audit.md about what falls with a failure and what survives it. */
#include <string.h>

#include "impl.h"

static void add_ids(struct text *out, const char *label, const struct id_list *list) {
  for (int i = 0; i < list->n; i++)
    text_printf(out, "%s%s%s", i ? ", " : label, list->id[i], i + 1 == list->n ? "\n" : "");
}

/* The formulas of those that a change leaves as they are, on one line. */
static void add_kept(const struct sheet *s, const struct consequence *q, enum change change, const char *label) {
  const char *sep = label;
  for (int i = 0; i < q->n_derived; i++) {
    const struct derived *d = &q->derived[i];
    if (d->change != change) continue;
    text_add(s->out, sep);
    sheet_math(s, d->latex);
    if (change != CHANGE_SAME_FORMULA) text_printf(s->out, " (%s)", d->verdict);
    sep = ", ";
  }
  if (sep != label) text_add_char(s->out, '\n');
}

static bool all_same(const struct consequence *q) {
  for (int i = 0; i < q->n_derived; i++)
    if (q->derived[i].change != CHANGE_SAME_FORMULA) return false;
  return q->n_derived > 0;
}

static void add_changes(const struct sheet *s, const struct consequence *q) {
  bool any = false;
  for (int i = 0; i < q->n_derived; i++) {
    const struct derived *d = &q->derived[i];
    if (d->change != CHANGE_CHANGES) continue;
    if (!any)
      text_add(s->out, "\n| derived | | size | entry | with the printed form | corrected | where |\n"
                       "| --- | --- | --- | --- | --- | --- | --- |\n");
    any = true;
    text_add(s->out, "| ");
    sheet_math(s, d->latex);
    text_add(s->out, ", ");
    sheet_text(s, d->title);
    text_printf(s->out, " | %s | below %s | %s | %s%s%s | %s | %s |\n", d->verdict, d->size, d->entry ? d->entry : "-",
                d->printed, d->chain ? "; all printed: " : "", d->chain ? d->chain : "", d->corrected, d->where);
  }
}

void report_consequences(struct text *out, const struct audit_result *r) {
  struct sheet s = {out, false};
  if (r->n_consequences == 0) return;
  text_add(out, "## What falls with a failure\n\nEverything is corrected but the failed formula, which is read as "
                "printed. A result with the same formula in both readings cannot change.\n\n");
  for (size_t i = 0; i < r->n_consequences; i++) {
    const struct consequence *q = &r->consequences[i];
    text_printf(out, "### with %s\n\n", q->failure);
    add_ids(out, "- fails: ", &q->falls);
    add_ids(out, "- rests on it and holds: ", &q->survives);
    add_ids(out, "- rests on it, undecided: ", &q->open);
    add_kept(&s, q, CHANGE_AGREES, "- keeps its value: ");
    add_kept(&s, q, CHANGE_UNDECIDED, "- undecided: ");
    add_kept(&s, q, CHANGE_UNDEFINED, "- cannot be evaluated: ");
    if (all_same(q))
      text_printf(out, "- same formula: all %d derived results\n", q->n_derived);
    else
      add_kept(&s, q, CHANGE_SAME_FORMULA, "- same formula: ");
    add_changes(&s, q);
    text_add_char(out, '\n');
  }
}
