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
#include "receipt.h"
#include "record/result.h"
#include "value/title.h"

/* --- The paper's side: each value when it is asked for --- */

static void add_instruction(struct text *out, const struct tape *t, slong i) {
  const struct tape_instr *in = &t->code[i];
  static const char *const infix[] = {[TAPE_add] = "+", [TAPE_sub] = "-", [TAPE_mul] = "*", [TAPE_div] = "/"};
  static const char *const functions[] = {[TAPE_sin] = "sin",   [TAPE_cos] = "cos",   [TAPE_cot] = "cot",
                                          [TAPE_sqrt] = "sqrt", [TAPE_sinc] = "sinc", [TAPE_stumpff] = "stumpff"};
  text_printf(out, "        %ld: lambda: ", (long)i);
  switch (in->op) {
  case TAPE_CONST:
    text_add(out, "f.number(\"");
    num_print_q(out, &t->consts[in->k]);
    text_add(out, "\")");
    break;
  case TAPE_INPUT:
    text_printf(out, "x(\"%s\")", t->inputs[in->k]);
    break;
  case TAPE_ROOT:
    text_printf(out, "f.root(%s", in->k < 0 ? "True" : "False");
    for (slong k = 0; k < in->b; k++) text_printf(out, ", v(%ld)", (long)t->links[in->a + k]);
    text_add(out, ")");
    break;
  case TAPE_POW:
    text_printf(out, "v(%ld) ** %ld", (long)in->a, (long)in->k);
    break;
  case TAPE_ROUNDED:
    text_printf(out, "v(%ld)", (long)in->a);
    break;
  case TAPE_neg:
    text_printf(out, "-v(%ld)", (long)in->a);
    break;
  case TAPE_sin:
  case TAPE_cos:
  case TAPE_cot:
  case TAPE_sqrt:
  case TAPE_sinc:
  case TAPE_stumpff:
    text_printf(out, "f.%s(v(%ld))", functions[in->op], (long)in->a);
    break;
  case TAPE_hypot:
    text_printf(out, "f.hypot(v(%ld), v(%ld))", (long)in->a, (long)in->b);
    break;
  default:
    text_printf(out, "v(%ld) %s v(%ld)", (long)in->a, infix[in->op], (long)in->b);
    break;
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
  struct exact_field *f = exact_field_new(NULL, 0);
  struct calc c = calc_begin(num_ctx_exact());
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
  calc_clear(&c);
  exact_field_free(f);
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
  for (slong k = 0; k < p->n; k++) text_add(out, s->ops[k] == REL_EQ ? "=" : s->ops[k] == REL_LT ? "<" : ">");
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

/* To a list of the script: PARTS, which it proves, or PRINTED, of which it says by how much they are wrong. */
static bool add_parts(struct text *out, const struct exact_proof *p, struct view view, const char *list,
                      struct diag *d) {
  bool ok = true;
  for (int i = 0; ok && i < p->n_parts; i++) {
    struct sentence s;
    ok = exact_sentence(&s, p->part[i].question, view, p->part[i].unknown, p->part[i].n_unknowns, d);
    if (ok) add_sides(out, &s.tape, list, i);
    if (ok) text_add(out, "\n\n");
    if (ok) add_part(out, &p->part[i], &s, list, i);
    sentence_clear(&s);
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

static bool add_head(struct text *out, struct judge *j, const struct claim *c, const char *id, bool corrected) {
  const struct model *m = j->model;
  bool argument = claim_kind(c) == KIND_ARGUMENT; /* whose formulas stand among its facts */
  text_printf(out, "#!/usr/bin/env python3\n# %s%s: ", id, corrected ? ", as corrected" : "");
  bool ok = claim_title(out, m, c, j->scene, j->d);
  text_printf(out, "\n#\n# Needs SymPy and nothing else.%s\n", argument ? "" : "  As read:");
  if (corrected) text_add(out, "#   ");
  if (corrected && erratum_text(out, m, c)) text_add_char(out, '\n');
  if (!corrected && !argument) claim_formulas(out, m, c, "#   ");
  text_printf(out, "%s\n\nCLAIM = \"%s%s\"\n%s\n",
              argument ? "from sympy import Symbol, cancel, diff, factor_list, fraction"
                       : "import re\nimport sys\n\nfrom sympy import QQ, Symbol, factor, ring",
              id, corrected ? " as corrected" : "", argument ? "PROOFS = []" : "PARTS, PRINTED, MATRICES = [], [], []");
  return ok;
}

static bool rank_receipt(struct text *out, struct judge *j, const struct claim *c) {
  struct rank_system y;
  struct exact_rank r = {-1, NULL};
  bool ok = rank_system_build(&y, j, c, claim_view(j->model, c));
  if (ok) {
    r = exact_rank_of(j->out, &y);
    const char *said = claim_get(c, "rank");
    ok = said && r.rank == (int)strtol(said, NULL, 10);
    if (!ok)
      diag_set(j->d, "error: %.200s is not proved by exact algebra: %s", c->id,
               r.rank < 0 ? r.note : "the rank differs");
  }
  ok = ok && add_head(out, j, c, c->id, false);
  if (ok) add_system(out);
  if (ok) add_matrix(out, &y, r.rank);
  sentence_clear(&y.s);
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
  if (ok && p.beyond) {
    diag_set(j->d, "error: %.200s has symbols of the paper's own, pi or exponentials, of which receipts know nothing",
             id);
    ok = false;
  }
  ok = ok && add_head(out, j, c, id, corrected);
  if (ok) add_system(out);
  ok = ok && add_parts(out, &p, view, "PARTS", j->d);
  bool a_matrix = p.n_parts > 0 && p.part[0].question->value; /* entry by entry as printed */
  return ok && (!corrected || !a_matrix || add_parts(out, &p, claim_view(j->model, c), "PRINTED", j->d));
}

/* --- Printed numbers against the orbit, by intervals --- */

static bool receipt_of_orbit(const struct claims *claims, const char *id) {
  const struct claim *c = claim_answering(claims, id);
  return c && (claim_kind(c) == KIND_CLOSURE || (claim_kind(c) == KIND_NUMBER && claim_says(c, "from", "orbit")));
}

/* The data, and the numbers as printed; false where the scene has not what the script starts from. */
static bool orbit_receipt(struct text *out, struct judge *j, const struct claim *c) {
  const struct scene *s = j->scene;
  const char *number = claim_get(c, "number");
  if (!scene_has_forces(s) || !scene_printed(s, "z10") || !scene_printed(s, "z20") ||
      (number && !scene_printed(s, number)))
    return diag_set(j->d, "error: %.200s needs a scene with e1, e2 and the printed numbers", c->id);
  text_printf(out, "#!/usr/bin/env python3\n# %s: ", c->id);
  bool ok = claim_title(out, j->model, c, j->scene, j->d);
  text_printf(out, "\n#\n# Needs mpmath and nothing else.\nCLAIM = \"%s\"\nNUMBER = ", c->id);
  text_printf(out, number ? "\"%s\"\nPARAMETERS = {" : "None\nPARAMETERS = {", number);
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
  return ok;
}

const char *receipt_file(const struct claims *claims, const char *id) {
  const struct claim *c = claim_answering(claims, id);
  return receipt_of_orbit(claims, id)          ? "receipt/orbit.py"
         : c && claim_kind(c) == KIND_ARGUMENT ? "receipt/argument.py"
                                               : "receipt/model.py";
}

bool audit_receipt(struct text *out, const struct model *m, const struct claims *claims, const struct scene *scene,
                   const char *id, const char *python, struct diag *d) {
  const struct restriction *r;
  const struct claim *c = find(claims, id, &r);
  if (!c) {
    claims_unknown(claims, id, d);
    return false;
  }
  enum kind kind = claim_kind(c);
  bool of_orbit = receipt_of_orbit(claims, id);
  if (!of_orbit && !claim_tried_at_points(c) && kind != KIND_RANK && kind != KIND_ARGUMENT)
    return diag_set(d, "error: %.200s is not of a kind that exact algebra proves", id);
  struct audit_result kept;
  audit_result_init(&kept);
  struct judge j = {.out = &kept, .model = m, .claims = claims, .scene = scene, .d = d};
  bool ok = of_orbit                ? orbit_receipt(out, &j, c)
            : kind == KIND_RANK     ? rank_receipt(out, &j, c)
            : kind == KIND_ARGUMENT ? add_head(out, &j, c, id, false) && argument_receipt(out, &j, c)
                                    : equality_receipt(out, &j, c, id, r);
  if (ok) text_printf(out, "\n\n%s", python);
  audit_result_clear(&kept);
  return ok;
}
