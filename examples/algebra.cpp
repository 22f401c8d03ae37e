// The algebra of allocation events at compile time: each static_assert is a statement of docs/algebra.md.
#include <rota/rota.hpp>

#include <array>
#include <cstdint>
#include <limits>

namespace {

struct soccer : rota::runtime_vocabulary {
  enum class agent : unsigned char { ann, ben };
  enum class plan : unsigned char { play };
  enum class task : unsigned char { attack, defend };
};
using atom = rota::in<soccer>;
using event = rota::event<atom>;
using delta = rota::delta<atom>;
using atoms = rota::atom_set<atom>;

constexpr atom ann_attacks{soccer::agent::ann, soccer::plan::play, soccer::task::attack};
constexpr atom ann_defends{soccer::agent::ann, soccer::plan::play, soccer::task::defend};

// An event has additions and subtractions, no atom in both.
constexpr auto takes_over = event::make(atoms{ann_attacks}, atoms{ann_defends}).value();
static_assert(takes_over(ann_attacks) == rota::sign::plus && takes_over(ann_defends) == rota::sign::minus);
static_assert(event::make(atoms{ann_attacks}, atoms{ann_attacks}).error().witness == ann_attacks);

// Not a group: brackets matter.
constexpr auto e = event::addition(ann_attacks);
constexpr auto back = inverse(e);
static_assert(compose(e, e) == e);
static_assert(compose(compose(e, e), back) == event{});
static_assert(compose(e, compose(e, back)) == e);
static_assert(!associates(e, e, back) && associates(e, back, e));
static_assert(!rota::group<event> && rota::abelian_group<delta>);

// The group: nothing is forgotten, brackets do not matter.
static_assert((delta(e) + delta(e)) + delta(back) == delta(e) + (delta(e) + delta(back)));
static_assert(delta(e) + delta(e) == 2 * delta(e) && clamp(2 * delta(e)) == e);
constexpr delta most(ann_attacks, std::numeric_limits<std::int64_t>::max());
static_assert(checked_sum(most, delta(e)).error().witness == ann_attacks && checked_negation(most).has_value());

// A run, such as the history of a robot, composes to one event in any brackets.
constexpr std::array history{e, back, e};
static_assert(rota::compose_run<atom>(history).value() == e);
constexpr std::array no_history{e, e, back};
static_assert(rota::compose_run<atom>(no_history).error().witness == ann_attacks);

// An arrow knows where it starts, so arrows that do not meet are refused.
constexpr bool arrows_meet() {
  rota::transition const first{atoms{ann_defends}, atoms{ann_attacks}};
  rota::transition const second{atoms{ann_attacks}, atoms{}};
  return checked_compose(first, second).value().target().empty() && !checked_compose(second, first).has_value() &&
         event_of(first) == takes_over && compose(first, inverse(first)) == first.identity(first.source());
}
static_assert(arrows_meet());

// Eight bytes follow an allocation through its events.
static_assert(fingerprint_of(atoms{ann_attacks}) == fingerprint_of(atoms{ann_defends}) + fingerprint_of(takes_over));

// The same events in two machine words, where all atoms are known.
using play_atoms =
    rota::in_universe<soccer, rota::name_list<soccer::agent::ann, soccer::agent::ben>,
                      rota::name_list<soccer::plan::play>, rota::name_list<soccer::task::attack, soccer::task::defend>>;
constexpr auto in_one_word = to_dense(takes_over, play_atoms{}).value();
static_assert(sizeof(in_one_word) == 16 && rota::delta(in_one_word) == delta(takes_over));
static_assert(compose(in_one_word, inverse(in_one_word)).empty());

}  // namespace

int main() {}
