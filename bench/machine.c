/* What a time was measured on: read from the system and the libraries, not from the build's own text. */
#include <gsl/gsl_version.h>
#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "bench/jobs.h"

/* The first line of a file of the system; with a key, what stands behind the colon of the first that begins with it. */
static bool system_line(char *value, size_t size, const char *path, const char *key) {
  FILE *f = fopen(path, "r");
  char line[512];
  bool found = false;
  while (f && !found && fgets(line, sizeof line, f)) {
    const char *colon = key && strncmp(line, key, strlen(key)) == 0 ? strchr(line, ':') : NULL;
    if (key && !colon) continue;
    snprintf(value, size, "%s", colon ? colon + 1 + (colon[1] == ' ') : line);
    value[strcspn(value, "\n")] = '\0';
    found = true;
  }
  if (f) fclose(f);
  return found;
}

void bench_machine(struct text *out, const struct bench_result *r) {
  char line[512];
  struct utsname u;
  if (system_line(line, sizeof line, "/proc/cpuinfo", "model name")) text_printf(out, "cpu: %s\n", line);
  if (system_line(line, sizeof line, "/proc/cpuinfo", "cpu MHz")) text_printf(out, "clock: %s MHz at the time\n", line);
  text_printf(out, "cores: %ld\n", sysconf(_SC_NPROCESSORS_ONLN));
  bool told = system_line(line, sizeof line, "/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", NULL);
  text_printf(out, "governor: %s\n", told ? line : "not told by the system");
  if (system_line(line, sizeof line, "/proc/loadavg", NULL))
    text_printf(out, "load: %.*s in the last minute\n", (int)strcspn(line, " "), line);
  if (uname(&u) == 0) text_printf(out, "system: %s %s %s\n", u.sysname, u.release, u.machine);
#if defined(__clang__)
  text_printf(out, "compiler: %s\n", __VERSION__);
#else
  text_printf(out, "compiler: gcc %s\n", __VERSION__);
#endif
#if !defined(__OPTIMIZE__)
  text_add(out, "optimization: none\n");
#endif
  text_printf(out, "GSL: %s\nMPFR: %s\nGMP: %s\nFLINT: %s\n", gsl_version, mpfr_get_version(), gmp_version,
              FLINT_VERSION);
#if __FLINT_RELEASE < 30000
  text_printf(out, "Arb: %s\n", arb_version);
#endif
  text_printf(out, "SUNDIALS: %s\n", bench_cvode_version());
  if (r) text_add(out, text_str(&r->peers.versions));
}
