/* What a person at a terminal meets: colours where they are wanted, tables, completion; and the documents that are
   typed from: every block of docs/ is read by the program, and the paper of two equations there is audited. */
#include <check.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/text.h"
#include "record/result.h"
#include "scratch.h"
#include "suites.h"
#include "table.h"
#include "whole.h"

static int count(const char *text, const char *part) {
  int n = 0;
  for (const char *p = strstr(text, part); p; p = strstr(p + 1, part)) n++;
  return n;
}

/* --- Colours and tables --- */

static const char audit_args[] = "verify paper --only eq-14,eq-29,eq-52 --out";

static char *on_a_terminal(const char *settings, const char *more) {
  int status;
  char *out = shell_output(&status, "%s tests/oracle/terminal.py %s -- %s %s %s %s", python(), settings, program(),
                           audit_args, scratch_path("r"), more);
  ck_assert_int_eq(status, 0);
  return out;
}

/* Where standard error is a terminal too, progress comes first, and wipes itself away. */
static const char *after_progress(const char *out) {
  const char *last = out;
  for (const char *p = strstr(out, "\033[K"); p; p = strstr(p + 1, "\033[K")) last = p + 3;
  return last;
}

START_TEST(colours_only_where_they_are_wanted) {
  static const struct {
    const char *settings;
    bool colours;
  } cases[] = {{"TERM=xterm NO_COLOR=", true},   {"TERM=xterm-256color NO_COLOR=", true},
               {"TERM=dumb NO_COLOR=", false},   {"TERM= NO_COLOR=", false},
               {"TERM=xterm NO_COLOR=1", false}, {"TERM=xterm NO_COLOR=0", false}};
  int status;
  char *plain = shell_output(&status, "TERM=xterm %s %s %s 2>&1", program(), audit_args, scratch_path("r"));
  ck_assert_int_eq(status, 0);
  ck_assert_msg(!strchr(plain, '\033') && !strchr(plain, '\r'), "%s", plain);
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char *out = on_a_terminal(cases[i].settings, "");
    const char *said = after_progress(out);
    if (cases[i].colours)
      ck_assert_msg(strstr(said, "\033[1;31mrefuted\033[0m     eq-29 "), "%s: %s", cases[i].settings, said);
    else
      ck_assert_msg(strcmp(said, plain) == 0, "%s: %s", cases[i].settings, said);
    ck_assert_int_eq(count(said, "\033[0m") * 2, count(said, "\033["));
    free(out);
  }
  free(plain);
}
END_TEST

/* Without its colours the text is the same, and the last line is the contract's. */
START_TEST(colours_change_no_character) {
  int status;
  char *plain = shell_output(&status, "%s %s %s", program(), audit_args, scratch_path("r"));
  char *out = on_a_terminal("TERM=xterm NO_COLOR=", ""), *to = out;
  for (const char *p = after_progress(out); *p;) {
    if (*p == '\033')
      p = strchr(p, 'm') + 1;
    else
      *to++ = *p++;
  }
  *to = '\0';
  ck_assert_str_eq(out, plain);
  const char *last = strstr(plain, "\npaper: 4 statements: ");
  ck_assert(last && strcmp(last + strlen(last) - 12, "as recorded\n") == 0 &&
            !strchr(strchr(last + 1, '\n') + 1, '\n'));
  free(out);
  out = on_a_terminal("TERM=xterm NO_COLOR=1", "--quiet");
  ck_assert_str_eq(out, last + 1);
  free(out);
  free(plain);
}
END_TEST

/* What verify says of the whole paper, which two cases read. */
static char *whole;

static void open_whole(void) {
  scratch_open();
  whole_open();
  whole = file_text(scratch_path("whole/said"));
}

static void close_whole(void) {
  free(whole);
  scratch_close();
}

/* verify --only shows what is wrong, what shows it and what mends it, in order of consequence (paper.roots), and where the
   report is; the numbers are those of the certificate in audit.json. */
START_TEST(what_fails_is_shown_worst_first) {
  static const char *const in_order[] = {"refuted     num-t_a t_a = 0.6784",
                                         "printed = 0.6784, unit = 1/10000",
                                         "correction  t_a = 0.5323 (proved)\n",
                                         "conditional eq-40   J_f is",
                                         "\n                    holds when  V = 1\n",
                                         "entry = [1,3], left = 2.212298604, right = 0.1382686627\n",
                                         "correction  ktilde_4 := V*sin(omega*t_d)/(omega*(z_200 - z_100)) (proved)\n",
                                         "refuted     eq-36b  the indices",
                                         "wrong       a slip of notation",
                                         "\nsection "};
  int status;
  char *out = shell_output(&status, "%s verify --only eq-36b,eq-40,num-t_a --out %s", program(), scratch_path("r"));
  const char *at = out;
  ck_assert_int_eq(status, 0);
  for (size_t i = 0; i < sizeof in_order / sizeof *in_order; i++) {
    at = strstr(at, in_order[i]);
    ck_assert_msg(at != NULL, "%s, in\n%s", in_order[i], out);
  }
  char where[300];
  snprintf(where, sizeof where, "\nwritten to %s\npaper: ", scratch_path("r"));
  ck_assert_msg(strstr(at, where) != NULL, "%s", out);
  free(out);
  ck_assert(!strstr(whole, "certificate"));
  const char *first = strstr(whole, " eq-10 "), *later = strstr(whole, " eq-40 ");
  const char *last = strstr(whole, " text-time-name ");
  ck_assert_msg(first && later && last && first < later && later < last, "%s", whole);
}
END_TEST

/* What writes says where, last; but where its output is JSON. */
START_TEST(where_it_is_written_is_said) {
  static const struct {
    const char *command, *to;
  } cases[] = {{"orbit paper --certificate", "c.json"},      {"sweep paper --over e2=0.8:0.9:5 --csv", "rows.csv"},
               {"mutate --count 3 --only title --out", "m"}, {"stability lambda_2 --quick --out", "s"},
               {"bench --job map --quick --inputs", "b"},    {"repair eq-36b --out", "p"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    int status;
    char want[300];
    snprintf(want, sizeof want, "written to %s\n", scratch_path(cases[i].to));
    char *out = shell_output(&status, "%s %s %s 2>/dev/null", program(), cases[i].command, scratch_path(cases[i].to));
    size_t n = strlen(out), m = strlen(want);
    ck_assert_msg(status == 0 && n >= m && strcmp(out + n - m, want) == 0, "%s: %d, %s", cases[i].command, status, out);
    free(out);
  }
  int status;
  char *out = shell_output(&status, "%s repair eq-36b --json --out %s", program(), scratch_path("p"));
  ck_assert(status == 0 && *out == '{' && !strstr(out, "written to"));
  free(out);
}
END_TEST

/* What explain marks is coloured like the verdicts of verify, and nothing else. */
START_TEST(explain_has_colours) {
  static const char command[] = "explain eq-29";
  int status;
  char *plain = shell_output(&status, "%s %s", program(), command);
  for (int k = 0; k < 2; k++) {
    char *out = shell_output(&status, "%s tests/oracle/terminal.py TERM=xterm NO_COLOR=%s -- %s %s", python(),
                             k ? "1" : "", program(), command);
    ck_assert_int_eq(status, 0);
    if (k) ck_assert_str_eq(out, plain);
    if (!k) ck_assert(strstr(out, "\nverdict     \033[1;31mrefuted\033[0m (on record"));
    if (!k) ck_assert(strstr(out, "\ndouble left  \033[1;31m") && strstr(out, "*\033[0m  1.0000000000000000\n"));
    free(out);
  }
  ck_assert(!strpbrk(plain, "\001\002\003\004\005\033"));
  free(plain);
}
END_TEST

/* The counts of the table add up: down the columns to its last row, and along each row. */
START_TEST(the_table_adds_up) {
  int sum[8] = {0};
  char *out = ss_strdup(whole);
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
  free(out);
}
END_TEST

/* Tables that a person can read: every number says what it is, and columns stand under each other. */
START_TEST(orbits_and_motions_are_tables) {
  int status;
  char *out = shell_output(&status, "%s orbit paper --digits 30", program());
  const char *meaning = strstr(out, "position of m_1"), *begin = meaning;
  ck_assert_int_eq(status, 0);
  ck_assert(meaning != NULL);
  while (begin[-1] != '\n') begin--;
  long column = meaning - begin;
  static const char *const words[] = {"length of the global stick", "of the slip-stick",
                                      "tr J: ", "static friction of m_2"};
  for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
    const char *at = strstr(out, words[i]), *from = at;
    ck_assert_msg(at != NULL, "%s", words[i]);
    while (from[-1] != '\n') from--;
    ck_assert_int_eq(at - from, column);
  }
  free(out);
  out = shell_output(&status, "%s simulate paper --at orbit:2", program());
  ck_assert(status == 0 && strstr(out, "lengths in one unit") && strstr(out, "\n          t mass change"));
  free(out);
}
END_TEST

/* Text less all that is blank. */
static void squeeze(char *s) {
  char *to = s;
  for (; *s; s++)
    if (!strchr(" \n", *s)) *to++ = *s;
  *to = '\0';
}

/* Lines that fit the terminal, with the same words: those that are wider elsewhere are broken at blanks. */
START_TEST(lines_fit_the_terminal) {
  enum { COMMAND, WIDTH, SAME };
  struct table cases;
  table_read(&cases, "tests/cases/terminal_lines.tsv", 3);
  for (int i = 0; i < cases.n; i++) {
    int status;
    char *wide = shell_output(&status, "%s %s", program(), cases.row[i][COMMAND]);
    ck_assert_int_eq(status, 0);
    char *out = shell_output(&status, "%s tests/oracle/terminal.py NO_COLOR=1 COLUMNS=%d -- %s %s 2>&1", python(),
                             atoi(cases.row[i][WIDTH]), program(), cases.row[i][COMMAND]);
    ck_assert_int_eq(status, 0);
    int lines = 0;
    ck_assert_msg(!strstr(out, " \n"), "%s: blanks at the end of a line", cases.row[i][COMMAND]);
    for (const char *p = out; *p; p += strcspn(p, "\n") + 1, lines++)
      ck_assert_msg(strcspn(p, "\n") <= (size_t)atoi(cases.row[i][WIDTH]) && *p != '\n', "%s: %.200s",
                    cases.row[i][COMMAND], p);
    ck_assert_int_gt(lines, 15);
    size_t long_lines = 0;
    for (const char *p = wide; *p; p += strcspn(p, "\n") + 1)
      long_lines += strcspn(p, "\n") > (size_t)atoi(cases.row[i][WIDTH]);
    ck_assert_msg(long_lines > 0 || atoi(cases.row[i][WIDTH]) == 130, "%s: nothing to break", cases.row[i][COMMAND]);
    squeeze(out);
    squeeze(wide);
    if (*cases.row[i][SAME] == 'y') ck_assert_msg(strcmp(out, wide) == 0, "%s: %s", cases.row[i][COMMAND], out);
    free(out);
    free(wide);
  }
  table_clear(&cases);
}
END_TEST

/* --- Scenes on file --- */

/* Who waits at a terminal is told how far a sweep is and how long it takes. */
START_TEST(a_sweep_tells_how_long) {
  int status;
  char *out = shell_output(&status,
                           "%s tests/oracle/terminal.py TERM=xterm -- %s sweep paper --jobs 1 --over e1=2:4:20 --over "
                           "e2=0.5:3:100 --csv %s",
                           python(), program(), scratch_path("rows"));
  ck_assert_int_eq(status, 0);
  const char *first = strstr(out, "\r\033[K["), *left = strstr(out, " left\r\033[K");
  ck_assert_msg(first && left && left - first > 10, "%.300s", out);
  free(out);
}
END_TEST

/* So is who waits for other commands: by one total from the beginning to the end, never more than it, and nothing where
   standard error is no terminal. */
START_TEST(progress_has_one_total) {
  static const struct {
    const char *command, *elsewhere; /* the same with less to do, where it is no terminal; NULL: the very same */
  } cases[] = {{"mutate --count 2 --only 4-stability.eq --out", "mutate --count 2 --only title --out"},
               {"repair eq-10 eq-31 --out", "repair eq-10 --out"},
               {"stability lambda_2 Gamma --quick --out", "stability lambda_2 --quick --out"},
               {"bifurcate beside-wall --along V=0.99:1.01", "bifurcate paper --along e2=0.85:0.86"},
               {"verify --only eq-52,num-t_a --out", NULL}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    const char *command = cases[i].command, *elsewhere = cases[i].elsewhere ? cases[i].elsewhere : command;
    const char *to = strstr(command, "--out") ? scratch_path("p") : "";
    int status, shown = 0;
    size_t done, of, last = 0, total = 0;
    char *out =
        shell_output(&status, "%s tests/oracle/terminal.py TERM=xterm -- %s %s %s", python(), program(), command, to);
    ck_assert_int_eq(status, 0);
    for (const char *p = out; (p = strstr(p, "\r\033[K[")) != NULL; p++, shown++) {
      ck_assert(sscanf(p, "\r\033[K[%zu/%zu]", &done, &of) == 2);
      ck_assert_msg(done <= of && done >= last && (of == total || !shown), "%s: %.40s", command, p + 4);
      last = done;
      total = of;
    }
    ck_assert_msg(shown > 0, "%s", command);
    free(out);
    out = shell_output(&status, "%s %s %s 2>&1 >/dev/null", program(), elsewhere, to);
    ck_assert_msg(status == 0 && !*out, "%s: %s", elsewhere, out);
    free(out);
  }
}
END_TEST

START_TEST(scenes_are_listed) {
  int status;
  char *out = shell_output(&status, "%s list scenes", program());
  ck_assert(status == 0 && strncmp(out, "above-one ", 10) == 0);
  ck_assert(strstr(out, "\npaper              the paper's numerical example\n"));
  free(out);
  out = shell_output(&status, "ls verify/scenes/*.scene | wc -l; %s list scenes | wc -l", program());
  int files = -1, lines = -2;
  ck_assert(sscanf(out, "%d %d", &files, &lines) == 2 && files == lines);
  free(out);
  out = shell_output(&status, "STICKSLIP_DATA=%s %s list scenes 2>&1", scratch_path(""), program());
  ck_assert(status == 3 && strstr(out, "scenes: error: "));
  free(out);
  out = shell_output(
      &status, "mkdir %s; echo 'chi = 2' > %s; cp verify/scenes/stable.scene %s; STICKSLIP_DATA=%s %s list scenes 2>&1",
      scratch_path("scenes"), scratch_path("scenes/broken.scene"), scratch_path("scenes"), scratch_path(""), program());
  ck_assert_msg(status == 3 && strstr(out, "broken.scene: error: ") && strstr(out, "stable  "), "%s", out);
  free(out);
}
END_TEST

/* --- Completion --- */

/* What bash offers for the line, a word a line. */
static char *offered(const char *line) {
  int status;
  scratch_put("try.bash", "source tools/completion.bash\n"
                          "COMP_LINE=$1 COMP_POINT=${#1} COMP_WORDBREAKS=$' \\t\\n=:'\n"
                          "read -ra COMP_WORDS <<< \"$1\"\n"
                          "[[ $1 == *' ' ]] && COMP_WORDS+=('')\n"
                          "COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n"
                          "_stickslip\n"
                          "printf '%s\\n' \"${COMPREPLY[@]}\"\n");
  char *out = shell_output(&status, "bash %s '%s %s' 2>&1", scratch_path("try.bash"), program(), line);
  ck_assert_int_eq(status, 0);
  return out;
}

START_TEST(bash_completes) {
  enum { LINE, WORDS };
  struct table cases;
  table_read(&cases, "tests/cases/completion.tsv", 2);
  if (system("command -v bash >/dev/null") != 0) return;
  for (int i = 0; i < cases.n; i++) {
    char *out = offered(cases.row[i][LINE]);
    ck_assert_msg(strcmp(out, cases.row[i][WORDS]) == 0, "%s: %s", cases.row[i][LINE], out);
    free(out);
  }
  table_clear(&cases);
}
END_TEST

/* zsh and fish ask the same file as a command; where they are installed, they are tried. */
START_TEST(other_shells_complete) {
  static const struct {
    const char *line, *words;
  } cases[] = {{"orb", "orbit\n"}, {"orbit paper --set et", "eta=\n"}, {"verify --only eq-60", "eq-60\neq-60b\n"}};
  static const char in_zsh[] =
      "compadd() { while [[ $1 != -- ]]; do shift; done; shift; (( $# )) && print -l -- $@; }\n"
      "words=(${(s: :)LINE}) CURRENT=$#words\nsource $SCRIPT\n";
  if (system("command -v bash >/dev/null") != 0) return;
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    int status;
    char *out = shell_output(&status, "bash tools/completion.bash %s %s 2>&1", program(), cases[i].line);
    ck_assert_msg(strcmp(out, cases[i].words) == 0, "%s: %s", cases[i].line, out);
    free(out);
    if (system("command -v zsh >/dev/null") == 0) {
      out = shell_output(&status,
                         "sed \"s|@COMPDIR@/stickslip|$PWD/tools/completion.bash|\" tools/completion.zsh >%s; "
                         "LINE='%s %s' SCRIPT=%s zsh -f %s 2>&1",
                         scratch_path("c.zsh"), program(), cases[i].line, scratch_path("c.zsh"),
                         scratch_put("try.zsh", in_zsh));
      ck_assert_msg(strcmp(out, cases[i].words) == 0, "zsh, %s: %s", cases[i].line, out);
      free(out);
    }
    if (system("command -v fish >/dev/null") == 0) {
      out = shell_output(
          &status,
          "sed \"s|@COMPDIR@/stickslip|$PWD/tools/completion.bash|\" tools/completion.fish >%s; "
          "PATH=$(realpath $(dirname %s)):$PATH fish --no-config -c 'source %s; complete -C \"stickslip %s\"' 2>&1",
          scratch_path("c.fish"), program(), scratch_path("c.fish"), cases[i].line);
      ck_assert_msg(strcmp(out, cases[i].words) == 0, "fish, %s: %s", cases[i].line, out);
      free(out);
    }
  }
}
END_TEST

/* Every option that is offered belongs to its command. */
START_TEST(what_is_offered_is_known) {
  if (system("command -v bash >/dev/null") != 0) return;
  char *commands = offered("");
  int tried = 0;
  char *end_of_commands = NULL;
  for (char *c = strtok_r(commands, "\n", &end_of_commands); c; c = strtok_r(NULL, "\n", &end_of_commands)) {
    char line[64], *end = NULL;
    if (c[0] == '-') continue;
    snprintf(line, sizeof line, "%.40s --", c);
    char *options = offered(line);
    for (char *o = strtok_r(options, "\n", &end); o; o = strtok_r(NULL, "\n", &end), tried++) {
      int status;
      char *said = shell_output(&status, "%s %s %s=x=y --no-such 2>&1 >/dev/null", program(), c, o);
      ck_assert_msg(status == 2 && !strstr(said, "belong") &&
                        (strstr(said, o) == NULL || strstr(said, "takes no value")),
                    "%s %s: %s", c, o, said);
      free(said);
    }
    free(options);
  }
  ck_assert_int_gt(tried, 40);
  free(commands);
}
END_TEST

/* --- Documents --- */

/* The blocks of a document that begin with ``` and a kind of file, less their indentation. */
static int check_blocks(const char *path, int *refused) {
  char line[2000], kind[20] = "", mode[20] = "";
  struct text body;
  FILE *f = fopen(path, "r");
  int n = 0;
  ck_assert_msg(f != NULL, "%s", path);
  text_init(&body);
  size_t indent = 0;
  while (fgets(line, sizeof line, f)) {
    const char *mark = strstr(line, "```");
    if (mark && !*kind) {
      mode[0] = '\0';
      indent = (size_t)(mark - line);
      text_reset(&body);
      ck_assert_msg(sscanf(mark + 3, "%19[a-z] %19[a-z]", kind, mode) >= 1, "%s: a block of no kind", path);
    } else if (mark) {
      char name[40];
      int status;
      bool wrong = strcmp(mode, "refused") == 0;
      snprintf(name, sizeof name, "block.%s", kind);
      char *said = shell_output(&status, "%s check %s 2>&1", program(), scratch_put(name, text_str(&body)));
      ck_assert_msg(status == (wrong ? 3 : 0), "%s: %s\n%s", path, text_str(&body), said);
      free(said);
      *refused += wrong;
      kind[0] = '\0';
      n++;
    } else if (*kind) {
      text_add(&body, line + (strlen(line) > indent ? indent : 0));
    }
  }
  fclose(f);
  text_clear(&body);
  return n;
}

START_TEST(documents_hold_what_the_program_reads) {
  int refused = 0;
  ck_assert_int_ge(check_blocks("docs/language.md", &refused), 7);
  ck_assert_int_ge(refused, 4);
  ck_assert_int_ge(check_blocks("docs/scenes.md", &refused), 7);
  ck_assert_int_ge(check_blocks("docs/another-paper.md", &refused), 1);
}
END_TEST

/* A paper of two equations, of which the first is right (the propagator of a mass that keeps its velocity) and the
   second is wrong (a triangular matrix with ones on its diagonal has the determinant 1). */
START_TEST(another_paper_is_audited) {
  int status;
  char *out =
      shell_output(&status, "STICKSLIP_DATA=tests/another %s verify --out %s 2>&1", program(), scratch_path("another"));
  ck_assert_msg(status == 0 && strstr(out, "refuted     eq-2 "), "%s", out);
  ck_assert_msg(strstr(out, "\npaper: 2 statements: 1 proved, 1 refuted; 4 of 4 controls noticed; as recorded\n"), "%s",
                out);
  free(out);
  out = shell_output(&status, "grep -c 'replaced by\\|det(D(t)) = 1\"' %s/audit.json", scratch_path("another"));
  ck_assert_int_eq(atoi(out), 1); /* the correction */
  free(out);
  /* the page says whose paper it is, and without its title of none */
  out = shell_output(&status, "grep -o '<h1>.*</h1>' %s/index.html", scratch_path("another"));
  ck_assert_str_eq(out, "<h1>Audit of a paper: <cite>A note on two equations of the oscillator</cite></h1>\n");
  free(out);
  /* the same folder with its second equation right: the verdict is not the recorded one */
  out = shell_output(
      &status,
      "cp -R tests/another/paper %s && sed -i 's/= 1 + t$/= 1/; /^paper:/d' %s/note.eq && STICKSLIP_DATA=tests/another "
      "%s verify --paper %s --out %s",
      scratch_path("paper"), scratch_path("paper"), program(), scratch_path("paper"), scratch_path("another"));
  ck_assert_msg(status == 1 && strstr(out, "eq-2: proved, recorded as refuted\n"), "%s", out);
  free(out);
  out = shell_output(&status, "grep -o '<h1>.*</h1>' %s/index.html", scratch_path("another"));
  ck_assert_str_eq(out, "<h1>Audit of a paper</h1>\n");
  free(out);
}
END_TEST

/* Every command of docs/ and of README's quick start is typed, and ends as they say. */
START_TEST(documents_show_what_happens) {
  int status;
  char *out =
      shell_output(&status, "%s tests/oracle/documents.py %s %s-checker 'README.md@More to look at' docs/*.md 2>&1",
                   python(), program(), program());
  ck_assert_msg(status == 0, "%s", out);
  ck_assert_int_ge(atoi(out), 20);
  free(out);
}
END_TEST

START_TEST(man_pages_are_sound) {
  int status;
  if (system("command -v mandoc >/dev/null") != 0) return;
  char *out = shell_output(&status, "mandoc -Tlint -Wwarning man/*.[135]");
  ck_assert_msg(status == 0 && !*out, "%s", out);
  free(out);
}
END_TEST

/* What it says of commands and options is what the program says. */
START_TEST(the_man_page_is_made_from_the_table) {
  int status;
  char *out = shell_output(&status, "%s tools/manual.py %s --check", python(), program());
  ck_assert_msg(status == 0, "%s", out);
  free(out);
}
END_TEST

/* Those of the library are made from its headers, and groff has nothing to say against them. */
START_TEST(the_pages_of_the_library_are_made_from_the_headers) {
  int status;
  char *out = shell_output(&status, "%s tools/headers.py --check", python());
  ck_assert_msg(status == 0, "%s", out);
  free(out);
  if (shell("command -v groff > /dev/null") != 0) return;
  out = shell_output(&status, "for page in man/*.3; do groff -mandoc -Tutf8 -ww -z $page 2>&1; done");
  ck_assert_msg(status == 0 && !*out, "%s", out);
  free(out);
}
END_TEST

START_TEST(every_kind_of_claim_is_in_the_manual) {
  int status;
  char *out = shell_output(
      &status,
      "for k in $(%s list | awk '{ print $2 }' | sort -u); do grep -qw -e \"$k\" man/stickslip-eq.5 || echo "
      "$k; done",
      program());
  ck_assert_msg(!*out, "%s", out);
  free(out);
}
END_TEST

Suite *terminal_suite(void) {
  Suite *s = suite_create("terminal");
  TCase *c = tcase_create("terminal");
  tcase_add_checked_fixture(c, scratch_open, scratch_close);
  tcase_set_timeout(c, 300);
  tcase_add_test(c, colours_only_where_they_are_wanted);
  tcase_add_test(c, colours_change_no_character);
  tcase_add_test(c, explain_has_colours);
  tcase_add_test(c, where_it_is_written_is_said);
  tcase_add_test(c, orbits_and_motions_are_tables);
  tcase_add_test(c, lines_fit_the_terminal);
  tcase_add_test(c, a_sweep_tells_how_long);
  tcase_add_test(c, progress_has_one_total);
  tcase_add_test(c, scenes_are_listed);
  tcase_add_test(c, bash_completes);
  tcase_add_test(c, what_is_offered_is_known);
  tcase_add_test(c, other_shells_complete);
  tcase_add_test(c, documents_hold_what_the_program_reads);
  tcase_add_test(c, documents_show_what_happens);
  tcase_add_test(c, another_paper_is_audited);
  tcase_add_test(c, man_pages_are_sound);
  tcase_add_test(c, the_man_page_is_made_from_the_table);
  tcase_add_test(c, the_pages_of_the_library_are_made_from_the_headers);
  tcase_add_test(c, every_kind_of_claim_is_in_the_manual);
  suite_add_tcase(s, c);
  c = tcase_create("whole");
  tcase_add_unchecked_fixture(c, open_whole, close_whole);
  tcase_add_test(c, what_fails_is_shown_worst_first);
  tcase_add_test(c, the_table_adds_up);
  suite_add_tcase(s, c);
  return s;
}
