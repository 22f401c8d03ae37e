#pragma once

#include "dense/dense_world.hpp"

#include <rota/dense/outcome.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dense_world {

/// A problem as the solver wants it. Owns what the instance views.
struct owned_instance {
  explicit owned_instance(problem const& p) : part(p.part), agents(p.agents) {
    for (auto const& u : p.utility) utility.push_back(u.value_or(rota::dense::absent));
    for (auto const& [lower, upper] : p.bounds) bounds.push_back({lower, upper});
  }
  [[nodiscard]] rota::dense::instance view() const {
    rota::dense::instance in{agents, utility, bounds};
    in.taking_part = part;
    return in;
  }

  std::vector<std::int64_t> utility;
  std::vector<rota::dense::slot_bounds> bounds;
  std::vector<unsigned char> part;
  std::size_t agents;
};

inline std::vector<int> slots_of(rota::dense::outcome const& found) {
  std::vector<int> x;
  for (auto const s : found.assignment) x.push_back(s == rota::dense::no_slot ? -1 : static_cast<int>(s));
  return x;
}

}  // namespace dense_world
