#pragma once

#include <rota/team/detail/by_agent.hpp>
#include <rota/team/monitors/verdict.hpp>

#include <cstdint>
#include <optional>
#include <utility>

namespace rota {

/// Counts how often a sender says that it has a task and is overridden: n times the same task, without being given it once,
/// are a detection. If something that it says between is accepted, it may be changing its mind rightly: then it takes
/// `monitor_options::yielding` times more. Another task that it is not given either begins the count anew.
///
/// It sees conflicts that complete no cycle: b insists on task 1, while a gives it 3, then 2, then 3 again, so no part is
/// ever restored; or b leaves between, or yields for a moment. It does not see a sender that never says the same twice;
/// `cycle_monitor` does.
template <vocabulary V = runtime_vocabulary>
class insistence_monitor {
public:
  using agent_id = typename V::agent;

  insistence_monitor() = default;
  explicit insistence_monitor(monitor_options options) : options_(options) {}

  /// Takes in what a message changed about its sender: `change.after` is what it says. O(senders watched).
  void on_message(part_change<V> const& change, instant now) {
    watch& w = watches_.at(change.agent);
    w.said = change.after;
    w.heard = now;
  }

  /// The receiver has deliberated and now believes in `atoms`. On a detection everything is cleared.
  [[nodiscard]] monitor_verdict<V> on_deliberation(event<in<V>> const& /*e_r*/, allocation_atoms<V> const& atoms,
                                                   instant /*now*/) {
    monitor_verdict<V> verdict;
    for (watch& w : watches_) {
      if (!w.said) continue;
      auto const said = *std::exchange(w.said, std::nullopt);
      auto const believed = part_of<V>(atoms, w.sender);
      bool const accepted = !believed.empty() && believed.front() == said;
      bool const again = w.count > 0 && said == w.overridden && w.heard - w.last <= 3 * options_.pending_age;
      if (accepted) {
        w.yielded = true;
        if (said == w.overridden) w.count = 0;
        continue;
      }
      if (!again) w.yielded = false;
      w.count = again ? w.count + 1 : 1;
      w.overridden = said;
      w.last = w.heard;
      if (w.count >= options_.cycles + (w.yielded ? options_.yielding : 0) && !verdict.detected)
        verdict.detected = w.sender;
    }
    if (verdict.detected) clear();
    return verdict;
  }

  void clear() noexcept { watches_.clear(); }
  /// Forgets b, which was deleted from the team.
  void forget(agent_id b) { watches_.erase(b); }
  /// Moves all instants by d: the clock has been set.
  void shift(duration d) noexcept {
    for (watch& w : watches_) {
      w.heard = moved(w.heard, d);
      w.last = moved(w.last, d);
    }
  }

  template <class Digest>
  void digest_into(Digest& d) const {
    for (watch const& w : watches_) {
      d(w.sender, w.said.has_value(), w.count);
      if (w.said) d(w.heard, w.said->plan, w.said->task);
      if (w.count > 0) d(w.last, w.yielded, w.overridden.plan, w.overridden.task);
    }
    d(watches_.size());
  }
  friend bool operator==(insistence_monitor const&, insistence_monitor const&) = default;

private:
  /// What the monitor remembers about one sender.
  struct watch {
    agent_id sender{};
    std::optional<in<V>> said{};  // since the last deliberation; what it says of having no task is no insisting
    instant heard{};
    in<V> overridden{};       // what it said before and was not given
    instant last{};           // when it last said so
    bool yielded = false;     // it said something else between that was accepted
    std::uint32_t count = 0;  // so often, whatever else it said between that was accepted
    friend bool operator==(watch const&, watch const&) = default;
  };

  monitor_options options_;
  detail::by_agent<watch, &watch::sender, 8> watches_;
};

}  // namespace rota
