#pragma once

#include <rota/team/wire.hpp>

#include <rapidcheck.h>

#include <algorithm>
#include <cstdint>

namespace rota_test {

/// A number of any length.
inline rc::Gen<std::uint64_t> any_number() {
  return rc::gen::map(rc::gen::tuple(rc::gen::arbitrary<std::uint64_t>(), rc::gen::inRange(0, 64)),
                      [](auto const& t) { return std::get<0>(t) >> std::get<1>(t); });
}
template <class Id>
Id any_id() {
  return rota::wire_id<Id>::from(*rc::gen::inRange<std::uint64_t>(0, 256));
}

/// A message that can be written, with times that the written form holds exactly.
template <rota::vocabulary V>
rc::Gen<rota::message<V>> any_message() {
  using agent = typename V::agent;
  return rc::gen::exec([] {
    if (*rc::gen::arbitrary<bool>()) {
      rota::plan_message<V> m{any_id<agent>(), {{*any_number()}, *any_number()}, *any_number(), {}};
      int const types = *rc::gen::weightedElement<int>({{2, 0}, {5, 1}, {3, 3}, {1, 9}});
      for (int t = 0; t < types; ++t) {
        rota::participation<V> p;
        p.type = any_id<typename V::plan_type>();
        p.leads = *any_number();
        if (*rc::gen::arbitrary<bool>())
          p.place =
              rota::placement<V>{any_id<typename V::plan>(), any_id<typename V::task>(), any_id<typename V::state>()};
        if (*rc::gen::arbitrary<bool>()) p.fingerprint = static_cast<std::uint32_t>(*any_number());
        p.stance = static_cast<rota::stance>(*rc::gen::inRange(0, 3));
        m.types.push_back(p);
      }
      return rota::message<V>{m};
    }
    rota::claim<V> c;
    c.type = any_id<typename V::plan_type>();
    auto const plan = any_id<typename V::plan>();
    int const size = *rc::gen::inRange(0, 13);
    for (int i = 0; i < size; ++i) c.atoms.insert({any_id<agent>(), plan, any_id<typename V::task>()});
    for (std::size_t i = 0; i < c.atoms.size(); ++i)
      c.ages.push_back(rota::milliseconds(*rc::gen::inRange(0, 100'000)));
    c.stamp = {static_cast<std::uint32_t>(*any_number()), any_id<agent>()};
    c.leader = any_id<agent>();
    c.incarnation = {*any_number()};
    c.number = *any_number();
    c.version = *any_number();
    c.renewals = static_cast<std::uint32_t>(*any_number());
    c.answers = static_cast<std::uint32_t>(*any_number());
    c.remaining = rota::microseconds(static_cast<std::int64_t>(*any_number() >> 12));
    return rota::message<V>{c};
  });
}

}  // namespace rota_test
