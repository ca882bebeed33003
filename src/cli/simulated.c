/* What simulate prints of any motion, of the paper's two masses or of a system file. */
#include "simulated.h"

void csv_line(int n, const struct mech_moment *at) {
  struct text line = {0};
  if (at)
    mech_csv_row(&line, n, at);
  else
    mech_csv_heading(&line, n);
  print_text(&line);
}

void routes_line(long shared, long events, double worst) {
  printf("closed forms: the first %ld of %ld event%s %s the same, times and states within %.1e\n", shared, events,
         plural_s(events), shared == 1 ? "is" : "are", worst);
}

void ended_line(double t, long n, const char *counted, const char *behind, const char *why) {
  printf("ended at t = %.10g after %ld %s%s%s%s%s\n", t, n, counted, plural_s(n), behind, why ? ": " : "",
         why ? why : "");
}

void simulated_json(const struct simulated *run, const char *ended) {
  struct text out = {0};
  struct mech_word word;
  double period, gap;
  int shared;
  struct json j = json_document(&out, NULL);
  json_string(&j, "scene", run->scene);
  json_string(&j, "system", run->system);
  json_string(&j, "at", run->at);
  JSON_EACH (&j, "start", i, run->states) mech_double_json(&j, NULL, run->main->moment[0].z[i]);
  mech_events_json(&j, run->n, run->main);
  json_string(&j, "ended", ended);
  mech_double_json(&j, "t", run->main->t);
  bool settled = mech_settles(&word, &period, &gap, run->main, run->n, run->states);
  if (settled) {
    mech_word_json(&j, &word);
    mech_double_json(&j, "period", period);
  } else {
    json_null(&j, "word");
    json_null(&j, "period");
  }
  double apart = mech_compare(&shared, run->main, run->other, run->n);
  json_long(&j, "shared", shared);
  mech_double_json(&j, "apart", apart);
  json_end_object(&j);
  print_text(&out);
}

int ended_early(const char *why, const char *route, double t) {
  fprintf(stderr, "simulate: error: the route %s ended early, at t = %.10g: %s\n", route, t, why);
  return EXIT_INTERNAL;
}
