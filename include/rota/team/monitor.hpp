#pragma once

#include <rota/team/monitors/cycle.hpp>
#include <rota/team/monitors/insistence.hpp>
#include <rota/team/monitors/verdict.hpp>

#include <algorithm>

namespace rota {

/// Two monitors side by side; the first that fires is right.
template <class First, class Second>
class either_monitor {
public:
  using agent_id = typename First::agent_id;

  either_monitor() = default;
  explicit either_monitor(monitor_options options) : first_(options), second_(options) {}

  template <vocabulary V>
  void on_message(part_change<V> const& change, instant now) {
    first_.on_message(change, now);
    second_.on_message(change, now);
  }
  template <vocabulary V>
  [[nodiscard]] monitor_verdict<V> on_deliberation(rota::event<in<V>> const& e_r, allocation_atoms<V> const& atoms,
                                                   instant now) {
    auto verdict = first_.on_deliberation(e_r, atoms, now);
    auto const other = second_.on_deliberation(e_r, atoms, now);
    verdict.cycles = (std::max)(verdict.cycles, other.cycles);
    if (!verdict.detected) verdict.detected = other.detected;
    if (verdict.detected) clear();
    return verdict;
  }
  void clear() noexcept {
    first_.clear();
    second_.clear();
  }
  void forget(agent_id b) {
    first_.forget(b);
    second_.forget(b);
  }
  void shift(duration d) noexcept {
    first_.shift(d);
    second_.shift(d);
  }

  template <class Digest>
  void digest_into(Digest& d) const {
    d(first_, second_);
  }
  friend bool operator==(either_monitor const&, either_monitor const&) = default;

private:
  First first_;
  Second second_;
};

/// The default monitor: cycles and insistence. docs/monitor.md has the table that it was chosen from.
template <vocabulary V = runtime_vocabulary>
using conflict_monitor = either_monitor<cycle_monitor<V>, insistence_monitor<V>>;

}  // namespace rota
