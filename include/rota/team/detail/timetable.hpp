#pragma once

#include <rota/core/time.hpp>
#include <rota/team/decision.hpp>

#include <algorithm>

namespace rota::detail {

/// When a robot sends plan messages: on a grid of `message_period` from `first_message` on, however late it is asked, and a
/// slot that was missed is not made up for. With `change_period`, what is news is said that soon after the last message.
class timetable {
public:
  explicit timetable(robot_options const& options)
      : period_(options.message_period),
        grid_(options.first_message),
        change_period_(options.change_period),
        slot_(options.first_message) {}

  [[nodiscard]] instant next_due() const noexcept {
    return news_ > 0 ? (std::min)(slot_, spoke_ + change_period_) : slot_;
  }
  /// Something is news: it is said twice, since a message may be lost.
  void note_news() noexcept { say(2); }
  /// Somebody believes otherwise: what this robot does is said again.
  void note_disagreement() noexcept { say(1); }
  /// A message goes out.
  void sent(instant now) noexcept {
    if (now >= slot_) slot_ = slot_after(now);
    spoke_ = now;
    if (news_ > 0) --news_;
  }
  /// The next slot is one period away at most, wherever the grid began.
  void keep_up(instant now) noexcept {
    if (slot_ - now > period_) slot_ = slot_after(now - nanoseconds(1));
  }
  /// The clock shows `now`, which is d after what it would have shown.
  void shift(instant now, duration d) noexcept {
    spoke_ = moved(spoke_, d);
    slot_ = slot_ <= now - d ? now : slot_after(now);  // what was due stays due
  }

  template <class Digest>
  void digest_into(Digest& d) const {
    d(slot_);
    if (change_period_ > duration{}) d(spoke_, news_);
  }
  friend bool operator==(timetable const&, timetable const&) = default;

private:
  void say(int times) noexcept {
    if (change_period_ > duration{}) news_ = (std::max)(news_, times);
  }
  /// The first slot after an instant.
  [[nodiscard]] instant slot_after(instant after) const noexcept {
    auto const past = (after.ns % period_.ns - grid_.ns % period_.ns + 2 * period_.ns) % period_.ns;
    return after + nanoseconds(period_.ns - past);
  }

  duration period_;
  instant grid_;
  duration change_period_;
  instant slot_;     // the next one
  instant spoke_{};  // when the last message was sent
  int news_ = 0;     // so many messages shall not wait for their slots
};

}  // namespace rota::detail
