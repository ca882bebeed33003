/* Kind behaviour: the table of checks. */
#include <string.h>

#include "friction.h"
#include "judge.h"

static const struct {
  const char *name;
  behaviour_fn run;
  bool by_law;
} checks[] = {{"modes", behaviour_modes, true},
              {"closed-forms", behaviour_closed_forms, true},
              {"configurations", behaviour_configurations, false},
              {"dimension", behaviour_dimension, false},
              {"linear", behaviour_linear, true},
              {"switches", behaviour_switches, true},
              {"jumps", behaviour_jumps, true},
              {"small", behaviour_small, false},
              {"fixed-points", behaviour_fixed_points, true},
              {"linearization", behaviour_linearization, true},
              {"equality", behaviour_equality, false},
              {"perturb", behaviour_perturb, true},
              {"long-run", behaviour_long_run, false},
              {"patching", behaviour_patching, false}};

static bool run_by_law(behaviour_fn run, struct behaviour *b) {
  struct friction law;
  b->law = &law;
  bool ok = friction_open(&law, b) && run(b);
  friction_close(&law);
  return ok;
}

bool judge_behaviour(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  struct behaviour b = {f, j, c, view, NULL};
  const char *name = claim_get(c, "check");
  for (size_t i = 0; name && i < sizeof checks / sizeof *checks; i++)
    if (strcmp(checks[i].name, name) == 0)
      return (checks[i].by_law ? run_by_law(checks[i].run, &b) : checks[i].run(&b)) && !j->d->set;
  return claim_error(j, c, "check", "there is no such check of behaviour");
}
