/* Groups of claims, by what their files say about them: one table of tests on attributes. */
#include "claim.h"
#include <string.h>

enum test {
  ALWAYS,
  IS,       /* the attribute is this word */
  IS_NAMED, /* the attribute is the word behind the group's name, "section stability" */
  IS_THERE,
  IS_ABSENT,
  SPEAKS_OF /* the attribute has this symbol in it, with or without an index: J, J_a */
};

/* Rows of one group stand together; a claim belongs to it when one of them holds. */
static const struct group {
  const char *name, *attribute;
  enum test test;
  const char *word;
} groups[] = {{"all", NULL, ALWAYS, NULL},
              {"section", "section", IS_NAMED, "NAME"},
              {"kind", "kind", IS_NAMED, "NAME"},
              {"record", "record", IS_NAMED, "VERDICT"},
              {"equations", "equation", IS_THERE, NULL},
              {"sentences", "equation", IS_ABSENT, NULL},
              {"definitions", "kind", IS, "definition"},
              {"matrices", "kind", IS, "matrix"},
              {"jacobians", "value", SPEAKS_OF, "J"},
              {"jacobians", "oracle", SPEAKS_OF, "J"},
              {"jacobians", "quote", SPEAKS_OF, "J"},
              {"identities", "kind", IS, "identity"},
              {"inequalities", "kind", IS, "inequality"},
              {"inequalities", "kind", IS, "sharp"},
              {"numbers", "kind", IS, "number"},
              {"numbers", "kind", IS, "closure"},
              {"arguments", "kind", IS, "argument"},
              {"behaviours", "kind", IS, "behaviour"},
              {"behaviours", "kind", IS, "sequence"}};
enum { N_GROUPS = sizeof groups / sizeof *groups };

/* The paper's sections, as the files of claims number them. */
static const char *const sections[] = {"model",      "prediction", "periodic",   "stability",
                                       "validation", "appendix_a", "appendix_b", "conclusion"};

static bool speaks_of(const char *text, const char *symbol) {
  size_t n = strlen(symbol);
  for (const char *p = strstr(text, symbol); p; p = strstr(p + 1, symbol))
    if ((p == text || !char_is_word(p[-1])) && !char_is_letter_or_digit(p[n])) return true;
  return false;
}

/* "4" stands for the fourth section. */
static const char *section_named(const char *word) {
  bool number = word[0] >= '1' && word[0] <= '8' && !word[1];
  return number ? sections[word[0] - '1'] : word;
}

/* What stands behind the group's name in the item; NULL when the item is of another group. */
static const char *rest_of(const struct group *g, const char *item) {
  size_t n = strlen(g->name);
  if (strncmp(item, g->name, n) != 0) return NULL;
  if (g->test != IS_NAMED) return item[n] ? NULL : item + n;
  return item[n] == ' ' && item[n + 1] && !strchr(item + n + 1, ' ') ? item + n + 1 : NULL;
}

static bool belongs(const struct claim *c, const struct group *g, const char *rest) {
  const char *has = g->attribute ? claim_get(c, g->attribute) : NULL;
  switch (g->test) {
  case ALWAYS:
    return true;
  case IS:
    return claim_says(c, g->attribute, g->word);
  case IS_NAMED:
    return has && strcmp(has, strcmp(g->name, "section") == 0 ? section_named(rest) : rest) == 0;
  case IS_THERE:
    return has != NULL;
  case IS_ABSENT:
    return has == NULL;
  default:
    return has && speaks_of(has, g->word);
  }
}

bool claim_group_known(const char *item) {
  for (int i = 0; i < N_GROUPS; i++)
    if (rest_of(&groups[i], item)) return true;
  return false;
}

void claim_groups_print(struct text *out) {
  for (int i = 0; i < N_GROUPS; i++) {
    if (i > 0 && strcmp(groups[i].name, groups[i - 1].name) == 0) continue;
    text_printf(out, "%s%s", i ? ", " : "", groups[i].name);
    if (groups[i].test == IS_NAMED) text_printf(out, " %s", groups[i].word);
  }
}

bool claim_asked_for(const struct claim *c, const char *item) {
  if (!claim_group_known(item)) return claim_selected(c->id, item) || claim_makes(c, item);
  for (int i = 0; i < N_GROUPS; i++) {
    const char *rest = rest_of(&groups[i], item);
    if (rest && belongs(c, &groups[i], rest)) return true;
  }
  return false;
}
