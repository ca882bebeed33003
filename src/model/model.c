/* Equation files in memory: definitions and statement records with their rank, and who sees which of them.
   Nothing is replaced when an overlay is loaded; a view decides at each look-up, so that one model serves the printed
   text, the corrected text, and every mixture that a claim needs. */
#include "symbol.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char *const layer_name[N_LAYERS] = {"printed", "corrected", "stable"};

enum { MAX_EQ_FILE = 4 << 20 };

void model_init(struct model *m) {
  *m = (struct model){.options = ""};
}

struct model model_noting(struct model_use *use, const struct model *m) {
  struct model noting = *m;
  use->def = memset(ss_malloc(m->n_defs + 1), false, m->n_defs + 1);
  use->record = memset(ss_malloc(m->n_records + 1), false, m->n_records + 1);
  noting.use = use;
  return noting;
}

struct model model_unnoted(const struct model *m) {
  struct model unnoted = *m;
  unnoted.use = NULL;
  return unnoted;
}

void model_use_clear(struct model_use *use) {
  free(use->def);
  free(use->record);
}

bool model_use_has(const struct model_use *use, const struct model *m, size_t record) {
  bool has = use->record[record];
  for (size_t i = 0; !has && i < m->n_defs; i++) has = use->def[i] && m->defs[i].record == m->records[record].record;
  return has;
}

void model_clear(struct model *m) {
  for (size_t i = 0; i < m->n_files; i++) {
    record_file_clear(m->files[i]);
    free(m->files[i]);
  }
  free(m->files);
  free(m->ranks);
  free(m->defs);
  free(m->records);
  symbols_clear(m->symbols, m->n_symbols);
  arena_clear(&m->arena);
}

bool model_is_symbol(const struct model *m, const char *name) {
  for (size_t i = 0; i < m->n_symbols; i++)
    if (strcmp(m->symbols[i].name, name) == 0) return true;
  return false;
}

const struct statement_record *model_statements(const struct model *m, const struct record *r) {
  for (size_t i = 0; i < m->n_records; i++)
    if (m->records[i].record == r) return &m->records[i];
  return NULL;
}

const struct symbol *model_own_symbol(const struct model *m, const char *name) {
  for (size_t i = 0; m->n_own && i < m->n_symbols; i++)
    if (strcmp(m->symbols[i].name, name) == 0) return m->symbols[i].has_domain ? &m->symbols[i] : NULL;
  return NULL;
}

static const char *or_empty(const char *s) {
  return s ? s : "";
}

/* Where definitions of that name stand.  A name is looked up some hundred thousand times in an audit. */
static size_t bucket_of(const char *name) {
  unsigned h = 2166136261U;
  for (const char *p = name; *p; p++) h = (h ^ (unsigned char)*p) * 16777619U;
  return (h ^ h >> 16) % MODEL_BUCKETS;
}

static bool is_defined(const struct model *m, const char *name) {
  size_t i = m->bucket[bucket_of(name)].first;
  while (i && strcmp(m->defs[i - 1].name, name) != 0) i = m->defs[i - 1].next;
  return i > 0;
}

static const char own_and_defined[] = "%s has a domain as a symbol, and is not defined besides";

/* A definition of the same name, section, rank and record kind twice is a mistake of the file. */
static bool add_definition(struct model *m, struct definition def, struct diag *d) {
  size_t b = bucket_of(def.name);
  bool pi = strcmp(def.name, expr_pi) == 0;
  if (pi || model_own_symbol(m, def.name))
    return diag_at(d, def.src, def.stmt->span.begin, pi ? "%s is the number and is not defined" : own_and_defined,
                   def.name);
  for (size_t i = m->bucket[b].first; i; i = m->defs[i - 1].next) {
    const struct definition *o = &m->defs[i - 1];
    if (o->rank == def.rank && def.rank != RANK_CONTROL && strcmp(o->name, def.name) == 0 &&
        strcmp(o->section, def.section) == 0)
      return diag_at(d, def.src, def.stmt->span.begin, "%s is defined twice in section %s", def.name,
                     *def.section ? def.section : "(none)");
  }
  *SS_PUSH(m->defs, m->n_defs, m->cap_defs) = def;
  *(m->bucket[b].last ? &m->defs[m->bucket[b].last - 1].next : &m->bucket[b].first) = m->n_defs;
  m->bucket[b].last = m->n_defs;
  return true;
}

/* Registers what a statement defines: a definition, a root, or the unknown functions of a trajectory. */
static bool register_names(struct model *m, struct definition def, const struct stmt *s, struct diag *d) {
  if (s->kind == STMT_TRAJECTORY) {
    for (int i = 0; i < s->n_names; i++) {
      def.name = s->names[i];
      if (!add_definition(m, def, d)) return false;
    }
    return true;
  }
  def.name = s->name;
  return add_definition(m, def, d);
}

/* "name = expr" in a define record is a definition, though it reads as a relation elsewhere. */
static const struct stmt *as_definition(struct model *m, const struct stmt *s) {
  if (s->kind != STMT_RELATION || s->n_sides != 2 || s->ops[0] != REL_EQ || s->sides[0]->kind != EXPR_SYM ||
      s->range_var)
    return s;
  struct stmt *def = arena_alloc(&m->arena, sizeof *def);
  *def = *s;
  def->kind = STMT_DEFINE;
  def->name = s->sides[0]->name;
  def->name_span = s->sides[0]->span;
  const struct expr **side = arena_alloc(&m->arena, sizeof *side);
  side[0] = s->sides[1];
  def->sides = side;
  def->n_sides = 1;
  return def;
}

/* A misspelt attribute would go unnoticed, and with it a section or an equation number. */
static bool check_attributes(const struct record_file *f, const struct record *r, const char *const *known, int n,
                             struct diag *d) {
  for (size_t k = 0; k < r->n_fields; k++) {
    const struct field *fd = &r->fields[k];
    if (!fd->attribute || word_find(fd->key_name, known, n) < n) continue;
    OWNED(text) names = {0};
    for (int i = 0; i < n; i++) text_printf(&names, " %s", known[i]);
    return diag_at(d, &f->src, fd->key.begin, "unknown attribute \"%s\"; one of%s", fd->key_name, text_str(&names));
  }
  return true;
}

static bool load_symbol(struct model *m, const struct record_file *f, const struct record *r, enum rank rank,
                        struct diag *d) {
  static const char *const known[] = {"means", "note", "domain"};
  if (!check_attributes(f, r, known, COUNT(known), d)) return false;
  for (size_t k = 0; k < r->n_fields; k++)
    if (!r->fields[k].attribute)
      return diag_at(d, &f->src, r->fields[k].value.begin, "a symbol has attributes only (means: ...)");
  if (strcmp(r->id_name, expr_pi) == 0)
    return diag_at(d, &f->src, r->id.begin, "pi is the number and is not declared; a quantity needs another name");
  if (model_is_symbol(m, r->id_name)) {
    if (rank != RANK_PAPER) return true;
    return diag_at(d, &f->src, r->id.begin, "symbol %s is declared twice", r->id_name);
  }
  struct symbol *s = SS_PUSH(m->symbols, m->n_symbols, m->cap_symbols);
  symbol_init(s, r, &f->src);
  if (!symbol_read_domain(s, d)) return false;
  if (s->has_domain && is_defined(m, s->name)) return diag_at(d, &f->src, r->id.begin, own_and_defined, s->name);
  m->n_own += s->has_domain;
  return true;
}

static bool load_statements(struct model *m, const struct record_file *f, const struct record *r, enum rank rank,
                            struct diag *d) {
  static const char *const known[] = {"section", "equation", "tex", "place", "note", "reads", "replaces", "equals"};
  if (!check_attributes(f, r, known, COUNT(known), d)) return false;
  bool defines = strcmp(r->kind_name, "define") == 0;
  const char *section = record_get(r, "section");
  const char *replaces = record_get(r, "replaces");
  struct statement_record sr = {.id = replaces ? replaces : r->id_name,
                                .section = or_empty(section ? section : record_get(&f->records[0], "section")),
                                .equation = or_empty(record_get(r, "equation")),
                                .tex = or_empty(record_get(r, "tex")),
                                .record = r,
                                .src = &f->src,
                                .rank = rank,
                                .stmts = arena_alloc(&m->arena, r->n_fields * sizeof(struct stmt *))};
  for (size_t i = 0; i < m->n_records; i++) {
    const struct statement_record *o = &m->records[i];
    if (strcmp(o->id, sr.id) != 0) continue;
    if (o->rank == rank && rank != RANK_CONTROL)
      return diag_at(d, &f->src, r->id.begin, "record %s is given twice", sr.id);
    if (!*sr.section) sr.section = o->section;
  }
  for (size_t k = 0; k < r->n_fields; k++) {
    if (r->fields[k].attribute) continue;
    const struct stmt *s = stmt_parse(&m->arena, &f->src, r->fields[k].value, d);
    if (!s) return false;
    if (defines) s = as_definition(m, s);
    if (defines && s->kind == STMT_RELATION)
      return diag_at(d, &f->src, s->span.begin,
                     "a define record holds definitions, name = expression or name(t) := expression");
    if (!defines && (s->kind == STMT_DEFINE || s->kind == STMT_ROOT))
      return diag_at(d, &f->src, s->span.begin, "a definition belongs in a define record");
    struct definition def = {
        .section = sr.section, .equation = sr.equation, .stmt = s, .src = &f->src, .record = r, .rank = rank};
    if (s->kind != STMT_RELATION && !register_names(m, def, s, d)) return false;
    sr.stmts[sr.n_stmts++] = s;
  }
  *SS_PUSH(m->records, m->n_records, m->cap_records) = sr;
  return true;
}

/* Is it "sha256 " and 64 hexadecimal digits, in small letters? */
static bool is_digest(const char *s) {
  static const char name[] = "sha256 ";
  const size_t n = strlen(name);
  return strncmp(s, name, n) == 0 && strspn(s + n, "0123456789abcdef") == 64 && strlen(s) == n + 64;
}

/* One fact about the paper.  A file of the paper's own that is read over the paper says the same again. */
static bool load_fact(const char **fact, const char *what, const struct record_file *f, const struct field *fd,
                      enum rank rank, struct diag *d) {
  if (rank != RANK_PAPER && *fact && strcmp(*fact, fd->text) == 0) return true;
  if (rank != RANK_PAPER || *fact)
    return diag_at(d, &f->src, fd->key.begin,
                   *fact ? "the paper's %s is given twice; leave one out"
                         : "the paper's %s stands in one of its own files, not in one that is laid over them",
                   what);
  *fact = fd->text;
  return true;
}

/* What the program has a model of. */
static const char two_masses[] = "two masses on a belt";

/* Whose formulas these are, the text that they are quoted from, and the system that they are about. */
static bool load_title(struct model *m, const struct record_file *f, enum rank rank, struct diag *d) {
  const struct record *top = &f->records[0];
  bool ok = true;
  for (size_t k = 0; ok && k < top->n_fields; k++) {
    const struct field *fd = &top->fields[k];
    if (!fd->attribute) continue;
    if (strcmp(fd->key_name, "paper") == 0) ok = load_fact(&m->paper, "title", f, fd, rank, d);
    if (strcmp(fd->key_name, "source") == 0) ok = load_fact(&m->paper_source, "source", f, fd, rank, d);
    if (strcmp(fd->key_name, "model") == 0)
      ok = load_fact(&m->system, "model", f, fd, rank, d) &&
           (strcmp(fd->text, two_masses) == 0 ||
            diag_at(d, &f->src, fd->value.begin,
                    "the program has one model, \"%s\"; without this line its names are the paper's", two_masses));
    if (strcmp(fd->key_name, "text") == 0)
      ok = load_fact(&m->paper_text, "text", f, fd, rank, d) &&
           (is_digest(fd->text) || diag_at(d, &f->src, fd->value.begin,
                                           "a text is named by its digest, \"sha256 \" and 64 hexadecimal digits"));
  }
  return ok;
}

static bool load_records(struct model *m, const struct record_file *f, enum rank rank, struct diag *d) {
  static const char *const kinds[] = {"define", "equation", "inequality", "relation"};
  static const char *const attributes[] = {"section", "title", "note", "paper", "place", "text", "source", "model"};
  const struct record *top = &f->records[0];
  if (!check_attributes(f, top, attributes, COUNT(attributes), d) || !load_title(m, f, rank, d)) return false;
  for (size_t k = 0; k < top->n_fields; k++)
    if (!top->fields[k].attribute)
      return diag_at(d, &f->src, top->fields[k].value.begin,
                     "a formula outside a record; begin one with \"define ID\" or \"equation ID\"");
  for (size_t i = 1; i < f->n_records; i++) {
    const struct record *r = &f->records[i];
    bool symbol = strcmp(r->kind_name, "symbol") == 0;
    if (!symbol && word_find(r->kind_name, kinds, COUNT(kinds)) == COUNT(kinds))
      return diag_at(d, &f->src, r->kind.begin,
                     "unknown record kind \"%s\"; one of symbol define equation inequality relation", r->kind_name);
    if (!(symbol ? load_symbol : load_statements)(m, f, r, rank, d)) return false;
  }
  return true;
}

static bool add_source(struct model *m, struct source src, enum rank rank, struct diag *d) {
  struct record_file *f = ss_malloc(sizeof *f);
  m->files = ss_grow(m->files, m->n_files, &m->cap_files, sizeof *m->files);
  m->ranks = ss_grow(m->ranks, m->n_files, &m->cap_ranks, sizeof *m->ranks);
  m->ranks[m->n_files] = rank;
  m->files[m->n_files++] = f;
  return record_file_parse(f, src, d) && load_records(m, f, rank, d);
}

bool model_add_file(struct model *m, const char *path, enum rank rank, struct diag *d) {
  struct source src;
  return source_read(&src, path, MAX_EQ_FILE, d) && add_source(m, src, rank, d);
}

bool model_add_text(struct model *m, const char *name, const char *text, enum rank rank, struct diag *d) {
  struct source src;
  source_from_string(&src, name, text);
  return add_source(m, src, rank, d);
}

bool model_add_folder(struct model *m, const char *path, enum rank rank, struct diag *d) {
  size_t n;
  FREED char **file = folder_files(&n, path, ".eq", &m->arena, d);
  bool ok = n > 0;
  for (size_t i = 0; ok && i < n; i++) ok = model_add_file(m, file[i], rank, d);
  return ok;
}

/* The options by which a command reads the same. */
static void set_options(struct model *m, const char *paper, const char *overlay) {
  const char *const option[] = {" --paper ", " --overlay "}, *const value[] = {paper, overlay};
  OWNED(text) t = {0};
  for (int i = 0; i < 2; i++) {
    if (value[i]) text_add(&t, option[i]);
    if (value[i]) text_add_quoted(&t, value[i]);
  }
  m->options = arena_strdup(&m->arena, text_str(&t));
}

bool model_load(struct model *m, const char *data, const char *paper, const char *overlay, struct diag *d) {
  static const struct {
    const char *name;
    enum rank rank;
    bool (*add)(struct model *m, const char *path, enum rank rank, struct diag *d);
  } part[] = {{"errata.eq", RANK_ERRATA, model_add_file},
              {"stable.eq", RANK_STABLE, model_add_file},
              {"controls", RANK_CONTROL, model_add_folder}};
  OWNED(text) path = {0};
  set_options(m, paper, overlay);
  text_printf(&path, "%s/paper", data);
  bool ok = model_add_folder(m, paper ? paper : text_str(&path), RANK_PAPER, d);
  ok = ok && (!overlay || model_add_file(m, overlay, RANK_USER, d));
  for (size_t i = 0; ok && i < sizeof part / sizeof *part; i++) {
    text_reset(&path);
    text_printf(&path, "%s/%s", data, part[i].name);
    ok =
        access(text_str(&path), F_OK) == 0 || errno != ENOENT ||
        diag_set(d, "%s: error: there is none, and every data folder has one (docs/another-paper.md)", text_str(&path));
    ok = ok && part[i].add(m, text_str(&path), part[i].rank, d);
  }
  return ok && model_check_tex(m, paper ? RANK_USER : RANK_STABLE, d); /* another paper's names are not the errata's */
}

void record_quote(struct text *out, const struct statement_record *r, const char *gap) {
  static const char left_out[] = " ... ";
  const char *s = r->tex;
  for (const char *end; (end = strstr(s, left_out)) != NULL; s = end + strlen(left_out))
    text_printf(out, "$%.*s$%s", (int)(end - s), s, gap);
  text_printf(out, "$%s$", s);
}

/* Whether the view sees something of this rank, equation and record. */
static bool sees(const struct view *v, enum rank rank, const char *equation, const char *id) {
  if (rank == RANK_ERRATA || rank == RANK_STABLE)
    return (rank == RANK_STABLE ? v->layer == LAYER_STABLE : v->layer != LAYER_PRINTED) &&
           !(v->own && strcmp(v->own, *equation ? equation : id) == 0);
  if (rank == RANK_CONTROL) return v->control && strcmp(v->control, id) == 0;
  return true;
}

bool view_sees(const struct view *v, const struct definition *def) {
  return sees(v, def->rank, def->equation, def->record->id_name);
}

static bool hides(const struct definition *def, const struct definition *earlier) {
  return !earlier || def->rank >= earlier->rank;
}

static const struct definition *look_up(const struct view *v, const char *name, const char *section, struct diag *d) {
  const struct model *m = v->model;
  const struct definition *here = NULL, *anywhere = NULL, *elsewhere = NULL;
  bool ambiguous = false;
  for (size_t i = m->bucket[bucket_of(name)].first; i; i = m->defs[i - 1].next) {
    const struct definition *def = &m->defs[i - 1];
    if (strcmp(def->name, name) != 0 || !view_sees(v, def)) continue;
    if (*def->section == '\0') {
      if (hides(def, anywhere)) anywhere = def;
    } else if (strcmp(def->section, section) == 0) {
      if (hides(def, here)) here = def;
    } else {
      if (elsewhere && strcmp(elsewhere->section, def->section) != 0) ambiguous = true;
      if (hides(def, elsewhere)) elsewhere = def;
    }
  }
  /* an overlay replaces whatever it meets, unless both name a section */
  if (here) return anywhere && anywhere->rank > here->rank ? anywhere : here;
  if (anywhere && (!elsewhere || elsewhere->rank <= anywhere->rank)) return anywhere;
  if (ambiguous) {
    diag_set(d, "%s is defined in several sections; the use in section %s does not say which", name,
             *section ? section : "(none)");
    return NULL;
  }
  return elsewhere;
}

const struct definition *view_lookup(const struct view *v, const char *name, const char *section, struct diag *d) {
  const struct definition *def = look_up(v, name, section, d);
  if (def && v->model->use) v->model->use->def[def - v->model->defs] = true;
  return def;
}

const struct definition *view_lookup_value(const struct view *v, const char *value, const char *section,
                                           struct diag *d) {
  char name[64];
  snprintf(name, sizeof name, "%.*s", (int)strcspn(value, "("), value);
  return view_lookup(v, name, section, d);
}

struct definition view_stated(const struct view *v, const struct statement_record *r, const struct stmt *s) {
  struct diag ignored = {0};
  bool defines = s->kind == STMT_DEFINE || s->kind == STMT_ROOT;
  const struct definition *seen = defines ? view_lookup(v, s->name, r->section, &ignored) : NULL;
  return seen ? *seen : (struct definition){.section = r->section, .stmt = s, .src = r->src};
}

const struct statement_record *view_record(const struct view *v, const char *id) {
  const struct model *m = v->model;
  const struct statement_record *best = NULL;
  for (size_t i = 0; i < m->n_records; i++) {
    const struct statement_record *r = &m->records[i];
    if (strcmp(r->id, id) == 0 && sees(v, r->rank, r->equation, r->record->id_name) && (!best || r->rank > best->rank))
      best = r;
  }
  if (best && m->use) m->use->record[best - m->records] = true;
  return best;
}
