/* The words of the reports. */
#include "glossary.h"

static const struct glossary_entry glossary[] = {
    {"claim",
     "a statement that was examined; eq-27 is the paper's equation (27), with a further letter where one number "
     "holds several statements; num-... is a printed number, text-... a sentence, fig-... a figure",
     false},
    {"scene", "a set of data: values of the parameters, and the numbers that are printed for them", false},
    {"orbit",
     "a periodic solution that goes through the four phases once, each ending at the first time at which its "
     "condition is met; the orbits of one set of data (where e1 and e2 stand for $e_1$ and $e_2$) are numbered by "
     "increasing $z_{10}$",
     true},
    {"admissible",
     "said of an orbit on which every condition of the motion holds for suitable static friction, so that the "
     "masses can follow it; realistic, where the static friction is given and suffices",
     true},
    {"tr J, criterion",
     "$\\operatorname{tr} J$ is the trace of the Jacobian of one period, its only eigenvalue besides "
     "0; by the paper's criterion an orbit is conditionally stable if $|\\operatorname{tr} J| < 1$ "
     "and unstable otherwise",
     true},
    {"propagator", "the matrix that carries the state over a phase of given duration", true},
    {"D, Gamma (G), H, C",
     "the global stick, slip-stick, global slip and stick-slip phases, by the letters of their "
     "matrices",
     true},
    {"printed, corrected",
     "the paper's own formulas, and the same formulas with the corrections proposed here; \"own text "
     "printed, the rest corrected\" means that the formula in question is taken as printed and all "
     "others as corrected",
     false},
    {"model", "the system computed from (1) and (2) alone", true},
    {"route",
     "a method by which a claim was checked: exact algebra, balls (interval arithmetic: numbers with proved error "
     "bounds), a matrix exponential, finite differences (fd), integration of the equations of motion, or "
     "reading what is printed (diagnostic); a route that states something decides nothing",
     false},
    {"residual", "the difference of two routes, relative to the size of what they compute", false},
    {"trials, bits", "the number of points at which they were compared, and the number of binary digits used", false},
    {"margin", "the difference of the two sides of an inequality, positive where it holds", false},
    {"degree",
     "of a quantity: k, if the quantity is multiplied by s^k when everything measured in one unit is multiplied by s; "
     "only quantities of the same degree can be added or equal",
     false},
    {"certificate",
     "what anybody can recheck: exact parameters at which the two sides differ, or the reason why a formula "
     "cannot be right",
     false},
    {"control", "a statement made wrong on purpose, to test whether the audit notices it", false}};

const struct glossary_entry *glossary_next(const struct glossary_entry *last, const struct audit_result *r) {
  for (const struct glossary_entry *g = last ? last + 1 : glossary; g < glossary + sizeof glossary / sizeof *glossary;
       g++)
    if (r->model || !g->of_motion) return g;
  return NULL;
}
