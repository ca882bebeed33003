/* Random motions watched by both routes: which modes occur, and how they follow one another. */
#include <math.h>
#include <string.h>

#include "friction.h"
#include "value/coulomb_setup.h"
#include "verdict.h"

/* --- Nine pairs of modes, four kinds of phase --- */

enum { N_PAPER_LETTERS = 4 }; /* D, G, H, C come first */

struct modes {
  long seen[N_MODE_PAIRS]; /* phases, by the integration */
  struct by_route rows;
};

/* (2) at one moment: a moving mass feels +-u_s against its motion over the belt, a sticking one at most u_r. */
static bool obeys(const struct coulomb_row *row, const struct motion *m) {
  const double *p = m->params;
  bool ok = true;
  for (int i = 0; i < 2; i++) {
    double lag = p[COULOMB_V] - row->v[i], fine = 1e-9 * (1 + p[COULOMB_V]);
    if (row->mode[i] == MODE_STICK)
      ok = ok && fabs(lag) <= fine && fabs(motion_force(m, row->x, i)) <= p[COULOMB_UR1 + i] * (1 + 1e-9);
    else
      ok = ok && (fabs(lag) <= fine || row->u[i] == copysign(p[COULOMB_US1 + i], lag));
  }
  return ok;
}

/* Samples that obey (2), and such as do not. */
static void count_rows(struct by_route *rows, const struct motion *m,
                       const struct trajectory trajectory[N_MOTION_ROUTES]) {
  for (int r = 0; r < N_MOTION_ROUTES; r++)
    for (size_t i = 0; i < trajectory[r].n_rows; i++) (obeys(&trajectory[r].row[i], m) ? rows->good : rows->bad)[r]++;
}

static void watch_modes(void *self, const struct motion *m, const struct trajectory trajectory[N_MOTION_ROUTES]) {
  struct modes *s = self;
  for (size_t i = 0; i < trajectory[0].log.n; i++) s->seen[mode_index(trajectory[0].log.event[i].at.mode)]++;
  count_rows(&s->rows, m, trajectory);
}

bool behaviour_modes(struct behaviour *b) {
  struct modes s = {.seen = {0}};
  struct route_result proof = events_prove_modes(b);
  struct watched w = behaviour_watch(b, 96, false, 12, 0.25, watch_modes, &s);
  struct text note;
  text_init(&note);
  text_printf(
      &note,
      "%ld motions from initial states all over the phase space (%ld more left out, with a contact of higher order), "
      "each in one of the nine configurations at all %ld instants examined; numbers of phases of each kind:",
      w.motions, w.apart, s.rows.good[0] + s.rows.bad[0]);
  for (int i = 0; i < N_MODE_PAIRS; i++) text_printf(&note, " %c %ld", mode_letters[i], s.seen[i]);
  text_add(&note, " (D both stick, G g m_1 slips, C c m_2 slips, H h X x both slip; small letters: faster than the "
                  "belt, X x: one faster, one slower)");
  behaviour_conclude(b, &s.rows, w.motions, NULL, result_take(b->j->out, &note), &proof);
  return true;
}

/* --- Do D, Gamma, H, C cover what happens? --- */

struct visits {
  struct behaviour *b;
  long inside, outside;
  struct by_route rows;     /* samples in one of the nine pairs of modes, as (2) has them, or not */
  double fastest;           /* largest lead over the belt, in belt speeds */
  const char *where, *told; /* the motion that has it; and in words */
  struct certificate certificate;
};

static void certify_number(struct visits *v, const char *name, double x) {
  certificate_add(&v->certificate, v->b->j->out, name, result_str(v->b->j->out, "%.12g", x));
}

/* A motion of which a mass is faster than the belt: its parameters and start, exactly, then when and how fast. */
static void certify(struct visits *v, const struct motion *m, const struct coulomb_row *row, int mass) {
  static const char *const parameter[N_COULOMB] = {"chi", "eta", "V", "u_s1", "u_s2", "u_r1", "u_r2"};
  static const char *const start[N_STATE] = {"x_1", "x_2", "x_1'", "x_2'"};
  v->certificate.n = 0;
  for (int i = 0; i < N_COULOMB; i++) certify_number(v, parameter[i], m->params[i]);
  for (int i = 0; i < N_STATE; i++) certify_number(v, start[i], m->start[i]);
  certify_number(v, "t", row->t);
  certify_number(v, "mass", mass + 1);
  certificate_add(&v->certificate, v->b->j->out, "velocity", result_str(v->b->j->out, "%.6f", row->v[mass]));
  struct text t;
  text_init(&t);
  for (int i = 0; i < N_COULOMB; i++) text_printf(&t, "%s%s = %.12g", i ? ", " : "for ", parameter[i], m->params[i]);
  text_printf(&t,
              " the motion that starts with both masses sticking at x_1 = %.12g and x_2 = %.12g has x'_%d = %.2f > V ",
              m->start[0], m->start[1], mass + 1, row->v[mass]);
  text_printf(&t, "at t = %.12g; (3), (5) and (7) suppose z'_i < V. ", row->t);
  v->told = result_take(v->b->j->out, &t);
}

static bool leaves_the_four(const struct coulomb_log *log) {
  bool out = false;
  for (size_t i = 0; i < log->n; i++) out = out || mode_index(log->event[i].at.mode) >= N_PAPER_LETTERS;
  return out;
}

static void watch_visits(void *self, const struct motion *m, const struct trajectory trajectory[N_MOTION_ROUTES]) {
  struct visits *v = self;
  double lead = 0;
  const struct coulomb_row *first = NULL; /* of which the lead is */
  int mass = 0;
  for (size_t i = 0; i < trajectory[0].n_rows; i++)
    for (int k = 0; k < 2; k++) {
      double here = trajectory[0].row[i].v[k] / m->params[COULOMB_V] - 1;
      if (here <= lead) continue;
      lead = here;
      first = &trajectory[0].row[i];
      mass = k;
    }
  bool out = leaves_the_four(&trajectory[0].log);
  *(out ? &v->outside : &v->inside) += 1;
  count_rows(&v->rows, m, trajectory);
  if (!out || lead < v->fastest + 0.01) return;
  v->fastest = lead;
  v->where = motion_text(v->b, m);
  certify(v, m, first, mass);
}

/* How many motions on admissible orbits stay inside. */
static void watch_orbits(long count[2], struct behaviour *b) {
  struct orbit_walk walk;
  const struct dyn_orbit *o;
  orbit_walk_begin(&walk, b, true, 40);
  while (count[0] + count[1] < 8 && (o = orbit_walk_next(&walk)) != NULL) {
    struct motion m;
    if (!motion_on_orbit(&m, &walk.p, o, OWN_FRICTION)) continue;
    struct coulomb_plan plan = coulomb_plan_default;
    plan.returns = 1;
    plan.max_events = 64;
    struct trajectory t = motion_simulate(BY_INTEGRATION, &m, &plan);
    count[leaves_the_four(&t.log)]++;
    trajectory_clear(&t);
  }
  orbit_walk_end(&walk);
}

/* Rest with unstretched springs, at the scene's parameters: an ordinary way to begin. */
static const char *from_rest(struct behaviour *b) {
  const struct scene *s = b->j->scene;
  struct coulomb_setup setup;
  struct diag d;
  diag_init(&d);
  if (!scene_has_forces(s) || !audit_coulomb_setup(&setup, s, 0, scene_printed(s, "z10") != NULL, &d)) return "";
  struct motion m = {.start = {0}};
  memcpy(m.params, setup.params, sizeof m.params);
  struct coulomb_plan plan = coulomb_plan_default;
  plan.duration = 400;
  struct trajectory t = motion_simulate(BY_INTEGRATION, &m, &plan);
  struct text word;
  text_init(&word);
  coulomb_log_word(&word, &t.log);
  const char *note = "";
  size_t n = strcspn(text_str(&word), "ghcXx");
  if (n < word.len)
    note = result_str(
        b->j->out, "; from rest with unstretched springs (simulate %s --start 0,0,0,0) the sequence of phases is H%.*s",
        s->name, (int)(n + 1 > 40 ? 40 : n + 1), text_str(&word));
  else
    note = result_str(
        b->j->out,
        "; for the data of the example no mass overruns the belt in the motion from rest with unstretched springs");
  text_clear(&word);
  trajectory_clear(&t);
  return note;
}

bool behaviour_configurations(struct behaviour *b) {
  struct visits v = {.b = b};
  long orbits[2] = {0, 0};
  struct watched w = behaviour_watch(b, 96, true, 24, 0.125, watch_visits, &v);
  watch_orbits(orbits, b);
  bool found = v.fastest > 0.1;
  const char *note = result_str(b->j->out,
                                "%s%s %ld motions that were tried and start with both masses sticking, as in (11), %ld "
                                "leave the four configurations; %s of %ld admissible periodic solutions %s them%s",
                                v.told ? v.told : "", v.told ? "Of" : "of", w.motions, v.outside,
                                orbits[1] ? result_str(b->j->out, "%ld", orbits[1]) : "none", orbits[0] + orbits[1],
                                orbits[1] ? "leave" : "leaves", from_rest(b));
  const struct by_route said = {{v.inside, v.inside}, {found, found}};
  behaviour_conclude(b, &said, w.motions, found ? v.where : NULL, note, NULL);
  if (b->f->verdict != VERDICT_REFUTED) return true;
  b->f->certificate = v.certificate;
  struct route_result all[N_MOTION_ROUTES];
  for (int r = 0; r < N_MOTION_ROUTES; r++)
    all[r] = behaviour_route(
        b, motion_route_name[r], "correction", outcome_of_counts(v.rows.good[r], v.rows.bad[r], 0), r == BY_INTEGRATION,
        v.rows.good[r] + v.rows.bad[r], NULL,
        "at every instant examined these motions are in one of the nine configurations, with the forces of (2)");
  b->f->correction = "nine configurations: for each mass x'_i = V with a force of at most u_ri (sticking), x'_i < V or "
                     "x'_i > V (slipping)";
  b->f->correction_verdict = verdict_of(all, N_MOTION_ROUTES, false);
  return true;
}

/* --- Transitions --- */

struct switches {
  bool to_stick, sliding_limit; /* which transition; the limit is u_s instead of u_r */
  struct by_route events, rows;
  long crossings;
};

static bool at_event(struct switches *s, const struct coulomb_event *e, const struct motion *m) {
  int i = e->mass;
  const double *p = m->params;
  double f = motion_force(m, e->at.x, i);
  double limit = p[(s->sliding_limit ? COULOMB_US1 : COULOMB_UR1) + i], fine = 1e-8 * (1 + fabs(e->at.x[0]));
  if (fabs(e->at.v[i] - p[COULOMB_V]) > fine) return false;
  if (e->from == MODE_STICK) return fabs(fabs(f) - limit) <= fine;
  return e->to == MODE_STICK ? fabs(f) <= limit + fine : fabs(f) >= limit - fine;
}

static void watch_switches(void *self, const struct motion *m, const struct trajectory trajectory[N_MOTION_ROUTES]) {
  struct switches *s = self;
  for (int r = 0; r < N_MOTION_ROUTES; r++)
    for (size_t i = 0; i < trajectory[r].log.n; i++) {
      const struct coulomb_event *e = &trajectory[r].log.event[i];
      if ((e->from != MODE_STICK) != s->to_stick) continue;
      s->crossings += r == 0 && e->from != MODE_STICK && e->to != MODE_STICK;
      (at_event(s, e, m) ? s->events.good : s->events.bad)[r]++;
    }
  count_rows(&s->rows, m, trajectory);
}

static void conclude_switches(struct behaviour *b, struct switches *s, const struct route_result *proof) {
  struct watched w = behaviour_watch(b, 96, false, 12, 0.25, watch_switches, s);
  for (int r = 0; r < N_MOTION_ROUTES; r++) s->events.bad[r] += s->rows.bad[r];
  long events = s->events.good[0] + s->events.bad[0];
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
  behaviour_conclude(b, &s->events, events, NULL, note, proof);
}

bool behaviour_switches(struct behaviour *b) {
  const char *which = claim_get(b->c, "transition"), *limit = claim_get(b->c, "limit");
  struct switches s = {.to_stick = which && strcmp(which, "slip to stick") == 0,
                       .sliding_limit = limit && strcmp(limit, "u_s") == 0};
  if (!s.to_stick && !(which && strcmp(which, "stick to slip") == 0))
    return claim_error(b->j, b->c, "transition", "\"slip to stick\" or \"stick to slip\"");
  struct friction law;
  struct behaviour with = *b;
  with.law = &law;
  bool ok = friction_open(&law, b);
  if (ok) {
    struct route_result proof = s.to_stick ? events_prove_stick(&with) : events_prove_slip(&with, s.sliding_limit);
    conclude_switches(b, &s, &proof);
  }
  friction_close(&law);
  return ok;
}
