/* What the reading that assumes least says of a printed number that the orbit does not give. */
#include <string.h>

#include "claim/claim.h"
#include "record/finding.h"
#include "study.h"

static const struct reading_number *number_in(const struct example_reading *r, const char *name) {
  for (int i = 0; i < r->n_numbers; i++)
    if (strcmp(r->number[i].name, name) == 0) return &r->number[i];
  return NULL;
}

/* "takes t_b = 2, t_c = 1.5, t_d = 2.34 as exact data and satisfies all equations except the second of (45), ..." */
static void add_assumptions(struct text *t, const struct example_reading *r) {
  text_add(t, "takes ");
  for (int i = 0; i < r->n_inputs; i++) text_printf(t, "%s%s", i ? ", " : "", r->inputs[i]);
  text_printf(t, "%s as exact data and satisfies all equations", r->n_inputs ? "" : "nothing");
  for (int i = 0; i < r->n_dropped; i++) text_printf(t, "%s %s", i ? ";" : " except", r->dropped[i].equation);
}

static const char *explanation(struct audit_result *out, const struct example_reading *r,
                               const struct reading_number *n) {
  struct text t = {0};
  text_add(&t, "the explanation of all printed numbers with the fewest assumptions ");
  add_assumptions(&t, r);
  if (strcmp(n->how, "input") == 0)
    text_printf(&t, "; in it %s = %s is one of the data, not a result", paper_name(n->name).is, n->printed);
  else
    text_printf(&t, "; it gives %s, which is printed as %s when %s", n->value, n->printed, n->how);
  return result_take(out, &t);
}

void readings_explain(struct audit_result *out, const struct claims *claims) {
  if (!out->readings || out->readings->n_found == 0) return;
  const struct example_reading *r = &out->readings->found[0];
  for (size_t i = 0; i < out->n_findings; i++) {
    struct finding *f = &out->findings[i];
    const struct claim *c = claim_named(claims, f->id);
    const char *name = c ? claim_get(c, "number") : NULL;
    const struct reading_number *n = name ? number_in(r, name) : NULL;
    if (!n || f->verdict != VERDICT_REFUTED) continue;
    finding_state(f, out, "balls", "reading", -1, 1, NULL, explanation(out, r, n));
  }
}
