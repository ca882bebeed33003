/* What holds on every motion, as tapes, and the definitions that can be held as matrices of unknowns. */
#include <stdlib.h>
#include <string.h>

#include "claim/claim.h"
#include "facts.h"
#include "value/expression.h"
#include "value/sentence.h"

/* (9)-(18) as definitions of the states at the switching times, (21)-(41) as definitions of their perturbations. */
const char *const motion_facts[][2] = {
    {"z'_10", "V"},
    {"z'_20", "V"},
    {"z'_1a", "V"},
    {"z'_2a", "V"},
    {"z'_2b", "V"},
    {"z'_1c", "V"},
    {"z_1a", "e_1 + chi*z_2a"},
    {"z_10", "e_1 + chi*z_2a - V*t_a"},
    {"z_20", "z_2a - V*t_a"},
    {"z_100", "e_1 + chi*z_2a - V*t_a"},
    {"z_200", "z_2a - V*t_a"},
    {"z_2b", "z_1b + e_2/chi"},
    {"u_r1", "u_s1 + e_1"},
    {"u_r2", "u_s2 + e_2"},
    {"u", "0"},
    {"v", "0"},
    {"u_a", "0"},
    {"v_a", "0"},
    {"v_b", "0"},
    {"u_c", "0"},
    {"u_f", "0"},
    {"v_f", "0"},
    {"x_a", "chi*y_a"},
    {"x", "chi*y_a - V*dt_a"},
    {"y", "y_a - V*dt_a"},
    {"x_b", "y_b"},
    {"z_1(t_a)", "z_1a"},
    {"z_2(t_a)", "z_2a"},
    {"z_1'(t_a)", "V"},
    {"z_2'(t_a)", "V"},
    {"z_1(t_a + t_b)", "z_1b"},
    {"z_2(t_a + t_b)", "z_2b"},
    {"z_1'(t_a + t_b)", "z'_1b"},
    {"z_2'(t_a + t_b)", "V"},
    {"z_1(t_a + t_b + t_c)", "z_1c"},
    {"z_2(t_a + t_b + t_c)", "z_2c"},
    {"z_1'(t_a + t_b + t_c)", "V"},
    {"z_2'(t_a + t_b + t_c)", "z'_2c"},
    {"z_1'(t_a + t_b + t_c + t_d)", "V"},
    {"z_2'(t_a + t_b + t_c + t_d)", "V"},
    {"z_1'(t_a + dt_a)", "V"},
    {"z_2'(t_a + dt_a)", "V"},
    {"z_2'(t_a + dt_a + t_b + dt_b)", "V"},
    {"z_1'(t_a + dt_a + t_b + dt_b + t_c + dt_c)", "V"},
    {"x_1'(t_a + dt_a + t_b + dt_b + t_c + dt_c)", "V"},
    {"z_1'(t_a + dt_a + t_b + dt_b + t_c + dt_c + t_d + dt_d)", "V"},
    {"z_2'(t_a + dt_a + t_b + dt_b + t_c + dt_c + t_d + dt_d)", "V"},
    {"x_1'(t_a + dt_a + t_b + dt_b + t_c + dt_c + t_d + dt_d)", "V"},
    {"x_2'(t_a + dt_a + t_b + dt_b + t_c + dt_c + t_d + dt_d)", "V"},
};
const int n_motion_facts = sizeof motion_facts / sizeof *motion_facts;
/* At the time t, which lies in one phase for a claim: behind the others, and taken by phase. */
static const struct {
  const char *name;
  bool rate; /* zero, not V */
  int mass;  /* that sticks where it holds */
} phase_facts[] = {{"z_1'(t)", false, 0}, {"z_2'(t)", false, 1}, {"z_1''(t)", true, 0}, {"z_2''(t)", true, 1}};
enum {
  N_MOTION_FACTS = sizeof motion_facts / sizeof *motion_facts,
  N_PHASE_FACTS = sizeof phase_facts / sizeof *phase_facts
};
_Static_assert((int)N_MOTION_FACTS + (int)N_PHASE_FACTS <= (int)MOST_FACTS, "room for all of them");

static bool tape_of(struct tape *t, const struct model *m, const char *expression) {
  return formula_tape(t, (struct view){m, LAYER_CORRECTED, NULL, NULL}, expression, "", NULL, 0);
}

/* --- Matrices held as unknowns --- */

static bool is_literal(const struct expr *e, const void *arg) {
  (void)arg;
  return e->kind == EXPR_MATRIX;
}

/* Is it the only definition of its name that the corrected view sees, written as a matrix, and no function? */
static bool is_written_matrix(const struct model *m, size_t def) {
  const struct definition *x = &m->defs[def];
  struct view v = {m, LAYER_CORRECTED, NULL, NULL};
  if (x->rank == RANK_CONTROL || x->stmt->kind != STMT_DEFINE || x->stmt->param ||
      !expr_any(x->stmt->sides[0], is_literal, NULL))
    return false;
  for (size_t i = 0; i < m->n_defs; i++)
    if (i != def && strcmp(m->defs[i].name, x->name) == 0 && view_sees(&v, &m->defs[i])) return false;
  return true;
}

static void add_opaque(struct facts *f, const struct model *m, size_t def) {
  struct opaque o;
  const struct model recording = model_noting(&o.use, m);
  OWNED(elaboration) el;
  struct matrix x;
  struct diag d = {0};
  elaboration_init(&el, (struct view){&recording, LAYER_CORRECTED, NULL, NULL}, NULL, 0);
  if (elaborate_text(&x, &el, m->defs[def].name, m->defs[def].name, m->defs[def].section, &d) && x.rows * x.cols > 1) {
    o.name = (struct override){m->defs[def].name, x.rows, x.cols};
    *SS_PUSH(f->opaque, f->n_opaque, f->cap_opaque) = o;
  } else {
    model_use_clear(&o.use);
  }
}

int facts_unknowns(struct override out[MOST_UNKNOWNS], const struct facts *f, const struct target *t) {
  int n = 0;
  for (size_t i = 0; !t->corrected && n < MOST_UNKNOWNS && i < f->n_opaque; i++)
    if (t->def < 0 || !f->opaque[i].use.def[t->def]) out[n++] = f->opaque[i].name;
  return n;
}

struct facts *facts_new(const struct model *m) {
  struct facts *f = ss_malloc(sizeof *f);
  *f = (struct facts){.n = 0};
  for (size_t i = 0; i < m->n_defs; i++)
    if (is_written_matrix(m, i)) add_opaque(f, m, i);
  /* A model without the belt's velocity has no use for any of them; one without a fact's symbols none for that fact. */
  bool usable = tape_of(&f->velocity, m, "V") && tape_of(&f->zero, m, "0");
  for (int i = 0; i < 2; i++) usable = usable && tape_of(&f->sign[i], m, i ? "1" : "-1");
  for (int i = 0; usable && i < N_MOTION_FACTS; i++) {
    struct exact_fact *x = &f->fact[f->n];
    x->name = motion_facts[i][0];
    if (tape_of(&x->tape, m, motion_facts[i][1]))
      f->n++;
    else
      tape_clear(&x->tape);
  }
  return f;
}

void facts_use(struct facts *f, bool use) {
  f->unused = !use;
}

void facts_free(struct facts *f) {
  for (int i = 0; i < f->n; i++) tape_clear(&f->fact[i].tape);
  tape_clear(&f->velocity);
  tape_clear(&f->zero);
  for (int i = 0; i < 2; i++) tape_clear(&f->sign[i]);
  for (size_t i = 0; i < f->n_opaque; i++) model_use_clear(&f->opaque[i].use);
  free(f->opaque);
  free(f);
}

/* The phase in which the time t of a claim about arcs lies; -1 when there are several, or the motion is no arc. */
static int phase_of(const struct claim *c) {
  enum { MAX = 4 };
  struct point_spec spec[MAX];
  struct diag d = {0};
  struct judge j = {.d = &d};
  int n = claim_points(spec, MAX, &j, c), phase = -1;
  for (int i = 0; i < n; i++) {
    bool arc = point_has_word(spec[i].kind);
    if (!arc || (i > 0 && (int)spec[i].phase != phase)) return -1;
    phase = (int)spec[i].phase;
  }
  return phase;
}

static bool on_motions(const struct claim *c) {
  const char *points = claim_points_asked(c);
  return points && !strstr(points, "params") && !strstr(points, "flow");
}

int facts_collect(struct exact_fact *out, const struct facts *f, const struct claim *c) {
  int n = 0, phase = c ? phase_of(c) : -1;
  if (f->unused) return 0;
  for (int i = 0; (!c || on_motions(c)) && i < f->n; i++) out[n++] = f->fact[i];
  for (int i = 0; phase >= 0 && i < N_PHASE_FACTS; i++)
    if (!phase_slips[phase][phase_facts[i].mass])
      out[n++] = (struct exact_fact){phase_facts[i].name, phase_facts[i].rate ? f->zero : f->velocity};
  return n;
}
