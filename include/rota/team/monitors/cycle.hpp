#pragma once

#include <rota/team/detail/by_agent.hpp>
#include <rota/team/monitors/verdict.hpp>

#include <cstdint>
#include <optional>

namespace rota {

/// Counts the cycles of Def. 5, one counter per sender. Lost messages, duplicates and third agents do not disturb it.
///
/// When a message changes b's part, the monitor remembers the old part. A deliberation that restores it completes a cycle;
/// n subsequent cycles are a detection. docs/monitor.md has the rules, and the runs on which the literal reading fails. The
/// robot drops old and duplicate messages before they come here (rule i). It calls `clear` when it begins or ceases to lead
/// or obey, and when it leaves the plan type (rule vi).
template <vocabulary V = runtime_vocabulary>
class cycle_monitor {
public:
  using agent_id = typename V::agent;

  cycle_monitor() = default;
  explicit cycle_monitor(monitor_options options) : options_(options) {}

  /// Takes in what a message changed about its sender. Rules ii, iv, v. O(senders watched).
  void on_message(part_change<V> const& change, instant now) {
    bool const agreeing = change.empty();
    if (agreeing && !watches_.find(change.agent)) return;
    watch& w = watches_.at(change.agent);
    if (w.open && !w.deliberated) {
      if (!agreeing && change.after == w.old_part) w.open = false;
      return;
    }
    if (agreeing || w.open) w.count = 0;
    w.open = !agreeing;
    w.deliberated = false;
    w.old_part = change.before;
    w.opened = now;
  }

  /// The receiver has deliberated and now believes in `atoms`. Rule iii. On a detection everything is cleared.
  [[nodiscard]] monitor_verdict<V> on_deliberation(event<in<V>> const& /*e_r*/, allocation_atoms<V> const& atoms,
                                                   instant now) {
    monitor_verdict<V> verdict;
    for (watch& w : watches_) {
      if (now - w.opened > options_.pending_age) w.open = false, w.count = 0;
      if (!w.open) continue;
      auto const restored = part_of<V>(atoms, w.sender);
      bool const same = w.old_part ? !restored.empty() && restored.front() == *w.old_part : restored.empty();
      if (!same) {
        w.deliberated = true;
        continue;
      }
      w.open = false;
      ++w.count;
      ++verdict.cycles;
      if (w.count >= options_.cycles && !verdict.detected) verdict.detected = w.sender;
    }
    if (verdict.detected) clear();
    return verdict;
  }

  void clear() noexcept { watches_.clear(); }
  /// Forgets b, which was deleted from the team.
  void forget(agent_id b) { watches_.erase(b); }
  /// Moves all instants by d: the clock has been set.
  void shift(duration d) noexcept {
    for (watch& w : watches_) w.opened = moved(w.opened, d);
  }

  template <class Digest>
  void digest_into(Digest& d) const {
    for (watch const& w : watches_) {
      if (!w.open && w.count == 0) continue;
      d(w.sender, w.opened, w.count, w.open);
      if (w.open) d(w.deliberated, w.old_part.has_value());
      if (w.open && w.old_part) d(w.old_part->plan, w.old_part->task);
    }
  }
  friend bool operator==(cycle_monitor const&, cycle_monitor const&) = default;

private:
  /// What the monitor remembers about one sender.
  struct watch {
    agent_id sender{};
    std::optional<in<V>> old_part{};  // what a cycle would restore, while open
    instant opened{};                 // when a message was last taken in
    std::uint32_t count = 0;          // subsequent cycles so far
    bool open = false;                // a message has changed the part, and no deliberation has restored it
    bool deliberated = false;         // a deliberation has run since, and has not restored it
    friend bool operator==(watch const&, watch const&) = default;
  };

  monitor_options options_;
  detail::by_agent<watch, &watch::sender, 8> watches_;
};

}  // namespace rota
