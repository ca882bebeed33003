/* Damaged data as an audit would meet them: read, checked, and judged where they are concerned. */
#ifndef STICKSLIP_POWER_DAMAGE_STUDY_H
#define STICKSLIP_POWER_DAMAGE_STUDY_H

#include "damages.h"
#include "quote/quote.h"

/* What became of a damage, and the first words of what was said of it; the rule where it is equivalent. */
enum { DAMAGE_WORDS = 240 };
struct damage_said {
  enum mutant_fate fate;
  char says[DAMAGE_WORDS];
};

struct damage_study;
/* All is borrowed; text: of the paper, or NULL. */
struct damage_study *damage_study_new(const struct material *m, const struct paper_text *text);
void damage_study_free(struct damage_study *s);

/* The damaged text in the place of its file: refused by what reads or checks it, or because a quotation is not found in
   the paper's text any more; unreadable where a claim that it concerns cannot be judged then; noticed where the
   verdict of one, of its correction or of a claim that it makes is another, or a control beside it is not refuted.

   Concerned are the claim or control whose record it is, and the controls of that claim; of equations, where a typed
   line is another, the claims that read the record, or the control whose record it is; of a scene, the claims that are
   about one scene.  Equivalent is what nothing notices and the damage excuses.  Verdicts are held against those without
   the damage, which are found when first asked for. */
void damage_try(struct damage_said *out, struct damage_study *s, const struct damage *d);

#endif
