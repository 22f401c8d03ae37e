#pragma once

#include <gtest/gtest.h>

#include <rota/testing/check.hpp>
#include <rota/testing/event_laws.hpp>
#include <rota/testing/groupoid_laws.hpp>
#include <rota/testing/structure_laws.hpp>

#include <source_location>
#include <string>
#include <type_traits>

namespace rota::testing {

/// The laws of the strongest structure that T has and claims; and those of allocation events, if it also has `signs`.
template <class T>
[[nodiscard]] bundle laws_of() {
  if constexpr (groupoid<T>)
    return groupoid_laws<T>();
  else if constexpr (requires(T const& x) { structure<T>::signs(x); })
    return bundle("allocation_event").merge(structure_laws<T>()).merge(allocation_event_laws<T>());
  else
    return structure_laws<T>();
}
/// The laws of G acting on X.
template <class G, class X>
[[nodiscard]] bundle laws_of() {
  static_assert(group_action<G, X>, "specialise rota::action<G, X> first, for a group G");
  return group_action_laws<G, X>();
}

namespace detail {

class law_test final : public ::testing::Test {
public:
  law_test(law l, std::string called) : law_(std::move(l)), called_(std::move(called)) {}

private:
  void TestBody() override {
    if (auto const why = refutation(law_, called_)) FAIL() << *why;
  }
  law law_;
  std::string called_;
};

}  // namespace detail

/// Makes each law of the bundle a GoogleTest test of its own, called `subject.bundle.law`. To be called before
/// `RUN_ALL_TESTS`, for example to initialise a variable; true.
inline bool register_laws(std::string const& subject, bundle const& b,
                          std::source_location where = std::source_location::current()) {
  for (law const& l : b.laws()) {
    auto const test = b.name() + "." + l.name;
    ::testing::RegisterTest(
        subject.c_str(), test.c_str(), nullptr, nullptr, where.file_name(), static_cast<int>(where.line()),
        [l, called = subject + "." + test]() -> ::testing::Test* { return new detail::law_test(l, called); });
  }
  return true;
}
/// All laws that T claims, or those of G acting on X, as tests.
template <class... T>
bool register_laws(std::string const& subject, std::source_location where = std::source_location::current()) {
  return register_laws(subject, laws_of<T...>(), where);
}

}  // namespace rota::testing
