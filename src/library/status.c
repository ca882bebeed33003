/* The last failure of each thread, and what else belongs to no handle. */
#include <mpfr.h>
#include <string.h>

#include "library.h"

static _Thread_local char last[sizeof((struct diag *)0)->message];

/* A diag's message is cut where a reader loses least; the same is done here. */
int library_fail(int status, const char *fmt, ...) {
  va_list ap;
  va_start(ap, fmt);
  vsnprintf(last, sizeof last, fmt, ap);
  va_end(ap);
  last[text_valid_prefix(last, strlen(last))] = '\0';
  return status;
}

int library_input(const struct diag *d) {
  return library_fail(SS_INPUT, "%s", d->message);
}

int library_argument(const char *function, const char *what) {
  return library_fail(SS_ARGUMENT, "%s: %s", function, what);
}

int library_digits(const char *function, size_t digits, size_t most) {
  if (digits >= 1 && digits <= most) return SS_OK;
  return library_fail(SS_ARGUMENT, "%s: from 1 to %zu digits can be had", function, most);
}

char *library_take(struct text *t) {
  if (!t->data) text_add(t, "");
  char *data = t->data;
  text_init(t);
  return data;
}

const char *ss_error(void) {
  return last;
}

const char *ss_status_text(int status) {
  static const char *const text[] = {
      "ok",
      "the value does not exist",
      "it could not be told or held",
      "the value does not exist; it could not be told or held",
  };
  static const struct {
    int code;
    const char *text;
  } call[] = {{SS_ARGUMENT, "a wrong argument"}, {SS_INPUT, "a wrong input"}, {SS_STOPPED, "stopped by the caller"}};
  for (size_t i = 0; i < sizeof call / sizeof *call; i++)
    if (status == call[i].code) return call[i].text;
  return status >= 0 && status < 4 ? text[status] : "no status of this library";
}

const char *ss_version(void) {
  return SS_VERSION;
}

void ss_text_free(char *text) {
  free(text);
}

void ss_cleanup(void) {
  flint_cleanup();
  mpfr_free_cache();
}
