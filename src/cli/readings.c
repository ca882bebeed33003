/* stickslip readings: how the printed numbers of a scene could have arisen. */
#include "cli.h"
#include "readings/study.h"
#include "report/report.h"

int run_readings(const struct options *o, const char *data, struct diag *d) {
  LOCAL(model, m);
  OWNED(scene) s;
  LOCAL(audit_result, r);
  struct text out = {0};
  bool ok = load_scene(&s, o->operands.word[0], data, o, SCENE_EXACT, d) && load_model(&m, data, o, d);
  const char *why = ok ? audit_readings(&r, &m, &s) : NULL;
  if (why) ok = diag_set(d, "%s: error: no readings: %s", s.path, why);
  r.scene = s.name;
  if (ok && option(o, OPT_JSON))
    report_readings_json(&out, &r);
  else if (ok)
    report_readings_markdown(&out, r.readings);
  if (ok && !option(o, OPT_JSON) && !scene_is_example(&s)) {
    text_printf(&out, "These are the printed numbers of %s, whose data are ", s.name);
    scene_data_print(&out, &s);
    text_add(&out, ", but for those that the readings take from the printed numbers.\n");
  }
  if (ok) print_text(&out);
  return EXIT_AS_RECORDED;
}
