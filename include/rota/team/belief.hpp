#pragma once

#include <rota/algebra/apply.hpp>
#include <rota/team/message.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

namespace rota {

/// The four events that a plan message can cause (section 4, after Def. 4).
enum class message_case : unsigned char {
  agreement,  ///< (∅, ∅): the sender's part stays
  joined,     ///< ({In(b, p, τ)}, ∅)
  moved,      ///< ({In(b, p, τ)}, {In(b, p′, τ′)}), (p, τ) ≠ (p′, τ′)
  left        ///< (∅, {In(b, p′, τ′)})
};

/// A change of one agent b: its part of an allocation before and after. Every other form follows from these two.
///
/// Invariant: `before` and `after`, if any, are about `agent`.
template <vocabulary V = runtime_vocabulary>
struct part_change {
  typename V::agent agent{};
  std::optional<in<V>> before{};
  std::optional<in<V>> after{};

  /// Whether the part stays as it was.
  [[nodiscard]] constexpr bool empty() const { return before == after; }
  /// Which of the four cases of a plan message this is.
  [[nodiscard]] constexpr message_case what() const {
    if (empty()) return message_case::agreement;
    if (!before) return message_case::joined;
    return after ? message_case::moved : message_case::left;
  }
  /// The event from the old part to the new one: e_m, if a message caused the change.
  [[nodiscard]] constexpr rota::event<in<V>> event() const {
    allocation_atoms<V> from, to;
    if (before) from.insert(*before);
    if (after) to.insert(*after);
    return difference(from, to);
  }

  friend bool operator==(part_change const&, part_change const&) = default;
};

/// What one robot believes about one plan type: who takes part, who does what, and when each was last heard.
///
/// Class invariants: participants are strictly ascending; every atom is about a participant; an agent has at most one atom,
/// its part. Apart from that the allocation may be invalid or mix plans while a conflict lasts.
template <vocabulary V = runtime_vocabulary>
class belief {
public:
  using agent_id = typename V::agent;

  [[nodiscard]] allocation_atoms<V> const& atoms() const noexcept { return atoms_; }
  /// The agents that execute the type, with or without a task, ascending. Valid until somebody comes or goes.
  [[nodiscard]] std::span<agent_id const> participants() const noexcept { return {who_.begin(), who_.size()}; }
  [[nodiscard]] bool takes_part(agent_id b) const { return std::binary_search(who_.begin(), who_.end(), b); }
  /// b's atom, if it has a task. O(log n).
  [[nodiscard]] std::optional<in<V>> part(agent_id b) const {
    auto const atoms = part_of<V>(atoms_, b);
    if (atoms.empty()) return std::nullopt;
    return atoms.front();
  }
  /// The state z that b inhabits; nullopt for an agent that does not take part.
  [[nodiscard]] std::optional<typename V::state> state(agent_id b) const {
    auto const at = find(b);
    if (!at) return std::nullopt;
    return records_[*at].state;
  }
  /// When b was last heard. @pre `takes_part(b)`
  [[nodiscard]] instant heard(agent_id b) const {
    auto const at = find(b);
    ROTA_ASSERT(at.has_value());
    return records_[*at].heard;
  }

  /// Notes a sign of life of b, and makes it a participant. O(n).
  void admit(agent_id b, instant now) { admitted(b, now); }
  /// Takes in what b says about itself: a sign of life, its part and its state. Looks b up once among the participants and
  /// once in the allocation. O(n).
  part_change<V> hear(agent_id b, std::optional<placement<V>> const& said, instant now) {
    record& r = admitted(b, now);
    if (said) r.state = said->state;
    return place(b, atom_of(b, said));
  }
  /// As `hear` while a leader rules: the part stays as it is, and the state counts only if b says that it has this part.
  void hear_ruled(agent_id b, std::optional<placement<V>> const& said, instant now) {
    record& r = admitted(b, now);
    if (said && part(b) == atom_of(b, said)) r.state = said->state;
  }
  /// Removes b from the participants and from the allocation. O(n).
  part_change<V> expel(agent_id b) {
    part_change<V> const change{b, part(b)};
    if (change.before) atoms_.erase(*change.before);
    if (auto const at = find(b)) {
      who_.erase(who_.begin() + *at);
      records_.erase(records_.begin() + *at);
    }
    return change;
  }

  /// Replaces the whole allocation. @pre at most one atom per agent, each of a participant
  void replace(allocation_atoms<V> const& atoms) { atoms_ = atoms; }
  /// @pre `takes_part(b)`
  void set_state(agent_id b, typename V::state z) {
    auto const at = find(b);
    ROTA_ASSERT(at.has_value());
    records_[*at].state = z;
  }

  friend bool operator==(belief const&, belief const&) = default;

private:
  struct record {
    typename V::state state{};
    instant heard{};
    friend bool operator==(record const&, record const&) = default;
  };

  static std::optional<in<V>> atom_of(agent_id b, std::optional<placement<V>> const& place) {
    if (!place) return std::nullopt;
    return in<V>{b, place->plan, place->task};
  }
  std::optional<std::size_t> find(agent_id b) const {
    auto const* where = std::lower_bound(who_.begin(), who_.end(), b);
    if (where == who_.end() || !(*where == b)) return std::nullopt;
    return static_cast<std::size_t>(where - who_.begin());
  }
  /// The record of b, which takes part from now on.
  record& admitted(agent_id b, instant now) {
    auto const* where = std::lower_bound(who_.begin(), who_.end(), b);
    auto const at = where - who_.begin();
    if (where != who_.end() && *where == b) {
      record& r = records_[static_cast<std::size_t>(at)];
      r.heard = now;
      return r;
    }
    who_.insert(where, b);
    return *records_.insert(records_.begin() + at, {{}, now});
  }
  /// Gives b this part in place of the one it has.
  part_change<V> place(agent_id b, std::optional<in<V>> const& atom) {
    part_change<V> const change{b, part(b), atom};
    if (change.empty()) return change;
    if (change.before) atoms_.erase(*change.before);
    if (change.after) atoms_.insert(*change.after);
    return change;
  }

  allocation_atoms<V> atoms_;
  small_vector<agent_id, 8> who_;
  small_vector<record, 8> records_;  // of the participants, in their order
};

}  // namespace rota
