# Formulas put over the paper's so that claims of the kinds law, rank, defined, constraints and reach fail, of which the
# paper's own hold, an equation inside its phase alone, and an inequality whose sides are equal: overlay.py confirms
# these failures.

relation eq-2
  u_1 = u_s2*eps for eps in {+1, -1}
  u_2 = u_s2*eps for eps in {+1, -1}
  eps*(V - x_1'(t)) > 0 for eps in {+1, -1}
  eps*(V - x_2'(t)) > 0 for eps in {+1, -1}

equation eq-31b
  x_b = y_b
  V*(z_1c - chi*z_2c)*x_b = e_2*y_b

equation eq-22
  u = v
  e_1*u = e_1*v

define eq-27
  J_a := [1, -1]/(2*chi - (1 + chi) + (1 - chi))

inequality eq-53
  u_r1 > (e_1 - (z_1c - chi*z_2c))/2
  u_r2 > (e_2 - chi*(z_20 + z_10))/2

inequality eq-54
  e_1 + V*(t - t_a)*(1 - chi) < z_1(t) - chi*z_2(t) < e_1 for t in (0, t_a)
  e_2 - 2*u_r2 < chi*(z_2(t) - z_1(t)) < e_2 for t in (0, t_a)

inequality eq-57
  z_1'(t) < V for t in (t_a, t_a + t_b)
  h(t_a) = h(t) < e_2 for t in (t_a, t_a + t_b)

equation eq-46
  z_20 = z_10 + u_s1
