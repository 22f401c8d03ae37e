// Events acting on sets: apply, difference, transitions.

#include "theory/every_case.hpp"

#include <rota/algebra/apply.hpp>
#include <rota/algebra/transition.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace applying_theory {
namespace {

using namespace theory;

TEST(apply, is_addition_of_characteristic_functions) {
  law applicable_iff("e is applicable at C ⇔ χ(C) + ι(e) ∈ {0, 1}");
  law adds("χ(e·C) = χ(C) + ι(e)");
  law witness("a refusal names the least atom at which it is not");
  for (auto const& signs : functions({1, 3, 6, 12}, -1, 1))
    for (auto const& members : functions({1, 3, 6, 12}, 0, 1)) {
      auto const e = event_from(signs);
      atom_set c;
      for (auto const& [x, n] : members) c.insert(x);
      auto const target = plus(members, signs);
      auto const offends =
          std::find_if(target.begin(), target.end(), [](auto const& entry) { return entry.second != 1; });
      bool const stays = offends == target.end();
      auto const r = apply(e, c);
      applicable_iff(applicable(e, c) == stays && r.has_value() == stays);
      if (r.has_value()) adds(values_of(*r) == target);
      if (!r.has_value() && !stays) witness(r.error().witness == offends->first);
    }
}
TEST(difference, is_the_one_event_that_leads_there) {
  law leads("diff(C, C′)·C = C′");
  law pointwise("ι(diff(C, C′)) = χ(C′) − χ(C)");
  law back("diff(C′, C) = diff(C, C′)⁻¹");
  auto const all = beliefs(3);
  for (auto const& c : all)
    for (auto const& d : all) {
      auto const e = difference(c, d);
      auto const there = apply(e, c);
      leads(there.has_value() && *there == d);
      pointwise(values_of(e) == plus(values_of(d), values_of(c), -1));
      back(difference(d, c) == inverse(e));
    }
}
TEST(difference, is_a_functor) {
  law functor("diff(C, C′) ∘ diff(C′, C″) = diff(C, C″)");
  law sum("ι(diff(C, C′)) + ι(diff(C′, C″)) = ι(diff(C, C″))");
  law arrow("δ(C → C′) = χ(C′) − χ(C)");
  law arrows("transitions compose where they meet, and nowhere else");
  law made("C → e·C, where e is applicable");
  using transition = rota::transition<atom_set>;
  auto const all = beliefs(2);
  for (auto const& c : all)
    for (auto const& d : all) {
      transition const t{c, d};
      made(*transition::make(c, difference(c, d)) == t && inverse(t) == transition{d, c} &&
           (c == d || transition::make(d, difference(c, d)).error() == apply(difference(c, d), d).error()));
      for (auto const& e : all) {
        transition const u{d, e};
        functor(compose(difference(c, d), difference(d, e)) == difference(c, e));
        sum(delta_of(t) + delta_of(u) == delta_of(compose(t, u)) && event_of(compose(t, u)) == difference(c, e));
        arrow(delta_of(u) == delta(e) - delta(d));
        auto const meets = checked_compose(transition{c, d}, transition{e, c});
        arrows(meets.has_value() == (d == e) &&
               (meets ? *meets == transition::identity(c) : meets.error().witness == difference(d, e).begin()->atom));
      }
    }
}

}  // namespace
}  // namespace applying_theory
