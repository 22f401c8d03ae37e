#pragma once

#include <rota/algebra/fingerprint.hpp>
#include <rota/team/monitors/verdict.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace rota {

/// Counts how often the whole allocation returns to one that it was before, by fingerprints: to compare, not to use.
///
/// A repetition is a deliberation that changes the allocation, after a message that did, to one of the last sixteen within
/// `pending_age`. It sees loops of any period, and sees loops where there are none: an allocation has few values.
template <vocabulary V = runtime_vocabulary>
  requires encodable_atom<in<V>>
class repetition_monitor {
public:
  using agent_id = typename V::agent;

  repetition_monitor() = default;
  explicit repetition_monitor(monitor_options options) : options_(options) {}

  void on_message(part_change<V> const& change, instant /*now*/) {
    if (!change.empty()) sender_ = change.agent;
  }
  [[nodiscard]] monitor_verdict<V> on_deliberation(event<in<V>> const& e_r, allocation_atoms<V> const& atoms,
                                                   instant now) {
    monitor_verdict<V> verdict;
    if (e_r.empty()) return verdict;
    auto const print = fingerprint_of(atoms);
    bool again = false;
    for (auto const& s : seen_) again |= s.print == print && now - s.when <= options_.pending_age;
    if (now - last_ > options_.pending_age) count_ = 0;
    if (sender_ && again) {
      last_ = now;
      if (++count_ >= options_.cycles) verdict.detected = sender_;
    }
    if (seen_.size() == most) seen_.erase(seen_.begin());
    seen_.push_back({print, now});
    sender_.reset();
    if (verdict.detected) clear();
    return verdict;
  }

  void clear() noexcept {
    seen_.clear();
    sender_.reset();
    count_ = 0;
  }
  void forget(agent_id) noexcept {}
  /// Moves all instants by d: the clock has been set.
  void shift(duration d) noexcept {
    for (auto& s : seen_) s.when = moved(s.when, d);
    last_ = moved(last_, d);
  }

  template <class Digest>
  void digest_into(Digest& d) const {
    for (auto const& s : seen_) d(s.print.value, s.when);
    d(seen_.size(), sender_, last_, count_);
  }
  friend bool operator==(repetition_monitor const&, repetition_monitor const&) = default;

private:
  static constexpr std::size_t most = 16;
  struct sight {
    fingerprint print;
    instant when{};
    friend bool operator==(sight const&, sight const&) = default;
  };

  monitor_options options_;
  small_vector<sight, most> seen_;  // in order of time
  std::optional<agent_id> sender_;  // of the last message since a deliberation that changed the allocation
  instant last_{};
  std::uint32_t count_ = 0;
};

}  // namespace rota
