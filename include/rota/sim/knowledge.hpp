#pragma once

#include <rota/core/time.hpp>
#include <rota/search/workspace.hpp>
#include <rota/sim/playbook.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace rota::sim {

/// What a robot says of the world beside each plan message, on the same way through the same radio.
struct testimony {
  instant heard{};         ///< on the clock of who heard it
  point self;              ///< where it believes that it is
  point ball;              ///< … and the ball
  bool blind = false;      ///< it sees nothing
  bool relocated = false;  ///< see `knowledge`
};

/// All that a robot has to go by: what it sees, and what the others have said. Never the truth.
struct knowledge {
  std::size_t self = 0;  ///< index; its id is one more
  instant now{};         ///< on its own clock
  perceived const& seen;
  /// It has begun to believe that it is elsewhere, `leap` or more away, from one look to the next, or has begun to look, within
  /// the last `doubt`: its localisation may have gone wrong. A robot that is carried elsewhere looks the same.
  bool relocated = false;
  std::span<std::optional<testimony> const> told;  ///< the last testimony of each robot; none of its own
  playbook const& book;
  team<names> const& members;
  workspace& space;  ///< to search in

  static constexpr micrometres leap = metres(1.5);
  static constexpr duration doubt = seconds(30);
};

/// What one robot keeps of what it saw and heard, so that there is a `knowledge` when it is asked for one. Times are of its own
/// clock.
class notebook {
public:
  notebook(std::size_t self, std::size_t robots) : self_(self), told_(robots) {}

  /// After each look of the robot.
  void look(perceived const& seen, instant now) {
    point const place = seen.robots[self_];
    if (!place_ || distance(*place_, place) >= knowledge::leap) leapt_ = now;
    place_ = place;
  }
  /// What another robot said beside a plan message that was accepted.
  void hear(std::size_t from, testimony const& t, instant now) {
    told_[from] = t;
    told_[from]->heard = now;
  }
  /// What the robot itself says beside its plan messages; nothing before it has looked.
  [[nodiscard]] std::optional<testimony> account(perceived const& seen, instant now) const {
    if (!place_) return std::nullopt;
    return testimony{{}, seen.robots[self_], seen.ball, seen.blind, relocated(now)};
  }
  /// All of it, and what the robot sees. The arguments and this must outlive it. @pre the robot has looked
  [[nodiscard]] knowledge know(perceived const& seen, instant now, playbook const& book, team<names> const& members,
                               workspace& space) const {
    return {self_, now, seen, relocated(now), told_, book, members, space};
  }

private:
  [[nodiscard]] bool relocated(instant now) const { return leapt_ != long_ago && now - leapt_ <= knowledge::doubt; }

  std::size_t self_;
  std::vector<std::optional<testimony>> told_;
  std::optional<point> place_;
  instant leapt_ = long_ago;  // when it last began to believe that it is elsewhere
};

/// How good the robot's reasons are to lead, asked before each deliberation. It must depend on the knowledge alone, or equal seeds
/// give different runs. Any number will do: stamps are ordered whatever the numbers mean.
using stamp_function = std::function<std::uint32_t(knowledge const&)>;

}  // namespace rota::sim
