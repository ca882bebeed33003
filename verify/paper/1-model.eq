# Description of the model: (1)-(2).
section: model

relation eq-1
  tex: x_1'' + x_1 - \chi x_2 = u_1 ... x_2'' + \chi \eta (x_2 - x_1) = \eta u_2
  place: 2037-2054 2087-2108
  trajectory x_1(t), x_2(t)
  x_1''(t) + x_1(t) - chi*x_2(t) = u_1
  x_2''(t) + chi*eta*(x_2(t) - x_1(t)) = eta*u_2

equation eq-1c
  tex: \chi = \frac{k_2}{k_1 + k_2}, \quad \eta = \frac{m_1}{m_2} ... u_i = \frac{F_i}{k_1 + k_2} \quad (i=1,2)
    \quad t = \omega_3 t', \quad \omega_3 = \sqrt{\frac{k_1 + k_2}{m_1}}
  place: 2056-2086 2110-2165
  reads: t' as t_{prime}
  chi = k_2/(k_1 + k_2)
  eta = m_1/m_2
  u_1 = F_1/(k_1 + k_2)
  u_2 = F_2/(k_1 + k_2)
  t = omega_3*t_prime
  omega_3 = sqrt((k_1 + k_2)/m_1)

# The law of each mass has a slipping branch, V - x_i' not zero, and at V - x_i' = 0 a sticking branch and one that
# breaks away.  The paper heads the branches of the first mass "V - x'_i = 0" and those of the second "V - x'_2 = 0".
relation eq-2
  tex: u_i = u_{si} \text{sign}(V - x'_i) \quad (i=1,2)
  place: 2238-2269
  u_1 = u_s1*eps for eps in {+1, -1}
  u_2 = u_s2*eps for eps in {+1, -1}
  eps*(V - x_1'(t)) > 0 for eps in {+1, -1}
  eps*(V - x_2'(t)) > 0 for eps in {+1, -1}

relation eq-2b
  tex: u_1 = ... x_1 - \chi x_2 & \text{if } |x_1 - \chi x_2| < u_{r1}
  place: 2300-2303 2304-2333
  u_1 = x_1(t) - chi*x_2(t)
  -u_r1 < x_1(t) - chi*x_2(t) < u_r1

relation eq-2d
  tex: u_1 = ... \varepsilon u_{s1} & \text{if } \varepsilon(x_1 - \chi x_2) > u_{r1} \quad (\varepsilon = \pm 1)
  place: 2300-2303 2355-2390
  u_1 = eps*u_s1 for eps in {+1, -1}
  eps*(x_1(t) - chi*x_2(t)) > u_r1 for eps in {+1, -1}

relation eq-2c
  tex: u_2 = ... \chi(x_2 - x_1) & \text{if } |\chi(x_2 - x_1)| < u_{r2}
  place: 2420-2423 2424-2457
  u_2 = chi*(x_2(t) - x_1(t))
  -u_r2 < chi*(x_2(t) - x_1(t)) < u_r2

relation eq-2e
  tex: u_2 = ... \varepsilon u_{s2} & \text{if } \varepsilon \chi(x_2 - x_1) > u_{r2} \quad (\varepsilon = \pm 1)
  place: 2420-2423 2479-2514
  u_2 = eps*u_s2 for eps in {+1, -1}
  eps*chi*(x_2(t) - x_1(t)) > u_r2 for eps in {+1, -1}
