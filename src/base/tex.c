/* The commands of LaTeX that formulas use, and the tokens of a formula. */
#include "base/tex.h"

#include <string.h>

#include "text.h"

/* --- Commands --- */

const struct tex_word *tex_word(const char *name, size_t len) {
  static const struct tex_word words[] = {
      {"alpha", TEX_ROLE_LETTER, 0, true, "\xce\xb1"},
      {"beta", TEX_ROLE_LETTER, 0, true, "\xce\xb2"},
      {"gamma", TEX_ROLE_LETTER, 0, true, "\xce\xb3"},
      {"delta", TEX_ROLE_LETTER, 0, true, "\xce\xb4"},
      {"epsilon", TEX_ROLE_LETTER, 0, true, "\xcf\xb5"},
      {"varepsilon", TEX_ROLE_LETTER, 0, true, "\xce\xb5"},
      {"zeta", TEX_ROLE_LETTER, 0, true, "\xce\xb6"},
      {"eta", TEX_ROLE_LETTER, 0, true, "\xce\xb7"},
      {"theta", TEX_ROLE_LETTER, 0, true, "\xce\xb8"},
      {"iota", TEX_ROLE_LETTER, 0, true, "\xce\xb9"},
      {"kappa", TEX_ROLE_LETTER, 0, true, "\xce\xba"},
      {"lambda", TEX_ROLE_LETTER, 0, true, "\xce\xbb"},
      {"mu", TEX_ROLE_LETTER, 0, true, "\xce\xbc"},
      {"nu", TEX_ROLE_LETTER, 0, true, "\xce\xbd"},
      {"xi", TEX_ROLE_LETTER, 0, true, "\xce\xbe"},
      {"pi", TEX_ROLE_LETTER, 0, true, "\xcf\x80"},
      {"rho", TEX_ROLE_LETTER, 0, true, "\xcf\x81"},
      {"sigma", TEX_ROLE_LETTER, 0, true, "\xcf\x83"},
      {"tau", TEX_ROLE_LETTER, 0, true, "\xcf\x84"},
      {"upsilon", TEX_ROLE_LETTER, 0, true, "\xcf\x85"},
      {"phi", TEX_ROLE_LETTER, 0, true, "\xcf\x95"},
      {"varphi", TEX_ROLE_LETTER, 0, true, "\xcf\x86"},
      {"chi", TEX_ROLE_LETTER, 0, true, "\xcf\x87"},
      {"psi", TEX_ROLE_LETTER, 0, true, "\xcf\x88"},
      {"omega", TEX_ROLE_LETTER, 0, true, "\xcf\x89"},
      {"Gamma", TEX_ROLE_UPRIGHT, 0, true, "\xce\x93"},
      {"Delta", TEX_ROLE_UPRIGHT, 0, true, "\xce\x94"},
      {"Theta", TEX_ROLE_UPRIGHT, 0, true, "\xce\x98"},
      {"Lambda", TEX_ROLE_UPRIGHT, 0, true, "\xce\x9b"},
      {"Xi", TEX_ROLE_UPRIGHT, 0, true, "\xce\x9e"},
      {"Pi", TEX_ROLE_UPRIGHT, 0, true, "\xce\xa0"},
      {"Sigma", TEX_ROLE_UPRIGHT, 0, true, "\xce\xa3"},
      {"Upsilon", TEX_ROLE_UPRIGHT, 0, true, "\xce\xa5"},
      {"Phi", TEX_ROLE_UPRIGHT, 0, true, "\xce\xa6"},
      {"Psi", TEX_ROLE_UPRIGHT, 0, true, "\xce\xa8"},
      {"Omega", TEX_ROLE_UPRIGHT, 0, true, "\xce\xa9"},
      {"infty", TEX_ROLE_UPRIGHT, 0, true, "\xe2\x88\x9e"},
      {"circ", TEX_ROLE_ORDINARY, 0, true, "\xe2\x88\x98"},
      {"vert", TEX_ROLE_ORDINARY, 0, true, "|"},
      {"lvert", TEX_ROLE_OPEN, 0, true, "|"},
      {"rvert", TEX_ROLE_CLOSE, 0, true, "|"},
      {"top", TEX_ROLE_ORDINARY, 0, true, "\xe2\x8a\xa4"},
      {"prime", TEX_ROLE_ORDINARY, 0, true, "\xe2\x80\xb2"},
      {"lbrace", TEX_ROLE_OPEN, 0, true, "{"},
      {"rbrace", TEX_ROLE_CLOSE, 0, true, "}"},
      {"quad", TEX_ROLE_SPACE, 0, false, "1em"},
      {"qquad", TEX_ROLE_SPACE, 0, false, "2em"},
      {"cdot", TEX_ROLE_BINARY, 0, false, "\xe2\x8b\x85"},
      {"times", TEX_ROLE_BINARY, 0, false, "\xc3\x97"},
      {"equiv", TEX_ROLE_BINARY, 0, false, "\xe2\x89\xa1"},
      {"neq", TEX_ROLE_BINARY, 0, false, "\xe2\x89\xa0"},
      {"ne", TEX_ROLE_BINARY, 0, false, "\xe2\x89\xa0"},
      {"le", TEX_ROLE_BINARY, 0, false, "\xe2\x89\xa4"},
      {"leq", TEX_ROLE_BINARY, 0, false, "\xe2\x89\xa4"},
      {"leqslant", TEX_ROLE_BINARY, 0, false, "\xe2\xa9\xbd"},
      {"ge", TEX_ROLE_BINARY, 0, false, "\xe2\x89\xa5"},
      {"geq", TEX_ROLE_BINARY, 0, false, "\xe2\x89\xa5"},
      {"geqslant", TEX_ROLE_BINARY, 0, false, "\xe2\xa9\xbe"},
      {"approx", TEX_ROLE_BINARY, 0, false, "\xe2\x89\x88"},
      {"lt", TEX_ROLE_BINARY, 0, false, "<"},
      {"gt", TEX_ROLE_BINARY, 0, false, ">"},
      {"in", TEX_ROLE_BINARY, 0, false, "\xe2\x88\x88"},
      {"to", TEX_ROLE_BINARY, 0, false, "\xe2\x86\x92"},
      {"rightarrow", TEX_ROLE_BINARY, 0, false, "\xe2\x86\x92"},
      {"Rightarrow", TEX_ROLE_BINARY, 0, false, "\xe2\x87\x92"},
      {"pm", TEX_ROLE_BINARY, 0, false, "\xc2\xb1"},
      {"mp", TEX_ROLE_BINARY, 0, false, "\xe2\x88\x93"},
      {"sin", TEX_ROLE_FUNCTION, 0, false, "sin"},
      {"cos", TEX_ROLE_FUNCTION, 0, false, "cos"},
      {"tan", TEX_ROLE_FUNCTION, 0, false, "tan"},
      {"cot", TEX_ROLE_FUNCTION, 0, false, "cot"},
      {"exp", TEX_ROLE_FUNCTION, 0, false, "exp"},
      {"ln", TEX_ROLE_FUNCTION, 0, false, "ln"},
      {"det", TEX_ROLE_FUNCTION, 0, false, "det"},
      {"dots", TEX_ROLE_ORDINARY, 0, false, "\xe2\x80\xa6"},
      {"ldots", TEX_ROLE_ORDINARY, 0, false, "\xe2\x80\xa6"},
      {"cdots", TEX_ROLE_ORDINARY, 0, false, "\xe2\x8b\xaf"},
      {"sqrt", TEX_ROLE_ROOT, 1, false, ""},
      {"text", TEX_ROLE_TEXT, 1, false, ""},
      {"operatorname", TEX_ROLE_FUNCTION, 1, false, ""},
      {"mathrm", TEX_ROLE_FONT, 1, false, ""},
      {"mathsf", TEX_ROLE_FONT, 1, false, ""},
      {"mathcal", TEX_ROLE_FONT, 1, false, ""},
      {"mathbf", TEX_ROLE_FONT, 1, false, ""},
      {"tilde", TEX_ROLE_ACCENT, 1, false, "\xcb\x9c"},
      {"bar", TEX_ROLE_ACCENT, 1, false, "\xc2\xaf"},
      {"hat", TEX_ROLE_ACCENT, 1, false, "^"},
      {"dot", TEX_ROLE_ACCENT, 1, false, "\xcb\x99"},
      {"ddot", TEX_ROLE_ACCENT, 1, false, "\xc2\xa8"},
      {"frac", TEX_ROLE_FRACTION, 2, false, ""},
      {"tfrac", TEX_ROLE_FRACTION, 2, false, ""},
      {"dfrac", TEX_ROLE_FRACTION, 2, false, ""},
  };
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (word_is(name, len, words[i].name)) return &words[i];
  return NULL;
}

const char *tex_letter_name(const struct tex_word *w) {
  return strcmp(w->name, "varepsilon") == 0 ? "eps" : strcmp(w->name, "varphi") == 0 ? "phi" : w->name;
}

const struct tex_environment *tex_environment(const char *name, size_t len) {
  static const struct tex_environment kinds[] = {{"pmatrix", "(", ")", 10},
                                                 {"bmatrix", "[", "]", 10},
                                                 {"matrix", "", "", 10},
                                                 {"aligned", "", "", 10},
                                                 {"cases", "{", "", 2}};
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
    if (word_is(name, len, kinds[i].name)) return &kinds[i];
  return NULL;
}

/* --- Tokens --- */

static enum tex_kind kind_of_character(char c) {
  static const struct {
    char c;
    enum tex_kind kind;
  } special[] = {{' ', TEX_BLANK},   {'{', TEX_OPEN},    {'}', TEX_CLOSE},   {'^', TEX_RAISED},
                 {'_', TEX_LOWERED}, {'\'', TEX_PRIME},  {'&', TEX_CELL},    {'%', TEX_STRANGE},
                 {'#', TEX_STRANGE}, {'~', TEX_STRANGE}, {'$', TEX_STRANGE}, {'`', TEX_STRANGE}};
  for (size_t i = 0; i < sizeof special / sizeof *special; i++)
    if (special[i].c == c) return special[i].kind;
  if (char_is_letter(c)) return TEX_LETTER;
  if (char_is_digit(c)) return TEX_DIGIT;
  return c > ' ' && c < 127 ? TEX_SIGN : TEX_STRANGE;
}

/* A command whose name is one sign. */
static enum tex_kind kind_of_control(char c) {
  if (c == '\\') return TEX_ROW;
  if (c == '{' || c == '}') return TEX_BRACE;
  return c && strchr(",:;! ", c) ? TEX_GAP : TEX_STRANGE;
}

static enum tex_kind kind_of_name(const char *name, size_t len) {
  static const struct {
    const char *name;
    enum tex_kind kind;
  } pairs[] = {{"left", TEX_LEFT}, {"right", TEX_RIGHT}, {"begin", TEX_BEGIN}, {"end", TEX_FINISH}};
  for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
    if (word_is(name, len, pairs[i].name)) return pairs[i].kind;
  return TEX_STRANGE;
}

struct tex_token tex_read(const char *s, const char *end) {
  struct tex_token t = {.kind = TEX_END, .s = s};
  if (s == end) return t;
  t.len = 1;
  if (*s != '\\') {
    t.kind = kind_of_character(*s);
    return t;
  }
  while (s + t.len < end && char_is_letter(s[t.len])) t.len++;
  if (t.len > 1) {
    t.word = tex_word(s + 1, t.len - 1);
    t.kind = t.word ? TEX_WORD : kind_of_name(s + 1, t.len - 1);
  } else if (s + 1 < end) {
    t.len = 2;
    t.kind = kind_of_control(s[1]);
  } else {
    t.kind = TEX_STRANGE; /* a backslash that ends the formula */
  }
  return t;
}

size_t tex_number_length(const char *s, const char *end) {
  size_t n = 1;
  while (s + n < end && (char_is_digit(s[n]) || (s[n] == '.' && s + n + 1 < end && char_is_digit(s[n + 1])))) n++;
  return n;
}

const char *tex_braced(size_t *len, const char *s, const char *end) {
  const char *close = s < end && *s == '{' ? memchr(s, '}', (size_t)(end - s)) : NULL;
  if (!close) return NULL;
  *len = (size_t)(close - s) - 1;
  return s + 1;
}
