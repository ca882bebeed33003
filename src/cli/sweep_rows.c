/* The rows of a sweep.

   CSV: a head of comments that says what was asked, so that a file speaks for itself and an interrupted one can be told
   from another; then a row for each orbit, and one for a point without any.  JSON: one object for each point. */
#include <stdlib.h>
#include <string.h>

#include "base/decimal.h"
#include "sweep.h"

/* Columns, in the order of the contract. */
static const char *const column[N_DYN_OUT] = {
    [DYN_OUT_Z10] = "z10",     [DYN_OUT_Z20] = "z20",    [DYN_OUT_TA] = "t_a",        [DYN_OUT_TB] = "t_b",
    [DYN_OUT_TC] = "t_c",      [DYN_OUT_TD] = "t_d",     [DYN_OUT_PERIOD] = "period", [DYN_OUT_TRACE] = "trace",
    [DYN_OUT_U1] = "u_r1_min", [DYN_OUT_U2] = "u_r2_min"};

static const char *axis_name(const struct sweep *q, int i) {
  return scene_key_name[q->range[i].vary];
}

static bool is_swept(const struct sweep *q, int param) {
  bool any = false;
  for (int i = 0; i < q->n_axes; i++) any |= q->range[i].vary == param;
  return any;
}

/* --- Before and after. --- */

static void head_csv(struct text *out, const struct sweep *q) {
  int n = 0;
  text_printf(out, "# stickslip " SS_VERSION " sweep\n# scene: %s\n#", q->scene.name);
  for (int i = 0; i < N_KEYS; i++) {
    if (!q->scene.given[i] || (i < N_PARAMS && is_swept(q, i))) continue;
    text_printf(out, "%s %s = ", n++ ? "," : "", scene_key_name[i]);
    num_print_q(out, &q->scene.value[i]);
  }
  for (int i = 0; i < q->n_axes; i++) {
    text_printf(out, "\n# over: %s = ", axis_name(q, i));
    num_print_q(out, q->range[i].from);
    text_add(out, " : ");
    num_print_q(out, q->range[i].to);
    text_printf(out, " : %ld", (long)q->axis[i].n);
  }
  text_printf(out, "\n# orbits: %s; search_every = %ld", q->all ? "all" : "admissible", (long)q->every);
  if (q->abreast > 1) text_printf(out, ", %d times as far where the line before is alike", FAMILY_APART);
  text_printf(out, "; digits = %ld, of double precision\npoint", (long)q->digits);
  for (int i = 0; i < q->n_axes; i++) text_printf(out, ",%s", axis_name(q, i));
  text_add(out, ",orbit");
  for (int i = 0; i < N_DYN_OUT; i++) text_printf(out, ",%s", column[i]);
  text_add(out, ",stable,admissible,violations,status\n");
}

static void head_json(struct text *out, const struct sweep *q) {
  struct json j = json_of_model(out, &q->scene); /* which sweep_tail ends */
  json_object(&j, "parameters");
  for (int i = 0; i < N_KEYS; i++)
    if (q->scene.given[i] && !(i < N_PARAMS && is_swept(q, i)))
      json_rational(&j, scene_key_name[i], &q->scene.value[i], q->digits);
  json_end_object(&j);
  JSON_EACH (&j, "over", i, q->n_axes) {
    JSON_OBJECT(&j, NULL);
    json_string(&j, "name", axis_name(q, i));
    json_rational(&j, "from", q->range[i].from, q->digits);
    json_rational(&j, "to", q->range[i].to, q->digits);
    json_long(&j, "n", (long)q->axis[i].n);
  }
  json_long(&j, "search_every", (long)q->every);
  json_bool(&j, "complete", false);
  json_array(&j, "points");
}

void sweep_head(struct text *out, const struct sweep *q) {
  (q->json ? head_json : head_csv)(out, q);
}

void sweep_tail(struct text *out, const struct sweep *q) {
  if (!q->json) return;
  struct json j = {.out = out, .depth = 2, .started = {true, true}};
  json_end_array(&j);
  json_end_object(&j);
}

/* --- One point. --- */

/* The values of the axes at a unit's line; the last one is that of each point. */
struct place {
  slong point;
  double value[MAX_OVER];
};

static void add_number(struct text *out, double x, slong digits) {
  char shown[DECIMAL_MAX];
  text_add_n(out, shown, (size_t)decimal_digits(shown, x, (int)digits));
}

static void begin_row(struct text *out, const struct sweep *q, const struct place *at) {
  char shown[DECIMAL_MAX];
  text_add_n(out, shown, (size_t)snprintf(shown, sizeof shown, "%ld", (long)at->point));
  for (int i = 0; i < q->n_axes; i++) {
    text_add_char(out, ',');
    text_add_n(out, shown, (size_t)decimal_whole(shown, at->value[i]));
  }
}

static void end_row(struct text *out, const char *status) {
  text_add_char(out, ',');
  text_add(out, status);
  text_add_char(out, '\n');
}

static void member_csv(struct text *out, const struct dyn_member *m, slong number, slong digits) {
  static const char *const word[] = {",false", ",true", ",unknown"};
  int n = 0;
  text_add_char(out, ',');
  add_number(out, (double)number, digits);
  for (int i = 0; i < N_DYN_OUT; i++) {
    text_add_char(out, ',');
    add_number(out, m->out[i], digits);
  }
  text_add(out, word[m->stable]);
  text_add(out, word[dyn_member_admissible(m)]);
  text_add_char(out, ',');
  for (int i = 0; i < ORBIT_CONDITIONS; i++) {
    if (!(m->violations >> i & 1)) continue;
    if (n++) text_add_char(out, ' ');
    text_add(out, orbit_condition_name(i));
  }
}

static void point_csv(struct text *out, const struct sweep *q, const struct dyn_family *f,
                      const struct dyn_family_point *p, const struct place *at) {
  slong n = 0;
  for (slong i = 0; i < p->n; i++) {
    const struct dyn_member *m = &f->member[p->first + i];
    if (!q->all && dyn_member_admissible(m) == TRUTH_FALSE) continue;
    begin_row(out, q, at);
    member_csv(out, m, ++n, q->digits);
    end_row(out, dyn_family_status_name[p->status]);
  }
  if (n > 0) return;
  begin_row(out, q, at);
  for (int i = 0; i < 1 + N_DYN_OUT + 3; i++) text_add_char(out, ',');
  end_row(out, p->status == FAMILY_OK ? "none" : dyn_family_status_name[p->status]);
}

static void member_json(struct json *j, const struct dyn_member *m, slong digits) {
  char shown[DECIMAL_MAX];
  JSON_OBJECT(j, NULL);
  for (int i = 0; i < N_DYN_OUT; i++) {
    decimal_digits(shown, m->out[i], (int)digits);
    json_string(j, column[i], shown);
  }
  json_truth(j, "stable", m->stable);
  json_truth(j, "admissible", dyn_member_admissible(m));
  JSON_EACH (j, "violations", i, ORBIT_CONDITIONS)
    if (m->violations >> i & 1) json_string(j, NULL, orbit_condition_name(i));
}

static void point_json(struct json *j, const struct sweep *q, const struct dyn_family *f,
                       const struct dyn_family_point *p, const struct place *at) {
  char shown[DECIMAL_MAX];
  JSON_OBJECT(j, NULL);
  for (int i = 0; i < q->n_axes; i++) {
    decimal_whole(shown, at->value[i]);
    json_string(j, axis_name(q, i), shown);
  }
  json_string(j, "status", p->status == FAMILY_OK && p->n == 0 ? "none" : dyn_family_status_name[p->status]);
  JSON_EACH (j, "orbits", i, p->n) member_json(j, &f->member[p->first + i], q->digits);
}

/* --- A unit. --- */

static void line_text(struct text *out, const struct sweep *q, const struct dyn_family *f, slong line, slong begin) {
  struct place at = {.point = line * sweep_line_axis(q)->n + begin};
  struct json j = {.out = out, .depth = 2, .started = {true, at.point > 0}};
  if (q->n_axes > 1) at.value[0] = dyn_axis_d(&q->axis[0], line);
  for (slong i = 0; i < f->n_points; i++, at.point++) {
    at.value[q->n_axes - 1] = f->point[i].x;
    if (q->json)
      point_json(&j, q, f, &f->point[i], &at);
    else
      point_csv(out, q, f, &f->point[i], &at);
  }
}

/* The points of a line from `begin` on, with the same points of the line before it beside. */
static void find_on_line(struct dyn_family *f, const struct sweep *q, slong line, slong begin,
                         const struct dyn_family *before) {
  const struct dyn_axis *axis = sweep_line_axis(q);
  struct dyn_family_request r = {.axis = axis, .every = q->every, .late = q->all, .beside = before};
  fmpq params[N_PARAMS], *across = &params[q->range[0].vary];
  memcpy(params, q->scene.value, sizeof params); /* borrowed, but for that which varies across */
  fmpq_init(across);
  if (q->n_axes > 1) dyn_axis_q(across, &q->axis[0], line);
  r.params = params;
  scene_static_friction(r.u_r, &q->scene);
  if (dyn_family_find(f, &r, begin, FLINT_MIN(begin + q->unit, axis->n)) != SS_OK)
    abort(); /* the ends of each axis are in the domain, and so is what lies between */
  fmpq_clear(across);
}

void sweep_rows(struct text *out, const struct sweep *q, slong unit) {
  slong line = unit / q->per_line * q->abreast, begin = unit % q->per_line * q->unit;
  slong end = FLINT_MIN(line + q->abreast, q->lines);
  struct dyn_family f = {.n_points = 0}, before;
  for (; line < end; line++) {
    before = f;
    find_on_line(&f, q, line, begin, before.n_points ? &before : NULL);
    line_text(out, q, &f, line, begin);
    dyn_family_clear(&before);
  }
  dyn_family_clear(&f);
}
