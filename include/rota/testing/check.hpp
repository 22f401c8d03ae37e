#pragma once

#include <rota/testing/law.hpp>

#include <cstdlib>
#include <map>
#include <optional>
#include <string>

namespace rota::testing {

namespace detail {

/// A listener that prints nothing; rapidcheck reports to one.
struct silence final : rc::detail::TestListener {
  void onTestCaseFinished(rc::detail::CaseDescription const&) override {}
  void onShrinkTried(rc::detail::CaseDescription const&, bool) override {}
  void onTestFinished(rc::detail::TestMetadata const&, rc::detail::TestResult const&) override {}
};

/// As `RC_PARAMS` says, but a thousand cases, not a hundred, unless it gives their number.
[[nodiscard]] inline rc::detail::TestParams parameters() {
  auto p = rc::detail::configuration().testParams;
  char const* const given = std::getenv("RC_PARAMS");
  if (given == nullptr || std::string(given).find("max_success") == std::string::npos) p.maxSuccess = 1000;
  return p;
}

[[nodiscard]] inline std::string indented(std::string const& text) {
  std::string r;
  for (char const c : text) r += c == '\n' ? std::string("\n            ") : std::string(1, c);
  return r;
}

/// The shares of interesting cases that the generator did not reach. Fewer than a thousand cases are not judged.
[[nodiscard]] inline std::string tame(law const& l, rc::detail::SuccessResult const& success) {
  std::string complaint;
  if (success.numSuccess < 1000) return complaint;
  for (share const& s : l.reaches) {
    int hits = 0;
    for (auto const& [tags, count] : success.distribution)
      if (std::find(tags.begin(), tags.end(), std::string(s.what)) != tags.end()) hits += count;
    if (hits * 100 >= success.numSuccess * s.percent) continue;
    complaint += "only " + std::to_string(hits) + " of " + std::to_string(success.numSuccess) + " cases were \"" +
                 s.what + "\" instead of " + std::to_string(s.percent) + " %: a generator too tame to test this\n";
  }
  return complaint;
}

}  // namespace detail

/// Tests a law. Returns nothing if it passed. Otherwise returns the text for a person: the law by the name `called`,
/// its equation and the shrunk inputs by name, or that the generator reaches too few interesting cases. Prints nothing.
///
/// Runs as many cases as `RC_PARAMS` says, a thousand if it does not say. `RC_PARAMS="seed=…"` sets the seed; the text
/// repeats it.
[[nodiscard]] inline std::optional<std::string> refutation(law const& l, std::string const& called) {
  using namespace rc::detail;
  auto const params = testing::detail::parameters();
  testing::detail::silence listener;
  TestResult const result = checkTestable(l.property, TestMetadata{}, params, listener);

  std::string why;
  if (result.is<SuccessResult>()) {
    why = testing::detail::tame(l, result.get<SuccessResult>());
    if (why.empty()) return std::nullopt;
  } else if (result.is<FailureResult>()) {
    auto const& failure = result.get<FailureResult>();
    for (auto const& [name, value] : failure.counterExample) why += name + " = " + value + "\n";
    why += failure.description + "\nafter " + std::to_string(failure.numSuccess) + " cases that passed\n";
  } else if (result.is<GaveUpResult>()) {
    auto const& gave_up = result.get<GaveUpResult>();
    why = "gave up after " + std::to_string(gave_up.numSuccess) + " cases: " + gave_up.description + "\n";
  } else {
    why = result.get<Error>().description + "\n";
  }
  why += "RC_PARAMS=\"seed=" + std::to_string(params.seed) + " max_success=" + std::to_string(params.maxSuccess) + "\"";
  return "law         " + called + "\nequation    " + testing::detail::indented(l.equation) + "\nrefuted by  " +
         testing::detail::indented(why);
}

/// The laws of a bundle that do not pass, each with its `refutation`. For use without a test framework.
[[nodiscard]] inline std::map<std::string, std::string> broken_laws(bundle const& b) {
  std::map<std::string, std::string> broken;
  for (law const& l : b.laws())
    if (auto why = refutation(l, b.name() + "." + l.name)) broken.emplace(l.name, *std::move(why));
  return broken;
}

}  // namespace rota::testing
