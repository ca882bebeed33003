/* The words of a command line, by one table of options. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli.h"

int usage(const char *fmt, const char *what) {
  struct diag d;
  diag_init(&d);
  diag_set(&d, fmt, what);
  fprintf(stderr, "stickslip: %s; see stickslip --help\n", d.message);
  return EXIT_USAGE;
}

int bad_input(const struct diag *d) {
  fprintf(stderr, "%s%s\n", strncmp(d->message, "error:", 6) == 0 ? "stickslip: " : "", d->message);
  return EXIT_INPUT;
}

/* Splits the list in place; it lives in argv. */
static bool add_only(struct options *o, char *list) {
  size_t len = strlen(list);
  if (list[0] == ',' || list[len - 1] == ',' || strstr(list, ",,")) return false;
  for (char *p = strtok(list, ","); p; p = strtok(NULL, ",")) {
    if (o->n_only == MAX_ONLY) return false;
    o->only[o->n_only++] = p;
  }
  return o->n_only > 0;
}

int parse_options(struct options *o, unsigned command, int argc, char **argv) {
  struct {
    const char *name;
    unsigned commands;
    const char **value;
    bool *flag;
  } table[] = {
      {"--only", FOR_VERIFY | FOR_MUTATE, NULL, NULL},
      {"--paper", FOR_VERIFY | FOR_STABILITY, &o->paper, NULL},
      {"--overlay", FOR_VERIFY | FOR_STABILITY, &o->overlay, NULL},
      {"--out", FOR_VERIFY | FOR_MUTATE | FOR_REPAIR | FOR_BENCH | FOR_STABILITY | FOR_PLOT, &o->out, NULL},
      {"--strict", FOR_VERIFY, NULL, &o->strict},
      {"--quiet", FOR_VERIFY, NULL, &o->quiet},
      {"--digits", FOR_VERIFY | FOR_ORBIT | FOR_JACOBIAN | FOR_BIFURCATE | FOR_SWEEP | FOR_WORDS, &o->digits, NULL},
      {"--json", FOR_JSON | FOR_VERIFY, NULL, &o->json},
      {"--at", FOR_JACOBIAN | FOR_EXPLAIN | FOR_SIMULATE | FOR_STABILITY, &o->at, NULL},
      {"--certificate", FOR_ORBIT, &o->certificate, NULL},
      {"--periods", FOR_SIMULATE, &o->periods, NULL},
      {"--samples", FOR_SIMULATE, &o->samples, NULL},
      {"--start", FOR_SIMULATE, &o->start, NULL},
      {"--csv", FOR_SIMULATE, NULL, &o->csv},
      {"--csv", FOR_SWEEP, &o->csv_file, NULL},
      {"--over", FOR_SWEEP, NULL, NULL},
      {"--search-every", FOR_SWEEP, &o->search_every, NULL},
      {"--all", FOR_SWEEP, NULL, &o->all},
      {"--resume", FOR_SWEEP, NULL, &o->resume},
      {"--compare", FOR_SIMULATE, NULL, &o->compare},
      {"--seed", FOR_MUTATE, &o->seed, NULL},
      {"--count", FOR_MUTATE, &o->count, NULL},
      {"--jobs", FOR_VERIFY | FOR_MUTATE | FOR_REPAIR | FOR_SWEEP | FOR_STABILITY, &o->jobs, NULL},
      {"--timeout", FOR_VERIFY, &o->timeout, NULL},
      {"--plan", FOR_VERIFY, NULL, &o->plan},
      {"--along", FOR_BIFURCATE, &o->along, NULL},
      {"--longest", FOR_WORDS, &o->longest, NULL},
      {"--basin", FOR_ORBIT, NULL, &o->basin},
      {"--job", FOR_BENCH, &o->job, NULL},
      {"--quick", FOR_BENCH | FOR_STABILITY, NULL, &o->quick},
      {"--inputs", FOR_BENCH, &o->inputs, NULL},
      {"--peers", FOR_BENCH, &o->peers, NULL},
      {"--tape", FOR_EXPLAIN, NULL, &o->tape},
      {"--receipt", FOR_EXPLAIN, NULL, &o->receipt},
      {"--method", FOR_JACOBIAN | FOR_ORBIT, &o->method, NULL},
      {"--layer", FOR_JACOBIAN | FOR_STABILITY, &o->layer, NULL},
      {"--after", FOR_STABILITY, &o->after, NULL},
      {"--phases", FOR_JACOBIAN, NULL, &o->phases},
      {"--set", FOR_SET, NULL, NULL},
      {"--scene-keys", FOR_LIST, NULL, &o->scene_keys},
      {"--help", ~0U, NULL, &o->help}};
  *o = (struct options){.n_operands = 0};
  for (int i = 0; i < argc; i++) {
    char *arg = argv[i];
    if (arg[0] != '-' || arg[1] == '\0') {
      if (o->n_operands == MAX_OPERANDS) return usage("too many operands, at %.200s", arg);
      o->operand[o->n_operands++] = arg;
      continue;
    }
    char *equals = strchr(arg, '=');
    size_t len = equals ? (size_t)(equals - arg) : strlen(arg);
    size_t k = 0, n = sizeof table / sizeof *table;
    bool known = false; /* two commands can give one name to different options */
    for (; k < n; k++) {
      bool named = strlen(table[k].name) == len && strncmp(table[k].name, arg, len) == 0;
      if (named && (table[k].commands & command)) break;
      known |= named;
    }
    if (k == n)
      return usage(known ? "the option %.200s does not belong to this command" : "unknown option %.200s", arg);
    if (table[k].flag) {
      if (equals) return usage("the option %.200s takes no value", table[k].name);
      if (*table[k].flag) return usage("the option %s is given twice", table[k].name);
      *table[k].flag = true;
      continue;
    }
    char *value = equals ? equals + 1 : i + 1 < argc ? argv[++i] : NULL;
    if (!value || !*value) return usage("the option %s needs a value", table[k].name);
    if (table[k].value) {
      if (*table[k].value) return usage("the option %s is given twice", table[k].name);
      *table[k].value = value;
    } else if (table[k].commands == FOR_SET) {
      if (!strchr(value, '=')) return usage("--set takes NAME=VALUE, as in e2=1/2, not %.200s", value);
      if (o->n_set == MAX_SET) return usage("at most 64 --set, not %.200s too", value);
      o->set[o->n_set++] = value;
    } else if (table[k].commands == FOR_SWEEP) {
      if (o->n_over == MAX_OVER) return usage("at most two --over, not %.200s too", value);
      o->over[o->n_over++] = value;
    } else if (!add_only(o, value)) {
      return usage("--only takes 1 to 256 names, not %.200s", value);
    }
  }
  return EXIT_AS_RECORDED;
}

bool parse_whole(unsigned long long *n, const char *text, bool zero, unsigned long long most) {
  char *end;
  errno = 0;
  *n = strtoull(text, &end, 10);
  return text[0] >= '0' && text[0] <= '9' && !errno && !*end && *n <= most && (zero || *n > 0);
}

int parse_jobs(int *jobs, const char *text) {
  unsigned long long n;
  long cores = sysconf(_SC_NPROCESSORS_ONLN);
  *jobs = cores < 1 ? 1 : cores > MAX_JOBS ? MAX_JOBS : (int)cores;
  if (!text) return EXIT_AS_RECORDED;
  if (!parse_whole(&n, text, false, MAX_JOBS))
    return usage("--jobs takes a whole number from 1 to 64, not %.200s", text);
  *jobs = (int)n;
  return EXIT_AS_RECORDED;
}

int parse_timeout(double *seconds, const char *text) {
  enum { MOST_SECONDS = 10000000 };
  char *end;
  *seconds = 0;
  if (!text) return EXIT_AS_RECORDED;
  bool plain = text[strspn(text, "0123456789.")] == '\0' && strlen(text) < 40;
  *seconds = plain ? strtod(text, &end) : 0;
  if (!plain || *end || !(*seconds >= 1e-6 && *seconds <= MOST_SECONDS))
    return usage("--timeout takes seconds as a decimal from 0.000001 to 10000000, not %.200s", text);
  return EXIT_AS_RECORDED;
}

int parse_digits(slong *digits, const struct options *o) {
  *digits = DEFAULT_DIGITS;
  if (!o->digits) return EXIT_AS_RECORDED;
  char *end;
  errno = 0;
  long n = strtol(o->digits, &end, 10);
  if (errno || *end || o->digits[0] < '1' || o->digits[0] > '9' || n < 1 || n > MAX_DIGITS)
    return usage("--digits takes a whole number from 1 to 100000, not %.200s", o->digits);
  *digits = n;
  return EXIT_AS_RECORDED;
}

int parse_start(slong *orbit, bool *printed, const char *at) {
  *orbit = 0;
  *printed = at && strcmp(at, "printed") == 0;
  if (!at || *printed) return EXIT_AS_RECORDED;
  char *end = NULL;
  errno = 0;
  bool shaped = strncmp(at, "orbit:", 6) == 0 && at[6] >= '1' && at[6] <= '9';
  long k = shaped ? strtol(at + 6, &end, 10) : 0;
  if (!shaped || errno || *end) return usage("--at takes orbit:K, K = 1, 2, ..., or printed, not %.200s", at);
  *orbit = k - 1;
  return EXIT_AS_RECORDED;
}
