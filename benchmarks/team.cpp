// One robot's 30 ms: a team of five robots and four tasks, everything included, and the steps it is made of.
//
// `heap_allocations` counts calls of operator new per iteration; it is 0 in a steady loop.

#include "support.hpp"

#include <rota/team/conflict.hpp>
#include <rota/team/robot.hpp>

#include <support/allocation_counter.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace {

using vocabulary = rota::runtime_vocabulary;
using atom = rota::in<vocabulary>;
using event = rota::event<atom>;
using agent_id = vocabulary::agent;

constexpr std::size_t robots = 5;
constexpr std::size_t tasks = 4;
constexpr vocabulary::plan_type play{7};
constexpr vocabulary::plan normal{1};
constexpr rota::duration tick = rota::milliseconds(30);

/// Attack, defend, support, and keep the goal; the robots differ in all of it.
struct beliefs {
  std::array<std::array<double, tasks>, robots> skill{};
};

beliefs some_beliefs() {
  auto random = seeded();
  beliefs b;
  for (auto& row : b.skill)
    for (double& x : row) x = uniform(random);
  return b;
}

rota::plan_type<vocabulary, beliefs> make_play() {
  using plan = rota::plan<vocabulary, beliefs>;
  rota::additive_utility<vocabulary, beliefs> const worth = [](auto a, auto t, beliefs const& b) {
    return std::optional{b.skill[a.value][t.value]};
  };
  auto p = plan::make({.plan = normal,
                       .tasks = {{{0}, {1, 1}, {}}, {{1}, {0, 2}, {}}, {{2}, {0, 1}, {}}, {{3}, {1, 1}, {}}},
                       .utility = worth});
  return *rota::plan_type<vocabulary, beliefs>::make(play, {*p});
}

/// The best total by trying all 5^5 assignments, to check the team's decision against.
double best_total(beliefs const& b) {
  double best = 0;
  for (std::size_t code = 0; code < 3125; ++code) {
    std::array<std::size_t, tasks + 1> count{};
    double sum = 0;
    for (std::size_t a = 0, rest = code; a < robots; ++a, rest /= 5) {
      ++count[rest % 5];
      if (rest % 5 < tasks) sum += b.skill[a][rest % 5];
    }
    if (count[0] == 1 && count[1] <= 2 && count[2] <= 1 && count[3] == 1) best = std::max(best, sum);
  }
  return best;
}

/// Robot 0 and what it needs, after it has heard of everybody and decided.
struct setting {
  rota::plan_type<vocabulary, beliefs> type = make_play();
  rota::team<vocabulary> members = squad();
  beliefs seen = some_beliefs();
  rota::workspace space;
  rota::robot<vocabulary> self;
  rota::instant now{};
  std::uint64_t sequence = 0;

  explicit setting(rota::robot_options options = {}) : self({0}, members.agents(), rota::incarnation{1}, options) {
    self.enter(type, now);
    for (std::uint64_t b = 1; b < robots; ++b) hear(b, std::nullopt);
    auto const d = deliberate();
    check(std::abs(d.search->utility - best_total(seen)) < 1e-5, "the best allocation");
    for (std::uint64_t b = 1; b < robots; ++b) hear(b, task_of(b));
    check(deliberate().reason == rota::decision_reason::kept, "then nothing changes");
  }
  static rota::team<vocabulary> squad() {
    rota::team<vocabulary> t;
    for (std::uint64_t a = 0; a < robots; ++a) t.add({a});
    return t;
  }
  std::optional<vocabulary::task> task_of(std::uint64_t b) const {
    auto const x = self.believes(play)->part({b});
    return x ? std::optional{x->task} : std::nullopt;
  }
  rota::reception<vocabulary> hear(std::uint64_t from, std::optional<vocabulary::task> task) {
    rota::plan_message<vocabulary> m{{from}, {{1}, ++sequence}, {}};
    rota::participation<vocabulary> p{play, std::nullopt};
    if (task) p.place = rota::placement<vocabulary>{normal, *task, {}};
    m.types.push_back(p);
    return self.receive(m, now);
  }
  rota::decision<vocabulary> deliberate() { return self.deliberate(type, members, seen, now, space); }
};

/// Times f() and counts what it allocates.
template <class F>
void counted(benchmark::State& state, F&& f) {
  auto const before = rota_test::allocation_count();
  for (auto _ : state) {
    auto&& result = f();
    benchmark::DoNotOptimize(result);
  }
  state.counters["heap_allocations"] = benchmark::Counter(static_cast<double>(rota_test::allocation_count() - before),
                                                          benchmark::Counter::kAvgIterations);
}

void deliberate_unchanged(benchmark::State& state) {
  setting s;
  counted(state, [&] { return s.deliberate(); });
  check(s.deliberate().reason == rota::decision_reason::kept, "still nothing changes");
}

/// Every tick one of the others repeats what it does.
void tick_agreeing(benchmark::State& state) {
  setting s;
  std::array<std::optional<vocabulary::task>, robots> does;
  for (std::uint64_t b = 0; b < robots; ++b) does[b] = s.task_of(b);
  std::uint64_t b = 0;
  counted(state, [&] {
    s.now += tick;
    b = b % (robots - 1) + 1;
    s.hear(b, does[b]);
    return s.deliberate();
  });
  check(s.deliberate().reason == rota::decision_reason::kept, "they agree");
}

/// Every tick one of the others contradicts, and the robot sets it right: a cycle each, without a leader to end it.
void tick_quarrelling(benchmark::State& state) {
  rota::robot_options options;
  options.resolution = false;
  setting s(options);
  auto const at_peace = s.self.believes(play)->atoms();
  std::uint64_t b = 0;
  std::uint64_t cycles = 0;
  counted(state, [&] {
    s.now += tick;
    b = b % (robots - 1) + 1;
    s.hear(b, vocabulary::task{s.task_of(b) == vocabulary::task{1} ? 2u : 1u});
    auto d = s.deliberate();
    cycles += d.cycles;
    return d;
  });
  check(cycles == static_cast<std::uint64_t>(state.iterations()), "each one a cycle");
  check(s.self.believes(play)->atoms() == at_peace, "set right");
}

void receive_plan_message(benchmark::State& state) {
  setting s;
  auto const does = s.task_of(1);
  counted(state, [&] { return s.hear(1, does); });
  check(s.hear(1, does).verdict == rota::verdict::accepted, "the message is taken in");
  check(s.hear(1, does).changes.empty(), "and says nothing new");
}

/// A message that disagrees, and the deliberation that restores what was: one cycle, judged by the default monitor.
void monitor_step(benchmark::State& state) {
  rota::cycle_monitor<vocabulary> monitor(rota::monitor_options{.cycles = 4});
  std::vector<rota::part_change<vocabulary>> leave;
  rota::allocation_atoms<vocabulary> atoms;
  for (std::uint64_t b = 0; b < robots; ++b) {
    atom const part{{b}, normal, {b % tasks}};
    leave.push_back({{b}, part, std::nullopt});
    atoms.insert(part);
  }
  event const nothing;
  rota::instant now{};
  std::size_t b = 0;
  std::uint64_t detections = 0;
  counted(state, [&] {
    now += tick;
    b = b + 1 == robots ? 1 : b + 1;
    monitor.on_message(leave[b], now);
    auto const v = monitor.on_deliberation(nothing, atoms, now);
    check(v.cycles == 1, "one cycle");
    detections += v.detected.has_value();
    return v;
  });
  // Four robots in turn have completed 13 cycles when one of them has completed four; then all is forgotten.
  check(detections == static_cast<std::uint64_t>(state.iterations()) / 13, "every 13th is the fourth of its robot");
}

/// The events of one robot changing its task, on run-time names: what a team composes all day.
void compose_one_change(benchmark::State& state) {
  auto random = seeded();
  std::vector<std::pair<event, event>> pairs;
  auto change = [&] {
    agent_id const b{pick(random, robots)};
    auto const from = pick(random, tasks);
    return *event::make({{b, normal, {(from + 1 + pick(random, tasks - 1)) % tasks}}}, {{b, normal, {from}}});
  };
  for (int i = 0; i < 256; ++i) {
    auto e = change();
    pairs.emplace_back(std::move(e), change());
  }
  for (auto const& [e, f] : pairs)
    for (std::uint64_t b = 0; b < robots; ++b)
      for (std::uint64_t t = 0; t < tasks; ++t) {
        atom const x{{b}, normal, {t}};
        check(compose(e, f)(x) == rota::clamped_sum(e(x), f(x)), "compose");
      }
  std::size_t i = 0;
  counted(state, [&] {
    auto const& [e, f] = pairs[i++ % 256];
    return compose(e, f);
  });
}

BENCHMARK(deliberate_unchanged)->Name("deliberate/unchanged/5x4");
BENCHMARK(tick_agreeing)->Name("tick/agreeing_message/5x4");
BENCHMARK(tick_quarrelling)->Name("tick/contradicting_message/5x4");
BENCHMARK(receive_plan_message)->Name("receive/plan_message");
BENCHMARK(monitor_step)->Name("cycle_monitor/step");
BENCHMARK(compose_one_change)->Name("compose/one_task_change");

}  // namespace
