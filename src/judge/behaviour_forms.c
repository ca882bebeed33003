/* The printed closed forms (4), (6), (8) with the equilibrium of (3), over whole phases of motions: the paper's
   matrices carry z = x - d_0 from one event to the next, and both routes say where the masses are by then. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "behaviour.h"
#include "value/expression.h"
#include "verdict.h"

enum { ARCS_PER_LETTER = 4 };
struct arcs {
  struct behaviour *b;
  long printed[N_MODE_PAIRS][2], with_signs[2]; /* agree, differ */
  const char *where;
  bool failed;
};

/* The point at which the paper's matrices are wanted: time t, the motion's parameters. */
static void arc_point(struct point *p, const struct motion *m, enum phase phase, double t) {
  static const int to[] = {Q_CHI, Q_ETA, Q_V, Q_US1, Q_US2};
  p->kind = POINT_FLOW;
  p->phase = phase;
  for (int i = 0; i < 5; i++) num_q_set_d(&p->q[to[i]], m->params[COULOMB_CHI + i]);
  for (int i = 0; i < 2; i++) {
    num_q_set_d(&p->q[Q_E1 + i], m->params[COULOMB_UR1 + i]);
    fmpq_sub(&p->q[Q_E1 + i], &p->q[Q_E1 + i], &p->q[Q_US1 + i]);
  }
  num_q_set_d(&p->q[Q_T], t);
}

/* The paper's own expression at the point, in doubles. */
static bool paper_value(double *out, int n, struct arcs *a, const char *expression, const char *section,
                        const struct point *p) {
  arb_ptr v = _arb_vec_init(16);
  int got;
  bool ok =
      expression_at(v, &got, a->b->view, expression, section, p, FIRST_PREC, a->b->j->cache, a->b->j->d) == SS_OK &&
      got == n;
  for (int i = 0; i < n; i++) out[i] = num_arb.get_d(v + i);
  _arb_vec_clear(v, 16);
  return ok;
}

/* Positions by x = d + (matrix (x - d, x'))_1,2 less those that the route found, relative to the state. */
static double gap(const double matrix[16], const double d[2], const struct coulomb_row *from,
                  const struct coulomb_row *to) {
  double z[N_STATE] = {from->x[0] - d[0], from->x[1] - d[1], from->v[0], from->v[1]}, worst = 0, size = 1;
  for (int i = 0; i < 2; i++) {
    double x = d[i];
    for (int k = 0; k < N_STATE; k++) x += matrix[4 * i + k] * z[k];
    worst = fmax(worst, fabs(x - to->x[i]));
    size = fmax(size, fmax(fabs(x), fabs(to->x[i])));
  }
  return worst / size;
}

static void try_arc(struct arcs *a, const struct motion *m, const struct coulomb_row *from[N_MOTION_ROUTES],
                    const struct coulomb_row *to[N_MOTION_ROUTES]) {
  static const char *const matrices[] = {NULL, "Gamma(t)", "H(t)", "C(t)", "Gamma(t)", "H(t)", "C(t)", "H(t)", "H(t)"};
  static const enum phase phases[] = {PHASE_D, PHASE_GAMMA, PHASE_H, PHASE_C, PHASE_GAMMA,
                                      PHASE_H, PHASE_C,     PHASE_H, PHASE_H};
  int letter = mode_index(from[0]->mode);
  double matrix[16], d[2], signs[2], signed_d[2], worst[2] = {0, 0}, least = INFINITY;
  const double *q = m->params;
  struct point p;
  point_init(&p);
  arc_point(&p, m, phases[letter], to[0]->t - from[0]->t);
  a->failed = !paper_value(matrix, 16, a, matrices[letter], "appendix_a", &p) ||
              !paper_value(d, 1, a, "d_01", "prediction", &p) || !paper_value(d + 1, 1, a, "d_02", "prediction", &p);
  point_clear(&p);
  for (int i = 0; i < 2; i++) signs[i] = from[0]->mode[i] == MODE_ABOVE ? -1 : 1;
  signed_d[0] = (signs[0] * q[COULOMB_US1] + signs[1] * q[COULOMB_US2]) / (1 - q[COULOMB_CHI]);
  signed_d[1] = signed_d[0] + signs[1] * q[COULOMB_US2] / q[COULOMB_CHI];
  for (int r = 0; r < N_MOTION_ROUTES; r++) {
    double printed = gap(matrix, d, from[r], to[r]);
    least = fmin(least, printed);
    worst[0] = fmax(worst[0], printed);
    worst[1] = fmax(worst[1], gap(matrix, signed_d, from[r], to[r]));
  }
  bool agrees = worst[0]<1e-8, differs = least> 1e-4;
  if (agrees || differs) a->printed[letter][differs]++;
  a->with_signs[worst[1] >= 1e-8]++;
  if (!differs || a->where) return;
  struct text t;
  text_init(&t);
  motion_print(&t, m);
  a->where = result_str(a->b->j->out, "phase %c from t = %.6f to %.6f of the motion %s", mode_letters[letter],
                        from[0]->t, to[0]->t, text_str(&t));
  text_clear(&t);
}

static void watch_arcs(void *self, const struct motion *m, const struct trajectory trajectory[N_MOTION_ROUTES]) {
  struct arcs *a = self;
  for (size_t i = 0; !a->failed && i + 1 < trajectory[0].log.n; i++) {
    const struct coulomb_row *from[N_MOTION_ROUTES], *to[N_MOTION_ROUTES];
    for (int r = 0; r < N_MOTION_ROUTES; r++) {
      from[r] = &trajectory[r].log.event[i].at;
      to[r] = &trajectory[r].log.event[i + 1].at;
    }
    int letter = mode_index(from[0]->mode);
    bool wanted = letter > 0 && to[0]->t - from[0]->t > 0.25;
    if (wanted && a->printed[letter][0] + a->printed[letter][1] < ARCS_PER_LETTER) try_arc(a, m, from, to);
  }
}

/* (3), (5) and (7) speak of masses that are not faster than the belt: phases G, H and C decide.  What becomes of the
   closed forms where a mass overruns it is said beside. */
static void state_overrun(struct behaviour *b, const struct arcs *a) {
  long agree = 0, differ = 0;
  for (int i = N_PHASES; i < N_MODE_PAIRS; i++) {
    agree += a->printed[i][0];
    differ += a->printed[i][1];
  }
  finding_state(
      b->f, b->j->out, motion_route_name[BY_INTEGRATION], "model", -1, 1, a->where,
      result_str(b->j->out,
                 "of phases in which a mass is faster than the belt, %ld agree and %ld differ: its friction has "
                 "the other sign; with d_01 = (eps_1*u_s1 + eps_2*u_s2)/(1 - chi), d_02 = (eps_1*u_s1*chi + "
                 "eps_2*u_s2)/((1 - chi)*chi), eps_i = sign(V - x'_i) for a slipping mass, %ld of all %ld phases "
                 "agree",
                 agree, differ, a->with_signs[0], a->with_signs[0] + a->with_signs[1]));
}

bool behaviour_closed_forms(struct behaviour *b) {
  struct arcs a = {.b = b};
  struct watched w = behaviour_watch(b, 96, true, 24, 0, watch_arcs, &a);
  if (a.failed) return claim_error(b->j, b->c, "check", "the paper's matrices or equilibrium cannot be evaluated");
  struct text note;
  long count[2] = {0, 0};
  text_init(&note);
  text_printf(
      &note,
      "the matrices with d_01, d_02 over whole phases of %ld motions that start as in (11), against both routes; "
      "agree and differ where no mass is faster than the belt:",
      w.motions);
  for (int i = PHASE_GAMMA; i < N_PHASES; i++) {
    text_printf(&note, "%s %ld and %ld in %s", i == PHASE_GAMMA ? "" : ",", a.printed[i][0], a.printed[i][1],
                i == PHASE_GAMMA ? "Gamma"
                : i == PHASE_H   ? "H"
                                 : "C");
    for (int k = 0; k < 2; k++) count[k] += a.printed[i][k];
  }
  enum route_outcome outcome[N_MOTION_ROUTES];
  for (int r = 0; r < N_MOTION_ROUTES; r++) outcome[r] = outcome_of_counts(count[0], count[1], 0);
  behaviour_conclude(b, outcome, count[0] + count[1], count[1] ? a.where : NULL, result_take(b->j->out, &note));
  state_overrun(b, &a);
  return true;
}
