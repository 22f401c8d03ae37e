#pragma once

#include <rota/core/time.hpp>
#include <rota/model/allocation.hpp>

#include <compare>
#include <cstdint>
#include <optional>
#include <variant>

namespace rota {

/// Orders the messages of one sender over its whole life: restarts first, then messages within one life.
struct message_number {
  std::uint64_t incarnation = 0;  ///< grows with every restart of the sender
  std::uint64_t sequence = 0;     ///< grows with every message of one incarnation

  friend auto operator<=>(message_number const&, message_number const&) = default;
};

/// The plan-task-state triple an agent executes.
template <vocabulary V = runtime_vocabulary>
struct placement {
  typename V::plan plan{};
  typename V::task task{};
  typename V::state state{};

  friend auto operator<=>(placement const&, placement const&) = default;
};

/// What a sender does about one plan type. Without a place: it takes part but has no task, which differs from not taking
/// part (the type is then not listed at all).
template <vocabulary V = runtime_vocabulary>
struct participation {
  typename V::plan_type type{};
  std::optional<placement<V>> place;

  friend bool operator==(participation const&, participation const&) = default;
};

/// A plan message: a snapshot of everything its sender executes. A type it does not list is one it does not execute.
/// Says nothing about other agents: a sender is trusted about itself and about nobody else.
template <vocabulary V = runtime_vocabulary>
struct plan_message {
  typename V::agent sender{};
  message_number number;
  small_vector<participation<V>, 4> types;

  friend bool operator==(plan_message const&, plan_message const&) = default;
};

/// What decides between claimants: totally ordered, computed once and frozen for a claim, never NaN.
///
/// With equal confidence, as by default, this is the paper's rule: the greatest id leads.
template <vocabulary V = runtime_vocabulary>
struct claim_stamp {
  std::uint32_t confidence = 0;
  typename V::agent id{};

  friend auto operator<=>(claim_stamp const&, claim_stamp const&) = default;
};

/// A leader's claim of authority over one plan type (section 4, the bully algorithm).
///
/// Identity is (leader, incarnation, number); the version counts the changes of its allocation. Agents that take part
/// and have no atom are idle by the leader's will. No clock is shared: a claim carries the time its reign has left.
template <vocabulary V = runtime_vocabulary>
struct claim {
  typename V::plan_type type{};
  allocation_atoms<V> atoms;
  claim_stamp<V> stamp;
  typename V::agent leader{};
  std::uint64_t incarnation = 0;
  std::uint64_t number = 0;
  std::uint64_t version = 0;
  duration remaining;

  friend bool operator==(claim const&, claim const&) = default;
};

/// Everything an agent says.
template <vocabulary V = runtime_vocabulary>
using message = std::variant<plan_message<V>, claim<V>>;

}  // namespace rota
