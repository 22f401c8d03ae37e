#pragma once
/// @file
/// How rapidcheck shows the algebra's values in counterexamples: by their `to_string`. Found by argument-dependent
/// lookup.

#include <rota/algebra/print.hpp>
#include <rota/model/print.hpp>

#include <rapidcheck.h>

#include <ostream>
#include <string>

namespace rota {

namespace testing::detail {

/// Names as `default_names` prints them; for an atom of your own that it cannot print, as rapidcheck does.
struct shown_names {
  template <class T>
  [[nodiscard]] std::string operator()(T const& x) const {
    auto const name = default_names{}(x);
    return name == default_names::unknown ? rc::toString(x) : name;
  }
};

template <class T>
concept has_text = requires(T const& x) { rota::to_string(x, shown_names{}); };

}  // namespace testing::detail

template <testing::detail::has_text T>
void showValue(T const& x, std::ostream& out) {
  out << to_string(x, testing::detail::shown_names{});
}
template <class Tag, class Rep>
void showValue(strong_id<Tag, Rep> const& id, std::ostream& out) {
  out << testing::detail::shown_names{}(id.value);
}
inline void showValue(fingerprint h, std::ostream& out) { out << to_string(h); }

}  // namespace rota
