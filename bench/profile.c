/* Where the time of a method goes: while it runs over its inputs again and again, a clock interrupts it some thousand
   times a second and notes the program counter.  Afterwards the counters are named, from the program's own symbol table
   and from what libraries export; a place in a library without a name counts for the library.  For Linux; elsewhere
   there are no profiles. */
#define _GNU_SOURCE
#include "bench/jobs.h"

#if defined(__linux__) && (defined(__x86_64__) || defined(__aarch64__))
#include <dlfcn.h>
#include <elf.h>
#include <link.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <ucontext.h>

#include "base/arena.h"

enum { MOST_SAMPLES = 8192, PERIOD_US = 200 };

static void *sample[MOST_SAMPLES];
static volatile sig_atomic_t n_samples;

static void *counter_of(const ucontext_t *u) {
#if defined(__x86_64__)
  return (void *)u->uc_mcontext.gregs[REG_RIP];
#else
  return (void *)u->uc_mcontext.pc;
#endif
}

static void take(int number, siginfo_t *info, void *context) {
  (void)number, (void)info;
  void *at = counter_of(context);
  if (n_samples == MOST_SAMPLES) return;
  sample[n_samples] = at;
  n_samples = n_samples + 1;
}

static struct sigaction before;

static bool begin(void) {
  struct sigaction action = {.sa_sigaction = take, .sa_flags = SA_SIGINFO | SA_RESTART};
  const struct itimerval period = {{0, PERIOD_US}, {0, PERIOD_US}};
  n_samples = 0;
  sigemptyset(&action.sa_mask);
  return sigaction(SIGALRM, &action, &before) == 0 && setitimer(ITIMER_REAL, &period, NULL) == 0;
}

static void end(void) {
  const struct itimerval never = {{0, 0}, {0, 0}};
  setitimer(ITIMER_REAL, &never, NULL);
  sigaction(SIGALRM, &before, NULL);
}

/* --- Names. --- */

/* The program's own table, which names static functions too; empty when it has been stripped. */
struct symbols {
  char *file;
  size_t size;
  const ElfW(Sym) * symbol;
  size_t n;
  const char *name;
  bool placed; /* values are relative to where the program was loaded */
};

static void read_program(struct symbols *s) {
  FILE *f = fopen("/proc/self/exe", "rb");
  long size = f && fseek(f, 0, SEEK_END) == 0 ? ftell(f) : -1;
  if (size > 0 && fseek(f, 0, SEEK_SET) == 0) {
    s->file = ss_malloc((size_t)size);
    s->size = fread(s->file, 1, (size_t)size, f);
  }
  if (f) fclose(f);
}

static bool inside(const struct symbols *s, size_t offset, size_t size) {
  return offset <= s->size && size <= s->size - offset;
}

static void symbols_init(struct symbols *s) {
  *s = (struct symbols){.file = NULL};
  read_program(s);
  const ElfW(Ehdr) *head = (const void *)s->file;
  if (!inside(s, 0, sizeof *head) || !inside(s, head->e_shoff, head->e_shnum * sizeof(ElfW(Shdr)))) return;
  const ElfW(Shdr) *section = (const void *)(s->file + head->e_shoff);
  s->placed = head->e_type == ET_DYN;
  for (int i = 0; i < head->e_shnum; i++) {
    if (section[i].sh_type != SHT_SYMTAB || section[i].sh_link >= head->e_shnum) continue;
    const ElfW(Shdr) *names = &section[section[i].sh_link];
    if (!inside(s, section[i].sh_offset, section[i].sh_size) || !inside(s, names->sh_offset, names->sh_size)) continue;
    s->symbol = (const void *)(s->file + section[i].sh_offset);
    s->n = section[i].sh_size / sizeof *s->symbol;
    s->name = s->file + names->sh_offset;
  }
}

static const char *symbol_at(const struct symbols *s, size_t offset) {
  for (size_t i = 0; i < s->n; i++)
    if ((s->symbol[i].st_info & 0xf) == STT_FUNC && offset - s->symbol[i].st_value < s->symbol[i].st_size)
      return s->name + s->symbol[i].st_name;
  return NULL;
}

enum { NAME = sizeof((struct bench_part *)0)->where };

/* "libm"; the function is NULL where the library does not tell it. */
static const char *name_of(char library[NAME], void *at, const struct symbols *s) {
  Dl_info where, own;
  snprintf(library, NAME, "elsewhere");
  if (!dladdr(at, &where) || !dladdr((void *)(size_t)&bench_profiles, &own)) return NULL;
  if (where.dli_fbase == own.dli_fbase) {
    snprintf(library, NAME, "stickslip");
    return symbol_at(s, (size_t)at - (s->placed ? (size_t)own.dli_fbase : 0));
  }
  const char *slash = strrchr(where.dli_fname, '/'), *file = slash ? slash + 1 : where.dli_fname;
  snprintf(library, NAME, "%.*s", (int)strcspn(file, "."), file);
  return where.dli_sname;
}

/* --- Adding up. --- */

struct places {
  struct place {
    char where[NAME];
    long n;
  } * place;
  int n;
};

static void count_one(struct places *p, const char *where) {
  int k = 0;
  while (k < p->n && strcmp(p->place[k].where, where) != 0) k++;
  if (k == p->n) {
    p->place[k].n = 0;
    snprintf(p->place[k].where, NAME, "%s", where);
    p->n++;
  }
  p->place[k].n++;
}

static int by_count(const void *x, const void *y) {
  long a = ((const struct place *)x)->n, b = ((const struct place *)y)->n;
  return (a < b) - (a > b);
}

static int largest(struct bench_part part[BENCH_PARTS], struct places *p, long of) {
  int n = 0;
  qsort(p->place, (size_t)p->n, sizeof *p->place, by_count);
  for (; n < p->n && n < BENCH_PARTS && 100 * p->place[n].n >= of; n++) { /* from one in a hundred on */
    memcpy(part[n].where, p->place[n].where, NAME);
    part[n].share = (double)p->place[n].n / (double)of;
  }
  return n;
}

static void add_up(struct bench_profile *p) {
  struct symbols s;
  long taken = n_samples;
  struct places libraries = {ss_malloc((size_t)taken * sizeof(struct place)), 0};
  struct places functions = {ss_malloc((size_t)taken * sizeof(struct place)), 0};
  symbols_init(&s);
  for (long i = 0; i < taken; i++) {
    char library[NAME];
    const char *function = name_of(library, sample[i], &s);
    count_one(&libraries, library);
    if (function) count_one(&functions, function);
  }
  p->samples = taken;
  p->n_libraries = largest(p->library, &libraries, taken);
  p->n_functions = largest(p->function, &functions, taken);
  free(libraries.place);
  free(functions.place);
  free(s.file);
}

/* --- What to look at. --- */

/* The method of the suite that a ratio is about, by the words of its name; "%g bits" in it is the setting. */
static const struct {
  const char *words;
  const struct bench_job *job;
  const char *method;
} subjects[] = {{"/ map in balls", &bench_map, "closed-arb"},
                {"MPFR map", &bench_map, "closed-mpfr"},
                {"map in double", &bench_map, "closed-double"},
                {"the suite's orbit", &bench_orbit, "from-guess"}};

static double bits_in(const char *name) {
  const char *bits = strstr(name, " bits"), *digit = bits;
  while (digit && digit > name && digit[-1] >= '0' && digit[-1] <= '9') digit--;
  return digit && digit < bits ? strtod(digit, NULL) : NAN;
}

static void profile(struct bench_ratio *r, const struct bench_env *env, bool quick) {
  const struct bench_job *job = NULL;
  const struct bench_method *m = NULL;
  for (int k = 0; k < COUNT(subjects) && !m; k++)
    if (strstr(r->name, subjects[k].words)) {
      job = subjects[k].job;
      m = bench_method_of(job, subjects[k].method);
    }
  double setting = m && m->kind == SET_BITS ? bits_in(r->name) : NAN;
  if (!m || (m->kind == SET_BITS && isnan(setting))) return;
  if (!bench_keep_busy(job, m, setting, env, quick ? 0.05 : 0.4, begin, end) || n_samples == 0) return;
  r->profile = (struct bench_profile){.method = m, .setting = setting};
  add_up(&r->profile);
}

void bench_profiles(struct bench_result *r, const struct bench_env *env) {
  for (int i = 0; i < r->n_ratios; i++)
    if (bench_outcome(&r->ratio[i]) == RATIO_NOT_MET) profile(&r->ratio[i], env, r->quick);
}
#else
void bench_profiles(struct bench_result *r, const struct bench_env *env) {
  (void)r, (void)env;
}
#endif
