#pragma once

#include <rota/algebra/apply.hpp>
#include <rota/core/time.hpp>
#include <rota/model/allocation.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace rota {

/// The four events a plan message can cause (section 4, after Def. 4), and what a claim causes.
enum class message_case : unsigned char {
  agreement,  ///< (∅, ∅): nothing new about the sender
  joined,     ///< ({In(b, p, τ)}, ∅)
  moved,      ///< ({In(b, p, τ)}, {In(b, p′, τ′)}), (p, τ) ≠ (p′, τ′)
  left,       ///< (∅, {In(b, p′, τ′)})
  imposed     ///< none of the four: a leader's claim, which may speak about anybody
};

/// What one agent believes about one plan type: who takes part, who does what, and when each was last heard of.
///
/// Class invariants: participants strictly ascending; every atom is about a participant; at most one atom per agent (so
/// b's part is an optional atom). The allocation may otherwise be invalid or mix plans, as long as a conflict lasts.
template <vocabulary V = runtime_vocabulary>
class belief {
public:
  using agent_id = typename V::agent;

  [[nodiscard]] allocation_atoms<V> const& atoms() const noexcept { return atoms_; }
  /// The agents that execute the type, with or without a task, ascending.
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
  /// When b was last heard of. @pre `takes_part(b)`
  [[nodiscard]] instant heard(agent_id b) const {
    auto const at = find(b);
    ROTA_ASSERT(at.has_value());
    return records_[*at].heard;
  }

  /// Notes a sign of life of b, adding it to the participants if new. O(n).
  void admit(agent_id b, instant now) {
    auto const* where = std::lower_bound(who_.begin(), who_.end(), b);
    auto const at = where - who_.begin();
    if (where != who_.end() && *where == b) {
      records_[static_cast<std::size_t>(at)].heard = now;
    } else {
      who_.insert(where, b);
      records_.insert(records_.begin() + at, {{}, now});
    }
  }
  /// Removes b from the participants and from the allocation; the event this causes.
  event<in<V>> expel(agent_id b) {
    auto e = place(b, std::nullopt);
    if (auto const at = find(b)) {
      who_.erase(who_.begin() + *at);
      records_.erase(records_.begin() + *at);
    }
    return e;
  }

  /// Gives b this atom in place of the one it has, if any; the event this causes.
  /// @pre the atom is about b; `takes_part(b)` if there is one
  event<in<V>> place(agent_id b, std::optional<in<V>> const& atom) {
    ROTA_ASSERT(!atom || (atom->agent == b && takes_part(b)));
    auto const old = part(b);
    if (old == atom) return {};
    if (old) atoms_.erase(*old);
    if (atom) atoms_.insert(*atom);
    return transfer(old, atom);
  }
  /// Replaces the whole allocation; the event this causes. @pre one atom per agent, each of a participant
  event<in<V>> replace(allocation_atoms<V> const& atoms) {
    auto e = difference(atoms_, atoms);
    atoms_ = atoms;
    return e;
  }
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

  static event<in<V>> transfer(std::optional<in<V>> const& from, std::optional<in<V>> const& to) {
    allocation_atoms<V> before, after;
    if (from) before.insert(*from);
    if (to) after.insert(*to);
    return difference(before, after);
  }
  std::optional<std::size_t> find(agent_id b) const {
    auto const* where = std::lower_bound(who_.begin(), who_.end(), b);
    if (where == who_.end() || !(*where == b)) return std::nullopt;
    return static_cast<std::size_t>(where - who_.begin());
  }

  allocation_atoms<V> atoms_;
  small_vector<agent_id, 8> who_;
  small_vector<record, 8> records_;
};

/// Which of the four cases turns b's old part into its new one.
template <vocabulary V>
[[nodiscard]] constexpr message_case classify(std::optional<in<V>> const& before, std::optional<in<V>> const& after) {
  if (before == after) return message_case::agreement;
  if (!before) return message_case::joined;
  return after ? message_case::moved : message_case::left;
}

}  // namespace rota
