/* The result record of a study of damages: the names of fates and classes, how many damages a row counts, the score. */
#include "mutation_result.h"

#include <stdlib.h>

#define FATE_STRING(upper, lower) #lower,
const char *const mutant_fate_name[N_MUTANT_FATES] = {FATES(FATE_STRING)};
#undef FATE_STRING

#define CLASS_INFO(name, words, counts) {words, counts},
const struct damage_class_info damage_classes[N_DAMAGE_CLASSES] = {DAMAGE_CLASSES(CLASS_INFO)};
#undef CLASS_INFO

long mutation_row_total(const struct mutation_row *r) {
  long n = 0;
  for (int i = 0; i < N_MUTANT_FATES; i++) n += r->count[i];
  return n;
}

long mutation_row_noticed(const struct mutation_row *r) {
  return r->count[FATE_NOTICED] + r->count[FATE_UNREADABLE] + r->count[FATE_UNPROVED] + r->count[FATE_REFUSED];
}

long mutation_row_counted(const struct mutation_row *r) {
  return mutation_row_total(r) - r->count[FATE_EQUIVALENT] - r->count[FATE_ON_MOTIONS] - r->count[FATE_NEEDS_TEXT];
}

static void add_to_score(struct mutation_score *s, const struct mutation_row *r) {
  s->counted += mutation_row_counted(r);
  s->noticed += mutation_row_noticed(r);
  s->equivalent += r->count[FATE_EQUIVALENT];
  s->on_motions += r->count[FATE_ON_MOTIONS];
  s->needs_text += r->count[FATE_NEEDS_TEXT];
}

void mutation_score_of(struct mutation_score *s, const struct mutation_result *r) {
  *s = (struct mutation_score){.errata = mutation_row_total(&r->errata)};
  add_to_score(s, &r->formulas);
  s->formulas = s->counted;
  for (int k = 0; k < N_DAMAGE_CLASSES; k++)
    if (damage_classes[k].counts)
      add_to_score(s, &r->data[k]);
    else
      s->errata += mutation_row_total(&r->data[k]);
}

void mutation_result_init(struct mutation_result *r) {
  *r = (struct mutation_result){.formulas.name = "formulas",
                                .printed.name = "of them printed text that the errata correct",
                                .errata.name = "formulas of errata.eq"};
  for (int k = 0; k < N_DAMAGE_CLASSES; k++) r->data[k].name = damage_classes[k].words;
}

void mutation_result_clear(struct mutation_result *r) {
  free(r->file);
  free(r->survivor);
  free(r->damaged);
  arena_clear(&r->arena);
}
