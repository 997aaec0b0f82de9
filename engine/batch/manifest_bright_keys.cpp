// The keys of what becomes of the brightest light: clamp and sun.
#include <cmath>
#include <limits>

#include "batch/manifest_key_table.h"

namespace shoal {
namespace {

using Limits = std::numeric_limits<double>;
constexpr NumberRule kNotNegative{0.0, Limits::max(), "a number that is not negative"};
constexpr NumberRule kAboveZero{Limits::denorm_min(), Limits::max(), "a number above 0"};
constexpr NumberRule kTop{Limits::denorm_min(), kMostBright,
                          "a part of the sphere: a number above 0, at most 0.01"};
const NumberRule kPercentile{99.0, std::nextafter(100.0, 0.0), "a number from 99 to below 100"};

const ManifestKeyRule<PixelPolicy> kClampRules[] = {
    {"percentile", [](const ManifestReader& reader, const Field& field, PixelPolicy& policy) {
       assign(reader.number(field, kPercentile), policy.clamp_percentile);
     }}};

const ManifestKeyRule<SunSettings> kSunRules[] = {
    {"top", [](const ManifestReader& reader, const Field& field,
               SunSettings& sun) { assign(reader.number(field, kTop), sun.top); }},
    {"above", [](const ManifestReader& reader, const Field& field,
                 SunSettings& sun) { assign(reader.number(field, kAboveZero), sun.above); }},
    {"action",
     [](const ManifestReader& reader, const Field& field, SunSettings& sun) {
       assign(reader.choice<SunSettings::Action>(field, kSunActionChoices), sun.action);
     },
     choice_names<kSunActionChoices>},
};

}  // namespace

std::span<const ManifestKeyRule<PixelPolicy>> clamp_rules() { return kClampRules; }
std::span<const ManifestKeyRule<SunSettings>> sun_rules() { return kSunRules; }

void read_clamp(const ManifestReader& reader, const Field& field, PixelPolicy& policy) {
  policy.clamp = 0.0;
  policy.clamp_percentile = 0.0;
  if (!field.value.IsMap()) {
    assign(reader.number(field, kNotNegative), policy.clamp);
    return;
  }
  read_mapping(reader, field.value, kClampMapping, KeyTarget<PixelPolicy>{kClampRules, &policy});
  if (field.value.size() == 0) {
    reader.error(field.value, "a clamp needs a percentile", "such as clamp: {percentile: 99.9}");
  }
}

void read_sun(const ManifestReader& reader, const Field& field, SunSettings& sun) {
  sun = {};
  if (field.value.IsScalar()) {
    assign(reader.choice<SunSettings>(field, kNoSunChoices), sun);
    return;
  }
  if (!read_mapping(reader, field.value, kSunMapping, KeyTarget<SunSettings>{kSunRules, &sun})) {
    return;
  }
  const bool by_top = field.value.IsMap() && field.value["top"];
  const bool by_level = field.value.IsMap() && field.value["above"];
  if (by_top == by_level) {
    reader.error(field.value, "a sun is told either by top or by above", "such as {top: 0.0005}");
  }
}

}  // namespace shoal
