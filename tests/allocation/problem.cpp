#include <rota/allocation/hysteresis.hpp>
#include <rota/allocation/validate.hpp>

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace problem_test {

struct names {
  enum class agent { a = 1, b };
  enum class plan_type { only };
  enum class plan { p };
  enum class task { t };
  enum class state { first };
};
using type = rota::plan_type<names, std::string>;
using team = rota::team<names>;
using problem = rota::problem<names, std::string>;
using agents = std::vector<names::agent>;

// A problem is made of variables: neither a temporary nor a converted copy may take their place.
static_assert(std::is_constructible_v<problem, type&, team&, std::string&>);
static_assert(std::is_constructible_v<problem, type const&, team const&, std::string const&, rota::idling>);
static_assert(std::is_constructible_v<problem, type const&, team&, std::string const&, agents&>);
static_assert(
    std::is_constructible_v<problem, type&, team&, std::string&, std::span<names::agent const>, rota::idling>);
static_assert(!std::is_constructible_v<problem, type, team&, std::string&>);
static_assert(!std::is_constructible_v<problem, type const, team&, std::string&>);
static_assert(!std::is_constructible_v<problem, type&, team, std::string&>);
static_assert(!std::is_constructible_v<problem, type&, team&, std::string>);
static_assert(!std::is_constructible_v<problem, type&, team&, std::string const>);
static_assert(!std::is_constructible_v<problem, type&, team&, char const*&>);
static_assert(!std::is_constructible_v<problem, type&, team&, std::string, rota::idling>);
static_assert(!std::is_constructible_v<problem, type&, team&, std::string&, agents>);
static_assert(!std::is_constructible_v<problem, type&, team&, std::string&, std::array<names::agent, 2>>);

// Without beliefs there is nothing to refer to.
using plain_type = rota::plan_type<names>;
using plain = rota::problem<names, rota::no_beliefs>;
static_assert(std::is_constructible_v<plain, plain_type&, team&>);
static_assert(std::is_constructible_v<plain, plain_type&, team&, rota::idling>);
static_assert(!std::is_constructible_v<plain, plain_type, team&>);
static_assert(!std::is_constructible_v<plain, plain_type&, team>);
static_assert(!std::is_constructible_v<problem, type&, team&>);

template <class P>
concept runs_temporary = requires(P const& p) { p.running(rota::allocation_atoms<names>{}); };
static_assert(!runs_temporary<problem>);

TEST(problem, what_runs_and_what_changes_cost_is_said_once_and_not_copied) {
  auto const p = plain_type::make(names::plan_type::only,
                                  {*rota::plan<names>::make({.plan = names::plan::p,
                                                             .tasks = {{names::task::t, {0, 2}, names::state::first}},
                                                             .utility = [](auto, auto, auto) { return 1.0; }})});
  team const members{names::agent::a, names::agent::b};
  rota::problem const here{*p, members, rota::idling::forbidden};
  EXPECT_EQ(here.participants.size(), 2u);
  EXPECT_TRUE(here.current.empty());
  rota::allocation_atoms<names> const now{{names::agent::a, names::plan::p, names::task::t}};
  auto const there = here.running(now).with_change_cost(0.5);
  EXPECT_EQ(there.current.data(), now.atoms().data());
  EXPECT_EQ(there.change_cost, 0.5);
  EXPECT_EQ(there.idle, rota::idling::forbidden);
  EXPECT_EQ(&there.members, &members);
  EXPECT_TRUE(here.current.empty()) << "the first problem is as it was";
}

TEST(hysteresis, nothing_beats_an_infinite_share_even_of_nothing) {
  constexpr auto infinity = std::numeric_limits<double>::infinity();
  constexpr rota::fixed_utility most{rota::quantise(rota::max_utility).value()};
  for (auto const current : {rota::fixed_utility{}, most, rota::fixed_utility{-most.units}}) {
    EXPECT_FALSE(rota::detail::beats(most, current, rota::detail::margin_of({.relative = infinity}, 0, current)));
    EXPECT_FALSE(rota::detail::beats(most, current, rota::detail::margin_of({.absolute = infinity}, 0, current)));
    EXPECT_EQ(rota::detail::beats(most, current, rota::detail::margin_of({}, 0, current)), current < most);
  }
  rota::fixed_utility const four{rota::quantise(4.0).value()};
  EXPECT_EQ(rota::detail::margin_of({.absolute = 1, .relative = 0.5}, 7, four), rota::quantise(3.0).value());
  EXPECT_EQ(rota::detail::margin_of({.relative = 0.5}, 7, four), rota::quantise(9.0).value());
}

}  // namespace problem_test
