#pragma once

#include <rota/allocation/utility.hpp>
#include <rota/core/small_vector.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace rota {

/// What an allocation can violate. (Numbers: Def. 1; the others are stated beside it.)
enum class clause : unsigned char {
  one_plan,        ///< (0) every atom names the one plan p, and p belongs to the plan type
  foreign_task,    ///< an atom of p names a task that is not in Tasks(p)
  stranger,        ///< the agent of an atom of p takes no part, or belongs to no team
  role,            ///< the agent's role forbids the task
  cardinality,     ///< (1)–(3) n₁ ≤ |A| ≤ n₂ for every task of p, counting p's atoms only
  one_task,        ///< (4) an agent has one task and one state in p
  precondition,    ///< (5) Pre(p)
  utility,         ///< (6) U_p ≥ 0, and it is a number
  forbidden_pair,  ///< (6) the additive utility forbids the pair, so U_p is not defined
  team_size,       ///< the plan's own limits on the number of agents that have a task
  idle_forbidden   ///< a participant has no task though the problem forbids idling
};

/// Whether the team adopts the plan or is already executing it: `precondition_scope::entry_only` asks Pre(p) only of the
/// former.
enum class plan_phase : bool { entering, running };

/// One violated clause and its witness. Fields a clause does not mention keep their default.
template <vocabulary V = runtime_vocabulary>
struct violation {
  clause what{};
  typename V::plan plan{};          ///< the plan p against which the judgement was made
  bool about_atom = false;          ///< whether `atom` is the witness, or the whole allocation is
  in<V> atom{};                     ///< 0, foreign_task, stranger, role, 4, forbidden_pair, 6 (a term's fault)
  in<V> other{};                    ///< 4: the agent's second atom; may differ in state only. 6: of a pair
  bool about_pair = false;          ///< 6: whether `atom` and `other` together are the witness
  typename V::state state{};        ///< 4: state of `atom`, where states were given
  typename V::state other_state{};  ///< 4: state of `other`, where states were given
  typename V::agent agent{};        ///< idle_forbidden; and the agent of `atom`
  typename V::task task{};          ///< cardinality; and the task of `atom`
  std::size_t count = 0;            ///< cardinality, team_size: how many agents there are
  cardinality bounds{};             ///< cardinality, team_size: how many there may be
  utility_fault fault{};            ///< 5: none or threw; 6: negative, or why U_p is not a number
  double value = 0;                 ///< 6: U_p, if negative

  friend bool operator==(violation const&, violation const&) = default;
};

/// Every violation of an allocation, in the order of `clause` (those of (6) together), then ascending by atom, task or
/// agent. Regular.
template <vocabulary V = runtime_vocabulary>
class validity_report {
public:
  using value_type = violation<V>;
  using const_iterator = violation<V> const*;

  [[nodiscard]] constexpr bool valid() const noexcept { return found_.empty(); }
  constexpr explicit operator bool() const noexcept { return valid(); }
  /// The plan the allocation is valid for; for a judgement on the type with C = ∅, the least such plan.
  [[nodiscard]] constexpr std::optional<typename V::plan> plan() const noexcept { return plan_; }
  [[nodiscard]] constexpr const_iterator begin() const noexcept { return found_.begin(); }
  [[nodiscard]] constexpr const_iterator end() const noexcept { return found_.end(); }
  [[nodiscard]] constexpr std::size_t size() const noexcept { return found_.size(); }
  [[nodiscard]] constexpr bool violates(clause c) const noexcept {
    for (auto const& v : found_)
      if (v.what == c) return true;
    return false;
  }

  constexpr void add(violation<V> const& v) {
    found_.push_back(v);
    plan_.reset();
  }
  /// @pre valid()
  constexpr void accept(typename V::plan p) {
    ROTA_ASSERT(valid());
    plan_ = p;
  }

  friend bool operator==(validity_report const&, validity_report const&) = default;

private:
  small_vector<violation<V>, 1> found_;
  std::optional<typename V::plan> plan_;
};

namespace detail {

/// What is wrong with one atom by itself; the bits are clauses.
template <vocabulary V, class Beliefs>
[[nodiscard]] unsigned faults_of(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p, in<V> const& x) {
  auto bit = [](clause c) { return 1u << static_cast<unsigned>(c); };
  if (x.plan != p.id()) return bit(clause::one_plan);
  bool const foreign = p.find(x.task) == nullptr;
  auto const* r = problem.members.role_of(x.agent);
  bool const here =
      r != nullptr && std::binary_search(problem.participants.begin(), problem.participants.end(), x.agent);
  return (foreign ? bit(clause::foreign_task) : 0u) | (here ? 0u : bit(clause::stranger)) |
         (r != nullptr && !foreign && !r->permits(x.task) ? bit(clause::role) : 0u);
}

/// A violation made of one atom.
template <vocabulary V>
[[nodiscard]] constexpr violation<V> at(clause c, typename V::plan p, in<V> const& x) {
  violation<V> v;
  v.what = c;
  v.plan = p;
  v.about_atom = true;
  v.atom = x;
  v.agent = x.agent;
  v.task = x.task;
  return v;
}

/// Clauses (1)–(3).
template <vocabulary V, class Beliefs, class Sink>
void judge_counts(plan<V, Beliefs> const& p, std::span<in<V> const> atoms, Sink& sink) {
  for (plan_task<V> const& t : p.tasks()) {
    std::size_t count = 0;
    for (in<V> const& x : atoms) count += x.plan == p.id() && x.task == t.task;
    if (t.bounds.admits(count)) continue;
    violation<V> v;
    v.what = clause::cardinality;
    v.plan = p.id();
    v.task = t.task;
    v.count = count;
    v.bounds = t.bounds;
    sink(v);
  }
}

/// Team size and idling.
template <vocabulary V, class Beliefs, class Sink>
void judge_team(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p, std::span<in<V> const> atoms,
                Sink& sink) {
  std::size_t employed = 0;
  in<V> const* last = nullptr;
  for (in<V> const& x : atoms) {
    if (x.plan != p.id()) continue;
    employed += last == nullptr || last->agent != x.agent;
    last = &x;
  }
  if (!p.team_size().admits(employed)) {
    violation<V> v;
    v.what = clause::team_size;
    v.plan = p.id();
    v.count = employed;
    v.bounds = p.team_size();
    sink(v);
  }
  if (problem.idle == idling::allowed) return;
  auto const* x = atoms.data();
  auto const* const end = x + atoms.size();
  for (typename V::agent const a : problem.participants) {
    while (x != end && (a > x->agent || (x->agent == a && x->plan != p.id()))) ++x;
    if (x != end && x->agent == a) continue;
    violation<V> v;
    v.what = clause::idle_forbidden;
    v.plan = p.id();
    v.agent = a;
    sink(v);
  }
}

/// Clauses (5) and (6) on the atoms that the user's functions may be asked about; U_p where it is defined.
template <vocabulary V, class Beliefs, class Sink>
std::optional<fixed_utility> judge_functions(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p,
                                             std::span<in<V> const> atoms, plan_phase phase, Sink& sink) {
  auto report = [&](clause c, utility_fault fault, double value) {
    violation<V> v;
    v.what = c;
    v.plan = p.id();
    v.fault = fault;
    v.value = value;
    sink(v);
  };
  if (p.precondition() && !(phase == plan_phase::running && p.scope() == precondition_scope::entry_only)) {
    auto const holds = guarded([&] { return p.precondition()(problem.beliefs, atoms); });
    if (!holds || !*holds) report(clause::precondition, holds ? utility_fault::none : utility_fault::threw, 0);
  }
  auto const total = value<V, Beliefs>(problem, p, atoms, [&](utility_refusal<V> const& why) {
    if (!why.atom) return report(clause::utility, why.why, 0);
    auto const c = why.why == utility_fault::forbidden_pair ? clause::forbidden_pair : clause::utility;
    auto v = at<V>(c, p.id(), *why.atom);
    v.fault = why.why;
    if (why.other) v.other = *why.other, v.about_pair = true;
    sink(v);
  });
  if (total && total->units < 0) report(clause::utility, utility_fault::negative, to_double(*total));
  return total;
}

/// Every clause of section 3 on C relative to p but (4) on states. `sink` takes each violation.
///
/// @return U_p where it is defined, whatever else is violated
template <vocabulary V, class Beliefs, class Sink>
std::optional<fixed_utility> judge(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p,
                                   std::span<in<V> const> atoms, plan_phase phase, Sink&& sink) {
  unsigned faults = 0;
  for (in<V> const& x : atoms) faults |= faults_of(problem, p, x);
  for (clause const c : {clause::one_plan, clause::foreign_task, clause::stranger, clause::role})
    if ((faults >> static_cast<unsigned>(c) & 1u) != 0)
      for (in<V> const& x : atoms)
        if ((faults_of(problem, p, x) >> static_cast<unsigned>(c) & 1u) != 0) sink(at<V>(c, p.id(), x));
  judge_counts(p, atoms, sink);
  in<V> const* last = nullptr;
  for (in<V> const& x : atoms) {
    if (x.plan != p.id()) continue;
    if (last != nullptr && last->agent == x.agent) {
      auto v = at<V>(clause::one_task, p.id(), *last);
      v.other = x;
      sink(v);
    }
    last = &x;
  }
  auto askable = [](unsigned f) { return (f & ~(1u << static_cast<unsigned>(clause::role))) == 0; };
  std::optional<fixed_utility> total;
  if (askable(faults)) {
    total = judge_functions(problem, p, atoms, phase, sink);
  } else {
    small_vector<in<V>, 8> known;
    for (in<V> const& x : atoms)
      if (askable(faults_of(problem, p, x))) known.push_back(x);
    total = judge_functions<V, Beliefs>(problem, p, {known.data(), known.size()}, phase, sink);
  }
  judge_team(problem, p, atoms, sink);
  return total;
}

}  // namespace detail

/// Whether C is valid for p wrt. the beliefs, with every violated clause. Def. 1 and section 3 of docs/algebra.md.
///
/// Pre(p) and U_p are read on C restricted to p's tasks and to participants, since a user's function is never asked
/// about anything else; a forbidden pair or a faulty term leaves U_p undefined, so no total is judged then.
/// Complexity: O(|C| (t + log n)) and the calls of the user's functions. Allocates only to report, or for |C| > 8.
template <vocabulary V, class Beliefs>
[[nodiscard]] validity_report<V> validate(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p,
                                          allocation_atoms<V> const& atoms, plan_phase phase = plan_phase::entering) {
  validity_report<V> report;
  if (problem.type.find(p.id()) == nullptr) {
    violation<V> v;
    v.plan = p.id();
    report.add(v);
  }
  detail::judge(problem, p, atoms.atoms(), phase, [&](violation<V> const& v) { report.add(v); });
  if (report.valid()) report.accept(p.id());
  return report;
}

/// As above over atoms with states: clause (4) also refuses an agent with two states.
template <vocabulary V, class Beliefs>
[[nodiscard]] validity_report<V> validate(problem<V, Beliefs> const& problem, plan<V, Beliefs> const& p,
                                          atom_set<in_state<V>> const& atoms, plan_phase phase = plan_phase::entering) {
  allocation_atoms<V> projected;
  for (in_state<V> const& x : atoms) projected.insert(project(x));
  auto const plain = validate(problem, p, projected, phase);
  validity_report<V> report;
  auto add_states = [&] {
    in_state<V> const* last = nullptr;
    for (in_state<V> const& x : atoms) {
      if (x.plan != p.id()) continue;
      if (last != nullptr && last->agent == x.agent) {
        auto v = detail::at<V>(clause::one_task, p.id(), project(*last));
        v.other = project(x);
        v.state = last->state;
        v.other_state = x.state;
        report.add(v);
      }
      last = &x;
    }
  };
  bool added = false;
  for (violation<V> const& v : plain) {
    if (!added && v.what >= clause::one_task) added = true, add_states();
    if (v.what != clause::one_task) report.add(v);
  }
  if (!added) add_states();
  if (report.valid()) report.accept(p.id());
  return report;
}

/// Whether C is valid for some plan of the type: a judgement that finds p itself.
///
/// A non-empty C is judged against the least plan of the type that occurs in it, and against none (clause (0) at every
/// atom) if none does. C = ∅ names no plan: it is valid iff it is valid for at least one plan; if for none, the report
/// lists what every plan says.
template <vocabulary V, class Beliefs, class Atom>
  requires std::same_as<Atom, in<V>> || std::same_as<Atom, in_state<V>>
[[nodiscard]] validity_report<V> validate(problem<V, Beliefs> const& problem, atom_set<Atom> const& atoms,
                                          plan_phase phase = plan_phase::entering) {
  validity_report<V> all;
  for (plan<V, Beliefs> const& p : problem.type.plans()) {
    bool occurs = atoms.empty();
    for (Atom const& x : atoms) occurs |= x.plan == p.id();
    if (!occurs) continue;
    auto report = validate(problem, p, atoms, phase);
    if (report.valid() || !atoms.empty()) return report;
    for (auto const& v : report) all.add(v);
  }
  for (Atom const& x : atoms) all.add(detail::at<V>(clause::one_plan, x.plan, in<V>{x.agent, x.plan, x.task}));
  return all;
}

}  // namespace rota
