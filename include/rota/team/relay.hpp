#pragma once

#include <rota/core/small_vector.hpp>
#include <rota/team/decision.hpp>
#include <rota/team/detail/roster.hpp>
#include <rota/team/message.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace rota {

/// Tells which messages are news, for whoever stands between robots that do not hear each other. Forwarding each message that
/// is news, and no other, lets every message reach everybody, and forwarding ends: copies and disorder do no harm.
///
/// `reception::relay` says the same of the plan types that a robot executes. This says it of all that are listed, so a robot
/// needs no part in them, and a repeater need not be a robot.
/// It remembers, of each agent, its last plan message, and its last claim for each type. Both may be forged, within reach of
/// what was heard; so what was not news for `robot_options::forget` counts as news, and then the forgery is forgotten.
/// A regular value; allocates only when it is made, in O(agents · types).
template <vocabulary V = runtime_vocabulary>
class relay {
public:
  using agent_id = typename V::agent;
  using type_id = typename V::plan_type;

  /// `everybody`: all whose messages are forwarded; `self`, if it is a robot, is none of them. `types`: those whose claims are
  /// forwarded, in any order. Of the options it reads `forget`, `max_delay` and `max_reign`, which are the same for the whole team.
  /// @pre `usable(options)`
  relay(agent_id self, std::span<agent_id const> everybody, std::span<type_id const> types,
        robot_options const& options = {})
      : peers_(self, everybody),
        agents_(everybody.begin(), everybody.end()),
        types_(types.begin(), types.end()),
        forget_(options.forget),
        max_delay_(options.max_delay),
        max_reign_(options.max_reign) {
    ROTA_ASSERT(usable(options));
    std::sort(agents_.begin(), agents_.end());
    std::sort(types_.begin(), types_.end());
    claims_.resize(agents_.size() * types_.size());
  }

  /// Whether to forward m, which has just arrived: it is newer than what was heard of its sender, and might be genuine. Takes
  /// it in. As with a robot, time is a parameter, and an earlier instant than the last moves all that is remembered back.
  /// O(log agents + log types).
  [[nodiscard]] bool is_news(message<V> const& m, instant now) {
    synchronise(now);
    if (auto const* const plan = std::get_if<plan_message<V>>(&m)) return newer(*plan, now);
    if (auto const* const bid = std::get_if<claim<V>>(&m)) return newer(*bid, now);
    return false;
  }

  friend bool operator==(relay const&, relay const&) = default;

private:
  /// The last claim of one leader for one type.
  struct last_claim {
    message_number life{};  // the incarnation, and the number of the claim
    std::uint64_t version = 0;
    duration least{};          // the least time left in any copy
    instant earliest{};        // the end that the first copy named, less the greatest delay
    instant heard = long_ago;  // when that was
    friend bool operator==(last_claim const&, last_claim const&) = default;
  };

  static bool within(std::uint64_t n) { return n > 0 && n <= incarnation::most().value; }
  /// Whether `next` may follow `last`: it is newer, and no farther than a genuine one can be.
  static bool follows(message_number const& last, message_number const& next) {
    return last < next && (last.incarnation != next.incarnation || next.sequence - last.sequence <= most_jump);
  }

  bool newer(plan_message<V> const& m, instant now) {
    auto* const sender = peers_.find(m.sender);
    if (!sender || m.types.size() > m.most_types || !within(m.number.incarnation.value) ||
        m.number.sequence > incarnation::most().value)
      return false;
    if (!sender->forgotten(now, forget_) && !follows(sender->last, m.number)) return false;
    sender->last = m.number;
    sender->heard = now;
    return true;
  }

  bool newer(claim<V> const& c, instant now) {
    auto const* const leader = peers_.find(c.leader);
    auto const type = std::lower_bound(types_.begin(), types_.end(), c.type);
    if (!leader || type == types_.end() || !(*type == c.type) || !(c.stamp.id == c.leader)) return false;
    if (!within(c.incarnation.value) || !within(c.number) || c.remaining <= duration{} || c.remaining > max_reign_)
      return false;
    if (!leader->forgotten(now, forget_) && c.incarnation < leader->last.incarnation) return false;
    last_claim& last = record_of(c.leader, static_cast<std::size_t>(type - types_.begin()));
    message_number const id{c.incarnation, c.number};
    bool const forgotten = last.heard == long_ago || now - last.heard > forget_;
    if (forgotten || follows(last.life, id)) {
      last = {id, c.version, c.remaining, now + c.remaining - max_delay_, now};
      return true;
    }
    bool const later = c.remaining < last.least || (c.remaining == last.least && c.version > last.version);
    if (id != last.life || !later || now + c.remaining < last.earliest) return false;
    last.version = c.version;
    last.least = c.remaining;
    return true;
  }

  last_claim& record_of(agent_id leader, std::size_t type) {
    auto const at = std::lower_bound(agents_.begin(), agents_.end(), leader) - agents_.begin();
    return claims_[static_cast<std::size_t>(at) * types_.size() + type];
  }
  void synchronise(instant now) {
    if (now < latest_) {
      duration const d = now - latest_;
      peers_.shift(d);
      for (last_claim& c : claims_) {
        c.earliest = moved(c.earliest, d);
        c.heard = moved(c.heard, d);
      }
    }
    latest_ = now;
  }

  detail::roster<V> peers_;
  std::vector<agent_id> agents_;  // ascending, like the types
  std::vector<type_id> types_;
  std::vector<last_claim> claims_;  // a row per agent
  duration forget_;
  duration max_delay_;
  duration max_reign_;
  instant latest_ = long_ago;
};

}  // namespace rota
