# Stability of the periodic solution, (19)-(43): the Poincare map, the perturbed motion phase by phase with its switching
# conditions, the local Jacobians and their chain.  A perturbation is the difference between the perturbed motion at its own
# switching time and the periodic one at its own, or the first-order part of it.
section: stability

define eq-19
  tex: \varphi_1 = D, \varphi_2 = \Gamma, \varphi_3 = H, \varphi_4 = C
  place: 6968-6990
  phi_1(t) := D(t)
  phi_2(t) := Gamma(t)
  phi_3(t) := H(t)
  phi_4(t) := C(t)

# P_k as a function of the state at its start would need a matrix argument; the composition over the printed phases is here.
equation eq-20
  tex: Z(t_k) = \varphi_k(t_k - t_{k-1})Z(t_{k-1}), \quad (k=1, \dots, 4)
  place: 7234-7276
  reads: Z(t_k) = \varphi_k(t_k - t_{k-1})Z(t_{k-1}), \quad (k=1, \dots, 4) as
    Z_a = \varphi_1(t_a)Z_0, Z_b = \varphi_2(t_b)Z_a, Z_c = \varphi_3(t_c)Z_b,
    Z(t_a + t_b + t_c + t_d) = \varphi_4(t_d)Z_c
  Z_a = phi_1(t_a)*Z_0
  Z_b = phi_2(t_b)*Z_a
  Z_c = phi_3(t_c)*Z_b
  Z(t_a + t_b + t_c + t_d) = phi_4(t_d)*Z_c

define eq-21
  tex: dz_0 = (x, y)^t, dz'_0 = (u, v)^t
  place: 7904-7929
  dz_0 := transpose([x, y])
  dz'_0 := transpose([u, v])

equation eq-22
  tex: u = v = 0
  place: 8028-8032
  u = v = 0

equation eq-23
  tex: Z(t) = D(t)Z_0
  place: 8189-8200
  reads: D(t)Z_0 as D(t)(Z_0 + dZ_0)
  note: Z_0 is the perturbed start, Z_0 + dZ_0 in the notation of (24)
  Z(t) = D(t)*(Z_0 + dZ_0)

equation eq-24
  tex: Z(t_a + dt_a) = D(t_a + dt_a)(Z_0 + dZ_0)
  place: 8315-8347
  Z(t_a + dt_a) = D(t_a + dt_a)*(Z_0 + dZ_0)

define eq-25c
  tex: dZ_a = \begin{pmatrix} dz_a \\ dz'_a \end{pmatrix}, dz_a = \begin{pmatrix} x_a \\ y_a \end{pmatrix}, dz'_a = 0
  place: 8423-8462
  dZ_a := [dz_a; dz'_a]
  dz_a := [x_a; y_a]
  dz'_a := [0; 0]

equation eq-25
  tex: dZ_a = Z(t_a + dt_a) - Z(t_a) = D(t_a)dZ_0 + D'(t_a)Z_0 dt_a
  place: 8374-8422
  reads: Z(t_a + dt_a) - Z(t_a) as [D(t_a + dt_a)(Z_0 + dZ_0) - D(t_a)Z_0]_{O(x, y, u, v, dt_a)^{\le 1}}
  note: the difference is written with (24) and (12), to first order
  dZ_a = first_order(D(t_a + dt_a)*(Z_0 + dZ_0) - D(t_a)*Z_0; x, y, u, v, dt_a)
    = D(t_a)*dZ_0 + D'(t_a)*Z_0*dt_a

equation eq-26
  tex: x_1(t_a + dt_a) - \chi x_2(t_a + dt_a) = u_{r1}
  place: 8503-8537
  x_1(t_a + dt_a) - chi*x_2(t_a + dt_a) = u_r1

equation eq-26b
  tex: x_a = \chi y_a
  place: 8546-8553
  x_a = chi*y_a

define eq-27
  tex: J_a = \frac{1}{1-\chi} \begin{pmatrix} -1 & 1 \end{pmatrix}
  place: 8587-8605
  J_a := (1/(1 - chi))*[-1, 1]

equation eq-28
  tex: Z(t) = \Gamma(t - t_a - dt_a)(Z_a + dZ_a)
  place: 8643-8670
  Z(t) = Gamma(t - t_a - dt_a)*(Z_a + dZ_a)

equation eq-29
  tex: Z(t_a + dt_a + t_b + dt_b) = \Gamma(t_b + dt_b)(Z_b + dZ_b)
  place: 8780-8821
  Z(t_a + dt_a + t_b + dt_b) = Gamma(t_b + dt_b)*(Z_b + dZ_b)

define eq-30c
  tex: dZ_b = \begin{pmatrix} dz_b \\ dz'_b \end{pmatrix}, dz_b = \begin{pmatrix} x_b \\ y_b \end{pmatrix},
    dz'_b = \begin{pmatrix} u_b \\ 0 \end{pmatrix}
  place: 8910-8955
  dZ_b := [dz_b; dz'_b]
  dz_b := [x_b; y_b]
  dz'_b := [u_b; 0]

equation eq-30
  tex: dZ_b = Z(t_a + dt_a + t_b + dt_b) - Z(t_a + t_b) = \Gamma(t_b)dZ_b + \Gamma'(t_b)Z_b dt_b
  place: 8848-8909
  reads: Z(t_a + dt_a + t_b + dt_b) - Z(t_a + t_b) as
    [\Gamma(t_b + dt_b)(Z_b + dZ_b) - \Gamma(t_b)Z_a]_{O(x_b, y_b, u_b, dt_b)^{\le 1}}
  note: the difference is written with (29) and (14), to first order
  dZ_b = first_order(Gamma(t_b + dt_b)*(Z_b + dZ_b) - Gamma(t_b)*Z_a; x_b, y_b, u_b, dt_b)
    = Gamma(t_b)*dZ_b + Gamma'(t_b)*Z_b*dt_b

equation eq-31
  tex: \chi(x_2(t_a + dt_a + t_b + dt_b) - x_1(t_a + dt_a + t_b + dt_b)) = u_{r1}
  place: 8996-9050
  chi*(x_2(t_a + dt_a + t_b + dt_b) - x_1(t_a + dt_a + t_b + dt_b)) = u_r1

equation eq-31b
  tex: x_b = y_b
  place: 9059-9065
  x_b = y_b

define eq-32
  tex: J_b = \begin{pmatrix} \tilde{\gamma}_1 \\ \tilde{\gamma}_2 \end{pmatrix},
    \tilde{\gamma}_1 = \frac{\chi - \chi_b}{1 - \chi_b},
    \tilde{\gamma}_2 = (\chi z_{2b} - z_{1b}) \frac{(\chi - 1)}{V(1 - \chi_b)}
  place: 9091-9174
  J_b := [gammatilde_1; gammatilde_2]
  gammatilde_1 := (chi - chi_b)/(1 - chi_b)
  gammatilde_2 := (chi*z_2b - z_1b)*((chi - 1)/(V*(1 - chi_b)))

# chi_b is printed for i = 1 and for i = 2 alike; the first reading is used wherever chi_b stands.
define eq-32e
  tex: \chi_b = z'_i(t_b) / V, \quad (i=1,2)
  place: 9175-9197
  reads: z'_i(t_b) / V, \quad (i=1,2) as z'_{1b} / V
  note: read with i = 1 and at the end of the slip-stick phase, t_a + t_b
  chi_b := z'_1b/V

equation eq-32b
  tex: \chi_b = z'_i(t_b) / V, \quad (i=1,2)
  place: 9175-9197
  reads: z'_i(t_b) as z'_{ib}
  chi_b = z'_1b/V
  chi_b = z'_2b/V

equation eq-32d
  tex: \chi_b = z'_i(t_b) / V
  place: 9175-9189
  reads: z'_i as z'_1
  note: the velocity at the time t_b of the motion, which starts at t = 0
  chi_b = z_1'(t_b)/V

equation eq-32c
  tex: \begin{pmatrix} y_b \\ u_b \end{pmatrix} = J_b y_b
  place: 9074-9089
  [y_b; u_b] = J_b*y_b

equation eq-33
  tex: Z(t) = H(t - t_a - dt_a - t_b - dt_b)(Z_b + dZ_b)
  place: 9232-9268
  Z(t) = H(t - t_a - dt_a - t_b - dt_b)*(Z_b + dZ_b)

define eq-34c
  tex: dZ_c = \begin{pmatrix} dz_c \\ dz'_c \end{pmatrix}, dz_c = \begin{pmatrix} x_c \\ y_c \end{pmatrix},
    dz'_c = \begin{pmatrix} u_c \\ v_c \end{pmatrix}
  place: 9535-9582
  dZ_c := [dz_c; dz'_c]
  dz_c := [x_c; y_c]
  dz'_c := [u_c; v_c]

equation eq-34
  tex: dZ_c = Z(t_a + dt_a + t_b + dt_b + t_c + dt_c) - Z(t_a + t_b + t_c) = H(t_c)dZ_b + H'(t_c)Z_b dt_c
  place: 9460-9534
  reads: Z(t_a + dt_a + t_b + dt_b + t_c + dt_c) - Z(t_a + t_b + t_c) as
    [H(t_c + dt_c)(Z_b + dZ_b) - H(t_c)Z_b]_{O(x_b, y_b, u_b, dt_c)^{\le 1}}
  note: the difference is written with (33) and (15), to first order
  dZ_c = first_order(H(t_c + dt_c)*(Z_b + dZ_b) - H(t_c)*Z_b; x_b, y_b, u_b, dt_c)
    = H(t_c)*dZ_b + H'(t_c)*Z_b*dt_c

equation text-states
  note: the states of (21), (25), (30) and (34) at the switching times
  Z_a = D(t_a)*Z_0
  Z_b = Gamma(t_b)*Z_a
  Z_c = H(t_c)*Z_b

equation eq-35
  tex: x'_1(t_a + dt_a + t_b + dt_b + t_c + dt_c) = V
  place: 9623-9656
  x_1'(t_a + dt_a + t_b + dt_b + t_c + dt_c) = V

equation eq-35b
  tex: u_c = 0
  place: 9665-9669
  u_c = 0

define eq-36
  tex: J_c = \begin{pmatrix}
    (H_{11} + H_{12} + \tilde{k}_1(H_{31} + H_{32})), & H_{13} + \tilde{k}_1 H_{11} \\
    (H_{21} + H_{22} + \tilde{k}_2(H_{31} + H_{32})), & H_{23} + \tilde{k}_2 H_{11} \\
    (H_{41} + H_{42} + \tilde{k}_3(H_{31} + H_{32})), & H_{21} + \tilde{k}_3 H_{11} \end{pmatrix}
  place: 9706-9869
  J_c := [(H_11 + H_12 + ktilde_1*(H_31 + H_32)), H_13 + ktilde_1*H_11;
          (H_21 + H_22 + ktilde_2*(H_31 + H_32)), H_23 + ktilde_2*H_11;
          (H_41 + H_42 + ktilde_3*(H_31 + H_32)), H_21 + ktilde_3*H_11]

define eq-36d
  tex: \tilde{k}_1 = \frac{V}{z_{1c} - \chi z_{2c}}, \tilde{k}_2 = \tilde{k}_1 z'_{2c} / V,
    \tilde{k}_3 = \tilde{k}_1 \chi \eta (z_{1c} - z_{2c}) / V
  place: 9901-9983
  ktilde_1 := V/(z_1c - chi*z_2c)
  ktilde_2 := ktilde_1*z'_2c/V
  ktilde_3 := ktilde_1*chi*eta*(z_1c - z_2c)/V

define eq-36e
  tex: H_{ij} = H_{ij}(t_c), (i, j = 1, 2, 3)
  place: 9870-9899
  reads: (i, j = 1, 2, 3) as (i, j = 1, 2, 3, 4)
  note: the range is taken as 1 to 4, since J_c itself uses H_41 and H_42
  H_11 := H(t_c)[1,1]
  H_12 := H(t_c)[1,2]
  H_13 := H(t_c)[1,3]
  H_14 := H(t_c)[1,4]
  H_21 := H(t_c)[2,1]
  H_22 := H(t_c)[2,2]
  H_23 := H(t_c)[2,3]
  H_24 := H(t_c)[2,4]
  H_31 := H(t_c)[3,1]
  H_32 := H(t_c)[3,2]
  H_33 := H(t_c)[3,3]
  H_34 := H(t_c)[3,4]
  H_41 := H(t_c)[4,1]
  H_42 := H(t_c)[4,2]
  H_43 := H(t_c)[4,3]
  H_44 := H(t_c)[4,4]

equation eq-36c
  tex: \begin{pmatrix} x_c \\ y_c \\ v_c \end{pmatrix} = J_c \begin{pmatrix} x_b \\ u_b \end{pmatrix}
  place: 9679-9704
  [x_c; y_c; v_c] = J_c*[x_b; u_b]

equation text-36-cancels
  note: ktilde_1, ktilde_2 and ktilde_3 are V, z'_2c and the third entry over z_1c - chi*z_2c
  J_f*[0; z'_2c; chi*eta*(z_1c - z_2c)] = -J_f*[V; 0; 0]

equation eq-37
  tex: Z(t) = C(t - t_a - dt_a - t_b - dt_b - t_c - dt_c)(Z_c + dZ_c)
  place: 10020-10065
  Z(t) = C(t - t_a - dt_a - t_b - dt_b - t_c - dt_c)*(Z_c + dZ_c)

define eq-38c
  tex: dZ_f = \begin{pmatrix} dz_f \\ dz'_f \end{pmatrix}, dz_f = \begin{pmatrix} x_f \\ y_f \end{pmatrix},
    dz'_f = \begin{pmatrix} 0 \\ v_f \end{pmatrix}
  place: 10270-10315
  dZ_f := [dz_f; dz'_f]
  dz_f := [x_f; y_f]
  dz'_f := [0; v_f]

equation eq-38
  tex: dZ_f = Z(t_a + dt_a + t_b + dt_b + t_c + dt_c + t_d + dt_d) - Z(t_a + t_b + t_c + t_d)
    = C(t_d) dZ_c + C'(t_d) Z_c dt_d
  place: 10182-10269
  reads: Z(t_a + dt_a + t_b + dt_b + t_c + dt_c + t_d + dt_d) - Z(t_a + t_b + t_c + t_d) as
    [C(t_d + dt_d)(Z_c + dZ_c) - C(t_d)Z_c]_{O(x_c, y_c, u_c, v_c, dt_d)^{\le 1}}
  note: the difference is written with (37) and (17), to first order
  dZ_f = first_order(C(t_d + dt_d)*(Z_c + dZ_c) - C(t_d)*Z_c; x_c, y_c, u_c, v_c, dt_d)
    = C(t_d)*dZ_c + C'(t_d)*Z_c*dt_d

equation eq-39
  tex: x'_2(t_a + dt_a + t_b + dt_b + t_c + dt_c + t_d + dt_d) = V
  place: 10356-10398
  x_2'(t_a + dt_a + t_b + dt_b + t_c + dt_c + t_d + dt_d) = V

equation eq-39b
  tex: v_f = 0
  place: 10404-10408
  v_f = 0

define eq-40
  tex: J_f = \begin{pmatrix} 1 + \tilde{k}_4, & -\tilde{k}_4, & \tilde{k}_5 \\
    1 - \tilde{k}_6, & \tilde{k}_6, & \tilde{k}_7 \end{pmatrix}
  place: 10444-10499
  J_f := [1 + ktilde_4, -ktilde_4, ktilde_5; 1 - ktilde_6, ktilde_6, ktilde_7]

define eq-40d
  tex: \tilde{k}_4 = \frac{\sin(\omega t_d)}{V \omega (z_{200} - z_{100})},
    \tilde{k}_5 = \frac{\tilde{k}_4}{\omega} \cot(\omega t_d),
    \tilde{k}_6 = \cos(\omega t_d) - \tilde{k}_4, \tilde{k}_7 = \frac{\sin(\omega t_d)}{\omega} + \tilde{k}_5,
    (\omega^2 = \chi \eta)
  place: 10500-10619
  ktilde_4 := sin(omega*t_d)/(V*omega*(z_200 - z_100))
  ktilde_5 := (ktilde_4/omega)*cot(omega*t_d)
  ktilde_6 := cos(omega*t_d) - ktilde_4
  ktilde_7 := sin(omega*t_d)/omega + ktilde_5
  omega := sqrt(chi*eta)

equation eq-40b
  tex: \begin{pmatrix} x_f \\ y_f \end{pmatrix} = J_f \begin{pmatrix} x_c \\ y_c \\ v_c \end{pmatrix}
  place: 10417-10442
  [x_f; y_f] = J_f*[x_c; y_c; v_c]

define eq-41
  tex: J = J_f J_c J_b J_a
  place: 10715-10728
  J := J_f*J_c*J_b*J_a

define eq-42
  tex: P(\lambda) \equiv \det(J - \lambda I)
  place: 11001-11012
  P(lambda) := det(J - lambda*I)

equation eq-43
  tex: \det(J) = \det(J_f J_c) \det(J_b J_a)
  place: 11033-11055
  det(J) = det(J_f*J_c)*det(J_b*J_a)

equation eq-43b
  tex: \det(J_b J_a) = 0
  place: 11057-11067
  det(J_b*J_a) = 0

equation text-singular
  note: "J is a singular matrix"
  det(J) = 0

equation text-charpoly
  tex: P(\lambda) = \lambda(\lambda - \text{tr}(J))
  place: 11082-11099
  P(lambda) = lambda*(lambda - tr(J))

inequality text-criterion
  tex: |\text{tr}(J) < 1|
  place: 11142-11153
  reads: |\text{tr}(J) < 1| as |\text{tr}(J)| < 1
  -1 < tr(J) < 1
