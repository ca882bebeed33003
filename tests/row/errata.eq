# Corrections of the note.

equation eq-6
  section: note
  exp(2*pi*zeta) = exp(pi*zeta)^2
