/* The program as its users meet it: what verify writes of the whole paper.  What other commands print is in
   check_commands.c and tests/oracle/said.py. */
#include <unistd.h>

#include "command.h"
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

/* The counts of the table add up: down the columns to its last row, and along each row. */
TEST(the_table_adds_up) {
  int sum[8] = {0};
  FREED char *out = ss_strdup(full_out);
  char *line = strstr(out, "\nsection");
  ck_assert(line != NULL);
  line = strtok(strchr(line + 1, '\n'), "\n");
  for (; line; line = strtok(NULL, "\n")) {
    char name[40], cell[8][8];
    int n = sscanf(line, "%39s %7s %7s %7s %7s %7s %7s %7s", name, cell[0], cell[1], cell[2], cell[3], cell[4], cell[5],
                   cell[6]) -
            1;
    int along = 0;
    ck_assert_msg(n == 7, "%s", line);
    for (int i = 0; i + 1 < n; i++) along += atoi(cell[i]);
    ck_assert_msg(along == atoi(cell[n - 1]), "%s", line);
    bool all = strcmp(name, "all") == 0;
    for (int i = 0; i < n; i++) {
      if (all)
        ck_assert_msg(sum[i] == atoi(cell[i]), "%s: column %d is %d", line, i, sum[i]);
      else
        sum[i] += atoi(cell[i]);
    }
    if (all) break;
  }
  ck_assert(line && sum[0] > 0 && sum[6] > 100);
}

/* What fails stands in order of consequence, and what shows it only where claims are selected. */
TEST(what_fails_is_said_worst_first) {
  const char *first = strstr(full_out, " eq-10 "), *later = strstr(full_out, " eq-40 ");
  const char *last = strstr(full_out, " text-time-name ");
  ck_assert_msg(first && later && last && first < later && later < last, "%s", full_out);
  ck_assert(!strstr(full_out, "certificate"));
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
