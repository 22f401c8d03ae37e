#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "playground.hpp"

#include <map>
#include <optional>

namespace belief_test {

namespace {

using part = std::optional<atom>;
using change = rota::part_change<soccer>;
using rota::message_case;

rc::Gen<part> any_part(int who) {
  return rc::gen::map(rc::gen::tuple(rc::gen::arbitrary<bool>(), rc::gen::inRange(0, 2), rc::gen::inRange(0, 3)),
                      [who](auto const& t) {
                        auto const [has, p, task] = t;
                        return has ? part(atom{agent(who), soccer::plan(p), soccer::task(task)}) : part();
                      });
}
atoms alone(part const& p) { return p ? atoms{*p} : atoms{}; }

/// One value tells the parts, the event and the case, and the three agree.
TEST(part_change, tells_one_change_in_three_ways) {
  int of[4] = {};
  EXPECT_TRUE(rc::check("the event leads from before to after; the case is that of the event", [&] {
    change const c{agent(2), *any_part(2), *any_part(2)};
    auto const e = c.event();
    RC_ASSERT(e == rota::difference(alone(c.before), alone(c.after)));
    RC_ASSERT(c.empty() == e.empty());
    bool const adds = !e.additions().empty();
    bool const subtracts = !e.subtractions().empty();
    RC_ASSERT(c.what() == (adds ? (subtracts ? message_case::moved : message_case::joined)
                                : (subtracts ? message_case::left : message_case::agreement)));
    ++of[static_cast<int>(c.what())];
  }));
  for (int n : of) EXPECT_GT(n, 20);
}

/// What a robot's belief should be, kept in the plainest way.
struct ledger {
  struct entry {
    part does;
    soccer::state state{};
    rota::instant heard{};
  };
  std::map<soccer::agent, entry> of;
};

TEST(belief, keeps_what_each_agent_said_last) {
  int moved = 0, ignored = 0, expelled = 0;
  EXPECT_TRUE(rc::check("the belief is the ledger; each change leads from the old atoms to the new ones", [&] {
    rota::belief<soccer> believed;
    ledger plain;
    int const steps = *rc::gen::inRange(1, 40);
    for (int i = 0; i < steps; ++i) {
      auto const now = start + rota::milliseconds(i);
      auto const who = *rc::gen::inRange(1, 12);
      auto const b = agent(who);
      auto const told = *any_part(who);
      std::optional<rota::placement<soccer>> said;
      if (told) said = {told->plan, told->task, soccer::state(*rc::gen::inRange(0, 4))};
      auto const before = believed.atoms();
      change c{b};
      switch (*rc::gen::weightedElement<int>({{5, 0}, {2, 1}, {1, 2}, {1, 3}})) {
      case 0:
        c = believed.hear(b, said, now);
        plain.of[b].does = told;
        if (said) plain.of[b].state = said->state;
        plain.of[b].heard = now;
        moved += c.what() == message_case::moved;
        break;
      case 1:
        believed.hear_ruled(b, said, now);
        if (said && plain.of[b].does == told) plain.of[b].state = said->state;
        plain.of[b].heard = now;
        ignored += plain.of[b].does != told;
        break;
      case 2:
        believed.admit(b, now);
        plain.of[b].heard = now;
        break;
      default: c = believed.expel(b); expelled += plain.of.erase(b) > 0;
      }
      RC_ASSERT(c.agent == b);
      auto const applied = rota::apply(c.event(), before);
      RC_ASSERT(applied.has_value() && *applied == believed.atoms());

      RC_ASSERT(believed.participants().size() == plain.of.size());
      std::size_t tasks = 0;
      for (auto const& [a, entry] : plain.of) {
        RC_ASSERT(believed.takes_part(a));
        RC_ASSERT(believed.part(a) == entry.does);
        RC_ASSERT(believed.state(a) == entry.state);
        RC_ASSERT(believed.heard(a) == entry.heard);
        tasks += entry.does.has_value();
      }
      RC_ASSERT(believed.atoms().size() == tasks);
      RC_ASSERT(!believed.state(agent(42)).has_value());
    }
  }));
  EXPECT_GT(moved, 100);
  EXPECT_GT(ignored, 100);
  EXPECT_GT(expelled, 100);
}

}  // namespace

}  // namespace belief_test
