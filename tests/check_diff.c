/* The reader of JSON, by RFC 8259, and what diff makes of two audits. */
#include "base/json.h"
#include "test.h"

/* --- Reading --- */

static bool parse(struct json_value *v, struct arena *a, const char *text, struct diag *d) {
  diag_init(d);
  OWNED(source) s = source_of("x.json", text);
  return json_parse(v, a, &s, d);
}

TEST(what_json_is) {
  OWNED(table) good = table_read("tests/cases/json_good.tsv", 1);
  LOCAL(arena, a);
  struct json_value v;
  for (int i = 0; i < good.n; i++) goes_well(parse(&v, &a, good.row[i][0], &d));
}

TEST(what_json_is_not) {
  enum { TEXT, SAYS };
  OWNED(table) bad = table_read("tests/cases/json_bad.tsv", 2);
  LOCAL(arena, a);
  struct diag d;
  struct json_value v;
  for (int i = 0; i < bad.n; i++) {
    ck_assert_msg(!parse(&v, &a, bad.row[i][TEXT], &d), "%s", bad.row[i][TEXT]);
    ck_assert_msg(strncmp(d.message, "x.json:", 7) == 0 && strstr(d.message, bad.row[i][SAYS]), "%s: %s",
                  bad.row[i][TEXT], d.message);
  }
}

TEST(values_are_those_written) {
  LOCAL(arena, a);
  struct json_value v;
  goes_well(parse(
      &v, &a, "{\"s\": \"\\u20ac \\ud834\\udd1e \\u00e9\\n\", \"n\": -1.50e3, \"t\": true, \"l\": [1, [], null]}", &d));
  ck_assert_uint_eq(v.n, 4);
  ck_assert_str_eq(json_text(&v, "s"), "\xe2\x82\xac \xf0\x9d\x84\x9e \xc3\xa9\n");
  ck_assert_str_eq(json_member(&v, "n")->text, "-1.50e3");
  ck_assert(json_member(&v, "t")->truth && json_text(&v, "n") == NULL && json_text(&v, "none") == NULL);
  const struct json_value *list = json_member(&v, "l");
  ck_assert(list->n == 3 && list->first->next->kind == JSON_KIND_ARRAY &&
            list->first->next->next->kind == JSON_KIND_NULL);
  ck_assert(list->first->next->next->next == NULL && json_member(list, "l") == NULL);
}

TABLE(same_values, "tests/cases/json_same.tsv", 3);
enum { FIRST, SECOND, SAME }; /* its columns */

TEST_EACH(sameness, same_values.n) {
  char *const *row = same_values.row[_i];
  LOCAL(arena, a);
  struct json_value x, y;
  goes_well(parse(&x, &a, row[FIRST], &d));
  goes_well(parse(&y, &a, row[SECOND], &d));
  ck_assert_msg(json_same(&x, &y) == is_yes(row[SAME]) && json_same(&y, &x) == is_yes(row[SAME]), "%s %s", row[FIRST],
                row[SECOND]);
}

TEST(limits) {
  static const struct {
    size_t depth;
    bool ok;
  } cases[] = {{64, true}, {65, false}, {1000000, false}};
  LOCAL(arena, a);
  struct diag d;
  struct json_value v;
  for (size_t i = 0; i < COUNT(cases); i++) {
    ck_assert_msg(parse(&v, &a, nested("[", "", "]", cases[i].depth), &d) == cases[i].ok, "%zu: %s", cases[i].depth,
                  d.message);
    ck_assert(cases[i].ok || strstr(d.message, "nested too deeply"));
  }
  for (int n = 1000; n <= 1001; n++) {
    LOCAL(text, t);
    for (int i = 0; i < n; i++) text_printf(&t, "%s\"%d\":0", i ? "," : "{", i);
    text_add(&t, "}");
    ck_assert_int_eq(parse(&v, &a, t.data, &d), n == 1000);
    ck_assert(n == 1000 || strstr(d.message, "too many members"));
  }
}

/* --- The command --- */

/* Compares two texts; the exit status.  What is printed goes to the files out and err. */
static int diff(const char *a, const char *b, const char *option) {
  scratch_put("a.json", a);
  scratch_put("b.json", b);
  return shell("\"$P\" diff \"$D/a.json\" \"$D/b.json\" %s > \"$D/out\" 2> \"$D/err\"", option);
}

TABLE(differences, "tests/cases/differences.tsv", 5);
enum { ONE, OTHER, OPTION, STATUS, SAID }; /* its columns */

/* What stands for what in the table. */
static const char *const abbreviated[][2] = {
    {"two",
     "{\"schema\":\"stickslip-audit-2\",\"scene\":\"s\",\"summary\":{\"proved\":2,\"refuted\":0},\"checks\":{},"
     "\"claims\":[{\"id\":\"x\",\"verdict\":\"proved\",\"effect\":null},{\"id\":\"y\",\"verdict\":\"proved\"}]}"},
    {"head", "{\"schema\":\"stickslip-audit-2\",\"scene\":\"s\",\"summary\":{"},
    {"claims", "},\"checks\":{},\"claims\":["},
    {"claim", "{\"id\":\""},
    {"is", "\",\"verdict\":\""},
    {NULL, NULL}};

CASE("command", .each = {scratch_open, scratch_close});

/* What is refused is refused as the first audit and as the second. */
TEST_EACH(differences_are_told, differences.n) {
  char *const *row = differences.row[_i];
  LOCAL(text, one, other);
  field_expand(&one, row[ONE], abbreviated);
  field_expand(&other, row[OTHER], abbreviated);
  ck_assert_int_eq(diff(text_str(&one), text_str(&other), row[OPTION]), atoi(row[STATUS]));
  check_is("out", row[SAID]);
  if (atoi(row[STATUS]) < 3) {
    check_is("err", "");
  } else {
    ck_assert_int_eq(diff(text_str(&other), text_str(&one), "--json"), 3);
    check_is("out", "");
  }
}

TEST(changes_as_json) {
  LOCAL(text, one, other);
  field_expand(&one, "{two}", abbreviated);
  field_expand(&other,
               "{head}\"proved\":2,\"refuted\":0{claims}{claim}x{is}proved\",\"effect\":1},{claim}y{is}unknown\"}]}",
               abbreviated);
  ck_assert_int_eq(diff(text_str(&one), text_str(&other), "--json"), 1);
  shell_well("\"$Y\" tests/oracle/validate.py schema/diff.schema.json \"$D/out\"");
  OWNED(source) s;
  LOCAL(arena, a);
  struct json_value v;
  goes_well(source_read(&s, scratch_path("out"), 1 << 20, &d));
  goes_well(json_parse(&v, &a, &s, &d));
  ck_assert_str_eq(json_text(&v, "schema"), "stickslip-diff-1");
  ck_assert(json_member(&v, "changed")->truth && json_member(&v, "counts")->n == 0);
  const struct json_value *verdict = json_member(&v, "verdicts")->first, *member = json_member(&v, "members")->first;
  ck_assert_str_eq(json_text(verdict, "claim"), "y");
  ck_assert_str_eq(json_text(verdict, "first"), "proved");
  ck_assert_str_eq(json_text(verdict, "second"), "unknown");
  ck_assert_str_eq(json_text(member, "claim"), "x");
  ck_assert_str_eq(json_text(member, "member"), "effect");
}

/* Many claims in the opposite order. */
TEST(many_claims) {
  LOCAL(text, a, b);
  field_expand(&a, "{head}{claims}", abbreviated);
  field_expand(&b, "{head}{claims}", abbreviated);
  for (int i = 0; i < 50000; i++) {
    text_printf(&a, "%s{\"id\":\"%d\",\"verdict\":\"proved\"}", i ? "," : "", i);
    text_printf(&b, "%s{\"id\":\"%d\",\"verdict\":\"proved\"}", i ? "," : "", 49999 - i);
  }
  text_add(&a, "]}");
  text_add(&b, "]}");
  ck_assert_int_eq(diff(a.data, b.data, ""), 0);
}
