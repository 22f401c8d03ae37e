#pragma once

#include <rota/model/plan.hpp>

#include <algorithm>
#include <initializer_list>
#include <span>
#include <type_traits>
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

/// The refusal in words, without names: `result` prints it where a refused plan type is taken for a plan type.
template <vocabulary V>
[[nodiscard]] constexpr char const* reason_of(plan_type_defect<V> const& d) noexcept {
  return d.what == plan_type_defect<V>::kind::no_plan ? "no_plan: the plan type has no plan"
                                                      : "repeated_plan: a plan is listed twice";
}

namespace detail {

/// One of the plans listed in a call of `plan_type::make`. Views it.
template <vocabulary V, class Beliefs>
struct listed_plan {
  plan<V, Beliefs> const* which;

  constexpr listed_plan(plan<V, Beliefs> const& p) noexcept : which(&p) {}
  template <class Refusal>
  constexpr listed_plan(result<plan<V, Beliefs>, Refusal> const&) noexcept : which(nullptr) {
    static_assert(std::is_void_v<Refusal>,
                  "this is the result of plan::make, which may be refused: check it, then pass `*result`");
  }
};

}  // namespace detail

/// A plan type pt: alternative plans for one problem. A team executes the best of them. Immutable.
///
/// Class invariant: plans strictly ascending by id and at least one.
template <vocabulary V = runtime_vocabulary, class Beliefs = no_beliefs>
class plan_type {
public:
  /// The plan type, or the first defect of its plans. O(n log n).
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
  /// As above, from plans listed in braces: `{*attack, *defend}`.
  [[nodiscard]] static result<plan_type, plan_type_defect<V>>
  make(typename V::plan_type id, std::initializer_list<detail::listed_plan<V, Beliefs>> plans) {
    std::vector<plan<V, Beliefs>> copies;
    copies.reserve(plans.size());
    for (auto const& p : plans) copies.push_back(*p.which);
    return make(id, std::move(copies));
  }

  [[nodiscard]] typename V::plan_type id() const noexcept { return id_; }
  /// The plans, ascending by id.
  [[nodiscard]] std::span<plan<V, Beliefs> const> plans() const noexcept { return plans_; }
  /// The plan with this id, or nullptr if pt has none. O(log n).
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
