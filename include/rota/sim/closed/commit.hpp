#pragma once

#include <rota/sim/closed/talk.hpp>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rota::sim::closed {

/// Commit before acting, in the manner of STEAM: M. Tambe, "Towards flexible teamwork", JAIR 7 (1997), section 3.1, establishing
/// commitments. The team leader requests a change from all, each confirms, and only when the leader has heard everybody does
/// it say that the team is committed, and does anybody act on it.
///
/// The leader is the greatest robot that is on. It sees with the eyes of all (the median of where they see the ball): STEAM has
/// members tell what ends a commitment. Requests are repeated every deliberation until all have confirmed; who falls silent is
/// not waited for any longer. A request that the leader does not want any more is void.
class commit_coordinator {
public:
  /// Names a change: greater ones are newer.
  struct round {
    std::uint64_t number = 0;
    std::size_t leader = 0;
    friend auto operator<=>(round const&, round const&) = default;
  };
  struct change {
    round id;
    allocation_atoms<names> atoms;
  };
  struct message {
    heading head;
    point ball;
    std::optional<change> request;
    std::optional<change> committed;  ///< what the leader acts on, which it repeats while it requests nothing
    std::optional<round> confirms;
  };

  commit_coordinator(post const& p, instant now) : talk_(p, now), confirmed_(p.robots) {}

  void tick(perceived const& seen, instant now) {
    talk_.see(seen);
    if (!leads(now)) {
      request_.reset();
      return;
    }
    perceived view = seen;
    view.ball = talk_.median_ball(now);
    auto next = talk_.choose(view, committed_.atoms, now);
    if (next == committed_.atoms) {
      request_.reset();
    } else if (!request_ || request_->atoms != next) {
      request_ = change{{++latest_, talk_.self()}, std::move(next)};
      confirmed_.assign(confirmed_.size(), false);
    }
    if (request_) talk_.pace().note_news(1);
    conclude(now);
  }
  void receive(message const& m, instant now) {
    if (!talk_.roll().hear(m.head, now)) return;
    talk_.note_ball(m.head.sender, m.ball);
    for (auto const* c : {&m.request, &m.committed})
      if (*c) latest_ = (std::max)(latest_, (*c)->id.number);
    if (request_ && m.confirms == request_->id) {
      confirmed_[m.head.sender] = true;
      conclude(now);
    }
    if (talk_.roll().greatest(now) != m.head.sender) return;
    if (m.request && confirms_ != m.request->id) {
      confirms_ = m.request->id;
      talk_.pace().note_news();
    }
    if (m.committed) committed_ = *m.committed;
  }
  [[nodiscard]] std::optional<message> next_message(instant now) {
    if (!talk_.pace().take(now)) return std::nullopt;
    message m{talk_.next_heading(now), *talk_.ball(talk_.self()), {}, {}, {}};
    if (leads(now)) {
      m.request = request_;
      if (!request_) m.committed = committed_;
    } else if (confirms_ != committed_.id) {
      m.confirms = confirms_;
    }
    return m;
  }
  /// It says nothing before it has seen anything.
  [[nodiscard]] instant next_due() const { return talk_.ball(talk_.self()) ? talk_.pace().next_due() : never; }
  [[nodiscard]] allocation_atoms<names> const& believed() const { return committed_.atoms; }
  [[nodiscard]] bool leads(instant now) const { return talk_.roll().greatest(now) == talk_.self(); }
  /// The change that the robot acts on, and the last one that it has confirmed.
  [[nodiscard]] round acts_on() const { return committed_.id; }
  [[nodiscard]] std::optional<round> confirmed() const { return confirms_; }
  [[nodiscard]] static std::size_t bytes(message const& m) {
    auto const of_round = [](round const& r) { return bytes_of(r.number) + bytes_of(r.leader); };
    auto const of_change = [&](std::optional<change> const& c) { return c ? of_round(c->id) + bytes_of(c->atoms) : 0; };
    return bytes_of(m.head) + bytes_of(m.ball) + of_change(m.request) + of_change(m.committed) +
           (m.confirms ? of_round(*m.confirms) : 0);
  }

private:
  void conclude(instant now) {
    if (!request_) return;
    for (std::size_t i = 0; i < confirmed_.size(); ++i)
      if (i != talk_.self() && talk_.roll().on(i, now) && !confirmed_[i]) return;
    committed_ = *std::exchange(request_, std::nullopt);
    talk_.pace().note_news();
  }

  talker talk_;
  std::optional<change> request_;  // of the leader
  std::vector<bool> confirmed_;    // by whom
  std::optional<round> confirms_;
  change committed_;
  std::uint64_t latest_ = 0;
};

}  // namespace rota::sim::closed
