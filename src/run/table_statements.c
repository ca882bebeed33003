/* The paper's statements with what became of each: place, words, the claims that answer it with their verdicts, the
   roots of those that fail, or the reason why nothing answers it. */
#include "tables.h"

#include <string.h>

#include "claim/claim.h"

/* Text of one line as a field. */
static void add_field(struct text *out, const char *s) {
  text_add_char(out, '\t');
  for (; s && *s; s++) text_add_char(out, *s == '\t' || *s == '\n' ? ' ' : *s);
}

/* "eq-3 proved, eq-5 refuted (configurations)": those that are judged as statements of the paper, or as checks. */
static void add_answers(struct text *out, const struct audit_result *r, const struct claim *statement,
                        enum claimant of) {
  static const char *const lists[N_CLAIMANTS] = {"claims", "checks"};
  char name[64];
  const char *sep = "";
  text_add_char(out, '\t');
  for (int l = 0; l < N_CLAIMANTS; l++)
    for (const char *p = claim_get(statement, lists[l]); (p = claim_next_item(name, sizeof name, p)) != NULL;) {
      const struct finding *f = audit_result_finding(r, name);
      if (!f || f->of != of) continue;
      text_printf(out, "%s%s %s", sep, name, verdict_name[f->verdict]);
      if (f->root) text_printf(out, " (%s)", f->root);
      sep = ", ";
    }
}

void table_of_statements(struct audit_result *out, const struct claims *statements) {
  struct text body = {0};
  text_add(
      &body,
      "# What the paper says, in its order. claims: those that answer it, with their verdicts and the root of "
      "what fails;\n# checks: the suite's own around it, and of other data what is said of the example. place: bytes "
      "of the paper's text.\n"
      "statement\tplace\tquote\tclaims\tchecks\treason\n");
  for (size_t i = 0; i < statements->n; i++) {
    const struct claim *s = &statements->claim[i];
    text_add(&body, s->id);
    add_field(&body, claim_get(s, "place"));
    add_field(&body, claim_get(s, "quote"));
    add_answers(&body, out, s, OF_PAPER);
    add_answers(&body, out, s, OF_SUITE);
    add_field(&body, claim_get(s, "reason"));
    text_add_char(&body, '\n');
  }
  table_finish(out, "statements.tsv", &body);
}
