#pragma once

#include <rota/sim/closed/coordinator.hpp>
#include <rota/team/monitors/literal.hpp>
#include <rota/team/wire.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

namespace rota::sim::closed {

/// A `rota::robot`, whole, with a monitor of choice: who acts first, and talks then.
template <class Monitor>
class robot_coordinator {
public:
  using message = rota::message<names>;

  robot_coordinator(post const& p, instant now) : book_(p.book), members_(p.members), mind_(make(p)) {
    mind_.enter(book_->type, now);
  }

  void tick(perceived const& seen, instant now) { (void)mind_.deliberate(book_->type, *members_, seen, now, space_); }
  void receive(message const& m, instant now) { (void)mind_.receive(m, now); }
  [[nodiscard]] std::optional<message> next_message(instant now) { return mind_.next_message(now); }
  [[nodiscard]] instant next_due() const { return mind_.next_due(); }
  [[nodiscard]] allocation_atoms<names> const& believed() const { return mind_.believes(book_->type.id())->atoms(); }
  /// Whether it leads, so that a game counts reigns.
  [[nodiscard]] bool reigns() const { return mind_.rule(book_->type.id())->leading(); }
  [[nodiscard]] static std::size_t bytes(message const& m) {
    std::array<std::byte, 512> buffer{};
    return encode(m, buffer).value();
  }

private:
  static rota::robot<names, Monitor> make(post const& p) {
    robot_options o = p.rules.robot;
    o.message_period = p.rules.message_period;
    o.silence = p.rules.silence;
    o.max_delay = (std::min)(o.max_delay, duration{o.silence.ns / 2});
    o.first_message = p.first_message;
    return {p.agent(), p.members->agents(), incarnation{p.life}, o};
  }

  playbook const* book_;
  team<names> const* members_;
  rota::robot<names, Monitor> mind_;
  workspace space_;
};

}  // namespace rota::sim::closed
