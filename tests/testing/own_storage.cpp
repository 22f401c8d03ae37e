// An event type of a user that satisfies the concept `allocation_event`. One line tests it by every law. With one
// function, `to_sparse`, it works with deltas, fingerprints, runs, transitions and cycles.

#include "testing/wrong.hpp"

#include <rota/testing/gtest.hpp>

#include <map>
#include <set>
#include <utility>

namespace own {

using rota::sign;
using sample::atom;

struct set {
  std::set<atom> of;
  bool insert(atom const& x) { return of.insert(x).second; }
  [[nodiscard]] bool contains(atom const& x) const { return of.contains(x); }
  friend bool operator==(set const&, set const&) = default;
};

/// Signs in a std::map.
struct event {
  using atom_type = atom;
  using set_type = set;
  std::map<atom, sign> of;

  [[nodiscard]] sign operator()(atom const& x) const { return of.contains(x) ? of.at(x) : sign::zero; }
  [[nodiscard]] std::size_t size() const { return of.size(); }
  [[nodiscard]] bool empty() const { return of.empty(); }
  [[nodiscard]] set additions() const { return part(sign::plus); }
  [[nodiscard]] set subtractions() const { return part(sign::minus); }
  [[nodiscard]] static rota::result<event, rota::overlap<atom>> make(set const& plus, set const& minus) {
    event e;
    for (auto const& x : plus.of) e.of[x] = sign::plus;
    for (auto const& x : minus.of)
      if (!e.of.emplace(x, sign::minus).second) return rota::refused{rota::overlap<atom>{x}};
    return e;
  }
  friend bool operator==(event const&, event const&) = default;

private:
  [[nodiscard]] set part(sign s) const {
    set c;
    for (auto const& [x, value] : of)
      if (value == s) c.insert(x);
    return c;
  }
};

event compose(event e, event const& f) {
  for (auto const& [x, s] : f.of)
    if ((e.of[x] = rota::clamped_sum(e(x), s)) == sign::zero) e.of.erase(x);
  return e;
}
event inverse(event e) {
  for (auto& [x, s] : e.of) s = s == sign::plus ? sign::minus : sign::plus;
  return e;
}
event difference(set const& before, set const& after) {
  event e;
  for (auto const& x : before.of)
    if (!after.contains(x)) e.of[x] = sign::minus;
  for (auto const& x : after.of)
    if (!before.contains(x)) e.of[x] = sign::plus;
  return e;
}
rota::result<set, rota::inapplicable<atom>> apply(event const& e, set c) {
  for (auto const& [x, s] : e.of)
    if (s == sign::plus ? !c.insert(x) : c.of.erase(x) == 0) return rota::refused{rota::inapplicable<atom>{x}};
  return c;
}
bool applicable(event const& e, set const& c) { return apply(e, c).has_value(); }

rota::atom_set<atom> to_sparse(set const& c) { return {c.of.begin(), c.of.end()}; }
rota::event<atom> to_sparse(event const& e) {
  return rota::event<atom>::make(to_sparse(e.additions()), to_sparse(e.subtractions())).value();
}

static_assert(rota::allocation_event<event> && rota::allocation_set<set>);

}  // namespace own

template <>
struct rota::structure<own::event> : rota::event_structure<own::event> {};

template <>
struct rc::Arbitrary<own::event> {
  static Gen<own::event> arbitrary() {
    return gen::map(gen::arbitrary<sample::event>(), [](sample::event const& e) {
      return rota::testing::storage<own::event, rota::structure<own::event>>::stored(e);
    });
  }
};

namespace own_storage_test {

using namespace rota::testing;
using transition = rota::transition<own::set>;

[[maybe_unused]] bool const registered =
    register_laws<own::event>("own_event") && register_laws<transition>("own_transition") &&
    register_laws("delta_of_own_transition", functor_laws<transition, sample::delta>(&rota::delta_of<own::set>));

TEST(own_event, is_under_every_law_by_one_line) {
  auto const laws = laws_of<own::event>();
  for (char const* name : {"closed", "commutative", "unique_inverse", "vanishes_iff_no_bad_sign_triple", "composition",
                           "unique_applicable_event", "difference_is_a_functor", "brackets_do_not_matter",
                           "compose_run_refuses_the_rest", "silent_about_b", "restores_b_s_part"})
    EXPECT_EQ(laws.contains(name), std::string(name) != "closed") << name;  // no class invariant was named
}

TEST(own_event, has_the_fingerprint_of_what_it_is) {
  sample::atom_set const c{nth_atom<sample::atom>(1), nth_atom<sample::atom>(5)};
  auto const own_c = stored_as<own::set>(c);
  EXPECT_EQ(rota::fingerprint_of(own_c), fingerprint_of(c));
  EXPECT_EQ(rota::fingerprint_of(difference(own_c, own::set{})), -fingerprint_of(c));
}

}  // namespace own_storage_test
