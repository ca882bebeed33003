/* stickslip plot: the pictures of a scene's orbits alone, and the tables they are drawn from. */
#include <string.h>

#include "cli.h"
#include "mech/orbit.h"
#include "report/report.h"
#include "run/tables.h"
#include "sweep.h"
#include "word_orbits.h"

/* Tables, then pictures, and says which. */
static bool write_pictures(const char *folder, const struct audit_result *r, struct diag *d) {
  OWNED(output) out;
  output_init(&out, folder);
  output_add_tables(&out, r);
  for (int i = 0; i < report_pictures(); i++)
    if (!report_picture(output_add(&out, "%s.svg", report_picture_id(i)), r, i))
      output_drop(&out); /* its table was not made */
  bool ok = output_write(&out, d);
  for (int i = 0; ok && i < out.n; i++) puts(text_str(&out.path[i]));
  return ok;
}

static bool nothing(struct diag *d, const struct scene *s, const char *why) {
  return diag_set(d, "%s: error: nothing to draw: %s", s->path, why);
}

/* The table of a scene that names a system file. */
static bool draw_system(struct audit_result *r, const struct scene *s, const char *data, struct diag *d) {
  OWNED(mech) m;
  OWNED(mech_orbits) list;
  bool ok = find_system_orbits(&m, &list, OF_ITS_WORD, s, data, DEFAULT_DIGITS, d);
  if (ok && list.n) table_of_system(r, &m, &list);
  if (ok && !list.n) ok = nothing(d, s, "no orbit is found");
  return ok;
}

/* --- Along a line, over a plane, in motion --- */

static int draw_along(struct audit_result *r, const struct scene *s, const struct options *o) {
  LOCAL(scene_range, a);
  int status = parse_along(&a, NULL, o);
  if (!status) status = range_check_friction(&a, s, "--along", option(o, OPT_ALONG));
  if (!status && table_of_bifurcations(r, s, a.vary, a.from, a.to) != SS_OK) warn_missed(s);
  return status;
}

static int parse_plane(struct scene_range range[MAX_OVER], struct dyn_axis axis[MAX_OVER], const struct scene *s,
                       const struct options *o) {
  static const struct over_rule rule = {"%s takes NAME=A:B or NAME=A:B:N, as in e2=0.5:3, not %.200s", 2,
                                        TABLE_MOST_SIDE, 97};
  const struct words *over = &o->given[OPT_OVER];
  if (over->n < MAX_OVER) return usage("plot takes --over twice, for both axes of a map");
  int status = EXIT_AS_RECORDED;
  for (int i = 0; i < MAX_OVER && !status; i++)
    status = parse_over(&range[i], &axis[i], over->word[i], i ? &range[0] : NULL, &rule);
  for (int i = 0; i < MAX_OVER && !status; i++) status = range_check_friction(&range[i], s, "--over", over->word[i]);
  return status;
}

static int draw_plane(struct audit_result *r, const struct scene *s, const struct options *o, struct diag *d) {
  struct crew_tally tally = {.tell = progress_wanted() ? progress_count : NULL};
  struct scene_range range[MAX_OVER];
  struct dyn_axis axis[MAX_OVER] = {{.n = 0}};
  int jobs, status = parse_jobs(&jobs, o);
  for (int i = 0; i < MAX_OVER; i++) scene_range_init(&range[i]);
  if (!status) status = parse_plane(range, axis, s, o);
  progress_begin();
  if (!status && !table_of_map(r, s, axis, jobs, &tally, d)) status = EXIT_INPUT;
  progress_end();
  for (int i = 0; i < MAX_OVER; i++) {
    dyn_axis_clear(&axis[i]);
    scene_range_clear(&range[i]);
  }
  return status;
}

static int draw_motion(struct audit_result *r, const struct scene *s, const struct options *o, struct diag *d) {
  slong orbit;
  bool printed;
  int status = parse_start(&orbit, &printed, o);
  if (!status && printed) return usage("plot takes --at orbit:K");
  if (!status && !scene_animation(r, s, orbit, d)) status = EXIT_INPUT;
  return status;
}

/* The pictures that are asked for by name; *any: there are some. */
static int draw_asked(struct audit_result *r, bool *any, const struct scene *s, const struct options *o,
                      struct diag *d) {
  static const enum option asked[] = {OPT_ALONG, OPT_OVER, OPT_ANIMATE};
  static const char *const name[] = {"plot --along", "plot --over", "plot --animate"};
  int status = EXIT_AS_RECORDED;
  for (int i = 0; i < 3 && !status; i++) {
    if (o->given[asked[i]].n == 0) continue;
    *any = true;
    if (s->system)
      diag_set(d, "%s: error: %s is of the paper's two masses", s->path, name[i] + strlen("plot "));
    else if (i == 2 || scene_needs_forces(s, name[i], d))
      status = i == 0 ? draw_along(r, s, o) : i == 1 ? draw_plane(r, s, o, d) : draw_motion(r, s, o, d);
    if (d->set) status = EXIT_INPUT;
  }
  return status;
}

/* The usual ones. */
static bool draw_usual(struct audit_result *r, const struct scene *s, const char *data, struct diag *d) {
  if (s->system) return draw_system(r, s, data, d);
  const char *why = audit_tables(r, s);
  return !why || nothing(d, s, why);
}

static int plot_scene(struct audit_result *r, const struct scene *s, const struct options *o, const char *data,
                      struct diag *d) {
  const char *out = option(o, OPT_OUT);
  OWNED(text) folder = {0};
  bool any = false;
  if (out && !folder_possible(out, d)) return EXIT_INPUT;
  int status = draw_asked(r, &any, s, o, d);
  if (!status && !any && !draw_usual(r, s, data, d)) status = EXIT_INPUT;
  if (status) return status;
  text_printf(&folder, "%s%s", out ? "" : "reports/", out ? out : s->folder);
  if (!write_pictures(text_str(&folder), r, d)) status = EXIT_INPUT;
  return status;
}

int run_plot(const struct options *o, const char *data, struct diag *d) {
  if (option(o, OPT_AT) && !option(o, OPT_ANIMATE)) return usage("plot takes --at with --animate alone");
  OWNED(scene) s;
  LOCAL(audit_result, r);
  bool ok =
      load_scene(&s, o->operands.word[0], data, o, SCENE_EXACT_OR_SYSTEM, d) && (s.system || scene_four_phases(&s, d));
  return ok ? plot_scene(&r, &s, o, data, d) : EXIT_INPUT;
}
