#include "sphere/automatic_window.h"

#include <algorithm>
#include <cmath>

#include "sphere/irradiance.h"
#include "sphere/nearest_point.h"

namespace shoal {
namespace {

// In units of a channel's mean irradiance. A direction off by its square root leaves the gains off
// by as much, hence so small.
constexpr double kTolerance = 1e-12;
constexpr int kMostRounds = 200;

// w_l: the square norm of degree l of the irradiance, over the channels.
std::vector<double> degree_energies(const Coefficients& radiance) {
  std::vector<double> energies(radiance.degree + 1, 0.0);
  for (int l = 0; l <= radiance.degree; ++l) {
    for (const auto& channel : radiance.channels) {
      for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
        const double value = clamped_cosine_gain(l) * channel[i];
        energies[l] += value * value;
      }
    }
  }
  return energies;
}

// The programme in x_l = s_l (1 - g_l), s_l^2 = w_l / sum w, for the degrees that hold irradiance:
// the least |x| with 0 <= x_l <= s_l and, for every direction taken so far, non-negative
// irradiance.
class GainProgramme {
 public:
  explicit GainProgramme(const std::vector<double>& energies) : size_(energies.size()) {
    double total = 0.0;
    for (std::size_t l = 1; l < size_; ++l) total += energies[l];
    for (std::size_t l = 1; l < size_; ++l) {
      if (energies[l] == 0.0) continue;
      degrees_.push_back(static_cast<int>(l));
      scales_.push_back(std::sqrt(energies[l] / total));
    }
    for (std::size_t k = 0; k < degrees_.size(); ++k) {
      std::vector<double> normal(degrees_.size(), 0.0);
      normal[k] = 1.0;
      conditions_.push_back({normal, 0.0});
      normal[k] = -1.0;
      conditions_.push_back({normal, -scales_[k]});
    }
  }

  // sum_l g_l parts_l >= 0, with g_l = 1 - x_l / s_l.
  void require_positive(const std::vector<double>& parts) {
    HalfSpace condition;
    for (std::size_t k = 0; k < degrees_.size(); ++k) {
      condition.normal.push_back(-parts[degrees_[k]] / scales_[k]);
    }
    for (double part : parts) condition.bound -= part;
    conditions_.push_back(std::move(condition));
  }

  [[nodiscard]] Result<std::vector<double>> gains() const {
    const auto x = nearest_point(static_cast<int>(degrees_.size()), conditions_);
    if (!x) {
      return Error{ErrorCode::internal, "the search for an automatic window did not settle", "",
                   "choose a window by name, such as hann, and report this panorama"};
    }
    std::vector<double> gains(size_, 1.0);
    for (std::size_t k = 0; k < degrees_.size(); ++k) {
      const double cut = std::clamp((*x)[k] / scales_[k], 0.0, 1.0);
      // Rounding of a degree that is not cut.
      if (cut > 1e-12) gains[degrees_[k]] = 1.0 - cut;
    }
    return gains;
  }

 private:
  std::size_t size_ = 0;
  std::vector<int> degrees_;
  std::vector<double> scales_;
  std::vector<HalfSpace> conditions_;
};

double relative_change(const std::vector<double>& energies, const std::vector<double>& gains) {
  double lost = 0.0, total = 0.0;
  for (std::size_t l = 0; l < energies.size(); ++l) {
    lost += energies[l] * (1.0 - gains[l]) * (1.0 - gains[l]);
    total += energies[l];
  }
  return total > 0.0 ? std::sqrt(lost / total) : 0.0;
}

}  // namespace

int AutomaticWindow::strongest_cut() const {
  const auto least = std::min_element(gains.begin(), gains.end());
  return least != gains.end() && *least < 1.0 ? static_cast<int>(least - gains.begin()) : 0;
}

// Kelley's cutting planes for the semi-infinite programme: solve it for the directions at hand,
// look where the irradiance of its gains is negative, add those directions.
Result<AutomaticWindow> fit_window(const Coefficients& radiance) {
  SHOAL_ASSIGN_OR_RETURN(search, IrradianceSearch::make(radiance));
  const std::vector<double> energies = degree_energies(radiance);
  AutomaticWindow window;
  window.gains.assign(radiance.degree + 1, 1.0);
  GainProgramme programme(energies);
  using Effort = IrradianceSearch::Effort;
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<LeastIrradiance> minima =
        search.minima(window.gains, round == 0 ? Effort::certain : Effort::deepest);
    if (round > 0 && !minima.empty() && minima.front().value >= -kTolerance) {
      minima = search.minima(window.gains, Effort::certain);
    }
    window.after = minima.empty() ? LeastIrradiance{.value = 0.0} : minima.front();
    if (round == 0) window.before = window.after;
    if (window.after.value >= -kTolerance) {
      window.change = relative_change(energies, window.gains);
      return window;
    }
    for (const LeastIrradiance& low : minima) {
      if (low.value < -kTolerance / 10) {
        programme.require_positive(search.parts(low.channel, low.direction));
      }
    }
    SHOAL_ASSIGN_OR_RETURN(gains, programme.gains());
    window.gains = gains;
  }
  return Error{ErrorCode::internal, "the search for an automatic window did not end", "",
               "choose a window by name, such as hann, and report this panorama"};
}

}  // namespace shoal
