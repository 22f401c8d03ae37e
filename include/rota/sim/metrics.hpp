#pragma once

#include <rota/core/lifetime.hpp>
#include <rota/sim/pursuit.hpp>
#include <rota/sim/simulation.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace rota::sim {

/// The figures of one run. `metrics` defines each of them.
struct figures {
  duration measured{};
  duration in_conflict{};
  length_statistics episodes;
  std::uint64_t cycles = 0;
  std::uint64_t detections = 0;
  std::uint64_t reigns = 0;
  std::uint64_t renewals = 0;      ///< of reigns
  std::uint64_t right = 0;         ///< reigns and renewals
  std::vector<std::uint64_t> led;  ///< reigns and renewals per robot
  std::uint64_t deliberations = 0;
  std::uint64_t messages = 0;  ///< broadcasts
  std::uint64_t perception_digest = 0;
  pursuit_figures pursuit;

  [[nodiscard]] double conflict_share() const { return share(in_conflict); }
  [[nodiscard]] double not_one_share() const { return share(pursuit.not_one); }
  [[nodiscard]] double wrong_share() const { return share(pursuit.wrong); }
  /// How often it was settled who leads.
  [[nodiscard]] std::uint64_t terms() const { return reigns + renewals; }
  [[nodiscard]] double right_share() const {
    return terms() == 0 ? 0 : static_cast<double>(right) / static_cast<double>(terms());
  }
  /// No episode was longer than 4 s.
  [[nodiscard]] bool resolved() const { return episodes.longest_ms() <= 4000; }

private:
  [[nodiscard]] double share(duration part) const {
    return measured.ns == 0 ? 0 : static_cast<double>(part.ns) / static_cast<double>(measured.ns);
  }
};

/// Counts while a simulation runs, from `begin` on.
///
/// * in conflict: two of the robots that execute the plan type believe in different allocations (Def. 2, either direction),
///   measured to the nanosecond. Beliefs are compared when everything that happens at one instant has happened.
/// * episode: from the beginning of a conflict to the beginning of the first agreement that then lasts `calm`. `begin` and
///   the end of the run cut episodes off; the agreement at the end of the run may be shorter than `calm`.
/// * reign: a robot begins to lead within the measured time, and `calm` later it has not turned to a greater claim and the
///   run has not ended. So of several claims made at once only the greatest counts.
/// * renewal: a leader claims anew, and `calm` later, or when it ends its reign itself, it has not turned to a greater claim.
///   Each renewal asks again who should lead.
/// * right: the leader imposes the attackers of the best allocation under the true world. This is judged at its first
///   deliberation as a leader, and at each renewal; the deliberation that began the reign counts as one.
/// * who pursues the ball: see `pursuit_watch`.
template <class Simulation>
class metrics {
public:
  static constexpr duration calm = milliseconds(300);

  /// `simulation` must outlive the metrics.
  metrics(Simulation const& simulation ROTA_LIFETIMEBOUND, instant begin)
      : simulation_(simulation),
        begin_(begin),
        beliefs_(simulation.size()),
        absent_(simulation.size()),
        reigns_(simulation.size()),
        pursuit_(simulation.book(), simulation.members(), begin) {
    figures_.led.resize(simulation.size());
  }

  metrics(Simulation const&&, instant) = delete;

  void operator()(log_record const& r) {
    pass_to(r.time);
    pursuit_(r);
    bool const comes = r.what == happening::entered;
    bool const goes = r.what == happening::left || r.what == happening::crashed;
    if (comes || goes) absent_[r.robot] = goes;
    if (!r.change.empty() || comes || goes) {
      beliefs_[r.robot] = r.believed;
      stale_ = true;
    }
    if (r.time < begin_) return;
    figures_.cycles += r.cycles;
    reign& mine = reigns_[r.robot];
    switch (r.what) {
    case happening::deliberated:
      ++figures_.deliberations;
      figures_.detections += r.detected ? 1 : 0;
      if (r.leading && mine.began && !mine.right) mine.right = imposes_right(r);
      break;
    case happening::said_plan:
    case happening::said_claim: ++figures_.messages; break;
    case happening::reign_began:
      mine = {r.time, std::nullopt, false};
      if (r.detected) mine.right = imposes_right(r);
      break;
    case happening::reign_ended:
      if (mine.began && !(r.superseded && r.time - *mine.began < calm)) count(r.robot);
      mine = {};
      break;
    case happening::reign_renewed:
      if (mine.began) count(r.robot);
      mine = {r.time, imposes_right(r), true};
      break;
    case happening::entered:
    case happening::left:
    case happening::crashed:
    case happening::restarted:
    case happening::heard_plan:
    case happening::heard_claim: break;
    }
  }

  /// Closes what is open and returns the figures. Call it once, after the last `run`.
  [[nodiscard]] figures finish(instant end) {
    pass_to(end);
    if (episode_) figures_.episodes.add((conflict_ ? end : agreed_) - *episode_);
    for (std::size_t i = 0; i < reigns_.size(); ++i)
      if (reigns_[i].began && end - *reigns_[i].began >= calm) count(i);
    figures_.measured = end - begin_;
    figures_.perception_digest = simulation_.perception_digest();
    figures_.pursuit = pursuit_.finish(end);
    return figures_;
  }

private:
  struct reign {
    std::optional<instant> began;
    std::optional<bool> right;
    bool renewed = false;
  };

  /// Accounts for the time up to t, when everything before t has happened.
  void pass_to(instant t) {
    if (t <= now_) return;
    if (stale_) {
      stale_ = false;
      bool const conflict = disagreement();
      if (conflict != conflict_) turn(conflict, now_);
    }
    if (now_ < begin_ && begin_ <= t && conflict_) episode_ = begin_;
    if (conflict_) figures_.in_conflict += (std::max)(t - (std::max)(now_, begin_), duration{});
    now_ = t;
  }

  /// Whether two of those that execute the plan type believe in different allocations.
  [[nodiscard]] bool disagreement() const {
    allocation_atoms<names> const* first = nullptr;
    for (std::size_t i = 0; i < beliefs_.size(); ++i) {
      if (absent_[i]) continue;
      if (first && *first != beliefs_[i]) return true;
      first = &beliefs_[i];
    }
    return false;
  }
  void turn(bool conflict, instant t) {
    conflict_ = conflict;
    if (!conflict) {
      agreed_ = t;
    } else if (t >= begin_) {
      if (episode_ && t - agreed_ >= calm) figures_.episodes.add(agreed_ - *std::exchange(episode_, std::nullopt));
      if (!episode_) episode_ = t;
    }
  }

  void count(std::size_t robot) {
    reign const& mine = reigns_[robot];
    if (!mine.right) return;
    ++(mine.renewed ? figures_.renewals : figures_.reigns);
    ++figures_.led[robot];
    figures_.right += *mine.right ? 1 : 0;
  }

  [[nodiscard]] bool imposes_right(log_record const& r) const {
    return pursuit_.attackers(r.believed) == pursuit_.wanted();
  }

  Simulation const& simulation_;
  instant begin_;
  instant now_{};
  std::vector<allocation_atoms<names>> beliefs_;
  std::vector<bool> absent_;
  bool stale_ = false;
  bool conflict_ = false;
  std::optional<instant> episode_;
  instant agreed_{};
  std::vector<reign> reigns_;
  figures figures_;
  pursuit_watch pursuit_;
};

}  // namespace rota::sim
