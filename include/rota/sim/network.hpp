#pragma once

#include <rota/core/small_vector.hpp>
#include <rota/core/time.hpp>
#include <rota/sim/random.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rota::sim {

/// A wireless network. The defaults fit broadcast datagrams over 802.11 in a quiet hall.
struct network_options {
  duration latency = milliseconds(2);  ///< the least delay
  duration jitter =
      milliseconds(3);         ///< each delay is longer by up to this, uniformly; more than the message period reorders
  double loss = 0.02;          ///< probability that a message does not arrive
  double duplication = 0.002;  ///< probability that a message that arrives does so twice, with two delays
};

/// All directed links of a team. Each link has a random stream of its own, and every message draws equally often from it.
/// So a change of one probability changes nothing else.
class network {
public:
  using delays = small_vector<duration, 2>;

  network(network_options const& options, std::size_t robots, std::uint64_t seed) : options_(options), robots_(robots) {
    links_.reserve(robots * robots);
    for (std::size_t i = 0; i < robots * robots; ++i) links_.push_back(engine_for(seed, stream::network, i));
  }

  /// The delays after which the copies of one message arrive: none, one or two.
  [[nodiscard]] delays send(std::size_t from, std::size_t to) {
    random_engine& engine = links_[from * robots_ + to];
    bool const lost = chance(engine, options_.loss);
    bool const twice = chance(engine, options_.duplication);
    duration const first = delay(engine);
    duration const second = delay(engine);
    delays d;
    if (lost) return d;
    d.push_back(first);
    if (twice) d.push_back(second);
    return d;
  }

private:
  [[nodiscard]] duration delay(random_engine& engine) const {
    return options_.latency + nanoseconds(uniform(engine, 0, options_.jitter.ns));
  }

  network_options options_;
  std::size_t robots_;
  std::vector<random_engine> links_;
};

}  // namespace rota::sim
