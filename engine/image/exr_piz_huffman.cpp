#include "image/exr_piz_huffman.h"

#include <algorithm>
#include <cstring>

namespace shoal {
namespace {

constexpr std::size_t kHeaderBytes = 20;
constexpr std::uint32_t kSymbols = 65537;  // every 16-bit value, and one more for runs

// A round decodes this many symbols of each stretch from one fetch of bits.
constexpr std::size_t kPerRound = 4;
constexpr std::uint32_t kSpecials = 0x700;  // of a sum of entries: how many are special
static_assert(kPerRound * ExrHuffmanCode::kTableBits <= BitString::kFetched);
constexpr std::uint64_t kRoundBits = 64;  // a fetch reads as many; a round moves on by less

// Fewer bits than this are not worth cutting.
constexpr std::uint64_t kWorthCutting = 1 << 14;
// It takes some dozens of codes to fall into step; who has not by then is left aside.
constexpr int kStepsToMeet = 1 << 12;

std::uint32_t read_u32(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) {
    value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
  }
  return value;
}

// Where decoding has come to, and how far it may go.
struct Stretch {
  std::uint64_t position = 0;  // of the next code
  std::uint64_t end = 0;       // where it need not go on
  std::uint16_t* out = nullptr;
  std::uint16_t* out_end = nullptr;

  // Rounds that end before `end` and `out_end` whatever the codes are.
  [[nodiscard]] std::size_t safe_rounds() const {
    if (position >= end) return 0;
    return std::min<std::size_t>((end - position) / kRoundBits,
                                 static_cast<std::size_t>(out_end - out) / kPerRound);
  }
};

// Decodes rounds of `kCount` stretches side by side until a special entry turns up. Returns, in
// byte i, whether stretch i has one next (not 0). Precondition: 1 <= rounds <= safe_rounds().
template <std::size_t kCount>
std::uint32_t decode_rounds(const ExrHuffmanCode::Entry* table, BitString bits,
                            Stretch* const* stretches, std::size_t rounds) {
  constexpr int kUnused = 64 - ExrHuffmanCode::kTableBits;
  // Plain variables, which stay in registers.
  std::array<std::uint64_t, kCount> position;
  std::array<std::uint16_t*, kCount> out;
  std::array<std::uint32_t, kCount> sums;
  for (std::size_t i = 0; i < kCount; ++i) {
    position[i] = stretches[i]->position;
    out[i] = stretches[i]->out;
  }
  std::size_t at = 0;
  std::uint32_t any = 0;
  do {
    any = 0;
#pragma GCC unroll 4
    for (std::size_t i = 0; i < kCount; ++i) {
      std::uint64_t next = bits.fetch(position[i]);
      // The low bytes of the entries add up: to the lengths, and to how many are special. A special
      // entry has no length, so that all entries after it are the same, and count too.
      sums[i] = 0;
#pragma GCC unroll 4
      for (std::size_t k = 0; k < kPerRound; ++k) {
        const ExrHuffmanCode::Entry entry = table[next >> kUnused];
        next <<= entry & 63;
        sums[i] += entry;
        // Volatile, or GCC gathers four symbols in a word with more instructions than four stores:
        // 51 ms for a 4096x2048 half picture instead of 45.
        const_cast<volatile std::uint16_t&>(out[i][at + k]) =
            static_cast<std::uint16_t>(entry >> 16);
      }
      position[i] += sums[i] & 0xff;
      any |= sums[i];
    }
    at += kPerRound;
  } while (--rounds > 0 && (any & kSpecials) == 0);
  std::uint32_t specials = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const std::uint32_t special = (sums[i] & kSpecials) >> 8;
    stretches[i]->position = position[i];
    stretches[i]->out = out[i] + at - special;
    specials |= special << (8 * i);
  }
  return specials;
}

using DecodeRounds = std::uint32_t(const ExrHuffmanCode::Entry*, BitString, Stretch* const*,
                                   std::size_t);

// For one stretch more than the index says.
constexpr std::array<DecodeRounds*, PizHuffmanDecoder::kStretches> kDecodeRounds = {
    decode_rounds<1>, decode_rounds<2>, decode_rounds<3>, decode_rounds<4>};

class Decoder {
 public:
  Decoder(const ExrHuffmanCode& code, std::span<const std::byte> bytes)
      : code_(code), bits_(bytes) {}

  [[nodiscard]] bool run_begins_at(std::uint64_t position) const {
    return code_.code_of(bits_.at(position)).is_run;
  }
  // Decodes the stretches side by side, each until it has less than a round before it.
  void decode(std::span<Stretch*> stretches) const;
  // Decodes `stretch` to `end` or a bit further. False if it cannot go on.
  bool decode_alone(Stretch& stretch, std::uint64_t end) const;
  // Goes on with `leader`, which is in step, until it meets `follower`, which was begun at `start`
  // and holds `held` symbols, and takes over what it holds from there on. If they don't meet,
  // `leader` is where it came to. False if it cannot go on.
  bool join(Stretch& leader, const Stretch& follower, std::uint64_t start, std::size_t held) const;

 private:
  bool step(Stretch& stretch) const;
  std::size_t skip(std::uint64_t& position) const;

  const ExrHuffmanCode& code_;
  BitString bits_;
};

void Decoder::decode(std::span<Stretch*> stretches) const {
  while (!stretches.empty()) {
    std::size_t rounds = stretches[0]->safe_rounds();
    for (const Stretch* stretch : stretches) rounds = std::min(rounds, stretch->safe_rounds());
    if (rounds == 0) {
      const auto left =
          std::remove_if(stretches.begin(), stretches.end(),
                         [](const Stretch* stretch) { return stretch->safe_rounds() == 0; });
      stretches = stretches.first(static_cast<std::size_t>(left - stretches.begin()));
      continue;
    }
    std::uint32_t specials =
        kDecodeRounds[stretches.size() - 1](code_.table(), bits_, stretches.data(), rounds);
    for (std::size_t i = 0; specials != 0; ++i, specials >>= 8) {
      Stretch& stretch = *stretches[i];
      if ((specials & 0xff) != 0 && !step(stretch)) stretch.end = stretch.position;
    }
  }
}

// Decodes one code, symbol or run. False, and nothing is changed, if there is no room for it or if
// it is a run of nothing, which is never written. Precondition: a symbol stands before stretch.out.
bool Decoder::step(Stretch& stretch) const {
  const ExrHuffmanCode::Code code = code_.code_of(bits_.at(stretch.position));
  if (!code.is_run) {
    if (stretch.out == stretch.out_end) return false;
    *stretch.out++ = code.symbol;
    stretch.position += code.length;
    return true;
  }
  const std::uint64_t count = bits_.at(stretch.position + code.length) >> 56;
  if (count == 0 || count > static_cast<std::uint64_t>(stretch.out_end - stretch.out)) return false;
  stretch.out = std::fill_n(stretch.out, count, stretch.out[-1]);
  stretch.position += code.length + 8;
  return true;
}

// Passes a code; returns how many symbols it stands for.
std::size_t Decoder::skip(std::uint64_t& position) const {
  const ExrHuffmanCode::Code code = code_.code_of(bits_.at(position));
  position += code.length;
  if (!code.is_run) return 1;
  const std::uint64_t count = bits_.at(position) >> 56;
  position += 8;
  return count;
}

bool Decoder::decode_alone(Stretch& stretch, std::uint64_t end) const {
  stretch.end = end;
  Stretch* alone = &stretch;
  decode({&alone, 1});
  while (stretch.position < end) {
    if (!step(stretch)) return false;
  }
  return true;
}

bool Decoder::join(Stretch& leader, const Stretch& follower, std::uint64_t start,
                   std::size_t held) const {
  // The follower's way once more, without symbols: how many it passed before the two met. Out of
  // step it may have come upon a code that let it go no further.
  std::size_t passed = 0;
  for (int steps = 0; steps < kStepsToMeet && start <= follower.position; ++steps) {
    // A run repeats the symbol before it, which the follower need not have had right.
    if (leader.position == start && !run_begins_at(start)) {
      const std::size_t taken = held - passed;
      if (taken > static_cast<std::size_t>(leader.out_end - leader.out)) return false;
      leader.out = std::copy(follower.out - taken, follower.out, leader.out);
      leader.position = follower.position;
      return true;
    }
    if (leader.position > start) {
      passed += skip(start);
    } else if (!step(leader)) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool PizHuffmanDecoder::decode(std::span<const std::byte> packed,
                               std::span<std::uint16_t> symbols) {
  if (packed.size() < kHeaderBytes || symbols.empty()) return false;
  const std::uint32_t first = read_u32(packed, 0);
  const std::uint32_t last = read_u32(packed, 4);
  const std::uint64_t bit_count = read_u32(packed, 12);  // at 8: the size of the code, not needed
  if (first > last || last >= kSymbols) return false;
  std::span<const std::byte> rest = packed.subspan(kHeaderBytes);
  const auto code_bytes = code_.read(rest, first, last);
  if (!code_bytes) return false;
  rest = rest.subspan(*code_bytes);
  if (bit_count > std::uint64_t{8} * rest.size()) return false;
  return decode_bits(rest.first((bit_count + 7) / 8), bit_count, symbols);
}

bool PizHuffmanDecoder::decode_bits(std::span<const std::byte> bytes, std::uint64_t bit_count,
                                    std::span<std::uint16_t> symbols) {
  const Decoder decoder(code_, bytes);
  if (decoder.run_begins_at(0)) return false;  // of which symbol?
  const std::size_t count = bit_count < kWorthCutting ? 1 : kStretches;
  // With one more symbol in front of each, which a run may repeat.
  scratch_.resize_uninitialised((count - 1) * (symbols.size() + 1));
  std::array<std::uint16_t*, kStretches> begins{symbols.data()};
  std::array<Stretch, kStretches> stretches;
  std::array<Stretch*, kStretches> running;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) {
      begins[i] = scratch_.data() + (i - 1) * (symbols.size() + 1) + 1;
      begins[i][-1] = 0;
    }
    stretches[i] = {bit_count * i / count, bit_count * (i + 1) / count, begins[i],
                    begins[i] + symbols.size()};
    running[i] = &stretches[i];
  }
  decoder.decode(std::span(running).first(count));

  Stretch& leader = stretches[0];
  for (std::size_t i = 1; i < count; ++i) {
    const std::uint64_t start = bit_count * i / count;
    const auto held = static_cast<std::size_t>(stretches[i].out - begins[i]);
    if (!decoder.decode_alone(leader, start)) return false;
    if (!decoder.join(leader, stretches[i], start, held)) return false;
  }
  return decoder.decode_alone(leader, bit_count) && leader.position == bit_count &&
         leader.out == leader.out_end;
}

}  // namespace shoal
