# Corrections of the note.

equation eq-2
  det(D(t)) = 1
