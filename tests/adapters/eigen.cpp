#include <gtest/gtest.h>

#include <rota/adapters/eigen.hpp>
#include <rota/algebra/apply.hpp>
#include <rota/core/atom.hpp>

#include <rapidcheck/gtest.h>

#include <array>
#include <map>
#include <vector>

namespace rota::test {
namespace eigen_test {

using V = runtime_vocabulary;
using atom = in<V>;

TEST(eigen, a_view_is_the_storage_row_by_row) {
  std::array<double, 6> storage{0, 1, 2, 3, 4, 5};
  auto const m = eigen::view(std::span<double>(storage), 2, 3);
  EXPECT_EQ(m.rows(), 2);
  EXPECT_EQ(m(1, 0), 3);
  eigen::view(std::span<double>(storage), 2, 3)(1, 2) = 7;
  EXPECT_EQ(storage[5], 7);
  auto const constant = eigen::view(std::span<double const>(storage), 3, 2);
  EXPECT_EQ(constant.row(2).sum(), 4 + 7);
}

TEST(eigen, a_matrix_is_an_additive_utility_and_back) {
  eigen::utility_matrix m(2, 3);
  m << 1, eigen::forbidden, 3, 4, 5, std::numeric_limits<double>::infinity();
  auto const u = eigen::to_utility<V>(m, {{20}, {10}}, {{3}, {1}, {2}});
  EXPECT_EQ(u({20}, {3}, {}), 1.0);
  EXPECT_EQ(u({20}, {1}, {}), std::nullopt) << "NaN forbids";
  EXPECT_EQ(u({20}, {2}, {}), 3.0);
  EXPECT_EQ(u({10}, {3}, {}), 4.0);
  EXPECT_EQ(u({10}, {2}, {}), std::numeric_limits<double>::infinity()) << "for the search to name";
  EXPECT_EQ(u({30}, {3}, {}), std::nullopt) << "a stranger";
  EXPECT_EQ(u({10}, {4}, {}), std::nullopt) << "a foreign task";

  std::vector<V::agent> const agents{{10}, {20}};
  std::vector<V::task> const tasks{{1}, {2}, {3}};
  auto const back = eigen::to_matrix<V, no_beliefs>(u, agents, tasks, {});
  EXPECT_EQ(back(0, 0), 5);
  EXPECT_EQ(back(0, 1), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(back(1, 0)));
  EXPECT_EQ(back(1, 2), 1);
}

TEST(eigen, a_matrix_is_assigned_whatever_its_storage_and_scalar) {
  Eigen::Matrix<float, 2, 3> costs;  // by columns
  costs << 4, 1, static_cast<float>(eigen::forbidden), 1, 9, 5;
  std::array<cardinality, 3> const bounds{{{0, 1}, {0, 1}, {0, 1}}};
  auto const best = eigen::assign(costs, bounds, {.minimise = true});
  ASSERT_TRUE(best);
  EXPECT_EQ(best->tasks, (std::vector<std::size_t>{1, 0}));
  EXPECT_EQ(best->total, 2);
  EXPECT_EQ(eigen::assign(costs, std::span(bounds).first(2)).error().reason, assign_fault::sizes_differ);
  EXPECT_EQ(eigen::assign(costs, bounds, {.forbidden = 9}).error(), (assign_refusal{assign_fault::not_a_number, 0, 2}));
}

/// Atoms of a small universe, numbered.
eigen::atom_index<atom> const& universe() {
  static eigen::atom_index<atom> const index = [] {
    atom_set<atom> all;
    for (std::uint64_t a = 1; a <= 3; ++a)
      for (std::uint64_t t = 1; t <= 3; ++t) all.insert({{a}, {1}, {t}});
    return eigen::atom_index<atom>(all);
  }();
  return index;
}

using rota_delta = rota::delta<atom>;

rota_delta delta_of(std::vector<int> const& counts) {
  rota_delta d;
  for (std::size_t i = 0; i < counts.size(); ++i)
    d += rota_delta(universe()[static_cast<Eigen::Index>(i) % universe().size()], counts[i] % 100);
  return d;
}

RC_GTEST_PROP(eigen, a_delta_and_its_vector_are_one, (std::vector<int> const& counts)) {
  auto const d = delta_of(counts);
  auto const v = eigen::to_vector(d, universe());
  RC_ASSERT(v.has_value());
  RC_ASSERT(v->size() == universe().size());
  RC_ASSERT(static_cast<std::size_t>(v->nonZeros()) == d.size());
  RC_ASSERT(eigen::to_delta(*v, universe()) == d);
}

RC_GTEST_PROP(eigen, the_vector_of_a_sum_is_the_sum_of_vectors,
              (std::vector<int> const& first, std::vector<int> const& second)) {
  auto const d = delta_of(first);
  auto const e = delta_of(second);
  eigen::sparse_vector<std::int64_t> const sum = *eigen::to_vector(d, universe()) + *eigen::to_vector(e, universe());
  RC_ASSERT(eigen::to_delta(sum, universe()) == d + e);
}

RC_GTEST_PROP(eigen, an_event_and_its_vector_are_one, (std::vector<int> const& counts)) {
  auto const e = clamp(delta_of(counts));
  auto const v = eigen::to_vector(e, universe());
  RC_ASSERT(v.has_value());
  auto const back = eigen::to_event(*v, universe());
  RC_ASSERT(back.has_value());
  RC_ASSERT(*back == e);
}

TEST(eigen, what_has_no_index_is_refused_with_its_witness) {
  atom const stranger{{9}, {1}, {1}};
  auto const v = eigen::to_vector(event<atom>::addition(stranger), universe());
  ASSERT_FALSE(v.has_value());
  EXPECT_EQ(v.error().witness, stranger);
}

TEST(eigen, a_vector_of_other_counts_is_no_event) {
  eigen::sparse_vector<std::int64_t> v(universe().size());
  v.insert(4) = 2;
  auto const e = eigen::to_event(v, universe());
  ASSERT_FALSE(e.has_value());
  EXPECT_EQ(e.error().witness, universe()[4]);
  EXPECT_EQ(universe()(universe()[4]), 4);
}

}  // namespace eigen_test
}  // namespace rota::test
