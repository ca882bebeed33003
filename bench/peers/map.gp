\\ The map of bench/job_map.c in PARI/GP, as peers.py runs it: run(digits, rows of chi, eta, V, e1, e2, r and rough
\\ t_b, t_c, t_d, all as fractions) prints the time of one call in ns, the least and the median of its batches, then t_b,
\\ t_c, t_d and r for each row.
settle(f, t, eps) = { my(v, d); for(i = 1, 60, v = f(t); d = v[1]/v[2]; t -= d; if(abs(d) < eps, return(t))); error("no convergence") };
pass(x, eps) = {
  my(chi = x[1], eta = x[2], V = x[3], e1 = x[4], e2 = x[5], r0 = x[6], a = (1 - chi)*V, q = chi*eta, tb, tc, s, c);
  tb = settle(t -> my(z = exp(I*t)); [a*(t - imag(z)) + e1*(1 - real(z)) + r0 - e2/chi, a*(1 - real(z)) + e1*imag(z)], x[7], eps);
  s = sin(tb); c = cos(tb);
  my(v = [V - a*(1 - c) - e1*s, V]~, f = [e1*c + a*s, eta*e2]~, K = [1, -chi; -q, q], root, big, small, P, om1, om2);
  root = sqrt(((1 - q)/2)^2 + chi*q); big = (1 + q)/2 + root; small = q*(1 - chi)/big;
  P = (big - K)/(big - small); om1 = sqrt(small); om2 = sqrt(big);
  my(v1 = P*v, v2 = v - v1, f1 = (P*f)/om1, f2 = (f - P*f)/om2);
  my(speed = (t -> my(y = exp(I*om1*t), z = exp(I*om2*t)); v1*real(y) - f1*imag(y) + v2*real(z) - f2*imag(z)));
  my(force = (t -> my(y = exp(I*om1*t), z = exp(I*om2*t)); om1*(v1*imag(y) + f1*real(y)) + om2*(v2*imag(z) + f2*real(z))));
  tc = settle(t -> [speed(t)[1] - V, -force(t)[1]], x[8], eps);
  my(u = speed(tc)[2] - V, r = force(tc)[2]/q, om = sqrt(q), up = if(u > 0, 1, -1));
  [tb, tc, arg(up*r + I*abs(u)/om)/om, up*sqrt(r^2 + u^2/q)]
};
run(digits, exact) = {
  default(realprecision, digits);
  my(n = matsize(exact)[1], rows = exact*1., eps = 10.^(-digits\2 - 2), times = 1, out, ms, batch = vector(5));
  until(ms >= 20, times *= 2; ms = getabstime(); for(k = 1, times, out = vector(n, i, pass(rows[i, ], eps))); ms = getabstime() - ms);
  for(b = 1, #batch, ms = getabstime(); for(k = 1, times, out = vector(n, i, pass(rows[i, ], eps))); batch[b] = getabstime() - ms);
  batch = vecsort(batch)*1e6/(times*n);
  print(batch[1]); print(batch[3]);
  for(i = 1, n, for(k = 1, 4, print(out[i][k])))
};
