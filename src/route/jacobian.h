/* Jacobians by one method. */
#ifndef STICKSLIP_ROUTE_JACOBIAN_H
#define STICKSLIP_ROUTE_JACOBIAN_H

#include "stickslip/audit.h"
#include "value/local_maps.h"
#include "value/point.h"

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
