/* Which edits of the printed text repair a refuted claim, the smallest first. */
#include <string.h>

#include "escape.h"
#include "mutation.h"
#include "sheet.h"

static SHAPE(repair, repair, INTS(repair, edits), LONGS(repair, distance),
             NULLABLE(repair, kinds, change, text, verdict, erratum));

static SHAPE(claim, repairs, NULLABLE(repairs, claim, equation, title, printed, erratum),
             MEMBER(MEMBER_STRING, MEMBER_NULLABLE, "not_searched", repairs, why_none), LONGS(repairs, singles, pairs),
             BOOLS(repairs, pairs_complete), RECORDS_OF(MEMBER_NEEDED, "repairs", repairs, repair, n, cap, &repair));

void report_repairs_json(struct text *out, const struct repair_result *r) {
  OWNED(json) j = json_document(out, "stickslip-repairs-1");
  json_string(&j, "scene", r->scene);
  JSON_EACH (&j, "claims", i, r->n) shape_write(&j, NULL, &claim, &r->claim[i]);
}

/* What was searched and what it gave, as one sentence. */
static void add_summary(struct text *out, const struct repairs *c) {
  if (c->why_none) {
    text_printf(out, "not searched: %s", c->why_none);
    return;
  }
  size_t single = 0;
  while (single < c->n && c->repair[single].edits == 1) single++;
  text_printf(out, "%zu of %ld edits %s the checks", single, c->singles, single == 1 ? "passes" : "pass");
  if (c->pairs)
    text_printf(out, ", %zu of %ld pairs of exchanged names%s", c->n - single, c->pairs,
                c->pairs_complete ? "" : " (the budget; there are more)");
  if (!c->erratum) return;
  size_t text = 0, values = 0;
  for (size_t k = 0; k < c->n; k++) {
    text += c->repair[k].erratum && strcmp(c->repair[k].erratum, "same text") == 0;
    values += c->repair[k].erratum && strcmp(c->repair[k].erratum, "same values") == 0;
  }
  text_printf(out, "; the correction on file is %s",
              text     ? "among them"
              : values ? "equal in value to one of them"
                       : "not among them");
}

void report_repairs_markdown(struct text *out, const struct repair_result *r) {
  size_t begin = out->len;
  text_printf(
      out,
      "# Repairs\n\nEvery one-token edit of the printed text of a refuted claim is tried; where none helps, or not the "
      "correction on file, pairs of exchanged names; and then the steps of a chain a = b = c one by one. A repair is "
      "listed when the claim passes, with it in place of the printed text, the checks that refuted it. Scene %s.\n\n",
      r->scene);
  for (size_t i = 0; i < r->n; i++) {
    const struct repairs *c = &r->claim[i];
    text_printf(out, "## %s: %s\n\n", c->claim, c->title);
    if (c->printed) text_printf(out, "- printed: `%s`\n", c->printed);
    if (c->erratum) text_printf(out, "- correction on file: `%s`\n", c->erratum);
    text_add(out, "- ");
    add_summary(out, c);
    text_add(out, "\n\n");
    if (c->n) markdown_head(out, "edits:|characters:|change|repaired text|verdict|correction on file");
    for (size_t k = 0; k < c->n; k++) {
      const struct repair *p = &c->repair[k];
      text_printf(out, "| %d | %ld | `%s` | `%s` | %s | %s |\n", p->edits, p->distance, p->change, p->text, p->verdict,
                  or_dash(p->erratum));
    }
    if (c->n) text_add_char(out, '\n');
  }
  escape_tags(out, begin);
}

void report_repairs_text(struct text *out, const struct repair_result *r) {
  for (size_t i = 0; i < r->n; i++) {
    const struct repairs *c = &r->claim[i];
    text_printf(out, "%s: ", c->claim);
    add_summary(out, c);
    text_add_char(out, '\n');
    for (size_t k = 0; k < c->n; k++) {
      const struct repair *p = &c->repair[k];
      text_printf(out, "  %s (%s)%s%s\n    %s\n", p->change, p->kinds, p->erratum ? ", the correction on file: " : "",
                  p->erratum ? p->erratum : "", p->text);
    }
  }
}
