// rota's allocation search beside its peers, cold: every solve starts from nothing but its buffers.
//
// `5x3` is five agents and three tasks; where agents may idle, idling is one more slot. A peer's set-up (its graph, its
// model, its file) is the counter setup_ns, per instance, and in no time. Peers in another process are timed by themselves;
// process_ns is what passed until they ended.

#include "instances.hpp"
#include "ours.hpp"
#include "peers/value.hpp"
#include "support.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

using instances::size;

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// As many instances as keep branch predictors from learning them, where that does not take too long.
std::size_t rotation(peers::additive_instance const& in) {
  auto const pairs = in.utility.size();
  return pairs <= 100 ? 64 : pairs <= 1000 ? 32 : pairs <= 100'000 ? 8 : 2;
}
std::size_t rotation(peers::pairwise_instance const& in) {
  return in.agents <= 5 ? 32 : in.agents <= 8 ? 16 : in.agents <= 12 ? 8 : 4;
}

/// The instances of a family at a size, made when first needed, with their optima by a peer.
template <class Instance>
class family {
public:
  using make = std::function<Instance(std::uint64_t seed)>;

  explicit family(make f) : make_(std::move(f)), first_(make_(0)) {}

  Instance const& first() const { return first_; }
  std::vector<Instance> const& all() {
    if (all_.empty())
      for (std::size_t seed = 0; seed < rotation(first_); ++seed) all_.push_back(make_(seed));
    return all_;
  }
  /// What a peer found first, or else what one finds now, rather a quick one; nothing if no peer is linked in.
  ///
  /// @param found by a peer
  std::optional<std::int64_t> optimum(std::size_t i, std::optional<std::int64_t> found = {}) {
    optima_.resize(all().size());
    if (!optima_[i]) optima_[i] = found;
    for (auto const effort : {peers::effort::quick, peers::effort::slow})
      for (auto const& entry : peers::all<Instance>()) {
        if (optima_[i]) return optima_[i];
        if (entry.needs(all()[i]) != effort) continue;
        auto const solver = entry.make(all()[i]);
        if (solver->solve()) optima_[i] = value(all()[i], solver->answer());
      }
    return optima_[i];
  }

private:
  make make_;
  Instance first_;
  std::vector<Instance> all_;
  std::vector<std::optional<std::int64_t>> optima_;
};

using solvers = std::vector<std::unique_ptr<peers::peer>>;

/// The counters of a row; every row needs the same.
void count(benchmark::State& state, double setup_seconds, double process_seconds) {
  state.counters["setup_ns"] = setup_seconds * 1e9;
  state.counters["process_ns"] = process_seconds * 1e9;
}

/// Times all in turn, one as often as another.
void time_solving(benchmark::State& state, solvers const& all) {
  bool const rewinds = all.front()->rewind();
  while (state.KeepRunningBatch(static_cast<benchmark::IterationCount>(all.size()))) {
    for (auto const& s : all) {
      bool found = s->solve();
      benchmark::DoNotOptimize(found);
    }
    if (!rewinds) continue;
    state.PauseTiming();
    for (auto const& s : all) s->rewind();
    state.ResumeTiming();
  }
}

/// Takes the time that processes state.
///
/// @return the seconds that passed until one had ended
double time_processes(benchmark::State& state, solvers const& all) {
  double passed = 0;
  while (state.KeepRunningBatch(static_cast<benchmark::IterationCount>(all.size()))) {
    for (auto const& s : all) {
      passed -= seconds();
      check(s->solve(), "an optimum");
      passed += seconds();
      state.SetIterationTime(dynamic_cast<peers::peer_process&>(*s).solve_seconds());
    }
  }
  return passed / static_cast<double>(state.iterations());
}

template <class Instance>
struct row {
  std::shared_ptr<family<Instance>> instances;
  peers::entry<Instance> solver;
  bool ours = false;
  bool checked = false;

  void operator()(benchmark::State& state) {
    auto const& in = instances->all();
    auto const start = seconds();
    solvers all;
    for (auto const& instance : in) all.push_back(solver.make(instance));
    auto const setup = (seconds() - start) / static_cast<double>(in.size());
    if (solver.process) {
      count(state, setup, time_processes(state, all));
    } else {
      time_solving(state, all);
      count(state, setup, 0);
    }
    if (std::exchange(checked, true)) return;
    for (std::size_t i = 0; i < in.size(); ++i) {
      if (ours || all[i]->rewind()) all[i]->solve();  // ours share what answers are in
      auto const found = value(in[i], all[i]->answer());
      auto const right = instances->optimum(i, ours ? std::nullopt : found);
      check(found && (!right || found == right), "an optimum");
    }
  }
};

template <class Instance>
void add_row(std::string const& name, row<Instance> r) {
  auto* const added = benchmark::RegisterBenchmark(name.c_str(), r);
  if (r.solver.needs(r.instances->first()) == peers::effort::slow) added->Repetitions(1);
  if (r.solver.process)
    added->UseManualTime()->Iterations(static_cast<benchmark::IterationCount>(rotation(r.instances->first())));
}

template <class Ours, class Instance>
row<Instance> row_of_ours(std::shared_ptr<family<Instance>> instances) {
  auto const make = [](Instance const& in) -> std::unique_ptr<peers::peer> { return std::make_unique<Ours>(in); };
  auto const quick = [](Instance const&) { return peers::effort::quick; };
  return {std::move(instances), {"rota", make, quick, false}, true};
}

/// A row for rota, and one for each peer that takes such instances.
template <class Ours, class Instance>
void add_rows(std::string const& name, size s, typename family<Instance>::make make) {
  auto const at = '/' + std::to_string(s.agents) + 'x' + std::to_string(s.tasks);
  auto const all = std::make_shared<family<Instance>>(std::move(make));
  add_row(name + at, row_of_ours<Ours>(all));
  for (auto const& peer : peers::all<Instance>()) {
    bool const too_short = peer.process && s.agents < 8;  // what processes state steps by a millisecond
    if (peer.needs(all->first()) == peers::effort::never || too_short) continue;
    add_row(name + "/peer:" + peer.name + at, row<Instance>{all, peer});
  }
}

/// The time of looking at every utility once, to which the time of large instances is compared.
void add_reading(size s) {
  using matrix = std::vector<std::int64_t>;
  auto const name = "read/additive/" + std::to_string(s.agents) + 'x' + std::to_string(s.tasks);
  benchmark::RegisterBenchmark(name.c_str(), [s](benchmark::State& state) {
    std::vector<matrix> all;
    for (std::uint64_t seed = 0; seed < 2; ++seed) all.push_back(uniform(s, congested_bounds(s), seed).utility);
    rotate(state, all, [](matrix const& u) {
      std::uint64_t sum = 0;
      for (auto const x : u) sum += static_cast<std::uint64_t>(x);
      return sum;
    });
    count(state, 0, 0);
  });
}

void add_additive() {
  using namespace instances;
  auto rows = [](std::string const& name, size s, std::function<additive_instance(std::uint64_t)> make) {
    add_rows<ours::additive, additive_instance>("allocate/" + name, s, std::move(make));
  };
  for (size const s : {size{5, 3}, size{50, 10}, size{200, 20}, size{1000, 50}, size{10000, 100}}) {
    rows("additive/congested", s, [s](auto seed) { return uniform(s, congested_bounds(s), seed); });
    rows("additive/distances", s, [s](auto seed) { return distances(s, congested_bounds(s), seed); });
    if (s.agents >= 1000) add_reading(s);
  }
  size const huge{100'000, 100};
  rows("additive/congested", huge, [huge](auto seed) { return uniform(huge, congested_bounds(huge), seed); });
  add_reading(huge);
  for (size const s : {size{50, 10}, size{1000, 50}}) {
    auto const at = '/' + std::to_string(s.agents) + 'x' + std::to_string(s.tasks);
    auto const alone = [&]<class Ours>(char const* name, auto make) {
      add_row("allocate/additive/" + (name + at),
              row_of_ours<Ours>(std::make_shared<family<additive_instance>>(std::move(make))));
    };
    auto const congested = [s](auto seed) { return uniform(s, congested_bounds(s), seed); };
    auto const of_digits = [s](auto seed) { return digits(s, congested_bounds(s), seed); };
    auto const of_classes = [s](auto seed) { return classes(s, congested_bounds(s), seed, s.agents / 10); };
    rows("additive/contested", s, [s](auto seed) { return contested(s, congested_bounds(s), seed); });
    rows("additive/digits", s, of_digits);
    rows("additive/classes", s, of_classes);
    alone.operator()<ours::any_optimum>("congested/ties:any", congested);
    alone.operator()<ours::keyed>("digits/ties:keyed", of_digits);
    alone.operator()<ours::keyed>("classes/ties:keyed", of_classes);
  }
  for (std::size_t const robots : {3u, 4u, 5u, 6u})
    rows("additive/attack_play", {robots, 4},
         [robots](auto seed) { return uniform({robots, 4}, attack_play(robots), seed); });
  for (size const s : {size{100, 100}, size{1000, 1000}}) {
    rows("square/uniform", s, [s](auto seed) { return uniform(s, one_each(s), seed); });
    rows("square/distances", s, [s](auto seed) { return distances(s, one_each(s), seed); });
  }
}

void add_pairwise() {
  using namespace instances;
  for (size const s : {size{5, 3}, size{8, 4}, size{10, 5}, size{12, 6}, size{15, 5}}) {
    auto rows = [s](std::string const& name, std::function<pairwise_instance(std::uint64_t)> make) {
      add_rows<ours::pairwise, pairwise_instance>("allocate/pairwise/" + name, s, std::move(make));
    };
    rows("uniform", [s](auto seed) { return pairwise_uniform(s, seed); });
    rows("distances", [s](auto seed) { return pairwise_distances(s, seed); });
  }
}

}  // namespace

int main(int argc, char** argv) {
  add_additive();
  add_pairwise();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
