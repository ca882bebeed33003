# Corrections of the note.

equation eq-6
  exp(2*pi*zeta) = exp(pi*zeta)^2
