/* Damages to what the audit itself is made of, each to a copy of the data folder: a rule of the claims names it, or a
   correction and a control are judged again.  What must be said is written by hand beside what is done. */
#include <check.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scratch.h"
#include "suites.h"

/* The output of a command, and its exit status. */
static char *said(int *status, const char *command) {
  static char out[1 << 16];
  char *all = shell_output(status, "%s", command);
  snprintf(out, sizeof out, "%s", all);
  free(all);
  return out;
}

/* What is done to which file (a script of sed), what the program is asked, how it ends and what it says. */
struct damage {
  const char *file, *script, *ask;
  int status;
  const char *says;
};

static const char planned[] = "verify paper --plan";

static const struct damage rules[] = {
    /* points and routes */
    {"claims/4-stability.claim", "/^claim eq-27$/,/^$/{s/points: .*/points: arcs 1/}", planned, 3,
     "eq-27: points for a claim of kind matrix are at least 6 in all and 3 of each sort"},
    {"claims/4-stability.claim", "/^claim eq-27$/,/^$/{s/orbits 8/orbits 2/}", planned, 3,
     "eq-27: points for a claim of kind matrix"},
    {"claims/4-stability.claim", "/^claim eq-27$/,/^$/{s/routes: .*/routes: balls/}", planned, 3,
     "eq-27: a claim of kind matrix is tried by at least 2 independent routes"},
    {"claims/1-model.claim", "/^claim eq-3$/,/^$/{s/routes: newton/routes: balls/}", planned, 3,
     "eq-3: a claim of kind matrix is tried by at least 2 independent routes"},
    {"claims/3-periodic.claim", "/^claim eq-18$/,/^$/{s/points: .*/points: orbits 1/}", planned, 3, "eq-18: points"},
    /* arguments */
    {"claims/8-text.claim", "/^claim text-54-fulfilled$/,/^$/{s/eq-56 D/eq-56 D, eq-54/}", planned, 3,
     "text-54-fulfilled: the conclusion eq-54 is among its own premises"},
    {"claims/8-text.claim", "/^claim text-54-fulfilled$/,/^$/{s/eq-56 D/eq-56 D, eq-54#2.1/}", planned, 3,
     "text-54-fulfilled: the conclusion eq-54 is among its own premises"},
    {"claims/8-text.claim", "/^claim text-59-concluded$/,/^$/{s/repair: .*/repair: eq-59#1.1/}", planned, 3,
     "text-59-concluded: the conclusion eq-59 is among its own premises"},
    {"claims/8-text.claim", "/^claim text-53-suffices$/,/^$/{s/text-start-w/text-start-w, eq-9#3/}", planned, 3,
     "text-53-suffices: the conclusion eq-52 is among its own premises, as eq-9"},
    {"claims/8-text.claim", "/^claim text-56-deduced$/,/^$/{s/eq-51#1/eq-51#1, eq-54/}", planned, 3,
     "a claim rests on itself: "},
    {"claims/4-stability.claim", "/^claim eq-27$/,/^$/{s/record:/depends-on: text-criterion\\n  record:/}", planned, 3,
     "a claim rests on itself: "},
    {"claims/8-text.claim", "/^claim text-stick-1-only$/,/^$/{s/converse-of: .*/converse-of: text-stick-2/}", planned,
     3, "text-stick-1-only: no argument of that name goes the other way round"},
    /* faults */
    {"claims/4-stability.claim", "/^claim eq-29$/,/^$/{s/fault: notation/fault: formula/}", planned, 3,
     "eq-29: the fault is \"notation\""},
    {"claims/4-stability.claim", "/^claim eq-40$/,/^$/{s/fault: formula/fault: notation/}", planned, 3,
     "eq-40: the fault is \"formula\""},
    {"claims/5-validation.claim", "/^claim num-t_a$/,/^$/{s/fault: number/fault: argument/}", planned, 3,
     "num-t_a: the fault is \"number\""},
    {"claims/5-validation.claim", "/^claim num-t_b$/,/^$/{s/fault: number/fault: nobody/}", planned, 3,
     "num-t_b: the fault is \"number\""},
    /* the paper's statements */
    {"paper/paper.statements", "/^statement abstract-1$/,/^$/d", planned, 3, "there are 171 records in this file"},
    {"paper/paper.statements", "/^statement stability-otherwise$/,/^$/{s/claims: .*/reason: obvious/}", planned, 3,
     "text-otherwise-unstable: no statement of the paper names this claim"},
    {"paper/paper.statements", "/^statement stability-chain$/,/^$/{/equation:/d}", planned, 3,
     "no statement has the equation number 41"},
    {"paper/paper.statements", "s/claims: eq-41$/claims: eq-14, eq-4l/", planned, 3, "there is no claim eq-4l"},
    {"paper/paper.statements", "/^statement stability-3$/,/^$/{/reason:/d}", planned, 3,
     "stability-3: a statement has claims that answer it, or a reason"},
    {"paper/paper.statements", "/^statement stability-3$/,/^$/{/quote:/d}", planned, 3,
     "stability-3: a statement has a quote"},
    {"paper/paper.statements", "/^statement stability-3$/,/^$/{s/reason:/why:/}", planned, 3,
     "stability-3: a statement has quote, place, equation, claims, checks and reason"},
    {"paper/paper.statements", "s/checks: eq-12c, text-states$/checks: eq-12c, text-states, eq-4l/", planned, 3,
     "there is no claim eq-4l"},
    {"paper/paper.statements", "s/checks: eq-12c, text-states$/checks: eq-12c, text-states, eq-13/", planned, 3,
     "periodic-stick-state: eq-13 answers a statement, and is no check"},
    /* the roots of discrepancies */
    {"claims/paper.roots", "/^root otherwise$/,/^$/d", planned, 3,
     "text-otherwise-unstable: no root of the file of roots names this claim"},
    {"claims/paper.roots", "/^root otherwise$/,/^$/{/claims:/d}", planned, 3,
     "otherwise: a root has the attribute claims"},
    {"claims/paper.roots", "/^root otherwise$/,/^$/{s/claims:.*/&, eq-40/}", planned, 3,
     "otherwise: eq-40 stands at the root slip-factor already"},
    {"claims/paper.roots", "/^root otherwise$/,/^$/{s/claims:.*/&, eq-4l/}", planned, 3,
     "otherwise: there is no claim eq-4l"},
    {"claims/paper.roots", "/^root configurations$/,/^$/{s/remark/grave/}", planned, 3,
     "configurations: a severity is substance, remark or notation"},
    {"claims/paper.roots", "/^root slip-factor$/,/^$/{s/substance/notation/}", planned, 3,
     "configurations: those of more consequence stand before it"},
    {"claims/paper.roots", "/^root otherwise$/,/^$/{s/by-hand:/shown:/}", planned, 3,
     "otherwise: a root has title, severity"},
    {"claims/8-text.claim", "/^claim text-56-deduced$/,/^$/d", planned, 3, "there is no claim text-56-deduced"},
    /* controls and corrections on file */
    {"controls/controls.claim", "/^control ctl-chain$/,/^$/d", planned, 3, "records in this file, not"},
    {"controls/controls.claim", "/^count:/d", planned, 3, "the file begins with \"count: N\""},
    {"controls/controls.claim", "s/claim: fig-3/claim: fig-4/", planned, 3,
     "claims of kind sequence, such as this, have 0 controls, and must have 1"},
    {"controls/controls.claim", "/^control ctl-correction-heading$/,/^$/{s/of: correction/near: 1/}", planned, 3,
     "text-free-index: no control makes a correction of this sort wrong"},
    {"errata.eq", "\\$a equation eq-54\\n  section: appendix_b\\n  e_1 = e_2", planned, 3,
     "eq-54: no claim is corrected by this"},
    {"controls/controls.eq", "/^define ctl-phases$/,/^$/d", planned, 3, "eq-19: no control damages this formula"},
    /* a control that is not near */
    {"controls/controls.eq", "/^define ctl-exact-matrix$/,/^$/{s/1e-90/1e9/}", "verify paper --only eq-3 --quiet", 3,
     "ctl-exact-matrix: its formula is wrong by 1e+09, and it says near: 1e-90\n"},
    {"controls/controls.eq", "/^define ctl-exact-propagator$/,/^$/{s/+ 1e-90/+ 1e9 + 1e-90/}",
     "verify paper --only eq-49 --quiet", 1, "control ctl-exact-propagator: it changes what it damages by 1e1"},
};

static const struct damage corrections[] = {
    {"claims/4-stability.claim", "s/repaired-range: 1 4/repaired-range: 1 7/", "verify paper --only eq-36b --quiet", 1,
     "eq-36b: the correction is refuted: indices 1..7\n"},
    {"claims/4-stability.claim", "s/repaired-range: 1 4/repaired-range: 1 5/", "verify paper --only eq-36b --quiet", 1,
     "eq-36b: the correction is refuted: indices 1..5\n"},
    {"claims/8-text.claim", "s/repaired: abs(tr(J)) < 1$/repaired: abs(tr(J)) < 2/",
     "verify paper --only text-trace-bars --quiet", 1, "text-trace-bars: the correction is refuted: abs(tr(J)) < 2\n"},
    {"claims/8-text.claim", "s/repaired: abs(tr(J)) < 1$/repaired: tr(J) < 1/",
     "verify paper --only text-trace-bars --quiet", 1, "text-trace-bars: the correction is refuted: tr(J) < 1\n"},
    {"claims/8-text.claim", "s/repaired: V - x_1'(t) = 0/repaired: V - x_2'(t) = 0/",
     "verify paper --only text-free-index --quiet", 1, "text-free-index: the correction is refuted: V - x_2'(t) = 0\n"},
    {"claims/8-text.claim", "s/repaired: u_{si}; u_{ri}/repaired: u_{ri}; u_{si}/",
     "verify paper --only text-friction-names --quiet", 1, "text-friction-names: the correction is refuted: "},
    {"claims/8-text.claim", "s/repaired: t^\\*; t^\\*/repaired: t; t/", "verify paper --only text-time-name --quiet", 1,
     "text-time-name: the correction is refuted: "},
    {"claims/8-text.claim", "s/repaired: m_1; m_1/repaired: m_2; m_2/", "verify paper --only text-mass-name --quiet", 1,
     "text-mass-name: the correction is refuted: "},
    {"claims/8-text.claim", "s/repaired: F_ u_$/repaired: F_ k_ m_/", "verify paper --only text-dimensions --quiet", 1,
     "text-dimensions: the correction is refuted: "},
    {"claims/8-text.claim", "/^claim text-first-always$/,/^$/{s/repair: .*/repair: eq-16b#1.2/}",
     "verify paper --only text-first-always --quiet", 1, "text-first-always: the correction is refuted: "},
    {"errata.eq", "s/V.sin(omega/V*cos(omega/; s/V .sin/V \\\\\\\\cos/", "verify paper --only eq-40 --quiet", 1,
     "eq-40: the correction is refuted: "},
    {"claims/1-model.claim", "s/heading: V - x_2'/heading: V - x_1'/", "verify paper --only eq-2c --quiet", 1,
     "eq-2c: refuted, recorded as proved\n"},
};

static void damage_and_ask(const struct damage *x, size_t i) {
  char command[2048];
  int status;
  const char *data = scratch_path("data");
  snprintf(command, sizeof command,
           "rm -rf %s && cp -R verify %s && cp %s/%s %s.was && sed -i \"%s\" %s/%s && ! cmp -s %s.was %s/%s", data,
           data, data, x->file, data, x->script, data, x->file, data, data, x->file);
  said(&status, command);
  ck_assert_msg(status == 0, "damage %zu, %s, changes nothing", i, x->script);
  snprintf(command, sizeof command, "STICKSLIP_DATA=%s %s %s%s%s 2>&1", data, program(), x->ask,
           x->ask == planned ? "" : " --out ", x->ask == planned ? "" : scratch_path("out"));
  const char *out = said(&status, command);
  ck_assert_msg(status == x->status && strstr(out, x->says), "damage %zu, %s: status %d, not %d with \"%s\":\n%s", i,
                x->script, status, x->status, x->says, out);
}

START_TEST(rules_name_what_breaks_them) {
  damage_and_ask(&rules[_i], (size_t)_i);
}
END_TEST

START_TEST(wrong_corrections_are_refuted) {
  damage_and_ask(&corrections[_i], (size_t)_i);
}
END_TEST

/* check says the same of the file alone, wherever it lies. */
START_TEST(check_knows_the_rules) {
  int status;
  char command[1024];
  const char *file = scratch_path("8-text.claim");
  snprintf(
      command, sizeof command,
      "sed '/^claim text-54-fulfilled$/,/^$/{s/eq-56 D/eq-56 D, eq-54/}' verify/claims/8-text.claim > %s && %s check "
      "%s 2>&1",
      file, program(), file);
  const char *out = said(&status, command);
  ck_assert_msg(status == 3 && strstr(out, "the conclusion eq-54 is among its own premises"), "%s", out);
  file = scratch_path("paper.statements");
  snprintf(command, sizeof command,
           "sed 's/claims: text-charpoly$/claims: eq-14/' verify/paper/paper.statements > %s && %s check %s 2>&1", file,
           program(), file);
  out = said(&status, command);
  ck_assert_msg(status == 3 && strstr(out, "text-charpoly: no statement of the paper names this claim"), "%s", out);
  snprintf(command, sizeof command,
           "%s check verify/paper/paper.statements && %s check verify/controls/controls.claim && %s check "
           "verify/claims/paper.roots",
           program(), program(), program());
  said(&status, command);
  ck_assert_int_eq(status, 0);
}
END_TEST

/* A claim with too few points goes through with a reason, and the report prints it. */
START_TEST(a_reason_is_printed) {
  static const struct damage few = {"claims/4-stability.claim", "/^claim eq-26$/a\\  points: arcs 2\\n  few: a test",
                                    "verify paper --only eq-26 --quiet", 0, "as recorded"};
  int status;
  char command[1024];
  damage_and_ask(&few, 0);
  snprintf(command, sizeof command, "grep -c 'fewer points or routes than its kind asks for: a test' %s/audit.json",
           scratch_path("out"));
  ck_assert_int_eq(atoi(said(&status, command)), 1);
}
END_TEST

/* A formula without a control on file has one that the program makes, and it is noticed; one on file that is near says by
   how much: 1 - chi is less than 1, so that 1e-90 (1 - chi) is less than 1e-90 and more than 1e-91 for most chi. */
START_TEST(near_controls_are_made_and_measured) {
  int status;
  char command[1024];
  snprintf(command, sizeof command, "%s verify paper --only eq-3,eq-4,eq-48b --quiet --out %s", program(),
           scratch_path("out"));
  const char *out = said(&status, command);
  ck_assert_msg(status == 0 && strstr(out, "as recorded"), "%s", out);
  snprintf(command, sizeof command,
           "%s -c 'import json; print(*sorted((c[\"id\"], c[\"noticed\"], c.get(\"distance\")) for c in "
           "json.load(open(\"%s/audit.json\"))[\"controls\"] if \"distance\" in c))'",
           python(), scratch_path("out"));
  out = said(&status, command);
  ck_assert_str_eq(out,
                   "('ctl-exact-matrix', True, '1e-90') ('near-eq-3b', True, '1e-30') ('near-eq-3d', True, '1e-30') "
                   "('near-eq-3e', True, '1e-30') ('near-eq-4', True, '1e-30') ('near-eq-48b', True, '1e-30')\n");
}
END_TEST

Suite *rules_suite(void) {
  Suite *s = suite_create("rules");
  TCase *t = tcase_create("damages");
  tcase_set_timeout(t, 120);
  tcase_add_checked_fixture(t, scratch_open, scratch_close);
  tcase_add_loop_test(t, rules_name_what_breaks_them, 0, sizeof rules / sizeof *rules);
  tcase_add_loop_test(t, wrong_corrections_are_refuted, 0, sizeof corrections / sizeof *corrections);
  tcase_add_test(t, check_knows_the_rules);
  tcase_add_test(t, a_reason_is_printed);
  tcase_add_test(t, near_controls_are_made_and_measured);
  suite_add_tcase(s, t);
  return s;
}
