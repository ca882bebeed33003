/* The paper's own procedure as a method: the equations (44)-(46) against the one-dimensional return map and the six
   equations.

   Each orbit of each scene on file, its e1 and e2 rounded to double and then exact, is solved for in double by the
   three methods, beside the condition numbers of what each inverts.  Then the other way round: with t_b, t_c, t_d known
   to a few printed digits, what are t_a, z_10, z_20?  Last, a line of orbits that passes one at which N_1 - I is
   singular. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "bench/figure.h"
#include "bench/jobs.h"
#include "bench/printed_digits.h"
#include "bench/study.h"
#include "bench/three_ways.h"
#include "motion/dual.h"
#include "value/orbits.h"

enum { PREC = THREE_WAYS_BITS };

static void add_lost(struct study_table *t, const struct three_ways *l) {
  const double k[] = {l->k_paper, l->k_n1, l->k_n3, l->k_six, l->k_map}, d[] = {l->paper, l->six, l->map};
  for (int i = 0; i < COUNT(k); i++) study_cells(t, "%.3g", k[i]);
  for (int i = 0; i < COUNT(d); i++) study_cells(t, isfinite(d[i]) ? "%.1f" : "fails", d[i]);
  study_row(t);
}

/* --- Orbits. --- */

/* A set of parameters, e1 and e2 rounded to double, and its orbits. */
struct found {
  double p[N_PARAMS];
  fmpq *exact;
  struct dyn_orbits list;
};

static void found_init(struct found *f, const fmpq *model, double e1, double e2) {
  for (int i = 0; i < N_PARAMS; i++) f->p[i] = i == P_E1 ? e1 : i == P_E2 ? e2 : fmpq_get_d(model + i);
  f->exact = bench_exact(f->p);
  dyn_orbits_find(&f->list, f->exact, PREC, NULL);
}

static void found_clear(struct found *f) {
  dyn_orbits_clear(&f->list);
  _fmpq_vec_clear(f->exact, N_PARAMS);
}

/* Digits asked for; orbits, how often their working precision was raised, and the most bits it had beyond those asked
   for. */
static const int asked[] = {15, 50, 150, 300, 1000};
struct planned {
  long orbits, raises, most;
};

struct tables {
  struct planned planned[COUNT(asked)];
  struct study_table *conditions, *printed, *summary, *singular;
  bool quick;
  double worst[3];    /* digits lost by paper, six and map, where they do not fail; over the orbits of scenes */
  int orbits, failed; /* failed: by the paper's equations */
  double (*digit)[3]; /* of t_a, by number of printed digits and method, for the summary */
  int n;
  size_t cap;
};

static const int counts[] = {2, 3, 4, 8};
static const char *const ways[] = {"(45), first", "(45), second", "t_b and t_c"};

static void add_digits(struct tables *all, const char *scene, slong number, int digits, int way,
                       const struct printed_digits *d) {
  struct study_table *t = all->printed;
  study_cells(t, "%s\t%ld\t%d\t%s", scene, (long)number + 1, digits, ways[way]);
  for (int i = 0; i < N_WANTED; i++) study_cells(t, "%.1f\t%.1f\t%.1f", d->printed[i], d->worst[i], d->sure[i]);
  study_row(t);
}

static void from_printed(struct tables *all, const char *scene, slong number, const struct found *f) {
  const struct dyn_orbit *o = &f->list.orbit[number];
  OWNED(num_vec) params;
  ARB_VECTOR(truth_of, N_WANTED);
  double t[3];
  for (int k = 0; k < 3; k++) t[k] = num_arb.get_d(o->t[PHASE_GAMMA + k]);
  printed_wanted(truth_of, o);
  num_vec_init(&params, N_PARAMS, dual_ctx(128));
  for (int i = 0; i < N_PARAMS; i++) num_dual.set_q(num_vec_at(&params, i), f->exact + i, 128);
  for (int k = 0; k < COUNT(counts); k++) {
    OWNED(printed_times) p;
    printed_times_set(&p, t, counts[k]);
    for (int way = 0; way < COUNT(ways); way++) {
      struct printed_digits d;
      if (way < 2)
        printed_row_digits(&d, way, &params, &p, truth_of, all->quick ? 2 : 4);
      else
        printed_pair_digits(&d, f->exact, &p, t[2], truth_of);
      add_digits(all, scene, number, counts[k], way, &d);
      const double kept[3] = {k, way, d.worst[0]};
      memcpy(SS_PUSH(all->digit, all->n, all->cap), kept, sizeof kept);
    }
  }
}

static void count_raises(struct tables *all, const fmpq *params) {
  for (int k = 0; k < (all->quick ? 2 : COUNT(asked)); k++) {
    struct planned *p = &all->planned[k];
    slong prec = (slong)ceil(asked[k] * log2(10)) + 64;
    OWNED(dyn_orbits) list;
    dyn_orbits_find(&list, params, prec, NULL);
    p->orbits += list.n;
    p->raises += list.raises;
    if (list.n > 0) p->most = FLINT_MAX(p->most, list.bits - prec);
  }
}

static void add_raises(struct study_page *page, const struct tables *all) {
  struct study_table *t = study_table(
      page, "precision", "The first working precision", "digits\torbits\traised\tbeyond",
      "The orbits of the scenes that give e1 and e2, enclosed to so many digits and 64 bits more. raised: how often "
      "the working precision had to be raised, over all of them; beyond: the most bits that the first one had beyond "
      "those asked for (planned from a pilot run above 512 bits, 40 below).");
  for (int k = 0; k < COUNT(asked); k++) {
    const struct planned *p = &all->planned[k];
    if (p->orbits == 0) continue;
    study_cells(t, "%d\t%ld\t%ld\t%ld", asked[k], p->orbits, p->raises, p->most);
    study_row(t);
  }
}

/* Every orbit of a scene, and of scenes that give times every one of the forces that belong to them. */
static void study_scene(struct tables *all, const struct scene *s) {
  int times = 0;
  for (int k = KEY_TA; k <= KEY_TD; k++) times += s->given[k];
  if (scene_is_box(s) || (!scene_has_forces(s) && times < 2)) return;
  if (scene_has_forces(s)) count_raises(all, s->value);
  OWNED(dyn_orbits) list;
  audit_orbits(&list, s, PREC);
  for (slong i = 0; i < list.n; i++) {
    const struct dyn_orbit *o = &list.orbit[i];
    OWNED(found) f;
    found_init(&f, s->value, num_arb.get_d(o->e1), num_arb.get_d(o->e2));
    for (slong k = 0; k < f.list.n; k++) {
      const struct dyn_orbit *near = &f.list.orbit[k];
      struct three_ways l;
      if (fabs(num_arb.get_d(near->z10) - num_arb.get_d(o->z10)) > 1e-6 * (1 + fabs(num_arb.get_d(o->z10)))) continue;
      three_ways(&l, f.p, f.exact, near);
      study_cells(all->conditions, "%s\t%ld\t%.6g", s->name, (long)i + 1, num_arb.get_d(near->trace));
      add_lost(all->conditions, &l);
      all->orbits++;
      all->failed += isnan(l.paper);
      const double lost[] = {l.paper, l.six, l.map};
      for (int m = 0; m < COUNT(lost); m++) all->worst[m] = fmax(all->worst[m], lost[m]);
      from_printed(all, s->name, k, &f);
    }
  }
}

/* Scenes on file in the order of their names; quick: those of the paper and beside the singular orbit. */
static bool each_scene(struct tables *all, const char *data) {
  size_t n;
  LOCAL(arena, a);
  struct diag none = {0};
  FREED char **name = scene_names(&n, data, &a, &none);
  bool good = n > 0;
  for (size_t i = 0; i < n; i++) {
    struct diag d = {0};
    bool wanted = !all->quick || strcmp(name[i], "paper") == 0 || strcmp(name[i], "near-singular") == 0;
    if (wanted) {
      OWNED(scene) s;
      bool loaded = scene_load_with(&s, name[i], data, NULL, SCENE_OF_TWO_MASSES, &d);
      if (loaded && !scene_other_word(&s)) study_scene(all, &s);
      good = good && loaded;
    }
  }
  return good;
}

/* --- Beside the orbit at which N_1 - I is singular. --- */

static void line_model(fmpq *model) {
  fmpq_set_si(model, 15, 64);
  fmpq_set_si(model + 1, 2, 1);
  fmpq_one(model + 2);
}

/* The admissible orbit of the line at t_b; false when there is none. */
static bool orbit_on_line(struct dyn_orbits *list, slong *which, const fmpq *model, const fmpq_t tb) {
  static const enum dyn_quantity given[2] = {QUANTITY_TB, QUANTITY_TC};
  FMPQ_VECTOR(value, 2);
  fmpq_set(value, tb);
  fmpq_set_si(value + 1, 43, 32);
  dyn_orbits_given(list, model, given, value, PREC, NULL);
  for (*which = 0; *which < list->n; ++*which)
    if (list->orbit[*which].admissible == TRUTH_TRUE) return true;
  return false;
}

/* The sign of det(N_1 - I) at the orbit; 0: not told, or no orbit. */
static int sign_at(const fmpq *model, const fmpq_t tb) {
  struct num_ctx ctx = num_ctx_arb(PREC);
  OWNED(dyn_orbits) list;
  OWNED(num_vec) params, a, lead, det;
  slong which;
  int sign = 0;
  num_vec_init(&params, N_PARAMS, ctx);
  num_vec_init(&a, N_STATE * N_STATE, ctx);
  num_vec_init(&lead, 4, ctx);
  num_vec_init(&det, 1, ctx);
  for (int i = 0; i < 3; i++) arb_set_fmpq(num_vec_at(&params, i), model + i, PREC);
  if (orbit_on_line(&list, &which, model, tb)) {
    struct dyn_orbit *o = &list.orbit[which];
    const struct num_vec t = {ctx, 3, (char *)o->t[PHASE_GAMMA]};
    arb_set(num_vec_at(&params, P_E1), o->e1);
    arb_set(num_vec_at(&params, P_E2), o->e2);
    int status = printed_matrix(&a, &params, &t);
    for (int k = 0; k < 4; k++)
      arb_sub_ui(num_vec_at(&lead, k), num_vec_at(&a, k / 2 * N_STATE + k % 2), k % 3 == 0, PREC);
    status |= num_mat_det(num_vec_at(&det, 0), &lead, 2);
    sign = status ? 0 : arb_sgn_nonzero(num_vec_at(&det, 0));
  }
  return sign;
}

/* Where the sign changes between 2.3855 and 2.3856, to about 1e-24. */
static bool find_singular(fmpq_t tb, const fmpq *model) {
  NUMBERS(fmpq, low, high);
  fmpq_set_si(low, 23855, 10000);
  fmpq_set_si(high, 23856, 10000);
  int sign = sign_at(model, low);
  bool good = sign != 0 && sign_at(model, high) == -sign;
  for (int i = 0; i < 66 && good; i++) {
    fmpq_add(tb, low, high);
    fmpq_div_2exp(tb, tb, 1);
    fmpq_set(sign_at(model, tb) == sign ? low : high, tb);
  }
  return good;
}

static bool study_line(struct tables *all) {
  FMPQ_VECTOR(model, 3);
  NUMBERS(fmpq, singular, tb);
  line_model(model);
  bool good = find_singular(singular, model);
  for (int k = 1; k <= (all->quick ? 4 : 11) && good; k++) {
    OWNED(dyn_orbits) list;
    slong which;
    fmpq_set_si(tb, 1, 1);
    fmpz_ui_pow_ui(fmpq_denref(tb), 10, (ulong)k);
    fmpq_add(tb, singular, tb);
    if (orbit_on_line(&list, &which, model, tb)) {
      const struct dyn_orbit *o = &list.orbit[which];
      OWNED(found) f;
      found_init(&f, model, num_arb.get_d(o->e1), num_arb.get_d(o->e2));
      for (slong i = 0; i < f.list.n; i++) {
        struct three_ways l;
        if (f.list.orbit[i].admissible != TRUTH_TRUE) continue;
        three_ways(&l, f.p, f.exact, &f.list.orbit[i]);
        study_cells(all->singular, "1e-%02d\t%.15g\t%.6g", k, fmpq_get_d(tb), num_arb.get_d(f.list.orbit[i].trace));
        add_lost(all->singular, &l);
      }
    }
  }
  return good;
}

/* --- The page. --- */

static void summarize(struct tables *all) {
  FREED double *x = ss_malloc((size_t)(all->n + 1) * sizeof *x);
  for (int k = 0; k < COUNT(counts); k++)
    for (int way = 0; way < COUNT(ways); way++) {
      int n = 0, none = 0;
      for (int i = 0; i < all->n; i++) {
        if ((int)all->digit[i][0] != k || (int)all->digit[i][1] != way) continue;
        x[n++] = all->digit[i][2];
        none += all->digit[i][2] < 1;
      }
      if (n == 0) continue;
      double middle = bench_median(x, n);
      study_cells(all->summary, "%d\t%s\t%d\t%.1f\t%.1f\t%.1f\t%d", counts[k], ways[way], n, x[0], middle, x[n - 1],
                  none);
      study_row(all->summary);
    }
}

static void draw(struct study_page *page, const struct study_table *t) {
  static const char *const column[] = {"paper", "six", "map"};
  struct figure f = {.id = "procedure", .title = page->study->title, .panels = 1};
  f.panel[0] = (struct figure_panel){
      .x = "distance in t_b from the orbit at which N_1 \xe2\x88\x92 I is singular",
      .y = "digits of 16 lost in double, on the line *\xcf\x87* = 15/64, *\xce\xb7* = 2, *V* = 1, *t*_c = 43/32",
      .power = {true}};
  OWNED(rows) rows;
  rows_parse(&rows, text_str(&t->tsv));
  for (int k = 0; k < COUNT(column); k++) {
    figure_curve(&f, column[k]);
    for (size_t i = 0; i < rows.n; i++)
      figure_point(&f, 0, log10(rows_number(&rows, i, rows_column(&rows, "distance"))),
                   rows_number(&rows, i, rows_column(&rows, column[k])));
  }
  figure_svg(&page->figure, &f);
}

#define LOST "cond_paper\tcond_N1-I\tcond_N3\tcond_six\tcond_map\tpaper\tsix\tmap"

static bool run(struct study_page *page, const struct bench_env *env) {
  struct tables all = {.quick = page->quick};
  if (!env->data) return false;
  all.conditions =
      study_table(page, "conditions", "Conditioning of three methods", "scene\torbit\ttrace\t" LOST,
                  "e1 and e2 are rounded to double and then exact. cond: |A| |A^-1| in the row-sum norm of the paper's "
                  "four equations' Jacobian, of N_1 - I and N_3 which they invert, and of the six equations' Jacobian; "
                  "cond_map is 1/|1 - tr J|. paper, six, map: decimal digits of 16 lost in double by Newton's "
                  "iteration on the paper's equations, on the six and on the return map, at the worst of the four "
                  "times (in units of the period) and the two positions.");
  all.summary = study_table(page, "summary", "Correct digits of t_a from printed times, over all orbits",
                            "printed\tway\torbits\tleast\tmedian\tmost\tnone",
                            "At the worst of the points looked at in the box of roundings. none: orbits with not one "
                            "digit right.");
  all.printed = study_table(
      page, "printed", "Correct digits from printed times",
      "scene\torbit\tprinted\tway\tt_a\tt_a_worst\tt_a_sure\tz10\tz10_worst\tz10_sure\tz20\tz20_worst\tz20_sure",
      "From t_b, t_c, t_d rounded to so many significant digits: by the first or the second equation (45), then (46); "
      "and from t_b and t_c alone, t_d being solved for. First the digits of what the rounded times give, then the "
      "fewest over 27 (9) points of the box of numbers that round to them, then a bound that holds in the whole box, "
      "by balls (values at the middles of cells and slopes over the cells).");
  all.singular =
      study_table(page, "singular", "Beside a singular N_1 - I", "distance\tt_b\ttrace\t" LOST,
                  "Admissible orbits with chi = 15/64, eta = 2, V = 1 and t_c = 43/32, at a distance in t_b from "
                  "the one at which det(N_1 - I) changes its sign. Columns as above.");
  bool good = each_scene(&all, env->data);
  summarize(&all);
  add_raises(page, &all);
  good = study_line(&all) && good;
  text_printf(&page->found,
              "- %d orbits of scenes: in double the paper's equations lose up to %.1f digits, the six up to %.1f, the "
              "map up to "
              "%.1f,\n  each at its own worst one; the paper's fail on %d\n",
              all.orbits, all.worst[0], all.worst[1], all.worst[2], all.failed);
  draw(page, all.singular);
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
