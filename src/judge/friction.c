/* Forces and accelerations by the paper's (1) and (2), see friction.h. */
#include "friction.h"

#include "claim/claim.h"
#include "verdict.h"

static const char *const needs_laws = "the claims of kind law for both masses are needed among these";

bool friction_open(struct friction *f, struct behaviour *b) {
  enum { MOST = 16 };
  char names[MOST][CLAIM_NAME];
  bool have[2] = {false, false};
  *f = (struct friction){.moves = {{.n = 0}}};
  int n = claim_names_listed(names, MOST, claim_get(b->c, "depends-on"));
  for (int i = 0; i < n; i++) {
    const struct claim *c = claim_named(b->j->claims, names[i]);
    if (!c || claim_kind(c) != KIND_LAW) continue;
    const char *mass = claim_get(c, "mass");
    int m = mass && *mass == '2';
    if (have[m]) return claim_error(b->j, b->c, "depends-on", needs_laws);
    have[m] = true;
    if (!law_read(&f->law[m], b->j, c, b->view) || !conditions_read(&f->moves[m], b->j, c, "moves", b->view))
      return false;
    if (f->moves[m].n != 1 || !f->moves[m].at[0].equality)
      return claim_error(b->j, c, "moves", "the mass's equation of motion is needed, as in \"eq-1#2 D\"");
  }
  return (have[0] && have[1]) || claim_error(b->j, b->c, "depends-on", needs_laws);
}

void friction_clear(struct friction *f) {
  for (int i = 0; i < 2; i++) {
    law_clear(&f->law[i]);
    conditions_clear(&f->moves[i]);
  }
}

val friction_acceleration(const struct friction *f, struct law_state *s, int mass) {
  return law_solve(s, &s->a[mass], &f->moves[mass].at[0], NULL);
}

bool friction_apply(const struct friction *f, struct law_state *s, int mass, int slips) {
  if (slips && !f->law[mass].slower) return false;
  s->eps = calc_d(&s->c, slips ? slips * f->law[mass].slower : 1);
  val u = law_friction(&f->law[mass], s, slips ? SLIPS : STICKS);
  if (u) s->u[mass] = u;
  if (!slips) s->v[mass] = s->belt;
  return u != NULL;
}

bool friction_mode(const struct friction *f, struct law_state *s, const int slips[2]) {
  bool ok = friction_apply(f, s, 0, slips[0]) && friction_apply(f, s, 1, slips[1]);
  val a[2] = {NULL, NULL};
  for (int i = 0; ok && i < 2; i++) {
    a[i] = friction_acceleration(f, s, i);
    ok = a[i] != NULL;
  }
  for (int i = 0; ok && i < 2; i++) s->a[i] = a[i];
  return ok;
}

struct route_result behaviour_proof(struct behaviour *b, enum route_outcome outcome, const char *note) {
  return exact_route(b->f, b->j->out, outcome, note);
}

void behaviour_decide(struct behaviour *b, enum route_outcome outcome, const char *note) {
  struct route_result w = behaviour_proof(b, outcome, note);
  b->f->verdict = verdict_of(&w, 1, true);
}
