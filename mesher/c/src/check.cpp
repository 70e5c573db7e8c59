// Checks of meshes, and texts of objects.
#include "mesher/check.hpp"

#include <optional>
#include <string>
#include <vector>

#include "graph.hpp"
#include "mesh.hpp"

namespace lm {
namespace {

struct FindingsObject final : Object {
  explicit FindingsObject(std::vector<mesher::Finding> of) : all(std::move(of)) {}
  const std::vector<mesher::Finding> all;
};

mesher::BoundaryRule rule_of(std::int32_t boundary) {
  switch (boundary) {
    case LM_BOUNDARY_BOX:
      return mesher::BoundaryRule::box;
    case LM_BOUNDARY_LINES:
      return mesher::BoundaryRule::lines;
    case LM_BOUNDARY_ANY:
      return mesher::BoundaryRule::any;
    default:
      throw Failure(LM_BAD_ARGUMENT, "options->boundary is " + std::to_string(boundary));
  }
}

template <int D>
std::vector<mesher::Finding> findings(const mesher::MeshData<D>& mesh, const GraphObject* input,
                                      const lm_check_options& given) {
  mesher::CheckOptions<D> options;
  if (input != nullptr) {
    options.graph = &file_in<D>(*input);
    require_points(options.graph->graph);
  }
  if (given.rho != 0) options.rho = given.rho;
  if (given.max_measure != 0) options.max_measure = given.max_measure;
  if (!mesh.features.empty()) options.features = &mesh.features;
  if constexpr (D == 3) options.near_delaunay = given.near_delaunay != 0;
  options.boundary = given.boundary == LM_BOUNDARY_AUTOMATIC
                         ? mesher::boundary_rule(mesh, options.graph)
                         : rule_of(given.boundary);
  return mesher::check_mesh(mesh, options);
}

}  // namespace
}  // namespace lm

using namespace lm;

lm_status lm_mesh_check(lm_handle mesh, const lm_check_options* options, lm_handle* found,
                        size_t* count) {
  return guarded([&] {
    require_pointer(found, "findings");
    lm_check_options given{};
    if (options != nullptr) given = read_struct(options, "options");
    if (!(given.rho >= 0) || !(given.max_measure >= 0)) {
      throw Failure(LM_BAD_ARGUMENT, "options->rho and options->max_measure must be 0 or above");
    }
    const Reading<MeshObject> object(mesh);
    std::optional<Reading<GraphObject>> graph;
    if (given.graph != 0) graph.emplace(given.graph);
    auto all = std::visit(
        [&](const auto& in) { return findings(in->corners(), graph ? &**graph : nullptr, given); },
        object->mesh);
    const std::size_t size = all.size();
    make_object<FindingsObject>(found, std::move(all));
    if (count != nullptr) *count = size;
  });
}

lm_status lm_finding_get(lm_handle findings, size_t i, lm_finding* finding) {
  return guarded([&] {
    require_struct(finding, "finding");
    const Reading<FindingsObject> object(findings);
    if (i >= object->all.size()) throw Failure(LM_BAD_ARGUMENT, "there is no finding i");
    const mesher::Finding& found = object->all[i];
    lm_finding all{};
    all.property = found.property.c_str();
    all.detail = found.detail.c_str();
    all.holds = found.holds;
    give_struct(all, finding);
  });
}

namespace {

const std::vector<std::string>& texts_of(Object& object) {
  const auto* texts = object.texts();
  if (texts == nullptr) throw Failure(LM_BAD_HANDLE, "this kind of object has no texts");
  return *texts;
}

}  // namespace

lm_status lm_text_count(lm_handle object, size_t* count) {
  return guarded([&] {
    require_pointer(count, "count");
    *count = texts_of(*Reading<Object>(object)).size();
  });
}

lm_status lm_text_get(lm_handle object, size_t i, const char** text) {
  return guarded([&] {
    require_pointer(text, "text");
    const Reading<Object> of(object);
    const auto& texts = texts_of(*of);
    if (i >= texts.size()) throw Failure(LM_BAD_ARGUMENT, "there is no text i");
    *text = texts[i].c_str();
  });
}

lm_status lm_free(lm_handle object) {
  return guarded([&] {
    if (object != 0) remove_object(object);
  });
}

uint64_t lm_objects(void) { return count_objects(); }
uint32_t lm_abi_version(void) { return LM_ABI_VERSION; }
const char* lm_version(void) { return LM_VERSION; }
