// Every assignment within the cardinalities, depth first with partial sums; no bound on utility. Set-up turns pair tables
// so that what an agent's choice adds to the choices of a later one lies side by side.

#include "pairwise.hpp"

#include <limits>

namespace peers {
namespace {

/// Whether the number of assignments is at most `most`.
bool few(std::size_t agents, std::size_t slots, double most) {
  double count = 1;
  for (std::size_t a = 0; a < agents && count <= most; ++a) count *= static_cast<double>(slots);
  return count <= most;
}
template <class Instance>
effort of_enumeration(Instance const& in) {
  if (few(in.agents, in.slots(), 1e6)) return effort::quick;
  return few(in.agents, in.slots(), 1e8) ? effort::slow : effort::never;
}

/// @tparam Sums what partial assignments are worth
template <class Sums>
class enumeration : public peer {
public:
  template <class Instance>
  explicit enumeration(Instance const& in)
      : bounds_(in.bounds), agents_(in.agents), sums_(in), count_(in.slots()), slots_(in.agents) {}

  bool solve() override {
    best_ = std::numeric_limits<std::int64_t>::min();
    found_ = false;
    std::size_t needed = 0;
    for (std::size_t s = 0; s < bounds_.slots(); ++s) {
      count_[s] = 0;
      needed += bounds_.lower[s];
    }
    if (needed <= agents_) place(0, 0, needed);
    return found_;
  }

  assignment answer() const override { return answer_; }

private:
  /// @param needed how many agents are still missing to fill the lower bounds; at most as many as are left
  void place(std::size_t a, std::int64_t sum, std::size_t needed) {
    if (a == agents_) {
      if (found_ && sum <= best_) return;
      found_ = true;
      best_ = sum;
      answer_ = slots_;
      return;
    }
    std::size_t const left = agents_ - a - 1;
    for (std::uint32_t s = 0; s < count_.size(); ++s) {
      std::int64_t const u = sums_.at(a, s);
      if (u == forbidden || count_[s] == bounds_.upper[s]) continue;
      std::size_t const still = needed - (count_[s] < bounds_.lower[s] ? 1 : 0);
      if (still > left) continue;
      ++count_[s];
      slots_[a] = s;
      sums_.place(a, s);
      place(a + 1, sum + u, still);
      --count_[s];
    }
  }

  cardinalities bounds_;
  std::size_t agents_;
  Sums sums_;
  std::vector<std::uint32_t> count_;
  assignment slots_;
  assignment answer_;
  std::int64_t best_ = 0;
  bool found_ = false;
};

class additive_sums {
public:
  explicit additive_sums(additive_instance const& in) : m_(in.slots()), utility_(in.utility) {}
  std::int64_t at(std::size_t a, std::size_t s) const { return utility_[a * m_ + s]; }
  void place(std::size_t, std::size_t) {}

private:
  std::size_t m_;
  std::vector<std::int64_t> utility_;
};

/// sum_[a·(n·m) + b·m + t]: what agent b ≥ a earns in slot t, alone and with the agents before a.
class pairwise_sums {
public:
  explicit pairwise_sums(pairwise_instance const& in)
      : n_(in.agents), m_(in.slots()), sum_((n_ + 1) * n_ * m_), pair_(n_ * m_ * n_ * m_) {
    for (std::size_t i = 0; i < n_ * m_; ++i) sum_[i] = in.unary[i];
    for (std::size_t b = 1; b < n_; ++b)
      for (std::size_t a = 0; a < b; ++a)
        for (std::size_t s = 0; s < m_; ++s)
          for (std::size_t t = 0; t < m_; ++t) pair_[((a * m_ + s) * n_ + b) * m_ + t] = in.pair(b, t, a, s);
  }
  std::int64_t at(std::size_t a, std::size_t s) const { return sum_[(a * n_ + a) * m_ + s]; }
  void place(std::size_t a, std::size_t s) {
    std::int64_t const* const now = sum_.data() + a * n_ * m_;
    std::int64_t const* const more = pair_.data() + (a * m_ + s) * n_ * m_;
    std::int64_t* const next = sum_.data() + (a + 1) * n_ * m_;
    for (std::size_t i = (a + 1) * m_; i < n_ * m_; ++i) next[i] = now[i] + more[i];
  }

private:
  std::size_t n_;
  std::size_t m_;
  std::vector<std::int64_t> sum_;
  std::vector<std::int64_t> pair_;
};

[[maybe_unused]] bool const added = add<enumeration<additive_sums>, additive_instance>("enumeration", of_enumeration) &&
                                    add<enumeration<pairwise_sums>, pairwise_instance>("enumeration", of_enumeration);

}  // namespace
}  // namespace peers
