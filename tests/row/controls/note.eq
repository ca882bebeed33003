define ctl-stiffness
  section: note
  K := [3*kappa, -kappa, 0; -kappa, 2*kappa, -kappa; 0, -kappa, kappa]

equation ctl-damped
  replaces: eq-4
  q''(t) + 2*zeta*omega*q'(t) + omega^2*q(t) = 1e-30*q_0

inequality ctl-bound
  replaces: eq-8
  sqrt(kappa) < kappa
