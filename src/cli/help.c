/* What the program says of itself, made from the rows of options.def: an overview that fits a screen, a page for each
   command, and every row for the tools that write the man page and complete command lines. */
#include <string.h>

#include "cli.h"

const struct command command_table[] = {
#define COMMAND(name, data, operands, purpose, text, ...)                                                              \
  {#name, data, operands, purpose, text, {__VA_ARGS__}, run_##name},
#include "cli/options.def"
};
const int n_commands = sizeof command_table / sizeof *command_table;

static const struct {
  int number;
  const char *brief, *text;
} statuses[] = {
#define STATUS(number, brief, text) {number, brief, text},
#include "cli/options.def"
};
enum { N_STATUSES = sizeof statuses / sizeof *statuses, WIDTH = 80 };

static const char scene_text[] =
    "SCENE is a path, or the name of a file in verify/scenes without its suffix (stickslip list scenes).";

/* A paragraph within the width; lines but its first go on at the column. */
static void add_paragraph(struct text *out, size_t indent, const char *fmt, ...) {
  OWNED(text) line = {0};
  va_list ap;
  va_start(ap, fmt);
  text_vprintf(&line, fmt, ap);
  text_fit(out, text_str(&line), line.len, 0, WIDTH, indent);
  text_add_char(out, '\n');
  va_end(ap);
}

/* Every paragraph of the command's description, those among them that other tables make. */
static void describe(struct text *out, const struct command *c) {
  text_add(out, c->text);
  if (strstr(c->operands, "SCENE")) text_printf(out, "\n%s", scene_text);
  if (strcmp(c->name, "orbit") != 0) return;
  text_add(out, "\nThe violations of an orbit in JSON name the conditions that it breaks:");
  for (int i = 0; i < ORBIT_CONDITIONS; i++) text_printf(out, " %s", orbit_condition_name(i));
  text_add(out, " (a static friction given by the scene is not above its bound).");
}

/* Whether the operands, as options.def writes them, hold the option too. */
static bool stands_among_operands(const struct command *c, const struct option_row *row) {
  return strstr(c->operands, row->name) != NULL;
}

static void add_usage(struct text *out, const struct command *c) {
  OWNED(text) item = {0};
  size_t begin = out->len;
  text_printf(out, "usage: stickslip %s%s%s", c->name, *c->operands ? " " : "", c->operands);
  for (int k = 0; k < n_option_rows; k++) {
    const struct option_row *row = &option_table[k];
    if (!option_belongs(row, c->name) || stands_among_operands(c, row)) continue;
    text_reset(&item);
    text_printf(&item, " [%s%s%s]", row->name, row->value ? " " : "", row->value ? row->value : "");
    if (out->len - begin + item.len > WIDTH) {
      text_add_char(out, '\n');
      begin = out->len;
      text_printf(out, "%*s", (int)strlen("usage: stickslip"), "");
    }
    text_add(out, text_str(&item));
  }
  text_add_char(out, '\n');
}

static void add_options(struct text *out, const struct command *c) {
  text_add(out, "\noptions:\n");
  for (int k = 0; k < n_option_rows; k++) {
    const struct option_row *row = &option_table[k];
    if (!option_belongs(row, c->name)) continue;
    text_printf(out, "  %s%s%s\n", row->name, row->value ? " " : "", row->value ? row->value : "");
    add_paragraph(out, strlen("      "), "      %s", row->text);
  }
}

static void add_statuses(struct text *out) {
  text_add(out, "\nexit status:\n");
  for (int i = 0; i < N_STATUSES; i++)
    add_paragraph(out, strlen("  0  "), "  %d  %s", statuses[i].number, statuses[i].text);
}

void help_page(const struct command *c) {
  struct text out = {0}, about = {0};
  add_usage(&out, c);
  describe(&about, c);
  for (const char *p = text_str(&about); *p; p += strspn(p, "\n")) {
    size_t len = strcspn(p, "\n");
    text_add_char(&out, '\n');
    add_paragraph(&out, 0, "%.*s", (int)len, p);
    p += len;
  }
  add_options(&out, c);
  text_printf(&out, "\nexamples:\n  %s\n  %s\n", c->example[0], c->example[1]);
  add_statuses(&out);
  terminal_print(&out);
  text_clear(&about);
}

static void overview(void) {
  struct text out = {0}, line = {0};
  text_add(&out, "stickslip " SS_VERSION ": audits a paper on stick-slip orbits of two masses on a belt\n"
                 "usage: stickslip COMMAND [OPERAND...] [OPTION...] | COMMAND --help | --version\n");
  for (int i = 0; i < n_commands; i++)
    text_printf(&out, "  %-10s %s\n", command_table[i].name, command_table[i].purpose);
  for (int i = 0; i < N_STATUSES; i++)
    text_printf(&line, "%s %d %s", i ? ";" : "", statuses[i].number, statuses[i].brief);
  add_paragraph(&out, strlen("exit status: "), "exit status:%s", text_str(&line));
  terminal_print(&out);
  text_clear(&line);
}

/* Each row is one of: COMMAND usage OPERANDS PURPOSE, COMMAND text - PARAGRAPH, COMMAND example - LINE, COMMAND
   --OPTION VALUE TEXT; behind the commands, - status NUMBER TEXT.  "-" is an empty field. */
static void print_table(void) {
  OWNED(text) about = {0};
  for (int i = 0; i < n_commands; i++) {
    const struct command *c = &command_table[i];
    printf("%s\tusage\t%s\t%s\n", c->name, or_dash(c->operands), c->purpose);
    text_reset(&about);
    describe(&about, c);
    for (char *end, *p = strtok_r(about.data, "\n", &end); p; p = strtok_r(NULL, "\n", &end))
      printf("%s\ttext\t-\t%s\n", c->name, p);
    for (int k = 0; k < 2; k++) printf("%s\texample\t-\t%s\n", c->name, c->example[k]);
    for (int k = 0; k < n_option_rows; k++)
      if (option_belongs(&option_table[k], c->name))
        printf("%s\t%s\t%s\t%s\n", c->name, option_table[k].name, option_table[k].value ? option_table[k].value : "-",
               option_table[k].text);
  }
  for (int i = 0; i < N_STATUSES; i++) printf("-\tstatus\t%d\t%s\n", statuses[i].number, statuses[i].text);
}

const struct command *find_command(const char *name) {
  struct suggestion meant;
  suggest_begin(&meant, name, strlen(name));
  for (int i = 0; i < n_commands; i++) {
    if (strcmp(command_table[i].name, name) == 0) return &command_table[i];
    suggest_try(&meant, command_table[i].name);
  }
  usage_unknown("unknown command %s", &meant);
  return NULL;
}

int help(int argc, char **argv) {
  if (argc > 1) return usage("help takes one command, not %.200s too", argv[1]);
  if (argc == 1 && strcmp(argv[0], "--table") == 0) {
    print_table();
  } else if (argc == 1) {
    const struct command *c = find_command(argv[0]);
    if (!c) return EXIT_USAGE;
    help_page(c);
  } else {
    overview();
  }
  return EXIT_AS_RECORDED;
}
