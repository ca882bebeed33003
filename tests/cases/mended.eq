# Forms of some of planted.eq that lose none, or fewer.
define mended
  cancels(t) := 2*sin(t/2)^2
  grows := V*sqrt(1 + (t/V)^2)
