#include "precision.h"

#include <math.h>
#include <stdlib.h>

#include "stability_impl.h"
#include "value/expression.h"

/* Of the pilot, doubled while it does not know an entry to SURE bits; bits beyond what the pilot lost. */
enum { PILOT_FIRST = 64, PILOT_LAST = 256, SURE = 8, SPARE = 16, WORD = 64, STEPS = 16 };

slong precision_round(slong prec) {
  slong unit = WORD;
  while (unit * STEPS < prec) unit *= 2;
  return (prec + unit - 1) / unit * unit;
}

/* The most bits that an entry loses; NaN where that does not show.  An entry that is exactly zero loses none. */
static double most_lost(struct digits_bench *w) {
  double most = 0;
  for (slong k = 0; k < w->f->n; k++) {
    arb_srcptr v = num_vec_at(&w->b, w->f->out[k]);
    if (arb_is_zero(v)) continue;
    if (arb_rel_accuracy_bits(v) < SURE) return NAN;
    most = fmax(most, digits_amplification(w, k));
  }
  return isfinite(most) ? most : NAN;
}

/* The tape with every node an output, as the study of digits reads it. */
static struct digits_formula every_node(const struct tape *t) {
  struct digits_formula f = {.n = t->n_outputs, .tape = *t, .out = t->outputs};
  f.tape.n_outputs = t->n;
  f.tape.outputs = ss_malloc((size_t)t->n * sizeof *f.tape.outputs);
  for (slong i = 0; i < t->n; i++) f.tape.outputs[i] = i;
  return f;
}

static double lost_at(int *status, struct digits_formula *f, const struct point *p, slong prec,
                      struct orbit_cache *cache) {
  OWNED(digits_bench) w;
  bool known;
  digits_bench_init(&w, f);
  w.prec = w.b.ctx.prec = w.adjoint.ctx.prec = prec;
  *status = tape_at_point(&w.b, &known, &f->tape, p, cache);
  double lost = *status == SS_OK && known ? most_lost(&w) : NAN;
  if (!known) *status |= SS_DOMAIN; /* nor at more bits */
  return lost;
}

slong precision_planned(const struct tape *t, const struct point *p, slong bits, slong otherwise,
                        struct orbit_cache *cache) {
  struct digits_formula f = every_node(t);
  double lost = NAN;
  int status = SS_OK;
  for (slong prec = PILOT_FIRST; isnan(lost) && !(status & SS_DOMAIN) && prec <= PILOT_LAST; prec *= 2)
    lost = lost_at(&status, &f, p, prec, cache);
  free(f.tape.outputs);
  return isnan(lost) ? otherwise : precision_round(bits + (slong)ceil(lost) + SPARE);
}
