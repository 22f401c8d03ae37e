#pragma once

#include <rota/sim/closed/talk.hpp>
#include <rota/sim/knowledge.hpp>
#include <rota/team/monitors/literal.hpp>
#include <rota/team/wire.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace rota::sim::closed {

/// A `rota::robot`, whole, with a monitor of choice: who acts first, and talks then.
template <class Monitor>
class robot_coordinator {
public:
  /// With a stamp policy, what it has seen goes beside each plan message.
  struct message {
    rota::message<names> said;
    std::optional<testimony> beside;
  };

  robot_coordinator(post const& p, instant now)
      : self_(p.self),
        book_(p.book),
        members_(p.members),
        stamp_(p.rules.stamp),
        mind_(make(p)),
        told_(p.robots),
        leapt_(now) {
    mind_.enter(book_->type, now);
  }

  void tick(perceived const& seen, instant now) {
    if (stamp_) {
      if (mine_ && distance(mine_->self, seen.robots[self_]) >= knowledge::leap) leapt_ = now;
      mine_ = testimony{{}, seen.robots[self_], seen.ball, seen.blind, now - leapt_ <= knowledge::doubt};
      mind_.set_confidence(stamp_(knowledge{self_, now, seen, mine_->relocated, told_, *book_, *members_, space_}));
    }
    (void)mind_.deliberate(book_->type, *members_, seen, now, space_);
  }
  void receive(message const& m, instant now) {
    if (mind_.receive(m.said, now).verdict != verdict::accepted || !m.beside) return;
    auto& told = told_[std::get<plan_message<names>>(m.said).sender.value - 1];
    told = m.beside;
    told->heard = now;
  }
  [[nodiscard]] std::optional<message> next_message(instant now) {
    auto said = mind_.next_message(now);
    if (!said) return std::nullopt;
    bool const plan = std::holds_alternative<plan_message<names>>(*said);
    return message{*std::move(said), plan ? mine_ : std::nullopt};
  }
  [[nodiscard]] instant next_due() const { return mind_.next_due(); }
  [[nodiscard]] allocation_atoms<names> const& believed() const { return mind_.believes(book_->type.id())->atoms(); }
  /// Whether it leads, so that a game counts reigns.
  [[nodiscard]] bool reigns() const { return mind_.rule(book_->type.id())->leading(); }
  [[nodiscard]] static std::size_t bytes(message const& m) {
    std::array<std::byte, 512> buffer{};
    return encode(m.said, buffer).value() + (m.beside ? 1 + bytes_of(m.beside->self) + bytes_of(m.beside->ball) : 0);
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

  std::size_t self_;
  playbook const* book_;
  team<names> const* members_;
  stamp_function stamp_;
  rota::robot<names, Monitor> mind_;
  std::vector<std::optional<testimony>> told_;
  std::optional<testimony> mine_;
  instant leapt_;  // when it last began to believe that it is elsewhere, or to look
  workspace space_;
};

}  // namespace rota::sim::closed
