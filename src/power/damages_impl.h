/* What the makers of damages share. */
#ifndef STICKSLIP_POWER_DAMAGES_IMPL_H
#define STICKSLIP_POWER_DAMAGES_IMPL_H

#include "damages.h"

/* A field to be damaged. */
struct maker {
  struct damages *out;
  const struct material *m;
  size_t file;
  const struct record *record;
  const struct field *field; /* NULL: the record as a whole */
  enum damage_class class;
  const char *text;   /* of the file */
  const char *excuse; /* of what is added now; none when a maker begins */
};
typedef void damage_fn(struct maker *k);

/* Adds the damage: bytes of the file from begin to end become n bytes of now. */
void maker_add(struct maker *k, size_t begin, size_t end, const char *now, size_t n, const char *rule);
void maker_put(struct maker *k, size_t begin, size_t end, const char *now);
/* The field with its line goes, or the record with its lines. */
damage_fn maker_delete;

/* Damages of the field's value, character by character: each digit is the next one; "+" and "-", "<" and ">" turn;
   words are exchanged by a list; an index of one letter is its neighbour; a bar of an absolute value is moved. */
damage_fn maker_digits, maker_signs, maker_index, maker_bars;
/* A list of texts for others, "was:now", and for one another, "was|now", with commas between; only between characters
   that are part of no word. */
void maker_exchange(struct maker *k, const char *list);

/* By lines (damage_lines.c). */
damage_fn damage_citations, damage_order, damage_premises, damage_points, damage_routes, damage_one_of,
    damage_parameters, damage_phases, damage_restriction, damage_control_claim, damage_control_line,
    damage_control_formula;
/* By words (damage_words.c). */
damage_fn damage_tex, damage_quotation, damage_number, damage_title;

#endif
