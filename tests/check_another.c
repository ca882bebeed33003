/* Papers that say something else: the audited one with another record or other digits, and Den Hartog's with data.
   What must be said is written by hand.  Damages to folders of other papers are in tests/cases/damaged.tsv. */
#include "test.h"

CASE("papers", .each = {scratch_open, scratch_close});

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

/* The note about a row of masses with another equation (5) or inequality (8). */
TABLE(own, "tests/cases/own_verdicts.tsv", 3);
enum { O_KIND, O_VERDICT, O_RECORD }; /* its columns */

TEST_EACH(sentences_about_symbols_of_a_paper, own.n) {
  char *const *row = own.row[_i];
  bool equation = strcmp(row[O_KIND], "identity") == 0;
  scratch_put("record", formatted("  %s\n", row[O_RECORD]));
  scratch_put("symbols", "\nsymbol v\n  means: v\n  domain: real\nsymbol w\n  means: w\n  domain: real\n"
                         "symbol d\n  means: d\n  domain: -1 <= d <= 1\nsymbol b\n  means: b\n  domain: 0 <= b <= 1\n");
  const char *kind = equation ? "equation" : "inequality", *id = equation ? "eq-5" : "eq-8";
  FREED char *out = shell_said("cp -R tests/row $D/row && cat $D/symbols >> $D/row/paper/note.eq && sed -i -e '/^%s "
                               "%s$/,/^$/{/^  /d}' -e \"/^%s %s$/r $D/record\" $D/row/paper/note.eq && { "
                               "STICKSLIP_DATA=$D/row $P verify --quiet --out $D/out --only %s 2>&1 || :; }",
                               kind, id, kind, id, id);
  const char *want = formatted("1 statement: 1 %s", row[O_VERDICT]);
  ck_assert_msg(strstr(out, want), "%s is not %s:\n%s", row[O_RECORD], row[O_VERDICT], out);
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
