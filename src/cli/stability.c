/* stickslip stability: where formulas lose digits. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "cli.h"
#include "report/stability.h"
#include "stability/digits.h"

static int parse_study(struct stability_options *q, const struct options *o) {
  const char *against = option(o, OPT_AFTER);
  int layer = LAYER_PRINTED, after = -1;
  int status = parse_word(&layer, o, OPT_LAYER, layer_name, N_LAYERS);
  if (!status) status = parse_word(&after, o, OPT_AFTER, layer_name, N_LAYERS);
  if (!status && against && after == layer) status = usage("--after takes another layer than --layer, not %s", against);
  if (!status && option(o, OPT_AT) && o->operands.n == 0) status = usage("--at needs the name of a formula");
  *q = (struct stability_options){.layer = (enum layer)layer,
                                  .after = after,
                                  .only = o->operands.word,
                                  .n_only = o->operands.n,
                                  .quick = option(o, OPT_QUICK),
                                  .progress = progress_count};
  return status ? status : parse_jobs(&q->jobs, o);
}

/* What an earlier study has left in the folder: maps from this number on, up to the first without one. */
static bool remove_maps(const char *folder, int from, struct diag *d) {
  static const char *const suffix[] = {"tsv", "svg"};
  OWNED(text) path = {0};
  char name[32];
  bool ok = true, any = true;
  for (int i = from; ok && any; i++) {
    any = false;
    for (size_t k = 0; ok && k < sizeof suffix / sizeof *suffix; k++) {
      snprintf(name, sizeof name, "map-%d.%s", i, suffix[k]);
      text_reset(&path);
      join_path(&path, folder, name);
      bool gone = remove(text_str(&path)) == 0;
      any = any || gone;
      ok = gone || errno == ENOENT;
      if (!ok) diag_set(d, "%s: error: cannot be removed", text_str(&path));
    }
  }
  return ok;
}

static bool write_files(const char *folder, const struct stability_result *r, struct diag *d) {
  OWNED(output) out;
  char name[32];
  output_init(&out, folder);
  bool ok = folder_make(folder, d);
  for (int i = 0; i < r->n_maps; i++) {
    snprintf(name, sizeof name, "map-%d", i + 1);
    report_stability_map_tsv(output_add(&out, "%s.tsv", name), r, i);
    report_stability_picture(output_add(&out, "%s.svg", name), r, i, name);
  }
  report_stability_markdown(output_add(&out, "ledger.md"), r);
  report_stability_tsv(output_add(&out, "ledger.tsv"), r);
  report_stability_json(output_add(&out, "stability.json"), r);
  return ok && output_write(&out, d) && remove_maps(folder, r->n_maps + 1, d);
}

static void study(const struct model *m, const struct stability_options *q, const struct options *o, struct diag *d) {
  const char *folder = option(o, OPT_OUT);
  OWNED(stability_result) r = {.quick = false};
  struct text body = {0};
  progress_begin();
  bool ok = (!folder || folder_possible(folder, d)) && audit_stability(&r, m, q, d);
  progress_end();
  ok = ok && (!folder || write_files(folder, &r, d));
  if (ok) (option(o, OPT_JSON) ? report_stability_json : report_stability_text)(&body, &r);
  if (ok) print_text(&body);
  if (ok && folder) say_written(o, folder);
}

static void show_point(const struct model *m, const struct stability_options *q, const char *at, struct diag *d) {
  OWNED(text) body = {0};
  bool ok = audit_stability_at(&body, m, q, at, d);
  if (ok) print_text(&body);
}

int run_stability(const struct options *o, const char *data, struct diag *d) {
  const char *at = option(o, OPT_AT);
  struct stability_options q;
  int status = parse_study(&q, o);
  if (status) return status;
  LOCAL(model, m);
  bool ok = load_model(&m, data, o, d);
  if (ok && at) show_point(&m, &q, at, d);
  if (ok && !at) study(&m, &q, o, d);
  return EXIT_AS_RECORDED;
}
