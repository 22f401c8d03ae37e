#pragma once

#include <rota/model/outline.hpp>
#include <rota/team/authority.hpp>
#include <rota/team/belief.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace rota::detail {

/// What a robot knows of one plan type that it executes or has executed. It is kept after leaving the type: claim numbers
/// must go on, and claims that have ended must stay so.
template <vocabulary V, class Monitor>
struct track {
  using agent_id = typename V::agent;

  outline<V> names;
  belief<V> believed;
  Monitor monitor;
  authority<V> rule;
  claim_stamp<V> stamp{};           // of this robot's claims; not computed anew before `frozen_until`
  instant frozen_until = long_ago;  // the end of the last claim that it knows of
  bool executing = false;
  bool judged = false;            // the last deliberation chose what is believed, and nothing has changed it since
  bool lapsed = false;            // a reign has ended since the last deliberation
  bool blind = false;             // it found no valid allocation: it neither counts cycles, claims nor answers
  instant abstains_from = never;  // … and says so, if by then it has not found one
  rota::stance stance = rota::stance::none;  // what the last deliberation came to

  /// Ends a reign whose time is over.
  void expire(instant now) {
    if (rule.expire(now)) normalise();
  }
  /// Back to normal after a reign. Rule vi of the monitor: what happened before or during authority never counts afterwards.
  void normalise() {
    monitor.clear();
    lapsed = true;
  }
  /// b no longer takes part. If b was the leader, its reign ends here.
  part_change<V> dismiss(agent_id b) {
    auto const change = believed.expel(b);
    if (rule.obeying() && rule.current().leader == b) {
      rule.release();
      normalise();
    }
    return change;
  }
  /// Deletes everybody but `self` that was not heard for longer than `silence`.
  event<in<V>> delete_silent(agent_id self, instant now, duration silence) {
    event<in<V>> total;
    for (std::size_t i = 0; i < believed.participants().size();) {
      agent_id const b = believed.participants()[i];
      if (b == self || now - believed.heard(b) <= silence) {
        ++i;
        continue;
      }
      total = compose(total, dismiss(b).event());
      monitor.forget(b);
    }
    return total;
  }

  /// Admits the leader, and each claimed agent that the leader has heard within `silence`. Only the leader itself has given a
  /// sign of life. The claim may have been under way for `max_delay`, so ages count from then: or else who is dead would
  /// grow younger with every leader that passes it on.
  /// @return the claim's allocation, without agents that do not take part @pre as many ages as atoms
  allocation_atoms<V> admit_all(claim<V> const& c, instant now, duration silence, duration max_delay) {
    believed.admit(c.leader, now);
    small_vector<in<V>, 8> alive;
    for (std::size_t i = 0; i < c.atoms.size(); ++i) {
      in<V> const& x = c.atoms.begin()[i];
      if (c.ages[i] <= silence - max_delay) believed.admit(x.agent, now - c.ages[i] - max_delay);
      if (believed.takes_part(x.agent)) alive.push_back(x);
    }
    return allocation_atoms<V>::from_ascending(std::move(alive));
  }
  /// Whether the entered plan type has every plan and task of this allocation.
  [[nodiscard]] bool knows(allocation_atoms<V> const& atoms) const {
    return std::all_of(atoms.begin(), atoms.end(), [&](in<V> const& x) { return names.find(x.plan, x.task); });
  }
  /// Adopts an allocation. Whoever gets a new task is taken to begin in its entry state.
  /// @pre `e` leads from the believed allocation to `atoms`
  void adopt(allocation_atoms<V> const& atoms, event<in<V>> const& e) {
    if (e.empty()) return;
    believed.replace(atoms);
    begin(e);
  }
  /// As `adopt`, where a leader says so.
  void obey(allocation_atoms<V> const& atoms, event<in<V>> const& e) {
    believed.impose(atoms);
    begin(e);
  }
  void begin(event<in<V>> const& e) {
    for (auto const& x : e) {
      if (x.value != sign::plus) continue;
      if (auto const* entry = names.find(x.atom.plan, x.atom.task)) believed.set_state(x.atom.agent, entry->state);
    }
  }

  /// The stamp of a claim made now by `self`. It stays the same for as long as any claim it knows of can live.
  claim_stamp<V> stamp_at(std::uint32_t confidence, agent_id self, instant now) {
    if (now >= frozen_until) stamp = {confidence, self};
    return stamp;
  }
  /// A reign is renewed: who leads from now on is decided anew.
  void thaw() { frozen_until = long_ago; }
  void freeze(instant until) { frozen_until = (std::max)(frozen_until, until); }
  /// Time since b was last heard; just over `silence` if b has left or was deleted since the leader deliberated.
  [[nodiscard]] duration age_of(agent_id b, agent_id self, instant now, duration silence) const {
    if (b == self) return {};
    return believed.takes_part(b) ? now - believed.heard(b) : silence + nanoseconds(1);
  }
  /// Of the believed allocation; 0 where atoms have no code.
  [[nodiscard]] std::uint32_t fingerprint() const {
    if constexpr (encodable_atom<in<V>>) {
      return believed.fingerprint();
    } else {
      return 0;
    }
  }

  /// Moves all instants by d: the clock has been set.
  void shift(duration d) noexcept {
    believed.shift(d);
    monitor.shift(d);
    rule.shift(d);
    frozen_until = moved(frozen_until, d);
    if (blind) abstains_from = moved(abstains_from, d);
  }

  template <class Digest>
  void digest_into(Digest& d) const {
    d(names.type(), believed, monitor, rule, stamp.confidence, executing, judged, lapsed, blind, stance)
        .until(frozen_until);
    if (blind) d.until(abstains_from);
  }
  friend bool operator==(track const&, track const&) = default;
};

}  // namespace rota::detail
