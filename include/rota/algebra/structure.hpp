#pragma once

#include <concepts>

namespace rota {

/// How a type is an algebraic structure: its operations, and the laws it claims. Opting in is explicit: nothing has a
/// structure until this is specialised, because no compiler can see a law in a signature.
///
/// A specialisation for T gives what its structure has:
/// * `static T combine(T const&, T const&)`: the operation;
/// * `static T identity()`;
/// * `static T inverse(T const&)`;
/// * `static constexpr bool associative`, `commutative`: claims, which `rota/testing/` puts to the test.
template <class T>
struct structure;

namespace detail {

template <class T>
concept claims_associative = requires { requires structure<T>::associative; };
template <class T>
concept claims_commutative = requires { requires structure<T>::commutative; };

}  // namespace detail

}  // namespace rota
