/* Claims of the tests' own beside formulas of their own, and what each comes to: tests/cases/verdicts.tsv.  What is
   expected is known by hand: ranks by counting, the law by its words, forces by the orbit's own bounds.  A claim at
   fault is refused at the line in the place of its condition. */
#include "paper_model.h"
#include "run/audit.h"
#include "test.h"

TABLE(abbreviated, "tests/cases/verdicts_abbreviated.tsv", 2);
TABLE(cases, "tests/cases/verdicts.tsv", 6);
enum { TOGETHER, WHAT, RECORDS, CLAIM, VERDICT, CONDITION }; /* its columns; the last: or what is said */

/* Rows of one name are judged in one run, which draws its orbits once: the first row behind those of this one. */
static int behind(int first) {
  int end = first + 1;
  const char *name = cases.row[first][TOGETHER];
  while (*name && end < cases.n && strcmp(cases.row[end][TOGETHER], name) == 0) end++;
  return end;
}

static int runs(void) {
  int n = 0;
  for (int i = 0; i < cases.n; i = behind(i)) n++;
  return n;
}

/* What fails can be rechecked: but for notation, words, and what fails in no numbers (docs/house.md) it has a
   certificate. */
static bool has_certificate(const struct finding *f, const char *claim) {
  static const char *const none[] = {"{behaviour}switches", "{behaviour}jumps",     "{behaviour}linear",
                                     "{behaviour}closed",   "{behaviour}dimension", "given: "};
  bool asked = verdict_fails(f->verdict) && strcmp(f->fault, fault_name[FAULT_NOTATION]) != 0;
  for (size_t i = 0; i < COUNT(none); i++) asked = asked && !strstr(claim, none[i]);
  return !asked || f->certificate.n > 0;
}

CASE("verdicts", .once = {paper_open, paper_close});

TEST_EACH(what_claims_come_to, runs()) {
  LOCAL(text, records, claims);
  OWNED(audit_result) r;
  const char *named[100][2] = {{NULL}};
  ck_assert_int_lt(abbreviated.n, COUNT(named));
  for (int i = 0; i < abbreviated.n; i++) memcpy(named[i], abbreviated.row[i], sizeof *named);
  int first = 0;
  for (int run = 0; run < _i; run++) first = behind(first);
  int n = behind(first) - first;
  for (int i = 0; i < n; i++) {
    char *const *row = cases.row[first + i];
    bool elsewhere = strncmp(row[CLAIM], "section: ", 9) == 0;
    text_printf(&claims, "claim eq-0%c\n  title: of the test\n  %s", 'a' + i,
                elsewhere ? "" : "section: appendix_b\n  ");
    field_expand(&records, row[RECORDS], (const char *const(*)[2])named);
    field_expand(&claims, row[CLAIM], (const char *const(*)[2])named);
    text_add(&records, "\n");
    text_add(&claims, "\n\n");
  }
  OWNED(model) m =
      paper_model(&(struct paper_layers){.overlay = scratch_put("overlay.eq", text_str(&records)), .controls = true});
  if (strcmp(cases.row[first][VERDICT], "fault") == 0) {
    fails_with(judge_text(&r, &m, text_str(&claims), &the_paper.scene, "eq-0", &d), cases.row[first][CONDITION]);
    return;
  }
  goes_well(judge_text(&r, &m, text_str(&claims), &the_paper.scene, "eq-0", &d));
  ck_assert_int_ge((int)r.n_findings, n); /* and those of restrictions */
  for (int i = 0; i < n; i++) {
    char *const *row = cases.row[first + i];
    const struct finding *f = finding_with_id(&r, (const char[]){'e', 'q', '-', '0', (char)('a' + i), '\0'});
    const char *said = verdict_name[f->verdict];
    if (strchr(row[VERDICT], ',')) said = formatted("%s, repaired %s", said, verdict_name[f->correction_verdict]);
    ck_assert_msg(strcmp(said, row[VERDICT]) == 0, "%s: %s\n%s: %s, not %s", row[WHAT], row[RECORDS], row[CLAIM], said,
                  row[VERDICT]);
    ck_assert_msg(has_certificate(f, row[CLAIM]), "%s has no certificate: %s", row[WHAT], row[CLAIM]);
    bool conditional = f->verdict == VERDICT_CONDITIONAL;
    ck_assert_msg(f->verdict == VERDICT_UNKNOWN || (f->condition != NULL) == conditional, "%s", row[WHAT]);
    if (*row[CONDITION] && conditional) ck_assert_str_eq(f->condition, row[CONDITION]);
    bool unsaid = *row[CONDITION] == '!';
    if (*row[CONDITION] && !conditional)
      ck_assert_msg(finding_says(f, row[CONDITION] + unsaid) != unsaid, "%s: %s", row[WHAT], row[CONDITION]);
  }
}
