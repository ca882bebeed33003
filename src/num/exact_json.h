/* What certificates of orbits are made of: numbers in JSON without loss (rationals p/q, balls in Arb's text form, four
   hexadecimal integers), and what is proved of the orbit. */
#ifndef STICKSLIP_NUM_EXACT_JSON_H
#define STICKSLIP_NUM_EXACT_JSON_H

#include "base/json.h"
#include "num.h"

void json_fraction(struct json *j, const char *key, const fmpq *x);
void json_ball(struct json *j, const char *key, arb_srcptr x);
/* With its radius doubled, so that a checker that rounds elsewhere can prove that its own enclosure lies within. */
void json_wide_ball(struct json *j, const char *key, arb_srcptr x);
void json_verdicts(struct json *j, truth stable, truth admissible);

#endif
