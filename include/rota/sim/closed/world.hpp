#pragma once

#include <rota/sim/random.hpp>
#include <rota/sim/scenario.hpp>
#include <rota/sim/world.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

/// A world that decisions move: who goes for the ball gets there.
namespace rota::sim::closed {

/// What goes wrong with the robots.
enum class trouble : unsigned char {
  none,  ///< nothing but noise and the bias of their eyes
  delusion,  ///< at all times one robot, in turn, sees a ball near itself, sees one near a mate, or is wrong about its place
  mixed,      ///< phantoms and bad localisations come and go as often as in the scenario `hour`
  breakdowns  ///< every 20 s a robot, in turn and the greatest id first, is off for 5 s
};

inline constexpr std::array all_troubles{trouble::none, trouble::delusion, trouble::mixed, trouble::breakdowns};

[[nodiscard]] constexpr std::string_view to_string(trouble t) noexcept {
  constexpr std::string_view words[] = {"none", "delusion", "mixed", "breakdowns"};
  return words[static_cast<std::size_t>(t)];
}
[[nodiscard]] constexpr std::optional<trouble> parse_trouble(std::string_view name) noexcept {
  for (trouble t : all_troubles)
    if (to_string(t) == name) return t;
  return std::nullopt;
}

/// Every number of the world that `scenario.hpp` does not have; none is fitted to a figure.
struct world_numbers {
  world_options common;                       ///< speeds, phantoms, errors of pose, how often they arise, and the tick
  micrometres reach = metres(0.3);            ///< an attacker this near to the ball has it …
  duration least_hold = seconds(1);           ///< … and keeps it so long at least
  duration most_hold = seconds(3);            ///< … and at most, and then kicks it
  micrometres crowd = metres(1.0);            ///< two attackers this near to the ball hinder each other:
  micrometres standoff = metres(0.5);         ///< neither comes nearer than this, and nobody has the ball
  double taken_per_minute = 6;                ///< so often opponents kick the ball
  duration between_breakdowns = seconds(20);  ///< `trouble::breakdowns`
  duration breakdown = seconds(5);
  duration sane = seconds(30);  ///< so long after the beginning nobody is deluded: `trouble::delusion`
};

/// Field, ball and robots. A kick takes no time: the ball is next seen where it lies still. Then whoever goes for the ball
/// drives to where it believes the ball to be; the first to reach the true one has it, and kicks it elsewhere.
///
/// The seed decides where the ball lies and what goes wrong. O(robots²) per tick.
class closed_world {
public:
  /// @pre 2 ≤ robots ≤ max_robots
  closed_world(trouble what, std::size_t robots, std::uint64_t seed, world_numbers const& numbers = {})
      : trouble_(what),
        numbers_(numbers),
        ball_engine_(engine_for(seed, stream::world, 1)),
        chance_engine_(engine_for(seed, stream::world, 2)),
        goals_(robots) {
    ROTA_ASSERT(robots >= 2 && robots <= max_robots);
    for (std::size_t i = 0; i < robots; ++i) state_.robots.push_back({formation_spot(i), {}, {}});
    for (std::size_t i = 0; i < robots; ++i) goals_[i].where = formation_spot(i);
    next_round_ = instant{} + numbers.sane;
    kick();
  }

  /// What robot i does from now on: it drives there, and may go for the ball.
  void send(std::size_t i, point where, bool attacks) { goals_[i] = {clamped(where), attacks}; }
  /// Robot i stands still from now on.
  void stop(std::size_t i) { goals_[i] = {state_.robots[i].position, false}; }

  /// Plays all ticks up to time t.
  void advance(instant t) {
    while (now_ + numbers_.common.tick <= t) {
      now_ += numbers_.common.tick;
      trouble_robots();
      for (std::size_t i = 0; i < goals_.size(); ++i) drive(i);
      play_ball();
    }
  }

  [[nodiscard]] world_state const& state() const noexcept { return state_; }
  [[nodiscard]] instant now() const noexcept { return now_; }
  /// How often the ball was kicked; it lies still meanwhile.
  [[nodiscard]] std::uint64_t kicks() const noexcept { return kicks_; }
  /// How often a robot of ours has got the ball, and how long it lay free before or in vain.
  [[nodiscard]] std::uint64_t won() const noexcept { return won_; }
  [[nodiscard]] duration free() const noexcept { return free_; }

private:
  struct goal {
    point where;
    bool attacks = false;
  };
  struct incident {
    bool active = false;
    std::size_t robot = 0;
  };

  static point clamped(point p) {
    p.x = std::clamp(p.x, -field_length / 2 - metres(2), field_length / 2 + metres(2));
    p.y = std::clamp(p.y, -field_width / 2 - metres(2), field_width / 2 + metres(2));
    return p;
  }
  [[nodiscard]] micrometres gap(std::size_t i) const { return distance(state_.robots[i].position, state_.ball); }
  /// Whether another attacker is in the way of robot i, which is at the ball.
  [[nodiscard]] bool hindered(std::size_t i) const {
    for (std::size_t j = 0; j < goals_.size(); ++j)
      if (j != i && goals_[j].attacks && gap(j) < numbers_.crowd) return true;
    return false;
  }

  void drive(std::size_t i) {
    robot_state& r = state_.robots[i];
    micrometres const step = metres(numbers_.common.robot_speed) / (seconds(1).ns / numbers_.common.tick.ns);
    point const next = moved(r.position, goals_[i].where, step);
    bool const closer = distance(next, state_.ball) < gap(i);
    if (goals_[i].attacks && closer && distance(next, state_.ball) < numbers_.standoff && hindered(i)) return;
    r.position = next;
  }

  void play_ball() {
    bool const taken = chance(chance_engine_, numbers_.taken_per_minute / 60 * to_seconds(numbers_.common.tick));
    std::optional<std::size_t> who;
    for (std::size_t i = 0; i < goals_.size() && !who; ++i)
      if (goals_[i].attacks && gap(i) <= numbers_.reach && !hindered(i)) who = i;
    if (!holder_) free_ += numbers_.common.tick;
    if (who && holder_ != who) {
      ++won_;
      hold_until_ = now_ + nanoseconds(uniform(ball_engine_, numbers_.least_hold.ns, numbers_.most_hold.ns));
    }
    holder_ = who;
    if (taken || (holder_ && now_ >= hold_until_)) kick();
  }
  void kick() {
    ++kicks_;
    holder_.reset();
    state_.ball.x = uniform(ball_engine_, -metres(8), metres(8));
    state_.ball.y = uniform(ball_engine_, -metres(5), metres(5));
  }

  // What goes wrong.

  [[nodiscard]] point around(point centre, extent e) {
    for (;;) {
      point const v{uniform(chance_engine_, -metres(1), metres(1)), uniform(chance_engine_, -metres(1), metres(1))};
      auto const n = length(v);
      if (n > 0 && n <= metres(1)) return centre + rescaled(v, uniform(chance_engine_, e.low, e.high), n);
    }
  }
  void trouble_robots() {
    if (trouble_ == trouble::delusion && now_ >= next_round_) begin_round();
    if (trouble_ != trouble::mixed) return;
    double const hours = to_seconds(numbers_.common.tick) / 3600;
    change(
        phantom_, numbers_.common.phantoms_per_hour * hours, numbers_.common.phantom_length,
        [&](robot_state& r) { see_phantom(r, chance(chance_engine_, 0.5)); },
        [](robot_state& r) { r.phantom.reset(); });
    change(
        lost_, numbers_.common.mislocalisations_per_hour * hours, numbers_.common.mislocalisation_length,
        [&](robot_state& r) { r.pose_error = around({}, numbers_.common.pose_error); },
        [](robot_state& r) { r.pose_error = {}; });
  }
  /// In each round the next robot is deluded; after all of them, in the next way.
  void begin_round() {
    next_round_ = now_ + numbers_.common.round;
    for (robot_state& r : state_.robots) r = {r.position, {}, {}};
    std::size_t const robots = state_.robots.size();
    std::size_t const x = rounds_ % robots;
    robot_state& r = state_.robots[x];
    switch ((x + rounds_ / robots) % 3) {
    case 0: see_phantom(r, true); break;
    case 1: r.phantom = around(state_.robots[(x + 1) % robots].position, numbers_.common.phantom); break;
    default: r.pose_error = around({}, numbers_.common.pose_error); break;
    }
    ++rounds_;
  }
  void see_phantom(robot_state& r, bool nearby) {
    point p = around(r.position, numbers_.common.phantom);
    if (!nearby) p = {uniform(chance_engine_, -metres(8), metres(8)), uniform(chance_engine_, -metres(5), metres(5))};
    r.phantom = p;
  }
  template <class Begin, class End>
  void change(incident& what, double arrival, duration mean, Begin begin, End end) {
    bool const arrives = chance(chance_engine_, arrival);
    bool const goes = chance(chance_engine_, to_seconds(numbers_.common.tick) / to_seconds(mean));
    if (what.active && goes) {
      what.active = false;
      end(state_.robots[what.robot]);
    } else if (!what.active && arrives) {
      auto const last = static_cast<std::int64_t>(goals_.size()) - 1;
      what = {true, static_cast<std::size_t>(uniform(chance_engine_, 0, last))};
      begin(state_.robots[what.robot]);
    }
  }

  trouble trouble_;
  world_numbers numbers_;
  random_engine ball_engine_;
  random_engine chance_engine_;
  world_state state_;
  std::vector<goal> goals_;
  instant now_{};
  std::optional<std::size_t> holder_;
  instant hold_until_{};
  std::uint64_t kicks_ = 0;
  std::uint64_t won_ = 0;
  duration free_{};
  incident phantom_, lost_;
  instant next_round_{};
  std::size_t rounds_ = 0;
};

}  // namespace rota::sim::closed
