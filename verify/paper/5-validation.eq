# Numerical validation: the periodicity conditions and the equations made from them, (44)-(46).
section: validation

define eq-44
  tex: N = C(t_d) H(t_c) \Gamma(t_b) D(t_a) = \begin{pmatrix} N_1 & N_2 \\ N_3 & N_4 \end{pmatrix} \quad z'_0 = (V, V)'
  place: 11310-11364
  reads: = \begin{pmatrix} N_1 & N_2 \\ N_3 & N_4 \end{pmatrix} as
    , N_1 = N_{1:2,1:2}, N_2 = N_{1:2,3:4}, N_3 = N_{3:4,1:2}, N_4 = N_{3:4,3:4}
  N := C(t_d)*H(t_c)*Gamma(t_b)*D(t_a)
  N_1 := N[1:2,1:2]
  N_2 := N[1:2,3:4]
  N_3 := N[3:4,1:2]
  N_4 := N[3:4,3:4]
  z'_0 := transpose([V, V])

equation eq-44b
  tex: (N_1 - I)z_0 + N_2 z'_0 = 0
  place: 11270-11289
  (N_1 - I)*z_0 + N_2*z'_0 = 0

equation eq-44c
  tex: N_3 z_0 + (N_4 - I)z'_0 = 0
  place: 11290-11309
  N_3*z_0 + (N_4 - I)*z'_0 = 0

define eq-45b
  tex: M = (N_1 - I)^{-1} N_2 - (N_3)^{-1} (N_4 - I)
  place: 11515-11549
  M := inv(N_1 - I)*N_2 - inv(N_3)*(N_4 - I)

equation eq-45
  tex: M_{11} + M_{12} = 0 \quad M_{21} + M_{22} = 0
  place: 11469-11494
  M[1,1] + M[1,2] = 0
  M[2,1] + M[2,2] = 0

equation text-45-suffices
  note: the right side is zero where (45) holds, since z'_0 = (V, V)'
  N_3*(-inv(N_1 - I)*N_2*z'_0) + (N_4 - I)*z'_0 = -N_3*M*z'_0

# D(t_a) is the last factor of N: in terms of y_0, which is z_a by (12), the left sides of (44) contain t_a in one place.
define text-44-parts
  y_0 := z_0 + t_a*z'_0
  U := C(t_d)*H(t_c)*Gamma(t_b)
  U_1 := U[1:2,1:2]
  U_2 := U[1:2,3:4]
  U_3 := U[3:4,1:2]
  U_4 := U[3:4,3:4]

equation text-44-by-z_a
  note: the left sides of (44) by y_0
  (N_1 - I)*z_0 + N_2*z'_0 = (U_1 - I)*y_0 + U_2*z'_0 + t_a*z'_0
  N_3*z_0 + (N_4 - I)*z'_0 = U_3*y_0 + (U_4 - I)*z'_0

# A stick-slip phase leaves z_1' as it is, so that the third line of (18), with z'_10 = V, is (16).
equation text-16-kept
  z_1'(t_a + t_b + t_c + t_d) = z'_1c

equation text-times-alone
  note: (45), and (12) and (14) with z_0 of (46)
  M[1,1] + M[1,2] = 0
  M[2,1] + M[2,2] = 0
  [1, -chi, 0, 0]*D(t_a)*[-inv(N_1 - I)*N_2*z'_0; z'_0] = e_1
  [-chi, chi, 0, 0]*Gamma(t_b)*D(t_a)*[-inv(N_1 - I)*N_2*z'_0; z'_0] = e_2

equation eq-46
  tex: z_0 = -(N_1 - I)^{-1} N_2 z'_0
  place: 11674-11697
  z_0 = -inv(N_1 - I)*N_2*z'_0
