#pragma once

#include <rota/model/role.hpp>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <vector>

namespace rota {

/// The agents that exist, each with its role. Which of them take part in a plan type is a belief of each robot, and not part
/// of the team.
///
/// Class invariant: agents strictly ascending. So nothing depends on the order in which they were added.
template <vocabulary V = runtime_vocabulary>
class team {
public:
  using agent = typename V::agent;

  team() = default;
  /// Agents that may have any task.
  team(std::initializer_list<agent> agents) {
    for (agent a : agents) add(a);
  }

  /// Adds an agent, or gives it another role. O(n).
  team& add(agent a, role<V> r = {}) {
    auto const where = std::lower_bound(agents_.begin(), agents_.end(), a);
    auto const at = where - agents_.begin();
    if (where != agents_.end() && *where == a) {
      roles_[static_cast<std::size_t>(at)] = std::move(r);
    } else {
      agents_.insert(where, a);
      roles_.insert(roles_.begin() + at, std::move(r));
    }
    return *this;
  }

  /// The agents, ascending.
  [[nodiscard]] std::span<agent const> agents() const noexcept { return agents_; }
  [[nodiscard]] std::size_t size() const noexcept { return agents_.size(); }
  [[nodiscard]] bool contains(agent a) const { return std::binary_search(agents_.begin(), agents_.end(), a); }
  /// The role of an agent, or nullptr for a stranger. O(log n).
  [[nodiscard]] role<V> const* role_of(agent a) const {
    auto const where = std::lower_bound(agents_.begin(), agents_.end(), a);
    return where != agents_.end() && *where == a ? &roles_[static_cast<std::size_t>(where - agents_.begin())] : nullptr;
  }
  /// Whether the agent exists and its role permits the task.
  [[nodiscard]] bool permits(agent a, typename V::task t) const {
    auto const* r = role_of(a);
    return r != nullptr && r->permits(t);
  }

  friend bool operator==(team const&, team const&) = default;

private:
  std::vector<agent> agents_;
  std::vector<role<V>> roles_;
};

}  // namespace rota
