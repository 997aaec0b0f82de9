// One zlib stream (RFC 1950 and 1951) while it is inflated: its headers, its ends, and symbols one
// by one. The bulk of the symbols is left to the fast loop of zlib_inflater.cpp, which takes turns
// with this.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "image/deflate_code.h"

namespace shoal {

static_assert(std::endian::native == std::endian::little, "bits are loaded eight bytes at once");

// A round of the fast loop, before which there has to be room for what it may read and write.
inline constexpr std::size_t kSymbolsPerRound = 5;
// Bytes behind an output that inflating may write to: an output that becomes too long is noticed
// after the round. A match has up to 258 bytes, and 31 bytes more are written.
inline constexpr std::size_t kInflateSlack = kSymbolsPerRound * 258 + 31;

// Where the fast loop is in a stream.
struct DeflateCursor {
  static constexpr std::uint64_t kMark = std::uint64_t{1} << 63;

  std::uint8_t* out = nullptr;
  // The input's bit that `bits` began with when it was last filled.
  std::uint64_t position = 0;
  // The bits that come next, the first one lowest. Filling puts kMark above them, which tells by
  // how much they have been shifted since; so a symbol costs no counting.
  std::uint64_t bits = kMark;

  [[nodiscard]] std::uint64_t next_position() const {
    return position + static_cast<unsigned>(std::countl_zero(bits));
  }
  // Makes 56 bits or more valid. Precondition: 8 bytes can be read at the next bit.
  void refill(const std::uint8_t* input) {
    position = next_position();
    std::uint64_t next = 0;
    std::memcpy(&next, input + (position >> 3), sizeof next);
    bits = next >> (position & 7) | kMark;
  }
  void drop(unsigned n) { bits >>= n; }
  std::uint64_t take(unsigned n) {
    const std::uint64_t value = bits & ((std::uint64_t{1} << n) - 1);
    drop(n);
    return value;
  }
};

// A length or a distance is `base` plus the number in the `extra` bits that follow its code.
struct DeflateRange {
  std::uint16_t base;
  std::uint16_t extra;
};

// By symbol, of lengths less 256. The symbols that no encoder uses, lengths 286 and 287 and
// distances 30 and 31, mean what the last used one does: so libdeflate has it.
extern const DeflateRange kDeflateLengths[32];
extern const DeflateRange kDeflateDistances[32];

// Repeats `length` bytes from `distance` before `to`; writes up to 31 bytes more.
void copy_any_match(std::uint8_t* to, std::size_t distance, std::size_t length);
// The same, for the fast loop: the mean length in EXR's chunks is 4 (float) to 20 (half).
SHOAL_INLINE void copy_match(std::uint8_t* to, std::size_t distance, std::size_t length) {
  if (distance < 16 || length > 32) [[unlikely]] {
    return copy_any_match(to, distance, length);
  }
  const std::uint8_t* from = to - distance;
  std::memcpy(to, from, 16);
  std::memcpy(to + 16, from + 16, 16);
}

class DeflateStream {
 public:
  enum class State { header, symbols, checksum, done, damaged };
  using LiteralCode = CodeTable<288 / 2, 11>;
  using DistanceCode = CodeTable<32 / 2, 8>;

  // Begins to inflate `packed` to exactly `out`, which kInflateSlack bytes of room follow.
  void begin(std::span<const std::byte> packed, std::span<std::byte> out);

  // Goes on until the fast loop can take over, or to the end.
  void advance();

  [[nodiscard]] bool is_over() const { return state_ == State::done || state_ == State::damaged; }
  [[nodiscard]] bool is_damaged() const { return state_ == State::damaged; }

  // For the fast loop, which works on a copy of the cursor.
  DeflateCursor cursor;
  void refill(DeflateCursor& at) const { at.refill(input_); }
  // Whether a round neither reads behind the input nor writes behind the slack.
  [[nodiscard]] bool has_room(const DeflateCursor& at) const {
    return at.position < fast_end_ && at.out <= out_end_;
  }
  [[nodiscard]] CodeEntry literal_entry(const DeflateCursor& at) const {
    return literals_.entries[at.bits & LiteralCode::kRootMask];
  }
  // Decodes the symbol that begins with `entry`, which is no literal. Precondition: 48 bits are
  // valid. False: the turn is advance()'s.
  bool decode_other(DeflateCursor& at, CodeEntry entry);

 private:
  using LengthCode = CodeTable<0, 7>;  // whose own lengths have 3 bits

  bool read_header();
  bool read_stored_block();
  bool read_codes();
  bool read_length_code(LengthCode& code);
  bool read_code_lengths(const LengthCode& code, std::span<std::uint8_t> lengths);
  bool set_fixed_codes();
  bool read_symbol();
  bool is_checksum_right();
  void end_block() { state_ = is_last_block_ ? State::checksum : State::header; }
  // Makes 56 bits valid; behind the input's end they are zeros.
  void refill();
  [[nodiscard]] bool has_overread() const { return cursor.next_position() > input_bits_; }

  State state_ = State::damaged;
  bool is_last_block_ = false;
  const std::uint8_t* input_ = nullptr;
  std::uint64_t input_bits_ = 0;  // the checksum follows them, or comes earlier
  std::uint64_t fast_end_ = 0;
  std::uint8_t* out_begin_ = nullptr;
  std::uint8_t* out_end_ = nullptr;
  LiteralCode literals_;
  DistanceCode distances_;
};

SHOAL_INLINE bool DeflateStream::decode_other(DeflateCursor& at, CodeEntry entry) {
  if (entry & kIsLink) {
    entry = literals_.follow(entry, at.bits);
    if (!(entry & kNoLiteral)) {
      *at.out++ = static_cast<std::uint8_t>(payload(entry));
      at.drop(code_length(entry));
      return true;
    }
  }
  at.drop(code_length(entry));
  const unsigned symbol = payload(entry);
  if (symbol == 0) {
    end_block();
    return false;
  }
  const DeflateRange length = kDeflateLengths[symbol];
  const std::size_t bytes = length.base + at.take(length.extra);
  const CodeEntry distance_entry = distances_.find(at.bits);
  at.drop(code_length(distance_entry));
  const DeflateRange range = kDeflateDistances[payload(distance_entry)];
  const std::size_t distance = range.base + at.take(range.extra);
  if (distance > static_cast<std::size_t>(at.out - out_begin_)) {
    state_ = State::damaged;
    return false;
  }
  copy_match(at.out, distance, bytes);
  at.out += bytes;
  return true;
}

}  // namespace shoal
