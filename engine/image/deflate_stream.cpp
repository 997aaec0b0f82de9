#include "image/deflate_stream.h"

#include <libdeflate.h>

#include <algorithm>

namespace shoal {

const DeflateRange kDeflateLengths[32] = {
    {0, 0},   {3, 0},   {4, 0},   {5, 0},   {6, 0},   {7, 0},   {8, 0},   {9, 0},
    {10, 0},  {11, 1},  {13, 1},  {15, 1},  {17, 1},  {19, 2},  {23, 2},  {27, 2},
    {31, 2},  {35, 3},  {43, 3},  {51, 3},  {59, 3},  {67, 4},  {83, 4},  {99, 4},
    {115, 4}, {131, 5}, {163, 5}, {195, 5}, {227, 5}, {258, 0}, {258, 0}, {258, 0}};
const DeflateRange kDeflateDistances[32] = {
    {1, 0},      {2, 0},      {3, 0},      {4, 0},     {5, 1},     {7, 1},     {9, 2},
    {13, 2},     {17, 3},     {25, 3},     {33, 4},    {49, 4},    {65, 5},    {97, 5},
    {129, 6},    {193, 6},    {257, 7},    {385, 7},   {513, 8},   {769, 8},   {1025, 9},
    {1537, 9},   {2049, 10},  {3073, 10},  {4097, 11}, {6145, 11}, {8193, 12}, {12289, 12},
    {16385, 13}, {24577, 13}, {24577, 13}, {24577, 13}};

namespace {

constexpr std::size_t kZlibHeader = 2;
constexpr std::size_t kChecksum = 4;
// A refill takes up to 63 bits, before a round and twice for each of its symbols, and reads 8
// bytes.
constexpr std::uint64_t kRoundInputBits = 63 + kSymbolsPerRound * 2 * 63 + 64;

// RFC 1950: method 8, a window of at most 32 KiB, no preset dictionary, a multiple of 31.
bool is_zlib_header(unsigned first, unsigned second) {
  return (first & 15) == 8 && first >> 4 <= 7 && (second & 32) == 0 &&
         (first * 256 + second) % 31 == 0;
}

}  // namespace

void copy_any_match(std::uint8_t* to, std::size_t distance, std::size_t length) {
  const std::uint8_t* from = to - distance;
  std::uint8_t* const end = to + length;
  if (distance >= 16) {
    do {
      std::memcpy(to, from, 16);
      std::memcpy(to + 16, from + 16, 16);
      to += 32;
      from += 32;
    } while (to < end);
    return;
  }
  if (distance == 1) {
    std::memset(to, *from, length);
    return;
  }
  while (to < end) *to++ = *from++;
}

void DeflateStream::begin(std::span<const std::byte> packed, std::span<std::byte> out) {
  cursor = {};
  state_ = State::damaged;
  is_last_block_ = false;
  if (packed.size() < kZlibHeader + kChecksum) return;
  input_ = reinterpret_cast<const std::uint8_t*>(packed.data());
  if (!is_zlib_header(input_[0], input_[1])) return;
  cursor.position = 8 * kZlibHeader;
  input_bits_ = 8 * (packed.size() - kChecksum);
  fast_end_ = input_bits_ - std::min(kRoundInputBits, input_bits_);
  out_begin_ = cursor.out = reinterpret_cast<std::uint8_t*>(out.data());
  out_end_ = out_begin_ + out.size();
  state_ = State::header;
}

void DeflateStream::advance() {
  for (;;) {
    bool is_sound = true;
    switch (state_) {
      case State::header:
        is_sound = read_header();
        break;
      case State::symbols:
        if (has_room(cursor)) return;
        is_sound = read_symbol();
        break;
      case State::checksum:
        is_sound = is_checksum_right();
        state_ = State::done;
        break;
      case State::done:
      case State::damaged:
        return;
    }
    if (!is_sound) state_ = State::damaged;
  }
}

void DeflateStream::refill() {
  const std::uint64_t position = cursor.next_position();
  const std::uint64_t begin = std::min(position, input_bits_) / 8;
  const std::uint64_t left = input_bits_ / 8 - begin;
  if (left >= 8) return cursor.refill(input_);
  std::uint64_t next = 0;
  std::memcpy(&next, input_ + begin, left);
  cursor.position = position;
  cursor.bits = next >> (position & 7) | DeflateCursor::kMark;
}

bool DeflateStream::read_header() {
  refill();
  is_last_block_ = cursor.take(1) != 0;
  state_ = State::symbols;
  switch (cursor.take(2)) {
    case 0:
      return read_stored_block();
    case 1:
      return set_fixed_codes() && !has_overread();
    case 2:
      return read_codes() && !has_overread();
    default:
      return false;
  }
}

bool DeflateStream::read_stored_block() {
  constexpr std::uint64_t kSizes = 4;
  const std::uint64_t begin = (cursor.next_position() + 7) / 8;
  const std::uint64_t end = input_bits_ / 8;
  if (begin + kSizes > end) return false;
  const std::uint8_t* in = input_ + begin;
  const unsigned size = in[0] | in[1] << 8;
  const unsigned complement = in[2] | in[3] << 8;
  if ((size ^ complement) != 0xffff || begin + kSizes + size > end ||
      out_end_ - cursor.out < std::ptrdiff_t{size}) {
    return false;
  }
  std::copy_n(in + kSizes, size, cursor.out);
  cursor = {cursor.out + size, 8 * (begin + kSizes + size)};
  end_block();
  return true;
}

bool DeflateStream::set_fixed_codes() {
  std::array<std::uint8_t, 288> lengths;
  std::fill_n(lengths.begin(), 144, std::uint8_t{8});
  std::fill_n(lengths.begin() + 144, 112, std::uint8_t{9});
  std::fill_n(lengths.begin() + 256, 24, std::uint8_t{7});
  std::fill_n(lengths.begin() + 280, 8, std::uint8_t{8});
  if (!literals_.build(lengths, CodeUse::literals_and_lengths)) return false;
  std::fill_n(lengths.begin(), 32, std::uint8_t{5});
  return distances_.build(std::span(lengths).first(32), CodeUse::plain);
}

bool DeflateStream::read_codes() {
  const std::size_t literals = 257 + cursor.take(5);
  const std::size_t distances = 1 + cursor.take(5);
  LengthCode code;
  if (!read_length_code(code)) return false;
  std::array<std::uint8_t, 288 + 32> lengths;
  const std::span used = std::span(lengths).first(literals + distances);
  return read_code_lengths(code, used) &&
         literals_.build(used.first(literals), CodeUse::literals_and_lengths) &&
         distances_.build(used.subspan(literals), CodeUse::plain);
}

// The code in which the lengths of the two codes are written, itself given by lengths of 3 bits.
bool DeflateStream::read_length_code(LengthCode& code) {
  static constexpr std::array<std::uint8_t, 19> kOrder = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                          11, 4,  12, 3, 13, 2, 14, 1, 15};
  std::array<std::uint8_t, 19> lengths{};
  const std::size_t count = 4 + cursor.take(4);
  for (std::size_t i = 0; i < count; ++i) {
    if (i % 16 == 0) refill();
    lengths[kOrder[i]] = static_cast<std::uint8_t>(cursor.take(3));
  }
  return code.build(lengths, CodeUse::plain);
}

bool DeflateStream::read_code_lengths(const LengthCode& code, std::span<std::uint8_t> lengths) {
  std::size_t filled = 0;
  while (filled < lengths.size()) {
    refill();
    const CodeEntry entry = code.find(cursor.bits);
    cursor.drop(code_length(entry));
    const unsigned symbol = payload(entry);
    if (symbol < 16) {
      lengths[filled++] = static_cast<std::uint8_t>(symbol);
      continue;
    }
    std::uint8_t repeated = 0;
    std::size_t times = 0;
    if (symbol == 16) {
      if (filled == 0) return false;
      repeated = lengths[filled - 1];
      times = 3 + cursor.take(2);
    } else {
      times = symbol == 17 ? 3 + cursor.take(3) : 11 + cursor.take(7);
    }
    if (times > lengths.size() - filled) return false;
    std::fill_n(lengths.begin() + static_cast<std::ptrdiff_t>(filled), times, repeated);
    filled += times;
  }
  return true;
}

bool DeflateStream::read_symbol() {
  if (cursor.out > out_end_) return false;
  refill();
  const CodeEntry entry = literal_entry(cursor);
  if (entry & kNoLiteral) {
    decode_other(cursor, entry);
    return state_ != State::damaged && !has_overread();
  }
  *cursor.out++ = static_cast<std::uint8_t>(payload(entry));
  cursor.drop(code_length(entry));
  return !has_overread();
}

bool DeflateStream::is_checksum_right() {
  const std::uint8_t* at = input_ + (cursor.next_position() + 7) / 8;
  const std::uint32_t expected = std::uint32_t{at[0]} << 24 | std::uint32_t{at[1]} << 16 |
                                 std::uint32_t{at[2]} << 8 | std::uint32_t{at[3]};
  const auto size = static_cast<std::size_t>(out_end_ - out_begin_);
  return cursor.out == out_end_ && libdeflate_adler32(1, out_begin_, size) == expected;
}

}  // namespace shoal
