/* What holds within the configurations, proved from (1) and (2) for each of the nine ways in which two masses stick, or
   slip slower or faster than the belt: linearity, the closed forms of the paper and where they stop, the dimension of
   each phase's states, and that a patched solution is a motion. */
#include <stdlib.h>

#include "friction.h"
#include "num/num_exact.h"
#include "value/expression.h"
#include "value/title.h"
#include "verdict.h"

enum { N_SLIPS = 3, N_PAIRS = N_SLIPS * N_SLIPS };
/* First the paper's: sticking, and slower than the belt. */
static const int slips_of[N_SLIPS] = {0, 1, -1};

/* --- Linearity --- */

static truth is_linear(const struct friction *f, const int slips[2]) {
  OWNED(law_state) s;
  law_state_open(&s, num_ctx_exact());
  truth all = friction_mode(f, &s, slips) ? TRUTH_TRUE : TRUTH_UNKNOWN;
  for (int i = 0; i < 2; i++) all = truth_and(all, law_affine(&s, s.a[i]));
  return all;
}

bool behaviour_linear(struct behaviour *b) {
  static const char *const says[] = {
      [TRUTH_TRUE] = ("in each of the nine configurations (either mass slower than the belt, with it, or faster): "
                      "by (1) and (2) each acceleration is a constant plus constants times x_1, x_2, x'_1 and x'_2"),
      [TRUTH_FALSE] = "in some configuration an acceleration is not affine in x_1, x_2, x'_1 and x'_2",
      [TRUTH_UNKNOWN] = "the accelerations are not known in every configuration"};
  truth all = TRUTH_TRUE;
  for (int i = 0; i < N_PAIRS; i++) {
    const int slips[2] = {slips_of[i / N_SLIPS], slips_of[i % N_SLIPS]};
    all = truth_and(all, is_linear(b->law, slips));
  }
  behaviour_decide(b, outcome_of_truth(all), says[all]);
  return true;
}

/* --- The closed forms --- */

/* K, K_1, K_2 and d_01, d_02 as the paper has them. */
enum { FORM_K, FORM_K1, FORM_K2, FORM_D1, FORM_D2, N_FORMS };
struct forms {
  struct expression x[N_FORMS];
};

static bool forms_open(struct forms *p, struct behaviour *b) {
  static const char *const name[N_FORMS] = {"K", "K_1", "K_2", "d_01", "d_02"};
  bool ok = true;
  for (int i = 0; ok && i < N_FORMS; i++)
    ok = expression_open(&p->x[i], b->view, name[i], "prediction", b->j->d) && p->x[i].n == (i < FORM_D1 ? 4 : 1);
  return ok || (!b->j->d->set && claim_error(b->j, b->c, "check", "K, K_1, K_2, d_01 or d_02 has another shape"));
}

static void forms_clear(struct forms *p) {
  for (int i = 0; i < N_FORMS; i++) expression_clear(&p->x[i]);
}

/* Gives the state the equilibrium of (3), with eps_i u_si in the place of u_si. */
static bool shift_state(const struct forms *p, struct law_state *s, const int eps[2]) {
  const val kept[2] = {s->slide[0], s->slide[1]};
  for (int i = 0; i < 2; i++)
    if (eps[i] < 0) s->slide[i] = calc_neg(&s->c, kept[i]);
  val d[2] = {law_value(s, &p->x[FORM_D1].tape, NULL), law_value(s, &p->x[FORM_D2].tape, NULL)};
  for (int i = 0; i < 2; i++) {
    s->slide[i] = kept[i];
    if (d[i]) s->shift[i] = d[i];
  }
  return d[0] && d[1];
}

static const int plain[2] = {1, 1}; /* d_01 and d_02 as printed */

/* How much the acceleration of a mass by (1) and (2) exceeds that of z'' + K z = 0 with the phase's stiffness
   matrix. */
static val excess(const struct forms *p, struct law_state *s, const int slips[2], int mass) {
  struct calc *c = &s->c;
  struct num_vec k;
  val sum = s->a[mass];
  if (!slips[0] && !slips[1]) return sum;
  const struct expression *matrix = &p->x[slips[0] && slips[1] ? FORM_K : slips[0] ? FORM_K1 : FORM_K2];
  if (!law_values(&k, s, &matrix->tape, NULL)) return NULL;
  for (int i = 0; i < 2; i++)
    sum = calc_add(c, sum, calc_mul(c, num_vec_at(&k, 2 * mass + i), calc_sub(c, s->x[i], s->shift[i])));
  return sum;
}

/* Do (3), (5), (7) and (9) describe a pair of modes?  FALSE: not every motion in it.  signs: with eps_i u_si in d_0. */
static truth form_holds(const struct friction *f, const struct forms *p, const int slips[2], bool signs) {
  OWNED(law_state) s;
  truth all = TRUTH_TRUE;
  law_state_open(&s, num_ctx_exact());
  bool ok = friction_mode(f, &s, slips) && shift_state(p, &s, signs ? slips : plain);
  for (int i = 0; i < 2; i++) all = truth_and(all, ok ? law_vanishes(&s, excess(p, &s, slips, i)) : TRUTH_UNKNOWN);
  return all;
}

/* Is the excess of a mass that alone is faster than the belt, the other being slower, -2 u_s1 or -2 eta u_s2? */
static bool falls_short_by_twice(const struct friction *f, const struct forms *p, int mass) {
  int slips[2] = {1, 1};
  OWNED(law_state) s;
  law_state_open(&s, num_ctx_exact());
  slips[mass] = -1;
  val z = friction_mode(f, &s, slips) && shift_state(p, &s, plain) ? excess(p, &s, slips, mass) : NULL;
  val twice = calc_mul(&s.c, calc_d(&s.c, 2), mass ? calc_mul(&s.c, s.eta, s.slide[1]) : s.slide[0]);
  return z && law_sign(&s, calc_add(&s.c, z, twice)) == 0;
}

/* Which of the nine pairs the paper's forms describe. */
struct described {
  long inside[2], beyond[2]; /* by truth: no mass faster than the belt; some mass */
  bool open, with_signs;
};

static struct described describe_pairs(const struct friction *f, const struct forms *p) {
  struct described n = {.with_signs = true};
  for (int i = 0; i < N_PAIRS; i++) {
    const int slips[2] = {slips_of[i / N_SLIPS], slips_of[i % N_SLIPS]};
    truth holds = form_holds(f, p, slips, false);
    if (holds == TRUTH_UNKNOWN)
      n.open = true;
    else
      (slips[0] < 0 || slips[1] < 0 ? n.beyond : n.inside)[holds == TRUTH_TRUE]++;
    n.with_signs = n.with_signs && form_holds(f, p, slips, true) == TRUTH_TRUE;
  }
  return n;
}

static void conclude_forms(struct behaviour *b, const struct described *n, bool twice) {
  if (n->open || n->beyond[1]) {
    bool all = !n->open && !n->inside[0] && !n->beyond[0];
    behaviour_decide(b, all ? ROUTE_AGREES : ROUTE_UNDECIDED,
                     all ? "exact in each of the nine configurations"
                         : "where the closed forms hold is not decided in every configuration");
    return;
  }
  behaviour_decide(
      b, ROUTE_DIFFERS,
      result_str(
          b->j->out,
          "z'' + K z = 0, with K, K_1 or K_2, z = x - d_0 and d_01, d_02 of (3), is exactly what (1) and (2) give in "
          "%s of the four configurations in which no mass is faster than the belt, and in none of the other five%s",
          n->inside[0] ? result_str(b->j->out, "%ld", n->inside[1]) : "each",
          twice ? ": a faster mass has the friction -u_si, and x''_1 is smaller by 2 u_s1, or x''_2 by 2 eta u_s2, "
                  "than (3) says, in every state"
                : ""));
  if (n->inside[0]) return;
  struct route_result under = {"exact", ROUTE_AGREES, true, 1};
  b->f->verdict = verdict_under_condition(b->f->verdict, verdict_of(&under, 1, true));
  b->f->condition = "no mass is faster than the belt";
  if (!n->with_signs) return;
  b->f->correction = "with -u_si in the place of u_si in d_01 and d_02 of (3) for a mass that is faster than the belt";
  b->f->correction_verdict = verdict_of(&under, 1, true);
}

bool behaviour_closed_forms(struct behaviour *b) {
  OWNED(forms) p = {.x = {{.n = 0}}};
  bool ok = forms_open(&p, b);
  if (ok) {
    struct described n = describe_pairs(b->law, &p);
    conclude_forms(b, &n, falls_short_by_twice(b->law, &p, 0) && falls_short_by_twice(b->law, &p, 1));
  }
  return ok;
}

/* --- Dimension --- */

/* The rank of the derivatives of the equations of a phase by the four coordinates, exact; -1: not decided. */
static int rank_of_equations(const struct conditions *list, enum phase ph) {
  OWNED(law_state) s;
  SIZED(fmpq_mat, m, MAX_CONDITIONS, N_STATE);
  law_state_open(&s, num_ctx_exact());
  struct calc *c = &s.c;
  val *const coordinate[N_STATE] = {&s.x[0], &s.x[1], &s.v[0], &s.v[1]};
  bool ok = true;
  for (int n = 0; ok && n < list->n; n++) {
    if (!list->at[n].equality || list->at[n].phase != ph) continue;
    val here = law_value(&s, &list->at[n].s.tape, NULL);
    for (int k = 0; ok && k < N_STATE; k++) {
      val kept = *coordinate[k];
      *coordinate[k] = calc_add(c, kept, calc_d(c, 1));
      val there = law_value(&s, &list->at[n].s.tape, NULL);
      *coordinate[k] = kept;
      ok = here && there && law_rational(fmpq_mat_entry(m, n, k), &s, calc_sub(c, there, here));
    }
  }
  return ok ? (int)fmpq_mat_rref(m, m) : -1;
}

static bool names_all_phases(const struct conditions *list, struct behaviour *b) {
  bool named[N_PHASES] = {false}, all = true;
  for (int n = 0; n < list->n; n++)
    if (list->at[n].phase < N_PHASES) named[list->at[n].phase] = true;
  for (int ph = 0; ph < N_PHASES; ph++) all = all && named[ph];
  return all || claim_error(b->j, b->c, "states", "the conditions of all four phases are needed");
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
  long claimed[2] = {0, 0}, least = N_STATE, most = 0;
  OWNED(conditions) states = {.n = 0};
  bool ok = claimed_range(claimed, b) && conditions_read(&states, b->j, b->c, "states", b->view) &&
            names_all_phases(&states, b);
  if (ok) {
    bool open = false;
    struct text note = {0};
    text_add(&note, "the number of coordinates x_1, x_2, x'_1, x'_2 less the rank of the equations among the "
                    "conditions of the phase, whose inequalities are strict and do not reduce it:");
    for (int ph = 0; ph < N_PHASES; ph++) {
      int rank = rank_of_equations(&states, (enum phase)ph);
      open = open || rank < 0;
      const char *many = rank < 0 ? "an undecided number" : result_str(b->j->out, "%d", N_STATE - rank);
      text_printf(&note, "%s %s in the %s phase", ph ? "," : "", many, phase_words[ph]);
      least = N_STATE - rank < least ? N_STATE - rank : least;
      most = N_STATE - rank > most ? N_STATE - rank : most;
    }
    for (int k = 0; k < states.n; k++) open = open || (!states.at[k].equality && !states.at[k].strict);
    bool same = least == claimed[0] && most == claimed[1];
    behaviour_decide(b, open ? ROUTE_UNDECIDED : same ? ROUTE_AGREES : ROUTE_DIFFERS, result_take(b->j->out, &note));
  }
  return ok;
}

/* --- A patched solution is a motion --- */

/* Is there an inequality of the phase that says the same as this margin? */
static bool is_stated(const struct conditions *states, enum phase ph, struct law_state *s, val margin) {
  bool stated = false;
  for (int k = 0; k < states->n && !stated; k++) {
    const struct condition *c = &states->at[k];
    if (c->equality || !c->strict || c->phase != ph) continue;
    val said = law_value(s, &c->s.tape, NULL);
    stated = said && margin && law_sign(s, calc_sub(&s->c, said, margin)) == 0;
  }
  return stated;
}

/* Do the conditions of the phase put the mass into the branch of (2) to which its part in the phase belongs: slower
   than the belt, or sticking with the inequalities of the sticking branch? */
static bool in_branch(const struct friction *f, const struct conditions *states, enum phase ph, struct law_state *s,
                      int mass, int slips) {
  if (slips) return is_stated(states, ph, s, calc_sub(&s->c, s->belt, s->v[mass]));
  bool all = true;
  for (int k = 0; k < f->law[mass].branch[STICKS].n; k++) {
    const struct condition *c = &f->law[mass].branch[STICKS].at[k];
    all = all && (c->equality || is_stated(states, ph, s, law_value(s, &c->s.tape, &f->law[mass])));
  }
  return all;
}

static bool phase_obeys_law(const struct friction *f, const struct forms *p, const struct conditions *states,
                            enum phase ph) {
  OWNED(law_state) s;
  law_state_open(&s, num_ctx_exact());
  bool ok = shift_state(p, &s, plain);
  for (int i = 0; i < 2; i++) ok = ok && in_branch(f, states, ph, &s, i, phase_slips[ph][i]);
  return ok && form_holds(f, p, phase_slips[ph], false) == TRUTH_TRUE;
}

struct route_result phases_prove_motion(struct behaviour *b) {
  OWNED(conditions) states = {.n = 0};
  OWNED(forms) p = {.x = {{.n = 0}}};
  struct route_result w = {.outcome = ROUTE_UNDECIDED};
  if (conditions_read(&states, b->j, b->c, "states", b->view) && forms_open(&p, b)) {
    bool all = events_decided(b->law);
    for (int ph = 0; ph < N_PHASES; ph++) all = all && phase_obeys_law(b->law, &p, &states, (enum phase)ph);
    w = behaviour_proof(
        b, all ? ROUTE_AGREES : ROUTE_UNDECIDED,
        all ? "in each of the four phases: with z = x - d_0 and e_i = u_ri - u_si the conditions of the phase "
              "are those under which (2) has one branch for either mass, and z'' + K z = 0 with the phase's matrix is "
              "what (1) gives with its friction. At t_a and t_a + t_b the force rises through its limit (at the rates "
              "V (1 - chi) and chi (V - z'_1)), so that the mass cannot keep sticking; at t_a + t_b + t_c and at the "
              "end a "
              "mass reaches the belt's velocity inside the limits, and sticks. So the solution of (12), (14), (16) and "
              "(18) that breaks no condition is the motion from Z_0 under Coulomb's law, and by (18) the map takes Z_0 "
              "to Z_0"
            : "the conditions of the phases are not known to be those of (2)");
  }
  return w;
}
