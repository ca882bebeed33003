# Forms that keep their digits where double precision loses those of the printed ones, an overlay on paper/ and errata.eq.
# A definition here equals the corrected one of its name wherever both have a value (src/proof/stable_forms.h proves it, and
# tries at points that they have one together); a name that is not the paper's is a part of others.  "replaces" says what loses
# digits where.  Where the terms of a result cancel as the point has it, and not by its form, no form keeps the digits:
# rounded() computes it as precisely as it takes.

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
  note: the coefficients of the polynomial hold half the digits of roots that are close to each other (chi -> 0, chi*eta -> 1)
  slip_s := sqrt(1 - chi)
  omega_p := hypot(omega + slip_s, sqrt(chi))
  omega_m := hypot(omega - slip_s, sqrt(chi))
  omega_2 := (omega_p + omega_m)/2
  omega_1 := omega*(slip_s/omega_2)

define stable-48b
  section: appendix_a
  note: 1 - omega_1^2 and omega_2^2 - 1 cancel where a frequency is near 1; here every term is positive
  bend := (chi/2)*(1/(omega_p + (omega + slip_s)) + 1/(omega_m + abs(slip_s - omega)))
  g_1 := ((abs(slip_s - omega) + (slip_s - omega))/2 + bend)*(omega_2 + omega)
  g_2 := chi*(omega/g_1)*omega
  lambda_1 := g_1/chi
  lambda_2 := -(omega/g_1)*omega

define stable-47
  section: appendix_a
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
  late(t) := (t/hypot(1, t))^2
  soft := early(omega)
  stiff := late(omega)
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
  diff_V(t) := rho*(cos_cos(t) - ((omega_1^2 + omega_2^2)/omega_p)*(sin(omega_p*t/2)*(t*sinc(omega_m*t/2)))/2)
    + detune*(cos(omega_2*t) - (omega_1/omega_2)^2*cos(omega_1*t))
  diff_Y(t) := t*(rho*near_Y(t)/(2*omega*slip_s) + detune*far_Y(t)/omega_2^2)
  scaled_W(t) := omega*(omega*diff_W(t))
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
             scaled_W(t),
             -(rho*((omega_p + skew*omega_m)*sin_cos(t) + (omega_m + skew*omega_p)*cos_sin(t))/2
               + apart*(beta*(omega_1*sin(omega_1*t)) + alpha*(omega_2*sin(omega_2*t))))]

define stable-47-bend
  section: appendix_a
  equals: -K*H_1(t)
  near_bend_11(t) := cos_cos(t) - ((omega_p*omega_m - skew*(omega_1^2 + omega_2^2))/2)*sin_sin(t)
  near_bend_22(t) := omega*omega*cos_cos(t) - ((omega_p*omega_m + skew*(omega_1^2 + omega_2^2))/2)*sin_sin(t)
  far_bend_11(t) := alpha*(omega_1^2*cos(omega_1*t)) + beta*(omega_2^2*cos(omega_2*t))
  far_bend_22(t) := beta*(omega_1^2*cos(omega_1*t)) + alpha*(omega_2^2*cos(omega_2*t))
  bend_H(t) := [-(rho*near_bend_11(t) + apart*far_bend_11(t)), chi*diff_V(t);
                omega*(omega*diff_V(t)), -(rho*near_bend_22(t) + apart*far_bend_22(t))]

define stable-47-less
  section: appendix_a
  equals: H_1(t) - [1, 0; 0, 1]
  note: 1 is taken off before the sum is formed: both terms of an entry have one sign
  near_less_11(t) := skew*sin_sin(t) - (versed(omega_p*t/2) + versed(omega_m*t/2)*cos(omega_p*t/2))
  near_less_22(t) := -(skew*sin_sin(t) + (versed(omega_p*t/2) + versed(omega_m*t/2)*cos(omega_p*t/2)))
  less_H(t) := [rho*near_less_11(t) - apart*(alpha*versed(omega_1*t) + beta*versed(omega_2*t)), chi*diff_X(t);
                scaled_X(t), rho*near_less_22(t) - apart*(beta*versed(omega_1*t) + alpha*versed(omega_2*t))]

define stable-49
  section: appendix_a
  note: 1 - cos t and t - sin t cancel at small times
  Gamma_1(t) := [cos(t), chi*(2*sin(t/2)^2); 0, 1]
  Gamma_2(t) := [sin(t), chi*(t^3*stumpff(t)); 0, t]
  Gamma_3(t) := [-sin(t), chi*sin(t); 0, 0]

define stable-50
  section: appendix_a
  note: as in (49)
  C_1(t) := [1, 0; 2*sin(omega*t/2)^2, cos(omega*t)]
  C_2(t) := [t, 0; t*((omega*t)^2*stumpff(omega*t)), t*sinc(omega*t)]
  C_3(t) := [0, 0; omega*sin(omega*t), -omega*sin(omega*t)]

define stable-49-less
  section: appendix_a
  equals: Gamma_1(t) - [1, 0; 0, 1]
  less_Gamma(t) := [-versed(t), chi*versed(t); 0, 0]

define stable-50-less
  section: appendix_a
  equals: C_1(t) - [1, 0; 0, 1]
  less_C(t) := [0, 0; versed(omega*t), -versed(omega*t)]

define stable-44
  section: validation
  note: the blocks of H Gamma, and of those without the 1 of the identity; at some times the three motions cancel in an entry of N
  N := rounded(C(t_d)*H(t_c)*Gamma(t_b)*D(t_a))
  G_1 := H_1(t_c)*Gamma_1(t_b) + H_2(t_c)*Gamma_3(t_b)
  G_2 := H_1(t_c)*Gamma_2(t_b) + H_2(t_c)*Gamma_1(t_b)
  G_3 := H_3(t_c)*Gamma_1(t_b) + H_1(t_c)*Gamma_3(t_b)
  G_4 := H_3(t_c)*Gamma_2(t_b) + H_1(t_c)*Gamma_1(t_b)
  less_G_1 := less_H(t_c)*Gamma_1(t_b) + less_Gamma(t_b) + H_2(t_c)*Gamma_3(t_b)
  less_G_4 := less_H(t_c)*Gamma_1(t_b) + less_Gamma(t_b) + H_3(t_c)*Gamma_2(t_b)
  N_3 := C_3(t_d)*G_1 + C_1(t_d)*G_3

define stable-44-less-1
  section: validation
  equals: N_1 - I
  note: C H Gamma - I = (C - I) H Gamma + (H - I) Gamma + (Gamma - I), in blocks; near I nothing cancels
  less_N_1 := less_C(t_d)*G_1 + C_2(t_d)*G_3 + less_G_1

define stable-44-rest-2
  section: validation
  equals: N_2 - t_a*(N_1 - I)
  note: (N_1 - I)^{-1} N_2 = t_a I + (N_1 - I)^{-1} rest_2
  rest_2 := t_a*I + C_1(t_d)*G_2 + C_2(t_d)*G_4

define stable-44-rest-4
  section: validation
  equals: N_4 - I - t_a*N_3
  note: (N_3)^{-1} (N_4 - I) = t_a I + (N_3)^{-1} rest_4
  rest_4 := C_3(t_d)*G_2 + less_C(t_d)*G_4 + less_G_4

define stable-47-force
  section: appendix_a
  note: the motions from rest under a unit force on the first mass, (push_1, push_2), and under omega^2 on the second, (pull_1,
    pull_2); (creep_1, creep_2) under a force t on the first
  push_1(t) := t*(t*(alpha*sinc(omega_1*t/2)^2 + beta*sinc(omega_2*t/2)^2))/2
  push_2(t) := (sinc(omega_1*t/2) + sinc(omega_2*t/2))*(t*scaled_Y(t/2))
  push(t) := [push_1(t); push_2(t)]
  pull(t) := [chi*push_2(t); (omega*t)^2*(beta*sinc(omega_1*t/2)^2 + alpha*sinc(omega_2*t/2)^2)/2]
  pull_rate(t) := [chi*scaled_Y(t); omega*(omega*H_2(t)[2,2])]
  creep_1(t) := t^3*(alpha*stumpff(omega_1*t) + beta*stumpff(omega_2*t))
  creep(t) := [creep_1(t); creep_1(t) - diff_Y(t)]

define stable-47-push
  section: validation
  equals: inv(K)*([1; 0] - H_1(t_c)*[1; 0])
  push_c := push(t_c)

define stable-47-pull
  section: validation
  equals: chi*eta*(inv(K)*([0; 1] - H_1(t_c)*[0; 1]))
  pull_c := pull(t_c)

define stable-44-parts
  section: validation
  note: what becomes of z_1 = z_2 = 1 at rest, and (later) of z'_1 = z'_2 = 1, at the end of the global slip phase
  lag_b := t_b^3*stumpff(t_b)
  even_c := push_c + H_1(t_c)*[versed(t_b); 0] + H_2(t_c)*[sin(t_b); 0]
  even'_c := H_2(t_c)*[1; 0] + H_3(t_c)*[versed(t_b); 0] + H_1(t_c)*[sin(t_b); 0]
  come_b := sin(t_b) + chi*lag_b
  later_c := come_b*push_c + creep(t_c) + lag_b*[1 - H_12; -less_H(t_c)[2,2]] + versed(t_b)*(H_2(t_c)*[1; 0])
  later'_c := [versed(t_b) + sin(t_b)*H_2(t_c)[1,1] + cos(t_b)*push_c[1] + chi*(lag_b*scaled_Y(t_c) + versed(t_b)*push_c[2]);
               sin(t_b)*scaled_Y(t_c) + cos(t_b)*push_c[2] + lag_b*pull_rate(t_c)[2] + versed(t_b)*pull_c[2]]

define stable-44-even-1
  section: validation
  equals: (I - N_1)*[1; 1]/(1 - chi)
  note: the columns of N_1 - I, of N_3 and of N_4 - I have sums with the factor 1 - chi
  even_1 := C_1(t_d)*even_c + C_2(t_d)*even'_c

define stable-44-even-3
  section: validation
  equals: -(N_3*[1; 1])/(1 - chi)
  even_3 := C_3(t_d)*even_c + C_1(t_d)*even'_c

define stable-44-even-2
  section: validation
  equals: ((t_a + t_b + t_c + t_d)*[1; 1] - (N_2 - t_a*(N_1 - I))*[1; 1])/(1 - chi)
  even_2 := C_1(t_d)*later_c + C_2(t_d)*later'_c

define stable-44-even-4
  section: validation
  equals: -((N_4 - I - t_a*N_3)*[1; 1])/(1 - chi)
  even_4 := C_3(t_d)*later_c + C_1(t_d)*later'_c

define stable-44-slack-1
  section: validation
  equals: (I - N_1)*[chi; 1]/(1 - chi)
  note: z = (chi, 1) at rest is the equilibrium of the first mass, which Gamma keeps
  slack_1 := C_1(t_d)*pull_c + C_2(t_d)*pull_rate(t_c) + less_C(t_d)*[1; 0]

define stable-44-slack-3
  section: validation
  equals: -(N_3*[chi; 1])/(1 - chi)
  slack_3 := C_3(t_d)*pull_c + C_1(t_d)*pull_rate(t_c) + C_3(t_d)*[1; 0]

define stable-44-lean
  section: validation
  note: first mass before second, of the motions of the first mass alone and of those above
  lean_3 := H_3(t_c)[1,1] - H_3(t_c)[2,1]
  even_gap := diff_X(t_c) + diff_V(t_c)*versed(t_b) + diff_W(t_c)*sin(t_b)
  even'_gap := diff_W(t_c) + lean_3*versed(t_b) + diff_V(t_c)*sin(t_b)
  later_gap := sin(t_b)*diff_X(t_c) + cos(t_b)*diff_Y(t_c) + lag_b*H_1(t_c)[2,2] + versed(t_b)*H_2(t_c)[2,2]
  later'_gap := sin(t_b)*diff_W(t_c) + cos(t_b)*diff_X(t_c) + lag_b*H_3(t_c)[2,2] + versed(t_b)*H_1(t_c)[2,2]
  pull_gap := -less_H(t_c)[2,2]
  pull'_gap := -H_3(t_c)[2,2]

define stable-44-edge-1
  section: validation
  equals: [1, -1]*(I - N_1)*[1; 1]/(1 - chi)
  note: while the second mass sticks its distance from the first turns by itself
  edge_1 := C_1(t_d)[2,2]*even_gap + C_2(t_d)[2,2]*even'_gap

define stable-44-edge-2
  section: validation
  equals: [-1, 1]*(N_2 - t_a*(N_1 - I))*[1; 1]/(1 - chi)
  edge_2 := C_1(t_d)[2,2]*later_gap + C_2(t_d)[2,2]*later'_gap

define stable-44-edge-3
  section: validation
  equals: [-1, 1]*N_3*[1; 1]/(1 - chi)
  edge_3 := C_1(t_d)[2,2]*even'_gap - C_3(t_d)[2,1]*even_gap

define stable-44-edge-4
  section: validation
  equals: [-1, 1]*(N_4 - I - t_a*N_3)*[1; 1]/(1 - chi)
  edge_4 := C_1(t_d)[2,2]*later'_gap - C_3(t_d)[2,1]*later_gap

define stable-44-gap-1
  section: validation
  equals: [-1, 1]*(I - N_1)*[chi; 1]/(1 - chi)
  gap_1 := C_1(t_d)[2,1] + C_1(t_d)[2,2]*pull_gap + C_2(t_d)[2,2]*pull'_gap

define stable-44-gap-3
  section: validation
  equals: [1, -1]*N_3*[chi; 1]/(1 - chi)
  gap_3 := C_3(t_d)[2,1]*(1 - pull_gap) + C_1(t_d)[2,2]*pull'_gap

define stable-44-go
  section: validation
  equals: [1, 0]*(N_2 - t_a*(N_1 - I))*[1; 1]
  note: how far the first mass comes from z = 0, z' = 1, from the motions of both masses together
  go_1 := t_a + sin(t_b)*sum_1 + cos(t_b)*reach_1 + chi*(lag_b*sum_2 + versed(t_b)*reach_2)
    + t_d*(sin(t_b)*sum_3 + cos(t_b)*sum_1 + chi*(lag_b*sum_4 + versed(t_b)*sum_2))

define stable-44-slip
  section: validation
  equals: [1, -chi]*(N_2 - t_a*(N_1 - I))*[1; 1]/(1 - chi)
  note: z_1 - chi z_2, which stays bounded where z_1 and z_2 drift away together (chi -> 1, omega -> 0); where omega is large
    their distance is small instead
  later_slip := H_1(t_c)[1,1]*sin(t_b) + H_2(t_c)[1,1]*cos(t_b) + chi*(scaled_X(t_c)*lag_b + scaled_Y(t_c)*versed(t_b))
  later'_slip := H_3(t_c)[1,1]*sin(t_b) + H_1(t_c)[1,1]*cos(t_b)
    + chi*(scaled_W(t_c)*lag_b + scaled_X(t_c)*versed(t_b))
  soft_slip := t_a + later_slip + t_d*later'_slip + chi*(C_1(t_d)[2,1]*later_gap + C_2(t_d)[2,1]*later'_gap)
  slip_2 := soft*soft_slip + stiff*(go_1 - chi*edge_2)

define stable-44-drift
  section: validation
  equals: [1, -chi]*(I - N_1)*[chi; 1]/(1 - chi)
  soft_drift := -chi*(scaled_X(t_c) + t_d*scaled_W(t_c) + C_1(t_d)[2,1]*H_1(t_c)[2,2] + C_2(t_d)[2,1]*H_3(t_c)[2,2])
  drift_1 := soft*soft_drift + stiff*((1 - chi)*slack_1[1] - chi*gap_1)

define stable-45
  section: validation
  note: by the images of (1, 1) and (chi, 1), so that the determinants are formed without their factor 1 - chi, and by
    the first mass and the distance of the second, each of size 1; t_a I stands in both terms of M and is left out
  even_size_1 := hypot(even_1[1], edge_1)
  gap_size_1 := hypot(gap_1, slack_1[1])
  det_1 := (gap_1/gap_size_1)*(even_1[1]/even_size_1) + (slack_1[1]/gap_size_1)*(edge_1/even_size_1)
  even_size_3 := hypot(even_3[1], edge_3)
  gap_size_3 := hypot(gap_3, slack_3[1])
  det_3 := (gap_3/gap_size_3)*(even_3[1]/even_size_3) + (slack_3[1]/gap_size_3)*(edge_3/even_size_3)
  adjugate_1 := [less_N_1[2,2], -less_N_1[1,2]; -less_N_1[2,1], less_N_1[1,1]]/even_size_1
  adjugate_3 := [N_3[2,2], -N_3[1,2]; -N_3[2,1], N_3[1,1]]/even_size_3
  M := rounded((adjugate_1*(rest_2/gap_size_1)/det_1 - adjugate_3*(rest_4/gap_size_3)/det_3)/(1 - chi))

define stable-46-rate
  section: validation
  equals: [-1, 1]*inv(N_3)*(N_4 - I)*[1; 1]/(1 - chi)
  note: by the second mass where it lags far behind the first, by their distance where it keeps up
  near_3 := edge_3/even_size_3
  far_3 := even_3[2]/even_size_3
  rate_near := even_4[1]*near_3 - edge_4*(even_3[1]/even_size_3)
  rate_far := even_4[2]*(even_3[1]/even_size_3) - even_4[1]*far_3
  rate_r := (((far_3^2*rate_near + near_3^2*rate_far)/(far_3^2 + near_3^2))/gap_size_3)/det_3

define stable-46
  section: validation
  note: z_0 + t_a z'_0 = (V/(1 - chi)) ((chi, 1) share_r + (1, 1) share_w)
  share_r := ((go_1*(edge_1/even_size_1) + (1 - chi)*(edge_2*(even_1[1]/even_size_1)))/gap_size_1)/det_1
  share_w := (((gap_1/gap_size_1)*slip_2 - (drift_1/gap_size_1)*edge_2)/even_size_1)/det_1
  rate_w := (((gap_3/gap_size_3)*even_4[1] + (slack_3[1]/gap_size_3)*edge_4)/even_size_3)/det_3

define stable-32
  section: stability
  note: chi_b overflows where V is far below z'_1b, and the coefficients do not
  gammatilde_1 := (chi*V - z'_1b)/(V - z'_1b)
  gammatilde_2 := (chi*z_2b - z_1b)*((chi - 1)/(V - z'_1b))

define stable-36
  section: stability
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

define stable-47-together
  section: stability
  note: H_13 + H_14 and H_23 + H_24, the motion from z'_1 = z'_2
  near_reach(t) := sinc(omega_p*t/2)*cos(omega_m*t/2) + spread*(((omega_m + skew_c*omega_p)/omega_2)*near_Y_late(t))
  reach_1 := t_c*(rho*near_reach(t_c) + apart*(alpha_c*sinc(omega_1*t_c) + beta_c*sinc(omega_2*t_c)))
  reach_2 := t_c*sinc(omega_1*t_c) + omega_1^2*diff_Y(t_c)

define stable-patched-1
  section: periodic
  equals: S_a[1] - chi*S_a[2]
  note: V t_a drops out of the difference as chi -> 1
  w_a := (z_10 - chi*z_20) + (1 - chi)*(V*t_a)

define stable-patched-2
  section: periodic
  equals: S_b[2] - S_b[1]
  note: the masses' difference is small where V t_a is not
  r_b := (1 - chi)*(versed(t_b)*(z_10 + V*t_a) + V*lag_b) + (z_20 - z_10)*(1 - chi*versed(t_b))

define stable-patched-3
  section: periodic
  equals: V - S_b[3]
  slow_b := (1 - chi)*(V*versed(t_b)) + sin(t_b)*w_a

define stable-patched
  section: periodic
  note: the common motion, then the difference of the masses
  S_b := [cos(t_b)*(z_10 + V*t_a) + chi*(versed(t_b)*(z_20 + V*t_a)) + V*sin(t_b) + chi*(V*lag_b);
          z_20 + V*(t_a + t_b); V*(cos(t_b) + chi*versed(t_b)) - sin(t_b)*w_a; V]
  S_c := [S_b[1]*sum_1 + V*reach_1 + r_b*H_12 - slow_b*H_13;
          S_b[2]*sum_2 + V*reach_2 - r_b*H_21 - slow_b*H_23;
          S_b[1]*sum_3 + V*sum_1 + r_b*H_32 - slow_b*H_11;
          S_b[2]*sum_4 + V*sum_2 - r_b*H_41 - slow_b*H_21]

define stable-patched-4
  section: periodic
  equals: S_c[2] - S_c[1]
  r_c := (1 - chi)*(S_b[2]*diff_X(t_c) + V*diff_Y(t_c)) + r_b*diff_V(t_c) + slow_b*diff_W(t_c)

define stable-patched-5
  section: periodic
  S_f := [S_c[1] + t_d*S_c[3]; C_1(t_d)[2,1:2]*S_c[1:2,1] + C_2(t_d)[2,1:2]*S_c[3:4,1];
          S_c[3]; C_1(t_d)[2,1:2]*S_c[3:4,1] - C_3(t_d)[2,1]*r_c]

define stable-40
  section: stability
  note: 1 - cos(omega t_d) cancels at small t_d; sin and cot of one angle are taken together
  ktilde_4 := (V/(z_200 - z_100))*(t_d*sinc(omega*t_d))
  ktilde_5 := ((V/(z_200 - z_100))*cos(omega*t_d)/omega)/omega
  ktilde_7 := t_d*sinc(omega*t_d) + ktilde_5
  J_f := [1 + ktilde_4, -ktilde_4, ktilde_5; 2*sin(omega*t_d/2)^2 + ktilde_4, ktilde_6, ktilde_7]

define stable-41-turn
  section: stability
  equals: [-1, 1, 0]*J_c*J_b
  note: y_c - x_c, for which J_c's rows differ by far less than they are
  ktilde_21 := (z'_2c - V)/(z_1c - chi*z_2c)
  turn := ((1 - chi)*diff_X(t_c) + ktilde_21*sum_3)*J_b[1] + (ktilde_21*H_11 - diff_W(t_c))*J_b[2]

define stable-41-rate
  section: stability
  equals: [0, 0, 1]*J_c*J_b
  rate := (sum_4 + ktilde_3*sum_3)*J_b[1] + (H_21 + ktilde_3*H_11)*J_b[2]

define stable-trace
  section: stability
  equals: tr(J)
  note: J_f's rows differ by far less than they are where z_200 - z_100 is small
  trace_J := (cos(omega*t_d)*turn + t_d*sinc(omega*t_d)*rate)/(1 - chi)

define stable-41
  section: stability
  note: y_c - x_c is formed once
  climb := J_c[1:2,1:2]*J_b
  J := [climb[1] - ktilde_4*turn + ktilde_5*rate;
        versed(omega*t_d)*climb[1] + cos(omega*t_d)*climb[2] - ktilde_4*turn + ktilde_7*rate]*J_a

define stable-42
  section: stability
  note: J is singular
  P(lambda) := lambda*(lambda - trace_J)

inequality text-criterion
  note: the trace as one number, not as a sum of two entries
  -1 < trace_J < 1

equation eq-34
  note: H' by the forms of its entries, not by their derivatives
  dZ_c = H(t_c)*dZ_b + [H_3(t_c), H_1(t_c); bend_H(t_c), H_3(t_c)]*Z_b*dt_c
    = H(t_c)*dZ_b + [H_3(t_c), H_1(t_c); bend_H(t_c), H_3(t_c)]*Z_b*dt_c

equation text-charpoly
  P(lambda) = lambda*(lambda - trace_J)

equation text-six-equations
  note: the conditions of the two masses' difference without the motion that they share
  w_a = e_1
  chi*r_b = e_2
  S_c[3] = V
  S_f = S_0

equation eq-44b
  note: N_1 - I as one matrix
  rounded(less_N_1*z_0 + N_2*z'_0) = 0

equation eq-44c
  note: N_4 - I without the 1 of the identity
  rounded(N_3*(z_0 + t_a*z'_0) + rest_4*z'_0) = 0

equation eq-45
  rounded(-((chi*share_r + share_w)/(1 - chi) + (chi*rate_r + rate_w))) = 0
  rounded(-((share_r + share_w)/(1 - chi) + (rate_r + rate_w))) = 0

equation eq-46
  z_0 = rounded(V*[(chi*share_r + share_w)/(1 - chi) - t_a; (share_r + share_w)/(1 - chi) - t_a])

equation text-45-suffices
  rounded(-V*(share_r*slack_3 + share_w*even_3 + (1 - chi)*even_4))
    = rounded(-V*(share_r*slack_3 + share_w*even_3 + (1 - chi)*even_4))

equation text-times-alone
  rounded(-((chi*share_r + share_w)/(1 - chi) + (chi*rate_r + rate_w))) = 0
  rounded(-((share_r + share_w)/(1 - chi) + (rate_r + rate_w))) = 0
  rounded(V*share_w) = e_1
  rounded(chi*(V*(share_r + versed(t_b)*share_w + (1 - chi)*lag_b))) = e_2
