#pragma once

#include "playground.hpp"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

/// Robots that share a radio without delay or loss, each deliberating every 30 ms and speaking every 100 ms.
struct pitch {
  playground& fixture;
  std::vector<robot> robots;
  std::vector<view> views;
  rota::instant now = start;
  std::map<int, int> detections, reigns;

  pitch(playground& f, std::vector<view> what_they_see, rota::robot_options options = {})
      : fixture(f), views(std::move(what_they_see)) {
    for (std::size_t i = 0; i < views.size(); ++i) {
      options.first_message = start + rota::milliseconds(static_cast<std::int64_t>(37 * i));
      robots.push_back(f.in_play(static_cast<int>(i) + 1, options));
    }
  }
  void step() {
    now += rota::milliseconds(1);
    for (std::size_t i = 0; i < robots.size(); ++i) {
      if ((now.ns / 1'000'000) % 30 == static_cast<std::int64_t>(i * 7 % 30)) {
        auto const d = fixture.think(robots[i], views[i], now);
        detections[static_cast<int>(i) + 1] += d.detected.has_value();
        reigns[static_cast<int>(i) + 1] += d.reign_began;
      }
      while (auto m = robots[i].next_message(now))
        for (auto& other : robots)
          if (&other != &robots[i]) {
            EXPECT_NE(other.receive(*m, now).verdict, rota::verdict::refused);
          }
    }
  }
  void run(rota::duration d) {
    for (auto const until = now + d; now < until;) step();
  }
  bool agreed() const {
    for (auto const& r : robots)
      if (r.believes(play_id)->atoms() != robots[0].believes(play_id)->atoms()) return false;
    return true;
  }
};
