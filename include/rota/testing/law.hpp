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

/// How many of the cases of a law must be interesting. A law that was tried on dull cases only has not been tested.
struct share {
  char const* what;  ///< as given to `interesting`
  int percent = 20;
};

/// A law as a value: its name, its equation, and a property that draws its inputs by name and fails by `same` or
/// `holds`. The type that the law is about is erased here, so that everything else is compiled once.
struct law {
  std::string name;
  std::string equation;
  std::function<void()> property;
  std::vector<share> reaches;
};

/// Laws under one name.
///
/// Class invariant: no two laws have the same name. A law that arrives by two parents is there once.
class bundle {
public:
  explicit bundle(char const* name) : name_(name) {}

  /// Adds the laws of the parent that are not here yet. @pre laws of the same name have the same equation
  bundle& merge(bundle const& parent) {
    for (law const& l : parent.laws_) {
      auto const mine =
          std::find_if(laws_.begin(), laws_.end(), [&](law const& other) { return other.name == l.name; });
      ROTA_ASSERT(mine == laws_.end() || mine->equation == l.equation);
      if (mine == laws_.end()) laws_.push_back(l);
    }
    return *this;
  }
  /// Adds a law. @pre no law here has this name
  bundle& add(char const* name, char const* equation, void (*property)(), std::initializer_list<share> reaches = {}) {
    return add_closure(name, equation, property, reaches);  // a std::function per law would be half the compile time
  }
  /// The same for a property with captures.
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

/// Draws an input of the law that is being tested, from `rc::Arbitrary<T>`. A counterexample shows it, shrunk, by this
/// name.
template <class T>
[[nodiscard]] T draw(char const* name) {
  return *rc::gen::arbitrary<T>().as(name);
}

/// Counts this case as interesting if `yes`. @pre the law lists `what` in `reaches`, else it is counted for nobody
inline void interesting(bool yes, char const* what) {
  if (yes) rc::detail::ImplicitParam<rc::detail::param::CurrentPropertyContext>::value()->addTag(what);
}

/// Fails the law that is being tested: the drawn inputs refute it.
[[noreturn]] inline void refute(std::string why) {
  throw rc::detail::CaseResult(rc::detail::CaseResult::Type::Failure, std::move(why));
}

/// Fails unless the condition holds; `what` says it in words.
inline void holds(bool condition, char const* what) {
  if (!condition) refute(std::string("not so: ") + what);
}

namespace detail {

[[noreturn]] inline void refute_equation(char const* left_name, std::string const& left, char const* right_name,
                                         std::string const& right) {
  refute(std::string(left_name) + " is " + left + "\n" + right_name + " is " + right);
}

}  // namespace detail

/// Fails unless the two sides of an equation are equal, and shows both.
template <class T>
void same(char const* left_name, T const& left, char const* right_name, T const& right) {
  if (!(left == right)) detail::refute_equation(left_name, rc::toString(left), right_name, rc::toString(right));
}

}  // namespace rota::testing
