/* An equation file from any bytes: names, shapes, roots, and every scalar that comes of it as a tape, run in double and
   in balls.  Laws: refused with a message or taken without one; a tape that was built passes its own check. */
#include "model/model.h"
#include "fuzz.h"

enum { MOST_OUTPUTS = 64, MOST_NODES = 5000 };

static void run_tape(const struct tape *t, struct num_ctx ctx) {
  struct num_vec in, out;
  num_vec_init(&in, t->n_inputs, ctx);
  num_vec_init(&out, t->n_outputs, ctx);
  for (slong i = 0; i < t->n_inputs; i++) {
    fmpq_t half;
    fmpq_init(half);
    fmpq_set_si(half, 1, (ulong)(i + 2));
    ctx.type->set_q(num_vec_at(&in, i), half, ctx.prec);
    fmpq_clear(half);
  }
  tape_eval(&out, NULL, t, &in);
  num_vec_clear(&in);
  num_vec_clear(&out);
}

static void compile(const struct model *m, const struct definition *def) {
  struct elaboration el;
  struct matrix value;
  struct tape t;
  struct diag d = {0};
  elaboration_init(&el, (struct view){m, LAYER_PRINTED, NULL, NULL}, NULL, 0);
  bool ok = elaborate_text(&value, &el, def->name, def->name, def->section, &d);
  fuzz_law(ok != d.set, "a name has a value, or there is a message");
  slong n = ok ? (slong)value.rows * value.cols : 0;
  if (ok && n <= MOST_OUTPUTS && el.pool.n <= MOST_NODES && elaboration_tape(&t, &el, value.e, n, &d)) {
    tape_check(&t);
    run_tape(&t, num_ctx_double());
    run_tape(&t, num_ctx_arb(64));
    tape_clear(&t);
  }
  elaboration_clear(&el);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  LOCAL(model, m);
  struct diag d = {0};
  bool ok = model_add_file(&m, fuzz_file(".eq", data, size), RANK_PAPER, &d);
  fuzz_law(ok != d.set, "a file is taken, or there is a message");
  ok = ok && view_check((struct view){&m, LAYER_PRINTED, NULL, NULL}, &d);
  for (size_t i = 0; ok && i < m.n_defs; i++)
    if (m.defs[i].stmt->kind == STMT_DEFINE && !m.defs[i].stmt->param) compile(&m, &m.defs[i]);
  return 0;
}
