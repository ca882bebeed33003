# Prediction of the oscillations: the four kinds of motion, (3)-(10).
section: prediction

define eq-3
  tex: K = \begin{pmatrix} 1 & -\chi \\ -\chi \eta & \chi \eta \end{pmatrix}
  place: 3060-3074
  K := [1, -chi; -chi*eta, chi*eta]

define eq-3b
  tex: d_{01} = \frac{u_{s1} + u_{s2}}{1 - \chi}, \quad
    d_{02} = \frac{u_{s1} \chi + u_{s2}}{(1 - \chi) \chi}
  place: 3117-3175
  d_01 := (u_s1 + u_s2)/(1 - chi)
  d_02 := (u_s1*chi + u_s2)/((1 - chi)*chi)

relation eq-3d
  tex: z'' + Kz = 0
  place: 3051-3058
  trajectory z_1(t), z_2(t)
  z''(t) + K*z(t) = 0

define eq-3h
  tex: z = (z_1, z_2)'
  place: 3075-3086
  z(t) := transpose([z_1(t), z_2(t)])

inequality eq-3e
  tex: z'_i < V, \quad (i=1,2)
  place: 3102-3115
  z_1'(t) < V
  z_2'(t) < V

relation eq-4
  tex: Z(t) = H(t)Z_0
  place: 3196-3207
  Z(t) = H(t)*Z_0

define eq-4b
  tex: Z = \begin{pmatrix} z \\ z' \end{pmatrix}, \quad Z_0 = Z(0)
  place: 3209-3225
  Z(t) := [z(t); z'(t)]
  Z_0 := Z(0)

define eq-5
  tex: K_1 = \begin{pmatrix} 1 & -\chi \\ 0 & 0 \end{pmatrix}
  place: 3383-3396
  K_1 := [1, -chi; 0, 0]

relation eq-5b
  tex: z'_1 < V, z'_2 = V, \quad e_2 - 2u_{r2} < \chi(z_2 - z_1) < e_2, \quad (e_2 = u_{r2} - u_{s2})
  place: 3397-3456
  z_1'(t) < V
  z_2'(t) = V
  e_2 - 2*u_r2 < chi*(z_2(t) - z_1(t)) < e_2
  e_2 = u_r2 - u_s2

relation eq-6
  tex: Z(t) = \Gamma(t)Z_0
  place: 3506-3517
  Z(t) = Gamma(t)*Z_0

define eq-7
  tex: K_2 = \begin{pmatrix} 0 & 0 \\ -\chi \eta & \chi \eta \end{pmatrix}
  place: 3631-3646
  K_2 := [0, 0; -chi*eta, chi*eta]

relation eq-7b
  tex: z'_1 = V, z'_2 < V, \quad e_1 - 2u_{r1} < z_1 - \chi z_2 < e_1, \quad (e_1 = u_{r1} - u_{s1})
  place: 3647-3704
  z_1'(t) = V
  z_2'(t) < V
  e_1 - 2*u_r1 < z_1(t) - chi*z_2(t) < e_1
  e_1 = u_r1 - u_s1

relation eq-8
  tex: Z(t) = C(t)Z_0
  place: 3728-3739
  Z(t) = C(t)*Z_0

relation eq-9
  tex: z'' = 0, \quad z'_1 = z'_2 = V, \quad e_1 - 2u_{r1} < z_{10} - \chi z_{20} < e_1 \quad
    e_2 - 2u_{r2} < \chi(z_{20} - z_{10}) < e_2
  place: 3819-3894
  z''(t) = 0
  z_1'(t) = z_2'(t) = V
  e_1 - 2*u_r1 < z_10 - chi*z_20 < e_1
  e_2 - 2*u_r2 < chi*(z_20 - z_10) < e_2

define eq-10
  tex: D = \begin{pmatrix} I & VtI \\ 0 & I \end{pmatrix}, \quad
    I = \begin{pmatrix} 1 & 0 \\ 0 & 1 \end{pmatrix}
  place: 3940-3964
  D(t) := [I, V*t*I; 0, I]
  I := [1, 0; 0, 1]

relation eq-10c
  tex: Z(t) = D(t)Z_0
  place: 3927-3938
  Z(t) = D(t)*Z_0

# The restoring forces in x and the same in z, which (2) and the conditions of (5), (7), (9) and (11) limit.
equation text-shift
  tex: z_i = x_i - d_{0i} ... (i=1,2)
  place: 3088-3101 3109-3115
  note: (3), as an equation between the motions
  z_1(t) = x_1(t) - d_01
  z_2(t) = x_2(t) - d_02
