/* Formulas in LaTeX from any bytes, every name known.  Laws: what was refused has a message; what was read and printed,
   if it is read again (long names print as words), prints the same again. */
#include <string.h>

#include "expr/latex_read.h"
#include "fuzz.h"

/* Capitals are functions; there are no differentials, which a product with d would be read as. */
static enum latex_name known(const void *context, const char *name) {
  (void)context;
  if (name[0] == 'd' && name[1]) return LATEX_UNKNOWN;
  return *name >= 'A' && *name <= 'Z' ? LATEX_FUNCTION : LATEX_VALUE;
}

static const struct latex_names names = {known, NULL};

static const struct stmt **read_formula(size_t *n, struct arena *a, const struct source *src, struct diag *d) {
  struct latex_formula f = {.src = src, .tex = {0, src->len}};
  return latex_statements(n, a, &f, &names, d);
}

static void print_and_read(const struct stmt *s) {
  LOCAL(text, once, twice);
  LOCAL(arena, a);
  OWNED(source) src;
  struct diag d = {0};
  size_t n;
  struct stmt plain = *s;
  plain.range_var = NULL; /* ranges are printed for people */
  stmt_latex(&once, &plain);
  source_from_string(&src, "printed", text_str(&once));
  const struct stmt **again = read_formula(&n, &a, &src, &d);
  fuzz_law(!again || n == 1, "one statement is printed");
  if (again) stmt_latex(&twice, again[0]);
  fuzz_law(!again || strcmp(text_str(&once), text_str(&twice)) == 0, "what is read again prints the same");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  OWNED(source) src = {.len = 0};
  struct diag d = {0};
  LOCAL(arena, a);
  size_t n;
  if (!fuzz_source(&src, data, size)) return 0;
  const struct stmt **s = read_formula(&n, &a, &src, &d);
  fuzz_law((s != NULL) != d.set, "a formula is read, or there is a message");
  for (size_t i = 0; i < n; i++) print_and_read(s[i]);
  return 0;
}
