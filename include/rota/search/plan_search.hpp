#pragma once

#include <rota/search/formulation.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

namespace rota::detail {

/// The search for the best allocation of one plan: what is best is U_p less change costs.
///
/// First the additive solver on what parts of U_p say of agents one by one: the optimum where there is nothing else, a proof
/// that there is no allocation at all, or else prices that bound. Then the pairwise solver where parts look at two agents,
/// and none at more; branch and bound for the rest. Leaves the assignment in `workspace::candidate`.
template <vocabulary V, class Beliefs>
class plan_search final : private dense::tree_oracle {
public:
  using agent = typename V::agent;
  struct outcome {
    std::optional<fixed_utility> utility{};  ///< U_p of the best valid allocation; otherwise see `refusal`
    std::int64_t objective = 0;              ///< the same less change costs, in units
    std::int64_t bound = 0;                  ///< no valid allocation has a greater objective
    std::size_t changes = 0;
    plan_refusal<V> refusal{};
    [[nodiscard]] bool optimal() const noexcept { return objective >= bound; }
  };

  plan_search(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p, workspace& w, plan_memory& memory)
      : problem_(problem), plan_(p), work_(w), memory_(memory), form_(problem, p, memory, w.row) {
    bool const running =
        std::any_of(problem.current.begin(), problem.current.end(), [&](in<V> const& x) { return x.plan == p.id(); });
    precondition_ = p.precondition() && !(running && p.scope() == precondition_scope::entry_only);
    for_each_part<V, Beliefs>(p.utility(), [&](double, auto const& part) {
      using part_type = std::remove_cvref_t<decltype(part)>;
      general_ |= std::same_as<part_type, general_utility<V, Beliefs>>;
      pairwise_ |= std::same_as<part_type, pairwise_utility<V, Beliefs>>;
    });
  }

  outcome run(search_budget const& budget, search_work& done) {
    if (!form_.write()) return refuse();
    note_current();
    dense::instance in{problem_.participants.size(), memory_.keys, memory_.bounds};
    in.unique = memory_.ties.unique();
    auto const first = solve_additive(in, budget, done);
    if (!first.found()) {
      explain(first);
      return refuse();
    }
    if (!coupled()) {
      bool const settled = first.proved() && form_.change_cost() == 0;
      if (settled && units(first.value) < 0) return negative(units(first.value));
      auto const value = leaf(first.assignment, first.value, std::nullopt);
      if (value && utility_of(first.assignment, units(first.value)) >= 0)
        return accept(first.assignment, units(first.value), units(first.bound));
    } else {
      in.utility = memory_.units;
      tables_ = pairwise_ && form_.write_pairs();
      if (auto const together = solve_pairwise(in, budget, done)) return *together;
    }
    return branch(in, first, budget, done);
  }

  /// The first thing that is no utility.
  [[nodiscard]] std::optional<utility_refusal<V>> ignored() const {
    if (form_.ignored()) return form_.ignored();
    return form_.pair_fault() ? form_.pair_fault() : coupling_fault_;
  }
  [[nodiscard]] std::optional<bound_lie<V>> const& lie() const noexcept { return lie_; }

private:
  outcome refuse() {
    outcome out;
    out.refusal = form_.refusal();
    out.refusal.plan = plan_.id();
    bool const searched = out.refusal.why != no_plan_reason::utilities_too_great;
    out.bound = searched ? (std::numeric_limits<std::int64_t>::min)() : dense::no_bound;
    return out;
  }
  outcome refuse(no_plan_reason why) {
    form_.refusal().why = why;
    return refuse();
  }
  outcome negative(std::int64_t units) {
    form_.refusal().value = to_double({units});
    return refuse(no_plan_reason::negative_utility);
  }
  outcome accept(std::span<dense::slot const> assignment, std::int64_t objective, std::int64_t bound) {
    work_.candidate.assign(assignment.begin(), assignment.end());
    outcome out;
    out.objective = objective;
    out.bound = bound;
    out.changes = changes_of(assignment);
    out.utility = fixed_utility{utility_of(assignment, objective)};
    return out;
  }

  /// Whether some part of U_p looks at more than one agent.
  [[nodiscard]] bool coupled() const noexcept { return general_ || pairwise_; }
  [[nodiscard]] std::int64_t units(std::int64_t keys) const { return memory_.ties.utility(keys); }

  // Change costs --------------------------------------------------------------------------------------------------------

  void note_current() {
    work_.now.assign(problem_.participants.size(), static_cast<dense::slot>(plan_.tasks().size()));
    if (problem_.current.empty()) return;
    for (std::size_t a = 0; a < work_.now.size(); ++a) work_.now[a] = form_.current_slot(a);
  }
  [[nodiscard]] std::size_t changes_of(std::span<dense::slot const> assignment) const {
    std::size_t changes = 0;
    for (std::size_t a = 0; a < assignment.size(); ++a) changes += assignment[a] != work_.now[a];
    return changes;
  }
  /// U_p from an objective.
  [[nodiscard]] std::int64_t utility_of(std::span<dense::slot const> assignment, std::int64_t objective) const {
    if (form_.change_cost() == 0) return objective;
    return objective + form_.change_cost() * static_cast<std::int64_t>(changes_of(assignment));
  }

  // Additive ------------------------------------------------------------------------------------------------------------

  dense::flow_outcome const& solve_additive(dense::instance const& in, search_budget const& budget, search_work& done) {
    if (memory_.solved) return memory_.last;
    dense::work_limit const limit{budget.relaxations, budget.stop};
    memory_.last = memory_.solver.resolve(in, memory_.changed, limit);
    memory_.seen = true;
    memory_.solved = memory_.last.proved();
    done += memory_.last.work;
    return memory_.last;
  }

  void explain(dense::flow_outcome const& o) {
    if (form_.blame_utility()) return;
    auto& refusal = form_.refusal();
    refusal.why = no_plan_reason::pairs_contradict;
    if (o.obstacle == dense::flow_obstacle::agent_stuck) {
      refusal.agent = problem_.participants[o.witness];
    } else if (o.witness < plan_.tasks().size()) {
      refusal.task = plan_.tasks()[o.witness].task;
    }
  }

  // Pairwise ------------------------------------------------------------------------------------------------------------

  /// Nothing where branch and bound has to do it.
  std::optional<outcome> solve_pairwise(dense::instance const& in, search_budget const& budget, search_work& done) {
    if (!tables_ || general_ || precondition_ || !memory_.pairs.within_range(in.utility)) return std::nullopt;
    auto& m = memory_;
    if (!m.settled) {
      m.together =
          work_.pairwise.solve({in.agents, m.units, m.pairs.couplings(), m.bounds}, {budget.nodes, budget.stop});
      m.placed.assign(m.together.assignment.begin(), m.together.assignment.end());
      m.settled = m.together.proved();
      done += m.together.work;
    }
    auto const& found = m.together;
    if (found.found() && utility_of(m.placed, found.value) >= 0)  // short of proving it canonical, it is not optimal
      return accept(m.placed, found.value, found.proved() ? found.value : (std::max)(found.bound, found.value + 1));
    if (found.status == dense::status::infeasible) {
      coupling_fault_ = form_.pair_fault();
      return coupling_refused();
    }
    if (form_.change_cost() == 0 && found.bound < 0) return negative(found.bound);
    if (found.proved()) return std::nullopt;
    auto out = refuse(no_plan_reason::search_incomplete);
    out.bound = found.bound;
    return out;
  }

  // Branch and bound ----------------------------------------------------------------------------------------------------

  outcome branch(dense::instance const& in, dense::flow_outcome const& first, search_budget const& budget,
                 search_work& done) {
    price_in(in.agents, in.slot_count());
    dense::tree_options options;
    options.limit = {budget.nodes, budget.stop};
    options.audit = budget.audit;
    if (!coupled() && first.proved() && form_.change_cost() == 0) options.enough = first.value;
    if (find_twins(in)) options.twin = work_.twin;
    begin_with(in, first, options);
    auto const tree = work_.tree.solve(in, *this, options);
    done += tree.work;
    if (tree.lie) note_lie(in, *tree.lie);
    bool const proved = tree.proved() && !tree.lie;
    auto const as_units = [&](std::int64_t value) { return coupled() ? value : units(value); };
    if (tree.found()) {
      auto const objective = as_units(tree.value);
      if (utility_of(tree.assignment, objective) >= 0)
        return accept(tree.assignment, objective,
                      proved                          ? objective
                      : tree.lie                      ? dense::no_bound
                      : tree.bound == dense::no_bound ? tree.bound
                                                      : as_units(tree.bound));
      if (proved) return negative(objective);
    }
    if (!proved) {
      auto out = refuse(no_plan_reason::search_incomplete);
      out.bound = tree.lie || tree.bound == dense::no_bound ? dense::no_bound : as_units(tree.bound);
      return out;
    }
    if (most_negative_) return negative(*most_negative_);
    if (coupling_fault_) return coupling_refused();
    return refuse(precondition_threw_ ? no_plan_reason::precondition_threw : no_plan_reason::precondition_never_holds);
  }

  /// Something to begin with, so that even a search that is stopped at once has an answer: what is best for agents alone, or
  /// what the team does now, if that is admissible.
  void begin_with(dense::instance const& in, dense::flow_outcome const& first, dense::tree_options& options) {
    auto const offer = [&](std::span<dense::slot const> x) {
      auto const sum = dense::value_of(in, x);
      if (!sum) return;
      auto const value = probe(x, *sum);
      if (!value || (!options.known.empty() && *value <= options.known_value)) return;
      options.known = x;
      options.known_value = *value;
    };
    if (coupled()) offer(first.assignment);  // otherwise it has been tried
    if (!problem_.current.empty()) offer(work_.now);
  }

  outcome coupling_refused() {
    auto& refusal = form_.refusal();
    refusal.fault = coupling_fault_->why;
    if (coupling_fault_->atom) refusal.agent = coupling_fault_->atom->agent, refusal.task = coupling_fault_->atom->task;
    return refuse(no_plan_reason::utility_refused);
  }

  allocation_view<V> decode(std::span<dense::slot const> assignment) {
    atoms_.clear();
    for (std::size_t a = 0; a < assignment.size(); ++a)
      if (assignment[a] < plan_.tasks().size())
        atoms_.push_back({problem_.participants[a], plan_.id(), plan_.tasks()[assignment[a]].task});
    return {atoms_.data(), atoms_.size()};
  }

  std::optional<std::int64_t> leaf(std::span<dense::slot const> assignment, std::int64_t sum,
                                   std::optional<std::int64_t> to_beat) override {
    if (!coupled() && to_beat && sum <= *to_beat) return std::nullopt;
    if (!coupled() && !precondition_ && form_.change_cost() == 0) return sum;
    auto const view = decode(assignment);
    if (precondition_) {
      auto const holds = guarded([&] { return plan_.precondition()(problem_.beliefs, view); });
      if (!holds) precondition_threw_ = true;
      if (!holds || !*holds) return std::nullopt;
    }
    auto value = sum;
    if (coupled()) {
      auto const whole = couple(view, assignment, sum);
      if (!whole) return std::nullopt;
      value = *whole;
    }
    if (form_.change_cost() == 0) return value;  // negative totals are judged at the end
    auto const utility = utility_of(assignment, coupled() ? value : units(value));
    if (utility >= 0) return value;
    most_negative_ = (std::max)(most_negative_.value_or(utility), utility);
    return std::nullopt;
  }
  std::optional<std::int64_t> probe(std::span<dense::slot const> assignment, std::int64_t sum) override {
    auto const kept = std::pair{coupling_fault_, precondition_threw_};
    auto const negative = most_negative_;
    auto const value = leaf(assignment, sum, std::nullopt);
    std::tie(coupling_fault_, precondition_threw_) = kept;
    most_negative_ = negative;
    return value;
  }

  /// The objective, from what it is by agents alone: adds what parts of U_p say of pairs and of the whole.
  std::optional<std::int64_t> couple(allocation_view<V> view, std::span<dense::slot const> assignment,
                                     std::int64_t alone) {
    fixed_utility total{alone};
    bool counts = true;
    auto count = [&](result<fixed_utility, utility_fault> const& term, std::optional<in<V>> x, std::optional<in<V>> y) {
      auto const why = add(total, term);
      if (why == utility_fault::none) return;
      counts = false;
      if (!coupling_fault_) coupling_fault_ = utility_refusal<V>{why, x, y};
    };
    if (tables_) {
      auto const together = memory_.pairs.value(assignment);
      counts = together && checked_add(total, {*together});
      if (!counts && !coupling_fault_) coupling_fault_ = form_.pair_fault();
    }
    for_each_part<V, Beliefs>(plan_.utility(), [&](double weight, auto const& part) {
      using part_type = std::remove_cvref_t<decltype(part)>;
      if constexpr (std::same_as<part_type, general_utility<V, Beliefs>>) {
        if (counts) count(value_of<V, Beliefs>(problem_, weight, part, view), std::nullopt, std::nullopt);
      } else if constexpr (std::same_as<part_type, pairwise_utility<V, Beliefs>>) {
        for (std::size_t i = 0; i < view.size() && counts && !tables_; ++i)
          for (std::size_t j = i + 1; j < view.size() && counts; ++j)
            count(term_of<V, Beliefs>(problem_, weight, part, view[i], view[j]), view[i], view[j]);
      }
    });
    return counts ? std::optional{total.units} : std::nullopt;
  }

  bool hopeless(std::span<dense::slot const> prefix) override {
    if (!precondition_ || !plan_.outlook()) return false;
    auto const view = decode(prefix);
    auto const rest = problem_.participants.subspan(prefix.size());
    auto const outlook = guarded([&] { return plan_.outlook()(problem_.beliefs, view, rest); });
    return outlook && *outlook == possibility::no;
  }

  /// What agents from one on add at most, at the prices of the slots: tight where the additive optimum is all there is.
  void price_in(std::size_t agents, std::size_t slot_count) {
    auto const price = memory_.solver.prices();
    work_.most.assign(agents + 1, 0);
    for (std::size_t k = 0; k < slot_count; ++k) {
      auto const [lower, upper] = memory_.solver.bounds(k);
      work_.most[agents] += price[k] * static_cast<std::int64_t>(price[k] > 0 ? upper : lower);
    }
    for (std::size_t a = agents; a-- > 0;) {
      work_.most[a] = work_.most[a + 1] + memory_.solver.most({memory_.keys.data() + a * slot_count, slot_count});
    }
  }
  [[nodiscard]] std::int64_t bound_alone(std::span<dense::slot const> prefix) const {
    auto const slot_count = plan_.tasks().size() + 1;
    auto const price = memory_.solver.prices();
    auto most = work_.most[prefix.size()];
    for (std::size_t a = 0; a < prefix.size(); ++a) most += memory_.keys[a * slot_count + prefix[a]] - price[prefix[a]];
    return most;
  }

  std::int64_t bound(std::span<dense::slot const> prefix, std::int64_t) override {
    auto const alone = bound_alone(prefix);
    if (!coupled()) return alone;
    fixed_utility total{units(alone)};
    bool known = !pairwise_ || tables_;
    bool nothing = false;
    if (tables_) {
      auto const together = memory_.pairs.most(prefix);
      nothing = !together;
      known = together && checked_add(total, {*together});
    }
    for_each_part<V, Beliefs>(plan_.utility(), [&](double weight, auto const& part) {
      using part_type = std::remove_cvref_t<decltype(part)>;
      if constexpr (std::same_as<part_type, general_utility<V, Beliefs>>) {
        if (!known || weight == 0) return;
        known = weight > 0 && part.bound;
        if (!known) return;
        auto const rest = problem_.participants.subspan(prefix.size());
        auto const said = guarded([&] { return part.bound(problem_.beliefs, decode(prefix), rest); });
        auto const most = said ? weigh(weight, *said) : refused{utility_fault::threw};
        if (most) {
          known = checked_add(total, most.value());
        } else {  // below the range nothing is admissible; above it, or for NaN, the bound says nothing
          nothing |= said && *said < 0;
          known = false;
        }
      }
    });
    return nothing ? (std::numeric_limits<std::int64_t>::min)() : known ? total.units : dense::no_bound;
  }

  /// Agents of one kind with equal rows are interchangeable, unless something else could tell them apart.
  bool find_twins(dense::instance const& in) {
    bool known = general_ && !pairwise_ && !precondition_;
    for_each_part<V, Beliefs>(plan_.utility(), [&](double, auto const& part) {
      using part_type = std::remove_cvref_t<decltype(part)>;
      if constexpr (std::same_as<part_type, general_utility<V, Beliefs>>) known &= static_cast<bool>(part.kind);
    });
    if (!known) return false;
    work_.twin.resize(in.agents);
    for (std::size_t a = 0; a < in.agents; ++a) {
      work_.twin[a] = static_cast<dense::row_index>(a);
      for (std::size_t b = a; b-- > 0 && work_.twin[a] == a;)
        if (std::equal(in.row(a), in.row(a) + in.slot_count(), in.row(b)) && same_kind(a, b))
          work_.twin[a] = static_cast<dense::row_index>(b);
    }
    return true;
  }
  [[nodiscard]] bool same_kind(std::size_t a, std::size_t b) const {
    bool same = true;
    for_each_part<V, Beliefs>(plan_.utility(), [&](double, auto const& part) {
      if constexpr (requires { part.kind; }) {
        auto const kind = [&](std::size_t x) {
          return guarded([&] { return part.kind(problem_.beliefs, problem_.participants[x]); });
        };
        auto const of_a = kind(a);
        same = same && of_a && of_a == kind(b);
      }
    });
    return same;
  }

  void note_lie(dense::instance const& in, dense::refuted_bound const& r) {
    if (!coupled()) return;
    bound_lie<V> l;
    auto const set = [&](std::span<dense::slot const> assignment) {
      auto const view = decode(assignment);
      return allocation_atoms<V>(view.begin(), view.end());
    };
    l.plan = plan_.id();
    l.partial = set(r.assignment.first(r.depth));
    l.complete = set(r.assignment);
    l.undecided = in.agents - r.depth;
    l.bound = to_double({r.bound});
    l.value = to_double({r.value});
    lie_ = std::move(l);
  }

  problem<V, Beliefs> const& problem_;
  plan<V, Beliefs> const& plan_;
  workspace& work_;
  plan_memory& memory_;
  formulation<V, Beliefs> form_;
  bool precondition_ = false;
  bool general_ = false;   // some part of U_p looks at the whole
  bool pairwise_ = false;  // some part of U_p looks at two agents
  bool tables_ = false;    // `plan_memory::pairs` says all that the latter do
  std::optional<utility_refusal<V>> coupling_fault_{};
  std::optional<bound_lie<V>> lie_{};
  bool precondition_threw_ = false;
  std::optional<std::int64_t> most_negative_{};
  small_vector<in<V>, 8> atoms_;
};

}  // namespace rota::detail
