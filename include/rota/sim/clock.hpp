#pragma once

#include <rota/core/time.hpp>
#include <rota/sim/random.hpp>

#include <cstdint>

namespace rota::sim {

/// How the clocks and loops of robots differ from each other.
struct clock_options {
  duration loop = milliseconds(30);  ///< mean length of the deliberation loop
  /// Each robot's loop is longer or shorter by up to this, so that no two loops stay in phase.
  std::int64_t loop_spread_ppm = 5000;
  std::int64_t drift_ppm = 50;  ///< each robot's clock is fast or slow by up to this
};

/// One robot's own clock, with an unknown origin and a slightly wrong speed, and the phases of the robot's loops.
///
/// The clocks of two robots are never compared. A clock never runs backwards; `global(local(t)) ≤ t` and
/// `local(global(l)) ≥ l`. @pre drift up to 100,000 ppm either way, times below a day
class robot_clock {
public:
  robot_clock() = default;
  robot_clock(clock_options const& options, duration message_period, random_engine& engine)
      : origin_(milliseconds(uniform(engine, 1'000, 100'000))),
        drift_ppm_(uniform(engine, -options.drift_ppm, options.drift_ppm)) {
    auto const spread = uniform(engine, -options.loop_spread_ppm, options.loop_spread_ppm);
    loop_ = {options.loop.ns + options.loop.ns / 1000 * spread / 1000};
    first_loop_ = instant{} + origin_ + nanoseconds(uniform(engine, 0, options.loop.ns - 1));
    first_message_ = instant{} + origin_ + nanoseconds(uniform(engine, 0, message_period.ns - 1));
  }

  /// The time that the clock shows at simulated time t ≥ 0.
  [[nodiscard]] instant local(instant t) const noexcept { return {t.ns + origin_.ns + drift_of(t.ns)}; }
  /// The first simulated time at which the clock shows l or more.
  [[nodiscard]] instant global(instant l) const noexcept {
    std::int64_t const elapsed = l.ns - origin_.ns;
    std::int64_t const speed = 1'000'000 + drift_ppm_;  // of this clock, where a right one has a million
    std::int64_t t = elapsed / speed * 1'000'000 + elapsed % speed * 1'000'000 / speed;
    while (local({t}) < l) ++t;
    while (t > 0 && local({t - 1}) >= l) --t;
    return {t};
  }

  /// Makes the clock faster by so many millionths of its speed at the beginning.
  void drift_by(std::int64_t ppm) noexcept { drift_ppm_ += ppm; }

  /// The length of the loop, its first run, and the first slot of the message grid, all on the robot's own clock.
  [[nodiscard]] duration loop() const noexcept { return loop_; }
  [[nodiscard]] instant first_loop() const noexcept { return first_loop_; }
  [[nodiscard]] instant first_message() const noexcept { return first_message_; }

private:
  [[nodiscard]] std::int64_t drift_of(std::int64_t ns) const noexcept { return ns * drift_ppm_ / 1'000'000; }

  duration origin_{};
  std::int64_t drift_ppm_ = 0;
  duration loop_ = milliseconds(30);
  instant first_loop_{};
  instant first_message_{};
};

}  // namespace rota::sim
