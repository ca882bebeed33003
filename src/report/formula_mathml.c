/* TeX to MathML.  What the checker of formulas accepts is set by descent along the braces; nothing else is tried, so that
   each function may rely on groups that close and arguments that are there.  Presentation MathML as browsers draw it
   (MathML Core): italics are theirs, the form of a sign is said where its place in the row would mislead. */
#include <string.h>

#include "page.h"

#define LETTERS "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
#define DIGITS  "0123456789"

/* What stands before the next sign: a minus after an operator is that of a number. */
enum before { BEFORE_NOTHING, BEFORE_OPERATOR, BEFORE_ATOM };

struct setter {
  struct text *out;
  const char *s, *end;
  const char *whole; /* where the marks count from */
  const bool *changed;
  bool continued; /* the formula was broken before its first sign */
  enum before before;
};

static void set_row(struct setter *m);

static bool starts(const struct setter *m, const char *word) {
  size_t n = strlen(word);
  return (size_t)(m->end - m->s) >= n && memcmp(m->s, word, n) == 0;
}

static void skip_blanks(struct setter *m) {
  while (m->s < m->end && *m->s == ' ') m->s++;
}

/* Puts what has been written since `at` between two tags. */
static void wrap(struct text *out, size_t at, const char *open, const char *close) {
  size_t n = strlen(open), tail = out->len - at;
  text_add(out, open);
  memmove(out->data + at + n, out->data + at, tail);
  memcpy(out->data + at, open, n);
  text_add(out, close);
}

/* --- Atoms --- */

static void set_sign(struct setter *m, const char *attributes, const char *s, size_t len, enum before after) {
  text_printf(m->out, "<mo%s>", attributes);
  html_plain_n(m->out, s, len);
  text_add(m->out, "</mo>");
  m->before = after;
}

static void set_binary(struct setter *m, const char *s, size_t len) {
  const char *form = m->continued ? " form=\"infix\"" : m->before == BEFORE_ATOM ? "" : " form=\"prefix\"";
  set_sign(m, form, s, len, BEFORE_OPERATOR);
}

static void set_character(struct setter *m) {
  const char *c = m->s++;
  if (*c == '-')
    set_binary(m, "\xe2\x88\x92", 3);
  else if (*c == '+')
    set_binary(m, c, 1);
  else if (strchr("=<>:", *c))
    set_sign(m, "", c, 1, BEFORE_OPERATOR);
  else if (strchr("([", *c))
    set_sign(m, " stretchy=\"false\"", c, 1, BEFORE_NOTHING);
  else if (strchr(")]", *c))
    set_sign(m, " stretchy=\"false\"", c, 1, BEFORE_ATOM);
  else if (*c == '|')
    set_sign(m, " stretchy=\"false\" lspace=\"0\" rspace=\"0\"", c, 1, BEFORE_ATOM);
  else
    set_sign(m, "", c, 1, strchr(",;", *c) ? BEFORE_OPERATOR : BEFORE_ATOM);
}

static void set_number(struct setter *m) {
  const char *from = m->s;
  while (m->s < m->end && (strchr(DIGITS, *m->s) || (*m->s == '.' && m->s + 1 < m->end && strchr(DIGITS, m->s[1]))))
    m->s++;
  text_printf(m->out, "<mn>%.*s</mn>", (int)(m->s - from), from);
  m->before = BEFORE_ATOM;
}

static void set_letter(struct setter *m) {
  text_printf(m->out, "<mi>%c</mi>", *m->s++);
  m->before = BEFORE_ATOM;
}

/* {...} as one element. */
static void set_group(struct setter *m) {
  skip_blanks(m);
  m->s++;
  set_row(m);
  m->s++;
  m->before = BEFORE_ATOM;
}

/* --- Commands --- */

/* The next group when it holds letters alone, which is then passed; NULL otherwise. */
static const char *letters_group(struct setter *m, size_t *len) {
  skip_blanks(m);
  const char *from = m->s + 1;
  *len = 0;
  while (from + *len < m->end && strchr(LETTERS DIGITS, from[*len])) ++*len;
  if (*len == 0 || from + *len >= m->end || from[*len] != '}') return NULL;
  m->s = from + *len + 1;
  return from;
}

/* Script and bold capitals have characters of their own; of the script ones some stand elsewhere in Unicode. */
static void set_alphabet(struct setter *m, char c, bool script) {
  static const struct {
    char c;
    unsigned point;
  } elsewhere[] = {{'B', 0x212C}, {'E', 0x2130}, {'F', 0x2131}, {'H', 0x210B},
                   {'I', 0x2110}, {'L', 0x2112}, {'M', 0x2133}, {'R', 0x211B}};
  unsigned point = (script ? 0x1D49CU : 0x1D400U) + (unsigned)(c - 'A');
  for (size_t i = 0; script && i < sizeof elsewhere / sizeof *elsewhere; i++)
    if (elsewhere[i].c == c) point = elsewhere[i].point;
  text_printf(m->out, "<mi>&#x%X;</mi>", point);
}

static void set_font(struct setter *m, const char *name) {
  size_t len;
  const char *s = letters_group(m, &len);
  bool script = strcmp(name, "mathcal") == 0, bold = strcmp(name, "mathbf") == 0;
  if (!s)
    set_group(m);
  else if ((script || bold) && len == 1 && *s >= 'A' && *s <= 'Z')
    set_alphabet(m, *s, script);
  else
    text_printf(m->out, len == 1 ? "<mi mathvariant=\"normal\">%.*s</mi>" : "<mi>%.*s</mi>", (int)len, s);
  m->before = BEFORE_ATOM;
}

static void set_words(struct setter *m) {
  int depth = 0;
  skip_blanks(m);
  text_add(m->out, "<mtext>");
  do {
    char c = *m->s++;
    depth += (c == '{') - (c == '}');
    if (c == '\\' && m->s < m->end) c = strchr(",;:! ", *m->s) ? ' ' : *m->s, m->s++;
    if (c == ' ')
      text_add(m->out, "&#xA0;");
    else if (c != '{' && c != '}')
      html_plain_n(m->out, &c, 1);
  } while (depth > 0);
  text_add(m->out, "</mtext>");
  m->before = BEFORE_ATOM;
}

static void set_accent(struct setter *m, const struct math_word *w) {
  text_add(m->out, "<mover accent=\"true\">");
  set_group(m);
  text_printf(m->out, "<mo stretchy=\"false\">%s</mo></mover>", w->text);
}

static void set_operator_name(struct setter *m, const struct math_word *w) {
  size_t len = strlen(w->text);
  const char *s = w->args ? letters_group(m, &len) : w->text;
  if (s)
    text_printf(m->out, "<mi>%.*s</mi>", (int)len, s);
  else
    set_group(m);
  m->before = BEFORE_ATOM;
}

static void set_word(struct setter *m, const struct math_word *w) {
  size_t at = m->out->len;
  switch (w->role) {
  case MATH_LETTER:
    text_printf(m->out, "<mi>%s</mi>", w->text);
    m->before = BEFORE_ATOM;
    return;
  case MATH_UPRIGHT:
    text_printf(m->out, "<mi mathvariant=\"normal\">%s</mi>", w->text);
    m->before = BEFORE_ATOM;
    return;
  case MATH_ORDINARY:
    set_sign(m, " stretchy=\"false\" lspace=\"0\" rspace=\"0\"", w->text, strlen(w->text), BEFORE_ATOM);
    return;
  case MATH_OPEN:
  case MATH_CLOSE:
    set_sign(m, " stretchy=\"false\"", w->text, 1, w->role == MATH_OPEN ? BEFORE_NOTHING : BEFORE_ATOM);
    return;
  case MATH_BINARY:
    set_binary(m, w->text, strlen(w->text));
    return;
  case MATH_SPACE:
    text_printf(m->out, "<mspace width=\"%s\"></mspace>", w->text);
    return;
  case MATH_FUNCTION:
    set_operator_name(m, w);
    return;
  case MATH_ACCENT:
    set_accent(m, w);
    return;
  case MATH_FONT:
    set_font(m, w->name);
    return;
  case MATH_TEXT:
    set_words(m);
    return;
  case MATH_ROOT:
    set_group(m);
    wrap(m->out, at, "<msqrt>", "</msqrt>");
    return;
  case MATH_FRACTION:
    set_group(m);
    set_group(m);
    wrap(m->out, at, "<mfrac>", "</mfrac>");
    return;
  }
}

/* One delimiter; '.' is none.  One that stretches is set wider, so that it does only where it has to. */
static void add_delimiter(struct text *out, char c, bool opens, bool stretches) {
  if (c == '.') return;
  text_printf(out, "<mo fence=\"true\" stretchy=\"%s\" form=\"%s\"%s>%c</mo>", stretches ? "true" : "false",
              opens ? "prefix" : "postfix", c == '|' ? " lspace=\"0\" rspace=\"0\"" : "", c);
}

/* \left( ... \right) as one element. */
static void set_fenced(struct setter *m) {
  struct text *out = m->out, inside;
  text_init(&inside);
  m->s += strlen("\\left");
  char open = *m->s++;
  m->out = &inside;
  set_row(m);
  m->out = out;
  m->s += strlen("\\right");
  char close = *m->s++;
  bool high = strstr(inside.data, "<mfrac>") || strstr(inside.data, "<mtable") || strstr(inside.data, "<msqrt>");
  text_add(out, "<mrow>");
  add_delimiter(out, open, true, high);
  text_add(out, inside.data);
  add_delimiter(out, close, false, high);
  text_add(out, "</mrow>");
  text_clear(&inside);
  m->before = BEFORE_ATOM;
}

static void pass_group(struct setter *m) {
  m->s = (const char *)memchr(m->s, '}', (size_t)(m->end - m->s)) + 1;
}

/* After a new line: whether the environment ends there all the same. */
static bool ends_here(struct setter *m) {
  skip_blanks(m);
  return starts(m, "\\end");
}

static void set_cells(struct setter *m) {
  text_add(m->out, "<mtr><mtd>");
  set_row(m);
  while (!starts(m, "\\end")) {
    bool cell = *m->s == '&';
    m->s += cell ? 1 : 2;
    if (!cell && ends_here(m)) break;
    text_add(m->out, cell ? "</mtd><mtd>" : "</mtd></mtr><mtr><mtd>");
    set_row(m);
  }
  text_add(m->out, "</mtd></mtr>");
}

static void set_environment(struct setter *m) {
  static const struct {
    const char *name, *open, *close;
  } kinds[] = {
      {"pmatrix", "(", ")"}, {"bmatrix", "[", "]"}, {"matrix", "", ""}, {"aligned", "", ""}, {"cases", "{", ""}};
  const char *name = m->s + strlen("\\begin{");
  size_t k = 0;
  while (strncmp(kinds[k].name, name, strlen(kinds[k].name)) != 0) k++;
  pass_group(m);
  text_add(m->out, "<mrow>");
  if (*kinds[k].open) text_printf(m->out, "<mo fence=\"true\" form=\"prefix\">%s</mo>", kinds[k].open);
  text_printf(m->out, "<mtable class=\"%s\">", kinds[k].name);
  set_cells(m);
  text_add(m->out, "</mtable>");
  if (*kinds[k].close) text_printf(m->out, "<mo fence=\"true\" form=\"postfix\">%s</mo>", kinds[k].close);
  text_add(m->out, "</mrow>");
  pass_group(m);
  m->before = BEFORE_ATOM;
}

/* \, and its like, \{ and \}. */
static void set_control_sign(struct setter *m) {
  static const char kinds[] = ",:;! ";
  static const char *const width[] = {"0.1667em", "0.2222em", "0.2778em", "-0.1667em", "0.25em"};
  const char *c = m->s + 1, *kind = strchr(kinds, *c);
  m->s += 2;
  if (kind)
    text_printf(m->out, "<mspace width=\"%s\"></mspace>", width[kind - kinds]);
  else
    set_sign(m, " stretchy=\"false\"", c, 1, *c == '{' ? BEFORE_NOTHING : BEFORE_ATOM);
}

/* Whether the name of a function was set, after which comes its argument. */
static bool set_command(struct setter *m) {
  size_t len = strspn(m->s + 1, LETTERS);
  if (starts(m, "\\begin{")) {
    set_environment(m);
  } else if (math_is(m->s + 1, len, "left")) {
    set_fenced(m);
  } else if (len == 0) {
    set_control_sign(m);
  } else {
    const struct math_word *w = math_word(m->s + 1, len);
    m->s += 1 + len;
    set_word(m, w);
    return w->role == MATH_FUNCTION;
  }
  return false;
}

/* --- Rows and scripts --- */

static bool set_atom(struct setter *m) {
  if (*m->s == '\\') return set_command(m);
  if (*m->s == '{')
    set_group(m);
  else if (strchr(DIGITS, *m->s))
    set_number(m);
  else if (strchr(LETTERS, *m->s))
    set_letter(m);
  else
    set_character(m);
  return false;
}

/* A group, or one character or command. */
static void set_script(struct setter *m, struct text *into) {
  struct text *out = m->out;
  const char *end = m->end;
  m->out = into;
  skip_blanks(m);
  if (strchr(DIGITS, *m->s)) m->end = m->s + 1;
  m->before = BEFORE_NOTHING;
  set_atom(m);
  m->end = end;
  m->out = out;
}

static int count_primes(struct setter *m) {
  int n = 0;
  for (; m->s < m->end && *m->s == '\''; m->s++) n++;
  return n;
}

/* Scripts and primes that follow, in any order; the number of primes. */
static int read_scripts(struct setter *m, struct text *sub, struct text *sup) {
  int primes = 0;
  for (;;) {
    const char *blank = m->s;
    skip_blanks(m);
    if (m->s < m->end && *m->s == '\'') {
      primes += count_primes(m);
    } else if (m->s < m->end && (*m->s == '_' || *m->s == '^')) {
      struct text *into = *m->s++ == '_' ? sub : sup;
      set_script(m, into);
    } else {
      m->s = blank;
      return primes;
    }
  }
}

/* The sign itself is raised; as a superscript it would be so twice. */
static void add_primes(struct setter *m, size_t at, int n) {
  text_add(m->out, "<mo lspace=\"0\" rspace=\"0\">");
  for (int i = 0; i < n; i++) text_add(m->out, "\xe2\x80\xb2");
  text_add(m->out, "</mo>");
  wrap(m->out, at, "<mrow>", "</mrow>");
}

static void add_script(struct setter *m, size_t at, const struct text *script, const char *open, const char *close) {
  text_add(m->out, text_str(script));
  wrap(m->out, at, open, close);
}

/* Primes and scripts after the element written since `at`. */
static void set_scripts(struct setter *m, size_t at) {
  struct text sub, sup;
  text_init(&sub);
  text_init(&sup);
  int primes = read_scripts(m, &sub, &sup);
  bool both = sub.len && sup.len && !primes;
  if (both) {
    text_add(m->out, text_str(&sub));
    add_script(m, at, &sup, "<msubsup>", "</msubsup>");
  } else {
    if (sub.len) add_script(m, at, &sub, "<msub>", "</msub>");
    if (primes) add_primes(m, at, primes);
    if (sup.len) add_script(m, at, &sup, "<msup>", "</msup>");
  }
  if (sub.len || sup.len || primes) m->before = BEFORE_ATOM;
  text_clear(&sup);
  text_clear(&sub);
}

/* The sign of application, and a thin space before an argument without parentheses. */
static void set_application(struct setter *m) {
  text_add(m->out, "<mo>&#x2061;</mo>");
  skip_blanks(m);
  if (m->s < m->end && *m->s != '(' && !starts(m, "\\left")) text_add(m->out, "<mspace width=\"0.1667em\"></mspace>");
  m->before = BEFORE_NOTHING;
}

static bool row_ends(const struct setter *m) {
  if (m->s >= m->end || *m->s == '}' || *m->s == '&') return true;
  return starts(m, "\\\\") || starts(m, "\\end{") || (starts(m, "\\right") && !strchr(LETTERS, m->s[6]));
}

/* A thin space between a factor and the name of a function. */
static void set_apart(struct setter *m) {
  size_t len = *m->s == '\\' ? strspn(m->s + 1, LETTERS) : 0;
  const struct math_word *w = len ? math_word(m->s + 1, len) : NULL;
  if (w && w->role == MATH_FUNCTION && m->before == BEFORE_ATOM)
    text_add(m->out, "<mspace width=\"0.1667em\"></mspace>");
}

/* The number of elements. */
static int set_item(struct setter *m) {
  set_apart(m);
  size_t at = m->out->len, from = (size_t)(m->s - m->whole);
  bool function = false;
  if (strchr("^_'", *m->s))
    text_add(m->out, "<mrow></mrow>");
  else
    function = set_atom(m);
  set_scripts(m, at);
  m->continued = false;
  if (m->changed && m->changed[from]) wrap(m->out, at, "<mrow class=\"chg\">", "</mrow>");
  if (function) set_application(m);
  return function ? 2 : 1;
}

/* Up to the end of the group, cell or fence; one element. */
static void set_row(struct setter *m) {
  size_t at = m->out->len;
  int n = 0;
  m->before = BEFORE_NOTHING;
  for (skip_blanks(m); !row_ends(m); skip_blanks(m)) n += set_item(m);
  if (n != 1) wrap(m->out, at, "<mrow>", "</mrow>");
}

/* --- Pieces: a browser does not break a formula, so that it is set in pieces where TeX would break it --- */

/* What is open: groups, which must close within a piece, and parentheses, which should. */
struct depth {
  int groups, parentheses;
};

/* Passes one sign or command of TeX; its length. */
static size_t pass(struct depth *d, const char *s, const char *end) {
  size_t n = *s == '\\' && s + 1 < end ? strspn(s + 1, LETTERS) : 0, len = *s != '\\' ? 1 : n ? n + 1 : 2;
  const char *word = s + 1;
  bool left = math_is(word, n, "left"), right = math_is(word, n, "right");
  if (*s == '{' || left || math_is(word, n, "begin")) d->groups++;
  if (*s == '}' || right || math_is(word, n, "end")) d->groups--;
  if (strchr("([", *s) || math_is(word, n, "lbrace") || (len == 2 && n == 0 && *word == '{')) d->parentheses++;
  if (strchr(")]", *s) || math_is(word, n, "rbrace") || (len == 2 && n == 0 && *word == '}')) d->parentheses--;
  return len + (left || right); /* with the fence */
}

/* Whether TeX would break a line before the sign or command: an operator or a relation. */
static bool is_break(const char *s, size_t len) {
  const struct math_word *w = *s == '\\' ? math_word(s + 1, len - 1) : NULL;
  return w ? w->role == MATH_BINARY : strchr("=<>+-", *s) != NULL;
}

/* The end of the piece that begins at s: behind a comma, before a wide space, and, when it has become long, before an
   operator that follows something. */
static const char *piece_end(const char *s, const char *end) {
  enum { LONG_PIECE = 24 };
  struct depth d = {0, 0};
  int signs = 0;
  bool follows = false;
  for (const char *p = s; p < end;) {
    size_t len = pass(&d, p, end);
    bool script = p > s && (p[-1] == '_' || p[-1] == '^');
    if (d.groups == 0 && d.parentheses == 0 && p > s && !script) {
      if (*p == ',') return p + 1;
      if (*p == '\\' && (math_is(p + 1, len - 1, "quad") || math_is(p + 1, len - 1, "qquad"))) return p;
      if (signs >= LONG_PIECE && follows && is_break(p, len)) return p;
    }
    if (!strchr(" {}_^", *p)) {
      signs++;
      follows = !is_break(p, len) && !strchr("([", *p);
    }
    p += len;
  }
  return end;
}

static void set_piece(struct setter *m, const char *s, const char *end) {
  m->s = s;
  m->end = end;
  size_t command = *s == '\\' ? 1 + strspn(s + 1, LETTERS) : 1;
  m->continued = s > m->whole && is_break(s, command);
  text_add(m->out, "<math displaystyle=\"true\"><semantics>");
  set_row(m);
  text_add(m->out, "<annotation encoding=\"application/x-tex\">");
  html_plain_n(m->out, s, (size_t)(end - s));
  text_add(m->out, "</annotation></semantics></math>");
}

bool mathml_add(struct text *out, const char *tex, size_t len, const bool *changed) {
  if (!math_is_sane(tex, len)) return false;
  struct setter m = {.out = out, .whole = tex, .changed = changed};
  const char *end = tex + len;
  for (const char *s = tex; s < end;) {
    while (s > tex && s < end && *s == ' ') s++;
    if (s == end) break;
    const char *stop = piece_end(s, end);
    if (s > tex) text_add_char(out, ' ');
    set_piece(&m, s, stop);
    s = stop;
  }
  return true;
}
