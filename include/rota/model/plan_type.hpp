#pragma once

#include <rota/model/plan.hpp>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace rota {

/// Refusal: what is wrong with the plans of a plan type.
template <vocabulary V>
struct plan_type_defect {
  enum class kind : unsigned char {
    no_plan,        ///< a plan type needs at least one plan
    repeated_plan,  ///< `plan` occurs twice
  };
  kind what{};
  typename V::plan plan{};

  friend bool operator==(plan_type_defect const&, plan_type_defect const&) = default;
};

/// A plan type pt: alternative plans for one problem. A team executes one of them, the best. Immutable.
///
/// Class invariant: plans strictly ascending by id and at least one.
template <vocabulary V = runtime_vocabulary, class Beliefs = no_beliefs>
class plan_type {
public:
  [[nodiscard]] static result<plan_type, plan_type_defect<V>> make(typename V::plan_type id,
                                                                   std::vector<plan<V, Beliefs>> plans) {
    using kind = typename plan_type_defect<V>::kind;
    if (plans.empty()) return refused{plan_type_defect<V>{kind::no_plan, {}}};
    std::sort(plans.begin(), plans.end(), [](auto const& a, auto const& b) { return a.id() < b.id(); });
    auto const twice =
        std::adjacent_find(plans.begin(), plans.end(), [](auto const& a, auto const& b) { return a.id() == b.id(); });
    if (twice != plans.end()) return refused{plan_type_defect<V>{kind::repeated_plan, twice->id()}};
    return plan_type{id, std::move(plans)};
  }

  [[nodiscard]] typename V::plan_type id() const noexcept { return id_; }
  /// The plans, ascending by id.
  [[nodiscard]] std::span<plan<V, Beliefs> const> plans() const noexcept { return plans_; }
  /// One plan, or nullptr if p does not belong to pt. O(log n).
  [[nodiscard]] plan<V, Beliefs> const* find(typename V::plan p) const {
    auto const where = std::lower_bound(plans_.begin(), plans_.end(), p,
                                        [](auto const& entry, auto const& key) { return entry.id() < key; });
    return where != plans_.end() && where->id() == p ? &*where : nullptr;
  }

private:
  plan_type(typename V::plan_type id, std::vector<plan<V, Beliefs>> plans) : id_(id), plans_(std::move(plans)) {}

  typename V::plan_type id_;
  std::vector<plan<V, Beliefs>> plans_;
};

}  // namespace rota
