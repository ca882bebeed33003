/* Would the audit have noticed?  What was made wrong on purpose and found: statements in this run, and damages of the
   formulas by the token in the study whose file stands beside the report. */
#include "html.h"

static void add_controls(const struct page *p) {
  const struct audit_result *r = p->r;
  size_t noticed = 0;
  for (size_t i = 0; i < r->n_controls; i++) noticed += r->controls[i].noticed;
  if (r->n_controls)
    text_printf(p->out,
                "<li>Of %zu <a href=\"#s-controls\">controls</a>, statements made wrong on purpose, <strong>%zu were "
                "noticed</strong> in this run.</li>\n",
                r->n_controls, noticed);
  else
    text_add(p->out, "<li>No statements made wrong on purpose were tried in this run.</li>\n");
}

static void add_mutation(const struct page *p) {
  const struct mutation_score *s = p->r->mutation;
  if (!s) return;
  text_printf(
      p->out,
      "<li>The paper's formulas were changed by one symbol at a time, in all %ld ways: "
      "<strong>%ld changes were noticed</strong> (of these %ld make a formula that cannot be read, and %ld turn "
      "a proof into mere support). Of the others %ld are proved to mean the same, %ld to make no difference "
      "on any motion, and <strong>%ld are open</strong>: <a href=\"../mutation/mutation.md\">all of them</a>, "
      "by <code>stickslip mutate --count all</code>.</li>\n",
      s->total, s->noticed + s->unreadable + s->unproved, s->unreadable, s->unproved, s->equivalent, s->on_motions,
      s->open);
}

static void add_pairs(const struct page *p) {
  const struct audit_result *r = p->r;
  size_t within = 0;
  for (size_t i = 0; i < r->n_pairs; i++) within += r->pairs[i].within;
  if (!r->n_pairs) return;
  text_printf(
      p->out,
      "<li>Of %zu pairs of <a href=\"#s-routes\">routes</a>, ways to compute one quantity, %zu agree within the "
      "accuracy that they state.</li>\n",
      r->n_pairs, within);
}

void page_power(const struct page *p) {
  long unexpected = audit_result_unexpected(p->r);
  size_t recorded = 0;
  for (size_t i = 0; i < p->r->n_findings; i++) recorded += p->r->findings[i].recorded != N_VERDICTS;
  text_add(p->out, "<h3>How sure can one be?</h3>\n<ul>\n");
  add_controls(p);
  add_mutation(p);
  add_pairs(p);
  if (unexpected)
    text_printf(p->out, "<li><strong>%ld results are not as recorded.</strong></li>\n", unexpected);
  else if (recorded == p->r->n_findings)
    text_add(p->out,
             "<li>Every verdict is the one expected: the one noted beside the claim when it was written down.</li>\n");
  else
    text_printf(p->out,
                "<li>%zu of the %zu verdicts are noted beside their claims, and come out as noted; the others have no "
                "record in this scene.</li>\n",
                recorded, p->r->n_findings);
  text_add(p->out, "<li>What the audit cannot show stands <a href=\"#s-limits\">at the end</a>.</li>\n</ul>\n");
}
