#pragma once

#include <rota/core/lifetime.hpp>
#include <rota/model/plan_type.hpp>
#include <rota/model/team.hpp>

#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>

namespace rota {

/// Whether an agent may take part without a task.
enum class idling : bool { allowed, forbidden };

namespace detail {

inline constexpr no_beliefs nothing_believed{};

/// Whether a `Viewed const&` that is given a T&& would refer to a temporary.
template <class T, class Viewed>
inline constexpr bool is_temporary =
    !std::is_lvalue_reference_v<T&&> || !std::is_convertible_v<std::remove_reference_t<T>*, Viewed const*>;

template <class T>
inline constexpr bool is_result = false;
template <class T, class Refusal>
inline constexpr bool is_result<result<T, Refusal>> = true;

/// Whether a span of T&& would outlive its elements.
template <class T, class Item>
inline constexpr bool is_temporary_range =
    !std::is_lvalue_reference_v<T> && std::is_convertible_v<T, std::span<Item const>>;
template <class T, std::size_t n, class Item>
inline constexpr bool is_temporary_range<std::span<T, n>, Item> = false;

}  // namespace detail

/// The task allocation problem for one plan type: which plan, and which of its tasks for whom? A view; owns nothing.
///
/// `participants` are the agents believed to execute the type, strictly ascending. No other agent gets an atom.
/// `current` is the running allocation. A plan that occurs there is not asked for its precondition if that is
/// `precondition_scope::entry_only`, and `similarity` counts the atoms that stay. `change_cost` is the price of each
/// participant who would do something else than there: a search maximises U_p less that, while validity asks for U_p alone.
/// Without a change cost, noise in the utilities of equally good agents makes them swap tasks, see `hysteresis`.
///
///   rota::problem const here{play, team, world};
///   reallocate(here.running(now).with_change_cost(0.02), …);
///
/// @pre everything viewed outlives the problem and does not change meanwhile; change_cost is finite and not negative
template <vocabulary V, class Beliefs>
struct problem {
  plan_type<V, Beliefs> const& type;
  team<V> const& members;
  Beliefs const& beliefs;
  std::span<typename V::agent const> participants;
  idling idle = idling::allowed;
  allocation_view<V> current{};
  double change_cost = 0;

  /// The whole team takes part.
  constexpr problem(plan_type<V, Beliefs> const& pt ROTA_LIFETIMEBOUND, team<V> const& t ROTA_LIFETIMEBOUND,
                    Beliefs const& b ROTA_LIFETIMEBOUND, idling i = idling::allowed)
      : problem(pt, t, b, t.agents(), i) {}
  constexpr problem(plan_type<V, Beliefs> const& pt ROTA_LIFETIMEBOUND, team<V> const& t ROTA_LIFETIMEBOUND,
                    Beliefs const& b ROTA_LIFETIMEBOUND, std::span<typename V::agent const> who ROTA_LIFETIMEBOUND,
                    idling i = idling::allowed)
      : type(pt), members(t), beliefs(b), participants(who), idle(i) {}
  /// For utilities and preconditions that read no beliefs.
  constexpr problem(plan_type<V, Beliefs> const& pt ROTA_LIFETIMEBOUND, team<V> const& t ROTA_LIFETIMEBOUND,
                    idling i = idling::allowed)
    requires std::same_as<Beliefs, no_beliefs>
      : problem(pt, t, detail::nothing_believed, i) {}

  template <class T, class M, class B, class... Rest>
    requires(!detail::is_result<std::remove_cvref_t<T>>) &&
                (detail::is_temporary<T, plan_type<V, Beliefs>> || detail::is_temporary<M, team<V>> ||
                 (detail::is_temporary<B, Beliefs> && !std::same_as<B, idling>) ||
                 (detail::is_temporary_range<Rest, typename V::agent> || ...))
  problem(T&&, M&&, B&&, Rest&&...) = delete;  // a problem is a view: what it views must be variables that outlive it
  template <class T, class M>
    requires(!detail::is_result<std::remove_cvref_t<T>>) &&
                (detail::is_temporary<T, plan_type<V, Beliefs>> || detail::is_temporary<M, team<V>>)
  problem(T&&, M&&) = delete;  // a problem is a view: what it views must be variables that outlive it
  template <class R, class... Rest>
  problem(result<plan_type<V, Beliefs>, R> const&, Rest&&...) = delete;  // a result may be refused: pass *result

  /// The same problem where the team executes this allocation already.
  [[nodiscard]] constexpr problem running(allocation_atoms<V> const& now ROTA_LIFETIMEBOUND) const {
    return running(now.atoms());
  }
  [[nodiscard]] constexpr problem running(allocation_view<V> now) const {
    auto p = *this;
    p.current = now;
    return p;
  }
  problem running(allocation_atoms<V>&&) const = delete;  // a problem is a view: the allocation must outlive it

  /// The same problem where each participant who changes costs this much. @pre finite, not negative
  [[nodiscard]] constexpr problem with_change_cost(double cost) const {
    auto p = *this;
    p.change_cost = cost;
    return p;
  }
};

}  // namespace rota
