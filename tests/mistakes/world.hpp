#pragma once

#include <rota/allocation/problem.hpp>

#include <cstdint>
#include <optional>

/// What every program here is about.
struct soccer {
  enum class agent : std::uint8_t { keeper = 1, left, right };
  enum class plan_type : std::uint8_t { play };
  enum class plan : std::uint8_t { normal };
  enum class task : std::uint8_t { attack, defend };
  enum class state : std::uint8_t { get_ball, protect };
};
struct view {
  double distance = 1;
};
/// Of `rota::domain<soccer, view>` only what the mistakes need, to compile in a third of the time.
struct game {
  using atoms = rota::allocation_atoms<soccer>;
  using plan = rota::plan<soccer, view>;
  using plan_type = rota::plan_type<soccer, view>;
  using team = rota::team<soccer>;
  using problem = rota::problem<soccer, view>;
};

inline std::optional<double> nearest(soccer::agent, soccer::task, view const& v) { return v.distance; }

inline game::plan_type right_play() {
  return *game::plan_type::make(soccer::plan_type::play,
                                {*game::plan::make({.plan = soccer::plan::normal,
                                                    .tasks = {{soccer::task::attack, {1, 1}, soccer::state::get_ball}},
                                                    .utility = nearest})});
}
