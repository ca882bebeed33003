/* The command line: a table of commands, each in a file of src/cli.  Results go to stdout, errors and progress to stderr. */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

#include "cli/cli.h"
#include "stickslip/dynamics.h"

static const char help[] =
    "stickslip " SS_VERSION ": audits a paper on periodic stick-slip orbits of two masses on a moving belt\n"
    "\n"
    "usage:\n"
    "  stickslip verify [SCENE...] [--only ID[,ID...]] [--paper DIR] [--overlay FILE] [--digits N] [--out DIR]\n"
    "                   [--strict] [--quiet] [--jobs N] [--timeout SECONDS]\n"
    "      judge the paper's claims and write audit.json, audit.md, index.html and others to reports/SCENE/ or DIR, by "
    "N\n"
    "      processes (default: all processors; the same bytes by any number); Ctrl-C, SIGTERM and the time limit end "
    "it\n"
    "      with status 5 and leave the old report\n"
    "  stickslip verify [SCENE...] --plan [--only ID[,ID...]] [--json]\n"
    "      what it would do for each claim, and the estimated cost; does nothing and writes nothing\n"
    "  stickslip orbit SCENE [--method model|paper] [--digits N] [--basin] [--json] [--certificate FILE]\n"
    "      every periodic orbit D-Gamma-H-C at the scene's parameters, by increasing z10; with --method paper, "
    "Newton's\n"
    "      iteration on the paper's equations (44)-(46) from the printed times, else from each orbit's times moved by\n"
    "      2 %, and how it is conditioned (at most 1000 digits); with --basin, for a stable orbit a proved interval "
    "of\n"
    "      z_2 - z_1 that the return map takes into itself; a scene with intervals gives enclosures over its box\n"
    "  stickslip jacobian SCENE [--at orbit:K|printed] [--method analytic|implicit|saltation|fd|fd-double|ode]\n"
    "                   [--layer printed|corrected|stable] [--digits N] [--json]\n"
    "      the 2x2 Jacobian of one period: the paper's chain, implicit differentiation at the events, saltation "
    "matrices,\n"
    "      central differences in multiprecision (fd), in hardware arithmetic (fd-double, about eleven digits), or of\n"
    "      GSL's integration of (1)-(2) (ode, about eight); with its accuracy and eigenvalues\n"
    "  stickslip jacobian SCENE --phases [--at orbit:K|printed] [--digits N] [--json]\n"
    "      J_a, J_b, J_c, J_f of the phases and J of the period, each entry by every method, the paper's as printed "
    "and\n"
    "      as corrected; marks where a method departs from the others by more than they allow (8 digits in the "
    "table)\n"
    "  stickslip simulate SCENE [--at orbit:K|printed | --start x1,x2,v1,v2] [--periods N] [--samples N] [--csv]\n"
    "                   [--compare]\n"
    "      the two masses under Coulomb's law (1)-(2), integrated by GSL: events and phase word, or rows\n"
    "      t,x1,x2,v1,v2,mode1,mode2,u1,u2 at N samples a period and at every event; with --compare, integration and\n"
    "      closed forms in double beside MPFR, period by period (at most 10000), where they part and how fast; status "
    "5\n"
    "      when a simulation ends early (its budget of events or steps is used up, or the integrator gives up)\n"
    "  stickslip bifurcate SCENE --along NAME=A:B [--digits N] [--json]\n"
    "      where the orbits change while chi, eta, V, e1 or e2 runs from A to B: multiplier -1 (flip), two orbits "
    "merge\n"
    "      (fold), t_a = 0, a condition of admissibility or a switching condition becomes an equality (grazing); each "
    "in\n"
    "      a proved bracket of N significant digits (at most 1000), with the orbits on both sides\n"
    "  stickslip words SCENE [--longest N] [--digits N] [--json]\n"
    "      which sequences of at most N phases (1 to 8, default 4) can happen, and the orbits they have at the "
    "scene's\n"
    "      parameters: D, Gamma, H, C and those with a mass faster than the belt (gamma, h, c, X, x; they need u_r1 "
    "and\n"
    "      u_r2); none found is no proof.  orbit and jacobian take a scene that names one of them, word: D Gamma H "
    "Gamma\n"
    "  stickslip readings SCENE [--json]\n"
    "      how the printed numbers of the scene could have arisen: which were inputs, which equations were solved and "
    "which\n"
    "      dropped; the readings that give every printed digit, and how far rounding of the inputs reaches\n"
    "  stickslip explain ID [--at NAME=VALUE,...] [--tape] | ID --receipt\n"
    "      one claim: the paper's text, the formula as read, verdict and evidence, both sides at a point of your "
    "choice;\n"
    "      with --receipt, its proof by exact algebra as a Python script that needs SymPy alone\n"
    "  stickslip list [scenes | --scene-keys [--json]]\n"
    "      every claim with its kind, the verdict on record and its title; or every scene on file; with --scene-keys, "
    "every\n"
    "      line that a scene can have\n"
    "  stickslip check FILE...\n"
    "      read equation (.eq), claim (.claim) and scene (.scene) files and report what is wrong with them\n"
    "  stickslip mutate [--seed N] [--count N|all] [--jobs N] [--only FILE|RECORD[,...]] [--json] [--out DIR]\n"
    "      would the audit notice?  Damages the paper's formulas one token at a time and asks the claims that read "
    "them,\n"
    "      but for those that simulate; by default 400 damages drawn with seed 1, on all processors; --out writes\n"
    "      mutation.json and mutation.md\n"
    "  stickslip repair [ID...] [--jobs N] [--json] [--out DIR]\n"
    "      for each refuted claim about a formula (or those named), the smallest edits of its printed text with which "
    "it\n"
    "      passes its checks; --out writes repairs.json and repairs.md\n"
    "  stickslip diff A.json B.json [--json]\n"
    "      what changed from one audit.json to the other: counts, verdicts, claims that came or went, and every "
    "member\n"
    "      with another value; status 1 when anything did\n"
    "  stickslip bench [--job J] [--quick] [--peers FILE] [--json] [--out DIR]\n"
    "  stickslip bench --inputs DIR [--job J] [--quick]\n"
    "      error against run time: each job by each method at each of its settings, errors against enclosures; which\n"
    "      method to use, the fronts, and the ratios that are asked for, with a profile of what misses its goal; "
    "--out\n"
    "      writes bench.md, bench.json, for each job a page, a table and, with gnuplot, figures, and removes what an\n"
    "      earlier run left there; --quick: few inputs and short timings; --inputs writes the inputs with their true\n"
    "      outputs, on which bench/peers/peers.py measures what is not C; --peers adds its table\n"
    "      jobs: propagator, map, jacobian, orbit, verdicts; studies, only when asked for, write STUDY.md and tables:\n"
    "      stiff (orbits at eta from 1e-12 to 1e12 by explicit and implicit integrators), smooth (smoothed friction\n"
    "      laws), procedure (the paper's (44)-(46) as a method), or all three as studies\n"
    "  stickslip sweep SCENE --over NAME=A:B:N [--over NAME=A:B:N] [--all] [--search-every N] [--digits N] [--jobs N]\n"
    "                  [--csv FILE [--resume] | --json]\n"
    "      the admissible orbits (with --all and in JSON: every orbit) at N values of one or two of chi, eta, V, e1, "
    "e2 "
    "from\n"
    "      A to B, in double precision, along the last --over; the numbers belong to the parameters as doubles, so "
    "that\n"
    "      those of a decimal can differ by 2^-53 times their condition number; CSV goes to stdout without --csv, "
    "which\n"
    "      writes FILE.part and renames it when complete; --resume continues a FILE.part.  Orbits are searched for at\n"
    "      every N-th point (by default up to 4096 apart, at least 128 times a line) and where an orbit ends or "
    "begins,\n"
    "      and followed between: one that begins and ends between two searches can be missing.  At most 1000000000\n"
    "      points; Ctrl-C and SIGTERM end it with status 5\n"
    "  stickslip stability [FORMULA...] [--quick] [--layer printed|corrected|stable] [--after LAYER] [--jobs N]\n"
    "                   [--paper DIR] [--overlay FILE] [--json] [--out DIR]\n"
    "      where the paper's formulas lose digits in double precision, by how many more than the problem loses, and "
    "why:\n"
    "      the worst points of every region (chi to 0, large times, beside poles, ...) that a search finds, with the "
    "node\n"
    "      that loses them; FORMULA is a name (H, H[1,3], ktilde_4), a statement's side (eq-46.2) or a record "
    "(eq-36);\n"
    "      --after holds another layer against it at the same points; --out writes stability.json, ledger.md, "
    "ledger.tsv\n"
    "      and maps; --quick: seconds instead of minutes, no maps\n"
    "  stickslip stability FORMULA --at NAME=VALUE,... [--layer printed|corrected|stable]\n"
    "      the formula at one point (hexadecimal numbers are exact): value, true value, error, conditioning, cause\n"
    "  stickslip plot SCENE [--out DIR]\n"
    "      the pictures of the scene's orbits alone, as SVG files with the tables they are drawn from: figures 3 and "
    "4,\n"
    "      return map, margins of the conditions, long run, error of finite differences; to DIR or reports/SCENE/\n"
    "  stickslip report DIR\n"
    "      writes the other reports in DIR (audit.md, index.html, errata.md, ...) again from its audit.json and the "
    "tables\n"
    "      beside that: the same bytes as verify did; needs neither the paper's files nor the scene's.  index.html "
    "also\n"
    "      shows the score of ../mutation, when that study was of the same formulas and scene, and links to pictures "
    "of\n"
    "      ../bench and ../stability, as far as these folders are there\n"
    "  stickslip --help | --version\n"
    "\n"
    "SCENE is a path, or the name of a file in verify/scenes without its suffix; verify without one runs \"paper\".\n"
    "--set NAME=VALUE, as often as wanted, puts a line in place of the scene's own or beside it (explain and repair: "
    "of\n"
    "the paper's example); an empty VALUE takes the line away: orbit paper --set chi=0.7 --set e2=1/2.\n"
    "--only eq-27 selects eq-27 and its suffixed claims.  --paper reads the equation files of another folder, "
    "--overlay\n"
    "puts a file's definitions over them; both count as the printed text.  --digits: significant digits, rounded to\n"
    "nearest, 1 to 100000 (default 15); for verify, of the values asked for; no verdict depends on it.  Layer: printed "
    "is the\n"
    "paper's text (default of stability), corrected (default elsewhere) has verify/errata.eq over it, stable has\n"
    "verify/stable.eq over both, forms that keep their digits in double precision.  Methods other than analytic use "
    "the\n"
    "suite's own model.  At printed, analytic takes the states at the printed times, the others locate the events.\n"
    "\n"
    "exit status: 0 verdicts as recorded; 1 a verdict differs from its record, a control went unnoticed, or routes "
    "disagree;\n"
    "2 usage; 3 bad input, or output that cannot be written; 4 with --strict: discrepancies or unknowns remain; 5 "
    "internal\n"
    "error, memory exhausted, the time limit of verify, an interrupted verify or sweep (other commands end by the\n"
    "signal), or a simulation that ended early.  Files written before are intact.\n";

static void print_help(void) {
  fputs(help, stdout);
  fputs("\nviolations in orbit --json name the conditions that an orbit breaks:\n ", stdout);
  for (int i = 0; i < N_CONDITIONS; i++) printf(" %s", dyn_condition_id[i]);
  fputs("\n  u_r1 u_r2 (a static friction given by the scene is not above its bound)\n", stdout);
}

static const struct command {
  const char *name;
  unsigned bit;
  int (*run)(const struct options *o, const char *data);
} commands[] = {{"verify", FOR_VERIFY, run_verify},
                {"orbit", FOR_ORBIT, run_orbit},
                {"jacobian", FOR_JACOBIAN, run_jacobian},
                {"simulate", FOR_SIMULATE, run_simulate},
                {"readings", FOR_READINGS, run_readings},
                {"explain", FOR_EXPLAIN, run_explain},
                {"list", FOR_LIST, run_list},
                {"check", FOR_CHECK, run_check},
                {"mutate", FOR_MUTATE, run_mutate},
                {"repair", FOR_REPAIR, run_repair},
                {"bifurcate", FOR_BIFURCATE, run_bifurcate},
                {"diff", FOR_DIFF, run_diff},
                {"bench", FOR_BENCH, run_bench},
                {"sweep", FOR_SWEEP, run_sweep},
                {"stability", FOR_STABILITY, run_stability},
                {"plot", FOR_PLOT, run_plot},
                {"words", FOR_WORDS, run_words},
                {"report", FOR_REPORT, run_report}};

static int run_command(const struct command *c, int argc, char **argv) {
  struct options o;
  int status = parse_options(&o, c->bit, argc, argv);
  if (status) return status;
  if (o.help) {
    print_help();
    return EXIT_AS_RECORDED;
  }
  struct text data;
  struct diag d;
  text_init(&data);
  diag_init(&d);
  bool needed = !(c->bit & (FOR_DIFF | FOR_REPORT)); /* which read audits and nothing else */
  status = !needed || find_data(&data, &d) ? c->run(&o, text_str(&data)) : bad_input(&d);
  text_clear(&data);
  return status;
}

/* What was printed must have reached its reader. */
static int finish(int status) {
  if (fflush(stdout) != 0 || ferror(stdout)) {
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

/* What the caller left closed must not become a file that is written; output that has nowhere to go is an error that write
   returns, not the end of the process. */
static void secure_output(void) {
  for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
    if (fcntl(fd, F_GETFD) < 0 && open("/dev/null", fd == STDERR_FILENO ? O_WRONLY : O_RDONLY) != fd)
      _exit(EXIT_INTERNAL);
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
}

int main(int argc, char **argv) {
  secure_output();
  signal(SIGABRT, on_abort);
  signal(SIGCHLD, SIG_DFL); /* a caller that ignores it would hide how processes end */
  own_memory();
  if (argc < 2)
    return usage("a command is needed: %s", "verify, orbit, jacobian, simulate, readings, explain, list, check, "
                                            "mutate, repair, bifurcate, diff, bench, sweep, stability, plot, words or "
                                            "report");
  if (strcmp(argv[1], "--help") == 0) {
    print_help();
    return finish(EXIT_AS_RECORDED);
  }
  if (strcmp(argv[1], "--version") == 0) {
    puts("stickslip " SS_VERSION);
    return finish(EXIT_AS_RECORDED);
  }
  for (size_t i = 0; i < sizeof commands / sizeof *commands; i++)
    if (strcmp(commands[i].name, argv[1]) == 0) return finish(run_command(&commands[i], argc - 2, argv + 2));
  return usage("unknown command %.200s", argv[1]);
}
