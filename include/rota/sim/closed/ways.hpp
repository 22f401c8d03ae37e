#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace rota::sim::closed {

/// Ways of deciding who does what.
enum class way : unsigned char {
  rota,      ///< act, notice conflicts, and follow a leader for as long as need be
  silent,    ///< act, and believe what the others say of themselves: no resolution
  alica,     ///< act, Def. 5 to the letter, and the greatest id leads for two seconds: as the paper has it
  central,   ///< one decides for all, by what it sees
  majority,  ///< one decides for all, by what most see
  steam,     ///< all confirm a change before anybody acts on it
  consa,     ///< who would do otherwise argues, and all act on the strongest grounds
  cbba       ///< all bid for tasks, and agree on who bids most
};

inline constexpr std::array all_ways{way::rota,     way::silent, way::alica, way::central,
                                     way::majority, way::steam,  way::consa, way::cbba};

[[nodiscard]] constexpr std::string_view to_string(way w) noexcept {
  constexpr std::string_view words[] = {"rota", "silent", "alica", "central", "majority", "steam", "consa", "cbba"};
  return words[static_cast<std::size_t>(w)];
}
[[nodiscard]] constexpr std::optional<way> parse_way(std::string_view name) noexcept {
  for (way w : all_ways)
    if (to_string(w) == name) return w;
  return std::nullopt;
}

}  // namespace rota::sim::closed
