/* A damage in place: load, check, judge what it concerns, and compare with what was said without it. */
#include "damage_study.h"

#include <stdlib.h>
#include <string.h>

#include "judge/judge.h"

/* A claim without damage: its findings, and what it reads. */
struct undamaged {
  bool judged, readable;
  struct audit_result said;
  struct model_use use;
};

struct damage_study {
  const struct material *m;
  const struct paper_text *text;
  struct orbit_cache *cache; /* no orbit depends on a formula of the paper, so that one serves every damage */
  struct undamaged *claim;
};

struct damage_study *damage_study_new(const struct material *m, const struct paper_text *text) {
  struct damage_study *s = ss_malloc(sizeof *s);
  *s = (struct damage_study){.m = m, .text = text, .cache = orbit_cache_new()};
  s->claim = ss_malloc((m->data.claims->n + 1) * sizeof *s->claim);
  memset(s->claim, 0, (m->data.claims->n + 1) * sizeof *s->claim);
  return s;
}

void damage_study_free(struct damage_study *s) {
  for (size_t i = 0; i < s->m->data.claims->n; i++) {
    if (!s->claim[i].judged) continue;
    audit_result_clear(&s->claim[i].said);
    model_use_clear(&s->claim[i].use);
  }
  free(s->claim);
  orbit_cache_free(s->cache);
  free(s);
}

/* --- Judging --- */

/* One claim, or the control beside it, with everything as in this material. */
static bool judge_one(struct audit_result *out, struct damage_study *s, const struct changed_material *of,
                      const struct claim *c, const struct claim *control, struct diag *d) {
  struct judge j = {
      .out = out, .model = of->data.model, .claims = of->data.claims, .scene = of->scene, .cache = s->cache, .d = d};
  return control ? judge_control(&j, control, c) : judge_claim(&j, c);
}

static const struct undamaged *undamaged_claim(struct damage_study *s, size_t i) {
  struct undamaged *u = &s->claim[i];
  if (u->judged) return u;
  const struct model recording = model_noting(&u->use, s->m->data.model);
  struct diag d = {0};
  audit_result_init(&u->said);
  u->judged = true;
  const struct changed_material none = {.data = {&recording, s->m->data.claims, s->m->data.controls, NULL, NULL},
                                        .scene = s->m->scene};
  u->readable = judge_one(&u->said, s, &none, &s->m->data.claims->claim[i], NULL, &d);
  return u;
}

/* --- What is said --- */

/* The first line, without the folder of the file that it begins with. */
SS_PRINTF(3, 4) static void say(struct damage_said *out, enum mutant_fate fate, const char *fmt, ...) {
  LOCAL(arena, a);
  va_list ap;
  va_start(ap, fmt);
  const char *message = arena_vprintf(&a, fmt, ap);
  va_end(ap);
  size_t line = strcspn(message, "\n"), word = strcspn(message, " \n"), folder = 0;
  for (size_t i = 0; i < word; i++)
    if (message[i] == '/' && message[word - 1] == ':') folder = i + 1;
  size_t most = line - folder < DAMAGE_WORDS ? line - folder : DAMAGE_WORDS - 1;
  *out = (struct damage_said){.fate = fate};
  memcpy(out->says, message + folder, text_valid_prefix(message + folder, most));
}

static bool differs(struct damage_said *out, const char *id, const char *what, enum verdict is, enum verdict was) {
  if (is == was) return false;
  say(out, FATE_NOTICED, "%s%s: %s, undamaged %s", id, what, is < N_VERDICTS ? verdict_name[is] : "none",
      was < N_VERDICTS ? verdict_name[was] : "none");
  return true;
}

static enum verdict own_verdict(const struct finding *f) {
  return f ? f->verdict : N_VERDICTS;
}

static enum verdict correction_verdict(const struct finding *f) {
  return f && f->correction ? f->correction_verdict : N_VERDICTS;
}

/* As a run of the audit says that a verdict is not the one on record. */
static bool off_record(struct damage_said *out, const struct finding *is, const struct finding *was) {
  if (!is || is->recorded == N_VERDICTS || is->recorded == is->verdict || (was && was->recorded != was->verdict))
    return false;
  say(out, FATE_NOTICED, "%s: %s, recorded as %s", is->id, verdict_name[is->verdict], verdict_name[is->recorded]);
  return true;
}

/* Of the findings in either list. */
static bool findings_differ(struct damage_said *out, const struct audit_result *is, const struct audit_result *was) {
  const struct audit_result *both[] = {is, was};
  for (int k = 0; k < 2; k++)
    for (size_t i = 0; i < both[k]->n_findings; i++) {
      const char *id = both[k]->findings[i].id;
      const struct finding *x = audit_result_finding(is, id), *y = audit_result_finding(was, id);
      if (differs(out, id, "", own_verdict(x), own_verdict(y)) ||
          differs(out, id, ", its correction", correction_verdict(x), correction_verdict(y)) || off_record(out, x, y))
        return true;
    }
  return false;
}

/* --- Claims and controls with the damage in place --- */

static bool claim_notices(struct damage_said *out, struct damage_study *s, const struct changed_material *c,
                          const struct claim *claim) {
  const struct claim *before = claim_named(s->m->data.claims, claim->id);
  const struct undamaged *u = before ? undamaged_claim(s, (size_t)(before - s->m->data.claims->claim)) : NULL;
  if (!u || !u->readable) return false;
  LOCAL(audit_result, r);
  struct diag d = {0};
  bool noticed = true;
  if (!judge_one(&r, s, c, claim, NULL, &d))
    say(out, FATE_UNREADABLE, "%s", d.message);
  else
    noticed = findings_differ(out, &r, &u->said);
  return noticed;
}

static bool is_far(struct damage_said *out, const struct control_result *c) {
  if (!control_is_far(c)) return false;
  say(out, FATE_NOTICED, "%s is %s from what it damages, and says %s", c->id, c->distance, c->near);
  return true;
}

static bool control_notices(struct damage_said *out, struct damage_study *s, const struct changed_material *c,
                            const struct claim *control) {
  const struct claim *claim = claim_named(c->data.claims, claim_get(control, "claim"));
  struct diag d = {0};
  if (!claim) {
    claim_mistake(control, "claim", &d, "a control names the claim that it damages");
    say(out, FATE_REFUSED, "%s", d.message);
    return true;
  }
  LOCAL(audit_result, r);
  bool noticed = true;
  if (!judge_one(&r, s, c, claim, control, &d))
    say(out, FATE_UNREADABLE, "%s", d.message);
  else
    noticed = r.n_controls > 0 &&
              (differs(out, control->id, "", r.controls[0].verdict, VERDICT_REFUTED) || is_far(out, &r.controls[0]));
  return noticed;
}

static bool controls_notice(struct damage_said *out, struct damage_study *s, const struct changed_material *c,
                            const char *claim) {
  for (size_t i = 0; i < c->data.controls->n; i++) {
    const struct claim *control = &c->data.controls->claim[i];
    if (claim_says(control, "claim", claim) && control_notices(out, s, c, control)) return true;
  }
  return false;
}

/* --- What is concerned --- */

static bool same_statements(const struct statement_record *a, const struct statement_record *b) {
  bool same = a->n_stmts == b->n_stmts;
  OWNED(text) x = {0}, y = {0};
  for (int k = 0; same && k < a->n_stmts; k++) {
    text_reset(&x);
    text_reset(&y);
    stmt_print(&x, a->stmts[k]);
    stmt_print(&y, b->stmts[k]);
    same = strcmp(text_str(&x), text_str(&y)) == 0;
  }
  return same;
}

static bool readers_notice(struct damage_said *out, struct damage_study *s, const struct changed_material *c,
                           size_t record) {
  for (size_t i = 0; i < s->m->data.claims->n; i++)
    if (model_use_has(&undamaged_claim(s, i)->use, s->m->data.model, record) &&
        claim_notices(out, s, c, &s->m->data.claims->claim[i]))
      return true;
  return false;
}

static bool equations_notice(struct damage_said *out, struct damage_study *s, const struct changed_material *c,
                             const struct damage *d) {
  const struct model *was = s->m->data.model, *is = c->data.model;
  const struct record_file *file = s->m->file[d->file].parsed;
  if (s->m->file[d->file].rank == RANK_CONTROL) {
    const struct claim *control = claim_named(s->m->data.controls, d->record);
    return control && control_notices(out, s, c, control);
  }
  for (size_t i = 0; i < was->n_records && i < is->n_records; i++)
    if (was->records[i].src == &file->src && strcmp(was->records[i].record->id_name, d->record) == 0 &&
        !same_statements(&was->records[i], &is->records[i]))
      return readers_notice(out, s, c, i);
  return false;
}

static bool scene_notices(struct damage_said *out, struct damage_study *s, const struct changed_material *c) {
  for (size_t i = 0; i < s->m->data.claims->n; i++) {
    const struct claim *claim = &s->m->data.claims->claim[i];
    if (claim_of_scene(claim) && claim_notices(out, s, c, claim)) return true;
  }
  return false;
}

static bool is_noticed(struct damage_said *out, struct damage_study *s, const struct changed_material *c,
                       const struct damage *d) {
  const struct claim *claim = claim_named(c->data.claims, d->record);
  const struct claim *control = claim_named(c->data.controls, d->record);
  switch (s->m->file[d->file].part) {
  case PART_EQUATIONS:
    return equations_notice(out, s, c, d);
  case PART_CLAIMS:
    return claim && (claim_notices(out, s, c, claim) || controls_notice(out, s, c, claim->id));
  case PART_CONTROLS:
    return control && control_notices(out, s, c, control);
  case PART_SCENE:
    return scene_notices(out, s, c);
  }
  return false;
}

/* --- One damage --- */

/* Whether a quotation is not found in the paper's text; says which. */
static bool is_misquoted(struct damage_said *out, const struct damage_study *s, const struct changed_material *c) {
  OWNED(quotations) q;
  struct source scene;
  OWNED(text) where = {0};
  struct diag diag = {0};
  source_from_string(&scene, c->scene->source[0]->name, c->scene->source[0]->text);
  bool ok = quotations_collect(&q, &c->data, &diag);
  if (!ok) source_clear(&scene);
  ok = ok && quotations_add_scene(&q, c->data.claims, scene, &diag);
  if (ok) quotations_compare(&q, &s->text->tokens);
  bool missed = ok && !quotations_report(&where, &q, s->text);
  if (missed || !ok) say(out, FATE_REFUSED, "%s", ok ? text_str(&where) : diag.message);
  return missed || !ok;
}

static bool is_refused(struct damage_said *out, struct changed_material *c, const struct damage_study *s,
                       const struct damage *d) {
  OWNED(text) t = {0};
  struct diag diag = {0};
  damage_text(&t, s->m, d);
  bool ok = material_change(c, s->m, d->file, text_str(&t), &diag) && material_check(&c->data, &diag);
  if (!ok) say(out, FATE_REFUSED, "%s", diag.message);
  return !ok || (s->text && is_misquoted(out, s, c));
}

void damage_try(struct damage_said *out, struct damage_study *s, const struct damage *d) {
  struct changed_material c;
  bool in_text = !s->text && (d->class == DAMAGE_QUOTATION || d->class == DAMAGE_PRINTED);
  *out = (struct damage_said){.fate = in_text ? FATE_NEEDS_TEXT : FATE_UNDECIDED};
  if (d->rule) {
    say(out, FATE_EQUIVALENT, "%s", d->rule);
    return;
  }
  bool titled = d->class == DAMAGE_TITLE; /* no judge reads a title */
  bool noticed = is_refused(out, &c, s, d) || (!titled && is_noticed(out, s, &c, d));
  if (!noticed && d->excuse) say(out, FATE_EQUIVALENT, "%s", d->excuse);
  changed_material_clear(&c);
}
