#pragma once
/// @file
/// The laws of deltas beyond those of a group: how events embed into them, and that they are free. Each bundle takes a
/// model M that names the functions. The models here name the library's own.

#include <rota/testing/arbitrary.hpp>

#include <cstdint>
#include <ostream>

namespace rota::testing {

/// ι, ρ and Def. 4.
template <class Atom>
struct embedding_model {
  using event_type = event<Atom>;
  using delta_type = delta<Atom>;
  [[nodiscard]] static delta_type embed(event_type const& e) { return delta_type(e); }
  [[nodiscard]] static event_type clamp(delta_type const& d) { return rota::clamp(d); }
  [[nodiscard]] static event_type compose(event_type const& e, event_type const& f) { return rota::compose(e, f); }
};

/// clamp_retracts_the_embedding, compose_is_the_clamped_sum. Neither map is a homomorphism: of the `homomorphism_laws`,
/// each breaks `preserves_product` and nothing else.
template <class M>
[[nodiscard]] bundle embedding_laws() {
  using E = typename M::event_type;
  using D = typename M::delta_type;
  bundle laws("embedding");
  laws.add("clamp_retracts_the_embedding", "ρ(ι(e)) = e",
           [] {
             auto const e = draw<E>("e");
             interesting(!(M::embed(e) == D{}), "e is not empty");
             same("ρ(ι(e))", M::clamp(M::embed(e)), "e", e);
           },
           {{"e is not empty"}});
  laws.add("compose_is_the_clamped_sum", "e∘f = ρ(ι(e) + ι(f))",
           [] {
             auto const e = draw<E>("e");
             auto const f = draw<E>("f");
             interesting(!(M::embed(M::compose(e, f)) == M::embed(e) + M::embed(f)), "the clamp cuts");
             same("e∘f", M::compose(e, f), "ρ(ι(e) + ι(f))", M::clamp(M::embed(e) + M::embed(f)));
           },
           {{"the clamp cuts"}});
  return laws;
}

/// ℤ/60: an abelian group that is not free, so a sum of multiples may vanish although nothing cancels.
struct residue {
  int value = 0;

  friend bool operator==(residue, residue) = default;
  friend residue operator+(residue a, residue b) { return {(a.value + b.value) % 60}; }
  friend residue operator*(std::int64_t n, residue a) { return {static_cast<int>(((n * a.value) % 60 + 60) % 60)}; }
  friend void showValue(residue a, std::ostream& out) { out << a.value << " mod 60"; }
};

template <class Atom>
struct extension_model {
  using delta_type = delta<Atom>;
  template <class G, class F>
  [[nodiscard]] static G extend(delta_type const& d, F const& f, G zero) {
    return rota::extend(d, f, zero);
  }
};

namespace detail {

/// Any map from atoms to ℤ/60, by a drawn table.
template <class Atom>
[[nodiscard]] auto draw_map(char const* name) {
  return [table = *values(0, 59).as(name)](Atom const& x) {
    for (std::size_t i = 0; i < table.size(); ++i)
      if (nth_atom<Atom>(i) == x) return residue{table[i]};
    return residue{7};
  };
}

}  // namespace detail

/// agrees_on_generators, additive: the homomorphism of the universal property. It is the only one, because the atoms
/// generate the group.
template <class M>
[[nodiscard]] bundle extension_laws() {
  using D = typename M::delta_type;
  using Atom = typename D::atom_type;
  bundle laws("extension");
  laws.add("agrees_on_generators", "f̂(1 x) = f(x)", [] {
    auto const f = detail::draw_map<Atom>("f, atom by atom");
    auto const x = nth_atom<Atom>(static_cast<std::size_t>(*integer(0, 7).as("x, the atom number")));
    same("f̂(1 x)", M::extend(D(x, 1), f, residue{}), "f(x)", f(x));
  });
  laws.add("additive", "f̂(d + e) = f̂(d) + f̂(e)",
           [] {
             auto const f = detail::draw_map<Atom>("f, atom by atom");
             auto const d = draw<D>("d");
             auto const e = draw<D>("e");
             interesting(!(d == D{} || e == D{} || d + e == D{}), "neither d, e nor the sum is zero");
             same("f̂(d + e)", M::extend(d + e, f, residue{}), "f̂(d) + f̂(e)",
                  M::extend(d, f, residue{}) + M::extend(e, f, residue{}));
           },
           {{"neither d, e nor the sum is zero"}});
  return laws;
}

}  // namespace rota::testing
