// Any text as a plan file of either format, and as a message in JSON: read or refused with a reason. What is read makes a
// plan, or says why not. A message that is read has bytes that say the same.
#include "input.hpp"
#include "pitch.hpp"

#include <rota/adapters/alica.hpp>
#include <rota/adapters/message_json.hpp>

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace {

namespace alica = rota::alica;

struct nothing {};

void check(std::string_view text, alica::file_kind kind) {
  alica::load_options limits;
  limits.max_entry_points = 64;  // a plan of a thousand tasks takes long to convert, and shows no more
  auto const d = alica::detail::read_document(text, kind, limits);
  fuzz::require(d.kind == kind, "the kind of a file is what its name says");
  for (auto const& x : d.diagnostics) fuzz::require(!x.reason.empty(), "a diagnostic gives a reason");
  fuzz::require(d.format == alica::file_format::none ? d.refused() : true, "a text of neither format is refused");
  if (d.plan && !d.refused()) {
    fuzz::require(!d.plan->entry_points.empty(), "a plan that is read has a task");
    rota::additive_utility<rota::runtime_vocabulary, nothing> const worth = [](auto, auto, nothing const&) {
      return std::optional<double>(0);
    };
    auto const made = alica::to_plan<nothing>(*d.plan, [&](alica::plan const&) { return worth; });
    if (!made) fuzz::require(!made.error().reason.empty(), "a plan that is none says why");
  }
  if (d.plan_type && !d.refused()) fuzz::require(!d.plan_type->plans.empty(), "a plan type that is read has a plan");

  // The same file twice in one folder: one of them loses its ids, and nothing refers to what is not there.
  std::vector<alica::detail::entry> entries;
  for (auto const* name : {"a", "b"}) entries.push_back({name, name, ".", false, false, d});
  alica::detail::check_repeated_ids(entries);
  alica::detail::directory all{entries, limits};
  alica::detail::check_references(entries, all);
  for (auto const& e : entries)
    for (auto const& l : e.content.needed)
      if (!e.content.refused())
        fuzz::require(all.resolve(static_cast<std::size_t>(&e - entries.data()), l, true).has_value(),
                      "what a sound file needs is there");
}

template <class V>
void check_message(std::string_view text) {
  auto const m = rota::read_json<V>(text);
  if (!m) return fuzz::require(!m.error().place.empty() && !m.error().reason.empty(), "a refusal says what and where");
  auto const again = rota::write_json(*m);
  fuzz::require(bool(again), "what was read can be written");
  auto const back = rota::read_json<V>(*again);
  fuzz::require(back && *back == *m, "it reads back");
  std::vector<std::byte> bytes(1 << 14);
  auto const size = rota::encode(*m, std::span(bytes));
  fuzz::require(bool(size), "what was read has bytes");
  auto const decoded = rota::decode<V>(std::span(bytes).first(*size));
  fuzz::require(decoded && *decoded == *m, "the bytes say the same");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  if (size == 0 || size > 1 << 14) return -1;
  constexpr alica::file_kind kinds[] = {
      alica::file_kind::plan,     alica::file_kind::plan_type,        alica::file_kind::task_repository,
      alica::file_kind::role_set, alica::file_kind::role_definitions, alica::file_kind::behaviour};
  // The first byte says of which kind the file is: p, t, k, r, d, b of the corpus, or any other.
  constexpr std::string_view letters = "ptkrdb";
  auto const letter = letters.find(static_cast<char>(data[0]));
  auto const kind = kinds[letter == std::string_view::npos ? data[0] % 6 : letter];
  std::string_view const text{reinterpret_cast<char const*>(data) + 1, size - 1};
  check(text, kind);
  check_message<fuzz::pitch>(text);
  check_message<rota::runtime_vocabulary>(text);
  return 0;
}
