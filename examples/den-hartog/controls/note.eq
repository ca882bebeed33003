# The load with the phase of the other sign.
equation ctl-phase
  replaces: eq-1
  m*x''(t) + k*x(t) = F + P*(u*cos(omega*t) + v*sin(omega*t))

# The damping function without 1/beta in front.
define ctl-damping
  section: note
  S := sin(pi/beta)/(1 + cos(pi/beta))

# An amplitude from which friction takes nothing.
define ctl-amplitude
  section: note
  x_0 := a*sqrt(V^2)

# The next half cycle with friction that pushes upwards still.
equation ctl-next
  replaces: eq-10
  m*y''(t) + k*y(t) = F + P*(u*cos(omega*t) - v*sin(omega*t))

# The acceleration of a mass that the load does not touch.
equation ctl-acceleration
  replaces: eq-13
  m*x''(0) = F - k*x_0

# A limit with another power of the frequency.
define ctl-limit
  section: note
  F_l := P*sqrt(V^2/(S^2 + 1/beta^2))
