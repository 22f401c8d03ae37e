#pragma once

#include <rota/model/allocation.hpp>
#include <rota/model/detail/function.hpp>

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace rota {

/// The atoms of an allocation, ascending by agent: what a precondition or a utility reads of it.
template <vocabulary V = runtime_vocabulary>
using allocation_view = std::span<in<V> const>;

/// U_p as a sum over agents: the utility of one agent on one task; an idle agent counts 0. `nullopt` forbids the pair.
///
/// Must return finite numbers of magnitude at most `max_utility`. The number of a pair must not depend on the allocation.
/// The optimum is found in polynomial time.
template <vocabulary V, class Beliefs>
using additive_utility = detail::function<std::optional<double>(typename V::agent, typename V::task, Beliefs const&)>;

/// U_p as a sum over agents and over pairs of agents: Σ_a alone(a, τ_a) + Σ_{a<b} together(a, τ_a, b, τ_b).
///
/// Idle agents count 0, and so do pairs with an idle agent. An empty `alone` counts 0. `together` is called with a < b. The
/// optimum is found by branch and bound; the bounds need no help from the user.
template <vocabulary V, class Beliefs>
struct pairwise_utility {
  additive_utility<V, Beliefs> alone;
  detail::function<double(typename V::agent, typename V::task, typename V::agent, typename V::task, Beliefs const&)>
      together;
};

/// U_p as any function of the beliefs and a complete allocation: a black box, which a search can only try out.
///
/// `bound` is optional. It must be at least the value of every complete allocation that extends the given partial one by
/// tasks for the undecided agents; decided agents without an atom are idle. A search uses it to prune, and reports a bound
/// that it saw to be too low (`solution::lie`).
/// `kind` is optional. Agents of one kind that may do the same tasks are interchangeable: swapping what two of them do must
/// not change the value. Of allocations equal up to such swaps, only one is evaluated.
template <vocabulary V, class Beliefs>
struct general_utility {
  detail::function<double(Beliefs const&, allocation_view<V>)> value;
  detail::function<double(Beliefs const&, allocation_view<V>, std::span<typename V::agent const> undecided)> bound{};
  detail::function<std::uint64_t(Beliefs const&, typename V::agent)> kind{};
};

/// A part of U_p: the sum of the priorities that the agents' roles give to their tasks.
struct role_priorities {
  friend bool operator==(role_priorities, role_priorities) = default;
};

/// A part of U_p: how many atoms the allocation shares with the running one. Weighted, a bonus for staying.
struct similarity {
  friend bool operator==(similarity, similarity) = default;
};

namespace detail {

/// The form of utility that a callable is, by its signature; void for none or several.
template <class F, vocabulary V, class Beliefs>
struct form_of {
  using agent = typename V::agent;
  using task = typename V::task;
  static constexpr bool additive = fits<F, std::optional<double>(agent, task, Beliefs const&)>;
  static constexpr bool pairwise = fits<F, double(agent, task, agent, task, Beliefs const&)>;
  static constexpr bool general = fits<F, double(Beliefs const&, allocation_view<V>)>;
  static constexpr bool unique = int{additive} + int{pairwise} + int{general} == 1;
};

/// A function of its own, so that compilers name the callable and the beliefs.
template <class F, class V, class Beliefs>
constexpr void check_signature() {
  static_assert(form_of<F, V, Beliefs>::unique,
                "a utility is a callable `double or std::optional<double> (agent, task, Beliefs const&)`, "
                "`double (agent, task, agent, task, Beliefs const&)` or `double (Beliefs const&, allocation_view<V>)`");
}

template <class T, class Variant>
inline constexpr bool is_form = false;
template <class T, class... Forms>
inline constexpr bool is_form<T, std::variant<Forms...>> = (std::is_same_v<T, Forms> || ...);

/// A form as it is, or the one that a plain callable fits.
template <vocabulary V, class Beliefs, class Variant, class F>
[[nodiscard]] Variant to_form(F&& f) {
  using plain = std::decay_t<F>;
  if constexpr (is_form<plain, Variant>) {
    return Variant(std::forward<F>(f));
  } else {
    using form = form_of<plain, V, Beliefs>;
    check_signature<plain, V, Beliefs>();
    if constexpr (!form::unique) {
      return {};
    } else if constexpr (form::additive) {
      return additive_utility<V, Beliefs>(std::forward<F>(f));
    } else if constexpr (form::pairwise) {
      return pairwise_utility<V, Beliefs>{{}, std::forward<F>(f)};
    } else {
      return general_utility<V, Beliefs>{std::forward<F>(f)};
    }
  }
}

/// Callables, fitting or not, and the forms of a utility.
template <class F, class Self>
concept made_into =
    !std::same_as<std::remove_cvref_t<F>, Self> &&
    (std::is_class_v<std::remove_cvref_t<F>> || std::is_function_v<std::remove_pointer_t<std::decay_t<F>>>);

}  // namespace detail

/// One part of a weighted sum, without its weight.
template <vocabulary V, class Beliefs>
class utility_part {
public:
  using form_type = std::variant<additive_utility<V, Beliefs>, pairwise_utility<V, Beliefs>,
                                 general_utility<V, Beliefs>, role_priorities, similarity>;

  utility_part() = default;
  /// One of the forms, or a callable with the signature of one.
  template <detail::made_into<utility_part> F>
  utility_part(F&& f) : form_(detail::to_form<V, Beliefs, form_type>(std::forward<F>(f))) {}

  [[nodiscard]] form_type const& form() const noexcept { return form_; }

private:
  form_type form_;
};

/// One part of a weighted sum. Each number that the part returns is multiplied by the weight before it is counted.
template <vocabulary V, class Beliefs>
struct weighted_part {
  double weight = 1;
  utility_part<V, Beliefs> part;
};

/// U_p = Σ weight·part. It is as hard to optimise as its hardest part.
template <vocabulary V, class Beliefs>
using weighted_sum = std::vector<weighted_part<V, Beliefs>>;

/// U_p: what an allocation is worth to a plan. Additive, pairwise, general, or a weighted sum of these.
///
/// A default-constructed one is missing: `plan::make` refuses it.
template <vocabulary V, class Beliefs>
class utility {
public:
  using form_type = std::variant<additive_utility<V, Beliefs>, pairwise_utility<V, Beliefs>,
                                 general_utility<V, Beliefs>, weighted_sum<V, Beliefs>>;

  utility() = default;
  /// One of the forms, or a callable with the signature of one: additive, pairwise (its `together`) or general (its
  /// `value`).
  template <detail::made_into<utility> F>
  utility(F&& f) : form_(detail::to_form<V, Beliefs, form_type>(std::forward<F>(f))) {}
  /// A weighted sum: `{{0.7, nearest}, {0.3, rota::role_priorities{}}}`.
  utility(std::initializer_list<weighted_part<V, Beliefs>> parts) : form_(weighted_sum<V, Beliefs>(parts)) {}

  [[nodiscard]] form_type const& form() const noexcept { return form_; }

private:
  form_type form_;
};

}  // namespace rota
