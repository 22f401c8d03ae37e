#pragma once

#include <rota/team/monitors/verdict.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>

namespace rota {

/// Counts how often a sender says the same of itself, and is overridden each time: n times in a row are a detection.
///
/// It sees conflicts that complete no cycle: b insists on task 1, while a gives it 3, then 2, then 3 again, so no part is
/// ever restored. It does not see a sender that changes its mind; `cycle_monitor` does.
template <vocabulary V = runtime_vocabulary>
class insistence_monitor {
public:
  using agent_id = typename V::agent;

  insistence_monitor() = default;
  explicit insistence_monitor(monitor_options options) : options_(options) {}

  /// Takes in what a message changed about its sender: `change.after` is what it says. O(senders watched).
  void on_message(part_change<V> const& change, instant now) {
    watch* w = lower(change.agent);
    if (w == watches_.end() || !(w->sender == change.agent)) w = watches_.insert(w, watch{.sender = change.agent});
    if (w->said != change.after || now - w->heard > options_.pending_age) w->count = 0;
    w->said = change.after;
    w->heard = now;
    w->unanswered = true;
  }

  /// The receiver has deliberated and now believes in `atoms`. On a detection everything is cleared.
  [[nodiscard]] monitor_verdict<V> on_deliberation(event<in<V>> const& /*e_r*/, allocation_atoms<V> const& atoms,
                                                   instant /*now*/) {
    monitor_verdict<V> verdict;
    for (watch& w : watches_) {
      if (!w.unanswered) continue;
      w.unanswered = false;
      auto const believed = part_of<V>(atoms, w.sender);
      bool const same = w.said ? !believed.empty() && believed.front() == *w.said : believed.empty();
      w.count = same ? 0 : w.count + 1;
      if (w.count >= options_.cycles && !verdict.detected) verdict.detected = w.sender;
    }
    if (verdict.detected) clear();
    return verdict;
  }

  void clear() noexcept { watches_.clear(); }
  /// Forgets b, which was deleted from the team.
  void forget(agent_id b) {
    watch* const w = lower(b);
    if (w != watches_.end() && w->sender == b) watches_.erase(w);
  }
  /// Moves all instants by d: the clock has been set.
  void shift(duration d) noexcept {
    for (watch& w : watches_) w.heard = w.heard + d;
  }

  template <class Digest>
  void digest_into(Digest& d) const {
    for (watch const& w : watches_) {
      d(w.sender, w.said.has_value(), w.heard, w.count, w.unanswered);
      if (w.said) d(w.said->plan, w.said->task);
    }
    d(watches_.size());
  }
  friend bool operator==(insistence_monitor const&, insistence_monitor const&) = default;

private:
  /// What the monitor remembers about one sender.
  struct watch {
    agent_id sender{};
    std::optional<in<V>> said{};
    instant heard{};
    std::uint32_t count = 0;  // so often in a row it said so and was overridden
    bool unanswered = false;  // no deliberation has run since
    friend bool operator==(watch const&, watch const&) = default;
  };

  watch* lower(agent_id b) {
    return std::lower_bound(watches_.begin(), watches_.end(), b,
                            [](watch const& w, agent_id key) { return w.sender < key; });
  }

  monitor_options options_;
  small_vector<watch, 8> watches_;  // ascending by sender
};

}  // namespace rota
