/* System files: records as everywhere (base/record.h).

     title: three masses on a belt
     k = 1/3

     mass m1
       inertia: 1
       sliding: 1/2
       static: 3
       surface: 1
     spring wall
       between: ground, m1
       stiffness: k
     damper d1
       between: m1, m2
       constant: 1/100
     load P
       on: m1
       frequency: 3/2
       cosine: 1
       sine: 0
     obstacle o
       stops: m1
       above: 2
       restitution: 1/2

   Lines NAME = VALUE before the first record are parameters, free in name; a value is a constant expression
   (expr/constant.h) and may use the parameters above it, or an interval, k = [1/3, 2/5].  A mass is free of friction
   without the last three lines; a load is cosine cos(frequency t) + sine sin(frequency t), the two amplitudes 0 where
   not given, the frequencies of all whole multiples of one; an obstacle stands above its mass, x <= 2, or below it. */
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/record.h"
#include "expr/constant.h"
#include "mech.h"

enum { MOST_PARAMETERS = 1000, MOST_INTERVALS = 24, MOST_BYTES = 1 << 20 };

enum end { MIDDLE, LOW, HIGH };
struct parameter {
  const char *name;
  fmpq_t value;
  bool varies; /* it is an interval, or linear in one */
};
struct reader {
  struct mech *m;
  const struct source *src;
  struct diag *d;
  struct arena arena;
  struct parameter *parameter;
  size_t n_parameters, cap_parameters;
  int depth;
  size_t work;
  const struct mech_given *given; /* other values than in the file */
  bool box;                       /* intervals are welcome */
  int moved;                      /* the interval that is not at its middle, but at that end; -1: all are */
  enum end end;
};

static bool wrong(struct reader *r, size_t place, const char *what) {
  return diag_at(r->d, r->src, place, "%s", what);
}

/* --- Values --- */

static const struct parameter *parameter_named(const struct reader *r, const char *name) {
  for (size_t i = 0; i < r->n_parameters; i++)
    if (strcmp(r->parameter[i].name, name) == 0) return &r->parameter[i];
  return NULL;
}

static bool refer(fmpq_t z, void *arg, const struct constant *c, const struct expr *e) {
  const struct parameter *p = parameter_named(arg, e->name);
  if (!p)
    return diag_at(c->d, c->src, e->span.begin,
                   "unknown name %.100s; a value may use numbers and the parameters above it", e->name);
  fmpq_set(z, p->value);
  return true;
}

static struct constant constant_of(struct reader *r) {
  return (struct constant){r->src, r->d, &r->depth, &r->work, refer, "the parameters above it", r, false};
}

/* In the intervals: 0 of a number, 1 of a sum of their multiples, else 2. */
static int degree(const struct reader *r, const struct expr *e) {
  const struct parameter *p = e->kind == EXPR_SYM ? parameter_named(r, e->name) : NULL;
  if (p) return p->varies;
  int most = 0, sum = 0, first = 0;
  for (int i = 0; i < e->n_args; i++) {
    int d = degree(r, e->args[i]);
    most = d > most ? d : most;
    sum += d;
    if (i == 0) first = d;
  }
  bool keeps = e->kind == EXPR_PAREN || e->kind == EXPR_NEG || e->kind == EXPR_ADD || e->kind == EXPR_SUB ||
               (e->kind == EXPR_MUL && sum < 2) || (e->kind == EXPR_DIV && sum == first);
  return most == 0 || keeps ? most : 2;
}

static bool evaluate(fmpq_t z, struct reader *r, const struct expr *e) {
  const struct constant c = constant_of(r);
  if (!constant_eval(z, &c, e)) return false;
  return !r->m->interval || degree(r, e) < 2 ||
         constant_complain(&c, e,
                           "a value that depends on an interval is linear in it: sums, and products with numbers");
}

/* An interval more of the system: its value is the end that is asked for. */
static bool read_interval(struct parameter *p, struct reader *r, const struct mech_given *of) {
  if (!r->box)
    return diag_at(r->d, of->src, of->place,
                   "%.100s is an interval; only orbit without --certificate takes a system with one", p->name);
  struct mech_given *interval, **last = &r->m->interval;
  int number = 0;
  for (; *last; last = &(*last)->next) number++;
  if (number == MOST_INTERVALS) return diag_at(r->d, of->src, of->place, "a system has at most 24 intervals");
  interval = ss_malloc(sizeof *interval);
  *interval = (struct mech_given){.name = ss_strdup(p->name)};
  fmpq_init(interval->low);
  fmpq_init(interval->high);
  fmpq_set(interval->low, of->low);
  fmpq_set(interval->high, of->high);
  *last = interval;
  p->varies = true;
  if (number == r->moved) {
    fmpq_set(p->value, r->end == LOW ? of->low : of->high);
  } else {
    fmpq_add(p->value, of->low, of->high);
    fmpq_div_2exp(p->value, p->value, 1);
  }
  return true;
}

static bool read_value_of(struct parameter *p, struct reader *r, const struct expr *e) {
  const struct constant c = constant_of(r);
  const struct mech_given *given = r->given;
  struct mech_given own = {.src = r->src, .place = e->span.begin};
  fmpq_init(own.low);
  fmpq_init(own.high);
  while (given && strcmp(p->name, given->name) != 0) given = given->next;
  bool ok = e->kind == EXPR_MATRIX ? constant_interval(own.low, own.high, &c, e) : evaluate(p->value, r, e);
  if (ok && e->kind == EXPR_MATRIX && degree(r, e) > 0) ok = constant_complain(&c, e, "an interval's ends are numbers");
  p->varies = ok && !given && degree(r, e) > 0;
  if (!given && e->kind == EXPR_MATRIX) given = &own;
  if (ok && given && !fmpq_equal(given->low, given->high)) {
    struct mech_given of = *given; /* borrowed */
    if (!of.src) of.src = own.src;
    ok = read_interval(p, r, &of);
  } else if (ok && given) {
    fmpq_set(p->value, given->low);
  }
  fmpq_clear(own.low);
  fmpq_clear(own.high);
  return ok;
}

static bool read_parameter(struct reader *r, const struct field *f) {
  const struct stmt *s = stmt_parse(&r->arena, r->src, f->value, r->d);
  if (!s) return false;
  if (!constant_is_given(s)) return wrong(r, f->value.begin, "a parameter is written NAME = VALUE");
  const char *name = s->sides[0]->name;
  if (parameter_named(r, name)) return wrong(r, f->value.begin, "this parameter is given twice");
  if (r->n_parameters == MOST_PARAMETERS) return wrong(r, f->value.begin, "a system has at most 1000 parameters");
  r->parameter = ss_grow(r->parameter, r->n_parameters, &r->cap_parameters, sizeof *r->parameter);
  struct parameter *p = &r->parameter[r->n_parameters];
  *p = (struct parameter){.name = name};
  fmpq_init(p->value);
  bool ok = read_value_of(p, r, s->sides[1]);
  r->n_parameters++; /* from here on it has a value */
  return ok;
}

/* The value of an attribute of a record; *given where it has that attribute. */
static bool read_value(fmpq_t z, bool *given, struct reader *r, const struct record *of, const char *key) {
  const struct field *f = record_field(of, key);
  *given = f != NULL;
  if (!f) return true;
  const struct expr *e = expr_parse(&r->arena, r->src, f->value, r->d);
  return e && evaluate(z, r, e);
}

static bool need_value(fmpq_t z, struct reader *r, const struct record *of, const char *key) {
  bool given;
  if (!read_value(z, &given, r, of, key)) return false;
  if (!given)
    diag_at(r->d, r->src, of->kind.begin, "%s %s needs a line \"%s: VALUE\"", of->kind_name, of->id_name, key);
  return given;
}

/* --- Records --- */

static const char *const of_mass[] = {"inertia", "sliding", "static", "surface", NULL},
                         *const of_spring[] = {"between", "stiffness", NULL},
                         *const of_damper[] = {"between", "constant", NULL},
                         *const of_obstacle[] = {"stops", "above", "below", "restitution", NULL},
                         *const of_load[] = {"on", "frequency", "cosine", "sine", NULL};

static bool unknown_field(struct reader *r, const struct record *of, const struct field *f, const char *const *keys) {
  OWNED(text) known = {0};
  for (int k = 0; keys[k]; k++) text_printf(&known, "%s%s", k ? ", " : "", keys[k]);
  return diag_at(r->d, r->src, f->attribute ? f->key.begin : f->value.begin, "%s %s has the lines %s only%s",
                 of->kind_name[0] == 'o' ? "an" : "a", of->kind_name, text_str(&known),
                 f->attribute ? "" : ", each as \"NAME: VALUE\"");
}

static bool known_fields(struct reader *r, const struct record *of, const char *const *keys) {
  for (size_t i = 0; i < of->n_fields; i++) {
    const struct field *f = &of->fields[i];
    int k = 0;
    while (f->attribute && keys[k] && strcmp(keys[k], f->key_name) != 0) k++;
    if (!f->attribute || !keys[k]) return unknown_field(r, of, f, keys);
    if (record_field(of, f->key_name) != f) return wrong(r, f->key.begin, "this line is given twice");
  }
  return true;
}

static int mass_named(const struct mech *m, const char *name, size_t len) {
  int i = 0;
  while (i < m->n && !word_is(name, len, m->mass[i].name)) i++;
  return i;
}

static bool read_mass(struct reader *r, const struct record *of) {
  if (!known_fields(r, of, of_mass)) return false;
  if (mass_named(r->m, of->id_name, strlen(of->id_name)) < r->m->n || strcmp(of->id_name, "ground") == 0)
    return wrong(r, of->id.begin, "there is a mass, or the ground, of this name");
  struct mech_mass *mass = mech_add_mass(r->m, of->id_name);
  if (!mass) return wrong(r, of->kind.begin, "a system has at most 24 masses");
  bool given[3];
  if (!need_value(mass->inertia, r, of, "inertia") || !read_value(mass->sliding, &given[0], r, of, "sliding") ||
      !read_value(mass->limit, &given[1], r, of, "static") || !read_value(mass->surface, &given[2], r, of, "surface"))
    return false;
  mass->rubbed = given[0];
  return (given[0] == given[1] && given[1] == given[2]) ||
         wrong(r, of->kind.begin, "friction has three lines: sliding, static, and surface, the velocity of what rubs");
}

static bool no_mass(struct reader *r, const struct field *f, const char *name, size_t len) {
  return diag_at(r->d, r->src, f->value.begin, "there is no mass %.*s above this line", (int)(len < 60 ? len : 60),
                 name);
}

/* "A, B": masses, or ground. */
static bool read_ends(struct mech_link *link, struct reader *r, const struct record *of) {
  const struct field *f = record_field(of, "between");
  if (!f) return wrong(r, of->kind.begin, "what it is between is missing: \"between: ground, m1\"");
  const char *s = f->text;
  for (int side = 0; side < 2; side++) {
    size_t len;
    if (!(s = list_item(&len, s))) return wrong(r, f->value.begin, "two ends are needed: \"between: ground, m1\"");
    int i = mass_named(r->m, s, len);
    bool ground = word_is(s, len, "ground");
    if (i == r->m->n && !ground) return no_mass(r, f, s, len);
    link->end[side] = ground ? -1 : i;
    s += len;
  }
  size_t more;
  return !list_item(&more, s) || wrong(r, f->value.begin, "it has two ends");
}

static bool read_link(struct reader *r, const struct record *of, bool spring) {
  if (!known_fields(r, of, spring ? of_spring : of_damper)) return false;
  struct mech_link *link = mech_add_link(r->m, spring, of->id_name);
  if (!link) return wrong(r, of->kind.begin, "a system has at most 600 springs and 600 dampers");
  return read_ends(link, r, of) && need_value(link->size, r, of, spring ? "stiffness" : "constant");
}

/* The mass that an attribute names; NULL with d set. */
static struct mech_mass *read_name(int *at, struct reader *r, const struct record *of, const char *key) {
  const struct field *f = record_field(of, key);
  if (!f) {
    diag_at(r->d, r->src, of->kind.begin, "the mass is missing: \"%s: m1\"", key);
    return NULL;
  }
  *at = mass_named(r->m, f->text, strlen(f->text));
  if (*at < r->m->n) return &r->m->mass[*at];
  no_mass(r, f, f->text, strlen(f->text));
  return NULL;
}

static bool read_obstacle(struct reader *r, const struct record *of) {
  int at;
  if (!known_fields(r, of, of_obstacle)) return false;
  struct mech_mass *mass = read_name(&at, r, of, "stops");
  if (!mass) return false;
  bool above = record_field(of, "above") != NULL;
  if (above == (record_field(of, "below") != NULL))
    return wrong(r, of->kind.begin, "an obstacle has one line \"above: VALUE\" or \"below: VALUE\"");
  if (mass->stop[above].given) return wrong(r, of->kind.begin, "this mass has an obstacle at that side");
  struct mech_stop *stop = mech_add_stop(mass, above, of->id_name);
  return need_value(stop->position, r, of, above ? "above" : "below") &&
         need_value(stop->restitution, r, of, "restitution");
}

static bool read_load(struct reader *r, const struct record *of) {
  if (!known_fields(r, of, of_load)) return false;
  int i;
  if (!read_name(&i, r, of, "on")) return false;
  struct mech_load *load = mech_add_load(r->m, of->id_name);
  if (!load) return wrong(r, of->kind.begin, "a system has at most 600 loads");
  load->mass = i;
  bool given;
  return need_value(load->frequency, r, of, "frequency") && read_value(load->cosine, &given, r, of, "cosine") &&
         read_value(load->sine, &given, r, of, "sine");
}

static bool read_record(struct reader *r, const struct record *of) {
  if (strlen(of->id_name) >= MECH_NAME) return wrong(r, of->id.begin, "a name of more than 31 characters");
  if (strcmp(of->kind_name, "mass") == 0) return read_mass(r, of);
  if (strcmp(of->kind_name, "spring") == 0) return read_link(r, of, true);
  if (strcmp(of->kind_name, "damper") == 0) return read_link(r, of, false);
  if (strcmp(of->kind_name, "load") == 0) return read_load(r, of);
  if (strcmp(of->kind_name, "obstacle") == 0) return read_obstacle(r, of);
  return wrong(r, of->kind.begin, "a system is made of the records mass, spring, damper, load and obstacle");
}

static bool read_head(struct reader *r, const struct record *head) {
  for (size_t i = 0; i < head->n_fields; i++) {
    const struct field *f = &head->fields[i];
    if (!f->attribute) {
      if (!read_parameter(r, f)) return false;
    } else if (strcmp(f->key_name, "title") == 0) {
      free(r->m->title);
      r->m->title = ss_strdup(f->text);
    } else {
      return wrong(r, f->key.begin, "before the first record stand the title and lines NAME = VALUE");
    }
  }
  return true;
}

/* Is it a parameter of the file? */
static bool check_given(struct reader *r, const struct mech_given *given) {
  OWNED(text) says = {0};
  if (parameter_named(r, given->name)) return true;
  text_printf(&says, "the system has no parameter %.100s", given->name);
  for (size_t i = 0; i < r->n_parameters; i++) text_printf(&says, "%s%s", i ? ", " : "; it has ", r->parameter[i].name);
  return given->src ? diag_at(r->d, given->src, given->place, "%.400s", text_str(&says))
                    : diag_set(r->d, "%.300s: error: %.400s", r->src->name, text_str(&says));
}

/* Says what is physically wrong at the record that it is about. */
static bool finish(struct reader *r, const struct record_file *f) {
  const char *why, *name;
  if (mech_finish(r->m, &why, &name)) return true;
  size_t place = 0;
  for (size_t i = 1; i < f->n_records; i++)
    if (strcmp(f->records[i].id_name, name) == 0) place = f->records[i].kind.begin;
  return diag_at(r->d, r->src, place, "%s%s%s", name, *name ? ": " : "", why);
}

/* The system in which that interval is at that end. */
static bool read_system(struct mech *m, struct reader *r, const struct record_file *f, int moved, enum end end) {
  r->m = m;
  r->moved = moved;
  r->end = end;
  mech_init(m);
  bool ok = read_head(r, &f->records[0]);
  for (const struct mech_given *given = r->given; ok && given; given = given->next) ok = check_given(r, given);
  for (size_t i = 1; ok && i < f->n_records; i++) ok = read_record(r, &f->records[i]);
  ok = ok && finish(r, f);
  for (size_t i = 0; i < r->n_parameters; i++) fmpq_clear(r->parameter[i].value);
  r->n_parameters = 0;
  return ok;
}

/* What a mass does at rest, and at an obstacle, is to be the same all over the box: of these data, which are linear in
   the intervals, each is 0 everywhere or nowhere.  The mass of which that is not so; NULL: there is none. */
static const char *changes_sign(const struct mech *m) {
  NUMBERS(fmpq, reach, moved);
  for (int k = 0; k < 3 * m->n; k++) {
    const struct mech_mass *mass = &m->mass[k / 3];
    const fmpq *middle = k % 3 == 2 ? mass->surface : mass->stop[k % 3].restitution;
    fmpq_abs(reach, middle);
    for (int i = 0; i < m->n_intervals; i++) {
      const struct mech_mass *other = &m->moved[i].mass[k / 3];
      fmpq_sub(moved, k % 3 == 2 ? other->surface : other->stop[k % 3].restitution, middle);
      fmpq_abs(moved, moved);
      fmpq_sub(reach, reach, moved);
    }
    if (fmpq_sgn(reach) < 0 || (fmpq_is_zero(reach) && !fmpq_is_zero(middle))) return mass->name;
  }
  return NULL;
}

/* Both ends of each interval are to be those of a system; the upper ones are kept. */
static bool read_ends_of_intervals(struct mech *m, struct reader *r, const struct record_file *f) {
  for (const struct mech_given *i = m->interval; i; i = i->next) {
    m->moved = ss_realloc(m->moved, (size_t)(m->n_intervals + 1) * sizeof *m->moved);
    struct mech *moved = &m->moved[m->n_intervals++];
    mech_init(moved);
    for (enum end end = LOW; end <= HIGH; end++) {
      mech_clear(moved);
      if (!read_system(moved, r, f, m->n_intervals - 1, end)) return false;
    }
    const char *load = mech_other_order(m, moved);
    if (load)
      return diag_at(r->d, r->src, 0,
                     "%s: over the box the loads' frequencies are not always the same multiples of one", load);
  }
  const char *name = changes_sign(m);
  return !name ||
         diag_at(r->d, r->src, 0,
                 "%s: its surface's velocity, or a restitution, is 0 at a point of the box and not at others", name);
}

bool mech_read(struct mech *m, struct source src, const struct mech_given *given, bool box, struct diag *d) {
  struct reader r = {.d = d, .given = given, .box = box};
  OWNED(record_file) f;
  bool ok = record_file_parse(&f, src, d);
  r.src = &f.src;
  if (ok)
    ok = read_system(m, &r, &f, -1, MIDDLE) && read_ends_of_intervals(m, &r, &f);
  else
    mech_init(m);
  free(r.parameter);
  arena_clear(&r.arena);
  return ok;
}

bool mech_load_with(struct mech *m, const char *path, const struct mech_given *given, bool box, struct diag *d) {
  struct source src;
  if (source_read(&src, path, MOST_BYTES, d)) return mech_read(m, src, given, box, d);
  mech_init(m);
  return false;
}

bool mech_load(struct mech *m, const char *path, struct diag *d) {
  return mech_load_with(m, path, NULL, false, d);
}
