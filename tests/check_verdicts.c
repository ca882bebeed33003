/* Claims of the tests' own beside formulas of their own, and what each comes to: tests/cases/verdicts.tsv.  What is
   expected is known by hand: ranks by counting, the law by its words, forces by the orbit's own bounds.  A claim at
   fault is refused at the line in the place of its condition. */
#include "paper_model.h"
#include "run/audit.h"
#include "test.h"

#define OWN(id) "relation own-" id "\n  section: appendix_b\n  "
#define IN(s)                                                                                                          \
  { s, "\n  section: " s "\n  " }
#define SLOWER "  eps*(V - x_1'(t)) > 0 for eps in {+1, -1}\n"
#define SLIDES "u_1 = eps*u_s1 for eps in {+1, -1}\n"

static const char *const named[][2] = {
    IN("appendix_a"),
    IN("appendix_b"),
    IN("model"),
    IN("periodic"),
    IN("prediction"),
    IN("stability"),
    IN("validation"),
    /* Coulomb's law of the first mass */
    {"slower", SLOWER},
    {"slips so", OWN("slips")},
    {"sticks so", OWN("sticks")},
    {"breaks so", OWN("breaks")},
    {"slips", OWN("slips") SLIDES SLOWER},
    {"sticks", OWN("sticks") "u_1 = x_1(t) - chi*x_2(t)\n  -u_r1 < x_1(t) - chi*x_2(t) < u_r1\n"},
    {"breaks", OWN("breaks") SLIDES "  eps*(x_1(t) - chi*x_2(t)) > u_r1 for eps in {+1, -1}\n"},
    /* the motion's equations: all of them, or with other right sides */
    {"moves so", OWN("moves") "trajectory x_1(t), x_2(t)\n  x_1''(t) + x_1(t) - chi*x_2(t) = "},
    {"moves", OWN("moves") "trajectory x_1(t), x_2(t)\n  x_1''(t) + x_1(t) - chi*x_2(t) = u_1\n"
                           "  x_2''(t) + chi*eta*(x_2(t) - x_1(t)) = eta*u_2\n"},
    {"own law", "slips: own-slips H\n  sticks: own-sticks C\n  breaks: own-breaks C"},
    {"behaviour", "kind: behaviour\n  check: "},
    {"laws", "depends-on: first, second\n\nclaim first\n  section: model\n  title: m_1\n  kind: law\n  mass: 1\n"
             "  moves: own-moves#2 D\n  slips: own-slips H\n  sticks: own-sticks C\n  breaks: own-breaks C\n\n"
             "claim second\n  section: model\n  title: m_2\n  kind: law\n  mass: 2\n  moves: own-moves#3 D\n"
             "  slips: eq-2#2, eq-2#4 H\n  sticks: eq-2d Gamma\n  breaks: eq-2e Gamma"},
    /* the paper's list of constraints, the part of it that bounds solutions, and the least static friction */
    {"list", "eq-51, eq-52#1.2, eq-52#2.2, eq-54#1.2, eq-54#2.2, eq-57#1, eq-57#2.2, text-h-phase, eq-59#1.2, eq-59#2"},
    {"bounds", "constraints: eq-51, eq-52#1.2, eq-52#2.2, eq-57#1, eq-57#2.2, text-h-phase, eq-59#1.2, eq-59#2"},
    {"least", "least-first: (e_1 - (z_1c - chi*z_2c))/2\n  least-second: (e_2 - chi*(z_20 - z_10))/2"},
    {"six", "kind: solutions\n  statement: text-six-equations\n  "},
    {"two", "kept: yes\n  at: chi = 71/100, eta = 6/5, V = 19/10, e1 = 59/10, e2 = 158/1000\n"},
    {"sign in D", "kind: identity\n  statement: own-sign\n  points: arcs D 4\n  routes: exponential"},
    {"admissible", "kind: identity\n  points: admissible 16\n  routes: exponential\n  "},
    {"lengths", "kind: scaling\n  scaled: V e_ u v F_ z x y d_ dz\n  "},
    {"number", "kind: number\n  number: e1\n  from: orbit\n  formula: "},
    {"example", "kind: argument\n  over: scene\n  "},
    {"uses", "kind: notation\n  quote: K_1 and $u_{si}, u_{ri}$ of \\Sigma_0 and P\n  symbols: "},
    /* on the way det(N_1 - I) is zero; the first mass touches the belt's velocity */
    {"along", "at: chi = 15/64, eta = 2, V = 1, e1 = 2.7294, e2 = 0.4475\n  vary: e2 from "},
    {"touching", "at: chi = 1/2, eta = 4, V = 1, e1 = 5/2, e2 = 1.11\n  vary: e2 from "},
    {NULL, NULL}};

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

CASE("verdicts", .once = {paper_open, paper_close});

TEST_EACH(what_claims_come_to, runs()) {
  LOCAL(text, records, claims);
  OWNED(audit_result) r;
  int first = 0;
  for (int run = 0; run < _i; run++) first = behind(first);
  int n = behind(first) - first;
  for (int i = 0; i < n; i++) {
    char *const *row = cases.row[first + i];
    bool elsewhere = strncmp(row[CLAIM], "section: ", 9) == 0;
    text_printf(&claims, "claim eq-0%c\n  title: of the test\n  %s", 'a' + i,
                elsewhere ? "" : "section: appendix_b\n  ");
    field_expand(&records, row[RECORDS], named);
    field_expand(&claims, row[CLAIM], named);
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
    bool conditional = f->verdict == VERDICT_CONDITIONAL;
    ck_assert_msg(f->verdict == VERDICT_UNKNOWN || (f->condition != NULL) == conditional, "%s", row[WHAT]);
    if (*row[CONDITION] && conditional) ck_assert_str_eq(f->condition, row[CONDITION]);
    if (*row[CONDITION] && !conditional) ck_assert_msg(finding_says(f, row[CONDITION]), "%s: not said", row[WHAT]);
  }
}
