/* Sessions at a shell: what commands say, how they end and which files they leave.  Those of one command, most of them
   refused, are in tests/hostile/messages.tsv (check_messages.c). */
#include "test.h"

TABLE(rows, "tests/cases/commands.tsv", 4);
enum { SHOWS, STATUS, LINE, SAYS }; /* its columns */

static int sessions(void) {
  int n = 0;
  for (int i = 0; i < rows.n; i++) n += *rows.row[i][SHOWS] != '\0';
  return n;
}

/* Where the n-th of them begins. */
static int session_row(int n) {
  int at = 0;
  while (!*rows.row[at][SHOWS] || n-- > 0) at++;
  return at;
}

static void try_line(char *const *row, const char *shows, const char *before) {
  int status = shell("exec > \"$D/.out\" 2> \"$D/.err\"\n%s%s", before, row[LINE]);
  FREED char *out = file_text(scratch_path(".out")), *err = file_text(scratch_path(".err"));
  const char *what = formatted("%s: %s", shows, row[LINE]);
  ck_assert_msg(status == atoi(row[STATUS]) && (status || !*err), "%.900s\nends with %d: %.800s%.800s", what, status,
                err, out);
  check_said(formatted("%s%s", out, err), row[SAYS], NULL, what);
}

CASE("commands", .each = {scratch_open, scratch_close}, .seconds = 300);

TEST_EACH(commands_do_as_they_say, sessions()) {
  LOCAL(text, before);
  int at = session_row(_i);
  const char *shows = rows.row[at][SHOWS];
  do {
    char *const *row = rows.row[at];
    if (strcmp(row[STATUS], "set") == 0)
      text_printf(&before, "%s\n", row[LINE]);
    else
      try_line(row, shows, text_str(&before));
  } while (++at < rows.n && !*rows.row[at][SHOWS]);
}
