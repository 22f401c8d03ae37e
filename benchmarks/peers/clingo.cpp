// clingo as a process. Set-up is writing its program. The time is from what clingo states in milliseconds: of its CPU time
// the share that search has in the time that passed, hence without reading and grounding. Of its configurations and strategies `handy` without restarts was the fastest at 10x5;
// core-guided optimisation did not end.

#include "process.hpp"
#include "searchable.hpp"

#include <sstream>

namespace peers {
namespace {

std::string program(pairwise_instance const& in) {
  std::ostringstream out;
  auto at = [](std::size_t a, std::size_t s) { return "at(" + std::to_string(a) + ',' + std::to_string(s) + ')'; };
  for (std::size_t a = 0; a < in.agents; ++a) {
    out << "1 {";
    for (std::size_t s = 0; s < in.slots(); ++s) out << (s == 0 ? "" : ";") << at(a, s);
    out << "} 1.\n";
  }
  for (std::size_t s = 0; s < in.slots(); ++s) {
    out << ":- not " << in.bounds.lower[s] << " {";
    for (std::size_t a = 0; a < in.agents; ++a) out << (a == 0 ? "" : ";") << at(a, s);
    out << "} " << in.bounds.upper[s] << ".\n";
  }
  for (std::size_t a = 0; a < in.agents; ++a) {
    auto const row = in.unary.begin() + static_cast<std::ptrdiff_t>(a * in.slots());
    auto const best = *std::max_element(row, row + static_cast<std::ptrdiff_t>(in.slots()));
    for (std::size_t s = 0; s < in.slots(); ++s)
      if (best != in.at(a, s)) out << ":~ " << at(a, s) << ". [" << best - in.at(a, s) << ',' << a << ']' << '\n';
  }
  for (std::size_t a = 1; a < in.agents; ++a)
    for (std::size_t b = 0; b < a; ++b)
      for (std::size_t s = 0; s < in.slots(); ++s)
        for (std::size_t t = 0; t < in.slots(); ++t)
          if (auto const loss = -in.pair(a, s, b, t); loss != 0)
            out << ":~ " << at(a, s) << ", " << at(b, t) << ". [" << loss << ',' << a << ',' << b << "]\n";
  return out.str();
}

class clingo : public peer_process {
public:
  explicit clingo(pairwise_instance const& in) : model_(in), file_(".lp", program(model_.instance)) {}

  bool solve() override {
    output_ = output_of("clingo " + file_.path() + " --outf=2 --quiet=1 --config=handy --restarts=no");
    return output_.find("OPTIMUM FOUND") != std::string::npos;
  }
  double solve_seconds() const override {
    double const all = number_after(output_, "\"Total\":");
    return all > 0 ? number_after(output_, "\"CPU\":") * number_after(output_, "\"Solve\":") / all : 0;
  }
  assignment answer() const override {
    auto const model = output_.substr(output_.rfind("\"Value\":"));
    return model_.original([&](std::size_t a, std::size_t s) {
      return model.find("at(" + std::to_string(a) + ',' + std::to_string(s) + ')') != std::string::npos;
    });
  }

private:
  searchable model_;
  problem_file file_;
  std::string output_;
};

effort of_search(pairwise_instance const& in) {
  return in.agents <= 8 ? effort::quick : in.agents <= 10 ? effort::slow : effort::never;
}
[[maybe_unused]] bool const added = add<clingo>("clingo", of_search);

}  // namespace
}  // namespace peers
