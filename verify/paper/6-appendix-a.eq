# Appendix A: the matrices H, Gamma, C, (47)-(50).
section: appendix_a

define eq-47
  tex: H = \begin{pmatrix} H_1 & H_2 \\ H_3 & H_1 \end{pmatrix} \quad H_i = \Lambda B_i \Lambda^{-1} \quad (i = 1,2,3) \quad
    \Lambda = \begin{pmatrix} 1 & 1 \\ \lambda_1 & \lambda_2 \end{pmatrix} \quad
    B_1 = \begin{pmatrix} c_1 & 0 \\ 0 & c_2 \end{pmatrix},
    B_2 = \begin{pmatrix} \frac{s_1}{\omega_1} & 0 \\ 0 & \frac{s_2}{\omega_2} \end{pmatrix}, \quad B_3 = B_1' \quad
    c_i = \cos(\omega_i t), \quad s_i = \sin(\omega_i t), \quad (i = 1,2)
  place: 13181-13328
  H(t) := [H_1(t), H_2(t); H_3(t), H_1(t)]
  H_1(t) := Lambda*B_1(t)*inv(Lambda)
  H_2(t) := Lambda*B_2(t)*inv(Lambda)
  H_3(t) := Lambda*B_3(t)*inv(Lambda)
  Lambda := [1, 1; lambda_1, lambda_2]
  B_1(t) := [c_1(t), 0; 0, c_2(t)]
  B_2(t) := [s_1(t)/omega_1, 0; 0, s_2(t)/omega_2]
  B_3(t) := B_1'(t)
  c_1(t) := cos(omega_1*t)
  c_2(t) := cos(omega_2*t)
  s_1(t) := sin(omega_1*t)
  s_2(t) := sin(omega_2*t)

define eq-48
  tex: \det(K - I\omega^2) = 0
  place: 13374-13384
  reads: \omega^2) = 0 as \omega_i^2) = 0, (i = 1, 2)
  note: of the four roots of this quartic the two positive ones are meant, in increasing order
  root omega_1: det(K - I*omega_1^2), smallest positive
  root omega_2: det(K - I*omega_2^2), largest positive

define eq-48d
  tex: \psi_i = \begin{pmatrix} 1 \\ \lambda_i \end{pmatrix}, \quad (i = 1,2)
  place: 13386-13404
  psi_1 := [1; lambda_1]
  psi_2 := [1; lambda_2]

define text-mode-shapes
  equation: 48
  note: lambda_i from the first row of (K - I omega_i^2) psi_i = 0; the second row is claim eq-48c
  lambda_1 := (1 - omega_1^2)/chi
  lambda_2 := (1 - omega_2^2)/chi

equation eq-48c
  tex: (K - I\omega_i^2)\psi_i = 0
  place: 13405-13419
  reads: \psi_i = 0 as \psi_i = 0, (i = 1, 2)
  (K - I*omega_1^2)*psi_1 = 0
  (K - I*omega_2^2)*psi_2 = 0

define eq-49
  tex: \Gamma = \begin{pmatrix} \Gamma_1 & \Gamma_2 \\ \Gamma_3 & \Gamma_1 \end{pmatrix}, \quad
    \Gamma_i = \Sigma \gamma_i \Sigma^{-1}, \quad (i = 1,2,3) \quad
    \Sigma = \begin{pmatrix} 1 & \mathcal{X} \\ 0 & 1 \end{pmatrix}, \quad
    \gamma_1 = \begin{pmatrix} \cos t & 0 \\ 0 & 1 \end{pmatrix},
    \gamma_2 = \begin{pmatrix} \sin t & 0 \\ 0 & t \end{pmatrix}, \quad \gamma_3 = \gamma_1'
  place: 13421-13517
  reads: \mathcal{X} as \chi
  note: \mathcal{X} is the only letter of that shape in the nomenclature, chi
  Gamma(t) := [Gamma_1(t), Gamma_2(t); Gamma_3(t), Gamma_1(t)]
  Gamma_1(t) := Sigma*gamma_1(t)*inv(Sigma)
  Gamma_2(t) := Sigma*gamma_2(t)*inv(Sigma)
  Gamma_3(t) := Sigma*gamma_3(t)*inv(Sigma)
  Sigma := [1, chi; 0, 1]
  gamma_1(t) := [cos(t), 0; 0, 1]
  gamma_2(t) := [sin(t), 0; 0, t]
  gamma_3(t) := gamma_1'(t)

define eq-50
  tex: C = \begin{pmatrix} C_1 & C_2 \\ C_3 & C_1 \end{pmatrix}, \quad C_i = \Pi A_i \Pi^{-1} \quad (i = 1, 2, 3), \quad
    \Pi = \begin{pmatrix} 1 & 0 \\ 1 & 1 \end{pmatrix} \quad
    A_1 = \begin{pmatrix} 1 & 0 \\ 0 & \cos(\omega t) \end{pmatrix}, \quad
    A_2 = \begin{pmatrix} t & 0 \\ 0 & \frac{\sin(\omega t)}{\omega} \end{pmatrix}, \quad
    A_3 = A_1', \quad \omega^2 = \chi \eta
  place: 13518-13629
  C(t) := [C_1(t), C_2(t); C_3(t), C_1(t)]
  C_1(t) := Pi*A_1(t)*inv(Pi)
  C_2(t) := Pi*A_2(t)*inv(Pi)
  C_3(t) := Pi*A_3(t)*inv(Pi)
  Pi := [1, 0; 1, 1]
  A_1(t) := [1, 0; 0, cos(omega*t)]
  A_2(t) := [t, 0; 0, sin(omega*t)/omega]
  A_3(t) := A_1'(t)
  omega := sqrt(chi*eta)
