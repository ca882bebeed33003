/* Proofs by exact algebra: both sides of a sentence as elements of one field, the paper's from its formulas, the
   model's from exact_motion.h.  An entry is proved when the difference of its sides is zero; more of what holds on
   motions is used only as far as needed.  What remains is said in words: why a sentence is not proved. */
#include "exact_proof.h"

#include "claim/kinds.h"
#include "exact_law.h"
#include "num/num_exact.h"
#include "record/finding.h"
#include "value/local_maps.h"
#include <stdlib.h>
#include <string.h>

enum { MAX_ENTRIES = 64 };

/* The sentence at one kind of point, and what has been found about its entries. */
struct job {
  struct judge *j;
  const char *value; /* what the sentence's oracle is called */
  struct point_spec spec;
  bool sharp, has_tangents;
  struct sentence *s;
  bool done[MAX_ENTRIES];  /* proved */
  bool apart[MAX_ENTRIES]; /* the difference is an element other than zero, by the last attempt that could tell */
  bool equal[MAX_ENTRIES]; /* proved, since the difference is zero */
  struct exact_attempt by[MAX_ENTRIES];
  slong largest;
  char unbound[64];
  bool wants_modes, undefined, uses_matrices, independent, beyond;
  bool by_law; /* (2) was made use of */
  bool level;  /* of a < or > both sides are equal */
  struct text field, witness;
  const struct restriction *holds_at; /* of restrictions[], where all differences vanish */
};

/* --- One attempt --- */

/* Both sides of entry i, as far as they could be computed. */
struct sides {
  struct num_vec paper, model;
  int *status, model_status;
};

static void sides_make(struct sides *v, struct job *b, struct exact_motion *m) {
  struct sentence *s = b->s;
  v->status = ss_malloc((size_t)(s->tape.n_outputs + 1) * sizeof *v->status);
  v->model = calc_vec(&m->c, s->n);
  v->model_status = s->oracle ? exact_motion_oracle(&v->model, m, b->value) : SS_OK;
  FREED bool *wanted = ss_malloc((size_t)(s->tape.n_outputs + 1) * sizeof *wanted);
  for (slong i = 0; i < s->tape.n_outputs; i++) wanted[i] = !b->done[i % s->n];
  exact_eval_each(&v->paper, v->status, &m->c, m->field, &s->tape, wanted);
}

/* left - right of an entry; SS_OK when that is known. */
static int difference(fmpz_mpoly_q_struct *d, struct job *b, struct exact_motion *m, struct sides *v, slong i) {
  int s = v->status[i] | (b->s->oracle ? v->model_status : v->status[b->s->n + i]);
  if (s != SS_OK) return s;
  const fmpz_mpoly_q_struct *right = b->s->oracle ? num_vec_at(&v->model, i) : num_vec_at(&v->paper, b->s->n + i);
  return exact_sub(d, m->field, num_vec_at(&v->paper, i), right) ? SS_OK : SS_UNABLE;
}

/* Does the step hold, an inequality, strict or not, because the difference of its sides is positive by what is known to
   be? */
static bool step_holds(struct job *b, struct exact_motion *m, slong i, const fmpz_mpoly_q_struct *d) {
  enum relop op = b->s->ops[i];
  bool equal = exact_is_zero(d);
  if (op == REL_EQ || (equal && (op == REL_LE || op == REL_GE))) return equal;
  if (equal) b->level = true;
  if (equal) return false;
  OWNED(calc) c = exact_calc(m->field);
  const fmpz_mpoly_q_struct *margin = op == REL_LT || op == REL_LE ? calc_neg(&c, d) : d;
  if (m->bare) return exact_sign(m->field, margin, op == REL_LT || op == REL_GT) > 0;
  struct num_vec law = calc_vec(&c, EXACT_CONDITIONS);
  int n = exact_law_margins(&law, NULL, m);
  bool plain = exact_follows(m, margin, &law, 0), by_law = !plain && exact_follows(m, margin, &law, n);
  b->by_law = b->by_law || by_law;
  return plain || by_law;
}

static bool vanishes(const struct restriction *r, const struct exact_field *f, const fmpz_mpoly_q_struct *d) {
  NUMBERS(fmpq, value);
  return r->quantity <= Q_V && num_parse_decimal(value, r->value, strlen(r->value)) == SS_OK &&
         exact_vanishes_at(f, d, name_param[r->quantity - Q_CHI], value);
}

/* Books the difference of an entry that is not zero. */
static void book_difference(struct job *b, struct exact_motion *m, slong i, const fmpz_mpoly_q_struct *d, bool *keep) {
  b->apart[i] = true;
  for (int r = 0; r < n_restrictions; r++) keep[r] = keep[r] && vanishes(&restrictions[r], m->field, d);
  if (b->witness.len) return;
  const char *place = sentence_place(b->j->out, b->s, i);
  long terms = (long)fmpz_mpoly_length(&d->num, num_exact_ctx());
  text_printf(&b->witness, "%sthe difference of the sides has %ld term%s and is ", place, terms, terms == 1 ? "" : "s");
  if (!exact_witness(&b->witness, m->field, d)) text_add(&b->witness, "not zero");
}

/* "Q(V, e_1, e_2, w_1, w_2), where w_1 and w_2 are ..." */
static void print_field(struct text *out, const struct exact_motion *m) {
  text_reset(out);
  text_add(out, "Q(");
  exact_print_generators(out, m->field);
  text_add(out, ")");
  if (!m->bare && strstr(text_str(out), "tau")) text_add(out, ", where tau is the time since the phase began");
  if (m->attempt.modes)
    text_printf(out, "%s w_1 and w_2 are the frequencies of the global slip phase",
                strstr(text_str(out), "where") ? " and" : ", where");
}

static bool all_done(const struct job *b) {
  for (slong i = 0; i < b->s->n; i++)
    if (!b->done[i]) return false;
  return true;
}

/* Proves what it can of what is not proved yet, and keeps those restrictions at which all differences vanish; whether
   there are any. */
static bool try_entries(struct job *b, const struct exact_attempt *a, struct exact_motion *m, bool *keep) {
  struct sides v;
  bool apart = false;
  fmpz_mpoly_q_struct *d = calc_new(&m->c);
  sides_make(&v, b, m);
  for (slong i = 0; i < b->s->n; i++) {
    if (b->done[i]) continue;
    b->apart[i] = false;
    int s = difference(d, b, m, &v, i);
    if (s == SS_OK && step_holds(b, m, i, d)) {
      b->done[i] = true;
      b->equal[i] = exact_is_zero(d);
      b->by[i] = *a;
    } else if (s == SS_OK && b->s->ops[i] == REL_EQ) {
      book_difference(b, m, i, d, keep);
    }
    apart = apart || b->apart[i];
    b->undefined = b->undefined || (s & SS_DOMAIN);
  }
  free(v.status);
  return apart;
}

static void try_attempt(struct job *b, const struct exact_attempt *a) {
  enum { MAX_RESTRICTIONS = 8 };
  OWNED(exact_motion) m;
  bool keep[MAX_RESTRICTIONS];
  for (int r = 0; r < n_restrictions; r++) keep[r] = true;
  b->undefined = false;
  exact_motion_init(&m, a, &b->spec, &b->s->tape);
  exact_motion_given(&m, b->s);
  text_reset(&b->witness);
  bool apart = try_entries(b, a, &m, keep);
  if (m.bare && !all_done(b) && exact_field_parts(m.field)) apart = try_entries(b, a, &m, keep);
  b->holds_at = NULL;
  for (int r = n_restrictions; apart && r > 0; r--)
    if (keep[r - 1]) b->holds_at = &restrictions[r - 1];
  if (exact_largest(m.field) > b->largest) b->largest = exact_largest(m.field);
  print_field(&b->field, &m);
  b->wants_modes = m.wants_modes;
  b->independent = exact_independent(m.field) && !m.beyond;
  b->beyond = b->beyond || m.beyond;
  b->uses_matrices = b->uses_matrices || m.used_matrix;
  memcpy(b->unbound, m.unbound, sizeof b->unbound);
}

static bool has_tangents(const struct tape *t) {
  bool any = false;
  for (slong i = 0; i < t->n_inputs; i++) any = any || name_of_tangent(t->inputs[i]) >= 0;
  return any;
}

static bool has_op(const struct tape *t, enum tape_op op) {
  for (slong i = 0; i < t->n; i++)
    if (t->code[i].op == op) return true;
  return false;
}

/* Are inequalities all that is not proved? */
static bool inequalities_left(const struct job *b) {
  for (slong i = 0; i < b->s->n; i++)
    if (!b->done[i] && b->s->ops[i] == REL_EQ) return false;
  return true;
}

/* Once with the frequencies of phase H more when they are asked for; of signs (2) alone tells there. */
static void try_with_modes(struct job *b, struct exact_attempt *a) {
  try_attempt(b, a);
  if (!b->wants_modes || a->modes || (inequalities_left(b) && !b->spec.admissible)) return;
  a->modes = true;
  try_attempt(b, a);
}

/* How the states follow from each other, in the order of the attempts. */
static int anchors(int list[6], const struct job *b) {
  list[0] = b->value && b->value[0] == 'S' ? 0 : 4; /* the paper patches its states from the start */
  if (!point_has_word(b->spec.kind) || list[0] == 0) return 1;
  bool orbit = b->spec.kind == POINT_ORBIT, last = orbit && tape_reads_matrix(&b->s->tape, "S_c");
  for (int n = 1; n < 6; n++) list[n] = last ? ANCHOR_BACK : 4 - n;
  return last ? 2 : orbit ? 6 : 5;
}

/* From little to all of what holds on motions. */
static void try_all(struct job *b) {
  bool word = point_has_word(b->spec.kind);
  struct exact_attempt a = {.modes = b->j->model->system && has_op(&b->s->tape, TAPE_ROOT)};
  int anchor[6], n = anchors(anchor, b);
  for (int i = 0; i < n; i++)
    for (int k = 0; k < (word ? N_EXACT_TANGENTS : 1); k++)
      for (int time = b->sharp ? TIME_START : TIME_INSIDE; time <= (b->sharp ? TIME_END : TIME_INSIDE); time++) {
        a.anchor = anchor[i];
        a.tangents = (enum exact_tangents)k;
        a.time = (enum exact_time)time;
        bool useless = (b->spec.finite && k == TANGENTS_LOCATED) || (k > 0 && !b->has_tangents);
        if (!useless && !all_done(b)) try_with_modes(b, &a);
      }
}

/* --- One claim --- */

/* The matrix of the period or the states in which phases meet, where the claim names them; the local Jacobians, of
   which J is made: fewer than EXACT_UNKNOWNS. */
static int choose_unknowns(struct override o[EXACT_UNKNOWNS], const char *list, const char *value) {
  int n = 0;
  if (list && strcmp(list, "N") == 0) n += oracle_override(&o[n], "N");
  for (int i = 0; list && i < N_PHASES - 1; i++)
    if (strstr(list, name_meeting[i])) n += oracle_override(&o[n], name_meeting[i]);
  bool about = value ? strcmp(value, "J") == 0 : list && list[0] == 'J';
  for (int ph = 0; about && ph < N_PHASES; ph++) n += oracle_override(&o[n], local_maps[ph].name);
  return n;
}

/* Is a kind of point among others of which it is a special case? */
static bool covered(const struct point_spec *spec, int n, int i) {
  for (int k = 0; k < n; k++)
    if (k != i && spec[i].kind == POINT_ORBIT && spec[k].kind == POINT_ARC && spec[k].phase == spec[i].phase)
      return true;
  return false;
}

static const char *why_open(struct job *b) {
  struct audit_result *out = b->j->out;
  slong open = 0, apart = 0, inequalities = 0;
  for (slong i = 0; i < b->s->n; i++) {
    open += !b->done[i];
    inequalities += !b->done[i] && b->s->ops[i] != REL_EQ;
    apart += b->apart[i];
  }
  if (inequalities)
    return b->j->model->system ? "an inequality, which exact algebra does not decide unless it follows from what (2) "
                                 "asks and from positive factors"
                               : "an inequality, which exact algebra does not decide";
  if (b->sharp) return "the sides of some step are not shown equal at either end of the phase";
  if (*b->unbound) return result_str(out, "the model has no exact value of %s there", b->unbound);
  if (apart == open)
    return result_str(out, "%s differ in the field %s: more than exact algebra knows of these %s would be needed",
                      b->s->n > 1 ? result_str(out, "%ld of %ld entries", (long)apart, (long)b->s->n) : "the sides",
                      text_str(&b->field), b->j->model->system ? "motions" : "functions");
  if (b->undefined) return "a divisor is zero for all parameters";
  return result_str(out, "an expression outgrew the budget of exact algebra (%ld terms)", (long)b->largest);
}

/* Is what is free in an attempt really free, so that a difference refutes?  The parameters, the time and the start of a
   motion are; of motions over the whole word not everything is used. */
static bool is_complete(const struct job *b) {
  return (b->spec.kind == POINT_PARAMS || b->spec.kind == POINT_FLOW) && b->independent;
}

/* The last part of the proof. */
static void record_part(struct exact_proof *p, struct job *b, const struct exact_question *q, const struct override *o,
                        int n) {
  if (p->n_parts == EXACT_PARTS) abort();
  struct exact_attempt *by = arena_alloc(&b->j->out->arena, (size_t)b->s->n * sizeof *by);
  bool *equal = arena_alloc(&b->j->out->arena, (size_t)b->s->n * sizeof *equal);
  memcpy(by, b->by, (size_t)b->s->n * sizeof *by);
  memcpy(equal, b->equal, (size_t)b->s->n * sizeof *equal);
  struct exact_part *part = &p->part[p->n_parts++];
  *part = (struct exact_part){.question = q, .n_unknowns = n, .spec = b->spec, .n = b->s->n, .equal = equal, .by = by};
  if (n) memcpy(part->unknown, o, (size_t)n * sizeof *o);
}

static void prove_spec(struct exact_proof *p, struct job *b) {
  try_all(b);
  if (b->largest > p->largest) p->largest = b->largest;
  p->uses_matrices = p->uses_matrices || b->uses_matrices;
  p->by_law = p->by_law || b->by_law;
  p->beyond = p->beyond || b->beyond || has_op(&b->s->tape, TAPE_exp);
  if (all_done(b)) {
    p->field = result_copy(b->j->out, text_str(&b->field));
  } else {
    p->proved = false;
    p->why_not = why_open(b);
    p->holds_at = b->holds_at;
    p->level = p->level || b->level;
    if (b->level) p->differs = "the sides of a strict inequality are equal wherever it is stated";
    if (is_complete(b) && b->witness.len) p->differs = result_copy(b->j->out, text_str(&b->witness));
  }
  text_clear(&b->witness);
  text_clear(&b->field);
}

bool exact_sentence(struct sentence *s, const struct exact_question *q, struct view view, const struct override *o,
                    int n, struct diag *d) {
  if (q->c) return sentence_from_claim(s, view, q->c, o, n, d);
  return sentence_from_value(s, view, q->value, q->section, o, n, d);
}

/* With n matrices held as unknowns; adds to the proof, which stays one. */
static void prove_with(struct exact_proof *p, struct judge *j, const struct exact_question *q, struct view view,
                       const struct override *o, int n) {
  OWNED(sentence) s;
  struct diag d = {0};
  if (!exact_sentence(&s, q, view, o, n, &d) || s.n > MAX_ENTRIES)
    *p = (struct exact_proof){.why_not = "the sentence cannot be read"};
  for (int i = 0; p->proved && i < q->n_specs; i++) {
    if (covered(q->spec, q->n_specs, i)) continue;
    struct job b = {.j = j,
                    .value = q->value,
                    .spec = q->spec[i],
                    .sharp = q->sharp,
                    .has_tangents = has_tangents(&s.tape) || q->spec[i].finite,
                    .s = &s};
    prove_spec(p, &b);
    if (p->proved) record_part(p, &b, q, o, n);
    for (slong k = 0; k < s.n; k++) p->by_factors = p->by_factors || s.ops[k] != REL_EQ;
  }
}

static struct exact_question *keep_question(struct judge *j, const struct exact_question *q) {
  struct exact_question *kept = arena_alloc(&j->out->arena, sizeof *kept);
  *kept = *q;
  return kept;
}

/* What a matrix held as unknowns is known to do is known of the model's: so the paper's must be the model's. */
static void are_the_models(struct exact_proof *p, struct judge *j, const struct exact_question *q, struct view view,
                           const struct override *o, int n) {
  const char *field = p->field;
  for (int i = 0; p->proved && i < n; i++) {
    struct exact_question *lemma = keep_question(j, q);
    lemma->c = NULL;
    lemma->value = o[i].name;
    prove_with(p, j, lemma, view, NULL, 0);
    if (!p->proved) p->why_not = result_str(j->out, "%s in it is not the model's", o[i].name);
  }
  p->field = field;
}

static const char *describe(struct judge *j, const struct exact_proof *p, const struct exact_question *q,
                            int unknowns) {
  return result_str(
      j->out, "%s%s%s in the field %s; the largest polynomial has %ld term%s",
      p->by_factors && !j->model->system
          ? "as functions of the paper's own symbols the sides of equations are equal, and those of inequalities "
            "differ by factors or terms whose signs follow from the domains and conditions,"
      : p->by_factors
          ? "on motions computed from the first-order systems the sides of equations are equal, and those of "
            "inequalities differ by a product of powers of chi, eta, V, 1 - chi and the times to the ends of the phase"
      : q->sharp ? "on motions computed from the first-order systems the sides of each inequality are equal at one end "
                   "of the phase"
      : !j->model->system ? "both sides, as functions of the paper's own symbols, are equal"
      : q->value          ? "the paper's matrix and the model's, computed from its first-order system, are equal"
                          : "both sides, on motions computed from the first-order systems, are equal",
      p->by_law ? ", by a positive multiple of what Coulomb's law (2) keeps positive in that phase, or by a sum or "
                  "product of these,"
                : "",
      unknowns ? ", with the matrices in them held as unknowns," : "", p->field, (long)p->largest,
      p->largest == 1 ? "" : "s");
}

/* oracle: the matrices that are held as unknowns, as a claim lists them. */
static struct exact_proof prove_question(struct judge *j, const struct exact_question *asked, const char *oracle,
                                         struct view view) {
  struct override o[EXACT_UNKNOWNS];
  const struct exact_question *q = keep_question(j, asked);
  int n = choose_unknowns(o, oracle, q->value);
  struct exact_proof p = {.proved = true};
  prove_with(&p, j, q, view, o, n);
  if (p.proved && p.uses_matrices) are_the_models(&p, j, q, view, o, n);
  if (p.proved) p.note = describe(j, &p, q, n);
  return p;
}

struct exact_proof exact_prove_jacobian(struct judge *j, struct view view) {
  const struct exact_question q = {
      .value = "J", .section = "stability", .spec = {{.kind = POINT_ORBIT, .n = 1}}, .n_specs = 1};
  return prove_question(j, &q, NULL, view);
}

struct exact_proof exact_prove(struct judge *j, const struct claim *c, struct view view, const struct restriction *r) {
  struct diag d = {0};
  struct judge quiet = *j;
  quiet.d = &d;
  struct exact_question asked = {
      .c = c, .value = claim_get(c, "value"), .section = claim_section(c), .sharp = claim_kind(c) == KIND_SHARP};
  asked.n_specs = claim_points(asked.spec, EXACT_SPECS, &quiet, c);
  if (asked.n_specs <= 0) return (struct exact_proof){.why_not = "the sentence cannot be read"};
  for (int i = 0; i < asked.n_specs; i++) asked.spec[i].restriction = r;
  return prove_question(j, &asked, claim_get(c, "oracle"), view);
}

void finding_add_proof(struct finding *f, struct audit_result *out, const struct exact_proof *p, const char *layer,
                       bool refuted) {
  const char *where =
      p->holds_at ? result_str(out, "every difference has a factor that is zero where %s", p->holds_at->text) : NULL;
  if (p->proved || p->differs) {
    struct evidence *e = finding_add(f, out);
    e->route = "exact";
    e->layer = layer;
    e->result = p->proved ? "proved" : "differs";
    e->note = p->proved ? p->note : where ? result_str(out, "%s; %s", p->differs, where) : p->differs;
  } else if (refuted && where) {
    finding_state(f, out, "exact", layer, -1, -1, NULL, where);
  } else if (!refuted && p->why_not) {
    finding_state(f, out, "exact", layer, -1, -1, NULL, result_str(out, "not proved: %s", p->why_not));
  }
}

void finding_why_not(struct finding *f, struct audit_result *out, const struct claim *c) {
  static const struct {
    enum kind kind;
    const char *why;
  } reasons[] = {
      {KIND_BEHAVIOUR, "a sentence about motions, which exact algebra does not reach"},
      {KIND_SEQUENCE, "an event is not proved to be the first of its phase, or a condition not throughout it"},
      {KIND_ARGUMENT, "no counterexample was found, and no combination of the premises that proves it"},
      {KIND_CONSTRAINTS, "the list is not shown to be what (2) asks, by exact algebra"},
      {KIND_SOLUTIONS, "solutions are listed in balls"}};
  enum kind kind = claim_kind(c);
  for (int i = 0; i < f->n_evidence; i++)
    if (strcmp(f->evidence[i].route, "exact") == 0) return;
  for (size_t i = 0; i < sizeof reasons / sizeof *reasons; i++)
    if (reasons[i].kind == kind)
      finding_state(f, out, "exact", layer_name[LAYER_CORRECTED], -1, -1, NULL,
                    result_str(out, "not proved: %s", reasons[i].why));
}
