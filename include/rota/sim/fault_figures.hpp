#pragma once

#include <rota/sim/campaign.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

/// How long a team takes to overcome what goes wrong: five robots with the default options, exact eyes, 2 to 5 ms under way.
namespace rota::sim {

/// How `fault_figures` are measured. Equal options give equal figures.
struct fault_study {
  std::uint64_t seed = 1;
  std::size_t runs = 200;  ///< for each figure
  robot_options robot;     ///< of every robot
};

struct fault_figures {
  /// How claims settle at one share of losses.
  struct settling {
    double loss = 0;
    std::uint64_t cascades = 0;  ///< times at which somebody began to lead while nobody did
    double settled_ms_p95 = 0;   ///< from there until all five are led by one of them
    double two_leaders_ms = 0;   ///< the longest time that two led at once
  };
  double dead_believed_ms = 0;   ///< the longest that anybody believed in a dead robot, at 60 % loss
  double disagreement_ms = 0;    ///< the longest from the healing of a partition to the last disagreement
  double greater_heard_ms = 0;   ///< the longest until all have heard a robot that restarted with a greater incarnation
  double equal_heard_ms = 0;     ///< … with an equal one
  double blind_wrong_share = 0;  ///< of time without exactly one attacker, where the greatest robot sees nothing
  double others_wrong_share = 0;  ///< … of the time in which another is the closest to the ball
  double seeing_wrong_share = 0;  ///< … where all see
  std::vector<settling> settled;  ///< at 0, 20 and 60 % loss
};

namespace detail {

/// One kind of run: the same team of five, and what goes wrong with it.
class fault_runs {
public:
  explicit fault_runs(fault_study const& s) : study_(s), book_(campaign_playbook()) {}

  /// The longest that anybody believes in a robot after it died.
  double dead_believed() {
    return longest([&](std::uint64_t seed, random_engine& engine) {
      auto o = options(seed, 0.6);
      auto const who = some(engine);
      instant const death = instant{} + between(engine, seconds(3), seconds(6));
      o.faults.crashes = {{who, death, crash::for_good}};
      simulation<restless_world> team(book_, quarrel(seed, engine), o);
      instant last = death;
      bool believed[robots] = {};
      team.run(death + seconds(15), [&](log_record const& r) {
        if (r.time < death || r.robot == who) return;
        bool const now = team.robot(r.robot).believes(type())->takes_part({who + 1});
        if (believed[r.robot] && !now) last = r.time;
        believed[r.robot] = now;
      });
      return *std::max_element(believed, believed + robots) ? seconds(15) : last - death;
    });
  }

  /// The longest from when all links are whole again until all agree for good. All see the same all the time.
  double disagreement() {
    return longest([&](std::uint64_t seed, random_engine& engine) {
      auto o = options(seed, 0);
      instant const cut = instant{} + between(engine, seconds(2), seconds(3));
      instant const whole = cut + between(engine, seconds(1), seconds(6));
      o.faults.partitions = {{{cut, whole}, static_cast<std::uint32_t>(uniform(engine, 1, (1 << robots) - 2))}};
      restless_options w;
      w.jumps = milliseconds(500);
      w.calm = whole;
      simulation<restless_world> team(book_, restless_world(robots, seed, w), o);
      instant last = whole;
      bool differ = false;
      instant const end = whole + seconds(8);
      team.run(end, [&](log_record const& r) {
        if (r.change.empty() && r.what != happening::entered) return;
        bool const before = std::exchange(differ, disagree(team));
        if (before && !differ && r.time > whole) last = r.time;
      });
      return (differ ? end : last) - whole;
    });
  }

  /// The longest until all others have accepted a message of a robot that came back. None is lost.
  double restart_heard(rebirth as) {
    return longest([&](std::uint64_t seed, random_engine& engine) {
      auto o = options(seed, 0);
      auto const who = some(engine);
      instant const death = instant{} + between(engine, seconds(6), seconds(7));
      instant const back = death + between(engine, milliseconds(100), seconds(3));
      o.faults.crashes = {{who, death, back - death, as}};
      simulation<restless_world> team(book_, restless_world(robots, seed, {}), o);
      instant heard = back;
      std::size_t count = 0;
      bool by[robots] = {};
      auto const watch = [&](log_record const& r) {
        if (r.time <= back + milliseconds(5) || r.what != happening::heard_plan || r.other != who) return;
        if (r.verdict != verdict::accepted || std::exchange(by[r.robot], true)) return;
        heard = r.time;
        ++count;
      };
      for (instant t = back; count < robots - 1 && t < back + seconds(35);) team.run(t += seconds(1), watch);
      return count == robots - 1 ? heard - back : seconds(35);
    });
  }

  /// The share of time without exactly one attacker: all in all, and where the greatest robot is not the closest to the ball.
  /// The ball jumps every five seconds.
  std::pair<double, double> wrong_share(bool blind) {
    duration wrong[2] = {}, total[2] = {};
    (void)longest([&](std::uint64_t seed, random_engine&) {
      auto o = options(seed, 0.02);
      if (blind) o.faults.blind = {{robots - 1, {}}};
      restless_options w;
      w.jumps = seconds(5);
      simulation<restless_world> team(book_, restless_world(robots, seed, w), o);
      instant const begin = instant{} + seconds(2), end = instant{} + seconds(32);
      instant last = begin;
      bool right = true, greatest = false, attacks[robots] = {};
      auto const pass_to = [&](instant t) {
        if (t <= last) return;
        total[greatest] += t - last;
        if (!right) wrong[greatest] += t - last;
        last = t;
      };
      team.run(end, [&](log_record const& r) {
        pass_to(r.time);
        auto const own = team.robot(r.robot).believes(type())->part({r.robot + 1});
        attacks[r.robot] = own && book_.attacks(*own);
        right = std::count(attacks, attacks + robots, true) == 1;
        auto const& all = r.truth.robots;
        greatest = std::min_element(all.begin(), all.end(), [&](robot_state const& a, robot_state const& b) {
                     return distance(a.position, r.truth.ball) < distance(b.position, r.truth.ball);
                   }) == all.end() - 1;
      });
      pass_to(end);
      return duration{};
    });
    auto const share = [](duration a, duration b) { return b == duration{} ? 0 : to_seconds(a) / to_seconds(b); };
    return {share(wrong[0] + wrong[1], total[0] + total[1]), share(wrong[0], total[0])};
  }

  /// Two robots are each sure to be closest, all the time.
  fault_figures::settling settling(double loss) {
    fault_figures::settling f;
    f.loss = loss;
    std::vector<duration> lengths;
    f.two_leaders_ms = longest([&](std::uint64_t seed, random_engine& engine) {
      auto o = options(seed, loss);
      o.robot.renewals = 0;  // a reign of fixed length, so that there are many
      simulation<restless_world> team(book_, quarrel(seed, engine), o);
      std::optional<instant> began, two;
      bool settled = false;
      duration both{};
      team.run(instant{} + seconds(30), [&](log_record const& r) {
        std::size_t leaders = 0, ruled = 0;
        std::optional<names::agent> leader;
        bool one = true;
        for (std::size_t i = 0; i < robots; ++i) {
          auto const* const a = team.robot(i).rule(type());
          if (!a || !a->active()) continue;
          ++ruled;
          leaders += a->leading() ? 1 : 0;
          if (leader && *leader != a->current().leader) one = false;
          leader = a->current().leader;
        }
        if (leaders > 0 && !began) began = r.time;
        if (began && !settled && ruled == robots && one && leaders == 1) {
          settled = true;
          lengths.push_back(r.time - *began);
        }
        if (ruled == 0 && began) {
          if (!settled) lengths.push_back(r.time - *began);
          began.reset();
          settled = false;
        }
        if (leaders > 1 && !two) two = r.time;
        if (leaders > 1 || !two) return;
        both = (std::max)(both, r.time - *two);
        two.reset();
      });
      return both;
    });
    f.cascades = lengths.size();
    if (lengths.empty()) return f;
    std::sort(lengths.begin(), lengths.end());
    f.settled_ms_p95 = to_milliseconds(lengths[(lengths.size() * 95 + 99) / 100 - 1]);
    return f;
  }

private:
  static constexpr std::size_t robots = 5;

  [[nodiscard]] names::plan_type type() const { return book_.type.id(); }
  [[nodiscard]] simulation_options options(std::uint64_t seed, double loss) const {
    simulation_options o;
    o.seed = seed;
    o.robot = study_.robot;
    o.network.loss = loss;
    o.sensor = exact_sensor();
    return o;
  }
  static std::size_t some(random_engine& engine) {
    return static_cast<std::size_t>(uniform(engine, 0, static_cast<std::int64_t>(robots) - 1));
  }
  static duration between(random_engine& engine, duration low, duration high) {
    return nanoseconds(uniform(engine, low.ns, high.ns));
  }
  static restless_world quarrel(std::uint64_t seed, random_engine& engine) {
    restless_world w(robots, seed, {});
    auto const a = some(engine);
    auto b = some(engine);
    while (b == a) b = some(engine);
    w.delude(a);
    w.delude(b);
    return w;
  }
  [[nodiscard]] bool disagree(simulation<restless_world> const& team) const {
    for (std::size_t i = 1; i < robots; ++i)
      if (team.plays(i) && team.robot(i).believes(type())->atoms() != team.robot(0).believes(type())->atoms())
        return true;
    return false;
  }
  /// The longest of what so many runs say, in ms.
  template <class Run>
  double longest(Run run) {
    duration most{};
    for (std::size_t k = 0; k < study_.runs; ++k) {
      std::uint64_t const seed = scatter(study_.seed) + k;
      auto engine = engine_for(seed, stream::campaign, 1);
      most = (std::max)(most, run(seed, engine));
    }
    return to_milliseconds(most);
  }

  fault_study study_;
  playbook book_;
};

}  // namespace detail

/// Measures them all. `next` is told before each how many there are, and what comes.
[[nodiscard]] inline fault_figures
measure_faults(fault_study const& study,
               std::function<void(std::size_t steps, std::string_view what)> const& next = {}) {
  detail::fault_runs runs(study);
  fault_figures f;
  auto const step = [&](std::string_view what) {
    if (next) next(9, what);
  };
  step("a dead robot");
  f.dead_believed_ms = runs.dead_believed();
  step("a partition");
  f.disagreement_ms = runs.disagreement();
  step("a restart with a greater incarnation");
  f.greater_heard_ms = runs.restart_heard(rebirth::greater);
  step("a restart with an equal incarnation");
  f.equal_heard_ms = runs.restart_heard(rebirth::equal);
  step("a blind robot");
  std::tie(f.blind_wrong_share, f.others_wrong_share) = runs.wrong_share(true);
  step("no blind robot");
  f.seeing_wrong_share = runs.wrong_share(false).first;
  for (double const loss : {0.0, 0.2, 0.6}) {
    step("two leaders");
    f.settled.push_back(runs.settling(loss));
  }
  return f;
}

}  // namespace rota::sim
