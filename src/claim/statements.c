/* The list of the paper's statements: what each sentence and each numbered line says is answered by claims, or a reason
   is given why by none. */
#include "claim.h"
#include "record/finding.h"

#include <stdlib.h>
#include <string.h>

bool statement_check(const struct claim *s, struct diag *d) {
  static const char *const known[] = {"quote", "place", "equation", "claims", "checks", "reason"};
  enum { N_KNOWN = sizeof known / sizeof *known };
  if (!claim_has_only(s, known, N_KNOWN, d, "a statement has quote, place, equation, claims, checks and reason"))
    return false;
  if (!claim_get(s, "quote")) return claim_mistake(s, "", d, "a statement has a quote that finds it in the paper");
  if (!claim_get(s, "claims") == !claim_get(s, "reason"))
    return claim_mistake(s, "", d, "a statement has claims that answer it, or a reason why there are none");
  return true;
}

bool statements_claim(const struct claims *statements, const char *id) {
  return claims_listing(statements, statements->n, "claims", id) != NULL;
}

/* Every name on its list is that of a claim; those on the list of checks, of claims that answer no statement: whether
   one answers what is asserted is one fact about it, whichever statement names it. */
static bool check_names(const struct claim *s, const char *key, const struct claims *claims,
                        const struct claims *statements, struct diag *d) {
  char name[64];
  for (const char *p = claim_get(s, key); (p = claim_next_item(name, sizeof name, p)) != NULL;) {
    if (!claim_named(claims, name)) return claim_mistake(s, key, d, "there is no claim %s", name);
    if (strcmp(key, "checks") == 0 && statements_claim(statements, name))
      return claim_mistake(s, key, d, "%s answers a statement, and is no check", name);
  }
  return true;
}

static bool is_listed(const char *equation, const struct claims *statements) {
  for (size_t i = 0; i < statements->n; i++)
    if (claim_says(&statements->claim[i], "equation", equation)) return true;
  return false;
}

/* The numbers that the equation files bear, and those between them. */
static bool check_equations(const struct model *m, const struct claims *statements, struct diag *d) {
  long most = 0;
  char number[24];
  for (size_t i = 0; i < m->n_records; i++) {
    long n = m->records[i].rank == RANK_PAPER ? strtol(m->records[i].equation, NULL, 10) : 0;
    if (n > most) most = n;
  }
  for (long n = 1; n <= most; n++) {
    snprintf(number, sizeof number, "%ld", n);
    if (is_listed(number, statements)) continue;
    return diag_at(d, &statements->files[0]->src, 0, "no statement has the equation number %ld, of %ld", n, most);
  }
  return true;
}

bool statements_keep_rules(const struct model *m, const struct claims *claims, const struct claims *statements,
                           struct diag *d) {
  for (size_t i = 0; i < statements->n_files; i++)
    if (!records_counted(statements->files[i], d)) return false;
  for (size_t i = 0; i < statements->n; i++)
    if (!statement_check(&statements->claim[i], d) ||
        !check_names(&statements->claim[i], "claims", claims, statements, d) ||
        !check_names(&statements->claim[i], "checks", claims, statements, d))
      return false;
  for (size_t i = 0; i < claims->n; i++)
    if (!statements_claim(statements, claims->claim[i].id) &&
        !claims_listing(statements, statements->n, "checks", claims->claim[i].id))
      return claim_mistake(&claims->claim[i], "", d, "no statement of the paper names this claim");
  return check_equations(m, statements, d);
}

void statements_unanswered(struct audit_result *out, const struct claims *statements) {
  for (size_t i = 0; i < statements->n; i++) {
    const char *reason = claim_get(&statements->claim[i], "reason");
    bool first = reason;
    for (size_t k = 0; first && k < i; k++) first = !claim_says(&statements->claim[k], "reason", reason);
    if (!first) continue;
    OWNED(text) which = {0};
    long n = 0;
    for (size_t k = i; k < statements->n; k++)
      if (claim_says(&statements->claim[k], "reason", reason))
        text_printf(&which, "%s\"%s ...\"", n++ ? ", " : "", claim_get(&statements->claim[k], "quote"));
    audit_leave_out(out, result_str(out, "the paper's statement%s %s", plural_s(n), text_str(&which)),
                    result_copy(out, reason));
  }
}
