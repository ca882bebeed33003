/* Kind behaviour: the table of checks. */
#include "friction.h"
#include "judge.h"

#define BEHAVIOUR_RUN(name, ...) behaviour_##name,
static bool (*const run[])(struct behaviour *b) = {BEHAVIOUR_CHECKS(BEHAVIOUR_RUN)};
#undef BEHAVIOUR_RUN

bool judge_behaviour(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  struct behaviour b = {f, j, c, view, NULL};
  const struct behaviour_check *check = claim_check(c);
  if (!check) return claim_error(j, c, "check", "there is no such check of behaviour");
  OWNED(friction) law = {.moves = {{.n = 0}}};
  if (check->by_law) b.law = &law;
  return (!b.law || friction_open(&law, &b)) && run[check - behaviour_checks](&b) && !j->d->set;
}
