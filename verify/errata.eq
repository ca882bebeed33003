# Corrections, an overlay on paper/.  Each is held to the checks that the printed form failed.

define err-10
  section: prediction
  tex: D = \begin{pmatrix} I & tI \\ 0 & I \end{pmatrix}
  note: z' = (V, V)^t already carries the velocity
  D(t) := [I, t*I; 0, I]

equation eq-29
  tex: Z(t_a + dt_a + t_b + dt_b) = \Gamma(t_b + dt_b)(Z_a + dZ_a)
  note: the slip-stick phase starts at Z_a + dZ_a, as (28) says
  Z(t_a + dt_a + t_b + dt_b) = Gamma(t_b + dt_b)*(Z_a + dZ_a)

equation eq-30
  tex: dZ_b = Z(t_a + dt_a + t_b + dt_b) - Z(t_a + t_b) = \Gamma(t_b)dZ_a + \Gamma'(t_b)Z_a dt_b
  reads: Z(t_a + dt_a + t_b + dt_b) - Z(t_a + t_b) as
    [\Gamma(t_b + dt_b)(Z_a + dZ_a) - \Gamma(t_b)Z_a]_{O(x_a, y_a, dt_b)^{\le 1}}
  note: from (29) as corrected
  dZ_b = first_order(Gamma(t_b + dt_b)*(Z_a + dZ_a) - Gamma(t_b)*Z_a; x_a, y_a, dt_b)
    = Gamma(t_b)*dZ_a + Gamma'(t_b)*Z_a*dt_b

equation eq-31
  tex: \chi(x_2(t_a + dt_a + t_b + dt_b) - x_1(t_a + dt_a + t_b + dt_b)) = u_{r2}
  note: it is the second mass that breaks away, so its own static friction limits the force
  chi*(x_2(t_a + dt_a + t_b + dt_b) - x_1(t_a + dt_a + t_b + dt_b)) = u_r2

equation eq-32b
  tex: \chi_b = z'_{1b} / V
  chi_b = z'_1b/V

equation eq-32d
  tex: \chi_b = z'_1(t_a + t_b) / V
  note: as in (14), the slip-stick phase ends at t_a + t_b
  chi_b = z_1'(t_a + t_b)/V

equation eq-32c
  tex: \begin{pmatrix} y_b \\ u_b \end{pmatrix} = J_b y_a
  [y_b; u_b] = J_b*y_a

define err-40
  section: stability
  tex: \tilde{k}_4 = \frac{V \sin(\omega t_d)}{\omega (z_{200} - z_{100})}
  ktilde_4 := V*sin(omega*t_d)/(omega*(z_200 - z_100))
