/* The phase space and what starts in it: the dimension of each mode's set of states, linearity inside a mode, small
   perturbations of the global stick phase, and orbits as fixed points. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "behaviour.h"
#include "proof/exact_law.h"
#include "value/coulomb_setup.h"
#include "verdict.h"

enum { STATES = 24 };

/* --- Dimension --- */

/* States met in each mode by the motions of one set of parameters. */
struct met {
  double z[N_MODE_PAIRS][STATES][N_STATE];
  int n[N_MODE_PAIRS];
};

static void meet(struct met *s, const struct coulomb_row *row) {
  int k = mode_index(row->mode);
  if (s->n[k] == STATES) return;
  double *z = s->z[k][s->n[k]++];
  for (int i = 0; i < 2; i++) {
    z[Z_1 + i] = row->x[i];
    z[DZ_1 + i] = row->v[i];
  }
}

/* The dimension of the plane through the states: the rank of their differences, exact, since doubles are rationals. */
static long affine_rank(const double z[][N_STATE], int n) {
  fmpq_mat_t m;
  fmpq_t first;
  mpq_t q;
  mpq_init(q);
  fmpq_init(first);
  fmpq_mat_init(m, n, N_STATE);
  for (int i = 0; i < n; i++)
    for (int k = 0; k < N_STATE; k++) {
      mpq_set_d(q, z[i][k]);
      fmpq_set_mpq(fmpq_mat_entry(m, i, k), q);
      mpq_set_d(q, z[0][k]);
      fmpq_set_mpq(first, q);
      fmpq_sub(fmpq_mat_entry(m, i, k), fmpq_mat_entry(m, i, k), first);
    }
  long rank = (long)fmpq_mat_rref(m, m);
  fmpq_mat_clear(m);
  fmpq_clear(first);
  mpq_clear(q);
  return rank;
}

/* In how many of the four directions a state can be moved both ways without leaving its mode: the law alone decides. */
static int free_directions(const double params[N_COULOMB], const double z[N_STATE]) {
  enum coulomb_mode here[2], there[2];
  int count = 0;
  coulomb_law_d(here, params, z);
  for (int k = 0; k < N_STATE; k++) {
    bool stays = true;
    for (int side = -1; side <= 1; side += 2) {
      double moved[N_STATE];
      memcpy(moved, z, sizeof moved);
      moved[k] += side * 1e-9 * (1 + fabs(z[k]));
      coulomb_law_d(there, params, moved);
      stays = stays && there[0] == here[0] && there[1] == here[1];
    }
    count += stays;
  }
  return count;
}

static void meet_motions(struct met met[N_MOTION_ROUTES], struct motion *m, const char *id) {
  enum { MOTIONS = 96 };
  struct sampler s;
  sampler_init(&s, id, POINT_PARAMS, PHASE_D, NULL);
  motion_params(m, &s);
  for (int i = 0; i < MOTIONS; i++) {
    struct coulomb_plan plan = coulomb_plan_default;
    plan.duration = 8;
    plan.sample = 0.75;
    motion_start(m, &s, i % 3 == 0);
    for (int r = 0; r < N_MOTION_ROUTES; r++) {
      struct trajectory t = motion_simulate((enum motion_route)r, m, &plan);
      for (size_t k = 1; k < t.n_rows; k++) meet(&met[r], &t.row[k]); /* the start may lie on a boundary */
      trajectory_clear(&t);
    }
  }
}

/* "2 4" as the least and the greatest dimension. */
static bool claimed_range(long range[2], struct behaviour *b) {
  const char *text = claim_get(b->c, "range");
  char *end = NULL;
  if (text) range[0] = strtol(text, &end, 10);
  if (text) range[1] = strtol(end, &end, 10);
  return (text && *end == '\0' && range[0] >= 0 && range[1] <= N_STATE && range[0] <= range[1]) ||
         claim_error(b->j, b->c, "range", "the least and the greatest dimension, as in \"2 4\"");
}

bool behaviour_dimension(struct behaviour *b) {
  long claimed[2] = {0, 0};
  if (!claimed_range(claimed, b)) return false;
  struct met *met = ss_malloc(N_MOTION_ROUTES * sizeof *met);
  struct motion m;
  struct text note;
  struct route_result w[N_MOTION_ROUTES];
  memset(met, 0, N_MOTION_ROUTES * sizeof *met);
  meet_motions(met, &m, b->c->id);
  text_init(&note);
  text_add(&note, "dimension of the states met in each mode, of both routes:");
  for (int r = 0; r < N_MOTION_ROUTES; r++) {
    long least = N_STATE, most = 0, modes = 0, against = 0;
    for (int k = 0; k < N_MODE_PAIRS; k++) {
      if (met[r].n[k] <= N_STATE) continue;
      long rank = affine_rank((const double(*)[N_STATE])met[r].z[k], met[r].n[k]);
      for (int i = 0; i < met[r].n[k]; i++) against += free_directions(m.params, met[r].z[k][i]) != rank;
      if (r == BY_INTEGRATION) text_printf(&note, " %c %ld", mode_letters[k], rank);
      least = rank < least ? rank : least;
      most = rank > most ? rank : most;
      modes++;
    }
    bool all = modes == N_MODE_PAIRS && against == 0;
    if (r == BY_INTEGRATION)
      text_add(&note, against ? "; the law disagrees" : "; the law leaves as many directions free at each of them");
    enum route_outcome outcome = !all                                        ? ROUTE_UNDECIDED
                                 : least == claimed[0] && most == claimed[1] ? ROUTE_AGREES
                                                                             : ROUTE_DIFFERS;
    w[r] = behaviour_route(b, motion_route_name[r], "model", outcome, r == BY_INTEGRATION, modes, NULL,
                           r == BY_INTEGRATION ? result_str(b->j->out, "%s", text_str(&note)) : NULL);
  }
  b->f->verdict = verdict_of(w, N_MOTION_ROUTES, false);
  text_clear(&note);
  free(met);
  return true;
}

/* --- Linearity inside a mode --- */

/* The state after the time, if the motion stays in its mode so long. */
static bool carried(double z[N_STATE], enum motion_route r, const struct motion *m, double time) {
  struct coulomb_plan plan = coulomb_plan_default;
  plan.duration = time;
  struct trajectory t = motion_simulate(r, m, &plan);
  bool ok = t.status == SS_OK && t.log.n == 0;
  for (int i = 0; i < 2; i++) {
    z[Z_1 + i] = t.result.at.x[i];
    z[DZ_1 + i] = t.result.at.v[i];
  }
  trajectory_clear(&t);
  return ok;
}

/* A start and two others beside it in the same mode, and the fourth corner of the parallelogram. */
static bool corners(struct motion m[4], struct sampler *s) {
  enum coulomb_mode mode[2], other[2];
  struct point p;
  point_init(&p);
  motion_start(&m[0], s, false);
  coulomb_law_d(mode, m[0].params, m[0].start);
  m[3] = m[0];
  for (int i = 1; i <= 2; i++) {
    sampler_next(&p, s);
    m[i] = m[0];
    for (int k = 0; k < N_STATE; k++) {
      double step = fmpq_get_d(&p.q[Q_Z1 + k]) / 16;
      if (k >= DZ_1 && mode[k - DZ_1] == MODE_STICK) continue;
      m[i].start[k] += step;
      m[3].start[k] += step;
    }
  }
  point_clear(&p);
  bool same = true;
  for (int i = 1; i < 4; i++) {
    coulomb_law_d(other, m[i].params, m[i].start);
    same = same && other[0] == mode[0] && other[1] == mode[1];
  }
  return same;
}

bool behaviour_linear(struct behaviour *b) {
  enum { DRAWS = 400, EACH = 4 };
  long tried[N_MODE_PAIRS] = {0}, good[N_MOTION_ROUTES] = {0}, bad[N_MOTION_ROUTES] = {0}, modes = 0, total = 0;
  struct sampler s;
  sampler_init(&s, b->c->id, POINT_PARAMS, PHASE_D, NULL);
  for (int i = 0; i < DRAWS; i++) {
    struct motion m[4];
    double z[N_MOTION_ROUTES][4][N_STATE];
    enum coulomb_mode mode[2];
    motion_params(&m[0], &s);
    if (!corners(m, &s)) continue;
    coulomb_law_d(mode, m[0].params, m[0].start);
    int letter = mode_index(mode);
    bool stays = tried[letter] < EACH;
    for (int r = 0; r < N_MOTION_ROUTES; r++)
      for (int k = 0; stays && k < 4; k++) stays = carried(z[r][k], (enum motion_route)r, &m[k], 0.375);
    if (!stays) continue;
    tried[letter]++;
    total++;
    modes += tried[letter] == 1;
    for (int r = 0; r < N_MOTION_ROUTES; r++) {
      double worst = 0, size = 1;
      for (int k = 0; k < N_STATE; k++) {
        worst = fmax(worst, fabs(z[r][0][k] - z[r][1][k] - z[r][2][k] + z[r][3][k]));
        size = fmax(size, fabs(z[r][0][k]));
      }
      *(worst < 1e-9 * size ? &good[r] : &bad[r]) += 1;
    }
  }
  struct route_result w[N_MOTION_ROUTES];
  const char *note = result_str(b->j->out,
                                "differences of motions add up inside a mode: %ld quadruples of starts in %ld of the "
                                "nine modes",
                                total, modes);
  for (int r = 0; r < N_MOTION_ROUTES; r++) {
    enum route_outcome outcome = bad[r]                             ? ROUTE_DIFFERS
                                 : good[r] && modes == N_MODE_PAIRS ? ROUTE_AGREES
                                                                    : ROUTE_UNDECIDED;
    w[r] = behaviour_route(b, motion_route_name[r], "model", outcome, r == BY_INTEGRATION, total, NULL,
                           r == BY_INTEGRATION ? note : NULL);
  }
  b->f->verdict = verdict_of(w, N_MOTION_ROUTES, false);
  return true;
}

/* --- Admissible orbits --- */

enum { ORBITS = 12, ORBIT_DRAWS = 80 };

/* What must hold of the motion that starts on an admissible orbit. */
typedef bool (*orbit_fn)(enum motion_route r, const struct motion *m);

/* Tries it on admissible orbits of the pool, by both routes, with two static frictions. */
static void judge_orbits(struct behaviour *b, orbit_fn holds, const char *note, bool proved) {
  static const double friction[] = {OWN_FRICTION, 2};
  struct sampler s;
  struct point p;
  struct orbit_set seen = {.n = 0};
  long good[N_MOTION_ROUTES] = {0}, bad[N_MOTION_ROUTES] = {0}, orbits = 0;
  sampler_init(&s, b->c->id, POINT_ORBIT, PHASE_D, NULL);
  s.admissible = true;
  point_init(&p);
  for (int i = 0; i < ORBIT_DRAWS && orbits < ORBITS; i++) {
    struct motion m;
    sampler_next(&p, &s);
    if (!point_settle(&p, b->j->cache)) continue;
    const struct dyn_orbit *o = &orbit_cache_get(b->j->cache, p.q, FD_PREC + 64)->orbit[p.orbit];
    if (o->grazing || !orbit_is_new(&seen, o)) continue;
    orbits++;
    for (int k = 0; k < 2; k++)
      for (int r = 0; r < N_MOTION_ROUTES; r++) {
        bool ok = motion_on_orbit(&m, &p, o, friction[k]) && holds((enum motion_route)r, &m);
        *(ok ? &good[r] : &bad[r]) += 1;
      }
  }
  point_clear(&p);
  struct route_result w[N_MOTION_ROUTES];
  const char *words =
      result_str(b->j->out, "%ld admissible orbits, each with u_ri = 5/4 and 2 times what it needs: %s", orbits, note);
  for (int r = 0; r < N_MOTION_ROUTES; r++)
    w[r] = behaviour_route(b, motion_route_name[r], "model", outcome_of_counts(good[r], bad[r], 0), r == BY_INTEGRATION,
                           good[r] + bad[r], NULL, r == BY_INTEGRATION ? words : NULL);
  b->f->verdict = verdict_of(w, N_MOTION_ROUTES, proved);
}

/* The distance from each limit of (11): e1 - w, w - (e1 - 2 u_r1), e2 - chi r, chi r - (e2 - 2 u_r2); the least. */
static double least_margin(const struct motion *m) {
  const double *p = m->params, *x = m->start;
  double f[2] = {x[0] - p[COULOMB_CHI] * x[1], p[COULOMB_CHI] * (x[1] - x[0])}, least = INFINITY;
  for (int i = 0; i < 2; i++) least = fmin(least, p[COULOMB_UR1 + i] - fabs(f[i]));
  return least;
}

/* Positions moved eight ways so that the forces change by less than their least margin. */
static bool still_sticks(enum motion_route r, const struct motion *m) {
  static const double side[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
  double size = 0.99 * least_margin(m) / (1 + m->params[COULOMB_CHI]);
  bool ok = size > 0;
  for (int i = 0; i < 8; i++) {
    struct motion moved = *m;
    enum coulomb_mode mode[2];
    struct coulomb_plan plan = coulomb_plan_default;
    for (int k = 0; k < 2; k++) moved.start[k] += size * side[i][k];
    coulomb_law_d(mode, moved.params, moved.start);
    plan.duration = 1000;
    plan.max_events = 1;
    struct trajectory t = motion_simulate(r, &moved, &plan);
    ok = ok && mode[0] == MODE_STICK && mode[1] == MODE_STICK && t.log.n == 1 && t.log.event[0].at.t > 0 &&
         t.log.event[0].mass == 0 && t.log.event[0].from == MODE_STICK;
    trajectory_clear(&t);
  }
  return ok;
}

/* The forces are below their limits by (2), and affine in the positions. */
static bool prove_small(struct behaviour *b) {
  struct text reach[2];
  for (int i = 0; i < 2; i++) text_init(&reach[i]);
  bool proved = exact_law_reach(reach);
  if (proved) {
    struct evidence *e = finding_add(b->f, b->j->out);
    e->route = "exact";
    e->layer = "model";
    e->result = "proved";
    e->note =
        result_str(b->j->out,
                   "by (2) each force is below its limit where the phase begins and throughout it, and changes of "
                   "z_10 and z_20 by at most r change the force on m_1 by at most (%s) r and that on m_2 by at most "
                   "(%s) r; so both masses stick wherever these are smaller than the least distances of the forces "
                   "from their limits",
                   text_str(&reach[0]), text_str(&reach[1]));
  }
  for (int i = 0; i < 2; i++) text_clear(&reach[i]);
  return proved;
}

bool behaviour_small(struct behaviour *b) {
  judge_orbits(b, still_sticks,
               "positions moved eight ways at the start by as much as 0.99 of the least distance of a force from its "
               "limit, over 1 + chi; both masses stick until m_1 breaks loose. \"Small\" means smaller than that",
               prove_small(b));
  return true;
}

static bool comes_back(enum motion_route r, const struct motion *m) {
  struct coulomb_plan plan = coulomb_plan_default;
  struct text word;
  plan.returns = 1;
  plan.max_events = 64;
  struct trajectory t = motion_simulate(r, m, &plan);
  text_init(&word);
  coulomb_log_word(&word, &t.log);
  double gap = 0;
  for (int i = 0; i < 2; i++) gap = fmax(gap, fabs(t.result.at.x[i] - m->start[i]) / (1 + fabs(m->start[i])));
  bool ok = t.status == SS_OK && gap < 1e-8 && strcmp(text_str(&word), "GHCD") == 0;
  text_clear(&word);
  trajectory_clear(&t);
  return ok;
}

bool behaviour_fixed_points(struct behaviour *b) {
  judge_orbits(b, comes_back, "the motion from its start goes G H C D and comes back to that start", false);
  return true;
}
