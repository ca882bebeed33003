/* stickslip explain ID --receipt: a proof as a program for another computer algebra system.  The sentence is printed
   from the tape of its parsed formulas, the model as the matrices of its first-order systems; what motions are is said
   again in verify/receipt/model.py, which ends such receipts. */
#include <stdlib.h>
#include <string.h>

#include "argument.h"
#include "claim/claim.h"
#include "num/calc.h"
#include "proof/exact_proof.h"
#include "proof/exact_rank.h"
#include "proof/generic_rank.h"
#include "proof/linearized.h"
#include "proof/nonzero.h"
#include "receipt.h"
#include "record/result.h"
#include "value/expression.h"
#include "value/local_maps.h"
#include "value/title.h"

/* --- The paper's side: each value when it is asked for --- */

static void add_instruction(struct text *out, const struct tape *t, slong i) {
  const struct tape_instr *in = &t->code[i];
  static const char *const infix[N_TAPE_OPS] = {[TAPE_add] = "+", [TAPE_sub] = "-", [TAPE_mul] = "*", [TAPE_div] = "/"};
  text_printf(out, "        %ld: lambda: ", (long)i);
  if (in->op == TAPE_CONST) {
    text_add(out, "f.number(\"");
    num_print_q(out, &t->consts[in->k]);
    text_add(out, "\")");
  } else if (in->op == TAPE_INPUT) {
    text_printf(out, "x(\"%s\")", t->inputs[in->k]);
  } else if (in->op == TAPE_POW) {
    text_printf(out, "v(%ld) ** %ld", (long)in->a, (long)in->k);
  } else if (in->op == TAPE_ROUNDED || in->op == TAPE_neg) {
    text_printf(out, in->op == TAPE_neg ? "-v(%ld)" : "v(%ld)", (long)in->a);
  } else if (infix[in->op]) {
    text_printf(out, "v(%ld) %s v(%ld)", (long)in->a, infix[in->op], (long)in->b);
  } else {
    text_printf(out, "f.%s(%s", tape_op_name[in->op], in->op != TAPE_ROOT ? "" : in->k < 0 ? "True, " : "False, ");
    for (slong k = 0; k < tape_operands(t, i); k++)
      text_printf(out, "%sv(%ld)", k ? ", " : "", (long)tape_operand(t, i, k));
    text_add(out, ")");
  }
  text_add(out, ",\n");
}

static void add_sides(struct text *out, const struct tape *t, const char *list, int part) {
  text_printf(out, "\n\ndef %s_%d(f, x, v):\n    return {\n", list, part);
  for (slong i = 0; i < t->n; i++) add_instruction(out, t, i);
  text_add(out, "    }\n");
}

/* --- The model's side --- */

static void add_system(struct text *out) {
  EXACT_FIELD f = exact_field_new(NULL, 0);
  OWNED(calc) c = calc_begin(num_ctx_exact());
  struct num_vec params = calc_vec(&c, N_PARAMS), a = calc_vec(&c, N_STATE * N_STATE);
  exact_symbol(num_vec_at(&params, P_CHI), f, "chi");
  exact_symbol(num_vec_at(&params, P_ETA), f, "eta");
  text_add(out, "SYSTEM = {  # A of Z' = A Z in each phase, Z = (z_1, z_2, z_1', z_2')\n");
  for (int ph = 0; ph < N_PHASES; ph++) {
    dyn_system(&a, (enum phase)ph, &params);
    text_printf(out, "    \"%s\": [", phase_name[ph]);
    for (int i = 0; i < N_STATE * N_STATE; i++) {
      text_add(out, i % N_STATE ? ", \"" : i ? ", [\"" : "[\"");
      exact_print(out, f, num_vec_at(&a, i));
      text_add(out, i % N_STATE == N_STATE - 1 ? "\"]" : "\"");
    }
    text_add(out, "],\n");
  }
  text_add(out, "}\n");
}

static bool same_attempt(const struct exact_attempt *a, const struct exact_attempt *b) {
  return a->modes == b->modes && a->anchor == b->anchor && a->tangents == b->tangents && a->time == b->time;
}

static void add_part(struct text *out, const struct exact_part *p, const struct sentence *s, const char *list, int i) {
  const struct tape *t = &s->tape;
  const struct restriction *r = p->spec.restriction;
  text_printf(out, "%s.append(dict(\n    values=%s_%d,\n    sides=[", list, list, i);
  for (slong k = 0; k < t->n_outputs; k++) text_printf(out, "%s%ld", k ? ", " : "", (long)t->outputs[k]);
  text_add(out, "],\n    relations=\"");
  for (slong k = 0; k < p->n; k++) /* what is proved: of an inequality that is not strict one of its two parts */
    text_add_char(out, p->equal[k] ? '=' : s->ops[k] == REL_LT || s->ops[k] == REL_LE ? '<' : '>');
  text_add(out, "\",\n    oracle=");
  text_printf(out, p->question->value ? "\"%s\"" : "None", p->question->value);
  text_printf(out, ",\n    kind=\"%s\",\n    phase=\"%s\",\n    finite=%s,\n    law=\"%s\",\n    fixed={",
              point_kind_word[p->spec.kind], phase_name[p->spec.phase], p->spec.finite ? "True" : "False",
              p->spec.realistic    ? "realistic"
              : p->spec.admissible ? "admissible"
                                   : "");
  if (r) text_printf(out, "\"%.*s\": %s", (int)strcspn(r->text, " "), r->text, r->value);
  text_add(out, "},\n    reads=[");
  for (slong k = 0; k < t->n_inputs; k++) text_printf(out, "%s\"%s\"", k ? ", " : "", t->inputs[k]);
  text_add(out, "],\n    # each entry's proof: with phase H's frequencies; states chained; perturbations shifted (1), "
                "located (2)\n"
                "    by=");
  for (slong k = 0, run = 1; k < p->n; k += run, run = 1) {
    while (k + run < p->n && same_attempt(&p->by[k], &p->by[k + run])) run++;
    text_printf(out, "%s[(%s, %d, %d, %d)] * %ld", k ? " + " : "", p->by[k].modes ? "True" : "False", p->by[k].anchor,
                (int)p->by[k].tangents, (int)p->by[k].time, (long)run);
  }
  text_add(out, ",\n))\n");
}

static void add_numbers(struct text *out, const slong *k, slong n) {
  for (slong i = 0; i < n; i++) text_printf(out, "%s%ld", i ? ", " : "", (long)k[i]);
}

/* The entries of the matrix of derivatives, and the rank that it is to have. */
static void add_matrix(struct text *out, const struct rank_system *y, int rank) {
  add_sides(out, &y->s.tape, "MATRICES", 0);
  text_add(out, "\n\nMATRICES.append(dict(\n    values=MATRICES_0,\n    rows=[\n");
  for (int i = 0; i < y->rows; i++) {
    text_add(out, "        [");
    add_numbers(out, y->s.tape.outputs + y->rows + i * y->cols, y->cols);
    text_add(out, "],\n");
  }
  text_printf(out, "    ],\n    rank=%d,\n))\n", rank);
}

/* The equations, of which the script takes the derivatives itself, and the rank that these are to have at almost all
   values. */
static void add_equations(struct text *out, const struct rank_system *y, int rank) {
  const struct tape t = rank_system_residuals(y);
  add_sides(out, &t, "GENERIC", 0);
  text_add(out, "\n\nGENERIC.append((GENERIC_0, [");
  add_numbers(out, t.outputs, y->rows);
  text_add(out, "], \"");
  for (int k = 0; k < y->cols; k++) text_printf(out, "%s%s", k ? " " : "", y->unknown[k]);
  text_printf(out, "\".split(), %d))  # the equations, their unknowns, the rank\n", rank);
}

/* To a list of the script: PARTS, which it proves, or PRINTED, of which it says by how much they are wrong. */
static bool add_parts(struct text *out, const struct exact_proof *p, struct view view, const char *list,
                      struct diag *d) {
  bool ok = true;
  for (int i = 0; ok && i < p->n_parts; i++) {
    OWNED(sentence) s;
    ok = exact_sentence(&s, p->part[i].question, view, p->part[i].unknown, p->part[i].n_unknowns, d);
    if (ok) add_sides(out, &s.tape, list, i);
    if (ok) text_add(out, "\n\n");
    if (ok) add_part(out, &p->part[i], &s, list, i);
  }
  return ok;
}

/* --- The script --- */

/* The claim, or the one that makes it under a restriction. */
static const struct claim *find(const struct claims *claims, const char *id, const struct restriction **r) {
  const struct claim *c = claim_answering(claims, id);
  struct made_claim made;
  *r = NULL;
  for (const char *p = c ? claim_get(c, "restricted") : NULL; (p = claim_next_made(&made, p)) != NULL;)
    for (int k = 0; strcmp(made.id, id) == 0 && k < n_restrictions; k++)
      if (strcmp(made.condition, restrictions[k].text) == 0) *r = &restrictions[k];
  return c;
}

static bool receipt_of_orbit(const struct claim *c) {
  enum kind kind = claim_kind(c);
  return kind == KIND_CLOSURE || kind == KIND_SEQUENCE || kind == KIND_INEQUALITY ||
         (kind == KIND_NUMBER && claim_says(c, "from", "orbit")) ||
         (kind == KIND_ARGUMENT && claim_says(c, "over", "scene"));
}

/* What the script prints before it proves anything: the claim, the paper's text and what was read.  The formulas of an
   argument stand among its facts. */
static bool add_head(struct text *out, struct judge *j, const struct claim *c, const char *id, bool corrected) {
  struct finding f;
  if (!finding_describe(&f, j, c)) return false;
  bool argument = claim_kind(c) == KIND_ARGUMENT, orbit = receipt_of_orbit(c);
  bool numbers = claim_kind(c) == KIND_CLOSURE || claim_kind(c) == KIND_NUMBER;
  const char *needs = numbers ? "mpmath" : orbit ? "SymPy, with mpmath," : "SymPy";
  OWNED(text) said = {0};
  OWNED(text) read = {0};
  text_printf(&said, "%s%s: %s\n", id, corrected ? ", as corrected" : "", f.title);
  text_add(&said, f.quote ? "The paper" : "");
  if (f.quote && f.equation) text_printf(&said, ", (%s)", f.equation);
  if (f.quote) text_printf(&said, ": %s\n", f.quote);
  if (corrected && erratum_text(&read, j->model, c)) text_printf(&said, "As corrected:\n  %s\n", text_str(&read));
  if (!corrected && !argument && claim_formulas(&read, j->model, c, "  ") > 0)
    text_printf(&said, "As read:\n%s", text_str(&read));
  for (char *p = said.data; (p = strstr(p, "\"\"\"")) != NULL;) *p = '\''; /* the string must not end there */
  text_printf(out, "#!/usr/bin/env python3\n# Needs %s and nothing else.\nr\"\"\"%s\"\"\"\n%s\nCLAIM = \"%s%s\"\n",
              needs, text_str(&said), argument && !orbit ? "from sympy import Symbol\n" : "", id,
              corrected ? " as corrected" : "");
  if (!orbit)
    text_add(out, argument ? "PROOFS = []\n\n"
                           : "PARTS, PRINTED, MATRICES, GENERIC, DIVISORS, CRITERION = [], [], [], [], [], []\n");
  return true;
}

/* The rank everywhere, or else that at almost all values, of which a minor at one point is left to the script. */
static bool rank_receipt(struct text *out, struct judge *j, const struct claim *c) {
  struct rank_system y;
  struct exact_rank r = {.rank = -1};
  struct view view = claim_view(j->model, c);
  const char *said = claim_get(c, "rank");
  int rank = said ? (int)strtol(said, NULL, 10) : -1;
  bool ok = rank_system_build(&y, j, c, view), generic = false;
  if (ok) {
    r = exact_rank_of(j->out, &y);
    struct generic_rank g = {0};
    if (r.rank < 0) g = generic_rank_of(j, c, view, &y);
    generic = g.analytic && g.most == rank;
    ok = generic || (r.rank >= 0 && r.rank == rank && !r.contradict);
    if (!ok)
      diag_set(j->d, "error: %.200s is not proved by exact algebra: %s", c->id,
               r.rank < 0 || r.contradict ? r.note : "the rank differs");
  }
  ok = ok && add_head(out, j, c, c->id, false);
  if (ok) add_system(out);
  if (ok) (generic ? add_equations : add_matrix)(out, &y, rank);
  sentence_clear(&y.s);
  return ok;
}

/* --- Divisors, and the criterion of stability --- */

/* What the records divide by and take roots of, none of it zero. */
static bool defined_receipt(struct text *out, struct judge *j, const struct claim *c) {
  struct divisor list[MOST_DIVISORS];
  char ids[16][32];
  struct view view = claim_view(j->model, c);
  int n = 0, m = claim_names_listed(ids, 16, claim_get(c, "statements"));
  bool admissible = claim_over_admissible(c), ok = add_head(out, j, c, c->id, false);
  for (int i = 0; ok && i < m; i++) {
    const struct statement_record *r = view_record(&view, ids[i]);
    ok = r && divisors_of(list, &n, &j->out->arena, r, view);
  }
  if (ok) add_system(out);
  for (int i = 0; ok && i < n; i++) {
    OWNED(tape) t = {.n = 0};
    const char *formula = list[i].formula;
    if (!nonzero_because(&list[i], view, admissible))
      ok = diag_set(j->d, "error: %.200s is not proved by exact algebra: %.200s may be zero", c->id, formula);
    ok = ok && formula_tape(&t, view, formula, list[i].section, NULL, 0);
    if (ok) add_sides(out, &t, "DIVISORS", i);
    if (ok)
      text_printf(out, "\n\nDIVISORS.append((\"%s\", %s, %s, DIVISORS_%d, %ld))\n", formula,
                  list[i].root ? "True" : "False", admissible ? "True" : "False", i, (long)t.outputs[0]);
  }
  return ok;
}

/* J and its factors, and the inequalities in the entries of these. */
static bool criterion_receipt(struct text *out, struct judge *j, const struct claim *c) {
  struct override o[N_PHASES];
  struct view view = claim_view(j->model, c);
  const struct statement_record *r = claim_record(view, c, "statement", claim_get(c, "statement"), j->d);
  if (!r) return false;
  struct linearized l = linearized_stability(j, r, view);
  if (!linearized_proves(&l)) return diag_set(j->d, "error: %.200s: %.200s", c->id, l.note);
  struct exact_proof p = exact_prove_jacobian(j, view);
  bool ok = add_head(out, j, c, c->id, false);
  if (ok) add_system(out);
  if (!ok || !add_parts(out, &p, view, "PARTS", j->d)) return false;
  int n = 0;
  for (int ph = 0; ph < N_PHASES; ph++) n += oracle_override(&o[n], local_maps[ph].name);
  OWNED(sentence) s;
  ok = sentence_from_relations(&s, view, r, o, n, j->d);
  if (ok) {
    add_sides(out, &s.tape, "CRITERION", 0);
    text_add(out, "\n\nCRITERION += [CRITERION_0, [");
    add_numbers(out, s.tape.outputs, s.tape.n_outputs);
    text_add(out, "], \"");
    for (slong k = 0; k < s.n; k++) text_add(out, s.ops[k] == REL_LT ? "<" : s.ops[k] == REL_GT ? ">" : "?");
    text_add(out, "\"]\n");
  }
  return ok;
}

static bool equality_receipt(struct text *out, struct judge *j, const struct claim *c, const char *id,
                             const struct restriction *r) {
  struct view view = claim_view(j->model, c);
  struct exact_proof p = exact_prove(j, c, view, r);
  bool corrected = !p.proved && !r;
  if (corrected) {
    view.own = NULL;
    p = exact_prove(j, c, view, NULL);
  }
  bool ok = p.proved;
  if (!ok) diag_set(j->d, "error: %.200s is not proved by exact algebra: %s", id, p.why_not);
  if (ok && p.beyond)
    ok = diag_set(
        j->d, "error: %.200s has symbols of the paper's own, pi or exponentials, of which receipts know nothing", id);
  ok = ok && add_head(out, j, c, id, corrected);
  if (ok) add_system(out);
  ok = ok && add_parts(out, &p, view, "PARTS", j->d);
  bool a_matrix = p.n_parts > 0 && p.part[0].question->value; /* entry by entry as printed */
  return ok && (!corrected || !a_matrix || add_parts(out, &p, claim_view(j->model, c), "PRINTED", j->d));
}

/* --- At the scene's orbit, by intervals --- */

static const char orbit_script[] = "receipt/orbit.py";

/* Has orbit.py a value of it?  At the printed numbers, which are no states, of fewer names. */
static bool known_there(const char *name, bool printed) {
  static const char *const friction[] = {"u_r1", "u_r2", "u_s1", "u_s2"};
  struct motion_name n;
  int arc = name_of_arc(name); /* z_10 and z_20 are the first two, times the last ones */
  bool at_start = arc == 0 || arc == 1, time = arc >= N_STATE * N_PHASES;
  bool moves = strcmp(name, "t") == 0;
  if (name_of_motion(&n, name)) {
    int switching = name_of_switching_time(n.argument);
    moves = n.primes < 2 && (name_goes_with_time(name) || (switching >= 0 && switching <= N_PHASES));
  }
  return at_start || time || strcmp(name, "pi") == 0 || word_find(name, name_param, N_PARAMS) < N_PARAMS ||
         (!printed && (arc >= 0 || moves || word_find(name, friction, 4) < 4));
}

/* What it has none of; NULL: nothing. */
static const char *unknown_there(const struct tape *t, bool printed) {
  static const enum tape_op without[] = {TAPE_ROOT, TAPE_sinc, TAPE_stumpff, TAPE_hypot};
  for (slong i = 0; i < t->n; i++)
    for (size_t k = 0; k < COUNT(without); k++)
      if (t->code[i].op == without[k]) return k ? "such functions" : "roots of polynomials";
  for (slong i = 0; i < t->n_inputs; i++)
    if (!known_there(t->inputs[i], printed)) return t->inputs[i];
  return NULL;
}

/* The margins of the conditions that the attribute names, each with its phase where it moves; of inequalities without
   those that contain u_r1 or u_r2, where nothing gives them. */
static bool add_margins(struct text *out, struct judge *j, const struct claim *c, const char *attribute,
                        const char *list) {
  OWNED(conditions) all;
  bool ok = conditions_read(&all, j, c, attribute, claim_view(j->model, c));
  for (int i = 0; ok && i < all.n; i++) {
    const struct condition *k = &all.at[i];
    bool printed = claim_kind(c) == KIND_INEQUALITY;
    bool given = (j->scene->given[KEY_U_R1] || !k->friction[0]) && (j->scene->given[KEY_U_R2] || !k->friction[1]);
    if (printed && !given) {
      text_printf(out, "LEFT_OUT.append(\"%s\")\n", k->text);
      continue;
    }
    const char *beyond = unknown_there(&k->s.tape, printed);
    if (beyond)
      return diag_set(j->d, "error: %.200s is proved, but %s knows nothing of %.200s%s", c->id, orbit_script, beyond,
                      printed ? " at the printed numbers" : "");
    add_sides(out, &k->s.tape, list, i);
    const char *relation = k->equality ? "=" : k->strict ? ">" : ">=";
    text_printf(out, "\n\n%s.append((\"%s\", \"%s\", \"%s\", %s_%d, %ld))\n", list, k->text,
                k->moving ? phase_name[k->phase] : "", relation, list, i, (long)k->s.tape.outputs[0]);
  }
  return ok;
}

/* The data, and the numbers as printed; false where the scene has not what the script starts from. */
static bool orbit_receipt(struct text *out, struct judge *j, const struct claim *c) {
  const struct scene *s = j->scene;
  const char *number = claim_get(c, "number"), *word = claim_get(c, "word");
  const struct printed_number *z[2];
  enum kind kind = claim_kind(c);
  if (!scene_has_forces(s) || !printed_start(z, s) || (number && !scene_printed(s, number)))
    return diag_set(j->d, "error: %.200s needs a scene with e1, e2 and the printed numbers", c->id);
  bool of_margins = kind != KIND_CLOSURE && kind != KIND_NUMBER;
  struct finding f;
  if (!judge_verdict(&f, j, c)) return false;
  if (of_margins ? f.verdict != VERDICT_PROVED : !verdict_fails(f.verdict))
    return diag_set(j->d, "error: %.200s is %s, and its receipt would be of what is %s", c->id, verdict_name[f.verdict],
                    of_margins ? "proved" : "refuted");
  bool ok = add_head(out, j, c, c->id, false);
  text_printf(out, number ? "NUMBER = \"%s\"\nPARAMETERS = {" : "NUMBER = None\nPARAMETERS = {", number);
  for (int i = 0; i < N_PARAMS; i++) {
    text_printf(out, "%s\"%s\": \"", i ? ", " : "", scene_key_name[i]);
    num_print_q(out, &s->value[i]);
    text_add_char(out, '"');
  }
  text_add(out, "}\nPRINTED = {");
  for (size_t i = 0; i < s->n_printed; i++) {
    text_printf(out, "%s\n    \"%s\": (\"%s\", \"", i ? "," : "", s->printed[i].name, s->printed[i].decimal);
    num_print_q(out, &s->printed[i].value);
    text_add(out, "\", \"");
    num_print_q(out, &s->printed[i].unit);
    text_add(out, "\")");
  }
  text_add(out, "}  # the decimal, its value, one unit of the last decimal that is given\n");
  text_printf(out, "PREMISES, LEFT_OUT, GOALS = [], [], %s\nWORD = \"%s\"\nFRICTION = %s\nAS_PRINTED = %s\n",
              of_margins ? "[]" : "None", word ? word : "",
              kind == KIND_ARGUMENT && !claim_get(c, "friction") ? "True" : "False",
              kind == KIND_INEQUALITY ? "True" : "False");
  const char *goals = kind == KIND_ARGUMENT ? "conclusion" : kind == KIND_INEQUALITY ? "statement" : "constraints";
  return ok &&
         (!of_margins || (add_margins(out, j, c, "premises", "PREMISES") && add_margins(out, j, c, goals, "GOALS")));
}

const char *receipt_file(const struct claims *claims, const char *id) {
  const struct claim *c = claim_answering(claims, id);
  return c && receipt_of_orbit(c)              ? orbit_script
         : c && claim_kind(c) == KIND_ARGUMENT ? "receipt/argument.py"
                                               : "receipt/model.py";
}

bool audit_receipt(struct text *out, const struct model *m, const struct claims *claims, const struct scene *scene,
                   const char *id, const char *python, struct diag *d) {
  const struct restriction *r;
  const struct claim *c = find(claims, id, &r);
  if (!c) return claims_unknown(claims, id, d);
  enum kind kind = claim_kind(c);
  LOCAL(audit_result, kept);
  struct judge j = {.out = &kept, .model = m, .claims = claims, .scene = scene, .cache = orbit_cache_new(), .d = d};
  bool ok = receipt_of_orbit(c)        ? orbit_receipt(out, &j, c)
            : kind == KIND_RANK        ? rank_receipt(out, &j, c)
            : kind == KIND_DEFINED     ? defined_receipt(out, &j, c)
            : kind == KIND_CRITERION   ? criterion_receipt(out, &j, c)
            : kind == KIND_ARGUMENT    ? add_head(out, &j, c, id, false) && argument_receipt(out, &j, c)
            : claim_tried_at_points(c) ? equality_receipt(out, &j, c, id, r)
                                       : diag_set(d, "error: %.200s is not of a kind that exact algebra proves", id);
  if (ok) text_printf(out, "\n\n%s", python);
  orbit_cache_free(j.cache);
  return ok;
}
