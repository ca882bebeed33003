/* stickslip orbit --method paper: equations (44)-(46) by Newton's iteration in double precision and in MPFR, as a table
   or as JSON (schema/orbit-paper.schema.json). */
#include <math.h>

#include "base/json.h"
#include "cli.h"
#include "value/paper_orbits.h"

enum { GUARD_BITS = 192 };

static const char *const name[N_ROUTE] = {"t_a", "t_b", "t_c", "t_d", "z10", "z20"};

static void print_number(struct text *out, const struct paper_orbit *p, int i, slong digits) {
  NUMBERS(arb, x);
  num_mpfr.get_arb(x, num_vec_at(&p->route.x, i));
  num_print(out, x, digits);
}

/* --- JSON --- */

static void write_orbit(struct json *j, const char *key, slong orbit) {
  if (json_or_null(j, key, orbit >= 0)) json_printf(j, key, "orbit:%ld", (long)orbit + 1);
}

static void write_steps(struct json *j, const struct paper_orbit *p) {
  JSON_OBJECT(j, "steps");
  if (json_or_null(j, "double", p->route.status_d == SS_OK)) json_long(j, "double", p->route.steps_d);
  if (json_or_null(j, "mpfr", p->status == SS_OK)) json_long(j, "mpfr", p->route.steps);
}

static void write_condition(struct json *j, const struct paper_orbit *p) {
  const struct paper_condition *k = &p->route.condition;
  if (json_or_null(j, "condition", p->status == SS_OK)) {
    JSON_OBJECT(j, "condition");
    json_double(j, "equations", "%.3g", k->jacobian);
    json_double(j, "N1 - I", "%.3g", k->n1);
    json_double(j, "N3", "%.3g", k->n3);
  }
  bool both = p->status == SS_OK && p->route.status_d == SS_OK;
  json_double(j, "digits_lost", "%.1f", both ? p->route.digits_lost : (double)NAN);
}

static void write_solution(struct json *j, const struct paper_orbit *p, slong digits) {
  bool found = p->status == SS_OK;
  JSON_OBJECT(j, NULL);
  if (p->from < 0)
    json_string(j, "from", "printed");
  else
    write_orbit(j, "from", p->from);
  JSON_EACH (j, "start", i, ROUTE_Z) json_double(j, NULL, "%.17g", p->guess[i]);
  json_bool(j, "converged", found);
  for (int i = 0; i < N_ROUTE; i++)
    if (json_or_null(j, name[i], found)) JSON_STRING(j, name[i], print_number(j->out, p, i, digits));
  write_steps(j, p);
  write_orbit(j, "nearest", p->nearest);
  if (json_or_null(j, "distance", p->nearest >= 0)) JSON_STRING(j, "distance", num_print(j->out, p->distance, 2));
  write_condition(j, p);
}

static void write_json(struct text *out, const struct paper_orbits *list, const struct scene *s, slong digits) {
  OWNED(json) j = json_document(out, NULL);
  json_string(&j, "scene", s->name);
  json_string(&j, "method", "paper");
  JSON_EACH (&j, "solutions", i, list->n) write_solution(&j, &list->item[i], digits);
}

/* --- The table --- */

static void add_solution(struct text *out, const struct paper_orbit *p, slong digits) {
  const struct paper_route *r = &p->route;
  if (p->from < 0)
    text_add(out, "from the printed times");
  else
    text_printf(out, "from the times of orbit %ld moved by %d %%", (long)p->from + 1, PAPER_START_MOVED);
  text_printf(out, " (%.6g, %.6g, %.6g, %.6g)\n", p->guess[0], p->guess[1], p->guess[2], p->guess[3]);
  if (p->status != SS_OK) {
    text_add(out, "  the iteration does not converge\n");
    return;
  }
  for (int i = 0; i < N_ROUTE; i++) {
    text_printf(out, "  %-9s ", name[i]);
    print_number(out, p, i, digits);
    text_add_char(out, '\n');
  }
  if (r->status_d == SS_OK)
    text_printf(out, "  steps     %d in double, %d in MPFR at %ld bits\n", r->steps_d, r->steps, (long)r->x.ctx.prec);
  else
    text_printf(out, "  steps     no convergence in double, %d in MPFR at %ld bits\n", r->steps, (long)r->x.ctx.prec);
  if (p->nearest >= 0) {
    text_printf(out, "  nearest   the model's orbit %ld, within ", (long)p->nearest + 1);
    num_print(out, p->distance, 2);
    text_add_char(out, '\n');
  } else {
    text_add(out, "  nearest   the model has no orbit here\n");
  }
  text_printf(out, "  condition %.3g of the four equations' Jacobian, %.3g of N_1 - I, %.3g of N_3\n",
              r->condition.jacobian, r->condition.n1, r->condition.n3);
  if (r->status_d == SS_OK) text_printf(out, "  digits    %.1f of 16 lost in double\n", r->digits_lost);
}

int run_orbit_paper(const struct options *o, const char *data, struct diag *d) {
  slong digits;
  int status = parse_digits(&digits, o, MAX_PAPER_DIGITS);
  if (status) return status;
  OWNED(scene) s;
  OWNED(paper_orbits) list = {.n = 0};
  struct text out = {0};
  slong prec = num_bits(digits) + GUARD_BITS;
  if (load_scene(&s, o->operands.word[0], data, o, SCENE_EXACT, d) && audit_paper_orbits(&list, &s, prec, d)) {
    if (option(o, OPT_JSON))
      write_json(&out, &list, &s, digits);
    else
      text_printf(&out, "%s: the paper's equations (44)-(46) by Newton's iteration\n", s.name);
    for (size_t i = 0; i < list.n && !option(o, OPT_JSON); i++) add_solution(&out, &list.item[i], digits);
    print_found(o, &out);
  }
  return status;
}
