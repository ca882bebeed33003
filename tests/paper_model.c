#include "paper_model.h"

#include <check.h>

#include "scratch.h"

void paper_model(struct model *m, const char *overlay, bool with_controls) {
  struct diag d;
  diag_init(&d);
  model_init(m);
  bool ok = model_add_folder(m, "verify/paper", RANK_PAPER, &d) &&
            (!overlay || model_add_file(m, scratch_put("overlay.eq", overlay), RANK_USER, &d)) &&
            model_add_file(m, "verify/errata.eq", RANK_ERRATA, &d) &&
            (!with_controls || model_add_folder(m, "verify/controls", RANK_CONTROL, &d));
  ck_assert_msg(ok, "%s", d.message);
}
