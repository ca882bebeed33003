#include "two_masses.h"

#include <stdlib.h>

void two_masses(struct mech *m, const fmpq params[N_PARAMS], const fmpq *const sliding[2]) {
  const char *why, *name;
  mech_init(m);
  for (int i = 0; i < 2; i++) {
    struct mech_link *spring = mech_add_link(m, true, i ? "middle" : "wall");
    struct mech_mass *mass = mech_add_mass(m, i ? "m2" : "m1");
    spring->end[0] = i - 1;
    spring->end[1] = i;
    mass->rubbed = true;
    fmpq_set(mass->surface, params + P_V);
    fmpq_set(mass->limit, params + P_E1 + i);
    if (!sliding[i]) continue;
    fmpq_set(mass->sliding, sliding[i]);
    fmpq_add(mass->limit, mass->limit, sliding[i]);
  }
  fmpq_one(m->spring[0].size);
  fmpq_sub(m->spring[0].size, m->spring[0].size, params + P_CHI);
  fmpq_set(m->spring[1].size, params + P_CHI);
  fmpq_one(m->mass[0].inertia);
  fmpq_inv(m->mass[1].inertia, params + P_ETA);
  if (!mech_finish(m, &why, &name)) abort();
}
