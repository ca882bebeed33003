# A paper of two equations about the same oscillator: both masses stick, and the volume of the states is kept.
paper: A note on two equations of the oscillator
place: 2-35
model: two masses on a belt
text: sha256 22dd2151620d09a431a71f9c1ac91defd7c28bb4b20a9f124ff29d3a9133301b
section: note

symbol t
  means: time since the phase began

define eq-1
  tex: D(t) = \begin{pmatrix} I & tI \\ 0 & I \end{pmatrix}
  place: 83-97
  D(t) := [I, t*I; 0, I]

define identity
  I := [1, 0; 0, 1]

equation eq-2
  tex: \det D(t) = 1 + t
  place: 179-187
  det(D(t)) = 1 + t
