// The free abelian group, over several types of integers. Each law is a test of its own, such as
// delta.abelian_group.associative. Then one wrong model per law of the embedding of events, and of freeness.

#include "testing/wrong.hpp"

#include <rota/testing/delta_laws.hpp>
#include <rota/testing/gtest.hpp>
#include <rota/testing/module_laws.hpp>

#include <cstdint>

namespace deltas_test {

using namespace rota::testing;
using sample::atom;
using sample::delta;
using sample::event;
using small_delta = rota::delta<atom, std::int8_t>;

/// ι of a dense event, and the clamp back into its universe.
struct dense_embedding {
  using event_type = sample::dense_event;
  using delta_type = delta;
  static delta embed(event_type const& e) { return delta(e); }
  static event_type clamp(delta const& d) { return to_dense(rota::clamp(d), sample::wide_universe{}).value(); }
  static event_type compose(event_type const& e, event_type const& f) { return rota::compose(e, f); }
};

[[maybe_unused]] bool const registered =
    register_laws<delta>("delta") && register_laws("delta", group_theorems<delta>()) &&
    register_laws("delta", module_laws<delta>()) && register_laws("delta", module_theorems<delta>()) &&
    register_laws("delta", embedding_laws<embedding_model<atom>>()) &&
    register_laws("dense_event", embedding_laws<dense_embedding>()) &&
    register_laws("delta", extension_laws<extension_model<atom>>()) && register_laws<small_delta>("delta_of_8_bits") &&
    register_laws("delta_of_8_bits", module_laws<small_delta>()) &&
    register_laws<sample::exact_delta>("delta_of_big_integers") &&
    register_laws("delta_of_big_integers", module_laws<sample::exact_delta>());

// ι and ρ -------------------------------------------------------------------------------------------------------------

using right = embedding_model<atom>;

/// Clamps by parity: right on the image of ι, wrong on sums.
struct clamps_by_parity : right {
  static event clamp(delta const& d) {
    delta odd;
    for (auto const& x : d)
      if (x.count % 2 != 0) odd += delta(x.atom, x.count);
    return rota::clamp(odd);
  }
};
/// Forgets subtractions, and composes accordingly.
struct forgets_subtractions : right {
  static event clamp(delta const& d) { return event::make(rota::clamp(d).additions(), {}).value(); }
  static event compose(event const& e, event const& f) { return clamp(delta(e) + delta(f)); }
};
TEST(wrong_embedding, one_model_for_each_law) {
  EXPECT_EQ(broken(embedding_laws<clamps_by_parity>()), "compose_is_the_clamped_sum");
  EXPECT_EQ(broken(embedding_laws<forgets_subtractions>()), "clamp_retracts_the_embedding");
}

// The universal property ----------------------------------------------------------------------------------------------

struct ignores_multiplicity : extension_model<atom> {
  template <class G, class F>
  static G extend(delta const& d, F const& f, G sum) {
    for (auto const& x : d) sum = sum + (x.count > 0 ? 1 : -1) * f(x.atom);
    return sum;
  }
};
struct extends_to_zero : extension_model<atom> {
  template <class G, class F>
  static G extend(delta const&, F const&, G zero) {
    return zero;
  }
};
TEST(wrong_extension, one_model_for_each_law) {
  EXPECT_EQ(broken(extension_laws<ignores_multiplicity>()), "additive");
  EXPECT_EQ(broken(extension_laws<extends_to_zero>()), "agrees_on_generators");
}

}  // namespace deltas_test
