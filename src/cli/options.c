/* The words of a command line, by the rows of options.def. */
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli.h"

int usage(const char *fmt, ...) {
  struct diag d = {0};
  OWNED(text) says = {0};
  va_list ap;
  va_start(ap, fmt);
  text_vprintf(&says, fmt, ap);
  diag_set(&d, "%s", text_str(&says));
  fprintf(stderr, "stickslip: %s; see stickslip --help\n", d.message);
  va_end(ap);
  return EXIT_USAGE;
}

int usage_unknown(const char *fmt, const struct suggestion *s) {
  OWNED(text) what = {0};
  text_printf(&what, "%.*s", (int)(s->len < 200 ? s->len : 200), s->word);
  suggest_print(&what, s);
  return usage(fmt, text_str(&what));
}

void say_written(const struct options *o, const char *where) {
  if (!option(o, OPT_JSON)) printf("written to %s\n", where);
}

int bad_input(const struct diag *d) {
  fprintf(stderr, "%s%s\n", strncmp(d->message, "error:", 6) == 0 ? "stickslip: " : "", d->message);
  return EXIT_INPUT;
}

const struct option_row option_table[] = {
#define OPTION(id, name, commands, value, kind, text) {OPT_##id, name, commands, value, kind, text},
#define ALSO                                          OPTION
#include "cli/options.def"
};
const int n_option_rows = sizeof option_table / sizeof *option_table;

bool option_belongs(const struct option_row *row, const char *command) {
  return row->commands[0] == '*' || list_has(row->commands, command);
}

const char *option(const struct options *o, enum option id) {
  return o->given[id].word[0];
}

const char *option_name(enum option id) {
  const struct option_row *row = option_table;
  while (row->id != id) row++;
  return row->name;
}

static bool add_word(struct words *w, const char *word, int most) {
  if (w->n == most) return false;
  w->word[w->n++] = word;
  return true;
}

/* Splits the list in place; it lives in argv. */
static bool add_list(struct words *w, char *list) {
  size_t len = strlen(list);
  if (list[0] == ',' || list[len - 1] == ',' || strstr(list, ",,")) return false;
  for (char *p = strtok(list, ","); p; p = strtok(NULL, ","))
    if (!add_word(w, p, MAX_WORDS)) return false;
  return w->n > 0;
}

static int add_value(struct words *w, const struct option_row *row, char *value) {
  switch (row->kind) {
  case KIND_LIST:
    if (!add_list(w, value)) return usage("%s takes 1 to %d names, not %.200s", row->name, MAX_WORDS, value);
    break;
  case KIND_TWICE:
    if (!add_word(w, value, MAX_OVER)) return usage("at most two --over, not %.200s too", value);
    break;
  case KIND_SETTINGS:
    if (!strchr(value, '=')) return usage("--set takes NAME=VALUE, as in e2=1/2, not %.200s", value);
    if (!add_word(w, value, MAX_SET)) return usage("at most %d --set, not %.200s too", MAX_SET, value);
    break;
  case KIND_FLAG:
  case KIND_TEXT:
    if (!add_word(w, value, 1)) return usage("the option %s is given twice", row->name);
  }
  return EXIT_AS_RECORDED;
}

/* The row of the option that len bytes of the word name, -h for --help; NULL after a message. */
static const struct option_row *find_option(const char *command, const char *word, size_t len) {
  if (strcmp(word, "-h") == 0) return find_option(command, "--help", strlen("--help"));
  bool known = false; /* as an option of other commands */
  struct suggestion meant;
  suggest_begin(&meant, word, len);
  for (int k = 0; k < n_option_rows; k++) {
    const struct option_row *row = &option_table[k];
    bool same = word_is(word, len, row->name), mine = option_belongs(row, command);
    if (same && mine) return row;
    known |= same;
    if (mine) suggest_try(&meant, row->name);
  }
  if (known)
    usage("the option %.200s does not belong to this command", word);
  else
    usage_unknown("unknown option %s", &meant);
  return NULL;
}

int parse_options(struct options *o, const char *command, int argc, char **argv) {
  *o = (struct options){.operands.n = 0};
  int status = EXIT_AS_RECORDED;
  for (int i = 0; i < argc; i++) /* outputs show them, and commands to type */
    if (text_plain_prefix(argv[i], strlen(argv[i]), false) < strlen(argv[i]))
      return usage("a control character in %.200s, or it is not UTF-8 text", argv[i]);
  for (int i = 0; i < argc && !status; i++) {
    char *arg = argv[i];
    if (arg[0] != '-' || arg[1] == '\0') {
      if (!add_word(&o->operands, arg, MAX_OPERANDS)) return usage("too many operands, at %.200s", arg);
      continue;
    }
    char *equals = strchr(arg, '=');
    const struct option_row *row = find_option(command, arg, equals ? (size_t)(equals - arg) : strlen(arg));
    if (!row) return EXIT_USAGE;
    bool flag = row->kind == KIND_FLAG;
    if (flag && equals) return usage("the option %.200s takes no value", row->name);
    char *value = flag ? arg : equals ? equals + 1 : i + 1 < argc ? argv[++i] : NULL;
    if (!value || !*value) return usage("the option %s needs a value", row->name);
    if (!flag && !equals && strncmp(value, "--", 2) == 0)
      return usage("the option %s needs a value, not %.200s (or %s=%.200s)", row->name, value, row->name, value);
    status = add_value(&o->given[row->id], row, value);
  }
  return status;
}

static int refuse_apart(const struct options *o, const char *command) {
  static const struct {
    const char *command;
    enum option id;
    const char *names;
  } apart[] = {
#define APART(command, id, names) {#command, OPT_##id, names},
#include "cli/options.def"
  };
  for (size_t i = 0; i < sizeof apart / sizeof *apart; i++)
    for (int k = 0; k < n_option_rows && option(o, apart[i].id) && strcmp(apart[i].command, command) == 0; k++)
      if (option(o, option_table[k].id) && list_has(apart[i].names, option_table[k].name))
        return usage("%s goes with no %s", option_name(apart[i].id), option_table[k].name);
  return EXIT_AS_RECORDED;
}

/* The operands stand for one each; in brackets or before dots there may be any number. */
static int check_operands(const struct options *o, const struct command *c) {
  const char *options = strstr(c->operands, " --"), *dots = strstr(c->operands, "...");
  int len = (int)(options ? (size_t)(options - c->operands) : strlen(c->operands)), n = len > 0;
  for (int i = 0; i < len; i++) n += c->operands[i] == ' ';
  if (c->operands[0] == '[' || (dots ? o->operands.n >= n : o->operands.n == n)) return EXIT_AS_RECORDED;
  return n ? usage("%s takes %s%.*s", c->name, n == 1 && !dots ? "one " : "", len, c->operands)
           : usage("%s takes no operand, not %.200s", c->name, o->operands.word[0]);
}

int check_options(const struct options *o, const struct command *c) {
  int status = refuse_apart(o, c->name);
  return status ? status : check_operands(o, c);
}

bool parse_whole(unsigned long long *n, const char *text, bool zero, unsigned long long most) {
  char *end;
  errno = 0;
  *n = strtoull(text, &end, 10);
  bool digits = text[0] >= (text[1] ? '1' : '0') && text[0] <= '9';
  return digits && !errno && !*end && *n <= most && (zero || *n > 0);
}

int parse_count(long *count, const struct options *o, enum option id, long most) {
  const char *text = option(o, id);
  unsigned long long n;
  if (!text) return EXIT_AS_RECORDED;
  if (!parse_whole(&n, text, false, (unsigned long long)most))
    return usage("%s takes a whole number from 1 to %ld, not %.200s", option_name(id), most, text);
  *count = (long)n;
  return EXIT_AS_RECORDED;
}

int parse_word(int *k, const struct options *o, enum option id, const char *const *list, int n) {
  const char *text = option(o, id);
  OWNED(text) words = {0};
  int at = text ? word_find(text, list, n) : *k, status = EXIT_AS_RECORDED;
  for (int i = 0; i < n; i++) text_printf(&words, "%s%s", list_joint(i, n, " or "), list[i]);
  if (at < n)
    *k = at;
  else
    status = usage("%s takes %s, not %.200s", option_name(id), text_str(&words), text);
  return status;
}

int parse_jobs(int *jobs, const struct options *o) {
  long cores = sysconf(_SC_NPROCESSORS_ONLN), n = cores < 1 ? 1 : cores > MAX_JOBS ? MAX_JOBS : cores;
  int status = parse_count(&n, o, OPT_JOBS, MAX_JOBS);
  *jobs = (int)n;
  return status;
}

int parse_decimal(double *x, const struct options *o, enum option id, long most) {
  const char *text = option(o, id);
  char *end;
  *x = 0;
  if (!text) return EXIT_AS_RECORDED;
  bool plain = text[strspn(text, "0123456789.")] == '\0' && strlen(text) < 40;
  *x = plain ? strtod(text, &end) : 0;
  if (plain && !*end && *x >= 1e-6 && *x <= (double)most) return EXIT_AS_RECORDED;
  return usage("%s takes %s as a decimal from 0.000001 to %ld, not %.200s", option_name(id),
               id == OPT_TIMEOUT ? "seconds" : "a time", most, text);
}

int parse_digits(slong *digits, const struct options *o, long most) {
  long n = DEFAULT_DIGITS;
  int status = parse_count(&n, o, OPT_DIGITS, most);
  *digits = n;
  return status;
}

int parse_start(slong *orbit, bool *printed, const struct options *o) {
  const char *at = option(o, OPT_AT);
  *orbit = at ? 0 : -1;
  *printed = at && strcmp(at, "printed") == 0;
  if (!at || *printed) return EXIT_AS_RECORDED;
  unsigned long long k;
  if (strncmp(at, "orbit:", 6) != 0 || !parse_whole(&k, at + 6, false, LONG_MAX))
    return usage("--at takes orbit:K, K = 1, 2, ..., or printed, not %.200s", at);
  *orbit = (slong)k - 1;
  return EXIT_AS_RECORDED;
}
