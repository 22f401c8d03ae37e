#pragma once

#include <rota/model/plan_type.hpp>

#include <algorithm>
#include <vector>

namespace rota {

/// The names of a plan type without its functions: which plans and tasks exist, and each task's entry state.
///
/// What an agent keeps of the model, so that its state stays a regular value and a message can be checked on receipt.
template <vocabulary V = runtime_vocabulary>
class outline {
public:
  struct entry {
    typename V::plan plan{};
    typename V::task task{};
    typename V::state state{};
    friend bool operator==(entry const&, entry const&) = default;
  };

  outline() = default;
  template <class Beliefs>
  explicit outline(plan_type<V, Beliefs> const& pt) : type_(pt.id()) {
    for (auto const& p : pt.plans())
      for (auto const& t : p.tasks()) entries_.push_back({p.id(), t.task, t.entry});
  }

  [[nodiscard]] typename V::plan_type type() const noexcept { return type_; }
  /// The entry of (p, τ), or nullptr where the type has no such task. O(log n).
  [[nodiscard]] entry const* find(typename V::plan p, typename V::task t) const {
    auto const where = std::lower_bound(entries_.begin(), entries_.end(), 0,
                                        [&](entry const& e, int) { return e.plan == p ? t > e.task : p > e.plan; });
    return where != entries_.end() && where->plan == p && where->task == t ? &*where : nullptr;
  }

  friend bool operator==(outline const&, outline const&) = default;

private:
  typename V::plan_type type_{};
  std::vector<entry> entries_;
};

}  // namespace rota
