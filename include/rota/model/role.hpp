#pragma once

#include <rota/core/assert.hpp>
#include <rota/core/finite.hpp>
#include <rota/core/vocabulary.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace rota {

/// A role gives each task a priority. A negative priority forbids the task. (Role restrictions: prose of section 3.)
///
/// A task without a priority of its own has the default priority.
template <vocabulary V = runtime_vocabulary>
class role {
public:
  using task = typename V::task;

  /// Permits every task, at priority 0.
  role() = default;
  /// @pre not NaN
  explicit role(double default_priority) : default_priority_(default_priority) {
    ROTA_ASSERT(!detail::is_nan(default_priority));
  }

  /// Sets one priority; for each task the last call counts. O(number of tasks). @pre not NaN
  role& prioritise(task t, double priority) {
    ROTA_ASSERT(!detail::is_nan(priority));
    auto const where = find(t);
    if (where != priorities_.end() && where->first == t) {
      where->second = priority;
    } else {
      priorities_.insert(where, {t, priority});
    }
    return *this;
  }
  role& forbid(task t) { return prioritise(t, -1.0); }

  /// O(log number of tasks).
  [[nodiscard]] double priority(task t) const {
    auto const where = std::lower_bound(priorities_.begin(), priorities_.end(), t,
                                        [](auto const& entry, task key) { return entry.first < key; });
    return where != priorities_.end() && where->first == t ? where->second : default_priority_;
  }
  [[nodiscard]] bool permits(task t) const { return priority(t) >= 0; }

  friend bool operator==(role const&, role const&) = default;

private:
  auto find(task t) {
    return std::lower_bound(priorities_.begin(), priorities_.end(), t,
                            [](auto const& entry, task key) { return entry.first < key; });
  }

  std::vector<std::pair<task, double>> priorities_;
  double default_priority_ = 0;
};

}  // namespace rota
