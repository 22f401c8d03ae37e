#pragma once

#include <rota/sim/closed/talk.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rota::sim::closed {

/// An auction without auctioneer: H.-L. Choi, L. Brunet, J. P. How, "Consensus-based decentralized auctions for robust task
/// allocation", IEEE Trans. Robotics 25(4) (2009): CBBA with bundles of one task, so CBAA with the decision rules of table I.
///
/// Each robot keeps for each slot of a task the greatest bid and who made it, and when it heard last of each robot, counted in
/// that robot's messages. It bids what a task pays as it sees the world, by the utilities that all use, and acts at once. The
/// world moves, so at each deliberation a robot renews its bid for its own slot, and moves where it would be paid clearly more:
/// by the plan's hysteresis, as everywhere. The slots of whoever falls silent are open again.
/// @pre the book has one plan
class auction_coordinator {
public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// Of one slot: the winner, and its bid.
  struct award {
    std::size_t winner = none;
    micrometres bid = 0;
    friend bool operator==(award const&, award const&) = default;
  };
  struct message {
    heading head;
    std::vector<award> awards;
    std::vector<std::uint64_t> heard;  ///< of each robot, its last message that this takes into account
  };

  auction_coordinator(post const& p, instant now) : post_(p), talk_(p, now), heard_(p.robots) {
    plan_sketch const& plan = p.book->plans.front();
    margin_ = metres(plan.hysteresis);
    // Needed slots pay a bonus, or two or three robots would leave them open.
    for (bool const needed : {true, false})
      for (auto const& t : plan.tasks) {
        auto const most = (std::min<std::uint64_t>)(t.bounds.upper(), p.robots);
        for (std::uint64_t k = needed ? 0 : t.bounds.lower(); k < (needed ? t.bounds.lower() : most); ++k)
          slots_.push_back({{p.agent(), plan.id, t.id}, home_of_task(*p.book, plan.id, t.id), needed});
      }
    awards_.resize(slots_.size());
  }

  void tick(perceived const& seen, instant now) {
    seen_ = seen;
    talk_.see(seen);  // a ball elsewhere is another bid
    for (award& a : awards_)
      if (a.winner != none && !talk_.roll().on(a.winner, now)) a = {};
    bid();
    note_change();
  }
  void receive(message const& m, instant now) {
    if (!talk_.roll().hear(m.head, now)) return;
    std::size_t const k = m.head.sender;
    for (std::size_t j = 0; j < awards_.size(); ++j) decide(j, k, m);
    for (std::size_t i = 0; i < heard_.size(); ++i) heard_[i] = (std::max)(heard_[i], m.heard[i]);
    heard_[k] = stamp_of(m.head);
    if (!seen_.robots.empty()) bid();
    note_change();
  }
  [[nodiscard]] std::optional<message> next_message(instant now) {
    if (!talk_.pace().take(now)) return std::nullopt;
    message m{talk_.next_heading(now), awards_, heard_};
    m.heard[talk_.self()] = stamp_of(m.head);
    return m;
  }
  [[nodiscard]] instant next_due() const { return talk_.pace().next_due(); }
  [[nodiscard]] allocation_atoms<names> const& believed() const { return believed_; }
  [[nodiscard]] std::vector<award> const& awards() const { return awards_; }
  [[nodiscard]] static std::size_t bytes(message const& m) {
    std::size_t n = bytes_of(m.head);
    for (award const& a : m.awards)
      n += 1 + (a.winner == none ? 0 : bytes_of(static_cast<std::uint64_t>(a.bid / 10'000)));
    for (std::uint64_t const h : m.heard) n += bytes_of(h & 0xffffffffU);
    return n;
  }

private:
  struct slot {
    in<names> part;
    std::optional<point> home;  // none: to attack
    bool needed = false;
  };
  static std::uint64_t stamp_of(heading const& h) { return h.life << 32 | h.number; }
  /// Whether bid a of robot i beats bid b of robot k.
  static bool beats(micrometres a, std::size_t i, micrometres b, std::size_t k) { return a != b ? a > b : i < k; }

  /// Table I: what robot i, this one, does about slot j when k says what it believes of it.
  void decide(std::size_t j, std::size_t k, message const& m) {
    award& mine = awards_[j];
    award const& theirs = m.awards[j];
    std::size_t const i = talk_.self();
    std::size_t const zi = mine.winner, zk = theirs.winner;
    auto const newer = [&](std::size_t who) { return m.heard[who] > heard_[who]; };
    auto const greater = [&] { return beats(theirs.bid, zk, mine.bid, zi); };
    if (zk == k) {
      if (zi == i ? greater() : zi == k || zi == none || newer(zi) || greater()) mine = theirs;
    } else if (zk == i) {
      if (zi == k || (zi != i && zi != none && newer(zi))) mine = {};
    } else if (zk != none) {
      if (zi == i) {
        if (newer(zk) && greater()) mine = theirs;
      } else if (zi == k) {
        mine = newer(zk) ? theirs : award{};
      } else if (zi == zk || zi == none) {
        if (newer(zk)) mine = theirs;
      } else if (newer(zk) && (newer(zi) || greater())) {
        mine = theirs;
      } else if (newer(zi) && heard_[zk] > m.heard[zk]) {
        mine = {};
      }
    } else if (zi == k || (zi != i && zi != none && newer(zi))) {
      mine = {};
    }
  }

  [[nodiscard]] micrometres pays(slot const& s) const {
    point const at = seen_.robots[talk_.self()];
    auto const other = pay_options{}.other;
    auto const worth = (std::max<micrometres>)(field_diagonal - distance(at, s.home.value_or(seen_.ball)), 0);
    return (s.home ? worth / other : worth) + (s.needed ? field_diagonal / other : 0);
  }
  /// Renews the bid for one's own slot, and moves to the one that pays most, if that is clearly more.
  void bid() {
    std::size_t const i = talk_.self();
    std::size_t own = none, best = none;
    micrometres most = 0;
    for (std::size_t j = 0; j < slots_.size(); ++j) {
      micrometres const pay = pays(slots_[j]);
      if (awards_[j].winner == i) {
        own = j;
        awards_[j].bid = pay;
      } else if ((awards_[j].winner == none || pay > awards_[j].bid + margin_) && (best == none || pay > most)) {
        best = j;
        most = pay;
      }
    }
    if (best == none || (own != none && most <= awards_[own].bid + margin_)) return;
    if (own != none) awards_[own] = {};
    awards_[best] = {i, most};
  }
  /// Who wins what is news.
  void note_change() {
    allocation_atoms<names> all;
    for (std::size_t j = 0; j < slots_.size(); ++j)
      if (awards_[j].winner != none) {
        auto part = slots_[j].part;
        part.agent = post_.members->agents()[awards_[j].winner];
        all.insert(part);
      }
    if (all == believed_) return;
    believed_ = std::move(all);
    talk_.pace().note_news();
  }

  post post_;
  talker talk_;
  std::vector<slot> slots_;
  std::vector<award> awards_;
  std::vector<std::uint64_t> heard_;
  micrometres margin_ = 0;
  perceived seen_;
  allocation_atoms<names> believed_;
};

}  // namespace rota::sim::closed
