# A paper about another system than the program's: three masses in a row, and one of them damped.  It does not say
# "model: ...", so that K and t are its own.
paper: A note on three masses in a row
section: note

symbol t
  means: time
  domain: t >= 0
symbol kappa
  means: stiffness of each spring
  domain: kappa > 0
symbol mu
  means: mass of each block
  domain: mu > 0
symbol zeta
  means: damping ratio
  domain: 0 < zeta < 1
symbol q_0
  means: a constant of the motion
  domain: real
symbol theta
  means: an angle of which the note says nothing more

define eq-1
  tex: K = \begin{pmatrix} 2\kappa & -\kappa & 0 \\ -\kappa & 2\kappa & -\kappa \\ 0 & -\kappa & \kappa \end{pmatrix}
  K := [2*kappa, -kappa, 0; -kappa, 2*kappa, -kappa; 0, -kappa, kappa]

equation eq-2
  tex: \det K = \kappa^3
  det(K) = kappa^3

define eq-3
  tex: \omega = \sqrt{\frac{\kappa}{\mu}}, \quad q(t) = q_0 e^{-\zeta \omega t} \sin(\sqrt{1 - \zeta^2} \omega t)
  omega := sqrt(kappa/mu)
  q(t) := q_0*exp(-zeta*omega*t)*sin(sqrt(1 - zeta^2)*omega*t)

equation eq-4
  tex: q''(t) + 2\zeta\omega q'(t) + \omega^2 q(t) = 0
  q''(t) + 2*zeta*omega*q'(t) + omega^2*q(t) = 0

equation eq-5
  tex: \omega^2 = \frac{\kappa}{\mu}, \quad \sqrt{\kappa^2} = \kappa
  omega^2 = kappa/mu
  sqrt(kappa^2) = kappa

equation eq-6
  tex: e^{2\pi\zeta} = e^{\pi\zeta}
  exp(2*pi*zeta) = exp(pi*zeta)

equation eq-7
  tex: \sin\theta = \kappa
  sin(theta) = kappa

inequality eq-8
  tex: \sqrt{\kappa} < 1 + \kappa
  sqrt(kappa) < 1 + kappa
