#pragma once
/// @file
/// The laws of conflict (Def. 2) and of its witness (Prop. 1). The model M names the functions. `conflict_model` names
/// the library's own.

#include <rota/team/conflict.hpp>
#include <rota/testing/arbitrary.hpp>
#include <rota/testing/cycle_laws.hpp>

#include <algorithm>
#include <vector>

namespace rota::testing {

template <vocabulary V>
struct conflict_model {
  using vocabulary_type = V;
  [[nodiscard]] static bool conflicts_with(allocation<V> const& c1, allocation<V> const& c2) {
    return rota::conflicts_with(c1, c2);
  }
  [[nodiscard]] static allocation_atoms<V> causes(allocation<V> const& c1, allocation<V> const& c2) {
    return rota::causes(c1, c2);
  }
  [[nodiscard]] static bool in_conflict(allocation<V> const& c1, allocation<V> const& c2) {
    return rota::in_conflict(c1, c2);
  }
  [[nodiscard]] static conflict_witness<V> proposition_1(allocation<V> const& c1, allocation<V> const& c2,
                                                         allocation<V> const& cb, in<V> const& cause) {
    return rota::proposition_1(c1, c2, cb, cause);
  }
};

namespace detail {

/// C₁ and C₂ of one plan type; C₂ is often close to C₁.
template <vocabulary V>
struct allocation_pair {
  allocation<V> c1, c2;
};
template <vocabulary V>
[[nodiscard]] allocation_pair<V> draw_pair() {
  auto const c1 = draw<allocation_atoms<V>>("C₁");
  return {{{}, c1}, {{}, *set_beside(c1).as("C₂")}};
}

/// C₁ ⊈ C₂, tested atom by atom: Def. 2 within one plan type.
template <vocabulary V>
[[nodiscard]] bool lacks_some(allocation<V> const& c1, allocation<V> const& c2) {
  return std::any_of(c1.atoms.begin(), c1.atoms.end(), [&](in<V> const& x) { return !c2.atoms.contains(x); });
}

}  // namespace detail

/// never_between_plan_types, causes_are_what_the_other_lacks, conflict_iff_some_cause, agents_conflict_either_way.
template <class M>
[[nodiscard]] bundle conflict_laws() {
  using V = typename M::vocabulary_type;
  bundle laws("definition_2");
  laws.add("never_between_plan_types", "C₁ and C₂ of different plan types: no conflict, no cause", [] {
    auto [c1, c2] = detail::draw_pair<V>();
    c1.type = sample_atoms<typename V::plan_type>::nth(0);
    c2.type = sample_atoms<typename V::plan_type>::nth(1);
    holds(!M::conflicts_with(c1, c2) && !M::in_conflict(c1, c2), "C₁ and C₂ are not in conflict");
    holds(M::causes(c1, c2).empty(), "there is no cause");
  });
  laws.add("causes_are_what_the_other_lacks", "x is a cause ⇔ x ∈ C₁ and x ∉ C₂",
           [] {
             auto const [c1, c2] = detail::draw_pair<V>();
             allocation_atoms<V> lacking;
             for (auto const& x : c1.atoms)
               if (!c2.atoms.contains(x)) lacking.insert(x);
             interesting(lacking.size() > 1, "several causes");
             same("the causes", M::causes(c1, c2), "what C₂ lacks", lacking);
           },
           {{"several causes"}});
  laws.add("conflict_iff_some_cause", "C₁ conflicts with C₂ ⇔ some x is a cause",
           [] {
             auto const [c1, c2] = detail::draw_pair<V>();
             bool const caused = !M::causes(c1, c2).empty();
             interesting(caused, "conflict");
             interesting(!caused, "no conflict");
             holds(M::conflicts_with(c1, c2) == caused, "C₁ conflicts with C₂ iff some x is a cause");
           },
           {{"conflict"}, {"no conflict"}});
  laws.add("agents_conflict_either_way", "agents in conflict ⇔ C₁ conflicts with C₂ or C₂ with C₁", [] {
    auto const [c1, c2] = detail::draw_pair<V>();
    holds(M::in_conflict(c1, c2) == (M::conflicts_with(c1, c2) || M::conflicts_with(c2, c1)),
          "in conflict iff one conflicts with the other");
  });
  return laws;
}
/// irreflexive, directed. Both follow.
template <class M>
[[nodiscard]] bundle conflict_theorems() {
  using V = typename M::vocabulary_type;
  bundle laws("definition_2_theorems");
  laws.add("irreflexive", "C never conflicts with itself", [] {
    allocation<V> const c{{}, draw<allocation_atoms<V>>("C")};
    holds(!M::conflicts_with(c, c) && !M::in_conflict(c, c), "C does not conflict with itself");
  });
  laws.add("directed", "C₁ ⊊ C₂ ⇒ C₂ conflicts with C₁, and not C₁ with C₂",
           [] {
             auto const [c1, c2] = detail::draw_pair<V>();
             allocation<V> const both{{}, unite(c1.atoms, c2.atoms)};
             interesting(both != c1, "C₁ ⊊ C₁ ∪ C₂");
             if (both == c1) return;
             holds(M::conflicts_with(both, c1), "C₁ ∪ C₂ conflicts with C₁");
             holds(!M::conflicts_with(c1, both), "C₁ does not conflict with C₁ ∪ C₂");
           },
           {{"C₁ ⊊ C₁ ∪ C₂"}});
  return laws;
}

namespace detail {

/// The premise of Prop. 1: what a₁, a₂ and b believe about one plan type, and a cause about b. If b is a₁ or a₂, C_b is
/// what that agent believes.
template <vocabulary V>
struct premise {
  allocation<V> c1, c2, cb;
  in<V> cause;
};
template <vocabulary V>
[[nodiscard]] premise<V> draw_premise() {
  auto [c1, c2] = draw_pair<V>();
  auto const cause = draw<in<V>>("the cause");
  c1.atoms.insert(cause);
  c2.atoms.erase(cause);
  allocation<V> cb{{}, *set_beside(c1.atoms).as("C_b")};
  switch (*integer(0, 4).as("b: 0, 1 another agent, 2 without the cause, 3 idle, 4 one of the two")) {
  case 0:
  case 1: break;
  case 2: cb.atoms.erase(cause); break;
  case 3: cb.atoms.clear(); break;
  case 4: cb = *integer(1, 2).as("which") == 1 ? c1 : c2; break;
  }
  interesting(cb.atoms.contains(cause), "b believes in the cause");
  interesting(!cb.atoms.contains(cause) && !cb.atoms.empty(), "b believes in something else");
  interesting(cb.atoms.empty(), "b believes in nothing");
  interesting(cb == c1 || cb == c2, "b is one of the two");
  return {c1, c2, cb, cause};
}

}  // namespace detail

/// witness_is_in_conflict_with_b, witness_names_the_cause.
template <class M>
[[nodiscard]] bundle proposition_1_laws() {
  using V = typename M::vocabulary_type;
  bundle laws("proposition_1");
  laws.add("witness_is_in_conflict_with_b", "x ∈ C₁∖C₂ about b ⇒ C_b conflicts with C₂, or C₁ with C_b, because of x",
           [] {
             auto const [c1, c2, cb, cause] = detail::draw_premise<V>();
             auto const w = M::proposition_1(c1, c2, cb, cause);
             bool const second = w.partner == conflict_partner::second;
             auto const& from = second ? cb : c1;
             auto const& to = second ? c2 : cb;
             holds(detail::lacks_some(from, to), "the witness is in conflict with b");
             holds(from.atoms.contains(cause) && !to.atoms.contains(cause), "the cause of that conflict is x");
           },
           {{"b believes in the cause", 15},
            {"b believes in something else", 15},
            {"b believes in nothing", 15},
            {"b is one of the two", 15}});
  laws.add("witness_names_the_cause", "the witness names x", [] {
    auto const [c1, c2, cb, cause] = detail::draw_premise<V>();
    same("the cause named", M::proposition_1(c1, c2, cb, cause).cause, "x", cause);
  });
  return laws;
}
/// b_is_news_to_the_witness, the corollary.
template <class M>
[[nodiscard]] bundle proposition_1_theorems() {
  using V = typename M::vocabulary_type;
  bundle laws("proposition_1_theorems");
  laws.add("b_is_news_to_the_witness", "b's part of C_b differs from b's part of what the witness believes", [] {
    auto const [c1, c2, cb, cause] = detail::draw_premise<V>();
    auto const w = M::proposition_1(c1, c2, cb, cause);
    auto const& believed = w.partner == conflict_partner::second ? c2 : c1;
    auto const part = [b = cause.agent](allocation<V> const& c) {
      std::vector<in<V>> atoms;
      for (auto const& x : c.atoms)
        if (x.agent == b) atoms.push_back(x);
      return atoms;
    };
    holds(part(cb) != part(believed), "b's next message is an event at the witness");
  });
  return laws;
}

}  // namespace rota::testing
