/* The paper's formulas as methods: the text as corrected, elaborated and compiled once, then evaluated in double. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "bench/jobs.h"
#include "model/model.h"

struct program {
  struct elaboration el;
  struct tape tape;
  struct num_vec in;
  int *symbol; /* of each input */
};

/* "omega_1@section" stands for the root omega_1 where several sections have one. */
static int find_symbol(const struct bench_formula *f, const char *input) {
  size_t len = strcspn(input, "@");
  for (int i = 0; i < f->n_symbols; i++)
    if (strlen(f->symbol[i]) == len && strncmp(f->symbol[i], input, len) == 0) return i;
  return -1;
}

static bool bind_symbols(struct program *p, const struct bench_formula *f) {
  p->symbol = ss_malloc((size_t)(p->tape.n_inputs + 1) * sizeof *p->symbol);
  bool known = true;
  for (slong i = 0; i < p->tape.n_inputs; i++) {
    p->symbol[i] = find_symbol(f, p->tape.inputs[i]);
    known = known && p->symbol[i] >= 0;
  }
  return known;
}

static bool compile(struct program *p, const struct bench_formula *f) {
  struct matrix m;
  struct diag d = {0};
  if (!elaborate_text(&m, &p->el, f->text, f->text, f->section, &d) || m.rows * m.cols != f->n_out) return false;
  return tape_build(&p->tape, m.e, f->n_out, p->el.roots, f->roots ? p->el.n_roots : 0, &d) && bind_symbols(p, f);
}

void *bench_formula_open(const struct bench_method *m, double setting, const struct bench_env *env) {
  const struct bench_formula *f = m->data;
  (void)setting;
  if (!env->model) return NULL;
  struct program *p = ss_malloc(sizeof *p);
  *p = (struct program){.tape = {.n = 0}};
  elaboration_init(&p->el, (struct view){env->model, f->stable ? LAYER_STABLE : LAYER_CORRECTED, NULL, NULL}, NULL, 0);
  bool good = compile(p, f);
  num_vec_init(&p->in, p->tape.n_inputs, num_ctx_double());
  if (good) return p;
  bench_formula_close(p);
  return NULL;
}

void bench_formula_close(void *self) {
  struct program *p = self;
  num_vec_clear(&p->in);
  free(p->symbol);
  tape_clear(&p->tape);
  elaboration_clear(&p->el);
  free(p);
}

int bench_formula_run(void *self, struct num_vec *out, const double *value) {
  struct program *p = self;
  for (slong i = 0; i < p->tape.n_inputs; i++) *(double *)num_vec_at(&p->in, i) = value[p->symbol[i]];
  return tape_eval(out, NULL, &p->tape, &p->in);
}

void bench_frequencies(double *slow, double *fast, double chi, double eta) {
  double mean = 0.5 * (1 + chi * eta), product = chi * eta * (1 - chi), root = sqrt(mean * mean - product);
  *slow = sqrt(mean - root);
  *fast = sqrt(mean + root);
}
