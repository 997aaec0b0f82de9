#include "kernels/wavelet.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/wavelet.cpp"
#include <hwy/foreach_target.h>  // compiles this file once a target; must come before highway.h
#include <hwy/highway.h>

#include "kernels/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace shoal::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::ScalableTag<std::uint16_t>;
using Vector = hn::Vec<Lanes>;

struct Samples {
  std::uint16_t first;
  std::uint16_t second;
};
struct Vectors {
  Vector first;
  Vector second;
};

// What a mean and a difference were made of. All arithmetic is modulo 2^16, which gives every
// target the same bits, damaged samples included.
//
// m = floor((a + b) / 2) and d = a - b, both signed.
struct FourteenBits {
  static Samples undone(std::uint16_t mean, std::uint16_t difference) {
    const auto d = static_cast<std::int16_t>(difference);
    const auto a = static_cast<std::uint16_t>(mean + (d & 1) + (d >> 1));
    return {a, static_cast<std::uint16_t>(a - difference)};
  }
  HWY_INLINE static Vectors undone(Vector mean, Vector difference) {
    const Lanes lanes;
    const hn::RebindToSigned<Lanes> signed_lanes;
    const Vector half =
        hn::BitCast(lanes, hn::ShiftRight<1>(hn::BitCast(signed_lanes, difference)));
    const Vector odd = hn::And(difference, hn::Set(lanes, std::uint16_t{1}));
    const Vector a = hn::Add(mean, hn::Add(odd, half));
    return {a, hn::Sub(a, difference)};
  }
};

// With a' = a + 2^15: d = a' - b, and m = floor((a' + b) / 2), plus 2^15 if a' < b.
struct SixteenBits {
  static Samples undone(std::uint16_t mean, std::uint16_t difference) {
    const auto b = static_cast<std::uint16_t>(mean - (difference >> 1));
    return {static_cast<std::uint16_t>(b + (difference ^ 0x8000)), b};
  }
  HWY_INLINE static Vectors undone(Vector mean, Vector difference) {
    const Lanes lanes;
    const Vector b = hn::Sub(mean, hn::ShiftRight<1>(difference));
    return {hn::Add(b, hn::Xor(difference, hn::Set(lanes, std::uint16_t{0x8000}))), b};
  }
};

template <typename Basis>
void undo_pair(std::uint16_t& first, std::uint16_t& second) {
  const Samples pair = Basis::undone(first, second);
  first = pair.first;
  second = pair.second;
}

// The columns [first, width) at one level, where neighbours are `step` samples apart, of two rows
// that are neighbours, or of one row without (`lower` is null).
struct RowPair {
  std::uint16_t* upper;
  std::uint16_t* lower;
};

template <typename Basis>
void undo_plainly(RowPair rows, std::size_t first, std::size_t width, std::size_t distance,
                  std::size_t interleaved) {
  const std::size_t step = distance * interleaved;
  std::size_t x = first;
  for (; x + 2 * distance <= width; x += 2 * distance) {
    for (std::size_t j = 0; j < interleaved; ++j) {
      const std::size_t at = x * interleaved + j;
      if (rows.lower) {
        undo_pair<Basis>(rows.upper[at], rows.lower[at]);
        undo_pair<Basis>(rows.upper[at + step], rows.lower[at + step]);
        undo_pair<Basis>(rows.lower[at], rows.lower[at + step]);
      }
      undo_pair<Basis>(rows.upper[at], rows.upper[at + step]);
    }
  }
  // A last column without a neighbour.
  if ((width & distance) == 0 || !rows.lower) return;
  for (std::size_t j = 0; j < interleaved; ++j) {
    undo_pair<Basis>(rows.upper[x * interleaved + j], rows.lower[x * interleaved + j]);
  }
}

#if HWY_TARGET == HWY_SCALAR

template <typename Basis>
std::size_t undo_vectors(RowPair, std::size_t, std::size_t, std::size_t) {
  return 0;
}

#else

// Moves lanes by `kStep` lanes down or up within groups of 2 kStep.
template <std::size_t kStep>
HWY_INLINE Vector moved_down(Vector v) {
  const Lanes lanes;
  if constexpr (kStep == 1) {
    return hn::BitCast(lanes,
                       hn::ShiftRight<16>(hn::BitCast(hn::Repartition<std::uint32_t, Lanes>(), v)));
  } else if constexpr (kStep == 2) {
    return hn::BitCast(lanes,
                       hn::ShiftRight<32>(hn::BitCast(hn::Repartition<std::uint64_t, Lanes>(), v)));
  } else {
    const hn::Repartition<std::uint8_t, Lanes> bytes;
    return hn::BitCast(lanes, hn::ShiftRightBytes<8>(bytes, hn::BitCast(bytes, v)));
  }
}

template <std::size_t kStep>
HWY_INLINE Vector moved_up(Vector v) {
  const Lanes lanes;
  if constexpr (kStep == 1) {
    return hn::BitCast(lanes,
                       hn::ShiftLeft<16>(hn::BitCast(hn::Repartition<std::uint32_t, Lanes>(), v)));
  } else if constexpr (kStep == 2) {
    return hn::BitCast(lanes,
                       hn::ShiftLeft<32>(hn::BitCast(hn::Repartition<std::uint64_t, Lanes>(), v)));
  } else {
    const hn::Repartition<std::uint8_t, Lanes> bytes;
    return hn::BitCast(lanes, hn::ShiftLeftBytes<8>(bytes, hn::BitCast(bytes, v)));
  }
}

// The neighbours in rows, in groups of 2 kStep lanes of which those of one level are the first
// `kActive` of each half: the others keep what they hold, `as_loaded`.
template <typename Basis, std::size_t kStep, std::size_t kActive>
class AcrossColumns {
 public:
  AcrossColumns() {
    alignas(16) std::uint16_t lower[8];
    alignas(16) std::uint16_t upper[8];
    for (std::size_t i = 0; i < 8; ++i) {
      const bool is_active = i % kStep < kActive;
      const bool is_lower = i % (2 * kStep) < kStep;
      lower[i] = is_active && is_lower ? 0xffff : 0;
      upper[i] = is_active && !is_lower ? 0xffff : 0;
    }
    lower_ = hn::MaskFromVec(hn::LoadDup128(Lanes(), lower));
    upper_ = hn::MaskFromVec(hn::LoadDup128(Lanes(), upper));
  }
  HWY_INLINE Vector undone(Vector v, Vector as_loaded) const {
    const Vectors pair = Basis::undone(v, moved_down<kStep>(v));
    const Vector second = moved_up<kStep>(pair.second);
    if constexpr (kStep == kActive) return hn::IfThenElse(lower_, pair.first, second);
    return hn::IfThenElse(lower_, pair.first, hn::IfThenElse(upper_, second, as_loaded));
  }

 private:
  hn::Mask<Lanes> lower_;
  hn::Mask<Lanes> upper_;
};

// Undoes as many whole vectors of the `size` samples as there are; returns how many samples.
template <typename Basis, std::size_t kStep, std::size_t kActive>
std::size_t undo_vectors_at(RowPair rows, std::size_t size) {
  const Lanes lanes;
  const AcrossColumns<Basis, kStep, kActive> across;
  std::size_t i = 0;
  for (; i + hn::Lanes(lanes) <= size; i += hn::Lanes(lanes)) {
    const Vector upper = hn::LoadU(lanes, rows.upper + i);
    if (!rows.lower) {
      hn::StoreU(across.undone(upper, upper), lanes, rows.upper + i);
      continue;
    }
    const Vector lower = hn::LoadU(lanes, rows.lower + i);
    const Vectors down = Basis::undone(upper, lower);
    hn::StoreU(across.undone(down.first, upper), lanes, rows.upper + i);
    hn::StoreU(across.undone(down.second, lower), lanes, rows.lower + i);
  }
  return i;
}

// The vectors of `width` columns at the finest levels, which are nearly all of the work; returns
// how many columns are done.
template <typename Basis>
std::size_t undo_vectors(RowPair rows, std::size_t width, std::size_t distance,
                         std::size_t interleaved) {
  const std::size_t paired = width / (2 * distance) * (2 * distance);
  if (interleaved == 1) {
    if (distance == 1) return undo_vectors_at<Basis, 1, 1>(rows, paired);
    if (distance == 2) return undo_vectors_at<Basis, 2, 1>(rows, paired);
    if (distance == 4) return undo_vectors_at<Basis, 4, 1>(rows, paired);
  } else if (interleaved == 2) {
    if (distance == 1) return undo_vectors_at<Basis, 2, 2>(rows, 2 * paired) / 2;
    if (distance == 2) return undo_vectors_at<Basis, 4, 2>(rows, 2 * paired) / 2;
  }
  return 0;
}

#endif

template <typename Basis>
void undo_level(std::uint16_t* samples, std::size_t width, std::size_t height, std::size_t distance,
                std::size_t interleaved) {
  const std::size_t row_size = width * interleaved;
  const auto undo_rows = [&](RowPair rows) {
    const std::size_t done = undo_vectors<Basis>(rows, width, distance, interleaved);
    undo_plainly<Basis>(rows, done, width, distance, interleaved);
  };
  std::size_t y = 0;
  for (; y + 2 * distance <= height; y += 2 * distance) {
    std::uint16_t* const upper = samples + y * row_size;
    undo_rows({upper, upper + distance * row_size});
  }
  if ((height & distance) != 0) undo_rows({samples + y * row_size, nullptr});
}

void UndoWavelet(std::uint16_t* samples, std::size_t width, std::size_t height,
                 std::size_t interleaved, std::uint16_t greatest) {
  std::size_t distance = 1;
  while (2 * distance <= std::min(width, height)) distance *= 2;
  while (distance > 1) {
    distance /= 2;
    if (greatest < 1 << 14) {
      undo_level<FourteenBits>(samples, width, height, distance, interleaved);
    } else {
      undo_level<SixteenBits>(samples, width, height, distance, interleaved);
    }
  }
}

}  // namespace shoal::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shoal::kernels {

SHOAL_KERNEL_TABLE(UndoWavelet);

void undo_wavelet(std::uint16_t* samples, std::size_t width, std::size_t height,
                  std::size_t interleaved, std::uint16_t greatest) {
  SHOAL_CALL_KERNEL(UndoWavelet)(samples, width, height, interleaved, greatest);
}

}  // namespace shoal::kernels
#endif
