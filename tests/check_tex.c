/* Formulas in LaTeX as tokens.  What each formula holds is written out by hand, a letter for each token. */
#include "base/tex.h"
#include "test.h"

/* A letter for each kind, in the order of the header. */
static const char letters[] = ". adsOCRLpcrgb()BEwX";

static void spell(char out[64], const char *formula, size_t len) {
  const char *end = formula + len;
  size_t n = 0;
  for (struct tex_token t = tex_read(formula, end); t.kind != TEX_END; t = tex_read(t.s + t.len, end)) {
    ck_assert(t.len > 0 && t.s + t.len <= end && n < 63);
    ck_assert(!t.word == (t.kind != TEX_WORD));
    out[n++] = letters[t.kind];
  }
  out[n] = '\0';
}

TEST(formulas_are_spelt) {
  enum { FORMULA, KINDS };
  OWNED(table) cases = table_read("tests/cases/tex_kinds.tsv", 2);
  char kinds[64];
  for (int i = 0; i < cases.n; i++) {
    spell(kinds, cases.row[i][FORMULA], strlen(cases.row[i][FORMULA]));
    ck_assert_str_eq(kinds, cases.row[i][KINDS]);
  }
}

/* A formula inside a text ends where it is told to, also in the middle of a command. */
TEST(nothing_behind_the_end_is_read) {
  char kinds[64];
  spell(kinds, "\\chi\\eta", 4);
  ck_assert_str_eq(kinds, "w");
  spell(kinds, "\\chi\\eta", 3);
  ck_assert_str_eq(kinds, "X");
  spell(kinds, "a\\\\", 2);
  ck_assert_str_eq(kinds, "aX");
}

TEST(a_point_belongs_to_a_number_between_digits) {
  static const struct {
    const char *formula;
    size_t len;
  } cases[] = {{"7", 1}, {"12", 2}, {"0.25x", 4}, {"3.", 1}, {"1.2.3", 5}, {"4.x", 1}};
  for (size_t i = 0; i < COUNT(cases); i++) {
    const char *s = cases[i].formula;
    ck_assert_uint_eq(tex_number_length(s, s + strlen(s)), cases[i].len);
  }
}

TEST(braces) {
  static const char s[] = "{cases}1";
  size_t len = 0;
  ck_assert_ptr_eq(tex_braced(&len, s, s + sizeof s - 1), s + 1);
  ck_assert_uint_eq(len, 5);
  ck_assert_ptr_null(tex_braced(&len, s, s + 6));
  ck_assert_ptr_null(tex_braced(&len, s + 1, s + 8));
  ck_assert_ptr_null(tex_braced(&len, s, s));
}

/* Greek letters stand in Unicode in the order of the alphabet, from U+03B1 and U+0393 on. */
TEST(commands) {
  static const char *const greek[] = {"alpha", "beta",   "gamma",   "delta", NULL,  "zeta", "eta",  "theta", "iota",
                                      "kappa", "lambda", "mu",      "nu",    "xi",  NULL,   "pi",   "rho",   NULL,
                                      "sigma", "tau",    "upsilon", NULL,    "chi", "psi",  "omega"};
  for (size_t i = 0; i < COUNT(greek); i++) {
    if (!greek[i]) continue;
    const struct tex_word *w = tex_word(greek[i], strlen(greek[i]));
    unsigned point = 0x3B1 + (unsigned)i;
    const char utf8[] = {(char)(0xC0 | point >> 6), (char)(0x80 | (point & 0x3F)), '\0'};
    ck_assert(w && w->role == TEX_ROLE_LETTER);
    ck_assert_str_eq(w->text, utf8);
  }
  ck_assert_int_eq(tex_word("frac", 4)->args, 2);
  ck_assert_ptr_null(tex_word("fra", 3));
  ck_assert_ptr_null(tex_word("fracs", 5));
  ck_assert_str_eq(tex_environment("bmatrix", 7)->close, "]");
  ck_assert_int_eq(tex_environment("cases", 5)->most_cells, 2);
  ck_assert_ptr_null(tex_environment("array", 5));
}
