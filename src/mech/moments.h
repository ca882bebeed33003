/* A simulated motion as it is written: lines of a table, rows of CSV, JSON; what it settles on; two of them compared.
   Masses are m1, m2, ...; their modes "stick", "below", "above" (slower, faster than the surface), "rest" (at an
   obstacle) and "free". */
#ifndef STICKSLIP_MECH_MOMENTS_H
#define STICKSLIP_MECH_MOMENTS_H

#include "base/json.h"
#include "walk.h"

/* t, mass, change, the phase where phases, x1 ... xn, v1 ... vn. */
void mech_table_heading(struct text *out, int n, bool phases);
/* An event: the mass was in the mode `from` before. */
void mech_table_line(struct text *out, int n, bool phases, const struct mech_moment *at, char from);
/* t, x1 ..., v1 ..., mode1 ..., u1 ..., with 17 significant digits. */
void mech_csv_heading(struct text *out, int n);
void mech_csv_row(struct text *out, int n, const struct mech_moment *at);
/* The array "word" of a word's phases. */
void mech_word_json(struct json *j, const struct mech_word *w);
/* The array "events" of a motion of n masses. */
void mech_events_json(struct json *j, int n, const struct mech_motion *x);
/* A number in 17 digits; a member or an element. */
void mech_double_json(struct json *j, const char *key, double x);

/* How nearly the k-th moment from there on returns to the first: the largest distance of positions, of velocities and
   of the angle of the loads, each relative to how far masses get in between, to the largest velocity and to 1. */
double mech_gap(const struct mech_moment *at, int k, int n, int states);
/* The phases from the last event back to an earlier one with the same phase and, within 1e-6, the same state: the word
   that the motion settles on, its length, and how far apart those states are.  false: there is none within
   MECH_PHASES. */
bool mech_settles(struct mech_word *w, double *period, double *gap, const struct mech_motion *x, int n, int states);
/* How many events from the first on are the same, and the largest difference of their times, positions and
   velocities. */
double mech_compare(int *shared, const struct mech_motion *a, const struct mech_motion *b, int n);

#endif
