#include "algebra/generators.hpp"

#include <utility>

namespace universe {
namespace {

/// Zeros with weight z against nonzero values with weight two, z drawn once per vector.
rc::Gen<std::vector<int>> values_with_zeros(std::size_t atoms, int low, int high, std::vector<std::size_t> weights) {
  std::vector<int> nonzero;
  for (int x = low; x <= high; ++x)
    if (x != 0) nonzero.push_back(x);
  return rc::gen::mapcat(rc::gen::elementOf(std::move(weights)), [=](std::size_t zeros) {
    return rc::gen::container<std::vector<int>>(
        atoms, rc::gen::weightedOneOf<int>({{zeros, rc::gen::just(0)}, {2, rc::gen::elementOf(nonzero)}}));
  });
}

/// The event that moves the marked atoms into c or out of it; a mark of −1 moves the wrong way.
event flips(std::vector<int> const& marks, atom_set const& c) {
  std::vector<int> signs;
  for (std::size_t i = 0; i < marks.size(); ++i) signs.push_back(c.contains(nth(i)) ? -marks[i] : marks[i]);
  return event_of(signs);
}

}  // namespace

rc::Gen<std::size_t> atom_count() { return rc::gen::element<std::size_t>(1, 2, 3, 6, 6, 24); }

rc::Gen<int> integer(int low, int high) {
  return rc::gen::resize(100, rc::gen::inRange(low, high + 1));  // inRange starts with a part of the range otherwise
}
rc::Gen<std::vector<int>> integers(std::size_t count, int low, int high) {
  return rc::gen::container<std::vector<int>>(count, integer(low, high));
}
rc::Gen<std::vector<int>> values(std::size_t atoms, int low, int high) {
  return values_with_zeros(atoms, low, high, {0, 1, 2, 6});
}

rc::Gen<event> event_over(std::size_t atoms) { return rc::gen::map(values(atoms, -1, 1), event_of); }
rc::Gen<atom_set> set_over(std::size_t atoms) { return rc::gen::map(values(atoms, 0, 1), set_of); }
rc::Gen<delta> delta_over(std::size_t atoms) { return rc::gen::map(values(atoms, -4, 4), delta_of<std::int64_t>); }
rc::Gen<std::vector<event>> events_over(std::size_t atoms, std::size_t count) {
  return rc::gen::container<std::vector<event>>(count, event_over(atoms));
}

rc::Gen<triple> triples() {
  return rc::gen::exec([] {
    auto const n = *rc::gen::element<std::size_t>(1, 1, 2, 2, 3, 6);
    auto const dense = [n] { return event_of(*values_with_zeros(n, -1, 1, {0, 0, 0, 1})); };
    return triple{dense(), dense(), dense()};
  });
}
std::ostream& operator<<(std::ostream& out, triple const& t) { return out << t.e << " " << t.f << " " << t.g; }

rc::Gen<attempt> attempts() {
  return rc::gen::exec([] {
    auto const n = *atom_count();
    auto const worst_mark = *rc::gen::element(-1, -1, 1);
    auto const c = *set_over(n);
    return attempt{flips(*values(n, worst_mark, 1), c), c};
  });
}
std::ostream& operator<<(std::ostream& out, attempt const& t) { return out << t.e << " at " << t.c; }

rc::Gen<history> histories() {
  return rc::gen::exec([] {
    auto const n = *rc::gen::element<std::size_t>(1, 2, 3, 6);
    auto const length = *rc::gen::element<std::size_t>(1, 3, 4, 5, 6);
    history h{*set_over(n), {}};
    auto members = h.start;
    while (h.run.size() < length) {
      h.run.push_back(flips(*values_with_zeros(n, 0, 1, {0, 1, 2}), members));
      // Followed by insertion and erasure, not by `apply`, which is under test.
      for (auto const& x : h.run.back()) x.value == rota::sign::plus ? members.insert(x.atom) : members.erase(x.atom);
    }
    return h;
  });
}
std::ostream& operator<<(std::ostream& out, history const& h) {
  out << h.start;
  for (auto const& e : h.run) out << " " << e;
  return out;
}

}  // namespace universe
