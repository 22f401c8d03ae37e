#pragma once

#include "minds.hpp"

#include <string>

namespace explorer {

enum class act : std::uint8_t {
  advance,    ///< time passes: what was under way for too long is lost, the rest is delayed
  tick,       ///< a robot deliberates and says what is due
  deliver,    ///< a message arrives
  duplicate,  ///< … and stays under way
  lose,
  leave,
  enter,
  crash,
  restart,  ///< with a greater incarnation
  restart_same,
  restart_less,
  blind,     ///< it sees nothing valid from now on, or sees again
  confident  ///< its confidence changes
};

/// What may happen, and in how large a world.
struct setting {
  std::string name;
  int robots = 2;
  std::vector<act> acts;  ///< besides advance, tick and deliver
  bool agree = false;     ///< all see the same; otherwise each is sure that it attacks best
  std::size_t types = 1;
  int rounds = 8;          ///< without loss, after which a team has settled
  std::size_t flying = 6;  ///< so many messages are under way at most, before anybody speaks
  int troubles = 1;        ///< so often something happens to a robot
};

constexpr auto step = rota::milliseconds(50);
constexpr auto longest_delay = rota::milliseconds(200);

struct move {
  act what{};
  std::uint8_t which = 0;  ///< a robot, a message under way, or robot + `most_robots` · type
};
constexpr bool of_air(act a) { return a == act::deliver || a == act::duplicate || a == act::lose; }
constexpr bool of_types(act a) { return a == act::leave || a == act::enter; }

/// A message under way.
struct flight {
  message_id what = 0;
  std::uint8_t to = 0;
  bool copied = false;
  rota::instant sent{};
  friend auto operator<=>(flight const& a, flight const& b) {
    return std::tie(a.to, a.sent, a.what) <=> std::tie(b.to, b.sent, b.what);
  }
};

constexpr rota::instant long_past{-1'000'000'000'000}, not_yet{1'000'000'000'000};

/// The last plan message that was taken in.
struct number {
  std::uint64_t incarnation = 0;
  std::uint64_t sequence = 0;
  rota::instant when = long_past;
  friend bool operator<(number const& a, number const& b) {
    return std::tie(a.incarnation, a.sequence) < std::tie(b.incarnation, b.sequence);
  }
};
/// The stamp of its claims, and until when it must stay so.
struct stamp {
  std::uint32_t confidence = 0;
  rota::instant frozen_until = long_past;
};
struct body {
  mind_id mind = 0;
  std::uint64_t incarnation = 5;
  std::uint32_t confidence = 0;
  int troubles = 0;  // how often something has happened to it
  bool alive = true;
  bool blind = false;
  bool was_blind = false;  // at its last deliberation
  bool thought = false;    // it thinks once at each instant
  rota::instant died{};
  std::array<number, most_robots> heard{};
  std::array<stamp, most_types> stamps{};
  std::array<std::uint32_t, most_types> disputes{};  // who said last that without a leader the conflict would be back
};
/// What is known of a claim.
struct note {
  claim_id name = 0;
  std::uint8_t answered = 0;                     // by whom, a bit each
  rota::instant end = long_past;                 // of the reign, at the leader
  std::array<rota::instant, most_robots> heard;  // when it ends, by all that each robot has heard of it in this life
  std::array<rota::instant, most_robots>
      floor;  // … at the earliest: no copy ends it `max_delay` before the first one's end
};

}  // namespace explorer
