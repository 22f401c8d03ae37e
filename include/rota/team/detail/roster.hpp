#pragma once

#include <rota/team/message.hpp>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

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
    friend bool operator==(peer const&, peer const&) = default;
  };

  roster(agent_id self, std::span<agent_id const> everybody) {
    std::vector<agent_id> sorted(everybody.begin(), everybody.end());
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    for (agent_id b : sorted)
      if (!(b == self)) peers_.push_back({b, {}});
  }

  /// O(log roster).
  [[nodiscard]] peer const* find(agent_id b) const {
    auto const where =
        std::lower_bound(peers_.begin(), peers_.end(), b, [](peer const& p, agent_id key) { return p.who < key; });
    return where != peers_.end() && where->who == b ? &*where : nullptr;
  }
  [[nodiscard]] peer* find(agent_id b) { return const_cast<peer*>(std::as_const(*this).find(b)); }
  /// Moves all instants by d: the clock has been set.
  void shift(duration d) noexcept {
    for (peer& p : peers_) p.heard = p.heard + d;
  }

  template <class Digest>
  void digest_into(Digest& d) const {
    for (peer const& p : peers_) d(p.who, p.last.incarnation.value, p.last.sequence, p.heard);
  }
  friend bool operator==(roster const&, roster const&) = default;

private:
  std::vector<peer> peers_;  // ascending by id
};

}  // namespace rota::detail
