/* Records, statements and expressions from any bytes.  Laws: what was refused has a message and a place; what was read
   prints to text that reads as the same. */
#include <string.h>

#include "base/record.h"
#include "expr/expr.h"
#include "fuzz.h"

static void print_and_read(const struct stmt *s) {
  LOCAL(text, once, twice);
  LOCAL(arena, a);
  OWNED(source) src;
  struct diag d = {0};
  stmt_print(&once, s);
  source_from_string(&src, "printed", text_str(&once));
  const struct stmt *again = stmt_parse(&a, &src, (struct span){0, src.len}, &d);
  fuzz_law(again != NULL, "what is printed can be read");
  stmt_print(&twice, again);
  fuzz_law(strcmp(text_str(&once), text_str(&twice)) == 0, "what is read again prints the same");
  text_reset(&twice);
  stmt_latex(&twice, s);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  struct source src;
  struct diag d = {0};
  LOCAL(arena, a);
  if (!fuzz_source(&src, data, size)) return 0;
  OWNED(record_file) f;
  bool ok = record_file_parse(&f, src, &d);
  fuzz_law(ok != d.set, "a file is read, or there is a message");
  for (size_t i = 0; ok && i < f.n_records; i++)
    for (size_t k = 0; k < f.records[i].n_fields; k++) {
      const struct field *fd = &f.records[i].fields[k];
      struct diag each = {0};
      const struct stmt *s = stmt_parse(&a, &f.src, fd->value, &each);
      fuzz_law((s != NULL) != each.set, "a statement is read, or there is a message");
      if (s) print_and_read(s);
      diag_init(&each);
      const struct expr *e = expr_parse(&a, &f.src, fd->value, &each);
      fuzz_law((e != NULL) != each.set, "an expression is read, or there is a message");
    }
  return 0;
}
