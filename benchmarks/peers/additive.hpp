#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

/// Solvers that others wrote, which rota is measured against and checked by. None of these files includes rota, and all
/// of them are C++17, since some headers of peers are no C++20.
namespace peers {

/// Marks a pair that does not exist.
inline constexpr std::int64_t forbidden = -(std::int64_t{1} << 62);

/// How many agents each slot must and can take.
struct cardinalities {
  std::vector<std::uint32_t> lower;
  std::vector<std::uint32_t> upper;

  std::size_t slots() const { return lower.size(); }
};

/// The slot of each agent.
using assignment = std::vector<std::uint32_t>;

/// Maximise the sum of utilities; every agent takes exactly one slot, and where it may idle, idling is a slot.
struct additive_instance {
  std::size_t agents = 0;
  cardinalities bounds;
  std::vector<std::int64_t> utility;  ///< row per agent

  std::size_t slots() const { return bounds.slots(); }
  std::int64_t at(std::size_t agent, std::size_t slot) const { return utility[agent * slots() + slot]; }
  bool present(std::size_t agent, std::size_t slot) const { return at(agent, slot) != forbidden; }
};

/// One solver, set up for one instance: the constructor is the set-up, which is timed by itself.
class peer {
public:
  virtual ~peer() = default;

  /// Leads back to where the set-up ended, where the next `solve` would lean on the last; not timed.
  ///
  /// @return whether this peer has to
  virtual bool rewind() { return false; }
  /// Finds an optimum, starting from nothing each time: this is what is timed.
  ///
  /// @return whether there is one
  virtual bool solve() = 0;
  /// The optimum found last, read from the peer's own structures; not timed.
  virtual assignment answer() const = 0;
};

/// A peer in another process knows better than we do how long its search took.
class peer_process : public peer {
public:
  /// What the peer says its search took.
  virtual double solve_seconds() const = 0;
};

/// What one solve of an instance costs a peer on a machine of the 2020s.
enum class effort : unsigned char {
  quick,  ///< below a tenth of a second: measured again and again
  slow,   ///< measured once
  never   ///< more than half a minute, or no instance of the kind this peer solves
};

/// The name of a peer, how it is made, and what that costs.
template <class Instance>
struct entry {
  char const* name;
  std::unique_ptr<peer> (*make)(Instance const&);
  effort (*needs)(Instance const&);
  bool process;  ///< it is a peer_process
};

/// All peers that are linked in: each unit adds its own, and one whose library is missing is not compiled.
template <class Instance>
std::vector<entry<Instance>>& all() {
  static std::vector<entry<Instance>> entries;
  return entries;
}

/// For the initialiser of a constant of a peer's unit.
template <class Peer, class Instance>
bool add(char const* name, effort (*needs)(Instance const&)) {
  auto const make = [](Instance const& in) -> std::unique_ptr<peer> { return std::make_unique<Peer>(in); };
  all<Instance>().push_back({name, make, needs, std::is_base_of_v<peer_process, Peer>});
  return true;
}

}  // namespace peers
