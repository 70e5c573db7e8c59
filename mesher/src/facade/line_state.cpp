// Edits of lines: segments between points that are there, that go, or that come.
#include "facade/line_state.hpp"

#include <optional>

#include "geometry/input_point.hpp"
#include "program/plane_input.hpp"
#include "program/space_input.hpp"
#include "program/world_impl.hpp"
#include "text/id_text.hpp"

namespace mesher::detail {

namespace {

// `points`: null for those of no line.
template <class Visit>
void for_each_part(const LinePoints* points, Visit&& visit) {
  if (points == nullptr) return;
  for (std::size_t i = 1; i < points->size(); ++i) visit((*points)[i - 1], (*points)[i]);
}

}  // namespace

void fail_in_use(PointId point, const std::string& what, const mesher::Feature& user,
                 std::vector<Position> places) {
  throw Error(ErrorCode::point_in_use,
              "point " + id_text(point) + " cannot go: it is " + what + " " + text_of(user), {},
              {mesher::Feature(point), user}, std::move(places));
}

template <int D>
const SegmentStoreOf<D>& LineState<D>::segments() const noexcept {
  if constexpr (D == 2) {
    return world_->segments.store();
  } else {
    return world_->plc.store().segments();
  }
}

// --- Single segments -------------------------------------------------------------------------

template <int D>
void LineState<D>::take_segment(const SegmentOf<D>& s) {
  segment_names_.take(s.self);
  erase_segment(*world_, s);
}

template <int D>
void LineState<D>::add_segment(const Part& part) {
  const auto end = [&](PointId id) {
    const VertexHandle v = this->point_with(id);
    return v != 0 ? v : fail_no_end(id, part.line);
  };
  const VertexHandle a = end(part.from);
  const VertexHandle b = end(part.to);
  const SegmentOf<D>& s = detail::add_segment(*world_, part.line, a, b, *this);
  segment_names_.add(s.self, part.line);
}

// --- All of an update ------------------------------------------------------------------------

template <int D>
void LineState<D>::take_edited(const Edits<D>& edits) {
  edits.lines.for_each_edit([&](LineId id, const LinePoints* was, const LinePoints* is) {
    for_each_part(
        was, [&](PointId a, PointId b) { take_segment(*segments().find(ids_.at(a), ids_.at(b))); });
    for_each_part(is, [&](PointId a, PointId b) { noted_.push_back({id, a, b}); });
  });
}

template <int D>
void LineState<D>::take_at(VertexHandle v, const Edits<D>&) {
  std::vector<const SegmentOf<D>*> all;
  segments().visit_at(v, [&](const SegmentOf<D>& s) {
    if (segment_names_.find(s.self)) all.push_back(&s);
  });
  for (const SegmentOf<D>* s : all) {
    noted_.push_back({*segment_names_.find(s->self), names_[s->a], names_[s->b]});
    take_segment(*s);
  }
}

template <int D>
void LineState<D>::require_unused(PointId id, VertexHandle v) const {
  std::optional<LineId> user;
  segments().visit_at(v, [&](const SegmentOf<D>& s) {
    if (const auto line = segment_names_.find(s.self); line && (!user || *line < *user)) {
      user = line;
    }
  });
  if (user) fail_in_use(id, "an end of", *user, places_of(this->place(id)));
}

template <int D>
void LineState<D>::add_noted() {
  for (const Part& part : noted_) add_segment(part);
}

template <int D>
void LineState<D>::add_features_first(const Edits<D>& edits) {
  take_edited(edits);
  add_noted();
  if (segments().live() == 0) return;
  require_fit();
  prepare_names();
  commit_names();
  discard_news();
}

template <int D>
void LineState<D>::make_edits(const Edits<D>& edits) {
  if (edits.limits)
    edit_limits(*world_, edits.limits->options, edits.limits->where, *this->engine_);
  take_edited(edits);
  for (const auto& edit : edits.points) {
    if (edit.was && edit.to) take_at(ids_.at(edit.id), edits);
  }
  for (const auto& edit : edits.points) {
    if (edit.was && !edit.to) require_unused(edit.id, ids_.at(edit.id));
  }
  this->make_points(edits.points);
  add_noted();
  if (segments().live() != 0) require_fit();
}

template <int D>
void LineState<D>::discard_news() noexcept {
  segment_names_.discard();
  noted_ = std::vector<Part>();
}

template class LineState<2>;
#ifndef MESHER_PLANE_ONLY
template class LineState<3>;
#endif

}  // namespace mesher::detail
