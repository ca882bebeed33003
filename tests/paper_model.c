#include "paper_model.h"
#include "record/result.h"

#include <check.h>
#include <string.h>

bool paper_model_read(struct model *m, const struct paper_layers *with, struct diag *d) {
  const struct paper_layers plain = {.paper = NULL}, *w = with ? with : &plain;
  const char *errata = w->errata ? w->errata : "verify/errata.eq";
  diag_init(d);
  model_init(m);
  return model_add_folder(m, w->paper ? w->paper : "verify/paper", RANK_PAPER, d) &&
         (!w->overlay || model_add_file(m, w->overlay, RANK_USER, d)) &&
         (!*errata || model_add_file(m, errata, RANK_ERRATA, d)) &&
         (!w->stable || model_add_file(m, w->stable, RANK_STABLE, d)) &&
         (!w->controls || model_add_folder(m, "verify/controls", RANK_CONTROL, d));
}

void paper_model(struct model *m, const struct paper_layers *with) {
  struct diag d;
  ck_assert_msg(paper_model_read(m, with, &d), "%s", d.message);
}

void paper_claims(struct claims *claims, struct claims *controls) {
  struct diag d;
  diag_init(&d);
  *claims = (struct claims){.n = 0};
  ck_assert_msg(claims_load(claims, "verify/claims", "claim", &d), "%s", d.message);
  if (!controls) return;
  *controls = (struct claims){.n = 0};
  ck_assert_msg(claims_load(controls, "verify/controls", "control", &d), "%s", d.message);
}

void paper_scene(struct scene *s) {
  struct diag d;
  diag_init(&d);
  ck_assert_msg(scene_load(s, "paper", "verify", &d), "%s", d.message);
}

int paper_value(fmpz_mpoly_q_struct *z, struct exact_field *f, const struct model *of, const char *text) {
  struct elaboration el;
  struct matrix m;
  struct tape t;
  struct diag d;
  struct exact_vec v;
  diag_init(&d);
  elaboration_init(&el, (struct view){of, LAYER_CORRECTED, NULL, NULL}, NULL, 0);
  ck_assert_msg(elaborate_tape(&t, &m, &el, "test", text, "", &d), "%s", d.message);
  int s = exact_eval(&v, f, &t);
  if (s == SS_OK) num_exact.set(z, &v.x[0]);
  exact_vec_clear(&v);
  tape_clear(&t);
  elaboration_clear(&el);
  return s;
}

const struct claim *claim_with_id(const struct claims *all, const char *id) {
  for (size_t i = 0; i < all->n; i++)
    if (strcmp(all->claim[i].id, id) == 0) return &all->claim[i];
  ck_abort_msg("no claim %s", id);
}

const struct finding *finding_with_id(const struct audit_result *r, const char *id) {
  for (size_t i = 0; i < r->n_findings; i++)
    if (strcmp(r->findings[i].id, id) == 0) return &r->findings[i];
  ck_abort_msg("no finding %s", id);
}
