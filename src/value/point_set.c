/* A point changed by words: "chi=1/2,V=2". */
#include "point.h"

#include <string.h>

#include "base/suggest.h"

/* p/q or a decimal with a sign. */
static bool parse_value(fmpq *z, const char *s, size_t len) {
  bool negative = len > 0 && *s == '-';
  if (negative) s++, len--;
  const char *slash = memchr(s, '/', len);
  NUMBERS(fmpq, den);
  fmpq_one(den);
  bool ok = num_parse_decimal(z, s, slash ? (size_t)(slash - s) : len) == SS_OK;
  if (ok && slash) ok = num_parse_decimal(den, slash + 1, len - (size_t)(slash + 1 - s)) == SS_OK && !fmpq_is_zero(den);
  if (ok) fmpq_div(z, z, den);
  if (ok && negative) fmpq_neg(z, z);
  return ok;
}

bool point_told(fmpq_t z, const char *at, const char *name) {
  size_t len = strlen(name);
  for (const char *s = at; s && *s; s += strcspn(s, ","), s += *s == ',')
    if (strncmp(s, name, len) == 0 && s[len] == '=') return parse_value(z, s + len + 1, strcspn(s, ",") - len - 1);
  return false;
}

/* The names that can be set: the model's quantities, or the own symbols of a paper about another system. */
static const char *settable_name(size_t *i, const struct point *p) {
  if (point_of_model(p)) {
    const struct point_quantity *row = point_settable(i);
    return row ? row->key : NULL;
  }
  const struct symbol *s = point_own(i, p, NULL, NULL);
  return s ? s->name : NULL;
}

/* The error of an item of which len bytes may be a name; of one that is not known, which there are. */
static bool complain(const struct point *p, const char *item, size_t len, struct diag *d) {
  struct suggestion meant;
  OWNED(text) says = {0};
  bool known = item[len] != '=';
  size_t whole = strcspn(item, ",");
  const char *name;
  suggest_begin(&meant, item, len);
  for (size_t i = 0; (name = settable_name(&i, p)) != NULL; i++) {
    known |= word_is(item, len, name);
    suggest_try(&meant, name);
  }
  if (!known) suggest_print(&says, &meant);
  const char *before = "; names are ";
  for (size_t i = 0; !known && (name = settable_name(&i, p)) != NULL; i++, before = ", ")
    text_printf(&says, "%s%s", before, name);
  return diag_set(d, "error: --at takes NAME=VALUE,..., values like 1/2 or 0.8, not %.*s%s",
                  (int)(whole > 80 ? 80 : whole), item, text_str(&says));
}

/* Whether an item before s gives the name of len bytes there. */
static bool is_told_before(const char *at, const char *s, size_t len) {
  for (; at < s; at += strcspn(at, ",") + 1)
    if (strncmp(at, s, len + 1) == 0) return true;
  return false;
}

/* A quantity of the model that is none of the point's, since others determine it there, would be ignored. */
static bool take_quantity(struct point *p, const struct point_quantity *row, const char *value, size_t len,
                          struct diag *d) {
  if (!parse_value(&p->q[row->q], value, len)) return false;
  if (row->q != Q_S && !((row->shown | row->certified | row->if_read) >> p->kind & 1U))
    diag_set(d, "error: --at cannot set %s here, where it follows from the others", row->key);
  return true;
}

/* The item's value is taken by the i-th of the names. */
static bool take(struct point *p, size_t i, const char *value, size_t len, struct diag *d) {
  if (point_of_model(p)) return take_quantity(p, point_settable(&i), value, len, d);
  const struct symbol *s = &p->paper->symbols[i];
  NUMBERS(fmpq, z);
  bool ok = parse_value(z, value, len);
  if (ok && !symbol_takes(s, z))
    diag_set(d, "error: --at leaves the domain of %s, \"%s\"", s->name, record_get(s->record, "domain"));
  return ok;
}

bool point_set(struct point *p, const char *at, struct diag *d) {
  for (const char *s = at; s && *s;) {
    size_t n = strcspn(s, ","), len = strcspn(s, "=");
    bool ok = false;
    const char *name;
    for (size_t i = 0; len < n && !ok && (name = settable_name(&i, p)) != NULL; i++) {
      if (strlen(name) != len || strncmp(name, s, len) != 0) continue;
      if (is_told_before(at, s, len)) return diag_set(d, "error: --at gives %s twice", name);
      ok = take(p, i, s + len + 1, n - len - 1, d);
      if (!ok) break;
    }
    if (!ok) return complain(p, s, len < n ? len : n, d);
    if (d->set) return false;
    s += n;
    if (*s == ',') s++;
  }
  if (!point_of_model(p)) p->at = at;
  if (!point_of_model(p) || dyn_in_domain(p->q + Q_CHI, N_PARAMS)) return true;
  return diag_set(d, "error: --at leaves the domain 0 < chi < 1, eta, V, e1, e2 > 0");
}
