/* Damaged data: each damage on file meets the fate on file; every damage that is made changes the file, reads like one
   that a transcriber makes, and stands in the record that it names; the reader of changed texts reads the same as the
   one of files. */
#include "every.h"
#include "paper_model.h"
#include "power/damage_study.h"
#include "test.h"

static struct model model; /* with the stable layer */
static struct material material;
static struct damage_study *study;

static void open_material(void) {
  paper_open();
  model = paper_model(&(struct paper_layers){.stable = "verify/stable.eq", .controls = true});
  const struct audit_data data = {&model, &the_paper.claims, &the_paper.controls, NULL, NULL};
  material_init(&material, &data, &the_paper.scene);
  study = damage_study_new(&material, NULL);
}

static void close_material(void) {
  damage_study_free(study);
  material_clear(&material);
  model_clear(&model);
  paper_close();
}

/* --- Those on file --- */

enum { FILE_, RECORD, ATTRIBUTE, WAS, NOW, TODAY, SAYS, N_COLUMNS };

static bool is_fate(const char *today, enum mutant_fate fate) {
  if (strcmp(today, "open") == 0) return fate == FATE_UNDECIDED;
  if (strcmp(today, "text") == 0) return fate == FATE_NEEDS_TEXT;
  return strcmp(today, "noticed") == 0 &&
         (fate == FATE_NOTICED || fate == FATE_REFUSED || fate == FATE_UNREADABLE || fate == FATE_UNPROVED);
}

static enum damage_class class_of(const char *attribute) {
  static const struct {
    const char *attribute;
    enum damage_class class;
  } rows[] = {{"quote", DAMAGE_QUOTATION}, {"printed", DAMAGE_PRINTED}, {"title", DAMAGE_TITLE}};
  for (size_t i = 0; i < COUNT(rows); i++)
    if (strcmp(attribute, rows[i].attribute) == 0) return rows[i].class;
  return DAMAGE_CORRECTION;
}

static const struct record *record_of(const struct record_file *f, const char *id) {
  for (size_t i = 0; i < f->n_records; i++)
    if (strcmp(f->records[i].id_name, id) == 0) return &f->records[i];
  ck_abort_msg("%s has no record %s", f->src.name, id);
}

/* The lines of the record, or of its first attribute of that name. */
static struct span lines_of(const struct record_file *f, const struct record *r, const char *attribute) {
  const struct field *field = *attribute ? record_field(r, attribute) : NULL;
  ck_assert_msg(field || !*attribute, "%s has no %s", r->id_name, attribute);
  size_t begin = field ? field->key.begin : r->kind.begin;
  size_t end = field ? field->value.end : r->fields[r->n_fields - 1].value.end;
  while (begin > 0 && f->src.text[begin - 1] != '\n') begin--;
  return (struct span){begin, end + 1};
}

/* What the row says of the text; the lines as a whole where it says nothing of what stands there. */
static struct damage damage_of(char **column) {
  size_t file = 0;
  while (file < material.n && strcmp(material.file[file].name, column[FILE_]) != 0) file++;
  ck_assert_msg(file < material.n, "%s", column[FILE_]);
  const struct record_file *f = material.file[file].parsed;
  const struct record *r = record_of(f, column[RECORD]);
  struct span at = lines_of(f, r, column[ATTRIBUTE]);
  if (*column[WAS]) {
    const char *found = strstr(f->src.text + at.begin, column[WAS]);
    size_t begin = found ? (size_t)(found - f->src.text) : at.end, end = begin + strlen(column[WAS]);
    ck_assert_msg(end <= at.end, "%s does not say %s", column[RECORD], column[WAS]);
    at = (struct span){begin, end};
  }
  return (struct damage){.class = class_of(column[ATTRIBUTE]),
                         .file = file,
                         .begin = at.begin,
                         .end = at.end,
                         .now = column[NOW],
                         .record = r->id_name,
                         .attribute = column[ATTRIBUTE]};
}

static void try_row(char **column) {
  struct damage damage = damage_of(column);
  struct damage_said said;
  damage_try(&said, study, &damage);
  ck_assert_msg(is_fate(column[TODAY], said.fate), "%s, %s: %s for %s: %s, on file %s (%s)", column[FILE_],
                column[RECORD], column[NOW], column[WAS], mutant_fate_name[said.fate], column[TODAY], said.says);
  bool silent = said.fate == FATE_UNDECIDED || said.fate == FATE_NEEDS_TEXT;
  ck_assert_msg(silent || strstr(said.says, column[SAYS]), "%s: \"%s\" is not said, but %s", column[RECORD],
                column[SAYS], said.says);
}

CASE("damage", .once = {open_material, close_material}, .seconds = 300);

TEST(each_meets_its_fate) {
  OWNED(table) damages = table_read("tests/damage.tsv", N_COLUMNS);
  ck_assert_int_eq(damages.n, 24);
  for (int i = 0; i < damages.n; i++) try_row(damages.row[i]);
}

/* --- Those that are made --- */

/* Of each class: texts that must be among the damages, and how many there must be at least. */
TABLE(made, "tests/cases/damages_made.tsv", 4);
enum { MADE, LEAST, MADE_OF, TEXT }; /* its columns */

TEST_EACH(what_is_made, made.n) {
  char *const *row = made.row[_i];
  OWNED(damages) all;
  LOCAL(text, t);
  size_t of_class = 0;
  bool found = false;
  damages_init(&all, &material, NULL, 0);
  for (size_t i = 0; i < all.n; i++) {
    const struct damage *d = &all.damage[i];
    if (strcmp(damage_classes[d->class].words, row[MADE]) != 0) continue;
    of_class++;
    if (found || strcmp(d->record, row[MADE_OF]) != 0) continue;
    text_reset(&t);
    damage_text(&t, &material, d);
    found = strstr(t.data + (d->begin > 200 ? d->begin - 200 : 0), row[TEXT]) != NULL &&
            !strstr(material.file[d->file].parsed->src.text, row[TEXT]);
  }
  ck_assert_msg(found, "%s: %s", row[MADE_OF], row[TEXT]);
  ck_assert_uint_ge(of_class, (size_t)atoi(row[LEAST]));
}

/* Each changes its file, within its record, and is told from the others of its class. */
TEST(every_damage_is_one) {
  OWNED(damages) all;
  LOCAL(text, t);
  damages_init(&all, &material, NULL, 0);
  ck_assert_uint_gt(all.n, 4000);
  for (size_t i = 0; i < all.n; i++) {
    const struct damage *d = &all.damage[i];
    const struct record_file *f = material.file[d->file].parsed;
    text_reset(&t);
    damage_text(&t, &material, d);
    ck_assert_msg(strcmp(t.data, f->src.text) != 0, "%s", d->record);
    size_t r = 0;
    while (r + 1 < f->n_records && f->records[r + 1].kind.begin <= d->begin) r++;
    ck_assert_msg(strcmp(f->records[r].id_name, d->record) == 0, "%s at %zu", d->record, d->begin);
    ck_assert(i == 0 || d->class >= all.damage[i - 1].class);
    for (size_t k = i; k > 0 && k + 40 > i; k--) {
      const struct damage *o = &all.damage[k - 1];
      bool same = o->class == d->class && o->file == d->file && o->begin == d->begin && o->end == d->end;
      ck_assert_msg(!same || strcmp(o->now, d->now) != 0, "%s, %s: twice %s", d->record, d->attribute, d->now);
    }
  }
}

/* A rule that says "the same" is held against the audit: nothing notices such a damage. */
TEST(what_says_the_same_is_not_noticed) {
  OWNED(damages) all;
  size_t with_rule = 0, tried = 0;
  damages_init(&all, &material, NULL, 0);
  for (size_t i = 0; i < all.n; i++) {
    struct damage d = all.damage[i];
    struct damage_said said;
    if (!d.rule || with_rule++ % (size_t)every(3) != 0) continue;
    d.rule = NULL;
    damage_try(&said, study, &d);
    ck_assert_msg(said.fate == FATE_UNDECIDED, "%s, %s: %s (%s): %s", d.record, d.attribute, d.now, all.damage[i].rule,
                  said.says);
    tried++;
  }
  ck_assert_uint_gt(tried, 50 / (size_t)every(3));
}

TEST(only_what_is_named) {
  static const char *const only[] = {"eq-29", "title", "controls.eq"};
  OWNED(damages) some;
  damages_init(&some, &material, only, 2);
  ck_assert_uint_gt(some.n, 10);
  for (size_t i = 0; i < some.n; i++)
    ck_assert(some.damage[i].class == DAMAGE_TITLE || strcmp(some.damage[i].record, "eq-29") == 0);
  ck_assert(damages_any(&some, &material, "title") && damages_any(&some, &material, "eq-29"));
  ck_assert(!damages_any(&some, &material, "controls.eq") && !damages_any(&some, &material, "eq-2"));
}

/* --- Texts in memory --- */

/* A comment more in a file: the same model, claims and scene. */
TEST(a_comment_changes_nothing) {
  for (size_t i = 0; i < material.n; i++) {
    OWNED(changed_material) c;
    LOCAL(text, t);
    text_add(&t, material.file[i].parsed->src.text);
    text_add(&t, "\n# nothing\n");
    goes_well(material_change(&c, &material, i, t.data, &d));
    goes_well(data_check(&c.data, &d));
    ck_assert_uint_eq(c.data.model->n_defs, model.n_defs);
    ck_assert_uint_eq(c.data.model->n_records, model.n_records);
    for (size_t k = 0; k < model.n_records; k++) ck_assert(c.data.model->records[k].rank == model.records[k].rank);
    ck_assert_uint_eq(c.data.claims->n, the_paper.claims.n);
    ck_assert_uint_eq(c.data.controls->n, the_paper.controls.n);
    ck_assert_uint_eq(c.scene->n_printed, the_paper.scene.n_printed);
  }
}
