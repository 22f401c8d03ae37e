#pragma once

#include <gtest/gtest.h>

#include <rota/testing/apply_laws.hpp>
#include <rota/testing/check.hpp>
#include <rota/testing/cycle_laws.hpp>
#include <rota/testing/event_laws.hpp>
#include <rota/testing/groupoid_laws.hpp>
#include <rota/testing/structure_laws.hpp>

#include <source_location>
#include <string>
#include <type_traits>

namespace rota::testing {

/// The laws of the strongest structure that T claims. If T is an `allocation_event` or its structure has `signs`, also
/// those of allocation events; if these act on sets, those of apply and of runs; if there is an `is_cycle`, those of
/// Def. 5.
template <class T>
[[nodiscard]] bundle laws_of() {
  if constexpr (groupoid<T>) {
    static_assert(
        !magma<T>,
        "a structure either composes arrows or combines elements: this one does both, so its laws are unclear");
    return groupoid_laws<T>();
  } else if constexpr (allocation_event<T> || requires(T const& x) { structure<T>::signs(x); }) {
    auto laws = bundle("allocation_event").merge(structure_laws<T>()).merge(allocation_event_laws<T>());
    if constexpr (requires { typename structure<T>::set_type; }) {
      static_assert(acts_on_sets<T, structure<T>>, "a structure with a set_type says how events act on these sets");
      laws.merge(apply_laws<T>()).merge(apply_theorems<T>()).merge(run_laws<T>());
    }
    if constexpr (detail::knows_cycles<T, structure<T>>) laws.merge(cycle_laws<T>()).merge(cycle_theorems<T>());
    return laws;
  } else {
    return structure_laws<T>();
  }
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

/// Makes each law of the bundle a GoogleTest test of its own, called `subject.bundle.law`. Call it before
/// `RUN_ALL_TESTS`, for example to initialise a variable. @return true
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
/// The same for all laws that T claims, or those of G acting on X.
template <class... T>
bool register_laws(std::string const& subject, std::source_location where = std::source_location::current()) {
  return register_laws(subject, laws_of<T...>(), where);
}

}  // namespace rota::testing
