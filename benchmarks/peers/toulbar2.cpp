// toulbar2 as a process. Set-up is writing its file. The time is the one toulbar2 states, in steps of a millisecond, of
// preprocessing and search without reading the file.
//
// Cardinalities are counters: for each slot and agent a variable that counts the agents up to it in that slot, joined by
// ternary tables. Its own global constraints took 1.5 to 8 times as long. Static order, no preprocessing, full directional
// arc consistency and depth-first search: with its defaults it took 4 to 8 times as long.

#include "process.hpp"
#include "searchable.hpp"

#include <sstream>

namespace peers {
namespace {

/// Writes an instance in the format wcsp: costs to be minimised, below a cost that forbids.
class writer {
public:
  explicit writer(pairwise_instance const& in) : in_(in), domains_(in.agents, in.slots()) {
    for (std::size_t a = 0; a < in.agents; ++a) table({a}, in.unary.data() + a * in.slots(), in.slots());
    for (std::size_t a = 1; a < in.agents; ++a)
      for (std::size_t b = 0; b < a; ++b) table({a, b}, in.pairs.data() + in.table(a, b), in.slots() * in.slots());
    for (std::size_t s = 0; s < in.slots(); ++s) count(s);
  }

  std::string text() const {
    std::ostringstream out;
    out << "allocation " << domains_.size() << ' ' << *std::max_element(domains_.begin(), domains_.end()) << ' '
        << functions_ << ' ' << top_ << '\n';
    for (std::size_t const d : domains_) out << d << ' ';
    std::string all = body_.str();
    for (std::size_t at = 0; (at = all.find(forbidding, at)) != std::string::npos;)
      all.replace(at, 1, std::to_string(top_));
    return out.str() + '\n' + all;
  }

private:
  static constexpr char forbidding = '#';

  void head(std::vector<std::size_t> const& variables, bool otherwise_forbidden, std::size_t tuples) {
    ++functions_;
    body_ << variables.size();
    for (std::size_t const v : variables) body_ << ' ' << v;
    if (otherwise_forbidden) {
      body_ << ' ' << forbidding;
    } else {
      body_ << " 0";
    }
    body_ << ' ' << tuples << '\n';
  }

  /// How much less than the best each entry is worth.
  void table(std::vector<std::size_t> const& variables, std::int64_t const* worth, std::size_t entries) {
    head(variables, false, entries);
    auto const best = *std::max_element(worth, worth + entries);
    top_ += best - *std::min_element(worth, worth + entries);
    for (std::size_t i = 0; i < entries; ++i) {
      if (variables.size() == 2) body_ << i / in_.slots() << ' ';
      body_ << i % in_.slots() << ' ' << best - worth[i] << '\n';
    }
  }

  /// Bounds the number of agents in a slot.
  void count(std::size_t slot) {
    std::size_t const lower = in_.bounds.lower[slot];
    std::size_t const upper = in_.bounds.upper[slot];
    if (lower == 0 && upper >= in_.agents) return;
    std::size_t before = 0;  // the variable that counts: agent 0 itself, at first
    for (std::size_t a = 1; a < in_.agents; ++a) {
      bool const last = a + 1 == in_.agents;
      std::vector<std::size_t> variables{before, a};
      if (!last) {
        variables.push_back(domains_.size());
        domains_.push_back(std::min(upper, a + 1) + 1);
      }
      std::ostringstream tuples;
      std::size_t n = 0;
      for (std::size_t c = 0; c < domains_[before]; ++c)
        for (std::size_t s = 0; s < in_.slots(); ++s) {
          std::size_t const so_far = before == 0 ? (c == slot ? 1 : 0) : c;
          std::size_t const now = so_far + (s == slot ? 1 : 0);
          if (now > upper || (last && now < lower)) continue;
          ++n;
          tuples << c << ' ' << s;
          if (!last) tuples << ' ' << now;
          tuples << " 0\n";
        }
      head(variables, true, n);
      body_ << tuples.str();
      if (!last) before = domains_.size() - 1;
    }
  }

  pairwise_instance const& in_;
  std::vector<std::size_t> domains_;
  std::ostringstream body_;
  std::size_t functions_ = 0;
  std::int64_t top_ = 1;
};

class toulbar2 : public peer_process {
public:
  explicit toulbar2(pairwise_instance const& in) : model_(in), file_(".wcsp", writer(model_.instance).text()) {}

  bool solve() override {
    output_ = output_of("toulbar2 " + file_.path() + " -nopre -svo -k=3 -hbfs: -s");
    return output_.find("Optimum:") != std::string::npos;
  }
  double solve_seconds() const override {
    auto const sentence = output_.substr(output_.rfind("Optimum:"));
    return number_after(sentence, " and ");
  }
  assignment answer() const override {
    auto const at = output_.find('\n', output_.rfind("New solution:"));
    std::istringstream values(output_.substr(at));
    std::vector<std::size_t> slots(model_.order.size());
    for (std::size_t& s : slots) values >> s;
    return model_.original([&](std::size_t a, std::size_t s) { return slots[a] == s; });
  }

private:
  searchable model_;
  problem_file file_;
  std::string output_;
};

effort of_search(pairwise_instance const& in) {
  if (in.agents < 2 || in.agents > 15) return effort::never;  // one agent alone needs no counter
  return in.agents <= 8 ? effort::quick : effort::slow;
}
[[maybe_unused]] bool const added = add<toulbar2>("toulbar2", of_search);

}  // namespace
}  // namespace peers
