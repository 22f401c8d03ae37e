#pragma once

#include <rota/core/time.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rota::sim {

/// A time of the simulation: from `from` on, and before `until`.
struct spell {
  instant from{};
  instant until = never;

  [[nodiscard]] constexpr bool covers(instant t) const noexcept { return from <= t && t < until; }
};

/// Losses in bursts (Gilbert–Elliott). Each directed link is good or bad. At each message a good link turns bad with
/// probability `begins`, and a bad one good with probability `ends`; a bad link loses the message with probability `loss`.
/// With `begins` 1 and `ends` 0 losses are independent.
struct burst_loss {
  spell when;
  double begins = 0.02;
  double ends = 0.2;
  double loss = 1;
};

/// Further copies: with this probability a message that is not cut off arrives once more, even if its first copy was lost,
/// so much after it was sent.
struct late_copies {
  spell when;
  double probability = 0.02;
  duration least = seconds(1);
  duration most = seconds(5);
};

/// With this probability one bit of one number of a message arrives flipped, as if there were no checksum. With the wire
/// form such a message is refused before a robot hears it; this is for the robot's own checks.
struct flipped_bits {
  spell when;
  double probability = 0.01;
};

/// For a time nothing that is said on one side is heard on the other. Both sides remain teams. What was under way arrives.
struct partition {
  spell when;
  std::uint32_t side = 0;  ///< bit i is set if the robot with index i is on one side, and not set if it is on the other
};

/// For a time nothing that `from` says is heard by `to`. The other direction stays as it is.
struct broken_link {
  spell when;
  std::size_t from = 0;
  std::size_t to = 0;
};

/// The incarnation that a robot obtains for its next life, compared with that of its last one.
enum class rebirth : unsigned char { greater, equal, smaller };

/// A robot stops, loses all that it knows, and starts again later, unless `down` is `for_good`. What it has said arrives.
struct crash {
  static constexpr duration for_good = seconds(1'000'000);

  std::size_t robot = 0;
  instant at{};
  duration down = seconds(1);
  rebirth as = rebirth::greater;
};

/// A robot's clock is faster by so many millionths than it would have been; slower if negative. @pre up to 100,000 either way
struct clock_drift {
  std::size_t robot = 0;
  std::int64_t ppm = 10'000;
};

/// For a time a robot goes on seeing what it saw last.
struct stuck_sensor {
  std::size_t robot = 0;
  spell when;
};

/// For a time a robot sees nothing, so no allocation is valid for it.
struct blindness {
  std::size_t robot = 0;
  spell when;
};

/// For a time a robot does not execute the plan type. It keeps speaking and listening.
struct absence {
  std::size_t robot = 0;
  spell when;
};

/// A robot's claims have another confidence from now on.
struct confidence_change {
  std::size_t robot = 0;
  instant at{};
  std::uint32_t confidence = 0;
};

/// Everything that goes wrong in a run; nothing by default. A robot that is down already does not crash, and one that runs
/// already does not start.
struct faults {
  std::optional<burst_loss> bursts;
  std::optional<late_copies> late;
  std::optional<flipped_bits> flips;
  std::vector<partition> partitions;
  std::vector<broken_link> broken;
  std::vector<crash> crashes;
  std::vector<clock_drift> drifts;
  std::vector<stuck_sensor> stuck;
  std::vector<blindness> blind;
  std::vector<absence> absences;
  std::vector<confidence_change> confidences;

  /// The instant from which on nothing goes wrong any more: everybody is up, sees and executes the type who ever will, every
  /// link is whole, and no late copy is under way. Clocks stay as they are.
  [[nodiscard]] instant healed() const {
    instant last{};
    auto const at = [&last](instant t) { last = (std::max)(last, t); };
    if (bursts) at(bursts->when.until);
    if (late) at(late->when.until == never ? never : late->when.until + late->most);
    if (flips) at(flips->when.until);
    for (auto const& x : partitions) at(x.when.until);
    for (auto const& x : broken) at(x.when.until);
    for (auto const& x : crashes) at(x.down == crash::for_good ? x.at : x.at + x.down);
    for (auto const& x : stuck) at(x.when.until);
    for (auto const& x : blind) at(x.when.until);
    for (auto const& x : absences) at(x.when.until);
    for (auto const& x : confidences) at(x.at);
    return last;
  }
  /// Whether each life of this robot has a greater incarnation than the one before.
  [[nodiscard]] bool orderly(std::size_t robot) const {
    return std::none_of(crashes.begin(), crashes.end(),
                        [=](crash const& c) { return c.robot == robot && c.as != rebirth::greater; });
  }
};

}  // namespace rota::sim
