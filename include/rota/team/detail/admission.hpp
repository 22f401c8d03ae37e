#pragma once

#include <rota/team/decision.hpp>
#include <rota/team/detail/roster.hpp>
#include <rota/team/detail/track.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace rota::detail {

/// Whether a message may enter a robot: `robot::receive` asks before anything changes. It reads what the robot knows, and
/// changes nothing.
template <vocabulary V, class Monitor>
class admission {
public:
  using agent_id = typename V::agent;
  using peer = typename roster<V>::peer;

  admission(agent_id self, incarnation life, robot_options const& options, roster<V> const& peers,
            std::vector<track<V, Monitor>> const& tracks)
      : self_(self), life_(life), options_(options), peers_(peers), tracks_(tracks) {}

  /// @param sender of the message, if the roster has it
  [[nodiscard]] refusal refuses(plan_message<V> const& m, peer const* sender, instant now) const {
    if (m.sender == self_) return own(m.number.incarnation);
    if (!sender) return refusal::stranger;
    if (m.types.size() > m.most_types) return refusal::too_many_types;
    if (!within(m.number.incarnation.value) || m.number.sequence >= out_of_reach || m.claims >= out_of_reach)
      return refusal::number_out_of_reach;
    if (!sender->forgotten(now, options_.forget) && m.number.incarnation == sender->last.incarnation &&
        jumps(sender->last.sequence, m.number.sequence))
      return refusal::number_out_of_reach;
    for (auto const& p : m.types)
      if (p.leads > m.claims) return refusal::foreign_claim;
    return refuses(m.types);
  }

  [[nodiscard]] refusal refuses(claim<V> const& c) const {
    if (c.leader == self_) return own(c.incarnation);
    if (!peers_.find(c.leader)) return refusal::stranger;
    if (!within(c.incarnation.value) || !within(c.number) || c.version >= out_of_reach)
      return refusal::number_out_of_reach;
    if (!(c.stamp.id == c.leader)) return refusal::foreign_stamp;
    if (!options_.resolution) return refusal::resolution_off;
    auto const t =
        std::find_if(tracks_.begin(), tracks_.end(), [&](auto const& x) { return x.names.type() == c.type; });
    if (t == tracks_.end() || !t->executing) return refusal::not_executed;
    if (t->rule.contradicts(c)) return refusal::foreign_stamp;
    if (auto const last = t->rule.last_heard(c.leader); last && last->incarnation == c.incarnation)
      if (jumps(last->number, c.number)) return refusal::number_out_of_reach;
    if (auto const version = t->rule.version_of(c); version && jumps(*version, c.version))
      return refusal::number_out_of_reach;
    if (c.remaining <= duration{} || c.remaining > options_.max_reign) return refusal::remaining_time;
    return refuses(c, t->names);
  }

private:
  /// No genuine number reaches this: greater ones are flipped bits, or forgeries that would mute their victim.
  static constexpr std::uint64_t out_of_reach = incarnation::most().value + 1;
  [[nodiscard]] static bool within(std::uint64_t number) { return number > 0 && number < out_of_reach; }
  [[nodiscard]] static bool jumps(std::uint64_t from, std::uint64_t to) { return to > from && to - from > most_jump; }

  /// A message from the robot's own id: an echo, or a sign that its incarnation was not obtained as it should.
  [[nodiscard]] refusal own(incarnation speaks) const {
    if (speaks < life_) return refusal::own_former_life;
    return speaks == life_ ? refusal::own_id : refusal::own_later_life;
  }
  /// What a plan message lists. O(types of the message + types known).
  [[nodiscard]] refusal refuses(small_vector<participation<V>, 4> const& types) const {
    auto t = tracks_.begin();
    for (auto const* p = types.begin(); p != types.end(); ++p) {
      if (p != types.begin() && !((p - 1)->type < p->type)) return refusal::types_not_ascending;
      while (t != tracks_.end() && t->names.type() < p->type) ++t;
      if (t == tracks_.end() || !t->executing || !(t->names.type() == p->type) || !p->place) continue;
      if (!t->names.find(p->place->plan, p->place->task)) return refusal::unknown_task;
    }
    return refusal::none;
  }
  /// What a claim says of whom. O(|claim| log roster).
  [[nodiscard]] refusal refuses(claim<V> const& c, outline<V> const& names) const {
    for (auto const* x = c.atoms.begin(); x != c.atoms.end(); ++x) {
      if (!(x->agent == self_) && !peers_.find(x->agent)) return refusal::stranger;
      if (!names.find(x->plan, x->task)) return refusal::unknown_task;
      if (!(x->plan == c.atoms.begin()->plan)) return refusal::malformed_allocation;
      if (x != c.atoms.begin() && (x - 1)->agent == x->agent) return refusal::malformed_allocation;
    }
    if (c.ages.size() != c.atoms.size()) return refusal::malformed_allocation;
    for (duration const age : c.ages)
      if (age < duration{} || age > longest_duration) return refusal::malformed_allocation;
    return refusal::none;
  }

  agent_id self_;
  incarnation life_;
  robot_options const& options_;
  roster<V> const& peers_;
  std::vector<track<V, Monitor>> const& tracks_;
};

}  // namespace rota::detail
