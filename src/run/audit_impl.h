/* What the parts of the audit share: points, their values, the model's quantities by the paper's names, comparisons. */
#ifndef STICKSLIP_AUDIT_IMPL_H
#define STICKSLIP_AUDIT_IMPL_H

#include <stdint.h>

#include "stickslip/audit.h"
#include "stickslip/dynamics.h"
#include "stickslip/tape.h"

/* Precision of the first trial in balls, and where raising it stops; bits. */
enum { FIRST_PREC = 128, LAST_PREC = 1024, FD_PREC = 256 };

/* --- Points: exact data at which a sentence is tried --- */

enum point_kind {
  POINT_PARAMS,  /* parameters and a time */
  POINT_FLOW,    /* a motion of one phase from an exact state over an exact time */
  POINT_ARC,     /* one pass through the word from an exact state, with its events */
  POINT_ORBIT,   /* a periodic orbit */
  POINT_PRINTED, /* the printed state carried over the printed times, events or not */
  POINT_GIVEN,   /* a periodic orbit of exact t_b and t_c, with the e1 and e2 that it needs, and exact u_r1 and u_r2 */
  POINT_PATCHED /* any exact state carried by the linear systems of the four phases over any exact times, no events; its
                    perturbations are any numbers, but for the velocities that (25), (30) and (38) leave alone */
};

/* Exact quantities of a point. */
enum {
  Q_CHI,
  Q_ETA,
  Q_V,
  Q_E1,
  Q_E2,
  Q_US1,
  Q_US2,
  Q_X,
  Q_Y,
  Q_LAMBDA,
  Q_T,
  Q_S,  /* arcs: how far into its phase the time t lies, as a fraction */
  Q_Z1, /* start of an arc or a flow: z_1, z_2, z_1', z_2' */
  Q_Z2,
  Q_DZ1,
  Q_DZ2,
  Q_TA, /* POINT_PRINTED, POINT_PATCHED */
  Q_TB,
  Q_TC,
  Q_TD,
  N_Q
};

struct point {
  enum point_kind kind;
  enum phase phase; /* of the time t: POINT_FLOW, and arcs */
  bool admissible;  /* POINT_ORBIT: only orbits that break no condition */
  bool realistic;   /* and u_s1, u_s2 for which each u_ri is 5/4 of what they ask of it, or a little more */
  bool finite;      /* arcs: the perturbation is (x, y)/1024, carried by the motion itself, not by its derivative */
  fmpq q[N_Q];
  slong orbit;                   /* POINT_ORBIT, POINT_GIVEN: index in the list of its parameters */
  const struct dyn_orbit *known; /* POINT_GIVEN: that orbit at hand, or NULL to find it through the cache */
  const struct scene *scene; /* POINT_ORBIT: whose orbits are meant, which need not give e1 and e2; NULL: those of q */
};

void point_init(struct point *p);
void point_clear(struct point *p);
/* "chi = 3/4, eta = 2, ..." with what matters for its kind. */
void point_print(struct text *out, const struct point *p);
/* Applies "chi=1/2,V=2" to the point. */
bool point_set(struct point *p, const char *at, struct diag *d);

/* A condition that narrows the domain, tried when a sentence fails on the whole of it. */
struct restriction {
  const char *text; /* "V = 1" */
  int quantity;
  const char *value;
};
extern const struct restriction restrictions[];
extern const int n_restrictions;

/* Orbits found so far, by what is given and precision. */
struct orbit_cache;
struct orbit_cache *orbit_cache_new(void);
void orbit_cache_free(struct orbit_cache *c);
/* From now on lists hold what the search misses too, as those that `orbit` shows: for who is told a number by it. */
void orbit_cache_complete(struct orbit_cache *c);
/* The orbits at five exact parameters, enclosed at prec bits. */
const struct dyn_orbits *orbit_cache_get(struct orbit_cache *c, const fmpq params[N_PARAMS], slong prec);
/* The orbits among which a POINT_ORBIT is one, enclosed for work at prec bits. */
const struct dyn_orbits *point_orbits(const struct point *p, struct orbit_cache *c, slong prec);

/* The orbits at exact chi, eta, V (of q) with exact t_b and t_c. */
const struct dyn_orbits *orbit_cache_given(struct orbit_cache *c, const fmpq q[N_Q], slong prec);

/* The orbit's arc in the context of arc and params; params are the orbit's own. */
int orbit_arc(struct dyn_arc *arc, struct orbit_cache *c, const struct dyn_orbit *o, const struct num_vec *params);

/* What the return map and motions do beside an orbit, whatever a sentence says of it (judge/criterion.c). */
struct orbit_slope {
  const struct dyn_orbit *orbit;
  bool have_slope, have_iterates, have_motion;
  int status; /* of the slope */
  double slope, margin;
  int iterates, motion; /* fates */
};
/* What is known so far, at first nothing; lives until another is asked for. */
struct orbit_slope *orbit_cache_slope(struct orbit_cache *c, const struct dyn_orbit *o);

/* Reduces an orbit point's number to one of the orbits there are; false when there is none. */
bool point_settle(struct point *p, struct orbit_cache *c);

/* A stream of random bits, seeded from an id. */
uint64_t random_next(uint64_t *state);
uint64_t random_seed(const char *id);

/* A stream of random points of one kind, seeded from an id. */
struct sampler {
  uint64_t state;
  enum point_kind kind;
  enum phase phase;
  bool admissible, realistic, finite;
  const struct restriction *restriction;
};
void sampler_init(struct sampler *s, const char *id, enum point_kind kind, enum phase phase,
                  const struct restriction *restriction);
void sampler_next(struct point *p, struct sampler *s);

/* --- Values of the paper's symbols at a point, in one number type --- */

/* How they are got: closed form and implicit differentiation; states carried by matrix exponentials; tangents by finite
   differences; the return Jacobian by saltation matrices. */
enum variant { VARIANT_CLOSED, VARIANT_EXPONENTIAL, VARIANT_FD, VARIANT_SALTATION };

struct values {
  struct num_ctx ctx;
  const struct point *point;
  enum variant variant;
  struct num_vec q;         /* N_Q */
  struct num_vec params;    /* N_PARAMS */
  struct dyn_arc arc;       /* POINT_ARC, POINT_ORBIT */
  struct dyn_arc perturbed; /* finite perturbations */
  struct num_vec t;         /* the time t; on arcs made when first asked for, as the next two */
  struct num_vec zt, azt;   /* Z(t) and its derivative */
  bool have_t;
  struct num_vec phi; /* the matrix exponentials over the arc's four phases, 16 each; each made when first asked for */
  bool have_phi[N_PHASES];
  struct num_vec local; /* four local Jacobians, 16 each; each made when first asked for */
  bool have_local[N_PHASES];
  struct num_vec tangent; /* dZ_0, dZ_a, dZ_b, dZ_c, dZ_f, 4 each */
  struct num_vec dt;      /* dt_a, dt_b, dt_c, dt_d */
  bool have_tangent;
  struct oracle_matrix *matrices; /* whose entries were asked for */
  size_t n_matrices, cap_matrices;
};

/* Status flags; anything but SS_OK means that the point is not accepted in this type. */
int values_init(struct values *v, const struct point *p, enum variant variant, struct num_ctx ctx,
                struct orbit_cache *cache);
void values_clear(struct values *v);
/* exp(A t) of a phase over its time on the arc. */
int values_propagator(struct num_vec *out, struct values *v, enum phase ph);
/* The value of a free symbol of a tape.  SS_UNABLE with *known = false for a name that has none at such a point. */
int values_bind(void *z, bool *known, struct values *v, const char *name);
/* The blocks behind (1), for motions of one phase: u_1, F_1, k_1, m_1, omega_3, ...; false for other names. */
bool springs_bind(int *status, void *z, struct values *v, const char *name);
int springs_square_of_omega_3(void *z, struct values *v);

/* What the paper's names stand for.  "z_10" ... "z'_2c": 4 times the state (Z_0, Z_a, Z_b, Z_c) plus the component;
   "t_a" ... "t_d": 100 and more; -1 for another name. */
int name_of_arc(const char *name);
/* "x", "x_a" ... "v_f", "u" and "v": 4 times the state plus the component; "dt_a" ... "dt_d": 100 and more. */
bool name_of_tangent(const char *name, int *index);
/* "z_1''(t)", "x_2(t_a + dt_a)": component, number of primes, argument with its parentheses. */
bool name_of_motion(const char *name, bool *in_x, int *component, int *primes, const char **argument);
/* "(t_a)", "(t_a + t_b)", ...: 0 to 3, at the perturbed times 4 to 7; -1 for another argument. */
int name_of_switching_time(const char *argument);

/* --- What the paper keeps of a phase's derivative --- */

enum entering { STAYS_OUT, ENTERS, ENTERS_BY_CHI };
enum { LOCAL_MOST = 3 };
struct local_map {
  const char *name; /* J_a */
  enum phase phase;
  int rows, cols;
  enum entering in[LOCAL_MOST][N_STATE]; /* the perturbation at the start that a column stands for */
  int keep[LOCAL_MOST];                  /* the component at the end that a row stands for */
};
extern const struct local_map local_maps[N_PHASES];
/* The paper's matrix (rows x cols) from the 4x4 derivative. */
int local_map_corner(struct num_vec *out, const struct local_map *m, const struct num_vec *local, const void *chi);
/* The columns' perturbations as directions. */
void local_map_directions(double dir[LOCAL_MOST][N_STATE], const struct local_map *m, double chi);

/* --- Jacobians by one method --- */

struct jacobian_job {
  const struct model *model;
  const struct scene *scene;
  struct point point; /* POINT_ORBIT or POINT_PRINTED */
  struct orbit_cache *cache;
  struct diag *d;
  struct coulomb_setup setup; /* of the simulation; made when first asked for */
  bool setup_done, setup_good;
};
/* Does the method work in double precision, whatever is asked for? */
bool method_is_double(enum jacobian_method method);
/* The 2x2 Jacobian of the period (map NULL) or the paper's matrix of one phase, as balls at prec bits. */
int jacobian_route(arb_ptr out, struct jacobian_job *job, enum jacobian_method method, enum layer layer,
                   const struct local_map *map, slong prec);

/* --- The model's quantities under the paper's names --- */

struct oracle;
/* The oracle of a name such as J_a, H(t), N, K_1; NULL when the model has no such quantity. */
const struct oracle *oracle_find(const char *name);
int oracle_rows(const struct oracle *o);
int oracle_cols(const struct oracle *o);
int oracle_eval(struct num_vec *out, const struct oracle *o, struct values *v);

/* --- Two sides at points --- */

/* A sentence ready to be tried: paper's expressions on one or both sides, the model's quantity perhaps on the other.
   It must be cleared whether or not it could be made. */
struct sentence {
  struct elaboration el;
  struct tape tape;
  slong n; /* entries of a side */
  int cols;
  enum relop *ops;             /* of each entry */
  const struct oracle *oracle; /* the right side, or NULL when it is on the tape */
};

/* value = oracle of the same name, which there is, with names in it replaced by the model's quantities. */
bool sentence_from_value(struct sentence *s, struct view v, const char *value, const char *section,
                         const struct override *overrides, int n_overrides, struct diag *d);
/* The record that an attribute of a claim names, which has a relation to be judged; NULL with d set. */
const struct statement_record *claim_record(struct view v, const struct claim *c, const char *attribute, const char *id,
                                            struct diag *d);
/* The entries of a record (every step of its relations, of which there are some), with names replaced by the model's
   quantities. */
bool sentence_from_relations(struct sentence *s, struct view v, const struct statement_record *r,
                             const struct override *overrides, int n_overrides, struct diag *d);
/* What a matrix or identity claim says: by its statement or its value. */
bool sentence_from_claim(struct sentence *s, struct view v, const struct claim *c, const struct override *overrides,
                         int n_overrides, struct diag *d);
void sentence_clear(struct sentence *s);
/* Both sides (s->n each, in the context of lhs and rhs). */
int sentence_values(struct num_vec *lhs, struct num_vec *rhs, struct sentence *s, const struct point *p,
                    enum variant variant, struct orbit_cache *cache);

enum outcome { OUTCOME_AGREES, OUTCOME_DIFFERS, OUTCOME_UNDECIDED, OUTCOME_REJECTED, OUTCOME_UNBOUND };

struct trial {
  enum outcome outcome;
  int status; /* of a rejected point */
  long bits;
  double log_diff; /* log2 of the largest difference over max(1, scale); -inf for none */
  slong entry;     /* where */
  char lhs[64], rhs[64];
  char unbound[64];
};

/* Both sides in balls, from 128 bits, doubled while undecided up to 1024.  Differs when the balls of an equality are
   disjoint, or those of an inequality are ordered the other way; agrees when every inequality is proved, and the sides of
   every equality overlap and are narrower than 2^(-bits/2) max(1, scale). */
struct trial sentence_try_balls(struct sentence *s, const struct point *p, enum variant variant,
                                struct orbit_cache *cache);
/* Two vectors of balls (as long as each other, in one context) as the sides of equalities, decided in the same way at
   their precision alone. */
struct trial balls_compare(const struct num_vec *lhs, const struct num_vec *rhs);
/* In a rounded type: agrees below tol max(1, scale), differs above sqrt(tol) max(1, scale). */
struct trial sentence_try_rounded(struct sentence *s, const struct point *p, enum variant variant, struct num_ctx ctx,
                                  double log_tol, struct orbit_cache *cache);

/* --- A claim being judged --- */

/* EFFORT_REFUTE: the decisive route alone, up to its first difference; a verdict other than refuted means nothing then,
   but that arguments, scaling, ranks and reach are proved just where the full effort proves them.
   EFFORT_VERDICT: all routes, up to the point from which on the verdict can be nothing but refuted; the evidence means
   nothing then.  EFFORT_DIFFERENCE: all routes, up to the first difference of the decisive one.  Kinds that know them are
   done sooner; others may pass over them. */
enum effort { EFFORT_FULL, EFFORT_REFUTE, EFFORT_VERDICT, EFFORT_DIFFERENCE };

struct judge {
  struct audit_result *out;
  const struct model *model;
  const struct claims *claims;
  struct dependences *dependences; /* of these claims; NULL where no finding is described */
  const struct scene *scene;
  struct orbit_cache *cache;
  struct orbit_pool *pool; /* made when first asked for */
  struct diag *d;
  bool claim_at_fault; /* the diagnostic is about the claim file, not about a formula */
  enum effort effort;
  const bool *touched; /* by record of the model: what may say something else than it did; NULL: everything may */
};

/* Fills verdict, evidence, condition, correction, effect of f.  false with j->d set when the claim cannot be read. */
typedef bool (*kind_fn)(struct finding *f, struct judge *j, const struct claim *c, struct view view);

/* The entries of an expression at a point, enclosed at prec bits; count of them in *n (at most 16 are returned). */
int expression_at(arb_ptr out, int *n, struct view v, const char *expression, const char *section,
                  const struct point *p, slong prec, struct orbit_cache *cache, struct diag *d);

/* The routes by which the claim is tried, the decisive one first; none where its kind has its own. */
enum { MOST_CLAIM_ROUTES = 16, ROUTE_NAME = 32 };
int claim_routes(char name[MOST_CLAIM_ROUTES][ROUTE_NAME], const struct claim *c);
/* Whether the scene asks for this route, or for all of them. */
bool route_is_asked(const struct scene *s, const char *route);
/* Of a claim that was judged: evidence by other routes goes, and with it what rested on it; says so. */
void keep_asked_routes(struct finding *f, struct judge *j, const struct claim *c);

/* The first kind of point that a claim names. */
struct point_spec {
  enum point_kind kind;
  enum phase phase;
  bool admissible, realistic;
  long n;
};
/* Reads the claim's points into at most max specs; the number of them, or -1 with j->d set. */
int claim_points(struct point_spec *spec, int max, struct judge *j, const struct claim *c);

bool judge_points(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_threshold(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_sharp(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_inequality(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_index_range(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_number(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_closure(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_criterion(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_behaviour(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_report(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_argument(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_notation(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_scaling(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_reach(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_rank(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_constraints(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_sequence(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_existence(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_law(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_outside(struct finding *f, struct judge *j, const struct claim *c, struct view view);
bool judge_definition(struct finding *f, struct judge *j, const struct claim *c, struct view view);

/* Is the id that of a claim which a restriction of this one makes? */
bool claim_makes(const struct claim *c, const char *id);
/* Another finding of the same claim under a restriction that was found to hold, or that is on record. */
bool judge_restrictions(struct judge *j, const struct claim *c, struct view view, const struct finding *refuted);

/* The kind of that name; NULL when there is none. */
kind_fn claim_kind(const char *name);

/* When is a claim asked about a damaged formula: at once; after the others, by EFFORT_REFUTE alone; or never, since it simulates
   and reads no formula that others do not read, or asserts nothing? */
enum asked { ASKED_EARLY, ASKED_LATE, ASKED_NEVER };
/* A kind.  tried_at_points: it can be restricted, corrected by an erratum, and refuted with little effort; of_scene: it is about
   the numbers of one scene, and of a box of parameters says nothing; parts: those of work.h that it may need besides what
   its points are, as bits; balls: it works in them. */
struct claim_kind {
  const char *name;
  kind_fn judge;
  bool tried_at_points;
  enum asked asked;
  bool of_scene;
  unsigned parts;
  bool balls;
};
/* NULL: there is none of that name. */
const struct claim_kind *claim_kind_of(const struct claim *c);
bool claim_tried_at_points(const struct claim *c);
enum asked claim_asked(const struct claim *c);

/* Do the options select the claim, by its own id or by one that a restriction of it makes?  And does every item of --only
   select some claim? */
bool claims_selects(const struct audit_options *opt, const struct claim *c);
bool claims_check_selection(const struct claims *claims, const struct audit_options *opt, struct diag *d);

/* How a claim is read: its own text as printed, the rest corrected. */
struct view claim_view(const struct model *m, const struct claim *c);
/* The verdict on record in that scene; N_VERDICTS: none. */
enum verdict claim_recorded(const struct claim *c, const struct scene *s);
/* What stands in the claim's file and in the paper, before anything is judged. */
bool finding_describe(struct finding *f, struct judge *j, const struct claim *c);
/* The claim's own finding, without its correction and restrictions. */
bool judge_verdict(struct finding *f, struct judge *j, const struct claim *c);
/* All findings of a claim, added to the result: its own, with the correction, and those that its restrictions make. */
bool judge_claim(struct judge *j, const struct claim *c);

/* The claim of that id, or NULL. */
const struct claim *claim_named(const struct claims *claims, const char *id);
/* A control beside its claim, whose own verdict may be among the findings of the result: what became of it is added there. */
bool judge_control(struct judge *j, const struct claim *control, const struct claim *claim);

/* --- Evidence and verdicts --- */

struct evidence *finding_add(struct finding *f, struct audit_result *out);
/* Does x op y hold?  UNKNOWN for an equality. */
truth inequality_holds(const struct num_type *type, enum relop op, const void *x, const void *y);

/* What one route says of a claim, as the table reads it. */
enum route_outcome { ROUTE_NOTHING, ROUTE_AGREES, ROUTE_DIFFERS, ROUTE_UNDECIDED };
struct route_result {
  const char *route;
  enum route_outcome outcome;
  bool decisive; /* its difference is a certificate */
  long trials;
};
/* The word as evidence.  bits is -1, where and note are NULL, when they do not apply. */
struct evidence *finding_add_route(struct finding *f, struct audit_result *out, struct route_result w,
                                   const char *layer, long bits, const char *where, const char *note);
/* Evidence that only states something. */
void finding_state(struct finding *f, struct audit_result *out, const char *route, const char *layer, long bits,
                   long trials, const char *where, const char *note);
/* The one table from evidence to verdict. */
enum verdict verdict_of(const struct route_result *w, int n, bool whole_domain);
/* Of a sentence with that verdict, judged again under a condition. */
enum verdict verdict_under_condition(enum verdict whole, enum verdict under);
/* How many of the routes agree and are pairwise independent by the table of routes.h. */
int independent_routes(const struct route_result *w, int n);

/* log2 of an upper bound of |x|; -inf for zero. */
double log2_upper(const arb_t x);
/* "1e-37", the next power of ten above 2^log2x; "0" for -inf. */
const char *order_of_magnitude(struct audit_result *r, double log2x);

/* Is the record of the paper's files what the claim is about: its statement; or, for a value, a definition under the claim's
   equation number, since a formula is printed together with its parts? */
bool claim_is_about(const struct statement_record *r, const struct claim *c);
/* Whether an erratum is about the claim: it replaces its statement or, not by statement, defines something anew under
   the claim's equation number. */
bool erratum_is_about(const struct statement_record *r, const struct claim *c, bool by_statement);
/* The correction of a claim and what it replaces as LaTeX, and where they differ. */
void erratum_typeset(struct finding *f, struct judge *j, const struct claim *c);
/* The correction that errata.eq holds for the sentence of a claim; false when it holds none. */
bool erratum_text(struct text *out, const struct model *m, const struct claim *c);
/* Judges the sentence again with everything corrected and fills f->correction. */
bool judge_correction(struct finding *f, struct judge *j, const struct claim *c, kind_fn kind);

/* The point at the scene's own parameters that is like p in everything else; false when the scene has no orbit. */
bool scene_point(struct point *out, const struct point *p, const struct scene *s, struct orbit_cache *cache);

/* What the scene gives, else prints, under a key's name; NULL when it does neither. */
const fmpq *scene_number(const struct scene *s, enum scene_key key);
/* The printed state and times of the scene as a point, with what the scene gives in place of what it does not print;
   false when some are neither printed nor given. */
bool printed_point(struct point *out, const struct scene *s);
/* The scene's orbit nearest to its printed numbers (the first without any); false when it has none. */
bool nearest_orbit_point(struct point *out, const struct scene *s, struct orbit_cache *cache);

/* The scene's parameters, in the context of params; e1 and e2 that it does not give are those of its orbit nearest to the
   printed numbers.  Status flags. */
int scene_numbers(struct num_vec *params, struct judge *j);

/* The orbits at the scene's parameters. */
const struct dyn_orbits *scene_orbits(const struct scene *s, struct orbit_cache *cache);

/* The two ways in which a decimal may have been printed. */
enum reading { READ_ROUNDED, READ_TRUNCATED, N_READINGS };
extern const char *const reading_name[N_READINGS];
/* Does x print as p?  TRUE under some reading (*how), FALSE under none. */
truth printed_fits(const arb_t x, const struct printed_number *p, enum reading *how);
/* A ball over every value that prints as p. */
void printed_ball(arb_t x, const struct printed_number *p);
/* A control's attribute "shift", in units of the last digit, applied to a printed number: *p then points at own, whose
   values the caller clears. */
bool printed_replace(struct printed_number *own, const struct printed_number **p, const struct claim *c);

/* Why a scene for which scene_has_forces is false has none: also a box, of which an audit keeps no data. */
const char *scene_lacks_forces(const struct scene *s);
/* Marks the claim as skipped, with the reason. */
void finding_skip(struct finding *f, struct judge *j, const char *why);
/* "[2,3]" for an entry of a matrix, counted from 0 by rows; "2" in a column, "" in a scalar. */
const char *entry_place(struct audit_result *out, slong n, int cols, slong entry);
/* x to n digits, or as a ball when it is not known that well. */
const char *ball_text(struct judge *j, const arb_t x, slong n);

/* --- What rests on what (depends.c, consequence.c) --- */

struct dependences;
/* Of all the claims, each with its own text as printed and all else corrected; model and claims must stay.  What a claim
   reaches is found when it is first asked for. */
struct dependences *dependences_new(const struct model *m, const struct claims *claims);
void dependences_free(struct dependences *d);
/* Whether the formulas of claim a reach what claim b is about; indices in the claims. */
bool dependences_on(struct dependences *d, size_t a, size_t b);
/* The definitions that the formulas of claim a reach. */
size_t dependences_n_used(struct dependences *d, size_t a);
const struct definition *dependences_used(struct dependences *d, size_t a, size_t i);
/* Whether they reach a definition that is corrected under this equation number. */
bool dependences_corrected(struct dependences *d, size_t a, const char *equation);
/* Whether the claim names the id by hand. */
bool dependences_named(const struct claim *c, const char *id);
/* Fills depends_on: what is computed and what the claim names by hand, in the order of the claims. */
bool dependences_list(struct finding *f, struct judge *j, const struct claim *c);

/* The claim that a finding is about when its failure has consequences: it fails and has a correction; the number of claims
   when not. */
size_t consequence_claim(const struct judge *j, const struct finding *f);
/* What refuted claims do to what is derived from them: of the n findings of the result at these places, which share what
   they read as printed (claim_own); completes their effects. */
bool judge_consequences(struct judge *j, const size_t *at, size_t n);

bool claim_error(struct judge *j, const struct claim *c, const char *attribute, const char *what);

/* What became of a control; it is noticed when it is refuted. */
void audit_control(struct audit_result *out, const char *id, const char *claim, enum verdict verdict);
/* Other work left out, with the reason. */
void audit_leave_out(struct audit_result *out, const char *what, const char *why);

/* audit_coulomb_setup on an orbit, by its number in the list of audit_orbits as it is, by which claims count. */
bool coulomb_setup_listed(struct coulomb_setup *sim, const struct scene *s, slong orbit, struct diag *d);
/* Coulomb's law beside an orbit, under the friction u_ri = factor max(e_i, u_ri_min).  OWN_FRICTION is the factor that
   audit_coulomb_setup takes where a scene gives no friction. */
#define OWN_FRICTION 1.25
int coulomb_setup_on_orbit(struct coulomb_setup *sim, const fmpq params[N_PARAMS], const struct dyn_orbit *o,
                           double factor);

/* Every pair of routes in the table of routes.h that compute the same quantity, held against each other at fixed random
   points and on orbits, into out->pairs. */
bool study_routes(struct judge *j);
/* Runs over many periods beside the scene's orbit nearest to its printed numbers and beside orbits of other multipliers,
   into out->long_runs. */
void study_long_runs(struct judge *j);
/* The tables that pictures are drawn from, into out->tables; NULL, or why there are none. */
const char *study_tables(struct judge *j);

#endif
