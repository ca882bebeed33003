/* stickslip plot: the pictures of a scene's orbits alone, and the tables they are drawn from. */
#include "cli.h"
#include "mech/orbit.h"
#include "report/report.h"
#include "run/tables.h"
#include "word_orbits.h"

/* Tables, then pictures, and says which. */
static bool write_pictures(const char *folder, const struct audit_result *r, struct diag *d) {
  struct output out;
  struct text name;
  text_init(&name);
  output_init(&out, folder);
  output_add_tables(&out, r);
  for (int i = 0; i < report_pictures(); i++) {
    text_reset(&name);
    text_printf(&name, "%s.svg", report_picture_id(i));
    if (!report_picture(output_add(&out, text_str(&name)), r, i)) output_drop(&out); /* its table was not made */
  }
  bool ok = output_write(&out, d);
  for (int i = 0; ok && i < out.n; i++) puts(text_str(&out.path[i]));
  output_clear(&out);
  text_clear(&name);
  return ok;
}

/* The table of a scene that names a system file; *why: there is nothing in it. */
static bool system_tables(struct audit_result *r, const char **why, const struct scene *s, const char *data,
                          struct diag *d) {
  struct mech m;
  struct mech_word w;
  struct mech_orbits list = {.n = 0};
  bool ok = scene_load_system(&m, &w, s, data, d);
  if (ok) mech_orbits_find(&list, &m, w.n ? &w : NULL, false, system_bits(DEFAULT_DIGITS));
  if (ok && list.n) table_of_system(r, &m, &list);
  *why = ok && !list.n ? "no orbit is found" : NULL;
  mech_orbits_clear(&list);
  mech_clear(&m);
  return ok;
}

int run_plot(const struct options *o, const char *data) {
  const char *out = option(o, OPT_OUT);
  if (o->operands.n != 1) return usage("plot takes one scene%s", "");
  struct diag d;
  struct scene s;
  struct audit_result r;
  struct text folder;
  diag_init(&d);
  text_init(&folder);
  audit_result_init(&r);
  const char *why = NULL;
  bool ok = load_scene(&s, o->operands.word[0], data, o, SCENE_EXACT_OR_SYSTEM, &d) &&
            (s.system || scene_four_phases(&s, &d)) && (!out || folder_possible(out, &d));
  if (ok && s.system)
    ok = system_tables(&r, &why, &s, data, &d);
  else if (ok)
    why = audit_tables(&r, &s);
  if (why) diag_set(&d, "%s: error: nothing to draw: %s", s.path, why);
  if (ok && out)
    text_add(&folder, out);
  else if (ok)
    text_printf(&folder, "reports/%s", s.folder);
  ok = ok && !why && write_pictures(text_str(&folder), &r, &d);
  scene_clear(&s);
  audit_result_clear(&r);
  text_clear(&folder);
  return ok ? EXIT_AS_RECORDED : bad_input(&d);
}
