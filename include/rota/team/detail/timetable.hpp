#pragma once

#include <rota/core/time.hpp>
#include <rota/team/decision.hpp>

#include <algorithm>

namespace rota::detail {

/// When a robot sends plan messages: on a grid of `message_period` from `first_message` on, however late it is asked, and a
/// slot that was missed is not made up for. With `change_period`, what is new is said that soon after the last message.
class timetable {
public:
  explicit timetable(robot_options const& options)
      : period_(options.message_period),
        grid_(options.first_message),
        change_period_(options.change_period),
        slot_(options.first_message) {}

  [[nodiscard]] instant next_due() const noexcept {
    bool const hurried = changed_ && change_period_ > duration{};
    return hurried ? (std::min)(slot_, spoke_ + change_period_) : slot_;
  }
  /// Something in the next message is new.
  void note_change(bool changed = true) noexcept { changed_ = changed_ || changed; }
  /// A message goes out.
  void sent(instant now) noexcept {
    if (now >= slot_) slot_ = slot_after(now);
    spoke_ = now;
    changed_ = false;
  }
  /// The next slot is one period away at most, wherever the grid began.
  void keep_up(instant now) noexcept {
    if (slot_ - now > period_) slot_ = slot_after(now - nanoseconds(1));
  }
  /// The clock shows `now`, which is d after what it would have shown.
  void shift(instant now, duration d) noexcept {
    spoke_ += d;
    slot_ = slot_after(now);
  }

  template <class Digest>
  void digest_into(Digest& d) const {
    d(slot_);
    if (change_period_ > duration{}) d(spoke_, changed_);
  }
  friend bool operator==(timetable const&, timetable const&) = default;

private:
  /// The first slot after an instant.
  [[nodiscard]] instant slot_after(instant after) const noexcept {
    auto const past = (after.ns % period_.ns - grid_.ns % period_.ns + 2 * period_.ns) % period_.ns;
    return after + nanoseconds(period_.ns - past);
  }

  duration period_;
  instant grid_;
  duration change_period_;
  instant slot_;          // the next one
  instant spoke_{};       // when the last message was sent
  bool changed_ = false;  // something in the next message is new
};

}  // namespace rota::detail
