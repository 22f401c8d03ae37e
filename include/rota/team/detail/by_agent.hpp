#pragma once

#include <rota/core/small_vector.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace rota::detail {

/// At most one record for each agent, ascending by agent, which the member `Key` of a record names. Up to N without the heap.
template <class Record, auto Key, std::size_t N>
class by_agent {
public:
  /// The record of b, or nullptr. O(log records).
  template <class Agent>
  [[nodiscard]] Record const* find(Agent const& b) const {
    auto const* const where = lower(b);
    return where != records_.end() && where->*Key == b ? where : nullptr;
  }
  template <class Agent>
  [[nodiscard]] Record* find(Agent const& b) {
    return const_cast<Record*>(std::as_const(*this).find(b));
  }
  /// The record of b; a new one if there is none. O(records).
  template <class Agent>
  Record& at(Agent const& b) {
    if (Record* const r = find(b)) return *r;
    Record fresh;
    fresh.*Key = b;
    return *records_.insert(lower(b), fresh);
  }
  template <class Agent>
  void erase(Agent const& b) {
    if (Record* const r = find(b)) records_.erase(r);
  }
  void clear() noexcept { records_.clear(); }

  [[nodiscard]] std::size_t size() const noexcept { return records_.size(); }
  [[nodiscard]] Record* begin() noexcept { return records_.begin(); }
  [[nodiscard]] Record* end() noexcept { return records_.end(); }
  [[nodiscard]] Record const* begin() const noexcept { return records_.begin(); }
  [[nodiscard]] Record const* end() const noexcept { return records_.end(); }
  friend bool operator==(by_agent const&, by_agent const&) = default;

private:
  template <class Agent>
  [[nodiscard]] Record const* lower(Agent const& b) const {
    return std::lower_bound(records_.begin(), records_.end(), b,
                            [](Record const& r, Agent const& key) { return r.*Key < key; });
  }

  small_vector<Record, N> records_;
};

}  // namespace rota::detail
