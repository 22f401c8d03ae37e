#pragma once

#include <rota/sim/knowledge.hpp>
#include <rota/sim/playbook.hpp>
#include <rota/team/robot.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace rota::sim::closed {

/// How often robots speak, and when they believe that one is gone. The same for every way of coordinating.
struct rules {
  duration message_period = milliseconds(100);  ///< nobody is silent for longer
  duration gap = milliseconds(10);              ///< nobody speaks sooner after the last message, whatever is new
  bool news = true;                             ///< `rota` says what is new after the gap, else in its next slot
  duration silence = seconds(1);                ///< who was not heard for longer is believed to be off
  stamp_function stamp;                         ///< of `rota::robot`: how sure it is of its claims, if it says so
  robot_options robot;                          ///< of `rota::robot`: what the three above do not say
};

/// What one robot is given when it is switched on. What it points at outlives it.
struct post {
  std::size_t self = 0;
  std::size_t robots = 0;
  playbook const* book = nullptr;
  team<names> const* members = nullptr;
  closed::rules rules;
  instant first_message{};  ///< on its own clock, like all instants
  std::uint64_t life = 1;   ///< greater each time that it is switched on

  [[nodiscard]] names::agent agent() const { return members->agents()[self]; }
};

/// One robot's way of deciding who does what, all that a game knows of it.
///
/// It sees (`tick`, about every 30 ms), hears (`receive`), says (`next_message`, when it is due), and executes its own part of
/// what it believes. The radio broadcasts a message to everybody; some do not get it. Times are of the robot's own clock.
template <class C>
concept coordinator = std::copyable<C> && std::constructible_from<C, post const&, instant> &&
                      requires(C c, C const& k, perceived const& seen, typename C::message const& m, instant now) {
                        c.tick(seen, now);
                        c.receive(m, now);
                        { c.next_message(now) } -> std::same_as<std::optional<typename C::message>>;
                        { k.next_due() } -> std::same_as<instant>;
                        { k.believed() } -> std::same_as<allocation_atoms<names> const&>;
                        { C::bytes(m) } -> std::convertible_to<std::size_t>;  // what it takes on the air
                      };

/// The home of a task, or nothing if it is to attack. @pre the book has the task
[[nodiscard]] inline std::optional<point> home_of_task(playbook const& book, names::plan plan, names::task task) {
  std::size_t others = 0;
  for (std::size_t i = 0; i < book.plans.size(); ++i) {
    if (book.plans[i].id != plan || book.attacking[i] == task) continue;
    for (auto const& t : book.plans[i].tasks) {
      if (t.id == task) return home_of(others);
      others += t.id == book.attacking[i] ? 0 : 1;
    }
  }
  return std::nullopt;
}

/// Where a robot with this part of an allocation goes, as it sees the world: to the ball, or half the way from the home of its
/// task to its own place in the formation, so that two with one task stand apart.
[[nodiscard]] inline point target_of(playbook const& book, in<names> const& part, perceived const& seen) {
  auto const home = home_of_task(book, part.plan, part.task);
  if (!home) return seen.ball;
  point const both = *home + formation_spot(part.agent.value - 1);
  return {both.x / 2, both.y / 2};
}

}  // namespace rota::sim::closed
