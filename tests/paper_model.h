/* The paper's files as the tests read them: equations in layers, claims, the scene of its example. */
#ifndef STICKSLIP_TESTS_PAPER_MODEL_H
#define STICKSLIP_TESTS_PAPER_MODEL_H

#include "claim/claims.h"
#include "judge/judge.h"
#include "model/model.h"
#include "record/result.h"
#include "run/audit.h"
#include "scene/scene.h"
#include "value/point.h"

/* Files besides the paper's, by path, or in place of those of verify/; all NULL: the paper with its corrections. */
struct paper_layers {
  const char *paper;   /* a folder in place of verify/paper */
  const char *overlay; /* over the paper, as a user gives one */
  const char *errata;  /* in place of verify/errata.eq; "": none */
  const char *stable;  /* forms of the stable layer; else none */
  bool controls;       /* with the records of the controls */
};

/* To be cleared.  with: NULL as {0}.  paper_model fails the test that gives a file at fault, paper_model_read says
   why. */
struct model paper_model(const struct paper_layers *with);
bool paper_model_read(struct model *m, const struct paper_layers *with, struct diag *d);

/* The claims on file, and the controls unless these are NULL.  To be cleared. */
void paper_claims(struct claims *claims, struct claims *controls);
/* Of this name, or at this path; fails the test where there is none.  To be cleared. */
struct scene scene_at(const char *spec);

/* All of it at once, with the records of the controls, beside a scratch folder: fixtures. */
extern struct paper_on_file {
  struct model model;
  struct claims claims, controls, statements, roots;
  struct scene scene;
  struct orbit_cache *cache;
} the_paper;
void paper_open(void);
void paper_close(void);

/* Judges claims of a test's own, those that `only` selects, without the studies of a whole audit; false with d set when
   they are at fault.  r is to be cleared in either case. */
bool judge_text(struct audit_result *r, const struct model *m, const char *text, const struct scene *s,
                const char *only, struct diag *d);

/* What the program gives an audit that is asked for these claims, or for all where n_only is 0, but for the costs. */
struct audit_options paper_options(const char *const *only, int n_only, int jobs);

/* Judges the claims on file that `only` selects, without any control; to be cleared. */
struct audit_result judge_only(const struct model *m, const char *only);

/* Points by sampler_init. */
struct sampler sampler_of(const char *id, struct point_spec spec);

/* A judge of the paper's claims under a model, with its example's scene and orbits; d is where it says what is wrong,
   out is to be cleared. */
struct judge paper_judge(struct audit_result *out, const struct model *m, struct diag *d, enum effort effort);

/* By its id; fails the test where there is none. */
const struct claim *claim_with_id(const struct claims *all, const char *id);
const struct claim *paper_claim(const char *id); /* of the_paper */
const struct statement_record *record_with_id(const struct model *m,
                                              const char *id); /* the paper's, not a correction */
const struct finding *finding_with_id(const struct audit_result *r, const char *id);
/* Whether the note of some evidence, or the effect, contains the words, or a value of the certificate is they. */
bool finding_says(const struct finding *f, const char *words);

#endif
