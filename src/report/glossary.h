/* What a report says all the time and a reader of the paper has not met, or has met in another sense. */
#ifndef STICKSLIP_GLOSSARY_H
#define STICKSLIP_GLOSSARY_H

#include <stddef.h>

struct glossary_entry {
  const char *word, *meaning; /* the meaning as a sentence without its stop, formulas between dollar signs */
};
extern const struct glossary_entry glossary[];
extern const size_t n_glossary;

#endif
