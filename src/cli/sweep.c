/* stickslip sweep: the orbits over a line or a plane of parameter values, as CSV or JSON. */
#include <string.h>

#include "sweep.h"

int parse_over(struct scene_range *r, struct dyn_axis *axis, const char *text, const struct scene_range *other,
               const struct over_rule *rule) {
  const char *colon = strrchr(text, ':');
  unsigned long long n = (unsigned long long)rule->usual;
  bool given = colon && (!n || strchr(text, ':') != colon);
  int status = range_parse(r, "--over", rule->shape, text, given ? (size_t)(colon - text) : strlen(text));
  if (status) return status;
  if (given && (!parse_whole(&n, colon + 1, false, rule->most) || n < rule->least))
    return usage("--over %.200s: N is a whole number from %llu to %llu", text, rule->least, rule->most);
  if ((n == 1) != fmpq_equal(r->from, r->to))
    return usage(n == 1 ? "--over %.200s: one value cannot be both ends" : "the ends of --over %.200s are equal", text);
  if (other && other->vary == r->vary) return usage("both --over vary %s", scene_key_name[r->vary]);
  double held[2];
  if (num_double.set_q(&held[0], r->from, 53) || num_double.set_q(&held[1], r->to, 53))
    return usage("the ends of --over %.200s cannot be held in double precision", text);
  dyn_axis_init(axis, r->vary, r->from, r->to, (slong)n);
  return EXIT_AS_RECORDED;
}

/* How the points are shared out. */
static int plan(struct sweep *q) {
  slong n = sweep_line_axis(q)->n;
  bool usual = q->every == 0;
  if (usual) q->every = dyn_axis_usual_every(n);
  q->lines = q->n_axes > 1 ? q->axis[0].n : 1;
  if (q->lines > AXIS_MOST_POINTS / n) return usage("--over: at most %d points in all", AXIS_MOST_POINTS);
  q->points = q->lines * n;
  q->unit = dyn_axis_stretch(q->every);
  q->per_line = (n + q->unit - 1) / q->unit;
  q->abreast = usual && !q->all && q->per_line == 1 ? dyn_lines_abreast(q->lines) : 1;
  q->units = (q->lines + q->abreast - 1) / q->abreast * q->per_line;
  return EXIT_AS_RECORDED;
}

static int parse_request(struct sweep *q, const struct options *o) {
  static const struct over_rule rule = {"%s takes NAME=A:B:N, as in e2=0.8:0.9:20000, not %.200s", 1, AXIS_MOST_POINTS,
                                        0};
  bool json = option(o, OPT_JSON);
  const struct words *over = &o->given[OPT_OVER];
  long every = 0;
  int status = parse_digits(&q->digits, o, MAX_SWEEP_DIGITS);
  if (!status) status = parse_count(&every, o, OPT_SEARCH_EVERY, AXIS_MOST_EVERY);
  if (status) return status;
  if (over->n == 0) return usage("sweep needs --over NAME=A:B:N");
  if (option(o, OPT_RESUME) && !option(o, OPT_CSV)) return usage("--resume continues a file: it needs --csv FILE");
  q->every = every;
  q->json = json;
  q->all = option(o, OPT_ALL) || json;
  for (int i = 0; i < over->n && !status; i++) {
    status = parse_over(&q->range[i], &q->axis[i], over->word[i], i ? &q->range[0] : NULL, &rule);
    q->n_axes += !status;
  }
  return status ? status : plan(q);
}

static int load_swept(struct sweep *q, const struct options *o, const char *data) {
  struct diag d = {0};
  if (!load_scene(&q->scene, o->operands.word[0], data, o, SCENE_EXACT, &d) ||
      !scene_needs_forces(&q->scene, "sweep", &d))
    return bad_input(&d);
  int status = EXIT_AS_RECORDED;
  for (int i = 0; i < q->n_axes && !status; i++)
    status = range_check_friction(&q->range[i], &q->scene, "--over", o->given[OPT_OVER].word[i]);
  return status;
}

static int write_all_rows(const struct sweep *q, const struct options *o, int jobs) {
  OWNED(sink) s;
  struct diag d = {0};
  int status = sink_open(&s, q, o, &d) ? sweep_carry_out(q, &s, jobs) : sink_failed(&d);
  if (status == EXIT_AS_RECORDED && s.to_file) say_written(o, option(o, OPT_CSV));
  return status;
}

static int sweep_with(struct sweep *q, const struct options *o, const char *data) {
  int jobs, status = parse_jobs(&jobs, o);
  if (!status) status = parse_request(q, o);
  if (!status) status = load_swept(q, o, data);
  if (status) return status;
  sweep_listen(true);
#ifdef STICKSLIP_MPI
  if (!option(o, OPT_JOBS)) jobs = ranks_jobs();
  status = ranks_number() > 0 ? ranks_serve(q, jobs) : write_all_rows(q, o, jobs);
#else
  status = write_all_rows(q, o, jobs);
#endif
  sweep_listen(false);
  return status;
}

int run_sweep(const struct options *o, const char *data, struct diag *none) {
  (void)none; /* ranks say what is wrong before they part */
  struct sweep q = {.n_axes = 0};
#ifdef STICKSLIP_MPI
  ranks_open();
#endif
  for (int i = 0; i < MAX_OVER; i++) scene_range_init(&q.range[i]);
  int status = sweep_with(&q, o, data);
  for (int i = 0; i < q.n_axes; i++) dyn_axis_clear(&q.axis[i]);
  for (int i = 0; i < MAX_OVER; i++) scene_range_clear(&q.range[i]);
  scene_clear(&q.scene);
#ifdef STICKSLIP_MPI
  ranks_close(status);
#endif
  return status;
}
