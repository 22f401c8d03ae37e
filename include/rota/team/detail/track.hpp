#pragma once

#include <rota/model/outline.hpp>
#include <rota/team/authority.hpp>
#include <rota/team/belief.hpp>

#include <algorithm>

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
  bool executing = false;
  bool lapsed = false;  // a reign has ended since the last deliberation

  /// Ends a reign whose time is over.
  void expire(instant now) {
    if (rule.expire(now)) normalise();
  }
  /// Back to normal after a reign. Rule vi of the monitor: what happened before or during authority never counts afterwards.
  void normalise() {
    monitor.clear();
    lapsed = true;
  }
  /// Ends the reign of a leader that has restarted: it knows nothing of what it claimed in its former life.
  void bury_former_life(agent_id sender, incarnation now_living) {
    if (!rule.obeying() || !(rule.current().leader == sender)) return;
    if (rule.current().incarnation >= now_living) return;
    rule.end();
    normalise();
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

  /// Counts in the leader and whom its claim is about. Only the leader has given a sign of life.
  void admit_all(claim<V> const& c, instant now) {
    believed.admit(c.leader, now);
    for (in<V> const& x : c.atoms)
      if (!believed.takes_part(x.agent)) believed.admit(x.agent, now);
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
    for (auto const& x : e) {
      if (x.value != sign::plus) continue;
      if (auto const* entry = names.find(x.atom.plan, x.atom.task)) believed.set_state(x.atom.agent, entry->state);
    }
  }

  friend bool operator==(track const&, track const&) = default;
};

}  // namespace rota::detail
