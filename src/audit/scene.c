/* Scene files to exact parameters.  A parameter is a constant expression, evaluated over the rationals: what was written
   is what is used, and rounding waits for the number types. */
#include "stickslip/scene.h"

#include <stdlib.h>
#include <string.h>

#include "stickslip/expr.h"
#include "stickslip/record.h"

const char *const scene_key_name[N_KEYS] = {"chi", "eta", "V", "e1", "e2", "t_a", "t_b", "t_c", "t_d", "u_r1", "u_r2"};

enum { MAX_SCENE_FILE = 1 << 20, MAX_VALUE_BITS = 200000 };

/* --- Constant expressions --- */

struct constant {
  const struct source *src;
  struct diag *d;
};

static bool constant_eval(fmpq_t z, const struct constant *c, const struct expr *e);

static bool complain(const struct constant *c, const struct expr *e, const char *what) {
  diag_at(c->d, c->src, e->span.begin, "%s", what);
  return false;
}

static bool constant_binary(fmpq_t z, const struct constant *c, const struct expr *e) {
  fmpq_t b;
  fmpq_init(b);
  bool ok = constant_eval(z, c, e->args[0]) && constant_eval(b, c, e->args[1]);
  if (ok && e->kind == EXPR_DIV && fmpq_is_zero(b)) ok = complain(c, e->args[1], "division by zero");
  if (ok) switch (e->kind) {
    case EXPR_ADD:
      fmpq_add(z, z, b);
      break;
    case EXPR_SUB:
      fmpq_sub(z, z, b);
      break;
    case EXPR_MUL:
      fmpq_mul(z, z, b);
      break;
    default:
      fmpq_div(z, z, b);
      break;
    }
  fmpq_clear(b);
  return ok;
}

static bool too_large(const fmpq_t z, int exponent) {
  unsigned long bits = fmpz_bits(fmpq_numref(z)) + fmpz_bits(fmpq_denref(z));
  return bits * (unsigned long)abs(exponent) > MAX_VALUE_BITS;
}

static bool constant_power(fmpq_t z, const struct constant *c, const struct expr *e) {
  if (!constant_eval(z, c, e->args[0])) return false;
  if (fmpq_is_zero(z) && e->exponent < 0) return complain(c, e, "division by zero");
  if (too_large(z, e->exponent)) return complain(c, e, "a value of more than 200000 bits");
  fmpq_pow_si(z, z, e->exponent);
  return true;
}

static bool constant_eval(fmpq_t z, const struct constant *c, const struct expr *e) {
  bool ok = false;
  switch (e->kind) {
  case EXPR_NUM:
    ok = num_parse_decimal(z, e->name, strlen(e->name)) == SS_OK;
    if (!ok) complain(c, e, "a number too large to hold");
    break;
  case EXPR_PAREN:
    ok = constant_eval(z, c, e->args[0]);
    break;
  case EXPR_NEG:
    ok = constant_eval(z, c, e->args[0]);
    fmpq_neg(z, z);
    break;
  case EXPR_ADD:
  case EXPR_SUB:
  case EXPR_MUL:
  case EXPR_DIV:
    ok = constant_binary(z, c, e);
    break;
  case EXPR_POW:
    ok = constant_power(z, c, e);
    break;
  default:
    complain(c, e, "a constant expression has numbers, + - * / ^ and parentheses only");
  }
  if (ok && too_large(z, 1)) ok = complain(c, e, "a value of more than 200000 bits");
  return ok;
}

bool scene_constant(fmpq_t z, const char *text, size_t len, const char *name, struct diag *d) {
  struct arena a;
  struct source src;
  arena_init(&a);
  source_from_string(&src, name, arena_strndup(&a, text, len));
  struct constant c = {&src, d};
  const struct expr *e = expr_parse(&a, &src, (struct span){0, src.len}, d);
  bool ok = e && constant_eval(z, &c, e);
  source_clear(&src);
  arena_clear(&a);
  return ok;
}

/* --- Printed numbers --- */

/* The unit of the last printed digit: 10^-(digits after the point), times the exponent part. */
static bool last_digit_unit(fmpq_t unit, const char *decimal) {
  struct text t;
  text_init(&t);
  bool any = false;
  for (const char *p = decimal; *p; p++) {
    bool digit = *p >= '0' && *p <= '9';
    if (*p == 'e' || *p == 'E') {
      text_add(&t, p);
      break;
    }
    any = any || digit;
    bool last = digit && (p[1] == '\0' || p[1] == 'e' || p[1] == 'E' || (p[1] == '.' && !(p[2] >= '0' && p[2] <= '9')));
    text_add_char(&t, digit ? (last ? '1' : '0') : *p);
  }
  bool ok = any && num_parse_decimal(unit, text_str(&t), t.len) == SS_OK;
  text_clear(&t);
  return ok;
}

static bool is_name_char(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

static bool add_printed(struct scene *s, const struct field *f, const struct source *src, struct diag *d) {
  const char *t = f->text;
  size_t n = 0;
  while (is_name_char(t[n])) n++;
  const char *p = t + n;
  while (*p == ' ') p++;
  if (n == 0 || *p != '=' || !p[1]) {
    diag_at(d, src, f->value.begin, "a printed line reads \"printed: NAME = DECIMAL\"");
    return false;
  }
  p++;
  while (*p == ' ') p++;
  bool negative = *p == '-';
  if (negative) p++;
  s->printed = ss_grow(s->printed, s->n_printed, &s->cap_printed, sizeof *s->printed);
  struct printed_number *pn = &s->printed[s->n_printed++];
  pn->name = ss_malloc(n + 1);
  memcpy(pn->name, t, n);
  pn->name[n] = '\0';
  size_t len = strlen(p) + 2;
  pn->decimal = ss_malloc(len);
  snprintf(pn->decimal, len, "%s%s", negative ? "-" : "", p);
  fmpq_init(&pn->value);
  fmpq_init(&pn->unit);
  if (num_parse_decimal(&pn->value, p, strlen(p)) != SS_OK || !last_digit_unit(&pn->unit, p)) {
    diag_at(d, src, f->value.begin, "%s is not a decimal", pn->decimal);
    return false;
  }
  if (negative) fmpq_neg(&pn->value, &pn->value);
  for (size_t i = 0; i + 1 < s->n_printed; i++)
    if (strcmp(s->printed[i].name, pn->name) == 0) {
      diag_at(d, src, f->value.begin, "%s is printed twice", pn->name);
      return false;
    }
  return true;
}

const struct printed_number *scene_printed(const struct scene *s, const char *name) {
  for (size_t i = 0; i < s->n_printed; i++)
    if (strcmp(s->printed[i].name, name) == 0) return &s->printed[i];
  return NULL;
}

/* --- The file --- */

/* [a, b] with a < b. */
static bool set_interval(struct scene *s, int key, const struct constant *c, const struct expr *e) {
  if (key >= N_SCENE_PARAMS) return complain(c, e, "only chi, eta, V, e1 and e2 can be intervals");
  if (e->rows != 1 || e->cols != 2) return complain(c, e, "an interval reads [low, high]");
  s->interval[key] = true;
  if (!constant_eval(&s->value[key], c, e->args[0]) || !constant_eval(&s->high[key], c, e->args[1])) return false;
  int order = fmpq_cmp(&s->value[key], &s->high[key]);
  if (order > 0) return complain(c, e, "the ends of the interval are in the wrong order");
  return order < 0 || complain(c, e, "the interval has no width; one number is enough");
}

static bool set_parameter(struct scene *s, const struct field *f, const struct source *src, struct arena *a,
                          struct span place[N_KEYS], struct diag *d) {
  const struct stmt *st = stmt_parse(a, src, f->value, d);
  if (!st) return false;
  if (st->kind != STMT_RELATION || st->n_sides != 2 || st->ops[0] != REL_EQ || st->sides[0]->kind != EXPR_SYM ||
      st->range_var) {
    diag_at(d, src, f->value.begin, "a scene line reads \"NAME = value\" or \"word: text\"");
    return false;
  }
  const char *name = st->sides[0]->name;
  for (int k = 0; k < N_KEYS; k++) {
    if (strcmp(name, scene_key_name[k]) != 0) continue;
    if (s->given[k]) {
      diag_at(d, src, f->value.begin, "%s is given twice", name);
      return false;
    }
    struct constant c = {src, d};
    s->given[k] = true;
    place[k] = f->value;
    if (st->sides[1]->kind == EXPR_MATRIX) return set_interval(s, k, &c, st->sides[1]);
    return constant_eval(&s->value[k], &c, st->sides[1]);
  }
  diag_at(d, src, f->value.begin,
          "unknown parameter %s; a scene sets chi, eta, V, two of e1 e2 t_a t_b t_c t_d, and may set u_r1, u_r2", name);
  return false;
}

static bool check_given(const struct scene *s, const struct source *src, const struct span place[N_KEYS],
                        struct diag *d) {
  for (int k = KEY_CHI; k <= KEY_V; k++)
    if (!s->given[k]) {
      diag_set(
          d, "%s: error: the parameter %s is missing; a scene gives chi, eta, V and two of e1, e2, t_a, t_b, t_c, t_d",
          s->path, scene_key_name[k]);
      return false;
    }
  int n = 0;
  for (int k = KEY_E1; k <= KEY_TD; k++) {
    n += s->given[k];
    if (n <= 2) continue;
    diag_at(d, src, place[k].begin, "more than two of e1, e2, t_a, t_b, t_c, t_d are given; leave %s out",
            scene_key_name[k]);
    return false;
  }
  if (n == 2) return true;
  diag_set(d, "%s: error: the parameter %s is missing; a scene gives chi, eta, V and two of e1, e2, t_a, t_b, t_c, t_d",
           s->path, s->given[KEY_E1] ? "e2" : "e1");
  return false;
}

/* The value, or the upper end of an interval. */
static const fmpq *greatest(const struct scene *s, int key) {
  return key < N_SCENE_PARAMS && s->interval[key] ? &s->high[key] : &s->value[key];
}

static bool check_domain(const struct scene *s, const struct source *src, const struct span place[N_KEYS],
                         struct diag *d) {
  if (!check_given(s, src, place, d)) return false;
  for (int k = 0; k < N_KEYS; k++)
    if (s->given[k] && k != KEY_TA && fmpq_sgn(&s->value[k]) <= 0) {
      diag_at(d, src, place[k].begin, "%s must be positive%s", scene_key_name[k], k == KEY_CHI ? " and below 1" : "");
      return false;
    }
  bool ok = fmpq_cmp_si(greatest(s, KEY_CHI), 1) < 0;
  if (!ok) diag_at(d, src, place[KEY_CHI].begin, "chi must lie strictly between 0 and 1");
  for (int i = 0; ok && i < 2; i++)
    if (s->given[KEY_U_R1 + i] && s->given[KEY_E1 + i] &&
        fmpq_cmp(&s->value[KEY_U_R1 + i], greatest(s, KEY_E1 + i)) <= 0) {
      diag_at(d, src, place[KEY_U_R1 + i].begin, "%s must exceed %s, since the sliding friction u_s is positive",
              scene_key_name[KEY_U_R1 + i], scene_key_name[KEY_E1 + i]);
      ok = false;
    }
  if (ok && scene_is_box(s) && !scene_has_forces(s)) {
    int k = 0;
    while (!s->interval[k]) k++;
    diag_at(d, src, place[k].begin, "a scene with an interval gives chi, eta, V, e1 and e2");
    ok = false;
  }
  return ok;
}

bool scene_has_forces(const struct scene *s) {
  return s->given[KEY_E1] && s->given[KEY_E2];
}

bool scene_is_box(const struct scene *s) {
  for (int k = 0; k < N_SCENE_PARAMS; k++)
    if (s->interval[k]) return true;
  return false;
}

static bool read_fields(struct scene *s, const struct record_file *f, struct diag *d) {
  if (f->n_records > 1) {
    diag_at(d, &f->src, f->records[1].kind.begin,
            "a scene has no records; \"%s %s\" is neither \"NAME = value\" nor \"word: text\"", f->records[1].kind_name,
            f->records[1].id_name);
    return false;
  }
  struct arena a;
  arena_init(&a);
  struct span place[N_KEYS] = {{0, 0}};
  const struct record *r = &f->records[0];
  bool ok = true;
  for (size_t k = 0; ok && k < r->n_fields; k++) {
    const struct field *fd = &r->fields[k];
    if (!fd->attribute) {
      ok = set_parameter(s, fd, &f->src, &a, place, d);
    } else if (strcmp(fd->key_name, "printed") == 0) {
      ok = add_printed(s, fd, &f->src, d);
    } else if (strcmp(fd->key_name, "title") == 0) {
      free(s->title);
      s->title = strdup(fd->text);
    } else {
      diag_at(d, &f->src, fd->key.begin, "unknown attribute \"%s\"; a scene has title and printed", fd->key_name);
      ok = false;
    }
  }
  arena_clear(&a);
  return ok && check_domain(s, &f->src, place, d);
}

/* The name of a scene is its file's, without folder and suffix. */
static char *name_of(const char *path) {
  const char *base = strrchr(path, '/');
  char *name = strdup(base ? base + 1 : path);
  char *dot = strrchr(name, '.');
  if (dot && strcmp(dot, ".scene") == 0 && dot > name) *dot = '\0';
  return name;
}

bool scene_load(struct scene *s, const char *spec, const char *data, struct diag *d) {
  if (!scene_load_box(s, spec, data, d)) return false;
  for (int k = 0; k < N_SCENE_PARAMS; k++)
    if (s->interval[k]) {
      diag_set(d, "%s: error: %s is an interval; only orbit and verify take one", s->path, scene_key_name[k]);
      return false;
    }
  return true;
}

bool scene_load_box(struct scene *s, const char *spec, const char *data, struct diag *d) {
  *s = (struct scene){.n_printed = 0};
  for (int k = 0; k < N_KEYS; k++) fmpq_init(&s->value[k]);
  for (int k = 0; k < N_SCENE_PARAMS; k++) fmpq_init(&s->high[k]);
  size_t len = strlen(spec);
  bool is_path = strchr(spec, '/') || (len > 6 && strcmp(spec + len - 6, ".scene") == 0);
  struct text path;
  text_init(&path);
  if (is_path)
    text_add(&path, spec);
  else
    text_printf(&path, "%s/scenes/%s.scene", data, spec);
  s->path = strdup(text_str(&path));
  s->name = name_of(s->path);
  s->title = strdup("");
  text_clear(&path);

  struct source src;
  if (!source_read(&src, s->path, MAX_SCENE_FILE, d)) return false;
  struct record_file f;
  bool ok = record_file_parse(&f, src, d) && read_fields(s, &f, d);
  record_file_clear(&f);
  return ok;
}

void scene_clear(struct scene *s) {
  for (int k = 0; k < N_KEYS; k++) fmpq_clear(&s->value[k]);
  for (int k = 0; k < N_SCENE_PARAMS; k++) fmpq_clear(&s->high[k]);
  for (size_t i = 0; i < s->n_printed; i++) {
    free(s->printed[i].name);
    free(s->printed[i].decimal);
    fmpq_clear(&s->printed[i].value);
    fmpq_clear(&s->printed[i].unit);
  }
  free(s->printed);
  free(s->name);
  free(s->path);
  free(s->title);
}
