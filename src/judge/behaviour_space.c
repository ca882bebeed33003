/* What starts on admissible orbits: small perturbations of the global stick phase, and orbits as fixed points. */
#include <math.h>
#include <string.h>

#include "friction.h"

/* --- Admissible orbits --- */

enum { ORBITS = 12, ORBIT_DRAWS = 80 };

/* What must hold of the motion that starts on an admissible orbit. */
typedef bool (*orbit_fn)(enum motion_route r, const struct coulomb_setup *m);

/* Tries it on admissible orbits of the pool, by both routes, with two static frictions. */
static void judge_orbits(struct behaviour *b, orbit_fn holds, const char *note, const struct route_result *proof) {
  static const double friction[] = {OWN_FRICTION, 2};
  OWNED(orbit_walk) walk;
  const struct dyn_orbit *o;
  struct answers said[N_MOTION_ROUTES] = {{{0}}, {{0}}};
  long orbits = 0;
  orbit_walk_begin(&walk, b, true, ORBIT_DRAWS);
  for (; orbits < ORBITS && (o = orbit_walk_next(&walk)) != NULL; orbits++)
    for (int k = 0; k < 2; k++)
      for (int r = 0; r < N_MOTION_ROUTES; r++) {
        struct coulomb_setup m;
        bool ok = coulomb_setup_on_orbit(&m, walk.p.q + Q_CHI, o, friction[k]) == SS_OK;
        ok = ok && holds((enum motion_route)r, &m);
        said[r].of[ok]++;
      }
  behaviour_conclude(
      b, said, answers_given(&said[0]),
      result_str(b->j->out, "%ld admissible orbits, each with u_ri = 5/4 and 2 times what it needs: %s", orbits, note),
      proof);
}

/* The distance from each limit of (11): e1 - w, w - (e1 - 2 u_r1), e2 - chi r, chi r - (e2 - 2 u_r2); the least. */
static double least_margin(const struct coulomb_setup *m) {
  double f[2];
  coulomb_forces(f, m->params, m->start);
  return fmin(m->params[COULOMB_UR1] - fabs(f[0]), m->params[COULOMB_UR2] - fabs(f[1]));
}

/* Positions moved eight ways so that the forces change by less than their least margin. */
static bool still_sticks(enum motion_route r, const struct coulomb_setup *m) {
  static const double side[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
  double size = 0.99 * least_margin(m) / (1 + m->params[COULOMB_CHI]);
  bool ok = size > 0;
  for (int i = 0; i < 8; i++) {
    struct coulomb_setup moved = *m;
    enum coulomb_mode mode[2];
    struct coulomb_plan plan = coulomb_plan_default;
    for (int k = 0; k < 2; k++) moved.start[k] += size * side[i][k];
    coulomb_law_d(mode, moved.params, moved.start);
    plan.duration = 1000;
    plan.max_events = 1;
    OWNED(trajectory) t = motion_simulate(r, &moved, &plan);
    ok = ok && mode[0] == MODE_STICK && mode[1] == MODE_STICK && t.log.n == 1 && t.log.event[0].at.t > 0 &&
         t.log.event[0].mass == 0 && t.log.event[0].from == MODE_STICK;
  }
  return ok;
}

bool behaviour_small(struct behaviour *b) {
  const struct route_result proof = events_prove_small(b);
  judge_orbits(b, still_sticks,
               "positions moved eight ways at the start by as much as 0.99 of the least distance of a force from its "
               "limit, over 1 + chi; both masses stick until m_1 breaks loose. \"Small\" means smaller than that",
               &proof);
  return true;
}

static bool comes_back(enum motion_route r, const struct coulomb_setup *m) {
  struct coulomb_plan plan = coulomb_plan_default;
  OWNED(text) word = {0};
  plan.returns = 1;
  plan.max_events = 64;
  OWNED(trajectory) t = motion_simulate(r, m, &plan);
  coulomb_log_word(&word, &t.log);
  double gap = 0;
  for (int i = 0; i < 2; i++) gap = fmax(gap, fabs(t.result.at.x[i] - m->start[i]) / (1 + fabs(m->start[i])));
  return t.status == SS_OK && gap < 1e-8 && strcmp(text_str(&word), "GHCD") == 0;
}

bool behaviour_fixed_points(struct behaviour *b) {
  struct route_result proof = phases_prove_motion(b);
  judge_orbits(b, comes_back, "the motion from its start goes G H C D and comes back to that start", &proof);
  return true;
}
