/* stickslip mutate and repair: damage to formulas and to what stands beside them, and edits that undo it. */
#include <string.h>

#include "cli.h"
#include "power/power.h"
#include "report/mutation.h"
#include "value/title.h"

static int parse_mutation(struct mutation_options *q, const struct options *o) {
  const char *seed = option(o, OPT_SEED), *count = option(o, OPT_COUNT);
  unsigned long long n = DEFAULT_COUNT;
  *q = (struct mutation_options){.seed = 1, .only = o->given[OPT_ONLY].word, .n_only = o->given[OPT_ONLY].n};
  if (seed && !parse_whole(&q->seed, seed, true, ~0ULL))
    return usage("--seed takes a whole number from 0 to %llu, not %.200s", ~0ULL, seed);
  if (count && strcmp(count, "all") == 0)
    n = 0;
  else if (count && !parse_whole(&n, count, false, MAX_COUNT))
    return usage("--count takes a whole number from 1 to %d, or all, not %.200s", MAX_COUNT, count);
  q->count = (long)n;
  return parse_jobs(&q->jobs, o);
}

/* Writes the files, JSON first, where there is a folder; prints the JSON or the text. */
static void deliver(const struct output *out, const struct text *text, const struct options *o, struct diag *d) {
  const char *folder = option(o, OPT_OUT);
  if (folder && !output_write(out, d)) return;
  fputs(text_str(option(o, OPT_JSON) ? &out->body[0] : text), stdout);
  if (folder) say_written(o, folder);
}

/* The roots are no part of it: no damage touches them. */
static struct audit_data searched(const struct paper_files *f) {
  return (struct audit_data){&f->model, &f->claims, &f->controls, &f->statements, NULL};
}

static bool load(struct inputs *in, const char *data, const struct options *o, struct diag *d) {
  const struct audit_data all = searched(&in->files);
  return inputs_load(in, data, o, d) && data_check(&all, d) && titles_check(all.model, all.claims, d);
}

/* A text of the paper in which everything that is quoted is found. */
static bool load_text(struct paper_text *t, const char *path, const struct audit_data *all, struct diag *d) {
  OWNED(quotations) q = {.n = 0};
  OWNED(text) says = {0};
  bool ok = paper_text_read(t, path, d) && quotations_collect(&q, all, d);
  if (ok) quotations_compare(&q, &t->tokens);
  if (ok && !quotations_report(&says, &q, t))
    ok = diag_set(d, "%.300s: error: not all that is quoted is found in this text; see stickslip quotes", path);
  return ok;
}

int run_mutate(const struct options *o, const char *data, struct diag *d) {
  const char *folder = option(o, OPT_OUT);
  struct mutation_options q;
  int status = parse_mutation(&q, o);
  if (status) return status;
  OWNED(inputs) in;
  LOCAL(mutation_result, r);
  OWNED(output) out;
  OWNED(text) said = {0};
  output_init(&out, folder ? folder : "");
  const struct audit_data all = searched(&in.files);
  q.progress = progress_count;
  progress_begin();
  OWNED(paper_text) text = {.tokens = {.n = 0}};
  q.text = option(o, OPT_TEXT) ? &text : NULL;
  bool ok = load(&in, data, o, d) && (!folder || folder_possible(folder, d)) &&
            (!q.text || load_text(&text, option(o, OPT_TEXT), &all, d)) && audit_mutate(&r, &all, &in.scene, &q, d);
  progress_end();
  if (ok) {
    report_mutation_json(output_add(&out, "mutation.json"), &r);
    report_mutation_markdown(output_add(&out, "mutation.md"), &r);
    report_mutation_text(&said, &r);
    deliver(&out, &said, o, d);
  }
  if (r.broken) status = EXIT_INTERNAL;
  return status;
}

int run_repair(const struct options *o, const char *data, struct diag *d) {
  const char *folder = option(o, OPT_OUT);
  int jobs, status = parse_jobs(&jobs, o);
  if (status) return status;
  OWNED(inputs) in;
  OWNED(repair_result) r = {.n = 0};
  OWNED(output) out;
  OWNED(text) said = {0};
  output_init(&out, folder ? folder : "");
  struct repair_options opt = {
      .only = o->operands.word, .n_only = o->operands.n, .jobs = jobs, .progress = progress_count};
  progress_begin();
  bool ok = load(&in, data, o, d) && (!folder || folder_possible(folder, d)) &&
            audit_repairs(&r, &in.files.model, &in.files.claims, &in.scene, &opt, d);
  progress_end();
  if (ok) {
    report_repairs_json(output_add(&out, "repairs.json"), &r);
    report_repairs_markdown(output_add(&out, "repairs.md"), &r);
    report_repairs_text(&said, &r);
    deliver(&out, &said, o, d);
  }
  if (r.broken) status = EXIT_INTERNAL;
  return status;
}
