#include "bench/panorama_painter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::bench {
namespace {

constexpr int kBroadOctaves = 5;
constexpr int kFirstColumns = 4;
constexpr float kLuminanceGrain = 0.008F;  // standard deviations, relative
constexpr float kChannelGrain = 0.004F;
constexpr float kSunRadiance = 5e4F;
constexpr double kSunRadius = 0.27 * std::numbers::pi / 180.0;

// SplitMix64's finaliser: 64 well mixed bits of a counter. Source: Steele, Lea & Flood, "Fast
// splittable pseudorandom number generators", OOPSLA 2014.
std::uint64_t mixed(std::uint64_t value) {
  value += 0x9E3779B97F4A7C15U;
  value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9U;
  value = (value ^ (value >> 27)) * 0x94D049BB133111EBU;
  return value ^ (value >> 31);
}

float smooth_step(float value) {
  const float t = std::clamp(value, 0.0F, 1.0F);
  return t * t * (3.0F - 2.0F * t);
}

// The sum of two uniform bytes is near enough to a normal deviate; this one has deviation 1.
float deviate(std::uint64_t bits) {
  const auto sum = static_cast<float>((bits & 255) + (bits >> 8 & 255));
  return (sum - 255.0F) * (1.0F / 104.5F);
}

}  // namespace

NoiseOctave::NoiseOctave(int width, int height, int columns, float amplitude, std::uint64_t seed)
    : lattice_rows_per_row_(0.5 * columns / height),
      amplitude_(amplitude),
      seed_(mixed(seed)),
      cells_(width),
      weights_(width),
      upper_(columns + 1),
      lower_(columns + 1),
      blended_(columns + 1) {
  for (int j = 0; j < width; ++j) {
    const double at = (j + 0.5) * columns / width;
    cells_[j] = static_cast<int>(at);
    weights_[j] = smooth_step(static_cast<float>(at - cells_[j]));
  }
}

void NoiseOctave::fill_lattice_row(int index, std::vector<float>& values) const {
  const std::uint64_t row_seed = mixed(seed_ + static_cast<std::uint64_t>(index));
  for (std::size_t k = 0; k + 1 < values.size(); ++k) {
    const auto bits = static_cast<std::int32_t>(mixed(row_seed + k) >> 32);
    values[k] = amplitude_ * 0x1p-31F * static_cast<float>(bits);
  }
  values.back() = values.front();
}

void NoiseOctave::add_row(int row, float* sums) {
  const double at = (row + 0.5) * lattice_rows_per_row_;
  const int index = static_cast<int>(at);
  if (index != upper_index_) {
    if (index == upper_index_ + 1) {
      upper_.swap(lower_);
    } else {
      fill_lattice_row(index, upper_);
    }
    fill_lattice_row(index + 1, lower_);
    upper_index_ = index;
  }
  const float weight = smooth_step(static_cast<float>(at - index));
  for (std::size_t k = 0; k < blended_.size(); ++k) {
    blended_[k] = upper_[k] + weight * (lower_[k] - upper_[k]);
  }
  for (std::size_t j = 0; j < cells_.size(); ++j) {
    const float* cell = blended_.data() + cells_[j];
    sums[j] += cell[0] + weights_[j] * (cell[1] - cell[0]);
  }
}

PanoramaPainter::PanoramaPainter(int width, int height, std::uint64_t seed)
    : width_(width), height_(height), seed_(mixed(seed)), broad_(width), fine_(width), hue_(width) {
  float amplitude = 0.9F;
  int octave = 0;
  for (int columns = kFirstColumns; columns <= std::max(kFirstColumns, width / 2); columns *= 2) {
    auto& octaves = octave < kBroadOctaves ? broad_octaves_ : fine_octaves_;
    octaves.emplace_back(width, height, columns, amplitude, seed_ + octave);
    amplitude *= 0.68F;
    ++octave;
  }
  for (int columns = kFirstColumns; columns <= 4 * kFirstColumns; columns *= 2) {
    hue_octaves_.emplace_back(width, height, columns, 0.08F, seed_ + 100 + columns);
  }
}

void PanoramaPainter::paint_texture(int row) {
  const auto sum = [row](std::vector<NoiseOctave>& octaves, std::vector<float>& sums) {
    std::ranges::fill(sums, 0.0F);
    for (NoiseOctave& octave : octaves) octave.add_row(row, sums.data());
  };
  sum(broad_octaves_, broad_);
  sum(fine_octaves_, fine_);
  sum(hue_octaves_, hue_);
}

void PanoramaPainter::paint_row(int row, const std::array<float*, 3>& planes) {
  paint_texture(row);
  const float elevation = 1.0F - 2.0F * (static_cast<float>(row) + 0.5F) / height_;
  const float zenith = std::max(0.0F, elevation);
  const std::array<float, 3> sky = {0.9F - 0.6F * zenith, 0.95F - 0.4F * zenith,
                                    1.0F - 0.1F * zenith};
  const std::array<float, 3> ground = {0.20F, 0.16F, 0.11F};
  for (int j = 0; j < width_; ++j) {
    const float share = smooth_step(0.5F + 12.0F * (elevation + 0.06F * broad_[j]));
    const float texture = (1.0F - 0.55F * share) * broad_[j] + (1.0F - 0.8F * share) * fine_[j];
    const float light = std::exp2(texture);
    const float warmth = 1.0F + hue_[j];
    planes[0][j] = light * warmth * (ground[0] + share * (sky[0] - ground[0]));
    planes[1][j] = light * (ground[1] + share * (sky[1] - ground[1]));
    planes[2][j] = light * (2.0F - warmth) * (ground[2] + share * (sky[2] - ground[2]));
  }
  add_sun(row, planes);
  add_grain(row, planes);
}

void PanoramaPainter::add_grain(int row, const std::array<float*, 3>& planes) const {
  const std::uint64_t row_seed = mixed(seed_ ^ (static_cast<std::uint64_t>(row) << 20));
  for (int j = 0; j < width_; ++j) {
    const std::uint64_t bits = mixed(row_seed + static_cast<std::uint64_t>(j));
    const float common = 1.0F + kLuminanceGrain * deviate(bits);
    for (int c = 0; c < 3; ++c) {
      planes[c][j] *= common + kChannelGrain * deviate(bits >> (16 * (c + 1)));
    }
  }
}

// A disc with a soft edge of a texel, 35 degrees above the horizon.
void PanoramaPainter::add_sun(int row, const std::array<float*, 3>& planes) const {
  constexpr double kTheta = 55.0 * std::numbers::pi / 180.0;
  constexpr double kPhi = 2.1;
  const double texel = std::numbers::pi / height_;
  const double radius = std::max(kSunRadius, texel);
  const double up = texel * (row + 0.5) - kTheta;
  if (std::abs(up) > radius + texel) return;
  const double stretch = std::sin(kTheta);
  const double texels_a_radian = 0.5 * width_ / std::numbers::pi;
  const int reach = static_cast<int>((radius + texel) / stretch * texels_a_radian) + 1;
  const int middle = static_cast<int>(kPhi * texels_a_radian);
  for (int j = std::max(0, middle - reach); j < std::min(width_, middle + reach); ++j) {
    const double aside = ((j + 0.5) / texels_a_radian - kPhi) * stretch;
    const double depth = (radius - std::hypot(up, aside)) / texel + 0.5;
    const float share = smooth_step(static_cast<float>(depth));
    planes[0][j] += share * kSunRadiance;
    planes[1][j] += share * kSunRadiance * 0.93F;
    planes[2][j] += share * kSunRadiance * 0.82F;
  }
}

}  // namespace shoal::bench
