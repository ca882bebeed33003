/* Would the audit have noticed a damaged formula?  Every claim is judged once as things stand, and what it reads is
   recorded; then each mutant is put in place and the claims that read it are asked again: with the least effort that
   can refute; by exact algebra, whether the mutant says anything else at all; in full; the kinds that take long, with
   the same little effort with which they were asked as things stood; and last the checks of loaded data, so that what
   the claims notice is measured without them.  Claims that simulate are not asked. */
#include <stdlib.h>
#include <string.h>

#include "base/crew.h"
#include "judge/judge.h"
#include "mutants.h"
#include "mutate_data.h"
#include "power.h"
#include "scene/fingerprint.h"

/* A claim as things stand: what it reads, what it says (of the kinds asked late: with little effort). */
struct reader {
  const struct claim *claim;
  struct model_use use;
  size_t weight; /* definitions read */
  struct audit_result said;
  bool asserts;
};

struct mutation_study {
  const struct model *model;
  const struct claims *claims, *controls;
  const struct scene *scene;
  struct orbit_cache *cache;
  struct reader *reader; /* the lightest first */
  size_t n_readers;
  struct overlay overlay;
  struct facts *facts;
  bool sound;    /* without damage the checks of loaded data pass */
  bool *touched; /* records */
  struct mutants mutants;
  size_t *drawn; /* indices of mutants, ascending */
  size_t n_drawn;
};

static struct judge new_judge(struct mutation_study *r, const struct model *m, struct audit_result *out,
                              enum effort effort, struct diag *d) {
  audit_result_init(out);
  diag_init(d);
  return (struct judge){
      .out = out, .model = m, .claims = r->claims, .scene = r->scene, .cache = r->cache, .d = d, .effort = effort};
}

/* --- As things stand --- */

static bool asserts(const struct audit_result *said) {
  enum verdict v = said->findings[0].verdict;
  return v != VERDICT_DEFINITION && v != VERDICT_SKIPPED;
}

static bool read_claim(struct reader *rd, struct mutation_study *r, const struct claim *c, struct diag *d) {
  *rd = (struct reader){.claim = c};
  const struct model recording = model_noting(&rd->use, r->model);
  if (claim_asked(c) == ASKED_NEVER) {
    audit_result_init(&rd->said);
    return true;
  }
  struct judge j = new_judge(r, &recording, &rd->said, claim_asked(c) == ASKED_LATE ? EFFORT_REFUTE : EFFORT_FULL, d);
  if (!judge_claim(&j, c)) return false;
  for (size_t i = 0; i < r->model->n_defs; i++) rd->weight += rd->use.def[i];
  rd->asserts = asserts(&rd->said);
  return true;
}

static int lightest_first(const void *a, const void *b) {
  const struct reader *x = a, *y = b;
  if (x->weight != y->weight) return x->weight < y->weight ? -1 : 1;
  return x->claim < y->claim ? -1 : x->claim > y->claim;
}

static bool read_all(struct mutation_study *r, struct diag *d) {
  r->reader = ss_malloc((r->claims->n + 1) * sizeof *r->reader);
  for (size_t i = 0; i < r->claims->n; i++) {
    r->n_readers++;
    if (!read_claim(&r->reader[i], r, &r->claims->claim[i], d)) return false;
  }
  if (r->n_readers) qsort(r->reader, r->n_readers, sizeof *r->reader, lightest_first);
  return true;
}

static bool reads(const struct reader *rd, const struct target *t) {
  return rd->asserts && (rd->use.record[t->record] || (t->def >= 0 && rd->use.def[t->def]));
}

/* --- One claim, one mutant --- */

enum notice { SAME, OPEN, LOST, CHANGED, BROKEN };

static bool is_diagnostic(const struct finding *f, const struct claim *c) {
  return claim_kind(c) != KIND_INDEX_RANGE && finding_is_diagnostic(f);
}

/* That a proof fails, or succeeds, is not noticed by itself. */
static bool alike(enum verdict a, enum verdict b) {
  return a == b || (verdict_passes(a) && verdict_passes(b));
}

static bool same_findings(const struct audit_result *a, const struct audit_result *b) {
  bool same = a->n_findings == b->n_findings;
  for (size_t i = 0; same && i < a->n_findings; i++) {
    const struct finding *x = &a->findings[i], *y = &b->findings[i];
    same = strcmp(x->id, y->id) == 0 && alike(x->verdict, y->verdict) && !x->correction == !y->correction &&
           (!x->correction || alike(x->correction_verdict, y->correction_verdict));
  }
  return same;
}

/* A refuted claim: whether what passed besides, its correction or a restricted claim, is refuted now. */
static enum notice quick_besides(const struct reader *rd, const struct audit_result *now) {
  const struct finding *was = &rd->said.findings[0], *is = &now->findings[0];
  if (is->verdict != VERDICT_REFUTED) return OPEN;
  if (is_diagnostic(is, rd->claim) && !is_diagnostic(was, rd->claim)) return BROKEN;
  if (was->correction && is->correction && verdict_passes(was->correction_verdict) &&
      is->correction_verdict == VERDICT_REFUTED)
    return CHANGED;
  for (size_t i = 1; i < rd->said.n_findings; i++) {
    const struct finding *f = audit_result_finding(now, rd->said.findings[i].id);
    if (verdict_passes(rd->said.findings[i].verdict) && f && f->verdict == VERDICT_REFUTED) return CHANGED;
  }
  return OPEN;
}

/* The least effort that can tell. */
static enum notice ask_quickly(struct mutation_study *r, const struct reader *rd) {
  enum verdict before = rd->said.findings[0].verdict;
  OWNED(audit_result) out;
  struct diag d;
  struct judge j = new_judge(r, &r->overlay.model, &out, EFFORT_REFUTE, &d);
  enum notice n = OPEN;
  if (verdict_fails(before) && claim_tried_at_points(rd->claim)) {
    n = judge_claim(&j, rd->claim) ? quick_besides(rd, &out) : BROKEN;
  } else {
    struct finding f;
    if (!judge_verdict(&f, &j, rd->claim))
      n = BROKEN;
    else if (f.verdict == VERDICT_REFUTED && !verdict_fails(before))
      n = is_diagnostic(&f, rd->claim) ? BROKEN : CHANGED;
  }
  return n;
}

static enum notice ask_in_full(struct mutation_study *r, const struct reader *rd) {
  OWNED(audit_result) out;
  struct diag d;
  struct judge j = new_judge(r, &r->overlay.model, &out, EFFORT_FULL, &d);
  enum notice n = BROKEN;
  if (judge_claim(&j, rd->claim)) n = same_findings(&rd->said, &out) ? SAME : CHANGED;
  return n;
}

/* Refuted or not, proved or not: what little effort says is compared with what the same effort said. */
static enum notice compare(enum verdict was, enum verdict is) {
  if ((was == VERDICT_REFUTED) != (is == VERDICT_REFUTED)) return CHANGED;
  return (was == VERDICT_PROVED) != (is == VERDICT_PROVED) ? LOST : OPEN;
}

static enum notice ask_late(struct mutation_study *r, const struct reader *rd) {
  const struct finding *was = &rd->said.findings[0];
  OWNED(audit_result) out;
  struct diag d;
  struct judge j = new_judge(r, &r->overlay.model, &out, EFFORT_REFUTE, &d);
  struct finding f;
  j.touched = r->touched;
  enum notice n = OPEN;
  if (!judge_verdict(&f, &j, rd->claim) || (is_diagnostic(&f, rd->claim) && !is_diagnostic(was, rd->claim)))
    n = BROKEN;
  else if (!f.correction != !was->correction)
    n = CHANGED;
  else
    n = compare(was->verdict, f.verdict);
  if (n == OPEN && f.correction) n = compare(was->correction_verdict, f.correction_verdict);
  return n;
}

/* --- One mutant --- */

/* Degrees and symbols: such a claim decides of itself whether it says the same, once it has been asked. */
static bool decides_exactly(const struct claim *c) {
  enum kind kind = claim_kind(c);
  return kind == KIND_SCALING || kind == KIND_NOTATION;
}

/* By exact algebra: the statement and what uses it, or every claim that reads it. */
static bool says_the_same(struct mutation_study *r, const struct target *t) {
  const struct model *damaged = &r->overlay.model;
  bool all = true, any = false;
  if (target_same_in(t, r->model, damaged, r->claims, r->facts)) return true;
  for (size_t i = 0; all && i < r->n_readers; i++) {
    if (!reads(&r->reader[i], t) || decides_exactly(r->reader[i].claim)) continue;
    any = true;
    all = claim_same_in(r->reader[i].claim, t, r->model, damaged, r->facts);
  }
  return all && any;
}

/* Asks the claims of one turn that read the target, until one notices: the fate then, else FATE_UNDECIDED. */
static enum mutant_fate ask_all(struct mutation_study *r, const struct target *t, enum asked turn,
                                enum notice (*ask)(struct mutation_study *, const struct reader *)) {
  enum mutant_fate fate = FATE_UNDECIDED;
  for (size_t i = 0; i < r->n_readers; i++) {
    if (!reads(&r->reader[i], t) || claim_asked(r->reader[i].claim) != turn) continue;
    enum notice n = ask(r, &r->reader[i]);
    if (n == BROKEN) return FATE_UNREADABLE;
    if (n == CHANGED) return FATE_NOTICED;
    if (n == LOST) fate = FATE_UNPROVED;
  }
  return fate;
}

/* By what is checked when the data are loaded. */
static bool is_refused(const struct mutation_study *r) {
  struct diag d = {0};
  return r->sound && !material_check(&(struct audit_data){&r->overlay.model, r->claims, r->controls, NULL, NULL}, &d);
}

static enum mutant_fate fate_in_place(struct mutation_study *r, const struct target *t) {
  bool any = false;
  for (size_t i = 0; !any && i < r->n_readers; i++) any = reads(&r->reader[i], t);
  if (!any) return is_refused(r) ? FATE_REFUSED : FATE_UNREAD;
  enum mutant_fate f = ask_all(r, t, ASKED_EARLY, ask_quickly);
  facts_use(r->facts, false);
  target_reaches(r->touched, r->model, t);
  if (f == FATE_UNDECIDED && target_same_in(t, r->model, &r->overlay.model, r->claims, r->facts)) f = FATE_EQUIVALENT;
  if (f == FATE_UNDECIDED) f = ask_all(r, t, ASKED_EARLY, ask_in_full);
  if (f == FATE_UNDECIDED) f = ask_all(r, t, ASKED_LATE, ask_late);
  if (f == FATE_UNDECIDED && says_the_same(r, t)) f = FATE_EQUIVALENT;
  facts_use(r->facts, true);
  if (f == FATE_UNDECIDED && is_refused(r)) f = FATE_REFUSED;
  if (f == FATE_UNDECIDED && says_the_same(r, t)) f = FATE_ON_MOTIONS;
  return f;
}

static void try_mutant(void *result, size_t i, void *arg) {
  struct mutation_study *r = arg;
  const struct mutant *m = &r->mutants.mutant[r->drawn[i]];
  const struct target *t = &r->mutants.target[m->target];
  overlay_set(&r->overlay, t, m->edit.stmt);
  enum mutant_fate f = fate_in_place(r, t);
  overlay_set(&r->overlay, t, NULL);
  memcpy(result, &f, sizeof f);
}

/* --- The report --- */

static struct mutation_row *file_row(struct mutation_result *out, const char *name) {
  for (size_t i = 0; i < out->n_files; i++)
    if (strcmp(out->file[i].name, name) == 0) return &out->file[i];
  out->file = ss_grow(out->file, out->n_files, &out->cap_files, sizeof *out->file);
  out->file[out->n_files] = (struct mutation_row){.name = arena_strdup(&out->arena, name)};
  return &out->file[out->n_files++];
}

static const char *keep(struct mutation_result *out, const char *s) {
  return arena_strdup(&out->arena, s);
}

static const char *keep_subject(struct mutation_result *out, const struct model *m, const struct scene *s) {
  struct text subject = {0};
  audit_fingerprint(&subject, m, s);
  return text_take(&out->arena, &subject);
}

static const char *readers_of(struct mutation_result *out, const struct mutation_study *r, const struct target *t) {
  struct text list = {0};
  for (size_t c = 0; c < r->claims->n; c++)
    for (size_t i = 0; i < r->n_readers; i++)
      if (r->reader[i].claim == &r->claims->claim[c] && reads(&r->reader[i], t))
        text_printf(&list, "%s%s", list.len ? ", " : "", r->claims->claim[c].id);
  return text_take(&out->arena, &list);
}

static void add_survivor(struct mutation_result *out, const struct mutation_study *r, const struct mutant *m,
                         enum mutant_fate fate) {
  const struct target *t = &r->mutants.target[m->target];
  const struct statement_record *rec = &r->model->records[t->record];
  size_t line, column;
  source_place(&line, &column, rec->src, m->edit.place.begin);
  struct survivor s = {.fate = fate,
                       .corrected = t->corrected,
                       .file = keep(out, path_base(rec->src->name)),
                       .record = keep(out, rec->record->id_name),
                       .equation = *rec->equation ? keep(out, rec->equation) : NULL,
                       .kind = edit_kind_name[m->edit.kind],
                       .line = (long)line,
                       .column = (long)column,
                       .was = keep(out, m->edit.was),
                       .now = keep(out, m->edit.now),
                       .text = keep(out, m->edit.text),
                       .read_by = readers_of(out, r, t)};
  const struct survivor *last = out->n_survivors ? &out->survivor[out->n_survivors - 1] : NULL;
  OWNED(text) original = {0};
  stmt_print(&original, rec->stmts[t->stmt]);
  bool same = last && strcmp(last->record, s.record) == 0 && strcmp(last->original, text_str(&original)) == 0;
  s.original = same ? last->original : keep(out, text_str(&original));
  if (same) s.record = last->record;
  *SS_PUSH(out->survivor, out->n_survivors, out->cap_survivors) = s;
}

static void report(struct mutation_result *out, const struct mutation_study *r, const enum mutant_fate *fate) {
  out->kind = arena_alloc(&out->arena, N_EDIT_KINDS * sizeof *out->kind);
  out->n_kinds = N_EDIT_KINDS;
  for (int k = 0; k < N_EDIT_KINDS; k++) out->kind[k].name = edit_kind_name[k];
  out->population += (long)r->mutants.n;
  out->tried += (long)r->n_drawn;
  for (size_t i = 0; i < r->n_drawn; i++) {
    const struct mutant *m = &r->mutants.mutant[r->drawn[i]];
    const struct target *t = &r->mutants.target[m->target];
    if (fate[i] >= FATE_EQUIVALENT) add_survivor(out, r, m, fate[i]);
    if (r->model->records[t->record].rank == RANK_ERRATA) {
      out->errata.count[fate[i]]++;
      continue;
    }
    if (t->corrected) out->printed.count[fate[i]]++;
    out->formulas.count[fate[i]]++;
    out->kind[m->edit.kind].count[fate[i]]++;
    file_row(out, path_base(r->model->records[t->record].src->name))->count[fate[i]]++;
  }
}

/* --- The run --- */

static void run_clear(struct mutation_study *r) {
  for (size_t i = 0; i < r->n_readers; i++) {
    model_use_clear(&r->reader[i].use);
    audit_result_clear(&r->reader[i].said);
  }
  free(r->reader);
  free(r->drawn);
  mutants_clear(&r->mutants);
  overlay_clear(&r->overlay);
  facts_free(r->facts);
  free(r->touched);
  orbit_cache_free(r->cache);
}

static bool mutate_formulas(struct mutation_result *out, struct mutation_study *r, const struct mutation_options *opt,
                            struct crew_tally *tally, struct diag *d) {
  uint64_t state = opt->seed;
  r->drawn = draw_some(&r->n_drawn, r->mutants.n, (size_t)opt->count, &state);
  tally->of += r->n_drawn;
  FREED enum mutant_fate *fate = ss_malloc((r->n_drawn + 1) * sizeof *fate);
  bool ok = r->n_drawn == 0 ||
            (read_all(r, d) && crew_results(fate, sizeof *fate, r->n_drawn, opt->jobs, try_mutant, r, tally, d));
  if (ok) report(out, r, fate);
  return ok;
}

/* Every item of --only must name something that can be damaged. */
static bool check_selection(const struct mutation_study *r, const struct damages *damages, const struct material *m,
                            const struct mutation_options *opt, struct diag *d) {
  for (int i = 0; i < opt->n_only; i++) {
    if (mutants_any(&r->mutants, r->model, opt->only[i]) || damages_any(damages, m, opt->only[i])) continue;
    return diag_set(d, "error: nothing to damage is in a file or record, or of a class, named %s", opt->only[i]);
  }
  return true;
}

static const char *keep_digest(struct mutation_result *out, const struct paper_text *text) {
  char digest[QUOTE_DIGEST];
  quote_tokens_digest(digest, &text->tokens);
  return keep(out, digest);
}

bool audit_mutate(struct mutation_result *out, const struct audit_data *data, const struct scene *scene,
                  const struct mutation_options *opt, struct diag *d) {
  const struct model *m = data->model;
  struct mutation_study r = {.model = m,
                             .claims = data->claims,
                             .controls = data->controls,
                             .scene = scene,
                             .cache = orbit_cache_new(),
                             .facts = facts_new(m)};
  OWNED(material) material;
  OWNED(damages) damages;
  r.touched = ss_malloc(m->n_records + 1);
  overlay_init(&r.overlay, m);
  mutants_init(&r.mutants, m, opt->only, opt->n_only);
  material_init(&material, data, scene);
  damages_init(&damages, &material, opt->only, opt->n_only);
  out->scene = keep(out, scene->name);
  out->subject = keep_subject(out, m, scene);
  out->seed = opt->seed;
  if (opt->text) out->text = keep_digest(out, opt->text);
  struct diag none = {0};
  r.sound = material_check(data, &none);
  struct crew_tally tally = {.tell = opt->progress, .of = mutate_data_count(&damages, opt)};
  bool ok = check_selection(&r, &damages, &material, opt, d) && mutate_formulas(out, &r, opt, &tally, d) &&
            mutate_data(out, &material, &damages, opt, &tally, d);
  run_clear(&r);
  return ok;
}
