#pragma once

#include <rota/sim/random.hpp>
#include <rota/sim/scenario.hpp>
#include <rota/sim/world.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rota::sim {

/// One of the scenarios, played by a script that reads only its own random stream. The seed decides everything.
class scripted_world {
public:
  /// @pre 2 ≤ robots ≤ max_robots
  scripted_world(scenario s, std::size_t robots, std::uint64_t seed, world_options const& options = {})
      : scenario_(s),
        options_(options),
        ticks_per_second_(seconds(1).ns / options.tick.ns),
        engine_(engine_for(seed, stream::world, 0)),
        bodies_(robots) {
    ROTA_ASSERT(robots >= 2 && robots <= max_robots);
    state_.robots.resize(robots);
    if (scenario_ == scenario::hour) {
      begin_play();
    } else {
      begin_round();
    }
  }

  /// Plays all ticks up to time t. O(robots) per tick.
  void advance(instant t) {
    while (now_ + options_.tick <= t) {
      now_ += options_.tick;
      scenario_ == scenario::hour ? tick_play() : tick_round();
      for (std::size_t i = 0; i < bodies_.size(); ++i) sway(i);
    }
  }
  [[nodiscard]] world_state const& state() const noexcept { return state_; }

private:
  /// How the script moves one robot: it wanders within `roam` of its anchor.
  struct body {
    point anchor;
    micrometres roam = 0;
    micrometres step = 0;
    point goal;
    instant next_choice{};
  };

  [[nodiscard]] std::size_t robots() const noexcept { return bodies_.size(); }
  [[nodiscard]] micrometres draw(extent e) { return uniform(engine_, e.low, e.high); }
  [[nodiscard]] micrometres per_tick(double speed) const { return metres(speed) / ticks_per_second_; }
  [[nodiscard]] point direction() {
    for (;;) {
      point const v{uniform(engine_, -metres(1), metres(1)), uniform(engine_, -metres(1), metres(1))};
      if (auto const n = length(v); n > 0 && n <= metres(1)) return rescaled(v, metres(1), n);
    }
  }
  [[nodiscard]] point around(point centre, extent e) {
    point const d = direction();
    return centre + rescaled(d, draw(e), metres(1));
  }
  /// A direction at least 120° from d: the cosine is at most -1/2.
  [[nodiscard]] point opposite(point d) {
    for (;;) {
      point const v = direction();
      if (v.x / 1000 * (d.x / 1000) + v.y / 1000 * (d.y / 1000) <= -500'000) return v;
    }
  }
  [[nodiscard]] point somewhere(micrometres half_x, micrometres half_y) {
    return {uniform(engine_, -half_x, half_x), uniform(engine_, -half_y, half_y)};
  }
  /// A robot that is neither a nor b.
  [[nodiscard]] std::size_t other_than(std::size_t a, std::size_t b) {
    auto const n = static_cast<std::int64_t>(robots());
    for (;;) {
      auto const c = static_cast<std::size_t>(uniform(engine_, 0, n - 1));
      if (c != a && (c != b || n == 2)) return c;
    }
  }

  void lead(std::size_t i, point anchor, micrometres roam, double speed) {
    body& b = bodies_[i];
    b.anchor = anchor;
    b.roam = roam;
    b.step = per_tick(speed);
  }
  void put(std::size_t i, point where) {
    state_.robots[i].position = bodies_[i].goal = where;
    lead(i, where, options_.sway, 0.5);
  }
  void sway(std::size_t i) {
    body& b = bodies_[i];
    if (now_ >= b.next_choice) {
      b.goal = around(b.anchor, {0, b.roam});
      b.next_choice = now_ + milliseconds(uniform(engine_, 300, 1500));
    }
    point& at = state_.robots[i].position;
    at = moved(at, b.goal, b.step);
  }

  // Rounds.

  void tick_round() {
    if (now_ - round_began_ >= options_.round) begin_round();
  }

  void begin_round() {
    round_began_ = now_;
    point const ball = state_.ball = somewhere(metres(5), metres(3));
    std::size_t const x = rounds_++ % robots();  // the one in trouble
    std::size_t const y = other_than(x, x);
    for (std::size_t i = 0; i < robots(); ++i) {
      state_.robots[i] = {};
      point const spot = formation_spot(i);
      put(i, distance(spot, ball) < options_.clearance ? towards(ball, spot, options_.clearance) : spot);
    }
    switch (scenario_) {
    case scenario::ball_fight: {
      // One draw per statement: the compiler chooses in which order a call evaluates its arguments.
      point const d = direction();
      put(x, ball + rescaled(d, draw(options_.fight), metres(1)));
      point const e = opposite(d);
      put(y, ball + rescaled(e, draw(options_.fight), metres(1)));
      break;
    }
    case scenario::phantom_two:
      put(y, around(ball, options_.near_ball));
      state_.robots[x].phantom = around(state_.robots[x].position, options_.phantom);
      break;
    case scenario::phantom_none:
      put(x, around(ball, options_.near_ball));
      state_.robots[x].phantom = around(state_.robots[y].position, options_.phantom);
      break;
    case scenario::mislocalised:
      put(x, around(ball, options_.near_ball));
      put(y, around(ball, options_.near_ball));
      state_.robots[x].pose_error = around({}, options_.pose_error);
      break;
    case scenario::hour: break;
    }
  }

  // Play.

  /// A fight, a phantom or a bad localisation, which comes and goes.
  struct incident {
    bool active = false;
    std::size_t robot = 0;
  };

  void begin_play() {
    for (std::size_t i = 0; i < robots(); ++i) {
      put(i, formation_spot(i));
      bodies_[i].roam = options_.roam;
    }
    chaser_ = nearest(robots());
    kick();
  }

  void tick_play() {
    double const hours = to_seconds(options_.tick) / 3600;
    change(fight_, options_.fights_per_hour * hours, options_.fight_length, [&] { begin_fight(); }, [] {});
    change(
        phantom_, options_.phantoms_per_hour * hours, options_.phantom_length, [&] { begin_phantom(); },
        [&] { state_.robots[phantom_.robot].phantom.reset(); });
    change(
        lost_, options_.mislocalisations_per_hour * hours, options_.mislocalisation_length,
        [&] { state_.robots[lost_.robot].pose_error = around({}, options_.pose_error); },
        [&] { state_.robots[lost_.robot].pose_error = {}; });
    move_ball(chance(engine_, options_.kicks_per_minute * 60 * hours));
    move_team();
  }

  /// One tick of an incident. Draws twice, and once more when the incident begins.
  template <class Begin, class End>
  void change(incident& what, double arrival, duration mean, Begin begin, End end) {
    bool const arrives = chance(engine_, arrival);
    bool const goes = chance(engine_, to_seconds(options_.tick) / to_seconds(mean));
    if (what.active && goes) {
      what.active = false;
      end();
    } else if (!what.active && arrives) {
      what.active = true;
      what.robot = static_cast<std::size_t>(uniform(engine_, 0, static_cast<std::int64_t>(robots()) - 1));
      begin();
    }
  }

  /// The nearest team mate runs to the other side of the ball, so that the ball is stuck between the two.
  void begin_fight() {
    fight_.robot = nearest(chaser_);
    fight_side_ = opposite(unit(state_.robots[chaser_].position - state_.ball));
    fight_gap_ = draw(options_.fight);
    chaser_gap_ = draw(options_.fight);
  }
  /// Half of the phantoms lie near the robot that sees them, half anywhere on the field or up to two metres beside it.
  void begin_phantom() {
    bool const nearby = chance(engine_, 0.5);
    robot_state& r = state_.robots[phantom_.robot];
    r.phantom = nearby ? around(r.position, options_.phantom)
                       : somewhere(field_length / 2 + metres(2), field_width / 2 + metres(2));
  }

  void kick() {
    ball_goal_ = somewhere(field_length / 2 - metres(0.5), field_width / 2 - metres(0.5));
    flying_ = true;
    ours_ = chance(engine_, 0.5);
  }
  void move_ball(bool kicked) {
    if (fight_.active) return;
    if (kicked) kick();
    if (state_.ball == ball_goal_) {
      flying_ = false;
      ball_goal_ = around(state_.ball, {metres(1), metres(3)});
      ball_goal_.x = std::clamp(ball_goal_.x, -field_length / 2, field_length / 2);
      ball_goal_.y = std::clamp(ball_goal_.y, -field_width / 2, field_width / 2);
    }
    state_.ball = moved(state_.ball, ball_goal_, per_tick(flying_ ? options_.kick_speed : options_.dribble_speed));
  }

  /// The robot that is truly nearest goes to the ball; the others keep the formation.
  void move_team() {
    if (!fight_.active && now_ >= next_chase_) {
      std::size_t const closest = nearest(robots());
      if (gap(closest) + metres(0.5) < gap(chaser_)) chaser_ = closest;
      next_chase_ = now_ + milliseconds(500);
    }
    for (std::size_t i = 0; i < robots(); ++i) {
      if (i == chaser_) {
        micrometres const keep = fight_.active ? chaser_gap_ : ours_ ? options_.keep_own : options_.keep_theirs;
        run(i, towards(state_.ball, state_.robots[i].position, keep));
      } else if (fight_.active && i == fight_.robot) {
        run(i, state_.ball + rescaled(fight_side_, fight_gap_, metres(1)));
      } else {
        auto const lean = static_cast<std::int64_t>(options_.formation_shift * 1000);
        point const spot = formation_spot(i);
        lead(i, spot + rescaled(state_.ball - spot, lean, 1000), options_.roam, options_.robot_speed);
      }
    }
  }
  void run(std::size_t i, point where) {
    lead(i, where, options_.sway, options_.robot_speed);
    bodies_[i].goal = where;
  }

  [[nodiscard]] micrometres gap(std::size_t i) const { return distance(state_.robots[i].position, state_.ball); }
  [[nodiscard]] std::size_t nearest(std::size_t except) const {
    std::size_t best = except == 0 ? 1 : 0;
    for (std::size_t i = 0; i < robots(); ++i)
      if (i != except && gap(i) < gap(best)) best = i;
    return best;
  }
  [[nodiscard]] static point unit(point v) {
    auto const n = length(v);
    return n == 0 ? point{metres(1), 0} : rescaled(v, metres(1), n);
  }

  scenario scenario_;
  world_options options_;
  std::int64_t ticks_per_second_;
  random_engine engine_;
  std::vector<body> bodies_;
  world_state state_;
  instant now_{};

  instant round_began_{};
  std::size_t rounds_ = 0;

  incident fight_, phantom_, lost_;
  point fight_side_;
  micrometres fight_gap_ = 0;
  micrometres chaser_gap_ = 0;
  std::size_t chaser_ = 0;
  instant next_chase_{};
  point ball_goal_;
  bool flying_ = false;
  bool ours_ = true;
};

static_assert(world<scripted_world> && world<duel_world>);

}  // namespace rota::sim
