# Den Hartog's oscillator with dry friction.  There is no line "model: ...", so that every letter is the note's own.
paper: A note on Den Hartog's forced vibration with dry friction
place: 2-49
text: sha256 1fa1a48f83ce71e95042788786c2441d95f14e68283ef7fd2b4c115122aebf47
section: note

symbol t
  means: time since the displacement was greatest
  domain: t >= 0

symbol m
  means: mass
  domain: m > 0

symbol k
  means: stiffness of the spring
  domain: k > 0

symbol omega
  means: frequency of the load
  domain: omega > 0

symbol P
  means: amplitude of the load
  domain: P > 0

symbol F
  means: friction of the mass in motion
  domain: F > 0

symbol A
  means: a constant of the general motion
  domain: real

symbol B
  means: another one
  domain: real

symbol C
  means: another one
  domain: real

symbol D
  means: another one
  domain: real

equation eq-1
  tex: m x''(t) + k x(t) = F + P (u \cos(\omega t) - v \sin(\omega t))
  place: 531-562
  m*x''(t) + k*x(t) = F + P*(u*cos(omega*t) - v*sin(omega*t))

define eq-2
  tex: \omega_n = \sqrt{\frac{k}{m}}, \quad \beta = \frac{\omega}{\omega_n}, \quad a = \frac{P}{k}, \quad x_f = \frac{F}{k}
  place: 566-613
  omega_n := sqrt(k/m)
  beta := omega/omega_n
  a := P/k
  x_f := F/k

define eq-3
  tex: V = \frac{1}{1 - \beta^2}, \quad S = \frac{1}{\beta} \frac{\sin(\pi/\beta)}{1 + \cos(\pi/\beta)}
  place: 659-700
  V := 1/(1 - beta^2)
  S := (1/beta)*(sin(pi/beta)/(1 + cos(pi/beta)))

equation eq-4
  tex: (k - m \omega^2) V = k, \quad \beta S \sin(\pi/\beta) = 1 - \cos(\pi/\beta)
  place: 742-770
  (k - m*omega^2)*V = k
  beta*S*sin(pi/beta) = 1 - cos(pi/beta)

define eq-5
  tex: x_0 = a \sqrt{V^2 - (x_f/a)^2 S^2}
  place: 785-808
  x_0 := a*sqrt(V^2 - (x_f/a)^2*S^2)

define eq-6
  tex: u = \frac{x_0}{a V}, \quad v = -\frac{x_f}{a} \frac{S}{V}
  place: 829-860
  u := x_0/(a*V)
  v := -(x_f/a)*(S/V)

define eq-7
  tex: x(t) = x_0 \cos(\omega t) + x_f S \sin(\omega t) + x_f (1 - \cos(\omega_n t) - \frac{\sin(\pi/\beta)}{1 + \cos(\pi/\beta)} \sin(\omega_n t))
  place: 899-963
  x(t) := x_0*cos(omega*t) + x_f*S*sin(omega*t) + x_f*(1 - cos(omega_n*t) - (sin(pi/beta)/(1 + cos(pi/beta)))*sin(omega_n*t))

equation eq-8
  tex: x(0) = x_0, \quad x'(0) = 0, \quad x(\pi/\omega) = -x_0, \quad x'(\pi/\omega) = 0
  place: 986-1023
  x(0) = x_0
  x'(0) = 0
  x(pi/omega) = -x_0
  x'(pi/omega) = 0

equation eq-9
  tex: u^2 + v^2 = 1
  place: 1048-1056
  u^2 + v^2 = 1

define def-10
  tex: y(t) = -x(t - \pi/\omega)
  place: 1086-1099
  y(t) := -x(t - pi/omega)

equation eq-10
  tex: m y''(t) + k y(t) = -F + P (u \cos(\omega t) - v \sin(\omega t))
  place: 1128-1160
  m*y''(t) + k*y(t) = -F + P*(u*cos(omega*t) - v*sin(omega*t))

define def-11
  tex: z(t) &= x_f + A \cos(\omega_n t) + B \sin(\omega_n t) + C \cos(\omega t) + D \sin(\omega t)
  place: 1249-1288
  z(t) := x_f + A*cos(omega_n*t) + B*sin(omega_n*t) + C*cos(omega*t) + D*sin(omega*t)

equation eq-11
  tex: m z''(t) + k z(t) &= F + (k - m \omega^2) (C \cos(\omega t) + D \sin(\omega t))
  place: 1289-1327
  m*z''(t) + k*z(t) = F + (k - m*omega^2)*(C*cos(omega*t) + D*sin(omega*t))

equation eq-12
  tex: z(0) + z(\pi/\omega) - \frac{\sin(\pi/\beta)}{1 + \cos(\pi/\beta)} \frac{z'(0) + z'(\pi/\omega)}{\omega_n} &= 2 (x_f + A) \\ \frac{\sin(\pi/\beta)}{1 + \cos(\pi/\beta)} (z(0) + z(\pi/\omega)) + \frac{z'(0) + z'(\pi/\omega)}{\omega_n} &= 2 (B + \frac{\sin(\pi/\beta)}{1 + \cos(\pi/\beta)} x_f)
  place: 1422-1564
  z(0) + z(pi/omega) - (sin(pi/beta)/(1 + cos(pi/beta)))*((z'(0) + z'(pi/omega))/omega_n) = 2*(x_f + A)
  (sin(pi/beta)/(1 + cos(pi/beta)))*(z(0) + z(pi/omega)) + (z'(0) + z'(pi/omega))/omega_n = 2*(B + (sin(pi/beta)/(1 + cos(pi/beta)))*x_f)

equation eq-13
  tex: m x''(0) = F + P u - k x_0 = F - k \beta^2 x_0
  place: 1642-1668
  m*x''(0) = F + P*u - k*x_0 = F - k*beta^2*x_0

define eq-14
  tex: F_l = P \sqrt{\frac{V^2}{S^2 + 1/\beta^4}}
  place: 1716-1740
  F_l := P*sqrt(V^2/(S^2 + 1/beta^4))

equation eq-15
  tex: x_0^2 - \frac{x_f^2}{\beta^4} = (S^2 + \frac{1}{\beta^4}) \frac{F_l^2 - F^2}{k^2}
  place: 1778-1829
  x_0^2 - x_f^2/beta^4 = (S^2 + 1/beta^4)*((F_l^2 - F^2)/k^2)
