/* stickslip simulate: the two masses under Coulomb's law from a start on an orbit or at the printed numbers, integrated by
   GSL; in the table, held against the closed forms event by event. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "stickslip/coulomb.h"

enum { MAX_PERIODS = 100000, MAX_SAMPLES = 1000000, DEFAULT_SAMPLES = 100 };

/* What is simulated, from where, and for how long. */
struct simulation {
  double params[N_COULOMB], start[N_STATE];
  double period;     /* of the orbit it starts on or beside; 0 when there is none */
  bool own_friction; /* u_r is ours, not the scene's */
  struct coulomb_plan plan;
};

static int parse_count(long *n, const char *text, long most, const char *option) {
  if (!text) return EXIT_AS_RECORDED;
  char *end;
  errno = 0;
  *n = strtol(text, &end, 10);
  if (!errno && !*end && end != text && *n >= 1 && *n <= most) return EXIT_AS_RECORDED;
  return usage("%s takes a whole number from 1 up", option);
}

/* --at orbit:K (from 0 into *orbit) or printed. */
static int parse_start(long *orbit, bool *printed, const char *at) {
  *orbit = 0;
  *printed = at && strcmp(at, "printed") == 0;
  if (!at || *printed) return EXIT_AS_RECORDED;
  char *end = NULL;
  errno = 0;
  long k = strncmp(at, "orbit:", 6) == 0 ? strtol(at + 6, &end, 10) : 0;
  if (k < 1 || errno || *end) return usage("--at takes orbit:K, K = 1, 2, ..., or printed, not %.200s", at);
  *orbit = k - 1;
  return EXIT_AS_RECORDED;
}

static double middle(const arb_t x) {
  return arf_get_d(arb_midref(x), ARF_RND_NEAR);
}

/* The scene's u_ri, else 5/4 max(e_i, u_ri_min). */
static double static_friction(const struct scene *s, int i, const struct dyn_orbit *o) {
  if (s->given[KEY_U_R1 + i]) return fmpq_get_d(&s->value[KEY_U_R1 + i]);
  double least = o ? middle(i == 0 ? o->u_r1_min : o->u_r2_min) : 0;
  return 1.25 * fmax(fmpq_get_d(&s->value[KEY_E1 + i]), least);
}

static int set_start(struct simulation *sim, double z10, double z20) {
  struct num_vec p, x, z;
  num_vec_init(&p, N_COULOMB, num_ctx_double());
  num_vec_init(&x, N_STATE, num_ctx_double());
  num_vec_init(&z, 2, num_ctx_double());
  for (int i = 0; i < N_COULOMB; i++) p.ctx.type->set_d(num_vec_at(&p, i), sim->params[i], 53);
  z.ctx.type->set_d(num_vec_at(&z, 0), z10, 53);
  z.ctx.type->set_d(num_vec_at(&z, 1), z20, 53);
  int s = coulomb_start_set(&x, &p, num_vec_at(&z, 0), num_vec_at(&z, 1));
  for (int i = 0; i < N_STATE; i++) sim->start[i] = x.ctx.type->get_d(num_vec_at(&x, i));
  num_vec_clear(&z);
  num_vec_clear(&x);
  num_vec_clear(&p);
  return s;
}

/* Friction and start; the orbit is the one asked for, at printed numbers the first, for its bounds and period. */
static bool prepare(struct simulation *sim, const struct scene *s, long orbit, bool printed, struct diag *d) {
  struct dyn_orbits list;
  dyn_orbits_find(&list, s->value, 128, &dyn_limits_default);
  const struct dyn_orbit *o = orbit < list.n ? &list.orbit[orbit] : NULL;
  const struct printed_number *z[2] = {scene_printed(s, "z10"), scene_printed(s, "z20")};
  bool ok = printed ? z[0] && z[1] : o != NULL;
  if (!ok && printed)
    diag_set(d, "%s: error: --at printed needs printed z10 and z20", s->path);
  else if (!ok)
    diag_set(d, "%s: error: there is no orbit %ld; the scene has %ld", s->path, orbit + 1, (long)list.n);
  if (ok) {
    for (int i = 0; i < 2; i++) {
      double e = fmpq_get_d(&s->value[KEY_E1 + i]), u_r = 0;
      for (slong k = 0; printed && k < list.n; k++) u_r = fmax(u_r, static_friction(s, i, &list.orbit[k]));
      if (!printed || list.n == 0) u_r = static_friction(s, i, o);
      sim->params[COULOMB_UR1 + i] = u_r;
      sim->params[COULOMB_US1 + i] = u_r - e;
      sim->own_friction = sim->own_friction || !s->given[KEY_U_R1 + i];
    }
    for (int i = 0; i < 3; i++) sim->params[COULOMB_CHI + i] = fmpq_get_d(&s->value[KEY_CHI + i]);
    sim->period = o ? middle(o->period) : 0;
    double z10 = printed ? fmpq_get_d(&z[0]->value) : middle(o->z10);
    double z20 = printed ? fmpq_get_d(&z[1]->value) : middle(o->z20);
    ok = set_start(sim, z10, z20) == SS_OK;
    if (!ok) diag_set(d, "%s: error: these parameters cannot be simulated", s->path);
  }
  dyn_orbits_clear(&list);
  return ok;
}

/* --- Output --- */

static bool print_csv_row(void *self, const struct coulomb_row *r) {
  struct text *line = self;
  text_reset(line);
  coulomb_csv_row(line, r);
  return fputs(text_str(line), stdout) >= 0;
}

static bool print_csv_event(void *self, const struct coulomb_event *e) {
  return print_csv_row(self, &e->at);
}

static int simulate_csv(const struct simulation *sim) {
  struct coulomb_result r;
  struct text line;
  text_init(&line);
  struct coulomb_sink sink = {&line, print_csv_event, print_csv_row};
  fputs(coulomb_csv_header, stdout);
  coulomb_simulate_ode(&r, sim->params, sim->start, &sim->plan, &sink);
  if (r.end != COULOMB_DONE && r.end != COULOMB_STOPPED)
    fprintf(stderr, "simulate: ended early (%s) at t = %.6g\n", coulomb_end_name[r.end], r.at.t);
  text_clear(&line);
  return EXIT_AS_RECORDED;
}

/* The word cut after each D, equal pieces in a row counted: (GHCD)^4 (GHCHGHCD)^2. */
static void fold_word(struct text *out, const char *word) {
  while (*word) {
    size_t len = strcspn(word, "D");
    if (word[len] == 'D') len++;
    long n = 0;
    const char *p = word;
    for (; strncmp(p, word, len) == 0 && strlen(p) >= len; p += len) n++;
    text_printf(out, "%s(%.*s)^%ld", out->len ? " " : "", (int)len, word, n);
    word = p;
  }
}

/* The largest difference of the times and states of the two logs' events, and how many they share. */
static double compare_logs(size_t *shared, const struct coulomb_log *a, const struct coulomb_log *b) {
  double worst = 0;
  for (*shared = 0; *shared < a->n && *shared < b->n; ++*shared) {
    const struct coulomb_event *e = &a->event[*shared], *f = &b->event[*shared];
    if (e->mass != f->mass || e->from != f->from || e->to != f->to) break;
    worst = fmax(worst, fabs(e->at.t - f->at.t));
    for (int i = 0; i < 2; i++) worst = fmax(worst, fmax(fabs(e->at.x[i] - f->at.x[i]), fabs(e->at.v[i] - f->at.v[i])));
  }
  return worst;
}

static int run_exact(struct coulomb_result *r, const struct simulation *sim, const struct coulomb_sink *sink) {
  struct num_vec p, x;
  num_vec_init(&p, N_COULOMB, num_ctx_double());
  num_vec_init(&x, N_STATE, num_ctx_double());
  for (int i = 0; i < N_COULOMB; i++) p.ctx.type->set_d(num_vec_at(&p, i), sim->params[i], 53);
  for (int i = 0; i < N_STATE; i++) x.ctx.type->set_d(num_vec_at(&x, i), sim->start[i], 53);
  int s = coulomb_simulate_exact(r, NULL, &p, &x, &sim->plan, sink);
  num_vec_clear(&x);
  num_vec_clear(&p);
  return s;
}

static int simulate_table(const struct simulation *sim, const struct scene *s) {
  struct coulomb_log ode, exact;
  struct coulomb_result r, r_exact;
  struct text word, folded;
  coulomb_log_init(&ode);
  coulomb_log_init(&exact);
  text_init(&word);
  text_init(&folded);
  struct coulomb_sink sink = coulomb_log_sink(&ode), sink_exact = coulomb_log_sink(&exact);
  coulomb_simulate_ode(&r, sim->params, sim->start, &sim->plan, &sink);
  run_exact(&r_exact, sim, &sink_exact);
  printf("%s: u_r1 = %.10g, u_r2 = %.10g%s\n", s->name, sim->params[COULOMB_UR1], sim->params[COULOMB_UR2],
         sim->own_friction ? " (5/4 of what the orbits need, where the scene gives none)" : "");
  printf("%14s  %-4s %-15s %14s %14s %12s %12s\n", "t", "mass", "change", "x1", "x2", "v1", "v2");
  for (size_t i = 0; i < ode.n; i++) {
    const struct coulomb_event *e = &ode.event[i];
    printf("%14.10f  m%-3d %-5s > %-7s %14.10f %14.10f %12.8f %12.8f%s\n", e->at.t, e->mass + 1,
           coulomb_mode_name[e->from], coulomb_mode_name[e->to], e->at.x[0], e->at.x[1], e->at.v[0], e->at.v[1],
           e->grazing ? "  grazing" : "");
  }
  coulomb_log_word(&word, &ode);
  fold_word(&folded, text_str(&word));
  printf("word %s\nended: %s at t = %.10f after %ld returns to the global stick phase\n", text_str(&folded),
         coulomb_end_name[r.end], r.at.t, r.returns);
  size_t shared;
  double worst = compare_logs(&shared, &ode, &exact);
  printf("closed forms: the first %zu of %zu events are the same, times and states within %.1e\n", shared, ode.n,
         worst);
  text_clear(&folded);
  text_clear(&word);
  coulomb_log_clear(&exact);
  coulomb_log_clear(&ode);
  return EXIT_AS_RECORDED;
}

int run_simulate(const struct options *o, const char *data) {
  enum { SLACK = 4 };
  long periods = 1, samples = DEFAULT_SAMPLES, orbit;
  bool printed;
  int status = parse_count(&periods, o->periods, MAX_PERIODS, "--periods");
  if (!status) status = parse_count(&samples, o->samples, MAX_SAMPLES, "--samples");
  if (!status) status = parse_start(&orbit, &printed, o->at);
  if (status) return status;
  if (o->n_operands != 1) return usage("simulate takes one %s", "SCENE");
  struct diag d;
  struct scene s;
  struct simulation sim = {.plan = coulomb_plan_default};
  diag_init(&d);
  if (scene_load(&s, o->operand[0], data, &d) && prepare(&sim, &s, orbit, printed, &d)) {
    double period = sim.period > 0 ? sim.period : 100;
    sim.plan.returns = periods;
    sim.plan.duration = SLACK * (double)periods * period; /* a motion that never sticks again ends all the same */
    if (o->csv) sim.plan.sample = period / (double)samples;
    status = o->csv ? simulate_csv(&sim) : simulate_table(&sim, &s);
  } else {
    status = bad_input(&d);
  }
  scene_clear(&s);
  return status;
}
