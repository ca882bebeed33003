/* Titles that are given: sentences in words, in which every formula, name, number and phase is a slot. */
#include "title_impl.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- Slots --- */

/* "eq-3, eq-4" as "(3) and (4)". */
static bool write_records(struct text *out, const struct title *t, const char *attribute) {
  OWNED(title_list) l = {.n = 0};
  char item[64];
  for (const char *at = claim_get(t->c, attribute); (at = claim_next_item(item, sizeof item, at)) != NULL;) {
    const struct statement_record *r = title_record(t, item, strlen(item));
    struct text *to = title_list_next(&l);
    if (r)
      title_name(to, t, r);
    else
      text_add(to, item);
  }
  title_list_write(out, &l);
  return true;
}

static bool write_parts(struct text *out, const struct title *t, const char *attribute) {
  struct title_parts p = {.one = N_PHASES, .several = true};
  return title_parts_write(out, &p, t, attribute);
}

static bool write_range(struct text *out, const struct title *t, const char *attribute) {
  char *end;
  long first = strtol(claim_get(t->c, attribute), &end, 10), last = strtol(end, NULL, 10);
  title_count(out, first);
  text_add(out, " to ");
  title_count(out, last);
  return true;
}

static bool write_count(struct text *out, const struct title *t, const char *attribute) {
  title_count(out, strtol(claim_get(t->c, attribute), NULL, 10));
  return true;
}

static bool write_number(struct text *out, const struct title *t, const char *attribute) {
  text_printf(out, "(%s)", claim_get(t->c, attribute));
  return true;
}

static bool write_mass(struct text *out, const struct title *t, const char *attribute) {
  text_add(out, claim_says(t->c, attribute, "1") ? "first" : "second");
  return true;
}

/* Which friction limits the force of a mass that sticks; that of (2) where it is not said. */
static bool write_limit(struct text *out, const struct title *t, const char *attribute) {
  text_add(out, claim_says(t->c, attribute, "u_s") ? "sliding" : "static");
  return true;
}

static bool write_phases(struct text *out, const struct title *t, const char *attribute) {
  title_phases_listed(out, claim_get(t->c, attribute));
  return true;
}

static bool write_list(struct text *out, const struct title *t, const char *attribute) {
  title_listed(out, claim_get(t->c, attribute), ',');
  return true;
}

static const struct {
  const char *attribute;
  bool (*write)(struct text *out, const struct title *t, const char *attribute);
} slots[] = {{"statement", write_records}, {"statements", write_records}, {"depends-on", write_records},
             {"premises", write_parts},    {"conclusion", write_parts},   {"constraints", write_parts},
             {"range", write_range},       {"rank", write_count},         {"equation", write_number},
             {"word", write_phases},       {"formula", title_formula},    {"reads", title_formula},
             {"repaired", title_formula},  {"unknowns", write_list},      {"absent", write_list},
             {"mass", write_mass},         {"limit", write_limit},        {"criterion", write_records}};

/* A text and, where it is a claim's own, its field. */
struct sentence_text {
  const char *text;
  const struct field *field;
};

static bool complain(const struct title *t, const struct sentence_text *s, const char *at, const char *what,
                     const char *which) {
  size_t place = t->c->record->id.begin;
  if (s->field) place = s->field->value.begin;
  if (s->field && s->field->value.end - s->field->value.begin == strlen(s->text)) place += (size_t)(at - s->text);
  return diag_at(t->d, &t->c->file->src, place, what, t->c->id, which);
}

/* The slot that begins at p, up to its brace; where it ends, NULL with t->d set. */
static const char *write_slot(struct text *out, const struct title *t, const struct sentence_text *s, const char *p) {
  char name[32];
  size_t len = strcspn(p + 1, "{}");
  if (p[1 + len] != '}' || len >= sizeof name) {
    complain(t, s, p, "%s: {%s is no attribute in braces", "...");
    return NULL;
  }
  memcpy(name, p + 1, len);
  name[len] = '\0';
  const char *text = strcmp(name, "title") == 0 ? NULL : claim_get(t->c, name);
  if (!text && strcmp(name, "limit") != 0) {
    complain(t, s, p, "%s: the claim has no attribute %s for its title", name);
    return NULL;
  }
  size_t i = 0, n = sizeof slots / sizeof *slots;
  while (i < n && strcmp(slots[i].attribute, name) != 0) i++;
  if (i == n) text_add(out, text);
  return i == n || slots[i].write(out, t, name) ? p + len + 2 : NULL;
}

/* --- What is named by hand --- */

/* A formula, a name of the paper, or a number. */
static bool word_is_named(const struct model *m, const char *word, size_t len) {
  char name[64];
  for (size_t i = 0; i < len; i++)
    if (char_is_digit(word[i]) || word[i] == '_') return true;
  if (len >= sizeof name) return false;
  memcpy(name, word, len);
  name[len] = '\0';
  return title_is_count(word, len) || model_is_symbol(m, name) || title_defines(m, name, len);
}

/* "a motion" in a paper that has a symbol a; "a is positive" names it. */
static bool is_article(const char *p) {
  return (*p == 'a' || *p == 'A') && p[1] == ' ' && char_is_letter(p[2]) && strncmp(p + 2, "is ", 3) != 0;
}

/* How long the name of a phase is that begins here; 0: none does. */
static size_t phase_named(const char *p) {
  static const char *const others[] = {"stick phase", "slip phase"};
  for (int i = 0; i < N_PHASES; i++)
    if (strncmp(p, phase_words[i], strlen(phase_words[i])) == 0) return strlen(phase_words[i]);
  for (size_t i = 0; i < sizeof others / sizeof *others; i++)
    if (strncmp(p, others[i], strlen(others[i])) == 0) return strlen(others[i]);
  return 0;
}

/* How many characters at p name something by hand; *plain otherwise becomes how many say nothing of the kind. */
static size_t named_by_hand(size_t *plain, const struct model *m, const char *p, bool word_begins) {
  *plain = 1;
  if (strchr("=<>|^*+", *p)) return 1;
  if (!word_begins || !char_is_word(*p)) return 0;
  size_t phase = phase_named(p), word = 0;
  while (char_is_word(p[word])) word++;
  *plain = word;
  return phase ? phase : word_is_named(m, p, word) && !is_article(p) ? word : 0;
}

static bool expand(struct text *out, const struct title *t, const struct sentence_text *s) {
  const char *p = s->text;
  while (*p) {
    size_t plain = 1, named = 0;
    if (*p == '{') {
      if (!(p = write_slot(out, t, s, p))) return false;
      continue;
    }
    if (s->field) named = named_by_hand(&plain, t->m, p, p == s->text || !char_is_word(p[-1]));
    if (named) {
      char word[64];
      snprintf(word, sizeof word, "%.*s", (int)named, p);
      return complain(t, s, p, "%s: the title names %s by hand, where an attribute in braces belongs", word);
    }
    text_add_n(out, p, plain);
    p += plain;
  }
  return true;
}

bool title_given(struct text *out, const struct title *t, const struct field *title) {
  const struct sentence_text s = {title->text, title};
  return expand(out, t, &s);
}

bool title_expand(struct text *out, const struct title *t, const char *text) {
  const struct sentence_text s = {text, NULL};
  return expand(out, t, &s);
}
