/* How could inconsistent printed numbers have arisen?  The readings of the example are searched by how many equations
   they drop, up to one number beyond the first at which some reading gives everything that is printed. */
#include <stdlib.h>
#include <string.h>

#include "readings_impl.h"
#include "study.h"
#include "value/printed.h"

enum { MAX_DROPPED = 3, SHOWN = 10 };

/* The formulas of a layer with the equations in double and in balls. */
struct engine {
  struct formulas formulas;
  struct system search, proof;
  enum layer layer;
};

static bool engine_start(struct engine *g, const struct model *m, enum layer layer, const struct scene *s) {
  g->layer = layer;
  bool ok = formulas_read(&g->formulas, (struct view){m, layer, NULL, NULL});
  system_init(&g->search, &g->formulas, s, num_ctx_double());
  system_init(&g->proof, &g->formulas, s, num_ctx_arb(FIRST_PREC));
  return ok;
}

static void engine_stop(struct engine *g) {
  system_clear(&g->proof);
  system_clear(&g->search);
  formulas_clear(&g->formulas);
}

/* Do both give the same matrices over the printed times? */
static truth same_motion(struct engine *a, struct engine *b, const struct example *e) {
  for (int i = 0; i < N_X; i++) {
    arb_set_fmpq(num_vec_at(&a->proof.x, i), &e->printed[i]->value, FIRST_PREC);
    arb_set_fmpq(num_vec_at(&b->proof.x, i), &e->printed[i]->value, FIRST_PREC);
  }
  if (system_propagators(&a->proof) != SS_OK || system_propagators(&b->proof) != SS_OK) return TRUTH_UNKNOWN;
  for (int k = 0; k < 4; k++)
    for (int i = 0; i < 16; i++)
      if (!arb_overlaps(num_vec_at(&a->proof.p[k], i), num_vec_at(&b->proof.p[k], i))) return TRUTH_FALSE;
  return TRUTH_TRUE;
}

/* --- Candidates proved and put on record --- */

struct hunt {
  struct audit_result *out;
  struct readings *r;
  const struct example *e;
  struct engine *engine[N_LAYERS];
  int n_engines;
  struct system own; /* the model's equations in balls */
};

static struct engine *engine_of(const struct hunt *h, const struct candidate *c) {
  for (int i = 0; i < h->n_engines; i++)
    if (h->engine[i]->layer == c->layer) return h->engine[i];
  abort();
}

/* Does the reading, enclosed in x, give every printed number?  UNKNOWN too where it cannot be enclosed. */
static truth gives_printed(arb_ptr x, const struct candidate *c, const struct example *e, struct system *s) {
  enum reading how;
  truth all = TRUTH_TRUE;
  if (!candidate_enclose(x, c, s, e)) return TRUTH_UNKNOWN;
  for (int i = 0; i < N_PRINTED; i++)
    if (e->printed[i] && (i >= N_X || c->unknown >> i & 1))
      all = truth_and(all, printed_fits(x + i, e->printed[i], &how));
  return all;
}

/* The model's own equations at the same place: enclosed, and the same numbers. */
static bool model_agrees(arb_srcptr x, struct hunt *h, const struct candidate *c) {
  ARB_VECTOR(y, N_PRINTED);
  bool same = candidate_enclose(y, c, &h->own, h->e);
  for (int i = 0; same && i < N_PRINTED; i++) same = arb_overlaps(x + i, y + i);
  return same;
}

/* The candidates are in the order of their ranks. */
static void record(struct hunt *h, const struct candidate *c, size_t n) {
  ARB_VECTOR(x, N_PRINTED);
  h->r->found = arena_alloc(&h->out->arena, SHOWN * sizeof *h->r->found);
  for (size_t i = 0; i < n && h->r->n_found < SHOWN; i++) {
    struct engine *g = engine_of(h, &c[i]);
    if (gives_printed(x, &c[i], h->e, &g->proof) != TRUTH_TRUE) continue;
    struct example_reading *r = &h->r->found[h->r->n_found++];
    reading_describe(r, h->out, &c[i], x, h->e, &g->proof);
    reading_shifts(r, h->out, &c[i], x, h->e, &g->proof, &g->search);
    if (c[i].layer == LAYER_CORRECTED && model_agrees(x, h, &c[i])) r->confirmed = "model";
  }
}

struct harvest {
  struct candidate *c;
  size_t n;
};

/* One number of dropped equations, in every layer; adds what is found and counts. */
static void search_level(struct harvest *all, struct hunt *h, int dropped) {
  struct readings_level *l = &h->r->level[h->r->n_levels++];
  ARB_VECTOR(x, N_PRINTED);
  *l = (struct readings_level){.dropped = dropped};
  for (int k = 0; k < h->n_engines; k++) {
    struct engine *g = h->engine[k];
    struct candidate *found;
    size_t n;
    long tried, undetermined;
    readings_search(&found, &n, &tried, &undetermined, dropped, &g->search, g->layer, h->e);
    l->tried += tried;
    l->undetermined += undetermined;
    for (size_t i = 0; i < n; i++) {
      truth t = gives_printed(x, &found[i], h->e, &g->proof);
      l->reproduce += t == TRUTH_TRUE;
      l->unrounded += t == TRUTH_TRUE && found[i].carry == CARRY_EXACT;
      l->open += t == TRUTH_UNKNOWN;
    }
    all->c = ss_realloc(all->c, (all->n + n + 1) * sizeof *all->c);
    if (n) memcpy(all->c + all->n, found, n * sizeof *found);
    all->n += n;
    free(found);
  }
}

/* --- In words --- */

static void say(struct hunt *h, const char ***list, int *n, const char *sentence) {
  arena_list_add(&h->out->arena, list, n, sentence);
}

static void describe_space(struct hunt *h, const char *layers) {
  struct readings *r = h->r;
  struct form forms[MAX_FORMS];
  const char *const sentences[] = {
      result_str(
          h->out,
          "There are eight quantities (z_10, z_20, t_a, t_b, t_c, t_d, e_1, e_2) for given chi, eta and V, and six "
          "independent equations: (12), (14) and four periodicity conditions.  The latter were taken in %d selections: "
          "one by one as (16) and (18) state them; with the positions combined to the restoring forces; and solved for "
          "z_0 by the positions (46) or by the velocities (second line of (44)), with the rows of (45) as the "
          "conditions that the two agree.",
          forms_list(forms)),
      "For every selection of equations, every choice of printed numbers as exact data was tried that leaves as many "
      "unknowns as equations.  Sets of equations that cannot determine their unknowns, whatever the coefficients, are "
      "only counted.",
      "Intermediate numbers were carried at full precision, as printed, or rounded to 3 or to 2 decimals wherever that "
      "makes a difference; the bounds (53) are computed from the numbers carried.",
      layers,
      result_str(
          h->out,
          "Solutions were sought by Newton's iteration from the printed numbers, with up to %d equations left out, and "
          "with up to one more than the least number for which some reading gives all the printed numbers.  Every "
          "number of a reading that is reported is proved to lie in the interval of the printed decimal, rounded or "
          "truncated, with as many decimals as the longest of the printed numbers has.",
          MAX_DROPPED),
      "The readings are ranked by the number of equations left out; then by the number of assumptions, one for each "
      "of these: a printed number taken as data that the paper does not name as such, a datum that is computed, a "
      "decimal by which a computed result is printed shorter than the longest (which must be zero by chance), a form "
      "of "
      "(18) that is not in the paper, rounding of intermediate results, a result that is truncated where most are "
      "rounded or conversely; then by the number of digits reproduced."};
  for (size_t i = 0; i < sizeof sentences / sizeof *sentences; i++) say(h, &r->space, &r->n_space, sentences[i]);
}

static const char *inputs_of(struct hunt *h, const struct example_reading *r) {
  struct text t = {0};
  for (int i = 0; i < r->n_inputs; i++) text_printf(&t, "%s%s", i ? ", " : "", r->inputs[i]);
  return t.len ? result_take(h->out, &t) : "nothing";
}

static void conclude_found(struct hunt *h) {
  struct readings *r = h->r;
  long before = 0;
  const struct readings_level *first = NULL;
  for (int k = 0; k < r->n_levels && !first; k++) {
    if (r->level[k].reproduce && r->n_found)
      first = &r->level[k];
    else
      before += r->level[k].tried;
  }
  const char *s;
  if (!first)
    s = result_str(h->out, "None of the %ld readings tried gives all the printed numbers.", before);
  else if (first->dropped == 0)
    s = result_str(
        h->out,
        "The printed numbers are consistent%s: %ld of %ld readings in which every equation holds give all of "
        "them; the first takes %s as inputs.",
        strcmp(r->found[0].layer, layer_name[LAYER_PRINTED]) == 0 ? " with the matrices as printed" : "",
        first->reproduce, first->tried, inputs_of(h, &r->found[0]));
  else
    s = result_str(
        h->out,
        "A reading is one way in which the printed numbers could have been computed: some of them are taken as exact "
        "data, and the others follow from the equations, of which some may have been left out.  None of the %ld "
        "readings "
        "%s gives all the printed numbers.  Of the %ld readings that leave out %s, %ld give%s all of them, %ld without "
        "rounding of intermediate results.",
        before,
        first->dropped == 1 ? "that satisfy every equation"
                            : result_str(h->out, "without fewer than %d of the equations", first->dropped),
        first->tried,
        first->dropped == 1 ? "one of the equations" : result_str(h->out, "%d of the equations", first->dropped),
        first->reproduce, first->reproduce == 1 ? "s" : "", first->unrounded);
  say(h, &r->conclusion, &r->n_conclusions, s);
}

/* What the first reading says. */
static void conclude_first(struct hunt *h) {
  struct readings *r = h->r;
  if (r->n_found == 0 || r->found[0].n_dropped == 0) return;
  const struct example_reading *f = &r->found[0];
  struct text t = {0};
  text_printf(&t, "The reading with the fewest assumptions takes %s as exact data and does not satisfy ",
              inputs_of(h, f));
  for (int i = 0; i < f->n_dropped; i++)
    text_printf(&t, "%s%s, whose sides then differ by %s", i ? "; " : "", f->dropped[i].equation,
                f->dropped[i].residual);
  text_add(&t, ".");
  if (f->n_shifts)
    text_add(&t, "  Its results differ from those of the whole procedure by the following amounts, with the "
                 "first-order effect of "
                 "that difference alone in brackets:");
  for (int i = 0; i < f->n_shifts; i++)
    text_printf(&t, "%s %s %s (%s)", i ? "," : "", paper_name(f->shift[i].of).is, f->shift[i].actual,
                f->shift[i].predicted);
  if (f->n_shifts) text_add(&t, ".");
  if (f->decimals >= 0)
    text_printf(
        &t,
        "  Its data have to be accurate to %d decimals if its results are to be known to half a unit of the last "
        "printed decimal.",
        f->decimals);
  say(h, &r->conclusion, &r->n_conclusions, result_take(h->out, &t));
}

static void conclude_pairs(struct hunt *h) {
  struct readings *r = h->r;
  const struct readings_pair *best = NULL;
  int solved = 0;
  for (int i = 0; i < r->n_pairs; i++) {
    solved += r->pair[i].missed != NULL;
    if (r->pair[i].missed && (!best || r->pair[i].n_given > best->n_given)) best = &r->pair[i];
  }
  if (best)
    say(h, &r->conclusion, &r->n_conclusions,
        result_str(h->out,
                   "If every equation is satisfied and two of the printed numbers are taken as exact data, %d of the "
                   "%d choices have a solution near the printed numbers; at most %d of the %d are reproduced, the two "
                   "included.",
                   solved, r->n_pairs, best->n_given, best->n_numbers));
}

static void conclude_rounding(struct hunt *h) {
  struct readings *r = h->r;
  OWNED(text) out = {0}, need = {0};
  int most = -1;
  for (int i = 0; i < r->procedure.n_outputs; i++) {
    const struct procedure_output *o = &r->procedure.output[i];
    if (strcmp(o->within, "no") == 0)
      text_printf(&out, "%s%s (%s to %s, printed %s)", out.len ? ", " : "", paper_name(o->name).is, o->low, o->high,
                  o->printed);
    text_printf(&need, "%s%s %d", need.len ? ", " : "", paper_name(o->name).is, o->decimals);
    if (o->decimals > most) most = o->decimals;
  }
  if (out.len)
    say(h, &r->conclusion, &r->n_conclusions,
        result_str(
            h->out,
            "The rounding of the data %s does not explain the differences: for all values that their printed "
            "digits allow, these results lie within the following bounds, and none is the printed one, read with as "
            "many decimals as the longest of the printed numbers has: %s.",
            r->procedure.inputs, text_str(&out)));
  if (r->procedure.n_outputs)
    say(h, &r->conclusion, &r->n_conclusions,
        result_str(h->out,
                   "Number of decimals of %s with which the results of the whole procedure are known to half a unit of "
                   "the last "
                   "printed decimal: %s.",
                   r->procedure.inputs, text_str(&need)));
}

/* --- The whole --- */

static void hunt_run(struct hunt *h) {
  struct readings *r = h->r;
  struct harvest all = {NULL, 0};
  int last = MAX_DROPPED;
  for (int dropped = 0; dropped <= last; dropped++) {
    search_level(&all, h, dropped);
    if (r->level[r->n_levels - 1].reproduce && dropped + 1 < last) last = dropped + 1;
  }
  if (all.n) qsort(all.c, all.n, sizeof *all.c, candidate_compare);
  record(h, all.c, all.n);
  free(all.c);
  struct engine *g = h->engine[0];
  readings_pairs(r, h->out, h->e, &g->proof, &g->search);
  readings_procedure(r, h->out, h->e, &g->proof, &g->search);
  conclude_found(h);
  conclude_first(h);
  conclude_pairs(h);
  conclude_rounding(h);
}

const char *audit_readings(struct audit_result *out, const struct model *m, const struct scene *s) {
  OWNED(example) e;
  struct engine corrected, printed;
  struct formulas own;
  const char *why = example_init(&e, s);
  if (why) return why;
  bool ok = engine_start(&corrected, m, LAYER_CORRECTED, s), also = engine_start(&printed, m, LAYER_PRINTED, s);
  truth same = ok && also ? same_motion(&corrected, &printed, &e) : TRUTH_UNKNOWN;
  formulas_own(&own);
  if (ok) {
    out->readings = arena_alloc(&out->arena, sizeof *out->readings);
    *out->readings = (struct readings){.n_space = 0};
    struct hunt h = {.out = out, .r = out->readings, .e = &e, .engine = {&corrected, &printed}, .n_engines = 1};
    if (same == TRUTH_FALSE) h.n_engines = 2;
    system_init(&h.own, &own, s, num_ctx_arb(FIRST_PREC));
    describe_space(&h, same == TRUTH_FALSE ? "The matrices are the paper's, both as corrected and as printed."
                       : same == TRUTH_TRUE
                           ? "The matrices are the paper's, as corrected; for the printed times those as printed are "
                             "the same."
                           : "The matrices are the paper's, as corrected; those as printed cannot be evaluated.");
    hunt_run(&h);
    system_clear(&h.own);
  } else {
    why = "the paper's matrices cannot be evaluated";
  }
  engine_stop(&printed);
  engine_stop(&corrected);
  return why;
}
