#pragma once

#include <rota/sim/closed/talk.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace rota::sim::closed {

/// Whose eyes a coordinator trusts.
enum class eyes : unsigned char {
  own,    ///< its own
  pooled  ///< the median of what all say
};

/// A central coordinator: the greatest robot that is on decides for all, as soon as it sees or hears that another allocation
/// is better, and repeats it in each of its messages. The others do as they are told.
///
/// If it falls silent, the next greatest goes on from the last order. Who is switched on listens before it leads. (The bully
/// election of H. Garcia-Molina, "Elections in a distributed computing system", 1982, with heartbeats in place of inquiries.)
template <eyes Eyes>
class central_coordinator {
public:
  struct message {
    heading head;
    std::optional<point> ball;
    std::optional<allocation_atoms<names>> order;
  };

  central_coordinator(post const& p, instant now) : talk_(p, now) {}

  void tick(perceived const& seen, instant now) {
    if constexpr (Eyes == eyes::pooled) talk_.see(seen);
    if (!leads(now)) return;
    perceived view = seen;
    if constexpr (Eyes == eyes::pooled) view.ball = talk_.median_ball(now);
    auto next = talk_.choose(view, atoms_, now);
    if (next == atoms_) return;
    atoms_ = std::move(next);
    talk_.pace().note_news();
  }
  void receive(message const& m, instant now) {
    if (!talk_.roll().hear(m.head, now)) return;
    if (m.ball) talk_.note_ball(m.head.sender, *m.ball);
    if (m.order && talk_.roll().greatest(now) == m.head.sender) atoms_ = *m.order;
  }
  [[nodiscard]] std::optional<message> next_message(instant now) {
    if (!talk_.pace().take(now)) return std::nullopt;
    message m{talk_.next_heading(now), {}, {}};
    if constexpr (Eyes == eyes::pooled) m.ball = talk_.ball(talk_.self());
    if (leads(now)) m.order = atoms_;
    return m;
  }
  [[nodiscard]] instant next_due() const { return talk_.pace().next_due(); }
  [[nodiscard]] allocation_atoms<names> const& believed() const { return atoms_; }
  [[nodiscard]] bool leads(instant now) const { return talk_.roll().greatest(now) == talk_.self(); }
  [[nodiscard]] static std::size_t bytes(message const& m) {
    return bytes_of(m.head) + (m.ball ? bytes_of(*m.ball) : 0) + (m.order ? bytes_of(*m.order) : 0);
  }

private:
  talker talk_;
  allocation_atoms<names> atoms_;
};

}  // namespace rota::sim::closed
