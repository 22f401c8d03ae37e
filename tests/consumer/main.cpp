#include <rota/rota.hpp>

#if __cplusplus < 202002L
#error "linking rota::rota must ask for C++20"
#endif

#ifdef WITH_COMPONENTS
#include <rota/adapters/alica.hpp>
#include <rota/adapters/eigen.hpp>
#include <rota/sim/evaluation.hpp>
#include <rota/testing/arbitrary.hpp>
#include <rota/testing/gtest.hpp>

auto const laws = rota::testing::register_laws<rota::fingerprint>("fingerprint");
#endif

int main() {
  rota::atom_set<rota::in<>> const before, after{{{1}, {2}, {3}}};
  auto const e = rota::difference(before, after);
  bool ok = rota::compose(e, inverse(e)).empty();
#ifdef WITH_COMPONENTS
  // What links against the packages of the components: pugixml, nlohmann-json, Eigen, Boost, rapidcheck.
  ok = ok && !rota::alica::load(std::filesystem::path("no such file")).diagnostics.empty();
  ::testing::InitGoogleTest();
  ok = ok && RUN_ALL_TESTS() == 0;
  auto const each = static_cast<int>(rota::testing::laws_of<rota::fingerprint>().laws().size());
  ok = ok && each > 0 && ::testing::UnitTest::GetInstance()->successful_test_count() == each;
  ok = ok && rota::sim::all_scenarios.size() == 5;
#endif
  return ok ? 0 : 1;
}
