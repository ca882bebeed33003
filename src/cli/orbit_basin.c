/* orbit --basin: how far r may be from that of a stable orbit, proved, and where that fails. */
#include "explore/basin.h"

#include "cli.h"
#include "explore/family.h"
#include "orbit_numbers.h"

/* An exact decimal with all of its digits. */
static void print_decimal(struct text *out, const fmpq_t q) {
  NUMBERS(fmpz, n);
  NUMBERS(arb, x);
  NUMBERS(fmpq, scaled);
  fmpq_set(scaled, q);
  while (!fmpz_is_one(fmpq_denref(scaled))) {
    fmpz_set_ui(n, 10);
    fmpq_mul_fmpz(scaled, scaled, n);
  }
  slong digits = (slong)fmpz_sizeinbase(fmpq_numref(scaled), 10);
  arb_set_fmpq(x, q, 8 * digits + 64);
  if (num_print(out, x, digits) != SS_OK) num_print_q(out, q);
}

static const char *reason(const struct dyn_basin *b) {
  static const char *const words[] = {[FAILS_UNKNOWN] = "unknown", [FAILS_SLOPE] = "slope", [FAILS_IMAGE] = "image"};
  return b->why == FAILS_CONDITION ? orbit_condition_name(b->condition) : words[b->why];
}

static void find(struct dyn_basin *b, const struct dyn_orbit *o, const struct scene *s) {
  const fmpq *u[2];
  scene_static_friction(u, s);
  dyn_basin_init(b);
  dyn_basin_find(b, s->value, u, o);
}

void basin_json(struct json *j, const struct dyn_orbit *o, const struct scene *s) {
  OWNED(dyn_basin) b;
  find(&b, o, s);
  if (json_or_null(j, "basin", b.proved)) {
    JSON_OBJECT(j, "basin");
    JSON_STRING(j, "r_low", print_decimal(j->out, &b.low));
    JSON_STRING(j, "r_high", print_decimal(j->out, &b.high));
    if (json_or_null(j, "fails_at", b.why != FAILS_UNKNOWN))
      JSON_STRING(j, "fails_at", print_decimal(j->out, &b.fails_at));
    json_string(j, "why", reason(&b));
  }
}

void basin_text(struct text *out, const struct dyn_orbit *o, const struct scene *s) {
  OWNED(dyn_basin) b;
  find(&b, o, s);
  text_add(out, "  basin    ");
  if (!b.proved) {
    text_add(out, "no interval of z_2 - z_1 is proved to go into itself\n");
  } else {
    text_add(out, "z_2 - z_1 in [");
    print_decimal(out, &b.low);
    text_add(out, ", ");
    print_decimal(out, &b.high);
    text_add(out, "] goes into itself, slope below 1");
    if (b.why == FAILS_UNKNOWN) {
      text_add(out, "; no point at most twice as far is proved to fail");
    } else {
      text_add(out, "; fails at ");
      print_decimal(out, &b.fails_at);
      text_printf(out, " (%s)", reason(&b));
    }
    text_add_char(out, '\n');
  }
}
