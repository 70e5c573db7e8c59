// Queries: the table of their labels, and requests that have found no value.
#include "sac/query.hpp"

#include <algorithm>
#include <sstream>

#include "sac/internal/chain.hpp"

namespace sac {

using detail::FirstRequest;
using detail::Query;
using Requests = detail::Chain<FirstRequest, &FirstRequest::previous, &FirstRequest::next>;

Queries::Queries(Engine& engine) : engine_(engine), id_(engine.add_structure(*this)) {}

// --- Requests --------------------------------------------------------------------------------

void Queries::ask_first(Scope& s, Query& query) {
  const Ref<Query> asked = Arena::ref(query);
  const auto same = [&](const FirstRequest& e) { return e.query == asked; };
  const Place place = s.place();
  if (s.recall<FirstRequest>(id_, kFirst, same, Scope::kMostRecalled) == nullptr) {
    auto& edge = s.observe<FirstRequest>(id_, kFirst);
    edge.place = place;
    edge.query = asked;
    Requests::push(engine_.arena(), query.first, edge);
  }
  // An earlier request has been answered since, unless this one is made for its answer, or the
  // running call has caught what that has thrown: its next call will say so.
  Requests::for_each(engine_.arena(), query.first, [&](const FirstRequest& other) {
    if (engine_.precedes(engine_.time(other.place), engine_.time(place))) {
      require_no_cycle(s.self(), query);
    }
  });
}

void Queries::answered(Scope& s, const Query& query) {
  if (engine_.appending()) return;
  const TimeNode& here = engine_.time(s.place());
  Requests::for_each(engine_.arena(), query.first, [&](const FirstRequest& other) {
    if (engine_.precedes(here, engine_.time(other.place))) {
      engine_.invalidate(other.place, &other);
    }
  });
}

void Queries::retract(Call&, Edge& edge) noexcept {
  const auto& gone = static_cast<const FirstRequest&>(edge);
  Query& query = at(gone.query);
  Requests::remove(engine_.arena(), query.first, gone);
  suspect(query);
}

bool Queries::unchanged(Call&, Edge& edge) {
  const auto& first = static_cast<const FirstRequest&>(edge);
  return !engine_.mods().is_written_before(first.place, at(first.query).answer);
}

// Not all of the calls around the running one run themselves: in a propagation perhaps none does.
void Queries::require_no_cycle(const Call& running, const Query& query) const {
  std::ostringstream asked;
  query.type->print(query, asked);
  std::vector<detail::QueryName> path{{&query, asked.str()}};
  for (const Call* c = &running;;) {
    if (c->function().query != nullptr) {
      path.push_back({c->function().query(*c), Engine::describe(*c)});
    }
    const Call* around = &engine_.core().parent_of(*c);
    if (around == c) break;
    c = around;
  }
  std::reverse(path.begin(), path.end());
  detail::require_no_cycle(path);
}

// A run from scratch fails at the first query that comes again. Which query of a cycle is asked for
// first depends on the edit: the message begins with the least name.
void detail::require_no_cycle(const std::vector<QueryName>& path) {
  const auto name_order = [](const QueryName& a, const QueryName& b) { return a.name < b.name; };
  for (auto last = path.begin(); last != path.end(); ++last) {
    const auto first = std::find_if(path.begin(), last,
                                    [&](const QueryName& q) { return q.query == last->query; });
    if (first == last) continue;
    std::vector<QueryName> cycle(first, last);
    std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end(), name_order),
                cycle.end());
    std::string text;
    for (const QueryName& q : cycle) text += q.name + " asks for ";
    throw UsageError("a query needs its own result: " + text + cycle.front().name);
  }
}

void detail::fail_unequal(std::string_view function) {
  throw UsageError("an argument of the query " + std::string(function) +
                   " does not equal itself: it could not be found again");
}

// --- The table -------------------------------------------------------------------------------

Query* Queries::find(const Query::Type& type, std::uint32_t hash, const void* args) {
  if (table_.empty()) return nullptr;
  for (Query* q = bucket(hash); q != nullptr; q = q->next) {
    if (q->hash == hash && q->type == &type && type.equal(*q, args)) return q;
  }
  return nullptr;
}

// Makes room for one more.
void Queries::reserve() {
  if (size_ < table_.size()) return;
  std::vector<Query*> old(table_.empty() ? 16 : 2 * table_.size());
  old.swap(table_);
  for (Query* q : old) {
    while (q != nullptr) {
      Query& query = *std::exchange(q, q->next);
      query.next = std::exchange(bucket(query.hash), &query);
    }
  }
}

void Queries::enter(Query& query) noexcept {
  query.next = std::exchange(bucket(query.hash), &query);
  ++size_;
  suspect(query);
}

void Queries::leave(Query& query) noexcept {
  Query** link = &bucket(query.hash);
  while (*link != &query) link = &(*link)->next;
  *link = query.next;
  --size_;
}

// To be looked at when the run or propagation has ended: a query that nobody is the first to ask
// for has no value, and goes.
void Queries::suspect(Query& query) noexcept {
  if (query.suspected) return;
  query.suspected = true;
  query.next_unused = std::exchange(unused_, &query);
}

bool Queries::is_unused(const Query& query) const noexcept {
  return query.first == nullptr && engine_.mods().is_unused(query.answer);
}

void Queries::finished() noexcept {
  while (unused_ != nullptr) {
    Query& query = *std::exchange(unused_, unused_->next_unused);
    query.suspected = false;
    if (!is_unused(query)) continue;
    leave(query);
    query.type->destroy(engine_, query);
  }
}

// --- For people, and checks --------------------------------------------------------------------

void Queries::label(const Call&, const Edge&, LabelSink& sink) const { sink.text("asks first"); }

void Queries::print(const Call&, const Edge& edge, std::ostream& out) const {
  out << "is the first to ask for ";
  const Query& query = at(static_cast<const FirstRequest&>(edge).query);
  query.type->print(query, out);
}

void Queries::check_invariants() const {
  SAC_INVARIANT(unused_ == nullptr);
  std::size_t size = 0;
  for (const Query* q : table_) {
    for (; q != nullptr; q = q->next) {
      ++size;
      SAC_INVARIANT(!is_unused(*q));
      SAC_INVARIANT(q->first != nullptr && at(q->first).next == nullptr);
      SAC_INVARIANT(!engine_.mods().is_written_before(at(q->first).place, q->answer));
    }
  }
  SAC_INVARIANT(size == size_);
}

}  // namespace sac
