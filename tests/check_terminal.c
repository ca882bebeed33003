/* What a person at a terminal meets: colours where they are wanted, tables, completion; and the documents that are
   typed from: every block of docs/ is read by the program. */
#include "record/result.h"
#include "test.h"
#include "whole.h"

static int count(const char *text, const char *part) {
  int n = 0;
  for (const char *p = strstr(text, part); p; p = strstr(p + 1, part)) n++;
  return n;
}

/* --- Colours and tables --- */

#define AUDIT "verify paper --only eq-14,eq-29,eq-52 --out \"$D/r\""

/* What the program prints on a terminal; settings: of the environment. */
static char *on_a_terminal(const char *settings, const char *words) {
  return shell_said("\"$Y\" tests/oracle/terminal.py %s -- \"$P\" %s", settings, words);
}

/* Where standard error is a terminal too, progress comes first, and wipes itself away. */
static const char *after_progress(const char *out) {
  const char *last = out;
  for (const char *p = strstr(out, "\033[K"); p; p = strstr(p + 1, "\033[K")) last = p + 3;
  return last;
}

static void wipe_colours(char *s) {
  char *to = s;
  while (*s)
    if (*s == '\033')
      s = strchr(s, 'm') + 1;
    else
      *to++ = *s++;
  *to = '\0';
}

CASE("terminal", .each = {scratch_open, scratch_close}, .seconds = 300);

/* Without its colours the text is the same, and the last line, the contract's, is all that is said quietly. */
TEST(colours_only_where_they_are_wanted) {
  static const struct {
    const char *settings;
    bool colours;
  } cases[] = {{"TERM=xterm NO_COLOR=", true},   {"TERM=xterm-256color NO_COLOR=", true},
               {"TERM=dumb NO_COLOR=", false},   {"TERM= NO_COLOR=", false},
               {"TERM=xterm NO_COLOR=1", false}, {"TERM=xterm NO_COLOR=0", false}};
  FREED char *plain = shell_said("TERM=xterm \"$P\" " AUDIT " 2>&1");
  ck_assert_msg(!strchr(plain, '\033') && !strchr(plain, '\r'), "%s", plain);
  const char *last = strstr(plain, "\npaper: 4 statements: ");
  ck_assert(last && strcmp(last + strlen(last) - 12, "as recorded\n") == 0 &&
            !strchr(strchr(last + 1, '\n') + 1, '\n'));
  for (size_t i = 0; i < COUNT(cases); i++) {
    FREED char *out = on_a_terminal(cases[i].settings, AUDIT);
    const char *said = after_progress(out);
    if (cases[i].colours)
      ck_assert_msg(strstr(said, "\033[1;31mrefuted\033[0m     eq-29 "), "%s: %s", cases[i].settings, said);
    ck_assert_int_eq(count(said, "\033[0m") * 2, count(said, "\033["));
    FREED char *without = ss_strdup(said);
    wipe_colours(without);
    ck_assert_msg(strcmp(cases[i].colours ? without : said, plain) == 0, "%s: %s", cases[i].settings, said);
  }
  FREED char *out = on_a_terminal("TERM=xterm NO_COLOR=1", AUDIT " --quiet");
  ck_assert_str_eq(out, last + 1);
}

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

CASE("whole", .once = {open_whole, close_whole});

/* verify --only shows what is wrong, what shows it and what mends it, in order of consequence (paper.roots), and where
   the report is; the numbers are those of the certificate in audit.json. */
TEST(what_fails_is_shown_worst_first) {
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
  FREED char *out = shell_said("\"$P\" verify --only eq-36b,eq-40,num-t_a --out \"$D/r\"");
  const char *at = out;
  for (size_t i = 0; i < COUNT(in_order); i++) {
    at = strstr(at, in_order[i]);
    ck_assert_msg(at != NULL, "%s, in\n%s", in_order[i], out);
  }
  const char *where = formatted("\nwritten to %s\npaper: ", scratch_path("r"));
  ck_assert_msg(strstr(at, where) != NULL, "%s", out);
  ck_assert(!strstr(whole, "certificate"));
  const char *first = strstr(whole, " eq-10 "), *later = strstr(whole, " eq-40 ");
  const char *last = strstr(whole, " text-time-name ");
  ck_assert_msg(first && later && last && first < later && later < last, "%s", whole);
}

CASE("terminal");

/* What explain marks is coloured like the verdicts of verify, and nothing else. */
TEST(explain_has_colours) {
  static const char command[] = "explain eq-29";
  FREED char *plain = shell_said("\"$P\" %s", command);
  for (int k = 0; k < 2; k++) {
    FREED char *out = on_a_terminal(k ? "TERM=xterm NO_COLOR=1" : "TERM=xterm NO_COLOR=", command);
    if (k) ck_assert_str_eq(out, plain);
    if (!k) ck_assert(strstr(out, "\nverdict     \033[1;31mrefuted\033[0m (on record"));
    if (!k) ck_assert(strstr(out, "\ndouble left  \033[1;31m") && strstr(out, "*\033[0m  1.0000000000000000\n"));
  }
  ck_assert(!strpbrk(plain, "\001\002\003\004\005\033"));
}

CASE("whole");

/* The counts of the table add up: down the columns to its last row, and along each row. */
TEST(the_table_adds_up) {
  int sum[8] = {0};
  FREED char *out = ss_strdup(whole);
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

CASE("terminal");

/* Tables that a person can read: every number says what it is, and columns stand under each other. */
TEST(orbits_and_motions_are_tables) {
  FREED char *out = shell_said("\"$P\" orbit paper --digits 30");
  const char *meaning = strstr(out, "position of m_1"), *begin = meaning;
  ck_assert(meaning != NULL);
  while (begin[-1] != '\n') begin--;
  long column = meaning - begin;
  static const char *const words[] = {"length of the global stick", "of the slip-stick",
                                      "tr J: ", "static friction of m_2"};
  for (size_t i = 0; i < COUNT(words); i++) {
    const char *at = strstr(out, words[i]), *from = at;
    ck_assert_msg(at != NULL, "%s", words[i]);
    while (from[-1] != '\n') from--;
    ck_assert_int_eq(at - from, column);
  }
  FREED char *motion = shell_said("\"$P\" simulate paper --at orbit:2");
  ck_assert(strstr(motion, "lengths in one unit") && strstr(motion, "\n          t mass change"));
}

/* Text less all that is blank. */
static void squeeze(char *s) {
  char *to = s;
  for (; *s; s++)
    if (!strchr(" \n", *s)) *to++ = *s;
  *to = '\0';
}

/* Lines that fit the terminal, with the same words: those that are wider elsewhere are broken at blanks. */
TEST(lines_fit_the_terminal) {
  enum { COMMAND, WIDTH, SAME };
  char *wide = NULL;
  OWNED(table) cases = table_read("tests/cases/terminal_lines.tsv", 3);
  for (int i = 0; i < cases.n; i++) {
    const char *command = cases.row[i][COMMAND];
    size_t width = (size_t)atoi(cases.row[i][WIDTH]), long_lines = 0;
    if (i == 0 || strcmp(command, cases.row[i - 1][COMMAND]) != 0) { /* else it is that of the row before */
      free(wide);
      wide = shell_said("\"$P\" %s", command);
    }
    const char *settings = formatted("NO_COLOR=1 COLUMNS=%zu", width);
    FREED char *out = on_a_terminal(settings, command);
    int lines = 0;
    ck_assert_msg(!strstr(out, " \n"), "%s: blanks at the end of a line", command);
    for (const char *p = out; *p; p += strcspn(p, "\n") + 1, lines++)
      ck_assert_msg(strcspn(p, "\n") <= width && *p != '\n', "%s: %.200s", command, p);
    ck_assert_int_gt(lines, 15);
    for (const char *p = wide; *p; p += strcspn(p, "\n") + 1) long_lines += strcspn(p, "\n") > width;
    ck_assert_msg(long_lines > 0 || width == 130, "%s: nothing to break", command);
    FREED char *words = ss_strdup(wide);
    squeeze(out);
    squeeze(words);
    if (*cases.row[i][SAME] == 'y') ck_assert_msg(strcmp(out, words) == 0, "%s: %s", command, out);
  }
  free(wide);
}

/* --- Scenes on file --- */

/* Who waits at a terminal is told how far a sweep is and how long it takes. */
TEST(a_sweep_tells_how_long) {
  FREED char *out =
      on_a_terminal("TERM=xterm", "sweep paper --jobs 1 --over e1=2:4:20 --over e2=0.5:3:100 --csv \"$D/rows\"");
  const char *first = strstr(out, "\r\033[K["), *left = strstr(out, " left\r\033[K");
  ck_assert_msg(first && left && left - first > 10, "%.300s", out);
}

/* So is who waits for other commands: by one total from the beginning to the end, never more than it, and nothing where
   standard error is no terminal. */
TEST(progress_has_one_total) {
  static const struct {
    const char *command, *elsewhere; /* the same with less to do, where it is no terminal; NULL: the very same */
  } cases[] = {{"mutate --count 2 --only 4-stability.eq --out $D/p", "mutate --count 2 --only title --out $D/p"},
               {"repair eq-10 eq-31 --out $D/p", "repair eq-10 --out $D/p"},
               {"stability lambda_2 Gamma --quick --out $D/p", "stability lambda_2 --quick --out $D/p"},
               {"bifurcate beside-wall --along V=0.99:1.01", "bifurcate paper --along e2=0.85:0.86"},
               {"orbit chain3", "orbit beside-wall"},
               {"simulate chain3", "simulate beside-wall"},
               {"verify --only eq-52,num-t_a --out $D/p", NULL}};
  for (size_t i = 0; i < COUNT(cases); i++) {
    const char *command = cases[i].command, *elsewhere = cases[i].elsewhere ? cases[i].elsewhere : command;
    int shown = 0;
    size_t done, of, last = 0, total = 0;
    FREED char *out = on_a_terminal("TERM=xterm", command);
    for (const char *p = out; (p = strstr(p, "\r\033[K[")) != NULL; p++, shown++) {
      ck_assert(sscanf(p, "\r\033[K[%zu/%zu]", &done, &of) == 2);
      ck_assert_msg(done <= of && done >= last && (of == total || !shown), "%s: %.40s", command, p + 4);
      last = done;
      total = of;
    }
    ck_assert_msg(shown > 0, "%s", command);
    shell_well("test -z \"$($P %s 2>&1 >/dev/null)\"", elsewhere);
  }
}

/* --- Completion --- */

/* What bash offers for the line, a word a line. */
static char *offered(const char *line) {
  scratch_put("try.bash", "source tools/completion.bash\n"
                          "COMP_LINE=$1 COMP_POINT=${#1} COMP_WORDBREAKS=$' \\t\\n=:'\n"
                          "read -ra COMP_WORDS <<< \"$1\"\n"
                          "[[ $1 == *' ' ]] && COMP_WORDS+=('')\n"
                          "COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n"
                          "_stickslip\n"
                          "printf '%s\\n' \"${COMPREPLY[@]}\"\n");
  return shell_said("bash $D/try.bash '%s %s' 2>&1", program(), line);
}

TEST(bash_completes) {
  enum { LINE, WORDS };
  OWNED(table) cases = table_read("tests/cases/completion.tsv", 2);
  if (!there_is("bash")) return;
  for (int i = 0; i < cases.n; i++) {
    FREED char *out = offered(cases.row[i][LINE]);
    ck_assert_msg(strcmp(out, cases.row[i][WORDS]) == 0, "%s: %s", cases.row[i][LINE], out);
  }
}

/* zsh and fish ask the same file as a command; where they are installed, they are tried. */
TEST(other_shells_complete) {
  static const struct {
    const char *line, *words;
  } cases[] = {{"orb", "orbit\n"}, {"orbit paper --set et", "eta=\n"}, {"verify --only eq-60", "eq-60\neq-60b\n"}};
  if (!there_is("bash")) return;
  scratch_put("try.zsh", "compadd() { while [[ $1 != -- ]]; do shift; done; shift; (( $# )) && print -l -- $@; }\n"
                         "words=(${(s: :)LINE}) CURRENT=$#words\nsource $D/c.zsh\n");
  for (int i = 0; i < 2; i++)
    shell_well("sed \"s|@COMPDIR@/stickslip|$PWD/tools/completion.bash|\" tools/completion.%s > $D/c.%s",
               i ? "fish" : "zsh", i ? "fish" : "zsh");
  for (size_t i = 0; i < COUNT(cases); i++) {
    scratch_put("words", cases[i].words);
    shell_well("bash tools/completion.bash $P %s 2>&1 | diff - $D/words", cases[i].line);
    if (there_is("zsh")) shell_well("LINE=\"$P %s\" zsh -f $D/try.zsh 2>&1 | diff - $D/words", cases[i].line);
    if (there_is("fish"))
      shell_well("PATH=$(realpath $(dirname $P)):$PATH "
                 "fish --no-config -c \"source $D/c.fish; complete -C 'stickslip %s'\" 2>&1 | diff - $D/words",
                 cases[i].line);
  }
}

/* Every option that is offered belongs to its command. */
TEST(what_is_offered_is_known) {
  if (!there_is("bash")) return;
  FREED char *commands = offered("");
  int tried = 0;
  char *end_of_commands = NULL;
  for (char *c = strtok_r(commands, "\n", &end_of_commands); c; c = strtok_r(NULL, "\n", &end_of_commands)) {
    char *end = NULL;
    if (c[0] == '-') continue;
    const char *line = formatted("%.40s --", c);
    FREED char *options = offered(line);
    for (char *o = strtok_r(options, "\n", &end); o; o = strtok_r(NULL, "\n", &end), tried++) {
      FREED char *said = shell_said("$P %s %s=x=y --no-such 2>&1 >/dev/null; test $? = 2", c, o);
      ck_assert_msg(!strstr(said, "belong") && (strstr(said, o) == NULL || strstr(said, "takes no value")), "%s %s: %s",
                    c, o, said);
    }
  }
  ck_assert_int_gt(tried, 40);
}

/* --- Documents --- */

/* The blocks of a document that begin with ``` and a kind of file, less their indentation. */
static int check_blocks(const char *path, int *refused) {
  char line[2000], kind[20] = "", mode[20] = "";
  LOCAL(text, body);
  FILE *f = fopen(path, "r");
  int n = 0;
  ck_assert_msg(f != NULL, "%s", path);
  size_t indent = 0;
  while (fgets(line, sizeof line, f)) {
    const char *mark = strstr(line, "```");
    if (mark && !*kind) {
      mode[0] = '\0';
      indent = (size_t)(mark - line);
      text_reset(&body);
      ck_assert_msg(sscanf(mark + 3, "%19[a-z] %19[a-z]", kind, mode) >= 1, "%s: a block of no kind", path);
    } else if (mark) {
      bool wrong = strcmp(mode, "refused") == 0;
      shell_ends(wrong ? 3 : 0, "", "$P check %s", scratch_put(formatted("block.%s", kind), text_str(&body)));
      *refused += wrong;
      kind[0] = '\0';
      n++;
    } else if (*kind) {
      text_add(&body, line + (strlen(line) > indent ? indent : 0));
    }
  }
  fclose(f);
  return n;
}

TEST(documents_hold_what_the_program_reads) {
  int refused = 0;
  ck_assert_int_ge(check_blocks("docs/language.md", &refused), 7);
  ck_assert_int_ge(refused, 4);
  ck_assert_int_ge(check_blocks("docs/scenes.md", &refused), 7);
  ck_assert_int_ge(check_blocks("docs/another-paper.md", &refused), 1);
}
