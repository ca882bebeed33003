# --- The proof: each margin is a sum of positive margins, each times a positive factor ---
from sympy import cancel, diff, factor_list, fraction


def product_sign(e):
    """The sign of a number times powers of chi, 1 - chi, eta and V, which are positive; 0 of anything else."""
    sign = 1
    for part in fraction(cancel(e)):
        unit, factors = factor_list(part)
        sign *= 1 if unit > 0 else -1 if unit < 0 else 0
        for factor, power in factors:
            ratio = [cancel(factor / p) for p in POSITIVE]
            known = [r for r in ratio if r.is_number]
            if not known:
                return 0
            sign *= 1 if known[0] > 0 else (-1)**power
    return sign


def solve(proof):
    """Puts what the equations say of some symbols into all that follows."""
    for i, name in proof["solved"]:
        symbol = proof["x"][name]
        equation = fraction(cancel(proof["zero"][i][1]))[0]
        slope = diff(equation, symbol)
        assert not slope.has(symbol) and product_sign(slope) != 0, "%s cannot be solved for %s" % (proof["zero"][i][0], name)
        value = -equation.subs(symbol, 0) / slope
        for key in ("zero", "positive", "goals"):
            proof[key] = [(text, e.subs(symbol, value)) for text, e in proof[key]]


def rate(e, x):
    """The derivative in t of what is a function of values at the time t."""
    moving = {s: x.get(name.replace("(t)", "'(t)")) for name, s in x.items() if name.endswith("(t)") and e.has(s)}
    return sum((diff(e, s) * of for s, of in moving.items()), diff(e, x["t"]) if "t" in x else 0)


def prove(proof):
    goals = [e for _, e in proof["goals"]]
    if proof["rises"]:  # h'(t), and what is positive where h increases: h(t) less its value before, that after less h(t)
        assert cancel(rate(goals[1], proof["x"]) - goals[0]) == 0 == cancel(rate(goals[2], proof["x"]) + goals[0])
    solve(proof)
    known = list(proof["positive"])
    for number, (i, terms) in enumerate(proof["steps"]):
        text, margin = proof["goals"][i]
        assert all(product_sign(factor) > 0 for factor, _ in terms), "a factor may be negative"
        rest = margin - sum(factor * known[k][1] for factor, k in terms)
        assert cancel(rest) == 0, "the margin of %s is another" % text
        print("Checked exactly: the margin of %s is the sum of positive factors times the margins of: %s." % (
            text, "; ".join(known[k][0] for _, k in terms)))
        if proof["rises"] and number == 0:
            known += proof["goals"][1:3]
    assert [i for i, _ in proof["steps"]] == [i for i in range(len(goals)) if not proof["rises"] or i not in (1, 2)]


assert PROOFS
print(__doc__)
for proof in PROOFS:
    x = proof["x"]
    POSITIVE = [x["chi"], 1 - x["chi"], x["eta"], x["V"]]
    if proof["zero"]:
        print("Used as equations: %s." % "; ".join(text for text, _ in proof["zero"]))
    prove(proof)
print("Not checked here: that these are the premises and conclusions that the paper means.")
print(CLAIM + ": proved")
