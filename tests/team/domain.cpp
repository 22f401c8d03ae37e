#include <rota/rota.hpp>

#include <gtest/gtest.h>

#include <type_traits>

namespace domain_test {

struct beliefs {
  double left_of_ball = 0;
};
struct soccer {
  enum class agent { left = 1, right };
  enum class plan_type { play };
  enum class plan { normal };
  enum class task { attack, defend };
  enum class state { get_ball, protect };
};
using game = rota::domain<soccer, beliefs>;

// Aliases: both spellings name one type.
static_assert(std::is_same_v<game::plan, rota::plan<soccer, beliefs>>);
static_assert(std::is_same_v<game::atom, rota::in<soccer>>);
static_assert(std::is_same_v<game::event, rota::event<rota::in<soccer>>>);
static_assert(std::is_same_v<game::robot, rota::robot<soccer>>);
static_assert(std::is_same_v<game::plan_id, soccer::plan>);
static_assert(std::is_same_v<rota::domain<>::plan_type, rota::plan_type<>>);

TEST(domain, names_the_pair_once) {
  using enum soccer::agent;
  using enum soccer::task;
  auto const normal =
      game::plan::make({.plan = soccer::plan::normal,
                        .tasks = {{attack, {1, 1}, soccer::state::get_ball}, {defend, {0, 2}, soccer::state::protect}},
                        .utility = [](soccer::agent a, soccer::task t, beliefs const& b) {
                          return t == defend ? 1.0 : a == left ? b.left_of_ball : 2.0;
                        }});
  ASSERT_TRUE(normal);
  auto const play = game::plan_type::make(soccer::plan_type::play, {*normal});
  ASSERT_TRUE(play);
  game::team const members{left, right};
  beliefs world{3};
  rota::workspace space;
  game::problem const here{*play, members, world};
  auto const best = rota::best_allocation(here, space);
  ASSERT_TRUE(best);
  EXPECT_EQ(best->atoms, (game::atoms{{left, soccer::plan::normal, attack}, {right, soccer::plan::normal, defend}}));
  game::validity_report const report = rota::validate(here, best->atoms);
  EXPECT_TRUE(report.valid());
}

}  // namespace domain_test
