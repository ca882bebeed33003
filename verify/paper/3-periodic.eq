# Periodic solutions including a global stick phase: (11)-(18).
section: periodic

relation eq-11
  tex: z'_{i0} = V, (i=1,2), \quad e_1 - 2u_{r1} < z_{10} - \chi z_{20} < e_1, \quad
    e_2 - 2u_{r2} < \chi(z_{20} - z_{10}) < e_2
  place: 4709-4785
  z'_10 = V
  z'_20 = V
  e_1 - 2*u_r1 < z_10 - chi*z_20 < e_1
  e_2 - 2*u_r2 < chi*(z_20 - z_10) < e_2

equation eq-12
  tex: Z_a \equiv Z(t_a) = D(t_a)Z_0, \quad Z_a = \begin{pmatrix} z_a \\ z'_a \end{pmatrix}, \quad
    z'_a = (V, V)^t, \quad z_a = (z_{1a}, z_{2a})^t
  place: 5118-5187
  Z_a = Z(t_a) = D(t_a)*Z_0
  Z_a = [z_a; z'_a]
  z'_a = transpose([V, V])
  z_a = transpose([z_1a, z_2a])

equation eq-12b
  tex: z_{1a} - \chi z_{2a} = e_1
  place: 5189-5206
  z_1a - chi*z_2a = e_1

equation eq-13
  tex: Z(t) = \Gamma(t - t_a)Z_a
  place: 5293-5308
  Z(t) = Gamma(t - t_a)*Z_a

equation eq-14
  tex: Z_b \equiv Z(t_a + t_b) = \Gamma(t_b)Z_a, \quad Z_b = \begin{pmatrix} z_b \\ z'_b \end{pmatrix}, \quad
    z'_b = (z'_{1b}, V)^t, \quad z_b = (z_{1b}, z_{2b})^t
  place: 5413-5492
  Z_b = Z(t_a + t_b) = Gamma(t_b)*Z_a
  Z_b = [z_b; z'_b]
  z'_b = transpose([z'_1b, V])
  z_b = transpose([z_1b, z_2b])

equation eq-14b
  tex: \chi(z_{2b} - z_{1b}) = e_2
  place: 5494-5513
  chi*(z_2b - z_1b) = e_2

equation eq-15
  tex: Z(t) = H(t - t_a - t_b)Z_b
  place: 5601-5620
  Z(t) = H(t - t_a - t_b)*Z_b

equation eq-16
  tex: z'_{1c} \equiv z'_1(t_a + t_b + t_c) = V
  place: 5663-5689
  z'_1c = z_1'(t_a + t_b + t_c) = V

inequality eq-16b
  tex: e_1 - 2u_{r1} < z_{1c} - \chi z_{2c} < e_1
  place: 5691-5720
  e_1 - 2*u_r1 < z_1c - chi*z_2c < e_1

equation eq-17
  tex: Z(t) = C(t - t_a - t_b - t_c)Z_c, \quad Z_c = Z(t_a + t_b + t_c)
  place: 5863-5905
  Z(t) = C(t - t_a - t_b - t_c)*Z_c
  Z_c = Z(t_a + t_b + t_c)

# What the range of (17) begins with.
equation text-c-start
  note: (17) at its start
  z_1(t) = z_1c
  z_2(t) = z_2c

equation eq-18
  tex: Z(t_a + t_b + t_c + t_d) = Z_0
  place: 5956-5977
  Z(t_a + t_b + t_c + t_d) = Z_0

# The motion as patched together from (12)-(18), as functions of the six unknowns z_10, z_20, t_a, t_b, t_c, t_d.
define text-patched-states
  S_0 := [z_10; z_20; V; V]
  S_a := D(t_a)*S_0
  S_b := Gamma(t_b)*S_a
  S_c := H(t_c)*S_b
  S_f := C(t_d)*S_c

# The stick phase of the next period, D(t) Z(t_a + t_b + t_c + t_d), less that of this one: zero where (18) holds, and with it
# what follows, which begins with the state that the stick phase ends in (text-states).
equation text-18-returns
  note: the motion repeats itself where (18) holds
  D(t)*Z(t_a + t_b + t_c + t_d) - Z(t) = D(t)*(Z(t_a + t_b + t_c + t_d) - Z_0)

equation text-six-equations
  note: (12), (14), (16) and (18)
  S_a[1] - chi*S_a[2] = e_1
  chi*(S_b[2] - S_b[1]) = e_2
  S_c[3] = V
  S_f = S_0

equation text-periodicity-and-16
  note: (18) and the equation in (16)
  S_f = S_0
  S_c[3] = V

equation text-periodicity-alone
  note: (18)
  S_f = S_0

equation eq-16e
  tex: z_{ic} = z_i(t_a + t_b + t_c), (i=1,2)
  place: 5722-5752
  z_1c = z_1(t_a + t_b + t_c)
  z_2c = z_2(t_a + t_b + t_c)

equation text-constant-force
  tex: z_2 - z_1 = z_{20} - z_{10}
  place: 4994-5012
  z_2(t) - z_1(t) = z_20 - z_10
