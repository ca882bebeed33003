/* Damages to what the audit itself is made of, each to a copy of the data folder: a rule of the claims names it, or a
   correction and a control are judged again.  What must be said is written by hand beside what is done. */
#include "test.h"

/* What is done to which file (a script of sed), what the program is asked, how it ends and what it says. */
enum { D_FILE, D_SCRIPT, D_ASK, D_STATUS, D_SAYS };
TABLE(rules, "tests/cases/rules.tsv", 5);

TABLE(corrections, "tests/cases/rules_corrections.tsv", 5);

static void damage_and_ask(char *const x[]) {
  bool planned = strstr(x[D_ASK], "--plan") != NULL;
  shell_well("rm -rf \"$D/data\" && cp -R verify \"$D/data\" && cp \"$D/data/%s\" \"$D/was\" && "
             "sed -i \"%s\" \"$D/data/%s\" && ! cmp -s \"$D/was\" \"$D/data/%s\"",
             x[D_FILE], x[D_SCRIPT], x[D_FILE], x[D_FILE]);
  shell_ends(atoi(x[D_STATUS]), x[D_SAYS], "STICKSLIP_DATA=\"$D/data\" \"$P\" %s %s", x[D_ASK],
             planned ? "" : "--out \"$D/out\"");
}

CASE("damages", .each = {scratch_open, scratch_close});

TEST_EACH(rules_name_what_breaks_them, rules.n) {
  damage_and_ask(rules.row[_i]);
}

TEST_EACH(wrong_corrections_are_refuted, corrections.n) {
  damage_and_ask(corrections.row[_i]);
}

/* check says the same of the file alone, wherever it lies. */
TEST(check_knows_the_rules) {
  shell_ends(3, "the conclusion eq-54 is among its own premises",
             "sed '/^claim text-54-fulfilled$/,/^$/{s/eq-56 D/eq-56 D, eq-54/}' verify/claims/7-appendix-b.claim "
             "> $D/7-appendix-b.claim && $P check $D/7-appendix-b.claim");
  shell_ends(3, "the sentence cites (52), which is neither a premise nor a conclusion",
             "sed '/^claim text-54-fulfilled$/,/^$/s/premises: eq-52, /premises: /' verify/claims/7-appendix-b.claim "
             "> $D/7-appendix-b.claim && $P check $D/7-appendix-b.claim");
  shell_ends(3, "text-charpoly: no statement of the paper names this claim",
             "sed 's/claims: text-charpoly$/claims: eq-14/' verify/paper/paper.statements > $D/paper.statements && "
             "$P check $D/paper.statements");
  shell_well("$P check verify/paper/paper.statements && $P check verify/controls/controls.claim && "
             "$P check verify/claims/paper.roots");
}

/* A claim with too few points goes through with a reason, and the report prints it. */
TEST(a_reason_is_printed) {
  static char *const few[] = {"claims/4-stability.claim", "/^claim eq-26$/a\\  points: arcs 2\\n  few: a test",
                              "verify paper --only eq-26 --quiet", "0", "as recorded"};
  damage_and_ask(few);
  shell_well("test 1 = $(grep -c 'fewer points or routes than its kind asks for: a test' $D/out/audit.json)");
}

/* A formula without a control on file has one that the program makes, and it is noticed; one on file that is near says
   by how much: 1 - chi is less than 1, so that 1e-90 (1 - chi) is less than 1e-90 and more than 1e-91 for most chi. */
TEST(near_controls_are_made_and_measured) {
  shell_ends(0, "as recorded", "$P verify paper --only eq-3,eq-4,eq-48b --quiet --out $D/out");
  FREED char *out =
      shell_said("$Y -c 'import json; print(*sorted((c[\"id\"], c[\"noticed\"], c.get(\"distance\")) for c in "
                 "json.load(open(\"'$D'/out/audit.json\"))[\"controls\"] if \"distance\" in c))'");
  ck_assert_str_eq(out,
                   "('ctl-exact-matrix', True, '1e-90') ('near-eq-3b', True, '1e-30') ('near-eq-3d', True, '1e-30') "
                   "('near-eq-3e', True, '1e-30') ('near-eq-4', True, '1e-30') ('near-eq-48b', True, '1e-30')\n");
}
