/* livemesh: Delaunay meshes of good quality that follow edits of their input. C99.
 *
 * Example: the triangles of a square.
 *   const double corners[] = {0, 0, 1, 0, 1, 1, 0, 1};
 *   const int64_t around[] = {0, 1, 2, 3, 0};
 *   lm_handle graph = 0, mesh = 0;
 *   lm_options options = {.size = sizeof options};
 *   lm_array cells = {.size = sizeof cells};
 *   options.min_angle = 28;
 *   if (lm_graph_new(2, &graph) != LM_OK ||
 *       lm_graph_add_points(graph, 4, corners, NULL, NULL, NULL) != LM_OK ||
 *       lm_graph_add_polyline(graph, 5, around, NULL, 0, NULL) != LM_OK ||
 *       lm_mesh_make(graph, &options, NULL, &mesh) != LM_OK ||
 *       lm_mesh_array(mesh, LM_MESH_CELLS, &cells) != LM_OK) {
 *     lm_error error = {.size = sizeof error};
 *     lm_last_error(&error);
 *     fprintf(stderr, "%s\n", error.message);
 *   }
 *   lm_free(mesh);
 *   lm_free(graph);
 *
 * Rules, for every function:
 *   (1) It returns LM_OK, or another status, and then has done nothing, unless it says otherwise;
 *       results are only written on LM_OK. lm_last_error() describes the last failure of the
 *       calling thread. No C++ exception leaves a function.
 *   (2) A handle is a number. One that was freed, belongs to another kind of object, or is
 *       invented, is LM_BAD_HANDLE. 0 is never a handle.
 *   (3) Structs that the caller passes begin with their size: `lm_array a = {.size = sizeof a};`
 *       sets everything else to 0, which is the default. Structs of older headers are accepted, and
 *       of newer ones if what is unknown is 0; else LM_BAD_SIZE.
 *   (4) A pointer that must not be NULL is LM_NULL_POINTER. An array of 0 elements may be NULL.
 *   (5) Coordinates are n x d doubles, point by point, in input length units: finite, and 0 or of
 *       magnitude 2^-100 to 2^100. NaN and infinity are LM_NOT_FINITE.
 *   (6) Different objects may be used in different threads. Several threads may read one object at
 *       a time. A call that would change an object in use, or use one that is changing, is LM_BUSY
 *       at once. So it is in a callback: it may read the graph that is being meshed, but not change
 *       it, and it cannot use the live mesh that is being updated.
 *   (7) What a function returns by pointer stays valid until its object is changed or freed;
 *       meshes, changes and findings never change.
 *
 * Words: d is the dimension, 2 or 3. A cell is a triangle (d = 2) or a tetrahedron (d = 3). A facet
 * is an edge (d = 2) or a face (d = 3) of a cell that is on a line (polygon) of the input or on the
 * boundary. A measure is an area (d = 2) or a volume (d = 3). Points, lines (segments and polylines
 * together), polygons, holes and regions of the input have ids: any int64_t, distinct within their
 * kind. Where ids may be NULL, new ones are chosen: consecutive numbers after the highest so far,
 * from 0. The C++ headers of the mesher describe the meshes themselves.
 */
#ifndef LIVEMESH_H
#define LIVEMESH_H

#include <stddef.h>
#include <stdint.h>

#ifdef _WIN32
#ifdef LM_BUILDS_LIBRARY
#define LM_API __declspec(dllexport)
#else
#define LM_API __declspec(dllimport)
#endif
#else
#define LM_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* --- Versions --- */

/* Grows if a program that was compiled with an older header cannot use the library. */
#define LM_ABI_VERSION 1
LM_API uint32_t lm_abi_version(void);
/* "0.2.0". */
LM_API const char* lm_version(void);

/* --- Handles and errors --- */

typedef uint64_t lm_handle;
typedef int32_t lm_status; /* an lm_status_code */

/* Frees an object of any kind; calls that use it in other threads still end well. 0 is ignored. */
LM_API lm_status lm_free(lm_handle object);
/* The number of objects that are not freed. */
LM_API uint64_t lm_objects(void);

/* A status; the numbers never change. */
typedef enum lm_status_code {
  LM_OK = 0,
  /* mistakes of the program */
  LM_BAD_HANDLE = 1,
  LM_NULL_POINTER = 2,
  LM_BAD_SIZE = 3,     /* of a struct */
  LM_BAD_ARGUMENT = 4, /* a number that a function does not accept */
  LM_BUSY = 5,         /* see rule (6) */
  /* what can happen to any program */
  LM_OUT_OF_MEMORY = 6,
  LM_INTERNAL = 7, /* a mistake of this library: please report its message */
  LM_NOTHING_TO_UNDO = 8,
  /* bad data, as mesher/error.hpp describes */
  LM_DUPLICATE_POINT = 100,
  LM_OUTSIDE_DOMAIN,
  LM_NOT_FINITE,
  LM_MAGNITUDE,
  LM_UNKNOWN_ID,
  LM_REPEATED_ID,
  LM_WRONG_COUNT,
  LM_TRUNCATED,
  LM_BAD_NUMBER,
  LM_BAD_HEADER,
  LM_BAD_EDIT,
  LM_UNBALANCED_COMMIT,
  LM_BAD_DIMENSION,
  LM_BAD_SYNTAX,
  LM_UNSUPPORTED,
  LM_BAD_MESH,
  LM_BAD_QUALITY,
  LM_UNKNOWN_FORMAT,
  LM_CANNOT_READ,
  LM_CANNOT_WRITE,
  LM_BAD_OPTION,
  LM_TOO_CLOSE,
  LM_CROSSING_SEGMENTS,
  LM_POINT_ON_SEGMENT,
  LM_OVERLAPPING_SEGMENTS,
  LM_ZERO_LENGTH,
  LM_REPEATED_SEGMENT,
  LM_POINT_IN_USE,
  LM_TOO_MANY,
  LM_CANCELLED, /* stopped by a callback, a timeout or lm_stop_request() */
  LM_BAD_SEED,
  LM_BAD_POLYGON,
  LM_NOT_FLAT,
  LM_REPEATED_POLYGON,
  LM_POINT_ON_POLYGON,
  LM_SEGMENT_ON_POLYGON,
  LM_SEGMENT_THROUGH_POLYGON,
  LM_CROSSING_POLYGONS,
  LM_OVERLAPPING_POLYGONS
} lm_status_code;

/* "ok", "bad_handle", ..., "crossing_segments"; "unknown" for other numbers. */
LM_API const char* lm_status_name(lm_status status);

typedef enum lm_feature_kind {
  LM_NO_FEATURE = 0,
  LM_POINT = 1,
  LM_LINE = 2, /* a segment or a polyline */
  LM_POLYGON = 3,
  LM_HOLE = 4,
  LM_REGION = 5
} lm_feature_kind;

/* A failure. The pointers are valid until the next failure of the same thread. */
typedef struct lm_error {
  size_t size;
  lm_status status;
  int32_t reserved;
  const char* name;             /* lm_status_name(status) */
  const char* message;          /* a sentence for people */
  const char* file;             /* "" unless the mistake is in a file */
  int64_t line, column;         /* from 1; 0: not known */
  size_t features;              /* the features concerned, the one at fault first */
  const int32_t* feature_kinds; /* lm_feature_kind */
  const int64_t* feature_ids;
  size_t places;    /* the positions concerned */
  const double* at; /* places x 3; z = 0 in the plane */
} lm_error;

/* The last failure of the calling thread; LM_OK in `status` if there was none. */
LM_API lm_status lm_last_error(lm_error* error);

/* --- Arrays --- */

typedef enum lm_type { LM_F64 = 0, LM_I64 = 1, LM_U32 = 2, LM_U8 = 3 } lm_type;

/* rows x columns elements: the element (i, j) is at data + i * stride + j * (size of an element).
 */
typedef struct lm_array {
  size_t size;
  const void* data; /* NULL if there are no rows */
  uint64_t rows;
  uint64_t stride; /* bytes */
  uint32_t columns;
  uint32_t type; /* lm_type */
} lm_array;

/* "No cell", "no point": among neighbours, and where a slot is not in use. */
#define LM_NONE UINT32_MAX

/* --- Watching and stopping --- */

typedef enum lm_phase {
  LM_PHASE_QUADTREE = 0,
  LM_PHASE_STEINER = 1,
  LM_PHASE_TRIANGULATE = 2,
  LM_PHASE_UPDATE = 3
} lm_phase;

typedef struct lm_progress {
  size_t size;
  int32_t phase; /* lm_phase */
  int32_t reserved;
  uint64_t done; /* steps of this phase */
  uint64_t of;   /* steps known to be needed, which may grow; 0: not known */
} lm_progress;

/* Returns 0 to go on, anything else to stop. See rule (6) for the object that calls it. */
typedef int (*lm_progress_callback)(const lm_progress* progress, void* user);

typedef struct lm_control {
  size_t size;
  lm_progress_callback progress; /* NULL: none; called some thousand times a second */
  void* user;
  double interval; /* seconds between calls of `progress`, at least; 0: every time */
  double timeout;  /* seconds; 0: none */
  lm_handle stop;  /* an lm_stop_new(); 0: none */
} lm_control;

/* Something by which another thread stops runs. */
LM_API lm_status lm_stop_new(lm_handle* stop);
/* Runs that have it in their lm_control end with LM_CANCELLED, now and later, and call nobody back.
 */
LM_API lm_status lm_stop_request(lm_handle stop);

/* --- Graphs: the input of a mesh --- */

/* An empty graph. In the plane it holds points, lines and seeds, in space also polygons. */
LM_API lm_status lm_graph_new(int32_t dimension, lm_handle* graph);

/* Adds n points. at: n x d. ids, markers: n, or NULL. first: where to put the first id chosen, or
 * NULL. */
LM_API lm_status lm_graph_add_points(lm_handle graph, size_t n, const double* at,
                                     const int64_t* ids, const int64_t* markers, int64_t* first);
/* Adds n segments. ends: n x 2 ids of points, which lm_mesh_make() looks up. */
LM_API lm_status lm_graph_add_segments(lm_handle graph, size_t n, const int64_t* ends,
                                       const int64_t* ids, const int64_t* markers, int64_t* first);
/* Adds a polyline through n >= 2 points; closed if the last is the first. id: NULL to choose one.
 * added: where to put its id, or NULL. */
LM_API lm_status lm_graph_add_polyline(lm_handle graph, size_t n, const int64_t* points,
                                       const int64_t* id, int64_t marker, int64_t* added);

/* A flat piece of surface. A position in its plane is inside if an odd number of loops go around
 * it; the first loop goes around all others. */
typedef struct lm_polygon {
  size_t size;
  size_t loops;
  const size_t* loop_sizes;    /* `loops` numbers of points, each >= 3 */
  const int64_t* points;       /* the ids of the points of all loops, one loop after the other */
  size_t inner_edges;          /* declared to lie inside */
  const int64_t* edges;        /* inner_edges x 2 */
  size_t inner_points;         /* declared to lie inside */
  const int64_t* loose_points; /* inner_points */
  int64_t marker;
} lm_polygon;

LM_API lm_status lm_graph_add_polygon(lm_handle graph, const lm_polygon* polygon, const int64_t* id,
                                      int64_t* added);
/* Adds n polygons of one loop each. sizes: n numbers of corners, each >= 3, or NULL: all are
 * triangles. corners: ids of points, one polygon after the other. */
LM_API lm_status lm_graph_add_faces(lm_handle graph, size_t n, const size_t* sizes,
                                    const int64_t* corners, const int64_t* ids,
                                    const int64_t* markers, int64_t* first);
/* Adds n triangles with corners at `at`: n x 3 x 3. Corners with equal coordinates are one point,
 * and a point of the graph if there is one. Triangles with two equal corners are left out;
 * first: as above. */
LM_API lm_status lm_graph_add_soup(lm_handle graph, size_t n, const double* at,
                                   const int64_t* markers, int64_t* first);
/* Adds n seeds of holes: what lines (polygons) enclose around them is not meshed. at: n x d. */
LM_API lm_status lm_graph_add_holes(lm_handle graph, size_t n, const double* at, const int64_t* ids,
                                    int64_t* first);
/* Adds n seeds of regions. attributes: n finite numbers, or NULL: 0. limits: the largest measures
 * of cells, 0 for none, or NULL. */
LM_API lm_status lm_graph_add_regions(lm_handle graph, size_t n, const double* at,
                                      const double* attributes, const double* limits,
                                      const int64_t* ids, int64_t* first);

typedef enum lm_graph_field {
  LM_GRAPH_POINTS = 0,        /* n x d F64 */
  LM_GRAPH_POINT_IDS = 1,     /* n I64 */
  LM_GRAPH_POINT_MARKERS = 2, /* n I64 */
  LM_GRAPH_SEGMENTS = 3,      /* s x 2 I64: ids of the ends */
  LM_GRAPH_SEGMENT_IDS = 4,
  LM_GRAPH_SEGMENT_MARKERS = 5,
  LM_GRAPH_POLYLINE_OFFSETS = 6, /* l + 1 I64: line i has the points offsets[i] to offsets[i + 1] */
  LM_GRAPH_POLYLINE_POINTS = 7,  /* I64: ids */
  LM_GRAPH_POLYLINE_IDS = 8,
  LM_GRAPH_POLYLINE_MARKERS = 9,
  LM_GRAPH_POLYGON_OFFSETS = 10, /* p + 1 I64: polygon i has the loops offsets[i] to ... */
  LM_GRAPH_LOOP_OFFSETS = 11,    /* I64: loop i has the points offsets[i] to offsets[i + 1] */
  LM_GRAPH_LOOP_POINTS = 12,     /* I64: ids */
  LM_GRAPH_POLYGON_IDS = 13,
  LM_GRAPH_POLYGON_MARKERS = 14,
  LM_GRAPH_HOLES = 15, /* h x d F64 */
  LM_GRAPH_HOLE_IDS = 16,
  LM_GRAPH_REGIONS = 17, /* r x d F64 */
  LM_GRAPH_REGION_IDS = 18,
  LM_GRAPH_REGION_ATTRIBUTES = 19, /* r F64 */
  LM_GRAPH_REGION_LIMITS = 20,     /* r F64; 0: none */
  /* Declared to lie inside polygons: polygon i has the edges, and points, offsets[i] to ... */
  LM_GRAPH_INNER_EDGE_OFFSETS = 21,  /* p + 1 I64 */
  LM_GRAPH_INNER_EDGES = 22,         /* e x 2 I64: ids of the ends */
  LM_GRAPH_INNER_POINT_OFFSETS = 23, /* p + 1 I64 */
  LM_GRAPH_INNER_POINTS = 24         /* I64: ids */
} lm_graph_field;

LM_API lm_status lm_graph_dimension(lm_handle graph, int32_t* dimension);
LM_API lm_status lm_graph_array(lm_handle graph, int32_t field, lm_array* array);

/* Reads a graph; the extension gives the format: .poly, .node, .geojson, .obj, .vtu, .xyz, .csv, in
 * space also .smesh, .off, .ply, .stl, .vtk. dimension: 2, 3, or 0: that of the file.
 * points_alone: whether only the vertices of surfaces are read. */
LM_API lm_status lm_graph_read(const char* path, int32_t dimension, int32_t points_alone,
                               lm_handle* graph);
/* Writes .poly, in the plane also .obj, in space .smesh: whole, or not at all. */
LM_API lm_status lm_graph_write(lm_handle graph, const char* path);
/* A graph whose lines and polygons meet only at common points, from one where they cross, touch or
 * overlap. domain: as in lm_options, or NULL. tolerance: what is closer is made to touch (0: what
 * rounding does not tell apart), or NULL: 0, in space 2^-20 of the side of the meshing box. Its
 * texts say what was done. */
LM_API lm_status lm_graph_repair(lm_handle graph, const double* domain, const double* tolerance,
                                 lm_handle* repaired);
/* In space: a graph whose polygons of one plane and one marker are merged where they meet. */
LM_API lm_status lm_graph_merge(lm_handle graph, lm_handle* merged);

/* --- Sizes --- */

/* The size at a position of d coordinates: the edge of the largest regular cell there; > 0, perhaps
 * infinite. Anything else is LM_BAD_OPTION of the run. Positions may be outside the domain. */
typedef double (*lm_size_callback)(const double* at, void* user);

/* Sizes that are linear between samples. at: n x d; h: n sizes, > 0 and finite. */
LM_API lm_status lm_sizes_samples(int32_t dimension, size_t n, const double* at, const double* h,
                                  lm_handle* sizes);
/* Sizes by a function that always returns the same, is at least `least` > 0, and changes by at most
 * `slope` >= 0 per unit of length. */
LM_API lm_status lm_sizes_function(int32_t dimension, lm_size_callback size, void* user,
                                   double slope, double least, lm_handle* sizes);
/* Samples from a file: .node with one attribute, or .csv with x, y, (z,) h. */
LM_API lm_status lm_sizes_read(const char* path, int32_t dimension, lm_handle* sizes);
/* The measure of a regular cell with edges of length h. */
LM_API double lm_measure_of_size(int32_t dimension, double h);

/* --- Meshes --- */

typedef enum lm_extent { LM_ENCLOSED = 0, LM_BOX = 1 } lm_extent;
typedef enum lm_algorithm {
  LM_AUTOMATIC = 0,
  LM_REFINE = 1,
  LM_SVR = 2,
  LM_GAP_BALLS = 3 /* that of live meshes */
} lm_algorithm;
typedef enum lm_rule { LM_RADIUS_EDGE = 0, LM_VORONOI_ASPECT = 1 } lm_rule;

/* Limits of size in a closed box; where boxes overlap, the last counts. */
typedef struct lm_box_limits {
  size_t size;
  double lo[3], hi[3];
  double max_measure; /* 0: no limit */
  lm_handle sizes;    /* 0: none */
} lm_box_limits;

/* As mesher::Options. 0 is always the default. */
typedef struct lm_options {
  size_t size;
  double domain_lo[3], domain_hi[3]; /* the box in which points may lie; all 0: around the input */
  double rho;                        /* bound of circumradius over shortest edge, above 1.01 */
  double min_angle;                  /* degrees, at most 29.6: in place of rho */
  double min_dihedral;               /* degrees, at most 20, in space; 0: any */
  double max_measure;                /* the largest measure of a cell */
  lm_handle sizes;                   /* sizes that vary */
  uint64_t max_vertices;
  int32_t extent;        /* lm_extent: what lines (polygons) enclose, or all of the box */
  int32_t algorithm;     /* lm_algorithm */
  int32_t rule;          /* lm_rule */
  int32_t region_limits; /* whether the limits of regions count */
  int32_t no_flat;       /* in space, for lm_mesh_make: whether flat tetrahedra are removed, where
                            that is possible (mesher/improve.hpp) */
  int32_t threads;       /* of live meshes, and with out_of_core; at most 256;
                            0: one */
  size_t box_limits_count;
  const lm_box_limits* box_limits;
  double growth; /* of sizes from one cell to the next, 1.05 to 100; 0: any. Not for live meshes */
  size_t periodic_count;   /* pairs of sides that fit together (mesher/periodic.hpp), for */
  const int64_t* periodic; /* lm_mesh_make in the plane: periodic_count x 2 markers of lines */
  const char* out_of_core; /* lm_mesh_make, points alone: a folder, in which they are meshed tile
                              after tile (mesher/out_of_core.hpp); NULL: in memory, at once */
  uint64_t tiles;          /* then: how many, 0: by the number of points; threads: at a time */
} lm_options;

/* Meshes a graph, once. options, control: may be NULL. With options->out_of_core the mesh is that
 * of LM_GAP_BALLS, for much less memory; a call that is stopped, fails or is killed leaves tiles in
 * the folder, with which one for the same points and options goes on. */
LM_API lm_status lm_mesh_make(lm_handle graph, const lm_options* options, const lm_control* control,
                              lm_handle* mesh);

typedef enum lm_mesh_field {
  LM_MESH_POINTS = 0,         /* n x d F64, in lexicographic order */
  LM_MESH_CELLS = 1,          /* m x (d + 1) U32, positively oriented */
  LM_MESH_NEIGHBORS = 2,      /* m x (d + 1) U32: the cells across from the corners, or LM_NONE */
  LM_MESH_POINT_KINDS = 3,    /* n U8: 0 Steiner, 1 on the boundary grid, 2 input, 3 on a line */
  LM_MESH_POINT_MARKERS = 4,  /* n I64; 0: none */
  LM_MESH_POINT_FEATURES = 5, /* n U8: lm_feature_kind that the point is or lies on */
  LM_MESH_POINT_FEATURE_IDS = 6,  /* n I64 */
  LM_MESH_CELL_REGIONS = 7,       /* m F64: the attribute of the region; 0: none */
  LM_MESH_FACETS = 8,             /* f x d U32, on lines (polygons) or on the boundary */
  LM_MESH_FACET_MARKERS = 9,      /* f I64; 1 on the boundary, if it has no other */
  LM_MESH_FACET_FEATURES = 10,    /* f U8: lm_feature_kind, LM_NO_FEATURE: not known */
  LM_MESH_FACET_FEATURE_IDS = 11, /* f I64 */
  LM_MESH_EDGES = 12,             /* e x 2 U32: on lines, as in the plane; in space beside facets */
  LM_MESH_EDGE_MARKERS = 13,
  LM_MESH_EDGE_FEATURES = 14,
  LM_MESH_EDGE_FEATURE_IDS = 15,
  LM_MESH_POINT_SLOTS = 16, /* n U32, of a mesh from lm_live_mesh(); else no rows */
  LM_MESH_CELL_SLOTS = 17,
  /* Of each pair of periodic sides the markers, p x 2 I64, and the translation, p x 3 F64. Pair i
   * has the twins offsets[i] to offsets[i + 1]: k x 2 U32, points of the first side, of the other.
   */
  LM_MESH_PERIODIC_MARKERS = 18,
  LM_MESH_PERIODIC_TRANSLATIONS = 19,
  LM_MESH_PERIODIC_OFFSETS = 20, /* p + 1 I64 */
  LM_MESH_PERIODIC_POINTS = 21
} lm_mesh_field;

typedef enum lm_measure {
  LM_CELL_MEASURE = 0,      /* area or volume */
  LM_RADIUS_EDGE_RATIO = 1, /* circumradius over shortest edge */
  LM_MIN_ANGLE = 2,         /* degrees; of a tetrahedron: of its faces */
  LM_MAX_ANGLE = 3,
  LM_MIN_DIHEDRAL = 4, /* degrees, in space */
  LM_MAX_DIHEDRAL = 5
} lm_measure;

typedef struct lm_mesh_info {
  size_t size;
  int32_t dimension;
  int32_t algorithm; /* that made it; LM_AUTOMATIC: read from a file */
  uint64_t points, cells;
  int32_t keeps_all; /* whether nothing was enclosed, or the whole box was requested */
  int32_t order;     /* 1, or 2: from lm_mesh_second_order() */
} lm_mesh_info;

LM_API lm_status lm_mesh_describe(lm_handle mesh, lm_mesh_info* info);
LM_API lm_status lm_mesh_array(lm_handle mesh, int32_t field, lm_array* array);
/* One F64 for each cell. measure: lm_measure. */
LM_API lm_status lm_mesh_quality(lm_handle mesh, int32_t measure, lm_array* array);
/* Writes .node (with .ele and others beside it), .vtu, .vtk, .msh, .inp, .su2, .mesh, .off, .obj,
 * .svg, in space also .stl: whole, or not at all. */
LM_API lm_status lm_mesh_write(lm_handle mesh, const char* path);

typedef enum lm_name_kind {
  LM_NAME_FACETS = 0, /* of a marker of facets */
  LM_NAME_EDGES = 1,  /* in space: of a marker of edges */
  LM_NAME_CELLS = 2   /* of a region */
} lm_name_kind;

/* The name of a group in .msh, .inp and .su2, of faces in space also in .stl and .obj: 1 to 80
 * bytes without blanks and quotes (mesher/names.hpp). */
typedef struct lm_name {
  size_t size;
  int32_t kind; /* lm_name_kind */
  int32_t reserved;
  int64_t marker; /* of facets or edges */
  double region;  /* of cells: the attribute */
  const char* name;
} lm_name;

typedef struct lm_write_options {
  size_t size;
  int32_t msh_version; /* of .msh: 41, or 22; 0: 41 */
  int32_t only_these;  /* whether the names that the mesh has itself are left out */
  size_t names_count;  /* names that count before those that the mesh has */
  const lm_name* names;
} lm_write_options;

/* As lm_mesh_write(); a mesh of second order also so. options: may be NULL. */
LM_API lm_status lm_mesh_write_as(lm_handle mesh, const char* path,
                                  const lm_write_options* options);
/* The names that a mesh has from its graph's file, or its own: those of facets, edges, cells. */
LM_API lm_status lm_mesh_name_count(lm_handle mesh, size_t* count);
LM_API lm_status lm_mesh_name_get(lm_handle mesh, size_t i, lm_name* name);

/* The mesh of second order: its points are those of `mesh`, then the midpoints of edges, which stay
 * straight. LM_MESH_CELLS has 6 columns (d = 3: 10), LM_MESH_FACETS 3 (6), LM_MESH_EDGES 3:
 * corners, then midpoints in the order of VTK; all else is as in `mesh`. A mesh of second order
 * gives its like. */
LM_API lm_status lm_mesh_second_order(lm_handle mesh, lm_handle* second);
/* Reads .node or .ele, .vtu, .vtk, .msh, .mesh, .off, .obj. dimension: 2, 3, or 0: that of the
 * file. */
LM_API lm_status lm_mesh_read(const char* path, int32_t dimension, lm_handle* mesh);

typedef enum lm_boundary {
  LM_BOUNDARY_AUTOMATIC = 0,
  LM_BOUNDARY_BOX = 1,
  LM_BOUNDARY_LINES = 2,
  LM_BOUNDARY_ANY = 3
} lm_boundary;

typedef struct lm_check_options {
  size_t size;
  lm_handle graph;       /* the input; 0: not checked against it */
  double rho;            /* 0: quality is not checked */
  double max_measure;    /* 0: likewise */
  int32_t boundary;      /* lm_boundary: where facets with one cell may be */
  int32_t near_delaunay; /* in space: whether Delaunay up to rounding is enough, as for no_flat */
} lm_check_options;

typedef struct lm_finding {
  size_t size;
  const char* property; /* "coordinates", "delaunay", ... */
  const char* detail;   /* the first violation, or what was checked */
  int32_t holds;
  int32_t reserved;
} lm_finding;

/* Checks a mesh by means that share nothing with those that made it, as mesher/check.hpp says.
 * options: may be NULL. count: the number of findings. */
LM_API lm_status lm_mesh_check(lm_handle mesh, const lm_check_options* options, lm_handle* findings,
                               size_t* count);
LM_API lm_status lm_finding_get(lm_handle findings, size_t i, lm_finding* finding);

/* --- Live meshes --- */

/* A mesh that follows edits. Edits are announced, and judged together by lm_live_update(): all of
 * them are made, or none. options: with a domain; the algorithm is gap-balls. */
LM_API lm_status lm_live_new(int32_t dimension, const lm_options* options, lm_handle* live);

/* Announcements. A call with a mistake announces nothing, and leaves earlier ones. Exception: out
 * of memory discards all of them. Arguments are as for graphs. */
LM_API lm_status lm_live_add_points(lm_handle live, size_t n, const double* at, const int64_t* ids,
                                    const int64_t* markers, int64_t* first);
/* Points may swap positions, and move in chains; ids must be distinct. */
LM_API lm_status lm_live_move_points(lm_handle live, size_t n, const int64_t* ids,
                                     const double* at);
LM_API lm_status lm_live_remove_points(lm_handle live, size_t n, const int64_t* ids);
LM_API lm_status lm_live_add_segments(lm_handle live, size_t n, const int64_t* ends,
                                      const int64_t* ids, const int64_t* markers, int64_t* first);
LM_API lm_status lm_live_add_polyline(lm_handle live, size_t n, const int64_t* points,
                                      const int64_t* id, int64_t marker, int64_t* added);
LM_API lm_status lm_live_remove_lines(lm_handle live, size_t n, const int64_t* ids);
LM_API lm_status lm_live_add_polygon(lm_handle live, const lm_polygon* polygon, const int64_t* id,
                                     int64_t* added);
LM_API lm_status lm_live_remove_polygons(lm_handle live, size_t n, const int64_t* ids);
LM_API lm_status lm_live_add_holes(lm_handle live, size_t n, const double* at, const int64_t* ids,
                                   int64_t* first);
LM_API lm_status lm_live_remove_holes(lm_handle live, size_t n, const int64_t* ids);
LM_API lm_status lm_live_add_regions(lm_handle live, size_t n, const double* at,
                                     const double* attributes, const double* limits,
                                     const int64_t* ids, int64_t* first);
LM_API lm_status lm_live_remove_regions(lm_handle live, size_t n, const int64_t* ids);
/* Announces all of a graph, with its ids. If that fails, all announcements are discarded. */
LM_API lm_status lm_live_add_graph(lm_handle live, lm_handle graph);
/* Announces limits of size in place of all earlier ones; or in a box, 2 x d: lo, hi. sizes: 0 for
 * none. */
LM_API lm_status lm_live_limit(lm_handle live, double max_measure, lm_handle sizes,
                               const double* box);
/* Discards all announcements. */
LM_API lm_status lm_live_discard(lm_handle live);

/* Makes the announced edits. change: where to put a handle of the change, or NULL; 0 if the edits
 * were made, but there is no memory to tell how. LM_CANCELLED leaves the edits announced: another
 * update goes on with them. Any other failure discards them. Both leave the mesh as it was. */
LM_API lm_status lm_live_update(lm_handle live, const lm_control* control, lm_handle* change);

/* How many updates can be undone: the last `depth`; by default 0. Costs memory for the features
 * that an edit touches. Limits of size are not undone. */
LM_API lm_status lm_live_keep_undo(lm_handle live, size_t depth);
/* Undoes the last update that was not undone yet: an update by the reverse edits. Requires: no
 * announcements. LM_NOTHING_TO_UNDO if there is none. A failure leaves everything as it was. */
LM_API lm_status lm_live_undo(lm_handle live, const lm_control* control, lm_handle* change);

typedef struct lm_live_info {
  size_t size;
  int32_t dimension;
  int32_t pending;      /* whether edits are announced */
  uint64_t point_slots; /* the lengths of arrays by slot, with free slots */
  uint64_t cell_slots;
  uint64_t points, cells; /* in use, in the mesh of the box */
  uint64_t updates;       /* that have been made */
  uint64_t undoable;      /* that can be undone */
  uint64_t trace_bytes;
  double domain_lo[3], domain_hi[3];
} lm_live_info;

LM_API lm_status lm_live_describe(lm_handle live, lm_live_info* info);

/* Arrays of the mesh of the box by slot. A point, cell, facet or edge has one slot, from the update
 * that adds it to the one that removes it; a free slot shows what it held last. */
typedef enum lm_live_field {
  LM_LIVE_POINTS = 0,      /* n x d F64 */
  LM_LIVE_POINT_KINDS = 1, /* n U8, as LM_MESH_POINT_KINDS */
  LM_LIVE_CELLS = 2,       /* m x (d + 1) U32: slots of points */
  LM_LIVE_NEIGHBORS = 3,   /* m x (d + 1) U32: slots of cells across from corners, or LM_NONE */
  LM_LIVE_POINT_USED = 4,  /* n U8: 1 if the slot is in use */
  LM_LIVE_CELL_USED = 5,   /* m U8 */
  LM_LIVE_CELL_KEPT = 6, /* m U8: 1 if it is in use and lines (polygons) enclose it, as lm_extent */
  LM_LIVE_FACETS = 7,    /* f x d U32: on lines (polygons) */
  LM_LIVE_FACET_FEATURES = 8,    /* f U8: lm_feature_kind */
  LM_LIVE_FACET_FEATURE_IDS = 9, /* f I64 */
  LM_LIVE_FACET_USED = 10        /* f U8 */
} lm_live_field;

/* Valid until the next update. For rule (6) this counts as a change. Fields 4 to 6 and 8 to 10 are
 * made at the first request, and then cost a part of each update. */
LM_API lm_status lm_live_array(lm_handle live, int32_t field, lm_array* array);
/* The attributes of the regions of n cells in use, by slot; 0: none. attributes: n. */
LM_API lm_status lm_live_regions(lm_handle live, size_t n, const uint32_t* cells,
                                 double* attributes);
/* The slots of the points at n positions, LM_NONE where there is none. at: n x d, finite; slots:
 * n. */
LM_API lm_status lm_live_find(lm_handle live, size_t n, const double* at, uint32_t* slots);
/* Whether n features exist, announced edits included. kind: lm_feature_kind; exist: n. */
LM_API lm_status lm_live_contains(lm_handle live, int32_t kind, size_t n, const int64_t* ids,
                                  uint8_t* exist);
/* The enclosed part of the mesh, without free slots, in canonical order, with LM_MESH_POINT_SLOTS
 * and LM_MESH_CELL_SLOTS. It does not follow edits. */
LM_API lm_status lm_live_mesh(lm_handle live, lm_handle* mesh);
/* The graph of the last update. */
LM_API lm_status lm_live_graph(lm_handle live, lm_handle* graph);

/* --- Changes --- */

typedef struct lm_change_info {
  size_t size;
  int32_t dimension;
  int32_t reserved;
  uint64_t point_slots, cell_slots; /* after the update */
  uint64_t executed, reused;        /* calls of the program behind the mesh */
  uint64_t point_slots_before;      /* before the update */
} lm_change_info;

typedef enum lm_change_field {
  LM_CHANGE_POINTS_ADDED = 0, /* U32: slots */
  LM_CHANGE_POINTS_REMOVED = 1,
  LM_CHANGE_CELLS_ADDED = 2, /* of the mesh of the box */
  LM_CHANGE_CELLS_REMOVED = 3,
  LM_CHANGE_KEPT_ADDED = 4, /* cells that are enclosed now and were not before */
  LM_CHANGE_KEPT_REMOVED = 5,
  LM_CHANGE_FACETS_ADDED = 6, /* on lines (polygons) */
  LM_CHANGE_FACETS_REMOVED = 7,
  LM_CHANGE_FROM = 8,    /* by POINTS_ADDED, x (d + 1) U32: points before around a new point */
  LM_CHANGE_WEIGHTS = 9, /* likewise, F64: sum 1; all 0 (and LM_NONE) if there was no mesh */
  LM_CHANGE_POINTS_ADDED_AT = 10, /* by POINTS_ADDED, x d F64 */
  LM_CHANGE_POINTS_REMOVED_AT = 11,
  LM_CHANGE_KINDS_CHANGED = 12 /* points that stay with another kind */
} lm_change_field;

LM_API lm_status lm_change_describe(lm_handle change, lm_change_info* info);
LM_API lm_status lm_change_array(lm_handle change, int32_t field, lm_array* array);
/* Carries a field by point slots through the change: points that stay keep their values, new ones
 * get values interpolated in the mesh before. before: rows_before x columns, with
 * point_slots_before <= rows_before; after: rows_after x columns, of which the first rows_before
 * are `before` (the same memory, or a copy that the caller made) and point_slots <= rows_after.
 * Only the rows of new points are written. Cost: that of the change. */
LM_API lm_status lm_change_transfer(lm_handle change, size_t columns, const double* before,
                                    size_t rows_before, double* after, size_t rows_after);

/* --- Texts --- */

/* What there is to tell of a graph (repairs, data in its file that is not used), a mesh or a live
 * mesh (seeds without a region of their own): sentences for people. */
LM_API lm_status lm_text_count(lm_handle object, size_t* count);
LM_API lm_status lm_text_get(lm_handle object, size_t i, const char** text);

#ifdef __cplusplus
}
#endif

#endif
