#pragma once

#include <rota/algebra/apply.hpp>
#include <rota/algebra/fingerprint.hpp>
#include <rota/team/message.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

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

/// What one robot believes about one plan type: who takes part, who does what, what each said last, and when.
///
/// What a sender said and what the robot believes of it differ while they disagree: reallocation changes the belief, and
/// never what was said.
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

  /// What b has said about its place; of who takes no part, nothing.
  [[nodiscard]] rota::stance stance(agent_id b) const {
    auto const at = find(b);
    return at ? records_[*at].stance : rota::stance::none;
  }
  /// Whether anybody has said so.
  [[nodiscard]] bool anybody(rota::stance s) const noexcept {
    return std::any_of(records_.begin(), records_.end(), [&](record const& r) { return r.stance == s; });
  }
  /// Whether without a leader somebody would not do what is believed of it: it was heard since then, and it dissents, or it
  /// abstains and has a task. O(n log n).
  [[nodiscard]] bool disputed(instant since) const {
    for (std::size_t i = 0; i < who_.size(); ++i) {
      record const& r = records_[i];
      if (r.heard < since) continue;
      if (r.stance == rota::stance::dissents || (r.stance == rota::stance::abstains && part(who_[i]))) return true;
    }
    return false;
  }
  /// Forgets who dissents: from another leader.
  void forget_dissent() noexcept {
    for (record& r : records_)
      if (r.stance == rota::stance::dissents) r.stance = rota::stance::none;
  }
  /// The participants but those who have said that they abstain, ascending. O(n).
  [[nodiscard]] small_vector<agent_id, 8> willing() const {
    small_vector<agent_id, 8> all;
    for (std::size_t i = 0; i < who_.size(); ++i)
      if (records_[i].stance != rota::stance::abstains) all.push_back(who_[i]);
    return all;
  }

  /// b's atom, as b said last: nothing if it said that it has none, or that it takes no part.
  [[nodiscard]] std::optional<in<V>> said(agent_id b) const {
    auto const at = find(b);
    return at ? records_[*at].said : std::nullopt;
  }
  /// What everybody but `self` said last, and what `self` does: where a deliberation of `self` begins. So nothing that was
  /// said on either side of an earlier deliberation is lost, and robots with equal beliefs come to agree.
  [[nodiscard]] allocation_atoms<V> told(agent_id self) const {
    small_vector<in<V>, 8> all;
    for (std::size_t i = 0; i < who_.size(); ++i)
      if (auto const& x = who_[i] == self ? part(self) : records_[i].said) all.push_back(*x);
    return allocation_atoms<V>::from_ascending(std::move(all));
  }
  /// A digest of the allocation, to compare with another robot's.
  [[nodiscard]] std::uint32_t fingerprint() const {
    auto const all = fingerprint_of(atoms_).value;
    return static_cast<std::uint32_t>(all ^ all >> 32);
  }

  /// Notes a sign of life of b, and makes it a participant. O(n).
  void admit(agent_id b, instant heard) { admitted(b, heard); }
  /// Takes in what b says about itself: a sign of life, its part and its state. Looks b up once among the participants and
  /// once in the allocation. O(n).
  part_change<V> hear(agent_id b, std::optional<placement<V>> const& said, instant now,
                      rota::stance stands = rota::stance::none) {
    record& r = admitted(b, now);
    r.stance = stands;
    if (said) r.state = said->state;
    r.said = atom_of(b, said);
    return place(b, r.said);
  }
  /// As `hear` while a leader rules: the part stays as it is, and the state counts only if b says that it has this part.
  void hear_ruled(agent_id b, std::optional<placement<V>> const& said, instant now,
                  rota::stance stands = rota::stance::none) {
    record& r = admitted(b, now);
    r.stance = stands;
    r.said = atom_of(b, said);
    if (said && part(b) == r.said) r.state = said->state;
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
  /// Replaces the whole allocation by a leader's, which counts as what everybody says. @pre as `replace`
  void impose(allocation_atoms<V> const& atoms) {
    atoms_ = atoms;
    for (std::size_t i = 0; i < who_.size(); ++i) records_[i].said = part(who_[i]);
  }
  /// Moves all instants by d: the clock has been set.
  void shift(duration d) noexcept {
    for (record& r : records_) r.heard = moved(r.heard, d);
  }
  /// @pre `takes_part(b)`
  void set_state(agent_id b, typename V::state z) {
    auto const at = find(b);
    ROTA_ASSERT(at.has_value());
    records_[*at].state = z;
  }

  template <class Digest>
  void digest_into(Digest& d) const {
    for (auto const& x : atoms_) d(x.agent, x.plan, x.task);
    d(atoms_.size()).all(who_);
    for (record const& r : records_) {
      d(r.state, r.heard, r.stance, r.said.has_value());
      if (r.said) d(r.said->plan, r.said->task);
    }
  }
  friend bool operator==(belief const&, belief const&) = default;

private:
  struct record {
    typename V::state state{};
    instant heard{};
    std::optional<in<V>> said{};
    rota::stance stance = rota::stance::none;
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
      r.heard = (std::max)(r.heard, now);
      return r;
    }
    who_.insert(where, b);
    return *records_.insert(records_.begin() + at, {{}, now, {}, {}});
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
