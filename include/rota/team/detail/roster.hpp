#pragma once

#include <rota/team/detail/by_agent.hpp>
#include <rota/team/message.hpp>

#include <span>

namespace rota::detail {

/// The other robots that may ever be heard of, and the last plan message of each: its number, and when it was heard.
template <vocabulary V>
class roster {
public:
  using agent_id = typename V::agent;

  struct peer {
    agent_id who{};
    message_number last{};
    instant heard{};  // when that message was accepted

    /// Whether it was not heard for so long, if ever, that it may begin a new life with any number.
    [[nodiscard]] bool forgotten(instant now, duration forget) const {
      return last.incarnation.value == 0 || now - heard > forget;
    }
    friend bool operator==(peer const&, peer const&) = default;
  };

  roster(agent_id self, std::span<agent_id const> everybody) {
    for (agent_id b : everybody)
      if (!(b == self)) peers_.at(b);
  }

  [[nodiscard]] std::size_t size() const noexcept { return peers_.size(); }
  /// O(log roster).
  [[nodiscard]] peer const* find(agent_id b) const { return peers_.find(b); }
  [[nodiscard]] peer* find(agent_id b) { return peers_.find(b); }
  /// Moves all instants by d: the clock has been set.
  void shift(duration d) noexcept {
    for (peer& p : peers_) p.heard = moved(p.heard, d);
  }

  template <class Digest>
  void digest_into(Digest& d) const {
    for (peer const& p : peers_) {
      d(p.who, p.last.incarnation.value);
      if (p.last.incarnation.value != 0) d(p.last.sequence, p.heard);
    }
  }
  friend bool operator==(roster const&, roster const&) = default;

private:
  by_agent<peer, &peer::who, 8> peers_;
};

}  // namespace rota::detail
