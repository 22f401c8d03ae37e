#pragma once

#include <rota/team/message.hpp>

#include <algorithm>
#include <compare>
#include <cstdint>
#include <optional>

namespace rota {

/// What hearing a claim did.
enum class claim_outcome : unsigned char {
  adopted,    ///< the receiver obeys this claim from now on
  revised,    ///< the receiver obeys this claim already, and this is a newer version of it
  repeated,   ///< nothing new; at most the claim ends sooner
  expired,    ///< this claim, or a later one of its leader, has already ended here; it is never obeyed again
  outranked,  ///< the receiver leads or obeys with a greater stamp; if it leads, it repeats its own claim
  challenged  ///< nobody rules and the receiver's own stamp is greater: it answers with a claim, once for each claim
};

/// One robot's view of who rules one plan type: nobody, itself, or the leader that it obeys (section 4, the bully algorithm).
///
/// Invariants, whatever is lost, duplicated, reordered or delayed: the robot obeys at most one leader; while it obeys, it
/// turns to no smaller stamp; copies of one claim end at the earliest end that any of them names; a claim that has ended is
/// never obeyed again; a claim is answered by at most one reign. Hence a reign ends at every follower no later than at its
/// leader plus the greatest message delay, and a delayed copy prolongs nothing.
template <vocabulary V = runtime_vocabulary>
class authority {
public:
  using agent_id = typename V::agent;

  [[nodiscard]] bool leading() const noexcept { return phase_ == phase::leading; }
  [[nodiscard]] bool obeying() const noexcept { return phase_ == phase::obeying; }
  [[nodiscard]] bool active() const noexcept { return leading() || obeying(); }
  /// The claim in force: the robot's own, or the one it obeys. @pre `active()`
  [[nodiscard]] claim<V> const& current() const& noexcept {
    ROTA_ASSERT(active());
    return claim_;
  }
  claim<V> const& current() const&& = delete;
  /// When the claim in force ends here. @pre `active()`
  [[nodiscard]] instant expiry() const noexcept {
    ROTA_ASSERT(active());
    return expiry_;
  }

  /// Begins to lead. The robot's claim gets its next number and is first due at `due`. @pre `!leading()`
  void lead(typename V::plan_type type, allocation_atoms<V> atoms, claim_stamp<V> mine, rota::incarnation incarnation,
            instant now, instant due, duration reign) {
    ROTA_ASSERT(!leading());
    supersede();
    claim_ = {type, std::move(atoms), mine, mine.id, incarnation, ++numbers_, 1, reign};
    phase_ = phase::leading;
    expiry_ = now + reign;
    next_repeat_ = due;
    said_ = false;
  }

  /// Whether c has the identity of the claim in force and another stamp. The stamp of a claim never changes, so such a
  /// message is forged or faulty.
  [[nodiscard]] bool contradicts(claim<V> const& c) const {
    return active() && claim_.leader == c.leader && identity_of(claim_) == identity_of(c) && claim_.stamp != c.stamp;
  }

  /// Takes in a claim that is well-formed and from somebody else. `mine` is the stamp that the robot's own claim would have.
  /// @pre `!contradicts(c)`
  claim_outcome hear(claim<V> const& c, claim_stamp<V> const& mine, instant now) {
    if (leading() && c.stamp < claim_.stamp) {
      next_repeat_ = (std::min)(next_repeat_, now);
      return claim_outcome::outranked;
    }
    if (auto const* last = ended(c.leader); last && identity_of(c) <= *last) return claim_outcome::expired;
    if (phase_ != phase::none && claim_.leader == c.leader) {
      identity const current = identity_of(claim_);
      if (identity_of(c) < current) return claim_outcome::expired;
      if (identity_of(c) == current) {
        expiry_ = (std::min)(expiry_, now + c.remaining);
        bool const again = phase_ == phase::released;
        bool const newer = c.version > claim_.version;
        phase_ = phase::obeying;
        if (newer) claim_ = c;
        return again ? claim_outcome::adopted : newer ? claim_outcome::revised : claim_outcome::repeated;
      }
    }
    if (active() && c.stamp < claim_.stamp) return claim_outcome::outranked;
    if (!active() && c.stamp < mine) {
      bury(c.leader, identity_of(c));
      return claim_outcome::challenged;
    }
    supersede();
    claim_ = c;
    phase_ = phase::obeying;
    expiry_ = now + c.remaining;
    return claim_outcome::adopted;
  }

  /// Ends the claim in force if its time is over. True if the robot led or obeyed until now.
  bool expire(instant now) {
    if (phase_ == phase::none || now < expiry_) return false;
    bool const was_active = active();
    end();
    return was_active;
  }
  /// Ends the claim in force, if any. No copy of it will be obeyed again.
  void end() {
    if (phase_ == phase::none) return;
    bury(claim_.leader, identity_of(claim_));
    phase_ = phase::none;
  }
  /// Stops obeying: the leader seems to be gone, or the robot itself leaves. If it hears the claim again before it expires,
  /// it obeys again.
  void release() {
    if (obeying()) phase_ = phase::released;
  }

  /// Takes in what the leader has deliberated. A changed allocation is a new version. The claim is due at once if it
  /// changed or was never sent. @pre `leading()`
  void revise(allocation_atoms<V> const& atoms, instant now) {
    ROTA_ASSERT(leading());
    if (claim_.atoms == atoms && said_) return;
    if (claim_.atoms != atoms) ++claim_.version;
    claim_.atoms = atoms;
    next_repeat_ = now;
  }

  /// When the leader has to send its claim next; `never` for everybody else.
  [[nodiscard]] instant next_due() const noexcept { return leading() ? next_repeat_ : never; }
  /// The leader's claim if it is due, with the remaining time filled in. O(|claim|).
  [[nodiscard]] std::optional<claim<V>> next_claim(instant now, duration period) {
    if (!leading() || now < next_repeat_ || now >= expiry_) return std::nullopt;
    next_repeat_ = now + period;
    said_ = true;
    claim_.remaining = expiry_ - now;
    return claim_;
  }

  friend bool operator==(authority const&, authority const&) = default;

private:
  enum class phase : unsigned char { none, leading, obeying, released };

  /// Orders the claims of one leader.
  struct identity {
    rota::incarnation incarnation{};
    std::uint64_t number = 0;
    friend auto operator<=>(identity const&, identity const&) = default;
  };
  /// The greatest identity among the claims of one leader that have ended here.
  struct grave {
    agent_id leader{};
    identity last;
    friend bool operator==(grave const&, grave const&) = default;
  };

  /// Ends the claim in force for good. A released claim is not buried: it may still be in force elsewhere.
  void supersede() {
    if (active()) end();
  }
  static identity identity_of(claim<V> const& c) { return {c.incarnation, c.number}; }
  static bool before(grave const& g, agent_id b) { return g.leader < b; }
  identity const* ended(agent_id leader) const {
    auto const* where = std::lower_bound(graves_.begin(), graves_.end(), leader, before);
    return where != graves_.end() && where->leader == leader ? &where->last : nullptr;
  }
  void bury(agent_id leader, identity last) {
    auto* where = std::lower_bound(graves_.begin(), graves_.end(), leader, before);
    if (where == graves_.end() || !(where->leader == leader)) where = graves_.insert(where, {leader, {}});
    where->last = (std::max)(where->last, last);
  }

  phase phase_ = phase::none;
  claim<V> claim_;
  instant expiry_{};
  instant next_repeat_{};
  bool said_ = false;              // the claim was sent at least once
  std::uint64_t numbers_ = 0;      // claims made by this robot
  small_vector<grave, 4> graves_;  // ascending by leader; at most one per agent of the roster
};

}  // namespace rota
