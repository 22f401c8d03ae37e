#pragma once
/// @file
/// Messages as bytes, the same on every machine. docs/protocol.md shows them byte by byte.

#include <rota/core/result.hpp>
#include <rota/team/detail/bytes.hpp>
#include <rota/team/message.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

namespace rota {

/// The version of the form. A receiver refuses every other one whole.
inline constexpr std::uint8_t wire_version = 2;

/// No claim has more: so a receiver's buffers and time are bounded whatever arrives.
inline constexpr std::size_t most_wire_atoms = 256;

/// Why bytes are no message, or a message cannot become bytes.
enum class wire_fault : unsigned char {
  no_room,        ///< encoding: the buffer is too small
  too_many,       ///< more types or atoms than `plan_message::most_types`, `most_wire_atoms`
  unequal_ages,   ///< encoding: a claim with more or fewer ages than atoms
  mixed_plans,    ///< encoding: a claim whose atoms are of two plans
  negative_time,  ///< encoding: a remaining time or an age below 0
  foreign,        ///< the bytes do not begin as rota's do
  version,        ///< another version of the form
  cut_short,      ///< the message ends too early
  too_long,       ///< bytes follow after its end
  checksum,       ///< a bit was flipped on the way
  not_canonical,  ///< a number in more bytes than it needs, an unknown flag, or atoms out of order
  out_of_range    ///< a number that its identifier or field cannot hold
};

/// How an identifier becomes a number, and back: for enumerations, integers, and `strong_id` of them. Specialise it for
/// yours: `static constexpr std::uint64_t most`, `to(id)`, `from(number)`, which is asked for numbers up to `most` only.
/// An optional `is_signed` says that the number is a signed one, zigzag-coded: forms for people show that one.
template <class Id>
struct wire_id;

template <class Id>
  requires std::is_enum_v<Id> || std::integral<Id>
struct wire_id<Id> {
  using rep = typename std::conditional_t<std::is_enum_v<Id>, std::underlying_type<Id>, std::type_identity<Id>>::type;
  static constexpr std::uint64_t most = (std::numeric_limits<std::make_unsigned_t<rep>>::max)();
  static constexpr bool is_signed = std::is_signed_v<rep>;
  [[nodiscard]] static constexpr std::uint64_t to(Id id) noexcept {
    if constexpr (std::is_signed_v<rep>) {
      return detail::zigzag(static_cast<std::int64_t>(id));
    } else {
      return static_cast<std::uint64_t>(id);
    }
  }
  [[nodiscard]] static constexpr Id from(std::uint64_t x) noexcept {
    if constexpr (std::is_signed_v<rep>) {
      return static_cast<Id>(detail::unzigzag(x));
    } else {
      return static_cast<Id>(x);
    }
  }
};
template <class Tag, class Rep>
struct wire_id<strong_id<Tag, Rep>> {
  static constexpr std::uint64_t most = wire_id<Rep>::most;
  static constexpr bool is_signed = wire_id<Rep>::is_signed;
  [[nodiscard]] static constexpr std::uint64_t to(strong_id<Tag, Rep> id) noexcept {
    return wire_id<Rep>::to(id.value);
  }
  [[nodiscard]] static constexpr strong_id<Tag, Rep> from(std::uint64_t x) noexcept { return {wire_id<Rep>::from(x)}; }
};

namespace detail {

inline constexpr std::uint8_t wire_mark = 0xa0;  // the upper half of the first byte; the lower: version·2 + kind
inline constexpr std::uint8_t wire_claim = 1;    // kind; a plan message is 0
enum wire_flag : std::uint8_t { has_place = 1, has_fingerprint = 2, abstains = 4, dissents = 8 };

template <class Id>
constexpr void write(byte_writer& w, Id const& id) noexcept {
  w.number(wire_id<Id>::to(id));
}
template <class Id>
[[nodiscard]] constexpr Id read(byte_reader& r) noexcept {
  return wire_id<Id>::from(r.number(wire_id<Id>::most));
}

template <vocabulary V>
[[nodiscard]] constexpr std::uint8_t flags_of(participation<V> const& p) noexcept {
  return static_cast<std::uint8_t>((p.place ? has_place : 0) | (p.fingerprint ? has_fingerprint : 0) |
                                   (p.stance == stance::abstains ? abstains : 0) |
                                   (p.stance == stance::dissents ? dissents : 0));
}

template <vocabulary V>
[[nodiscard]] result<std::size_t, wire_fault> finish(byte_writer& w, std::span<std::byte> out) noexcept {
  if (w.fits()) w.fixed32(crc32(out.first(w.size())));
  if (!w.fits()) return refused{wire_fault::no_room};
  return w.size();
}

/// Why a message has no form, whatever the buffer.
template <vocabulary V>
[[nodiscard]] constexpr std::optional<wire_fault> unwritable(plan_message<V> const& m) noexcept {
  return m.types.size() > m.most_types ? std::optional(wire_fault::too_many) : std::nullopt;
}
template <vocabulary V>
[[nodiscard]] constexpr std::optional<wire_fault> unwritable(claim<V> const& c) noexcept {
  if (c.atoms.size() > most_wire_atoms) return wire_fault::too_many;
  if (c.ages.size() != c.atoms.size()) return wire_fault::unequal_ages;
  if (c.remaining < duration{}) return wire_fault::negative_time;
  for (std::size_t i = 0; i < c.atoms.size(); ++i) {
    if (!(c.atoms.begin()[i].plan == c.atoms.begin()->plan)) return wire_fault::mixed_plans;
    if (c.ages[i] < duration{}) return wire_fault::negative_time;
  }
  return std::nullopt;
}

[[nodiscard]] constexpr std::uint64_t round_up(duration d, std::int64_t unit) noexcept {
  return static_cast<std::uint64_t>(d.ns / unit + (d.ns % unit != 0 ? 1 : 0));
}

}  // namespace detail

/// Writes a plan message. @return how many bytes; nothing is promised about `out` if it is refused
template <vocabulary V>
[[nodiscard]] result<std::size_t, wire_fault> encode(plan_message<V> const& m, std::span<std::byte> out) noexcept {
  if (auto const fault = detail::unwritable(m)) return refused{*fault};
  detail::byte_writer w(out);
  w.byte(detail::wire_mark | wire_version << 1);
  detail::write(w, m.sender);
  w.number(m.number.incarnation.value);
  w.number(m.number.sequence);
  w.number(m.claims);
  w.number(m.types.size());
  for (participation<V> const& p : m.types) {
    detail::write(w, p.type);
    w.byte(detail::flags_of(p));
    w.number(p.leads);
    if (p.place) {
      detail::write(w, p.place->plan);
      detail::write(w, p.place->task);
      detail::write(w, p.place->state);
    }
    if (p.fingerprint) w.fixed32(*p.fingerprint);
  }
  return detail::finish<V>(w, out);
}

/// Writes a claim: its remaining time in microseconds, rounded down; ages in milliseconds, rounded up, since who is said to
/// have lived longer ago than it did loses nothing but a moment.
template <vocabulary V>
[[nodiscard]] result<std::size_t, wire_fault> encode(claim<V> const& c, std::span<std::byte> out) noexcept {
  if (auto const fault = detail::unwritable(c)) return refused{*fault};
  detail::byte_writer w(out);
  w.byte(detail::wire_mark | wire_version << 1 | detail::wire_claim);
  detail::write(w, c.type);
  detail::write(w, c.leader);
  w.number(c.incarnation.value);
  w.number(c.number);
  w.number(c.version);
  w.number(c.renewals);
  w.number(c.answers);
  w.number(c.stamp.confidence);
  detail::write(w, c.stamp.id);
  w.number(static_cast<std::uint64_t>(c.remaining.ns / 1000));
  w.number(c.atoms.size());
  if (!c.atoms.empty()) detail::write(w, c.atoms.begin()->plan);
  for (std::size_t i = 0; i < c.atoms.size(); ++i) {
    in<V> const& x = c.atoms.begin()[i];
    detail::write(w, x.agent);
    detail::write(w, x.task);
    w.number(detail::round_up(c.ages[i], 1'000'000));
  }
  return detail::finish<V>(w, out);
}

/// Writes a message. At most 30 + 16·types and 50 + 16·atoms bytes, where identifiers and numbers are below 2^14; see
/// docs/protocol.md for what usual ones take. Never allocates. O(bytes).
template <vocabulary V>
[[nodiscard]] result<std::size_t, wire_fault> encode(message<V> const& m, std::span<std::byte> out) noexcept {
  if (auto const* plan = std::get_if<plan_message<V>>(&m)) return encode(*plan, out);
  if (auto const* bid = std::get_if<claim<V>>(&m)) return encode(*bid, out);
  return refused{wire_fault::foreign};
}

namespace detail {

template <vocabulary V>
void read(byte_reader& r, plan_message<V>& m) {
  m.sender = read<typename V::agent>(r);
  m.number.incarnation.value = r.number();
  m.number.sequence = r.number();
  m.claims = r.number();
  auto const count = r.number(plan_message<V>::most_types);
  for (std::uint64_t i = 0; i < count && r.wrong() == byte_reader::fault::none; ++i) {
    participation<V> p;
    p.type = read<typename V::plan_type>(r);
    auto const flags = r.byte();
    if ((flags & ~(has_place | has_fingerprint | abstains | dissents)) != 0 ||
        (flags & (abstains | dissents)) == (abstains | dissents))
      r.fail(byte_reader::fault::not_canonical);
    if ((flags & abstains) != 0) p.stance = stance::abstains;
    if ((flags & dissents) != 0) p.stance = stance::dissents;
    p.leads = r.number();
    if ((flags & has_place) != 0) {
      placement<V> place;
      place.plan = read<typename V::plan>(r);
      place.task = read<typename V::task>(r);
      place.state = read<typename V::state>(r);
      p.place = place;
    }
    if ((flags & has_fingerprint) != 0) p.fingerprint = r.fixed32();
    m.types.push_back(p);
  }
}

template <vocabulary V>
void read(byte_reader& r, claim<V>& c, small_vector<in<V>, 8>& atoms) {
  constexpr auto longest = static_cast<std::uint64_t>((std::numeric_limits<std::int64_t>::max)());
  c.type = read<typename V::plan_type>(r);
  c.leader = read<typename V::agent>(r);
  c.incarnation.value = r.number();
  c.number = r.number();
  c.version = r.number();
  c.renewals = static_cast<std::uint32_t>(r.number((std::numeric_limits<std::uint32_t>::max)()));
  c.answers = static_cast<std::uint32_t>(r.number((std::numeric_limits<std::uint32_t>::max)()));
  c.stamp.confidence = static_cast<std::uint32_t>(r.number((std::numeric_limits<std::uint32_t>::max)()));
  c.stamp.id = read<typename V::agent>(r);
  c.remaining = microseconds(static_cast<std::int64_t>(r.number(longest / 1000)));
  auto const count = r.number(most_wire_atoms);
  auto const plan = count != 0 ? read<typename V::plan>(r) : typename V::plan{};
  for (std::uint64_t i = 0; i < count && r.wrong() == byte_reader::fault::none; ++i) {
    in<V> x;
    x.agent = read<typename V::agent>(r);
    x.plan = plan;
    x.task = read<typename V::task>(r);
    if (!atoms.empty() && !(atoms.back() < x)) r.fail(byte_reader::fault::not_canonical);
    atoms.push_back(x);
    c.ages.push_back(milliseconds(static_cast<std::int64_t>(r.number(longest / 1'000'000))));
  }
}

}  // namespace detail

/// Reads a message, whole or not at all. Each message has one form, so encode ∘ decode is the identity on bytes.
///
/// What it says is still hostile: `robot::receive` judges it. Allocates only for more than 4 types or 8 atoms. O(bytes).
template <vocabulary V>
[[nodiscard]] result<message<V>, wire_fault> decode(std::span<std::byte const> bytes) {
  using fault = detail::byte_reader::fault;
  constexpr std::size_t tail = 4;
  if (bytes.empty()) return refused{wire_fault::cut_short};
  auto const first = static_cast<std::uint8_t>(bytes[0]);
  if ((first & 0xf0) != detail::wire_mark) return refused{wire_fault::foreign};
  if ((first & 0x0f) >> 1 != wire_version) return refused{wire_fault::version};
  if (bytes.size() <= tail) return refused{wire_fault::cut_short};
  detail::byte_reader r(bytes.subspan(1, bytes.size() - 1 - tail));
  plan_message<V> plan;
  message<V> m;
  if ((first & 1) == detail::wire_claim) {
    small_vector<in<V>, 8> atoms;
    claim<V> c;
    detail::read<V>(r, c, atoms);
    if (r.wrong() == fault::none) c.atoms = allocation_atoms<V>::from_ascending(std::move(atoms));
    m = std::move(c);
  } else {
    detail::read<V>(r, plan);
    m = std::move(plan);
  }
  detail::byte_reader sum(bytes.last(tail));
  // A message that lost its end may fail in many ways, the checksum among them: what was read says which.
  if (r.wrong() == fault::cut_short) return refused{wire_fault::cut_short};
  if (sum.fixed32() != detail::crc32(bytes.first(bytes.size() - tail)))
    return refused{r.wrong() == fault::none && r.left() != 0 ? wire_fault::too_long : wire_fault::checksum};
  if (r.wrong() == fault::not_canonical) return refused{wire_fault::not_canonical};
  if (r.wrong() == fault::out_of_range) return refused{wire_fault::out_of_range};
  if (r.left() != 0) return refused{wire_fault::too_long};
  return m;
}

}  // namespace rota
