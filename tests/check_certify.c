/* Certified orbits, and the separate checker of their certificates.

   What is proved is held against tests/oracle (mpmath: matrix exponentials, 60 digits, violations in double
   precision).  The checker runs as a process; $STICKSLIP-checker is its path.  A certificate with anything false in it
   must be rejected: every number and every truth of a real one is changed in turn, and solutions of the six equations
   that start an event too early are forged into certificates. */
#include <sys/wait.h>

#include "base/random.h"
#include "effort.h"
#include "every.h"
#include "explore/family.h"
#include "known_orbits.h"
#include "mech/orbit.h"
#include "mech/two_masses.h"
#include "motion/certify.h"
#include "motion/complete.h"
#include "motion/given.h"
#include "motion/map_balls.h"
#include "motion/orbit_equations.h"
#include "motion/orbit_judge.h"
#include "motion/warm.h"
#include "params.h"
#include "rational.h"
#include "system.h"
#include "test.h"

/* --- A question and its answer --- */

struct study {
  fmpq *params, *u;
  const enum dyn_quantity *which;
  struct dyn_question q;
  struct dyn_orbits list;
  struct dyn_certificate *proof;
  struct text json;
};

static void certify_all(struct study *s) {
  s->proof = calloc((size_t)(s->list.n + 1), sizeof *s->proof);
  for (slong i = 0; i < s->list.n; i++) dyn_certify(&s->proof[i], &s->q, &s->list.orbit[i]);
  text_init(&s->json);
  two_masses_certificates_json(&s->json, "test", &s->q, &s->list, s->proof);
}

/* chi, eta, V and two quantities; u_r1, u_r2 or NULL. */
static struct study study_of(const char *const text[N_PARAMS], const enum dyn_quantity which[2], const char *const u[2],
                             slong prec) {
  struct study s = {.params = rationals(text, N_PARAMS), .u = _fmpq_vec_init(2), .which = which};
  s.q = (struct dyn_question){.model = s.params, .value = s.params + 3, .which = which};
  for (int i = 0; i < 2; i++) {
    if (!u || !u[i]) continue;
    rational_set(&s.u[i], u[i]);
    s.q.u_r[i] = &s.u[i];
  }
  dyn_orbits_given(&s.list, s.params, which, s.params + 3, prec, NULL);
  certify_all(&s);
  return s;
}

static const enum dyn_quantity by_forces[] = {QUANTITY_E1, QUANTITY_E2}, by_times[] = {QUANTITY_TB, QUANTITY_TC},
                               by_stick[] = {QUANTITY_E1, QUANTITY_TA};

static struct study study_forces(const char *chi, const char *eta, const char *V, const char *e1, const char *e2) {
  return study_of((const char *const[]){chi, eta, V, e1, e2}, by_forces, NULL, 128);
}

static struct study study_paper(void) {
  return study_of(example_text, by_forces, NULL, 128);
}

static void study_clear(struct study *s) {
  for (slong i = 0; i < s->list.n; i++) dyn_certificate_clear(&s->proof[i]);
  free(s->proof);
  dyn_orbits_clear(&s->list);
  text_clear(&s->json);
  _fmpq_vec_clear(s->params, N_PARAMS);
  _fmpq_vec_clear(s->u, 2);
}

static void all_certified(const struct study *s, slong n) {
  ck_assert_int_eq(s->list.n, n);
  for (slong i = 0; i < n; i++) {
    LOCAL(text, why);
    dyn_certificate_why(&why, &s->proof[i]);
    ck_assert_msg(s->proof[i].certified, "orbit %ld: %s", (long)i, text_str(&why));
  }
}

/* --- The checker --- */

static char said[2000];

/* Its exit status on the file; what it says goes to `said`. */
static int checker_on(const char *path) {
  const char *command = formatted("%s-checker '%s' 2>&1", program(), path);
  FILE *f = popen(command, "r");
  ck_assert(f != NULL);
  size_t n = fread(said, 1, sizeof said - 1, f);
  said[n] = '\0';
  int status = pclose(f);
  ck_assert_msg(WIFEXITED(status) && n > 0 && n < 1000, "%s: %d bytes, status %d", command, (int)n, status);
  return WEXITSTATUS(status);
}

static int checker(const char *text) {
  return checker_on(scratch_put("certificate.json", text));
}

enum { VERIFIED = 0, REJECTED = 1, BAD_FILE = 3 };

static void verified(const struct study *s) {
  ck_assert_msg(checker(text_str(&s->json)) == VERIFIED, "%s", said);
  const char *line = formatted("verified: %ld orbit%s; whether there are others is not checked\n", (long)s->list.n,
                               s->list.n == 1 ? "" : "s");
  ck_assert_str_eq(said, line);
}

/* How the checker ends on the list as it is now, and what it says. */
static void checked(struct study *s, int status, const char *says) {
  text_reset(&s->json);
  two_masses_certificates_json(&s->json, "changed", &s->q, &s->list, s->proof);
  ck_assert_msg(checker(text_str(&s->json)) == status && strstr(said, says), "%s", said);
}

/* --- Against independent data --- */

/* field: its row in orbits.tsv. */
static void check_orbit(const struct study *s, slong i, char *const *field) {
  const struct dyn_orbit *o = &s->list.orbit[i];
  const struct dyn_certificate *z = &s->proof[i];
  arb_srcptr x[] = {o->z10, o->z20, o->t[0], o->t[1], o->t[2], o->t[3], o->period, o->trace, o->u_r1_min, o->u_r2_min};
  for (int k = 0; k < 10; k++)
    ck_assert_msg(decimal_within(field[KNOWN_Z10 + k], x[k], 195), "%s %ld: number %d", field[1], (long)i, k);
  for (int k = 0; k < 4; k++) ck_assert(decimal_within(field[KNOWN_TA + k], z->box[QUANTITY_TA + k], 195));
  ck_assert(decimal_within(field[KNOWN_Z10], z->box_z10, 195) && decimal_within(field[KNOWN_Z20], z->box_z20, 195));
  double trace = strtod(field[KNOWN_TRACE], NULL);
  ck_assert_int_eq(z->stable, trace > -1 && trace < 1);
  ck_assert_int_eq(z->admissible, strcmp(field[KNOWN_ADMISSIBLE], "yes") == 0);
  const char *list = formatted(",%s,", field[KNOWN_VIOLATIONS]);
  for (int k = 0; k < N_CONDITIONS; k++) {
    const char *id = formatted(",%s,", dyn_condition_id[k]);
    ck_assert_msg((strstr(list, id) == NULL) == (z->holds[k] == TRUTH_TRUE), "%s %ld: %s", field[1], (long)i,
                  dyn_condition_id[k]);
  }
  for (int k = 0; k < N_PHASES; k++) ck_assert_int_eq(z->first[k], TRUTH_TRUE);
}

CASE("certify", .each = {scratch_open, scratch_close});

/* t_b > pi, t_a < 0, tr J beyond 1, coexisting orbits, t_c near 76, an orbit beside its fold, ...: see sets.tsv. */
TEST(every_set_is_certified_and_verified) {
  for (int set = 0; set < KNOWN_SETS; set++) {
    const struct known_set *known = known_set(set);
    OWNED(study) s = study_of(known->text, by_forces, NULL, 128);
    all_certified(&s, known->n);
    for (slong i = 0; i < known->n; i++) check_orbit(&s, i, known->orbit[i]);
    if (known->n > 0)
      verified(&s);
    else
      ck_assert_int_eq(checker(text_str(&s.json)), REJECTED); /* nothing is certified */
  }
}

/* |tr J| = 1 to 18 digits: the parameters of equality.tsv, and 1e-15 aside on either side. */
TEST(near_flip) {
  static const char *const chi[] = {"0.7832116263051993", "0.7832116263052", "0.783211626305199313"};
  for (int i = 0; i < 3; i++) {
    OWNED(study) s = study_forces(chi[i], "2", "1", "4", "1/4");
    all_certified(&s, 1);
    if (i < 2) ck_assert_msg(s.proof[0].stable == (i ? TRUTH_FALSE : TRUTH_TRUE), "%s: %d", chi[i], s.proof[0].stable);
    if (i == 2) ck_assert_int_ge(s.proof[0].bits, 128); /* 64 do not tell the side */
    ck_assert_double_lt(fabs(num_arb.get_d(s.list.orbit[0].margin)), 1e-11);
    verified(&s);
  }
}

TABLE(folds, "tests/cases/near_folds.tsv", N_PARAMS + 1);

/* Parameters between which an orbit appears or ends, found by halving to 1e-14 and better: two orbits at their fold, a
   touching of z_1' = V in phase H, t_b after a touching of chi r = e2, t_b near 0, z_2' = V just before t_c; and some
   at which Newton's iteration has left the phases, for t_b = -23.4 and t_c = -35.2, which are those of no orbit. */
TEST(near_folds_and_grazing_events) {
  int raised = 0;
  for (int i = 0; i < folds.n; i++) {
    OWNED(study) s = study_of((const char *const *)folds.row[i], by_forces, NULL, 128);
    all_certified(&s, atoi(folds.row[i][N_PARAMS]));
    for (slong k = 0; k < s.list.n; k++) {
      raised += s.proof[k].bits > 64;
      ck_assert(arb_is_positive(s.list.orbit[k].t[PHASE_GAMMA]) && arb_is_positive(s.list.orbit[k].t[PHASE_H]));
    }
    verified(&s);
  }
  ck_assert_int_ge(raised, 6);
}

/* t_c = 224.7; and given times, t_a = 1e-9 and two events at one time. */
TEST(long_slip_and_given_times) {
  OWNED(study) slip = study_forces("0.8", "1", "1", "0.05", "0.001");
  all_certified(&slip, 1);
  ck_assert_double_gt(slip.list.orbit[0].guess[PHASE_H], 200);
  verified(&slip);

  static const char *const times[N_PARAMS] = {"0.8", "1", "1", "2", "1.5"};
  OWNED(table) given = table_read("tests/oracle/times.tsv", 2);
  static const char *const u[2][2] = {{"100", "100"}, {"1", "100"}};
  for (int i = 0; i < 2; i++) { /* w < 0 where C starts: u_r1_min > e1/2 > 1 */
    OWNED(study) s = study_of(times, by_times, u[i], 128);
    all_certified(&s, 1);
    ck_assert(decimal_within(given.row[table_row(&given, "t_a", NULL)][1], s.list.orbit[0].t[0], 130));
    ck_assert_int_eq(s.proof[0].u_r[0], i == 0);
    ck_assert_int_eq(s.proof[0].admissible, i == 0);
    verified(&s);
  }

  static const char *const short_stick[N_PARAMS] = {"0.8", "1", "1", "2.7844", "1e-9"};
  OWNED(study) brief = study_of(short_stick, by_stick, NULL, 128);
  all_certified(&brief, 1);
  verified(&brief);

  static const char *const no_stick[N_PARAMS] = {"0.8", "1", "1", "2.7844", "0"};
  OWNED(study) s = study_of(no_stick, by_stick, NULL, 128);
  ck_assert_int_eq(s.list.n, 1);
  ck_assert(!s.proof[0].certified); /* w = e1 at the end of C: neither below nor above */
  ck_assert_uint_eq(s.proof[0].open, (unsigned)OPEN_HOLDS << COND_C_W);
  ck_assert_int_eq(s.proof[0].bits, DYN_CERTIFY_LAST);
}

/* Parameters at which a loop once had no bound: t_b of 1.7e9, behind some 270 million crests of the rise; phase H of
   seven million oscillations, of which only those that the slow mode brings near a limit are looked at; a search of
   passes that end before they take a step. */
TEST(extremes_end) {
  OWNED(study) late = study_forces("1e-9", "1", "1", "2.7844", "0.8587");
  ck_assert_int_eq(late.list.n, 0); /* beyond the fast search, not beyond the complete one */
  free(late.proof);
  text_clear(&late.json);
  dyn_orbits_complete(&late.list, late.params, 128, DYN_CELLS);
  certify_all(&late);
  all_certified(&late, 2);
  ck_assert(late.list.orbit[0].guess[PHASE_GAMMA] > 1e9 || late.list.orbit[1].guess[PHASE_GAMMA] > 1e9);

  OWNED(study) s = study_forces("0.8", "1e12", "1", "2.7844", "0.8587");
  ck_assert_int_eq(s.list.n, 1);
  ck_assert(s.proof[0].certified && !s.proof[0].spent);
  /* z_2 swings by e_2/chi in the fast mode, of frequency sqrt(chi eta) */
  double fastest = sqrt(0.8e12) * 0.8587 / 0.8;
  LOCAL(dyn_margins, margins);
  dyn_margins_find(&margins, s.params, &s.list.orbit[0], NULL, NULL, 128);
  ck_assert(fabs(num_arb.get_d(margins.at[COND_H_V2].margin) + fastest) < 1e-5 * fastest);
  struct dyn_certificate given_up = s.proof[0]; /* for its words alone */
  LOCAL(text, why);
  given_up.spent = true;
  dyn_certificate_why(&why, &given_up);
  ck_assert(strstr(text_str(&why), "too many oscillations") != NULL);

  static const char *const hard[N_PARAMS] = {"0.999999999", "1e300", "1", "1e-300", "1e-300"};
  OWNED(dyn_orbits) list;
  FREED_PARAMS fmpq *p = rationals(hard, N_PARAMS);
  ck_assert_int_eq(dyn_orbits_find(&list, p, 64, NULL), SS_UNABLE);
  ck_assert_int_lt(list.evaluations, 2000000);
}

/* --- Certificates with something false in them --- */

/* The certificate with len bytes at `at` replaced. */
static int checker_with(const struct text *json, size_t at, size_t len, const char *by) {
  LOCAL(text, t);
  text_add_n(&t, json->data, at);
  text_add(&t, by);
  text_add(&t, json->data + at + len);
  return checker(text_str(&t));
}

/* The certificate with the first string behind that name replaced. */
static int checker_with_string(const struct text *json, const char *name, const char *by) {
  const char *value = strchr(strstr(json->data, formatted("\"%s\":", name)), ':');
  value += strcspn(value, "\"") + 1;
  return checker_with(json, (size_t)(value - json->data), strcspn(value, "\""), by);
}

/* The certificate with the first occurrence of a text behind another one replaced; what the checker says is wrong. */
static void refused_with(const struct text *json, const char *behind, const char *from, const char *to, int status,
                         const char *why) {
  const char *p = strstr(json->data, behind);
  if (p) p = strstr(p, from);
  ck_assert_msg(p != NULL, "%s %s", behind, from);
  int got = checker_with(json, (size_t)(p - json->data), strlen(from), to);
  ck_assert_msg(got == status && strstr(said, why), "%s for %s: %d %s", to, from, got, said);
}

/* tests/forge.py makes forgeries of every value of these certificates and proves of each that is verified that it is
   true: here every other truth and letter, and some of the rest; make long makes all of them. */
TEST(some_of_all_forgeries) {
  shell_well(
      "$Y tests/forge.py --every 101 \"$P\" paper above-one other-word chain3 driven two-loads beside-wall den-hartog");
}

/* A number that is claimed to be exactly zero, as it is, is soon not confirmed. */
TEST(an_exact_claim_costs_little) {
  OWNED(study) s = study_paper();
  ck_assert_int_eq(checker_with_string(&s.json, "re", "0 0 0 0"), REJECTED);
  ck_assert_msg(strstr(said, "cannot be confirmed"), "%s", said);
}

/* tr J is near -3.4e-31: the multipliers, it and 0, are told apart. */
TEST(multipliers_that_nearly_meet) {
  static const char *const text[N_PARAMS] = {"47/125", "47/125", "1", "5/4",
                                             ("61181618554749724207734213342667609152351510878569650320353507/"
                                              "100000000000000000000000000000000000000000000000000000000000000")};
  OWNED(study) s = study_of(text, by_forces, NULL, 256);
  all_certified(&s, 3);
  verified(&s);
  slong i = 0;
  while (i < 3 && fabs(num_arb.get_d(s.list.orbit[i].trace)) > 1e-20) i++;
  ck_assert_int_lt(i, 3);
  ck_assert_double_eq_tol(num_arb.get_d(s.list.orbit[i].trace), -3.4e-31, 1e-32);
  arb_neg(s.list.orbit[i].trace, s.list.orbit[i].trace);
  checked(&s, REJECTED, "a multiplier is not as claimed");
}

/* A solution of the six equations in place of the first orbit, with every claim that the prover would make. */
static void forge(struct study *s, const struct word_root *root, slong prec) {
  struct ball_params m;
  struct ball_pass pass;
  struct dyn_orbit *o = &s->list.orbit[0];
  OWNED(calc) c = calc_begin(num_ctx_arb(prec));
  ball_params_init(&m, &c, s->params);
  val x[N_QUANTITIES];
  struct word w;
  for (int i = 0; i < N_QUANTITIES; i++) x[i] = root->x[i];
  word_make(&w, &c, &m, x);
  ball_pass_make(&pass, &c, &m, x[QUANTITY_TB], x[QUANTITY_TC], num_arb.get_d(w.end) > 0);
  dyn_orbit_describe(o, &c, &m, &pass);
  for (int i = 0; i < N_PHASES; i++) arb_set(o->t[i], root->x[QUANTITY_TA + i]);
  dyn_certify(&s->proof[0], &s->q, o);
}

/* Newton's iteration on the six equations from a grid of times also ends where t_b or t_c is a later root: never
   certified, and rejected when certified by force. */
TEST(later_events_are_no_orbits) {
  int later = 0, by_event = 0;
  OWNED(study) s = study_paper();
  struct word_data d = {s.params, s.params + 3, s.which, {QUANTITY_TA, QUANTITY_TB, QUANTITY_TC, QUANTITY_TD}};
  for (int i = 0; i < 400 && later < 40 / every(4); i++) {
    OWNED(word_root) root = {0};
    const double start[N_QUANTITIES] = {2.7844, 0.8587, 1, 0.5 + 0.6 * (i % 20), 0.7 + 0.9 * (i / 20), 2};
    for (int k = 0; k < N_QUANTITIES; k++) arb_set_d(root.x[k], start[k]);
    bool solved = word_solve(&root, &d, 192) == SS_OK;
    for (int k = QUANTITY_TB; k <= QUANTITY_TD; k++) solved = solved && arb_is_positive(root.x[k]);
    if (solved && num_arb.get_d(root.x[QUANTITY_TD]) < 3.51) { /* pi/sqrt(0.8) */
      forge(&s, &root, 192);
      bool known = s.proof[0].certified;
      if (!known) {
        struct dyn_certificate *z = &s.proof[0];
        unsigned firsts = (unsigned)OPEN_FIRST << PHASE_GAMMA | (unsigned)OPEN_FIRST << PHASE_H;
        ck_assert_msg(z->open & firsts, "open %u", z->open);
        z->certified = true;
        z->admissible = TRUTH_TRUE;
        for (int k = 0; k < N_PHASES; k++) z->first[k] = TRUTH_TRUE;
        for (int k = 0; k < N_CONDITIONS; k++) {
          if (k == COND_GAMMA_R || k == COND_H_V1 || z->holds[k] == TRUTH_UNKNOWN) z->holds[k] = TRUTH_TRUE;
          z->admissible = truth_and(z->admissible, z->holds[k]);
        }
        checked(&s, REJECTED, "");
        by_event += strstr(said, "the first ones") != NULL;
        later++;
      }
    }
  }
  ck_assert_int_ge(later, 5);
  ck_assert_msg(by_event == later, "%d of %d", by_event, later); /* nothing else is false */
}

/* An orbit with enclosures beside it, or too narrow to hold it. */
TEST(wrong_enclosures_are_not_certified) {
  OWNED(study) s = study_paper();
  struct dyn_orbit *o = &s.list.orbit[1];
  arb_add_ui(o->t[PHASE_D], o->t[PHASE_D], 1, 200);
  dyn_certify(&s.proof[1], &s.q, o);
  ck_assert(!s.proof[1].certified);
  ck_assert_uint_eq(s.proof[1].open, OPEN_SAME);
  OWNED(study) far = study_paper();
  o = &far.list.orbit[1];
  for (int i = 0; i < N_PHASES; i++) arb_set_d(o->t[i], 1e5 + i);
  dyn_certify(&far.proof[1], &far.q, o);
  ck_assert(!far.proof[1].certified);
}

/* A box beside the orbit, where all else is true of the orbit and of every point of the box. */
TEST(a_box_without_its_orbit_is_rejected) {
  OWNED(study) s = study_paper();
  struct dyn_orbit *o = &s.list.orbit[0];
  arb_ptr wide[] = {o->z10, o->z20, o->t[0], o->t[1], o->t[2], o->t[3], o->period, o->trace, o->u_r1_min, o->u_r2_min};
  for (size_t i = 0; i < COUNT(wide); i++) arb_add_error_2exp_si(wide[i], -6);
  checked(&s, VERIFIED, ""); /* it says less, but nothing false */
  arb_ptr box = s.proof[0].box[QUANTITY_TB];
  NUMBERS(arf, shift);
  arf_set_mag(shift, arb_radref(box));
  arf_mul_2exp_si(shift, shift, 2);
  arf_add(arb_midref(box), arb_midref(box), shift, ARF_PREC_EXACT, ARF_RND_DOWN);
  checked(&s, REJECTED, "its box");
}

/* One orbit twice, no orbit, and more than the file says. */
TEST(entries_are_different_orbits) {
  OWNED(study) s = study_paper();
  dyn_orbit_clear(&s.list.orbit[0]);
  memcpy(&s.list.orbit[0], &s.list.orbit[1], sizeof *s.list.orbit);
  s.list.n = 2;
  struct dyn_certificate kept = s.proof[0];
  s.proof[0] = s.proof[1];
  checked(&s, REJECTED, "may be one");
  s.proof[0] = kept;
  s.list.orbit[0] = (struct dyn_orbit){.grazing = false};
}

/* Sliding friction is positive: u_ri is, and above e_i; else nothing in the certificate is about the system. */
TEST(static_friction_has_a_range) {
  static const struct {
    const char *u[2], *says;
    int status;
  } rows[] = {{{"3", "3"}, "verified: 2 orbits", VERIFIED},
              {{"11/4", "3"}, "mass 1: its static limit is out of its range", REJECTED},
              {{"6961/2500", "3"}, "nothing is certified", REJECTED}, /* whether e_1 is below u_r1 stays open */
              {{"-1", "3"}, "masses.0.static is out of its range", REJECTED},
              {{"3", "8587/10000"}, "mass 2: its static limit is out of its range", REJECTED},
              {{"3", "0"}, "masses.1.static is out of its range", REJECTED}};
  for (size_t i = 0; i < COUNT(rows); i++) {
    OWNED(study) s = study_of(example_text, by_forces, rows[i].u, 128);
    int status = checker(text_str(&s.json));
    ck_assert_msg(status == rows[i].status && strstr(said, rows[i].says), "%s, %s: %s", rows[i].u[0], rows[i].u[1],
                  said);
  }
  static const char *const times[N_PARAMS] = {"0.8", "1", "1", "2", "1.5"}, *const u[2] = {"-1", "100"};
  OWNED(study) s = study_of(times, by_times, u, 128);
  ck_assert_msg(checker(text_str(&s.json)) == REJECTED && strstr(said, "out of its range"), "%s", said);
  static const char *const below_e1[2] = {"5/2", "3"}; /* and above what holds the mass */
  OWNED(study) t = study_of(times, by_times, below_e1, 128);
  ck_assert_int_eq(t.proof[0].admissible, TRUTH_FALSE);
  t.proof[0].admissible = TRUTH_TRUE;
  checked(&t, REJECTED, "admissible is not as claimed");
}

/* Nobody takes the answer, or the memory ends: no verdict, and a status of its own. */
TEST(no_answer) {
  OWNED(study) s = study_paper();
  const char *path = scratch_put("certificate.json", text_str(&s.json));
  static const char *const out[] = {"> /dev/full", ">&-"};
  for (int i = 0; i < 2; i++) shell_ends(4, "standard output cannot be written", "$P-checker '%s' %s", path, out[i]);
#ifndef __SANITIZE_ADDRESS__ /* has memory of its own */
  FREED char *text = shell_said(
      "for v in $(seq 15000 50 60000); do (ulimit -c 0; ulimit -v $v; exec $P-checker '%s' > /dev/null 2>&1);"
      "s=$?; [ $s = 127 ] || echo $s; [ $s != 0 ] || break; done | uniq | tr '\\n' ' '",
      path);
  ck_assert_str_eq(text, "4 0 ");
#endif
}

/* --- Systems --- */

struct system_study {
  struct mech m;
  struct mech_orbits list;
  struct text json;
};

/* An orbit of that word; of any where word is NULL. */
static struct system_study system_study_of(const char *path, const char *word) {
  struct system_study s;
  struct mech_word w;
  goes_well(mech_load(&s.m, path, &d));
  if (word) w = word_in(&s.m, word);
  mech_orbits_find(&s.list, &s.m, word ? &w : NULL, true, 128, NULL);
  ck_assert_int_ge(s.list.n, 1);
  text_init(&s.json);
  mech_certificates_json(&s.json, "test", &s.m, &s.list);
  return s;
}

static void system_study_clear(struct system_study *s) {
  mech_orbits_clear(&s->list);
  mech_clear(&s->m);
  text_clear(&s->json);
}

/* How the checker ends on these orbits of the system, and what it says. */
static void checked_orbits(struct system_study *s, const struct mech_orbits *list, int status, const char *says) {
  text_reset(&s->json);
  mech_certificates_json(&s->json, "changed", &s->m, list);
  ck_assert_msg(checker(text_str(&s->json)) == status && strstr(said, says), "%s", said);
}

static void verified_one(const char *what) {
  ck_assert_msg(strcmp(said, "verified: 1 orbit; whether there are others is not checked\n") == 0, "%s: %s", what,
                said);
}

/* Between two phases one number tells the whole state. */
TEST(nothing_is_free_of_one_mass) {
  OWNED(system_study) s =
      system_study_of(scratch_put("one.system", "title: a mass on a belt\n" MASS("m", "1", "1", "2", "1")
                                                    SPRING("k", "ground, m", "1")),
                      NULL);
  ck_assert_int_eq(s.list.orbit[0].n_free, 0);
  ck_assert_int_eq(checker(text_str(&s.json)), VERIFIED);
  verified_one("one mass");
}

/* Where a mass meets an obstacle that takes all its velocity and leaves it at once, that velocity is not free.  Period
   and multipliers: Newton's iteration on (x_b, x_b') over motions by Taylor series in double. */
TEST(no_velocity_is_free_after_a_dead_rebound) {
  const char *path = scratch_put(
      "dead.system", "title: a soft stop below and a hard one above\n" MASS("a", "1", "1/2", "3/2", "1")
                         MASS("b", "2", "1/2", "2", "1") SPRING("k1", "ground, a", "1") SPRING("k2", "a, b", "1/2")
                             STOP("low", "a", "below: -1/4", "0") STOP("high", "b", "above: 5", "9/10"));
  OWNED(system_study) s = system_study_of(path, "--<1 --<1 -s -->2");
  const struct mech_orbit *o = &s.list.orbit[0];
  ck_assert_str_eq(o->word.phase[0], "--<1");
  ck_assert_int_eq(o->n_free, 2);
  ck_assert_double_eq_tol(num_arb.get_d(o->period), 13.3549557697702, 1e-10);
  ck_assert_double_eq_tol(num_arb.get_d(acb_realref(o->multiplier)), 0.384506883, 1e-7);
  ck_assert_double_eq_tol(num_arb.get_d(acb_realref(o->multiplier + 1)), 0.036894617, 1e-7);
  ck_assert_msg(checker(text_str(&s.json)) == VERIFIED, "%s", said);
}

/* One orbit twice, also when its word and its numbers begin with another phase. */
TEST(an_orbit_of_a_system_counts_once) {
  OWNED(system_study) s = system_study_of("verify/systems/den-hartog.system", NULL);
  struct mech_orbit pair[2] = {s.list.orbit[0], s.list.orbit[0]};
  struct mech_orbits twice = {.orbit = pair, .n = 2};
  checked_orbits(&s, &twice, REJECTED, "orbits 1 and 2 may be one");
  struct mech_word w;
  double t[2], z[MECH_STATES];
  mech_word_turn(&w, &pair[0].word, 1);
  for (int k = 0; k < 2; k++) t[k] = num_arb.get_d(pair[0].t + 1 - k);
  for (int i = 0; i < s.m.states; i++) z[i] = num_arb.get_d(pair[0].state + s.m.states + i);
  ck_assert_int_eq(mech_orbit_near(&pair[1], &s.m, &w, t, z, 128), SS_OK);
  mech_orbit_judge(&pair[1], &s.m, 128);
  checked_orbits(&s, &twice, REJECTED, "orbits 1 and 2 may be one");
  mech_orbit_clear(&pair[1]);
}

/* Solutions of a word's equations that pass through a wall, slip past their surface's velocity or return too late: each
   is rejected when it is certified by force; and one that only breaks the law is verified when it says so. */
TEST(solutions_that_are_no_motions_are_rejected) {
  static const struct {
    const char *system, *word;
    double t[4], z[4]; /* a start */
  } row[] = {{"beside-wall", "-- -->2 s-", {0}, {0}},
             {"soft-wall", "-- s- -- -a", {0}, {0}},
             {"driven", "-- +- -- -s", {0}, {0}},
             {"den-hartog", "+ -", {0}, {0}},
             /* the paper's orbit that breaks h_v2; z = x - (10, 45/4) */
             {"two-masses", "ss -s -- s-", {14.318937, 1.3814616, 10.909628, 3.2581067}, {4.5356558, 4.5188039, 1, 1}}};
  int later = 0, broken = 0;
  for (size_t i = 0; i < COUNT(row); i++) {
    OWNED(system_study) s = system_study_of(formatted("verify/systems/%s.system", row[i].system), NULL);
    struct mech_word w = word_in(&s.m, row[i].word);
    uint64_t stream = random_seed("forged orbits");
    for (int k = 0; k < 60; k++) {
      struct mech_orbit o; /* needs no clearing where there is none */
      double t[4], z[MECH_STATES];
      bool given = k == 0 && row[i].t[0] > 0;
      for (int l = 0; l < w.n; l++) t[l] = given ? row[i].t[l] : 8 * random_unit(&stream);
      for (int l = 0; l < s.m.states; l++) z[l] = given ? row[i].z[l] : 8 * random_unit(&stream) - 4;
      if (mech_orbit_near(&o, &s.m, &w, t, z, 128) != SS_OK) continue;
      mech_orbit_judge(&o, &s.m, 128);
      bool positive = o.multipliers;
      for (int l = 0; l < w.n; l++) positive = positive && arb_is_positive(o.t + l);
      if (positive && o.admissible == TRUTH_FALSE) {
        struct mech_orbits one = {.orbit = &o, .n = 1};
        bool own = o.own == TRUTH_TRUE;
        if (own) checked_orbits(&s, &one, VERIFIED, ""); /* it is certified as it is */
        o.certified = true;
        o.admissible = TRUTH_TRUE;
        checked_orbits(&s, &one, REJECTED, "");
        broken += own;
        later += !own && strstr(said, "the first ones");
      }
      mech_orbit_clear(&o);
    }
  }
  ck_assert_msg(later >= 3 && broken == 1, "%d, %d", later, broken);
}

/* An orbit that breaks the law, in a box that the checker's first precision proves, with numbers to so many digits that
   it leaves them undecided: the verdict is held against the conditions only when all of them have been looked at. */
TEST(a_verdict_waits_for_the_conditions) {
  /* the paper's orbit that breaks h_v2; z = x - (10, 45/4) */
  const double t[] = {14.318937, 1.3814616, 10.909628, 3.2581067}, z[MECH_STATES] = {4.5356558, 4.5188039, 1, 1};
  OWNED(mech_orbit) coarse, fine;
  OWNED(system_study) s = system_study_of("verify/systems/two-masses.system", NULL);
  struct mech_word w = word_in(&s.m, "ss -s -- s-");
  ck_assert_int_eq(mech_orbit_near(&coarse, &s.m, &w, t, z, 128), SS_OK);
  ck_assert_int_eq(mech_orbit_near(&fine, &s.m, &w, t, z, 512), SS_OK);
  mech_orbit_judge(&fine, &s.m, 512);
  ck_assert(fine.certified && fine.admissible == TRUTH_FALSE);
  ck_assert_int_lt(mag_cmp_2exp_si(arb_radref(fine.period), -300), 0);
  for (int l = 0; l < w.n + fine.n_free; l++) arb_set(fine.box + l, coarse.box + l);
  struct mech_orbits one = {.orbit = &fine, .n = 1};
  checked_orbits(&s, &one, VERIFIED, "");
  refused_with(&s.json, "verdicts", "\"admissible\": false", "\"admissible\": true", REJECTED,
               "admissible is not as claimed");
}

/* A mass that leaves an obstacle is on the slower side of its surface only where that moves up: on the other side its
   friction would jump, and with it the force that was zero. */
TEST(a_mass_leaves_rest_with_its_friction) {
  struct mech_word w;
  size_t at;
  const char *why;
  OWNED(system_study) s = system_study_of(
      scratch_put("soft.system", "title: a driven mass at a soft wall\n" MASS("m", "1", "1e-6", "1e-3", "-3")
                                     SPRING("k", "ground, m", "1") DAMPER("d", "ground, m", "1/10")
                                         LOAD("p", "m", "3/5", "1") STOP("o", "m", "above: 1/4", "0")),
      NULL);
  word_in(&s.m, "a +");
  ck_assert(!mech_word_parse(&w, &at, &why, "a -", &s.m) && strstr(why, "slips as at rest"));
  ck_assert_int_eq(checker(text_str(&s.json)), VERIFIED);
  refused_with(&s.json, "\"word\"", "\"+\"", "\"-\"", REJECTED, "differ by more or less than one event");
}

/* A text with what a field of a table abbreviates. */
static const char *written(struct text *t, const char *field) {
  text_reset(t);
  field_expand(t, field, NULL);
  return text_str(t);
}

TABLE(false_parts, "tests/cases/certificates_false.tsv", 6);
enum { OF, BEHIND, FROM, TO, ENDS, SAYS }; /* its columns */

/* Truths, phases, what is no system, and what is out of all proportion, which is refused at once.  In the file of the
   paper's orbits sliding friction is left open, so that every mass rubs and none meets an obstacle or is faster. */
TEST_EACH(a_changed_certificate_is_rejected, 5) {
  static const char *const of[] = {"chain3", "driven", "beside-wall", "two-loads", "the paper"};
  LOCAL(text, json);
  int rows = 0;
  if (_i < 4) {
    OWNED(system_study) s = system_study_of(formatted("verify/systems/%s.system", of[_i]), NULL);
    text_add(&json, text_str(&s.json));
  } else {
    OWNED(study) s = study_paper();
    text_add(&json, text_str(&s.json));
  }
  for (int i = 0; i < false_parts.n; i++) {
    char *const *row = false_parts.row[i];
    LOCAL(text, to);
    if (strcmp(row[OF], of[_i]) != 0) continue;
    field_expand(&to, row[TO], NULL);
    refused_with(&json, row[BEHIND], row[FROM], text_str(&to), strcmp(row[ENDS], "rejected") ? BAD_FILE : REJECTED,
                 row[SAYS]);
    rows++;
  }
  ck_assert_int_ge(rows, 3);
}

/* --- Files that are no certificates --- */

TEST(bad_files) {
  OWNED(study) s = study_paper();
  for (size_t len = 0; len + 3 < s.json.len; len += 97 * (size_t)every(3)) { /* cut off */
    ck_assert_int_eq(checker_on(scratch_put_n("cut.json", s.json.data, len)), BAD_FILE);
  }
  static const char *const bad[] = {"", "{", "[]", "null", "{\"format\": 1}", "\"\\", "{\"a\": {\"a\": tru", "{} {}"};
  for (size_t i = 0; i < COUNT(bad); i++) ck_assert_msg(checker(bad[i]) == BAD_FILE, "%s: %s", bad[i], said);
  LOCAL(text, t);
  ck_assert_int_eq(checker(written(&t, "@500000{[{\"\":}")), BAD_FILE);
  ck_assert_int_eq(checker(written(&t, "@300000{[true,}")), BAD_FILE);
  ck_assert_int_eq(checker(written(&t, "@3000000{9}")), BAD_FILE); /* a long number, not even a string */
  ck_assert_int_eq(checker_on(scratch_put_n("binary.json",
                                            "\x7f"
                                            "ELF\0\1\2\xff\xfe",
                                            9)),
                   BAD_FILE);
  ck_assert_int_eq(checker_on(scratch_path("")), BAD_FILE);
  ck_assert_int_eq(checker_on("/dev/zero"), BAD_FILE);
  ck_assert_int_eq(checker_on(scratch_path("none.json")), BAD_FILE);

  OWNED(table) number = table_read("tests/cases/numbers_false.tsv", 1);
  static const char *const replaced[] = {"stiffness", "times", "excess", "period", "re"};
  for (size_t i = 0; i < COUNT(replaced); i++)
    for (int k = 0; k < number.n; k++) {
      int status = checker_with_string(&s.json, replaced[i], *number.row[k]);
      ck_assert_msg(status == REJECTED || status == BAD_FILE, "%s, %s: %s", replaced[i], *number.row[k], said);
    }
  written(&t, "1@150000{0}");
  static const char *const huge[] = {"inertia", "surface", "stiffness", "excess"};
  for (size_t i = 0; i < COUNT(huge); i++)
    ck_assert_int_eq(checker_with_string(&s.json, huge[i], text_str(&t)), REJECTED);
}

/* --- Digits, and what they cost --- */

TEST(thousand_digits) {
  OWNED(study) s = study_of(example_text, by_forces, NULL, 3394);
  all_certified(&s, 2);
  NUMBERS(mag, radius);
  dyn_orbit_radius(radius, &s.list.orbit[1]);
  ck_assert_int_lt(mag_cmp_2exp_si(radius, -3380), 0);
  OWNED(table) digits = table_read("tests/oracle/paper_1000.tsv", 2);
  ck_assert(decimal_within(digits.row[table_row(&digits, "z10", NULL)][1], s.list.orbit[1].z10, 3350));
  verified(&s);
}

static void find_and_certify(void *prec) {
  OWNED(study) s = study_of(example_text, by_forces, NULL, *(slong *)prec);
}

/* In proportion to their number at most: what is certified at 128 bits is refined by steps that double them. */
TEST(digits_are_cheap) {
  slong few = 128, many = 3394;
  ck_assert(costs_less(&(struct effort){find_and_certify, &many}, (double)many / (double)few,
                       &(struct effort){find_and_certify, &few}));
}

static void find(void *arg) {
  struct study *s = arg;
  OWNED(dyn_orbits) list;
  dyn_orbits_given(&list, s->params, s->which, s->params + 3, 128, NULL);
}

static void certify_one(void *arg) {
  struct study *s = arg;
  OWNED(dyn_certificate) z = {.certified = false};
  dyn_certify(&z, &s->q, &s->list.orbit[1]);
}

/* A certificate comes from the enclosure that the search has left, without a search of its own. */
TEST(an_orbit_costs_no_second_search) {
  OWNED(study) s = study_paper();
  ck_assert(costs_less(&(struct effort){certify_one, &s}, 2, &(struct effort){find, &s}));
}
