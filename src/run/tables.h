/* Tables of numbers that pictures are drawn from: one text for each, tab-separated, with a heading in comment lines.

   Every number is printed to fixed few decimals of an enclosure, or of a number that MPFR rounds the same way on every
   machine, so that a table is the same bytes everywhere. */
#ifndef STICKSLIP_RUN_TABLES_H
#define STICKSLIP_RUN_TABLES_H

#include "base/crew.h"
#include "explore/bifurcate.h"
#include "explore/family.h"
#include "judge/behaviour.h"
#include "mech/orbit.h"

/* What a table is made from. */
struct table_source {
  struct judge *j;
  const struct point *point;               /* the orbit below */
  const struct dyn_orbits *list;           /* the scene's orbits, at least one */
  const struct dyn_orbit *orbit;           /* nearest to the printed numbers */
  const struct printed_number *printed[2]; /* z10, z20; NULL both where the scene prints no start */
  struct num_vec params;                   /* enclosed; where e1 and e2 are not given, those of the orbit */
  double near[N_PARAMS];                   /* the same, rounded */
};

/* The tables of the scene, into out->tables; NULL, or why there are none. */
const char *study_tables(struct judge *j);

/* Appends a tab, and x to so many decimals; "-" where they are not known, or x is NULL. */
void table_number(struct text *out, arb_srcptr x, int decimals);
/* Into how many pieces a phase is cut that takes this share of the period. */
slong table_pieces(double share);
/* The two decimals that are proved to enclose a change, each after a tab. */
void table_bracket(struct text *out, const struct dyn_bifurcation *b);
/* The scene's parameters, borrowed, but for one, which is to be set and cleared by the pointer returned. */
fmpq *table_params(fmpq params[N_PARAMS], const struct scene *s, int vary);
/* Adds a table to the result, and clears its text. */
void table_finish(struct audit_result *out, const char *name, struct text *body);

/* From what dyn_return_near returned at r to the next period: r becomes its middle, so that enclosures do not grow by
   themselves, and error, how far that may be from the true iterate, by little more than the slope; false once that
   could be seen. */
bool table_go_on(arb_t r, mag_t error, const struct num_vec *returned);

/* figure-3.tsv, figure-4.tsv, margins.tsv: along the orbit, and from the printed start. */
void tables_of_motion(struct table_source *s);
/* return-map.tsv: the map, its fixed points, and the iterates of the printed start. */
void table_of_return_map(struct table_source *s);
/* long-run.tsv: how far from an orbit, period by period. */
void table_of_long_runs(struct table_source *s);
/* differences.tsv: the error of tr J by central differences against their step. */
void table_of_differences(struct table_source *s);
/* along-e2.tsv: the orbit and what changes on it when e2 alone is another; none where the scene does not give e2. */
void table_along_e2(struct table_source *s);
/* animation.tsv: one period of that orbit of the scene (from 0), or of the nearest to the printed numbers where it is
   -1; false with d set where there is none. */
bool scene_animation(struct audit_result *out, const struct scene *s, slong orbit, struct diag *d);
/* The same of the orbit of a source; false, with a table of no rows, where its motion cannot be enclosed. */
bool table_of_animation(struct audit_result *out, const struct table_source *s);
/* bifurcations.tsv: every branch of orbits along a line of one parameter; SS_UNABLE when a change can
   be missing.  The samples stand where the curves were followed in double precision, which may differ from one machine
   to another. */
int table_of_bifurcations(struct audit_result *out, const struct scene *s, int vary, const fmpq_t from,
                          const fmpq_t to);
/* stability-map.tsv: the orbits over a plane of two parameters, at most so many values of each, the second running
   along the lines, with proved points of the boundaries; the tally counts lines.  false with d set, and a table of no
   rows, when no process can be made. */
enum { TABLE_MOST_SIDE = 400 };
bool table_of_map(struct audit_result *out, const struct scene *s, const struct dyn_axis axis[2], int jobs,
                  struct crew_tally *tally, struct diag *d);

/* statements.tsv: what the paper says, with verdicts and roots. */
void table_of_statements(struct audit_result *out, const struct claims *statements);
/* phase-planes.tsv: the orbits of a system file. */
void table_of_system(struct audit_result *out, const struct mech *m, const struct mech_orbits *list);

/* The tables that pictures of the scene's orbits are drawn from, into out->tables; NULL, or why there are none. */
const char *audit_tables(struct audit_result *out, const struct scene *scene);

#endif
