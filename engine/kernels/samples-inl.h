// Loading samples of every type into float vectors. Included once a SIMD target.
#if defined(SHOAL_KERNELS_SAMPLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SHOAL_KERNELS_SAMPLES_INL_H_
#undef SHOAL_KERNELS_SAMPLES_INL_H_
#else
#define SHOAL_KERNELS_SAMPLES_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstdint>
#include <cstring>

#include "core/aligned_buffer.h"
#include "core/row_band.h"

HWY_BEFORE_NAMESPACE();
namespace shoal::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Sixteen virtual lanes, whatever the target: two vectors of eight, four of four, sixteen of one.
inline constexpr std::size_t kVirtualLanes = 16;
using FloatTag = HWY_CAPPED(float, kVirtualLanes);
using FloatVec = hn::Vec<FloatTag>;
using IntTag = hn::RebindToSigned<FloatTag>;
inline constexpr std::size_t kLanes = hn::MaxLanes(FloatTag());

template <typename T, typename Tag>
HWY_INLINE hn::Vec<Tag> load_unaligned(Tag tag, const std::byte* bytes) {
#if HWY_TARGET == HWY_SCALAR
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return hn::Set(tag, value);
#else
  return hn::LoadU(tag, reinterpret_cast<const T*>(bytes));
#endif
}

template <typename T>
HWY_INLINE T load_one(const std::byte* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

// Exact for every half, infinities and NaNs included.
template <typename Tag>
HWY_INLINE hn::Vec<Tag> half_to_float(Tag d, const std::byte* bytes) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
  const hn::Rebind<hwy::float16_t, Tag> d16;
  return hn::PromoteTo(d, load_unaligned<hwy::float16_t>(d16, bytes));
#else
  // Highway's own conversion leaves infinities and NaNs undefined where the processor has none.
  // Exponent and mantissa, moved into a float's place, make a number 2^112 too small, denormals
  // included.
  const hn::RebindToUnsigned<Tag> du;
  const hn::Rebind<std::uint16_t, Tag> du16;
  const auto half = hn::BitCast(
      du, hn::PromoteTo(hn::RebindToSigned<Tag>(), load_unaligned<std::uint16_t>(du16, bytes)));
  const auto magnitude = hn::ShiftLeft<13>(hn::And(half, hn::Set(du, 0x7FFFU)));
  const auto sign = hn::ShiftLeft<16>(hn::And(half, hn::Set(du, 0x8000U)));
  const auto scaled = hn::BitCast(du, hn::Mul(hn::BitCast(d, magnitude), hn::Set(d, 0x1p112F)));
  const auto special_mask = hn::Eq(hn::And(half, hn::Set(du, 0x7C00U)), hn::Set(du, 0x7C00U));
  const auto special = hn::IfThenElseZero(special_mask, hn::Set(du, 0x7F800000U));
  return hn::BitCast(d, hn::Or(hn::Or(scaled, special), sign));
#endif
}

// Each loader gives samples [index, index + lanes) of a row, or one of them as the same float.
struct HalfSamples {
  const std::byte* row;

  HWY_INLINE FloatVec vector(std::size_t index) const {
    return half_to_float(FloatTag(), row + 2 * index);
  }
  HWY_INLINE float one(std::size_t index) const {
    return hn::GetLane(half_to_float(HWY_CAPPED(float, 1)(), row + 2 * index));
  }
};

struct FloatSamples {
  const std::byte* row;

  HWY_INLINE FloatVec vector(std::size_t index) const {
    return load_unaligned<float>(FloatTag(), row + 4 * index);
  }
  HWY_INLINE float one(std::size_t index) const { return load_one<float>(row + 4 * index); }
};

// Both halves of the number convert exactly and so does their scaling; their sum rounds once, which
// makes it the nearest float.
struct Uint32Samples {
  const std::byte* row;

  HWY_INLINE FloatVec vector(std::size_t index) const {
    const hn::RebindToUnsigned<FloatTag> du;
    const auto bits = load_unaligned<std::uint32_t>(du, row + 4 * index);
    const auto high = hn::BitCast(IntTag(), hn::ShiftRight<16>(bits));
    const auto low = hn::BitCast(IntTag(), hn::And(bits, hn::Set(du, 0xFFFFU)));
    const FloatTag d;
    return hn::Add(hn::Mul(hn::ConvertTo(d, high), hn::Set(d, 65536.0F)), hn::ConvertTo(d, low));
  }
  HWY_INLINE float one(std::size_t index) const {
    return static_cast<float>(load_one<std::uint32_t>(row + 4 * index));
  }
};

// 2^(e-136) of a Radiance exponent, 0 for e = 0: what a mantissa m is multiplied by, exactly,
// whatever e. 2^(e-128) has the float bits (e-1) << 23, but for e = 1, where it is the denormal
// 2^-127 with the bits 1 << 22. e << 22 gives that and the 0, and is nowhere else the larger one.
HWY_INLINE FloatVec texel_scales(const std::byte* exponents) {
  const FloatTag d;
  const IntTag di;
  const hn::Rebind<std::uint8_t, FloatTag> d8;
  const auto e = hn::PromoteTo(di, load_unaligned<std::uint8_t>(d8, exponents));
  const auto normal = hn::Sub(hn::ShiftLeft<23>(e), hn::Set(di, 1 << 23));
  const auto bits = hn::Max(normal, hn::ShiftLeft<22>(e));
  return hn::Mul(hn::BitCast(d, bits), hn::Set(d, 0x1p-8F));
}

HWY_INLINE float texel_scale(std::uint8_t e) {
  const std::uint32_t bits = e > 1 ? (e - 1U) << 23 : e == 1 ? 0x00400000U : 0U;
  return std::bit_cast<float>(bits) * 0x1p-8F;
}

// The scales of a whole row, which its three channels share.
inline void make_texel_scales(const std::byte* exponents, std::size_t width, float* scales) {
  std::size_t k = 0;
  for (; k + kLanes <= width; k += kLanes) {
    hn::StoreU(texel_scales(exponents + k), FloatTag(), scales + k);
  }
  for (; k < width; ++k) scales[k] = texel_scale(load_one<std::uint8_t>(exponents + k));
}

template <int kHalves>
struct RgbeSamples {
  const std::byte* row;
  const float* scales;

  static constexpr float kOffset = 0.5F * kHalves;

  HWY_INLINE FloatVec vector(std::size_t index) const {
    const FloatTag d;
    const hn::Rebind<std::uint8_t, FloatTag> d8;
    const auto m = hn::PromoteTo(IntTag(), load_unaligned<std::uint8_t>(d8, row + index));
    auto mantissa = hn::ConvertTo(d, m);
    if constexpr (kHalves != 0) mantissa = hn::Add(mantissa, hn::Set(d, kOffset));
    return hn::Mul(mantissa, hn::LoadU(d, scales + index));
  }
  HWY_INLINE float one(std::size_t index) const {
    const auto m = static_cast<float>(load_one<std::uint8_t>(row + index));
    return (m + kOffset) * scales[index];
  }
};

inline bool is_rgbe(const RowBand& band) {
  return band.channels[0].type == SampleType::rgbe_floor ||
         band.channels[0].type == SampleType::rgbe_center;
}

// What all channels of a row of Radiance texels share.
inline void prepare_scales(const RowBand& band, int row, AlignedBuffer<float>& scales) {
  if (!is_rgbe(band)) return;
  const auto width = static_cast<std::size_t>(band.width);
  scales.resize_uninitialised(width);
  make_texel_scales(band.exponent.row(row), width, scales.data());
}

// Calls `use` with the loader of one row of one channel. `scales`: of the row, for Radiance texels.
template <typename Use>
HWY_INLINE void with_samples(const RowBand& band, int row, int channel, const float* scales,
                             const Use& use) {
  const Plane& plane = band.channels[channel];
  const std::byte* samples = plane.row(row);
  switch (plane.type) {
    case SampleType::half:
      return use(HalfSamples{samples});
    case SampleType::float32:
      return use(FloatSamples{samples});
    case SampleType::uint32:
      return use(Uint32Samples{samples});
    case SampleType::rgbe_floor:
      return use(RgbeSamples<0>{samples, scales});
    case SampleType::rgbe_center:
      return use(RgbeSamples<1>{samples, scales});
  }
}

}  // namespace shoal::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard, toggled once a target
