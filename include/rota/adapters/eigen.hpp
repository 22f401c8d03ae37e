#pragma once
/// @file
/// Eigen matrices as utilities and for `assign`; events and deltas as sparse vectors over numbered atoms.

#include <rota/algebra/delta.hpp>
#include <rota/algebra/event.hpp>
#include <rota/core/result.hpp>
#include <rota/model/plan.hpp>
#include <rota/search/assign.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace rota::eigen {

/// Utilities of agents (rows) on tasks (columns), row-major. NaN forbids the pair.
using utility_matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The entry of a forbidden pair in a `utility_matrix`.
inline constexpr double forbidden = std::numeric_limits<double>::quiet_NaN();

/// Views dense row-major storage as an agents × tasks matrix. Copies nothing.
///
/// @pre `storage.size() == agents * tasks`, and the storage outlives the view
[[nodiscard]] inline Eigen::Map<utility_matrix const> view(std::span<double const> storage, std::size_t agents,
                                                           std::size_t tasks) {
  ROTA_ASSERT(storage.size() == agents * tasks);
  return {storage.data(), static_cast<Eigen::Index>(agents), static_cast<Eigen::Index>(tasks)};
}
[[nodiscard]] inline Eigen::Map<utility_matrix> view(std::span<double> storage, std::size_t agents, std::size_t tasks) {
  ROTA_ASSERT(storage.size() == agents * tasks);
  return {storage.data(), static_cast<Eigen::Index>(agents), static_cast<Eigen::Index>(tasks)};
}

/// The matrix of a utility for these agents and tasks. Forbidden pairs are NaN. O(a·t) calls.
template <vocabulary V, class Beliefs>
[[nodiscard]] utility_matrix to_matrix(additive_utility<V, Beliefs> const& u, std::span<typename V::agent const> agents,
                                       std::span<typename V::task const> tasks, Beliefs const& beliefs) {
  utility_matrix m(static_cast<Eigen::Index>(agents.size()), static_cast<Eigen::Index>(tasks.size()));
  for (std::size_t i = 0; i < agents.size(); ++i)
    for (std::size_t k = 0; k < tasks.size(); ++k)
      m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          u(agents[i], tasks[k], beliefs).value_or(forbidden);
  return m;
}

/// The additive utility that a matrix holds. NaN entries are forbidden, and so are agents and tasks that are not in it. An
/// infinite entry is passed on: whoever counts it reports it.
///
/// @param agents, tasks the agents of the rows and the tasks of the columns, in any order, each once
/// @pre as many agents as rows, as many tasks as columns
template <vocabulary V, class Beliefs = no_beliefs, class Derived>
[[nodiscard]] additive_utility<V, Beliefs> to_utility(Eigen::MatrixBase<Derived> const& matrix,
                                                      std::vector<typename V::agent> agents,
                                                      std::vector<typename V::task> tasks) {
  ROTA_ASSERT(static_cast<std::size_t>(matrix.rows()) == agents.size());
  ROTA_ASSERT(static_cast<std::size_t>(matrix.cols()) == tasks.size());
  auto const numbered = [](auto const& names) {
    std::vector<std::pair<typename std::remove_cvref_t<decltype(names)>::value_type, Eigen::Index>> out;
    for (std::size_t i = 0; i < names.size(); ++i) out.emplace_back(names[i], static_cast<Eigen::Index>(i));
    std::sort(out.begin(), out.end());
    return out;
  };
  struct table {
    utility_matrix values;
    std::vector<std::pair<typename V::agent, Eigen::Index>> rows;
    std::vector<std::pair<typename V::task, Eigen::Index>> columns;
  };
  auto const t =
      std::make_shared<table const>(table{matrix.template cast<double>(), numbered(agents), numbered(tasks)});
  return [t](typename V::agent a, typename V::task task, Beliefs const&) -> std::optional<double> {
    auto const find = [](auto const& names, auto key) -> std::optional<Eigen::Index> {
      auto const at = std::lower_bound(names.begin(), names.end(), key,
                                       [](auto const& entry, auto const& k) { return entry.first < k; });
      if (at == names.end() || at->first != key) return std::nullopt;
      return at->second;
    };
    auto const row = find(t->rows, a);
    auto const column = find(t->columns, task);
    if (!row || !column || rota::detail::is_nan(t->values(*row, *column))) return std::nullopt;
    return t->values(*row, *column);
  };
}

/// The best assignment of the agents of the rows to the tasks of the columns, see `rota::assign`. NaN forbids a pair, unless
/// the options name another number.
template <class Derived>
[[nodiscard]] result<assignment, assign_refusal>
assign(Eigen::MatrixBase<Derived> const& matrix, std::span<cardinality const> bounds, assign_options options = {}) {
  if (static_cast<std::size_t>(matrix.cols()) != bounds.size())
    return refused{assign_refusal{assign_fault::sizes_differ, 0, 0}};
  if (!options.forbidden) options.forbidden = forbidden;
  utility_matrix const rows = matrix.template cast<double>();
  return rota::assign(std::span(rows.data(), static_cast<std::size_t>(rows.size())), bounds, options);
}

/// Numbers finitely many atoms from 0 to size() − 1: the coordinates of a sparse vector.
///
/// Class invariant: the order of indices is the order of atoms.
template <ordered_atom Atom>
class atom_index {
public:
  explicit atom_index(atom_set<Atom> atoms) : atoms_(std::move(atoms)) {}

  [[nodiscard]] Eigen::Index size() const noexcept { return static_cast<Eigen::Index>(atoms_.size()); }
  /// @pre 0 ≤ i < size()
  [[nodiscard]] Atom const& operator[](Eigen::Index i) const noexcept {
    ROTA_ASSERT(i >= 0 && i < size());
    return atoms_.begin()[i];
  }
  /// O(log n).
  [[nodiscard]] std::optional<Eigen::Index> operator()(Atom const& x) const {
    auto const at = std::lower_bound(atoms_.begin(), atoms_.end(), x);
    if (at == atoms_.end() || !(*at == x)) return std::nullopt;
    return at - atoms_.begin();
  }

private:
  atom_set<Atom> atoms_;
};

/// Refusal: an atom without an index.
template <ordered_atom Atom>
struct unnumbered {
  Atom witness{};
  friend bool operator==(unnumbered const&, unnumbered const&) = default;
};

/// An element of ℤ^n, or of {−1, 0, +1}^n.
template <class Scalar>
using sparse_vector = Eigen::SparseVector<Scalar>;

/// δ as a sparse vector. The vector of a sum is the sum of the vectors. O(|δ| log n).
template <ordered_atom Atom, class Coefficient>
[[nodiscard]] result<sparse_vector<Coefficient>, unnumbered<Atom>> to_vector(delta<Atom, Coefficient> const& d,
                                                                             atom_index<Atom> const& index) {
  sparse_vector<Coefficient> v(index.size());
  v.reserve(static_cast<Eigen::Index>(d.size()));
  for (auto const& x : d) {
    auto const i = index(x.atom);
    if (!i) return refused{unnumbered<Atom>{x.atom}};
    v.insertBack(*i) = x.count;
  }
  return v;
}

/// e as a sparse vector of signs. Sums of such vectors are deltas, not events: `clamp` them. O(|e| log n).
template <ordered_atom Atom>
[[nodiscard]] result<sparse_vector<std::int64_t>, unnumbered<Atom>> to_vector(event<Atom> const& e,
                                                                              atom_index<Atom> const& index) {
  return to_vector(delta<Atom>(e), index);
}

/// The delta with these coordinates. O(k²) for k nonzeros. @pre `v.size() == index.size()`
template <ordered_atom Atom, class Coefficient>
[[nodiscard]] delta<Atom, Coefficient> to_delta(sparse_vector<Coefficient> const& v, atom_index<Atom> const& index) {
  ROTA_ASSERT(v.size() == index.size());
  delta<Atom, Coefficient> d;
  for (typename sparse_vector<Coefficient>::InnerIterator x(v); x; ++x)
    d += delta<Atom, Coefficient>(index[x.index()], x.value());
  return d;
}

/// The event with these signs, or the least atom whose coordinate is none of −1, 0, +1.
template <ordered_atom Atom, class Coefficient>
[[nodiscard]] result<event<Atom>, unnumbered<Atom>> to_event(sparse_vector<Coefficient> const& v,
                                                             atom_index<Atom> const& index) {
  auto const d = to_delta(v, index);
  for (auto const& x : d)
    if (x.count != Coefficient{1} && x.count != Coefficient{-1}) return refused{unnumbered<Atom>{x.atom}};
  return clamp(d);
}

}  // namespace rota::eigen
