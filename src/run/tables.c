/* The tables behind the pictures: which there are. */
#include "tables.h"

#include "judge/judge.h"
#include "value/printed.h"

/* NULL, or why there is nothing to be drawn. */
static const char *source_init(struct table_source *s, struct judge *j, struct point *p) {
  *s = (struct table_source){.j = j, .point = p};
  num_vec_init(&s->params, N_PARAMS, num_ctx_arb(FIRST_PREC));
  if (scene_is_box(j->scene)) return "the scene gives intervals";
  if (!nearest_orbit_point(p, j->scene, j->cache)) return "the scene has no orbit";
  s->list = scene_orbits(j->scene, j->cache);
  s->orbit = &s->list->orbit[p->orbit];
  if (s->orbit->grazing) return "two events of the orbit coincide, or one is double";
  if (scene_numbers(&s->params, j) != SS_OK) return "its parameters cannot be enclosed";
  for (int i = 0; i < N_PARAMS; i++) s->near[i] = num_arb.get_d(num_vec_at(&s->params, i));
  const struct printed_number *z10 = scene_printed(j->scene, "z10"), *z20 = scene_printed(j->scene, "z20");
  if (z10 && z20) {
    s->printed[0] = z10;
    s->printed[1] = z20;
  }
  return NULL;
}

const char *study_tables(struct judge *j) {
  struct table_source s;
  LOCAL(point, p);
  const char *why = source_init(&s, j, &p);
  if (!why) {
    tables_of_motion(&s);
    if (s.orbit->admissible == TRUTH_TRUE) table_of_animation(j->out, &s);
    table_of_return_map(&s);
    table_of_long_runs(&s);
    table_of_differences(&s);
    table_along_e2(&s);
  }
  num_vec_clear(&s.params);
  return why;
}

static void judge_open(struct judge *j, struct audit_result *out, const struct scene *scene, struct diag *d) {
  *j = (struct judge){.out = out, .scene = scene, .cache = orbit_cache_new(), .d = d};
  record_scene(out, scene);
}

const char *audit_tables(struct audit_result *out, const struct scene *scene) {
  struct diag d = {0};
  struct judge j;
  judge_open(&j, out, scene, &d);
  const char *why = study_tables(&j);
  orbit_cache_free(j.cache);
  return why;
}

bool scene_animation(struct audit_result *out, const struct scene *scene, slong orbit, struct diag *d) {
  struct judge j;
  struct table_source s;
  LOCAL(point, p);
  judge_open(&j, out, scene, d);
  const char *why = source_init(&s, &j, &p);
  bool there = !why && orbit < s.list->n;
  if (!why && !there) scene_lacks_orbit(scene, orbit, s.list->n, d);
  if (there && orbit >= 0) s.orbit = &s.list->orbit[orbit];
  if (there && s.orbit->admissible == TRUTH_FALSE) why = "the orbit is not admissible, so that no masses move like it";
  for (int i = 0; i < 2 && there; i++)
    if (!scene->given[KEY_E1 + i]) arb_set(num_vec_at(&s.params, P_E1 + i), i ? s.orbit->e2 : s.orbit->e1);
  if (there && !why && !table_of_animation(out, &s)) why = "its motion cannot be enclosed";
  if (why) diag_set(d, "%s: error: nothing to draw: %s", scene->path, why);
  num_vec_clear(&s.params);
  orbit_cache_free(j.cache);
  return there && !why;
}
