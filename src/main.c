/* The command line: the commands of src/cli/options.def, each in a file of src/cli.  Results go to stdout, errors and
   progress to stderr. */
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "cli/cli.h"

static int run_command(const struct command *c, int argc, char **argv) {
  static struct options o; /* too large for a small stack */
  int status = parse_options(&o, c->name, argc, argv);
  if (status) return status;
  if (option(&o, OPT_HELP)) {
    help_page(c);
    return EXIT_AS_RECORDED;
  }
  status = check_options(&o, c);
  if (status) return status;
  OWNED(text) data = {0};
  struct diag d = {0};
  if (!c->data || find_data(&data, &d)) status = c->run(&o, text_str(&data), &d);
  int said = d.set ? bad_input(&d) : status;
  if (status != EXIT_INTERNAL) status = said;
  return status;
}

/* No command. */
static int name_the_commands(void) {
  OWNED(text) names = {0};
  for (int i = 0; i < n_commands; i++)
    text_printf(&names, "%s%s", list_joint(i, n_commands, " or "), command_table[i].name);
  return usage("a command is needed: %s", text_str(&names));
}

static bool asks_for_help(const char *word) {
  return strcmp(word, "help") == 0 || strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0;
}

/* Whether standard output is a pipe that nobody reads any more, as behind "| head". */
static bool reader_has_gone(void) {
  struct pollfd out = {.fd = STDOUT_FILENO};
  return poll(&out, 1, 0) > 0 && (out.revents & (POLLERR | POLLHUP)) != 0;
}

/* What was printed must have reached its reader; one that has read enough is none the worse. */
static int finish(int status) {
  if ((fflush(stdout) != 0 || ferror(stdout)) && !reader_has_gone()) {
    fprintf(stderr, "stickslip: error: standard output cannot be written: %s\n", strerror(errno));
    if (status == EXIT_AS_RECORDED || status == EXIT_DIFFERS || status == EXIT_STRICT) status = EXIT_INPUT;
  }
  flint_cleanup();
  mpfr_free_cache();
  return status;
}

/* A broken invariant, here or in a library, ends in abort(): it has the status that the contract gives it. */
static void on_abort(int signal) {
  static const char message[] = "stickslip: internal error\n";
  (void)signal;
  if (write(STDERR_FILENO, message, sizeof message - 1) < 0) _exit(EXIT_INTERNAL);
  _exit(EXIT_INTERNAL);
}

/* What the caller left closed must not become a file that is written; output that has nowhere to go is an error that
   write returns, not the end of the process. */
static void secure_output(void) {
  for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
    if (fcntl(fd, F_GETFD) < 0 && open("/dev/null", fd == STDERR_FILENO ? O_WRONLY : O_RDONLY) != fd)
      _exit(EXIT_INTERNAL);
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
}

/* A stack that ends would end the program without a word, so that it is looked at before anything runs deep; a
   whole audit of the paper takes less than what is needed here. */
static void secure_stack(void) {
  enum { NEEDED = 1 << 20 };
  struct rlimit r;
  if (getrlimit(RLIMIT_STACK, &r) != 0 || r.rlim_cur >= NEEDED) return;
  r.rlim_cur = NEEDED;
  if (r.rlim_max >= NEEDED && setrlimit(RLIMIT_STACK, &r) == 0) return;
  fputs("stickslip: error: the stack is too small; it takes 1024 KiB (ulimit -s)\n", stderr);
  exit(EXIT_INTERNAL);
}

int main(int argc, char **argv) {
  secure_output();
  secure_stack();
  signal(SIGABRT, on_abort);
  signal(SIGCHLD, SIG_DFL); /* a caller that ignores it would hide how processes end */
  own_memory();
  atexit(files_settle);
  if (argc < 2) return name_the_commands();
  if (asks_for_help(argv[1])) return finish(help(argc == 3 && asks_for_help(argv[2]) ? 0 : argc - 2, argv + 2));
  if (strcmp(argv[1], "--version") == 0) {
    puts("stickslip " SS_VERSION);
    return finish(EXIT_AS_RECORDED);
  }
  const struct command *c = find_command(argv[1]);
  return c ? finish(run_command(c, argc - 2, argv + 2)) : EXIT_USAGE;
}
