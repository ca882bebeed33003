/* What is different about the orbits of a scene that names another word than the paper's: how they are found, and what
   is said of the word; and which orbits of any scene a certificate is of. */
#include "word_orbits.h"

slong system_bits(slong digits) {
  return solved_word_bits(digits) + 64;
}

bool may_write_certificate(const struct scene *s, slong certified, slong n, struct diag *d) {
  if (certified == 0)
    diag_set(d,
             "%s: error: no orbit is certified and keeps to the phases of its word, so that there is no certificate to "
             "write",
             s->path);
  else if (certified < n)
    fprintf(stderr,
            "%s: warning: %ld of %ld orbits are in the certificate; the others are not certified, or do not keep to "
            "their phases\n",
            s->path, (long)certified, (long)n);
  return certified > 0;
}

bool find_word_orbits(struct word_orbits *list, const struct scene *s, slong digits, struct diag *d) {
  if (phase_word_fate(NULL, &s->word) != WORD_OPEN) return true;
  if (scene_lacks_friction(s, &s->word))
    return diag_set(d, "%s: error: a word in which a mass is faster than the belt needs u_r1 and u_r2", s->path);
  if (solved_word(list, &s->word, s, digits) != SS_OK)
    abort(); /* the scene is in the domain, and has the friction that the word needs */
  return true;
}

static const char not_complete[] = "no proof of completeness covers this word";

void word_json(struct json *j, const struct scene *s) {
  OWNED(text) why = {0};
  enum word_fate fate = phase_word_fate(&why, &s->word);
  bool complete = fate == WORD_IMPOSSIBLE || fate == WORD_UNCLOSED;
  JSON_STRING(j, "word", phase_word_print(j->out, &s->word));
  json_string(j, "fate", word_fate_name[fate]);
  json_string(j, "reason", fate == WORD_OPEN ? NULL : text_str(&why));
  json_bool(j, "complete", complete);
  json_string(j, "gap", complete ? NULL : not_complete);
}

void word_text(struct text *out, const struct word_orbits *list, const struct scene *s) {
  OWNED(text) why = {0};
  enum word_fate fate = phase_word_fate(&why, &s->word);
  text_printf(out, "%s: %d orbit%s of the word ", s->name, list->found.n, plural_s(list->found.n));
  phase_word_print(out, &s->word);
  text_add(out, " found\n");
  if (fate == WORD_IMPOSSIBLE || fate == WORD_UNCLOSED)
    text_printf(out, "there is none: %s\n", text_str(&why));
  else if (fate != WORD_OPEN)
    text_printf(out, "none searched for: %s\n", text_str(&why));
  else
    text_printf(out, "not proved complete: %s; %ld evaluations, %d starts of Newton's iteration\n", not_complete,
                list->evaluations, list->found.candidates);
  if (list->found.failed > 0)
    text_printf(out, "%d solution%s in double precision could not be enclosed\n", list->found.failed,
                plural_s(list->found.failed));
}
