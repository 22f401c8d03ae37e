#pragma once

#include <rota/allocation/utility.hpp>
#include <rota/core/small_vector.hpp>
#include <rota/search/best_allocation.hpp>
#include <rota/sim/knowledge.hpp>
#include <rota/sim/stamp_policy.hpp>
#include <rota/sim/world.hpp>
#include <rota/team/confidence.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace rota::sim {

namespace detail {

/// What one robot says, or the robot itself sees.
struct witness {
  std::size_t robot = 0;
  point self;
  point ball;
  bool relocated = false;
  micrometres away = 0;  // from its ball

  /// How wrong it may be about the ball: distances are seen up to a fifth wrong, or so.
  [[nodiscard]] micrometres tolerance() const noexcept { return metres(0.15) + away / 5; }
};

/// Everybody who has said something lately and sees, and the robot itself.
class witnesses {
public:
  static constexpr duration fresh = seconds(2);

  explicit witnesses(knowledge const& k) {
    for (std::size_t i = 0; i < k.told.size(); ++i) {
      if (i == k.self) {
        if (!k.seen.blind) add({i, k.seen.robots[i], k.seen.ball, k.relocated});
      } else if (auto const& t = k.told[i]; t && !t->blind && k.now - t->heard <= fresh) {
        add({i, t->self, t->ball, t->relocated});
      }
    }
  }
  [[nodiscard]] auto begin() const noexcept { return list_.begin(); }
  [[nodiscard]] auto end() const noexcept { return list_.end(); }
  [[nodiscard]] bool empty() const noexcept { return list_.empty(); }

  /// Where the ball is by all of them: the ball that fits what the others say best, averaged over those who agree with it; who
  /// is near counts more. @pre not empty
  [[nodiscard]] point ball() const {
    witness const* best = nullptr;
    std::int64_t most = -1;
    for (witness const& w : list_)
      if (auto const votes = votes_for(w); votes > most) {
        most = votes;
        best = &w;
      }
    std::int64_t x = 0, y = 0, total = 0;
    for (witness const& w : list_) {
      if (distance(w.ball, best->ball) > best->tolerance() + w.tolerance()) continue;
      auto const centimetres = w.away / 10'000;
      std::int64_t const weight = 100'000'000 / (500 + centimetres * centimetres);
      x += w.ball.x * weight;
      y += w.ball.y * weight;
      total += weight;
    }
    return {x / total, y / total};
  }

private:
  void add(witness w) {
    w.away = distance(w.self, w.ball);
    list_.push_back(w);
  }
  /// In thousandths: one for each that sees the same, less the farther they are apart.
  [[nodiscard]] std::int64_t votes_for(witness const& c) const {
    std::int64_t votes = 0;
    for (witness const& w : list_)
      if (w.robot != c.robot)
        votes += (std::max<std::int64_t>)(1000 - 1000 * distance(c.ball, w.ball) / (c.tolerance() + w.tolerance()), 0);
    return votes;
  }

  small_vector<witness, max_robots> list_;
};

/// The world that all together tell of. A robot stands as far from the ball as it sees it if its ball is the one of the others,
/// and also if it sees another one nearer to itself, but may have lost its place: then it is the place that is wrong. Who has kept
/// its place and sees another ball than the others sees a phantom.
[[nodiscard]] inline perceived shared_world(knowledge const& k, witnesses const& all) {
  perceived world;
  world.robots = k.seen.robots;
  world.ball = all.ball();
  for (witness const& w : all) {
    point const off = w.ball - world.ball;
    bool const agrees = length(off) <= 2 * w.tolerance();
    bool const lost = w.relocated && w.away < distance(w.self, world.ball);
    world.robots[w.robot] = agrees || lost ? w.self - off : w.self;
  }
  return world;
}

[[nodiscard]] inline std::uint32_t mates_agreeing(knowledge const& k) {
  std::uint32_t count = 0;
  for (witness const& w : witnesses(k))
    if (w.robot != k.self && distance(w.ball, k.seen.ball) <= metres(1)) ++count;
  return count;
}
/// Above every utility in metres: they add up over at most eleven robots, each below the diagonal of the field.
inline constexpr double most_metres = 256;

[[nodiscard]] inline std::uint32_t closeness(knowledge const& k, std::uint32_t greatest = UINT32_MAX) {
  if (k.seen.blind) return 0;
  return confidence_of(pay(distance(k.seen.robots[k.self], k.seen.ball), 1), 0, most_metres, greatest);
}

/// What a robot's choice is worth in this world. A robot that would send another to the ball knows less than that one, so that
/// costs it 20 cm.
[[nodiscard]] inline std::uint32_t worth_in(knowledge const& k, perceived const& world,
                                            std::span<names::agent const> present, solution<names> const& choice) {
  auto const worth = evaluate(problem<names, perceived>(k.book.type, k.members, world, present),
                              *k.book.type.find(choice.plan), choice.atoms);
  if (!worth) return 0;
  bool const myself = std::any_of(choice.atoms.begin(), choice.atoms.end(),
                                  [&](in<names> const& x) { return x.agent.value == k.self + 1 && k.book.attacks(x); });
  return confidence_of(to_double(*worth) - (myself ? 0 : 0.2), 0, most_metres);
}

/// What the robot's choice is worth in the shared world.
[[nodiscard]] inline std::uint32_t shared_worth(knowledge const& k) {
  witnesses const all(k);
  if (k.seen.blind) return 0;
  small_vector<names::agent, max_robots> present;
  for (witness const& w : all) present.push_back(k.members.agents()[w.robot]);
  std::span<names::agent const> const who(present.begin(), present.size());
  auto const mine = best_allocation(problem<names, perceived>(k.book.type, k.members, k.seen, who), k.space);
  if (!mine) return 0;
  return worth_in(k, shared_world(k, all), who, *mine);
}

}  // namespace detail

/// The policy as a function; an empty one for `id`.
[[nodiscard]] inline stamp_function function_of(stamp_policy p) {
  using namespace detail;
  switch (p) {
  case stamp_policy::id: break;
  case stamp_policy::mates: return [](knowledge const& k) { return mates_agreeing(k); };
  case stamp_policy::closeness: return [](knowledge const& k) { return closeness(k); };
  case stamp_policy::closeness_if_agreed:
    return [](knowledge const& k) { return mates_agreeing(k) == 0 ? 0 : closeness(k); };
  case stamp_policy::mates_then_closeness:
    return [](knowledge const& k) { return first_then(mates_agreeing(k), closeness(k, greatest_second)); };
  case stamp_policy::consensus: return [](knowledge const& k) { return shared_worth(k); };
  }
  return {};
}

}  // namespace rota::sim
