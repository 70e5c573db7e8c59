/* Random calls of the C interface, most of them with something wrong: freed, forged and foreign
 * handles, NULL, wrong sizes, NaN, unknown fields. Every call has to return, with a status that has
 * a name; afterwards every object can be freed, and a mesh can still be made.
 *
 *   misuse [SEED [CALLS]]
 */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "livemesh.h"

#define MOST 24   /* elements of an array */
#define HANDLES 5 /* of a kind */

/* A struct with room behind it: it may say that it is larger than it is known to be. */
#define WITH_ROOM(type, name)  \
  static union {               \
    type all;                  \
    unsigned char bytes[4096]; \
  } name##_room;               \
  type* const name = &name##_room.all

static uint64_t state;
static uint64_t any(void) { /* splitmix64 */
  uint64_t z = (state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}
static unsigned below(unsigned n) { return (unsigned)(any() % n); }
static int once_in(unsigned n) { return below(n) == 0; }

enum kind { GRAPH, SIZES, MESH, LIVE, CHANGE, FINDINGS, STOP, KINDS };
static lm_handle handles[KINDS][HANDLES];
static const char* folder;

static lm_handle any_handle(void) { return handles[below(KINDS)][below(HANDLES)]; }
static lm_handle handle(enum kind kind) {
  if (once_in(60)) return any();
  if (once_in(60)) return any_handle() ^ (1u << below(8));
  if (once_in(20)) return any_handle();
  return handles[kind][below(HANDLES)]; /* perhaps 0, or freed */
}
static lm_handle* place(enum kind kind) {
  lm_handle* at = &handles[kind][below(HANDLES)];
  if (once_in(60)) return NULL;
  if (*at != 0) lm_free(*at); /* until it is written, a handle that was freed */
  if (once_in(2)) *at = 0;
  return at;
}

static double number(void) {
  static const double odd[] = {NAN,   INFINITY, -INFINITY, 0, -0.0, 1e-300,
                               1e300, 0x1p-100, -1,        2, 1};
  if (once_in(400)) return odd[below(sizeof odd / sizeof *odd)];
  if (once_in(9)) return below(9) / 8.0;
  return (double)(any() >> 11) * 0x1p-53;
}
static double numbers_memory[MOST * 9];
static const double* numbers(void) {
  size_t i;
  if (once_in(40)) return NULL;
  for (i = 0; i < sizeof numbers_memory / sizeof *numbers_memory; ++i) numbers_memory[i] = number();
  return numbers_memory;
}
/* A size, or what cannot be one. Tiny ones ask for more vertices than a test has time for. */
static double measure(void) {
  const double x = number();
  return x > 0 && x < 1e-3 ? 1e-3 : x;
}
static const double* measures(void) {
  static double memory[MOST];
  size_t i;
  for (i = 0; i < MOST; ++i) memory[i] = measure();
  return memory;
}
static int64_t id(void) {
  if (once_in(40)) return (int64_t)any();
  if (once_in(80)) return INT64_MAX;
  return (int64_t)below(MOST);
}
static int64_t ids_memory[4][MOST * 6];
static const int64_t* ids(int k) {
  size_t i;
  if (once_in(4)) return NULL;
  for (i = 0; i < MOST * 6; ++i) ids_memory[k][i] = id();
  return ids_memory[k];
}
static size_t count(void) { return once_in(60) ? SIZE_MAX >> below(40) : below(MOST); }
static size_t count_in_array(void) { return below(MOST); }
static size_t size(size_t right) {
  if (once_in(30)) return (size_t)any();
  if (once_in(20)) return below(2 * (unsigned)right + 1);
  return right;
}
static int32_t small(int32_t n) {
  return once_in(25) ? (int32_t)any() : (int32_t)below((unsigned)n);
}
static int32_t dimension(void) { return 2 + small(2); }
static const char* path(void) {
  static const char* names[] = {"x.poly",   "x.node",    "x.vtu", "x.msh",  "x.smesh",
                                "x.stl",    "x.off",     "x.svg", "x.none", "",
                                "no/x.vtu", "x.geojson", "x.inp", "x.su2"};
  static char all[512];
  if (once_in(30)) return NULL;
  snprintf(all, sizeof all, "%s/%s", folder, names[below(sizeof names / sizeof *names)]);
  return all;
}

static int watch(const lm_progress* progress, void* user) {
  lm_array array = {.size = sizeof array};
  (void)user;
  if (progress->size < sizeof *progress) abort();
  lm_live_array(any_handle(), small(12), &array); /* perhaps its own caller */
  lm_live_discard(any_handle());
  return once_in(20);
}
/* Wrong at some places, but the same whenever it is asked: sizes are a function. */
static double size_at(const double* at, void* user) {
  static const double wrong[] = {NAN, INFINITY, -1, 0, 1e300, 1e-300, 5};
  uint64_t bits;
  (void)user;
  memcpy(&bits, at, sizeof bits);
  bits = (bits ^ (bits >> 31)) * 0xbf58476d1ce4e5b9u >> 32;
  if (bits % 2000 == 0) return wrong[bits / 2000 % 7];
  return 0.3 + 0.1 * fabs(at[0] < 1 ? at[0] : 1);
}

static lm_control* control(void) {
  WITH_ROOM(lm_control, all);
  if (once_in(2)) return NULL;
  memset(&all_room, 0, sizeof all_room);
  all->size = size(sizeof *all);
  all->progress = once_in(2) ? watch : NULL;
  all->interval = once_in(20) ? number() : 0;
  all->timeout = once_in(10) ? number() : 2;
  all->stop = once_in(8) ? handle(STOP) : 0;
  return all;
}
static double seen;
static lm_status write_as(void) {
  WITH_ROOM(lm_write_options, all);
  static const char* texts[] = {"inlet", "a b", "", "wall", "marker_1", "\x80"};
  static lm_name names[128]; /* two, and room */
  int i;
  memset(&all_room, 0, sizeof all_room);
  memset(names, 0, sizeof names);
  all->size = size(sizeof *all);
  all->msh_version = once_in(9) ? small(50) : once_in(2) ? 22 : 41;
  all->only_these = small(2);
  all->names_count = below(3);
  all->names = once_in(20) ? NULL : names;
  for (i = 0; i < 2; ++i) {
    names[i].size = size(sizeof names[i]);
    names[i].kind = small(4);
    names[i].marker = id();
    names[i].region = once_in(20) ? number() : small(4);
    names[i].name = once_in(30) ? NULL : texts[below(sizeof texts / sizeof *texts)];
  }
  return lm_mesh_write_as(handle(MESH), path(), once_in(20) ? NULL : all);
}
static lm_status look_at_names(void) {
  WITH_ROOM(lm_name, name);
  size_t n = 0;
  lm_status status = lm_mesh_name_count(handle(MESH), once_in(30) ? NULL : &n);
  if (status != LM_OK) return status;
  memset(&name_room, 0, sizeof name_room);
  name->size = size(sizeof *name);
  status = lm_mesh_name_get(handle(MESH), below(4), name);
  if (status == LM_OK && name->size >= sizeof *name) seen += strlen(name->name);
  return status;
}
static const int64_t kSides[] = {4, 2, 1, 3}; /* markers of a square: left, right, bottom, top */
static const char* tile_folder(void) {
  static char all[512];
  snprintf(all, sizeof all, "%s/tiles", folder);
  return all;
}
static lm_options* options(void) {
  WITH_ROOM(lm_options, all);
  static lm_box_limits boxes[128]; /* two, and room */
  static int64_t pairs[4];
  int i;
  if (once_in(6)) return NULL;
  memset(&all_room, 0, sizeof all_room);
  all->size = size(sizeof *all);
  all->max_vertices = 3000; /* so that runs are short */
  for (i = 0; i < 3 && !once_in(6); ++i) all->domain_hi[i] = once_in(20) ? number() : 1;
  if (once_in(4)) all->min_angle = once_in(4) ? 100 * number() : 25;
  if (once_in(9)) all->rho = 3 * number();
  if (once_in(30)) all->min_dihedral = number();
  if (once_in(4)) all->max_measure = once_in(9) ? measure() : 0.02;
  if (once_in(6)) all->sizes = handle(SIZES);
  if (once_in(8)) all->extent = small(2);
  if (once_in(4)) all->algorithm = small(4);
  if (once_in(12)) all->rule = small(2);
  if (once_in(6)) all->growth = once_in(4) ? 3 * number() : 1.25 + number();
  if (once_in(4)) all->threads = once_in(6) ? small(300) : 1 + small(4);
  if (once_in(4)) {
    for (i = 0; i < 4; ++i) pairs[i] = once_in(9) ? id() : kSides[i];
    all->periodic = once_in(20) ? NULL : pairs;
    all->periodic_count = below(3);
  }
  if (once_in(12)) {
    all->out_of_core = once_in(4) ? path() : tile_folder();
    all->tiles = below(4);
  }
  if (once_in(40)) all->tiles = any();
  all->region_limits = small(2);
  all->no_flat = small(2);
  if (once_in(9)) {
    memset(boxes, 0, sizeof boxes);
    for (i = 0; i < 2; ++i) {
      int k;
      boxes[i].size = size(sizeof boxes[i]);
      for (k = 0; k < 3; ++k) boxes[i].hi[k] = once_in(9) ? number() : 0.5;
      boxes[i].max_measure = once_in(9) ? measure() : 0.05;
    }
    all->box_limits = once_in(9) ? NULL : boxes;
    all->box_limits_count = below(3);
  }
  return all;
}
static lm_polygon* polygon(void) {
  WITH_ROOM(lm_polygon, all);
  static size_t loops[2];
  if (once_in(30)) return NULL;
  memset(&all_room, 0, sizeof all_room);
  all->size = size(sizeof *all);
  all->loops = below(3);
  loops[0] = below(8);
  loops[1] = 3;
  all->loop_sizes = once_in(30) ? NULL : loops;
  all->points = ids(0);
  all->inner_edges = once_in(5);
  all->edges = ids(1);
  all->inner_points = once_in(5);
  all->loose_points = ids(2);
  all->marker = id();
  return all;
}

/* A square whose sides can be periodic; points inside. */
static lm_status square(lm_handle* graph) {
  static const double corners[] = {.25, .25, .75, .25, .75, .75, .25, .75};
  static const int64_t ends[] = {0, 1, 1, 2, 3, 2, 0, 3}, markers[] = {1, 2, 3, 4};
  lm_status status = lm_graph_new(2, graph);
  if (status == LM_OK) status = lm_graph_add_points(*graph, 4, corners, NULL, NULL, NULL);
  if (status == LM_OK) status = lm_graph_add_segments(*graph, 4, ends, NULL, markers, NULL);
  if (status != LM_OK || once_in(2)) return status;
  return lm_graph_add_points(*graph, below(5), numbers(), NULL, NULL, NULL);
}

static lm_status mesh_of_square(void) {
  lm_handle* graph = place(GRAPH);
  lm_options* given = options();
  const lm_status status = square(graph);
  if (status != LM_OK) return status;
  if (given != NULL && once_in(2)) {
    given->periodic = kSides;
    given->periodic_count = sizeof kSides / sizeof *kSides / 2;
  }
  return lm_mesh_make(*graph, given, control(), place(MESH));
}

/* Reads what an array shows, so that a sanitizer sees it. */
static double read_all(const lm_array* a) {
  static const size_t sizes[] = {8, 8, 4, 1};
  double sum = 0;
  uint64_t i;
  for (i = 0; i < a->rows; ++i) {
    const unsigned char* row = (const unsigned char*)a->data + i * a->stride;
    size_t k;
    for (k = 0; k < a->columns * sizes[a->type]; ++k) sum += row[k];
  }
  return sum;
}

static lm_status call(void) {
  WITH_ROOM(lm_array, array);
  int64_t first;
  double* field;
  lm_status status;
  memset(&array_room, 0, sizeof array_room);
  array->size = size(sizeof *array);
  switch (below(52)) {
    case 0:
    case 1:
      return lm_graph_new(dimension(), place(GRAPH));
    case 2:
    case 3:
    case 4:
    case 5:
      return lm_graph_add_points(handle(GRAPH), count_in_array(), numbers(),
                                 once_in(3) ? ids(0) : NULL, ids(1), once_in(2) ? &first : NULL);
    case 6:
    case 7:
      return lm_graph_add_segments(handle(GRAPH), count_in_array() / 4, ids(0), NULL, ids(2), NULL);
    case 8:
      return lm_graph_add_polyline(handle(GRAPH), below(6), ids(0), ids(1), id(), &first);
    case 9:
      return lm_graph_add_polygon(handle(GRAPH), polygon(), once_in(2) ? ids(3) : NULL, NULL);
    case 10:
      return lm_graph_add_faces(handle(GRAPH), below(8), NULL, ids(0), NULL, ids(2), NULL);
    case 11:
      return lm_graph_add_soup(handle(GRAPH), count_in_array(), numbers(), ids(0), NULL);
    case 12:
      return lm_graph_add_holes(handle(GRAPH), below(3), numbers(), NULL, NULL);
    case 13:
      return lm_graph_add_regions(handle(GRAPH), below(3), numbers(), numbers(), measures(), NULL,
                                  NULL);
    case 14:
      status = lm_graph_array(handle(GRAPH), small(LM_GRAPH_INNER_POINTS + 2), array);
      if (status == LM_OK && array->size >= sizeof *array) seen += read_all(array);
      return status;
    case 15:
      return lm_graph_read(path(), small(5), small(2), place(GRAPH));
    case 16:
      return lm_graph_write(handle(GRAPH), path());
    case 17:
      return lm_graph_repair(handle(GRAPH), once_in(9) ? numbers() : NULL,
                             once_in(3) ? numbers() : NULL, place(GRAPH));
    case 18:
      return lm_graph_merge(handle(GRAPH), place(GRAPH));
    case 19:
      return lm_sizes_samples(dimension(), below(9), numbers(), measures(), place(SIZES));
    case 20:
      return lm_sizes_function(dimension(), once_in(20) ? NULL : size_at, NULL, number(),
                               0.1 * measure(), place(SIZES));
    case 21:
      return lm_sizes_read(path(), dimension(), place(SIZES));
    case 22:
    case 23:
      return mesh_of_square();
    case 24:
      return lm_mesh_make(handle(GRAPH), options(), control(), place(MESH));
    case 25:
    case 26:
      status = lm_mesh_array(handle(MESH), small(LM_MESH_PERIODIC_POINTS + 2), array);
      if (status == LM_OK && array->size >= sizeof *array) seen += read_all(array);
      return status;
    case 27:
      status = lm_mesh_quality(handle(MESH), small(7), array);
      if (status == LM_OK && array->size >= sizeof *array) seen += read_all(array);
      return status;
    case 28:
      switch (below(4)) {
        case 0:
          return lm_mesh_write(handle(MESH), path());
        case 1:
          return write_as();
        case 2:
          return look_at_names();
        default:
          return lm_mesh_second_order(handle(MESH), place(MESH));
      }
    case 29:
      return lm_mesh_read(path(), small(5), place(MESH));
    case 30: {
      WITH_ROOM(lm_check_options, given);
      memset(&given_room, 0, sizeof given_room);
      given->size = size(sizeof *given);
      size_t n;
      if (once_in(2)) given->graph = handle(GRAPH);
      if (once_in(4)) given->rho = 2 * number();
      given->boundary = small(5);
      return lm_mesh_check(handle(MESH), once_in(5) ? NULL : given, place(FINDINGS),
                           once_in(2) ? &n : NULL);
    }
    case 31: {
      WITH_ROOM(lm_finding, finding);
      memset(&finding_room, 0, sizeof finding_room);
      finding->size = size(sizeof *finding);
      status = lm_finding_get(handle(FINDINGS), below(20), finding);
      if (status == LM_OK && finding->property != NULL) seen += (double)strlen(finding->property);
      return status;
    }
    case 32:
    case 33:
      return lm_live_new(dimension(), options(), place(LIVE));
    case 34:
    case 35:
    case 36:
      return lm_live_add_points(handle(LIVE), count_in_array(), numbers(),
                                once_in(3) ? ids(0) : NULL, ids(1), &first);
    case 37:
      return lm_live_move_points(handle(LIVE), below(3), ids(0), numbers());
    case 38:
      return lm_live_remove_points(handle(LIVE), below(3), ids(0));
    case 39:
      return lm_live_add_segments(handle(LIVE), below(3), ids(0), NULL, ids(2), &first);
    case 40:
      return lm_live_add_polyline(handle(LIVE), below(5), ids(0), once_in(2) ? ids(1) : NULL, id(),
                                  &first);
    case 41:
      return once_in(2) ? lm_live_remove_lines(handle(LIVE), below(3), ids(0))
                        : lm_live_remove_regions(handle(LIVE), below(2), ids(0));
    case 42:
      return once_in(2) ? lm_live_add_polygon(handle(LIVE), polygon(), NULL, &first)
                        : lm_live_remove_polygons(handle(LIVE), 1, ids(0));
    case 43:
      return once_in(2) ? lm_live_add_holes(handle(LIVE), below(3), numbers(), NULL, &first)
                        : lm_live_add_regions(handle(LIVE), below(2), numbers(), numbers(),
                                              measures(), NULL, NULL);
    case 44:
      return once_in(2) ? lm_live_add_graph(handle(LIVE), handle(GRAPH))
                        : lm_live_limit(handle(LIVE), measure(), once_in(3) ? handle(SIZES) : 0,
                                        once_in(2) ? numbers() : NULL);
    case 45:
      return once_in(9) ? lm_live_discard(handle(LIVE)) : lm_live_keep_undo(handle(LIVE), below(5));
    case 46:
    case 47:
      return lm_live_update(handle(LIVE), control(), once_in(3) ? NULL : place(CHANGE));
    case 48:
      return lm_live_undo(handle(LIVE), control(), place(CHANGE));
    case 49:
      if (once_in(3))
        return once_in(2) ? lm_live_mesh(handle(LIVE), place(MESH))
                          : lm_live_graph(handle(LIVE), place(GRAPH));
      status = lm_live_array(handle(LIVE), small(LM_LIVE_FACET_USED + 2), array);
      if (status == LM_OK && array->size >= sizeof *array) seen += read_all(array);
      return status;
    case 50:
      if (once_in(3)) {
        lm_change_info info = {.size = sizeof info};
        const lm_handle change = handle(CHANGE);
        if (lm_change_describe(change, &info) != LM_OK || info.point_slots > 100000) return LM_OK;
        field = calloc((size_t)info.point_slots + 1, 2 * sizeof *field);
        if (field == NULL) return LM_OK;
        status = lm_change_transfer(
            change, below(3), field,
            (size_t)(once_in(3) ? below((unsigned)info.point_slots + 1) : info.point_slots_before),
            field, (size_t)info.point_slots - (once_in(9) && info.point_slots > 0));
        free(field);
        return status;
      }
      status = lm_change_array(handle(CHANGE), small(14), array);
      if (status == LM_OK && array->size >= sizeof *array) seen += read_all(array);
      return status;
    default: {
      const char* text;
      size_t n;
      WITH_ROOM(lm_live_info, live);
      memset(&live_room, 0, sizeof live_room);
      live->size = size(sizeof *live);
      WITH_ROOM(lm_mesh_info, mesh);
      memset(&mesh_room, 0, sizeof mesh_room);
      mesh->size = size(sizeof *mesh);
      uint32_t slots[MOST];
      uint8_t exist[MOST];
      int32_t d;
      switch (below(11)) {
        case 0:
          return lm_text_count(any_handle(), &n);
        case 1:
          return lm_text_get(any_handle(), below(9), &text);
        case 2:
          return lm_live_describe(handle(LIVE), live);
        case 3:
          return lm_mesh_describe(handle(MESH), once_in(9) ? NULL : mesh);
        case 4:
          return lm_live_find(handle(LIVE), count_in_array(), numbers(), slots);
        case 5:
          return lm_live_contains(handle(LIVE), small(7), count_in_array(), ids(0), exist);
        case 6:
          return lm_graph_dimension(handle(GRAPH), &d);
        case 7:
          return lm_stop_new(place(STOP));
        case 8:
          return lm_stop_request(once_in(9) ? handle(STOP) : 0);
        case 9:
          return lm_free(once_in(3) ? any_handle() : any());
        default:
          return lm_graph_add_points(handle(GRAPH), count(), NULL, NULL, NULL, NULL);
      }
    }
  }
}

/* A good input after all that: the library is as it was. */
static int still_works(void) {
  static const double corners[] = {0, 0, 1, 0, 1, 1, 0, 1};
  static const int64_t around[] = {0, 1, 2, 3, 0};
  lm_handle graph = 0, mesh = 0;
  lm_array cells = {.size = sizeof cells};
  const int good = lm_graph_new(2, &graph) == LM_OK &&
                   lm_graph_add_points(graph, 4, corners, NULL, NULL, NULL) == LM_OK &&
                   lm_graph_add_polyline(graph, 5, around, NULL, 0, NULL) == LM_OK &&
                   lm_mesh_make(graph, NULL, NULL, &mesh) == LM_OK &&
                   lm_mesh_array(mesh, LM_MESH_CELLS, &cells) == LM_OK && cells.rows > 1;
  return good && lm_free(mesh) == LM_OK && lm_free(graph) == LM_OK &&
         lm_free(graph) == LM_BAD_HANDLE;
}

/* The first rule that does not hold; NULL: all do. */
#define HOLDS(condition) \
  if (!(condition)) return #condition

static const char* results_are_written_on_success_alone(lm_handle live) {
  const uint32_t cells[] = {0, LM_NONE};
  const double nowhere[] = {0, 0, NAN, 0}, far[] = {0, 0, 1, INFINITY};
  double attributes[] = {-7, -7};
  uint32_t slots[] = {77, 77};
  HOLDS(lm_live_regions(live, 1, cells, attributes) == LM_OK && attributes[0] == 0);
  attributes[0] = -7;
  HOLDS(lm_live_regions(live, 2, cells, attributes) == LM_BAD_ARGUMENT);
  HOLDS(attributes[0] == -7 && attributes[1] == -7);
  HOLDS(lm_live_find(live, 2, nowhere, slots) == LM_NOT_FINITE);
  HOLDS(lm_live_find(live, 2, far, slots) == LM_NOT_FINITE);
  HOLDS(slots[0] == 77 && slots[1] == 77);
  HOLDS(lm_live_find(live, 1, nowhere, slots) == LM_OK && slots[0] != LM_NONE);
  return NULL;
}

static const char* texts_stay(lm_handle live) {
  const double holes[] = {.05, .05, .05, .1, .05, .125, .05, .2, .05, .25};
  const char *texts[5], *text;
  char copies[5][200];
  lm_handle change;
  size_t n, i;
  HOLDS(lm_live_add_holes(live, 5, holes, NULL, NULL) == LM_OK);
  HOLDS(lm_live_update(live, NULL, NULL) == LM_OK);
  HOLDS(lm_text_count(live, &n) == LM_OK && n == 5);
  for (i = 0; i < 5; ++i) {
    HOLDS(lm_text_get(live, i, &texts[i]) == LM_OK);
    snprintf(copies[i], sizeof copies[i], "%s", texts[i]);
  }
  for (i = 0; i < 5; ++i) {
    HOLDS(lm_text_get(live, i, &text) == LM_OK && text == texts[i]);
    HOLDS(strcmp(texts[i], copies[i]) == 0);
  }
  HOLDS(lm_live_keep_undo(live, 1) == LM_OK);
  HOLDS(lm_live_remove_holes(live, 3, (const int64_t[]){0, 1, 2}) == LM_OK);
  HOLDS(lm_live_update(live, NULL, NULL) == LM_OK);
  HOLDS(lm_text_count(live, &n) == LM_OK && n == 2);
  HOLDS(lm_live_undo(live, NULL, &change) == LM_OK && lm_free(change) == LM_OK);
  HOLDS(lm_text_count(live, &n) == LM_OK && n == 5);
  return NULL;
}

static const char* undo_undoes_whole_updates(void) {
  const double at[] = {.25, .25, .75, .75};
  const int64_t ids[] = {0, 1};
  uint8_t exist[] = {7, 7};
  lm_handle live;
  lm_options box = {.size = sizeof box, .domain_hi = {1, 1}};
  HOLDS(lm_live_new(2, &box, &live) == LM_OK);
  HOLDS(lm_live_add_points(live, 1, at, NULL, NULL, NULL) == LM_OK);
  HOLDS(lm_live_keep_undo(live, 4) == LM_OK);
  HOLDS(lm_live_add_points(live, 1, at + 2, NULL, NULL, NULL) == LM_OK);
  HOLDS(lm_live_update(live, NULL, NULL) == LM_OK);
  HOLDS(lm_live_contains(live, LM_POINT, 2, ids, exist) == LM_OK && exist[0] && exist[1]);
  HOLDS(lm_live_undo(live, NULL, NULL) == LM_OK);
  HOLDS(lm_live_contains(live, LM_POINT, 2, ids, exist) == LM_OK && !exist[0] && !exist[1]);
  HOLDS(lm_live_undo(live, NULL, NULL) == LM_NOTHING_TO_UNDO);
  HOLDS(lm_free(live) == LM_OK);
  return NULL;
}

struct caller {
  lm_handle graph, live;
  lm_status reads, changes, uses;
};
static int look_at_caller(const lm_progress* progress, void* user) {
  static const double at[] = {.5, .25};
  struct caller* in = user;
  lm_array array = {.size = sizeof array};
  (void)progress;
  in->reads = lm_graph_array(in->graph, LM_GRAPH_POINTS, &array);
  in->changes = lm_graph_add_points(in->graph, 1, at, NULL, NULL, NULL);
  in->uses = lm_live_find(in->live, 0, NULL, NULL);
  return 0;
}
static const char* callbacks_read_graphs_alone(lm_handle graph, lm_handle live) {
  struct caller in = {graph, live, LM_INTERNAL, LM_INTERNAL, LM_INTERNAL};
  lm_control control = {.size = sizeof control, .progress = look_at_caller, .user = &in};
  lm_options fine = {.size = sizeof fine, .max_measure = 1e-4};
  lm_handle mesh;
  HOLDS(lm_mesh_make(graph, &fine, &control, &mesh) == LM_OK && lm_free(mesh) == LM_OK);
  HOLDS(in.reads == LM_OK && in.changes == LM_BUSY && in.uses == LM_OK);
  HOLDS(lm_live_limit(live, 1e-4, 0, NULL) == LM_OK);
  HOLDS(lm_live_update(live, &control, NULL) == LM_OK && in.uses == LM_BUSY);
  return NULL;
}

static const char* sizes_cut_no_member(lm_handle graph) {
  lm_options all = {.size = offsetof(lm_options, periodic) + 4};
  lm_handle mesh;
  all.periodic_count = 2;
  all.periodic = kSides;
  HOLDS(lm_mesh_make(graph, &all, NULL, &mesh) == LM_BAD_SIZE);
  all.size = offsetof(lm_options, periodic);
  HOLDS(lm_mesh_make(graph, &all, NULL, &mesh) == LM_NULL_POINTER);
  all.size = offsetof(lm_options, periodic_count); /* the first version */
  HOLDS(lm_mesh_make(graph, &all, NULL, &mesh) == LM_OK && lm_free(mesh) == LM_OK);
  return NULL;
}

static const char* fields_have_a_row_for_each_slot(lm_handle live) {
  static const double at[] = {.4, .4, .6, .4};
  static double field[10000];
  lm_change_info info = {.size = sizeof info};
  lm_change_info older = {.size = offsetof(lm_change_info, point_slots_before)};
  lm_handle change;
  size_t before, after;
  HOLDS(lm_live_add_points(live, 2, at, NULL, NULL, NULL) == LM_OK);
  HOLDS(lm_live_update(live, NULL, &change) == LM_OK);
  HOLDS(lm_change_describe(change, &info) == LM_OK);
  before = (size_t)info.point_slots_before;
  after = (size_t)info.point_slots;
  HOLDS(0 < before && before < after && after <= sizeof field / sizeof *field);
  HOLDS(lm_change_transfer(change, 1, field, before - 1, field, after) == LM_BAD_ARGUMENT);
  HOLDS(lm_change_transfer(change, 1, field, before, field, after - 1) == LM_BAD_ARGUMENT);
  HOLDS(lm_change_transfer(change, 1, field, before, field, after) == LM_OK);
  HOLDS(lm_change_transfer(change, 1, field, after, field, after) == LM_OK);
  HOLDS(lm_change_describe(change, &older) == LM_OK && older.point_slots == after);
  HOLDS(older.point_slots_before == 0);
  return lm_free(change) == LM_OK ? NULL : "a change is freed";
}

static const char* broken_rule(void) {
  static const double corners[] = {.25, .25, .75, .25, .5, .75, 0, 0};
  static const int64_t around[] = {0, 1, 2, 0};
  const char* broken;
  lm_options box = {.size = sizeof box, .domain_hi = {1, 1}};
  lm_handle graph, live;
  HOLDS(lm_graph_new(2, &graph) == LM_OK);
  HOLDS(lm_graph_add_points(graph, 4, corners, NULL, NULL, NULL) == LM_OK);
  HOLDS(lm_graph_add_polyline(graph, 4, around, NULL, 0, NULL) == LM_OK);
  HOLDS(lm_live_new(2, &box, &live) == LM_OK && lm_live_add_graph(live, graph) == LM_OK);
  HOLDS(lm_live_update(live, NULL, NULL) == LM_OK);
  broken = results_are_written_on_success_alone(live);
  if (broken == NULL) broken = sizes_cut_no_member(graph);
  if (broken == NULL) broken = fields_have_a_row_for_each_slot(live);
  if (broken == NULL) broken = texts_stay(live);
  if (broken == NULL) broken = undo_undoes_whole_updates();
  if (broken == NULL) broken = callbacks_read_graphs_alone(graph, live);
  HOLDS(lm_free(graph) == LM_OK && lm_free(live) == LM_OK);
  return broken;
}

int main(int argc, char** argv) {
  const char* broken = broken_rule();
  long internal = 0, ok = 0, calls_left, i;
  static long by_status[200];
  const uint64_t seed = argc > 1 ? strtoull(argv[1], NULL, 10) : 1;
  const char* scratch = getenv("TMPDIR");
  if (broken != NULL) {
    fprintf(stderr, "does not hold: %s\n", broken);
    return 1;
  }
  state = seed;
  folder = scratch != NULL ? scratch : "/tmp/livemesh-nowhere";
  calls_left = argc > 2 ? atol(argv[2]) : 20000;
  for (i = 0; i < calls_left; ++i) {
    const lm_status status = call();
    lm_error error = {.size = sizeof error};
    if (strcmp(lm_status_name(status), "unknown") == 0) return 1;
    if (status >= 0 && status < 200) ++by_status[status];
    if (status == LM_OK) {
      ++ok;
      continue;
    }
    if (lm_last_error(&error) != LM_OK || error.status != status || error.message == NULL) return 1;
    if (status == LM_INTERNAL && ++internal > 0) {
      fprintf(stderr, "seed %llu, call %ld: %s\n", (unsigned long long)seed, i, error.message);
    }
  }
  for (i = 0; i < 200; ++i) {
    if (by_status[i] > 0) printf("%s %ld\n", lm_status_name((lm_status)i), by_status[i]);
  }
  for (i = 0; i < KINDS * HANDLES; ++i) lm_free(handles[i / HANDLES][i % HANDLES]);
  printf("%ld of %ld calls succeeded, %g\n", ok, calls_left, seen);
  return !still_works() || internal > 0 || ok * 8 < calls_left;
}
