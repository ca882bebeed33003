/* What an audit is made of, as texts in memory, and the same with one text changed. */
#ifndef STICKSLIP_POWER_MATERIAL_H
#define STICKSLIP_POWER_MATERIAL_H

#include "claim/claim.h"
#include "scene/scene.h"

enum material_part { PART_EQUATIONS, PART_CLAIMS, PART_CONTROLS, PART_SCENE };

struct material_file {
  enum material_part part;
  enum rank rank;                   /* of equations */
  const char *name;                 /* without its folder */
  const struct record_file *parsed; /* with the source */
};

struct material {
  struct audit_data data;
  const struct scene *scene;
  struct material_file *file; /* equations, claims, controls, the scene, each in the order in which they were read */
  size_t n;
  struct record_file scene_records;
};

/* All of it is borrowed. */
void material_init(struct material *m, const struct audit_data *data, const struct scene *scene);
void material_clear(struct material *m);
/* Whether "4-stability.eq" or "4-stability" names the file. */
bool file_is_named(const char *file, const char *item);
/* The checks of loaded data, those of the TeX that model_load makes and those of verify. */
bool material_check(const struct audit_data *data, struct diag *d);

/* The material with one file's text exchanged: what it made is its own, the rest is that of the material. */
struct changed_material {
  struct audit_data data;
  const struct scene *scene;
  struct model own_model;
  struct claims own_claims;
  struct scene own_scene;
};
/* Reads the text as the file's; messages call the file by its name without a folder.  false with d set where it cannot
   be read.  To be cleared in any case. */
bool material_change(struct changed_material *c, const struct material *m, size_t file, const char *text,
                     struct diag *d);
void changed_material_clear(struct changed_material *c);

#endif
