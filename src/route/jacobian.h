/* Jacobians of a period and of its phases, by each method. */
#ifndef STICKSLIP_ROUTE_JACOBIAN_H
#define STICKSLIP_ROUTE_JACOBIAN_H

#include "model/model.h"
#include "scene/scene.h"
#include "value/coulomb_setup.h"
#include "value/local_maps.h"
#include "value/point.h"

enum jacobian_method {
  METHOD_ANALYTIC,
  METHOD_IMPLICIT,
  METHOD_SALTATION,
  METHOD_FD,
  METHOD_FD_DOUBLE,
  METHOD_ODE,
  N_METHODS
};
extern const char *const method_name[N_METHODS];
extern const char *const method_accuracy[N_METHODS]; /* what the accuracy of a method consists of, in words */

struct jacobian_request {
  enum jacobian_method method;
  enum layer layer; /* of the paper's chain, METHOD_ANALYTIC */
  bool at_printed;  /* at the scene's printed numbers, else on an orbit */
  slong orbit;      /* from 0, by increasing z10, in the list that `orbit` shows: with what the search alone misses */
  slong digits;
};

/* j (4 balls, row-major), trace and det, good for the digits asked for where the method reaches them; the radius of a
   ball is the accuracy that the method states (differences: an estimate).  METHOD_ANALYTIC: the paper's J_f J_c J_b
   J_a; at printed numbers its states are those at the printed times.  The other methods start at the printed state and
   locate the events.  METHOD_FD_DOUBLE works in double precision, METHOD_ODE integrates (1)-(2); they give the digits
   they have, about eleven and eight, whatever is asked for, and their accuracy holds what rounding the inputs to
   doubles does.  det is exactly 0 wherever the method proves or confirms it (all that precedes t_a is a map to one
   number).  A scene that does not give e1 and e2 has those of its orbit, at printed numbers the printed ones.  false
   with d set on failure. */
bool audit_jacobian(arb_ptr j, arb_t trace, arb_t det, const struct model *m, const struct scene *s,
                    const struct jacobian_request *q, struct diag *d);
/* trace and det of a 2x2 matrix of balls, det as above. */
void jacobian_invariants(arb_t trace, arb_t det, arb_srcptr j);
/* The largest radius, exactly. */
void jacobian_accuracy(arb_t worst, arb_srcptr x, slong n);

/* The local Jacobians J_a, J_b, J_c, J_f of the phases and J of the period, by every method side by side. */
enum { N_COLUMNS = N_METHODS + 1, N_MATRICES = N_PHASES + 1, MATRIX_MOST = 6 };
struct jacobian_column {
  const char *name, *heading;
  enum jacobian_method method;
  enum layer layer;
};
extern const struct jacobian_column
    jacobian_columns[N_COLUMNS]; /* the paper's chain is there as printed and corrected */
struct jacobian_matrix {
  const char *name, *phase; /* phase: NULL for J */
  int rows, cols;
  bool known[N_COLUMNS];
  arb_ptr entry[N_COLUMNS];             /* row-major balls; the radius is the accuracy */
  bool departs[N_COLUMNS][MATRIX_MOST]; /* disjoint from more than half of the other methods that are known */
};
struct jacobian_phases {
  struct jacobian_matrix matrix[N_MATRICES];
  int known; /* how many matrices of any method */
};
void jacobian_phases_init(struct jacobian_phases *p);
void jacobian_phases_clear(struct jacobian_phases *p);
/* method and layer of the request are not looked at.  At printed numbers the paper's formulas stand at other states
   than the methods that locate events (see audit_jacobian). */
bool audit_phases(struct jacobian_phases *out, const struct model *m, const struct scene *s,
                  const struct jacobian_request *q, struct diag *d);

struct jacobian_job {
  const struct model *model;
  const struct scene *scene;
  struct point point; /* POINT_ORBIT or POINT_PRINTED */
  struct orbit_cache *cache;
  struct diag *d;
  struct coulomb_setup setup; /* of the simulation; made when first asked for */
  bool setup_done, setup_good;
};
/* Does the method work in double precision, whatever is asked for? */
bool method_is_double(enum jacobian_method method);
/* The 2x2 Jacobian of the period (map NULL) or the paper's matrix of one phase, as balls at prec bits. */
int jacobian_route(arb_ptr out, struct jacobian_job *job, enum jacobian_method method, enum layer layer,
                   const struct local_map *map, slong prec);

#endif
