/* Kind behaviour: the table of checks. */
#include <string.h>

#include "friction.h"
#include "judge.h"

#define ROW(name, word, by_law, says) {word, behaviour_##name, by_law},
static const struct {
  const char *name;
  bool (*run)(struct behaviour *b);
  bool by_law;
} checks[] = {BEHAVIOUR_CHECKS(ROW)};
#undef ROW

bool judge_behaviour(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  struct behaviour b = {f, j, c, view, NULL};
  const char *name = claim_get(c, "check");
  for (size_t i = 0; name && i < sizeof checks / sizeof *checks; i++) {
    if (strcmp(checks[i].name, name) != 0) continue;
    OWNED(friction) law = {.moves = {{.n = 0}}};
    if (checks[i].by_law) b.law = &law;
    return (!b.law || friction_open(&law, &b)) && checks[i].run(&b) && !j->d->set;
  }
  return claim_error(j, c, "check", "there is no such check of behaviour");
}
