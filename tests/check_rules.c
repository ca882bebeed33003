/* Damages to what an audit is made of, each to a copy of a data folder: a rule of the claims names it, a correction or
   a control is judged again, another paper says something else, a quotation is not found.  Nothing that the program
   does not know is refuted, and no slip of the one who types is charged to the paper.  What must be said is written by
   hand beside what is done. */
#include "test.h"

TABLE(rows, "tests/cases/damaged.tsv", 6);
enum { FOLDER, CHANGED, SCRIPT, ASK, STATUS, SAYS }; /* its columns */

CASE("damages", .each = {scratch_open, scratch_close});

TEST_EACH(damages_are_noticed, rows.n) {
  char *const *row = rows.row[_i];
  const bool writes = strncmp(row[ASK], "verify", 6) == 0 && !strstr(row[ASK], "--plan");
  shell_ends(atoi(row[STATUS]), row[SAYS],
             "cp -R %s $D/data && sed -i -f /dev/stdin $D/data/%s << 'END' && ! cmp -s %s/%s $D/data/%s || exit 99\n"
             "%s\nEND\nSTICKSLIP_DATA=$D/data $P %s%s",
             row[FOLDER], row[CHANGED], row[FOLDER], row[CHANGED], row[CHANGED], row[SCRIPT], row[ASK],
             writes ? " --out $D/out" : "");
}
