// Difference and apply, and runs: every law a test of its own, such as event.apply.unique_applicable_event; then one wrong
// model per law.

#include "testing/wrong.hpp"

#include <rota/testing/apply_laws.hpp>
#include <rota/testing/gtest.hpp>

#include <span>
#include <vector>

namespace apply_test {

using namespace rota::testing;
using rota::sign;
using sample::atom;
using sample::atom_set;
using sample::delta;
using sample::event;

// Apply and difference ------------------------------------------------------------------------------------------------

using right = apply_model<atom>;
using right_runs = run_model<atom>;
[[maybe_unused]] bool const registered = register_laws("event", apply_laws<right>()) &&
                                         register_laws("event", apply_theorems<right>()) &&
                                         register_laws("event", run_laws<right_runs>());

using applied = rota::result<atom_set, rota::inapplicable<atom>>;

struct swaps_the_difference : right {
  static event difference(atom_set const& c, atom_set const& d) { return rota::difference(d, c); }
};
/// (C ∖ e⁻) ∪ e⁺ whether or not the event applies.
struct never_refuses : right {
  static applied apply(event const& e, atom_set const& c) {
    return unite(subtract(c, e.subtractions()), e.additions());
  }
};
struct names_the_greatest_atom : right {
  static applied apply(event const& e, atom_set const& c) {
    auto const r = rota::apply(e, c);
    if (r.has_value()) return *r;
    auto witness = r.error().witness;
    for (auto const& x : delta(c) + delta(e))
      if (x.count != 1) witness = x.atom;
    return rota::refused{rota::inapplicable<atom>{witness}};
  }
};
struct counts_members_twice : right {
  static delta characteristic(atom_set const& c) { return 2 * delta(c); }
};
/// The later event wins at each atom: associative, and still wrong.
event by_the_later(event const& e, event const& f) {
  std::vector<int> signs;
  for (std::size_t i = 0; i < 24; ++i) {
    auto const x = nth_atom<atom>(i);
    signs.push_back(to_int(f(x) == sign::zero ? e(x) : f(x)));
  }
  return event_with<atom>(signs);
}
struct composes_by_the_later : right {
  static event compose(event const& e, event const& f) { return by_the_later(e, f); }
};

TEST(wrong_apply, one_model_for_each_law) {
  EXPECT_EQ(broken(apply_laws<swaps_the_difference>()), "unique_applicable_event");
  EXPECT_EQ(broken(apply_laws<never_refuses>()), "refuses_iff_it_leaves_the_sets");
  EXPECT_EQ(broken(apply_laws<names_the_greatest_atom>()), "refusal_names_the_least_atom");
  EXPECT_EQ(broken(apply_laws<counts_members_twice>()), "characteristic_adds");
  EXPECT_EQ(broken(apply_laws<composes_by_the_later>()), "compatible_with_compose");
  EXPECT_EQ(broken(apply_theorems<composes_by_the_later>()), "difference_is_a_functor");
}

// Runs ----------------------------------------------------------------------------------------------------------------

using events = std::span<event const>;
using composed = rota::result<event, rota::no_run<atom>>;

/// Subtracts each event from what came before: as a left fold merely what should have been the sum.
struct subtracts : right_runs {
  static event compose(event const& e, event const& f) { return rota::compose(e, rota::inverse(f)); }
  static event fold(events run) {
    event folded = run.front();
    for (auto const& e : run.subspan(1)) folded = compose(folded, e);
    return folded;
  }
  static delta sum(events run) { return delta(fold(run)); }
  static composed compose_run(events run) {
    auto const r = rota::compose_run(run);
    if (!r) return r;
    return fold(run);
  }
};
struct sums_without_the_first : right_runs {
  static delta sum(events run) { return right_runs::sum(run.subspan(1)); }
};
struct forgets_the_last : right_runs {
  static composed compose_run(events run) {
    auto const r = rota::compose_run(run);
    return r && run.size() > 3 ? rota::compose_run(run.first(run.size() - 1)) : r;
  }
};
struct composes_what_is_no_run : right_runs {
  static composed compose_run(events run) {
    auto const r = rota::compose_run(run);
    if (r) return r;
    return clamp(sum(run));
  }
};
struct blames_the_first_two : right_runs {
  static composed compose_run(events run) {
    auto const r = rota::compose_run(run);
    if (r) return r;
    return rota::refused{rota::no_run<atom>{r.error().witness, 0, 1}};
  }
};
TEST(wrong_run, one_model_for_each_law) {
  EXPECT_EQ(broken(run_laws<subtracts>()), "brackets_do_not_matter");
  EXPECT_EQ(broken(run_laws<sums_without_the_first>()), "left_fold_is_the_sum");
  EXPECT_EQ(broken(run_laws<forgets_the_last>()), "compose_run_is_the_left_fold");
  EXPECT_EQ(broken(run_laws<composes_what_is_no_run>()), "compose_run_refuses_the_rest");
  EXPECT_EQ(broken(run_laws<blames_the_first_two>()), "compose_run_refuses_the_rest");
}

}  // namespace apply_test
