/* Random motions watched by both routes: which modes occur, and how they follow one another. */
#include <math.h>

#include "friction.h"
#include "verdict.h"

/* --- Nine pairs of modes, four kinds of phase --- */

struct modes {
  long seen[N_MODE_PAIRS]; /* phases, by the integration */
  struct answers rows[N_MOTION_ROUTES];
};

/* (2) at one moment: a moving mass feels +-u_s against its motion over the belt, a sticking one at most u_r. */
static bool obeys(const struct coulomb_row *row, const struct coulomb_setup *m) {
  const double *p = m->params;
  double f[2];
  bool ok = true;
  coulomb_forces(f, p, row->x);
  for (int i = 0; i < 2; i++) {
    double lag = p[COULOMB_V] - row->v[i], fine = 1e-9 * (1 + p[COULOMB_V]);
    if (row->mode[i] == MODE_STICK)
      ok = ok && fabs(lag) <= fine && fabs(f[i]) <= p[COULOMB_UR1 + i] * (1 + 1e-9);
    else
      ok = ok && (fabs(lag) <= fine || row->u[i] == copysign(p[COULOMB_US1 + i], lag));
  }
  return ok;
}

/* Samples that obey (2), and such as do not. */
static void count_rows(struct answers rows[N_MOTION_ROUTES], const struct coulomb_setup *m,
                       const struct trajectory trajectory[N_MOTION_ROUTES]) {
  for (int r = 0; r < N_MOTION_ROUTES; r++)
    for (size_t i = 0; i < trajectory[r].n_rows; i++) rows[r].of[obeys(&trajectory[r].row[i], m)]++;
}

static void watch_modes(void *self, const struct coulomb_setup *m,
                        const struct trajectory trajectory[N_MOTION_ROUTES]) {
  struct modes *s = self;
  for (size_t i = 0; i < trajectory[0].log.n; i++) s->seen[mode_index(trajectory[0].log.event[i].at.mode)]++;
  count_rows(s->rows, m, trajectory);
}

bool behaviour_modes(struct behaviour *b) {
  struct modes s = {.seen = {0}};
  struct route_result proof = events_prove_modes(b);
  struct watched w = behaviour_watch(b, watch_modes, &s);
  struct text note = {0};
  text_printf(&note,
              "%ld motions from initial states all over the phase space%s, each in one of the nine configurations at "
              "all %ld instants examined; numbers of phases of each kind:",
              w.motions,
              w.apart ? result_str(b->j->out, " (%ld more left out, with a contact of higher order)", w.apart) : "",
              answers_given(&s.rows[0]));
  for (int i = 0; i < N_MODE_PAIRS; i++) text_printf(&note, " %c %ld", mode_letters[i], s.seen[i]);
  text_add(&note, " (D both stick, G g m_1 slips, C c m_2 slips, H h X x both slip; small letters: faster than the "
                  "belt, X x: one faster, one slower)");
  behaviour_conclude(b, s.rows, w.motions, result_take(b->j->out, &note), &proof);
  return true;
}

/* --- Transitions --- */

struct switches {
  bool to_stick, sliding_limit; /* which transition; the limit is u_s instead of u_r */
  struct answers events[N_MOTION_ROUTES], rows[N_MOTION_ROUTES];
  long crossings;
};

static bool at_event(struct switches *s, const struct coulomb_event *e, const struct coulomb_setup *m) {
  int i = e->mass;
  const double *p = m->params;
  double forces[2];
  coulomb_forces(forces, p, e->at.x);
  double f = forces[i], limit = p[(s->sliding_limit ? COULOMB_US1 : COULOMB_UR1) + i],
         fine = 1e-8 * (1 + fabs(e->at.x[0]));
  if (fabs(e->at.v[i] - p[COULOMB_V]) > fine) return false;
  if (e->from == MODE_STICK) return fabs(fabs(f) - limit) <= fine;
  return e->to == MODE_STICK ? fabs(f) <= limit + fine : fabs(f) >= limit - fine;
}

static void watch_switches(void *self, const struct coulomb_setup *m,
                           const struct trajectory trajectory[N_MOTION_ROUTES]) {
  struct switches *s = self;
  for (int r = 0; r < N_MOTION_ROUTES; r++)
    for (size_t i = 0; i < trajectory[r].log.n; i++) {
      const struct coulomb_event *e = &trajectory[r].log.event[i];
      if ((e->from != MODE_STICK) != s->to_stick) continue;
      s->crossings += r == 0 && e->from != MODE_STICK && e->to != MODE_STICK;
      s->events[r].of[at_event(s, e, m)]++;
    }
  count_rows(s->rows, m, trajectory);
}

static void conclude_switches(struct behaviour *b, struct switches *s, const struct route_result *proof) {
  struct watched w = behaviour_watch(b, watch_switches, s);
  for (int r = 0; r < N_MOTION_ROUTES; r++) s->events[r].of[TRUTH_FALSE] += s->rows[r].of[TRUTH_FALSE];
  long events = answers_given(&s->events[0]);
  const char *note;
  if (s->to_stick)
    note = result_str(b->j->out,
                      "%ld motions, %ld moments at which a mass reaches the belt's velocity: it sticks where the force "
                      "is within the limit, and crosses to the other side of the belt's velocity where it is not (%ld)",
                      w.motions, events, s->crossings);
  else
    note = result_str(
        b->j->out,
        "%ld motions, %ld masses break loose, each with its force at the limit; no sticking mass has a greater one",
        w.motions, events);
  long otherwise = s->events[0].of[TRUTH_FALSE];
  if (otherwise) note = result_str(b->j->out, "%s, but for %ld", note, otherwise);
  behaviour_conclude(b, s->events, events, note, proof);
}

bool behaviour_switches(struct behaviour *b) {
  struct switches s = {.to_stick = claim_says(b->c, "transition", "slip to stick"),
                       .sliding_limit = claim_says(b->c, "limit", "u_s")};
  if (!s.to_stick && !claim_says(b->c, "transition", "stick to slip"))
    return claim_error(b->j, b->c, "transition", "\"slip to stick\" or \"stick to slip\"");
  if (claim_get(b->c, "limit") && !s.sliding_limit && !claim_says(b->c, "limit", "u_r"))
    return claim_error(b->j, b->c, "limit", "u_r or u_s");
  struct route_result proof = s.to_stick ? events_prove_stick(b) : events_prove_slip(b, s.sliding_limit);
  conclude_switches(b, &s, &proof);
  return true;
}
