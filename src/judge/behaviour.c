/* Kind behaviour: the table of checks. */
#include "behaviour.h"

#include <string.h>

#include "judge.h"

static const struct {
  const char *name;
  behaviour_fn run;
} checks[] = {{"modes", behaviour_modes},
              {"closed-forms", behaviour_closed_forms},
              {"configurations", behaviour_configurations},
              {"dimension", behaviour_dimension},
              {"linear", behaviour_linear},
              {"switches", behaviour_switches},
              {"jumps", behaviour_jumps},
              {"small", behaviour_small},
              {"fixed-points", behaviour_fixed_points},
              {"linearization", behaviour_linearization},
              {"equality", behaviour_equality},
              {"perturb", behaviour_perturb},
              {"long-run", behaviour_long_run},
              {"patching", behaviour_patching}};

bool judge_behaviour(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  struct behaviour b = {f, j, c, view};
  const char *name = claim_get(c, "check");
  for (size_t i = 0; name && i < sizeof checks / sizeof *checks; i++)
    if (strcmp(checks[i].name, name) == 0) return checks[i].run(&b) && !j->d->set;
  return claim_error(j, c, "check", "there is no such check of behaviour");
}
