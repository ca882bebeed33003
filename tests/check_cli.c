/* The program as its users meet it: what verify writes, what explain and the help say.  What orbit, jacobian and simulate
   print is held against other programs' numbers by tests/oracle/said.py, from check_commands.c. */
#include <unistd.h>

#include "command.h"
#include "every.h"
#include "test.h"
#include "whole.h"

/* --- verify --- */

/* Of the whole paper: what verify said, and the report. */
static char *full_out, *full_json, *full_md;

static char *report(const char *folder, const char *file) {
  const char *name = formatted("%s/%s", folder, file);
  return file_text(scratch_path(name));
}

static void open_full(void) {
  scratch_open();
  whole_open();
  full_out = report("whole", "said");
  full_json = report("whole/paper", "audit.json");
  full_md = report("whole/paper", "audit.md");
}

static void close_full(void) {
  free(full_md);
  free(full_json);
  free(full_out);
  scratch_close();
}

CASE("verify", .once = {open_full, close_full}, .seconds = TIME_LIMIT);

/* What was computed at another time and perhaps on another machine, to the byte; run.json says how a run went.  Where a
   file differs, make verify writes it anew. */
TEST(the_report_on_record_is_the_computed_one) {
  shell_well(
      "for f in $(ls $D/whole/paper); do [ $f = run.json ] || cmp $D/whole/paper/$f reports/paper/$f || exit; done");
  shell_well("echo 0 | diff - $D/whole/status && diff /dev/null $D/whole/errors");
  ck_assert_str_eq(scratch_list(scratch_path("whole/paper")),
                   "along-e2.tsv animation.tsv audit.csv audit.json audit.md claims.dot differences.tsv errata.md "
                   "errata.tex figure-3.tsv figure-4.tsv index.html junit.xml long-run.tsv margins.tsv return-map.tsv "
                   "run.json statements.tsv");
}

static const char *const verdicts[] = {"proved",  "conditional", "supported", "refuted",
                                       "unknown", "skipped",     "definition"};

/* The last line of the output says what the summary of audit.json says. */
TEST(the_last_line_is_the_summary) {
  const char *end = full_out + strlen(full_out) - 1, *line = end;
  ck_assert(*end == '\n');
  while (line > full_out && line[-1] != '\n') line--;
  const char *summary = strstr(full_json, "\"summary\": {");
  ck_assert(summary != NULL && strncmp(line, "paper: ", 7) == 0);
  const char *checks = strstr(full_json, "\"checks\": {"), *semicolon = strchr(line, ';');
  ck_assert(checks != NULL && semicolon != NULL);
  for (int of = 0; of < 2; of++) {
    const char *from = of ? semicolon + 1 : line + 6, *end_of = strchr(from, ';');
    const char *half = formatted("%.*s", (int)(end_of - from), from);
    int total = 0;
    for (int i = 0; i < COUNT(verdicts); i++) {
      int n = atoi(member(of ? checks : summary, verdicts[i]));
      total += n;
      const char *part = formatted(" %d %s", n, verdicts[i]);
      ck_assert_msg((strstr(half, part) != NULL) == (n > 0), "%s: %s", part, half);
    }
    ck_assert_int_eq(total, atoi(member(of ? checks : summary, "total")));
    ck_assert_int_eq(total, atoi(half));
    ck_assert(strstr(half, of ? " checks: " : " statements: "));
  }
  int noticed = -1, controls = -2;
  ck_assert(sscanf(strchr(semicolon + 1, ';'), "; %d of %d controls noticed; as recorded", &noticed, &controls) == 2);
  ck_assert_msg(noticed == controls && noticed > 20, "%s", line);
}

/* audit.md holds every claim of audit.json once, what needs attention before the overview. */
TEST(the_markdown_holds_every_claim) {
  int claims = 0;
  for (const char *p = strstr(full_json, "    {\n      \"id\": \""); p; p = strstr(p + 1, "    {\n      \"id\": \"")) {
    if (strncmp(strchr(p + 8, '\n') + 1, "      \"equation\"", 16) != 0) continue; /* a control */
    const char *heading = formatted("\n### %s: ", member(p, "id"));
    const char *h = strstr(full_md, heading);
    ck_assert_msg(h && !strstr(h + 1, heading), "%s stands not once in audit.md", heading + 1);
    const char *verdict = formatted("%s", member(p, "verdict"));
    bool attention =
        strcmp(verdict, "refuted") == 0 || strcmp(verdict, "conditional") == 0 || strcmp(verdict, "unknown") == 0;
    ck_assert_msg((h < strstr(full_md, "\n## Every claim")) == attention, "%s", heading + 1);
    claims++;
  }
  ck_assert_int_eq(claims,
                   atoi(member(full_json, "total")) + atoi(member(strstr(full_json, "\"checks\": {"), "total")));
}

/* --- Usage and bad input --- */

CASE("refusal", .once = {scratch_open, scratch_close}, .seconds = TIME_LIMIT);

/* A folder that is not there; and none beside a copy of the program, unless it is installed. */
TEST(a_missing_data_folder_is_noticed) {
  shell_ends(3, scratch_path("no-data"), "STICKSLIP_DATA=$D/no-data $P list");
  if (access(STICKSLIP_DATADIR, F_OK) == 0) return;
  shell_ends(3, "the data folder verify/ was not found; set STICKSLIP_DATA to it",
             "mkdir -p $D/a/b && cp $P $D/a/b/copy && unset STICKSLIP_DATA && $D/a/b/copy list");
}

/* --- explain --- */

/* The n-th number of the line that begins with the label. */
static double shown_number(const char *out, const char *label, int n) {
  const char *p = strstr(out, label);
  ck_assert_msg(p != NULL, "no line \"%s\" in\n%.1500s", label, out);
  p += strlen(label);
  char *end;
  double x = 0;
  for (int i = 0; i < n; i++, p = end) {
    x = strtod(p, &end);
    ck_assert_msg(end > p, "%s: %d numbers, not %d", label, i, n);
  }
  return x;
}

CASE("explain", .once = {scratch_open, scratch_close}, .seconds = TIME_LIMIT);

/* (10) prints D with V t where t is meant: at V = 2, t = 3 the entry [1,3] is 6 against 3. */
TEST(explain_shows_both_sides) {
  static const char *const types[] = {"double", "mpfr  ", "arb   "};
  OWNED(job) j = job_run_well("explain", "eq-10", "--at", "V=2,t=3", NULL);
  ck_assert(strncmp(j.out, "eq-10, the claim: ", 18) == 0 && strstr(j.out, "conditional") &&
            strstr(j.out, "V = 2, t = 3"));
  for (int i = 0; i < 3; i++) {
    char left[20], right[20];
    snprintf(left, sizeof left, "%s left ", types[i]);
    snprintf(right, sizeof right, "%s right", types[i]);
    ck_assert(shown_number(j.out, left, 1) == 1 && shown_number(j.out, right, 1) == 1);
    double d = shown_number(j.out, right, 3) - 3; /* GSL's exponential rounds */
    ck_assert(shown_number(j.out, left, 3) == 6 && d > -1e-13 && d < 1e-13);
    const char *row = strstr(j.out, left);
    for (int k = 0; k < 4; k++, row = strchr(row, '\n') + 1) /* D is 4 x 4 */
      ck_assert(*row == (k ? ' ' : *left) && shown_number(row, k ? "" : left, k + 1) == 1);
    ck_assert(strncmp(row, right, strlen(right)) == 0);
  }
  ck_assert(strstr(j.out, "double left  1.0000000000000000  0  6.0000000000000000*  0\n"));
  ck_assert(strstr(j.out, "\nas read     D(t) := [I, V*t*I; 0, I]\n") &&
            strstr(j.out, "\n*           the two sides differ here\n"));
  job_take(&j, job_run_well("explain", "eq-3", "--at", "chi=1/2,eta=3", "--tape", NULL)); /* K from (3) */
  static const double k[] = {1, -0.5, -1.5, 1.5};
  for (int i = 0; i < 4; i++)
    ck_assert(shown_number(j.out, "double left ", i + 1) == k[i] && shown_number(j.out, "double right", i + 1) == k[i]);
  ck_assert(strstr(j.out, "%0 = ") != NULL);
}

/* What the page shows by an id can be explained, be it a claim, one that a restriction makes, a root or a control; and
   there are as many claims in the list as in the report. */
TEST(what_the_page_shows_can_be_explained) {
  char *page = file_text("reports/paper/index.html"), *audit = file_text("reports/paper/audit.json");
  int roots = 0, controls = 0, claims = 0, lines = 0;
  ck_assert(page && audit);
  for (char *p = page; (p = strstr(p, " id=\"r-")) != NULL; roots++) {
    char id[40];
    ck_assert(sscanf(p, " id=\"r-%39[^\"]", id) == 1);
    p++;
    if (roots % every(3) != 0) continue;
    OWNED(job) j = job_run_well("explain", id, NULL);
    ck_assert_msg(strncmp(j.out, id, strlen(id)) == 0 && strstr(j.out, "\nwrong       ") &&
                      strstr(j.out, "\nclaims      "),
                  "%s", j.out);
  }
  ck_assert_int_gt(roots, 15);
  const char *end = strstr(audit, "\n  \"consequences\"");
  for (const char *p = strstr(audit, "\n  \"claims\": ["); p && (p = strstr(p + 1, "\n      \"id\": ")) && p < end;)
    claims++;
  for (const char *p = strstr(audit, "\n  \"controls\": ["); p && (p = strstr(p + 1, "\n      \"id\": ")) != NULL;) {
    char id[60];
    if (controls++ % 24) continue;
    ck_assert(sscanf(p, "\n      \"id\": \"%59[^\"]", id) == 1);
    OWNED(job) j = job_run_well("explain", id, NULL);
    ck_assert_msg(strstr(j.out, ", a control, ") && strstr(j.out, "\nclaim       "), "%s: %s", id, j.out);
  }
  ck_assert_int_gt(controls, 100);
  OWNED(job) j = job_run_well("list", NULL);
  for (const char *p = j.out; *p; p = strchr(p, '\n') + 1) lines++;
  ck_assert_int_eq(lines, claims);
  job_take(&j, job_run_well("explain", "eq-10d", NULL));
  ck_assert(strstr(j.out, "eq-10d, the claim: Z(t) = D(t) Z_0 in the global stick phase, when V = 1\n") == j.out &&
            strstr(j.out, "\nverdict     proved (on record: proved)\ncondition   V = 1\n"));
  free(audit);
  free(page);
}

/* --- Help --- */

/* Is the option or word in the text, not as the beginning of a longer one? */
static bool mentions(const char *text, const char *word) {
  size_t n = strlen(word);
  for (const char *p = strstr(text, word); p; p = strstr(p + 1, word))
    if ((p == text || strchr(" \n[(|\"", p[-1])) && strchr(" \n=],.)|;:", p[n])) return true;
  return false;
}

/* The rows of help --table, their four fields. */
enum { MOST_ROWS = 400, ROW_FIELDS = 4 };
struct rows {
  struct job j;
  char *field[MOST_ROWS][ROW_FIELDS];
  int n;
};

static void rows_read(struct rows *r) {
  r->j = job_run_well("help", "--table", NULL);
  r->n = 0;
  char *end = NULL;
  for (char *line = strtok_r(r->j.out, "\n", &end); line; line = strtok_r(NULL, "\n", &end), r->n++) {
    ck_assert_int_lt(r->n, MOST_ROWS);
    char *at = NULL, **field = r->field[r->n];
    int k = 0;
    for (char *f = strtok_r(line, "\t", &at); f && k < ROW_FIELDS; f = strtok_r(NULL, "\t", &at)) field[k++] = f;
    ck_assert_msg(k == ROW_FIELDS && (at == NULL || !*at), "row %d of help --table", r->n + 1);
  }
}

static void rows_clear(struct rows *r) {
  job_clear(&r->j);
}

static void lines_fit(const char *what, const char *text, int most) {
  int n = 0;
  for (const char *p = text; *p; p += strcspn(p, "\n") + 1, n++)
    ck_assert_msg(strcspn(p, "\n") <= 80, "%s: %.200s", what, p);
  ck_assert_msg(n <= most, "%s has %d lines", what, n);
}

CASE("help", .once = {scratch_open, scratch_close}, .seconds = TIME_LIMIT);

TEST(help_fits_a_screen) {
  static const char *const asked[] = {"-h", "help", "--help"};
  OWNED(rows) r;
  OWNED(job) j = job_run_well("--help", NULL);
  lines_fit("--help", j.out, 24);
  ck_assert(mentions(j.out, "COMMAND --help") && mentions(j.out, "0 as recorded"));
  for (int i = 0; i < 3; i++) {
    OWNED(job) other = job_run_well(asked[i], NULL);
    ck_assert_str_eq(other.out, j.out);
  }
  rows_read(&r);
  int commands = 0;
  for (int i = 0; i < r.n; i++) {
    if (strcmp(r.field[i][1], "usage") != 0) continue;
    const char *line = formatted("\n  %-10s %.80s\n", r.field[i][0], r.field[i][3]);
    ck_assert_msg(strstr(j.out, line) != NULL, "no line for %s", r.field[i][0]);
    commands++;
  }
  ck_assert_int_ge(commands, 18);
}

/* Less all that is blank; lines of a page are broken at blanks. */
static char *squeezed(const char *s) {
  char *out = strdup(s), *to = out;
  for (const char *p = out; *p; p++)
    if (*p != ' ' && *p != '\n') *to++ = *p;
  *to = '\0';
  return out;
}

/* How many options the page describes. */
static int options_of(const char *page) {
  const char *p = strstr(page, "\noptions:\n"), *end = strstr(page, "\nexamples:\n");
  int n = 0;
  ck_assert(p && end);
  while ((p = strstr(p + 1, "\n  --")) != NULL && p < end) n++;
  return n;
}

/* The page of the command holds its rows, and no more options than these. */
static void check_page(const struct rows *r, const char *command) {
  char *flat;
  int n_options = 0, n_examples = 0;
  OWNED(job) page = job_run_well(command, "--help", NULL);
  OWNED(job) same = job_run_well("help", command, NULL);
  ck_assert_str_eq(page.out, same.out);
  job_take(&same, job_run_well(command, "-h", NULL));
  ck_assert_str_eq(page.out, same.out);
  lines_fit(command, page.out, 100);
  flat = squeezed(page.out);
  for (int i = 0; i < r->n; i++) {
    char *const *field = r->field[i], *text = squeezed(field[3]);
    bool option = strncmp(field[1], "--", 2) == 0;
    bool own = strcmp(field[0], command) == 0 && strcmp(field[1], "usage") != 0;
    const char *head =
        formatted("\n  %s%s%s\n", field[1], *field[2] == '-' ? "" : " ", *field[2] == '-' ? "" : field[2]);
    if (own) ck_assert_msg(strstr(flat, text) && (!option || strstr(page.out, head)), "%s: %s", command, field[3]);
    n_options += own && option;
    n_examples += own && strcmp(field[1], "example") == 0;
    free(text);
  }
  ck_assert_int_eq(n_options, options_of(page.out));
  ck_assert_int_eq(n_examples, 2);
  free(flat);
}

TEST(each_command_has_its_page) {
  OWNED(rows) r;
  rows_read(&r);
  for (int i = 0; i < r.n; i++)
    if (strcmp(r.field[i][1], "usage") == 0) check_page(&r, r.field[i][0]);
}

/* With an option that nobody has behind them nothing is done, and nothing else is wrong with them. */
TEST(examples_of_the_help_are_commands) {
  OWNED(rows) r;
  int n = 0;
  rows_read(&r);
  for (int i = 0; i < r.n; i++) {
    const char *begin = formatted("stickslip %s ", r.field[i][0]), *line = r.field[i][3];
    if (strcmp(r.field[i][1], "example") != 0) continue;
    ck_assert_msg(strncmp(formatted("%s ", line), begin, strlen(begin)) == 0, "%s", line);
    shell_ends(2, "unknown option --no-such-option", "$P %s --no-such-option", line + strlen("stickslip"));
    n++;
  }
  ck_assert_int_ge(n, 36);
}

/* The jobs that --job takes are those that the help names. */
TEST(help_names_every_job) {
  OWNED(job) help = job_run_well("help", "bench", NULL);
  OWNED(job) refused = job_run("bench", "--job", "nobody", NULL);
  char *p = strstr(refused.err, "--job takes one of "), *end = NULL;
  ck_assert_msg(refused.status == 2 && p, "%s", refused.err);
  p += strlen("--job takes one of ");
  *strstr(p, ", not nobody") = '\0';
  char *says = strstr(help.out, "JOB is ");
  says[strcspn(says, ".") + 1] = '\0'; /* what follows describes them */
  int n = 0;
  for (char *job = strtok_r(p, ", ", &end); job; job = strtok_r(NULL, ", ", &end), n++) {
    if (strcmp(job, "or") == 0) continue;
    ck_assert_msg(mentions(says, job), "the help says nothing of %s", job);
  }
  ck_assert_int_ge(n, 10);
}

TEST(help_and_version) {
  OWNED(job) j = job_run_well("orbit", "--help", NULL);
  /* the ids that the data of orbits.tsv finds broken */
  static const char *const violations[] = {"t_a", "gamma_v1", "h_v2", "c_v2", "c_w", "u_r1", "u_r2"};
  for (size_t i = 0; i < COUNT(violations); i++)
    ck_assert_msg(mentions(strstr(j.out, "violations"), violations[i]), "the help says nothing of %s", violations[i]);
  job_take(&j, job_run_well("--version", NULL));
  ck_assert(strncmp(j.out, "stickslip ", 10) == 0 && strchr(j.out, '\n') == j.out + strlen(j.out) - 1);
}
