#include <gtest/gtest.h>

#include "playground.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace interleavings_test {

using rota::decision_reason;
using rota::milliseconds;

namespace {

struct interleavings : playground {};

/// Loss, duplication, reordering, delay, leaving, entering and restart, over whole agents and their beliefs.
TEST_F(interleavings, authority_over_every_interleaving_of_real_agents) {
  constexpr int n = 4;
  int obeyed = 0, led = 0, restarted = 0, settled = 0, abandoned = 0;
  EXPECT_TRUE(rc::check("one leader, greater stamps only, bounded reigns; one round without loss settles", [&] {
    auto const who = squad(n);
    rota::robot_options options;
    options.cycles = 2;
    std::vector<robot> robots;
    std::vector<rota::incarnation> incarnation(n, first_life);
    for (auto a : who) {
      robots.emplace_back(a, who, first_life, options);
      robots.back().enter(play, start);
    }
    struct copy {
      message what;
      rota::instant sent;
    };
    std::vector<copy> flying;
    auto now = start;
    rota::instant last_reign_ends = start;
    rota::duration greatest_delay{};

    // Everybody thinks and speaks, everybody hears.
    auto const lossless_round = [&] {
      now += milliseconds(30);
      for (std::size_t i = 0; i < robots.size(); ++i) {
        (void)think(robots[i], sees(static_cast<int>(i) + 1), now);
        while (auto m = robots[i].next_message(now)) {
          flying.push_back({*m, now});
          for (auto& other : robots)
            if (&other != &robots[i]) other.receive(*m, now);
        }
        if (robots[i].rule(play_id)->leading())
          last_reign_ends = std::max(last_reign_ends, robots[i].rule(play_id)->expiry());
      }
    };
    int const prelude = *rc::gen::inRange(0, 14).as("rounds without loss");
    for (int round = 0; round < prelude; ++round) lossless_round();

    int const steps = *rc::gen::inRange(20, 150).as("steps");
    for (int step = 0; step < steps; ++step) {
      auto const i = static_cast<std::size_t>(*rc::gen::inRange(0, n));
      auto& r = robots[i];
      auto const held = [&]() -> std::optional<claim> {
        auto const* rule = r.rule(play_id);
        if (!rule || !rule->active()) return std::nullopt;
        return rule->current();
      };
      auto const before = held();
      switch (*rc::gen::weightedElement<int>({{3, 0}, {8, 1}, {4, 2}, {12, 3}, {1, 4}, {1, 5}})) {
      case 0: now += milliseconds(*rc::gen::inRange(1, 300)); break;
      case 1: (void)think(r, sees(static_cast<int>(i) + 1), now); break;
      case 2:
        while (auto m = r.next_message(now)) flying.push_back({*m, now});
        break;
      case 3: {
        if (flying.empty()) break;
        auto const& c = flying[static_cast<std::size_t>(*rc::gen::inRange<int>(0, static_cast<int>(flying.size())))];
        greatest_delay = std::max(greatest_delay, now - c.sent);
        auto const held_until = before ? r.rule(play_id)->expiry() : now;
        r.receive(c.what, now);
        auto const after = held();
        // It held that claim until it heard this message: it may have expired just now, but not been outranked by less.
        bool const expired = before && now >= held_until;
        if (before && after && !expired && after->leader != before->leader) RC_ASSERT(before->stamp < after->stamp);
        break;
      }
      case 4:
        if (!r.leave(play_id)) r.enter(play, now);
        break;
      default:
        ++incarnation[i].value;
        options.first_message = now;
        r = robot(who[i], who, incarnation[i], options);
        r.enter(play, now);
        ++restarted;
      }
      for (auto& each : robots) {
        auto const* rule = each.rule(play_id);
        if (!rule || !rule->active()) continue;
        RC_ASSERT(rule->leading() == (rule->current().leader == each.self()));
        if (rule->leading()) last_reign_ends = std::max(last_reign_ends, rule->expiry());
        RC_ASSERT(rule->expiry() <= last_reign_ends + greatest_delay);
        obeyed += rule->obeying();
        led += rule->leading();
      }
    }

    // From now on nothing is lost. Everybody takes part and speaks; whoever rules then rules alone.
    for (auto& r : robots) r.enter(play, now);
    for (int round = 0; round < 12; ++round) lossless_round();
    std::vector<soccer::agent> leaders;
    for (auto const& r : robots)
      if (r.rule(play_id)->leading()) leaders.push_back(r.self());
    if (!leaders.empty()) {
      ++settled;
      RC_ASSERT(leaders.size() == 1u);
      auto const& leader = *std::find_if(robots.begin(), robots.end(), [&](auto& r) { return r.self() == leaders[0]; });
      for (auto const& r : robots) {
        if (!r.rule(play_id)->obeying()) continue;
        auto const& held = r.rule(play_id)->current();
        if (held.leader != leaders[0]) {
          // A greater leader that has left unheard: its followers hold to expiry, as nobody can tell silence from loss.
          auto const& gone = robots[static_cast<std::size_t>(held.leader) - 1];
          RC_ASSERT(leader.rule(play_id)->current().stamp < held.stamp);
          RC_ASSERT(!gone.rule(play_id)->leading());
          ++abandoned;
          continue;
        }
        RC_ASSERT(r.believes(play_id)->atoms() == leader.believes(play_id)->atoms());
      }
    }

    // Nobody speaks any more: afterwards everybody is back to normal.
    now += rota::seconds(2) + greatest_delay;
    for (std::size_t i = 0; i < robots.size(); ++i) {
      auto const d = think(robots[i], sees(1), now);
      RC_ASSERT(d.reason != decision_reason::obeyed);
    }
  }));
  EXPECT_GT(obeyed, 1000);
  EXPECT_GT(led, 1000);
  EXPECT_GT(restarted, 100);
  EXPECT_GT(settled, 100);
  EXPECT_LT(abandoned, settled / 2);
}

}  // namespace

}  // namespace interleavings_test
