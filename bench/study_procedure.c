/* The paper's own procedure as a method: the equations (44)-(46) against the one-dimensional return map and the six
   equations.

   Each orbit of each scene on file, its e1 and e2 rounded to double and then exact, is solved for in double by the three
   methods, beside the condition numbers of what each inverts.  Then the other way round: with t_b, t_c, t_d known to a few
   printed digits, what are t_a, z_10, z_20?  With A = C H Gamma in blocks A1 A2; A3 A4, N = A D makes the two equations (45)
   linear in t_a,

     t_a (A1 - I)^-1 u + (A1 - I)^-1 A2 u - A3^-1 (A4 - I) u = 0,   u = (1, 1),

   so each of them alone gives t_a, and (46) z_0; on an orbit they agree.  Third, t_b and t_c alone, the rest being solved
   for (given.h).  Last, a line of orbits that passes one at which N_1 - I is singular. */
#include <dirent.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/jobs.h"
#include "bench/study.h"
#include "dynamics/dual.h"
#include "stickslip/arena.h"
#include "stickslip/paper_route.h"

enum { PREC = 256, N_WANTED = 3 }; /* wanted: t_a, z_10, z_20 */

/* --- The three methods in double. --- */

struct lost {
  double paper, six, map; /* digits, as paper_route.h counts them; NAN: the method failed */
  double k_paper, k_n1, k_n3, k_six, k_map;
};

/* digits_lost of paper_route.h; x: t_a, t_b, t_c, t_d, z_10, z_20. */
static double digits_lost(const double x[N_ROUTE], const struct dyn_orbit *o) {
  arb_t off;
  double worst = 0, period = 0, reach = fabs(x[ROUTE_Z]) + fabs(x[ROUTE_Z + 1]);
  arb_init(off);
  for (int i = 0; i < ROUTE_Z; i++) period += fabs(x[i]);
  for (int i = 0; i < N_ROUTE; i++) {
    arb_set_d(off, x[i]);
    arb_sub(off, off, i < ROUTE_Z ? o->t[i] : i == ROUTE_Z ? o->z10 : o->z20, PREC);
    worst = fmax(worst, fabs(num_arb.get_d(off)) / (i < ROUTE_Z ? period : reach));
  }
  arb_clear(off);
  return isfinite(worst) ? fmax(0, log10(ldexp(worst, 53))) : (double)NAN;
}

static double row_norm(const double *m, int n) {
  double most = 0;
  for (int i = 0; i < n; i++) {
    double sum = 0;
    for (int k = 0; k < n; k++) sum += fabs(m[i * n + k]);
    most = fmax(most, sum);
  }
  return most;
}

/* The condition number of the six equations' Jacobian in the row-sum norm. */
static double condition_six(const double *params, const double x[SIX]) {
  double f[SIX], j[SIX * SIX], inverse[SIX * SIX], norm;
  int sign;
  bench_six(f, j, params, x);
  norm = row_norm(j, SIX);
  gsl_matrix_view a = gsl_matrix_view_array(j, SIX, SIX), b = gsl_matrix_view_array(inverse, SIX, SIX);
  gsl_permutation *perm = gsl_permutation_alloc(SIX);
  gsl_linalg_LU_decomp(&a.matrix, perm, &sign);
  bool singular = gsl_linalg_LU_det(&a.matrix, sign) == 0;
  if (!singular) gsl_linalg_LU_invert(&a.matrix, perm, &b.matrix);
  gsl_permutation_free(perm);
  return singular ? INFINITY : norm * row_norm(inverse, SIX);
}

/* Newton's iteration on the six equations from x; its last steps stay at the level of rounding. */
static void solve_six(double x[SIX], const double *params) {
  enum { STEPS = 8 };
  for (int n = 0; n < STEPS; n++) {
    double f[SIX], j[SIX * SIX], dx[SIX];
    int sign;
    bench_six(f, j, params, x);
    gsl_matrix_view a = gsl_matrix_view_array(j, SIX, SIX);
    gsl_vector_view b = gsl_vector_view_array(f, SIX), d = gsl_vector_view_array(dx, SIX);
    gsl_permutation *perm = gsl_permutation_alloc(SIX);
    gsl_linalg_LU_decomp(&a.matrix, perm, &sign);
    bool singular = gsl_linalg_LU_det(&a.matrix, sign) == 0;
    if (!singular) gsl_linalg_LU_solve(&a.matrix, perm, &b.vector, &d.vector);
    gsl_permutation_free(perm);
    for (int i = 0; i < SIX; i++) x[i] = singular ? (double)NAN : x[i] - dx[i];
    if (singular) return;
  }
}

static void six_of(double x[SIX], const struct dyn_orbit *o) {
  x[0] = num_arb.get_d(o->z10);
  x[1] = num_arb.get_d(o->z20);
  for (int i = 0; i < N_PHASES; i++) x[2 + i] = num_arb.get_d(o->t[i]);
}

static double lost_by_six(const double *params, const struct dyn_orbit *o) {
  double x[SIX];
  six_of(x, o);
  solve_six(x, params);
  const double y[N_ROUTE] = {x[2], x[3], x[4], x[5], x[0], x[1]};
  return digits_lost(y, o);
}

static double lost_by_map(const double *params, const struct dyn_orbit *o) {
  double x[N_ROUTE + 1], r = num_arb.get_d(o->z20) - num_arb.get_d(o->z10);
  long steps;
  return bench_orbit_by_map(x, &steps, params, r) ? (double)NAN : digits_lost(x, o);
}

/* params as doubles and as rationals, which are equal. */
static void compare(struct lost *l, const double *params, const fmpq *exact, const struct dyn_orbit *o) {
  struct paper_route route;
  double x[SIX];
  six_of(x, o);
  paper_route_init(&route, PREC);
  paper_route_run(&route, exact, o->guess);
  *l = (struct lost){.paper = route.digits_lost,
                     .six = lost_by_six(params, o),
                     .map = lost_by_map(params, o),
                     .k_paper = route.condition.jacobian,
                     .k_n1 = route.condition.n1,
                     .k_n3 = route.condition.n3,
                     .k_six = condition_six(params, x),
                     .k_map = 1 / fabs(1 - num_arb.get_d(o->trace))};
  paper_route_clear(&route);
}

static void add_lost(struct study_table *t, const struct lost *l) {
  const double k[] = {l->k_paper, l->k_n1, l->k_n3, l->k_six, l->k_map}, d[] = {l->paper, l->six, l->map};
  for (int i = 0; i < COUNT(k); i++) study_number(t, k[i], 3);
  for (int i = 0; i < COUNT(d); i++)
    if (isfinite(d[i]))
      study_text(t, "%.1f", d[i]);
    else
      study_text(t, "fails");
  study_row(t);
}

/* --- t_a, z_10, z_20 from t_b, t_c, t_d. --- */

/* (x y; z w)^-1 (a; b). */
static void solve_two(val out[2], struct calc *c, const val m[4], val a, val b) {
  val det = calc_sub(c, calc_mul(c, m[0], m[3]), calc_mul(c, m[1], m[2]));
  out[0] = calc_div(c, calc_sub(c, calc_mul(c, m[3], a), calc_mul(c, m[1], b)), det);
  out[1] = calc_div(c, calc_sub(c, calc_mul(c, m[0], b), calc_mul(c, m[2], a)), det);
}

/* The values that equation `row` (0, 1) of (45) and then (46) give, in balls; not finite where they cannot be had.  params
   and t are duals, t those of the directions 0, 1, 2; slope, unless NULL: derivatives by these, value by value. */
static void by_row(arb_ptr out, arb_ptr slope, int row, const struct num_vec *params, const struct num_vec *t) {
  enum { SIZE = N_STATE * N_STATE };
  struct num_ctx ctx = params->ctx;
  struct num_vec a, step;
  struct calc c;
  num_vec_init(&a, SIZE, ctx);
  num_vec_init(&step, SIZE, ctx);
  calc_init(&c, ctx);
  int status = dyn_flow_matrix(&a, PHASE_GAMMA, params, num_vec_at(t, 0));
  for (int k = 1; k < 3; k++) {
    status |= dyn_flow_matrix(&step, (enum phase)(PHASE_GAMMA + k), params, num_vec_at(t, k));
    status |= num_mat_mul(&a, &step, &a, N_STATE, N_STATE, N_STATE);
  }
  val m[SIZE], one = calc_d(&c, 1), V = num_vec_at(params, P_V), x[2], y[2], s[2];
  flow_vals(m, &a, 0, SIZE);
  const val lead[4] = {calc_sub(&c, m[0], one), m[1], m[4], calc_sub(&c, m[5], one)},
            low[4] = {m[8], m[9], m[12], m[13]};
  solve_two(s, &c, lead, one, one);                                           /* (A1 - I)^-1 u */
  solve_two(x, &c, lead, calc_add(&c, m[2], m[3]), calc_add(&c, m[6], m[7])); /* (A1 - I)^-1 A2 u */
  solve_two(y, &c, low, calc_add(&c, calc_sub(&c, m[10], one), m[11]),
            calc_add(&c, m[14], calc_sub(&c, m[15], one))); /* A3^-1 (A4 - I) u */
  val got[N_WANTED] = {calc_div(&c, calc_sub(&c, y[row], x[row]), s[row])};
  for (int i = 0; i < 2; i++) {
    val part = calc_mul(&c, got[0], calc_add(&c, one, s[i]));
    got[1 + i] = calc_neg(&c, calc_mul(&c, V, calc_add(&c, x[i], part)));
  }
  for (int i = 0; i < N_WANTED; i++) {
    arb_set(out + i, dual_value(got[i]));
    for (int k = 0; k < 3 && slope; k++) arb_set(slope + 3 * i + k, dual_slope(got[i], k));
  }
  if (status | c.status) _arb_vec_indeterminate(out, N_WANTED);
  calc_clear(&c);
  num_vec_clear(&step);
  num_vec_clear(&a);
}

/* From t_b and t_c alone: the orbit whose t_d is nearest. */
static void by_pair(arb_ptr out, const fmpq *model, const fmpq *t, double td) {
  static const enum dyn_quantity which[2] = {QUANTITY_TB, QUANTITY_TC};
  struct dyn_orbits list;
  double least = INFINITY;
  _arb_vec_indeterminate(out, N_WANTED);
  dyn_orbits_given(&list, model, which, t, 128, NULL);
  for (slong i = 0; i < list.n; i++) {
    const struct dyn_orbit *o = &list.orbit[i];
    double off = fabs(num_arb.get_d(o->t[PHASE_C]) - td);
    if (off >= least) continue;
    least = off;
    arb_set(out, o->t[PHASE_D]);
    arb_set(out + 1, o->z10);
    arb_set(out + 2, o->z20);
  }
  dyn_orbits_clear(&list);
}

/* Correct digits of every point of the ball: at least 0, at most 20. */
static double digits_of(arb_srcptr got, arb_srcptr truth_of) {
  arb_t off;
  mag_t most;
  double digits = 0;
  arb_init(off);
  mag_init(most);
  if (arb_is_finite(got)) {
    arb_sub(off, got, truth_of, PREC);
    arb_div(off, off, truth_of, 64);
    arb_get_mag(most, off);
    digits = fmin(20, fmax(0, -log10(mag_get_d(most))));
  }
  mag_clear(most);
  arb_clear(off);
  return digits;
}

/* The three times as printed, and half a unit of their last digit. */
struct printed_times {
  fmpq t[3], half[3];
};

static void print_times(struct printed_times *p, const double t[3], int digits) {
  for (int k = 0; k < 3; k++) {
    char s[64];
    int exponent;
    snprintf(s, sizeof s, "%.*e", digits - 1, t[k]);
    exponent = atoi(strchr(s, 'e') + 1) - (digits - 1);
    fmpq_init(&p->t[k]);
    fmpq_init(&p->half[k]);
    num_parse_decimal(&p->t[k], s, strlen(s));
    fmpq_set_si(&p->half[k], 1, 2);
    fmpz *side = exponent < 0 ? fmpq_denref(&p->half[k]) : fmpq_numref(&p->half[k]);
    fmpz_t power;
    fmpz_init(power);
    fmpz_ui_pow_ui(power, 10, (ulong)abs(exponent));
    fmpz_mul(side, side, power);
    fmpz_clear(power);
    fmpq_canonicalise(&p->half[k]);
  }
}

static void printed_clear(struct printed_times *p) {
  for (int k = 0; k < 3; k++) {
    fmpq_clear(&p->t[k]);
    fmpq_clear(&p->half[k]);
  }
}

/* t + half * (at/n - 1), exactly on the grid; wide: with everything up to half/n on both sides. */
static void place(struct num_vec *t, const struct printed_times *p, const int at[3], int n, bool wide) {
  fmpq_t x;
  arf_t radius;
  fmpq_init(x);
  arf_init(radius);
  for (int k = 0; k < 3; k++) {
    struct dual *z = num_vec_at(t, k);
    fmpq_set_si(x, at[k] - n, (ulong)n);
    fmpq_mul(x, x, &p->half[k]);
    fmpq_add(x, x, &p->t[k]);
    arb_set_fmpq(&z->v, x, t->ctx.prec);
    arb_one(&z->d[k]);
    arf_set_fmpq(radius, &p->half[k], 64, ARF_RND_UP);
    arf_div_ui(radius, radius, (ulong)n, 64, ARF_RND_UP);
    if (wide) arb_add_error_arf(&z->v, radius);
  }
  arf_clear(radius);
  fmpq_clear(x);
}

/* The values over the cell around a point: those at the point and slopes over the cell times what it extends. */
static void over_cell(arb_ptr out, int row, const struct num_vec *params, struct num_vec *t,
                      const struct printed_times *p, const int at[3], int n) {
  arb_ptr slope = _arb_vec_init(N_WANTED * 3), middle = _arb_vec_init(3), wide = _arb_vec_init(N_WANTED);
  slong prec = params->ctx.prec;
  place(t, p, at, n, false);
  for (int k = 0; k < 3; k++) arb_set(middle + k, dual_value(num_vec_at(t, k)));
  by_row(out, NULL, row, params, t);
  place(t, p, at, n, true);
  by_row(wide, slope, row, params, t);
  for (int k = 0; k < 3; k++) {
    arb_sub(middle + k, dual_value(num_vec_at(t, k)), middle + k, prec);
    for (int i = 0; i < N_WANTED; i++) arb_addmul(out + i, slope + 3 * i + k, middle + k, prec);
  }
  _arb_vec_clear(middle, 3);
  _arb_vec_clear(wide, N_WANTED);
  _arb_vec_clear(slope, N_WANTED * 3);
}

/* Digits of the printed values themselves, the fewest at points of the box, and the fewest anywhere in it. */
struct digits {
  double printed[N_WANTED], worst[N_WANTED], sure[N_WANTED];
};

static void least_digits(double least[N_WANTED], arb_srcptr got, arb_srcptr truth_of) {
  for (int i = 0; i < N_WANTED; i++) least[i] = fmin(least[i], digits_of(got + i, truth_of + i));
}

static void rows_digits(struct digits *d, int row, const struct num_vec *params, const struct printed_times *p,
                        arb_srcptr truth_of, int n) {
  struct num_vec t;
  arb_ptr got = _arb_vec_init(N_WANTED);
  num_vec_init(&t, 3, params->ctx);
  for (int i = 0; i < N_WANTED; i++) d->printed[i] = d->worst[i] = d->sure[i] = INFINITY;
  place(&t, p, (int[]){1, 1, 1}, 1, false);
  by_row(got, NULL, row, params, &t);
  least_digits(d->printed, got, truth_of);
  for (int k = 0; k < 27; k++) {
    place(&t, p, (int[]){k % 3, k / 3 % 3, k / 9}, 1, false);
    by_row(got, NULL, row, params, &t);
    least_digits(d->worst, got, truth_of);
  }
  for (int k = 0; k < n * n * n; k++) {
    over_cell(got, row, params, &t, p, (int[]){2 * (k % n) + 1, 2 * (k / n % n) + 1, 2 * (k / n / n) + 1}, n);
    least_digits(d->sure, got, truth_of);
  }
  num_vec_clear(&t);
  _arb_vec_clear(got, N_WANTED);
}

static void pair_digits(struct digits *d, const fmpq *model, const struct printed_times *p, double td,
                        arb_srcptr truth_of) {
  arb_ptr got = _arb_vec_init(N_WANTED);
  fmpq *t = _fmpq_vec_init(2);
  for (int i = 0; i < N_WANTED; i++) {
    d->printed[i] = d->worst[i] = INFINITY;
    d->sure[i] = NAN;
  }
  by_pair(got, model, p->t, td);
  least_digits(d->printed, got, truth_of);
  for (int k = 0; k < 9; k++) {
    for (int i = 0; i < 2; i++) {
      int side = i ? k / 3 : k % 3;
      fmpq_set(t + i, &p->t[i]);
      if (side == 0) fmpq_sub(t + i, t + i, &p->half[i]);
      if (side == 2) fmpq_add(t + i, t + i, &p->half[i]);
    }
    by_pair(got, model, t, td);
    least_digits(d->worst, got, truth_of);
  }
  _fmpq_vec_clear(t, 2);
  _arb_vec_clear(got, N_WANTED);
}

/* --- Orbits. --- */

/* A set of parameters, e1 and e2 rounded to double, and its orbits. */
struct found {
  double p[N_PARAMS];
  fmpq *exact;
  struct dyn_orbits list;
};

static void found_init(struct found *f, const fmpq *model, double e1, double e2) {
  f->exact = _fmpq_vec_init(N_PARAMS);
  for (int i = 0; i < N_PARAMS; i++) {
    arf_t x;
    f->p[i] = i == P_E1 ? e1 : i == P_E2 ? e2 : fmpq_get_d(model + i);
    arf_init(x);
    arf_set_d(x, f->p[i]);
    arf_get_fmpq(f->exact + i, x);
    arf_clear(x);
  }
  dyn_orbits_find(&f->list, f->exact, PREC, NULL);
}

static void found_clear(struct found *f) {
  dyn_orbits_clear(&f->list);
  _fmpq_vec_clear(f->exact, N_PARAMS);
}

struct tables {
  struct study_table *conditions, *printed, *summary, *singular;
  bool quick;
  double (*digit)[3]; /* of t_a, by number of printed digits and method, for the summary */
  int n, cap;
};

static const int counts[] = {2, 3, 4, 8};
static const char *const ways[] = {"(45), first", "(45), second", "t_b and t_c"};

static void add_digits(struct tables *all, const char *scene, slong number, int digits, int way,
                       const struct digits *d) {
  struct study_table *t = all->printed;
  study_text(t, "%s\t%ld\t%d\t%s", scene, (long)number + 1, digits, ways[way]);
  for (int i = 0; i < N_WANTED; i++) {
    study_text(t, "%.1f", d->printed[i]);
    study_text(t, "%.1f", d->worst[i]);
    if (isnan(d->sure[i]))
      study_text(t, "-");
    else
      study_text(t, "%.1f", d->sure[i]);
  }
  study_row(t);
}

static void from_printed(struct tables *all, const char *scene, slong number, const struct found *f) {
  const struct dyn_orbit *o = &f->list.orbit[number];
  struct num_vec params;
  arb_ptr truth_of = _arb_vec_init(N_WANTED);
  double t[3];
  for (int k = 0; k < 3; k++) t[k] = num_arb.get_d(o->t[PHASE_GAMMA + k]);
  arb_set(truth_of, o->t[PHASE_D]);
  arb_set(truth_of + 1, o->z10);
  arb_set(truth_of + 2, o->z20);
  num_vec_init(&params, N_PARAMS, dual_ctx(128));
  for (int i = 0; i < N_PARAMS; i++) num_dual.set_q(num_vec_at(&params, i), f->exact + i, 128);
  for (int k = 0; k < COUNT(counts); k++) {
    struct printed_times p;
    print_times(&p, t, counts[k]);
    for (int way = 0; way < COUNT(ways); way++) {
      struct digits d;
      if (way < 2)
        rows_digits(&d, way, &params, &p, truth_of, all->quick ? 2 : 4);
      else
        pair_digits(&d, f->exact, &p, t[2], truth_of);
      add_digits(all, scene, number, counts[k], way, &d);
      if (all->n == all->cap) {
        all->cap = all->cap ? 2 * all->cap : 64;
        all->digit = ss_realloc(all->digit, (size_t)all->cap * sizeof *all->digit);
      }
      const double kept[3] = {k, way, d.worst[0]};
      memcpy(all->digit[all->n++], kept, sizeof kept);
    }
    printed_clear(&p);
  }
  num_vec_clear(&params);
  _arb_vec_clear(truth_of, N_WANTED);
}

/* Every orbit of a scene, and of scenes that give times every one of the forces that belong to them. */
static void study_scene(struct tables *all, const struct scene *s) {
  struct dyn_orbits list;
  int times = 0;
  for (int k = KEY_TA; k <= KEY_TD; k++) times += s->given[k];
  if (scene_is_box(s) || (!scene_has_forces(s) && times < 2)) return;
  audit_orbits(&list, s, PREC);
  for (slong i = 0; i < list.n; i++) {
    const struct dyn_orbit *o = &list.orbit[i];
    struct found f;
    found_init(&f, s->value, num_arb.get_d(o->e1), num_arb.get_d(o->e2));
    for (slong k = 0; k < f.list.n; k++) {
      const struct dyn_orbit *near = &f.list.orbit[k];
      struct lost l;
      if (fabs(num_arb.get_d(near->z10) - num_arb.get_d(o->z10)) > 1e-6 * (1 + fabs(num_arb.get_d(o->z10)))) continue;
      compare(&l, f.p, f.exact, near);
      study_text(all->conditions, "%s\t%ld", s->name, (long)i + 1);
      study_number(all->conditions, num_arb.get_d(near->trace), 6);
      add_lost(all->conditions, &l);
      from_printed(all, s->name, k, &f);
    }
    found_clear(&f);
  }
  dyn_orbits_clear(&list);
}

static int by_name(const void *x, const void *y) {
  return strcmp(*(char *const *)x, *(char *const *)y);
}

/* Scenes on file in the order of their names; quick: those of the paper and beside the singular orbit. */
static bool study_scenes(struct tables *all, const char *data) {
  struct text folder;
  char **name = NULL;
  size_t n = 0, cap = 0;
  text_init(&folder);
  text_printf(&folder, "%s/scenes", data);
  DIR *dir = opendir(text_str(&folder));
  for (struct dirent *e; dir && (e = readdir(dir)) != NULL;) {
    size_t len = strlen(e->d_name);
    if (len < 7 || strcmp(e->d_name + len - 6, ".scene") != 0) continue;
    name = ss_grow(name, n, &cap, sizeof *name);
    name[n] = ss_malloc(len);
    memcpy(name[n], e->d_name, len - 6);
    name[n++][len - 6] = '\0';
  }
  if (dir) closedir(dir);
  if (n > 0) qsort(name, n, sizeof *name, by_name);
  bool good = n > 0;
  for (size_t i = 0; i < n; i++) {
    struct scene s;
    struct diag d;
    bool wanted = !all->quick || strcmp(name[i], "paper") == 0 || strcmp(name[i], "near-singular") == 0;
    diag_init(&d);
    if (wanted) {
      bool loaded = scene_load_box(&s, name[i], data, &d);
      if (loaded) study_scene(all, &s);
      good = good && loaded;
      scene_clear(&s);
    }
    free(name[i]);
  }
  free(name);
  text_clear(&folder);
  return good;
}

/* --- Beside the orbit at which N_1 - I is singular. --- */

static const char singular_line[] = "chi = 15/64, eta = 2, V = 1, t_c = 43/32";

static void line_model(fmpq *model) {
  fmpq_set_si(model, 15, 64);
  fmpq_set_si(model + 1, 2, 1);
  fmpq_one(model + 2);
}

/* The admissible orbit of the line at t_b; false when there is none. */
static bool orbit_on_line(struct dyn_orbits *list, slong *which, const fmpq *model, const fmpq_t tb) {
  static const enum dyn_quantity given[2] = {QUANTITY_TB, QUANTITY_TC};
  fmpq *value = _fmpq_vec_init(2);
  fmpq_set(value, tb);
  fmpq_set_si(value + 1, 43, 32);
  dyn_orbits_given(list, model, given, value, PREC, NULL);
  _fmpq_vec_clear(value, 2);
  for (*which = 0; *which < list->n; ++*which)
    if (list->orbit[*which].admissible == TRUTH_TRUE) return true;
  return false;
}

/* The sign of det(N_1 - I) at the orbit; 0: not told, or no orbit. */
static int sign_at(const fmpq *model, const fmpq_t tb) {
  struct num_ctx ctx = num_ctx_arb(PREC);
  struct dyn_orbits list;
  struct num_vec params, a, step;
  slong which;
  int sign = 0;
  num_vec_init(&params, N_PARAMS, ctx);
  num_vec_init(&a, N_STATE * N_STATE, ctx);
  num_vec_init(&step, N_STATE * N_STATE, ctx);
  for (int i = 0; i < 3; i++) arb_set_fmpq(num_vec_at(&params, i), model + i, PREC);
  if (orbit_on_line(&list, &which, model, tb)) {
    const struct dyn_orbit *o = &list.orbit[which];
    arb_set(num_vec_at(&params, P_E1), o->e1);
    arb_set(num_vec_at(&params, P_E2), o->e2);
    int status = dyn_flow_matrix(&a, PHASE_GAMMA, &params, o->t[PHASE_GAMMA]);
    for (int k = PHASE_H; k <= PHASE_C; k++) {
      status |= dyn_flow_matrix(&step, (enum phase)k, &params, o->t[k]);
      status |= num_mat_mul(&a, &step, &a, N_STATE, N_STATE, N_STATE);
    }
    arb_t det, other;
    arb_init(det);
    arb_init(other);
    arb_sub_ui(det, num_vec_at(&a, 0), 1, PREC);
    arb_sub_ui(other, num_vec_at(&a, 5), 1, PREC);
    arb_mul(det, det, other, PREC);
    arb_submul(det, num_vec_at(&a, 1), num_vec_at(&a, 4), PREC);
    sign = status ? 0 : arb_is_positive(det) ? 1 : arb_is_negative(det) ? -1 : 0;
    arb_clear(det);
    arb_clear(other);
  }
  dyn_orbits_clear(&list);
  num_vec_clear(&params);
  num_vec_clear(&a);
  num_vec_clear(&step);
  return sign;
}

/* Where the sign changes between 2.3855 and 2.3856, to about 1e-24. */
static bool find_singular(fmpq_t tb, const fmpq *model) {
  fmpq_t low, high;
  fmpq_init(low);
  fmpq_init(high);
  fmpq_set_si(low, 23855, 10000);
  fmpq_set_si(high, 23856, 10000);
  int sign = sign_at(model, low);
  bool good = sign != 0 && sign_at(model, high) == -sign;
  for (int i = 0; i < 66 && good; i++) {
    fmpq_add(tb, low, high);
    fmpq_div_2exp(tb, tb, 1);
    fmpq_set(sign_at(model, tb) == sign ? low : high, tb);
  }
  fmpq_clear(low);
  fmpq_clear(high);
  return good;
}

static bool study_line(struct tables *all) {
  fmpq *model = _fmpq_vec_init(3);
  fmpq_t singular, tb;
  fmpq_init(singular);
  fmpq_init(tb);
  line_model(model);
  bool good = find_singular(singular, model);
  for (int k = 1; k <= (all->quick ? 4 : 11) && good; k++) {
    struct dyn_orbits list;
    slong which;
    fmpq_set_si(tb, 1, 1);
    fmpz_ui_pow_ui(fmpq_denref(tb), 10, (ulong)k);
    fmpq_add(tb, singular, tb);
    if (orbit_on_line(&list, &which, model, tb)) {
      const struct dyn_orbit *o = &list.orbit[which];
      struct found f;
      found_init(&f, model, num_arb.get_d(o->e1), num_arb.get_d(o->e2));
      for (slong i = 0; i < f.list.n; i++) {
        struct lost l;
        if (f.list.orbit[i].admissible != TRUTH_TRUE) continue;
        compare(&l, f.p, f.exact, &f.list.orbit[i]);
        study_text(all->singular, "1e-%02d", k);
        study_number(all->singular, fmpq_get_d(tb), 15);
        study_number(all->singular, num_arb.get_d(f.list.orbit[i].trace), 6);
        add_lost(all->singular, &l);
      }
      found_clear(&f);
    }
    dyn_orbits_clear(&list);
  }
  fmpq_clear(singular);
  fmpq_clear(tb);
  _fmpq_vec_clear(model, 3);
  return good;
}

/* --- The page. --- */

static int by_size(const void *x, const void *y) {
  double a = *(const double *)x, b = *(const double *)y;
  return (a > b) - (a < b);
}

static void summarize(struct tables *all) {
  double *x = ss_malloc((size_t)(all->n + 1) * sizeof *x);
  for (int k = 0; k < COUNT(counts); k++)
    for (int way = 0; way < COUNT(ways); way++) {
      int n = 0, none = 0;
      for (int i = 0; i < all->n; i++) {
        if ((int)all->digit[i][0] != k || (int)all->digit[i][1] != way) continue;
        x[n++] = all->digit[i][2];
        none += all->digit[i][2] < 1;
      }
      if (n == 0) continue;
      qsort(x, (size_t)n, sizeof *x, by_size);
      study_text(all->summary, "%d\t%s\t%d\t%.1f\t%.1f\t%.1f\t%d", counts[k], ways[way], n, x[0],
                 n % 2 ? x[n / 2] : 0.5 * (x[n / 2] + x[n / 2 - 1]), x[n - 1], none);
      study_row(all->summary);
    }
  free(x);
}

static void plot(struct study_page *page, const struct study_table *t) {
  static const char *const column[] = {"paper", "six", "map"};
  struct text *out = &page->plot, cell;
  text_init(&cell);
  for (int k = 0; k < COUNT(column); k++) {
    text_printf(out, "$d%d << EOD\n", k);
    for (int i = 0; i < study_rows(t); i++) {
      text_printf(out, "%s ", study_cell(&cell, t, i, "distance"));
      text_printf(out, "%s\n", study_cell(&cell, t, i, column[k]));
    }
    text_add(out, "EOD\n");
  }
  text_printf(out,
              "set terminal svg size 900,560 dynamic font 'sans,12' background '#ffffff'\n"
              "set output 'procedure.svg'\nset title 'Beside the orbit at which N_1 - I is singular: %s'\n"
              "set logscale x\nset format x '10^{%%T}'\nset grid lc '#d0d0d0'\nset xlabel 'distance in t_b'\n"
              "set ylabel 'digits of 16 lost in double'\nset key top right\nset datafile missing 'fails'\nplot ",
              singular_line);
  for (int k = 0; k < COUNT(column); k++)
    text_printf(out, "%s$d%d using 1:2 with linespoints pt %d dt %d lc %d title '%s'", k ? ", \\\n  " : "", k, k + 1,
                k + 1, k + 1, column[k]);
  text_add(out, "\n");
  text_clear(&cell);
}

#define LOST "cond_paper\tcond_N1-I\tcond_N3\tcond_six\tcond_map\tpaper\tsix\tmap"

static bool run(struct study_page *page, const struct bench_env *env) {
  struct tables all = {.quick = page->quick};
  if (!env->data) return false;
  all.conditions =
      study_table(page, "conditions", "Conditioning of three methods", "scene\torbit\ttrace\t" LOST,
                  "e1 and e2 are rounded to double and then exact. cond: |A| |A^-1| in the row-sum norm of the paper's "
                  "four equations' "
                  "Jacobian, of N_1 - I and N_3 which they invert, and of the six equations' Jacobian; cond_map is "
                  "1/|1 - tr J|. paper, "
                  "six, map: decimal digits of 16 lost in double by Newton's iteration on the paper's equations, on "
                  "the six and on the "
                  "return map, at the worst of the four times (in units of the period) and the two positions.");
  all.summary = study_table(page, "summary", "Correct digits of t_a from printed times, over all orbits",
                            "printed\tway\torbits\tleast\tmedian\tmost\tnone",
                            "At the worst of the points looked at in the box of roundings. none: orbits with not one "
                            "digit right.");
  all.printed = study_table(
      page, "printed", "Correct digits from printed times",
      "scene\torbit\tprinted\tway\tt_a\tt_a_worst\tt_a_sure\tz10\tz10_worst\tz10_sure\tz20\tz20_worst\tz20_sure",
      "From t_b, t_c, t_d rounded to so many significant digits: by the first or the second equation (45), then (46); "
      "and "
      "from t_b and t_c alone, t_d being solved for. First the digits of what the rounded times give, then the fewest "
      "over "
      "27 (9) points of the box of numbers that round to them, then a bound that holds in the whole box, by balls "
      "(values at the middles of cells and slopes over the cells).");
  all.singular =
      study_table(page, "singular", "Beside a singular N_1 - I", "distance\tt_b\ttrace\t" LOST,
                  "Admissible orbits with chi = 15/64, eta = 2, V = 1 and t_c = 43/32, at a distance in t_b from "
                  "the one at which det(N_1 - I) changes its sign. Columns as above.");
  bool good = study_scenes(&all, env->data);
  summarize(&all);
  good = study_line(&all) && good;
  plot(page, all.singular);
  free(all.digit);
  return good;
}

const struct study study_procedure = {
    .id = "procedure",
    .title = "The paper's own procedure",
    .question =
        "How well do the equations (44)-(46) serve as a method for finding the orbit, and how many digits of t_a, z_10 "
        "and z_20 do\nprinted times determine?",
    .run = run,
};
