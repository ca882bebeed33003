/* The Jacobian of one period to the digits that are asked for, and phase by phase by every method side by side. */
#include "jacobian.h"
#include "value/printed.h"
#include <string.h>

enum { ATTEMPTS = 4, GUARD_BITS = 64 };

/* The point that is asked for; false with d set when the scene does not have it. */
static bool find_point(struct point *p, const struct scene *s, const struct jacobian_request *q,
                       struct orbit_cache *cache, struct diag *d) {
  if (q->at_printed) {
    if (printed_point(p, s)) return true;
    return diag_set(
        d, "%s: error: --at printed needs z10 and z20 printed, and e1, e2, t_a, t_b, t_c and t_d printed or given",
        s->path);
  }
  slong n = scene_orbits(s, cache)->n;
  p->kind = POINT_ORBIT;
  p->scene = s;
  p->orbit = q->orbit;
  for (int k = 0; k < N_SCENE_PARAMS; k++) fmpq_set(&p->q[Q_CHI + k], &s->value[k]);
  return q->orbit < n || scene_lacks_orbit(s, q->orbit, n, d);
}

static bool job_init(struct jacobian_job *job, const struct model *m, const struct scene *s,
                     const struct jacobian_request *q, struct diag *d) {
  *job = (struct jacobian_job){.model = m, .scene = s, .cache = orbit_cache_new(), .d = d};
  orbit_cache_complete(job->cache);
  point_init(&job->point);
  return find_point(&job->point, s, q, job->cache, d);
}

static void job_clear(struct jacobian_job *job) {
  point_clear(&job->point);
  orbit_cache_free(job->cache);
}

/* What differs from zero has a digit that can be printed. */
static bool has_digits(arb_srcptr x, int n) {
  bool ok = true;
  for (int i = 0; i < n; i++) ok = ok && (arb_contains_zero(x + i) || num_has_digits(x + i, 1, 1));
  return ok;
}

/* Raises the precision until the digits are reached.  The status of the last attempt; *precise: are they? */
static int refine(arb_ptr out, bool *precise, struct jacobian_job *job, enum jacobian_method method, enum layer layer,
                  const struct local_map *map, slong digits) {
  int n = map ? map->rows * map->cols : 4, s = SS_UNABLE;
  slong prec = num_bits(digits) + GUARD_BITS;
  if (method == METHOD_FD) prec = 3 * prec / 2; /* central differences keep two thirds of the digits */
  *precise = method_is_double(method);
  if (*precise) return jacobian_route(out, job, method, layer, map, prec);
  for (int i = 0; i < ATTEMPTS && !*precise && !job->d->set; i++, prec += prec / 2) {
    s = jacobian_route(out, job, method, layer, map, prec);
    *precise = s == SS_OK && num_has_digits(out, n, digits);
  }
  return s;
}

static void complain(struct jacobian_job *job, enum jacobian_method method, slong digits) {
  if (method == METHOD_ODE)
    diag_set(job->d, "%s: error: under Coulomb's law nearby motions do not follow the word D-Gamma-H-C",
             job->scene->path);
  else if (method == METHOD_FD_DOUBLE)
    diag_set(job->d, "%s: error: no differences in double precision can be had there", job->scene->path);
  else
    diag_set(job->d, "%s: error: the Jacobian cannot be computed to %ld digits there", job->scene->path, (long)digits);
}

void jacobian_invariants(arb_t trace, arb_t det, arb_srcptr j) {
  NUMBERS(arb, a);
  slong prec = 64; /* products of midpoints stay exact */
  for (int i = 0; i < 4; i++) prec = FLINT_MAX(prec, 2 * arb_bits(j + i) + 64);
  arb_add(trace, j, j + 3, prec);
  arb_mul(det, j, j + 3, prec);
  arb_mul(a, j + 1, j + 2, prec);
  arb_sub(det, det, a, prec);
  /* J_f J_c J_b is a column and J_a a row, and the model's map before t_a likewise leads to one number */
  if (arb_contains_zero(det)) arb_zero(det);
}

void jacobian_accuracy(arb_t worst, arb_srcptr x, slong n) {
  arb_zero(worst);
  for (slong i = 0; i < n; i++)
    if (mag_cmp(arb_radref(x + i), arb_radref(worst)) > 0) mag_set(arb_radref(worst), arb_radref(x + i));
  arf_set_mag(arb_midref(worst), arb_radref(worst));
  mag_zero(arb_radref(worst));
}

bool audit_jacobian(arb_ptr j, arb_t trace, arb_t det, const struct model *m, const struct scene *s,
                    const struct jacobian_request *q, struct diag *d) {
  OWNED_CLEARED(job_clear) struct jacobian_job job;
  bool precise, ok = job_init(&job, m, s, q, d);
  if (ok) {
    int status = refine(j, &precise, &job, q->method, q->layer, NULL, q->digits);
    if (!d->set && (status || !precise)) complain(&job, q->method, q->digits);
    ok = !d->set;
  }
  if (ok) jacobian_invariants(trace, det, j);
  if (ok && !(has_digits(j, 4) && has_digits(trace, 1))) complain(&job, q->method, q->digits);
  return !d->set;
}

/* --- Phase by phase --- */

const struct jacobian_column jacobian_columns[N_COLUMNS] = {
    {"analytic-printed", "printed", METHOD_ANALYTIC, LAYER_PRINTED},
    {"analytic-corrected", "corrected", METHOD_ANALYTIC, LAYER_CORRECTED},
    {"implicit", "implicit", METHOD_IMPLICIT, LAYER_CORRECTED},
    {"saltation", "saltation", METHOD_SALTATION, LAYER_CORRECTED},
    {"fd", "fd", METHOD_FD, LAYER_CORRECTED},
    {"fd-double", "fd-double", METHOD_FD_DOUBLE, LAYER_CORRECTED},
    {"ode", "ode", METHOD_ODE, LAYER_CORRECTED},
};

void jacobian_phases_init(struct jacobian_phases *p) {
  *p = (struct jacobian_phases){.known = 0};
  for (int i = 0; i < N_MATRICES; i++) {
    struct jacobian_matrix *a = &p->matrix[i];
    const struct local_map *map = i < N_PHASES ? &local_maps[i] : NULL;
    a->name = map ? map->name : "J";
    a->phase = map ? phase_name[map->phase] : NULL;
    a->rows = map ? map->rows : 2;
    a->cols = map ? map->cols : 2;
    for (int c = 0; c < N_COLUMNS; c++) a->entry[c] = _arb_vec_init(MATRIX_MOST);
  }
}

void jacobian_phases_clear(struct jacobian_phases *p) {
  for (int i = 0; i < N_MATRICES; i++)
    for (int c = 0; c < N_COLUMNS; c++) _arb_vec_clear(p->matrix[i].entry[c], MATRIX_MOST);
}

/* A method departs where its enclosure is disjoint from those of more than half of the others. */
static void find_departures(struct jacobian_matrix *a) {
  for (int e = 0; e < a->rows * a->cols; e++)
    for (int c = 0; c < N_COLUMNS; c++) {
      int others = 0, apart = 0;
      for (int o = 0; o < N_COLUMNS; o++) {
        if (o == c || !a->known[c] || !a->known[o]) continue;
        others++;
        apart += !arb_overlaps(a->entry[c] + e, a->entry[o] + e);
      }
      a->departs[c][e] = 2 * apart > others;
    }
}

bool audit_phases(struct jacobian_phases *out, const struct model *m, const struct scene *s,
                  const struct jacobian_request *q, struct diag *d) {
  OWNED_CLEARED(job_clear) struct jacobian_job job;
  bool ok = job_init(&job, m, s, q, d);
  for (int i = 0; ok && i < N_MATRICES; i++) {
    struct jacobian_matrix *a = &out->matrix[i];
    for (int c = 0; ok && c < N_COLUMNS; c++) {
      const struct jacobian_column *col = &jacobian_columns[c];
      bool precise;
      int status =
          refine(a->entry[c], &precise, &job, col->method, col->layer, i < N_PHASES ? &local_maps[i] : NULL, q->digits);
      a->known[c] = status == SS_OK;
      out->known += a->known[c];
      ok = !d->set;
    }
    find_departures(a);
  }
  if (ok && out->known == 0) complain(&job, METHOD_IMPLICIT, q->digits);
  return !d->set;
}
