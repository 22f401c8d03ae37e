#pragma once

#include <rota/allocation/utility.hpp>
#include <rota/core/small_vector.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace rota {

/// The conditions that a valid allocation meets. Those with numbers are of Def. 1.
enum class clause : unsigned char {
  one_plan,        ///< (0) every atom names the same plan p, and p belongs to the plan type
  foreign_task,    ///< every atom of p names a task of p
  stranger,        ///< the agent of every atom of p belongs to the team and takes part
  role,            ///< no role forbids its agent the task
  cardinality,     ///< (1)–(3) n₁ ≤ |A| ≤ n₂ for every task of p; atoms of other plans do not count
  one_task,        ///< (4) an agent has one task and one state in p
  precondition,    ///< (5) Pre(p)
  utility,         ///< (6) U_p ≥ 0, and it is a number
  forbidden_pair,  ///< (6) the additive utility forbids no pair, or U_p would not be defined
  team_size,       ///< the plan limits how many agents have a task
  idle_forbidden   ///< every participant has a task, if the problem forbids idling
};

/// Whether the team adopts the plan or executes it already. A precondition that is `precondition_scope::entry_only` is
/// checked only when the team adopts the plan.
enum class plan_phase : bool { entering, running };

/// One violated clause and its witness. Fields that the clause does not use keep their default.
template <vocabulary V = runtime_vocabulary>
struct violation {
  clause what{};
  typename V::plan plan{};          ///< the plan p that the allocation was judged against
  bool about_atom = false;          ///< true: `atom` is the witness; false: the whole allocation is
  in<V> atom{};                     ///< 0, foreign_task, stranger, role, 4, forbidden_pair, 6 (a term's fault)
  in<V> other{};                    ///< 4: the agent's second atom; may differ in state only. 6: of a pair
  bool about_pair = false;          ///< 6: true: `atom` and `other` together are the witness
  typename V::state state{};        ///< 4: state of `atom`, where states were given
  typename V::state other_state{};  ///< 4: state of `other`, where states were given
  typename V::agent agent{};        ///< idle_forbidden; and the agent of `atom`
  typename V::task task{};          ///< cardinality; and the task of `atom`
  std::size_t count = 0;            ///< cardinality, team_size: how many agents there are
  cardinality bounds{};             ///< cardinality, team_size: how many there may be
  utility_fault fault{};            ///< 5: none or threw; 6: negative, or why U_p is not defined
  double value = 0;                 ///< 6: U_p, if negative

  friend bool operator==(violation const&, violation const&) = default;
};

/// Every violation of an allocation, in the order of `clause` (those of (6) together), then ascending by atom, task or
/// agent.
template <vocabulary V = runtime_vocabulary>
class validity_report {
public:
  using value_type = violation<V>;
  using const_iterator = violation<V> const*;

  [[nodiscard]] constexpr bool valid() const noexcept { return found_.empty(); }
  constexpr explicit operator bool() const noexcept { return valid(); }
  /// The plan that the allocation is valid for. Where C = ∅ was judged against a plan type, the least such plan.
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

/// The clauses that one atom violates by itself, as bits.
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

/// A violation by one atom.
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
    while (x != end && (x->agent < a || (x->agent == a && x->plan != p.id()))) ++x;
    if (x != end && x->agent == a) continue;
    violation<V> v;
    v.what = clause::idle_forbidden;
    v.plan = p.id();
    v.agent = a;
    sink(v);
  }
}

/// Clauses (5) and (6) on the atoms that the user's functions may be called for. @return U_p, if it is defined
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
  auto const total = value<V, Beliefs>(problem, p, atoms, [&](utility_refusal<V> const& r) {
    if (!r.atom) return report(clause::utility, r.reason, 0);
    auto const c = r.reason == utility_fault::forbidden_pair ? clause::forbidden_pair : clause::utility;
    auto v = at<V>(c, p.id(), *r.atom);
    v.fault = r.reason;
    if (r.other) v.other = *r.other, v.about_pair = true;
    sink(v);
  });
  if (total && total->units < 0) report(clause::utility, utility_fault::negative, to_double(*total));
  return total;
}

/// Judges C against p by every clause of section 3, except (4) on states. `sink` gets each violation.
///
/// @return U_p if it is defined, even if other clauses are violated
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

/// Whether C is valid for p under the beliefs, and every clause that it violates. Def. 1 and section 3 of docs/algebra.md.
///
/// Pre(p) and U_p are evaluated on the atoms of C that name a task of p and a participant: the user's functions are called
/// for no others. After a forbidden pair or a faulty term U_p is not defined, so its sign is not judged.
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

/// As above, for atoms with states: an agent with two states violates clause (4), too.
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

/// Whether C is valid for some plan of the type. Finds the plan itself.
///
/// A non-empty C is judged against the least plan of the type that occurs in it. If none does, every atom violates clause
/// (0). C = ∅ names no plan: it is valid iff it is valid for at least one plan; otherwise the report has the violations of
/// every plan.
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
