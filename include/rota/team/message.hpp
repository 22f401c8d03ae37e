#pragma once

#include <rota/core/time.hpp>
#include <rota/model/allocation.hpp>
#include <rota/team/incarnation.hpp>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>

namespace rota {

/// Within one life, no number of a sender's messages grows by more from one message to the next.
inline constexpr std::uint64_t most_jump = 1 << 16;

/// No duration in a message or in the options of a robot is longer, so that instants do not overflow.
inline constexpr duration longest_duration = seconds(100'000'000);

/// Orders the messages of one sender over all its lives: first by restart, then within one life.
struct message_number {
  rota::incarnation incarnation{};  ///< grows with every restart of the sender
  std::uint64_t sequence = 0;       ///< grows with every message of one incarnation

  friend auto operator<=>(message_number const&, message_number const&) = default;
};

/// The plan, task and state that an agent executes.
template <vocabulary V = runtime_vocabulary>
struct placement {
  typename V::plan plan{};
  typename V::task task{};
  typename V::state state{};

  friend auto operator<=>(placement const&, placement const&) = default;
};

/// What a sender has to say about its place in one plan type.
enum class stance : unsigned char {
  none,      ///< nothing
  abstains,  ///< it knows no valid allocation, so it can judge no task: give it none, as long as others can take them all
  dissents  ///< it obeys a leader, and would do otherwise by itself: without the reign the conflict would be back
};

/// What a sender does about one plan type. Without a place it takes part and has no task. That differs from not taking
/// part: a sender that takes no part does not list the type at all.
template <vocabulary V = runtime_vocabulary>
struct participation {
  typename V::plan_type type{};
  std::optional<placement<V>> place{};
  std::uint64_t leads = 0;  ///< the number of the claim with which the sender leads this type; 0: it does not lead
  /// Of the allocation that the sender believes in, if it says so: see `belief::fingerprint`.
  std::optional<std::uint32_t> fingerprint{};
  rota::stance stance = rota::stance::none;

  friend bool operator==(participation const&, participation const&) = default;
};

/// A plan message: a snapshot of everything its sender executes. The sender does not execute a type that is not listed.
/// It says nothing about other agents: a sender is trusted about itself and about nobody else.
template <vocabulary V = runtime_vocabulary>
struct plan_message {
  /// A message with more types is refused.
  static constexpr std::size_t most_types = 64;

  typename V::agent sender{};
  message_number number;
  std::uint64_t claims =
      0;  ///< how many claims the sender has made in this life; all are over but those it `leads` with
  small_vector<participation<V>, 4> types{};  ///< strictly ascending by type

  friend bool operator==(plan_message const&, plan_message const&) = default;
};

/// Decides between claimants: the greater stamp leads. Totally ordered, computed once for a claim and then frozen.
///
/// With equal confidence, the default, this is the paper's rule: the greatest id leads.
template <vocabulary V = runtime_vocabulary>
struct claim_stamp {
  std::uint32_t confidence = 0;
  typename V::agent id{};

  friend auto operator<=>(claim_stamp const&, claim_stamp const&) = default;
};

/// A leader's claim of authority over one plan type (section 4, the bully algorithm).
///
/// (leader, incarnation, number) identifies a claim; the version counts how often its allocation has changed. A leader that
/// hears dissent renews its reign by a new claim; `renewals` counts them since the detection that all of it follows from. The leader
/// wants agents that take part and have no atom to be idle. Robots share no clock, so a claim carries the time that its
/// reign has left. The leader passes on when it last heard whom the claim is about, since a claim is a sign of life of its
/// leader only.
template <vocabulary V = runtime_vocabulary>
struct claim {
  typename V::plan_type type{};
  allocation_atoms<V> atoms;
  claim_stamp<V> stamp;
  typename V::agent leader{};
  rota::incarnation incarnation{};
  std::uint64_t number = 0;
  std::uint64_t version = 0;
  duration remaining{};
  small_vector<duration, 8> ages{};  ///< of each atom's agent, the time since its last sign of life; 0 for the leader
  std::uint32_t renewals = 0;        ///< an answer has as many as the claim that it answers
  std::uint32_t answers = 0;  ///< so many claims were answered, one after the other, since the detection or the renewal

  friend bool operator==(claim const&, claim const&) = default;
};

/// Everything that a robot sends.
template <vocabulary V = runtime_vocabulary>
using message = std::variant<plan_message<V>, claim<V>>;

}  // namespace rota
