#pragma once

#include <rota/model/plan_type.hpp>

#include <algorithm>
#include <vector>

namespace rota {

/// A plan type without its functions: which plans and tasks it has, and the entry state of each task.
///
/// A robot keeps this much of the model. So its own state stays a regular value, and it can check messages on receipt.
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
  /// The entry of (p, τ), or nullptr if the type has no such task. O(log n).
  [[nodiscard]] entry const* find(typename V::plan p, typename V::task t) const {
    // `p > e.plan`, not `e.plan < p`: clang would read the class template `plan` there.
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
