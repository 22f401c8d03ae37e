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
    if (auto* const plan = std::get_if<plan_message<names>>(&broken)) {
      flip_one(*plan, engine);
    } else {
      flip_one(*std::get_if<claim<names>>(&broken), engine);
    }
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
  static void flip_one(plan_message<names>& m, random_engine& engine) {
    switch (uniform(engine, 0, m.types.empty() ? 3 : 6)) {
    case 0: return flip(m.sender.value, engine);
    case 1: return flip(m.number.incarnation.value, engine);
    case 2: return flip(m.number.sequence, engine);
    case 3: return flip(m.claims, engine);
    case 4: return flip(m.types[0].type.value, engine);
    case 5: return flip(m.types[0].leads, engine);
    default:
      if (m.types[0].place) flip(m.types[0].place->task.value, engine);
    }
  }
  static void flip_one(claim<names>& c, random_engine& engine) {
    switch (uniform(engine, 0, c.atoms.empty() ? 6 : 8)) {
    case 0: return flip(c.leader.value, engine);
    case 1: return flip(c.incarnation.value, engine);
    case 2: return flip(c.number, engine);
    case 3: return flip(c.version, engine);
    case 4: return flip(c.remaining.ns, engine);
    case 5: return flip(c.stamp.confidence, engine);
    case 6: return flip(c.stamp.id.value, engine);
    case 7: return flip(c.ages[0].ns, engine);
    default: {
      auto x = *c.atoms.begin();
      c.atoms.erase(x);
      flip(chance(engine, 0.5) ? x.agent.value : x.task.value, engine);
      c.atoms.insert(x);
    }
    }
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
