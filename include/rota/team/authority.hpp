#pragma once

#include <rota/team/detail/by_agent.hpp>
#include <rota/team/message.hpp>

#include <algorithm>
#include <compare>
#include <cstdint>
#include <optional>
#include <utility>

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

/// What hearing a claim did, and whether it was news.
struct heard_claim {
  claim_outcome outcome{};
  bool fresh = false;  ///< no copy of it with as little time left was heard before
  duration late{};     ///< this copy was under way for so much longer than the quickest one

  friend bool operator==(heard_claim, heard_claim) = default;
};

/// One robot's view of who rules one plan type: nobody, itself, or the leader that it obeys (section 4, the bully algorithm).
///
/// It remembers the last claim of every leader it has heard, and when that claim ends. A leader that gives way to a greater
/// one, or that the robot stops obeying, is not forgotten: if its claim is heard again and is still in force, it is obeyed
/// again once nobody greater rules.
///
/// Invariants, whatever is lost, duplicated, reordered or delayed: the robot obeys at most one leader; while it obeys, it
/// turns to no smaller stamp; a claim that has ended is never obeyed again; a claim is answered at most once. Copies of a
/// claim that are delayed by at most `max_delay` end at the earliest end that any of them names; no copy ends a reign more
/// than `max_delay` before the end that the first one named, so a copy with a corrupt time cannot end it at once.
/// Hence a reign ends at every follower no later than at its leader plus the greatest message delay.
template <vocabulary V = runtime_vocabulary>
class authority {
public:
  using agent_id = typename V::agent;

  /// A claim with less time left is not sent: messages count microseconds, and a claim with none left is refused.
  static constexpr duration least_remaining = microseconds(1);

  /// Identifies a claim of one leader; ordered by age.
  struct identity {
    rota::incarnation incarnation{};
    std::uint64_t number = 0;
    friend auto operator<=>(identity const&, identity const&) = default;
  };

  [[nodiscard]] bool leading() const noexcept { return phase_ == phase::leading; }
  [[nodiscard]] bool obeying() const noexcept { return phase_ == phase::obeying; }
  [[nodiscard]] bool active() const noexcept { return phase_ != phase::none; }
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

  /// Begins to lead with claim number `number`, which is first due at `due`. With `never` it is due once `revise` has
  /// named the allocation. @pre `!leading()`; numbers grow
  void lead(typename V::plan_type type, allocation_atoms<V> atoms, claim_stamp<V> mine, rota::incarnation incarnation,
            std::uint64_t number, instant now, instant due, instant expiry, std::uint32_t renewals = 0,
            std::uint32_t answers = 0) {
    ROTA_ASSERT(!leading());
    claim_ = {type, std::move(atoms), mine, mine.id, incarnation, number, 1, {}, {}, renewals, answers};
    phase_ = phase::leading;
    began_ = now;
    expiry_ = expiry;
    next_repeat_ = due;
    said_ = false;
  }

  /// Whether c has the identity of a claim that is remembered, and says something else: another stamp, other counts
  /// of renewals and answers, or another allocation in the same version. None of them ever changes, so such a message is a forgery or a fault.
  [[nodiscard]] bool contradicts(claim<V> const& c) const {
    if (known const* const k = known_.find(c.leader); k && k->last == identity_of(c) && k->stamp != c.stamp)
      return true;
    if (!active() || !(claim_.leader == c.leader) || identity_of(claim_) != identity_of(c)) return false;
    return claim_.stamp != c.stamp || claim_.renewals != c.renewals || claim_.answers != c.answers ||
           (claim_.version == c.version && claim_.atoms != c.atoms);
  }
  /// Whether the robot obeys a claim that this leader had not made when it had made `made` of them.
  [[nodiscard]] bool obeys_after(agent_id leader, rota::incarnation incarnation, std::uint64_t made) const {
    return obeying() && claim_.leader == leader && identity_of(claim_) > identity{incarnation, made};
  }
  /// Whether c renews the reign that the robot obeys.
  [[nodiscard]] bool renews(claim<V> const& c) const {
    return obeying() && claim_.leader == c.leader && identity_of(claim_) < identity_of(c) &&
           claim_.renewals < c.renewals;
  }
  /// The last claim of this leader that was heard, if any is remembered.
  [[nodiscard]] std::optional<identity> last_heard(agent_id leader) const {
    auto const* const k = known_.find(leader);
    return k ? std::optional{k->last} : std::nullopt;
  }
  /// The version of the claim in force, if it is c's.
  [[nodiscard]] std::optional<std::uint64_t> version_of(claim<V> const& c) const {
    if (!active() || !(claim_.leader == c.leader) || identity_of(claim_) != identity_of(c)) return std::nullopt;
    return claim_.version;
  }

  /// Hears a claim that is well-formed and from somebody else. `mine` is the robot's own stamp, were it to claim now;
  /// none if it would not. @pre `!contradicts(c)`
  heard_claim hear(claim<V> const& c, std::optional<claim_stamp<V>> const& mine, instant now, duration max_delay) {
    known& k = known_.at(c.leader);
    auto const id = identity_of(c);
    auto const end = now + c.remaining;
    if (id < k.last) return {claim_outcome::expired};
    bool const genuine = id > k.last || end >= k.earliest;  // or its time is forged, so that it ends the reign
    bool const fresh = id > k.last || (genuine && c.remaining < k.least);
    if (id > k.last) {
      k = {c.leader, id, c.stamp, end, end - max_delay, long_ago, c.remaining};
      if (obeying() && claim_.leader == c.leader)
        phase_ = phase::none;  // a leader that claims anew has ended the last one
    } else {
      k.expiry = (std::max)(k.earliest, (std::min)(k.expiry, end));
      if (genuine) k.least = (std::min)(k.least, c.remaining);
    }
    if (k.over || now >= k.expiry) {
      if (obeying() && claim_.leader == c.leader) phase_ = phase::none;
      if (!k.over && fresh) k.late = now;  // a copy that is not was recorded, and says nothing of its leader
      return {claim_outcome::expired};
    }
    return {judge(c, k, mine, now), fresh, (std::max)(end - k.expiry, duration{})};
  }

  /// Takes in that all claims of this leader up to `made` are over, but for `leads`. True if the claim in force ended by it.
  bool hear_over(agent_id leader, rota::incarnation incarnation, std::uint64_t made, std::uint64_t leads, instant now,
                 duration max_delay) {
    known* const k = known_.find(leader);
    if (!k) return false;
    if (k->last > identity{incarnation, made}) {  // it has not made this claim: a forgery, unless the message is late
      if (now - k->expiry > max_delay) known_.erase(leader);
      return false;
    }
    // A leader that leads with a later claim has renewed this one: that holds until the later one is heard.
    bool const leads_on = k->last.incarnation == incarnation && leads >= k->last.number;
    if (k->over || leads_on) return false;
    k->over = true;
    if (!obeying() || !(claim_.leader == leader)) return false;
    phase_ = phase::none;
    return true;
  }

  /// When the last claim of somebody with a stamp greater than `mine` was heard although it had ended here: one of the
  /// clocks has jumped, and its leader still rules. `long_ago` if there is none.
  [[nodiscard]] instant heard_late(claim_stamp<V> const& mine) const noexcept {
    instant latest = long_ago;
    for (known const& k : known_)
      if (mine < k.stamp) latest = (std::max)(latest, k.late);
    return latest;
  }

  /// Ends the claim in force if its time is over. Whether it did.
  bool expire(instant now) {
    if (!active() || now < expiry_) return false;
    phase_ = phase::none;
    return true;
  }
  /// Stops obeying, since the leader is gone or the robot itself leaves, or gives up its own claim. An obeyed claim that is
  /// heard again before it ends is obeyed again.
  void release() { phase_ = phase::none; }
  /// Forgets what it knows of a leader that was not heard for so long that it may begin a new life with any number.
  void forget(agent_id leader) {
    if (!(obeying() && claim_.leader == leader)) known_.erase(leader);
  }

  /// The leader has deliberated: a change is a new version. That, and a claim never sent, is due at once.
  /// @pre `leading()`
  void revise(allocation_atoms<V> const& atoms, instant now) {
    ROTA_ASSERT(leading());
    if (claim_.atoms == atoms && said_) return;
    if (claim_.atoms != atoms) ++claim_.version;
    claim_.atoms = atoms;
    next_repeat_ = now;
  }

  /// When the leader has to speak next; `never` for everybody else.
  [[nodiscard]] instant next_due() const noexcept {
    if (!leading()) return never;
    return next_repeat_ <= expiry_ - least_remaining ? next_repeat_ : (std::max)(next_repeat_, expiry_);
  }
  /// The leader's claim if it is due, with the remaining time filled in; `ages` is left to the caller. It repeats every
  /// `period`, and in the first `opening` of the reign every `opening_period`, but not with less than `least_remaining`
  /// left. O(|claim|).
  [[nodiscard]] std::optional<claim<V>> next_claim(instant now, duration period, duration opening = {},
                                                   duration opening_period = {}) {
    if (!leading() || now < next_repeat_ || now > expiry_ - least_remaining) return std::nullopt;
    next_repeat_ = now + (now - began_ < opening ? (std::min)(opening_period, period) : period);
    said_ = true;
    claim_.remaining = expiry_ - now;
    return claim_;
  }

  /// Moves everything it remembers by d: the clock has been set.
  void shift(duration d) noexcept {
    expiry_ = moved(expiry_, d);
    began_ = moved(began_, d);
    next_repeat_ = moved(next_repeat_, d);
    for (known& k : known_) {
      k.expiry = moved(k.expiry, d);
      k.earliest = moved(k.earliest, d);
      k.late = moved(k.late, d);
    }
  }

  template <class Digest>
  void digest_into(Digest& d) const {
    d(phase_);
    if (active()) {
      d(claim_.leader, claim_.incarnation.value, claim_.number, claim_.version, claim_.renewals, claim_.answers,
        claim_.stamp.confidence, expiry_);
      for (auto const& x : claim_.atoms) d(x.agent, x.plan, x.task);
      if (obeying()) d.all(claim_.ages);
    }
    if (leading()) d(began_, next_repeat_, said_);
    for (known const& k : known_)
      d(k.leader, k.last.incarnation.value, k.last.number, k.stamp.confidence, k.expiry, k.earliest, k.late, k.least,
        k.answered, k.over);
    d(known_.size());
  }
  friend bool operator==(authority const&, authority const&) = default;

private:
  enum class phase : unsigned char { none, leading, obeying };

  /// The last claim heard of one leader.
  struct known {
    agent_id leader{};
    identity last{};
    claim_stamp<V> stamp{};
    instant expiry{};         // the earliest end that any copy named, but at least `earliest`
    instant earliest{};       // the end that the first copy named, less the greatest delay
    instant late = long_ago;  // when a copy was last heard after that end
    duration least{};         // the least time left in any copy
    bool answered = false;    // this robot has claimed against it
    bool over = false;        // its leader says that it is
    friend bool operator==(known const&, known const&) = default;
  };

  /// What a claim in force means for who rules.
  claim_outcome judge(claim<V> const& c, known& k, std::optional<claim_stamp<V>> const& mine, instant now) {
    if (active() && claim_.leader == c.leader) {
      expiry_ = k.expiry;
      if (c.version <= claim_.version) return claim_outcome::repeated;
      claim_ = c;
      return claim_outcome::revised;
    }
    if (active() && c.stamp < claim_.stamp) {
      if (leading() && next_repeat_ != never) next_repeat_ = (std::min)(next_repeat_, now);
      return claim_outcome::outranked;
    }
    if (!active() && mine && c.stamp < *mine && !k.answered) {
      k.answered = true;
      return claim_outcome::challenged;
    }
    claim_ = c;
    phase_ = phase::obeying;
    expiry_ = k.expiry;
    return claim_outcome::adopted;
  }

  static identity identity_of(claim<V> const& c) { return {c.incarnation, c.number}; }

  phase phase_ = phase::none;
  claim<V> claim_;
  instant expiry_{};
  instant began_{};
  instant next_repeat_{};
  bool said_ = false;  // the claim was sent at least once
  detail::by_agent<known, &known::leader, 4> known_;
};

}  // namespace rota
