#pragma once

#include <rota/search/reallocate.hpp>
#include <rota/sim/closed/coordinator.hpp>

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

/// What the other ways of coordinating have in common.
namespace rota::sim::closed {

/// When a robot speaks: every message period, and news as soon as the gap allows, twice.
class pacer {
public:
  pacer() = default;
  pacer(rules const& r, instant first) : period_(r.message_period), gap_(r.gap), slot_(first) {}

  void note_news(int times = 2) { news_ = (std::max)(news_, times); }
  [[nodiscard]] instant next_due() const { return news_ > 0 ? (std::min)(slot_, last_ + gap_) : slot_; }
  /// Whether to speak now; who asks, speaks.
  [[nodiscard]] bool take(instant now) {
    if (now < next_due()) return false;
    news_ = (std::max)(news_ - 1, 0);
    last_ = now;
    slot_ = now + period_;
    return true;
  }

private:
  duration period_{};
  duration gap_{};
  instant slot_{};
  instant last_ = long_ago;
  int news_ = 0;
};

/// Who speaks, in which of its lives, for the which time.
struct heading {
  std::size_t sender = 0;
  std::uint64_t life = 0;
  std::uint64_t number = 0;
  bool ready = true;  ///< it has been on for long enough to lead
};

/// Who is on: whoever was heard within `silence`, and the robot itself.
class attendance {
public:
  attendance() = default;
  explicit attendance(post const& p, instant now)
      : self_(p.self),
        silence_(p.rules.silence),
        ready_(now + 2 * p.rules.message_period),
        members_(p.members),
        known_(p.robots) {}

  /// Notes a message; false if it is no newer than what was heard.
  [[nodiscard]] bool hear(heading const& h, instant now) {
    auto& k = known_[h.sender];
    if (k.heard && (h.life < k.life || (h.life == k.life && h.number <= k.number))) return false;
    k = {now, h.life, h.number, h.ready};
    return true;
  }
  [[nodiscard]] bool on(std::size_t i, instant now) const {
    return i == self_ || (known_[i].heard && now - *known_[i].heard <= silence_);
  }
  [[nodiscard]] std::vector<names::agent> all(instant now) const {
    std::vector<names::agent> who;
    for (std::size_t i = 0; i < known_.size(); ++i)
      if (on(i, now)) who.push_back(members_->agents()[i]);
    return who;
  }
  /// Whether the robot itself may lead: who was just switched on listens for two message periods first.
  [[nodiscard]] bool ready(instant now) const { return now >= ready_; }
  /// The greatest robot that is on and may lead.
  [[nodiscard]] std::optional<std::size_t> greatest(instant now) const {
    for (std::size_t i = known_.size(); i-- > 0;)
      if (on(i, now) && (i == self_ ? ready(now) : known_[i].ready)) return i;
    return std::nullopt;
  }
  [[nodiscard]] std::size_t size() const { return known_.size(); }

private:
  struct record {
    std::optional<instant> heard;
    std::uint64_t life = 0;
    std::uint64_t number = 0;
    bool ready = false;
  };
  std::size_t self_ = 0;
  duration silence_{};
  instant ready_{};
  team<names> const* members_ = nullptr;
  std::vector<record> known_;
};

/// What a robot knows of its mates, says of itself, and would do if it decided alone.
class talker {
public:
  talker(post const& p, instant now) : post_(p), roll_(p, now), pace_(p.rules, p.first_message), balls_(p.robots) {}

  [[nodiscard]] std::size_t self() const { return post_.self; }
  [[nodiscard]] heading next_heading(instant now) { return {post_.self, post_.life, ++number_, roll_.ready(now)}; }
  [[nodiscard]] attendance& roll() { return roll_; }
  [[nodiscard]] attendance const& roll() const { return roll_; }
  [[nodiscard]] pacer& pace() { return pace_; }
  [[nodiscard]] pacer const& pace() const { return pace_; }

  /// Where robot i says that the ball is.
  void note_ball(std::size_t i, point where) { balls_[i] = where; }
  [[nodiscard]] std::optional<point> ball(std::size_t i) const { return balls_[i]; }
  /// Notes what the robot sees itself. That the ball lies elsewhere than it said last is news.
  void see(perceived const& seen) {
    balls_[post_.self] = seen.ball;
    if (!said_ || distance(*said_, seen.ball) > metres(0.5)) {
      said_ = seen.ball;
      pace_.note_news();
    }
  }
  /// The median, in x and in y, of where all who are on say that the ball is.
  [[nodiscard]] point median_ball(instant now) const {
    std::vector<micrometres> x, y;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      if (!balls_[i] || !roll_.on(i, now)) continue;
      x.push_back(balls_[i]->x);
      y.push_back(balls_[i]->y);
    }
    auto const middle = [](std::vector<micrometres>& v) {
      if (v.empty()) return micrometres{0};
      std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
      return v[v.size() / 2];
    };
    return {middle(x), middle(y)};
  }
  /// What these should do, given what they do and how the world looks.
  [[nodiscard]] allocation_atoms<names> choose(perceived const& seen, allocation_atoms<names> const& current,
                                               instant now) {
    auto const who = roll_.all(now);
    problem<names, perceived> p{post_.book->type, *post_.members, seen, std::span(who)};
    p.current = current.atoms();
    return reallocate(p, hysteresis{}, space_).atoms;
  }

private:
  post post_;
  attendance roll_;
  pacer pace_;
  std::vector<std::optional<point>> balls_;
  std::optional<point> said_;
  std::uint64_t number_ = 0;
  workspace space_;
};

// What messages take on the air, if they are written as rota's are: numbers of seven bits a byte, places in centimetres, one
// byte that says what it is, and a checksum of four.

[[nodiscard]] constexpr std::size_t bytes_of(std::uint64_t x) noexcept {
  std::size_t n = 1;
  while ((x >>= 7) != 0) ++n;
  return n;
}
[[nodiscard]] constexpr std::size_t bytes_of(point p) noexcept {
  auto const one = [](micrometres d) { return bytes_of(static_cast<std::uint64_t>((d < 0 ? -d : d) / 10'000 * 2)); };
  return one(p.x) + one(p.y);
}
[[nodiscard]] constexpr std::size_t bytes_of(heading const& h) noexcept {
  return 1 + bytes_of(h.sender) + bytes_of(h.life) + bytes_of(h.number) + 4;
}
[[nodiscard]] inline std::size_t bytes_of(allocation_atoms<names> const& atoms) {
  std::size_t n = 2;  // plan type, how many
  if (!atoms.empty()) n += bytes_of(atoms.begin()->plan.value);
  for (auto const& x : atoms) n += bytes_of(x.agent.value) + bytes_of(x.task.value);
  return n;
}

}  // namespace rota::sim::closed
