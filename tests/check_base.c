/* Strings, diagnostics, files, records, JSON, truth and memory.  Expected texts are written out by hand from the
   contracts; UTF-8 is judged by a decoder of the test's own, which encodes again what it decoded (RFC 3629). */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/json.h"
#include "base/record.h"
#include "base/status.h"
#include "base/suggest.h"
#include "rng.h"
#include "test.h"

static struct rng rng;

/* ---- UTF-8, the test's own */

static size_t encode(unsigned char out[4], uint32_t c) {
  if (c < 0x80) {
    out[0] = (unsigned char)c;
    return 1;
  }
  size_t n = c < 0x800 ? 2 : c < 0x10000 ? 3 : 4;
  for (size_t i = n; i-- > 1; c >>= 6) out[i] = (unsigned char)(0x80 | (c & 0x3F));
  out[0] = (unsigned char)((0xF00U >> n & 0xFFU) | c);
  return n;
}

/* The length of the character at s: the one whose encoding stands there; 0 when there is none. */
static size_t character(const unsigned char *s, size_t len) {
  uint32_t c = s[0];
  size_t ones = 0;
  while (ones < 8 && (s[0] & 0x80U >> ones)) ones++;
  size_t n = ones == 0 ? 1 : ones;
  if (ones == 1 || n > 4 || n > len) return 0;
  if (n > 1) c &= 0x7FU >> n;
  for (size_t i = 1; i < n; i++) c = c << 6 | (s[i] & 0x3FU);
  unsigned char again[4];
  bool surrogate = c >= 0xD800 && c <= 0xDFFF;
  return c <= 0x10FFFF && !surrogate && encode(again, c) == n && memcmp(again, s, n) == 0 ? n : 0;
}

static size_t valid_prefix(const char *text, size_t len) {
  const unsigned char *s = (const unsigned char *)text;
  size_t i = 0, n;
  while (i < len && (n = character(s + i, len - i)) > 0) i += n;
  return i;
}

static size_t count_characters(const char *s, size_t len) {
  const unsigned char *u = (const unsigned char *)s;
  size_t n = 0;
  for (size_t i = 0; i < len; n++) i += character(u + i, len - i);
  return n;
}

/* One character of each length. */
static const char *const unit[] = {"a", "\xC3\xA9", "\xE2\x82\xAC", "\xF0\x9D\x9C\x94"};

static void check_prefix(const unsigned char *s, size_t len) {
  size_t mine = valid_prefix((const char *)s, len), its = text_valid_prefix((const char *)s, len);
  if (mine != its) ck_abort_msg("%02x %02x %02x %02x: %zu, expected %zu", s[0], s[1], s[2], s[3], its, mine);
}

CASE("base", .each = {scratch_open, scratch_close});

/* Every string of two bytes, every one of three that begins one of three, and those of four at the edges. */
TEST(prefix_of_short_strings) {
  static const unsigned char edge[] = {0x00, 0x7F, 0x80, 0xBF, 0xC0, 0xFF};
  for (unsigned a = 0; a < 256; a++)
    for (unsigned b = 0; b < 256; b++) {
      check_prefix((unsigned char[4]){(unsigned char)a, (unsigned char)b}, 2);
      for (unsigned c = 0; c < 256 && a >> 4 == 0xE; c++)
        check_prefix((unsigned char[4]){(unsigned char)a, (unsigned char)b, (unsigned char)c}, 3);
      for (size_t c = 0; c < sizeof edge; c++)
        for (size_t e = 0; e < sizeof edge && a >= 0xF0; e++)
          check_prefix((unsigned char[4]){(unsigned char)a, (unsigned char)b, edge[c], edge[e]}, 4);
    }
}

TEST(prefix_of_all_characters) {
  LOCAL(text, t);
  for (uint32_t c = 1; c <= 0x10FFFF; c++) {
    unsigned char s[4];
    if (c < 0xD800 || c > 0xDFFF) text_add_n(&t, (const char *)s, encode(s, c));
  }
  ck_assert_uint_eq(text_valid_prefix(t.data, t.len), t.len);
  ck_assert_uint_eq(text_valid_prefix(t.data, t.len - 1), t.len - 4);
}

/* ---- text */

TEST(text_grows) {
  struct text t = {0};
  ck_assert_str_eq(text_str(&t), "");
  ck_assert_ptr_null(t.data);
  FREED char *copy = calloc(200000, 1);
  size_t n = 0;
  rng.state = 1;
  for (int i = 0; i < 2000; i++) {
    char piece[64];
    size_t len = rng_next(&rng) % sizeof piece;
    for (size_t k = 0; k < len; k++) piece[k] = (char)('a' + rng_next(&rng) % 26);
    switch (i % 3) {
    case 0:
      text_add_n(&t, piece, len);
      break;
    case 1:
      text_printf(&t, "%.*s", (int)len, piece);
      break;
    default:
      for (size_t k = 0; k < len; k++) text_add_char(&t, piece[k]);
      break;
    }
    memcpy(copy + n, piece, len);
    n += len;
    ck_assert_uint_eq(t.len, n);
  }
  ck_assert_str_eq(t.data, copy);
  size_t cap = t.cap;
  text_reset(&t);
  ck_assert(t.len == 0 && t.cap == cap);
  ck_assert_str_eq(text_str(&t), "");
  text_printf(&t, "%5000d|", 7);
  ck_assert_uint_eq(t.len, 5001);
  ck_assert_str_eq(t.data + 4998, " 7|");
  text_clear(&t);
  text_add(&t, "");
  ck_assert(t.data && t.len == 0);
  text_clear(&t);
  ck_assert_ptr_null(t.data);
}

/* ---- diagnostics */

TABLE(shown_places, "tests/cases/diagnostics.tsv", 3);
enum { SHOWN, OFFSET, MESSAGE }; /* its columns */

TEST_EACH(diag_places, shown_places.n) {
  char *const *row = shown_places.row[_i];
  struct diag d = {0};
  OWNED(source) s = source_of("f.eq", row[SHOWN]);
  diag_at(&d, &s, (size_t)atoi(row[OFFSET]), "n%c", 'o');
  ck_assert(d.set);
  ck_assert_str_eq(d.message, row[MESSAGE]);
}

TEST(diag_keeps_the_first) {
  struct diag d = {0};
  OWNED(source) s = source_of("f", "x");
  ck_assert(!d.set);
  ck_assert_str_eq(d.message, "");
  diag_set(&d, "%s %d", "first", 1);
  diag_set(&d, "second");
  diag_at(&d, &s, 0, "third");
  ck_assert_str_eq(d.message, "first 1");
  diag_set(NULL, "nobody listens");
  diag_at(NULL, &s, 0, "nobody listens");
}

/* The lines of a message. */
static size_t split(char *line[4], char *message) {
  size_t n = 0;
  for (char *p = strtok(message, "\n"); p && n < 4; p = strtok(NULL, "\n")) line[n++] = p;
  return n;
}

/* A line of 5000 characters with an X among them: the excerpt is short, and the caret stands below the X. */
TEST_EACH(diag_clips_long_lines, 4) {
  static const size_t place[] = {0, 1, 30, 49, 50, 51, 2500, 4949, 4950, 4998, 4999};
  const char *u = unit[_i];
  for (size_t k = 0; k < COUNT(place); k++) {
    LOCAL(text, t, head);
    text_add(&t, "first\n");
    for (size_t i = 0; i < 5000; i++) text_add(&t, i == place[k] ? "X" : u);
    text_add(&t, "\nlast");
    text_printf(&head, "f:2:%zu: error: here", place[k] + 1);
    struct diag d = {0};
    OWNED(source) s = source_of("f", t.data);
    diag_at(&d, &s, 6 + place[k] * strlen(u), "here");
    char *line[4];
    ck_assert_uint_eq(valid_prefix(d.message, strlen(d.message)), strlen(d.message));
    ck_assert_uint_eq(split(line, d.message), 3);
    ck_assert_str_eq(line[0], head.data);
    ck_assert(strlen(line[1]) <= 102 && strlen(line[1]) > 45 && strstr(t.data, line[1] + 2));
    const char *x = strchr(line[1], 'X');
    ck_assert_ptr_nonnull(x);
    size_t caret = strlen(line[2]) - 1;
    ck_assert_uint_eq(caret, count_characters(line[1], (size_t)(x - line[1])));
    ck_assert(line[2][caret] == '^' && strspn(line[2], " ") == caret);
  }
}

/* s ASCII characters and then 2000 of the unit: some of them end where a message must. */
static void long_text(struct text *t, int shift, const char *u) {
  text_init(t);
  for (int i = 0; i < shift; i++) text_add(t, "s");
  for (int i = 0; i < 2000; i++) text_add(t, u);
}

TEST_EACH(diag_cuts_at_characters, 4) {
  for (int shift = 0; shift < 4; shift++) {
    OWNED(text) t;
    long_text(&t, shift, unit[_i]);
    struct diag d = {0};
    diag_set(&d, "%s", t.data);
    size_t n = strlen(d.message);
    ck_assert(n >= 990 && n < 1000);
    ck_assert_uint_eq(valid_prefix(d.message, n), n);
    const char *gap = strstr(d.message, " ... ");
    ck_assert(gap && gap - d.message > 295 && strncmp(d.message, t.data, (size_t)(gap - d.message)) == 0);
    ck_assert_str_eq(gap + 5, t.data + t.len - strlen(gap + 5));

    OWNED(source) s = source_of(t.data, t.data);
    diag_init(&d);
    diag_at(&d, &s, (size_t)shift, "%s", t.data);
    n = strlen(d.message);
    ck_assert(n > 600 && n < 1000);
    ck_assert_uint_eq(valid_prefix(d.message, n), n);
    char *line[4];
    ck_assert_uint_eq(split(line, d.message), 3);
    ck_assert_str_eq(line[2] + strspn(line[2], " "), "^");
  }
}

TABLE(shown_bytes, "tests/cases/bytes_shown.tsv", 2);

/* What is quoted may be anything; the message is UTF-8 all the same. */
TEST_EACH(diag_is_utf8, shown_bytes.n) {
  const char *given = shown_bytes.row[_i][0], *shown = shown_bytes.row[_i][1];
  struct diag d = {0};
  diag_set(&d, "%s", given);
  ck_assert_str_eq(d.message, shown);
  OWNED(source) s = source_of(given, given);
  diag_init(&d);
  diag_at(&d, &s, 0, "in");
  ck_assert_str_eq(d.message, formatted("%s:1:1: error: in\n  %s\n  ^", shown, shown));
}

/* ---- reading files */

static void refused(const char *path, size_t max, const char *why) {
  struct source s;
  fails_as(source_read(&s, path, max, &d), formatted("%s:%s", path, why));
  ck_assert(!s.name && !s.text && s.len == 0);
}

TABLE(read_files, "tests/cases/files_read.tsv", 2);

TEST_EACH(read_what_was_written, read_files.n) {
  const char *bytes = read_files.row[_i][0];
  const size_t len = strlen(bytes), skip = (size_t)atoi(read_files.row[_i][1]);
  const char *path = scratch_put("read", bytes);
  OWNED(source) s;
  goes_well(source_read(&s, path, len, &d));
  ck_assert_str_eq(s.name, path);
  ck_assert_uint_eq(s.len, len - skip);
  ck_assert_str_eq(s.text, bytes + skip);
}

TEST(read_large_files) {
  LOCAL(text, t);
  for (int i = 0; i < 100000; i++) text_printf(&t, "%d\n", i);
  const char *path = scratch_put("large", t.data);
  struct source s;
  goes_well(source_read(&s, path, t.len, &d));
  ck_assert_uint_eq(s.len, t.len);
  ck_assert_str_eq(s.text, t.data);
  source_clear(&s);
  refused(path, s.len, " error: larger than 0 bytes");
  refused(path, 588889, " error: larger than 588889 bytes"); /* the digits and newlines of 0 .. 99999 are 588890 */
  refused("/dev/zero", 10, " error: a device or pipe, not a regular file");
}

TABLE(refused_files, "tests/cases/files_refused.tsv", 2);

TEST(read_refuses) {
  for (int i = 0; i < refused_files.n; i++) {
    LOCAL(text, t);
    field_expand(&t, refused_files.row[i][0], NULL);
    refused(scratch_put_n("bad", text_str(&t), t.len), 100, refused_files.row[i][1]);
  }
  refused(scratch_path(""), 100, " error: a folder, not a regular file");
  refused(scratch_path("absent"), 100, " error: No such file or directory");
  /* a pipe nobody writes to: opening it must not wait */
  ck_assert(mkfifo(scratch_path("pipe"), 0600) == 0);
  refused(scratch_path("pipe"), 100, " error: a device or pipe, not a regular file");
}

/* ---- writing files */

static const char *content(const char *path) {
  static char buffer[100];
  FILE *f = fopen(path, "rb");
  size_t n = f ? fread(buffer, 1, sizeof buffer - 1, f) : 0;
  buffer[n] = '\0';
  if (f) fclose(f);
  return buffer;
}

static void written(const char *path, const char *bytes, size_t len) {
  goes_well(file_write(path, bytes, len, &d) && !d.set);
}

/* A reader that has the old file open keeps it whole: the new one took its name, not its place. */
TEST(write_replaces) {
  const char *path = scratch_path("out");
  written(path, "old", 3);
  ck_assert_str_eq(content(path), "old");
  FILE *reader = fopen(path, "rb");
  ck_assert_ptr_nonnull(reader);
  written(path, "new and longer", 14);
  char old[10] = "";
  ck_assert(fread(old, 1, sizeof old, reader) == 3 && strcmp(old, "old") == 0);
  fclose(reader);
  ck_assert_str_eq(content(path), "new and longer");
  written(path, "a\0b", 3);
  struct stat st;
  ck_assert(stat(path, &st) == 0 && st.st_size == 3);
  ck_assert_uint_eq(st.st_mode & 0777, 0644);
  written(path, "", 0);
  ck_assert(stat(path, &st) == 0 && st.st_size == 0);
  ck_assert_str_eq(scratch_list(scratch_path("")), "out");
}

static void not_written(const char *path, const char *why) {
  fails_as(file_write(path, "new", 3, &d), formatted("%s: error: cannot be written: %s", path, why));
}

TEST(write_refuses) {
  const char *top = scratch_path("");
  ck_assert(mkdir(scratch_path("folder"), 0755) == 0 && mkfifo(scratch_path("pipe"), 0600) == 0);
  scratch_put("folder/inside", "kept");
  not_written(scratch_path("folder"), strerror(EISDIR));
  not_written(scratch_path("absent/out"), strerror(ENOENT));
  not_written(scratch_path("folder/inside/out"), strerror(ENOTDIR));
  /* renaming over a pipe or a device would put a file in its place */
  not_written(scratch_path("pipe"), strerror(EINVAL));
  struct stat st;
  ck_assert(lstat(scratch_path("pipe"), &st) == 0 && S_ISFIFO(st.st_mode));
  ck_assert_str_eq(content(scratch_path("folder/inside")), "kept");
  ck_assert_str_eq(scratch_list(top), "folder pipe");
  ck_assert_str_eq(scratch_list(scratch_path("folder")), "inside");
}

/* The disk is full in the middle: a limit on the size of files stands for it. */
TEST(write_breaks_off) {
  const char *path = scratch_put("out", "old");
  struct rlimit before;
  ck_assert(getrlimit(RLIMIT_FSIZE, &before) == 0);
  struct rlimit small = before;
  small.rlim_cur = 1000;
  FREED char *data = calloc(5000, 1);
  struct diag d = {0};
  void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
  bool limited = setrlimit(RLIMIT_FSIZE, &small) == 0;
  bool ok = file_write(path, data, 5000, &d);
  setrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, handler);
  ck_assert(limited && !ok);
  ck_assert_ptr_nonnull(strstr(d.message, strerror(EFBIG)));
  ck_assert_str_eq(content(path), "old");
  ck_assert_str_eq(scratch_list(scratch_path("")), "out");
}

/* Root may write anywhere, so it becomes nobody for the length of the call. */
TEST(write_in_a_read_only_folder) {
  const uid_t nobody = 65534, me = geteuid();
  ck_assert(mkdir(scratch_path("locked"), 0755) == 0);
  const char *path = scratch_put("locked/out", "old"), *folder = scratch_path("locked");
  ck_assert(chmod(folder, 0555) == 0);
  struct diag d = {0}, made = {0};
  bool plain = me != 0 || seteuid(nobody) == 0;
  bool ok = plain && file_write(path, "new", 3, &d);
  bool folder_ok = plain && folder_make(scratch_path("locked/a/b"), &made);
  bool back = me != 0 || seteuid(0) == 0;
  ck_assert(plain && back && !ok && !folder_ok);
  ck_assert_ptr_nonnull(strstr(d.message, strerror(EACCES)));
  ck_assert_ptr_nonnull(strstr(made.message, strerror(EACCES)));
  ck_assert_str_eq(content(path), "old");
  ck_assert_str_eq(scratch_list(folder), "out");
}

TEST(folders) {
  static const char *const fine[] = {"a", "a/b/c/d", "a/b", "a//x/", "a/./y", "a/../z", ""};
  struct stat st;
  for (size_t i = 0; i < COUNT(fine); i++) {
    const char *path = scratch_path(fine[i]);
    goes_well(folder_make(path, &d));
    ck_assert_msg(stat(path, &st) == 0 && S_ISDIR(st.st_mode), "%s", path);
  }
  goes_well(folder_make(".", &d) && folder_make("/", &d));
  ck_assert_str_eq(scratch_list(scratch_path("a")), "b x y");
  scratch_put("a/file", "kept");
  static const char *const wrong[] = {"a/file", "a/file/", "a/file/b", "a/file/b/c"};
  for (size_t i = 0; i < COUNT(wrong); i++) {
    const char *path = scratch_path(wrong[i]);
    fails_as(folder_make(path, &d), formatted("%s: error: cannot make the folder: %s", path, strerror(ENOTDIR)));
  }
  ck_assert_str_eq(content(scratch_path("a/file")), "kept");
  fails_with(folder_make("", &d), "error");
}

/* ---- records */

/* kind id{key="text" <formula> ...} for each record but an empty record 0 */
static void spell(struct text *out, const struct record_file *f) {
  for (size_t i = 0; i < f->n_records; i++) {
    const struct record *r = &f->records[i];
    if (i == 0 && r->n_fields == 0) continue;
    text_printf(out, "%s%s %s{", out->len ? " " : "", r->kind_name, r->id_name);
    for (size_t k = 0; k < r->n_fields; k++) {
      const struct field *fd = &r->fields[k];
      if (k) text_add(out, " ");
      if (fd->attribute)
        text_printf(out, "%s=\"%s\"", fd->key_name, fd->text);
      else
        text_printf(out, "<%.*s>", (int)(fd->value.end - fd->value.begin), f->src.text + fd->value.begin);
    }
    text_add(out, "}");
  }
}

static bool parse(struct record_file *f, const char *text, struct diag *d) {
  struct source s = source_of("f", text);
  diag_init(d);
  return record_file_parse(f, s, d);
}

TEST(records) {
  enum { TEXT, SPELT };
  OWNED(table) c = table_read("tests/cases/records.tsv", 2);
  for (int i = 0; i < c.n; i++) {
    OWNED(record_file) f;
    LOCAL(text, t);
    goes_well(parse(&f, c.row[i][TEXT], &d));
    ck_assert(f.n_records >= 1 && f.records[0].kind.begin == f.records[0].kind.end);
    spell(&t, &f);
    ck_assert_msg(strcmp(text_str(&t), c.row[i][SPELT]) == 0, "%s\nread as\n%s\nexpected\n%s", c.row[i][TEXT],
                  text_str(&t), c.row[i][SPELT]);
  }
}

TEST(record_spans) {
  OWNED(record_file) f;
  goes_well(parse(&f, "t: 1\ndefine J_a # no\n  note:  a\n    b \n  J = 1\n  note: c\n", &d));
  const struct record *r = &f.records[1];
  ck_assert(r->kind.begin == 5 && r->kind.end == 11 && r->id.begin == 12 && r->id.end == 15);
  ck_assert(r->fields[0].key.begin == 23 && r->fields[0].key.end == 27);
  ck_assert(r->fields[0].value.begin == 30 && r->fields[0].value.end == 37);
  ck_assert(r->fields[1].value.begin == 41 && r->fields[1].value.end == 46);
  ck_assert_str_eq(record_get(r, "note"), "a b"); /* the first of that name */
  ck_assert_ptr_eq(record_field(r, "note"), &r->fields[0]);
  ck_assert_ptr_null(record_get(r, "J"));
  ck_assert_ptr_null(record_field(r, "no"));
}

TEST(record_errors) {
  static const char *const c[][3] = {{"define a\nx = 1\n", "2", "x = 1"},
                                     {"define a\n  x = 1\nnote: 2\n", "3", "note: 2"}};
  for (size_t i = 0; i < COUNT(c); i++) {
    OWNED(record_file) f;
    fails_as(
        parse(&f, c[i][0], &d),
        formatted("f:%s:1: error: a line in the first column must be a head \"kind id\"; indent the fields of record "
                  "a\n  %s\n  ^",
                  c[i][1], c[i][2]));
  }
}

TEST(record_limit) {
  for (int extra = 0; extra < 2; extra++) {
    LOCAL(text, t);
    for (int i = 0; i < 50000; i++) text_add(&t, "x\n");
    text_add(&t, "a b\n");
    for (int i = 0; i < 50000 + extra; i++) text_add(&t, " y: z\n");
    OWNED(record_file) f;
    if (extra) {
      fails_as(parse(&f, t.data, &d), "f:100002:2: error: more than 100000 fields in one file\n   y: z\n   ^");
    } else {
      goes_well(parse(&f, t.data, &d));
      ck_assert_uint_eq(f.records[0].n_fields, 50000);
      ck_assert_uint_eq(f.records[1].n_fields, 50000);
      ck_assert_str_eq(f.records[1].fields[49999].text, "z");
    }
  }
}

/* ---- JSON */

TEST(json_nesting) {
  LOCAL(text, t);
  struct json j = {.out = &t};
  json_object(&j, NULL);
  json_string(&j, "s", "x");
  json_array(&j, "empty");
  json_end_array(&j);
  json_object(&j, "none");
  json_end_object(&j);
  json_array(&j, "list");
  json_long(&j, NULL, -12);
  json_bool(&j, NULL, true);
  json_object(&j, NULL);
  json_bool(&j, "no", false);
  json_null(&j, "nil");
  json_end_object(&j);
  json_string(&j, NULL, NULL);
  json_end_array(&j);
  json_string_array(&j, "words", (const char *const[]){"a", "b"}, 2);
  json_printf(&j, "by format", "%d\"%s", 3, "\n");
  json_string(&j, "last", "");
  json_end_object(&j);
  OWNED(table) written = table_read("tests/cases/json_written.tsv", 1);
  ck_assert_str_eq(t.data, *written.row[0]);
}

/* A JSON string read by the rules of RFC 8259, section 7; false where they are broken. */
static bool read_json_string(struct text *out, const char **p) {
  static const char names[] = "\"\\/bfnrt", values[] = "\"\\/\b\f\n\r\t";
  if (*(*p)++ != '"') return false;
  for (; **p != '"'; (*p)++) {
    unsigned char c = (unsigned char)**p;
    if (c < 0x20) return false;
    if (c != '\\') {
      text_add_char(out, (char)c);
      continue;
    }
    const char *name = strchr(names, *++*p);
    unsigned code;
    if (**p == 'u' && sscanf(*p + 1, "%4x", &code) == 1 && code < 0x80) {
      text_add_char(out, (char)code);
      *p += 4;
    } else if (**p && name) {
      text_add_char(out, values[name - names]);
    } else {
      return false;
    }
  }
  (*p)++;
  return true;
}

TEST(json_strings) {
  LOCAL(text, given, t, key, value);
  for (int c = 1; c < 0x80; c++) text_add_char(&given, (char)c);
  for (size_t i = 0; i < 4; i++) text_add(&given, unit[i]);
  struct json j = {.out = &t};
  json_object(&j, NULL);
  json_string(&j, given.data, given.data);
  json_end_object(&j);
  const char *p = strchr(t.data, '"');
  ck_assert(read_json_string(&key, &p));
  ck_assert(strncmp(p, ": ", 2) == 0);
  p += 2;
  ck_assert(read_json_string(&value, &p));
  ck_assert_str_eq(p, "\n}\n");
  ck_assert_str_eq(key.data, given.data);
  ck_assert_str_eq(value.data, given.data);
  text_reset(&value);
  text_reset(&t);
  json_begin_string(&j, NULL); /* the same, made in two steps */
  text_add_n(&t, given.data, 20);
  text_add(&t, given.data + 20);
  json_end_string(&j);
  p = t.data;
  ck_assert(read_json_string(&value, &p));
  ck_assert_str_eq(p, "");
  ck_assert_str_eq(value.data, given.data);
}

static void open_arrays(int n) {
  LOCAL(text, t);
  struct json j = {.out = &t};
  for (int i = 0; i < n; i++) json_array(&j, NULL);
  for (int i = 0; i < n; i++) json_end_array(&j);
}
static void deepest(void) {
  open_arrays(JSON_DEPTH);
}
static void too_deep(void) {
  open_arrays(JSON_DEPTH + 1);
}
static void close_nothing(void) {
  struct text t = {0};
  struct json j = {.out = &t};
  json_end_object(&j);
}

TEST(json_broken_nesting_aborts) {
  ck_assert_int_eq(child_end(deepest), 0);
  ck_assert_int_eq(child_end(too_deep), -SIGABRT);
  ck_assert_int_eq(child_end(close_nothing), -SIGABRT);
}

/* ---- what was meant */

/* The definition: the least over the last edit, without a table. */
static size_t edits_by_definition(const char *a, size_t n, const char *b, size_t m) {
  if (n == 0 || m == 0) return n + m;
  size_t best = edits_by_definition(a, n - 1, b, m - 1) + (a[n - 1] != b[m - 1]);
  size_t other = 1 + edits_by_definition(a, n - 1, b, m);
  if (other < best) best = other;
  other = 1 + edits_by_definition(a, n, b, m - 1);
  if (other < best) best = other;
  if (n > 1 && m > 1 && a[n - 1] == b[m - 2] && a[n - 2] == b[m - 1]) {
    other = 1 + edits_by_definition(a, n - 2, b, m - 2);
    if (other < best) best = other;
  }
  return best;
}

TEST(edits_between_words) {
  char a[8], b[8];
  rng.state = 7;
  for (int trial = 0; trial < 2000; trial++) {
    size_t n = rng_next(&rng) % 6, m = rng_next(&rng) % 6;
    for (size_t i = 0; i < 6; i++) a[i] = (char)('a' + rng_next(&rng) % 3), b[i] = (char)('a' + rng_next(&rng) % 3);
    ck_assert_msg(word_edits(a, n, b, m) == edits_by_definition(a, n, b, m), "%.*s, %.*s: %zu", (int)n, a, (int)m, b,
                  word_edits(a, n, b, m));
  }
  ck_assert_uint_eq(word_edits("Orbit", 5, "oRBIT", 5), 0);
}

TABLE(meant, "tests/cases/suggestions.tsv", 2);

/* One edit in words of 3 to 7 characters, two in longer ones, none in shorter ones; the nearest alone, at most
   three. */
TEST_EACH(what_was_meant, meant.n) {
  static const char *const known[] = {"orbit", "simulate", "sweep", "e1", "V", "eq-40", "eq-41", "eq-42", "eq-43"};
  struct suggestion s;
  LOCAL(text, word, t);
  field_expand(&word, meant.row[_i][0], NULL);
  suggest_begin(&s, text_str(&word), word.len);
  for (size_t i = 0; i < COUNT(known); i++) suggest_try(&s, known[i]);
  suggest_print(&t, &s);
  ck_assert_str_eq(text_str(&t), meant.row[_i][1]);
}

/* ---- truth */

/* Kleene's logic is the order FALSE < UNKNOWN < TRUE: and is the minimum, or the maximum, not turns it round. */
TEST(kleene) {
  static const truth order[] = {TRUTH_FALSE, TRUTH_UNKNOWN, TRUTH_TRUE};
  for (int i = 0; i < 3; i++) {
    ck_assert_int_eq(truth_not(order[i]), order[2 - i]);
    for (int k = 0; k < 3; k++) {
      ck_assert_int_eq(truth_and(order[i], order[k]), order[i < k ? i : k]);
      ck_assert_int_eq(truth_or(order[i], order[k]), order[i > k ? i : k]);
    }
  }
}

/* ---- memory */

/* Pieces of many sizes: aligned, zero, and none overlaps another. */
TEST(arena_pieces) {
  enum { N = 3000 };
  static unsigned char *piece[N];
  static size_t size[N];
  struct arena a;
  arena_init(&a);
  rng.state = 2;
  for (int i = 0; i < N; i++) {
    size[i] = i % 500 == 499 ? 3000000 : rng_next(&rng) % (i % 10 ? 50 : 9000);
    piece[i] = arena_alloc(&a, size[i]);
    ck_assert_uint_eq((uintptr_t)piece[i] % _Alignof(max_align_t), 0);
    size_t nonzero = 0;
    for (size_t k = 0; k < size[i]; k++) nonzero += piece[i][k] != 0;
    ck_assert_uint_eq(nonzero, 0);
    memset(piece[i], i % 255 + 1, size[i]);
  }
  for (int i = 0; i < N; i++) {
    size_t changed = 0;
    for (size_t k = 0; k < size[i]; k++) changed += piece[i][k] != i % 255 + 1;
    ck_assert_msg(changed == 0, "piece %d of %zu bytes was written over", i, size[i]);
  }
  char *s = arena_strndup(&a, "abcdef", 3);
  ck_assert_str_eq(s, "abc");
  ck_assert_str_eq(arena_strndup(&a, "", 0), "");
  arena_clear(&a);
  ck_assert_ptr_null(a.head);
  arena_clear(&a);
}

TEST(grown_arrays) {
  int *v = NULL;
  size_t cap = 0, moves = 0;
  for (int i = 0; i < 10000; i++) {
    size_t before = cap;
    v = ss_grow(v, (size_t)i, &cap, sizeof *v);
    moves += cap != before;
    ck_assert(cap > (size_t)i);
    v[i] = i;
  }
  for (int i = 0; i < 10000; i++) ck_assert_int_eq(v[i], i);
  ck_assert_uint_le(moves, 14); /* doubling: 2^14 > 10000 */
  free(v);
  void *none = ss_malloc(0);
  ck_assert_ptr_nonnull(none);
  free(ss_realloc(none, 0));
}

static void exhaust_arena(void) {
  struct arena a;
  arena_init(&a);
  arena_alloc(&a, SIZE_MAX);
}
static void exhaust_array(void) {
  size_t cap = 0;
  free(ss_grow(NULL, 0, &cap, SIZE_MAX / 4));
}

TEST(exhausted_memory_ends_with_5) {
  ck_assert_int_eq(child_end(exhaust_arena), 5);
  ck_assert_int_eq(child_end(exhaust_array), 5);
}
