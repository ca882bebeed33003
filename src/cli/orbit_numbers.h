/* What the forms of stickslip orbit share. */
#ifndef STICKSLIP_ORBIT_NUMBERS_H
#define STICKSLIP_ORBIT_NUMBERS_H

#include "base/json.h"
#include "value/solved.h"

enum { MOST_BOX_DIGITS = 20 };
/* Prints the i-th number of an orbit. */
typedef void number_printer(struct text *out, const struct dyn_orbit *o, int i, const struct scene *s, slong digits);
/* All of them by name, the eigenvalues, whether it is stable and admissible, and the violations; u: whether the given
   u_r1, u_r2 exceed their bounds. */
void orbit_numbers_json(struct json *j, const struct dyn_orbit *o, number_printer *print, const struct scene *s,
                        slong digits, truth admissible, const truth u[2]);
/* An end of an enclosure as a decimal, rounded outwards; of an interval that is given: exactly where it has so many
   digits. */
void add_end(struct text *out, const arb_struct *x, bool upper, slong digits);
void add_box_end(struct text *out, const fmpq *end, bool upper, slong digits);
/* admissible or not; under which condition, where the scene leaves u_r1 or u_r2 open */
void admissible_text(struct text *out, truth admissible, const struct scene *s);
/* orbit --basin */
void basin_json(struct json *j, const struct dyn_orbit *o, const struct scene *s);
void basin_text(struct text *out, const struct dyn_orbit *o, const struct scene *s);

#endif
