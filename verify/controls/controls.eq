# What the controls damage; seen by the control of the same id and by nothing else.

# one sign of one mode shape
define ctl-propagator
  section: appendix_a
  Lambda := [1, 1; lambda_1, -lambda_2]

# the velocity enters twice, and squared
define ctl-propagator-stick
  section: prediction
  D(t) := [I, V^2*t*I; 0, I]

define ctl-stiffness
  section: prediction
  K := [1, -chi; chi*eta, chi*eta]

# exact algebra: wrong by one part in 10^90
define ctl-exact-matrix
  section: prediction
  K := [1, -chi; -chi*eta, chi*eta + 1e-90*(1 - chi)]

define ctl-exact-propagator
  section: appendix_a
  gamma_1(t) := [cos(t), 0; 0, 1 + 1e-90*t]

define ctl-exact-modes
  section: appendix_a
  s_2(t) := sin(omega_2*t)*(1 + 1e-90*eta)

define ctl-exact-motion
  section: appendix_a
  A_2(t) := [t, 0; 0, sin(omega*t)/omega + 1e-90*(1 - cos(omega*t))]

equation ctl-exact-friction
  replaces: eq-1
  x_1''(t) + x_1(t) - chi*x_2(t) = u_1 + 1e-90*V*t

define ctl-equilibrium
  section: prediction
  d_02 := (u_s1*chi - u_s2)/((1 - chi)*chi)

# no fall of the friction where the first mass breaks loose
relation ctl-fall
  replaces: eq-2
  u_1 = u_r1*eps for eps in {+1, -1}
  u_2 = u_s2*eps for eps in {+1, -1}
  eps*(V - x_1'(t)) > 0 for eps in {+1, -1}
  eps*(V - x_2'(t)) > 0 for eps in {+1, -1}

# sliding friction that drives the second mass away from the belt's velocity
relation ctl-drag
  replaces: eq-2
  u_1 = u_s1*eps for eps in {+1, -1}
  u_2 = u_s2*eps for eps in {+1, -1}
  eps*(V - x_1'(t)) > 0 for eps in {+1, -1}
  eps*(x_2'(t) - V) > 0 for eps in {+1, -1}

# a spring that is not linear
relation ctl-linear
  replaces: eq-1
  trajectory x_1(t), x_2(t)
  x_1''(t) + x_1(t) + x_1(t)^3/1000 - chi*x_2(t) = u_1
  x_2''(t) + chi*eta*(x_2(t) - x_1(t)) = eta*u_2

define ctl-closed-forms
  section: prediction
  d_01 := (u_s1 - u_s2)/(1 - chi)

define ctl-frequency
  section: appendix_a
  root omega_1: det(K + I*omega_1^2 - 2*I), smallest positive

define ctl-motion
  section: appendix_a
  gamma_2(t) := [sin(t), 0; 0, t^2]

equation ctl-finite
  replaces: eq-33
  [z_1(t); z_2(t); z_1'(t); z_2'(t)] = H(t - t_a - dt_a - t_b - dt_b)*(Z_b - dZ_b)

equation ctl-first-order
  replaces: eq-34
  dZ_c = H(t_c)*dZ_b + H'(t_c)*Z_c*dt_c

equation ctl-inside-phase
  replaces: eq-15
  [z_1(t); z_2(t); z_1'(t); z_2'(t)] = H(t - t_a)*[z_1b; z_2b; z'_1b; z'_2b]

inequality ctl-inequality
  replaces: eq-56
  z_10 - chi*z_20 < z_1(t) - chi*z_2(t) < e_2

# true in the phase, and not the best that can be said
inequality ctl-sharp
  replaces: eq-56
  z_10 - chi*z_20 - V < z_1(t) - chi*z_2(t) < e_1

equation ctl-switching
  replaces: eq-26
  x_1(t_a + dt_a) - chi*x_2(t_a + dt_a) = u_s1

equation ctl-perturbation
  replaces: eq-31b
  x_b = -y_b

define ctl-jacobian-a
  section: stability
  J_a := (1/(1 - chi))*[1, 1]

define ctl-jacobian-b
  section: stability
  gammatilde_1 := (chi + chi_b)/(1 - chi_b)

define ctl-jacobian-c
  section: stability
  ktilde_3 := ktilde_1*chi*eta*(z_1c + z_2c)/V

define ctl-jacobian-f
  section: stability
  ktilde_6 := cos(omega*t_d) + ktilde_4

define ctl-chain
  section: stability
  J := J_f*J_c*J_b*J_a*2

equation ctl-determinant
  replaces: eq-43
  det(J) + 1 = det(J_f*J_c)*det(J_b*J_a)

equation ctl-charpoly
  replaces: text-charpoly
  P(lambda) = lambda*(lambda + tr(J))

inequality ctl-criterion
  replaces: text-criterion
  -2 < tr(J) < 2

equation ctl-periodicity
  replaces: eq-44b
  (N_1 + I)*z_0 + N_2*z'_0 = 0

define ctl-compatibility
  section: validation
  M := inv(N_1 - I)*N_2 + inv(N_3)*(N_4 - I)

inequality ctl-positive
  replaces: eq-51
  t_a < 0

inequality ctl-bound
  replaces: eq-53
  u_r1 > V*t_a*(1 + chi)/2
  u_r2 > (e_2 - chi*(z_20 - z_10))/2

# half of the upper bound
inequality ctl-argument
  replaces: eq-54
  e_1 - 2*u_r1 < z_1(t) - chi*z_2(t) < e_1/2 for t in (0, t_a)

# one u_r2, not two
inequality ctl-limits
  replaces: eq-52
  e_1 - 2*u_r1 < z_10 - chi*z_20 < e_1
  e_2 - u_r2 < chi*(z_20 - z_10) < e_2

inequality ctl-argument-example
  replaces: eq-57
  z_1'(t) < V/2 for t in (t_a, t_a + t_b)

# a displacement and a time
equation ctl-scaling
  replaces: eq-12b
  z_1a - chi*z_2a = e_1 + t_a

relation ctl-motion-equations
  replaces: eq-1
  trajectory x_1(t), x_2(t)
  x_1''(t) + x_1(t) - chi*x_2(t) = u_1
  x_2''(t) + chi*(x_2(t) - x_1(t)) = u_2

equation ctl-blocks
  replaces: eq-1c
  chi = k_2/k_1

# sticks a little beyond the limit on one side
relation ctl-law
  replaces: eq-2b
  u_1 = x_1(t) - chi*x_2(t)
  -u_r1 < x_1(t) - chi*x_2(t) < u_r1*1.125

relation ctl-realistic
  replaces: eq-9
  z_1'(t) = z_2'(t) = V
  e_1 - 2*u_r1 < z_10 - chi*z_20 < e_1/2

# true where both velocities are V
define ctl-patched
  section: stability
  Z_a := [z_1a; z_2a; z'_2a; z'_1a]

# each step the other way round
inequality ctl-inequality-turned
  replaces: eq-56
  z_10 - chi*z_20 > z_1(t) - chi*z_2(t) > e_1

# true where t_a = t_b
define ctl-meeting
  section: periodic
  S_b := Gamma(t_a)*S_a

# the velocities of masses that stick are not perturbed
define ctl-perturbation-sticks
  section: stability
  dZ_a := [x_a; y_a; x_a - y_a; 0]

# (16) in the place of (14), with a factor
equation ctl-rank-repeated
  replaces: text-six-equations
  S_a[1] - chi*S_a[2] = e_1
  2*S_c[3] = 2*V
  S_c[3] = V
  S_f = S_0

# one equation, said twice
equation ctl-rank-equations
  replaces: eq-22
  u = v = u

# the mass of the other block
equation ctl-blocks-time
  replaces: eq-1c
  omega_3 = sqrt((k_1 + k_2)/m_2)

# true where x_b = y_b
define ctl-perturbation-form
  section: stability
  dZ_b := [y_b; x_b; u_b; 0]

# follows from (52), but is weaker
inequality ctl-converse
  replaces: eq-58b
  e_2 - 3*u_r2 < h(t_a) < e_2

# the correction of (40), wrong by one part in 10^30
define ctl-correction-formula
  section: stability
  ktilde_4 := (V*sin(omega*t_d)/(omega*(z_200 - z_100)))*(1 + 1e-30)

# wrong by little, each where another formula is judged by it
define ctl-phases
  section: stability
  phi_1(t) := (1 + 1e-30)*D(t)

define ctl-start
  section: stability
  dz_0 := (1 + 1e-30)*transpose([x, y])

define ctl-polynomial
  section: stability
  P(lambda) := (1 + 1e-30)*det(J - lambda*I)

relation ctl-slips
  replaces: eq-2
  u_1 = u_s1*eps*(1 + 1e-12) for eps in {+1, -1}
  u_2 = u_s2*eps for eps in {+1, -1}
  eps*(V - x_1'(t)) > 0 for eps in {+1, -1}
  eps*(V - x_2'(t)) > 0 for eps in {+1, -1}

inequality ctl-stays-below
  replaces: eq-54
  e_1 - 2*u_r1 < z_1(t) - chi*z_2(t) < e_1*(1 - 1e-6) for t in (0, t_a)
  e_2 - 2*u_r2 < chi*(z_2(t) - z_1(t)) < e_2 for t in (0, t_a)

inequality ctl-stays-below-second
  replaces: eq-57
  z_1'(t) < V for t in (t_a, t_a + t_b)
  e_2 - 2*u_r2 < h(t) < e_2*(1 - 1e-6) for t in (t_a, t_a + t_b)

inequality ctl-stays-slower
  replaces: eq-59
  e_1 - 2*u_r1 < z_1(t) - chi*z_2(t) < e_1 for t in (t_a + t_b + t_c, t_a + t_b + t_c + t_d)
  z_2'(t) < V*(1 - 1e-6) for t in (t_a + t_b + t_c, t_a + t_b + t_c + t_d)

# the lower bound on both sides
inequality ctl-comes-below
  replaces: eq-16b
  e_1 - 2*u_r1 < z_1c - chi*z_2c < e_1 - 2*u_r1

# true with V (1 - chi) on the right, which is what (60) is worth
inequality ctl-increases
  replaces: eq-60b
  V - chi*z_2'(t) > V*(1 - chi)*(1 + 1e-6)
