#pragma once

#include <rota/team/cycle.hpp>
#include <rota/team/monitors/verdict.hpp>

#include <algorithm>
#include <cstdint>

namespace rota {

/// Def. 5 to the letter, with one counter per plan type: to reproduce and to compare, not to use.
///
/// It compares every pending message event with the next reallocation. A cycle counts; anything else sets the counter to 0.
/// Therefore one change of a third robot in the same deliberation hides a loop for ever.
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
  /// The clock has been set: this monitor knows no time.
  void shift(duration) noexcept {}
  void forget(agent_id b) {
    auto* const old = std::find_if(pending_.begin(), pending_.end(), [&](pending const& p) { return p.sender == b; });
    if (old != pending_.end()) pending_.erase(old);
  }

  template <class Digest>
  void digest_into(Digest& d) const {
    for (pending const& p : pending_) {
      d(p.sender);
      for (auto const& x : p.e_m) d(x.value, x.atom.agent, x.atom.plan, x.atom.task);
    }
    d(pending_.size(), count_);
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
