// The words that keys of a profile take.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "output/profile.h"

namespace shoal {

// The keys of a profile, and those that a choice of an option may replace.
inline constexpr std::string_view kConventionKeys[] = {"frame", "sign",  "quantity",
                                                       "basis", "scale", "light"};
inline constexpr std::string_view kKeys[] = {
    "shoal_profile", "title", "consumer",  "frame", "sign",     "quantity", "basis",
    "scale",         "light", "degree",    "order", "channels", "packing",  "number",
    "separator",     "form",  "extension", "text",  "options",  "sources",  "unknown"};

template <typename E>
struct Word {
  std::string_view name;
  E value;
};
inline constexpr Word<BasisSign> kSigns[] = {{"plain", BasisSign::plain},
                                             {"condon-shortley", BasisSign::condon_shortley}};
inline constexpr Word<Quantity> kQuantities[] = {
    {"radiance", Quantity::radiance},
    {"irradiance", Quantity::irradiance},
    {"irradiance_over_pi", Quantity::irradiance_over_pi}};
inline constexpr Word<BasisConstant> kBases[] = {{"separate", BasisConstant::separate},
                                                 {"premultiplied", BasisConstant::premultiplied}};
inline constexpr Word<ProfileLight> kLights[] = {
    {"full", ProfileLight::full},
    {"zh3", ProfileLight::zh3},
    {"zh3-hallucinated", ProfileLight::zh3_hallucinated}};
inline constexpr Word<ChannelPacking> kChannels[] = {{"interleaved", ChannelPacking::interleaved},
                                                     {"planar", ChannelPacking::planar}};
inline constexpr Word<NumberType> kNumbers[] = {{"float32", NumberType::float32},
                                                {"float64", NumberType::float64}};
inline constexpr Word<ProfileForm> kForms[] = {{"text", ProfileForm::text},
                                               {"npy", ProfileForm::npy}};

template <typename E, std::size_t kCount>
[[nodiscard]] std::string_view word_of(const Word<E> (&words)[kCount], E value) {
  return std::ranges::find(words, value, &Word<E>::value)->name;
}

// Whether a name can stand in a file's name and in a place of a text.
[[nodiscard]] inline bool is_word(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_';
  });
}

}  // namespace shoal
