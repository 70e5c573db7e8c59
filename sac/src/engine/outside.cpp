// Objects of the outside: made, released, freed.
#include "sac/engine.hpp"
#include "sac/mod.hpp"

namespace sac {

Ref<Engine::OutsideHead> Engine::new_outside(const OutsideType& type) {
  if (outside_.size() == outside_.capacity()) outside_.reserve(2 * outside_.size() + 16);
  const std::uint16_t number = outside_types_.number(type);
  const Ref<OutsideHead> head(arena().allocate(type.bytes));
  ::new (static_cast<void*>(&arena()[head]))
      OutsideHead{static_cast<std::uint32_t>(outside_.size()), number, false};
  outside_.push_back(head);
  return head;
}

void Engine::release_outside(void* object, const char* kind) {
  begin_edit("release");
  OutsideHead& head = static_cast<OutsideHead*>(object)[-1];
  const bool known = arena().contains(object) && head.position < outside_.size() &&
                     outside_[head.position] == Arena::ref(head);
  if (!known) throw UsageError(std::string("release: the outside has not made this ") + kind);
  if (head.released) {
    const Handle handle = arena().handle_of(object);
    const std::string name = settings.names.contains(handle)
                                 ? describe_mod(ModRef(handle))
                                 : std::string(kind) + " @" + std::to_string(handle);
    throw UsageError("release: " + name + " has been released already");
  }
  if (released_.size() == released_.capacity()) released_.reserve(2 * released_.size() + 16);
  on_rollback([this] {
    arena()[released_.back()].released = false;
    released_.pop_back();
  });
  head.released = true;
  released_.push_back(Arena::ref(head));
}

void Engine::require_unused() const {
  constexpr Handle kHead = sizeof(OutsideHead) / Arena::kGranule;
  for (const Ref<OutsideHead> object : released_) {
    const std::size_t bytes = outside_types_[arena()[object].type].bytes;
    const ModStructure::Use use =
        mods_->use_within(object.handle() + kHead, bytes - sizeof(OutsideHead));
    if (use.call == nullptr) continue;
    throw UsageError("release: " + describe(*use.call) + (use.writes ? " writes " : " reads ") +
                     describe_mod(use.mod) + ", which has been released");
  }
}

void Engine::free_released() noexcept {
  for (const Ref<OutsideHead> object : released_) free_outside(object);
  released_.clear();
}

void Engine::free_outside(Ref<OutsideHead> object) noexcept {
  OutsideHead& head = arena()[object];
  const OutsideType& type = outside_types_[head.type];
  outside_[head.position] = outside_.back();
  arena()[outside_.back()].position = head.position;
  outside_.pop_back();
  type.destroy(&head + 1);
  forget_names(object.handle(), type.bytes);
  arena().release(object, type.bytes);
}

}  // namespace sac
