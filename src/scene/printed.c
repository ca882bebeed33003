/* The numbers that a scene prints: decimals with the unit to which they are given (scene.h), each under its name
   once. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "scene_impl.h"

/* The unit of the last printed digit: 10^-(digits after the point), times the exponent part. */
static bool last_digit_unit(fmpq_t unit, const char *decimal) {
  OWNED(text) t = {0};
  bool any = false;
  for (const char *p = decimal; *p; p++) {
    bool digit = char_is_digit(*p);
    if (*p == 'e' || *p == 'E') {
      text_add(&t, p);
      break;
    }
    any = any || digit;
    bool last = digit && (p[1] == '\0' || p[1] == 'e' || p[1] == 'E' || (p[1] == '.' && !char_is_digit(p[2])));
    text_add_char(&t, digit ? (last ? '1' : '0') : *p);
  }
  return any && num_parse_decimal(unit, text_str(&t), t.len) == SS_OK;
}

void scene_printed_clear(struct printed_number *p) {
  free(p->name);
  free(p->decimal);
  fmpq_clear(&p->value);
  fmpq_clear(&p->digit);
  fmpq_clear(&p->unit);
}

/* A new printed number of that name, or the file's when an override prints it again; NULL when it is printed twice. */
static struct printed_number *place_of(struct scene *s, const char *name, size_t n, bool override) {
  struct printed_number *p = NULL;
  for (size_t i = 0; i < s->n_printed && !p; i++)
    if (word_is(name, n, s->printed[i].name)) p = &s->printed[i];
  if (p && (!override || p->override)) return NULL;
  if (p) {
    scene_printed_clear(p);
  } else {
    p = SS_PUSH(s->printed, s->n_printed, s->cap_printed);
  }
  *p = (struct printed_number){.name = ss_strndup(name, n), .override = override};
  fmpq_init(&p->value);
  fmpq_init(&p->digit);
  fmpq_init(&p->unit);
  return p;
}

bool scene_printed_add(struct scene *s, const struct scene_line *l, bool override, struct diag *d) {
  const char *t = l->text;
  size_t n = 0;
  while (char_is_word(t[n])) n++;
  const char *p = t + n;
  while (*p == ' ') p++;
  if (n == 0 || *p != '=' || !p[1])
    return diag_at(d, l->src, l->value.begin, "a printed line reads \"printed: NAME = DECIMAL\"");
  p++;
  while (*p == ' ') p++;
  bool negative = *p == '-';
  if (negative) p++;
  struct printed_number *pn = place_of(s, t, n, override);
  if (!pn)
    return diag_at(d, l->src, l->value.begin, "%.*s is printed twice; leave one of the lines out",
                   (int)(n < 100 ? n : 100), t);
  size_t len = strlen(p) + 2;
  pn->decimal = ss_malloc(len);
  snprintf(pn->decimal, len, "%s%s", negative ? "-" : "", p);
  if (num_parse_decimal(&pn->value, p, strlen(p)) != SS_OK || !last_digit_unit(&pn->digit, p))
    return diag_at(d, l->src, l->value.begin, "%.100s is not a decimal; write one such as -2.1958 or 2.5e-3",
                   pn->decimal);
  if (negative) fmpq_neg(&pn->value, &pn->value);
  return true;
}

static bool stands_by_itself(const struct printed_number *p) {
  return strpbrk(p->decimal, "eE") != NULL;
}

void scene_printed_align(struct scene *s) {
  const fmpq *finest = NULL;
  for (size_t i = 0; i < s->n_printed; i++) {
    const struct printed_number *p = &s->printed[i];
    if (!stands_by_itself(p) && (!finest || fmpq_cmp(&p->digit, finest) < 0)) finest = &p->digit;
  }
  for (size_t i = 0; i < s->n_printed; i++) {
    struct printed_number *p = &s->printed[i];
    fmpq_set(&p->unit, stands_by_itself(p) ? &p->digit : finest);
  }
}

const struct printed_number *scene_printed(const struct scene *s, const char *name) {
  for (size_t i = 0; i < s->n_printed; i++)
    if (strcmp(s->printed[i].name, name) == 0) return &s->printed[i];
  return NULL;
}
