# The free quantities of the paper, in its own notation.
# z_1a is the paper's z_{1a}, a component of the state at the end of the phase whose letter it carries; z'_1b is a
# velocity there; x_a, u_b, ... are the first-order perturbations of (21)-(41).
paper: Analytical investigation of periodic solutions for a coupled oscillator with dry friction
place: 2-79
model: two masses on a belt
source: a machine conversion of the printed paper, without its figures; a misprint of one symbol may be due to it
text: sha256 843a63168c06b344dcb4caa15bf79f0d490fe8048cc8bac571711feaa7cceec7

symbol chi
  means: non dimensional stiffness k_2/(k_1 + k_2)
symbol eta
  means: non dimensional mass m_1/m_2
symbol V
  means: belt velocity
symbol t
  means: non dimensional time
symbol t_prime
  means: time before scaling, t' in (1) (t^* in the nomenclature)
symbol omega_3
  means: frequency that scales time, (1)
symbol m_1
  means: mass of the first block
symbol m_2
  means: mass of the second block
symbol k_1
  means: stiffness of the spring to the wall
symbol k_2
  means: stiffness of the spring between the blocks
symbol F_1
  means: friction force on the first block
symbol F_2
  means: friction force on the second block
symbol u_1
  means: non dimensional friction force on the first block
symbol u_2
  means: non dimensional friction force on the second block
symbol u_r1
  means: non dimensional static friction force, first block
symbol u_r2
  means: non dimensional static friction force, second block
symbol u_s1
  means: non dimensional sliding friction force, first block
symbol u_s2
  means: non dimensional sliding friction force, second block
symbol e_1
  means: u_r1 - u_s1, (7)
symbol e_2
  means: u_r2 - u_s2, (5)
symbol eps
  means: a sign, +1 or -1
symbol lambda
  means: the unknown of the characteristic equation (42)

symbol t_a
  means: duration of the global stick phase
symbol t_b
  means: duration of the slip-stick phase
symbol t_c
  means: duration of the global slip phase
symbol t_d
  means: duration of the stick-slip phase
symbol dt_a
  means: first-order change of t_a
symbol dt_b
  means: first-order change of t_b
symbol dt_c
  means: first-order change of t_c
symbol dt_d
  means: first-order change of t_d

symbol z_10
  means: z_1 at the start of the period
symbol z_20
  means: z_2 at the start of the period
symbol z_100
  means: z_10 of the unperturbed periodic solution, (21)
symbol z_200
  means: z_20 of the unperturbed periodic solution, (21)
symbol z'_10
  means: z_1' at the start of the period
symbol z'_20
  means: z_2' at the start of the period
symbol z_1a
  means: z_1 at t_a
symbol z_2a
  means: z_2 at t_a
symbol z'_1a
  means: z_1' at t_a
symbol z'_2a
  means: z_2' at t_a
symbol z_1b
  means: z_1 at t_a + t_b
symbol z_2b
  means: z_2 at t_a + t_b
symbol z'_1b
  means: z_1' at t_a + t_b
symbol z'_2b
  means: z_2' at t_a + t_b
symbol z_1c
  means: z_1 at t_a + t_b + t_c
symbol z_2c
  means: z_2 at t_a + t_b + t_c
symbol z'_1c
  means: z_1' at t_a + t_b + t_c
symbol z'_2c
  means: z_2' at t_a + t_b + t_c

symbol u
  means: perturbation of z'_10
symbol v
  means: perturbation of z'_20
symbol x
  means: perturbation of z_10
symbol y
  means: perturbation of z_20
symbol x_a
  means: perturbation of z_1 at the end of the stick phase
symbol y_a
  means: perturbation of z_2 at the end of the stick phase
symbol u_a
  means: perturbation of z_1' at the end of the stick phase
symbol v_a
  means: perturbation of z_2' at the end of the stick phase
symbol x_b
  means: perturbation of z_1 at the end of the slip-stick phase
symbol y_b
  means: perturbation of z_2 at the end of the slip-stick phase
symbol u_b
  means: perturbation of z_1' at the end of the slip-stick phase
symbol v_b
  means: perturbation of z_2' at the end of the slip-stick phase
symbol x_c
  means: perturbation of z_1 at the end of the global slip phase
symbol y_c
  means: perturbation of z_2 at the end of the global slip phase
symbol u_c
  means: perturbation of z_1' at the end of the global slip phase
symbol v_c
  means: perturbation of z_2' at the end of the global slip phase
symbol x_f
  means: perturbation of z_1 at the end of the period
symbol y_f
  means: perturbation of z_2 at the end of the period
symbol u_f
  means: perturbation of z_1' at the end of the period
symbol v_f
  means: perturbation of z_2' at the end of the period

# What the paper writes as one letter: states at the switching times and their parts, perturbations likewise.
define text-states-named
  z_0 := [z_10; z_20]
  z'_0 := [z'_10; z'_20]
  Z_0 := [z_0; z'_0]
  z_a := [z_1a; z_2a]
  z'_a := [z'_1a; z'_2a]
  Z_a := [z_a; z'_a]
  z_b := [z_1b; z_2b]
  z'_b := [z'_1b; z'_2b]
  Z_b := [z_b; z'_b]
  z_c := [z_1c; z_2c]
  z'_c := [z'_1c; z'_2c]
  Z_c := [z_c; z'_c]
  dZ_0 := [dz_0; dz'_0]
