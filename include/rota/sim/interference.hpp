#pragma once

#include <rota/sim/faults.hpp>
#include <rota/sim/network.hpp>
#include <rota/sim/playbook.hpp>
#include <rota/team/message.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace rota::sim {

/// What faults do to messages. Each directed link has a random stream of its own, apart from those of the network.
class interference {
public:
  interference(faults const& what, std::size_t robots, std::uint64_t seed)
      : bursts_(what.bursts),
        late_(what.late),
        flips_(what.flips),
        partitions_(what.partitions),
        broken_(what.broken),
        robots_(robots) {
    if (!bursts_ && !late_ && !flips_) return;  // nothing to draw
    links_.reserve(robots * robots);
    for (std::size_t i = 0; i < robots * robots; ++i) links_.push_back({engine_for(seed, stream::faults, i), false});
  }

  /// Takes from and adds to the delays of the copies of a message that is said now.
  void disturb(network::delays& copies, std::size_t from, std::size_t to, instant now) {
    if (bursts_ && bursts_->when.covers(now)) {
      link& l = links_[from * robots_ + to];
      l.bad = chance(l.engine, l.bad ? bursts_->ends : bursts_->begins) != l.bad;
      if (l.bad && chance(l.engine, bursts_->loss)) copies.clear();
    }
    if (late_ && late_->when.covers(now)) {
      auto& engine = links_[from * robots_ + to].engine;
      if (chance(engine, late_->probability))
        copies.push_back(nanoseconds(uniform(engine, late_->least.ns, late_->most.ns)));
    }
    if (cut(from, to, now)) copies.clear();
  }

  /// The message as it arrives, if a bit of it flips.
  [[nodiscard]] std::optional<message<names>> flipped(message<names> const& m, std::size_t from, std::size_t to,
                                                      instant now) {
    if (!flips_ || !flips_->when.covers(now)) return std::nullopt;
    auto& engine = links_[from * robots_ + to].engine;
    if (!chance(engine, flips_->probability)) return std::nullopt;
    auto broken = m;
    std::visit([&](auto& one) { flip_one(one, engine); }, broken);
    return broken;
  }

private:
  struct link {
    random_engine engine;
    bool bad = false;
  };

  [[nodiscard]] bool cut(std::size_t from, std::size_t to, instant now) const {
    for (partition const& p : partitions_)
      if (p.when.covers(now) && (p.side >> from & 1U) != (p.side >> to & 1U)) return true;
    for (broken_link const& b : broken_)
      if (b.from == from && b.to == to && b.when.covers(now)) return true;
    return false;
  }

  /// Small numbers matter most, so half of the flips are in the lowest twenty bits.
  template <class Number>
  static void flip(Number& x, random_engine& engine) {
    constexpr std::int64_t bits = sizeof(Number) * 8;
    auto const bit = chance(engine, 0.5) ? uniform(engine, 0, 19) : uniform(engine, 0, bits - 1);
    x = static_cast<Number>(static_cast<std::uint64_t>(x) ^ std::uint64_t{1} << bit);
  }
  template <class Message>
  static void flip_one(Message& m, random_engine& engine) {
    std::int64_t count = 0;
    each_number(m, [&](auto&) { ++count; });
    auto chosen = uniform(engine, 0, count - 1);
    each_number(m, [&](auto& x) {
      if (chosen-- == 0) flip(x, engine);
    });
  }
  template <class F>
  static void each_number(in<names>& x, F const& f) {
    f(x.agent.value), f(x.plan.value), f(x.task.value);
  }
  template <class F>
  static void each_number(plan_message<names>& m, F const& f) {
    f(m.sender.value), f(m.number.incarnation.value), f(m.number.sequence), f(m.claims);
    for (auto& t : m.types) {
      f(t.type.value), f(t.leads);
      if (t.place) f(t.place->plan.value), f(t.place->task.value), f(t.place->state.value);
      if (t.fingerprint) f(*t.fingerprint);
    }
  }
  template <class F>
  static void each_number(claim<names>& c, F const& f) {
    f(c.type.value), f(c.leader.value), f(c.incarnation.value), f(c.number), f(c.version), f(c.remaining.ns);
    f(c.stamp.confidence), f(c.stamp.id.value);
    for (duration& age : c.ages) f(age.ns);
    allocation_atoms<names> atoms;
    for (in<names> x : c.atoms) {
      each_number(x, f);
      atoms.insert(x);
    }
    c.atoms = std::move(atoms);
  }

  std::optional<burst_loss> bursts_;
  std::optional<late_copies> late_;
  std::optional<flipped_bits> flips_;
  std::vector<partition> partitions_;
  std::vector<broken_link> broken_;
  std::size_t robots_;
  std::vector<link> links_;
};

}  // namespace rota::sim
