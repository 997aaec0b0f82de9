#include "transform/bright_texels.h"

#include <numbers>
#include <utility>

namespace shoal {
namespace {

constexpr double kSphere = 4.0 * std::numbers::pi;

// What is let go while rows come is let go for certain, whichever way sums of solid angles round.
constexpr double kMargin = 1.0 + 1e-9;

// Bins of floats above 0: sign, exponent and 7 bits of the mantissa, so that one is a range of 1 %.
constexpr int kBinShift = 16;
constexpr std::size_t kBinCount = std::size_t{1} << (31 - kBinShift);

std::uint32_t bin_of(float value) { return std::bit_cast<std::uint32_t>(value) >> kBinShift; }

// Fewer texels are not worth looking through.
constexpr std::size_t kLeastCount = 4096;

// What a texel is sorted by.
struct SortKey {
  std::uint64_t key;
  std::int32_t column;
  std::uint32_t index;
};

bool is_before(const SortKey& a, const SortKey& b) {
  return a.key != b.key ? a.key > b.key : a.column < b.column;
}

}  // namespace

float BrightestTexels::threshold(double fraction) const {
  double covered = 0.0;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    covered += solid_angles[i];
    if (covered > fraction * kSphere) return texels[i].value();
  }
  return 0.0F;
}

BrightTexels::BrightTexels(double fraction, float floor, SolidAngle solid_angle)
    : most_(fraction * kSphere),
      floor_(floor),
      solid_angle_(std::move(solid_angle)),
      count_to_let_go_at_(kLeastCount),
      covered_by_bin_(kBinCount) {}

void BrightTexels::add(std::span<const BrightTexel> texels) {
  const std::scoped_lock lock(mutex_);
  for (const BrightTexel& texel : texels) {
    const float value = texel.value();
    if (!may_hold(value, texel.row)) continue;
    texels_.push_back(texel);
    const double solid_angle = solid_angle_(texel.row, texel.column);
    covered_by_bin_[bin_of(value)] += solid_angle;
    covered_ += solid_angle;
  }
  raise_cut();
  if (texels_.size() > count_to_let_go_at_) let_go();
}

// As far as the bins above cover enough without the lowest. Called with mutex_ held, as the next.
void BrightTexels::raise_cut() {
  const std::uint32_t before = cut_bin_;
  while (covered_ - covered_by_bin_[cut_bin_] > most_ * kMargin) {
    covered_ -= covered_by_bin_[cut_bin_++];
  }
  if (cut_bin_ == before) return;
  const auto lowest = std::bit_cast<float>(cut_bin_ << kBinShift);
  cut_ = std::max(cut_.load(), key(lowest, std::numeric_limits<std::int32_t>::max()));
}

void BrightTexels::let_go() {
  std::erase_if(texels_, [this](const BrightTexel& texel) {
    return key(texel.value(), texel.row) < cut_.load(std::memory_order_relaxed);
  });
  // Of many texels in one bin, or all alike, the order decides.
  if (covered_ > 2.0 * most_) keep_first(most_ * kMargin);
  count_to_let_go_at_ = std::max(kLeastCount, texels_.size() + texels_.size() / 2);
}

// Keeps the texels up to the one with which they cover more than `most`.
void BrightTexels::keep_first(double most) {
  std::vector<SortKey> keys;
  keys.reserve(texels_.size());
  for (std::size_t i = 0; i < texels_.size(); ++i) {
    const BrightTexel& texel = texels_[i];
    keys.push_back({key(texel.value(), texel.row), texel.column, static_cast<std::uint32_t>(i)});
  }
  std::ranges::sort(keys, is_before);
  std::vector<BrightTexel> kept;
  double covered = 0.0;
  for (const SortKey& place : keys) {
    kept.push_back(texels_[place.index]);
    covered += solid_angle_(kept.back().row, kept.back().column);
    if (covered <= most) continue;
    cut_ = std::max(cut_.load(), place.key);
    break;
  }
  texels_ = std::move(kept);
}

BrightestTexels BrightTexels::brightest() {
  const std::scoped_lock lock(mutex_);
  let_go();
  keep_first(most_);
  BrightestTexels result;
  result.texels = std::exchange(texels_, {});
  result.solid_angles.reserve(result.texels.size());
  for (const BrightTexel& texel : result.texels) {
    result.solid_angles.push_back(solid_angle_(texel.row, texel.column));
  }
  return result;
}

}  // namespace shoal
