#pragma once

#include <rota/team/message.hpp>

#include <algorithm>
#include <compare>
#include <cstdint>
#include <optional>

namespace rota {

/// What hearing a claim did.
enum class claim_outcome : unsigned char {
  adopted,     ///< a new claim, now obeyed
  revised,     ///< a new version of the obeyed claim
  repeated,    ///< nothing new; at most the expiry came nearer
  expired,     ///< that claim, or a later one of its leader, has already ended here: it never revives
  outranked,   ///< one leads or obeys with a greater stamp; a leader answers with its own claim
  challenged   ///< one's own stamp is greater: time to claim
};

/// One agent's view of who rules one plan type: nobody, itself, or the leader it obeys (section 4, the bully algorithm).
///
/// Invariants, over any loss, duplication, reordering and delay: at most one leader is obeyed; while one is obeyed, never
/// a smaller stamp; copies of one claim expire at the minimum over the copies; what has expired never revives. So a reign
/// ends at every follower no later than at its leader plus the greatest message delay.
template <vocabulary V = runtime_vocabulary>
class authority {
public:
  using agent_id = typename V::agent;

  [[nodiscard]] bool leading() const noexcept { return phase_ == phase::leading; }
  [[nodiscard]] bool obeying() const noexcept { return phase_ == phase::obeying; }
  [[nodiscard]] bool active() const noexcept { return phase_ != phase::none; }
  /// The claim in force: one's own, or the obeyed one. @pre `active()`
  [[nodiscard]] claim<V> const& current() const noexcept {
    ROTA_ASSERT(active());
    return claim_;
  }
  /// When the claim in force ends here. @pre `active()`
  [[nodiscard]] instant expiry() const noexcept {
    ROTA_ASSERT(active());
    return expiry_;
  }

  /// Begins to lead with a claim of one's own. Its number is one more than that of the last. @pre `!leading()`
  void lead(typename V::plan_type type, allocation_atoms<V> atoms, claim_stamp<V> mine, std::uint64_t incarnation,
            instant now, duration reign) {
    ROTA_ASSERT(!leading());
    end();
    claim_ = {type, std::move(atoms), mine, mine.id, incarnation, ++numbers_, 1, reign};
    phase_ = phase::leading;
    expiry_ = now + reign;
    next_repeat_ = now;
  }

  /// Hears a claim that is well-formed and from somebody else. `mine` is one's own stamp, were one to claim now.
  claim_outcome hear(claim<V> const& c, claim_stamp<V> const& mine, instant now) {
    if (auto const* last = ended(c.leader); last && identity_of(c) <= *last) return claim_outcome::expired;
    if (active() && claim_.leader == c.leader) {
      identity const current = identity_of(claim_);
      if (identity_of(c) < current) return claim_outcome::expired;
      if (identity_of(c) == current) {
        expiry_ = std::min(expiry_, now + c.remaining);
        if (c.version <= claim_.version) return claim_outcome::repeated;
        claim_ = c;
        return claim_outcome::revised;
      }
    }
    if (active() && c.stamp < claim_.stamp) {
      if (leading()) next_repeat_ = now;
      return claim_outcome::outranked;
    }
    if (!active() && c.stamp < mine) return claim_outcome::challenged;
    end();
    claim_ = c;
    phase_ = phase::obeying;
    expiry_ = now + c.remaining;
    return claim_outcome::adopted;
  }

  /// Ends the claim in force if its time is over; whether it did.
  bool expire(instant now) {
    if (!active() || now < expiry_) return false;
    end();
    return true;
  }
  /// Ends the claim in force, if any; no copy of it will revive.
  void end() {
    if (!active()) return;
    bury(claim_.leader, identity_of(claim_));
    phase_ = phase::none;
  }

  /// The leader changed its mind: a new version, due at once. @pre `leading()`
  void revise(allocation_atoms<V> const& atoms, instant now) {
    ROTA_ASSERT(leading());
    if (claim_.atoms == atoms) return;
    claim_.atoms = atoms;
    ++claim_.version;
    next_repeat_ = now;
  }

  /// When the leader has to speak next; `never` for everybody else.
  [[nodiscard]] instant next_due() const noexcept { return leading() ? next_repeat_ : never; }
  /// The leader's claim if it is due, with the remaining time filled in. O(|claim|).
  [[nodiscard]] std::optional<claim<V>> next_claim(instant now, duration period) {
    if (!leading() || now < next_repeat_ || now >= expiry_) return std::nullopt;
    next_repeat_ = now + period;
    claim_.remaining = expiry_ - now;
    return claim_;
  }

  friend bool operator==(authority const&, authority const&) = default;

private:
  enum class phase : unsigned char { none, leading, obeying };

  /// Orders the claims of one leader.
  struct identity {
    std::uint64_t incarnation = 0;
    std::uint64_t number = 0;
    friend constexpr auto operator<=>(identity const&, identity const&) = default;
  };
  struct grave {
    agent_id leader{};
    identity last;
    friend bool operator==(grave const&, grave const&) = default;
  };

  static identity identity_of(claim<V> const& c) { return {c.incarnation, c.number}; }
  static bool before(grave const& g, agent_id b) { return g.leader < b; }
  identity const* ended(agent_id leader) const {
    auto const* where = std::lower_bound(graves_.begin(), graves_.end(), leader, before);
    return where != graves_.end() && where->leader == leader ? &where->last : nullptr;
  }
  void bury(agent_id leader, identity last) {
    auto* where = std::lower_bound(graves_.begin(), graves_.end(), leader, before);
    if (where == graves_.end() || !(where->leader == leader)) where = graves_.insert(where, {leader, {}});
    where->last = std::max(where->last, last);
  }

  phase phase_ = phase::none;
  claim<V> claim_;
  instant expiry_{};
  instant next_repeat_{};
  std::uint64_t numbers_ = 0;       // claims made by this agent
  small_vector<grave, 4> graves_;   // ascending by leader; at most one per agent of the roster
};

}  // namespace rota
