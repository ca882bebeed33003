/* A point changed by words: "chi=1/2,V=2". */
#include "point.h"

#include <string.h>

#include "base/suggest.h"

/* Quantities that --at can set, and the point's quantity they are. */
static const struct {
  const char *name;
  int q;
} settable[] = {{"chi", Q_CHI},  {"eta", Q_ETA}, {"V", Q_V},     {"e1", Q_E1},   {"e2", Q_E2},    {"u_s1", Q_US1},
                {"u_s2", Q_US2}, {"t", Q_T},     {"s", Q_S},     {"x", Q_X},     {"y", Q_Y},      {"lambda", Q_LAMBDA},
                {"z_1", Q_Z1},   {"z_2", Q_Z2},  {"z_10", Q_Z1}, {"z_20", Q_Z2}, {"z_1'", Q_DZ1}, {"z_2'", Q_DZ2}};

enum { N_SETTABLE = sizeof settable / sizeof *settable };

/* p/q or a decimal with a sign. */
static bool parse_value(fmpq *z, const char *s, size_t len) {
  bool negative = len > 0 && *s == '-';
  if (negative) s++, len--;
  const char *slash = memchr(s, '/', len);
  fmpq_t den;
  fmpq_init(den);
  fmpq_one(den);
  bool ok = num_parse_decimal(z, s, slash ? (size_t)(slash - s) : len) == SS_OK;
  if (ok && slash) ok = num_parse_decimal(den, slash + 1, len - (size_t)(slash + 1 - s)) == SS_OK && !fmpq_is_zero(den);
  if (ok) fmpq_div(z, z, den);
  if (ok && negative) fmpq_neg(z, z);
  fmpq_clear(den);
  return ok;
}

/* The error of an item of which len bytes may be a name; of one that is not known, which there are. */
static bool complain(const char *item, size_t len, struct diag *d) {
  struct suggestion meant;
  struct text says = {0};
  bool known = item[len] != '=';
  size_t whole = strcspn(item, ",");
  suggest_begin(&meant, item, len);
  for (size_t i = 0; i < N_SETTABLE; i++) {
    known |= strlen(settable[i].name) == len && strncmp(settable[i].name, item, len) == 0;
    suggest_try(&meant, settable[i].name);
  }
  if (!known) suggest_print(&says, &meant);
  for (size_t i = 0; !known && i < N_SETTABLE; i++)
    text_printf(&says, "%s %s", i ? "," : "; names are", settable[i].name);
  diag_set(d, "error: --at takes NAME=VALUE,..., values like 1/2 or 0.8, not %.*s%s", (int)(whole > 80 ? 80 : whole),
           item, text_str(&says));
  text_clear(&says);
  return false;
}

bool point_set(struct point *p, const char *at, struct diag *d) {
  bool given[N_SETTABLE] = {false};
  for (const char *s = at; s && *s;) {
    size_t n = strcspn(s, ","), name = strcspn(s, "=");
    bool ok = false;
    for (size_t i = 0; name < n && i < N_SETTABLE; i++)
      if (strlen(settable[i].name) == name && strncmp(settable[i].name, s, name) == 0) {
        if (given[i]) {
          diag_set(d, "error: --at gives %s twice", settable[i].name);
          return false;
        }
        given[i] = true;
        ok = parse_value(&p->q[settable[i].q], s + name + 1, n - name - 1);
      }
    if (!ok) return complain(s, name < n ? name : n, d);
    s += n;
    if (*s == ',') s++;
  }
  if (dyn_in_domain(p->q + Q_CHI, N_PARAMS)) return true;
  diag_set(d, "error: --at leaves the domain 0 < chi < 1, eta, V, e1, e2 > 0");
  return false;
}
