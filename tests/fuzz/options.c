/* A command line from any bytes: words ended by NUL, the first of them the command.  Laws: a status of the contract,
   and numbers within their bounds. */
#include <string.h>

#include "cli/cli.h"
#include "fuzz.h"

enum { MOST_WORDS = 100 };

static void read_ranges(const struct options *o) {
  LOCAL(scene_range, r);
  const struct words *over = &o->given[OPT_OVER];
  const char *along = option(o, OPT_ALONG);
  for (int i = 0; i < over->n; i++) range_parse(&r, "--over", "%s: %.200s", over->word[i], strlen(over->word[i]));
  if (along) {
    int status = range_parse(&r, "--along", "%s: %.200s", along, strlen(along));
    fuzz_law(status == EXIT_USAGE || fmpq_sgn(r.from) > 0, "a range lies in the domain");
  }
}

static void read_numbers(const struct options *o) {
  slong digits, orbit;
  unsigned long long n;
  bool printed;
  int jobs;
  double seconds;
  if (!parse_digits(&digits, o, MAX_DIGITS))
    fuzz_law(digits >= 1 && digits <= MAX_DIGITS, "digits are within their bounds");
  if (!parse_jobs(&jobs, o)) fuzz_law(jobs >= 1 && jobs <= MAX_JOBS, "jobs are within their bounds");
  if (!parse_decimal(&seconds, o, OPT_TIMEOUT, MOST_SECONDS))
    fuzz_law(!option(o, OPT_TIMEOUT) || (seconds > 0 && seconds <= 1e7), "seconds are within their bounds");
  if (!parse_start(&orbit, &printed, o)) fuzz_law(orbit >= -1, "an orbit has a number, or is left to the command");
  const char *count = option(o, OPT_COUNT);
  if (count && parse_whole(&n, count, false, 1000)) fuzz_law(n >= 1 && n <= 1000, "a count is within its bounds");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  LOCAL(text, words);
  char *argv[MOST_WORDS];
  int argc = 0;
  struct options o;
  if (size == 0) return 0;
  text_add_n(&words, (const char *)data, size);
  for (char *p = words.data; p < words.data + words.len && argc < MOST_WORDS; p += strlen(p) + 1) argv[argc++] = p;
  int status = parse_options(&o, argv[0], argc - 1, argv + 1);
  fuzz_law(status == EXIT_AS_RECORDED || status == EXIT_USAGE, "the words are taken, or it is a mistake of usage");
  if (!status) {
    read_ranges(&o);
    read_numbers(&o);
  }
  return 0;
}
