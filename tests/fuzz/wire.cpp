// Any bytes: what `decode` accepts is exactly what `encode` writes. What it refuses, it refuses without a trace.
#include "input.hpp"
#include "pitch.hpp"

#include <algorithm>
#include <vector>

namespace {

template <class V>
void check(std::vector<std::byte> const& bytes) {
  auto const m = rota::decode<V>(bytes);
  if (!m) return;
  std::vector<std::byte> again(bytes.size());
  auto const size = rota::encode(*m, again);
  fuzz::require(bool(size), "what was decoded can be encoded");
  fuzz::require(*size == bytes.size() && again == bytes, "a message has one form");
  fuzz::require(!rota::encode(*m, std::span(again).first(again.size() - 1)), "a buffer too small by one is refused");
  auto const copy = rota::decode<V>(again);
  fuzz::require(copy && *copy == *m, "equal bytes are equal messages");

  std::span const whole(bytes);
  fuzz::require(!rota::decode<V>(whole.first(whole.size() - 1)), "a message without its last byte is refused");
  auto longer = bytes;
  longer.push_back(std::byte{0});
  fuzz::require(!rota::decode<V>(longer), "a message and one byte more is refused");
  for (std::size_t bit = 0; bit < 8 * bytes.size(); bit += 1 + bytes.size() / 16) {
    auto flipped = bytes;
    flipped[bit / 8] ^= std::byte{1} << (bit % 8);
    fuzz::require(!rota::decode<V>(flipped), "a message with a flipped bit is refused");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::vector<std::byte> bytes(size);
  std::transform(data, data + size, bytes.begin(), [](std::uint8_t x) { return std::byte{x}; });
  check<fuzz::pitch>(bytes);
  check<rota::runtime_vocabulary>(bytes);
  // And with the checksum that belongs to them, which no luck would find.
  auto const sum = rota::detail::crc32(bytes);
  for (int k = 0; k < 4; ++k) bytes.push_back(static_cast<std::byte>(sum >> (8 * k)));
  check<fuzz::pitch>(bytes);
  check<rota::runtime_vocabulary>(bytes);
  return 0;
}
