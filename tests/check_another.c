/* Papers that say something else, and papers of somebody else's: tests/another is about the program's system and says
   so, tests/row and examples/den-hartog are about others and have symbols of their own.  Nothing that the program does
   not know is refuted, and no slip of the one who types is charged to the paper.  Each case damages a copy of a folder;
   what must be said stands beside it, written by hand. */
#include "every.h"
#include "test.h"

TABLE(audits, "tests/cases/papers_of_others.tsv", 6);
enum { X_FOLDER, X_FILE, X_SCRIPT, X_ONLY, X_STATUS, X_SAYS }; /* its columns */

CASE("papers", .each = {scratch_open, scratch_close});

TEST_EACH(papers_of_others, audits.n) {
  char **x = audits.row[_i];
  shell_well("cp -R tests/%s \"$D/data\" && sed -i '%s' \"$D/data/%s\" && ! cmp -s tests/%s/%s \"$D/data/%s\"",
             x[X_FOLDER], x[X_SCRIPT], x[X_FILE], x[X_FOLDER], x[X_FILE], x[X_FILE]);
  shell_ends(atoi(x[X_STATUS]), x[X_SAYS], "STICKSLIP_DATA=\"$D/data\" \"$P\" verify %s%s --out \"$D/out\"",
             *x[X_ONLY] ? "--only " : "", x[X_ONLY]);
}

/* That nothing decides a correction can be on record, in the report as in the run; that it is wrong, or holds,
   cannot. */
TEST(corrections_on_record) {
  static const char *const verify = "STICKSLIP_DATA=\"$D/data\" \"$P\" verify --only eq-6 --out \"$D/out\"";
  shell_well("cp -R tests/row \"$D/data\" && sed -i 's/exp(pi.zeta)^2/exp(pi*zeta\\/2)^4/' \"$D/data/errata.eq\" && "
             "sed -i '/^claim eq-6/,/^$/s/record: .*/&\\n  correction: unknown/' \"$D/data/claims/note.claim\"");
  shell_ends(0, "as recorded", "%s", verify);
  shell_ends(0, "as recorded", "\"$P\" report \"$D/out\"");
  shell_well(
      "grep -q '(which is not proved)' \"$D/out/errata.md\" && ! grep -q 'are not as recorded' \"$D/out/index.html\"");
  shell_well("cp tests/row/errata.eq \"$D/data\"");
  shell_ends(1, "eq-6: the correction is proved", "%s", verify);
}

/* A root of a polynomial is no frequency of the program's system. */
TEST(roots_of_others) {
  shell_well("cp -R tests/row \"$D/data\" && sed -i '/tex: .omega = /d; s/^  omega := .*/  root omega: mu*omega^2 - "
             "kappa, smallest positive/' \"$D/data/paper/note.eq\"");
  shell_ends(1, "eq-5: unknown, recorded as proved",
             "STICKSLIP_DATA=\"$D/data\" \"$P\" verify --only eq-5 --out \"$D/out\"");
  shell_well("grep -q 'in the field Q(.*root(' \"$D/out/audit.md\" && ! grep -q 'slip phase' \"$D/out/audit.md\"");
}

/* A failure that no root describes yet is in the errata all the same; and nothing is said of a periodic solution. */
TEST(failures_without_a_root) {
  static const char *const verify = "STICKSLIP_DATA=\"$D/data\" \"$P\" verify --out \"$D/out\"";
  shell_well("cp -R tests/row \"$D/data\" && : > \"$D/data/claims/note.roots\" && "
             "sed -i '/record: refuted/d' \"$D/data/claims/note.claim\"");
  shell_ends(0, "1 refuted", "%s", verify);
  for (const char *const *file = (const char *const[]){"errata.md", "errata.tex", NULL}; *file; file++)
    shell_well(
        "sed -n '/What does not hold/,/What was compared/p' \"$D/out/%s\" | grep '6.*: it does not hold that .* It "
        "should read .* The sides differ at 8 of 8 points'",
        *file);
  shell_well("grep 'Without any consequence for other statements or results: eq-6' \"$D/out/audit.md\" && "
             "! grep 'true periodic solution' \"$D/out/audit.md\"");
}

/* A factor is no other name of the same quantity. */
TEST(factors_are_no_slips_of_notation) {
  shell_well("cp -R tests/row \"$D/data\" && cd \"$D/data\" && sed -i '/^equation eq-5/,$s/frac{.kappa}{.mu}/kappa/; "
             "s/omega^2 = kappa.mu/omega^2 = kappa/' paper/note.eq && "
             "printf 'equation err-5\\n  section: note\\n  replaces: eq-5\\n  omega^2 = kappa/mu\\n  sqrt(kappa^2) = "
             "kappa\\n' >> errata.eq");
  shell_well("STICKSLIP_DATA=\"$D/data\" \"$P\" explain eq-5 > \"$D/said\"; grep 'fault *formula' \"$D/said\" && "
             "! grep ^routes \"$D/said\"");
  shell_well("sed -i 's/{eq-6}/{err-5}/' \"$D/data/claims/note.roots\"");
  shell_ends(
      3, "there is no {err-5}, a record or a correction \"CLAIM.repaired\"; that record replaces another, write {eq-5}",
      "\"$P\" check \"$D/data/claims/note.roots\"");
}

/* What is refuted at a few of its points is shown at one of them. */
TEST(explained_where_it_fails) {
  shell_well(
      "cp -R tests/row \"$D/data\" && sed -i '/sqrt{.kappa} </d; s/sqrt(kappa) < 1 + kappa/kappa < 31\\/4/' "
      "\"$D/data/paper/note.eq\" && sed -i '/^claim eq-8/,$s/params 8/params 200/' \"$D/data/claims/note.claim\"");
  shell_ends(0, "this fails here", "STICKSLIP_DATA=\"$D/data\" \"$P\" explain eq-8");
}

TABLE(sentences, "tests/cases/other_sentences.tsv", 4);
enum { Y_ID, Y_VERDICTS, Y_WHY, Y_RECORD }; /* its columns */

/* The paper itself, where one record says something else. */
TEST_EACH(other_sentences, sentences.n) {
  char **y = sentences.row[_i], verdict[24];
  int n = 0;
  scratch_put("other.eq", y[Y_RECORD]);
  char *out =
      shell_said("$P verify paper --overlay $D/other.eq --only %s --quiet --out $D/out 2>&1; test $? = 1", y[Y_ID]);
  bool met = false;
  for (const char *p = y[Y_VERDICTS]; sscanf(p, "%23s%n", verdict, &n) == 1; p += n) {
    const char *want = formatted("%s: %s, recorded as proved", y[Y_ID], verdict);
    met = met || strstr(out, want);
  }
  ck_assert_msg(met, "%s, not %s, though %s:\n%s", y[Y_ID], y[Y_VERDICTS], y[Y_WHY], out);
  free(out);
}

/* The example with other digits: on its orbit t_a, z_10 and z_20 are 0.532281, 0.978188 and -2.124695, the bounds
   0.053228 and 1.670503, and from the numbers to four decimals, taken exactly, e_2 would be 0.8586. */
TABLE(digits, "tests/cases/other_digits.tsv", 9);
enum { T_A, T_B, T_C, T_D, Z10, Z20, U_R1, U_R2, SAID }; /* its columns */

TEST_EACH(other_digits, digits.n) {
  char *const *row = digits.row[_i];
  OWNED(text) scene = {0};
  text_printf(&scene,
              "chi = 0.8\neta = 1\nV = 1\ne1 = 2.7844\ne2 = 0.8587\nprinted: e1 = 2.7844\nprinted: e2 = 0.8587\n"
              "printed: t_a = %s\nprinted: t_b = %s\nprinted: t_c = %s\nprinted: t_d = %s\nprinted: z10 = %s\n"
              "printed: z20 = %s\nprinted: u_r1 = %s\nprinted: u_r2 = %s\n",
              row[T_A], row[T_B], row[T_C], row[T_D], row[Z10], row[Z20], row[U_R1], row[U_R2]);
  scratch_put("digits.scene", text_str(&scene));
  FREED char *out =
      shell_said("$P verify $D/digits.scene --quiet --out $D/out --only num-t_a,num-t_b,num-t_c,num-t_d,num-z10,"
                 "num-z20,num-u_r1,num-u_r2,num-e1,num-e2,text-periodic 2>&1");
  ck_assert_msg(strstr(out, row[SAID]), "not %s:\n%s", row[SAID], out);
}

/* |name - value| < 1e-32, said as d - |name - value| being its own absolute value, which balls refute where it is wrong
   and else leave unproved. */
static int near_value(char *out, size_t size, const char *name, const char *value, const char *shift) {
  return snprintf(out, size, "  abs(1e-32 - abs(%s - %s%s)) = 1e-32 - abs(%s - %s%s)\n", name, value, shift, name,
                  value, shift);
}

/* Den Hartog's amplitude and phase are those of motions that tests/oracle/den_hartog.py found without them; (9) makes
   room for these equations, and the row's data for the symbols. */
TEST_EVERY(amplitudes_and_phases_of_motions, 3, 40) {
  static const char *const shift[] = {"", " + 2e-32"};
  char text[2048];
  OWNED(table) motions = table_read("tests/oracle/den_hartog.tsv", 4);
  char *const *field = motions.row[_i / 4];
  const char *cosine = formatted("cos(%s)", field[3]);
  const char *sine = formatted("sin(%s)", field[3]);
  const char *const held[][2] = {{"x_0", field[2]}, {"u", cosine}, {"v", sine}};
  int n = 0, wrong = _i % 4; /* 0: none */
  for (int k = 0; k < 3; k++)
    n += near_value(text + n, sizeof text - (size_t)n, held[k][0], held[k][1], shift[k + 1 == wrong]);
  scratch_put("values", text);
  snprintf(text, sizeof text, "\ndefine data\n  m := 1\n  k := 1\n  P := 1\n  omega := %s\n  F := %s\n", field[0],
           field[1]);
  scratch_put("data", text);
  shell_well(
      "cp -R examples/den-hartog \"$D/hartog\" && cd \"$D\" && for s in m k P F omega; do sed -i \"/^symbol "
      "$s\\$/,/domain/d\" "
      "hartog/paper/note.eq; done && sed -i -e '/tex: u^2 + v/d; /^  u^2 + v^2 = 1/d; /^equation eq-9$/r values' "
      "-e '$r data' hartog/paper/note.eq");
  shell_ends(1, wrong ? "eq-9: refuted" : "eq-9: unknown",
             "STICKSLIP_DATA=\"$D/hartog\" \"$P\" verify --only eq-9 --out \"$D/out\"");
}

TABLE(own_papers, "tests/cases/own_papers.tsv", 3);
enum { COMMAND, STATUS, O_SAYS }; /* its columns */

/* check reads a file with the data folder around it, and one that bears another paper's title alone. */
TEST_EACH(files_are_checked_with_their_own_paper, own_papers.n) {
  char *const *row = own_papers.row[_i];
  FREED char *out =
      shell_said("HERE=$PWD; S=$(realpath $P); unset STICKSLIP_DATA; exec 2>&1; cd $D && %s; test $? = %s",
                 row[COMMAND], row[STATUS]);
  ck_assert_msg(strstr(out, row[O_SAYS]) && !strstr(out, "given twice"), "%s:\n%s", row[COMMAND], out);
}
