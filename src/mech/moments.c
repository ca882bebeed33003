/* Motions as text. */
#include "moments.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *mode_name(char letter) {
  return letter == 's'        ? "stick"
         : letter == '-'      ? "below"
         : letter == '+'      ? "above"
         : mech_rests(letter) ? "rest"
                              : "free";
}

/* --- The table --- */

enum { PHASE_WIDTH = 5 };

static int phase_width(int n) {
  return n + 2 < PHASE_WIDTH ? PHASE_WIDTH : n + 2;
}

void mech_table_heading(struct text *out, int n, bool phases) {
  text_printf(out, "%11s %-4s %-13s", "t", "mass", "change");
  if (phases) text_printf(out, " %-*s", phase_width(n), "phase");
  for (int i = 0; i < 2 * n; i++) {
    char name[16];
    snprintf(name, sizeof name, "%c%d", i < n ? 'x' : 'v', i % n + 1);
    text_printf(out, i < n ? " %12s" : " %10s", name);
  }
  text_add_char(out, '\n');
}

void mech_table_line(struct text *out, int n, bool phases, const struct mech_moment *at, char from) {
  text_printf(out, "%11.7f m%-3d ", at->t, at->mass + 1);
  if (at->mass >= 0 && at->phase[n])
    text_printf(out, "%-13s", "rebound");
  else
    text_printf(out, "%-5s > %-5s", mode_name(from), mode_name(at->phase[at->mass]));
  if (phases) text_printf(out, " %-*s", phase_width(n), at->phase);
  for (int i = 0; i < 2 * n; i++) /* as many digits before the point as anybody reads */
    text_printf(out, fabs(at->z[i]) < 1e15 ? " %*.*f" : " %*.*e", i < n ? 12 : 10, i < n ? 8 : 6, at->z[i]);
}

/* --- CSV and JSON --- */

void mech_csv_heading(struct text *out, int n) {
  static const char *const parts[] = {"x", "v", "mode", "u"};
  text_add_char(out, 't');
  for (int k = 0; k < 4 * n; k++) text_printf(out, ",%s%d", parts[k / n], k % n + 1);
  text_add_char(out, '\n');
}

void mech_csv_row(struct text *out, int n, const struct mech_moment *at) {
  text_printf(out, "%.17g", at->t);
  for (int i = 0; i < 2 * n; i++) text_printf(out, ",%.17g", at->z[i]);
  for (int i = 0; i < n; i++) text_printf(out, ",%s", mode_name(at->phase[i]));
  for (int i = 0; i < n; i++) text_printf(out, ",%.17g", at->u[i]);
  text_add_char(out, '\n');
}

void mech_word_json(struct json *j, const struct mech_word *w) {
  JSON_EACH (j, "word", k, w->n) json_string(j, NULL, w->phase[k]);
}

void mech_double_json(struct json *j, const char *key, double x) {
  json_printf(j, key, "%.17g", x);
}

void mech_events_json(struct json *j, int n, const struct mech_motion *x) {
  json_array(j, "events");
  for (int k = 1; k < x->n_moments; k++) {
    const struct mech_moment *at = &x->moment[k];
    JSON_OBJECT(j, NULL);
    mech_double_json(j, "t", at->t);
    json_long(j, "mass", at->mass + 1);
    json_string(j, "from", mode_name(x->moment[k - 1].phase[at->mass]));
    json_string(j, "to", mode_name(at->phase[at->mass]));
    json_string(j, "phase", at->phase);
    for (int part = 0; part < 2; part++)
      JSON_EACH (j, part ? "v" : "x", i, n) mech_double_json(j, NULL, at->z[part * n + i]);
  }
  json_end_array(j);
}

/* --- Motions compared --- */

/* The range of a mass's positions between those moments: at least half of the way there and back that it goes at its
   mean speeds, since it may be at the same place at every event. */
static double range(const struct mech_moment *at, int k, int n, int mass) {
  double low = at->z[mass], high = low, length = 0;
  for (int l = 1; l <= k; l++) {
    low = fmin(low, at[l].z[mass]);
    high = fmax(high, at[l].z[mass]);
    length += (at[l].t - at[l - 1].t) * (fabs(at[l - 1].z[n + mass]) + fabs(at[l].z[n + mass])) / 2;
  }
  return fmax(high - low, length / 2);
}

static double share(double apart, double extent) {
  return apart > 0 ? apart / extent : 0;
}

double mech_gap(const struct mech_moment *at, int k, int n, int states) {
  double apart[3] = {0}, extent[3] = {0};
  for (int i = 0; i < states; i++) {
    int part = i < n ? 0 : i < 2 * n ? 1 : 2;
    apart[part] = fmax(apart[part], fabs(at[k].z[i] - at[0].z[i]));
    if (part == 0) extent[part] = fmax(extent[part], range(at, k, n, i));
    for (int l = 0; part > 0 && l <= k; l++) extent[part] = fmax(extent[part], fabs(at[l].z[i]));
  }
  return fmax(share(apart[0], extent[0]), fmax(share(apart[1], extent[1]), share(apart[2], extent[2])));
}

bool mech_settles(struct mech_word *w, double *period, double *gap, const struct mech_motion *x, int n, int states) {
  static const double same = 1e-6;
  const struct mech_moment *last = x->moment + x->n_moments - 1;
  *w = (struct mech_word){.n = 0};
  for (int k = 1; k <= MECH_PHASES && k < x->n_moments; k++) {
    const struct mech_moment *at = last - k;
    *gap = mech_gap(at, k, n, states);
    if (strcmp(at->phase, last->phase) != 0 || !(*gap < same)) continue;
    *period = last->t - at->t;
    w->n = k;
    for (int l = 0; l < k; l++) memcpy(w->phase[l], at[l].phase, sizeof at->phase);
    return *period > 0;
  }
  return false;
}

double mech_compare(int *shared, const struct mech_motion *a, const struct mech_motion *b, int n) {
  double worst = 0;
  for (*shared = 0; *shared + 1 < a->n_moments && *shared + 1 < b->n_moments; ++*shared) {
    const struct mech_moment *p = &a->moment[*shared + 1], *q = &b->moment[*shared + 1];
    if (p->mass != q->mass || strcmp(p->phase, q->phase) != 0) break;
    worst = fmax(worst, fabs(p->t - q->t));
    for (int i = 0; i < 2 * n; i++) worst = fmax(worst, fabs(p->z[i] - q->z[i]));
  }
  return worst;
}
