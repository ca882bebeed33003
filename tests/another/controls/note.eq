define ctl-propagator
  section: note
  D(t) := [I, 2*t*I; 0*I, I]

equation ctl-determinant
  replaces: eq-2
  det(D(t)) = 1 + 1e-30*t
