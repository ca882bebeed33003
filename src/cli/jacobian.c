/* stickslip jacobian: the 2x2 Jacobian of one period by the method asked for, with its accuracy and its eigenvalues. */
#include <string.h>

#include "base/json.h"
#include "cli.h"
#include "value/printed.h"

static int parse_jacobian(struct jacobian_request *q, const struct options *o) {
  enum { TABLE_DIGITS = 8 };
  int method = METHOD_ANALYTIC, layer = LAYER_CORRECTED, status = parse_digits(&q->digits, o, MAX_DIGITS);
  if (option(o, OPT_PHASES) && !option(o, OPT_DIGITS) && !option(o, OPT_JSON)) q->digits = TABLE_DIGITS;
  if (!status) status = parse_word(&method, o, OPT_METHOD, method_name, N_METHODS);
  if (!status) status = parse_word(&layer, o, OPT_LAYER, layer_name, N_LAYERS);
  q->method = (enum jacobian_method)method;
  q->layer = (enum layer)layer;
  return status ? status : parse_start(&q->orbit, &q->at_printed, o);
}

/* What is printed about one Jacobian: entries, trace, det. */
enum { TRACE = 4, DET = 5, N_NUMBERS = 6 };

static void jacobian_json(struct text *out, arb_srcptr x, const char *layer, const struct jacobian_request *q) {
  OWNED(json) w = json_document(out, NULL);
  JSON_EACH (&w, "J", i, 2) json_numbers(&w, NULL, x + 2 * i, 2, q->digits);
  json_number(&w, "trace", x + TRACE, q->digits);
  json_number(&w, "det", x + DET, q->digits);
  json_string(&w, "method", method_name[q->method]);
  json_string(&w, "layer", layer);
  json_at(&w, q);
}

static void jacobian_text(struct text *out, arb_srcptr x, const struct scene *s, const char *layer,
                          const struct jacobian_request *q) {
  static const char *const before[N_NUMBERS + 1] = {"  ", "  ", "\n  ", "  ", "\ntrace ", "\ndet   ", "\naccuracy "};
  NUMBERS(arb, worst);
  text_printf(out, "%s, ", s->name);
  print_orbit_at(out, q, s);
  text_printf(out, ", method %s, layer %s\n", method_name[q->method], layer);
  for (int i = 0; i < N_NUMBERS; i++) {
    text_add(out, before[i]);
    print_known(out, x + i, q->digits);
  }
  text_add(out, before[N_NUMBERS]);
  jacobian_accuracy(worst, x, 4);
  print_accuracy(out, worst);
  text_printf(out, " (%s)\n", method_accuracy[q->method]);
  eigenvalues_text(out, "", x, q->digits);
}

/* x: J, trace and det. */
static void print_jacobian(arb_srcptr x, const struct jacobian_request *q, const struct scene *s, bool as_json) {
  struct text out = {0};
  const char *layer = q->method == METHOD_ANALYTIC ? layer_name[q->layer] : "model";
  if (as_json)
    jacobian_json(&out, x, layer, q);
  else
    jacobian_text(&out, x, s, layer, q);
  print_text(&out);
}

/* Whether an entry or the trace would be printed as 0 though all that is known is that it is not large. */
static bool is_lost(arb_srcptr x) {
  const double near = 1e-3;
  for (int i = 0; i <= TRACE; i++)
    if (arb_contains_zero(x + i) && !(mag_get_d(arb_radref(x + i)) < near)) return true;
  return false;
}

static void show_jacobian(const struct options *o, const struct model *m, const struct scene *s,
                          const struct jacobian_request *q, struct diag *d) {
  ARB_VECTOR(x, N_NUMBERS);
  bool ok = audit_jacobian(x, x + TRACE, x + DET, m, s, q, d);
  if (ok && is_lost(x))
    ok = diag_set(d, "%s: error: method %s knows no digit of the Jacobian's entries or of their trace here", s->path,
                  method_name[q->method]);
  if (ok) print_jacobian(x, q, s, option(o, OPT_JSON));
}

int run_jacobian(const struct options *o, const char *data, struct diag *d) {
  struct jacobian_request q;
  int status = parse_jacobian(&q, o);
  if (status) return status;
  LOCAL(model, m);
  OWNED(scene) s;
  bool ok =
      load_scene(&s, o->operands.word[0], data, o, SCENE_OF_ANY_SYSTEM, d) && (s.system || scene_one_point(&s, d));
  bool proved = ok && (s.system || scene_other_word(&s));
  if (ok && q.orbit < 0) q.orbit = proved ? 0 : scene_usual_orbit(&s);
  if (proved)
    status = run_proved_jacobian(o, &s, data, &q, d);
  else if (ok && load_model(&m, data, o, d))
    (option(o, OPT_PHASES) ? show_phases : show_jacobian)(o, &m, &s, &q, d);
  return status;
}
