#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace rota::sim {

/// Who should lead: arguments for the stamp of a claim. Each is a number that a robot computes from what it sees and what it was
/// told, so nobody who hears the claim needs to see the same.
enum class stamp_policy : unsigned char {
  id,                    ///< none: the greatest id leads, as in the paper
  mates,                 ///< how many mates see the ball within a metre of where the robot sees it
  closeness,             ///< how close the robot sees the ball
  closeness_if_agreed,   ///< … or nothing, if no mate sees the ball within a metre of there
  mates_then_closeness,  ///< how many mates; among equals, how close
  consensus              ///< what the robot's choice is worth in the world that all together tell of
};

inline constexpr std::array all_stamp_policies{stamp_policy::id,
                                               stamp_policy::mates,
                                               stamp_policy::closeness,
                                               stamp_policy::closeness_if_agreed,
                                               stamp_policy::mates_then_closeness,
                                               stamp_policy::consensus};
/// The one that is right most often, see docs/evaluation.md.
inline constexpr stamp_policy best_stamp_policy = stamp_policy::consensus;

[[nodiscard]] constexpr std::string_view to_string(stamp_policy p) noexcept {
  constexpr std::string_view words[] = {"id",       "mates", "closeness", "closeness-if-agreed", "mates-then-closeness",
                                        "consensus"};
  return words[static_cast<std::size_t>(p)];
}
[[nodiscard]] constexpr std::optional<stamp_policy> parse_stamp_policy(std::string_view name) noexcept {
  for (stamp_policy p : all_stamp_policies)
    if (to_string(p) == name) return p;
  return std::nullopt;
}

}  // namespace rota::sim
