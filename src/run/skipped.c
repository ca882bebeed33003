/* The ledger of what was not done: claims, controls and studies by the pieces that were made, routes by the evidence,
   the rest by what the work has touched. */
#include <string.h>

#include "base/work.h"
#include "claim/claim.h"
#include "claim/kinds.h"
#include "record/finding.h"
#include "record/routes.h"
#include "run.h"

bool run_is_whole(const struct audit_options *opt, const struct scene *s) {
  return opt->n_only == 0 && s->asked.claims.n == 0 && s->asked.values.n == 0 && s->asked.routes.n == 0;
}

static size_t count(const struct pieces *p, enum piece_kind kind) {
  size_t n = 0;
  for (size_t i = 0; i < p->n; i++) n += p->item[i].kind == kind;
  return n;
}

/* Whose doing it is that claims were left out. */
static const char *not_selected(const struct scene *s, const struct audit_options *opt) {
  if (opt->n_only == 0) return "the scene does not ask for them";
  return s->asked.claims.n == 0 ? "not selected by --only" : "not selected by the scene and --only together";
}

static bool in_evidence(const struct audit_result *out, const char *route) {
  for (size_t i = 0; i < out->n_findings; i++)
    for (int k = 0; k < out->findings[i].n_evidence; k++)
      if (strcmp(out->findings[i].evidence[k].route, route) == 0) return true;
  return false;
}

/* Each name once, in the order of the table. */
static void skip_routes(struct audit_result *out, const struct scene *s) {
  OWNED(text) names = {0};
  for (int i = 0; i < N_ROUTE_ROWS; i++) {
    const char *name = route_first_called(i);
    if (name && !in_evidence(out, name)) text_printf(&names, "%s%s", names.len ? ", " : "", name);
  }
  if (names.len)
    audit_leave_out(out, result_str(out, "routes %s", text_str(&names)),
                    s->asked.routes.n ? "the scene asks for other routes, or no claim judged asks for them"
                                      : "no claim judged asks for them");
}

/* The untouched of parts from .. to in one line; head: what their names have in common. */
static void skip_range(struct audit_result *out, unsigned touched, enum work_part from, enum work_part to,
                       const char *head, const char *why) {
  OWNED(text) names = {0};
  for (int part = (int)from; part <= (int)to; part++)
    if (!(touched >> part & 1U))
      text_printf(&names, "%s%s", names.len ? ", " : head, work_part_name[part] + (names.len ? strlen(head) : 0));
  if (names.len) audit_leave_out(out, result_copy(out, text_str(&names) + strlen(head)), why);
}

static void skip_parts(struct audit_result *out, unsigned touched) {
  static const char unreached[] = "nothing that was asked for reaches it";
  skip_range(out, touched, WORK_PHASE_D, WORK_PHASE_C, "phase ", unreached);
  for (int part = WORK_PHASE_C + 1; part < WORK_BITS_128; part++)
    skip_range(out, touched, (enum work_part)part, (enum work_part)part, "", unreached);
  skip_range(out, touched, WORK_BITS_128, WORK_BITS_1024, "balls of ",
             touched >> WORK_BITS_128 & 1U ? "nothing was undecided with fewer bits" : unreached);
}

void skipped_describe(const struct judge *j, const struct claims *controls, const struct audit_options *opt,
                      const struct pieces *first, const struct pieces *second, unsigned touched) {
  struct audit_result *out = j->out;
  const struct scene *s = j->scene;
  size_t others = j->claims->n - count(first, PIECE_CLAIM), unused = controls->n - count(second, PIECE_CONTROL);
  if (others) audit_leave_out(out, result_str(out, "%zu other claims", others), not_selected(s, opt));
  if (unused)
    audit_leave_out(out, result_str(out, "%zu controls", unused), "the claims that they stand beside are not selected");
  if (count(first, PIECE_ROUTES) == 0)
    audit_leave_out(out, "the study of the routes, the long runs and the pictures of the orbit",
                    run_is_whole(opt, s) ? "no file of the paper says \"model: two masses on a belt\""
                    : opt->n_only        ? "made by the whole audit, not with --only"
                                         : "the scene asks for less than everything");
  if (opt->readings && count(first, PIECE_READINGS) == 0)
    audit_leave_out(out, "readings of the printed numbers", "no claim about printed numbers is selected");
  skip_routes(out, s);
  if (opt->statements && run_is_whole(opt, s)) statements_unanswered(out, opt->statements);
  skip_parts(out, touched);
}
