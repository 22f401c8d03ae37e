#pragma once

#include <rota/sim/evaluation.hpp>
#include <rota/sim/stamps.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

namespace rota::sim {

/// What robots know in a study that no robot can know: how good a stamp could be.
enum class oracle : unsigned char {
  confused,  ///< whether it sees a phantom or has lost its place itself; then it leads last
  eyes,      ///< everything, but how far the ball is it only sees, with the bias and the noise of its eyes
  choice     ///< whether its choice is the one of the true world
};

inline constexpr std::array all_oracles{oracle::confused, oracle::eyes, oracle::choice};

[[nodiscard]] constexpr std::string_view to_string(oracle o) noexcept {
  constexpr std::string_view words[] = {"knows whether confused", "knows all but distance", "knows whether right"};
  return words[static_cast<std::size_t>(o)];
}

namespace detail {

/// The true world with every robot as far from the ball as it sees it; the robot itself as far as it sees it now.
[[nodiscard]] inline perceived world_by_eyes(knowledge const& k, world_state const& truth, sensor_options const& eyes) {
  perceived world;
  world.ball = truth.ball;
  for (std::size_t i = 0; i < truth.robots.size(); ++i) {
    point const off = truth.robots[i].position - truth.ball;
    micrometres const d = length(off);
    world.robots.push_back(i == k.self && !truth.robots[i].phantom ? truth.ball + (k.seen.robots[i] - k.seen.ball)
                           : d == 0                                ? truth.ball
                                    : truth.ball + rescaled(off, seen_distance(eyes, d), d));
  }
  return world;
}

}  // namespace detail

/// The confidence of a robot with such knowledge. @pre all take part
[[nodiscard]] inline std::uint32_t confidence_knowing(oracle what, knowledge const& k, world_state const& truth,
                                                      sensor_options const& eyes) {
  robot_state const& me = truth.robots[k.self];
  if (what == oracle::confused) return me.phantom || me.pose_error != point{} ? 0 : 1;
  auto const mine = best_allocation(problem<names, perceived>(k.book.type, k.members, k.seen), k.space);
  if (!mine) return 0;
  if (what == oracle::eyes)
    return detail::worth_in(k, detail::world_by_eyes(k, truth, eyes), k.members.agents(), *mine);
  auto const attackers = [&](allocation_atoms<names> const& atoms) {
    small_vector<names::agent, max_robots> who;
    for (in<names> const& x : atoms)
      if (k.book.attacks(x)) who.push_back(x.agent);
    return who;
  };
  auto const chosen = attackers(mine->atoms);
  perceived world;
  know(truth, world);
  auto const best = best_allocation(problem<names, perceived>(k.book.type, k.members, world), k.space);
  return best && chosen == attackers(best->atoms) ? 1 : 0;
}

/// Plays a scenario once with robots that know so much, or, without an oracle, with the stamps of the options.
[[nodiscard]] inline figures play_knowing(playbook const& book, play_options options, std::optional<oracle> what) {
  auto const truth = std::make_shared<world_state const*>(nullptr);  // of the game that is being played
  auto const eyes = options.team.sensor;
  if (what)
    options.team.stamp = [truth, what = *what, eyes](knowledge const& k) {
      return confidence_knowing(what, k, **truth, eyes);
    };
  return play(book, options, [](log_record const&) {}, [&](auto const& team) { *truth = &team.truth(); });
}

}  // namespace rota::sim
