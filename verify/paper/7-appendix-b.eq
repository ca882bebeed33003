# Appendix B: constraints, (51)-(61).
section: appendix_b

inequality eq-51
  tex: t_a > 0, t_b > 0, t_c > 0, t_d > 0
  place: 13842-13864
  t_a > 0
  t_b > 0
  t_c > 0
  t_d > 0

inequality eq-52
  tex: e_1 - 2u_{r1} < z_{10} - \chi z_{20} < e_1 \quad e_2 - 2u_{r2} < \chi(z_{20} - z_{10}) < e_2
  place: 13865-13922
  e_1 - 2*u_r1 < z_10 - chi*z_20 < e_1
  e_2 - 2*u_r2 < chi*(z_20 - z_10) < e_2

inequality eq-53
  tex: u_{r1} > \frac{V t_a (1 - \chi)}{2}, \quad u_{r2} > \frac{e_2 - \chi(z_{20} - z_{10})}{2}
  place: 14183-14236
  u_r1 > V*t_a*(1 - chi)/2
  u_r2 > (e_2 - chi*(z_20 - z_10))/2

inequality eq-54
  tex: 0 < t < t_a ... e_1 - 2u_{r1} < z_1 - \chi z_2 < e_1, \quad e_2 - 2u_{r2} < \chi(z_2 - z_1) < e_2
  place: 14376-14382 14383-14433
  e_1 - 2*u_r1 < z_1(t) - chi*z_2(t) < e_1 for t in (0, t_a)
  e_2 - 2*u_r2 < chi*(z_2(t) - z_1(t)) < e_2 for t in (0, t_a)

equation eq-55
  tex: z_1 - \chi z_2 = z_{10} - \chi z_{20} + V t (1 - \chi) = e_1 + V(t - t_a)(1 - \chi)
  place: 14438-14484
  z_1(t) - chi*z_2(t) = z_10 - chi*z_20 + V*t*(1 - chi) = e_1 + V*(t - t_a)*(1 - chi)

equation eq-55b
  tex: \chi(z_2 - z_1) = \chi(z_{20} - z_{10})
  place: 14485-14509
  chi*(z_2(t) - z_1(t)) = chi*(z_20 - z_10)

inequality eq-56
  tex: z_{10} - \chi z_{20} < z_1 - \chi z_2 < e_1
  place: 14518-14542
  z_10 - chi*z_20 < z_1(t) - chi*z_2(t) < e_1

inequality eq-57
  tex: t_a < t < t_a + t_b ... z'_1 < V, \quad e_2 - 2u_{r2} < h(t) \equiv \chi(z_2 - z_1) < e_2
  place: 14611-14623 14624-14661
  reads: h(t) \equiv \chi(z_2 - z_1) as h(t)
  z_1'(t) < V for t in (t_a, t_a + t_b)
  e_2 - 2*u_r2 < h(t) < e_2 for t in (t_a, t_a + t_b)

define eq-57b
  tex: h(t) \equiv \chi(z_2 - z_1)
  place: 14643-14657
  h(t) := chi*(z_2(t) - z_1(t))

equation text-h-slope
  tex: h'(t) = \chi(z'_2 - z'_1) = \chi(V - z'_1)
  place: 14713-14740
  h'(t) = chi*(z_2'(t) - z_1'(t)) = chi*(V - z_1'(t))

inequality text-h-increases
  tex: \chi(V - z'_1) > 0
  place: 14732-14742
  chi*(V - z_1'(t)) > 0

inequality eq-58b
  tex: e_2 - 2u_{r2} < h(t_a) < e_2
  place: 14806-14827
  e_2 - 2*u_r2 < h(t_a) < e_2

equation eq-58
  tex: h(t_a + t_b) = e_2
  place: 14829-14842
  h(t_a + t_b) = e_2

inequality eq-59
  tex: t_a + t_b + t_c < t < t_a + t_b + t_c + t_d ... e_1 - 2u_{r1} < z_1 - \chi z_2 < e_1, \quad z'_2 < V
  place: 14946-14974 14975-15005
  e_1 - 2*u_r1 < z_1(t) - chi*z_2(t) < e_1 for t in (t_a + t_b + t_c, t_a + t_b + t_c + t_d)
  z_2'(t) < V for t in (t_a + t_b + t_c, t_a + t_b + t_c + t_d)

define eq-60c
  tex: \bar{h}(t) = z_1 - \chi z_2
  place: 15056-15071
  hbar(t) := z_1(t) - chi*z_2(t)

equation eq-60
  tex: \bar{h}'(t) = z'_1 - \chi z'_2 = V - \chi z'_2
  place: 15072-15098
  hbar'(t) = z_1'(t) - chi*z_2'(t) = V - chi*z_2'(t)

inequality eq-60b
  tex: V - \chi z'_2 > 0
  place: 15092-15100
  V - chi*z_2'(t) > 0

equation eq-61
  tex: \bar{h}(t_a + t_b + t_c + t_d) = z_{10} - \chi z_{20}
  place: 15193-15226
  hbar(t_a + t_b + t_c + t_d) = z_10 - chi*z_20

# What the text of the appendix says between its numbered lines.
equation text-h-start
  note: (55) at t_a, where the stick phase ends and h begins
  h(t_a) = chi*(z_20 - z_10)

equation text-hbar-start
  note: (60) at the start of its interval
  hbar(t_a + t_b + t_c) = z_1c - chi*z_2c

inequality text-h-phase
  tex: t_a + t_b < t < t_a + t_b + t_c ... z'_1 < V, z'_2 < V
  place: 14874-14894 14909-14921
  z_1'(t) < V for t in (t_a + t_b, t_a + t_b + t_c)
  z_2'(t) < V for t in (t_a + t_b, t_a + t_b + t_c)

inequality text-first
  tex: u_{r1} > e_1
  place: 14325-14334
  u_r1 > e_1

equation text-start-w
  note: (55) at t = 0
  z_10 - chi*z_20 = e_1 - V*t_a*(1 - chi)

# The constraints in closed form; the ranges that follow stand in verify/claims/7-ranges.claim.
equation text-57-range
  note: the first inequality of (57)
  V - z_1'(t) = (1 - chi)*V*(1 - cos(t - t_a)) + e_1*sin(t - t_a)

equation text-59-range
  section: appendix_a
  note: the second inequality of (59), from the state at the start of its interval
  V - z_2'(t) = (V - z'_2c)*cos(omega*(t - t_a - t_b - t_c)) + omega*(z_2c - z_1c)*sin(omega*(t - t_a - t_b - t_c))

inequality text-57-friction
  note: what the lower bound of (57) asks of u_r2, inside its interval
  u_r2 >= chi*((1 - chi)*V*(t_b - sin(t_b)) + e_1*(1 - cos(t_b)))/2

inequality text-58-friction
  note: and what (58) and (52) ask
  u_r2 > chi*((1 - chi)*V*(t_b - sin(t_b)) + e_1*(1 - cos(t_b)))/2

inequality text-16-friction
  section: appendix_a
  note: what (16) asks of u_r1
  u_r1 > ((1 - chi)*V*(t_a + t_d) + chi*(z_10 - z_20)*(1 - cos(omega*t_d)))/2

inequality text-behind-range
  note: the second mass is behind while both stick
  z_20 < z_10

inequality text-behind-duration
  note: the same by t_b
  e_2 < chi*((1 - chi)*V*(t_b - sin(t_b)) + e_1*(1 - cos(t_b)))

# The same conditions in other words, against which the list is held.
inequality text-51-order
  note: the switching times of (51) follow one another
  0 < t_a < t_a + t_b < t_a + t_b + t_c < t_a + t_b + t_c + t_d

inequality text-h-rises
  note: "h(t) is an increasing function"
  h'(t) > 0

inequality text-hbar-rises
  note: "hbar(t) is an increasing function"
  hbar'(t) > 0

inequality text-first-sliding
  note: there is sliding friction on the first mass
  u_s1 > 0
