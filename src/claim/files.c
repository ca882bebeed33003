/* The files of a data folder besides its scenes, loaded together. */
#include "claim.h"

void paper_files_init(struct paper_files *f) {
  *f = (struct paper_files){.claims = {.n = 0}};
  model_init(&f->model);
}

bool paper_files_load(struct paper_files *f, const char *data, const char *paper, const char *overlay, struct diag *d) {
  return model_load(&f->model, data, paper, overlay, d) && claims_load(&f->claims, data, "claims", "claim", d) &&
         claims_load(&f->controls, data, "controls", "control", d) &&
         claims_load(&f->statements, data, "paper", "statement", d) &&
         claims_load(&f->roots, data, "claims", "root", d) && claims_complete(&f->claims, &f->statements, d);
}

void paper_files_clear(struct paper_files *f) {
  claims_clear(&f->roots);
  claims_clear(&f->statements);
  claims_clear(&f->controls);
  claims_clear(&f->claims);
  model_clear(&f->model);
}
