#pragma once

#include <rota/algebra/apply.hpp>
#include <rota/core/time.hpp>
#include <rota/model/allocation.hpp>
#include <rota/team/cycle.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>

namespace rota {

/// When a monitor fires, and what it forgets.
struct monitor_options {
  std::uint32_t cycles = 4;           ///< n of the paper: so many subsequent cycles are a conflict that does not heal
  duration pending_age = seconds(1);  ///< a message event that no reallocation answered in this time is forgotten

  friend bool operator==(monitor_options const&, monitor_options const&) = default;
};

/// What one deliberation meant to a monitor.
template <vocabulary V>
struct monitor_verdict {
  std::uint32_t cycles = 0;                   ///< cycles that this deliberation completed
  std::optional<typename V::agent> detected;  ///< the sender whose n-th subsequent cycle it was (the least, if several)
};

/// The default monitor: one counter per sender, which loss, duplicates and third agents do not disturb.
///
/// A message event from b opens a *pending* (b, b's old part); a deliberation that restores the old part completes a
/// cycle; n subsequent ones are a detection. The rules, and the runs on which the literal reading fails, are in
/// docs/monitor.md. The agent drops old and duplicate messages before they come here (rule i), and calls `clear` on
/// entering or leaving authority and on leaving the plan type (rule vi).
template <vocabulary V = runtime_vocabulary>
class cycle_monitor {
public:
  using agent_id = typename V::agent;
  using part = std::optional<in<V>>;

  cycle_monitor() = default;
  explicit cycle_monitor(monitor_options options) : options_(options) {}

  /// b's part of the receiver's allocation went from `before` to `after` because of a message. Rules ii, iv, v.
  void on_message(agent_id b, part const& before, part const& after, instant now) {
    bool const agreeing = before == after;
    watch* w = find(b);
    if (!w && agreeing) return;
    if (!w) w = insert(b);
    bool const unanswered = w->open && !w->deliberated;
    if (unanswered) {
      if (!agreeing && after == w->old_part) w->open = false;
      return;
    }
    if (agreeing || w->open) w->count = 0;
    w->open = !agreeing;
    w->deliberated = false;
    w->old_part = before;
    w->opened = now;
  }

  /// The receiver deliberated and now believes in `atoms`. Rule iii; fires at most once, then everything is cleared.
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
  /// b was deleted from the team.
  void forget(agent_id b) {
    if (watch* w = find(b)) watches_.erase(w);
  }

  friend bool operator==(cycle_monitor const&, cycle_monitor const&) = default;

private:
  struct watch {
    agent_id sender{};
    part old_part;
    instant opened{};
    std::uint32_t count = 0;
    bool open = false;
    bool deliberated = false;
    friend bool operator==(watch const&, watch const&) = default;
  };

  watch* lower(agent_id b) {
    return std::lower_bound(watches_.begin(), watches_.end(), b,
                            [](watch const& w, agent_id key) { return w.sender < key; });
  }
  watch* find(agent_id b) {
    watch* w = lower(b);
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

/// Def. 5 to the letter, with one counter per plan type: for reproduction and comparison, not for use.
///
/// Every pending message event is judged against the next reallocation; a cycle counts, anything else starts over. A
/// third robot's change in the same deliberation therefore hides a loop for ever.
template <vocabulary V = runtime_vocabulary>
class literal_monitor {
public:
  using agent_id = typename V::agent;
  using part = std::optional<in<V>>;

  literal_monitor() = default;
  explicit literal_monitor(monitor_options options) : options_(options) {}

  void on_message(agent_id b, part const& before, part const& after, instant /*now*/) {
    if (before == after) return;
    auto* const old = std::find_if(pending_.begin(), pending_.end(), [&](pending const& p) { return p.sender == b; });
    if (old != pending_.end()) pending_.erase(old);
    allocation_atoms<V> from, to;
    if (before) from.insert(*before);
    if (after) to.insert(*after);
    pending_.push_back({b, difference(from, to)});
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
