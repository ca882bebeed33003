/* Scenes as hostile users write them: every line of tests/hostile/scenes.tsv and sets.tsv ends with the status that it
   says, one message that names the place and the remedy, and without harm to time or memory; the library of scenes;
   what --set changes and what it does not. */
#include <glob.h>
#include <sys/stat.h>
#include <unistd.h>

#include "claim/claims.h"
#include "command.h"
#include "every.h"
#include "paper_model.h"
#include "process.h"
#include "rational.h"
#include "run/audit.h"
#include "test.h"
#include "value/printed.h"

#define REST "eta = 1\nV = 1\ne1 = 2\ne2 = 1\n"
#define GOOD "chi = 0.8\n" REST

static const struct job_place in_little_memory = {.memory = 200 << 20};

/* --- Processes --- */

/* The program with these words. */
static struct job run_words(const char *const *words) {
  return job_quick(&in_little_memory, program(), words);
}

/* --- The tables --- */

static const char *const abbreviated[][2] = {{"good", GOOD}, {"rest", REST}, {NULL, NULL}};

/* Refused by a message that names the place and says what it should. */
static void is_refused(const struct job *r, const char *what, int status, const char *place, const char *says,
                       const char *name) {
  job_refused(r, status, what);
  ck_assert_msg(r->err_size < 1000 && (strstr(r->err, "error: ") || status == 2), "%s: %s", what, r->err);
  ck_assert_msg(strstr(r->err, says) != NULL, "%s\ndoes not say: %s\n%s", what, says, r->err);
  if (strcmp(place, "-") == 0) return;
  const char *begin = formatted("%s:%s: error: ", name, place);
  ck_assert_msg(strncmp(r->err, begin, strlen(begin)) == 0, "%s: not at %s: %s", what, place, r->err);
}

/* check reads the file, and so does orbit, by the same function. */
static void hostile_scene(char *const *field, bool by_orbit) {
  LOCAL(text, text);
  field_expand(&text, field[4], abbreviated);
  const char *path = scratch_put_n("case.scene", text_str(&text), text.len);
  int status = atoi(field[1]);
  OWNED(job) r = run_words((const char *const[]){"check", path, NULL});
  if (status)
    is_refused(&r, field[0], status, field[2], field[3], path);
  else
    ck_assert_msg(r.status == 0 && r.err_size == 0 && r.seconds < MOST_SECONDS, "%s: %d, %s", field[0], r.status,
                  r.err);
  if (!status || !by_orbit) return;
  job_take(&r, run_words((const char *const[]){"orbit", path, NULL}));
  is_refused(&r, field[0], status, field[2], field[3], path);
}

CASE("hostile", .once = {scratch_open, scratch_close});

TEST(hostile_scenes) {
  OWNED(table) scenes = table_read("tests/hostile/scenes.tsv", 5);
  ck_assert_int_ge(scenes.n, 150);
  for (int i = 0; i < scenes.n; i++) hostile_scene(scenes.row[i], i % every(7) == 0);
}

static void hostile_set(char *const *field) {
  struct text value[MOST_COLUMNS];
  const char *scene = field[4], *words[2 * MOST_COLUMNS] = {"orbit"};
  int n = 5;
  if (strcmp(scene, "{bad}") == 0) scene = scratch_put("bad.scene", "chi = 0.8\neta = 1\nV = 1\ne1 = 0\ne2 = 1\n");
  if (strcmp(scene, "{friction}") == 0) scene = scratch_put("friction.scene", GOOD "u_r1 = 2.5\n");
  words[1] = scene;
  for (int i = 5; field[i]; i++, n++) {
    text_init(&value[i]);
    field_expand(&value[i], field[i], abbreviated);
    words[2 * i - 8] = "--set";
    words[2 * i - 7] = text_str(&value[i]);
  }
  OWNED(job) r = run_words(words);
  if (strcmp(field[1], "0") != 0) {
    is_refused(&r, field[0], atoi(field[1]), field[2], field[3], "--set");
  } else {
    ck_assert_msg(r.status == 0 && r.err_size == 0, "%s: %d, %s", field[0], r.status, r.err);
  }
  for (int i = 5; i < n; i++) text_clear(&value[i]);
}

TEST(hostile_sets) {
  OWNED(table) sets = table_read("tests/hostile/sets.tsv", ANY_COLUMNS);
  ck_assert_int_ge(sets.n, 50);
  for (int i = 0; i < sets.n; i++) hostile_set(sets.row[i]);
}

/* --- The library --- */

static bool begins(const char *text, const char *with) {
  return strncmp(text, with, strlen(with)) == 0;
}

CASE("scene", .once = {scratch_open, scratch_close});

/* Every scene on file says in a first line of comment what it teaches, has a title, and asks for what there is. */
TEST(the_library_is_readable) {
  glob_t g;
  OWNED(claims) claims;
  struct diag d = {0};
  OWNED(model) m = paper_model(NULL);
  paper_claims(&claims, NULL);
  ck_assert(glob("verify/scenes/*.scene", 0, NULL, &g) == 0);
  for (size_t i = 0; i < g.gl_pathc; i++) {
    OWNED(scene) s;
    FREED char *text = file_text(g.gl_pathv[i]);
    ck_assert_msg(begins(text, "# ") && strstr(text, "\ntitle: "), "%s", g.gl_pathv[i]);
    bool ok = scene_load_with(&s, g.gl_pathv[i], "verify", NULL, SCENE_OF_ANY_SYSTEM, &d);
    ck_assert_msg(ok && (s.system || scene_check_asked(&s, &claims, &m, &d)), "%s", d.message);
    ck_assert(*s.title);
  }
  globfree(&g);
}

/* --- Values --- */

static bool load(struct scene *s, struct diag *d, const char *text, const struct scene_overrides *o) {
  diag_init(d);
  return scene_load_with(s, scratch_put("case.scene", text), "no-such-folder", o, true, d);
}

CASE("scene");

/* What a scene gives, by hand: exact values, whatever the ends of lines, marks and blanks; values that use each other,
   in whatever order their lines stand.  Other parameters than those of the row are not given. */
TEST(values_of_scenes) {
  OWNED(table) scenes = table_read("tests/cases/scene_values.tsv", ANY_COLUMNS);
  for (int i = 0; i < scenes.n; i++) {
    OWNED(scene) s;
    LOCAL(text, text);
    bool given[N_KEYS] = {false};
    field_expand(&text, scenes.row[i][0], abbreviated);
    goes_well(load(&s, &d, text_str(&text), NULL));
    for (char *const *field = scenes.row[i] + 1; *field; field++) {
      char name[20], value[80], high[20] = "";
      ck_assert_int_ge(sscanf(*field, "%19[^=]=%79[^.]..%19s", name, value, high), 2);
      int key = word_find(name, scene_key_name, N_KEYS);
      ck_assert_msg(key < N_KEYS, "%s", name);
      given[key] = true;
      is_rational(&s.value[key], value);
      if (*high) is_rational(&s.high[key], high);
    }
    for (int key = 0; key < N_KEYS; key++) ck_assert_msg(s.given[key] == given[key], "row %d: %d", i, key);
  }
}

TABLE(printed, "tests/cases/printed_digits.tsv", 3);
enum { DECIMAL, VALUE, UNIT }; /* its columns */

TEST_EACH(the_last_printed_digit, printed.n) {
  char *const *row = printed.row[_i];
  OWNED(scene) s;
  const char *text = formatted(GOOD "printed: x_1 = %s\n", row[DECIMAL]);
  goes_well(load(&s, &d, text, NULL));
  const struct printed_number *p = scene_printed(&s, "x_1");
  ck_assert(p != NULL && scene_printed(&s, "x_2") == NULL);
  ck_assert_str_eq(p->decimal, row[DECIMAL]);
  is_rational(&p->value, row[VALUE]);
  is_rational(&p->unit, row[UNIT]);
}

TABLE(fitting, "tests/cases/printed_readings.tsv", 3);
enum { OF, NUMBER, HOW }; /* its columns */

TEST_EACH(a_decimal_is_read_rounded_or_cut_off, fitting.n) {
  char *const *row = fitting.row[_i];
  OWNED(scene) s;
  NUMBERS(arb, x, whole);
  const char *text = formatted(GOOD "printed: q = %s\n", row[OF]);
  goes_well(load(&s, &d, text, NULL));
  ck_assert(arb_set_str(x, row[NUMBER], 200) == 0);
  enum reading how = N_READINGS;
  truth fits = printed_fits(x, scene_printed(&s, "q"), &how);
  printed_ball(whole, scene_printed(&s, "q"));
  bool unknown = strcmp(row[HOW], "unknown") == 0;
  ck_assert_msg(fits == (unknown     ? TRUTH_UNKNOWN
                         : *row[HOW] ? TRUTH_TRUE
                                     : TRUTH_FALSE),
                "%s as %s: %d", row[NUMBER], row[OF], (int)fits);
  if (fits == TRUTH_TRUE) ck_assert_str_eq(reading_name[how], row[HOW]);
  bool at_end = fits == TRUTH_FALSE && arb_is_exact(x);
  if (fits != TRUTH_UNKNOWN && !at_end) ck_assert_int_eq(arb_overlaps(whole, x), fits == TRUTH_TRUE);
}

TEST(a_value_without_a_name) {
  const char *item = "chi";
  OWNED(scene) s;
  struct diag d;
  ck_assert(!load(&s, &d, GOOD, &(struct scene_overrides){&item, 1, "--with"}));
  ck_assert_msg(strstr(d.message, "--with takes NAME=VALUE, as in e2=1/2") != NULL, "%s", d.message);
}

/* What an override prints stays, on whichever side of it the file's printed numbers are taken away. */
TEST(overrides_print_in_any_order) {
  static const char *const items[][3] = {{"printed=t_a = 0.5", "printed=", "printed=t_b = 7"},
                                         {"printed=", "printed=t_a = 0.5", "printed=t_b = 7"},
                                         {"printed=t_b = 7", "printed=t_a = 0.5", "printed="}};
  for (size_t i = 0; i < COUNT(items); i++) {
    OWNED(scene) s;
    const struct scene_overrides o = {items[i], 3, "--set"};
    goes_well(load(&s, &d, GOOD "printed: t_a = 0.6\nprinted: z10 = 0.9\n", &o));
    ck_assert_msg(s.n_printed == 2 && scene_printed(&s, "t_a") && scene_printed(&s, "t_b"), "order %zu", i);
    is_rational(&scene_printed(&s, "t_a")->value, "1/2");
    is_rational(&scene_printed(&s, "t_b")->value, "7");
  }
}

/* --- What is asked --- */

static void list_is(const struct scene_list *list, int n, const char *const *item) {
  ck_assert_int_eq((int)list->n, n);
  for (int i = 0; i < n; i++) ck_assert_str_eq(list->item[i], item[i]);
}

TEST(what_is_asked) {
  OWNED(scene) s, plain;
  goes_well(load(&s, &d,
                 GOOD "ask: eq-27,  section\tstability ,\n  # a comment\n  matrices\nvalues: trace_J, H(t_c)[1,3], "
                      "tr(J)\nroutes: balls, fd\ndigits: 30\nbudget: 1000000000000000000\n",
                 NULL));
  list_is(&s.asked.claims, 3, (const char *const[]){"eq-27", "section stability", "matrices"});
  list_is(&s.asked.values, 3, (const char *const[]){"trace_J", "H(t_c)[1,3]", "tr(J)"});
  list_is(&s.asked.routes, 2, (const char *const[]){"balls", "fd"});
  ck_assert(s.asked.digits == 30 && s.asked.budget == 1000000000000000000ULL);
  /* places: line 8 is the one behind the comment */
  size_t line, column;
  source_place(&line, &column, s.asked.claims.source, s.asked.claims.place[2].begin);
  ck_assert_msg(line == 8 && column == 3, "%zu:%zu", line, column);
  goes_well(load(&plain, &d, GOOD, NULL));
  const struct scene_asked *a = &plain.asked;
  ck_assert(!a->claims.n && !a->values.n && !a->routes.n && !a->digits && !a->budget);
}

/* The groups against the attributes of the claims, counted here with the files as text. */
static int count_lines(const char *line) {
  glob_t g;
  int n = 0;
  ck_assert(glob("verify/claims/*.claim", 0, NULL, &g) == 0);
  for (size_t i = 0; i < g.gl_pathc; i++) {
    FREED char *s = file_text(g.gl_pathv[i]);
    for (const char *p = strstr(s, line); p; p = strstr(p + 1, line)) n++;
  }
  globfree(&g);
  return n;
}

static int count_asked(const struct claims *c, const char *item) {
  int n = 0;
  for (size_t i = 0; i < c->n; i++) n += claim_asked_for(&c->claim[i], item);
  return n;
}

TABLE(groups, "tests/cases/claim_groups.tsv", 4);

TEST(groups_of_claims) {
  OWNED(claims) c;
  paper_claims(&c, NULL);
  for (int i = 0; i < groups.n; i++) {
    char *const *row = groups.row[i];
    int want = 0;
    for (int k = 1; k < 4 && *row[k]; k++) want += count_lines(row[k]);
    ck_assert_msg(want > 0 && count_asked(&c, *row) == want, "%s: %d, not %d", *row, count_asked(&c, *row), want);
  }
  ck_assert_int_eq(count_asked(&c, "all"), (int)c.n);
  ck_assert_int_eq(count_asked(&c, "equations") + count_asked(&c, "sentences"), (int)c.n);
  for (size_t i = 0; i < c.n; i++) {
    const char *section = claim_get(&c.claim[i], "section");
    const char *item = formatted("section %s", section);
    ck_assert(claim_asked_for(&c.claim[i], item));
    ck_assert(claim_asked_for(&c.claim[i], c.claim[i].id) && !claim_asked_for(&c.claim[i], "eq-999"));
    /* a section's number is that of the file of claims that bears its name */
    const char *file = strrchr(c.claim[i].file->src.name, '/') + 1;
    if (file[1] == '-') {
      char number[] = "section N";
      number[8] = file[0];
      size_t same = strlen("section ");
      if (strncmp(file + 2, item + same, 5) == 0)
        ck_assert_msg(claim_asked_for(&c.claim[i], number), "%s is not %s", section, number);
    }
  }
  /* J_a, J_b, J_c, J_f and J have an equation each: (27), (32), (36), (40), (41) */
  static const char *const of[] = {"eq-27", "eq-32", "eq-36", "eq-40", "eq-41", "text-singular"};
  for (size_t i = 0; i < COUNT(of); i++)
    ck_assert_msg(claim_asked_for(claim_with_id(&c, of[i]), "jacobians"), "%s", of[i]);
}

/* --- --set --- */

CASE("set", .once = {scratch_open, scratch_close});

/* The records of a scene on file are not those of another file of the same name, whatever it holds. */
TEST(only_the_file_itself_is_on_file) {
  const char *const chi[] = {"chi=0.7"}, *const ask[] = {"ask=eq-27"};
  struct scene_overrides changed = {chi, 1, "--set"}, asking = {ask, 1, "--set"};
  struct {
    const char *spec;
    const struct scene_overrides *o;
    bool is;
  } c[] = {{"paper", NULL, true},
           {"verify/scenes/paper.scene", NULL, true},
           {"./verify/../verify/scenes/paper.scene", NULL, true},
           {"paper", &asking, true},
           {"paper", &changed, false},
           {scratch_put("paper.scene", GOOD), NULL, false}};
  for (size_t i = 0; i < COUNT(c); i++) {
    OWNED(scene) s;
    goes_well(scene_load_with(&s, c[i].spec, "verify", c[i].o, false, &d));
    ck_assert_str_eq(s.file, "paper");
    ck_assert_msg(scene_on_record(&s) == c[i].is, "%s", c[i].spec);
  }
}

TEST(set_names_what_it_changed) {
  OWNED(scene) s, plain, other;
  const char *const item[] = {"e2=[1, 2]", "title=it's"}, *const asked[] = {"ask=eq-27"};
  struct scene_overrides o = {item, 2, "--set"}, only_asked = {asked, 1, "--set"};
  goes_well(load(&s, &d, GOOD, &o));
  goes_well(load(&plain, &d, GOOD, NULL));
  ck_assert_str_eq(s.name, "case --set 'e2=[1, 2]' --set 'title=it'\\''s'");
  ck_assert_str_eq(s.file, "case");
  ck_assert_str_eq(s.title, "it's");
  ck_assert(s.changed && !plain.changed);
  ck_assert_str_eq(plain.name, "case");
  ck_assert_str_eq(plain.folder, "case");
  ck_assert(strcmp(s.folder, "case") != 0 && !strpbrk(s.folder, "/ '[]"));
  goes_well(load(&other, &d, GOOD, &only_asked));
  ck_assert(!other.changed); /* it asks for less of the same scene */
}

/* One mass, whose orbits are soon found. */
static const char one_mass[] = "title: one mass\nV = 1\nmass m\n  inertia: 1\n  sliding: 1\n  static: 2\n  surface: V\n"
                               "spring k\n  between: ground, m\n  stiffness: 1\n";

/* Two values whose names fold into one do not share a folder. */
TEST(folders_differ) {
  OWNED(scene) a, b;
  const char *const one[] = {"e2=1/2"}, *const two[] = {"e2=1*2"};
  goes_well(load(&a, &d, GOOD, &(struct scene_overrides){one, 1, "--set"}));
  goes_well(load(&b, &d, GOOD, &(struct scene_overrides){two, 1, "--set"}));
  ck_assert_str_ne(a.folder, b.folder);
}

/* --- Names of files --- */

TABLE(names, "tests/cases/scene_names.tsv", 2);
enum { NAME, STATUS }; /* its columns */

/* A sweep's head says the scene's name in one line of comment, whatever the file is called; a name that would break it,
   or that no report in UTF-8 can give, is refused. */
TEST_EACH(names_of_files_do_not_break_lines, names.n) {
  char *const *row = names.row[_i];
  const char *path = scratch_put(row[NAME], GOOD);
  OWNED(job) r = run_words((const char *const[]){"sweep", path, "--over", "e2=0.5:0.6:2", NULL});
  ck_assert_msg(r.status == atoi(row[STATUS]), "%s", r.err);
  bool rows = false;
  for (const char *line = r.out; *line; line = strchr(line, '\n') + 1) {
    if (begins(line, "point,e2,orbit,")) rows = true;
    ck_assert_msg(*line == '#' || (rows && (*line == 'p' || (*line >= '0' && *line <= '9'))), "%.100s", line);
    for (const char *p = line; *p && *p != '\n'; p++) ck_assert(*p >= ' ' && *p != 0x7F);
  }
}

/* --- Keys --- */

CASE("scene");

TEST(keys_are_documented) {
  FREED char *page = file_text("man/stickslip-scene.5");
  OWNED(job) r = run_words((const char *const[]){"list", "--scene-keys", NULL});
  OWNED(job) json = run_words((const char *const[]){"list", "--scene-keys", "--json", NULL});
  for (int k = 0; k < N_SCENE_KEYS; k++) {
    const char *item = formatted("\n.It Ic %s ", scene_keys[k].name);
    const char *line = formatted("%s%s", scene_keys[k].name, k < N_KEYS ? " =" : ":");
    const char *member = formatted("\"name\": \"%s\"", scene_keys[k].name);
    ck_assert_msg(strstr(page, item), "%s is not in the man page", scene_keys[k].name);
    ck_assert_msg(strstr(r.out, line) && strstr(r.out, scene_keys[k].meaning), "%s", line);
    ck_assert_msg(strstr(json.out, member), "%s", member);
  }
}

/* --- Which command uses which key --- */

/* A scene as the values of its keys; NULL: the key is not given. */
struct lines {
  const char *of[N_SCENE_KEYS];
};

/* A scene of a system file, which stands in place of the parameters. */
static const struct lines alone = {{[KEY_TITLE] = "as it was"}};

static const struct lines full = {{[KEY_CHI] = "0.8",
                                   [KEY_ETA] = "1",
                                   [KEY_V] = "1",
                                   [KEY_E1] = "2.7844",
                                   [KEY_E2] = "0.8587",
                                   [KEY_U_R1] = "4",
                                   [KEY_U_R2] = "4",
                                   [KEY_TITLE] = "as it was",
                                   [KEY_PRINTED] = "z10 = 0.8921",
                                   [KEY_VALUES] = "z10"}};

TABLE(altered, "tests/cases/scene_changes.tsv", 4);
TABLE(ways, "tests/cases/scene_uses.tsv", 4);
enum { MOST_CHANGES = 40, MOST_USES = 40, MOST_WORDS = 10 };

static struct altered {
  int key;
  const char *value;
  int with;
  const char *its;
} changes[MOST_CHANGES];

static struct use { const char *argv[MOST_WORDS], *word, *u_r1, *u_r2; } uses[MOST_USES];

/* NULL where a field has nothing. */
static const char *given(const char *field) {
  return *field ? field : NULL;
}

static void open_keys(void) {
  scratch_open();
  ck_assert(altered.n <= MOST_CHANGES && ways.n <= MOST_USES);
  for (int i = 0; i < altered.n; i++) {
    char *const *row = altered.row[i];
    changes[i] = (struct altered){word_find(row[0], scene_key_name, N_SCENE_KEYS), given(row[1]),
                                  word_find(row[2], scene_key_name, N_SCENE_KEYS), given(row[3])};
    ck_assert_msg(changes[i].key < N_SCENE_KEYS && changes[i].with < N_SCENE_KEYS, "%s or %s", row[0], row[2]);
  }
  for (int i = 0, n = 0; i < ways.n; i++, n = 0) {
    char *const *row = ways.row[i];
    uses[i] = (struct use){.word = given(row[1]), .u_r1 = given(row[2]), .u_r2 = given(row[3])};
    for (char *p = strtok(row[0], " "); p && n + 1 < MOST_WORDS; p = strtok(NULL, " ")) uses[i].argv[n++] = p;
  }
}

/* The scene before any change. */
static struct lines unchanged(const struct use *u) {
  struct lines l = full;
  if (u->u_r1) l.of[KEY_U_R1] = u->u_r1;
  if (u->u_r2) l.of[KEY_U_R2] = u->u_r2;
  return l;
}

static void put_scene(const struct lines *l) {
  LOCAL(text, t);
  for (int k = 0; k < N_SCENE_KEYS; k++)
    if (l->of[k]) text_printf(&t, "%s%s %s\n", scene_key_name[k], k < N_KEYS ? " =" : ":", l->of[k]);
  text_add(&t, "printed: z20 = -2.1958\nprinted: t_a = 0.6784\nprinted: t_b = 2\nprinted: t_c = 1.5\n"
               "printed: t_d = 2.34\nprinted: e1 = 2.7844\nprinted: e2 = 0.8587\nprinted: u_r2 = 1.6645\n");
  scratch_put("scenes/x.scene", text_str(&t));
}

/* All that the command says and writes, but for what belongs to the machine; its exit status. */
static int answer(struct text *out, const struct use *u, const struct lines *l) {
  const char *words[MOST_WORDS] = {NULL}, *folder = scratch_path("keys-out");
  struct lines own = *l;
  if (u->word) own.of[KEY_WORD] = u->word;
  put_scene(&own);
  for (int i = 0; u->argv[i]; i++)
    words[i] = strcmp(u->argv[i], "SCENE") == 0 ? scratch_path("scenes/x.scene")
               : strcmp(u->argv[i], "OUT") == 0 ? folder
                                                : u->argv[i];
  if (strcmp(words[0], "list") == 0) setenv("STICKSLIP_DATA", scratch_path(""), 1);
  OWNED(job) r;
  job_start(&r, &in_little_memory, program(), words);
  job_finish(&r);
  unsetenv("STICKSLIP_DATA");
  text_printf(out, "%d\n%s%s", r.status, r.out, r.err);
  if (access(folder, F_OK) == 0) {
    FREED char *list = ss_strdup(scratch_list(folder));
    for (char *name = strtok(list, " "); name; name = strtok(NULL, " ")) {
      const char *path = formatted("keys-out/%s", name);
      FREED char *s = file_text(scratch_path(path));
      if (strcmp(name, "run.json") != 0) text_printf(out, "%s\n%s", name, s);
      unlink(scratch_path(path));
    }
    ck_assert(rmdir(folder) == 0);
  }
  return r.status;
}

/* Whether the list of the column, from a place up to a semicolon, names the command. */
static bool lists_command(const char *list, const char *command) {
  size_t n = strlen(command), len;
  const char *end = strchr(list, ';');
  for (const char *s = list_item(&len, list); s && (!end || s < end); s = list_item(&len, s + len))
    if (strncmp(s, command, n) == 0 && (len == n || (len == n + 1 && s[n] == ';'))) return true;
  return false;
}

/* What the table says of a key and a command: that it acts there, that it is refused there. */
static bool told_to_act(int key, const char *command) {
  const char *used = scene_keys[key].used;
  return (strcmp(used, "every command") == 0 && strcmp(command, "list") != 0) || lists_command(used, command);
}

static bool told_to_be_refused(int key, const char *command) {
  const char *refusal = strstr(scene_keys[key].used, "; refused by ");
  return refusal && lists_command(refusal + 13, command);
}

/* Whether all changes at once of keys that should do nothing here do nothing: then none of them has to be tried alone.
   idle: those that were among them. */
static void try_idle(bool idle[MOST_CHANGES], const struct use *u, const char *before) {
  struct lines l = unchanged(u);
  LOCAL(text, after);
  bool changed[N_SCENE_KEYS] = {false};
  for (int i = 0; i < altered.n; i++) {
    const struct altered *c = &changes[i];
    idle[i] = c->with == c->key && !changed[c->key] && !(u->word && c->key == KEY_WORD) &&
              !told_to_act(c->key, u->argv[0]) && !told_to_be_refused(c->key, u->argv[0]);
    if (!idle[i]) continue;
    changed[c->key] = true;
    l.of[c->key] = c->value;
  }
  answer(&after, u, &l);
  for (int i = 0; i < altered.n && strcmp(before, text_str(&after)) != 0; i++) idle[i] = false;
}

/* Whether it is tried that a key acts where it is told to: in make check with a third of the commands, and of the
   frictions, which are read as a pair, both or none. */
static bool is_tried(int key, int first) {
  const int k = key == KEY_U_R2 ? KEY_U_R1 : key;
  return !told_to_act(key, uses[first].argv[0]) || (k + first) % every(3) == 0;
}

CASE("keys", .once = {open_keys, scratch_close}, .seconds = 900, .tags = "long");

/* What the table says a key is used by is what it acts on: all that a command says and writes stays the same byte for
   byte, or does not. */
TEST(keys_act_where_they_say) {
  bool acts[N_SCENE_KEYS][MOST_USES] = {{false}}, refused[N_SCENE_KEYS][MOST_USES] = {{false}};
  ck_assert(mkdir(scratch_path("scenes"), 0755) == 0);
  scratch_put("scenes/one.system", one_mass);
  for (int u = 0; u < ways.n; u++) {
    LOCAL(text, before);
    int first = u; /* of the same command */
    while (first > 0 && strcmp(uses[first - 1].argv[0], uses[u].argv[0]) == 0) first--;
    const struct lines as_it_was = unchanged(&uses[u]);
    int status = answer(&before, &uses[u], &as_it_was);
    bool idle[MOST_CHANGES];
    try_idle(idle, &uses[u], text_str(&before));
    for (int i = 0; i < altered.n; i++) {
      const struct altered *c = &changes[i];
      struct lines l = c->key == KEY_SYSTEM ? alone : as_it_was;
      LOCAL(text, after);
      bool spoilt = c->key == KEY_SYSTEM && status != 0; /* what is refused anyhow tells nothing */
      if (idle[i] || spoilt || acts[c->key][first] || !is_tried(c->key, first) || (uses[u].word && c->key == KEY_WORD))
        continue; /* nothing more to learn of it */
      l.of[c->key] = c->value;
      l.of[c->with] = c->its;
      int then = answer(&after, &uses[u], &l);
      bool refuses = status == 0 && then == 3;
      if (refuses)
        refused[c->key][first] = true;
      else if (strcmp(text_str(&before), text_str(&after)) != 0)
        acts[c->key][first] = true;
    }
  }
  for (int u = 0; u < ways.n; u++) /* read as a pair, of which one can be too large to matter on every orbit */
    acts[KEY_U_R1][u] = acts[KEY_U_R2][u] = acts[KEY_U_R1][u] || acts[KEY_U_R2][u];
  for (int k = 0; k < N_SCENE_KEYS; k++)
    for (int u = 0; u < ways.n; u++) {
      const char *command = uses[u].argv[0];
      if (u > 0 && strcmp(uses[u - 1].argv[0], command) == 0) continue;
      bool told = told_to_act(k, command), barred = told_to_be_refused(k, command);
      if (!is_tried(k, u)) continue;
      ck_assert_msg(acts[k][u] == told, "%s %s in %s", scene_keys[k].name, told ? "does not act" : "acts", command);
      ck_assert_msg((refused[k][u] && !acts[k][u]) == barred, "%s is %s by %s", scene_keys[k].name,
                    barred ? "not refused" : "refused", command);
    }
}
