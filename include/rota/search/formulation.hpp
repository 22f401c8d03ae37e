#pragma once

#include <rota/dense/buffer.hpp>
#include <rota/search/solution.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <variant>

namespace rota::detail {

/// Writes one plan of a problem into dense numbers: slots are its tasks and, last, idling; utilities are what parts of U_p
/// that look at agents one by one say, less change costs, in units.
///
/// What does not differ from what the memory holds is left as it is, and `plan_memory::changed` says what does.
template <vocabulary V, class Beliefs>
class formulation {
public:
  using agent = typename V::agent;

  formulation(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p, plan_memory& memory,
              dense::buffer<std::int64_t>& row)
      : problem_(problem), plan_(p), memory_(memory), row_(row) {}

  /// False if the plan has no valid allocation for a reason that shows at once: `refusal`.
  bool write() { return write_bounds() && write_utilities(); }

  /// What parts of U_p say of two agents at a time, as tables; what is no utility forbids the combination. False if there are
  /// too many of them, or too great ones. @pre write()
  bool write_pairs() {
    std::size_t const n = problem_.participants.size();
    std::size_t const slot_count = plan_.tasks().size() + 1;
    if (!dense::pair_tables::suit(n, slot_count)) return false;
    memory_.pairs.resize(n, slot_count);
    bool changed = false;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        for (std::size_t x = 0; x + 1 < slot_count; ++x)
          for (std::size_t y = 0; y + 1 < slot_count; ++y) changed |= memory_.pairs.put(i, x, j, y, rate(i, x, j, y));
    if (changed) memory_.settled = false;
    return memory_.settled || memory_.pairs.finish(memory_.units);
  }

  [[nodiscard]] plan_refusal<V>& refusal() noexcept { return refusal_; }
  /// The first term left out because it is no utility.
  [[nodiscard]] std::optional<utility_refusal<V>> const& ignored() const noexcept { return ignored_; }
  /// The first combination of two atoms left out for that reason.
  [[nodiscard]] std::optional<utility_refusal<V>> const& pair_fault() const noexcept { return pair_fault_; }
  /// A change cost in units, nothing where it is out of range.
  [[nodiscard]] std::int64_t change_cost() const noexcept { return cost_; }

  /// What agent number a does now, as a slot of this plan; `no_slot` if it executes another plan.
  [[nodiscard]] dense::slot current_slot(std::size_t a) const {
    agent const who = problem_.participants[a];
    auto const& now = problem_.current;
    auto const x =
        std::lower_bound(now.begin(), now.end(), who, [](in<V> const& y, agent key) { return key > y.agent; });
    auto const tasks = plan_.tasks();
    if (x == now.end() || !(x->agent == who)) return static_cast<dense::slot>(tasks.size());
    if (!(x->plan == plan_.id())) return dense::no_slot;
    for (std::size_t s = 0; s < tasks.size(); ++s)
      if (tasks[s].task == x->task) return static_cast<dense::slot>(s);
    return dense::no_slot;
  }

  /// Where terms were left out as faulty, that is the likelier reason than the cardinalities.
  bool blame_utility() {
    if (!ignored_) return false;
    refusal_.why = no_plan_reason::utility_refused;
    refusal_.fault = ignored_->why;
    refusal_.agent = ignored_->atom->agent;
    refusal_.task = ignored_->atom->task;
    return true;
  }

private:
  static constexpr std::int64_t most_units = dense::max_total;
  static constexpr std::uint64_t unlimited = std::uint64_t{1} << 40;
  static constexpr std::uint32_t clip(std::uint64_t n) {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(n, cardinality::unbounded - 1));
  }
  bool fail(no_plan_reason why, std::uint64_t count, cardinality bounds) {
    refusal_.why = why;
    refusal_.count = count;
    refusal_.bounds = bounds;
    return false;
  }

  /// Cardinalities and team size as slot bounds; the team size bounds the idle slot from the other side.
  bool write_bounds() {
    std::size_t const n = problem_.participants.size();
    auto const tasks = plan_.tasks();
    std::uint64_t least = 0;
    std::uint64_t most = 0;
    for (plan_task<V> const& t : tasks) {
      least += t.bounds.lower();
      most += t.bounds.is_bounded() ? t.bounds.upper() : unlimited;
    }
    cardinality const size = plan_.team_size();
    std::uint64_t const size_max = size.is_bounded() ? size.upper() : unlimited;
    if (least > size_max) return fail(no_plan_reason::contradictory_cardinalities, least, size);
    if (most < size.lower()) return fail(no_plan_reason::contradictory_cardinalities, most, size);
    std::uint64_t const needed = std::max<std::uint64_t>(least, size.lower());
    if (n < needed) return fail(no_plan_reason::too_few_agents, n, {clip(needed), cardinality::unbounded});
    std::uint64_t const room = (std::min)(most, size_max);
    bool const may_idle = problem_.idle == idling::allowed;
    if (!may_idle && n > room) return fail(no_plan_reason::too_many_agents, n, {0, clip(room)});

    if (memory_.bounds.size() != tasks.size() + 1) memory_.bounds.assign(tasks.size() + 1, {~0u, ~0u});
    auto const set = [&](std::size_t s, std::uint64_t lower, std::uint64_t upper) {
      dense::slot_bounds const b{static_cast<std::uint32_t>(lower), static_cast<std::uint32_t>(upper)};
      if (memory_.bounds[s] == b) return;
      memory_.bounds[s] = b;
      memory_.solved = memory_.settled = false;
    };
    for (std::size_t s = 0; s < tasks.size(); ++s) {
      auto const& b = tasks[s].bounds;
      set(s, b.lower(), std::min<std::uint64_t>(b.is_bounded() ? b.upper() : unlimited, n));
    }
    set(tasks.size(), n - std::min<std::uint64_t>(n, size_max), may_idle ? n - size.lower() : 0);
    return true;
  }

  /// The utility matrix, with forbidden pairs absent.
  bool write_utilities() {
    std::size_t const n = problem_.participants.size();
    std::size_t const slot_count = plan_.tasks().size() + 1;
    auto const cost = weigh(1, problem_.change_cost);
    if (!cost || cost.value().units < 0) {
      refusal_.fault = cost ? utility_fault::negative : cost.error();
      refusal_.why = no_plan_reason::utility_refused;
      return false;
    }
    cost_ = cost.value().units;
    auto& m = memory_;
    bool const anew = m.units.size() != n * slot_count || !m.seen;
    if (anew) {
      m.units.assign(n * slot_count, dense::absent);
      m.keys.resize(n * slot_count);
    }
    m.changed.clear();
    row_.resize(slot_count);
    std::uint64_t greatest = 0;
    std::size_t greatest_at = 0;
    for (std::size_t a = 0; a < n; ++a) {
      if (auto const magnitude = write_row(a); magnitude > greatest) greatest = magnitude, greatest_at = a;
      auto const old = m.units.begin() + static_cast<std::ptrdiff_t>(a * slot_count);
      if (std::equal(row_.begin(), row_.end(), old)) continue;
      std::copy(row_.begin(), row_.end(), old);
      m.changed.push_back(static_cast<dense::row_index>(a));
    }
    if (!m.changed.empty()) m.seen = m.solved = m.settled = false;
    if (!dense::fits(n, slot_count, greatest)) {
      refusal_.agent = problem_.participants[greatest_at];
      refusal_.fault = utility_fault::out_of_range;
      refusal_.why = no_plan_reason::utilities_too_great;
      m.seen = m.solved = m.settled = false;
      return false;
    }
    break_ties(n, slot_count, greatest, anew);
    return every_task_served(n, slot_count) && every_agent_served(n, slot_count);
  }

  void break_ties(std::size_t n, std::size_t slot_count, std::uint64_t greatest, bool anew) {
    auto& m = memory_;
    dense::tie_rule const ties(n, slot_count, greatest);
    bool const all = anew || !(ties == m.ties);
    m.ties = ties;
    if (all) {
      m.changed.resize(n);
      for (std::size_t a = 0; a < n; ++a) m.changed[a] = static_cast<dense::row_index>(a);
      m.seen = m.solved = m.settled = false;
    }
    for (auto const a : m.changed) ties.keys(a, m.units.data() + a * slot_count, m.keys.data() + a * slot_count);
  }

  /// One agent's utilities into row_. @return the greatest magnitude
  std::uint64_t write_row(std::size_t a) {
    auto const tasks = plan_.tasks();
    agent const who = problem_.participants[a];
    ROTA_ASSERT(a == 0 || problem_.participants[a - 1] < who);
    auto const* const role = problem_.members.role_of(who);
    auto const now = cost_ != 0 ? current_slot(a) : dense::no_slot;
    std::uint64_t greatest = 0;
    auto const write = [&](std::size_t s, std::int64_t units) {
      // With the cost, so that sums fit both with and without it: what an agent gains by moving may be all its cost.
      greatest = (std::max)(greatest, static_cast<std::uint64_t>((units < 0 ? -units : units) + cost_));
      row_[s] = s != now ? units - cost_ : units;
    };
    for (std::size_t s = 0; s < tasks.size(); ++s) {
      row_[s] = dense::absent;
      if (role == nullptr || memory_.bounds[s].upper == 0 || !role->permits(tasks[s].task)) continue;
      if (auto const units = rate({who, plan_.id(), tasks[s].task})) write(s, *units);
    }
    row_[tasks.size()] = dense::absent;
    if (memory_.bounds[tasks.size()].upper > 0) write(tasks.size(), 0);
    return greatest;
  }

  [[nodiscard]] in<V> atom(std::size_t a, std::size_t s) const {
    return {problem_.participants[a], plan_.id(), plan_.tasks()[s].task};
  }

  /// What all pairwise parts of U_p say about two atoms; 0 where one of them is out of the question.
  std::int64_t rate(std::size_t i, std::size_t x, std::size_t j, std::size_t y) {
    std::size_t const slot_count = plan_.tasks().size() + 1;
    if (memory_.units[i * slot_count + x] == dense::absent || memory_.units[j * slot_count + y] == dense::absent)
      return 0;
    auto const one = atom(i, x);
    auto const other = atom(j, y);
    fixed_utility total;
    auto why = utility_fault::none;
    for_each_part<V, Beliefs>(plan_.utility(), [&](double weight, auto const& part) {
      if constexpr (std::same_as<std::remove_cvref_t<decltype(part)>, pairwise_utility<V, Beliefs>>)
        if (why == utility_fault::none) why = add(total, term_of<V, Beliefs>(problem_, weight, part, one, other));
    });
    if (why == utility_fault::none) return total.units;
    if (!pair_fault_) pair_fault_ = utility_refusal<V>{why, one, other};
    return dense::absent;
  }

  /// What all parts of U_p say about one atom.
  std::optional<std::int64_t> rate(in<V> const& x) {
    if (auto const* alone =
            std::get_if<additive_utility<V, Beliefs>>(&plan_.utility().form())) {  // the usual case, at once
      auto const value = guarded([&] { return (*alone)(x.agent, x.task, problem_.beliefs); });
      if (value && *value)
        if (auto const term = quantise(**value)) return term.value().units;
    }
    fixed_utility total;
    auto why = utility_fault::none;
    for_each_part<V, Beliefs>(plan_.utility(), [&](double weight, auto const& part) {
      if (why == utility_fault::none) why = add(total, term_of<V, Beliefs>(problem_, weight, part, x));
    });
    if (why == utility_fault::none && (total.units > most_units || total.units < -most_units))
      why = utility_fault::out_of_range;
    if (why == utility_fault::none) return total.units;
    if (why != utility_fault::forbidden_pair && !ignored_) ignored_ = utility_refusal<V>{why, x, std::nullopt};
    return std::nullopt;
  }

  bool every_task_served(std::size_t n, std::size_t slot_count) {
    for (std::size_t s = 0; s + 1 < slot_count; ++s) {
      if (memory_.bounds[s].lower == 0) continue;
      std::size_t able = 0;
      for (std::size_t a = 0; a < n; ++a) able += memory_.units[a * slot_count + s] != dense::absent;
      if (able >= memory_.bounds[s].lower) continue;
      if (blame_utility()) return false;
      refusal_.task = plan_.tasks()[s].task;
      return fail(no_plan_reason::task_short, able, plan_.tasks()[s].bounds);
    }
    return true;
  }

  bool every_agent_served(std::size_t n, std::size_t slot_count) {
    for (std::size_t a = 0; a < n; ++a) {
      auto const row = memory_.units.begin() + static_cast<std::ptrdiff_t>(a * slot_count);
      if (std::any_of(row, row + static_cast<std::ptrdiff_t>(slot_count), [](auto u) { return u != dense::absent; }))
        continue;
      if (blame_utility()) return false;
      refusal_.agent = problem_.participants[a];
      refusal_.why = no_plan_reason::agent_without_task;
      return false;
    }
    return true;
  }

  problem<V, Beliefs> const& problem_;
  plan<V, Beliefs> const& plan_;
  plan_memory& memory_;
  dense::buffer<std::int64_t>& row_;
  std::int64_t cost_ = 0;
  plan_refusal<V> refusal_{};
  std::optional<utility_refusal<V>> ignored_{};
  std::optional<utility_refusal<V>> pair_fault_{};
};

}  // namespace rota::detail
