/* What certificates of orbits are made of, see verify/checker/README.md: numbers in JSON without loss (rationals p/q,
   balls in Arb's text form, four hexadecimal integers), and what is proved of the orbit. */
#ifndef STICKSLIP_NUM_EXACT_JSON_H
#define STICKSLIP_NUM_EXACT_JSON_H

#include "base/json.h"
#include "num.h"

/* Begins the file; scene: a name. */
struct json json_certificate(struct text *out, const char *scene);
/* A spring or damper between two masses, counted from 1, or one and the ground, 0. */
void json_link(struct json *j, int a, int b, const char *key, const fmpq *size);
void json_fraction(struct json *j, const char *key, const fmpq *x);
void json_ball(struct json *j, const char *key, arb_srcptr x);
/* With its radius doubled, so that a checker that rounds elsewhere can prove that its own enclosure lies within. */
void json_wide_ball(struct json *j, const char *key, arb_srcptr x);
/* An array of such balls. */
void json_balls(struct json *j, const char *key, arb_srcptr const *x, int n);
void json_multiplier(struct json *j, arb_srcptr re, arb_srcptr im);
void json_verdicts(struct json *j, truth stable, truth admissible);

#endif
