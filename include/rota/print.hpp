#pragma once
/// @file
/// `std::cout << value` for every value of this library that has words: names, atoms, sets, events, times, allocations,
/// refusals, reasons, messages, decisions. Never in the umbrella, since deciding needs no streams.

#include <rota/algebra/print.hpp>
#include <rota/allocation/print.hpp>
#include <rota/core/print.hpp>
#include <rota/dense/print.hpp>
#include <rota/model/print.hpp>
#include <rota/search/print.hpp>
#include <rota/team/print.hpp>

#include <concepts>
#include <ostream>
#include <string>
#include <type_traits>

namespace rota {

namespace detail {

// Qualified, so that only the functions of this library count: a type of yours that is made of ours prints as you say.
template <class T>
concept has_text = requires(T const& x) {
  { rota::to_string(x) } -> std::same_as<std::string>;
} || requires(T const& x) {
  { rota::dense::to_string(x) } -> std::same_as<std::string>;
};
template <class T>
concept has_sentence = requires(T const& x) {
  { rota::describe(x) } -> std::same_as<std::string>;
};

}  // namespace detail

/// A value of this library for which there is a `to_string` or a `describe`.
template <class T>
concept printable = (std::is_class_v<T> || std::is_enum_v<T>) && (detail::has_text<T> || detail::has_sentence<T>);

namespace detail {

/// By its `to_string`, yours before ours; else by its `describe`.
template <printable T>
[[nodiscard]] std::string printed(T const& x) {
  if constexpr (has_text<T>)
    return default_names{}(x);
  else
    return rota::describe(x);
}

}  // namespace detail

template <printable T>
std::ostream& operator<<(std::ostream& out, T const& x) {
  return out << detail::printed(x);
}

namespace dense {
using rota::operator<<;
}

}  // namespace rota
