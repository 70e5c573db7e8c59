/* A heated wall moves through a room: the mesh follows, and the field by slots with it. Exits with
 * 0 if every step is as it should be. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "livemesh.h"

/* Ends the program with the message of a failure. */
static void require(lm_status status) {
  lm_error error = {.size = sizeof error};
  if (status == LM_OK) return;
  lm_last_error(&error);
  fprintf(stderr, "%s: %s\n", error.name, error.message);
  exit(1);
}

/* A field by point slots: here x + 2 y, which linear interpolation carries through without error.
 */
typedef struct {
  double* at;
  size_t rows;
} field;

static void follow(lm_handle live, lm_handle change, field* f) {
  lm_change_info info = {.size = sizeof info};
  lm_array points = {.size = sizeof points};
  size_t i;
  double worst = 0;
  require(lm_change_describe(change, &info));
  f->at = realloc(f->at, (size_t)info.point_slots * sizeof *f->at);
  if (f->at == NULL) exit(1);
  require(lm_live_array(live, LM_LIVE_POINTS, &points));
  if (f->rows == 0) {
    for (i = 0; i < points.rows; ++i) {
      const double* p = (const double*)points.data + 2 * i;
      f->at[i] = p[0] + 2 * p[1];
    }
  } else {
    require(lm_change_transfer(change, 1, f->at, f->rows, f->at, (size_t)info.point_slots));
  }
  f->rows = (size_t)info.point_slots;
  for (i = 0; i < points.rows; ++i) {
    const double* p = (const double*)points.data + 2 * i;
    worst = fmax(worst, fabs(f->at[i] - p[0] - 2 * p[1]));
  }
  if (worst > 1e-9) {
    fprintf(stderr, "the field is off by %g\n", worst);
    exit(1);
  }
}

int main(void) {
  const double room[] = {0, 0, 4, 0, 4, 3, 0, 3};
  const int64_t around[] = {0, 1, 2, 3, 0};
  double wall[] = {1, 1, 1, 2};
  int64_t ends[2];
  lm_options options = {.size = sizeof options};
  lm_live_info info = {.size = sizeof info};
  lm_handle live = 0, change = 0, mesh = 0;
  lm_array added = {.size = sizeof added}, cells = {.size = sizeof cells},
           angles = {.size = sizeof angles};
  field f = {NULL, 0};
  int step;

  if (lm_abi_version() != LM_ABI_VERSION) return 1;
  options.domain_hi[0] = 4;
  options.domain_hi[1] = 3;
  options.min_angle = 25;
  options.max_measure = 0.05;
  require(lm_live_new(2, &options, &live));
  require(lm_live_add_points(live, 4, room, NULL, NULL, NULL));
  require(lm_live_add_polyline(live, 5, around, NULL, 1, NULL));
  require(lm_live_add_points(live, 2, wall, NULL, NULL, &ends[0]));
  ends[1] = ends[0] + 1;
  require(lm_live_add_segments(live, 1, ends, NULL, NULL, NULL));
  require(lm_live_update(live, NULL, &change));
  follow(live, change, &f);
  require(lm_free(change));

  for (step = 1; step <= 10; ++step) {
    wall[0] = wall[2] = 1 + 0.15 * step;
    require(lm_live_move_points(live, 2, ends, wall));
    require(lm_live_update(live, NULL, &change));
    require(lm_change_array(change, LM_CHANGE_KEPT_ADDED, &added));
    follow(live, change, &f);
    printf("step %d: %d triangles are new\n", step, (int)added.rows);
    require(lm_free(change));
  }

  /* An edit that cannot be: nothing of the batch is made. */
  wall[0] = 9;
  if (lm_live_move_points(live, 2, ends, wall) != LM_OUTSIDE_DOMAIN) return 1;
  require(lm_live_describe(live, &info));
  if (info.pending) return 1;

  require(lm_live_mesh(live, &mesh));
  require(lm_mesh_array(mesh, LM_MESH_CELLS, &cells));
  require(lm_mesh_quality(mesh, LM_MIN_ANGLE, &angles));
  {
    double least = 180;
    size_t i;
    for (i = 0; i < angles.rows; ++i) least = fmin(least, ((const double*)angles.data)[i]);
    printf("%d triangles, smallest angle %.1f degrees\n", (int)cells.rows, least);
    if (least < 25) return 1;
  }
  require(lm_free(mesh));
  require(lm_free(live));
  free(f.at);
  return lm_objects() == 0 ? 0 : 1;
}
