/* The long run: what becomes of the printed initial state under Coulomb's law. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "behaviour.h"
#include "judge.h"

/* Friction, and the printed start z under it; factor times what the orbits need where the scene does not give it. */
static bool long_run_motion(struct coulomb_setup *m, struct behaviour *b, const struct printed_number *const z[2],
                            double factor) {
  const struct scene *s = b->j->scene;
  struct diag d = {0};
  if (!audit_coulomb_setup(m, s, 0, true, &d)) return false;
  for (int i = 0; i < 2; i++) {
    double e = m->params[COULOMB_UR1 + i] - m->params[COULOMB_US1 + i];
    if (s->given[KEY_U_R1 + i]) continue;
    m->params[COULOMB_UR1 + i] *= factor / OWN_FRICTION;
    m->params[COULOMB_US1 + i] = m->params[COULOMB_UR1 + i] - e;
  }
  return coulomb_start_set_d(m->start, m->params, fmpq_get_d(&z[0]->value), fmpq_get_d(&z[1]->value)) == SS_OK;
}

/* Times and r of the last two returns. */
static void last_returns(double *period, double *change, const struct coulomb_log *log) {
  const struct coulomb_event *last[2] = {NULL, NULL};
  for (size_t i = log->n; i-- > 0 && !last[1];) {
    const struct coulomb_event *e = &log->event[i];
    if (e->at.mode[0] != MODE_STICK || e->at.mode[1] != MODE_STICK) continue;
    last[last[0] != NULL] = e;
  }
  *period = *change = INFINITY;
  if (!last[1]) return;
  *period = last[0]->at.t - last[1]->at.t;
  *change = fabs(last[0]->at.x[1] - last[0]->at.x[0] - last[1]->at.x[1] + last[1]->at.x[0]);
}

/* The shortest piece that the word's tail repeats often enough to believe it. */
static size_t tail_period(const char *word, size_t len) {
  enum { LONGEST = 40, TIMES = 4 };
  for (size_t p = 1; p <= LONGEST && TIMES * p <= len; p++) {
    size_t k = 1;
    while (k < TIMES && strncmp(word + len - p, word + len - (k + 1) * p, p) == 0) k++;
    if (k == TIMES) return p;
  }
  return 0;
}

/* The piece of the word that the motion repeats at its end, as (GHCD), cut after a D, else after a C, an H, ... */
static const char *ending(struct behaviour *b, const struct text *word) {
  const char *s = text_str(word), *end = "DCHGXcxgh"; /* the first of them that the piece has is its last */
  size_t p = tail_period(s, word->len), last = word->len;
  if (!p) return "no piece that repeats";
  while (!memchr(s + word->len - p, *end, p)) end++;
  while (s[last - 1] != *end) last--;
  return result_str(b->j->out, "(%.*s)", (int)p, s + last - p);
}

static bool long_run_once(struct behaviour *b, const struct printed_number *const z[2], double factor) {
  enum { RETURNS = 200 };
  struct coulomb_setup m;
  if (!long_run_motion(&m, b, z, factor)) return false;
  struct coulomb_plan plan = coulomb_plan_default;
  plan.returns = RETURNS;
  plan.duration = 100.0 * RETURNS;
  struct trajectory trajectory[N_MOTION_ROUTES];
  for (int r = 0; r < N_MOTION_ROUTES; r++) trajectory[r] = motion_simulate((enum motion_route)r, &m, &plan);
  OWNED(text) word = {0}, folded = {0};
  double period, change;
  bool same = trajectories_agree(&trajectory[0], &trajectory[1]);
  coulomb_log_word(&word, &trajectory[0].log);
  coulomb_word_fold(&folded, text_str(&word));
  last_returns(&period, &change, &trajectory[0].log);
  bool steady = change < 1e-8;
  const char *letters = coulomb_letters_said(text_str(&word));
  const char *where = result_str(b->j->out, "u_r1 = %.7g, u_r2 = %.7g", m.params[COULOMB_UR1], m.params[COULOMB_UR2]);
  const char *end =
      steady ? result_str(b->j->out, "is periodic with the phases %s and the period %.6f", ending(b, &word), period)
             : "does not repeat itself from one return to the next";
  const char *note = result_str(
      b->j->out,
      "from the printed initial state, over %d returns to the global stick phase, the sequence of phases is %s (%s); "
      "at the end the motion %s; the closed forms %s",
      RETURNS, text_str(&folded), letters, end, same ? "give the same events" : "give other events before that");
  if (!b->f->letter)
    b->f->letter = result_str(b->j->out, "after %d returns the motion from the printed initial state, for %s, %s (%s)",
                              RETURNS, where, end, letters);
  finding_state(b->f, b->j->out, "integration", "model", -1, 1, where, note);
  for (int r = 0; r < N_MOTION_ROUTES; r++) trajectory_clear(&trajectory[r]);
  return true;
}

bool behaviour_long_run(struct behaviour *b) {
  const char *friction = claim_get(b->c, "friction");
  const struct printed_number *z[2];
  if (!printed_start(z, b->j->scene) || !scene_has_forces(b->j->scene)) {
    finding_skip(b->f, b->j, "the scene prints no initial state, or does not give e1 and e2");
    return true;
  }
  char *end = NULL;
  int n = 0;
  for (const char *at = friction; at && *at; at = end, n++) {
    double factor = strtod(at, &end);
    if (end == at || !(factor > 1 && factor < 1000))
      return claim_error(b->j, b->c, "friction", "factors greater than 1, as in \"1.25 2\"");
    if (!long_run_once(b, z, factor)) {
      finding_skip(b->f, b->j, "the printed start cannot be simulated");
      return true;
    }
  }
  if (n == 0) return claim_error(b->j, b->c, "friction", "factors greater than 1, as in \"1.25 2\"");
  b->f->verdict = VERDICT_DEFINITION; /* the paper says nothing of it */
  return true;
}
