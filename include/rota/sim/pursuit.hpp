#pragma once

#include <rota/core/lifetime.hpp>
#include <rota/search/best_allocation.hpp>
#include <rota/sim/log.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace rota::sim {

/// Lengths of episodes, exact to 0.1 ms.
///
/// Memory: disjoint intervals within a time T have at most √(2T) different lengths, so an hour needs at most 8,486 entries.
class length_statistics {
public:
  void add(duration d) {
    ++counts_[d.ns / unit];
    ++total_;
    sum_ += d;
  }
  /// Adds those of another run.
  void add(length_statistics const& other) {
    for (auto const& [length, times] : other.counts_) counts_[length] += times;
    total_ += other.total_;
    sum_ += other.sum_;
  }
  [[nodiscard]] std::uint64_t count() const noexcept { return total_; }
  /// 0 if there are none.
  [[nodiscard]] double mean_ms() const { return total_ == 0 ? 0 : to_milliseconds(sum_) / static_cast<double>(total_); }
  /// The least length in ms that at least `percent` of all episodes do not exceed; 0 if there are none.
  [[nodiscard]] double percentile_ms(std::uint64_t percent) const {
    std::uint64_t const rank = (total_ * percent + 99) / 100;
    std::uint64_t seen = 0;
    for (auto const& [length, times] : counts_)
      if ((seen += times) >= rank) return in_ms(length);
    return 0;
  }
  [[nodiscard]] double longest_ms() const { return counts_.empty() ? 0 : in_ms(counts_.rbegin()->first); }

private:
  static constexpr std::int64_t unit = 100'000;
  static double in_ms(std::int64_t tenths) { return static_cast<double>(tenths) / 10; }

  std::map<std::int64_t, std::uint64_t> counts_;
  std::uint64_t total_ = 0;
  duration sum_{};
};

/// How well a team pursues the ball. `pursuit_watch` defines each figure.
struct pursuit_figures {
  duration not_one{};
  duration wrong{};
  length_statistics reactions;
  std::uint64_t missed = 0;
};

/// Watches who attacks, and who should: the attackers of the best allocation under the true world for those who play. Robots
/// act as they believe, so a robot attacks while its own belief gives it an attack task. From `begin` on:
///
/// * not one: the time in which none attacks, or several do.
/// * wrong: the time in which somebody attacks who should not.
/// * change: others should attack than before, and that lasts for `lasting`; what lasts shorter is ignored.
/// * reaction: from the beginning of a change until exactly those attack who should; 0 if they did already.
/// * missed: a change without reaction until the next one, or until the end.
///
/// The true world is read at each deliberation.
class pursuit_watch {
public:
  using mask = std::uint32_t;  ///< of robots, by index

  static constexpr duration lasting = seconds(1);

  /// Both must outlive the watch. @pre at most 32 members, all called 1, 2, 3, …
  pursuit_watch(playbook const& book ROTA_LIFETIMEBOUND, team<names> const& members ROTA_LIFETIMEBOUND, instant begin)
      : book_(book), members_(members), begin_(begin), absent_(members.size(), true) {
    ROTA_ASSERT(members.size() <= 32);
  }
  pursuit_watch(playbook&&, team<names> const&, instant) = delete;
  pursuit_watch(playbook const&, team<names>&&, instant) = delete;

  void operator()(log_record const& r) {
    pass_to(r.time);
    bool const comes = r.what == happening::entered;
    bool const goes = r.what == happening::left || r.what == happening::crashed;
    if (comes || goes) {
      absent_[r.robot] = goes;
      known_ = {};
    }
    mask const self = mask{1} << r.robot;
    if (!r.change.empty() || comes || goes) attack_ = (attack_ & ~self) | (goes ? 0 : attackers(r.believed) & self);
    if (r.what == happening::deliberated || comes || goes) judge(r.truth);
  }

  /// Who should attack in the world of the last deliberation, and who attacks.
  [[nodiscard]] mask wanted() const noexcept { return wanted_; }
  [[nodiscard]] mask attacking() const noexcept { return attack_; }
  /// Whom an allocation lets attack.
  [[nodiscard]] mask attackers(allocation_atoms<names> const& atoms) const {
    mask who = 0;
    for (in<names> const& x : atoms)
      if (book_.attacks(x)) who |= mask{1} << (x.agent.value - 1);
    return who;
  }

  /// Closes what is open and returns the figures. Call it once.
  [[nodiscard]] pursuit_figures finish(instant end) {
    pass_to(end);
    if (awaited_) ++figures_.missed;
    return figures_;
  }

private:
  /// Accounts for the time up to t, when everything before t has happened.
  void pass_to(instant t) {
    if (t <= now_) return;
    instant const from = (std::max)(now_, begin_);
    if (from < t) {
      if (attack_ == 0 || (attack_ & (attack_ - 1)) != 0) figures_.not_one += t - from;
      if ((attack_ & ~wanted_) != 0) figures_.wrong += t - from;
    }
    react(t);
    now_ = t;
  }

  /// What the state since `now_`, which lasts until t, means for changes and reactions.
  void react(instant t) {
    if (wanted_ != candidate_) {
      candidate_ = wanted_;
      since_ = now_;
      reached_.reset();
    }
    if (!reached_ && attack_ == candidate_) reached_ = now_;
    if (awaited_ && attack_ == settled_) {
      figures_.reactions.add(now_ - *awaited_);
      awaited_.reset();
    }
    if (candidate_ == settled_ || t - since_ < lasting) return;
    if (awaited_) ++figures_.missed;
    awaited_.reset();
    bool const counts = settled_ && since_ >= begin_;
    settled_ = candidate_;
    if (!counts) return;
    if (reached_) {
      figures_.reactions.add(*reached_ - since_);
    } else {
      awaited_ = since_;
    }
  }

  void judge(world_state const& truth) {
    know(truth, seen_);
    if (seen_.ball == known_.ball && seen_.robots == known_.robots) return;
    std::swap(seen_, known_);
    small_vector<names::agent, 8> present;
    for (std::size_t i = 0; i < absent_.size(); ++i)
      if (!absent_[i]) present.push_back(members_.agents()[i]);
    auto const best = best_allocation(
        problem<names, perceived>(book_.type, members_, known_, {present.begin(), present.size()}), space_);
    wanted_ = best ? attackers(best->atoms) : 0;
  }

  playbook const& book_;
  team<names> const& members_;
  instant begin_;
  std::vector<bool> absent_;
  instant now_{};
  mask attack_ = 0;
  mask wanted_ = 0;
  mask candidate_ = 0;           // who should attack since `since_`
  std::optional<mask> settled_;  // … by the last change
  instant since_{};
  std::optional<instant> reached_;  // when exactly the candidates attacked first
  std::optional<instant> awaited_;  // the beginning of the last change, until the reaction to it
  pursuit_figures figures_;
  perceived known_;  // the world that `wanted_` is about
  perceived seen_;
  workspace space_;
};

}  // namespace rota::sim
