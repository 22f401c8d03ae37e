#pragma once

#include <rota/sim/closed/talk.hpp>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace rota::sim::closed {

/// Arguing before acting, in the manner of CONSA: M. Tambe and H. Jung, "The benefits of arguing in a team", AI Magazine 20(4)
/// (1999). Who would do otherwise than the team opens an argument. Everybody looks again, and answers with its grounds: where it sees the ball.
/// Who opened it judges which grounds are strongest and says what follows; then all act on that.
///
/// Grounds are the stronger the more others are supported by them, and among equals, the nearer the ball was to who saw it.
/// Several arguments at once: the newest, then the one of the greatest robot, goes on. Who was overruled argues again when it
/// has other grounds or claims something else, or after a second. Answers are awaited for a message period.
class argue_coordinator {
public:
  struct argument {
    std::uint64_t number = 0;
    std::size_t opener = 0;
    friend auto operator<=>(argument const&, argument const&) = default;
  };
  struct agreement {
    argument id;
    allocation_atoms<names> atoms;
  };
  struct message {
    heading head;
    point ball;
    std::optional<argument> argues;  ///< it opens this argument, or answers it
    std::optional<agreement> agreed;
  };

  argue_coordinator(post const& p, instant now)
      : talk_(p, now), patience_(p.rules.message_period), answered_(p.robots) {}

  void tick(perceived const& seen, instant now) {
    seen_ = seen;
    talk_.see(seen);
    if (open_ && open_->opener != talk_.self()) {
      if (now - opened_ > 3 * patience_) open_.reset();  // its opener is gone
      if (!std::exchange(looked_, true)) talk_.pace().note_news();
    }
    claim_ = talk_.choose(seen, agreed_.atoms, now);
    if (!open_ && claim_ != agreed_.atoms && !overruled(now)) {
      open_ = argument{++latest_, talk_.self()};
      opened_ = now;
      answered_.assign(answered_.size(), false);
      talk_.pace().note_news();
    }
    conclude(now);
  }
  void receive(message const& m, instant now) {
    if (!talk_.roll().hear(m.head, now)) return;
    talk_.note_ball(m.head.sender, m.ball);
    if (m.agreed && m.agreed->id > agreed_.id) agree(*m.agreed, now);
    if (!m.argues) return;
    latest_ = (std::max)(latest_, m.argues->number);
    if (open_ == *m.argues && open_->opener == talk_.self()) {
      answered_[m.head.sender] = true;
      conclude(now);
    } else if (*m.argues > agreed_.id && (!open_ || *m.argues > *open_)) {
      open_ = *m.argues;
      opened_ = now;
      looked_ = false;
    }
  }
  [[nodiscard]] std::optional<message> next_message(instant now) {
    if (!talk_.pace().take(now)) return std::nullopt;
    bool const speaks = open_ && (looked_ || open_->opener == talk_.self());
    return message{talk_.next_heading(now), seen_.ball, speaks ? open_ : std::nullopt, agreed_};
  }
  /// It says nothing before it has seen anything.
  [[nodiscard]] instant next_due() const { return talk_.ball(talk_.self()) ? talk_.pace().next_due() : never; }
  [[nodiscard]] allocation_atoms<names> const& believed() const { return agreed_.atoms; }
  [[nodiscard]] argument agreed_on() const { return agreed_.id; }
  [[nodiscard]] static std::size_t bytes(message const& m) {
    auto const of = [](argument const& a) { return bytes_of(a.number) + bytes_of(a.opener); };
    return bytes_of(m.head) + bytes_of(m.ball) + (m.argues ? of(*m.argues) : 0) +
           (m.agreed ? of(m.agreed->id) + bytes_of(m.agreed->atoms) : 0);
  }

private:
  [[nodiscard]] bool overruled(instant now) const {
    return overruled_ && now - *overruled_ < seconds(1) && lost_claim_ == claim_ &&
           distance(lost_ball_, seen_.ball) < metres(0.5);
  }
  void agree(agreement const& a, instant now) {
    agreed_ = a;
    if (open_ && *open_ <= a.id) open_.reset();
    if (claim_ == a.atoms) return;
    overruled_ = now;
    lost_claim_ = claim_;
    lost_ball_ = seen_.ball;
  }
  /// Ends an argument of one's own when everybody has answered, or was given the time.
  void conclude(instant now) {
    if (!open_ || open_->opener != talk_.self()) return;
    bool all = true;
    for (std::size_t i = 0; i < answered_.size(); ++i)
      if (i != talk_.self() && talk_.roll().on(i, now) && !answered_[i]) all = false;
    if (!all && now - opened_ < patience_) return;
    perceived view = seen_;
    view.ball = strongest();
    agree({*open_, talk_.choose(view, agreed_.atoms, now)}, now);
    talk_.pace().note_news();
  }
  [[nodiscard]] point strongest() const {
    point best = seen_.ball;
    std::tuple<std::size_t, micrometres> most{0, 0};
    auto const counts = [&](std::size_t i) { return i == talk_.self() || answered_[i]; };
    for (std::size_t i = 0; i < answered_.size(); ++i) {
      if (!counts(i) || !talk_.ball(i)) continue;
      micrometres const seen_from = distance(seen_.robots[i], *talk_.ball(i));
      std::size_t support = 0;
      for (std::size_t j = 0; j < answered_.size(); ++j)
        if (counts(j) && talk_.ball(j) && distance(*talk_.ball(i), *talk_.ball(j)) < metres(1.5)) ++support;
      std::tuple const strength{support, -seen_from};
      if (support > 0 && (std::get<0>(most) == 0 || strength > most)) most = strength, best = *talk_.ball(i);
    }
    return best;
  }

  talker talk_;
  duration patience_;
  perceived seen_;
  allocation_atoms<names> claim_;
  agreement agreed_;
  std::optional<argument> open_;
  instant opened_{};
  bool looked_ = false;  // since it heard of the argument
  std::vector<bool> answered_;
  std::uint64_t latest_ = 0;
  std::optional<instant> overruled_;
  allocation_atoms<names> lost_claim_;
  point lost_ball_;
};

}  // namespace rota::sim::closed
