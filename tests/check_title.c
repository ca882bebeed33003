/* Titles are made from what a claim says, and none states a fact beside it.  The expected titles are written by hand
   from the paper's text: what its equations say and where. */
#include "claim/claim.h"
#include "paper_model.h"
#include "test.h"
#include "value/title.h"

static void has_title(const struct model *m, const struct claim *c, const char *want) {
  LOCAL(text, title);
  struct diag d = {0};
  ck_assert_msg(claim_title(&title, m, c, NULL, &d), "%s: %s", c->id, d.message);
  ck_assert_msg(strcmp(text_str(&title), want) == 0, "%s: %s\ninstead of %s", c->id, text_str(&title), want);
}

/* --- Those on file --- */

TABLE(on_file, "tests/cases/titles.tsv", 2);
enum { ON_FILE_ID, ON_FILE_TITLE }; /* its columns */

CASE("title", .each = {paper_open, paper_close});

TEST_EACH(titles_say_what_claims_say, on_file.n) {
  has_title(&the_paper.model, paper_claim(on_file.row[_i][ON_FILE_ID]), on_file.row[_i][ON_FILE_TITLE]);
}

/* Plain text of a length that a table of the report holds, without the notation of the files. */
TEST(titles_are_read_as_they_stand) {
  enum { LONGEST = 175 };
  LOCAL(text, title);
  goes_well(titles_check(&the_paper.model, &the_paper.claims, &d));
  for (size_t i = 0; i < the_paper.claims.n; i++) {
    text_reset(&title);
    goes_well(claim_title(&title, &the_paper.model, &the_paper.claims.claim[i], NULL, &d));
    const char *s = text_str(&title);
    ck_assert_msg(title.len > 3 && title.len < LONGEST, "%s: %s", the_paper.claims.claim[i].id, s);
    ck_assert_msg(!strpbrk(s, "*{}[]\\$;") && !strstr(s, "  ") && !strstr(s, " , ") && !strstr(s, "first_order"),
                  "%s: %s", the_paper.claims.claim[i].id, s);
  }
}

/* Where another attribute is damaged, so is the title: the two cannot part. */
TABLE(damaged, "tests/cases/titles_of_fields.tsv", 2);
enum { DAMAGED_FIELDS, DAMAGED_TITLE }; /* its columns */

static const struct claim *one_claim(struct claims *own, const char *fields) {
  const char *path = scratch_print("own.claim", "claim own\n  section: stability\n  %s", fields);
  goes_well(claims_add_file(own, path, "claim", &d));
  return &own->claim[0];
}

TEST_EACH(titles_follow_the_fields, damaged.n) {
  OWNED(claims) own = {.n = 0};
  has_title(&the_paper.model, one_claim(&own, damaged.row[_i][DAMAGED_FIELDS]), damaged.row[_i][DAMAGED_TITLE]);
}

/* To first order in the perturbations says so; in some of them, or in something else, in which. */
TEST_EACH(first_order_in_what, 4) {
  static const char *const cases[][2] = {{"first_order(x*y; x, y)", "x y = 0 to first order"},
                                         {"first_order(x*y; x)", "x y = 0 to first order in x"},
                                         {"first_order(J_a*dz_0; x)", "J_a dz_0 = 0 to first order in x"},
                                         {"first_order(chi^2*V; chi, V)", "chi^2 V = 0 to first order in chi and V"}};
  OWNED(claims) own = {.n = 0};
  const char *overlay =
      scratch_print("overlay.eq", "equation text-own\n  section: stability\n  %s = 0\n", cases[_i][0]);
  OWNED(model) m = paper_model(&(struct paper_layers){.overlay = overlay});
  has_title(&m, one_claim(&own, "kind: identity\n  statement: text-own\n  points: arcs 4\n"), cases[_i][1]);
}

/* --- What a title by hand must not name, and where --- */

TABLE(refused, "tests/cases/titles_refused.tsv", 3);
enum { REFUSED_TITLE, REFUSED_COLUMN, REFUSED_SAYS }; /* its columns */

TEST_EACH(titles_name_nothing_by_hand, refused.n) {
  char *const *row = refused.row[_i];
  OWNED(claims) own = {.n = 0};
  LOCAL(text, fields, out);
  struct diag d = {0};
  text_printf(&fields, "kind: outside\n  title: %s\n", row[REFUSED_TITLE]);
  const struct claim *c = one_claim(&own, text_str(&fields));
  ck_assert_msg(!titles_check(&the_paper.model, &own, &d) && !claim_title(&out, &the_paper.model, c, NULL, &d),
                "%s is taken", row[REFUSED_TITLE]);
  const char *place = formatted("own.claim:4:%s: error: own: ", row[REFUSED_COLUMN]);
  ck_assert_msg(strstr(d.message, place) && strstr(d.message, row[REFUSED_SAYS]), "%s\ninstead of %s...%s", d.message,
                place, row[REFUSED_SAYS]);
}

/* What a title would be made of is missing, or names what is not there. */
TABLE(lacking, "tests/cases/titles_lacking.tsv", 4);
enum { LACKING_FIELDS, LACKING_LINE, LACKING_COLUMN, LACKING_SAYS }; /* its columns */

TEST_EACH(titles_that_cannot_be_made, lacking.n) {
  OWNED(claims) own = {.n = 0};
  LOCAL(text, out);
  struct diag d = {0};
  const struct claim *c = one_claim(&own, lacking.row[_i][LACKING_FIELDS]);
  ck_assert_msg(!claim_title(&out, &the_paper.model, c, NULL, &d), "%s", text_str(&out));
  const char *place = formatted("own.claim:%d:%d: error: own: ", atoi(lacking.row[_i][LACKING_LINE]),
                                atoi(lacking.row[_i][LACKING_COLUMN]));
  ck_assert_msg(strstr(d.message, place) && strstr(d.message, lacking.row[_i][LACKING_SAYS]), "%s\ninstead of %s...%s",
                d.message, place, lacking.row[_i][LACKING_SAYS]);
}

/* What is said by the attributes is not said again. */
TEST(no_title_beside_what_makes_one) {
  OWNED(claims) own = {.n = 0};
  one_claim(&own, "kind: identity\n  statement: eq-4\n  title: the masses are faster than the belt\n");
  fails_with(titles_check(&the_paper.model, &own, &d), "own.claim:5:3: error: own: its attributes make the title");
}

/* --- Another paper --- */

TEST(titles_of_another_paper) {
  LOCAL(model, m);
  OWNED(claims) own = {.n = 0}, d_there = {.n = 0}, no_j = {.n = 0};
  goes_well(model_add_folder(&m, "tests/another/paper", RANK_PAPER, &d));
  goes_well(claims_load(&own, "tests/another", "claims", "claim", &d));
  has_title(&m, claim_with_id(&own, "eq-1"), "D(t) is the propagator of the global stick phase");
  has_title(&m, claim_with_id(&own, "eq-2"), "det(D(t)) = 1 + t in the global stick phase");
  /* that paper has a name D, and none J */
  LOCAL(text, out);
  fails_with(claim_title(&out, &m, one_claim(&d_there, "kind: outside\n  title: the matrix D\n"), NULL, &d),
             "own.claim");
  has_title(&m, one_claim(&no_j, "kind: outside\n  title: the matrix J\n"), "the matrix J");
  /* nor does a paper about another system say what has a dimension there */
  LOCAL(model, row);
  OWNED(claims) of_row = {.n = 0};
  goes_well(model_add_folder(&row, "tests/row/paper", RANK_PAPER, &d));
  has_title(&row, one_claim(&of_row, "kind: scaling\n  statement: eq-5\n  scaled: kappa mu\n"),
            "(5) is homogeneous in kappa and mu");
}
