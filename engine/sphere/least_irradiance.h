// Where a panorama's irradiance, as a sum to some degree has it, is least.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/result.h"
#include "sphere/basis.h"
#include "sphere/coefficients.h"
#include "sphere/equirect_evaluator.h"

namespace shoal {

// The least value of a panorama's irradiance over all directions and channels, each channel in
// units of its own mean irradiance: 1 under a constant environment, 0 where a direction gets no
// light, negative where a sum to a low degree dips below.
struct LeastIrradiance {
  double value = 1.0;
  glm::dvec3 direction{0.0, 0.0, 1.0};  // unit, in the coefficients' frame
  int channel = 0;

  friend bool operator==(const LeastIrradiance&, const LeastIrradiance&) = default;
};

// Searches one panorama's irradiance, under any gains a degree. Channels without any light count
// for nothing.
class IrradianceSearch {
 public:
  // Error: usage, where a channel has light of which the mean is not positive, or where
  // coefficients are not finite.
  [[nodiscard]] static Result<IrradianceSearch> make(const Coefficients& radiance);

  enum class Effort {
    certain,  // whatever may hold the least value is looked into
    deepest,  // only a dozen low places a channel: one that is lower may be missed
  };

  // Local minima, the least first: the least one, and others low down. Empty where no channel has
  // light. Found on a grid of 8(L+1) rows and refined by Newton's method. Error of the least value:
  // 1e-12 of the channel's largest irradiance. Precondition: gains holds the degree + 1 numbers.
  [[nodiscard]] std::vector<LeastIrradiance> minima(std::span<const double> gains,
                                                    Effort effort) const;

  // What each degree contributes to the irradiance of a channel in a unit direction, in units of
  // the channel's mean: (degree+1), the first being 1.
  [[nodiscard]] std::vector<double> parts(int channel, const glm::dvec3& direction) const;

 private:
  explicit IrradianceSearch(int degree);

  // A low grid point.
  struct Candidate {
    double value = 0.0;
    glm::dvec3 direction{0.0};
  };
  struct Tangents;
  struct Quadratic;
  using Channels = std::array<std::vector<double>, kChannelCount>;

  [[nodiscard]] std::vector<double> grid_values(const std::vector<double>& coefficients) const;
  [[nodiscard]] std::vector<Candidate> candidates(const std::vector<double>& values,
                                                  double rise) const;
  [[nodiscard]] bool is_local_minimum(const std::vector<double>& values, int row, int column) const;
  [[nodiscard]] double value_at(const std::vector<double>& coefficients,
                                const glm::dvec3& direction) const;
  [[nodiscard]] Quadratic quadratic_at(const std::vector<double>& coefficients, double value,
                                       const Tangents& at) const;
  [[nodiscard]] static glm::dvec2 newton_step(const Quadratic& q);
  [[nodiscard]] LeastIrradiance refine(const std::vector<double>& coefficients,
                                       glm::dvec3 direction) const;

  int degree_ = 0;
  EquirectEvaluator grid_;  // 8(L+1) rows, twice as many columns
  Basis<double> basis_;
  Channels irradiance_;  // index order, by the channel's mean; empty for a dark channel
};

// The least one without gains; value 0 where no channel has light. Error: as IrradianceSearch.
[[nodiscard]] Result<LeastIrradiance> least_irradiance(const Coefficients& radiance);

}  // namespace shoal
