/* What a report says all the time and a reader of the paper has not met, or has met in another sense. */
#ifndef STICKSLIP_GLOSSARY_H
#define STICKSLIP_GLOSSARY_H

#include "record/result.h"

struct glossary_entry {
  const char *word, *meaning; /* the meaning as a sentence without its stop, formulas between dollar signs */
  bool of_motion;             /* said only where the paper is about the program's system */
};
/* The entry that follows, the first after NULL; NULL behind the last. */
const struct glossary_entry *glossary_next(const struct glossary_entry *last, const struct audit_result *r);

#endif
