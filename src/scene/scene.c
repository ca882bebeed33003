/* Scene files and the overrides of a command line to exact parameters.

   Both are lines with a key of the table in scene.h; an override stands in place of the file's line.  Parameters are
   gathered first and evaluated afterwards, since one may refer to another, in any order. */
#include "scene.h"

#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/record.h"
#include "base/suggest.h"
#include "scene_impl.h"

const struct scene_key_info scene_keys[N_SCENE_KEYS] = {
#define ROW(key, name, takes, meaning, used) {name, takes, meaning, used},
    SCENE_KEYS(ROW)
#undef ROW
};
const char *const scene_key_name[N_SCENE_KEYS] = {
#define NAME(key, name, takes, meaning, used) name,
    SCENE_KEYS(NAME)
#undef NAME
};
const char *const scene_takes_text[TAKES_BUDGET + 1] = {[TAKES_TEXT] = "text",
                                                        [TAKES_VALUE] = "constant expression",
                                                        [TAKES_INTERVAL] = "constant expression, or [low, high]",
                                                        [TAKES_PRINTED] = "NAME = DECIMAL",
                                                        [TAKES_CLAIMS] =
                                                            "ids and groups of claims, with commas between",
                                                        [TAKES_QUANTITIES] = "names of quantities, with commas between",
                                                        [TAKES_ROUTES] = "names of routes, with commas between",
                                                        [TAKES_DIGITS] = "whole number from 1 to 100000",
                                                        [TAKES_WORD] = "phases",
                                                        [TAKES_SYSTEM] = "name or path of a system file",
                                                        [TAKES_BUDGET] = "whole number from 1 to 10^18"};

enum state { NOT_EVALUATED, IN_EVALUATION, EVALUATED };

/* A parameter as it was written. */
struct parameter {
  const struct source *src; /* NULL: not given */
  size_t place;             /* what diagnostics about its value point to */
  const struct expr *value;
  enum state state;
};

struct reader {
  struct scene *s;
  struct diag *d;
  struct arena arena;
  struct parameter parameter[N_KEYS];
  bool overridden[N_SCENE_KEYS + 1 /* with a name of the system's: never */], read[N_SCENE_KEYS];
  bool of_system;   /* the scene names a system file */
  const char *text; /* NULL: read from the scene's path */
  const struct source *file;
  enum scene_key chain[N_KEYS]; /* parameters in evaluation, each referred to by the one before */
  int n_chain, depth;
  size_t work;
};

/* --- Values --- */

static bool evaluate(struct reader *r, enum scene_key k);

/* "e1 -> e2 -> e1", the circle that ends where it began. */
static void print_circle(struct text *out, const struct reader *r, enum scene_key back) {
  int i = 0;
  while (r->chain[i] != back) i++;
  for (; i < r->n_chain; i++) text_printf(out, "%s -> ", scene_key_name[r->chain[i]]);
  text_add(out, scene_key_name[back]);
}

/* Another parameter of the scene in an expression. */
static bool refer(fmpq_t z, void *arg, const struct constant *c, const struct expr *e) {
  struct reader *r = arg;
  int k = word_find(e->name, scene_key_name, N_KEYS);
  if (k == N_KEYS)
    return diag_at(
        c->d, c->src, e->span.begin,
        "unknown name %.100s; a value may use numbers and the scene's own chi, eta, V, e1, e2, t_a, t_b, t_c, t_d, "
        "u_r1, u_r2",
        e->name);
  if (!r->parameter[k].src)
    return diag_at(c->d, c->src, e->span.begin, "%s is used here and not given; give it, or write a number", e->name);
  if (r->parameter[k].state == IN_EVALUATION) {
    OWNED(text) circle = {0};
    print_circle(&circle, r, (enum scene_key)k);
    return diag_at(c->d, c->src, e->span.begin, "a parameter that rests on itself, %s; give one of them as a number",
                   text_str(&circle));
  }
  if (!evaluate(r, (enum scene_key)k)) return false;
  if (r->s->interval[k])
    return diag_at(c->d, c->src, e->span.begin, "%s is an interval; only a number can be used in another value",
                   e->name);
  fmpq_set(z, &r->s->value[k]);
  return true;
}

static bool set_interval(struct scene *s, enum scene_key key, const struct constant *c, const struct expr *e) {
  if (scene_keys[key].takes != TAKES_INTERVAL)
    return constant_complain(c, e, "only chi, eta, V, e1 and e2 can be intervals; give a number");
  s->interval[key] = true;
  return constant_interval(&s->value[key], &s->high[key], c, e);
}

static bool evaluate(struct reader *r, enum scene_key k) {
  struct parameter *p = &r->parameter[k];
  struct constant c = {p->src,    r->d,
                       &r->depth, &r->work,
                       refer,     "the scene's other parameters",
                       r,         scene_keys[k].takes == TAKES_INTERVAL};
  if (p->state == EVALUATED) return true;
  p->state = IN_EVALUATION;
  r->chain[r->n_chain++] = k;
  bool ok = p->value->kind == EXPR_MATRIX ? set_interval(r->s, k, &c, p->value)
                                          : constant_eval(&r->s->value[k], &c, p->value);
  r->n_chain--;
  p->state = EVALUATED;
  r->s->given[k] = true;
  return ok;
}

static bool evaluate_all(struct reader *r) {
  for (int k = 0; k < N_KEYS; k++)
    if (r->parameter[k].src && !evaluate(r, (enum scene_key)k)) return false;
  return true;
}

/* --- The domain --- */

static bool say_missing(struct reader *r, const char *name) {
  return diag_set(
      r->d,
      "%.300s: error: the parameter %s is missing; a scene gives chi, eta, V and two of e1, e2, t_a, t_b, t_c, t_d",
      r->s->path, name);
}

/* A third of the six: the last one in the file, or the one that an override adds, which also could take another
   away. */
static void say_third(struct reader *r) {
  int last = -1, added = -1;
  OWNED(text) others = {0};
  for (int k = KEY_E1; k <= KEY_TD; k++) {
    if (!r->parameter[k].src) continue;
    last = k;
    if (r->parameter[k].src != r->file) added = k;
  }
  int k = added < 0 ? last : added;
  const struct parameter *p = &r->parameter[k];
  if (added < 0) {
    diag_at(r->d, p->src, p->place, "more than two of e1, e2, t_a, t_b, t_c, t_d are given; leave %s out",
            scene_key_name[k]);
  } else {
    for (int i = KEY_E1; i <= KEY_TD; i++)
      if (r->parameter[i].src && i != k)
        text_printf(&others, "%s--set %s=", others.len ? " or " : "", scene_key_name[i]);
    diag_at(r->d, p->src, p->place,
            "more than two of e1, e2, t_a, t_b, t_c, t_d are given; take another one away with %s", text_str(&others));
  }
}

/* A scene of another system asks nothing of an audit. */
static bool check_system(struct reader *r) {
  for (int k = N_KEYS; k < N_SCENE_KEYS; k++) {
    if (!r->read[k] || k == KEY_SYSTEM || k == KEY_WORD || k == KEY_TITLE) continue;
    return diag_set(
        r->d,
        "%s: error: %s is of the paper's two masses; a scene of a system file has the lines system, title, word, "
        "and values of that file's parameters",
        r->s->path, scene_key_name[k]);
  }
  return true;
}

static bool check_given(struct reader *r) {
  for (int k = KEY_CHI; k <= KEY_V; k++)
    if (!r->parameter[k].src) return say_missing(r, scene_key_name[k]);
  int n = 0;
  for (int k = KEY_E1; k <= KEY_TD; k++) n += r->parameter[k].src != NULL;
  if (n < 2) say_missing(r, r->parameter[KEY_E1].src ? "e2" : "e1");
  if (n > 2) say_third(r);
  return n == 2;
}

/* The value, or the upper end of an interval. */
static const fmpq *greatest(const struct scene *s, int key) {
  return s->interval[key] ? &s->high[key] : &s->value[key];
}

static bool complain_about(struct reader *r, int k, const char *fmt, const char *first, const char *second) {
  return diag_at(r->d, r->parameter[k].src, r->parameter[k].place, fmt, first, second);
}

static bool check_domain(struct reader *r) {
  const struct scene *s = r->s;
  for (int k = 0; k < N_KEYS; k++)
    if (s->given[k] && k != KEY_TA && fmpq_sgn(&s->value[k]) <= 0)
      return complain_about(r, k, "%s must be positive%s", scene_key_name[k], k == KEY_CHI ? " and below 1" : "");
  if (fmpq_cmp_si(greatest(s, KEY_CHI), 1) >= 0)
    return complain_about(r, KEY_CHI, "%s must lie strictly between 0 and 1%s", "chi", "");
  for (int i = 0; i < 2; i++)
    if (s->given[KEY_U_R1 + i] && s->given[KEY_E1 + i] &&
        fmpq_cmp(&s->value[KEY_U_R1 + i], greatest(s, KEY_E1 + i)) <= 0)
      return complain_about(r, KEY_U_R1 + i, "%s must exceed %s, since the sliding friction u_s is positive",
                            scene_key_name[KEY_U_R1 + i], scene_key_name[KEY_E1 + i]);
  int k = scene_interval(s);
  return k == N_SCENE_PARAMS || scene_has_forces(s) ||
         complain_about(r, k, "a scene with an interval gives %s and %s", "chi, eta, V, e1", "e2");
}

/* --- Lines --- */

/* The names of the keys, of parameters or of others, with commas between. */
static void print_keys(struct text *out, int from, int to) {
  for (int k = from; k < to; k++) text_printf(out, "%s%s", k > from ? ", " : "", scene_key_name[k]);
}

static bool unknown_key(struct reader *r, const struct source *src, size_t at, const char *what, const char *name) {
  OWNED(text) parameters = {0}, others = {0}, says = {0};
  struct suggestion meant;
  suggest_begin(&meant, name, strlen(name));
  for (int k = 0; k < N_SCENE_KEYS; k++) suggest_try(&meant, scene_keys[k].name);
  suggest_print(&says, &meant);
  print_keys(&parameters, 0, N_KEYS);
  print_keys(&others, N_KEYS, N_SCENE_KEYS);
  return diag_at(r->d, src, at, "unknown %s %.100s%s; a scene has the parameters %s and the lines %s", what, name,
                 text_str(&says), text_str(&parameters), text_str(&others));
}

static int key_of(const char *name, size_t len) {
  int k = 0;
  while (k < N_SCENE_KEYS && !word_is(name, len, scene_key_name[k])) k++;
  return k;
}

static bool read_parameter(struct reader *r, const struct source *src, struct span where) {
  const struct stmt *st = stmt_parse(&r->arena, src, where, r->d);
  if (!st) return false;
  if (!constant_is_given(st))
    return diag_at(r->d, src, where.begin, "a scene line reads \"NAME = value\" or \"word: text\"");
  const char *name = st->sides[0]->name;
  int k = key_of(name, strlen(name));
  bool of_file = src == r->file;
  if (r->of_system) {
    struct mech_given line = {.name = name, .src = src, .place = where.begin};
    return (of_file && r->overridden[k]) || scene_system_give(r->s, &line, st->sides[1], r->file, r->d);
  }
  if (k == N_SCENE_KEYS) return unknown_key(r, src, where.begin, "parameter", name);
  if (k >= N_KEYS) return diag_at(r->d, src, where.begin, "%s is no parameter; write \"%s: ...\"", name, name);
  if (of_file && r->overridden[k]) return true;
  if (r->parameter[k].src)
    return diag_at(r->d, src, where.begin, "%s is given twice; leave one of the lines out", name);
  r->parameter[k] =
      (struct parameter){src, of_file ? where.begin : st->sides[1]->span.begin, st->sides[1], NOT_EVALUATED};
  return true;
}

/* A relative path in the scene's file starts at that file's folder, one in an override at the working directory. */
static void keep_system(struct scene *s, const struct scene_line *l, bool override) {
  OWNED(text) path = {0};
  const char *folder_end = strrchr(s->path, '/');
  if (!override && folder_end && scene_spec_is_path(l->text, SYSTEM_SUFFIX) && l->text[0] != '/')
    text_add_n(&path, s->path, (size_t)(folder_end - s->path) + 1);
  text_add(&path, l->text);
  s->system = ss_strdup(text_str(&path));
  s->system_src = l->src;
  s->system_at = l->value.begin;
}

static bool set_word(struct scene *s, struct diag *d) {
  size_t at = 0;
  const char *why, *text = s->system_word.text;
  if (!text || phase_word_parse(&s->word, &at, &why, text, strlen(text))) return true;
  return diag_at(d, s->system_word.src, s->system_word.at + at, "%s", why);
}

static bool read_line(struct reader *r, const struct scene_line *l) {
  bool override = l->src != r->file;
  if (l->key == KEY_PRINTED) return scene_printed_add(r->s, l, override, r->d);
  if (r->read[l->key])
    return diag_at(r->d, l->src, l->value.begin, "%s is given twice; leave one of the lines out",
                   scene_key_name[l->key]);
  r->read[l->key] = true;
  if (l->key == KEY_WORD) { /* read once it is known whose letters they are */
    r->s->system_word.text = ss_strdup(l->text);
    r->s->system_word.src = l->src;
    r->s->system_word.at = l->value.begin;
  }
  if (l->key == KEY_SYSTEM) keep_system(r->s, l, override);
  if (l->key == KEY_WORD || l->key == KEY_SYSTEM) return true;
  if (l->key != KEY_TITLE) return scene_read_asked(&r->s->asked, l, r->d);
  free(r->s->title);
  r->s->title = ss_strdup(l->text);
  return true;
}

/* Another word has no t_a to t_d by which it could be known. */
static bool check_word(const struct scene *s, struct diag *d) {
  if (!scene_other_word(s)) return true;
  if (scene_has_forces(s) && !scene_is_box(s)) return true;
  OWNED(text) word = {0};
  phase_word_print(&word, &s->word);
  return diag_set(d, "%s: error: a scene of the word %s gives e1 and e2, and no interval (or, of Gamma-H-C, t_a = 0)",
                  s->path, text_str(&word));
}

/* --- The file --- */

static bool read_field(struct reader *r, const struct source *src, const struct field *f) {
  if (!f->attribute) return read_parameter(r, src, f->value);
  int k = key_of(f->key_name, strlen(f->key_name));
  if (k == N_SCENE_KEYS) return unknown_key(r, src, f->key.begin, "attribute", f->key_name);
  if (k < N_KEYS)
    return diag_at(r->d, src, f->key.begin, "%s is a parameter; write \"%s = ...\"", f->key_name, f->key_name);
  if (r->overridden[k]) return true;
  return read_line(r, &(struct scene_line){(enum scene_key)k, src, f->value, f->text});
}

static bool read_fields(struct reader *r, const struct record_file *f) {
  if (f->n_records > 1)
    return diag_at(r->d, r->file, f->records[1].kind.begin,
                   "a scene has no records; \"%s %s\" is neither \"NAME = value\" nor \"word: text\"",
                   f->records[1].kind_name, f->records[1].id_name);
  const struct record *all = &f->records[0];
  if (!r->overridden[KEY_SYSTEM]) r->of_system = record_field(all, scene_key_name[KEY_SYSTEM]) != NULL;
  for (size_t k = 0; k < all->n_fields; k++)
    if (!read_field(r, r->file, &all->fields[k])) return false;
  return true;
}

static const struct source *keep_source(struct scene *s, const struct source *src) {
  struct source *kept = ss_malloc(sizeof *kept);
  *kept = *src;
  *SS_PUSH(s->source, s->n_sources, s->cap_sources) = kept;
  return kept;
}

/* The same demands on a text as source_read makes on a file. */
static bool take_text(struct source *src, struct reader *r) {
  bool ok = strlen(r->text) <= MAX_SCENE_FILE;
  source_from_string(src, r->s->path, ok ? r->text : "");
  if (!ok) diag_set(r->d, "%.300s: error: longer than %d bytes", r->s->path, MAX_SCENE_FILE);
  ok = ok && source_check(src, r->d);
  if (!ok) source_clear(src);
  return ok;
}

static bool read_file(struct reader *r) {
  struct source src;
  if (!(r->text ? take_text(&src, r) : source_read(&src, r->s->path, MAX_SCENE_FILE, r->d))) return false;
  r->file = keep_source(r->s, &src);
  source_from_string(&src, r->file->name, r->file->text);
  OWNED(record_file) f;
  return record_file_parse(&f, src, r->d) && read_fields(r, &f);
}

/* --- Overrides --- */

struct override {
  const struct source *src;
  int key;
  struct span name, value;
};

static void trim(const char *text, struct span *w) {
  while (w->begin < w->end && scene_blank(text[w->begin])) w->begin++;
  while (w->end > w->begin && scene_blank(text[w->end - 1])) w->end--;
}

/* NAME=VALUE; no other override of the list bears a name of the table.  Only printed may come again: each gives a
   number beside the file's, and an empty one takes away the file's alone, wherever it stands among them. */
static bool split_override(struct reader *r, struct override *o, const char *item, const char *option) {
  struct source src;
  source_from_string(&src, option, item);
  o->src = keep_source(r->s, &src);
  size_t good = text_plain_prefix(item, o->src->len, false);
  const char *equals = strchr(item, '=');
  if (good < o->src->len || !equals)
    return diag_at(r->d, o->src, good < o->src->len ? good : 0,
                   equals ? "a control character, or not UTF-8 text; write plain text"
                          : "%s takes NAME=VALUE, as in e2=1/2",
                   option);
  o->name = (struct span){0, (size_t)(equals - item)};
  o->value = (struct span){o->name.end + 1, o->src->len};
  trim(item, &o->name);
  trim(item, &o->value);
  o->key = key_of(item + o->name.begin, o->name.end - o->name.begin);
  if (o->key == N_SCENE_KEYS) return true; /* a parameter of a system file, or an error once the file has been read */
  if (r->overridden[o->key] && o->key != KEY_PRINTED)
    return diag_at(r->d, o->src, o->name.begin, "%s is given twice with %s; leave one of them out",
                   scene_key_name[o->key], option);
  if (o->key == KEY_SYSTEM) r->of_system = o->value.begin < o->value.end;
  r->overridden[o->key] |= o->key != KEY_PRINTED || o->value.begin == o->value.end;
  r->s->changed |= o->key < N_KEYS || o->key == KEY_PRINTED || o->key == KEY_WORD;
  return true;
}

/* A name that is none of the table's: of a parameter of the scene's system. */
static bool apply_other(struct reader *r, const struct override *o) {
  const char *name = o->src->text + o->name.begin;
  size_t len = o->name.end - o->name.begin;
  if (r->of_system && o->value.begin < o->value.end)
    return read_parameter(r, o->src, (struct span){o->name.begin, o->value.end});
  if (r->of_system && scene_system_take(r->s, name, len)) return true;
  char shown[101];
  snprintf(shown, sizeof shown, "%.*s", (int)(len < 100 ? len : 100), name);
  if (r->of_system)
    return diag_at(r->d, o->src, o->name.begin, "the scene gives no value of %s that could be taken away", shown);
  return unknown_key(r, o->src, o->name.begin, "name", shown);
}

static bool apply_override(struct reader *r, const struct override *o) {
  if (o->key == N_SCENE_KEYS) return apply_other(r, o);
  if (o->value.begin == o->value.end) return true;
  if (o->key < N_KEYS) return read_parameter(r, o->src, (struct span){o->name.begin, o->value.end});
  OWNED(text) value = {0};
  text_add_n(&value, o->src->text + o->value.begin, o->value.end - o->value.begin);
  return read_line(r, &(struct scene_line){(enum scene_key)o->key, o->src, o->value, text_str(&value)});
}

static bool read_all(struct reader *r, const struct scene_overrides *o) {
  int n = o ? o->n : 0;
  FREED struct override *list = ss_malloc((size_t)(n + 1) * sizeof *list);
  bool ok = true;
  for (int i = 0; ok && i < n; i++) ok = split_override(r, &list[i], o->item[i], o->option);
  ok = ok && read_file(r);
  for (int i = 0; ok && i < n; i++) ok = apply_override(r, &list[i]);
  scene_printed_align(r->s);
  if (ok && r->s->system) return check_system(r);
  return ok && set_word(r->s, r->d) && check_given(r) && evaluate_all(r) && check_domain(r) && check_word(r->s, r->d);
}

bool scene_constant(fmpq_t z, const char *text, size_t len, const char *name, struct diag *d) {
  LOCAL(arena, a);
  OWNED(source) src;
  int depth = 0;
  size_t work = 0;
  source_from_string(&src, name, arena_strndup(&a, text, len));
  struct constant c = {.src = &src, .d = d, .depth = &depth, .work = &work};
  const struct expr *e = expr_parse(&a, &src, (struct span){0, src.len}, d);
  return e && constant_eval(z, &c, e);
}

/* --- Scenes --- */

static bool load(struct scene *s, const char *spec, const char *text, const char *data, const struct scene_overrides *o,
                 enum scene_welcome any, struct diag *d) {
  *s = (struct scene){.n_printed = 0};
  for (int k = 0; k < N_KEYS; k++) fmpq_init(&s->value[k]);
  for (int k = 0; k < N_SCENE_PARAMS; k++) fmpq_init(&s->high[k]);
  scene_set_names(s, spec, data, o);
  s->title = ss_strdup("");
  struct reader r = {.s = s, .d = d, .text = text};
  bool ok = !path_has_suffix(spec, SYSTEM_SUFFIX) ||
            diag_set(d, "%.300s: error: a system file; a scene of it is a file with the line \"system: FILE\"", spec);
  ok = ok && (text || scene_is_there(s, spec, data, d)) && read_all(&r, o);
  arena_clear(&r.arena);
  bool exact = any == SCENE_EXACT || any == SCENE_EXACT_OR_SYSTEM, system = any >= SCENE_EXACT_OR_SYSTEM;
  if (!ok || !s->system) return ok && (!exact || (scene_one_point(s, d) && scene_papers_word(s, d)));
  if (!system)
    diag_set(d,
             "%s: error: a scene of the system file %s; only orbit, jacobian, words, simulate, plot and bifurcate take "
             "such a scene",
             s->path, s->system);
  return system;
}

bool scene_load_with(struct scene *s, const char *spec, const char *data, const struct scene_overrides *o,
                     enum scene_welcome any, struct diag *d) {
  return load(s, spec, NULL, data, o, any, d);
}

bool scene_load_text(struct scene *s, const char *name, const char *text, const struct scene_overrides *o,
                     enum scene_welcome any, struct diag *d) {
  OWNED(text) path = {0};
  text_printf(&path, "%s.scene", name);
  return load(s, text_str(&path), text, "", o, any, d);
}

bool scene_lacks_orbit(const struct scene *s, slong orbit, slong n, struct diag *d) {
  if (n)
    return diag_set(d, "%s: error: there is no orbit %ld; %ld %s found", s->path, (long)orbit + 1, (long)n,
                    n == 1 ? "is" : "are");
  return diag_set(d, s->system ? "%s: error: no orbit is found" : "%s: error: there is no orbit", s->path);
}

void scene_clear(struct scene *s) {
  for (int k = 0; k < N_KEYS; k++) fmpq_clear(&s->value[k]);
  for (int k = 0; k < N_SCENE_PARAMS; k++) fmpq_clear(&s->high[k]);
  for (size_t i = 0; i < s->n_printed; i++) scene_printed_clear(&s->printed[i]);
  free(s->printed);
  free(s->system);
  free(s->system_word.text);
  scene_system_clear(s);
  scene_asked_clear(&s->asked);
  for (size_t i = 0; i < s->n_sources; i++) {
    source_clear(s->source[i]);
    free(s->source[i]);
  }
  free(s->source);
  free(s->name);
  free(s->file);
  free(s->command);
  free(s->folder);
  free(s->path);
  free(s->title);
}
