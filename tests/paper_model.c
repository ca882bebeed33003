#include "paper_model.h"
#include "local.h"
#include "says.h"
#include "scratch.h"

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

struct model paper_model(const struct paper_layers *with) {
  struct model m;
  goes_well(paper_model_read(&m, with, &d));
  return m;
}

static void on_file(struct claims *all, const char *folder, const char *word) {
  *all = (struct claims){.n = 0};
  goes_well(claims_load(all, "verify", folder, word, &d));
}

void paper_claims(struct claims *claims, struct claims *controls) {
  static struct claims statements; /* their words are the claims' */
  on_file(claims, "claims", "claim");
  if (!statements.n) on_file(&statements, "paper", "statement");
  goes_well(claims_complete(claims, &statements, &d));
  if (controls) on_file(controls, "controls", "control");
}

/* The paper's statements and the roots of its discrepancies, with which an audit says what the program says. */
static void paper_statements(struct claims *statements, struct claims *roots) {
  on_file(statements, "paper", "statement");
  on_file(roots, "claims", "root");
}

struct scene scene_at(const char *spec) {
  struct scene s;
  goes_well(scene_load_with(&s, spec, "verify", NULL, SCENE_EXACT, &d));
  return s;
}

struct paper_on_file the_paper;

void paper_open(void) {
  scratch_open();
  the_paper.model = paper_model(&(struct paper_layers){.controls = true});
  paper_claims(&the_paper.claims, &the_paper.controls);
  paper_statements(&the_paper.statements, &the_paper.roots);
  the_paper.scene = scene_at("paper");
  the_paper.cache = orbit_cache_new();
}

void paper_close(void) {
  orbit_cache_free(the_paper.cache);
  scene_clear(&the_paper.scene);
  claims_clear(&the_paper.roots);
  claims_clear(&the_paper.statements);
  claims_clear(&the_paper.controls);
  claims_clear(&the_paper.claims);
  model_clear(&the_paper.model);
  scratch_close();
}

bool judge_text(struct audit_result *r, const struct model *m, const char *text, const struct scene *s,
                const char *only, struct diag *d) {
  OWNED(claims) claims = {.n = 0};
  struct claims none = {.n = 0};
  const struct audit_options opt = {.only = &only, .n_only = 1};
  diag_init(d);
  audit_result_init(r);
  return claims_add_file(&claims, scratch_put("own.claim", text), "claim", d) &&
         audit_run(r, m, &claims, &none, s, &opt, d);
}

struct audit_options paper_options(const char *const *only, int n_only, int jobs) {
  return (struct audit_options){.only = only,
                                .n_only = n_only,
                                .readings = true,
                                .jobs = jobs,
                                .statements = &the_paper.statements,
                                .roots = &the_paper.roots};
}

struct audit_result judge_only(const struct model *m, const char *only) {
  const struct claims none = {.n = 0};
  const struct audit_options opt = {.only = &only, .n_only = 1};
  struct audit_result r;
  audit_result_init(&r);
  goes_well(audit_run(&r, m, &the_paper.claims, &none, &the_paper.scene, &opt, &d));
  return r;
}

struct sampler sampler_of(const char *id, struct point_spec spec) {
  struct sampler s;
  sampler_init(&s, id, &spec);
  return s;
}

struct judge paper_judge(struct audit_result *out, const struct model *m, struct diag *d, enum effort effort) {
  audit_result_init(out);
  diag_init(d);
  return (struct judge){.out = out,
                        .model = m,
                        .claims = &the_paper.claims,
                        .scene = &the_paper.scene,
                        .cache = the_paper.cache,
                        .d = d,
                        .effort = effort};
}

const struct claim *claim_with_id(const struct claims *all, const char *id) {
  for (size_t i = 0; i < all->n; i++)
    if (strcmp(all->claim[i].id, id) == 0) return &all->claim[i];
  ck_abort_msg("no claim %s", id);
}

const struct claim *paper_claim(const char *id) {
  return claim_with_id(&the_paper.claims, id);
}

const struct statement_record *record_with_id(const struct model *m, const char *id) {
  for (size_t i = 0; i < m->n_records; i++)
    if (m->records[i].rank <= RANK_USER && strcmp(m->records[i].id, id) == 0) return &m->records[i];
  ck_abort_msg("no record %s", id);
}

const struct finding *finding_with_id(const struct audit_result *r, const char *id) {
  for (size_t i = 0; i < r->n_findings; i++)
    if (strcmp(r->findings[i].id, id) == 0) return &r->findings[i];
  ck_abort_msg("no finding %s", id);
}

bool finding_says(const struct finding *f, const char *words) {
  for (int i = 0; i < f->n_evidence; i++)
    if (f->evidence[i].note && strstr(f->evidence[i].note, words)) return true;
  for (int i = 0; i < f->certificate.n; i++)
    if (strcmp(f->certificate.at[i].value, words) == 0) return true;
  return f->effect && strstr(f->effect, words);
}
