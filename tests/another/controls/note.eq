define ctl-propagator
  section: note
  D(t) := [I, 2*t*I; 0*I, I]
