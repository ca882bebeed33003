# Corrections of the note.

equation eq-2
  section: note
  det(D(t)) = 1
