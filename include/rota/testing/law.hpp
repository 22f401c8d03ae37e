#pragma once

#include <rota/core/assert.hpp>

#include <rapidcheck.h>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace rota::testing {

/// How often the cases of a law must be interesting. A law that holds on boring cases only has not been tested.
struct share {
  char const* what;  ///< as given to `interesting`
  int percent = 20;
};

/// A law as a value: what it is called, what it says, and a property that draws its inputs by name and refutes itself by
/// `same` or `holds`. The type it speaks of is erased here, once, so that all else is compiled once.
struct law {
  std::string name;
  std::string equation;
  std::function<void()> property;
  std::vector<share> reaches;
};

/// Laws under one name, each law once.
///
/// Invariant: no two laws have the same name. A parent's law that is there already, as the tops of a diamond are, comes in
/// once.
class bundle {
public:
  explicit bundle(char const* name) : name_(name) {}

  /// Adds what the parent has and this one has not. @pre laws of one name are one law: their equations are the same
  bundle& merge(bundle const& parent) {
    for (law const& l : parent.laws_) {
      auto const mine =
          std::find_if(laws_.begin(), laws_.end(), [&](law const& other) { return other.name == l.name; });
      ROTA_ASSERT(mine == laws_.end() || mine->equation == l.equation);
      if (mine == laws_.end()) laws_.push_back(l);
    }
    return *this;
  }
  /// Adds a law. @pre none here is called so
  bundle& add(char const* name, char const* equation, void (*property)(), std::initializer_list<share> reaches = {}) {
    return add_closure(name, equation, property, reaches);  // a std::function per law would be half the compile time
  }
  /// The same for a property that captures something.
  bundle& add_closure(char const* name, char const* equation, std::function<void()> property,
                      std::initializer_list<share> reaches = {}) {
    ROTA_ASSERT(!contains(name));
    laws_.push_back({name, equation, std::move(property), reaches});
    return *this;
  }

  [[nodiscard]] std::string const& name() const noexcept { return name_; }
  [[nodiscard]] std::vector<law> const& laws() const noexcept { return laws_; }
  [[nodiscard]] bool contains(std::string const& law_name) const {
    return std::any_of(laws_.begin(), laws_.end(), [&](law const& l) { return l.name == law_name; });
  }

private:
  std::string name_;
  std::vector<law> laws_;
};

/// Draws an input of the law that is being tested, as `rc::Arbitrary<T>` generates it. A counterexample shows it by this
/// name, shrunk.
template <class T>
[[nodiscard]] T draw(char const* name) {
  return *rc::gen::arbitrary<T>().as(name);
}

/// Counts this case as interesting. @pre the law lists it in `reaches`, or nobody looks
inline void interesting(bool yes, char const* what) {
  if (yes) rc::detail::ImplicitParam<rc::detail::param::CurrentPropertyContext>::value()->addTag(what);
}

/// Refutes the law that is being tested, by the drawn inputs.
[[noreturn]] inline void refute(std::string why) {
  throw rc::detail::CaseResult(rc::detail::CaseResult::Type::Failure, std::move(why));
}

/// Demands a condition, said in words.
inline void holds(bool condition, char const* what) {
  if (!condition) refute(std::string("not so: ") + what);
}

namespace detail {

[[noreturn]] inline void refute_equation(char const* left_name, std::string const& left, char const* right_name,
                                         std::string const& right) {
  refute(std::string(left_name) + " is " + left + "\n" + right_name + " is " + right);
}

}  // namespace detail

/// Demands that two sides of an equation are equal; otherwise shows both.
template <class T>
void same(char const* left_name, T const& left, char const* right_name, T const& right) {
  if (!(left == right)) detail::refute_equation(left_name, rc::toString(left), right_name, rc::toString(right));
}

}  // namespace rota::testing
