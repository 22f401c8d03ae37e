#pragma once

#include <rota/core/time.hpp>
#include <rota/model/allocation.hpp>
#include <rota/team/belief.hpp>
#include <rota/team/cycle.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>

namespace rota {

/// When a monitor fires, and what it forgets.
struct monitor_options {
  std::uint32_t cycles = 4;  ///< n of the paper: after so many subsequent cycles the conflict counts as lasting
  duration pending_age = seconds(1);  ///< a change that no deliberation has reversed for so long is forgotten

  friend bool operator==(monitor_options const&, monitor_options const&) = default;
};

/// What a monitor says about one deliberation.
template <vocabulary V>
struct monitor_verdict {
  std::uint32_t cycles = 0;                     ///< cycles that this deliberation completed
  std::optional<typename V::agent> detected{};  ///< the sender whose n-th subsequent cycle it was, the least of several
};

/// The default monitor: one counter per sender. Lost messages, duplicates and third agents do not disturb it.
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
    watch* w = find(change.agent);
    if (!w) {
      if (agreeing) return;
      w = insert(change.agent);
    }
    bool const unanswered = w->open && !w->deliberated;
    if (unanswered) {
      if (!agreeing && change.after == w->old_part) w->open = false;
      return;
    }
    if (agreeing || w->open) w->count = 0;
    w->open = !agreeing;
    w->deliberated = false;
    w->old_part = change.before;
    w->opened = now;
  }

  /// The receiver has deliberated and now believes in `atoms`. Rule iii. On a detection everything is cleared.
  [[nodiscard]] monitor_verdict<V> on_deliberation(event<in<V>> const& /*e_r*/, allocation_atoms<V> const& atoms,
                                                   instant now) {
    monitor_verdict<V> verdict;
    for (watch& w : watches_) {
      if (!w.open) continue;
      if (now - w.opened > options_.pending_age) {
        w.open = false;
        w.count = 0;
        continue;
      }
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
  void forget(agent_id b) {
    if (watch* const w = find(b)) watches_.erase(w);
  }

  friend bool operator==(cycle_monitor const&, cycle_monitor const&) = default;

private:
  /// What the monitor remembers about one sender.
  struct watch {
    agent_id sender{};
    std::optional<in<V>> old_part{};  // what a cycle would restore, while open
    instant opened{};
    std::uint32_t count = 0;   // subsequent cycles so far
    bool open = false;         // a message has changed the part, and no deliberation has restored it
    bool deliberated = false;  // a deliberation has run since, and has not restored it
    friend bool operator==(watch const&, watch const&) = default;
  };

  watch* lower(agent_id b) {
    return std::lower_bound(watches_.begin(), watches_.end(), b,
                            [](watch const& w, agent_id key) { return w.sender < key; });
  }
  watch* find(agent_id b) {
    watch* const w = lower(b);
    return w != watches_.end() && w->sender == b ? w : nullptr;
  }
  watch* insert(agent_id b) {
    watch fresh;
    fresh.sender = b;
    return watches_.insert(lower(b), fresh);
  }

  monitor_options options_;
  small_vector<watch, 8> watches_;  // ascending by sender
};

/// Def. 5 to the letter, with one counter per plan type: to reproduce and to compare, not to use.
///
/// It compares every pending message event with the next reallocation. A cycle counts; anything else sets the counter to 0.
/// Therefore a third robot that keeps changing in the same deliberations hides a loop for ever.
template <vocabulary V = runtime_vocabulary>
class literal_monitor {
public:
  using agent_id = typename V::agent;

  literal_monitor() = default;
  explicit literal_monitor(monitor_options options) : options_(options) {}

  void on_message(part_change<V> const& change, instant /*now*/) {
    if (change.empty()) return;
    forget(change.agent);
    pending_.push_back({change.agent, change.event()});
  }

  [[nodiscard]] monitor_verdict<V> on_deliberation(event<in<V>> const& e_r, allocation_atoms<V> const& /*atoms*/,
                                                   instant /*now*/) {
    monitor_verdict<V> verdict;
    if (e_r.empty()) return verdict;
    for (pending const& p : pending_) {
      if (!is_cycle(p.e_m, e_r, p.sender)) {
        count_ = 0;
        continue;
      }
      ++verdict.cycles;
      if (++count_ >= options_.cycles && !verdict.detected) verdict.detected = p.sender;
    }
    pending_.clear();
    if (verdict.detected) clear();
    return verdict;
  }

  void clear() noexcept {
    pending_.clear();
    count_ = 0;
  }
  void forget(agent_id b) {
    auto* const old = std::find_if(pending_.begin(), pending_.end(), [&](pending const& p) { return p.sender == b; });
    if (old != pending_.end()) pending_.erase(old);
  }

  friend bool operator==(literal_monitor const&, literal_monitor const&) = default;

private:
  struct pending {
    agent_id sender{};
    event<in<V>> e_m;
    friend bool operator==(pending const&, pending const&) = default;
  };

  monitor_options options_;
  small_vector<pending, 4> pending_;  // in order of arrival
  std::uint32_t count_ = 0;
};

}  // namespace rota
