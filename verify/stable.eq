# Forms that keep their digits where double precision loses those of the printed ones, an overlay on paper/ and errata.eq.
# A definition here equals the corrected one of its name wherever that has a value (include/stickslip/stable.h proves it); a
# name that is not the paper's is a part of others.  "replaces" says what loses digits where.

define stable-omega
  section: appendix_a
  equation: 50
  note: the product underflows where the frequency does not
  omega := sqrt(chi)*sqrt(eta)

define stable-omega-40
  section: stability
  equation: 40
  note: as in appendix A
  omega := sqrt(chi)*sqrt(eta)

define stable-48
  section: appendix_a
  equation: 48
  tex: \omega_2 \pm \omega_1 = \sqrt{(\omega \pm \sqrt{1 - \chi})^2 + \chi}
  note: the coefficients of the polynomial hold half the digits of roots that are close to each other (chi -> 0, chi*eta -> 1)
  slip_s := sqrt(1 - chi)
  omega_p := hypot(omega + slip_s, sqrt(chi))
  omega_m := hypot(omega - slip_s, sqrt(chi))
  omega_2 := (omega_p + omega_m)/2
  omega_1 := omega*(slip_s/omega_2)

define stable-48b
  section: appendix_a
  equation: 48
  tex: \lambda_1 = \frac{g_1}{\chi}, \lambda_2 = -\frac{\omega^2}{g_1}, g_1 = 1 - \omega_1^2, g_2 = \omega_2^2 - 1
  note: 1 - omega_1^2 and omega_2^2 - 1 cancel where a frequency is near 1; here every term is positive
  bend := (chi/2)*(1/(omega_p + (omega + slip_s)) + 1/(omega_m + abs(slip_s - omega)))
  g_1 := ((abs(slip_s - omega) + (slip_s - omega))/2 + bend)*(omega_2 + omega)
  g_2 := chi*(omega/g_1)*omega
  lambda_1 := g_1/chi
  lambda_2 := -(omega/g_1)*omega

define stable-47
  section: appendix_a
  equation: 47
  tex: H_1 = \begin{pmatrix} \alpha c_1 + \beta c_2 & \chi X \\ \omega^2 X & \beta c_1 + \alpha c_2 \end{pmatrix},
    X = \frac{c_1 - c_2}{\omega_2^2 - \omega_1^2}, W = X', Y' = X
  note: the inverse of Lambda divides by lambda_2 - lambda_1.  Each entry is the sum of two forms of itself: in the half sum
    and difference of the frequencies, for close ones, and in the frequencies, for distant ones.  Their weights are rho and
    apart = 1 - rho, the square of detune = 1 - omega_1^2/omega_2^2.  Y is in turn the sum of a form for small times and one for large ones
  alpha := g_2/(g_2 + g_1)
  beta := g_1/(g_2 + g_1)
  skew := (g_2 - g_1)/(g_2 + g_1)
  detune := omega_p*omega_m/(omega_1^2 + omega_p*omega_m)
  rho := (omega_1^2/(omega_1^2 + omega_p*omega_m))*(1 + detune)
  apart := detune^2
  sin_cos(t) := sin(omega_p*t/2)*cos(omega_m*t/2)
  cos_sin(t) := cos(omega_p*t/2)*sin(omega_m*t/2)
  cos_cos(t) := cos(omega_p*t/2)*cos(omega_m*t/2)
  sin_sin(t) := sin(omega_p*t/2)*sin(omega_m*t/2)
  versed(t) := 2*sin(t/2)^2
  lag(t) := t*(t*stumpff(t))
  early(t) := (1/hypot(1, t))^2
  late(t) := 1 - early(t)
  near_X(t) := sinc(omega_p*t/2)*(t*sinc(omega_m*t/2))
  near_W(t) := cos(omega_p*t/2)*sinc(omega_m*t/2) + sinc(omega_p*t/2)*cos(omega_m*t/2)
  near_Y_early(t) := versed(omega_p*t/2) - lag(omega_p*t/2) - (versed(omega_m*t/2) - lag(omega_m*t/2))
    + lag(omega_p*t/2)*versed(omega_m*t/2) - versed(omega_p*t/2)*lag(omega_m*t/2)
  near_Y_late(t) := sinc(omega_p*t/2)*cos(omega_m*t/2) - cos(omega_p*t/2)*sinc(omega_m*t/2)
  near_Y(t) := early(omega_p*t/2)*near_Y_early(t) + late(omega_p*t/2)*near_Y_late(t)
  far_X(t) := 2*(sin(omega_2*t/2)^2 - sin(omega_1*t/2)^2)
  far_Y(t) := early(omega_2*t)*(lag(omega_2*t) - lag(omega_1*t)) + late(omega_2*t)*(sinc(omega_1*t) - sinc(omega_2*t))
  diff_X(t) := rho*(t*near_X(t))/2 + detune*far_X(t)/omega_2^2
  diff_W(t) := rho*(t*near_W(t))/2 + detune*(sin(omega_2*t) - (omega_1/omega_2)*sin(omega_1*t))/omega_2
  diff_Y(t) := t*(rho*near_Y(t)/(2*omega*slip_s) + detune*far_Y(t)/omega_2^2)
  scaled_X(t) := rho*((omega*t)*(omega*near_X(t)))/2 + detune*((omega/omega_2)^2*far_X(t))
  scaled_Y(t) := t*(rho*(omega*near_Y(t))/(2*slip_s) + detune*((omega/omega_2)^2*far_Y(t)))
  near_11(t) := cos_cos(t) + skew*sin_sin(t)
  near_22(t) := cos_cos(t) - skew*sin_sin(t)
  far_11(t) := alpha*cos(omega_1*t) + beta*cos(omega_2*t)
  far_22(t) := beta*cos(omega_1*t) + alpha*cos(omega_2*t)
  spread := omega_m/(4*omega_1)
  near_13(t) := sinc(omega_p*t/2)*cos(omega_m*t/2) + spread*(((omega_m + skew*omega_p)/omega_2)*near_Y_late(t))
  near_24(t) := sinc(omega_p*t/2)*cos(omega_m*t/2) + spread*(((omega_m - skew*omega_p)/omega_2)*near_Y_late(t))
  H_1(t) := [near_11(t) + apart*(far_11(t) - near_11(t)), chi*diff_X(t);
             scaled_X(t), near_22(t) + apart*(far_22(t) - near_22(t))]
  H_2(t) := [t*(rho*near_13(t) + apart*(alpha*sinc(omega_1*t) + beta*sinc(omega_2*t))), chi*diff_Y(t);
             scaled_Y(t), t*(rho*near_24(t) + apart*(beta*sinc(omega_1*t) + alpha*sinc(omega_2*t)))]
  H_3(t) := [-(rho*((omega_p - skew*omega_m)*sin_cos(t) + (omega_m - skew*omega_p)*cos_sin(t))/2
               + apart*(alpha*(omega_1*sin(omega_1*t)) + beta*(omega_2*sin(omega_2*t)))),
             chi*diff_W(t);
             omega*(omega*diff_W(t)),
             -(rho*((omega_p + skew*omega_m)*sin_cos(t) + (omega_m + skew*omega_p)*cos_sin(t))/2
               + apart*(beta*(omega_1*sin(omega_1*t)) + alpha*(omega_2*sin(omega_2*t))))]

define stable-49
  section: appendix_a
  equation: 49
  tex: 1 - \cos t = 2 \sin^2 \frac{t}{2}, t - \sin t
  note: 1 - cos t and t - sin t cancel at small times
  Gamma_1(t) := [cos(t), chi*(2*sin(t/2)^2); 0, 1]
  Gamma_2(t) := [sin(t), chi*(t^3*stumpff(t)); 0, t]
  Gamma_3(t) := [-sin(t), chi*sin(t); 0, 0]

define stable-50
  section: appendix_a
  equation: 50
  note: as in (49)
  C_1(t) := [1, 0; 2*sin(omega*t/2)^2, cos(omega*t)]
  C_2(t) := [t, 0; t*((omega*t)^2*stumpff(omega*t)), t*sinc(omega*t)]
  C_3(t) := [0, 0; omega*sin(omega*t), -omega*sin(omega*t)]

define stable-32
  section: stability
  equation: 32
  note: chi_b overflows where V is far below z'_1b, and the coefficients do not
  gammatilde_1 := (chi*V - z'_1b)/(V - z'_1b)
  gammatilde_2 := (chi*z_2b - z_1b)*((chi - 1)/(V - z'_1b))

define stable-36
  section: stability
  equation: 36
  tex: H_{11} + H_{12}, H_{21} + H_{22} = c_1 + \omega_1^2 X, H_{31} + H_{32}, H_{41} + H_{42} = -(1 - \chi) \omega^2 Y
  note: the sums of two entries cancel at small t_c (the last one) and large omega_2 t_c; they are the motion from z_1 = z_2
  g_3 := chi*(1 - chi)/(g_2 + chi)
  alpha_c := (g_2 + chi)/(g_2 + chi + g_3)
  beta_c := g_3/(g_2 + chi + g_3)
  skew_c := (g_2 + chi - g_3)/(g_2 + chi + g_3)
  near_sum(t) := cos_cos(t) + skew_c*sin_sin(t)
  far_sum(t) := alpha_c*cos(omega_1*t) + beta_c*cos(omega_2*t)
  sum_1 := near_sum(t_c) + apart*(far_sum(t_c) - near_sum(t_c))
  sum_2 := cos(omega_1*t_c) + omega_1^2*diff_X(t_c)
  sum_3 := -(rho*((omega_p - skew_c*omega_m)*sin_cos(t_c) + (omega_m - skew_c*omega_p)*cos_sin(t_c))/2
    + apart*(alpha_c*(omega_1*sin(omega_1*t_c)) + beta_c*(omega_2*sin(omega_2*t_c))))
  sum_4 := -(1 - chi)*scaled_Y(t_c)
  ktilde_2 := z'_2c/(z_1c - chi*z_2c)
  ktilde_3 := omega*(omega*((z_1c - z_2c)/(z_1c - chi*z_2c)))
  J_c := [sum_1 + ktilde_1*sum_3, H_13 + ktilde_1*H_11;
          sum_2 + ktilde_2*sum_3, H_23 + ktilde_2*H_11;
          sum_4 + ktilde_3*sum_3, H_21 + ktilde_3*H_11]

define stable-40
  section: stability
  equation: 40
  note: 1 - cos(omega t_d) cancels at small t_d; sin and cot of one angle are taken together
  ktilde_4 := (V/(z_200 - z_100))*(t_d*sinc(omega*t_d))
  ktilde_5 := ((V/(z_200 - z_100))*cos(omega*t_d)/omega)/omega
  ktilde_7 := t_d*sinc(omega*t_d) + ktilde_5
  J_f := [1 + ktilde_4, -ktilde_4, ktilde_5; 2*sin(omega*t_d/2)^2 + ktilde_4, ktilde_6, ktilde_7]

define stable-trace
  section: stability
  tex: \text{tr}(J) = \frac{\cos(\omega t_d) (y_c - x_c) + \frac{\sin(\omega t_d)}{\omega} v_c}{1 - \chi}
  note: J_f's rows differ by far less than they are where z_200 - z_100 is small
  ktilde_21 := ktilde_1*((z'_2c - V)/V)
  turn := ((1 - chi)*diff_X(t_c) + ktilde_21*sum_3)*J_b[1] + (H_23 - H_13 + ktilde_21*H_11)*J_b[2]
  rate := (sum_4 + ktilde_3*sum_3)*J_b[1] + (H_21 + ktilde_3*H_11)*J_b[2]
  trace_J := (cos(omega*t_d)*turn + t_d*sinc(omega*t_d)*rate)/(1 - chi)

inequality text-criterion
  section: stability
  note: the trace as one number, not as a sum of two entries
  -1 < trace_J < 1
