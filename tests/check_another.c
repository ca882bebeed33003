/* Papers of somebody else's: tests/another is about the program's system and says so, tests/row and examples/den-hartog are
   about others and have symbols of their own.  Nothing that the program does not know is refuted, and no slip of the one who types is charged to
   the paper.  Each case damages a copy of a folder; what must be said stands beside it, written by hand. */
#include <check.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scratch.h"
#include "suites.h"

/* The folder, a script of sed for one of its files, the claims that are asked for, the exit status and what is said. */
struct audit {
  const char *folder, *file, *script, *only;
  int status;
  const char *says;
};

#define HARTOG "../examples/den-hartog"

static const struct audit audits[] = {
    {"row", "stable.eq", "1s/$/ Indeed./", "", 0,
     "paper: 6 statements: 3 proved, 1 refuted, 2 unknown; 4 of 4 controls noticed; as recorded"},
    {"another", "stable.eq", "1s/$/ Indeed./", "", 0,
     "paper: 2 statements: 1 proved, 1 refuted; 4 of 4 controls noticed; as recorded"},
    {HARTOG, "stable.eq", "1s/$/ Indeed./", "", 0,
     "paper: 9 statements: 9 proved; 9 of 9 controls noticed; as recorded"},
    /* the sign of a phase, the friction in an amplitude and in a motion, a power in a limit, the end of a half cycle */
    {HARTOG, "paper/note.eq", "/^  tex: u =/d; s/v := -(x_f/v := (x_f/", "eq-1", 1,
     "eq-1: refuted, recorded as proved"},
    {HARTOG, "paper/note.eq", "/^  tex: x_0 = a/d; s/(x_f.a)^2\\*S^2/(x_f\\/a)^2*V^2/", "eq-9", 1,
     "eq-9: refuted, recorded as proved"},
    {HARTOG, "paper/note.eq", "/^  tex: x(t) =/d; s/x_f\\*(1 - cos(omega_n/x_f*(2 - cos(omega_n/", "eq-8", 1,
     "eq-8: refuted, recorded as proved"},
    {HARTOG, "paper/note.eq", "/^  tex: F_l =/d; s/beta^4))$/beta^2))/", "eq-15", 1,
     "eq-15: refuted, recorded as proved"},
    {HARTOG, "paper/note.eq", "/^  tex: y(t) =/d; s/t - pi.omega)/t - pi\\/omega_n)/", "eq-10", 1,
     "eq-10: refuted, recorded as proved"},
    /* a name is the model's only where the paper is about its system */
    {"row", "paper/note.eq", "/tex: K =/d; s/  K := .*/  K := [2*kappa, -kappa; -kappa, kappa]/", "eq-1", 0,
     "1 statement: 1 unknown"},
    {"row", "paper/note.eq", "s/^section: note/model: two masses on a belt\\nsection: note/", "eq-1", 3,
     "t is the model's, which gives it its domain; leave the line out"},
    {"another", "paper/note.eq", "/^model:/d", "eq-1", 1, "eq-1: unknown, recorded as proved"},
    {"another", "paper/note.eq", "/^model:/d", "eq-2", 1, "eq-2: unknown, recorded as refuted"},
    {"another", "paper/note.eq", "s/^model: .*/model: a pendulum/", "eq-2", 3,
     "note.eq:4:8: error: the program has one model, \"two masses on a belt\""},
    {"another", "errata.eq", "1s/^/model: two masses in a row\\n/", "eq-2", 3,
     "errata.eq:1:1: error: the paper's model is given twice"},
    /* of a quantity that the model lacks nothing is known, and the rest goes on */
    {"another", "claims/note.claim", "s/value: D(t)/value: I/", "", 1, "eq-1: unknown, recorded as proved"},
    {"another", "claims/note.claim", "s/value: D(t)/value: P(t)/", "", 3, "note.claim:1:7: error: eq-1: "},
    {"another", "paper/note.eq",
     "s/^symbol t$/symbol w\\n  means: another\\n\\nsymbol t/; /tex: .det/d; /place: 179/d; s/= 1 + t$/= 1 + w/",
     "eq-2", 1, "eq-2: unknown, recorded as refuted"},
    /* a name that nobody declares is a slip of the file */
    {"another", "paper/note.eq", "/^symbol t$/,/^$/d; /tex:/d; /place: 83/d; /place: 179/d", "eq-2", 3,
     "note.eq:17:9: error: undefined symbol t"},
    {"row", "paper/note.eq", "/^symbol mu$/,/domain/d; /tex: .omega/d", "eq-5", 3, "error: undefined symbol mu"},
    /* a form that cannot be right is the paper's where its TeX says it, and else the file's */
    {"row", "paper/note.eq", "s/det K = .kappa^3/kappa K = \\\\kappa/; s/det(K) = kappa^3/kappa*K = kappa/", "eq-2", 1,
     "eq-2: refuted, recorded as proved"},
    {"row", "paper/note.eq", "/det K = .kappa^3/d; s/det(K) = kappa^3/kappa*K = kappa/", "eq-2", 3,
     "the two sides have the shapes 3x3 and 1x1"},
    /* what is more than the program reads */
    {"row", "paper/note.eq", "s/.det K = .kappa^3/K^2 = K K/; s/det(K) = kappa^3/K^2 = K*K/", "eq-2", 1,
     "eq-2: unknown, recorded as proved"},
    {"row", "paper/note.eq", "s/det K = .kappa^3/exp(K) = \\\\exp(K)/; s/det(K) = kappa^3/exp(K) = exp(K)/", "eq-2", 1,
     "eq-2: unknown, recorded as proved"},
    /* the model's names have the model's domains */
    {"another", "paper/note.eq", "s/^symbol t$/symbol t\\n  domain: 0 < t < 2/", "eq-2", 3, "t is the model's"},
    /* where symbols may be */
    {"row", "paper/note.eq",
     "s/.sqrt{.kappa^2} = .kappa/\\\\sqrt{q_0^2} = q_0/; s/sqrt(kappa^2) = kappa/sqrt(q_0^2) = q_0/", "eq-5", 1,
     "eq-5: refuted, recorded as proved"},
    {"row", "paper/note.eq", "s/domain: kappa > 0/domain: 3 <= kappa < 7\\/2/", "eq-5", 0, "1 proved"},
    {"row", "paper/note.eq", "/domain: kappa > 0/d", "eq-2", 1, "eq-2: unknown, recorded as proved"},
    {"row", "paper/note.eq", "s/domain: kappa > 0/domain: kappa = 1/", "eq-5", 3,
     "note.eq:11:11: error: a domain reads"},
    {"row", "paper/note.eq", "s/domain: kappa > 0/domain: 1 < kappa < 1/", "eq-5", 3, "a domain reads"},
    {"row", "paper/note.eq", "s/domain: kappa > 0/domain: mu > 0/", "eq-5", 3, "a domain reads"},
    {"row", "paper/note.eq", "s/domain: kappa > 0/domain: kappa > pi/", "eq-5", 3, "a domain reads"},
    {"row", "paper/note.eq", "s/domain: kappa > 0/domain: 1 > kappa < 2/", "eq-5", 3, "a domain reads"},
    {"row", "paper/note.eq", "s/domain: kappa > 0/domain: 1\\/0 < kappa/", "eq-5", 3, "a domain reads"},
    {"row", "paper/note.eq", "s/domain: kappa > 0/domain:/", "eq-5", 3, "note.eq:"},
    {"row", "claims/note.claim", "s/points: params 8/points: flow D 8/", "eq-2", 1,
     "eq-2: unknown, recorded as proved"},
    /* exp and pi */
    {"row", "paper/note.eq", "s/q_0 e^{-.zeta/q_0 e^{\\\\zeta/; s/exp(-zeta/exp(zeta/", "eq-4", 1,
     "eq-4: refuted, recorded as proved"},
    {"row", "paper/note.eq", "s/e^{2.pi/e^{3\\\\pi/; s/exp(2\\*pi/exp(3*pi/", "eq-6", 0, "1 refuted"},
    {"row", "paper/note.eq", "s/^symbol theta/symbol pi/", "eq-5", 3, "pi is the number"},
};

START_TEST(papers_of_others) {
  const struct audit *x = &audits[_i];
  char command[2048];
  int status;
  const char *data = scratch_path("data");
  snprintf(command, sizeof command, "cp -R tests/%s %s && sed -i '%s' %s/%s && ! cmp -s tests/%s/%s %s/%s", x->folder,
           data, x->script, data, x->file, x->folder, x->file, data, x->file);
  free(shell_output(&status, "%s", command));
  ck_assert_msg(status == 0, "%s changes nothing", x->script);
  snprintf(command, sizeof command, "STICKSLIP_DATA=%s %s verify %s%s --out %s 2>&1", data, program(),
           *x->only ? "--only " : "", x->only, scratch_path("out"));
  char *out = shell_output(&status, "%s", command);
  ck_assert_msg(status == x->status && strstr(out, x->says), "%s: status %d, not %d with \"%s\":\n%s", x->script,
                status, x->status, x->says, out);
  free(out);
}
END_TEST

/* |name - value| < 1e-32, said as d - |name - value| being its own absolute value, which balls refute where it is wrong
   and else leave unproved. */
static int near_value(char *out, size_t size, const char *name, const char *value, const char *shift) {
  return snprintf(out, size, "  abs(1e-32 - abs(%s - %s%s)) = 1e-32 - abs(%s - %s%s)\n", name, value, shift, name,
                  value, shift);
}

/* Den Hartog's amplitude and phase are those of motions that tests/oracle/den_hartog.py found without them; (9) makes
   room for these equations, and the row's data for the symbols. */
START_TEST(amplitudes_and_phases_of_motions) {
  static const char *const shift[] = {"", " + 2e-32"};
  char row[256] = "", *field[4], cosine[128], sine[128], text[2048], command[2048];
  FILE *in = fopen("tests/oracle/den_hartog.tsv", "r");
  ck_assert_ptr_nonnull(in);
  for (int i = 0; i <= _i / 4; i++) ck_assert_ptr_nonnull(fgets(row, sizeof row, in));
  fclose(in);
  row[strcspn(row, "\n")] = '\0';
  ck_assert_int_eq(split_tabs(field, 4, row), 4);
  snprintf(cosine, sizeof cosine, "cos(%s)", field[3]);
  snprintf(sine, sizeof sine, "sin(%s)", field[3]);
  const char *const held[][2] = {{"x_0", field[2]}, {"u", cosine}, {"v", sine}};
  int status, n = 0, wrong = _i % 4; /* 0: none */
  for (int k = 0; k < 3; k++)
    n += near_value(text + n, sizeof text - (size_t)n, held[k][0], held[k][1], shift[k + 1 == wrong]);
  scratch_put("values", text);
  snprintf(text, sizeof text, "\ndefine data\n  m := 1\n  k := 1\n  P := 1\n  omega := %s\n  F := %s\n", field[0],
           field[1]);
  scratch_put("data", text);
  snprintf(command, sizeof command,
           "cp -R examples/den-hartog %s && cd %s && for s in m k P F omega; do sed -i \"/^symbol $s\\$/,/domain/d\" "
           "hartog/paper/note.eq; done && sed -i -e '/tex: u^2 + v/d; /^  u^2 + v^2 = 1/d; /^equation eq-9$/r values' "
           "-e '$r data' hartog/paper/note.eq",
           scratch_path("hartog"), scratch_path(""));
  free(shell_output(&status, "%s", command));
  ck_assert_int_eq(status, 0);
  char *out = shell_output(&status, "STICKSLIP_DATA=%s %s verify --only eq-9 --out %s 2>&1", scratch_path("hartog"),
                           program(), scratch_path("out"));
  ck_assert_msg(status == 1 && strstr(out, wrong ? "eq-9: refuted" : "eq-9: unknown"), "beta = %s, %d: %s", field[0],
                wrong, out);
  free(out);
}
END_TEST

/* check reads a file with the data folder around it, and one that bears another paper's title alone. */
START_TEST(files_are_checked_with_their_own_paper) {
  static const struct {
    const char *command;
    int status;
    const char *says;
  } cases[] = {
      {"cd %s && cp -R $P/tests/row . && cp row/paper/note.eq alone.eq && $S check alone.eq", 0, "alone.eq: ok"},
      {"cd %s && cp -R $P/tests/row . && $S check row/paper/note.eq && cd row/paper && $S check note.eq", 0,
       "note.eq: ok"},
      {"cd %s && cp -R $P/tests/row . && $S check row/claims/note.claim && $S check row/controls/note.eq", 0, "ok"},
      {"cd %s && sed '/domain: mu/d; s/^symbol mu/symbol nu/' $P/tests/row/paper/note.eq > alone.eq && $S check "
       "alone.eq",
       3, "mu is neither defined nor a symbol"},
  };
  char command[2048];
  int status,
      n = snprintf(command, sizeof command, "P=$PWD; S=$(realpath %s); unset STICKSLIP_DATA; exec 2>&1; ", program());
  snprintf(command + n, sizeof command - (size_t)n, cases[_i].command, scratch_path(""));
  char *out = shell_output(&status, "%s", command);
  ck_assert_msg(status == cases[_i].status && strstr(out, cases[_i].says) && !strstr(out, "given twice"),
                "%s: status %d:\n%s", cases[_i].command, status, out);
  free(out);
}
END_TEST

Suite *another_suite(void) {
  Suite *s = suite_create("another");
  TCase *t = tcase_create("papers");
  tcase_set_timeout(t, 120);
  tcase_add_checked_fixture(t, scratch_open, scratch_close);
  tcase_add_loop_test(t, papers_of_others, 0, sizeof audits / sizeof *audits);
  tcase_add_loop_test(t, amplitudes_and_phases_of_motions, 0, 40);
  tcase_add_loop_test(t, files_are_checked_with_their_own_paper, 0, 4);
  suite_add_tcase(s, t);
  return s;
}
