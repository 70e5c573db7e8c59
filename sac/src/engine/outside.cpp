// Objects of the outside: made, released, freed.
#include "sac/engine.hpp"
#include "sac/mod.hpp"

namespace sac {

Handle Engine::new_outside(const OutsideType& type) {
  if (outside_.size() == outside_.capacity()) outside_.reserve(2 * outside_.size() + 16);
  const std::uint16_t number = outside_types_.number(type);
  const Handle head = arena().allocate(type.bytes);
  ::new (static_cast<void*>(outside_head(head)))
      OutsideHead{static_cast<std::uint32_t>(outside_.size()), number, false};
  outside_.push_back(head);
  return head;
}

void Engine::release_outside(void* object, const char* kind) {
  begin_edit("release");
  const Handle head = arena().handle_of(static_cast<OutsideHead*>(object) - 1);
  const bool known = arena().contains(object) && outside_head(head)->position < outside_.size() &&
                     outside_[outside_head(head)->position] == head;
  if (!known) throw UsageError(std::string("release: the outside has not made this ") + kind);
  if (outside_head(head)->released) {
    const Handle handle = arena().handle_of(object);
    const std::string name = core_.settings.names.contains(handle)
                                 ? describe_mod(handle)
                                 : std::string(kind) + " @" + std::to_string(handle);
    throw UsageError("release: " + name + " has been released already");
  }
  if (released_.size() == released_.capacity()) released_.reserve(2 * released_.size() + 16);
  on_rollback([this] {
    outside_head(released_.back())->released = false;
    released_.pop_back();
  });
  outside_head(head)->released = true;
  released_.push_back(head);
}

void Engine::require_unused() const {
  constexpr Handle kHead = sizeof(OutsideHead) / Arena::kGranule;
  for (const Handle h : released_) {
    const std::size_t bytes = outside_types_[outside_head(h)->type].bytes;
    const ModStructure::Use use = mods_->use_within(h + kHead, bytes - sizeof(OutsideHead));
    if (use.call == nullptr) continue;
    throw UsageError("release: " + describe(*use.call) + (use.writes ? " writes " : " reads ") +
                     describe_mod(use.head) + ", which has been released");
  }
}

void Engine::free_released() noexcept {
  for (const Handle h : released_) free_outside(h);
  released_.clear();
}

void Engine::free_outside(Handle h) noexcept {
  OutsideHead& head = *outside_head(h);
  const OutsideType& type = outside_types_[head.type];
  outside_[head.position] = outside_.back();
  outside_head(outside_.back())->position = head.position;
  outside_.pop_back();
  type.destroy(&head + 1);
  core_.forget_names(h, type.bytes);
  arena().release(h, type.bytes);
}

}  // namespace sac
