/* Attributes that judges of several kinds read: a word or nothing, the parameters at which a claim speaks of an
   orbit. */
#include "claim/judging.h"
#include "judge.h"

bool judge_switch(bool *on, struct judge *j, const struct claim *c, const char *attribute, const char *word) {
  *on = claim_says(c, attribute, word);
  return *on || !claim_get(c, attribute) || claim_error(j, c, attribute, result_str(j->out, "%s, or nothing", word));
}

bool judge_params(struct point *p, struct judge *j, const struct claim *c, const char *at) {
  OWNED(text) packed = {0};
  struct diag d = {0};
  for (const char *s = at; s && *s && *s != ';'; s++)
    if (*s != ' ') text_add_char(&packed, *s);
  for (int q = Q_CHI; q <= Q_E2; q++) fmpq_zero(&p->q[q]);
  bool ok = at && point_set(p, text_str(&packed), &d);
  p->kind = POINT_ORBIT;
  p->orbit = 0;
  return ok || claim_error(j, c, "at", "exact chi, eta, V, e1 and e2 are needed, as in \"chi = 2/5, eta = 4, ...\"");
}
