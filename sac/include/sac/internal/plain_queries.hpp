// The queries of plain runs: a table of answers for each function.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "sac/check.hpp"
#include "sac/internal/same.hpp"
#include "sac/label.hpp"

namespace sac {

namespace detail {
// A query, by any address that is its own, and its name.
struct QueryName {
  const void* query;
  std::string name;
};
/// `path`: queries, each before the one that it asks for. Throws: UsageError if one is there twice;
/// it names the cycle.
void require_no_cycle(const std::vector<QueryName>& path);
[[noreturn]] void fail_unequal(std::string_view function);
/// Throws: UsageError if an argument does not equal itself, as a NaN in a vector.
template <auto F, class... P>
void require_equal_to_itself(const std::tuple<P...>& args) {
  if (!identical(args, args)) fail_unequal(function_name<F>());
}
}  // namespace detail

class PlainQueries {
 public:
  /// The value that compute(args...) returns, computed once, and then behind(). Throws: UsageError
  /// if it asks for itself.
  template <auto F, class Compute, class Behind, class... P>
  const auto& answer(const std::tuple<P...>& args, Compute&& compute, Behind&& behind) {
    using R = decltype(std::apply(compute, args));
    using Value =
        std::conditional_t<std::is_void_v<R>, std::type_identity<std::monostate>, std::decay<R>>;
    using Known = Answers<F, typename Value::type, P...>;
    auto& table = tables_[&kTag<F, P...>];
    if (table == nullptr) table = std::make_unique<Known>();
    Known& known = static_cast<Known&>(*table);
    detail::require_equal_to_itself<F>(args);
    const auto [found, is_new] = known.answers.try_emplace(args);
    std::optional<typename Value::type>& value = found->second;
    if (value.has_value()) return std::as_const(*value);
    const Running running{&name<F, P...>, &found->first, innermost_};
    if (!is_new) fail_cycle(running);
    try {
      innermost_ = &running;
      if constexpr (std::is_void_v<R>) {
        std::apply(compute, args);
        value.emplace();
      } else {
        value.emplace(std::apply(compute, args));
      }
      innermost_ = running.asker;
      behind();
    } catch (...) {
      innermost_ = running.asker;
      known.answers.erase(found->first);
      throw;
    }
    return std::as_const(*value);
  }

 private:
  struct AnyAnswers {
    virtual ~AnyAnswers() = default;
  };
  struct Hash {
    template <class... P>
    std::size_t operator()(const std::tuple<P...>& args) const {
      return hash_arguments(0, args);
    }
  };
  struct Identical {
    template <class... P>
    bool operator()(const std::tuple<P...>& a, const std::tuple<P...>& b) const {
      return detail::identical(a, b);
    }
  };
  template <auto F, class Value, class... P>
  struct Answers : AnyAnswers {
    std::unordered_map<std::tuple<P...>, std::optional<Value>, Hash, Identical> answers;
  };
  template <auto F, class... P>
  static constexpr char kTag = 0;

  // A query that runs.
  struct Running {
    std::string (*name)(const void* arguments);
    const void* arguments;
    const Running* asker;
  };
  template <auto F, class... P>
  static std::string name(const void* arguments) {
    std::ostringstream out;
    out << function_name<F>() << '(';
    print_arguments(out, *static_cast<const std::tuple<P...>*>(arguments));
    out << ')';
    return out.str();
  }
  void fail_cycle(const Running& asked) const {
    std::vector<detail::QueryName> path;
    for (const Running* q = &asked; q != nullptr; q = q->asker) {
      path.push_back({q->arguments, q->name(q->arguments)});
    }
    std::reverse(path.begin(), path.end());
    detail::require_no_cycle(path);
  }

  std::map<const void*, std::unique_ptr<AnyAnswers>> tables_;
  const Running* innermost_ = nullptr;
};

}  // namespace sac
