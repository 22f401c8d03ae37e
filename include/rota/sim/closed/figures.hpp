#pragma once

#include <rota/sim/closed/world.hpp>
#include <rota/sim/metrics.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace rota::sim::closed {

/// The figures of one game. `tally` defines each of them.
struct game_figures {
  duration measured{};
  duration in_conflict{};
  duration several{};  ///< two or more attack
  duration nobody{};   ///< nobody attacks
  duration wrong{};    ///< one attacks, and it is clearly the wrong one
  length_statistics episodes;
  length_statistics reactions;
  duration reacted{};  ///< the sum of all reactions
  std::uint64_t missed = 0;
  std::uint64_t won = 0;  ///< balls
  duration free{};        ///< so long they lay free, together
  std::uint64_t reigns = 0;
  std::uint64_t right = 0;  ///< of these
  std::uint64_t messages = 0;
  std::uint64_t bytes = 0;

  [[nodiscard]] double share(duration d) const {
    return measured.ns == 0 ? 0 : static_cast<double>(d.ns) / static_cast<double>(measured.ns);
  }
  /// Of time without exactly one attacker.
  [[nodiscard]] double incoherent() const { return share(several + nobody); }
  [[nodiscard]] double reaction_ms() const {
    auto const n = reactions.count();
    return n == 0 ? 0 : to_milliseconds(reacted) / static_cast<double>(n);
  }
  /// Of all true changes, those to which nobody reacted in time.
  [[nodiscard]] double missed_share() const {
    auto const all = reactions.count() + missed;
    return all == 0 ? 0 : static_cast<double>(missed) / static_cast<double>(all);
  }
  /// Balls that were never reached count with the time that they lay free.
  [[nodiscard]] double time_to_ball_ms() const {
    return won == 0 ? to_milliseconds(measured) : to_milliseconds(free) / static_cast<double>(won);
  }
  [[nodiscard]] double per_second(std::uint64_t n) const {
    return measured.ns == 0 ? 0 : static_cast<double>(n) / to_seconds(measured);
  }
};

/// Counts while a game runs, from `begin` on. Robots that are off count for nothing.
///
/// * in conflict: two of the robots believe in different allocations (Def. 2). Compared when everything that happens at one
///   instant has happened.
/// * episode: from the beginning of a conflict to the beginning of the first agreement that then lasts 300 ms.
/// * attacker: a robot whose own part of what it believes is to attack.
/// * wrong: exactly one robot attacks, and another is nearer to the true ball by more than `clearly`.
/// * reaction: the ball is kicked, and then one robot is nearer to it than all others by more than `clearly`, and does not
///   attack; until it does. Missed, if the ball is reached by another or kicked again before.
/// * reign: a robot leads for 300 ms or longer. Right: when it began, no robot was clearly nearer to the true ball than the one
///   that it had attack.
/// * time to the ball: how long balls lie free, divided by how many of ours have reached.
class tally {
public:
  static constexpr duration calm = milliseconds(300);
  static constexpr micrometres clearly = metres(0.5);

  tally(std::size_t robots, instant begin) : begin_(begin), minds_(robots) {}

  /// Everything before t has happened. Call it before what happens at t.
  void pass_to(instant t) {
    if (t <= now_) return;
    if (stale_) settle();
    duration const d = (std::max)(t - (std::max)(now_, begin_), duration{});
    if (now_ < begin_ && begin_ <= t && conflict_) episode_ = begin_;
    if (conflict_) f_.in_conflict += d;
    if (attackers_ > 1) f_.several += d;
    if (attackers_ == 0) f_.nobody += d;
    if (wrong_) f_.wrong += d;
    now_ = t;
  }
  /// What robot i believes and does from now on; nothing while it is off.
  void note(std::size_t i, allocation_atoms<names> const* believed, bool attacks) {
    mind& m = minds_[i];
    bool const on = believed != nullptr;
    if (m.on == on && m.attacks == attacks && (!on || m.believed == *believed)) return;
    m.believed = on ? *believed : allocation_atoms<names>{};
    m.on = on;
    m.attacks = attacks;
    if (!on) m.reign.reset();
    stale_ = true;
    if (awaited_ && awaited_->robot == i && !on) awaited_.reset();
    if (awaited_ && awaited_->robot == i && attacks) react();
  }
  /// Whether robot i leads from now on, and whom it has attack.
  void note_reign(std::size_t i, bool leads, std::optional<std::size_t> attacker) {
    auto& r = minds_[i].reign;
    if (r.has_value() == leads) return;
    if (leads) {
      r = reign{now_, attacker && !clearly_wrong(*attacker)};
    } else {
      count(*std::exchange(r, std::nullopt));
    }
  }
  /// The world has moved; `kicked`: so has the ball. `won`: one of ours has got it.
  void look(world_state const& truth, bool kicked, bool won) {
    if (kicked || won) {
      if (awaited_ && now_ >= begin_) ++f_.missed;
      awaited_.reset();
    }
    distances_.clear();
    for (robot_state const& r : truth.robots) distances_.push_back(distance(r.position, truth.ball));
    stale_ = true;
    if (!kicked) return;
    for (std::size_t i = 0; i < minds_.size(); ++i)
      if (minds_[i].on && !minds_[i].attacks && clearly_nearest(i)) awaited_ = awaited{i, now_};
  }
  void count(std::size_t bytes) {
    if (now_ < begin_) return;
    ++f_.messages;
    f_.bytes += bytes;
  }

  /// Closes what is open and returns the figures. Call it once.
  [[nodiscard]] game_figures finish(instant end) {
    pass_to(end);
    if (episode_) f_.episodes.add((conflict_ ? end : agreed_) - *episode_);
    for (mind const& m : minds_)
      if (m.reign) count(*m.reign);
    f_.measured = end - begin_;
    return f_;
  }

private:
  struct reign {
    instant began{};
    bool right = false;
  };
  struct mind {
    allocation_atoms<names> believed;
    bool on = true;
    bool attacks = false;
    std::optional<closed::tally::reign> reign;
  };
  struct awaited {
    std::size_t robot = 0;
    instant since{};
  };

  [[nodiscard]] bool clearly_nearest(std::size_t i) const {
    for (std::size_t j = 0; j < minds_.size(); ++j)
      if (j != i && minds_[j].on && distances_[j] <= distances_[i] + clearly) return false;
    return true;
  }
  /// Whether another robot is clearly nearer.
  [[nodiscard]] bool clearly_wrong(std::size_t i) const {
    for (std::size_t j = 0; j < distances_.size(); ++j)
      if (minds_[j].on && distances_[j] + clearly < distances_[i]) return true;
    return false;
  }
  void count(reign const& r) {
    if (r.began < begin_ || now_ - r.began < calm) return;
    ++f_.reigns;
    f_.right += r.right ? 1 : 0;
  }
  void react() {
    if (awaited_->since >= begin_) {
      f_.reactions.add(now_ - awaited_->since);
      f_.reacted += now_ - awaited_->since;
    }
    awaited_.reset();
  }
  /// What holds from now_ on.
  void settle() {
    stale_ = false;
    attackers_ = 0;
    mind const* first = nullptr;
    bool conflict = false;
    std::size_t who = 0;
    for (std::size_t i = 0; i < minds_.size(); ++i) {
      mind const& m = minds_[i];
      if (!m.on) continue;
      if (first && first->believed != m.believed) conflict = true;
      first = &m;
      if (m.attacks) ++attackers_, who = i;
    }
    wrong_ = attackers_ == 1 && !distances_.empty() && clearly_wrong(who);
    if (conflict == conflict_) return;
    conflict_ = conflict;
    if (!conflict) {
      agreed_ = now_;
    } else if (now_ >= begin_) {
      if (episode_ && now_ - agreed_ >= calm) f_.episodes.add(agreed_ - *std::exchange(episode_, std::nullopt));
      if (!episode_) episode_ = now_;
    }
  }

  instant begin_;
  instant now_{};
  std::vector<mind> minds_;
  std::vector<micrometres> distances_;
  bool stale_ = true;
  bool conflict_ = false;
  bool wrong_ = false;
  std::size_t attackers_ = 0;
  std::optional<instant> episode_;
  instant agreed_{};
  std::optional<awaited> awaited_;
  game_figures f_;
};

}  // namespace rota::sim::closed
