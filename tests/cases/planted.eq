# Formulas whose losses of digits are known beforehand, for tests/check_stability.c.
define planted
  cancels(t) := 1 - cos(t)
  steady(t) := 2*sin(t/2)^2
  turned := sin(V*t)
  divides := t^2/(1 - cos(t))
  hides := (V + t) - V
  grows := sqrt(V^2 + t^2)
  given := (z_20 - z_10)/V
  none := (V + t) - (t + V)
  rolls := sinc(V*t)
  lags := stumpff(V*t)
  spans := hypot(V - 1, t)
  brims := (V*10000000000)/10000000000
  dregs := (V/10000000000)*10000000000
  sinks := e_1*t/sqrt(V*e_1)
  drifts := ((V/49)*49 - V) + t
  folds := (abs(V - t/3) + (V - t/3)) + V^2/3
  whole := rounded((V + t)*(V - t) - V^2)
