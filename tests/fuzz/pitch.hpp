#pragma once

#include <rota/team/robot.hpp>
#include <rota/team/wire.hpp>

#include <array>
#include <cstdint>
#include <optional>

namespace fuzz {

/// A vocabulary so small that random names meet all the time.
struct pitch {
  enum class agent : std::uint8_t {};
  enum class plan_type : std::uint8_t { play, defence };
  enum class plan : std::uint8_t { normal, kickoff };
  enum class task : std::uint8_t { attack, defend, support };
  enum class state : std::uint8_t { none, busy };
};

/// What a robot sees: how well each agent attacks. Who sees only negative numbers knows no valid allocation.
struct view {
  std::array<std::int8_t, 8> attack{};
};

inline rota::plan_type<pitch, view> make_type(pitch::plan_type type) {
  using plan = rota::plan<pitch, view>;
  rota::additive_utility<pitch, view> const worth = [](pitch::agent a, pitch::task t, view const& v) {
    return std::optional<double>(t == pitch::task::attack ? v.attack[static_cast<std::size_t>(a) % 8] : 0.125);
  };
  auto const normal = plan::make(
      {.plan = pitch::plan::normal,
       .tasks = {{pitch::task::attack, {1, 1}, pitch::state::busy}, {pitch::task::defend, {0, 2}, pitch::state::none}},
       .utility = worth});
  auto const kickoff = plan::make(
      {.plan = pitch::plan::kickoff,
       .tasks = {{pitch::task::attack, {2, 2}, pitch::state::busy}, {pitch::task::support, {0, 1}, pitch::state::none}},
       .utility = worth});
  if (type == pitch::plan_type::defence) return *rota::plan_type<pitch, view>::make(type, {*normal});
  return *rota::plan_type<pitch, view>::make(type, {*normal, *kickoff});
}

}  // namespace fuzz
