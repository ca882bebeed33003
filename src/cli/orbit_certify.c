/* stickslip orbit: the proof of each orbit, and --certificate. */
#include <stdlib.h>

#include "base/arena.h"
#include "cli.h"
#include "explore/family.h"
#include "motion/certify.h"

/* The scene as a question; value borrows from it. */
static void question_of(struct dyn_question *q, enum dyn_quantity which[2], fmpq value[2], const struct scene *s) {
  int n = 0;
  *q = (struct dyn_question){.model = s->value + KEY_CHI, .value = value, .which = which};
  for (int k = KEY_E1; k <= KEY_TD && n < 2; k++) {
    if (!s->given[k]) continue;
    which[n] = (enum dyn_quantity)(QUANTITY_E1 + (k - KEY_E1));
    value[n++] = s->value[k];
  }
  for (int i = 0; i < 2; i++) q->u_r[i] = s->given[KEY_U_R1 + i] ? &s->value[KEY_U_R1 + i] : NULL;
}

struct dyn_certificate *certify_orbits(struct dyn_orbits *list, const struct scene *s) {
  struct dyn_certificate *proof = ss_malloc((size_t)(list->n + 1) * sizeof *proof);
  struct dyn_question q;
  enum dyn_quantity which[2];
  fmpq value[2];
  question_of(&q, which, value, s);
  for (slong i = 0; i < list->n; i++) {
    struct dyn_orbit *o = &list->orbit[i];
    dyn_certificate_init(&proof[i]);
    dyn_certify(&proof[i], &q, o);
    if (!proof[i].certified) continue;
    o->stable = proof[i].stable;
    for (int k = 0; k < N_CONDITIONS; k++) o->holds[k] = proof[i].holds[k];
  }
  return proof;
}

void certificates_free(struct dyn_certificate *proof, slong n) {
  for (slong i = 0; i < n; i++) dyn_certificate_clear(&proof[i]);
  free(proof);
}

void print_radius(struct text *out, const struct dyn_orbit *o) {
  arb_t radius;
  arb_init(radius);
  dyn_orbit_radius(arb_radref(radius), o);
  arb_get_rad_arb(radius, radius);
  print_accuracy(out, radius);
  arb_clear(radius);
}

bool write_certificate(const char *path, const struct scene *s, const struct dyn_orbits *list,
                       const struct dyn_certificate *proof, struct diag *d) {
  struct dyn_question q;
  enum dyn_quantity which[2];
  fmpq value[2];
  slong certified = 0;
  for (slong i = 0; i < list->n; i++) certified += proof[i].certified;
  if (certified == 0) {
    diag_set(d, "%s: error: no orbit is certified, so that there is no certificate to write", s->path);
    return false;
  }
  if (certified < list->n)
    fprintf(stderr, "%s: warning: %ld of %ld orbits are certified; the others are not in the certificate\n", s->path,
            (long)certified, (long)list->n);
  question_of(&q, which, value, s);
  struct text out;
  text_init(&out);
  dyn_certificates_json(&out, s->name, &q, list, proof);
  bool written = file_write(path, out.data, out.len, d);
  text_clear(&out);
  return written;
}
